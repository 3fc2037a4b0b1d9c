/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Expressions against MPFR at 4000 bits: inclusion [ENC-1] [ENC-2], widths, nestedness [NEST-2], edges of domains,
 * static ranges [RANGE-1]. */
#include "harness.h"

#include "rect/rect.h"
#include "stream/expr.h"

#define ORACLE_BITS 4000

typedef int (*mpfr_unary)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

static int oracle_sinh(mpfr_ptr out, mpfr_srcptr x, mpfr_rnd_t rnd) {
  return mpfr_sinh(out, x, rnd);
}

static const struct {
  const char *name;
  mpfr_unary f;
} functions[] = {{"sqrt", mpfr_sqrt}, {"cbrt", mpfr_cbrt}, {"exp", mpfr_exp},     {"log", mpfr_log},
                 {"sin", mpfr_sin},   {"cos", mpfr_cos},   {"tan", mpfr_tan},     {"asin", mpfr_asin},
                 {"acos", mpfr_acos}, {"atan", mpfr_atan}, {"sinh", oracle_sinh}, {"cosh", mpfr_cosh},
                 {"tanh", mpfr_tanh}, {"abs", mpfr_abs}};
#define FUNCTIONS (sizeof functions / sizeof *functions)

static void random_leaf(char *text, mpfr_t v, test_random *r) {
  switch (test_below(r, 6)) {
  case 0:
    strcpy(text, "pi");
    mpfr_const_pi(v, MPFR_RNDN);
    break;
  case 1:
    strcpy(text, "e");
    mpfr_set_ui(v, 1, MPFR_RNDN);
    mpfr_exp(v, v, MPFR_RNDN);
    break;
  case 2: {
    long a = (long)test_between(r, -20, 20), b = (long)test_between(r, 1, 9);
    sprintf(text, "(%ld/%ld)", a, b);
    mpfr_set_si(v, a, MPFR_RNDN);
    mpfr_div_si(v, v, b, MPFR_RNDN);
    break;
  }
  default: {
    long a = (long)test_between(r, 0, 40);
    sprintf(text, "%ld", a);
    mpfr_set_si(v, a, MPFR_RNDN);
  }
  }
}

/* Did the oracle meet a number beyond 2^1500, so that its error is large or a refusal in order? */
static bool met_huge;

static void random_tree(char *text, mpfr_t v, test_random *r, int depth);

static void random_binary(char *text, mpfr_t v, test_random *r, int depth) {
  static const char *const forms[] = {"(%s+%s)", "(%s-%s)", "%s*%s", "(%s/%s)", "min(%s,%s)", "max(%s,%s)"};
  char a[2000], b[2000];
  mpfr_t w;
  mpfr_init2(w, ORACLE_BITS);
  random_tree(a, v, r, depth - 1);
  random_tree(b, w, r, depth - 1);
  size_t k = test_below(r, 6);
  if (k == 2) {
    sprintf(text, "((%s)*(%s))", a, b);
  } else {
    sprintf(text, forms[k], a, b);
  }
  if (k == 0) mpfr_add(v, v, w, MPFR_RNDN);
  if (k == 1) mpfr_sub(v, v, w, MPFR_RNDN);
  if (k == 2) mpfr_mul(v, v, w, MPFR_RNDN);
  if (k == 3) mpfr_div(v, v, w, MPFR_RNDN);
  if (k == 4 || k == 5) { /* MPFR lets a number win over NaN: here undefined stays undefined */
    bool nan = mpfr_nan_p(v) || mpfr_nan_p(w);
    (k == 4 ? mpfr_min : mpfr_max)(v, v, w, MPFR_RNDN);
    if (nan) mpfr_set_nan(v);
  }
  mpfr_clear(w);
}

static void random_tree(char *text, mpfr_t v, test_random *r, int depth) {
  char a[2000];
  if (depth == 0) {
    random_leaf(text, v, r);
    return;
  }
  switch (test_below(r, 5)) {
  case 0:
  case 1: {
    size_t k = test_below(r, FUNCTIONS);
    random_tree(a, v, r, depth - 1);
    sprintf(text, "%s(%s)", functions[k].name, a);
    functions[k].f(v, v, MPFR_RNDN);
    break;
  }
  case 2: {
    long n = (long)test_between(r, -3, 5);
    random_tree(a, v, r, depth - 1);
    sprintf(text, "(-(%s)^%ld)", a, n);
    bool nan = mpfr_nan_p(v);
    mpfr_pow_si(v, v, n, MPFR_RNDN);
    mpfr_neg(v, v, MPFR_RNDN);
    if (nan) mpfr_set_nan(v);
    break;
  }
  default:
    random_binary(text, v, r, depth);
  }
  if (mpfr_number_p(v) && !mpfr_zero_p(v) && mpfr_get_exp(v) > 1500) met_huge = true;
  if (met_huge) mpfr_set_nan(v);      /* the oracle would take for ever */
  if (mpfr_inf_p(v)) mpfr_set_nan(v); /* undefined for good */
}

