/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Births in doubles [FLT-BIRTH].
 *
 * The lower envelope of the lines of some sites is walked, its best corner found, and sites nearer there are added, as
 * in rows.c. Then it is confirmed: sites q_0, ..., q_h, and places s_1 < ... < s_h, s_b among them the exact crossing
 * of q_(b-1) and q_b, at which both are v < 0 nearer than i. At each other s_m both q_(m-1) and q_m are at least as
 * much nearer, and so are q_0 and q_h towards the ends. Where one site is that much nearer is convex: each q_m is
 * between s_m and s_(m+1). So no centre has less than v; and v holds for all sites when no other is nearer at the
 * crossing. Its value is worked out in double-doubles, and rounded as the exact one is.
 *
 * q is v nearer at s when D(s) <= v (2 r + v) and r + v > 0, r the distance of c(s) from i. D is off by em + 2 |s| en
 * and three roundings, the right side by 2^-48 of itself. */
#include "tolerance/dd_filter.h"
#include "tolerance/state.h"

enum { FIRST_LINES = 24, MOST_LINES = 96, MOST_ADDED = 8, MOST_ROUNDS = 24 };

#define ROOM 0x1p-48

/* corner[m], m > 0: where line[chain[m - 1]] and line[chain[m]] cross, about; best: the highest of them. end: 1, -1:
 * that end is higher. */
typedef struct birth_work {
  const dyd_tolerance *t;
  dyd_lines_d pair;
  dyd_line_d line[MOST_LINES];
  uint32_t count, links, best, chain[MOST_LINES];
  double corner[MOST_LINES + 1], value;
  int end;
} birth_work;

static bool birth_see(birth_work *b, uint32_t v) {
  for (uint32_t k = 0; k < b->count; k++)
    if (b->line[k].vertex == v) return true;
  if (b->count == MOST_LINES) return false;
  dyd_filter_line(&b->line[b->count++], &b->pair, &b->t->points, v);
  return true;
}

/* ---- the envelope ---- */

static double birth_r(const birth_work *b, double s) {
  return sqrt(b->pair.jj * (0.25 + s * s));
}

/* How much farther the line is than i at s: below 0 where it is nearer. */
static double birth_value(const birth_work *b, const dyd_line_d *o, double s) {
  double d = o->m - 2 * o->n * s, r = birth_r(b, s);
  return d / (sqrt(fmax(r * r + d, 0)) + r);
}

static void birth_envelope(birth_work *b) {
  b->links = dyd_filter_envelope(b->chain, b->corner, b->line, b->count);
  b->best = 0;
  b->value = -HUGE_VAL;
  for (uint32_t m = 1; m < b->links; m++) {
    double value = birth_value(b, &b->line[b->chain[m]], b->corner[m]);
    if (value > b->value) b->value = value, b->best = m;
  }
  double size = sqrt(b->pair.jj), left = b->line[b->chain[0]].n / size,
         right = -b->line[b->chain[b->links - 1]].n / size;
  b->end = fmax(left, right) < b->value ? 0 : left > right ? -1 : 1;
}

/* ---- the value ---- */

static dyd_dd_bounded dd_over(dyd_dd_bounded a, dyd_dd_bounded b) {
  double q = a.h / b.h;
  dyd_dd_bounded rest = dyd_dd_plus(a, dyd_dd_times(b, dyd_dd_of(q)), -1);
  double e = (rest.e + DYD_DD_ROUND * fabs(a.h)) / (fabs(b.h) - b.e) * (1 + 0x1p-20);
  return dyd_dd_renormal(q, rest.h / b.h, b.e < 0x1p-30 * fabs(b.h) ? e : HUGE_VAL);
}

/* Where the birth is by the best corner, its place *s within *es, *radius2 at least the squared distance of its lines
 * there. */
