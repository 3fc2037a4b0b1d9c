/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Finding the faces of exact points, and reading them. */
#include "delaunay/ties.h"

#include "base/alloc.h"
#include "base/error.h"
#include "delaunay/faces.h"

/* Invariant: list[0..count-1] are triangles of the face in work. */
typedef struct tie_flood {
  uint32_t *list;
  size_t count, cap;
  bool ghost; /* a chain */
} tie_flood;

static bool mark(tie_flood *f, dyd_delaunay *pd, uint32_t t, uint32_t face) {
  if (!dyd_reserve((void **)&f->list, &f->cap, f->count + 1, sizeof *f->list)) return false;
  f->list[f->count++] = t;
  pd->faces.of[t] = face;
  return true;
}

/* All triangles joined to t by uncertain edges. */
static dyd_status flood(tie_flood *f, dyd_delaunay *pd, uint32_t t, uint32_t face) {
  f->count = 0;
  f->ghost = dyd_mesh_is_ghost(&pd->mesh, t);
  if (!mark(f, pd, t, face)) return DYD_E_NOMEM;
  for (size_t q = 0; q < f->count; q++)
    for (unsigned k = 0; k < 3; k++) {
      uint32_t s = f->list[q], beyond = pd->mesh.tri[s].n[k] >> 2;
      if (dyd_edge_is_certain(pd, s, k) || pd->faces.of[beyond] == face) continue;
      if (!mark(f, pd, beyond, face)) return DYD_E_NOMEM;
    }
  return DYD_OK;
}

static dyd_status report_cap(dyd_delaunay *pd, size_t face) {
  uint32_t *v = NULL, *site = pd->reps.site;
  size_t n;
  dyd_status st = dyd_tie_vertices(&v, &n, pd, face);
  if (st != DYD_OK) return st;
  dyd_fail(
      pd->err, DYD_CAPPED,
      "more than %zu undecided pairs to store: %zu sites around sites %u, %u, %u have too many possible neighbours "
      "(nearly cocircular, collinear or overlapping); raise the cap on pairs, or give narrower rectangles",
      pd->max_pairs, n, site[v[0]], site[v[n / 2]], site[v[n - 1]]);
  free(v);
  return DYD_OK;
}

/* Counts the pairs of the face in work, of t triangles. A polygon of m = t + 2 sites has m sides and t - 1 edges
 * inside; a chain of m = t + 1 sites has t links, and its edges inside go to the ghost. */
static dyd_status settle(dyd_delaunay *pd, uint64_t t, bool ghost) {
  dyd_face_table *table = &pd->faces;
  uint64_t all = ghost ? t * (t - 1) / 2 : (t + 2) * (t - 1) / 2, inside = ghost ? 0 : t - 1;
  size_t face = table->count++;
  if (table->live_pairs <= pd->max_pairs && all <= pd->max_pairs - table->live_pairs) {
    table->live_pairs += all;
    if (t == 2 && !ghost) table->seed[face] |= DYD_SEED_QUAD;
    return DYD_OK;
  }
  table->seed[face] |= DYD_SEED_CAPPED;
  table->live_pairs += inside;
  table->capped_pairs += inside;
  return report_cap(pd, face);
}

/* Two triangles joined by the only uncertain edge of both, no ghost among them: marks them. */
static bool is_quad(dyd_delaunay *pd, uint32_t t, uint32_t face) {
  unsigned open = 7 & ~pd->certain[t], k = open >> 1;
  if ((open & (open - 1)) || dyd_mesh_is_ghost(&pd->mesh, t)) return false;
  uint32_t u = pd->mesh.tri[t].n[k] >> 2; /* no ghost: the edge would be one of the hull, and certain */
  unsigned other = 7 & ~pd->certain[u];
  if (other & (other - 1)) return false;
  pd->faces.of[t] = pd->faces.of[u] = face;
  return true;
}

static dyd_status find_face(tie_flood *f, dyd_delaunay *pd, uint32_t t) {
  dyd_face_table *table = &pd->faces;
  uint32_t face = (uint32_t)table->count;
  if (dyd_cancelled(pd)) return DYD_CANCELLED;
  if (!dyd_reserve((void **)&table->seed, &table->seed_cap, table->count + 1, sizeof *table->seed)) return DYD_E_NOMEM;
  table->seed[face] = t;
  pd->counters.faces++;
  if (is_quad(pd, t, face)) return settle(pd, 2, false);
  dyd_status st = flood(f, pd, t, face);
  return st == DYD_OK ? settle(pd, f->count, f->ghost) : st;
}

dyd_status dyd_ties_find(dyd_delaunay *pd) {
  tie_flood f = {0};
  dyd_status st = DYD_OK;
  for (uint32_t t = 0; t < pd->mesh.count && st == DYD_OK; t++) {
    if ((pd->certain[t] & 7) == 7) continue;
    st = dyd_faces_mark(pd);
    if (st == DYD_OK && pd->faces.of[t] == DYD_NONE) st = find_face(&f, pd, t);
  }
  free(f.list);
  if (st != DYD_OK) dyd_faces_clear(&pd->faces);
  return st;
}

/* ---- reading ---- */

dyd_status dyd_tie_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f) {
  uint32_t first = dyd_tie_start(pd, f), h = first, *v = NULL;
  size_t kept = 0, cap = 0;
  do {
    uint32_t w = dyd_tie_vertex(&pd->mesh, h);
    if (!dyd_reserve((void **)&v, &cap, kept + 1, sizeof *v)) return free(v), DYD_E_NOMEM;
    if (w != pd->mesh.n) v[kept++] = w;
    h = dyd_tie_next(pd, h);
  } while (h != first);
  qsort(v, kept, sizeof *v, dyd_compare_index);
  *vertex = v;
  *count = kept;
  return DYD_OK;
}

bool dyd_tie_is_outer(const dyd_delaunay *pd, size_t f) {
  return dyd_mesh_is_ghost(&pd->mesh, pd->faces.seed[f] & ~DYD_SEED_MARKS);
}

static bool is_in_face(const dyd_delaunay *pd, uint32_t v, uint32_t face) {
  uint32_t first = pd->corner[v], h = first;
  do {
    if (pd->faces.of[h >> 2] == face) return true;
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
  return false;
}

dyd_pair_status dyd_tie_status(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  uint32_t first = pd->corner[v], h = first, before = DYD_NONE;
  if (!pd->faces.of) return DYD_ILLEGAL;
  do {
    uint32_t face = pd->faces.of[h >> 2];
    if (face != DYD_NONE && face != before && is_in_face(pd, w, face))
      return dyd_tie_is_capped(pd, face) ? DYD_INDETERMINATE : DYD_TIE;
    before = face;
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
  return DYD_ILLEGAL;
}
