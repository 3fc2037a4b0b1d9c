/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Orientation [ORI-1]: 64 literal choices on every triple of a grid; filters against integers at every scale. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "predicate/circle.h"
#include "predicate/predicate_filter.h"
#include "predicate/shapes.h"
#include "rect/rect.h"

enum { SIDES = 6, RECTS = SIDES * SIDES };
static const int side_lo[SIDES] = {0, 0, 0, 1, 1, 2}, side_hi[SIDES] = {0, 1, 2, 1, 2, 2};

/* Every triple of rectangles with corners in {0,1,2}^2. */
static void test_exhaustive(void **state) {
  (void)state;
  static small_rect small[RECTS];
  static dyd_rect rect[RECTS];
  static dyd_irect irect[RECTS];
  for (int k = 0; k < RECTS; k++) {
    small[k] = (small_rect){{side_lo[k % SIDES], side_hi[k % SIDES], side_lo[k / SIDES], side_hi[k / SIDES]}};
    dyd_rect_init(&rect[k]), dyd_irect_init(&irect[k]);
    small_rect_get(&rect[k], &small[k]);
    small_irect(&irect[k], &small[k]);
  }
  for (int n = 0; n < RECTS * RECTS * RECTS; n++) {
    int i = n % RECTS, j = n / RECTS % RECTS, k = n / RECTS / RECTS;
    dyd_sure expected = oracle_orientation(&small[i], &small[j], &small[k]);
    assert_int_equal(dyd_orientation(&rect[i], &rect[j], &rect[k]), expected);
    assert_int_equal(dyd_irect_orientation(&irect[i], &irect[j], &irect[k]), expected);
  }
  for (int k = 0; k < RECTS; k++) dyd_irect_clear(&irect[k]), dyd_rect_clear(&rect[k]);
}

typedef struct workspace {
  dyd_rect rect[3];
  dyd_irect irect[3];
  double box[3][4];
} workspace;

static void workspace_init(workspace *w) {
  for (int k = 0; k < 3; k++) dyd_rect_init(&w->rect[k]), dyd_irect_init(&w->irect[k]);
}

static void workspace_clear(workspace *w) {
  for (int k = 0; k < 3; k++) dyd_irect_clear(&w->irect[k]), dyd_rect_clear(&w->rect[k]);
}

static void check_scaled(workspace *w) {
  const dyd_rect *in[3] = {&w->rect[0], &w->rect[1], &w->rect[2]};
  dyd_irects_scale(w->irect, in, 3, NULL, NULL);
  dyd_sure exact = dyd_irect_orientation(&w->irect[0], &w->irect[1], &w->irect[2]);
  assert_int_equal(dyd_orientation(in[0], in[1], in[2]), exact);
  assert_int_equal(dyd_orientation(in[1], in[2], in[0]), exact);
  assert_int_equal(dyd_orientation(in[1], in[0], in[2]), -(int)exact);
  dyd_box box[3];
  for (int k = 0; k < 3; k++) dyd_filter_box(&box[k], in[k]);
  dyd_turns t = dyd_filter_turns(box[0].outer, box[1].outer, box[2].outer);
  assert_true(!t.all_left || exact == DYD_SURE_PLUS);
  assert_true(!t.all_right || exact == DYD_SURE_MINUS);
  if (box[0].exact && box[1].exact && box[2].exact && t.some_left) assert_true(exact != DYD_SURE_MINUS);
  if (box[0].exact && box[1].exact && box[2].exact && t.some_right) assert_true(exact != DYD_SURE_PLUS);
}

static void test_scales(void **state) {
  (void)state;
  test_random r = test_random_start("orientation at all scales");
  workspace w;
  workspace_init(&w);
  for (size_t n = test_cases(20000); n > 0; n--) {
    double scale = shape_scale(&r);
    bool tie = test_chance(&r, 2);
    for (int k = 0; k < 3; k++) {
      random_box(w.box[k], &r, test_chance(&r, 20) ? shape_scale(&r) : scale, tie);
      box_rect(&w.rect[k], w.box[k]);
    }
    check_scaled(&w);
  }
  workspace_clear(&w);
}

/* Exact rational points on a line and just next to it: doubles cannot decide, the exact rung can. */
static void test_rational_points(void **state) {
  (void)state;
  test_random r = test_random_start("rational points");
  workspace w;
  workspace_init(&w);
  mpq_t x, y;
  mpq_inits(x, y, NULL);
  for (size_t n = test_cases(2000); n > 0; n--) {
    bool beside = test_chance(&r, 2);
    for (int k = 0; k < 3; k++) {
      mpq_set_si(x, (long)test_between(&r, -30, 30), 30);
      mpq_canonicalize(x);
      mpq_set_si(y, 7, 3);
      mpq_mul(y, y, x);
      if (beside && k == 2) {
        mpq_set_si(x, 1, 1);
        mpq_div_2exp(x, x, 200);
        mpq_add(y, y, x);
        mpq_set_si(x, 40, 30);
        mpq_canonicalize(x);
      }
      assert_int_equal(dyd_rect_set_q(&w.rect[k], x, y), DYD_OK);
    }
    check_scaled(&w);
    if (!beside) assert_int_equal(dyd_orientation(&w.rect[0], &w.rect[1], &w.rect[2]), DYD_UNSURE);
  }
  mpq_clears(x, y, NULL);
  workspace_clear(&w);
}

static void test_wide_boxes_of_points(void **state) {
  (void)state;
  test_random r = test_random_start("points with wide boxes");
  workspace w;
  workspace_init(&w);
  for (size_t n = test_cases(3000); n > 0; n--) {
    for (int k = 0; k < 3; k++) random_far_point(&w.rect[k], &r);
    check_scaled(&w);
  }
  workspace_clear(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_exhaustive), cmocka_unit_test(test_scales),
                                     cmocka_unit_test(test_rational_points),
                                     cmocka_unit_test(test_wide_boxes_of_points)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
