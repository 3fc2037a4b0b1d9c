/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading shapes: sure triangles, the hull, witnesses. */
#include "base/alloc.h"
#include "delaunay/build.h"
#include "legal/certify.h"
#include "legal/witness.h"

#include <math.h>
#include <string.h>

static int compare_triangle(const void *a, const void *b) {
  const dyd_triangle *x = a, *y = b;
  for (int k = 0; k < 3; k++)
    if (x->v[k] != y->v[k]) return x->v[k] < y->v[k] ? -1 : 1;
  return 0;
}

/* Three legal edges around a face of the skeleton: a point that entered the triangle would first lie on an edge. */
static bool is_sure(const dyd_delaunay *pd, uint32_t t) {
  return (pd->certain[t] & 7) == 7 && !dyd_mesh_is_ghost(&pd->mesh, t);
}

dyd_status dyd_delaunay_triangles(dyd_triangle_list *out, const dyd_delaunay *pd) {
  size_t count = 0;
  for (uint32_t t = 0; t < pd->mesh.count; t++) count += is_sure(pd, t);
  dyd_triangle *item = dyd_alloc(count, sizeof *item);
  if (!item) return DYD_E_NOMEM;
  count = 0;
  for (uint32_t t = 0; t < pd->mesh.count; t++) {
    if (!is_sure(pd, t)) continue;
    uint32_t s[3];
    for (int k = 0; k < 3; k++) s[k] = pd->reps.site[pd->mesh.tri[t].v[k]];
    unsigned low = s[0] < s[1] ? (s[0] < s[2] ? 0 : 2) : (s[1] < s[2] ? 1 : 2);
    item[count++] = (dyd_triangle){{s[low], s[dyd_next(low)], s[dyd_prev(low)]}};
  }
  if (count) qsort(item, count, sizeof *item, compare_triangle);
  dyd_triangle_list_clear(out);
  *out = (dyd_triangle_list){count, item};
  return DYD_OK;
}

/* A ghost triangle, and its edges around the ghost. */
static uint32_t any_ghost(const dyd_mesh *m, unsigned *slot) {
  for (uint32_t t = 0; t < m->count; t++)
    for (unsigned k = 0; k < 3; k++)
      if (m->tri[t].v[k] == m->n) return *slot = k, t;
  return DYD_NONE;
}

static dyd_status line_ends(dyd_index_list *out, const dyd_delaunay *pd) {
  uint32_t ends = pd->line.count < 2 ? pd->line.count : 2;
  uint32_t *item = dyd_alloc(ends, sizeof *item);
  if (!item) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < ends; q++) item[q] = pd->reps.site[pd->line.order[q ? pd->line.count - 1 : 0]];
  dyd_index_list_clear(out);
  *out = (dyd_index_list){ends, item};
  return DYD_OK;
}

dyd_status dyd_delaunay_hull(dyd_index_list *out, const dyd_delaunay *pd) {
  const dyd_mesh *m = &pd->mesh;
  if (m->collinear) return line_ends(out, pd);
  unsigned slot = 0;
  uint32_t t = any_ghost(m, &slot), first = 4 * t + slot, h = first;
  size_t count = 0, cap = 0;
  uint32_t *item = NULL;
  do { /* counter-clockwise around the ghost is clockwise around the hull */
    if (!dyd_reserve((void **)&item, &cap, count + 1, sizeof *item)) return free(item), DYD_E_NOMEM;
    item[count++] = pd->reps.site[m->tri[h >> 2].v[dyd_next(h & 3)]];
    h = dyd_turn(m, h);
  } while (h != first);
  for (size_t q = 0; q < count / 2; q++) {
    uint32_t s = item[q];
    item[q] = item[count - 1 - q];
    item[count - 1 - q] = s;
  }
  dyd_index_list_clear(out);
  *out = (dyd_index_list){count, item};
  return DYD_OK;
}

/* ---- witnesses ---- */

static void add_item(dyd_delaunay *view, uint32_t *item, uint32_t *count, uint32_t v) {
  dyd_sites_get_d(view->box[v].e, view->sites, view->reps.site[v]);
  item[(*count)++] = v;
}

/* The other ends of v's edges. */
static void add_star(dyd_delaunay *view, uint32_t *item, uint32_t *count, uint32_t v) {
  uint32_t first = view->corner[v], h = first;
  do {
    uint32_t w = view->mesh.tri[h >> 2].v[dyd_next(h & 3)];
    if (w != view->mesh.n) add_item(view, item, count, w);
    h = dyd_turn(&view->mesh, h);
  } while (h != first);
}

static uint32_t degree(const dyd_delaunay *pd, uint32_t v) {
  uint32_t first = pd->corner[v], h = first, count = 0;
  do count++;
  while ((h = dyd_turn(&pd->mesh, h)) != first);
  return count;
}

/* Exact points have no boxes of their own. For a centre nearer to i and j than to all their Delaunay neighbours nobody
 * else is nearer (see [FLT-STAR]), so a tree over these neighbours will do; on a line, one over all. */
static dyd_status make_view(dyd_delaunay *view, const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  bool line = pd->mesh.collinear;
  size_t size = line ? pd->line.count : (size_t)degree(pd, v) + degree(pd, w) + 2;
  *view = *pd;
  view->box = dyd_alloc(pd->n, sizeof *view->box);
  uint32_t *item = dyd_alloc(size, sizeof *item), count = 0;
  if (!view->box || !item) return free(view->box), free(item), DYD_E_NOMEM;
  if (line) {
    for (uint32_t q = 0; q < pd->line.count; q++) add_item(view, item, &count, pd->line.order[q]);
  } else {
    add_item(view, item, &count, v);
    add_item(view, item, &count, w);
    add_star(view, item, &count, v);
    add_star(view, item, &count, w);
  }
  dyd_status st = dyd_tree_init(&view->tree, item, count, view->box);
  if (st != DYD_OK) {
    free(view->box);
    dyd_tree_clear(&view->tree);
  }
  return st;
}

static dyd_status find_witness(dyd_point *out, const dyd_delaunay *pd, uint32_t v, uint32_t w, dyd_xy guess) {
  bool found;
  dyd_status st = dyd_witness_search(&found, out, pd, v, w, guess, NULL);
  if (st == DYD_OK && !found) {
    dyd_work work;
    dyd_work_init(&work, pd);
    st = dyd_witness_far(&found, out, &work, pd, v, w);
    dyd_work_clear(&work);
  }
  return st == DYD_OK && !found ? DYD_E_RANGE : st;
}

dyd_status dyd_delaunay_witness(dyd_point *out, const dyd_delaunay *pd, uint32_t i, uint32_t j) {
  if (dyd_delaunay_status(pd, i, j) != DYD_LEGAL) return DYD_E_ARG;
  uint32_t v = pd->vertex[i], w = pd->vertex[j];
  dyd_xy guess = {NAN, NAN};
  if (!pd->mesh.collinear) {
    uint32_t h = dyd_find_edge(pd, v, w);
    guess = dyd_edge_centre(pd, h >> 2, dyd_prev(h & 3));
  }
  if (pd->box) return find_witness(out, pd, v, w, guess);
  dyd_delaunay view;
  dyd_status st = make_view(&view, pd, v, w);
  if (st != DYD_OK) return st;
  st = find_witness(out, &view, v, w, guess);
  dyd_tree_clear(&view.tree);
  free(view.box);
  return st;
}
