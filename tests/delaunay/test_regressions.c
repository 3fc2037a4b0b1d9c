/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cases that once were answered wrongly, as they were found. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/read_case.h"
#include "skeleton/rects_filter.h"
#include <cmocka.h>
#include <math.h>

static harness shared;

static void expect_text(const char *name, const char *text) {
  orc_case c;
  orc_case_init(&c);
  read_case(&c, name, text);
  expect_right(&shared, &c);
  orc_case_clear(&c);
}

/* Pairs were listed twice, and a legal one inside a face; site 3 is surely on the hull: no outer face. */
static void test_pairs_of_faces(void **state) {
  (void)state;
  orc_case c;
  char message[MESSAGE_SIZE] = "";
  orc_case_init(&c);
  read_case(&c, "pairs twice", "0 0\n10 0\n0 10\n[9,11] [9,11]\n");
  expect_right(&shared, &c);
  dyd_sites *s = harness_sites(&c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  assert_non_null(pd);
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd); f++) {
    dyd_index_list l = {0};
    bool outer = true;
    assert_int_equal(dyd_delaunay_face(&l, &outer, pd, f), DYD_OK);
    assert_false(outer);
    dyd_index_list_clear(&l);
  }
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  orc_case_clear(&c);
}

/* An alias stayed in the order of a line [LINE-1]. */
static void test_alias_on_a_line(void **state) {
  (void)state;
  expect_text("alias", "3 -4\n3 -3\n3 -3\n");
  expect_text("alias", "1 2\n0 1\n0 1\n");
}

/* Two sites had to move apart before the third could leave their line. */
static void test_leave_line(void **state) {
  (void)state;
  expect_text("leave line", "[0,2] 0\n1 [1,2]\n1 [1,2]\n");
  expect_text("leave line", "0 [0,2]\n[1,2] 1\n[1,2] 1\n");
}

/* Exact points on a line: ties while their face is theirs alone, indeterminate while a rectangle touches the line. */
static void test_line_of_points(void **state) {
  (void)state;
  static const char *const text[] = {"0 0\n1 0\n2 0\n[0,2] [1,2]\n", "0 0\n1 0\n2 0\n[3,4] [0,1]\n"};
  static const int status[] = {DYD_TIE, DYD_INDETERMINATE};
  for (int k = 0; k < 2; k++) {
    orc_case c;
    orc_case_init(&c);
    read_case(&c, "line of points", text[k]);
    assert_int_equal(engine_status(&c, 0, 2, false), status[k]);
    assert_int_equal(engine_status(&c, 0, 1, false), DYD_LEGAL);
    orc_case_clear(&c);
    expect_text("line of points", text[k]);
  }
}

/* The doubles of [FLT-SMALL] overflowed, or underflowed, when everything is scaled by 2^e. */
static void test_scales(void **state) {
  (void)state;
  static const long exps[] = {-1000, -500, -300, -250, -243, -240, 0,   200, 217,
                              220,   221,  250,  255,  300,  505,  515, 1000};
  orc_case c;
  orc_case_init(&c);
  for (size_t k = 0; k < sizeof exps / sizeof *exps; k++) {
    read_case(&c, "scaled", "[10,14] [-7,-4]\n8 [-10,-9]\n[8,11] [-8,-4]\n[7,11] [-11,-8]\n");
    orc_case_scale(&c, exps[k]);
    expect_right(&shared, &c);
  }
  orc_case_clear(&c);
}

/* A witness that was not found, though there is room for it: the pair must be legal in all images of the case. */
static void expect_legal(const char *name, const char *text, uint32_t i, uint32_t j, int unit) {
  orc_case c, image;
  orc_case_init(&c);
  orc_case_init(&image);
  read_case(&c, name, text);
  orc_case_scale(&c, unit);
  expect_right(&shared, &c);
  for (unsigned symmetry = 0; symmetry < 8; symmetry++)
    for (int reversed = 0; reversed < 2; reversed++) {
      size_t order[ORC_MAX];
      uint32_t last = (uint32_t)c.n - 1;
      for (size_t k = 0; k < c.n; k++) order[k] = reversed ? last - k : k;
      orc_case_permute(&image, &c, order, c.n);
      orc_case_turn(&image, symmetry);
      uint32_t a = reversed ? last - i : i, b = reversed ? last - j : j;
      for (int exact = 0; exact < 2; exact++) {
        if (engine_status(&image, a, b, exact) == DYD_LEGAL) continue;
        orc_case_print(stderr, &image);
        fail_msg("%s: %u %u is legal, symmetry %u", name, a, b, symmetry);
      }
    }
  orc_case_clear(&image);
  orc_case_clear(&c);
}

/* A wedge of about 2^-27: only soundness is required [WIT-1]. */
static void test_thin_wedge(void **state) {
  (void)state;
  expect_text("wedge", "[-5*2^524,-3*2^524] [-9*2^524,-1*2^527]\n"
                       "0 [-1*2^-6,-3*2^-8]\n"
                       "[-5*2^-195,-3*2^-195] -5*2^-195\n"
                       "0 [-1*2^-166,-1*2^-167]\n");
}

