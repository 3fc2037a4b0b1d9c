/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Edges certified in doubles from the triangles or stars next to them: the centre that the proof names is a witness, by
 * exact arithmetic, whatever rectangles and further sites the premises allow [WIT-NEAR] [WIT-HULL] [FLT-STAR]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/read_case.h"
#include "legal/star_filter.h"
#include "skeleton/hull.h"
#include <cmocka.h>
#include <math.h>

static harness shared;

typedef struct vec {
  mpq_srcptr x, y;
} vec;

static mpq_srcptr number(orc_pool *p, double x) {
  mpq_ptr q = orc_new(p);
  mpq_set_d(q, x);
  return q;
}
static vec point(orc_pool *p, dyd_xy a) {
  return (vec){number(p, a.x), number(p, a.y)};
}
static vec minus(orc_pool *p, vec a, vec b) {
  return (vec){orc_sub(p, a.x, b.x), orc_sub(p, a.y, b.y)};
}
static mpq_srcptr cross(orc_pool *p, vec a, vec b) {
  return orc_sub(p, orc_mul(p, a.x, b.y), orc_mul(p, a.y, b.x));
}
static mpq_srcptr norm2(orc_pool *p, vec a) {
  return orc_add(p, orc_sqr(p, a.x), orc_sqr(p, a.y));
}

/* The centre of the circle through a, b, c: a + perpendicular combination, over twice the cross product. */
static vec circumcentre(orc_pool *p, vec a, vec b, vec c) {
  vec u = minus(p, b, a), v = minus(p, c, a);
  mpq_srcptr lu = norm2(p, u), lv = norm2(p, v), d = orc_twice(p, cross(p, u, v));
  mpq_srcptr x = orc_sub(p, orc_mul(p, v.y, lu), orc_mul(p, u.y, lv));
  mpq_srcptr y = orc_sub(p, orc_mul(p, u.x, lv), orc_mul(p, v.x, lu));
  return (vec){orc_add(p, a.x, orc_div(p, x, d)), orc_add(p, a.y, orc_div(p, y, d))};
}

static orc_alg distance2(orc_pool *p, orc_point c, vec a) {
  return orc_alg_add(p, orc_alg_sqr(p, orc_alg_sub_q(p, c.x, a.x)), orc_alg_sqr(p, orc_alg_sub_q(p, c.y, a.y)));
}

/* |c-k| - E > |c-i| + E, without roots: L = |c-k|^2 - |c-i|^2 - 4 E^2 > 0 and L^2 > 16 E^2 |c-i|^2. */
static bool clear_of(orc_pool *p, orc_point c, vec i, vec k, double reach) {
  orc_alg near = distance2(p, c, i), far = distance2(p, c, k);
  mpq_srcptr e = number(p, reach), zero = orc_si(p, 0, 1);
  orc_alg l = orc_alg_sub_q(p, orc_alg_sub(p, far, near), orc_mul(p, orc_si(p, 4, 1), orc_sqr(p, e)));
  if (orc_alg_sgn(p, l) <= 0) return false;
  orc_alg bound = orc_alg_affine(p, near, orc_mul(p, orc_si(p, 16, 1), orc_sqr(p, e)), zero);
  return orc_alg_sgn(p, orc_alg_sub(p, orc_alg_sqr(p, l), bound)) > 0;
}

/* ---- configurations ---- */

/* The edge ij, u on its left, v on its right (or no v: a hull edge), m a bound of distances from i and j. */
typedef struct corner {
  dyd_xy i, j, u, v;
  bool hull;
  double m;
} corner;

static double random_scale(test_random *r) {
  return test_chance(r, 3) ? ldexp(1, (int)test_between(r, -30, 40)) : 1;
}

static dyd_xy random_point(test_random *r, double spread) {
  return (dyd_xy){(test_unit(r) - 0.5) * spread, (test_unit(r) - 0.5) * spread};
}

static int turn(orc_pool *p, dyd_xy a, dyd_xy b, dyd_xy c) {
  return mpq_sgn(cross(p, minus(p, point(p, b), point(p, a)), minus(p, point(p, c), point(p, a))));
}

