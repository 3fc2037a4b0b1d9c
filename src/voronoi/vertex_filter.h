/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Enclosures of Voronoi vertices in doubles. */
#ifndef DYD_VORONOI_VERTEX_FILTER_H
#define DYD_VORONOI_VERTEX_FILTER_H

#include "delaunay/state.h"

/* A box that holds the circumcentre of v[0], v[1], v[2] for every choice; false when doubles cannot tell. */
bool dyd_filter_vertex(dyd_bbox *out, const dyd_delaunay *pd, const uint32_t v[3]);

#endif
