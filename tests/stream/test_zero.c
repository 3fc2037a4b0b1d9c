/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [IDN-1] [SEP-1] The zero test: values that are 0 and have to be proved so, values that are not 0 and must never be,
 * unknown ones. */
#include "harness.h"

#include "rect/rect.h"
#include "stream/algebra/form.h"
#include "stream/algebra/zero.h"

#include <stdio.h>

#define TIE_BITS ((int64_t)1 << 17)

/* Are two coordinates the same number? *reduces (may be NULL): is their difference 0 as a polynomial? */
static dyd_zero compare_ways(bool *reduces, dyd_zero_counts *count, const char *left, const char *right, int64_t bits) {
  dyd_real *x[2] = {parsed(left), parsed(right)};
  dyd_algebra a;
  assert_int_equal(dyd_algebra_open(&a, bits, NULL), DYD_OK);
  uint32_t n[2] = {dyd_forms_real(&a.forms, x[0]), dyd_forms_real(&a.forms, x[1])};
  assert_true(n[0] != DYD_NONE && n[1] != DYD_NONE);
  assert_int_equal(dyd_algebra_settle(&a, n, 2), DYD_OK);
  dyd_zero zero = dyd_algebra_test(&a, dyd_forms_binary(&a.forms, DYD_OP_SUB, n[0], n[1]));
  if (count) *count = a.count;
  const dyd_fraction *f = dyd_ring_fraction(&a.ring, dyd_forms_binary(&a.forms, DYD_OP_SUB, n[0], n[1]));
  bool same = f && fmpz_mpoly_is_zero(f->num, a.ring.ctx);
  if (reduces) *reduces = same;
  if (same && zero != DYD_ZERO_PROVED) fail_msg("%s and %s reduce to the same", left, right);
  dyd_algebra_close(&a);
  dyd_real_free(x[0]);
  dyd_real_free(x[1]);
  return zero;
}

static dyd_zero compare(dyd_zero_counts *count, const char *left, const char *right, int64_t bits) {
  return compare_ways(NULL, count, left, right, bits);
}

static void expect(dyd_zero zero, const char *left, const char *right) {
  dyd_zero found = compare(NULL, left, right, TIE_BITS);
  if (found != zero) fail_msg("%s against %s: %d, not %d", left, right, found, zero);
}

static void test_equal(void **state) {
  static const char *const pair[][2] = {
      {"sqrt(8)", "2*sqrt(2)"},
      {"sqrt(2)*sqrt(2)", "2"},
      {"2*sin(pi/6)", "1"},
      {"cbrt(2+sqrt(5))+cbrt(2-sqrt(5))", "1"},
      {"pi+e", "e+pi"},
      {"exp(1)*pi", "pi*e"},
      {"sqrt(2)*sqrt(3)", "sqrt(6)"},
      {"sqrt(12)-sqrt(3)", "sqrt(3)"},
      {"sqrt(3+2*sqrt(2))", "1+sqrt(2)"},
      {"sqrt(2)+sqrt(3)", "sqrt(5+2*sqrt(6))"},
      {"cos(pi/5)", "(1+sqrt(5))/4"},
      {"cos(pi/17)^2+sin(pi/17)^2", "1"},
      {"cos(1)^2+sin(-1)^2", "1"},
      {"tan(pi/8)", "sqrt(2)-1"},
      {"1/(1+sqrt(2))", "sqrt(2)-1"},
      {"cosh(sqrt(2))^2-sinh(sqrt(2))^2", "1"},
      {"tanh(pi)*cosh(pi)", "sinh(pi)"},
      {"exp(-pi)*exp(pi)", "1"},
      {"abs(1-sqrt(2))", "sqrt(2)-1"},
      {"min(sqrt(2),sqrt(3))", "sqrt(2)"},
      {"max(pi,3)", "pi"},
      {"log(2)*3", "3*log(2)"},
      {"sqrt(1+sqrt(2))*sqrt(1+sqrt(2))", "1+sqrt(2)"},
      {"sqrt((2+sqrt(2))/4)", "cos(pi/8)"},
      {"cbrt(16)", "2*cbrt(2)"},
      {"cbrt(-2)", "-cbrt(2)"},
      {"root(x^2-2,1,2)", "sqrt(2)"},
      {"root((x^2-2)*(x^3-3),1,143/100)", "sqrt(2)"},
      {"root((x^2-2)*(x^3-3),143/100,2)", "cbrt(3)"},
      {"root(x^5-x-1,1,2)", "root(2*x^5-2*x-2,1,3/2)"},
      {"root(8*x^3-6*x-1,1/2,1)", "cos(pi/9)"},
      {"root(x^4-10*x^2+1,3,4)", "sqrt(2)+sqrt(3)"},
      {"2*cos(2*pi/7)*2*cos(4*pi/7)*2*cos(6*pi/7)", "1"},
      {"sqrt(0*pi+2)", "sqrt(2)"},
      {"sqrt(1000000007*1000000009)", "sqrt(1000000007)*sqrt(1000000009)"},
      {"(sqrt(2)+1)^40*(sqrt(2)-1)^40", "1"},
      {"sqrt(2+sqrt(2+sqrt(2)))/2", "cos(pi/16)"},
      {"atan(1)*4", "4*atan(1)"},
  };
  (void)state;
  for (size_t k = 0; k < sizeof pair / sizeof *pair; k++) {
    expect(DYD_ZERO_PROVED, pair[k][0], pair[k][1]);
    expect(DYD_ZERO_PROVED, pair[k][1], pair[k][0]);
  }
}

