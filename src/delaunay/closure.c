/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Closure under flips.
 *
 * Any two choices are joined by a path along which the Delaunay triangulation changes by flips. So starting from the
 * skeleton's edges, whenever an uncertain possible pair ij has two common possible neighbours k, l, the pair kl may
 * come: it is decided by cover. The ghost takes part as a vertex: its pairs are the possible hull vertices. Every quad
 * is seen when the last of its five pairs is taken from the queue (the links of the map in their order of addition).
 * Certain pairs are never displaced, and every other possible pair lies inside one face, so a face is closed in itself
 * [CLO-1]. A face of exact points whose uncertain edges are all exact ties is one cocircular polygon (or, beyond the
 * hull, one collinear chain): all its pairs are possible [CLO-2]. */
#include "delaunay/closure.h"

#include "base/alloc.h"
#include "base/local.h"
#include "legal/witness.h"
#include "possible/cover.h"
#include "possible/pair_map.h"
#include "possible/patches_filter.h"
#include "predicate/circle.h"
#include "rect/rect.h"
#include "skeleton/hull.h"
#include "skeleton/mesh_filter.h"
#include "skeleton/rects_filter.h"
#include "skeleton/skeleton.h"
#include "skeleton/work.h"

#include <dyadel/predicate.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Possibly nearest sites at one dyadic point, exactly.
 *
 * If ds_i(c), ds_j(c) <= M(c), the least dl_k(c) of all k, then c is a centre of ij: possible [POS-1]. Any c will do.
 */

typedef struct meeting {
  uint32_t *vertex;
  size_t count, cap, most;
  bool full; /* no memory */
} meeting;

static bool centre_meet(void *context, uint32_t k) {
  meeting *m = context;
  m->full = !DYD_GROW(m->vertex, m->cap, m->count + 1);
  if (!m->full) m->vertex[m->count++] = k;
  return !m->full && m->count <= m->most;
}

/* Collects all sites that may have ds <= M: not farther than dl of the vertex v. Collects none if they are too many. */
static dyd_status centre_gather(meeting *m, const dyd_skeleton *sk, const dyd_point *c, uint32_t v) {
  dyd_bbox box = dyd_point_box(c);
  double radius2 = dyd_dl2_upper(&box, &sk->rects.box[v]);
  if (isnan(radius2) || sk->mesh.no_filter) radius2 = INFINITY;
  dyd_tree_near(&sk->rects.tree, &box, &radius2, centre_meet, m);
  if (m->count > m->most) m->count = 0;
  return m->full ? DYD_E_NOMEM : DYD_OK;
}

/* Leaves those with ds <= least dl. */
static void centre_choose(meeting *m, const dyd_skeleton *sk, const dyd_point *c) {
  DYD_LOCAL(dyd_rect, best, r);
  size_t kept = 0;
  for (size_t k = 0; k < m->count; k++) {
    dyd_rects_get(&r, &sk->rects, m->vertex[k]);
    if (k == 0 || dyd_compare_distance(c, &r, DYD_FARTHEST, &best, DYD_FARTHEST) < 0) dyd_rect_swap(&best, &r);
  }
  for (size_t k = 0; k < m->count; k++) {
    dyd_rects_get(&r, &sk->rects, m->vertex[k]);
    if (dyd_compare_distance(c, &r, DYD_CLOSEST, &best, DYD_FARTHEST) <= 0) m->vertex[kept++] = m->vertex[k];
  }
  m->count = kept;
}

/* Vertices that are possibly nearest at one point, so that all pairs of them are possible [POS-1]: those with ds <= M
 * at a dyadic point next to the centre of the circle through the representatives of v[0..2], exactly. Few or none if
 * these are (nearly) collinear; none if the circle may hold or touch more than `most`. *vertex is owned by the caller,
 * NULL when *count is 0. */
static dyd_status dyd_centre_shows(uint32_t **vertex, size_t *count, const dyd_skeleton *sk, const uint32_t v[3],
                                   size_t most) {
  meeting m = {.most = most};
  DYD_LOCAL(dyd_point, c);
  dyd_status st = dyd_circumcentre_round(&c, sk, v) ? centre_gather(&m, sk, &c, v[0]) : DYD_OK;
  if (st == DYD_OK) centre_choose(&m, sk, &c);
  if (st != DYD_OK || m.count == 0) {
    free(m.vertex);
    m = (meeting){0};
  }
  *vertex = m.vertex;
  *count = m.count;
  return st;
}

