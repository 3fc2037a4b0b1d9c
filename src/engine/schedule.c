/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which points to narrow next, and how far (mathematics: section 7).
 *
 * Towards "decided": in each undecided face, those ends of indeterminate pairs that are coarsest for their surroundings
 * (coarse.c); where no end can be narrowed further, the coarsest sites of the face, since a blocker may be what keeps a
 * pair open. Sites of the face that are no ends follow one step behind, so that a wide blocker is not left alone while
 * the ends are refined for nothing. In a result that met its cap pairs are missing: all sites of the undecided faces
 * are refined.
 *
 * Towards "Hausdorff bound 2^-M": the bound is the largest of one number per pair (metric/bounds.c). For legal pairs it
 * is the larger diameter, so every point with a diameter above 2^-M is narrowed; for the others, as above, but only in
 * faces with an indeterminate pair whose number is above 2^-M.
 *
 * Towards "area bound 2^-M": of P possible pairs whose areas sum to more than 2^-M at least one is above the share 2^-M
 * / P; the ends of all these are narrowed. Where none of them can be, the points in pairs of at least half the area of
 * the largest pair with a point that can.
 *
 * Towards bounds on the Voronoi diagram the same is done with other numbers of the pairs (goal_voronoi.c).
 *
 * In faces of many points a few go ahead of the others, to tell how far these must go (scout.c).
 *
 * Every rule marks a point whenever one that matters can be narrowed, and every mark asks for more than before, up to
 * max_bits: the loop ends. Growth is geometric, so a run asks for at most about twice the bits it needs; with step_bits
 * it is that step instead, for tables of convergence. */
#include "engine/coarse.h"
#include "engine/engine.h"
#include "engine/scout.h"

#include "metric/bounds.h"
#include "stream/stream.h"

/* b + by without overflow, by >= 0; at most max where b is. */
static int64_t raised(int64_t b, int64_t by, int64_t max) {
  return b > max - by ? max : b + by;
}

/* The precision of the first stage. Where none is given it is 64, or what doubles give, if that is worth a stage: most
 * points need no more. Those that do go on as if they had been asked for 64. */
#define FIRST_BITS 64
#define FIRST_IN_DOUBLES 24

/* The step from precision b to the next. */
static int64_t grown(int64_t b, const dyd_engine_options *o) {
  if (o->step_bits) return raised(b, o->step_bits, o->max_bits);
  if (!o->start_bits && b < FIRST_BITS) b = FIRST_BITS;
  int64_t size = b < 0 ? -b : b;
  return b + (size < 16 ? 16 : size);
}

/* Can p still be asked, now or under a larger max_bits? In the second case the plan remembers that. */
static bool can_narrow(dyd_plan *plan, const dyd_refinable *p, const dyd_engine_options *o) {
  if (!p || p->final) return false;
  if (p->bits < o->max_bits) return true;
  plan->bits_blocked = true;
  return false;
}

/* Why a point is marked, and the pair that this names. */
typedef struct cause {
  dyd_reason reason;
  uint32_t i, j;
} cause;

/* Marks p; of several causes the one that asks for most is kept, the first among equals. */
static void mark(dyd_plan *plan, dyd_refinable *p, int64_t want, cause why, const dyd_engine_options *o) {
  if (want > o->max_bits) want = o->max_bits;
  if (!p->marked) plan->marked++;
  if (!p->marked || p->want < want) {
    p->want = want;
    p->reason = why.reason;
    p->pair[0] = why.i;
    p->pair[1] = why.j;
  }
  p->marked = true;
}

/* A cause that names no pair. */
static cause alone(dyd_reason reason, const dyd_refinable *p) {
  return (cause){reason, p->site, p->site};
}

static int64_t first_bits(const dyd_refinable *p, const dyd_engine_options *o) {
  if (o->start_bits) return o->start_bits;
  if (!p->stream || o->schedule != DYD_SCHEDULE_ADAPTIVE) return FIRST_BITS;
  int64_t bits = dyd_stream_glance_bits(p->stream);
  return bits >= FIRST_IN_DOUBLES && bits < FIRST_BITS ? bits : FIRST_BITS;
}

