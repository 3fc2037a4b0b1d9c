/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Finding faces that are ties: of exact points, and of points that are proved to be on one circle or line.
 *
 * [TIE-3] A face whose rim is one cycle of certain edges through all its vertices, and whose true points are on one
 * circle: the rim is Delaunay for every choice, so the triangles inside use these vertices only, one of them has an
 * empty disc, and that disc has all of them on its circle. So all pairs that are not on the rim are weakly Delaunay,
 * and never strictly. A rim that passes through the ghost is a chain on the hull: if its true points are on one line,
 * all others are on one side of it, and a half-plane takes the place of the disc. */
#include "delaunay/ties.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"

#include <string.h>

/* vertex[0..count-1]: the rim, counter-clockwise; a chain begins behind the ghost, which is omitted. */
typedef struct face_rim {
  uint32_t *vertex, *site;
  uint32_t count;
  bool chain;
} face_rim;

static void face_rim_clear(face_rim *r) {
  dyd_free_all(r->vertex, r->site);
}

static bool has_inexact_vertex(const dyd_delaunay *pd, const face_rim *r) {
  for (uint32_t q = 0; q < r->count; q++)
    if (!dyd_vertex_is_point(&pd->sk, r->vertex[q])) return true;
  return false;
}

/* The triangles are connected; if they are joined like a tree, t of them have t + 2 sides that no other shares, and one
 * cycle passes through all of these. */
dyd_half_edge dyd_rim_start(bool *chain, const dyd_delaunay *pd, const dyd_face *face) {
  const dyd_skeleton *sk = &pd->sk;
  dyd_half_edge start = DYD_NONE;
  uint32_t sides = 0;
  *chain = false;
  for (uint32_t q = 0; q < face->tris; q++) {
    uint32_t t = pd->open.tri[face->first_tri + q];
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++) {
      if (!dyd_edge_is_certain(sk, h)) continue;
      sides++;
      bool ghost = dyd_edge_origin(&sk->mesh, h) == sk->mesh.n;
      if (ghost || start == DYD_NONE) start = h;
      *chain = *chain || ghost;
    }
  }
  return sides == face->tris + 2 ? start : DYD_NONE;
}

static dyd_status are_distinct(bool *distinct, const uint32_t *v, uint32_t count) {
  DYD_FREED uint32_t *sorted = dyd_alloc(count, sizeof *sorted);
  if (!sorted) return DYD_E_NOMEM;
  *distinct = true;
  for (uint32_t q = 0; q < count; q++) sorted[q] = v[q];
  qsort(sorted, count, sizeof *sorted, dyd_compare_index);
  for (uint32_t q = 1; q < count && *distinct; q++) *distinct = sorted[q] != sorted[q - 1];
  return DYD_OK;
}

/* Walks around the face. *found: it is a polygon, or a chain, in which something is open. */
static dyd_status rim_find(bool *found, face_rim *r, const dyd_delaunay *pd, const dyd_face *face) {
  const dyd_skeleton *sk = &pd->sk;
  dyd_half_edge h = dyd_rim_start(&r->chain, pd, face);
  *found = false;
  if (h == DYD_NONE || face->tris < 2) return DYD_OK;
  if (!DYD_NEW(r->vertex, face->tris + 2) || !DYD_NEW(r->site, face->tris + 2)) return DYD_E_NOMEM;
  uint32_t ghosts = 0;
  for (uint32_t q = 0; q < face->tris + 2; q++, h = dyd_tie_next(sk, h)) {
    uint32_t v = dyd_edge_origin(&sk->mesh, h);
    ghosts += v == sk->mesh.n;
    if (v == sk->mesh.n) continue;
    r->site[r->count] = sk->reps.site[v];
    r->vertex[r->count++] = v;
  }
  return ghosts == r->chain ? are_distinct(found, r->vertex, r->count) : DYD_OK;
}

/* ---- pairs ---- */

