/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What points answered in an earlier run, given again in place of asking them. */
#ifndef DYD_ENGINE_RECALL_H
#define DYD_ENGINE_RECALL_H

#include "engine/state.h"

/* What the site will answer next without being asked, or NULL: the first answer left that is for at least `bits`. */
const dyd_recalled *dyd_recall_next(dyd_recall *m, uint32_t site, int64_t bits);
/* That answer has been given: it and those before it are used up. */
void dyd_recall_use(dyd_recall *m, const dyd_recalled *a);
/* Calls fn for each answer given, those of a site in the order given, until it returns other than DYD_OK. */
typedef dyd_status (*dyd_recalled_fn)(void *user, uint32_t site, int64_t bits, const dyd_rect *r, bool final);
dyd_status dyd_recall_each(const dyd_recall *m, dyd_recalled_fn fn, void *user);
/* The rectangle it was narrowed to; *final: no call can narrow it further. */
void dyd_recalled_get(dyd_rect *r, bool *final, const dyd_recalled *a);
void dyd_recall_free(dyd_recall *m);

#endif
