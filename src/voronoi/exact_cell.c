/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries of Int_i and Pos_i: the chains of an outline, written in the caller's coordinates. */
#include "voronoi/exact_cell.h"

#include "base/alloc.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "voronoi/outline_filter.h"
#include "voronoi/sample.h"
#include "voronoi/surd_point.h"

#include <dyadel/arc.h>
#include <dyadel/voronoi.h>

#include <stdlib.h>

#define NONE SIZE_MAX

/* ---- boundaries: chains of arcs ---- */

static void arc_init(dyd_arc *a) {
  *a = (dyd_arc){.kind = DYD_ARC_LINE};
  dyd_surd_point_init(&a->begin.at);
  dyd_surd_point_init(&a->end.at);
}

static void arc_clear(dyd_arc *a) {
  dyd_surd_point_clear(&a->end.at);
  dyd_surd_point_clear(&a->begin.at);
}

/* Appends a chain with room for `arcs` initialised arcs (count = arcs) to a boundary whose chain array has room for it.
 * NULL when memory is exhausted, nothing changed then. */
static dyd_chain *boundary_add_chain(dyd_boundary *b, size_t arcs) {
  dyd_arc *arc = dyd_alloc(arcs, sizeof *arc);
  if (!arc) return NULL;
  for (size_t k = 0; k < arcs; k++) arc_init(&arc[k]);
  dyd_chain *chain = &b->chain[b->count++];
  *chain = (dyd_chain){.count = arcs, .arc = arc};
  return chain;
}

void dyd_boundary_clear(dyd_boundary *b) {
  for (size_t c = b->count; c-- > 0;) {
    dyd_chain *chain = &b->chain[c];
    for (size_t k = chain->count; k-- > 0;) arc_clear(&chain->arc[k]);
    free(chain->arc);
  }
  free(b->chain);
  *b = (dyd_boundary){0};
}

/* ---- writing ---- */

static dyd_arc_end end_kind(dyd_outline *o, const dyd_outline_piece *p, const dyd_outline_piece *other,
                            dyd_outline_spot *at) {
  dyd_arc_end e = {.kind = DYD_END_WINDOW};
  if (!other) {
    e.kind = DYD_END_INFINITE;
  } else if (p->arc && other->arc && p->curve == other->curve) {
    e.kind = p->arc->corner != other->arc->corner ? DYD_END_AXIS : DYD_END_FEATURE;
  } else if (p->arc && other->arc) {
    e.kind = DYD_END_SITES;
    e.site = o->item[dyd_outline_exact_third(o, at, p->curve, other->curve)].site;
  }
  return e;
}

/* other: the piece beyond this end. */
static void write_end(dyd_arc_end *out, dyd_outline *o, const dyd_outline_piece *p, const dyd_outline_piece *other,
                      dyd_outline_spot *at) {
  dyd_arc_end e = end_kind(o, p, other, at);
  out->kind = e.kind;
  out->site = e.site;
  if (e.kind == DYD_END_INFINITE) return;
  const dyd_surd_point *exact = dyd_outline_exact(o, at);
  if (!exact) return;
  dyd_surd_point_set(&out->at, exact);
  dyd_outline_unscale(&out->at, o);
}

/* The arc made of the pieces from first to last. */
static void write_arc(dyd_arc *out, dyd_outline *o, size_t first, size_t last) {
  const dyd_outline_piece *f = &o->piece[first], *t = &o->piece[last];
  const dyd_outline_piece *before = o->last[first] == NONE ? NULL : &o->piece[o->last[first]];
  const dyd_outline_piece *after = o->next[last] == NONE ? NULL : &o->piece[o->next[last]];
  out->kind = DYD_ARC_WINDOW;
  if (f->arc) {
    uint32_t i = o->item[o->count].site, j = o->item[f->curve].site;
    out->kind = f->arc->shape.parabola ? DYD_ARC_PARABOLA : DYD_ARC_LINE;
    out->far_site = o->outer ? j : i;
    out->near_site = o->outer ? i : j;
    out->corner = (dyd_feature_kind)f->arc->corner;
    out->feature = (dyd_feature_kind)f->arc->feature;
  }
  write_end(&out->begin, o, f, before, f->begin);
  write_end(&out->end, o, t, after, t->end);
}

static dyd_status write_chain(dyd_boundary *out, bool *done, dyd_outline *o, size_t start) {
  size_t arcs = 0, p = start;
  do {
    done[p] = true;
    bool smooth = dyd_outline_smooth(o, p);
    p = o->next[p];
    arcs += !smooth || p == start;
  } while (p != NONE && p != start);
  dyd_chain *chain = boundary_add_chain(out, arcs);
  if (!chain) return DYD_E_NOMEM;
  chain->closed = p != NONE;
  p = start;
  for (size_t k = 0; k < arcs && o->status == DYD_OK; k++) {
    size_t first = p;
    while (dyd_outline_smooth(o, p) && o->next[p] != start) p = o->next[p];
    write_arc(&chain->arc[k], o, first, p);
    p = o->next[p];
  }
  return o->status;
}

