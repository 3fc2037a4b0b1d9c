/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Centres of discs for some choice of places in cores, by a few of them and a descent in doubles.
 *
 * For a centre c the choice that joins i and j best is clear: theirs nearest to c, all others farthest. There is room
 * when the farther of i and j is then nearer to c than all others, wherever those are that cannot be chosen. */
#include "engine/settle_filter.h"

#include "base/local.h"
#include "engine/settle.h"

#include "legal/lp_filter.h"

#include <math.h>
#include <stdlib.h>

/* Four points that keep two sites apart, in doubles.
 *
 * A disc around c holds both ends and no other site if c is nearer to every corner a of theirs than to all points b of
 * the others: c is in half-planes. By Helly's theorem four of the points show that no such c exists: two a and two b on
 * crossing segments, where |a - z| |a' - z| > |b - z| |b' - z| at the crossing z, or one b among three a. Half-planes
 * are added as witnesses are searched for, for the farthest a and the nearest b, until nothing is left. */

/* Points of others, and half-planes; corners of both ends, or points on the rims of their discs. */
enum { AROUND = 8, MOST = 64, ENDS = 2 * AROUND + MOST };

typedef struct nearby_site {
  double at[2];
  size_t site;
} nearby_site;

/* Coordinates are relative to `origin`. end: corners of both ends. excess: by how much the best four, three of `inside`
 * or two of which are of ends, keep them apart; 0: nothing found. */
typedef struct cutting {
  const dyd_settle_site *site;
  size_t count, i, j;
  double origin[2];
  nearby_site end[ENDS], other[MOST];
  dyd_cut cut[MOST];
  size_t ends, others;
  nearby_site best[4];
  bool inside;
  double excess;
} cutting;

static double square(double x) {
  return x * x;
}

static double spot_distance2(const nearby_site *a, const double c[2]) {
  return square(a->at[0] - c[0]) + square(a->at[1] - c[1]);
}

/* Twice the area of a, b, c. */
static double spot_turn(const nearby_site *a, const nearby_site *b, const nearby_site *c) {
  return (b->at[0] - a->at[0]) * (c->at[1] - a->at[1]) - (b->at[1] - a->at[1]) * (c->at[0] - a->at[0]);
}

void dyd_filter_disc_point(double z[2], const double disc[3], const double at[2], bool farthest) {
  const double x = at[0] - disc[0], y = at[1] - disc[1], far = hypot(x, y), r = disc[2] * (1 - 0x1p-20);
  const double t = !(far > 0) ? 0 : farthest ? -r / far : fmin(1, r / far);
  z[0] = disc[0] + (far > 0 ? t * x : farthest ? r : 0);
  z[1] = disc[1] + t * y;
}

bool dyd_filter_within(const double disc[3], double x, double y, double r) {
  return hypot(x - disc[0], y - disc[1]) <= r * (1 - 0x1p-20);
}

static void cutting_add_disc(cutting *q, size_t k) {
  const double *d = q->site[k].disc;
  for (int n = 0; n < AROUND; n++) {
    const double t = 2 * 3.14159265358979 * n / AROUND, far[2] = {d[0] + 4 * d[2] * cos(t), d[1] + 4 * d[2] * sin(t)};
    nearby_site *s = &q->end[q->ends++];
    dyd_filter_disc_point(s->at, d, far, false);
    s->site = k;
    for (int x = 0; x < 2; x++) s->at[x] -= q->origin[x];
  }
}

static void cutting_add_end(cutting *q, size_t k) {
  const double *o = q->origin;
  if (q->site[k].disc[2] > 0) {
    cutting_add_disc(q, k);
    return;
  }
  double b[4];
  for (int n = 0; n < 4; n++) {
    const double *side = &q->site[k].box[n & 2];
    b[n] = q->site[k].core[n / 2] ? side[n & 1] : side[0] / 2 + side[1] / 2;
  }
  for (int x = 0; x < (b[0] < b[1] ? 2 : 1); x++)
    for (int y = 2; y < (b[2] < b[3] ? 4 : 3); y++) q->end[q->ends++] = (nearby_site){{b[x] - o[0], b[y] - o[1]}, k};
}

