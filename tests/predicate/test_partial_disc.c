/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Con and the partial disc [CON-1]: the six circles of the oracle, sampled choices, symmetry, monotony.
 *
 * Con is unsure iff some circle meets all four rectangles, whichever three are used (mathematics: section 4): a check
 * that does not know of critical circles. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "predicate/circle.h"
#include "predicate/predicate_filter.h"
#include "predicate/shapes.h"
#include "rect/rect.h"

/* Four rectangles in every form: 0, 1, 2 the triple, 3 the one asked about. */
typedef struct quad {
  small_rect s[4];
  dyd_rect rect[4];
  dyd_irect irect[4];
} quad;

static void quad_init(quad *q) {
  for (int k = 0; k < 4; k++) dyd_rect_init(&q->rect[k]), dyd_irect_init(&q->irect[k]);
}

static void quad_clear(quad *q) {
  for (int k = 0; k < 4; k++) dyd_irect_clear(&q->irect[k]), dyd_rect_clear(&q->rect[k]);
}

static void quad_set(quad *q) {
  for (int k = 0; k < 4; k++) {
    small_rect_get(&q->rect[k], &q->s[k]);
    small_irect(&q->irect[k], &q->s[k]);
  }
}

/* By the public function and by the exact rung, which must agree. */
static dyd_sure con(quad *q, int r, int a, int b, int c) {
  dyd_sure answer = dyd_con(&q->rect[r], &q->rect[a], &q->rect[b], &q->rect[c]);
  const dyd_irect *const abc[3] = {&q->irect[a], &q->irect[b], &q->irect[c]};
  dyd_sure orientation = dyd_irect_orientation(abc[0], abc[1], abc[2]);
  dyd_sure exact = orientation ? dyd_irect_con_oriented(&q->irect[r], abc, orientation) : DYD_UNSURE;
  assert_int_equal(exact, answer);
  return answer;
}

static dyd_sure con_small(const small_rect s[4]) {
  quad q;
  quad_init(&q);
  for (int k = 0; k < 4; k++) q.s[k] = s[k];
  quad_set(&q);
  dyd_sure answer = con(&q, 3, 0, 1, 2);
  quad_clear(&q);
  return answer;
}

static dyd_sure disc_con(const quad *q) {
  dyd_partial_disc d;
  dyd_partial_disc_init(&d);
  dyd_partial_disc_set(&d, &q->rect[0], &q->rect[1], &q->rect[2]);
  dyd_sure answer = dyd_partial_disc_con(&d, &q->rect[3]);
  dyd_partial_disc_clear(&d);
  return answer;
}

static void random_quad(quad *q, test_random *r) {
  int grid = test_chance(r, 4) ? 3 : 12;
  for (int k = 0; k < 4; k++) q->s[k] = random_small(r, grid);
  quad_set(q);
}

static void test_oracle(void **state) {
  (void)state;
  test_random r = test_random_start("Con against six literal circles");
  quad q;
  quad_init(&q);
  size_t seen[3] = {0};
  for (size_t n = test_cases(150); n > 0;) {
    random_quad(&q, &r);
    dyd_sure answer = con(&q, 3, 0, 1, 2);
    if (oracle_orientation(&q.s[0], &q.s[1], &q.s[2]) == DYD_UNSURE) {
      assert_int_equal(answer, DYD_UNSURE);
      continue;
    }
    assert_int_equal(answer, oracle_con(&q.s[3], q.s));
    assert_int_equal(answer, disc_con(&q));
    seen[1 + (int)answer]++;
    n--;
  }
  assert_true(seen[0] && seen[1] && seen[2]);
  quad_clear(&q);
}

/* The point number k of a 5 x 5 grid on r, in units of 1/4. */
static void sample(long out[2], const small_rect *r, uint64_t k) {
  for (int axis = 0; axis < 2; axis++, k /= 5) {
    long t = (long)(k % 5);
    out[axis] = r->end[2 * axis] * (4 - t) + r->end[2 * axis + 1] * t;
  }
}

