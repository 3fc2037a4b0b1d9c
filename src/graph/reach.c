/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Neighbours among a few rectangles, in integers. */
#include "graph/reach.h"

#include "base/alloc.h"
#include "graph/clip.h"

void dyd_reach_init(dyd_reach *r) {
  *r = (dyd_reach){0};
  mpz_inits(r->rho, r->d, r->e, NULL);
}

void dyd_reach_clear(dyd_reach *r) {
  for (size_t k = 0; k < r->made; k++) {
    dyd_rect_clear(&r->rect[k]);
    dyd_irect_clear(&r->grid[k]);
  }
  free(r->rect);
  free(r->in);
  free(r->grid);
  free(r->mark);
  mpz_clears(r->rho, r->d, r->e, NULL);
}

/* ---- loading ---- */

static bool reach_room(dyd_reach *r, size_t count) {
  size_t cap[4] = {r->made, r->made, r->made, r->made};
  if (count <= r->made) return true;
  if (!dyd_reserve((void **)&r->rect, &cap[0], count, sizeof *r->rect) ||
      !dyd_reserve((void **)&r->in, &cap[1], count, sizeof *r->in) ||
      !dyd_reserve((void **)&r->grid, &cap[2], count, sizeof *r->grid) ||
      !dyd_reserve((void **)&r->mark, &cap[3], count, sizeof *r->mark))
    return false;
  for (; r->made < cap[0]; r->made++) {
    dyd_rect_init(&r->rect[r->made]);
    dyd_irect_init(&r->grid[r->made]);
  }
  for (size_t k = 0; k < r->made; k++) r->in[k] = &r->rect[k];
  return true;
}

static void times_four(dyd_irect *g) {
  mpz_mul_2exp(g->x0, g->x0, 2);
  mpz_mul_2exp(g->x1, g->x1, 2);
  mpz_mul_2exp(g->y0, g->y0, 2);
  mpz_mul_2exp(g->y1, g->y1, 2);
}

dyd_status dyd_reach_load(dyd_reach *r, const dyd_sites *sites, uint32_t i, const uint32_t *other, size_t count) {
  if (!reach_room(r, count + 1)) return DYD_E_NOMEM;
  dyd_status st = dyd_sites_get(&r->rect[0], sites, i);
  for (size_t k = 0; k < count && st == DYD_OK; k++) st = dyd_sites_get(&r->rect[k + 1], sites, other[k]);
  if (st != DYD_OK) return st;
  r->count = count + 1;
  dyd_irects_scale(r->grid, r->in, r->count, NULL, NULL);
  for (size_t k = 0; k < r->count; k++) times_four(&r->grid[k]);
  return DYD_OK;
}

/* ---- for every choice ---- */

/* Corner c of a rectangle. */
static mpz_srcptr corner_x(const dyd_irect *g, int c) {
  return dyd_irect_end(g, 0, c & 1);
}
static mpz_srcptr corner_y(const dyd_irect *g, int c) {
  return dyd_irect_end(g, 1, c >> 1);
}

/* dl_j^2 - ds_k^2 is a maximum of functions that are affine in x: largest at a corner of R_0. */
bool dyd_reach_is_nearest(dyd_reach *r, size_t j) {
  for (int c = 0; c < 4; c++) {
    mpz_srcptr x = corner_x(&r->grid[0], c), y = corner_y(&r->grid[0], c);
    dyd_irect_dl2(r->d, x, y, &r->grid[j]);
    for (size_t k = 1; k < r->count; k++) {
      if (k == j) continue;
      dyd_irect_ds2(r->e, x, y, &r->grid[k]);
      if (mpz_cmp(r->d, r->e) >= 0) return false;
    }
  }
  return true;
}

/* *least = min (z - x)(z - y) over the sides of a, b, k along an axis: x and y at ends, since it is affine in each; z
 * as near as can be to their middle. */
static void least_product(mpz_ptr least, mpz_ptr z, mpz_ptr t, const dyd_irect *a, const dyd_irect *b,
                          const dyd_irect *k, int axis) {
  for (int c = 0; c < 4; c++) {
    mpz_srcptr x = dyd_irect_end(a, axis, c & 1), y = dyd_irect_end(b, axis, c >> 1);
    mpz_add(z, x, y);
    mpz_fdiv_q_2exp(z, z, 1);
    if (mpz_cmp(z, dyd_irect_end(k, axis, 0)) < 0) mpz_set(z, dyd_irect_end(k, axis, 0));
    if (mpz_cmp(z, dyd_irect_end(k, axis, 1)) > 0) mpz_set(z, dyd_irect_end(k, axis, 1));
    mpz_sub(t, z, x);
    mpz_sub(z, z, y);
    mpz_mul(t, t, z);
    if (c == 0 || mpz_cmp(t, least) < 0) mpz_set(least, t);
  }
}

/* p_k is outside of the disc with diameter p_i p_j iff (p_k - p_i).(p_k - p_j) > 0: a sum over both coordinates, each
 * with its own variables. */
