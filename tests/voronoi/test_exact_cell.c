/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Int_i and Pos_i against their definitions: [CELL-1] [CELL-2] [CELL-3] [ARC-1] [OUTLINE-1].
 *
 * Every arc, end and chain is checked literally; points anywhere and within tiny distances of the boundary are on the
 * side that ds and dl say, against all sites. DYADEL_TEST_SCALE=60 makes more than 10^6 membership checks. */
#include <setjmp.h>
#include <stdarg.h>

#include "voronoi/region_oracle.h"
#include <cmocka.h>
#include <dyadel/voronoi.h>
#include <string.h>

static size_t points, undetermined, arcs;

/* ---- points ---- */

static bool check_point(char *message, orc_pool *p, const region *g, size_t site, mpq_srcptr x, mpq_srcptr y) {
  orc_point at = {orc_alg_q(p, x), orc_alg_q(p, y)};
  int literal = literal_side(p, g, site, at), side = region_side(p, g, x, y);
  points++;
  if (side == 2) return undetermined++, true;
  bool fine = literal == side;
  /* closures may meet where the regions (Int; regions on a window) have no area */
  if (!literal && side == -1) fine = !g->outer || g->window;
  if (fine) return true;
  char text[2][200];
  gmp_snprintf(text[0], sizeof text[0], "%Qd", x);
  gmp_snprintf(text[1], sizeof text[1], "%Qd", y);
  return wrong(message, "site %zu %s%s: (%.90s, %.90s) is %d, chains say %d", site, g->outer ? "Pos" : "Int",
               g->window ? " on the window" : "", text[0], text[1], literal, side);
}

/* A tiny dyadic, of either sign. */
static mpq_srcptr tiny(orc_pool *p, test_random *r, mpq_srcptr size) {
  mpq_srcptr k = orc_si(p, (long)test_between(r, -3, 3), 1);
  mpq_ptr t = orc_new(p);
  mpq_mul(t, k, size);
  mpq_div_2exp(t, t, (mp_bitcnt_t)test_between(r, 3, 90));
  return t;
}

/* The width of everything, and its middle. */
typedef struct extent {
  mpq_srcptr middle[2], size;
} extent;

static extent find_extent(orc_pool *p, const orc_case *c) {
  extent e;
  e.size = orc_si(p, 0, 1);
  for (int a = 0; a < 2; a++) {
    mpq_srcptr lo = c->rect[0].e[2 * a], hi = c->rect[0].e[2 * a + 1];
    for (size_t k = 1; k < c->n; k++) {
      if (mpq_cmp(c->rect[k].e[2 * a], lo) < 0) lo = c->rect[k].e[2 * a];
      if (mpq_cmp(c->rect[k].e[2 * a + 1], hi) > 0) hi = c->rect[k].e[2 * a + 1];
    }
    e.middle[a] = orc_mid(p, lo, hi);
    if (mpq_cmp(orc_sub(p, hi, lo), e.size) > 0) e.size = orc_sub(p, hi, lo);
  }
  if (!mpq_sgn(e.size)) e.size = orc_si(p, 1, 1);
  return e;
}

/* Anywhere within the extent enlarged, often at its lattice points. */
static mpq_srcptr somewhere(orc_pool *p, test_random *r, const extent *e, int axis) {
  bool coarse = test_chance(r, 2);
  mpq_ptr t = orc_new(p);
  mpq_set_si(t, (long)test_between(r, coarse ? -16 : -(1 << 20), coarse ? 16 : 1 << 20), 1);
  mpq_div_2exp(t, t, coarse ? 4 : 20);
  mpq_mul(t, t, e->size);
  mpq_add(t, t, e->middle[axis]);
  return t;
}

static bool check_arc_points(char *message, orc_pool *p, test_random *r, const region *g, size_t site,
                             const extent *e) {
  size_t chain = (size_t)test_below(r, g->b->count);
  const dyd_arc *a = &g->b->chain[chain].arc[test_below(r, g->b->chain[chain].count)];
  orc_point at = region_sample(p, g, a);
  const dyd_arc_end *end = test_chance(r, 2) ? &a->begin : &a->end;
  if (test_chance(r, 3) && end->kind != DYD_END_INFINITE) {
    at = region_point(p, &end->at);
    size_t bits = (size_t)test_between(r, 4, 200);
    at.x = orc_alg_q(p, orc_alg_near(p, at.x, bits));
    at.y = orc_alg_q(p, orc_alg_near(p, at.y, bits));
  }
  if (!check_point(message, p, g, site, at.x.a, at.y.a)) return false;
  return check_point(message, p, g, site, orc_add(p, at.x.a, tiny(p, r, e->size)),
                     orc_add(p, at.y.a, tiny(p, r, e->size)));
}

