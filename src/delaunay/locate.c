/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Places among the triangles.
 *
 * If a place is in a triangle for every choice, it is in that triangle for the representatives, which are one choice.
 * So an exact walk among the representatives' triangles finds the only candidates: the one it ends in, and where the
 * place is on its sides those around its corners. Beyond the hull of the representatives, the place is outside for
 * every choice if it is not in the hull of all rectangles, which is the union of the hulls of all choices. */
#include "base/alloc.h"
#include "base/local.h"
#include "delaunay/state.h"
#include "skeleton/mesh_filter.h"
#include <dyadel/predicate.h>
#include <math.h>
#include <stdlib.h>

/* r: scratch. failed: DYD_OK, or why answers since then mean nothing. corner[count]: the hull of the outward boxes of
 * all rectangles, counter-clockwise; made when first needed. */
typedef struct locator {
  const dyd_delaunay *pd;
  dyd_rect r[3];
  dyd_status failed;
  dyd_xy *corner;
  size_t count;
  bool made;
} locator;

/* Exact sign: > 0 left turn. All are finite. */
static int places_turn(locator *l, dyd_xy a, dyd_xy b, dyd_xy c) {
  const dyd_mesh *m = &l->pd->sk.mesh;
  int sign = m->no_filter ? 0 : dyd_filter_orient_near(m, a, b, c);
  if (sign) return sign;
  (void)dyd_rect_set_d(&l->r[0], a.x, a.x, a.y, a.y);
  (void)dyd_rect_set_d(&l->r[1], b.x, b.x, b.y, b.y);
  (void)dyd_rect_set_d(&l->r[2], c.x, c.x, c.y, c.y);
  return (int)dyd_orientation(&l->r[0], &l->r[1], &l->r[2]);
}

/* ---- the hull of all rectangles ---- */

static int compare_corners(const void *a, const void *b) {
  const dyd_xy *p = a, *q = b;
  if (p->x != q->x) return p->x < q->x ? -1 : 1;
  return (p->y > q->y) - (p->y < q->y);
}

/* Replaces the corners by those of their hull: along its lower side, then back along the upper one. */
static dyd_status hull_of_corners(locator *l) {
  size_t n = l->count, count = 0, low = 1;
  dyd_xy *all = l->corner, *hull = dyd_alloc(2 * n + 1, sizeof *hull);
  if (!hull) return DYD_E_NOMEM;
  qsort(all, n, sizeof *all, compare_corners);
  for (size_t k = 0; k + 1 < 2 * n; k++) {
    dyd_xy z = all[k < n ? k : 2 * n - 2 - k];
    if (k == n) low = count;
    while (count > low && places_turn(l, hull[count - 2], hull[count - 1], z) <= 0) count--;
    hull[count++] = z;
  }
  l->corner = hull;
  l->count = count > 1 ? count - 1 : count; /* the first one comes last again */
  free(all);
  return DYD_OK;
}

/* Makes the hull of all sites that may be on the hull of some choice; no corners where doubles do not hold them. */
static dyd_status make_hull(locator *l) {
  DYD_SCOPED(dyd_hull) hull = {0};
  const dyd_index_list *possible = &hull.possible_vertices;
  dyd_status st = dyd_delaunay_partial_hull(&hull, l->pd, false);
  if (st == DYD_OK) l->corner = dyd_alloc(4 * possible->count, sizeof *l->corner);
  if (st == DYD_OK && !l->corner) st = DYD_E_NOMEM;
  bool finite = true;
  for (size_t k = 0; k < possible->count && st == DYD_OK; k++) {
    double b[4];
    dyd_sites_get_d(b, dyd_delaunay_sites(l->pd), possible->item[k]);
    for (int q = 0; q < 4; q++) finite = finite && isfinite(b[q]);
    for (int q = 0; q < 4; q++) l->corner[l->count++] = (dyd_xy){b[q & 1], b[2 + (q >> 1)]};
  }
  if (!finite) l->count = 0;
  l->made = true;
  return st == DYD_OK && l->count ? hull_of_corners(l) : st;
}

/* Returns true if z is outside of the hull. The box of a flat hull decides about its line. */
static bool place_is_beyond(locator *l, dyd_xy z) {
  bool left = true, right = true, below = true, above = true;
  for (size_t k = 0; k < l->count; k++) {
    dyd_xy a = l->corner[k], b = l->corner[(k + 1) % l->count];
    if (l->count > 1 && places_turn(l, a, b, z) < 0) return true;
    left = left && z.x < a.x, right = right && z.x > a.x;
    below = below && z.y < a.y, above = above && z.y > a.y;
  }
  return l->count && (left || right || below || above);
}

