/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certificates of the Voronoi diagram: genuine certificates are accepted, and true by a literal judge; forged ones are
 * rejected [CERT-6] [CERT-7]. */
#include "checker/diagram.h"

#include <stdlib.h>
#include <string.h>

#define SIZE 60000

typedef struct totals {
  size_t cases, polygons, proved, unproved, none, large;
} totals;

static void expect_good(totals *t, diagram *d, const orc_case *c, char *text, test_random *r) {
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  t->cases++;
  if (!text) {
    t->large++;
    return;
  }
  if (certificate_check(&report, text, strlen(text), &err) != DYD_OK) {
    fputs(text, stderr);
    fail_msg("line %zu: %s", err.line, err.message);
  }
  assert_true(report.diagram);
  diagram_read(d, text);
  const char *wrong = diagram_judge(d, c, r, 40);
  if (wrong) {
    fputs(text, stderr);
    fail_msg("%s", wrong);
  }
  t->large += d->large;
  t->polygons += report.polygons;
  t->proved += report.distance_proved;
  t->unproved += report.distance && !report.distance_proved;
  t->none += !report.distance;
  free(text);
}

static void random_cases(void **state) {
  (void)state;
  static diagram d;
  totals t = {0};
  orc_case c;
  test_random r = test_random_start("certificates of diagrams");
  orc_case_init(&c);
  diagram_init(&d);
  for (size_t k = 0; k < test_cases(2); k++)
    for (size_t kind = 0; kind < ORC_KINDS; kind++) {
      orc_generate(&c, &r, kind, k % 2 ? 4 : 9);
      dyd_engine *e = engine_of_case(&c, NULL);
      expect_good(&t, &d, &c, diagram_of_engine(e, NULL), &r);
      dyd_engine_free(e);
    }
  fprintf(stderr, "# %zu certificates, %zu polygons; distances: %zu proved, %zu unproved, %zu none; %zu not judged\n",
          t.cases, t.polygons, t.proved, t.unproved, t.none, t.large);
  assert_true(t.large * 5 <= t.cases && t.proved * 2 > t.cases && t.unproved * 20 <= t.cases);
  diagram_clear(&d);
  orc_case_clear(&c);
}

/* Thin and thick boxes, small windows, windows beside all sites. */
static void windows(void **state) {
  (void)state;
  static diagram d;
  totals t = {0};
  orc_case c;
  dyd_rect w;
  test_random r = test_random_start("windows of certificates");
  orc_case_init(&c);
  diagram_init(&d);
  dyd_rect_init(&w);
  for (size_t k = 0; k < test_cases(10); k++) {
    c.n = 0;
    for (int q = 0; q < 8; q++) {
      long x = (long)test_between(&r, 0, 300), y = (long)test_between(&r, 0, 300), wide = k % 3 ? 2 : 40;
      orc_case_add(&c, x, x + (long)test_between(&r, 0, wide), y, y + (long)test_between(&r, 0, wide), 1);
    }
    dyd_engine *e = engine_of_case(&c, NULL);
    double x = (double)test_between(&r, -400, 400), y = (double)test_between(&r, -400, 400);
    double side = k % 2 ? 1.0 / 1024 : (double)test_between(&r, 1, 500);
    assert_int_equal(dyd_interval_set_d(&w.x, x, x + side), DYD_OK);
    assert_int_equal(dyd_interval_set_d(&w.y, y, y + side), DYD_OK);
    expect_good(&t, &d, &c, diagram_of_engine(e, &w), &r);
    dyd_engine_free(e);
  }
  fprintf(stderr, "# %zu windows, %zu polygons; distances: %zu proved, %zu unproved, %zu none\n", t.cases, t.polygons,
          t.proved, t.unproved, t.none);
  dyd_rect_clear(&w);
  diagram_clear(&d);
  orc_case_clear(&c);
}

/* ---- goals ---- */

