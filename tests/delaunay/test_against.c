/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Two ways to the same rectangles: the filters against the exact rung, an update against a fresh run. Searches that
 * once found differences [FLT-INC] [FLT-ORI] [FLT-SCALE] [FLT-SMALL] [LOC-1]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/read_case.h"
#include "rect/rect.h"
#include <cmocka.h>
#include <math.h>

static harness shared;

static dyd_delaunay *engine(const dyd_sites *s, bool no_filter) {
  char message[MESSAGE_SIZE] = "";
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = no_filter};
  dyd_delaunay *pd = harness_engine(message, s, &o);
  if (!pd) fail_msg("%s", message);
  return pd;
}

static void print_sites(const dyd_sites *s) {
  double e[4];
  for (size_t i = 0; i < dyd_sites_count(s) && i < ORC_MAX; i++) {
    dyd_sites_get_d(e, s, i);
    fprintf(stderr, "[%a,%a] [%a,%a]  # %zu\n", e[0], e[1], e[2], e[3], i);
  }
}

static void expect_same(const char *name, const dyd_delaunay *a, const dyd_delaunay *b) {
  uint32_t n = (uint32_t)dyd_sites_count(dyd_delaunay_sites(a));
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = i + 1; j < n; j++) {
      int s = (int)dyd_delaunay_status(a, i, j), t = (int)dyd_delaunay_status(b, i, j);
      if (s == t) continue;
      print_sites(dyd_delaunay_sites(b));
      fail_msg("%s: pair %u %u: %d and %d", name, i, j, s, t);
    }
}

static void filter_against_exact(const char *name, const dyd_sites *s) {
  dyd_delaunay *a = engine(s, false), *b = engine(s, true);
  expect_same(name, a, b);
  dyd_delaunay_free(b);
  dyd_delaunay_free(a);
}

/* ---- filters against the exact rung ---- */

/* Points about 2^e: terms of the determinants overflow, or their bounds do, or both. Short mantissas make ties. */
static void test_overflow_search(void **state) {
  (void)state;
  static const int range[4][2] = {{250, 272}, {505, 515}, {-272, -240}, {254, 260}};
  for (size_t k = test_cases(600); k; k--) {
    const int *e = range[k % 2 ? 3 : k / 2 % 4];
    dyd_sites *s = NULL;
    assert_int_equal(dyd_sites_new(&s), DYD_OK);
    int bits = test_chance(&shared.random, 3) ? 3 : 30, span = test_chance(&shared.random, 2) ? e[1] - e[0] : 2;
    int base = (int)test_between(&shared.random, e[0], e[1] - span);
    for (int i = 0; i < 7; i++) {
      double c[2];
      for (int a = 0; a < 2; a++)
        c[a] = ldexp((double)test_between(&shared.random, -(1l << bits), 1l << bits),
                     base - bits + (int)test_below(&shared.random, (uint64_t)span));
      assert_int_equal(dyd_sites_add_points(s, 1, &c[0], &c[1]), DYD_OK);
    }
    filter_against_exact("overflow", s);
    dyd_sites_free(s);
  }
}

/* (1 + a/d) 2^-400 for an odd d of the given number of bits. */
static void long_rational(mpq_t q, unsigned bits, test_random *r) {
  mpz_ptr d = mpq_denref(q), a = mpq_numref(q);
  mpz_set_ui(d, 0);
  mpz_set_ui(a, 0);
  for (unsigned b = 0; b < bits; b += 32) {
    mpz_mul_2exp(d, d, 32);
    mpz_mul_2exp(a, a, 32);
    mpz_add_ui(d, d, test_below(r, UINT64_C(1) << 32));
    mpz_add_ui(a, a, test_below(r, UINT64_C(1) << 32));
  }
  mpz_setbit(d, bits + 1);
  mpz_setbit(d, 0);
  mpz_mod(a, a, d);
  mpz_add(a, a, d);
  mpq_canonicalize(q);
  mpq_div_2exp(q, q, 400);
}

static void add_long_rational(dyd_sites *s, unsigned bits, test_random *r) {
  dyd_rect box;
  mpq_t x, y;
  mpq_inits(x, y, NULL);
  dyd_rect_init(&box);
  long_rational(x, bits, r);
  long_rational(y, bits, r);
  assert_int_equal(dyd_rect_set_q(&box, x, y), DYD_OK);
  assert_int_equal(dyd_sites_add_rect(s, &box), DYD_OK);
  dyd_rect_clear(&box);
  mpq_clears(x, y, NULL);
}

