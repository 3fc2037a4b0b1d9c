/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs that are neighbours for some choice, exactly, in integers [NNG-1] [GAB-1].
 *
 * They are where a box has a place at which no third rectangle is too near for all choices. For the nearest neighbour
 * that is a place x in R_i with ds_j(x) <= dl_k(x) for all k; for the Gabriel graph, whose edges are diameters of empty
 * discs, a middle m of points of R_i and R_j with r(m) <= dl_k(m), r(m) half the least distance of two points with that
 * middle: by each coordinate the larger of the distances of m to both sides. So both ask whether
 *
 *     min over k of dl_k(x)^2 - rho(x),   rho = rho_x + rho_y,   rho_a = max over one or two sides of ds^2
 *
 * is anywhere in a box at least 0. Cut along the ends of the sides, and where those of two are equally far, rho_a is 0
 * or (x_a - e)^2. There dl_k^2 - rho is convex: a k that is too near at four corners is so in between. Cut through the
 * middles of the k as well, each dl_k is the distance of one corner; where that of k is the least of all, a convex
 * polygon, the convex function dl_k^2 - rho is largest at one of its corners, which are rational. */
#include "base/alloc.h"
#include "base/local.h"
#include "graph/graph.h"

/* ---- polygons in a box ---- */

typedef struct dyd_clip_point {
  mpz_t at[2];
} dyd_clip_point;

/* Points, and a level: level^2 (x, y) is the sum of (x - level[0])^2, unless flat[0], and the like of y. */
typedef struct dyd_clip {
  const dyd_irect *box; /* borrowed */
  mpz_t level[2];
  bool flat[2];
  dyd_clip_point *point;
  size_t count, cap;
} dyd_clip;

static void clip_clear(dyd_clip *c) {
  for (size_t k = 0; k < c->count; k++) mpz_clears(c->point[k].at[0], c->point[k].at[1], NULL);
  free(c->point);
  mpz_clears(c->level[0], c->level[1], NULL);
}

/* The largest level in the box against the least distance of the point to the box, both squared. */
static bool is_far(const dyd_clip *c, mpz_srcptr x, mpz_srcptr y) {
  DYD_LOCAL_NUMBERS(mpz, most, d, t);
  for (int axis = 0; axis < 2; axis++) {
    mpz_sub(d, dyd_irect_end(c->box, axis, 0), c->level[axis]);
    mpz_sub(t, dyd_irect_end(c->box, axis, 1), c->level[axis]);
    mpz_srcptr longer = mpz_cmpabs(d, t) > 0 ? d : t;
    if (!c->flat[axis]) mpz_addmul(most, longer, longer);
  }
  dyd_irect_ds2(d, x, y, c->box);
  return mpz_cmp(d, most) >= 0;
}

/* Adds a point, unless it is far enough from everywhere in the box. false: memory is exhausted. */
static bool clip_add(dyd_clip *c, mpz_srcptr x, mpz_srcptr y) {
  if (is_far(c, x, y)) return true;
  if (!DYD_GROW(c->point, c->cap, c->count + 1)) return false;
  mpz_init_set(c->point[c->count].at[0], x);
  mpz_init_set(c->point[c->count].at[1], y);
  c->count++;
  return true;
}

typedef struct clip_corner {
  mpq_t at[2];
} clip_corner;

/* Invariant: corners are initialised up to made; in order, perhaps of a segment or a point only. */
typedef struct clip_polygon {
  clip_corner *corner;
  size_t count, made, cap;
} clip_polygon;

/* One corner more; NULL: memory is exhausted. */
static clip_corner *polygon_add(clip_polygon *p) {
  if (p->count == p->made) {
    if (!DYD_GROW(p->corner, p->cap, p->made + 1)) return NULL;
    mpq_inits(p->corner[p->made].at[0], p->corner[p->made].at[1], NULL);
    p->made++;
  }
  return &p->corner[p->count++];
}

static void polygon_clear(clip_polygon *p) {
  for (size_t k = 0; k < p->made; k++) mpq_clears(p->corner[k].at[0], p->corner[k].at[1], NULL);
  free(p->corner);
}