/* Tests whether b is inside of a, a2 and another point of the ends. */
static void cutting_look_inside(cutting *q, const nearby_site *a, const nearby_site *a2, const nearby_site *b) {
  for (const nearby_site *a3 = a2 + 1; a3 < q->end + q->ends; a3++) {
    double t = spot_turn(a, a2, a3), least = spot_turn(a, a2, b) / t;
    least = fmin(least, fmin(spot_turn(a2, a3, b) / t, spot_turn(a3, a, b) / t));
    double excess = least * fabs(t);
    if (!(least > 0) || !(excess > q->excess)) continue;
    q->excess = excess;
    q->inside = true;
    q->best[0] = *a, q->best[1] = *a2, q->best[2] = *a3, q->best[3] = *b;
  }
}

static void cutting_look_crossed(cutting *q, const nearby_site *a, const nearby_site *a2, const nearby_site *b,
                                 const nearby_site *b2) {
  double s = spot_turn(a, a2, b), s2 = spot_turn(a, a2, b2), t = spot_turn(b, b2, a), t2 = spot_turn(b, b2, a2);
  if (!(s * s2 < 0 && t * t2 < 0)) return;
  double along = t / (t - t2), across = s / (s - s2);
  double excess = along * (1 - along) * spot_distance2(a, a2->at) - across * (1 - across) * spot_distance2(b, b2->at);
  if (!(excess > q->excess)) return;
  q->excess = excess;
  q->inside = false;
  q->best[0] = *a, q->best[1] = *a2, q->best[2] = *b, q->best[3] = *b2;
}

/* What number k of the others does with those before it. */
static void cutting_look(cutting *q, size_t k) {
  for (const nearby_site *a = q->end; a < q->end + q->ends; a++)
    for (const nearby_site *a2 = a + 1; a2 < q->end + q->ends; a2++) {
      cutting_look_inside(q, a, a2, &q->other[k]);
      for (size_t n = 0; n < k; n++) cutting_look_crossed(q, a, a2, &q->other[n], &q->other[k]);
    }
}

/* What the last of the ends does with all others. */
static void cutting_look_end(cutting *q) {
  const nearby_site *last = &q->end[q->ends - 1];
  for (const nearby_site *a = q->end; a < last; a++)
    for (size_t k = 0; k < q->others; k++)
      for (size_t n = 0; n < k; n++) cutting_look_crossed(q, a, last, &q->other[n], &q->other[k]);
}

/* The point of the ends that is farthest from c; a point of a disc is added. */
static nearby_site farthest_end(cutting *q, const double c[2]) {
  const double at[2] = {c[0] + q->origin[0], c[1] + q->origin[1]};
  const size_t end[2] = {q->i, q->j}, had = q->ends;
  nearby_site best = q->end[0];
  for (int e = 0; e < 2 && q->ends < ENDS; e++) {
    nearby_site *s = &q->end[q->ends];
    if (!(q->site[end[e]].disc[2] > 0)) continue;
    dyd_filter_disc_point(s->at, q->site[end[e]].disc, at, true);
    s->site = end[e];
    for (int x = 0; x < 2; x++) s->at[x] -= q->origin[x];
    if (q->ends == had || spot_distance2(s, c) > spot_distance2(&q->end[had], c)) q->end[had] = *s, q->ends = had + 1;
  }
  for (size_t k = 1; k < q->ends; k++)
    if (spot_distance2(&q->end[k], c) > spot_distance2(&best, c)) best = q->end[k];
  if (q->ends > had) cutting_look_end(q);
  return best;
}

