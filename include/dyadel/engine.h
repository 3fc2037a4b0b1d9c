/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The engine: owns the points, refines them, and runs the partial triangulation until a goal is reached
 * (mathematics: section 7).
 *
 * Threads: one engine is used by one thread at a time, several engines in several threads work; only
 * dyd_engine_cancel may be called from anywhere, a signal handler included. While the engine is at work its callbacks
 * (questions, progress, trace, sources) may call functions that take it const, and dyd_engine_cancel. To callbacks and
 * to other threads dyd_engine_run, dyd_engine_ask, dyd_engine_nearest and functions that add or measure points return
 * DYD_E_ARG. The engine must not be freed then. After fork() both processes may use their copies of an engine that was
 * not at work; programs of an oracle stay those of the process that started them (DYD_E_STREAM in the other one, which
 * does not end them either). After an error an engine can be used like any other. A function of 2^18 bits or more that
 * a cancel or the time limit interrupts continues in a separate thread until it is done: no call waits for it, and it
 * holds no part of the engine.
 */
#ifndef DYADEL_ENGINE_H
#define DYADEL_ENGINE_H

#include <dyadel/delaunay.h>
#include <dyadel/graph.h>
#include <dyadel/stream.h>
#include <dyadel/tolerance.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum dyd_outcome {
  DYD_OUTCOME_NONE = 0,  /* not run yet */
  DYD_OUTCOME_DECIDED,   /* no indeterminate pair and no tie is left */
  DYD_OUTCOME_CERTIFIED, /* the requested bound holds */
  DYD_OUTCOME_FIXPOINT,  /* only better measurements can decide more: fixed rectangles, ties */
  DYD_OUTCOME_BUDGET,    /* bits, stages, calls, pairs or seconds spent */
  DYD_OUTCOME_CANCELLED,
  DYD_OUTCOME_ERROR /* a stream failed or memory ran out; earlier statements stay valid. (GMP, MPFR and FLINT end
                       the process when they run out of memory: set max_bytes, or handlers of theirs.) */
} dyd_outcome;
/* "decided", "certified", ... Static storage. */
DYD_API const char *dyd_outcome_text(dyd_outcome outcome);

typedef enum dyd_goal {
  DYD_GOAL_DECIDED = 0,
  DYD_GOAL_AREA, /* bounds on the triangulation */
  DYD_GOAL_HAUSDORFF,
  DYD_GOAL_VORONOI_AREA, /* bounds on the diagram in a window; they can hold at ties */
  DYD_GOAL_VORONOI_HAUSDORFF
} dyd_goal;
/* "decided", "area", "hausdorff", "voronoi area", "voronoi hausdorff". Static storage. */
DYD_API const char *dyd_goal_text(dyd_goal goal);

typedef enum dyd_schedule {
  DYD_SCHEDULE_ADAPTIVE = 0, /* refine what takes part in something undecided */
  DYD_SCHEDULE_UNIFORM       /* refine every point at each stage, as KEL */
} dyd_schedule;

typedef enum dyd_budget {
  DYD_BUDGET_NONE = 0,
  DYD_BUDGET_BITS,
  DYD_BUDGET_STAGES,
  DYD_BUDGET_CALLS,
  DYD_BUDGET_PAIRS,
  DYD_BUDGET_SECONDS
} dyd_budget;

/* Tests whether a determinant or difference of true points is 0: their results and their cost. */
typedef struct dyd_tie_counters {
  size_t struct_size; /* set by DYD_SIZED */
  uint64_t tests;
  uint64_t by_identity, by_bound; /* proved to be 0, by an identity or by a separation bound */
  uint64_t nonzero, unknown;
  int64_t bits_most;   /* the highest precision computed with */
  int64_t degree_most; /* the largest degree of a separation bound */
  double seconds;
} dyd_tie_counters;

