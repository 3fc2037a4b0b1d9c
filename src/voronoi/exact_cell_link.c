/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pieces joined to chains, and chains written as arcs.
 *
 * Each piece ends where exactly one other begins, since the region has no pinched point in the plane: Int_i is convex,
 * and near a point outside R_i the segments towards R_i, all in Pos_i, run in nearly one direction. A curve may touch
 * a side of the window; there each goes on by itself, so a piece is first joined to the next one of its own curve.
 * Neighbours that differ in nothing but a cut become one arc. */
#include "base/alloc.h"
#include "base/invariant.h"
#include "voronoi/boundary.h"
#include "voronoi/exact_cell.h"

#include <stdlib.h>

#define NONE SIZE_MAX

/* next[p], last[p]: the pieces before and after p; done: written. */
typedef struct links {
  size_t *next, *last;
  bool *done;
} links;

static dyd_status links_init(links *l, size_t count) {
  l->next = dyd_alloc(count, sizeof *l->next);
  l->last = dyd_alloc(count, sizeof *l->last);
  l->done = calloc(count ? count : 1, sizeof *l->done);
  if (!l->next || !l->last || !l->done) return DYD_E_NOMEM;
  for (size_t p = 0; p < count; p++) l->next[p] = l->last[p] = NONE;
  return DYD_OK;
}

static void links_clear(links *l) {
  free(l->done);
  free(l->last);
  free(l->next);
}

static bool same_spot(const dyd_spot *p, const dyd_spot *q) {
  if (p == q) return true;
  for (int axis = 0; axis < 2; axis++)
    if (dyd_filter_spot_cmp(p, q, axis)) return false;
  return !dyd_surd_point_cmp(&p->at, &q->at, 0) && !dyd_surd_point_cmp(&p->at, &q->at, 1);
}

/* Joins every loose end of a finite piece to a loose beginning; own: of the same curve only. */
static void links_join(links *l, const dyd_exact_cell *c, bool own) {
  for (size_t p = 0; p < c->pieces; p++) {
    if (c->piece[p].end->infinite || l->next[p] != NONE) continue;
    for (size_t q = 0; q < c->pieces; q++) {
      if (l->last[q] != NONE || c->piece[q].begin->infinite) continue;
      if ((own && c->piece[p].curve != c->piece[q].curve) || !same_spot(c->piece[p].end, c->piece[q].begin)) continue;
      l->next[p] = q;
      l->last[q] = p;
      break;
    }
    DYD_INVARIANT(own || l->next[p] != NONE);
  }
}

/* Are the piece p and its successor one arc? */
static bool links_are_smooth(const links *l, const dyd_exact_cell *c, size_t p) {
  size_t n = l->next[p];
  if (n == NONE || c->piece[p].curve != c->piece[n].curve) return false;
  const dyd_elementary *a = c->piece[p].arc, *b = c->piece[n].arc;
  return a == b || (a && b && a->corner == b->corner && a->feature == b->feature);
}

/* ---- writing ---- */

static dyd_arc_end links_end_kind(const dyd_exact_cell *c, const dyd_piece *p, const dyd_piece *other,
                                  const dyd_spot *at) {
  dyd_arc_end e = {.kind = DYD_END_WINDOW};
  if (!other) {
    e.kind = DYD_END_INFINITE;
  } else if (p->arc && other->arc && p->curve == other->curve) {
    e.kind = p->arc->corner != other->arc->corner ? DYD_END_AXIS : DYD_END_FEATURE;
  } else if (p->arc && other->arc) {
    size_t k = 0;
    while (k < c->count && (k == p->curve || dyd_cell_spot_side(c, at, k))) k++;
    DYD_INVARIANT(k < c->count);
    e.kind = DYD_END_SITES;
    e.site = c->site[k < c->count ? k : other->curve];
  }
  return e;
}

/* other: the piece beyond this end. */
static void links_write_end(dyd_arc_end *out, const dyd_exact_cell *c, const dyd_piece *p, const dyd_piece *other,
                            const dyd_spot *at) {
  dyd_arc_end e = links_end_kind(c, p, other, at);
  out->kind = e.kind;
  out->site = e.site;
  if (e.kind == DYD_END_INFINITE) return;
  dyd_surd_point_set(&out->at, &at->at);
  dyd_surd_point_unscale(&out->at, c->frame->ox, c->frame->oy, c->frame->man, c->frame->exp);
}

/* The arc made of the pieces from first to last. */
static void links_write_arc(dyd_arc *out, const dyd_exact_cell *c, const links *l, size_t first, size_t last) {
  const dyd_piece *f = &c->piece[first], *t = &c->piece[last];
  const dyd_piece *before = l->last[first] == NONE ? NULL : &c->piece[l->last[first]];
  const dyd_piece *after = l->next[last] == NONE ? NULL : &c->piece[l->next[last]];
  out->kind = DYD_ARC_WINDOW;
  if (f->arc) {
    uint32_t i = c->task->site, j = c->site[f->curve];
    out->kind = f->arc->parabola ? DYD_ARC_PARABOLA : DYD_ARC_LINE;
    out->far_site = c->task->outer ? j : i;
    out->near_site = c->task->outer ? i : j;
    out->corner = f->arc->corner;
    out->feature = f->arc->feature;
  }
  links_write_end(&out->begin, c, f, before, f->begin);
  links_write_end(&out->end, c, t, after, t->end);
}

/* Where the chain through p starts: at infinity, or after a break. */
static size_t links_chain_start(const links *l, const dyd_exact_cell *c, size_t p) {
  size_t start = p;
  while (l->last[start] != NONE && l->last[start] != p) start = l->last[start];
  if (l->last[start] == NONE) return start;
  size_t q = p;
  while (links_are_smooth(l, c, l->last[q]) && l->last[q] != p) q = l->last[q];
  return q;
}

static dyd_status links_write_chain(dyd_boundary *out, links *l, const dyd_exact_cell *c, size_t start) {
  size_t arcs = 0, p = start;
  do {
    l->done[p] = true;
    bool smooth = links_are_smooth(l, c, p);
    p = l->next[p];
    arcs += !smooth || p == start;
  } while (p != NONE && p != start);
  dyd_chain *chain = dyd_boundary_add_chain(out, arcs);
  if (!chain) return DYD_E_NOMEM;
  chain->closed = p != NONE;
  p = start;
  for (size_t k = 0; k < arcs; k++) {
    size_t first = p;
    while (links_are_smooth(l, c, p) && l->next[p] != start) p = l->next[p];
    links_write_arc(&chain->arc[k], c, l, first, p);
    p = l->next[p];
  }
  return DYD_OK;
}

static dyd_status links_write_all(dyd_boundary *out, links *l, const dyd_exact_cell *c) {
  out->chain = dyd_alloc(c->pieces, sizeof *out->chain);
  if (!out->chain) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  bool all_window = true;
  for (size_t p = 0; p < c->pieces && st == DYD_OK; p++) {
    all_window = all_window && !c->piece[p].arc;
    if (!l->done[p]) st = links_write_chain(out, l, c, links_chain_start(l, c, p));
  }
  out->whole = all_window;
  return st;
}

dyd_status dyd_cell_link(dyd_boundary *out, const dyd_exact_cell *c) {
  links l;
  dyd_status st = links_init(&l, c->pieces);
  if (st == DYD_OK) {
    links_join(&l, c, true);
    links_join(&l, c, false);
    st = links_write_all(out, &l, c);
  }
  links_clear(&l);
  return st;
}
