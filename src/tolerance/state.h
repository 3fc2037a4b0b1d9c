/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The state of a computation of tolerances, and its results.
 *
 *   lines.c           one pair: the other sites as lines over its bisector, exactly
 *   lines_filter.c    the same in doubles
 *   near_filter.c     the sites that a pair needs; the others near a place
 *   rows.c            all pairs, sorted; the whole
 *   points_filter.c   each point; probabilities
 *   births_filter.c   births in doubles
 *   moves_filter.c    deaths in discs of weights and in squares, by the sites that bind
 *   weights_filter.c  all pairs where points have weights
 *   squares_filter.c  all pairs where points move in squares
 *   enclosing_filter.c  the tolerances of true points in small rectangles
 *   tolerance.c       the public calls */
#ifndef DYD_TOLERANCE_STATE_H
#define DYD_TOLERANCE_STATE_H

#include "delaunay/memory.h"
#include "delaunay/undecided.h"
#include "tolerance/lines.h"
#include <dyadel/tolerance.h>

/* Vertices considered for one pair. */
typedef struct dyd_others {
  uint32_t *vertex;
  size_t count, cap;
} dyd_others;

/* A circle between i, j and all others: about the centre at s (or the end) of their bisector, `half` beyond them. */
typedef struct dyd_ring_d {
  uint32_t i, j;
  double s, half;
  int end;
} dyd_ring_d;

struct dyd_tolerance {
  dyd_tolerance_result result;
  const dyd_delaunay *pd;
  const dyd_skeleton *sk;
  dyd_delaunay *centres; /* pd, owned: of centres of rectangles; NULL: pd is borrowed */
  dyd_tolerance_options options;
  dyd_memory memory; /* what the triangulation leaves of max_bytes */
  dyd_tolerance_row *row;
  size_t rows, cap, sorted; /* sorted: rows of deaths that are */
  double *weight;           /* of a vertex, the largest of those at its place; NULL: all are 1 */
  double heaviest;
  double *sigma, widest; /* the same of standard deviations; NULL: none are given */
  double *radius;
  double *chance;   /* of each row, once sorted, where sigma was given */
  dyd_ring_d *ring; /* of all edges, for radii or probabilities */
  size_t rings;
  /* scratch */
  dyd_points_d points;
  dyd_xy *low;
  uint32_t *start, *near; /* neighbours of v: near[start[v] .. start[v + 1] - 1], the ghost included; NULL: a line */
  uint8_t *own;           /* of each of them: is the pair legal, and the row of v's site, which is the smaller one? */
  bool has_tree, *listed; /* of a vertex: is it in `lines`? Set while others are looked for */
  dyd_bbox *box;
  dyd_tree tree;
  dyd_lines lines;
  dyd_summit summit;
  dyd_lines_d small;
  dyd_others others;
};

/* enclosing_filter.c: the tolerances of true points that lie in the rectangles of pd, from those of their centres,
 * which are at most *off away from them; rows are sorted. Pairs that pd leaves indeterminate have no row. *least
 * becomes the least number of a row but of ties, of the centres. Statuses as dyd_tolerance_new. */
dyd_status dyd_tolerance_enclosing(dyd_tolerance **out, double *off, double *least, const dyd_delaunay *pd,
                                   const dyd_tolerance_options *options, dyd_error *err);

/* near_filter.c. The doubles, neighbours. */
dyd_status dyd_near_prepare(dyd_tolerance *t);
static inline uint32_t dyd_degree(const dyd_tolerance *t, uint32_t v) {
  return t->start[v + 1] - t->start[v];
}
void dyd_near_clear(dyd_tolerance *t);
/* Makes the tree over all vertices, unless there is one. */
dyd_status dyd_near_index(dyd_tolerance *t);
/* rows.c. Returns true, and holds the bytes, if the budget has room for the rows of `pairs` pairs, their circles and
 * their sorting. */
bool dyd_rows_have_room(dyd_tolerance *t, uint64_t pairs, const char *what);
bool dyd_others_add(dyd_others *o, uint32_t v);
/* *o becomes the neighbours of v and w in the skeleton, but v, w and the ghost; of an end of more than `most`
 * neighbours only the ones next to the other end. Repeats are possible. */
