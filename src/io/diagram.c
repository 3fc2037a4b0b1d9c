/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The Voronoi diagram to be written: its window, vertices, cells and bounds. */
#include "io/diagram.h"
#include "dyadic/raw.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "delaunay/undecided.h"
#include "metric/bounds.h"
#include "voronoi/vertex_filter.h"
#include <math.h>

/* ---- cells ---- */

static void diagram_grow_box(double box[4], double xlo, double xhi, double ylo, double yhi) {
  box[0] = fmin(box[0], xlo);
  box[1] = fmax(box[1], xhi);
  box[2] = fmin(box[2], ylo);
  box[3] = fmax(box[3], yhi);
}

static void clip_box(double box[4], const double window[4]) {
  for (int k = 0; k < 4; k++) box[k] = k & 1 ? fmin(box[k], window[k]) : fmax(box[k], window[k]);
}

static void cell_row_box(dyd_cell_row *row, const dyd_shape *s, const double window[4]) {
  double *b = row->box;
  b[0] = b[2] = INFINITY;
  b[1] = b[3] = -INFINITY;
  for (uint32_t k = 0; s->in_doubles && k < s->outer_count; k++)
    diagram_grow_box(b, s->outer[k].x, s->outer[k].x, s->outer[k].y, s->outer[k].y);
  for (size_t p = 0; !s->in_doubles && p < s->outer_exact.count; p++)
    for (size_t k = 0; k < s->outer_exact.item[p].count; k++) {
      const dyd_point *z = &s->outer_exact.item[p].vertex[k];
      diagram_grow_box(b, dyd_dyadic_get_d(&z->x, DYD_DOWN), dyd_dyadic_get_d(&z->x, DYD_UP),
                       dyd_dyadic_get_d(&z->y, DYD_DOWN), dyd_dyadic_get_d(&z->y, DYD_UP));
    }
  row->present = b[0] <= b[1];
  row->exact = s->exact;
  row->rounding = s->exact ? s->rounding : 0;
  for (int k = 0; k < 4 && s->exact; k++) {
    double out = k & 1 ? INFINITY : -INFINITY;
    b[k] = nextafter(b[k] + copysign(s->rounding, out), out);
  }
  clip_box(b, window);
}

double dyd_cell_undetermined(const dyd_cell_row *row) {
  const double *area = row->area;
  if (row->exact || !(area[1] > 0)) return 0;
  return fmin(nextafter(nextafter(area[1] - area[0], INFINITY) / area[1], INFINITY), 1);
}

typedef struct visitor {
  dyd_cell_visit visit;
  void *context;
  double window[4];
} visitor;

static dyd_status visit_cell(void *context, uint32_t i, const dyd_shape *shape, const double area[2]) {
  const visitor *v = context;
  dyd_cell_row row = {.area = {area[0], area[1]}};
  cell_row_box(&row, shape, v->window);
  return v->visit(v->context, i, shape, &row);
}

dyd_status dyd_diagram_visit(const dyd_diagram *d, dyd_cell_visit visit, void *context) {
  dyd_voronoi_sums sums;
  visitor v = {.visit = visit, .context = context};
  dyd_rect_get_d(v.window, &d->window);
  dyd_status st = dyd_voronoi_sums_init(&sums, d->pd, &d->window, d->bits);
  *d->cut = 0;
  sums.cancel = d->cancel;
  sums.cut = d->cut;
  sums.discs = d->discs;
  sums.memory.beside = d->memory->beside;
  if (st == DYD_OK) st = dyd_voronoi_sums_all(&sums, visit_cell, &v);
  if (st == DYD_OK) st = dyd_voronoi_sums_bounds(d->bounds, &sums);
  dyd_memory_join(d->memory, &sums.memory);
  dyd_voronoi_sums_clear(&sums);
  return st;
}

/* ---- cells as arrays ---- */

void dyd_cells_clear(dyd_cells *c) {
  if (!c) return;
  dyd_free_all(c->ring, c->xy, c->area);
  *c = (dyd_cells){0};
}

typedef struct cells_maker {
  dyd_cells *out;
  const dyd_diagram *d;
  size_t ring_cap, xy_cap, vertices;
} cells_maker;

