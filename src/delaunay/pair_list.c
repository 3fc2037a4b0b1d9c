/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* All possible pairs: as they are met, and as a sorted list.
 *
 * For the list, pairs are met in the skeleton's order. They are dealt into blocks of consecutive sites i, few enough to
 * be written side by side; a block is small enough for the nearer caches, and is sorted there: dealt to its sites, and
 * each site's pairs by j. Blocks are sorted side by side. */
#include "base/alloc.h"
#include "base/local.h"
#include "base/parallel.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "delaunay/undecided.h"

#include <string.h>

/* The certain triangles, sorted or in the order of the mesh, and their neighbours.
 *
 * To be sorted they are dealt to their lowest sites; a site has few. In the order of the mesh, which is near that of
 * the Hilbert curve, all that belongs to one triangle is near in memory, too. */

/* A certain triangle and its number in the mesh. */
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
  DYD_FREED uint32_t *start = dyd_alloc((size_t)pd->sk.n + 1, sizeof *start);
  if (!start) return DYD_E_NOMEM;
  count_starts(start, pd);
  *count = start[pd->sk.n];
  *out = dyd_alloc(*count, sizeof **out);
  if (*out) deal_all(*out, start, pd);
  return *out ? DYD_OK : DYD_E_NOMEM;
}

/* The number of every triangle of the mesh among the certain ones, sorted; DYD_NO_TRIANGLE: it is none. */
static dyd_status number_sorted(uint32_t *place, size_t *count, const dyd_delaunay *pd) {
  DYD_FREED dealt *all = NULL;
  dyd_status st = deal_triangles(&all, count, pd);
  if (st != DYD_OK) return st;
  if (pd->sk.mesh.count) memset(place, 0xff, pd->sk.mesh.count * sizeof *place);
  for (size_t k = 0; k < *count; k++) place[all[k].mesh] = (uint32_t)k;
  return DYD_OK;
}

/* The same in the order of the mesh. */
static dyd_status number_as_found(uint32_t *place, size_t *count, const dyd_delaunay *pd) {
  uint32_t found = 0;
  for (uint32_t t = 0; t < pd->sk.mesh.count; t++) place[t] = dyd_triangle_is_sure(pd, t) ? found++ : DYD_NO_TRIANGLE;
  *count = found;
  return DYD_OK;
}

/* Each begins at its lowest site. beyond: NULL, or for the triangles next to them. */
static void list_numbered(dyd_triangle *triangle, dyd_triangle *beyond, const uint32_t *place, const dyd_skeleton *sk) {
  for (uint32_t t = 0; t < sk->mesh.count; t++) {
    if (place[t] == DYD_NO_TRIANGLE) continue;
    unsigned corner = lowest_corner(sk, t);
    for (int q = 0; q < 3; q++, corner = dyd_next(corner)) {
      triangle[place[t]].v[q] = sk->reps.site[sk->mesh.tri[t].v[corner]];
      if (beyond) beyond[place[t]].v[q] = place[dyd_edge_triangle(dyd_edge_twin(&sk->mesh, dyd_edge_of(t, corner)))];
    }
  }
}

static uint64_t triangles_bytes(const dyd_delaunay *pd, bool neighbours) {
  uint64_t beyond = dyd_bytes_times(pd->sk.mesh.count, sizeof(dyd_triangle) + sizeof(uint32_t));
  return dyd_bytes_add(dyd_triangles_bytes(pd), neighbours ? beyond : 0);
}

dyd_status dyd_delaunay_triangles(dyd_triangle_list *out, dyd_triangle_list *neighbours, const dyd_delaunay *pd,
                                  unsigned flags) {
  DYD_FREED uint32_t *place = NULL;
  dyd_triangle_list found = {0}, beyond = {0};
  if (!pd || flags > DYD_TRIANGLES_AS_FOUND) return DYD_E_ARG;
  dyd_status st = DYD_OK;
  if (!flags) st = dyd_delaunay_grant(pd, triangles_bytes(pd, neighbours), "the list of triangles", NULL);
  if (st != DYD_OK) return st;
  if (!DYD_NEW(place, pd->sk.mesh.count)) return DYD_E_NOMEM;
  st = (flags ? number_as_found : number_sorted)(place, &found.count, pd);
  beyond.count = found.count;
  if (st == DYD_OK && (!DYD_NEW(found.item, found.count) || (neighbours && !DYD_NEW(beyond.item, beyond.count))))
    st = DYD_E_NOMEM;
  if (st == DYD_OK) {
    list_numbered(found.item, beyond.item, place, &pd->sk);
    dyd_triangle_list_clear(out);
    *out = found;
  } else
    dyd_triangle_list_clear(&found);
  if (st == DYD_OK && neighbours) {
    dyd_triangle_list_clear(neighbours);
    *neighbours = beyond;
  }
  return st;
}

