/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Chains that prove a pair illegal. */
#ifndef DYD_CHECKER_CHAIN_H
#define DYD_CHECKER_CHAIN_H

#include "checker/sites.h"

/* A ray from point 0 in direction u[0], the segments between successive points, a ray from the last point in direction
 * u[1]. Piece t, counted from the first ray, has the blocker blocker[t]: points + 1 of them. Invariant: points >= 1. */
typedef struct dyd_cert_chain {
  size_t points, cap;
  dyd_exact (*point)[2];
  uint32_t *blocker;
  dyd_exact u[2][2];
} dyd_cert_chain;

void dyd_cert_chain_init(dyd_cert_chain *c);
void dyd_cert_chain_clear(dyd_cert_chain *c);
/* Room for so many points, initialised; points is set. */
dyd_status dyd_cert_chain_resize(dyd_cert_chain *c, size_t points);
/* Does the chain prove that ij is impossible [CERT-4]? Every piece lies where its blocker is surely nearer than i and
 * than j, and the chain separates R_i from R_j. The blockers are sites and no aliases. */
bool dyd_cert_chain_holds(const dyd_cert_chain *c, const dyd_cert_sites *s, uint32_t i, uint32_t j);

#endif
