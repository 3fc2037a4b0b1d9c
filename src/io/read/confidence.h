/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Normal errors: how far regions reach so that all points lie in theirs with a stated probability [CNF-1]. */
#ifndef DYD_IO_READ_CONFIDENCE_H
#define DYD_IO_READ_CONFIDENCE_H

#include <dyadel/io.h>
#include <gmp.h>

/* Sets *out to the confidence of n points to be added to e; k is 0 where n is. Returns DYD_E_ARG if the text is not
 * like "95%" or "0.95", or if e already has a confidence. */
dyd_status dyd_confidence_for(dyd_confidence *out, const dyd_engine *e, const char *probability, size_t n,
                              dyd_error *err);

/* Returns the smallest double >= q >= 0; infinite beyond the range of doubles. */
double dyd_double_above(mpq_srcptr q);
/* Returns at least the root of q >= 0. */
double dyd_root_above(mpq_srcptr q);
/* Returns at least the longer half-axis of the ellipse of one standard deviation: the root of the larger eigenvalue of
 * the errors' covariance, with standard deviations sigma[0], sigma[1] >= 0 and correlation rho. */
double dyd_sigma_round(mpq_t sigma[2], mpq_srcptr rho);

#endif
