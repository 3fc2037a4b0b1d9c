/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Literal oracles in rationals for rectangles: distances by all candidate points, hulls by all pairs of corners. */
#ifndef DYD_TESTS_LITERAL_RECT_H
#define DYD_TESTS_LITERAL_RECT_H

#include "support/random.h"
#include <dyadel/rect.h>

/* x0, x1, y0, y1 as rationals. */
typedef struct literal_rect {
  mpq_t end[4];
} literal_rect;

static inline void literal_init(literal_rect *l) {
  mpq_inits(l->end[0], l->end[1], l->end[2], l->end[3], NULL);
}
static inline void literal_clear(literal_rect *l) {
  mpq_clears(l->end[0], l->end[1], l->end[2], l->end[3], NULL);
}
static inline void literal_set(literal_rect *l, const dyd_rect *r) {
  dyd_interval_get_q(l->end[0], l->end[1], &r->x);
  dyd_interval_get_q(l->end[2], l->end[3], &r->y);
}

/* A multiple of 1/den in 0 .. grid, times 2^exp. */
static inline void random_rational(mpq_t q, test_random *r, int64_t grid, unsigned long den, int64_t exp) {
  mpq_set_si(q, (long)test_between(r, 0, grid * (int64_t)den), den);
  mpq_canonicalize(q);
  if (exp > 0) mpq_mul_2exp(q, q, (mp_bitcnt_t)exp);
  if (exp < 0) mpq_div_2exp(q, q, (mp_bitcnt_t)-exp);
}

/* An interval with ends in 0 .. grid, times 2^exp; now and then with rational ones, or a rational point between. */
static inline void random_interval(dyd_interval *out, test_random *r, int64_t grid, int64_t exp) {
  static const unsigned long den[] = {1, 3, 5, 6, 7, 9, 10};
  mpq_t q[2];
  mpq_inits(q[0], q[1], NULL);
  const bool rational = test_chance(r, 3);
  for (int k = 0; k < 2; k++) random_rational(q[k], r, grid, rational ? den[test_below(r, 7)] : 1, exp);
  if (test_chance(r, 3)) mpq_set(q[1], q[0]);
  const int low = mpq_cmp(q[0], q[1]) > 0;
  (void)dyd_interval_set_ends_q(out, q[low], q[!low]);
  mpq_clears(q[0], q[1], NULL);
}

static inline void random_rect(dyd_rect *out, test_random *r, int64_t grid, int64_t exp) {
  random_interval(&out->x, r, grid, exp);
  random_interval(&out->y, r, grid, exp);
}

/* t = (a - b)^2 added to out. */
static inline void literal_add_square(mpq_t out, const mpq_t a, const mpq_t b) {
  mpq_t t;
  mpq_init(t);
  mpq_sub(t, a, b);
  mpq_mul(t, t, t);
  mpq_add(out, out, t);
  mpq_clear(t);
}

/* Closest: the least over corners, feet on the four sides and c itself, where they belong to the rectangle.
 * Farthest: the largest over the four corners. */
static inline void literal_distance2(mpq_t out, const mpq_t c[2], const literal_rect *l, bool far) {
  mpq_t d;
  mpq_init(d);
  bool first = true;
  bool in_x = mpq_cmp(c[0], l->end[0]) >= 0 && mpq_cmp(c[0], l->end[1]) <= 0;
  bool in_y = mpq_cmp(c[1], l->end[2]) >= 0 && mpq_cmp(c[1], l->end[3]) <= 0;
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      if ((i == 2 || j == 2) && far) continue;
      if ((i == 2 && !in_x) || (j == 2 && !in_y)) continue;
      mpq_set_ui(d, 0, 1);
      literal_add_square(d, i == 2 ? c[0] : l->end[i], c[0]);
      literal_add_square(d, j == 2 ? c[1] : l->end[2 + j], c[1]);
      if (first || (far ? mpq_cmp(d, out) > 0 : mpq_cmp(d, out) < 0)) mpq_set(out, d);
      first = false;
    }
  }
  mpq_clear(d);
}

/* out = (b - a) x (c - a) */
static inline void literal_cross(mpq_t out, mpq_t *const a[2], mpq_t *const b[2], mpq_t *const c[2]) {
  mpq_t s, t;
  mpq_inits(s, t, NULL);
  mpq_sub(s, *b[0], *a[0]);
  mpq_sub(t, *c[1], *a[1]);
  mpq_mul(out, s, t);
  mpq_sub(s, *b[1], *a[1]);
  mpq_sub(t, *c[0], *a[0]);
  mpq_mul(s, s, t);
  mpq_sub(out, out, s);
  mpq_clears(s, t, NULL);
}

#endif
