/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tiles: the Voronoi diagram of one point of each rectangle on a window, as rings whose coordinates are doubles.
 *
 * Vertices are rounded to a grid, each once, so that rings share them bit by bit. Where a ring is not simple after
 * that, a cell is about as thin as the grid, and edges pass over vertices of others. There edges are led through all
 * vertices whose box of the grid they meet, on both sides alike [PART-1], until all rings are simple: a ring is cut
 * where it touches itself, and parts without area are dropped. */
#include "base/alloc.h"
#include "base/local.h"
#include "metric/bounds.h"
#include "metric/tiles_filter.h"
#include "rect/rect.h"
#include "voronoi/shape.h"
#include <gmp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A window takes at least 2^COARSEST steps of the grid. */
enum { COARSEST = 3 };

/* The ring of a cell that is worked on; the edge from z[k] on is shared with site across[k], or on the window's rim.
 * changed: since its edges were last compared with its vertices. */
typedef struct loose_ring {
  uint32_t site;
  bool changed;
  size_t count, cap, across_cap;
  dyd_xy *z;
  uint32_t *across;
} loose_ring;

/* pd: the triangulation of the representatives, of pd's own sites if they are points. loose_of[i]: 1 + place of the
 * loose ring of site i, 0: none; NULL: no ring is loose. */
typedef struct tiling {
  dyd_tiles *out;
  const dyd_delaunay *pd;
  dyd_window w;
  dyd_shape shape;
  bool areas_only; /* no xy */
  bool discs;      /* areas are bounded by cells of discs */
  double *bound;   /* two for each site; NULL: those of the shapes */
  size_t ring_cap, offset_cap, xy_cap, area_cap, bound_cap, vertices;
  loose_ring *loose;
  size_t loose_count, loose_cap;
  uint32_t *loose_of;
  struct quick_tile *quick; /* for each site; NULL: not made */
  dyd_grid_centre *centre;  /* of each triangle, for them */
  double scale;             /* 2^grid */
} tiling;

void dyd_tiles_clear(dyd_tiles *t) {
  dyd_free_all(t->site, t->offset, t->xy, t->area, t->bound);
  *t = (dyd_tiles){0};
}

/* ---- representatives ---- */

static dyd_status add_centre(dyd_sites *to, const dyd_sites *of, size_t i) {
  DYD_LOCAL_ARRAY(mpq_t, end, [4]);
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sites_get(&r, of, i);
  dyd_interval_get_q(end[0], end[1], &r.x);
  dyd_interval_get_q(end[2], end[3], &r.y);
  for (int k = 0; k < 4; k += 2) {
    mpq_add(end[k], end[k], end[k + 1]);
    mpq_div_2exp(end[k], end[k], 1);
  }
  if (st == DYD_OK) st = dyd_rect_set_q(&r, end[0], end[2]);
  return st == DYD_OK ? dyd_sites_add_rect(to, &r) : st;
}

/* The triangulation of the centres of all rectangles; the caller frees both, whatever is returned. */
static dyd_status tiling_of_centres(dyd_sites **sites, dyd_delaunay **pd, const dyd_sites *of,
                                    const volatile int *cancel) {
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = cancel};
  dyd_status st = dyd_sites_new(sites);
  for (size_t i = 0; i < dyd_sites_count(of) && st == DYD_OK; i++) st = add_centre(*sites, of, i);
  return st == DYD_OK ? dyd_delaunay_new(pd, *sites, &o, NULL) : st;
}

/* ---- rings that are done ---- */

/* Twice the area of a ring, exactly. */
static dyd_status ring_area2(dyd_dyadic *out, bool *simple, const dyd_xy *z, size_t n, const volatile int *cancel) {
  DYD_SCOPED(dyd_polygon) p = {.vertex = dyd_alloc(n, sizeof *p.vertex)};
  if (!p.vertex) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  for (; p.count < n; p.count++) {
    dyd_point *v = &p.vertex[p.count];
    dyd_point_init(v);
    if (st == DYD_OK) st = dyd_dyadic_set_d(&v->x, z[p.count].x);
    if (st == DYD_OK) st = dyd_dyadic_set_d(&v->y, z[p.count].y);
  }
  if (st == DYD_OK) st = dyd_polygon_area2(out, &p);
  if (st == DYD_OK && simple) st = dyd_polygon_is_simple(simple, &p, cancel);
  return st;
}