/* The point of the others that is nearest to c; site = count: there is none. */
static nearby_site nearest_other(const cutting *q, const double c[2]) {
  nearby_site best = {{0, 0}, q->count};
  for (size_t k = 0; k < q->count; k++) {
    nearby_site s = {.site = k};
    if (k == q->i || k == q->j) continue;
    const double *d = q->site[k].disc, at[2] = {c[0] + q->origin[0], c[1] + q->origin[1]};
    if (d[2] > 0) dyd_filter_disc_point(s.at, d, at, false);
    for (int a = 0; a < 2; a++) {
      const double *side = &q->site[k].box[2 * a];
      s.at[a] = d[2] > 0 ? s.at[a] - q->origin[a] : fmin(fmax(c[a], side[0] - q->origin[a]), side[1] - q->origin[a]);
    }
    if (best.site == q->count || spot_distance2(&s, c) < spot_distance2(&best, c)) best = s;
  }
  return best;
}

/* Adds a half-plane to the search for a disc around c. Returns false if the disc exists, or if no half-plane excludes
 * it. */
static bool cutting_add(cutting *q, const double c[2]) {
  nearby_site a = farthest_end(q, c), b = nearest_other(q, c);
  double n[2] = {a.at[0] - b.at[0], a.at[1] - b.at[1]}, length = hypot(n[0], n[1]);
  if (b.site == q->count || !(spot_distance2(&a, c) >= spot_distance2(&b, c)) || !(length > 0)) return false;
  double d = -(n[0] * (a.at[0] + b.at[0]) + n[1] * (a.at[1] + b.at[1])) / 2;
  q->cut[q->others] = (dyd_cut){n[0] / length, n[1] / length, d / length};
  q->other[q->others] = b;
  cutting_look(q, q->others++);
  return true;
}

/* Around the middles of i and j, whose distance is *size. */
static void cutting_begin(cutting *q, double *size) {
  const double *a = q->site[q->i].box, *b = q->site[q->j].box;
  for (int x = 0; x < 2; x++)
    q->origin[x] = (a[2 * x] / 2 + a[2 * x + 1] / 2) / 2 + (b[2 * x] / 2 + b[2 * x + 1] / 2) / 2;
  *size = hypot(fmax(a[1], b[1]) - fmin(a[0], b[0]), fmax(a[3], b[3]) - fmin(a[2], b[2]));
  cutting_add_end(q, q->i);
  cutting_add_end(q, q->j);
}

/* Where the search begins: a little to one side and the other of the middle, as a point between both ends may be on the
 * very segment. */
static void cutting_start(double c[2], const cutting *q, int side) {
  const nearby_site *a = &q->end[0], *b = &q->end[q->ends - 1];
  c[0] = side * (b->at[1] - a->at[1]) / 16;
  c[1] = side * (a->at[0] - b->at[0]) / 16;
}

bool dyd_filter_find_cut(dyd_settle_cut *out, const dyd_settle_site *site, size_t count, size_t i, size_t j) {
  cutting q = {.site = site, .count = count, .i = i, .j = j};
  dyd_lp_result r = {.z = 1};
  double size, c[2];
  cutting_begin(&q, &size);
  for (int side = -1; side <= 1; side += 2) {
    cutting_start(c, &q, side);
    cutting_add(&q, c);
  }
  while (q.others < MOST && r.z > 0) {
    r = dyd_lp_centre(q.cut, q.others, 1e6 * size);
    c[0] = r.x;
    c[1] = r.y;
    if (r.z > 0 && !cutting_add(&q, c)) break;
  }
  for (int k = 0; k < 4; k++) {
    out->site[k] = q.best[k].site;
    for (int x = 0; x < 2; x++) out->at[k][x] = q.best[k].at[x] + q.origin[x];
  }
  out->inside = q.inside;
  return q.excess > 0;
}

/* First centres lie this often the distance of i and j off the middle, on both sides. From the best of them descents
 * begin: from all, when that matters, with more steps. */
static const double offset[] = {0, 0.125, 0.25, 0.5, 1, 2, 4, 16, 64, 4096};

/* Centres of circles that nearly are lines, in distances of i and j: farther ones do not help in doubles. */
static const double FARTHEST = 1e12;

