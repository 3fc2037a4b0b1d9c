/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exhausted memory in nearest-site queries, the partial hull and the making of streams: the k-th allocation fails, for
 * every k. The call says so, leaks nothing (run under a leak checker) and leaves its output as it was. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include "support/compose.h"
#include "support/failing_memory.h"
#include <cmocka.h>
#include <dyadel/dyadel.h>

/* Engines of exact points, of rectangles, of points on a line. */
static dyd_engine *engine_of(int kind) {
  dyd_engine *e = NULL;
  dyd_outcome outcome;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  for (int k = 0; k < 12; k++) {
    double x = k * k % 7, y = kind == 2 ? 0 : k % 5, x1 = x + 1.5, y1 = y + 0.5;
    if (kind == 1)
      dyd_engine_add_boxes(e, 1, &x, &x1, &y, &y1, NULL);
    else
      dyd_engine_add_points(e, 1, &x, &y, NULL);
  }
  assert_int_equal(dyd_engine_run(&outcome, e, NULL, NULL), DYD_OK);
  return e;
}

static dyd_status ask_rect(dyd_engine *e) {
  dyd_rect q;
  dyd_rect_init(&q);
  dyd_rect_set_d(&q, 1, 4, 1, 3);
  dyd_index_list l = {0};
  bool sure;
  dyd_status st = dyd_nearest(&l, &sure, dyd_engine_delaunay(e), &q);
  assert_true(st == DYD_OK || (!l.item && !l.count));
  dyd_index_list_clear(&l);
  dyd_rect_clear(&q);
  return st;
}

static dyd_status ask_places(dyd_engine *e) {
  dyd_place_list l = {0};
  dyd_status st = dyd_nearest_places(&l, dyd_engine_delaunay(e), (const double[]){1, 4, 1, 3, 2.5, 2}, 3, NULL);
  assert_true(st == DYD_OK || (!l.site && !l.end && !l.places));
  dyd_place_list_clear(&l);
  return st;
}

static dyd_status ask_hull(dyd_engine *e) {
  dyd_hull h = {0};
  dyd_status st = dyd_delaunay_partial_hull(&h, dyd_engine_delaunay(e), true);
  assert_true(st == DYD_OK || (!h.possible_vertices.item && !h.sure_vertices.item && !h.pairs.item));
  dyd_hull_clear(&h);
  return st;
}

/* A midpoint of an engine's points as a query; its third corner makes a vertex as well. */
static dyd_status ask_streams(dyd_engine *e) {
  dyd_stream *a = NULL, *b = NULL, *m = NULL, *v = NULL;
  const dyd_triangle t = {{0, 1, 2}};
  dyd_index_list l = {0};
  dyd_outcome outcome;
  bool sure;
  dyd_status st = dyd_engine_stream(&a, e, 1);
  if (st == DYD_OK) st = dyd_engine_stream(&b, e, 2);
  if (st == DYD_OK) {
    st = test_midpoint(&m, a, b);
    a = b = NULL;
  }
  if (st == DYD_OK) st = dyd_engine_nearest(&l, &sure, &outcome, e, m, NULL, NULL);
  dyd_status made = st == DYD_OK ? test_vertex(&v, e, &t) : st;
  if (made == DYD_E_NOMEM) st = made; /* a collinear triangle is not a failure here */
  dyd_index_list_clear(&l);
  dyd_stream_free(v);
  dyd_stream_free(m);
  dyd_stream_free(a);
  dyd_stream_free(b);
  return st;
}

static void test_all(void **state) {
  (void)state;
  dyd_status (*const call[])(dyd_engine *) = {ask_rect, ask_places, ask_hull, ask_streams};
  for (int kind = 0; kind < 3; kind++) {
    dyd_engine *e = engine_of(kind);
    for (size_t n = 0; n < sizeof call / sizeof *call; n++) {
      bool over = false;
      for (size_t k = 1; !over; k++) {
        countdown = k;
        dyd_status st = call[n](e);
        over = countdown > 0;
        countdown = 0;
        /* A question after a stream triangulates sites; without memory for their copy in integers it takes longer. */
        bool does_without = st == DYD_OK && call[n] == ask_streams && kind == 1;
        assert_true(st == (over ? DYD_OK : DYD_E_NOMEM) || does_without);
        assert_true(k < 1000);
      }
    }
    dyd_engine_free(e);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_all)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
