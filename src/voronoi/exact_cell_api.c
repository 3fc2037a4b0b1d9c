/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact bisectors and cells, as asked by callers.
 *
 * [CELL-2] Under every choice the true cell of i is bounded by its Delaunay neighbours, which are possible neighbours.
 * So a point nearer to R_i than to all possible neighbours is in every true cell, hence in Int_i; and a point of Ext_i,
 * under the choice with p_i closest to it and all others farthest, is nearer to some Delaunay neighbour of i, hence in
 * C_ji for a possible neighbour j. No other site matters. */
#include "base/alloc.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "predicate/circle.h"
#include "predicate/predicate_filter.h"
#include "voronoi/exact_cell.h"
#include "voronoi/sample.h"

#include <dyadel/voronoi.h>
#include <string.h>

/* ---- pruning: which of many others bound a cell in a window ----
 *
 * The rest is removed before the exact work, which is cubic in their number.
 *
 * Let A be some of the others, G_A the closure of the interior of their region in the window (of its part in the window
 * that has area). Its boundary consists of the pieces that A gives; if other k has D_k > r on all of these, closed,
 * then D_k > r on G_A, and k neither has pieces of its own nor takes any away, whatever is added to A [PRUNE-1]. So A
 * starts with the neighbours in the skeleton; every other is compared with the pieces of A once, and either
 * removed, or taken into A, or kept without use. One of A that no longer touches the pieces is removed as well.
 *
 * D_k > r on a piece: it lies in the box of its ends, as arcs are monotone in both coordinates [ARC-1], which doubles
 * may tell. For Int, D_k > r is the convex C_ik, so the ends of a straight piece tell. For Pos, dl_k >= |c - x| for a
 * corner x of R_k, while ds_i = dl_j = |c - s| on the curve of j with far corner s, and ds_i <= |c - y| for a corner y
 * of R_i; a difference of two squares of such is linear in c, so the ends of a straight piece tell again. Else both
 * ends tell if no critical circle of i, j, k has its centre on the piece. In doubt the other is kept. */

/* FEW: below, the exact work is quicker than pruning. */
enum { FEW = 16, BATCH = 12, MOST_PICKS = 48, MOST_REBUILDS = 80 };

typedef enum relation { CLEAR, TOUCHES, CUTS } relation;

/* State of an other: not compared yet, removed, kept, in A, cuts a piece. */
enum { NEW, OUT, KEPT, PICKED, CUTTING };

/* sub: the pieces of the region of c->other[pick[..picks)], everything else borrowed from c. built: how many of pick
 * that was; the ones removed since do not change the region. */
typedef struct prune {
  dyd_exact_cell sub;
  dyd_cell_task task;
  const dyd_exact_cell *c;
  dyd_icircle circle[DYD_CELL_CIRCLES];
  size_t *pick, picks, rebuilds;
  uint8_t *state;
  bool joined; /* members that no longer touch may leave A */
} prune;

/* ---- one piece ---- */

/* The corner `which` as a rectangle, limbs borrowed. */
static dyd_irect corner_of_irect(const dyd_irect *r, int which) {
  const __mpz_struct *x = which & 1 ? r->x1 : r->x0, *y = which & 2 ? r->y1 : r->y0;
  return (dyd_irect){{*x}, {*x}, {*y}, {*y}};
}

/* |c - x| > |c - y| at both ends of the piece? Then everywhere on it, if it is straight. */
static bool both_farther(const dyd_piece *p, const dyd_irect *x, const dyd_irect *y) {
  return dyd_surd_point_side(&p->begin->at, x, DYD_CLOSEST, y, DYD_CLOSEST) > 0 &&
         dyd_surd_point_side(&p->end->at, x, DYD_CLOSEST, y, DYD_CLOSEST) > 0;
}

/* Pos, a straight piece: is some corner of k farther than a point that bounds the radius from above? */
static bool corner_is_farther(const prune *f, const dyd_piece *p, size_t k) {
  for (int a = 0; a < 4; a++) {
    dyd_irect x = corner_of_irect(&f->c->other[k].r, a);
    if (p->arc) {
      dyd_irect s = {{p->arc->s[0][0]}, {p->arc->s[0][0]}, {p->arc->s[1][0]}, {p->arc->s[1][0]}};
      if (both_farther(p, &x, &s)) return true;
    }
    for (int b = 0; b < 4 && !p->arc; b++) {
      dyd_irect y = corner_of_irect(&f->c->frame->fixed.r, b);
      if (both_farther(p, &x, &y)) return true;
    }
  }
  return false;
}

