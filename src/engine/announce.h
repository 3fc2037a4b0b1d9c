/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Telling sources what they will be asked. */
#ifndef DYD_ENGINE_ANNOUNCE_H
#define DYD_ENGINE_ANNOUNCE_H

#include "engine/plan.h"

/* Tells the sources that want to know which of their points a plan, sorted, has, in the order in which narrowing will
 * come to them; `most` points of such sources at most. */
void dyd_plan_announce(const dyd_plan *plan, uint64_t most);

#endif
