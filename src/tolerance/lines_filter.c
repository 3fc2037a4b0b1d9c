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

#include <float.h>
#include <math.h>

#if FLT_EVAL_METHOD != 0
#error "the error bounds of this file need doubles that are rounded to double after each operation"
#endif

#define U 0x1p-53
#define TINY 0x1p-900
#define GENEROUS (1 + 0x1p-20)
#define WIDTH 0x1p-42 /* half the relative width asked for, with room */
enum { CLIMBS = 40 };

/* ---- lines ---- */

/* A difference of coordinates: the double parts exactly, then the low ones. */
static double axis_difference(double a, double b, double low) {
  double s = a - b, t = s - a;
  return s + (((a - (s - t)) - (b + t)) + low);
}

static dyd_xy point_difference(const dyd_points_d *p, uint32_t a, uint32_t b) {
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
  dyd_xy d = point_difference(p, j, i);
  l->jx = d.x;
  l->jy = d.y;
  l->jj = d.x * d.x + d.y * d.y;
  l->ejj = product_error(l->jj, 2 * (fabs(d.x) + fabs(d.y)), p->slack);
  l->i = i;
  l->j = j;
  l->count = 0;
  return p->usable && l->jj > 0x1p-400 && l->jj < 0x1p400 && l->ejj < 0x1p-40 * l->jj;
}