void dyd_engine_plan_first(dyd_plan *out, dyd_engine *e, const dyd_engine_options *o) {
  *out = (dyd_plan){0};
  for (size_t k = 0; k < e->points; k++) {
    dyd_refinable *p = &e->point[k];
    if (!p->asked) mark(out, p, first_bits(p, o), alone(DYD_REASON_FIRST, p), o);
  }
}

/* ---- undecided faces ---- */

/* Must the pair be refined? m = NULL: always; otherwise when its Hausdorff number is above the goal. */
static dyd_status pair_matters(bool *out, mpfr_ptr number, dyd_measure *m, const dyd_pair *pair,
                               const dyd_engine_options *o) {
  *out = pair->status == DYD_INDETERMINATE;
  if (!*out || !m) return DYD_OK;
  dyd_status status = dyd_bound_pair_hausdorff(number, m, pair);
  *out = status < 0 || mpfr_cmp_ui_2exp(number, 1, (mpfr_exp_t)-o->goal_bits) > 0;
  return status;
}

/* Removes the pairs that need not be refined. */
static dyd_status keep_pairs(dyd_pair_list *pairs, mpfr_ptr number, dyd_measure *m, const dyd_engine_options *o) {
  dyd_status status = DYD_OK;
  size_t kept = 0;
  for (size_t k = 0; status >= 0 && k < pairs->count; k++) {
    bool matters;
    status = pair_matters(&matters, number, m, &pairs->item[k], o);
    if (status >= 0 && matters) pairs->item[kept++] = pairs->item[k];
  }
  pairs->count = kept;
  return status;
}

/* Sites known about as well as the least known one are refined with it: up to twice its bits. */
static int64_t companions(int64_t least) {
  return least > INT64_MAX / 4 ? INT64_MAX : 2 * least + 2;
}

static int64_t lesser(int64_t a, int64_t b) {
  return a < b ? a : b;
}

/* The step of a point that is known to `relative` bits of its distances: to twice as many, where these are few of its
 * bits. Where it meets a neighbour the distance is not known, and all of its bits are doubled. */
static int64_t next_bits(const dyd_refinable *p, int64_t relative, const dyd_engine_options *o) {
  if (o->step_bits || relative < 16 || relative > p->bits / 2) return grown(p->bits, o);
  return raised(p->bits, relative, o->max_bits);
}

/* Marks the coarsest of the ends of pairs that can be narrowed; *least becomes their relative precision. false: none
 * can be. */
static bool mark_ends(int64_t *least, dyd_plan *plan, const dyd_engine *e, const dyd_coarse *c,
                      const dyd_pair_list *pairs, const dyd_engine_options *o) {
  bool any = false;
  *least = INT64_MAX;
  for (int pass = 0; pass < 2; pass++) {
    for (size_t k = 0; k < 2 * pairs->count; k++) {
      const dyd_pair *pair = &pairs->item[k / 2];
      dyd_refinable *p = dyd_engine_find(e, k % 2 ? pair->j : pair->i);
      if (!can_narrow(plan, p, o)) continue;
      int64_t relative = dyd_coarse_bits(c, p->site);
      any = true;
      if (pass == 0)
        *least = lesser(*least, relative);
      else if (relative <= companions(*least))
        mark(plan, p, next_bits(p, relative, o), (cause){DYD_REASON_END, pair->i, pair->j}, o);
    }
  }
  return any;
}

/* Marks the sites of the face that are coarser than the ends; where no end can be narrowed, the coarsest of all. */
static void mark_blockers(dyd_plan *plan, const dyd_engine *e, const dyd_coarse *c, bool ends, int64_t least,
                          const dyd_engine_options *o) {
  int64_t limit = ends ? least - 1 : INT64_MAX;
  for (int pass = ends ? 1 : 0; pass < 2; pass++) {
    for (size_t k = 0; k < c->sites.count; k++) {
      dyd_refinable *p = dyd_engine_find(e, c->sites.item[k]);
      if (!can_narrow(plan, p, o)) continue;
      int64_t relative = dyd_coarse_bits(c, p->site);
      if (pass == 0)
        limit = lesser(limit, relative);
      else if (relative <= limit)
        mark(plan, p, next_bits(p, relative, o), alone(DYD_REASON_BLOCKER, p), o);
    }
    if (pass == 0) limit = companions(limit);
  }
}

