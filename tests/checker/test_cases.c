/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certificates of special results: few sites, aliases, lines, caps, every outcome; what the report counts; places where
 * a naive reading of [CERT-2] and [CERT-3] goes wrong. */
#include "checker/diagram.h"

#include <stdlib.h>
#include <string.h>

/* Runs, writes, checks; the text is released with free(). */
static char *certify(dyd_certificate_report *report, dyd_engine *e, const dyd_engine_options *o) {
  dyd_error err;
  dyd_outcome outcome;
  assert_int_equal(dyd_engine_run(&outcome, e, o, &err), DYD_OK);
  char *text = certificate_of_engine(e);
  if (certificate_check(report, text, strlen(text), &err) != DYD_OK) {
    fputs(text, stderr);
    fail_msg("line %zu: %s", err.line, err.message);
  }
  assert_string_equal(report->outcome, dyd_outcome_text(outcome));
  return text;
}

static dyd_engine *engine_of(size_t n, const double *x, const double *y) {
  dyd_engine *e = NULL;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_engine_add_points(e, n, x, y, NULL), DYD_OK);
  return e;
}

static void expect(size_t n, const double *x, const double *y, size_t legal, size_t tie, size_t triangles) {
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  dyd_engine *e = engine_of(n, x, y);
  free(certify(&r, e, NULL));
  assert_int_equal(r.legal, legal);
  assert_int_equal(r.tie, tie);
  assert_int_equal(r.triangles, triangles);
  assert_int_equal(r.unproved, 0);
  dyd_engine_free(e);
}

static void few_sites(void **state) {
  (void)state;
  const double x[] = {0, 4, 0, 4, 0, 0}, y[] = {0, 0, 3, 3, 0, 0};
  expect(0, x, y, 0, 0, 0);
  expect(1, x, y, 0, 0, 0);
  expect(2, x, y, 1, 0, 0);
  expect(3, x, y, 3, 0, 1);
  expect(4, x, y, 4, 2, 0);
  expect(6, x, y, 4, 2, 0); /* two aliases */
}

static void lines_of_points(void **state) {
  (void)state;
  const double x[] = {0, 3, 1, 7, 2}, y[] = {0, 6, 2, 14, 4}, zero[] = {0, 0, 0, 0, 0};
  expect(5, x, y, 4, 6, 0);
  expect(5, x, zero, 4, 6, 0);
  expect(5, zero, x, 4, 6, 0);
  expect(5, zero, zero, 0, 0, 0); /* one site and four aliases */
}

/* A grid: sides are legal, diagonals ties, hull sides ties. */
static void grid(void **state) {
  (void)state;
  double x[49], y[49];
  for (int k = 0; k < 49; k++) x[k] = k % 7, y[k] = k / 7;
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  dyd_engine *e = engine_of(49, x, y);
  free(certify(&r, e, NULL));
  assert_int_equal(r.legal, 84);
  assert_int_equal(r.tie, 72 + 4 * 15);
  assert_int_equal(r.unproved, 0);
  assert_int_equal(r.corners, 4);
  dyd_engine_free(e);
}

static void capped(void **state) {
  (void)state;
  double lo[20], hi[20];
  for (int k = 0; k < 20; k++) lo[k] = k, hi[k] = k + 30;
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  dyd_engine *e = NULL;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_engine_add_boxes(e, 20, lo, hi, lo, hi, NULL), DYD_OK);
  free(certify(&r, e, &(dyd_engine_options){DYD_SIZED(dyd_engine_options), .max_pairs = 10}));
  assert_true(r.capped);
  assert_int_equal(r.legal, 0);
  assert_true(r.unproved > 0);
  assert_false(r.area || r.hausdorff);
  dyd_engine_free(e);
}

/* sqrt(2) beside its neighbours: decided, certified, budget, cancelled. */
static void outcomes(void **state) {
  (void)state;
  static const char *const at[5][2] = {
      {"0", "0"}, {"sqrt(2)", "0"}, {"sqrt(2)", "sqrt(3)"}, {"0", "sqrt(3)"}, {"1/3", "1/7"}};
  for (int k = 0; k < 4; k++) {
    dyd_engine *e = NULL;
    dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
    assert_int_equal(dyd_engine_new(&e), DYD_OK);
    for (int q = 0; q < (k ? 4 : 5); q++) {
      dyd_real *x = NULL, *y = NULL;
      dyd_stream *s = NULL;
      assert_int_equal(dyd_real_parse(&x, at[q][0], strlen(at[q][0]), NULL), DYD_OK);
      assert_int_equal(dyd_real_parse(&y, at[q][1], strlen(at[q][1]), NULL), DYD_OK);
      assert_int_equal(dyd_stream_from_reals(&s, x, y), DYD_OK);
      assert_int_equal(dyd_engine_add_stream(e, s, NULL), DYD_OK);
    }
    dyd_engine_options o = {DYD_SIZED(dyd_engine_options), .max_bits = 200, .no_ties = true};
    if (k == 1) o.goal = DYD_GOAL_AREA, o.goal_bits = 20;
    if (k == 3) o.max_stages = 1;
    char *text = certify(&r, e, &o);
    static const char *const want[4] = {"decided", "certified", "budget", "budget"};
    if (k) assert_string_equal(r.outcome, want[k]);
    if (k == 1) {
      char *bad = strdup(text), *goal = strstr(bad, "area 20");
      goal[5] = '9'; /* 2^-90 is not reached */
      assert_int_equal(certificate_check(NULL, bad, strlen(bad), NULL), DYD_E_PARSE);
      free(bad);
    }
    free(text);
    dyd_engine_free(e);
  }
}

