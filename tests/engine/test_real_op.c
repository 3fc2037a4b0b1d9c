/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reals made of callbacks by operations, and callbacks that are claimed to be roots: values, identities, errors; ties
 * and certificates that rest on them. */
#include "engine/help.h"

#include "base/error.h"
#include "rect/rect.h"
#include "stream/algebra/form.h"
#include "stream/algebra/zero.h"
#include <dyadel/certificate.h>

#include <stdio.h>
#include <string.h>

/* A callback that gives the answers of a parsed text, without its expression. */
static dyd_status narrow_inner(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_status st = dyd_real_narrow(user, request->bits, request->max_bits, err);
  if (dyd_failed(st)) return st;
  dyd_interval_set(out, dyd_real_interval(user));
  return dyd_real_is_final(user) && !dyd_interval_is_point(out) ? DYD_FIXED : DYD_OK;
}

static void release_inner(void *user) {
  dyd_real_free(user);
}

static dyd_real *parse(const char *text) {
  dyd_real *x = NULL;
  assert_int_equal(dyd_real_parse(&x, text, strlen(text), NULL), DYD_OK);
  return x;
}

static dyd_real *callback(const char *text) {
  dyd_real *x = NULL;
  assert_int_equal(dyd_real_new(&x, narrow_inner, release_inner, parse(text)), DYD_OK);
  return x;
}

/* x op y; references are taken over. */
static dyd_real *make(dyd_real_operation op, dyd_real *x, dyd_real *y) {
  dyd_real *out = NULL;
  dyd_error err;
  dyd_error_clear(&err);
  if (dyd_real_op(&out, x, y, op, &err) != DYD_OK) fail_msg("%s", err.message);
  return out;
}

/* Both hold one value: they meet, and are narrow. */
static void expect_same(dyd_real *x, const char *text) {
  dyd_real *y = parse(text);
  for (int64_t bits = 10; bits <= 400; bits += 130) {
    assert_false(dyd_failed(dyd_real_narrow(x, bits, 1000, NULL)));
    assert_false(dyd_failed(dyd_real_narrow(y, bits, 1000, NULL)));
    if (!dyd_interval_meets(dyd_real_interval(x), dyd_real_interval(y))) fail_msg("not %s", text);
    assert_true(dyd_interval_bits(dyd_real_interval(x)) >= bits);
  }
  dyd_real_free(y);
  dyd_real_free(x);
}

static void test_values(void **state) {
  static const struct {
    dyd_real_operation op;
    const char *x, *y, *value;
  } row[] = {{DYD_REAL_ADD, "sqrt(2)", "pi", "sqrt(2)+pi"},
             {DYD_REAL_SUB, "sqrt(2)", "pi", "sqrt(2)-pi"},
             {DYD_REAL_MUL, "sqrt(2)", "-pi", "-sqrt(2)*pi"},
             {DYD_REAL_DIV, "sqrt(2)", "pi", "sqrt(2)/pi"},
             {DYD_REAL_MIN, "sqrt(2)", "pi", "sqrt(2)"},
             {DYD_REAL_MAX, "sqrt(2)", "pi", "pi"},
             {DYD_REAL_NEG, "pi", NULL, "-pi"},
             {DYD_REAL_ABS, "-pi", NULL, "pi"},
             {DYD_REAL_SQRT, "pi", NULL, "sqrt(pi)"},
             {DYD_REAL_CBRT, "-pi", NULL, "cbrt(-pi)"},
             {DYD_REAL_EXP, "pi", NULL, "exp(pi)"},
             {DYD_REAL_LOG, "pi", NULL, "log(pi)"},
             {DYD_REAL_SIN, "sqrt(2)", NULL, "sin(sqrt(2))"},
             {DYD_REAL_COS, "sqrt(2)", NULL, "cos(sqrt(2))"},
             {DYD_REAL_TAN, "sqrt(2)", NULL, "tan(sqrt(2))"},
             {DYD_REAL_ASIN, "1/sqrt(2)", NULL, "asin(1/sqrt(2))"},
             {DYD_REAL_ACOS, "-1/sqrt(2)", NULL, "acos(-1/sqrt(2))"},
             {DYD_REAL_ATAN, "pi", NULL, "atan(pi)"},
             {DYD_REAL_SINH, "pi", NULL, "sinh(pi)"},
             {DYD_REAL_COSH, "pi", NULL, "cosh(pi)"},
             {DYD_REAL_TANH, "pi", NULL, "tanh(pi)"}};
  (void)state;
  for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
    assert_int_equal((size_t)row[k].op, k);
    expect_same(make(row[k].op, callback(row[k].x), row[k].y ? callback(row[k].y) : NULL), row[k].value);
    expect_same(make(row[k].op, parse(row[k].x), row[k].y ? callback(row[k].y) : NULL), row[k].value);
  }
  expect_same(make(DYD_REAL_SQRT, parse("2"), NULL), "sqrt(2)");
  expect_same(make(DYD_REAL_ADD, parse("1/3"), callback("pi")), "1/3+pi");
}