/* Equalities that hold on every branch are proved by the identity alone: the difference reduces to 0. */
static void test_identities(void **state) {
  static const char *const pair[][2] = {
      {"sqrt(8)", "2*sqrt(2)"},
      {"sqrt(2)*sqrt(2)", "2"},
      {"2*sin(pi/6)", "1"},
      {"pi+e", "e+pi"},
      {"sqrt(2)*sqrt(3)", "sqrt(6)"},
      {"cos(pi/17)^2+sin(pi/17)^2", "1"},
      {"cos(1)^2+sin(-1)^2", "1"},
      {"cosh(sqrt(2))^2-sinh(sqrt(2))^2", "1"},
      {"abs(1-sqrt(2))", "sqrt(2)-1"},
      {"sqrt(1+sqrt(2))*sqrt(1+sqrt(2))", "1+sqrt(2)"},
      {"cbrt(16)", "2*cbrt(2)"},
      {"cbrt(-2)", "-cbrt(2)"},
      {"cbrt(1-sqrt(2))", "-cbrt(sqrt(2)-1)"},
      {"root(x^2-2,1,2)", "sqrt(2)"},
      {"root(x^2-2,-2,-1)", "-sqrt(2)"},
      {"root((x^2-2)*(x^3-3),1,143/100)", "sqrt(2)"},
      {"root(2*x^5-2*x-2,1,3/2)", "root(x^5-x-1,1,2)"},
      {"root(3*x^2-6*x+1,0,1)", "1-sqrt(6)/3"},
      {"2*cos(2*pi/7)*2*cos(4*pi/7)*2*cos(6*pi/7)", "1"},
      {"cos(2*pi/9)+cos(8*pi/9)", "cos(5*pi/9)+0*sin(pi/5)"},
      {"cos(3*pi/11)", "-cos(8*pi/11)"},
      {"sin(3*pi/11)", "cos(5*pi/22)"},
      {"tan(pi/7)*cos(pi/7)", "sin(pi/7)"},
  };
  (void)state;
  for (size_t k = 0; k < sizeof pair / sizeof *pair; k++) {
    bool reduces;
    compare_ways(&reduces, NULL, pair[k][0], pair[k][1], TIE_BITS);
    if (!reduces) fail_msg("%s and %s do not reduce to the same", pair[k][0], pair[k][1]);
  }
}