/* ---- triangles ---- */

/* Exact sign of the representatives of a and b and the place z. */
static int reps_turn(locator *l, uint32_t a, uint32_t b, dyd_xy z) {
  const dyd_mesh *m = &l->pd->sk.mesh;
  int sign = m->no_filter ? 0 : dyd_filter_orient_near(m, m->xy[a], m->xy[b], z);
  if (sign) return sign;
  for (int k = 0; k < 2 && l->failed == DYD_OK; k++) l->failed = dyd_mesh_get(&l->r[k], m, k ? b : a);
  if (l->failed != DYD_OK) return 0;
  (void)dyd_rect_set_d(&l->r[2], z.x, z.x, z.y, z.y);
  return (int)dyd_orientation(&l->r[0], &l->r[1], &l->r[2]);
}

/* Returns true if z is on the left of the way from a to b for every choice. On it is enough between exact points. */
static bool is_on_left(locator *l, uint32_t a, uint32_t b, dyd_xy z) {
  const dyd_skeleton *sk = &l->pd->sk;
  if (dyd_vertex_is_point(sk, a) && dyd_vertex_is_point(sk, b)) return reps_turn(l, a, b, z) >= 0;
  for (int k = 0; k < 2 && l->failed == DYD_OK; k++)
    l->failed = dyd_sites_get(&l->r[k], dyd_delaunay_sites(l->pd), sk->reps.site[k ? b : a]);
  if (l->failed != DYD_OK) return false;
  (void)dyd_rect_set_d(&l->r[2], z.x, z.x, z.y, z.y);
  return dyd_orientation(&l->r[0], &l->r[1], &l->r[2]) == DYD_SURE_PLUS;
}

/* Its sites, lowest number first, where z is in triangle t for every choice, unless *out comes before it. */
static void offer_triangle(dyd_triangle *out, locator *l, uint32_t t, dyd_xy z) {
  const dyd_skeleton *sk = &l->pd->sk;
  const uint32_t *v = sk->mesh.tri[t].v;
  if (!dyd_triangle_is_sure(l->pd, t)) return;
  dyd_triangle at = {{sk->reps.site[v[0]], sk->reps.site[v[1]], sk->reps.site[v[2]]}};
  while (at.v[0] > at.v[1] || at.v[0] > at.v[2]) at = (dyd_triangle){{at.v[1], at.v[2], at.v[0]}};
  if (at.v[0] > out->v[0] || (at.v[0] == out->v[0] && at.v[1] >= out->v[1])) return;
  for (unsigned k = 0; k < 3; k++)
    if (!is_on_left(l, v[dyd_next(k)], v[dyd_prev(k)], z)) return;
  *out = at;
}

/* The triangle of the representatives that holds z, or the ghost triangle of a hull edge that z is strictly beyond:
 * mesh_locate in src/skeleton/mesh_build.c explains why the walk ends. */
static uint32_t walk_to(locator *l, uint32_t from, dyd_xy z) {
  const dyd_mesh *m = &l->pd->sk.mesh;
  if (dyd_is_ghost_triangle(m, from)) from = dyd_edge_triangle(dyd_edge_twin(m, dyd_hull_edge(m, from)));
  dyd_half_edge h = dyd_edge_of(from, 0);
  if (reps_turn(l, dyd_edge_origin(m, h), dyd_edge_target(m, h), z) < 0) h = dyd_edge_twin(m, h);
  while (dyd_edge_apex(m, h) != m->n) {
    uint32_t a = dyd_edge_origin(m, h), b = dyd_edge_target(m, h), c = dyd_edge_apex(m, h);
    if (reps_turn(l, b, c, z) < 0)
      h = dyd_edge_twin(m, dyd_edge_next(h));
    else if (reps_turn(l, c, a, z) < 0)
      h = dyd_edge_twin(m, dyd_edge_prev(h));
    else
      break;
  }
  return dyd_edge_triangle(h);
}

/* Offers the triangle t around z, and all around its corners where z is on a side of it. */
static void offer_around(dyd_triangle *out, locator *l, uint32_t t, dyd_xy z) {
  const dyd_mesh *m = &l->pd->sk.mesh;
  const uint32_t *v = m->tri[t].v;
  bool inside = true;
  for (unsigned k = 0; k < 3; k++) inside = inside && reps_turn(l, v[dyd_next(k)], v[dyd_prev(k)], z) > 0;
  if (inside) {
    offer_triangle(out, l, t, z);
    return;
  }
  for (unsigned k = 0; k < 3; k++) {
    dyd_half_edge first = dyd_edge_of(t, dyd_prev(k)), h = first;
    do
      if (!dyd_is_ghost_triangle(m, dyd_edge_triangle(h))) offer_triangle(out, l, dyd_edge_triangle(h), z);
    while ((h = dyd_edge_around(m, h, first)) != DYD_NONE);
  }
}

