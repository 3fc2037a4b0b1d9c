/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One timed run of the library over a cloud. */
#ifndef DYD_BENCH_OURS_H
#define DYD_BENCH_OURS_H

#include "cloud.h"
#include "edges.h"
#include "harness.h"

#include <dyadel/delaunay.h>

typedef struct ours_answer {
  size_t count[4];    /* pairs by status */
  double input_bytes; /* held by the table of sites */
  bench_edges edges;  /* all possible pairs, when asked for; owned by the holder */
} ours_answer;

typedef enum ours_what {
  OURS_STATUSES, /* statuses computed and counted */
  OURS_ARRAYS,   /* ... and triangles with their neighbours as arrays, alone inside the timed part */
  OURS_LISTED,   /* ... and all possible pairs listed, inside the timed part */
  OURS_AND_EDGES /* like OURS_STATUSES; the pairs are listed after the clock has stopped */
} ours_what;

/* Ends the program with a message, err's if it has one, unless the call succeeded. */
void bench_need(const char *row, dyd_status status, const dyd_error *err);
/* Table of sites (points, or boxes when the cloud has them), partial triangulation, counts. Ends the program with a
 * message when the library fails. */
bench_cost ours_run(ours_answer *out, const char *row, const cloud *c, ours_what what, unsigned threads);
/* A run over points that must meet the default cap on pairs; the message goes to remark. */
bench_cost ours_capped(char *remark, size_t size, const cloud *c);
/* The possible pairs of pd as sorted edges. */
void ours_edges(bench_edges *out, const char *row, const dyd_delaunay *pd);

#endif
