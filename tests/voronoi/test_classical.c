/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact points: the polygons of the cells meet the cells of the classical diagram, and their areas add up to the
 * window.
 *
 * A cell's exact area is found by cutting the window by the half-planes of all other points, in rationals. With m bits
 * the polygons lie within 2^-m of a cell, so the areas differ by about its girth times 2^-m: m = 56 leaves 2^-40 and
 * more on windows here. Citations: [POLY-1] [POLY-2]. */
#include <setjmp.h>
#include <stdarg.h>

#include "oracle/oracle_num.h"
#include "support/random.h"
#include "voronoi/shape.h"
#include <cmocka.h>
#include <dyadel/voronoi.h>
#include <stdlib.h>
#include <string.h>

enum { BITS = 56, WANTED = 40, RING = 64 };

static const char *airports;
static size_t compared;

typedef struct xy {
  mpq_srcptr x, y;
} xy;

/* Points and a window with doubles as coordinates. */
typedef struct cloud {
  size_t n;
  double *x, *y, window[4];
} cloud;

static mpq_srcptr of_double(orc_pool *p, double d) {
  mpq_ptr q = orc_new(p);
  mpq_set_d(q, d);
  return q;
}

/* ---- the classical cell ---- */

/* |z-v|^2 - |z-u|^2 = 2 z.(u-v) + |v|^2 - |u|^2, so >= 0 where u is the nearer one. */
static mpq_srcptr nearer(orc_pool *p, xy z, xy u, xy v) {
  mpq_srcptr vx = orc_sqr(p, orc_sub(p, z.x, v.x)), vy = orc_sqr(p, orc_sub(p, z.y, v.y)),
             ux = orc_sqr(p, orc_sub(p, z.x, u.x)), uy = orc_sqr(p, orc_sub(p, z.y, u.y));
  return orc_sub(p, orc_add(p, vx, vy), orc_add(p, ux, uy));
}

/* The corners of `in` (n of them) nearer to u than to v, and where the border crosses sides. */
static size_t cut(orc_pool *p, xy *out, const xy *in, size_t n, xy u, xy v) {
  mpq_srcptr f[RING];
  size_t kept = 0;
  bool whole = true;
  for (size_t k = 0; k < n; k++) {
    f[k] = nearer(p, in[k], u, v);
    whole = whole && mpq_sgn(f[k]) >= 0;
  }
  if (whole) return SIZE_MAX;
  for (size_t k = 0; k < n; k++) {
    xy a = in[k], b = in[(k + 1) % n];
    mpq_srcptr fa = f[k], fb = f[(k + 1) % n];
    assert_true(kept + 2 < RING);
    if (mpq_sgn(fa) >= 0) out[kept++] = a;
    if (mpq_sgn(fa) * mpq_sgn(fb) >= 0) continue;
    mpq_srcptr t = orc_div(p, fa, orc_sub(p, fa, fb));
    out[kept++] = (xy){orc_add(p, a.x, orc_mul(p, t, orc_sub(p, b.x, a.x))),
                       orc_add(p, a.y, orc_mul(p, t, orc_sub(p, b.y, a.y)))};
  }
  return kept;
}

/* Twice the area of the cell of point i on the window; all other points are examined. */
static mpq_srcptr cell_area2(orc_pool *p, const cloud *c, size_t i) {
  xy ring[RING], next[RING], u = {of_double(p, c->x[i]), of_double(p, c->y[i])};
  size_t n = 4;
  for (int k = 0; k < 4; k++)
    ring[k] = (xy){of_double(p, c->window[k == 1 || k == 2]), of_double(p, c->window[2 + (k >= 2)])};
  for (size_t j = 0; j < c->n && n; j++) {
    size_t mark = orc_mark(p);
    if (c->x[j] == c->x[i] && c->y[j] == c->y[i]) continue;
    size_t kept = cut(p, next, ring, n, u, (xy){of_double(p, c->x[j]), of_double(p, c->y[j])});
    if (kept == SIZE_MAX) {
      orc_release(p, mark);
      continue;
    }
    memcpy(ring, next, kept * sizeof *next);
    n = kept;
  }
  mpq_srcptr sum = orc_si(p, 0, 1);
  for (size_t k = 0; k < n; k++) {
    xy a = ring[k], b = ring[(k + 1) % n];
    sum = orc_add(p, sum, orc_sub(p, orc_mul(p, a.x, b.y), orc_mul(p, a.y, b.x)));
  }
  return sum;
}

