/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is proved about the true points of an engine. */
#ifndef DYD_ENGINE_TIES_H
#define DYD_ENGINE_TIES_H

#include "engine/state.h"

/* As dyd_prove_fn, for the points of the engine `user`; what was asked before is remembered. */
dyd_status dyd_ties_prove(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                          dyd_error *err);
void dyd_ties_free(dyd_ties *t);

#endif
