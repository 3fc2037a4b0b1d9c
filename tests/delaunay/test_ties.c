/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Faces of exact points: polygons and chains of many sites, with and without a cap, against the definition in integers
 * [CLO-2] [CLO-3] [TIE-1] [TIE-2].
 *
 * The oracle: with p_i at the origin, D = p_j, N = D turned by a right angle, the centre D/2 + t N is not nearer to K
 * than to i and j iff A - t B >= 0, A = K.K - D.K, B = 2 N.K. Strictly for some t: legal; for some t, or for t = +-inf
 * (B of one sign): possible. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/state.h"
#include "support/random.h"
#include <cmocka.h>
#include <dyadel/delaunay.h>
#include <math.h>
#include <string.h>

enum { MOST = 120 };

typedef struct example {
  size_t n;
  int64_t x[MOST], y[MOST];
  uint32_t alias[MOST];
  dyd_pair_status status[MOST][MOST];
} example;

static void add(example *e, int64_t x, int64_t y) {
  if (e->n < MOST) {
    e->x[e->n] = x;
    e->y[e->n++] = y;
  }
}

/* Integer points at the squared distance r from (a,b), each with a chance of one in `one_in`. */
static void add_circle(example *e, test_random *g, int64_t a, int64_t b, int64_t r, unsigned one_in) {
  for (int64_t x = -60; x <= 60; x++)
    for (int64_t y = -60; y <= 60; y++)
      if (x * x + y * y == r && test_chance(g, one_in)) add(e, a + x, b + y);
}

static void add_grid(example *e, test_random *g, int64_t side, unsigned one_in) {
  for (int64_t x = 0; x < side; x++)
    for (int64_t y = 0; y < side; y++)
      if (!test_chance(g, one_in)) add(e, 3 * x, 3 * y);
}

static void make(example *e, test_random *g) {
  static const int64_t radius[6] = {25, 65, 325, 425, 1105, 2125};
  e->n = 0;
  switch (test_below(g, 5)) {
  case 0:
    add_grid(e, g, 3 + (int64_t)test_below(g, 4), 2 + (unsigned)test_below(g, 30));
    break;
  case 1:
    add_circle(e, g, 0, 0, radius[test_below(g, 6)], 1 + (unsigned)test_below(g, 2));
    break;
  case 2:
    for (int q = 0; q < 3; q++)
      add_circle(e, g, test_between(g, -9, 9), test_between(g, -60, 60), radius[test_below(g, 6)], 2);
    break;
  case 3: /* chains on the hull */
    for (int64_t x = 0; x < 30; x++) add(e, x * (1 + (int64_t)test_below(g, 2)), 0);
    for (int64_t x = 0; x < 12; x++) add(e, test_between(g, 0, 20), test_between(g, 0, 3));
    break;
  default:
    for (int q = 0; q < 12; q++) add(e, test_between(g, 0, 4), test_between(g, 0, 4));
  }
  for (int q = 0; q < 3; q++) add(e, test_between(g, -5, 5), test_between(g, -5, 5));
  for (size_t i = e->n; i > 1; i--) {
    size_t k = (size_t)test_below(g, i);
    int64_t x = e->x[k], y = e->y[k];
    e->x[k] = e->x[i - 1], e->y[k] = e->y[i - 1];
    e->x[i - 1] = x, e->y[i - 1] = y;
  }
}

typedef struct range {
  int64_t lo[2], hi[2]; /* numerator, denominator > 0; denominator 0: infinite */
} range;

static dyd_pair_status status_of(const example *e, size_t i, size_t j) {
  range t = {{0, 0}, {0, 0}};
  bool left = true, right = true, between = false;
  int64_t dx = e->x[j] - e->x[i], dy = e->y[j] - e->y[i];
  for (size_t k = 0; k < e->n; k++) {
    int64_t kx = e->x[k] - e->x[i], ky = e->y[k] - e->y[i];
    if ((!kx && !ky) || (kx == dx && ky == dy)) continue;
    int64_t a = kx * kx + ky * ky - dx * kx - dy * ky, b = 2 * (dx * ky - dy * kx);
    left = left && b <= 0;
    right = right && b >= 0;
    between = between || (b == 0 && a < 0);
    if (b > 0 && (!t.hi[1] || a * t.hi[1] < t.hi[0] * b)) t.hi[0] = a, t.hi[1] = b;
    if (b < 0 && (!t.lo[1] || -a * t.lo[1] > t.lo[0] * -b)) t.lo[0] = -a, t.lo[1] = -b;
  }
  int64_t room = t.lo[1] && t.hi[1] ? t.hi[0] * t.lo[1] - t.lo[0] * t.hi[1] : 1;
  if (!between && room > 0) return DYD_LEGAL;
  return left || right || (!between && room == 0) ? DYD_TIE : DYD_ILLEGAL;
}

