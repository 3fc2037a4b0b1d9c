/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Triangles that fat rectangles meet, against all triangles and all rectangles in long double; and edges of thin sites
 * among fat ones, whose status any choice of points might refute [WIT-FAT] [WIT-NEAR] [WIT-HULL]. */
#include <setjmp.h>
#include <stdarg.h>

#include "legal/certify.h"
#include "legal/star_filter.h"
#include "support/random.h"

#include <cmocka.h>
#include <dyadel/delaunay.h>
#include <math.h>
#include <string.h>

typedef long double real;

enum { MOST = 150 };

typedef struct flock {
  size_t n;
  double box[MOST][4];
} flock;

/* Points of a grid or of a circle, so that many are in line or on one circle, or anywhere; a few fat ones, some of them
 * reaching far beyond the hull. */
static void fill(flock *f, test_random *r, double thin, unsigned one_in) {
  int kind = (int)test_below(r, 4), grid = 1 << test_between(r, 4, 20);
  f->n = (size_t)test_between(r, 30, MOST);
  for (size_t k = 0; k < f->n; k++) {
    double x = (double)test_between(r, 0, grid), y = kind == 1 ? x * x / grid : (double)test_between(r, 0, grid);
    if (kind == 2) y = floor(y / 16) + (double)test_below(r, 2);
    if (kind == 3) x = floor(grid * cos((double)k)), y = floor(grid * sin((double)k));
    double w = test_chance(r, one_in) ? grid * ldexp(1, -(int)test_between(r, 0, 8)) : thin;
    double high = test_chance(r, 2) ? w : thin, left = w == thin ? 0 : w * (double)test_below(r, 5) / 4;
    f->box[k][0] = x - left;
    f->box[k][1] = x - left + w;
    f->box[k][2] = y;
    f->box[k][3] = y + high;
  }
}

static dyd_sites *sites_of(const flock *f) {
  dyd_sites *s = NULL;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (size_t k = 0; k < f->n; k++) {
    const double *b = f->box[k];
    assert_int_equal(dyd_sites_add_boxes(s, 1, &b[0], &b[1], &b[2], &b[3]), DYD_OK);
  }
  return s;
}

/* true: it has triangles and boxes, and representatives that are doubles. */
static bool thin_skeleton(dyd_skeleton *sk, const dyd_sites *s) {
  assert_int_equal(dyd_skeleton_build(sk, s, &(dyd_skeleton_options){.threads = 1}), DYD_OK);
  return sk->mesh.count && sk->rects.box && !sk->reps.code;
}

/* Vertices of rectangles that are not thin. */
static uint32_t fat_ones(uint32_t *fat, const dyd_skeleton *sk, double thin) {
  const dyd_bbox *box = sk->rects.box;
  uint32_t count = 0;
  for (uint32_t v = 0; v < sk->n; v++)
    if (box[v].e[1] - box[v].e[0] > thin || box[v].e[3] - box[v].e[2] > thin) fat[count++] = v;
  return count;
}

/* ---- the flood ---- */

static real outside(real x, real lo, real hi) {
  return x < lo ? lo - x : x > hi ? x - hi : 0;
}

/* Distance of box and disc less the reach, in radii of the disc; of the half-plane, in lengths of the edge. flat:
 * doubles may take it for met. */
static real apart(bool *flat, const dyd_mesh *m, uint32_t t, const dyd_bbox *b, real reach) {
  const uint32_t *v = m->tri[t].v;
  *flat = false;
  for (unsigned g = 0; g < 3; g++) {
    if (v[g] != m->n) continue;
    dyd_xy p = m->xy[v[dyd_prev(g)]], q = m->xy[v[dyd_next(g)]];
    real x = (real)q.x - p.x, y = (real)q.y - p.y, least = INFINITY, length = hypotl(x, y);
    for (int k = 0; k < 4; k++)
      least = fminl(least, (x * ((real)b->e[2 + (k >> 1)] - p.y) - y * ((real)b->e[k & 1] - p.x)) / length);
    return (least - reach) / length;
  }
  dyd_xy o = m->xy[v[0]];
  real bx = (real)m->xy[v[1]].x - o.x, by = (real)m->xy[v[1]].y - o.y, cx = (real)m->xy[v[2]].x - o.x,
       cy = (real)m->xy[v[2]].y - o.y, lb = bx * bx + by * by, lc = cx * cx + cy * cy, d = 2 * (bx * cy - by * cx);
  real x = (cy * lb - by * lc) / d, y = (bx * lc - cx * lb) / d, r = hypotl(x, y);
  *flat = d < 1e-5L * (lb + lc);
  real away = hypotl(outside(o.x + x, b->e[0], b->e[1]), outside(o.y + y, b->e[2], b->e[3]));
  return (away - r - reach) / r;
}

typedef struct tally {
  size_t met, clear, floods;
} tally;

static bool touches(const dyd_mesh *m, uint32_t t, uint32_t v) {
  return m->tri[t].v[0] == v || m->tri[t].v[1] == v || m->tri[t].v[2] == v;
}