/* Sets *good to whether it is a simple polygon, counter-clockwise. */
static dyd_status ring_is_good(bool *good, const tiling *t, const dyd_xy *z, size_t n) {
  *good = n < 3 || dyd_filter_is_convex(z, n);
  if (*good) return DYD_OK;
  DYD_LOCAL(dyd_dyadic, area2);
  dyd_status st = ring_area2(&area2, good, z, n, t->w.cancel);
  *good = *good && dyd_dyadic_sgn(&area2) > 0;
  return st;
}

static dyd_status ring_area(double *out, const tiling *t, const dyd_xy *z, size_t n) {
  if (dyd_filter_grid_area(out, z, n, t->w.grid)) return DYD_OK;
  DYD_LOCAL(dyd_dyadic, area2);
  dyd_status st = ring_area2(&area2, NULL, z, n, t->w.cancel);
  if (st == DYD_OK) st = dyd_dyadic_mul_2exp(&area2, &area2, -1);
  *out = dyd_dyadic_get_d(&area2, DYD_UP);
  return st;
}

/* Makes room for this number of rings and vertices in all; false: memory is exhausted. */
static bool reserve_rings(tiling *t, size_t rings, size_t vertices) {
  dyd_tiles *o = t->out;
  return DYD_GROW(o->site, t->ring_cap, rings) && DYD_GROW(o->offset, t->offset_cap, rings + 1) &&
         DYD_GROW(o->area, t->area_cap, rings) && DYD_GROW(o->bound, t->bound_cap, 2 * rings) &&
         (t->areas_only || DYD_GROW(o->xy, t->xy_cap, 2 * vertices));
}

/* z = NULL: its places follow. */
static dyd_status append_ring(tiling *t, uint32_t site, const dyd_xy *z, size_t n, double area, const double bound[2]) {
  dyd_tiles *o = t->out;
  size_t r = o->count, end = t->vertices + n;
  if (!reserve_rings(t, r + 1, end)) return DYD_E_NOMEM;
  if (z && !t->areas_only) memcpy(o->xy + 2 * t->vertices, z, n * sizeof *z);
  o->site[r] = site;
  o->offset[r] = t->vertices;
  o->offset[r + 1] = t->vertices = end;
  memcpy(&o->bound[2 * r], t->bound ? &t->bound[2 * (size_t)site] : bound, 2 * sizeof *bound);
  o->area[r] = area;
  o->count++;
  return DYD_OK;
}

static dyd_status measure_ring(tiling *t, uint32_t site, const dyd_xy *z, size_t n, const double bound[2]) {
  double area = 0;
  dyd_status st = ring_area(&area, t, z, n);
  return st == DYD_OK ? append_ring(t, site, z, n, area, bound) : st;
}

/* ---- loose rings ---- */

static bool same_place(dyd_xy a, dyd_xy b) {
  return a.x == b.x && a.y == b.y;
}

/* *out, borrowed until the next call: the loose ring of the site, made if it is not there. */
static dyd_status loosen_ring(loose_ring **out, tiling *t, uint32_t site) {
  if (!t->loose_of) t->loose_of = calloc(dyd_sites_count(dyd_delaunay_sites(t->pd)), sizeof *t->loose_of);
  if (!t->loose_of) return DYD_E_NOMEM;
  if (!t->loose_of[site]) {
    if (!DYD_GROW(t->loose, t->loose_cap, t->loose_count + 1)) return DYD_E_NOMEM;
    dyd_status st = dyd_shape_edges(&t->shape, t->pd, site, &t->w);
    if (st != DYD_OK) return st;
    loose_ring r = {.site = site, .changed = true};
    uint32_t n = t->shape.inner_count;
    if (!DYD_GROW(r.z, r.cap, n + 1) || !DYD_GROW(r.across, r.across_cap, n + 1)) {
      free(r.z);
      return DYD_E_NOMEM;
    }
    for (r.count = 0; r.count < n; r.count++) {
      r.z[r.count] = t->shape.inner[r.count];
      r.across[r.count] = t->shape.across[r.count];
    }
    t->loose[t->loose_count++] = r;
    t->loose_of[site] = (uint32_t)t->loose_count;
  }
  *out = &t->loose[t->loose_of[site] - 1];
  return DYD_OK;
}