static bool check_region(char *message, harness *h, const region *g, size_t site, size_t rounds) {
  orc_pool *p = &h->pool;
  size_t mark = orc_mark(p);
  if (!region_is_sound(message, p, g, site)) return false;
  for (size_t m = 0; m < g->b->count; m++) arcs += g->b->chain[m].count;
  for (size_t k = 0; k < rounds; k++) {
    extent e = find_extent(p, g->c);
    mpq_srcptr x = somewhere(p, &h->random, &e, 0), y = somewhere(p, &h->random, &e, 1);
    if (!check_point(message, p, g, site, x, y)) return false;
    if (g->b->count && !check_arc_points(message, p, &h->random, g, site, &e)) return false;
    orc_release(p, mark);
  }
  return true;
}

/* ---- one case ---- */

static void set_window(orc_rect *w, harness *h, const orc_case *c) {
  orc_pool *p = &h->pool;
  size_t mark = orc_mark(p);
  extent e = find_extent(p, c);
  for (int a = 0; a < 2; a++) {
    mpq_srcptr s = somewhere(p, &h->random, &e, a), t = somewhere(p, &h->random, &e, a);
    while (mpq_equal(s, t)) t = somewhere(p, &h->random, &e, a);
    bool ordered = mpq_cmp(s, t) < 0;
    mpq_set(w->e[2 * a], ordered ? s : t);
    mpq_set(w->e[2 * a + 1], ordered ? t : s);
  }
  orc_release(p, mark);
}

static bool is_dyadic(mpq_srcptr q) {
  return mpz_popcount(mpq_denref(q)) == 1;
}

/* All four regions of one site. window may be NULL. */
static bool check_site(char *message, harness *h, const orc_case *c, const dyd_delaunay *pd, size_t site,
                       const orc_rect *window, size_t rounds) {
  dyd_boundary b = {0};
  dyd_rect w;
  dyd_rect_init(&w);
  if (window) harness_rect(&w, window);
  bool good = true;
  size_t own = orc_case_alias(c, site);
  for (int which = 0; which < (window ? 4 : 2) && good; which++) {
    bool outer = which & 1;
    dyd_status st;
    if (which < 2)
      st = outer ? dyd_voronoi_cell(&b, pd, (uint32_t)site, DYD_CELL_POSSIBLE, NULL)
                 : dyd_voronoi_cell(&b, pd, (uint32_t)site, DYD_CELL_SURE, NULL);
    else
      st = outer ? dyd_voronoi_cell(&b, pd, (uint32_t)site, DYD_CELL_POSSIBLE, &w)
                 : dyd_voronoi_cell(&b, pd, (uint32_t)site, DYD_CELL_SURE, &w);
    region g = {&b, c, outer, which < 2 ? NULL : window};
    good = st == DYD_OK || wrong(message, "status %d", st);
    good = good && check_region(message, h, &g, own, rounds);
  }
  dyd_rect_clear(&w);
  dyd_boundary_clear(&b);
  return good;
}

/* dyd_voronoi_side against the definition. */
static bool check_side(char *message, harness *h, const orc_case *c, const dyd_delaunay *pd, size_t site) {
  orc_pool *p = &h->pool;
  size_t mark = orc_mark(p);
  extent e = find_extent(p, c);
  mpq_srcptr x = somewhere(p, &h->random, &e, 0), y = somewhere(p, &h->random, &e, 1);
  bool good = true;
  if (is_dyadic(x) && is_dyadic(y)) {
    dyd_rect r;
    dyd_rect_init(&r);
    orc_rect o;
    for (int k = 0; k < 4; k++) {
      mpq_init(o.e[k]);
      mpq_set(o.e[k], k < 2 ? x : y);
    }
    harness_rect(&r, &o);
    dyd_point at;
    dyd_point_init(&at);
    dyd_dyadic_set(&at.x, &r.x.lo);
    dyd_dyadic_set(&at.y, &r.y.lo);
    region in = {.c = c}, out = {.c = c, .outer = true};
    orc_point q = {orc_alg_q(p, x), orc_alg_q(p, y)};
    dyd_truth want = literal_side(p, &in, site, q) > 0    ? DYD_TRUE
                     : literal_side(p, &out, site, q) < 0 ? DYD_FALSE
                                                          : DYD_UNKNOWN;
    dyd_truth got = dyd_voronoi_side(pd, (uint32_t)site, &at);
    good = got == want || wrong(message, "dyd_voronoi_side of %zu gives %d for %d", site, got, want);
    dyd_point_clear(&at);
    for (int k = 0; k < 4; k++) mpq_clear(o.e[k]);
    dyd_rect_clear(&r);
  }
  orc_release(p, mark);
  return good;
}

