/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [OUTLINE-1] The polygons found from boundaries in doubles are those of the exact rung, number by number: vertices in
 * the same order, areas; where a rounding was in doubt they are as near to those as two moves of a vertex, inner
 * corners are in the cell, and edges of outer ones certainly nearer to another site. Rectangles of doubles and of
 * decimals that no double holds, points among them, on a lattice with ties, apart, touching and overlapping; equal
 * squares on a grid, where curves cross on the borders of panes, every other row shifted by half in some; windows
 * anywhere, some of no doubles. */
#include <setjmp.h>
#include <stdarg.h>

#include "predicate/circle.h"
#include "rect/rect.h"
#include "stream/real.h"
#include "support/random.h"
#include "voronoi/sample.h"
#include "voronoi/shape.h"
#include <cmocka.h>
#include <dyadel/stream.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LATTICE, GRID, DOUBLES, DECIMALS, MIXED, KINDS, MOST = 60 };

static size_t cells[KINDS], done[KINDS], loose[KINDS], corners;

/* ---- cases ---- */

static int64_t whole(test_random *r, int64_t most) {
  return test_between(r, 0, most);
}

/* [x - w, x + w], in units of 2^-20 or of a millionth. */
static void set_side(dyd_interval *out, int64_t x, int64_t w, bool decimal) {
  char text[80];
  if (!decimal) {
    assert_int_equal(dyd_interval_set_d(out, ldexp((double)(x - w), -20), ldexp((double)(x + w), -20)), DYD_OK);
    return;
  }
  int length = snprintf(text, sizeof text, "[%llde-6,%llde-6]", (long long)(x - w), (long long)(x + w));
  assert_int_equal(dyd_interval_set_text(out, text, (size_t)length, NULL), DYD_OK);
}

/* Half-widths of a share of the spacing: 0, small, touching now and then, overlapping. */
static void make_rect(dyd_rect *out, test_random *r, size_t kind, int64_t size, unsigned number) {
  static const double share[] = {0, 0x1p-20, 0.05, 0.1, 0.3, 0.6};
  int64_t most = kind == LATTICE ? 24 : 1000000007, spacing = most / 6;
  bool decimal = kind == DECIMALS || kind == MIXED;
  int64_t w[2];
  if (kind == GRID) {
    int64_t row = number / 7, column = number % 7, shift = size < 3 ? 0 : 2 * (row & 1);
    set_side(&out->x, 4 * column + shift, size % 3, false);
    set_side(&out->y, 4 * row, size % 3, false);
    return;
  }
  for (int k = 0; k < 2; k++) {
    int64_t one = kind == MIXED ? (int64_t)test_below(r, 6) : size;
    w[k] = kind == LATTICE ? (int64_t)test_below(r, (uint64_t)size + 1) : (int64_t)(share[one] * (double)spacing);
  }
  if (kind != LATTICE && test_chance(r, 3)) w[1] = w[0];
  set_side(&out->x, whole(r, most), w[0], decimal);
  set_side(&out->y, whole(r, most), w[1], decimal);
}

static void make_window(dyd_rect *out, test_random *r, size_t kind) {
  double size = kind <= GRID ? 24 * 0x1p-20 : kind == DOUBLES ? 954 : 1000, x = size / 2, y = size / 2;
  double half = size * ldexp(1, 1 - (int)test_below(r, 4));
  if (test_chance(r, 2)) x += size * (test_unit(r) - 0.5), y += size * (test_unit(r) - 0.5);
  if (test_chance(r, 3)) x = floor(x), y = floor(y), half = ceil(half);
  assert_int_equal(dyd_rect_set_d(out, x - half, x + half, y - half, y + half), DYD_OK);
  if (!test_chance(r, 5)) return;
  dyd_dyadic little; /* an end that is no double */
  dyd_dyadic_init(&little);
  assert_int_equal(dyd_dyadic_set_si_2exp(&little, 1, -80), DYD_OK);
  assert_int_equal(dyd_dyadic_add(&out->x.hi, &out->x.hi, &little), DYD_OK);
  dyd_dyadic_clear(&little);
}

/* ---- comparison ---- */

static void same_polygon(const dyd_polygon *a, const dyd_polygon *b) {
  assert_int_equal(a->count, b->count);
  for (size_t k = 0; k < a->count; k++) {
    assert_int_equal(dyd_dyadic_cmp(&a->vertex[k].x, &b->vertex[k].x), 0);
    assert_int_equal(dyd_dyadic_cmp(&a->vertex[k].y, &b->vertex[k].y), 0);
    corners++;
  }
}

