/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [AREA-T], [HAUS-T], [AREA-V]: the bounds against random choices of points, whose Delaunay graphs come from the
 * oracle. */
#include "metric/bounds.h"
#include "oracle/oracle.h"
#include "oracle/oracle_gen.h"
#include "rect/rect.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* A table of the rectangles of c. */
static dyd_sites *make_sites(const orc_case *c) {
  dyd_sites *sites;
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(DYD_OK, dyd_sites_new(&sites));
  for (size_t i = 0; i < c->n; i++) {
    dyd_interval *side[2] = {&r.x, &r.y};
    for (int a = 0; a < 2; a++) {
      mpq_srcptr lo = c->rect[i].e[2 * a], hi = c->rect[i].e[2 * a + 1];
      dyd_status st =
          mpq_equal(lo, hi) ? dyd_interval_set_q(side[a], lo) : dyd_interval_set_outward(side[a], lo, hi, -200);
      assert_int_equal(DYD_OK, st);
    }
    assert_int_equal(DYD_OK, dyd_sites_add_rect(sites, &r));
  }
  dyd_rect_clear(&r);
  return sites;
}

/* out = squared distance of (x, y) to the segment from rectangle p to rectangle q of c (points). */
static void segment2(mpq_t out, const mpq_t x, const mpq_t y, const orc_rect *p, const orc_rect *q) {
  mpq_t dx, dy, ex, ey, t, s;
  mpq_inits(dx, dy, ex, ey, t, s, NULL);
  mpq_sub(dx, q->e[0], p->e[0]);
  mpq_sub(dy, q->e[2], p->e[2]);
  mpq_sub(ex, x, p->e[0]);
  mpq_sub(ey, y, p->e[2]);
  mpq_mul(t, dx, ex);
  mpq_mul(s, dy, ey);
  mpq_add(t, t, s);
  mpq_mul(out, dx, dx);
  mpq_mul(s, dy, dy);
  mpq_add(out, out, s);
  if (mpq_sgn(out) > 0) mpq_div(t, t, out);
  if (mpq_sgn(t) < 0) mpq_set_ui(t, 0, 1);
  if (mpq_cmp_ui(t, 1, 1) > 0) mpq_set_ui(t, 1, 1);
  mpq_mul(dx, dx, t);
  mpq_sub(ex, ex, dx);
  mpq_mul(dy, dy, t);
  mpq_sub(ey, ey, dy);
  mpq_mul(out, ex, ex);
  mpq_mul(s, ey, ey);
  mpq_add(out, out, s);
  mpq_clears(dx, dy, ex, ey, t, s, NULL);
}

/* A random point (x, y) of Ed(R_i,R_j): (1-t) a + t b, ends and middle more often. */
static void point_of_edge(mpq_t x, mpq_t y, test_random *r, const orc_case *c, size_t i, size_t j) {
  orc_case a, b;
  mpq_t t, s;
  orc_case_init(&a);
  orc_case_init(&b);
  mpq_inits(t, s, NULL);
  orc_choose(&a, r, c, 2);
  orc_choose(&b, r, c, 2);
  mpq_set_ui(t, (unsigned long)test_below(r, 9), 8);
  mpq_canonicalize(t);
  mpq_ptr out[2] = {x, y};
  for (int k = 0; k < 2; k++) {
    mpq_sub(s, b.rect[j].e[2 * k], a.rect[i].e[2 * k]);
    mpq_mul(s, s, t);
    mpq_add(out[k], a.rect[i].e[2 * k], s);
  }
  mpq_clears(t, s, NULL);
  orc_case_clear(&b);
  orc_case_clear(&a);
}

/* The square of the distance of a random point of a random possible pair to the graph of `choice` must not exceed
 * bound^2. Only strictly Delaunay edges count for the graph: the smallest graph that may be called Delaunay. */
static void check_choice(test_random *r, const orc_case *c, const orc_case *choice, const orc_table *graph,
                         const dyd_pair_list *pairs, const mpq_t bound) {
  mpq_t x, y, d, least, bound2;
  mpq_inits(x, y, d, least, bound2, NULL);
  mpq_mul(bound2, bound, bound);
  for (int k = 0; k < 6; k++) {
    const dyd_pair *pair = &pairs->item[test_below(r, pairs->count)];
    point_of_edge(x, y, r, c, pair->i, pair->j);
    bool any = false;
    for (size_t i = 0; i < choice->n; i++)
      for (size_t j = i + 1; j < choice->n; j++) {
        bool same = orc_rect_equal(&choice->rect[i], &choice->rect[j]);
        if (!same && graph->status[i][j] != ORC_LEGAL) continue;
        segment2(d, x, y, &choice->rect[i], &choice->rect[j]);
        if (!any || mpq_cmp(d, least) < 0) mpq_set(least, d);
        any = true;
      }
    assert_true(any);
    assert_true(mpq_cmp(least, bound2) <= 0);
  }
  mpq_clears(x, y, d, least, bound2, NULL);
}