static bool polygon_box(clip_polygon *p, const dyd_irect *box) {
  p->count = 0;
  for (int c = 0; c < 4; c++) {
    clip_corner *to = polygon_add(p);
    if (!to) return false;
    mpq_set_z(to->at[0], dyd_irect_end(box, 0, c == 1 || c == 2));
    mpq_set_z(to->at[1], dyd_irect_end(box, 1, c >= 2));
  }
  return true;
}

/* *out = 2 (k - l).m + |l|^2 - |k|^2: at least 0 where k is as near as l. */
static void nearer_by(mpq_ptr out, const clip_corner *m, const dyd_clip_point *k, const dyd_clip_point *l) {
  DYD_LOCAL_NUMBERS(mpq, s, t);
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
}

/* Adds the place between a and b where a value that is f at a and g at b, of opposite signs, is 0. */
static bool polygon_between(clip_polygon *p, const clip_corner *a, const clip_corner *b, mpq_srcptr f, mpq_srcptr g) {
  clip_corner *to = polygon_add(p);
  if (!to) return false;
  DYD_LOCAL_NUMBERS(mpq, w, t);
  mpq_sub(w, f, g);
  mpq_div(w, f, w);
  for (int axis = 0; axis < 2; axis++) {
    mpq_sub(t, b->at[axis], a->at[axis]);
    mpq_mul(t, t, w);
    mpq_add(to->at[axis], a->at[axis], t);
  }
  return true;
}

static bool polygon_keep(clip_polygon *p, const clip_corner *a) {
  clip_corner *to = polygon_add(p);
  for (int axis = 0; axis < 2 && to; axis++) mpq_set(to->at[axis], a->at[axis]);
  return to;
}

/* The part of `from` that is as near to k as to l. */
static bool polygon_cut(clip_polygon *to, const clip_polygon *from, const dyd_clip_point *k, const dyd_clip_point *l) {
  bool good = true;
  DYD_LOCAL_NUMBERS(mpq, f, g);
  to->count = 0;
  for (size_t q = 0; q < from->count && good; q++) {
    const clip_corner *a = &from->corner[q], *b = &from->corner[(q + 1) % from->count];
    nearer_by(f, a, k, l);
    nearer_by(g, b, k, l);
    if (mpq_sgn(f) >= 0) good = polygon_keep(to, a);
    if (good && mpq_sgn(f) * mpq_sgn(g) < 0) good = polygon_between(to, a, b, f, g);
  }
  return good;
}

/* Returns true if the point k is as far as the level. */
static bool corner_has_room(const dyd_clip *c, const clip_corner *m, const dyd_clip_point *k) {
  DYD_LOCAL_NUMBERS(mpq, sum, t);
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
  return mpq_sgn(sum) >= 0;
}

/* Where k is the nearest of all: a polygon, cut by one bisector after another. The squared distance to k less the
 * squared level is convex there, so it is largest at a corner. */
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

/* *room: somewhere in the box all points are at least as far as the level there. O(count^2). false: memory is
 * exhausted. */
static bool clip_has_room(bool *room, const dyd_clip *c) {
  clip_polygon p[2] = {{0}, {0}};
  bool good = true;
  *room = c->count == 0;
  for (size_t k = 0; k < c->count && good && !*room; k++) good = point_has_room(room, c, p, k);
  polygon_clear(&p[0]);
  polygon_clear(&p[1]);
  return good;
}

/* ---- for some choice ---- */

enum { REACH_CUTS = 6 };

/* rho: of the sides of j, and of R_0 where `both`. cut: where its form changes, along x and y. */
typedef struct reach_quest {
  dyd_reach *r;
  size_t j;
  bool both, failed;
  mpz_t cut[2][REACH_CUTS];
  int cuts;
} reach_quest;

/* *out = ds(t, side)^2 along an axis. */
static void side_distance2(mpz_ptr out, mpz_srcptr t, const dyd_irect *g, int axis) {
  mpz_set_ui(out, 0);
  if (mpz_cmp(t, dyd_irect_end(g, axis, 0)) < 0) mpz_sub(out, dyd_irect_end(g, axis, 0), t);
  if (mpz_cmp(t, dyd_irect_end(g, axis, 1)) > 0) mpz_sub(out, t, dyd_irect_end(g, axis, 1));
  mpz_mul(out, out, out);
}

