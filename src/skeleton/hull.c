/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which vertices are certainly, which are possibly on the hull: walks around the circle of directions.
 *
 * Another site k and v compare by the rectangle D = R_k - R_v of differences. When 0 is not in D, the directions u with
 * u.d > 0 for all d in D (k certainly farther out than v) form an open arc of at most a half turn, bounded by the
 * normals of D's two extreme corners; where v is certainly farther out than k, by those of R_v - R_k. v is certainly on
 * the hull iff the arcs in which it is farther out than others have a common direction: intersect arcs of violators. It
 * is possibly on the hull iff the arcs in which others are farther out leave a direction free: walk from arc to arc
 * until the start is passed. */
#include "skeleton/hull.h"

#include "base/local.h"
#include "skeleton/rects_filter.h"
#include "skeleton/work.h"

#include <math.h>

typedef struct vec {
  mpz_t x, y;
} vec;

static void vec_init(vec *a) {
  mpz_inits(a->x, a->y, NULL);
}
static void vec_clear(vec *a) {
  mpz_clears(a->x, a->y, NULL);
}
static void vec_set(vec *a, const vec *b) {
  mpz_set(a->x, b->x);
  mpz_set(a->y, b->y);
}

/* One walk, at the direction u. */
typedef struct arcs {
  dyd_work *w;
  const dyd_skeleton *sk;
  uint32_t own[2], found; /* the vertices compared with all others; equal when it is one */
  vec u, from, to, d[4];  /* from, to: ends of the arc of the site found; d: scratch */
  bool outward;           /* arcs where the other site is farther out, else where v is */
  double height, u_d[2];  /* what the other site has to reach in the direction u, about */
  bool empty;             /* the arc found is empty */
  dyd_status status;
} arcs;

static void arcs_init(arcs *t, dyd_work *w, const dyd_skeleton *sk, uint32_t v, uint32_t v2, bool outward) {
  *t = (arcs){.w = w, .sk = sk, .own = {v, v2}, .outward = outward, .status = DYD_OK};
  vec_init(&t->u);
  vec_init(&t->from);
  vec_init(&t->to);
  for (int k = 0; k < 4; k++) vec_init(&t->d[k]);
}

static void arcs_clear(arcs *t) {
  for (int k = 0; k < 4; k++) vec_clear(&t->d[k]);
  vec_clear(&t->to);
  vec_clear(&t->from);
  vec_clear(&t->u);
}

/* Signs of products. */
static int arcs_cross(arcs *t, const vec *a, const vec *b) {
  mpz_mul(t->w->s, a->x, b->y);
  mpz_submul(t->w->s, a->y, b->x);
  return mpz_sgn(t->w->s);
}

static int arcs_dot(arcs *t, const vec *a, const vec *b) {
  mpz_mul(t->w->s, a->x, b->x);
  mpz_addmul(t->w->s, a->y, b->y);
  return mpz_sgn(t->w->s);
}

/* The corners of farther - nearer. */
static void arc_differences(arcs *t, const dyd_irect *farther, const dyd_irect *nearer) {
  for (int k = 0; k < 4; k++) {
    mpz_sub(t->d[k].x, k & 1 ? farther->x1 : farther->x0, k & 1 ? nearer->x0 : nearer->x1);
    mpz_sub(t->d[k].y, k & 2 ? farther->y1 : farther->y0, k & 2 ? nearer->y0 : nearer->y1);
  }
}

static bool arc_holds(arcs *t) {
  for (int k = 0; k < 4; k++)
    if (arcs_dot(t, &t->u, &t->d[k]) <= 0) return false;
  return true;
}

