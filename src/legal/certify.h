/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which edges of the skeleton are certain: real edges legal, ghost edges surely on the hull. */
#ifndef DYD_LEGAL_CERTIFY_H
#define DYD_LEGAL_CERTIFY_H

#include "possible/cover.h"

/* Marks every certain edge of a fresh mesh, in options.threads threads. */
dyd_status dyd_certify_all(dyd_delaunay *pd);
/* Decides edge k of triangle t, by witness or hull test, and marks it. */
dyd_status dyd_certify_edge(dyd_delaunay *pd, dyd_work *w, uint32_t t, unsigned k);
/* Edge k of t, in a face (or a whole) of exact points bounded by certain edges: legal iff not cocircular, a hull edge
 * always, a ghost edge iff its vertex is not on the line of its neighbours [TIE-2]. Exact. */
bool dyd_point_edge_is_certain(dyd_delaunay *pd, uint32_t t, unsigned k);
/* The middle of the skeleton's Voronoi edge of edge k of t, in doubles; NaN or far off is possible. */
dyd_xy dyd_edge_centre(const dyd_delaunay *pd, uint32_t t, unsigned k);
/* The quick pass in doubles over all vertices: marks edges whose first guess is proved a witness [FLT-STAR]. */
dyd_status dyd_certify_stars(dyd_delaunay *pd);
/* Before it, for representatives that are doubles and sites within `reach` of them: marks the edges that the two
 * triangles beside them prove legal [WIT-NEAR]. met (NULL: no site is farther): of dyd_fat_meet for those that are. */
dyd_status dyd_certify_near(dyd_delaunay *pd, double reach, const uint32_t *met);

#endif
