/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sure triangles, sorted or as they stand in the mesh, and who is next to whom.
 *
 * To be sorted they are dealt to their lowest sites; a site has few. In the order of the mesh, which is near that of
 * the Hilbert curve, all that belongs to one triangle is near in memory, too. */
#include "base/alloc.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"

#include <string.h>

/* A sure triangle and its number in the mesh. */
typedef struct dealt {
  dyd_triangle sites;
  uint32_t mesh;
} dealt;

/* The corner of triangle t of the mesh with the lowest site. */
static unsigned lowest_corner(const dyd_skeleton *sk, uint32_t t) {
  const uint32_t *v = sk->mesh.tri[t].v, s[3] = {sk->reps.site[v[0]], sk->reps.site[v[1]], sk->reps.site[v[2]]};
  return s[0] < s[1] ? (s[0] < s[2] ? 0 : 2) : (s[1] < s[2] ? 1 : 2);
}

static dealt dealt_of(const dyd_skeleton *sk, uint32_t t) {
  const uint32_t *v = sk->mesh.tri[t].v, *site = sk->reps.site;
  unsigned low = lowest_corner(sk, t);
  return (dealt){{{site[v[low]], site[v[dyd_next(low)]], site[v[dyd_prev(low)]]}}, t};
}

/* By the second corner, then by the third, for triangles of one lowest site. */
static bool dealt_is_before(const dealt *a, const dealt *b) {
  const uint32_t *u = a->sites.v, *v = b->sites.v;
  return u[1] != v[1] ? u[1] < v[1] : u[2] < v[2];
}

static int dealt_compare(const void *a, const void *b) {
  return dealt_is_before(b, a) - dealt_is_before(a, b);
}

/* The triangles of one lowest site: nearly always few. */
static void sort_dealt(dealt *run, size_t count) {
  enum { SHORT_RUN = 24 };
  if (count > SHORT_RUN) qsort(run, count, sizeof *run, dealt_compare);
  for (size_t q = 1; q < count && count <= SHORT_RUN; q++) {
    dealt t = run[q];
    size_t r = q;
    for (; r && dealt_is_before(&t, &run[r - 1]); r--) run[r] = run[r - 1];
    run[r] = t;
  }
}

/* start[i]: how many have a lowest site below i; start[n]: how many there are. */
static void count_starts(uint32_t *start, const dyd_delaunay *pd) {
  const dyd_skeleton *sk = &pd->sk;
  memset(start, 0, ((size_t)sk->n + 1) * sizeof *start);
  for (uint32_t t = 0; t < sk->mesh.count; t++)
    if (dyd_triangle_is_sure(pd, t)) start[sk->reps.site[sk->mesh.tri[t].v[lowest_corner(sk, t)]] + 1]++;
  for (uint32_t i = 0; i < sk->n; i++) start[i + 1] += start[i];
}

/* Each start moves on to the end of its site's run. */
static void deal_all(dealt *to, uint32_t *start, const dyd_delaunay *pd) {
  for (uint32_t t = 0; t < pd->sk.mesh.count; t++) {
    if (!dyd_triangle_is_sure(pd, t)) continue;
    dealt d = dealt_of(&pd->sk, t);
    to[start[d.sites.v[0]]++] = d;
  }
  for (uint32_t i = 0, first = 0; i < pd->sk.n; first = start[i++]) sort_dealt(to + first, start[i] - first);
}

/* All of them, sorted; owned by the caller. */
static dyd_status deal_triangles(dealt **out, size_t *count, const dyd_delaunay *pd) {
  uint32_t *start = dyd_alloc((size_t)pd->sk.n + 1, sizeof *start);
  if (!start) return DYD_E_NOMEM;
  count_starts(start, pd);
  *count = start[pd->sk.n];
  *out = dyd_alloc(*count, sizeof **out);
  if (*out) deal_all(*out, start, pd);
  free(start);
  return *out ? DYD_OK : DYD_E_NOMEM;
}

static dyd_status list_triangles(dyd_triangle_list *out, const dealt *from, size_t count) {
  dyd_triangle *item = dyd_alloc(count, sizeof *item);
  if (!item) return DYD_E_NOMEM;
  for (size_t k = 0; k < count; k++) item[k] = from[k].sites;
  *out = (dyd_triangle_list){count, item};
  return DYD_OK;
}

/* The number in the list of every triangle of the mesh, where it has one. */
static dyd_status number_triangles(uint32_t **out, const dyd_mesh *m, const dealt *from, size_t count) {
  uint32_t *place = dyd_alloc(m->count, sizeof *place);
  if (!place) return DYD_E_NOMEM;
  if (m->count) memset(place, 0xff, m->count * sizeof *place);
  for (size_t k = 0; k < count; k++) place[from[k].mesh] = (uint32_t)k;
  *out = place;
  return DYD_OK;
}