/* Least common denominators beyond 2^1024, with boxes next to them [FLT-SCALE]. */
static void test_long_denominators(void **state) {
  (void)state;
  static const unsigned bits[4] = {64, 96, 128, 192};
  for (size_t k = test_cases(24); k; k--) {
    dyd_sites *s = NULL;
    assert_int_equal(dyd_sites_new(&s), DYD_OK);
    for (int i = 0; i < 9; i++) add_long_rational(s, bits[k % 4], &shared.random);
    for (int i = 0; i < 5; i++) {
      double t[4];
      for (int q = 0; q < 4; q++) t[q] = (double)test_below(&shared.random, q & 1 ? 300 : 1000) / 1000;
      double x0 = (1 + t[0]) * 0x1p-400, x1 = (1 + t[0] + t[1]) * 0x1p-400;
      double y0 = (1 + t[2]) * 0x1p-400, y1 = (1 + t[2] + t[3]) * 0x1p-400;
      assert_int_equal(dyd_sites_add_boxes(s, 1, &x0, &x1, &y0, &y1), DYD_OK);
    }
    filter_against_exact("denominators", s);
    dyd_sites_free(s);
  }
}

/* ---- an update against a fresh run ---- */

static void narrow_to(dyd_sites *s, uint32_t i, double x0, double x1, double y0, double y1) {
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(dyd_rect_set_d(&r, x0, x1, y0, y1), DYD_OK);
  assert_int_equal(dyd_sites_narrow(s, i, &r), DYD_OK);
  dyd_rect_clear(&r);
}

static void update(dyd_delaunay *pd, const uint32_t *changed, size_t count) {
  dyd_error err;
  dyd_error_clear(&err);
  if (dyd_delaunay_update(pd, changed, count, NULL, &err) != DYD_OK) fail_msg("update: %s", err.message);
}

/* Four boxes about the corners of the unit square become exact points near them; once a constant of the old
 * representatives took a rounded determinant for exact. */
static void near_square(double p[4][2]) {
  static const uint32_t all[4] = {0, 1, 2, 3};
  dyd_sites *s = NULL;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (int k = 0; k < 4; k++) {
    double x = k & 1, y = k >> 1, e[4] = {x - 0.25, x + 0.25, y - 0.25, y + 0.25};
    assert_int_equal(dyd_sites_add_boxes(s, 1, &e[0], &e[1], &e[2], &e[3]), DYD_OK);
  }
  dyd_delaunay *pd = engine(s, false);
  for (uint32_t k = 0; k < 4; k++) narrow_to(s, k, p[k][0], p[k][0], p[k][1], p[k][1]);
  update(pd, all, 4);
  dyd_delaunay *fresh = engine(s, true);
  expect_same("near square", pd, fresh);
  dyd_delaunay_free(fresh);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void test_stale_constant(void **state) {
  (void)state;
  double found[4][2] = {{0x1.8p-52, 0}, {1, -0x1p-53}, {0, 0x1.fffffffffffffp-1}, {1, 0x1.0000000000001p+0}};
  near_square(found);
  for (size_t n = test_cases(400); n; n--) {
    double p[4][2];
    for (int k = 0; k < 4; k++) {
      p[k][0] = (k & 1) + (double)test_between(&shared.random, -4, 4) * 0x1p-53;
      p[k][1] = (k >> 1) + (double)test_between(&shared.random, -4, 4) * 0x1p-53;
    }
    near_square(p);
  }
}

/* From the rectangles of one case to those of another, site by site in random order, with an update after each few. */
static bool walk(char *message, harness *h, const orc_case *from, const orc_case *to) {
  dyd_sites *s = harness_sites(from);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  uint32_t order[ORC_MAX];
  orc_case now;
  dyd_rect r;
  orc_case_init(&now);
  orc_case_set(&now, from);
  dyd_rect_init(&r);
  for (uint32_t k = 0; k < to->n; k++) {
    uint32_t q = (uint32_t)test_below(&h->random, k + 1);
    order[k] = order[q], order[q] = k;
  }
  bool good = pd;
  for (size_t done = 0; done < to->n && good;) {
    size_t first = done, step = 1 + (size_t)test_below(&h->random, 3);
    for (; done < to->n && done < first + step; done++) {
      harness_rect(&r, &to->rect[order[done]]);
      good = good && dyd_sites_narrow(s, order[done], &r) == DYD_OK;
      for (int e = 0; e < 4; e++) mpq_set(now.rect[order[done]].e[e], to->rect[order[done]].e[e]);
    }
    good = good && dyd_delaunay_update(pd, order + first, done - first, NULL, NULL) == DYD_OK;
    good = good && queries_agree(message, &now, pd);
    dyd_delaunay *fresh = good ? harness_engine(message, s, NULL) : NULL;
    good = good && fresh && same_statuses(message, h, &now, pd, fresh);
    dyd_delaunay_free(fresh);
  }
  dyd_rect_clear(&r);
  orc_case_clear(&now);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static void expect_walks(const char *from_text, const char *to_text) {
  char message[MESSAGE_SIZE] = "";
  orc_case from, to;
  orc_case_init(&from);
  orc_case_init(&to);
  read_case(&from, "walk", from_text);
  read_case(&to, "walk", to_text);
  for (size_t k = test_cases(40); k; k--)
    if (!walk(message, &shared, &from, &to)) fail_msg("%s", message);
  orc_case_clear(&to);
  orc_case_clear(&from);
}

/* A pair on the rims of two faces was listed twice after one of them had been worked on. */
static void test_shared_pairs(void **state) {
  (void)state;
  expect_walks("[-23,-19] 15\n[-9,-6] [8,14]\n[-17,-13] [11,15]\n-7 [9,15]\n[-20,-13] [10,13]\n-18 [4,5]\n",
               "[-733*2^-5,-5183*2^-8] 15\n[-225*2^-5,-3369*2^-9] [203*2^-4,14]\n[-127*2^-3,-3949*2^-8] [11,95*2^-3]\n"
               "-7 [3279*2^-8,14457*2^-10]\n-493*2^-5 101*2^-3\n-18 [1171*2^-8,1269*2^-8]\n");
  expect_walks("[33,35] [-67,-65]\n[0,64] [-64,0]\n[31,37] [-56,-50]\n[60,65] [-50,-40]\n59 [-50,-49]\n59 [-50,-49]\n"
               "59 -50\n59 -50\n59 -50\n59 -50\n[13,15] [-7,-4]\n",
               "[33,35] [-67,-65]\n64 [-64,-16]\n553*2^-4 -809*2^-4\n[60,65] [-50,-325*2^-3]\n59 [-197*2^-2,-49]\n"
               "59 [-50,-49]\n59 -50\n59 -50\n59 -50\n59 -50\n[13,29*2^-1] [-7,-4]\n");
}

/* ---- many boxes, a few faces at a time ---- */

enum { MANY = 2000 };

/* Every third undecided face is narrowed: its sites to their middles or to a half. Returns how many. */
static size_t narrow_faces(uint32_t *changed, dyd_sites *s, const dyd_delaunay *pd) {
  size_t count = 0;
  bool seen[MANY] = {false};
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd); f++) {
    dyd_index_list l = {0};
    bool outer;
    if (!test_chance(&shared.random, 3)) continue;
    assert_int_equal(dyd_delaunay_face(&l, &outer, pd, f), DYD_OK);
    bool final = test_chance(&shared.random, 3);
    for (size_t k = 0; k < l.count; k++) {
      double e[4], lo[2], hi[2];
      if (seen[l.item[k]]) continue;
      seen[l.item[k]] = true;
      dyd_sites_get_d(e, s, l.item[k]);
      for (int a = 0; a < 2; a++) {
        double m = e[2 * a] + (e[2 * a + 1] - e[2 * a]) / 2;
        bool low = test_chance(&shared.random, 2);
        lo[a] = final || !low ? m : e[2 * a];
        hi[a] = final || low ? m : e[2 * a + 1];
      }
      narrow_to(s, l.item[k], lo[0], hi[0], lo[1], hi[1]);
      changed[count++] = l.item[k];
    }
    dyd_index_list_clear(&l);
  }
  return count;
}

