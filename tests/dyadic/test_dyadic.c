/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dyadic numbers against rationals (GMP) and directed conversions against MPFR. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <float.h>
#include <math.h>
#include <mpfr.h>
#include <string.h>

#include "dyadic/random_dyadic.h"
#include "dyadic/raw.h"

enum { CASES = 20000 };

static void check_value(const dyd_dyadic *x, const mpq_t expected) {
  mpq_t q;
  mpq_init(q);
  assert_true(dyd_dyadic_is_valid(x));
  dyd_dyadic_get_q(q, x);
  assert_true(mpq_equal(q, expected));
  mpq_clear(q);
}

static void test_arithmetic(void **state) {
  (void)state;
  test_random r = test_random_start("dyadic arithmetic");
  dyd_dyadic x, y, z;
  mpq_t p, q, s;
  dyd_dyadic_init(&x), dyd_dyadic_init(&y), dyd_dyadic_init(&z);
  mpq_inits(p, q, s, NULL);
  for (size_t n = test_cases(CASES); n > 0; n--) {
    random_dyadic(&x, &r);
    random_dyadic(&y, &r);
    if (test_chance(&r, 8)) dyd_dyadic_set(&y, &x);
    if (test_chance(&r, 8)) dyd_dyadic_neg(&y, &y);
    dyd_dyadic_get_q(p, &x);
    dyd_dyadic_get_q(q, &y);
    int order = mpq_cmp(p, q);
    assert_int_equal(dyd_dyadic_cmp(&x, &y), (order > 0) - (order < 0));
    assert_int_equal(dyd_dyadic_sgn(&x), mpq_sgn(p));
    mpq_add(s, p, q);
    assert_int_equal(dyd_dyadic_add(&z, &x, &y), DYD_OK);
    check_value(&z, s);
    mpq_sub(s, p, q);
    assert_int_equal(dyd_dyadic_sub(&z, &x, &y), DYD_OK);
    check_value(&z, s);
    mpq_mul(s, p, q);
    assert_int_equal(dyd_dyadic_mul(&z, &x, &y), DYD_OK);
    check_value(&z, s);
    mpq_mul_2exp(s, p, 77);
    assert_int_equal(dyd_dyadic_mul_2exp(&z, &x, 77), DYD_OK);
    check_value(&z, s);
    mpq_sub(s, q, p);
    assert_int_equal(dyd_dyadic_sub(&x, &y, &x), DYD_OK); /* aliased */
    check_value(&x, s);
  }
  mpq_clears(p, q, s, NULL);
  dyd_dyadic_clear(&z), dyd_dyadic_clear(&y), dyd_dyadic_clear(&x);
}

static void test_range(void **state) {
  (void)state;
  dyd_dyadic x, y;
  dyd_dyadic_init(&x), dyd_dyadic_init(&y);
  assert_int_equal(dyd_dyadic_set_si_2exp(&x, 1, DYD_EXP_LIMIT), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_set_si_2exp(&x, 1, DYD_EXP_LIMIT - 1), DYD_OK);
  assert_int_equal(dyd_dyadic_set_si_2exp(&y, 1, -DYD_EXP_LIMIT - 1), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_set_si_2exp(&y, 2, -DYD_EXP_LIMIT - 1), DYD_OK);
  assert_int_equal(y.exp, -DYD_EXP_LIMIT);
  assert_int_equal(dyd_dyadic_set_si_2exp(&y, 0, INT64_MAX), DYD_OK);
  assert_int_equal(dyd_dyadic_set_si_2exp(&y, 4, INT64_MAX), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_set_si_2exp(&y, 4, INT64_MIN), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_sgn(&y), 0);
  assert_int_equal(dyd_dyadic_add(&x, &x, &x), DYD_E_RANGE);
  assert_int_equal(x.exp, DYD_EXP_LIMIT - 1); /* unchanged */
  assert_int_equal(dyd_dyadic_sub(&y, &x, &x), DYD_OK);
  assert_int_equal(dyd_dyadic_sgn(&y), 0);
  assert_int_equal(dyd_dyadic_mul(&x, &x, &x), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_mul_2exp(&x, &x, INT64_MIN), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_mul_2exp(&x, &x, 1), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_mul_2exp(&x, &x, 1 - 2 * DYD_EXP_LIMIT), DYD_OK);
  assert_int_equal(x.exp, -DYD_EXP_LIMIT);
  assert_int_equal(dyd_dyadic_mul(&y, &x, &x), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_set_si_2exp(&y, 3, DYD_EXP_LIMIT - 2), DYD_OK);
  assert_int_equal(dyd_dyadic_add(&x, &x, &y), DYD_OK); /* both ends of the range in one number */
  assert_int_equal(dyd_bits(x.man), 2 * DYD_EXP_LIMIT);
  assert_true(dyd_dyadic_get_d(&x, DYD_DOWN) == DBL_MAX);
  assert_true(dyd_dyadic_get_d(&x, DYD_UP) == HUGE_VAL);
  assert_int_equal(dyd_dyadic_round(&y, &x, INT64_MAX, DYD_UP), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_round(&y, &x, INT64_MAX, DYD_DOWN), DYD_OK);
  assert_int_equal(dyd_dyadic_sgn(&y), 0);
  dyd_dyadic_clear(&y), dyd_dyadic_clear(&x);
}

