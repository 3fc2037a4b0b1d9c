/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A flag that is set while one function, or one step to a root, is at work on millions of digits: the call ends within
 * a second, says so, and what was known stays known. */
#include "harness.h"

#include "base/clock.h"
#include "stream/algebra/describe.h"
#include "stream/real.h"

#include <pthread.h>

/* What a test waits for at most after the flag, in seconds. */
#define SPARE 1.0

typedef struct alarm {
  volatile int stop;
  double after, set; /* seconds; the clock when it was set */
  pthread_t thread;
} alarm;

static void *alarm_wait(void *arg) {
  alarm *a = arg;
  const struct timespec wait = {(time_t)a->after, (long)(1e9 * (a->after - (double)(time_t)a->after))};
  nanosleep(&wait, NULL);
  a->set = dyd_seconds();
  __atomic_store_n(&a->stop, 1, __ATOMIC_SEQ_CST);
  return NULL;
}

static void alarm_start(alarm *a, double after) {
  *a = (alarm){.after = after};
  assert_int_equal(0, pthread_create(&a->thread, NULL, alarm_wait, a));
}

/* Since the flag was set; negative: the work ended before. */
static double alarm_late(alarm *a) {
  double now = dyd_seconds();
  assert_int_equal(0, pthread_join(a->thread, NULL));
  return now - a->set;
}

/* Eight million bits take some ten seconds. */
static void test_functions(void **state) {
  static const dyd_op function[] = {DYD_OP_EXP, DYD_OP_LOG, DYD_OP_SIN, DYD_OP_ATAN};
  (void)state;
  for (size_t k = 0; k < sizeof function / sizeof *function; k++) {
    alarm a;
    mpq_t q;
    dyd_forms f;
    mpq_init(q);
    mpq_set_ui(q, 4, 3);
    dyd_forms_init(&f);
    uint32_t n = dyd_forms_unary(&f, function[k], dyd_forms_number(&f, q), 0);
    assert_true(arb_is_finite(dyd_forms_value(&f, n, 1 << 12)));
    f.stop = &a.stop;
    alarm_start(&a, 0.1);
    bool known = arb_is_finite(dyd_forms_value(&f, n, 1 << 23));
    double late = alarm_late(&a);
    assert_false(known);
    if (late > SPARE) fail_msg("operation %d ended %.1f s late", (int)function[k], late);
    f.stop = NULL; /* what was stopped is computed anew */
    assert_true(arb_is_finite(dyd_forms_value(&f, n, 1 << 12)));
    dyd_forms_clear(&f);
    mpq_clear(q);
  }
}

/* sum of bits: many functions, each of them short. */
static void test_expression(void **state) {
  (void)state;
  alarm a;
  dyd_error err;
  dyd_real *x = parsed("exp(sqrt(2))*exp(sqrt(3))*exp(sqrt(5))*exp(sqrt(6))*exp(sqrt(7))*exp(sqrt(10))*exp(sqrt(11))");
  narrowed(x, 64, 4096);
  int64_t before = dyd_interval_bits(dyd_real_interval(x));
  alarm_start(&a, 0.1);
  dyd_status st = dyd_real_narrow_until(x, 1000000, 1000000, &a.stop, &err);
  double late = alarm_late(&a);
  assert_int_equal(DYD_CANCELLED, st);
  if (late > SPARE) fail_msg("ended %.1f s late", late);
  assert_int_equal(before, dyd_interval_bits(dyd_real_interval(x)));
  narrowed(x, 200, 4096);
  dyd_real_free(x);
}

/* (2^B x - m) (x^D + ... + x + 1): the sign at the root is known after B D bits only. */
static void test_root(void **state) {
  enum { DEGREE = 900, BITS = 2000 };
  (void)state;
  mpq_t coeff[DEGREE + 2], lo, hi;
  mpz_t m, power;
  alarm a;
  dyd_error err;
  dyd_real *x;
  mpz_inits(m, power, NULL);
  mpq_inits(lo, hi, NULL);
  mpz_ui_pow_ui(m, 3, 1260); /* about 2^1997: the root is near 1/8 */
  mpz_setbit(power, BITS);
  for (int k = 0; k <= DEGREE + 1; k++) {
    mpq_init(coeff[k]);
    if (k) mpz_add(mpq_numref(coeff[k]), mpq_numref(coeff[k]), power);
    if (k <= DEGREE) mpz_sub(mpq_numref(coeff[k]), mpq_numref(coeff[k]), m);
  }
  mpq_set_ui(hi, 1, 1);
  assert_int_equal(DYD_OK, dyd_real_root(&x, (const mpq_t *)coeff, DEGREE + 2, lo, hi, &err));
  alarm_start(&a, 0.5);
  dyd_status st = dyd_real_narrow_until(x, 100000, 100000, &a.stop, &err);
  double late = alarm_late(&a);
  if (late > SPARE) fail_msg("ended %.1f s late", late);
  assert_true(late < 0 ? st >= 0 : st == DYD_CANCELLED);
  narrowed(x, 100, 4096);
  dyd_real_free(x);
  for (int k = 0; k <= DEGREE + 1; k++) mpq_clear(coeff[k]);
  mpq_clears(lo, hi, NULL);
  mpz_clears(m, power, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_functions), cmocka_unit_test(test_expression),
                                     cmocka_unit_test(test_root)};
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