static dyd_dd_bounded birth_at_corner(double *s, double *es, double *radius2, const birth_work *b) {
  const dyd_points_d *points = &b->t->points;
  dyd_dd_bounded j[2], k[2], l[2];
  dyd_dd_vector(j, points, b->pair.j, b->pair.i);
  dyd_dd_line(&k[0], &k[1], points, b->line[b->chain[b->best - 1]].vertex, b->pair.i, b->pair.j, j);
  dyd_dd_line(&l[0], &l[1], points, b->line[b->chain[b->best]].vertex, b->pair.i, b->pair.j, j);
  dyd_dd_bounded e = dyd_dd_plus(l[1], k[1], -1);
  dyd_dd_bounded height = dd_over(dyd_dd_plus(dyd_dd_times(l[1], k[0]), dyd_dd_times(k[1], l[0]), -1), e);
  dyd_dd_bounded place = dd_over(dyd_dd_plus(l[0], k[0], -1), dyd_dd_times(e, dyd_dd_of(2)));
  dyd_dd_bounded jj = dyd_dd_square_sum(j[0], j[1]);
  dyd_dd_bounded r2 = dyd_dd_times(jj, dyd_dd_plus(dyd_dd_of(0.25), dyd_dd_times(place, place), 1));
  dyd_dd_bounded other = dyd_dd_plus(r2, height, 1);
  *s = place.h;
  *es = place.e + ROOM * fabs(place.h);
  *radius2 = (other.h + other.e) * (1 + ROOM);
  dyd_dd_bounded sum = dyd_dd_plus(dyd_dd_root(r2), dyd_dd_root(other), 1);
  return dd_over(height, dyd_dd_times(sum, dyd_dd_of(-2)));
}

/* Doubles next to it; false: not certain. */
static bool birth_round(double *lo, double *hi, dyd_dd_bounded v) {
  if (!(v.h > 0x1p-900 && v.h < 0x1p900 && fabs(v.l) > v.e * (1 + 0x1p-20))) return false;
  *lo = v.l > 0 ? v.h : nextafter(v.h, 0);
  *hi = v.l > 0 ? nextafter(v.h, HUGE_VAL) : v.h;
  return true;
}

/* ---- the proof ---- */

static bool is_nearer_by(const birth_work *b, const dyd_line_d *o, double s, double v) {
  double r = birth_r(b, s), d = o->m - 2 * o->n * s, right = v * (2 * r + v);
  double doubt = o->em + 2 * fabs(s) * o->en + ROOM * (fabs(o->m) + fabs(2 * o->n * s) + fabs(right));
  return r + v > ROOM * r && d + doubt * (1 + ROOM) < right;
}

/* No centre has less than the birth t, but the best corner. */
static bool birth_is_least(const birth_work *b, double t) {
  double v = -2 * t, out = -v * sqrt(b->pair.jj) * (1 + ROOM);
  const dyd_line_d *first = &b->line[b->chain[0]], *last = &b->line[b->chain[b->links - 1]];
  if (!(first->n + first->en < -out && last->n - last->en > out && b->pair.rjj < 0x1p-49)) return false;
  for (uint32_t m = 1; m < b->links; m++)
    if (m != b->best && !(is_nearer_by(b, &b->line[b->chain[m - 1]], b->corner[m], v) &&
                          is_nearer_by(b, &b->line[b->chain[m]], b->corner[m], v)))
      return false;
  return true;
}

/* How high the line is over i's at s, which is off by es; *doubt: by how much that may be off. */
static double birth_height(double *doubt, const birth_work *b, uint32_t k, double s, double es) {
  const dyd_line_d *o = &b->line[k];
  *doubt = o->em + 2 * (fabs(s) + es) * o->en + 2 * fabs(o->n) * es + ROOM * (fabs(o->m) + fabs(2 * o->n * s));
  return o->m - 2 * o->n * s;
}

/* No other site seen is as near to the best corner. */
static bool best_is_lowest(const birth_work *b, double s, double es) {
  uint32_t one = b->chain[b->best - 1], two = b->chain[b->best];
  double doubt, more, low = birth_height(&doubt, b, one, s, es);
  for (uint32_t k = 0; k < b->count; k++) {
    double other = birth_height(&more, b, k, s, es);
    if (k != one && k != two && !(other - low > (doubt + more) * (1 + ROOM))) return false;
  }
  return true;
}

/* ---- nearer sites ---- */

/* From (x, y), seen from i; the squared radius shrinks to the sites met. had: MOST_LINES where there are too many. */
typedef struct birth_search {
  birth_work *b;
  uint32_t had;
  double x, y, radius2;
} birth_search;

