/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The rungs of the skeleton's predicates against determinants in rationals: a rung that decides is right, the last
 * rungs are always right [FLT-ORI] [FLT-INC] [FLT-SMALL] [FIX-1]. */
#include <setjmp.h>
#include <stdarg.h>

#include "rect/rect.h"
#include "skeleton/mesh_build.h"
#include "skeleton/mesh_filter.h"
#include "support/random.h"
#include <cmocka.h>
#include <math.h>
#include <string.h>

enum { POINTS = 7 };

/* A mesh without triangles over a few exact points, and the points in rationals. */
typedef struct bed {
  dyd_sites *s;
  dyd_reps reps;
  dyd_mesh m;
  dyd_tally tally;
  mpq_t q[POINTS][2];
} bed;

/* How often each rung was sure, and how many exact ties there were. */
static struct tally { size_t asked, ties, filter, near, small, fixed; } tally;
static test_random shared;

static void bed_open(bed *b) {
  memset(b, 0, sizeof *b);
  assert_int_equal(dyd_sites_new(&b->s), DYD_OK);
  for (int k = 0; k < POINTS; k++) mpq_inits(b->q[k][0], b->q[k][1], NULL);
}

/* The coordinates q become sites. */
static void bed_make(bed *b) {
  dyd_rect r;
  uint32_t *site = malloc(POINTS * sizeof *site);
  assert_non_null(site);
  dyd_rect_init(&r);
  for (uint32_t k = 0; k < POINTS; k++) {
    assert_int_equal(dyd_rect_set_q(&r, b->q[k][0], b->q[k][1]), DYD_OK);
    assert_int_equal(dyd_sites_add_rect(b->s, &r), DYD_OK);
    site[k] = k;
  }
  dyd_rect_clear(&r);
  assert_int_equal(dyd_reps_init(&b->reps, NULL, b->s, site, POINTS, 1), DYD_OK);
  b->m = (dyd_mesh){.reps = &b->reps, .n = POINTS, .end = POINTS};
  dyd_mesh_coordinates(&b->m);
}

static void bed_close(bed *b) {
  dyd_mesh_clear(&b->m);
  dyd_reps_clear(&b->reps);
  dyd_sites_free(b->s);
  for (int k = 0; k < POINTS; k++) mpq_clears(b->q[k][0], b->q[k][1], NULL);
}

/* ---- determinants by definition ---- */

static void cross_to(mpq_t out, mpq_t *a, mpq_t *b) {
  mpq_t t;
  mpq_init(t);
  mpq_mul(out, a[0], b[1]);
  mpq_mul(t, a[1], b[0]);
  mpq_sub(out, out, t);
  mpq_clear(t);
}

/* The points v relative to the last of them. */
static void relative(mpq_t d[3][2], bed *b, const uint32_t *v, int count) {
  for (int k = 0; k + 1 < count; k++)
    for (int a = 0; a < 2; a++) mpq_sub(d[k][a], b->q[v[k]][a], b->q[v[count - 1]][a]);
}

static int literal(bed *b, const uint32_t *v, int count) {
  mpq_t d[3][2], l, x, t, det;
  for (int k = 0; k < 3; k++) mpq_inits(d[k][0], d[k][1], NULL);
  mpq_inits(l, x, t, det, NULL);
  relative(d, b, v, count);
  if (count == 3)
    cross_to(det, d[0], d[1]);
  else
    for (int k = 0; k < 3; k++) {
      mpq_mul(l, d[k][0], d[k][0]);
      mpq_mul(t, d[k][1], d[k][1]);
      mpq_add(l, l, t);
      cross_to(x, d[(k + 1) % 3], d[(k + 2) % 3]);
      mpq_mul(l, l, x);
      mpq_add(det, det, l);
    }
  int sign = mpq_sgn(det);
  mpq_clears(l, x, t, det, NULL);
  for (int k = 0; k < 3; k++) mpq_clears(d[k][0], d[k][1], NULL);
  return sign;
}

/* ---- the rungs ---- */

static void right_or_unsure(size_t *count, const bed *b, int said, int truth, const char *rung) {
  *count += said != 0;
  if (said == 0 || said == truth) return;
  for (int k = 0; k < POINTS; k++) gmp_fprintf(stderr, "%a %a\n", b->m.xy[k].x, b->m.xy[k].y);
  fail_msg("%s says %d, the determinant %d", rung, said, truth);
}

static void right(const bed *b, int said, int truth, const char *rung) {
  size_t unused = 0;
  if (said == 0 && truth != 0) said = -truth;
  right_or_unsure(&unused, b, said, truth, rung);
}