bool dyd_reach_is_gabriel(dyd_reach *r, size_t j) {
  mpz_t z;
  bool free_of_all = true;
  mpz_init(z);
  for (size_t k = 1; k < r->count && free_of_all; k++) {
    if (k == j) continue;
    least_product(r->d, z, r->rho, &r->grid[0], &r->grid[j], &r->grid[k], 0);
    least_product(r->e, z, r->rho, &r->grid[0], &r->grid[j], &r->grid[k], 1);
    mpz_add(r->d, r->d, r->e);
    free_of_all = mpz_sgn(r->d) > 0;
  }
  mpz_clear(z);
  return free_of_all;
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

/* Marks lose whoever is not too near there; is nobody? */
static bool corner_is_free(const reach_quest *q, mpz_srcptr x, mpz_srcptr y) {
  dyd_reach *r = q->r;
  bool nobody = true;
  set_rho(q, x, y);
  for (size_t k = 1; k < r->count; k++) {
    if (k == q->j) continue;
    dyd_irect_dl2(r->d, x, y, &r->grid[k]);
    if (mpz_cmp(r->d, r->rho) < 0)
      nobody = false;
    else
      r->mark[k] = false;
  }
  return nobody;
}

/* One of the corners is free; otherwise the marks say who is too near at all of them. */
static bool has_free_corner(const reach_quest *q, const dyd_irect *box) {
  for (size_t k = 0; k < q->r->count; k++) q->r->mark[k] = k && k != q->j;
  for (int c = 0; c < 4; c++)
    if (corner_is_free(q, corner_x(box, c), corner_y(box, c))) return true;
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
  dyd_clip c;
  mpz_t e[2], t, middle;
  mpz_inits(e[0], e[1], t, middle, NULL);
  dyd_clip_init(&c, box);
  for (int axis = 0; axis < 2; axis++) dyd_clip_level(&c, axis, rho_form(e[axis], t, q, box, axis) ? e[axis] : NULL);
  for (size_t k = 1; k < r->count && !q->failed; k++) {
    if (k == q->j) continue;
    mpz_srcptr far[2];
    for (int axis = 0; axis < 2; axis++) {
      const dyd_irect *g = &r->grid[k];
      mpz_add(middle, dyd_irect_end(box, axis, 0), dyd_irect_end(box, axis, 1));
      mpz_add(t, dyd_irect_end(g, axis, 0), dyd_irect_end(g, axis, 1));
      far[axis] = dyd_irect_end(g, axis, mpz_cmp(middle, t) < 0);
    }
    q->failed = !dyd_clip_add(&c, far[0], far[1]);
  }
  bool room = false;
  q->failed = q->failed || !dyd_clip_has_room(&room, &c);
  dyd_clip_clear(&c);
  mpz_clears(e[0], e[1], t, middle, NULL);
  return room;
}

static bool box_has_room(reach_quest *q, const dyd_irect *box);

static bool half_has_room(reach_quest *q, const dyd_irect *box, int axis, mpz_srcptr at) {
  dyd_irect half;
  bool room = false;
  dyd_irect_init(&half);
  for (int side = 0; side < 2 && !room; side++) {
    mpz_set(half.x0, box->x0), mpz_set(half.x1, box->x1);
    mpz_set(half.y0, box->y0), mpz_set(half.y1, box->y1);
    mpz_set(axis ? (side ? half.y0 : half.y1) : (side ? half.x0 : half.x1), at);
    room = box_has_room(q, &half);
  }
  dyd_irect_clear(&half);
  return room;
}

/* Is there a place in the box where nobody is too near? Each cut is made once on every way down. */
static bool box_has_room(reach_quest *q, const dyd_irect *box) {
  if (q->failed) return false;
  if (has_free_corner(q, box)) return true;
  mpz_t at;
  mpz_init(at);
  bool room = false, covered = false;
  int axis = find_cut(at, q, box);
  for (size_t k = 1; axis < 0 && k < q->r->count; k++) covered = covered || q->r->mark[k];
  if (axis < 0 && !covered) axis = find_middle(at, q, box);
  if (axis >= 0)
    room = half_has_room(q, box, axis, at);
  else if (!covered)
    room = leaf_has_room(q, box);
  mpz_clear(at);
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

static bool quest_has_room(reach_quest *q, const dyd_irect *box) {
  set_cuts(q);
  bool room = box_has_room(q, box);
  for (int axis = 0; axis < 2; axis++)
    for (int c = 0; c < q->cuts; c++) mpz_clear(q->cut[axis][c]);
  return room || q->failed; /* without memory nothing is denied */
}

bool dyd_reach_may_be_nearest(dyd_reach *r, size_t j) {
  reach_quest q = {.r = r, .j = j};
  return quest_has_room(&q, &r->grid[0]);
}

bool dyd_reach_may_be_gabriel(dyd_reach *r, size_t j) {
  reach_quest q = {.r = r, .j = j, .both = true};
  const dyd_irect *a = &r->grid[0], *b = &r->grid[j];
  dyd_irect middle;
  dyd_irect_init(&middle);
  mpz_add(middle.x0, a->x0, b->x0);
  mpz_add(middle.x1, a->x1, b->x1);
  mpz_add(middle.y0, a->y0, b->y0);
  mpz_add(middle.y1, a->y1, b->y1);
  mpz_fdiv_q_2exp(middle.x0, middle.x0, 1);
  mpz_fdiv_q_2exp(middle.x1, middle.x1, 1);
  mpz_fdiv_q_2exp(middle.y0, middle.y0, 1);
  mpz_fdiv_q_2exp(middle.y1, middle.y1, 1);
  bool may = quest_has_room(&q, &middle);
  dyd_irect_clear(&middle);
  return may;
}