/* CROWD: least number of triangles of a face for which a search of the plane pays. PATIENCE: walks before the first
 * centre is tried. MOST_BITS: members of a face that has its pairs as bits, too, from the first; FEW_PAIRS: others have
 * them when one pair in that number is known. In the armed build small faces take part, too. */
#ifdef DYD_ARMED
enum { CROWD = 5, PATIENCE = 1, MOST_BITS = 16, FEW_PAIRS = 4 };
#else
enum { CROWD = 64, PATIENCE = 4, MOST_BITS = 1024, FEW_PAIRS = 64 };
#endif

/* Members 0 .. vertices-1 are the face's vertices, member `vertices` is the ghost (if outer). */
typedef struct closing {
  const dyd_skeleton *sk;
  dyd_work *w;
  dyd_closure *out;
  dyd_pair_map map;
  uint64_t *possible, *known_with; /* a row of `words` for each member; NULL: not yet made */
  size_t words;
  const uint32_t *tri;
  uint32_t tris;
  size_t open, room;
  uint64_t known, all;           /* pairs of sites that have a state, of how many */
  size_t walks, patience, tries; /* walks to a possible pair since a centre was tried; after how many the next one is */
  size_t shown, hope, reached;   /* the same for pairs that doubles showed and pairs far apart */
  bool full;
} closing;

static dyd_status closing_gather(closing *c) {
  const dyd_mesh *m = &c->sk->mesh;
  dyd_closure *out = c->out;
  if (!DYD_NEW(out->vertex, 3 * (size_t)c->tris)) return DYD_E_NOMEM;
  uint32_t count = 0;
  for (uint32_t q = 0; q < c->tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t v = m->tri[c->tri[q]].v[k];
      if (v == m->n)
        out->outer = true;
      else
        out->vertex[count++] = v;
    }
  qsort(out->vertex, count, sizeof *out->vertex, dyd_compare_index);
  out->all_points = true;
  for (uint32_t q = 0; q < count; q++) {
    if (out->vertices && out->vertex[out->vertices - 1] == out->vertex[q]) continue;
    out->vertex[out->vertices++] = out->vertex[q];
    out->all_points = out->all_points && dyd_vertex_is_point(c->sk, out->vertex[q]);
  }
  c->all = out->vertices * (out->vertices - UINT64_C(1)) / 2;
  c->words = out->vertices / 64 + (size_t)1;
  return DYD_OK;
}

static uint32_t closing_member(const closing *c, uint32_t v) {
  if (v == c->sk->mesh.n) return c->out->vertices;
  const uint32_t *p = bsearch(&v, c->out->vertex, c->out->vertices, sizeof v, dyd_compare_index);
  return (uint32_t)(p - c->out->vertex);
}

static dyd_status keep_pair(dyd_closure *out, uint32_t a, uint32_t b) {
  if (!DYD_GROW(out->pair, out->pair_cap, out->pairs + 1)) return DYD_E_NOMEM;
  out->pair[out->pairs++] = a < b ? (dyd_vertex_pair){a, b, 0} : (dyd_vertex_pair){b, a, 0};
  return DYD_OK;
}

static void set_bit(uint64_t *rows, const closing *c, uint32_t a, uint32_t b) {
  rows[a * c->words + b / 64] |= UINT64_C(1) << b % 64;
  rows[b * c->words + a / 64] |= UINT64_C(1) << a % 64;
}

static void set_bits(closing *c, uint32_t a, uint32_t b, dyd_pair_state state) {
  set_bit(c->known_with, c, a, b);
  if (dyd_pair_is_possible(state)) set_bit(c->possible, c, a, b);
}

static bool closing_knows(const closing *c, uint32_t a, uint32_t b) {
  if (c->known_with) return c->known_with[a * c->words + b / 64] >> b % 64 & 1;
  return dyd_pair_map_get(&c->map, a, b) != DYD_PAIR_UNKNOWN;
}

static uint64_t bits_bytes(const closing *c) {
  uint64_t members = (uint64_t)c->out->vertices + 1;
  return members > MOST_BITS && c->known < c->all / FEW_PAIRS ? 0 : 2 * members * c->words * sizeof *c->possible;
}

