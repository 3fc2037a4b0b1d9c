/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Random integers and dyadics, biased to small values, long mantissas and the ends of the ranges of doubles. */
#ifndef DYD_TESTS_RANDOM_DYADIC_H
#define DYD_TESTS_RANDOM_DYADIC_H

#include "support/random.h"
#include <dyadel/dyadic.h>

/* At most `bits` bits, often few, often with long runs of equal bits. */
static inline void random_integer(mpz_t out, test_random *r, unsigned bits) {
  unsigned size = test_chance(r, 2) ? 4 : 1 + (unsigned)test_below(r, bits);
  mpz_set_ui(out, 0);
  for (unsigned have = 0; have < size; have += 64) {
    uint64_t word = test_u64(r);
    if (test_chance(r, 4)) word = test_chance(r, 2) ? 0 : UINT64_MAX;
    mpz_mul_2exp(out, out, 64);
    mpz_add_ui(out, out, word);
  }
  mpz_fdiv_r_2exp(out, out, size);
  if (test_chance(r, 2)) mpz_neg(out, out);
}

static inline int64_t random_exponent(test_random *r) {
  static const int64_t middle[] = {0, 0, 0, -1074, -1022, 971, 1024, -200, 200};
  return middle[test_below(r, sizeof middle / sizeof *middle)] + test_between(r, -70, 70);
}

static inline void random_dyadic(dyd_dyadic *out, test_random *r) {
  mpz_t man;
  mpz_init(man);
  random_integer(man, r, 200);
  (void)dyd_dyadic_set_z_2exp(out, man, random_exponent(r));
  mpz_clear(man);
}

#endif
