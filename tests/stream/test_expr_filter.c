/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Expressions in doubles [FLT-EXPR] against MPFR intervals of 2500 bits, their rounding to a grid [FLT-GRID] against
 * exact rationals, and short constants. The programs are made by hand, so that nothing is folded. */
#include "stream/harness.h"

#include "rect/rect.h"
#include "stream/expr_filter.h"
#include "stream/real.h"
#include <math.h>

#define PREC 2500
#define NODES 40
#define DEEP 16

/* ---- the slow oracle: intervals of MPFR numbers ---- */

typedef struct span {
  mpfr_t lo, hi;
} span;

static void span_init(span *s) {
  mpfr_init2(s->lo, PREC);
  mpfr_init2(s->hi, PREC);
}

static void span_clear(span *s) {
  mpfr_clear(s->lo);
  mpfr_clear(s->hi);
}

typedef int (*corner_fn)(mpfr_ptr out, mpfr_srcptr a, mpfr_srcptr b, mpfr_rnd_t rnd);

/* a = the hull of f at the four corners, rounded outward. */
static void hull(span *a, const span *b, corner_fn f) {
  span out;
  mpfr_t t;
  span_init(&out);
  mpfr_init2(t, PREC);
  for (int k = 0; k < 4; k++) {
    mpfr_srcptr x = k & 1 ? a->hi : a->lo, y = k & 2 ? b->hi : b->lo;
    f(t, x, y, MPFR_RNDD);
    if (k == 0 || mpfr_less_p(t, out.lo)) mpfr_set(out.lo, t, MPFR_RNDD);
    f(t, x, y, MPFR_RNDU);
    if (k == 0 || mpfr_greater_p(t, out.hi)) mpfr_set(out.hi, t, MPFR_RNDU);
  }
  mpfr_swap(a->lo, out.lo);
  mpfr_swap(a->hi, out.hi);
  mpfr_clear(t);
  span_clear(&out);
}

static bool spans_zero(const span *a) {
  return mpfr_sgn(a->lo) <= 0 && mpfr_sgn(a->hi) >= 0;
}

/* Smallest or largest of both at both ends. */
static void extreme(span *a, const span *b, corner_fn f) {
  f(a->lo, a->lo, b->lo, MPFR_RNDD);
  f(a->hi, a->hi, b->hi, MPFR_RNDU);
}

static bool oracle_binary(span *a, dyd_op op, const span *b) {
  if (op == DYD_OP_ADD) hull(a, b, mpfr_add);
  if (op == DYD_OP_SUB) hull(a, b, mpfr_sub);
  if (op == DYD_OP_MUL) hull(a, b, mpfr_mul);
  if (op == DYD_OP_MIN) extreme(a, b, mpfr_min);
  if (op == DYD_OP_MAX) extreme(a, b, mpfr_max);
  if (op != DYD_OP_DIV) return true;
  if (spans_zero(b)) return false;
  hull(a, b, mpfr_div);
  return true;
}

static bool oracle_power(span *a, long n) {
  span base;
  if (mpfr_equal_p(a->lo, a->hi)) { /* both are the same number: powers of two stay quick */
    if (n < 0 && mpfr_zero_p(a->lo)) return false;
    mpfr_pow_si(a->lo, a->lo, n, MPFR_RNDD);
    mpfr_pow_si(a->hi, a->hi, n, MPFR_RNDU);
    return true;
  }
  span_init(&base);
  mpfr_set(base.lo, a->lo, MPFR_RNDD);
  mpfr_set(base.hi, a->hi, MPFR_RNDU);
  mpfr_set_ui(a->lo, 1, MPFR_RNDD);
  mpfr_set_ui(a->hi, 1, MPFR_RNDU);
  bool good = n >= 0 || !spans_zero(&base);
  for (long k = 0; good && k < labs(n); k++) hull(a, &base, n < 0 ? mpfr_div : mpfr_mul);
  span_clear(&base);
  return good;
}

