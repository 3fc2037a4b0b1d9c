/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [DISC-7] Polygons of cells of discs against their definition, place by place, for all other discs: on lattices, so
 * that discs touch, overlap and lie in each other; scaled; far from the origin; the same without the filter. */
#include <setjmp.h>
#include <stdarg.h>

#include "dyadic/raw.h"
#include "support/random.h"
#include "voronoi/shape.h"
#include <cmocka.h>
#include <math.h>
#include <mpfr.h>

enum { MOST = 7, PREC = 1024, ZERO = 900, GRID = 12, AROUND = 256 };

/* Numbers are doubles times 2^scale. */
typedef struct disc_cells {
  uint32_t n;
  int scale;
  bool fine;
  double x[MOST], y[MOST], r[MOST], w[4];
} disc_cells;

/* ---- the oracle: places are sums of two doubles, x, y, and what these lack; distances with 1024 bits, a difference
 * below 2^-900 of 1 is none ---- */

static void coordinate(mpfr_t out, const double z[4], int axis) {
  mpfr_set_d(out, z[axis], MPFR_RNDN);
  mpfr_add_d(out, out, z[axis + 2], MPFR_RNDN);
}

static void distance(mpfr_t out, const double z[4], double x, double y) {
  mpfr_t d;
  mpfr_init2(d, PREC);
  coordinate(out, z, 0);
  mpfr_sub_d(out, out, x, MPFR_RNDN);
  coordinate(d, z, 1);
  mpfr_sub_d(d, d, y, MPFR_RNDN);
  mpfr_hypot(out, out, d, MPFR_RNDN);
  mpfr_clear(d);
}

/* Sign of |z - c_i| + sign_i r_i - (|z - c_j| + sign_j r_j), both at least 0. */
static int compare(const disc_cells *c, const double z[4], uint32_t i, int sign_i, uint32_t j, int sign_j) {
  mpfr_t a, b;
  mpfr_inits2(PREC, a, b, (mpfr_ptr)0);
  distance(a, z, c->x[i], c->y[i]);
  distance(b, z, c->x[j], c->y[j]);
  mpfr_add_d(a, a, sign_i * c->r[i], MPFR_RNDN);
  mpfr_add_d(b, b, sign_j * c->r[j], MPFR_RNDN);
  if (mpfr_sgn(a) < 0) mpfr_set_zero(a, 1);
  if (mpfr_sgn(b) < 0) mpfr_set_zero(b, 1);
  mpfr_sub(a, a, b, MPFR_RNDN);
  int sign = mpfr_zero_p(a) || mpfr_get_exp(a) < -ZERO ? 0 : mpfr_sgn(a);
  mpfr_clears(a, b, (mpfr_ptr)0);
  return sign;
}

static bool in_certain(const disc_cells *c, const double z[4], uint32_t i) {
  for (uint32_t j = 0; j < c->n; j++)
    if (j != i && compare(c, z, i, 1, j, -1) >= 0) return false;
  return true;
}

static bool in_possible(const disc_cells *c, const double z[4], uint32_t i) {
  for (uint32_t j = 0; j < c->n; j++)
    if (j != i && compare(c, z, i, -1, j, 1) > 0) return false;
  return true;
}

/* ---- cases ---- */

static double coarse(test_random *r, double most, double steps) {
  return nearbyint(test_unit(r) * most * steps) / steps;
}

