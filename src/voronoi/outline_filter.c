/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The boundary of a region in doubles: arcs, cuts, a sample between two cuts, pieces, the chain of them. What the exact
 * work does (exact_cell_pieces.c, exact_cell_window.c, exact_cell_link.c), where no comparison is in doubt.
 *
 * [OUTLINE-1] Every true end or meeting point lies in the box of a spot: the formulas are the exact ones in intervals,
 * and a formula that could give a point or none ends the work. So the order of cuts along an arc, the sides of samples
 * and the pane of a meeting point, where certain, are the true ones. More cuts than the exact work makes change
 * nothing, as pieces of one arc are joined. Each finite end of a piece is where exactly one other piece begins; where
 * only one beginning has a box that meets the box of the end, it is that one. */
#include "voronoi/outline_filter.h"

#include "delaunay/memory.h"
#include "rect/sites_table.h"
#include <stdlib.h>

/* ---- the site and the others ---- */

/* Sides of the rectangle that are one number, where outward doubles leave it open. */
static dyd_status box_find_thin(bool thin[2], const dyd_box *b, const dyd_sites *s, uint32_t i) {
  bool open[2];
  for (int a = 0; a < 2; a++) {
    thin[a] = b->outer[2 * a] == b->outer[2 * a + 1];
    open[a] = !thin[a] && b->end[2 * a].hi >= b->end[2 * a + 1].lo;
  }
  if (!open[0] && !open[1]) return DYD_OK;
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = dyd_sites_get(&r, s, i);
  for (int a = 0; a < 2; a++) {
    const dyd_interval *side = a ? &r.y : &r.x;
    if (open[a]) thin[a] = !dyd_dyadic_cmp(&side->lo, &side->hi);
  }
  dyd_rect_clear(&r);
  return st;
}

/* The ends of the box, each within the last place of an outward double if doubles do not hold it. */
static bool box_load(dyd_box *out, const dyd_sites *s, uint32_t i) {
  dyd_sites_get_d(out->outer, s, i);
  out->exact = dyd_sites_in_doubles(s, i);
  for (int k = 0; k < 4; k++) {
    double e = out->outer[k], inward = out->exact ? e : nextafter(e, k & 1 ? -INFINITY : INFINITY);
    if (!isfinite(e)) return false;
    out->end[k] = (dyd_iv){fmin(e, inward), fmax(e, inward)};
  }
  return true;
}

dyd_status dyd_outline_load(bool *done, dyd_outline *o, const dyd_delaunay *pd, uint32_t i) {
  dyd_index_list list = {0};
  const dyd_sites *s = dyd_delaunay_sites(pd);
  dyd_status st = dyd_delaunay_neighbours(&list, pd, i, dyd_least_bounding(pd));
  *done = st == DYD_OK && list.count <= DYD_OUTLINE_OTHERS;
  if (*done) {
    o->count = list.count;
    for (size_t k = 0; k <= list.count && *done && st == DYD_OK; k++) {
      uint32_t site = k < list.count ? list.item[k] : i;
      if (k < list.count) o->site[k] = site;
      *done = box_load(&o->box[k], s, site);
      if (*done) st = box_find_thin(o->thin[k], &o->box[k], s, site);
    }
    o->origin[0] = o->box[list.count].outer[0];
    o->origin[1] = o->box[list.count].outer[2];
    for (int k = 0; k < 4; k++) o->limit[k] = k & 1 ? INFINITY : -INFINITY;
  }
  dyd_index_list_clear(&list);
  return st;
}

static void box_place(dyd_box *out, double *slack, const dyd_box *b, const double origin[2]) {
  *out = *b;
  *slack = 0;
  for (int k = 0; k < 4; k++) {
    out->end[k] = dyd_iv_sub(b->end[k], dyd_iv_point(origin[k >> 1]));
    out->outer[k] = k & 1 ? out->end[k].hi : out->end[k].lo;
    *slack = dyd_max(*slack, dyd_up(out->end[k].hi - out->end[k].lo));
  }
}

