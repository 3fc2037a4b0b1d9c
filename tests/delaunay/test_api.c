/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts at the edges: wrong arguments, caps, cancelling, aliases, faces, hull, memory, nothing at all. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include "delaunay/state.h"
#include "rect/rect.h"
#include <cmocka.h>
#include <fenv.h>
#include <string.h>

static harness shared;

static dyd_delaunay *engine(const dyd_sites *s) {
  char message[MESSAGE_SIZE] = "";
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  if (!pd) fail_msg("%s", message);
  return pd;
}

static void must(bool good, const char *message) {
  if (!good) fail_msg("%s", message);
}

/* n exact points of a square grid. */
static dyd_sites *grid(size_t side) {
  dyd_sites *s = NULL;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (size_t k = 0; k < side * side; k++) {
    double x = (double)(k % side), y = (double)(k / side);
    assert_int_equal(dyd_sites_add_points(s, 1, &x, &y), DYD_OK);
  }
  return s;
}

/* n equal unit squares. */
static dyd_sites *heap_of(size_t n) {
  dyd_sites *s = NULL;
  double lo = 0, hi = 1;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (size_t k = 0; k < n; k++) assert_int_equal(dyd_sites_add_boxes(s, 1, &lo, &hi, &lo, &hi), DYD_OK);
  return s;
}

static void test_nothing(void **state) {
  (void)state;
  dyd_sites *s = grid(0);
  dyd_delaunay *pd = engine(s);
  dyd_pair_list pairs = {0};
  dyd_triangle_list triangles = {0};
  dyd_index_list hull = {0};
  size_t count[4] = {1, 1, 1, 1};
  assert_int_equal(dyd_delaunay_pairs(&pairs, pd), DYD_OK);
  assert_int_equal(dyd_delaunay_triangles(&triangles, NULL, pd, 0), DYD_OK);
  assert_int_equal(dyd_delaunay_hull(&hull, pd), DYD_OK);
  dyd_delaunay_count(count, pd);
  assert_int_equal(pairs.count + triangles.count + hull.count + count[0] + count[1] + count[2] + count[3], 0);
  assert_int_equal(dyd_delaunay_undecided_faces(pd), 0);
  assert_int_equal(dyd_delaunay_update(pd, NULL, 0, NULL, NULL), DYD_OK);
  assert_false(dyd_delaunay_is_capped(pd));
  assert_ptr_equal(dyd_delaunay_sites(pd), s);
  dyd_pair_list_clear(&pairs);
  dyd_triangle_list_clear(&triangles);
  dyd_index_list_clear(&hull);
  dyd_pair_list_clear(&pairs);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  dyd_delaunay_free(NULL);
  dyd_sites_free(NULL);
}

static void test_site_arguments(void **state) {
  (void)state;
  dyd_sites *s = grid(2);
  double good = 0, nan = strtod("nan", NULL), huge = strtod("inf", NULL), one = 1, out[4];
  assert_int_equal(dyd_sites_add_points(s, 1, &nan, &good), DYD_E_ARG);
  assert_int_equal(dyd_sites_add_points(s, 1, &good, &huge), DYD_E_ARG);
  assert_int_equal(dyd_sites_add_boxes(s, 1, &one, &good, &good, &one), DYD_E_ARG);
  assert_int_equal(dyd_sites_add_boxes(s, 1, &good, &one, &one, &good), DYD_E_ARG);
  assert_int_equal(dyd_sites_add_boxes(s, 1, &good, &huge, &good, &one), DYD_E_ARG);
  double x[3] = {5, 6, nan}, y[3] = {5, 6, 7};
  assert_int_equal(dyd_sites_add_points(s, 3, x, y), DYD_E_ARG);
  assert_int_equal(dyd_sites_count(s), 4);
  assert_true(dyd_sites_is_point(s, 3));
  assert_true(dyd_sites_memory(s) > 0);
  dyd_sites_get_d(out, s, 3);
  assert_true(out[0] == 1 && out[1] == 1 && out[2] == 1 && out[3] == 1);
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(dyd_rect_set_d(&r, 0, 1, 1, 1), DYD_OK);
  assert_int_equal(dyd_sites_narrow(s, 3, &r), DYD_E_NESTING);
  assert_int_equal(dyd_sites_get(&r, s, 3), DYD_OK);
  assert_true(dyd_rect_is_point(&r));
  dyd_rect_clear(&r);
  dyd_sites_free(s);
}