/* Returns true if k is outside the circle about c through i, or on it. */
static bool outside(orc_pool *p, vec c, dyd_xy i, dyd_xy k) {
  return mpq_cmp(norm2(p, minus(p, point(p, k), c)), norm2(p, minus(p, point(p, i), c))) >= 0;
}

static vec centre(orc_pool *p, const corner *c, dyd_xy third) {
  return circumcentre(p, point(p, c->i), point(p, c->j), point(p, third));
}

/* The shortest side times a factor: i and j may have neighbours that near. */
static double shortest(const corner *c) {
  double l = fmin(dyd_square_distance(c->i, c->j), dyd_square_distance(c->i, c->u));
  l = fmin(l, dyd_square_distance(c->j, c->u));
  if (!c->hull) l = fmin(l, fmin(dyd_square_distance(c->i, c->v), dyd_square_distance(c->j, c->v)));
  return sqrt(l);
}

static bool make_corner(corner *c, orc_pool *p, test_random *r, bool hull) {
  double scale = random_scale(r), thin = test_chance(r, 3) ? 1.0 / 64 : 1;
  *c = (corner){.hull = hull};
  c->i = random_point(r, scale);
  c->j = random_point(r, scale);
  c->u = random_point(r, scale);
  c->v = random_point(r, scale);
  if (test_chance(r, 3)) /* a flat or a short triangle */
    c->u = (dyd_xy){c->i.x + (c->j.x - c->i.x) * test_unit(r) + (c->u.x - c->i.x) * thin,
                    c->i.y + (c->j.y - c->i.y) * test_unit(r) + (c->u.y - c->i.y) * thin};
  if (turn(p, c->i, c->j, c->u) <= 0 || (!hull && turn(p, c->i, c->j, c->v) >= 0)) return false;
  if (!hull && !outside(p, centre(p, c, c->u), c->i, c->v)) return false;
  c->m = shortest(c) * (test_chance(r, 2) ? 1 : test_unit(r));
  return c->m > 0;
}

static bool filter_says(const corner *c, double reach) {
  return c->hull ? dyd_filter_hull_edge_near(c->i, c->j, c->u, reach, c->m)
                 : dyd_filter_edge_near(c->i, c->j, c->u, c->v, reach, c->m);
}

/* The largest reach that the filter accepts, up to a relative 2^-20; 0 if there is none. */
static double largest_reach(const corner *c) {
  double lo = 0, hi = c->m;
  for (int step = 0; step < 60 && hi - lo > hi * 0x1p-20; step++) {
    double mid = lo > 0 ? lo + (hi - lo) / 2 : hi / 2;
    if (mid > 0x1p-300 && filter_says(c, mid))
      lo = mid;
    else
      hi = mid;
  }
  return lo;
}

/* The centre that the proof names: (c1 + c2)/2, or c1 + r1 n with r1 n = (jy, -jx) sqrt(|iu|^2 |ju|^2 / a1^2) / 2. */
static orc_point stated_centre(orc_pool *p, const corner *c) {
  vec c1 = centre(p, c, c->u), i = point(p, c->i), j = point(p, c->j), u = point(p, c->u);
  if (!c->hull) {
    vec c2 = centre(p, c, c->v);
    return (orc_point){orc_alg_q(p, orc_mid(p, c1.x, c2.x)), orc_alg_q(p, orc_mid(p, c1.y, c2.y))};
  }
  vec e = minus(p, j, i);
  mpq_srcptr half = orc_si(p, 1, 2), a1 = cross(p, e, minus(p, u, i));
  mpq_srcptr c0 = orc_div(p, orc_mul(p, norm2(p, minus(p, u, i)), norm2(p, minus(p, u, j))), orc_sqr(p, a1));
  return (orc_point){{c1.x, orc_mul(p, half, e.y), c0}, {c1.y, orc_mul(p, half, orc_neg(p, e.x)), c0}};
}

