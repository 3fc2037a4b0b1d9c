/* SPDX-License-Identifier: LGPL-3.0-or-later */
#include "voronoi/grid_polygon.h"

#include "base/alloc.h"
#include <limits.h>
#include <stdlib.h>

bool dyd_grid_align(dyd_grid_polygon *p) {
  int scale = INT_MIN;
  bool fits = true;
  for (size_t k = 0; k < p->count; k++)
    if (p->vertex[k].scale > scale) scale = p->vertex[k].scale;
  for (size_t k = 0; k < p->count; k++) {
    dyd_grid_point *z = &p->vertex[k];
    int up = scale - z->scale;
    for (int a = 0; a < 2; a++) {
      if (up > DYD_GRID_BITS || llabs(z->at[a]) >> (DYD_GRID_BITS + 2 - up)) fits = false;
      if (fits) z->at[a] = (int64_t)((uint64_t)z->at[a] << up);
    }
    z->scale = scale;
  }
  return fits;
}

/* Twice the area of a, b, c, with its sign. */
static dyd_i128 grid_turn(const dyd_grid_point *a, const dyd_grid_point *b, const dyd_grid_point *c) {
  return (dyd_i128)(b->at[0] - a->at[0]) * (c->at[1] - a->at[1]) -
         (dyd_i128)(b->at[1] - a->at[1]) * (c->at[0] - a->at[0]);
}

static int compare_grid(const void *a, const void *b) {
  const dyd_grid_point *p = a, *q = b;
  for (int k = 0; k < 2; k++)
    if (p->at[k] != q->at[k]) return p->at[k] < q->at[k] ? -1 : 1;
  return 0;
}

static size_t grid_extend(dyd_grid_point *chain, size_t kept, size_t floor, dyd_grid_point z) {
  while (kept >= floor + 2 && grid_turn(&chain[kept - 2], &chain[kept - 1], &z) <= 0) kept--;
  chain[kept++] = z;
  return kept;
}

/* The hull is made behind the vertices, where there is room. */
dyd_status dyd_grid_make_convex(dyd_grid_polygon *p) {
  size_t n = p->count, kept = 0;
  if (!dyd_reserve((void **)&p->vertex, &p->cap, 3 * n + 1, sizeof *p->vertex)) return DYD_E_NOMEM;
  dyd_grid_point *z = p->vertex, *chain = z + n;
  qsort(z, n, sizeof *z, compare_grid);
  for (size_t k = 0; k < n; k++) kept = grid_extend(chain, kept, 0, z[k]);
  size_t floor = kept ? kept - 1 : 0;
  for (size_t k = n; k-- > 1;) kept = grid_extend(chain, kept, floor, z[k - 1]);
  kept = kept ? kept - 1 : 0;
  p->count = kept >= 3 ? kept : 0;
  for (size_t k = 0; k < p->count; k++) z[k] = chain[k];
  return DYD_OK;
}

static int64_t min64(int64_t a, int64_t b) {
  return a < b ? a : b;
}

/* Do the closed boxes of the edges from a and from c meet? */
static bool grid_edges_near(const dyd_grid_point *a, const dyd_grid_point *b, const dyd_grid_point *c,
                            const dyd_grid_point *d) {
  for (int k = 0; k < 2; k++)
    if (-min64(-a->at[k], -b->at[k]) < min64(c->at[k], d->at[k]) ||
        -min64(-c->at[k], -d->at[k]) < min64(a->at[k], b->at[k]))
      return false;
  return true;
}

bool dyd_grid_is_simple(bool *known, const dyd_grid_polygon *p) {
  const dyd_grid_point *z = p->vertex;
  size_t n = p->count;
  for (size_t j = 0; j < n; j++) {
    const dyd_grid_point *c = &z[j], *d = &z[j + 1 == n ? 0 : j + 1];
    if (!grid_turn(c, d, &z[(j + 2) % n])) *known = false;
    for (size_t i = 0; i + 1 < j; i++) {
      const dyd_grid_point *a = &z[i], *b = &z[i + 1];
      if ((j + 1 == n && i == 0) || !grid_edges_near(a, b, c, d)) continue;
      dyd_i128 s = grid_turn(a, b, c), t = grid_turn(a, b, d), u = grid_turn(c, d, a), v = grid_turn(c, d, b);
      if (!s || !t || !u || !v) *known = false;
      if ((s < 0) != (t < 0) && (u < 0) != (v < 0)) return false;
    }
  }
  return n >= 3;
}

void dyd_grid_drop_repeats(dyd_grid_polygon *p) {
  size_t kept = 0, n = p->count;
  for (size_t k = 0; k < n; k++)
    if (n == 1 || compare_grid(&p->vertex[k], &p->vertex[kept ? kept - 1 : n - 1])) p->vertex[kept++] = p->vertex[k];
  p->count = kept;
}

dyd_i128 dyd_grid_area2(const dyd_grid_polygon *p) {
  dyd_i128 sum = 0;
  for (size_t k = 1; k + 1 < p->count; k++) sum += grid_turn(&p->vertex[0], &p->vertex[k], &p->vertex[k + 1]);
  return sum;
}
