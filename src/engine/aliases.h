/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points that are proved to be the same place. */
#ifndef DYD_ENGINE_ALIASES_H
#define DYD_ENGINE_ALIASES_H

#include "engine/state.h"

/* Joins the sites of pd, a triangulation of e's sites, that are proved to be the same [TIE-4]; *any: some are, and pd
 * is to be brought up to date. Looks at sites that share an undecided face and whose rectangles meet: others are
 * different, or so wide that they are asked for more. */
dyd_status dyd_aliases_find(bool *any, dyd_engine *e, const dyd_delaunay *pd, dyd_error *err);

#endif