static void same_area(const dyd_shape *s, bool outer, const dyd_polygon *p) {
  dyd_dyadic a, b;
  dyd_dyadic_init(&a);
  dyd_dyadic_init(&b);
  assert_int_equal(dyd_shape_area2(&a, s, outer), DYD_OK);
  if (p) assert_int_equal(dyd_polygon_area2(&b, p), DYD_OK);
  assert_int_equal(dyd_dyadic_cmp(&a, &b), 0);
  dyd_dyadic_clear(&b);
  dyd_dyadic_clear(&a);
}

/* ---- where a rounding was in doubt ---- */

static void take_point(mpq_t out[2], const dyd_point *z) {
  dyd_dyadic_get_q(out[0], &z->x);
  dyd_dyadic_get_q(out[1], &z->y);
}

/* Squared distance of z to the segment from a to b is at most most2. */
static bool is_beside(mpq_t z[2], mpq_t a[2], mpq_t b[2], const mpq_t most2) {
  mpq_t d[2], e[2], t, s, n;
  mpq_inits(d[0], d[1], e[0], e[1], t, s, n, NULL);
  for (int k = 0; k < 2; k++) {
    mpq_sub(d[k], b[k], a[k]);
    mpq_sub(e[k], z[k], a[k]);
    mpq_mul(s, d[k], d[k]);
    mpq_add(n, n, s);
    mpq_mul(s, d[k], e[k]);
    mpq_add(t, t, s);
  }
  if (mpq_sgn(n)) mpq_div(t, t, n);
  if (mpq_sgn(t) < 0) mpq_set_ui(t, 0, 1);
  if (mpq_cmp_ui(t, 1, 1) > 0) mpq_set_ui(t, 1, 1);
  mpq_set_ui(n, 0, 1);
  for (int k = 0; k < 2; k++) {
    mpq_mul(d[k], d[k], t);
    mpq_sub(e[k], e[k], d[k]);
    mpq_mul(s, e[k], e[k]);
    mpq_add(n, n, s);
  }
  bool near = mpq_cmp(n, most2) <= 0;
  mpq_clears(d[0], d[1], e[0], e[1], t, s, n, NULL);
  return near;
}

/* Each corner of p is within 2^-bits of the boundary of q. */
static void near_polygon(const dyd_polygon *p, const dyd_polygon *q, long bits) {
  mpq_t z[2], a[2], b[2], most2;
  mpq_inits(z[0], z[1], a[0], a[1], b[0], b[1], most2, NULL);
  mpq_set_ui(most2, 1, 1);
  if (bits > 0)
    mpq_div_2exp(most2, most2, (mp_bitcnt_t)(2 * bits));
  else
    mpq_mul_2exp(most2, most2, (mp_bitcnt_t)(-2 * bits));
  for (size_t k = 0; k < p->count; k++) {
    bool near = false;
    take_point(z, &p->vertex[k]);
    for (size_t m = 0; m < q->count && !near; m++) {
      take_point(a, &q->vertex[m]);
      take_point(b, &q->vertex[(m + 1) % q->count]);
      near = is_beside(z, a, b, most2);
    }
    assert_true(near);
    corners++;
  }
  mpq_clears(z[0], z[1], a[0], a[1], b[0], b[1], most2, NULL);
}

/* Is one site certainly nearer than i at both? */
static bool is_beyond(const dyd_delaunay *pd, uint32_t i, const dyd_point *z, const dyd_point *next) {
  const dyd_sites *s = dyd_delaunay_sites(pd);
  dyd_rect own, other;
  bool found = false;
  dyd_rect_init(&own);
  dyd_rect_init(&other);
  assert_int_equal(dyd_sites_get(&own, s, i), DYD_OK);
  for (size_t k = 0; k < dyd_sites_count(s) && !found; k++) {
    assert_int_equal(dyd_sites_get(&other, s, k), DYD_OK);
    found = k != i && dyd_nearer(z, &other, &own) == DYD_TRUE && dyd_nearer(next, &other, &own) == DYD_TRUE;
  }
  dyd_rect_clear(&other);
  dyd_rect_clear(&own);
  return found;
}