/* Totals since the engine was made. */
typedef struct dyd_engine_counters {
  size_t struct_size; /* set by DYD_SIZED */
  uint64_t stages;    /* triangulations or updates done */
  uint64_t calls;     /* stream calls */
  int64_t bits_least; /* least / most precision asked of any refinable point so far; 0 when none was asked */
  int64_t bits_most;
  uint64_t bits_total; /* sum over points of the bits last asked */
  uint64_t undecided_faces;
  double seconds;   /* wall clock, all runs and questions */
  dyd_budget spent; /* which budget ended the last run */
  dyd_delaunay_counters delaunay;
  dyd_tie_counters ties;
  uint64_t bytes_most; /* the most that was estimated to be held at once by runs and questions with max_bytes */
} dyd_engine_counters;

typedef struct dyd_progress {
  size_t struct_size; /* set by the library */
  uint64_t stage;
  int64_t bits; /* precision asked for in this stage */
  size_t sites;
  size_t count[4]; /* pairs by status */
  size_t undecided_faces;
  double seconds;
} dyd_progress;

/* Why a point was narrowed. */
typedef enum dyd_reason {
  DYD_REASON_FIRST = 0, /* it had not been asked before */
  DYD_REASON_END,       /* an end of the indeterminate pair i, j */
  DYD_REASON_BLOCKER,   /* a site of an undecided face, coarser than the ends of its pairs, or none of these can be
                           narrowed */
  DYD_REASON_BOUND,     /* contributes to the bound asked for, through the pair i, j (i = j: by its own diameter) */
  DYD_REASON_UNIFORM,   /* all points are refined */
  DYD_REASON_QUESTION,  /* a question wants it narrower (dyd_engine_ask, dyd_engine_nearest) */
  DYD_REASON_POLICY     /* the policy of the options wants it narrower */
} dyd_reason;
/* "first", "end", ... Static storage. */
DYD_API const char *dyd_reason_text(dyd_reason reason);

/* One point brought to a precision. */
typedef struct dyd_step {
  size_t struct_size; /* set by the library */
  uint64_t stage;     /* the stage it belongs to, from 1: that of the next report of progress */
  uint32_t site;
  int64_t bits; /* precision asked for */
  dyd_reason reason;
  uint32_t i, j;        /* see dyd_reason; the site itself where that names none */
  bool called;          /* false: it was that narrow before, no stream was called */
  const dyd_rect *rect; /* reached; borrowed during the call */
  bool final;           /* no call can narrow it further */
} dyd_step;

/* Which sites a question needs narrower, and how far. Made by the engine, filled in by the question, carried out by the
 * engine when the question returns: asking changes nothing. */
typedef struct dyd_wants dyd_wants;
typedef struct dyd_engine dyd_engine;

/* Changes what a stage narrows. `request`, count (dyd_request_at): points, by their numbers as sites, and bits that the
 * schedule wants. Entries added to *wants (dyd_wants_add), empty when called, replace that; if none is added,
 * it stays. Before the first stage every point is wanted, and one that is not added keeps its bits. e as for
 * dyd_ask_fn: dyd_engine_delaunay has the undecided pairs, NULL before the first stage. Returns DYD_OK; DYD_CANCELLED
 * to give up; an error < 0 with *err (clear when called) filled. Statements do not depend on it, nor does the end of a
 * run: each point added gets a request for more bits than before, up to max_bits. */
typedef dyd_status (*dyd_policy_fn)(dyd_wants *wants, void *user, const dyd_engine *e, const dyd_request *request,
                                    size_t count, dyd_error *err);