static void settle(example *e) {
  for (uint32_t i = 0; i < e->n; i++) {
    e->alias[i] = i;
    for (uint32_t j = i; j-- > 0;)
      if (e->x[i] == e->x[j] && e->y[i] == e->y[j]) e->alias[i] = j;
  }
  for (uint32_t i = 0; i < e->n; i++)
    for (uint32_t j = 0; j < e->n; j++) e->status[i][j] = e->alias[i] == e->alias[j] ? DYD_ILLEGAL : status_of(e, i, j);
}

static dyd_sites *sites_of(const example *e) {
  dyd_sites *s = NULL;
  double x[MOST], y[MOST];
  for (size_t i = 0; i < e->n; i++) {
    x[i] = (double)e->x[i];
    y[i] = (double)e->y[i];
  }
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  assert_int_equal(dyd_sites_add_points(s, e->n, x, y), DYD_OK);
  return s;
}

/* ---- without a cap ---- */

static bool is_own(const example *e, uint32_t i) {
  return e->alias[i] == i;
}

static void check_pairs(const example *e, const dyd_delaunay *pd) {
  dyd_pair_list l = {0};
  size_t count[4], want[4] = {0}, k = 0;
  assert_int_equal(dyd_delaunay_pairs(&l, pd), DYD_OK);
  for (uint32_t i = 0; i < e->n; i++)
    for (uint32_t j = 0; j < e->n; j++) {
      dyd_pair_status s = e->status[i][j];
      assert_int_equal(dyd_delaunay_status(pd, i, j), s);
      if (j <= i || !is_own(e, i) || !is_own(e, j) || s == DYD_ILLEGAL) continue;
      assert_true(k < l.count && l.item[k].i == i && l.item[k].j == j && l.item[k].status == s);
      want[s]++;
      k++;
    }
  assert_int_equal(k, l.count);
  dyd_delaunay_count(count, pd);
  assert_memory_equal(count, want, sizeof count);
  dyd_pair_list_clear(&l);
}

static void check_neighbours(const example *e, const dyd_delaunay *pd) {
  for (uint32_t i = 0; i < e->n; i++)
    for (int least = DYD_TIE; least <= DYD_LEGAL; least++) {
      dyd_index_list l = {0};
      size_t k = 0;
      assert_int_equal(dyd_delaunay_neighbours(&l, pd, i, (dyd_pair_status)least), DYD_OK);
      for (uint32_t j = 0; j < e->n; j++)
        if (is_own(e, j) && (int)e->status[i][j] >= least) assert_true(k < l.count && l.item[k++] == j);
      assert_int_equal(k, l.count);
      dyd_index_list_clear(&l);
    }
}

/* A face has all ties among its sites; each tie is in one face; only chains are outer. */
static void check_faces(const example *e, const dyd_delaunay *pd) {
  size_t ties[4], seen = 0;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd); f++) {
    dyd_index_list sites = {0};
    dyd_pair_list pairs = {0};
    bool outer;
    size_t k = 0;
    assert_int_equal(dyd_delaunay_face(&sites, &outer, pd, f), DYD_OK);
    assert_int_equal(dyd_delaunay_face_pairs(&pairs, pd, f), DYD_OK);
    for (size_t a = 0; a < sites.count; a++)
      for (size_t b = a + 1; b < sites.count; b++) {
        uint32_t i = sites.item[a], j = sites.item[b];
        assert_true(i < j && is_own(e, i) && is_own(e, j) && e->status[i][j] != DYD_ILLEGAL);
        if (e->status[i][j] == DYD_LEGAL) continue;
        assert_true(k < pairs.count && pairs.item[k].i == i && pairs.item[k].j == j && pairs.item[k].status == DYD_TIE);
        k++;
      }
    assert_int_equal(k, pairs.count);
    uint32_t u = sites.item[0], v = sites.item[1], w = sites.item[2];
    int64_t turn = (e->x[v] - e->x[u]) * (e->y[w] - e->y[u]) - (e->y[v] - e->y[u]) * (e->x[w] - e->x[u]);
    assert_int_equal(outer, turn == 0);
    seen += k;
    dyd_index_list_clear(&sites);
    dyd_pair_list_clear(&pairs);
  }
  dyd_delaunay_count(ties, pd);
  assert_int_equal(seen, ties[DYD_TIE]);
}

