/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Deaths in doubles [FLT-TOL].
 *
 * Let u = 2^-53. A difference of coordinates has an error of at most u of itself, and slack where the low parts are
 * rounded. So each of m, n, along, jj is a sum of two products of factors with error u, each rounded, and the sum
 * rounded: (1 + u)^4 - 1 < 5 u of the sum of the sizes of the computed products; 6 u covers the rounding of the bound
 * itself. slack s adds at most 2 s times the sum of the four factors plus 4 s^2. Products that underflow are off by
 * less than TINY = 2^-900, and jj is at least 2^-400; overflow gives infinities or NaN, and every test is written so
 * that these are "not sure".
 *
 * The place s = d / (2 e) of a crossing: with computed d, e, s, |s - true| <= (ed + 2 |s| ee + 2 u |d|) / (2 (e - ee)).
 * D = (n_b m_a - n_a m_b) / e there, and w = D / (sqrt(r^2 + D) + r) has no cancellation beyond that of D: its relative
 * error is that of D, plus half the larger of those of r^2 and D, plus 5 u. Bounds are sums of a few terms, each with a
 * few roundings: the factor GENEROUS covers them.
 *
 * How low other lines are follows from distances to the centre. Let c = c(s) for the s computed, P any of the points, M
 * the larger of |c|^2 and |P - c|^2, R = ejj / jj >= 6 u + 4 slack / |J|. The vector P - c is off by less than 7.2 u
 * sqrt(M), as |J| / 2 and |s J| are at most |c|, and by 5 slack / |J| sqrt(M); its computed square by less than 4 R M.
 * With es |J| <= K |c|, K < 2^-12, the line at the true place is off from that at s by 2 |n| es <= 4 K M. So with M of
 * one that binds (the others being farther from c than i), a point with a computed square above (1 + 12 K + 12 R) times
 * its own is higher at the true place. */
#include "tolerance/dd_filter.h"
#include "tolerance/lines.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The crossing of two lines in double-doubles. Three levels deep (difference, product, sum, product, sum), errors stay
 * below DYD_DD_ROUND = 2^-98 of the sum of the sizes of all products; slack s of a difference counts s times the other
 * factors. Pairs too short for products that underflow are refused. */

#define U 0x1p-53

#define TINY DYD_DD_TINY

/* The height of the crossing of the lines of vertices a and b, within *relative of itself (not below 2^-30, or NaN: not
 * known), and its place s within es. */
static double filter_crossing(double *s, double *es, double *relative, const dyd_points_d *p, const dyd_lines_d *l,
                              uint32_t a, uint32_t b) {
  dyd_dd_bounded m[2], n[2], j[2];
  dyd_dd_vector(j, p, l->j, l->i);
  dyd_dd_line(&m[0], &n[0], p, a, l->i, l->j, j);
  dyd_dd_line(&m[1], &n[1], p, b, l->i, l->j, j);
  dyd_dd_bounded num = dyd_dd_plus(dyd_dd_times(n[1], m[0]), dyd_dd_times(n[0], m[1]), -1);
  dyd_dd_bounded d = dyd_dd_plus(m[1], m[0], -1), e = dyd_dd_plus(n[1], n[0], -1);
  double ee = e.e + 2 * U * fabs(e.h), ed = d.e + 2 * U * fabs(d.h);
  *relative = (num.e / fabs(num.h) + 2 * U + ee / (fabs(e.h) - ee) + 4 * U) * (1 + 0x1p-20);
  *s = d.h / (2 * e.h);
  *es = (ed + 2 * fabs(*s) * ee + 2 * U * fabs(d.h)) / (2 * (fabs(e.h) - ee)) * (1 + 0x1p-20);
  if (!(ee < 0x1p-30 * fabs(e.h) && *es <= DBL_MAX)) *relative = HUGE_VAL;
  return num.h / e.h;
}

#define GENEROUS (1 + 0x1p-20)

#define WIDTH 0x1.fep-42 /* half the relative width asked for, 2^-40, with room */

#define CLOSE 0x1p-42 /* of the height alone; else it is worked out in double-doubles */

enum { CLIMBS = 40, MOST_ROUNDS = 4 };

/* ---- lines ---- */