typedef struct dyd_engine_options {
  size_t struct_size; /* set by dyd_engine_options_init, or by DYD_SIZED */
  dyd_goal goal;
  int64_t goal_bits;      /* M of "bound 2^-M" for the area and Hausdorff goals */
  const dyd_rect *window; /* of the Voronoi goals: dyadic ends, positive area; borrowed during the run */
  dyd_schedule schedule;
  int64_t start_bits;  /* precision of the first stage; default 64. 0, and no options at all: 64, or less (24 at least)
                          for expressions that doubles enclose so well, unless the schedule is uniform */
  int64_t step_bits;   /* each refinement asks for this many bits more; 0: growth is geometric */
  int64_t max_bits;    /* 0: default 4096 */
  uint64_t max_stages; /* of this run; 0: no limit */
  uint64_t max_calls;  /* of this run; 0: no limit */
  size_t max_pairs;    /* 0: default, see dyd_delaunay_options */
  double seconds;      /* of this run; 0: no limit; wall clock */
  unsigned threads;    /* 0: one */
  bool no_filter;      /* exact rung only (tests) */
  bool discs;          /* Voronoi goals, and rows of dyd_converge_run, are about the discs in the squares of sites
                          (dyd_disc_pairs) */
  /* Called after each stage from the running thread; may be NULL. It may look at the engine (the functions below that
   * take it const) and cancel it, nothing else. */
  void (*progress)(void *user, const dyd_progress *p);
  void *progress_user;
  /* Called after each narrowing, in the order they are made; may be NULL. It may cancel the engine. */
  void (*trace)(void *user, const dyd_step *step);
  void *trace_user;
  /* Ties among points given by expressions and roots (mathematics: section 11) are proved, unless no_ties; with at most
   * this many bits for each proof; 0: default 2^17. */
  int64_t tie_bits;
  bool no_ties;
  /* Cost of asking each point again, above 0; NULL: that of its row (DYD_ROW_COST of io.h). The adaptive
   * schedule postpones points that cost more than twice as much as the cheapest point that a face needs narrower,
   * until the same amount was spent on others. dyd_engine_count(e) numbers, borrowed during the run. */
  const double *cost;
  /* Memory that the engine may hold while it works, points included, by its own estimate; 0: no bound. Before more is
   * asked for (half-edges, faces, pairs, sums of the bounds, digits of the points, proofs of ties) the run ends with
   * DYD_E_NOMEM and names the allocation; the engine and its last result stay as they are, and a run with a larger
   * bound continues. This protects against GMP, MPFR and FLINT, which end the process when memory is exhausted: set it,
   * for example, to half of the available memory. Estimates are within a factor of 2 of what the engine holds, or a
   * megabyte where that is more; of callbacks only the answers count. Later calls that build outputs from the result
   * (lists of pairs and triangles, outputs, pictures, certificates, cells, polygons, diagrams and their bounds, graphs,
   * tolerances, plans) fail with DYD_E_NOMEM if they would exceed the bound together with points and result. Both are
   * kept, and smaller outputs remain possible. Pictures of diagrams are estimated roughly; the lists of spheres are not
   * counted. */
  uint64_t max_bytes;
  /* Called with the wants of every stage of a run or question; NULL: those of the schedule are carried out. */
  dyd_policy_fn policy;
  void *policy_user;
  /* Instead of policy: a command (sh -c) that a run or question starts, and that answers until its input ends;
   * borrowed. For each stage it reads lines "stage S points N", "pair I J" for each indeterminate pair, "plan I B" for
   * each point wanted, and "choose". It answers by lines "refine I B", as dyd_wants_add, and "go". A program that
   * ends, writes something else, or is silent for policy_seconds (0: DYD_ORACLE_SECONDS) ends the run with
   * DYD_E_STREAM. */
  const char *policy_program;
  double policy_seconds;
} dyd_engine_options;
/* Fills in the size and the defaults (all zero unless the comments say otherwise). */
static inline void dyd_engine_options_init(dyd_engine_options *o) {
  memset(o, 0, sizeof *o);
  o->struct_size = sizeof *o;
  o->start_bits = 64;
  o->max_bits = 4096;
}

DYD_API dyd_status dyd_engine_new(dyd_engine **out);
DYD_API void dyd_engine_free(dyd_engine *e);

/* Adding points: numbered from 0 in the order added, at any time but from within a callback. On failure nothing is
 * added (and of streams and sources the reference or context is released), and err, which may be NULL, says why:
 * DYD_E_ARG for NaN, infinities and lower ends above upper ones, with the point.
 * Points added after a run or question get the next numbers, and invalidate the result, which is about fewer points:
 * dyd_engine_delaunay is NULL and dyd_engine_outcome DYD_OUTCOME_NONE until the next stage is complete. Rectangles stay
 * as narrow as they are, no request is repeated. The result of the next run equals that of an engine with all points
 * from the start, for the rectangles reached. Statements are monotone for fixed points; among more points a legal pair
 * may become illegal. Cost: O(points added). The next run works only on the faces around the new points, O(sqrt(N)) for
 * each that is far from the one before, if they are at most a sixteenth of the points that were triangulated last; they
 * are no rectangles among exact points, and no exact point among rectangles has the place of another; no old point was
 * narrowed in between; no face is capped; and there is no memory budget. Otherwise it triangulates all. */