/* out is the nearest multiple of 2^exp on the given side of q. */
static void check_rounded(const dyd_dyadic *out, const mpq_t q, int64_t exp, dyd_round dir) {
  mpq_t v, gap, quantum;
  mpq_inits(v, gap, quantum, NULL);
  assert_true(dyd_dyadic_is_valid(out));
  dyd_dyadic_get_q(v, out);
  mpq_set_ui(quantum, 1, 1);
  if (exp > 0) mpq_mul_2exp(quantum, quantum, (mp_bitcnt_t)exp);
  if (exp < 0) mpq_div_2exp(quantum, quantum, (mp_bitcnt_t)-exp);
  mpq_sub(gap, q, v);
  if (dir == DYD_UP) mpq_neg(gap, gap);
  assert_true(mpq_sgn(gap) >= 0 && mpq_cmp(gap, quantum) < 0);
  mpq_div(v, v, quantum);
  assert_true(mpz_cmp_ui(mpq_denref(v), 1) == 0);
  mpq_clears(v, gap, quantum, NULL);
}

static void test_round(void **state) {
  (void)state;
  test_random r = test_random_start("dyadic rounding");
  dyd_dyadic x, z;
  mpq_t q;
  dyd_dyadic_init(&x), dyd_dyadic_init(&z);
  mpq_init(q);
  for (size_t n = test_cases(CASES); n > 0; n--) {
    random_dyadic(&x, &r);
    dyd_dyadic_get_q(q, &x);
    int64_t exp = x.exp + test_between(&r, -100, 300);
    dyd_round dir = test_chance(&r, 2) ? DYD_UP : DYD_DOWN;
    assert_int_equal(dyd_dyadic_round(&z, &x, exp, dir), DYD_OK);
    check_rounded(&z, q, exp, dir);
    assert_int_equal(dyd_dyadic_round_q(&z, q, exp, dir), DYD_OK);
    check_rounded(&z, q, exp, dir);
    random_integer(mpq_numref(q), &r, 150);
    random_integer(mpq_denref(q), &r, 150);
    if (!mpz_sgn(mpq_denref(q))) mpz_set_ui(mpq_denref(q), 3);
    mpq_canonicalize(q);
    exp = random_exponent(&r);
    assert_int_equal(dyd_dyadic_round_q(&z, q, exp, dir), DYD_OK);
    check_rounded(&z, q, exp, dir);
  }
  mpq_set_si(q, 1, 3);
  assert_int_equal(dyd_dyadic_round_q(&z, q, INT64_MIN, DYD_UP), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_round_q(&z, q, -DYD_EXP_LIMIT - 1, DYD_UP), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_round_q(&z, q, -DYD_EXP_LIMIT, DYD_UP), DYD_OK);
  assert_int_equal(dyd_dyadic_round_q(&z, q, INT64_MAX, DYD_UP), DYD_E_RANGE);
  assert_int_equal(dyd_dyadic_round_q(&z, q, INT64_MAX, DYD_DOWN), DYD_OK);
  mpq_set_si(q, -5, 8);
  assert_int_equal(dyd_dyadic_round_q(&z, q, INT64_MIN, DYD_UP), DYD_OK);
  check_value(&z, q);
  mpq_clear(q);
  dyd_dyadic_clear(&z), dyd_dyadic_clear(&x);
}

static void check_double(const dyd_dyadic *x, mpfr_t f) {
  mpfr_set_z_2exp(f, x->man, (mpfr_exp_t)x->exp, MPFR_RNDN);
  double down = dyd_dyadic_get_d(x, DYD_DOWN), up = dyd_dyadic_get_d(x, DYD_UP);
  assert_true(down == mpfr_get_d(f, MPFR_RNDD));
  assert_true(up == mpfr_get_d(f, MPFR_RNDU));
  assert_int_equal(dyd_dyadic_is_double(x), down == up);
}

