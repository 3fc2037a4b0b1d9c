/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Enclosures of Voronoi vertices in doubles. */
#ifndef DYD_VORONOI_VERTEX_FILTER_H
#define DYD_VORONOI_VERTEX_FILTER_H

#include "delaunay/state.h"

/* Where the Voronoi vertices of undecided faces can lie. */

/* Shrinks *box, whose ends are finite, to a box that still holds all points of it that are possible for both ends of
 * one of the pairs and for a third site: *any = false when there are none. sites, ascending: the ends
 * and all their possible neighbours. [REGION-1] DYD_OK or DYD_E_NOMEM. */
dyd_status dyd_filter_region(dyd_bbox *box, bool *any, const dyd_delaunay *pd, const dyd_pair_list *pairs,
                             const dyd_index_list *sites);

/* A box that holds the circumcentre of v[0], v[1], v[2] for every choice; returns false when doubles cannot decide. */
bool dyd_filter_vertex(dyd_bbox *out, const dyd_delaunay *pd, const uint32_t v[3]);

#endif
