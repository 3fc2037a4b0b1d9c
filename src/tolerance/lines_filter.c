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
 * few roundings: the factor GENEROUS covers them. */
#include "tolerance/lines_filter.h"
#include "tolerance/crossing_filter.h"

#include <float.h>
#include <math.h>

#define U 0x1p-53
#define TINY 0x1p-900
#define GENEROUS (1 + 0x1p-20)
#define WIDTH 0x1.fep-42 /* half the relative width asked for, 2^-40, with room */
#define CLOSE 0x1p-42    /* of the height alone; else it is worked out in double-doubles */
enum { CLIMBS = 40 };

/* ---- lines ---- */

/* A difference of coordinates: the double parts exactly, then the low ones. */
static double axis_difference(double a, double b, double low) {
  double s = a - b, t = s - a;
  return s + (((a - (s - t)) - (b + t)) + low);
}

static dyd_xy lines_point_difference(const dyd_points_d *p, uint32_t a, uint32_t b) {
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
  l->span = 0;
  l->i = i;
  l->j = j;
  l->count = 0;
  return p->usable && l->jj > 0x1p-400 && l->jj < 0x1p400 && l->ejj < 0x1p-40 * l->jj;
}

bool dyd_filter_add(dyd_lines_d *l, const dyd_points_d *at, const uint32_t *k, uint32_t count) {
  const dyd_points_d here = *at;
  double span = l->span;
  if (count > DYD_LINES_D - l->count) return false;
  for (uint32_t c = l->count; count; c++, k++, count--) {
    dyd_xy p = lines_point_difference(&here, *k, l->i), q = lines_point_difference(&here, *k, l->j);
    l->vertex[c] = *k;
    l->px[c] = p.x;
    l->py[c] = p.y;
    l->qx[c] = q.x;
    l->qy[c] = q.y;
    l->m[c] = p.x * q.x + p.y * q.y;
    l->n[c] = p.y * l->jx - p.x * l->jy;
    span = dyd_max(fabs(p.x) + fabs(p.y) + fabs(q.x) + fabs(q.y), span);
    l->count++;
  }
  l->span = span;
  return true;
}

dyd_line_d dyd_filter_line(const dyd_lines_d *l, const dyd_points_d *at, uint32_t k) {
  double px = l->px[k], py = l->py[k], qx = l->qx[k], qy = l->qy[k], ax = px * l->jx, ay = py * l->jy;
  double sum = fabs(px) + fabs(py), far = sum + fabs(qx) + fabs(qy), near = sum + fabs(l->jx) + fabs(l->jy);
  dyd_line_d o = {.m = l->m[k], .n = l->n[k], .along = ax + ay, .vertex = l->vertex[k]};
  o.em = product_error(fabs(px * qx) + fabs(py * qy), far, at->slack);
  o.en = product_error(fabs(py * l->jx) + fabs(px * l->jy), near, at->slack);
  o.ea = product_error(fabs(ax) + fabs(ay), near, at->slack);
  o.hm = o.em / (6 * U);
  o.hn = o.en / (6 * U);
  return o;
}

/* ---- places ---- */

/* s, with a bound of its error; end: -1 or 1 for an end of the bisector. */
typedef struct place_d {
  double s, es;
  int end;
} place_d;

static double height_d(const dyd_line_d *o, const place_d *at) {
  return at->end ? -at->end * o->n : o->m - 2 * o->n * at->s;
}

/* Of all lines, by number. */
static uint32_t lowest_d(const dyd_lines_d *l, const place_d *at) {
  uint32_t best = 0;
  double low = HUGE_VAL, slope = at->end ? -at->end : -2 * at->s;
  for (uint32_t k = 0; k < l->count; k++) {
    double h = at->end ? slope * l->n[k] : l->m[k] + slope * l->n[k];
    best = h < low ? k : best;
    low = h < low ? h : low;
  }
  return best;
}

