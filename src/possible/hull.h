/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which vertices are possibly on the convex hull (mathematics: sections 3, 6). */
#ifndef DYD_POSSIBLE_HULL_H
#define DYD_POSSIBLE_HULL_H

#include "skeleton/work.h"

/* Does some direction u have max_{R_v} u.x >= min_{R_k} u.x for all k [HUL-1]? Exact. */
dyd_status dyd_hull_possible(bool *possible, dyd_work *w, const dyd_skeleton *sk, uint32_t v);

#endif
