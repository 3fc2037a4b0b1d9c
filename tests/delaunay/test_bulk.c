/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Hundreds of sites with integer corners: exact points against the definition, rectangles against choices, and
 * refinement from the one to the other [POS-1] [LEG-1] [CLO-1] [TIE-1] [WIT-NEAR] [WIT-HULL] [FLT-STAR] [FLT-ORI]
 * [FLT-INC] [FLT-SMALL] [FIX-1]. */
#include <setjmp.h>
#include <stdarg.h>

#include "oracle/oracle_lattice.h"
#include "support/random.h"
#include <dyadel/delaunay.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#define BULK_MAX 256

/* Rectangle k is lo[k] .. hi[k]. */
typedef struct bulk {
  size_t n;
  orc_lattice *lo, *hi, *choice;
  uint32_t *every;
} bulk;

static bulk bulk_new(size_t n) {
  bulk b = {n, calloc(n, sizeof *b.lo), calloc(n, sizeof *b.hi), calloc(n, sizeof *b.choice), calloc(n, 4)};
  assert_true(b.lo && b.hi && b.choice && b.every);
  for (size_t k = 0; k < n; k++) b.every[k] = (uint32_t)k;
  return b;
}

static void bulk_free(bulk *b) {
  free(b->lo);
  free(b->hi);
  free(b->choice);
  free(b->every);
}

/* Lower corners in [0,grid]^2, sides up to `side`; one in `fat` is ten times as large. */
static void fill(bulk *b, test_random *r, int64_t grid, int64_t side, unsigned fat) {
  for (size_t k = 0; k < b->n; k++) {
    int64_t most = fat && test_chance(r, fat) ? 10 * side : side;
    b->lo[k] = (orc_lattice){(int32_t)test_between(r, 0, grid), (int32_t)test_between(r, 0, grid)};
    b->hi[k] =
        (orc_lattice){b->lo[k].x + (int32_t)test_between(r, 0, most), b->lo[k].y + (int32_t)test_between(r, 0, most)};
  }
}

static void choose(bulk *b, test_random *r) {
  for (size_t k = 0; k < b->n; k++) {
    b->choice[k].x = (int32_t)test_between(r, b->lo[k].x, b->hi[k].x);
    b->choice[k].y = (int32_t)test_between(r, b->lo[k].y, b->hi[k].y);
  }
}

static dyd_sites *bulk_sites(const bulk *b) {
  dyd_sites *s = NULL;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (size_t k = 0; k < b->n; k++) {
    double x0 = b->lo[k].x, x1 = b->hi[k].x, y0 = b->lo[k].y, y1 = b->hi[k].y;
    assert_int_equal(dyd_sites_add_boxes(s, 1, &x0, &x1, &y0, &y1), DYD_OK);
  }
  return s;
}

static void set_site(dyd_sites *s, uint32_t k, orc_lattice lo, orc_lattice hi) {
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(dyd_rect_set_d(&r, lo.x, hi.x, lo.y, hi.y), DYD_OK);
  assert_int_equal(dyd_sites_narrow(s, k, &r), DYD_OK);
  dyd_rect_clear(&r);
}

static void complain(const bulk *b, size_t i, size_t j, int is, int want) {
  for (size_t k = 0; k < b->n; k++)
    fprintf(stderr, "[%d,%d] [%d,%d]   # %zu, choice %d %d\n", b->lo[k].x, b->hi[k].x, b->lo[k].y, b->hi[k].y, k,
            b->choice[k].x, b->choice[k].y);
  fail_msg("pair %zu %zu: engine %d, choice %d", i, j, is, want);
}

static bool same_place(orc_lattice a, orc_lattice b) {
  return a.x == b.x && a.y == b.y;
}

/* Every pair of the choice. `exact`: the sites are the points of the choice. Aliases are excluded: they would hide
 * strictness. */
