/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Outputs as inputs: Voronoi vertices, combinations, streams taken out of engines, their life times
 * [VTX-1] [CMB-1]. */
#include "rect/rect.h"
#include "support/compose.h"
#include "voronoi/streams.h"

#include <dyadel/arc.h>
#include <flint/flint.h>

static test_random shared;

/* ---- vertices ---- */

static void ends(mpq_t e[4], const dyd_rect *r) {
  dyd_interval_get_q(e[0], e[1], &r->x);
  dyd_interval_get_q(e[2], e[3], &r->y);
}

static void init4(mpq_t e[4]) {
  for (int n = 0; n < 4; n++) mpq_init(e[n]);
}
static void clear4(mpq_t e[4]) {
  for (int n = 0; n < 4; n++) mpq_clear(e[n]);
}

/* Returns true if the point is inside the stream's rectangle, up to 2^-slack. */
static bool holds(const dyd_stream *s, const mpq_t x, const mpq_t y, unsigned slack) {
  mpq_t e[4], t;
  init4(e);
  mpq_init(t);
  ends(e, dyd_stream_rect(s));
  mpq_set_ui(t, 1, 1);
  mpq_div_2exp(t, t, slack);
  for (int n = 0; n < 4; n++) (n & 1 ? mpq_add : mpq_sub)(e[n], e[n], t);
  bool good = mpq_cmp(e[0], x) <= 0 && mpq_cmp(x, e[1]) <= 0 && mpq_cmp(e[2], y) <= 0 && mpq_cmp(y, e[3]) <= 0;
  mpq_clear(t);
  clear4(e);
  return good;
}

/* The centre of the circle through the points p[0], p[1], p[2] = (p[k][0], p[k][1]), by solving two linear equations.
 */
static bool circumcentre(mpq_t x, mpq_t y, mpq_t p[3][2]) {
  mpq_t a[2][2], b[2], d, t;
  mpq_inits(a[0][0], a[0][1], a[1][0], a[1][1], b[0], b[1], d, t, NULL);
  for (int k = 0; k < 2; k++)
    for (int n = 0; n < 2; n++) { /* 2 (p_k+1 - p_0).c = |p_k+1|^2 - |p_0|^2 */
      mpq_sub(a[k][n], p[k + 1][n], p[0][n]);
      mpq_add(t, p[k + 1][n], p[0][n]);
      mpq_mul(t, t, a[k][n]);
      mpq_add(b[k], b[k], t);
      mpq_add(a[k][n], a[k][n], a[k][n]);
    }
  mpq_mul(d, a[0][0], a[1][1]);
  mpq_mul(t, a[0][1], a[1][0]);
  mpq_sub(d, d, t);
  bool good = mpq_sgn(d) != 0;
  for (int n = 0; n < 2 && good; n++) { /* Cramer */
    mpq_ptr to = n ? y : x;
    mpq_mul(to, b[n ? 1 : 0], a[n ? 0 : 1][n ? 0 : 1]);
    mpq_mul(t, b[n ? 0 : 1], a[n ? 1 : 0][n ? 0 : 1]);
    mpq_sub(to, to, t);
    mpq_div(to, to, d);
  }
  mpq_clears(a[0][0], a[0][1], a[1][0], a[1][1], b[0], b[1], d, t, NULL);
  return good;
}

static dyd_stream *exact_stream(mpq_t p[2]) {
  dyd_rect r;
  dyd_stream *s = NULL;
  dyd_rect_init(&r);
  assert_int_equal(dyd_rect_set_q(&r, p[0], p[1]), DYD_OK);
  assert_int_equal(dyd_stream_from_rect(&s, &r), DYD_OK);
  dyd_rect_clear(&r);
  return s;
}

