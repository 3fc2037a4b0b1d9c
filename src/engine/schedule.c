/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which points to narrow next, and how far (mathematics: section 7).
 *
 * Towards "decided": in each undecided face, those ends of indeterminate pairs that are coarsest for their surroundings
 * (coarse.c); where no end can be narrowed further, the coarsest sites of the face, since a blocker may be what keeps a
 * pair open. Sites of the face that are no ends follow one step behind, so that a wide blocker is not left alone while
 * the ends are refined for nothing. Where pairs of a face are missing, since it met the cap or was postponed, all its
 * sites are refined.
 *
 * Pairs of which it is known that no refinement decides them (settle.c) count for nothing here.
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
 * Where a tie was tried and is none, it is known at which bit that showed (ties.c): all its points in the face go there
 * at once. In faces of many points a few go ahead of the others, to tell how far these must go (scout.c). Where points
 * have costs, dear ones wait for cheap ones (thrift.c).
 *
 * Every rule marks a point whenever one that matters can be narrowed, and every mark asks for more than before
 * (plan.c): the loop ends. */
#include "engine/schedule.h"
#include "delaunay/memory.h"
#include "delaunay/undecided.h"

#include "base/alloc.h"
#include "engine/coarse.h"
#include "engine/goal_voronoi.h"
#include "engine/points.h"
#include "metric/bounds.h"

/* Who goes ahead, and who waits. scouts NULL: nobody goes ahead. */
typedef struct dyd_helpers {
  dyd_scouts *scouts;
  dyd_thrift *thrift;
} dyd_helpers;

/* ---- undecided faces ---- */

/* The step of a point that lacks `excess` bits: at least as far as the next precision. */
static int64_t excess_step(const dyd_refinable *p, int64_t excess, const dyd_engine_options *o) {
  int64_t target = dyd_bits_raised(p->bits, excess < 0 ? 0 : excess, o->max_bits), step = dyd_bits_grown(p->bits, o);
  return target > step && !o->step_bits ? target : step;
}

/* Must the pair be refined? m = NULL: always; otherwise when its Hausdorff number is above the goal. */
static dyd_status pair_matters(bool *out, mpfr_ptr number, dyd_measure *m, const dyd_pair *pair,
                               const dyd_engine_options *o) {
  *out = pair->status == DYD_INDETERMINATE;
  if (!*out || !m) return DYD_OK;
  dyd_status st = dyd_bound_pair_hausdorff(number, m, pair);
  *out = st != DYD_OK || mpfr_cmp_ui_2exp(number, 1, (mpfr_exp_t)-o->goal_bits) > 0;
  return st;
}

/* Removes the pairs that need not be refined, or for which that is in vain. */
static dyd_status keep_pairs(dyd_pair_list *pairs, dyd_measure *m, const dyd_settled *settled,
                             const dyd_engine_options *o) {
  dyd_status st = DYD_OK;
  mpfr_t number;
  mpfr_init2(number, DYD_MEASURE_PREC);
  size_t kept = 0;
  for (size_t k = 0; st == DYD_OK && k < pairs->count; k++) {
    bool matters;
    st = pair_matters(&matters, number, m, &pairs->item[k], o);
    matters = matters && !dyd_is_settled(settled, &pairs->item[k]);
    if (st == DYD_OK && matters) pairs->item[kept++] = pairs->item[k];
  }
  pairs->count = kept;
  mpfr_clear(number);
  return st;
}

/* Sites known about as well as the least known one are refined with it: up to twice its bits. */
static int64_t companion_bits(int64_t least) {
  return least > INT64_MAX / 4 ? INT64_MAX : 2 * least + 2;
}

static int64_t lesser_bits(int64_t a, int64_t b) {
  return a < b ? a : b;
}

/* The step of a point that is known to `relative` bits of its distances: to twice as many, where these are few of its
 * bits. Where it meets a neighbour the distance is not known, and all of its bits are doubled. */
static int64_t relative_step(const dyd_refinable *p, int64_t relative, const dyd_engine_options *o) {
  if (o->step_bits || relative < 16 || relative > p->bits / 2) return dyd_bits_grown(p->bits, o);
  return dyd_bits_raised(p->bits, relative, o->max_bits);
}

/* Was a tie tried with the point, and is it known that it takes more bits to see that there is none (ties.c)? */
static bool lacks_needed(const dyd_refinable *p, const dyd_engine_options *o) {
  return lesser_bits(p->needed, o->max_bits) > p->bits && !o->step_bits && o->goal == DYD_GOAL_DECIDED;
}