/* Do the closed rectangles meet? */
static bool outline_rects_meet(bool *unsure, const dyd_box *a, const dyd_box *b) {
  bool doubt = false;
  for (int k = 0; k < 4; k += 2)
    if (dyd_outline_order(&doubt, a->end[k], b->end[k + 1]) > 0 ||
        dyd_outline_order(&doubt, b->end[k], a->end[k + 1]) > 0)
      return false;
  if (doubt) *unsure = true;
  return true;
}

/* Relative to the origin; false: some other meets the site. */
static bool outline_place(dyd_outline *o, const dyd_rect *window) {
  bool free = true;
  dyd_filter_box(&o->window, window);
  double none;
  box_place(&o->frame, &none, &o->window, o->origin);
  for (size_t k = 0; k <= o->count; k++) box_place(&o->near[k], &o->slack[k], &o->box[k], o->origin);
  for (size_t k = 0; k < o->count; k++) {
    o->drop[k] = outline_rects_meet(&o->unsure, &o->box[k], &o->box[o->count]);
    free = free && !o->drop[k];
  }
  for (int k = 0; k < 4; k++) {
    int side[2] = {k == 1 || k == 2, k >= 2};
    o->corner[k] = (dyd_outline_spot){{o->frame.end[side[0]], o->frame.end[2 + side[1]]}, {side[0], side[1]}};
  }
  return free;
}

/* ---- limits ---- */

/* How far the others are from the origin, at most, in one coordinate. */
static double outline_reach(const dyd_outline *o) {
  double most = 0;
  for (size_t k = 0; k < o->count; k++)
    for (int e = 0; e < 4; e++) most = fmax(most, fabs(o->near[k].outer[e]));
  return most;
}

/* Is all of the square ring taken away around the site? Then Pos, which is connected and holds the
 * site, is inside. */
static bool ring_is_taken(dyd_outline *o, const double ring[4]) {
  enum { PARTS = 4 };
  for (int k = 0; k < 4; k++) {
    int across = k >> 1, along = 1 - across;
    dyd_iv at[2];
    at[across] = dyd_iv_point(ring[k]);
    double from = ring[2 * along], length = ring[2 * along + 1] - from;
    for (int part = 0; part < PARTS; part++) {
      at[along] = (dyd_iv){from + length * part / PARTS, from + length * (part + 1) / PARTS};
      if (!dyd_outline_taken(NULL, o, o->count, at)) return false;
    }
  }
  return true;
}

static void limit_by_ring(dyd_outline *o) {
  static const double share[] = {0.6, 0.8, 1.25, 2};
  double reach = outline_reach(o);
  const dyd_box *own = &o->near[o->count];
  for (size_t m = 0; m < sizeof share / sizeof *share; m++) {
    double ring[4];
    for (int k = 0; k < 4; k++) ring[k] = own->outer[k] + (k & 1 ? reach : -reach) * share[m];
    if (!(ring[0] < own->outer[0] && own->outer[1] < ring[1] && ring[2] < own->outer[2] && own->outer[3] < ring[3]) ||
        !ring_is_taken(o, ring))
      continue;
    for (int k = 0; k < 4; k++) {
      double at = o->origin[k >> 1] + ring[k];
      o->limit[k] = k & 1 ? dyd_up(at) : dyd_down(at);
    }
    return;
  }
}

/* Int is in Pos, whose arcs are in the boxes of their ends. A little more, so that nothing ends at a limit. */
static void limit_by_parts(dyd_outline *o) {
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (size_t p = 0; p < o->pieces; p++)
    for (int e = 0; e < 2; e++)
      for (int k = 0; k < 4; k++) {
        dyd_iv at = dyd_outline_coordinate(o, e ? o->piece[p].end : o->piece[p].begin, k >> 1);
        box[k] = k & 1 ? dyd_max(box[k], at.hi) : dyd_min(box[k], at.lo);
      }
  for (int k = 0; k < 4 && o->pieces; k++) {
    double more = 0x1p-10 * (box[k | 1] - box[k & 2]);
    o->limit[k] = k & 1 ? fmin(o->limit[k], box[k] + more) : fmax(o->limit[k], box[k] - more);
  }
}