/* A tenth and the doubles around it are three different sites; exact ends come back exactly. */
static void test_exact_sites(void **state) {
  (void)state;
  orc_case c;
  mpq_t lo, hi;
  dyd_rect r;
  double d[4];
  mpq_inits(lo, hi, NULL);
  orc_case_init(&c);
  dyd_rect_init(&r);
  orc_case_add(&c, 1, 1, 1, 1, 10);
  orc_case_add(&c, 0, 3, 1, 1, 10);
  mpq_set_si(c.rect[1].e[1], 3, 4);
  dyd_sites *s = harness_sites(&c);
  assert_true(dyd_sites_is_point(s, 0));
  assert_false(dyd_sites_is_point(s, 1));
  for (size_t i = 0; i < 2; i++) {
    assert_int_equal(dyd_sites_get(&r, s, i), DYD_OK);
    dyd_interval_get_q(lo, hi, &r.x);
    assert_true(mpq_equal(lo, c.rect[i].e[0]) && mpq_equal(hi, c.rect[i].e[1]));
    dyd_interval_get_q(lo, hi, &r.y);
    assert_true(mpq_equal(lo, c.rect[i].e[2]) && mpq_equal(hi, c.rect[i].e[3]));
    dyd_sites_get_d(d, s, i);
    assert_true(d[0] <= d[1] && d[2] < 0.1 + 0x1p-50 && d[2] < d[3]);
  }
  dyd_sites_free(s);
  dyd_rect_clear(&r);
  orc_case_clear(&c);
  mpq_clears(lo, hi, NULL);
}

static void test_query_arguments(void **state) {
  (void)state;
  dyd_sites *s = grid(3);
  dyd_delaunay *pd = engine(s);
  dyd_index_list l = {0};
  dyd_pair_list pairs = {0};
  dyd_point w;
  bool outer = false;
  uint32_t outside = 9;
  dyd_point_init(&w);
  assert_int_equal(dyd_delaunay_witness(&w, pd, 0, 8), DYD_E_ARG);
  assert_int_equal(dyd_delaunay_witness(&w, pd, 0, 0), DYD_E_ARG);
  assert_int_equal(dyd_delaunay_witness(&w, pd, 0, 4), DYD_E_ARG);
  assert_int_equal(dyd_delaunay_witness(&w, pd, 0, 1), DYD_OK);
  assert_int_equal(dyd_delaunay_face(&l, &outer, pd, dyd_delaunay_undecided_faces(pd)), DYD_E_ARG);
  assert_int_equal(dyd_delaunay_face_pairs(&pairs, pd, dyd_delaunay_undecided_faces(pd)), DYD_E_ARG);
  assert_int_equal(dyd_delaunay_neighbours(&l, pd, outside, DYD_TIE), DYD_E_ARG);
  assert_int_equal(dyd_delaunay_update(pd, &outside, 1, NULL, NULL), DYD_E_ARG);
  assert_true(dyd_delaunay_memory(pd) > 0);
  assert_int_equal(dyd_delaunay_status(pd, 0, outside), DYD_ILLEGAL);
  assert_int_equal(dyd_delaunay_status(pd, outside, 0), DYD_ILLEGAL);
  dyd_point_clear(&w);
  dyd_index_list_clear(&l);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

/* Structs without their size, doubles that round elsewhere: the call changes nothing. More pairs than numbers exist: as
 * many. */
static void test_refused(void **state) {
  (void)state;
  dyd_sites *s = grid(3);
  dyd_delaunay *pd = NULL;
  dyd_delaunay_options o = {.threads = 2};
  dyd_delaunay_counters c = {.filter = 0};
  dyd_error err;
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, &err), DYD_E_ARG);
  o = (dyd_delaunay_options){DYD_SIZED(dyd_delaunay_options), .max_pairs = SIZE_MAX};
  fesetround(FE_UPWARD);
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, &err), DYD_E_ARG);
  fesetround(FE_TONEAREST);
  assert_null(pd);
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, &err), DYD_OK);
  assert_int_equal(dyd_delaunay_get_counters(&c, pd, &err), DYD_E_ARG);
  fesetround(FE_DOWNWARD);
  assert_int_equal(dyd_delaunay_update(pd, NULL, 0, &o, &err), DYD_E_ARG);
  fesetround(FE_TONEAREST);
  o.struct_size = 0;
  assert_int_equal(dyd_delaunay_update(pd, NULL, 0, &o, &err), DYD_E_ARG);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

