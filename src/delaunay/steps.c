/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sites measured one by one.
 *
 * A site that becomes narrower can decide pairs with an end at it, and pairs of two others that it was a possible
 * neighbour of [LOC-4]; the mesh stays as it is while its representative is in the new rectangle. */
#include "delaunay/steps.h"

#include "base/alloc.h"
#include "base/index.h"
#include "base/local.h"
#include "delaunay/index_list.h"
#include "delaunay/memory.h"
#include "legal/certify.h"
#include "possible/cover.h"
#include "possible/patches_filter.h"
#include "skeleton/rects_filter.h"

#include <string.h>

/* ---- pairs ---- */

bool dyd_steps_can(const dyd_delaunay *pd) {
  return pd->open.kind == DYD_LISTED && !pd->open.capped;
}

uint64_t dyd_steps_bytes(const dyd_delaunay *pd) {
  const dyd_steps *s = NULL;
  const uint64_t pair = sizeof *s->pair + 2 * sizeof *s->at + sizeof *s->open,
                 vertex = sizeof *s->start + sizeof *s->mark + sizeof *s->nearest + 2 * sizeof *s->seen;
  return dyd_bytes_add(dyd_pairs_bytes(pd, DYD_TIE), pd->open.live_pairs * pair + pd->sk.n * vertex);
}

static dyd_status steps_list(dyd_steps *s, const dyd_pair_list *all) {
  const uint32_t *vertex = s->pd->sk.vertex;
  if (!DYD_NEW(s->pair, all->count)) return DYD_E_NOMEM;
  for (size_t k = 0; k < all->count; k++) {
    uint32_t v = vertex[all->item[k].i], w = vertex[all->item[k].j];
    if (all->item[k].status != DYD_LEGAL) s->pair[s->pairs++] = (dyd_vertex_pair){v < w ? v : w, v < w ? w : v, 0};
  }
  if (s->pairs) qsort(s->pair, s->pairs, sizeof *s->pair, dyd_compare_vertex_pair);
  return DYD_OK;
}

/* Pairs are dealt to their vertices. */
static dyd_status steps_deal(dyd_steps *s) {
  const size_t n = s->pd->sk.n;
  if (!DYD_ZEROED(s->start, n + 2) || !DYD_NEW(s->at, 2 * s->pairs) || !DYD_NEW(s->open, s->pairs) ||
      !DYD_ZEROED(s->mark, n + 1) || !DYD_NEW(s->nearest, n) || !DYD_ZEROED(s->seen, (size_t)s->pd->sk.mesh.count + 1))
    return DYD_E_NOMEM;
  size_t *next = s->start + 1;
  for (size_t k = 0; k < s->pairs; k++) next[s->pair[k].i + 1]++, next[s->pair[k].j + 1]++;
  for (size_t v = 0; v < n; v++) next[v + 1] += next[v];
  for (size_t k = 0; k < s->pairs; k++) s->at[next[s->pair[k].i]++] = s->at[next[s->pair[k].j]++] = (uint32_t)k;
  memset(s->open, true, s->pairs);
  return DYD_OK;
}

dyd_status dyd_steps_begin(dyd_steps *s, dyd_delaunay *pd, const volatile int *cancel) {
  DYD_SCOPED(dyd_pair_list) all = {0};
  s->pd = pd;
  s->run = (dyd_run){.cancel = cancel, .threads = 1};
  dyd_work_init(&s->w, &pd->sk, &s->run);
  dyd_status st = dyd_pairs_list(&all, pd, DYD_TIE);
  if (st == DYD_OK) st = steps_list(s, &all);
  return st == DYD_OK ? steps_deal(s) : st;
}

void dyd_steps_clear(dyd_steps *s) {
  if (s->pd) dyd_work_clear(&s->w);
  dyd_free_all(s->pair, s->start, s->at, s->open, s->mark, s->seen, s->nearest, s->near.item, s->doubt.item,
               s->ended.item, s->part.item, s->lost.item);
  *s = (dyd_steps){0};
}

static uint32_t step_other(const dyd_steps *s, uint32_t pair, uint32_t v) {
  return s->pair[pair].i == v ? s->pair[pair].j : s->pair[pair].i;
}

