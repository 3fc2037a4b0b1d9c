/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Normal errors: how far regions reach so that all points lie in theirs with a stated probability [CNF-1]; and rows
 * that give one point, joined. */
#ifndef DYD_IO_READ_TWINS_H
#define DYD_IO_READ_TWINS_H

#include <dyadel/io.h>
#include <gmp.h>

/* What a row says of its point: exact ends of x and y, standard deviations of normal errors in x and y besides, and the
 * radius kept next to the rectangle. Initialise by dyd_twin_init. */
typedef struct dyd_twin {
  mpq_t lo[2], hi[2];
  double sigma[2], kept;
} dyd_twin;

void dyd_twin_init(dyd_twin *t);
void dyd_twin_clear(dyd_twin *t);
/* *out, initialised, becomes a region that holds each point that all n > 0 rows allow, with the options `o` that they
 * were read with: of boxes the intersection; of discs (o->round, squares around them) and of radii on the ground the
 * smallest one. In a coordinate in which all rows have a standard deviation it is their mean, weighted by the inverse
 * variances, with its standard deviation, which holds for independent errors [CNF-1]. Longitudes of `row` are moved by
 * whole turns. Returns DYD_E_DOMAIN where rows apart[0] and apart[1] have nothing in common, each row in all but the
 * smallest disc is compared with that alone; DYD_E_ARG where the radius of one is a length on the ground, and the other
 * is no exact place. O(n) */
dyd_status dyd_twins_merge(dyd_twin *out, size_t apart[2], dyd_twin *row, size_t n, const dyd_read_options *o);

/* ---- normal errors ---- */

/* Sets *out to the confidence of n points to be added to e; k is 0 where n is. Returns DYD_E_ARG if the text is not
 * like "95%" or "0.95", or if e already has a confidence. */
dyd_status dyd_confidence_for(dyd_confidence *out, const dyd_engine *e, const char *probability, size_t n,
                              dyd_error *err);

/* Returns the smallest double >= q >= 0; infinite beyond the range of doubles. */
double dyd_double_above(mpq_srcptr q);
/* Returns at least the longer half-axis of the ellipse of one standard deviation: the root of the larger eigenvalue of
 * the errors' covariance, with standard deviations sigma[0], sigma[1] >= 0 and correlation rho. */
double dyd_sigma_round(mpq_t sigma[2], mpq_srcptr rho);

#endif