static bool oracle_unary(span *a, const dyd_node *n) {
  if (n->op == DYD_OP_POW) return oracle_power(a, n->argument);
  if (n->op == DYD_OP_NEG) {
    mpfr_swap(a->lo, a->hi);
    mpfr_neg(a->lo, a->lo, MPFR_RNDD);
    mpfr_neg(a->hi, a->hi, MPFR_RNDU);
  } else if (n->op == DYD_OP_ABS) {
    bool zero = spans_zero(a);
    mpfr_abs(a->lo, a->lo, MPFR_RNDD);
    mpfr_abs(a->hi, a->hi, MPFR_RNDU);
    if (mpfr_greater_p(a->lo, a->hi)) mpfr_swap(a->lo, a->hi);
    if (zero) mpfr_set_zero(a->lo, 1);
  } else {
    if (mpfr_sgn(a->lo) < 0) return false;
    mpfr_sqrt(a->lo, a->lo, MPFR_RNDD);
    mpfr_sqrt(a->hi, a->hi, MPFR_RNDU);
  }
  return true;
}

static void oracle_leaf(span *a, const dyd_expr *e, const dyd_node *n) {
  dyd_constant_view view;
  for (int up = 0; up < 2; up++) {
    mpfr_ptr end = up ? a->hi : a->lo;
    mpfr_rnd_t rnd = up ? MPFR_RNDU : MPFR_RNDD;
    if (n->op == DYD_OP_CONST) mpfr_set_q(end, dyd_constant_get(&view, &e->constant[n->argument]), rnd);
    if (n->op == DYD_OP_PI) mpfr_const_pi(end, rnd);
    if (n->op != DYD_OP_E) continue;
    mpfr_set_ui(end, 1, rnd);
    mpfr_exp(end, end, rnd);
  }
}

/* out = the value; false: not surely defined. */
static bool oracle(span *out, const dyd_expr *e) {
  static span stack[DEEP];
  size_t top = 0;
  bool good = true;
  for (size_t k = 0; k < DEEP; k++) span_init(&stack[k]);
  for (size_t i = 0; good && i < e->count; i++) {
    const dyd_node *n = &e->node[i];
    if (dyd_op_is_leaf((dyd_op)n->op))
      oracle_leaf(&stack[top++], e, n);
    else if (dyd_op_is_binary((dyd_op)n->op))
      top--, good = oracle_binary(&stack[top - 1], (dyd_op)n->op, &stack[top]);
    else
      good = oracle_unary(&stack[top - 1], n);
  }
  mpfr_swap(out->lo, stack[0].lo);
  mpfr_swap(out->hi, stack[0].hi);
  for (size_t k = 0; k < DEEP; k++) span_clear(&stack[k]);
  return good;
}

/* ---- programs ---- */

typedef struct program {
  dyd_expr e;
  dyd_node node[NODES];
  dyd_constant constant[NODES];
} program;

static void program_clear(program *p) {
  *p = (program){.e = {.node = p->node, .constant = p->constant}};
}

static void add_node(program *p, dyd_op op, int32_t exponent) {
  const dyd_range any = {-DYD_NO_END, DYD_NO_END};
  dyd_node n = {
      .op = (unsigned char)op, .range = any, .argument = op == DYD_OP_CONST ? (int32_t)p->e.constants : exponent};
  p->node[p->e.count++] = n;
}

static void add_ratio(program *p, int64_t num, int64_t den) {
  add_node(p, DYD_OP_CONST, 0);
  p->constant[p->e.constants] = (dyd_constant){.den = 1};
  mpq_t q;
  mpq_init(q);
  mpq_set_si(q, num, (unsigned long)den);
  mpq_canonicalize(q);
  assert_int_equal(DYD_OK, dyd_constant_set(&p->constant[p->e.constants++], q));
  mpq_clear(q);
}

/* Returns true if the answer in doubles, if there is one, is right. */
static bool check_program(const program *p) {
  dyd_double_span d;
  span s;
  bool answered = dyd_filter_expr(&d, &p->e);
  if (!answered) return false;
  span_init(&s);
  assert_true(oracle(&s, &p->e));
  assert_true(d.lo <= d.hi && d.lo - d.lo == 0 && d.hi - d.hi == 0);
  assert_true(mpfr_cmp_d(s.hi, d.lo) >= 0 && mpfr_cmp_d(s.lo, d.hi) <= 0);
  assert_false((d.lo == 0 && signbit(d.lo)) || (d.hi == 0 && signbit(d.hi)));
  span_clear(&s);
  return true;
}

