/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Directed cases for what random ones hardly reach (tests/coverage): discs as large as numbers go, many triangles at
 * one site, several faces at one cap, work that is stopped between faces, bounds on memory, misuse. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include "delaunay/state.h"
#include "rect/rect.h"
#include <cmocka.h>
#include <math.h>
#include <string.h>

static dyd_sites *no_sites(void) {
  dyd_sites *s = NULL;
  assert_int_equal(DYD_OK, dyd_sites_new(&s));
  return s;
}

static void add_box(dyd_sites *s, double x0, double x1, double y0, double y1) {
  assert_int_equal(DYD_OK, dyd_sites_add_boxes(s, 1, &x0, &x1, &y0, &y1));
}

static void add_heap(dyd_sites *s, int n, double x) {
  for (int k = 0; k < n; k++) add_box(s, x, x + 1, 0, 1);
}

static dyd_delaunay *made(dyd_status want, dyd_sites *s, const dyd_delaunay_options *o, dyd_error *err) {
  dyd_delaunay *pd = NULL;
  dyd_error_clear(err);
  dyd_status st = dyd_delaunay_new(&pd, s, o, err);
  if (st != want) fail_msg("%d instead of %d: %s", st, want, err->message);
  return pd;
}

/* The hull edge of two boxes above which a site hangs by 2^-height is legal: by discs of radius 2^height. */
static void test_far_witness(void **state) {
  (void)state;
  for (int height = 30; height <= 20000; height *= 5) {
    dyd_sites *s = no_sites();
    dyd_error err;
    dyd_rect r;
    dyd_point c;
    add_box(s, 0, 0x1p-10, 0, 0);
    add_box(s, 1, 1 + 0x1p-10, 0, 0);
    dyd_rect_init(&r);
    dyd_point_init(&c);
    assert_int_equal(DYD_OK, dyd_rect_set_d(&r, 0.5, 0.5, 0, 0));
    dyd_dyadic up;
    dyd_dyadic_init(&up);
    assert_int_equal(DYD_OK, dyd_dyadic_set_si_2exp(&up, 1, -height));
    assert_int_equal(DYD_OK, dyd_interval_set_ends(&r.y, &up, &up));
    assert_int_equal(DYD_OK, dyd_sites_add_rect(s, &r));
    dyd_delaunay *pd = made(DYD_OK, s, NULL, &err);
    assert_int_equal(DYD_LEGAL, dyd_delaunay_status(pd, 0, 1));
    assert_int_equal(DYD_OK, dyd_delaunay_witness(&c, pd, 0, 1));
    assert_true(dyd_dyadic_sgn(&c.y) < 0);
    dyd_delaunay_free(pd);
    dyd_dyadic_clear(&up);
    dyd_point_clear(&c);
    dyd_rect_clear(&r);
    dyd_sites_free(s);
  }
}

/* All triangles have the same lowest site: sorted, each once. */
static void test_wheel(void **state) {
  enum { RIM = 60 };
  (void)state;
  dyd_sites *s = no_sites();
  dyd_error err;
  dyd_triangle_list t = {0};
  const double zero = 0;
  assert_int_equal(DYD_OK, dyd_sites_add_points(s, 1, &zero, &zero));
  for (int k = 0; k < RIM; k++) {
    double turn = 7 * k % RIM * 6.28 / RIM, x = cos(turn), y = sin(turn);
    assert_int_equal(DYD_OK, dyd_sites_add_points(s, 1, &x, &y));
  }
  dyd_delaunay *pd = made(DYD_OK, s, NULL, &err);
  assert_int_equal(DYD_OK, dyd_delaunay_triangles(&t, NULL, pd, 0));
  assert_int_equal(RIM, t.count);
  for (size_t k = 0; k < t.count; k++) {
    assert_int_equal(0, t.item[k].v[0]);
    assert_true(k == 0 || t.item[k - 1].v[1] < t.item[k].v[1]);
  }
  dyd_triangle_list_clear(&t);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

/* A heap in the middle of a square of four points. */
static void add_framed_heap(dyd_sites *s, double x) {
  for (int k = 0; k < 4; k++) {
    double cx = x + (k % 2 ? 50 : -50), cy = k / 2 ? 50 : -50;
    add_box(s, cx, cx, cy, cy);
  }
  add_heap(s, 8, x);
}

static size_t face_pairs(const dyd_delaunay *pd, size_t f) {
  dyd_pair_list l = {0};
  assert_int_equal(DYD_OK, dyd_delaunay_face_pairs(&l, pd, f));
  size_t count = l.count;
  dyd_pair_list_clear(&l);
  return count;
}

/* Two faces and room for the pairs of one and a half: one is whole, the other is capped, whatever both found at once.
 */
static void test_cap_between_faces(void **state) {
  (void)state;
  for (unsigned threads = 1; threads <= 2; threads++) {
    dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .threads = threads};
    dyd_sites *s = no_sites();
    dyd_error err;
    add_framed_heap(s, 0);
    add_framed_heap(s, 1000);
    dyd_delaunay *pd = made(DYD_OK, s, &o, &err);
    size_t faces = dyd_delaunay_undecided_faces(pd), most = 0, whole = 0, pairs = 0;
    for (size_t f = 0; f < faces; f++) most = face_pairs(pd, f) > most ? face_pairs(pd, f) : most;
    dyd_delaunay_free(pd);
    o.max_pairs = most + most / 2;
    pd = made(DYD_CAPPED, s, &o, &err);
    assert_non_null(strstr(err.message, "undecided pairs to store"));
    assert_int_equal(faces, dyd_delaunay_undecided_faces(pd));
    for (size_t f = 0; f < faces; f++) {
      whole += face_pairs(pd, f) == most;
      pairs += face_pairs(pd, f);
    }
    assert_int_equal(1, whole);
    assert_true(pairs < 2 * most);
    for (uint32_t i = 4; i < 12; i++)
      for (uint32_t j = 4; j < i; j++) {
        assert_int_equal(DYD_INDETERMINATE, dyd_delaunay_status(pd, i, j));
        assert_int_equal(DYD_INDETERMINATE, dyd_delaunay_status(pd, 12 + i, 12 + j));
      }
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
  }
}