/* Leads the edge from z[k] on through v. */
static dyd_status ring_insert(loose_ring *r, size_t k, dyd_xy v) {
  if (!DYD_GROW(r->z, r->cap, r->count + 1) || !DYD_GROW(r->across, r->across_cap, r->count + 1)) return DYD_E_NOMEM;
  memmove(&r->z[k + 2], &r->z[k + 1], (r->count - k - 1) * sizeof *r->z);
  memmove(&r->across[k + 2], &r->across[k + 1], (r->count - k - 1) * sizeof *r->across);
  r->z[k + 1] = v;
  r->across[k + 1] = r->across[k];
  r->count++;
  r->changed = true;
  return DYD_OK;
}

/* Numbers for exact questions about an edge and a vertex. */
typedef struct edge_test {
  mpq_t a[2], b[2], v[2], p[2], q[2], sum, term, limit;
} edge_test;

static void edge_test_each(edge_test *e, void (*fn)(mpq_ptr)) {
  mpq_t *const all[] = {e->a, e->b, e->v, e->p, e->q};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++)
    for (int axis = 0; axis < 2; axis++) fn(all[k][axis]);
  fn(e->sum);
  fn(e->term);
  fn(e->limit);
}

static void edge_test_set(mpq_t out[2], dyd_xy z) {
  mpq_set_d(out[0], z.x);
  mpq_set_d(out[1], z.y);
}

/* Returns true if (v - a) (b - a) > 0. */
static bool edge_goes_to(edge_test *e, mpq_t a[2], mpq_t b[2]) {
  mpq_set_ui(e->sum, 0, 1);
  for (int k = 0; k < 2; k++) {
    mpq_sub(e->term, e->v[k], a[k]);
    mpq_sub(e->limit, b[k], a[k]);
    mpq_mul(e->term, e->term, e->limit);
    mpq_add(e->sum, e->sum, e->term);
  }
  return mpq_sgn(e->sum) > 0;
}

static dyd_status edge_test_site(mpq_t out[2], const tiling *t, uint32_t site) {
  DYD_LOCAL(dyd_rect, r);
  DYD_LOCAL_NUMBERS(mpq, hi);
  dyd_status st = dyd_sites_get(&r, dyd_delaunay_sites(t->pd), site);
  dyd_interval_get_q(out[0], hi, &r.x);
  dyd_interval_get_q(out[1], hi, &r.y);
  return st;
}

/* Returns true if the bisector of p and q meets the closed box of the grid around v. With d = q - p: is
 * |2 d v - (|q|^2 - |p|^2)| <= 2^-grid (|dx| + |dy|)? */
static bool bisector_meets(edge_test *e, int grid) {
  mpq_set_ui(e->sum, 0, 1);
  mpq_set_ui(e->limit, 0, 1);
  for (int k = 0; k < 2; k++) {
    DYD_LOCAL_NUMBERS(mpq, d);
    mpq_sub(d, e->q[k], e->p[k]);
    mpq_add(e->term, e->v[k], e->v[k]);
    mpq_sub(e->term, e->term, e->q[k]);
    mpq_sub(e->term, e->term, e->p[k]);
    mpq_mul(e->term, e->term, d);
    mpq_add(e->sum, e->sum, e->term);
    mpq_abs(d, d);
    mpq_add(e->limit, e->limit, d);
  }
  if (grid >= 0)
    mpq_div_2exp(e->limit, e->limit, (mp_bitcnt_t)grid);
  else
    mpq_mul_2exp(e->limit, e->limit, (mp_bitcnt_t)-grid);
  mpq_abs(e->sum, e->sum);
  return mpq_cmp(e->sum, e->limit) <= 0;
}

/* Sets *takes to whether vertex v is to become one of the edge from z[k] on. */
static dyd_status edge_takes(bool *takes, edge_test *e, const tiling *t, const loose_ring *r, size_t k, dyd_xy v) {
  dyd_xy a = r->z[k], b = r->z[(k + 1) % r->count];
  *takes = false;
  if (same_place(v, a) || same_place(v, b) || !dyd_filter_near_edge(a, b, v, t->w.grid)) return DYD_OK;
  edge_test_set(e->a, a);
  edge_test_set(e->b, b);
  edge_test_set(e->v, v);
  if (!edge_goes_to(e, e->a, e->b) || !edge_goes_to(e, e->b, e->a)) return DYD_OK;
  if (r->across[k] == DYD_NONE) {
    *takes = (a.x == b.x && v.x == a.x) || (a.y == b.y && v.y == a.y);
    return DYD_OK;
  }
  dyd_status st = edge_test_site(e->p, t, r->site);
  if (st == DYD_OK) st = edge_test_site(e->q, t, r->across[k]);
  *takes = st == DYD_OK && bisector_meets(e, t->w.grid);
  return st;
}

