/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers that look random, each a function of a seed and its place in the sequence (splitmix64). */
#ifndef DYD_BASE_RANDOM_H
#define DYD_BASE_RANDOM_H

#include <stdint.h>

#define DYD_RANDOM_STEP UINT64_C(0x9E3779B97F4A7C15)

static inline uint64_t dyd_random(uint64_t seed, uint64_t k) {
  uint64_t z = seed + k * DYD_RANDOM_STEP;
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return z ^ (z >> 31);
}

#endif
