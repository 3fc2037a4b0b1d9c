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

/* The crossing of two lines in double-doubles. Three levels deep (difference, product, sum, product, sum), errors stay
 * below DYD_DD_ROUND = 2^-98 of the sum of the sizes of all products; slack s of a difference counts s times the other
 * factors. Pairs too short for products that underflow are refused. */

#define U 0x1p-53

#define TINY DYD_DD_TINY

/* The height of the crossing of the lines of vertices a and b, within *relative of itself (not below 2^-30, or NaN: not
 * known), and its place s within es. */
static double filter_crossing(double *s, double *es, double *relative, const dyd_points_d *p, const dyd_lines_d *l,
                              uint32_t a, uint32_t b) {
  dyd_dd m[2], n[2], j[2];
  dyd_dd_vector(j, p, l->j, l->i);
  dyd_dd_line(&m[0], &n[0], p, a, l->i, l->j, j);
  dyd_dd_line(&m[1], &n[1], p, b, l->i, l->j, j);
  dyd_dd num = dyd_dd_plus(dyd_dd_times(n[1], m[0]), dyd_dd_times(n[0], m[1]), -1);
  dyd_dd d = dyd_dd_plus(m[1], m[0], -1), e = dyd_dd_plus(n[1], n[0], -1);
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

enum { CLIMBS = 40 };

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
static double product_error(double size, double factors, double slack) {
  return 6 * U * size + slack * (2 * factors + 4 * slack) + TINY;
}

bool dyd_filter_pair(dyd_lines_d *l, const dyd_points_d *p, uint32_t i, uint32_t j) {
  dyd_xy d = lines_point_difference(p, j, i);
  l->jx = d.x;
  l->jy = d.y;
  l->jj = d.x * d.x + d.y * d.y;
  l->ejj = product_error(l->jj, 2 * (fabs(d.x) + fabs(d.y)), p->slack);
  l->rjj = l->ejj / l->jj;
  l->i = i;
  l->j = j;
  l->count = 0;
  return p->usable && l->jj > 0x1p-400 && l->jj < 0x1p400 && l->ejj < 0x1p-40 * l->jj;
}

bool dyd_filter_add(dyd_lines_d *l, const dyd_points_d *at, const uint32_t *ring, uint32_t size, uint32_t first,
                    uint32_t count) {
  const dyd_points_d here = *at;
  const uint32_t i = l->i;
  double *px = l->px + l->count, *py = l->py + l->count;
  uint32_t *vertex = l->vertex + l->count;
  if (count > DYD_LINES_D - l->count) return false;
  for (uint32_t q = 0, r = first; q < count; q++, r++) {
    r = r >= size ? r - size : r;
    vertex[q] = ring[r];
  }
  for (uint32_t q = 0; q < count; q++) {
    dyd_xy p = lines_point_difference(&here, vertex[q], i);
    px[q] = p.x;
    py[q] = p.y;
  }
  for (uint32_t q = count; q < count + DYD_LINES_BLOCK; q++) px[q] = py[q] = NAN;
  l->count += count;
  return true;
}

void dyd_filter_line(dyd_line_d *o, const dyd_lines_d *l, const dyd_points_d *at, uint32_t vertex) {
  dyd_xy p = lines_point_difference(at, vertex, l->i), q = lines_point_difference(at, vertex, l->j);
  double x = p.x * q.x, y = p.y * q.y, ax = p.x * l->jx, ay = p.y * l->jy, nx = p.y * l->jx, ny = p.x * l->jy;
  double sum = fabs(p.x) + fabs(p.y), far = sum + fabs(q.x) + fabs(q.y), near = sum + fabs(l->jx) + fabs(l->jy);
  o->px = p.x;
  o->py = p.y;
  o->qx = q.x;
  o->qy = q.y;
  o->m = x + y;
  o->n = nx - ny;
  o->along = ax + ay;
  o->em = product_error(fabs(x) + fabs(y), far, at->slack);
  o->en = product_error(fabs(nx) + fabs(ny), near, at->slack);
  o->ea = product_error(fabs(ax) + fabs(ay), near, at->slack);
  o->vertex = vertex;
}

/* ---- places ---- */

/* s, with a bound of its error, and the centre c(s) from p_i, cc = |c|^2; es |J| is at most near |c|. end: -1 or 1 for
 * an end of the bisector. */
typedef struct place_d {
  double s, es, near, x, y, cc;
  int end;
} place_d;

/* The place s, if it is well known. */
static bool place_on_bisector(place_d *at, const dyd_lines_d *l, double s, double es) {
  double x = l->jx / 2 - s * l->jy, y = l->jy / 2 + s * l->jx, near = es * 1.5 / (0.5 + fabs(s));
  *at = (place_d){s, es, near, x, y, x * x + y * y, 0};
  return near < 0x1p-12;
}

static double from_centre(const dyd_line_d *o, const place_d *at) {
  double x = o->px - at->x, y = o->py - at->y;
  return x * x + y * y;
}

static bool cross_d(place_d *at, const dyd_lines_d *l, const dyd_line_d *a, const dyd_line_d *b) {
  double d = b->m - a->m, e = b->n - a->n, ee = a->en + b->en + 2 * U * fabs(e);
  double ed = a->em + b->em + 2 * U * fabs(d), s = d / (2 * e);
  double es = (ed + 2 * fabs(s) * ee + 2 * U * fabs(d)) / (2 * (fabs(e) - ee)) * GENEROUS;
  return place_on_bisector(at, l, s, es) && fabs(e) > 2 * ee;
}

static bool summit_d(place_d *at, const dyd_lines_d *l, const dyd_line_d *o) {
  double q = dyd_max(-o->along, o->along - l->jj), eq = o->ea + l->ejj + 2 * U * fabs(q), s = -o->n / (2 * q);
  double es = (o->en + 2 * fabs(s) * eq + 2 * U * fabs(o->n)) / (2 * (q - eq)) * GENEROUS;
  return place_on_bisector(at, l, s, es) && q > 2 * eq;
}

/* 1, -1; 0: not certain (or at a summit). At an end: of the computed numbers, checked by end_death. Else the sign of
 * g' |J| = a / |c - P| - s |J|^2 / r, a = s |J|^2 - n: of a |a| r^2 - s |s| |J|^4 |c - P|^2, over |J|^2. */
static int trend_d(const dyd_lines_d *l, const dyd_line_d *o, const place_d *at) {
  double s = at->s, size = fabs(s), a = s * l->jj - o->n;
  if (at->end) return (o->n * o->n > l->jj * o->m ? 1 : -1) * at->end;
  double ea = at->es * l->jj + size * l->ejj + o->en + 4 * U * (size * l->jj + fabs(o->n));
  double e = from_centre(o, at), far = l->jj * dyd_max(e, at->cc), quarter = 0.25 + s * s;
  double x = a * fabs(a) * quarter, y = s * size * l->jj * e;
  double doubt = quarter * (2 * fabs(a) + ea) * ea + far * (2 * size + at->es) * at->es +
                 (fabs(x) + s * s * far) * (10 * at->near + 8 * l->rjj);
  return x - y > doubt * GENEROUS ? 1 : y - x > doubt * GENEROUS ? -1 : 0;
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
  uint32_t known[2]; /* the vertices that bind so far */
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
  *up = trend_d(c->l, c->rising, &c->at);
  *down = trend_d(c->l, c->falling, &c->at);
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
  place_on_bisector(&c->at, c->l, 0, 0);
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

/* The points that may be as near to the centre as the binding ones, if any: all whose squared distance is at most the
 * top; at an end, how far out they are. NaN does not count. */
typedef struct near_d {
  double e[DYD_LINES_D], top;
  uint32_t number[DYD_LINES_D], count;
} near_d;

static void measure_d(near_d *o, const climb_d *c) {
  const dyd_lines_d *l = c->l;
  const double cx = c->at.x, cy = c->at.y, end = -c->at.end, top = o->top;
  for (uint32_t k = 0; k < l->count; k += DYD_LINES_BLOCK)
    for (uint32_t q = k; q < k + DYD_LINES_BLOCK; q++) {
      double x = l->px[q] - cx, y = l->py[q] - cy;
      o->e[q] = x * x + y * y;
    }
  for (uint32_t k = 0; end != 0 && k < l->count; k++) o->e[k] = end * (l->py[k] * l->jx - l->px[k] * l->jy);
  o->count = 0;
  for (uint32_t k = 0; k < l->count; k++) {
    o->number[o->count] = k;
    o->count += o->e[k] <= top;
  }
}

/* The point with the lowest line there, except binding ones. DYD_NONE: none. */
static uint32_t lowest_d(double *distance, const climb_d *c, const near_d *near) {
  uint32_t best = DYD_NONE;
  *distance = HUGE_VAL;
  for (uint32_t k = 0; k < near->count; k++) {
    uint32_t vertex = c->l->vertex[near->number[k]];
    double e = near->e[near->number[k]];
    if (!(e < *distance) || vertex == c->known[0] || vertex == c->known[1]) continue;
    best = vertex;
    *distance = e;
  }
  return best;
}

/* The lowest of the points that may be as near as the binding ones. *alone: certainly none is. */
static uint32_t beside_binding(bool *alone, double *distance, climb_d *c) {
  const dyd_line_d *a = c->kind == SUMMIT ? c->one : c->rising, *b = c->kind == SUMMIT ? c->one : c->falling;
  bool binds = !c->at.end && (c->kind == CROSSING || c->kind == SUMMIT);
  near_d near;
  c->known[0] = binds ? a->vertex : DYD_NONE;
  c->known[1] = binds ? b->vertex : DYD_NONE;
  near.top = HUGE_VAL;
  if (binds) near.top = dyd_max(from_centre(a, &c->at), c->at.cc) * (1 + (12 * c->at.near + 12 * c->l->rjj));
  measure_d(&near, c);
  uint32_t lowest = lowest_d(distance, c, &near);
  *alone = binds && lowest == DYD_NONE && from_centre(b, &c->at) <= near.top;
  return lowest;
}

/* To where no line lies below what binds. false: not certain. */
static bool climb_up(climb_d *c) {
  begin_d(c);
  for (int k = 0; k < CLIMBS; k++) {
    double distance;
    bool alone;
    uint32_t vertex = beside_binding(&alone, &distance, c);
    if (alone) return true;
    if (vertex == DYD_NONE) return false;
    const dyd_line_d *low = climb_line(c, vertex);
    bool high = c->at.end ? -c->at.end * low->n > 0 : distance > c->at.cc;
    int up = high ? trend_d(c->l, low, &c->at) : low->n > 0 ? -1 : 1;
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

static bool give(dyd_death_d *out, double w, double relative, const climb_d *c) {
  double h = w / 2, e = relative * GENEROUS + 4 * U;
  out->lo = h * (1 - e);
  out->hi = h * (1 + e);
  out->k = c->kind == CROSSING ? c->rising->vertex : c->one->vertex;
  out->l = c->kind == CROSSING ? c->falling->vertex : c->one->vertex;
  out->s = c->at.s;
  out->end = c->kind == END ? c->at.end : 0;
  return e < WIDTH && out->lo > 0 && out->hi <= DBL_MAX;
}

/* D and its relative error at the crossing. */
static double crossing_height(double *relative, const dyd_line_d *a, const dyd_line_d *b) {
  double e = b->n - a->n, ee = a->en + b->en + 2 * U * fabs(e), x = b->n * a->m, y = a->n * b->m, num = x - y;
  double error = (fabs(b->n) + b->en) * a->em + fabs(a->m) * b->en + (fabs(a->n) + a->en) * b->em + fabs(b->m) * a->en +
                 4 * U * (fabs(x) + fabs(y));
  *relative = (error / fabs(num) + ee / (fabs(e) - ee) + 4 * U) * GENEROUS;
  return num / e;
}

static bool crossing_death(dyd_death_d *out, double *radius2, climb_d *c) {
  const dyd_lines_d *l = c->l;
  double rD, D = crossing_height(&rD, c->rising, c->falling);
  if (!(rD < CLOSE)) D = filter_crossing(&c->at.s, &c->at.es, &rD, c->points, l, c->rising->vertex, c->falling->vertex);
  double s = c->at.s, es = c->at.es, quarter = 0.25 + s * s, B = l->jj * quarter;
  double rB = (l->rjj + (2 * fabs(s) * es + es * es) / quarter + 6 * U) * GENEROUS;
  if (!(D > 0 && rD < 0x1p-30 && rB < 0x1p-30)) return false;
  *radius2 = (B + D) * (1 + 2 * (rB + rD));
  return give(out, D / (sqrt(B + D) + sqrt(B)), rD + dyd_max(rB, rD) / 2 + 6 * U, c);
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
  return give(out, sqrt(w2), ew2 / w2 + 4 * U, c);
}

/* At an end: of all lines the one whose |n| is least, and its n^2 > jj m. */
static bool end_death(dyd_death_d *out, double *radius2, const climb_d *c) {
  const dyd_lines_d *l = c->l;
  const dyd_line_d *o = c->one;
  double w = -c->at.end * o->n, n2 = o->n * o->n, jm = l->jj * o->m;
  double doubt =
      (2 * fabs(o->n) + o->en) * o->en + (l->jj + l->ejj) * o->em + l->ejj * fabs(o->m) + 4 * U * (n2 + fabs(jm));
  if (!(n2 - jm > doubt * GENEROUS && w > 0)) return false;
  for (uint32_t k = 0; k < l->count; k++) {
    dyd_line_d q;
    if (l->vertex[k] == o->vertex || isnan(l->px[k])) continue;
    dyd_filter_line(&q, l, c->points, l->vertex[k]);
    if (!(-c->at.end * q.n - w > (q.en + o->en) * GENEROUS + 2 * U * w)) return false;
  }
  *radius2 = HUGE_VAL;
  return give(out, w / sqrt(l->jj), o->en / w + l->rjj + 6 * U, c);
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

bool dyd_filter_death(dyd_death_d *out, double box[4], double *radius2, const dyd_points_d *p, const dyd_lines_d *l) {
  climb_d c;
  c.points = p;
  c.l = l;
  if (l->apex[0] == DYD_NONE || !climb_up(&c)) return false;
  bool sure = c.kind == CROSSING ? crossing_death(out, radius2, &c)
              : c.kind == SUMMIT ? summit_death(out, radius2, &c)
                                 : end_death(out, radius2, &c);
  if (!sure || !box || c.kind == END) return sure;
  double low[2] = {p->low ? fabs(p->low[l->i].x) : 0, p->low ? fabs(p->low[l->i].y) : 0};
  centre_box_axis(&box[0], &box[1], p->xy[l->i].x, l->jx, -l->jy, &c.at, p->slack + low[0]);
  centre_box_axis(&box[2], &box[3], p->xy[l->i].y, l->jy, l->jx, &c.at, p->slack + low[1]);
  return true;
}