bool dyd_filter_add(dyd_lines_d *l, const dyd_points_d *at, uint32_t k) {
  if (l->count == DYD_LINES_D) return false;
  dyd_line_d *o = &l->item[l->count++];
  dyd_xy p = point_difference(at, k, l->i), q = point_difference(at, k, l->j);
  double mx = p.x * q.x, my = p.y * q.y, nx = p.y * l->jx, ny = p.x * l->jy, ax = p.x * l->jx, ay = p.y * l->jy;
  double sum = fabs(p.x) + fabs(p.y), far = sum + fabs(q.x) + fabs(q.y), near = sum + fabs(l->jx) + fabs(l->jy);
  o->vertex = k;
  o->m = mx + my;
  o->n = nx - ny;
  o->along = ax + ay;
  o->hm = fabs(mx) + fabs(my);
  o->hn = fabs(nx) + fabs(ny);
  o->em = product_error(o->hm, far, at->slack);
  o->en = product_error(o->hn, near, at->slack);
  o->ea = product_error(fabs(ax) + fabs(ay), near, at->slack);
  o->p2 = p.x * p.x + p.y * p.y;
  o->q2 = q.x * q.x + q.y * q.y;
  return true;
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

static uint32_t lowest_d(const dyd_lines_d *l, const place_d *at) {
  uint32_t best = 0;
  double low = height_d(&l->item[0], at);
  for (uint32_t k = 1; k < l->count; k++) {
    double h = height_d(&l->item[k], at);
    if (h < low) low = h, best = k;
  }
  return best;
}

/* e bounds |at - s|. */
static double height_error(const dyd_line_d *o, double s, double es) {
  return o->em + 2 * fabs(s) * o->en + 2 * (fabs(o->n) + o->en) * es + 4 * U * (fabs(o->m) + 2 * fabs(o->n * s));
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
  double q = fmax(-o->along, o->along - l->jj), eq = o->ea + l->ejj + 2 * U * fabs(q);
  at->end = 0;
  at->s = -o->n / (2 * q);
  at->es = (o->en + 2 * fabs(at->s) * eq + 2 * U * fabs(o->n)) / (2 * (q - eq)) * GENEROUS;
  return q > 2 * eq && at->es <= DBL_MAX;
}

/* The polynomial of dyd_line_trend over jj^2, with s for p and 1/2 for q; *doubt bounds its error. */
static double trend_polynomial(double *doubt, const dyd_lines_d *l, const dyd_line_d *o, const place_d *at) {
  double n = o->n / l->jj, m = o->m / l->jj, hn = (o->hn + o->en) / l->jj, hm = (o->hm + o->em) / l->jj;
  double s = at->s, size = fabs(s) + 0.5;
  double e = fmax(fmax(o->en / o->hn, o->em / o->hm), fmax(at->es / size, l->ejj / l->jj));
  *doubt = 8 * (e + 4 * U) * (size * size * (hn * hn + hm) + size * hn + hn * hn);
  return s * s * (n * n - m) - s * n / 2 + n * n / 4;
}

/* 1, -1; 0: not sure (or at a summit). At an end: of the computed numbers, checked by end_is_sure. */
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

typedef struct climb_d {
  const dyd_line_d *rising, *falling;
  place_d at;
  enum { ANYWHERE, CROSSING, SUMMIT, END } kind;
  const dyd_line_d *one; /* whose summit or end it is */
} climb_d;

static void begin_d(climb_d *c, const dyd_lines_d *l) {
  const dyd_line_d *left = NULL, *right = NULL;
  for (uint32_t k = 0; k < l->count; k++) {
    if (l->item[k].n > 0 && (!left || l->item[k].p2 < left->p2)) left = &l->item[k];
    if (l->item[k].n < 0 && (!right || l->item[k].p2 < right->p2)) right = &l->item[k];
  }
  *c = (climb_d){.kind = ANYWHERE};
  if (left && right)
    cross_d(&c->at, left, right);
  else if (left || right)
    c->at.end = left ? -1 : 1;
}

/* As climb_next. false: not sure. */
static bool next_d(climb_d *c, const dyd_lines_d *l) {
  if (c->rising && c->falling) {
    if (!cross_d(&c->at, c->rising, c->falling)) return false;
    int up = trend_d(l, c->rising, &c->at), down = trend_d(l, c->falling, &c->at);
    if (!up || !down) return false;
    c->kind = up > 0 && down < 0 ? CROSSING : SUMMIT;
    c->one = up < 0 ? c->rising : c->falling;
    return c->kind == CROSSING || summit_d(&c->at, l, c->one);
  }
  c->one = c->rising ? c->rising : c->falling;
  c->kind = SUMMIT;
  if (summit_d(&c->at, l, c->one)) return true;
  if (fmax(-c->one->along, c->one->along - l->jj) > -2 * (c->one->ea + l->ejj)) return false;
  c->kind = END;
  c->at.end = c->rising ? 1 : -1;
  return true;
}

static int death_trend_d(const dyd_lines_d *l, const dyd_line_d *o, const place_d *at) {
  if (height_d(o, at) > 0) return trend_d(l, o, at);
  return o->n > 0 ? -1 : 1;
}

/* To where no line lies below what binds. false: not sure. */
static bool climb_up(climb_d *c, const dyd_lines_d *l) {
  begin_d(c, l);
  for (int k = 0; k < CLIMBS; k++) {
    const dyd_line_d *low = &l->item[lowest_d(l, &c->at)];
    if (c->kind == CROSSING && (low->vertex == c->rising->vertex || low->vertex == c->falling->vertex)) return true;
    if (c->kind == SUMMIT && low->vertex == c->one->vertex) return true;
    int up = death_trend_d(l, low, &c->at);
    if (c->at.end && up == c->at.end) {
      c->kind = END;
      c->one = low;
      return true;
    }
    if (!up) return false;
    *(up > 0 ? &c->rising : &c->falling) = low;
    if (!next_d(c, l)) return false;
  }
  return false;
}

/* ---- the value, and the proof ---- */

/* Does every line but those that bind lie above D by more than all errors? */
static bool others_above(const dyd_lines_d *l, const climb_d *c, uint32_t a, uint32_t b, double D, double eD) {
  for (uint32_t k = 0; k < l->count; k++) {
    const dyd_line_d *o = &l->item[k];
    if (o->vertex == a || o->vertex == b) continue;
    if (!(height_d(o, &c->at) - D > (height_error(o, c->at.s, c->at.es) + eD) * GENEROUS)) return false;
  }
  return true;
}

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

static bool crossing_death(dyd_death_d *out, double *radius2, const dyd_lines_d *l, const climb_d *c) {
  const dyd_line_d *a = c->rising, *b = c->falling;
  double s = c->at.s, es = c->at.es, e = b->n - a->n, ee = a->en + b->en + 2 * U * fabs(e);
  double x = b->n * a->m, y = a->n * b->m, num = x - y;
  double enum_ = (fabs(b->n) + b->en) * a->em + fabs(a->m) * b->en + (fabs(a->n) + a->en) * b->em + fabs(b->m) * a->en +
                 4 * U * (fabs(x) + fabs(y));
  double D = num / e, rD = (enum_ / num + ee / (e - ee) + 4 * U) * GENEROUS;
  double quarter = 0.25 + s * s, B = l->jj * quarter;
  double rB = (l->ejj / l->jj + (2 * fabs(s) * es + es * es) / quarter + 6 * U) * GENEROUS;
  if (!(num > 0 && e > 0 && rD < 0x1p-30 && rB < 0x1p-30)) return false;
  if (!others_above(l, c, a->vertex, b->vertex, D, rD * D)) return false;
  *radius2 = (B + D) * (1 + 2 * (rB + rD));
  return give(out, D / (sqrt(B + D) + sqrt(B)), rD + fmax(rB, rD) / 2 + 6 * U, c);
}

static bool summit_death(dyd_death_d *out, double *radius2, const dyd_points_d *p, const dyd_lines_d *l,
                         const climb_d *c) {
  const dyd_line_d *o = c->one;
  double s = c->at.s, w2 = o->along < 0 ? o->p2 : o->q2;
  double ew2 = product_error(w2, 4 * sqrt(w2), p->slack);
  double D = height_d(o, &c->at), eD = height_error(o, s, c->at.es), B = l->jj * (0.25 + s * s);
  double eB = B * 0x1p-30 + 2 * l->jj * (2 * fabs(s) + c->at.es) * c->at.es;
  if (!others_above(l, c, o->vertex, o->vertex, D, eD)) return false;
  *radius2 = (B + eB + D + eD) * GENEROUS;
  return give(out, sqrt(w2), ew2 / w2 + 4 * U, c);
}

/* At an end: of all lines the one whose |n| is least, and its n^2 > jj m. */
static bool end_death(dyd_death_d *out, double *radius2, const dyd_lines_d *l, const climb_d *c) {
  const dyd_line_d *o = c->one;
  double w = -c->at.end * o->n, n2 = o->n * o->n, jm = l->jj * o->m;
  double doubt = (2 * fabs(o->n) + o->en) * o->en + (l->jj + l->ejj) * o->em + l->ejj * fabs(o->m) +
                 4 * U * (n2 + fabs(jm));
  if (!(n2 - jm > doubt * GENEROUS && w > 0)) return false;
  for (uint32_t k = 0; k < l->count; k++) {
    const dyd_line_d *q = &l->item[k];
    if (q->vertex != o->vertex && !(-c->at.end * q->n - w > (q->en + o->en) * GENEROUS + 2 * U * w)) return false;
  }
  *radius2 = HUGE_VAL;
  return give(out, w / sqrt(l->jj), o->en / w + l->ejj / l->jj + 6 * U, c);
}

/* The centre, one axis: origin + (along + 2 s turn) / 2. */
static void centre_box_axis(double *lo, double *hi, double origin, double along, double turn, const place_d *at,
                            double slack) {
  double c = origin + (along / 2 + at->s * turn);
  double e = 8 * U * (fabs(origin) + fabs(along) + fabs(at->s * turn)) + 2 * slack +
             at->es * (fabs(turn) + slack) + fabs(at->s) * slack;
  *lo = c - e * GENEROUS - TINY;
  *hi = c + e * GENEROUS + TINY;
}

bool dyd_filter_death(dyd_death_d *out, double box[4], double *radius2, const dyd_points_d *p, const dyd_lines_d *l) {
  climb_d c;
  if (!l->count || !climb_up(&c, l)) return false;
  bool sure = c.kind == CROSSING ? crossing_death(out, radius2, l, &c)
              : c.kind == SUMMIT ? summit_death(out, radius2, p, l, &c)
                                 : end_death(out, radius2, l, &c);
  if (!sure || !box || c.kind == END) return sure;
  double low[2] = {p->low ? fabs(p->low[l->i].x) : 0, p->low ? fabs(p->low[l->i].y) : 0};
  centre_box_axis(&box[0], &box[1], p->xy[l->i].x, l->jx, -l->jy, &c.at, p->slack + low[0]);
  centre_box_axis(&box[2], &box[3], p->xy[l->i].y, l->jy, l->jx, &c.at, p->slack + low[1]);
  return true;
}