/* Wrong branches, conjugates, other factors, values that are close. */
static void test_different(void **state) {
  static const char *const pair[][2] = {
      {"sqrt(6)", "-sqrt(2)*sqrt(3)"},
      {"sqrt(3-2*sqrt(2))", "1-sqrt(2)"},
      {"sqrt(2)", "-sqrt(2)"},
      {"cos(2*pi/7)", "cos(4*pi/7)"},
      {"sin(pi/7)", "sin(2*pi/7)"},
      {"cbrt(2+sqrt(5))", "1"},
      {"root((x^2-2)*(x^2-3),1,3/2)", "sqrt(3)"},
      {"root((x^2-2)*(x^2-3),8/5,2)", "sqrt(2)"},
      {"root(x^3-3*x+1,0,1)", "root(x^3-3*x+1,1,2)"},
      {"root(x^3-3*x+1,-2,-1)", "root(x^3-3*x+1,1,2)"},
      {"sqrt(2)", "1.41421356237309504880168872420969807856967187537694"},
      {"exp(pi*sqrt(163))", "262537412640768744"},
      {"sqrt(2)", "sqrt(2+2^-3000)"},
      {"sqrt(2)+2^-3000", "sqrt(2)"},
      {"cos(pi/1001)", "cos(pi/1003)"},
      {"abs(1-sqrt(2))", "1-sqrt(2)"},
      {"min(sqrt(2),sqrt(3))", "sqrt(3)"},
      {"pi", "22/7"},
      {"pi+2^-2000", "pi"},
      {"sin(1)", "sin(-1)"},
  };
  (void)state;
  for (size_t k = 0; k < sizeof pair / sizeof *pair; k++) {
    expect(DYD_ZERO_REFUTED, pair[k][0], pair[k][1]);
    expect(DYD_ZERO_REFUTED, pair[k][1], pair[k][0]);
  }
}

static void test_unknown(void **state) {
  static const char *const pair[][2] = {
      {"pi", "4*atan(1)"},         {"exp(sqrt(2))*exp(sqrt(3))", "exp(sqrt(2)+sqrt(3))"},
      {"log(6)", "log(2)+log(3)"}, {"sin(2)", "2*sin(1)*cos(1)"},
      {"sqrt(pi^2)", "pi"},        {"exp(log(2))", "2"},
  };
  (void)state;
  for (size_t k = 0; k < sizeof pair / sizeof *pair; k++) expect(DYD_ZERO_UNKNOWN, pair[k][0], pair[k][1]);
}

/* f of n primes added up, and again the other way round; f is the text before the prime, which ")" follows. */
static void expect_sums(const char *f, int n, dyd_zero zero, dyd_zero_counts *count) {
  char left[2048] = "0", right[2048] = "0", term[40], keep[2048];
  for (int p = 3, k = 0; k < n; p += 2) {
    bool prime = true;
    for (int q = 3; q * q <= p; q += 2) prime = prime && p % q;
    if (!prime) continue;
    k++;
    snprintf(term, sizeof term, "%s%d)", f, p);
    strcat(strcat(left, "+"), term);
    snprintf(keep, sizeof keep, "%s+%.1990s", term, right);
    memcpy(right, keep, sizeof right);
  }
  dyd_zero found = compare(count, left, right, TIE_BITS);
  if (found != zero) fail_msg("%d %s: %d, not %d", n, f, found, zero);
}

/* Roots of k-th powers of many primes have one leaf in common. */
static void test_powers_in_radicands(void **state) {
  (void)state;
  for (int cube = 0; cube < 2; cube++) {
    char left[8192] = "0", right[40];
    long sum = 0;
    for (int k = 1; k <= 200; k++) {
      size_t end = strlen(left);
      long radicand = cube ? 16L * k * k * k : 8L * k * k;
      snprintf(left + end, sizeof left - end, "+%s(%ld)", cube ? "cbrt" : "sqrt", radicand);
      sum += 2L * k;
    }
    snprintf(right, sizeof right, "%ld*%s(2)", sum, cube ? "cbrt" : "sqrt");
    assert_int_equal(compare(NULL, left, right, TIE_BITS), DYD_ZERO_PROVED);
  }
}

/* Forms are so many, and so deep, and no more. */
static void test_forms_caps(void **state) {
  (void)state;
  mpq_t q;
  dyd_forms f;
  uint32_t n, deep = 0;
  mpq_init(q);
  dyd_forms_init(&f);
  n = dyd_forms_leaf(&f, DYD_OP_PI);
  while (n != DYD_NONE && deep <= DYD_FORMS_DEPTH) n = dyd_forms_unary(&f, DYD_OP_SIN, n, 0), deep++;
  assert_true(n == DYD_NONE && deep > DYD_FORMS_DEPTH - 2 && !f.failed);
  for (unsigned long k = 0; k < DYD_FORMS_MOST; k++) {
    mpq_set_ui(q, k, 1);
    n = dyd_forms_number(&f, q);
  }
  assert_true(n == DYD_NONE && f.count == DYD_FORMS_MOST && !f.failed);
  dyd_forms_clear(&f);
  mpq_clear(q);
}