DYD_API dyd_status dyd_engine_add_points(dyd_engine *e, size_t n, const double *x, const double *y, dyd_error *err);
DYD_API dyd_status dyd_engine_add_boxes(dyd_engine *e, size_t n, const double *x0, const double *x1, const double *y0,
                                        const double *y1, dyd_error *err);
/* The same from the columns x and y: of an array of n pairs, {{a, 16}, {a + 1, 16}}. radius: NULL, or columns of
 * half-widths in x and in y, not negative: then point k is x - radius, x + radius and so on, rounded outward to the
 * next double where it is none. DYD_E_ARG also for ends beyond the largest double. */
DYD_API dyd_status dyd_engine_add_columns(dyd_engine *e, size_t n, const dyd_column xy[2], const dyd_column *radius,
                                          dyd_error *err);
/* A fixed rectangle or exact point. Copied. */
DYD_API dyd_status dyd_engine_add_rect(dyd_engine *e, const dyd_rect *r, dyd_error *err);
/* Takes over one reference. */
DYD_API dyd_status dyd_engine_add_stream(dyd_engine *e, dyd_stream *s, dyd_error *err);
/* n points served by one callback, as points 0 .. n-1 of the source. Copied; release is called once,
 * when the engine is freed. */
DYD_API dyd_status dyd_engine_add_source(dyd_engine *e, size_t n, const dyd_source *source, dyd_error *err);

/* Point i has been measured again, before or between runs: it lies in r, and where it is known to lie. Its rectangle
 * becomes the intersection of both, for every kind of point; later answers of its stream or source are intersected
 * with it. Statements stay as they are, and the next run brings the result up to date. Returns DYD_OK, also where r
 * adds no information; DYD_E_CONTRADICTION, with err naming the point and both rectangles, when they have nothing in
 * common (then nothing changes: one of them is wrong; runs end with it when a stream's answer is of that kind);
 * DYD_E_ARG when there is no point i, when r is not valid, and from within a callback; DYD_E_NOMEM. r is copied. Not in
 * traces. O(log points), and the next run works only on the undecided faces that have point i as a corner; err may be
 * NULL. */
DYD_API dyd_status dyd_engine_remeasure(dyd_engine *e, uint32_t i, const dyd_rect *r, dyd_error *err);
/* Point i, which can be narrowed, answered r when it was asked for `bits` in an earlier run (a dyd_step
 * with `called`); `final` as there. Given again instead of asking it, in the order of these calls: a request is
 * answered by the first answer left that was for at least as many bits. So a run with the same options takes the way of
 * the earlier one, and asks only from where that ended; answers that come then are intersected with those recalled, and
 * one that has nothing in common with them ends the run with DYD_E_CONTRADICTION. Before the first run only. DYD_E_ARG
 * when there is no such point or r is not valid, DYD_E_NOMEM. r is copied; err may be NULL. O(log answers) amortized.
 */
DYD_API dyd_status dyd_engine_recall(dyd_engine *e, uint32_t i, int64_t bits, const dyd_rect *r, bool final,
                                     dyd_error *err);
DYD_API size_t dyd_engine_count(const dyd_engine *e);

/* What point i is called in the file it was read from (dyd_read_options): its row, counted from 0, rows without a point
 * included; other points are rows of their own, in the order of adding. So it is i unless rows were skipped or merged.
 * Writers of results name points by their rows; errors, traces and certificates by i. e NULL: i. O(1). */
DYD_API size_t dyd_engine_row(const dyd_engine *e, size_t i);
/* Its identifier, "" without one; NULL: no point has one. Terminated, any bytes; borrowed until points are added. */
DYD_API const char *dyd_engine_id(const dyd_engine *e, size_t i);
/* Names the n points added last: row[k], ascending and above the rows of the points before, and id[k], which may be
 * NULL; id NULL: none has an identifier. Copied. Before a sphere is made of e. DYD_E_ARG when there are fewer points or
 * rows do not ascend, or rows were merged; DYD_E_NOMEM. O(points) */