/* ---- ours ---- */

typedef struct setting {
  const cloud *c;
  dyd_sites *sites;
  dyd_delaunay *pd;
  dyd_rect window;
  orc_pool pool;
  mpq_t inner, outer; /* twice the sums */
} setting;

static void setting_init(setting *s, const cloud *c) {
  dyd_error err;
  *s = (setting){.c = c};
  orc_pool_init(&s->pool);
  mpq_inits(s->inner, s->outer, NULL);
  dyd_rect_init(&s->window);
  assert_int_equal(dyd_dyadic_set_d(&s->window.x.lo, c->window[0]), DYD_OK);
  assert_int_equal(dyd_dyadic_set_d(&s->window.x.hi, c->window[1]), DYD_OK);
  assert_int_equal(dyd_dyadic_set_d(&s->window.y.lo, c->window[2]), DYD_OK);
  assert_int_equal(dyd_dyadic_set_d(&s->window.y.hi, c->window[3]), DYD_OK);
  assert_int_equal(dyd_sites_new(&s->sites), DYD_OK);
  assert_int_equal(dyd_sites_add_points(s->sites, c->n, c->x, c->y), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&s->pd, s->sites, NULL, &err), DYD_OK);
}

static void setting_clear(setting *s) {
  dyd_delaunay_free(s->pd);
  dyd_sites_free(s->sites);
  dyd_rect_clear(&s->window);
  mpq_clears(s->inner, s->outer, NULL);
  orc_pool_clear(&s->pool);
}

/* Twice the areas of the polygons of site i. */
static void polygon_areas2(mpq_ptr inner, mpq_ptr outer, const setting *s, uint32_t i) {
  dyd_polygon_list in = {0};
  dyd_polygon_list out = {0};
  dyd_dyadic d;
  mpq_t q;
  dyd_dyadic_init(&d);
  mpq_init(q);
  mpq_set_ui(outer, 0, 1);
  assert_int_equal(dyd_voronoi_polygons(&in, s->pd, i, DYD_CELL_SURE, &s->window, BITS), DYD_OK);
  assert_int_equal(dyd_voronoi_polygons(&out, s->pd, i, DYD_CELL_POSSIBLE, &s->window, BITS), DYD_OK);
  assert_int_equal(dyd_polygon_area2(&d, in.count ? in.item : &(dyd_polygon){0}), DYD_OK);
  dyd_dyadic_get_q(inner, &d);
  for (size_t k = 0; k < out.count; k++) {
    assert_int_equal(dyd_polygon_area2(&d, &out.item[k]), DYD_OK);
    dyd_dyadic_get_q(q, &d);
    mpq_add(outer, outer, q);
  }
  mpq_clear(q);
  dyd_dyadic_clear(&d);
  dyd_polygon_list_clear(&out);
  dyd_polygon_list_clear(&in);
}

/* a <= b <= a + slack * 2^-WANTED */
static bool just_below(mpq_srcptr a, mpq_srcptr b, unsigned long slack) {
  mpq_t q;
  mpq_init(q);
  mpq_set_ui(q, slack, 1);
  mpq_div_2exp(q, q, WANTED);
  mpq_add(q, q, a);
  bool good = mpq_cmp(a, b) <= 0 && mpq_cmp(b, q) <= 0;
  mpq_clear(q);
  return good;
}

/* Inner <= exact <= outer, each within 2^-WANTED (twice the areas within twice that). */
static void check_cell(setting *s, uint32_t i, bool exact) {
  mpq_t inner, outer;
  mpq_inits(inner, outer, NULL);
  polygon_areas2(inner, outer, s, i);
  if (exact) {
    size_t mark = orc_mark(&s->pool);
    mpq_srcptr truth = cell_area2(&s->pool, s->c, i);
    if (!just_below(inner, truth, 2)) fail_msg("inner polygon of %u does not meet its cell", (unsigned)i);
    if (!just_below(truth, outer, 2)) fail_msg("outer polygon of %u does not meet its cell", (unsigned)i);
    orc_release(&s->pool, mark);
    compared++;
  }
  mpq_add(s->inner, s->inner, inner);
  mpq_add(s->outer, s->outer, outer);
  mpq_clears(inner, outer, NULL);
}

