/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Queries about undecided parts: each has one switch over the way they are stored. */
#include "delaunay/undecided.h"

#include "base/alloc.h"
#include "delaunay/faces.h"

dyd_pair_status dyd_open_status_of(const dyd_delaunay *pd, size_t f) {
  switch (pd->open.kind) {
  case DYD_LINE:
    return pd->line_tie ? DYD_TIE : DYD_INDETERMINATE;
  case DYD_TIED:
    return DYD_TIE;
  default:
    return dyd_listed_status(&pd->open.face[f]);
  }
}

/* ---- faces ---- */

/* Sorts, drops repeats. */
static size_t distinct(uint32_t *v, size_t count) {
  size_t kept = 0;
  if (count) qsort(v, count, sizeof *v, dyd_compare_index);
  for (size_t q = 0; q < count; q++)
    if (kept == 0 || v[kept - 1] != v[q]) v[kept++] = v[q];
  return kept;
}

static dyd_status listed_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f) {
  const dyd_face *face = &pd->open.face[f];
  const dyd_mesh *m = &pd->sk.mesh;
  uint32_t *v = dyd_alloc(3 * (size_t)face->tris, sizeof *v);
  size_t all = 0;
  if (!v) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < face->tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t w = m->tri[pd->open.tri[face->first_tri + q]].v[k];
      if (w != m->n) v[all++] = w;
    }
  *vertex = v;
  *count = distinct(v, all);
  return DYD_OK;
}

static dyd_status line_vertices(uint32_t **vertex, size_t *count, const dyd_line *l) {
  uint32_t *v = dyd_alloc(l->count, sizeof *v);
  if (!v) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < l->count; q++) v[q] = l->order[q];
  *vertex = v;
  *count = distinct(v, l->count);
  return DYD_OK;
}

dyd_status dyd_open_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f) {
  switch (pd->open.kind) {
  case DYD_LINE:
    return line_vertices(vertex, count, &pd->sk.line);
  case DYD_TIED:
    return dyd_tie_vertices(vertex, count, pd, f);
  default:
    return listed_vertices(vertex, count, pd, f);
  }
}

bool dyd_open_is_outer(const dyd_delaunay *pd, size_t f) {
  switch (pd->open.kind) {
  case DYD_LINE:
    return true;
  case DYD_TIED:
    return dyd_is_ghost_triangle(&pd->sk.mesh, dyd_tie_seed(pd, f));
  default:
    return pd->open.face[f].outer;
  }
}

bool dyd_open_is_capped(const dyd_delaunay *pd, size_t f) {
  if (pd->open.kind == DYD_LINE) return pd->open.capped;
  return pd->open.kind == DYD_LISTED && pd->open.face[f].capped;
}

bool dyd_open_is_postponed(const dyd_delaunay *pd, size_t f) {
  return pd->open.kind == DYD_LISTED && pd->open.face[f].postponed;
}

/* ---- one pair ---- */

/* The status of vw by face f alone, of which v is a vertex. */
static dyd_pair_status status_in_face(const dyd_delaunay *pd, uint32_t f, uint32_t v, uint32_t w) {
  if (pd->open.kind == DYD_TIED) return dyd_is_corner_of(pd, w, f) ? dyd_open_status_of(pd, f) : DYD_ILLEGAL;
  const dyd_vertex_pair *p = dyd_listed_pair(pd, f, v, w);
  return p && !p->hidden ? dyd_open_status_of(pd, f) : DYD_ILLEGAL;
}

/* In a capped face any pair may be possible. */
static bool may_be_missing(const dyd_delaunay *pd, uint32_t f, uint32_t w) {
  return pd->open.kind == DYD_LISTED && pd->open.face[f].capped && dyd_is_corner_of(pd, w, f);
}

