/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reals for experiments, and the witness of answers that are not nested. */
#include "stream/harness.h"

/* The ends, and their distance. */
static void ends(mpq_t lo, mpq_t hi, mpq_t width, const dyd_interval *a) {
  dyd_interval_get_q(lo, hi, a);
  mpq_sub(width, hi, lo);
}

/* Asked for b bits it is exactly 2^-b wide, in the former interval, and the same whatever was asked before. */
static void test_digits(void **state) {
  (void)state;
  test_random r = test_random_start("random real");
  mpq_t lo, hi, width, past[2], step;
  mpq_inits(lo, hi, width, past[0], past[1], step, NULL);
  for (size_t k = 0; k < 50; k++) {
    char text[64];
    snprintf(text, sizeof text, "random(%llu)", (unsigned long long)test_u64(&r));
    dyd_real *x = parsed(text), *y = parsed(text);
    mpq_set_si(past[0], 0, 1);
    mpq_set_si(past[1], 1, 1);
    for (int64_t bits = 0; bits < 400; bits += 1 + (int64_t)test_below(&r, 60)) {
      ends(lo, hi, width, narrowed(x, bits, 500));
      mpq_set_ui(step, 1, 1);
      mpq_div_2exp(step, step, (mp_bitcnt_t)bits);
      assert_true(mpq_equal(width, step));
      assert_true(mpq_cmp(past[0], lo) <= 0 && mpq_cmp(hi, past[1]) <= 0);
      assert_false(dyd_real_is_final(x));
      mpq_set(past[0], lo);
      mpq_set(past[1], hi);
    }
    ends(lo, hi, width, narrowed(y, 600, 600));
    assert_true(mpq_cmp(past[0], lo) <= 0 && mpq_cmp(hi, past[1]) <= 0);
    dyd_real_free(x);
    dyd_real_free(y);
  }
  mpq_clears(lo, hi, width, past[0], past[1], step, NULL);
}

/* Different seeds give different numbers, whose first digits are spread. */
static void test_seeds(void **state) {
  (void)state;
  int seen[16] = {0};
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  for (int seed = 0; seed < 1600; seed++) {
    char text[32];
    snprintf(text, sizeof text, "16*random(%d)", seed);
    dyd_real *x = parsed(text);
    dyd_interval_get_q(lo, hi, narrowed(x, 40, 80));
    seen[mpz_get_ui(mpq_numref(lo)) / mpz_get_ui(mpq_denref(lo)) % 16]++;
    dyd_real_free(x);
  }
  for (int k = 0; k < 16; k++) assert_true(seen[k] > 50 && seen[k] < 160);
  mpq_clears(lo, hi, NULL);
}

/* Answer n is at most 1/n wide, at least half as much after the first ones, holds the number, and is nested. */
static void test_slow(void **state) {
  (void)state;
  static const char *const text[] = {"sqrt(2)", "1/3", "-5", "root(x^3-2,1,2)", "random(4)", "exp(1)-100", "0"};
  mpq_t lo, hi, width, most, a, b;
  mpq_inits(lo, hi, width, most, a, b, NULL);
  for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
    char slow[64];
    snprintf(slow, sizeof slow, "slow(%s)", text[k]);
    dyd_real *x = parsed(slow), *y = parsed(text[k]);
    dyd_interval_get_q(a, b, narrowed(y, 200, 300));
    for (unsigned n = 1; n < 200; n++) {
      ends(lo, hi, width, narrowed(x, 30, 300));
      mpq_set_ui(most, 1, n);
      assert_true(mpq_cmp(width, most) <= 0);
      mpq_div_2exp(most, most, 1);
      assert_true(mpq_cmp(width, most) >= 0);
      assert_true(mpq_cmp(lo, a) <= 0 && mpq_cmp(b, hi) <= 0);
    }
    dyd_real_free(x);
    dyd_real_free(y);
  }
  mpq_clears(lo, hi, width, most, a, b, NULL);
}

/* ---- witnesses ---- */

typedef struct two_answers {
  const char *answer[2];
  int given;
} two_answers;

static dyd_status give_next(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  two_answers *t = user;
  dyd_real *x = parsed(t->answer[t->given++]);
  (void)request;
  (void)err;
  dyd_interval_set(out, dyd_real_interval(x));
  dyd_real_free(x);
  return DYD_OK;
}

static void test_witness(void **state) {
  (void)state;
  static const struct {
    const char *old, *new, *witness;
  } row[] = {{"[1,2]", "[0.9,1.5]", "has 15*2^-4;"},
             {"[1,2]", "[1.5,2.3]", "has 9*2^-2;"},
             {"[1,2]", "[-3,2]", "has 0;"},
             {"[1,2]", "[1,9]", "has 8;"},
             {"[-2,-1]", "[-2,-0.9]", "has -15*2^-4;"},
             {"[-2,-1]", "[-5,-1]", "has -4;"},
             {"[1,2]", "[1/3,2]", "has 1*2^-1;"},
             {"[0,1]", "[0,1*2^-0]", NULL},
             {"[5,6]", "[5,6+2^-3]", "has 49*2^-3;"},
             {"[0,1]", "[-2^-70,1]", "has -1*2^-70;"},
             {"[1,2]", "[1-2^-300,2]", "2^-299; each"}}; /* too long to be shown */
  for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
    two_answers t = {{row[k].old, row[k].new}, 0};
    dyd_real *x = NULL;
    dyd_error err;
    dyd_error_clear(&err);
    assert_int_equal(DYD_OK, dyd_real_new(&x, give_next, NULL, &t));
    assert_int_equal(DYD_OK, dyd_real_narrow(x, 10, 90, &err));
    dyd_status st = dyd_real_narrow(x, 20, 90, &err);
    assert_int_equal(row[k].witness ? DYD_E_NESTING : DYD_OK, st);
    if (row[k].witness && !strstr(err.message, row[k].witness)) fail_msg("%s: %s", row[k].new, err.message);
    dyd_real_free(x);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_digits), cmocka_unit_test(test_seeds),
                                     cmocka_unit_test(test_slow), cmocka_unit_test(test_witness)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
