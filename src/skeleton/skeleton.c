/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From sites to a skeleton: order, representatives, triangles, maps, boxes. */
#include "skeleton/skeleton.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "base/parallel.h"
#include "skeleton/mesh_build.h"
#include "skeleton/mesh_filter.h"
#include "skeleton/work.h"

#include <math.h>
#include <string.h>

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
  dyd_line_clear(&sk->line);
  dyd_reps_clear(&sk->reps);
  dyd_free_all(sk->block, sk->rects.box, sk->certain, sk->leaving, sk->vertex);
  memset(sk, 0, sizeof *sk);
}

void dyd_skeleton_moved(dyd_skeleton *sk) {
  sk->mesh.reps = &sk->reps;
  sk->rects.tree.box = sk->rects.box;
}

enum { FETCH_AHEAD = 24 };

static void boxes_of_range(void *context, size_t number, size_t begin, size_t end) {
  dyd_skeleton *sk = context;
  (void)number;
  for (size_t v = begin; v < end; v++) {
    if (v + FETCH_AHEAD < end) dyd_sites_fetch(sk->rects.sites, sk->rects.site[v + FETCH_AHEAD]);
    dyd_rects_set_box(&sk->rects, (uint32_t)v);
  }
}

static dyd_status skeleton_reserve(dyd_skeleton *sk) {
  const bool boxed = !dyd_sites_are_double_points(sk->rects.sites);
  if (!DYD_NEW(sk->reps.site, sk->n) || !DYD_NEW(sk->vertex, sk->n) || !DYD_NEW(sk->leaving, sk->n) ||
      (boxed && !DYD_NEW(sk->rects.box, sk->n)))
    return DYD_E_NOMEM;
  sk->rects.site = sk->reps.site;
  return DYD_OK;
}

/* Boxes: the table of sites in the order of the vertices, read once for whatever is made of it. */
static dyd_status skeleton_triangulate(dyd_skeleton *sk, const dyd_skeleton_options *o) {
  const dyd_sites *sites = sk->rects.sites;
  dyd_strips strips;
  dyd_status st = dyd_spatial_order(sk->reps.site, &strips, sites, o->threads);
  if (st == DYD_OK && dyd_flag_is_set(o->cancel)) st = DYD_CANCELLED;
  if (st != DYD_OK) return st;
  if (sk->rects.box) dyd_parallel_ranges(o->threads, sk->n, boxes_of_range, sk);
  st = dyd_reps_init(&sk->reps, sites, sk->reps.site, sk->rects.box, sk->n, o->threads);
  if (st == DYD_OK) st = dyd_mesh_build_strips(&sk->mesh, &sk->reps, &strips, o->no_filter, o->cancel, o->threads);
  return st;
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

/* A vertex at a seam may have triangles of the other strip only. */
static bool has_lost_vertex(const dyd_skeleton *sk) {
  for (uint32_t v = 0; v < sk->n; v++)
    if (sk->leaving[v] == DYD_NONE && dyd_mesh_alias(&sk->mesh, v) == DYD_NONE) return sk->mesh.count > 0;
  return false;
}

static void find_leaving(dyd_skeleton *sk, unsigned threads) {
  memset(sk->leaving, 0xff, sk->n * sizeof *sk->leaving);
  dyd_parallel(threads, sk->mesh.strips.count, leaving_of_strip, sk);
  if (!has_lost_vertex(sk)) return;
  for (uint32_t t = 0; t < sk->mesh.count; t++)
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
  for (uint32_t i = 0; i < sk->n && sk->all_points; i++) sk->all_points = dyd_sites_is_point(sk->rects.sites, i);
  return DYD_OK;
}

static dyd_status build_boxes(dyd_skeleton *sk) {
  if (sk->all_points || sk->mesh.collinear) {
    dyd_status st = blocks_make(sk, 0); /* while the boxes are at hand in this order */
    free(sk->rects.box);
    sk->rects.box = NULL;
    return st;
  }
  uint32_t *item = dyd_alloc(sk->n, sizeof *item), count = 0;
  if (!item) return DYD_E_NOMEM;
  for (uint32_t v = 0; v < sk->n; v++)
    if (sk->leaving[v] != DYD_NONE) item[count++] = v;
  return dyd_tree_init(&sk->rects.tree, item, count, sk->rects.box);
}

dyd_status dyd_skeleton_build(dyd_skeleton *sk, const dyd_sites *sites, const dyd_skeleton_options *o) {
  *sk = (dyd_skeleton){.n = (uint32_t)dyd_sites_count(sites), .rects = {.sites = sites}};
  sk->built = sk->n;
  dyd_status st = skeleton_reserve(sk);
  if (st == DYD_OK) st = skeleton_triangulate(sk, o);
  if (st == DYD_OK && sk->mesh.collinear) st = dyd_line_build(&sk->line, &sk->mesh, &sk->rects, sk->n);
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

typedef struct work_pass {
  dyd_work_task *task;
  void *context;
  dyd_work *work;
  dyd_status status[DYD_RANGES_MOST];
} work_pass;

static void task_of_range(void *context, size_t number, size_t begin, size_t end) {
  work_pass *p = context;
  p->status[number] = p->task(p->context, &p->work[number], number, begin, end);
}

static void work_join(dyd_work *w, dyd_work *task) {
  dyd_tally_join(&w->tally, &task->tally);
  add_counters(&w->counters, &task->counters);
  dyd_room_join(&w->room, &task->room);
  dyd_work_clear(task);
}

dyd_status dyd_work_ranges(dyd_work *w, const dyd_skeleton *sk, size_t count, dyd_work_task *task, void *context) {
  size_t ranges = dyd_ranges(count);
  work_pass p = {.task = task, .context = context};
  dyd_status st = DYD_OK;
  if (ranges == 1) return task(context, w, 0, 0, count); /* with the scratch that is there */
  if (!DYD_NEW(p.work, ranges)) return DYD_E_NOMEM;
  for (size_t r = 0; r < ranges; r++) {
    dyd_work_init(&p.work[r], sk, w->run);
    p.work[r].room = w->room;
    dyd_room_share(&p.work[r].room, w->run->threads);
  }
  dyd_parallel_ranges(w->run->threads, count, task_of_range, &p);
  for (size_t r = 0; r < ranges; r++) {
    if (st == DYD_OK) st = p.status[r];
    work_join(w, &p.work[r]);
  }
  free(p.work);
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
