/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plans changed from outside: by a callback, or by a program. */
#ifndef DYD_ENGINE_POLICY_H
#define DYD_ENGINE_POLICY_H

#include "engine/plan.h"

/* Returns true if a policy chooses what is narrowed. */
static inline bool dyd_has_policy(const dyd_engine_options *o) {
  return o->policy || o->policy_program;
}
/* Puts *plan, not empty, to the policy of plan->o; stage: the one that it is for. What the policy adds replaces the
 * plan. If it adds nothing, the plan stays. first: points that it does not name stay in the plan. DYD_CANCELLED when
 * e->stop was seen. */
dyd_status dyd_policy_apply(dyd_plan *plan, bool first, dyd_error *err);

/* A program that is asked. */
typedef struct dyd_policy dyd_policy;
/* Starts o->policy_program, if there is one, and makes it o's policy; *out: NULL if there is none. */
dyd_status dyd_policy_start(dyd_policy **out, dyd_engine_options *o, dyd_error *err);
/* Ends the program. NULL is allowed. */
void dyd_policy_free(dyd_policy *p);

#endif
