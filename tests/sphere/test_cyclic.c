/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [SPH-3] Sums of roots of unity: against their values, and by relations that make them 0. */
#include <setjmp.h>
#include <stdarg.h>

#include "sphere/state.h"
#include "support/random.h"
#include <cmocka.h>
#include <math.h>
#include <string.h>

enum { MOST = 192 };

static bool is_zero(const dyd_root_term *term, size_t count, dyd_turns n) {
  dyd_root_term copy[MOST];
  bool zero = false;
  memcpy(copy, term, count * sizeof *term);
  assert_int_equal(dyd_cyclic_is_zero(&zero, copy, count, n), DYD_OK);
  return zero;
}

/* Sums that are not 0 are not small here: few terms of a low order. */
static bool is_small(const dyd_root_term *term, size_t count, dyd_turns n) {
  long double x = 0, y = 0, turn = 2 * acosl(-1);
  for (size_t k = 0; k < count; k++) {
    x += (long double)term[k].c * cosl(turn * (long double)term[k].e / (long double)n);
    y += (long double)term[k].c * sinl(turn * (long double)term[k].e / (long double)n);
  }
  long double size = hypotl(x, y);
  assert_true(size < 1e-14L || size > 1e-9L);
  return size < 1e-14L;
}

/* All sums of up to five roots of order n, with coefficients 1 and -1. */
static void test_all_short_sums(void **state) {
  size_t zeros = 0;
  (void)state;
  for (unsigned n = 1; n <= 18; n++)
    for (unsigned count = 0; count <= (n <= 12 ? 5 : 4); count++) {
      unsigned long many = 1;
      for (unsigned k = 1; k < count; k++) many *= 2 * n;
      for (unsigned long code = 0; code < many; code++) {
        dyd_root_term term[5] = {{0, 1}};
        unsigned long left = code;
        for (unsigned k = 1; k < count; k++, left /= 2 * n)
          term[k] = (dyd_root_term){(dyd_turns)(left % (2 * n) / 2), left % 2 ? 1 : -1};
        bool zero = is_zero(term, count, n);
        assert_true(zero == is_small(term, count, n));
        zeros += zero;
      }
    }
  assert_true(zeros > 1000);
}

/* Adds c z^e times the sum of all p-th roots of unity, which is 0. */
static size_t put_cycle(dyd_root_term *term, size_t count, dyd_turns n, unsigned p, dyd_turns e, int64_t c) {
  for (unsigned k = 0; k < p; k++) term[count++] = (dyd_root_term){(e + k * (n / p)) % n, c};
  return count;
}

static dyd_turns random_below(test_random *r, dyd_turns n) {
  dyd_turns wide = (dyd_turns)test_below(r, (uint64_t)1 << 60) << 60 | (dyd_turns)test_below(r, (uint64_t)1 << 60);
  return wide % n;
}

/* Sums of cycles are 0, and no longer when one root is moved, or a coefficient. Orders with large primes, too. */
static void test_cycles(void **state) {
  static const uint64_t order[] = {
      360, 3600, 30030, 46189, UINT64_C(36000000000), UINT64_C(2) * 3 * 5 * 999999999989, UINT64_C(360) * 49 * 1000003};
  test_random r;
  (void)state;
  r = test_random_start("cycles of roots of unity");
  for (int k = 0; k < 4000; k++) {
    dyd_root_term term[MOST];
    size_t count = 0;
    dyd_turns n = (dyd_turns)order[test_below(&r, sizeof order / sizeof *order)];
    if (test_chance(&r, 3)) n *= (dyd_turns)1 << test_below(&r, 50);
    for (unsigned cycles = 1 + (unsigned)test_below(&r, 6); cycles; cycles--) {
      static const unsigned prime[] = {2, 3, 5, 7, 11, 13, 17, 19};
      unsigned p = prime[test_below(&r, 8)];
      if (n % p == 0) count = put_cycle(term, count, n, p, random_below(&r, n), (int64_t)test_below(&r, 7) - 3);
    }
    assert_true(is_zero(term, count, n));
    if (!count) continue;
    size_t other = test_below(&r, count);
    if (!term[other].c) continue;
    dyd_root_term was = term[other];
    term[other].c++;
    assert_false(is_zero(term, count, n));
    term[other] = was;
    dyd_turns move = random_below(&r, n);
    term[other].e = (was.e + move) % n;
    assert_true(is_zero(term, count, n) == (move == 0));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_all_short_sums), cmocka_unit_test(test_cycles)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