static bool check_case(char *message, harness *h, const orc_case *c) {
  if (c->n < 1) return true;
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  bool good = pd != NULL;
  orc_rect w;
  for (int k = 0; k < 4; k++) mpq_init(w.e[k]);
  set_window(&w, h, c);
  bool dyadic = true;
  for (int k = 0; k < 4; k++) dyadic = dyadic && is_dyadic(w.e[k]);
  for (size_t i = 0; i < c->n && good; i++) {
    good = check_site(message, h, c, pd, i, dyadic ? &w : NULL, 3);
    good = good && check_side(message, h, c, pd, i);
  }
  for (int k = 0; k < 4; k++) mpq_clear(w.e[k]);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static void random_cases(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "voronoi random");
  orc_case c;
  orc_case_init(&c);
  points = undetermined = arcs = 0;
  for (size_t k = 0; k < test_cases(200); k++) {
    orc_generate(&c, &h.random, k % ORC_KINDS, k % 20 ? 7 : 24);
    harness_run(&h, &c, check_case);
  }
  fprintf(stderr, "# %zu points, %zu undetermined, %zu arcs\n", points, undetermined, arcs);
  assert_true(undetermined * 5 < points);
  orc_case_clear(&c);
  harness_clear(&h);
}

/* ---- small cases ---- */

/* Rectangle number k of the 36 with corners on {0,1,2}^2. */
static void add_small(orc_case *c, size_t k) {
  static const long side[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  orc_case_add(c, side[k / 6][0], side[k / 6][1], side[k % 6][0], side[k % 6][1], 1);
}

static void small_triples(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "voronoi small");
  orc_case c;
  orc_case_init(&c);
  size_t all = 36 * 36 * 36, step = all / test_cases(250);
  if (!step) step = 1;
  for (size_t k = test_below(&h.random, step); k < all; k += step) {
    c.n = 0;
    strcpy(c.kind, "small");
    add_small(&c, k % 36);
    add_small(&c, k / 36 % 36);
    add_small(&c, k / 1296);
    harness_run(&h, &c, check_case);
  }
  orc_case_clear(&c);
  harness_clear(&h);
}

/* Rectangles next to one another that share corners, sides, lines: many coinciding curves. */
static void lattice_cases(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "voronoi lattice");
  orc_case c;
  orc_case_init(&c);
  for (size_t k = 0; k < test_cases(80); k++) {
    c.n = 0;
    strcpy(c.kind, "lattice");
    long n = (long)test_between(&h.random, 2, 7), grid = (long)test_between(&h.random, 3, 8);
    for (long m = 0; m < n; m++) {
      long x = (long)test_below(&h.random, (uint64_t)grid), y = (long)test_below(&h.random, (uint64_t)grid);
      orc_case_add(&c, x, x + (long)test_below(&h.random, 3), y, y + (long)test_below(&h.random, 3), 1);
    }
    harness_run(&h, &c, check_case);
  }
  orc_case_clear(&c);
  harness_clear(&h);
}

/* ---- known shapes ---- */

static dyd_delaunay *engine_of(dyd_sites **s, const orc_case *c) {
  char message[MESSAGE_SIZE] = "";
  *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, *s, NULL);
  assert_non_null(pd);
  return pd;
}