/* Are both beyond one side of the window, or on it? */
static bool is_outside(const dyd_rect *w, const dyd_point *z, const dyd_point *next) {
  const dyd_dyadic *side[4] = {&w->x.lo, &w->x.hi, &w->y.lo, &w->y.hi};
  for (int k = 0; k < 4; k++) {
    const dyd_dyadic *a = k < 2 ? &z->x : &z->y, *b = k < 2 ? &next->x : &next->y;
    int sign = k & 1 ? -1 : 1;
    if (sign * dyd_dyadic_cmp(a, side[k]) <= 0 && sign * dyd_dyadic_cmp(b, side[k]) <= 0) return true;
  }
  return false;
}

static void check_loose(const dyd_polygon *inner, const dyd_polygon_list *outer, const dyd_delaunay *pd, uint32_t i,
                        const dyd_window *w) {
  dyd_cell_sites s;
  assert_int_equal(dyd_cell_sites_init(&s, pd, i, DYD_TIE), DYD_OK);
  assert_int_equal(dyd_cell_sites_enclose(&s), DYD_OK);
  for (size_t k = 0; k < inner->count; k++) {
    assert_true(dyd_rect_holds(w->rect, &inner->vertex[k]));
    assert_true(dyd_cell_holds(&s, &inner->vertex[k]));
  }
  dyd_cell_sites_clear(&s);
  for (size_t p = 0; p < outer->count; p++)
    for (size_t k = 0; k < outer->item[p].count; k++) {
      const dyd_point *z = &outer->item[p].vertex[k], *next = &outer->item[p].vertex[(k + 1) % outer->item[p].count];
      assert_true(is_outside(w->rect, z, next) || is_beyond(pd, i, z, next));
    }
}

static void check_cell(size_t kind, dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w, long bits) {
  dyd_polygon inner = {0}, copy = {0};
  dyd_polygon_list outer = {0}, copies = {0}, whole = {0};
  bool found;
  assert_int_equal(dyd_filter_polygons(&found, s, pd, i, w, bits), DYD_OK);
  if (found && s->loose) assert_int_equal(dyd_shape_outer(&whole, s), DYD_OK);
  if (found) assert_int_equal(dyd_shape_clip(&found, s, w, bits), DYD_OK);
  cells[kind]++;
  done[kind] += found;
  if (!found) {
    dyd_polygon_list_clear(&whole);
    return;
  }
  assert_int_equal(dyd_exact_polygons(&inner, &outer, pd, i, w, bits), DYD_OK);
  assert_int_equal(dyd_shape_inner(&copy, s), DYD_OK);
  assert_int_equal(dyd_shape_outer(&copies, s), DYD_OK);
  loose[kind] += s->loose;
  bool paired =
      outer.count == copies.count; /* rounding may leave a sliver of a cell that touches the window, or none */
  assert_true(paired || s->loose);
  if (s->loose) {
    check_loose(&copy, &whole, pd, i, w);
    near_polygon(&copy, &inner, bits - 1);
    near_polygon(&inner, &copy, bits - 1);
    for (size_t k = 0; paired && k < outer.count; k++) near_polygon(&copies.item[k], &outer.item[k], bits - 1);
    for (size_t k = 0; paired && k < outer.count; k++) near_polygon(&outer.item[k], &copies.item[k], bits - 1);
  } else {
    same_polygon(&inner, &copy);
    for (size_t k = 0; k < outer.count; k++) same_polygon(&outer.item[k], &copies.item[k]);
  }
  same_area(s, false, &copy);
  if (copies.count < 2) same_area(s, true, copies.count ? &copies.item[0] : NULL);
  dyd_polygon_list_clear(&whole);
  dyd_polygon_list_clear(&copies);
  dyd_polygon_list_clear(&outer);
  dyd_polygon_clear(&copy);
  dyd_polygon_clear(&inner);
  dyd_polygon_list_clear(&s->outer_exact); /* of the cut parts; the shape is used again */
  dyd_polygon_clear(&s->inner_exact);
}

static void check_case(test_random *r, size_t kind) {
  unsigned n = (unsigned)test_between(r, 3, MOST);
  int64_t size = (int64_t)test_below(r, kind == LATTICE ? 3 : 6);
  dyd_rect rect;
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_shape shape = {0};
  dyd_window w;
  dyd_rect_init(&rect);
  assert_int_equal(dyd_sites_new(&sites), DYD_OK);
  for (unsigned k = 0; k < n; k++) {
    make_rect(&rect, r, kind, size, k);
    assert_int_equal(dyd_sites_add_rect(sites, &rect), DYD_OK);
  }
  assert_int_equal(dyd_delaunay_new(&pd, sites, NULL, NULL), DYD_OK);
  for (int times = 0; times < 12; times++) {
    uint32_t i = (uint32_t)test_below(r, n);
    make_window(&rect, r, kind);
    assert_int_equal(dyd_window_init(&w, &rect), DYD_OK);
    long coarse = kind <= GRID ? 16 : -8;
    if (dyd_delaunay_alias(pd, i) == i) check_cell(kind, &shape, pd, i, &w, coarse + (long)test_below(r, 10));
  }
  dyd_shape_clear(&shape);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  dyd_rect_clear(&rect);
}