static void check_choice(const bulk *b, const dyd_delaunay *pd, bool exact) {
  orc_lattice point[BULK_MAX];
  uint32_t place[BULK_MAX];
  size_t n = 0;
  for (uint32_t k = 0; k < b->n; k++) {
    place[k] = (uint32_t)n;
    if (dyd_delaunay_alias(pd, k) == k) point[n++] = b->choice[k];
  }
  for (uint32_t i = 0; i < b->n; i++)
    for (uint32_t j = i + 1; j < b->n; j++) {
      dyd_pair_status is = dyd_delaunay_status(pd, i, j);
      if ((is == DYD_INDETERMINATE && !exact) || same_place(b->choice[i], b->choice[j])) continue;
      if (dyd_delaunay_alias(pd, i) != i || dyd_delaunay_alias(pd, j) != j) continue;
      int want = orc_lattice_status(point, n, place[i], place[j]);
      bool good = (is == DYD_LEGAL) == (want == 3) && (is == DYD_ILLEGAL) == (want == 0);
      if (!exact) good = is == DYD_LEGAL ? want == 3 : is != DYD_ILLEGAL || want == 0;
      if (!good) complain(b, i, j, (int)is, want);
    }
}

/* Leaves each place of the choice once. Returns how many points are left. */
static size_t drop_repeats(bulk *b) {
  size_t n = 0;
  for (size_t k = 0; k < b->n; k++) {
    bool fresh = true;
    for (size_t m = 0; m < n && fresh; m++) fresh = !same_place(b->choice[m], b->choice[k]);
    if (fresh) b->lo[n] = b->hi[n] = b->choice[n] = b->choice[k], n++;
  }
  return n;
}

static void test_points(void **state) {
  (void)state;
  test_random r = test_random_start("bulk points");
  for (size_t k = 0; k < test_cases(12); k++) {
    static const int64_t grid[4] = {10, 18, 60, LATTICE_MAX};
    bulk b = bulk_new((size_t)test_between(&r, 100, 250));
    fill(&b, &r, grid[k % 4], 0, 0);
    choose(&b, &r);
    b.n = drop_repeats(&b);
    dyd_sites *s = bulk_sites(&b);
    dyd_delaunay *pd = NULL;
    dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = k % 5 == 0};
    assert_int_equal(dyd_delaunay_new(&pd, s, &o, NULL), DYD_OK);
    check_choice(&b, pd, true);
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
    bulk_free(&b);
  }
}

/* Choices never refute; halving towards a choice; at the end, that choice. */
static void shrink_to_choice(bulk *b, test_random *r, dyd_sites *s, dyd_delaunay *pd) {
  for (size_t step = 0; step < 4; step++) {
    size_t count = 0;
    for (uint32_t k = 0; k < b->n; k++) {
      if (step < 3 && !test_chance(r, 3)) continue;
      orc_lattice c = b->choice[k];
      b->lo[k].x = step == 3 ? c.x : c.x - (c.x - b->lo[k].x) / 2;
      b->lo[k].y = step == 3 ? c.y : c.y - (c.y - b->lo[k].y) / 2;
      b->hi[k].x = step == 3 ? c.x : c.x + (b->hi[k].x - c.x) / 2;
      b->hi[k].y = step == 3 ? c.y : c.y + (b->hi[k].y - c.y) / 2;
      set_site(s, k, b->lo[k], b->hi[k]);
      b->every[count++] = k;
    }
    assert_int_equal(dyd_delaunay_update(pd, b->every, count, NULL, NULL), DYD_OK);
    check_choice(b, pd, false);
  }
}

static bool repeats(const bulk *b) {
  for (size_t i = 0; i < b->n; i++)
    for (size_t j = 0; j < i; j++)
      if (same_place(b->choice[i], b->choice[j])) return true;
  return false;
}

