/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The boundary of Int_i or Pos_i: doubles first, exact numbers where these leave a doubt [OUTLINE-1].
 *
 * Each number is enclosed by an interval, and each decision is taken from intervals that leave no doubt, or else from
 * the exact numbers (outline.h), which are made only then. */
#ifndef DYD_VORONOI_OUTLINE_FILTER_H
#define DYD_VORONOI_OUTLINE_FILTER_H

#include "voronoi/outline_sites_filter.h"

/* Finds the pieces, joined, of Int or (outer) Pos, in a window or (NULL) in the plane. Pos first: its outline limits
 * that of Int. DYD_OK, DYD_E_NOMEM, DYD_CANCELLED. */
dyd_status dyd_outline_find(dyd_outline *o, const dyd_rect *window, bool outer);
/* Returns true if piece p and the next one are parts of one arc, or of one side. */
bool dyd_outline_smooth(const dyd_outline *o, size_t p);
/* Where the chain through piece p starts: at infinity, or after a break. */
size_t dyd_outline_start(const dyd_outline *o, size_t p);

#endif
