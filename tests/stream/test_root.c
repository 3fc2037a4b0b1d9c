/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Roots of polynomials against exact signs in rationals [ROOT-1] [ROOT-2]: the interval always holds a sign change
 * of the polynomial as given, or is the exact root. */
#include "harness.h"
#include "rect/rect.h"

#define MAX_COUNT 16

typedef struct problem {
  mpq_t coeff[MAX_COUNT];
  size_t count;
  mpq_t lo, hi;
} problem;

static void problem_init(problem *p) {
  for (size_t k = 0; k < MAX_COUNT; k++) mpq_init(p->coeff[k]);
  mpq_inits(p->lo, p->hi, NULL);
  p->count = 0;
}

static void problem_clear(problem *p) {
  for (size_t k = 0; k < MAX_COUNT; k++) mpq_clear(p->coeff[k]);
  mpq_clears(p->lo, p->hi, NULL);
}

static int sign_at(const problem *p, const mpq_t x) {
  mpq_t y;
  mpq_init(y);
  for (size_t k = p->count; k-- > 0;) {
    mpq_mul(y, y, x);
    mpq_add(y, y, p->coeff[k]);
  }
  int sign = mpq_sgn(y);
  mpq_clear(y);
  return sign;
}

static dyd_status solve(dyd_real **x, const problem *p) {
  dyd_error err;
  dyd_error_clear(&err);
  return dyd_real_root(x, (const mpq_t *)p->coeff, p->count, p->lo, p->hi, &err);
}

/* Is there a sign change or an exact root in the interval, and is it inside [lo,hi]? */
static void check_bracket(const problem *p, const dyd_interval *a, bool simple) {
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  dyd_interval_get_q(lo, hi, a);
  if (mpq_equal(lo, hi)) {
    assert_int_equal(sign_at(p, lo), 0);
  } else {
    assert_true(mpq_cmp(hi, p->lo) > 0 && mpq_cmp(lo, p->hi) < 0);
    if (mpq_cmp(lo, p->lo) < 0) mpq_set(lo, p->lo);
    if (mpq_cmp(hi, p->hi) > 0) mpq_set(hi, p->hi);
    int product = sign_at(p, lo) * sign_at(p, hi);
    if (simple ? product >= 0 : product > 0) {
      for (size_t k = 0; k < p->count; k++) gmp_fprintf(stderr, "# %Qd x^%zu\n", p->coeff[k], k);
      gmp_fprintf(stderr, "# on [%Qd,%Qd]\n", p->lo, p->hi);
      gmp_fprintf(stderr, "# in [%Qd,%Qd]\n", lo, hi);
      fail_msg("no sign change");
    }
  }
  mpq_clears(lo, hi, NULL);
}

static void check_problem(const problem *p, bool simple) {
  static const int64_t steps[] = {-2, 5, 30, 31, 64, 300, 2000};
  dyd_real *x = NULL, *jump = NULL;
  dyd_interval before;
  dyd_interval_init(&before);
  assert_int_equal(solve(&x, p), DYD_OK);
  assert_int_equal(solve(&jump, p), DYD_OK);
  for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
    const dyd_interval *now = narrowed(x, steps[i], 4000);
    /* a coarse interval is rounded outward and may hold more roots */
    if (steps[i] >= 30) check_bracket(p, now, simple);
    assert_true(dyd_interval_bits(now) >= steps[i]);
    if (i) assert_true(dyd_interval_contains(&before, now));
    dyd_interval_set(&before, now);
  }
  /* asked for at once, it is the same root */
  const dyd_interval *at_once = narrowed(jump, 2000, 4000);
  check_bracket(p, at_once, simple);
  assert_true(dyd_interval_meets(&before, at_once));
  dyd_interval_clear(&before);
  dyd_real_free(jump);
  dyd_real_free(x);
}

static void random_rational(mpq_t q, test_random *r) {
  mpq_set_si(q, (long)test_between(r, -30, 30), (unsigned long)test_between(r, 1, test_chance(r, 2) ? 1 : 12));
  mpq_canonicalize(q);
}

/* coeff = (x - a) coeff */
static void times_linear(problem *p, const mpq_t a) {
  mpq_t t;
  mpq_init(t);
  for (size_t k = p->count; k > 0; k--) mpq_set(p->coeff[k], p->coeff[k - 1]);
  mpq_set_ui(p->coeff[0], 0, 1);
  p->count++;
  for (size_t k = 0; k + 1 < p->count; k++) {
    mpq_mul(t, a, p->coeff[k + 1]);
    mpq_sub(p->coeff[k], p->coeff[k], t);
  }
  mpq_clear(t);
}