static void check_value(const char *text, dyd_real *x, const mpfr_t v) {
  static const int64_t steps[] = {-3, 20, 53, 64, 200, 320};
  dyd_interval before;
  dyd_interval_init(&before);
  for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
    dyd_error err;
    dyd_error_clear(&err);
    dyd_status st = dyd_real_narrow(x, steps[i], 6000, &err);
    if (st == DYD_E_DOMAIN && i == 0) break; /* at the edge of a domain, as the rounded oracle can't tell */
    if (st < 0) fail_msg("%s: status %d at %d bits: %s", text, st, (int)steps[i], err.message);
    const dyd_interval *now = dyd_real_interval(x);
    if (!holds(now, v, 400)) fail_msg("%s: the value is not inside at %d bits", text, (int)steps[i]);
    if (dyd_interval_bits(now) < steps[i]) fail_msg("%s: %d bits wanted", text, (int)steps[i]);
    if (i && !dyd_interval_contains(&before, now)) fail_msg("%s: not nested", text);
    dyd_interval_set(&before, now);
  }
  dyd_interval_clear(&before);
}

static void test_trees(void **state) {
  (void)state;
  test_random r = test_random_start("expression trees");
  size_t used = 0, refused = 0;
  mpfr_t v;
  mpfr_init2(v, ORACLE_BITS);
  for (size_t n = test_cases(1500); n > 0; n--) {
    char text[20000];
    met_huge = false;
    random_tree(text, v, &r, (int)test_between(&r, 1, 4));
    dyd_real *x = NULL;
    dyd_error err;
    dyd_status st = parse_text(&x, text, &err);
    if (st) { /* whatever is refused must be undefined or huge for the oracle too */
      if (mpfr_number_p(v) && !met_huge) fail_msg("%s: %s", text, err.message);
      refused++;
      continue;
    }
    if (met_huge) {
      st = dyd_real_narrow(x, 64, 500, &err);
      assert_true(st == DYD_OK || st == DYD_FIXED || st == DYD_E_RANGE || st == DYD_E_DOMAIN);
    } else if (!mpfr_number_p(v)) {
      assert_true(dyd_real_narrow(x, 64, 500, &err) < 0);
      assert_null(dyd_real_interval(x));
    } else {
      check_value(text, x, v);
      used++;
    }
    dyd_real_free(x);
  }
  fprintf(stderr, "# %zu trees compared, %zu refused\n", used, refused);
  mpfr_clear(v);
}

/* Computable at the edge of a domain, by the range that the argument always has. */
static void test_edges(void **state) {
  (void)state;
  static const struct {
    const char *text;
    double value;
  } rows[] = {{"sqrt(abs(sin(pi)))", 0},
              {"sqrt(sin(pi)^2)", 0},
              {"asin(sin(pi/2))", 1.5707963267948966},
              {"acos(cos(pi))", 3.1415926535897932},
              {"acos(tanh(1e6))", 0},
              {"asin(1)", 1.5707963267948966},
              {"asin(-1)", -1.5707963267948966},
              {"acos(-1)", 3.1415926535897932},
              {"asin(min(1,sqrt(2)^2/2))", 1.5707963267948966},
              {"sqrt(1-cos(2*pi)^2)", 0},
              {"sqrt(1+cos(pi))", 0},
              {"sqrt(max(0,sin(pi)))", 0},
              {"sqrt(-min(0,sin(pi)))", 0},
              {"sqrt(cosh(sin(pi))-1)", 0},
              {"sqrt(abs(sin(pi))*exp(1))", 0},
              {"cbrt(sin(pi))", 0},
              {"cbrt(-pi)", -1.4645918875615233},
              {"abs(sin(pi))", 0},
              {"exp(-1e30)", 0},
              {"tanh(-1e30)", -1},
              {"tanh(1e300000)", 1},
              {"atan(1e300000)", 1.5707963267948966},
              {"1e1000+pi-1e1000", 3.1415926535897932},
              {"sin(1e100)", -0.37237612366127667}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    dyd_real *x = parsed(rows[i].text);
    const dyd_interval *a = narrowed(x, 300, 2000);
    double lo, hi;
    dyd_interval_get_d(&lo, &hi, a);
    if (dyd_interval_bits(a) < 300) fail_msg("%s: too wide", rows[i].text);
    if (!(lo - 1e-15 <= rows[i].value && rows[i].value <= hi + 1e-15))
      fail_msg("%s: [%.17g,%.17g]", rows[i].text, lo, hi);
    dyd_real_free(x);
  }
}