static dyd_engine *engine_of_reals(void) {
  static const char *const at[5][2] = {
      {"0", "0"}, {"sqrt(2)", "0"}, {"sqrt(2)", "sqrt(3)"}, {"0", "sqrt(3)"}, {"pi", "1/7"}};
  dyd_engine *e = NULL;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  for (int q = 0; q < 5; q++) {
    dyd_real *x = NULL, *y = NULL;
    dyd_stream *s = NULL;
    assert_int_equal(dyd_real_parse(&x, at[q][0], strlen(at[q][0]), NULL), DYD_OK);
    assert_int_equal(dyd_real_parse(&y, at[q][1], strlen(at[q][1]), NULL), DYD_OK);
    assert_int_equal(dyd_stream_from_reals(&s, x, y), DYD_OK);
    assert_int_equal(dyd_engine_add_stream(e, s, NULL), DYD_OK);
  }
  return e;
}

/* The text with the first `old` behind `after` replaced; borrowed until the next call. */
static const char *replaced(const char *text, const char *after, const char *old, const char *by) {
  static char out[SIZE];
  const char *from = strstr(text, after), *at = from ? strstr(from, old) : NULL;
  assert_non_null(at);
  snprintf(out, sizeof out, "%.*s%s%s", (int)(at - text), text, by, at + strlen(old));
  return out;
}

static void expect_rejected(const char *text) {
  dyd_error err;
  if (certificate_check(NULL, text, strlen(text), &err) == DYD_OK) fail_msg("accepted:\n%s", text);
  assert_true(err.line > 0);
}

/* A goal that was reached is checked; a finer one in its place is not reached; without the section neither is. */
static void goals(void **state) {
  (void)state;
  dyd_rect w;
  dyd_rect_init(&w);
  assert_int_equal(dyd_interval_set_d(&w.x, -1, 4), DYD_OK);
  assert_int_equal(dyd_interval_set_d(&w.y, -1, 3), DYD_OK);
  for (int area = 0; area < 2; area++)
    for (int bits = 5; bits < (area ? 30 : 200); bits *= 4) {
      dyd_engine *e = engine_of_reals();
      dyd_engine_options o = {DYD_SIZED(dyd_engine_options), .goal_bits = bits, .window = &w, .max_bits = 2000};
      o.goal = area ? DYD_GOAL_VORONOI_AREA : DYD_GOAL_VORONOI_HAUSDORFF;
      dyd_outcome outcome;
      dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
      dyd_error err;
      assert_int_equal(dyd_engine_run(&outcome, e, &o, NULL), DYD_OK);
      assert_int_equal(outcome, DYD_OUTCOME_CERTIFIED);
      char *text = diagram_of_engine(e, &w), goal[40];
      if (certificate_check(&report, text, strlen(text), &err) != DYD_OK) fail_msg("%s\n%s", err.message, text);
      assert_string_equal(report.outcome, "certified");
      assert_string_equal(report.goal, area ? "voronoi area" : "voronoi hausdorff");
      assert_int_equal(report.goal_bits, bits);
      assert_true(report.distance_proved && report.polygons == 5);
      snprintf(goal, sizeof goal, "%s %d\n", report.goal, bits);
      expect_rejected(replaced(text, "goal", goal, area ? "voronoi area 9999\n" : "voronoi hausdorff 9999\n"));
      expect_rejected(replaced(text, "goal", goal, area ? "area 9999\n" : "decided\n"));
      char *cut = strdup(text);
      strcpy(strstr(cut, "window "), "end\n");
      expect_rejected(cut);
      FILE *none = fopen("/dev/null", "w");
      assert_non_null(none);
      assert_int_equal(dyd_write_certificate(none, e, NULL, &err), DYD_E_ARG);
      fclose(none);
      free(cut);
      free(text);
      dyd_engine_free(e);
    }
  dyd_rect_clear(&w);
}

/* ---- forgeries ---- */

/* The certificate of the case with this section put in. */
static const char *with_section(const char *text, const char *section) {
  static char out[SIZE];
  snprintf(out, sizeof out, "%.*s%send\n", (int)(strlen(text) - 4), text, section);
  return out;
}

#define WINDOW "window -1 5 -1 5\npolygons\n"
#define SQUARE "-1 -1 1 -1 1 1 -1 1"
#define END "undetermined 1*2^5\ndistance 0\n"

