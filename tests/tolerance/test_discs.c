/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Statuses of discs: with equal radii against tolerances, with others against choices of points [DISC-1] [DISC-2]
 * [DISC-3]. */
#include <setjmp.h>
#include <stdarg.h>

#include "support/random.h"
#include <cmocka.h>
#include <dyadel/tolerance.h>
#include <math.h>
#include <string.h>

enum { MOST = 12 };

typedef struct disc_case {
  size_t n;
  double x[MOST], y[MOST], r[MOST];
} disc_case;

/* Dyadic and coarse, so that squares are exact and discs often touch. */
static void make_discs_case(disc_case *c, test_random *r, bool equal) {
  double grid = test_chance(r, 2) ? 16 : 1024, size = grid * 0.25 * test_unit(r);
  c->n = 3 + test_below(r, MOST - 2);
  for (size_t k = 0; k < c->n; k++) {
    c->x[k] = (double)test_below(r, (uint64_t)grid);
    c->y[k] = (double)test_below(r, (uint64_t)grid);
    c->r[k] = equal && k ? c->r[0] : nearbyint(size * (equal ? 0.5 : test_unit(r)) * 4) / 4;
    for (size_t i = 0; i < k; i++) /* places once only: as points they would be one */
      if (c->x[i] == c->x[k] && c->y[i] == c->y[k]) c->x[k] += 2000 + (double)k;
  }
}

static dyd_delaunay *triangulate(dyd_sites **sites, const disc_case *c, bool squares) {
  dyd_delaunay *pd;
  dyd_error err;
  assert_int_equal(dyd_sites_new(sites), DYD_OK);
  for (size_t k = 0; k < c->n; k++) {
    double r = squares ? c->r[k] : 0, b[4] = {c->x[k] - r, c->x[k] + r, c->y[k] - r, c->y[k] + r};
    assert_int_equal(dyd_sites_add_boxes(*sites, 1, &b[0], &b[1], &b[2], &b[3]), DYD_OK);
  }
  assert_int_equal(dyd_delaunay_new(&pd, *sites, NULL, &err), DYD_OK);
  return pd;
}

static dyd_pair_status status_in(const dyd_pair_list *l, uint32_t i, uint32_t j) {
  for (size_t k = 0; k < l->count; k++)
    if (l->item[k].i == i && l->item[k].j == j) return l->item[k].status;
  return DYD_ILLEGAL;
}

static dyd_pair_list pairs_of_discs(const disc_case *c) {
  dyd_sites *sites;
  dyd_error err;
  dyd_pair_list l = {0};
  dyd_delaunay *pd = triangulate(&sites, c, true);
  assert_int_equal(dyd_disc_pairs(&l, pd, NULL, &err), DYD_OK);
  for (size_t k = 0; k < l.count; k++) { /* only what squares leave open may change */
    dyd_pair_status square = dyd_delaunay_status(pd, l.item[k].i, l.item[k].j);
    assert_true(square == l.item[k].status || square == DYD_INDETERMINATE);
  }
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return l;
}

/* ---- equal radii: the same as tolerances say ---- */

static void compare_with_tolerance(const disc_case *c, size_t *decided) {
  dyd_sites *sites;
  dyd_error err;
  const dyd_tolerance_row *row;
  dyd_tolerance *t;
  mpq_t up_to;
  mpq_init(up_to);
  mpq_set_d(up_to, c->r[0] * (1 + 1e-9)); /* what hangs on roundings may be listed */
  dyd_delaunay *pd = triangulate(&sites, c, false);
  dyd_pair_list l = pairs_of_discs(c);
  assert_int_equal(
      dyd_tolerance_new(&t, pd, &(dyd_tolerance_options){DYD_SIZED(dyd_tolerance_options), .up_to = up_to}, &err),
      DYD_OK);
  size_t events = dyd_tolerance_rows(&row, t), listed = 0;
  for (; events--; row++) {
    dyd_pair_status s = status_in(&l, row->i, row->j);
    bool death = row->event == DYD_EVENT_DEATH;
    listed += s != DYD_ILLEGAL;
    if (death && row->lo > c->r[0] * (1 + 1e-9)) assert_int_equal(s, DYD_LEGAL);
    if (death && row->hi <= c->r[0]) assert_int_equal(s, DYD_INDETERMINATE);
    if (!death && row->hi <= c->r[0]) assert_true(s == DYD_INDETERMINATE || (s == DYD_TIE && c->r[0] == 0));
    *decided += s == DYD_LEGAL;
  }
  assert_int_equal(l.count, listed);
  dyd_pair_list_clear(&l);
  dyd_tolerance_free(t);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  mpq_clear(up_to);
}

