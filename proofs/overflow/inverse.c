/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/inverse.c: intervals at a place, and which is narrower. */
/* Without begin_near, dyd_cert_enclosure_log_from, dyd_cert_enclosure_log, dyd_cert_enclosure_atan,
   dyd_cert_enclosure_asin, dyd_cert_enclosure_acos: tried, with intervals admitted to stay intervals up to four times;
   that they still do one or two calls later CVC4 does not prove (of begin_near, 3 of 48 goals in 3 s). */
/* Without settle_from: not run; it calls through a pointer to a function, and WP does not know valid_function. */
/* Without dyd_cert_enclosure_atan_from: not tried; it has one number more than dyd_cert_enclosure_log_from. */
#include "enclosures.h"

/*@ requires \valid(x) && interval(x) && whole(y) && \separated(x, y); assigns ALL_OF(x); exits \false;
    ensures interval(x); */
static void enclosure_set_at(dyd_cert_enclosure *x, mpz_srcptr y);
/*@ requires interval(x) && interval(y); assigns \nothing; exits \false; */
static bool is_narrower(const dyd_cert_enclosure *x, const dyd_cert_enclosure *y);

#include "checker/inverse.c"
