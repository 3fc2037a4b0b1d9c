/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Experiments on convergence: a run of the engine stage by stage, as a table (mathematics: sections 7, 8). */
#ifndef DYADEL_CONVERGE_H
#define DYADEL_CONVERGE_H

#include <dyadel/engine.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The state after one stage. All but `seconds` is the same in every run and for every number of threads.
 * Invariant: area, hausdorff count when bounded, v_area, v_hausdorff when voronoi; they are 0 otherwise. */
typedef struct dyd_stage_row {
  size_t struct_size; /* set by the library */
  uint64_t stage;
  int64_t bits_least, bits_most; /* asked of any refinable point so far; 0 when there is none */
  uint64_t bits_total;           /* sum over the points of the bits last asked */
  dyd_dyadic width_largest;      /* of all sides of all rectangles; rounded up by at most 2^-63 of itself */
  dyd_dyadic width_median;       /* of the longer sides: number N/2 of N in ascending order; rounded alike */
  size_t count[4];               /* pairs by status; the possible ones are all of them */
  size_t undecided_faces;
  bool bounded, voronoi;          /* the bounds of T (of the disc or bisector), of V are known */
  dyd_dyadic area, hausdorff;     /* upper bounds for T, or for the disc or bisector (metric.h) */
  dyd_dyadic v_area, v_hausdorff; /* upper bounds for V on the window (metric.h) */
  dyd_sure orientation;           /* of the disc; of the bisector: PLUS, the rectangles are disjoint */
  dyd_sure *con;                  /* of the disc: Con of point 3 + k, k < cons; owned */
  size_t cons;
  dyd_delaunay_counters rungs; /* decisions since the start, by rung */
  uint64_t calls;              /* stream calls since the start */
  uint64_t digest;             /* of all pairs with their statuses (FNV-1a, 64 bits) */
  /* Known a priori from the rectangles of this stage (dyd_converge_options.rates): of any that are narrower, at most w
   * wide, the Hausdorff distance is at most 2^rate w, where that is at most 2^-rate_from [RATE-1]. */
  bool rated;
  int64_t rate, rate_from;
  double seconds; /* wall clock since the start of the run, the making of this table included */
} dyd_stage_row;

/* What a table is about. */
typedef enum dyd_converge_of {
  DYD_CONVERGE_DELAUNAY = 0, /* T: statuses, and its bounds */
  DYD_CONVERGE_VORONOI,      /* the same, and the bounds of V on the window, which cost more than the rest */
  DYD_CONVERGE_DISC,         /* the partial disc of points 0, 1, 2, and Con of the others */
  DYD_CONVERGE_BISECTOR      /* the partial bisector of points 0 and 1 on the window; other points are ignored */
} dyd_converge_of;
/* "delaunay", "voronoi", "disc", "bisector". Static storage. */
DYD_API const char *dyd_converge_of_text(dyd_converge_of of);

/* The rows of a run. Init with DYD_SIZED, release with dyd_convergence_clear. */
typedef struct dyd_convergence {
  size_t struct_size; /* set by DYD_SIZED */
  size_t count, cap;
  dyd_stage_row **row;
  dyd_outcome outcome;
  dyd_engine_options *options; /* as given to the run, pointers and callbacks aside; NULL before the run */
  dyd_rect *window;            /* of the bounds of V or of the bisector; NULL when there is none */
  dyd_converge_of of;
  bool sought;        /* dyd_converge_options.hindsight was given: */
  uint64_t best_bits; /* see there; 0: not known */
} dyd_convergence;
DYD_API void dyd_convergence_clear(dyd_convergence *c);

/* The results of every stage of a run: statuses of pairs and boxes of sites, stored as changes. Formats with a slider
 * over the stages (html) use it. Memory: 20 bytes for each pair of the first stage and each status that changed, 40 for
 * each box.
 *
 * Filled by dyd_history_note, called from dyd_engine_options.progress or dyd_converge_options.stage. */
typedef struct dyd_history dyd_history;
DYD_API dyd_status dyd_history_new(dyd_history **out);
DYD_API void dyd_history_free(dyd_history *h);
/* Adds a stage: the current state of pd, which is always the result for the same sites. DYD_E_ARG if the sites differ
 * from those before, DYD_E_NOMEM: *h is unchanged. O(N + pairs). */
DYD_API dyd_status dyd_history_note(dyd_history *h, const dyd_delaunay *pd);

typedef struct dyd_converge_options {
  size_t struct_size; /* set by DYD_SIZED */
  /* The window of the bounds of V (dyadic ends, positive area), borrowed; NULL: the default window of the sites after
   * the first stage (dyd_voronoi_window). */
  const dyd_rect *window;
  dyd_converge_of of;
  /* Called after each row is complete; may be NULL. */
  void (*stage)(void *user, const dyd_stage_row *row, const dyd_delaunay *pd);
  void *stage_user;
  /* Gives the pairs that rows count, instead of those of the result, such as those of the places of a sphere; rows have
   * no bounds then. An error ends the run. NULL: those of the result. */
  dyd_status (*pairs)(dyd_pair_list *out, void *user);
  void *pairs_user;
  /* when it points to a non-zero value, bounds not known by then are omitted from rows; NULL: never. At the
   * deadline and when the engine is cancelled, dyd_converge_run omits them without this flag */
  const volatile int *cancel;
  bool rates; /* of plane rectangles: rows have the a priori bounds, from the first one that has one */
  /* Not 0: after a run whose goal holds (decided, or a bound of the triangulation), the least sum of bits is sought by
   * which it could have held, had all answers been known: best_bits. At most this number of triangulations is tried,
   * each of all points; the search grows with the power of the number of points, so that few points are meant. Point by
   * point the bits are from those of the first stage to twice the most that the run asked for, and the answer is that
   * of expressions, multiples of 2^-(bits + 2) about the point, which is narrowed for this after the run. */
  uint64_t hindsight;
} dyd_converge_options;

/* Runs e as dyd_engine_run does, callbacks of options included, and notes a row after each stage. *out, given cleared,
 * holds the rows of the complete stages, whatever is returned. Returns the status of dyd_engine_run, or
 * DYD_E_NOMEM with outcome cancelled. converge may be NULL. A Voronoi goal without a window in options is about the
 * window of converge, or about the default one after the first stage. Each row costs O(N log N + pairs).
 *
 * Of a disc or bisector: goals of area and distance are those of its bounds. Each stage asks the points that make it
 * for the next precision, for the goal "decided" also those points whose Con is not known (schedule uniform: all
 * points). Decided: the triple is oriented and Con of all others known; the two rectangles are disjoint. Bits, widths
 * and calls are those of the points concerned. The engine is left without a result (dyd_engine_delaunay). DYD_E_ARG
 * with less than three, or two, points. */
DYD_API dyd_status dyd_converge_run(dyd_convergence *out, dyd_engine *e, const dyd_engine_options *options,
                                    const dyd_converge_options *converge, dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
