/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The exact walks, one by one: around the directions against all candidate directions, along beta against the oracle,
 * on a line against the oracle [HUL-1] [HUL-2] [HUL-3] [COV-1] [COV-2] [BETA-1] [POS-1] [LINE-1]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/read_case.h"
#include "delaunay/state.h"
#include "possible/cover.h"
#include "skeleton/hull.h"
#include <cmocka.h>
#include <string.h>

static harness shared;

/* ---- directions ---- */

enum { SITES = 6, DIRECTIONS = 4 + 32 * 2 * SITES };

/* Small integer rectangles x0, x1, y0, y1. */
typedef struct boxes {
  int n;
  long e[SITES][4];
} boxes;

typedef struct direction {
  long x, y;
} direction;

static long highest(const long *e, direction u) {
  return u.x * (u.x > 0 ? e[1] : e[0]) + u.y * (u.y > 0 ? e[3] : e[2]);
}
static long lowest(const long *e, direction u) {
  return u.x * (u.x > 0 ? e[0] : e[1]) + u.y * (u.y > 0 ? e[2] : e[3]);
}

static long cross(direction a, direction b) {
  return a.x * b.y - a.y * b.x;
}
static int half(direction a) {
  return a.y > 0 || (a.y == 0 && a.x > 0) ? 0 : 1;
}
static int by_angle(const void *a, const void *b) {
  const direction *u = a, *v = b;
  if (half(*u) != half(*v)) return half(*u) - half(*v);
  long c = cross(*u, *v);
  return (c < 0) - (c > 0);
}

/* The normals of all differences of corners of v and of others, and the axes, sorted by angle: between two neighbours
 * no comparison of corners changes. */
static size_t candidates(direction *out, const boxes *b, int v) {
  size_t n = 0;
  for (int q = 0; q < 4; q++) out[n++] = (direction){q == 0 ? 1 : q == 1 ? -1 : 0, q == 2 ? 1 : q == 3 ? -1 : 0};
  for (int k = 0; k < b->n; k++)
    for (int c = 0; c < 16 && k != v; c++) {
      long dx = b->e[k][c & 1] - b->e[v][c >> 2 & 1], dy = b->e[k][2 + (c >> 1 & 1)] - b->e[v][2 + (c >> 3)];
      if (dx == 0 && dy == 0) continue;
      out[n++] = (direction){-dy, dx};
      out[n++] = (direction){dy, -dx};
    }
  return n;
}

typedef bool (*property)(const boxes *b, int i, int j, direction u);

static bool may_be_farthest(const boxes *b, int i, int j, direction u) {
  (void)j;
  for (int k = 0; k < b->n; k++)
    if (highest(b->e[i], u) < lowest(b->e[k], u)) return false;
  return true;
}

static bool surely_farthest(const boxes *b, int i, int j, direction u) {
  for (int k = 0; k < b->n; k++)
    if (k != i && k != j && (lowest(b->e[i], u) <= highest(b->e[k], u) || lowest(b->e[j], u) <= highest(b->e[k], u)))
      return false;
  return true;
}

/* Returns true if it holds in some direction: a candidate, or between two neighbours. */
static bool somewhere(const boxes *b, int i, int j, property holds) {
  direction u[2 * DIRECTIONS];
  size_t n = candidates(u, b, i);
  if (j != i) n += candidates(u + n, b, j);
  qsort(u, n, sizeof *u, by_angle);
  for (size_t q = 0; q < n; q++) {
    direction next = u[(q + 1) % n], between = {u[q].x + next.x, u[q].y + next.y};
    if (holds(b, i, j, u[q])) return true;
    if ((between.x || between.y) && holds(b, i, j, between)) return true;
  }
  return false;
}

static void random_boxes(boxes *b, test_random *r) {
  long grid = (long)test_between(r, 2, 12), side = (long)test_below(r, 5);
  b->n = (int)test_between(r, 3, SITES);
  for (int k = 0; k < b->n; k++)
    for (int a = 0; a < 2; a++) {
      b->e[k][2 * a] = (long)test_between(r, 0, grid);
      b->e[k][2 * a + 1] = b->e[k][2 * a] + (long)test_between(r, 0, side);
    }
}