/* Is the centre of no critical circle with k on the piece of an arc? */
static bool no_circle_on_piece(prune *f, const dyd_piece *p, size_t k) {
  const dyd_touch touch[3] = {f->c->frame->fixed_touch, f->c->frame->other_touch, f->c->frame->other_touch};
  const dyd_irect *r[3] = {&f->c->frame->fixed.r, &f->sub.other[p->curve].r, &f->c->other[k].r};
  size_t found = dyd_icircles(f->circle, DYD_CELL_CIRCLES, r, touch);
  if (found >= DYD_CELL_CIRCLES) return false;
  bool forward = p->begin == &p->arc->end[0] || dyd_cell_spot_cmp(p->begin, p->end, p->arc->axis) < 0;
  const dyd_spot *low = forward ? p->begin : p->end, *high = forward ? p->end : p->begin;
  for (size_t m = 0; m < found; m++) {
    const dyd_icircle *o = &f->circle[m];
    dyd_spot at = {.at = {{o->ax[0]}, {o->bx[0]}, {o->ay[0]}, {o->by[0]}, {o->c[0]}, {o->d[0]}}}; /* borrowed limbs */
    dyd_filter_spot_box(&at, f->c->frame->shift);
    if (dyd_elementary_holds(p->arc, &at) && dyd_cell_spot_cmp(&at, low, p->arc->axis) >= 0 &&
        dyd_cell_spot_cmp(&at, high, p->arc->axis) <= 0)
      return false;
  }
  return true;
}

static relation prune_against_piece(prune *f, const dyd_piece *p, size_t k) {
  const dyd_exact_cell *c = f->c;
  bool outer = c->task->outer, straight = !p->arc || !p->arc->parabola;
  dyd_spot hull;
  dyd_filter_spot_span(&hull, p->begin, p->end);
  if (dyd_filter_side(&hull, &c->other[k].box, c->frame->other_touch, &c->frame->fixed.box, c->frame->fixed_touch) > 0)
    return CLEAR;
  if (outer && straight && corner_is_farther(f, p, k)) return CLEAR;
  int begin = dyd_cell_spot_side(c, p->begin, k), end = dyd_cell_spot_side(c, p->end, k);
  if (begin < 0 || end < 0) return CUTS;
  if (!begin || !end) return TOUCHES;
  if (straight && !outer) return CLEAR;
  return p->arc && no_circle_on_piece(f, p, k) ? CLEAR : TOUCHES;
}

static relation prune_against(prune *f, size_t k) {
  relation all = CLEAR;
  for (size_t p = 0; p < f->sub.pieces && all != CUTS; p++) {
    relation one = prune_against_piece(f, &f->sub.piece[p], k);
    if (one > all) all = one;
  }
  return all;
}

/* ---- A ---- */

static dyd_status prune_rebuild(prune *f) {
  dyd_cell_forget(&f->sub);
  f->rebuilds++;
  f->sub.count = f->picks;
  for (size_t m = 0; m < f->picks; m++) {
    f->sub.other[m] = f->c->other[f->pick[m]];
    f->sub.site[m] = f->c->site[f->pick[m]];
  }
  return dyd_cell_find_pieces(&f->sub);
}

/* Those of A that do not touch the pieces leave it. */
static void prune_release(prune *f) {
  size_t kept = 0;
  for (size_t m = 0; m < f->picks; m++) {
    size_t k = f->pick[m];
    if (prune_against(f, k) == CLEAR)
      f->state[k] = OUT;
    else
      f->pick[kept++] = k;
  }
  f->picks = kept;
}

/* Takes some of those marked CUTTING into A, far apart in the order of the sites; keeps them all when A is full. */
static dyd_status prune_take_some(prune *f, size_t cutting) {
  size_t room = MOST_PICKS - f->picks, batch = room < BATCH ? room : BATCH, seen = 0, taken = 0;
  if (f->rebuilds == MOST_REBUILDS) batch = 0;
  for (size_t k = 0; k < f->c->count; k++) {
    if (f->state[k] != CUTTING) continue;
    bool due = batch > 0 && seen++ * batch >= taken * cutting;
    f->state[k] = !batch ? KEPT : due && taken < batch ? PICKED : NEW;
    if (f->state[k] != PICKED) continue;
    f->pick[f->picks++] = k;
    taken++;
  }
  if (!taken) return DYD_OK;
  dyd_status st = prune_rebuild(f);
  if (st == DYD_OK && f->joined && f->sub.pieces) prune_release(f);
  return st;
}