static void set_bounds(dyd_outline *o) {
  for (int k = 0; k < 4; k++) {
    dyd_iv end = o->window.end[k];
    o->of_window[k] = !(k & 1 ? o->limit[k] < end.lo : o->limit[k] > end.hi);
    o->bound[k] = o->of_window[k] ? end : dyd_iv_point(o->limit[k]);
  }
}

dyd_iv dyd_outline_coordinate(const dyd_outline *o, const dyd_outline_spot *p, int a) {
  if (p->side[a] >= 0) return o->window.end[2 * a + p->side[a]];
  return dyd_iv_add(p->at[a], dyd_iv_point(o->origin[a]));
}

/* ---- samples ---- */

static bool point_is_taken(dyd_outline *o, size_t own, const dyd_iv at[2]) {
  bool doubt = false, taken = dyd_outline_taken(&doubt, o, own, at);
  if (doubt && !taken) o->unsure = true;
  return taken;
}

/* A double surely between. */
static dyd_iv coordinate_between(dyd_outline *o, dyd_iv a, dyd_iv b) {
  double t = a.hi / 2 + b.lo / 2;
  if (!(a.hi < t && t < b.lo)) o->unsure = true;
  return dyd_iv_point(t);
}

/* ---- cuts and pieces ---- */

/* Sorts the cuts along an axis: few. */
static void sort_spots(dyd_outline *o, size_t count, int axis) {
  for (size_t k = 1; k < count; k++)
    for (size_t m = k; m > 0; m--) {
      const dyd_outline_spot *p = o->cut[m - 1], *q = o->cut[m];
      int order = dyd_outline_order(&o->unsure, p->at[axis], q->at[axis]);
      if (!order) o->unsure = true;
      if (order <= 0) break;
      o->cut[m - 1] = q;
      o->cut[m] = p;
    }
}

static void add_part(dyd_outline *o, size_t curve, const dyd_outline_arc *arc, bool grows, size_t k) {
  const dyd_outline_spot *low = o->cut[k], *high = o->cut[k + 1];
  if (o->pieces == DYD_OUTLINE_PIECES)
    o->unsure = true;
  else
    o->piece[o->pieces++] = (dyd_outline_piece){(uint32_t)curve, arc, grows ? low : high, grows ? high : low};
}

/* cut[0 .. count) are the ends of the arc and the meets on it. */
static void outline_arc_pieces(dyd_outline *o, uint32_t a) {
  const dyd_outline_arc *p = &o->arc[a];
  size_t count = 2;
  o->cut[0] = &p->end[0];
  o->cut[1] = &p->end[1];
  for (size_t m = 0; m < o->meets; m++)
    if (o->meet[m].arc[0] == a || o->meet[m].arc[1] == a) o->cut[count++] = &o->meet[m].spot;
  sort_spots(o, count, p->axis);
  int across = p->axis == 0 ? p->tilt[1] : p->tilt[0]; /* of the near feature, seen from the far corner */
  bool grows = ((across < 0) == (p->axis == 0)) != o->outer;
  size_t before = o->pieces;
  for (size_t k = 0; k + 1 < count && !o->unsure; k++) {
    dyd_iv t = coordinate_between(o, o->cut[k]->at[p->axis], o->cut[k + 1]->at[p->axis]);
    dyd_outline_spot sample = dyd_outline_arc_at(p, t);
    if (!point_is_taken(o, p->curve, sample.at)) add_part(o, p->curve, p, grows, k);
  }
  if (p->either && o->pieces > before + 1) o->unsure = true; /* in which order? */
}