/* Is that known of a site of the face? Then nobody has to be sent to learn it. */
static bool any_lacks_needed(const dyd_coarse *c, const dyd_plan *plan) {
  for (size_t k = 0; k < c->sites.count; k++) {
    const dyd_refinable *p = dyd_engine_find(plan->e, c->sites.item[k]);
    if (p && !p->final && lacks_needed(p, plan->o)) return true;
  }
  return false;
}

static int64_t face_step(const dyd_refinable *p, int64_t relative, const dyd_engine_options *o) {
  int64_t step = relative_step(p, relative, o);
  return lacks_needed(p, o) && p->needed > step ? p->needed : step;
}

/* The relative precision up to which ends are refined: beyond it they wait for the coarsest site of the face, which may
 * be what keeps their pairs open. */
static int64_t bits_worth(dyd_plan *plan, const dyd_coarse *c) {
  int64_t least = INT64_MAX;
  for (size_t k = 0; k < c->sites.count; k++)
    if (dyd_plan_can_narrow(plan, dyd_engine_find(plan->e, c->sites.item[k])))
      least = lesser_bits(least, dyd_coarse_bits(c, c->sites.item[k]));
  return least > INT64_MAX / 4 ? INT64_MAX : least + least / 2;
}

/* Marks the coarsest of the ends of pairs that can be narrowed, up to the precision `worth`; *least becomes their
 * relative precision. Returns false if no end can be narrowed. */
static bool mark_ends(int64_t *least, dyd_plan *plan, const dyd_coarse *c, const dyd_pair_list *pairs, int64_t worth) {
  bool any = false;
  *least = INT64_MAX;
  for (int pass = 0; pass < 2; pass++) {
    for (size_t k = 0; k < 2 * pairs->count; k++) {
      const dyd_pair *pair = &pairs->item[k / 2];
      const dyd_refinable *p = dyd_engine_find(plan->e, k % 2 ? pair->j : pair->i);
      if (!dyd_plan_can_narrow(plan, p)) continue;
      int64_t relative = dyd_coarse_bits(c, p->site);
      any = true;
      if (pass == 0)
        *least = lesser_bits(*least, relative);
      else if ((relative <= companion_bits(*least) && relative <= worth) || lacks_needed(p, plan->o))
        dyd_plan_mark(plan, p, face_step(p, relative, plan->o), DYD_REASON_END, pair->i, pair->j);
    }
  }
  return any;
}

/* Marks the sites of the face that are coarser than the ends; where no end can be narrowed, the coarsest of all. */
static void mark_blockers(dyd_plan *plan, const dyd_coarse *c, bool ends, int64_t least) {
  int64_t limit = ends ? least - 1 : INT64_MAX;
  for (int pass = ends ? 1 : 0; pass < 2; pass++) {
    for (size_t k = 0; k < c->sites.count; k++) {
      const dyd_refinable *p = dyd_engine_find(plan->e, c->sites.item[k]);
      if (!dyd_plan_can_narrow(plan, p)) continue;
      int64_t relative = dyd_coarse_bits(c, p->site);
      if (pass == 0)
        limit = lesser_bits(limit, relative);
      else if (relative <= limit || lacks_needed(p, plan->o))
        dyd_plan_mark_alone(plan, p, face_step(p, relative, plan->o), DYD_REASON_BLOCKER);
    }
    if (pass == 0) limit = companion_bits(limit);
  }
}

/* Marks all sites of a face whose pairs are not all known: to twice their bits, or to where a tie was seen to be none.
 * Nothing tells yet which of them are enough. Scouts need pairs that cross: each site with one half of the face on. */
static dyd_status plan_capped(dyd_plan *plan, dyd_helpers *h, size_t f) {
  dyd_index_list sites = {0};
  bool outer, lacks = false;
  dyd_status st = dyd_delaunay_face(&sites, &outer, plan->e->pd, f);
  dyd_pair_list across = {st == DYD_OK ? sites.count : 0, dyd_alloc(sites.count, sizeof *across.item)};
  if (!across.item) st = DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < sites.count; k++) {
    const dyd_refinable *p = dyd_engine_find(plan->e, sites.item[k]);
    across.item[k] = (dyd_pair){sites.item[k], sites.item[(k + sites.count / 2) % sites.count], DYD_INDETERMINATE};
    if (!dyd_plan_can_narrow(plan, p)) continue;
    int64_t bits = dyd_bits_grown(p->bits, plan->o);
    lacks = lacks || lacks_needed(p, plan->o);
    dyd_plan_mark_alone(plan, p, lacks_needed(p, plan->o) && p->needed > bits ? p->needed : bits, DYD_REASON_BLOCKER);
  }
  bool scouts = h->scouts && !lacks && dyd_open_is_postponed(plan->e->pd, f);
  if (st == DYD_OK && scouts) st = dyd_scouts_add(h->scouts, plan, &across);
  dyd_pair_list_clear(&across);
  dyd_index_list_clear(&sites);
  return st;
}