static void test_get_d(void **state) {
  (void)state;
  test_random r = test_random_start("dyadic to double");
  dyd_dyadic x, y;
  mpfr_t f;
  dyd_dyadic_init(&x), dyd_dyadic_init(&y);
  mpfr_init2(f, 4000);
  for (size_t n = test_cases(CASES); n > 0; n--) {
    random_dyadic(&x, &r);
    check_double(&x, f);
    /* Just beside a double, just next to the largest and the smallest. */
    uint64_t word = test_u64(&r);
    double d;
    memcpy(&d, &word, sizeof d);
    if (test_chance(&r, 4)) d = test_chance(&r, 2) ? DBL_MAX : 0x1p-1074 * (double)test_below(&r, 3);
    if (!isfinite(d)) continue;
    assert_int_equal(dyd_dyadic_set_d(&x, d), DYD_OK);
    assert_true(dyd_dyadic_is_double(&x));
    assert_true(dyd_dyadic_get_d(&x, DYD_DOWN) == d && dyd_dyadic_get_d(&x, DYD_UP) == d);
    assert_int_equal(dyd_dyadic_set_si_2exp(&y, test_chance(&r, 2) ? 1 : -1, -1200), DYD_OK);
    assert_int_equal(dyd_dyadic_add(&x, &x, &y), DYD_OK);
    check_double(&x, f);
    /* Quotients: d1 <= m / den <= d2 next to each other. */
    mpz_t den;
    mpz_init(den);
    random_integer(den, &r, 100);
    mpz_abs(den, den);
    mpz_add_ui(den, den, 1);
    mpfr_prec_t prec = 4000;
    mpfr_set_prec(f, prec);
    random_dyadic(&x, &r);
    double lo = dyd_raw_quotient_get_d(x.man, x.exp, den, DYD_DOWN);
    double hi = dyd_raw_quotient_get_d(x.man, x.exp, den, DYD_UP);
    mpfr_set_z_2exp(f, x.man, (mpfr_exp_t)x.exp, MPFR_RNDN);
    mpfr_div_z(f, f, den, MPFR_RNDD); /* so precise that it never crosses a double */
    double expect_lo = mpfr_get_d(f, MPFR_RNDD);
    mpfr_set_z_2exp(f, x.man, (mpfr_exp_t)x.exp, MPFR_RNDN);
    mpfr_div_z(f, f, den, MPFR_RNDU);
    assert_true(lo == expect_lo && hi == mpfr_get_d(f, MPFR_RNDU));
    mpz_clear(den);
  }
  assert_int_equal(dyd_dyadic_set_d(&x, HUGE_VAL), DYD_E_ARG);
  assert_int_equal(dyd_dyadic_set_d(&x, -HUGE_VAL), DYD_E_ARG);
  assert_int_equal(dyd_dyadic_set_d(&x, (double)NAN), DYD_E_ARG);
  mpfr_clear(f);
  dyd_dyadic_clear(&y), dyd_dyadic_clear(&x);
}

/* 2^e >= |q| and 2^(e-2) < |q|: the least such e, or one more. Every fraction of small numbers, of both signs. */
static void test_log2_above(void **state) {
  (void)state;
  mpq_t q, power;
  mpq_inits(q, power, NULL);
  for (long num = -70; num <= 70; num++)
    for (unsigned long den = 1; num && den <= 70; den++) {
      mpq_set_si(q, num, den);
      mpq_canonicalize(q);
      int64_t e = dyd_q_log2_above(q);
      mpq_abs(q, q);
      for (int less = 0; less <= 2; less += 2) {
        mpq_set_ui(power, 1, 1);
        if (e - less >= 0)
          mpq_mul_2exp(power, power, (mp_bitcnt_t)(e - less));
        else
          mpq_div_2exp(power, power, (mp_bitcnt_t)(less - e));
        assert_true(less ? mpq_cmp(power, q) < 0 : mpq_cmp(power, q) >= 0);
      }
    }
  mpq_clears(q, power, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_arithmetic), cmocka_unit_test(test_range),
                                     cmocka_unit_test(test_round), cmocka_unit_test(test_get_d),
                                     cmocka_unit_test(test_log2_above)};
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  mpfr_free_cache();
  return failed;
}