static bool cross_d(place_d *at, const dyd_line_d *a, const dyd_line_d *b) {
  double d = b->m - a->m, e = b->n - a->n, ee = a->en + b->en + 2 * U * fabs(e);
  double ed = a->em + b->em + 2 * U * fabs(d);
  at->end = 0;
  at->s = d / (2 * e);
  at->es = (ed + 2 * fabs(at->s) * ee + 2 * U * fabs(d)) / (2 * (fabs(e) - ee)) * GENEROUS;
  return fabs(e) > 2 * ee && at->es <= DBL_MAX;
}

static bool summit_d(place_d *at, const dyd_lines_d *l, const dyd_line_d *o) {
  double q = dyd_max(-o->along, o->along - l->jj), eq = o->ea + l->ejj + 2 * U * fabs(q);
  at->end = 0;
  at->s = -o->n / (2 * q);
  at->es = (o->en + 2 * fabs(at->s) * eq + 2 * U * fabs(o->n)) / (2 * (q - eq)) * GENEROUS;
  return q > 2 * eq && at->es <= DBL_MAX;
}

/* The polynomial of dyd_line_trend, with s for p and 1/2 for q; *doubt bounds its error: each factor is off by at most
 * 6 u of what stands for its size, s by es. */
static double trend_polynomial(double *doubt, const dyd_lines_d *l, const dyd_line_d *o, const place_d *at) {
  double n = o->n, s = at->s, size = fabs(s) + 0.5, jj = l->jj + l->ejj / (6 * U);
  double sum = size * size * (o->hn * o->hn + jj * o->hm) + size * o->hn * jj + o->hn * o->hn;
  *doubt = 8 * (10 * U + at->es / size) * sum;
  return s * s * (n * n - l->jj * o->m) - s * n * l->jj / 2 + n * n / 4;
}

/* 1, -1; 0: not sure (or at a summit). At an end: of the computed numbers, checked by end_death. */
static int trend_d(const dyd_lines_d *l, const dyd_line_d *o, const place_d *at) {
  double doubt, a = at->s * l->jj - o->n;
  if (at->end) return (o->n * o->n > l->jj * o->m ? 1 : -1) * at->end;
  double ea = at->es * l->jj + fabs(at->s) * l->ejj + o->en + 4 * U * (fabs(at->s) * l->jj + fabs(o->n));
  if (at->s <= -at->es && a > ea) return 1;
  if (at->s >= at->es && a < -ea) return -1;
  double q = trend_polynomial(&doubt, l, o, at);
  bool both_up = at->s > at->es && a > ea, both_down = at->s < -at->es && a < -ea;
  if (!(fabs(q) > doubt) || (!both_up && !both_down)) return 0;
  return (q > 0) == both_up ? 1 : -1;
}

/* ---- the way up ---- */

/* As in summit.c. one: whose summit or end it is. */
typedef struct climb_d {
  const dyd_points_d *points;
  const dyd_lines_d *l;
  dyd_line_d rising, falling, one;
  bool has_rising, has_falling;
  place_d at;
  enum { ANYWHERE, CROSSING, SUMMIT, END } kind;
} climb_d;

/* From the last line of each side on: apexes come last, and often bind. */
static void begin_d(climb_d *c) {
  uint32_t left = DYD_NONE, right = DYD_NONE;
  for (uint32_t k = 0; k < c->l->count; k++) {
    left = c->l->n[k] > 0 ? k : left;
    right = c->l->n[k] < 0 ? k : right;
  }
  c->kind = ANYWHERE;
  c->has_rising = c->has_falling = false;
  c->at = (place_d){0, 0, 0};
  if (left != DYD_NONE && right != DYD_NONE) {
    c->rising = dyd_filter_line(c->l, c->points, right);
    c->falling = dyd_filter_line(c->l, c->points, left);
    if (!cross_d(&c->at, &c->rising, &c->falling) || !(height_d(&c->rising, &c->at) > 0)) return;
    bool between = trend_d(c->l, &c->rising, &c->at) > 0 && trend_d(c->l, &c->falling, &c->at) < 0;
    if (between) c->kind = CROSSING, c->has_rising = c->has_falling = true;
  } else if (left != right) {
    c->at.end = left != DYD_NONE ? -1 : 1;
  }
}

