/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sites that come later. */
#ifndef DYD_DELAUNAY_EXTEND_H
#define DYD_DELAUNAY_EXTEND_H

#include "delaunay/state.h"

/* Can points be put into it? */
bool dyd_delaunay_is_extensible(const dyd_delaunay *pd);
/* Brings *pd up to date after sites were added to its table: what dyd_delaunay_new would state of all [LOC-5]. *fits =
 * false: they cannot be put in one by one (too many; into exact points only points of doubles can), or it failed; then
 * *pd can only be freed. options and errors as for dyd_delaunay_update. O(sqrt(N)) for each new site that is far from
 * the one before, plus the faces that change, plus N / 32. */
dyd_status dyd_delaunay_extend(bool *fits, dyd_delaunay *pd, const dyd_delaunay_options *options, dyd_error *err);
/* The same with options set. */
dyd_status dyd_extend(bool *fits, dyd_delaunay *pd, dyd_error *err);

#endif
