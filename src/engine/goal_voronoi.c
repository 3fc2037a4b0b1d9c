/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Goals on the Voronoi diagram: whether they hold, and the contribution of each pair.
 *
 * The bounds themselves are certified (metric/bounds.c). The numbers of pairs that steer the refinement need no
 * proof: for the Hausdorff bound they are widths of strips, or, below the goal, the very terms it is the maximum of;
 * for the area, four times that term (the width of the strip in which the pair is undecided, twice over) times the
 * smaller reach of the two cells (half its length). Where all numbers together stay below the goal and the area does
 * not, it is the flattening of the polygons that costs, and they are made finer. */
#include "engine/goal_voronoi.h"
#include "base/local.h"
#include "delaunay/memory.h"

#include "base/alloc.h"
#include "metric/bounds.h"
#include <math.h>

enum { FINER = 8, MOST_FINER = 64 };

void dyd_goal_sums_free(dyd_voronoi_sums **sums) {
  if (!*sums) return;
  dyd_voronoi_sums_clear(*sums);
  free(*sums);
  *sums = NULL;
}

bool dyd_goal_window_is_good(const dyd_rect *window) {
  dyd_window w;
  return window && dyd_window_init(&w, window) >= 0;
}

/* At most 2^-M; a second point farther away than the goal is as good as none. */
static double goal_most(const dyd_engine_options *o) {
  return o->goal_bits > 1000 ? 0 : o->goal_bits < -1000 ? HUGE_VAL : ldexp(1, (int)-o->goal_bits);
}

/* Makes *sums with polygons within 2^-bits. Stopped when e->stop is raised: DYD_CANCELLED. */
static dyd_status goal_try_sums(dyd_voronoi_sums **sums, const dyd_engine *e, const dyd_engine_options *o,
                                int64_t bits) {
  dyd_goal_sums_free(sums);
  *sums = malloc(sizeof **sums);
  if (!*sums) return DYD_E_NOMEM;
  dyd_status st = dyd_voronoi_sums_init(*sums, e->pd, o->window, bits);
  (*sums)->most = goal_most(o);
  (*sums)->discs = o->discs;
  (*sums)->cancel = &e->stop;
  if (st == DYD_OK) st = dyd_voronoi_sums_all(*sums, NULL, NULL);
  if (e->room && (*sums)->room.refused) {
    dyd_room_join(e->room, &(*sums)->room);
    e->room->wanted += e->room->beside;
  }
  return st;
}

/* The same; finer where polygons as coarse as that cross themselves and are not mended by adding corners. */
static dyd_status goal_find_sums(dyd_voronoi_sums **sums, const dyd_engine *e, const dyd_engine_options *o,
                                 int64_t bits) {
  enum { STEP = 12, TRIES = 4 };
  dyd_status st = goal_try_sums(sums, e, o, bits);
  for (int k = 1; st == DYD_E_RANGE && k < TRIES; k++) st = goal_try_sums(sums, e, o, bits + k * STEP);
  return st;
}

dyd_status dyd_goal_voronoi_number(mpfr_ptr out, dyd_voronoi_sums *sums, dyd_measure *m, const dyd_pair *pair,
                                   const dyd_engine_options *o) {
  bool finite;
  double second;
  dyd_status st = dyd_voronoi_pair_width(out, &finite, sums, m, pair);
  if (st != DYD_OK) return st;
  if (!finite) mpfr_set_inf(out, 1);
  if (o->goal == DYD_GOAL_VORONOI_HAUSDORFF) {
    if (mpfr_cmp_ui_2exp(out, 1, (mpfr_exp_t)-o->goal_bits) <= 0) return DYD_OK;
    st = dyd_voronoi_pair_second(&second, sums, pair);
    if (st == DYD_OK && second <= sums->most) mpfr_set_d(out, second, MPFR_RNDU);
  } else if (finite) {
    double reach[2];
    dyd_voronoi_pair_reach(reach, sums, pair);
    mpfr_mul_d(out, out, reach[reach[1] < reach[0]], MPFR_RNDU);
    mpfr_mul_2ui(out, out, 2, MPFR_RNDU);
  }
  return st;
}

