/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Ends of caps in doubles.
 *
 * Rationals become doubles by mpq_get_d, within 2^-52 of themselves unless subnormal. u = (tau w + turn sqrt(c) w') /
 * ww has length 1 and |tau w|, |sqrt(c) w'| <= ww, so each coordinate is off by a few 2^-52 in all; c is converted, not
 * computed, so nothing cancels. u.w_k - tau_k is then off by less than 2^-46 (|w_k| + tau_k), sum norm. */
#include "tolerance/discs.h"

#include <math.h>

/* Returns true if x is a normal number that stays one when squared. */
static bool is_plain(double x) {
  return fabs(x) > 0x1p-400 && fabs(x) < 0x1p400;
}

dyd_direction dyd_filter_cap_end(const dyd_cap *e, int turn) {
  double ww = mpq_get_d(e->ww), s = turn * sqrt(fmax(mpq_get_d(e->c), 0));
  if (!is_plain(ww) || !is_plain(s)) return (dyd_direction){NAN, NAN};
  return (dyd_direction){(e->top * e->w[0] - s * e->w[1]) / ww, (e->top * e->w[1] + s * e->w[0]) / ww};
}

int dyd_filter_cap_side(const dyd_direction *u, const dyd_cap *k) {
  double size = fabs(k->w[0]) + fabs(k->w[1]) + k->top, d = u->x * k->w[0] + u->y * k->w[1] - k->top;
  if (!is_plain(size) || !(fabs(d) > 0x1p-46 * size)) return 0;
  return d > 0 ? 1 : -1;
}

dyd_direction dyd_filter_between(const dyd_direction end[2]) {
  double x = end[0].x + end[1].x, y = end[0].y + end[1].y, d = hypot(x, y);
  return (dyd_direction){x / d, y / d};
}