static void make_cells(disc_cells *c, test_random *r) {
  double grid = test_chance(r, 2) ? 8 : 64, size = grid * test_unit(r) / 2, off = test_chance(r, 6) ? 0x1p28 : 0;
  *c = (disc_cells){.n = 1 + (uint32_t)test_below(r, MOST),
                    .scale = test_chance(r, 4) ? 600 * (int)test_below(r, 3) - 600 : 0};
  for (uint32_t k = 0; k < c->n; k++) {
    c->x[k] = off + coarse(r, grid, 1);
    c->y[k] = coarse(r, grid, 1);
    c->r[k] = test_chance(r, 3) ? 0 : coarse(r, size, 4);
    for (uint32_t i = 0; i < k; i++) /* equal points are one */
      if (c->x[i] == c->x[k] && c->y[i] == c->y[k]) c->x[k] += 2 * grid + k;
  }
  double at[2] = {off + coarse(r, grid, 2), coarse(r, grid, 2)}, half = grid * ldexp(1, (int)test_below(r, 5) - 3);
  c->fine = test_chance(r, 2); /* ends of many digits: cutting may ask for coarser outer polygons */
  if (c->fine) half += ldexp((double)test_below(r, 1000), -44);
  for (int k = 0; k < 4; k++) c->w[k] = at[k >> 1] + (k & 1 ? half : -half);
}

static dyd_delaunay *triangulate_cells(dyd_sites **sites, const disc_cells *c, bool no_filter) {
  dyd_delaunay *pd;
  dyd_error err;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = no_filter};
  assert_int_equal(dyd_sites_new(sites), DYD_OK);
  for (uint32_t k = 0; k < c->n; k++) {
    double b[4] = {c->x[k] - c->r[k], c->x[k] + c->r[k], c->y[k] - c->r[k], c->y[k] + c->r[k]};
    for (int e = 0; e < 4; e++) b[e] = ldexp(b[e], c->scale);
    dyd_rect at;
    dyd_rect_init(&at);
    assert_int_equal(dyd_rect_set_d(&at, b[0], b[1], b[2], b[3]), DYD_OK);
    assert_int_equal(dyd_sites_add_rect(*sites, &at), DYD_OK);
    dyd_rect_clear(&at);
  }
  assert_int_equal(dyd_delaunay_new(&pd, *sites, &o, &err), DYD_OK);
  return pd;
}

/* ---- polygons in doubles, which hold these ---- */

typedef struct ring {
  size_t n;
  double (*z)[4];
} ring;

/* z[0] + z[2] is the number. */
static void two_doubles(double z[3], const dyd_dyadic *number, int scale) {
  dyd_dyadic rest, most;
  dyd_dyadic_init(&rest);
  dyd_dyadic_init(&most);
  assert_int_equal(dyd_dyadic_mul_2exp(&rest, number, -scale), DYD_OK);
  z[0] = dyd_dyadic_get_d(&rest, DYD_DOWN);
  assert_int_equal(dyd_dyadic_set_d(&most, z[0]), DYD_OK);
  assert_int_equal(dyd_dyadic_sub(&rest, &rest, &most), DYD_OK);
  assert_true(dyd_dyadic_is_double(&rest));
  z[2] = dyd_dyadic_get_d(&rest, DYD_DOWN);
  dyd_dyadic_clear(&most);
  dyd_dyadic_clear(&rest);
}

static ring ring_of(const dyd_polygon *p, int scale) {
  ring g = {p->count, calloc(p->count + 1, sizeof(double[4]))};
  assert_non_null(g.z);
  for (size_t k = 0; k < g.n; k++) {
    two_doubles(&g.z[k][0], &p->vertex[k].x, scale);
    two_doubles(&g.z[k][1], &p->vertex[k].y, scale);
  }
  return g;
}

/* Sign of the area of a, b, z. Exact. */
static int turn(const double a[4], const double b[4], const double z[4]) {
  mpfr_t d[4];
  for (int k = 0; k < 4; k++) {
    mpfr_init2(d[k], PREC);
    coordinate(d[k], k < 2 ? b : z, k & 1);
    mpfr_sub_d(d[k], d[k], a[k & 1], MPFR_RNDN);
    mpfr_sub_d(d[k], d[k], a[2 + (k & 1)], MPFR_RNDN);
  }
  mpfr_mul(d[0], d[0], d[3], MPFR_RNDN);
  mpfr_mul(d[1], d[1], d[2], MPFR_RNDN);
  int sign = mpfr_cmp(d[0], d[1]);
  for (int k = 0; k < 4; k++) mpfr_clear(d[k]);
  return (sign > 0) - (sign < 0);
}