/* Sets *out to a double next to x. Returns how far they are apart at most. */
static double cells_round(double *out, const dyd_dyadic *x) {
  double lo = dyd_dyadic_get_d(x, DYD_DOWN), hi = dyd_dyadic_get_d(x, DYD_UP);
  *out = isfinite(lo) ? lo : hi;
  return hi - lo;
}

/* Makes a ring with the given number of vertices, and sets *xy to their array; NULL if they are too few for a ring. */
static dyd_status cells_begin(double **xy, cells_maker *m, uint32_t i, dyd_ring_kind kind, size_t count) {
  dyd_cells *c = m->out;
  size_t end = m->vertices + count;
  *xy = NULL;
  if (count < 3) return DYD_OK;
  uint64_t bytes = dyd_bytes_times(end, 2 * sizeof *c->xy) + dyd_bytes_times(c->count + 1, sizeof *c->ring);
  if (!dyd_memory_has(m->d->memory, bytes, "the polygons of the cells") ||
      !DYD_GROW(c->ring, m->ring_cap, c->count + 1) || !DYD_GROW(c->xy, m->xy_cap, 2 * end))
    return DYD_E_NOMEM;
  *xy = c->xy + 2 * m->vertices;
  c->ring[c->count++] = (dyd_cell_ring){.site = i, .kind = (uint32_t)kind, .end = m->vertices = end};
  return DYD_OK;
}

static dyd_status cells_add_doubles(cells_maker *m, uint32_t i, dyd_ring_kind kind, const dyd_xy *z, size_t count) {
  double *xy;
  dyd_status st = cells_begin(&xy, m, i, kind, count);
  for (size_t k = 0; xy && k < count; k++) xy[2 * k] = z[k].x, xy[2 * k + 1] = z[k].y;
  return st;
}

static dyd_status cells_add_exact(cells_maker *m, uint32_t i, dyd_ring_kind kind, const dyd_polygon *p) {
  double *xy;
  dyd_status st = cells_begin(&xy, m, i, kind, p->count);
  for (size_t k = 0; xy && k < p->count; k++) {
    double *most = &m->out->ring[m->out->count - 1].rounding;
    *most = fmax(*most, cells_round(&xy[2 * k], &p->vertex[k].x));
    *most = fmax(*most, cells_round(&xy[2 * k + 1], &p->vertex[k].y));
  }
  return st;
}

static dyd_status cells_add(void *context, uint32_t i, const dyd_shape *s, const dyd_cell_row *row) {
  cells_maker *m = context;
  const dyd_ring_kind kind = row->exact ? DYD_RING_EXACT : DYD_RING_CERTAIN;
  const size_t parts = row->exact || s->in_doubles ? 0 : s->outer_exact.count, first = m->out->count;
  dyd_status st = s->in_doubles ? cells_add_doubles(m, i, kind, s->inner, s->inner_count)
                                : cells_add_exact(m, i, kind, &s->inner_exact);
  if (st == DYD_OK && s->in_doubles && !row->exact)
    st = cells_add_doubles(m, i, DYD_RING_POSSIBLE, s->outer, s->outer_count);
  for (size_t k = 0; k < parts && st == DYD_OK; k++)
    st = cells_add_exact(m, i, DYD_RING_POSSIBLE, &s->outer_exact.item[k]);
  for (size_t k = first; k < m->out->count && row->rounding > 0; k++)
    m->out->ring[k].rounding = nextafter(m->out->ring[k].rounding + row->rounding, INFINITY);
  for (int k = 0; k < 2; k++) m->out->area[2 * (size_t)i + (size_t)k] = row->area[k];
  return st;
}

dyd_status dyd_diagram_cells(dyd_cells *out, const dyd_diagram *d) {
  cells_maker m = {.out = out, .d = d};
  uint64_t bytes = dyd_bytes_times(d->count, 2 * sizeof *out->area);
  if (dyd_memory_has(d->memory, bytes, "the areas of the cells"))
    out->area = dyd_alloc(2 * d->count, sizeof *out->area);
  if (!out->area) return DYD_E_NOMEM;
  d->memory->beside += bytes;
  out->sites = d->count;
  out->bits = d->bits;
  dyd_status st = dyd_diagram_visit(d, cells_add, &m);
  for (uint32_t i = 0; i < d->count && st == DYD_OK; i++) {
    const double *of = &out->area[2 * (size_t)dyd_delaunay_alias(d->pd, i)];
    for (int k = 0; k < 2; k++) out->area[2 * (size_t)i + (size_t)k] = of[k];
  }
  return st;
}

