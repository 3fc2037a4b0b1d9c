/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Triangulating strips by themselves, and joining neighbours along a seam.
 *
 * Two meshes left and right of a vertical line are two spheres, each with the ghost. They are glued along the lower
 * common tangent of their hulls, where both are cut open from the hull to the ghost; then the seam is zipped upwards,
 * as in Guibas and Stolfi (1985), every step being one flip of an edge: deleting an inner edge next to the seam flips
 * it with its ghost triangle, adding an edge across flips the edge between two ghost triangles.
 *
 * [JOIN-1] The result is a Delaunay triangulation of the union, and every exact zero among the quads and hull corners
 * of its seam was met, so that [TIE-1] holds for joined meshes too. */
#ifndef DYD_SKELETON_JOIN_H
#define DYD_SKELETON_JOIN_H

#include "skeleton/mesh.h"

/* Do vertical lines divide the strips of representatives? */
bool dyd_strips_are_apart(const dyd_reps *reps, const dyd_strips *strips);
/* Triangulates m, which has its coordinates and no triangles. *joined = false: some part was stuck, m is as it was. */
dyd_status dyd_mesh_join_strips(bool *joined, dyd_mesh *m, const dyd_strips *strips, const volatile int *cancel,
                                unsigned threads);

#endif