/* Sets *out to whether the numbers of all pairs stay below the goal. */
static dyd_status goal_numbers_are_small(bool *out, dyd_voronoi_sums *sums, const dyd_engine *e,
                                         const dyd_engine_options *o, const dyd_pair_list *pairs) {
  DYD_SCOPED(dyd_measure) m;
  dyd_status st = DYD_OK;
  dyd_measure_init(&m, e->sites);
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, sum, one);
  mpfr_set_zero(sum, 1);
  for (size_t k = 0; k < pairs->count && st == DYD_OK; k++) {
    st = dyd_goal_voronoi_number(one, sums, &m, &pairs->item[k], o);
    mpfr_add(sum, sum, one, MPFR_RNDU);
  }
  *out = st == DYD_OK && mpfr_cmp_ui_2exp(sum, 1, (mpfr_exp_t)-o->goal_bits) < 0;
  return st;
}

/* Returns true if the bound, found with polygons within 2^-bits, is above the goal even less what flattening adds to it
 * (about 2^-(bits - flattening of goal 0)). Then finer polygons do not help. */
static bool goal_is_hopeless(mpfr_srcptr bound, int64_t bits, const dyd_engine *e, const dyd_engine_options *o) {
  int64_t flat = bits - dyd_metric_flattening(e->pd, o->window, 0);
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, rest);
  mpfr_set_ui_2exp(rest, 1, (mpfr_exp_t)-flat, MPFR_RNDU);
  mpfr_sub(rest, bound, rest, MPFR_RNDD);
  return mpfr_cmp_ui_2exp(rest, 1, (mpfr_exp_t)-o->goal_bits) > 0;
}

/* Polygons start coarse and become as fine as the goal asks, or only so fine that they show that it does not hold:
 * parabolas take 2^(bits/2) points. */
static dyd_status goal_area_holds(bool *out, mpfr_ptr bound, dyd_voronoi_sums **sums, const dyd_engine *e,
                                  const dyd_engine_options *o, const dyd_pair_list *pairs) {
  dyd_status st = DYD_OK;
  int64_t fine = dyd_metric_flattening(e->pd, o->window, o->goal_bits), bits = dyd_metric_coarseness(e->pd, o->window);
  if (bits > fine) bits = fine;
  while (st == DYD_OK && !*out && bits <= fine + MOST_FINER) {
    bool small = false;
    st = goal_find_sums(sums, e, o, bits);
    if (st != DYD_OK) break;
    dyd_voronoi_area(bound, *sums);
    *out = mpfr_cmp_ui_2exp(bound, 1, (mpfr_exp_t)-o->goal_bits) <= 0;
    if (!*out) st = goal_numbers_are_small(&small, *sums, e, o, pairs);
    if (!small && (bits >= fine || goal_is_hopeless(bound, bits, e, o))) break;
    bits = bits < fine && (small || bits + FINER > fine) ? fine : bits + FINER;
  }
  return st;
}

dyd_status dyd_goal_voronoi_holds(bool *out, dyd_voronoi_sums **sums, const dyd_engine *e,
                                  const dyd_engine_options *o) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  bool finite = false;
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, bound);
  dyd_status st = dyd_pairs_list(&pairs, e->pd, dyd_least_bounding_true(e->pd));
  if (st == DYD_OK && o->goal == DYD_GOAL_VORONOI_AREA) {
    st = goal_area_holds(out, bound, sums, e, o, &pairs);
  } else if (st == DYD_OK) {
    st = goal_find_sums(sums, e, o, dyd_metric_coarseness(e->pd, o->window));
    if (st == DYD_OK) st = dyd_voronoi_hausdorff(bound, &finite, *sums, &pairs);
    *out = st == DYD_OK && finite && mpfr_cmp_ui_2exp(bound, 1, (mpfr_exp_t)-o->goal_bits) <= 0;
  }
  if (*out || st != DYD_OK) dyd_goal_sums_free(sums);
  return st;
}

/* ---- vertices ---- */

dyd_status dyd_goal_vertex_excess(int64_t *out, const dyd_engine *e, const dyd_triangle *t,
                                  const dyd_engine_options *o) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_voronoi_vertex(&r, e->pd, t, o->goal_bits + 2);
  int64_t bits = dyd_rect_bits(&r);
  *out = st != DYD_OK || bits >= o->goal_bits || !dyd_rect_meets(&r, o->window) ? 0 : o->goal_bits - bits;
  return st;
}
