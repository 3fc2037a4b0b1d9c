/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The cover walk.
 *
 * R_i and R_j disjoint are separated by a vertical or a horizontal line; say vertical, i on the left. Then ds_i^2 -
 * ds_j^2 increases strictly with x, from -inf to inf, so beta = {ds_i = ds_j} is a graph over the axis t = y [BETA-1],
 * and only centres on beta (or at its two ends at infinity, the directions of the outer common tangents) matter: moving
 * c towards the farther rectangle keeps the inequality. Each other k blocks the open part of beta where dl_k < ds_i,
 * one interval or two rays; its finite ends are critical circles closest-closest-farthest of (i, j, k). A k that meets
 * R_i or R_j never blocks: a common point is no nearer than ds. The walk starts at t = -inf. If no vertex blocks
 * the place, the pair is possible. Else the walk continues to the far end of the blocker's interval; if there is none,
 * beta is covered, the pair is illegal [COV-1]. */
#include "possible/cover.h"

#include "skeleton/rects_filter.h"

#include <math.h>

/* One walk. Members 0 and 1 of the set are i and j; axis is the coordinate t. */
typedef struct walk {
  dyd_work *w;
  const dyd_skeleton *sk;
  uint32_t i, j;
  const uint32_t *hint; /* two vertices asked before all others */
  int axis;
  int end;          /* -1, 1: at infinity; 0: at the circle w->here */
  uint32_t blocker; /* of the current place, DYD_NONE: none found */
  uint32_t last;    /* whose interval ends at w->here: does not block there */
  double bound;     /* squared radius from above, or height from below */
  double u[2];      /* about the direction at that end */
  dyd_bbox centre;
  dyd_status status;
} walk;

static void cover_grow_circle(dyd_icircle *k, const mpz_t factor) {
  mpz_mul(k->ax, k->ax, factor);
  mpz_mul(k->bx, k->bx, factor);
  mpz_mul(k->ay, k->ay, factor);
  mpz_mul(k->by, k->by, factor);
  mpz_mul(k->px, k->px, factor);
  mpz_mul(k->py, k->py, factor);
}

/* Member index of v; the current circle follows the scale. */
static bool cover_member(size_t *index, walk *k, uint32_t v) {
  bool grown;
  k->status = dyd_scale_add(index, &grown, &k->w->set, v);
  if (k->status == DYD_OK && grown && k->end == 0) cover_grow_circle(&k->w->here, k->w->set.growth);
  return k->status == DYD_OK;
}

/* The ends of side `axis` of r. */
static mpz_srcptr cover_low_end(const dyd_irect *r, int axis) {
  return axis == 0 ? r->x0 : r->y0;
}
static mpz_srcptr cover_high_end(const dyd_irect *r, int axis) {
  return axis == 0 ? r->x1 : r->y1;
}

/* ---- ends at infinity ---- */

/* u = outward normal of the common tangent at the end of beta towards `end` of axis t; h = u.x on the tangent. The
 * tangent touches both rectangles on the side `end` of axis t, at the corners that face u in the other axis. */
static void cover_tangent(walk *k) {
  const dyd_irect *a = &k->w->set.rect[0], *b = &k->w->set.rect[1];
  int t = k->axis, o = 1 - t;
  if (mpz_cmp(cover_high_end(a, o), cover_low_end(b, o)) > 0) {
    const dyd_irect *swap = a;
    a = b;
    b = swap;
  }
  mpz_srcptr ta = k->end > 0 ? cover_high_end(a, t) : cover_low_end(a, t),
             tb = k->end > 0 ? cover_high_end(b, t) : cover_low_end(b, t);
  mpz_sub(k->w->t, tb, ta);
  int rise = mpz_sgn(k->w->t) * k->end; /* > 0: b reaches farther, u leans towards a's side */
  mpz_srcptr oa = rise > 0 ? cover_low_end(a, o) : cover_high_end(a, o),
             ob = rise > 0 ? cover_low_end(b, o) : cover_high_end(b, o);
  mpz_sub(k->w->s, ob, oa);
  mpz_ptr ut = k->w->u[t], uo = k->w->u[o];
  mpz_mul_si(ut, k->w->s, k->end);
  mpz_mul_si(uo, k->w->t, -k->end);
  mpz_mul(k->w->h, ut, ta);
  mpz_addmul(k->w->h, uo, oa);
}

/* Returns true if min over r of u.x > h. */
static bool cover_beyond(dyd_work *w, const dyd_irect *r) {
  mpz_mul(w->s, w->u[0], mpz_sgn(w->u[0]) > 0 ? r->x0 : r->x1);
  mpz_addmul(w->s, w->u[1], mpz_sgn(w->u[1]) > 0 ? r->y0 : r->y1);
  return mpz_cmp(w->s, w->h) > 0;
}

static bool cover_blocks_end(void *context, uint32_t v) {
  walk *k = context;
  size_t q;
  if (v == k->i || v == k->j || dyd_surely_not_beyond(&k->sk->rects, k->u[0], k->u[1], v, k->bound)) return true;
  if (!cover_member(&q, k, v)) return false;
  cover_tangent(k);
  if (!cover_beyond(k->w, &k->w->set.rect[q])) return true;
  k->blocker = v;
  return false;
}

/* Asks the two hints first; true if one of them blocks. */
static bool cover_ask_hints(walk *k, dyd_visit blocks) {
  for (int q = 0; q < 2; q++)
    if (k->hint[q] != DYD_NONE && !blocks(k, k->hint[q])) return true;
  return false;
}

