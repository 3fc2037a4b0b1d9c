/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The polygons of a cell in doubles, where all triangles round the site are certain and the cell lies inside the
 * window.
 *
 * Let p_k be the representatives, V_t the circumcentre of p_i, p_j, p_k for the t-th triangle round i, found in
 * doubles. Nothing is trusted of it: it is moved towards p_i by a margin to give an inner vertex, away from p_i to
 * give an outer one, and these are proved against the outward boxes with the bounds of [FLT-DST]:
 *   inner vertex z: dl_i(z) < ds_j(z) for all neighbours j of i, so z is in Int_i [POLY-1];
 *   outer vertices z_t, z_t+1: dl_j < ds_i at both, j the neighbour between the triangles t and t+1, so the edge is
 * in C_ji [POLY-2]; all turns about p_i are certain left turns and wind round once, so the polygon is star-shaped about
 *   p_i and holds Pos_i, which is connected, contains p_i's rectangle and does not meet the polygon's boundary.
 * Int_i, Pos_i lie in the hull of the outer vertices, so they are within max |inner_t - outer_t| of the inner polygon:
 * that is required to be at most 2^-bits. Where anything is not certain the exact rung does the cell. [SHAPE-1] */
#include "base/alloc.h"
#include "voronoi/shape.h"

#include <math.h>

#define U 0x1p-53

/* Twice the signed area of o, a, b with a bound on its rounding error: differences carry a relative error u, products
 * and their difference (1+u)^4 in all, 4.01 u (|ax by| + |ay bx|) < 8 u of the same; plus underflow. */
static double double_turn(double *error, dyd_xy o, dyd_xy a, dyd_xy b) {
  double ax = a.x - o.x, ay = a.y - o.y, bx = b.x - o.x, by = b.y - o.y, p = ax * by, q = ay * bx;
  *error = 8 * 0x1p-53 * (fabs(p) + fabs(q)) + DYD_TINY;
  return p - q;
}

/* The vertices round v, counter-clockwise, with their boxes. false: a ghost or an undecided face is among them. */
static dyd_status shape_find_fan(bool *done, uint32_t *degree, dyd_shape *s, const dyd_delaunay *pd, uint32_t v) {
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_half_edge first = pd->sk.leaving[v], h = first;
  uint32_t n = 0;
  *done = false;
  if (first == DYD_NONE) return DYD_OK;
  do {
    if (!dyd_triangle_is_sure(pd, dyd_edge_triangle(h))) return DYD_OK;
    if (!DYD_GROW(s->fan, s->fan_cap, n + 1)) return DYD_E_NOMEM;
    if (!DYD_GROW(s->fan_box, s->box_cap, n + 1)) return DYD_E_NOMEM;
    s->fan[n] = dyd_edge_target(m, h);
    dyd_sites_get_d(s->fan_box[n].e, pd->sk.rects.sites, pd->sk.reps.site[s->fan[n]]);
    n++;
    h = dyd_edge_turn(m, h);
  } while (h != first);
  *degree = n;
  *done = n >= 3;
  return DYD_OK;
}

/* By how much a point of the box can be away from its representative; no bound is needed, only a guess. */
static double box_spread(const dyd_bbox *b, dyd_xy p) {
  double x = dyd_max(b->e[1] - p.x, p.x - b->e[0]), y = dyd_max(b->e[3] - p.y, p.y - b->e[2]);
  return x + y;
}

/* Moves the circumcentre of o, a, b towards o and away from it: guesses. `wide` bounds the rectangles; times is how
 * often the margin is doubled thrice. false: there is no good guess. */
static bool shape_guess(dyd_xy *in, dyd_xy *out, dyd_xy o, dyd_xy a, dyd_xy b, double wide, double times) {
  double ax = a.x - o.x, ay = a.y - o.y, bx = b.x - o.x, by = b.y - o.y;
  double la = ax * ax + ay * ay, lb = bx * bx + by * by, d = 2 * (ax * by - ay * bx);
  double x = (by * la - ay * lb) / d, y = (ax * lb - bx * la) / d;
  double radius = sqrt(x * x + y * y), far = fabs(o.x) + fabs(o.y) + radius;
  double blur = 8 * U * (la * sqrt(lb) + lb * sqrt(la)) / fabs(d);
  double share = times * (wide + 2 * blur + 8 * U * far) * 2 * radius / dyd_min(la, lb);
  if (!(share < 0.5)) return false;
  *in = (dyd_xy){o.x + x * (1 - share), o.y + y * (1 - share)};
  *out = (dyd_xy){o.x + x * (1 + share), o.y + y * (1 + share)};
  return true;
}

static dyd_bbox box_of_xy(dyd_xy z) {
  return (dyd_bbox){{z.x, z.x, z.y, z.y}};
}

static bool shape_inner_holds(const dyd_shape *s, uint32_t degree, const dyd_bbox *own, dyd_xy z) {
  dyd_bbox c = box_of_xy(z);
  double most = dyd_dl2_upper(&c, own);
  for (uint32_t k = 0; k < degree; k++)
    if (!(most < dyd_ds2_lower(&c, &s->fan_box[k]))) return false;
  return true;
}

static bool shape_outer_holds(const dyd_bbox *a, const dyd_bbox *b, const dyd_bbox *own, dyd_xy z) {
  dyd_bbox c = box_of_xy(z);
  double least = dyd_ds2_lower(&c, own);
  return dyd_dl2_upper(&c, a) < least && dyd_dl2_upper(&c, b) < least;
}