/* The arc {u : u.d > 0 for all corners}: from = last corner turned by -90 degrees, to = first corner turned by +90. */
static void arc_set(arcs *t) {
  int first = 0, last = 0;
  t->empty = mpz_sgn(t->d[0].x) <= 0 && mpz_sgn(t->d[3].x) >= 0 && mpz_sgn(t->d[0].y) <= 0 && mpz_sgn(t->d[3].y) >= 0;
  if (t->empty) return;
  for (int k = 1; k < 4; k++) {
    if (arcs_cross(t, &t->d[k], &t->d[first]) > 0) first = k;
    if (arcs_cross(t, &t->d[last], &t->d[k]) > 0) last = k;
  }
  mpz_set(t->from.x, t->d[last].y);
  mpz_neg(t->from.y, t->d[last].x);
  mpz_neg(t->to.x, t->d[first].y);
  mpz_set(t->to.y, t->d[first].x);
}

/* Compares site k with own vertex q; true if it is the one looked for. */
static bool arc_examine_one(arcs *t, uint32_t k, int q) {
  size_t a, b;
  bool grown;
  t->status = dyd_scale_add(&a, &grown, &t->w->set, k);
  if (t->status == DYD_OK) t->status = dyd_scale_add(&b, &grown, &t->w->set, t->own[q]);
  if (t->status != DYD_OK) return true;
  const dyd_irect *other = &t->w->set.rect[a], *self = &t->w->set.rect[b];
  if (t->outward)
    arc_differences(t, other, self);
  else
    arc_differences(t, self, other);
  if (arc_holds(t) != t->outward) return false;
  t->found = k;
  arc_set(t);
  return true;
}

static bool arc_examine(void *context, uint32_t k) {
  arcs *t = context;
  if (k == t->own[0] || k == t->own[1]) return true;
  if (t->outward && dyd_surely_not_beyond(t->w->rects, t->u_d[0], t->u_d[1], k, t->height)) return true;
  if (arc_examine_one(t, k, 0)) return false;
  return t->own[1] == t->own[0] || !arc_examine_one(t, k, 1);
}

/* A height reached by every site comparable with own vertex q. */
static double arc_own_height(const arcs *t, int q, const double u[2]) {
  dyd_bbox point = t->w->rects->box[t->own[q]];
  if (!t->outward) { /* min over the rectangle instead of max: the opposite corner */
    for (int a = 0; a < 2; a++) point.e[2 * a] = point.e[2 * a + 1] = u[a] > 0 ? point.e[2 * a] : point.e[2 * a + 1];
  }
  return dyd_height_lower(t->w->rects, u[0], u[1], &point);
}

/* Looks for a site in whose arc u is (outward), or is not; t->found, and its arc. DYD_NONE: there is none. Looks for a
 * site that blocks v in the direction u (possible), or that reaches as far as v there (sure). */
static void arcs_ask(arcs *t) {
  double *u = t->u_d;
  t->found = DYD_NONE;
  dyd_direction_d(u, t->u.x, t->u.y);
  t->height = dyd_min(arc_own_height(t, 0, u), arc_own_height(t, 1, u));
  if (t->sk->mesh.no_filter) t->height = -INFINITY;
  dyd_tree_beyond(&t->w->rects->tree, u[0], u[1], &t->height, arc_examine, t);
}

/* ---- possibly on the hull ---- */

/* Returns true if `mark` is in the half-open arc (u, to]. It is below a half turn, since u is strictly inside the arc
 * found. */
static bool hull_passes(arcs *t, const vec *mark) {
  return arcs_cross(t, &t->u, mark) > 0 && arcs_cross(t, mark, &t->to) >= 0;
}

dyd_status dyd_hull_possible(bool *possible, dyd_work *w, const dyd_skeleton *sk, uint32_t v) {
  DYD_SCOPED(arcs) t;
  DYD_LOCAL(vec, start);
  arcs_init(&t, w, sk, v, v, true);
  dyd_scale_set_empty(&w->set);
  mpz_set_si(start.x, 1);
  vec_set(&t.u, &start);
  for (arcs_ask(&t); t.status == DYD_OK && t.found != DYD_NONE; arcs_ask(&t)) {
    if (hull_passes(&t, &start)) break;
    vec_set(&t.u, &t.to);
  }
  *possible = t.found == DYD_NONE;
  return t.status;
}

