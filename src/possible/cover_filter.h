/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Decides in doubles if a pair is possible: the quick rung of the cover walk. */
#ifndef DYD_POSSIBLE_COVER_FILTER_H
#define DYD_POSSIBLE_COVER_FILTER_H

#include "skeleton/work.h"

/* Decides if the pair of vertices i, j is possible [POS-1]. TRUE: *centre shows it; FALSE: others block all of its
 * curve [COV-2]; UNKNOWN: doubles do not decide. hint: two vertices that are likely to block it (DYD_NONE: no idea). */
dyd_truth dyd_filter_cover(dyd_xy *centre, const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t hint[2]);

#endif
