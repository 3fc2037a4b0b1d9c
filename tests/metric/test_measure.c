/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Areas and lengths of pairs against a literal oracle: the hull of eight corners in rationals [AREA-T]. */
#include "metric/bounds.h"
#include "metric/bounds_filter.h"
#include "support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

typedef struct corner {
  mpq_t x, y;
} corner;

static void cross(mpq_t out, const corner *o, const corner *a, const corner *b) {
  mpq_t s, t, u;
  mpq_inits(s, t, u, NULL);
  mpq_sub(s, a->x, o->x);
  mpq_sub(t, b->y, o->y);
  mpq_mul(out, s, t);
  mpq_sub(s, a->y, o->y);
  mpq_sub(t, b->x, o->x);
  mpq_mul(u, s, t);
  mpq_sub(out, out, u);
  mpq_clears(s, t, u, NULL);
}

static int corner_cmp(const void *a, const void *b) {
  const corner *p = a, *q = b;
  int c = mpq_cmp(p->x, q->x);
  return c ? c : mpq_cmp(p->y, q->y);
}

/* One chain of the hull of sorted corners; adds twice the signed area of (first, .., last) seen from corner 0. */
static void chain_area(mpq_t sum, const corner *c, int from, int to, int step) {
  const corner *stack[8];
  size_t n = 0;
  mpq_t t;
  mpq_init(t);
  for (int k = from; k != to + step; k += step) {
    while (n >= 2) {
      cross(t, stack[n - 2], stack[n - 1], &c[k]);
      if (mpq_sgn(t) > 0) break;
      n--;
    }
    stack[n++] = &c[k];
  }
  for (size_t k = 0; k + 1 < n; k++) {
    cross(t, &c[0], stack[k], stack[k + 1]);
    mpq_add(sum, sum, t);
  }
  mpq_clear(t);
}

/* Twice the area of the hull of two rectangles, by monotone chains. */
static void oracle_area2(mpq_t out, const double a[4], const double b[4]) {
  corner c[8];
  for (int k = 0; k < 8; k++) {
    const double *r = k < 4 ? a : b;
    mpq_inits(c[k].x, c[k].y, NULL);
    mpq_set_d(c[k].x, r[k & 1]);
    mpq_set_d(c[k].y, r[2 + (k >> 1 & 1)]);
  }
  qsort(c, 8, sizeof *c, corner_cmp);
  mpq_set_ui(out, 0, 1);
  chain_area(out, c, 0, 7, 1);
  chain_area(out, c, 7, 0, -1);
  for (int k = 0; k < 8; k++) mpq_clears(c[k].x, c[k].y, NULL);
}

/* The square of the largest distance between corners. */
static void oracle_length2(mpq_t out, const double a[4], const double b[4]) {
  mpq_t x, y, t;
  mpq_inits(x, y, t, NULL);
  mpq_set_ui(out, 0, 1);
  for (int k = 0; k < 16; k++) {
    mpq_set_d(x, a[k & 1]);
    mpq_set_d(t, b[k >> 1 & 1]);
    mpq_sub(x, x, t);
    mpq_set_d(y, a[2 + (k >> 2 & 1)]);
    mpq_set_d(t, b[2 + (k >> 3 & 1)]);
    mpq_sub(y, y, t);
    mpq_mul(x, x, x);
    mpq_mul(y, y, y);
    mpq_add(x, x, y);
    if (mpq_cmp(x, out) > 0) mpq_set(out, x);
  }
  mpq_clears(x, y, t, NULL);
}

/* reach between lo and hi (both at 500 bits), from the squares. */
static void oracle_reach(mpfr_t lo, mpfr_t hi, const double a[4], const double b[4]) {
  mpq_t la, lb, l;
  mpfr_t d;
  mpq_inits(la, lb, l, NULL);
  mpfr_init2(d, 500);
  oracle_length2(la, a, a);
  oracle_length2(lb, b, b);
  oracle_length2(l, a, b);
  if (mpq_cmp(la, lb) < 0) mpq_swap(la, lb);
  mpfr_ptr out[2] = {lo, hi};
  for (int k = 0; k < 2; k++) {
    mpfr_rnd_t rnd = k ? MPFR_RNDU : MPFR_RNDD;
    mpfr_set_q(d, la, rnd);
    mpfr_sqrt(d, d, rnd);
    mpfr_set_q(out[k], l, rnd);
    mpfr_sqrt(out[k], out[k], rnd);
    mpfr_div_2ui(out[k], out[k], 1, rnd);
    mpfr_add(out[k], out[k], d, rnd);
  }
  mpfr_clear(d);
  mpq_clears(la, lb, l, NULL);
}

/* t <= x <= (1 + 2^-bits) t */
static void assert_close_q(mpfr_srcptr x, const mpq_t t, long bits) {
  mpfr_t room;
  mpq_t factor;
  mpfr_init2(room, 500);
  mpq_init(factor);
  assert_true(mpfr_cmp_q(x, t) >= 0);
  mpq_set_ui(factor, 1, 1);
  mpq_div_2exp(factor, factor, (mp_bitcnt_t)bits);
  mpq_mul(factor, factor, t);
  mpq_add(factor, factor, t);
  assert_true(mpfr_cmp_q(x, factor) <= 0);
  mpq_clear(factor);
  mpfr_clear(room);
}

static void assert_close(mpfr_srcptr x, mpfr_srcptr lo, mpfr_srcptr hi, long bits) {
  mpfr_t most;
  mpfr_init2(most, 500);
  assert_true(mpfr_cmp(x, lo) >= 0);
  mpfr_div_2ui(most, hi, (unsigned long)bits, MPFR_RNDU);
  mpfr_add(most, most, hi, MPFR_RNDU);
  assert_true(mpfr_cmp(x, most) <= 0);
  mpfr_clear(most);
}

