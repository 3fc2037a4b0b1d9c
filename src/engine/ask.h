/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The one loop. */
#ifndef DYD_ENGINE_ASK_H
#define DYD_ENGINE_ASK_H

#include "engine/plan.h"

/* Fills in defaults. false: an option that every question heeds is out of its range. */
bool dyd_ask_options(dyd_engine_options *o);
/* DYD_E_ARG, with a message, when the loop is at work and the call comes from one of its callbacks. */
dyd_status dyd_ask_may_begin(const dyd_engine *e, dyd_error *err);
/* dyd_engine_ask; *spent tells which budget was met. *err, which may be NULL, is clear unless the call failed or the
 * budget of pairs was met. */
dyd_status dyd_ask(dyd_outcome *outcome, dyd_budget *spent, dyd_engine *e, const dyd_question *question,
                   const dyd_engine_options *options, dyd_error *err);

#endif