static void to_case(orc_case *c, const boxes *b) {
  c->n = 0;
  snprintf(c->kind, sizeof c->kind, "directions");
  for (int k = 0; k < b->n; k++) orc_case_add(c, b->e[k][0], b->e[k][1], b->e[k][2], b->e[k][3], 1);
}

static bool from_case(boxes *b, const orc_case *c) {
  b->n = (int)c->n;
  for (size_t k = 0; k < c->n; k++) {
    for (int e = 0; e < 4; e++) b->e[k][e] = mpz_get_si(mpq_numref(c->rect[k].e[e]));
    if (orc_case_alias(c, k) != k) return false;
  }
  return c->n >= 3;
}

static bool hull_right(char *message, dyd_work *w, const dyd_skeleton *sk, const boxes *b, uint32_t v) {
  bool possible = false, sure = false;
  int i = (int)sk->reps.site[v];
  if (dyd_hull_possible(&possible, w, sk, v) != DYD_OK || dyd_hull_sure(&sure, w, sk, v) != DYD_OK)
    return wrong(message, "hull of %d fails", i);
  if (possible != somewhere(b, i, i, may_be_farthest))
    return wrong(message, "%d possible on the hull: %d", i, possible);
  if (sure != somewhere(b, i, i, surely_farthest)) return wrong(message, "%d surely on the hull: %d", i, sure);
  return true;
}

static bool direction_right(char *message, dyd_work *w, const dyd_skeleton *sk, const boxes *b, uint32_t v,
                            uint32_t v2) {
  bool found = false;
  int i = (int)sk->reps.site[v], j = (int)sk->reps.site[v2];
  mpz_t x, y;
  mpz_inits(x, y, NULL);
  bool good = dyd_hull_direction(&found, x, y, w, sk, v, v2) == DYD_OK;
  good = good && found == somewhere(b, i, j, surely_farthest);
  if (good && found) good = surely_farthest(b, i, j, (direction){mpz_get_si(x), mpz_get_si(y)});
  mpz_clears(x, y, NULL);
  return good || wrong(message, "direction of %d %d: %d", i, j, found);
}

static bool skeleton_of(dyd_skeleton *sk, char *message, const dyd_sites *s, bool no_filter) {
  dyd_skeleton_options o = {.no_filter = no_filter, .threads = 1};
  return dyd_skeleton_build(sk, s, &o) == DYD_OK || wrong(message, "no skeleton");
}

static bool directions(char *message, harness *h, const orc_case *c) {
  boxes b;
  bool good = true;
  (void)h;
  if (!from_case(&b, c)) return true;
  for (int exact = 0; exact < 2 && good; exact++) {
    dyd_sites *s = harness_sites(c);
    dyd_skeleton sk;
    dyd_work w;
    good = skeleton_of(&sk, message, s, exact);
    dyd_work_init(&w, &sk, NULL);
    for (uint32_t v = 0; sk.rects.box && v < sk.n && good; v++) {
      good = hull_right(message, &w, &sk, &b, v);
      for (uint32_t v2 = 0; v2 < v && good; v2++) good = direction_right(message, &w, &sk, &b, v, v2);
    }
    dyd_work_clear(&w);
    dyd_skeleton_clear(&sk);
    dyd_sites_free(s);
  }
  return good;
}

static void test_directions(void **state) {
  (void)state;
  orc_case c;
  boxes b;
  orc_case_init(&c);
  for (size_t k = test_cases(700); k; k--) {
    random_boxes(&b, &shared.random);
    to_case(&c, &b);
    harness_run(&shared, &c, directions);
  }
  orc_case_clear(&c);
}

/* ---- cover ---- */

/* How often doubles alone say FALSE, UNKNOWN, TRUE. */
static uint64_t quickly[3];

static bool quick_right(char *message, const dyd_skeleton *sk, uint32_t v, uint32_t v2, const uint32_t hint[2],
                        bool want) {
  dyd_xy centre;
  dyd_truth quick = dyd_filter_cover(&centre, sk, v, v2, hint);
  quickly[quick == DYD_TRUE ? 2 : quick == DYD_UNKNOWN]++;
  if (quick == DYD_UNKNOWN || (quick == DYD_TRUE) == want) return true;
  return wrong(message, "pair %u %u: doubles say %d, oracle %d", sk->reps.site[v], sk->reps.site[v2], quick == DYD_TRUE,
               want);
}

