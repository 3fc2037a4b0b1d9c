/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The part of a box that is nearest to one of some points, in rationals: a polygon, cut by one bisector after another.
 * The squared distance to that point less the squared level is convex there, so it is largest at a corner. */
#include "graph/clip.h"

#include "base/alloc.h"

void dyd_clip_init(dyd_clip *c, const dyd_irect *box) {
  *c = (dyd_clip){.box = box};
  mpz_inits(c->level[0], c->level[1], NULL);
}

void dyd_clip_clear(dyd_clip *c) {
  for (size_t k = 0; k < c->count; k++) mpz_clears(c->point[k].at[0], c->point[k].at[1], NULL);
  free(c->point);
  mpz_clears(c->level[0], c->level[1], NULL);
}

void dyd_clip_level(dyd_clip *c, int axis, mpz_srcptr at) {
  c->flat[axis] = !at;
  if (at) mpz_set(c->level[axis], at);
}

/* The largest level in the box against the least distance of the point to the box, both squared. */
static bool is_far(const dyd_clip *c, mpz_srcptr x, mpz_srcptr y) {
  mpz_t most, d, t;
  mpz_inits(most, d, t, NULL);
  for (int axis = 0; axis < 2; axis++) {
    mpz_sub(d, dyd_irect_end(c->box, axis, 0), c->level[axis]);
    mpz_sub(t, dyd_irect_end(c->box, axis, 1), c->level[axis]);
    mpz_srcptr longer = mpz_cmpabs(d, t) > 0 ? d : t;
    if (!c->flat[axis]) mpz_addmul(most, longer, longer);
  }
  dyd_irect_ds2(d, x, y, c->box);
  bool far = mpz_cmp(d, most) >= 0;
  mpz_clears(most, d, t, NULL);
  return far;
}

bool dyd_clip_add(dyd_clip *c, mpz_srcptr x, mpz_srcptr y) {
  if (is_far(c, x, y)) return true;
  if (!dyd_reserve((void **)&c->point, &c->cap, c->count + 1, sizeof *c->point)) return false;
  mpz_init_set(c->point[c->count].at[0], x);
  mpz_init_set(c->point[c->count].at[1], y);
  c->count++;
  return true;
}

/* ---- polygons ---- */

typedef struct clip_corner {
  mpq_t at[2];
} clip_corner;

/* Invariant: corners are initialised up to made; in order, perhaps of a segment or a point only. */
typedef struct clip_polygon {
  clip_corner *corner;
  size_t count, made, cap;
} clip_polygon;

static bool polygon_room(clip_polygon *p) {
  if (p->count < p->made) return true;
  if (!dyd_reserve((void **)&p->corner, &p->cap, p->made + 1, sizeof *p->corner)) return false;
  mpq_inits(p->corner[p->made].at[0], p->corner[p->made].at[1], NULL);
  p->made++;
  return true;
}

static void polygon_clear(clip_polygon *p) {
  for (size_t k = 0; k < p->made; k++) mpq_clears(p->corner[k].at[0], p->corner[k].at[1], NULL);
  free(p->corner);
}

static bool polygon_box(clip_polygon *p, const dyd_irect *box) {
  p->count = 0;
  for (int c = 0; c < 4; c++) {
    if (!polygon_room(p)) return false;
    mpq_set_z(p->corner[p->count].at[0], dyd_irect_end(box, 0, c == 1 || c == 2));
    mpq_set_z(p->corner[p->count].at[1], dyd_irect_end(box, 1, c >= 2));
    p->count++;
  }
  return true;
}

/* *out = 2 (k - l).m + |l|^2 - |k|^2: at least 0 where k is as near as l. */
static void nearer_by(mpq_ptr out, const clip_corner *m, const dyd_clip_point *k, const dyd_clip_point *l) {
  mpq_t s, t;
  mpq_inits(s, t, NULL);
  mpq_set_ui(out, 0, 1);
  for (int axis = 0; axis < 2; axis++) {
    mpz_sub(mpq_numref(s), k->at[axis], l->at[axis]);
    mpz_add(mpq_numref(t), k->at[axis], l->at[axis]);
    mpq_sub(t, m->at[axis], t);
    mpq_add(t, t, m->at[axis]);
    mpz_set_ui(mpq_denref(s), 1);
    mpq_mul(s, s, t);
    mpq_add(out, out, s);
    mpq_set_ui(t, 0, 1);
  }
  mpq_clears(s, t, NULL);
}

