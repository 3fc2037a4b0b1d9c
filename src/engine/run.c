/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A run: the question whether its goal holds. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "delaunay/undecided.h"
#include "engine/ask.h"
#include "engine/labels.h"
#include "engine/points.h"
#include "engine/probe.h"
#include "engine/record.h"
#include "engine/settle.h"
#include "engine/state.h"
#include "engine/ties.h"
#include "engine/wants.h"
#include "metric/bounds.h"
#include "rect/rect.h"

#include <dyadel/compose.h>
#include <dyadel/io.h>
#include <dyadel/metric.h>

#include <math.h>
#include <stdlib.h>

/* ---- goals on the Voronoi diagram: whether they hold, and the contribution of each pair ----
 *
 * The bounds themselves are certified (metric/bounds.c). The numbers of pairs that steer the refinement need no
 * proof: for the Hausdorff bound they are widths of strips, or, below the goal, the very terms it is the maximum of;
 * for the area, four times that term (the width of the strip in which the pair is undecided, twice over) times the
 * smaller reach of the two cells (half its length). Where all numbers together stay below the goal and the area does
 * not, it is the flattening of the polygons that costs, and they are made finer. */

enum { FINER = 8, MOST_FINER = 64 };

static void goal_sums_free(dyd_voronoi_sums **sums) {
  if (!*sums) return;
  dyd_voronoi_sums_clear(*sums);
  free(*sums);
  *sums = NULL;
}