static dyd_status list_neighbours(dyd_triangle_list *out, const dyd_skeleton *sk, const dealt *from, size_t count) {
  uint32_t *place;
  dyd_status st = number_triangles(&place, &sk->mesh, from, count);
  dyd_triangle *item = st == DYD_OK ? dyd_alloc(count, sizeof *item) : NULL;
  for (size_t k = 0; item && k < count; k++) {
    unsigned corner = lowest_corner(sk, from[k].mesh);
    for (int q = 0; q < 3; q++, corner = dyd_next(corner)) {
      dyd_half_edge beyond = dyd_edge_twin(&sk->mesh, dyd_edge_of(from[k].mesh, corner));
      item[k].v[q] = place[dyd_edge_triangle(beyond)];
    }
  }
  if (st == DYD_OK) free(place);
  if (st == DYD_OK && item) *out = (dyd_triangle_list){count, item};
  return item ? DYD_OK : DYD_E_NOMEM;
}

static uint64_t triangles_bytes(const dyd_delaunay *pd, bool neighbours) {
  uint64_t beyond = dyd_bytes_times(pd->sk.mesh.count, sizeof(dyd_triangle) + sizeof(uint32_t));
  return dyd_bytes_add(dyd_triangles_bytes(pd), neighbours ? beyond : 0);
}

dyd_status dyd_delaunay_triangles_and_neighbours(dyd_triangle_list *out, dyd_triangle_list *neighbours,
                                                 const dyd_delaunay *pd) {
  if (!pd) return DYD_E_ARG;
  dealt *all = NULL;
  size_t count = 0;
  dyd_triangle_list triangles = {0}, beyond = {0};
  dyd_status st = dyd_delaunay_grant(pd, triangles_bytes(pd, neighbours), "the list of triangles", NULL);
  if (st == DYD_OK) st = deal_triangles(&all, &count, pd);
  if (st == DYD_OK) st = list_triangles(&triangles, all, count);
  if (st == DYD_OK && neighbours) st = list_neighbours(&beyond, &pd->sk, all, count);
  free(all);
  if (st != DYD_OK) {
    dyd_triangle_list_clear(&triangles);
    return st;
  }
  dyd_triangle_list_clear(out);
  *out = triangles;
  if (neighbours) {
    dyd_triangle_list_clear(neighbours);
    *neighbours = beyond;
  }
  return DYD_OK;
}

dyd_status dyd_delaunay_triangles(dyd_triangle_list *out, const dyd_delaunay *pd) {
  if (!pd) return DYD_E_ARG;
  return dyd_delaunay_triangles_and_neighbours(out, NULL, pd);
}

/* ---- as they stand in the mesh ---- */

/* The number of every triangle of the mesh among the sure ones, and how many these are. */
static size_t number_as_found(uint32_t *place, const dyd_delaunay *pd) {
  uint32_t count = 0;
  for (uint32_t t = 0; t < pd->sk.mesh.count; t++) place[t] = dyd_triangle_is_sure(pd, t) ? count++ : DYD_NO_TRIANGLE;
  return count;
}

static void list_as_found(dyd_triangle *triangle, dyd_triangle *beyond, const uint32_t *place, const dyd_delaunay *pd) {
  const dyd_skeleton *sk = &pd->sk;
  for (uint32_t t = 0; t < sk->mesh.count; t++) {
    if (place[t] == DYD_NO_TRIANGLE) continue;
    unsigned corner = lowest_corner(sk, t);
    for (int q = 0; q < 3; q++, corner = dyd_next(corner)) {
      triangle[place[t]].v[q] = sk->reps.site[sk->mesh.tri[t].v[corner]];
      beyond[place[t]].v[q] = place[dyd_edge_triangle(dyd_edge_twin(&sk->mesh, dyd_edge_of(t, corner)))];
    }
  }
}

dyd_status dyd_delaunay_triangles_as_found(dyd_triangle_list *out, dyd_triangle_list *neighbours,
                                           const dyd_delaunay *pd) {
  if (!pd) return DYD_E_ARG;
  uint32_t *place = dyd_alloc(pd->sk.mesh.count, sizeof *place);
  if (!place) return DYD_E_NOMEM;
  size_t count = number_as_found(place, pd);
  dyd_triangle *triangle = dyd_alloc(count, sizeof *triangle), *beyond = dyd_alloc(count, sizeof *beyond);
  if (triangle && beyond) {
    list_as_found(triangle, beyond, place, pd);
    dyd_triangle_list_clear(out);
    dyd_triangle_list_clear(neighbours);
    *out = (dyd_triangle_list){count, triangle};
    *neighbours = (dyd_triangle_list){count, beyond};
  } else {
    free(triangle);
    free(beyond);
  }
  free(place);
  return triangle && beyond ? DYD_OK : DYD_E_NOMEM;
}
