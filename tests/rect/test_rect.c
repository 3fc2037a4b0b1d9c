/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Intervals, rectangles, distances and hulls against literal rational oracles [DIST-1] [HULL-1]. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "rect/irect.h"
#include "rect/literal.h"
#include "rect/rect.h"

static const int64_t exponents[] = {0, 0, -3, 60, -1080, 1030, -3000};

static int64_t random_scale(test_random *r) {
  return exponents[test_below(r, sizeof exponents / sizeof *exponents)];
}

static void test_interval_order(void **state) {
  (void)state;
  test_random r = test_random_start("interval order");
  dyd_interval a, b, c;
  mpq_t a0, a1, b0, b1, c0, c1;
  dyd_interval_init(&a), dyd_interval_init(&b), dyd_interval_init(&c);
  mpq_inits(a0, a1, b0, b1, c0, c1, NULL);
  for (size_t n = test_cases(30000); n > 0; n--) {
    int64_t exp = random_scale(&r);
    random_interval(&a, &r, 4, exp);
    random_interval(&b, &r, 4, test_chance(&r, 4) ? exp + 1 : exp);
    assert_true(dyd_interval_is_valid(&a));
    dyd_interval_get_q(a0, a1, &a);
    dyd_interval_get_q(b0, b1, &b);
    assert_int_equal(dyd_interval_is_point(&a), mpq_equal(a0, a1) != 0);
    assert_int_equal(dyd_interval_contains(&a, &b), mpq_cmp(a0, b0) <= 0 && mpq_cmp(b1, a1) <= 0);
    bool meets = mpq_cmp(a0, b1) <= 0 && mpq_cmp(b0, a1) <= 0;
    assert_int_equal(dyd_interval_meets(&a, &b), meets);
    assert_int_equal(dyd_interval_intersect(&c, &a, &b), meets ? DYD_OK : DYD_E_ARG);
    if (!meets) continue;
    dyd_interval_get_q(c0, c1, &c);
    assert_true(dyd_interval_is_valid(&c));
    assert_true(mpq_equal(c0, mpq_cmp(a0, b0) > 0 ? a0 : b0));
    assert_true(mpq_equal(c1, mpq_cmp(a1, b1) < 0 ? a1 : b1));
  }
  mpq_clears(a0, a1, b0, b1, c0, c1, NULL);
  dyd_interval_clear(&c), dyd_interval_clear(&b), dyd_interval_clear(&a);
}

/* d is the double nearest to q on its side. */
static void check_nearest(double d, const mpq_t q, int side) {
  if (isinf(d)) return;
  mpq_t v;
  mpq_init(v);
  mpq_set_d(v, d);
  assert_true(side * mpq_cmp(v, q) >= 0);
  double inner = nextafter(d, side * -HUGE_VAL);
  if (isfinite(inner)) {
    mpq_set_d(v, inner);
    assert_true(side * mpq_cmp(v, q) < 0);
  }
  mpq_clear(v);
}

