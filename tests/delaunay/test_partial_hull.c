/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The partial convex hull against its definitions, in exact rationals, for all directions that can matter: random cases
 * biased to trouble, the same after narrowing, a small exhaustive grid, and large inputs [HST-1] [HST-2] [HUL-2]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include <cmocka.h>
#include <dyadel/predicate.h>
#include <dyadel/voronoi.h>
#include <math.h>
#include <time.h>

static harness shared;

/* ---- the oracle ---- */

typedef struct direction {
  mpq_srcptr x, y;
} direction;

/* max (or min) of u.x over the rectangle. */
static mpq_srcptr height(orc_pool *p, direction u, const orc_rect *r, bool most) {
  mpq_srcptr x = r->e[(mpq_sgn(u.x) > 0) == most], y = r->e[2 + ((mpq_sgn(u.y) > 0) == most)];
  return orc_add(p, orc_mul(p, u.x, x), orc_mul(p, u.y, y));
}

static bool is_alias(const orc_case *c, size_t k) {
  return orc_case_alias(c, k) != k;
}

/* max over i and max over j are both >= min over every k. */
static bool supports(orc_pool *p, const orc_case *c, direction u, size_t i, size_t j) {
  mpq_srcptr a = height(p, u, &c->rect[i], true), b = height(p, u, &c->rect[j], true);
  for (size_t k = 0; k < c->n; k++) {
    mpq_srcptr m = height(p, u, &c->rect[k], false);
    if (mpq_cmp(a, m) < 0 || mpq_cmp(b, m) < 0) return false;
  }
  return true;
}

static bool separates(orc_pool *p, const orc_case *c, direction u, size_t i) {
  mpq_srcptr a = height(p, u, &c->rect[i], false);
  for (size_t k = 0; k < c->n; k++)
    if (k != i && !is_alias(c, k) && mpq_cmp(a, height(p, u, &c->rect[k], true)) <= 0) return false;
  return true;
}

typedef struct visitor {
  orc_pool *p;
  const orc_case *c;
  size_t i, j;
  bool sure;
} visitor;

static bool holds(const visitor *v, mpq_srcptr x, mpq_srcptr y) {
  size_t mark = orc_mark(v->p);
  direction u = {x, y};
  bool found =
      (mpq_sgn(x) || mpq_sgn(y)) && (v->sure ? separates(v->p, v->c, u, v->i) : supports(v->p, v->c, u, v->i, v->j));
  orc_release(v->p, mark);
  return found;
}

/* Returns true if corner n of the rectangle is the same point as a corner of a lower number. */
static bool repeats(const orc_rect *r, int n) {
  return (n & 1 && mpq_equal(r->e[0], r->e[1])) || (n & 2 && mpq_equal(r->e[2], r->e[3]));
}

/* The differences of corners of rectangles a and b, both ways, and their normals. */
static bool holds_for(const visitor *v, const orc_rect *a, const orc_rect *b) {
  for (int n = 0; n < 16; n++) {
    if (repeats(a, n & 3) || repeats(b, n >> 2)) continue;
    mpq_srcptr x = orc_sub(v->p, a->e[n & 1], b->e[n >> 2 & 1]),
               y = orc_sub(v->p, a->e[2 + (n >> 1 & 1)], b->e[2 + (n >> 3)]);
    mpq_srcptr nx = orc_neg(v->p, x), ny = orc_neg(v->p, y);
    if (holds(v, x, y) || holds(v, nx, ny) || holds(v, ny, x) || holds(v, y, nx)) return true;
  }
  return false;
}

/* Returns true if a direction as wanted exists. The directions that support i and j are a closed set: all of them, or
 * arcs that end in normals of differences of corners of i or j and others, or within an axis direction. A direction
 * that separates rectangle i from the hull of the others can be a normal of an edge of one of the two, or a difference
 * of corners. */
static bool exists(const visitor *v) {
  size_t mark = orc_mark(v->p);
  mpq_srcptr zero = orc_si(v->p, 0, 1), one = orc_si(v->p, 1, 1), minus = orc_si(v->p, -1, 1);
  bool found = holds(v, one, zero) || holds(v, minus, zero) || holds(v, zero, one) || holds(v, zero, minus);
  for (size_t a = 0; a < v->c->n && !found; a++) {
    if (!v->sure && a != v->i && a != v->j) continue;
    for (size_t b = v->sure ? a : 0; b < v->c->n && !found; b++) found = holds_for(v, &v->c->rect[a], &v->c->rect[b]);
  }
  orc_release(v->p, mark);
  return found;
}