/* Leads the edge from z[k] of ring `place` on through v, on the other side, too. */
static dyd_status split_edge(tiling *t, size_t place, size_t k, dyd_xy v) {
  loose_ring *r = &t->loose[place], *other;
  dyd_xy a = r->z[k], b = r->z[(k + 1) % r->count];
  uint32_t site = r->site, across = r->across[k];
  dyd_status st = ring_insert(r, k, v);
  if (st != DYD_OK || across == DYD_NONE) return st;
  st = loosen_ring(&other, t, across);
  for (size_t l = 0; st == DYD_OK && l < other->count; l++)
    if (other->across[l] == site && same_place(other->z[l], b) && same_place(other->z[(l + 1) % other->count], a))
      return ring_insert(other, l, v);
  return st == DYD_OK ? DYD_E_RANGE : st;
}

/* Leads edges of the ring through its own vertices until none is left; *any: some were. */
static dyd_status settle_ring(bool *any, tiling *t, size_t place, edge_test *e) {
  dyd_status st = DYD_OK;
  t->loose[place].changed = false;
  for (size_t k = 0; k < t->loose[place].count && st == DYD_OK; k++)
    for (size_t v = 0; v < t->loose[place].count && st == DYD_OK; v++) {
      bool takes;
      dyd_xy z = t->loose[place].z[v];
      st = edge_takes(&takes, e, t, &t->loose[place], k, z);
      if (st != DYD_OK || !takes) continue;
      st = split_edge(t, place, k, z);
      *any = true;
      v = (size_t)-1; /* the edge is a shorter one now */
    }
  return st;
}

static dyd_status settle_all(tiling *t) {
  edge_test e;
  bool any = true;
  dyd_status st = DYD_OK;
  edge_test_each(&e, mpq_init);
  while (any && st == DYD_OK) {
    any = false;
    for (size_t k = 0; k < t->loose_count && st == DYD_OK; k++) {
      if (dyd_flag_is_set(t->w.cancel)) st = DYD_CANCELLED;
      if (st == DYD_OK && t->loose[k].changed) st = settle_ring(&any, t, k, &e);
    }
  }
  edge_test_each(&e, mpq_clear);
  return st;
}

/* Appends the loops of the ring: each is cut out where it comes back to a vertex. */
static dyd_status append_loops(tiling *t, const loose_ring *r, const double bound[2]) {
  DYD_FREED dyd_xy *open = dyd_alloc(r->count + 1, sizeof *open);
  size_t n = 0;
  dyd_status st = open ? DYD_OK : DYD_E_NOMEM;
  for (size_t k = 0; k <= r->count && st == DYD_OK && r->count; k++) {
    dyd_xy z = r->z[k % r->count];
    size_t from = 0;
    bool good = true;
    while (from < n && !same_place(open[from], z)) from++;
    if (n - from >= 3) {
      st = ring_is_good(&good, t, open + from, n - from);
      if (st == DYD_OK && !good) st = DYD_E_RANGE;
      if (st == DYD_OK) st = measure_ring(t, r->site, open + from, n - from, bound);
    }
    n = from;
    open[n++] = z;
  }
  return st;
}

/* ---- most cells at once ----
 *
 * The vertices of the diagram of exact points are the circumcentres of all triangles, also where four sites share a
 * circle with others. Each is found once; then cells whose vertices are all inside W are walked around, in the order of
 * the mesh. */

/* count = 0: to be made as a shape. Its ring is that of the tiles from vertex `first` on. */
typedef struct quick_tile {
  size_t first, count;
  double area, bound[2];
} quick_tile;

static dyd_status find_centres(const tiling *t) {
  const dyd_mesh *m = &t->pd->sk.mesh;
  dyd_status st = DYD_OK;
  for (uint32_t k = 0; k < m->count && st == DYD_OK; k++) {
    dyd_grid_centre *c = &t->centre[k];
    c->error = (double)NAN;
    if (dyd_is_ghost_triangle(m, k) || dyd_filter_grid_centre(c, t->pd, k, &t->w, t->scale)) continue;
    st = dyd_shape_centre(&c->z, t->pd, k, &t->w);
    c->error = t->out->rounding;
  }
  return st;
}