static void test_exact_vertices(void **state) {
  (void)state;
  mpq_t p[3][2], c[2];
  for (int n = 0; n < 6; n++) mpq_init(p[n / 2][n % 2]);
  mpq_inits(c[0], c[1], NULL);
  size_t degenerate = 0;
  for (size_t k = test_cases(300); k; k--) {
    for (int n = 0; n < 6; n++) {
      mpq_set_si(p[n / 2][n % 2], (long)test_between(&shared, -4, 4), 1 + (unsigned long)test_below(&shared, 3));
      mpq_canonicalize(p[n / 2][n % 2]);
    }
    dyd_stream *v = NULL;
    dyd_status st = dyd_stream_voronoi_vertex(&v, exact_stream(p[0]), exact_stream(p[1]), exact_stream(p[2]));
    if (!circumcentre(c[0], c[1], p)) {
      assert_int_equal(st, DYD_E_DOMAIN);
      degenerate++;
      continue;
    }
    assert_int_equal(st, DYD_OK);
    assert_true(dyd_stream_is_final(v) && dyd_rect_is_point(dyd_stream_rect(v)));
    mpq_t e[4];
    init4(e);
    ends(e, dyd_stream_rect(v));
    assert_true(mpq_equal(e[0], c[0]) && mpq_equal(e[2], c[1]));
    clear4(e);
    dyd_stream_free(v);
  }
  assert_true(degenerate > 0);
  mpq_clears(c[0], c[1], NULL);
  for (int n = 0; n < 6; n++) mpq_clear(p[n / 2][n % 2]);
}

/* The vertex of three reals: nested, as narrow as asked for, and right: the centre of the points known to 2^-1000. */
static void test_real_vertices(void **state) {
  (void)state;
  static const int64_t bits[] = {-3, 5, 6, 60, 61, 300, 900};
  mpq_t p[3][2], c[2], unused;
  for (int n = 0; n < 6; n++) mpq_init(p[n / 2][n % 2]);
  mpq_inits(c[0], c[1], unused, NULL);
  for (size_t k = test_cases(20); k; k--) {
    dyd_stream *a[3], *v = NULL;
    for (int n = 0; n < 3; n++) a[n] = random_stream(&shared);
    assert_int_equal(dyd_stream_voronoi_vertex(&v, dyd_stream_ref(a[0]), dyd_stream_ref(a[1]), dyd_stream_ref(a[2])),
                     DYD_OK);
    dyd_rect before;
    dyd_rect_init(&before);
    for (size_t n = 0; n < sizeof bits / sizeof *bits; n++) {
      narrow(v, bits[n]);
      assert_true(dyd_rect_bits(dyd_stream_rect(v)) >= bits[n]);
      assert_true(n == 0 || dyd_rect_contains(&before, dyd_stream_rect(v)));
      dyd_rect_set(&before, dyd_stream_rect(v));
    }
    for (int n = 0; n < 3; n++) {
      narrow(a[n], 1400);
      dyd_interval_get_q(p[n][0], unused, &dyd_stream_rect(a[n])->x);
      dyd_interval_get_q(p[n][1], unused, &dyd_stream_rect(a[n])->y);
      dyd_stream_free(a[n]);
    }
    assert_true(circumcentre(c[0], c[1], p));
    assert_true(holds(v, c[0], c[1], 1000));
    dyd_rect_clear(&before);
    dyd_stream_free(v);
  }
  mpq_clears(c[0], c[1], unused, NULL);
  for (int n = 0; n < 6; n++) mpq_clear(p[n / 2][n % 2]);
}