/* Bits in addition to the map while they take little memory, or less than the map: sets of common neighbours are found
 * by words. */
static dyd_status start_bits(closing *c) {
  size_t size = (c->out->vertices + (size_t)1) * c->words;
  if (c->possible || !bits_bytes(c)) return DYD_OK;
  c->possible = calloc(size, sizeof *c->possible);
  c->known_with = calloc(size, sizeof *c->known_with);
  if (!c->possible || !c->known_with) return DYD_E_NOMEM;
  for (size_t q = 0; q <= c->map.mask; q++) {
    uint64_t key = c->map.key[q] - 1;
    if (c->map.key[q]) set_bits(c, (uint32_t)(key >> 32), (uint32_t)key, (dyd_pair_state)c->map.state[q]);
  }
  return DYD_OK;
}

/* ---- exact ties ---- */

/* All sites exact, all uncertain edges exact ties, and either no ghost triangle or nothing else? */
static bool is_polygon(const closing *c) {
  uint32_t ghosts = 0;
  if (!c->out->all_points) return false;
  for (uint32_t q = 0; q < c->tris; q++) {
    uint32_t t = c->tri[q];
    ghosts += dyd_is_ghost_triangle(&c->sk->mesh, t);
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++)
      if (!dyd_edge_is_certain(c->sk, h) && dyd_mesh_beyond(&c->w->tally, &c->sk->mesh, h) != 0) return false;
  }
  return ghosts == 0 || ghosts == c->tris;
}

/* One more pair: the map grows in steps, and the open pairs are copied from it at the end. */
static dyd_status closing_reserve(closing *c) {
  uint64_t pairs = dyd_bytes_times(c->open + c->open / 2, sizeof *c->out->pair);
  if (!dyd_pair_map_is_full(&c->map)) return DYD_OK;
  uint64_t bytes = dyd_bytes_add(dyd_bytes_add(pairs, bits_bytes(c)), dyd_pair_map_bytes(&c->map));
  return dyd_memory_has(&c->w->memory, bytes, "the possible pairs of a face") ? start_bits(c) : DYD_E_NOMEM;
}

static dyd_status closing_add(closing *c, uint32_t a, uint32_t b, dyd_pair_state state) {
  uint32_t ghost = c->out->vertices;
  dyd_status st = closing_reserve(c);
  if (st != DYD_OK) return st;
  if (c->possible) set_bits(c, a, b, state);
  c->known += a != ghost && b != ghost;
  if (state == DYD_PAIR_OPEN && a != ghost && b != ghost && c->open++ >= c->room) c->full = true;
  return dyd_pair_map_add(&c->map, a, b, state);
}

/* The edges of the face's triangles: the certain ones, or the others. */
static dyd_status add_edges(closing *c, bool certain) {
  const dyd_mesh *m = &c->sk->mesh;
  dyd_status st = DYD_OK;
  for (uint32_t q = 0; q < c->tris && st == DYD_OK; q++)
    for (dyd_half_edge h = dyd_edge_of(c->tri[q], 0); h < dyd_edge_end(c->tri[q]) && st == DYD_OK; h++) {
      if (dyd_edge_is_certain(c->sk, h) != certain) continue;
      uint32_t a = closing_member(c, dyd_edge_origin(m, h)), b = closing_member(c, dyd_edge_target(m, h));
      if (dyd_pair_map_get(&c->map, a, b) == DYD_PAIR_UNKNOWN)
        st = closing_add(c, a, b, certain ? DYD_PAIR_CERTAIN : DYD_PAIR_OPEN);
    }
  return st;
}

static dyd_status all_pairs(closing *c) {
  uint64_t m = c->out->vertices;
  uint64_t bytes = dyd_bytes_times(m * (m - 1) / 2, sizeof *c->out->pair);
  if (!dyd_memory_has(&c->w->memory, dyd_bytes_add(bytes, bytes / 2), "the pairs of a tie")) return DYD_E_NOMEM;
  dyd_status st = add_edges(c, true);
  for (uint32_t a = 0; a < m && st == DYD_OK; a++)
    for (uint32_t b = a + 1; b < m && st == DYD_OK; b++)
      if (dyd_pair_map_get(&c->map, a, b) == DYD_PAIR_UNKNOWN)
        st = keep_pair(c->out, c->out->vertex[a], c->out->vertex[b]);
  return st;
}

/* ---- the general case ---- */

