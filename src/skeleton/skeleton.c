/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From sites to a skeleton: order, representatives, triangles, maps, boxes. */
#include "skeleton/skeleton.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "base/local.h"
#include "base/parallel.h"
#include "rect/irect.h"
#include "skeleton/mesh_build.h"
#include "skeleton/mesh_filter.h"
#include "skeleton/work.h"

#include <math.h>
#include <string.h>

/* ---- sites on one line ----
 *
 * Every pair is possible: the closed half-plane of the line has all points on its boundary and none in its open
 * interior. A pair is legal iff a disc holds both rectangles and meets no other, that is iff the segment hull(R_i u
 * R_j) of the line meets no other rectangle (the disc over that segment does it; any disc meets the line in a segment).
 * With two sites the pair is legal [LINE-1]. */

/* A site's extent along the line, as scaled integers: the axis along which the sites differ orders them. */
typedef struct line_entry {
  uint32_t vertex;
  dyd_irect r;
  int axis;
} line_entry;

static mpz_srcptr line_low(const line_entry *e) {
  return e->axis == 0 ? e->r.x0 : e->r.y0;
}
static mpz_srcptr line_high(const line_entry *e) {
  return e->axis == 0 ? e->r.x1 : e->r.y1;
}

static int line_compare(const void *a, const void *b) {
  const line_entry *x = a, *y = b;
  int c = mpz_cmp(line_low(x), line_low(y));
  if (!c) c = mpz_cmp(line_high(x), line_high(y));
  return c ? c : (x->vertex > y->vertex) - (x->vertex < y->vertex);
}

/* x, unless the line is vertical. */
static int line_axis(const line_entry *e, uint32_t count) {
  for (uint32_t q = 0; q < count; q++)
    if (mpz_cmp(e[q].r.x0, e[0].r.x0) != 0 || mpz_cmp(e[q].r.x1, e[q].r.x0) != 0) return 0;
  return 1;
}

/* Sorted by lower end. hull(R_q u R_q+1) is free of others iff no site before reaches R_q's lower end and no site after
 * starts at or before the larger upper end. */
static void line_find_legal(dyd_line *l, const line_entry *e) {
  uint32_t reach = 0; /* the entry with the largest upper end among 0 .. q-1 */
  for (uint32_t q = 0; q + 1 < l->count; q++) {
    mpz_srcptr top = mpz_cmp(line_high(&e[q]), line_high(&e[q + 1])) > 0 ? line_high(&e[q]) : line_high(&e[q + 1]);
    bool before = q == 0 || mpz_cmp(line_high(&e[reach]), line_low(&e[q])) < 0;
    bool after = q + 2 >= l->count || mpz_cmp(line_low(&e[q + 2]), top) > 0;
    l->legal[q] = before && after;
    if (q == 0 || mpz_cmp(line_high(&e[q]), line_high(&e[reach])) > 0) reach = q;
  }
}

/* The first is certainly an end iff it lies before the second, which has the lowest end of the others; the last iff no
 * site reaches it. Two sites need not be on a line: both are ends when they are apart. */
static void line_find_ends(dyd_line *l, const line_entry *e) {
  uint32_t last = l->count - 1, reach = 0;
  if (l->count == 0) return;
  for (uint32_t q = 1; q < last; q++)
    if (mpz_cmp(line_high(&e[q]), line_high(&e[reach])) > 0) reach = q;
  l->is_end[0] = last == 0 || mpz_cmp(line_high(&e[0]), line_low(&e[1])) < 0;
  l->is_end[1] = last == 0 || mpz_cmp(line_high(&e[reach]), line_low(&e[last])) < 0;
  if (l->count == 2) l->is_end[0] = l->is_end[1] = !dyd_irects_meet(&e[0].r, &e[1].r);
}

static dyd_status line_allocate(dyd_line *l, uint32_t n) {
  return DYD_NEW(l->order, n) && DYD_NEW(l->rank, n) && DYD_ZEROED(l->legal, n ? n : 1) ? DYD_OK : DYD_E_NOMEM;
}