/* Random coefficients, sometimes times a few linear factors, repeated ones among them. */
static void random_problem(problem *p, test_random *r) {
  mpq_t a;
  mpq_init(a);
  p->count = (size_t)test_between(r, 1, 8);
  for (size_t k = 0; k < MAX_COUNT; k++) mpq_set_ui(p->coeff[k], 0, 1);
  for (size_t k = 0; k < p->count; k++) random_rational(p->coeff[k], r);
  for (size_t k = test_below(r, 5); k > 0; k--) {
    if (k == 4 || test_chance(r, 2)) random_rational(a, r);
    times_linear(p, a);
  }
  random_rational(p->lo, r);
  random_rational(p->hi, r);
  if (mpq_cmp(p->lo, p->hi) > 0) mpq_swap(p->lo, p->hi);
  mpq_clear(a);
}

static void test_random_polynomials(void **state) {
  (void)state;
  test_random r = test_random_start("polynomials");
  size_t solved = 0;
  problem p;
  problem_init(&p);
  for (size_t n = test_cases(3000); n > 0; n--) {
    random_problem(&p, &r);
    bool zero = true;
    for (size_t k = 0; k < p.count; k++) zero &= mpq_sgn(p.coeff[k]) == 0;
    int left = sign_at(&p, p.lo), right = sign_at(&p, p.hi);
    if (!zero && left * right <= 0) {
      check_problem(&p, false);
      solved++;
    } else {
      dyd_real *x = NULL;
      assert_int_equal(solve(&x, &p), DYD_E_ARG);
      assert_null(x);
    }
  }
  fprintf(stderr, "# %zu roots\n", solved);
  problem_clear(&p);
}

static void expect(const char *text, const char *value) {
  dyd_real *x = parsed(text);
  const dyd_interval *a = narrowed(x, 3000, 4096);
  if (!dyd_real_is_final(x) || !is_exactly(a, value)) fail_msg("%s is not %s", text, value);
  dyd_real_free(x);
}

/* Roots met exactly: at an end, at a bisection point, at a point of the quadratic phase, by degree one. */
static void test_exact(void **state) {
  (void)state;
  expect("root(x^2-4,2,5)", "2");
  expect("root(x^2-4,-1,2)", "2");
  expect("root(x^2-4,-1,5)", "2");
  expect("root(x^3-x,-1/2,1/3)", "0");
  expect("root(x^2-1/9,0,1/3)", "1/3");
  expect("root((x-3)^2*(7*x-1),0,4)", "1/7");
  expect("root(x*(x-5),5,5)", "5");
  expect("root((4*x-1)*(x^2+1),0,1)", "1/4");
  expect("root((2^60*x-12345678901234567)*(x^2+x+1),0,1)", "12345678901234567/1152921504606846976");
}

/* 10,000 bits against MPFR, quickly: simple, odd multiple, clustered and far roots. */
static void test_many_bits(void **state) {
  (void)state;
  static const struct {
    const char *text;
    unsigned long radicand, index;
  } rows[] = {{"root(x^2-2,0,2)", 2, 2},
              {"root((x^2-2)^3,0,2)", 2, 2},
              {"root((x^2-2)^3*(x-3)^2,0,5)", 2, 2},
              {"root(x^100-7,0,2)", 7, 100},
              {"root(x^3-5,-1e30,1e30)", 5, 3},
              {"root((x^2-2)*(x-1414/1000)^2,0,2)", 2, 2},
              {"root(x^2-3,1.7320508,1.7320509)", 3, 2}};
  double start = seconds();
  mpfr_t v;
  mpfr_init2(v, 10100);
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    dyd_real *x = parsed(rows[i].text);
    const dyd_interval *a = narrowed(x, 10000, 10000);
    mpfr_set_ui(v, rows[i].radicand, MPFR_RNDN);
    mpfr_rootn_ui(v, v, rows[i].index, MPFR_RNDN);
    if (!holds(a, v, 10090) || dyd_interval_bits(a) < 10000) fail_msg("%s", rows[i].text);
    dyd_real_free(x);
  }
  mpfr_clear(v);
  assert_true(seconds() - start < 5);
}

