/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The search for a witness by cutting planes.
 *
 * c is a witness of ij iff ds_k(c)^2 - dl_s(c)^2 > 0 for s = i, j and all other k. This is the least, over q in R_k and
 * corners p of R_s, of |c-q|^2 - |c-p|^2, linear in c: a concave function, so at any c its active pair (q,p) gives a
 * half-plane that holds all witnesses: the points nearer to p than to q [WIT-1]. The search keeps such half-planes,
 * moves c to the centre of the largest disc inside them, and asks again who violates. An empty intersection ends it: no
 * witness.
 *
 * First in doubles (witness_filter.c), which is enough for nearly all; else with exact half-planes. */
#include "legal/witness.h"

#include "base/local.h"
#include "legal/planes.h"
#include "legal/witness_filter.h"
#include "predicate/circle.h"
#include "rect/rect.h"
#include "skeleton/circumcentre.h"
#include "skeleton/hull.h"
#include "skeleton/rects_filter.h"
#include <dyadel/predicate.h>

#include <math.h>
#include <stdlib.h>

enum { MAX_RIVALS = 12, LEAST_STEPS = 48, MAX_STEPS = 400, STEP_BITS = 1 << 17, SNAP_STEPS = 8 };

/* Invariant: `rivals` counts those seen so far who violate the present c; ended: no witness exists, or no space for
 * more half-planes, or c is only asked about and violated; none: certainly none exists, or only below the floor. */
typedef struct search {
  const dyd_rects *rects;
  bool no_filter;
  uint32_t i, j;
  dyd_rect own[2], rival; /* rival: the latest */
  dyd_plane_list *planes; /* NULL: c is only asked about */
  dyd_point c;
  dyd_bbox at; /* where c is */
  size_t rivals;
  bool ended, none;
  const volatile int *cancel;
  dyd_status status;
} search;

static void witness_search_init(search *s, const dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j) {
  *s = (search){.rects = w->rects, .no_filter = sk->mesh.no_filter, .i = i, .j = j, .cancel = w->run->cancel};
  dyd_rect_init(&s->own[0]);
  dyd_rect_init(&s->own[1]);
  dyd_rect_init(&s->rival);
  dyd_point_init(&s->c);
  dyd_rects_get(&s->own[0], s->rects, i);
  dyd_rects_get(&s->own[1], s->rects, j);
}

static void witness_search_clear(search *s) {
  dyd_point_clear(&s->c);
  dyd_rect_clear(&s->rival);
  dyd_rect_clear(&s->own[1]);
  dyd_rect_clear(&s->own[0]);
}

static bool witness_search_found(const search *s) {
  return s->status == DYD_OK && s->rivals == 0;
}

/* Returns true if the rectangle is certainly farther from c than all of R_i and R_j. Exact. */
static bool witness_is_outside(const search *s, const dyd_rect *r) {
  for (int q = 0; q < 2; q++)
    if (dyd_compare_distance(&s->c, &s->own[q], DYD_FARTHEST, r, DYD_CLOSEST) >= 0) return false;
  return true;
}

/* The same in doubles, for nearly all where c is far away [FLT-FAR]. */
static bool witness_is_surely_outside(const search *s, uint32_t k) {
  const dyd_bbox *box = s->rects->box;
  if (s->no_filter) return false;
  return dyd_filter_is_farther(&s->at, &box[s->i], &box[k]) && dyd_filter_is_farther(&s->at, &box[s->j], &box[k]);
}

/* r violates c: new half-planes. */
static void witness_add_rival(search *s, const dyd_rect *r) {
  s->ended = !s->planes;
  for (int q = 0; q < 2 && !s->ended; q++) s->ended = !dyd_planes_add(s->planes, &s->c, &s->own[q], r);
  s->rivals++;
  dyd_rect_set(&s->rival, r);
}