/* Of three on a line: the last one is between the others iff they are on opposite sides of it. */
static void check_between(bed *b, const uint32_t *v) {
  mpq_t d[3][2], t, dot;
  for (int k = 0; k < 3; k++) mpq_inits(d[k][0], d[k][1], NULL);
  mpq_inits(t, dot, NULL);
  relative(d, b, v, 3);
  mpq_mul(dot, d[0][0], d[1][0]);
  mpq_mul(t, d[0][1], d[1][1]);
  mpq_add(dot, dot, t);
  assert_int_equal(dyd_mesh_between(&b->m, v[0], v[1], v[2]), mpq_sgn(dot) < 0);
  mpq_clears(t, dot, NULL);
  for (int k = 0; k < 3; k++) mpq_clears(d[k][0], d[k][1], NULL);
}

static void check_orient(bed *b, const uint32_t *v) {
  dyd_mesh *m = &b->m;
  const dyd_xy *xy = m->xy;
  int truth = literal(b, v, 3), sign = 7;
  tally.asked++;
  tally.ties += truth == 0;
  if (truth == 0) check_between(b, v);
  right_or_unsure(&tally.filter, b, dyd_filter_orient(m, xy[v[0]], xy[v[1]], xy[v[2]]), truth, "orient");
  right_or_unsure(&tally.near, b, dyd_filter_orient_near(m, xy[v[0]], xy[v[1]], xy[v[2]]), truth, "orient near");
  if (dyd_filter_orient_small(&sign, m, xy[v[0]], xy[v[1]], xy[v[2]])) {
    right(b, sign, truth, "orient small");
    tally.small++;
  }
  if (m->fixed) {
    right(b, dyd_fixed_orient(m, v[0], v[1], v[2]), truth, "fixed orient");
    tally.fixed++;
  }
  right(b, dyd_mesh_orient_exact(m, v[0], v[1], v[2]), truth, "exact orient");
  right(b, dyd_mesh_orient(&b->tally, m, v[0], v[1], v[2]), truth, "orient in all");
  right(b, dyd_build_orient(m, v[0], v[1], v[2]), truth, "orient of a builder");
}

static void check_incircle(bed *b, const uint32_t *v) {
  dyd_mesh *m = &b->m;
  dyd_xy p[4];
  for (int k = 0; k < 4; k++) p[k] = m->xy[v[k]];
  dyd_incircle at = dyd_incircle_of(p[0], p[1], p[2], p[3]);
  int truth = literal(b, v, 4), sign = 7;
  tally.asked++;
  tally.ties += truth == 0;
  right_or_unsure(&tally.filter, b, dyd_filter_incircle_at(m, at), truth, "incircle");
  right_or_unsure(&tally.near, b, dyd_filter_incircle_near(m, p[0], p[1], p[2], p[3]), truth, "incircle near");
  if (dyd_filter_incircle_small(&sign, m, at)) {
    right(b, sign, truth, "incircle small");
    tally.small++;
  }
  if (dyd_fixed_incircle(&sign, m, v[0], v[1], v[2], v[3])) {
    right(b, sign, truth, "fixed incircle");
    tally.fixed++;
  }
  right(b, dyd_mesh_incircle_exact(m, v[0], v[1], v[2], v[3]), truth, "exact incircle");
  right(b, dyd_mesh_incircle(&b->tally, m, v[0], v[1], v[2], v[3]), truth, "incircle in all");
  right(b, dyd_build_incircle(m, v[0], v[1], v[2], v[3]), truth, "incircle of a builder");
}

/* All the rungs, before and after the common grid is made, and after it is given back. */
static void check_bed(bed *b) {
  bed_make(b);
  for (int round = 0; round < 3; round++) {
    if (round == 1) {
      b->m.no_fixed = false;
      dyd_fixed_prepare(&b->m);
    }
    if (round == 2) dyd_mesh_trim(&b->m);
    for (int k = 0; k < 8; k++) {
      uint32_t v[POINTS];
      for (uint32_t i = 0; i < POINTS; i++) {
        uint32_t q = (uint32_t)test_below(&shared, i + 1);
        v[i] = v[q], v[q] = i;
      }
      if (round == 0) { /* without a grid it is unknown */
        b->m.exact_s = -1;
        b->m.no_fixed = true;
      }
      check_orient(b, v);
      check_incircle(b, v);
    }
  }
}

/* ---- coordinates ---- */

static void put(mpq_t out, int64_t man, int64_t exp) {
  mpz_set_si(mpq_numref(out), (long)man);
  mpz_set_ui(mpq_denref(out), 1);
  if (exp > 0)
    mpq_mul_2exp(out, out, (mp_bitcnt_t)exp);
  else
    mpq_div_2exp(out, out, (mp_bitcnt_t)-exp);
}

