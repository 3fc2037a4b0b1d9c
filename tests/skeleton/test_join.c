/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Meshes joined from strips [JOIN-1]: every edge is checked with integers, links and counts as well; without ties they
 * have the edges of the mesh made at once; a mesh that met no exact zero has none. */
#include <setjmp.h>
#include <stdarg.h>

#include "rect/rect.h"
#include "skeleton/mesh_build.h"
#include "skeleton/mesh_filter.h"
#include "support/random.h"
#include <cmocka.h>
#include <string.h>

enum { MOST = 400 };

static test_random shared;
static size_t joined_meshes, stuck_meshes, tied_meshes, aliases_met;

typedef struct bed {
  dyd_sites *sites;
  dyd_reps reps;
  dyd_mesh m;
} bed;

static void bed_close(bed *b) {
  dyd_mesh_clear(&b->m);
  dyd_reps_clear(&b->reps);
  dyd_sites_free(b->sites);
}

/* Fractions that no double holds: all coordinates by den; where shifted, a seventh is added to y
 * in odd strips, and x is more by less than a double tells. */
static unsigned long den = 1;
static bool shifted;

/* x is more by k 2^-80 of itself. */
static void add_little(mpq_t x, unsigned long k) {
  mpq_t little;
  mpq_init(little);
  mpq_set_ui(little, k, 1);
  mpq_div_2exp(little, little, 80);
  mpq_mul(little, little, x);
  mpq_add(x, x, little);
  mpq_clear(little);
}

static void add_fractions(dyd_sites *sites, const double *x, const double *y, size_t n, const dyd_strips *strips) {
  mpq_t at[2], by, more;
  dyd_rect r;
  mpq_inits(at[0], at[1], by, more, NULL);
  dyd_rect_init(&r);
  mpq_set_ui(by, 1, den);
  mpq_set_ui(more, 1, 7);
  for (size_t v = 0, s = 0; v < n; v++) {
    while (v >= strips->begin[s + 1]) s++;
    mpq_set_d(at[0], x[v]);
    mpq_set_d(at[1], y[v]);
    for (int a = 0; a < 2; a++) mpq_mul(at[a], at[a], by);
    if (shifted && s % 2) mpq_add(at[1], at[1], more);
    if (shifted) add_little(at[0], v * 7 % 3);
    assert_int_equal(dyd_rect_set_q(&r, at[0], at[1]), DYD_OK);
    assert_int_equal(dyd_sites_add_rect(sites, &r), DYD_OK);
  }
  dyd_rect_clear(&r);
  mpq_clears(at[0], at[1], by, more, NULL);
}

/* apart: by strips, else at once. */
static void bed_make(bed *b, const double *x, const double *y, size_t n, const dyd_strips *strips, bool apart,
                     unsigned threads, bool no_filter) {
  uint32_t *site = malloc(n * sizeof *site);
  memset(b, 0, sizeof *b);
  assert_non_null(site);
  assert_int_equal(dyd_sites_new(&b->sites), DYD_OK);
  if (den == 1 && !shifted)
    assert_int_equal(dyd_sites_add_points(b->sites, n, x, y), DYD_OK);
  else
    add_fractions(b->sites, x, y, n, strips);
  for (uint32_t v = 0; v < n; v++) site[v] = v;
  assert_int_equal(dyd_reps_init(&b->reps, NULL, b->sites, site, (uint32_t)n, 1), DYD_OK);
  dyd_strips one = {1, {0, (uint32_t)n}};
  assert_int_equal(dyd_mesh_build_strips(&b->m, &b->reps, apart ? strips : &one, NULL, no_filter, NULL, threads),
                   DYD_OK);
}

static uint32_t alive(const dyd_mesh *m) {
  uint32_t n = 0;
  for (uint32_t v = 0; v < m->n; v++) n += dyd_mesh_alias(m, v) == DYD_NONE;
  return n;
}

static bool has_edge(const dyd_mesh *m, uint32_t v, uint32_t w) {
  for (uint32_t t = 0; t < m->count; t++)
    for (unsigned k = 0; k < 3; k++)
      if (m->tri[t].v[k] == v && m->tri[t].v[dyd_next(k)] == w) return true;
  return false;
}

