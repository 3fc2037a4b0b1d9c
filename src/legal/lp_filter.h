/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A small linear program in doubles: the centre of the largest disc inside a few half-planes.
 *
 * It only proposes: its user proves that the centre is a witness, or that three half-planes have no common point, so no
 * error bound is needed here. */
#ifndef DYD_LEGAL_LP_FILTER_H
#define DYD_LEGAL_LP_FILTER_H

#include <stdbool.h>
#include <stddef.h>

enum { DYD_LP_CUTS = 192 };

/* The half-plane n.x + d > 0 with |n| = 1. */
typedef struct dyd_cut {
  double nx, ny, d;
} dyd_cut;

/* The centre x maximises z = min over the cuts of n.x + d, within about `bound` of the origin. */
typedef struct dyd_lp_result {
  double x, y, z;
  int basis[3]; /* the three cuts that bound z */
  bool bounded; /* none of the three is the artificial bound; else basis is unset */
} dyd_lp_result;

dyd_lp_result dyd_lp_centre(const dyd_cut *cut, size_t count, double bound);

#endif
