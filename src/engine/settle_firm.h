/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Firm rectangles [SET-2]. */
#ifndef DYD_ENGINE_SETTLE_FIRM_H
#define DYD_ENGINE_SETTLE_FIRM_H

#include "engine/state.h"

/* *eps: a power of 2 that no diameter of a point exceeds that can be narrowed. */
dyd_status dyd_firm_eps(dyd_dyadic *eps, const dyd_engine *e);
bool dyd_site_is_fixed(const dyd_engine *e, uint32_t site);
/* *out, unless it is NULL, becomes r, smaller by eps on each side, if r is wide enough: *can. out = r is allowed. */
dyd_status dyd_firm_shrink(dyd_rect *out, bool *can, const dyd_rect *r, const dyd_dyadic *eps);
/* Are both ends firm? */
dyd_status dyd_pair_is_firm(bool *out, const dyd_engine *e, const dyd_dyadic *eps, const dyd_pair *pair);
/* Adds site number k of the engine: smaller if it is firm, a point if it can be narrowed, else as it is. */
dyd_status dyd_firm_add(dyd_sites *sites, const dyd_engine *e, const dyd_dyadic *eps, uint32_t k);

#endif