static void test_interval_size(void **state) {
  (void)state;
  test_random r = test_random_start("interval size");
  dyd_interval a, b;
  mpq_t lo, hi, t, l, h;
  dyd_interval_init(&a), dyd_interval_init(&b);
  mpq_inits(lo, hi, t, l, h, NULL);
  for (size_t n = test_cases(20000); n > 0; n--) {
    random_interval(&a, &r, test_chance(&r, 2) ? 9 : 1000000, random_scale(&r));
    dyd_interval_get_q(lo, hi, &a);
    double dlo, dhi;
    dyd_interval_get_d(&dlo, &dhi, &a);
    check_nearest(dlo, lo, -1);
    check_nearest(dhi, hi, 1);
    int64_t bits = dyd_interval_bits(&a);
    mpq_sub(t, hi, lo);
    if (!mpq_sgn(t)) {
      assert_true(bits == INT64_MAX);
      continue;
    }
    if (bits >= 0) mpq_mul_2exp(t, t, (mp_bitcnt_t)bits);
    if (bits < 0) mpq_div_2exp(t, t, (mp_bitcnt_t)-bits);
    assert_true(mpq_cmp_ui(t, 1, 1) <= 0 && mpq_cmp_ui(t, 1, 2) > 0);
    dyd_interval_round(&b, &a);
    dyd_interval_get_q(l, h, &b);
    assert_true(dyd_interval_is_valid(&b) && mpz_cmp_ui(b.den, 1) == 0 && dyd_interval_contains(&b, &a));
    mpq_sub(t, hi, lo);
    mpq_sub(l, h, l);
    mpq_sub(l, l, t);
    mpq_mul_2exp(l, l, 64);
    assert_true(mpq_cmp(l, t) < 0); /* 2^-64 of the width */
    for (int k = 0; k < 2; k++) {
      dyd_interval_set(&b, &a);
      dyd_interval_set_over(&b, k ? &b.hi : &b.lo, b.den);
      dyd_interval_get_q(l, h, &b);
      assert_true(dyd_interval_is_valid(&b) && mpq_equal(l, h) && mpq_equal(l, k ? hi : lo));
    }
    mpz_add_ui(mpq_denref(lo), mpq_denref(lo), 2); /* some rationals in order */
    mpq_canonicalize(lo);
    if (mpq_cmp(lo, hi) > 0) continue;
    int64_t exp = test_between(&r, -80, 80);
    assert_int_equal(dyd_interval_set_outward(&a, lo, hi, exp), DYD_OK);
    assert_true(dyd_interval_is_valid(&a));
    dyd_interval_get_q(l, h, &a);
    assert_true(mpq_cmp(l, lo) <= 0 && mpq_cmp(hi, h) <= 0);
  }
  mpq_clears(lo, hi, t, l, h, NULL);
  dyd_interval_clear(&b), dyd_interval_clear(&a);
}

static void test_interval_refused(void **state) {
  (void)state;
  dyd_interval a;
  dyd_rect rect;
  mpq_t q;
  dyd_interval_init(&a);
  dyd_rect_init(&rect);
  mpq_init(q);
  assert_int_equal(dyd_interval_set_d(&a, 1, 2), DYD_OK);
  assert_int_equal(dyd_interval_set_d(&a, 2, 1), DYD_E_ARG);
  assert_int_equal(dyd_interval_set_d(&a, (double)NAN, 1), DYD_E_ARG);
  assert_int_equal(dyd_interval_set_d(&a, -HUGE_VAL, 1), DYD_E_ARG);
  assert_int_equal(dyd_interval_set_ends(&a, &a.hi, &a.lo), DYD_E_ARG);
  mpq_set_ui(q, 1, 3);
  mpq_div_2exp(q, q, (mp_bitcnt_t)DYD_EXP_LIMIT + 1);
  assert_int_equal(dyd_interval_set_q(&a, q), DYD_E_RANGE);
  assert_int_equal(mpz_get_si(a.lo.man), 1); /* unchanged */
  assert_int_equal(dyd_interval_bits(&a), 0);
  assert_int_equal(dyd_rect_set_d(&rect, 0, 1, 1, 0), DYD_E_ARG);
  assert_true(dyd_rect_is_point(&rect));
  mpq_set_ui(q, 1, 3);
  assert_int_equal(dyd_rect_set_q(&rect, q, q), DYD_OK);
  assert_true(dyd_rect_is_point(&rect) && dyd_rect_bits(&rect) == INT64_MAX);
  mpq_clear(q);
  dyd_rect_clear(&rect);
  dyd_interval_clear(&a);
}

static void test_rect_order(void **state) {
  (void)state;
  test_random r = test_random_start("rectangle order");
  dyd_rect a, b;
  dyd_rect_init(&a), dyd_rect_init(&b);
  for (size_t n = test_cases(10000); n > 0; n--) {
    random_rect(&a, &r, 2, 0);
    random_rect(&b, &r, 2, 0);
    bool ab = dyd_rect_contains(&a, &b), ba = dyd_rect_contains(&b, &a);
    assert_int_equal(ab, dyd_interval_contains(&a.x, &b.x) && dyd_interval_contains(&a.y, &b.y));
    assert_int_equal(dyd_rect_equal(&a, &b), ab && ba);
    assert_int_equal(dyd_rect_meets(&a, &b), dyd_interval_meets(&a.x, &b.x) && dyd_interval_meets(&a.y, &b.y));
    int64_t x = dyd_interval_bits(&a.x), y = dyd_interval_bits(&a.y);
    assert_true(dyd_rect_bits(&a) == (x < y ? x : y));
    dyd_rect_swap(&a, &b);
    dyd_rect_set(&a, &b);
    assert_true(dyd_rect_equal(&a, &b));
  }
  dyd_rect_clear(&b), dyd_rect_clear(&a);
}

