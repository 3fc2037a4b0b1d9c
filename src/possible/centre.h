/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One exact centre that shows many pairs to be possible, for sites nearly on a circle. */
#ifndef DYD_POSSIBLE_CENTRE_H
#define DYD_POSSIBLE_CENTRE_H

#include "delaunay/state.h"

/* Vertices that are possibly nearest at one point, so that all pairs of them are possible [POS-1]: those with ds <= M
 * at a dyadic point next to the centre of the circle through the representatives of v[0..2], exactly. Few or none if
 * these are (nearly) collinear; none if the circle may hold or touch more than `most`. *vertex is owned by the caller,
 * NULL when *count is 0. */
dyd_status dyd_centre_shows(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, const uint32_t v[3], size_t most);

/* c: a dyadic point next to the middle of the centres of the circles through the representatives of i, j and each of
 * the two across: where a witness of ij is likely, at any depth. *found: false when one of the triples is collinear. */
dyd_status dyd_centre_between(bool *found, dyd_point *c, const dyd_delaunay *pd, uint32_t i, uint32_t j,
                              const uint32_t across[2]);

#endif
