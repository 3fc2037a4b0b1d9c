/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Keeping what cannot have changed. */
#include "delaunay/narrowed.h"

#include "base/alloc.h"
#include "delaunay/face_table.h"
#include "possible/clique_filter.h"
#include "possible/cover.h"
#include "skeleton/rects_filter.h"

/* CROWD: least triangles of a face that is worth it. Pairs are found anew where more than one of SHARE may end. In the
 * armed build small faces take part, too. */
#ifdef DYD_ARMED
enum { CROWD = 4, SHARE = 1 };
#else
enum { CROWD = 64, SHARE = 4 };
#endif

/* CHANGED: narrowed. NEAR: was a possible neighbour of one who was. FREE: besides, does not meet that one any more, who
 * may block it. MEMBER: of the face in work; of these, DOUBT: in a pair that may have become impossible; SHOWN: surely
 * possibly nearest at the centre looked at. */
enum { CHANGED = 1, NEAR = 2, FREE = 4, MEMBER = 8, DOUBT = 16, SHOWN = 32 };

void dyd_narrowed_clear(dyd_narrowed *n) {
  free(n->mark);
  n->mark = NULL;
}

/* ---- who can be concerned ---- */

static bool is_corner_of(const dyd_delaunay *pd, uint32_t v, uint32_t f) {
  dyd_half_edge first = pd->sk.leaving[v], h = first;
  do {
    if (pd->open.of[dyd_edge_triangle(h)] == f) return true;
    h = dyd_edge_turn(&pd->sk.mesh, h);
  } while (h != first);
  return false;
}

/* false: they are too many. */
static bool note_changed(dyd_narrowed *n, const dyd_delaunay *pd, uint32_t f, const uint32_t *changed, size_t count) {
  for (size_t q = 0; q < count; q++) {
    uint32_t v = pd->sk.vertex[changed[q]];
    if (n->mark[v] || !is_corner_of(pd, v, f)) continue;
    if (n->count == DYD_FEW) return false;
    n->mark[v] = CHANGED;
    n->vertex[n->count++] = v;
  }
  return true;
}

static void note_near(dyd_narrowed *n, const dyd_delaunay *pd, uint32_t changed, uint32_t v) {
  n->mark[v] |= dyd_surely_meet(&pd->sk.rects, changed, v) ? NEAR : NEAR | FREE;
}

/* The possible neighbours of those narrowed: by pairs of the face, and by legal ones. */
static void note_neighbours(dyd_narrowed *n, const dyd_delaunay *pd) {
  const dyd_vertex_pair *p = pd->open.pair + n->old.first_pair, *end = p + n->old.pairs;
  const dyd_mesh *m = &pd->sk.mesh;
  for (; p < end; p++) {
    if (n->mark[p->i] & CHANGED) note_near(n, pd, p->i, p->j);
    if (n->mark[p->j] & CHANGED) note_near(n, pd, p->j, p->i);
  }
  for (uint32_t q = 0; q < n->count; q++) {
    dyd_half_edge first = pd->sk.leaving[n->vertex[q]], h = first;
    do {
      uint32_t v = dyd_edge_target(m, h);
      if (dyd_edge_is_certain(&pd->sk, h) && v != m->n) note_near(n, pd, n->vertex[q], v);
      h = dyd_edge_turn(m, h);
    } while (h != first);
  }
}

dyd_status dyd_narrowed_init(dyd_narrowed *n, const dyd_delaunay *pd, uint32_t f, const uint32_t *changed,
                             size_t count) {
  *n = (dyd_narrowed){.old = pd->open.face[f]};
  bool large = n->old.tris >= CROWD && !n->old.capped && !n->old.tie;
  if (!large || count > n->old.tris) return DYD_OK;
  n->mark = calloc((size_t)pd->sk.mesh.n + 1, sizeof *n->mark);
  if (!n->mark) return DYD_E_NOMEM;
  if (note_changed(n, pd, f, changed, count))
    note_neighbours(n, pd);
  else
    dyd_narrowed_clear(n);
  return DYD_OK;
}

bool dyd_narrowed_reaches(const dyd_narrowed *n, const dyd_mesh *m, dyd_half_edge h) {
  return !n->mark || ((n->mark[dyd_edge_origin(m, h)] | n->mark[dyd_edge_target(m, h)]) & (CHANGED | NEAR));
}

/* ---- pairs ---- */

/* Those that may have become impossible: places in the old list, and whose they are. gone: by place in the old list. */
typedef struct doubt {
  uint32_t *pair, *vertex;
  size_t pairs, all, vertices, pair_cap, vertex_cap;
  bool *gone, *near;
} doubt;

static void doubt_clear(doubt *d) {
  free(d->pair);
  free(d->vertex);
  free(d->gone);
  free(d->near);
}

/* Rectangles that meet are a possible pair [POS-1]. */
static bool may_end(const dyd_narrowed *n, const dyd_delaunay *pd, dyd_vertex_pair p) {
  uint8_t a = n->mark[p.i], b = n->mark[p.j];
  return (((a | b) & CHANGED) || (a & b & FREE)) && !dyd_surely_meet(&pd->sk.rects, p.i, p.j);
}

static bool doubt_vertex(doubt *d, const dyd_narrowed *n, uint32_t v) {
  if (n->mark[v] & DOUBT) return true;
  if (!dyd_reserve((void **)&d->vertex, &d->vertex_cap, d->vertices + 1, sizeof *d->vertex)) return false;
  n->mark[v] |= DOUBT;
  d->vertex[d->vertices++] = v;
  return true;
}

