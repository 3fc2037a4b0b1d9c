/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tolerances of points with weights: against equal ones, statuses of discs, attacks, random choices [TOL-8]. */
#include <setjmp.h>
#include <stdarg.h>

#include "tolerance/cases.h"

#include <cmocka.h>
#include <math.h>

static bool same_place(double a, double b) {
  return fabs(a - b) <= 1e-6 * b;
}

/* All weights equal: the events of [TOL-1] to [TOL-3], divided by the weight; by brute force, too. */
static void test_equal_weights(void **state) {
  (void)state;
  test_random r = test_random_start("equal weights");
  size_t sharp = 0, all = 0;
  for (size_t c = 0; c < test_cases(300); c++) {
    brute_points p;
    cases_answer a, b;
    const dyd_tolerance_row *x, *y;
    double weight[BRUTE_MOST], w = ldexp(1 + test_unit(&r), (int)test_below(&r, 9) - 4);
    mpq_t up_to, scaled;
    cases_make(&p, &r, c % 6);
    for (size_t i = 0; i < p.n; i++) weight[i] = w;
    mpq_inits(up_to, scaled, NULL);
    mpq_set_ui(up_to, 1, 1 + (unsigned long)test_below(&r, 20));
    mpq_set_d(scaled, w);
    mpq_div(scaled, up_to, scaled);
    cases_ask(&a, &p, &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .up_to = up_to});
    cases_ask(&b, &p, &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .up_to = scaled, .weight = weight});
    size_t n = dyd_tolerance_rows(&x, a.t);
    assert_true(dyd_tolerance_rows(&y, b.t) >= n); /* births at up_to to the last bit may be open */
    for (size_t k = 0; k < n; k++) {
      const dyd_tolerance_row *q = cases_row(b.t, x[k].i, x[k].j);
      assert_true(q && q->event == x[k].event);
      assert_true(q->lo * w <= x[k].hi * (1 + 0x1p-50) && x[k].lo <= q->hi * w * (1 + 0x1p-50));
      sharp += q->hi <= q->lo * (1 + 0x1p-40) || q->lo == q->hi;
      all++;
    }
    double lo[2], hi[2];
    lo[0] = dyd_tolerance_get(a.t)->lo, hi[0] = dyd_tolerance_get(a.t)->hi;
    lo[1] = dyd_tolerance_get(b.t)->lo, hi[1] = dyd_tolerance_get(b.t)->hi;
    assert_true(lo[1] * w <= hi[0] * (1 + 0x1p-50) && lo[0] <= hi[1] * w * (1 + 0x1p-50));
    cases_forget(&a);
    cases_forget(&b);
    mpq_clears(up_to, scaled, NULL);
  }
  assert_true(all > 300 && sharp * 100 > all * 99);
}

/* Statuses of discs with these radii [DISC-1] [DISC-2]. */
static void disc_statuses(dyd_pair_list *out, const brute_points *p, const double *weight, double t) {
  dyd_sites *sites;
  dyd_delaunay *pd;
  dyd_error err;
  double end[4][BRUTE_MOST];
  for (size_t i = 0; i < p->n; i++) {
    end[0][i] = p->x[i] - weight[i] * t, end[1][i] = p->x[i] + weight[i] * t;
    end[2][i] = p->y[i] - weight[i] * t, end[3][i] = p->y[i] + weight[i] * t;
  }
  assert_int_equal(dyd_sites_new(&sites), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(sites, p->n, end[0], end[1], end[2], end[3]), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, sites, NULL, &err), DYD_OK);
  assert_int_equal(dyd_disc_pairs(out, pd, NULL, &err), DYD_OK);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

static dyd_pair_status status_in(const dyd_pair_list *l, uint32_t i, uint32_t j) {
  for (size_t k = 0; k < l->count; k++)
    if (l->item[k].i == i && l->item[k].j == j) return l->item[k].status;
  return DYD_ILLEGAL;
}

/* Discs of at least 1e-4 among coordinates up to 1000, as doubles hold their squares. */
#define NEAR 1e-7