static void cover_ask_end(walk *k, int end) {
  double *u = k->u;
  k->end = end;
  k->blocker = DYD_NONE;
  k->bound = -INFINITY;
  cover_tangent(k);
  if (cover_ask_hints(k, cover_blocks_end)) return;
  cover_tangent(k);
  dyd_direction_d(u, k->w->u[0], k->w->u[1]);
  double a = dyd_height_lower(&k->sk->rects, u[0], u[1], &k->sk->rects.box[k->i]);
  double b = dyd_height_lower(&k->sk->rects, u[0], u[1], &k->sk->rects.box[k->j]);
  if (!k->sk->mesh.no_filter) k->bound = dyd_max(a, b);
  dyd_tree_beyond(&k->sk->rects.tree, u[0], u[1], &k->bound, cover_blocks_end, k);
}

/* ---- circles ---- */

static bool cover_blocks_circle(void *context, uint32_t v) {
  walk *k = context;
  size_t q;
  if (v == k->i || v == k->j || v == k->last) return true;
  if (!k->sk->mesh.no_filter && dyd_surely_not_nearer(&k->sk->rects, &k->centre, v, k->bound)) return true;
  if (!cover_member(&q, k, v)) return false;
  const dyd_irect *r = &k->w->set.rect[q];
  if (dyd_irects_meet(r, &k->w->set.rect[0]) || dyd_irects_meet(r, &k->w->set.rect[1])) return true;
  if (dyd_icircle_side(&k->w->here, r, DYD_FARTHEST) >= 0) return true;
  k->blocker = v;
  return false;
}

static void cover_ask_circle(walk *k) {
  k->blocker = DYD_NONE;
  dyd_icircle_centre_d(k->centre.e, &k->w->here, dyd_scale_shift(&k->w->set));
  dyd_scale_to_user(&k->centre, &k->w->set);
  k->bound = k->sk->mesh.no_filter ? INFINITY : dyd_pair_ds2_upper(&k->sk->rects, &k->centre, k->i, k->j);
  k->blocker = k->sk->mesh.no_filter ? DYD_NONE : dyd_surely_nearest(&k->sk->rects, &k->centre, k->i, k->j);
  if (k->blocker != DYD_NONE || cover_ask_hints(k, cover_blocks_circle)) return;
  dyd_tree_near(&k->sk->rects.tree, &k->centre, &k->bound, cover_blocks_circle, k);
}

/* Moves to the far end of the blocker's interval; false if it has none. */
static bool cover_advance(walk *k) {
  dyd_work *w = k->w;
  size_t q, best = DYD_CIRCLES;
  if (!cover_member(&q, k, k->blocker)) return false;
  const dyd_irect *const r[3] = {&w->set.rect[0], &w->set.rect[1], &w->set.rect[q]};
  static const dyd_touch touch[3] = {DYD_CLOSEST, DYD_CLOSEST, DYD_FARTHEST};
  size_t count = dyd_icircles(w->next, DYD_CIRCLES, r, touch);
  for (size_t c = 0; c < count; c++) {
    if (k->end == 0 && dyd_icircle_compare(&w->next[c], &w->here, k->axis) <= 0) continue;
    if (best == DYD_CIRCLES || dyd_icircle_compare(&w->next[c], &w->next[best], k->axis) < 0) best = c;
  }
  if (best == DYD_CIRCLES) return false;
  dyd_icircle_swap(&w->here, &w->next[best]);
  k->end = 0;
  k->last = k->blocker;
  return true;
}

static bool cover_start(walk *k) {
  size_t q;
  dyd_scale_set_empty(&k->w->set);
  return cover_member(&q, k, k->i) && cover_member(&q, k, k->j);
}

dyd_status dyd_cover_possible(dyd_cover *out, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j,
                              const uint32_t hint[2]) {
  walk k = {.w = w, .sk = sk, .i = i, .j = j, .hint = hint, .end = -1, .status = DYD_OK};
  k.blocker = k.last = DYD_NONE;
  dyd_xy c = {0, 0};
  dyd_truth quick = sk->mesh.no_filter ? DYD_UNKNOWN : dyd_filter_cover(&c, sk, i, j, hint);
  *out = (dyd_cover){quick != DYD_FALSE, .walked = quick == DYD_UNKNOWN, .place = {{c.x, c.x, c.y, c.y}}};
  if (!out->walked) return DYD_OK;
  if (!cover_start(&k)) return k.status;
  const dyd_irect *a = &w->set.rect[0], *b = &w->set.rect[1];
  if (dyd_irects_meet(a, b)) return DYD_OK;
  k.axis = mpz_cmp(a->x1, b->x0) < 0 || mpz_cmp(b->x1, a->x0) < 0 ? 1 : 0;
  w->counters.cover_walks++;
  cover_ask_end(&k, 1);
  if (k.status == DYD_OK && k.blocker != DYD_NONE) cover_ask_end(&k, -1);
  while (k.status == DYD_OK && k.blocker != DYD_NONE) {
    if (!cover_advance(&k)) {
      out->possible = k.status != DYD_OK;
      return k.status;
    }
    cover_ask_circle(&k);
  }
  out->far = k.end != 0;
  out->place = k.centre;
  if (out->far) dyd_direction_d(out->u, w->u[0], w->u[1]);
  return k.status;
}