/* As climb_next. false: not sure. */
static bool next_d(climb_d *c) {
  if (c->has_rising && c->has_falling) {
    if (!cross_d(&c->at, &c->rising, &c->falling)) return false;
    int up = trend_d(c->l, &c->rising, &c->at), down = trend_d(c->l, &c->falling, &c->at);
    if (!up || !down) return false;
    c->kind = up > 0 && down < 0 ? CROSSING : SUMMIT;
    if (c->kind == CROSSING) return true;
    c->one = up < 0 ? c->rising : c->falling;
    return summit_d(&c->at, c->l, &c->one);
  }
  c->one = c->has_rising ? c->rising : c->falling;
  c->kind = SUMMIT;
  if (summit_d(&c->at, c->l, &c->one)) return true;
  if (!(dyd_max(-c->one.along, c->one.along - c->l->jj) < -2 * (c->one.ea + c->l->ejj))) return false;
  c->kind = END;
  c->at.end = c->has_rising ? 1 : -1;
  return true;
}

static int death_trend_d(const dyd_lines_d *l, const dyd_line_d *o, const place_d *at) {
  if (height_d(o, at) > 0) return trend_d(l, o, at);
  return o->n > 0 ? -1 : 1;
}

/* To where no line lies below what binds. false: not sure. */
static bool climb_up(climb_d *c) {
  begin_d(c);
  for (int k = 0; k < CLIMBS; k++) {
    uint32_t number = lowest_d(c->l, &c->at), vertex = c->l->vertex[number];
    if (c->kind == CROSSING && (vertex == c->rising.vertex || vertex == c->falling.vertex)) return true;
    if (c->kind == SUMMIT && vertex == c->one.vertex) return true;
    dyd_line_d low = dyd_filter_line(c->l, c->points, number);
    int up = death_trend_d(c->l, &low, &c->at);
    if (c->at.end && up == c->at.end) {
      c->kind = END;
      c->one = low;
      return true;
    }
    if (!up) return false;
    *(up > 0 ? &c->rising : &c->falling) = low;
    *(up > 0 ? &c->has_rising : &c->has_falling) = true;
    if (!next_d(c)) return false;
  }
  return false;
}

/* ---- the value, and the proof ---- */

/* Does every line but those that bind lie above D by more than all errors? One bound for all: |m| and the sizes of its
 * products are at most span^2, |n| and its own at most span (|jx| + |jy|). */
static bool others_above(const climb_d *c, uint32_t a, uint32_t b, double D, double eD) {
  const dyd_lines_d *l = c->l;
  double s = c->at.s, size = l->span + fabs(l->jx) + fabs(l->jy), slack = c->points->slack;
  double e = product_error(size * size, size, slack), top = D;
  double doubt = (e * (1 + 2 * fabs(s)) + 2 * (size * size + e) * c->at.es + 4 * U * size * size * (1 + 2 * fabs(s)));
  top += (doubt + eD) * GENEROUS + 2 * U * fabs(D);
  bool above = top >= D;
  for (uint32_t k = 0; k < l->count; k++)
    above = above & ((l->m[k] - 2 * l->n[k] * s > top) | (l->vertex[k] == a) | (l->vertex[k] == b));
  return above;
}