/* Each cap is met: nothing is claimed, quickly. */
static void test_caps(void **state) {
#define X "(1+pi+e+log(2))"
  static const char *const unknown[][2] = {
      {"cos(pi/1000003)^2", "(1+cos(2*pi/1000003))/2"}, /* order */
      {"sqrt(1+2^20000)*sqrt(3)", "sqrt(3+3*2^20000)"}, /* bits of the base */
      {"(3^4000+pi)^60", "(pi+3^4000)^59*(3^4000+pi)"}, /* bits */
      {X "^45*(log(2)+e+pi+1)^45", X "^90"},            /* terms */
      {"sqrt(" X "^38+1)*" X "^13*sqrt(" X "^38+1)",
       X "^13*sqrt(" X "^38+1)*sqrt(" X "^38+1)"},                 /* terms times terms of a reduction */
      {"sqrt(2)^5000", "2^2500"},                                  /* exponent */
      {"abs(sqrt(2)-sqrt(2+2^-3000))", "sqrt(2+2^-3000)-sqrt(2)"}, /* a sign */
      {"(1+sqrt(2)+sqrt(3)+sqrt(5)+pi+e)^300", "(e+pi+sqrt(5)+sqrt(3)+sqrt(2)+1)^300"},
      {"(pi+sqrt(2))^5000", "(pi+sqrt(2))^4999*(sqrt(2)+pi)"},
  };
#undef X
  (void)state;
  for (size_t k = 0; k < sizeof unknown / sizeof *unknown; k++) {
    dyd_zero_counts c;
    dyd_zero zero = compare(&c, unknown[k][0], unknown[k][1], TIE_BITS);
    if (zero != DYD_ZERO_UNKNOWN) fail_msg("%s: %d", unknown[k][0], zero);
  }
  /* degrees without a bound do not hinder the identity */
  dyd_zero_counts c;
  expect_sums("sqrt(", 50, DYD_ZERO_PROVED, &c);
  assert_int_equal(c.by_identity, 1);
  expect_sums("sqrt(", 80, DYD_ZERO_UNKNOWN, &c); /* elements of the base, and leaves */
  expect_sums("log(", 80, DYD_ZERO_UNKNOWN, &c);  /* leaves */
  /* by few bits nothing that needs more is proved, and nothing else changes */
  assert_int_equal(compare(NULL, "cbrt(2+sqrt(5))+cbrt(2-sqrt(5))", "1", 128), DYD_ZERO_PROVED);
  assert_int_equal(compare(NULL, "cbrt(2+sqrt(5))+cbrt(2-sqrt(5))", "1", 16), DYD_ZERO_UNKNOWN);
}

/* ---- random expressions ---- */

static const char *const leaf[] = {"sqrt(2)",         "sqrt(3)",   "sqrt(6)", "sqrt(2+sqrt(2))",
                                   "cbrt(2)",         "cos(pi/5)", "1/3",     "sin(2*pi/5)",
                                   "cbrt(1+sqrt(3))", "2",         "sqrt(5)", "sqrt(2-sqrt(2))"};

static test_random chance;

static size_t random_below(size_t n) {
  return (size_t)test_below(&chance, n);
}

static void random_text(char *out, size_t size, int depth) {
  if (depth == 0 || random_below(4) == 0) {
    snprintf(out, size, "%s", leaf[random_below(sizeof leaf / sizeof *leaf)]);
    return;
  }
  char a[2048], b[2048];
  random_text(a, sizeof a, depth - 1);
  random_text(b, sizeof b, depth - 1);
  snprintf(out, size, "(%s%c%s)", a, "+-*"[random_below(3)], b);
}

/* p (q + r) against p q + p r: always the same number, which identities prove where the bits do not suffice for a
 * bound, and bounds elsewhere. */
