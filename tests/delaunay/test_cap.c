/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Bounds on pairs and bytes are met by the first pair or byte too many, not before: faces of boxes, and polygons of
 * exact points on a circle with boxes beyond it. */
#include <setjmp.h>
#include <stdarg.h>

#include "support/random.h"

#include <cmocka.h>
#include <dyadel/delaunay.h>
#include <string.h>

enum { MOST = 48 };

static void add_box(dyd_sites *s, double x, double y, double half) {
  double x0 = x - half, x1 = x + half, y0 = y - half, y1 = y + half;
  assert_int_equal(dyd_sites_add_boxes(s, 1, &x0, &x1, &y0, &y1), DYD_OK);
}

/* Several of the 36 points with whole coordinates on the circle x^2 + y^2 = 65^2, and three boxes. */
static void add_circle(dyd_sites *s, test_random *r) {
  unsigned one_in = 2 + (unsigned)test_below(r, 3);
  for (int x = -65; x <= 65; x++)
    for (int y = -65; y <= 65; y++)
      if (x * x + y * y == 65 * 65 && !test_chance(r, one_in)) add_box(s, x, y, 0);
  add_box(s, 400, 0, 2);
  add_box(s, -300, 250, 2);
  add_box(s, -200, -350, 2);
}

static void add_boxes(dyd_sites *s, test_random *r) {
  size_t n = 3 + test_below(r, MOST - 2);
  double wide = test_chance(r, 3) ? 60 : (double)(1 + test_below(r, 6));
  for (size_t k = 0; k < n; k++) add_box(s, 100 * test_unit(r), 100 * test_unit(r), wide * test_unit(r));
}

/* Faces, pairs that are open or ties, and the bytes it took. */
typedef struct answer {
  size_t faces, pairs;
  uint64_t bytes;
} answer;

static dyd_status ask_within(answer *out, dyd_error *err, const dyd_sites *s, size_t pairs, uint64_t most) {
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = pairs, .max_bytes = most, .threads = 1};
  dyd_delaunay *pd = NULL;
  dyd_delaunay_counters c = {DYD_SIZED(dyd_delaunay_counters)};
  size_t count[4];
  dyd_error_clear(err);
  dyd_status st = dyd_delaunay_new(&pd, s, &o, err);
  if (!pd) return st;
  dyd_delaunay_count(count, pd);
  dyd_delaunay_get_counters(&c, pd, NULL);
  *out = (answer){dyd_delaunay_undecided_faces(pd), count[DYD_TIE] + count[DYD_INDETERMINATE], c.bytes_most};
  assert_int_equal(dyd_delaunay_is_capped(pd), st == DYD_CAPPED);
  dyd_delaunay_free(pd);
  return st;
}

static void test_bounds(void **state) {
  (void)state;
  test_random r = test_random_start("bounds");
  const uint64_t plenty = UINT64_C(1) << 40;
  size_t of_face = 0, of_tie = 0, alone = 0;
  for (size_t k = test_cases(400); k; k--) {
    dyd_sites *s = NULL;
    dyd_error err;
    answer open, again;
    assert_int_equal(dyd_sites_new(&s), DYD_OK);
    (k % 2 ? add_circle : add_boxes)(s, &r);
    assert_int_equal(ask_within(&open, &err, s, 0, plenty), DYD_OK);
    if (open.pairs > 2) {
      /* faces may share pairs, which then are stored twice or more */
      size_t enough = open.pairs * open.faces;
      alone += open.faces == 1;
      assert_int_equal(ask_within(&again, &err, s, enough, plenty), DYD_OK);
      assert_int_equal(again.pairs, open.pairs);
      assert_int_equal(ask_within(&again, &err, s, open.pairs - 1, plenty), DYD_CAPPED);
      assert_int_equal(ask_within(&again, &err, s, 1, plenty), DYD_CAPPED);
      assert_int_equal(ask_within(&again, &err, s, 0, open.bytes), DYD_OK);
      assert_int_equal(ask_within(&again, &err, s, 0, open.bytes - 1), DYD_E_NOMEM);
      of_face += strstr(err.message, "the possible pairs of a face") != NULL;
      of_tie += strstr(err.message, "the pairs of a tie") != NULL;
    }
    dyd_sites_free(s);
  }
  print_message("%zu of one face, %zu refused by a face, %zu by a tie\n", alone, of_face, of_tie);
  assert_true(alone > test_cases(150) && of_face > test_cases(50) && of_tie > test_cases(50));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_bounds)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