/* The ring of mesh vertex v: its vertices; 0: not all are known, or they are too many for so quick a look. */
enum { QUICK_VERTICES = 64 };
static size_t quick_ring(dyd_xy ring[QUICK_VERTICES], double bound[2], const tiling *t, uint32_t v) {
  const dyd_grid_centre *at[QUICK_VERTICES];
  const dyd_skeleton *sk = &t->pd->sk;
  dyd_half_edge first = sk->leaving[v], h = first;
  size_t n = 0;
  if (first == DYD_NONE) return 0;
  do {
    const dyd_grid_centre *z = &t->centre[dyd_edge_triangle(h)];
    if (n == QUICK_VERTICES || isnan(z->error)) return 0;
    at[n++] = z;
    h = dyd_edge_turn(&sk->mesh, h);
  } while (h != first);
  return n < 3 ? 0 : dyd_filter_tile(ring, bound, at, n, &t->w, t->scale);
}

static dyd_status find_quick_tiles(tiling *t) {
  const dyd_skeleton *sk = &t->pd->sk;
  dyd_xy ring[QUICK_VERTICES];
  size_t vertices = 0;
  if (sk->mesh.no_filter || sk->mesh.collinear) return DYD_OK;
  t->scale = ldexp(1, t->w.grid);
  t->centre = dyd_alloc(sk->mesh.count, sizeof *t->centre);
  t->quick = calloc(sk->n + 1, sizeof *t->quick);
  dyd_status st = t->centre && t->quick ? find_centres(t) : DYD_E_NOMEM;
  for (uint32_t v = 0; v < sk->n && st == DYD_OK; v++) {
    quick_tile *q = &t->quick[sk->reps.site[v]];
    size_t n = quick_ring(ring, q->bound, t, v);
    if ((v & 4095) == 0 && dyd_flag_is_set(t->w.cancel)) st = DYD_CANCELLED;
    if (n < 3 || !dyd_filter_is_convex(ring, n)) continue;
    vertices += q->count = n;
    st = ring_area(&q->area, t, ring, n);
  }
  return st == DYD_OK && !reserve_rings(t, sk->n, vertices) ? DYD_E_NOMEM : st;
}

/* Once it is known where the rings begin. */
static void fill_quick_tiles(tiling *t) {
  const dyd_skeleton *sk = &t->pd->sk;
  dyd_xy ring[QUICK_VERTICES];
  double bound[2];
  for (uint32_t v = 0; t->quick && !t->areas_only && v < sk->n; v++) {
    uint32_t site = sk->reps.site[v];
    const quick_tile *q = &t->quick[site];
    if (!q->count || sk->leaving[v] == DYD_NONE || (t->loose_of && t->loose_of[site])) continue;
    size_t n = quick_ring(ring, bound, t, v);
    memcpy(&t->out->xy[2 * q->first], ring, n * sizeof *ring);
  }
}

/* ---- all ---- */

static bool tile_is_loose(const tiling *t, uint32_t i) {
  return t->loose_of && t->loose_of[i];
}

/* The tile of site i, unless its ring is loose, or becomes so. last: no more rings become loose. */
static dyd_status find_tile(tiling *t, uint32_t i, bool last) {
  dyd_shape *s = &t->shape;
  bool good;
  quick_tile *q = t->quick ? &t->quick[i] : NULL;
  if (q && q->count && !tile_is_loose(t, i)) {
    q->first = t->vertices;
    return append_ring(t, i, NULL, q->count, q->area, q->bound);
  }
  dyd_status st = dyd_shape_find(s, t->pd, i, &t->w, 0);
  if (st != DYD_OK) return st;
  if (!s->exact) return DYD_E_RANGE;
  double bound[2] = {s->area[0], s->area[1]};
  if (last && tile_is_loose(t, i)) return append_loops(t, &t->loose[t->loose_of[i] - 1], bound);
  st = ring_is_good(&good, t, s->inner, s->inner_count);
  if (st != DYD_OK) return st;
  if (!good) {
    loose_ring *r;
    return last ? DYD_E_RANGE : loosen_ring(&r, t, i);
  }
  return s->inner_count < 3 ? DYD_OK : measure_ring(t, i, s->inner, s->inner_count, bound);
}

static dyd_status find_tiles(tiling *t, bool last) {
  dyd_status st = DYD_OK;
  size_t n = dyd_sites_count(dyd_delaunay_sites(t->pd));
  t->out->count = t->out->coincident = t->vertices = 0;
  for (uint32_t i = 0; i < n && st == DYD_OK; i++) {
    if (dyd_delaunay_alias(t->pd, i) == i)
      st = find_tile(t, i, last);
    else
      t->out->coincident++;
  }
  return st;
}