/* Exact operands give exact values, intervals intervals for good. */
static void test_exact(void **state) {
  (void)state;
  dyd_real *x = make(DYD_REAL_DIV, parse("1/3"), parse("7"));
  assert_true(dyd_real_is_final(x) && dyd_interval_is_point(dyd_real_interval(x)));
  expect_same(x, "1/21");
  x = make(DYD_REAL_SQRT, parse("9/4"), NULL);
  assert_true(dyd_real_is_final(x));
  expect_same(x, "3/2");
  x = make(DYD_REAL_ADD, parse("[1,2]"), parse("1/3"));
  assert_int_equal(dyd_real_narrow(x, 40, 100, NULL), DYD_FIXED);
  assert_true(dyd_real_is_final(x) && !dyd_interval_is_point(dyd_real_interval(x)));
  dyd_real_free(x);
  x = make(DYD_REAL_ADD, parse("[1,2]"), callback("pi"));
  assert_false(dyd_failed(dyd_real_narrow(x, 40, 100, NULL)));
  assert_false(dyd_real_is_final(x)); /* pi can be narrowed */
  dyd_real_free(x);
}

static void expect_refused(dyd_status st, dyd_real_operation op, dyd_real *x, dyd_real *y) {
  dyd_real *out = NULL;
  dyd_error err;
  dyd_error_clear(&err);
  assert_int_equal(dyd_real_op(&out, x, y, op, &err), st);
  assert_null(out);
  assert_true(err.message[0]);
}

static void test_refused(void **state) {
  (void)state;
  expect_refused(DYD_E_ARG, DYD_REAL_ADD, parse("1"), NULL);
  expect_refused(DYD_E_ARG, DYD_REAL_SQRT, parse("1"), callback("pi"));
  expect_refused(DYD_E_ARG, DYD_REAL_SQRT, NULL, NULL);
  expect_refused(DYD_E_ARG, DYD_REAL_ADD, NULL, parse("2"));
  expect_refused(DYD_E_ARG, (dyd_real_operation)99, parse("1"), NULL);
  expect_refused(DYD_E_DOMAIN, DYD_REAL_SQRT, parse("-1"), NULL);
  expect_refused(DYD_E_DOMAIN, DYD_REAL_DIV, parse("1"), parse("0"));
  expect_refused(DYD_E_DOMAIN, DYD_REAL_LOG, parse("0"), NULL);
  dyd_real *x = make(DYD_REAL_SQRT, callback("-pi"), NULL);
  assert_int_equal(dyd_real_narrow(x, 20, 100, NULL), DYD_E_DOMAIN);
  dyd_real_free(x);
  x = callback("pi");
  for (int k = 0; k < 1000; k++) x = make(DYD_REAL_NEG, x, NULL);
  assert_false(dyd_failed(dyd_real_narrow(x, 20, 100, NULL)));
  expect_refused(DYD_E_RANGE, DYD_REAL_NEG, x, NULL);
}

/* ---- known facts about them ---- */

/* Is x - y proved to be 0? References are taken over. */
static dyd_zero compare_reals(dyd_real *x, dyd_real *y) {
  dyd_algebra a;
  assert_int_equal(dyd_algebra_open(&a, 4096, NULL), DYD_OK);
  uint32_t n[2] = {dyd_forms_real(&a.forms, x), dyd_forms_real(&a.forms, y)};
  assert_int_equal(dyd_algebra_settle(&a, n, 2), DYD_OK);
  dyd_zero zero = dyd_algebra_test(&a, dyd_forms_binary(&a.forms, DYD_OP_SUB, n[0], n[1]));
  dyd_algebra_close(&a);
  dyd_real_free(x);
  dyd_real_free(y);
  return zero;
}

