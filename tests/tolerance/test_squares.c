/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tolerances in the max norm: against the literal oracle, all choices of corners, both rungs, statuses, random choices
 * [TOL-9] [TOL-12]. */
#include <setjmp.h>
#include <stdarg.h>

#include "oracle/oracle.h"
#include "tolerance/cases.h"

#include <cmocka.h>
#include <math.h>
#include <string.h>

static const double width = 1 + 0x1p-20;

static void ask_squares(cases_answer *a, const brute_points *p, mpq_srcptr up_to, bool no_filter) {
  cases_ask(a, p,
            &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .up_to = up_to, .points = true,
                                     .no_filter = no_filter, .metric = DYD_METRIC_BOX});
}

static bool is_few(const brute_points *p, size_t most) {
  return p->n <= most && p->n > 2;
}

/* ---- the literal oracle ---- */

/* Squares of half-width t, exactly. */
static void oracle_squares(orc_case *out, const brute_points *p, double t) {
  orc_rect r;
  mpq_t half;
  mpq_init(half);
  mpq_set_d(half, t);
  for (int e = 0; e < 4; e++) mpq_init(r.e[e]);
  out->n = 0;
  for (size_t i = 0; i < p->n; i++) {
    for (int e = 0; e < 4; e++) {
      mpq_set_d(r.e[e], e < 2 ? p->x[i] : p->y[i]);
      (e % 2 ? mpq_add : mpq_sub)(r.e[e], r.e[e], half);
    }
    orc_case_add_rect(out, &r);
  }
  for (int e = 0; e < 4; e++) mpq_clear(r.e[e]);
  mpq_clear(half);
}

static bool oracle_says(const brute_points *p, double t, uint32_t i, uint32_t j, bool legal) {
  orc_case c;
  orc_pool pool;
  orc_pool_init(&pool);
  orc_case_init(&c);
  oracle_squares(&c, p, t);
  bool answer = legal ? orc_legal(NULL, NULL, &pool, &c, i, j) : orc_possible(&pool, &c, i, j);
  orc_case_clear(&c);
  orc_pool_clear(&pool);
  return answer;
}

/* At lo it is so, a little above hi it is not; a site not listed is not possible at up_to. */
static void test_squares_against_oracle(void **state) {
  (void)state;
  test_random r = test_random_start("squares against the oracle");
  size_t deaths = 0, births = 0, sharp = 0, all = 0;
  for (size_t c = 0; c < test_cases(60); c++) {
    brute_points p;
    cases_answer a;
    mpq_t up_to;
    cases_make(&p, &r, c % 6);
    if (!is_few(&p, 6)) continue;
    mpq_init(up_to);
    mpq_set_ui(up_to, 1, 1 + (unsigned long)test_below(&r, 20));
    ask_squares(&a, &p, up_to, c % 7 == 0);
    for (uint32_t i = 0; i < p.n; i++)
      for (uint32_t j = i + 1; j < p.n; j++) {
        const dyd_tolerance_row *row = cases_row(a.t, i, j);
        if (!row) assert_false(oracle_says(&p, mpq_get_d(up_to) * (1 - 0x1p-20), i, j, false));
        if (!row || row->event == DYD_EVENT_TIE || isinf(row->lo)) continue;
        bool death = row->event == DYD_EVENT_DEATH;
        assert_true(oracle_says(&p, row->lo, i, j, death) == death);
        assert_true(oracle_says(&p, row->hi * (1 + 0x1p-30), i, j, death) != death);
        deaths += death, births += !death, all++;
        sharp += row->hi <= row->lo * width;
      }
    cases_forget(&a);
    mpq_clear(up_to);
  }
  print_message("%zu deaths, %zu births, %zu of %zu sharp\n", deaths, births, sharp, all);
  assert_true(deaths > test_least(25) && births > test_least(5) && sharp * 100 > all * 99);
}

/* ---- all choices of corners ---- */

/* p with each point at a corner of its square of half-width t, two bits of `which` each. */
static void corner_choice(orc_case *out, const brute_points *p, double t, unsigned which) {
  orc_rect r;
  for (int e = 0; e < 4; e++) mpq_init(r.e[e]);
  out->n = 0;
  for (size_t i = 0; i < p->n; i++, which >>= 2) {
    mpq_set_d(r.e[0], p->x[i] + (which & 1 ? t : -t));
    mpq_set_d(r.e[2], p->y[i] + (which & 2 ? t : -t));
    mpq_set(r.e[1], r.e[0]);
    mpq_set(r.e[3], r.e[2]);
    orc_case_add_rect(out, &r);
  }
  for (int e = 0; e < 4; e++) mpq_clear(r.e[e]);
}