/* The ghost's pairs, all of them. */
static dyd_status start_ghost(closing *c) {
  uint32_t ghost = c->out->vertices;
  dyd_status st = DYD_OK;
  for (uint32_t a = 0; a < ghost && c->out->outer && st == DYD_OK; a++) {
    if (dyd_pair_map_get(&c->map, a, ghost) != DYD_PAIR_UNKNOWN) continue;
    if (dyd_work_cancelled(c->w)) return DYD_CANCELLED;
    bool possible;
    st = dyd_hull_possible(&possible, c->w, c->sk, c->out->vertex[a]);
    if (st == DYD_OK) st = closing_add(c, a, ghost, possible ? DYD_PAIR_OPEN : DYD_PAIR_IMPOSSIBLE);
  }
  return st;
}

/* A pair of sites without a state. */
static dyd_status add_possible(closing *c, uint32_t a, uint32_t b) {
  return closing_add(c, a, b,
                     dyd_is_legal(c->sk, c->out->vertex[a], c->out->vertex[b]) ? DYD_PAIR_CERTAIN : DYD_PAIR_OPEN);
}

/* ---- many overlapping rectangles: patches of the plane [PLANE-1] ---- */

static dyd_status closing_found(void *context, bool *enough, uint32_t a, uint32_t b) {
  closing *c = context;
  dyd_status st = add_possible(c, a, b);
  *enough = c->full || c->known == c->all;
  return st;
}

/* Returns true if most vertices have uncertain edges all around. */
static bool is_crowded(const closing *c) {
  return c->tris >= CROWD && c->tris / 3 >= c->out->vertices / 2 && !c->sk->mesh.no_filter;
}

/* Returns true if a search of the plane pays. It visits all sites: only if many of them are vertices here, or each has
 * many pairs. */
static bool is_worth_patches(const closing *c) {
  size_t all = c->sk->rects.tree.count;
  return all / 16 <= c->out->vertices || all / 2 <= c->known;
}

/* A member by the left side of its box, for a sweep from left to right. */
typedef struct sweep_entry {
  double left;
  uint32_t member;
} sweep_entry;

static int compare_left(const void *a, const void *b) {
  const sweep_entry *x = a, *y = b;
  if (x->left != y->left) return x->left < y->left ? -1 : 1;
  return (x->member > y->member) - (x->member < y->member);
}

static sweep_entry *sweep_order(const closing *c) {
  uint32_t count = c->out->vertices;
  sweep_entry *e = dyd_alloc(count, sizeof *e);
  if (!e) return NULL;
  for (uint32_t a = 0; a < count; a++) e[a] = (sweep_entry){c->sk->rects.box[c->out->vertex[a]].e[0], a};
  qsort(e, count, sizeof *e, compare_left);
  return e;
}

/* Rectangles that meet are a possible pair [POS-1]: doubles decide nearly all. */
static dyd_status add_meeting(closing *c) {
  const dyd_rects *rects = &c->sk->rects;
  const uint32_t *v = c->out->vertex, count = c->out->vertices;
  DYD_FREED sweep_entry *e = sweep_order(c);
  dyd_status st = e ? DYD_OK : DYD_E_NOMEM;
  for (uint32_t q = 0; q < count && st == DYD_OK && !c->full; q++) {
    uint32_t a = e[q].member;
    double right = rects->box[v[a]].e[1];
    if (dyd_work_cancelled(c->w)) st = DYD_CANCELLED;
    for (uint32_t r = q + 1; r < count && st == DYD_OK && !c->full && e[r].left <= right; r++) {
      uint32_t b = e[r].member;
      if (dyd_surely_meet(rects, v[a], v[b]) && dyd_pair_map_get(&c->map, a, b) == DYD_PAIR_UNKNOWN)
        st = closing_add(c, a, b, DYD_PAIR_OPEN);
    }
  }
  return st;
}

/* Does the decider of the run know whether the pair is possible? */
static bool closing_is_told(bool *possible, const closing *c, uint32_t a, uint32_t b) {
  const dyd_decider *d = c->w->run->decider;
  const uint32_t *site = c->sk->reps.site, *v = c->out->vertex;
  return d && d->tell(possible, d->context, site[v[a]], site[v[b]]);
}

