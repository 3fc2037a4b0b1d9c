/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Arb, wherever it is: a part of FLINT 3, whose headers are in flint/, or a library separate from FLINT 2. Names that
 * we use are the same in both. FLINT 3 does not include GMP. */
#ifndef DYD_STREAM_ARB_H
#define DYD_STREAM_ARB_H

#include <gmp.h>
#ifdef DYD_ARB_IN_FLINT
#include <flint/arb.h>
#include <flint/arb_fmpz_poly.h>
#else
#include <arb.h>
#include <arb_fmpz_poly.h>
#endif

#endif
