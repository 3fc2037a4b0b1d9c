/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The points of an engine: finding one, asking one to narrow. */
#ifndef DYD_ENGINE_POINTS_H
#define DYD_ENGINE_POINTS_H

#include "engine/state.h"
#include "rect/sites_table.h"

#include <dyadel/engine.h>

/* The refinable point of a site, NULL when the site is fixed. O(log points). */
const dyd_refinable *dyd_engine_find(const dyd_engine *e, uint32_t site);
/* From now on a cancel of e cancels `follower`, too, also one that came before; NULL ends that. */
void dyd_engine_follow(dyd_engine *e, dyd_engine *follower);
/* Brings one point, or a guest, to precision bits (2^-bits) and its site in the table with it; *calls counts calls made
 * (0 when the point was that narrow before). On failure the site and p->bits are as before, and err names site and
 * stage; so they are for DYD_CANCELLED, which a source returns when it saw e->stop raised. */
dyd_status dyd_engine_narrow(dyd_refinable *p, uint64_t *calls, dyd_engine *e, int64_t bits, int64_t max_bits,
                             dyd_error *err);

/* The request for a point of a source, with the flag that says that the answer is not wanted any more. */
dyd_status dyd_engine_request(dyd_request *out, const dyd_refinable *p, const dyd_engine *e, int64_t bits,
                              int64_t max_bits, dyd_error *err);
/* The source added last gives first answers by fn, with its own user. */
void dyd_engine_set_glance(dyd_engine *e, dyd_glance_fn fn);
/* Called after a site was narrowed: it is listed in `changed`, which has room. */
void dyd_engine_note_change(dyd_engine *e, uint32_t site);
/* Releases streams and sources. */
void dyd_engine_clear_points(dyd_engine *e);
void dyd_shared_source_free(dyd_shared_source *s);

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
