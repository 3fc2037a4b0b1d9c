/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Adding points; for the readers, too. */
#ifndef DYD_ENGINE_ADD_H
#define DYD_ENGINE_ADD_H

#include "rect/sites_table.h"
#include <dyadel/engine.h>

/* Checks that points may be added now, not from a callback. Clears *err, which may be NULL; DYD_E_ARG. */
dyd_status dyd_engine_may_add(const dyd_engine *e, dyd_error *err);
/* Room for n more sites, so that adding them in parts copies nothing. */
dyd_status dyd_engine_reserve(dyd_engine *e, size_t n);
/* Takes back the points from number `before` on, which were added since the last run or question. */
void dyd_engine_take_back(dyd_engine *e, size_t before);
/* Adds n exact points that are rationals of single words, as dyd_sites_add_words, or boxes, as
 * dyd_sites_add_word_boxes, whenever a point may come; nothing on failure. */
dyd_status dyd_engine_add_words(dyd_engine *e, size_t n, const dyd_words *xy, bool boxes, dyd_error *err);

#endif
