/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Nearest sites against a literal oracle in exact rationals: points and rectangles, all generators of trouble, with and
 * without filters, on touching and tied queries [NEAR-1] [NEAR-2]; a grid of every small case; large inputs against all
 * distances in doubles that are exact. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include <cmocka.h>
#include <dyadel/voronoi.h>
#include <math.h>
#include <string.h>
#include <time.h>

static harness shared;

/* ---- the oracle ---- */

static bool is_alias(const orc_case *c, size_t k) {
  return orc_case_alias(c, k) != k;
}

/* ds_i <= dl_k at the point, for all k. */
static bool possible_at(orc_pool *p, const orc_case *c, size_t i, orc_point at) {
  orc_alg d = orc_ds2(p, at, &c->rect[i]);
  for (size_t k = 0; k < c->n; k++)
    if (k != i && !is_alias(c, k) && orc_alg_sgn(p, orc_alg_sub(p, d, orc_dl2(p, at, &c->rect[k]))) > 0) return false;
  return true;
}

static orc_point on_side(orc_pool *p, int axis, orc_alg t, mpq_srcptr across) {
  orc_alg a = {across, orc_si(p, 0, 1), t.c};
  return axis == 0 ? (orc_point){t, a} : (orc_point){a, t};
}

/* Tries the place t on the side if it is one, q's side [lo,hi]. */
static bool try_place(orc_pool *p, const orc_case *c, size_t i, int axis, const mpq_t *q, mpq_srcptr across,
                      orc_alg t) {
  if (orc_alg_cmp_q(p, t, q[2 * axis]) < 0 || orc_alg_cmp_q(p, t, q[2 * axis + 1]) > 0) return false;
  return possible_at(p, c, i, on_side(p, axis, t, across));
}

/* Distance across, squared, from one end: (across - at)^2, 0 for at = NULL. */
static mpq_srcptr square_to(orc_pool *p, mpq_srcptr across, mpq_srcptr at) {
  return at ? orc_sqr(p, orc_sub(p, across, at)) : orc_si(p, 0, 1);
}

/* All t with (t - s)^2 + u = (t - e)^2 + v, e = NULL: v alone. */
static size_t solve(orc_alg out[2], orc_pool *p, mpq_srcptr s, mpq_srcptr u, mpq_srcptr e, mpq_srcptr v) {
  mpq_srcptr w = orc_sub(p, v, u);
  if (!e) {
    if (mpq_sgn(w) < 0) return 0;
    out[0] = (orc_alg){s, orc_si(p, 1, 1), w};
    out[1] = (orc_alg){s, orc_si(p, -1, 1), w};
    return 2;
  }
  mpq_srcptr m = orc_twice(p, orc_sub(p, e, s)); /* m t = e^2 + v - s^2 - u */
  if (!mpq_sgn(m)) return 0;
  out[0] = orc_alg_q(p, orc_div(p, orc_add(p, orc_sub(p, orc_sqr(p, e), orc_sqr(p, s)), w), m));
  return 1;
}

/* The closed set Pos_i on a side, if it is not empty, has a first point: the side's beginning, or a zero of some
 * dl_k^2 - ds_i^2. Every root of every piece is tried, wherever it lies. */
static bool side_meets(orc_pool *p, const orc_case *c, size_t i, int axis, const mpq_t *q, mpq_srcptr across) {
  if (try_place(p, c, i, axis, q, across, orc_alg_q(p, q[2 * axis]))) return true;
  orc_piece near_t[3], near_o[3], far_t[2], far_o[2];
  size_t a = orc_pieces_closest(near_t, p, &c->rect[i].e[2 * axis]);
  size_t b = orc_pieces_closest(near_o, p, &c->rect[i].e[2 - 2 * axis]);
  for (size_t k = 0; k < c->n; k++) {
    if (k == i || is_alias(c, k)) continue;
    size_t f = orc_pieces_farthest(far_t, p, &c->rect[k].e[2 * axis]);
    size_t g = orc_pieces_farthest(far_o, p, &c->rect[k].e[2 - 2 * axis]);
    for (size_t n = 0; n < a * b * f * g; n++) {
      orc_alg t[2];
      mpq_srcptr u = square_to(p, across, far_o[n / a / b / f].at), v = square_to(p, across, near_o[n / a % b].at);
      size_t count = solve(t, p, far_t[n / a / b % f].at, u, near_t[n % a].at, v);
      for (size_t r = 0; r < count; r++)
        if (try_place(p, c, i, axis, q, across, t[r])) return true;
    }
  }
  return false;
}

