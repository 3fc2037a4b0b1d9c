/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The polygons of a cell in dyadics, from its exact boundary. In a window no chain means no cell: where the cell is all
 * of the window, its chain is the window's sides.
 *
 * Samples of the boundary are moved a little off it, rounded, and proved exactly; where rounding spoils one, it is
 * taken anew with more bits. This ends: inwards, the samples move towards a point g inside the open convex set Int_i n
 * W, so that the segment's end has a disc around it inside the set; outwards, they move along the ray from their
 * nearest point of R_i, on which ds_i grows by the length of the step and every dl_k by less, unless R_k meets R_i.
 *
 * Moves are at most 2^-(bits+2), chords are within 2^-(bits+1) of their arcs. [POLY-1] [POLY-2] */
#include "base/alloc.h"
#include "dyadic/raw.h"
#include "rect/rect.h"
#include "voronoi/exact_cell.h"
#include "voronoi/polygon.h"
#include "voronoi/sample.h"
#include "voronoi/shape.h"

/* FINER: bits by which polygons that cross themselves are made finer. Parabolas take twice as many chords for two bits,
 * so what was too coarse costs less than what is fine enough. */
enum { FIRST_EXTRA = 8, MOST_EXTRA = 1 << 15, MOST_ANEW = 1 << 13, FINER = 2 };

typedef struct work {
  dyd_cell_sites sites;
  uint32_t own;
  const dyd_rect *window;
  int64_t bits;
  const volatile int *cancel;
  dyd_room *room;
  dyd_boundary boundary;
  dyd_arc_samples samples;
  dyd_point goal; /* of inward moves: a point inside */
  mpq_t x, y, s, t;
} work;

/* On a window, or one as wide as that. */
static dyd_status polygon_work_init(work *w, const dyd_delaunay *pd, uint32_t i, const dyd_rect *rect,
                                    const dyd_window *window, int64_t bits) {
  *w = (work){.own = i, .window = rect, .bits = bits, .cancel = window->cancel, .room = window->room};
  dyd_point_init(&w->goal);
  mpq_inits(w->x, w->y, w->s, w->t, NULL);
  return dyd_cell_sites_init(&w->sites, pd, i);
}

static void polygon_work_clear(work *w) {
  mpq_clears(w->x, w->y, w->s, w->t, NULL);
  dyd_point_clear(&w->goal);
  free(w->samples.item);
  dyd_boundary_clear(&w->boundary);
  dyd_cell_sites_clear(&w->sites);
}

/* z += (x, y) 2^-shift with shift such that the move has between 2^-(bits+5) and 2^-(bits+2), or the whole of (x, y) if
 * that is shorter and not `stretch`; rounded to multiples of 2^-fine. */
static dyd_status move_by_step(dyd_point *z, work *w, bool stretch, int64_t fine) {
  int64_t shift = dyd_log2_length(w->x, w->y) + w->bits + 2;
  if (shift < 1 && !stretch) shift = 1;
  for (int axis = 0; axis < 2; axis++) {
    mpq_ptr d = axis ? w->y : w->x;
    if (shift >= 0)
      mpq_div_2exp(d, d, (mp_bitcnt_t)shift);
    else
      mpq_mul_2exp(d, d, (mp_bitcnt_t)-shift);
    dyd_dyadic_get_q(w->s, axis ? &z->y : &z->x);
    mpq_add(d, d, w->s);
    dyd_status st = dyd_dyadic_round_q(axis ? &z->y : &z->x, d, -fine, DYD_DOWN);
    if (st != DYD_OK) return st;
  }
  return DYD_OK;
}

/* ---- inward ---- */

/* goal = the mean of the samples, rounded: inside when fine is large enough. */
static dyd_status find_inner_goal(bool *out, work *w, int64_t fine) {
  dyd_point z;
  dyd_point_init(&z);
  mpq_t x, y;
  mpq_inits(x, y, NULL);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < w->samples.count && st == DYD_OK; k++) {
    if (dyd_flag_is_set(w->cancel)) st = DYD_CANCELLED;
    if (st == DYD_OK) st = dyd_sample_point(&z, &w->samples.item[k], &w->sites, w->own, fine);
    dyd_dyadic_get_q(w->s, &z.x);
    mpq_add(x, x, w->s);
    dyd_dyadic_get_q(w->s, &z.y);
    mpq_add(y, y, w->s);
  }
  mpq_set_ui(w->s, w->samples.count, 1);
  mpq_div(x, x, w->s);
  mpq_div(y, y, w->s);
  if (st == DYD_OK) st = dyd_dyadic_round_q(&w->goal.x, x, -fine, DYD_DOWN);
  if (st == DYD_OK) st = dyd_dyadic_round_q(&w->goal.y, y, -fine, DYD_DOWN);
  *out = st == DYD_OK && dyd_rect_holds(w->window, &w->goal) && dyd_cell_holds(&w->sites, &w->goal);
  mpq_clears(x, y, NULL);
  dyd_point_clear(&z);
  return st;
}