enum { BEST = 20, GAPS = 32, STEPS = 40, MORE_STEPS = 150 };

/* A question: sites i and j among `count`. last: the site that left least space before, examined first. */
typedef struct joining {
  const dyd_settle_site *site;
  size_t count, i, j, last;
} joining;

typedef struct trial_centre {
  double at[2], room, step;
} trial_centre;

static double site_middle(const dyd_settle_site *s, int axis) {
  return s->box[2 * axis] / 2 + s->box[2 * axis + 1] / 2;
}

/* The point of site k that is as far from c as can be when that is wanted (of an end: as near). */
static void joining_spot(double out[2], const joining *q, size_t k, const double c[2]) {
  const dyd_settle_site *s = &q->site[k];
  bool end = k == q->i || k == q->j;
  if (s->disc[2] > 0) {
    dyd_filter_disc_point(out, s->disc, c, !end);
    return;
  }
  for (int a = 0; a < 2; a++) {
    const double *side = &s->box[2 * a];
    if (s->core[a] == end)
      out[a] = fmin(fmax(c[a], side[0]), side[1]);
    else
      out[a] = side[c[a] - side[0] < side[1] - c[a]];
  }
}

/* |a - c|^2 - |b - c|^2, for c far away, too. */
static double farther_by(const double a[2], const double b[2], const double c[2]) {
  return (a[0] - b[0]) * ((a[0] - c[0]) + (b[0] - c[0])) + (a[1] - b[1]) * ((a[1] - c[1]) + (b[1] - c[1]));
}

/* The room at c; at most `most` where it is no more than that. */
static double centre_room(joining *q, const double c[2], double most) {
  double end[2], other[2], least = HUGE_VAL;
  joining_spot(end, q, q->i, c);
  joining_spot(other, q, q->j, c);
  if (farther_by(other, end, c) > 0) end[0] = other[0], end[1] = other[1];
  const double inner = hypot(end[0] - c[0], end[1] - c[1]);
  const double enough = inner + most > 0 ? most * (2 * inner + most) : -square(inner);
  for (size_t n = 0; n <= q->count && least > enough; n++) {
    size_t k = n ? n - 1 : q->last;
    if (k == q->i || k == q->j || q->site[k].absent) continue;
    joining_spot(other, q, k, c);
    double more = farther_by(other, end, c);
    if (more < least) {
      least = more;
      q->last = k;
    }
  }
  return least < HUGE_VAL ? least / (inner + sqrt(fmax(square(inner) + least, 0))) : HUGE_VAL;
}

/* Moves c where there is more room. Room has ridges: the four ways are turned from step to step. */
static void centre_climb(trial_centre *c, joining *q, int steps) {
  double way[2] = {1, 0};
  for (int n = 0; n < steps; n++) {
    trial_centre best = *c;
    for (int w = 0; w < 4; w++) {
      const double next[2] = {c->at[0] + c->step * way[0], c->at[1] + c->step * way[1]}, turned = -way[1];
      double room = centre_room(q, next, best.room);
      if (room > best.room) best = (trial_centre){{next[0], next[1]}, room, c->step * 1.25};
      way[1] = way[0];
      way[0] = turned;
    }
    if (!(best.room > c->room)) best.step /= 2;
    *c = best;
    const double turned = 0.8 * way[0] - 0.6 * way[1];
    way[1] = 0.6 * way[0] + 0.8 * way[1];
    way[0] = turned;
  }
}

/* The best centres met, best first; middle and d: where i and j are, and how far apart. */
typedef struct centre_list {
  trial_centre best[BEST];
  double middle[2], d[2];
} centre_list;

static void centre_offer(centre_list *l, joining *q, const double at[2]) {
  double room = centre_room(q, at, l->best[BEST - 1].room);
  double far = hypot(at[0] - l->middle[0], at[1] - l->middle[1]) / 2, step = fmax(far, hypot(l->d[0], l->d[1]) / 8);
  size_t n = BEST;
  for (; n > 0 && room > l->best[n - 1].room; n--)
    if (n < BEST) l->best[n] = l->best[n - 1];
  if (n < BEST) l->best[n] = (trial_centre){{at[0], at[1]}, room, step};
}