/* Returns true if a window is given, with positive area and dyadic ends. */
static bool goal_window_is_good(const dyd_rect *window) {
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
  goal_sums_free(sums);
  *sums = malloc(sizeof **sums);
  if (!*sums) return DYD_E_NOMEM;
  dyd_status st = dyd_voronoi_sums_init(*sums, e->pd, o->window, bits);
  (*sums)->most = goal_most(o);
  (*sums)->discs = o->discs;
  (*sums)->cancel = &e->stop;
  if (st == DYD_OK) st = dyd_voronoi_sums_all(*sums, NULL, NULL);
  if (e->memory && (*sums)->memory.refused) {
    dyd_memory_join(e->memory, &(*sums)->memory);
    e->memory->wanted += e->memory->beside;
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

/* What a pair contributes to the bound; infinite when its rectangles meet, unless that does no harm to the goal. */
static dyd_status goal_voronoi_number(mpfr_ptr out, dyd_voronoi_sums *sums, dyd_measure *m, const dyd_pair *pair,
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
    st = goal_voronoi_number(one, sums, &m, &pairs->item[k], o);
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

/* Sets *out to whether the goal, one of these two, holds. If it does not, *sums, NULL before, keeps the sums found, for
 * the wants; freed by goal_sums_free, whatever is returned. */
static dyd_status goal_voronoi_holds(bool *out, dyd_voronoi_sums **sums, const dyd_engine *e,
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
  if (*out || st != DYD_OK) goal_sums_free(sums);
  return st;
}

/* ---- vertices ---- */

static dyd_status goal_vertex_excess(int64_t *out, const dyd_engine *e, const dyd_triangle *t,
                                     const dyd_engine_options *o) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_voronoi_vertex(&r, e->pd, t, o->goal_bits + 2);
  int64_t bits = dyd_rect_bits(&r);
  *out = st != DYD_OK || bits >= o->goal_bits || !dyd_rect_meets(&r, o->window) ? 0 : o->goal_bits - bits;
  return st;
}

/* Of the points that a face wants narrower, the ones that cost at most EXPENSIVE times as much as the cheapest are
 * asked; the others wait, since the cheap ones may decide the face without them. A point waits until the amount spent
 * on the others equals its cost: so waiting at most doubles the total cost. It then goes at once to the finest
 * precision of the face: the bits of one call cost nothing, and it need not take the steps of the others.
 *
 * The cheapest never wait, so nothing is wanted only where that was so before. Like all of the schedule this only
 * chooses what to narrow. */

enum { EXPENSIVE = 2 };

/* Which points wait, kept from judgement to judgement of a run. Init with waiting_init. waited: of each point of the
 * engine, the amount spent on others of its faces while it waited; NULL: all points cost the same, and none waits.
 */
typedef struct dyd_waiting {
  double *waited;
  dyd_wants face; /* the wants of one face */
} dyd_waiting;

static double waiting_cost(const dyd_wants *p, uint32_t site) {
  return p->o->cost ? p->o->cost[site] : dyd_engine_number(p->e, site, DYD_ROW_COST);
}

/* Returns true if every cost is a number above 0. */
static bool waiting_costs_are_good(const dyd_engine *e, const dyd_engine_options *o) {
  size_t n = o->cost ? dyd_engine_count(e) : 0, k = 0;
  while (k < n && o->cost[k] > 0 && o->cost[k] < HUGE_VAL) k++;
  return k == n;
}

/* Borrows e and o, which has costs that are above 0, or none. DYD_E_NOMEM. */
static dyd_status waiting_init(dyd_waiting *t, const dyd_engine *e, const dyd_engine_options *o) {
  *t = (dyd_waiting){.waited = NULL};
  dyd_wants_init(&t->face, e, o, NULL, 0);
  bool differ = false;
  for (size_t k = 1; k < e->points && !differ; k++)
    differ = waiting_cost(&t->face, e->point[k].site) != waiting_cost(&t->face, e->point[0].site);
  if (differ) t->waited = calloc(e->points, sizeof *t->waited);
  return t->face.failed == DYD_OK && !t->waited == !differ ? DYD_OK : DYD_E_NOMEM;
}

static void waiting_clear(dyd_waiting *t) {
  dyd_wants_clear(&t->face);
  free(t->waited);
  *t = (dyd_waiting){.waited = NULL};
}

/* The finest precision that one of the sites was asked for. */
static int64_t waiting_finest(const dyd_engine *e, const dyd_index_list *sites) {
  int64_t finest = INT64_MIN;
  for (size_t k = 0; k < sites->count; k++) {
    const dyd_refinable *p = dyd_engine_find(e, sites->item[k]);
    if (p && p->asked && p->bits > finest) finest = p->bits;
  }
  return finest;
}

/* Returns the least cost of a want of the face. *spent: the total cost of the wants that are not expensive. */
static double waiting_least(double *spent, const dyd_wants *face) {
  double least = HUGE_VAL;
  for (size_t k = 0; k < face->count; k++)
    least = fmin(least, waiting_cost(face, dyd_wants_point(face, &face->item[k])->site));
  *spent = 0;
  for (size_t k = 0; k < face->count; k++) {
    double cost = waiting_cost(face, dyd_wants_point(face, &face->item[k])->site);
    if (cost <= EXPENSIVE * least) *spent += cost;
  }
  return least;
}

/* The wants of the face with these sites go to *wants, but for wants that wait. */
static void waiting_choose(dyd_wants *wants, dyd_waiting *t, const dyd_index_list *sites) {
  dyd_wants *face = &t->face;
  double spent, least = waiting_least(&spent, face);
  if (!t->waited) return;
  for (size_t k = 0; k < face->count; k++) {
    const dyd_want *w = &face->item[k];
    const dyd_refinable *p = dyd_wants_point(face, w);
    double cost = waiting_cost(face, p->site), *waited = &t->waited[p - wants->e->point];
    if (cost > EXPENSIVE * least && *waited < cost) {
      *waited += spent;
      continue;
    }
    int64_t finest = *waited > 0 && !wants->o->step_bits ? waiting_finest(wants->e, sites) : w->bits;
    dyd_wants_mark(wants, p, finest > w->bits ? finest : w->bits, w->reason, w->i, w->j);
    *waited = 0;
  }
  if (face->failed) wants->failed = face->failed;
  wants->blocked = wants->blocked || face->blocked;
  dyd_wants_empty(face);
}

/* Which points to narrow next, and how far (mathematics: section 7).
 *
 * Towards "decided": in each undecided face, those ends of indeterminate pairs that are coarsest for their surroundings
 * (dyd_face_precision); where no end can be narrowed further, the coarsest sites of the face, since a blocker may be
 * what keeps a pair open. Sites of the face that are no ends follow one step behind, so that a wide blocker is not left
 * alone while the ends are refined for nothing. Where pairs of a face are missing, since it met the cap or was
 * postponed, all its sites are refined.
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
 * Towards bounds on the Voronoi diagram the same is done with other numbers of the pairs (above).
 *
 * Where a tie was tried and is none, it is known at which bit that showed (ties.c): all its points in the face go there
 * at once. In faces of many points a few go ahead of the others, to find how far these must go (probe.c). Where points
 * have costs, expensive ones wait for cheap ones (dyd_waiting).
 *
 * Every rule marks a point whenever one that matters can be narrowed, and every mark asks for more than before
 * (wants.c): the loop ends. */

/* Sites that go ahead, and sites that wait. probes NULL: none goes ahead. */
typedef struct dyd_helpers {
  dyd_probes *probes;
  dyd_waiting *waiting;
} dyd_helpers;

/* ---- undecided faces ---- */

/* The step of a point that lacks `excess` bits: at least as far as the next precision. */
static int64_t excess_step(const dyd_refinable *p, int64_t excess, const dyd_engine_options *o) {
  int64_t target = dyd_bits_raised(p->bits, excess < 0 ? 0 : excess, o->max_bits), step = dyd_bits_grown(p->bits, o);
  return target > step && !o->step_bits ? target : step;
}

/* Sets *out to whether the pair must be refined. m = NULL: always; otherwise when its Hausdorff number is above the
 * goal. */
static dyd_status pair_matters(bool *out, mpfr_ptr number, dyd_measure *m, const dyd_pair *pair,
                               const dyd_engine_options *o) {
  *out = pair->status == DYD_INDETERMINATE;
  if (!*out || !m) return DYD_OK;
  dyd_status st = dyd_bound_pair_hausdorff(number, m, pair);
  *out = st != DYD_OK || mpfr_cmp_ui_2exp(number, 1, (mpfr_exp_t)-o->goal_bits) > 0;
  return st;
}

/* Removes the pairs that need not be refined, or for which that is useless. */
static dyd_status keep_pairs(dyd_pair_list *pairs, dyd_measure *m, const dyd_settled *settled,
                             const dyd_engine_options *o) {
  dyd_status st = DYD_OK;
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, number);
  size_t kept = 0;
  for (size_t k = 0; st == DYD_OK && k < pairs->count; k++) {
    bool matters;
    st = pair_matters(&matters, number, m, &pairs->item[k], o);
    matters = matters && !dyd_is_settled(settled, &pairs->item[k]);
    if (st == DYD_OK && matters) pairs->item[kept++] = pairs->item[k];
  }
  pairs->count = kept;
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

/* Returns true if a tie with the point was tried, and more bits are needed to show that it does not tie (ties.c). */
static bool lacks_needed(const dyd_refinable *p, const dyd_engine_options *o) {
  return lesser_bits(p->needed, o->max_bits) > p->bits && !o->step_bits && o->goal == DYD_GOAL_DECIDED;
}

/* Returns true if that is known of a site of the face. Then no probe has to be sent to learn it. */
static bool any_lacks_needed(const dyd_face_precision *c, const dyd_wants *wants) {
  for (size_t k = 0; k < c->sites.count; k++) {
    const dyd_refinable *p = dyd_engine_find(wants->e, c->sites.item[k]);
    if (p && !p->final && lacks_needed(p, wants->o)) return true;
  }
  return false;
}

static int64_t face_step(const dyd_refinable *p, int64_t relative, const dyd_engine_options *o) {
  int64_t step = relative_step(p, relative, o);
  return lacks_needed(p, o) && p->needed > step ? p->needed : step;
}

/* The relative precision up to which ends are refined: beyond it they wait for the coarsest site of the face, which may
 * be what keeps their pairs open. */
static int64_t bits_worth(dyd_wants *wants, const dyd_face_precision *c) {
  int64_t least = INT64_MAX;
  for (size_t k = 0; k < c->sites.count; k++)
    if (dyd_wants_can_narrow(wants, dyd_engine_find(wants->e, c->sites.item[k])))
      least = lesser_bits(least, dyd_face_precision_bits(c, c->sites.item[k]));
  return least > INT64_MAX / 4 ? INT64_MAX : least + least / 2;
}

/* Marks the coarsest of the ends of pairs that can be narrowed, up to the precision `worth`; *least becomes their
 * relative precision. Returns false if no end can be narrowed. */
static bool mark_ends(int64_t *least, dyd_wants *wants, const dyd_face_precision *c, const dyd_pair_list *pairs,
                      int64_t worth) {
  bool any = false;
  *least = INT64_MAX;
  for (int pass = 0; pass < 2; pass++) {
    for (size_t k = 0; k < 2 * pairs->count; k++) {
      const dyd_pair *pair = &pairs->item[k / 2];
      const dyd_refinable *p = dyd_engine_find(wants->e, k % 2 ? pair->j : pair->i);
      if (!dyd_wants_can_narrow(wants, p)) continue;
      int64_t relative = dyd_face_precision_bits(c, p->site);
      any = true;
      if (pass == 0)
        *least = lesser_bits(*least, relative);
      else if ((relative <= companion_bits(*least) && relative <= worth) || lacks_needed(p, wants->o))
        dyd_wants_mark(wants, p, face_step(p, relative, wants->o), DYD_REASON_END, pair->i, pair->j);
    }
  }
  return any;
}

/* Marks the sites of the face that are coarser than the ends; where no end can be narrowed, the coarsest of all. */
static void mark_blockers(dyd_wants *wants, const dyd_face_precision *c, bool ends, int64_t least) {
  int64_t limit = ends ? least - 1 : INT64_MAX;
  for (int pass = ends ? 1 : 0; pass < 2; pass++) {
    for (size_t k = 0; k < c->sites.count; k++) {
      const dyd_refinable *p = dyd_engine_find(wants->e, c->sites.item[k]);
      if (!dyd_wants_can_narrow(wants, p)) continue;
      int64_t relative = dyd_face_precision_bits(c, p->site);
      if (pass == 0)
        limit = lesser_bits(limit, relative);
      else if (relative <= limit || lacks_needed(p, wants->o))
        dyd_wants_mark_alone(wants, p, face_step(p, relative, wants->o), DYD_REASON_BLOCKER);
    }
    if (pass == 0) limit = companion_bits(limit);
  }
}

/* Marks all sites of a face whose pairs are not all known: to twice their bits, or to where a tie was seen to be none.
 * Which of them suffice is not known yet. Probes need pairs that cross: each site with one half of the face on. */
static dyd_status want_capped(dyd_wants *wants, dyd_helpers *h, size_t f) {
  DYD_SCOPED(dyd_index_list) sites = {0};
  bool outer, lacks = false;
  dyd_status st = dyd_delaunay_face(&sites, &outer, wants->e->pd, f);
  DYD_SCOPED(dyd_pair_list) across = {st == DYD_OK ? sites.count : 0, dyd_alloc(sites.count, sizeof *across.item)};
  if (!across.item) st = DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < sites.count; k++) {
    const dyd_refinable *p = dyd_engine_find(wants->e, sites.item[k]);
    across.item[k] = (dyd_pair){sites.item[k], sites.item[(k + sites.count / 2) % sites.count], DYD_INDETERMINATE};
    if (!dyd_wants_can_narrow(wants, p)) continue;
    int64_t bits = dyd_bits_grown(p->bits, wants->o);
    lacks = lacks || lacks_needed(p, wants->o);
    dyd_wants_mark_alone(wants, p, lacks_needed(p, wants->o) && p->needed > bits ? p->needed : bits,
                         DYD_REASON_BLOCKER);
  }
  bool probes = h->probes && !lacks && dyd_open_is_postponed(wants->e->pd, f);
  if (st == DYD_OK && probes) st = dyd_probes_add(h->probes, wants, &across);
  return st;
}

static dyd_status want_face(dyd_wants *wants, dyd_helpers *h, size_t f, dyd_measure *m, const dyd_settled *settled) {
  const dyd_delaunay *pd = wants->e->pd;
  if (dyd_open_is_capped(pd, f)) return want_capped(wants, h, f);
  DYD_SCOPED(dyd_face_precision) c = {0};
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = dyd_delaunay_face_pairs(&pairs, pd, f);
  if (st == DYD_OK) st = keep_pairs(&pairs, m, settled, wants->o);
  if (st == DYD_OK && pairs.count) st = dyd_face_precision_set(&c, pd, f, &pairs);
  if (st == DYD_OK && pairs.count) {
    int64_t least;
    dyd_wants *into =
        h->waiting->waited ? &h->waiting->face : wants; /* of the face; where none waits all go to one list */
    /* Where points have costs the coarsest may be expensive, and wait themselves. */
    bool ends = mark_ends(&least, into, &c, &pairs, h->waiting->waited ? INT64_MAX : bits_worth(wants, &c));
    mark_blockers(into, &c, ends, least);
    waiting_choose(wants, h->waiting, &c.sites);
    if (ends && h->probes && !any_lacks_needed(&c, wants)) st = dyd_probes_add(h->probes, wants, &pairs);
  }
  return st;
}

static dyd_status want_faces(dyd_wants *wants, dyd_helpers *h, dyd_measure *m, const dyd_settled *settled) {
  dyd_status st = DYD_OK;
  size_t faces = dyd_delaunay_undecided_faces(wants->e->pd);
  for (size_t f = 0; st == DYD_OK && f < faces; f++) st = want_face(wants, h, f, m, settled);
  return st;
}

/* ---- bounds ---- */

static dyd_status want_hausdorff(dyd_wants *wants, dyd_helpers *h, dyd_measure *m) {
  const dyd_settled none = {0}; /* a pair that stays indeterminate may still come below the bound */
  const dyd_engine *e = wants->e;
  const dyd_engine_options *o = wants->o;
  dyd_status st = want_faces(wants, h, m, &none);
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, diameter);
  for (size_t k = 0; st == DYD_OK && k < e->points; k++) {
    const dyd_refinable *p = &e->point[k];
    if (p->final) continue;
    st = dyd_measure_diameter(diameter, m, p->site);
    if (mpfr_cmp_ui_2exp(diameter, 1, (mpfr_exp_t)-o->goal_bits) <= 0 || !dyd_wants_can_narrow(wants, p)) continue;
    /* Widths of 2^-b give a diameter of at most sqrt(2) 2^-b. */
    dyd_wants_mark_alone(
        wants, p, p->bits <= o->goal_bits && !o->step_bits ? o->goal_bits + 1 : dyd_bits_grown(p->bits, wants->o),
        DYD_REASON_BOUND);
  }
  return st;
}