/* A visit by vertices, passed on by sites. */
typedef struct site_visit {
  const uint32_t *site;
  dyd_pair_fn visit;
  void *user;
} site_visit;

static void visit_sites(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  const site_visit *s = context;
  uint32_t i = s->site[v], j = s->site[w];
  s->visit(s->user, i < j ? i : j, i < j ? j : i, status);
}

void dyd_delaunay_each_pair(const dyd_delaunay *pd, dyd_pair_fn visit, void *user) {
  if (!pd) return;
  site_visit s = {pd->sk.reps.site, visit, user};
  dyd_each_pair(pd, DYD_TIE, visit_sites, &s);
}

/* At most MOST_BLOCKS blocks; up to SHORT_RUN pairs are sorted by insertion, FEW by one thread. In the armed build few
 * sites need all. */
#ifdef DYD_ARMED
enum { MOST_BLOCKS = 4, SHORT_RUN = 4, PARTS = 2, FEW = 16 };
#else
enum { MOST_BLOCKS = 512, SHORT_RUN = 48, PARTS = 16, FEW = 1 << 16 };
#endif

/* One task, which sorts MOST_BLOCKS / PARTS blocks. */
typedef struct sort_part {
  dyd_pair *spare[2];
  size_t cap[2];
  size_t *start; /* of the sites of one block */
  dyd_status status;
} sort_part;

/* Invariant: end[b] is the place of the next pair of block b, sites b << shift and on. */
typedef struct pair_sort {
  const uint32_t *site; /* of a vertex */
  uint32_t n;
  unsigned shift;
  size_t end[MOST_BLOCKS + 1];
  dyd_pair *to;
  sort_part part[PARTS];
} pair_sort;

static void count_pair(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  pair_sort *s = context;
  uint32_t i = s->site[v], j = s->site[w];
  (void)status;
  s->end[(i < j ? i : j) >> s->shift]++;
}

static void place_pair(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  pair_sort *s = context;
  uint32_t i = s->site[v], j = s->site[w], low = i < j ? i : j, high = i < j ? j : i;
  s->to[s->end[low >> s->shift]++] = (dyd_pair){low, high, status};
}

/* Counts become the places where the runs start; returns the sum. */
static size_t starts_from_counts(size_t *start, size_t n) {
  size_t sum = 0;
  for (size_t i = 0; i < n; i++) {
    size_t c = start[i];
    start[i] = sum;
    sum += c;
  }
  return sum;
}

static void sort_short_run(dyd_pair *run, size_t count) {
  for (size_t q = 1; q < count; q++) {
    dyd_pair p = run[q];
    size_t r = q;
    for (; r && run[r - 1].j > p.j; r--) run[r] = run[r - 1];
    run[r] = p;
  }
}

/* By j: digits of 8 bits from the lowest one, to and fro between run and spare. */
static void sort_long_run(dyd_pair *run, dyd_pair *spare, size_t count, uint32_t n) {
  dyd_pair *from = run, *to = spare;
  for (unsigned shift = 0; shift < 32 && n >> shift; shift += 8) {
    size_t place[256] = {0};
    for (size_t q = 0; q < count; q++) place[from[q].j >> shift & 255]++;
    starts_from_counts(place, 256);
    for (size_t q = 0; q < count; q++) to[place[from[q].j >> shift & 255]++] = from[q];
    dyd_pair *swap = from;
    from = to;
    to = swap;
  }
  if (from != run) memcpy(run, from, count * sizeof *run);
}

static dyd_status sort_run(sort_part *p, dyd_pair *run, size_t count, uint32_t n) {
  if (count <= SHORT_RUN) {
    sort_short_run(run, count);
    return DYD_OK;
  }
  if (!DYD_GROW(p->spare[1], p->cap[1], count)) return DYD_E_NOMEM;
  sort_long_run(run, p->spare[1], count, n);
  return DYD_OK;
}