/* Decides a pair of members that has no state. */
static dyd_status closing_cover(dyd_cover *found, closing *c, uint32_t a, uint32_t b, const uint32_t hint[2]) {
  const uint32_t *v = c->out->vertex;
  *found = (dyd_cover){0};
  bool told = closing_is_told(&found->possible, c, a, b);
  dyd_status st = told ? DYD_OK : dyd_cover_possible(found, c->w, c->sk, v[a], v[b], hint);
  if (st != DYD_OK) return st;
  return found->possible ? add_possible(c, a, b) : closing_add(c, a, b, DYD_PAIR_IMPOSSIBLE);
}

static const uint32_t no_hint[2] = {DYD_NONE, DYD_NONE};

static dyd_status closing_decide(void *context, bool *enough, uint32_t a, uint32_t b) {
  closing *c = context;
  dyd_cover found;
  dyd_status st = closing_cover(&found, c, a, b, no_hint);
  *enough = c->full || c->known == c->all;
  return st;
}

/* *done: all possible pairs have been found. */
static dyd_status close_by_patches(bool *done, closing *c) {
  dyd_patches patches = {.rects = &c->sk->rects,
                         .cancel = c->w->run->cancel,
                         .vertex = c->out->vertex,
                         .vertices = c->out->vertices,
                         .map = &c->map,
                         .found = closing_found,
                         .decide = closing_decide,
                         .context = c};
  return dyd_patches_run(done, &patches);
}

/* ---- few: closure under flips ---- */

/* All pairs of these members that have no state are possible. */
static dyd_status add_all(closing *c, const uint32_t *member, size_t count) {
  dyd_status st = DYD_OK;
  for (size_t a = 0; a < count && !c->full; a++)
    for (size_t b = a + 1; b < count && !c->full && st == DYD_OK; b++)
      if (!closing_knows(c, member[a], member[b])) st = add_possible(c, member[a], member[b]);
  return st;
}

/* Vertices become members; the others are dropped. Returns how many remain. */
static size_t to_members(uint32_t *vertex, size_t count, const dyd_closure *out) {
  size_t members = 0;
  for (size_t k = 0; k < count; k++) {
    const uint32_t *p = dyd_find_index(&vertex[k], out->vertex, out->vertices, sizeof *p);
    if (p) vertex[members++] = (uint32_t)(p - out->vertex);
  }
  return members;
}

/* Exact walks have found several possible pairs: perhaps the sites are nearly on one circle, whose centre shows many
 * more: the circle through the last three, or, at first, through three sites of the face far apart. */
static dyd_status closing_try_centre(closing *c, uint32_t k, uint32_t l, uint32_t other) {
  const uint32_t *v = c->out->vertex, n = c->out->vertices;
  const uint32_t three[2][3] = {{v[0], v[n / 3], v[2 * n / 3]}, {k, l, other}};
  DYD_FREED uint32_t *vertex = NULL;
  size_t count = 0, before = c->known;
  if (other == DYD_NONE || ++c->walks < c->patience || c->sk->mesh.no_filter) return DYD_OK;
  dyd_status st = dyd_centre_shows(&vertex, &count, c->sk, three[c->tries++ > 0], 2 * (size_t)n);
  if (st == DYD_OK) st = add_all(c, vertex, to_members(vertex, count, c->out));
  if (c->known < before + c->walks) c->patience *= 2;
  c->walks = 0;
  return st;
}

/* Member a, and the one farthest from it in order whose pair with it is open; a itself: there is none. */
static uint32_t farthest_unknown(const closing *c, uint32_t a) {
  uint32_t n = c->out->vertices;
  for (uint32_t most = a > n - 1 - a ? a : n - 1 - a; most > 0; most--) {
    if (most <= a && !closing_knows(c, a, a - most)) return a - most;
    if (most < n - a && !closing_knows(c, a, a + most)) return a + most;
  }
  return a;
}

/* All pairs of members that are near the centre, certainly. */
static dyd_status add_clique(closing *c, dyd_xy centre) {
  uint32_t n = c->out->vertices, count = 0;
  DYD_FREED uint32_t *member = dyd_alloc(n, sizeof *member);
  DYD_FREED bool *near = dyd_alloc(n, sizeof *near);
  if (!member || !near) return DYD_E_NOMEM;
  dyd_filter_clique(near, &c->sk->rects, centre, c->out->vertex, n);
  for (uint32_t a = 0; a < n; a++)
    if (near[a]) member[count++] = a;
  return add_all(c, member, count);
}