static void test_equal_discs(void **state) {
  (void)state;
  test_random r = test_random_start("equal discs");
  size_t decided = 0;
  for (size_t k = 0; k < test_cases(400); k++) {
    disc_case c;
    make_discs_case(&c, &r, true);
    compare_with_tolerance(&c, &decided);
  }
  assert_true(decided > test_least(500));
}

/* ---- any radii: choices never refute ---- */

/* In the discs, mostly on their rims; towards or away from one place, or anywhere. */
static void choose(disc_case *out, const disc_case *c, test_random *r) {
  double cx = c->x[0] + 40 * (test_unit(r) - 0.5), cy = c->y[0] + 40 * (test_unit(r) - 0.5);
  uint64_t way = test_u64(r);
  bool aimed = test_chance(r, 2);
  *out = *c;
  for (size_t k = 0; k < c->n; k++) {
    double a = aimed ? atan2(cy - c->y[k], cx - c->x[k]) : 6.283185307179586 * test_unit(r);
    double d = c->r[k] * (test_chance(r, 4) ? test_unit(r) : 1) * (1 - 1e-12) * (aimed && way >> k & 1 ? -1 : 1);
    out->x[k] += d * cos(a);
    out->y[k] += d * sin(a);
    out->r[k] = 0;
  }
}

static void test_choices(void **state) {
  (void)state;
  test_random r = test_random_start("choices in discs");
  size_t open = 0, shown = 0, changed = 0;
  for (size_t k = 0; k < test_cases(300); k++) {
    disc_case c, p;
    bool edge[MOST][MOST], none[MOST][MOST];
    make_discs_case(&c, &r, false);
    memset(edge, 0, sizeof edge);
    memset(none, 0, sizeof none);
    dyd_pair_list l = pairs_of_discs(&c);
    for (int tries = 0; tries < 100; tries++) {
      dyd_sites *sites;
      choose(&p, &c, &r);
      dyd_delaunay *pd = triangulate(&sites, &p, false);
      for (uint32_t i = 0; i < c.n; i++)
        for (uint32_t j = i + 1; j < c.n; j++)
          *(dyd_delaunay_status(pd, i, j) == DYD_LEGAL ? &edge[i][j] : &none[i][j]) = true;
      dyd_delaunay_free(pd);
      dyd_sites_free(sites);
    }
    for (uint32_t i = 0; i < c.n; i++)
      for (uint32_t j = i + 1; j < c.n; j++) {
        dyd_pair_status s = status_in(&l, i, j);
        if (s == DYD_LEGAL) assert_false(none[i][j]);
        if (s == DYD_ILLEGAL) assert_false(edge[i][j]);
        open += s == DYD_INDETERMINATE;
        shown += s == DYD_INDETERMINATE && edge[i][j] && none[i][j];
        changed += s == DYD_LEGAL;
      }
    dyd_pair_list_clear(&l);
  }
  print_message("open %zu, shown to be so by choices %zu, legal %zu\n", open, shown, changed);
  assert_true(changed > test_least(300) && shown * 10 > open * 6);
}

/* ---- triangles: with the empty circles of choices ---- */