/* Two engines on the same sites, pair by pair. */
static void check_same(const bulk *b, const dyd_sites *s, const dyd_delaunay *pd, bool no_filter, unsigned threads) {
  dyd_delaunay *other = NULL;
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = no_filter, .threads = threads};
  assert_int_equal(dyd_delaunay_new(&other, s, &o, NULL), DYD_OK);
  for (uint32_t i = 0; i < b->n; i++)
    for (uint32_t j = i + 1; j < b->n; j++) {
      dyd_pair_status x = dyd_delaunay_status(pd, i, j), y = dyd_delaunay_status(other, i, j);
      if (x != y) complain(b, i, j, (int)x, (int)y);
    }
  dyd_delaunay_free(other);
}

static int triangle_compare(const void *a, const void *b) {
  return memcmp(a, b, sizeof(dyd_triangle));
}

/* The number of t in a list sorted by the bytes. */
static uint32_t number_in(const dyd_triangle_list *l, dyd_triangle t) {
  const dyd_triangle *found = bsearch(&t, l->item, l->count, sizeof t, triangle_compare);
  assert_non_null(found);
  return (uint32_t)(found - l->item);
}

/* Sorted or as found, the triangles and the sites beyond their sides are the same. */
static void check_triangles(const dyd_delaunay *pd) {
  dyd_triangle_list sorted = {0}, beyond = {0}, found = {0}, behind = {0}, names = {0};
  assert_int_equal(DYD_OK, dyd_delaunay_triangles(&sorted, &beyond, pd, 0));
  assert_int_equal(DYD_OK, dyd_delaunay_triangles(&found, &behind, pd, DYD_TRIANGLES_AS_FOUND));
  assert_int_equal(DYD_OK, dyd_delaunay_triangles(&names, NULL, pd, 0));
  assert_int_equal(sorted.count, found.count);
  assert_int_equal(sorted.count, behind.count);
  qsort(names.item, names.count, sizeof *names.item, triangle_compare);
  uint32_t *place = calloc(sorted.count + 1, sizeof *place); /* by name: in the sorted list */
  for (uint32_t t = 0; t < sorted.count; t++) place[number_in(&names, sorted.item[t])] = t;
  for (uint32_t t = 0; t < found.count; t++) {
    uint32_t same = place[number_in(&names, found.item[t])];
    for (int k = 0; k < 3; k++) {
      uint32_t next = behind.item[t].v[k];
      uint32_t want = next == DYD_NO_TRIANGLE ? next : place[number_in(&names, found.item[next])];
      assert_int_equal(beyond.item[same].v[k], want);
    }
  }
  free(place);
  dyd_triangle_list_clear(&names);
  dyd_triangle_list_clear(&behind);
  dyd_triangle_list_clear(&found);
  dyd_triangle_list_clear(&beyond);
  dyd_triangle_list_clear(&sorted);
}

static void run_rectangles(test_random *r, size_t n, int64_t grid, int64_t side, unsigned fat) {
  bulk b = bulk_new(n);
  dyd_delaunay *pd = NULL;
  fill(&b, r, grid, side, fat);
  dyd_sites *s = bulk_sites(&b);
  assert_int_equal(dyd_delaunay_new(&pd, s, NULL, NULL), DYD_OK);
  for (size_t k = 0; k < 6; k++) {
    choose(&b, r);
    check_choice(&b, pd, false);
  }
  check_same(&b, s, pd, true, 1);
  check_same(&b, s, pd, false, 3);
  check_triangles(pd);
  shrink_to_choice(&b, r, s, pd);
  if (!repeats(&b)) check_choice(&b, pd, true);
  check_same(&b, s, pd, false, 1);
  check_triangles(pd);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  bulk_free(&b);
}

static void test_rectangles(void **state) {
  (void)state;
  test_random r = test_random_start("bulk rectangles");
  for (size_t k = 0; k < test_cases(3); k++) {
    run_rectangles(&r, 120, 3000, 20, 0);
    run_rectangles(&r, 120, 3000, 100, 0);
    run_rectangles(&r, 90, 1000, 16, 12);
    run_rectangles(&r, 60, 300, 60, 0);
    run_rectangles(&r, 100, 40, 2, 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_points), cmocka_unit_test(test_rectangles)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
