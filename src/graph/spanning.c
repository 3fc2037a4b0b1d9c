/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The minimum spanning tree, by the least and the largest length of each pair [MST-1].
 *
 * never   legal pairs that are surely shorter join i and j, or ij is never an edge of the Gabriel graph
 * sure    other pairs, not among those, that may be as short do not join i and j: the bottleneck between i and j by
 *         least lengths is in the spanning tree by least lengths, or, where ij is in that itself, the first pair that
 *         closes a circle with it; or j is surely the nearest one to i, or i to j */
#include "base/alloc.h"
#include "base/flag.h"
#include "graph/lengths.h"

/* Sets of sites; a set's `at` is its top in the tree. */
typedef struct span_sets {
  uint32_t *up;
} span_sets;

static uint32_t set_of(span_sets *s, uint32_t i) {
  while (s->up[i] != i) {
    s->up[i] = s->up[s->up[i]];
    i = s->up[i];
  }
  return i;
}

static void sets_begin(span_sets *s, size_t n) {
  for (size_t i = 0; i < n; i++) s->up[i] = (uint32_t)i;
}

enum { SPAN_NONE = UINT32_MAX };

/* least, largest: of all pairs, sorted. nearest: who is surely that to each site; SPAN_NONE: nobody. replaced: by pair,
 * the number in least[] of the first pair that closes a circle with it, where it is in the tree; SPAN_NONE: none. tree:
 * is it? Neither counts pairs that are in no minimum spanning tree. */
typedef struct span_work {
  dyd_graph_work *w;
  dyd_length *least, *largest;
  uint32_t *replaced, *nearest;
  bool *tree, *never;
  span_sets sets;
  /* the tree by least lengths: towards the root */
  uint32_t *parent, *link, *depth;
  size_t *start;
  uint32_t *edge; /* pairs of the tree at each site */
} span_work;

/* Sorting lengths may take as much again as one list of them. */
static bool span_has_room(const span_work *s) {
  uint64_t pair = 3 * sizeof *s->least + sizeof *s->replaced + sizeof *s->tree + sizeof *s->never;
  uint64_t site = 7 * sizeof(uint32_t) + sizeof *s->start;
  uint64_t bytes = dyd_bytes_times(s->w->pairs.count, pair) + dyd_bytes_times(s->w->n, site);
  return dyd_room_has(&s->w->room, bytes, "the spanning tree");
}

static bool span_alloc(span_work *s) {
  size_t n = s->w->n, pairs = s->w->pairs.count;
  s->least = dyd_alloc(pairs, sizeof *s->least);
  s->largest = dyd_alloc(pairs, sizeof *s->largest);
  s->replaced = dyd_alloc(pairs, sizeof *s->replaced);
  s->nearest = dyd_alloc(n, sizeof *s->nearest);
  s->tree = calloc(pairs + 1, sizeof *s->tree);
  s->never = calloc(pairs + 1, sizeof *s->never);
  s->sets.up = dyd_alloc(n, sizeof *s->sets.up);
  s->parent = dyd_alloc(n, sizeof *s->parent);
  s->link = dyd_alloc(n, sizeof *s->link);
  s->depth = dyd_alloc(n, sizeof *s->depth);
  s->start = calloc(n + 2, sizeof *s->start);
  s->edge = dyd_alloc(2 * n, sizeof *s->edge);
  return s->least && s->largest && s->replaced && s->nearest && s->tree && s->never && s->sets.up && s->parent &&
         s->link && s->depth && s->start && s->edge;
}

static void spanning_work_clear(span_work *s) {
  free(s->least);
  free(s->largest);
  free(s->replaced);
  free(s->nearest);
  free(s->tree);
  free(s->never);
  free(s->sets.up);
  free(s->parent);
  free(s->link);
  free(s->depth);
  free(s->start);
  free(s->edge);
}

static void sort_lengths(span_work *s) {
  size_t pairs = s->w->pairs.count;
  for (uint32_t p = 0; p < pairs; p++) {
    s->least[p] = dyd_filter_length(s->w, p, false);
    s->largest[p] = dyd_filter_length(s->w, p, true);
  }
  qsort(s->least, pairs, sizeof *s->least, dyd_length_order);
  qsort(s->largest, pairs, sizeof *s->largest, dyd_length_order);
}

/* Legal pairs stay legal, so what they join stays joined when rectangles shrink. */
static void find_never(span_work *s) {
  const dyd_pair *pair = s->w->pairs.item;
  size_t next = 0;
  sets_begin(&s->sets, s->w->n);
  for (size_t q = 0; q < s->w->pairs.count; q++) {
    for (; next < s->w->pairs.count && dyd_length_compare(&s->largest[next], &s->least[q]) < 0; next++) {
      const dyd_pair *p = &pair[s->largest[next].pair];
      if (p->status == DYD_LEGAL) s->sets.up[set_of(&s->sets, p->i)] = set_of(&s->sets, p->j);
    }
    const dyd_pair *p = &pair[s->least[q].pair];
    s->never[s->least[q].pair] = set_of(&s->sets, p->i) == set_of(&s->sets, p->j);
  }
}