/* The pairs of block b. */
static dyd_status sort_block(sort_part *p, const pair_sort *s, dyd_pair *block, size_t count, size_t b) {
  size_t width = (size_t)1 << s->shift, low = b << s->shift;
  dyd_status st = DYD_OK;
  if (width == 1) return sort_run(p, block, count, s->n);
  if (!DYD_GROW(p->spare[0], p->cap[0], count)) return DYD_E_NOMEM;
  memcpy(p->spare[0], block, count * sizeof *block);
  memset(p->start, 0, width * sizeof *p->start);
  for (size_t q = 0; q < count; q++) p->start[p->spare[0][q].i - low]++;
  starts_from_counts(p->start, width);
  for (size_t q = 0; q < count; q++) block[p->start[p->spare[0][q].i - low]++] = p->spare[0][q];
  for (size_t i = 0, first = 0; i < width && st == DYD_OK; first = p->start[i++])
    st = sort_run(p, block + first, p->start[i] - first, s->n);
  return st;
}

/* Each end has moved on to the end of its block, where the next one begins. */
static void sort_part_of_blocks(void *context, size_t number) {
  pair_sort *s = context;
  sort_part *p = &s->part[number];
  size_t b = number * (MOST_BLOCKS / PARTS), first = b ? s->end[b - 1] : 0;
  p->start = dyd_alloc((size_t)1 << s->shift, sizeof *p->start);
  if (!p->start) p->status = DYD_E_NOMEM;
  for (; b < (number + 1) * (MOST_BLOCKS / PARTS) && p->status == DYD_OK; first = s->end[b++])
    if (s->end[b] > first) p->status = sort_block(p, s, s->to + first, s->end[b] - first, b);
  dyd_free_all(p->start, p->spare[0], p->spare[1]);
}

static dyd_status sort_blocks(pair_sort *s, unsigned threads) {
  dyd_status st = DYD_OK;
  dyd_parallel(threads, PARTS, sort_part_of_blocks, s);
  for (size_t k = 0; k < PARTS && st == DYD_OK; k++) st = s->part[k].status;
  return st;
}

dyd_status dyd_pairs_list(dyd_pair_list *out, const dyd_delaunay *pd, dyd_pair_status least) {
  pair_sort s = {.site = pd->sk.reps.site, .n = pd->sk.n};
  while (pd->sk.n && (pd->sk.n - 1) >> s.shift >= MOST_BLOCKS) s.shift++;
  dyd_each_pair(pd, least, count_pair, &s);
  size_t total = starts_from_counts(s.end, MOST_BLOCKS);
  if (!DYD_NEW(s.to, total)) return DYD_E_NOMEM;
  dyd_each_pair(pd, least, place_pair, &s);
  dyd_status st = sort_blocks(&s, total < FEW ? 1 : pd->options.threads);
  if (st != DYD_OK) {
    free(s.to);
    return st;
  }
  dyd_pair_list_clear(out);
  *out = (dyd_pair_list){total, s.to};
  return DYD_OK;
}

dyd_status dyd_pairs_take(dyd_pair_list *out, const dyd_delaunay *pd, dyd_pair_status least) {
  dyd_status st = DYD_OK;
  if (dyd_delaunay_is_bounded(pd)) st = dyd_delaunay_grant(pd, dyd_pairs_bytes(pd, least), "the list of pairs", NULL);
  return st == DYD_OK ? dyd_pairs_list(out, pd, least) : st;
}

dyd_status dyd_pairs_deal(size_t **start, uint32_t **partner, const dyd_pair_list *l, size_t n) {
  size_t *at = *start = calloc(n + 2, sizeof **start);
  *partner = dyd_alloc(2 * l->count, sizeof **partner);
  if (!at || !*partner) return DYD_E_NOMEM;
  for (size_t k = 0; k < l->count; k++) at[l->item[k].i + 2]++, at[l->item[k].j + 2]++;
  for (size_t i = 2; i <= n + 1; i++) at[i] += at[i - 1];
  for (size_t k = 0; k < l->count; k++) {
    (*partner)[at[l->item[k].i + 1]++] = l->item[k].j;
    (*partner)[at[l->item[k].j + 1]++] = l->item[k].i;
  }
  return DYD_OK;
}

dyd_status dyd_delaunay_pairs(dyd_pair_list *out, const dyd_delaunay *pd) {
  return pd ? dyd_pairs_take(out, pd, DYD_TIE) : DYD_E_ARG;
}