static bool hull_same_direction(arcs *t, const vec *a, const vec *b) {
  return arcs_cross(t, a, b) == 0 && arcs_dot(t, a, b) > 0;
}

/* Returns true if u is strictly inside the arc from a to b, at most a half turn. */
static bool hull_is_inside(arcs *t, const vec *a, const vec *b, const vec *u) {
  return arcs_cross(t, a, u) > 0 && arcs_cross(t, u, b) > 0;
}

/* Intersects the open arc (lo, hi) with the arc found; false if nothing is left. The beginning of the one must lie in
 * the other, its end excluded, and so with the ends. */
static bool hull_narrow(arcs *t, vec *lo, vec *hi) {
  bool from_in = hull_is_inside(t, lo, hi, &t->from), to_in = hull_is_inside(t, lo, hi, &t->to);
  bool lo_in = hull_is_inside(t, &t->from, &t->to, lo) || hull_same_direction(t, lo, &t->from);
  bool hi_in = hull_is_inside(t, &t->from, &t->to, hi) || hull_same_direction(t, hi, &t->to);
  if (!(from_in || lo_in) || !(to_in || hi_in)) return false;
  if (from_in) vec_set(lo, &t->from);
  if (to_in) vec_set(hi, &t->to);
  return true;
}

/* A short direction strictly between a and b, less than a half arcs apart. */
static void hull_between(vec *u, const vec *a, const vec *b) {
  size_t sa = mpz_sizeinbase(a->x, 2), sb = mpz_sizeinbase(b->x, 2), ta = mpz_sizeinbase(a->y, 2),
         tb = mpz_sizeinbase(b->y, 2);
  sa = sa > ta ? sa : ta;
  sb = sb > tb ? sb : tb;
  mp_bitcnt_t up_a = sb > sa ? sb - sa : 0, up_b = sa > sb ? sa - sb : 0;
  DYD_LOCAL(vec, t);
  mpz_mul_2exp(t.x, b->x, up_b);
  mpz_mul_2exp(t.y, b->y, up_b);
  mpz_mul_2exp(u->x, a->x, up_a);
  mpz_mul_2exp(u->y, a->y, up_a);
  mpz_add(u->x, u->x, t.x);
  mpz_add(u->y, u->y, t.y);
}

/* Intersects arcs of violators until none is left at t->u, or nothing of the arc. */
static bool hull_common_direction(arcs *t) {
  DYD_LOCAL(vec, lo, hi);
  bool any = false, left = true;
  dyd_scale_set_empty(&t->w->set);
  mpz_set_si(t->u.x, 1);
  for (arcs_ask(t); t->status == DYD_OK && t->found != DYD_NONE; arcs_ask(t)) {
    left = !t->empty && (!any || hull_narrow(t, &lo, &hi));
    if (!left) break;
    if (!any) {
      vec_set(&lo, &t->from);
      vec_set(&hi, &t->to);
      any = true;
    }
    if (arcs_cross(t, &lo, &hi) != 0)
      hull_between(&t->u, &lo, &hi);
    else { /* a half arcs */
      mpz_neg(t->u.x, lo.y);
      mpz_set(t->u.y, lo.x);
    }
  }
  return left && t->status == DYD_OK;
}

dyd_status dyd_hull_sure(bool *sure, dyd_work *w, const dyd_skeleton *sk, uint32_t v) {
  DYD_SCOPED(arcs) t;
  arcs_init(&t, w, sk, v, v, false);
  *sure = hull_common_direction(&t);
  return t.status;
}

dyd_status dyd_hull_direction(bool *found, mpz_t ux, mpz_t uy, dyd_work *w, const dyd_skeleton *sk, uint32_t i,
                              uint32_t j) {
  DYD_SCOPED(arcs) t;
  arcs_init(&t, w, sk, i, j, false);
  *found = hull_common_direction(&t);
  mpz_set(ux, t.u.x);
  mpz_set(uy, t.u.y);
  return t.status;
}
