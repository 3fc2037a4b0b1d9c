/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Building a skeleton, at once or from strips. */
#ifndef DYD_SKELETON_MESH_BUILD_H
#define DYD_SKELETON_MESH_BUILD_H

#include "skeleton/mesh.h"

/* The skeleton of the n vertices of reps listed in local (NULL: all). Representatives that coincide are moved within
 * their rectangles; equal exact points become aliases; if all representatives are collinear they are moved too,
 * unless every choice is collinear. cancel may be NULL. *m is cleared on failure. */
dyd_status dyd_mesh_build(dyd_mesh *m, dyd_reps *reps, const uint32_t *local, uint32_t n, bool no_filter,
                          const volatile int *cancel);
/* From strips, if there are several and that is possible: no representative has to be moved, strips are divided by
 * vertical lines and none is collinear; else as dyd_mesh_build. Which of several skeletons comes out at exact ties
 * depends on the strips, not on the number of threads. vertex: the vertex of each site, where some sites are joined:
 * these are aliases from the start, and strips are not used; else NULL. */
dyd_status dyd_mesh_build_strips(dyd_mesh *m, dyd_reps *reps, const dyd_strips *strips, const uint32_t *vertex,
                                 bool no_filter, const volatile int *cancel, unsigned threads);

/* Sets xy (own_xy, a copy, for a part of the vertices) and the filter constants. */
void dyd_mesh_coordinates(dyd_mesh *m);
/* Makes room for vertices up to n, which are points that reps has already; the ghost gets the number n. ghost: a ghost
 * triangle. width: that of all points in x and y. DYD_E_NOMEM: only clearing is allowed. */
dyd_status dyd_mesh_grow(dyd_mesh *m, uint32_t n, uint32_t ghost, const double width[2]);
/* Sets *t to the triangle in which, or the ghost triangle beyond whose edge, the new vertex v is, near the one put in
 * before, and *same to the vertex at the same place, or DYD_NONE. */
void dyd_mesh_find(uint32_t *t, uint32_t *same, dyd_mesh *m, uint32_t v);
/* Puts v into t, where it was found; the hint becomes a triangle at v. */
dyd_status dyd_mesh_put(dyd_mesh *m, uint32_t v, uint32_t t);
/* Returns true if the representatives of a and b are the same exact point. */
bool dyd_mesh_same(const dyd_mesh *m, uint32_t a, uint32_t b);
/* Gives back what only building needs. */
void dyd_mesh_trim(dyd_mesh *m);
void dyd_mesh_clear(dyd_mesh *m);

/* Returns true if vertical lines divide the strips of representatives. */
bool dyd_strips_are_apart(const dyd_reps *reps, const dyd_strips *strips);

#endif