/* Marks the ends of pairs with a number above `least`, so that the numbers shrink below `share`;
 * *largest becomes the largest number of a pair with an end that can be narrowed. */
static dyd_status mark_bound(dyd_wants *wants, mpfr_ptr largest, dyd_measure *m, dyd_voronoi_sums *sums,
                             const dyd_pair_list *pairs, mpfr_srcptr least, mpfr_srcptr share) {
  const dyd_engine_options *o = wants->o;
  dyd_status st = DYD_OK;
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, value);
  mpfr_set_zero(largest, 1);
  for (size_t k = 0; st == DYD_OK && k < pairs->count; k++) {
    const uint32_t end[2] = {pairs->item[k].i, pairs->item[k].j};
    /* infinite: it has to be refined before anything is known */
    st = sums ? goal_voronoi_number(value, sums, m, &pairs->item[k], o) : dyd_measure_area(value, m, end[0], end[1]);
    if (st != DYD_OK || mpfr_zero_p(value)) continue;
    int64_t excess = mpfr_inf_p(value) ? 0 : (int64_t)mpfr_get_exp(value) - (int64_t)mpfr_get_exp(share) + 2;
    for (int a = 0; a < 2; a++) {
      const dyd_refinable *p = dyd_engine_find(wants->e, end[a]);
      if (!dyd_wants_can_narrow(wants, p)) continue;
      mpfr_max(largest, largest, value, MPFR_RNDU);
      if (mpfr_cmp(value, least) > 0)
        dyd_wants_mark(wants, p, excess_step(p, excess, o), DYD_REASON_BOUND, end[0], end[1]);
    }
  }
  return st;
}