DYD_API dyd_status dyd_engine_name(dyd_engine *e, size_t n, const size_t *row, const char *const *id);
/* The k-th row, ascending, that was taken as one with an earlier one, and the point that represents both; false:
 * none is left. */
DYD_API bool dyd_engine_merged(size_t *row, size_t *point, const dyd_engine *e, size_t k);

/* Runs until exactly one outcome holds; may be called again with other options to continue from there: earlier
 * statements stay valid. options may be NULL.
 * Returns DYD_OK for the outcomes decided, certified, fixpoint, budget and cancelled; an error code for
 * DYD_OUTCOME_ERROR, with *err filled. *outcome is always set; err may be NULL. After an error in a stream the last
 * complete result stays available (dyd_engine_delaunay), if there was one. When the budget of pairs is spent, *err
 * names the sites (code DYD_CAPPED). After a cancel or the end of time within a stage some sites may be narrower
 * than when the result was made: it holds for them all the same, and the next run begins by bringing it up to date. */
DYD_API dyd_status dyd_engine_run(dyd_outcome *outcome, dyd_engine *e, const dyd_engine_options *options,
                                  dyd_error *err);

/* The statuses of n points in one call, for programs that need nothing else of an engine.
 * out      pairs that are not illegal, i < j, sorted; empty before; the caller clears it with dyd_pair_list_clear
 * xy       x0 y0 x1 y1 ...: 2 n doubles, borrowed for the call
 * radius   each point lies in the square of this half-width about its x, y; 0: exact points
 * options  as of dyd_engine_run, NULL selects the defaults; err may be NULL
 * Returns DYD_OK also where pairs stay undecided (their status says so), or a code below 0 with *out unchanged:
 * DYD_E_ARG for NaN, infinities and a radius below 0. */
DYD_API dyd_status dyd_delaunay_of(dyd_pair_list *out, size_t n, const double *xy, double radius,
                                   const dyd_engine_options *options, dyd_error *err);
/* Asks a run to stop soon, with outcome cancelled. Async-signal-safe, from any thread. Sticky until the next
 * run has ended with it. */
DYD_API void dyd_engine_cancel(dyd_engine *e);

DYD_API dyd_outcome dyd_engine_outcome(const dyd_engine *e);
/* The goal of the last run, and its goal_bits in *bits (may be NULL); DYD_GOAL_DECIDED and 0 before the first one. */
DYD_API dyd_goal dyd_engine_goal(int64_t *bits, const dyd_engine *e);
/* The rectangles as they are now; borrowed until e is freed, they shrink in place. A point that was never asked holds
 * the whole plane: numbers too large to compute with. */
DYD_API const dyd_sites *dyd_engine_sites(const dyd_engine *e);
/* Returns true if there is a rectangle for site i: the site is fixed, or was asked or measured once. Returns false if
 * there is no site i. */
DYD_API bool dyd_engine_knows(const dyd_engine *e, uint32_t i);
/* The current result; borrowed until the next call that changes e; NULL before the first complete stage, and
 * before the next one when points were appended. */
DYD_API const dyd_delaunay *dyd_engine_delaunay(const dyd_engine *e);
DYD_API dyd_status dyd_engine_get_counters(dyd_engine_counters *out, const dyd_engine *e, dyd_error *err);
/* The bounds of the current result (metric.h), DYD_E_ARG before the first complete stage. */
DYD_API dyd_status dyd_engine_bounds(dyd_dyadic *area, dyd_dyadic *hausdorff, const dyd_engine *e);

/* ---- questions ---- */

#define DYD_BITS_NEXT INT64_MIN
/* Adds site i, to be brought to 2^-bits. Where that was requested before, and for DYD_BITS_NEXT, it is the next
 * step of the options (start_bits, step_bits): a site that is wanted always narrows. bits are cut to max_bits. Of
 * several calls for one site the finest counts. Site dyd_engine_count(e) + k is guest k of the question. A site that is
 * fixed, final, or was requested at max_bits before is skipped without an error. Returns DYD_OK; DYD_E_ARG when there
 * is no site i, DYD_E_NOMEM: then dyd_engine_ask ends with this error, whatever the question returns. O(log points). */
