/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Intervals of logarithms, inverse tangents, sines and cosines against libm, at few digits and at many [CERT-10]: that
 * of an interval, however wide, holds the values at its ends and between them; that of a point is as narrow as it
 * should be; where nothing can be known, nothing is. */
#include "checker/enclosure.h"
#include "support/random.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>
#include <math.h>

typedef struct inverse_case {
  const char *name;
  void (*enclose)(dyd_cert_enclosure *x, long p);
  void (*from)(dyd_cert_enclosure *out, const dyd_cert_enclosure *x, mpz_srcptr y, long p); /* or NULL */
  long double (*value)(long double x);
  double least, most; /* where it is defined */
} inverse_case;

static const inverse_case functions[] = {
    {"log", dyd_cert_enclosure_log, dyd_cert_enclosure_log_from, logl, 0x1p-1000, INFINITY},
    {"atan", dyd_cert_enclosure_atan, dyd_cert_enclosure_atan_from, atanl, -INFINITY, INFINITY},
    {"asin", dyd_cert_enclosure_asin, NULL, asinl, -1, 1},
    {"acos", dyd_cert_enclosure_acos, NULL, acosl, -1, 1}};
enum { FUNCTIONS = sizeof functions / sizeof *functions };
static size_t known_from;

/* An integer of at most the given number of bits, small ones as often as large ones. */
static int64_t any_size(test_random *r, int bits) {
  int64_t z = (int64_t)(test_u64(r) >> (64 - (1 + test_below(r, (uint64_t)bits))));
  return test_below(r, 2) ? z : -z;
}

static void expect_held(const inverse_case *f, const dyd_cert_enclosure *y, int64_t x, long p, int64_t lo, int64_t hi) {
  long double at = ldexpl((long double)x, (int)-p);
  if (at < f->least || at > f->most) return;
  long double v = ldexpl(f->value(at), (int)p), slack = 1e-9L + fabsl(v) * 0x1p-55L;
  if (v < mpz_get_d(y->lo) - slack || v > mpz_get_d(y->hi) + slack) {
    gmp_fprintf(stderr, "%s of %ld to %ld, by 2^-%ld: %Zd to %Zd, but at %ld it is %f\n", f->name, (long)lo, (long)hi,
                p, y->lo, y->hi, (long)x, (double)v);
    fail();
  }
}

/* The same for enclosures from any place, some near, some far off. */
static void expect_held_from(const inverse_case *f, test_random *r, int64_t lo, int64_t hi, long p) {
  dyd_cert_enclosure x, y;
  mpz_t from;
  mpz_init(from);
  dyd_cert_enclosure_init(&x);
  dyd_cert_enclosure_init(&y);
  mpz_set_si(x.lo, lo);
  mpz_set_si(x.hi, hi);
  mpz_set_si(from, (int64_t)test_below(r, (uint64_t)1 << (p + 4)) - ((int64_t)1 << (p + 3)));
  f->from(&y, &x, from, p);
  if (y.known) {
    known_from++;
    expect_held(f, &y, lo, p, lo, hi);
    expect_held(f, &y, hi, p, lo, hi);
  }
  dyd_cert_enclosure_clear(&y);
  dyd_cert_enclosure_clear(&x);
  mpz_clear(from);
}

/* y is unbounded only where x leaves the domain of the function, or is too wide. */
static void try_interval(const inverse_case *f, test_random *r, int64_t lo, int64_t hi, long p) {
  dyd_cert_enclosure y;
  dyd_cert_enclosure_init(&y);
  mpz_set_si(y.lo, lo);
  mpz_set_si(y.hi, hi);
  f->enclose(&y, p);
  bool reaches = f->least > 0 && lo <= 0;
  if (reaches ? y.known : !y.known)
    fail_msg("%s of %ld to %ld, by 2^-%ld: known %d", f->name, (long)lo, (long)hi, p, y.known);
  if (y.known) {
    expect_held(f, &y, lo, p, lo, hi);
    expect_held(f, &y, hi, p, lo, hi);
    for (int k = 0; k < 3 && hi > lo; k++)
      expect_held(f, &y, lo + (int64_t)test_below(r, (uint64_t)(hi - lo)), p, lo, hi);
  }
  if (y.known && lo == hi) { /* the derivative of asin, acos is below 3 where they are asked to be narrow */
    mpz_sub(y.hi, y.hi, y.lo);
    int64_t unit = (int64_t)1 << p;
    if ((f->most > 1 || (10 * lo < 9 * unit && 10 * lo > -9 * unit)) && mpz_cmp_ui(y.hi, 12) > 0)
      fail_msg("%s of %ld by 2^-%ld: too wide", f->name, (long)lo, p);
  }
  dyd_cert_enclosure_clear(&y);
}

static void intervals(void **state) {
  (void)state;
  test_random r = test_random_start("intervals");
  for (size_t k = 0; k < test_cases(60000); k++) {
    const inverse_case *f = &functions[test_below(&r, FUNCTIONS)];
    long p = 1 + (long)test_below(&r, 40);
    int64_t unit = (int64_t)1 << p, lo = any_size(&r, f->most > 1 ? 50 : (int)p), hi = any_size(&r, 50);
    if (f->least > 0 && test_below(&r, 8)) lo = lo < 0 ? -lo : lo;
    if (test_below(&r, 3) == 0) lo = (test_below(&r, 2) ? unit : -unit) + any_size(&r, 3);
    if (f->most <= 1 && (lo > unit || lo < -unit)) lo = unit;
    hi = test_below(&r, 4) ? lo + (hi < 0 ? -hi : hi) : lo;
    try_interval(f, &r, lo, hi, p);
    if (f->from && (f->least < 0 || lo > 0)) expect_held_from(f, &r, lo, hi, p);
  }
  assert_true(20 * known_from > test_cases(60000));
}

/* An unbounded value stays unbounded, or is too large. */
static void unknown(void **state) {
  (void)state;
  for (size_t k = 0; k < FUNCTIONS; k++) {
    dyd_cert_enclosure y;
    dyd_cert_enclosure_init(&y);
    mpz_set_ui(y.lo, 1);
    mpz_set_ui(y.hi, 2);
    y.known = false;
    functions[k].enclose(&y, 10);
    assert_false(y.known);
    mpz_ui_pow_ui(y.hi, 2, 40000);
    y.known = true;
    functions[k].enclose(&y, 10);
    assert_false(y.known && functions[k].most == 1);
    dyd_cert_enclosure_clear(&y);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(intervals), cmocka_unit_test(unknown)};
  return cmocka_run_group_tests_name("inverse functions", tests, NULL, NULL);
}
