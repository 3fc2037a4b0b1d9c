/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The oracle against sampling: choices and centres can only confirm or refute it, and it is never refuted. */
#include <setjmp.h>
#include <stdarg.h>

#include "oracle/oracle.h"
#include "oracle/oracle_gen.h"
#include "oracle/oracle_lattice.h"
#include <cmocka.h>

static void fail_case(const orc_case *c, const orc_case *choice, size_t i, size_t j, const char *what) {
  fprintf(stderr, "pair %zu %zu: %s\n", i, j, what);
  orc_case_print(stderr, c);
  if (choice) fprintf(stderr, "choice:\n"), orc_case_print(stderr, choice);
  fail_msg("%s", what);
}

/* Whatever holds in a choice is possible; a legal pair is a strict edge in it. */
static void check_choice(orc_pool *p, const orc_case *c, const orc_table *t, const orc_case *choice) {
  for (size_t i = 0; i < c->n; i++)
    for (size_t j = i + 1; j < c->n; j++) {
      if (orc_rect_equal(&choice->rect[i], &choice->rect[j])) continue;
      if (orc_case_alias(c, i) != i || orc_case_alias(c, j) != j) continue;
      int is = orc_classical(p, choice, i, j);
      if (t->status[i][j] == ORC_ILLEGAL && is != ORC_ILLEGAL) fail_case(c, choice, i, j, "illegal, but an edge");
    }
}

/* Aliases of a legal pair's ends lie on them in every choice, so strictness is tested without aliases only. */
static void check_legal(orc_pool *p, const orc_case *c, const orc_table *t, const orc_case *choice) {
  for (size_t i = 0; i < c->n; i++)
    if (orc_case_alias(c, i) != i) return;
  for (size_t i = 0; i < c->n; i++)
    for (size_t j = i + 1; j < c->n; j++) {
      if (t->status[i][j] != ORC_LEGAL || orc_rect_equal(&choice->rect[i], &choice->rect[j])) continue;
      if (orc_classical(p, choice, i, j) != ORC_LEGAL) fail_case(c, choice, i, j, "legal, but not an edge");
    }
}

static void check_centre(orc_pool *p, const orc_case *c, const orc_table *t, long x, long y, unsigned long den) {
  size_t mark = orc_mark(p);
  mpq_srcptr cx = orc_si(p, x, den), cy = orc_si(p, y, den);
  orc_point at = {orc_alg_q(p, cx), orc_alg_q(p, cy)};
  for (size_t i = 0; i < c->n; i++)
    for (size_t j = i + 1; j < c->n; j++) {
      if (orc_case_alias(c, i) != i || orc_case_alias(c, j) != j) continue;
      if (t->status[i][j] != ORC_LEGAL && orc_is_witness(p, c, i, j, cx, cy))
        fail_case(c, NULL, i, j, "not legal, but a witness");
      if (t->status[i][j] == ORC_ILLEGAL && orc_is_free(p, c, i, j, at))
        fail_case(c, NULL, i, j, "illegal, but a free centre");
    }
  orc_release(p, mark);
}

static void check_consistent(orc_pool *p, const orc_case *c, const orc_table *t) {
  for (size_t i = 0; i < c->n; i++)
    for (size_t j = i + 1; j < c->n; j++) {
      if (orc_case_alias(c, i) != i || orc_case_alias(c, j) != j) continue;
      size_t mark = orc_mark(p);
      if (t->status[i][j] == ORC_LEGAL && !orc_possible(p, c, i, j)) fail_case(c, NULL, i, j, "legal, not possible");
      orc_release(p, mark);
    }
}

static void check_by_sampling(orc_pool *p, const orc_case *c, test_random *r, size_t choices) {
  orc_table t;
  orc_case choice;
  orc_case_init(&choice);
  orc_statuses(&t, p, c);
  check_consistent(p, c, &t);
  for (size_t k = 0; k < choices; k++) {
    orc_choose(&choice, r, c, k % 2 ? 1 : 8);
    check_choice(p, c, &t, &choice);
    check_legal(p, c, &t, &choice);
    check_centre(p, c, &t, (long)test_between(r, -20, 200), (long)test_between(r, -20, 200), 1 + k % 7);
  }
  orc_case_clear(&choice);
}

static void test_random_cases(void **state) {
  (void)state;
  test_random r = test_random_start("oracle");
  orc_pool p;
  orc_case c;
  orc_pool_init(&p);
  orc_case_init(&c);
  for (size_t k = 0; k < test_cases(400); k++) {
    orc_generate(&c, &r, k % ORC_KINDS, 8);
    check_by_sampling(&p, &c, &r, 40);
  }
  orc_case_clear(&c);
  orc_pool_clear(&p);
}

/* Exact points: two roads to the same answer. */
static void test_points(void **state) {
  (void)state;
  test_random r = test_random_start("oracle points");
  orc_pool p;
  orc_case c, points;
  orc_table t;
  orc_pool_init(&p);
  orc_case_init(&c);
  orc_case_init(&points);
  for (size_t k = 0; k < test_cases(300); k++) {
    orc_generate(&c, &r, k % ORC_KINDS, 9);
    orc_choose(&points, &r, &c, 2);
    orc_statuses(&t, &p, &points);
    for (size_t i = 0; i < c.n; i++)
      for (size_t j = i + 1; j < c.n; j++) {
        if (orc_case_alias(&points, i) != i || orc_case_alias(&points, j) != j) continue;
        int is = orc_classical(&p, &points, i, j);
        bool doubled = false;
        for (size_t m = 0; m < c.n; m++) doubled = doubled || orc_case_alias(&points, m) != m;
        if (doubled ? (is == ORC_ILLEGAL) != (t.status[i][j] == ORC_ILLEGAL) : is != t.status[i][j])
          fail_case(&points, NULL, i, j, "two roads differ");
      }
  }
  orc_case_clear(&points);
  orc_case_clear(&c);
  orc_pool_clear(&p);
}