/* Points of small circles and lines, of `bits` more bits, some moved by one unit. */
static void near_tie(int64_t z[2], unsigned bits) {
  static const int64_t circle[4][2] = {{4, 33}, {9, 32}, {12, 31}, {23, 24}};
  const int64_t *c = circle[test_below(&shared, 4)];
  bool swap = test_chance(&shared, 2);
  for (int a = 0; a < 2; a++) {
    z[a] = (c[a ^ swap] * (test_chance(&shared, 2) ? 1 : -1)) * (INT64_C(1) << bits);
    if (bits && test_chance(&shared, 6)) z[a] += test_between(&shared, -1, 1);
  }
}

static void coordinates(int64_t z[2], unsigned bits) {
  if (test_chance(&shared, 2)) {
    near_tie(z, bits > 6 ? bits - 6 : 0);
    return;
  }
  for (int a = 0; a < 2; a++) z[a] = test_between(&shared, -(INT64_C(1) << bits), INT64_C(1) << bits);
}

/* Doubles at exponents where products of two and of four overflow or underflow. */
static void run_scales(int lo, int hi, int spread, size_t cases) {
  for (size_t k = cases; k; k--) {
    bed b;
    bed_open(&b);
    unsigned bits = (unsigned)test_between(&shared, 3, 52);
    long e = (long)test_between(&shared, lo, hi);
    for (int i = 0; i < POINTS; i++) {
      int64_t z[2], extra = spread ? test_between(&shared, 0, spread) : 0;
      coordinates(z, bits);
      for (int a = 0; a < 2; a++) put(b.q[i][a], z[a], e - (int64_t)bits + extra);
    }
    check_bed(&b);
    bed_close(&b);
  }
}

static void test_scales(void **state) {
  (void)state;
  static const int range[][3] = {{0, 0, 0},          {254, 262, 0},   {255, 257, 1},   {250, 272, 0},
                                 {250, 262, 12},     {505, 515, 0},   {500, 510, 9},   {-272, -240, 0},
                                 {-272, -240, 20},   {-400, -250, 0}, {-520, -500, 5}, {-1022, -1000, 0},
                                 {-1074, -1020, 30}, {1000, 1023, 0}, {-200, 200, 60}};
  for (size_t k = 0; k < sizeof range / sizeof *range; k++) {
    tally = (struct tally){0};
    run_scales(range[k][0], range[k][1], range[k][2], test_cases(120));
    fprintf(stderr, "# 2^%d .. 2^%d: asked %zu, ties %zu, filter %zu, near %zu, small %zu, fixed %zu\n", range[k][0],
            range[k][1], tally.asked, tally.ties, tally.filter, tally.near, tally.small, tally.fixed);
    if (k == 0) assert_true(tally.filter && tally.near && tally.fixed && tally.ties);
  }
}

/* Small integers times 2^e at the ends of the range in which doubles are exact [FLT-SMALL]. */
static void test_small_integers(void **state) {
  (void)state;
  static const int unit[] = {-245, -242, -241, -240, -239, 0, 5, 218, 219, 220, 221, 222, 226};
  tally = (struct tally){0};
  for (size_t k = 0; k < test_cases(60) * (sizeof unit / sizeof *unit); k++) {
    bed b;
    bed_open(&b);
    unsigned bits = (unsigned)test_between(&shared, 2, 14);
    for (int i = 0; i < POINTS; i++) {
      int64_t z[2];
      coordinates(z, bits);
      for (int a = 0; a < 2; a++) put(b.q[i][a], z[a], unit[k % (sizeof unit / sizeof *unit)]);
    }
    check_bed(&b);
    bed_close(&b);
  }
  assert_true(tally.small > 100 && tally.ties > 100);
}

/* Integers up to 2^60 - 1 and rationals on one grid: the widest products, exact ties among them [FIX-1]. */
static void test_widest(void **state) {
  (void)state;
  const int64_t top = (INT64_C(1) << 60) - 1;
  tally = (struct tally){0};
  for (size_t k = test_cases(500); k; k--) {
    bed b;
    bed_open(&b);
    int64_t x = test_between(&shared, top / 2, top), y = test_chance(&shared, 3) ? top : test_between(&shared, 0, top);
    static const unsigned long dens[] = {1, 1, 3, 5, 7};
    unsigned long den = dens[test_below(&shared, 5)];
    for (int i = 0; i < POINTS; i++) {
      bool swap = test_chance(&shared, 2);
      int64_t z[2] = {swap ? y : x, swap ? x : y};
      for (int a = 0; a < 2; a++) {
        int64_t off = test_chance(&shared, 8) ? test_between(&shared, 0, 2) : 0;
        put(b.q[i][a], (z[a] - off) * (test_chance(&shared, 2) ? 1 : -1), 0);
        mpz_set_ui(mpq_denref(b.q[i][a]), den);
        mpq_canonicalize(b.q[i][a]);
      }
    }
    check_bed(&b);
    bed_close(&b);
  }
  assert_true(tally.fixed > 1000 && tally.ties > 100);
}