/* Which of five roots is found does not depend on the widths asked for on the way. */
static void test_same_root(void **state) {
  (void)state;
  static const int64_t schedules[][4] = {
      {600, 600, 600, 600}, {1, 2, 3, 600}, {0, 9, 10, 600}, {4, 5, 77, 600}, {-5, 1, 30, 600}};
  test_random r = test_random_start("same root");
  for (size_t n = test_cases(200); n > 0; n--) {
    char text[200] = "root(x";
    for (int i = 0; i < 5; i++)
      sprintf(text + strlen(text), "*(x^2-%d/64)", (int)test_between(&r, 64 + 40 * i, 103 + 40 * i));
    sprintf(text + strlen(text), ",%d/10,%d/10)", (int)test_between(&r, 1, 9), (int)test_between(&r, 21, 60));
    dyd_real *first = parsed(text);
    narrowed(first, 600, 600);
    for (size_t k = 1; k < sizeof schedules / sizeof *schedules; k++) {
      dyd_real *x = parsed(text);
      for (size_t i = 0; i < 4; i++) narrowed(x, schedules[k][i], 600);
      if (!dyd_interval_meets(dyd_real_interval(first), dyd_real_interval(x))) fail_msg("%s: schedule %zu", text, k);
      dyd_real_free(x);
    }
    dyd_real_free(first);
  }
}

/* Very close roots (Mignotte): they are distinguished, and the sign change is real. */
static void test_close_roots(void **state) {
  (void)state;
  problem p;
  problem_init(&p);
  p.count = 10; /* x^9 - 2 (a x - 1)^2 with a = 10^10: two roots near 10^-10, some 2^-150 apart */
  mpq_set_si(p.coeff[9], 1, 1);
  mpq_set_str(p.coeff[2], "-200000000000000000000", 10);
  mpq_set_str(p.coeff[1], "40000000000", 10);
  mpq_set_si(p.coeff[0], -2, 1);
  mpq_set_str(p.hi, "1/10000000000", 10);
  mpq_set_si(p.lo, 0, 1);
  check_problem(&p, true);
  mpq_set(p.lo, p.hi);
  mpq_set_si(p.hi, 1, 1);
  check_problem(&p, true);
  problem_clear(&p);
}

/* Roots within expressions, against the same with sqrt and cbrt, which come another way: the intervals meet, are as
 * narrow as asked for, and nested. */
static void test_within_expressions(void **state) {
  (void)state;
  static const char *const forms[] = {"(%s+%s)*%s", "%s/(%s*%s)-7", "sqrt(%s)+exp(-%s)*%s", "min(%s,%s)-max(%s,2)",
                                      "(%s-3*%s)^3/%s"};
  test_random r = test_random_start("roots within expressions");
  for (size_t n = test_cases(300); n > 0; n--) {
    char root[3][60], other[3][60], text[2][300];
    for (int k = 0; k < 3; k++) {
      int a = (int)test_between(&r, 2, 500), cube = (int)test_below(&r, 2);
      sprintf(root[k], "root(x^%d-%d/7, 0, %d)", cube ? 3 : 2, a, a);
      sprintf(other[k], cube ? "cbrt(%d/7)" : "sqrt(%d/7)", a);
    }
    const char *form = forms[test_below(&r, sizeof forms / sizeof *forms)];
    sprintf(text[0], form, root[0], root[1], root[2]);
    sprintf(text[1], form, other[0], other[1], other[2]);
    dyd_real *x = parsed(text[0]), *y = parsed(text[1]);
    dyd_interval before;
    bool begun = false;
    dyd_interval_init(&before);
    for (int64_t bits = test_between(&r, 1, 40); bits < 2000; bits *= 3) {
      const dyd_interval *a = narrowed(x, bits, 4000);
      if (!dyd_interval_meets(a, narrowed(y, bits, 4000)) || dyd_interval_bits(a) < bits)
        fail_msg("%s: %d bits", text[0], (int)bits);
      if (begun && !dyd_interval_contains(&before, a)) fail_msg("%s is not nested", text[0]);
      dyd_interval_set(&before, a);
      begun = true;
    }
    dyd_interval_clear(&before);
    dyd_real_free(x);
    dyd_real_free(y);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_random_polynomials), cmocka_unit_test(test_exact),
      cmocka_unit_test(test_many_bits),          cmocka_unit_test(test_same_root),
      cmocka_unit_test(test_close_roots),        cmocka_unit_test(test_within_expressions)};
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