/* Doubles have shown many possible pairs, near ones first: perhaps the sites are about on a line, and the centre of two
 * far apart shows many more. */
static dyd_status closing_try_far(closing *c) {
  size_t before = c->known;
  if (++c->shown < c->hope || c->sk->mesh.no_filter) return DYD_OK;
  uint32_t n = c->out->vertices, a = 0, b = 0;
  for (int tries = 0; tries < 8 && a == b; tries++) {
    a = (uint32_t)((uint64_t)(uint32_t)(c->reached++ * UINT32_C(2654435769)) * n >> 32);
    b = farthest_unknown(c, a);
  }
  dyd_cover found = {0};
  dyd_status st = a == b ? DYD_OK : closing_cover(&found, c, a, b, no_hint);
  if (st == DYD_OK && found.possible && !found.walked) st = add_clique(c, (dyd_xy){found.place.e[0], found.place.e[2]});
  c->hope = c->known < before + c->shown ? 2 * c->hope : PATIENCE;
  c->shown = 0;
  return st;
}

/* The pair kl may take the place of ij: decide it, once. */
static dyd_status closing_flip(closing *c, uint32_t i, uint32_t j, uint32_t k, uint32_t l) {
  uint32_t ghost = c->out->vertices;
  const uint32_t *v = c->out->vertex;
  const uint32_t hint[2] = {i == ghost ? DYD_NONE : v[i], j == ghost ? DYD_NONE : v[j]};
  dyd_cover found;
  if (k == ghost || l == ghost || closing_knows(c, k, l)) return DYD_OK;
  if (i != ghost && j != ghost && dyd_surely_not_displaced(c->sk, v[i], v[j], v[k], v[l])) return DYD_OK;
  dyd_status st = closing_cover(&found, c, k, l, hint);
  if (st != DYD_OK || !found.possible) return st;
  return found.walked ? closing_try_centre(c, v[k], v[l], hint[0]) : closing_try_far(c);
}

/* Search for common possible neighbours of i and j, one after another; with k, for those whose pair with k has no
 * state. Init with .link = the first link of i. */
typedef struct common {
  uint32_t i, j, k, link, vertex;
  size_t word;
  uint64_t left;
} common;

static bool next_linked(common *s, const closing *c) {
  while (s->link != DYD_NONE) {
    dyd_pair_link l = c->map.link[s->link];
    s->link = l.next;
    s->vertex = l.to;
    if (l.to != s->j && l.to != s->k && dyd_pair_is_possible(dyd_pair_map_get(&c->map, s->j, l.to))) return true;
  }
  return false;
}

static bool next_common(common *s, const closing *c) {
  if (!c->possible) return next_linked(s, c);
  const uint64_t *i = c->possible + s->i * c->words, *j = c->possible + s->j * c->words;
  const uint64_t *known = s->k == DYD_NONE ? NULL : c->known_with + s->k * c->words;
  while (s->left == 0) {
    if (s->word == c->words) return false;
    s->left = i[s->word] & j[s->word] & (known ? ~known[s->word] : UINT64_MAX);
    s->word++;
  }
  s->vertex = (uint32_t)(64 * (s->word - 1)) + (uint32_t)__builtin_ctzll(s->left);
  s->left &= s->left - 1;
  return true;
}

/* ij uncertain with the common neighbour k: every other common neighbour l. */
static dyd_status flips_with(closing *c, uint32_t i, uint32_t j, uint32_t k) {
  common s = {.i = i, .j = j, .k = k, .link = c->map.head[i]};
  dyd_status st = DYD_OK;
  if (dyd_pair_map_get(&c->map, i, j) != DYD_PAIR_OPEN) return st;
  while (st == DYD_OK && next_common(&s, c))
    if (s.vertex != k) st = closing_flip(c, i, j, k, s.vertex);
  return st;
}

/* All quads in which the pair ab is the last one: as the pair displaced, or as one of the four sides. */
static dyd_status closing_settle(closing *c, uint32_t a, uint32_t b) {
  common s = {.i = a, .j = b, .k = DYD_NONE, .link = c->map.head[a]};
  dyd_status st = DYD_OK;
  while (st == DYD_OK && next_common(&s, c)) {
    st = flips_with(c, a, b, s.vertex);
    if (st == DYD_OK) st = flips_with(c, a, s.vertex, b);
    if (st == DYD_OK) st = flips_with(c, b, s.vertex, a);
  }
  return st;
}

