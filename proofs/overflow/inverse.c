/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/inverse.c: intervals at a place, and which is narrower. */
/* Without settle_from: tried, the function that is called one of two; 100 of 105 goals are proved. Open are two goals
   function_pointer (WP does not know valid_function), and, Timeout in 5 s, what dyd_cert_enclosure_log_from and
   dyd_cert_enclosure_atan_from require, one goal of each. */
/* Without dyd_cert_enclosure_log_from: tried; Timeout in 4 s of its postcondition, and of what mpz_sub (the second),
   mpz_add (both) and dyd_cert_enclosure_clear (both) require. */
/* Without dyd_cert_enclosure_atan_from: tried; Timeout in 4 s of ten goals: its postcondition, a mem_access, and what
   the second dyd_cert_enclosure_mul, mpz_sgn, mpz_sizeinbase, mpz_add and dyd_cert_enclosure_clear require. */
/* Without dyd_cert_enclosure_log, dyd_cert_enclosure_atan, dyd_cert_enclosure_asin, dyd_cert_enclosure_acos: tried,
   with intervals admitted to stay intervals up to four times; that they still do one or two calls later CVC4 does not
   prove in 3 s. */
#define SPELL_OUT
#include "enclosures.h"

/*@ requires \valid(x) && interval(x) && whole(y) && \separated(x, y); assigns ALL_OF(x); exits \false;
    ensures interval(x); */
static void enclosure_set_at(dyd_cert_enclosure *x, mpz_srcptr y);
/*@ requires interval(x) && interval(y); assigns \nothing; exits \false; */
static bool is_narrower(const dyd_cert_enclosure *x, const dyd_cert_enclosure *y);

#include "checker/inverse.c"