/* Offers centres between i and j. */
static void centre_list_start(centre_list *l, joining *q) {
  const dyd_settle_site *a = &q->site[q->i], *b = &q->site[q->j];
  for (size_t n = 0; n < BEST; n++) l->best[n].room = -HUGE_VAL;
  for (int x = 0; x < 2; x++) {
    l->middle[x] = site_middle(a, x) / 2 + site_middle(b, x) / 2;
    l->d[x] = site_middle(b, x) - site_middle(a, x);
  }
  for (size_t n = 0; n < 2 * sizeof offset / sizeof *offset; n++) {
    double t = n % 2 ? -offset[n / 2] : offset[n / 2];
    const double at[2] = {l->middle[0] - t * l->d[1], l->middle[1] + t * l->d[0]};
    centre_offer(l, q, at);
  }
}

/* Returns true if the site has more than one choice. */
static bool site_is_wide(const dyd_settle_site *s) {
  return s->disc[2] > 0 || (s->core[0] && s->box[0] < s->box[1]) || (s->core[1] && s->box[2] < s->box[3]);
}

/* Number n of the corners and middles of the box; false: there is none. */
static bool site_spot(double out[2], const dyd_settle_site *s, int n) {
  for (int a = 0; a < 2; a++) {
    const int at = a ? n / 3 : n % 3;
    out[a] = s->core[a] && at != 1 ? s->box[2 * a + at / 2] : site_middle(s, a);
  }
  return n < (site_is_wide(s) ? 9 : 1);
}

/* Centres a + u / 2 + t n of circles through a and a + u, n being u turned to the left. */
typedef struct pencil {
  double a[2], u[2], n[2];
} pencil;

/* Site k is inside the circle, or has no corner outside it, from *lo to *hi: for each corner on one side of some t. */
static void pencil_blocked(double *lo, double *hi, const pencil *p, const dyd_settle_site *s) {
  *lo = -HUGE_VAL;
  *hi = HUGE_VAL;
  for (int k = 0; k < 4; k++) {
    const double v[2] = {s->box[k % 2] - p->a[0], s->box[2 + k / 2] - p->a[1]};
    double free = v[0] * (v[0] - p->u[0]) + v[1] * (v[1] - p->u[1]), slope = 2 * (p->n[0] * v[0] + p->n[1] * v[1]);
    if (slope > 0) *lo = fmax(*lo, free / slope);
    if (slope < 0) *hi = fmin(*hi, free / slope);
  }
}

/* *t goes up to where no site is in the way; *end is how far that goes. */
static void pencil_next_gap(double *t, double *end, const pencil *p, const joining *q) {
  for (bool moved = true; moved;) {
    *end = HUGE_VAL;
    moved = false;
    for (size_t k = 0; k < q->count; k++) {
      double lo, hi;
      if (k == q->i || k == q->j || q->site[k].absent) continue;
      pencil_blocked(&lo, &hi, p, &q->site[k]);
      if (lo > *t && lo < hi) *end = fmin(*end, lo);
      if (lo > *t || !(hi > *t)) continue;
      *t = hi;
      moved = true;
    }
  }
}

/* A place well between both; beyond FARTHEST there is none. */
static double gap_middle(double t, double end) {
  if (t <= -FARTHEST) return end < HUGE_VAL ? end - fmax(fabs(end), 1e6) : 0;
  return end < HUGE_VAL ? (t + end) / 2 : t + fmax(fabs(t), 1e6);
}

