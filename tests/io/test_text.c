/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points, rectangles and intervals as text: every form of a points file, errors with their columns, and the
 * answers of callbacks, which stay nested whatever their ends are [NEST-1]. */
#include "stream/real.h"
#include "support/random.h"
#include <dyadel/dyadel.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void assert_end(const mpq_t q, const char *want, const char *text) {
  mpq_t w;
  mpq_init(w);
  assert_int_equal(0, mpq_set_str(w, want, 10));
  mpq_canonicalize(w);
  if (!mpq_equal(w, q)) fail_msg("%s: not %s", text, want);
  mpq_clear(w);
}

static void assert_side(const dyd_interval *a, const char *lo, const char *hi, const char *text) {
  mpq_t l, h;
  mpq_inits(l, h, NULL);
  dyd_interval_get_q(l, h, a);
  assert_end(l, lo, text);
  assert_end(h, hi, text);
  mpq_clears(l, h, NULL);
}

/* ---- intervals ---- */

static const struct {
  const char *text, *lo, *hi;
} intervals[] = {
    {"-3.25", "-13/4", "-13/4"},
    {"1e-3", "1/1000", "1/1000"},
    {"22/7", "22/7", "22/7"},
    {"0x1.8p-3", "3/16", "3/16"},
    {"5*2^-20", "5/1048576", "5/1048576"},
    {"[1.25,1.5]", "5/4", "3/2"},
    {"[ -1 , 1/2 ]", "-1", "1/2"},
    {"1.25+-0.25", "1", "3/2"},
    {"1.25\xC2\xB1"
     "0.25",
     "1", "3/2"},
    {"(1+2)/7", "3/7", "3/7"},
    {"[1/3,1/3]", "1/3", "1/3"},
};

static const struct {
  const char *text;
  dyd_status status;
  size_t column;
  const char *says;
} bad_intervals[] = {
    {"", DYD_E_PARSE, 1, ""},
    {"sqrt(2)", DYD_E_PARSE, 1, "number or an interval"},
    {"root(x^2-2,1,2)", DYD_E_PARSE, 1, "number or an interval"},
    {"1.5x", DYD_E_PARSE, 4, ""},
    {"[2,1]", DYD_E_PARSE, 2, "exchange"},
    {"[1;2]", DYD_E_PARSE, 3, "','"},
    {"1/0", DYD_E_DOMAIN, 3, ""},
    {"1e99999999", DYD_E_RANGE, 1, ""},
};

static void test_intervals(void **state) {
  (void)state;
  dyd_error err;
  dyd_interval a;
  dyd_interval_init(&a);
  for (size_t k = 0; k < sizeof intervals / sizeof *intervals; k++) {
    const char *text = intervals[k].text;
    if (dyd_interval_set_text(&a, text, strlen(text), &err) != DYD_OK) fail_msg("%s: %s", text, err.message);
    assert_side(&a, intervals[k].lo, intervals[k].hi, text);
  }
  assert_int_equal(DYD_OK, dyd_interval_set_text(&a, "78 and more", 1, NULL));
  for (size_t k = 0; k < sizeof bad_intervals / sizeof *bad_intervals; k++) {
    const char *text = bad_intervals[k].text;
    dyd_error_clear(&err);
    dyd_status st = dyd_interval_set_text(&a, text, strlen(text), &err);
    if (st != bad_intervals[k].status || err.code != st) fail_msg("%s: status %d", text, st);
    if (st == DYD_E_PARSE && err.column != bad_intervals[k].column) fail_msg("%s: column %zu", text, err.column);
    if (!strstr(err.message, bad_intervals[k].says)) fail_msg("%s: %s", text, err.message);
    assert_side(&a, "7", "7", text);
  }
  dyd_interval_clear(&a);
}

/* ---- rectangles ---- */

static const struct {
  const char *text, *e[4];
} rects[] = {
    {"1 2", {"1", "1", "2", "2"}},
    {"1,2", {"1", "1", "2", "2"}},
    {"  22/7 ,\t[1.25,1.5]  # a comment", {"22/7", "22/7", "5/4", "3/2"}},
    {"[-1, 1] (1 + 2)/4", {"-1", "1", "3/4", "3/4"}},
    {"1+-1 0x1p-1", {"0", "2", "1/2", "1/2"}},
};