/* How far z is from the closed polygon, about; 0 inside, exactly. */
static double from_ring(const ring *g, const double z[4]) {
  bool inside = false;
  double least = INFINITY;
  for (size_t k = 0; k < g->n; k++) {
    const double *a = g->z[k], *b = g->z[(k + 1) % g->n];
    double dx = b[0] - a[0], dy = b[1] - a[1], t = ((z[0] - a[0]) * dx + (z[1] - a[1]) * dy) / (dx * dx + dy * dy);
    t = fmin(fmax(t, 0), 1);
    if (t > 0 && t < 1 && turn(a, b, z) == 0) least = 0;
    least = fmin(least, hypot(z[0] - a[0] - t * dx, z[1] - a[1] - t * dy));
    if ((a[1] > z[1]) != (b[1] > z[1]) && (turn(a, b, z) > 0) == (b[1] > a[1])) inside = !inside;
  }
  return inside ? 0 : least;
}

static bool in_window(const disc_cells *c, const double z[4]) {
  for (int a = 0; a < 2; a++) {
    double hi = c->w[2 * a + 1];
    if (z[a] < c->w[2 * a] || z[a] > hi || (z[a] == hi && z[a + 2] > 0)) return false;
  }
  return true;
}

/* ---- checks ---- */

static void check_inner(const disc_cells *c, uint32_t i, const ring *in) {
  for (size_t k = 0; k < in->n; k++) {
    assert_true(in_window(c, in->z[k]));
    assert_true(in_certain(c, in->z[k], i));
    assert_true(turn(in->z[k], in->z[(k + 1) % in->n], in->z[(k + 2) % in->n]) >= 0);
  }
}

/* Is some place possible that is so far from z, or half as far? The one towards the centre comes first: Pos may be
 * thin. */
static bool possible_around(const disc_cells *c, uint32_t i, const double z[4], double far) {
  double ray = atan2(c->y[i] - z[1], c->x[i] - z[0]);
  for (int k = 0; k < 2 * AROUND; k++) {
    double angle = ray + 6.283185307179586 * (k >> 1) / AROUND, d = k & 1 ? far / 2 : far;
    double at[4] = {z[0] + d * cos(angle), z[1] + d * sin(angle)};
    if (in_possible(c, at, i)) return true;
  }
  return false;
}

static bool is_inside(const disc_cells *c, const double z[4]) {
  return c->w[0] < z[0] && z[0] < c->w[1] && c->w[2] < z[1] && z[1] < c->w[3];
}

/* Corners and middles of sides that are not on the border of the window. */
static void check_outer_is_near(const disc_cells *c, uint32_t i, const ring *out, double far) {
  for (size_t k = 0; k < out->n; k++) {
    const double *a = out->z[k], *b = out->z[(k + 1) % out->n];
    const double middle[4] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    if (is_inside(c, a)) assert_true(possible_around(c, i, a, far));
    if (is_inside(c, middle)) assert_true(possible_around(c, i, middle, far));
  }
}

/* Is all around z, so far, certain and in W? */
static bool certain_around(const disc_cells *c, uint32_t i, const double z[4], double far) {
  for (int k = 0; k < 4; k++) {
    double at[4] = {z[0] + (k == 0 ? far : k == 1 ? -far : 0), z[1] + (k == 2 ? far : k == 3 ? -far : 0)};
    if (!in_window(c, at) || !in_certain(c, at, i)) return false;
  }
  return true;
}

static void check_places(const disc_cells *c, uint32_t i, const ring *in, const ring *out, size_t outs, double far,
                         size_t *seen) {
  for (int k = 0; k < GRID * GRID; k++) {
    double z[4] = {0}, least = INFINITY;
    for (int a = 0; a < 2; a++)
      z[a] = c->w[2 * a] + (c->w[2 * a + 1] - c->w[2 * a]) * (a ? k / GRID : k % GRID) / (GRID - 1);
    for (size_t p = 0; p < outs; p++) least = fmin(least, from_ring(&out[p], z));
    if (in_possible(c, z, i)) assert_true(least == 0);
    bool deep = far > 0 && certain_around(c, i, z, 2 * far);
    if (deep) assert_true(in->n && from_ring(in, z) <= far);
    *seen += deep;
  }
}