/* (a + b)^2 and a^2 + b^2 + 2 a b; the second with c instead of b. */
static dyd_zero compare_squares(dyd_real *a, dyd_real *b, dyd_real *c) {
  dyd_real *sum = make(DYD_REAL_ADD, dyd_real_ref(a), dyd_real_ref(b));
  dyd_real *square = make(DYD_REAL_MUL, dyd_real_ref(sum), sum);
  dyd_real *aa = make(DYD_REAL_MUL, dyd_real_ref(a), dyd_real_ref(a)), *cc = make(DYD_REAL_MUL, dyd_real_ref(c), c);
  dyd_real *ac = make(DYD_REAL_MUL, a, dyd_real_ref(c));
  dyd_real *two = make(DYD_REAL_ADD, dyd_real_ref(ac), ac);
  dyd_real_free(b);
  return compare_reals(square, make(DYD_REAL_ADD, make(DYD_REAL_ADD, aa, cc), two));
}

static void test_identities(void **state) {
  (void)state;
  dyd_real *b = callback("pi");
  assert_int_equal(compare_squares(callback("sqrt(2)"), b, dyd_real_ref(b)), DYD_ZERO_PROVED);
  assert_int_equal(compare_squares(callback("sqrt(2)"), callback("pi"), callback("pi")), DYD_ZERO_UNKNOWN);
  assert_int_equal(compare_squares(callback("sqrt(2)"), callback("pi"), callback("3")), DYD_ZERO_UNKNOWN);
  /* of parsed texts more is known */
  assert_int_equal(compare_squares(parse("sqrt(2)"), parse("pi"), parse("pi")), DYD_ZERO_PROVED);
  b = callback("pi");
  assert_int_equal(
      compare_reals(make(DYD_REAL_COS, dyd_real_ref(b), NULL), make(DYD_REAL_COS, make(DYD_REAL_NEG, b, NULL), NULL)),
      DYD_ZERO_PROVED);
}

/* ---- claims ---- */

/* x is said to be the root in [lo,hi] of x^2 - c. */
static dyd_status claim(dyd_real *x, int c, const char *lo, const char *hi) {
  mpq_t coeff[3], end[2];
  for (int k = 0; k < 3; k++) mpq_init(coeff[k]);
  mpq_inits(end[0], end[1], NULL);
  mpq_set_si(coeff[0], -c, 1);
  mpq_set_si(coeff[2], 1, 1);
  mpq_set_str(end[0], lo, 10);
  mpq_set_str(end[1], hi, 10);
  dyd_status st = dyd_real_claim_root(x, (const mpq_t *)coeff, 3, end[0], end[1], NULL);
  mpq_clears(end[0], end[1], NULL);
  for (int k = 0; k < 3; k++) mpq_clear(coeff[k]);
  return st;
}

static void test_claims(void **state) {
  (void)state;
  dyd_real *x = callback("sqrt(2)");
  assert_int_equal(claim(x, 2, "1", "2"), DYD_OK);
  assert_int_equal(claim(x, 2, "1", "2"), DYD_E_ARG); /* once */
  assert_false(dyd_failed(dyd_real_narrow(x, 500, 500, NULL)));
  assert_int_equal(compare_reals(dyd_real_ref(x), parse("sqrt(8)/2")), DYD_ZERO_PROVED);
  assert_int_equal(compare_reals(dyd_real_ref(x), parse("-sqrt(2)")), DYD_ZERO_REFUTED);
  dyd_real *other = callback("sqrt(2)");
  assert_int_equal(claim(other, 2, "5/4", "3/2"), DYD_OK);
  assert_int_equal(compare_reals(x, other), DYD_ZERO_PROVED);
  x = callback("3/2");                                 /* a rational root */
  assert_int_equal(claim(x, 0, "-1", "1"), DYD_E_ARG); /* a double root */
  dyd_real_free(x);
}

static void test_claims_refused(void **state) {
  (void)state;
  dyd_real *x = callback("sqrt(2)");
  assert_int_equal(claim(x, 2, "2", "3"), DYD_E_ARG);  /* no root */
  assert_int_equal(claim(x, 2, "-2", "2"), DYD_E_ARG); /* no change of signs */
  assert_int_equal(claim(x, 3, "1", "2"), DYD_OK);     /* x has no bound yet */
  assert_int_equal(dyd_real_narrow(x, 60, 100, NULL), DYD_E_NESTING);
  dyd_real_free(x);
  x = callback("sqrt(2)");
  assert_false(dyd_failed(dyd_real_narrow(x, 60, 100, NULL)));
  assert_int_equal(claim(x, 3, "1", "2"), DYD_E_NESTING); /* known already */
  assert_int_equal(claim(x, 2, "1", "2"), DYD_OK);        /* it was as before */
  dyd_real_free(x);
  x = parse("sqrt(2)");
  assert_int_equal(claim(x, 2, "1", "2"), DYD_E_ARG); /* parsed values are known */
  dyd_real_free(x);
  x = parse("2");
  assert_int_equal(claim(x, 4, "1", "3"), DYD_E_ARG);
  dyd_real_free(x);
}

