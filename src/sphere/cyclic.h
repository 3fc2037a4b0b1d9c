/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sums of roots of unity: are they 0? */
#ifndef DYD_SPHERE_CYCLIC_H
#define DYD_SPHERE_CYCLIC_H

#include <dyadel/status.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

__extension__ typedef __int128 dyd_turns;

/* Orders below this are taken: products with small primes stay in 128 bits. */
#define DYD_CYCLIC_MOST ((dyd_turns)1 << 110)

/* c times the root of unity e / n of a turn; n is that of the sum. */
typedef struct dyd_root_term {
  dyd_turns e;
  int64_t c;
} dyd_root_term;

/* *zero: sum c exp(2 pi i e / n) over the terms is 0. Decided exactly for all 0 < n < DYD_CYCLIC_MOST, |e| < n and
 * |c| < 2^31, count < 2^31 [SPH-3]; the terms are destroyed. DYD_OK or DYD_E_NOMEM. */
dyd_status dyd_cyclic_is_zero(bool *zero, dyd_root_term *term, size_t count, dyd_turns n);

#endif