static bool listed(orc_pool *p, const orc_case *c, size_t i, const orc_rect *q) {
  if (is_alias(c, i)) return false;
  if (orc_rect_meets(&c->rect[i], q)) return true;
  for (int n = 0; n < 4; n++)
    if (side_meets(p, c, i, n < 2, q->e, q->e[n])) return true;
  return false;
}

/* Returns true if q is inside Int_i: dl_i < ds_k at its corners. */
static bool inside(orc_pool *p, const orc_case *c, size_t i, const orc_rect *q) {
  for (int corner = 0; corner < 4; corner++) {
    orc_point at = {orc_alg_q(p, q->e[corner & 1]), orc_alg_q(p, q->e[2 + corner / 2])};
    orc_alg d = orc_dl2(p, at, &c->rect[i]);
    for (size_t k = 0; k < c->n; k++)
      if (k != i && !is_alias(c, k) && orc_alg_sgn(p, orc_alg_sub(p, d, orc_ds2(p, at, &c->rect[k]))) >= 0)
        return false;
  }
  return true;
}

/* ---- comparing ---- */

static void print_query(const orc_rect *q) {
  gmp_fprintf(stderr, "query [%Qd,%Qd] x [%Qd,%Qd]\n", q->e[0], q->e[1], q->e[2], q->e[3]);
}

static bool is_dyadic(const mpq_t x) {
  return mpz_popcount(mpq_denref(x)) == 1;
}

/* One query by rectangle. */
static void ask(dyd_index_list *out, bool *sure, const dyd_delaunay *pd, const orc_rect *q) {
  dyd_rect r;
  dyd_rect_init(&r);
  harness_rect(&r, q);
  assert_int_equal(dyd_nearest(out, sure, pd, &r), DYD_OK);
  dyd_rect_clear(&r);
}

static bool query_right(char *message, orc_pool *p, const orc_case *c, const dyd_delaunay *pd, const orc_rect *q) {
  dyd_index_list found = {0};
  bool sure, good = true, only = false;
  ask(&found, &sure, pd, q);
  size_t at = 0;
  for (size_t i = 0; i < c->n && good; i++) {
    size_t mark = orc_mark(p);
    bool is = at < found.count && found.item[at] == i, should = listed(p, c, i, q);
    if (is != should) good = wrong(message, "site %zu is %slisted", i, is ? "" : "not ");
    only = only || (!is_alias(c, i) && inside(p, c, i, q));
    at += is;
    orc_release(p, mark);
  }
  if (good && at != found.count) good = wrong(message, "the list is not ascending");
  if (good && sure != only) good = wrong(message, "sure is %d", sure);
  if (!good) print_query(q);
  dyd_index_list_clear(&found);
  return good;
}

/* ---- queries ---- */

/* A coordinate biased to trouble: an end or middle of some rectangle, the middle between two, or near one. */
static void coordinate(mpq_t out, test_random *r, const orc_case *c, int axis) {
  const mpq_t *a = &c->rect[test_below(r, c->n)].e[2 * axis], *b = &c->rect[test_below(r, c->n)].e[2 * axis];
  mpq_set(out, a[test_below(r, 2)]);
  unsigned kind = (unsigned)test_below(r, 4);
  if (kind == 0) return;
  mpq_add(out, out, b[test_below(r, 2)]);
  mpq_div_2exp(out, out, 1);
  if (kind == 1) return;
  mpq_t t, d; /* a multiple of a sixteenth of a distance away */
  mpq_inits(t, d, NULL);
  mpq_sub(d, a[0], b[1]);
  mpq_set_si(t, (long)test_between(r, -40, 40), 16);
  mpq_canonicalize(t);
  mpq_mul(t, t, d);
  mpq_add(out, out, t);
  mpq_clears(t, d, NULL);
}