static int turn(orc_pool *p, const orc_rect *r[3], int n) {
  mpq_srcptr x[3], y[3];
  for (int k = 0; k < 3; k++) {
    x[k] = r[k]->e[n >> 2 * k & 1];
    y[k] = r[k]->e[2 + (n >> (2 * k + 1) & 1)];
  }
  mpq_srcptr a = orc_mul(p, orc_sub(p, x[1], x[0]), orc_sub(p, y[2], y[0]));
  mpq_srcptr b = orc_mul(p, orc_sub(p, y[1], y[0]), orc_sub(p, x[2], x[0]));
  int order = mpq_cmp(a, b);
  return (order > 0) - (order < 0);
}

/* The sign of all 64 corner choices, 0 when they differ. */
static int sure_turn(orc_pool *p, const orc_case *c, size_t i, size_t j, size_t k) {
  const orc_rect *r[3] = {&c->rect[i], &c->rect[j], &c->rect[k]};
  size_t mark = orc_mark(p);
  int sign = turn(p, r, 0);
  for (int n = 1; n < 64 && sign; n++)
    if (turn(p, r, n) != sign) sign = 0;
  orc_release(p, mark);
  return sign;
}

static dyd_pair_status pair_status(orc_pool *p, const orc_case *c, size_t i, size_t j) {
  const visitor v = {p, c, i, j, false};
  if (!exists(&v)) return DYD_ILLEGAL;
  bool tie = orc_rect_is_point(&c->rect[i]) && orc_rect_is_point(&c->rect[j]),
       legal = !orc_rect_meets(&c->rect[i], &c->rect[j]);
  int side = 0;
  for (size_t k = 0; k < c->n; k++) {
    if (k == i || k == j || is_alias(c, k)) continue;
    int s = sure_turn(p, c, i, j, k);
    legal = legal && s && s + side;
    if (s) side = s;
    if (!s && !orc_rect_is_point(&c->rect[k])) tie = false;
  }
  return legal ? DYD_LEGAL : tie ? DYD_TIE : DYD_INDETERMINATE;
}

/* ---- comparing ---- */

static bool same_list(char *message, const char *what, const dyd_index_list *l, const bool *should, size_t n) {
  size_t at = 0;
  for (size_t i = 0; i < n; i++) {
    bool is = at < l->count && l->item[at] == i;
    if (is != should[i]) return wrong(message, "vertex %zu is %s%s", i, is ? "" : "not ", what);
    at += is;
  }
  return at == l->count || wrong(message, "the %s vertices are not ascending", what);
}

/* The vertices computed alone equal the vertices of the whole answer. */
static void assert_vertices(const dyd_hull *hull, const dyd_delaunay *pd) {
  dyd_hull alone = {0};
  const dyd_index_list *list[2] = {&alone.sure_vertices, &alone.possible_vertices};
  const dyd_index_list *should[2] = {&hull->sure_vertices, &hull->possible_vertices};
  assert_int_equal(dyd_delaunay_partial_hull(&alone, pd, false), DYD_OK);
  for (int k = 0; k < 2; k++) {
    assert_int_equal(list[k]->count, should[k]->count);
    for (size_t q = 0; q < list[k]->count; q++) assert_int_equal(list[k]->item[q], should[k]->item[q]);
  }
  assert_int_equal(alone.pairs.count, 0);
  dyd_hull_clear(&alone);
}

static bool hull_right(char *message, orc_pool *p, const orc_case *c, const dyd_delaunay *pd) {
  dyd_hull hull = {0};
  assert_int_equal(dyd_delaunay_partial_hull(&hull, pd, true), DYD_OK);
  assert_vertices(&hull, pd);
  bool sure[ORC_MAX], possible[ORC_MAX], good = true;
  for (size_t i = 0; i < c->n; i++) {
    visitor v = {p, c, i, i, false};
    possible[i] = !is_alias(c, i) && exists(&v);
    v.sure = true;
    sure[i] = !is_alias(c, i) && exists(&v);
  }
  good = same_list(message, "possible", &hull.possible_vertices, possible, c->n) &&
         same_list(message, "sure", &hull.sure_vertices, sure, c->n);
  size_t at = 0;
  for (uint32_t i = 0; i < c->n && good; i++)
    for (uint32_t j = i + 1; j < c->n && good; j++) {
      dyd_pair_status should = is_alias(c, i) || is_alias(c, j) ? DYD_ILLEGAL : pair_status(p, c, i, j),
                      is = DYD_ILLEGAL;
      if (at < hull.pairs.count && hull.pairs.item[at].i == i && hull.pairs.item[at].j == j)
        is = hull.pairs.item[at++].status;
      if (is != should) good = wrong(message, "hull pair %u %u has %d, should have %d", i, j, (int)is, (int)should);
    }
  if (good && at != hull.pairs.count) good = wrong(message, "the pairs are not sorted");
  dyd_hull_clear(&hull);
  return good;
}

