/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The bounds of a certificate, computed again. */
#ifndef DYD_CHECKER_BOUNDS_H
#define DYD_CHECKER_BOUNDS_H

#include "checker/sites.h"

/* Twice the sum of the areas of the hulls so far, and the greatest terms of the Hausdorff bound. */
typedef struct dyd_cert_bounds {
  dyd_cert_fraction area2;
  const dyd_exact *hausdorff; /* the bound stated, borrowed; NULL: none */
  bool exceeded;              /* a pair's term is greater */
} dyd_cert_bounds;

void dyd_cert_bounds_init(dyd_cert_bounds *b);
void dyd_cert_bounds_clear(dyd_cert_bounds *b);
/* Counts the pair: its hull's area; and whether its term is at most the Hausdorff bound stated: the greater diameter,
 * for pairs that are not legal plus half the greatest length [CERT-5]. */
void dyd_cert_bounds_add(dyd_cert_bounds *b, const dyd_cert_sites *s, uint32_t i, uint32_t j, bool legal);
/* Is the sum of the areas at most `area`? */
bool dyd_cert_bounds_area_holds(const dyd_cert_bounds *b, const dyd_exact *area);

#endif
