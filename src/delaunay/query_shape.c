/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading shapes: the hull, witnesses. */

#include "base/alloc.h"
#include "delaunay/state.h"
#include "legal/witness.h"
#include "skeleton/centre_filter.h"

#include <math.h>

static dyd_status line_ends(dyd_index_list *out, const dyd_skeleton *sk) {
  const dyd_line *l = &sk->line;
  uint32_t ends = l->count < 2 ? l->count : 2;
  uint32_t *item = dyd_alloc(ends, sizeof *item);
  if (!item) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < ends; q++) item[q] = sk->reps.site[l->order[q ? l->count - 1 : 0]];
  dyd_index_list_clear(out);
  *out = (dyd_index_list){ends, item};
  return DYD_OK;
}

dyd_status dyd_delaunay_hull(dyd_index_list *out, const dyd_delaunay *pd) {
  if (!pd) return DYD_E_ARG;
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_half_edge last = dyd_hull_first(m), h = last;
  size_t count = 0, cap = 0;
  uint32_t *item = NULL;
  if (last == DYD_NONE) return line_ends(out, &pd->sk);
  do {
    h = dyd_hull_following(m, h);
    if (!dyd_reserve((void **)&item, &cap, count + 1, sizeof *item)) return free(item), DYD_E_NOMEM;
    item[count++] = pd->sk.reps.site[dyd_hull_target(m, h)];
  } while (h != last);
  dyd_index_list_clear(out);
  *out = (dyd_index_list){count, item};
  return DYD_OK;
}

/* ---- witnesses ---- */

static uint32_t degree(const dyd_skeleton *sk, uint32_t v) {
  dyd_half_edge first = sk->leaving[v], h = first;
  uint32_t count = 0;
  do count++;
  while ((h = dyd_edge_turn(&sk->mesh, h)) != first);
  return count;
}

/* v and the other ends of its edges. */
static void add_star(dyd_rects *few, uint32_t *item, uint32_t *count, const dyd_skeleton *sk, uint32_t v) {
  dyd_half_edge first = sk->leaving[v], h = first;
  dyd_rects_set_box(few, item[(*count)++] = v);
  do {
    uint32_t w = dyd_edge_target(&sk->mesh, h);
    if (w != sk->mesh.n) dyd_rects_set_box(few, item[(*count)++] = w);
    h = dyd_edge_turn(&sk->mesh, h);
  } while (h != first);
}

/* Exact points have no boxes of their own. For a centre nearer to i and j than to all their Delaunay neighbours nobody
 * else is nearer (see [FLT-STAR]), so a tree over these neighbours will do; on a line, one over all. */
static dyd_status few_rects(dyd_rects *few, const dyd_skeleton *sk, uint32_t v, uint32_t w) {
  bool line = sk->mesh.count == 0;
  size_t size = line ? sk->line.count : (size_t)degree(sk, v) + degree(sk, w) + 2;
  uint32_t *item = dyd_alloc(size, sizeof *item), count = 0;
  *few = (dyd_rects){.sites = sk->rects.sites, .site = sk->rects.site};
  few->box = dyd_alloc(sk->n, sizeof *few->box);
  if (!few->box || !item) return free(item), DYD_E_NOMEM;
  for (uint32_t q = 0; line && q < size; q++) dyd_rects_set_box(few, item[count++] = sk->line.order[q]);
  if (!line) {
    add_star(few, item, &count, sk, v);
    add_star(few, item, &count, sk, w);
  }
  return dyd_tree_init(&few->tree, item, count, few->box);
}

static dyd_status find_witness(dyd_point *out, dyd_work *work, const dyd_skeleton *sk, uint32_t v, uint32_t w) {
  dyd_half_edge h = dyd_find_edge(sk, v, w);
  dyd_xy guess = h == DYD_NONE ? (dyd_xy){NAN, NAN} : dyd_edge_centre(sk, h);
  bool found;
  dyd_status st = dyd_witness_search(&found, out, work, sk, v, w, guess, NULL);
  if (st == DYD_OK && !found) st = dyd_witness_far(&found, out, work, sk, v, w);
  return st == DYD_OK && !found ? DYD_E_RANGE : st;
}

dyd_status dyd_delaunay_witness(dyd_point *out, const dyd_delaunay *pd, uint32_t i, uint32_t j) {
  if (!pd) return DYD_E_ARG;
  if (dyd_delaunay_status(pd, i, j) != DYD_LEGAL) return DYD_E_ARG;
  const dyd_skeleton *sk = &pd->sk;
  uint32_t v = sk->vertex[i], w = sk->vertex[j];
  dyd_rects few = {0};
  dyd_work work;
  dyd_status st = sk->rects.box ? DYD_OK : few_rects(&few, sk, v, w);
  dyd_work_init(&work, sk, NULL);
  if (few.box) work.rects = &few;
  if (st == DYD_OK) st = find_witness(out, &work, sk, v, w);
  dyd_work_clear(&work);
  dyd_tree_clear(&few.tree);
  free(few.box);
  return st;
}