/* Narrows some rectangles and updates. */
static bool narrowed_right(char *message, harness *h, const orc_case *c, dyd_sites *s, dyd_delaunay *pd) {
  orc_case target, now;
  dyd_rect r;
  uint32_t changed[ORC_MAX];
  size_t count = 0;
  orc_case_init(&target);
  orc_case_init(&now);
  dyd_rect_init(&r);
  orc_case_set(&now, c);
  orc_choose(&target, &h->random, c, 3);
  for (size_t i = 0; i < c->n; i++) {
    if (test_chance(&h->random, 2)) continue;
    orc_narrow(&now.rect[i], &h->random, &target.rect[i], test_chance(&h->random, 3));
    harness_rect(&r, &now.rect[i]);
    assert_int_equal(dyd_sites_narrow(s, i, &r), DYD_OK);
    changed[count++] = (uint32_t)i;
  }
  bool coincide = false; /* points that became equal keep their places: not the same as aliases from the start */
  for (size_t i = 0; i < c->n; i++) coincide = coincide || is_alias(&now, i) != is_alias(c, i);
  dyd_status st = dyd_delaunay_update(pd, changed, count, NULL, NULL);
  bool good = st == DYD_OK && (coincide || hull_right(message, &h->pool, &now, pd));
  if (!good) orc_case_print(stderr, &now);
  dyd_rect_clear(&r);
  orc_case_clear(&now);
  orc_case_clear(&target);
  return good;
}