/* The ends of the pairs whose numbers are above 2^-M, or above the share 2^-M / P of P pairs; where none of them can be
 * narrowed, those of at least half the largest number with an end that can. */
static dyd_status want_bound(dyd_wants *wants, dyd_measure *m, dyd_voronoi_sums *sums, bool shared) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, share, largest, unused);
  dyd_status st = dyd_pairs_list(&pairs, wants->e->pd, sums ? dyd_least_bounding_true(wants->e->pd) : DYD_TIE);
  if (st == DYD_OK && pairs.count) {
    mpfr_set_ui_2exp(share, 1, (mpfr_exp_t)-wants->o->goal_bits, MPFR_RNDD);
    if (shared) mpfr_div_ui(share, share, (unsigned long)pairs.count, MPFR_RNDD);
    st = mark_bound(wants, largest, m, sums, &pairs, share, share);
    if (st == DYD_OK && wants->count == 0 && !mpfr_zero_p(largest)) {
      mpfr_div_2ui(largest, largest, 1, MPFR_RNDD);
      st = mark_bound(wants, unused, m, sums, &pairs, largest, share);
    }
  }
  return st;
}

/* Marks the ends of certain triangles whose Voronoi vertex may be in the window and is enclosed in more than 2^-M. */
static dyd_status want_vertices(dyd_wants *wants) {
  const dyd_engine_options *o = wants->o;
  DYD_SCOPED(dyd_triangle_list) list = {0};
  dyd_status st = dyd_delaunay_triangles(&list, NULL, wants->e->pd, 0);
  for (size_t k = 0; k < list.count && st == DYD_OK; k++) {
    const uint32_t *v = list.item[k].v;
    int64_t excess;
    st = goal_vertex_excess(&excess, wants->e, &list.item[k], o);
    for (int m = 0; m < 3 && st == DYD_OK && excess > 0; m++) {
      const dyd_refinable *p = dyd_engine_find(wants->e, v[m]);
      if (dyd_wants_can_narrow(wants, p))
        dyd_wants_mark(wants, p, excess_step(p, excess, o), DYD_REASON_BOUND, v[m], v[(m + 1) % 3]);
    }
  }
  return st;
}