/* A further representative about distance m from i or j, in a random direction or near the line ij. */
static dyd_xy intruder(test_random *r, const corner *c) {
  bool at_i = test_chance(r, 2);
  dyd_xy from = at_i ? c->i : c->j, to = at_i ? c->j : c->i;
  double along = atan2(from.y - to.y, from.x - to.x),
         wide = test_chance(r, 2) ? 3.2 : ldexp(1, -(int)test_below(r, 20));
  double angle = along + (2 * test_unit(r) - 1) * wide;
  double d = c->m * (1 + 0x1p-40) * (test_chance(r, 4) ? 1 + test_unit(r) : 1);
  return (dyd_xy){from.x + d * cos(angle), from.y + d * sin(angle)};
}

/* Returns true if k is allowed: outside the empty circles, not nearer than m to i and j, not beyond a hull edge. */
static bool allowed(orc_pool *p, const corner *c, dyd_xy k) {
  mpq_srcptr m2 = orc_sqr(p, number(p, c->m));
  if (mpq_cmp(norm2(p, minus(p, point(p, k), point(p, c->i))), m2) < 0) return false;
  if (mpq_cmp(norm2(p, minus(p, point(p, k), point(p, c->j))), m2) < 0) return false;
  if (!outside(p, centre(p, c, c->u), c->i, k)) return false;
  return c->hull ? turn(p, c->i, c->j, k) >= 0 : outside(p, centre(p, c, c->v), c->i, k);
}

static void fail_at(const corner *c, dyd_xy k, double reach) {
  const dyd_xy all[5] = {c->i, c->j, c->u, c->v, k};
  for (int q = 0; q < 5; q++) fprintf(stderr, "%c %a %a\n", "ijuvk"[q], all[q].x, all[q].y);
  fail_msg("reach %a, m %a: the centre is no witness", reach, c->m);
}

static size_t attack(orc_pool *p, const corner *c, double reach) {
  size_t tried = 0;
  orc_point at = stated_centre(p, c);
  vec i = point(p, c->i);
  if (!clear_of(p, at, i, point(p, c->u), reach)) fail_at(c, c->u, reach);
  if (!c->hull && !clear_of(p, at, i, point(p, c->v), reach)) fail_at(c, c->v, reach);
  for (int n = 0; n < 30; n++) {
    size_t mark = orc_mark(p);
    dyd_xy k = intruder(&shared.random, c);
    bool good = allowed(p, c, k);
    tried += good;
    if (good && !clear_of(p, at, i, point(p, k), reach)) fail_at(c, k, reach);
    orc_release(p, mark);
  }
  return tried;
}

static void run_corners(bool hull, size_t cases) {
  size_t certified = 0, tried = 0;
  for (size_t n = cases; n; n--) {
    corner c;
    size_t mark = orc_mark(&shared.pool);
    if (make_corner(&c, &shared.pool, &shared.random, hull)) {
      double reach = largest_reach(&c);
      if (reach > 0) {
        certified++;
        tried += attack(&shared.pool, &c, reach);
      }
    }
    orc_release(&shared.pool, mark);
  }
  fprintf(stderr, "# %s: %zu edges certified, %zu intruders\n", hull ? "hull" : "inner", certified, tried);
  assert_true(certified > cases / 40 && tried > certified);
}

static void test_near(void **state) {
  (void)state;
  run_corners(false, test_cases(6000));
}

static void test_hull_near(void **state) {
  (void)state;
  run_corners(true, test_cases(2500));
}