/* Fixed rectangles: final from the start, the box of the partial centre, and right for all choices of corners. */
static void test_fixed_vertices(void **state) {
  (void)state;
  mpq_t p[3][2], c[2];
  for (int n = 0; n < 6; n++) mpq_init(p[n / 2][n % 2]);
  mpq_inits(c[0], c[1], NULL);
  for (size_t k = test_cases(100); k; k--) {
    dyd_rect r[3];
    dyd_stream *s[3], *v = NULL;
    for (int n = 0; n < 3; n++) {
      long x = (long)test_between(&shared, -9, 9), y = (long)test_between(&shared, -9, 9);
      dyd_rect_init(&r[n]);
      dyd_rect_set_d(&r[n], (double)x, (double)(x + test_between(&shared, 0, 2)), (double)y,
                     (double)(y + test_between(&shared, 0, 2)));
      assert_int_equal(dyd_stream_from_rect(&s[n], &r[n]), DYD_OK);
    }
    bool sure = dyd_orientation(&r[0], &r[1], &r[2]) != DYD_UNSURE;
    assert_int_equal(dyd_stream_voronoi_vertex(&v, s[0], s[1], s[2]), sure ? DYD_OK : DYD_E_DOMAIN);
    for (int code = 0; sure && code < 64; code++) {
      for (int n = 0; n < 6; n++) {
        mpq_t other;
        mpq_init(other);
        const dyd_interval *side = n % 2 ? &r[n / 2].y : &r[n / 2].x;
        if (code >> n & 1)
          dyd_interval_get_q(other, p[n / 2][n % 2], side);
        else
          dyd_interval_get_q(p[n / 2][n % 2], other, side);
        mpq_clear(other);
      }
      assert_true(circumcentre(c[0], c[1], p));
      assert_true(holds(v, c[0], c[1], 4000));
    }
    if (sure) assert_true(dyd_stream_is_final(v));
    dyd_stream_free(v);
    for (int n = 0; n < 3; n++) dyd_rect_clear(&r[n]);
  }
  mpq_clears(c[0], c[1], NULL);
  for (int n = 0; n < 6; n++) mpq_clear(p[n / 2][n % 2]);
}

static void test_bad_vertices(void **state) {
  (void)state;
  dyd_stream *v = NULL, *a = text_stream("1", "2"), *line[3];
  dyd_error err;
  assert_int_equal(dyd_stream_voronoi_vertex(&v, dyd_stream_ref(a), dyd_stream_ref(a), text_stream("0", "0")),
                   DYD_E_ARG);
  assert_int_equal(dyd_stream_voronoi_vertex(&v, a, NULL, text_stream("0", "0")), DYD_E_ARG);
  line[0] = text_stream("sqrt(2)", "sqrt(3)");
  line[1] = text_stream("2*sqrt(2)", "2*sqrt(3)");
  line[2] = text_stream("0", "0");
  assert_int_equal(dyd_stream_voronoi_vertex(&v, line[0], line[1], line[2]), DYD_OK);
  dyd_error_clear(&err);
  assert_int_equal(dyd_stream_narrow(v, 20, 500, &err), DYD_E_DOMAIN);
  assert_non_null(strstr(err.message, "on one line"));
  assert_null(dyd_stream_rect(v));
  dyd_stream_free(v);
}

/* ---- combinations ---- */

static void test_combinations(void **state) {
  (void)state;
  mpq_t weight[3], shift[2], sum[2], t, e[4];
  init4(e);
  mpq_inits(weight[0], weight[1], weight[2], shift[0], shift[1], sum[0], sum[1], t, NULL);
  for (size_t k = test_cases(60); k; k--) {
    size_t n = (size_t)test_below(&shared, 4);
    bool exact = test_chance(&shared, 3);
    dyd_stream *of[3], *keep[3], *s = NULL;
    for (size_t q = 0; q < n; q++) {
      of[q] = exact ? text_stream("1/3", "-2/7") : random_stream(&shared);
      keep[q] = dyd_stream_ref(of[q]);
      mpq_set_si(weight[q], (long)test_between(&shared, -9, 9), 7);
      mpq_canonicalize(weight[q]);
    }
    for (int a = 0; a < 2; a++) mpq_set_si(shift[a], (long)test_between(&shared, -3, 3), 1);
    assert_int_equal(dyd_stream_combination(&s, n, of, (const mpq_t *)weight, (const mpq_t *)shift), DYD_OK);
    narrow(s, 100);
    assert_true(dyd_rect_bits(dyd_stream_rect(s)) >= 100);
    if (exact || n == 0) assert_true(dyd_stream_is_final(s) && dyd_rect_is_point(dyd_stream_rect(s)));
    mpq_set(sum[0], shift[0]);
    mpq_set(sum[1], shift[1]);
    for (size_t q = 0; q < n; q++) {
      narrow(keep[q], 600);
      ends(e, dyd_stream_rect(keep[q]));
      for (int a = 0; a < 2; a++) {
        mpq_mul(t, weight[q], e[2 * a]);
        mpq_add(sum[a], sum[a], t);
      }
      dyd_stream_free(keep[q]);
    }
    assert_true(holds(s, sum[0], sum[1], 590));
    dyd_stream_free(s);
  }
  dyd_stream *m = NULL;
  assert_int_equal(test_midpoint(&m, text_stream("1/3", "1"), text_stream("1", "2")), DYD_OK);
  mpq_set_si(sum[0], 2, 3);
  mpq_set_si(sum[1], 3, 2);
  ends(e, dyd_stream_rect(m));
  assert_true(mpq_equal(e[0], sum[0]) && mpq_equal(e[1], sum[0]) && mpq_equal(e[2], sum[1]) && mpq_equal(e[3], sum[1]));
  dyd_stream_free(m);
  assert_int_equal(test_midpoint(&m, NULL, text_stream("1", "2")), DYD_E_ARG);
  mpq_clears(weight[0], weight[1], weight[2], shift[0], shift[1], sum[0], sum[1], t, NULL);
  clear4(e);
}