static void strip_and_plane(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  orc_case_add(&c, 0, 0, 0, 0, 1);
  dyd_sites *s;
  dyd_delaunay *pd = engine_of(&s, &c);
  dyd_boundary b = {0};
  assert_int_equal(dyd_voronoi_cell(&b, pd, 0, DYD_CELL_SURE, NULL), DYD_OK);
  assert_true(b.whole && !b.count);
  assert_int_equal(dyd_voronoi_cell(&b, pd, 0, DYD_CELL_POSSIBLE, NULL), DYD_OK);
  assert_true(b.whole && !b.count);
  assert_int_equal(dyd_voronoi_cell(&b, pd, 1, DYD_CELL_POSSIBLE, NULL), DYD_E_ARG);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  orc_case_add(&c, 4, 4, 0, 0, 1);
  orc_case_add(&c, 8, 8, 0, 0, 1);
  pd = engine_of(&s, &c);
  assert_int_equal(dyd_voronoi_cell(&b, pd, 1, DYD_CELL_SURE, NULL), DYD_OK);
  assert_int_equal(b.count, 2);
  for (int k = 0; k < 2; k++) {
    assert_false(b.chain[k].closed);
    assert_int_equal(b.chain[k].count, 1);
  }
  dyd_rect w;
  dyd_rect_init(&w);
  dyd_rect_set_d(&w, 3, 5, -1, 1);
  assert_int_equal(dyd_voronoi_cell(&b, pd, 1, DYD_CELL_SURE, &w), DYD_OK);
  assert_true(b.whole && b.count == 1 && b.chain[0].closed && b.chain[0].count == 4);
  assert_int_equal(dyd_voronoi_cell(&b, pd, 0, DYD_CELL_SURE, &w), DYD_OK);
  assert_true(!b.whole && !b.count);
  dyd_rect_set_d(&w, 3, 3, -1, 1);
  assert_int_equal(dyd_voronoi_cell(&b, pd, 0, DYD_CELL_SURE, &w), DYD_E_ARG);
  dyd_rect_clear(&w);
  dyd_boundary_clear(&b);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  orc_case_clear(&c);
}

static void set_rect(dyd_rect *out, double x0, double x1, double y0, double y1) {
  assert_int_equal(dyd_rect_set_d(out, x0, x1, y0, y1), DYD_OK);
}

/* A curve that touches a side of the window, from outside and from inside, changes nothing on that side. */
static void touched_window(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  dyd_boundary b = {0};
  dyd_rect w;
  dyd_rect_init(&w);
  orc_case_add(&c, 0, 1, 0, 0, 1);
  orc_case_add(&c, 0, 0, 0, 2, 1);
  orc_case_add(&c, 1, 1, 0, 2, 1);
  dyd_sites *s;
  dyd_delaunay *pd = engine_of(&s, &c);
  set_rect(&w, -0.5, 1, 0.875, 1.125);
  assert_int_equal(dyd_voronoi_cell(&b, pd, 1, DYD_CELL_POSSIBLE, &w), DYD_OK);
  assert_true(b.whole && b.count == 1 && b.chain[0].count == 4);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  c.n = 0;
  orc_case_add(&c, -5, 5, 0, 0, 1);
  orc_case_add(&c, 0, 0, 2, 2, 1); /* the parabola y = x^2 / 4 + 1 */
  pd = engine_of(&s, &c);
  set_rect(&w, -1, 1, 1, 3);
  assert_int_equal(dyd_voronoi_cell(&b, pd, 0, DYD_CELL_POSSIBLE, &w), DYD_OK);
  assert_true(!b.whole && b.count == 1 && b.chain[0].closed && b.chain[0].count == 4);
  assert_int_equal(dyd_voronoi_cell(&b, pd, 1, DYD_CELL_SURE, &w), DYD_OK);
  assert_true(!b.whole && b.count == 1 && b.chain[0].closed && b.chain[0].count == 4);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  dyd_rect_clear(&w);
  dyd_boundary_clear(&b);
  orc_case_clear(&c);
}

/* Exact points: the boundaries of Int and Pos are the same classical cell. */
static void classical(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "voronoi classical");
  orc_case c;
  orc_case_init(&c);
  for (size_t k = 0; k < test_cases(20); k++) {
    orc_generate(&c, &h.random, k % 2 ? 5 : 10, 8);
    dyd_sites *s;
    dyd_delaunay *pd = engine_of(&s, &c);
    dyd_boundary in = {0}, out = {0};
    for (uint32_t i = 0; i < c.n && orc_case_all_points(&c); i++) {
      assert_int_equal(dyd_voronoi_cell(&in, pd, i, DYD_CELL_SURE, NULL), DYD_OK);
      assert_int_equal(dyd_voronoi_cell(&out, pd, i, DYD_CELL_POSSIBLE, NULL), DYD_OK);
      assert_int_equal(in.count, out.count);
      for (size_t m = 0; m < in.count; m++) assert_int_equal(in.chain[m].count, out.chain[m].count);
    }
    dyd_boundary_clear(&in);
    dyd_boundary_clear(&out);
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
  }
  orc_case_clear(&c);
  harness_clear(&h);
}