/* Pairs of members that have become legal are gone, others are in doubt. */
static dyd_status find_doubts(doubt *d, const dyd_narrowed *n, const dyd_delaunay *pd) {
  const dyd_vertex_pair *p = pd->open.pair + n->old.first_pair;
  d->gone = calloc(n->old.pairs ? n->old.pairs : 1, sizeof *d->gone);
  if (!d->gone) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < n->old.pairs; q++, p++) {
    uint8_t a = n->mark[p->i], b = n->mark[p->j];
    if (!(a & b & MEMBER)) continue;
    d->all++;
    d->gone[q] = n->certain && ((a | b) & (CHANGED | NEAR)) && dyd_is_legal(&pd->sk, p->i, p->j);
    if (d->gone[q] || !may_end(n, pd, *p)) continue;
    if (!dyd_reserve((void **)&d->pair, &d->pair_cap, d->pairs + 1, sizeof *d->pair) || !doubt_vertex(d, n, p->i) ||
        !doubt_vertex(d, n, p->j))
      return DYD_E_NOMEM;
    d->pair[d->pairs++] = q;
  }
  d->near = dyd_alloc(d->vertices, sizeof *d->near);
  return d->near ? DYD_OK : DYD_E_NOMEM;
}

/* The centre shows some of those left to be possible: they are in doubt no longer. */
static void clear_doubts(doubt *d, const dyd_narrowed *n, const dyd_delaunay *pd, dyd_xy centre) {
  const dyd_vertex_pair *old = pd->open.pair + n->old.first_pair;
  size_t kept = 0;
  dyd_filter_clique(d->near, &pd->sk.rects, centre, d->vertex, d->vertices);
  for (size_t k = 0; k < d->vertices; k++)
    if (d->near[k]) n->mark[d->vertex[k]] |= SHOWN;
  for (size_t k = 0; k < d->pairs; k++) {
    dyd_vertex_pair p = old[d->pair[k]];
    if (!(n->mark[p.i] & n->mark[p.j] & SHOWN)) d->pair[kept++] = d->pair[k];
  }
  for (size_t k = 0; k < d->vertices; k++) n->mark[d->vertex[k]] &= (uint8_t)~SHOWN;
  d->pairs = kept;
}

static dyd_status settle_doubts(doubt *d, const dyd_narrowed *n, dyd_work *w, const dyd_delaunay *pd) {
  dyd_status st = DYD_OK;
  while (d->pairs && st == DYD_OK) {
    uint32_t q = d->pair[--d->pairs];
    dyd_vertex_pair p = pd->open.pair[n->old.first_pair + q];
    bool of_others = !((n->mark[p.i] | n->mark[p.j]) & CHANGED), possible = true;
    const uint32_t hint[2] = {of_others ? n->vertex[0] : DYD_NONE, DYD_NONE};
    if (dyd_work_cancelled(w)) return DYD_CANCELLED;
    st = dyd_cover_possible(&possible, w, &pd->sk, p.i, p.j, hint);
    d->gone[q] = !possible;
    if (possible && !w->walked) clear_doubts(d, n, pd, w->centre);
  }
  return st;
}

/* Marks the vertices of face g as members, or no longer. Says whether it is outer, and of exact points only. */
static void mark_members(dyd_face *as, const dyd_narrowed *n, const dyd_delaunay *pd, size_t g, bool member) {
  const dyd_face *face = &pd->open.face[g];
  const dyd_mesh *m = &pd->sk.mesh;
  as->tie = true;
  for (uint32_t q = 0; q < face->tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t v = m->tri[pd->open.tri[face->first_tri + q]].v[k];
      n->mark[v] = (uint8_t)(member ? n->mark[v] | MEMBER : n->mark[v] & ~MEMBER);
      if (v == m->n)
        as->outer = true;
      else
        as->tie = as->tie && dyd_vertex_is_point(&pd->sk, v);
    }
}

/* The pairs of members that are not gone, in their order, become those of face g. */
static dyd_status store_rest(dyd_face as, const doubt *d, const dyd_narrowed *n, dyd_delaunay *pd, size_t g) {
  const dyd_vertex_pair *old = pd->open.pair + n->old.first_pair;
  dyd_vertex_pair *pair = dyd_alloc(d->all, sizeof *pair);
  if (!pair) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < n->old.pairs; q++)
    if (!d->gone[q] && (n->mark[old[q].i] & n->mark[old[q].j] & MEMBER))
      pair[as.pairs++] = (dyd_vertex_pair){old[q].i, old[q].j, 0};
  dyd_status st = dyd_table_store(pd, g, as, pair);
  free(pair);
  return st;
}

dyd_status dyd_narrowed_close(bool *closed, dyd_delaunay *pd, dyd_work *w, const dyd_narrowed *n, size_t g) {
  dyd_face as = {0};
  doubt d = {0};
  size_t stored = pd->open.live_pairs;
  dyd_status st = DYD_OK;
  *closed = false;
  if (!n->mark || pd->open.face[g].tris < CROWD || stored > pd->max_pairs || n->old.pairs > pd->max_pairs - stored)
    return DYD_OK;
  mark_members(&as, n, pd, g, true);
  if (!as.tie) st = find_doubts(&d, n, pd);
  *closed = !as.tie && st == DYD_OK && d.pairs <= d.all / SHARE;
  if (*closed) st = settle_doubts(&d, n, w, pd);
  if (*closed && st == DYD_OK) st = store_rest(as, &d, n, pd, g);
  for (size_t k = 0; k < d.vertices; k++) n->mark[d.vertex[k]] &= (uint8_t)~DOUBT;
  mark_members(&as, n, pd, g, false);
  if (*closed) w->counters.faces++;
  doubt_clear(&d);
  return st;
}
