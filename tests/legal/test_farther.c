/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [FLT-FAR] Which of two rectangles is farther, against exact distances: from near, from within, from very far away. */
#include <setjmp.h>
#include <stdarg.h>

#include "legal/witness_filter.h"
#include "predicate/circle.h"
#include "support/random.h"

#include <cmocka.h>
#include <dyadel/predicate.h>
#include <math.h>

/* Whole numbers up to 8 with a few low bits, so that many rectangles touch, hold each other, or are in line. */
static void make_box(dyd_bbox *b, test_random *r) {
  for (int a = 0; a < 2; a++) {
    double lo = (double)test_below(r, 9), w = test_chance(r, 2) ? 0 : ldexp((double)test_below(r, 9), -3);
    if (test_chance(r, 3)) lo += ldexp(test_unit(r), -(int)test_below(r, 60));
    b->e[2 * a] = lo;
    b->e[2 * a + 1] = lo + w;
  }
}

/* c: a place, in a box of doubles of which it is a corner. */
static void make_centre(dyd_bbox *b, double c[2], test_random *r) {
  int far = test_chance(r, 3) ? 3 : (int)test_below(r, 62);
  for (int a = 0; a < 2; a++) {
    double x = test_chance(r, 4) ? (double)test_below(r, 9) : ldexp(2 * test_unit(r) - 1, far);
    double to = test_chance(r, 2) ? x : nextafter(x, test_chance(r, 2) ? HUGE_VAL : -HUGE_VAL);
    c[a] = x;
    b->e[2 * a] = fmin(x, to);
    b->e[2 * a + 1] = fmax(x, to);
  }
}

static void set_rect(dyd_rect *out, const dyd_bbox *b) {
  assert_int_equal(dyd_rect_set_d(out, b->e[0], b->e[1], b->e[2], b->e[3]), DYD_OK);
}

static void test_farther(void **state) {
  (void)state;
  test_random r = test_random_start("farther");
  dyd_rect own, other;
  dyd_point c;
  size_t true_ones = 0, told = 0, squares = 0;
  dyd_rect_init(&own);
  dyd_rect_init(&other);
  dyd_point_init(&c);
  for (size_t k = 0; k < test_cases_all(200000); k++) {
    dyd_bbox s, q, at;
    double place[2];
    make_box(&s, &r);
    make_box(&q, &r);
    make_centre(&at, place, &r);
    set_rect(&own, &s);
    set_rect(&other, &q);
    assert_int_equal(dyd_dyadic_set_d(&c.x, place[0]), DYD_OK);
    assert_int_equal(dyd_dyadic_set_d(&c.y, place[1]), DYD_OK);
    bool farther = dyd_compare_distance(&c, &own, DYD_FARTHEST, &other, DYD_CLOSEST) < 0;
    bool sure = dyd_filter_is_farther(&at, &s, &q);
    assert_true(farther || !sure);
    true_ones += farther;
    told += sure;
    squares += dyd_ds2_lower(&at, &q) > dyd_dl2_upper(&at, &s);
  }
  assert_true(told > true_ones * 99 / 100 && squares < told * 19 / 20); /* squares alone tell fewer */
  dyd_point_clear(&c);
  dyd_rect_clear(&other);
  dyd_rect_clear(&own);
}

/* A distance that is not finite is unknown. */
static void test_not_finite(void **state) {
  const dyd_bbox near = {{0, 1, 0, 1}}, far = {{5, 6, 5, 6}}, all = {{-HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL}};
  const dyd_bbox c = {{0, 0, 0, 0}}, lost = {{NAN, NAN, 0, 0}}, beyond = {{0x1p1023, 0x1p1023, 0x1p1023, 0x1p1023}};
  (void)state;
  assert_true(dyd_filter_is_farther(&c, &near, &far));
  assert_false(dyd_filter_is_farther(&c, &all, &far) || dyd_filter_is_farther(&c, &near, &all));
  assert_false(dyd_filter_is_farther(&all, &near, &far) || dyd_filter_is_farther(&lost, &near, &far));
  assert_false(dyd_filter_is_farther(&beyond, &near, &far) || dyd_filter_is_farther(&beyond, &far, &near));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_farther), cmocka_unit_test(test_not_finite)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