/* Returns true if r is a point, and `before` the same one. */
static bool is_point_again(const dyd_irect *r, const dyd_irect *before) {
  return mpz_cmp(r->x0, r->x1) == 0 && mpz_cmp(r->y0, r->y1) == 0 && mpz_cmp(before->x0, r->x0) == 0 &&
         mpz_cmp(before->x1, r->x0) == 0 && mpz_cmp(before->y0, r->y0) == 0 && mpz_cmp(before->y1, r->y0) == 0;
}

/* Equal exact points are neighbours in the order: the later ones become aliases and leave the list. */
static void line_drop_aliases(dyd_line *l, dyd_mesh *m, line_entry *e) {
  uint32_t kept = 0;
  for (uint32_t q = 0; q < l->count; q++) {
    if (kept && is_point_again(&e[q].r, &e[kept - 1].r)) {
      m->alias[e[q].vertex] = e[kept - 1].vertex;
      dyd_irect_clear(&e[q].r);
    } else
      e[kept++] = e[q];
  }
  l->count = kept;
}

static void line_sort(dyd_line *l, dyd_mesh *m, line_entry *e) {
  int axis = line_axis(e, l->count);
  for (uint32_t q = 0; q < l->count; q++) e[q].axis = axis;
  qsort(e, l->count, sizeof *e, line_compare);
  line_drop_aliases(l, m, e);
  for (uint32_t q = 0; q < l->count; q++) {
    l->order[q] = e[q].vertex;
    l->rank[e[q].vertex] = q;
  }
  line_find_legal(l, e);
  line_find_ends(l, e);
  for (uint32_t q = 0; q < l->count; q++) dyd_irect_clear(&e[q].r);
}

/* From the rectangles of the n vertices. Vertices that turn out to be the same exact point become aliases in m. */
static dyd_status line_build(dyd_line *l, dyd_mesh *m, const dyd_rects *rects, uint32_t n) {
  *l = (dyd_line){0};
  dyd_status st = line_allocate(l, n);
  if (st != DYD_OK) return st;
  for (uint32_t v = 0; v < n; v++) {
    l->rank[v] = DYD_NONE;
    if (dyd_mesh_alias(m, v) == DYD_NONE) l->order[l->count++] = v;
  }
  DYD_FREED line_entry *e = dyd_alloc(l->count, sizeof *e);
  DYD_FREED dyd_rect *r = dyd_alloc(l->count, sizeof *r);
  DYD_FREED dyd_irect *out = dyd_alloc(l->count, sizeof *out);
  DYD_FREED const dyd_rect **in = calloc((size_t)l->count + 1, sizeof *in);
  if (!e || !r || !in || !out) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < l->count; q++) {
    dyd_rect_init(&r[q]);
    dyd_irect_init(&out[q]);
    dyd_rects_get(&r[q], rects, l->order[q]);
    in[q] = &r[q];
  }
  dyd_irects_scale(out, in, l->count, NULL, NULL);
  for (uint32_t q = 0; q < l->count; q++) {
    e[q] = (line_entry){.vertex = l->order[q], .r = out[q]};
    dyd_rect_clear(&r[q]);
  }
  line_sort(l, m, e);
  return DYD_OK;
}

bool dyd_line_is_legal(const dyd_line *l, uint32_t v, uint32_t w) {
  uint32_t a = l->rank[v], b = l->rank[w];
  return a < b ? b == a + 1 && l->legal[a] : a == b + 1 && l->legal[b];
}

bool dyd_line_is_end(const dyd_line *l, uint32_t v) {
  return (l->rank[v] == 0 && l->is_end[0]) || (l->rank[v] == l->count - 1 && l->is_end[1]);
}

size_t dyd_line_legal_pairs(const dyd_line *l) {
  size_t count = 0;
  for (uint32_t q = 0; q + 1 < l->count; q++) count += l->legal[q];
  return count;
}