/* The sign of the turn a, b, c; and is d inside the circle through a, b, c (1), or on it (0)? Exactly. */
static int circle_sign(int *turn, const disc_case *p, const uint32_t v[4]) {
  mpq_t m[3][3], s, t;
  mpq_inits(s, t, NULL);
  for (int k = 0; k < 3; k++) {
    mpq_inits(m[k][0], m[k][1], m[k][2], NULL);
    for (int axis = 0; axis < 2; axis++) {
      mpq_set_d(m[k][axis], axis ? p->y[v[k]] : p->x[v[k]]);
      mpq_set_d(s, axis ? p->y[v[3]] : p->x[v[3]]);
      mpq_sub(m[k][axis], m[k][axis], s);
      mpq_mul(s, m[k][axis], m[k][axis]);
      mpq_add(m[k][2], m[k][2], s);
    }
  }
  mpq_t all, area;
  mpq_inits(all, area, NULL);
  for (int k = 0; k < 3; k++) { /* of the first two columns of the rows after k */
    mpq_t *a = m[(k + 1) % 3], *b = m[(k + 2) % 3];
    mpq_mul(s, a[0], b[1]);
    mpq_mul(t, a[1], b[0]);
    mpq_sub(s, s, t);
    mpq_add(area, area, s);
    mpq_mul(s, s, m[k][2]);
    mpq_add(all, all, s);
  }
  int inside = mpq_sgn(all);
  *turn = mpq_sgn(area);
  for (int k = 0; k < 3; k++) mpq_clears(m[k][0], m[k][1], m[k][2], NULL);
  mpq_clears(s, t, all, area, NULL);
  return inside * *turn;
}

/* Counter-clockwise, and all other sites are strictly outside of its circle. */
static bool is_triangle(const disc_case *p, const uint32_t v[3]) {
  for (uint32_t d = 0; d < p->n; d++) {
    uint32_t all[4] = {v[0], v[1], v[2], d};
    int turn;
    if (d == v[0] || d == v[1] || d == v[2]) continue;
    if (circle_sign(&turn, p, all) >= 0 || turn <= 0) return false;
  }
  return true;
}

static bool lists_triangle(const dyd_triangle_list *l, const uint32_t v[3]) {
  bool found = false;
  for (size_t k = 0; k < l->count; k++) found = found || memcmp(l->item[k].v, v, sizeof l->item[k].v) == 0;
  return found;
}

/* Those listed are triangles of every choice; the others with three legal pairs are of none. */
static void compare_triangles(const disc_case *c, test_random *r, const dyd_pair_list *l, const dyd_triangle_list *tri,
                              size_t *hollow) {
  for (int tries = 0; tries < 20; tries++) {
    disc_case p = *c;
    if (tries) choose(&p, c, r);
    for (uint32_t i = 0; i < c->n; i++)
      for (uint32_t j = i + 1; j < c->n; j++)
        for (uint32_t k = i + 1; k < c->n; k++) {
          const uint32_t v[3] = {i, j, k};
          bool listed = lists_triangle(tri, v);
          bool legal = j != k && status_in(l, i, j) == DYD_LEGAL && status_in(l, i, k) == DYD_LEGAL &&
                       status_in(l, j < k ? j : k, j < k ? k : j) == DYD_LEGAL;
          assert_true(legal || !listed);
          if (legal) assert_int_equal(is_triangle(&p, v), listed);
          *hollow += legal && j < k && !tries && !listed && !lists_triangle(tri, (uint32_t[]){i, k, j});
        }
  }
}