/* Sum of inner areas <= W <= sum of outer ones, each within n * 2^-WANTED. */
static void check_sums(setting *s) {
  mpq_t w, h, q;
  mpq_inits(w, h, q, NULL);
  mpq_set_d(w, s->c->window[1]);
  mpq_set_d(q, s->c->window[0]);
  mpq_sub(w, w, q);
  mpq_set_d(h, s->c->window[3]);
  mpq_set_d(q, s->c->window[2]);
  mpq_sub(h, h, q);
  mpq_mul(w, w, h);
  mpq_mul_2exp(w, w, 1);
  assert_true(just_below(s->inner, w, 2 * s->c->n));
  assert_true(just_below(w, s->outer, 2 * s->c->n));
  mpq_clears(w, h, q, NULL);
}

/* Compares every `step`th cell with the exact one. */
static void check_cloud(const cloud *c, size_t step) {
  setting s;
  setting_init(&s, c);
  for (size_t i = 0; i < c->n; i++)
    if (dyd_delaunay_alias(s.pd, (uint32_t)i) == i) check_cell(&s, (uint32_t)i, i % step == 0);
  check_sums(&s);
  setting_clear(&s);
}

/* ---- clouds ---- */

static void cloud_init(cloud *c, size_t room) {
  *c = (cloud){.x = calloc(room, sizeof(double)), .y = calloc(room, sizeof(double))};
  assert_non_null(c->x);
  assert_non_null(c->y);
}

static void cloud_clear(cloud *c) {
  free(c->x);
  free(c->y);
}

/* Dyadics: anywhere, or on a coarse lattice, where cells meet in fours and points coincide. */
static void random_clouds(void **state) {
  (void)state;
  test_random r = test_random_start("classical");
  for (size_t k = 0; k < test_cases(12); k++) {
    cloud c;
    size_t n = (size_t)test_between(&r, 1, 24);
    bool lattice = test_chance(&r, 2);
    cloud_init(&c, n);
    c.n = n;
    for (size_t i = 0; i < n; i++) {
      c.x[i] = lattice ? (double)test_between(&r, 0, 7) / 8 : test_unit(&r);
      c.y[i] = lattice ? (double)test_between(&r, 0, 7) / 8 : test_unit(&r);
    }
    for (int a = 0; a < 2; a++) {
      c.window[2 * a] = (double)test_between(&r, -8, 8) / 16;
      c.window[2 * a + 1] = c.window[2 * a] + (double)test_between(&r, 1, 24) / 16;
    }
    check_cloud(&c, 1);
    cloud_clear(&c);
  }
  fprintf(stderr, "# %zu cells compared\n", compared);
}

/* Latitude and longitude are the last two fields of a line. */
static void read_airports(cloud *c) {
  char line[512];
  FILE *f = fopen(airports, "r");
  assert_non_null(f);
  cloud_init(c, 4096);
  while (fgets(line, sizeof line, f) && c->n < 4096) {
    char *last = strrchr(line, ',');
    if (!last) continue;
    *last = 0;
    char *before = strrchr(line, ',');
    if (!before || strchr("0123456789-", before[1]) == NULL) continue;
    c->x[c->n] = strtod(last + 1, NULL);
    c->y[c->n++] = strtod(before + 1, NULL);
  }
  assert_int_equal(fclose(f), 0);
  assert_in_range(c->n, 3000, 4000);
}

/* The cells of the doubles next to the coordinates of the airports; all take part in the sums. */
static void airport_cells(void **state) {
  (void)state;
  cloud c;
  read_airports(&c);
  memcpy(c.window, (double[4]){-94, -90, 38, 41}, sizeof c.window);
  check_cloud(&c, test_environment("DYADEL_TEST_SCALE", 1) > 1 ? 1 : 211);
  fprintf(stderr, "# %zu cells compared\n", compared);
  cloud_clear(&c);
}

int main(int argc, char **argv) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(random_clouds), cmocka_unit_test(airport_cells)};
  if (argc != 2) return 2;
  airports = argv[1];
  return cmocka_run_group_tests(tests, NULL, NULL);
}