/* A difference of coordinates: the double parts exactly, then the low ones. */
static double axis_difference(double a, double b, double low) {
  double s = a - b, t = s - a;
  return fabs(s) <= DBL_MAX ? s + (((a - (s - t)) - (b + t)) + low) : s;
}

static inline dyd_xy lines_point_difference(const dyd_points_d *p, uint32_t a, uint32_t b) {
  dyd_xy d = {p->xy[a].x - p->xy[b].x, p->xy[a].y - p->xy[b].y};
  if (!p->low) return d;
  d.x = axis_difference(p->xy[a].x, p->xy[b].x, p->low[a].x - p->low[b].x);
  d.y = axis_difference(p->xy[a].y, p->xy[b].y, p->low[a].y - p->low[b].y);
  return d;
}

/* size: of the products; factors: sum of the sizes of the factors. */
static inline double product_error(double size, double factors, double slack) {
  return 6 * U * size + slack * (2 * factors + 4 * slack) + TINY;
}

/* Returns true if doubles hold the pair well. */
static inline bool pair_d(dyd_lines_d *l, dyd_xy j, double slack) {
  l->jx = j.x;
  l->jy = j.y;
  l->jj = j.x * j.x + j.y * j.y;
  l->ejj = product_error(l->jj, 2 * (fabs(j.x) + fabs(j.y)), slack);
  l->rjj = l->ejj / l->jj;
  return (l->jj > 0x1p-400) & (l->jj < 0x1p400) & (l->ejj < 0x1p-40 * l->jj);
}

bool dyd_filter_pair(dyd_lines_d *l, const dyd_points_d *p, uint32_t i, uint32_t j) {
  l->i = i;
  l->j = j;
  return pair_d(l, lines_point_difference(p, j, i), p->slack) && p->usable;
}

static inline void line_d(dyd_line_d *o, const dyd_lines_d *l, dyd_xy p, dyd_xy q, double slack) {
  double x = p.x * q.x, y = p.y * q.y, ax = p.x * l->jx, ay = p.y * l->jy, nx = p.y * l->jx, ny = p.x * l->jy;
  double sum = fabs(p.x) + fabs(p.y), far = sum + fabs(q.x) + fabs(q.y), near = sum + fabs(l->jx) + fabs(l->jy);
  o->px = p.x;
  o->py = p.y;
  o->qx = q.x;
  o->qy = q.y;
  o->m = x + y;
  o->n = nx - ny;
  o->along = ax + ay;
  o->em = product_error(fabs(x) + fabs(y), far, slack);
  o->en = product_error(fabs(nx) + fabs(ny), near, slack);
  o->ea = product_error(fabs(ax) + fabs(ay), near, slack);
}

void dyd_filter_line(dyd_line_d *o, const dyd_lines_d *l, const dyd_points_d *at, uint32_t vertex) {
  line_d(o, l, lines_point_difference(at, vertex, l->i), lines_point_difference(at, vertex, l->j), at->slack);
  o->vertex = vertex;
}

uint32_t dyd_filter_envelope(uint32_t *chain, double *corner, const dyd_line_d *line, uint32_t count) {
  uint32_t links = 0, next = 0;
  for (uint32_t k = 1; k < count; k++)
    if (line[k].n < line[next].n || (line[k].n == line[next].n && line[k].m < line[next].m)) next = k;
  do {
    const dyd_line_d *from = &line[chain[links++] = next];
    double *at = &corner[links];
    *at = HUGE_VAL;
    for (uint32_t k = 0; k < count; k++) {
      const dyd_line_d *o = &line[k];
      if (!(o->n > from->n)) continue;
      double s = (o->m - from->m) / (2 * (o->n - from->n));
      if (!(s < *at || (s == *at && o->n > line[next].n))) continue;
      *at = s;
      next = k;
    }
  } while (next != chain[links - 1]);
  return links;
}

/* ---- places ---- */

/* s, and the centre c(s) from p_i, cc = |c|^2. end: -1 or 1 for an end of the bisector. es, once known: a bound of the
 * error of s; es |J| is at most near |c|. */
typedef struct place_d {
  double s, x, y, cc, es, near;
  int end;
} place_d;