/* Is there an edge whose two triangles are cocircular, or a hull vertex on the line of its neighbours? */
static bool has_tie(const dyd_mesh *m) {
  dyd_tally unused = {0};
  for (uint32_t t = 0; t < m->count; t++)
    for (unsigned k = 0; k < 3; k++) {
      const uint32_t *v = m->tri[t].v;
      dyd_half_edge twin = dyd_edge_twin(m, dyd_edge_of(t, k));
      uint32_t p = dyd_edge_apex(m, twin);
      bool here = dyd_is_ghost_triangle(m, t), there = dyd_is_ghost_triangle(m, dyd_edge_triangle(twin));
      if (here != there) continue;
      if (!here && dyd_mesh_incircle(&unused, m, v[0], v[1], v[2], p) == 0) return true;
      unsigned g = v[0] == m->n ? 0 : v[1] == m->n ? 1 : 2;
      if (here && v[k] != m->n && dyd_mesh_orient(&unused, m, v[dyd_next(g)], v[dyd_prev(g)], p) == 0) return true;
    }
  return false;
}

static void compare(bed *joined, bed *whole) {
  dyd_mesh *m = &joined->m, *w = &whole->m;
  assert_int_equal(m->collinear, w->collinear);
  if (m->collinear) return;
  assert_int_equal(m->count, 2 * alive(m) - 2);
  assert_int_equal(m->count, w->count);
  assert_true(dyd_mesh_is_valid(m));
  aliases_met += m->n - alive(m);
  for (uint32_t v = 0; v < m->n; v++) /* an alias refers to an equal vertex that is not an alias */
    if (dyd_mesh_alias(m, v) != DYD_NONE) {
      assert_int_equal(dyd_mesh_alias(m, dyd_mesh_alias(m, v)), DYD_NONE);
      assert_true(dyd_mesh_same(m, v, dyd_mesh_alias(m, v)));
    }
  if (m->tally.ties) {
    tied_meshes++;
    return;
  }
  assert_false(has_tie(m));
  if (m->n > 60) return;
  for (uint32_t t = 0; t < w->count; t++)
    for (unsigned k = 0; k < 3; k++) assert_true(has_edge(m, w->tri[t].v[k], w->tri[t].v[dyd_next(k)]));
}

/* The points are in the order of their strips; inside a strip in any order. */
static void check(const double *x, const double *y, size_t n, const dyd_strips *strips) {
  bed joined, whole;
  bool no_filter = test_below(&shared, 8) == 0;
  bed_make(&joined, x, y, n, strips, true, 1 + (unsigned)test_below(&shared, 3), no_filter);
  bed_make(&whole, x, y, n, strips, false, 1, no_filter);
  bool apart = dyd_strips_are_apart(&joined.reps, strips);
  bool made = joined.m.strips.count > 1;
  assert_true(apart || !made);
  joined_meshes += apart && made;
  stuck_meshes += apart && !made;
  compare(&joined, &whole);
  bed_close(&whole);
  bed_close(&joined);
}

typedef double place(size_t q, int axis);
static double scale, span;