/* ---- engines on engines ---- */

/* A new engine on the Voronoi vertices of e, which is freed. */
static dyd_engine *next_level(dyd_engine *e) {
  dyd_triangle_list t = {0};
  dyd_engine *next = engine_new();
  assert_int_equal(dyd_delaunay_triangles(&t, NULL, dyd_engine_delaunay(e), 0), DYD_OK);
  for (size_t k = 0; k < t.count; k++) {
    dyd_stream *v = NULL;
    assert_int_equal(test_vertex(&v, e, &t.item[k]), DYD_OK);
    assert_int_equal(dyd_engine_add_stream(next, v, NULL), DYD_OK);
  }
  dyd_triangle_list_clear(&t);
  dyd_engine_free(e);
  return next;
}

static void test_levels(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  for (int k = 0; k < 50; k++) dyd_engine_add_stream(e, random_stream(&shared), NULL);
  for (int level = 0;; level++) {
    run(e, DYD_OUTCOME_DECIDED);
    dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
    dyd_engine_get_counters(&c, e, NULL);
    fprintf(stderr, "# level %d: %zu points, %llu stages, at most %lld bits\n", level, dyd_engine_count(e),
            (unsigned long long)c.stages, (long long)c.bits_most);
    if (level == 3) break;
    e = next_level(e);
  }
  dyd_engine_free(e);
}

/* Centres of exact triangles that make a square: the ties are recognised. */
static void test_exact_tie(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  static const char *corner[4][2] = {{"0", "0"}, {"1/3", "0"}, {"0", "1/3"}, {"1/3", "1/3"}};
  for (int k = 0; k < 4; k++) { /* the circle of radius 5/3 about the corner, through (1,4/3), (-1,4/3), (5/3,0) */
    char x[3][20], y[3][20];
    static const int dx[3] = {3, -3, 5}, dy[3] = {4, 4, 0};
    dyd_stream *s[3], *v = NULL;
    for (int n = 0; n < 3; n++) {
      snprintf(x[n], sizeof x[n], "%d/3", dx[n] + (corner[k][0][0] == '1'));
      snprintf(y[n], sizeof y[n], "%d/3", dy[n] + (corner[k][1][0] == '1'));
      s[n] = text_stream(x[n], y[n]);
    }
    assert_int_equal(dyd_stream_voronoi_vertex(&v, s[0], s[1], s[2]), DYD_OK);
    assert_int_equal(dyd_engine_add_stream(e, v, NULL), DYD_OK);
  }
  run(e, DYD_OUTCOME_FIXPOINT);
  size_t count[4];
  dyd_delaunay_count(count, dyd_engine_delaunay(e));
  assert_int_equal(count[DYD_LEGAL], 4);
  assert_int_equal(count[DYD_TIE], 2);
  dyd_engine_free(e);
}

/* ---- life times ---- */

