/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Triangles that fat rectangles meet, found by a flood from each of them.
 *
 * [WIT-FAT] Let all sites but the fat ones be within E of their representatives, ij an edge neither of whose triangles
 * is met by a fat R_k. If [WIT-NEAR] or [WIT-HULL] holds for ij, its centre c is a witness all the same. A triangle is
 * met when R_k comes within E of its closed disc, a ghost triangle when R_k comes within E of the closed half-plane
 * beyond its hull edge. All triangles that R_k meets are joined to those around p_k through edges of such triangles.
 *   Proof. The power of x about c is the mean of its powers about c1 and c2 (at the hull: P1 + 2 r1 t), so the disc
 * about c through p_i lies in the two discs (in disc and half-plane), and within E of it is within E of one of these.
 * So ds_k(c) > rho + E >= dl_i(c), dl_j(c) for the fat k; for the others the old proof stands. p_i of a fat i is in
 * R_i, so the triangles at i are met: i and j are not fat.
 *   Let S be the points within E of the hull of R_k and p_k: convex; a triangle is met iff its disc holds a y of S. On
 * a line from inside of it to y the power of y about the discs crossed does not grow (it is affine and the same on the
 * common edge, and each disc is empty), so all of them hold y. If y is in the hull, the line ends in a triangle that
 * holds y, and the triangles that the segment from p_k to y touches hold points of S and are connected. Else the line
 * ends at a hull edge that y is strictly beyond. So does the segment from p_k to y, at a triangle that holds a point of
 * S; the hull edges that y is strictly beyond follow upon each other, and their ghost triangles are met. []
 *
 * Rounding, u = 2^-53. o, the centre seen from vertex a: with d >= 2^-100 and d >= 2^-20 q, q = 2(|bx cy| + |by cx|),
 * d has an error <= 4.1 u q <= 2^-30.9 d, each numerator one <= 7.1 u of its two terms, so o is off by at most e =
 * 2^-28 (Mx + My), M the terms over d (underflow: <= 2^-900 below e, as Mx + My >= r >= 2^-52). Ends of the box seen
 * from a are off by u times (distance + |o|). Distance ds and radius r = |o| have fewer than 10 factors 1+u. So ds >=
 * 1.001 (r + E) + 4e leaves room for all. Half-plane: every corner on the inner side, by E |ab| (1 + 2^-20) + 2^-48 of
 * the two terms (4.1 u) + 2^-900. An uncertain result, infinite or NaN counts as met. */
#include "legal/star_filter.h"

#include "base/alloc.h"
#include "skeleton/mesh_filter.h"

/* met[t]: 1 + the last of the fat ones that was found to meet t. */
typedef struct flood {
  const dyd_mesh *m;
  double reach;
  dyd_bbox box; /* of the rectangle and its representative */
  uint32_t *met, *stack, mark;
  size_t top, cap, left; /* left: triangles that may still be met */
} flood;

/* Corners of the box, seen from a. */
static dyd_bbox box_from(const dyd_bbox *b, dyd_xy a) {
  return (dyd_bbox){{b->e[0] - a.x, b->e[1] - a.x, b->e[2] - a.y, b->e[3] - a.y}};
}

static bool disc_is_clear(const flood *f, dyd_xy a, dyd_xy b, dyd_xy c) {
  double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  double lb = bx * bx + by * by, lc = cx * cx + cy * cy, left = bx * cy, right = by * cx, d = 2 * (left - right);
  if (!(d >= 0x1p-100 && d >= 0x1p-19 * (fabs(left) + fabs(right)) && lb + lc <= 0x1p98)) return false;
  double x = (cy * lb - by * lc) / d, y = (bx * lc - cx * lb) / d;
  double e = 0x1p-28 * ((fabs(cy) * lb + fabs(by) * lc) / d + (fabs(bx) * lc + fabs(cx) * lb) / d);
  dyd_bbox box = box_from(&f->box, a);
  double dx = dyd_max(dyd_max(box.e[0] - x, x - box.e[1]), 0), dy = dyd_max(dyd_max(box.e[2] - y, y - box.e[3]), 0);
  return sqrt(dx * dx + dy * dy) >= 1.001 * (sqrt(x * x + y * y) + f->reach) + 4 * e;
}