static void pick_site(prune *f, uint32_t site) {
  for (size_t k = 0; k < f->c->count && f->picks < MOST_PICKS / 4; k++)
    if (f->c->site[k] == site && f->state[k] == NEW) {
      f->pick[f->picks++] = k;
      f->state[k] = PICKED;
    }
}

/* A good guess: the neighbours of the cell in the skeleton. */
static void pick_skeleton(prune *f) {
  if (!f->c->task->pd) return;
  const dyd_skeleton *sk = &f->c->task->pd->sk;
  dyd_half_edge first = sk->leaving[sk->vertex[f->c->task->site]], h = first;
  while (h != DYD_NONE) {
    uint32_t v = dyd_edge_target(&sk->mesh, h);
    if (v != sk->mesh.n) pick_site(f, sk->reps.site[v]);
    h = dyd_edge_turn(&sk->mesh, h);
    if (h == first) break;
  }
}

/* ---- all ---- */

static bool holds_strictly(const dyd_irect *w, const dyd_irect *r) {
  return mpz_cmp(w->x0, r->x0) < 0 && mpz_cmp(r->x1, w->x1) < 0 && mpz_cmp(w->y0, r->y0) < 0 &&
         mpz_cmp(r->y1, w->y1) < 0;
}

static dyd_status prune_init(prune *f, const dyd_exact_cell *c) {
  memset(f, 0, sizeof *f);
  f->c = c;
  f->task = *c->task;
  f->task.pd = NULL; /* pairs of A may meet on its region though they do not on the cell */
  f->joined = !c->task->outer || holds_strictly(&c->frame->window.r, &c->frame->fixed.r);
  dyd_cell_init(&f->sub, &f->task, c->frame);
  f->sub.other = dyd_alloc(MOST_PICKS, sizeof *f->sub.other);
  f->sub.site = dyd_alloc(MOST_PICKS, sizeof *f->sub.site);
  for (int m = 0; m < DYD_CELL_CIRCLES; m++) dyd_icircle_init(&f->circle[m]);
  f->pick = dyd_alloc(MOST_PICKS, sizeof *f->pick);
  f->state = calloc(c->count, sizeof *f->state);
  return f->sub.other && f->sub.site && f->pick && f->state ? DYD_OK : DYD_E_NOMEM;
}

static void prune_clear(prune *f) {
  free(f->state);
  free(f->pick);
  for (int m = DYD_CELL_CIRCLES; m-- > 0;) dyd_icircle_clear(&f->circle[m]);
  dyd_cell_clear(&f->sub);
}

/* Compares all that are NEW with the pieces; how many cut them. Without pieces the region is empty, whatever comes. */
static size_t prune_compare_all(prune *f) {
  static const uint8_t next[] = {[CLEAR] = OUT, [TOUCHES] = KEPT, [CUTS] = CUTTING};
  size_t cutting = 0;
  for (size_t k = 0; k < f->c->count && !dyd_flag_is_set(f->task.cancel); k++) {
    if (f->state[k] != NEW) continue;
    f->state[k] = next[f->sub.pieces ? prune_against(f, k) : CLEAR];
    cutting += f->state[k] == CUTTING;
  }
  return cutting;
}

/* Decides about every other. */
static dyd_status prune_decide(prune *f) {
  pick_skeleton(f);
  dyd_status st = prune_rebuild(f);
  for (size_t cutting = 1; st == DYD_OK && cutting;) {
    cutting = prune_compare_all(f);
    if (dyd_flag_is_set(f->task.cancel)) return DYD_CANCELLED;
    if (cutting) st = prune_take_some(f, cutting);
  }
  return st;
}

static void prune_compact(dyd_exact_cell *c, const uint8_t *state) {
  size_t kept = 0;
  for (size_t k = 0; k < c->count; k++) {
    dyd_scaled t = c->other[kept];
    if (state[k] == OUT) continue;
    c->other[kept] = c->other[k];
    c->other[k] = t;
    c->site[kept++] = c->site[k];
  }
  for (size_t k = kept; k < c->count; k++) dyd_irect_clear(&c->other[k].r);
  c->count = kept;
}

dyd_status dyd_cell_prune(dyd_exact_cell *c) {
  if (!c->task->windowed || c->task->keep_all || c->count <= FEW) return DYD_OK;
  prune f;
  dyd_status st = prune_init(&f, c);
  if (st == DYD_OK) st = prune_decide(&f);
  if (st == DYD_OK) prune_compact(c, f.state);
  prune_clear(&f);
  return st;
}

/* *site = the site that i is an alias of, or i. */
static dyd_status find_cell_site(uint32_t *site, const dyd_delaunay *pd, uint32_t i) {
  if (i >= dyd_sites_count(dyd_delaunay_sites(pd))) return DYD_E_ARG;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  *site = dyd_delaunay_alias(pd, i);
  return DYD_OK;
}