/* Premises that do not hold: no statement. */
static void test_near_refuses(void **state) {
  (void)state;
  dyd_xy i = {0, 0}, j = {1, 0}, u = {0.5, 0.5}, v = {0.5, -0.5}, low = {0.5, -0.75}, ghost = {NAN, NAN};
  assert_true(dyd_filter_edge_near(i, j, u, low, 1e-4, 0.7));
  assert_true(dyd_filter_hull_edge_near(i, j, u, 1e-4, 0.7));
  assert_false(dyd_filter_edge_near(i, j, u, v, 1e-9, 0.7));    /* cocircular */
  assert_false(dyd_filter_edge_near(j, i, u, low, 1e-9, 0.7));  /* the wrong way round */
  assert_false(dyd_filter_edge_near(i, j, u, low, 0.01, 0.7));  /* reach > m / 200 */
  assert_false(dyd_filter_edge_near(i, j, ghost, low, 0, 0.7)); /* the ghost */
  assert_false(dyd_filter_edge_near(i, j, u, ghost, 0, 0.7));
  assert_false(dyd_filter_edge_near(i, j, u, low, NAN, 0.7));
  assert_false(dyd_filter_edge_near(i, j, u, low, 1e-4, NAN));
  assert_false(dyd_filter_hull_edge_near(i, j, ghost, 0, 0.7));
  assert_false(dyd_filter_hull_edge_near(i, j, v, 1e-9, 0.7));
  assert_false(dyd_filter_hull_edge_near(i, j, u, NAN, 0.7));
}

/* ---- the pass over all stars ---- */

/* Rectangles of equal size, a few fat ones among them; long numbers now and then, so that delta > 0. */
static void random_thin(orc_case *c, test_random *r) {
  unsigned bits = (unsigned)test_between(r, 3, 14), fine = test_chance(r, 3) ? 44 : 0;
  c->n = 0;
  snprintf(c->kind, sizeof c->kind, "stars");
  for (int k = 0; k < 11; k++) {
    long w = (long)test_below(r, 5), x = (long)test_below(r, 20ul << bits), y = (long)test_below(r, 20ul << bits);
    if (test_chance(r, 4)) x = (x >> bits) << bits, y = (y >> bits) << bits;
    if (test_chance(r, 30)) w = 4l << bits;
    x = (x << fine) + (fine != 0), y <<= fine;
    orc_case_add(c, x, x + (w << fine), y, y + (w << fine), 1ul << bits);
  }
}

/* Every edge that the pass marks is legal, every ghost edge is on the hull for every choice. */
static bool stars_hold(char *message, harness *h, const orc_case *c) {
  dyd_sites *s = harness_sites(c);
  dyd_skeleton sk;
  dyd_work w;
  bool good =
      dyd_skeleton_build(&sk, s, &(dyd_skeleton_options){.threads = 1}) == DYD_OK || wrong(message, "no skeleton");
  dyd_work_init(&w, &sk, NULL);
  if (good && sk.rects.box) {
    const dyd_mesh *m = &sk.mesh;
    good = dyd_certify_stars(&sk, 1) == DYD_OK || wrong(message, "the pass fails");
    for (uint32_t t = 0; t < m->count && good; t++)
      for (dyd_half_edge e = dyd_edge_of(t, 0); e < dyd_edge_end(t) && good; e++) {
        uint32_t a = dyd_edge_origin(m, e), b = dyd_edge_target(m, e);
        if (!dyd_edge_is_certain(&sk, e) || !dyd_edge_is_first(m, e)) continue;
        bool real = a != m->n && b != m->n, sure = false;
        if (real)
          sure = orc_legal(NULL, NULL, &h->pool, c, sk.reps.site[a], sk.reps.site[b]);
        else
          good = dyd_hull_sure(&sure, &w, &sk, a == m->n ? b : a) == DYD_OK;
        h->pairs++;
        h->legal += real;
        if (!sure) good = wrong(message, "edge %u %u marked", a, b);
      }
  }
  dyd_work_clear(&w);
  dyd_skeleton_clear(&sk);
  dyd_sites_free(s);
  return good;
}

static void test_stars(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  for (size_t k = test_cases(40); k; k--) {
    bool alias = false;
    random_thin(&c, &shared.random);
    for (size_t i = 0; i < c.n; i++) alias = alias || orc_case_alias(&c, i) != i;
    if (!alias) harness_run(&shared, &c, stars_hold);
  }
  orc_case_clear(&c);
  assert_true(shared.legal > 100);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_near), cmocka_unit_test(test_hull_near),
                                     cmocka_unit_test(test_near_refuses), cmocka_unit_test(test_stars)};
  harness_init(&shared, "near");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
