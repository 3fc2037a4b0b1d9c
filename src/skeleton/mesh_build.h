/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Building a skeleton: at once, or from strips. */
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
 * depends on the strips, not on the number of threads. */
dyd_status dyd_mesh_build_strips(dyd_mesh *m, dyd_reps *reps, const dyd_strips *strips, bool no_filter,
                                 const volatile int *cancel, unsigned threads);

#endif