static void set_dd(mpfr_t out, const double dd[2]) {
  mpfr_set_d(out, dd[0], MPFR_RNDN);
  assert_int_equal(0, mpfr_add_d(out, out, dd[1], MPFR_RNDN));
}

/* Both rungs against the oracle; false: the filter declined. */
static bool check(const double a[4], const double b[4]) {
  mpq_t area2, length2, t;
  mpfr_t x, y, lo, hi;
  double dd[2];
  dyd_sites *sites;
  dyd_measure m;
  mpq_inits(area2, length2, t, NULL);
  mpfr_inits2(2400, x, y, lo, hi, (mpfr_ptr)0);
  mpfr_set_prec(y, DYD_MEASURE_PREC);
  oracle_area2(area2, a, b);
  oracle_length2(length2, a, a);
  oracle_reach(lo, hi, a, b);
  bool answered = dyd_filter_partial_edge_area2(dd, a, b);
  if (answered) {
    set_dd(x, dd);
    assert_close_q(x, area2, 86);
  }
  if (dyd_filter_reach(dd, a, b)) {
    set_dd(x, dd);
    assert_close(x, lo, hi, 85);
  }
  if (dyd_filter_diameter(dd, a)) {
    set_dd(x, dd);
    mpfr_sqr(x, x, MPFR_RNDN);
    assert_close_q(x, length2, 84);
  }
  assert_int_equal(DYD_OK, dyd_sites_new(&sites));
  for (int k = 0; k < 2; k++) {
    const double *r = k ? b : a;
    assert_int_equal(DYD_OK, dyd_sites_add_boxes(sites, 1, &r[0], &r[1], &r[2], &r[3]));
  }
  dyd_measure_init(&m, sites);
  for (int rung = 0; rung < 2; rung++) {
    if (rung) m.filter = false;
    assert_int_equal(DYD_OK, dyd_measure_area(y, &m, 0, 1));
    mpfr_mul_2ui(y, y, 1, MPFR_RNDN);
    assert_close_q(y, area2, 80);
    assert_int_equal(DYD_OK, dyd_measure_reach(y, &m, 0, 1));
    assert_close(y, lo, hi, 80);
    assert_int_equal(DYD_OK, dyd_measure_diameter(y, &m, 0));
    mpfr_sqr(x, y, MPFR_RNDN);
    assert_close_q(x, length2, 78);
  }
  dyd_measure_clear(&m);
  dyd_sites_free(sites);
  mpfr_clears(x, y, lo, hi, (mpfr_ptr)0);
  mpq_clears(area2, length2, t, NULL);
  return answered;
}

/* Every pair of intervals with ends in 0..3 on each axis, up to the choice of the first axis' pair: 10^4 cases. */
static void test_grid(void **state) {
  (void)state;
  double side[10][2];
  int n = 0;
  for (int lo = 0; lo < 4; lo++)
    for (int hi = lo; hi < 4; hi++, n++) side[n][0] = lo, side[n][1] = hi;
  for (int k = 0; k < 10000; k++) {
    const double *ax = side[k % 10], *bx = side[k / 10 % 10], *ay = side[k / 100 % 10], *by = side[k / 1000];
    const double a[4] = {ax[0], ax[1], ay[0], ay[1]}, b[4] = {bx[0], bx[1], by[0], by[1]};
    assert_true(check(a, b));
  }
}

static double number(test_random *r, int spread) {
  double x = ldexp(test_unit(r) - 0.5, (int)test_between(r, -spread, spread));
  return test_chance(r, 8) ? 0 : test_chance(r, 4) ? rint(x) : x;
}

static void box(double out[4], test_random *r, int spread) {
  for (int a = 0; a < 4; a += 2) {
    double lo = number(r, spread), hi = lo;
    if (test_chance(r, 2))
      hi = lo + fabs(ldexp(lo, -(int)test_below(r, 60)));
    else if (!test_chance(r, 4))
      hi = number(r, spread);
    out[a] = lo < hi ? lo : hi;
    out[a + 1] = lo < hi ? hi : lo;
  }
}

static void random_boxes(test_random *r, int spread, bool must_answer) {
  for (size_t k = 0; k < test_cases(3000); k++) {
    double a[4], b[4];
    box(a, r, spread);
    box(b, r, spread);
    if (test_chance(r, 5)) b[test_below(r, 2)] = a[test_below(r, 2)];
    if (b[0] > b[1]) b[0] = b[1];
    bool answered = check(a, b);
    if (must_answer) assert_true(answered);
  }
}

static void test_random_boxes(void **state) {
  (void)state;
  test_random r = test_random_start("measure");
  random_boxes(&r, 3, true);
  random_boxes(&r, 60, true);
  random_boxes(&r, 1000, false);
}

/* Thin boxes far apart: a width 2^-1074 beside a distance 2^1000 must not be lost. */
static void test_extremes(void **state) {
  (void)state;
  const double tiny = 0x1p-1074, huge = 0x1p1000;
  const double box_[][4] = {{0, tiny, 0, 0},          {0, 0, 0, 0},
                            {huge, huge, 0, tiny},    {-huge, huge, 1, 1},
                            {1, 1 + 0x1p-52, 1, 2},   {-0x1p-400, 0x1p-400, 0, 0},
                            {0x1p400, 0x1p401, 3, 4}, {0x1.fp1023, 0x1.fffp1023, -0x1.fp1023, 0x1.fp1023}};
  const size_t n = sizeof box_ / sizeof *box_;
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < n; j++) check(box_[i], box_[j]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_grid),
      cmocka_unit_test(test_random_boxes),
      cmocka_unit_test(test_extremes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
