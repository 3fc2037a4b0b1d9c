/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The exact linear programme against all triples of half-planes, in rationals [LP-1]. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "legal/witness.h"
#include "support/random.h"

enum { MOST = 12 };

typedef struct plane {
  long a, b, c, w;
} plane;

/* Determinant of three rows (p, q, r). */
static void determinant(mpz_t out, const long m[3][3]) {
  mpz_set_si(out, 0);
  for (int k = 0; k < 3; k++) {
    const long *u = m[(k + 1) % 3], *v = m[(k + 2) % 3];
    mpz_t t;
    mpz_init_set_si(t, m[k][0]);
    mpz_mul_si(t, t, u[1] * v[2] - u[2] * v[1]);
    mpz_add(out, out, t);
    mpz_clear(t);
  }
}

/* The point where three half-planes have one value z: coordinates and z as rationals; false: none or many. */
static bool meet(mpq_t v[3], const plane *p[3]) {
  long rows[3][3];
  mpz_t d, n;
  mpz_inits(d, n, NULL);
  for (int k = 0; k < 3; k++) rows[k][0] = p[k]->a, rows[k][1] = p[k]->b, rows[k][2] = -p[k]->w;
  determinant(d, (const long(*)[3])rows);
  bool one = mpz_sgn(d) != 0;
  for (int c = 0; c < 3 && one; c++) {
    for (int k = 0; k < 3; k++) {
      rows[k][0] = p[k]->a, rows[k][1] = p[k]->b, rows[k][2] = -p[k]->w;
      rows[k][c] = -p[k]->c;
    }
    determinant(n, (const long(*)[3])rows);
    mpz_set(mpq_numref(v[c]), n);
    mpz_set(mpq_denref(v[c]), d);
    mpq_canonicalize(v[c]);
  }
  mpz_clears(d, n, NULL);
  return one;
}

/* a x + b y + c - w z */
static int value_sign(const plane *p, mpq_t v[3]) {
  const long f[3] = {p->a, p->b, -p->w};
  mpq_t sum, t;
  mpq_inits(sum, t, NULL);
  mpq_set_si(sum, p->c, 1);
  for (int k = 0; k < 3; k++) {
    mpq_set_si(t, f[k], 1);
    mpq_mul(t, t, v[k]);
    mpq_add(sum, sum, t);
  }
  int sign = mpq_sgn(sum);
  mpq_clears(sum, t, NULL);
  return sign;
}

/* The optimum is taken at a vertex: the largest z of all triples whose point satisfies all constraints. */
static void brute_force(mpq_t best, const plane *p, int count) {
  mpq_t v[3];
  bool any = false;
  for (int k = 0; k < 3; k++) mpq_init(v[k]);
  for (int i = 0; i < count; i++)
    for (int j = i + 1; j < count; j++)
      for (int k = j + 1; k < count; k++) {
        const plane *three[3] = {&p[i], &p[j], &p[k]};
        if (!meet(v, three)) continue;
        bool good = true;
        for (int q = 0; q < count && good; q++) good = value_sign(&p[q], v) >= 0;
        if (good && (!any || mpq_cmp(v[2], best) > 0)) mpq_set(best, v[2]), any = true;
      }
  for (int k = 0; k < 3; k++) mpq_clear(v[k]);
  assert_true(any);
}

static void check(const plane *p, int count) {
  dyd_half_plane h[MOST];
  dyd_exact_centre c;
  mpq_t best, got, v[3];
  mpq_inits(best, got, v[0], v[1], v[2], NULL);
  dyd_exact_centre_init(&c);
  for (int k = 0; k < count; k++) {
    dyd_half_plane_init(&h[k]);
    mpz_set_si(h[k].a, p[k].a);
    mpz_set_si(h[k].b, p[k].b);
    mpz_set_si(h[k].c, p[k].c);
    mpz_set_si(h[k].w, p[k].w);
  }
  assert_true(dyd_exact_lp(&c, h, (size_t)count, NULL));
  assert_true(mpz_sgn(c.d) > 0);
  mpz_srcptr part[3] = {c.x, c.y, c.z};
  for (int k = 0; k < 3; k++) {
    mpz_set(mpq_numref(v[k]), part[k]);
    mpz_set(mpq_denref(v[k]), c.d);
    mpq_canonicalize(v[k]);
  }
  brute_force(best, p, count);
  assert_true(mpq_equal(best, v[2]));
  for (int k = 0; k < count; k++) {
    assert_true(value_sign(&p[k], v) >= 0);
    dyd_half_plane_clear(&h[k]);
  }
  dyd_exact_centre_clear(&c);
  mpq_clears(best, got, v[0], v[1], v[2], NULL);
}

/* Small coefficients: parallel, equal and antiparallel half-planes, empty and one-point intersections are common. */
static void test_small(void **state) {
  (void)state;
  test_random r = test_random_start("exact_lp");
  for (size_t n = test_cases(1500); n; n--) {
    plane p[MOST] = {{1, 0, 8, 1}, {-1, 0, 8, 1}, {0, 1, 8, 1}, {0, -1, 8, 1}};
    int count = 4 + (int)test_below(&r, MOST - 3);
    for (int k = 4; k < count; k++) {
      do {
        p[k].a = test_between(&r, -3, 3);
        p[k].b = test_between(&r, -3, 3);
      } while (p[k].a == 0 && p[k].b == 0);
      p[k].c = test_between(&r, -9, 9);
      p[k].w = labs(p[k].a) + labs(p[k].b);
    }
    check(p, count);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_small)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
