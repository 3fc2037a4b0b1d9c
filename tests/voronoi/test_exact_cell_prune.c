/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [PRUNE-1] Cells in a window with and without pruning of arcs that others cover: the same arcs, number by number.
 *
 * Up to forty rectangles: nearly or exactly cocircular, on a lattice with shared corners and sides, overlapping;
 * windows anywhere, tiny ones, and some with sides on the lattice. */
#include <setjmp.h>
#include <stdarg.h>

#include "support/random.h"
#include <cmocka.h>
#include <dyadel/voronoi.h>
#include <math.h>
#include <string.h>

#include "voronoi/exact_cell.h"

enum { MOST = 40, KINDS = 6 };

static size_t regions, arcs;

static void set(dyd_rect *out, double x, double y, double w, double h) {
  assert_int_equal(dyd_rect_set_d(out, x - w, x + w, y - h, y + h), DYD_OK);
}

/* A point of the circle of radius 65 about 0 with integer coordinates. */
static void cocircular(double at[2], test_random *r) {
  static const double leg[5][2] = {{0, 65}, {16, 63}, {25, 60}, {33, 56}, {39, 52}};
  const double *l = leg[test_below(r, 5)];
  bool turned = test_chance(r, 2);
  at[turned] = test_chance(r, 2) ? l[0] : -l[0];
  at[!turned] = test_chance(r, 2) ? l[1] : -l[1];
}

static void make_rect(dyd_rect *out, test_random *r, size_t kind, size_t k, size_t n) {
  double at[2], w = 0, h = 0;
  if (kind < 2) { /* a regular polygon of computable numbers; kind 1: wider */
    double t = 6.283185307179586 * (double)k / (double)n, size = kind ? 0x1p-7 : 0x1p-40;
    set(out, cos(t) + size * test_unit(r), sin(t) + size * test_unit(r), size, size * 2);
  } else if (kind < 4) { /* exactly cocircular; kind 3: with extent */
    cocircular(at, r);
    if (kind == 3 && test_chance(r, 2)) w = 0x1p-3 * (double)test_below(r, 3);
    if (kind == 3 && test_chance(r, 2)) h = 0x1p-3 * (double)test_below(r, 3);
    set(out, at[0], at[1], w, h);
  } else { /* a lattice; kind 5: wide, many overlaps */
    uint64_t wide = kind == 4 ? 2 : 6;
    double x = (double)test_below(r, 24), y = (double)test_below(r, 24);
    set(out, x, y, (double)test_below(r, wide) / 2, (double)test_below(r, wide) / 2);
  }
}

static void make_window(dyd_rect *out, test_random *r, size_t kind) {
  double size = kind < 2 ? 2 : kind < 4 ? 128 : 24, x, y, w, h;
  uint64_t form = test_below(r, 4);
  if (form == 0) { /* round everything */
    set(out, kind < 4 ? 0 : 12, kind < 4 ? 0 : 12, size, size);
    return;
  }
  if (form == 1) { /* lattice */
    x = (double)test_between(r, -8, 24), y = (double)test_between(r, -8, 24);
    w = (double)test_between(r, 1, 16), h = (double)test_between(r, 1, 16);
    double f = kind < 2 ? 0x1p-4 : kind < 4 ? 4 : 1;
    assert_int_equal(dyd_rect_set_d(out, f * x, f * (x + w), f * y, f * (y + h)), DYD_OK);
    return;
  }
  x = kind < 4 ? (test_unit(r) - 0.5) * size / 4 : test_unit(r) * size;
  y = kind < 4 ? (test_unit(r) - 0.5) * size / 4 : test_unit(r) * size;
  w = h = size * ldexp(1, -(int)test_below(r, 8));
  if (form == 3) x = y = 0;
  set(out, x, y, w, h);
}

/* ---- comparison ---- */

static void same_end(const dyd_arc_end *a, const dyd_arc_end *b) {
  assert_int_equal(a->kind, b->kind);
  assert_int_equal(a->site, b->site);
  mpz_srcptr x[6] = {a->at.ax, a->at.bx, a->at.ay, a->at.by, a->at.c, a->at.d};
  mpz_srcptr y[6] = {b->at.ax, b->at.bx, b->at.ay, b->at.by, b->at.c, b->at.d};
  for (int k = 0; k < 6; k++) assert_int_equal(mpz_cmp(x[k], y[k]), 0);
}