static inline void set_place(place_d *at, const dyd_lines_d *l, double s) {
  double x = l->jx / 2 - s * l->jy, y = l->jy / 2 + s * l->jx;
  *at = (place_d){.s = s, .x = x, .y = y, .cc = x * x + y * y};
}

static inline double nearness(double es, double s) {
  return es * 1.5 / (0.5 + fabs(s));
}

/* s = p / (2 q), off by ep, eq. Returns true if that place is well known. */
static inline bool bound_place(place_d *at, double p, double ep, double q, double eq) {
  double size = fabs(at->s);
  at->es = (ep + 2 * size * eq + 2 * U * fabs(p)) / (2 * (fabs(q) - eq)) * GENEROUS;
  at->near = nearness(at->es, at->s);
  return (at->near < 0x1p-12) & (fabs(q) > 2 * eq);
}

static inline double from_centre(const dyd_line_d *o, const place_d *at) {
  double x = o->px - at->x, y = o->py - at->y;
  return x * x + y * y;
}

/* The sign of g' |J| = a / |c - P| - s |J|^2 / r, a = s |J|^2 - n, is that of a |a| r^2 - s |s| |J|^4 |c - P|^2: this
 * over |J|^2, and what its errors are below. */
static inline double trend_d(double *doubt, const dyd_lines_d *l, const dyd_line_d *o, const place_d *at) {
  double s = at->s, size = fabs(s), a = s * l->jj - o->n, e = from_centre(o, at), quarter = 0.25 + s * s;
  double ea = at->es * l->jj + size * l->ejj + o->en + 4 * U * (size * l->jj + fabs(o->n));
  double far = l->jj * dyd_max(e, at->cc), x = a * fabs(a) * quarter, y = s * size * l->jj * e;
  *doubt = (quarter * (2 * fabs(a) + ea) * ea + far * (2 * size + at->es) * at->es +
            (fabs(x) + s * s * far) * (10 * at->near + 8 * l->rjj)) *
           GENEROUS;
  return x - y;
}

/* 1, -1; 0: not certain (or at a summit). At an end: of the computed numbers, checked by end_death. */
static int trend_sign(const dyd_lines_d *l, const dyd_line_d *o, const place_d *at) {
  double doubt, trend = trend_d(&doubt, l, o, at);
  if (at->end) return (o->n * o->n > l->jj * o->m ? 1 : -1) * at->end;
  return trend > doubt ? 1 : -trend > doubt ? -1 : 0;
}

/* Which way to go from where this line is lowest; 0: not certain. */
static int way_up(const dyd_lines_d *l, const dyd_line_d *low, const place_d *at, double distance) {
  bool high = at->end ? -at->end * low->n > 0 : distance > at->cc;
  return high ? trend_sign(l, low, at) : low->n > 0 ? -1 : 1;
}

/* Where the lines cross, if that is well known. */
static inline bool cross_d(place_d *at, const dyd_lines_d *l, const dyd_line_d *a, const dyd_line_d *b) {
  double d = b->m - a->m, e = b->n - a->n, ed = a->em + b->em + 2 * U * fabs(d);
  set_place(at, l, d / (2 * e));
  return bound_place(at, d, ed, e, a->en + b->en + 2 * U * fabs(e));
}

static bool summit_d(place_d *at, const dyd_lines_d *l, const dyd_line_d *o) {
  double q = dyd_max(-o->along, o->along - l->jj);
  set_place(at, l, -o->n / (2 * q));
  return bound_place(at, o->n, o->en, q, o->ea + l->ejj + 2 * U * fabs(q)) && q > 0;
}

/* Others than what binds are above if their squared distance from the centre is. */
static inline double top_of(const place_d *at, const dyd_lines_d *l, const dyd_line_d *a) {
  return dyd_max(from_centre(a, at), at->cc) * (1 + (12 * at->near + 12 * l->rjj));
}

/* ---- the way up ---- */

/* As in lines.c. one: whose summit or end it is. There are at most two lines at a time, and place for the next. */
typedef struct climb_d {
  const dyd_points_d *points;
  const dyd_lines_d *l;
  dyd_line_d line[3];
  const dyd_line_d *rising, *falling, *one; /* NULL: none */
  place_d at;
  enum { ANYWHERE, CROSSING, SUMMIT, END } kind;
} climb_d;

