/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From circles in scaled integers to circles in the coordinates of the caller. */
#ifndef DYD_PREDICATE_CIRCLE_H
#define DYD_PREDICATE_CIRCLE_H

#include "predicate/icircle.h"

/* out = k divided by man * 2^exp, man > 0: undoes dyd_irects_scale. Exact. */
void dyd_circle_unscale(dyd_circle *out, const dyd_icircle *k, mpz_srcptr man, int64_t exp);

#endif
