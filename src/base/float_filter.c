/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tried by sums and products whose results are known; volatile, so that they are done when the program runs. */
#define _GNU_SOURCE /* fegetexcept */
#include "base/float_filter.h"

#include "base/error.h"

#include <fenv.h>
#include <float.h>

/* 1, as on s390x, widens floats only. */
#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1
#error "the error bounds of filters need doubles that are rounded to double after each operation: on x86, -mfpmath=sse"
#endif
#if defined __FAST_MATH__ || __FINITE_MATH_ONLY__
#error "the error bounds of filters need sums in the order written, infinities and NaN: no -ffast-math"
#endif
#ifndef __SIZEOF_INT128__
#error "products of 64-bit numbers need 128-bit integers, which compilers have on 64-bit machines"
#endif

/* Filters overflow, underflow and divide by zero where nothing is decided by it. Other C libraries than glibc cannot
 * unmask traps. */
static bool float_traps(void) {
#ifdef __GLIBC__
  return fegetexcept() != 0;
#else
  return false;
#endif
}

static bool float_flushes(void) {
  volatile double least = DBL_MIN, half = 0.5, tiny = 0x1p-1074, one = 1;
  volatile double made = least * half, taken = tiny * one;
  return !(made > 0) || !(tiny > 0) || !(taken > 0);
}

/* Halfway cases go to the even neighbour, both up and down, for both signs. */
static bool float_rounds_to_nearest(void) {
  volatile double one = 1, half = 0x1p-53, more = 0x1.8p-53;
  volatile double even = one + half, up = one + more, minus = -one - half, down = -one - more;
  return even == 1 && up > 1 && minus == -1 && down < -1;
}

/* Without contraction the product is rounded before the subtraction, and the difference is 0. No macro says so. */
static bool float_contracts(void) {
  volatile double factor = 1 + 0x1p-30, square = factor * factor;
  double x = factor;
  return x * x - square != 0;
}

dyd_status dyd_float_check(dyd_error *err) {
  if (float_traps())
    return dyd_fail(err, DYD_E_ARG,
                    "this thread has unmasked traps of floating point, by which the process would end; call "
                    "fedisableexcept(FE_ALL_EXCEPT) before, and feenableexcept behind");
  if (float_flushes())
    return dyd_fail(err, DYD_E_ARG,
                    "this thread flushes subnormal numbers to zero, so that different points would be taken for one; "
                    "call fesetenv(FE_DFL_ENV) before, and link no library built with -ffast-math");
  if (!float_rounds_to_nearest())
    return dyd_fail(err, DYD_E_ARG,
                    "this thread does not round to nearest, and all bounds assume that; call fesetround(FE_TONEAREST)");
  if (float_contracts())
    return dyd_fail(err, DYD_E_ARG,
                    "this library was compiled to fuse products and sums, which its bounds do not hold for; compile it "
                    "with -ffp-contract=off");
  return DYD_OK;
}
