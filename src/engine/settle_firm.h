/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cores of sites [SET-3] and firm ones [SET-2]. */
#ifndef DYD_ENGINE_SETTLE_FIRM_H
#define DYD_ENGINE_SETTLE_FIRM_H

#include "engine/state.h"

/* Sets *r to the rectangle of `site` with its core in place of each side that has one, an interval that no refinement
 * leaves: core[0] for x, core[1] for y. A side that is fixed is its own core; one with a radius has a core once the
 * centre is known to within the radius. */
dyd_status dyd_site_get_core(dyd_rect *r, bool core[2], const dyd_engine *e, uint32_t site);
/* Sets *eps to 0 or a power of 2 that is at least the distance of any two points of a rectangle that differ only along
 * sides without a core. */
dyd_status dyd_firm_eps(dyd_dyadic *eps, const dyd_engine *e);
/* Raises *eps to what that is for one site. */
dyd_status dyd_firm_raise(dyd_dyadic *eps, const dyd_engine *e, uint32_t site);
/* Sets *out, unless it is NULL, to r less eps on each side, if r is wide enough: *can. out = r is allowed. */
dyd_status dyd_firm_shrink(dyd_rect *out, bool *can, const dyd_rect *r, const dyd_dyadic *eps);
/* Are the cores of both ends firm? */
dyd_status dyd_pair_is_firm(bool *out, const dyd_engine *e, const dyd_dyadic *eps, const dyd_pair *pair);
/* Sets *out to the core of a guest, with a point for each side that has none, and raises *eps as dyd_firm_eps does. */
dyd_status dyd_firm_place(dyd_rect *out, dyd_dyadic *eps, const dyd_stream *at);
/* Adds the core of site number k of the engine: less eps if it is firm, else with a point for each side that has no
 * core. */
dyd_status dyd_firm_add(dyd_sites *sites, bool *firm, const dyd_engine *e, const dyd_dyadic *eps, uint32_t k);

#endif