/* Offers the middles of the gaps where circles through a and b hold too little of all others. */
static void centre_offer_gaps(centre_list *l, joining *q, const double a[2], const double b[2]) {
  const pencil p = {{a[0], a[1]}, {b[0] - a[0], b[1] - a[1]}, {a[1] - b[1], b[0] - a[0]}};
  double t = -FARTHEST, end;
  for (int n = 0; n < GAPS && t < FARTHEST; n++, t = end) {
    pencil_next_gap(&t, &end, &p, q);
    double m = gap_middle(t, end);
    const double at[2] = {a[0] + p.u[0] / 2 + m * p.n[0], a[1] + p.u[1] / 2 + m * p.n[1]};
    if (t < FARTHEST) centre_offer(l, q, at);
  }
}

static trial_centre centre_find(joining *q, bool thorough) {
  centre_list l;
  centre_list_start(&l, q);
  const dyd_settle_site *i = &q->site[q->i], *j = &q->site[q->j];
  double a[2], b[2];
  for (int n = 0; thorough && site_spot(a, i, n); n++)
    for (int m = 0; site_spot(b, j, m); m++) centre_offer_gaps(&l, q, a, b);
  trial_centre best = l.best[0];
  for (size_t n = 0; n < (thorough ? BEST : 3); n++) {
    centre_climb(&l.best[n], q, thorough ? MORE_STEPS : STEPS);
    if (l.best[n].room > best.room) best = l.best[n];
  }
  return best;
}

bool dyd_filter_find_centre(double c[2], const dyd_settle_site *site, size_t count, size_t i, size_t j, bool thorough) {
  joining q = {site, count, i, j, i};
  trial_centre best = centre_find(&q, thorough);
  c[0] = best.at[0];
  c[1] = best.at[1];
  return best.room > 0 && isfinite(c[0]) && isfinite(c[1]);
}

void dyd_filter_lean(double c[2], const dyd_settle_site *site, size_t beside, size_t other, double more) {
  const double *a = site[beside].box, *b = site[other].box;
  const double from[2] = {fmin(fmax(c[0], b[0]), b[1]), fmin(fmax(c[1], b[2]), b[3])};
  const double v[2] = {c[0] - from[0], c[1] - from[1]}, w[2] = {from[0] - a[0], from[1] - a[2]};
  const double t = -(square(w[0]) + square(w[1])) / (2 * (w[0] * v[0] + w[1] * v[1])) * (1 - more);
  for (int x = 0; t > 0 && t < 1 && x < 2; x++) c[x] = from[x] + t * v[x];
}

/* ---- discs that stay ---- */

/* Along one axis: *mid, the middle of the core, and *half, a little less than half of it, as doubles; false where the
 * core is more than 2^-34 of it smaller than the side, or in doubles. */
static bool side_get_disc(double *mid, double *half, const dyd_interval *core, const dyd_interval *whole) {
  DYD_LOCAL_NUMBERS(mpq, lo, hi, from, to);
  dyd_interval_get_q(lo, hi, core);
  dyd_interval_get_q(from, to, whole);
  mpq_sub(to, to, from);
  mpq_add(from, lo, hi);
  mpq_sub(hi, hi, lo);
  mpq_sub(to, to, hi);
  mpq_mul_2exp(to, to, 34);
  *mid = mpq_get_d(from) / 2;
  *half = mpq_get_d(hi) / 2 * (1 - 0x1p-30);
  return mpq_cmp(to, hi) <= 0 && *half > 0x1p-500 && *half < 0x1p500 && fabs(*mid) <= 0x1p20 * *half;
}

dyd_status dyd_disc_get_core(double disc[3], const dyd_engine *e, uint32_t site) {
  bool core[2];
  double half = 0;
  DYD_LOCAL(dyd_rect, whole, r);
  disc[2] = 0;
  dyd_status st = dyd_sites_get(&whole, e->sites, site);
  if (st == DYD_OK) st = dyd_site_get_core(&r, core, e, site);
  if (st == DYD_OK && core[0] && core[1] && !dyd_rect_is_point(&r) &&
      side_get_disc(&disc[0], &disc[2], &r.x, &whole.x) && side_get_disc(&disc[1], &half, &r.y, &whole.y))
    disc[2] = half < disc[2] ? half : disc[2];
  else
    disc[2] = 0;
  return st;
}