/* *from: where the walk begins; becomes where it ended. */
static dyd_status locate_one(dyd_triangle *out, dyd_truth *in, locator *l, uint32_t *from, dyd_xy z) {
  const dyd_skeleton *sk = &l->pd->sk;
  bool line = sk->mesh.count == 0;
  *out = (dyd_triangle){{DYD_NO_TRIANGLE, DYD_NO_TRIANGLE, DYD_NO_TRIANGLE}};
  *in = DYD_UNKNOWN;
  if (!line) *from = walk_to(l, *from, z);
  bool ghost = line || dyd_is_ghost_triangle(&sk->mesh, *from);
  if (!ghost) offer_around(out, l, *from, z);
  if (out->v[0] != DYD_NO_TRIANGLE) *in = DYD_TRUE;
  if (!ghost || l->failed != DYD_OK) return l->failed;
  if (!line && sk->all_points) return *in = DYD_FALSE, DYD_OK;
  dyd_status st = l->made ? DYD_OK : make_hull(l);
  if (st == DYD_OK && place_is_beyond(l, z)) *in = DYD_FALSE;
  return st;
}

dyd_status dyd_delaunay_locate(dyd_triangle *out, dyd_truth *in, const dyd_delaunay *pd, const double *xy, size_t count,
                               const volatile int *cancel) {
  if (!pd || (count && (!out || !in || !xy))) return DYD_E_ARG;
  for (size_t k = 0; k < 2 * count; k++)
    if (!isfinite(xy[k])) return DYD_E_ARG;
  locator l = {.pd = pd};
  dyd_status st = DYD_OK;
  uint32_t from = 0;
  for (int k = 0; k < 3; k++) dyd_rect_init(&l.r[k]);
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    st = locate_one(&out[k], &in[k], &l, &from, (dyd_xy){xy[2 * k], xy[2 * k + 1]});
    if (dyd_flag_is_set(cancel)) st = DYD_CANCELLED;
  }
  for (int k = 0; k < 3; k++) dyd_rect_clear(&l.r[k]);
  free(l.corner);
  return st;
}

/* ---- corners of the triangle around a place, for some choice ---- */

void dyd_place_list_clear(dyd_place_list *l) {
  if (!l) return;
  dyd_free_all(l->site, l->end, l->sure);
  *l = (dyd_place_list){0};
}

/* seen: triangles that the place may be in. mark: of each triangle, the place that it was seen for last, from 1. */
typedef struct corner_search {
  locator l;
  uint32_t *seen, *mark;
  size_t count, seen_cap, site_cap;
  dyd_place_list out;
} corner_search;

static bool corner_see(corner_search *s, uint32_t t) {
  if (s->mark[t] == s->out.places + 1) return true;
  s->mark[t] = (uint32_t)s->out.places + 1;
  if (!DYD_GROW(s->seen, s->seen_cap, s->count + 1)) return false;
  s->seen[s->count++] = t;
  return true;
}

/* Is z at the exact point v? */
static bool is_at(const dyd_skeleton *sk, uint32_t v, dyd_xy z) {
  return dyd_vertex_is_point(sk, v) && dyd_reps_is_double(&sk->reps, v) && sk->mesh.xy[v].x == z.x &&
         sk->mesh.xy[v].y == z.y;
}

/* [LOC-6] From the triangle t of the representatives over all edges that z is not on the inner side of for every
 * choice, or that some choice does not have as an edge. *sure: none leads outside. */
static dyd_status corner_flood(bool *sure, corner_search *s, uint32_t t, dyd_xy z) {
  const dyd_skeleton *sk = &s->l.pd->sk;
  s->count = 0;
  *sure = true;
  if (!corner_see(s, t)) return DYD_E_NOMEM;
  for (size_t k = 0; k < s->count && *sure; k++) {
    *sure = !dyd_is_ghost_triangle(&sk->mesh, s->seen[k]);
    for (dyd_half_edge h = dyd_edge_of(s->seen[k], 0), end = dyd_edge_end(s->seen[k]); h < end && *sure; h++) {
      if (dyd_edge_is_certain(sk, h) &&
          is_on_left(&s->l, dyd_edge_origin(&sk->mesh, h), dyd_edge_target(&sk->mesh, h), z))
        continue;
      if (!corner_see(s, dyd_edge_triangle(dyd_edge_twin(&sk->mesh, h)))) return DYD_E_NOMEM;
    }
  }
  return s->l.failed;
}