/* Below its event a pair has one status, above it another; a pair not listed is not an edge up to up_to. */
static void test_weights_against_discs(void **state) {
  (void)state;
  test_random r = test_random_start("weights");
  size_t deaths = 0, births = 0, sharp = 0;
  for (size_t c = 0; c < test_cases(60); c++) {
    brute_points p;
    cases_answer a;
    const dyd_tolerance_row *row;
    static const double some[] = {0, 0, 0.25, 1, 1, 3, 17};
    double weight[BRUTE_MOST];
    mpq_t up_to;
    dyd_pair_list list = {0};
    cases_make(&p, &r, 4);
    for (size_t i = 0; i < p.n; i++) weight[i] = some[test_below(&r, 7)];
    mpq_init(up_to);
    mpq_set_ui(up_to, 1, 4 + (unsigned long)test_below(&r, 60));
    cases_ask(&a, &p, &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .up_to = up_to, .weight = weight});
    for (size_t n = dyd_tolerance_rows(&row, a.t); n--; row++) {
      if (row->event == DYD_EVENT_TIE || row->lo < 1e-4) continue;
      bool death = row->event == DYD_EVENT_DEATH;
      if (row->lo < 100) {
        disc_statuses(&list, &p, weight, row->lo * (1 - NEAR));
        assert_int_equal(status_in(&list, row->i, row->j), death ? DYD_LEGAL : DYD_ILLEGAL);
      }
      if (row->hi < 100) {
        disc_statuses(&list, &p, weight, row->hi * (1 + NEAR));
        dyd_pair_status after = status_in(&list, row->i, row->j);
        assert_int_equal(after, DYD_INDETERMINATE);
      }
      *(death ? &deaths : &births) += 1;
      sharp += same_place(row->lo, row->hi) || isinf(row->lo);
    }
    disc_statuses(&list, &p, weight, mpq_get_d(up_to) * (1 - 1e-7));
    for (size_t k = 0; k < list.count; k++) assert_non_null(cases_row(a.t, list.item[k].i, list.item[k].j));
    dyd_pair_list_clear(&list);
    cases_forget(&a);
    mpq_clear(up_to);
  }
  assert_true(deaths > test_least(100) && births > test_least(30) && sharp * 100 > (deaths + births) * 99);
}

/* The circle (x, y, radius) that touches the discs of the four: those of i and j from outside, of k and l from within;
 * by Newton's way from the middle of ij, on the first three; false: the fourth does not agree. */
static bool touching_circle(double c[3], const brute_points *p, const dyd_tolerance_row *row, const double *weight,
                            double t) {
  const uint32_t who[4] = {row->i, row->j, row->k, row->l};
  double x[4], y[4], r[4], f[4], d[4][3];
  for (int q = 0; q < 4; q++) x[q] = p->x[who[q]], y[q] = p->y[who[q]], r[q] = (q < 2 ? t : -t) * weight[who[q]];
  c[0] = (x[0] + x[1] + x[2] + x[3]) / 4, c[1] = (y[0] + y[1] + y[2] + y[3]) / 4;
  c[2] = hypot(x[0] - x[1], y[0] - y[1]);
  for (int step = 0; step < 60; step++) {
    for (int q = 0; q < 4; q++) {
      double far = hypot(c[0] - x[q], c[1] - y[q]);
      f[q] = far + r[q] - c[2];
      d[q][0] = (c[0] - x[q]) / far, d[q][1] = (c[1] - y[q]) / far, d[q][2] = -1;
    }
    double a = d[1][0] - d[0][0], b = d[1][1] - d[0][1], e = d[2][0] - d[0][0], g = d[2][1] - d[0][1];
    double u = f[0] - f[1], v = f[0] - f[2], det = a * g - b * e, mx = (u * g - b * v) / det,
           my = (a * v - e * u) / det;
    double most = fmax(fabs(mx), fabs(my)), by = most > 0.25 ? 0.25 / most : 1;
    c[0] += by * mx, c[1] += by * my, c[2] += by * (f[0] + d[0][0] * mx + d[0][1] * my);
  }
  for (int q = 0; q < 4; q++)
    if (!(fabs(hypot(c[0] - x[q], c[1] - y[q]) + r[q] - c[2]) < 1e-9)) return false;
  return true;
}

/* As test_attacks: i and j flee from the centre, k and l come near, each by its weight. */
static void test_weighted_attacks(void **state) {
  (void)state;
  test_random r = test_random_start("weighted attacks");
  size_t attacks = 0;
  for (size_t c = 0; c < test_cases(300); c++) {
    brute_points p, q;
    cases_answer a;
    const dyd_tolerance_row *row;
    double weight[BRUTE_MOST], at[3];
    cases_make(&p, &r, 4);
    for (size_t i = 0; i < p.n; i++) weight[i] = test_chance(&r, 4) ? 0 : 0.25 + 3 * test_unit(&r);
    cases_ask(&a, &p, &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .weight = weight});
    for (size_t n = dyd_tolerance_rows(&row, a.t); n--; row++) {
      if (row->event != DYD_EVENT_DEATH || row->l == DYD_NO_SITE || row->lo < 1e-6) continue;
      if (!cases_parted(&p, row) || !touching_circle(at, &p, row, weight, row->lo) || at[2] > 100) continue;
      for (int beyond = 0; beyond < 2; beyond++) {
        const uint32_t who[4] = {row->i, row->j, row->k, row->l};
        double t = beyond ? row->hi * 1.001 : row->lo * 0.999;
        q = p;
        for (int k = 0; k < 4; k++) {
          double x = p.x[who[k]] - at[0], y = p.y[who[k]] - at[1], by = (k < 2 ? t : -t) * weight[who[k]] / hypot(x, y);
          q.x[who[k]] += by * x, q.y[who[k]] += by * y;
        }
        if (beyond && !cases_parted(&q, row)) continue;
        assert_true(cases_is_edge(&q, row->i, row->j) == !beyond);
        attacks += (size_t)beyond;
      }
    }
    cases_forget(&a);
  }
  assert_true(attacks > 100);
}