/* ---- with a cap ---- */

/* Ties are no stored pairs: the least cap changes nothing. */
static void check_cap(const dyd_sites *s, const dyd_delaunay *free) {
  dyd_delaunay *pd = NULL;
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = 1};
  dyd_pair_list want = {0}, l = {0};
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, NULL), DYD_OK);
  assert_false(dyd_delaunay_is_capped(pd));
  assert_int_equal(dyd_delaunay_pairs(&want, free), DYD_OK);
  assert_int_equal(dyd_delaunay_pairs(&l, pd), DYD_OK);
  assert_int_equal(l.count, want.count);
  for (size_t q = 0; q < l.count; q++)
    assert_true(l.item[q].i == want.item[q].i && l.item[q].j == want.item[q].j &&
                l.item[q].status == want.item[q].status);
  dyd_pair_list_clear(&l);
  dyd_pair_list_clear(&want);
  dyd_delaunay_free(pd);
}

static bool is_line(const example *e) {
  for (size_t k = 0; k < e->n; k++)
    for (size_t q = 0; q < k; q++) {
      int64_t x = e->x[k] - e->x[0], y = e->y[k] - e->y[0];
      if (x * (e->y[q] - e->y[0]) != y * (e->x[q] - e->x[0])) return false;
    }
  return true;
}

static void test_definition(void **state) {
  (void)state;
  test_random g = test_random_start("ties");
  example *e = malloc(sizeof *e);
  size_t undecided = 0;
  assert_non_null(e);
  for (size_t q = 0; q < test_cases(400); q++) {
    dyd_delaunay *pd = NULL;
    dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = test_chance(&g, 8)};
    size_t count[4];
    make(e, &g);
    if (is_line(e)) continue;
    settle(e);
    dyd_sites *s = sites_of(e);
    assert_int_equal(dyd_delaunay_new(&pd, s, &o, NULL), DYD_OK);
    check_pairs(e, pd);
    check_neighbours(e, pd);
    check_faces(e, pd);
    dyd_delaunay_count(count, pd);
    undecided += count[DYD_TIE];
    check_cap(s, pd);
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
  }
  assert_true(undecided > 1000);
  free(e);
}

/* More than 256 sites, so that site numbers have several digits: the list is sorted, and as long as counted. */
static void test_large_grid(void **state) {
  enum { SIDE = 27 };
  double x[SIDE * SIDE], y[SIDE * SIDE];
  size_t n = SIDE * SIDE, count[4], cells = (SIDE - 1) * (SIDE - 1), chain = (SIDE - 1) * (SIDE - 2) / 2;
  dyd_sites *s = NULL;
  dyd_delaunay *pd = NULL;
  dyd_pair_list l = {0};
  (void)state;
  for (size_t i = 0, k = 0; i < n; i++, k = (k + 100) % n) { /* 100 is prime to the number of sites */
    x[i] = (double)(k % SIDE);
    y[i] = (double)(k / SIDE);
  }
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  assert_int_equal(dyd_sites_add_points(s, n, x, y), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, s, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_delaunay_pairs(&l, pd), DYD_OK);
  dyd_delaunay_count(count, pd);
  assert_int_equal(count[DYD_LEGAL], 2 * SIDE * (SIDE - 1));
  assert_int_equal(count[DYD_TIE], 2 * cells + 4 * chain);
  assert_int_equal(l.count, count[DYD_LEGAL] + count[DYD_TIE]);
  for (size_t q = 0; q < l.count; q++) {
    dyd_pair p = l.item[q], before = l.item[q ? q - 1 : 0];
    assert_true(p.i < p.j && p.status == dyd_delaunay_status(pd, p.i, p.j));
    if (q) assert_true(before.i < p.i || (before.i == p.i && before.j < p.j));
  }
  dyd_pair_list_clear(&l);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

/* ---- a callback that proves everything ---- */

typedef struct asked {
  size_t times, most;
} asked;

static dyd_status prove_all(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                            dyd_error *err) {
  asked *a = user;
  (void)err;
  assert_true(relation == DYD_COLLINEAR || relation == DYD_COCIRCULAR);
  for (size_t q = 0; q < count; q++)
    for (size_t k = 0; k < q; k++) assert_int_not_equal(site[k], site[q]);
  a->times++;
  if (count > a->most) a->most = count;
  *proved = true;
  return DYD_OK;
}

/* x0, x1, y0, y1 of n boxes, with the callback that proves everything. */
static asked ask_boxes(size_t count[4], size_t n, double *const end[4], size_t most) {
  asked a = {0, 0};
  dyd_sites *s = NULL;
  dyd_delaunay *pd = NULL;
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .prove = prove_all, .prove_user = &a, .max_pairs = most};
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(s, n, end[0], end[1], end[2], end[3]), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, s, &o, NULL), most ? DYD_CAPPED : DYD_OK);
  dyd_delaunay_count(count, pd);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return a;
}