DYD_API dyd_status dyd_wants_add(dyd_wants *wants, uint32_t i, int64_t bits);
/* Returns the number of points wanted. */
DYD_API size_t dyd_wants_count(const dyd_wants *wants);

/* Looks whether the answer is known. Either sets *answered = true (false when called), or adds to *wants, empty when
 * called, which have to be narrower. e is borrowed for the call: see dyd_engine_sites, dyd_engine_knows,
 * dyd_engine_delaunay. Returns DYD_OK; DYD_CANCELLED to give up; an error < 0 with *err (clear when called) filled. */
typedef dyd_status (*dyd_ask_fn)(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err);

/* A question, borrowed during the ask. */
typedef struct dyd_question {
  size_t struct_size;
  dyd_ask_fn ask;
  void *user;
  bool triangulate; /* it looks at the triangulation: all points are asked once before it comes first, and the result
                       is brought up to date before it comes again */
  /* Further points that it looks at, borrowed; they may be narrowed, as sites are, and have a rectangle
   * (dyd_stream_rect) whenever the question comes. They are not sites of the triangulation. */
  dyd_stream *const *guest;
  size_t guests;
} dyd_question;

/* The loop of the engine: asks, narrows the points wanted, asks again, until exactly one outcome holds:
 * decided (answered), fixpoint (nothing is wanted: nothing the question needs can be narrowed), budget (bits: it needs
 * more than max_bits; stages, pairs: with triangulate only; calls; seconds), cancelled. dyd_engine_run and
 * dyd_engine_nearest are questions of this kind.
 *
 * A question that does not use the triangulation is called again after a cancel or the time limit, so that it
 * has seen the rectangles reached; its wants are then ignored. The next run updates the result with the points narrowed
 * here. options may be NULL; goal and schedule are ignored; progress is called after each triangulation.
 * Guests are narrowed to the precision of the first stage at the start, and do not appear in traces.
 *
 * Returns DYD_OK, or an error with outcome DYD_OUTCOME_ERROR and *err (may be NULL) filled: that of a stream, of the
 * question; DYD_E_ARG for bad options, for a site that does not exist, and from within a callback of e, which is
 * then unchanged. Statements stay valid in every case. dyd_engine_outcome and the counter `spent` describe the last
 * run. Cost: the calls of the question and its wants; O(log points) for each point narrowed, a triangulation update for
 * each stage.
 *
 * Example: decides whether points 0 and 1 are certainly different. (r: two rectangles, initialised.)
 *
 *     static dyd_status differ(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
 *       dyd_rect *r = user;
 *       dyd_status st = DYD_OK;
 *       for (uint32_t i = 0; st == DYD_OK && i < 2; i++) st = dyd_sites_get(&r[i], dyd_engine_sites(e), i);
 *       *answered = st == DYD_OK && !dyd_rect_meets(&r[0], &r[1]);
 *       for (uint32_t i = 0; st == DYD_OK && i < 2; i++) st = dyd_wants_add(wants, i, DYD_BITS_NEXT);
 *       return st;
 *     }
 *     const dyd_question question = {DYD_SIZED(dyd_question), .ask = differ, .user = r};
 *     dyd_status st = dyd_engine_ask(&outcome, e, &question, NULL, &err);
 */
DYD_API dyd_status dyd_engine_ask(dyd_outcome *outcome, dyd_engine *e, const dyd_question *question,
                                  const dyd_engine_options *options, dyd_error *err);

/* ---- points as streams, and questions about computable points ---- */

/* Point i of e, as a new reference to a stream that stays valid when e is freed (compose.h). It begins with the
 * rectangle that e knows. Points that one of the two narrows later may be wider in the other; both enclose the same
 * point. DYD_E_ARG when there is no point i. */
DYD_API dyd_status dyd_engine_stream(dyd_stream **out, dyd_engine *e, uint32_t i);