static void same_as_exact(void **state) {
  (void)state;
  test_random r = test_random_start("polygon filter");
  for (size_t k = 0; k < test_cases(160); k++) check_case(&r, k % KINDS);
  for (size_t k = 0; k < KINDS; k++)
    fprintf(stderr, "# kind %zu: %zu of %zu cells, %zu loose\n", k, done[k], cells[k], loose[k]);
  fprintf(stderr, "# %zu corners\n", corners);
  assert_true(10 * done[DOUBLES] > 7 * cells[DOUBLES] && 10 * done[DECIMALS] > 7 * cells[DECIMALS] &&
              10 * done[MIXED] > 7 * cells[MIXED] && 3 * done[GRID] > cells[GRID] && done[LATTICE] > 0);
}

/* ---- simple or not: small lattices, where much touches ---- */

static long turn_of(const long a[2], const long b[2], const long c[2]) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* z, on the line through a and b, is between them, or one of them. */
static bool is_between(const long z[2], const long a[2], const long b[2]) {
  return (z[0] - a[0]) * (z[0] - b[0]) + (z[1] - a[1]) * (z[1] - b[1]) <= 0;
}

static bool edges_meet(const long a[2], const long b[2], const long c[2], const long d[2]) {
  long s = turn_of(a, b, c), t = turn_of(a, b, d), u = turn_of(c, d, a), v = turn_of(c, d, b);
  if (((s > 0 && t < 0) || (s < 0 && t > 0)) && ((u > 0 && v < 0) || (u < 0 && v > 0))) return true;
  return (!s && is_between(c, a, b)) || (!t && is_between(d, a, b)) || (!u && is_between(a, c, d)) ||
         (!v && is_between(b, c, d));
}

/* No vertex is that before it. */
static bool simple_by_all_pairs(long z[][2], size_t n) {
  for (size_t i = 0; i < n; i++) {
    long *a = z[i], *b = z[(i + 1) % n], *c = z[(i + 2) % n];
    if (!turn_of(a, b, c) && is_between(c, a, b)) return false;
    if (!turn_of(a, b, c) && is_between(a, b, c)) return false;
    for (size_t j = i + 2; j < n; j++)
      if (!(i == 0 && j + 1 == n) && edges_meet(a, b, z[j], z[(j + 1) % n])) return false;
  }
  return n >= 3;
}

static void simple_as_by_all_pairs(void **state) {
  (void)state;
  enum { MOST_CORNERS = 9 };
  test_random r = test_random_start("simple polygons");
  size_t simple = 0, all = 20 * test_cases(1000);
  for (size_t times = 0; times < all; times++) {
    size_t n = (size_t)test_between(&r, 3, MOST_CORNERS);
    long z[MOST_CORNERS][2];
    bool found;
    dyd_polygon p = {0};
    p.vertex = calloc(n, sizeof *p.vertex);
    assert_non_null(p.vertex);
    for (; p.count < n; p.count++) {
      dyd_point *v = &p.vertex[p.count];
      do
        for (int k = 0; k < 2; k++) z[p.count][k] = (long)test_below(&r, 5);
      while ((p.count && !memcmp(z[p.count], z[p.count - 1], sizeof *z)) ||
             (p.count + 1 == n && !memcmp(z[p.count], z[0], sizeof *z)));
      dyd_point_init(v);
      assert_int_equal(dyd_dyadic_set_si_2exp(&v->x, z[p.count][0], -3), DYD_OK);
      assert_int_equal(dyd_dyadic_set_si_2exp(&v->y, z[p.count][1], 40), DYD_OK);
    }
    assert_int_equal(dyd_polygon_is_simple(&found, &p, NULL), DYD_OK);
    assert_int_equal(found, simple_by_all_pairs(z, n));
    simple += found;
    dyd_polygon_clear(&p);
  }
  assert_true(20 * simple > all && 20 * simple < 19 * all);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(same_as_exact), cmocka_unit_test(simple_as_by_all_pairs)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