static dyd_status place_inner(bool *out, dyd_point *z, work *w, const dyd_arc_sample *at, int64_t fine) {
  dyd_status st = dyd_sample_point(z, at, &w->sites, w->own, fine);
  if (st != DYD_OK) return st;
  dyd_dyadic_get_q(w->s, &z->x);
  dyd_dyadic_get_q(w->x, &w->goal.x);
  mpq_sub(w->x, w->x, w->s);
  dyd_dyadic_get_q(w->s, &z->y);
  dyd_dyadic_get_q(w->y, &w->goal.y);
  mpq_sub(w->y, w->y, w->s);
  st = move_by_step(z, w, false, fine);
  *out = st == DYD_OK && dyd_rect_holds(w->window, z) && dyd_cell_holds(&w->sites, z);
  return st;
}

/* ---- outward ---- */

/* (x, y) = z minus its nearest point in R_i. */
static void set_away(work *w, const dyd_point *z) {
  const dyd_rect *r = &w->sites.own;
  for (int axis = 0; axis < 2; axis++) {
    mpq_ptr d = axis ? w->y : w->x;
    dyd_interval_get_q(w->s, w->t, axis ? &r->y : &r->x);
    dyd_dyadic_get_q(d, axis ? &z->y : &z->x);
    if (mpq_cmp(d, w->s) <= 0)
      mpq_sub(d, d, w->s);
    else if (mpq_cmp(d, w->t) >= 0)
      mpq_sub(d, d, w->t);
    else
      mpq_set_ui(d, 0, 1);
  }
}

/* Is z in C_ki for the far site k of the arc? Window arcs ask nothing. */
static bool beyond_arc(const work *w, const dyd_arc *arc, const dyd_point *z) {
  return arc->kind == DYD_ARC_WINDOW ||
         dyd_nearer(z, dyd_cell_site(&w->sites, arc->far_site), &w->sites.own) == DYD_TRUE;
}

static dyd_status place_outer(bool *out, dyd_point *z, work *w, const dyd_arc_sample *at, int64_t fine) {
  dyd_status st = dyd_sample_point(z, at, &w->sites, w->own, fine);
  if (st != DYD_OK) return st;
  if (at->arc->kind == DYD_ARC_WINDOW && at->before->kind == DYD_ARC_WINDOW) {
    *out = true; /* a corner of W: its edges need no proof */
    return DYD_OK;
  }
  set_away(w, z);
  st = move_by_step(z, w, true, fine);
  *out = st == DYD_OK && beyond_arc(w, at->arc, z) && beyond_arc(w, at->before, z);
  return st;
}

/* ---- both ---- */

typedef dyd_status (*place_fn)(bool *out, dyd_point *z, work *w, const dyd_arc_sample *at, int64_t fine);

/* Proved points for all samples. */
static dyd_status place_samples(dyd_polygon *out, work *w, place_fn place, int64_t extra) {
  const dyd_arc_samples *all = &w->samples;
  out->vertex = dyd_alloc(all->count, sizeof *out->vertex);
  if (!out->vertex) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  for (; out->count < all->count && st == DYD_OK; out->count++) {
    dyd_point *z = &out->vertex[out->count];
    dyd_point_init(z);
    bool done = false;
    if (dyd_flag_is_set(w->cancel)) st = DYD_CANCELLED;
    for (int64_t e = extra; !done && st == DYD_OK; e *= 2)
      st = e > MOST_EXTRA ? DYD_E_RANGE : place(&done, z, w, &all->item[out->count], w->bits + e);
  }
  return st;
}

static dyd_status exact_inner(dyd_polygon *out, work *w) {
  bool found = false;
  dyd_status st = dyd_chain_samples(&w->samples, &w->boundary.chain[0], &w->sites, w->own, w->bits + 1, w->room);
  for (int64_t extra = FIRST_EXTRA; !found && st == DYD_OK; extra *= 2)
    st = extra > MOST_EXTRA ? DYD_E_RANGE : find_inner_goal(&found, w, w->bits + extra);
  if (st == DYD_OK) st = place_samples(out, w, place_inner, FIRST_EXTRA);
  return st == DYD_OK ? dyd_polygon_make_convex(out) : st;
}

dyd_status dyd_exact_inner(dyd_polygon *out, const dyd_delaunay *pd, uint32_t i, const dyd_window *window,
                           int64_t bits) {
  work w;
  dyd_polygon polygon = {0};
  dyd_status st = polygon_work_init(&w, pd, i, window->rect, window, bits);
  if (st == DYD_OK) st = dyd_cell_region(&w.boundary, pd, i, false, window->rect, w.room, w.cancel);
  if (st == DYD_OK && w.boundary.count) st = exact_inner(&polygon, &w);
  if (st == DYD_OK) {
    dyd_polygon_clear(out);
    *out = polygon;
    polygon = (dyd_polygon){0};
  }
  dyd_polygon_clear(&polygon);
  polygon_work_clear(&w);
  return st;
}