/* The corners of a square of side 4, exact; the cell of site 0 is left and below of (2,2). */
static void forged_sections(void **state) {
  (void)state;
  static const char *const good[] = {WINDOW "0 " SQUARE "\n" END, WINDOW "undetermined 9*2^2\ndistance 0\n",
                                     WINDOW "0 " SQUARE "\n1 3 -1 5 -1 5 1\nundetermined 15*2^1\ndistance none\n",
                                     WINDOW "0 " SQUARE "\nundetermined 33\ndistance 1*2^-50 unproved\n"};
  static const char *const bad[] = {
      WINDOW "0 -1 -1 -1 1 1 1 1 -1\n" END,                               /* clockwise */
      WINDOW "0 -1 -1 0 -1 1 -1 1 1 -1 1\n" END,                          /* three in line */
      WINDOW "0 -1 -1 1 -1 0 0 1 1 -1 1\n" END,                           /* not convex */
      WINDOW "0 " SQUARE " " SQUARE "\nundetermined 7*2^2\ndistance 0\n", /* twice round */
      WINDOW "0 0 1*2^-1 -5*2^-4 -3*2^-3 1*2^-1 1*2^-3 -1*2^-1 1*2^-3 5*2^-4 -3*2^-3\n"
             "undetermined 9*2^2\ndistance 0\n", /* a star: left turns, twice round */
      WINDOW "0 -1 -1 1 -1\n" END,
      WINDOW "0 -1 -1 1 -1 1\n" END,
      WINDOW "0\n" END,
      WINDOW "0 -1 -1 1*2^1 -1 1*2^1 1 -1 1\nundetermined 15*2^1\ndistance 0\n", /* on the bisector */
      WINDOW "0 -1 -1 3 -1 3 1 -1 1\nundetermined 7*2^2\ndistance 0\n",          /* beyond it */
      WINDOW "0 3 0 -1 1 -1 -1\nundetermined 1*2^5\ndistance 0\n",               /* its first vertex is */
      WINDOW "0 -1*2^1 -1 1 -1 1 1 -1 1\nundetermined 1*2^5\ndistance 0\n",      /* outside of the window */
      WINDOW "0 " SQUARE "\n0 " SQUARE "\nundetermined 7*2^2\ndistance 0\n",
      WINDOW "1 3 -1 5 -1 5 1\n0 " SQUARE "\nundetermined 15*2^1\ndistance 0\n",
      WINDOW "1 " SQUARE "\n" END,
      WINDOW "4 " SQUARE "\n" END, /* an alias of 0 */
      WINDOW "5 " SQUARE "\n" END,
      WINDOW "0 " SQUARE "\nundetermined 4294967295*2^-27\ndistance 0\n",
      WINDOW "0 " SQUARE "\nundetermined -1*2^5\ndistance 0\n",
      WINDOW "0 " SQUARE "\nundetermined none\ndistance 0\n",
      WINDOW "0 " SQUARE "\nundetermined 1*2^5\ndistance -1\n",
      WINDOW "0 " SQUARE "\nundetermined 1*2^5\ndistance 0 proved\n",
      WINDOW "0 " SQUARE "\nundetermined 1*2^5\ndistance none none\n",
      WINDOW "0 " SQUARE "\nundetermined 1*2^5\n",
      WINDOW "0 " SQUARE "\n" END WINDOW "0 " SQUARE "\n" END,
      "window 5 -1 -1 5\npolygons\nundetermined 9*2^2\ndistance 0\n",
      "window -1 -1 -1 5\npolygons\nundetermined 0\ndistance 0\n",
      "window -1 5 -1\npolygons\nundetermined 9*2^2\ndistance 0\n",
      "window -1 5 -1 5\nundetermined 9*2^2\ndistance 0\n"};
  orc_case c;
  orc_case_init(&c);
  for (int k = 0; k < 5; k++) {
    long x = 4 * (k == 1 || k == 2), y = 4 * (k == 2 || k == 3);
    orc_case_add(&c, x, x, y, y, 1);
  }
  char *text = certificate_of_case(&c, NULL);
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  for (size_t k = 0; k < sizeof good / sizeof *good; k++) {
    const char *all = with_section(text, good[k]);
    assert_int_equal(certificate_check(&report, all, strlen(all), NULL), DYD_OK);
    assert_true(report.diagram && report.distance_proved == (k < 2) && report.distance == (k != 2));
  }
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) expect_rejected(with_section(text, bad[k]));
  free(text);
  orc_case_clear(&c);
}

