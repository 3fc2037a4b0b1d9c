/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Crowds of overlapping rectangles: cells of the plane against closure under flips, which the exact rung alone uses
 * [PLANE-1] [CLO-1] [WIT-QUAD]. */
#include <setjmp.h>
#include <stdarg.h>

#include "support/random.h"
#include <dyadel/delaunay.h>

#include <cmocka.h>
#include <math.h>

enum { MOST = 64, KINDS = 10 };

typedef struct crowd {
  size_t n;
  double x0[MOST], x1[MOST], y0[MOST], y1[MOST];
} crowd;

/* kind 0: anywhere; 1: integer corners, so that they touch and tie; 2: a flat row; 3: far from the origin; 4: two
 * scales; 5: points among rectangles; 6: sides of the hull on two lines, whose pairs have their centre at infinity; 7:
 * a few far outliers; 8: tight clusters far apart; 9: points, thin and thick rectangles mixed. */
static void fill(crowd *c, test_random *r, unsigned kind, double half) {
  c->n = (size_t)test_between(r, 12, kind == 1 ? 20 : 30);
  for (size_t k = 0; k < c->n; k++) {
    double shrink = kind == 4 && k % 3 == 0 ? 0x1p-7 : 1, at = kind == 3 ? 0x1p30 : 0;
    double x = test_unit(r) * shrink, y = test_unit(r) * shrink * (kind == 2 ? 0x1p-9 : 1);
    double w = half * (1 + test_unit(r)), h = half * (1 + test_unit(r));
    if (kind == 5 && k % 2) w = h = 0;
    if (kind == 7 && k % 7 == 0) x = test_unit(r) * 0x1p20;
    if (kind == 8) {
      x = x * 0x1p-6 + (double)(k % 3) * 0x1p10;
      y = y * 0x1p-6 - (double)(k % 2) * 0x1p8;
      w *= 0x1p-6;
      h *= 0x1p-6;
    }
    if (kind == 9 && k % 4) w *= k % 4 == 1 ? 0 : 0x1p-30;
    if (kind == 9 && k % 3) h *= k % 3 == 1 ? 0 : 0x1p-30;
    if (kind == 1) {
      x = (double)test_between(r, 0, 8);
      y = (double)test_between(r, 0, 8);
      w = (double)test_between(r, 0, 2);
      h = (double)test_between(r, 0, 2);
    }
    if (kind == 6) {
      x = (double)test_between(r, 0, 12);
      y = 3 * (double)(k & 1);
      w = 0.5 * (double)test_between(r, 0, 2);
      h = k < 10 ? 0 : 0.5;
      if (k >= 10) y = 1.5 + (y - 1.5) / 2;
    }
    c->x0[k] = at + (x - w);
    c->x1[k] = at + (x + w);
    c->y0[k] = at + (y - h);
    c->y1[k] = at + (y + h);
  }
}

/* Boxes a few units wide around points exactly on a circle of 2^51 units: too close for doubles. */
static void fill_circle(crowd *c, test_random *r) {
  c->n = 0;
  for (int x = -33; x <= 33; x++)
    for (int y = -33; y <= 33; y++) {
      if (x * x + y * y != 1105 || test_chance(r, 3)) continue;
      double w = (double)test_between(r, 0, 2), h = (double)test_between(r, 0, 2), off = (double)test_between(r, -1, 1);
      if (test_chance(r, 2)) off *= 50;
      c->x0[c->n] = x * 0x1p46 + off - w;
      c->x1[c->n] = x * 0x1p46 + off + w;
      c->y0[c->n] = y * 0x1p46 - h;
      c->y1[c->n++] = y * 0x1p46 + h;
    }
}

/* x and y change places. */
static void turn(crowd *c) {
  for (size_t k = 0; k < c->n; k++) {
    double lo = c->x0[k], hi = c->x1[k];
    c->x0[k] = c->y0[k];
    c->x1[k] = c->y1[k];
    c->y0[k] = lo;
    c->y1[k] = hi;
  }
}

static void print(const crowd *c) {
  for (size_t k = 0; k < c->n; k++) fprintf(stderr, "[%a,%a] [%a,%a]\n", c->x0[k], c->x1[k], c->y0[k], c->y1[k]);
}

static dyd_sites *sites_of(const crowd *c) {
  dyd_sites *s = NULL;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(s, c->n, c->x0, c->x1, c->y0, c->y1), DYD_OK);
  return s;
}

/* Statuses of both engines; adds the walks of each to walks[]. */
static void check_same(uint64_t walks[2], const crowd *c) {
  dyd_sites *s = sites_of(c);
  dyd_delaunay *pd[2] = {NULL, NULL};
  dyd_delaunay_counters counters = {DYD_SIZED(dyd_delaunay_counters)};
  for (int k = 0; k < 2; k++) {
    dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = k == 1};
    assert_int_equal(dyd_delaunay_new(&pd[k], s, &o, NULL), DYD_OK);
    dyd_delaunay_get_counters(&counters, pd[k], NULL);
    walks[k] += counters.cover_walks;
  }
  for (uint32_t i = 0; i < c->n; i++)
    for (uint32_t j = i + 1; j < c->n; j++) {
      dyd_pair_status a = dyd_delaunay_status(pd[0], i, j), b = dyd_delaunay_status(pd[1], i, j);
      if (a == b) continue;
      print(c);
      fail_msg("pair %u %u: by cells %d, by flips %d", i, j, (int)a, (int)b);
    }
  for (int k = 0; k < 2; k++) dyd_delaunay_free(pd[k]);
  dyd_sites_free(s);
}

static void test_crowds(void **state) {
  (void)state;
  test_random r = test_random_start("crowds");
  uint64_t walks[2] = {0, 0};
  for (size_t k = 0; k < test_cases_all(50); k++) {
    crowd c;
    fill(&c, &r, (unsigned)(k % KINDS), 0.25 * test_unit(&r));
    if (k / KINDS % 2) turn(&c);
    check_same(walks, &c);
  }
  fprintf(stderr, "# walks: %llu with cells, %llu with flips\n", (unsigned long long)walks[0],
          (unsigned long long)walks[1]);
  assert_true(walks[0] < walks[1]);
}

static void test_near_circles(void **state) {
  (void)state;
  test_random r = test_random_start("near circles");
  uint64_t walks[2] = {0, 0};
  for (size_t k = 0; k < test_cases_all(5); k++) {
    crowd c;
    fill_circle(&c, &r);
    check_same(walks, &c);
  }
  assert_true(walks[0] < walks[1]);
}

/* Many squares around one point: every list is the longest; the cap on pairs ends it, in time proportional to it. */
static void test_equal_squares(void **state) {
  (void)state;
  enum { MANY = 6000 };
  dyd_sites *s = NULL;
  dyd_delaunay *pd = NULL;
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = 100000};
  dyd_error err;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (size_t k = 0; k < MANY; k++) {
    double lo = -(double)k, hi = MANY;
    assert_int_equal(dyd_sites_add_boxes(s, 1, &lo, &hi, &lo, &hi), DYD_OK);
  }
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, &err), DYD_CAPPED);
  assert_true(dyd_delaunay_is_capped(pd));
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_crowds), cmocka_unit_test(test_near_circles),
                                     cmocka_unit_test(test_equal_squares)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