/* Marks all sites of a face whose pairs are not all known. */
static dyd_status plan_capped(dyd_plan *plan, const dyd_engine *e, size_t f, const dyd_engine_options *o) {
  dyd_index_list sites = {0};
  bool outer;
  dyd_status status = dyd_delaunay_face(&sites, &outer, e->pd, f);
  for (size_t k = 0; status >= 0 && k < sites.count; k++) {
    dyd_refinable *p = dyd_engine_find(e, sites.item[k]);
    if (can_narrow(plan, p, o)) mark(plan, p, grown(p->bits, o), alone(DYD_REASON_BLOCKER, p), o);
  }
  dyd_index_list_clear(&sites);
  return status;
}

static dyd_status plan_face(dyd_plan *plan, dyd_scouts *scouts, mpfr_ptr number, const dyd_engine *e, size_t f,
                            dyd_measure *m, const dyd_engine_options *o) {
  if (dyd_delaunay_is_capped(e->pd)) return plan_capped(plan, e, f, o);
  dyd_coarse c = {0};
  dyd_pair_list pairs = {0};
  dyd_status status = dyd_delaunay_face_pairs(&pairs, e->pd, f);
  if (status >= 0) status = keep_pairs(&pairs, number, m, o);
  if (status >= 0 && pairs.count) status = dyd_coarse_set(&c, e->pd, f, &pairs);
  if (status >= 0 && pairs.count) {
    int64_t least;
    bool ends = mark_ends(&least, plan, e, &c, &pairs, o);
    mark_blockers(plan, e, &c, ends, least, o);
    if (ends && scouts) status = dyd_scouts_add(scouts, e, &pairs);
  }
  dyd_coarse_clear(&c);
  dyd_pair_list_clear(&pairs);
  return status;
}

static dyd_status plan_faces(dyd_plan *plan, dyd_scouts *scouts, const dyd_engine *e, dyd_measure *m,
                             const dyd_engine_options *o) {
  dyd_status status = DYD_OK;
  size_t faces = dyd_delaunay_undecided_faces(e->pd);
  mpfr_t number;
  mpfr_init2(number, DYD_MEASURE_PREC);
  for (size_t f = 0; status >= 0 && f < faces; f++) status = plan_face(plan, scouts, number, e, f, m, o);
  mpfr_clear(number);
  return status;
}

/* ---- bounds ---- */

static dyd_status plan_hausdorff(dyd_plan *plan, dyd_scouts *scouts, const dyd_engine *e, dyd_measure *m,
                                 const dyd_engine_options *o) {
  dyd_status status = plan_faces(plan, scouts, e, m, o);
  mpfr_t diameter;
  mpfr_init2(diameter, DYD_MEASURE_PREC);
  for (size_t k = 0; status >= 0 && k < e->points; k++) {
    dyd_refinable *p = &e->point[k];
    if (p->final) continue;
    status = dyd_measure_diameter(diameter, m, p->site);
    if (mpfr_cmp_ui_2exp(diameter, 1, (mpfr_exp_t)-o->goal_bits) <= 0 || !can_narrow(plan, p, o)) continue;
    /* Widths of 2^-b give a diameter of at most sqrt(2) 2^-b. */
    mark(plan, p, p->bits <= o->goal_bits && !o->step_bits ? o->goal_bits + 1 : grown(p->bits, o),
         alone(DYD_REASON_BOUND, p), o);
  }
  mpfr_clear(diameter);
  return status;
}

/* What a pair contributes to a bound; infinite when it has to be refined before anything is known. */
typedef dyd_status (*number_fn)(mpfr_ptr out, dyd_engine *e, dyd_measure *m, const dyd_pair *pair,
                                const dyd_engine_options *o);

static dyd_status number_area(mpfr_ptr out, dyd_engine *e, dyd_measure *m, const dyd_pair *pair,
                              const dyd_engine_options *o) {
  (void)e, (void)o;
  return dyd_measure_area(out, m, pair->i, pair->j);
}

/* Marks the ends of pairs with a number above `least`, so that the numbers shrink below `share`;
 * *largest becomes the largest number of a pair with an end that can be narrowed. */