/* One part; taken anew with more bits while it crosses itself. Where arcs come nearer to each other than samples of
 * that number can follow, scales are too far apart for polygons: DYD_E_RANGE. */
static dyd_status exact_outer_part(dyd_polygon *out, work *w, const dyd_chain *chain) {
  int64_t bits = w->bits;
  bool simple = false;
  dyd_status st = DYD_OK;
  for (int64_t extra = 0; !simple && st == DYD_OK; extra += FINER) {
    if (extra > MOST_EXTRA) return DYD_E_RANGE;
    dyd_polygon_clear(out);
    w->samples.count = 0;
    w->bits = bits + extra;
    st = dyd_chain_samples(&w->samples, chain, &w->sites, w->own, w->bits + 1, w->room);
    if (st == DYD_OK && extra > 0 && w->samples.count > MOST_ANEW) st = DYD_E_RANGE;
    if (st == DYD_OK) st = place_samples(out, w, place_outer, FIRST_EXTRA);
    if (st == DYD_OK) st = dyd_polygon_is_simple(&simple, out, w->cancel);
  }
  w->bits = bits;
  return st;
}

/* A polygon that comes out clockwise winds round no point of Pos_i n W: its part was outside of W, and is left out. */
static dyd_status drop_if_clockwise(dyd_polygon_list *l) {
  dyd_dyadic area2;
  dyd_dyadic_init(&area2);
  dyd_status st = dyd_polygon_area2(&area2, &l->item[l->count - 1]);
  if (st == DYD_OK && dyd_dyadic_sgn(&area2) <= 0) dyd_polygon_clear(&l->item[--l->count]);
  dyd_dyadic_clear(&area2);
  return st;
}

static dyd_status exact_outer_parts(dyd_polygon_list *out, work *w) {
  dyd_polygon_list_clear(out);
  out->item = calloc(w->boundary.count, sizeof *out->item);
  if (!out->item) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < w->boundary.count && st == DYD_OK; k++) {
    st = exact_outer_part(&out->item[out->count++], w, &w->boundary.chain[k]);
    if (st == DYD_OK) st = drop_if_clockwise(out);
  }
  return st;
}

/* Cut to W; taken anew with more bits while that spoils one. */
static dyd_status exact_outer(dyd_polygon_list *out, work *w, const dyd_rect *window) {
  int64_t bits = w->bits;
  bool simple = false;
  dyd_status st = DYD_OK;
  for (int64_t extra = 0; !simple && st == DYD_OK; extra += FINER) {
    if (extra > MOST_EXTRA) return DYD_E_RANGE;
    w->bits = bits + extra;
    st = exact_outer_parts(out, w);
    if (st == DYD_OK) st = dyd_polygons_clip(&simple, out, window, w->bits + DYD_CLIP_EXTRA, w->cancel);
  }
  w->bits = bits;
  return st;
}

dyd_status dyd_window_enlarge(dyd_rect *out, const dyd_rect *window, int64_t bits) {
  dyd_dyadic margin;
  dyd_dyadic_init(&margin);
  dyd_status st = dyd_dyadic_set_si_2exp(&margin, 1, -(bits + 1));
  dyd_rect_set(out, window);
  for (int axis = 0; axis < 2 && st == DYD_OK; axis++) {
    dyd_interval *side = axis ? &out->y : &out->x;
    st = dyd_dyadic_sub(&side->lo, &side->lo, &margin);
    if (st == DYD_OK) st = dyd_dyadic_add(&side->hi, &side->hi, &margin);
  }
  dyd_dyadic_clear(&margin);
  return st;
}

dyd_status dyd_exact_outer(dyd_polygon_list *out, const dyd_delaunay *pd, uint32_t i, const dyd_window *window,
                           int64_t bits) {
  work w;
  dyd_polygon_list list = {0};
  dyd_rect wide;
  dyd_rect_init(&wide);
  dyd_status st = polygon_work_init(&w, pd, i, &wide, window, bits);
  if (st == DYD_OK) st = dyd_window_enlarge(&wide, window->rect, bits);
  if (st == DYD_OK) st = dyd_cell_region(&w.boundary, pd, i, true, &wide, w.room, w.cancel);
  if (st == DYD_OK && w.boundary.count) st = exact_outer(&list, &w, window->rect);
  if (st == DYD_OK) {
    dyd_polygon_list_clear(out);
    *out = list;
    list = (dyd_polygon_list){0};
  }
  dyd_polygon_list_clear(&list);
  polygon_work_clear(&w);
  dyd_rect_clear(&wide);
  return st;
}