/* Returns true if some choice of corners takes the edge, or makes one. t is cut to 2^-50, so that sums are exact. */
static bool corners_change(const brute_points *p, double t, uint32_t i, uint32_t j, bool death) {
  orc_case c;
  bool change = false;
  t = ldexp(floor(ldexp(t, 50)), -50);
  orc_case_init(&c);
  for (unsigned which = 0; which < 1u << 2 * p->n && !change; which++) {
    orc_pool pool;
    orc_pool_init(&pool);
    corner_choice(&c, p, t, which);
    bool one_place = orc_rect_equal(&c.rect[i], &c.rect[j]), other = false;
    for (size_t k = 0; k < p->n; k++)
      other = other ||
              (k != i && k != j && (orc_rect_equal(&c.rect[k], &c.rect[i]) || orc_rect_equal(&c.rect[k], &c.rect[j])));
    int status = one_place ? ORC_LEGAL : other ? ORC_TIE : orc_classical(&pool, &c, i, j);
    change = death ? status != ORC_LEGAL : status != ORC_ILLEGAL;
    orc_pool_clear(&pool);
  }
  orc_case_clear(&c);
  return change;
}

static void test_corners(void **state) {
  (void)state;
  test_random r = test_random_start("corners");
  size_t changed = 0, all = 0;
  for (size_t c = 0; c < test_cases(80); c++) {
    brute_points p;
    cases_answer a;
    const dyd_tolerance_row *row;
    mpq_t up_to;
    cases_make(&p, &r, c % 6);
    if (!is_few(&p, 4)) continue;
    mpq_init(up_to);
    mpq_set_ui(up_to, 1, 1);
    ask_squares(&a, &p, up_to, false);
    for (size_t n = dyd_tolerance_rows(&row, a.t); n--; row++) {
      if (row->event == DYD_EVENT_TIE || isinf(row->lo) || row->lo < 1e-6) continue;
      bool death = row->event == DYD_EVENT_DEATH;
      assert_false(corners_change(&p, row->lo, row->i, row->j, death));
      changed += corners_change(&p, row->hi * 1.01, row->i, row->j, death);
      all++;
    }
    cases_forget(&a);
    mpq_clear(up_to);
  }
  print_message("%zu of %zu changed by corners\n", changed, all);
  assert_true(all > test_least(20) && changed * 5 > all * 2); /* others are lost by points on sides */
}

/* ---- discs, both rungs ---- */

static bool is_within(const dyd_tolerance_row *q, const dyd_tolerance_row *disc) {
  double room = 1 + 0x1p-20;
  return q->lo >= disc->lo * 0.7071067811 && q->hi <= disc->hi * room;
}

/* Deaths lie between those of discs / sqrt(2) and those; integers alone give the same. */
static void test_squares_against_discs(void **state) {
  (void)state;
  test_random r = test_random_start("squares against discs");
  size_t less = 0;
  for (size_t c = 0; c < test_cases(80); c++) {
    brute_points p;
    cases_answer a, b, e;
    const dyd_tolerance_row *row;
    cases_make(&p, &r, c % 6);
    ask_squares(&a, &p, NULL, false);
    ask_squares(&b, &p, NULL, true);
    cases_ask(&e, &p, NULL);
    size_t n = dyd_tolerance_rows(&row, a.t);
    assert_int_equal(n, dyd_tolerance_rows(&(const dyd_tolerance_row *){NULL}, e.t));
    for (; n--; row++) {
      const dyd_tolerance_row *other = cases_row(b.t, row->i, row->j), *disc = cases_row(e.t, row->i, row->j);
      assert_true(other && disc && other->event == row->event && disc->event == row->event);
      assert_true(row->lo <= other->hi && other->lo <= row->hi);
      assert_true(row->k < row->l || (row->k == DYD_NO_SITE && row->l == DYD_NO_SITE));
      if (isinf(row->lo) || row->event == DYD_EVENT_TIE) {
        assert_true(row->lo == disc->lo && row->hi == disc->hi);
        continue;
      }
      assert_true(is_within(row, disc));
      less += row->hi < disc->lo * 0.99;
    }
    cases_forget(&a), cases_forget(&b), cases_forget(&e);
  }
  assert_true(less > test_least(80));
}

/* ---- statuses of all, radii ---- */

/* Statuses of squares of half-width t. */
static void squares_at(cases_answer *out, const brute_points *p, double t) {
  dyd_error err;
  double end[4][BRUTE_MOST];
  for (size_t i = 0; i < p->n; i++) {
    end[0][i] = p->x[i] - t, end[1][i] = p->x[i] + t;
    end[2][i] = p->y[i] - t, end[3][i] = p->y[i] + t;
  }
  *out = (cases_answer){0};
  assert_int_equal(dyd_sites_new(&out->sites), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(out->sites, p->n, end[0], end[1], end[2], end[3]), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&out->pd, out->sites, NULL, &err), DYD_OK);
}