/* q->r->rho = rho(x, y) */
static void set_rho(const reach_quest *q, mpz_srcptr x, mpz_srcptr y) {
  dyd_reach *r = q->r;
  mpz_set_ui(r->rho, 0);
  for (int axis = 0; axis < 2; axis++) {
    side_distance2(r->d, axis ? y : x, &r->grid[q->j], axis);
    if (q->both) side_distance2(r->e, axis ? y : x, &r->grid[0], axis);
    mpz_add(r->rho, r->rho, q->both && mpz_cmp(r->e, r->d) > 0 ? r->e : r->d);
  }
}

/* Clears the marks of sites that are not too near there; returns true if none is too near. */
static bool corner_is_free(const reach_quest *q, mpz_srcptr x, mpz_srcptr y) {
  dyd_reach *r = q->r;
  bool is_free = true;
  set_rho(q, x, y);
  for (size_t k = 1; k < r->count; k++) {
    if (k == q->j) continue;
    dyd_irect_dl2(r->d, x, y, &r->grid[k]);
    if (mpz_cmp(r->d, r->rho) < 0)
      is_free = false;
    else
      r->mark[k] = false;
  }
  return is_free;
}

/* Returns true if a corner is free; otherwise the marks are of those too near at all of them. */
static bool has_free_corner(const reach_quest *q, const dyd_irect *box) {
  for (size_t k = 0; k < q->r->count; k++) q->r->mark[k] = k && k != q->j;
  for (int c = 0; c < 4; c++)
    if (corner_is_free(q, dyd_irect_end(box, 0, c & 1), dyd_irect_end(box, 1, c >> 1))) return true;
  return false;
}

static bool cuts_through(const dyd_irect *box, int axis, mpz_srcptr at) {
  return mpz_cmp(dyd_irect_end(box, axis, 0), at) < 0 && mpz_cmp(at, dyd_irect_end(box, axis, 1)) < 0;
}

/* A cut of rho through the box: the axis; -1: none. */
static int find_cut(mpz_ptr at, const reach_quest *q, const dyd_irect *box) {
  for (int axis = 0; axis < 2; axis++)
    for (int c = 0; c < q->cuts; c++)
      if (cuts_through(box, axis, q->cut[axis][c])) {
        mpz_set(at, q->cut[axis][c]);
        return axis;
      }
  return -1;
}

/* The middle of some k that goes through the box. */
static int find_middle(mpz_ptr at, const reach_quest *q, const dyd_irect *box) {
  for (size_t k = 1; k < q->r->count; k++)
    for (int axis = 0; axis < 2 && k != q->j; axis++) {
      mpz_add(at, dyd_irect_end(&q->r->grid[k], axis, 0), dyd_irect_end(&q->r->grid[k], axis, 1));
      mpz_fdiv_q_2exp(at, at, 1);
      if (cuts_through(box, axis, at)) return axis;
    }
  return -1;
}

/* In a box that no cut goes through, along an axis: rho = (t - *e)^2, or false: 0. */
static bool rho_form(mpz_ptr e, mpz_ptr t, const reach_quest *q, const dyd_irect *box, int axis) {
  const dyd_irect *side[2] = {&q->r->grid[q->j], &q->r->grid[0]};
  bool any = false;
  mpz_add(t, dyd_irect_end(box, axis, 0), dyd_irect_end(box, axis, 1)); /* twice the middle */
  for (int s = 0; s <= q->both; s++) {
    mpz_mul_2exp(q->r->rho, dyd_irect_end(side[s], axis, 0), 1);
    bool below = mpz_cmp(t, q->r->rho) < 0;
    mpz_mul_2exp(q->r->e, dyd_irect_end(side[s], axis, 1), 1);
    if (!below && mpz_cmp(t, q->r->e) <= 0) continue;
    mpz_srcptr end = dyd_irect_end(side[s], axis, !below);
    mpz_sub(q->r->rho, t, below ? q->r->rho : q->r->e);
    if (!any || mpz_cmpabs(q->r->rho, q->r->d) > 0) {
      mpz_set(q->r->d, q->r->rho);
      mpz_set(e, end);
    }
    any = true;
  }
  return any;
}

