/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One exact centre that shows many pairs to be possible, for sites nearly on a circle. */
#ifndef DYD_POSSIBLE_CENTRE_H
#define DYD_POSSIBLE_CENTRE_H

#include "skeleton/skeleton.h"

/* Vertices that are possibly nearest at one point, so that all pairs of them are possible [POS-1]: those with ds <= M
 * at a dyadic point next to the centre of the circle through the representatives of v[0..2], exactly. Few or none if
 * these are (nearly) collinear; none if the circle may hold or touch more than `most`. *vertex is owned by the caller,
 * NULL when *count is 0. */
dyd_status dyd_centre_shows(uint32_t **vertex, size_t *count, const dyd_skeleton *sk, const uint32_t v[3], size_t most);

#endif