static void side_of_query(mpq_t *e, test_random *r, const orc_case *c, int axis, bool point) {
  coordinate(e[0], r, c, axis);
  coordinate(e[1], r, c, axis);
  if (point) mpq_set(e[1], e[0]);
  if (mpq_cmp(e[0], e[1]) > 0) mpq_swap(e[0], e[1]);
  if (is_dyadic(e[0]) && is_dyadic(e[1])) return;
  mpq_set(e[1], e[0]); /* the library knows rational points, but dyadic ends only */
}

static void query_init(orc_rect *q) {
  for (int n = 0; n < 4; n++) mpq_init(q->e[n]);
}
static void query_clear(orc_rect *q) {
  for (int n = 0; n < 4; n++) mpq_clear(q->e[n]);
}

/* Many places in one call, near and far from one another: each answer is that of dyd_nearest [NEAR-7]. */
static bool places_right(char *message, test_random *r, const orc_case *c, const dyd_delaunay *pd) {
  enum { PLACES = 24 };
  double xy[2 * PLACES];
  dyd_place_list all = {0};
  dyd_rect at;
  mpq_t e;
  bool good = true;
  mpq_init(e);
  dyd_rect_init(&at);
  for (size_t k = 0; k < 2 * PLACES; k++) {
    coordinate(e, r, c, (int)(k & 1));
    xy[k] = isfinite(mpq_get_d(e)) ? mpq_get_d(e) : (double)k;
  }
  assert_int_equal(dyd_nearest_places(&all, pd, xy, PLACES, NULL), DYD_OK);
  for (size_t k = 0; k < PLACES && good; k++) {
    dyd_index_list found = {0};
    bool sure;
    size_t begin = k ? all.end[k - 1] : 0;
    assert_int_equal(dyd_rect_set_d(&at, xy[2 * k], xy[2 * k], xy[2 * k + 1], xy[2 * k + 1]), DYD_OK);
    assert_int_equal(dyd_nearest(&found, &sure, pd, &at), DYD_OK);
    good = all.end[k] - begin == found.count && all.sure[k] == sure &&
           (!found.count || memcmp(&all.site[begin], found.item, found.count * sizeof *found.item) == 0);
    if (!good) wrong(message, "place %zu, (%a, %a), of many has another answer", k, xy[2 * k], xy[2 * k + 1]);
    dyd_index_list_clear(&found);
  }
  dyd_place_list_clear(&all);
  dyd_rect_clear(&at);
  mpq_clear(e);
  return good;
}

