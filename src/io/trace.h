/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What writing and reading traces share: the words of the format, documented in io.h. */
#ifndef DYD_IO_TRACE_H
#define DYD_IO_TRACE_H

#include <dyadel/engine.h>

#define DYD_TRACE_FORMAT "dyadel trace 2"

/* The last goal and schedule of a trace; their words are dyd_goal_text and dyd_schedule_text. */
enum { DYD_TRACE_GOAL = DYD_GOAL_VORONOI_HAUSDORFF, DYD_TRACE_SCHEDULE = DYD_SCHEDULE_UNIFORM };
/* "coincident", ... by dyd_relation. */
extern const char *const dyd_trace_relations[3];

#endif
