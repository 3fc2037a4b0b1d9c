/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The tree over own sites. */
#include "tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAF = 32 };

typedef struct tree_maker {
  tiles_tree *t;
  const tiles_sites *s;
  unsigned along; /* which coordinate is compared: 0 x, 1 y */
} tree_maker;

static double key_of(const tree_maker *m, size_t k) {
  const double *e = m->s->end + m->t->order[k] * (size_t)m->s->dim;
  return e[m->along * (m->s->dim / 2)];
}

static void swap_order(uint32_t *order, size_t a, size_t b) {
  uint32_t kept = order[a];
  order[a] = order[b];
  order[b] = kept;
}

/* Puts order[lo .. hi] such that nobody before `at` has a larger key than anybody from there on (Hoare's selection). */
static void tree_select(const tree_maker *m, ptrdiff_t lo, ptrdiff_t hi, ptrdiff_t at) {
  while (lo < hi) {
    double pivot = key_of(m, (size_t)at);
    ptrdiff_t i = lo, j = hi;
    while (i <= j) {
      while (key_of(m, (size_t)i) < pivot) i++;
      while (key_of(m, (size_t)j) > pivot) j--;
      if (i <= j) swap_order(m->t->order, (size_t)i++, (size_t)j--);
    }
    if (j < at) lo = i;
    if (at < i) hi = j;
  }
}

static tiles_box box_of_range(const tree_maker *m, size_t lo, size_t hi) {
  tiles_box all = tiles_box_empty();
  for (size_t k = lo; k < hi; k++) {
    tiles_box b = tiles_sites_box(m->s, m->t->order[k]);
    tiles_box_join(&all, &b);
  }
  return all;
}

static void tree_node(tree_maker *m, size_t node, size_t lo, size_t hi) {
  tiles_box *box = &m->t->box[node];
  *box = box_of_range(m, lo, hi);
  if (hi - lo <= LEAF) return;
  size_t middle = lo + (hi - lo) / 2;
  m->along = tiles_box_is_tall(box);
  tree_select(m, (ptrdiff_t)lo, (ptrdiff_t)hi - 1, (ptrdiff_t)middle);
  tree_node(m, 2 * node, lo, middle);
  tree_node(m, 2 * node + 1, middle, hi);
}

bool tiles_tree_make(tiles_tree *t, const tiles_sites *s) {
  size_t nodes = 2;
  for (size_t n = s->count; n > LEAF; n = (n + 1) / 2) nodes *= 2;
  *t = (tiles_tree){.count = s->count};
  if (s->count == 0) return true;
  t->order = malloc(s->count * sizeof *t->order);
  t->box = malloc(nodes * sizeof *t->box);
  if (!t->order || !t->box) return false;
  for (size_t k = 0; k < s->count; k++) t->order[k] = (uint32_t)k;
  tree_maker m = {t, s, 0};
  tree_node(&m, 1, 0, s->count);
  return true;
}

void tiles_tree_clear(tiles_tree *t) {
  free(t->order);
  free(t->box);
  *t = (tiles_tree){0};
}

/* ---- searching ---- */

static bool is_too_late(const tiles_search *q, double score) {
  return score == INFINITY || (q->count == q->most && score >= q->score[q->count - 1]);
}

static bool search_take(tiles_search *q, uint32_t site, double score) {
  if (q->count < q->most) {
    if (!tiles_reserve((void **)&q->site, &q->room_site, q->count + 1, sizeof *q->site)) return false;
    if (!tiles_reserve((void **)&q->score, &q->room_score, q->count + 1, sizeof *q->score)) return false;
    q->count++;
  }
  size_t at = q->count - 1;
  for (; at > 0 && q->score[at - 1] > score; at--) {
    q->score[at] = q->score[at - 1];
    q->site[at] = q->site[at - 1];
  }
  q->site[at] = site;
  q->score[at] = score;
  return true;
}

static bool search_node(tiles_search *q, const tiles_tree *t, const tiles_sites *s, size_t node, size_t lo, size_t hi) {
  if (is_too_late(q, tiles_disc_score(q->disc, &t->box[node]))) return true;
  if (hi - lo > LEAF) {
    size_t middle = lo + (hi - lo) / 2;
    return search_node(q, t, s, 2 * node, lo, middle) && search_node(q, t, s, 2 * node + 1, middle, hi);
  }
  for (size_t k = lo; k < hi; k++) {
    if (tiles_set_has(q->skip, t->order[k]) || (q->alias && q->alias[t->order[k]])) continue;
    tiles_box b = tiles_sites_box(s, t->order[k]);
    double score = tiles_disc_score(q->disc, &b);
    if (!is_too_late(q, score) && !search_take(q, t->order[k], score)) return false;
  }
  return true;
}

bool tiles_tree_search(tiles_search *q, const tiles_tree *t, const tiles_sites *s) {
  q->count = 0;
  return t->count == 0 || search_node(q, t, s, 1, 0, t->count);
}

void tiles_search_clear(tiles_search *q) {
  free(q->site);
  free(q->score);
  *q = (tiles_search){.disc = q->disc};
}