static bool shape_in_window(const dyd_window *w, dyd_xy z) {
  return w->d[0] <= z.x && z.x <= w->d[1] && w->d[2] <= z.y && z.y <= w->d[3];
}

/* The vertices of triangle t round o, proved. */
static bool shape_place(dyd_shape *s, uint32_t t, uint32_t degree, const dyd_delaunay *pd, dyd_xy o,
                        const dyd_bbox *own, const dyd_window *w, double flat) {
  uint32_t next = t + 1 == degree ? 0 : t + 1;
  dyd_xy a = pd->sk.reps.xy[s->fan[t]], b = pd->sk.reps.xy[s->fan[next]];
  double wide = box_spread(own, o) + dyd_max(box_spread(&s->fan_box[t], a), box_spread(&s->fan_box[next], b));
  for (double times = 1.25; times < 100; times *= 8) {
    dyd_xy *in = &s->inner[t], *out = &s->outer[t];
    if (!shape_guess(in, out, o, a, b, wide, times)) return false;
    double x = out->x - in->x, y = out->y - in->y;
    if (!(dyd_upper(x * x + y * y) <= flat) || !shape_in_window(w, *out) || !shape_in_window(w, *in)) return false;
    if (shape_inner_holds(s, degree, own, *in) && shape_outer_holds(&s->fan_box[t], &s->fan_box[next], own, *out))
      return true;
  }
  return false;
}

/* Returns true if the polygon is star-shaped about o, with certain turns, winding round once. Adds up its area as it
 * goes: *area less *error is a lower bound, *area more *error an upper one. */
static bool shape_star(double *area, double *error, dyd_xy o, const dyd_xy *z, uint32_t n) {
  int crossings = 0;
  *area = *error = 0;
  for (uint32_t t = 0; t < n; t++) {
    dyd_xy a = z[t], b = z[t + 1 == n ? 0 : t + 1];
    double e, d = double_turn(&e, o, a, b);
    if (!(d > e)) return false;
    crossings += a.y < o.y && b.y >= o.y;
    *area += d;
    *error += e + 4 * 0x1p-53 * *area;
  }
  return crossings == 1;
}

bool dyd_filter_is_convex(const dyd_xy *z, size_t n) {
  size_t lowest = 0;
  for (size_t k = 0; k < n; k++) {
    dyd_xy a = z[k], b = z[(k + 1) % n], c = z[(k + 2) % n];
    double e;
    if (!(double_turn(&e, a, b, c) > e)) return false;
    lowest += b.y < a.y && c.y >= b.y;
  }
  return n >= 3 && lowest == 1;
}

/* Drops vertices that spoil convexity (as rounding does where three circles nearly coincide), then asks for certain
 * left turns everywhere. `flat` bounds the squared distance of a dropped vertex from one that is kept. */
static bool shape_make_convex(dyd_shape *s, uint32_t n, double flat) {
  uint32_t kept = 0;
  for (uint32_t t = 0; t < n; t++) {
    const dyd_xy *last = kept ? &s->inner[kept - 1] : NULL, z = s->inner[t];
    if (last) {
      double x = s->outer[t].x - last->x, y = s->outer[t].y - last->y, e;
      dyd_xy beyond = s->inner[t + 1 == n ? 0 : t + 1];
      if (!(double_turn(&e, *last, z, beyond) > e) && t + 1 < n && dyd_upper(x * x + y * y) <= flat) continue;
    }
    s->inner[kept++] = z;
  }
  s->inner_count = kept;
  if (kept < 3) return false;
  for (uint32_t t = 0; t < kept; t++) {
    double e;
    if (!(double_turn(&e, s->inner[t], s->inner[(t + 1) % kept], s->inner[(t + 2) % kept]) > e)) return false;
  }
  return true;
}

dyd_status dyd_filter_shape(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t v, const dyd_window *w,
                            int64_t bits) {
  uint32_t degree = 0;
  *done = false;
  if (bits > 1000 || bits < -1000) return DYD_OK;
  bool found;
  dyd_status st = shape_find_fan(&found, &degree, s, pd, v);
  if (st != DYD_OK || !found) return st;
  if (!DYD_GROW(s->inner, s->inner_cap, degree)) return DYD_E_NOMEM;
  if (!DYD_GROW(s->outer, s->outer_cap, degree)) return DYD_E_NOMEM;
  dyd_xy o = pd->sk.reps.xy[v];
  dyd_bbox own;
  dyd_sites_get_d(own.e, pd->sk.rects.sites, pd->sk.reps.site[v]);
  if (!(own.e[0] <= o.x && o.x <= own.e[1] && own.e[2] <= o.y && o.y <= own.e[3])) return DYD_OK;
  double flat = ldexp(1, bits > 500 ? -1000 : (int)(-2 * bits)), area, error;
  for (uint32_t t = 0; t < degree; t++)
    if (!shape_place(s, t, degree, pd, o, &own, w, flat)) return DYD_OK;
  s->outer_count = degree;
  if (!shape_star(&area, &error, o, s->outer, degree)) return DYD_OK;
  s->area[1] = dyd_upper((area + error) / 2);
  if (!shape_make_convex(s, degree, flat) || !shape_star(&area, &error, o, s->inner, s->inner_count)) return DYD_OK;
  s->area[0] = dyd_max(dyd_lower((area - error) / 2), 0);
  *done = s->in_doubles = true;
  return DYD_OK;
}
