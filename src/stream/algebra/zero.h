/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Decides if the value of a form is 0: proved, or not. */
#ifndef DYD_STREAM_ALGEBRA_ZERO_H
#define DYD_STREAM_ALGEBRA_ZERO_H

#include "base/memory.h"
#include "stream/algebra/ring.h"

/* From a form to a fraction of polynomials in the leaves. */

/* Makes the fractions of the forms given; until then leaves are not settled. */
dyd_status dyd_ring_settle(dyd_ring *r, const uint32_t *node, size_t count);
/* The fraction of form n; NULL: not known, or beyond the limits. Borrowed. */
const dyd_fraction *dyd_ring_fraction(dyd_ring *r, uint32_t n);

/* The precision that tests begin with, in bits. */
enum { DYD_ZERO_FIRST_BITS = 128 };

typedef enum dyd_zero { DYD_ZERO_UNKNOWN, DYD_ZERO_PROVED, DYD_ZERO_REFUTED } dyd_zero;

/* What tests found, since the start. */
typedef struct dyd_zero_counts {
  uint64_t tests, by_identity, by_bound, nonzero, unknown;
  int64_t bits, degree; /* the most computed with; the largest degree of a separation bound */
} dyd_zero_counts;

/* One group of forms and their tests: common parts are shared. Init with dyd_algebra_open. */
typedef struct dyd_algebra {
  dyd_forms forms;
  dyd_ring ring;
  bool settled;
  slong most;                 /* bits computed with at most */
  const volatile int *cancel; /* NULL: no flag */
  dyd_memory *memory;         /* NULL: no bound; forms it refuses stay unknown */
  dyd_zero_counts count;
  slong shown; /* bits at which the last value refuted was seen not to be 0 */
} dyd_algebra;

dyd_status dyd_algebra_open(dyd_algebra *a, int64_t most_bits, const volatile int *cancel);
void dyd_algebra_close(dyd_algebra *a);
/* Settles the leaves of the forms given. All forms tested later are sums, differences and products of these. DYD_OK or
 * DYD_E_NOMEM. */
dyd_status dyd_algebra_settle(dyd_algebra *a, const uint32_t *node, size_t count);
/* Returns true if n is seen not to be 0 at a low precision, or at a moderate one. Leaves need not be settled; DYD_NONE
 * is not. */
bool dyd_algebra_is_refuted(dyd_algebra *a, uint32_t n);
bool dyd_algebra_is_nonzero(dyd_algebra *a, uint32_t n);
/* To `prec` bits: the least e such that |value of n| >= 2^-e is seen; INT64_MAX: none is. */
int64_t dyd_algebra_smallness(dyd_algebra *a, uint32_t n, slong prec);
/* Decides about form n [IDN-1] [SEP-1], which is refuted at most where n is DYD_NONE or leaves could not be settled. */
dyd_zero dyd_algebra_test(dyd_algebra *a, uint32_t n);

#endif