static bool all_decided(const cases_answer *a) {
  size_t count[4];
  dyd_delaunay_count(count, a->pd);
  return count[DYD_INDETERMINATE] == 0 && count[DYD_TIE] == 0;
}

/* Just below the tolerance of the whole squares leave all decided, just above they do not. Each square of the radii
 * told, at its corners or anywhere, changes nothing. */
static void test_whole_and_radii(void **state) {
  (void)state;
  test_random r = test_random_start("whole and radii of squares");
  size_t wholes = 0, moved = 0;
  for (size_t c = 0; c < test_cases(120); c++) {
    brute_points p, q;
    cases_answer a, at;
    double lo, hi;
    cases_make(&p, &r, c % 6);
    ask_squares(&a, &p, NULL, c % 5 == 0);
    lo = dyd_tolerance_get(a.t)->lo, hi = dyd_tolerance_get(a.t)->hi;
    for (int above = 0; above < 2 && lo > 1e-6 && isfinite(lo); above++, wholes++) {
      squares_at(&at, &p, above ? hi * (1 + 1e-6) : lo * (1 - 1e-6));
      assert_true(all_decided(&at) == !above);
      cases_forget(&at);
    }
    const double *rho = dyd_tolerance_get(a.t)->points;
    for (int k = 0; k < 50; k++) {
      q = p;
      for (size_t i = 0; i < p.n; i++) {
        if (!isfinite(rho[i])) continue;
        bool corner = test_chance(&r, 2);
        q.x[i] += rho[i] * (1 - 1e-9) * (corner ? (test_chance(&r, 2) ? 1 : -1) : 2 * test_unit(&r) - 1);
        q.y[i] += rho[i] * (1 - 1e-9) * (corner ? (test_chance(&r, 2) ? 1 : -1) : 2 * test_unit(&r) - 1);
        moved += q.x[i] != p.x[i];
      }
      assert_true(cases_same_edges(&q, &a));
    }
    cases_forget(&a);
  }
  assert_true(wholes > test_least(40) && moved > test_least(4000));
}

/* ---- many points ---- */

enum { MANY = 40, RING = 82 };

/* Anywhere; a hub within a ring; a ring within which another one is; thin. */
static void make_many(double xy[2][MANY], test_random *r, size_t kind) {
  for (size_t i = 0; i < MANY; i++) {
    double a = 6.283185307179586 * ((double)i + test_unit(r)) / MANY, x = test_unit(r), y = test_unit(r);
    double far = kind == 1 ? (i ? 1 + ldexp(x, -6) : 0) : i % 2 ? 1 + ldexp(x, -8) : 1.02 + ldexp(y, -8);
    if (kind == 3) y = ldexp(y, -4);
    if (kind == 1 || kind == 2) x = far * cos(a), y = far * sin(a);
    xy[0][i] = ldexp(nearbyint(ldexp(x, 30)), -30);
    xy[1][i] = ldexp(nearbyint(ldexp(y, 30)), -30);
  }
}

static dyd_pair_status status_of_squares(size_t n, const double *x, const double *y, double t, uint32_t i, uint32_t j) {
  dyd_sites *sites;
  dyd_delaunay *pd;
  dyd_error err;
  double end[4][RING + 2];
  for (size_t k = 0; k < n; k++)
    for (int e = 0; e < 4; e++) end[e][k] = (e / 2 ? y : x)[k] + (e % 2 ? t : -t);
  assert_int_equal(dyd_sites_new(&sites), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(sites, n, end[0], end[1], end[2], end[3]), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, sites, NULL, &err), DYD_OK);
  dyd_pair_status status = dyd_delaunay_status(pd, i, j);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return status;
}