size_t dyd_line_open_pairs(const dyd_line *l) {
  return l->count ? (size_t)l->count * (l->count - 1) / 2 - dyd_line_legal_pairs(l) : 0;
}

/* ---- edges ---- */

dyd_half_edge dyd_find_edge(const dyd_skeleton *sk, uint32_t v, uint32_t w) {
  dyd_half_edge first = sk->leaving[v], h = first;
  while (h != DYD_NONE && dyd_edge_target(&sk->mesh, h) != w) h = dyd_edge_around(&sk->mesh, h, first);
  return h;
}

bool dyd_is_legal(const dyd_skeleton *sk, uint32_t v, uint32_t w) {
  dyd_half_edge h = dyd_find_edge(sk, v, w);
  return h != DYD_NONE && dyd_edge_is_certain(sk, h);
}

uint64_t dyd_certain_corners(const dyd_skeleton *sk) {
  const dyd_mesh *m = &sk->mesh;
  uint64_t corners = 0;
  dyd_half_edge first = dyd_hull_first(m), h = first;
  if (first == DYD_NONE) return 0;
  do {
    corners += dyd_edge_is_certain(sk, dyd_edge_prev(h));
    h = dyd_hull_following(m, h);
  } while (h != first);
  return corners;
}

/* Bits of certain[] are halves of edges. */
uint64_t dyd_certain_edges(const dyd_skeleton *sk) {
  const dyd_mesh *m = &sk->mesh;
  uint64_t halves = 0;
  for (uint32_t t = 0; t < m->count; t++)
    halves += (sk->certain[t] & 1u) + (sk->certain[t] >> 1 & 1u) + (sk->certain[t] >> 2 & 1u);
  return halves / 2 - dyd_certain_corners(sk);
}

static bool is_listed(const uint32_t *list, int count, uint32_t v) {
  for (int k = 0; k < count; k++)
    if (list[k] == v) return true;
  return false;
}

int dyd_neighbours(uint32_t *out, int room, const dyd_skeleton *sk, uint32_t i, uint32_t j) {
  const dyd_mesh *m = &sk->mesh;
  int count = 0, before;
  for (int k = 0; k < 2; k++) {
    dyd_half_edge first = sk->leaving[k ? j : i];
    before = count;
    for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(m, h, first)) {
      uint32_t v = dyd_edge_target(m, h);
      if (v != m->n && v != i && v != j && count < room && !is_listed(out, before, v)) out[count++] = v;
    }
  }
  return count;
}

/* ---- a coarse box tree for results that have no tree over single vertices: exact points, and collinear sites ----
 *
 * Vertices are in spatial order, so a block of consecutive ones has a small box. Boxes are outward: those of the
 * representatives where these are the points, of the table of sites otherwise. It costs about 1.3 bytes a vertex. */

void dyd_vertex_box(dyd_bbox *out, const dyd_skeleton *sk, uint32_t v) {
  if (sk->rects.box) {
    *out = sk->rects.box[v];
  } else if (sk->all_points && dyd_reps_is_double(&sk->reps, v)) {
    dyd_xy p = sk->reps.xy[v];
    *out = (dyd_bbox){{p.x, p.x, p.y, p.y}};
  } else {
    dyd_sites_get_d(out->e, sk->rects.sites, sk->reps.site[v]);
  }
}

/* Resizes an array; false: it stays as it is. */
static bool skeleton_resize(void *array, size_t count, size_t size) {
  void *to = realloc(*(void **)array, count ? count * size : 1);
  if (to) *(void **)array = to;
  return to;
}

/* The boxes of the blocks from the last one of `before` vertices on, and the tree over all, aliases included; needs
 * reps and all_points. On failure clearing is due as well. */
