/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Undecided faces that are ties because their true points are proved to be on one circle or line. */
#ifndef DYD_DELAUNAY_PROVED_H
#define DYD_DELAUNAY_PROVED_H

#include "delaunay/state.h"
#include "skeleton/work.h"

/* Looks at listed face g, which has not been closed, and asks who proves such things. Where it is a tie, its pairs are
 * stored, and it is marked as proved. Without somebody to ask nothing is done. DYD_OK or a failure, also of who was
 * asked. */
dyd_status dyd_prove_face(dyd_delaunay *pd, dyd_work *w, size_t g);
/* A half-edge of the rim of listed face `face`, that of the ghost for a chain; DYD_NONE unless the rim is one cycle. */
dyd_half_edge dyd_rim_start(bool *chain, const dyd_delaunay *pd, const dyd_face *face);
/* The same for the sites of a line: pd->line_tie. */
dyd_status dyd_prove_line(dyd_delaunay *pd, dyd_work *w);

#endif