/* In-circle determinant of p[0..2] and p[3] times the orientation of p[0..2]. Below 2^60: coordinates below 2^7. */
static int literal_incircle(long p[4][2]) {
  long x[3], y[3], det = 0;
  for (int k = 0; k < 3; k++) x[k] = p[k][0] - p[3][0], y[k] = p[k][1] - p[3][1];
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    det += (x[k] * x[k] + y[k] * y[k]) * (x[i] * y[j] - x[j] * y[i]);
  }
  long turn = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
  return ((det > 0) - (det < 0)) * ((turn > 0) - (turn < 0));
}

/* A sure answer holds for every sample; the circle through samples in all four makes it unsure. */
static void test_samples(void **state) {
  (void)state;
  test_random r = test_random_start("Con against samples");
  quad q;
  quad_init(&q);
  for (size_t n = test_cases(4000); n > 0; n--) {
    random_quad(&q, &r);
    dyd_sure answer = con(&q, 3, 0, 1, 2);
    if (answer == DYD_UNSURE) continue;
    for (int k = 0; k < 200; k++) {
      long p[4][2];
      for (int m = 0; m < 4; m++) sample(p[m], &q.s[m], test_below(&r, 25));
      assert_int_equal(literal_incircle(p), answer);
    }
  }
  quad_clear(&q);
}

/* Samples of both signs exist for most unsure quads: the answer is not idle. */
static void test_not_idle(void **state) {
  (void)state;
  test_random r = test_random_start("unsure Con is refuted by samples");
  quad q;
  quad_init(&q);
  size_t unsure = 0, mixed = 0;
  for (size_t n = test_cases(4000); n > 0; n--) {
    random_quad(&q, &r);
    if (oracle_orientation(&q.s[0], &q.s[1], &q.s[2]) == DYD_UNSURE || con(&q, 3, 0, 1, 2) != DYD_UNSURE) continue;
    bool in = false, out = false;
    for (int k = 0; k < 400 && !(in && out); k++) {
      long p[4][2];
      for (int m = 0; m < 4; m++) sample(p[m], &q.s[m], test_below(&r, 25));
      int sign = literal_incircle(p);
      in = in || sign >= 0;
      out = out || sign <= 0;
    }
    unsure++;
    mixed += in && out;
  }
  assert_true(unsure > 0 && 10 * mixed >= 9 * unsure);
  quad_clear(&q);
}

static void test_any_three(void **state) {
  (void)state;
  test_random r = test_random_start("Con by any three");
  quad q;
  quad_init(&q);
  for (size_t n = test_cases(4000); n > 0; n--) {
    random_quad(&q, &r);
    int unsure = -1;
    for (int k = 0; k < 4; k++) {
      int a = (k + 1) % 4, b = (k + 2) % 4, c = (k + 3) % 4;
      if (oracle_orientation(&q.s[a], &q.s[b], &q.s[c]) == DYD_UNSURE) continue;
      int answer = con(&q, k, a, b, c) == DYD_UNSURE;
      if (unsure < 0) unsure = answer;
      assert_int_equal(answer, unsure);
    }
  }
  quad_clear(&q);
}

static void test_symmetry(void **state) {
  (void)state;
  test_random r = test_random_start("Con, turned and mirrored");
  quad q;
  quad_init(&q);
  for (size_t n = test_cases(3000); n > 0; n--) {
    random_quad(&q, &r);
    dyd_sure answer = con(&q, 3, 0, 1, 2);
    assert_int_equal(con(&q, 3, 1, 2, 0), answer);
    assert_int_equal(con(&q, 3, 2, 1, 0), answer);
    assert_int_equal(con(&q, 3, 0, 2, 1), answer);
    small_rect turned[4], mirrored[4];
    for (int k = 0; k < 4; k++) turned[k] = turn_small(&q.s[k]), mirrored[k] = mirror_small(&q.s[k]);
    assert_int_equal(con_small(turned), answer);
    assert_int_equal(con_small(mirrored), answer);
  }
  quad_clear(&q);
}

