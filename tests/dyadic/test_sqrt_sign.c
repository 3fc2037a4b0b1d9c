/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Signs with one and two roots [SQR-1] [SQR-2] against MPFR, and at constructed zeros.
 *
 * A nonzero a + b sqrt(c) times its conjugate is a nonzero integer; with entries below 2^64 it is above 2^-200. With
 * two roots there are three conjugates, each below 2^100: a nonzero value is above 2^-300. So 2000 bits decide. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <mpfr.h>

#include "dyadic/random_dyadic.h"
#include "dyadic/raw.h"

enum { PRECISION = 2000, ZERO_BELOW = -400 };

typedef struct terms {
  mpz_t a, b, c, d, e;
} terms;

static void add_root(mpfr_t sum, const mpz_t b, const mpz_t c) {
  mpfr_t t;
  mpfr_init2(t, PRECISION);
  mpfr_set_z(t, c, MPFR_RNDN);
  mpfr_sqrt(t, t, MPFR_RNDN);
  mpfr_mul_z(t, t, b, MPFR_RNDN);
  mpfr_add(sum, sum, t, MPFR_RNDN);
  mpfr_clear(t);
}

/* a + b sqrt(c) [+ d sqrt(e)] */
static int oracle(const terms *t, bool two) {
  mpfr_t sum;
  mpfr_init2(sum, PRECISION);
  mpfr_set_z(sum, t->a, MPFR_RNDN);
  add_root(sum, t->b, t->c);
  if (two) add_root(sum, t->d, t->e);
  int sign = mpfr_zero_p(sum) || mpfr_get_exp(sum) < ZERO_BELOW ? 0 : mpfr_sgn(sum) > 0 ? 1 : -1;
  mpfr_clear(sum);
  return sign;
}

static void check(const terms *t) {
  assert_int_equal(dyd_sqrt_sign(t->a, t->b, t->c), oracle(t, false));
  assert_int_equal(dyd_sqrt2_sign(t->a, t->b, t->c, t->d, t->e), oracle(t, true));
  assert_int_equal(dyd_sqrt2_sign(t->a, t->d, t->e, t->b, t->c), oracle(t, true));
}

/* a + b sqrt(c) = 0 */
static void make_zero(terms *t, test_random *r) {
  random_integer(t->b, r, 30);
  random_integer(t->c, r, 30);
  mpz_mul(t->a, t->b, t->c);
  mpz_neg(t->a, t->a);
  mpz_mul(t->c, t->c, t->c);
  if (mpz_sgn(t->a) * mpz_sgn(t->b) > 0) mpz_neg(t->a, t->a);
}

/* b sqrt(c) + d sqrt(e) = 0 with c = k^2 w, e = m^2 w, b = m, d = -k */
static void make_zero2(terms *t, test_random *r) {
  mpz_set_ui(t->a, 0);
  random_integer(t->b, r, 20);
  random_integer(t->d, r, 20);
  mpz_abs(t->b, t->b);
  mpz_abs(t->d, t->d);
  mpz_mul(t->c, t->d, t->d);
  mpz_mul(t->e, t->b, t->b);
  unsigned long w = 1 + (unsigned long)test_below(r, 30);
  mpz_mul_ui(t->c, t->c, w);
  mpz_mul_ui(t->e, t->e, w);
  mpz_neg(t->d, t->d);
}

static void nudge(mpz_t z, test_random *r) {
  if (test_chance(r, 3)) mpz_add_ui(z, z, 1);
}

static void test_signs(void **state) {
  (void)state;
  test_random r = test_random_start("sqrt signs");
  terms t;
  mpz_inits(t.a, t.b, t.c, t.d, t.e, NULL);
  for (size_t n = test_cases(20000); n > 0; n--) {
    random_integer(t.a, &r, 60);
    random_integer(t.b, &r, 30);
    random_integer(t.c, &r, 60);
    random_integer(t.d, &r, 30);
    random_integer(t.e, &r, 60);
    mpz_abs(t.c, t.c);
    mpz_abs(t.e, t.e);
    check(&t);
    make_zero(&t, &r);
    assert_int_equal(dyd_sqrt_sign(t.a, t.b, t.c), 0);
    nudge(t.a, &r), nudge(t.c, &r);
    check(&t);
    make_zero2(&t, &r);
    assert_int_equal(dyd_sqrt2_sign(t.a, t.b, t.c, t.d, t.e), 0);
    nudge(t.a, &r), nudge(t.c, &r), nudge(t.e, &r);
    check(&t);
  }
  mpz_clears(t.a, t.b, t.c, t.d, t.e, NULL);
}

static void test_small(void **state) {
  (void)state;
  terms t;
  mpz_inits(t.a, t.b, t.c, t.d, t.e, NULL);
  for (int a = -4; a <= 4; a++) {
    for (int b = -2; b <= 2; b++) {
      for (int k = 0; k < 5 * 9 * 9; k++) {
        mpz_set_si(t.a, a), mpz_set_si(t.b, b);
        mpz_set_si(t.d, k % 5 - 2), mpz_set_ui(t.c, k / 5 % 9U), mpz_set_ui(t.e, k / 45 % 9U);
        check(&t);
      }
    }
  }
  mpz_clears(t.a, t.b, t.c, t.d, t.e, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_signs), cmocka_unit_test(test_small)};
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  mpfr_free_cache();
  return failed;
}