/* The line of a vertex, in a place that is free. */
static const dyd_line_d *climb_line(climb_d *c, uint32_t vertex) {
  dyd_line_d *o = c->line;
  while (o == c->rising || o == c->falling) o++;
  dyd_filter_line(o, c->l, c->points, vertex);
  return o;
}

/* Returns true if both bind where they cross, as far as trends go. up, down: of the two. */
static bool cross_both(int *up, int *down, climb_d *c) {
  if (!cross_d(&c->at, c->l, c->rising, c->falling)) return false;
  *up = trend_sign(c->l, c->rising, &c->at);
  *down = trend_sign(c->l, c->falling, &c->at);
  return *up && *down;
}

/* Where the lines of the apexes cross, on most edges; where all lie on one side, at the end beyond them. */
static void begin_d(climb_d *c) {
  const dyd_line_d *first = NULL, *second = NULL;
  int up, down;
  c->rising = c->falling = NULL;
  c->rising = first = climb_line(c, c->l->apex[0]);
  if (c->l->apex[1] != DYD_NONE) c->falling = second = climb_line(c, c->l->apex[1]);
  bool across = second && (first->n < 0 ? second->n > 0 : second->n < 0);
  if (across) {
    if (first->n > 0) c->rising = second, c->falling = first;
    c->kind = CROSSING;
    if (cross_both(&up, &down, c) && up > 0 && down < 0 && from_centre(c->rising, &c->at) > c->at.cc) return;
  }
  c->kind = ANYWHERE;
  c->rising = c->falling = NULL;
  set_place(&c->at, c->l, 0);
  if (!across) c->at.end = first->n > 0 ? -1 : 1;
}

/* As climb_next. false: not certain. */
static bool next_d(climb_d *c) {
  if (c->rising && c->falling) {
    int up, down;
    if (!cross_both(&up, &down, c)) return false;
    c->kind = up > 0 && down < 0 ? CROSSING : SUMMIT;
    if (c->kind == CROSSING) return true;
    c->one = up < 0 ? c->rising : c->falling;
    return summit_d(&c->at, c->l, c->one);
  }
  c->one = c->rising ? c->rising : c->falling;
  c->kind = SUMMIT;
  if (summit_d(&c->at, c->l, c->one)) return true;
  if (!(dyd_max(-c->one->along, c->one->along - c->l->jj) < -2 * (c->one->ea + c->l->ejj))) return false;
  c->kind = END;
  c->at.end = c->rising ? 1 : -1;
  return true;
}

/* *least becomes e and *best v where e is less and counts: without a branch, which would be taken at random. */
static inline void keep_less(double *least, uint32_t *best, double e, uint32_t v, bool counts) {
  uint64_t less = -(uint64_t)(counts & (e < *least)), old, new;
  memcpy(&old, least, sizeof old);
  memcpy(&new, &e, sizeof new);
  old ^= (old ^ new) & less;
  memcpy(least, &old, sizeof old);
  *best ^= (*best ^ v) & (uint32_t)less;
}

/* The point with the lowest line there, but i, j and two; its *distance from the centre squared, at an end how far out.
 * DYD_NONE: there is none. NaN does not count. */
static uint32_t lowest_d(double *distance, const climb_d *c, const uint32_t known[2]) {
  const dyd_lines_d *l = c->l;
  const dyd_points_d here = *c->points;
  const double cx = c->at.x, cy = c->at.y, end = -c->at.end;
  const uint32_t a = known[0], b = known[1];
  double least = HUGE_VAL;
  uint32_t best = DYD_NONE;
  for (int n = 0; n < 2; n++)
    for (uint32_t q = 0; q < l->rings[n]; q++) {
      uint32_t v = l->ring[n][q];
      dyd_xy p = lines_point_difference(&here, v, l->i);
      double x = p.x - cx, y = p.y - cy, e = end != 0 ? end * (p.y * l->jx - p.x * l->jy) : x * x + y * y;
      keep_less(&least, &best, e, v, (v != a) & (v != b) & (v != l->i) & (v != l->j));
    }
  *distance = least;
  return best;
}