static dyd_status find_never_gabriel(span_work *s) {
  const dyd_pair *pair = s->w->pairs.item;
  dyd_status st = DYD_OK;
  for (size_t p = 0; p < s->w->pairs.count && st == DYD_OK; p++) {
    dyd_graph_status status;
    if (s->never[p]) continue;
    st = dyd_flag_is_set(s->w->cancel) ? DYD_CANCELLED : dyd_gabriel_status(&status, s->w, pair[p].i, pair[p].j);
    s->never[p] = st == DYD_OK && status == DYD_GRAPH_NEVER;
  }
  return st;
}

static void find_tree(span_work *s) {
  sets_begin(&s->sets, s->w->n);
  for (size_t q = 0; q < s->w->pairs.count; q++) {
    const dyd_pair *p = &s->w->pairs.item[s->least[q].pair];
    if (s->never[s->least[q].pair]) continue;
    uint32_t a = set_of(&s->sets, p->i), b = set_of(&s->sets, p->j);
    s->tree[s->least[q].pair] = a != b;
    s->sets.up[a] = b;
  }
}

/* The pairs of the tree at each site. */
static void deal_tree(span_work *s) {
  const dyd_pair *pair = s->w->pairs.item;
  for (size_t p = 0; p < s->w->pairs.count; p++) {
    if (!s->tree[p]) continue;
    s->start[pair[p].i + 2]++;
    s->start[pair[p].j + 2]++;
  }
  for (size_t i = 2; i <= s->w->n + 1; i++) s->start[i] += s->start[i - 1];
  for (uint32_t p = 0; p < s->w->pairs.count; p++) {
    if (!s->tree[p]) continue;
    s->edge[s->start[pair[p].i + 1]++] = p;
    s->edge[s->start[pair[p].j + 1]++] = p;
  }
}

/* Hangs every tree on one of its sites. `queue`: room for all. */
static void root_trees(span_work *s, uint32_t *queue) {
  size_t head = 0, tail = 0;
  for (uint32_t i = 0; i < s->w->n; i++) s->parent[i] = SPAN_NONE;
  for (uint32_t i = 0; i < s->w->n; i++) {
    if (s->parent[i] != SPAN_NONE) continue;
    s->parent[i] = i, s->depth[i] = 0, s->link[i] = SPAN_NONE;
    for (queue[tail++] = i; head < tail; head++) {
      uint32_t v = queue[head];
      for (size_t k = s->start[v]; k < s->start[v + 1]; k++) {
        const dyd_pair *p = &s->w->pairs.item[s->edge[k]];
        uint32_t other = p->i == v ? p->j : p->i;
        if (s->parent[other] != SPAN_NONE) continue;
        s->parent[other] = v, s->depth[other] = s->depth[v] + 1, s->link[other] = s->edge[k];
        queue[tail++] = other;
      }
    }
  }
}

/* The other pairs, shortest first: each is the first around the links of the tree between its ends that none was
 * around before; those are passed over from then on. */
static void find_replacements(span_work *s) {
  for (size_t p = 0; p < s->w->pairs.count; p++) s->replaced[p] = SPAN_NONE;
  sets_begin(&s->sets, s->w->n);
  for (size_t q = 0; q < s->w->pairs.count; q++) {
    const dyd_pair *p = &s->w->pairs.item[s->least[q].pair];
    if (s->tree[s->least[q].pair] || s->never[s->least[q].pair]) continue;
    uint32_t a = set_of(&s->sets, p->i), b = set_of(&s->sets, p->j);
    while (a != b) {
      uint32_t *lower = s->depth[a] >= s->depth[b] ? &a : &b;
      s->replaced[s->link[*lower]] = (uint32_t)q;
      s->sets.up[*lower] = s->parent[*lower];
      *lower = set_of(&s->sets, *lower);
    }
  }
}

static bool is_surely_shortest(const span_work *s, uint32_t p) {
  if (!s->tree[p]) return false;
  dyd_length own = dyd_filter_length(s->w, p, true);
  return s->replaced[p] == SPAN_NONE || dyd_length_compare(&own, &s->least[s->replaced[p]]) < 0;
}

/* Who is surely nearest to each site. */
static dyd_status find_sure_nearest(span_work *s) {
  dyd_graph_list *l = &s->w->out;
  dyd_status st = dyd_nearest_graph(s->w);
  for (size_t i = 0; i < s->w->n; i++) s->nearest[i] = SPAN_NONE;
  for (size_t k = 0; k < l->count; k++)
    if (l->item[k].sure) s->nearest[l->item[k].i] = l->item[k].j;
  l->count = 0;
  return st;
}

static dyd_status span_pair(const span_work *s, uint32_t number) {
  uint32_t i = s->w->pairs.item[number].i, j = s->w->pairs.item[number].j;
  if (s->never[number]) return DYD_OK;
  return dyd_graph_add(s->w, i, j, s->nearest[i] == j || s->nearest[j] == i || is_surely_shortest(s, number));
}

dyd_status dyd_spanning_graph(dyd_graph_work *w) {
  span_work s = {.w = w};
  dyd_status st = span_has_room(&s) && span_alloc(&s) ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) {
    sort_lengths(&s);
    find_never(&s);
    st = find_never_gabriel(&s);
  }
  if (st == DYD_OK) {
    find_tree(&s);
    deal_tree(&s);
    root_trees(&s, s.sets.up);
    find_replacements(&s);
    st = find_sure_nearest(&s);
  }
  for (uint32_t p = 0; p < w->pairs.count && st == DYD_OK; p++) st = span_pair(&s, p);
  spanning_work_clear(&s);
  return st;
}