static void test_monotone(void **state) {
  (void)state;
  test_random r = test_random_start("Con of smaller rectangles");
  quad q;
  quad_init(&q);
  for (size_t n = test_cases(4000); n > 0; n--) {
    random_quad(&q, &r);
    dyd_sure answer = con(&q, 3, 0, 1, 2);
    if (answer == DYD_UNSURE) continue;
    small_rect smaller[4];
    for (int k = 0; k < 4; k++) smaller[k] = shrink_small(&r, &q.s[k]);
    assert_int_equal(con_small(smaller), answer);
  }
  quad_clear(&q);
}

/* Every triple of points of {0,1,2}^2 with every rectangle there. */
static void test_exhaustive(void **state) {
  (void)state;
  static const int lo[6] = {0, 0, 0, 1, 1, 2}, hi[6] = {0, 1, 2, 1, 2, 2};
  quad q;
  quad_init(&q);
  for (int n = 0; n < 729 * 36; n++) {
    for (int k = 0, m = n; k < 3; k++, m /= 9) q.s[k] = (small_rect){{m % 3, m % 3, m / 3 % 3, m / 3 % 3}};
    int m = n / 729;
    q.s[3] = (small_rect){{lo[m % 6], hi[m % 6], lo[m / 6], hi[m / 6]}};
    quad_set(&q);
    dyd_sure answer = con(&q, 3, 0, 1, 2);
    int least = 1, most = -1;
    if (oracle_orientation(&q.s[0], &q.s[1], &q.s[2]) == DYD_UNSURE) least = -1, most = 1;
    /* A fixed circle: the farthest point of the rectangle is a corner; the closest is a corner, the centre or the foot
     * of it on a side, and on this grid a sample shows the same sign. */
    for (uint64_t k = 0; k < 25; k++) {
      long p[4][2];
      for (int j = 0; j < 4; j++) sample(p[j], &q.s[j], k);
      int sign = literal_incircle(p);
      if (sign < least) least = sign;
      if (sign > most) most = sign;
    }
    dyd_sure expected = least > 0 ? DYD_SURE_PLUS : most < 0 ? DYD_SURE_MINUS : DYD_UNSURE;
    assert_int_equal(answer, expected);
  }
  quad_clear(&q);
}

/* The public answer, the partial disc and both filters against the exact rung; is the filter for mixed quads right? */
static bool check_scaled(quad *q) {
  const dyd_rect *in[4] = {&q->rect[0], &q->rect[1], &q->rect[2], &q->rect[3]};
  dyd_irects_scale(q->irect, in, 4, NULL, NULL);
  dyd_sure answer = con(q, 3, 0, 1, 2);
  assert_int_equal(disc_con(q), answer);
  dyd_box box[4];
  bool exact = true;
  for (int k = 0; k < 4; k++) {
    dyd_filter_box(&box[k], in[k]);
    exact = exact && box[k].exact;
  }
  int turn = (int)dyd_irect_orientation(&q->irect[0], &q->irect[1], &q->irect[2]);
  int sign = (int)dyd_filter_incircle(box[0].outer, box[1].outer, box[2].outer, box[3].outer);
  bool mixed = dyd_filter_incircle_mixed(box[0].outer, box[1].outer, box[2].outer, box[3].outer);
  if (sign && turn) assert_int_equal(sign * turn, answer);
  if (turn && mixed && exact) assert_int_equal(answer, DYD_UNSURE);
  return mixed;
}