static dyd_status step_end(dyd_steps *s, uint32_t pair) {
  if (!s->open[pair]) return DYD_OK;
  s->open[pair] = false;
  return dyd_index_list_add(&s->ended, &s->ended_cap, &pair, 1);
}

/* ---- narrower ---- */

/* NEAR: the site narrowed, or a possible neighbour of it. FREE: it, or one that does not meet it any more. SHOWN:
 * possibly nearest at the centre examined. */
enum { NEAR = 1, FREE = 2, SHOWN = 4 };

static dyd_status step_note(dyd_steps *s, uint32_t v, uint32_t of) {
  const dyd_skeleton *sk = &s->pd->sk;
  if (v == sk->mesh.n || s->mark[v]) return DYD_OK;
  s->mark[v] = v != of && dyd_surely_meet(&sk->rects, v, of) ? NEAR : NEAR | FREE;
  return dyd_index_list_add(&s->near, &s->near_cap, &v, 1);
}

static dyd_status step_note_near(dyd_steps *s, uint32_t v) {
  const dyd_skeleton *sk = &s->pd->sk;
  dyd_status st = step_note(s, v, v);
  for (size_t q = s->start[v]; q < s->start[v + 1] && st == DYD_OK; q++)
    if (s->open[s->at[q]]) st = step_note(s, step_other(s, s->at[q], v), v);
  for (dyd_half_edge h = sk->leaving[v]; h != DYD_NONE && st == DYD_OK;
       h = dyd_edge_around(&sk->mesh, h, sk->leaving[v]))
    if (dyd_edge_is_certain(sk, h)) st = step_note(s, dyd_edge_target(&sk->mesh, h), v);
  return st;
}

/* The pair of an edge that has become certain. */
static dyd_status step_end_edge(dyd_steps *s, uint32_t v, uint32_t w) {
  dyd_vertex_pair key = {v < w ? v : w, v < w ? w : v, 0};
  const dyd_vertex_pair *at = s->pairs ? bsearch(&key, s->pair, s->pairs, sizeof key, dyd_compare_vertex_pair) : NULL;
  return at ? step_end(s, (uint32_t)(at - s->pair)) : DYD_OK;
}

/* Edges at v that are not certain, each once. */
static dyd_status step_certify(dyd_steps *s, uint32_t v) {
  dyd_skeleton *sk = &s->pd->sk;
  const dyd_mesh *m = &sk->mesh;
  dyd_status st = DYD_OK;
  for (dyd_half_edge h = sk->leaving[v]; h != DYD_NONE && st == DYD_OK; h = dyd_edge_around(m, h, sk->leaving[v])) {
    const uint32_t w = dyd_edge_target(m, h);
    if (dyd_edge_is_certain(sk, h) || (w < v && s->mark[w])) continue;
    st = dyd_certify_edge(sk, &s->w, h);
    if (st == DYD_OK && w != m->n && dyd_edge_is_certain(sk, h)) st = step_end_edge(s, v, w);
  }
  return st;
}

/* Lists open pairs of v that may have become impossible, each once: all of the site narrowed, else those of two that
 * are free. */
static dyd_status step_doubt(dyd_steps *s, uint32_t v, uint32_t of) {
  dyd_status st = DYD_OK;
  for (size_t q = s->start[v]; q < s->start[v + 1] && st == DYD_OK; q++) {
    const uint32_t k = s->at[q], w = step_other(s, k, v);
    if (!s->open[k] || (v != of && (w == of || w < v || !(s->mark[w] & FREE)))) continue;
    if (!dyd_surely_meet(&s->pd->sk.rects, v, w)) st = dyd_index_list_add(&s->doubt, &s->doubt_cap, &k, 1);
  }
  return st;
}

/* The centre shows some of those left to be possible. */
static void step_clear_doubts(dyd_steps *s, dyd_xy centre) {
  size_t kept = 0;
  dyd_filter_clique(s->nearest, &s->pd->sk.rects, centre, s->near.item, s->near.count);
  for (size_t k = 0; k < s->near.count; k++)
    if (s->nearest[k]) s->mark[s->near.item[k]] |= SHOWN;
  for (size_t k = 0; k < s->doubt.count; k++) {
    const dyd_vertex_pair *p = &s->pair[s->doubt.item[k]];
    if (!(s->mark[p->i] & s->mark[p->j] & SHOWN)) s->doubt.item[kept++] = s->doubt.item[k];
  }
  for (size_t k = 0; k < s->near.count; k++) s->mark[s->near.item[k]] &= (uint8_t)~SHOWN;
  s->doubt.count = kept;
}

