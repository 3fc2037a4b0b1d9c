/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Arcs of directions, exactly. */
#include "skeleton/arcs.h"

#include "skeleton/rects_filter.h"

#include <math.h>

void dyd_arcs_init(dyd_arcs *t, dyd_work *w, const dyd_skeleton *sk, uint32_t v, uint32_t v2, bool outward) {
  *t = (dyd_arcs){.w = w, .sk = sk, .own = {v, v2}, .outward = outward, .status = DYD_OK};
  dyd_vec_init(&t->u);
  dyd_vec_init(&t->from);
  dyd_vec_init(&t->to);
  for (int k = 0; k < 4; k++) dyd_vec_init(&t->d[k]);
}

void dyd_arcs_clear(dyd_arcs *t) {
  for (int k = 0; k < 4; k++) dyd_vec_clear(&t->d[k]);
  dyd_vec_clear(&t->to);
  dyd_vec_clear(&t->from);
  dyd_vec_clear(&t->u);
}

int dyd_arcs_cross(dyd_arcs *t, const dyd_vec *a, const dyd_vec *b) {
  mpz_mul(t->w->s, a->x, b->y);
  mpz_submul(t->w->s, a->y, b->x);
  return mpz_sgn(t->w->s);
}

int dyd_arcs_dot(dyd_arcs *t, const dyd_vec *a, const dyd_vec *b) {
  mpz_mul(t->w->s, a->x, b->x);
  mpz_addmul(t->w->s, a->y, b->y);
  return mpz_sgn(t->w->s);
}

/* The corners of farther - nearer. */
static void arc_differences(dyd_arcs *t, const dyd_irect *farther, const dyd_irect *nearer) {
  for (int k = 0; k < 4; k++) {
    mpz_sub(t->d[k].x, k & 1 ? farther->x1 : farther->x0, k & 1 ? nearer->x0 : nearer->x1);
    mpz_sub(t->d[k].y, k & 2 ? farther->y1 : farther->y0, k & 2 ? nearer->y0 : nearer->y1);
  }
}

static bool arc_holds(dyd_arcs *t) {
  for (int k = 0; k < 4; k++)
    if (dyd_arcs_dot(t, &t->u, &t->d[k]) <= 0) return false;
  return true;
}

/* The arc {u : u.d > 0 for all corners}: from = last corner turned by -90 degrees, to = first corner turned by +90. */
static void arc_set(dyd_arcs *t) {
  int first = 0, last = 0;
  t->empty = mpz_sgn(t->d[0].x) <= 0 && mpz_sgn(t->d[3].x) >= 0 && mpz_sgn(t->d[0].y) <= 0 && mpz_sgn(t->d[3].y) >= 0;
  if (t->empty) return;
  for (int k = 1; k < 4; k++) {
    if (dyd_arcs_cross(t, &t->d[k], &t->d[first]) > 0) first = k;
    if (dyd_arcs_cross(t, &t->d[last], &t->d[k]) > 0) last = k;
  }
  mpz_set(t->from.x, t->d[last].y);
  mpz_neg(t->from.y, t->d[last].x);
  mpz_neg(t->to.x, t->d[first].y);
  mpz_set(t->to.y, t->d[first].x);
}

/* Compares site k with own vertex q; true if it is the one looked for. */
static bool arc_examine_one(dyd_arcs *t, uint32_t k, int q) {
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
  dyd_arcs *t = context;
  if (k == t->own[0] || k == t->own[1]) return true;
  if (arc_examine_one(t, k, 0)) return false;
  return t->own[1] == t->own[0] || !arc_examine_one(t, k, 1);
}

/* A height that whoever compares with own vertex q reaches. */
static double arc_own_height(const dyd_arcs *t, int q, const double u[2]) {
  dyd_bbox point = t->w->rects->box[t->own[q]];
  if (!t->outward) { /* min over the rectangle instead of max: the opposite corner */
    for (int a = 0; a < 2; a++) point.e[2 * a] = point.e[2 * a + 1] = u[a] > 0 ? point.e[2 * a] : point.e[2 * a + 1];
  }
  return dyd_height_lower(t->w->rects, u[0], u[1], &point);
}

/* Looks for a site that blocks v in the direction u (possible), or that reaches as far as v there (sure). */
void dyd_arcs_ask(dyd_arcs *t) {
  double u[2];
  t->found = DYD_NONE;
  dyd_direction_d(u, t->u.x, t->u.y);
  double height = dyd_min(arc_own_height(t, 0, u), arc_own_height(t, 1, u));
  if (t->sk->mesh.no_filter) height = -INFINITY;
  dyd_tree_beyond(&t->w->rects->tree, u[0], u[1], &height, arc_examine, t);
}