static dyd_status plan_face(dyd_plan *plan, dyd_helpers *h, size_t f, dyd_measure *m, const dyd_settled *settled) {
  const dyd_delaunay *pd = plan->e->pd;
  if (dyd_open_is_capped(pd, f)) return plan_capped(plan, h, f);
  dyd_coarse c = {0};
  dyd_pair_list pairs = {0};
  dyd_status st = dyd_delaunay_face_pairs(&pairs, pd, f);
  if (st == DYD_OK) st = keep_pairs(&pairs, m, settled, plan->o);
  if (st == DYD_OK && pairs.count) st = dyd_coarse_set(&c, pd, f, &pairs);
  if (st == DYD_OK && pairs.count) {
    int64_t least;
    dyd_plan *wants = dyd_thrift_face(h->thrift, plan);
    /* Where points have costs the coarsest may be dear, and wait themselves. */
    bool ends = mark_ends(&least, wants, &c, &pairs, h->thrift->waited ? INT64_MAX : bits_worth(plan, &c));
    mark_blockers(wants, &c, ends, least);
    dyd_thrift_choose(plan, h->thrift, &c.sites);
    if (ends && h->scouts && !any_lacks_needed(&c, plan)) st = dyd_scouts_add(h->scouts, plan, &pairs);
  }
  dyd_coarse_clear(&c);
  dyd_pair_list_clear(&pairs);
  return st;
}

static dyd_status plan_faces(dyd_plan *plan, dyd_helpers *h, dyd_measure *m, const dyd_settled *settled) {
  dyd_status st = DYD_OK;
  size_t faces = dyd_delaunay_undecided_faces(plan->e->pd);
  for (size_t f = 0; st == DYD_OK && f < faces; f++) st = plan_face(plan, h, f, m, settled);
  return st;
}

/* ---- bounds ---- */

static dyd_status plan_hausdorff(dyd_plan *plan, dyd_helpers *h, dyd_measure *m) {
  const dyd_settled none = {0}; /* a pair that stays indeterminate may still come below the bound */
  const dyd_engine *e = plan->e;
  const dyd_engine_options *o = plan->o;
  dyd_status st = plan_faces(plan, h, m, &none);
  mpfr_t diameter;
  mpfr_init2(diameter, DYD_MEASURE_PREC);
  for (size_t k = 0; st == DYD_OK && k < e->points; k++) {
    const dyd_refinable *p = &e->point[k];
    if (p->final) continue;
    st = dyd_measure_diameter(diameter, m, p->site);
    if (mpfr_cmp_ui_2exp(diameter, 1, (mpfr_exp_t)-o->goal_bits) <= 0 || !dyd_plan_can_narrow(plan, p)) continue;
    /* Widths of 2^-b give a diameter of at most sqrt(2) 2^-b. */
    dyd_plan_mark_alone(plan, p,
                        p->bits <= o->goal_bits && !o->step_bits ? o->goal_bits + 1 : dyd_bits_grown(p->bits, plan->o),
                        DYD_REASON_BOUND);
  }
  mpfr_clear(diameter);
  return st;
}

/* What a pair contributes to the bound; infinite when it has to be refined before anything is known. */
static dyd_status pair_number(mpfr_ptr out, dyd_measure *m, dyd_voronoi_sums *sums, const dyd_pair *pair,
                              const dyd_engine_options *o) {
  return sums ? dyd_goal_voronoi_number(out, sums, m, pair, o) : dyd_measure_area(out, m, pair->i, pair->j);
}

/* Marks the ends of pairs with a number above `least`, so that the numbers shrink below `share`;
 * *largest becomes the largest number of a pair with an end that can be narrowed. */
