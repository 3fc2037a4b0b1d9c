/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Graphs of neighbours through the library: wrong calls, hubs, and both rungs by turns [NNG-1] [GAB-1] [MST-1].
 * Exactness is tried by tests/cli/test_graphs.py. */
#include <setjmp.h>
#include <stdarg.h>

#include "rect/rect.h"
#include "support/random.h"
#include <cmocka.h>
#include <dyadel/graph.h>
#include <math.h>
#include <string.h>

enum { GRAPHS = 3 };

static dyd_graph_list edges_of(const dyd_delaunay *pd, int graph) {
  dyd_graph_list l = {0};
  dyd_error err;
  assert_int_equal(dyd_graph_edges(&l, pd, NULL, (dyd_graph)graph, NULL, &err), DYD_OK);
  return l;
}

static dyd_delaunay *triangulated(const dyd_sites *s, const dyd_delaunay_options *o) {
  dyd_delaunay *pd;
  assert_true(dyd_delaunay_new(&pd, s, o, NULL) >= DYD_OK);
  return pd;
}

/* Boxes of doubles, and the same times 1/3, which doubles do not hold: equal answers. */
static void test_rungs(void **state) {
  (void)state;
  test_random r = test_random_start("graphs of thirds");
  mpq_t third[4];
  for (int k = 0; k < 4; k++) mpq_init(third[k]);
  for (size_t c = 0; c < test_cases(150); c++) {
    dyd_sites *s[2];
    dyd_rect rect;
    dyd_rect_init(&rect);
    for (int k = 0; k < 2; k++) assert_int_equal(dyd_sites_new(&s[k]), DYD_OK);
    size_t n = test_below(&r, 14), size = test_chance(&r, 2) ? 6 : 100;
    for (size_t i = 0; i < n; i++) {
      double x = (double)test_below(&r, size), y = (double)test_below(&r, size);
      assert_int_equal(dyd_sites_add_points(s[0], 1, &x, &y), DYD_OK);
      mpq_set_si(third[0], (long)x, 3);
      mpq_set_si(third[1], (long)y, 3);
      mpq_canonicalize(third[0]);
      mpq_canonicalize(third[1]);
      assert_int_equal(dyd_rect_set_q(&rect, third[0], third[1]), DYD_OK);
      assert_int_equal(dyd_sites_add_rect(s[1], &rect), DYD_OK);
    }
    dyd_delaunay *pd[2] = {triangulated(s[0], NULL), triangulated(s[1], NULL)};
    for (int g = 0; g < GRAPHS; g++) {
      dyd_graph_list a = edges_of(pd[0], g), b = edges_of(pd[1], g);
      assert_int_equal(a.count, b.count);
      for (size_t k = 0; k < a.count; k++) {
        assert_true(a.item[k].i == b.item[k].i && a.item[k].j == b.item[k].j && a.item[k].sure == b.item[k].sure);
        assert_true(k == 0 || a.item[k - 1].i < a.item[k].i ||
                    (a.item[k - 1].i == a.item[k].i && a.item[k - 1].j < a.item[k].j));
      }
      dyd_graph_list_clear(&a);
      dyd_graph_list_clear(&b);
    }
    for (int k = 0; k < 2; k++) {
      dyd_delaunay_free(pd[k]);
      dyd_sites_free(s[k]);
    }
    dyd_rect_clear(&rect);
  }
  for (int k = 0; k < 4; k++) mpq_clear(third[k]);
}

/* A wheel: the middle has all others as neighbours, at nearly one distance. A tree has one edge less than points. */
static void test_hub(void **state) {
  (void)state;
  enum { SPOKES = 3000 };
  dyd_sites *s;
  double x = 0, y = 0;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  assert_int_equal(dyd_sites_add_points(s, 1, &x, &y), DYD_OK);
  for (int k = 0; k < SPOKES; k++) {
    x = 1000 * cos(k * 6.283185307179586 / SPOKES), y = 1000 * sin(k * 6.283185307179586 / SPOKES);
    assert_int_equal(dyd_sites_add_points(s, 1, &x, &y), DYD_OK);
  }
  dyd_delaunay *pd = triangulated(s, NULL);
  dyd_graph_list l = edges_of(pd, DYD_GRAPH_MST);
  size_t sure = 0;
  for (size_t k = 0; k < l.count; k++) sure += l.item[k].sure;
  assert_true(sure <= SPOKES && l.count >= SPOKES);
  dyd_graph_list_clear(&l);
  l = edges_of(pd, DYD_GRAPH_NEAREST);
  assert_true(l.count >= SPOKES + 1);
  assert_int_equal(l.item[0].i, 0);
  dyd_graph_list_clear(&l);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void test_wrong_calls(void **state) {
  (void)state;
  dyd_sites *s;
  dyd_error err;
  dyd_graph_list l = {0};
  int stop = 1;
  const double x0[] = {0, 1, 2, 1}, x1[] = {3, 4, 5, 2}, y[] = {0, 1, 0, 3};
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(s, 4, x0, x1, y, y), DYD_OK);
  dyd_delaunay *pd = triangulated(s, NULL);
  assert_int_equal(dyd_graph_edges(&l, pd, NULL, (dyd_graph)GRAPHS, NULL, &err), DYD_E_ARG);
  assert_non_null(strstr(err.message, "no graph number 3"));
  for (int g = 0; g < GRAPHS; g++)
    assert_int_equal(dyd_graph_edges(&l, pd, NULL, (dyd_graph)g, &stop, NULL), DYD_CANCELLED);
  assert_null(l.item);
  dyd_delaunay_free(pd);
  pd = triangulated(s, &(dyd_delaunay_options){DYD_SIZED(dyd_delaunay_options), .max_pairs = 1});
  assert_true(dyd_delaunay_is_capped(pd));
  assert_int_equal(dyd_graph_edges(&l, pd, NULL, DYD_GRAPH_MST, NULL, &err), DYD_CAPPED);
  assert_non_null(strstr(err.message, "`max_pairs`"));
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_rungs), cmocka_unit_test(test_hub),
                                     cmocka_unit_test(test_wrong_calls)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