dyd_status dyd_diagram_tiles(dyd_tiles *out, const dyd_diagram *d, bool areas_only, dyd_error *err) {
  dyd_status st =
      dyd_tiles_find(out, d->bounds, d->pd, &d->window, d->bits, areas_only && !d->clip_to, d->discs, d->cancel);
  if (st == DYD_OK && d->clip_to) st = dyd_tiles_clip(out, d->clip_to, d->cancel);
  if (st == DYD_OK && d->coincident) *d->coincident = out->coincident;
  if (st != DYD_E_RANGE) return st;
  return dyd_fail(
      err, st,
      "doubles are too coarse for tiles on this window, or do not hold its ends; give a larger `window`, or "
      "points nearer to the origin");
}

double dyd_diagram_tile(size_t *end, const dyd_diagram *d, const dyd_tiles *tiles) {
  uint32_t site = tiles->site[*end];
  double area = tiles->area[(*end)++];
  for (; d->clip_to && *end < tiles->count && tiles->site[*end] == site; ++*end)
    if (tiles->area[*end] > 0) area = nextafter(area + tiles->area[*end], INFINITY);
  return area;
}

dyd_status dyd_diagram_regions(const dyd_diagram *d, dyd_region_visit visit, void *context) {
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_rect, r);
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(d->pd) && st == DYD_OK; f++) {
    bool any = true;
    double b[4];
    if (dyd_flag_is_set(d->cancel)) {
      ++*d->cut;
      dyd_rect_set(&r, &d->window);
    } else {
      st = dyd_voronoi_region(&r, &any, d->pd, f, &d->window);
    }
    dyd_rect_get_d(b, &r);
    if (st == DYD_OK) st = visit(context, f, any ? b : NULL);
  }
  return st;
}

/* ---- vertices ---- */

static dyd_status find_vertex(double out[4], const dyd_diagram *d, const dyd_triangle *t, int64_t bits) {
  uint32_t v[3] = {d->pd->sk.vertex[t->v[0]], d->pd->sk.vertex[t->v[1]], d->pd->sk.vertex[t->v[2]]};
  dyd_bbox b;
  double most = ldexp(1, d->bits < -1000 ? 1000 : d->bits > 1000 ? -1000 : (int)-d->bits);
  /* Wide boxes in doubles say much less than the exact ones. */
  if (dyd_filter_vertex(&b, d->pd, v) && b.e[1] - b.e[0] < most && b.e[3] - b.e[2] < most) {
    for (int k = 0; k < 4; k++) out[k] = b.e[k];
    return DYD_OK;
  }
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_flag_is_set(d->cancel) ? DYD_E_RANGE : dyd_voronoi_vertex(&r, d->pd, t, bits);
  dyd_rect_get_d(out, &r);
  if (st != DYD_OK) {
    out[0] = out[2] = -INFINITY;
    out[1] = out[3] = INFINITY;
  }
  return st == DYD_E_RANGE ? DYD_OK : st;
}

/* Where rectangles give no bound, the enclosure has infinite ends. */
static dyd_status find_tied_vertex(bool *tied, double out[4], const dyd_diagram *d, size_t f) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_voronoi_tied_vertex(&r, tied, d->pd, f, d->vertex_bits);
  dyd_rect_get_d(out, &r);
  for (int k = 0; k < 4 && st == DYD_E_RANGE; k++) out[k] = k & 1 ? INFINITY : -INFINITY;
  return st == DYD_E_RANGE ? DYD_OK : st;
}

static dyd_status find_tied_vertices(dyd_diagram *d, size_t faces) {
  dyd_status st = DYD_OK;
  for (size_t f = 0; f < faces && st == DYD_OK; f++) {
    bool tied = false;
    st = find_tied_vertex(&tied, d->vertex[d->triangles.count + d->ties], d, f);
    if (st == DYD_OK && tied) d->tied[d->ties++] = f;
  }
  return st;
}