/* Statuses of all squares, a little below lo and above hi. */
static void test_many_squares(void **state) {
  (void)state;
  test_random r = test_random_start("many squares");
  size_t births = 0, all = 0;
  for (size_t c = 0; c < test_cases_all(4); c++) {
    double xy[2][MANY];
    cases_answer a;
    const dyd_tolerance_row *row;
    dyd_error err;
    mpq_t up_to;
    make_many(xy, &r, c % 4);
    mpq_init(up_to);
    mpq_set_ui(up_to, 1, 400);
    assert_int_equal(dyd_sites_new(&a.sites), DYD_OK);
    assert_int_equal(dyd_sites_add_points(a.sites, MANY, xy[0], xy[1]), DYD_OK);
    assert_int_equal(dyd_delaunay_new(&a.pd, a.sites, NULL, &err), DYD_OK);
    const dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .up_to = up_to, .metric = DYD_METRIC_BOX};
    assert_int_equal(dyd_tolerance_new(&a.t, a.pd, &o, &err), DYD_OK);
    for (size_t n = dyd_tolerance_rows(&row, a.t); n--; row++) {
      bool death = row->event == DYD_EVENT_DEATH;
      if (row->lo < 1e-6 || row->hi > 0.02 || test_below(&r, 4)) continue;
      dyd_pair_status before = status_of_squares(MANY, xy[0], xy[1], row->lo * (1 - 1e-6), row->i, row->j);
      dyd_pair_status after = status_of_squares(MANY, xy[0], xy[1], row->hi * (1 + 1e-6), row->i, row->j);
      assert_int_equal(before, death ? DYD_LEGAL : DYD_ILLEGAL);
      assert_int_equal(after, DYD_INDETERMINATE);
      births += !death, all++;
    }
    cases_forget(&a);
    mpq_clear(up_to);
  }
  print_message("%zu births of %zu\n", births, all);
  assert_true(births > 30 && all > 100);
}

/* Two near points amid a ring that is a little wider at its diagonals: those of the ring that bind for discs are at the
 * axes, for squares at the diagonals, and are not listed at first, as both points have many neighbours. */
static void test_two_hubs(void **state) {
  (void)state;
  test_random r = test_random_start("two hubs");
  for (int c = 0; c < 3; c++) {
    double x[RING + 2] = {-0x1p-8, 0x1p-8}, y[RING + 2] = {0};
    cases_answer a;
    dyd_error err;
    for (size_t k = 0; k < RING; k++) {
      double angle = 6.283185307179586 * ((double)k + test_unit(&r) / 4) / RING,
             far = 1 + 0x1p-9 * fabs(sin(2 * angle));
      x[k + 2] = far * cos(angle);
      y[k + 2] = far * sin(angle);
    }
    assert_int_equal(dyd_sites_new(&a.sites), DYD_OK);
    assert_int_equal(dyd_sites_add_points(a.sites, RING + 2, x, y), DYD_OK);
    assert_int_equal(dyd_delaunay_new(&a.pd, a.sites, NULL, &err), DYD_OK);
    for (uint32_t i = 0; i < 2; i++) {
      dyd_index_list near = {0};
      assert_int_equal(dyd_delaunay_neighbours(&near, a.pd, i, DYD_LEGAL), DYD_OK);
      assert_true(near.count > 30);
      dyd_index_list_clear(&near);
    }
    const dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .metric = DYD_METRIC_BOX};
    assert_int_equal(dyd_tolerance_new(&a.t, a.pd, &o, &err), DYD_OK);
    const dyd_tolerance_row *row = cases_row(a.t, 0, 1);
    assert_true(row && row->event == DYD_EVENT_DEATH && row->lo > 0.3 && row->hi < row->lo * width);
    assert_int_equal(status_of_squares(RING + 2, x, y, row->lo * (1 - 1e-6), 0, 1), DYD_LEGAL);
    assert_int_equal(status_of_squares(RING + 2, x, y, row->hi * (1 + 1e-6), 0, 1), DYD_INDETERMINATE);
    cases_forget(&a);
  }
}

/* Options that do not apply to squares. */
static void test_squares_refused(void **state) {
  (void)state;
  const brute_points p = {3, {0, 1, 0}, {0, 0, 1}};
  const double weight[3] = {1, 1, 1};
  cases_answer a;
  dyd_error err;
  dyd_tolerance *t;
  mpq_t plus, minus;
  ask_squares(&a, &p, NULL, false);
  mpq_inits(plus, minus, NULL);
  assert_int_equal(dyd_tolerance_exact(plus, minus, a.t, 0), DYD_E_ARG);
  assert_int_equal(dyd_tolerance_get(a.t)->metric, DYD_METRIC_BOX);
  const dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .weight = weight, .metric = DYD_METRIC_BOX};
  assert_int_equal(dyd_tolerance_new(&t, a.pd, &o, &err), DYD_E_ARG);
  assert_non_null(strstr(err.message, "weights"));
  mpq_clears(plus, minus, NULL);
  cases_forget(&a);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_squares_against_oracle), cmocka_unit_test(test_corners),
      cmocka_unit_test(test_squares_against_discs),  cmocka_unit_test(test_whole_and_radii),
      cmocka_unit_test(test_many_squares),           cmocka_unit_test(test_two_hubs),
      cmocka_unit_test(test_squares_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