static dyd_status blocks_make(dyd_skeleton *sk, uint32_t before) {
  uint32_t count = sk->n / DYD_BLOCK + (sk->n % DYD_BLOCK != 0);
  uint32_t *item = dyd_alloc(count, sizeof *item);
  if (!item || !skeleton_resize(&sk->block, count, sizeof *sk->block)) return free(item), DYD_E_NOMEM;
  for (uint32_t b = 0; b < count; b++) item[b] = b;
  for (uint32_t v = before - before % DYD_BLOCK; v < sk->n; v++) {
    dyd_bbox one;
    dyd_vertex_box(&one, sk, v);
    if (v % DYD_BLOCK == 0) sk->block[v / DYD_BLOCK] = one;
    dyd_box_widen(&sk->block[v / DYD_BLOCK], &one);
  }
  dyd_tree_clear(&sk->blocks);
  return dyd_tree_init(&sk->blocks, item, count, sk->block);
}

void dyd_skeleton_clear(dyd_skeleton *sk) {
  dyd_tree_clear(&sk->rects.tree);
  dyd_tree_clear(&sk->blocks);
  dyd_mesh_clear(&sk->mesh);
  dyd_reps_clear(&sk->reps);
  dyd_free_all(sk->line.order, sk->line.rank, sk->line.legal);
  dyd_free_all(sk->block, sk->rects.box, sk->certain, sk->leaving, sk->vertex);
  memset(sk, 0, sizeof *sk);
}

void dyd_skeleton_moved(dyd_skeleton *sk) {
  sk->mesh.reps = &sk->reps;
  sk->rects.tree.box = sk->rects.box;
}

static dyd_status skeleton_reserve(dyd_skeleton *sk) {
  const bool boxed = !dyd_sites_are_double_points(sk->rects.sites);
  if (!DYD_NEW(sk->reps.site, sk->n) || !DYD_NEW(sk->vertex, sk->n) || !DYD_NEW(sk->leaving, sk->n) ||
      (boxed && (!DYD_NEW(sk->rects.box, sk->n) || !DYD_NEW(sk->rects.tree.item, sk->n))))
    return DYD_E_NOMEM;
  sk->rects.site = sk->reps.site;
  return DYD_OK;
}

/* A vertex represents the lowest of its equal sites: site numbers of a vertex and its aliases are exchanged. */
static void settle_aliases(dyd_skeleton *sk) {
  uint32_t *site = sk->reps.site;
  for (uint32_t v = 0; v < sk->n && sk->mesh.alias; v++)
    while (sk->mesh.alias[v] != DYD_NONE && dyd_mesh_alias(&sk->mesh, sk->mesh.alias[v]) != DYD_NONE)
      sk->mesh.alias[v] = sk->mesh.alias[sk->mesh.alias[v]];
  for (uint32_t v = 0; v < sk->n && sk->mesh.alias; v++) {
    uint32_t a = sk->mesh.alias[v];
    if (a == DYD_NONE || site[v] > site[a]) continue;
    uint32_t t = site[v];
    site[v] = site[a];
    site[a] = t;
    if (!sk->rects.box) continue;
    dyd_bbox box = sk->rects.box[v];
    sk->rects.box[v] = sk->rects.box[a];
    sk->rects.box[a] = box;
  }
  for (uint32_t v = 0; v < sk->n; v++) {
    uint32_t a = dyd_mesh_alias(&sk->mesh, v);
    sk->vertex[site[v]] = a != DYD_NONE ? a : v;
  }
}

/* Of a vertex: a half-edge out of the last one among the triangles of its strip. */
static void leaving_of_strip(void *context, size_t number) {
  dyd_skeleton *sk = context;
  uint32_t begin = sk->mesh.strips.begin[number], end = sk->mesh.strips.begin[number + 1];
  uint32_t last = 2 * end < sk->mesh.count ? 2 * end : sk->mesh.count;
  for (uint32_t t = 2 * begin; t < last; t++)
    for (unsigned k = 0; k < 3; k++) {
      uint32_t v = sk->mesh.tri[t].v[k];
      if (v - begin < end - begin) sk->leaving[v] = dyd_edge_of(t, dyd_prev(k));
    }
}