static dyd_status find_vertices(dyd_diagram *d) {
  size_t faces = dyd_delaunay_undecided_faces(d->pd), most = 2 * d->count + faces;
  uint64_t bytes = dyd_bytes_times(most, sizeof *d->triangles.item + sizeof *d->vertex);
  if (!dyd_memory_has(d->memory, bytes, "the vertices of the diagram")) return DYD_E_NOMEM;
  d->memory->beside += bytes;
  dyd_status st = dyd_delaunay_triangles(&d->triangles, NULL, d->pd, 0);
  if (st != DYD_OK) return st;
  d->vertex = dyd_alloc(d->triangles.count + faces, sizeof *d->vertex);
  d->tied = dyd_alloc(faces, sizeof *d->tied);
  if (!d->vertex || !d->tied) return DYD_E_NOMEM;
  for (size_t k = 0; k < d->triangles.count && st == DYD_OK; k++)
    st = find_vertex(d->vertex[k], d, &d->triangles.item[k], d->vertex_bits);
  return st == DYD_OK ? find_tied_vertices(d, faces) : st;
}

dyd_status dyd_diagram_vertex_sites(dyd_index_list *out, const dyd_diagram *d, size_t k) {
  bool outer;
  if (k >= d->triangles.count) return dyd_delaunay_face(out, &outer, d->pd, d->tied[k - d->triangles.count]);
  *out = (dyd_index_list){.item = dyd_alloc(3, sizeof *out->item)};
  if (!out->item) return DYD_E_NOMEM;
  for (; out->count < 3; out->count++) out->item[out->count] = d->triangles.item[k].v[out->count];
  return DYD_OK;
}

bool dyd_diagram_vertex_in_window(const dyd_diagram *d, size_t k) {
  double w[4];
  const double *b = d->vertex[k];
  dyd_rect_get_d(w, &d->window);
  return dyd_box_is_finite(b) && b[0] <= w[1] && w[0] <= b[1] && b[2] <= w[3] && w[2] <= b[3];
}

dyd_status dyd_diagram_vertex(char *text[4], const dyd_diagram *d, size_t k) {
  DYD_LOCAL(dyd_rect, r);
  for (int m = 0; m < 4; m++) text[m] = NULL;
  size_t triangles = d->triangles.count;
  bool tied;
  dyd_status st = k < triangles ? dyd_voronoi_vertex(&r, d->pd, &d->triangles.item[k], d->vertex_bits)
                                : dyd_voronoi_tied_vertex(&r, &tied, d->pd, d->tied[k - triangles], d->vertex_bits);
  for (int m = 0; m < 4 && st == DYD_OK; m++) {
    text[m] = dyd_end_text(m < 2 ? &r.x : &r.y, m & 1);
    if (!text[m]) st = DYD_E_NOMEM;
  }
  return st;
}

/* As fine as the goal on the distance asks, and fine enough for doubles. */
static int64_t vertex_bits(const dyd_diagram *d) {
  int64_t goal_bits, bits = d->bits + 40 > 64 ? d->bits + 40 : 64;
  bool hausdorff = dyd_engine_goal(&goal_bits, d->engine) == DYD_GOAL_VORONOI_HAUSDORFF;
  return hausdorff && goal_bits + 2 > bits ? goal_bits + 2 : bits;
}

/* ---- certain edges ---- */

/* The edge dual to a legal pair ij ends on each side at the vertex of the certain triangle there; or at that of a
 * polygon whose sites are on one circle, since its sides are legal and others are not between them; or somewhere in the
 * region of an undecided face; or it is a ray: with all other points to the left of the way from i to j, or on it, it
 * goes to infinity along (y_j - y_i, x_i - x_j). So it is for pairs that are hull edges for every choice, for
 * neighbours in a chain of sites on one line that is a tie, whose sites have all others on one side [CLO-2] [TIE-3],
 * and on both sides where all sites are on one line. */

static dyd_dual_edge *dual_find(dyd_dual_edge *edge, size_t count, uint32_t i, uint32_t j) {
  const dyd_dual_edge key = {.i = i, .j = j};
  return bsearch(&key, edge, count, sizeof key, dyd_compare_two);
}

static void dual_join_triangles(dyd_dual_edge *edge, size_t count, const dyd_triangle_list *triangles) {
  for (size_t t = 0; t < triangles->count; t++)
    for (int k = 0; k < 3; k++) {
      uint32_t a = triangles->item[t].v[k], b = triangles->item[t].v[(k + 1) % 3];
      dyd_dual_edge *e = dual_find(edge, count, a < b ? a : b, a < b ? b : a);
      if (e) e->end[a < b ? 0 : 1] = (dyd_dual_end){.kind = DYD_DUAL_VERTEX, .vertex = t};
    }
}