static bool window_has_area(const dyd_rect *w) {
  return dyd_dyadic_cmp(&w->x.lo, &w->x.hi) < 0 && dyd_dyadic_cmp(&w->y.lo, &w->y.hi) < 0;
}

/* The region of `site` among the sites s of its cell; window: NULL for the whole plane. */
static dyd_status cell_region_among(dyd_boundary *out, const dyd_delaunay *pd, const dyd_cell_sites *s, uint32_t site,
                                    bool outer, const dyd_rect *window, dyd_room *room, const volatile int *cancel) {
  const dyd_rect **in = dyd_alloc(s->count + 2, sizeof *in);
  if (!in) return DYD_E_NOMEM;
  in[0] = &s->own;
  for (size_t k = 0; k < s->count; k++) in[k + 1] = &s->other[k];
  in[s->count + 1] = window;
  dyd_cell_task task = {site, s->site, s->count, in, outer, window != NULL, pd, false, cancel, room};
  dyd_status st = dyd_cell_boundary(out, &task);
  free(in);
  return st;
}

dyd_status dyd_cell_region(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, bool outer, const dyd_rect *window,
                           dyd_room *room, const volatile int *cancel) {
  uint32_t site;
  if (window && !window_has_area(window)) return DYD_E_ARG;
  if (dyd_flag_is_set(cancel)) return DYD_CANCELLED;
  dyd_status st = find_cell_site(&site, pd, i);
  if (st != DYD_OK) return st;
  dyd_cell_sites s;
  st = dyd_cell_sites_init(&s, pd, site);
  if (st == DYD_OK) st = cell_region_among(out, pd, &s, site, outer, window, room, cancel);
  dyd_cell_sites_clear(&s);
  return st;
}

/* As the public calls want it. */
static dyd_status cell_of_caller(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, bool outer,
                                 const dyd_rect *window) {
  dyd_room room = dyd_delaunay_room(pd);
  return dyd_cell_region(out, pd, i, outer, window, &room, NULL);
}

dyd_status dyd_voronoi_int(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i) {
  if (!pd) return DYD_E_ARG;
  return cell_of_caller(out, pd, i, false, NULL);
}

dyd_status dyd_voronoi_pos(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i) {
  if (!pd) return DYD_E_ARG;
  return cell_of_caller(out, pd, i, true, NULL);
}

dyd_status dyd_voronoi_int_on(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, const dyd_rect *window) {
  if (!pd) return DYD_E_ARG;
  return window ? cell_of_caller(out, pd, i, false, window) : DYD_E_ARG;
}

dyd_status dyd_voronoi_pos_on(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, const dyd_rect *window) {
  if (!pd) return DYD_E_ARG;
  return window ? cell_of_caller(out, pd, i, true, window) : DYD_E_ARG;
}

dyd_status dyd_bisector(dyd_boundary *out, const dyd_rect *a, const dyd_rect *b) {
  const uint32_t other = 1;
  const dyd_rect *in[2] = {a, b};
  dyd_cell_task task = {0, &other, 1, in, false, false, NULL, false, NULL, NULL};
  return dyd_cell_boundary(out, &task);
}

/* ---- points ---- */

/* TRUE unless some neighbour says otherwise. */
static dyd_truth side_of_cell(const dyd_cell_sites *s, const dyd_point *c) {
  dyd_truth answer = DYD_TRUE;
  for (size_t k = 0; k < s->count && answer != DYD_FALSE; k++) {
    dyd_truth one = dyd_nearer(c, &s->own, &s->other[k]);
    if (one != DYD_TRUE) answer = one;
  }
  return answer;
}

dyd_status dyd_cell_point_side(dyd_truth *out, const dyd_delaunay *pd, uint32_t i, const dyd_point *c) {
  uint32_t site;
  dyd_status st = find_cell_site(&site, pd, i);
  if (st != DYD_OK) return st;
  dyd_cell_sites s;
  st = dyd_cell_sites_init(&s, pd, site);
  if (st == DYD_OK) *out = side_of_cell(&s, c);
  dyd_cell_sites_clear(&s);
  return st;
}

dyd_truth dyd_voronoi_side(const dyd_delaunay *pd, uint32_t i, const dyd_point *c) {
  if (!pd) return DYD_UNKNOWN;
  dyd_truth answer = DYD_UNKNOWN;
  return dyd_cell_point_side(&answer, pd, i, c) == DYD_OK ? answer : DYD_UNKNOWN;
}
