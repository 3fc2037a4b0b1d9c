/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sure edges of the Voronoi diagram.
 *
 * The edge dual to a legal pair ij ends on each side at the vertex of the sure triangle there; or at that of a polygon
 * whose sites are on one circle, since its sides are legal and others are not between them; or somewhere in the region
 * of an undecided face; or, for pairs that are hull edges for every choice, it is a ray: with all other points to the
 * left of the way from i to j, it goes to infinity along (y_j - y_i, x_i - x_j). */
#include "io/dual.h"

#include "base/alloc.h"
#include "delaunay/state.h"
#include <math.h>

static int dual_compare(const void *a, const void *b) {
  const dyd_dual_edge *x = a, *y = b;
  if (x->i != y->i) return x->i < y->i ? -1 : 1;
  return (x->j > y->j) - (x->j < y->j);
}

static dyd_dual_edge *dual_find(dyd_dual_edge *edge, size_t count, uint32_t i, uint32_t j) {
  const dyd_dual_edge key = {.i = i, .j = j};
  return bsearch(&key, edge, count, sizeof key, dual_compare);
}

static void dual_join_triangles(dyd_dual_edge *edge, size_t count, const dyd_triangle_list *triangles) {
  for (size_t t = 0; t < triangles->count; t++)
    for (int k = 0; k < 3; k++) {
      uint32_t a = triangles->item[t].v[k], b = triangles->item[t].v[(k + 1) % 3];
      dyd_dual_edge *e = dual_find(edge, count, a < b ? a : b, a < b ? b : a);
      if (e) e->end[a < b ? 0 : 1] = (dyd_dual_end){.kind = DYD_DUAL_VERTEX, .vertex = t};
    }
}

static int tied_compare(const void *a, const void *b) {
  const size_t *f = a, *g = b;
  return (*f > *g) - (*f < *g);
}

/* Ends that are in no triangle may be in a tied polygon. first: the number of its first vertex. */
static void dual_join_ties(dyd_dual_edge *e, const dyd_delaunay *pd, const size_t *tied, size_t ties, size_t first) {
  uint32_t v[2] = {pd->sk.vertex[e->i], pd->sk.vertex[e->j]};
  for (int end = 0; end < 2; end++) {
    if (e->end[end].kind != DYD_DUAL_OPEN) continue;
    dyd_half_edge h = dyd_find_edge(&pd->sk, v[end], v[1 - end]);
    size_t face = h == DYD_NONE ? DYD_NONE : dyd_face_of(pd, dyd_edge_triangle(h));
    const size_t *found = bsearch(&face, tied, ties, sizeof *tied, tied_compare);
    if (found) e->end[end] = (dyd_dual_end){.kind = DYD_DUAL_VERTEX, .vertex = first + (size_t)(found - tied)};
  }
}

/* Bounds of sign * (b - a) along an axis: an operation in doubles, then one step outward. */
static void dual_difference(double out[2], const double a[2], const double b[2], int sign) {
  double lo = sign > 0 ? b[0] - a[1] : a[0] - b[1], hi = sign > 0 ? b[1] - a[0] : a[1] - b[0];
  out[0] = nextafter(lo, -INFINITY);
  out[1] = nextafter(hi, INFINITY);
}

/* All other points are on the left of i to j: the ray is on the right, end[1]; else the other way round. */
static void dual_set_ray(dyd_dual_edge *e, const dyd_delaunay *pd) {
  double a[4], b[4];
  dyd_sites_get_d(a, dyd_delaunay_sites(pd), e->i);
  dyd_sites_get_d(b, dyd_delaunay_sites(pd), e->j);
  int right = e->end[0].kind == DYD_DUAL_VERTEX ? 1 : 0;
  dyd_dual_end *end = &e->end[right];
  end->kind = DYD_DUAL_RAY;
  dual_difference(end->direction, a + 2, b + 2, right ? 1 : -1);
  dual_difference(end->direction + 2, a, b, right ? -1 : 1);
}

/* A sure hull edge with a vertex on one side has its ray on the other. Where both sides are open, or all points are
 * collinear, nothing is said. */
static dyd_status dual_join_rays(dyd_dual_edge *edge, size_t count, const dyd_delaunay *pd) {
  dyd_hull hull = {0};
  dyd_status st = dyd_delaunay_partial_hull(&hull, pd);
  if (st == DYD_CAPPED) st = DYD_OK; /* then it lists no pairs */
  for (size_t k = 0; st == DYD_OK && k < hull.pairs.count; k++) {
    if (hull.pairs.item[k].status != DYD_LEGAL) continue;
    dyd_dual_edge *e = dual_find(edge, count, hull.pairs.item[k].i, hull.pairs.item[k].j);
    if (e && (e->end[0].kind == DYD_DUAL_VERTEX) != (e->end[1].kind == DYD_DUAL_VERTEX)) dual_set_ray(e, pd);
  }
  dyd_hull_clear(&hull);
  return st;
}

dyd_status dyd_dual_edges(dyd_dual_edge **out, size_t *count, const dyd_delaunay *pd,
                          const dyd_triangle_list *triangles, const size_t *tied, size_t ties) {
  dyd_pair_list pairs = {0};
  size_t legal = 0;
  dyd_status st = dyd_delaunay_pairs(&pairs, pd);
  dyd_dual_edge *edge = st == DYD_OK ? calloc(pairs.count ? pairs.count : 1, sizeof *edge) : NULL;
  if (st == DYD_OK && !edge) st = DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < pairs.count; k++)
    if (pairs.item[k].status == DYD_LEGAL) {
      edge[legal].i = pairs.item[k].i;
      edge[legal++].j = pairs.item[k].j;
    }
  dyd_pair_list_clear(&pairs);
  if (st == DYD_OK) {
    dual_join_triangles(edge, legal, triangles);
    for (size_t k = 0; ties && k < legal; k++) dual_join_ties(&edge[k], pd, tied, ties, triangles->count);
    st = dual_join_rays(edge, legal, pd);
  }
  if (st != DYD_OK) {
    free(edge);
    return st;
  }
  *out = edge;
  *count = legal;
  return DYD_OK;
}
