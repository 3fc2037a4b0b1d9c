/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Many undecided faces side by side: they are independent of each other [LOC-1]. */
#ifndef DYD_DELAUNAY_CLOSURES_H
#define DYD_DELAUNAY_CLOSURES_H

#include "delaunay/closure.h"

/* The closure of one face of the table. */
dyd_status dyd_closures_run_one(dyd_closure *out, const dyd_delaunay *pd, dyd_work *w, const dyd_face *face,
                                size_t room);
/* out[k] becomes the closure of face first + k of the table (nothing, where that is proved), in w->threads threads;
 * each may keep `room` pairs. The same for every number of threads. On failure nothing is left to clear; the failure is
 * that of the first face that has one, DYD_CANCELLED when the work was stopped. */
dyd_status dyd_closures_run(dyd_closure *out, const dyd_delaunay *pd, dyd_work *w, size_t first, size_t count,
                            size_t room);

#endif