static void add_random_leaf(program *p, test_random *r) {
  static const int64_t ends[] = {0, 1, -1, 4, 9007199254740992, -9007199254740992, 9007199254740991, 3, 10};
  int kind = (int)test_below(r, 8);
  if (kind == 0) {
    add_node(p, test_below(r, 2) ? DYD_OP_PI : DYD_OP_E, 0);
  } else if (kind < 4) {
    int64_t den = (int64_t)(test_u64(r) >> (11 + test_below(r, 52)));
    add_ratio(p, ends[test_below(r, sizeof ends / sizeof *ends)], den < 1 ? 1 : den);
  } else {
    int64_t num = (int64_t)(test_u64(r) >> (11 + test_below(r, 52)));
    add_ratio(p, test_below(r, 2) ? num : -num, (int64_t)1 << test_below(r, 53));
  }
}

static void random_program(program *p, test_random *r) {
  static const dyd_op unary[] = {DYD_OP_NEG, DYD_OP_ABS, DYD_OP_SQRT, DYD_OP_SQRT, DYD_OP_POW, DYD_OP_POW};
  size_t open = 0, most = 2 + test_below(r, NODES - 2);
  program_clear(p);
  while (p->e.count + open < most || open != 1) {
    if (open == 0 || (open < 6 && p->e.count + open + 2 < most && test_below(r, 2))) {
      add_random_leaf(p, r);
      open++;
    } else if (open > 1 && (p->e.count + open >= most || test_below(r, 3))) {
      add_node(p, (dyd_op)(DYD_OP_ADD + test_below(r, 6)), 0);
      open--;
    } else {
      dyd_op op = unary[test_below(r, 6)];
      int32_t exponent = (int32_t)test_below(r, test_below(r, 3) ? 9 : 90) - 4;
      add_node(p, op, exponent);
    }
  }
}

static void test_random_programs(void **state) {
  (void)state;
  test_random r = test_random_start("programs in doubles");
  size_t answers = 0, n = test_cases(6000);
  for (size_t k = 0; k < n; k++) {
    program p;
    random_program(&p, &r);
    answers += check_program(&p);
  }
  assert_true(answers > n / 8); /* the cases are not all trivial */
}

/* a op b for all a, b among numbers at the ends of doubles: (2^e) (1 + k 2^-52) for large and small e, made by powers.
 */
static void add_power(program *p, int64_t num, int e) {
  add_ratio(p, num, (int64_t)1 << 52);
  add_ratio(p, 2, 1);
  add_node(p, DYD_OP_POW, e / 2);
  add_node(p, DYD_OP_MUL, 0);
  add_ratio(p, 2, 1);
  add_node(p, DYD_OP_POW, e - e / 2);
  add_node(p, DYD_OP_MUL, 0);
}

static void test_ends_of_doubles(void **state) {
  (void)state;
  static const int exponents[] = {-1130, -1075, -1074, -1073, -1022, -1021, -540, -53, -1,
                                  0,     1,     52,    511,   512,   1022,  1023, 1024};
  static const int64_t nums[] = {4503599627370496, 4503599627370497, -9007199254740991, 0};
  size_t count = sizeof exponents / sizeof *exponents, answers = 0;
  for (size_t k = 0; k < count * count * 16 * 6; k++) {
    program p;
    program_clear(&p);
    size_t i = k;
    dyd_op op = (dyd_op)(DYD_OP_ADD + i % 6);
    i /= 6;
    add_power(&p, nums[i % 4], exponents[i / 16 % count]);
    add_power(&p, nums[i / 4 % 4], exponents[i / 16 / count]);
    add_node(&p, op, 0);
    if (k % 3 == 0) add_node(&p, DYD_OP_ABS, 0);
    if (k % 3 == 0) add_node(&p, DYD_OP_SQRT, 0);
    answers += check_program(&p);
  }
  assert_true(answers > 1000);
}