static void check_cell(const disc_cells *c, const dyd_delaunay *pd, uint32_t i, dyd_shape *s, const dyd_window *w,
                       int64_t bits, size_t *seen) {
  dyd_polygon inner = {0};
  dyd_polygon_list outer = {0};
  assert_int_equal(dyd_shape_find(s, pd, i, w, bits), DYD_OK);
  assert_int_equal(dyd_shape_inner(&inner, s), DYD_OK);
  assert_int_equal(dyd_shape_outer(&outer, s), DYD_OK);
  ring in = ring_of(&inner, c->scale), *out = calloc(outer.count + 1, sizeof *out);
  double far = s->exact ? 0 : ldexp(1, -(int)bits - c->scale);
  for (size_t p = 0; p < outer.count; p++) out[p] = ring_of(&outer.item[p], c->scale);
  if (!s->exact) check_inner(c, i, &in);
  for (size_t p = 0; p < outer.count && far > 0 && !c->fine; p++) check_outer_is_near(c, i, &out[p], far);
  if (!s->exact) check_places(c, i, &in, out, outer.count, far, seen);
  for (size_t p = 0; p < outer.count; p++) free(out[p].z);
  free(out);
  free(in.z);
  dyd_polygon_clear(&inner);
  dyd_polygon_list_clear(&outer);
}

static bool polygons_are_equal(const dyd_polygon *p, const dyd_polygon *q) {
  bool equal = p->count == q->count;
  for (size_t k = 0; equal && k < p->count; k++)
    equal =
        dyd_dyadic_cmp(&p->vertex[k].x, &q->vertex[k].x) == 0 && dyd_dyadic_cmp(&p->vertex[k].y, &q->vertex[k].y) == 0;
  return equal;
}

static void check_discs(const disc_cells *c, int64_t bits, size_t *seen) {
  dyd_sites *sites[2];
  dyd_delaunay *pd[2];
  dyd_shape s[2] = {0};
  dyd_window w;
  dyd_rect rect;
  dyd_rect_init(&rect);
  double e[4];
  for (int k = 0; k < 4; k++) e[k] = ldexp(c->w[k], c->scale);
  assert_int_equal(dyd_rect_set_d(&rect, e[0], e[1], e[2], e[3]), DYD_OK);
  assert_int_equal(dyd_window_init(&w, &rect), DYD_OK);
  w.discs = true;
  for (int k = 0; k < 2; k++) pd[k] = triangulate_cells(&sites[k], c, k);
  for (uint32_t i = 0; i < c->n; i++) {
    check_cell(c, pd[0], i, &s[0], &w, bits - c->scale, seen);
    assert_int_equal(dyd_shape_find(&s[1], pd[1], i, &w, bits - c->scale), DYD_OK);
    if (s[0].exact) continue;
    assert_true(polygons_are_equal(&s[0].inner_exact, &s[1].inner_exact));
    assert_int_equal(s[0].outer_exact.count, s[1].outer_exact.count);
    for (size_t p = 0; p < s[0].outer_exact.count; p++)
      assert_true(polygons_are_equal(&s[0].outer_exact.item[p], &s[1].outer_exact.item[p]));
  }
  for (int k = 0; k < 2; k++) {
    dyd_shape_clear(&s[k]);
    dyd_delaunay_free(pd[k]);
    dyd_sites_free(sites[k]);
  }
  dyd_rect_clear(&rect);
}

static void test_disc_cells(void **state) {
  (void)state;
  test_random r = test_random_start("cells of discs");
  size_t seen = 0;
  for (size_t k = 0; k < test_cases(150); k++) {
    disc_cells c;
    make_cells(&c, &r);
    check_discs(&c, (int64_t)test_below(&r, 9) - 2, &seen);
  }
  assert_true(seen > 1000);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_disc_cells)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