static void test_triangles(void **state) {
  (void)state;
  test_random r = test_random_start("triangles of discs");
  size_t certain = 0, more = 0, hollow = 0;
  for (size_t k = 0; k < test_cases(300); k++) {
    disc_case c;
    dyd_sites *sites;
    dyd_triangle_list tri = {0}, squares = {0};
    make_discs_case(&c, &r, false);
    for (size_t i = 0; i < c.n; i++) c.r[i] = nearbyint(c.r[i]) / (k % 2 ? 4 : 1);
    if (c.n < 4) continue;
    dyd_pair_list l = pairs_of_discs(&c);
    dyd_delaunay *pd = triangulate(&sites, &c, true);
    assert_int_equal(dyd_disc_triangles(&tri, &l, pd), DYD_OK);
    assert_int_equal(dyd_delaunay_triangles(&squares, NULL, pd, 0), DYD_OK);
    compare_triangles(&c, &r, &l, &tri, &hollow);
    for (size_t q = 0; q < squares.count; q++) assert_true(lists_triangle(&tri, squares.item[q].v));
    for (size_t q = 0; q + 1 < tri.count; q++) assert_true(memcmp(&tri.item[q], &tri.item[q + 1], sizeof *tri.item));
    certain += tri.count;
    more += tri.count - squares.count;
    dyd_triangle_list_clear(&squares);
    dyd_triangle_list_clear(&tri);
    dyd_pair_list_clear(&l);
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
  }
  print_message("certain %zu, not so for squares %zu, three legal pairs around others %zu\n", certain, more, hollow);
  assert_true(certain > test_least(300) && more > test_least(20) && hollow > test_least(10));
}

/* Cancelled before it begins, a tolerance has no rows and counts the missing ones; without a cancel it has all. */
static void test_cancelled(void **state) {
  (void)state;
  test_random r = test_random_start("cancelled tolerances");
  for (size_t k = 0; k < test_cases(40); k++) {
    disc_case c;
    dyd_sites *sites;
    const dyd_tolerance_row *row;
    size_t count[4], edges = 1, births = 1, deaths = 0;
    make_discs_case(&c, &r, false);
    dyd_delaunay *pd = triangulate(&sites, &c, false);
    dyd_delaunay_count(count, pd);
    for (int now = 0; now < 2; now++) {
      dyd_tolerance *t;
      mpq_t up_to;
      mpq_init(up_to);
      mpq_set_ui(up_to, 1, 1);
      dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .cancel = &now, .metric = k % 2,
                                 .weight = k % 4 == 2 ? c.r : NULL};
      if (k % 3) o.up_to = up_to;
      assert_int_equal(dyd_tolerance_new(&t, pd, &o, NULL), now && count[DYD_LEGAL] ? DYD_CANCELLED : DYD_OK);
      size_t rows = dyd_tolerance_rows(&row, t);
      edges = dyd_tolerance_get(t)->edges_left, births = dyd_tolerance_get(t)->births_left;
      for (size_t q = deaths = 0; q < rows; q++) deaths += row[q].event == DYD_EVENT_DEATH;
      assert_int_equal(deaths + edges, count[DYD_LEGAL]);
      assert_int_equal(deaths, now ? 0 : count[DYD_LEGAL]);
      assert_true(births == (now && o.up_to ? SIZE_MAX : 0));
      dyd_tolerance_free(t);
      mpq_clear(up_to);
    }
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
  }
}

static void test_refused(void **state) {
  (void)state;
  dyd_triangle_list none = {0};
  dyd_sites *sites;
  dyd_delaunay *pd;
  dyd_error err;
  dyd_pair_list l = {0};
  const double lo[3] = {0, 10, 5}, hi[3] = {1, 11, 6}, top[3] = {1, 1, 9};
  assert_int_equal(dyd_sites_new(&sites), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(sites, 3, lo, hi, (double[]){0, 0, 7}, top), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, sites, NULL, &err), DYD_OK);
  assert_int_equal(dyd_disc_pairs(&l, pd, NULL, &err), DYD_E_ARG);
  assert_true(err.point == 2 && l.count == 0);
  assert_int_equal(dyd_disc_triangles(&none, &l, pd), DYD_E_ARG);
  assert_true(none.count == 0);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

/* Small discs, hundreds of them: near the hull circles are as large as half-planes, and few others are in their way.
 * The armed build counts how many are seen. */