/* The eight symmetries of the square change nothing but the names of corners and sides. */
static void count_kinds(size_t out[8], const dyd_boundary *b) {
  memset(out, 0, 8 * sizeof *out);
  out[0] = b->count;
  out[1] = b->whole;
  for (size_t m = 0; m < b->count; m++)
    for (size_t k = 0; k < b->chain[m].count; k++) {
      out[2 + b->chain[m].arc[k].kind]++;
      out[4] += b->chain[m].arc[k].end.kind == DYD_END_SITES;
      out[5] += b->chain[m].arc[k].end.kind == DYD_END_AXIS;
      out[6] += b->chain[m].arc[k].end.kind == DYD_END_FEATURE;
      out[7] += b->chain[m].arc[k].begin.site + b->chain[m].arc[k].end.site;
    }
}

static void symmetries(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "voronoi symmetries");
  orc_case c;
  orc_case_init(&c);
  for (size_t k = 0; k < test_cases(34); k++) {
    orc_generate(&c, &h.random, k % ORC_KINDS, 6);
    size_t first[2 * ORC_MAX][8];
    for (unsigned turn = 0; turn < 8; turn++) {
      orc_case_turn(&c, turn);
      dyd_sites *s;
      dyd_delaunay *pd = engine_of(&s, &c);
      dyd_boundary b = {0};
      for (uint32_t i = 0; i < 2 * c.n; i++) {
        size_t kinds[8];
        assert_int_equal(i & 1 ? dyd_voronoi_cell(&b, pd, i / 2, DYD_CELL_POSSIBLE, NULL)
                               : dyd_voronoi_cell(&b, pd, i / 2, DYD_CELL_SURE, NULL),
                         DYD_OK);
        count_kinds(turn ? kinds : first[i], &b);
        if (turn && memcmp(kinds, first[i], sizeof kinds)) {
          orc_case_print(stderr, &c);
          fail_msg("site %u, symmetry %u", i / 2, turn);
        }
      }
      dyd_boundary_clear(&b);
      dyd_delaunay_free(pd);
      dyd_sites_free(s);
    }
  }
  orc_case_clear(&c);
  harness_clear(&h);
}

/* Narrower rectangles: every point of the old Int is in the new one, every point of the new Pos in the old one; arcs'
 * samples are points of the closures. */
static bool grows(orc_pool *p, const orc_case *old, const orc_case *new, const dyd_boundary *b, bool outer, size_t i) {
  region g = {b, outer ? new : old, outer, NULL}, h = {b, outer ? old : new, outer, NULL};
  for (size_t m = 0; m < b->count; m++)
    for (size_t k = 0; k < b->chain[m].count; k++)
      if (literal_side(p, &h, i, region_sample(p, &g, &b->chain[m].arc[k])) < 0) return false;
  return true;
}

static void refinement(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "voronoi refinement");
  orc_case c, goal, fine;
  orc_case_init(&c);
  orc_case_init(&goal);
  orc_case_init(&fine);
  for (size_t k = 0; k < test_cases(51); k++) {
    size_t mark = orc_mark(&h.pool);
    orc_generate(&c, &h.random, k % ORC_KINDS, 6);
    orc_choose(&goal, &h.random, &c, 3);
    orc_case_set(&fine, &c);
    for (size_t i = 0; i < c.n; i++) orc_narrow(&fine.rect[i], &h.random, &goal.rect[i], test_chance(&h.random, 4));
    dyd_sites *s[2];
    dyd_delaunay *pd[2] = {engine_of(&s[0], &c), engine_of(&s[1], &fine)};
    dyd_boundary b = {0};
    for (uint32_t i = 0; i < c.n; i++) {
      if (orc_case_alias(&fine, i) != i) continue;
      assert_int_equal(dyd_voronoi_cell(&b, pd[0], i, DYD_CELL_SURE, NULL), DYD_OK);
      assert_true(grows(&h.pool, &c, &fine, &b, false, i));
      assert_int_equal(dyd_voronoi_cell(&b, pd[1], i, DYD_CELL_POSSIBLE, NULL), DYD_OK);
      assert_true(grows(&h.pool, &c, &fine, &b, true, i));
    }
    dyd_boundary_clear(&b);
    for (int m = 0; m < 2; m++) {
      dyd_delaunay_free(pd[m]);
      dyd_sites_free(s[m]);
    }
    orc_release(&h.pool, mark);
  }
  orc_case_clear(&fine);
  orc_case_clear(&goal);
  orc_case_clear(&c);
  harness_clear(&h);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strip_and_plane), cmocka_unit_test(touched_window), cmocka_unit_test(random_cases),
      cmocka_unit_test(small_triples),   cmocka_unit_test(lattice_cases),  cmocka_unit_test(classical),
      cmocka_unit_test(symmetries),      cmocka_unit_test(refinement),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
