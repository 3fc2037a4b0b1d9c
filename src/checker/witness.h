/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Is a centre a witness? Exact, against all sites. */
#ifndef DYD_CHECKER_WITNESS_H
#define DYD_CHECKER_WITNESS_H

#include "checker/tree.h"

/* Is max(dl_i, dl_j)(c) < ds_k(c) for all k other than i, j and aliases [CERT-1]? With places: the same for the places
 * of the sites, |c - p_i|, |c - p_j| < |c - p_k| [CERT-2]. i and j are no aliases. *other (may be NULL) is a site that
 * is too near when the answer is no. Cost: about the logarithm of N, plus the sites that touch the disc. */
bool dyd_cert_is_witness(uint32_t *other, const dyd_cert_sites *s, const dyd_cert_tree *t, uint32_t i, uint32_t j,
                         const dyd_exact c[2], bool places);

#endif
