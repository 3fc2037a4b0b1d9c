/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The rungs of the skeleton's predicates beyond doubles. */
#ifndef DYD_SKELETON_MESH_EXACT_H
#define DYD_SKELETON_MESH_EXACT_H

#include "skeleton/mesh.h"

/* Exact signs for real vertices, by integers. */
int dyd_mesh_orient_exact(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c);
int dyd_mesh_incircle_exact(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p);
/* Which comes first in the order of x, then y: below 0, a. */
int dyd_mesh_compare(const dyd_mesh *m, uint32_t a, uint32_t b);
/* Does p, known to be collinear with a and b, lie strictly between them? */
bool dyd_mesh_between(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p);
/* Are the representatives of a and b the same exact point? */
bool dyd_mesh_same(const dyd_mesh *m, uint32_t a, uint32_t b);

#endif
