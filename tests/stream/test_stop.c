/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A flag that is set while one function, or one step to a root, is at work on millions of digits: the call ends within
 * a second, says so, and earlier bounds stay known. */
#include "harness.h"

#include "base/clock.h"
#include "rect/rect.h"
#include "stream/algebra/form.h"
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
    f.stop = NULL; /* the stopped value is computed anew */
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

/* A polynomial whose coefficients are 0, and the interval of a root of it. */
enum { MOST = 900 };
typedef struct polynomial {
  size_t degree;
  mpq_t coeff[MOST + 1], lo, hi;
} polynomial;

static void polynomial_init(polynomial *p, size_t degree) {
  p->degree = degree;
  for (size_t k = 0; k <= degree; k++) mpq_init(p->coeff[k]);
  mpq_inits(p->lo, p->hi, NULL);
}

/* The root; the polynomial is cleared. */
static dyd_real *polynomial_root(polynomial *p) {
  dyd_error err;
  dyd_real *x;
  assert_int_equal(DYD_OK, dyd_real_root(&x, (const mpq_t *)p->coeff, p->degree + 1, p->lo, p->hi, &err));
  for (size_t k = 0; k <= p->degree; k++) mpq_clear(p->coeff[k]);
  mpq_clears(p->lo, p->hi, NULL);
  return x;
}

/* The given bits take longer than the given seconds, after which the flag is set, and soon seen. */
static void is_stopped(dyd_real *x, int64_t bits, double seconds) {
  alarm a;
  dyd_error err;
  alarm_start(&a, seconds);
  dyd_status st = dyd_real_narrow_until(x, bits, bits, &a.stop, &err);
  double late = alarm_late(&a);
  if (late > SPARE) fail_msg("ended %.1f s late", late);
  assert_int_equal(DYD_CANCELLED, st);
}

/* x^900 - 2: at 2^17 bits the next step, which doubles them, takes some three seconds. */
static void test_root(void **state) {
  enum { DEGREE = 900, BITS = 1 << 17 };
  (void)state;
  polynomial p;
  polynomial_init(&p, DEGREE);
  mpq_set_si(p.coeff[0], -2, 1);
  mpq_set_si(p.coeff[DEGREE], 1, 1);
  mpq_set_ui(p.lo, 1, 1);
  mpq_set_ui(p.hi, 2, 1);
  dyd_real *x = polynomial_root(&p);
  narrowed(x, BITS, BITS);
  int64_t before = dyd_interval_bits(dyd_real_interval(x));
  is_stopped(x, 2 * BITS, 0.1);
  assert_int_equal(before, dyd_interval_bits(dyd_real_interval(x)));
  dyd_real_free(x);
}

/* x^40 - 2 (2^3000 x - 1)^2: its two roots near 2^-3000 are 2^-63000 apart, so that thousands of bits take as
 * many steps, each of them short, and made at once. */
static void test_close_roots(void **state) {
  enum { DEGREE = 40, POWER = 3000, BITS = 6000 };
  (void)state;
  polynomial p;
  polynomial_init(&p, DEGREE);
  mpq_set_si(p.coeff[0], -2, 1);
  mpq_set_si(p.coeff[1], 4, 1);
  mpq_mul_2exp(p.coeff[1], p.coeff[1], POWER);
  mpq_set_si(p.coeff[2], -2, 1);
  mpq_mul_2exp(p.coeff[2], p.coeff[2], 2 * POWER);
  mpq_set_si(p.coeff[DEGREE], 1, 1);
  mpq_set_ui(p.hi, 1, 1);
  mpq_div_2exp(p.hi, p.hi, POWER);
  dyd_real *x = polynomial_root(&p);
  is_stopped(x, BITS, 0.2);
  narrowed(x, 100, 4096);
  dyd_real_free(x);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_functions), cmocka_unit_test(test_expression),
                                     cmocka_unit_test(test_root), cmocka_unit_test(test_close_roots)};
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