/* Exact squares, roots of what only the range knows to be positive, and cases that must stay without an answer. */
static void test_special(void **state) {
  (void)state;
  program p;
  dyd_double_span d;
  for (int64_t k = 0; k < 1000; k++) {
    program_clear(&p);
    add_ratio(&p, k * k, 1);
    add_node(&p, DYD_OP_SQRT, 0);
    assert_true(check_program(&p));
    assert_true(dyd_filter_expr(&d, &p.e) && d.lo <= (double)k && d.hi >= (double)k && d.lo >= 0);
    assert_true(d.hi - d.lo <= 0x1p-42);
  }
  program_clear(&p);
  add_ratio(&p, -1, 3);
  add_node(&p, DYD_OP_SQRT, 0);
  assert_false(dyd_filter_expr(&d, &p.e));
  program_clear(&p);
  add_ratio(&p, 1, 3);
  add_ratio(&p, 1, 3);
  add_node(&p, DYD_OP_SUB, 0);
  add_node(&p, DYD_OP_SQRT, 0);
  assert_false(dyd_filter_expr(&d, &p.e));
  p.node[2].range = (dyd_range){0, DYD_NO_END};
  assert_true(dyd_filter_expr(&d, &p.e) && d.lo == 0 && d.hi > 0);
  p.node[3].op = DYD_OP_POW;
  p.node[3].argument = -2;
  assert_false(dyd_filter_expr(&d, &p.e));
  p.node[3].op = DYD_OP_SIN;
  assert_false(dyd_filter_expr(&d, &p.e));
}

/* More operands open at one time than there is room for. */
static void test_deep(void **state) {
  (void)state;
  for (size_t depth = 1; depth <= NODES / 2; depth++) {
    program p;
    dyd_double_span d;
    program_clear(&p);
    for (size_t k = 0; k < depth; k++) add_ratio(&p, 1, 3);
    for (size_t k = 1; k < depth; k++) add_node(&p, DYD_OP_ADD, 0);
    assert_int_equal(depth <= 16, dyd_filter_expr(&d, &p.e));
  }
}

/* ---- grids ---- */

static void check_grid(dyd_double_span a, int64_t bits) {
  dyd_double_span d;
  if (!dyd_filter_round(&d, a, bits)) return;
  assert_true(d.lo <= a.lo && a.hi <= d.hi);
  mpq_t q[2];
  mpq_inits(q[0], q[1], NULL);
  mpq_set_d(q[0], d.lo);
  mpq_set_d(q[1], d.hi);
  for (int k = 0; k < 2; k++) mpq_mul_2exp(q[k], q[k], (mp_bitcnt_t)bits + 2);
  if (a.lo < a.hi)
    for (int k = 0; k < 2; k++) assert_int_equal(0, mpz_cmp_ui(mpq_denref(q[k]), 1));
  mpq_sub(q[0], q[1], q[0]);
  assert_true(mpq_cmp_ui(q[0], 4, 1) <= 0);
  mpq_clears(q[0], q[1], NULL);
}

static void test_grids(void **state) {
  (void)state;
  test_random r = test_random_start("grids");
  for (size_t n = test_cases(100000); n > 0; n--) {
    int e = (int)test_below(&r, test_below(&r, 2) ? 60 : 1000) - 30;
    double lo = ldexp((double)test_u64(&r), -64 + e) * (test_below(&r, 2) ? 1 : -1), hi = lo;
    if (test_below(&r, 2))
      for (uint64_t k = test_below(&r, 4); k > 0; k--) hi = nextafter(hi, INFINITY);
    else
      hi = lo + ldexp((double)test_below(&r, 5), -(int)test_below(&r, 1090));
    if (hi > 0 && test_below(&r, 20) == 0) lo = -ldexp(1, -(int)test_below(&r, 1074));
    dyd_double_span a = {lo, hi}, d;
    int64_t most = dyd_filter_bits(a);
    if (most != INT64_MIN) assert_true(dyd_filter_round(&d, a, most));
    if (most != INT64_MAX) assert_false(dyd_filter_round(&d, a, most == INT64_MIN ? 0 : most + 1));
    assert_false(dyd_filter_round(&d, a, -1));
    for (int k = 0; k < 4 && most > 0 && most <= 1000; k++)
      check_grid(a, most - (k ? (int64_t)test_below(&r, (uint64_t)most) : 0));
    check_grid(a, (int64_t)test_below(&r, 1001));
  }
}

