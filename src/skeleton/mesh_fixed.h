/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The middle rung: representatives as 64-bit integers on one common grid, products in 128 and 256 bits. */
#ifndef DYD_SKELETON_MESH_FIXED_H
#define DYD_SKELETON_MESH_FIXED_H

#include "skeleton/mesh.h"

/* Puts all representatives of m on a common grid with coordinates below 2^60, if there is one and that was not tried
 * yet; sets m->fixed or m->no_fixed. Never fails: without memory or grid, m->no_fixed. O(n), once per mesh. */
void dyd_fixed_prepare(dyd_mesh *m);
/* Exact signs; m->fixed is set. */
int dyd_fixed_orient(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c);
/* Exact sign on a grid of the four points' own, or on the common one; false when neither exists. */
bool dyd_fixed_incircle(int *sign, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p);
void dyd_fixed_free(dyd_fixed *f);
/* m, a part that grows by `right`: the grid of both, or none yet. m takes the grid of `whole`, which has none
 * afterwards. Only for meshes whose representatives are doubles. */
void dyd_fixed_join(dyd_mesh *m, const dyd_mesh *right);
void dyd_fixed_take(dyd_mesh *m, dyd_mesh *whole);

#endif