/* Every pair, with good, bad and no hints. */
static bool covers(char *message, harness *h, const orc_case *c, const dyd_skeleton *sk) {
  dyd_work w;
  bool good = true;
  dyd_work_init(&w, sk, NULL);
  for (uint32_t v = 0; v < sk->n && good; v++)
    for (uint32_t v2 = 0; v2 < sk->n && good; v2++) {
      uint32_t hint[2] = {DYD_NONE, DYD_NONE};
      dyd_cover found = {0};
      if (v == v2) continue;
      for (int q = 0; q < 2; q++)
        if (test_chance(&h->random, 2)) hint[q] = (uint32_t)test_below(&h->random, sk->n);
      uint32_t i = sk->reps.site[v], j = sk->reps.site[v2];
      size_t mark = orc_mark(&h->pool);
      bool want = orc_possible(&h->pool, c, i, j);
      orc_release(&h->pool, mark);
      if (dyd_cover_possible(&found, &w, sk, v, v2, hint) != DYD_OK)
        good = wrong(message, "cover of %u %u fails", i, j);
      else if (found.possible != want)
        good = wrong(message, "pair %u %u: possible %d, oracle %d", i, j, found.possible, want);
      good = good && quick_right(message, sk, v, v2, hint, want);
      h->pairs++;
      h->undecided += !want;
    }
  dyd_work_clear(&w);
  return good;
}

static bool cover_both(char *message, harness *h, const orc_case *c) {
  bool good = true;
  for (size_t k = 0; k < c->n; k++)
    if (orc_case_alias(c, k) != k) return true;
  for (int exact = 0; exact < 2 && good; exact++) {
    dyd_sites *s = harness_sites(c);
    dyd_skeleton sk;
    good = skeleton_of(&sk, message, s, exact) && (!sk.rects.box || covers(message, h, c, &sk));
    dyd_skeleton_clear(&sk);
    dyd_sites_free(s);
  }
  return good;
}

static void test_cover(void **state) {
  (void)state;
  harness_run_cases(&shared, 6, test_cases(ORC_KINDS * 20), cover_both);
  assert_true(shared.undecided > 20);
  fprintf(stderr, "# in doubles: impossible %llu, unknown %llu, possible %llu\n", (unsigned long long)quickly[0],
          (unsigned long long)quickly[1], (unsigned long long)quickly[2]);
  assert_true(quickly[0] > 20 && quickly[2] > 20);
}

/* A small rectangle before a tall one, so that beta is bent, and others around both ends of it and behind the small
 * one: several block a part of beta each, some two parts. */
static void bent_case(orc_case *c, test_random *r) {
  long tall = (long)test_between(r, 2, 12), apart = (long)test_between(r, 2, 5), size = (long)test_below(r, 2);
  size_t n = (size_t)test_between(r, 4, 8);
  c->n = 0;
  snprintf(c->kind, sizeof c->kind, "bent");
  orc_case_add(c, -size, 0, 0, size, 1);
  orc_case_add(c, apart, apart, -tall, tall, 1);
  while (c->n < n) {
    long x = (long)test_between(r, -6, 4), y = (long)test_between(r, -tall - 4, tall + 4);
    orc_case_add(c, x, x + (long)test_below(r, 3), y, y + (long)test_below(r, 6), 1);
  }
  orc_case_turn(c, (unsigned)test_below(r, 8));
}

static void test_chains(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  memset(quickly, 0, sizeof quickly);
  for (size_t k = test_cases(400); k; k--) {
    bent_case(&c, &shared.random);
    harness_run(&shared, &c, cover_both);
  }
  orc_case_clear(&c);
  fprintf(stderr, "# in doubles: impossible %llu, unknown %llu, possible %llu\n", (unsigned long long)quickly[0],
          (unsigned long long)quickly[1], (unsigned long long)quickly[2]);
  assert_true(quickly[0] > quickly[1]);
}

