/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Bringing the statuses up to date after sites were narrowed. */
#ifndef DYD_DELAUNAY_UPDATE_H
#define DYD_DELAUNAY_UPDATE_H

#include "delaunay/state.h"

/* As dyd_delaunay_update. */
dyd_status dyd_update(dyd_delaunay *pd, const uint32_t *changed, size_t count, dyd_error *err);

#endif