static void test_distances(void **state) {
  (void)state;
  test_random r = test_random_start("distances");
  dyd_rect a;
  dyd_point c, d;
  literal_rect l;
  mpq_t q[2], got, expected;
  dyd_rect_init(&a), dyd_point_init(&c), dyd_point_init(&d), literal_init(&l);
  mpq_inits(q[0], q[1], got, expected, NULL);
  for (size_t n = test_cases(20000); n > 0; n--) {
    int64_t exp = random_scale(&r);
    random_rect(&a, &r, 4, exp);
    literal_set(&l, &a);
    (void)dyd_dyadic_set_si_2exp(&c.x, (long)test_between(&r, -2, 10), exp - 1);
    (void)dyd_dyadic_set_si_2exp(&c.y, (long)test_between(&r, -2, 10), exp - 1);
    dyd_point_set(&d, &c);
    dyd_dyadic_get_q(q[0], &d.x);
    dyd_dyadic_get_q(q[1], &d.y);
    for (int far = 0; far < 2; far++) {
      literal_distance2(expected, (const mpq_t *)q, &l, far != 0);
      (far ? dyd_rect_dl2 : dyd_rect_ds2)(got, &c, &a);
      assert_true(mpq_equal(got, expected));
    }
  }
  mpq_clears(q[0], q[1], got, expected, NULL);
  literal_clear(&l), dyd_point_clear(&d), dyd_point_clear(&c), dyd_rect_clear(&a);
}

/* The eight corners of two rectangles as borrowed coordinates. */
typedef struct corners {
  mpq_t *at[8][2];
} corners;

static corners corners_of(literal_rect *a, literal_rect *b) {
  corners c;
  for (int k = 0; k < 8; k++) {
    literal_rect *l = k < 4 ? a : b;
    c.at[k][0] = &l->end[k & 1];
    c.at[k][1] = &l->end[2 + (k >> 1 & 1)];
  }
  return c;
}

/* Twice the area: the sum of p x q over ordered pairs with all corners on or left of pq, and none on the line beyond
 * the segment; equal corners count once. */
static void literal_hull_area2(mpq_t out, const corners *c) {
  mpq_t t, s;
  mpq_inits(t, s, NULL);
  mpq_set_ui(out, 0, 1);
  for (int i = 0; i < 8; i++) {
    for (int j = 0; j < 8; j++) {
      bool edge = true, repeated = false;
      for (int k = 0; k < 8 && edge; k++) {
        literal_cross(t, c->at[i], c->at[j], c->at[k]);
        edge = mpq_sgn(t) >= 0;
        if (edge && !mpq_sgn(t)) { /* on the line: must be within the segment */
          for (int axis = 0; axis < 2; axis++) {
            mpq_srcptr p = *c->at[i][axis], q = *c->at[j][axis], x = *c->at[k][axis];
            if ((mpq_cmp(x, p) < 0 && mpq_cmp(x, q) < 0) || (mpq_cmp(x, p) > 0 && mpq_cmp(x, q) > 0)) edge = false;
          }
        }
      }
      for (int k = 0; k < 8; k++) {
        bool same_i = mpq_equal(*c->at[k][0], *c->at[i][0]) && mpq_equal(*c->at[k][1], *c->at[i][1]);
        bool same_j = mpq_equal(*c->at[k][0], *c->at[j][0]) && mpq_equal(*c->at[k][1], *c->at[j][1]);
        repeated = repeated || (same_i && k < i) || (same_j && k < j);
      }
      if (!edge || repeated) continue;
      mpq_mul(t, *c->at[i][0], *c->at[j][1]);
      mpq_mul(s, *c->at[i][1], *c->at[j][0]);
      mpq_sub(t, t, s);
      mpq_add(out, out, t);
    }
  }
  mpq_clears(t, s, NULL);
}

/* Disjoint iff 0 is outside the hull of the differences d: iff none is 0 and all lie within [0,180) degrees from
 * one of them. */
