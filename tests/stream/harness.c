/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Releases the caches that FLINT and MPFR keep for a thread. */
#include "harness.h"

#include <flint/flint.h>

int release_caches(void **state) {
  (void)state;
  flint_cleanup();
  mpfr_free_cache();
  return 0;
}
