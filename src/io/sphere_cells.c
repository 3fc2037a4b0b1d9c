/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Voronoi cells on the sphere as lists of vertices.
 *
 * Around a place i, counter-clockwise, the triangle (i, a, b) is followed by (i, b, c). So its triangles, sorted by a,
 * are walked by looking up b; a walk that ends has an undecided region behind its end. */
#include "io/sphere_cells.h"

#include "base/alloc.h"

/* Triangle `node` seen from a corner: the next corners are a, b. */
typedef struct corner_view {
  uint32_t at, a, b, node;
  bool has_before, used;
} corner_view;

void dyd_sphere_cells_clear(dyd_sphere_cells *c) {
  free(c->node);
  free(c->first);
  free(c->of);
  free(c->gap);
  free(c->closed);
  *c = (dyd_sphere_cells){0};
}

static int compare_views(const void *p, const void *q) {
  const corner_view *x = p, *y = q;
  if (x->at != y->at) return x->at < y->at ? -1 : 1;
  return (x->a > y->a) - (x->a < y->a);
}

static corner_view *view_find(corner_view *view, size_t count, uint32_t at, uint32_t a) {
  const corner_view key = {.at = at, .a = a};
  return count ? bsearch(&key, view, count, sizeof key, compare_views) : NULL;
}

/* Lists the chain from `from` on; returns how many, and whether it came back. */
static size_t nodes_walk(bool *cycle, dyd_sphere_cells *c, size_t n, corner_view *view, size_t count,
                         corner_view *from) {
  corner_view *v = from;
  size_t begin = n;
  for (; v && !v->used; v = view_find(view, count, v->at, v->b)) {
    v->used = true;
    c->gap[n] = false;
    c->of[n++] = v->node;
  }
  *cycle = v == from;
  c->gap[begin] = !*cycle;
  return n;
}

/* The cell seen in view[0 .. count-1]: chains that have a beginning first, then what is a cycle. */
static size_t cell_walk(dyd_sphere_cells *c, size_t n, corner_view *view, size_t count) {
  bool cycle = false, all = count > 0;
  for (size_t k = 0; k < count; k++) {
    corner_view *next = view_find(view, count, view[k].at, view[k].b);
    if (next) next->has_before = true;
  }
  for (int pass = 0; pass < 2; pass++)
    for (size_t k = 0; k < count; k++) {
      if (view[k].used || (pass == 0 && view[k].has_before)) continue;
      n = nodes_walk(&cycle, c, n, view, count, &view[k]);
      all = all && cycle;
    }
  if (count) c->closed[view[0].at] = all;
  return n;
}

static void cells_walk(dyd_sphere_cells *c, corner_view *view, size_t count) {
  size_t n = 0, k = 0;
  qsort(view, count, sizeof *view, compare_views);
  for (size_t i = 0; i < c->places; i++) {
    size_t begin = k;
    c->first[i] = n;
    while (k < count && view[k].at == i) k++;
    n = cell_walk(c, n, view + begin, k - begin);
  }
  c->first[c->places] = n;
}

static dyd_status cells_put(dyd_sphere_cells *c, const dyd_sphere *s, const dyd_triangle_list *t, dyd_error *err) {
  corner_view *view = dyd_alloc(t->count, 3 * sizeof *view);
  dyd_status st = view ? DYD_OK : DYD_E_NOMEM;
  for (uint32_t k = 0; k < t->count && st == DYD_OK; k++) {
    const uint32_t *v = t->item[k].v;
    c->node[k].of = t->item[k];
    st = dyd_sphere_vertex(c->node[k].box, s, &t->item[k], err);
    for (int l = 0; l < 3; l++)
      view[3 * k + (uint32_t)l] = (corner_view){.at = v[l], .a = v[(l + 1) % 3], .b = v[(l + 2) % 3], .node = k};
  }
  if (st == DYD_OK) cells_walk(c, view, 3 * t->count);
  free(view);
  return st;
}

dyd_status dyd_sphere_cells_find(dyd_sphere_cells *c, const dyd_sphere *s, dyd_error *err) {
  dyd_triangle_list t = {0};
  dyd_status st = dyd_sphere_triangles(&t, s);
  c->places = dyd_engine_count(dyd_sphere_places(s));
  c->nodes = t.count;
  c->node = dyd_alloc(t.count, sizeof *c->node);
  c->first = dyd_alloc(c->places + 1, sizeof *c->first);
  c->of = dyd_alloc(t.count, 3 * sizeof *c->of);
  c->gap = dyd_alloc(t.count, 3 * sizeof *c->gap);
  c->closed = calloc(c->places + 1, sizeof *c->closed);
  if (st == DYD_OK && !(c->node && c->first && c->of && c->gap && c->closed)) st = DYD_E_NOMEM;
  if (st == DYD_OK) st = cells_put(c, s, &t, err);
  /* Of one or two points the cells are the globe or its halves. */
  for (size_t i = 0; st == DYD_OK && dyd_engine_count(dyd_sphere_images(s)) < 2 && i < c->places; i++)
    c->closed[i] = true;
  dyd_triangle_list_clear(&t);
  return st;
}