static int tied_compare(const void *a, const void *b) {
  const size_t *f = a, *g = b;
  return (*f > *g) - (*f < *g);
}

const size_t *dyd_dual_tied(const size_t *tied, size_t ties, size_t face) {
  return ties ? bsearch(&face, tied, ties, sizeof face, tied_compare) : NULL;
}

/* Bounds of sign * (b - a) along an axis: an operation in doubles, then one step outward. */
static void dual_difference(double out[2], const double a[2], const double b[2], int sign) {
  double lo = sign > 0 ? b[0] - a[1] : a[0] - b[1], hi = sign > 0 ? b[1] - a[0] : a[1] - b[0];
  out[0] = nextafter(lo, -INFINITY);
  out[1] = nextafter(hi, INFINITY);
}

/* right: 1 where all other points are on the left of i to j, so that the ray is end[1]; else 0, the other way round. */
static void dual_set_ray(dyd_dual_edge *e, const dyd_delaunay *pd, int right) {
  double a[4], b[4];
  dyd_sites_get_d(a, dyd_delaunay_sites(pd), e->i);
  dyd_sites_get_d(b, dyd_delaunay_sites(pd), e->j);
  dyd_dual_end *end = &e->end[right];
  end->kind = DYD_DUAL_RAY;
  dual_difference(end->direction, a + 2, b + 2, right ? 1 : -1);
  dual_difference(end->direction + 2, a, b, right ? -1 : 1);
}

/* first: the number of the vertex of the first tied polygon. */
typedef struct dual_ties {
  const size_t *tied;
  size_t count, first;
} dual_ties;

/* An end that is in no triangle may be in a tied polygon, or beyond a tied chain of the hull. */
static void dual_join_tie(dyd_dual_edge *e, int end, const dyd_delaunay *pd, const dual_ties *ties) {
  uint32_t v[2] = {pd->sk.vertex[e->i], pd->sk.vertex[e->j]};
  dyd_half_edge h = dyd_find_edge(&pd->sk, v[end], v[1 - end]);
  size_t face = h == DYD_NONE ? DYD_NONE : dyd_face_of(pd, dyd_edge_triangle(h));
  const size_t *found = dyd_dual_tied(ties->tied, ties->count, face);
  if (found)
    e->end[end] = (dyd_dual_end){.kind = DYD_DUAL_VERTEX, .vertex = ties->first + (size_t)(found - ties->tied)};
  else if (face != DYD_NONE && dyd_open_is_outer(pd, face) && dyd_open_status_of(pd, face) == DYD_TIE)
    dual_set_ray(e, pd, end);
}

static void dual_join_ties(dyd_dual_edge *e, const dyd_delaunay *pd, const dual_ties *ties) {
  for (int end = 0; end < 2; end++) {
    if (e->end[end].kind != DYD_DUAL_OPEN) continue;
    if (pd->open.kind == DYD_LINE)
      dual_set_ray(e, pd, end);
    else if (pd->open.count)
      dual_join_tie(e, end, pd, ties);
  }
}

/* A certain hull edge with a vertex on one side has its ray on the other. Both sides open: the ray is unknown. */
static dyd_status dual_join_rays(dyd_dual_edge *edge, size_t count, const dyd_delaunay *pd) {
  DYD_SCOPED(dyd_hull) hull = {0};
  dyd_status st = dyd_delaunay_partial_hull(&hull, pd, true);
  if (st == DYD_CAPPED) st = DYD_OK; /* then it lists no pairs */
  for (size_t k = 0; st == DYD_OK && k < hull.pairs.count; k++) {
    if (hull.pairs.item[k].status != DYD_LEGAL) continue;
    dyd_dual_edge *e = dual_find(edge, count, hull.pairs.item[k].i, hull.pairs.item[k].j);
    if (e && (e->end[0].kind == DYD_DUAL_VERTEX) != (e->end[1].kind == DYD_DUAL_VERTEX))
      dual_set_ray(e, pd, e->end[0].kind == DYD_DUAL_VERTEX);
  }
  return st;
}

