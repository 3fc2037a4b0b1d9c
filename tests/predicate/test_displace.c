/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Comparison of distances, the quad rule [QUAD-1], its hulls [HULL-1] and the cases of mathematics.md, section 10,
 * about them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "predicate/circle.h"
#include "predicate/predicate_filter.h"
#include "predicate/shapes.h"
#include "rect/literal.h"
#include "rect/rect.h"

static void set_point(dyd_point *p, double x, double y) {
  assert_int_equal(dyd_dyadic_set_d(&p->x, x), DYD_OK);
  assert_int_equal(dyd_dyadic_set_d(&p->y, y), DYD_OK);
}

static void check_distances(const dyd_point *c, const dyd_rect r[2]) {
  literal_rect l[2];
  mpq_t q[2], d[2][2];
  mpq_inits(q[0], q[1], d[0][0], d[0][1], d[1][0], d[1][1], NULL);
  dyd_dyadic_get_q(q[0], &c->x);
  dyd_dyadic_get_q(q[1], &c->y);
  for (int k = 0; k < 2; k++) {
    literal_init(&l[k]);
    literal_set(&l[k], &r[k]);
    for (int far = 0; far < 2; far++) literal_distance2(d[k][far], (const mpq_t *)q, &l[k], far != 0);
  }
  for (int s = 0; s < 2; s++) {
    for (int t = 0; t < 2; t++) {
      int order = mpq_cmp(d[0][s], d[1][t]);
      assert_int_equal(dyd_compare_distance(c, &r[0], (dyd_touch)s, &r[1], (dyd_touch)t), (order > 0) - (order < 0));
    }
  }
  dyd_truth nearer = mpq_cmp(d[0][1], d[1][0]) < 0 ? DYD_TRUE : mpq_cmp(d[1][1], d[0][0]) < 0 ? DYD_FALSE : DYD_UNKNOWN;
  assert_int_equal(dyd_nearer(c, &r[0], &r[1]), nearer);
  for (int k = 0; k < 2; k++) literal_clear(&l[k]);
  mpq_clears(q[0], q[1], d[0][0], d[0][1], d[1][0], d[1][1], NULL);
}

/* Ties, rational points, and doubles at every scale. */
static void test_distances(void **state) {
  (void)state;
  test_random r = test_random_start("comparison of distances");
  dyd_point c;
  dyd_rect rect[2];
  dyd_point_init(&c);
  for (int k = 0; k < 2; k++) dyd_rect_init(&rect[k]);
  for (size_t n = test_cases(8000); n > 0; n--) {
    if (test_chance(&r, 2)) {
      static const int64_t exponents[] = {0, -5, 70, -1100, 1100};
      int64_t exp = exponents[test_below(&r, 5)];
      for (int k = 0; k < 2; k++) random_rect(&rect[k], &r, 4, exp);
      (void)dyd_dyadic_set_si_2exp(&c.x, (long)test_between(&r, -2, 10), exp - 1);
      (void)dyd_dyadic_set_si_2exp(&c.y, (long)test_between(&r, -2, 10), exp - 1);
    } else {
      double scale = shape_scale(&r), box[4];
      for (int k = 0; k < 2; k++) {
        random_box(box, &r, scale, true);
        box_rect(&rect[k], box);
      }
      random_box(box, &r, scale, true);
      set_point(&c, box[0], box[2]);
    }
    check_distances(&c, rect);
  }
  for (int k = 0; k < 2; k++) dyd_rect_clear(&rect[k]);
  dyd_point_clear(&c);
}

static void test_hull_filter(void **state) {
  (void)state;
  test_random r = test_random_start("filter of disjoint hulls");
  dyd_rect rect[4];
  dyd_box box[4];
  size_t known = 0, total = 0;
  for (int k = 0; k < 4; k++) dyd_rect_init(&rect[k]);
  for (size_t n = test_cases(10000); n > 0; n--) {
    double scale = shape_scale(&r);
    bool small = test_chance(&r, 2), far = test_chance(&r, 3);
    for (int k = 0; k < 4; k++) {
      double at[4];
      random_box(at, &r, scale, test_chance(&r, 2));
      box_rect(&rect[k], at);
      if (small) random_rect(&rect[k], &r, 3, 0);
      if (far) random_far_point(&rect[k], &r);
      dyd_filter_box(&box[k], &rect[k]);
    }
    bool disjoint = dyd_partial_edges_disjoint(&rect[0], &rect[1], &rect[2], &rect[3]);
    dyd_truth answer = dyd_filter_partial_edges_disjoint(&box[0], &box[1], &box[2], &box[3]);
    if (answer == DYD_TRUE) assert_true(disjoint);
    if (answer == DYD_FALSE) assert_false(disjoint);
    if (scale == 1 && !small && !far) total++, known += answer != DYD_UNKNOWN;
  }
  assert_true(5 * known > 4 * total);
  for (int k = 0; k < 4; k++) dyd_rect_clear(&rect[k]);
}

