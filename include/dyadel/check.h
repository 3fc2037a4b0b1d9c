/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The harness of monotone refinement: runs random refinement schedules over points and looks for broken promises, of
 * the points' streams and of the engine alike.
 *
 * A schedule is a list of moves: at stage s, b bits are requested of point i. Before stage 1, base_bits are requested
 * of every point that can be narrowed. After each stage the triangulation is updated and these conditions are checked:
 *   nested   every rectangle is inside the one before (a stream's fault);
 *   rate     a point asked for b bits is narrower than 2^-(b - slack_bits), or final (a stream's fault); of points made
 *            of reals, what a fixed coordinate or a radius leaves is not counted;
 *   retract  no pair that was illegal is possible, no legal one is anything else;
 *   cell     proved polygons inside Int and round Pos of some sites, made a stage before, still are that;
 *   path     a triangulation made afresh from the same rectangles has the same statuses (legal against indeterminate
 *            aside where the witness search stops at its floor, see legal/witness.h: these are counted);
 *   choice   a random exact choice of points has every legal pair as a strict edge, and no impossible pair as one. */
#ifndef DYADEL_CHECK_H
#define DYADEL_CHECK_H

#include <dyadel/engine.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Makes a new engine with the points, never run; called once for each schedule. On failure *err is filled. */
typedef dyd_status (*dyd_check_open_fn)(dyd_engine **out, void *user, dyd_error *err);

typedef struct dyd_check_move {
  uint32_t stage; /* from 1, ascending in a schedule */
  uint32_t point;
  int64_t bits;
} dyd_check_move;

typedef struct dyd_check_options {
  size_t struct_size; /* set by DYD_SIZED */
  uint64_t seed;
  unsigned schedules;         /* 0: 100 */
  int64_t base_bits;          /* 0: 8 */
  int64_t max_bits;           /* finest request; 0: 192 */
  int64_t slack_bits;         /* 0: 16 */
  unsigned stages;            /* of each schedule; 0: 6 */
  unsigned cells;             /* watched from stage to stage; 0: 6 */
  bool no_cells;              /* watch none */
  const volatile int *cancel; /* may be NULL */
  /* Called before each schedule; may be NULL. */
  void (*progress)(void *user, unsigned schedule, unsigned of);
  void *progress_user;
  double seconds;   /* of all schedules together; 0: no limit */
  int64_t tie_bits; /* as in dyd_engine_options */
  bool no_ties;
  const dyd_check_move *move; /* the one schedule to run, such as a report holds; NULL: `schedules` of them are made */
  size_t moves;
} dyd_check_options;

typedef enum dyd_check_fault {
  DYD_CHECK_FINE = 0,
  DYD_CHECK_STREAM, /* a stream failed or was not nested; message has its error */
  DYD_CHECK_RATE,
  DYD_CHECK_RETRACT,
  DYD_CHECK_CELL,
  DYD_CHECK_PATH,
  DYD_CHECK_CHOICE
} dyd_check_fault;
/* "fine", "stream", ... Static storage. */
DYD_API const char *dyd_check_fault_text(dyd_check_fault fault);

/* The findings. Init with DYD_SIZED, release with dyd_check_report_clear. */
typedef struct dyd_check_report {
  size_t struct_size;    /* set by DYD_SIZED */
  dyd_check_fault fault; /* of the first schedule that shows one */
  char message[DYD_MESSAGE_SIZE];
  uint64_t seed;     /* of that schedule */
  int64_t base_bits; /* for repeating it */
  size_t moves;      /* a schedule that shows the fault; every move in it is needed */
  dyd_check_move *move;
  uint64_t schedules, stages, pairs, cells, floors; /* how much was done; floors: see `path` */
} dyd_check_report;
DYD_API void dyd_check_report_clear(dyd_check_report *r);

/* Runs the schedules: the first one brings each point from base_bits to max_bits in small steps, the others are random.
 * Returns DYD_OK, also when a fault was found (see the report); DYD_CANCELLED, also at the time limit, with the counts
 * until then and the shortest schedule found so far; errors of `open`; DYD_E_NOMEM; DYD_E_ARG, with err->line the
 * number of the move from 1, where one of the options names a point that does not exist or a stage before the last one;
 * stages begin with 1. */
DYD_API dyd_status dyd_check_run(dyd_check_report *out, dyd_check_open_fn open, void *user, const dyd_check_options *o,
                                 dyd_error *err);
#ifdef __cplusplus
}
#endif
#endif