dyd_pair_status dyd_open_status(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  if (pd->open.kind == DYD_LINE) return dyd_open_status_of(pd, 0);
  dyd_half_edge first = pd->sk.leaving[v];
  uint32_t before = DYD_NONE;
  bool missing = false;
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(&pd->sk.mesh, h, first)) {
    uint32_t f = dyd_face_of(pd, dyd_edge_triangle(h));
    if (f != DYD_NONE && f != before) {
      dyd_pair_status status = status_in_face(pd, f, v, w);
      if (status != DYD_ILLEGAL) return status;
      missing = missing || may_be_missing(pd, f, w);
    }
    before = f;
  }
  return missing ? DYD_INDETERMINATE : DYD_ILLEGAL;
}

/* ---- all of them ---- */

static void count_listed(size_t count[4], const dyd_delaunay *pd) {
  for (size_t f = 0; f < pd->open.count; f++) {
    const dyd_face *face = &pd->open.face[f];
    count[dyd_listed_status(face)] += face->pairs - face->hidden;
  }
}

void dyd_open_count(size_t count[4], const dyd_delaunay *pd) {
  switch (pd->open.kind) {
  case DYD_LINE:
    if (!pd->open.capped) count[dyd_open_status_of(pd, 0)] += dyd_line_open_pairs(&pd->sk.line);
    return;
  case DYD_TIED:
    count[DYD_TIE] += pd->open.tied_pairs;
    return;
  default:
    count_listed(count, pd);
  }
}

uint64_t dyd_legal_count(const dyd_delaunay *pd) {
  return pd->open.kind == DYD_LINE ? dyd_line_legal_pairs(&pd->sk.line) : dyd_certain_edges(&pd->sk);
}

bool dyd_pair_is_legal(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  return pd->open.kind == DYD_LINE ? dyd_line_is_legal(&pd->sk.line, v, w) : dyd_is_legal(&pd->sk, v, w);
}

bool dyd_corner_is_sure(const dyd_delaunay *pd, uint32_t v) {
  return pd->open.kind == DYD_LINE ? dyd_line_is_end(&pd->sk.line, v) : dyd_is_legal(&pd->sk, v, pd->sk.mesh.n);
}

bool dyd_is_hull_edge(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  if (pd->open.kind == DYD_LINE) return pd->sk.line.count == 2;
  for (int k = 0; k < 2; k++) {
    dyd_half_edge h = k ? dyd_find_edge(&pd->sk, w, v) : dyd_find_edge(&pd->sk, v, w);
    if (h != DYD_NONE && dyd_is_ghost_triangle(&pd->sk.mesh, dyd_edge_triangle(h))) return true;
  }
  return false;
}

/* ---- those of one face ---- */

/* Passes on the pairs that are not legal. */
typedef struct only_open {
  dyd_pair_visit visit;
  void *context;
} only_open;

static void visit_open(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  const only_open *o = context;
  if (status != DYD_LEGAL) o->visit(o->context, v, w, status);
}

void dyd_open_each_in(const dyd_delaunay *pd, size_t f, dyd_pair_visit visit, void *context) {
  only_open o = {visit, context};
  if (pd->open.kind == DYD_LINE)
    dyd_each_on_line(pd, dyd_open_status_of(pd, 0), visit_open, &o);
  else if (pd->open.kind == DYD_LISTED)
    dyd_each_listed(pd, f, visit, context);
  else
    dyd_each_tied(pd, f, visit, context);
}

/* ---- those of one vertex ---- */

static void each_on_line_at(const dyd_delaunay *pd, uint32_t v, dyd_pair_visit visit, void *context) {
  const dyd_line *l = &pd->sk.line;
  for (uint32_t q = 0; q < l->count; q++)
    if (l->order[q] != v && !dyd_line_is_legal(l, v, l->order[q]))
      visit(context, v, l->order[q], dyd_open_status_of(pd, 0));
}

/* Of the tied face on the left of the rim's half-edge h: the pairs of the origin with sites that are not next to it on
 * the rim. */