static const struct {
  const char *text;
  size_t column;
  const char *says;
} bad_rects[] = {
    {"", 0, "no point"},
    {" # nothing", 0, "no point"},
    {"1", 2, "one coordinate only"},
    {"1 2 3", 5, "more than two"},
    {"1 ,, 2", 4, "two commas"},
    {" 1 2x", 5, ""},
    {"\xC3\xA9 2", 1, ""},
    {"[1,2] [3;4]", 9, "','"},
    {"0 sqrt(2)", 3, "number or an interval"},
    {"1 2\n3 4", 3, "more than two"},
};

static void test_rects(void **state) {
  (void)state;
  dyd_error err;
  dyd_rect r;
  dyd_rect_init(&r);
  for (size_t k = 0; k < sizeof rects / sizeof *rects; k++) {
    const char *text = rects[k].text;
    if (dyd_rect_set_text(&r, text, strlen(text), &err) != DYD_OK) fail_msg("%s: %s", text, err.message);
    assert_side(&r.x, rects[k].e[0], rects[k].e[1], text);
    assert_side(&r.y, rects[k].e[2], rects[k].e[3], text);
  }
  assert_int_equal(DYD_OK, dyd_rect_set_text(&r, "7 8", 3, NULL));
  for (size_t k = 0; k < sizeof bad_rects / sizeof *bad_rects; k++) {
    const char *text = bad_rects[k].text;
    memset(&err, 0xAA, sizeof err);
    assert_int_equal(DYD_E_PARSE, dyd_rect_set_text(&r, text, strlen(text), &err));
    if (err.column != bad_rects[k].column || err.line > 2) fail_msg("%s: %zu:%zu", text, err.line, err.column);
    if (!strstr(err.message, bad_rects[k].says)) fail_msg("%s: %s", text, err.message);
    assert_int_equal(DYD_E_PARSE, dyd_rect_set_text(&r, text, strlen(text), NULL));
    assert_side(&r.x, "7", "7", text);
    assert_side(&r.y, "8", "8", text);
  }
  dyd_rect_clear(&r);
}

/* ---- points of an engine ---- */

static dyd_status add(dyd_engine *e, const char *text, const dyd_read_options *o, dyd_error *err) {
  return dyd_engine_add_text(e, text, strlen(text), o, err);
}

static void test_points(void **state) {
  (void)state;
  dyd_error err;
  dyd_engine *e = NULL;
  dyd_outcome outcome;
  dyd_pair_list pairs = {0};
  assert_int_equal(DYD_OK, dyd_engine_new(&e));
  assert_int_equal(DYD_OK, add(e, "0 0", NULL, &err));
  assert_int_equal(DYD_OK, add(e, "\xEF\xBB\xBF# two more\r\n1 0\r\n\r\n0 sqrt(2)\r\n", NULL, &err));
  assert_int_equal(DYD_OK, add(e, "", NULL, NULL));
  dyd_read_options csv = {DYD_SIZED(dyd_read_options), .columns = "y,x", .measured = true};
  assert_int_equal(DYD_OK, add(e, "x,name,y\n1.41,a,1.0\n", &csv, &err));
  assert_int_equal(dyd_engine_count(e), 4);
  assert_int_equal(DYD_E_PARSE, add(e, "5 5\n 6 ?\n", NULL, &err));
  assert_true(err.line == 2 && err.column == 4);
  assert_int_equal(DYD_E_PARSE, add(e, "1 2\n3", NULL, NULL));
  assert_int_equal(dyd_engine_count(e), 4);
  assert_int_equal(DYD_E_PARSE, dyd_engine_add_text(e, "1 \0002", 4, NULL, &err));
  assert_true(err.line == 1 && err.column == 3);
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, NULL, &err));
  assert_int_equal(DYD_OK, dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(e)));
  assert_true(pairs.count >= 5);
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(DYD_OK, dyd_sites_get(&r, dyd_delaunay_sites(dyd_engine_delaunay(e)), 3));
  assert_true(!dyd_rect_is_point(&r));
  dyd_rect_clear(&r);
  assert_int_equal(DYD_OK, add(e, "9 9", NULL, &err)); /* after a run, too */
  assert_int_equal(dyd_engine_count(e), 5);
  dyd_pair_list_clear(&pairs);
  dyd_engine_free(e);
}

/* ---- answers of callbacks ---- */

static const struct {
  const char *text;
  dyd_status status;
  const char *says;
} answers[] = {
    {"1 2 3 4", DYD_OK, ""},
    {"\t1 2  3/7 22/7 fixed ", DYD_FIXED, ""},
    {"1 2 3", DYD_E_STREAM, "XLO XHI YLO YHI"},
    {"1 2 3 4 5", DYD_E_STREAM, "XLO XHI YLO YHI"},
    {"1 2 3 4 fixed fixed", DYD_E_STREAM, "XLO XHI YLO YHI"},
    {"2 1 3 4", DYD_E_STREAM, "exchange"},
    {"1 2 3 4e", DYD_E_STREAM, "\"4e\", column 7"},
    {"1 1e99999999 3 4", DYD_E_RANGE, ""},
};