static bool literal_hulls_disjoint(const corners *p, const corners *q) {
  mpq_t d[64][2], s, t;
  mpq_inits(s, t, NULL);
  bool zero = false, found = false;
  for (int k = 0; k < 64; k++) {
    mpq_inits(d[k][0], d[k][1], NULL);
    for (int axis = 0; axis < 2; axis++) mpq_sub(d[k][axis], *p->at[k / 8][axis], *q->at[k % 8][axis]);
    zero = zero || (!mpq_sgn(d[k][0]) && !mpq_sgn(d[k][1]));
  }
  for (int i = 0; i < 64 && !zero && !found; i++) {
    found = true;
    for (int j = 0; j < 64 && found; j++) {
      mpq_mul(s, d[i][0], d[j][1]);
      mpq_mul(t, d[i][1], d[j][0]);
      int cross = mpq_cmp(s, t);
      mpq_mul(s, d[i][0], d[j][0]);
      mpq_mul(t, d[i][1], d[j][1]);
      mpq_add(s, s, t);
      found = cross > 0 || (cross == 0 && mpq_sgn(s) > 0);
    }
  }
  for (int k = 0; k < 64; k++) mpq_clears(d[k][0], d[k][1], NULL);
  mpq_clears(s, t, NULL);
  return found;
}

static void check_hulls(const dyd_rect r[4], literal_rect l[4]) {
  mpq_t got, expected;
  mpq_inits(got, expected, NULL);
  for (int k = 0; k < 4; k++) literal_set(&l[k], &r[k]);
  corners p = corners_of(&l[0], &l[1]), q = corners_of(&l[2], &l[3]);
  dyd_partial_edge_area2(got, &r[0], &r[1]);
  literal_hull_area2(expected, &p);
  assert_true(mpq_equal(got, expected));
  bool disjoint = literal_hulls_disjoint(&p, &q);
  assert_int_equal(dyd_partial_edges_disjoint(&r[0], &r[1], &r[2], &r[3]), disjoint);
  assert_int_equal(dyd_partial_edges_disjoint(&r[3], &r[2], &r[1], &r[0]), disjoint);
  mpq_clears(got, expected, NULL);
}

static void test_hulls_random(void **state) {
  (void)state;
  test_random r = test_random_start("hulls");
  dyd_rect rect[4];
  literal_rect l[4];
  for (int k = 0; k < 4; k++) dyd_rect_init(&rect[k]), literal_init(&l[k]);
  for (size_t n = test_cases(1500); n > 0; n--) {
    int64_t exp = random_scale(&r), grid = test_between(&r, 1, 7);
    for (int k = 0; k < 4; k++) random_rect(&rect[k], &r, grid, exp);
    check_hulls(rect, l);
  }
  for (int k = 0; k < 4; k++) literal_clear(&l[k]), dyd_rect_clear(&rect[k]);
}

/* Every four rectangles with corners in {0,1}^2. */
static void test_hulls_exhaustive(void **state) {
  (void)state;
  static const double lo[] = {0, 0, 1}, hi[] = {0, 1, 1};
  dyd_rect rect[4];
  literal_rect l[4];
  for (int k = 0; k < 4; k++) dyd_rect_init(&rect[k]), literal_init(&l[k]);
  for (int n = 0; n < 6561; n++) {
    for (int k = 0, m = n; k < 4; k++, m /= 9) {
      assert_int_equal(dyd_rect_set_d(&rect[k], lo[m % 3], hi[m % 3], lo[m / 3 % 3], hi[m / 3 % 3]), DYD_OK);
    }
    if (n % 5 == 0) check_hulls(rect, l);
  }
  for (int k = 0; k < 4; k++) literal_clear(&l[k]), dyd_rect_clear(&rect[k]);
}

/* 2^-100000 beside 2^100000: slow is allowed, wrong is not (case 9). */
static void test_far_exponents(void **state) {
  (void)state;
  dyd_rect r;
  dyd_point c;
  mpq_t got, expected;
  dyd_rect_init(&r), dyd_point_init(&c);
  mpq_inits(got, expected, NULL);
  assert_int_equal(dyd_dyadic_set_si_2exp(&r.x.hi, 1, 100000), DYD_OK);
  assert_int_equal(dyd_dyadic_set_si_2exp(&c.x, -1, -100000), DYD_OK);
  dyd_rect_ds2(got, &c, &r);
  mpq_set_ui(expected, 1, 1);
  mpq_div_2exp(expected, expected, 200000);
  assert_true(mpq_equal(got, expected));
  dyd_rect_dl2(got, &c, &r);
  mpq_set_ui(expected, 1, 1);
  mpq_mul_2exp(expected, expected, 200000);
  assert_true(mpq_cmp(got, expected) > 0);
  assert_int_equal(dyd_rect_bits(&r), -100000);
  mpq_clears(got, expected, NULL);
  dyd_point_clear(&c), dyd_rect_clear(&r);
}