static void same_boundary(const dyd_boundary *a, const dyd_boundary *b) {
  assert_int_equal(a->whole, b->whole);
  assert_int_equal(a->count, b->count);
  for (size_t m = 0; m < a->count; m++) {
    assert_int_equal(a->chain[m].count, b->chain[m].count);
    assert_int_equal(a->chain[m].closed, b->chain[m].closed);
    for (size_t k = 0; k < a->chain[m].count; k++) {
      const dyd_arc *p = &a->chain[m].arc[k], *q = &b->chain[m].arc[k];
      assert_int_equal(p->kind, q->kind);
      assert_int_equal(p->far_site, q->far_site);
      assert_int_equal(p->near_site, q->near_site);
      assert_int_equal(p->corner, q->corner);
      assert_int_equal(p->feature, q->feature);
      same_end(&p->begin, &q->begin);
      same_end(&p->end, &q->end);
      arcs++;
    }
  }
}

static void check_task(dyd_cell_task *task) {
  dyd_boundary all = {0}, some = {0};
  task->keep_all = true;
  assert_int_equal(dyd_cell_boundary(&all, task), DYD_OK);
  task->keep_all = false;
  assert_int_equal(dyd_cell_boundary(&some, task), DYD_OK);
  same_boundary(&all, &some);
  regions++;
  dyd_boundary_clear(&some);
  dyd_boundary_clear(&all);
}

/* ---- cases ---- */

/* Site i against its possible neighbours (pd given) or all others. */
static void check_site(const dyd_rect *rect, uint32_t n, uint32_t i, const dyd_delaunay *pd, const dyd_rect *window) {
  uint32_t other[MOST];
  const dyd_rect *in[MOST + 1] = {&rect[i]};
  dyd_index_list list = {0};
  size_t count = 0;
  if (pd) assert_int_equal(dyd_delaunay_neighbours(&list, pd, i, DYD_TIE), DYD_OK);
  for (uint32_t k = 0; k < (pd ? list.count : n); k++)
    if (pd || k != i) other[count++] = pd ? list.item[k] : k;
  for (size_t k = 0; k < count; k++) in[k + 1] = &rect[other[k]];
  in[count + 1] = window;
  for (int outer = 0; outer < 2; outer++) {
    dyd_cell_task task = {i, other, count, in, outer, true, pd, false, NULL, NULL};
    check_task(&task);
  }
  dyd_index_list_clear(&list);
}

static void check_case(test_random *r, dyd_rect *rect, size_t kind) {
  uint32_t n = (uint32_t)test_between(r, 18, kind < 2 ? 30 : 24);
  dyd_rect window;
  dyd_rect_init(&window);
  dyd_sites *s = NULL;
  dyd_delaunay *pd = NULL;
  dyd_error err;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (uint32_t k = 0; k < n; k++) {
    make_rect(&rect[k], r, kind, k, n);
    assert_int_equal(dyd_sites_add_rect(s, &rect[k]), DYD_OK);
  }
  assert_int_equal(dyd_delaunay_new(&pd, s, NULL, &err), DYD_OK);
  for (int times = 0; times < 3; times++) {
    uint32_t i = (uint32_t)test_below(r, n);
    make_window(&window, r, kind);
    if (dyd_delaunay_alias(pd, i) != i) continue;
    check_site(rect, n, i, pd, &window);
    bool alone = true; /* equal points do not count as others of one another */
    for (uint32_t k = 0; k < n; k++) alone = alone && dyd_delaunay_alias(pd, k) == k;
    if (alone) check_site(rect, n, i, NULL, &window);
  }
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  dyd_rect_clear(&window);
}

static void same_with_and_without(void **state) {
  (void)state;
  test_random r = test_random_start("voronoi prune");
  dyd_rect rect[MOST];
  for (int k = 0; k < MOST; k++) dyd_rect_init(&rect[k]);
  for (size_t k = 0; k < test_cases(60); k++) check_case(&r, rect, k % KINDS);
  for (int k = MOST; k-- > 0;) dyd_rect_clear(&rect[k]);
  fprintf(stderr, "# %zu regions, %zu arcs\n", regions, arcs);
  assert_true(arcs > regions);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(same_with_and_without)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
