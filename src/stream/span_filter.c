/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Widths of intervals of doubles, and rounding them to a grid.
 *
 * [FLT-GRID] Scaling up by 2^k is exact unless it overflows, floor and ceil are exact, and an integer that came from
 * x 2^k times 2^-k is again a double: below 2^53 it has 53 bits and 2^-k is at least 2^-1002; beyond, it is x 2^k.
 * Where scaling overflows, both ends are multiples already. The computed width is at most 2^-(bits + 1), so the width
 * is less than that times 1 + 2^-52, and each end moves by less than one unit 2^-(bits + 2): less than 4 + 2^-51 units,
 * and as a whole number of them at most 4, which is 2^-bits. */
#include "stream/span_filter.h"

#include <math.h>

#define MOST_BITS 1000

int64_t dyd_filter_bits(dyd_double_span a) {
  double width = a.hi - a.lo;
  if (width == 0) return INT64_MAX;
  if (!(width <= 0.5)) return INT64_MIN;
  /* At most 2^e; subnormal widths are below 2^-1022. */
  uint64_t pattern = dyd_pattern_of(width);
  int64_t e = (int64_t)(pattern >> 52) - 1023 + (pattern << 12 != 0);
  return -e - 1 < MOST_BITS ? -e - 1 : MOST_BITS;
}

/* -1022 <= k <= 1023. */
static double power_of_two(int64_t k) {
  return dyd_double_of_pattern((uint64_t)(k + 1023) << 52);
}

bool dyd_filter_round(dyd_double_span *out, dyd_double_span a, int64_t bits) {
  int64_t most = dyd_filter_bits(a);
  if (bits > most || bits < 0) return false;
  *out = a;
  if (most == INT64_MAX) return true;
  if (bits > MOST_BITS) return false;
  double up = power_of_two(bits + 2), down = power_of_two(-bits - 2), lo = a.lo * up, hi = a.hi * up;
  if (isfinite(lo) && isfinite(hi)) *out = (dyd_double_span){floor(lo) * down + 0.0, ceil(hi) * down + 0.0};
  return true;
}
