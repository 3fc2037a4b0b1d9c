/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sure edges of the Voronoi diagram: one for each legal pair, between vertices of sure triangles and of ties. */
#ifndef DYD_IO_DUAL_H
#define DYD_IO_DUAL_H

#include "base/room.h"
#include <dyadel/voronoi.h>

typedef enum dyd_dual_kind {
  DYD_DUAL_OPEN = 0, /* ends in the region of an undecided face */
  DYD_DUAL_VERTEX,   /* at the vertex of a sure triangle, or of a tied face */
  DYD_DUAL_RAY       /* unbounded, for every choice; beyond a tied chain, for the true points */
} dyd_dual_kind;

typedef struct dyd_dual_end {
  dyd_dual_kind kind;
  size_t vertex;       /* number of the triangle; of a tied face: beyond the triangles */
  double direction[4]; /* of a ray: bounds of both components of a vector along it, rounded outward */
} dyd_dual_end;

/* end[0] is on the left of the way from i to j, end[1] on its right. */
typedef struct dyd_dual_edge {
  uint32_t i, j;
  dyd_dual_end end[2];
} dyd_dual_edge;

/* Where the face is among those that are tied, ascending; NULL: it is none of them. */
const size_t *dyd_dual_tied(const size_t *tied, size_t ties, size_t face);

/* tied: faces of pd whose sites are on one circle, ascending. *out is new, sorted by i and j; release with free().
 * DYD_E_NOMEM, too, when *room has none. */
dyd_status dyd_dual_edges(dyd_dual_edge **out, size_t *count, const dyd_delaunay *pd,
                          const dyd_triangle_list *triangles, const size_t *tied, size_t ties, dyd_room *room);

#endif
