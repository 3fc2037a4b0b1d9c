/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Decides exactly if a pair is possible, by covering the curve of its centres (mathematics: section 5). */
#ifndef DYD_POSSIBLE_COVER_H
#define DYD_POSSIBLE_COVER_H

#include "skeleton/work.h"

/* What a walk found. A possible pair of rectangles that are apart is seen in `place`, or, far, at infinity in the
 * direction u, scaled to at most 1; when not walked, doubles decided, and place is one point. */
typedef struct dyd_cover {
  bool possible, walked, far;
  dyd_bbox place;
  double u[2];
} dyd_cover;

/* Decides whether the pair of vertices i, j is possible [POS-1]. Exact; in doubles where they decide. hint: two
 * vertices that are likely to block it (DYD_NONE: no idea); they only save steps. */
dyd_status dyd_cover_possible(dyd_cover *out, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j,
                              const uint32_t hint[2]);

/* The same in doubles. TRUE: *centre shows it; FALSE: others block all of its curve [COV-2]; UNKNOWN: not decided. */
dyd_truth dyd_filter_cover(dyd_xy *centre, const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t hint[2]);

#endif