/* To where no line lies below what binds. false: not certain. */
static bool climb_up(climb_d *c) {
  begin_d(c);
  for (int k = 0; k < CLIMBS; k++) {
    const dyd_line_d *a = c->kind == SUMMIT ? c->one : c->rising, *b = c->kind == SUMMIT ? c->one : c->falling;
    bool binds = !c->at.end && (c->kind == CROSSING || c->kind == SUMMIT);
    const uint32_t known[2] = {binds ? a->vertex : DYD_NONE, binds ? b->vertex : DYD_NONE};
    double distance, top = binds ? top_of(&c->at, c->l, a) : HUGE_VAL;
    uint32_t vertex = lowest_d(&distance, c, known);
    if (binds && !(distance <= top)) return from_centre(b, &c->at) <= top;
    if (vertex == DYD_NONE) return false;
    const dyd_line_d *low = climb_line(c, vertex);
    int up = way_up(c->l, low, &c->at, distance);
    if (c->at.end && up == c->at.end) {
      c->kind = END;
      c->one = low;
      return true;
    }
    if (!up) return false;
    *(up > 0 ? &c->rising : &c->falling) = low;
    if (!next_d(c)) return false;
  }
  return false;
}

/* ---- the value, and the proof ---- */

static bool give(dyd_death_d *out, double w, double relative) {
  double h = w / 2, e = relative * GENEROUS + 4 * U;
  out->lo = h * (1 - e);
  out->hi = h * (1 + e);
  return e < WIDTH && out->lo > 0 && out->hi <= DBL_MAX;
}

/* D at a crossing, r^2 there, and their relative errors. */
typedef struct height_d {
  double D, rD, B, rB;
} height_d;

static inline void set_height(height_d *h, const dyd_line_d *a, const dyd_line_d *b) {
  double e = b->n - a->n, ee = a->en + b->en + 2 * U * fabs(e), x = b->n * a->m, y = a->n * b->m, num = x - y;
  double error = (fabs(b->n) + b->en) * a->em + fabs(a->m) * b->en + (fabs(a->n) + a->en) * b->em + fabs(b->m) * a->en +
                 4 * U * (fabs(x) + fabs(y));
  h->rD = (error / fabs(num) + ee / (fabs(e) - ee) + 4 * U) * GENEROUS;
  h->D = num / e;
}

static inline void set_radius(height_d *h, const dyd_lines_d *l, double s, double es) {
  double quarter = 0.25 + s * s;
  h->B = l->jj * quarter;
  h->rB = (l->rjj + (2 * fabs(s) * es + es * es) / quarter + 6 * U) * GENEROUS;
}

static inline bool give_crossing(dyd_death_d *out, const height_d *h) {
  if (!(h->D > 0 && h->rD < 0x1p-30 && h->rB < 0x1p-30)) return false;
  return give(out, h->D / (sqrt(h->B + h->D) + sqrt(h->B)), h->rD + dyd_max(h->rB, h->rD) / 2 + 6 * U);
}

static bool crossing_death(dyd_death_d *out, double *radius2, climb_d *c) {
  uint32_t a = c->rising->vertex, b = c->falling->vertex;
  height_d h;
  set_height(&h, c->rising, c->falling);
  if (!(h.rD < CLOSE)) h.D = filter_crossing(&c->at.s, &c->at.es, &h.rD, c->points, c->l, a, b);
  set_radius(&h, c->l, c->at.s, c->at.es);
  *radius2 = (h.B + h.D) * (1 + 2 * (h.rB + h.rD));
  return give_crossing(out, &h);
}

static bool summit_death(dyd_death_d *out, double *radius2, const climb_d *c) {
  const dyd_line_d *o = c->one;
  const dyd_lines_d *l = c->l;
  double x = o->along < 0 ? o->px : o->qx, y = o->along < 0 ? o->py : o->qy, w2 = x * x + y * y;
  double ew2 = product_error(w2, 2 * (fabs(x) + fabs(y)), c->points->slack);
  double s = c->at.s, es = c->at.es, D = o->m - 2 * o->n * s, B = l->jj * (0.25 + s * s);
  double eD = o->em + 2 * fabs(s) * o->en + 2 * (fabs(o->n) + o->en) * es + 4 * U * (fabs(o->m) + 2 * fabs(o->n * s));
  double eB = B * 0x1p-30 + 2 * l->jj * (2 * fabs(s) + es) * es;
  *radius2 = (B + eB + D + eD) * GENEROUS;
  return give(out, sqrt(w2), ew2 / w2 + 4 * U);
}