static dyd_status step_settle(dyd_steps *s, uint32_t of) {
  dyd_status st = DYD_OK;
  while (s->doubt.count && st == DYD_OK) {
    const uint32_t k = s->doubt.item[--s->doubt.count], v = s->pair[k].i, w = s->pair[k].j;
    const uint32_t hint[2] = {v == of || w == of ? DYD_NONE : of, DYD_NONE};
    dyd_cover found;
    st = dyd_cover_possible(&found, &s->w, &s->pd->sk, v, w, hint);
    if (st == DYD_OK && !found.possible) st = step_end(s, k);
    if (st == DYD_OK && found.possible && !found.walked)
      step_clear_doubts(s, (dyd_xy){found.place.e[0], found.place.e[2]});
  }
  return st;
}

dyd_status dyd_steps_narrow(bool *holds, dyd_steps *s, uint32_t site) {
  dyd_skeleton *sk = &s->pd->sk;
  const uint32_t v = sk->vertex[site];
  s->near.count = s->ended.count = s->doubt.count = 0;
  dyd_status st = dyd_reps_stay(holds, &sk->reps, v);
  if (st != DYD_OK || !*holds) return st;
  if (dyd_work_cancelled(&s->w)) return DYD_CANCELLED;
  dyd_skeleton_set_box(sk, v);
  st = step_note_near(s, v);
  for (size_t k = 0; k < s->near.count && st == DYD_OK; k++) st = step_certify(s, s->near.item[k]);
  for (size_t k = 0; k < s->near.count && st == DYD_OK; k++)
    if (s->mark[s->near.item[k]] & FREE) st = step_doubt(s, s->near.item[k], v);
  if (st == DYD_OK) st = step_settle(s, v);
  for (size_t k = 0; k < s->near.count; k++) s->mark[s->near.item[k]] = 0;
  return st;
}

/* ---- wider ---- */

/* Of a triangle: bit k, half-edge k is decided; PART: it is in s->part. */
enum { DECIDED = 1, PART = 8, MOST_PART = 512 };

static dyd_status step_reach(dyd_steps *s, uint32_t t) {
  if (s->seen[t] & PART) return DYD_OK;
  s->seen[t] |= PART;
  return dyd_index_list_add(&s->part, &s->part_cap, &t, 1);
}

/* Decides an edge that was certain, once; if it no longer is, the faces beyond it join the part. *stops: that is
 * enough. */
static dyd_status step_edge(bool *stops, dyd_steps *s, dyd_half_edge h, bool (*stop)(void *user, uint32_t, uint32_t),
                            void *user) {
  dyd_skeleton *sk = &s->pd->sk;
  const dyd_half_edge twin = dyd_edge_twin(&sk->mesh, h);
  const uint32_t v = dyd_edge_origin(&sk->mesh, h), w = dyd_edge_target(&sk->mesh, h);
  dyd_status st = DYD_OK;
  if (dyd_edge_is_certain(sk, h) && !(s->seen[dyd_edge_triangle(h)] >> dyd_edge_corner(h) & DECIDED)) {
    s->seen[dyd_edge_triangle(h)] |= (uint8_t)(DECIDED << dyd_edge_corner(h));
    s->seen[dyd_edge_triangle(twin)] |= (uint8_t)(DECIDED << dyd_edge_corner(twin));
    dyd_set_certain(sk, h, false);
    st = dyd_certify_edge(sk, &s->w, h);
    if (!dyd_edge_is_certain(sk, h)) {
      *stops = v != sk->mesh.n && w != sk->mesh.n && stop(user, sk->reps.site[v], sk->reps.site[w]);
      dyd_status listed = dyd_index_list_add(&s->lost, &s->lost_cap, &h, 1);
      if (listed != DYD_OK) dyd_set_certain(sk, h, true);
      if (st == DYD_OK) st = listed;
    }
  }
  return st != DYD_OK || dyd_edge_is_certain(sk, h) ? st : step_reach(s, dyd_edge_triangle(twin));
}

