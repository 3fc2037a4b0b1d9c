/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What writing and reading traces share: the words of the format, documented in io.h. */
#ifndef DYD_IO_TRACE_H
#define DYD_IO_TRACE_H

#include <dyadel/engine.h>

#define DYD_TRACE_FORMAT "dyadel trace 1"

/* The names of goals and schedules, by value. */
enum { DYD_TRACE_GOALS = DYD_GOAL_HAUSDORFF + 1, DYD_TRACE_SCHEDULES = DYD_SCHEDULE_UNIFORM + 1 };
extern const char *const dyd_trace_goal[DYD_TRACE_GOALS];
extern const char *const dyd_trace_schedule[DYD_TRACE_SCHEDULES];

#endif