/* A vertex at a seam may have triangles of the other strip only: it is lost at first. */
static void find_leaving(dyd_skeleton *sk, unsigned threads) {
  bool lost = false;
  memset(sk->leaving, 0xff, sk->n * sizeof *sk->leaving);
  dyd_parallel(threads, sk->mesh.strips.count, leaving_of_strip, sk);
  for (uint32_t v = 0; v < sk->n && !lost; v++)
    lost = sk->leaving[v] == DYD_NONE && dyd_mesh_alias(&sk->mesh, v) == DYD_NONE;
  for (uint32_t t = 0; t < sk->mesh.count && lost; t++)
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++) {
      uint32_t v = dyd_edge_origin(&sk->mesh, h);
      if (v != sk->mesh.n && sk->leaving[v] == DYD_NONE) sk->leaving[v] = h;
    }
}

static dyd_status build_maps(dyd_skeleton *sk, unsigned threads) {
  if (!DYD_ZEROED(sk->certain, sk->mesh.count ? sk->mesh.count : 1)) return DYD_E_NOMEM;
  settle_aliases(sk);
  find_leaving(sk, threads);
  sk->all_points = true;
  if (dyd_sites_are_double_points(sk->rects.sites)) return DYD_OK;
  for (uint32_t i = 0; i < sk->n && sk->all_points; i++) sk->all_points = dyd_site_is_point(sk->rects.sites, i);
  return DYD_OK;
}

static dyd_status build_boxes(dyd_skeleton *sk) {
  if (sk->all_points || sk->mesh.collinear) {
    dyd_status st = blocks_make(sk, 0); /* while the boxes are at hand in this order */
    dyd_tree_clear(&sk->rects.tree);
    free(sk->rects.box);
    sk->rects.box = NULL;
    return st;
  }
  uint32_t *item = sk->rects.tree.item, count = 0;
  for (uint32_t v = 0; v < sk->n; v++)
    if (sk->leaving[v] != DYD_NONE) item[count++] = v;
  return dyd_tree_init(&sk->rects.tree, item, count, sk->rects.box);
}

dyd_status dyd_skeleton_build(dyd_skeleton *sk, const dyd_sites *sites, const dyd_skeleton_options *o) {
  *sk = (dyd_skeleton){.n = (uint32_t)dyd_sites_count(sites), .rects = {.sites = sites}};
  sk->built = sk->n;
  dyd_strips strips;
  dyd_status st = skeleton_reserve(sk);
  if (st == DYD_OK) st = dyd_spatial_order(sk->reps.site, &strips, sites, o->threads);
  if (st == DYD_OK && dyd_flag_is_set(o->cancel)) st = DYD_CANCELLED;
  if (st == DYD_OK) st = dyd_reps_init(&sk->reps, sk->rects.box, sites, sk->reps.site, sk->n, o->threads);
  for (uint32_t v = 0; st == DYD_OK && sites->joins && v < sk->n; v++) sk->vertex[sk->reps.site[v]] = v;
  if (st == DYD_OK)
    st = dyd_mesh_build_strips(&sk->mesh, &sk->reps, &strips, sites->joins ? sk->vertex : NULL, o->no_filter, o->cancel,
                               o->threads);
  if (st == DYD_OK && sk->mesh.collinear) st = line_build(&sk->line, &sk->mesh, &sk->rects, sk->n);
  if (st == DYD_OK) st = build_maps(sk, o->threads);
  if (st == DYD_OK) st = build_boxes(sk);
  if (st == DYD_OK) DYD_INVARIANT(dyd_mesh_is_valid(&sk->mesh));
  if (st != DYD_OK) dyd_skeleton_clear(sk);
  return st;
}

void dyd_skeleton_set_box(dyd_skeleton *sk, uint32_t v) {
  dyd_tree *tree = &sk->rects.tree;
  dyd_rects_set_box(&sk->rects, v);
  bool own_number = v < tree->count && tree->item[v] == v; /* no aliases before it */
  dyd_tree_refresh(tree, own_number ? v : dyd_tree_entry(tree, v));
}