/* At an end: of all lines the one whose |n| is least, and its n^2 > jj m. */
static bool end_death(dyd_death_d *out, double *radius2, const climb_d *c) {
  const dyd_lines_d *l = c->l;
  const dyd_line_d *o = c->one;
  double w = -c->at.end * o->n, n2 = o->n * o->n, jm = l->jj * o->m;
  double doubt =
      (2 * fabs(o->n) + o->en) * o->en + (l->jj + l->ejj) * o->em + l->ejj * fabs(o->m) + 4 * U * (n2 + fabs(jm));
  if (!(n2 - jm > doubt * GENEROUS && w > 0)) return false;
  for (int n = 0; n < 2; n++)
    for (uint32_t k = 0; k < l->rings[n]; k++) {
      uint32_t v = l->ring[n][k];
      dyd_line_d q;
      dyd_filter_line(&q, l, c->points, v);
      if (v == l->i || v == l->j || v == o->vertex || isnan(q.px)) continue;
      if (!(-c->at.end * q.n - w > (q.en + o->en) * GENEROUS + 2 * U * w)) return false;
    }
  *radius2 = HUGE_VAL;
  return give(out, w / sqrt(l->jj), o->en / w + l->rjj + 6 * U);
}

/* The centre, one axis: origin + (along + 2 s turn) / 2. */
static void centre_box_axis(double *lo, double *hi, double origin, double along, double turn, const place_d *at,
                            double slack) {
  double c = origin + (along / 2 + at->s * turn);
  double e = 8 * U * (fabs(origin) + fabs(along) + fabs(at->s * turn)) + 2 * slack + at->es * (fabs(turn) + slack) +
             fabs(at->s) * slack;
  *lo = c - e * GENEROUS - TINY;
  *hi = c + e * GENEROUS + TINY;
}

bool dyd_filter_death(dyd_death_d *out, double box[4], double *radius2, const dyd_points_d *p, dyd_lines_d *l) {
  climb_d c;
  c.points = p;
  c.l = l;
  if (l->apex[0] == DYD_NONE || !dyd_filter_pair(l, p, l->i, l->j) || !climb_up(&c)) return false;
  bool sure = c.kind == CROSSING ? crossing_death(out, radius2, &c)
              : c.kind == SUMMIT ? summit_death(out, radius2, &c)
                                 : end_death(out, radius2, &c);
  out->k = c.kind == CROSSING ? c.rising->vertex : c.one->vertex;
  out->l = c.kind == CROSSING ? c.falling->vertex : c.one->vertex;
  out->s = c.at.s;
  out->end = c.kind == END ? c.at.end : 0;
  if (!sure || !box || c.kind == END) return sure;
  double low[2] = {p->low ? fabs(p->low[l->i].x) : 0, p->low ? fabs(p->low[l->i].y) : 0};
  centre_box_axis(&box[0], &box[1], p->xy[l->i].x, l->jx, -l->jy, &c.at, p->slack + low[0]);
  centre_box_axis(&box[2], &box[3], p->xy[l->i].y, l->jy, l->jx, &c.at, p->slack + low[1]);
  return true;
}

/* ---- many at once ---- */

/* Straight code over columns, which compilers turn into that of vectors: as dyd_filter_death decides where two lines
 * cross, in the same numbers. */