static void test_random_identities(void **state) {
  size_t by_identity = 0, by_bound = 0;
  (void)state;
  chance = test_random_start("identities");
  for (size_t k = 0; k < test_cases(150); k++) {
    char p[2048], q[2048], r[2048], left[8192], right[16384];
    random_text(p, sizeof p, 2);
    random_text(q, sizeof q, 2);
    random_text(r, sizeof r, 2);
    snprintf(left, sizeof left, "%s*(%s+%s)", p, q, r);
    snprintf(right, sizeof right, "%s*%s+%s*%s", p, r, p, q);
    dyd_zero_counts with, without;
    assert_int_equal(compare(&without, left, right, 16), DYD_ZERO_PROVED);
    by_identity += without.by_identity;
    assert_int_equal(compare(&with, left, right, TIE_BITS), DYD_ZERO_PROVED);
    by_bound += with.by_bound;
    snprintf(right, sizeof right, "%s*%s+%s*%s+2^-%lu", p, r, p, q, (unsigned long)(1 + random_below(3000)));
    expect(DYD_ZERO_REFUTED, left, right);
  }
  print_message("of %zu by identity %zu, by bounds %zu\n", test_cases(150), by_identity, by_bound);
  assert_true(2 * by_identity > test_cases(150) && 3 * by_bound > test_cases(150));
}

/* Four points of a circle, or three of a line, given by random expressions; one of them moved by 2^-k, k to 3000, or
 * not. */
static void random_tie(char point[4][2][600], bool line) {
  char r[200], c[100];
  snprintf(r, sizeof r, "(%s)", leaf[random_below(sizeof leaf / sizeof *leaf)]);
  snprintf(c, sizeof c, "%s", leaf[random_below(sizeof leaf / sizeof *leaf)]);
  size_t n = 5 + random_below(20), first = random_below(n);
  for (size_t k = 0; k < 4; k++) {
    size_t at = first + k;
    if (line) {
      snprintf(point[k][0], sizeof point[k][0], "%s*%zu+%s", r, at, c);
      snprintf(point[k][1], sizeof point[k][1], "%s*%zu-%zu/7", c, at, n);
    } else {
      snprintf(point[k][0], sizeof point[k][0], "%s*cos(2*pi*%zu/%zu)+%s", r, at, n, c);
      snprintf(point[k][1], sizeof point[k][1], "%s*sin(2*pi*%zu/%zu)-1/3", r, at, n);
    }
  }
}

/* Are they on one circle, or the first three on one line? */
static dyd_zero tie_zero(char point[4][2][600], bool line) {
  dyd_real *x[4][2];
  dyd_form_point at[4];
  dyd_algebra a;
  assert_int_equal(dyd_algebra_open(&a, TIE_BITS, NULL), DYD_OK);
  for (int k = 0; k < 4; k++) {
    for (int m = 0; m < 2; m++) x[k][m] = parsed(point[k][m]);
    at[k] = (dyd_form_point){dyd_forms_real(&a.forms, x[k][0]), dyd_forms_real(&a.forms, x[k][1])};
  }
  assert_int_equal(dyd_algebra_settle(&a, &at->x, 8), DYD_OK);
  uint32_t n = line ? dyd_forms_collinear(&a.forms, at) : dyd_forms_cocircular(&a.forms, at);
  dyd_zero zero = dyd_algebra_test(&a, n);
  dyd_algebra_close(&a);
  for (int k = 0; k < 8; k++) dyd_real_free(x[k / 2][k % 2]);
  return zero;
}

/* With DYADEL_TEST_SCALE=100, 10^5 of them. */
static void test_moved_ties(void **state) {
  (void)state;
  chance = test_random_start("moved ties");
  for (size_t k = 0; k < test_cases(1000); k++) {
    char point[4][2][600], more[40];
    bool line = random_below(2);
    random_tie(point, line);
    char *moved = point[random_below(3)][random_below(2)];
    size_t bits = 1 + random_below(k % 10 ? 300 : 3000);
    if (k % 20 == 0 && tie_zero(point, line) != DYD_ZERO_PROVED)
      fail_msg("no tie: %s %s, %s %s ...", point[0][0], point[0][1], point[1][0], point[1][1]);
    snprintf(more, sizeof more, "%c2^-%zu", "+-"[random_below(2)], bits);
    strcat(moved, more);
    dyd_zero zero = tie_zero(point, line);
    /* along its circle a point is off by no more than the square, which may be too little for the bits allowed */
    bool small = !line && bits > 1500;
    if (zero == DYD_ZERO_PROVED || (zero == DYD_ZERO_UNKNOWN && !small))
      fail_msg("%d, 2^-%zu: %s in %s %s ...", zero, bits, moved, point[0][0], point[0][1]);
  }
}