static bool birth_meet(void *context, uint32_t v) {
  birth_search *s = context;
  birth_work *b = s->b;
  if (v == b->pair.i || v == b->pair.j) return true;
  if (!birth_see(b, v)) {
    s->had = MOST_LINES;
    return false;
  }
  const dyd_line_d *o = &b->line[b->count - 1];
  double x = o->px - s->x, y = o->py - s->y;
  if (o->vertex == v) s->radius2 = fmin(s->radius2, (x * x + y * y) * (1 + 0x1p-30));
  return b->count < s->had + MOST_ADDED;
}

/* Adds sites that may be farther out at the end that is highest so far, about: later on they are only sites. */
static bool birth_beyond(bool *more, birth_work *b) {
  const dyd_line_d *low = &b->line[b->chain[b->end < 0 ? 0 : b->links - 1]];
  dyd_xy i = b->t->points.xy[b->pair.i];
  double size = sqrt(b->pair.jj), x = -b->end * b->pair.jy / size, y = b->end * b->pair.jx / size;
  double height = x * (i.x + low->px) + y * (i.y + low->py);
  birth_search search = {b, b->count, 0, 0, HUGE_VAL};
  dyd_tree_beyond(&b->t->tree, x, y, &height, birth_meet, &search);
  *more = b->count > search.had;
  return search.had < MOST_LINES && *more;
}

/* Adds sites that may be nearer at s. *more: there are some. false: too many. */
static bool birth_nearer(bool *more, birth_work *b, double s, double es, double radius2) {
  const dyd_points_d *p = &b->t->points;
  dyd_xy i = p->xy[b->pair.i];
  double jx = b->pair.jx, jy = b->pair.jy, cx = jx / 2 - s * jy, cy = jy / 2 + s * jx, x = i.x + cx, y = i.y + cy;
  double size = fabs(i.x) + fabs(i.y) + (fabs(jx) + fabs(jy)) * (1 + fabs(s));
  double room = ROOM * size + es * (fabs(jx) + fabs(jy)) + 4 * p->slack * (1 + fabs(s));
  const dyd_bbox at = {{x - room, x + room, y - room, y + room}};
  birth_search search = {b, b->count, cx, cy, radius2};
  if (!isfinite(radius2) || !isfinite(room)) return false;
  dyd_tree_near(&b->t->tree, &at, &search.radius2, birth_meet, &search);
  *more = b->count > search.had;
  return search.had < MOST_LINES;
}

/* ---- a pair ---- */

static bool birth_begin(birth_work *b, dyd_others *o, const dyd_tolerance *t, uint32_t i, uint32_t j) {
  b->t = t;
  b->count = 0;
  if (dyd_is_line(t->pd) || !dyd_filter_pair(&b->pair, &t->points, i, j)) return false;
  if (dyd_others_around(o, t, i, j, FIRST_LINES) != DYD_OK) return false;
  for (size_t k = 0; k < o->count; k++)
    if (!birth_see(b, o->vertex[k])) return false;
  return b->count > 1;
}

/* The row by the best corner, unless there are *more sites to see. false: not certain. */
static bool birth_settle(bool *more, dyd_tolerance_row *row, birth_work *b, double up_to) {
  double s, es, radius2, lo, hi;
  dyd_dd_bounded v = birth_at_corner(&s, &es, &radius2, b);
  if (!birth_round(&lo, &hi, v) || !birth_nearer(more, b, s, es, radius2)) return false;
  uint32_t k = b->line[b->chain[b->best - 1]].vertex, l = b->line[b->chain[b->best]].vertex;
  *row = dyd_row_of(b->t, b->pair.i, b->pair.j, DYD_EVENT_BIRTH, k, l, lo, hi);
  return *more || (best_is_lowest(b, s, es) && birth_is_least(b, hi) && hi <= up_to * (1 - 0x1p-50));
}

bool dyd_filter_birth(dyd_tolerance_row *row, bool *late, const dyd_tolerance *t, uint32_t i, uint32_t j, double up_to,
                      dyd_others *spare) {
  birth_work b;
  *late = false;
  if (!birth_begin(&b, spare, t, i, j)) return false;
  for (int round = 0; round < MOST_ROUNDS; round++) {
    bool more = false;
    birth_envelope(&b);
    uint32_t best = b.best;
    b.best = 0;
    *late = birth_is_least(&b, up_to * (1 + 0x1p-50));
    if (*late) return true;
    b.best = best;
    if (!(b.end ? birth_beyond(&more, &b) : birth_settle(&more, row, &b, up_to))) return false;
    if (!more) return true;
  }
  return false;
}