static dyd_status mark_bound(dyd_plan *plan, mpfr_ptr largest, dyd_engine *e, dyd_measure *m,
                             const dyd_pair_list *pairs, number_fn number, mpfr_srcptr least, mpfr_srcptr share,
                             const dyd_engine_options *o) {
  dyd_status status = DYD_OK;
  mpfr_t value;
  mpfr_init2(value, DYD_MEASURE_PREC);
  mpfr_set_zero(largest, 1);
  for (size_t k = 0; status >= 0 && k < pairs->count; k++) {
    const uint32_t end[2] = {pairs->item[k].i, pairs->item[k].j};
    status = number(value, e, m, &pairs->item[k], o);
    if (status < 0 || mpfr_zero_p(value)) continue;
    int64_t excess = mpfr_inf_p(value) ? 0 : (int64_t)mpfr_get_exp(value) - (int64_t)mpfr_get_exp(share) + 2;
    for (int a = 0; a < 2; a++) {
      dyd_refinable *p = dyd_engine_find(e, end[a]);
      if (!can_narrow(plan, p, o)) continue;
      mpfr_max(largest, largest, value, MPFR_RNDU);
      int64_t target = raised(p->bits, excess < 0 ? 0 : excess, o->max_bits), step = grown(p->bits, o);
      if (mpfr_cmp(value, least) > 0)
        mark(plan, p, target > step && !o->step_bits ? target : step, (cause){DYD_REASON_BOUND, end[0], end[1]}, o);
    }
  }
  mpfr_clear(value);
  return status;
}

/* The ends of the pairs whose numbers are above 2^-M, or above the share 2^-M / P of P pairs; where none of them can be
 * narrowed, those of at least half the largest number with an end that can. */
static dyd_status plan_bound(dyd_plan *plan, dyd_engine *e, dyd_measure *m, number_fn number, bool shared,
                             const dyd_engine_options *o) {
  dyd_pair_list pairs = {0};
  mpfr_t share, largest, unused;
  mpfr_inits2(DYD_MEASURE_PREC, share, largest, unused, (mpfr_ptr)0);
  dyd_status status = dyd_delaunay_pairs(&pairs, e->pd);
  if (status >= 0 && pairs.count) {
    mpfr_set_ui_2exp(share, 1, (mpfr_exp_t)-o->goal_bits, MPFR_RNDD);
    if (shared) mpfr_div_ui(share, share, (unsigned long)pairs.count, MPFR_RNDD);
    status = mark_bound(plan, largest, e, m, &pairs, number, share, share, o);
    if (status >= 0 && plan->marked == 0 && !mpfr_zero_p(largest)) {
      mpfr_div_2ui(largest, largest, 1, MPFR_RNDD);
      status = mark_bound(plan, unused, e, m, &pairs, number, largest, share, o);
    }
  }
  mpfr_clears(share, largest, unused, (mpfr_ptr)0);
  dyd_pair_list_clear(&pairs);
  return status;
}

/* Marks the ends of sure triangles whose Voronoi vertex may be in the window and is enclosed in more than 2^-M. */
static dyd_status plan_vertices(dyd_plan *plan, dyd_engine *e, const dyd_engine_options *o) {
  dyd_triangle_list list = {0};
  dyd_status status = dyd_delaunay_triangles(&list, e->pd);
  for (size_t k = 0; k < list.count && status >= 0; k++) {
    const uint32_t *v = list.item[k].v;
    int64_t excess;
    status = dyd_engine_vertex_excess(&excess, e, &list.item[k], o);
    for (int m = 0; m < 3 && status >= 0 && excess > 0; m++) {
      dyd_refinable *p = dyd_engine_find(e, v[m]);
      if (!can_narrow(plan, p, o)) continue;
      int64_t target = raised(p->bits, excess, o->max_bits), step = grown(p->bits, o);
      mark(plan, p, target > step && !o->step_bits ? target : step, (cause){DYD_REASON_BOUND, v[m], v[(m + 1) % 3]}, o);
    }
  }
  dyd_triangle_list_clear(&list);
  return status;
}