static dyd_status legal_pairs(dyd_dual_edge **out, size_t *count, const dyd_pair_list *pairs) {
  *count = 0;
  *out = calloc(pairs->count ? pairs->count : 1, sizeof **out);
  for (size_t k = 0; *out && k < pairs->count; k++)
    if (pairs->item[k].status == DYD_LEGAL)
      (*out)[(*count)++] = (dyd_dual_edge){.i = pairs->item[k].i, .j = pairs->item[k].j};
  return *out ? DYD_OK : DYD_E_NOMEM;
}

dyd_status dyd_diagram_edges(dyd_dual_edge **out, size_t *count, const dyd_diagram *d) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_dual_edge *edge = NULL;
  uint64_t bytes = d->discs ? 0 : dyd_pairs_bytes(d->pd, DYD_LEGAL),
           most = d->discs ? d->discs->count : bytes / sizeof(dyd_pair);
  if (!dyd_memory_has(d->memory, dyd_bytes_add(bytes, dyd_bytes_times(most, sizeof *edge)), "the edges of the diagram"))
    return DYD_E_NOMEM;
  dyd_status st = d->discs ? DYD_OK : dyd_pairs_take(&pairs, d->pd, DYD_LEGAL);
  if (st == DYD_OK) st = legal_pairs(&edge, count, d->discs ? d->discs : &pairs);
  if (st == DYD_OK) {
    dual_join_triangles(edge, *count, &d->triangles);
    const dual_ties all = {.tied = d->tied, .count = d->ties, .first = d->triangles.count};
    for (size_t k = 0; k < *count; k++) dual_join_ties(&edge[k], d->pd, &all);
    st = dual_join_rays(edge, *count, d->pd);
  }
  if (st == DYD_OK)
    *out = edge;
  else
    free(edge);
  return st;
}

/* ---- where edges are drawn ---- */

bool dyd_box_is_finite(const double b[4]) {
  return isfinite(b[0]) && isfinite(b[1]) && isfinite(b[2]) && isfinite(b[3]);
}

/* lo, hi of begin + [0,1] * length * direction at its far end; two roundings, each a step outward. */
static void ray_side(double out[2], const double begin[2], const double direction[2], double length) {
  out[0] = nextafter(begin[0] + nextafter(direction[0] * length, -INFINITY), -INFINITY);
  out[1] = nextafter(begin[1] + nextafter(direction[1] * length, INFINITY), INFINITY);
}

/* Where an end of an edge is drawn: at its vertex, or so far out on its ray that it has passed the window; false when
 * neither is known. */
static bool edge_place(double box[4], const dyd_diagram *d, const dyd_dual_edge *e, int end) {
  double w[4], from[4];
  const dyd_dual_end *to = &e->end[end], *other = &e->end[1 - end];
  if (to->kind == DYD_DUAL_VERTEX) {
    for (int k = 0; k < 4; k++) box[k] = d->vertex[to->vertex][k];
    return dyd_box_is_finite(box);
  }
  if (to->kind != DYD_DUAL_RAY || other->kind != DYD_DUAL_VERTEX) return false;
  for (int k = 0; k < 4; k++) from[k] = d->vertex[other->vertex][k];
  dyd_rect_get_d(w, &d->window);
  const double *v = to->direction;
  double size = fmax(fabs(v[0] / 2 + v[1] / 2), fabs(v[2] / 2 + v[3] / 2));
  double apart = fmax(fmax(w[0] - from[0], from[1] - w[1]), fmax(w[2] - from[2], from[3] - w[3]));
  double length = (w[1] - w[0] + w[3] - w[2] + 2 * fmax(apart, 0)) / size;
  ray_side(box, from, v, length);
  ray_side(box + 2, from + 2, v + 2, length);
  return dyd_box_is_finite(box);
}

bool dyd_diagram_edge(double box[2][4], const dyd_diagram *d, const dyd_dual_edge *e) {
  return edge_place(box[0], d, e, 0) && edge_place(box[1], d, e, 1);
}

/* ---- vertices, edges and regions as arrays ---- */

void dyd_frame_clear(dyd_frame *f) {
  if (!f) return;
  dyd_free_all(f->box, f->end, f->site, f->face, f->edge, f->ray);
  *f = (dyd_frame){0};
}

typedef struct frame_maker {
  dyd_frame *out;
  const dyd_diagram *d;
  size_t box_cap, end_cap, site_cap, face_cap, ray_cap, sites;
} frame_maker;