/* R_0 and R_1 touch at (1,1): below and left of both, dl_0 = ds_1. No point there is surely nearest. */
static void touching_rectangles(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  orc_case_add(&c, 0, 1, 0, 1, 1);
  orc_case_add(&c, 1, 2, 1, 2, 1);
  char *text = certificate_of_case(&c, NULL);
  expect_rejected(with_section(text, "window -8 -4 -8 -4\npolygons\n0 -5 -5 -9*2^-1 -5 -5 -9*2^-1\n"
                                     "undetermined 1*2^4\ndistance none\n") +
                  0);
  expect_rejected(with_section(text, "window -1*2^3 -1*2^2 -1*2^3 -1*2^2\npolygons\n0 -5 -5 -9*2^-1 -5 -5 -9*2^-1\n"
                                     "undetermined 1*2^4\ndistance none\n"));
  const char *all =
      with_section(text, "window -1*2^3 -1*2^2 -1*2^3 -1*2^2\npolygons\nundetermined 1*2^4\ndistance none\n");
  assert_int_equal(certificate_check(NULL, all, strlen(all), NULL), DYD_OK);
  /* Nor is any distance known: both may be one point, and then the diagram does not exist. */
  expect_rejected(with_section(text, "window -1*2^3 -1*2^2 -1*2^3 -1*2^2\npolygons\nundetermined 1*2^4\ndistance "
                                     "1*2^60\n"));
  free(text);
  orc_case_clear(&c);
}

/* No site, one site, sites that may coincide. */
static void few_sites(void **state) {
  (void)state;
  static diagram d;
  totals t = {0};
  orc_case c;
  dyd_rect w;
  test_random r = test_random_start("diagrams of few sites");
  orc_case_init(&c);
  diagram_init(&d);
  dyd_rect_init(&w);
  assert_int_equal(dyd_interval_set_d(&w.x, -8, 8), DYD_OK);
  assert_int_equal(dyd_interval_set_d(&w.y, -4, 8), DYD_OK);
  for (int k = 0; k < 6; k++) {
    c.n = 0;
    for (int q = 0; q < (k < 3 ? k : 2 * k); q++) orc_case_add(&c, q % 2, q % 2 + k, q / 3, q / 3 + k, 1);
    dyd_engine *e = engine_of_case(&c, NULL);
    expect_good(&t, &d, &c, diagram_of_engine(e, &w), &r);
    dyd_engine_free(e);
  }
  assert_true(t.none > 0);
  dyd_rect_clear(&w);
  diagram_clear(&d);
  orc_case_clear(&c);
}

/* ---- the bound of the distance ---- */

/* Two boxes of side 1, their middles 9 apart. Far up on the axis between them, at height h, the bound of [HAUS-V] is
 * about sqrt(2) (h / 8): for the bound that the checker takes to be true it must grow with the window. */
static void distance_is_tight(void **state) {
  (void)state;
  static diagram d;
  orc_case c;
  test_random r = test_random_start("distances between two boxes");
  orc_case_init(&c);
  diagram_init(&d);
  orc_case_add(&c, 0, 1, 0, 1, 1);
  orc_case_add(&c, 9, 10, 0, 1, 1);
  char *text = certificate_of_case(&c, NULL);
  for (long top = 16; top <= 4096; top *= 2) {
    bool last = false;
    size_t accepted = 0;
    for (long h = 1; h <= 2 * top; h++) {
      char section[300];
      snprintf(section, sizeof section, "window 5 7 0 %ld\npolygons\nundetermined %ld*2^9\ndistance %ld*2^-3\n",
               top + 1, top + 1, 2 * h + 1);
      const char *all = with_section(text, section);
      bool good = certificate_check(NULL, all, strlen(all), NULL) == DYD_OK;
      assert_true(good || !last); /* a larger bound is true as well */
      if (good && !last) {
        diagram_read(&d, all);
        const char *wrong = diagram_judge(&d, &c, &r, 400);
        if (wrong) fail_msg("height %ld, bound %ld/4: %s", top, h, wrong);
      }
      last = good;
      accepted += good;
      if (accepted > 2) break;
      if (!good) h += h / 8;
    }
    assert_true(accepted > 0);
  }
  free(text);
  diagram_clear(&d);
  orc_case_clear(&c);
}

/* Three boxes on one another; all sites possible in the window meet each other. The distance of a point of the window
 * to the boxes far right is a bound, as one of two points is another one: sqrt(148) for the nearer two of these. */
