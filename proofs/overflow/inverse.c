/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/inverse.c: intervals at a place, and which is narrower. */
#define SPELL_OUT
#include "enclosures.h"

/*@ requires \valid(x) && interval(x) && whole(y) && \separated(x, y); assigns ALL_OF(x); exits \false;
    ensures interval(x); */
static void enclosure_set_at(dyd_cert_enclosure *x, mpz_srcptr y);
/*@ requires interval(x) && interval(y); assigns \nothing; exits \false; */
static bool is_narrower(const dyd_cert_enclosure *x, const dyd_cert_enclosure *y);

#include "checker/inverse.c"
