/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Triangulating vertices one after the other. */
#ifndef DYD_SKELETON_INSERT_H
#define DYD_SKELETON_INSERT_H

#include "skeleton/mesh.h"

/* A triangle whose circle holds v, which is no vertex: the real triangle around it, or a ghost triangle whose hull edge
 * it is beyond. */
uint32_t dyd_mesh_locate(dyd_mesh *m, uint32_t v);
/* Triangulates the vertices from begin to end; used on parts. DYD_CANCELLED also when a part is stuck. */
dyd_status dyd_mesh_fill(dyd_mesh *m, const volatile int *cancel);

#endif
