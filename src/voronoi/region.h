/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where the Voronoi vertices of undecided faces can lie. */
#ifndef DYD_VORONOI_REGION_H
#define DYD_VORONOI_REGION_H

#include "delaunay/state.h"

/* Shrinks *box to a box that still holds all points of it that are possible for both ends of one of the pairs (in
 * Pos_i n Pos_j): false when there are none. sites lists those of the face. [REGION-1] */
bool dyd_filter_region(dyd_bbox *box, const dyd_delaunay *pd, const dyd_pair_list *pairs, const dyd_index_list *sites);

#endif