static void test_answers(void **state) {
  (void)state;
  dyd_error err;
  for (size_t k = 0; k < sizeof answers / sizeof *answers; k++) {
    const char *text = answers[k].text;
    dyd_rect r;
    dyd_rect_init(&r);
    dyd_error_clear(&err);
    dyd_status st = dyd_rect_narrow_text(&r, text, strlen(text), &err);
    if (st != answers[k].status) fail_msg("%s: status %d: %s", text, st, err.message);
    if (!strstr(err.message, answers[k].says)) fail_msg("%s: %s", text, err.message);
    assert_true(dyd_rect_is_point(&r) == (st < 0));
    dyd_rect_clear(&r);
  }
}

/* Ends x/d, d any of these: dyadic or not. */
static void random_end(mpq_t out, const mpq_t lo, const mpq_t hi, test_random *r) {
  static const unsigned long den[] = {1, 2, 3, 7, 10, 4096, 1000003};
  unsigned long d = den[test_below(r, sizeof den / sizeof *den)];
  mpq_sub(out, hi, lo);
  mpq_t part;
  mpq_init(part);
  mpq_set_ui(part, (unsigned long)test_below(r, d + 1), d);
  mpq_canonicalize(part);
  mpq_mul(out, out, part);
  mpq_add(out, out, lo);
  mpq_clear(part);
}

/* Rational intervals, each inside the one before, are accepted, hold the interval stated, and stay inside. */
static void test_nested_answers(void **state) {
  (void)state;
  test_random g = test_random_start("io_text_nested");
  mpq_t e[2], next[2], lo, hi;
  mpq_inits(e[0], e[1], next[0], next[1], lo, hi, NULL);
  for (unsigned long k = 0; k < test_cases(300); k++) {
    dyd_rect r, before;
    dyd_rect_init(&r);
    dyd_rect_init(&before);
    mpq_set_si(e[0], test_between(&g, -9, 0), 7);
    mpq_set_si(e[1], test_between(&g, 1, 9), 9);
    mpq_canonicalize(e[0]);
    mpq_canonicalize(e[1]);
    for (int step = 0; step < 12 && mpq_cmp(e[0], e[1]) < 0; step++) {
      char *text = NULL;
      gmp_asprintf(&text, "%Qd %Qd %Qd %Qd", e[0], e[1], e[0], e[1]);
      assert_int_equal(DYD_OK, dyd_rect_narrow_text(&r, text, strlen(text), NULL));
      dyd_interval_get_q(lo, hi, &r.y);
      assert_true(mpq_cmp(lo, e[0]) <= 0 && mpq_cmp(e[1], hi) <= 0);
      assert_true(step == 0 || dyd_rect_contains(&before, &r));
      dyd_rect_set(&before, &r);
      free(text);
      random_end(next[0], e[0], e[1], &g);
      random_end(next[1], next[0], e[1], &g);
      mpq_swap(e[0], next[0]);
      mpq_swap(e[1], next[1]);
    }
    dyd_rect_clear(&before);
    dyd_rect_clear(&r);
  }
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_error err;
  assert_int_equal(DYD_OK, dyd_rect_narrow_text(&r, "0 1/3 0 1", 9, NULL));
  assert_int_equal(DYD_E_NESTING, dyd_rect_narrow_text(&r, "0 1/2 0 1", 9, &err));
  assert_side(&r.y, "0", "1", "kept");
  dyd_rect_clear(&r);
  mpq_clears(e[0], e[1], next[0], next[1], lo, hi, NULL);
}

static void test_error_set(void **state) {
  (void)state;
  dyd_error err;
  dyd_error_clear(&err);
  assert_int_equal(DYD_E_STREAM, dyd_error_set(&err, DYD_E_STREAM, "100%s of it"));
  assert_string_equal(err.message, "100%s of it");
  assert_int_equal(err.code, DYD_E_STREAM);
  assert_int_equal(DYD_E_IO, dyd_error_set(NULL, DYD_E_IO, "nobody listens"));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_intervals),      cmocka_unit_test(test_rects),
                                     cmocka_unit_test(test_points),         cmocka_unit_test(test_answers),
                                     cmocka_unit_test(test_nested_answers), cmocka_unit_test(test_error_set)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