/* Where z is at an exact point of t, or on a certain edge between two: these alone give the value. Returns how many. */
static size_t corner_exact(uint32_t site[2], corner_search *s, uint32_t t, dyd_xy z) {
  const dyd_skeleton *sk = &s->l.pd->sk;
  const uint32_t *v = sk->mesh.tri[t].v;
  size_t count = 0;
  if (dyd_is_ghost_triangle(&sk->mesh, t)) return 0;
  for (unsigned k = 0; k < 3 && !count; k++)
    if (is_at(sk, v[k], z)) site[count++] = sk->reps.site[v[k]];
  for (unsigned k = 0; k < 3 && !count; k++) {
    uint32_t a = v[dyd_next(k)], b = v[dyd_prev(k)];
    if (!dyd_edge_is_certain(sk, dyd_edge_of(t, k)) || !dyd_vertex_is_point(sk, a) || !dyd_vertex_is_point(sk, b))
      continue;
    if (reps_turn(&s->l, a, b, z) == 0) site[count++] = sk->reps.site[a], site[count++] = sk->reps.site[b];
  }
  return count;
}

/* Adds the sites of the triangles seen; none unless the place is surely in one. */
static dyd_status corner_list(corner_search *s, bool sure, const uint32_t exact[2], size_t alone) {
  dyd_place_list *o = &s->out;
  const dyd_skeleton *sk = &s->l.pd->sk;
  size_t begin = o->places ? o->end[o->places - 1] : 0, count = alone ? alone : sure ? 3 * s->count : 0, kept = begin;
  if (!DYD_GROW(o->site, s->site_cap, begin + count)) return DYD_E_NOMEM;
  for (size_t k = 0; k < count; k++)
    o->site[begin + k] = alone ? exact[k] : sk->reps.site[sk->mesh.tri[s->seen[k / 3]].v[k % 3]];
  if (count) qsort(o->site + begin, count, sizeof *o->site, dyd_compare_index);
  for (size_t k = begin; k < begin + count; k++)
    if (k == begin || o->site[k] != o->site[kept - 1]) o->site[kept++] = o->site[k];
  o->sure[o->places] = sure || alone;
  o->end[o->places++] = kept;
  return DYD_OK;
}

static dyd_status corners_find(corner_search *s, uint32_t *from, dyd_xy z) {
  uint32_t exact[2];
  size_t alone = 0;
  bool sure = false;
  dyd_status st = DYD_OK;
  s->count = 0;
  if (s->l.pd->sk.mesh.count) {
    *from = walk_to(&s->l, *from, z);
    alone = corner_exact(exact, s, *from, z);
    if (!alone) st = corner_flood(&sure, s, *from, z);
  }
  return st == DYD_OK ? corner_list(s, sure, exact, alone) : st;
}

dyd_status dyd_delaunay_corners(dyd_place_list *out, const dyd_delaunay *pd, const double *xy, size_t count,
                                const volatile int *cancel) {
  if (!out || !pd || (count && !xy) || count >= UINT32_MAX) return DYD_E_ARG;
  for (size_t k = 0; k < 2 * count; k++)
    if (!isfinite(xy[k])) return DYD_E_ARG;
  corner_search s = {.l = {.pd = pd}, .mark = calloc(pd->sk.mesh.count + (size_t)1, sizeof *s.mark)};
  s.out.end = dyd_alloc(count, sizeof *s.out.end);
  s.out.sure = dyd_alloc(count, sizeof *s.out.sure);
  dyd_status st = s.mark && s.out.end && s.out.sure ? DYD_OK : DYD_E_NOMEM;
  uint32_t from = 0;
  for (int k = 0; k < 3; k++) dyd_rect_init(&s.l.r[k]);
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    st = corners_find(&s, &from, (dyd_xy){xy[2 * k], xy[2 * k + 1]});
    if (dyd_flag_is_set(cancel)) st = DYD_CANCELLED;
  }
  for (int k = 0; k < 3; k++) dyd_rect_clear(&s.l.r[k]);
  dyd_free_all(s.mark, s.seen);
  dyd_place_list_clear(st == DYD_OK ? out : &s.out);
  if (st == DYD_OK) *out = s.out;
  return st;
}
