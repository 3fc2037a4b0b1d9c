/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Linked with a check of floating point that was compiled with contraction, which is refused. */
#include "base/float_filter.h"

#include <string.h>

int main(void) {
  enum { SKIPPED = 77 };
  dyd_error err;
  if (!__builtin_cpu_supports("fma")) return SKIPPED;
  return !(dyd_float_check(&err) == DYD_E_ARG && strstr(err.message, "-ffp-contract=off"));
}