/* area = the sum of exact areas, rounded up by at most 2^-53 of itself. */
static void check_area(const dyd_dyadic *area, const dyd_sites *sites, const dyd_pair_list *pairs) {
  mpq_t sum, t;
  dyd_rect a, b;
  mpq_inits(sum, t, NULL);
  dyd_rect_init(&a);
  dyd_rect_init(&b);
  for (size_t k = 0; k < pairs->count; k++) {
    dyd_sites_get(&a, sites, pairs->item[k].i);
    dyd_sites_get(&b, sites, pairs->item[k].j);
    dyd_partial_edge_area2(t, &a, &b);
    mpq_div_2exp(t, t, 1);
    mpq_add(sum, sum, t);
  }
  dyd_dyadic_get_q(t, area);
  assert_true(mpq_cmp(t, sum) >= 0);
  mpq_sub(t, t, sum);
  mpq_mul_2exp(t, t, 53);
  assert_true(mpq_cmp(t, sum) <= 0);
  dyd_rect_clear(&b);
  dyd_rect_clear(&a);
  mpq_clears(sum, t, NULL);
}

static void check_case(test_random *r, orc_pool *pool, const orc_case *c) {
  dyd_sites *sites = make_sites(c);
  dyd_delaunay *pd = NULL;
  dyd_pair_list pairs = {0};
  dyd_dyadic area, hausdorff;
  mpq_t bound;
  dyd_dyadic_init(&area);
  dyd_dyadic_init(&hausdorff);
  mpq_init(bound);
  assert_int_equal(DYD_OK, dyd_delaunay_new(&pd, sites, NULL, NULL));
  assert_int_equal(DYD_OK, dyd_delaunay_pairs(&pairs, pd));
  assert_int_equal(DYD_OK, dyd_metric_area(&area, pd));
  assert_int_equal(DYD_OK, dyd_metric_hausdorff(&hausdorff, pd));
  check_area(&area, sites, &pairs);
  dyd_dyadic_get_q(bound, &hausdorff);
  orc_case choice;
  orc_case_init(&choice);
  for (int k = 0; pairs.count && k < 4; k++) {
    orc_table graph;
    orc_choose(&choice, r, c, 3);
    orc_statuses(&graph, pool, &choice);
    check_choice(r, c, &choice, &graph, &pairs, bound);
  }
  if (!pairs.count) assert_true(!dyd_dyadic_sgn(&area) && !dyd_dyadic_sgn(&hausdorff));
  orc_case_clear(&choice);
  mpq_clear(bound);
  dyd_dyadic_clear(&hausdorff);
  dyd_dyadic_clear(&area);
  dyd_pair_list_clear(&pairs);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

static void test_choices(void **state) {
  (void)state;
  test_random r = test_random_start("bounds");
  orc_case c;
  orc_pool pool;
  orc_pool_init(&pool);
  for (size_t k = 0; k < test_cases(6 * ORC_KINDS); k++) {
    orc_case_init(&c);
    orc_generate(&c, &r, k % ORC_KINDS, 6);
    size_t mark = orc_mark(&pool);
    check_case(&r, &pool, &c);
    orc_release(&pool, mark);
    orc_case_clear(&c);
  }
  orc_pool_clear(&pool);
}

/* N = 0, 1 and one point given twice: no edge, both bounds 0. */
static void test_few(void **state) {
  (void)state;
  for (int n = 0; n < 3; n++) {
    dyd_sites *sites;
    dyd_delaunay *pd = NULL;
    dyd_dyadic area, hausdorff;
    dyd_dyadic_init(&area);
    dyd_dyadic_init(&hausdorff);
    assert_int_equal(DYD_OK, dyd_sites_new(&sites));
    const double x[2] = {1, 1};
    assert_int_equal(DYD_OK, dyd_sites_add_points(sites, (size_t)n, x, x));
    assert_int_equal(DYD_OK, dyd_delaunay_new(&pd, sites, NULL, NULL));
    assert_int_equal(DYD_OK, dyd_metric_area(&area, pd));
    assert_int_equal(DYD_OK, dyd_metric_hausdorff(&hausdorff, pd));
    assert_int_equal(0, dyd_dyadic_sgn(&area));
    assert_int_equal(0, dyd_dyadic_sgn(&hausdorff));
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
    dyd_dyadic_clear(&hausdorff);
    dyd_dyadic_clear(&area);
  }
}

/* Two rectangles of known size: [0,1]x[0,0] and [10,10]x[0,1]. The pair is legal. The hull
 * has corners (0,0), (10,0), (10,1): area 5. Both diameters are 1. */
static void test_by_hand(void **state) {
  (void)state;
  dyd_sites *sites;
  dyd_delaunay *pd = NULL;
  dyd_dyadic area, hausdorff;
  dyd_dyadic_init(&area);
  dyd_dyadic_init(&hausdorff);
  const double x0[2] = {0, 10}, x1[2] = {1, 10}, y0[2] = {0, 0}, y1[2] = {0, 1};
  assert_int_equal(DYD_OK, dyd_sites_new(&sites));
  assert_int_equal(DYD_OK, dyd_sites_add_boxes(sites, 2, x0, x1, y0, y1));
  assert_int_equal(DYD_OK, dyd_delaunay_new(&pd, sites, NULL, NULL));
  assert_int_equal(DYD_LEGAL, dyd_delaunay_status(pd, 0, 1));
  assert_int_equal(DYD_OK, dyd_metric_area(&area, pd));
  assert_int_equal(DYD_OK, dyd_metric_hausdorff(&hausdorff, pd));
  assert_true(dyd_dyadic_get_d(&area, DYD_DOWN) == 5);
  assert_true(dyd_dyadic_get_d(&hausdorff, DYD_DOWN) == 1);
  assert_true(dyd_dyadic_get_d(&hausdorff, DYD_UP) <= 1 + 0x1p-52);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  dyd_dyadic_clear(&hausdorff);
  dyd_dyadic_clear(&area);
}

/* Is an area in doubles on its side of that of the polygons, if they are not doubles themselves? */
static dyd_status check_shape(void *context, uint32_t i, const dyd_shape *shape, const double area[2]) {
  mpq_t exact, rounded;
  dyd_dyadic area2;
  (void)i;
  if (shape->in_doubles && !shape->on_grid) return DYD_OK;
  mpq_inits(exact, rounded, NULL);
  dyd_dyadic_init(&area2);
  for (int outer = 0; outer < 2; outer++) {
    assert_int_equal(DYD_OK, dyd_shape_area2(&area2, shape, outer));
    dyd_dyadic_get_q(exact, &area2);
    mpq_div_2exp(exact, exact, 1);
    mpq_set_d(rounded, area[outer]);
    int sign = mpq_cmp(rounded, exact);
    assert_true(outer ? sign >= 0 : sign <= 0);
    *(size_t *)context += sign != 0;
  }
  dyd_dyadic_clear(&area2);
  mpq_clears(rounded, exact, NULL);
  return DYD_OK;
}

/* Areas of cells are rounded outward to the last bit [AREA-V]. */
static void test_areas_of_cells(void **state) {
  (void)state;
  test_random r = test_random_start("areas of cells");
  orc_case c;
  dyd_rect window;
  size_t rounded = 0;
  dyd_rect_init(&window);
  assert_int_equal(DYD_OK, dyd_interval_set_d(&window.x, -9, 9));
  assert_int_equal(DYD_OK, dyd_interval_set_d(&window.y, -0.1, 8));
  for (size_t k = 0; k < test_cases(2 * ORC_KINDS); k++) {
    dyd_voronoi_sums s;
    dyd_delaunay *pd = NULL;
    orc_case_init(&c);
    orc_generate(&c, &r, k % ORC_KINDS, 6);
    dyd_sites *sites = make_sites(&c);
    assert_int_equal(DYD_OK, dyd_delaunay_new(&pd, sites, NULL, NULL));
    assert_int_equal(DYD_OK, dyd_voronoi_sums_init(&s, pd, &window, k % 2 ? 90 : 20));
    dyd_status st = dyd_voronoi_sums_all(&s, check_shape, &rounded);
    assert_true(st == DYD_OK || st == DYD_E_RANGE);
    dyd_voronoi_sums_clear(&s);
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
    orc_case_clear(&c);
  }
  fprintf(stderr, "# %zu areas rounded\n", rounded);
  assert_true(rounded > 0);
  dyd_rect_clear(&window);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_choices),
      cmocka_unit_test(test_few),
      cmocka_unit_test(test_by_hand),
      cmocka_unit_test(test_areas_of_cells),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
