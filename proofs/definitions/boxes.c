/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Boxes along a direction, the direction in doubles, and back from the common scale. */
#include "skeleton/rects_filter.c" /* functions are static */
#include "vectors.h"

static dyd_bbox box_at(const double *x) {
  return (dyd_bbox){{x[0], x[1], x[2], x[3]}};
}

static void ask_reach(answer *a, const double *x) {
  dyd_bbox b = box_at(x);
  say_double(a, reach(&b, x[4], x[5]));
}
static void ask_hull(answer *a, const double *x) {
  dyd_bbox h = box_at(x), b = box_at(x + 4);
  dyd_box_widen(&h, &b);
  say_doubles(a, h.e, 4);
}
static void ask_height_lower(answer *a, const double *x) {
  dyd_bbox all = box_at(x), p = box_at(x + 6);
  dyd_rects r = {.tree = {.node = &all, .levels = 1}};
  say_double(a, dyd_height_lower(&r, x[4], x[5], &p));
}
/* x[4]: the denominator, as mpz_get_d will see it; infinite: too large for doubles */
static void ask_scale_to_user(answer *a, const double *x) {
  dyd_scale_set s = {.count = 0};
  dyd_bbox b = box_at(x);
  mpz_init(s.lcm);
  if (isfinite(x[4]))
    mpz_set_d(s.lcm, x[4]);
  else
    mpz_setbit(s.lcm, 1100);
  dyd_scale_to_user(&b, &s);
  say_doubles(a, b.e, 4);
  mpz_clear(s.lcm);
}

static void choose_scale(double *x, unsigned inputs, const kind *k) {
  choose_intervals(x, inputs, k);
  switch (test_below(&shared, 8)) {
  case 0:
    x[4] = INFINITY;
    break;
  case 1:
    x[4] = ldexp(1, (int)test_below(&shared, 1024));
    break;
  default:
    x[4] = floor(ldexp(1 + test_unit(&shared), (int)test_below(&shared, 70)));
  }
}

/* Directions along an axis, boxes without an end. */
static void choose_direction(double *x, unsigned inputs, const kind *k) {
  choose_intervals(x, inputs, k);
  if (test_chance(&shared, 4)) x[4 + test_below(&shared, 2)] = test_chance(&shared, 2) ? 0.0 : -0.0;
  if (test_chance(&shared, 4)) x[inputs == 6 ? 2 : 8] = -INFINITY;
  if (test_chance(&shared, 4)) x[inputs == 6 ? 1 : 7] = INFINITY;
}

static const function box[] = {{"reach", 6, ask_reach, choose_direction, 0, 0},
                               {"dyd_box_widen", 8, ask_hull, choose_intervals, 0, 0},
                               {"dyd_height_lower", 10, ask_height_lower, choose_direction, 0, 0},
                               {"dyd_scale_to_user", 5, ask_scale_to_user, choose_scale, 0, 0}};

/* ---- directions ---- */

static void ask_direction(answer *a, mpz_t *z) {
  double u[2];
  dyd_direction_d(u, z[0], z[1]);
  say_doubles(a, u, 2);
}

static void some_component(mpz_t z) {
  mp_bitcnt_t bits = (mp_bitcnt_t)test_below(&shared, test_chance(&shared, 2) ? 60 : 1000);
  mpz_set_ui(z, (unsigned long)(test_u64(&shared) >> test_below(&shared, 64)));
  mpz_mul_2exp(z, z, bits);
  if (test_chance(&shared, 2)) mpz_add_ui(z, z, (unsigned long)test_u64(&shared));
  if (test_chance(&shared, 2)) mpz_neg(z, z);
  if (test_chance(&shared, 10)) mpz_set_ui(z, 0);
}

static void choose_components(mpz_t *z, unsigned inputs) {
  for (unsigned q = 0; q < inputs; q++) some_component(z[q]);
}

static const whole direction = {"dyd_direction_d", 2, ask_direction, choose_components};

void vectors_of_boxes(const kind *k) {
  put_vectors(box, sizeof box / sizeof *box, k);
  put_wholes(&direction, 1);
}