/* Replaces the marks by: every point to one precision, a step above the least so far. */
static void plan_uniform(dyd_plan *plan, dyd_engine *e, const dyd_engine_options *o) {
  int64_t least = INT64_MAX;
  for (size_t k = 0; k < e->points; k++) {
    e->point[k].marked = false;
    if (!e->point[k].final && e->point[k].bits < least) least = e->point[k].bits;
  }
  plan->marked = 0;
  int64_t level = grown(least, o) < o->max_bits ? grown(least, o) : o->max_bits;
  for (size_t k = 0; k < e->points; k++)
    if (!e->point[k].final && e->point[k].bits < level)
      mark(plan, &e->point[k], level, alone(DYD_REASON_UNIFORM, &e->point[k]), o);
}

/* Where the bound holds already only vertices are left to be narrowed. */
static dyd_status plan_voronoi(dyd_plan *plan, dyd_engine *e, dyd_measure *m, const dyd_engine_options *o) {
  dyd_status status = DYD_OK;
  if (e->sums) status = plan_bound(plan, e, m, dyd_engine_voronoi_number, o->goal == DYD_GOAL_VORONOI_AREA, o);
  if (status >= 0 && o->goal == DYD_GOAL_VORONOI_HAUSDORFF) status = plan_vertices(plan, e, o);
  return status;
}

dyd_status dyd_engine_plan(dyd_plan *out, dyd_scouts *scouts, dyd_engine *e, const dyd_engine_options *o) {
  dyd_measure m;
  dyd_status status;
  *out = (dyd_plan){0};
  if (o->step_bits || o->schedule != DYD_SCHEDULE_ADAPTIVE) scouts = NULL;
  dyd_measure_init(&m, e->sites);
  if (o->goal == DYD_GOAL_DECIDED || dyd_delaunay_is_capped(e->pd))
    status = plan_faces(out, scouts, e, NULL, o);
  else if (o->goal == DYD_GOAL_HAUSDORFF)
    status = plan_hausdorff(out, scouts, e, &m, o);
  else if (o->goal == DYD_GOAL_AREA)
    status = plan_bound(out, e, &m, number_area, true, o);
  else
    status = plan_voronoi(out, e, &m, o);
  dyd_measure_clear(&m);
  dyd_engine_voronoi_forget(e);
  if (status >= 0 && out->marked && o->schedule == DYD_SCHEDULE_UNIFORM) plan_uniform(out, e, o);
  return status;
}

/* ---- goals ---- */

static dyd_status bound_holds(bool *out, const dyd_engine *e, const dyd_engine_options *o) {
  dyd_pair_list pairs = {0};
  dyd_measure m;
  mpfr_t bound;
  dyd_measure_init(&m, e->sites);
  mpfr_init2(bound, DYD_MEASURE_PREC);
  dyd_status status = dyd_delaunay_pairs(&pairs, e->pd);
  if (status >= 0) {
    status = o->goal == DYD_GOAL_AREA ? dyd_bound_area(bound, &m, &pairs) : dyd_bound_hausdorff(bound, &m, &pairs);
    *out = status >= 0 && mpfr_cmp_ui_2exp(bound, 1, (mpfr_exp_t)-o->goal_bits) <= 0;
  }
  mpfr_clear(bound);
  dyd_measure_clear(&m);
  dyd_pair_list_clear(&pairs);
  return status;
}

/* The bound holds, and no vertex is left that is too wide and could be narrowed. */
static dyd_status voronoi_holds(bool *out, dyd_engine *e, const dyd_engine_options *o) {
  dyd_plan plan = {0};
  dyd_status status = dyd_engine_voronoi_holds(out, e, o);
  if (status != DYD_OK || !*out || o->goal != DYD_GOAL_VORONOI_HAUSDORFF) return status;
  status = plan_vertices(&plan, e, o);
  for (size_t k = 0; k < e->points; k++) e->point[k].marked = false;
  *out = status == DYD_OK && plan.marked == 0;
  return status;
}

dyd_status dyd_engine_goal_holds(bool *out, dyd_engine *e, const dyd_engine_options *o) {
  *out = false;
  if (dyd_delaunay_is_capped(e->pd)) return DYD_OK;
  if (dyd_goal_is_voronoi(o->goal)) return voronoi_holds(out, e, o);
  if (o->goal != DYD_GOAL_DECIDED) return bound_holds(out, e, o);
  size_t count[4];
  dyd_delaunay_count(count, e->pd);
  *out = count[DYD_INDETERMINATE] == 0 && count[DYD_TIE] == 0;
  return DYD_OK;
}
