/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The invariant of the skeleton, checked in the armed build. */
#ifndef DYD_SKELETON_MESH_INVARIANT_H
#define DYD_SKELETON_MESH_INVARIANT_H

#include "skeleton/mesh.h"

/* Twins agree, triangles turn left, every edge is locally (weakly) Delaunay, the hull is one cycle that turns once:
 * hence the whole is a Delaunay triangulation. Exact; O(n). */
bool dyd_mesh_is_valid(const dyd_mesh *m);

#endif
