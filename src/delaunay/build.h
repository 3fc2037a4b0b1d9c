/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Building everything from the sites, at first or again. */
#ifndef DYD_DELAUNAY_BUILD_H
#define DYD_DELAUNAY_BUILD_H

#include "delaunay/state.h"
#include "skeleton/work.h"

/* Legal pairs known from before, as sites; they are in every skeleton and stay legal. */
typedef struct dyd_known {
  const dyd_pair *pair;
  size_t count;
} dyd_known;

/* Fills an object that has only options and counters. err may be NULL. On failure it is cleared back to that. */
dyd_status dyd_build(dyd_delaunay *pd, const dyd_sites *sites, dyd_known known, dyd_error *err);
void dyd_build_clear(dyd_delaunay *pd);

#endif
