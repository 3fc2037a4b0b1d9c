/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Caps and their ends in doubles.
 *
 * Rationals become doubles by mpq_get_d, within 2^-52 of themselves unless subnormal; a sum or product is off by 2^-53
 * of itself. So a disc seen from i is off by less than 2^-50 of the sizes of both (`off`, the sum of its errors), n by
 * less than 2 size off + 2^-50 size^2, w and tau by the errors of the factors of their products, c = |w|^2 - tau^2 like
 * n. An end u = (tau w + turn s w') / ww, s = sqrt(c), has length 1; s is off by at most off_c / s, the numerators by
 * less than 3 size off + size off_c / s + 2^-50 size^2 with the size of w and tau, ww like n. Bounds are wider than
 * their derivation by a factor of MORE, which covers their own rounding. Squares of plain numbers do not
 * overflow, and results that underflow there are below all bounds. */
#include "tolerance/discs.h"

#include <math.h>

#define MORE 1.01
#define LAST 0x1p-50

/* Returns true if x is a normal number that stays one when squared. */
static bool is_plain(double x) {
  return fabs(x) > 0x1p-400 && fabs(x) < 0x1p400;
}

static double square_off(double size, double off) {
  return MORE * (2 * size * off + LAST * size * size);
}

static dyd_relative relative_disc(const double i[3], const dyd_disc *k, int sign) {
  const double x = mpq_get_d(k->x), y = mpq_get_d(k->y), r = mpq_get_d(k->r);
  dyd_relative o = {.x = x - i[0], .y = y - i[1], .r = r + sign * i[2]};
  o.off = LAST * (fabs(x) + fabs(y) + r + fabs(i[0]) + fabs(i[1]) + i[2]);
  o.size = fabs(o.x) + fabs(o.y) + fabs(o.r) + o.off;
  o.n = o.x * o.x + o.y * o.y - o.r * o.r;
  o.off_n = is_plain(o.size) ? square_off(o.size, o.off) : HUGE_VAL;
  return o;
}

static double cap_extent(const dyd_cap *k) {
  return fabs(k->w[0]) + fabs(k->w[1]) + fabs(k->top) + k->off;
}

/* c, from w and tau. */
static void set_size(dyd_cap *k) {
  double size = cap_extent(k);
  k->in_c = k->w[0] * k->w[0] + k->w[1] * k->w[1] - k->top * k->top;
  k->off_c = is_plain(size) ? square_off(size, k->off) : HUGE_VAL;
}

/* |a b - a' b'| for a of `size`, off by `off`, and b = n, off by off_n. */
static double product_off(double size, double off, double n, double off_n) {
  return size * off_n + (fabs(n) + off_n) * off + LAST * size * fabs(n);
}

void dyd_filter_cap(dyd_cap *k, dyd_caps *c) {
  bool bound = k == c->item;
  double turn = bound == c->legal ? 1 : -1;
  if (bound) {
    const double at[3] = {mpq_get_d(c->i->x), mpq_get_d(c->i->y), mpq_get_d(c->i->r)};
    for (int a = 0; a < 3; a++) c->at[a] = at[a];
    c->j = relative_disc(c->at, k->disc, -1);
    k->w[0] = turn * c->j.x;
    k->w[1] = turn * c->j.y;
    k->top = c->j.r;
    k->off = c->j.off;
  } else {
    const dyd_relative o = relative_disc(c->at, k->disc, 1), *j = &c->j;
    k->w[0] = turn * (o.x * j->n - j->x * o.n);
    k->w[1] = turn * (o.y * j->n - j->y * o.n);
    k->top = o.r * j->n + j->r * o.n;
    k->off = MORE * (product_off(o.size, o.off, j->n, j->off_n) + product_off(j->size, j->off, o.n, o.off_n));
  }
  set_size(k);
}

void dyd_filter_cap_rounded(dyd_cap *k) {
  k->w[0] = mpq_get_d(k->wx);
  k->w[1] = mpq_get_d(k->wy);
  k->top = mpq_get_d(k->tau);
  k->off = 0;
  k->off = LAST * cap_extent(k);
  k->in_c = mpq_get_d(k->c);
  k->off_c = is_plain(cap_extent(k)) ? LAST * fabs(k->in_c) : HUGE_VAL;
}

int dyd_filter_cap_size(const dyd_cap *k) {
  return k->in_c > k->off_c ? 1 : k->in_c < -k->off_c ? -1 : 0;
}

dyd_direction dyd_filter_cap_end(const dyd_cap *e, int turn) {
  double ww = e->w[0] * e->w[0] + e->w[1] * e->w[1], s = sqrt(fmax(e->in_c, 0)), size = cap_extent(e);
  double off_ww = square_off(size, e->off);
  if (!is_plain(ww) || !is_plain(s) || !(e->in_c > e->off_c) || !(ww > 2 * off_ww))
    return (dyd_direction){NAN, NAN, HUGE_VAL};
  dyd_direction u = {(e->top * e->w[0] - turn * s * e->w[1]) / ww, (e->top * e->w[1] + turn * s * e->w[0]) / ww, 0};
  double off = 3 * size * e->off + size * e->off_c / s + LAST * size * size;
  u.off = MORE * ((off + (fabs(u.x) + fabs(u.y)) * off_ww) / (ww - off_ww) + LAST);
  return u;
}

int dyd_filter_cap_side(const dyd_direction *u, const dyd_cap *k) {
  double size = cap_extent(k), d = u->x * k->w[0] + u->y * k->w[1] - k->top;
  double off = MORE * (u->off * size + (fabs(u->x) + fabs(u->y) + 1) * k->off + LAST * size);
  if (!is_plain(size) || !(fabs(d) > off)) return 0;
  return d > 0 ? 1 : -1;
}

dyd_direction dyd_filter_between(const dyd_direction end[2]) {
  double x = end[0].x + end[1].x, y = end[0].y + end[1].y, d = hypot(x, y);
  return (dyd_direction){x / d, y / d, MORE * ((end[0].off + end[1].off) / d + LAST)};
}