/* Adds a vertex or a region; takes over the sites. */
static dyd_status frame_add(frame_maker *m, const double box[4], dyd_index_list *sites) {
  dyd_frame *f = m->out;
  size_t k = f->vertices + f->regions, end = m->sites + sites->count;
  dyd_status st = DYD_OK;
  if (!DYD_GROW(f->box, m->box_cap, 4 * (k + 1)) || !DYD_GROW(f->end, m->end_cap, k + 1) ||
      !DYD_GROW(f->site, m->site_cap, end))
    st = DYD_E_NOMEM;
  for (size_t q = 0; q < 4 && st == DYD_OK; q++) f->box[4 * k + q] = box[q];
  for (size_t q = 0; q < sites->count && st == DYD_OK; q++) f->site[m->sites + q] = sites->item[q];
  if (st == DYD_OK) f->end[k] = m->sites = end;
  dyd_index_list_clear(sites);
  return st;
}

static dyd_status frame_add_region(void *context, size_t face, const double box[4]) {
  frame_maker *m = context;
  dyd_index_list sites = {0};
  bool outer;
  if (!box) return DYD_OK;
  if (!DYD_GROW(m->out->face, m->face_cap, m->out->regions + 1)) return DYD_E_NOMEM;
  dyd_status st = dyd_delaunay_face(&sites, &outer, m->d->pd, face);
  if (st == DYD_OK) st = frame_add(m, box, &sites);
  if (st == DYD_OK) m->out->face[m->out->regions++] = (uint32_t)face;
  return st;
}

static dyd_status frame_add_ends(frame_maker *m, const dyd_dual_edge *e) {
  dyd_frame *f = m->out;
  dyd_frame_edge *to = &f->edge[f->edges++];
  *to = (dyd_frame_edge){e->i, e->j, {DYD_END_OPEN, DYD_END_OPEN}};
  for (int end = 0; end < 2; end++) {
    if (e->end[end].kind == DYD_DUAL_VERTEX) to->end[end] = (int64_t)e->end[end].vertex;
    if (e->end[end].kind != DYD_DUAL_RAY) continue;
    if (!DYD_GROW(f->ray, m->ray_cap, f->rays + 1)) return DYD_E_NOMEM;
    dyd_frame_ray *r = &f->ray[f->rays];
    bool known = edge_place(r->box, m->d, e, end);
    for (int k = 0; k < 4; k++) r->direction[k] = e->end[end].direction[k], r->box[k] = known ? r->box[k] : NAN;
    to->end[end] = DYD_END_OPEN - 1 - (int64_t)f->rays++;
  }
  return DYD_OK;
}

dyd_status dyd_diagram_frame(dyd_frame *out, const dyd_diagram *d) {
  frame_maker m = {.out = out, .d = d};
  DYD_FREED dyd_dual_edge *edge = NULL;
  size_t count = 0;
  dyd_status st = dyd_diagram_edges(&edge, &count, d);
  if (st == DYD_OK) out->edge = dyd_alloc(count, sizeof *out->edge);
  if (st == DYD_OK && !out->edge) st = DYD_E_NOMEM;
  for (size_t k = 0; k < count && st == DYD_OK; k++) st = frame_add_ends(&m, &edge[k]);
  for (size_t k = 0; k < dyd_diagram_vertices(d) && st == DYD_OK; k++) {
    dyd_index_list sites = {0};
    st = dyd_diagram_vertex_sites(&sites, d, k);
    if (st == DYD_OK) st = frame_add(&m, d->vertex[k], &sites);
    out->vertices += st == DYD_OK;
  }
  return st == DYD_OK ? dyd_diagram_regions(d, frame_add_region, &m) : st;
}

/* ---- all ---- */

static dyd_status diagram_window(dyd_diagram *d, const dyd_rect *given, dyd_error *err) {
  if (given) {
    dyd_window w;
    dyd_rect_set(&d->window, given);
    if (dyd_window_init(&w, given) == DYD_OK) return DYD_OK;
    return dyd_fail(err, DYD_E_ARG, "the window has to have positive area and dyadic ends");
  }
  if (dyd_voronoi_window(&d->window, d->sites) == DYD_OK) return DYD_OK;
  return dyd_fail(err, DYD_E_RANGE, "the points span more than doubles hold; give a `window`");
}

