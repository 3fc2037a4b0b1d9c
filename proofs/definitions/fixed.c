/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Signs of orientation and in-circle of skeleton/mesh_filter.c, in doubles and in 256 bits. */
#include "skeleton/mesh_filter.c" /* functions are static */
#include "vectors.h"

/* ---- in doubles ---- */

/* x[0]: the bound, or what belongs in its place; then x and y of points, the last one seen from. */
static dyd_xy point_of(const double *x, int k) {
  return (dyd_xy){x[2 * k + 1], x[2 * k + 2]};
}
static dyd_incircle incircle_of(const double *x) {
  return dyd_incircle_of(point_of(x, 0), point_of(x, 1), point_of(x, 2), point_of(x, 3));
}

static void ask_orient(answer *a, const double *x) {
  dyd_mesh m = {.orient_bound = x[0]};
  say_integer(a, dyd_filter_orient(&m, point_of(x, 0), point_of(x, 1), point_of(x, 2)));
}
static void ask_turn(answer *a, const double *x) {
  dyd_mesh m = {.orient_bound = x[0]};
  say_integer(a, dyd_filter_turn(&m, x[1]));
}
static void ask_orient_near(answer *a, const double *x) {
  dyd_mesh m = {.incircle_delta = x[0]};
  say_integer(a, dyd_filter_orient_near(&m, point_of(x, 0), point_of(x, 1), point_of(x, 2)));
}
static void ask_orient_small(answer *a, const double *x) {
  int sign;
  dyd_mesh m = {.exact_s = x[0]};
  if (dyd_filter_orient_small(&sign, &m, point_of(x, 0), point_of(x, 1), point_of(x, 2)))
    say_integer(a, sign);
  else
    say_none(a);
}
static void ask_incircle_at(answer *a, const double *x) {
  dyd_mesh m = {.incircle_delta = x[0]};
  say_integer(a, dyd_filter_incircle_at(&m, incircle_of(x)));
}
static void ask_incircle_near(answer *a, const double *x) {
  dyd_mesh m = {.incircle_delta = x[0]};
  say_integer(a, dyd_filter_incircle_near(&m, point_of(x, 0), point_of(x, 1), point_of(x, 2), point_of(x, 3)));
}
static void ask_incircle_small(answer *a, const double *x) {
  int sign;
  dyd_mesh m = {.exact_s = x[0]};
  if (dyd_filter_incircle_small(&sign, &m, incircle_of(x)))
    say_integer(a, sign);
  else
    say_none(a);
}

static void choose_bounded(double *x, unsigned inputs, const kind *k) {
  static const double deltas[] = {0, 0, 0x1p-60, 0x1p40, INFINITY};
  (void)inputs;
  (void)k;
  if (test_chance(&shared, 2))
    x[0] = deltas[test_below(&shared, 5)];
  else if (test_chance(&shared, 2))
    x[0] = ldexp(fabs(x[1]), -(int)test_below(&shared, 30));
}

static const function signs[] = {{"dyd_filter_orient", 7, ask_orient, choose_bounded, 12, 0},
                                 {"dyd_filter_turn", 2, ask_turn, choose_bounded, 2, 0},
                                 {"dyd_filter_orient_near", 7, ask_orient_near, choose_bounded, 12, 0},
                                 {"dyd_filter_orient_small", 7, ask_orient_small, choose_bounded, 12, 0},
                                 {"dyd_filter_incircle_at", 9, ask_incircle_at, choose_bounded, 12, 0},
                                 {"dyd_filter_incircle_near", 9, ask_incircle_near, choose_bounded, 12, 0},
                                 {"dyd_filter_incircle_small", 9, ask_incircle_small, choose_bounded, 12, 0}};

/* Two points whose products differ by so few last bits that the bound for three points alone has to tell. */
static void put_near_turn(void) {
  double bits = 5 + (double)test_below(&shared, 3),
         off = ldexp(test_unit(&shared) - 0.5, -(int)test_below(&shared, 30));
  double left = bits / 4.01 * (1 + off), side = test_chance(&shared, 2) ? 1 : -1;
  const double x[INPUTS] = {0, left, 1, left - side * bits * 0x1p-52, 1, 0, 0};
  put_vector(&signs[2], x);
}

