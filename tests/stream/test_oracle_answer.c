/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [ORA-1] What the answers of oracle programs become: a table of lines, and random intervals inside and outside. */
#include "rect/rect.h"
#include "stream/harness.h"
#include "stream/stream.h"

#include <dyadel/oracle.h>
#include <stdio.h>

static const struct {
  const char *line;
  dyd_status status;
  const char *x0, *x1, *says;
} answers[] = {
    {"0 1 2 3 4", DYD_OK, "1", "2", ""},
    {"0 \t -3.25\t1e-3   22/7  0x1.8p3 ", DYD_OK, "-13/4", NULL, ""},
    {"0 5*2^-20 5*2^-20 1/3 1/3", DYD_OK, "5/1048576", "5/1048576", ""},
    {"0 1/3 1/3 0 1", DYD_OK, "1/3", "1/3", ""},
    {"0 0 1 0 1 fixed", DYD_FIXED, "0", "1", ""},
    {"0 1 2 3", DYD_E_STREAM, NULL, NULL, "five words"},
    {"0 1 2 3 4 fixed 5", DYD_E_STREAM, NULL, NULL, "five words"},
    {"0 1 2 3 4 Fixed", DYD_E_STREAM, NULL, NULL, "five words"},
    {"0", DYD_E_STREAM, NULL, NULL, "five words"},
    {"0 2 1 0 1", DYD_E_STREAM, NULL, NULL, "lower end of the x side"},
    {"0 1 2 1 1/2", DYD_E_STREAM, NULL, NULL, "lower end of the y side"},
    {"0 1 2 3 4x", DYD_E_STREAM, NULL, NULL, "\"4x\", column 9"},
    {"0 1 2 1/0 4", DYD_E_STREAM, NULL, NULL, "\"1/0\", column 7"},
    {"0 1 2 nan 4", DYD_E_STREAM, NULL, NULL, "\"nan\", column 7"},
    {"0 [1,2] 2 3 4", DYD_E_STREAM, NULL, NULL, "\"[1,2]\", column 3"},
    {"0 1 1e99999999 3 4", DYD_E_RANGE, NULL, NULL, ""},
    {"0 1 2 3 \x01\x02", DYD_E_STREAM, NULL, NULL, "\"??\", column 9"},
};

static void assert_says(const dyd_error *err, const char *words) {
  if (!strstr(err->message, words)) fail_msg("no \"%s\" in: %s", words, err->message);
}

static void test_answers(void **state) {
  (void)state;
  for (size_t k = 0; k < sizeof answers / sizeof *answers; k++) {
    dyd_rect r;
    dyd_error err;
    dyd_error_clear(&err);
    dyd_rect_init(&r);
    dyd_status status = dyd_oracle_read_answer(&r, false, answers[k].line, strlen(answers[k].line), &err);
    if (status != answers[k].status) fail_msg("%s: status %d: %s", answers[k].line, status, err.message);
    if (status < 0) assert_true(dyd_rect_is_point(&r)); /* unchanged */
    assert_says(&err, answers[k].says);
    mpq_t lo, hi, q;
    mpq_inits(lo, hi, q, NULL);
    dyd_interval_get_q(lo, hi, &r.x);
    if (answers[k].x0) assert_int_equal(0, mpq_set_str(q, answers[k].x0, 10) || mpq_cmp(q, lo));
    if (answers[k].x1) assert_int_equal(0, mpq_set_str(q, answers[k].x1, 10) || mpq_cmp(q, hi));
    mpq_clears(lo, hi, q, NULL);
    dyd_rect_clear(&r);
  }
}

static void random_rational(mpq_t out, test_random *r) {
  static const unsigned long den[] = {1, 2, 3, 7, 10, 4096, 1000003};
  mpq_set_si(out, test_between(r, -40, 40), den[test_below(r, sizeof den / sizeof *den)]);
  mpq_canonicalize(out);
  if (test_chance(r, 3)) mpq_div_2exp(out, out, (mp_bitcnt_t)test_below(r, 200));
}

/* lo <= hi, equal now and then. */
static void random_interval(mpq_t lo, mpq_t hi, test_random *r) {
  random_rational(lo, r);
  random_rational(hi, r);
  if (mpq_cmp(lo, hi) > 0) mpq_swap(lo, hi);
  if (test_chance(r, 6)) mpq_set(hi, lo);
}