/* A few violators are enough for one step. */
static bool witness_examine(void *context, uint32_t k) {
  search *s = context;
  if (k == s->i || k == s->j || witness_is_surely_outside(s, k)) return true;
  if (dyd_flag_is_set(s->cancel)) s->status = DYD_CANCELLED; /* each that follows may take long */
  if (s->status != DYD_OK) return false;
  DYD_LOCAL(dyd_rect, r);
  dyd_rects_get(&r, s->rects, k);
  if (!witness_is_outside(s, &r)) witness_add_rival(s, &r);
  return !s->ended && s->rivals < MAX_RIVALS;
}

static bool witness_meets(void *context, uint32_t k) {
  search *s = context;
  if (k == s->i || k == s->j) return true;
  DYD_LOCAL(dyd_rect, r);
  dyd_rects_get(&r, s->rects, k);
  s->ended = dyd_rect_meets(&r, &s->own[0]) || dyd_rect_meets(&r, &s->own[1]);
  return !s->ended;
}

/* A rectangle that meets R_i or R_j is never outside of a disc that holds both: then no witness exists. */
static void witness_look_at_ends(search *s) {
  const double zero = 0;
  const uint32_t own[2] = {s->i, s->j};
  for (int q = 0; q < 2 && !s->ended; q++)
    dyd_tree_near(&s->rects->tree, &s->rects->box[own[q]], &zero, witness_meets, s);
  s->none = s->ended;
  if (s->ended) s->rivals = 1;
}

/* Finds the sites that violate c. All sites are tested through the tree; the result is exact. */
static void witness_evaluate(search *s) {
  s->rivals = 0;
  s->at = dyd_point_box(&s->c);
  double bound = s->no_filter ? INFINITY : dyd_pair_dl2_upper(s->rects, &s->at, s->i, s->j);
  dyd_tree_near(&s->rects->tree, &s->at, &bound, witness_examine, s);
}

/* Representatives are finite doubles. */
static void witness_set_start(dyd_point *c, const dyd_skeleton *sk, uint32_t i, dyd_xy guess) {
  if (!isfinite(guess.x) || !isfinite(guess.y)) guess = sk->reps.xy[i];
  dyd_point_set_xy(c, guess);
}

/* How many steps are made: fewer where the ends of rectangles span many bits, since each then takes longer. */
static int64_t witness_steps(const dyd_plane_list *l) {
  int64_t span = l->top - l->low;
  return span > STEP_BITS / (MAX_STEPS - LEAST_STEPS) ? LEAST_STEPS + STEP_BITS / span : MAX_STEPS;
}

/* end: the end of the three sides that is nearest to x; gap: how near. */
static void witness_nearest_end(const dyd_dyadic **end, dyd_dyadic *gap, const dyd_dyadic *x,
                                const dyd_interval *const side[3]) {
  DYD_LOCAL(dyd_dyadic, d);
  *end = NULL;
  for (int k = 0; k < 6; k++) {
    const dyd_dyadic *e = k % 2 ? &side[k / 2]->hi : &side[k / 2]->lo;
    if (dyd_dyadic_sub(&d, x, e) != DYD_OK) continue;
    if (dyd_dyadic_sgn(&d) < 0) dyd_dyadic_neg(&d, &d);
    if (*end && dyd_dyadic_cmp(&d, gap) >= 0) continue;
    *end = e;
    dyd_dyadic_swap(&d, gap);
  }
}

/* Where witnesses have next to no room, the centres come nearer to it by a fixed part in each step: as many steps as
 * numbers have bits. It often lies beside ends of rectangles: there half-planes are of the right scale at once. In
 * turns the nearer coordinate moves (the other may be on its way to infinity) and both. */