dyd_status dyd_others_around(dyd_others *o, const dyd_tolerance *t, uint32_t v, uint32_t w, uint32_t most);
/* *o becomes the vertices of the lines and at most `most`, or as many again, other than these, i and j, that may lie as
 * near to the place of
 * t->summit as the binding ones there (at an end: as far out). *more: some were added. */
dyd_status dyd_others_nearer(bool *more, dyd_others *o, dyd_tolerance *t, uint32_t i, uint32_t j, size_t most);

dyd_status dyd_deaths(dyd_tolerance *t);
dyd_status dyd_births(dyd_tolerance *t, dyd_error *err);
/* Where points have weights: rows from number `first` on become those with weights, without births above up_to. Births
 * of an infinite `hi` are only listed; others are made. */
dyd_status dyd_weigh(dyd_tolerance *t, size_t first);
/* squares_filter.c: the same for squares. */
dyd_status dyd_square_rows(dyd_tolerance *t, size_t first);
dyd_status dyd_whole(dyd_tolerance *t);
/* Half the distance of a corner v of the hull, at which hull edge h ends, to the line through the corners before and
 * behind, unless these are an edge: infinite then. In the metric of t. weighted: from where on their discs let v come
 * between them. */
dyd_status dyd_hull_corner(double *lo, double *hi, const dyd_tolerance *t, dyd_half_edge h, bool weighted);
dyd_status dyd_points_radius(dyd_tolerance *t);
/* After dyd_rows_sort. */
dyd_status dyd_chances(dyd_tolerance *t);

/* The row of vertices v, w, bound by the vertices k and l, or DYD_NONE. */
static inline dyd_tolerance_row dyd_row_of(const dyd_tolerance *t, uint32_t v, uint32_t w, dyd_tolerance_event event,
                                           uint32_t k, uint32_t l, double lo, double hi) {
  const uint32_t *site = t->sk->reps.site;
  uint32_t i = site[v], j = site[w], a = k == DYD_NONE ? DYD_NO_SITE : site[k],
           b = l == DYD_NONE || l == k ? DYD_NO_SITE : site[l];
  return (dyd_tolerance_row){i < j ? i : j, i < j ? j : i, event, a < b ? a : b, a < b ? b : a, lo, hi};
}
/* The upper end of a row that work did not reach before it was cancelled. */
#define DYD_UNREACHED (-1.0)
/* Rows from number `first` on, but ties, become what dyd_filter_moved_death makes of them, on the threads of the
 * options, or else `work`, and those go that it finds too late. DYD_CANCELLED: rows that were not reached are marked.
 * After dyd_near_index. */
typedef dyd_status dyd_row_work(bool *late, dyd_tolerance_row *row, void *user);
dyd_status dyd_rows_rework(dyd_tolerance *t, size_t first, dyd_row_work *work, void *user);
/* births_filter.c: the row of a pair that is not an edge, as exact numbers make it; or *late: it is born above up_to,
 * which is rounded up. false: not certain [FLT-BIRTH]. After dyd_near_index; spare: of the calling thread. */
bool dyd_filter_birth(dyd_tolerance_row *row, bool *late, const dyd_tolerance *t, uint32_t i, uint32_t j, double up_to,
                      dyd_others *spare);
/* moves_filter.c: the row of a death of unmoved weights, 1 each, in discs, becomes that of t's weights and metric
 * [TOL-11]; false: not certain, and unchanged. spare: of the calling thread. */
bool dyd_filter_moved_death(dyd_tolerance_row *row, const dyd_tolerance *t, dyd_others *spare);
/* The row of a pair that is not an edge, or *late, as dyd_filter_birth, but of t's weights and metric [TOL-12]. */
bool dyd_filter_moved_birth(dyd_tolerance_row *row, bool *late, const dyd_tolerance *t, uint32_t i, uint32_t j,
                            double up_to, dyd_others *spare);
/* After work that was cancelled: removes marked rows, and counts the pairs without one. */
void dyd_rows_reached(dyd_tolerance *t);
dyd_status dyd_row_add(dyd_tolerance *t, dyd_tolerance_row row);
/* The number of the row of v, w; all are sorted. */
size_t dyd_row_find(const dyd_tolerance *t, uint32_t v, uint32_t w);
dyd_status dyd_rows_sort(dyd_tolerance *t);

#endif