/* Sets *out to whether the bound of the area at bits + step is less than half of that at bits, so that flattening still
 * matters. */
static dyd_status finer_helps(bool *out, const dyd_diagram *d, int64_t bits, int64_t step) {
  dyd_voronoi_bounds b[2];
  dyd_status st = DYD_OK;
  for (int k = 0; k < 2; k++) dyd_voronoi_bounds_init(&b[k]);
  for (int k = 0; k < 2 && st == DYD_OK; k++)
    st = dyd_voronoi_bounds_within(&b[k], d->pd, &d->window, bits + (k ? step : 0), 0, d->discs, d->cancel);
  if (st == DYD_OK) st = dyd_dyadic_add(&b[1].area, &b[1].area, &b[1].area);
  *out = st == DYD_OK && dyd_dyadic_cmp(&b[1].area, &b[0].area) < 0;
  for (int k = 2; k-- > 0;) dyd_voronoi_bounds_clear(&b[k]);
  return st == DYD_CANCELLED ? DYD_OK : st;
}

/* Where scales are far apart, arcs may take more points than can be held: only as fine as polygons can be had.
 * Elsewhere they can, and nothing is tried. */
static dyd_status coarsen_flattening(dyd_diagram *d) {
  enum { COMMON = 40, COARSER = 8 };
  int64_t least = COMMON + 3 - dyd_metric_flattening(d->pd, &d->window, 0);
  dyd_status st = DYD_E_RANGE;
  while (st == DYD_E_RANGE && d->bits > least) {
    DYD_LOCAL(dyd_voronoi_bounds, b);
    st = dyd_voronoi_bounds_within(&b, d->pd, &d->window, d->bits, 0, d->discs, d->cancel);
    if (st == DYD_E_RANGE) d->bits -= COARSER;
  }
  return st == DYD_E_NOMEM ? st : DYD_OK;
}

/* Fine enough for the eye, and for the goal on the area if there was one. If that was not reached, the undetermined
 * area hides the flattening, and polygons as fine as the goal could be endless: then only as fine as it helps. */
static dyd_status choose_flattening(dyd_diagram *d) {
  enum { STEP = 6 };
  int64_t goal_bits;
  bool helps = true;
  dyd_status st = DYD_OK;
  d->bits = dyd_metric_coarseness(d->pd, &d->window) + 4;
  if (dyd_engine_goal(&goal_bits, d->engine) != DYD_GOAL_VORONOI_AREA) return DYD_OK;
  int64_t fine = dyd_metric_flattening(d->pd, &d->window, goal_bits) + 8;
  bool reached = dyd_engine_outcome(d->engine) == DYD_OUTCOME_CERTIFIED;
  while (d->bits < fine && !reached && helps && st == DYD_OK) {
    st = finer_helps(&helps, d, d->bits, STEP);
    if (helps) d->bits += STEP;
  }
  if (reached && fine > d->bits) d->bits = fine;
  return st;
}

dyd_status dyd_diagram_init(dyd_diagram *d, const dyd_output *to, const dyd_write_options *o, bool vertices,
                            dyd_memory *memory, dyd_error *err) {
  const dyd_delaunay *pd = dyd_engine_delaunay(to->engine);
  *d = (dyd_diagram){.out = to->out,
                     .engine = to->engine,
                     .pd = pd,
                     .sites = dyd_delaunay_sites(pd),
                     .bounds = o->bounds,
                     .discs = o->pairs,
                     .cancel = o->cancel,
                     .memory = memory,
                     .cut = o->cut,
                     .coincident = o->coincident};
  d->count = dyd_sites_count(d->sites);
  d->clip_to = o->clip_to;
  d->epsg = o->epsg;
  d->history = o->history;
  dyd_rect_init(&d->window);
  dyd_status st = diagram_window(d, o->window, err);
  if (st != DYD_OK) return st;
  if (o->flatten_set)
    d->bits = o->flatten_bits;
  else
    st = choose_flattening(d);
  if (st == DYD_OK && !o->flatten_set) st = coarsen_flattening(d);
  d->vertex_bits = vertex_bits(d);
  if (st == DYD_OK && vertices) st = find_vertices(d);
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

void dyd_diagram_clear(dyd_diagram *d) {
  dyd_rect_clear(&d->window);
  dyd_triangle_list_clear(&d->triangles);
  dyd_free_all(d->vertex, d->tied);
}