/* A corner of a square, known within 2^-40 and never better; asked for more than 100 bits it stops the run. */
static dyd_status stop_run(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_engine *cancel = user;
  const double wide = 0x1p-40;
  if (request->bits > 100 && !cancel) {
    snprintf(err->message, sizeof err->message, "this point fails on purpose");
    return DYD_E_STREAM;
  }
  if (request->bits > 100) dyd_engine_cancel(cancel);
  if (dyd_interval_set_d(&out->x, 1 - wide, 1 + wide) < 0) return DYD_E_NOMEM;
  return dyd_interval_set_d(&out->y, 1 - wide, 1 + wide);
}

/* The certificate of a run with this outcome, with every other outcome instead: accepted if it claims nothing. */
static void try_words(const char *text, const char *outcome) {
  static const char *const words[] = {"fixpoint", "budget", "cancelled", "error", "decided", "certified", "stopped"};
  char other[8000], line[40];
  snprintf(line, sizeof line, "outcome %s\n", outcome);
  const char *at = strstr(text, line);
  assert_non_null(at);
  for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
    snprintf(other, sizeof other, "%.*soutcome %s\n%s", (int)(at - text), text, words[k], at + strlen(line));
    assert_int_equal(certificate_check(NULL, other, strlen(other), NULL), k < 4 ? DYD_OK : DYD_E_PARSE);
  }
}

/* The words error and cancelled: earlier statements are written and accepted, with and without a diagram. */
static void stopped(void **state) {
  (void)state;
  const double x[] = {0, 1, 0}, y[] = {0, 0, 1};
  for (int cancel = 0; cancel < 2; cancel++) {
    dyd_engine *e = engine_of(3, x, y);
    dyd_stream *s = NULL;
    dyd_outcome outcome;
    dyd_error err;
    dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
    dyd_source source = {DYD_SIZED(dyd_source), .narrow = stop_run, .user = cancel ? e : NULL};
    assert_int_equal(dyd_stream_new(&s, &source, 0, NULL), DYD_OK);
    assert_int_equal(dyd_engine_add_stream(e, s, NULL), DYD_OK);
    dyd_status status =
        dyd_engine_run(&outcome, e, &(dyd_engine_options){DYD_SIZED(dyd_engine_options), .start_bits = 30}, &err);
    assert_int_equal(status, cancel ? DYD_OK : DYD_E_STREAM);
    assert_int_equal(outcome, cancel ? DYD_OUTCOME_CANCELLED : DYD_OUTCOME_ERROR);
    for (int with = 0; with < 2; with++) {
      char *text = with ? diagram_of_engine(e, NULL) : certificate_of_engine(e);
      assert_int_equal(certificate_check(&r, text, strlen(text), &err), DYD_OK);
      assert_string_equal(r.outcome, cancel ? "cancelled" : "error");
      assert_int_equal(r.diagram, with);
      assert_int_equal(r.legal, 4);
      assert_int_equal(r.indeterminate, 2); /* the diagonals */
      try_words(text, r.outcome);
      free(text);
    }
    dyd_engine_free(e);
  }
}

static void no_result(void **state) {
  (void)state;
  dyd_engine *e = NULL;
  dyd_error err;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_write_certificate(stderr, e, NULL, &err), DYD_E_ARG);
  dyd_engine_free(e);
}

/* A full disk: the certificate is not complete, and its reader sees that. */
static void full_disk(void **state) {
  (void)state;
  const double x[] = {0, 4, 0}, y[] = {0, 0, 3};
  dyd_engine *e = engine_of(3, x, y);
  dyd_outcome outcome;
  dyd_error err;
  assert_int_equal(dyd_engine_run(&outcome, e, NULL, NULL), DYD_OK);
  FILE *full = fopen("/dev/full", "w");
  if (full) {
    assert_int_equal(dyd_write_certificate(full, e, NULL, &err), DYD_E_IO);
    fclose(full);
  }
  dyd_engine_free(e);
}

/* Bridges do not divide the unbounded face: two sites in the middle whose component hangs on a bridge, between corners
 * on either side. A checker that takes the sides of a bridge for two parts calls the pair of 1 and 4 illegal. */
