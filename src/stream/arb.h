/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Arb, wherever it is: a part of FLINT 3, whose headers are in flint/, or a library separate from FLINT 2. Names that
 * we use are the same in both. FLINT 3 does not include GMP. */
#ifndef DYD_STREAM_ARB_H
#define DYD_STREAM_ARB_H

#include "base/local.h"
#ifdef DYD_ARB_IN_FLINT
#include <flint/arb.h>
#include <flint/arb_fmpz_poly.h>
#else
#include <arb.h>
#include <arb_fmpz_poly.h>
#endif

DYD_NUMBER(arb)
DYD_RUNS(arb_struct, arb_init, arb_clear, &)
DYD_NUMBER(arf)
DYD_NUMBER(mag)
DYD_NUMBER(fmpz)
DYD_NUMBER(fmpq)
DYD_NUMBER(fmpz_poly)

#endif
