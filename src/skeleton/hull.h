/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which vertices are certainly, which are possibly on the convex hull (mathematics: sections 3, 6). */
#ifndef DYD_SKELETON_HULL_H
#define DYD_SKELETON_HULL_H

#include "skeleton/work.h"

/* Sets *sure to whether some direction u has min_{R_v} u.x > max_{R_k} u.x for all other k: v is a vertex of the hull
 * for every choice then [HUL-2]. Exact. */
dyd_status dyd_hull_sure(bool *sure, dyd_work *w, const dyd_skeleton *sk, uint32_t v);

/* A direction u with min_{R_i} u.x and min_{R_j} u.x > max_{R_k} u.x for all other k, if there is one: then all centres
 * far enough out in the direction u are witnesses of ij [HUL-3]. Exact. */
dyd_status dyd_hull_direction(bool *found, mpz_t ux, mpz_t uy, dyd_work *w, const dyd_skeleton *sk, uint32_t i,
                              uint32_t j);

/* Sets *possible to whether some direction u has max_{R_v} u.x >= min_{R_k} u.x for all k [HUL-1]. Exact. */
dyd_status dyd_hull_possible(bool *possible, dyd_work *w, const dyd_skeleton *sk, uint32_t v);

#endif
