/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sides of the window inside a region.
 *
 * Inside W the boundary of the region consists of pieces of the curves, and of points at which a curve touches W from
 * outside. So along a side the region can begin or end only at an end of an arc on that side (arcs that are one point
 * included, so that no sample meets a touching point). Between two such ends a sample decides; a stretch that lies on
 * the boundary of the region itself is no piece of the window (the curve's arc is one, if it has the region on the side
 * of W). */
#include "voronoi/exact_cell.h"

/* Adds s if it lies strictly inside the side. */
static dyd_status cut_side(dyd_exact_cell *c, size_t *count, int side, const dyd_spot *s) {
  int axis = dyd_window_axis(side);
  const dyd_irect *w = &c->frame->window.r;
  if (s->infinite || dyd_surd_point_cmp_z(&s->at, 1 - axis, dyd_window_level(c, side))) return DYD_OK;
  if (dyd_surd_point_cmp_z(&s->at, axis, dyd_irect_end(w, axis, 0)) <= 0) return DYD_OK;
  if (dyd_surd_point_cmp_z(&s->at, axis, dyd_irect_end(w, axis, 1)) >= 0) return DYD_OK;
  return dyd_cell_add_cut(c, count, s);
}

static dyd_status side_find_cuts(dyd_exact_cell *c, size_t *count, int side) {
  *count = 0;
  for (size_t j = 0; j < c->count; j++)
    for (size_t a = 0; a < c->curve[j].count; a++)
      for (int e = 0; e < 2; e++) {
        dyd_status st = cut_side(c, count, side, &c->curve[j].arc[a].end[e]);
        if (st != DYD_OK) return st;
      }
  return DYD_OK;
}

static bool side_is_inside(dyd_exact_cell *c, int side) {
  for (size_t k = 0; k < c->count; k++)
    if (dyd_cell_side(c, &c->sample, NULL, side, k) <= 0) return false;
  return true;
}

static dyd_status side_pieces(dyd_exact_cell *c, int side) {
  size_t count;
  bool grows = side < 2;
  const dyd_spot *first = &c->frame->corner[side], *last = &c->frame->corner[(side + 1) & 3];
  const dyd_spot *lowest = grows ? first : last, *highest = grows ? last : first;
  dyd_status st = side_find_cuts(c, &count, side);
  if (st != DYD_OK) return st;
  count = dyd_cell_sort_cuts(c->cut, count, dyd_window_axis(side));
  for (size_t k = 0; k <= count && st == DYD_OK; k++) {
    const dyd_spot *low = k ? c->cut[k - 1] : lowest, *high = k < count ? c->cut[k] : highest;
    dyd_cell_sample(c, NULL, side, low, high);
    if (side_is_inside(c, side))
      st = dyd_cell_add_piece(c, (dyd_piece){c->count + (size_t)side, NULL, grows ? low : high, grows ? high : low});
  }
  return st;
}

dyd_status dyd_cell_window_pieces(dyd_exact_cell *c) {
  dyd_status st = DYD_OK;
  for (int side = 0; side < 4 && st == DYD_OK; side++) st = side_pieces(c, side);
  return st;
}