static void check_flood(tally *sum, const dyd_skeleton *sk, double thin, double reach) {
  uint32_t fat[MOST], count = fat_ones(fat, sk, thin), *met = NULL;
  assert_int_equal(dyd_fat_meet(&met, sk, fat, count, reach), DYD_OK);
  if (!met) return;
  sum->floods++;
  for (uint32_t t = 0; t < sk->mesh.count; t++) {
    bool must = false, may = false, flat = false;
    for (uint32_t k = 0; k < count; k++) {
      real gap = apart(&flat, &sk->mesh, t, &sk->rects.box[fat[k]], reach);
      must = must || gap <= -1e-9L || touches(&sk->mesh, t, fat[k]);
      may = may || flat || !(gap > 0.01L + 0.01L * reach);
    }
    if (must && !met[t]) fail_msg("triangle %u of %u vertices is met", t, sk->n);
    if (!must && !may && met[t]) fail_msg("triangle %u of %u vertices is clear", t, sk->n);
    sum->met += must;
    sum->clear += !met[t];
  }
  free(met);
}

static void test_flood(void **state) {
  (void)state;
  test_random r = test_random_start("fat floods");
  tally sum = {0};
  flock *f = malloc(sizeof *f);
  assert_non_null(f);
  for (size_t k = test_cases(80); k; k--) {
    double thin = ldexp(1, -(int)test_between(&r, 4, 12));
    fill(f, &r, thin, (unsigned)test_between(&r, 20, 150));
    dyd_sites *s = sites_of(f);
    dyd_skeleton sk;
    if (thin_skeleton(&sk, s)) {
      check_flood(&sum, &sk, thin, thin);
      check_flood(&sum, &sk, thin, 2);
    }
    dyd_skeleton_clear(&sk);
    dyd_sites_free(s);
  }
  free(f);
  fprintf(stderr, "# %zu floods, %zu met, %zu clear\n", sum.floods, sum.met, sum.clear);
  assert_true(sum.floods > test_cases(80) / 3 && sum.met > 10 * sum.floods && sum.clear > 10 * sum.floods);
}

/* ---- edges ---- */

/* What the first pass marks is legal. */
static void check_first_pass(const dyd_sites *s, const dyd_delaunay *plain, double thin, size_t *marked) {
  dyd_skeleton sk;
  bool is_thin = thin_skeleton(&sk, s);
  if (is_thin) {
    uint32_t fat[MOST], count = fat_ones(fat, &sk, thin), *met = NULL;
    assert_int_equal(dyd_fat_meet(&met, &sk, fat, count, thin), DYD_OK);
    if (met) assert_int_equal(dyd_certify_near(&sk, 1, thin, met, dyd_short_edge(&sk.mesh)), DYD_OK);
    for (uint32_t t = 0; met && t < sk.mesh.count; t++)
      for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++) {
        if (!dyd_edge_is_certain(&sk, h)) continue;
        uint32_t a = dyd_edge_origin(&sk.mesh, h), b = dyd_edge_target(&sk.mesh, h);
        ++*marked;
        if (dyd_delaunay_status(plain, sk.reps.site[a], sk.reps.site[b]) != DYD_LEGAL)
          fail_msg("edge %u %u is not legal", a, b);
      }
    free(met);
  }
  dyd_skeleton_clear(&sk);
}

/* What the first pass marks is legal; and all statuses are those found without doubles. */
static void check_marked(const flock *f, double thin, size_t *marked) {
  dyd_sites *s = sites_of(f);
  dyd_delaunay *pd = NULL, *plain = NULL;
  dyd_delaunay_options slow = {DYD_SIZED(dyd_delaunay_options), .no_filter = true};
  assert_int_equal(dyd_delaunay_new(&pd, s, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&plain, s, &slow, NULL), DYD_OK);
  for (uint32_t i = 0; i < f->n; i++)
    for (uint32_t j = i + 1; j < f->n; j++)
      if (dyd_delaunay_status(pd, i, j) != dyd_delaunay_status(plain, i, j))
        fail_msg("pair %u %u: %d, exactly %d", i, j, (int)dyd_delaunay_status(pd, i, j),
                 (int)dyd_delaunay_status(plain, i, j));
  check_first_pass(s, plain, thin, marked);
  dyd_delaunay_free(plain);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void test_edges(void **state) {
  (void)state;
  test_random r = test_random_start("edges among fat ones");
  size_t marked = 0;
  flock *f = malloc(sizeof *f);
  assert_non_null(f);
  for (size_t k = test_cases(8); k; k--) {
    double thin = ldexp(1, -(int)test_between(&r, 8, 20));
    fill(f, &r, thin, 40);
    if (f->n > 60) f->n = 60;
    check_marked(f, thin, &marked);
  }
  free(f);
  fprintf(stderr, "# %zu edges marked\n", marked);
  assert_true(marked > 20 * test_cases(8));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_flood), cmocka_unit_test(test_edges)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