/* The classical statuses in 64 bits and in rationals. */
static void test_lattice(void **state) {
  (void)state;
  test_random r = test_random_start("oracle lattice");
  orc_pool p;
  orc_case c;
  orc_pool_init(&p);
  orc_case_init(&c);
  for (size_t k = 0; k < test_cases(300); k++) {
    orc_lattice point[10];
    size_t n = (size_t)test_between(&r, 2, 10);
    int64_t grid = k % 2 ? 4 : LATTICE_MAX;
    c.n = 0;
    for (size_t i = 0; i < n; i++) {
      point[i] = (orc_lattice){(int32_t)test_between(&r, -grid, grid), (int32_t)test_between(&r, -grid, grid)};
      orc_case_add(&c, point[i].x, point[i].x, point[i].y, point[i].y, 1);
    }
    for (size_t i = 0; i < n; i++)
      for (size_t j = i + 1; j < n; j++)
        if (!orc_rect_equal(&c.rect[i], &c.rect[j]))
          assert_int_equal(orc_lattice_status(point, n, i, j), orc_classical(&p, &c, i, j));
  }
  orc_case_clear(&c);
  orc_pool_clear(&p);
}

/* Rectangle number v of the 36 with corners on {0,1,2}^2. */
static void add_tiny(orc_case *c, size_t v) {
  static const long side[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  orc_case_add(c, side[v % 6][0], side[v % 6][1], side[v / 6][0], side[v / 6][1], 1);
}

/* Three rectangles on a tiny grid (every seventh case at scale 1): all half-integer centres. */
static void test_tiny(void **state) {
  (void)state;
  orc_pool p;
  orc_case c;
  orc_table t;
  orc_pool_init(&p);
  orc_case_init(&c);
  size_t step = test_environment("DYADEL_TEST_SCALE", 1) > 1 ? 1 : 97;
  for (size_t v = 0; v < (size_t)36 * 36 * 36; v += step) {
    c.n = 0;
    add_tiny(&c, v % 36), add_tiny(&c, v / 36 % 36), add_tiny(&c, v / 1296);
    orc_statuses(&t, &p, &c);
    for (long x = -2; x <= 10; x++)
      for (long y = -2; y <= 10; y++) check_centre(&p, &c, &t, x, y, 4);
  }
  orc_case_clear(&c);
  orc_pool_clear(&p);
}

/* Here the critical free centres of the pair 0 3 see a side of each: two parabolas meet. */
static void test_two_sides(void **state) {
  (void)state;
  orc_pool p;
  orc_case c;
  orc_table t;
  orc_pool_init(&p);
  orc_case_init(&c);
  orc_case_add(&c, 32, 40, 0, 10, 1);
  orc_case_add(&c, 16, 16, 0, 1, 1);
  orc_case_add(&c, 64, 65, 0, 4, 1);
  orc_case_add(&c, 16, 24, 16, 25, 1);
  orc_case_add(&c, 32, 34, 32, 37, 1);
  orc_statuses(&t, &p, &c);
  assert_int_equal(t.status[0][3], ORC_LEGAL);
  assert_true(orc_possible(&p, &c, 0, 3));
  for (long x = -10; x < 60; x++)
    for (long y = -10; y < 60; y++) check_centre(&p, &c, &t, x, y, 1);
  orc_case_clear(&c);
  orc_pool_clear(&p);
}

/* The field: a + b sqrt(c) against numbers known otherwise. */
static void test_field(void **state) {
  (void)state;
  orc_pool p;
  orc_pool_init(&p);
  for (long a = -6; a <= 6; a++)
    for (long b = -3; b <= 3; b++)
      for (long s = 0; s <= 3; s++) {
        orc_alg x = {orc_si(&p, a, 1), orc_si(&p, b, 1), orc_si(&p, s * s, 1)};
        long value = a + b * s;
        assert_int_equal(orc_alg_sgn(&p, x), (value > 0) - (value < 0));
        for (long d = -4; d <= 4; d++) {
          orc_alg y = {orc_si(&p, d, 1), orc_si(&p, 2, 1), orc_si(&p, 4, 1)};
          assert_int_equal(orc_alg_cmp(&p, x, y), (value > d + 4) - (value < d + 4));
        }
      }
  orc_alg root2 = {orc_si(&p, 0, 1), orc_si(&p, 1, 1), orc_si(&p, 2, 1)};
  assert_true(orc_alg_cmp_q(&p, root2, orc_si(&p, 577, 408)) < 0);
  assert_true(orc_alg_cmp_q(&p, root2, orc_si(&p, 1393, 985)) > 0);
  mpq_srcptr between = orc_alg_between(&p, orc_alg_q(&p, orc_si(&p, 1393, 985)), root2);
  assert_true(orc_alg_cmp_q(&p, root2, between) > 0);
  orc_pool_clear(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_field),     cmocka_unit_test(test_points),
                                     cmocka_unit_test(test_two_sides), cmocka_unit_test(test_random_cases),
                                     cmocka_unit_test(test_tiny),      cmocka_unit_test(test_lattice)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