dyd_status dyd_skeleton_refresh(dyd_skeleton *sk, uint32_t v) {
  dyd_skeleton_set_box(sk, v);
  return dyd_reps_choose(&sk->reps, v, sk->reps.code && sk->reps.code[v] ? sk->reps.code[v] - 1 : 0);
}

dyd_status dyd_skeleton_grow(dyd_skeleton *sk, const uint32_t *order, uint32_t count, uint32_t ghost) {
  const uint32_t before = sk->n, n = before + count;
  if (!skeleton_resize(&sk->reps.site, n, sizeof *sk->reps.site) ||
      !skeleton_resize(&sk->reps.xy, (size_t)n + 1, sizeof *sk->reps.xy) ||
      !skeleton_resize(&sk->vertex, n, sizeof *sk->vertex) || !skeleton_resize(&sk->leaving, n, sizeof *sk->leaving) ||
      !skeleton_resize(&sk->certain, 2 * (size_t)n + 2, 1) ||
      (sk->rects.box && !skeleton_resize(&sk->rects.box, n, sizeof *sk->rects.box)) ||
      (sk->reps.code && !skeleton_resize(&sk->reps.code, n, sizeof *sk->reps.code)))
    return DYD_E_NOMEM;
  sk->rects.site = sk->reps.site;
  for (uint32_t k = 0; k < count; k++) {
    sk->reps.site[before + k] = order[k];
    if (sk->reps.code) sk->reps.code[before + k] = 0;
    if (sk->rects.box) dyd_rects_set_box(&sk->rects, before + k);
    sk->vertex[order[k]] = before + k;
    sk->leaving[before + k] = DYD_NONE;
  }
  sk->reps.xy[n] = (dyd_xy){NAN, NAN};
  sk->n = sk->reps.n = n;
  dyd_status st = DYD_OK;
  for (uint32_t v = before; v < n && st == DYD_OK; v++) st = dyd_reps_choose(&sk->reps, v, 0);
  if (st == DYD_OK)
    st = sk->rects.box ? dyd_tree_grow(&sk->rects.tree, before, count, sk->rects.box) : blocks_make(sk, before);
  if (st != DYD_OK) return st;
  const dyd_tree *tree = sk->rects.box ? &sk->rects.tree : &sk->blocks;
  const dyd_bbox *all = &tree->node[tree->level[tree->levels] - 1];
  return dyd_mesh_grow(&sk->mesh, n, ghost, (const double[]){all->e[1] - all->e[0], all->e[3] - all->e[2]});
}

size_t dyd_skeleton_memory(const dyd_skeleton *sk) {
  size_t n = sk->n, t = sk->mesh.collinear ? 0 : 2 * n + 2;
  const dyd_tree *tree = &sk->rects.tree;
  size_t bytes = n * (3 * sizeof(uint32_t) + sizeof(dyd_xy)) + t * sizeof(dyd_tri) + sk->mesh.count;
  if (sk->reps.code) bytes += n * sizeof(uint32_t);
  if (sk->rects.box) bytes += n * sizeof(dyd_bbox) + tree->count * sizeof(uint32_t);
  return bytes +
         (tree->level[tree->levels] + sk->blocks.level[sk->blocks.levels] + sk->blocks.count) * sizeof(dyd_bbox);
}

/* As above, and coordinates scaled to integers for the mesh. Boxes come with sites that are not points. */
uint64_t dyd_skeleton_bytes(const dyd_sites *sites) {
  enum { TREE = sizeof(dyd_bbox) / (DYD_TREE_FANOUT - 1) + sizeof(uint32_t) };
  uint64_t n = dyd_sites_count(sites), each = 3 * sizeof(uint32_t) + 2 * sizeof(dyd_xy) + 2 * sizeof(dyd_tri) + 2;
  if (sites->upper[0] || sites->upper[1] || sites->exact) each += sizeof(uint32_t) + sizeof(dyd_bbox) + TREE;
  return n * each;
}