typedef struct counted {
  int released, calls;
  int64_t least; /* bits asked for */
} counted;

/* Points (1/3 + k, k^2), never exact: x within 2^-bits. */
static dyd_status counted_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  counted *c = user;
  (void)err;
  c->calls++;
  if (request->bits < c->least) c->least = request->bits;
  mpq_t third, y;
  mpq_inits(third, y, NULL);
  mpq_set_ui(third, 1 + 3 * request->point, 3);
  mpq_set_ui(y, request->point * request->point, 1);
  dyd_interval now;
  dyd_interval_init(&now);
  mpq_t hi;
  mpq_init(hi);
  mpq_set_ui(hi, 1, 1);
  mpq_div_2exp(hi, hi, (mp_bitcnt_t)(request->bits + 2));
  mpq_add(hi, hi, third);
  dyd_status st = dyd_interval_set_outward(&now, third, hi, -request->bits - 2);
  if (st == DYD_OK) dyd_interval_swap(&out->x, &now);
  if (st == DYD_OK) st = dyd_interval_set_q(&out->y, y);
  dyd_interval_clear(&now);
  mpq_clears(third, y, hi, NULL);
  return st;
}

static void counted_release(void *user) {
  ((counted *)user)->released++;
}

static void test_life(void **state) {
  (void)state;
  counted c = {0, 0, 1 << 20};
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = counted_narrow, .release = counted_release, .user = &c};
  dyd_engine *e = engine_new();
  dyd_stream *early = NULL, *late = NULL, *fixed = NULL, *none = NULL, *shared_one = NULL,
             *own = random_stream(&shared);
  double x = 7, y = 5, far = -90;
  assert_int_equal(dyd_engine_add_points(e, 1, &far, &y, NULL), DYD_OK);
  assert_int_equal(dyd_engine_add_source(e, 4, &source, NULL), DYD_OK);
  assert_int_equal(dyd_engine_add_points(e, 1, &x, &y, NULL), DYD_OK);
  assert_int_equal(dyd_engine_add_stream(e, dyd_stream_ref(own), NULL), DYD_OK);
  assert_int_equal(dyd_engine_stream(&early, e, 3), DYD_OK);
  assert_null(dyd_stream_rect(early));
  run(e, DYD_OUTCOME_DECIDED);
  assert_int_equal(dyd_engine_stream(&late, e, 4), DYD_OK);
  assert_int_equal(dyd_engine_stream(&fixed, e, 5), DYD_OK);
  assert_int_equal(dyd_engine_stream(&shared_one, e, 6), DYD_OK);
  assert_int_equal(dyd_engine_stream(&none, e, 7), DYD_E_ARG);
  assert_true(dyd_stream_is_final(fixed) && shared_one == own);
  int calls = c.calls;
  narrow(late, 10); /* the engine knows more already */
  assert_int_equal(c.calls, calls);
  assert_true(dyd_rect_bits(dyd_stream_rect(late)) >= 64);
  dyd_engine_free(e);
  assert_int_equal(c.released, 0);
  narrow(early, 20);
  assert_true(mpz_cmp_ui(dyd_stream_rect(early)->y.lo.man, 1) == 0 && dyd_stream_rect(early)->y.lo.exp == 2); /* 2^2 */
  narrow(late, 200);
  assert_int_equal(c.calls, calls + 2);
  dyd_stream_free(early);
  assert_int_equal(c.released, 0);
  dyd_stream_free(late);
  assert_int_equal(c.released, 1);
  dyd_stream_free(fixed);
  dyd_stream_free(own);
  dyd_stream_free(shared_one);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_exact_vertices), cmocka_unit_test(test_real_vertices),
                                     cmocka_unit_test(test_fixed_vertices), cmocka_unit_test(test_bad_vertices),
                                     cmocka_unit_test(test_combinations),   cmocka_unit_test(test_exact_tie),
                                     cmocka_unit_test(test_levels),         cmocka_unit_test(test_life)};
  shared = test_random_start("compose");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  flint_cleanup();
  return failed;
}