void dyd_filter_batch(dyd_batch_d *c, const dyd_points_d *p) {
  for (int n = 0; n < 4; n++)
    for (uint32_t k = 0; k < c->count; k++) {
      c->x[n][k] = p->xy[c->of[n][k]].x;
      c->y[n][k] = p->xy[c->of[n][k]].y;
    }
  for (uint32_t k = 0; k < DYD_BATCH; k++) {
    dyd_lines_d l;
    dyd_line_d a, b;
    place_d at;
    height_d h;
    double doubt[2];
    double ix = c->x[0][k], iy = c->y[0][k], jx = c->x[1][k], jy = c->y[1][k];
    double ax = c->x[2][k], ay = c->y[2][k], bx = c->x[3][k], by = c->y[3][k];
    bool sure = pair_d(&l, (dyd_xy){jx - ix, jy - iy}, 0);
    line_d(&a, &l, (dyd_xy){ax - ix, ay - iy}, (dyd_xy){ax - jx, ay - jy}, 0);
    line_d(&b, &l, (dyd_xy){bx - ix, by - iy}, (dyd_xy){bx - jx, by - jy}, 0);
    sure &= cross_d(&at, &l, &a, &b);
    double up = trend_d(&doubt[0], &l, &a, &at), down = trend_d(&doubt[1], &l, &b, &at), top = top_of(&at, &l, &a);
    sure &= (up > doubt[0]) & (-down > doubt[1]) & (from_centre(&b, &at) <= top);
    set_height(&h, &a, &b);
    set_radius(&h, &l, at.s, at.es);
    c->s[k] = at.s, c->es[k] = at.es, c->cx[k] = at.x, c->cy[k] = at.y;
    c->D[k] = h.D, c->rD[k] = h.rD, c->B[k] = h.B, c->rB[k] = h.rB;
    c->top[k] = sure & (h.rD < CLOSE) & (h.D > 0) ? top : -1;
  }
}

/* The points given that are within the top: j and i, once each, since their squares are off by less than 4 R M, and
 * what binds, since it is measured by the same numbers; and others. How many. */
static uint32_t list_within(uint32_t *vertex, const dyd_batch_d *c, uint32_t k, const dyd_xy *xy,
                            const dyd_lines_d *l) {
  const double top = c->top[k], cx = c->cx[k], cy = c->cy[k], ix = c->x[0][k], iy = c->y[0][k];
  uint32_t within = 0;
  for (int n = 0; n < 2; n++) {
    const uint32_t *ring = l->ring[n], count = l->rings[n];
    for (uint32_t q = 0; q < count; q++) {
      uint32_t v = vertex[within] = ring[q];
      double x = xy[v].x - ix - cx, y = xy[v].y - iy - cy;
      within += x * x + y * y <= top;
    }
  }
  return within;
}

/* The others are above. *again: one is not, and comes to bind instead of one of the two. */
static bool binds_alone(bool *again, dyd_batch_d *c, uint32_t k, const dyd_points_d *p, dyd_lines_d *l) {
  uint32_t within[DYD_HUB + 1], count = list_within(within, c, k, p->xy, l), others = 0;
  const uint32_t known[2] = {c->of[2][k], c->of[3][k]};
  dyd_line_d o, low = {0};
  place_d at;
  double distance = HUGE_VAL;
  if (c->round[k] == 0 && count == 6) return true; /* i, j, and the apexes, which are neighbours of both */
  if (!dyd_filter_pair(l, p, l->i, l->j)) return false;
  for (uint32_t q = 0; q < count; q++) {
    uint32_t v = within[others] = within[q];
    others += (v != l->i) & (v != l->j) & (v != known[0]) & (v != known[1]);
  }
  if (!others) return true;
  set_place(&at, l, c->s[k]);
  at.es = c->es[k], at.near = nearness(at.es, at.s);
  for (uint32_t q = 0; q < others; q++) {
    dyd_filter_line(&o, l, p, within[q]);
    double e = from_centre(&o, &at);
    if (!(e < distance)) continue;
    low = o;
    distance = e;
  }
  int up = distance < HUGE_VAL && c->round[k]++ < MOST_ROUNDS ? way_up(l, &low, &at, distance) : 0;
  if (up) c->of[up > 0 ? 2 : 3][k] = low.vertex;
  *again = up;
  return false;
}

bool dyd_filter_batched(dyd_death_d *out, bool *again, dyd_batch_d *c, uint32_t k, const dyd_points_d *p,
                        dyd_lines_d *l) {
  *out = (dyd_death_d){.k = c->of[2][k], .l = c->of[3][k], .s = c->s[k]};
  *again = false;
  return c->top[k] > 0 && binds_alone(again, c, k, p, l) &&
         give_crossing(out, &(height_d){c->D[k], c->rD[k], c->B[k], c->rB[k]});
}