/* Replaces the marks by: every point to one precision, a step above the least so far. */
static void want_uniform(dyd_wants *wants) {
  const dyd_engine *e = wants->e;
  int64_t least = INT64_MAX;
  for (size_t k = 0; k < e->points; k++)
    if (!e->point[k].final && e->point[k].bits < least) least = e->point[k].bits;
  dyd_wants_empty(wants);
  int64_t level = lesser_bits(dyd_bits_grown(least, wants->o), wants->o->max_bits);
  for (size_t k = 0; k < e->points; k++)
    if (!e->point[k].final && e->point[k].bits < level)
      dyd_wants_mark_alone(wants, &e->point[k], level, DYD_REASON_UNIFORM);
}

static dyd_status want_all(dyd_wants *wants, dyd_helpers *h, dyd_settled *settled, dyd_measure *m,
                           dyd_voronoi_sums *sums) {
  const dyd_engine_options *o = wants->o;
  if (o->step_bits || o->schedule != DYD_SCHEDULE_ADAPTIVE || h->waiting->waited || dyd_has_policy(o)) h->probes = NULL;
  bool capped = dyd_delaunay_is_capped(wants->e->pd);
  if (o->goal == DYD_GOAL_DECIDED || capped) {
    dyd_status settling = capped ? DYD_OK : dyd_settle(settled, wants);
    return settling == DYD_OK ? want_faces(wants, h, NULL, settled) : settling;
  }
  if (o->goal == DYD_GOAL_HAUSDORFF) return want_hausdorff(wants, h, m);
  if (o->goal == DYD_GOAL_AREA) return want_bound(wants, m, NULL, true);
  /* Where the bound on the diagram holds already, and sums are not kept, only vertices are left to be narrowed. */
  dyd_status st = sums ? want_bound(wants, m, sums, o->goal == DYD_GOAL_VORONOI_AREA) : DYD_OK;
  if (st == DYD_OK && o->goal == DYD_GOAL_VORONOI_HAUSDORFF) st = want_vertices(wants);
  return st;
}