static bool is_on_rim(const face_rim *r, uint32_t p, uint32_t q) {
  return q == p + 1 || (!r->chain && p == 0 && q + 1 == r->count);
}

/* Returns true if all sites but aliases lie on the chain. Then another face has it from its other side. */
static bool is_everything(const dyd_delaunay *pd, const face_rim *r) {
  return r->chain && 2 * (uint64_t)r->count == (uint64_t)pd->sk.mesh.count + 2;
}

/* All pairs but those of the rim, unless one of them is legal. */
static dyd_status rim_tie(dyd_face *as, dyd_vertex_pair **pair, const dyd_delaunay *pd, const face_rim *r) {
  uint64_t m = r->count;
  dyd_vertex_pair *list = dyd_alloc(m * (m - 1) / 2, sizeof *list);
  uint32_t n = 0;
  if (!(*pair = list)) return DYD_E_NOMEM;
  for (uint32_t p = 0; p < r->count; p++)
    for (uint32_t q = p + 1; q < r->count; q++) {
      uint32_t v = r->vertex[p], w = r->vertex[q];
      if (is_on_rim(r, p, q)) continue;
      if (dyd_is_legal(&pd->sk, v, w)) return DYD_OK;
      list[n++] = v < w ? (dyd_vertex_pair){v, w, 0} : (dyd_vertex_pair){w, v, 0};
    }
  qsort(list, n, sizeof *list, dyd_compare_vertex_pair);
  *as = (dyd_face){.pairs = n, .outer = r->chain, .tie = true, .polygon = !is_everything(pd, r), .proved = true};
  return DYD_OK;
}

/* ---- asking ---- */

static dyd_status ask_rim(bool *proved, const dyd_delaunay *pd, dyd_work *w, const face_rim *r) {
  uint64_t m = r->count, pairs = m * (m - 1) / 2;
  *proved = false;
  if (m < (r->chain ? 3 : 4) || !has_inexact_vertex(pd, r)) return DYD_OK;
  if (pd->open.live_pairs > pd->max_pairs || pairs > pd->max_pairs - pd->open.live_pairs) return DYD_OK;
  dyd_relation relation = r->chain ? DYD_COLLINEAR : DYD_COCIRCULAR;
  return pd->options.prove(proved, pd->options.prove_user, relation, r->site, r->count, w->run->err);
}

dyd_status dyd_prove_face(dyd_face *as, dyd_vertex_pair **pair, const dyd_delaunay *pd, dyd_work *w,
                          const dyd_face *face) {
  DYD_SCOPED(face_rim) r = {0};
  bool found = false, proved = false;
  if (!pd->options.prove) return DYD_OK;
  dyd_status st = rim_find(&found, &r, pd, face);
  if (st == DYD_OK && found) st = ask_rim(&proved, pd, w, &r);
  if (st == DYD_OK && proved) st = rim_tie(as, pair, pd, &r);
  w->counters.faces += st == DYD_OK && proved;
  return st;
}

static dyd_status prove_line(dyd_delaunay *pd, dyd_work *w) {
  const dyd_line *l = &pd->sk.line;
  dyd_status st = DYD_OK;
  pd->line_tie = pd->sk.all_points;
  if (pd->line_tie || !pd->options.prove || l->count < 3) return st;
  for (uint32_t q = 0; q + 1 < l->count; q++)
    if (!l->legal[q]) return st;
  DYD_FREED uint32_t *site = dyd_alloc(l->count, sizeof *site);
  if (!site) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < l->count; q++) site[q] = pd->sk.reps.site[l->order[q]];
  return pd->options.prove(&pd->line_tie, pd->options.prove_user, DYD_COLLINEAR, site, l->count, w->run->err);
}