static dyd_status keep_bound(void *context, uint32_t i, const dyd_shape *shape, const double area[2]) {
  double *bound = context;
  (void)shape;
  bound[2 * (size_t)i] = area[0];
  bound[2 * (size_t)i + 1] = area[1];
  return DYD_OK;
}

/* Bounds the areas of the true cells, and the undetermined part of the diagram. */
static dyd_status bound_areas(double *bound, dyd_voronoi_bounds *bounds, const dyd_delaunay *pd, const dyd_rect *window,
                              int64_t bits, bool discs, const volatile int *cancel) {
  DYD_SCOPED(dyd_voronoi_sums) sums;
  dyd_status st = dyd_voronoi_sums_init(&sums, pd, window, bits);
  sums.cancel = cancel;
  sums.discs = discs;
  if (st == DYD_OK) st = dyd_voronoi_sums_all(&sums, keep_bound, bound);
  if (st == DYD_OK && bounds) st = dyd_voronoi_sums_bounds(bounds, &sums);
  return st;
}

/* Exact points leave nothing open. */
static dyd_status bound_nothing(dyd_voronoi_bounds *bounds) {
  dyd_status st = dyd_dyadic_set_si_2exp(&bounds->area, 0, 0);
  bounds->finite = true;
  return st == DYD_OK ? dyd_dyadic_set_si_2exp(&bounds->hausdorff, 0, 0) : st;
}

/* t->pd is there, of pd's own sites or of their centres. */
static dyd_status tile_all(tiling *t, dyd_voronoi_bounds *bounds, const dyd_delaunay *pd, const dyd_rect *window,
                           int64_t bits, const volatile int *cancel) {
  size_t n = dyd_sites_count(dyd_delaunay_sites(pd));
  dyd_status st = dyd_window_init(&t->w, window);
  if (st != DYD_OK) return st;
  dyd_window_set_grid(&t->w, COARSEST);
  t->w.cancel = cancel;
  if (!t->w.exact) return DYD_E_RANGE;
  t->out->rounding = ldexp(1, -t->w.grid - 1);
  if (t->pd == pd) {
    if (bounds) st = bound_nothing(bounds);
  } else {
    t->bound = calloc(2 * n + 1, sizeof *t->bound);
    st = t->bound ? bound_areas(t->bound, bounds, pd, window, bits, t->discs, cancel) : DYD_E_NOMEM;
  }
  if (st == DYD_OK) st = find_quick_tiles(t);
  if (st == DYD_OK) st = find_tiles(t, false);
  if (st == DYD_OK && t->loose_count) st = settle_all(t);
  if (st == DYD_OK && t->loose_count) st = find_tiles(t, true);
  if (st == DYD_OK) fill_quick_tiles(t);
  return st;
}

static void tiling_clear(tiling *t) {
  for (size_t k = 0; k < t->loose_count; k++) {
    dyd_free_all(t->loose[k].z, t->loose[k].across);
  }
  dyd_free_all(t->loose, t->loose_of, t->quick, t->centre, t->bound);
  dyd_shape_clear(&t->shape);
}

dyd_status dyd_tiles_find(dyd_tiles *out, dyd_voronoi_bounds *bounds, const dyd_delaunay *pd, const dyd_rect *window,
                          int64_t bits, bool areas_only, bool discs, const volatile int *cancel) {
  dyd_tiles made = {0};
  dyd_sites *sites = NULL;
  dyd_delaunay *centres = NULL;
  DYD_SCOPED(tiling) t = {.out = &made, .pd = pd, .areas_only = areas_only, .discs = discs};
  dyd_status st = DYD_OK;
  if (!pd->sk.all_points) {
    st = tiling_of_centres(&sites, &centres, dyd_delaunay_sites(pd), cancel);
    t.pd = centres;
  }
  if (st == DYD_OK) st = tile_all(&t, bounds, pd, window, bits, cancel);
  dyd_delaunay_free(centres);
  dyd_sites_free(sites);
  dyd_tiles_clear(st == DYD_OK ? out : &made);
  if (st == DYD_OK) *out = made;
  return st;
}

dyd_status dyd_voronoi_tiles(dyd_tiles *out, const dyd_delaunay *pd, const dyd_rect *window, int64_t bits,
                             const volatile int *cancel) {
  if (!out || !pd || !window) return DYD_E_ARG;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  return dyd_tiles_find(out, NULL, pd, window, bits, false, false, cancel);
}