static void witness_snap(search *s, bool both) {
  const dyd_interval *const x[3] = {&s->own[0].x, &s->own[1].x, &s->rival.x};
  const dyd_interval *const y[3] = {&s->own[0].y, &s->own[1].y, &s->rival.y};
  const dyd_dyadic *end[2];
  DYD_LOCAL_ARRAY(dyd_dyadic, gap, [2]);
  witness_nearest_end(&end[0], &gap[0], &s->c.x, x);
  witness_nearest_end(&end[1], &gap[1], &s->c.y, y);
  if (end[0] && end[1]) {
    int order = dyd_dyadic_cmp(&gap[0], &gap[1]);
    if (both || order <= 0) dyd_dyadic_set(&s->c.x, end[0]);
    if (both || order > 0) dyd_dyadic_set(&s->c.y, end[1]);
    witness_evaluate(s);
  }
}

/* Ends with no rivals (a witness), or with some (none, the floor, or too many steps). */
static void witness_search_run(search *s) {
  dyd_truth room = DYD_TRUE;
  witness_look_at_ends(s);
  if (!s->ended) witness_evaluate(s);
  for (int step = 0; s->status == DYD_OK && s->rivals && !s->ended && room == DYD_TRUE; step++) {
    if (step >= witness_steps(s->planes)) break;
    s->status = dyd_planes_centre(&room, &s->c, s->planes);
    s->none = room == DYD_FALSE;
    if (s->status == DYD_OK && room == DYD_TRUE) witness_evaluate(s);
    if (s->status == DYD_OK && room == DYD_TRUE && s->rivals && !s->ended && step % SNAP_STEPS == SNAP_STEPS - 1)
      witness_snap(s, step / SNAP_STEPS % 2);
  }
}

static dyd_status witness_search_exactly(dyd_truth *exists, dyd_point *c, dyd_work *w, const dyd_skeleton *sk,
                                         uint32_t i, uint32_t j, dyd_xy guess) {
  dyd_plane_list *planes = malloc(sizeof *planes);
  search s;
  if (!planes) return DYD_E_NOMEM;
  dyd_planes_init(planes, w->run->cancel);
  witness_search_init(&s, w, sk, i, j);
  s.planes = planes;
  witness_set_start(&s.c, sk, i, guess);
  witness_search_run(&s);
  *exists = witness_search_found(&s) ? DYD_TRUE : s.none ? DYD_FALSE : DYD_UNKNOWN;
  if (*exists == DYD_TRUE && c) dyd_point_set(c, &s.c);
  witness_search_clear(&s);
  dyd_planes_clear(planes);
  free(planes);
  return s.status;
}

/* Returns true if some circle meets the rectangles of i, j and of both vertices across, these certainly on opposite
 * sides of ij. Then there is no witness [WIT-QUAD]. */
static bool witness_is_excluded(const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t across[2]) {
  const uint32_t v[4] = {i, j, across[0], across[1]};
  DYD_LOCAL_ARRAY(dyd_rect, r, [4]);
  for (int k = 0; k < 4; k++) dyd_rects_get(&r[k], &sk->rects, v[k]);
  dyd_sure a = dyd_orientation(&r[0], &r[1], &r[2]), b = dyd_orientation(&r[0], &r[1], &r[3]);
  bool opposite = a != DYD_UNSURE && (int)a == -(int)b;
  return opposite && dyd_con(&r[3], &r[0], &r[1], &r[2]) == DYD_UNSURE;
}

/* Before a search with big numbers: returns true if certainly none exists, or one lies between the centres of the
 * edge's two triangles. */
static bool witness_look_between(bool *found, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j,
                                 const uint32_t across[2]) {
  if (witness_is_excluded(sk, i, j, across)) return true;
  DYD_LOCAL(dyd_point, middle);
  *found = dyd_circumcentre_between(&middle, sk, i, j, across) && dyd_witness_check(w, sk, i, j, &middle);
  if (*found && c) dyd_point_set(c, &middle);
  return *found;
}

/* One search for a pair in either order. */
static void witness_order(uint32_t *i, uint32_t *j) {
  uint32_t t = *i;
  if (t <= *j) return;
  *i = *j;
  *j = t;
}