/* A value on a small grid of rationals and one sample of each operation: ranges hold whatever operands are taken. */
static void apply_double(double *out, dyd_op op, double a, double b, long n) {
  mpfr_t x, y;
  mpfr_init2(x, 80);
  mpfr_init2(y, 80);
  mpfr_set_d(x, a, MPFR_RNDN);
  mpfr_set_d(y, b, MPFR_RNDN);
  if (op == DYD_OP_ADD) mpfr_add(x, x, y, MPFR_RNDN);
  if (op == DYD_OP_SUB) mpfr_sub(x, x, y, MPFR_RNDN);
  if (op == DYD_OP_MUL) mpfr_mul(x, x, y, MPFR_RNDN);
  if (op == DYD_OP_DIV) mpfr_div(x, x, y, MPFR_RNDN);
  if (op == DYD_OP_MIN) mpfr_min(x, x, y, MPFR_RNDN);
  if (op == DYD_OP_MAX) mpfr_max(x, x, y, MPFR_RNDN);
  if (op == DYD_OP_NEG) mpfr_neg(x, x, MPFR_RNDN);
  if (op == DYD_OP_POW) mpfr_pow_si(x, x, n, MPFR_RNDN);
  for (size_t k = 0; k < FUNCTIONS; k++) {
    if (!strcmp(functions[k].name, dyd_op_name(op))) functions[k].f(x, x, MPFR_RNDN);
  }
  *out = mpfr_get_d(x, MPFR_RNDN);
  mpfr_clear(y);
  mpfr_clear(x);
}

static bool in_range(double v, dyd_range r) {
  return (r.lo == -DYD_NO_END || v >= r.lo) && (r.hi == DYD_NO_END || v <= r.hi);
}

static void check_ranges(dyd_op op, dyd_range a, dyd_range b, long n) {
  static const double samples[] = {-8, -2, -1, -0.75, -0.125, 0, 0.125, 0.5, 1, 1.5, 2, 8};
  dyd_range out = dyd_range_apply(op, a, b, n);
  assert_true(out.lo == -DYD_NO_END || (out.lo >= -1 && out.lo <= 1));
  assert_true(out.hi == DYD_NO_END || (out.hi >= -1 && out.hi <= 1));
  for (size_t i = 0; i < 12; i++) {
    for (size_t j = 0; j < (dyd_op_is_binary(op) ? 12 : 1); j++) {
      double v;
      if (!in_range(samples[i], a) || (dyd_op_is_binary(op) && !in_range(samples[j], b))) continue;
      apply_double(&v, op, samples[i], samples[j], n);
      bool finite = v - v == 0;
      if (finite && !in_range(v, out)) fail_msg("%s(%g,%g)^%ld: outside", dyd_op_name(op), samples[i], samples[j], n);
    }
  }
}

static void test_ranges(void **state) {
  (void)state;
  static const signed char ends[] = {-DYD_NO_END, -1, 0, 1, DYD_NO_END};
  dyd_range all[25];
  size_t count = 0;
  for (size_t i = 0; i < 4; i++) {
    for (size_t j = 1; j < 5; j++) {
      if (ends[i] <= ends[j]) all[count++] = (dyd_range){ends[i], ends[j]};
    }
  }
  for (dyd_op op = DYD_OP_ADD; op <= DYD_OP_ABS; op++) {
    for (size_t i = 0; i < count; i++) {
      for (size_t j = 0; j < (dyd_op_is_binary(op) ? count : 1); j++) {
        for (long n = -3; n <= (op == DYD_OP_POW ? 3 : -3); n++) check_ranges(op, all[i], all[j], n);
      }
    }
  }
}

static void test_many_bits(void **state) {
  (void)state;
  static const char *const texts[] = {"sqrt(2)+pi/4", "cos(2*pi/7)", "(1+sqrt(5))/2", "exp(sin(1))-log(3)"};
  double start = seconds();
  for (size_t i = 0; i < 4; i++) {
    dyd_real *x = parsed(texts[i]);
    assert_true(dyd_interval_bits(narrowed(x, 10000, 10000)) >= 10000);
    /* the ends stay short */
    assert_true(dyd_real_interval(x)->lo.exp >= -10002);
    dyd_error err;
    dyd_error_clear(&err);
    assert_int_equal(dyd_real_narrow(x, (int64_t)1 << 40, (int64_t)1 << 40, &err), DYD_E_RANGE);
    dyd_real_free(x);
  }
  assert_true(seconds() - start < 5);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_trees), cmocka_unit_test(test_edges),
                                     cmocka_unit_test(test_ranges), cmocka_unit_test(test_many_bits)};
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