static void bridge_is_no_border(void **state) {
  (void)state;
  orc_case c;
  orc_pool pool;
  statement s;
  test_random r = test_random_start("bridges");
  orc_case_init(&c);
  orc_pool_init(&pool);
  for (size_t k = 0; k < test_cases(60); k++) {
    c.n = 0;
    for (int q = 0; q < 6; q++) {
      long x = (long)test_between(&r, -8, 8), y = (long)test_between(&r, -8, 8), w = test_chance(&r, 2) ? 12 : 0;
      orc_case_add(&c, x, x + w, y, y + (long)test_between(&r, 0, w / 3), 1);
    }
    char *text = certificate_of_case(&c, NULL);
    dyd_error err;
    if (certificate_check(NULL, text, strlen(text), &err) != DYD_OK)
      fail_msg("line %zu: %s\n%s", err.line, err.message, text);
    statement_init(&s);
    statement_read(&s, text);
    const char *wrong = statement_judge(&pool, &s);
    if (wrong) fail_msg("%s\n%s", wrong, text);
    statement_clear(&s);
    free(text);
  }
  orc_case_clear(&c);
  orc_pool_clear(&pool);
}

/* Two joined sites whose lower left corner, a fraction, is the same: the edge has no direction, so no face is known. */
static void joined_in_one_place(void **state) {
  (void)state;
  orc_case c;
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  orc_case_init(&c);
  orc_case_add(&c, 1, 1, 0, 3, 3);
  orc_case_add(&c, 1, 1, 0, 6, 3);
  char *text = certificate_of_case(&c, NULL);
  assert_int_equal(certificate_check(&r, text, strlen(text), NULL), DYD_OK);
  assert_int_equal(r.legal, 1);
  assert_false(r.connected);
  assert_int_equal(r.unproved, 0);
  free(text);
  orc_case_clear(&c);
}

/* Both diagonals of a quadrangle are open. A bridge along one, true for the places, would hide the other. */
static void bridge_across_a_face(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  orc_case_add(&c, 0, 2, 0, 2, 8);
  orc_case_add(&c, 32, 34, 0, 2, 8);
  orc_case_add(&c, 32, 34, 32, 34, 8);
  orc_case_add(&c, 0, 2, 31, 33, 8);
  char *text = certificate_of_case(&c, NULL), bad[4000];
  assert_int_equal(certificate_check(NULL, text, strlen(text), NULL), DYD_OK);
  char *bridges = strstr(text, "bridges 0\n"), *open = strstr(text, "o 0 2\n");
  assert_non_null(bridges);
  assert_non_null(open);
  snprintf(bad, sizeof bad, "%.*sbridges 1\n1 3 2079*2^-10 63*2^-5\n%.*s%s", (int)(bridges - text), text,
           (int)(open - bridges - 10), bridges + 10, open + 6);
  dyd_error err;
  assert_int_equal(certificate_check(NULL, bad, strlen(bad), &err), DYD_E_PARSE);
  assert_non_null(strstr(err.message, "bridge joins"));
  free(text);
  orc_case_clear(&c);
}

/* Texts that are not certificates, or whose numbers are out of bounds. */
static void rubbish(void **state) {
  (void)state;
  dyd_certificate_report without_size = {.sites = 0};
  assert_int_equal(certificate_check(&without_size, "", 0, NULL), DYD_E_ARG);
  static const char *const text[] = {
      "",
      "\n",
      "dyadel certificate 1",
      "dyadel certificate 2\n",
      "dyadel certificate 1\noutcome fine\n",
      "dyadel certificate 1\noutcome decided\ngoal decided\ncapped no\nsites 999999999999999999999\n",
      "dyadel certificate 1\noutcome decided\ngoal decided\ncapped no\nsites 1\n1*2^999999999 0\n",
      "dyadel certificate 1\noutcome decided\ngoal decided\ncapped no\nsites 1\n2*2^3 0\n",
      "dyadel certificate 1\noutcome decided\ngoal decided\ncapped no\nsites 1\n01 0\n",
      "dyadel certificate 1\noutcome decided\ngoal decided\ncapped no\nsites 1\n-0 0\n",
      "dyadel certificate 1\noutcome decided\ngoal decided\ncapped no\nsites 1\n1+-1 0\n",
      "dyadel certificate 1\noutcome decided\ngoal decided\ncapped no\nsites 1\n3/9 0\n",
      "dyadel certificate 1\noutcome decided\ngoal decided\ncapped no\nsites 1\n= 0\n"};
  for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
    dyd_error err;
    assert_int_equal(certificate_check(NULL, text[k], strlen(text[k]), &err), DYD_E_PARSE);
    assert_true(err.line > 0);
    assert_int_equal(certificate_check(NULL, text[k], strlen(text[k]), NULL), DYD_E_PARSE);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(few_sites),
                                     cmocka_unit_test(lines_of_points),
                                     cmocka_unit_test(grid),
                                     cmocka_unit_test(capped),
                                     cmocka_unit_test(outcomes),
                                     cmocka_unit_test(stopped),
                                     cmocka_unit_test(no_result),
                                     cmocka_unit_test(full_disk),
                                     cmocka_unit_test(bridge_is_no_border),
                                     cmocka_unit_test(bridge_across_a_face),
                                     cmocka_unit_test(joined_in_one_place),
                                     cmocka_unit_test(rubbish)};
  return cmocka_run_group_tests_name("certificates of special results", tests, NULL, NULL);
}
