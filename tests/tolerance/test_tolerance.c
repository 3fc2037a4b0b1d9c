/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tolerances against all annuli, adversaries, and statuses: [TOL-1] [TOL-2] [TOL-3] [TOL-4] [TOL-5] [TOL-6] [FLT-TOL].
 */
#include <setjmp.h>
#include <stdarg.h>

#include "tolerance/cases.h"

#include <cmocka.h>
#include <math.h>

/* ---- every pair against every annulus ---- */

static void check_exact_form(const dyd_tolerance *t, const dyd_tolerance_row *row, mpf_srcptr w) {
  const dyd_tolerance_row *first;
  mpq_t plus, minus;
  mpf_t a, b;
  dyd_tolerance_rows(&first, t);
  mpq_inits(plus, minus, NULL);
  mpf_init2(a, BRUTE_BITS);
  mpf_init2(b, BRUTE_BITS);
  assert_int_equal(dyd_tolerance_exact(plus, minus, t, (size_t)(row - first)), DYD_OK);
  mpf_set_q(a, plus);
  mpf_sqrt(a, a);
  mpf_set_q(b, minus);
  mpf_sqrt(b, b);
  mpf_sub(a, a, b);
  mpf_sub(a, a, w);
  mpf_abs(a, a);
  assert_true(mpf_cmp_d(a, 1e-80) < 0);
  mpf_clears(a, b, NULL);
  mpq_clears(plus, minus, NULL);
}

static void check_pair(const cases_answer *a, const brute_points *p, uint32_t i, uint32_t j, double up_to) {
  const dyd_tolerance_row *row = cases_row(a->t, i, j);
  mpf_t w, half;
  mpf_init2(w, BRUTE_BITS);
  mpf_init2(half, BRUTE_BITS);
  bool any = brute_width(w, p, i, j);
  mpf_abs(half, w);
  mpf_div_2exp(half, half, 1);
  bool tie = any && mpf_cmp_d(half, 1e-80) < 0;
  if (!any) {
    assert_true(row && row->event == DYD_EVENT_DEATH && isinf(row->lo) && isinf(row->hi));
  } else if (!tie && mpf_sgn(w) < 0 && mpf_cmp_d(half, up_to) > 0) {
    assert_null(row);
  } else {
    assert_non_null(row);
    assert_int_equal(row->event, tie ? DYD_EVENT_TIE : mpf_sgn(w) > 0 ? DYD_EVENT_DEATH : DYD_EVENT_BIRTH);
    if (!tie) assert_true(mpf_cmp_d(half, row->lo) >= 0 && mpf_cmp_d(half, row->hi) <= 0);
    assert_true(row->hi <= row->lo * (1 + 0x1p-40));
    assert_true(row->k < row->l || (row->k == DYD_NO_SITE && row->l == DYD_NO_SITE));
    check_exact_form(a->t, row, w);
  }
  mpf_clears(w, half, NULL);
}

static void test_all_annuli(void **state) {
  (void)state;
  test_random r = test_random_start("all annuli");
  uint64_t filter = 0, exact = 0;
  for (size_t c = 0; c < test_cases(1000); c++) {
    brute_points p;
    cases_answer a;
    mpq_t up_to;
    cases_make(&p, &r, c % 6);
    mpq_init(up_to);
    mpq_set_ui(up_to, 1, 1 + (unsigned long)test_below(&r, 20));
    cases_ask(&a, &p,
              &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .up_to = up_to, .no_filter = c % 7 == 0});
    for (uint32_t i = 0; i < p.n; i++)
      for (uint32_t j = i + 1; j < p.n; j++) check_pair(&a, &p, i, j, mpq_get_d(up_to));
    uint64_t f, e;
    f = dyd_tolerance_get(a.t)->filter, e = dyd_tolerance_get(a.t)->exact;
    filter += f, exact += e;
    cases_forget(&a);
    mpq_clear(up_to);
  }
  assert_true(filter > 300 && exact > 300);
}

/* ---- adversaries ---- */

