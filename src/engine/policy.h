/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plans changed from outside: by a callback, or by a program. */
#ifndef DYD_ENGINE_POLICY_H
#define DYD_ENGINE_POLICY_H

#include "engine/plan.h"

/* Returns true if a policy chooses the points to narrow. */
static inline bool dyd_has_policy(const dyd_engine_options *o) {
  return o->policy || o->policy_program;
}

/* A program that is asked. */
typedef struct dyd_policy dyd_policy;

#endif