static dyd_status mark_bound(dyd_plan *plan, mpfr_ptr largest, dyd_measure *m, dyd_voronoi_sums *sums,
                             const dyd_pair_list *pairs, mpfr_srcptr least, mpfr_srcptr share) {
  const dyd_engine_options *o = plan->o;
  dyd_status st = DYD_OK;
  mpfr_t value;
  mpfr_init2(value, DYD_MEASURE_PREC);
  mpfr_set_zero(largest, 1);
  for (size_t k = 0; st == DYD_OK && k < pairs->count; k++) {
    const uint32_t end[2] = {pairs->item[k].i, pairs->item[k].j};
    st = pair_number(value, m, sums, &pairs->item[k], o);
    if (st != DYD_OK || mpfr_zero_p(value)) continue;
    int64_t excess = mpfr_inf_p(value) ? 0 : (int64_t)mpfr_get_exp(value) - (int64_t)mpfr_get_exp(share) + 2;
    for (int a = 0; a < 2; a++) {
      const dyd_refinable *p = dyd_engine_find(plan->e, end[a]);
      if (!dyd_plan_can_narrow(plan, p)) continue;
      mpfr_max(largest, largest, value, MPFR_RNDU);
      if (mpfr_cmp(value, least) > 0)
        dyd_plan_mark(plan, p, excess_step(p, excess, o), DYD_REASON_BOUND, end[0], end[1]);
    }
  }
  mpfr_clear(value);
  return st;
}

/* The ends of the pairs whose numbers are above 2^-M, or above the share 2^-M / P of P pairs; where none of them can be
 * narrowed, those of at least half the largest number with an end that can. */
static dyd_status plan_bound(dyd_plan *plan, dyd_measure *m, dyd_voronoi_sums *sums, bool shared) {
  dyd_pair_list pairs = {0};
  mpfr_t share, largest, unused;
  mpfr_inits2(DYD_MEASURE_PREC, share, largest, unused, (mpfr_ptr)0);
  dyd_status st = dyd_pairs_list(&pairs, plan->e->pd, DYD_TIE);
  if (st == DYD_OK && pairs.count) {
    mpfr_set_ui_2exp(share, 1, (mpfr_exp_t)-plan->o->goal_bits, MPFR_RNDD);
    if (shared) mpfr_div_ui(share, share, (unsigned long)pairs.count, MPFR_RNDD);
    st = mark_bound(plan, largest, m, sums, &pairs, share, share);
    if (st == DYD_OK && plan->count == 0 && !mpfr_zero_p(largest)) {
      mpfr_div_2ui(largest, largest, 1, MPFR_RNDD);
      st = mark_bound(plan, unused, m, sums, &pairs, largest, share);
    }
  }
  mpfr_clears(share, largest, unused, (mpfr_ptr)0);
  dyd_pair_list_clear(&pairs);
  return st;
}

/* Marks the ends of sure triangles whose Voronoi vertex may be in the window and is enclosed in more than 2^-M. */
static dyd_status plan_vertices(dyd_plan *plan) {
  const dyd_engine_options *o = plan->o;
  dyd_triangle_list list = {0};
  dyd_status st = dyd_delaunay_triangles(&list, plan->e->pd);
  for (size_t k = 0; k < list.count && st == DYD_OK; k++) {
    const uint32_t *v = list.item[k].v;
    int64_t excess;
    st = dyd_goal_vertex_excess(&excess, plan->e, &list.item[k], o);
    for (int m = 0; m < 3 && st == DYD_OK && excess > 0; m++) {
      const dyd_refinable *p = dyd_engine_find(plan->e, v[m]);
      if (dyd_plan_can_narrow(plan, p))
        dyd_plan_mark(plan, p, excess_step(p, excess, o), DYD_REASON_BOUND, v[m], v[(m + 1) % 3]);
    }
  }
  dyd_triangle_list_clear(&list);
  return st;
}

/* Replaces the marks by: every point to one precision, a step above the least so far. */
static void plan_uniform(dyd_plan *plan) {
  const dyd_engine *e = plan->e;
  int64_t least = INT64_MAX;
  for (size_t k = 0; k < e->points; k++)
    if (!e->point[k].final && e->point[k].bits < least) least = e->point[k].bits;
  dyd_plan_empty(plan);
  int64_t level = lesser_bits(dyd_bits_grown(least, plan->o), plan->o->max_bits);
  for (size_t k = 0; k < e->points; k++)
    if (!e->point[k].final && e->point[k].bits < level)
      dyd_plan_mark_alone(plan, &e->point[k], level, DYD_REASON_UNIFORM);
}

static dyd_status plan_decided(dyd_plan *plan, dyd_helpers *h, dyd_settled *settled) {
  dyd_status st = dyd_delaunay_is_capped(plan->e->pd) ? DYD_OK : dyd_settle(settled, plan);
  return st == DYD_OK ? plan_faces(plan, h, NULL, settled) : st;
}