/* Nothing changes while all move within the tolerance of the whole, each by its weight. */
static void test_weighted_whole(void **state) {
  (void)state;
  test_random r = test_random_start("weighted whole");
  size_t moved = 0;
  for (size_t c = 0; c < test_cases(200); c++) {
    brute_points p, q;
    cases_answer a;
    double lo, weight[BRUTE_MOST], reach[BRUTE_MOST];
    cases_make(&p, &r, c % 6);
    for (size_t i = 0; i < p.n; i++) weight[i] = test_chance(&r, 3) ? 0 : test_unit(&r) * 4;
    cases_ask(&a, &p, &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .weight = weight});
    lo = dyd_tolerance_get(a.t)->lo;
    for (size_t i = 0; i < p.n; i++) reach[i] = isfinite(lo) ? weight[i] * lo : 0;
    for (int k = 0; k < 30; k++) {
      cases_move(&q, &p, reach, 1, &r);
      assert_true(cases_same_edges(&q, &a));
      moved += lo > 0;
    }
    cases_forget(&a);
  }
  assert_true(moved > 150);
}

static void test_weights_of_use(void **state) {
  (void)state;
  const double fixed[4] = {0, 0, 0, 0}, large[4] = {1, 1, 5, 1},
               wrong[3][4] = {{1, -1, 1, 1}, {1, NAN, 1, 1}, {1, 1e300, 1, 1}};
  brute_points p = {.n = 4, .x = {0, 1, 0, 0}, .y = {0, 0, 0, 1}}; /* 2 is an alias of 0 */
  const dyd_tolerance_row *row;
  double lo, hi;
  cases_answer a;
  mpq_t q[2];
  mpq_inits(q[0], q[1], NULL);
  cases_ask(&a, &p, &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .weight = fixed});
  assert_int_equal(dyd_tolerance_rows(&row, a.t), 3);
  for (int k = 0; k < 3; k++) assert_true(isinf(row[k].lo) && row[k].k == DYD_NO_SITE);
  lo = dyd_tolerance_get(a.t)->lo, hi = dyd_tolerance_get(a.t)->hi;
  assert_true(isinf(lo) && isinf(hi));
  cases_forget(&a);
  cases_ask(&a, &p, &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .weight = large});
  dyd_tolerance_rows(&row, a.t); /* 0 moves by 5 t: it meets the line of 1 and 3 at sqrt(1/2) = 6 t */
  lo = dyd_tolerance_get(a.t)->lo, hi = dyd_tolerance_get(a.t)->hi;
  assert_true(lo <= sqrt(0.5) / 6 && hi >= sqrt(0.5) / 6 && hi < lo * (1 + 1e-12));
  assert_int_equal(dyd_tolerance_exact(q[0], q[1], a.t, 0), DYD_E_ARG);
  for (int k = 0; k < 3; k++) {
    dyd_tolerance *t;
    dyd_error err;
    const dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .weight = wrong[k]};
    assert_int_equal(dyd_tolerance_new(&t, a.pd, &o, &err), DYD_E_ARG);
    assert_true(t == NULL && err.point == 1);
  }
  cases_forget(&a);
  mpq_clears(q[0], q[1], NULL);
}

/* What the two rungs say of the same points. */
typedef struct binding_count {
  size_t deaths, births, quick, sharp;
} binding_count;

static void binding_compare(binding_count *n, const cases_answer *a, const cases_answer *b) {
  const dyd_tolerance_row *x, *y;
  size_t rows = dyd_tolerance_rows(&x, a->t);
  assert_true(rows == dyd_tolerance_rows(&y, b->t));
  for (; rows--; x++, y++) {
    assert_true(x->i == y->i && x->j == y->j && x->event == y->event && x->lo <= y->hi && y->lo <= x->hi);
    if (x->event == DYD_EVENT_TIE || x->lo == HUGE_VAL || x->lo == 0) continue;
    *(x->event == DYD_EVENT_DEATH ? &n->deaths : &n->births) += 1;
    n->quick += x->lo != y->lo || x->hi != y->hi;
    n->sharp += x->hi <= x->lo * (1 + 0x1p-40);
  }
}

