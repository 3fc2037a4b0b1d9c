/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Roots of polynomials: limits and the state of one root. */
#ifndef DYD_STREAM_ROOT_H
#define DYD_STREAM_ROOT_H

#include <dyadel/stream.h>
#include <flint/fmpz_poly.h>

/* Largest degree; largest product of a degree and the bits of a coefficient or of an end of the bracket. */
#define DYD_ROOT_DEGREE ((size_t)1000)
#define DYD_ROOT_WORK ((size_t)1 << 22)

/* A root of the integer polynomial poly, which has simple roots only, between two places of opposite
 * sign. sign_left = -1 or 1 is the sign at the left one.
 * Invariant: !on_grid: the root lies in the open interval (lo,hi); on_grid: in the open interval
 * (slot, slot + 1) 2^-s, or it is the point slot 2^-s when exact. isolated: the slot holds one root only. */
typedef struct dyd_root {
  fmpz_poly_t poly;
  mpq_t lo, hi;
  bool on_grid, exact, isolated;
  int sign_left;
  mpz_t slot;
  int64_t s;
  unsigned jump; /* places to be gained by the next quadratic step */
} dyd_root;

/* One step of narrowing towards a slot of side 2^-target; each step halves the bracket at least [ROOT-1].
 * DYD_CANCELLED, and the bracket as it was, once *stop is set (NULL: no flag). */
dyd_status dyd_root_step(dyd_root *r, int64_t target, const volatile int *stop, dyd_error *err);
/* Returns true if the bracket is at most 2^-bits wide (or the root known exactly). */
bool dyd_root_is_narrow(const dyd_root *r, int64_t bits);
/* A copy with a bracket of its own; to be freed. DYD_OK or DYD_E_NOMEM. */
dyd_status dyd_root_copy(dyd_root **out, const dyd_root *r);
void dyd_root_free(dyd_root *r);

#endif