/* The two ways to a proof, each alone, against many digits. */
static void test_ways_agree(void **state) {
  int proved = 0;
  (void)state;
  chance = test_random_start("ways");
  for (size_t k = 0; k < test_cases(400); k++) {
    char text[8192];
    random_text(text, sizeof text, 3);
    dyd_real *x = parsed(text);
    dyd_algebra a;
    assert_int_equal(dyd_algebra_open(&a, TIE_BITS, NULL), DYD_OK);
    uint32_t n = dyd_forms_real(&a.forms, x), square = dyd_forms_binary(&a.forms, DYD_OP_MUL, n, n);
    /* n (n - near) for the nearest integer `near`: 0 now and then */
    dyd_zero zero = DYD_ZERO_UNKNOWN;
    if (n != DYD_NONE && square != DYD_NONE) {
      assert_int_equal(dyd_algebra_settle(&a, &n, 1), DYD_OK);
      zero = dyd_algebra_test(&a, n);
      bool tiny = arb_contains_zero(dyd_forms_value(&a.forms, n, 4096));
      const dyd_fraction *f = dyd_ring_fraction(&a.ring, n);
      if (zero == DYD_ZERO_PROVED && !tiny) fail_msg("%s is not 0", text);
      if (zero == DYD_ZERO_REFUTED && tiny) fail_msg("%s is 0 to 4096 bits", text);
      if (f && fmpz_mpoly_is_zero(f->num, a.ring.ctx) && zero != DYD_ZERO_PROVED) fail_msg("%s reduces to 0", text);
      assert_true(zero != DYD_ZERO_UNKNOWN);
      proved += zero == DYD_ZERO_PROVED;
    }
    dyd_algebra_close(&a);
    dyd_real_free(x);
  }
  print_message("%d of 400 are 0\n", proved);
}

/* ---- callbacks ---- */

static dyd_status say_two(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  mpq_t q;
  (void)user, (void)request, (void)err;
  mpq_init(q);
  mpq_set_ui(q, 2, 1);
  dyd_status st = dyd_interval_set_q(out, q);
  mpq_clear(q);
  return st;
}

/* A callback is itself, and nothing else is known of it. */
static void test_callbacks(void **state) {
  (void)state;
  dyd_real *x = NULL, *y = NULL;
  assert_int_equal(dyd_real_new(&x, say_two, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_real_new(&y, say_two, NULL, NULL), DYD_OK);
  dyd_algebra a;
  assert_int_equal(dyd_algebra_open(&a, TIE_BITS, NULL), DYD_OK);
  uint32_t n[3] = {dyd_forms_real(&a.forms, x), dyd_forms_real(&a.forms, y), dyd_forms_real(&a.forms, x)};
  assert_int_equal(dyd_algebra_settle(&a, n, 3), DYD_OK);
  assert_int_equal(dyd_algebra_test(&a, dyd_forms_binary(&a.forms, DYD_OP_SUB, n[0], n[2])), DYD_ZERO_PROVED);
  assert_int_equal(dyd_algebra_test(&a, dyd_forms_binary(&a.forms, DYD_OP_SUB, n[0], n[1])), DYD_ZERO_UNKNOWN);
  dyd_algebra_close(&a);
  dyd_real_free(x);
  dyd_real_free(y);
}

/* An interval around a computable value is not a number. */
static void test_intervals(void **state) {
  static const char *const text[] = {"sqrt(2)+-0.1", "[1,2]", "1.5+-0.5"};
  (void)state;
  for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
    dyd_real *x = parsed(text[k]);
    dyd_forms f;
    dyd_forms_init(&f);
    assert_true(dyd_forms_real(&f, x) == DYD_NONE);
    dyd_forms_clear(&f);
    dyd_real_free(x);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_equal),
      cmocka_unit_test(test_identities),
      cmocka_unit_test(test_different),
      cmocka_unit_test(test_unknown),
      cmocka_unit_test(test_caps),
      cmocka_unit_test(test_powers_in_radicands),
      cmocka_unit_test(test_forms_caps),
      cmocka_unit_test(test_callbacks),
      cmocka_unit_test(test_intervals),
      cmocka_unit_test(test_ways_agree),
      cmocka_unit_test(test_random_identities),
      cmocka_unit_test(test_moved_ties),
  };
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