/* The place between a and b where a value that is f at a and g at b, of opposite signs, is 0. */
static bool polygon_between(clip_polygon *to, const clip_corner *a, const clip_corner *b, mpq_srcptr f, mpq_srcptr g) {
  mpq_t w, t;
  if (!polygon_room(to)) return false;
  mpq_inits(w, t, NULL);
  mpq_sub(w, f, g);
  mpq_div(w, f, w);
  for (int axis = 0; axis < 2; axis++) {
    mpq_sub(t, b->at[axis], a->at[axis]);
    mpq_mul(t, t, w);
    mpq_add(to->corner[to->count].at[axis], a->at[axis], t);
  }
  to->count++;
  mpq_clears(w, t, NULL);
  return true;
}

static bool polygon_keep(clip_polygon *to, const clip_corner *a) {
  if (!polygon_room(to)) return false;
  mpq_set(to->corner[to->count].at[0], a->at[0]);
  mpq_set(to->corner[to->count].at[1], a->at[1]);
  to->count++;
  return true;
}

/* The part of `from` that is as near to k as to l. */
static bool polygon_cut(clip_polygon *to, const clip_polygon *from, const dyd_clip_point *k, const dyd_clip_point *l) {
  mpq_t f, g;
  bool good = true;
  mpq_inits(f, g, NULL);
  to->count = 0;
  for (size_t q = 0; q < from->count && good; q++) {
    const clip_corner *a = &from->corner[q], *b = &from->corner[(q + 1) % from->count];
    nearer_by(f, a, k, l);
    nearer_by(g, b, k, l);
    if (mpq_sgn(f) >= 0) good = polygon_keep(to, a);
    if (good && mpq_sgn(f) * mpq_sgn(g) < 0) good = polygon_between(to, a, b, f, g);
  }
  mpq_clears(f, g, NULL);
  return good;
}

/* Is the point k as far as the level? */
static bool corner_has_room(const dyd_clip *c, const clip_corner *m, const dyd_clip_point *k) {
  mpq_t sum, t;
  mpq_inits(sum, t, NULL);
  for (int axis = 0; axis < 2; axis++) {
    mpq_set_z(t, k->at[axis]);
    mpq_sub(t, m->at[axis], t);
    mpq_mul(t, t, t);
    mpq_add(sum, sum, t);
    mpq_set_z(t, c->level[axis]);
    mpq_sub(t, m->at[axis], t);
    mpq_mul(t, t, t);
    if (!c->flat[axis]) mpq_sub(sum, sum, t);
  }
  bool room = mpq_sgn(sum) >= 0;
  mpq_clears(sum, t, NULL);
  return room;
}

/* Where k is the nearest of all. */
static bool point_has_room(bool *room, const dyd_clip *c, clip_polygon p[2], size_t k) {
  int now = 0;
  if (!polygon_box(&p[0], c->box)) return false;
  for (size_t l = 0; l < c->count && p[now].count; l++) {
    if (l == k) continue;
    if (!polygon_cut(&p[!now], &p[now], &c->point[k], &c->point[l])) return false;
    now = !now;
  }
  for (size_t q = 0; q < p[now].count && !*room; q++) *room = corner_has_room(c, &p[now].corner[q], &c->point[k]);
  return true;
}

bool dyd_clip_has_room(bool *room, const dyd_clip *c) {
  clip_polygon p[2] = {{0}, {0}};
  bool good = true;
  *room = c->count == 0;
  for (size_t k = 0; k < c->count && good && !*room; k++) good = point_has_room(room, c, p, k);
  polygon_clear(&p[0]);
  polygon_clear(&p[1]);
  return good;
}