/* root is the double next to the root of `square` on its side. */
static void check_root(double root, const mpq_t square, int side) {
  mpq_t v, w;
  mpq_inits(v, w, NULL);
  for (int inner = 0; inner < 2; inner++) {
    double d = inner ? nextafter(root, side * -HUGE_VAL) : root;
    if (!isfinite(d) || d < 0) continue;
    mpq_set_d(v, d);
    mpq_mul(w, v, v);
    int order = side * mpq_cmp(w, square);
    assert_true(inner ? order < 0 : order >= 0);
  }
  mpq_clears(v, w, NULL);
}

/* Rectangles of small integers, at all scales: the least and largest of all distances of points with coordinates among
 * the ends and each other's ends, where the extremes are. */
static void test_rect_distances(void **state) {
  (void)state;
  test_random r = test_random_start("distances of rectangles");
  dyd_rect a, b;
  mpq_t least, largest;
  dyd_rect_init(&a), dyd_rect_init(&b);
  mpq_inits(least, largest, NULL);
  for (size_t n = test_cases(5000); n > 0; n--) {
    long e[2][4], low = 0, high = 0;
    int64_t exp = test_chance(&r, 2) ? 0 : test_between(&r, -300, 300);
    for (int k = 0; k < 2; k++)
      for (int m = 0; m < 4; m++)
        e[k][m] = m & 1 ? e[k][m - 1] + (long)test_below(&r, 4) : (long)test_between(&r, -6, 6);
    for (int axis = 0; axis < 4; axis += 2) {
      long closest = 1000, farthest = 0;
      for (long p = e[0][axis]; p <= e[0][axis + 1]; p++)
        for (long q = e[1][axis]; q <= e[1][axis + 1]; q++) {
          long d = p < q ? q - p : p - q;
          closest = d < closest ? d : closest;
          farthest = d > farthest ? d : farthest;
        }
      low += closest * closest, high += farthest * farthest;
    }
    dyd_rect *rect[2] = {&a, &b};
    for (int k = 0; k < 2; k++) {
      dyd_dyadic *end[4] = {&rect[k]->x.lo, &rect[k]->x.hi, &rect[k]->y.lo, &rect[k]->y.hi};
      for (int m = 0; m < 4; m++) assert_int_equal(dyd_dyadic_set_si_2exp(end[m], e[k][m], exp), DYD_OK);
    }
    mpq_set_si(least, low, 1), mpq_set_si(largest, high, 1);
    if (exp > 0)
      mpq_mul_2exp(least, least, 2 * (unsigned long)exp), mpq_mul_2exp(largest, largest, 2 * (unsigned long)exp);
    if (exp < 0)
      mpq_div_2exp(least, least, 2 * (unsigned long)-exp), mpq_div_2exp(largest, largest, 2 * (unsigned long)-exp);
    double lo, hi;
    dyd_rect_distance(&lo, &hi, &a, &b);
    check_root(lo, least, -1);
    check_root(hi, largest, 1);
  }
  assert_int_equal(dyd_dyadic_set_si_2exp(&a.x.hi, 1, 100000), DYD_OK);
  double lo, hi;
  dyd_rect_distance(&lo, &hi, &a, &b);
  assert_true(hi == HUGE_VAL && isfinite(lo));
  mpq_clears(least, largest, NULL);
  dyd_rect_clear(&b), dyd_rect_clear(&a);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_interval_order),   cmocka_unit_test(test_interval_size),
                                     cmocka_unit_test(test_interval_refused), cmocka_unit_test(test_rect_order),
                                     cmocka_unit_test(test_distances),        cmocka_unit_test(test_hulls_random),
                                     cmocka_unit_test(test_hulls_exhaustive), cmocka_unit_test(test_far_exponents),
                                     cmocka_unit_test(test_rect_distances)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