/* i and j flee from the centre of their annulus, k and l come near, all by t. */
static void attack(brute_points *out, const brute_points *p, const dyd_tolerance_row *row, double t) {
  double jx = p->x[row->j] - p->x[row->i], jy = p->y[row->j] - p->y[row->i];
  double kx = p->x[row->k] - p->x[row->i], ky = p->y[row->k] - p->y[row->i];
  double lx = p->x[row->l] - p->x[row->i], ly = p->y[row->l] - p->y[row->i];
  double mk = kx * (kx - jx) + ky * (ky - jy), ml = lx * (lx - jx) + ly * (ly - jy);
  double nk = jx * ky - jy * kx, nl = jx * ly - jy * lx, s = (mk - ml) / (2 * (nk - nl));
  double cx = p->x[row->i] + jx / 2 - s * jy, cy = p->y[row->i] + jy / 2 + s * jx;
  const uint32_t who[4] = {row->i, row->j, row->k, row->l};
  *out = *p;
  for (int q = 0; q < 4; q++) {
    double x = p->x[who[q]] - cx, y = p->y[who[q]] - cy, d = hypot(x, y), by = q < 2 ? t : -t;
    out->x[who[q]] += by * x / d;
    out->y[who[q]] += by * y / d;
  }
}

/* Where k and l are on different sides, the attack succeeds just beyond the death, and never before. */
static void test_attacks(void **state) {
  (void)state;
  test_random r = test_random_start("attacks");
  size_t attacks = 0;
  for (size_t c = 0; c < test_cases(600); c++) {
    brute_points p, q;
    cases_answer a;
    const dyd_tolerance_row *row;
    cases_make(&p, &r, c % 5);
    cases_ask(&a, &p, NULL);
    for (size_t n = dyd_tolerance_rows(&row, a.t); n--; row++) {
      if (row->event != DYD_EVENT_DEATH || row->l == DYD_NO_SITE) continue;
      if (!cases_parted(&p, row) || row->lo < 1e-9) continue; /* steps of doubles count there */
      attack(&q, &p, row, row->lo * 0.999);
      assert_true(cases_is_edge(&q, row->i, row->j));
      attack(&q, &p, row, row->hi * 1.001);
      if (!cases_parted(&q, row)) continue; /* k has gone round i: the pair nearly touches */
      assert_false(cases_is_edge(&q, row->i, row->j));
      attacks++;
    }
    cases_forget(&a);
  }
  assert_true(attacks > test_least(300));
}

/* ---- each point, and the whole ---- */

static void test_points_and_whole(void **state) {
  (void)state;
  test_random r = test_random_start("points");
  size_t moved = 0;
  for (size_t c = 0; c < test_cases(400); c++) {
    brute_points p, q;
    cases_answer a;
    double lo, hi, all[BRUTE_MOST], least = HUGE_VAL;
    cases_make(&p, &r, c % 6);
    cases_ask(&a, &p,
              &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .points = true, .no_filter = c % 5 == 0});
    const double *radius = dyd_tolerance_get(a.t)->points;
    lo = dyd_tolerance_get(a.t)->lo, hi = dyd_tolerance_get(a.t)->hi;
    assert_true(hi <= lo * (1 + 0x1p-40) || lo == hi);
    for (size_t i = 0; i < p.n; i++) {
      all[i] = lo;
      least = fmin(least, radius[i]);
      assert_true(radius[i] >= 0);
    }
    /* the circles of the edges are those of their deaths, so the points can move no less than the whole */
    assert_true(least <= hi && least >= lo * (1 - 1e-6));
    for (int k = 0; k < 50; k++) {
      cases_move(&q, &p, k % 2 ? radius : all, 1, &r);
      assert_true(cases_same_edges(&q, &a));
      moved += least > 0;
    }
    cases_forget(&a);
  }
  assert_true(moved > 1000);
}

/* A place whose edges doubles cannot hold: it is not free to go anywhere. */
static void test_point_far_away(void **state) {
  brute_points p = {.n = 3, .x = {0, 1, 0x1p250}, .y = {0, 0, 0x1p250}};
  cases_answer a;
  (void)state;
  cases_ask(&a, &p, &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .points = true});
  for (size_t i = 0; i < p.n; i++) assert_true(dyd_tolerance_get(a.t)->points[i] <= 1);
  cases_forget(&a);
}

/* ---- large cases: the rungs agree; a hub ---- */

enum { BY_DOUBLES, BY_INTEGERS, BY_THREADS, WAYS };

