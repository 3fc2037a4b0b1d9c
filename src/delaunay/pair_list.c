/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* All possible pairs: as they are met, and as a sorted list.
 *
 * For the list, pairs are met in the skeleton's order. They are dealt into blocks of consecutive sites i, few enough to
 * be written side by side; a block is small enough for the nearer caches, and is sorted there: dealt to its sites, and
 * each site's pairs by j. Blocks are sorted side by side. */
#include "base/alloc.h"
#include "base/parallel.h"
#include "delaunay/memory.h"
#include "delaunay/undecided.h"

#include <string.h>

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

/* Who sorts MOST_BLOCKS / PARTS blocks. */
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
  if (!dyd_reserve((void **)&p->spare[1], &p->cap[1], count, sizeof *p->spare[1])) return DYD_E_NOMEM;
  sort_long_run(run, p->spare[1], count, n);
  return DYD_OK;
}

/* The pairs of block b. */
static dyd_status sort_block(sort_part *p, const pair_sort *s, dyd_pair *block, size_t count, size_t b) {
  size_t width = (size_t)1 << s->shift, low = b << s->shift;
  dyd_status st = DYD_OK;
  if (width == 1) return sort_run(p, block, count, s->n);
  if (!dyd_reserve((void **)&p->spare[0], &p->cap[0], count, sizeof *p->spare[0])) return DYD_E_NOMEM;
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
  free(p->start);
  free(p->spare[0]);
  free(p->spare[1]);
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
  s.to = dyd_alloc(total, sizeof *s.to);
  if (!s.to) return DYD_E_NOMEM;
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

dyd_status dyd_delaunay_pairs(dyd_pair_list *out, const dyd_delaunay *pd) {
  return pd ? dyd_pairs_take(out, pd, DYD_TIE) : DYD_E_ARG;
}