dyd_status dyd_witness_search(bool *found, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j,
                              dyd_xy guess, const uint32_t across[2]) {
  *found = false;
  witness_order(&i, &j);
  dyd_truth quick = dyd_filter_witness(&guess, w->rects, sk, i, j);
  if (quick == DYD_UNKNOWN || (quick == DYD_TRUE && sk->mesh.no_filter)) {
    dyd_truth exists = DYD_UNKNOWN;
    if (across && !sk->mesh.no_filter && witness_look_between(found, c, w, sk, i, j, across)) return DYD_OK;
    dyd_status st = witness_search_exactly(&exists, c, w, sk, i, j, guess);
    *found = exists == DYD_TRUE;
    return st;
  }
  *found = quick == DYD_TRUE;
  if (*found && c) witness_set_start(c, sk, i, guess);
  return DYD_OK;
}

dyd_status dyd_witness_decide(dyd_truth *exists, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i,
                              uint32_t j, dyd_xy guess, const uint32_t across[2]) {
  witness_order(&i, &j);
  *exists = sk->mesh.no_filter ? DYD_UNKNOWN : dyd_filter_witness(&guess, w->rects, sk, i, j);
  if (*exists == DYD_TRUE) {
    witness_set_start(c, sk, i, guess);
    return DYD_OK;
  }
  *exists = DYD_FALSE;
  if (across && witness_is_excluded(sk, i, j, across)) return DYD_OK;
  return witness_search_exactly(exists, c, w, sk, i, j, guess);
}

bool dyd_witness_check(dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j, const dyd_point *c) {
  search s;
  witness_search_init(&s, w, sk, i, j);
  dyd_point_set(&s.c, c);
  witness_evaluate(&s);
  bool good = witness_search_found(&s);
  witness_search_clear(&s);
  return good;
}

bool dyd_witness_at(dyd_work *w, const dyd_skeleton *sk, dyd_half_edge h, dyd_xy at) {
  dyd_point c;
  dyd_point_init(&c);
  dyd_point_set_xy(&c, at);
  bool good = dyd_witness_check(w, sk, dyd_edge_origin(&sk->mesh, h), dyd_edge_target(&sk->mesh, h), &c);
  dyd_point_clear(&c);
  return good;
}

/* c = p + 2^m u for a vertex's double p. */
static dyd_status witness_far_centre(dyd_point *c, const dyd_skeleton *sk, uint32_t i, const mpz_t ux, const mpz_t uy,
                                     int64_t m) {
  DYD_LOCAL(dyd_dyadic, d);
  witness_set_start(c, sk, i, (dyd_xy){NAN, NAN});
  dyd_status st = dyd_dyadic_set_z_2exp(&d, ux, m);
  if (st == DYD_OK) st = dyd_dyadic_add(&c->x, &c->x, &d);
  if (st == DYD_OK) st = dyd_dyadic_set_z_2exp(&d, uy, m);
  return st == DYD_OK ? dyd_dyadic_add(&c->y, &c->y, &d) : st;
}

dyd_status dyd_witness_far(bool *found, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j) {
  DYD_LOCAL_NUMBERS(mpz, ux, uy);
  DYD_LOCAL(dyd_point, far);
  dyd_status st = dyd_hull_direction(found, ux, uy, w, sk, i, j);
  bool direction = *found;
  *found = false;
  for (int64_t step = 16, m = -64; direction && st == DYD_OK && !*found; m += step, step += step / 4) {
    st = witness_far_centre(&far, sk, i, ux, uy, m);
    *found = st == DYD_OK && dyd_witness_check(w, sk, i, j, &far);
  }
  if (st == DYD_E_RANGE) st = DYD_OK; /* farther than numbers go: the floor */
  if (*found && c) dyd_point_set(c, &far);
  return st;
}
