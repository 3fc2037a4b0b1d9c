/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Firm rectangles [SET-2]. */
#ifndef DYD_ENGINE_SETTLE_FIRM_H
#define DYD_ENGINE_SETTLE_FIRM_H

#include "engine/state.h"

/* *eps: a power of 2 that is at least the distance of any two points of a rectangle that differ only along sides that
 * can be narrowed. */
dyd_status dyd_firm_eps(dyd_dyadic *eps, const dyd_engine *e);
bool dyd_site_is_fixed(const dyd_engine *e, uint32_t site);
/* Which sides of the site, x and y, can its point never narrow? r: its rectangle. A side that is measured beside one
 * that is computed is one. */
void dyd_site_fixed_sides(bool fixed[2], const dyd_engine *e, uint32_t site, const dyd_rect *r);
/* *out, unless it is NULL, becomes r, smaller by eps on each side, if r is wide enough: *can. out = r is allowed. */
dyd_status dyd_firm_shrink(dyd_rect *out, bool *can, const dyd_rect *r, const dyd_dyadic *eps);
/* Are both ends firm? */
dyd_status dyd_pair_is_firm(bool *out, const dyd_engine *e, const dyd_dyadic *eps, const dyd_pair *pair);
/* Adds site number k of the engine: smaller if it is firm, else with a point for each side that can be narrowed. */
dyd_status dyd_firm_add(dyd_sites *sites, const dyd_engine *e, const dyd_dyadic *eps, uint32_t k);

#endif
