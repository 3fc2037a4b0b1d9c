/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lists of edges, for comparing the answers of the contestants. */
#ifndef DYD_BENCH_EDGES_H
#define DYD_BENCH_EDGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Invariant: i < j. */
typedef struct bench_edge {
  uint32_t i, j;
} bench_edge;

/* Owned by the holder: init with {0}, release with bench_edges_clear. */
typedef struct bench_edges {
  size_t count;
  bench_edge *item;
} bench_edges;

void bench_edges_clear(bench_edges *e);
void bench_edges_sort(bench_edges *e);
/* How many edges of a are missing in b; both sorted. */
size_t bench_edges_missing(const bench_edges *a, const bench_edges *b);

#ifdef __cplusplus
}
#endif
#endif