/* A box in which each dl is the distance of one corner: of k, the one farthest from the middle of the box. */
static bool leaf_has_room(reach_quest *q, const dyd_irect *box) {
  dyd_reach *r = q->r;
  dyd_clip c = {.box = box};
  DYD_LOCAL_NUMBERS(mpz, t, middle);
  mpz_inits(c.level[0], c.level[1], NULL);
  for (int axis = 0; axis < 2; axis++) c.flat[axis] = !rho_form(c.level[axis], t, q, box, axis);
  for (size_t k = 1; k < r->count && !q->failed; k++) {
    if (k == q->j) continue;
    mpz_srcptr far[2];
    for (int axis = 0; axis < 2; axis++) {
      const dyd_irect *g = &r->grid[k];
      mpz_add(middle, dyd_irect_end(box, axis, 0), dyd_irect_end(box, axis, 1));
      mpz_add(t, dyd_irect_end(g, axis, 0), dyd_irect_end(g, axis, 1));
      far[axis] = dyd_irect_end(g, axis, mpz_cmp(middle, t) < 0);
    }
    q->failed = !clip_add(&c, far[0], far[1]);
  }
  bool room = false;
  q->failed = q->failed || !clip_has_room(&room, &c);
  clip_clear(&c);
  return room;
}

static bool box_has_room(reach_quest *q, const dyd_irect *box);

static bool half_has_room(reach_quest *q, const dyd_irect *box, int axis, mpz_srcptr at) {
  bool room = false;
  DYD_LOCAL(dyd_irect, half);
  for (int side = 0; side < 2 && !room; side++) {
    mpz_set(half.x0, box->x0), mpz_set(half.x1, box->x1);
    mpz_set(half.y0, box->y0), mpz_set(half.y1, box->y1);
    mpz_set(axis ? (side ? half.y0 : half.y1) : (side ? half.x0 : half.x1), at);
    room = box_has_room(q, &half);
  }
  return room;
}

/* Returns true if none is too near at some place in the box. Each cut is made once on every way down. */
static bool box_has_room(reach_quest *q, const dyd_irect *box) {
  if (q->failed) return false;
  if (has_free_corner(q, box)) return true;
  DYD_LOCAL_NUMBERS(mpz, at);
  bool room = false, covered = false;
  int axis = find_cut(at, q, box);
  for (size_t k = 1; axis < 0 && k < q->r->count; k++) covered = covered || q->r->mark[k];
  if (axis < 0 && !covered) axis = find_middle(at, q, box);
  if (axis >= 0)
    room = half_has_room(q, box, axis, at);
  else if (!covered)
    room = leaf_has_room(q, box);
  return room;
}

/* The ends of both sides, and where the distances to opposite ends are equal. */
static void set_cuts(reach_quest *q) {
  const dyd_irect *a = &q->r->grid[q->j], *b = &q->r->grid[0];
  q->cuts = q->both ? REACH_CUTS : 2;
  for (int axis = 0; axis < 2; axis++)
    for (int c = 0; c < q->cuts; c++) {
      mpz_srcptr end = dyd_irect_end(c & 2 ? b : a, axis, c & 1);
      if (c < 4) {
        mpz_init_set(q->cut[axis][c], end);
        continue;
      }
      mpz_init(q->cut[axis][c]);
      mpz_add(q->cut[axis][c], dyd_irect_end(a, axis, c & 1), dyd_irect_end(b, axis, !(c & 1)));
      mpz_fdiv_q_2exp(q->cut[axis][c], q->cut[axis][c], 1);
    }
}

bool dyd_reach_has_place(dyd_reach *r, size_t j, bool both, const dyd_irect *box) {
  reach_quest q = {.r = r, .j = j, .both = both};
  set_cuts(&q);
  bool room = box_has_room(&q, box);
  for (int axis = 0; axis < 2; axis++)
    for (int c = 0; c < q.cuts; c++) mpz_clear(q.cut[axis][c]);
  return room || q.failed; /* without memory nothing is denied */
}