static void test_many(void **state) {
  enum { MANY = 700 };
  static double x0[MANY], x1[MANY], y0[MANY], y1[MANY];
  (void)state;
  test_random r = test_random_start("many discs");
  size_t open = 0, decided = 0;
  for (size_t c = 0; c < test_cases(3); c++) {
    dyd_sites *sites;
    dyd_delaunay *pd;
    dyd_pair_list l = {0};
    for (size_t k = 0; k < MANY; k++) {
      double x = (double)test_below(&r, 1 << 16), y = (double)test_below(&r, 1 << 16),
             h = (double)(8 << test_below(&r, 3));
      x0[k] = x - h, x1[k] = x + h, y0[k] = y - h, y1[k] = y + h;
    }
    assert_int_equal(dyd_sites_new(&sites), DYD_OK);
    assert_int_equal(dyd_sites_add_boxes(sites, MANY, x0, x1, y0, y1), DYD_OK);
    assert_int_equal(dyd_delaunay_new(&pd, sites, NULL, NULL), DYD_OK);
    assert_int_equal(dyd_disc_pairs(&l, pd, NULL, NULL), DYD_OK);
    for (size_t k = 0; k < l.count; k++) {
      dyd_pair_status square = dyd_delaunay_status(pd, l.item[k].i, l.item[k].j);
      assert_true(square == l.item[k].status || square == DYD_INDETERMINATE);
      open += l.item[k].status == DYD_INDETERMINATE;
      decided += square != l.item[k].status;
    }
    dyd_pair_list_clear(&l);
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
  }
  assert_true(open > 0 && decided > 0);
}

/* 0,1 is legal by a disc whose centre is near (-9e14, 4e14), with a margin of 1e-7: a direction decides, not a place.
 * Of two discs a rim's width apart no circle in doubles tells. */
static void test_far_centre(void **state) {
  (void)state;
  static const disc_case cases[] = {{5,
                                     {-1, 20, 59, 20, 59},
                                     {20, 59, 20, 20, 40},
                                     {4.7978909999999999, 1.4393673, 28.787345999999999, 14.393673, 14.393673}},
                                    /* a small disc in a large one; the nearest other is 2^-30 away */
                                    {4, {0, 1, 16, -40}, {0, 0, 0, 0}, {8, 2, 8 - 0x1p-30, 1}},
                                    /* one 2^-22 beyond the rim of a large one: doubles place no circle */
                                    {4, {0, 6 + 0x1p-22, -16, 40}, {0, 0, 0, 0}, {8, 2, 8 - 0x1p-30, 1}},
                                    /* beside a line, 2^-30 before a third disc touches it */
                                    {4, {0, 1024, 512, 512}, {0, 0, 16 + 0x1p-30, 99999}, {8, 8, 8, 1}}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    dyd_pair_list l = pairs_of_discs(&cases[k]);
    assert_int_equal(DYD_LEGAL, status_in(&l, 0, 1));
    dyd_pair_list_clear(&l);
  }
}

/* Powers of two change nothing, however large or small squares of distances become. */
static void test_scaled(void **state) {
  (void)state;
  static const double powers[] = {0x1p250, 0x1p900, 0x1p-250, 0x1p-900};
  test_random r = test_random_start("scaled discs");
  size_t decided = 0;
  for (size_t k = 0; k < test_cases(40); k++) {
    disc_case c;
    make_discs_case(&c, &r, false);
    dyd_pair_list here = pairs_of_discs(&c);
    double by = powers[test_below(&r, 4)];
    for (size_t i = 0; i < c.n; i++) c.x[i] *= by, c.y[i] *= by, c.r[i] *= by;
    dyd_pair_list there = pairs_of_discs(&c);
    assert_int_equal(here.count, there.count);
    for (size_t i = 0; i < here.count; i++) {
      assert_int_equal(here.item[i].status, status_in(&there, here.item[i].i, here.item[i].j));
      decided += here.item[i].status == DYD_LEGAL;
    }
    dyd_pair_list_clear(&here);
    dyd_pair_list_clear(&there);
  }
  assert_true(decided > 0);
}

