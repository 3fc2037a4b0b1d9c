/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Asking cheap points before dear ones. */
#ifndef DYD_ENGINE_THRIFT_H
#define DYD_ENGINE_THRIFT_H

#include "engine/plan.h"

/* Kept from judgement to judgement of a run. Init with dyd_thrift_init. waited: of each point of the engine, what was
 * spent on others of its faces while it was left out; NULL: all points cost the same, and nobody waits. */
typedef struct dyd_thrift {
  double *waited;
  dyd_plan face; /* what one face wants */
} dyd_thrift;

/* Borrows e and o, which has costs that are above 0, or none. DYD_E_NOMEM. */
dyd_status dyd_thrift_init(dyd_thrift *t, const dyd_engine *e, const dyd_engine_options *o);
void dyd_thrift_clear(dyd_thrift *t);
/* Where the wants of the next face go: `plan` itself where nobody waits. */
dyd_plan *dyd_thrift_face(dyd_thrift *t, dyd_plan *plan);
/* The wants of the face with these sites go to the plan, but for those that wait. */
void dyd_thrift_choose(dyd_plan *plan, dyd_thrift *t, const dyd_index_list *sites);
/* Is every cost a number above 0? */
bool dyd_thrift_costs_are_good(const dyd_engine *e, const dyd_engine_options *o);

#endif