/* Sides of the window: bottom, right, top, left, as in exact_cell.h. */
static void outline_side_pieces(dyd_outline *o, int side) {
  int axis = side & 1, end = side == 1 || side == 2;
  bool grows = side < 2;
  size_t count = 2;
  if (!o->of_window[2 * (1 - axis) + end]) return; /* out of reach */
  o->cut[0] = &o->corner[side];
  o->cut[1] = &o->corner[(side + 1) & 3];
  for (size_t a = 0; a < o->arcs; a++)
    for (int e = 0; e < 2; e++) {
      const dyd_outline_spot *p = &o->arc[a].end[e];
      if (p->side[1 - axis] != end) continue;
      if (count == DYD_OUTLINE_MEETS || p->side[axis] >= 0) o->unsure = true;
      if (!o->unsure) o->cut[count++] = p;
    }
  sort_spots(o, count, axis);
  for (size_t k = 0; k + 1 < count && !o->unsure; k++) {
    dyd_iv at[2];
    at[axis] = coordinate_between(o, o->cut[k]->at[axis], o->cut[k + 1]->at[axis]);
    at[1 - axis] = o->corner[side].at[1 - axis];
    if (!point_is_taken(o, o->count, at)) add_part(o, o->count + (size_t)side, NULL, grows, k);
  }
}

/* ---- the chain ---- */

static bool spots_meet(const dyd_outline_spot *p, const dyd_outline_spot *q) {
  for (int a = 0; a < 2; a++)
    if (!(p->at[a].lo <= q->at[a].hi && q->at[a].lo <= p->at[a].hi)) return false;
  return true;
}

/* next[p]: the only piece that can begin where p ends. */
static bool pieces_join(size_t next[DYD_OUTLINE_PIECES], size_t last[DYD_OUTLINE_PIECES], const dyd_outline *o) {
  for (size_t p = 0; p < o->pieces; p++) last[p] = SIZE_MAX;
  for (size_t p = 0; p < o->pieces; p++) {
    size_t found = 0;
    for (size_t q = 0; q < o->pieces; q++)
      if (o->piece[p].end == o->piece[q].begin || spots_meet(o->piece[p].end, o->piece[q].begin)) {
        next[p] = q;
        found++;
      }
    if (found != 1 || last[next[p]] != SIZE_MAX) return false;
    last[next[p]] = p;
  }
  return true;
}

static bool pieces_smooth(const dyd_outline_piece *p, const dyd_outline_piece *q) {
  if (p->curve != q->curve) return false;
  return p->arc == q->arc ||
         (p->arc && q->arc && p->arc->corner == q->arc->corner && p->arc->feature == q->arc->feature);
}

/* One chain of everything, begun where the exact work begins it: at the break before the first piece. */
static bool outline_link(dyd_outline *o) {
  size_t next[DYD_OUTLINE_PIECES], last[DYD_OUTLINE_PIECES], start = 0, p, seen = 0;
  if (!pieces_join(next, last, o)) return false;
  while (pieces_smooth(&o->piece[last[start]], &o->piece[start]) && last[start]) start = last[start];
  if (pieces_smooth(&o->piece[last[start]], &o->piece[start])) return false;
  p = start;
  do {
    if (p == start || !pieces_smooth(&o->piece[last[p]], &o->piece[p])) o->part[o->parts++] = o->piece[p];
    o->part[o->parts - 1].end = o->piece[p].end;
    p = next[p];
    seen++;
  } while (p != start);
  return seen == o->pieces;
}

bool dyd_filter_outline(dyd_outline *o, const dyd_rect *window, bool outer) {
  o->outer = outer;
  o->unsure = false;
  o->arcs = o->meets = o->pieces = o->parts = 0;
  o->taker = o->count;
  if (!outline_place(o, window) && !outer) return !o->unsure;
  if (outer) limit_by_ring(o);
  set_bounds(o);
  dyd_outline_find_arcs(o);
  if (!o->unsure) dyd_outline_find_meets(o);
  for (uint32_t a = 0; a < o->arcs && !o->unsure; a++) outline_arc_pieces(o, a);
  for (int side = 0; side < 4 && !o->unsure; side++) outline_side_pieces(o, side);
  if (o->unsure) return false;
  if (outer) limit_by_parts(o);
  return !o->pieces || outline_link(o);
}