/* Cancelled before it begins, at a scale that is triangulated anew: the pairs keep the statuses of squares. */
static void test_scaled_cancelled(void **state) {
  (void)state;
  test_random r = test_random_start("cancelled discs");
  const volatile int cancel = 1;
  size_t open = 0;
  for (size_t k = 0; k < test_cases(40); k++) {
    disc_case c;
    dyd_sites *sites;
    dyd_error err;
    dyd_pair_list l = {0};
    make_discs_case(&c, &r, false);
    for (size_t i = 0; i < c.n; i++) c.x[i] *= 0x1p300, c.y[i] *= 0x1p300, c.r[i] *= 0x1p300;
    dyd_delaunay *pd = triangulate(&sites, &c, true);
    dyd_status st = dyd_disc_pairs(&l, pd, &cancel, &err);
    for (size_t i = 0; i < l.count; i++) {
      assert_int_equal(l.item[i].status, dyd_delaunay_status(pd, l.item[i].i, l.item[i].j));
      if (l.item[i].status != DYD_INDETERMINATE) continue;
      assert_int_equal(st, DYD_CANCELLED);
      open++;
    }
    dyd_pair_list_clear(&l);
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
  }
  assert_true(open > 0);
}

/* The square about (10^12, 10^9) + (x, y) / 10^4 with half-width 3.5 / 10^4, its ends known to 2^-200. */
static void make_fine_square(dyd_rect *r, long x, long y) {
  mpq_t at, lo, hi, half;
  mpq_inits(at, lo, hi, half, NULL);
  mpq_set_ui(half, 7, 20000);
  mpq_canonicalize(half);
  for (int axis = 0; axis < 2; axis++) {
    mpq_set_si(at, axis ? y : x, 10000);
    mpq_canonicalize(at);
    mpq_set_d(lo, axis ? 1e9 : 1e12);
    mpq_add(at, at, lo);
    mpq_sub(lo, at, half);
    mpq_add(hi, at, half);
    assert_int_equal(dyd_interval_set_outward(axis ? &r->y : &r->x, lo, hi, -200), DYD_OK);
  }
  mpq_clears(at, lo, hi, half, NULL);
}

enum { FINE = 9 };

static dyd_pair_status status_of_fine(const dyd_sites *sites) {
  dyd_delaunay *pd;
  dyd_pair_list l = {0};
  assert_int_equal(dyd_delaunay_new(&pd, sites, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_disc_pairs(&l, pd, NULL, NULL), DYD_OK);
  dyd_pair_status s = status_in(&l, 4, 6);
  dyd_pair_list_clear(&l);
  dyd_delaunay_free(pd);
  return s;
}

/* Exact squares far from 0 have the discs in them, not ones larger by what doubles there would be rounded by, of which
 * 4,6 is not legal. Narrowed ones may have been rounded. */
static void test_given(void **state) {
  (void)state;
  static const long at[FINE][2] = {{-50, 9},  {-24, -49}, {-31, 47}, {36, 42}, {-33, 31},
                                   {13, -31}, {-23, 42},  {34, -18}, {-21, -2}};
  dyd_sites *sites;
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(dyd_sites_new(&sites), DYD_OK);
  for (size_t k = 0; k < FINE; k++) {
    make_fine_square(&r, at[k][0], at[k][1]);
    assert_int_equal(dyd_sites_add_rect(sites, &r), DYD_OK);
  }
  assert_int_equal(status_of_fine(sites), DYD_LEGAL);
  for (size_t k = 0; k < FINE; k++) {
    assert_int_equal(dyd_sites_get(&r, sites, k), DYD_OK);
    assert_int_equal(dyd_sites_narrow(sites, k, &r), DYD_OK);
  }
  assert_int_equal(status_of_fine(sites), DYD_INDETERMINATE);
  dyd_sites_free(sites);
  dyd_rect_clear(&r);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_equal_discs), cmocka_unit_test(test_choices),
                                     cmocka_unit_test(test_triangles),   cmocka_unit_test(test_cancelled),
                                     cmocka_unit_test(test_refused),     cmocka_unit_test(test_many),
                                     cmocka_unit_test(test_far_centre),  cmocka_unit_test(test_given),
                                     cmocka_unit_test(test_scaled),      cmocka_unit_test(test_scaled_cancelled)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