/* Four squares of ties, and outside four sides of three collinear points: the outer face may be given in parts. */
static void test_faces_of_grid(void **state) {
  (void)state;
  dyd_sites *s = grid(3);
  dyd_delaunay *pd = engine(s);
  size_t outside = 0, squares = 0, count[4];
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd); f++) {
    dyd_index_list l = {0};
    dyd_pair_list pairs = {0};
    bool outer = false;
    assert_int_equal(dyd_delaunay_face(&l, &outer, pd, f), DYD_OK);
    assert_int_equal(dyd_delaunay_face_pairs(&pairs, pd, f), DYD_OK);
    outside += outer ? pairs.count : 0;
    squares += !outer && l.count == 4 && pairs.count == 2;
    dyd_index_list_clear(&l);
    dyd_pair_list_clear(&pairs);
  }
  assert_true(outside == 4 && squares == 4);
  dyd_delaunay_count(count, pd);
  assert_true(count[DYD_LEGAL] == 12 && count[DYD_TIE] == 12 && count[DYD_INDETERMINATE] == 0);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

/* The hull of separated points, counter-clockwise; points on its sides may be listed or not. */
static void test_hull(void **state) {
  (void)state;
  dyd_sites *s = grid(3);
  dyd_delaunay *pd = engine(s);
  dyd_index_list l = {0};
  static const uint32_t round[8] = {0, 1, 2, 5, 8, 7, 6, 3};
  assert_int_equal(dyd_delaunay_hull(&l, pd), DYD_OK);
  size_t corners = 0, place[9] = {0}, falls = 0;
  for (size_t k = 0; k < 8; k++) place[round[k]] = k + 1;
  for (size_t k = 0; k < l.count; k++) {
    assert_true(l.item[k] < 9 && place[l.item[k]]);
    corners += l.item[k] == 0 || l.item[k] == 2 || l.item[k] == 6 || l.item[k] == 8;
    falls += place[l.item[k]] >= place[l.item[(k + 1) % l.count]];
  }
  assert_true(corners == 4 && falls == 1);
  dyd_index_list_clear(&l);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void test_aliases(void **state) {
  (void)state;
  dyd_sites *s = NULL;
  static const double x[6] = {0, 4, 0, 4, 2, 0}, y[6] = {0, 0, 0, 0, 3, 0};
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  assert_int_equal(dyd_sites_add_points(s, 6, x, y), DYD_OK);
  dyd_delaunay *pd = engine(s);
  static const uint32_t stands[6] = {0, 1, 0, 1, 4, 0};
  dyd_triangle_list l = {0};
  for (uint32_t i = 0; i < 6; i++) {
    assert_int_equal(dyd_delaunay_alias(pd, i), stands[i]);
    for (uint32_t j = 0; j < 6; j++)
      assert_int_equal(dyd_delaunay_status(pd, i, j), stands[i] == stands[j] ? DYD_ILLEGAL : DYD_LEGAL);
  }
  assert_int_equal(dyd_delaunay_triangles(&l, NULL, pd, 0), DYD_OK);
  assert_int_equal(l.count, 1);
  dyd_triangle_list_clear(&l);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

/* Returns true if the message names some site of the case by its number. */
static bool names_a_site(const char *message, size_t n) {
  for (const char *t = message; *t; t++)
    if (*t >= '0' && *t <= '9') return strtoul(t, NULL, 10) < n;
  return false;
}

/* 60 equal squares have 1770 possible pairs; at a cap of 10 the object is still right. */
static void test_cap(void **state) {
  (void)state;
  size_t n = 60, count[4];
  dyd_sites *s = heap_of(n);
  dyd_delaunay *pd = NULL;
  dyd_error err;
  dyd_pair_list l = {0};
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = 10};
  dyd_error_clear(&err);
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, &err), DYD_CAPPED);
  assert_non_null(pd);
  assert_true(dyd_delaunay_is_capped(pd));
  assert_int_equal(err.code, DYD_CAPPED);
  assert_true(names_a_site(err.message, n));
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = 0; j < n; j++)
      assert_int_equal(dyd_delaunay_status(pd, i, j), i == j ? DYD_ILLEGAL : DYD_INDETERMINATE);
  assert_int_equal(dyd_delaunay_pairs(&l, pd), DYD_OK);
  assert_true(l.count < n * (n - 1) / 2);
  dyd_delaunay_count(count, pd);
  assert_int_equal(count[DYD_LEGAL], 0);
  dyd_pair_list_clear(&l);
  dyd_delaunay_free(pd);
  assert_int_equal(dyd_delaunay_new(&pd, s, NULL, &err), DYD_OK);
  dyd_delaunay_count(count, pd);
  assert_int_equal(count[DYD_INDETERMINATE], n * (n - 1) / 2);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

