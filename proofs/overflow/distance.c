/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/distance.c: what is reckoned on the grid. Areas are numbers of 64 bits here: their values
 * are no part of the proof. */
#define __int128 long long
#include "sites.h"

#include "base/alloc.h"

#define ITEM uint32_t
#define RESERVE dyd_reserve
#define ALLOC alloc_indices
#include "lists.h"

#include "checker/distance.h"
#include "checker/tree.h"

#undef mpz_inits
#undef mpz_clears
#define mpz_inits(a, b, c, d, end) (mpz_init(a), mpz_init(b), mpz_init(c), mpz_init(d))
#define mpz_clears(a, b, c, d, end) (mpz_clear(a), mpz_clear(b), mpz_clear(c), mpz_clear(d))

/*@ requires -2305843009213693952 <= d <= 2305843009213693952; assigns \nothing; exits \false; */
static inline dyd_cert_area dyd_cert_square(int64_t d);

#include "checker/distance.c"
