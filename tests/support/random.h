/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Deterministic random numbers for tests: the seed and the scale come from the environment and are printed.
 *
 * DYADEL_TEST_SEED (default 1) chooses the cases, DYADEL_TEST_SCALE (default 1) multiplies their number; with
 * sanitizers, which make each many times as slow, DYADEL_TEST_SANITIZED asks for a sixth. */
#ifndef DYD_TESTS_RANDOM_H
#define DYD_TESTS_RANDOM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct test_random {
  uint64_t state;
} test_random;

static inline uint64_t test_environment(const char *name, uint64_t otherwise) {
  const char *text = getenv(name);
  return text && *text ? strtoull(text, NULL, 10) : otherwise;
}

/* How many random cases to run when `base` is the number for everyday runs; where few of them would show nothing. */
static inline size_t test_cases_all(size_t base) {
  return base * (size_t)test_environment("DYADEL_TEST_SCALE", 1);
}

/* The same, with sanitizers fewer. */
static inline size_t test_cases(size_t base) {
  size_t cases = test_cases_all(base);
  return test_environment("DYADEL_TEST_SANITIZED", 0) ? (cases + 5) / 6 : cases;
}

/* Of the cases so many are of a kind that a test is about; with sanitizers, a third as many. */
static inline size_t test_least(size_t base) {
  return test_environment("DYADEL_TEST_SANITIZED", 0) ? base / 3 : base;
}

/* Step of tests that try place by place: every place, with sanitizers every eleventh. */
static inline size_t test_stride(void) {
  return test_environment("DYADEL_TEST_SANITIZED", 0) ? 11 : 1;
}

/* splitmix64 */
static inline uint64_t test_u64(test_random *r) {
  uint64_t z = r->state += UINT64_C(0x9E3779B97F4A7C15);
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return z ^ (z >> 31);
}

/* A generator for the test called `name`; prints the seed so that a failure can be run again. */
static inline test_random test_random_of(const char *name, uint64_t seed) {
  fprintf(stderr, "# %s: DYADEL_TEST_SEED=%llu\n", name, (unsigned long long)seed);
  test_random mix = {seed};
  return (test_random){test_u64(&mix)}; /* neighbouring seeds start far apart */
}
static inline test_random test_random_start(const char *name) {
  return test_random_of(name, test_environment("DYADEL_TEST_SEED", 1));
}

/* Uniform in 0 .. n-1. */
static inline uint64_t test_below(test_random *r, uint64_t n) {
  return test_u64(r) % n;
}
/* Uniform in lo .. hi. */
static inline int64_t test_between(test_random *r, int64_t lo, int64_t hi) {
  return lo + (int64_t)test_below(r, (uint64_t)(hi - lo) + 1);
}
static inline bool test_chance(test_random *r, unsigned one_in) {
  return test_below(r, one_in) == 0;
}
/* Uniform in [0,1), a multiple of 2^-53. */
static inline double test_unit(test_random *r) {
  return (double)(test_u64(r) >> 11) * 0x1p-53;
}

#endif