/* The rule by its parts, its two symmetries, and monotony. */
static void test_quad_rule(void **state) {
  (void)state;
  test_random r = test_random_start("quad rule");
  dyd_rect rect[4];
  for (int k = 0; k < 4; k++) dyd_rect_init(&rect[k]);
  for (size_t n = test_cases(4000); n > 0; n--) {
    small_rect s[4];
    int grid = test_chance(&r, 3) ? 2 : 10;
    for (int k = 0; k < 4; k++) {
      s[k] = random_small(&r, grid);
      small_rect_get(&rect[k], &s[k]);
    }
    const dyd_rect *i = &rect[0], *j = &rect[1], *a = &rect[2], *b = &rect[3];
    bool expected = dyd_partial_edges_disjoint(i, j, a, b) || dyd_con(a, i, j, b) == DYD_SURE_MINUS ||
                    dyd_con(b, i, j, a) == DYD_SURE_MINUS;
    dyd_truth answer = dyd_cannot_displace(i, j, a, b);
    assert_int_equal(answer, expected ? DYD_TRUE : DYD_UNKNOWN);
    assert_int_equal(dyd_cannot_displace(j, i, b, a), answer);
    if (answer != DYD_TRUE) continue;
    for (int k = 0; k < 4; k++) {
      small_rect smaller = shrink_small(&r, &s[k]);
      small_rect_get(&rect[k], &smaller);
    }
    assert_int_equal(dyd_cannot_displace(i, j, a, b), DYD_TRUE);
  }
  for (int k = 0; k < 4; k++) dyd_rect_clear(&rect[k]);
}

/* Case 1: legal neighbours do not suffice for Int. */
static void test_case_1(void **state) {
  (void)state;
  dyd_rect site[4];
  dyd_point c;
  dyd_point_init(&c);
  for (int k = 0; k < 4; k++) dyd_rect_init(&site[k]);
  assert_int_equal(dyd_rect_set_d(&site[1], 1, 1, 0, 0), DYD_OK);
  assert_int_equal(dyd_rect_set_d(&site[2], .9, 1.1, .9, 1.1), DYD_OK);
  assert_int_equal(dyd_rect_set_d(&site[3], 0, 0, 1, 1), DYD_OK);
  set_point(&c, .48, .48);
  assert_int_equal(dyd_nearer(&c, &site[0], &site[1]), DYD_TRUE);
  assert_int_equal(dyd_nearer(&c, &site[0], &site[3]), DYD_TRUE);
  assert_int_equal(dyd_nearer(&c, &site[0], &site[2]), DYD_UNKNOWN);
  for (int k = 0; k < 4; k++) dyd_rect_clear(&site[k]);
  dyd_point_clear(&c);
}

/* Case 2: local legality is not global. */
static void test_case_2(void **state) {
  (void)state;
  dyd_rect i, j, k, l, m;
  dyd_rect *all[5] = {&i, &j, &k, &l, &m};
  for (int n = 0; n < 5; n++) dyd_rect_init(all[n]);
  mpq_t q[4];
  mpq_inits(q[0], q[1], q[2], q[3], NULL);
  mpq_set_si(q[0], 0, 1), mpq_set_si(q[1], 1, 5), mpq_set_si(q[2], 3, 10), mpq_set_si(q[3], -3, 5);
  assert_int_equal(dyd_rect_set_d(&j, 1, 1, 0, 0), DYD_OK);
  assert_int_equal(dyd_rect_set_d(&k, .5, .5, .5, .5), DYD_OK);
  assert_int_equal(dyd_rect_set_d(&l, .5, .5, 0, 0), DYD_OK);
  assert_int_equal(dyd_interval_set_q(&l.y, q[3]), DYD_OK);
  assert_int_equal(dyd_interval_set_outward(&m.x, q[0], q[1], -60), DYD_OK);
  assert_int_equal(dyd_interval_set_q(&m.y, q[2]), DYD_OK);
  assert_int_equal(dyd_con(&l, &i, &j, &k), DYD_SURE_MINUS);
  assert_int_equal(dyd_cannot_displace(&i, &j, &k, &l), DYD_TRUE);
  assert_int_equal(dyd_cannot_displace(&i, &j, &m, &l), DYD_UNKNOWN);
  mpq_clears(q[0], q[1], q[2], q[3], NULL);
  for (int n = 0; n < 5; n++) dyd_rect_clear(all[n]);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_distances), cmocka_unit_test(test_hull_filter),
                                     cmocka_unit_test(test_quad_rule), cmocka_unit_test(test_case_1),
                                     cmocka_unit_test(test_case_2)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