static void compare_ways(const dyd_tolerance *const t[WAYS], size_t n) {
  const dyd_tolerance_row *row[WAYS];
  size_t count = 0;
  for (int k = 0; k < WAYS; k++) {
    size_t rows = dyd_tolerance_rows(&row[k], t[k]);
    assert_true(k == 0 || rows == count);
    count = rows;
  }
  for (size_t k = 0; k < count; k++) {
    const dyd_tolerance_row *a = &row[BY_DOUBLES][k], *b = &row[BY_INTEGERS][k], *c = &row[BY_THREADS][k];
    assert_true(a->i == b->i && a->j == b->j && a->event == b->event && a->k == b->k && a->l == b->l);
    assert_true(a->lo <= b->hi && b->lo <= a->hi && a->hi <= a->lo * (1 + 0x1p-40));
    assert_true(a->i == c->i && a->j == c->j && a->event == c->event && a->k == c->k && a->l == c->l);
    assert_true(a->lo == c->lo && a->hi == c->hi);
    assert_true(k == 0 || a[-1].i < a->i || (a[-1].i == a->i && a[-1].j < a->j));
  }
  const double *radius = dyd_tolerance_get(t[BY_DOUBLES])->points, *again = dyd_tolerance_get(t[BY_THREADS])->points,
               *exact = dyd_tolerance_get(t[BY_INTEGERS])->points;
  const double lo = dyd_tolerance_get(t[BY_DOUBLES])->lo;
  assert_int_equal(!radius, !again);
  assert_true(lo > 0);
  for (size_t i = 0; radius && i < n; i++) {
    assert_true(radius[i] == again[i]);
    assert_true(fabs(radius[i] - exact[i]) <= 1e-9 && radius[i] >= lo / 2);
  }
}

/* share: of the deaths that doubles decide, at least. */
static void compare_rungs(size_t n, const double *x, const double *y, bool points, double share) {
  dyd_sites *sites;
  dyd_delaunay *pd[WAYS];
  dyd_tolerance *t[WAYS];
  dyd_error err;
  assert_int_equal(dyd_sites_new(&sites), DYD_OK);
  assert_int_equal(dyd_sites_add_points(sites, n, x, y), DYD_OK);
  for (int k = 0; k < WAYS; k++) {
    dyd_delaunay_options threads = {DYD_SIZED(dyd_delaunay_options), .threads = k == BY_THREADS ? 3 : 1};
    dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .no_filter = k == BY_INTEGERS, .points = points};
    assert_int_equal(dyd_delaunay_new(&pd[k], sites, &threads, &err), DYD_OK);
    assert_int_equal(dyd_tolerance_new(&t[k], pd[k], &o, &err), DYD_OK);
  }
  compare_ways((const dyd_tolerance *const *)t, n);
  uint64_t filter, exact;
  filter = dyd_tolerance_get(t[BY_DOUBLES])->filter, exact = dyd_tolerance_get(t[BY_DOUBLES])->exact;
  assert_true((double)filter >= share * (double)(filter + exact));
  for (int k = 0; k < WAYS; k++) dyd_tolerance_free(t[k]);
  for (int k = 0; k < WAYS; k++) dyd_delaunay_free(pd[k]);
  dyd_sites_free(sites);
}

/* Births are the same numbers, by the same sites, whether doubles or integers find them [FLT-BIRTH]. */
static void test_births_by_rungs(void **state) {
  (void)state;
  enum { SOME = 70 };
  test_random r = test_random_start("births by rungs");
  size_t births = 0;
  for (size_t c = 0; c < test_cases(24); c++) {
    double x[SOME], y[SOME];
    const double shift = c % 3 == 1 ? 0x1p30 : 0, size = c % 4 == 3 ? 0x1p-120 : 1;
    dyd_sites *sites;
    dyd_delaunay *pd[WAYS];
    dyd_tolerance *t[WAYS];
    const dyd_tolerance_row *row[WAYS];
    dyd_error err;
    mpq_t up_to;
    for (size_t i = 0; i < SOME; i++) { /* anywhere, in a crowd, or on a grid */
      double share = c % 5 == 4 || i % 3 ? 1 : 0.05;
      x[i] = size * (shift + share * (c % 2 ? test_unit(&r) : (double)test_below(&r, 12) / 8));
      y[i] = size * share * (c % 2 ? test_unit(&r) : (double)test_below(&r, 12) / 8);
    }
    mpq_init(up_to);
    mpq_set_d(up_to, size * (0.02 + 0.15 * test_unit(&r)));
    assert_int_equal(dyd_sites_new(&sites), DYD_OK);
    assert_int_equal(dyd_sites_add_points(sites, SOME, x, y), DYD_OK);
    for (int k = 0; k < WAYS; k++) {
      dyd_delaunay_options threads = {DYD_SIZED(dyd_delaunay_options), .threads = k == BY_THREADS ? 3 : 1};
      dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .no_filter = k == BY_INTEGERS, .up_to = up_to};
      assert_int_equal(dyd_delaunay_new(&pd[k], sites, &threads, &err), DYD_OK);
      assert_int_equal(dyd_tolerance_new(&t[k], pd[k], &o, &err), DYD_OK);
    }
    size_t n = dyd_tolerance_rows(&row[0], t[0]);
    for (int k = 1; k < WAYS; k++) assert_int_equal(dyd_tolerance_rows(&row[k], t[k]), n);
    for (size_t q = 0; q < n; q++)
      for (int k = 1; k < WAYS; k++) {
        const dyd_tolerance_row *a = &row[0][q], *b = &row[k][q];
        assert_true(a->i == b->i && a->j == b->j && a->event == b->event);
        if (a->event != DYD_EVENT_BIRTH) continue;
        assert_true(a->lo == b->lo && a->hi == b->hi);
        births += k == BY_INTEGERS && a->k == b->k && a->l == b->l;
      }
    for (int k = 0; k < WAYS; k++) dyd_tolerance_free(t[k]), dyd_delaunay_free(pd[k]);
    dyd_sites_free(sites);
    mpq_clear(up_to);
  }
  assert_true(births > 500);
}