/* x^3 - 3 x + 1 has three roots in [-2,2]; signs differ at the ends. */
static void test_several_roots(void **state) {
  mpq_t coeff[4], end[2];
  (void)state;
  for (int k = 0; k < 4; k++) mpq_init(coeff[k]);
  mpq_inits(end[0], end[1], NULL);
  mpq_set_si(coeff[0], 1, 1);
  mpq_set_si(coeff[1], -3, 1);
  mpq_set_si(coeff[3], 1, 1);
  mpq_set_si(end[0], -2, 1);
  mpq_set_si(end[1], 2, 1);
  dyd_real *x = callback("2*cos(2*pi/9)");
  assert_int_equal(dyd_real_claim_root(x, (const mpq_t *)coeff, 4, end[0], end[1], NULL), DYD_E_ARG);
  mpq_set_si(end[0], 1, 1);
  assert_int_equal(dyd_real_claim_root(x, (const mpq_t *)coeff, 4, end[0], end[1], NULL), DYD_OK);
  assert_int_equal(compare_reals(x, parse("2*cos(2*pi/9)")), DYD_ZERO_PROVED);
  mpq_clears(end[0], end[1], NULL);
  for (int k = 0; k < 4; k++) mpq_clear(coeff[k]);
}

/* ---- points ---- */

static void add_point(dyd_engine *e, dyd_real *x, dyd_real *y) {
  dyd_stream *s = NULL;
  assert_int_equal(dyd_stream_from_reals(&s, x, y), DYD_OK);
  assert_int_equal(dyd_engine_add_stream(e, s, NULL), DYD_OK);
}

/* The corners (x,y), (-y,x), (-x,-y), (y,-x). */
static dyd_engine *square(dyd_real *x, dyd_real *y) {
  dyd_engine *e = engine_new();
  for (int k = 0; k < 4; k++) {
    dyd_real *minus = make(DYD_REAL_NEG, dyd_real_ref(y), NULL);
    add_point(e, dyd_real_ref(x), y);
    y = x;
    x = minus;
  }
  dyd_real_free(x);
  dyd_real_free(y);
  return e;
}

static void expect_certificate(const dyd_engine *e, unsigned gaps) {
  char *text = NULL;
  size_t size;
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  FILE *out = open_memstream(&text, &size);
  assert_int_equal(dyd_write_certificate(out, e, NULL, NULL), DYD_OK);
  fclose(out);
  FILE *in = fmemopen(text, size, "r");
  if (dyd_verify_certificate(&r, in, NULL, &err) != DYD_OK) fail_msg("%zu: %s\n%s", err.line, err.message, text);
  fclose(in);
  if (r.gaps != gaps) fail_msg("gaps %u in place of %u:\n%s", r.gaps, gaps, text);
  free(text);
}

/* A square turned by an unknown angle is one; a certificate cannot enclose a callback, and names a claim. */
static void test_points(void **state) {
  (void)state;
  for (int claimed = 0; claimed < 2; claimed++) {
    dyd_real *x = callback("sqrt(2)"), *y = callback("sqrt(3)");
    size_t count[4];
    if (claimed) assert_int_equal(claim(x, 2, "1", "2"), DYD_OK);
    if (claimed) assert_int_equal(claim(y, 3, "1", "2"), DYD_OK);
    dyd_engine *e = square(x, y);
    engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
    engine_count(count, e);
    assert_int_equal(count[DYD_LEGAL], 4);
    assert_int_equal(count[DYD_TIE], 2);
    expect_certificate(e, claimed ? DYD_GAP_CLAIMS : DYD_GAP_TIES | DYD_GAP_OUTCOME);
    dyd_engine_free(e);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_values),        cmocka_unit_test(test_exact),
                                     cmocka_unit_test(test_refused),       cmocka_unit_test(test_identities),
                                     cmocka_unit_test(test_claims),        cmocka_unit_test(test_claims_refused),
                                     cmocka_unit_test(test_several_roots), cmocka_unit_test(test_points)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