static dyd_status plan_all(dyd_plan *plan, dyd_helpers *h, dyd_settled *settled, dyd_measure *m,
                           dyd_voronoi_sums *sums) {
  const dyd_engine_options *o = plan->o;
  if (o->step_bits || o->schedule != DYD_SCHEDULE_ADAPTIVE || h->thrift->waited) h->scouts = NULL;
  if (o->goal == DYD_GOAL_DECIDED || dyd_delaunay_is_capped(plan->e->pd)) return plan_decided(plan, h, settled);
  if (o->goal == DYD_GOAL_HAUSDORFF) return plan_hausdorff(plan, h, m);
  if (o->goal == DYD_GOAL_AREA) return plan_bound(plan, m, NULL, true);
  /* Where the bound on the diagram holds already, and sums are not kept, only vertices are left to be narrowed. */
  dyd_status st = sums ? plan_bound(plan, m, sums, o->goal == DYD_GOAL_VORONOI_AREA) : DYD_OK;
  if (st == DYD_OK && o->goal == DYD_GOAL_VORONOI_HAUSDORFF) st = plan_vertices(plan);
  return st;
}

/* ---- goals ---- */

static dyd_status goal_bound_holds(bool *out, dyd_measure *m, const dyd_engine *e, const dyd_engine_options *o) {
  dyd_pair_list pairs = {0};
  mpfr_t bound;
  mpfr_init2(bound, DYD_MEASURE_PREC);
  dyd_status st = dyd_pairs_list(&pairs, e->pd, DYD_TIE);
  if (st == DYD_OK)
    st = o->goal == DYD_GOAL_AREA ? dyd_bound_area(bound, m, &pairs) : dyd_bound_hausdorff(bound, m, &pairs);
  *out = st == DYD_OK && mpfr_cmp_ui_2exp(bound, 1, (mpfr_exp_t)-o->goal_bits) <= 0;
  mpfr_clear(bound);
  dyd_pair_list_clear(&pairs);
  return st;
}

/* The bound holds, and no vertex is left that is too wide and could be narrowed. */
static dyd_status goal_voronoi_and_vertices_hold(bool *out, dyd_voronoi_sums **sums, const dyd_engine *e,
                                                 const dyd_engine_options *o) {
  dyd_status st = dyd_goal_voronoi_holds(out, sums, e, o);
  if (st != DYD_OK || !*out || o->goal != DYD_GOAL_VORONOI_HAUSDORFF) return st;
  dyd_plan plan;
  dyd_plan_init(&plan, e, o, NULL, 0);
  st = plan_vertices(&plan);
  if (st == DYD_OK) st = plan.failed;
  *out = st == DYD_OK && plan.count == 0;
  dyd_plan_clear(&plan);
  return st;
}

static dyd_status goal_holds(bool *out, dyd_measure *m, dyd_voronoi_sums **sums, const dyd_engine *e,
                             const dyd_engine_options *o) {
  *out = false;
  if (dyd_delaunay_is_capped(e->pd)) return DYD_OK;
  if (dyd_goal_is_voronoi(o->goal)) return goal_voronoi_and_vertices_hold(out, sums, e, o);
  if (o->goal != DYD_GOAL_DECIDED) return goal_bound_holds(out, m, e, o);
  size_t count[4];
  dyd_delaunay_count(count, e->pd);
  *out = count[DYD_INDETERMINATE] == 0 && count[DYD_TIE] == 0;
  return DYD_OK;
}

/* Else a plan is empty, whatever the goal. */
static bool any_point_is_left(const dyd_engine *e) {
  for (size_t k = 0; k < e->points; k++)
    if (!e->point[k].final) return true;
  return false;
}

dyd_status dyd_schedule_judge(bool *holds, dyd_plan *plan, dyd_scouts *scouts, dyd_thrift *thrift,
                              dyd_settled *settled) {
  dyd_helpers h = {scouts, thrift};
  dyd_measure m;
  dyd_voronoi_sums *sums = NULL;
  dyd_measure_init(&m, plan->e->sites);
  dyd_status st = goal_holds(holds, &m, &sums, plan->e, plan->o);
  if (st == DYD_OK && !*holds && any_point_is_left(plan->e)) st = plan_all(plan, &h, settled, &m, sums);
  if (st == DYD_OK) st = plan->failed;
  if (st == DYD_OK && plan->count && plan->o->schedule == DYD_SCHEDULE_UNIFORM) plan_uniform(plan);
  dyd_goal_sums_free(&sums);
  dyd_measure_clear(&m);
  return st;
}