static void test_rungs(void **state) {
  (void)state;
  enum { MANY = 2000 };
  static double x[MANY], y[MANY];
  test_random r = test_random_start("rungs");
  for (size_t i = 0; i < MANY; i++) x[i] = test_unit(&r), y[i] = test_unit(&r);
  compare_rungs(MANY, x, y, true, 0.99);
  for (size_t i = 1; i < MANY; i++) { /* a hub in a rough circle: rims bind at places of their own */
    double a = 6.283185307179586 * (double)i / (MANY - 1), d = 1 + test_unit(&r) * 1e-4;
    x[i] = d * cos(a), y[i] = d * sin(a);
  }
  x[0] = 0.01, y[0] = 0.02;
  compare_rungs(MANY, x, y, true, 0.9);
  for (size_t i = 0; i < MANY; i++) x[i] = ldexp(x[i], 300), y[i] = ldexp(y[i], 300); /* beyond the filter */
  compare_rungs(200, x, y, false, 0);
}

/* ---- refusals, few points, aliases ---- */

static void test_edges_of_use(void **state) {
  (void)state;
  const double x[4] = {0, 1, 0, 0}, y[4] = {0, 0, 0, 1};
  double lo, hi;
  dyd_error err;
  const dyd_tolerance_row *row;
  for (size_t n = 0; n <= 4; n++) {
    cases_answer a;
    brute_points p = {.n = n};
    for (size_t i = 0; i < n; i++) p.x[i] = x[i], p.y[i] = y[i];
    cases_ask(&a, &p, &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .points = true});
    lo = dyd_tolerance_get(a.t)->lo, hi = dyd_tolerance_get(a.t)->hi;
    assert_int_equal(dyd_tolerance_rows(&row, a.t), n < 2 ? 0 : n < 4 ? 1 : 3);
    assert_true(n < 4 ? isinf(lo) && isinf(hi) : lo <= sqrt(0.125) && hi >= sqrt(0.125) && hi < 0.36);
    if (n == 4) assert_true(dyd_tolerance_get(a.t)->points[2] == dyd_tolerance_get(a.t)->points[0]);
    cases_forget(&a);
  }
  dyd_sites *sites;
  dyd_delaunay *pd;
  dyd_tolerance *t = (dyd_tolerance *)&lo;
  assert_int_equal(dyd_sites_new(&sites), DYD_OK);
  assert_int_equal(dyd_sites_add_points(sites, 2, x, y), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(sites, 1, (double[]){2}, (double[]){3}, (double[]){0}, (double[]){1}), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, sites, NULL, &err), DYD_OK);
  assert_int_equal(dyd_tolerance_new(&t, pd, NULL, &err), DYD_E_ARG);
  assert_true(t == NULL && err.point == 2);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_all_annuli),     cmocka_unit_test(test_attacks), cmocka_unit_test(test_points_and_whole),
      cmocka_unit_test(test_point_far_away), cmocka_unit_test(test_rungs),   cmocka_unit_test(test_births_by_rungs),
      cmocka_unit_test(test_edges_of_use),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