static dyd_status stop_work(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                            dyd_error *err) {
  (void)relation, (void)site, (void)count, (void)err, (void)proved;
  *(volatile int *)user = 1;
  return DYD_OK;
}

/* Stopped between faces: faces not closed count as capped, or the work is cancelled. */
static void test_stopped_between_faces(void **state) {
  (void)state;
  for (int keep = 0; keep < 2; keep++) {
    volatile int stop = 0;
    const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = &stop, .prove = stop_work,
                                    .prove_user = (void *)(uintptr_t)&stop, .keep_cut = keep};
    dyd_sites *s = no_sites();
    dyd_error err;
    for (int k = 0; k < 4; k++) add_box(s, k % 2, k % 2 + 0x1p-40, k / 2, k / 2 + 0x1p-40);
    add_heap(s, 8, 1000);
    dyd_delaunay *pd = made(keep ? DYD_CAPPED : DYD_CANCELLED, s, &o, &err);
    assert_int_equal(keep, pd != NULL);
    assert_int_equal(1, stop);
    if (keep) assert_non_null(strstr(err.message, "stopped before all undecided faces"));
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
  }
}

/* A line is built anew next to the old one; if memory does not suffice for both, the old one stays. */
static void test_room_to_rebuild(void **state) {
  (void)state;
  dyd_sites *s = no_sites();
  dyd_error err;
  dyd_rect r;
  snapshot was;
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_bytes = 1000000};
  const uint32_t changed = 3;
  for (int k = 0; k < 9; k++) add_box(s, k, k + 1.25, 0, 0);
  dyd_delaunay *pd = made(DYD_OK, s, &o, &err);
  snapshot_take(was, pd, 9);
  dyd_rect_init(&r);
  assert_int_equal(DYD_OK, dyd_rect_set_d(&r, 3.5, 3.5, 0, 0));
  assert_int_equal(DYD_OK, dyd_sites_narrow(s, 3, &r));
  o.max_bytes = dyd_delaunay_memory(pd) + 100;
  assert_int_equal(DYD_E_NOMEM, dyd_delaunay_update(pd, &changed, 1, &o, &err));
  assert_non_null(strstr(err.message, "made anew"));
  for (uint32_t k = 0; k + 1 < 9; k++) assert_int_equal(was[k][k + 1], dyd_delaunay_status(pd, k, k + 1));
  o.max_bytes = 1000000;
  assert_int_equal(DYD_OK, dyd_delaunay_update(pd, &changed, 1, &o, &err));
  dyd_delaunay_counters c = {DYD_SIZED(dyd_delaunay_counters)};
  assert_int_equal(DYD_OK, dyd_delaunay_get_counters(&c, pd, &err));
  assert_true(c.bytes_most > 0 && c.bytes_most < o.max_bytes);
  dyd_rect_clear(&r);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void test_sites_added_later(void **state) {
  (void)state;
  dyd_sites *s = no_sites();
  dyd_error err;
  add_heap(s, 3, 0);
  dyd_delaunay *pd = made(DYD_OK, s, NULL, &err);
  add_heap(s, 1, 5);
  assert_int_equal(DYD_E_ARG, dyd_delaunay_update(pd, NULL, 0, NULL, &err));
  assert_non_null(strstr(err.message, "sites were added"));
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_far_witness),       cmocka_unit_test(test_wheel),
      cmocka_unit_test(test_cap_between_faces), cmocka_unit_test(test_stopped_between_faces),
      cmocka_unit_test(test_room_to_rebuild),   cmocka_unit_test(test_sites_added_later)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