/* ---- goals ---- */

static dyd_status goal_bound_holds(bool *out, dyd_measure *m, const dyd_delaunay *pd, const dyd_engine_options *o) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, bound);
  dyd_status st = dyd_pairs_list(&pairs, pd, DYD_TIE);
  if (st == DYD_OK)
    st = o->goal == DYD_GOAL_AREA ? dyd_bound_area(bound, m, &pairs) : dyd_bound_hausdorff(bound, m, &pairs);
  *out = st == DYD_OK && mpfr_cmp_ui_2exp(bound, 1, (mpfr_exp_t)-o->goal_bits) <= 0;
  return st;
}

dyd_status dyd_goal_of_pairs_holds(bool *out, dyd_measure *m, const dyd_delaunay *pd, const dyd_engine_options *o) {
  size_t count[4];
  if (o->goal != DYD_GOAL_DECIDED) return goal_bound_holds(out, m, pd, o);
  dyd_delaunay_count(count, pd);
  *out = count[DYD_INDETERMINATE] == 0 && count[DYD_TIE] == 0;
  return DYD_OK;
}

/* The bound holds, and no vertex is left that is too wide and could be narrowed. */
static dyd_status goal_voronoi_and_vertices_hold(bool *out, dyd_voronoi_sums **sums, const dyd_engine *e,
                                                 const dyd_engine_options *o) {
  dyd_status st = goal_voronoi_holds(out, sums, e, o);
  if (st != DYD_OK || !*out || o->goal != DYD_GOAL_VORONOI_HAUSDORFF) return st;
  DYD_SCOPED(dyd_wants) wants;
  dyd_wants_init(&wants, e, o, NULL, 0);
  st = want_vertices(&wants);
  if (st == DYD_OK) st = wants.failed;
  *out = st == DYD_OK && wants.count == 0;
  return st;
}

