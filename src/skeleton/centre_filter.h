/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where the centres of triangles and the middles of Voronoi edges are, in doubles: guesses without a bound. */
#ifndef DYD_SKELETON_CENTRE_FILTER_H
#define DYD_SKELETON_CENTRE_FILTER_H

#include "skeleton/skeleton.h"

/* The circumcentre of the representatives; for a ghost triangle a place far enough beyond its hull edge. */
dyd_xy dyd_triangle_centre(const dyd_mesh *m, uint32_t t);
/* The middle of the skeleton's Voronoi edge; NaN or far off is possible. */
dyd_xy dyd_edge_centre(const dyd_skeleton *sk, dyd_half_edge h);
/* The middle between the representatives of the ends. */
dyd_xy dyd_edge_middle(const dyd_skeleton *sk, dyd_half_edge h);
/* Returns true if the middle of the Voronoi edge is so far away, compared with the length of the edge, that it is of
 * little use. */
bool dyd_edge_centre_is_far(const dyd_skeleton *sk, dyd_half_edge h);

#endif