/* Cocircular and collinear doubles at every scale. */
static void test_scales(void **state) {
  (void)state;
  test_random r = test_random_start("Con at all scales");
  static const double circle[8][2] = {{25, 0}, {24, 7}, {20, 15}, {7, 24}, {-15, 20}, {-25, 0}, {-7, -24}, {15, -20}};
  quad q;
  quad_init(&q);
  for (size_t n = test_cases(6000); n > 0; n--) {
    double scale = shape_scale(&r);
    bool cocircular = test_chance(&r, 2);
    for (int k = 0; k < 4; k++) {
      double box[4];
      random_box(box, &r, scale, test_chance(&r, 2));
      const double *p = circle[test_below(&r, 8)];
      for (int axis = 0; axis < 2 && cocircular; axis++) {
        box[2 * axis] = test_chance(&r, 8) ? jitter(&r, scale * p[axis]) : scale * p[axis];
        box[2 * axis + 1] = test_chance(&r, 4) ? box[2 * axis] + fabs(scale) * 0.25 : box[2 * axis];
      }
      box_rect(&q.rect[k], box);
    }
    check_scaled(&q);
  }
  quad_clear(&q);
}

static void test_wide_boxes_of_points(void **state) {
  (void)state;
  test_random r = test_random_start("Con of points with wide boxes");
  quad q;
  quad_init(&q);
  for (size_t n = test_cases(3000); n > 0; n--) {
    for (int k = 0; k < 4; k++) random_far_point(&q.rect[k], &r);
    check_scaled(&q);
  }
  quad_clear(&q);
}

/* Most unsure quads of wide boxes need no integers. */
static void test_filter_answers(void **state) {
  (void)state;
  test_random r = test_random_start("filter of unsure Con");
  quad q;
  quad_init(&q);
  size_t unsure = 0, filtered = 0;
  for (size_t n = test_cases(3000); n > 0; n--) {
    random_quad(&q, &r);
    if (oracle_orientation(&q.s[0], &q.s[1], &q.s[2]) == DYD_UNSURE || con(&q, 3, 0, 1, 2) != DYD_UNSURE) continue;
    unsure++;
    filtered += check_scaled(&q);
  }
  assert_true(unsure > 0 && 2 * filtered > unsure);
  quad_clear(&q);
}

/* Rational points on the unit circle: a tie is a tie. */
static void test_rational_ties(void **state) {
  (void)state;
  static const long triple[4][3] = {{3, 4, 5}, {5, 12, 13}, {-8, 15, 17}, {20, -21, 29}};
  dyd_rect rect[4];
  mpq_t x, y;
  mpq_inits(x, y, NULL);
  for (int k = 0; k < 4; k++) {
    dyd_rect_init(&rect[k]);
    mpq_set_si(x, triple[k][0], (unsigned long)triple[k][2]);
    mpq_set_si(y, triple[k][1], (unsigned long)triple[k][2]);
    assert_int_equal(dyd_rect_set_q(&rect[k], x, y), DYD_OK);
  }
  assert_int_equal(dyd_con(&rect[3], &rect[0], &rect[1], &rect[2]), DYD_UNSURE);
  for (int sign = -1; sign <= 1; sign += 2) { /* moved in or out by 2^-300 */
    mpq_set_si(x, sign, 1);
    mpq_div_2exp(x, x, 300);
    mpq_set_si(y, 20, 29);
    mpq_add(x, x, y);
    mpq_set_si(y, -21, 29);
    assert_int_equal(dyd_rect_set_q(&rect[3], x, y), DYD_OK);
    assert_int_equal(dyd_con(&rect[3], &rect[0], &rect[1], &rect[2]), -sign);
  }
  mpq_clears(x, y, NULL);
  for (int k = 0; k < 4; k++) dyd_rect_clear(&rect[k]);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_oracle),        cmocka_unit_test(test_samples),
                                     cmocka_unit_test(test_not_idle),      cmocka_unit_test(test_any_three),
                                     cmocka_unit_test(test_symmetry),      cmocka_unit_test(test_monotone),
                                     cmocka_unit_test(test_exhaustive),    cmocka_unit_test(test_scales),
                                     cmocka_unit_test(test_rational_ties), cmocka_unit_test(test_wide_boxes_of_points),
                                     cmocka_unit_test(test_filter_answers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