static dyd_status goal_holds(bool *out, dyd_measure *m, dyd_voronoi_sums **sums, const dyd_engine *e,
                             const dyd_engine_options *o) {
  *out = false;
  if (dyd_delaunay_is_capped(e->pd)) return DYD_OK;
  return dyd_goal_is_voronoi(o->goal) ? goal_voronoi_and_vertices_hold(out, sums, e, o)
                                      : dyd_goal_of_pairs_holds(out, m, e->pd, o);
}

/* Else nothing is wanted, whatever the goal. */
static bool any_point_is_left(const dyd_engine *e) {
  for (size_t k = 0; k < e->points; k++)
    if (!e->point[k].final) return true;
  return false;
}

/* Sets *holds if the goal holds for the result, which is up to date. Otherwise *wants, empty, becomes the points to
 * narrow for it; adds to *probes, just initialised, the points that may go ahead, and to *waiting and *settled, kept
 * from judgement to judgement of a run, the points that wait and the pairs that no refinement decides. DYD_CANCELLED
 * when e->stop was seen. */
static dyd_status schedule_judge(bool *holds, dyd_wants *wants, dyd_probes *probes, dyd_waiting *waiting,
                                 dyd_settled *settled) {
  dyd_helpers h = {probes, waiting};
  DYD_SCOPED(dyd_measure) m;
  dyd_voronoi_sums *sums = NULL;
  dyd_measure_init(&m, wants->e->sites);
  dyd_status st = goal_holds(holds, &m, &sums, wants->e, wants->o);
  if (st == DYD_OK && !*holds && any_point_is_left(wants->e)) st = want_all(wants, &h, settled, &m, sums);
  if (st == DYD_OK) st = wants->failed;
  if (st == DYD_OK && wants->count && wants->o->schedule == DYD_SCHEDULE_UNIFORM) want_uniform(wants);
  goal_sums_free(&sums);
  return st;
}

#define MOST_GOAL_BITS ((int64_t)1 << 40)

/* Invariant: while probes.count > 0 the probes began in the stage after number `stage`, and `held` is the list that
 * waits for them. */
typedef struct goal_question {
  dyd_probes probes;
  dyd_waiting waiting;
  dyd_settled settled;
  dyd_wants held;
  uint64_t stage;
} goal_question;

/* Probes go ahead within a stage, and the others follow when their probes are over. A stage that was cut short ends the
 * probes as well: there is a new result to be judged. */
static dyd_status goal_ask(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  goal_question *q = user;
  (void)err;
  if (q->probes.count == 0 || q->stage != e->stages) {
    dyd_probes_clear(&q->probes);
    dyd_wants_empty(&q->held);
    dyd_status st = schedule_judge(answered, wants, &q->probes, &q->waiting, &q->settled);
    if (st != DYD_OK || q->probes.count == 0) return st;
    q->stage = e->stages;
    dyd_wants all = *wants; /* waits */
    *wants = q->held;
    q->held = all;
  }
  dyd_status st = dyd_probes_next(wants, &q->probes, &q->held);
  wants->again = wants->count > 0;
  if (st != DYD_OK || wants->again) return st;
  dyd_probes_finish(wants, &q->probes, &q->held);
  dyd_probes_clear(&q->probes);
  dyd_wants_empty(&q->held);
  return DYD_OK;
}

