/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Inside the harness of monotone refinement.
 *
 *   check.c         schedules: random ones, given ones, and cutting a failing one down
 *   check_stage.c   what is compared after each stage */
#ifndef DYD_ENGINE_CHECK_H
#define DYD_ENGINE_CHECK_H

#include "engine/points.h"
#include "engine/watch.h"
#include <dyadel/check.h>
#include <dyadel/metric.h>
#include <dyadel/voronoi.h>

/* A site whose polygons of the last stage are kept. */
typedef struct dyd_watched {
  uint32_t site;
  dyd_polygon inner;
  dyd_polygon_list outer;
} dyd_watched;

/* One schedule under way. */
typedef struct dyd_check_state {
  dyd_engine *e;
  dyd_delaunay *pd;     /* NULL before the first stage */
  dyd_pair_list before; /* pairs after the last stage */
  dyd_watched *watched;
  size_t watch_count;
  dyd_rect window;
  bool windowed;
  uint64_t random;
  dyd_watch watch;            /* raises e->stop at the deadline */
  const dyd_check_options *o; /* defaults filled in */
  dyd_check_report *report;   /* counters; fault and message when one is found */
  uint32_t *changed;
  size_t changes, change_cap;
} dyd_check_state;

/* Is the time over, or was it cancelled? */
bool dyd_check_is_over(const dyd_check_state *s);
/* Uniform in 0 .. n-1, n > 0. */
uint64_t dyd_check_below(uint64_t *random, uint64_t n);
/* Notes a fault; returns DYD_OK. */
dyd_status dyd_check_found(dyd_check_state *s, dyd_check_fault fault, const char *format, ...);

/* Narrows point i to b bits and checks the stream. */
dyd_status dyd_check_narrow(dyd_check_state *s, uint32_t point, int64_t bits);
/* Triangulates and checks everything; the last stage also against a fresh run and random choices. */
dyd_status dyd_check_stage(dyd_check_state *s, bool last);
void dyd_check_state_clear(dyd_check_state *s);

#endif