/* A capped triangulation dissolves when the sites shrink to the points of a parabola. */
static void test_cap_dissolves(void **state) {
  (void)state;
  size_t n = 20, count[4];
  uint32_t changed[20];
  dyd_sites *s = heap_of(n);
  dyd_delaunay *pd = NULL;
  dyd_rect r;
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = 5};
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, NULL), DYD_CAPPED);
  dyd_rect_init(&r);
  for (uint32_t i = 0; i < n; i++) {
    double x = i / 32.0, y = x * x;
    changed[i] = i;
    assert_int_equal(dyd_rect_set_d(&r, x, x, y, y), DYD_OK);
    assert_int_equal(dyd_sites_narrow(s, i, &r), DYD_OK);
  }
  dyd_rect_clear(&r);
  assert_int_equal(dyd_delaunay_update(pd, changed, n, NULL, NULL), DYD_OK);
  assert_false(dyd_delaunay_is_capped(pd));
  dyd_delaunay_count(count, pd);
  assert_int_equal(count[DYD_TIE] + count[DYD_INDETERMINATE], 0);
  assert_int_equal(count[DYD_LEGAL], 2 * n - 3);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void test_cancel(void **state) {
  (void)state;
  dyd_sites *s = heap_of(30);
  dyd_delaunay *pd = (dyd_delaunay *)s;
  volatile int flag = 1;
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = &flag};
  dyd_error err;
  dyd_error_clear(&err);
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, &err), DYD_CANCELLED);
  assert_null(pd);
  flag = 0;
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, &err), DYD_OK);
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(dyd_rect_set_d(&r, 0, 0, 0, 0), DYD_OK);
  assert_int_equal(dyd_sites_narrow(s, 0, &r), DYD_OK);
  flag = 1;
  uint32_t changed = 0;
  assert_int_equal(dyd_delaunay_update(pd, &changed, 1, &o, &err), DYD_CANCELLED);
  for (uint32_t j = 1; j < 30; j++) assert_int_equal(dyd_delaunay_status(pd, 0, j), DYD_INDETERMINATE);
  flag = 0;
  assert_int_equal(dyd_delaunay_update(pd, &changed, 1, &o, &err), DYD_OK);
  dyd_rect_clear(&r);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

