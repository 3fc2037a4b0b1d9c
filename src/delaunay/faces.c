/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Flooding the skeleton over uncertain edges, and closing the faces found. */
#include "delaunay/faces.h"

#include "base/alloc.h"
#include "delaunay/closure.h"
#include "delaunay/face_table.h"
#include "delaunay/ties.h"
#include "possible/cover.h"
#include "possible/patches_filter.h"
#include "skeleton/rects_filter.h"

#include <string.h>

/* ---- keeping what cannot have changed ---- */

/* CROWD: least triangles of a face that is worth it. Pairs are found anew where more than one of SHARE may end. In the
 * armed build small faces take part, too. */
#ifdef DYD_ARMED

enum { CROWD = 4, SHARE = 1 };

#else

enum { CROWD = 64, SHARE = 4 };

#endif

/* CHANGED: narrowed. NEAR: was a possible neighbour of a changed one. FREE: also, does not meet that one any more,
 * which may block it. MEMBER: of the face in work; of these, DOUBT: in a pair that may have become impossible; SHOWN:
 * proved possibly nearest at the centre examined. */
enum { CHANGED = 1, NEAR = 2, FREE = 4, MEMBER = 8, DOUBT = 16, SHOWN = 32 };

void dyd_narrowed_clear(dyd_narrowed *n) {
  free(n->mark);
  n->mark = NULL;
}

/* ---- vertices that may be concerned ---- */

/* false: they are too many. */
static bool note_changed(dyd_narrowed *n, const dyd_delaunay *pd, uint32_t f, const uint32_t *changed, size_t count) {
  for (size_t q = 0; q < count; q++) {
    uint32_t v = pd->sk.vertex[changed[q]];
    if (n->mark[v] || !dyd_is_corner_of(pd, v, f)) continue;
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
    dyd_half_edge first = pd->sk.leaving[n->vertex[q]];
    for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(m, h, first)) {
      uint32_t v = dyd_edge_target(m, h);
      if (dyd_edge_is_certain(&pd->sk, h) && v != m->n) note_near(n, pd, n->vertex[q], v);
    }
  }
}