/* The same lists of pairs, in the same order, with the same statuses. */
static void expect_same_lists(const dyd_delaunay *pd, const dyd_delaunay *fresh) {
  dyd_pair_list a = {0}, b = {0};
  assert_int_equal(dyd_delaunay_pairs(&a, pd), DYD_OK);
  assert_int_equal(dyd_delaunay_pairs(&b, fresh), DYD_OK);
  assert_int_equal(a.count, b.count);
  for (size_t k = 0; k < a.count; k++) {
    assert_int_equal(a.item[k].i, b.item[k].i);
    assert_int_equal(a.item[k].j, b.item[k].j);
    assert_int_equal(a.item[k].status, b.item[k].status);
  }
  dyd_pair_list_clear(&b);
  dyd_pair_list_clear(&a);
}

static void many_boxes(double least, double most) {
  dyd_sites *s = NULL;
  uint32_t changed[MANY];
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (int i = 0; i < MANY; i++) {
    double c[2], e[4];
    for (int a = 0; a < 2; a++) {
      c[a] = test_unit(&shared.random);
      double half = (least + (most - least) * test_unit(&shared.random)) / sqrt(MANY);
      e[2 * a] = c[a] - half;
      e[2 * a + 1] = c[a] + half;
    }
    assert_int_equal(dyd_sites_add_boxes(s, 1, &e[0], &e[1], &e[2], &e[3]), DYD_OK);
  }
  dyd_delaunay *pd = engine(s, false);
  size_t most_faces = dyd_delaunay_undecided_faces(pd), touched = 0;
  for (int round = 0; round < 5; round++) {
    size_t count = narrow_faces(changed, s, pd);
    touched += count;
    update(pd, changed, count);
    dyd_delaunay *fresh = engine(s, false);
    expect_same_lists(pd, fresh);
    dyd_delaunay_free(fresh);
  }
  assert_true(most_faces > 1 && touched > 10);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void test_many_boxes(void **state) {
  (void)state;
  for (size_t k = test_cases(1); k; k--) {
    many_boxes(0.03, 0.1);
    many_boxes(0.0, 0.05);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_overflow_search), cmocka_unit_test(test_long_denominators),
                                     cmocka_unit_test(test_stale_constant), cmocka_unit_test(test_shared_pairs),
                                     cmocka_unit_test(test_many_boxes)};
  harness_init(&shared, "against");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