static bool give(dyd_death_d *out, double w, double relative, const climb_d *c) {
  double h = w / 2, e = relative * GENEROUS + 4 * U;
  out->lo = h * (1 - e);
  out->hi = h * (1 + e);
  out->k = c->kind == CROSSING ? c->rising.vertex : c->one.vertex;
  out->l = c->kind == CROSSING ? c->falling.vertex : c->one.vertex;
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
  double rD, D = crossing_height(&rD, &c->rising, &c->falling);
  if (!(rD < CLOSE))
    D = dyd_filter_crossing(&c->at.s, &c->at.es, &rD, c->points, l, c->rising.vertex, c->falling.vertex);
  double s = c->at.s, es = c->at.es, quarter = 0.25 + s * s, B = l->jj * quarter;
  double rB = (l->ejj / l->jj + (2 * fabs(s) * es + es * es) / quarter + 6 * U) * GENEROUS;
  if (!(D > 0 && rD < 0x1p-30 && rB < 0x1p-30)) return false;
  if (!others_above(c, c->rising.vertex, c->falling.vertex, D, rD * D)) return false;
  *radius2 = (B + D) * (1 + 2 * (rB + rD));
  return give(out, D / (sqrt(B + D) + sqrt(B)), rD + dyd_max(rB, rD) / 2 + 6 * U, c);
}

static bool summit_death(dyd_death_d *out, double *radius2, const climb_d *c) {
  const dyd_line_d *o = &c->one;
  const dyd_lines_d *l = c->l;
  uint32_t k = 0;
  while (l->vertex[k] != o->vertex) k++;
  double x = o->along < 0 ? l->px[k] : l->qx[k], y = o->along < 0 ? l->py[k] : l->qy[k], w2 = x * x + y * y;
  double ew2 = product_error(w2, 2 * (fabs(x) + fabs(y)), c->points->slack);
  double s = c->at.s, es = c->at.es, D = height_d(o, &c->at), B = l->jj * (0.25 + s * s);
  double eD = o->em + 2 * fabs(s) * o->en + 2 * (fabs(o->n) + o->en) * es + 4 * U * (fabs(o->m) + 2 * fabs(o->n * s));
  double eB = B * 0x1p-30 + 2 * l->jj * (2 * fabs(s) + es) * es;
  if (!others_above(c, o->vertex, o->vertex, D, eD)) return false;
  *radius2 = (B + eB + D + eD) * GENEROUS;
  return give(out, sqrt(w2), ew2 / w2 + 4 * U, c);
}

/* At an end: of all lines the one whose |n| is least, and its n^2 > jj m. */
static bool end_death(dyd_death_d *out, double *radius2, const climb_d *c) {
  const dyd_lines_d *l = c->l;
  const dyd_line_d *o = &c->one;
  double w = -c->at.end * o->n, n2 = o->n * o->n, jm = l->jj * o->m;
  double doubt =
      (2 * fabs(o->n) + o->en) * o->en + (l->jj + l->ejj) * o->em + l->ejj * fabs(o->m) + 4 * U * (n2 + fabs(jm));
  if (!(n2 - jm > doubt * GENEROUS && w > 0)) return false;
  for (uint32_t k = 0; k < l->count; k++) {
    if (l->vertex[k] == o->vertex) continue;
    dyd_line_d q = dyd_filter_line(l, c->points, k);
    if (!(-c->at.end * q.n - w > (q.en + o->en) * GENEROUS + 2 * U * w)) return false;
  }
  *radius2 = HUGE_VAL;
  return give(out, w / sqrt(l->jj), o->en / w + l->ejj / l->jj + 6 * U, c);
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
  if (!l->count || !climb_up(&c)) return false;
  bool sure = c.kind == CROSSING ? crossing_death(out, radius2, &c)
              : c.kind == SUMMIT ? summit_death(out, radius2, &c)
                                 : end_death(out, radius2, &c);
  if (!sure || !box || c.kind == END) return sure;
  double low[2] = {p->low ? fabs(p->low[l->i].x) : 0, p->low ? fabs(p->low[l->i].y) : 0};
  centre_box_axis(&box[0], &box[1], p->xy[l->i].x, l->jx, -l->jy, &c.at, p->slack + low[0]);
  centre_box_axis(&box[2], &box[3], p->xy[l->i].y, l->jy, l->jx, &c.at, p->slack + low[1]);
  return true;
}