/* ---- reals ---- */

/* The first interval of a real contains later ones for more bits, and widths are as asked. */
static void check_glance(const char *text, int64_t first, int64_t later) {
  dyd_double_span d;
  dyd_interval whole;
  dyd_real *x = parsed(text);
  dyd_interval_init(&whole);
  int64_t most = dyd_real_glance_bits(x);
  assert_true(most > 20);
  if (first > most) first = most;
  assert_true(dyd_real_glance(&d, x, first));
  assert_int_equal(DYD_OK, dyd_interval_set_d(&whole, d.lo, d.hi));
  assert_true(dyd_interval_bits(&whole) >= first);
  const dyd_interval *now = narrowed(x, later, 4096);
  assert_true(dyd_interval_bits(now) >= later);
  if (later >= first && !dyd_interval_contains(&whole, now)) fail_msg("%s: %d, %d bits", text, (int)first, (int)later);
  assert_false(dyd_real_glance(&d, x, first));
  dyd_interval_set(&whole, now);
  assert_true(dyd_interval_contains(&whole, narrowed(x, later + 30, 4096)));
  dyd_interval_clear(&whole);
  dyd_real_free(x);
}

/* Values next to multiples of the grids: what doubles and balls know of them lies on different sides. */
static void test_glances(void **state) {
  (void)state;
  test_random r = test_random_start("glances");
  for (size_t n = test_cases(20000); n > 0; n--) {
    char text[100];
    int64_t first = test_between(&r, 0, 60), later = test_between(&r, 0, 130);
    snprintf(text, sizeof text, "%d*2^-%d%csqrt(%d)*2^-%d*2^-%d", (int)test_below(&r, 2000), (int)test_below(&r, 12),
             test_below(&r, 2) ? '+' : '-', (int)test_below(&r, 4) + 2, (int)test_below(&r, 50),
             (int)test_below(&r, 50));
    if (strstr(text, "sqrt(4)")) continue;
    check_glance(text, first, later);
  }
}

/* ---- constants ---- */

static void test_constants(void **state) {
  (void)state;
  static const char *const numbers[] = {"0",
                                        "1",
                                        "4611686018427387903",
                                        "4611686018427387904",
                                        "9223372036854775808",
                                        "18446744073709551616",
                                        "340282366920938463463374607431768211456"};
  size_t n = sizeof numbers / sizeof *numbers;
  mpq_t q;
  mpq_init(q);
  dyd_constant c = {.den = 1};
  for (size_t k = 0; k < 2 * n * n; k++) {
    dyd_constant_view view;
    mpz_set_str(mpq_numref(q), numbers[k % n], 10);
    mpz_set_str(mpq_denref(q), numbers[k / n % n], 10);
    if (!mpz_sgn(mpq_denref(q))) continue;
    if (k >= n * n) mpq_neg(q, q);
    mpq_canonicalize(q);
    assert_int_equal(DYD_OK, dyd_constant_set(&c, q));
    assert_true(mpq_equal(q, dyd_constant_get(&view, &c)));
    assert_int_equal(mpz_sizeinbase(mpq_numref(q), 2) + mpz_sizeinbase(mpq_denref(q), 2), dyd_constant_bits(&c));
    for (int s = -1; s <= 1; s++) {
      int sign = mpq_cmp_si(q, s, 1), got = dyd_constant_cmp(&c, s);
      assert_int_equal((sign > 0) - (sign < 0), (got > 0) - (got < 0));
    }
  }
  dyd_constant_clear(&c);
  mpq_clear(q);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_random_programs), cmocka_unit_test(test_ends_of_doubles),
                                     cmocka_unit_test(test_special),         cmocka_unit_test(test_deep),
                                     cmocka_unit_test(test_grids),           cmocka_unit_test(test_glances),
                                     cmocka_unit_test(test_constants)};
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