dyd_status dyd_line_find(dyd_delaunay *pd, dyd_work *w) {
  const dyd_line *l = &pd->sk.line;
  dyd_status st = prove_line(pd, w);
  if (st != DYD_OK) return st;
  size_t open = dyd_line_open_pairs(l);
  pd->open.count = open > 0;
  pd->open.capped = !pd->line_tie && open > pd->max_pairs;
  if (pd->open.capped)
    dyd_fail(w->run->err, DYD_CAPPED,
             "%zu collinear sites (%u, %u, ...) have %zu possible pairs, more than the cap of %zu; raise the cap on "
             "pairs",
             (size_t)l->count, pd->sk.reps.site[l->order[0]], pd->sk.reps.site[l->order[1]], open, pd->max_pairs);
  return DYD_OK;
}

/* ---- the table ---- */

void dyd_table_clear(dyd_undecided *f) {
  dyd_free_all(f->face, f->seed, f->tri, f->pair, f->turned, f->of);
  *f = (dyd_undecided){.kind = f->kind};
}

dyd_status dyd_table_mark(dyd_undecided *f, uint32_t n) {
  size_t count = 2 * (size_t)n + 2; /* vertices may still come into the mesh */
  if (f->of) return DYD_OK;
  if (!DYD_NEW(f->of, count)) return DYD_E_NOMEM;
  memset(f->of, 0xff, count * sizeof *f->of);
  return DYD_OK;
}

/* Invariant: list[0..count-1] are triangles of the face in work. */
typedef struct tie_flood {
  uint32_t *list;
  size_t count, cap;
  bool ghost; /* a chain */
} tie_flood;

static bool tie_mark(tie_flood *f, dyd_delaunay *pd, uint32_t t, uint32_t face) {
  if (!DYD_GROW(f->list, f->cap, f->count + 1)) return false;
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
  if (!DYD_GROW(table->seed, table->seed_cap, table->count + 1)) return DYD_E_NOMEM;
  table->seed[face] = t;
  w->counters.faces++;
  if (is_quad(pd, t, face)) return tie_settle(pd, 2, false), DYD_OK;
  dyd_status st = tie_flood_from(f, pd, t, face);
  if (st == DYD_OK) tie_settle(pd, f->count, f->ghost);
  return st;
}

dyd_status dyd_ties_drop(dyd_delaunay *pd, uint32_t t) {
  dyd_undecided *table = &pd->open;
  const uint32_t face = dyd_face_of(pd, t);
  tie_flood f = {0};
  if (face == DYD_NONE) return DYD_OK;
  dyd_status st = tie_flood_from(&f, pd, t, DYD_NONE);
  if (st == DYD_OK) {
    table->tied_pairs -= dyd_group_pairs(f.ghost ? f.count + 1 : f.count + 2, f.ghost);
    table->seed[face] = table->seed[--table->count];
    if (face < table->count) st = tie_flood_from(&f, pd, table->seed[face] & ~DYD_SEED_QUAD, face);
  }
  free(f.list);
  return st;
}

dyd_status dyd_ties_add(dyd_delaunay *pd, dyd_work *w, uint32_t t) {
  tie_flood f = {0};
  if (dyd_triangle_is_certain(&pd->sk, t)) return DYD_OK;
  dyd_status st = dyd_table_mark(&pd->open, pd->sk.n);
  if (st == DYD_OK && pd->open.of[t] == DYD_NONE) st = tie_find_face(&f, pd, w, t);
  free(f.list);
  return st;
}

dyd_status dyd_ties_find(dyd_delaunay *pd, dyd_work *w) {
  tie_flood f = {0};
  dyd_status st = DYD_OK;
  if (pd->sk.mesh.tally.ties == 0) return DYD_OK; /* [TIE-1] */
  for (uint32_t t = 0; t < pd->sk.mesh.count && st == DYD_OK; t++) {
    if (dyd_triangle_is_certain(&pd->sk, t)) continue;
    st = dyd_table_mark(&pd->open, pd->sk.n);
    if (st == DYD_OK && pd->open.of[t] == DYD_NONE) st = tie_find_face(&f, pd, w, t);
  }
  free(f.list);
  if (st != DYD_OK) dyd_table_clear(&pd->open);
  return st;
}