dyd_status dyd_steps_widen(bool *holds, dyd_steps *s, uint32_t site, bool (*stop)(void *user, uint32_t i, uint32_t j),
                           void *user) {
  dyd_skeleton *sk = &s->pd->sk;
  const uint32_t v = sk->vertex[site];
  bool stops = false;
  dyd_status st = dyd_work_cancelled(&s->w) ? DYD_CANCELLED : DYD_OK;
  s->part.count = s->lost.count = 0;
  dyd_skeleton_set_box(sk, v);
  for (dyd_half_edge h = sk->leaving[v]; h != DYD_NONE && st == DYD_OK;
       h = dyd_edge_around(&sk->mesh, h, sk->leaving[v]))
    st = step_reach(s, dyd_edge_triangle(h));
  for (size_t k = 0; k < 3 * s->part.count && st == DYD_OK && !stops && s->part.count < MOST_PART; k++)
    st = step_edge(&stops, s, dyd_edge_of(s->part.item[k / 3], k % 3), stop, user);
  *holds = st == DYD_OK && !stops && s->part.count < MOST_PART;
  for (size_t k = 0; k < s->part.count; k++)
    for (unsigned e = 0; e < 3; e++)
      s->seen[dyd_edge_triangle(s->pd->sk.mesh.tri[s->part.item[k]].n[e])] = s->seen[s->part.item[k]] = 0;
  return st;
}

void dyd_steps_back(dyd_steps *s, uint32_t site) {
  dyd_skeleton_set_box(&s->pd->sk, s->pd->sk.vertex[site]);
  for (size_t k = 0; k < s->lost.count; k++) dyd_set_certain(&s->pd->sk, s->lost.item[k], true);
}

bool dyd_steps_part_is_sure(const dyd_steps *s) {
  for (size_t k = 0; k < s->part.count; k++)
    if (!dyd_triangle_is_certain(&s->pd->sk, s->part.item[k])) return false;
  return true;
}

/* The sites at the corners of triangles, ascending. */
static dyd_status corner_sites(dyd_index_list *out, const dyd_skeleton *sk, const dyd_index_list *triangles) {
  size_t cap = 0;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < 3 * triangles->count && st == DYD_OK; k++) {
    const uint32_t v = sk->mesh.tri[triangles->item[k / 3]].v[k % 3];
    if (v != sk->mesh.n) st = dyd_index_list_add(out, &cap, &sk->reps.site[v], 1);
  }
  dyd_index_list_sort(out);
  return st;
}

dyd_status dyd_steps_part_sites(dyd_index_list *out, const dyd_steps *s) {
  return corner_sites(out, &s->pd->sk, &s->part);
}

/* ---- faces ---- */

/* The triangles joined to t by edges that are not certain; marked in `seen`. */
static dyd_status face_flood(dyd_index_list *out, size_t *cap, uint8_t *seen, const dyd_skeleton *sk, uint32_t t) {
  out->count = 0;
  seen[t] = 1;
  dyd_status st = dyd_index_list_add(out, cap, &t, 1);
  for (size_t k = 0; k < 3 * out->count && st == DYD_OK; k++) {
    const dyd_half_edge h = dyd_edge_of(out->item[k / 3], k % 3);
    const uint32_t beyond = dyd_edge_triangle(dyd_edge_twin(&sk->mesh, h));
    if (dyd_edge_is_certain(sk, h) || seen[beyond]) continue;
    seen[beyond] = 1;
    st = dyd_index_list_add(out, cap, &beyond, 1);
  }
  return st;
}

dyd_status dyd_steps_large(bool *large, const dyd_steps *s, size_t most) {
  const dyd_skeleton *sk = &s->pd->sk;
  DYD_SCOPED(dyd_index_list) face = {0};
  size_t cap = 0;
  DYD_FREED uint8_t *seen = calloc((size_t)sk->mesh.count + 1, 1);
  dyd_status st = seen ? DYD_OK : DYD_E_NOMEM;
  for (uint32_t t = 0; t < sk->mesh.count && st == DYD_OK; t++) {
    DYD_SCOPED(dyd_index_list) sites = {0};
    if (seen[t] || dyd_triangle_is_certain(sk, t)) continue;
    st = face_flood(&face, &cap, seen, sk, t);
    if (st == DYD_OK && face.count > most / 3) st = corner_sites(&sites, sk, &face);
    for (size_t k = 0; k < sites.count && sites.count > most; k++) large[sites.item[k]] = true;
  }
  return st;
}