/* *out is empty before; on failure the caller clears it. */
static dyd_status write_boundary(dyd_boundary *out, dyd_outline *o) {
  DYD_FREED bool *done = calloc(o->pieces ? o->pieces : 1, sizeof *done);
  out->chain = dyd_alloc(o->pieces, sizeof *out->chain);
  if (!done || !out->chain) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  bool all_window = true;
  for (size_t p = 0; p < o->pieces && st == DYD_OK; p++) {
    all_window = all_window && !o->piece[p].arc;
    if (!done[p]) st = write_chain(out, done, o, dyd_outline_start(o, p));
  }
  out->whole = all_window;
  return st;
}

dyd_status dyd_cell_boundary(dyd_boundary *out, const dyd_cell_task *task) {
  DYD_SCOPED(dyd_outline)
  o = {.pd = task->pd, .cancel = task->cancel, .memory = task->memory, .keep_all = task->keep_all};
  const dyd_rect *window = task->windowed ? task->rect[task->count + 1] : NULL;
  dyd_boundary b = {.whole = !window && (task->outer || !task->count)};
  dyd_status st = dyd_outline_load_rects(&o, task->site, task->rect, task->other, task->count);
  if (st == DYD_OK) st = dyd_outline_find(&o, window, task->outer);
  if (st == DYD_OK && o.pieces) st = write_boundary(&b, &o);
  if (st != DYD_OK) return dyd_boundary_clear(&b), st;
  dyd_boundary_clear(out);
  *out = b;
  return DYD_OK;
}

/* ---- the public calls ----
 *
 * [CELL-2] Under every choice the true cell of i is bounded by its Delaunay neighbours, which are possible neighbours.
 * So a point nearer to R_i than to all possible neighbours is in every true cell, hence in Int_i; and a point of Ext_i,
 * under the choice with p_i closest to it and all others farthest, is nearer to some Delaunay neighbour of i, hence in
 * C_ji for a possible neighbour j. No other site matters. */

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
                                    bool outer, const dyd_rect *window, dyd_memory *memory,
                                    const volatile int *cancel) {
  DYD_FREED const dyd_rect **in = dyd_alloc(s->count + 2, sizeof *in);
  if (!in) return DYD_E_NOMEM;
  in[0] = &s->own;
  for (size_t k = 0; k < s->count; k++) in[k + 1] = &s->other[k];
  in[s->count + 1] = window;
  dyd_cell_task task = {site, s->site, s->count, in, outer, window != NULL, pd, false, cancel, memory};
  return dyd_cell_boundary(out, &task);
}

dyd_status dyd_cell_region(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, bool outer, bool proved,
                           const dyd_rect *window, dyd_memory *memory, const volatile int *cancel) {
  uint32_t site;
  if (window && !window_has_area(window)) return DYD_E_ARG;
  if (dyd_flag_is_set(cancel)) return DYD_CANCELLED;
  dyd_status st = find_cell_site(&site, pd, i);
  if (st != DYD_OK) return st;
  DYD_SCOPED(dyd_cell_sites) s;
  dyd_pair_status least = dyd_least_at(pd, site, proved);
  st = dyd_cell_sites_init(&s, pd, site, least);
  const dyd_delaunay *complete =
      least == dyd_least_bounding(pd) ? pd : NULL; /* of some sites only: all may share one */
  return st == DYD_OK ? cell_region_among(out, complete, &s, site, outer, window, memory, cancel) : st;
}

dyd_status dyd_voronoi_cell(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, dyd_cell_bound bound,
                            const dyd_rect *window) {
  if (!pd) return DYD_E_ARG;
  dyd_memory memory = dyd_delaunay_memory_left(pd);
  return dyd_cell_region(out, pd, i, bound == DYD_CELL_POSSIBLE, false, window, &memory, NULL);
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
  DYD_SCOPED(dyd_cell_sites) s;
  st = dyd_cell_sites_init(&s, pd, site, dyd_least_bounding(pd));
  if (st == DYD_OK) *out = side_of_cell(&s, c);
  return st;
}

dyd_truth dyd_voronoi_side(const dyd_delaunay *pd, uint32_t i, const dyd_point *c) {
  if (!pd) return DYD_UNKNOWN;
  dyd_truth answer = DYD_UNKNOWN;
  return dyd_cell_point_side(&answer, pd, i, c) == DYD_OK ? answer : DYD_UNKNOWN;
}