/* ---- a common integer scale of a growing set of rectangles ---- */

void dyd_scale_set_init(dyd_scale_set *s, const dyd_rects *rects) {
  *s = (dyd_scale_set){.rects = rects};
  mpz_inits(s->lcm, s->growth, s->t, NULL);
  dyd_scale_set_empty(s);
  dyd_rect_init(&s->load);
}

void dyd_scale_set_clear(dyd_scale_set *s) {
  for (size_t k = 0; k < s->made; k++) dyd_irect_clear(&s->rect[k]);
  dyd_free_all(s->rect, s->vertex);
  mpz_clears(s->lcm, s->growth, s->t, NULL);
  dyd_rect_clear(&s->load);
}

void dyd_scale_set_empty(dyd_scale_set *s) {
  s->count = 0;
  mpz_set_ui(s->lcm, 1);
  s->low = INT64_MAX;
}

static void scale_lower(int64_t *low, const dyd_dyadic *x) {
  if (mpz_sgn(x->man) && x->exp < *low) *low = x->exp;
}

/* man * 2^exp / den in the scale of the set: exact, since den divides lcm and exp >= low. */
static void scale_end(mpz_t out, const dyd_scale_set *s, const dyd_dyadic *x, const mpz_t den) {
  if (mpz_sgn(x->man) == 0) {
    mpz_set_ui(out, 0);
    return;
  }
  mpz_mul_2exp(out, x->man, (mp_bitcnt_t)(x->exp - s->low));
  if (mpz_cmp(den, s->lcm) != 0) {
    mpz_mul(out, out, s->lcm);
    mpz_divexact(out, out, den);
  }
}

/* Refines the scale for the loaded rectangle; true if members there were have to grow. */
static bool scale_refine(dyd_scale_set *s) {
  int64_t low = s->low;
  const dyd_interval *side[2] = {&s->load.x, &s->load.y};
  mpz_set(s->t, s->lcm);
  for (int a = 0; a < 2; a++) {
    scale_lower(&low, &side[a]->lo);
    scale_lower(&low, &side[a]->hi);
    mpz_lcm(s->t, s->t, side[a]->den);
  }
  bool grows = s->count > 0 && (low < s->low || mpz_cmp(s->t, s->lcm) != 0);
  if (grows) {
    mpz_divexact(s->growth, s->t, s->lcm);
    if (s->low != INT64_MAX) mpz_mul_2exp(s->growth, s->growth, (mp_bitcnt_t)(s->low - low));
  }
  mpz_set(s->lcm, s->t);
  s->low = low;
  return grows;
}

static void grow_members(dyd_scale_set *s) {
  for (size_t k = 0; k < s->count; k++) {
    mpz_mul(s->rect[k].x0, s->rect[k].x0, s->growth);
    mpz_mul(s->rect[k].x1, s->rect[k].x1, s->growth);
    mpz_mul(s->rect[k].y0, s->rect[k].y0, s->growth);
    mpz_mul(s->rect[k].y1, s->rect[k].y1, s->growth);
  }
}

static bool scale_find(size_t *index, const dyd_scale_set *s, uint32_t v) {
  for (size_t k = 0; k < s->count; k++)
    if (s->vertex[k] == v) return *index = k, true;
  return false;
}

dyd_status dyd_scale_add(size_t *index, bool *grown, dyd_scale_set *s, uint32_t v) {
  *grown = false;
  if (scale_find(index, s, v)) return DYD_OK;
  if (!DYD_GROW(s->vertex, s->vertex_cap, s->count + 1)) return DYD_E_NOMEM;
  if (!DYD_GROW(s->rect, s->rect_cap, s->count + 1)) return DYD_E_NOMEM;
  dyd_rects_get(&s->load, s->rects, v);
  if (s->made == s->count) dyd_irect_init(&s->rect[s->made++]);
  *grown = scale_refine(s);
  if (*grown) grow_members(s);
  dyd_irect *r = &s->rect[s->count];
  scale_end(r->x0, s, &s->load.x.lo, s->load.x.den);
  scale_end(r->x1, s, &s->load.x.hi, s->load.x.den);
  scale_end(r->y0, s, &s->load.y.lo, s->load.y.den);
  scale_end(r->y1, s, &s->load.y.hi, s->load.y.den);
  s->vertex[s->count] = v;
  *index = s->count++;
  return DYD_OK;
}