/* Which points of e are possibly nearest to the point `at`, ascending; *sure: exactly one is, and it is certainly
 * nearest. Refines `at` and the points that are possibly nearest until that is certain (decided), until nothing
 * concerned can be refined (fixpoint: ties, fixed rectangles), or until options->max_bits, max_calls or seconds are
 * spent (budget); dyd_engine_cancel works (cancelled). *out is right for the rectangles reached in every case, and the
 * list only ever shrinks [NEAR-3]. Needs a result (DYD_E_ARG before the first run); points narrowed here are brought
 * into it by the next run. `at` is borrowed. options (may be NULL): goal, schedule, stages, pairs and progress are
 * ignored. On errors *outcome is DYD_OUTCOME_ERROR, *err (may be NULL) is filled, *out and *sure are as before.
 * dyd_engine_outcome and the counter `spent` still describe the last run. */
DYD_API dyd_status dyd_engine_nearest(dyd_index_list *out, bool *sure, dyd_outcome *outcome, dyd_engine *e,
                                      dyd_stream *at, const dyd_engine_options *options, dyd_error *err);
/* Returns true if the last dyd_engine_nearest ended with a tie: all points that it listed, at least two, are equally
 * far from `at`, because all is exact, or by a proof from the forms of the coordinates (unless options->no_ties). Then
 * each of them is nearest, permanently, and the outcome is fixpoint. Returns false before the first call, and after one
 * that failed. */
DYD_API bool dyd_engine_nearest_tied(const dyd_engine *e);

/* The edges of a graph of neighbours, as dyd_graph_edges has them, after refining the points about which they are not
 * yet certain. Outcomes: decided (each edge listed is certain); fixpoint (no refinement makes the others certain: fixed
 * or equal distances of fixed points, radii that stay [NEAR-6]); budget; cancelled. Equal distances of points that are
 * not exact end with budget: they are not proved. *out is right for the rectangles reached; refined later it only loses
 * edges that are not certain. DYD_CANCELLED if it was cancelled, or the time ended, before any were found: *out is as
 * before, as on errors. options->discs: of discs, whose points are refined as for dyd_engine_discs.
 * options and errors as in dyd_engine_ask. */
DYD_API dyd_status dyd_engine_graph(dyd_graph_list *out, dyd_outcome *outcome, dyd_engine *e, dyd_graph graph,
                                    const dyd_engine_options *options, dyd_error *err);

/* The pairs of dyd_disc_pairs (see there) for the discs in squares whose points were computed and have radii. Refines
 * the centres of undecided pairs, up to the precision at which discs are decided. Outcomes: decided (each pair
 * listed is legal), fixpoint, budget, cancelled. DYD_CAPPED, and DYD_CANCELLED as there: *out is valid. options and
 * errors as in dyd_engine_ask. */
DYD_API dyd_status dyd_engine_discs(dyd_pair_list *out, dyd_outcome *outcome, dyd_engine *e,
                                    const dyd_engine_options *options, dyd_error *err);

/* Tolerances of the true points of e (tolerance.h), exact or computable: the statuses are refined until they are
 * decided or are ties, then all points until each death and birth but ties is enclosed to a relative width of at most
 * 2^-relative_bits beyond that for exact points; 1 to 40, others: 20 [TOL-10]. k and l of a row bind for the centres of
 * the rectangles reached. A pair that the budget leaves indeterminate has no row. *out is released by
 * dyd_tolerance_free, and does not need e; NULL when no stage was complete. Outcomes: decided; fixpoint: ties, which
 * are events; budget: statuses or widths miss the request, but all statements hold; cancelled. DYD_CANCELLED
 * as dyd_tolerance_new; DYD_E_ARG for a rectangle that nothing narrows (err names it), and for weights or standard
 * deviations unless all points are exact. Cost: a run, and about two times that of dyd_tolerance_new. */
DYD_API dyd_status dyd_engine_tolerance(dyd_tolerance **out, dyd_outcome *outcome, dyd_engine *e,
                                        const dyd_tolerance_options *options, int64_t relative_bits,
                                        const dyd_engine_options *run, dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