static void each_tied_at(const dyd_delaunay *pd, dyd_half_edge h, dyd_pair_visit visit, void *context) {
  const dyd_skeleton *sk = &pd->sk;
  uint32_t v = dyd_edge_origin(&sk->mesh, h);
  for (dyd_half_edge at = dyd_tie_next(sk, dyd_tie_next(sk, h)), next; at != h; at = next) {
    uint32_t w = dyd_edge_origin(&sk->mesh, at);
    next = dyd_tie_next(sk, at);
    if (w != sk->mesh.n && next != h) visit(context, v, w, DYD_TIE);
  }
}

/* Of the pairs of a face, in the order of turned or their own (NULL): how many begin with less than v. */
static uint32_t listed_below(const dyd_vertex_pair *pair, const uint32_t *turned, uint32_t pairs, uint32_t v) {
  uint32_t low = 0, high = pairs;
  while (low < high) {
    uint32_t mid = low + (high - low) / 2;
    if ((turned ? pair[turned[mid]].j : pair[mid].i) < v)
      low = mid + 1;
    else
      high = mid;
  }
  return low;
}

static void visit_listed(const dyd_face *face, dyd_vertex_pair p, uint32_t v, dyd_pair_visit visit, void *context) {
  if (!p.hidden) visit(context, v, p.i == v ? p.j : p.i, dyd_listed_status(face));
}

static void each_listed_at(const dyd_delaunay *pd, uint32_t f, uint32_t v, dyd_pair_visit visit, void *context) {
  const dyd_face *face = &pd->open.face[f];
  const dyd_vertex_pair *pair = pd->open.pair + face->first_pair;
  uint32_t pairs = face->pairs, q = 0;
  if (pairs <= DYD_FEW_PAIRS) {
    for (; q < pairs; q++)
      if (pair[q].i == v || pair[q].j == v) visit_listed(face, pair[q], v, visit, context);
    return;
  }
  const uint32_t *turned = pd->open.turned + face->first_pair;
  for (q = listed_below(pair, turned, pairs, v); q < pairs && pair[turned[q]].j == v; q++)
    visit_listed(face, pair[turned[q]], v, visit, context);
  for (q = listed_below(pair, NULL, pairs, v); q < pairs && pair[q].i == v; q++)
    visit_listed(face, pair[q], v, visit, context);
}

void dyd_open_each_at(const dyd_delaunay *pd, uint32_t v, dyd_pair_status least, dyd_pair_visit visit, void *context) {
  if (!pd->open.count || (pd->open.kind != DYD_LISTED && dyd_open_status_of(pd, 0) < least)) return;
  if (pd->open.kind == DYD_LINE) {
    each_on_line_at(pd, v, visit, context);
    return;
  }
  dyd_half_edge first = pd->sk.leaving[v];
  uint32_t before = DYD_NONE;
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(&pd->sk.mesh, h, first)) {
    uint32_t f = dyd_face_of(pd, dyd_edge_triangle(h));
    if (f != DYD_NONE && pd->open.kind == DYD_LISTED) {
      if (f != before) each_listed_at(pd, f, v, visit, context);
    } else if (f != DYD_NONE && dyd_edge_is_certain(&pd->sk, h)) {
      each_tied_at(pd, h, visit, context);
    }
    before = f;
  }
}

void dyd_legal_each_at(const dyd_delaunay *pd, uint32_t v, dyd_pair_visit visit, void *context) {
  const dyd_line *l = &pd->sk.line;
  if (pd->open.kind == DYD_LINE) {
    uint32_t q = l->rank[v];
    if (q > 0 && l->legal[q - 1]) visit(context, v, l->order[q - 1], DYD_LEGAL);
    if (q + 1 < l->count && l->legal[q]) visit(context, v, l->order[q + 1], DYD_LEGAL);
    return;
  }
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_half_edge first = pd->sk.leaving[v];
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(m, h, first))
    if (dyd_edge_is_certain(&pd->sk, h) && dyd_edge_target(m, h) != m->n)
      visit(context, v, dyd_edge_target(m, h), DYD_LEGAL);
}