/* ---- line ---- */

/* Segments and points on a vertical or horizontal line, or points on a slanted one; rational ones among them. */
static void random_line(orc_case *c, test_random *r) {
  size_t n = 1 + (size_t)test_below(r, 8);
  bool slanted = test_chance(r, 3);
  unsigned long den = test_chance(r, 3) ? 3 : 1;
  c->n = 0;
  snprintf(c->kind, sizeof c->kind, "line");
  while (c->n < n) {
    long t = (long)test_between(r, 0, 12), w = slanted || den == 3 ? 0 : (long)test_below(r, 4);
    if (slanted)
      orc_case_add(c, 2 * t, 2 * t, 5 - 3 * t, 5 - 3 * t, den);
    else
      orc_case_add(c, t, t + w, 7, 7, den);
  }
  orc_case_turn(c, (unsigned)test_below(r, 8));
  if (test_chance(r, 3)) orc_case_scale(c, (long)test_between(r, -1500, 1500));
}

static bool counts_right(char *message, harness *h, const orc_case *c) {
  (void)h;
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  bool good = pd && (pd->sk.mesh.collinear || wrong(message, "no line"));
  size_t open = 0, legal = 0, alive = 0;
  for (uint32_t i = 0; good && i < c->n; i++) {
    if (orc_case_alias(c, i) != i) continue;
    alive++;
    for (uint32_t j = 0; j < i; j++) {
      if (orc_case_alias(c, j) != j) continue;
      int status = (int)dyd_delaunay_status(pd, i, j);
      legal += status == DYD_LEGAL;
      if (dyd_line_is_legal(&pd->sk.line, pd->sk.vertex[i], pd->sk.vertex[j]) != (status == DYD_LEGAL))
        good = wrong(message, "the line says otherwise of %u %u", i, j);
      open += status == DYD_INDETERMINATE || status == DYD_TIE;
    }
  }
  const dyd_line *l = pd ? &pd->sk.line : NULL;
  if (good && (l->count != alive || dyd_line_open_pairs(l) != open || dyd_line_legal_pairs(l) != legal))
    good = wrong(message, "%zu alive, %zu open, %zu legal", alive, open, legal);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static void test_line(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  for (size_t k = test_cases(120); k; k--) {
    random_line(&c, &shared.random);
    harness_run(&shared, &c, counts_right);
    expect_right(&shared, &c);
  }
  orc_case_clear(&c);
}

/* Two long sides of a street, 100 apart, and points in its middle, 90 apart: each blocks 50 to both sides, so more of
 * them than the filter follows block all of it; without one there is a gap. */
static void test_street(void **state) {
  (void)state;
  const double lo = -10000, hi = 10000, side[2] = {0, 100}, middle = 50;
  const uint32_t no_hint[2] = {DYD_NONE, DYD_NONE};
  char message[MESSAGE_SIZE] = "";
  for (int left_out = -112; left_out <= 113; left_out += 45) {
    dyd_sites *s = NULL;
    dyd_work w;
    dyd_cover found;
    assert_int_equal(dyd_sites_new(&s), DYD_OK);
    for (int k = 0; k < 2; k++) assert_int_equal(dyd_sites_add_boxes(s, 1, &lo, &hi, &side[k], &side[k]), DYD_OK);
    for (int k = -112; k <= 112; k++) {
      double x = 90 * k;
      if (k != left_out) assert_int_equal(dyd_sites_add_points(s, 1, &x, &middle), DYD_OK);
    }
    dyd_delaunay *pd = harness_engine(message, s, NULL);
    assert_non_null(pd);
    dyd_work_init(&w, &pd->sk, NULL);
    assert_int_equal(dyd_cover_possible(&found, &w, &pd->sk, pd->sk.vertex[0], pd->sk.vertex[1], no_hint), DYD_OK);
    if (found.possible != (left_out < 112)) fail_msg("without %d: %d", left_out, found.possible);
    dyd_work_clear(&w);
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_directions), cmocka_unit_test(test_cover),
                                     cmocka_unit_test(test_chains), cmocka_unit_test(test_line),
                                     cmocka_unit_test(test_street)};
  harness_init(&shared, "walks");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