static dyd_status closing_run(closing *c) {
  bool done = false;
  bool crowded = is_crowded(c);
  dyd_status st = start_bits(c);
  if (st == DYD_OK) st = add_edges(c, true);
  if (st == DYD_OK) st = add_edges(c, false);
  if (st == DYD_OK && crowded) st = add_meeting(c);
  if (st == DYD_OK && crowded && !c->full && c->known < c->all && is_worth_patches(c)) st = close_by_patches(&done, c);
  if (done || c->full || c->known == c->all) return st;
  if (st == DYD_OK) st = start_ghost(c);
  for (size_t q = 0; q < c->map.links && st == DYD_OK && !c->full && c->known < c->all; q += 2) {
    if (dyd_work_cancelled(c->w)) return DYD_CANCELLED;
    st = closing_settle(c, c->map.link[q + 1].to, c->map.link[q].to);
  }
  return st;
}

/* Every open pair of real members; when the cap was met only those of the skeleton, which come first. */
static dyd_status closing_collect(closing *c, size_t links) {
  uint32_t ghost = c->out->vertices;
  dyd_status st = DYD_OK;
  for (size_t q = 0; q < links && st == DYD_OK; q += 2) {
    uint32_t b = c->map.link[q].to, a = c->map.link[q + 1].to;
    if (a != ghost && b != ghost && dyd_pair_map_get(&c->map, a, b) == DYD_PAIR_OPEN)
      st = keep_pair(c->out, c->out->vertex[a], c->out->vertex[b]);
  }
  return st;
}

static dyd_status skeleton_pairs(closing *c) {
  const dyd_mesh *m = &c->sk->mesh;
  dyd_status st = DYD_OK;
  c->out->capped = true;
  c->out->pairs = 0;
  for (uint32_t q = 0; q < c->tris && st == DYD_OK; q++)
    for (dyd_half_edge h = dyd_edge_of(c->tri[q], 0); h < dyd_edge_end(c->tri[q]) && st == DYD_OK; h++) {
      uint32_t a = dyd_edge_origin(m, h), b = dyd_edge_target(m, h);
      if (a < b && b != m->n && !dyd_edge_is_certain(c->sk, h)) st = keep_pair(c->out, a, b);
    }
  return st;
}

dyd_status dyd_closure_run(dyd_closure *out, dyd_work *w, const dyd_skeleton *sk, const uint32_t *tri, uint32_t tris,
                           size_t room, bool postponed) {
  closing c = {
      .sk = sk, .w = w, .out = out, .tri = tri, .tris = tris, .room = room, .patience = PATIENCE, .hope = PATIENCE};
  *out = (dyd_closure){0};
  dyd_status st = closing_gather(&c);
  out->polygon = st == DYD_OK && !postponed && is_polygon(&c);
  out->postponed = c.full = postponed;
  if (st == DYD_OK) st = dyd_pair_map_init(&c.map, out->vertices + 1);
  if (st == DYD_OK && out->polygon) {
    uint64_t m = out->vertices;
    if (m * (m - 1) / 2 > room + 3 * (uint64_t)tris)
      c.full = true;
    else
      st = all_pairs(&c);
  } else if (st == DYD_OK && !postponed) {
    st = w->run->keep_cut && dyd_work_cancelled(w) ? DYD_CANCELLED : closing_run(&c);
    if (st == DYD_OK) st = closing_collect(&c, c.map.links);
  }
  if (st == DYD_CANCELLED && w->run->keep_cut) {
    c.full = true;
    st = DYD_OK;
  }
  if (st == DYD_OK && (c.full || out->pairs > room)) st = skeleton_pairs(&c);
  bool sorted = out->polygon && !out->capped; /* all_pairs goes in order */
  if (st == DYD_OK && out->pairs && !sorted) qsort(out->pair, out->pairs, sizeof *out->pair, dyd_compare_vertex_pair);
  dyd_free_all(c.known_with, c.possible);
  dyd_pair_map_clear(&c.map);
  if (st != DYD_OK) dyd_closure_clear(out);
  return st;
}

void dyd_closure_clear(dyd_closure *c) {
  dyd_free_all(c->vertex, c->pair);
  memset(c, 0, sizeof *c);
}
