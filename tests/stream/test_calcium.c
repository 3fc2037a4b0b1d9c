/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [IDN-1] [SEP-1] The zero test against Calcium, which decides in fields of algebraic numbers, on random expressions.
 */
#include "harness.h"

#include "stream/algebra/form.h"
#include "stream/algebra/zero.h"

#include <calcium/ca.h>
#include <calcium/qqbar.h>
#include <stdio.h>

enum { TEXT = 4096 };

static test_random chance;
static ca_ctx_t field;

static size_t below(size_t n) {
  return (size_t)test_below(&chance, n);
}

/* A small number, a cosine of a part of pi. */
static void random_leaf(char *text, ca_t x) {
  long p = (long)below(9) - 4, q = 1 + (long)below(8);
  if (below(2)) {
    snprintf(text, TEXT, "(%ld/%ld)", p, q);
    ca_set_si(x, p, field);
    ca_div_si(x, x, q, field);
  } else {
    qqbar_t c;
    qqbar_init(c);
    qqbar_cos_pi(c, p, (ulong)q);
    snprintf(text, TEXT, "cos(%ld*pi/%ld)", p, q);
    ca_set_qqbar(x, c, field);
    qqbar_clear(c);
  }
}

/* The square root of the value, or of its negative. */
static void random_root(char *text, ca_t x) {
  char of[TEXT];
  arb_t size;
  acb_t ball;
  arb_init(size);
  acb_init(ball);
  ca_get_acb(ball, x, 64, field);
  acb_get_real(size, ball);
  snprintf(of, sizeof of, "%s", text);
  bool negative = arb_is_negative(size);
  if (negative) ca_neg(x, x, field);
  if (negative || arb_is_positive(size)) {
    ca_sqrt(x, x, field);
    snprintf(text, TEXT, "sqrt(%s%.*s)", negative ? "-" : "", TEXT - 10, of);
  }
  acb_clear(ball);
  arb_clear(size);
}

static void random_number(char *text, ca_t x, int depth) {
  if (depth == 0) {
    random_leaf(text, x);
    return;
  }
  char a[TEXT], b[TEXT];
  ca_t y;
  ca_init(y, field);
  random_number(a, x, depth - 1);
  random_number(b, y, depth - 1);
  size_t op = below(4);
  if (op == 0) ca_add(x, x, y, field);
  if (op == 1) ca_sub(x, x, y, field);
  if (op == 2) ca_mul(x, x, y, field);
  snprintf(text, TEXT, op == 3 ? "(%.*s)" : "(%.*s%c%.*s)", TEXT / 2 - 4, a, "+-*"[op % 3], TEXT / 2 - 4, b);
  if (op == 3) random_root(text, x);
  ca_clear(y, field);
}

static dyd_zero test_text(const char *text) {
  dyd_real *x = parsed(text);
  dyd_algebra a;
  dyd_zero zero = DYD_ZERO_UNKNOWN;
  assert_int_equal(dyd_algebra_open(&a, (int64_t)1 << 17, NULL), DYD_OK);
  uint32_t n = dyd_forms_real(&a.forms, x);
  assert_int_equal(dyd_algebra_settle(&a, &n, 1), DYD_OK);
  zero = dyd_algebra_test(&a, n);
  dyd_algebra_close(&a);
  dyd_real_free(x);
  return zero;
}

/* Random numbers x, y: x - y, x^2 - y^2, and expressions that are always 0. */
static void test_against(void **state) {
  size_t zeros = 0, others = 0, unknown = 0;
  (void)state;
  chance = test_random_start("calcium");
  ca_ctx_init(field);
  for (size_t k = 0; k < test_cases_all(300); k++) {
    char left[TEXT], right[TEXT], text[8 * TEXT];
    ca_t x, y;
    ca_init(x, field);
    ca_init(y, field);
    random_number(left, x, 2);
    random_number(right, y, 2);
    switch (below(3)) {
    case 0:
      snprintf(text, sizeof text, "(%s+%s)*(%s-%s)-%s^2+%s^2", left, right, left, right, left, right);
      ca_zero(x, field);
      break;
    case 1:
      snprintf(text, sizeof text, "%s^2-%s^2", left, right);
      ca_pow_ui(x, x, 2, field);
      ca_pow_ui(y, y, 2, field);
      ca_sub(x, x, y, field);
      break;
    default:
      snprintf(text, sizeof text, "%s-%s", left, right);
      ca_sub(x, x, y, field);
    }
    truth_t truth = ca_check_is_zero(x, field);
    dyd_zero zero = test_text(text);
    if (zero == DYD_ZERO_PROVED && truth == T_FALSE) fail_msg("%s is not 0", text);
    if (zero == DYD_ZERO_REFUTED && truth == T_TRUE) fail_msg("%s is 0", text);
    if (zero == DYD_ZERO_UNKNOWN && truth == T_TRUE) fail_msg("%s is 0, and not proved to be", text);
    zeros += zero == DYD_ZERO_PROVED;
    others += zero == DYD_ZERO_REFUTED;
    unknown += truth == T_UNKNOWN;
    ca_clear(y, field);
    ca_clear(x, field);
  }
  ca_ctx_clear(field);
  print_message("%zu are 0, %zu not; Calcium does not know %zu\n", zeros, others, unknown);
  assert_true(zeros > 50 && others > 50);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_against)};
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