static void test_mixed_scales(void **state) {
  (void)state;
  expect_legal("mixed scales A",
               "[-671088640,-536870912] [-469762048,-402653184]\n"
               "[-1*2^147,-3*2^145] [-1*2^147,-7*2^144]\n"
               "[-1*2^-19,-7*2^-22] [-1*2^-19,-3*2^-21]\n"
               "[-5*2^-403,-1*2^-401] [-3*2^-404,-1*2^-403]\n"
               "[-3*2^-204,-1*2^-204] [-1*2^-201,-3*2^-203]\n",
               2, 4, 0);
  expect_legal("mixed scales B",
               "[1*2^-303,5*2^-305] -5*2^-305\n"
               "[1*2^-215,1*2^-214] -1*2^-216\n"
               "0 [-1*2^-278,0]\n"
               "[1*2^-385,3*2^-386] [-9*2^-386,-7*2^-386]\n"
               "[1*2^-356,5*2^-358] [-3*2^-358,-1*2^-358]\n",
               4, 3, 0);
}

static void test_fat_regions(void **state) {
  (void)state;
  expect_legal("fat A",
               "[-3,-1] [0,1]\n[-1,1] [0,2]\n[-2,0] [549755813887,549755813888]\n[-4,-2] 1649267441664\n"
               "[-1099511627779,-1099511627778] [1099511627775,1099511627775]\n"
               "[-2,-1] 1099511627775\n[-549755813889,-549755813887] -2\n[-3,-2] [2,4]\n",
               2, 5, -39);
  expect_legal("fat B",
               "25165824 [41943040,58720256]\n[7*2^-27,9*2^-27] [7*2^-27,1*2^-24]\n"
               "[1*2^-27,3*2^-28] [7*2^-28,1*2^-25]\n[3*2^-22,7*2^-23] 3*2^-22\n"
               "[5*2^-25,7*2^-25] 7*2^-25\n",
               2, 4, 0);
}

/* Six exact points where a term overflowed before its bound [FLT-INC]. */
static void test_overflowing_bound(void **state) {
  (void)state;
  expect_text("overflow", "-0x1.ff5695p+255 0x1.7cdbdbdp+255\n0x1.35d08f1p+254 0x1.7cb1d9ap+255\n"
                          "0x1.259ada7p+255 -0x1.067517b8p+255\n-0x1.8bb7beap+255 -0x1.95b687ep+254\n"
                          "0x1.0df3b71p+255 0x1.b4106ae8p+255\n0x1.a2823fp+251 0x1.86b57ecp+255\n");
}

/* Infinite centres and infinite boxes: ds has no bound from above [FLT-DST]. */
static void test_infinite_boxes(void **state) {
  (void)state;
  dyd_bbox plane = {{-HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL}}, unit = {{0, 1, 0, 1}};
  assert_true(dyd_ds2_upper(&plane, &plane, HUGE_VAL) == HUGE_VAL);
  assert_true(dyd_ds2_upper(&plane, &plane, 0) == HUGE_VAL);
  assert_true(dyd_ds2_upper(&plane, &unit, 0) == HUGE_VAL);
  assert_true(dyd_ds2_upper(&unit, &plane, HUGE_VAL) == HUGE_VAL);
  assert_true(dyd_dl2_upper(&unit, &plane) == HUGE_VAL);
  assert_true(dyd_ds2_lower(&plane, &plane) <= 0);
  expect_text("infinite boxes", "[-1*2^2000,1*2^2000] [-1*2^2000,1*2^2000]\n1*2^3000 0\n-1*2^3000 5\n0 1*2^2990\n"
                                "0 -1*2^2500\n");
}

/* Random cases with coordinates far beyond doubles beside small ones. Those of the usual seed have all their witnesses
 * found: none of the pairs that the search is allowed to miss for want of room is left. */
static void test_beyond_doubles(void **state) {
  (void)state;
  static const long exps[] = {3000, 2000, 1023, 0, -1070, -2000};
  orc_case c, one;
  orc_case_init(&c);
  orc_case_init(&one);
  for (size_t k = test_cases(25); k; k--) {
    c.n = 0;
    snprintf(c.kind, sizeof c.kind, "beyond doubles");
    while (c.n < 5) {
      test_random *r = &shared.random;
      long x = (long)test_between(r, -4, 4), y = (long)test_between(r, -4, 4);
      one.n = 0;
      orc_case_add(&one, x, x + (long)test_below(r, 4), y, y + (long)test_below(r, 4), 1);
      orc_case_scale(&one, exps[test_below(r, 6)]);
      orc_case_add_rect(&c, &one.rect[0]);
    }
    expect_right(&shared, &c);
  }
  if (!getenv("DYADEL_TEST_SEED")) assert_int_equal(shared.hairlines + shared.missed, 0);
  orc_case_clear(&one);
  orc_case_clear(&c);
}

/* Among overlapping rectangles, three points within a unit in the last place: their boxes meet, they do not [POS-1]. */
static void test_boxes_meet(void **state) {
  (void)state;
  expect_text("boxes meet",
              "1208925819614629174706177*2^-80 0\n1208925819614629174706178*2^-80 0\n"
              "1208925819614629174706179*2^-80 0\n[-4,4] [-4,4]\n[-4,4] [-3,4]\n[-30,-3] [-10,10]\n[3,30] [-10,10]\n"
              "[-5,5] [3,30]\n[-5,5] [-30,-3]\n");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_boxes_meet),      cmocka_unit_test(test_pairs_of_faces),
                                     cmocka_unit_test(test_alias_on_a_line), cmocka_unit_test(test_leave_line),
                                     cmocka_unit_test(test_line_of_points),  cmocka_unit_test(test_scales),
                                     cmocka_unit_test(test_thin_wedge),      cmocka_unit_test(test_mixed_scales),
                                     cmocka_unit_test(test_fat_regions),     cmocka_unit_test(test_overflowing_bound),
                                     cmocka_unit_test(test_infinite_boxes),  cmocka_unit_test(test_beyond_doubles)};
  harness_init(&shared, "regressions");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