/* A hexagon of small boxes about `inside` large ones. most: cap on pairs, 0: no cap. */
static asked ask_hexagon(size_t ties[4], size_t inside, size_t most) {
  static const double cx[6] = {100, 50, -50, -100, -50, 50}, cy[6] = {0, 87, 87, 0, -87, -87};
  double x0[9], x1[9], y0[9], y1[9];
  for (size_t q = 0; q < 6 + inside; q++) {
    double half = q < 6 ? 1 : 40, x = q < 6 ? cx[q] : (double)q, y = q < 6 ? cy[q] : -(double)q;
    x0[q] = x - half, x1[q] = x + half, y0[q] = y - half, y1[q] = y + half;
  }
  return ask_boxes(ties, 6 + inside, (double *const[]){x0, x1, y0, y1}, most);
}

/* A face is asked about where its rim passes through all of its vertices, and is closed where some are inside. */
static void test_prover(void **state) {
  size_t count[4];
  (void)state;
  asked a = ask_hexagon(count, 0, 0);
  assert_int_equal(a.times, 1);
  assert_int_equal(a.most, 6);
  assert_int_equal(count[DYD_TIE], 9);
  assert_int_equal(count[DYD_INDETERMINATE], 0);
  a = ask_hexagon(count, 3, 0);
  assert_int_equal(a.times, 0);
  assert_int_equal(count[DYD_TIE], 0);
  assert_true(count[DYD_INDETERMINATE] > 18);
  a = ask_hexagon(count, 0, 5); /* its pairs would not be stored: the callback is not called */
  assert_int_equal(a.times, 0);
  assert_int_equal(count[DYD_TIE], 0);
  assert_int_equal(count[DYD_INDETERMINATE], 3);
}

/* Points of the circle x^2 + y^2 = 65^2, one of which is a small box, and points far from it: the face is asked about,
 * whatever vertex its rim begins with. */
static void test_prover_of_one_box(void **state) {
  (void)state;
  test_random r = test_random_start("one box");
  for (size_t k = test_cases_all(800); k; k--) {
    double end[4][46];
    size_t n = 0, count[4];
    for (int x = -65; x <= 65; x++)
      for (int y = -65; y <= 65; y++) {
        if (x * x + y * y != 65 * 65 || (n > 3 && !test_chance(&r, 4))) continue;
        end[0][n] = end[1][n] = x;
        end[2][n] = end[3][n] = y;
        n++;
      }
    end[1][test_below(&r, n)] += 0x1p-20;
    size_t rim = n;
    for (size_t far = test_below(&r, 10); far; far--, n++) {
      double turn = 6.28 * test_unit(&r), away = 300 + 100 * test_unit(&r);
      end[0][n] = end[1][n] = away * cos(turn);
      end[2][n] = end[3][n] = away * sin(turn);
    }
    asked a = ask_boxes(count, n, (double *const[]){end[0], end[1], end[2], end[3]}, 0);
    assert_int_equal(a.times, 1);
    assert_int_equal(count[DYD_TIE], rim * (rim - 3) / 2);
  }
}

/* About a rim that passes twice through its least vertex, which is not a polygon, the callback is not called (see
 * prove_all); about the other face it is. */
static void test_pinched_rim(void **state) {
  double x0[] = {12, 0, 4, 0, 8, 0, 4, 8}, x1[] = {12, 3, 4, 3, 8, 0, 4, 11}, y0[] = {0, 4, 8, 8, 8, 12, 0, 12},
         y1[] = {0, 4, 12, 11, 8, 13, 0, 13};
  size_t count[4];
  (void)state;
  asked a = ask_boxes(count, 8, (double *const[]){x0, x1, y0, y1}, 0);
  assert_int_equal(a.times, 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_definition), cmocka_unit_test(test_large_grid),
                                     cmocka_unit_test(test_prover), cmocka_unit_test(test_prover_of_one_box),
                                     cmocka_unit_test(test_pinched_rim)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
