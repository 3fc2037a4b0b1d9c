/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Finding the faces of exact points, and their vertices. */
#include "delaunay/ties.h"

#include "base/alloc.h"
#include "delaunay/face_table.h"

/* Invariant: list[0..count-1] are triangles of the face in work. */
typedef struct tie_flood {
  uint32_t *list;
  size_t count, cap;
  bool ghost; /* a chain */
} tie_flood;

static bool tie_mark(tie_flood *f, dyd_delaunay *pd, uint32_t t, uint32_t face) {
  if (!dyd_reserve((void **)&f->list, &f->cap, f->count + 1, sizeof *f->list)) return false;
  f->list[f->count++] = t;
  pd->open.of[t] = face;
  return true;
}

/* All triangles joined to t by uncertain edges. */
static dyd_status tie_flood_from(tie_flood *f, dyd_delaunay *pd, uint32_t t, uint32_t face) {
  f->count = 0;
  f->ghost = dyd_is_ghost_triangle(&pd->sk.mesh, t);
  if (!tie_mark(f, pd, t, face)) return DYD_E_NOMEM;
  for (size_t q = 0; q < f->count; q++)
    for (dyd_half_edge h = dyd_edge_of(f->list[q], 0), end = dyd_edge_end(f->list[q]); h < end; h++) {
      uint32_t beyond = dyd_edge_triangle(dyd_edge_twin(&pd->sk.mesh, h));
      if (dyd_edge_is_certain(&pd->sk, h) || pd->open.of[beyond] == face) continue;
      if (!tie_mark(f, pd, beyond, face)) return DYD_E_NOMEM;
    }
  return DYD_OK;
}

/* Counts the pairs of the face in work, of t triangles. A polygon has t + 2 sites, a chain t + 1. */
static void tie_settle(dyd_delaunay *pd, uint64_t t, bool ghost) {
  dyd_undecided *table = &pd->open;
  table->tied_pairs += dyd_group_pairs(ghost ? t + 1 : t + 2, ghost);
  if (t == 2 && !ghost) table->seed[table->count] |= DYD_SEED_QUAD;
  table->count++;
}

/* Two triangles joined by the only uncertain edge of both, no ghost among them: marks them. */
static bool is_quad(dyd_delaunay *pd, uint32_t t, uint32_t face) {
  const dyd_mesh *m = &pd->sk.mesh;
  unsigned open = 7 & ~pd->sk.certain[t];
  if ((open & (open - 1)) || dyd_is_ghost_triangle(m, t)) return false;
  /* no ghost beyond: the edge would be one of the hull, and certain */
  uint32_t u = dyd_edge_triangle(dyd_edge_twin(m, dyd_edge_of(t, open >> 1)));
  unsigned other = 7 & ~pd->sk.certain[u];
  if (other & (other - 1)) return false;
  pd->open.of[t] = pd->open.of[u] = face;
  return true;
}

static dyd_status tie_find_face(tie_flood *f, dyd_delaunay *pd, dyd_work *w, uint32_t t) {
  dyd_undecided *table = &pd->open;
  uint32_t face = (uint32_t)table->count;
  if (dyd_work_cancelled(w)) return DYD_CANCELLED;
  if (!dyd_reserve((void **)&table->seed, &table->seed_cap, table->count + 1, sizeof *table->seed)) return DYD_E_NOMEM;
  table->seed[face] = t;
  w->counters.faces++;
  if (is_quad(pd, t, face)) return tie_settle(pd, 2, false), DYD_OK;
  dyd_status st = tie_flood_from(f, pd, t, face);
  if (st == DYD_OK) tie_settle(pd, f->count, f->ghost);
  return st;
}

dyd_status dyd_ties_find(dyd_delaunay *pd, dyd_work *w) {
  tie_flood f = {0};
  dyd_status st = DYD_OK;
  if (pd->sk.mesh.tally.ties == 0) return DYD_OK; /* [TIE-1] */
  for (uint32_t t = 0; t < pd->sk.mesh.count && st == DYD_OK; t++) {
    if (dyd_triangle_is_certain(&pd->sk, t)) continue;
    st = dyd_table_mark(pd);
    if (st == DYD_OK && pd->open.of[t] == DYD_NONE) st = tie_find_face(&f, pd, w, t);
  }
  free(f.list);
  if (st != DYD_OK) dyd_table_clear(&pd->open);
  return st;
}

/* ---- reading ---- */

dyd_status dyd_tie_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f) {
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_half_edge first = dyd_tie_start(pd, f), h = first;
  uint32_t *v = NULL;
  size_t kept = 0, cap = 0;
  do {
    uint32_t w = dyd_edge_origin(m, h);
    if (!dyd_reserve((void **)&v, &cap, kept + 1, sizeof *v)) return free(v), DYD_E_NOMEM;
    if (w != m->n) v[kept++] = w;
    h = dyd_tie_next(&pd->sk, h);
  } while (h != first);
  qsort(v, kept, sizeof *v, dyd_compare_index);
  *vertex = v;
  *count = kept;
  return DYD_OK;
}
