/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of chains of blockers. */
#ifndef DYD_PROOFS_CHAINS_H
#define DYD_PROOFS_CHAINS_H

#include "sites.h"

#include "checker/chain.h"

typedef const dyd_cert_chain *chain_of;
typedef const dyd_cert_sites *sites_of;

/*@ predicate certified_chain(chain_of c, sites_of s) = \valid_read(c) && 0 < c->points <= c->cap &&
      \valid_read(c->blocker + (0 .. c->points)) && \valid_read(c->point + (0 .. c->points - 1)) &&
      (\forall integer q; 0 <= q <= c->points ==> small_site(s->site + c->blocker[q])) &&
      (\forall integer q; 0 <= q < c->points ==> small(&c->point[q][0]) && small(&c->point[q][1])) &&
      small(&c->u[0][0]) && small(&c->u[0][1]) && small(&c->u[1][0]) && small(&c->u[1][1]); */

#endif
