/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Voronoi cells on the sphere as lists of vertices.
 *
 * Around a place i, counter-clockwise, the face (i, a, .., b), a triangle or the sites of a circle in its order, is
 * followed by (i, b, .., c). So its faces, sorted by a, are walked by looking up b; a walk that ends has an undecided
 * region behind its end. */
#include "io/sphere_cells.h"

#include "base/alloc.h"
#include "io/result.h"

#define NARROW 1e-9 /* degrees */

/* The face of `node` seen from a corner: the next one is a, the one before b. */
typedef struct corner_view {
  uint32_t at, a, b, node;
  bool has_before, used;
} corner_view;

/* Faces as they are found. */
typedef struct face_list {
  dyd_sphere_node *node;
  corner_view *view;
  size_t nodes, node_cap, views, view_cap;
} face_list;

void dyd_sphere_cells_clear(dyd_sphere_cells *c) {
  free(c->node);
  free(c->first);
  free(c->of);
  free(c->beyond);
  free(c->gap);
  free(c->closed);
  free(c->middle);
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
    c->beyond[n] = v->b;
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

/* A face by its sites; the vertex is found from three of them, far apart in the order. */
static dyd_status face_put(void *user, dyd_group_kind kind, const dyd_index_list *l) {
  face_list *f = user;
  (void)kind;
  if (!dyd_reserve((void **)&f->node, &f->node_cap, f->nodes + 1, sizeof *f->node) ||
      !dyd_reserve((void **)&f->view, &f->view_cap, f->views + l->count, sizeof *f->view))
    return DYD_E_NOMEM;
  f->node[f->nodes].of = (dyd_triangle){{l->item[0], l->item[l->count / 3], l->item[2 * l->count / 3]}};
  for (size_t k = 0; k < l->count; k++)
    f->view[f->views++] = (corner_view){.at = l->item[k],
                                        .a = l->item[k + 1 < l->count ? k + 1 : 0],
                                        .b = l->item[k ? k - 1 : l->count - 1],
                                        .node = (uint32_t)f->nodes};
  f->nodes++;
  return DYD_OK;
}

static dyd_status faces_find(face_list *f, const dyd_sphere *s) {
  dyd_triangle_list t = {0};
  dyd_status st = dyd_sphere_triangles(&t, s);
  for (size_t k = 0; k < t.count && st == DYD_OK; k++)
    st = face_put(f, DYD_GROUP_CIRCLE, &(dyd_index_list){3, t.item[k].v});
  dyd_triangle_list_clear(&t);
  return st == DYD_OK ? dyd_sphere_each_circle(s, face_put, f) : st;
}

/* Of one place it is the globe, wherever the place is; of two, its halves, which are known if both places are. */
static dyd_status cells_close(dyd_sphere_cells *c, const dyd_sphere *s) {
  dyd_rect r;
  dyd_status st = DYD_OK;
  size_t sites = 0, exact = 0;
  dyd_rect_init(&r);
  for (uint32_t i = 0; i < c->places && sites < 3 && st == DYD_OK; i++) {
    if (dyd_sphere_alias(s, i) != i) continue;
    st = dyd_sphere_rect(&r, s, i);
    exact += dyd_rect_is_point(&r);
    sites++;
  }
  for (size_t i = 0; i < c->places && (sites == 1 || (sites == 2 && exact == 2)); i++) c->closed[i] = true;
  dyd_rect_clear(&r);
  return st;
}

static dyd_status middles_find(dyd_sphere_cells *c, const dyd_sphere *s) {
  double(*box)[4] = NULL;
  dyd_status st = dyd_sphere_boxes(&box, s);
  c->middle = st == DYD_OK ? dyd_alloc(c->places, sizeof *c->middle) : NULL;
  for (size_t i = 0; i < c->places && c->middle; i++) c->middle[i] = dyd_lon_lat_of(box[i]);
  free(box);
  return st == DYD_OK && !c->middle ? DYD_E_NOMEM : st;
}

/* Boxes wider than NARROW are wider than the error of doubles: there the vertex of the middles is computed. */
static dyd_status nodes_find(dyd_sphere_cells *c, const dyd_sphere *s, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < c->nodes && st == DYD_OK; k++) {
    dyd_sphere_node *v = &c->node[k];
    st = dyd_sphere_vertex(v->box, s, &v->of, err);
    v->at = dyd_lon_lat_of(v->box);
    bool wide = v->box[1] - v->box[0] > NARROW || v->box[3] - v->box[2] > NARROW;
    if (!wide || (v->box[3] - v->box[2] <= NARROW && v->box[1] - v->box[0] >= 360)) continue;
    const dyd_lon_lat corner[3] = {c->middle[v->of.v[0]], c->middle[v->of.v[1]], c->middle[v->of.v[2]]};
    v->at = dyd_circle_centre(corner);
  }
  return st;
}

dyd_status dyd_sphere_cells_find(dyd_sphere_cells *c, const dyd_sphere *s, dyd_error *err) {
  face_list f = {0};
  dyd_status st = faces_find(&f, s);
  c->places = dyd_engine_count(dyd_sphere_places(s));
  c->nodes = f.nodes;
  c->node = f.node;
  c->first = dyd_alloc(c->places + 1, sizeof *c->first);
  c->of = dyd_alloc(f.views, sizeof *c->of);
  c->beyond = dyd_alloc(f.views, sizeof *c->beyond);
  c->gap = dyd_alloc(f.views, sizeof *c->gap);
  c->closed = calloc(c->places + 1, sizeof *c->closed);
  if (st == DYD_OK && !(c->first && c->of && c->beyond && c->gap && c->closed)) st = DYD_E_NOMEM;
  if (st == DYD_OK) st = middles_find(c, s);
  if (st == DYD_OK) st = nodes_find(c, s, err);
  if (st == DYD_OK) cells_walk(c, f.view, f.views);
  free(f.view);
  return st == DYD_OK ? cells_close(c, s) : st;
}

dyd_side dyd_sphere_cell_side(const dyd_sphere_cells *c, uint32_t i, size_t k) {
  size_t from = c->first[i] + k, to = from + 1 < c->first[i + 1] ? from + 1 : c->first[i];
  return (dyd_side){c->node[c->of[from]].at, c->node[c->of[to]].at, true, c->middle[i], c->middle[c->beyond[from]]};
}

bool dyd_sphere_cell_is_half(dyd_side *out, const dyd_sphere_cells *c, const dyd_sphere *s, uint32_t i) {
  uint32_t j = 0;
  if (!c->closed[i] || c->first[i] < c->first[i + 1]) return false;
  while (j < c->places && dyd_sphere_alias(s, j) == dyd_sphere_alias(s, i)) j++;
  if (j < c->places) *out = (dyd_side){.between = true, .left = c->middle[i], .right = c->middle[j]};
  return j < c->places;
}