static bool case_right(char *message, harness *h, const orc_case *c) {
  dyd_sites *s = harness_sites(c);
  dyd_delaunay_options exact = {DYD_SIZED(dyd_delaunay_options), .no_filter = true};
  dyd_delaunay *pd = harness_engine(message, s, NULL), *slow = harness_engine(message, s, &exact);
  bool good = pd && slow && hull_right(message, &h->pool, c, pd) && hull_right(message, &h->pool, c, slow) &&
              narrowed_right(message, h, c, s, pd);
  dyd_delaunay_free(slow);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static void test_random_cases(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  for (size_t n = test_cases(60); n; n--) {
    orc_generate(&c, &shared.random, n % ORC_KINDS, 3 + n % 4);
    harness_run(&shared, &c, case_right);
  }
  orc_case_clear(&c);
}

/* Four rectangles from a list in every combination (a share of them at scale 1). */
static void test_grid(void **state) {
  (void)state;
  static const long list[][4] = {{0, 0, 0, 0}, {2, 2, 0, 0}, {4, 4, 0, 0}, {1, 1, 0, 0}, {0, 2, 0, 0}, {2, 2, 1, 3},
                                 {1, 2, 1, 2}, {0, 0, 2, 2}, {2, 2, 2, 2}, {1, 1, 1, 1}, {0, 1, 0, 3}};
  enum { LIST = sizeof list / sizeof *list };
  orc_case c;
  orc_case_init(&c);
  size_t step = test_cases(1) < 60 ? 60 / test_cases(1) : 1, n = 0;
  for (size_t code = 0; code < (size_t)LIST * LIST * LIST * LIST; code++) {
    size_t at[4] = {code % LIST, code / LIST % LIST, code / LIST / LIST % LIST, code / LIST / LIST / LIST};
    if (at[0] > at[1] || at[1] > at[2] || at[2] > at[3] || n++ % step) continue;
    c.n = 0;
    snprintf(c.kind, sizeof c.kind, "grid");
    for (int k = 0; k < 4; k++) orc_case_add(&c, list[at[k]][0], list[at[k]][1], list[at[k]][2], list[at[k]][3], 1);
    harness_run(&shared, &c, case_right);
  }
  for (size_t code = 0; code < (size_t)LIST * LIST; code++) { /* two sites; one */
    c.n = 0;
    for (int k = 0; k < 2; k++) {
      const long *e = list[k ? code / LIST : code % LIST];
      orc_case_add(&c, e[0], e[1], e[2], e[3], 1);
    }
    if (code % LIST == code / LIST) c.n = 1;
    harness_run(&shared, &c, case_right);
  }
  orc_case_clear(&c);
}

/* Four intervals with ends in 0 .. 4, on a horizontal or a vertical line (a share of them at scale 1). */
static void test_lines(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  for (size_t n = test_cases(60); n; n--) {
    bool vertical = test_chance(&shared.random, 2);
    c.n = 0;
    snprintf(c.kind, sizeof c.kind, "line");
    for (int k = 0; k < 4; k++) {
      long a = (long)test_below(&shared.random, 5), b = a + (long)test_below(&shared.random, (uint64_t)(5 - a));
      orc_case_add(&c, vertical ? 0 : a, vertical ? 0 : b, vertical ? a : 0, vertical ? b : 0, 1);
    }
    harness_run(&shared, &c, case_right);
  }
  orc_case_clear(&c);
}

/* ---- large ---- */

static void run_large(const char *what, size_t n, bool circle, double width) {
  dyd_sites *s = NULL;
  dyd_delaunay *pd = NULL;
  dyd_hull hull = {0};
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (size_t i = 0; i < n; i++) {
    double t = 6.283185307179586 * (double)i / (double)n, x = circle ? cos(t) : test_unit(&shared.random);
    double y = circle ? sin(t) : test_unit(&shared.random);
    double x0 = x - width, x1 = x + width, y0 = y - width, y1 = y + width;
    dyd_sites_add_boxes(s, 1, &x0, &x1, &y0, &y1);
  }
  assert_int_equal(dyd_delaunay_new(&pd, s, NULL, NULL), DYD_OK);
  clock_t begun = clock();
  assert_int_equal(dyd_delaunay_partial_hull(&hull, pd, true), DYD_OK);
  double seconds = (double)(clock() - begun) / CLOCKS_PER_SEC;
  size_t legal = 0;
  for (size_t k = 0; k < hull.pairs.count; k++) legal += hull.pairs.item[k].status == DYD_LEGAL;
  fprintf(stderr, "# %zu %s: %zu sure, %zu possible vertices, %zu legal of %zu pairs, %.3f s\n", n, what,
          hull.sure_vertices.count, hull.possible_vertices.count, legal, hull.pairs.count, seconds);
  assert_true(hull.sure_vertices.count <= hull.possible_vertices.count && hull.possible_vertices.count >= 3);
  if (circle && width < 1e-13) assert_int_equal(legal, n);
  dyd_hull_clear(&hull);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void test_large(void **state) {
  (void)state;
  run_large("uniform boxes", 20000, false, 0x1p-30);
  run_large("wide boxes", 2000, false, 0.01);
  run_large("points on a circle", 5000, true, 0);
  run_large("boxes on a circle", 120, true, 1e-14);
}

/* N collinear points have more pairs than a small cap: the vertices are complete, the pairs omitted. */
static void test_cap(void **state) {
  (void)state;
  dyd_sites *s = NULL;
  dyd_delaunay *pd = NULL;
  dyd_hull hull = {0};
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = 100};
  dyd_error err;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (int i = 0; i <= 60; i++) {
    double x = i, y = i == 60;
    dyd_sites_add_points(s, 1, &x, &y);
  }
  assert_true(dyd_delaunay_new(&pd, s, &o, &err) >= 0);
  assert_int_equal(dyd_delaunay_partial_hull(&hull, pd, true), DYD_CAPPED);
  assert_int_equal(hull.pairs.count, 0);
  assert_int_equal(hull.possible_vertices.count, 61);
  assert_int_equal(hull.sure_vertices.count, 3);
  assert_vertices(&hull, pd);
  dyd_hull_clear(&hull);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

/* The vertices do not wait for the pairs: all N^2 / 2 of them on a line, N^2 / 4 of wide boxes. */
static void run_vertices(size_t n, bool line, size_t sure, size_t possible) {
  dyd_sites *s = NULL;
  dyd_delaunay *pd = NULL;
  dyd_hull hull = {0};
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (size_t i = 0; i < n; i++) {
    double x = (double)(i * 7919 % n), y = line ? 0 : 1e9 * (double)(i % 2), x1 = line ? x : x + (double)n;
    dyd_sites_add_boxes(s, 1, &x, &x1, &y, &y);
  }
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = 9};
  assert_true(dyd_delaunay_new(&pd, s, &o, NULL) >= 0);
  clock_t begun = clock();
  assert_int_equal(dyd_delaunay_partial_hull(&hull, pd, false), DYD_OK);
  double seconds = (double)(clock() - begun) / CLOCKS_PER_SEC;
  fprintf(stderr, "# %zu: %zu sure, %zu possible vertices, %.3f s\n", n, hull.sure_vertices.count,
          hull.possible_vertices.count, seconds);
  assert_int_equal(hull.sure_vertices.count, sure);
  assert_int_equal(hull.possible_vertices.count, possible);
  dyd_hull_clear(&hull);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void test_vertices(void **state) {
  (void)state;
  run_vertices(60000, true, 2, 60000);
  run_vertices(600, false, 0, 600);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_random_cases), cmocka_unit_test(test_grid),
                                     cmocka_unit_test(test_lines),        cmocka_unit_test(test_large),
                                     cmocka_unit_test(test_cap),          cmocka_unit_test(test_vertices)};
  harness_init(&shared, "hull");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
