/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which points to narrow next, and how far, where a goal does not hold. */
#ifndef DYD_ENGINE_SCHEDULE_H
#define DYD_ENGINE_SCHEDULE_H

#include "engine/plan.h"
#include "engine/scout.h"
#include "engine/settle.h"
#include "engine/thrift.h"

/* Does the goal hold for the result, which is up to date? Otherwise *plan, empty, becomes what to narrow towards it;
 * adds to *scouts, just initialised, what may go ahead, and to *thrift and *settled, kept from judgement to judgement
 * of a run, who waits, and which pairs no refinement decides. DYD_CANCELLED when e->stop was seen. */
dyd_status dyd_schedule_judge(bool *holds, dyd_plan *plan, dyd_scouts *scouts, dyd_thrift *thrift,
                              dyd_settled *settled);

#endif