/* ---- in 256 bits ---- */

static u128 wide_of(mpz_srcptr z) {
  u128 y = 0;
  for (size_t k = mpz_size(z); k-- > 0;) y = y << 64 | mpz_getlimbn(z, (mp_size_t)k);
  return mpz_sgn(z) < 0 ? -y : y;
}
static void say_wide(answer *a, u128 y) {
  mpz_t z;
  mpz_init_set_ui(z, (unsigned long)(y >> 64));
  mpz_mul_2exp(z, z, 64);
  mpz_add_ui(z, z, (unsigned long)y);
  say_big(a, z);
  mpz_clear(z);
}
static void say_256(answer *a, i256 y) {
  say_wide(a, y.low);
  say_wide(a, y.high);
}

static void ask_product(answer *a, mpz_t *z) {
  say_256(a, product((i128)wide_of(z[0]), (i128)wide_of(z[1])));
}
static void ask_sum(answer *a, mpz_t *z) {
  say_256(a, sum((i256){wide_of(z[0]), wide_of(z[1])}, (i256){wide_of(z[2]), wide_of(z[3])}));
}
static void ask_fixed_incircle(answer *a, mpz_t *z) {
  int64_t at[4][2];
  dyd_reps reps = {.n = 4};
  dyd_fixed f = {.z = at};
  dyd_mesh m = {.reps = &reps, .fixed = &f};
  int sign = 2;
  for (int k = 0; k < 8; k++) at[k / 2][k % 2] = mpz_get_si(z[k]);
  dyd_fixed_incircle(&sign, &m, 0, 1, 2, 3);
  say_integer(a, sign);
}

/* Of `bits` bits at most, with long runs of equal ones. */
static void some_bits(mpz_t z, unsigned bits) {
  mpz_set_ui(z, 0);
  for (unsigned k = 0; k < bits; k += 8) {
    mpz_mul_2exp(z, z, 8);
    mpz_add_ui(z, z,
               test_chance(&shared, 3)   ? 255
               : test_chance(&shared, 2) ? 0
                                         : (unsigned long)test_below(&shared, 256));
  }
  mpz_tdiv_r_2exp(z, z, bits);
}
static void choose_product(mpz_t *z, unsigned inputs) {
  (void)inputs;
  some_bits(z[0], (unsigned)test_between(&shared, 0, 123));
  some_bits(z[1], (unsigned)test_between(&shared, 0, 123));
  if (test_chance(&shared, 2)) mpz_neg(z[1], z[1]);
}
static void choose_sum(mpz_t *z, unsigned inputs) {
  for (unsigned k = 0; k < inputs; k++) some_bits(z[k], test_chance(&shared, 6) ? 0 : 128);
}
/* Points of a circle about a place, or about that; of few bits, or of all 60. */
static void choose_circle(mpz_t *z, unsigned inputs) {
  static const int place[8][2] = {{25, 0}, {24, 7}, {20, 15}, {15, 20}, {7, 24}, {0, 25}, {-7, 24}, {-24, -7}};
  int64_t size = test_between(&shared, 1, INT64_C(1) << test_below(&shared, 54));
  for (unsigned k = 0; k < inputs; k += 2) {
    const int *p = place[test_below(&shared, 8)];
    for (unsigned e = 0; e < 2; e++) {
      mpz_set_si(z[k + e], (long)(p[e] * size + test_between(&shared, -1, 1) * (int64_t)test_chance(&shared, 4)));
      if (test_chance(&shared, 12)) some_bits(z[k + e], 60);
    }
  }
}

static const whole fixed[] = {{"product", 2, ask_product, choose_product},
                              {"sum", 4, ask_sum, choose_sum},
                              {"dyd_fixed_incircle", 8, ask_fixed_incircle, choose_circle}};

void vectors_of_fixed(const kind *k) {
  put_near_turn();
  put_vectors(signs, sizeof signs / sizeof *signs, k);
  put_wholes(fixed, sizeof fixed / sizeof *fixed);
}
