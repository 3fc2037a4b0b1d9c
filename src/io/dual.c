/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sure edges of the Voronoi diagram.
 *
 * The edge dual to a legal pair ij ends on each side at the vertex of the sure triangle there; or at that of a polygon
 * whose sites are on one circle, since its sides are legal and others are not between them; or somewhere in the region
 * of an undecided face; or it is a ray: with all other points to the left of the way from i to j, or on it, it goes to
 * infinity along (y_j - y_i, x_i - x_j). So it is for pairs that are hull edges for every choice, for neighbours in a
 * chain of sites on one line that is a tie, whose sites have all others on one side [CLO-2] [TIE-3], and on both sides
 * where all sites are on one line. */
#include "io/dual.h"

#include "base/alloc.h"
#include "base/index.h"
#include "delaunay/memory.h"
#include "delaunay/undecided.h"
#include <math.h>

static dyd_dual_edge *dual_find(dyd_dual_edge *edge, size_t count, uint32_t i, uint32_t j) {
  const dyd_dual_edge key = {.i = i, .j = j};
  return bsearch(&key, edge, count, sizeof key, dyd_compare_two);
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

const size_t *dyd_dual_tied(const size_t *tied, size_t ties, size_t face) {
  return ties ? bsearch(&face, tied, ties, sizeof face, tied_compare) : NULL;
}

/* Bounds of sign * (b - a) along an axis: an operation in doubles, then one step outward. */
static void dual_difference(double out[2], const double a[2], const double b[2], int sign) {
  double lo = sign > 0 ? b[0] - a[1] : a[0] - b[1], hi = sign > 0 ? b[1] - a[0] : a[1] - b[0];
  out[0] = nextafter(lo, -INFINITY);
  out[1] = nextafter(hi, INFINITY);
}

/* right: 1 where all other points are on the left of i to j, so that the ray is end[1]; else 0, the other way round. */
static void dual_set_ray(dyd_dual_edge *e, const dyd_delaunay *pd, int right) {
  double a[4], b[4];
  dyd_sites_get_d(a, dyd_delaunay_sites(pd), e->i);
  dyd_sites_get_d(b, dyd_delaunay_sites(pd), e->j);
  dyd_dual_end *end = &e->end[right];
  end->kind = DYD_DUAL_RAY;
  dual_difference(end->direction, a + 2, b + 2, right ? 1 : -1);
  dual_difference(end->direction + 2, a, b, right ? -1 : 1);
}

/* first: the number of the vertex of the first tied polygon. */
typedef struct dual_ties {
  const size_t *tied;
  size_t count, first;
} dual_ties;

/* An end that is in no triangle may be in a tied polygon, or beyond a tied chain of the hull. */
static void dual_join_tie(dyd_dual_edge *e, int end, const dyd_delaunay *pd, const dual_ties *ties) {
  uint32_t v[2] = {pd->sk.vertex[e->i], pd->sk.vertex[e->j]};
  dyd_half_edge h = dyd_find_edge(&pd->sk, v[end], v[1 - end]);
  size_t face = h == DYD_NONE ? DYD_NONE : dyd_face_of(pd, dyd_edge_triangle(h));
  const size_t *found = dyd_dual_tied(ties->tied, ties->count, face);
  if (found)
    e->end[end] = (dyd_dual_end){.kind = DYD_DUAL_VERTEX, .vertex = ties->first + (size_t)(found - ties->tied)};
  else if (face != DYD_NONE && dyd_open_is_outer(pd, face) && dyd_open_status_of(pd, face) == DYD_TIE)
    dual_set_ray(e, pd, end);
}

static void dual_join_ties(dyd_dual_edge *e, const dyd_delaunay *pd, const dual_ties *ties) {
  for (int end = 0; end < 2; end++) {
    if (e->end[end].kind != DYD_DUAL_OPEN) continue;
    if (pd->open.kind == DYD_LINE)
      dual_set_ray(e, pd, end);
    else if (pd->open.count)
      dual_join_tie(e, end, pd, ties);
  }
}

/* A sure hull edge with a vertex on one side has its ray on the other. Where both sides are open, nothing is said. */
static dyd_status dual_join_rays(dyd_dual_edge *edge, size_t count, const dyd_delaunay *pd) {
  dyd_hull hull = {0};
  dyd_status st = dyd_delaunay_partial_hull(&hull, pd);
  if (st == DYD_CAPPED) st = DYD_OK; /* then it lists no pairs */
  for (size_t k = 0; st == DYD_OK && k < hull.pairs.count; k++) {
    if (hull.pairs.item[k].status != DYD_LEGAL) continue;
    dyd_dual_edge *e = dual_find(edge, count, hull.pairs.item[k].i, hull.pairs.item[k].j);
    if (e && (e->end[0].kind == DYD_DUAL_VERTEX) != (e->end[1].kind == DYD_DUAL_VERTEX))
      dual_set_ray(e, pd, e->end[0].kind == DYD_DUAL_VERTEX);
  }
  dyd_hull_clear(&hull);
  return st;
}

dyd_status dyd_dual_edges(dyd_dual_edge **out, size_t *count, const dyd_delaunay *pd,
                          const dyd_triangle_list *triangles, const size_t *tied, size_t ties, dyd_room *room) {
  dyd_pair_list pairs = {0};
  size_t legal = 0;
  uint64_t bytes = dyd_pairs_bytes(pd, DYD_LEGAL),
           edges = dyd_bytes_times(bytes / sizeof(dyd_pair), sizeof(dyd_dual_edge));
  if (!dyd_room_has(room, dyd_bytes_add(bytes, edges), "the edges of the diagram")) return DYD_E_NOMEM;
  dyd_status st = dyd_pairs_take(&pairs, pd, DYD_LEGAL);
  dyd_dual_edge *edge = st == DYD_OK ? calloc(pairs.count ? pairs.count : 1, sizeof *edge) : NULL;
  if (st == DYD_OK && !edge) st = DYD_E_NOMEM;
  for (; st == DYD_OK && legal < pairs.count; legal++) {
    edge[legal].i = pairs.item[legal].i;
    edge[legal].j = pairs.item[legal].j;
  }
  dyd_pair_list_clear(&pairs);
  if (st == DYD_OK) {
    dual_join_triangles(edge, legal, triangles);
    const dual_ties all = {.tied = tied, .count = ties, .first = triangles->count};
    for (size_t k = 0; k < legal; k++) dual_join_ties(&edge[k], pd, &all);
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