static void boxes_on_one_another(void **state) {
  (void)state;
  static diagram d;
  orc_case c;
  test_random r = test_random_start("boxes on one another");
  orc_case_init(&c);
  diagram_init(&d);
  for (int k = 0; k < 3; k++) orc_case_add(&c, -1, 1, -1, 1, 1);
  orc_case_add(&c, 10, 10, 0, 0, 1);
  for (int k = 0; k < 2; k++) orc_case_add(&c, 30, 31 + k, -1, 1, 1);
  char *text = certificate_of_case(&c, NULL);
  static const struct {
    const char *bound;
    bool proved;
  } tried[] = {{"12", false}, {"97*2^-3", false}, {"49*2^-2", true}, {"13", true}, {"35", true}};
  for (size_t k = 0; k < sizeof tried / sizeof *tried; k++) {
    char section[300];
    snprintf(section, sizeof section, "window -1*2^1 1*2^1 -1*2^1 1*2^1\npolygons\nundetermined 1*2^4\ndistance %s\n",
             tried[k].bound);
    const char *all = with_section(text, section);
    assert_int_equal(certificate_check(NULL, all, strlen(all), NULL) == DYD_OK, tried[k].proved);
    if (!tried[k].proved) continue;
    diagram_read(&d, all);
    assert_null(diagram_judge(&d, &c, &r, 400));
  }
  free(text);
  diagram_clear(&d);
  orc_case_clear(&c);
}

/* Bounds below the written ones: any that are accepted are true. */
static void smaller_distances(void **state) {
  (void)state;
  static diagram d;
  orc_case c;
  size_t tried = 0, accepted = 0;
  test_random r = test_random_start("smaller distances");
  orc_case_init(&c);
  diagram_init(&d);
  for (size_t k = 0; k < test_cases(6); k++) {
    c.n = 0;
    for (int q = 0; q < 5; q++) {
      long x = (long)test_between(&r, 0, 100), y = (long)test_between(&r, 0, 100);
      orc_case_add(&c, x, x + (long)test_between(&r, 1, k % 2 ? 30 : 5), y, y + (long)test_between(&r, 1, 5), 1);
    }
    dyd_engine *e = engine_of_case(&c, NULL);
    char *text = diagram_of_engine(e, NULL);
    diagram_read(&d, text);
    for (unsigned long share = 31; share > 8 && d.distance_proved; share -= 2) {
      char line[400];
      mpz_t man;
      mpz_init_set(man, mpq_numref(d.distance));
      if (mpq_sgn(d.distance) && mpz_even_p(man)) mpz_setbit(man, 0);
      mpz_mul_ui(man, man, share);
      gmp_snprintf(line, sizeof line, "distance %Zd*2^%ld\n", man,
                   -4 - (long)mpz_sizeinbase(mpq_denref(d.distance), 2));
      const char *old = strstr(text, "\ndistance ") + 1;
      char *line_old = strndup(old, strcspn(old, "\n") + 1);
      const char *all = replaced(text, "undetermined", line_old, line);
      tried++;
      if (certificate_check(NULL, all, strlen(all), NULL) == DYD_OK) {
        accepted++;
        diagram_read(&d, all);
        const char *wrong = diagram_judge(&d, &c, &r, 600);
        if (wrong) fail_msg("%s\n%s", wrong, all);
        diagram_read(&d, text);
      }
      free(line_old);
      mpz_clear(man);
    }
    free(text);
    dyd_engine_free(e);
  }
  fprintf(stderr, "# %zu smaller bounds, %zu of them proved\n", tried, accepted);
  assert_true(accepted * 2 < tried);
  diagram_clear(&d);
  orc_case_clear(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(random_cases),
                                     cmocka_unit_test(windows),
                                     cmocka_unit_test(goals),
                                     cmocka_unit_test(forged_sections),
                                     cmocka_unit_test(few_sites),
                                     cmocka_unit_test(touching_rectangles),
                                     cmocka_unit_test(distance_is_tight),
                                     cmocka_unit_test(boxes_on_one_another),
                                     cmocka_unit_test(smaller_distances)};
  return cmocka_run_group_tests_name("certificates of diagrams", tests, NULL, NULL);
}
