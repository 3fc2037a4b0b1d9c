/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Estimates of memory. */
#ifndef DYD_ENGINE_BYTES_H
#define DYD_ENGINE_BYTES_H

#include "engine/plan.h"

/* What the points take: their rectangles, records and streams. O(points). */
uint64_t dyd_engine_point_bytes(const dyd_engine *e);
/* What is made of the result later has what the points leave of so many bytes; 0: no bound. */
void dyd_engine_allow(dyd_engine *e, uint64_t most);
/* What carrying out a plan will take beside that: longer ends, and the digits computed with. O(plan). */
uint64_t dyd_plan_bytes(const dyd_plan *p);
/* What judging the result takes: bounds list all pairs, and those of the diagram have two numbers a cell. O(points). */
uint64_t dyd_goal_bytes(const dyd_engine *e, const dyd_engine_options *o);

#endif
