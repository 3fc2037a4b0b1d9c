/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The distance of undetermined points to the Voronoi diagram. */
#ifndef DYD_CHECKER_DISTANCE_H
#define DYD_CHECKER_DISTANCE_H

#include "checker/sites.h"

/* The window: x lower, x upper, y lower, y upper. Invariant: positive area. */
typedef struct dyd_cert_window {
  dyd_exact e[4];
} dyd_cert_window;

void dyd_cert_window_init(dyd_cert_window *w);
void dyd_cert_window_clear(dyd_cert_window *w);

/* Is, for every choice of points, each point of the window that is surely nearest to no site at most `bound` from the
 * diagram [CERT-7]? DYD_OK with *holds: true is proved, false is not known. Or DYD_E_NOMEM. The search is given up
 * after work in proportion to the number of sites. Memory: linear. */
dyd_status dyd_cert_distance_holds(bool *holds, const dyd_cert_sites *s, const dyd_cert_window *w,
                                   const dyd_exact *bound);

#endif