int64_t dyd_scale_shift(const dyd_scale_set *s) {
  return s->low == INT64_MAX ? 0 : -s->low;
}

/* ---- the work of one thread ---- */

void dyd_work_init(dyd_work *w, const dyd_skeleton *sk, const dyd_run *run) {
  static const dyd_run alone = {.threads = 1};
  *w = (dyd_work){.run = run ? run : &alone, .rects = &sk->rects};
  dyd_scale_set_init(&w->set, &sk->rects);
  dyd_icircle_init(&w->here);
  for (int k = 0; k < DYD_CIRCLES; k++) dyd_icircle_init(&w->next[k]);
  mpz_inits(w->u[0], w->u[1], w->h, w->s, w->t, NULL);
}

void dyd_work_clear(dyd_work *w) {
  mpz_clears(w->u[0], w->u[1], w->h, w->s, w->t, NULL);
  for (int k = 0; k < DYD_CIRCLES; k++) dyd_icircle_clear(&w->next[k]);
  dyd_icircle_clear(&w->here);
  dyd_scale_set_clear(&w->set);
}

static void add_counters(dyd_delaunay_counters *sum, const dyd_delaunay_counters *c) {
  sum->filter += c->filter;
  sum->integer += c->integer;
  sum->exact += c->exact;
  sum->witness_guess += c->witness_guess;
  sum->witness_search += c->witness_search;
  sum->cover_walks += c->cover_walks;
  sum->faces += c->faces;
}

/* done: of each range, the work without its scratch. */
typedef struct work_pass {
  dyd_work_task *task;
  void *context;
  const dyd_skeleton *sk;
  const dyd_work *work;
  dyd_work *done;
  dyd_status status[DYD_RANGES_MOST];
} work_pass;

/* Scratch is there while the range is worked on, made by the thread that needs it. */
static void task_of_range(void *context, size_t number, size_t begin, size_t end) {
  work_pass *p = context;
  dyd_work *w = &p->done[number];
  dyd_work_init(w, p->sk, p->work->run);
  w->memory = p->work->memory;
  dyd_memory_share(&w->memory, w->run->threads);
  p->status[number] = p->task(p->context, w, number, begin, end);
  dyd_work_clear(w);
}

dyd_status dyd_work_ranges(dyd_work *w, const dyd_skeleton *sk, size_t count, dyd_work_task *task, void *context) {
  size_t ranges = dyd_ranges(count);
  work_pass p = {.task = task, .context = context, .sk = sk, .work = w};
  dyd_status st = DYD_OK;
  if (ranges == 1) return task(context, w, 0, 0, count); /* with the scratch that is there */
  if (!DYD_NEW(p.done, ranges)) return DYD_E_NOMEM;
  dyd_parallel_ranges(w->run->threads, count, task_of_range, &p);
  for (size_t r = 0; r < ranges; r++) {
    if (st == DYD_OK) st = p.status[r];
    add_counters(&w->counters, &p.done[r].counters);
    dyd_tally_join(&w->tally, &p.done[r].tally);
    dyd_memory_join(&w->memory, &p.done[r].memory);
  }
  free(p.done);
  return st;
}

void dyd_work_count(dyd_delaunay_counters *sum, const dyd_work *w, const dyd_skeleton *sk) {
  const dyd_tally *t = &w->tally;
  uint64_t beyond = t->integer + t->exact;
  add_counters(sum, &w->counters);
  if (!sk->mesh.no_filter && t->asked > beyond) sum->filter += t->asked - beyond;
  sum->integer += t->integer;
  sum->exact += t->exact;
}
