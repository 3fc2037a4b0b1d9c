/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sorting and comparing lists of edges. */
#include "edges.h"

#include <stdlib.h>

void bench_edges_clear(bench_edges *e) {
  free(e->item);
  *e = (bench_edges){0};
}

static int compare(const void *a, const void *b) {
  const bench_edge *x = a, *y = b;
  if (x->i != y->i) return x->i < y->i ? -1 : 1;
  return (x->j > y->j) - (x->j < y->j);
}

void bench_edges_sort(bench_edges *e) {
  if (e->count) qsort(e->item, e->count, sizeof *e->item, compare);
}

size_t bench_edges_missing(const bench_edges *a, const bench_edges *b) {
  size_t missing = 0;
  for (size_t i = 0, j = 0; i < a->count; i++) {
    while (j < b->count && compare(&b->item[j], &a->item[i]) < 0) j++;
    missing += j == b->count || compare(&b->item[j], &a->item[i]) != 0;
  }
  return missing;
}
