/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A run: the question whether its goal holds. */
#include "base/abi.h"
#include "base/error.h"
#include "engine/ask.h"
#include "engine/goal_voronoi.h"
#include "engine/schedule.h"

#define MOST_GOAL_BITS ((int64_t)1 << 40)

/* Invariant: while scouts.count > 0 the races began in the stage after number `stage`, and `held` is the plan that
 * waits for them. */
typedef struct goal_question {
  dyd_scouts scouts;
  dyd_thrift thrift;
  dyd_settled settled;
  dyd_plan held;
  uint64_t stage;
} goal_question;

/* Scouts go ahead within a stage, and the plan follows when their races are over. A stage that was cut short ends the
 * races as well: there is a new result to be judged. */
static dyd_status goal_ask(bool *answered, dyd_plan *plan, void *user, const dyd_engine *e, dyd_error *err) {
  goal_question *q = user;
  (void)err;
  if (q->scouts.count == 0 || q->stage != e->stages) {
    dyd_scouts_clear(&q->scouts);
    dyd_plan_empty(&q->held);
    dyd_status st = dyd_schedule_judge(answered, plan, &q->scouts, &q->thrift, &q->settled);
    if (st != DYD_OK || q->scouts.count == 0) return st;
    q->stage = e->stages;
    dyd_plan all = *plan; /* waits */
    *plan = q->held;
    q->held = all;
  }
  dyd_status st = dyd_scouts_next(plan, &q->scouts, &q->held);
  plan->again = plan->count > 0;
  if (st != DYD_OK || plan->again) return st;
  dyd_scouts_finish(plan, &q->scouts, &q->held);
  dyd_scouts_clear(&q->scouts);
  dyd_plan_empty(&q->held);
  return DYD_OK;
}

static bool goal_options_are_good(const dyd_engine_options *o) {
  if (o->goal_bits > MOST_GOAL_BITS || o->goal_bits < -MOST_GOAL_BITS) return false;
  if (o->goal < DYD_GOAL_DECIDED || o->goal > DYD_GOAL_VORONOI_HAUSDORFF) return false;
  if (dyd_goal_is_voronoi(o->goal) && !dyd_goal_window_is_good(o->window)) return false;
  return o->schedule == DYD_SCHEDULE_ADAPTIVE || o->schedule == DYD_SCHEDULE_UNIFORM;
}

static dyd_status goal_run(dyd_outcome *outcome, dyd_engine *e, const dyd_engine_options *o, dyd_error *err) {
  goal_question g = {.scouts = {0}};
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = goal_ask, .user = &g, .triangulate = true};
  e->goal = o->goal;
  e->goal_bits = o->goal_bits;
  /* Where a stage may be the last one, or bounds are asked for, all pairs are needed at once. */
  e->postpones = o->goal == DYD_GOAL_DECIDED && o->schedule == DYD_SCHEDULE_ADAPTIVE && !o->step_bits &&
                 !o->max_stages && !o->max_calls;
  dyd_plan_init(&g.held, e, o, NULL, 0);
  dyd_status st = dyd_thrift_init(&g.thrift, e, o);
  st = st == DYD_OK ? dyd_ask(outcome, &e->spent, e, &question, o, err) : dyd_fail_nomem(err);
  e->postpones = false;
  dyd_thrift_clear(&g.thrift);
  dyd_plan_clear(&g.held);
  dyd_scouts_clear(&g.scouts);
  dyd_settled_clear(&g.settled);
  if (*outcome == DYD_OUTCOME_DECIDED && o->goal != DYD_GOAL_DECIDED) *outcome = DYD_OUTCOME_CERTIFIED;
  return st;
}

dyd_status dyd_engine_run(dyd_outcome *outcome, dyd_engine *e, const dyd_engine_options *options, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  dyd_engine_options o;
  *outcome = DYD_OUTCOME_ERROR;
  if (err) dyd_error_clear(err);
  dyd_status st = dyd_ask_may_begin(e, err);
  if (st != DYD_OK) return st;
  e->spent = DYD_BUDGET_NONE;
  st = dyd_abi_take(&o, sizeof o, options, "dyd_engine_options", err);
  if (st == DYD_OK && !dyd_thrift_costs_are_good(e, &o))
    st = dyd_fail(err, DYD_E_ARG, "the cost of a point is not above 0");
  else if (st == DYD_OK && dyd_ask_options(&o) && goal_options_are_good(&o))
    st = goal_run(outcome, e, &o, err);
  else if (st == DYD_OK)
    st = dyd_fail(err, DYD_E_ARG, "an option of the run is out of its range");
  e->outcome = *outcome;
  return st;
}
