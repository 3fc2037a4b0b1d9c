/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Is a pair possible? Decided exactly, by covering the curve of its centres (mathematics: section 5). */
#ifndef DYD_POSSIBLE_COVER_H
#define DYD_POSSIBLE_COVER_H

#include "skeleton/work.h"

/* *possible: is the pair of vertices i, j possible [POS-1]? Exact; in doubles where they tell. hint: two vertices that
 * are likely to block it (DYD_NONE: no idea); they only save steps. */
dyd_status dyd_cover_possible(bool *possible, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j,
                              const uint32_t hint[2]);

#endif