/* The box is inside of the line from a to b (the inside on the left), by more than the reach. */
static bool half_plane_is_clear(const flood *f, dyd_xy a, dyd_xy b) {
  double x = b.x - a.x, y = b.y - a.y, most = f->reach * sqrt(x * x + y * y) * (1 + 0x1p-20) + 0x1p-900;
  dyd_bbox box = box_from(&f->box, a);
  for (int k = 0; k < 4; k++) {
    double left = x * box.e[2 + (k >> 1)], right = y * box.e[k & 1];
    if (!(left - right >= most + 0x1p-48 * (fabs(left) + fabs(right)))) return false;
  }
  return true;
}

static bool is_clear(const flood *f, uint32_t t) {
  const dyd_mesh *m = f->m;
  const uint32_t *v = m->tri[t].v;
  if (!dyd_is_ghost_triangle(m, t)) return disc_is_clear(f, m->xy[v[0]], m->xy[v[1]], m->xy[v[2]]);
  dyd_half_edge h = dyd_hull_edge(m, t);
  return half_plane_is_clear(f, m->xy[dyd_hull_origin(m, h)], m->xy[dyd_hull_target(m, h)]);
}

/* DYD_CAPPED: enough. */
static dyd_status fat_meet(flood *f, uint32_t t) {
  if (f->met[t] == f->mark) return DYD_OK;
  if (f->left == 0) return DYD_CAPPED;
  if (!DYD_GROW(f->stack, f->cap, f->top + 1)) return DYD_E_NOMEM;
  f->left--;
  f->met[t] = f->mark;
  f->stack[f->top++] = t;
  return DYD_OK;
}

static dyd_status flood_from(flood *f, const dyd_skeleton *sk, uint32_t k) {
  dyd_xy p = f->m->xy[k];
  dyd_half_edge first = sk->leaving[k], h = first;
  dyd_status st = first == DYD_NONE ? DYD_CAPPED : DYD_OK;
  f->box = (dyd_bbox){{dyd_min(sk->rects.box[k].e[0], p.x), dyd_max(sk->rects.box[k].e[1], p.x),
                       dyd_min(sk->rects.box[k].e[2], p.y), dyd_max(sk->rects.box[k].e[3], p.y)}};
  f->top = 0;
  while (st == DYD_OK) {
    st = fat_meet(f, dyd_edge_triangle(h));
    h = dyd_edge_turn(f->m, h);
    if (h == first) break;
  }
  while (st == DYD_OK && f->top) {
    uint32_t t = f->stack[--f->top];
    for (dyd_half_edge e = dyd_edge_of(t, 0); e < dyd_edge_end(t) && st == DYD_OK; e++) {
      uint32_t beyond = dyd_edge_triangle(dyd_edge_twin(f->m, e));
      if (f->met[beyond] != f->mark && !is_clear(f, beyond)) st = fat_meet(f, beyond);
    }
  }
  return st;
}

dyd_status dyd_fat_meet(uint32_t **met, const dyd_skeleton *sk, const uint32_t *fat, uint32_t count, double reach) {
  flood f = {.m = &sk->mesh, .reach = reach, .left = sk->mesh.count / 2 + 64};
  dyd_status st = DYD_OK;
  *met = NULL;
  if (count == 0) return DYD_OK;
  if (!DYD_ZEROED(f.met, (size_t)sk->mesh.count + 1)) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < count && st == DYD_OK; q++) {
    f.mark = q + 1;
    st = flood_from(&f, sk, fat[q]);
  }
  free(f.stack);
  if (st == DYD_OK)
    *met = f.met;
  else
    free(f.met);
  return st == DYD_CAPPED ? DYD_OK : st;
}