static double weight_at_random(test_random *r) {
  static const double some[] = {0, 0x1p-30, 0.02, 0.3, 1, 1, 60, 0x1p20};
  return some[test_below(r, 8)];
}

/* Deaths [TOL-11] and births [TOL-12] by the sites that bind against those by exact statuses: discs of weights,
 * squares.
 */
static void test_binding_against_statuses(void **state) {
  (void)state;
  test_random r = test_random_start("binding");
  binding_count n = {0, 0, 0, 0};
  for (size_t c = 0; c < test_cases(240); c++) {
    brute_points p;
    cases_answer a, b;
    double weight[BRUTE_MOST];
    mpq_t up_to;
    dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .up_to = up_to};
    cases_make(&p, &r, c % 6);
    int shift = c % 7 == 0 ? 30 : 0, scale = c % 11 == 0 ? -300 : 0;
    for (size_t i = 0; i < p.n; i++) {
      weight[i] = weight_at_random(&r);
      p.x[i] = ldexp(p.x[i] + (shift ? ldexp(1, shift) : 0), scale);
      p.y[i] = ldexp(p.y[i], scale);
    }
    mpq_init(up_to);
    mpq_set_d(up_to, ldexp(0.01 + test_unit(&r), scale));
    if (c % 2) o.weight = weight;
    if (!(c % 2)) o.metric = DYD_METRIC_BOX;
    cases_ask(&a, &p, &o);
    o.no_filter = true;
    cases_ask(&b, &p, &o);
    binding_compare(&n, &a, &b);
    cases_forget(&a);
    cases_forget(&b);
    mpq_clear(up_to);
  }
  print_message("%zu deaths, %zu births, %zu quick, %zu sharp\n", n.deaths, n.births, n.quick, n.sharp);
  assert_true(n.deaths > test_least(400) && n.births > test_least(200) && n.quick * 2 > n.deaths + n.births &&
              n.sharp * 2 > n.deaths + n.births);
}

enum { MANY = 24 };

/* 24 points, some sets so flat that centres are far away: chains of many sites. */
static void test_binding_of_many(void **state) {
  (void)state;
  test_random r = test_random_start("binding of many");
  binding_count n = {0, 0, 0, 0};
  for (size_t c = 0; c < test_cases(12); c++) {
    cases_answer a[2];
    double x[MANY], y[MANY], weight[MANY];
    mpq_t up_to;
    dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .up_to = up_to};
    double flat = c % 3 == 0 ? 0x1p-12 : 1;
    for (size_t i = 0; i < MANY; i++) {
      x[i] = test_unit(&r), y[i] = test_unit(&r) * flat;
      if (c % 3 == 1) x[i] *= x[i] * x[i], y[i] *= y[i] * y[i];
      weight[i] = test_chance(&r, 4) ? 0 : 0.02 + test_unit(&r);
    }
    mpq_init(up_to);
    mpq_set_d(up_to, (c % 3 == 0 ? 0.02 : 0.04) * (0.5 + test_unit(&r)) * (flat < 1 ? 0x1p-8 : 1));
    if (c % 2) o.weight = weight;
    if (!(c % 2)) o.metric = DYD_METRIC_BOX;
    for (int k = 0; k < 2; k++) {
      dyd_error err;
      o.no_filter = k;
      assert_int_equal(dyd_sites_new(&a[k].sites), DYD_OK);
      assert_int_equal(dyd_sites_add_points(a[k].sites, MANY, x, y), DYD_OK);
      assert_int_equal(dyd_delaunay_new(&a[k].pd, a[k].sites, NULL, &err), DYD_OK);
      assert_int_equal(dyd_tolerance_new(&a[k].t, a[k].pd, &o, &err), DYD_OK);
    }
    binding_compare(&n, &a[0], &a[1]);
    cases_forget(&a[0]);
    cases_forget(&a[1]);
    mpq_clear(up_to);
  }
  print_message("%zu deaths, %zu births, %zu quick, %zu sharp\n", n.deaths, n.births, n.quick, n.sharp);
  assert_true(n.deaths > 25 * test_cases(12) && n.births > 25 * test_cases(12) && n.quick * 2 > n.deaths + n.births &&
              n.sharp * 2 > n.deaths + n.births);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_equal_weights),    cmocka_unit_test(test_weights_against_discs),
      cmocka_unit_test(test_weighted_attacks), cmocka_unit_test(test_weighted_whole),
      cmocka_unit_test(test_weights_of_use),   cmocka_unit_test(test_binding_against_statuses),
      cmocka_unit_test(test_binding_of_many),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