/* Inside the old one by its given ends? Then it contains them, lies in the old one, and is hardly wider. [ORA-1] */
static void check_answer(const dyd_interval *old, const mpq_t lo, const mpq_t hi) {
  char *line = NULL;
  dyd_rect r;
  dyd_error err;
  mpq_t a, b, c, d;
  mpq_inits(a, b, c, d, NULL);
  dyd_rect_init(&r);
  dyd_interval_set(&r.x, old);
  dyd_rect_set_d(&r, 0, 1, -1e9, 1e9);
  dyd_interval_set(&r.x, old);
  gmp_asprintf(&line, "7 %Qd %Qd 0 1", lo, hi);
  dyd_interval_get_q(a, b, old);
  bool inside = mpq_cmp(a, lo) <= 0 && mpq_cmp(hi, b) <= 0;
  dyd_status status = dyd_oracle_read_answer(&r, true, line, strlen(line), &err);
  assert_int_equal(inside ? DYD_OK : DYD_E_NESTING, status);
  assert_true(dyd_interval_contains(old, &r.x));
  if (!inside) assert_true(dyd_interval_contains(&r.x, old));
  dyd_interval_get_q(c, d, &r.x);
  if (inside) assert_true(mpq_cmp(c, lo) <= 0 && mpq_cmp(hi, d) <= 0);
  mpq_sub(a, hi, lo);
  mpq_sub(b, d, c);
  mpq_sub(b, b, a);
  mpq_div_2exp(a, a, 62);
  if (inside) assert_true(mpq_cmp(b, a) <= 0);
  mpq_clears(a, b, c, d, NULL);
  dyd_rect_clear(&r);
  void (*release)(void *, size_t);
  mp_get_memory_functions(NULL, NULL, &release);
  release(line, strlen(line) + 1);
}

static void test_random_answers(void **state) {
  (void)state;
  test_random r = test_random_start("oracle answers");
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  for (size_t k = test_cases(4000); k; k--) {
    dyd_interval old;
    dyd_error err;
    dyd_rect rect;
    char *line = NULL;
    dyd_interval_init(&old);
    dyd_rect_init(&rect);
    random_interval(lo, hi, &r);
    gmp_asprintf(&line, "7 %Qd %Qd 0 0", lo, hi);
    assert_int_equal(DYD_OK, dyd_oracle_read_answer(&rect, false, line, strlen(line), &err));
    dyd_interval_swap(&old, &rect.x);
    if (test_chance(&r, 2)) random_interval(lo, hi, &r);
    check_answer(&old, lo, hi);
    free(line);
    dyd_rect_clear(&rect);
    dyd_interval_clear(&old);
  }
  mpq_clears(lo, hi, NULL);
}

static const struct {
  const char *line;
  dyd_status status;
  size_t count;
  double cost[3];
  const char *says;
} firsts[] = {
    {"points 3", DYD_OK, 3, {0}, ""},
    {"points 00000000000000000003", DYD_OK, 3, {0}, ""},
    {"points +3", DYD_E_STREAM, 0, {0}, "print \"points N\""},
    {" points\t0 ", DYD_OK, 0, {0}, ""},
    {"points 3 cost 1 1/2\t6e1 ", DYD_OK, 3, {1, 0.5, 60}, ""},
    {"points 0 cost", DYD_OK, 0, {0}, ""},
    {"points 1 cost 5*2^-20", DYD_OK, 1, {0x5p-20}, ""},
    {"points", DYD_E_STREAM, 0, {0}, "print \"points N\""},
    {"points 3 4", DYD_E_STREAM, 0, {0}, "print \"points N\""},
    {"points 3 costs 1 1 1", DYD_E_STREAM, 0, {0}, "print \"points N\""},
    {"points 3 cost", DYD_E_STREAM, 0, {0}, "3 points and 0 costs"},
    {"points 3 cost 1 2", DYD_E_STREAM, 0, {0}, "3 points and 2 costs"},
    {"points 3 cost 1 2 3 4", DYD_E_STREAM, 0, {0}, "3 points and 4 costs; print one for each point"},
    {"points 99999999 cost 1", DYD_E_STREAM, 0, {0}, "99999999 points and 1 costs"},
    {"points 2 cost 1 0", DYD_E_STREAM, 0, {0}, "the cost of point 1, \"0\", is no exact number above 0"},
    {"points 2 cost -1 1", DYD_E_STREAM, 0, {0}, "the cost of point 0, \"-1\","},
    {"points 2 cost 1 inf", DYD_E_STREAM, 0, {0}, "\"inf\""},
    {"points 2 cost 1 1e999", DYD_E_STREAM, 0, {0}, "\"1e999\""},
    {"points 2 cost 1 1e-999", DYD_E_STREAM, 0, {0}, "\"1e-999\""},
    {"points 2 cost 1 2s", DYD_E_STREAM, 0, {0}, "\"2s\""},
};

static void test_first_lines(void **state) {
  (void)state;
  for (size_t k = 0; k < sizeof firsts / sizeof *firsts; k++) {
    size_t count = 77;
    double *cost = NULL;
    dyd_error err;
    dyd_error_clear(&err);
    dyd_status status = dyd_oracle_read_count(&count, &cost, firsts[k].line, strlen(firsts[k].line), &err);
    if (status != firsts[k].status) fail_msg("%s: status %d: %s", firsts[k].line, status, err.message);
    assert_says(&err, firsts[k].says);
    assert_int_equal(status == DYD_OK ? firsts[k].count : 77, count);
    assert_true((cost != NULL) == (status == DYD_OK && strstr(firsts[k].line, "cost")));
    for (size_t i = 0; cost && i < count; i++) assert_true(cost[i] == firsts[k].cost[i]);
    free(cost);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_answers), cmocka_unit_test(test_random_answers),
                                     cmocka_unit_test(test_first_lines)};
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