static double on_grid(size_t q, int axis) {
  (void)q, (void)axis;
  return scale * (double)test_below(&shared, (uint64_t)span);
}
static double anywhere(size_t q, int axis) {
  (void)q, (void)axis;
  return scale * test_unit(&shared);
}
/* Integers on the left, and a last bit more or less on the right: the grid of one part is too coarse for the other. */
static double on_two_grains(size_t q, int axis) {
  static double x;
  (void)q;
  double c = 1 + (double)test_below(&shared, (uint64_t)span);
  if (axis == 0) return x = test_chance(&shared, 2) ? c : 64 + c;
  return x < 64 || test_chance(&shared, 2) ? c : c + (c < 8 ? 0x1p-50 : 0x1p-49) * (double)test_between(&shared, -1, 1);
}
/* One rectangle around x = 0 among points of no order: a single tie, across the seam if there is one near. */
static double on_rectangle(size_t q, int axis) {
  static const double corner[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  if (q < 4) return scale * corner[q][axis] * (axis ? span : 3);
  double x = (test_unit(&shared) * 2 - 1) * 8 * span;
  return scale * (x < 0 ? x - 4 * span : x + 4 * span);
}
/* On a parabola, cut at x = 0: all points are hull vertices, the seam runs through everything. */
static double on_curve(size_t q, int axis) {
  static double x;
  if (axis == 0) x = (double)test_below(&shared, 4 * (uint64_t)span) - 2 * span;
  (void)q;
  return scale * (axis == 0 ? x : x * x);
}

static int by_x(const void *a, const void *b) {
  const double *p = a, *q = b;
  return (p[0] > q[0]) - (p[0] < q[0]);
}

/* Cuts between different x only (one case in ten: anywhere, then the strips may not be apart). */
static dyd_strips cut(double (*p)[2], size_t n) {
  dyd_strips s = {1, {0}};
  unsigned want = 2 + (unsigned)test_below(&shared, n < 40 ? 2 : DYD_STRIPS - 1);
  bool careless = test_below(&shared, 10) == 0;
  for (size_t v = 4; v + 4 < n && s.count < want; v++)
    if (test_below(&shared, n) < 2 * want && (careless || p[v][0] > p[v - 1][0])) s.begin[s.count++] = (uint32_t)v;
  s.begin[s.count] = (uint32_t)n;
  return s;
}

static void shuffle(double (*p)[2], size_t n) {
  for (size_t v = n; v > 1; v--) {
    size_t w = test_below(&shared, v);
    double t[2];
    memcpy(t, p[v - 1], sizeof t);
    memcpy(p[v - 1], p[w], sizeof t);
    memcpy(p[w], t, sizeof t);
  }
}

static void one_case(place *where, size_t n) {
  static double p[MOST][2], x[MOST], y[MOST];
  for (size_t v = 0; v < n; v++)
    for (int a = 0; a < 2; a++) p[v][a] = where(v, a);
  qsort(p, n, sizeof *p, by_x);
  dyd_strips strips = cut(p, n);
  for (unsigned s = 0; s < strips.count; s++) shuffle(p + strips.begin[s], strips.begin[s + 1] - strips.begin[s]);
  for (size_t v = 0; v < n; v++) {
    x[v] = p[v][0];
    y[v] = p[v][1];
  }
  check(x, y, n, &strips);
}

static void run(place *where, size_t cases) {
  joined_meshes = stuck_meshes = tied_meshes = aliases_met = 0;
  for (size_t q = 0; q < test_cases_all(cases); q++) {
    static const double scales[] = {1, 0x1p-900, 0x1p600, 0x1p-30, 3};
    scale = scales[test_below(&shared, 5)];
    span = 2 + (double)test_below(&shared, 12);
    den = test_chance(&shared, 2) ? 1 : test_chance(&shared, 2) ? 3 : 1000000007;
    shifted = test_chance(&shared, 6);
    one_case(where, 3 + test_below(&shared, q % 16 == 0 ? MOST - 3 : 60));
  }
  print_message("# joined %zu, stuck %zu, tied %zu, aliases %zu\n", joined_meshes, stuck_meshes, tied_meshes,
                aliases_met);
  assert_true(joined_meshes > cases / 4);
}

static void test_grids(void **state) {
  (void)state;
  run(on_grid, 1500);
  assert_true(tied_meshes > 100 && aliases_met > 100);
}
static void test_scattered(void **state) {
  (void)state;
  run(anywhere, 800);
  assert_int_equal(tied_meshes, 0); /* a zero that is none costs a proof for every edge */
}
static void test_curves(void **state) {
  (void)state;
  run(on_curve, 1200);
}

static void test_grains(void **state) {
  (void)state;
  run(on_two_grains, 800);
}

static void test_single_ties(void **state) {
  (void)state;
  run(on_rectangle, 800);
  assert_true(tied_meshes > 300);
}

/* The same mesh, triangle by triangle, for every number of threads. */
static void test_threads(void **state) {
  (void)state;
  enum { N = 4000 };
  static double x[N], y[N];
  den = 1;
  shifted = false;
  dyd_strips strips = {DYD_STRIPS, {0}};
  for (unsigned s = 0; s < DYD_STRIPS; s++)
    for (uint32_t v = strips.begin[s] = s * N / DYD_STRIPS; v < (s + 1) * N / DYD_STRIPS; v++) {
      x[v] = s + (double)test_below(&shared, 30) / 32;
      y[v] = (double)test_below(&shared, 300) / 32;
    }
  strips.begin[DYD_STRIPS] = N;
  bed one, many;
  bed_make(&one, x, y, N, &strips, true, 1, false);
  for (unsigned threads = 2; threads < 9; threads += 3) {
    bed_make(&many, x, y, N, &strips, true, threads, false);
    assert_int_equal(one.m.count, many.m.count);
    assert_memory_equal(one.m.tri, many.m.tri, one.m.count * sizeof *one.m.tri);
    assert_memory_equal(one.m.alias, many.m.alias, N * sizeof *one.m.alias);
    assert_int_equal(one.m.tally.ties, many.m.tally.ties);
    dyd_mesh_trim(&many.m);
    if (threads == 2) dyd_mesh_trim(&one.m);
    assert_memory_equal(&one.m.tally, &many.m.tally, sizeof one.m.tally);
    bed_close(&many);
  }
  bed_close(&one);
}

int main(void) {
  shared = test_random_start("join");
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_grids),  cmocka_unit_test(test_scattered),
                                     cmocka_unit_test(test_curves), cmocka_unit_test(test_single_ties),
                                     cmocka_unit_test(test_grains), cmocka_unit_test(test_threads)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