static bool case_right(char *message, harness *h, const orc_case *c) {
  dyd_sites *s = harness_sites(c);
  dyd_delaunay_options exact = {DYD_SIZED(dyd_delaunay_options), .no_filter = true};
  dyd_delaunay *pd = harness_engine(message, s, NULL), *slow = harness_engine(message, s, &exact);
  bool good = pd && slow;
  orc_rect q;
  query_init(&q);
  for (int n = 0; n < 8 && good; n++) {
    unsigned shape = (unsigned)test_below(&h->random, 4);
    side_of_query(&q.e[0], &h->random, c, 0, shape & 1);
    side_of_query(&q.e[2], &h->random, c, 1, shape & 2);
    size_t mark = orc_mark(&h->pool);
    good = query_right(message, &h->pool, c, pd, &q) && query_right(message, &h->pool, c, slow, &q);
    orc_release(&h->pool, mark);
    h->pairs++;
  }
  good = good && places_right(message, &h->random, c, pd) && places_right(message, &h->random, c, slow);
  query_clear(&q);
  dyd_delaunay_free(slow);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static void test_random_cases(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  for (size_t n = test_cases(500); n; n--) {
    orc_generate(&c, &shared.random, n % ORC_KINDS, 3 + n % 7);
    harness_run(&shared, &c, case_right);
  }
  orc_case_clear(&c);
}

/* Every pair of sites from a list of small rectangles beside a fixed one, every query with corners on a small grid. */
static bool grid_right(char *message, harness *h, const orc_case *c) {
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  bool good = pd;
  orc_rect q;
  query_init(&q);
  for (long n = 0; n < 256 && good; n++) {
    long x = n & 3, w = n >> 2 & 3, y = n >> 4 & 3, v = n >> 6;
    long e[4] = {x, x + w, y, y + v};
    for (int k = 0; k < 4; k++) mpq_set_si(q.e[k], e[k], 1);
    size_t mark = orc_mark(&h->pool);
    good = query_right(message, &h->pool, c, pd, &q);
    orc_release(&h->pool, mark);
  }
  good = good && places_right(message, &h->random, c, pd);
  query_clear(&q);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static void test_grid(void **state) {
  (void)state;
  static const long list[][4] = {{0, 0, 0, 0}, {2, 2, 0, 0}, {1, 1, 1, 1}, {0, 2, 0, 0}, {0, 0, 1, 3},
                                 {1, 2, 1, 2}, {0, 3, 1, 2}, {4, 5, 0, 3}, {2, 2, 4, 4}, {0, 4, 0, 4}};
  enum { LIST = sizeof list / sizeof *list };
  orc_case c;
  orc_case_init(&c);
  for (size_t a = 0; a < LIST; a++)
    for (size_t b = a; b < LIST; b++) {
      if ((a * LIST + b) % 8 && test_cases(1) < 4) continue;
      c.n = 0;
      snprintf(c.kind, sizeof c.kind, "grid");
      orc_case_add(&c, 3, 3, 2, 2, 1);
      orc_case_add(&c, list[a][0], list[a][1], list[a][2], list[a][3], 1);
      orc_case_add(&c, list[b][0], list[b][1], list[b][2], list[b][3], 1);
      harness_run(&shared, &c, grid_right);
    }
  orc_case_clear(&c);
}

/* A wide rectangle above, two or three blockers below it: on the query, a segment under the rectangle, they block |x -
 * a| < sqrt(4 - b^2), so ends of intervals are surds and the result depends on the intervals' overlaps. */
static bool shelf_right(char *message, harness *h, const orc_case *c) {
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  bool good = pd;
  orc_rect q;
  query_init(&q);
  for (long n = 0; n < 30 && good; n++) {
    mpq_set_si(q.e[0], n % 6, 1);
    mpq_set_si(q.e[1], n % 6 + n / 6, 1);
    size_t mark = orc_mark(&h->pool);
    good = query_right(message, &h->pool, c, pd, &q);
    orc_release(&h->pool, mark);
  }
  query_clear(&q);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static void test_shelf(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  snprintf(c.kind, sizeof c.kind, "shelf");
  for (size_t n = test_cases(80); n; n--) {
    c.n = 0;
    orc_case_add(&c, 0, 12, 4, 5, 2); /* in halves */
    for (size_t k = 1 + n % 3; k; k--) {
      long a = (long)test_between(&shared.random, 0, 12), b = (long)test_between(&shared.random, -4, 2);
      orc_case_add(&c, a, a, b, b, 2);
    }
    harness_run(&shared, &c, shelf_right);
  }
  orc_case_clear(&c);
}

/* ---- large ---- */

static void box_of(double e[4], test_random *r, bool points) {
  for (int a = 0; a < 2; a++) {
    double x = (double)test_below(r, 1 << 20), w = points ? 0 : (double)test_below(r, 300);
    e[2 * a] = x;
    e[2 * a + 1] = x + w;
  }
}

static double ds2(double x, double y, const double e[4]) {
  double dx = x < e[0] ? e[0] - x : x > e[1] ? x - e[1] : 0, dy = y < e[2] ? e[2] - y : y > e[3] ? y - e[3] : 0;
  return dx * dx + dy * dy;
}
static double dl2(double x, double y, const double e[4]) {
  double dx = x - e[0] > e[1] - x ? x - e[0] : e[1] - x, dy = y - e[2] > e[3] - y ? y - e[2] : e[3] - y;
  return dx * dx + dy * dy;
}

/* Coordinates are integers below 2^22: squares in doubles are exact. */
static void run_large(bool points, size_t n, size_t queries) {
  test_random *r = &shared.random;
  double(*e)[4] = malloc(n * sizeof *e);
  dyd_sites *s = NULL;
  dyd_delaunay *pd = NULL;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (size_t i = 0; i < n; i++) {
    box_of(e[i], r, points);
    if (points)
      dyd_sites_add_points(s, 1, &e[i][0], &e[i][2]);
    else
      dyd_sites_add_boxes(s, 1, &e[i][0], &e[i][1], &e[i][2], &e[i][3]);
  }
  assert_int_equal(dyd_delaunay_new(&pd, s, NULL, NULL), DYD_OK);
  double seconds = 0;
  size_t output = 0, many = 0;
  double *xy = malloc(2 * queries * sizeof *xy);
  dyd_place_list all = {0};
  for (size_t k = 0; k < 2 * queries; k++) xy[k] = (double)test_between(r, -100000, (1 << 20) + 100000);
  assert_int_equal(dyd_nearest_places(&all, pd, xy, queries, NULL), DYD_OK);
  for (size_t k = 0; k < queries; k++) {
    double x = xy[2 * k], y = xy[2 * k + 1];
    dyd_rect c;
    dyd_rect_init(&c);
    dyd_rect_set_d(&c, x, x, y, y);
    dyd_index_list found = {0};
    bool sure;
    clock_t begun = clock();
    assert_int_equal(dyd_nearest(&found, &sure, pd, &c), DYD_OK);
    seconds += (double)(clock() - begun) / CLOCKS_PER_SEC;
    output += found.count;
    double least = dl2(x, y, e[0]);
    for (size_t i = 1; i < n; i++) least = dl2(x, y, e[i]) < least ? dl2(x, y, e[i]) : least;
    size_t at = 0;
    for (uint32_t i = 0; i < n; i++) {
      if (ds2(x, y, e[i]) > least || dyd_delaunay_alias(pd, i) != i) continue;
      assert_true(at < found.count && found.item[at] == i && all.site[many + at] == i);
      at++;
    }
    assert_int_equal(at, found.count);
    assert_true(all.end[k] == (many += at) && all.sure[k] == sure);
    dyd_index_list_clear(&found);
    dyd_rect_clear(&c);
  }
  fprintf(stderr, "# %zu %s: %.2f us a query, %.2f sites listed\n", n, points ? "points" : "boxes",
          1e6 * seconds / (double)queries, (double)output / (double)queries);
  dyd_place_list_clear(&all);
  free(xy);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  free(e);
}

static void test_large(void **state) {
  (void)state;
  run_large(true, 20000, test_cases(300));
  run_large(false, 20000, test_cases(300));
}

static void test_few(void **state) {
  (void)state;
  dyd_sites *s = NULL;
  dyd_delaunay *pd = NULL;
  dyd_index_list found = {0};
  bool sure = true;
  dyd_rect c;
  dyd_rect_init(&c);
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, s, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_nearest(&found, &sure, pd, &c), DYD_OK);
  assert_true(found.count == 0 && !sure);
  dyd_delaunay_free(pd);
  const double x[3] = {5, 5, 7}, y[3] = {1, 1, 1};
  dyd_sites_add_points(s, 2, x, y);
  assert_int_equal(dyd_delaunay_new(&pd, s, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_nearest(&found, &sure, pd, &c), DYD_OK);
  assert_true(found.count == 1 && found.item[0] == 0 && sure);
  dyd_place_list all = {0};
  const volatile int cancelled = 1;
  assert_int_equal(dyd_nearest_places(&all, pd, (double[]){5, 1, 7, 1}, 2, NULL), DYD_OK);
  assert_true(all.places == 2 && all.end[1] == 2 && all.site[0] == 0 && all.site[1] == 0);
  assert_int_equal(dyd_nearest_places(&all, pd, (double[]){5, NAN, 7, 1}, 2, NULL), DYD_E_ARG);
  assert_int_equal(dyd_nearest_places(&all, pd, (double[]){5, 1, 7, 1}, 2, &cancelled), DYD_CANCELLED);
  assert_int_equal(dyd_nearest_places(&all, NULL, NULL, 0, NULL), DYD_E_ARG);
  assert_true(all.places == 2);
  assert_int_equal(dyd_nearest_places(&all, pd, NULL, 0, NULL), DYD_OK);
  assert_true(all.places == 0);
  dyd_place_list_clear(&all);
  dyd_delaunay_free(pd);
  dyd_index_list_clear(&found);
  dyd_rect_clear(&c);
  dyd_sites_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_few), cmocka_unit_test(test_random_cases),
                                     cmocka_unit_test(test_grid), cmocka_unit_test(test_shelf),
                                     cmocka_unit_test(test_large)};
  harness_init(&shared, "nearest");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
