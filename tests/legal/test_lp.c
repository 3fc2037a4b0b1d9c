/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The linear programme in doubles against all triples of cuts. */
#include <setjmp.h>
#include <stdarg.h>

#include "legal/lp_filter.h"
#include "support/random.h"
#include <cmocka.h>
#include <math.h>

static test_random shared;

/* The optimum of three cuts, where 0 is in the hull of their normals. */
static bool triple(double *z, const dyd_cut *a, const dyd_cut *b, const dyd_cut *c) {
  double la = b->nx * c->ny - b->ny * c->nx, lb = c->nx * a->ny - c->ny * a->nx, lc = a->nx * b->ny - a->ny * b->nx;
  double sum = la + lb + lc;
  if (fabs(sum) < 1e-9 || la * sum < 0 || lb * sum < 0 || lc * sum < 0) return false;
  *z = (la * a->d + lb * b->d + lc * c->d) / sum;
  return true;
}

static double least_over_triples(const dyd_cut *cut, size_t count) {
  double least = INFINITY, z;
  for (size_t a = 0; a < count; a++)
    for (size_t b = 0; b < a; b++)
      for (size_t c = 0; c < b; c++)
        if (triple(&z, &cut[a], &cut[b], &cut[c]) && z < least) least = z;
  return least;
}

/* Normals in general position: antiparallel up to rounding, a guess may go astray. */
static size_t random_cuts(dyd_cut *cut) {
  size_t count = (size_t)test_below(&shared, 13);
  for (size_t q = 0; q < count; q++) {
    bool regular = test_chance(&shared, 3);
    double angle = regular ? ((double)test_below(&shared, 24) + test_unit(&shared) * 0x1p-8) * 0.2617993877991494
                           : test_unit(&shared) * 6.283185307;
    cut[q] = (dyd_cut){cos(angle), sin(angle), test_unit(&shared) * 4 - 2};
  }
  return count;
}

/* The value is that of the point. Bounded: it is the optimum; else it is as good as the optimum inside the frame. */
static void test_lp(void **state) {
  (void)state;
  size_t bounded = 0;
  const double h = sqrt(0.75), bound = 100;
  for (size_t k = test_cases(3000); k; k--) {
    dyd_cut cut[15];
    size_t count = random_cuts(cut);
    dyd_lp_result r = dyd_lp_centre(cut, count, bound);
    cut[count] = (dyd_cut){0, 1, bound};
    cut[count + 1] = (dyd_cut){-h, -0.5, bound};
    cut[count + 2] = (dyd_cut){h, -0.5, bound};
    double own = least_over_triples(cut, count), framed = least_over_triples(cut, count + 3), value = INFINITY;
    for (size_t q = 0; q < count; q++) value = fmin(value, cut[q].nx * r.x + cut[q].ny * r.y + cut[q].d);
    bool good = r.bounded ? fabs(r.z - own) < 1e-5 && fabs(value - own) < 1e-5
                          : value > r.z - 1e-5 && r.z > framed - 1e-5 && r.z < own + 1e-5;
    bounded += r.bounded;
    if (!r.bounded && hypot(r.x, r.y) > 10 * bound) continue; /* an open end: any centre far out will do */
    if (good && r.bounded)
      good = triple(&value, &cut[r.basis[0]], &cut[r.basis[1]], &cut[r.basis[2]]) && fabs(value - own) < 1e-5;
    if (good) continue;
    for (size_t q = 0; q < count; q++) fprintf(stderr, "%a %a %a\n", cut[q].nx, cut[q].ny, cut[q].d);
    fail_msg("%zu cuts: %g, at the point %g; best %g, in the frame %g", count, r.z, value, own, framed);
  }
  assert_true(bounded > 100);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_lp)};
  shared = test_random_start("lp");
  return cmocka_run_group_tests(tests, NULL, NULL);
}