/* NULL, or which option of a run is out of its range. */
static const char *goal_options_fault(const dyd_engine_options *o) {
  if (o->goal_bits > MOST_GOAL_BITS || o->goal_bits < -MOST_GOAL_BITS)
    return "`goal_bits` is not between -2^40 and 2^40; give a number between them";
  if (o->goal < DYD_GOAL_DECIDED || o->goal > DYD_GOAL_VORONOI_HAUSDORFF) return "`goal` is not a dyd_goal; give one";
  if (dyd_goal_is_voronoi(o->goal) && !goal_window_is_good(o->window))
    return "the goal is about a diagram, and `window` has no area; give a rectangle with lower ends below upper ones";
  return o->schedule == DYD_SCHEDULE_ADAPTIVE || o->schedule == DYD_SCHEDULE_UNIFORM
             ? NULL
             : "`schedule` is not a dyd_schedule; give one";
}

static dyd_status goal_run(dyd_outcome *outcome, dyd_engine *e, const dyd_engine_options *o, dyd_error *err) {
  goal_question g = {.probes = {0}};
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = goal_ask, .user = &g, .triangulate = true};
  e->goal = o->goal;
  e->goal_bits = o->goal_bits;
  g.settled.prover = dyd_engine_prover(e, o);
  /* Where a stage may be the last one, or bounds are wanted, all pairs are needed at once. */
  e->postpones = o->goal == DYD_GOAL_DECIDED && o->schedule == DYD_SCHEDULE_ADAPTIVE && !o->step_bits &&
                 !o->max_stages && !o->max_calls && !dyd_has_policy(o);
  dyd_wants_init(&g.held, e, o, NULL, 0);
  dyd_status st = waiting_init(&g.waiting, e, o);
  st = st == DYD_OK ? dyd_ask(outcome, &e->spent, e, &question, o, err) : dyd_fail_nomem(err);
  e->postpones = false;
  waiting_clear(&g.waiting);
  dyd_wants_clear(&g.held);
  dyd_probes_clear(&g.probes);
  dyd_settled_clear(&g.settled);
  if (*outcome == DYD_OUTCOME_DECIDED && o->goal != DYD_GOAL_DECIDED) *outcome = DYD_OUTCOME_CERTIFIED;
  return st;
}

dyd_status dyd_engine_run(dyd_outcome *outcome, dyd_engine *e, const dyd_engine_options *options, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  dyd_engine_options o;
  *outcome = DYD_OUTCOME_ERROR;
  if (err) dyd_error_clear(err);
  dyd_status st = dyd_ask_may_begin(e, err);
  if (st != DYD_OK) return st;
  e->spent = DYD_BUDGET_NONE;
  st = dyd_abi_take(&o, sizeof o, options, "dyd_engine_options", err);
  if (st == DYD_OK && !waiting_costs_are_good(e, &o))
    st = dyd_fail(err, DYD_E_ARG, "the cost of a point is not above 0");
  if (st == DYD_OK) {
    const char *wrong = dyd_ask_options(&o);
    if (!wrong) wrong = goal_options_fault(&o);
    st = wrong ? dyd_fail(err, DYD_E_ARG, "%s", wrong) : goal_run(outcome, e, &o, err);
  }
  e->outcome = *outcome;
  return st;
}

/* ---- in one call ---- */

dyd_status dyd_delaunay_of(dyd_pair_list *out, size_t n, const double *xy, double radius,
                           const dyd_engine_options *options, dyd_error *err) {
  const dyd_column xys[2] = {{xy, 2 * sizeof *xy}, {xy ? xy + 1 : NULL, 2 * sizeof *xy}},
                   radii[2] = {{&radius, 0}, {&radius, 0}};
  dyd_engine *e = NULL;
  dyd_outcome outcome;
  if (!out || (n && !xy)) return dyd_fail_null(err);
  dyd_status st = dyd_engine_new(&e);
  if (st != DYD_OK) return dyd_fail_nomem(err);
  st = dyd_engine_add_columns(e, n, xys, radius == 0 ? NULL : radii, err);
  if (st == DYD_OK) st = dyd_engine_run(&outcome, e, options, err);
  if (st == DYD_OK) {
    st = dyd_delaunay_pairs(out, dyd_engine_delaunay(e));
    if (st != DYD_OK)
      dyd_fail(err, st,
               "no pair is known: the budget was spent before the first stage was complete, or memory is exhausted");
  }
  dyd_engine_free(e);
  return st;
}
