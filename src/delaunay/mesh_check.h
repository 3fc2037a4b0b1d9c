/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The invariant of the skeleton, checked in the verify build. */
#ifndef DYD_DELAUNAY_MESH_CHECK_H
#define DYD_DELAUNAY_MESH_CHECK_H

#include "delaunay/mesh.h"

/* Twins agree, triangles turn left, every edge is locally (weakly) Delaunay, the hull is one cycle that turns once:
 * hence the whole is a Delaunay triangulation. Exact; O(n). */
bool dyd_mesh_check(dyd_mesh *m);

#endif