/* Representatives that are not doubles: the filters work on rounded ones and know by how much (delta > 0). */
static void test_inexact(void **state) {
  (void)state;
  static const int range[][2] = {{0, 0}, {250, 272}, {505, 515}, {-272, -240}, {-1074, -1000}, {1000, 1025}};
  for (size_t r = 0; r < 6; r++) {
    tally = (struct tally){0};
    for (size_t k = test_cases(150); k; k--) {
      bed b;
      bed_open(&b);
      unsigned bits = (unsigned)test_between(&shared, 4, 54), more = (unsigned)test_between(&shared, 0, 61 - bits);
      long e = (long)test_between(&shared, range[r][0], range[r][1]);
      bool thirds = test_chance(&shared, 3);
      int64_t far[2] = {0,
                        0}; /* all about a point far from the origin, so that rounding moves them against each other */
      if (test_chance(&shared, 2)) {
        bits = (unsigned)test_between(&shared, 3, 20),
        more = test_chance(&shared, 2) ? 0 : (unsigned)test_below(&shared, 12);
        for (int a = 0; a < 2; a++) far[a] = test_between(&shared, INT64_C(1) << 52, INT64_C(1) << 60);
      }
      for (int i = 0; i < POINTS; i++) {
        int64_t z[2];
        coordinates(z, bits);
        for (int a = 0; a < 2; a++) {
          z[a] = z[a] * (INT64_C(1) << more) + test_between(&shared, -1, 1) + far[a];
          put(b.q[i][a], z[a], e - (int64_t)(bits + more));
          if (thirds) mpz_mul_ui(mpq_denref(b.q[i][a]), mpq_denref(b.q[i][a]), 3), mpq_canonicalize(b.q[i][a]);
        }
      }
      check_bed(&b);
      bed_close(&b);
    }
    fprintf(stderr, "# inexact 2^%d: asked %zu, ties %zu, filter %zu, near %zu, small %zu, fixed %zu\n", range[r][0],
            tally.asked, tally.ties, tally.filter, tally.near, tally.small, tally.fixed);
    if (r == 0) assert_true(tally.filter > 100);
  }
}

/* Points for which a product once overflowed and the bound did not. */
static void check_found(const double found[][2], int n) {
  bed b;
  bed_open(&b);
  for (int i = 0; i < POINTS; i++)
    for (int a = 0; a < 2; a++) mpq_set_d(b.q[i][a], found[i % n][a]);
  check_bed(&b);
  for (uint32_t k = 0; k < POINTS * POINTS * POINTS * POINTS; k++) {
    const uint32_t v[4] = {k % POINTS, k / POINTS % POINTS, k / POINTS / POINTS % POINTS, k / POINTS / POINTS / POINTS};
    check_orient(&b, v);
    check_incircle(&b, v);
  }
  bed_close(&b);
}

static void test_found(void **state) {
  (void)state;
  static const double turns[3][2] = {{0x1.99d68a711497p+511, 0x1.a587620a358abp+511},
                                     {0x1.3465e35d7f665p+512, 0x1.388ed15d9eefep+512},
                                     {-0x1.a58f408c48a82p+506, 0x1.5a109d27d23a8p+505}};
  static const double circles[6][2] = {{-0x1.ff5695p+255, 0x1.7cdbdbdp+255},   {0x1.35d08f1p+254, 0x1.7cb1d9ap+255},
                                       {0x1.259ada7p+255, -0x1.067517b8p+255}, {-0x1.8bb7beap+255, -0x1.95b687ep+254},
                                       {0x1.0df3b71p+255, 0x1.b4106ae8p+255},  {0x1.a2823fp+251, 0x1.86b57ecp+255}};
  check_found(turns, 3);
  check_found(circles, 6);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_scales), cmocka_unit_test(test_small_integers),
                                     cmocka_unit_test(test_widest), cmocka_unit_test(test_inexact),
                                     cmocka_unit_test(test_found)};
  shared = test_random_start("mesh");
  return cmocka_run_group_tests(tests, NULL, NULL);
}