/* Counters count, and the exact rung alone is used when asked for. */
static void test_counters(void **state) {
  (void)state;
  dyd_sites *s = grid(4);
  dyd_delaunay *pd = NULL;
  dyd_delaunay_counters k = {DYD_SIZED(dyd_delaunay_counters)};
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = true};
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, NULL), DYD_OK);
  dyd_delaunay_get_counters(&k, pd, NULL);
  assert_int_equal(k.filter, 0);
  assert_true(k.exact + k.integer > 0);
  dyd_delaunay_free(pd);
  assert_int_equal(dyd_delaunay_new(&pd, s, NULL, NULL), DYD_OK);
  dyd_delaunay_get_counters(&k, pd, NULL);
  assert_true(k.filter + k.exact + k.integer > 0);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

/* Neither the engine nor the queries change the sites; two engines of the same sites agree. */
static void test_pure(void **state) {
  (void)state;
  char message[MESSAGE_SIZE] = "";
  orc_case c;
  orc_case_init(&c);
  for (size_t kind = 0; kind < ORC_KINDS; kind++) {
    orc_generate(&c, &shared.random, kind, 9);
    dyd_sites *s = harness_sites(&c);
    dyd_delaunay *a = engine(s), *b = engine(s);
    must(same_statuses(message, &shared, &c, a, b), message);
    must(queries_agree(message, &c, a), message);
    must(witnesses_hold(message, &shared.pool, &c, b), message);
    dyd_delaunay_free(a);
    must(queries_agree(message, &c, b), message);
    dyd_delaunay_free(b);
    dyd_sites_free(s);
  }
  orc_case_clear(&c);
}

/* Beside a point that is nearly on it, a long edge is legal, and its witnesses are farther than numbers go. */
static void test_witness_out_of_range(void **state) {
  (void)state;
  dyd_dyadic x, y;
  dyd_rect r;
  dyd_point c;
  dyd_dyadic_init(&x);
  dyd_dyadic_init(&y);
  dyd_rect_init(&r);
  dyd_point_init(&c);
  for (int64_t height = 0; height < DYD_EXP_LIMIT; height += DYD_EXP_LIMIT - 3016) {
    dyd_sites *s = NULL;
    assert_int_equal(dyd_sites_new(&s), DYD_OK);
    for (int k = 0; k < 3; k++) {
      assert_int_equal(dyd_dyadic_set_si_2exp(&x, k, DYD_EXP_LIMIT - 16), DYD_OK);
      assert_int_equal(dyd_dyadic_set_si_2exp(&y, k == 1, height), DYD_OK);
      assert_int_equal(dyd_interval_set_ends(&r.x, &x, &x), DYD_OK);
      assert_int_equal(dyd_interval_set_ends(&r.y, &y, &y), DYD_OK);
      assert_int_equal(dyd_sites_add_rect(s, &r), DYD_OK);
    }
    dyd_delaunay *pd = engine(s);
    assert_int_equal(dyd_delaunay_status(pd, 0, 2), DYD_LEGAL);
    assert_int_equal(dyd_delaunay_witness(&c, pd, 0, 2), DYD_E_RANGE);
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
  }
  dyd_dyadic_clear(&x);
  dyd_dyadic_clear(&y);
  dyd_point_clear(&c);
  dyd_rect_clear(&r);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_nothing),     cmocka_unit_test(test_site_arguments),
                                     cmocka_unit_test(test_exact_sites), cmocka_unit_test(test_query_arguments),
                                     cmocka_unit_test(test_refused),     cmocka_unit_test(test_faces_of_grid),
                                     cmocka_unit_test(test_hull),        cmocka_unit_test(test_aliases),
                                     cmocka_unit_test(test_cap),         cmocka_unit_test(test_cap_dissolves),
                                     cmocka_unit_test(test_cancel),      cmocka_unit_test(test_counters),
                                     cmocka_unit_test(test_pure),        cmocka_unit_test(test_witness_out_of_range)};
  harness_init(&shared, "api");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