dyd_status dyd_narrowed_init(dyd_narrowed *n, const dyd_delaunay *pd, uint32_t f, const uint32_t *changed,
                             size_t count) {
  *n = (dyd_narrowed){.old = pd->open.face[f]};
  bool large = n->old.tris >= CROWD && !n->old.capped && !n->old.tie;
  if (!large || count > n->old.tris) return DYD_OK;
  if (!DYD_ZEROED(n->mark, (size_t)pd->sk.mesh.n + 1)) return DYD_E_NOMEM;
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

/* Pairs that may have become impossible: places in the old list, and their vertices. gone: by place in the old list. */
typedef struct doubt {
  uint32_t *pair, *vertex;
  size_t pairs, all, vertices, pair_cap, vertex_cap;
  bool *gone, *near;
} doubt;

static void doubt_clear(doubt *d) {
  dyd_free_all(d->pair, d->vertex, d->gone, d->near);
}

/* Rectangles that meet are a possible pair [POS-1]. */
static bool may_end(const dyd_narrowed *n, const dyd_delaunay *pd, dyd_vertex_pair p) {
  uint8_t a = n->mark[p.i], b = n->mark[p.j];
  return (((a | b) & CHANGED) || (a & b & FREE)) && !dyd_surely_meet(&pd->sk.rects, p.i, p.j);
}

static bool doubt_vertex(doubt *d, const dyd_narrowed *n, uint32_t v) {
  if (n->mark[v] & DOUBT) return true;
  if (!DYD_GROW(d->vertex, d->vertex_cap, d->vertices + 1)) return false;
  n->mark[v] |= DOUBT;
  d->vertex[d->vertices++] = v;
  return true;
}

/* Pairs of members that have become legal are gone, others are in doubt. */
static dyd_status find_doubts(doubt *d, const dyd_narrowed *n, const dyd_delaunay *pd) {
  const dyd_vertex_pair *p = pd->open.pair + n->old.first_pair;
  if (!DYD_ZEROED(d->gone, n->old.pairs ? n->old.pairs : 1)) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < n->old.pairs; q++, p++) {
    uint8_t a = n->mark[p->i], b = n->mark[p->j];
    if (!(a & b & MEMBER)) continue;
    d->all++;
    d->gone[q] = n->certain && ((a | b) & (CHANGED | NEAR)) && dyd_is_legal(&pd->sk, p->i, p->j);
    if (d->gone[q] || !may_end(n, pd, *p)) continue;
    if (!DYD_GROW(d->pair, d->pair_cap, d->pairs + 1) || !doubt_vertex(d, n, p->i) || !doubt_vertex(d, n, p->j))
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
    bool of_others = !((n->mark[p.i] | n->mark[p.j]) & CHANGED);
    dyd_cover found;
    const uint32_t hint[2] = {of_others ? n->vertex[0] : DYD_NONE, DYD_NONE};
    if (dyd_work_cancelled(w)) return DYD_CANCELLED;
    st = dyd_cover_possible(&found, w, &pd->sk, p.i, p.j, hint);
    d->gone[q] = !found.possible;
    if (found.possible && !found.walked) clear_doubts(d, n, pd, (dyd_xy){found.place.e[0], found.place.e[2]});
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

/* Gives face g, which was a part of the old one or all of it, those of the old pairs that are open still. *closed:
 * done; false where it is as well to find its pairs anew, and nothing is changed. The old face is not in the table. */
static dyd_status narrowed_close(bool *closed, dyd_delaunay *pd, dyd_work *w, const dyd_narrowed *n, size_t g) {
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

/* ---- closing ---- */

typedef struct batch {
  dyd_closure *out;
  const dyd_delaunay *pd;
  size_t first, room;
} batch;

/* Least number of triangles of a face that can be postponed; in the armed build small faces are, too. */
#ifdef DYD_ARMED

enum { MANY_TRIANGLES = 16 };

#else

enum { MANY_TRIANGLES = 64 };

#endif

/* Returns true if all corners of many triangles are points or can be narrowed. Not all are points: no cover walk is
 * needed for those. */
static bool face_is_postponed(const dyd_delaunay *pd, const dyd_face *face) {
  const dyd_delaunay_options *o = &pd->options;
  bool any = false;
  if (!o->narrows || face->tris < MANY_TRIANGLES) return false;
  for (uint32_t q = 0; q < face->tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t v = pd->sk.mesh.tri[pd->open.tri[face->first_tri + q]].v[k];
      if (v == pd->sk.mesh.n || dyd_vertex_is_point(&pd->sk, v)) continue;
      if (!o->narrows(o->narrows_user, pd->sk.reps.site[v])) return false;
      any = true;
    }
  return any;
}

static dyd_status closures_run_one(dyd_closure *out, const dyd_delaunay *pd, dyd_work *w, const dyd_face *face,
                                   size_t room) {
  return dyd_closure_run(out, w, &pd->sk, pd->open.tri + face->first_tri, face->tris, room,
                         face_is_postponed(pd, face));
}

/* Closures of one range; those after a failure stay empty. */
static dyd_status close_range(void *context, dyd_work *w, size_t number, size_t begin, size_t end) {
  const batch *b = context;
  dyd_status st = DYD_OK;
  (void)number;
  for (size_t k = begin; k < end && st == DYD_OK; k++) {
    const dyd_face *f = &b->pd->open.face[b->first + k];
    if (f->proved) continue;
    st = DYD_CANCELLED;
    if (w->run->keep_cut || !dyd_work_cancelled(w)) st = closures_run_one(&b->out[k], b->pd, w, f, b->room);
    w->counters.faces++;
  }
  return st;
}

static dyd_status closures_run(dyd_closure *out, const dyd_delaunay *pd, dyd_work *w, size_t first, size_t count,
                               size_t room) {
  batch b = {out, pd, first, room};
  memset(out, 0, count * sizeof *out);
  dyd_status st = dyd_work_ranges(w, &pd->sk, count, close_range, &b);
  for (size_t k = 0; k < count && st != DYD_OK; k++) dyd_closure_clear(&out[k]);
  return st;
}

static dyd_status store(dyd_delaunay *pd, dyd_work *w, const dyd_closure *c, size_t g) {
  dyd_face as = {.pairs = (uint32_t)c->pairs,
                 .outer = c->outer,
                 .tie = c->all_points,
                 .capped = c->capped,
                 .postponed = c->postponed,
                 .polygon = c->polygon};
  uint64_t pairs = dyd_bytes_times(pd->open.pair_count + as.pairs, sizeof *c->pair);
  if (!dyd_room_has(&w->room, pairs / 2 * 3, "the possible pairs")) return DYD_E_NOMEM;
  dyd_status st = dyd_table_store(pd, g, as, c->pair);
  if (st == DYD_OK && c->capped) dyd_report_cap(w, pd, c->vertex, c->vertices);
  return st;
}

/* Room for pairs now: what the faces stored so far leave. */
static size_t room_left(const dyd_delaunay *pd) {
  return pd->max_pairs > pd->open.live_pairs ? pd->max_pairs - pd->open.live_pairs : 0;
}

/* Closes the faces g .. g + count - 1 together. One that found more pairs than the others have left room for is closed
 * again, with that room. */
static dyd_status close_batch(dyd_closure *c, dyd_delaunay *pd, dyd_work *w, size_t g, size_t count) {
  size_t room = room_left(pd);
  w->room.held = dyd_delaunay_memory(pd);
  dyd_status st = closures_run(c, pd, w, g, count, room);
  if (st != DYD_OK) return st;
  for (size_t k = 0; k < count; k++) {
    dyd_face *face = &pd->open.face[g + k];
    if (st == DYD_OK && !face->proved && (c[k].capped || c[k].pairs > room_left(pd)) && room_left(pd) < room) {
      dyd_closure_clear(&c[k]);
      st = closures_run_one(&c[k], pd, w, face, room_left(pd));
    }
    if (st == DYD_OK && !face->proved) st = store(pd, w, &c[k], g + k);
    dyd_closure_clear(&c[k]);
  }
  return st;
}

enum { BATCH = 4096 };

static dyd_status close_faces(dyd_delaunay *pd, dyd_work *w, size_t from) {
  size_t end = pd->open.count, most = end - from < BATCH ? end - from : BATCH;
  dyd_closure *c = dyd_alloc(most, sizeof *c);
  dyd_status st = c ? DYD_OK : DYD_E_NOMEM;
  for (size_t g = from; g < end && st == DYD_OK; g += most)
    st = close_batch(c, pd, w, g, end - g < most ? end - g : most);
  free(c);
  return st;
}

/* Faces after those there are, and which of them are proved ties. */
static dyd_status find_and_prove(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count) {
  size_t first = pd->open.count;
  dyd_status st = dyd_table_find(pd, w, tri, count);
  for (size_t g = first; g < pd->open.count && st == DYD_OK; g++) st = dyd_prove_face(pd, w, g);
  return st == DYD_CANCELLED && w->run->keep_cut ? DYD_OK : st;
}

static void share_out_from(dyd_delaunay *pd, size_t first) {
  for (size_t g = first; g < pd->open.count; g++) dyd_table_share_out(pd, (uint32_t)g);
}

dyd_status dyd_faces_find(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count) {
  const dyd_undecided before = pd->open;
  dyd_status st = find_and_prove(pd, w, tri, tri ? count : pd->sk.mesh.count);
  if (st == DYD_OK) st = close_faces(pd, w, before.count);
  if (st == DYD_OK)
    share_out_from(pd, before.count);
  else
    dyd_table_roll_back(pd, &before);
  return st;
}

/* ---- replacing one face ---- */

/* Closes the faces from `from` on, the remaining parts of an old one. */
static dyd_status close_parts(dyd_delaunay *pd, dyd_work *w, size_t from, const dyd_narrowed *narrowed) {
  dyd_closure c;
  dyd_status st = DYD_OK;
  for (size_t g = from; g < pd->open.count && st == DYD_OK; g++) {
    bool closed = pd->open.face[g].proved;
    if (!closed) st = narrowed_close(&closed, pd, w, narrowed, g);
    if (!closed && st == DYD_OK) st = close_batch(&c, pd, w, g, 1);
  }
  return st;
}

/* Pairs of the face replaced, which is not in the table, that a face before `fresh` lists, but none of the new ones: by
 * what changed here they may have become legal or impossible. Pairs that have are put into *ended. */
static dyd_status find_ended(dyd_vertex_pair **ended, size_t *count, dyd_delaunay *pd, dyd_work *w, const dyd_face *old,
                             size_t fresh) {
  static const uint32_t no_hint[2] = {DYD_NONE, DYD_NONE};
  const dyd_undecided *f = &pd->open;
  size_t cap = 0;
  dyd_status st = DYD_OK;
  if (f->count == 0 || (old->polygon && f->others == 0)) return st;
  dyd_table_star star = {.from = 0, .to = fresh, .self = DYD_NONE, .v = DYD_NONE};
  for (uint32_t q = 0; q < old->pairs && st == DYD_OK; q++) {
    dyd_vertex_pair p = f->pair[old->first_pair + q];
    dyd_face *owner = NULL;
    dyd_cover found = {0};
    if (!dyd_table_may_list(&star, pd, p.i)) continue;
    if (!dyd_table_listed(&owner, pd, p, 0, fresh) || dyd_table_listed(&owner, pd, p, fresh, f->count)) continue;
    if (!dyd_is_legal(&pd->sk, p.i, p.j)) st = dyd_cover_possible(&found, w, &pd->sk, p.i, p.j, no_hint);
    if (st != DYD_OK || found.possible) continue;
    if (!dyd_reserve((void **)ended, &cap, *count + 1, sizeof **ended)) return DYD_E_NOMEM;
    (*ended)[(*count)++] = p;
  }
  return st;
}

/* Takes pairs out of the faces before `fresh`. */
static void delete_ended(dyd_delaunay *pd, const dyd_vertex_pair *ended, size_t count, size_t fresh) {
  for (size_t q = 0; q < count; q++) {
    dyd_face *owner = NULL;
    dyd_vertex_pair *at;
    while ((at = dyd_table_listed(&owner, pd, ended[q], 0, fresh))) dyd_table_delete(&pd->open, owner, at);
  }
}

dyd_status dyd_faces_end_pairs(dyd_delaunay *pd, dyd_work *w, const dyd_face *old, size_t olds, size_t fresh) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < olds && st == DYD_OK; k++) {
    dyd_vertex_pair *ended = NULL;
    size_t count = 0;
    st = find_ended(&ended, &count, pd, w, &old[k], fresh);
    if (st == DYD_OK) delete_ended(pd, ended, count, fresh);
    free(ended);
  }
  return st;
}

/* All that can fail comes before the first change that cannot be taken back. */
dyd_status dyd_faces_replace(bool *replaced, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count,
                             const dyd_narrowed *narrowed) {
  dyd_undecided *f = &pd->open;
  uint32_t g = f->of[tri[0]];
  dyd_face old = f->face[g];
  dyd_table_take_out(pd, g);
  dyd_undecided before = *f;
  dyd_vertex_pair *ended = NULL;
  size_t ended_count = 0;
  dyd_status st = find_and_prove(pd, w, tri, count);
  if (st == DYD_OK) st = close_parts(pd, w, before.count, narrowed);
  if (st == DYD_OK) st = find_ended(&ended, &ended_count, pd, w, &old, before.count);
  *replaced = st == DYD_OK;
  if (*replaced) {
    share_out_from(pd, before.count);
    delete_ended(pd, ended, ended_count, before.count);
    dyd_table_compact(f);
  } else {
    dyd_table_roll_back(pd, &before);
    dyd_table_put_back(pd, &old);
  }
  free(ended);
  return st;
}
