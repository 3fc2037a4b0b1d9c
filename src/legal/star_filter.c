/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certifying most edges in doubles, from stars only.
 *
 * [FLT-STAR] Let p_k be the representatives, R_k within E of p_k for all k but a few "fat" ones. Let c be any point,
 * rho >= |c-p_i|, |c-p_j|. The vertices of a Delaunay triangulation inside a disc about c span a connected subgraph,
 * since from any of them a neighbour strictly nearer to c exists until a nearest one is reached, and the nearest ones
 * are the corners of one empty circle. So if no Delaunay neighbour of i or of j other than i, j lies within rho + 2E of
 * c, then no vertex does, hence for every k that is not fat ds_k(c) >= |c-p_k| - E > rho + E >= dl_i(c), dl_j(c); the
 * fat ones are asked through a tree of their own: c is a witness. The hull in the same way: if v is farther than all
 * its neighbours by 2E in the direction u, then it is farther than all vertices by 2E.
 *
 * Bounds: distances as in skeleton/rects_filter.h; representatives that are not doubles are off by delta, E grows by
 * 3 delta. The centres need no bound: any double will do. Both ends of an edge use the same bits for c and rho. */
#include "legal/star_filter.h"

#include "base/alloc.h"
#include "base/index.h"
#include "base/local.h"
#include "skeleton/centre_filter.h"
#include "skeleton/mesh_filter.h"

#include <float.h>
#include <math.h>

/* ---- ranges of triangles, and the lists of edges between them ---- */

void dyd_mark_later(dyd_marks *m, dyd_half_edge h) {
  if (DYD_GROW(m->edge, m->cap, m->count + 1))
    m->edge[m->count++] = h;
  else
    m->status = DYD_E_NOMEM;
}

void dyd_mark(dyd_marks *m, dyd_skeleton *sk, dyd_half_edge h) {
  uint32_t other = dyd_edge_triangle(dyd_edge_twin(&sk->mesh, h));
  if (other >= m->first && other < m->end)
    dyd_set_certain(sk, h, true);
  else
    dyd_mark_later(m, h);
}

dyd_status dyd_marks_settle(dyd_marks *marks, size_t ranges, dyd_skeleton *sk, bool certain) {
  dyd_status st = DYD_OK;
  for (dyd_marks *m = marks; m < marks + ranges; m++) {
    for (size_t q = 0; q < m->count; q++) dyd_set_certain(sk, m->edge[q], certain);
    if (st == DYD_OK) st = m->status;
    free(m->edge);
  }
  return st;
}

/* The first pass over the edges of thin rectangles: most are certain by the two triangles next to them [WIT-NEAR].
 * Those whose triangles a fat one meets are left to the next pass [WIT-FAT].
 *
 * The distance m to the nearest representatives is first bounded for all vertices at once: `most` for vertices that
 * have no shorter skeleton edge (found by one pass over the edges), the least edge of all for the others. */

enum { BATCH = 240 };

typedef struct near_pass {
  dyd_skeleton *sk;
  double reach, least, most;
  const uint32_t *met; /* triangles whose edges are left to later passes: not 0. NULL: none */
  uint8_t *close;      /* of each vertex: it has an edge shorter than `most` */
  dyd_marks marks[DYD_RANGES_MOST];
  double shortest2[DYD_RANGES_MOST]; /* in each range */
} near_pass;

double dyd_short_edge(const dyd_mesh *m) {
  enum { SAMPLE = 4096, SHARE = 200 };
  double shortest2[SAMPLE / SHARE + 1]; /* ascending */
  uint32_t sample = m->count < SAMPLE ? m->count : SAMPLE, rank = sample / SHARE, found = 0;
  for (uint32_t s = 0; s < sample; s++) {
    const uint32_t *v = m->tri[(uint64_t)s * m->count / sample].v;
    double d = dyd_square_distance(m->xy[v[s % 3]], m->xy[v[dyd_next(s % 3)]]);
    if (!(d < DBL_MAX) || (found > rank && d >= shortest2[rank])) continue; /* a ghost edge, or a longer one */
    uint32_t at = found <= rank ? found++ : rank;
    for (; at && shortest2[at - 1] > d; at--) shortest2[at] = shortest2[at - 1];
    shortest2[at] = d;
  }
  return found ? sqrt(shortest2[found - 1]) : 0;
}

/* Several tasks may say the same of one vertex at once. */
static void set_close(const near_pass *p, uint32_t v) {
  if (!__atomic_load_n(&p->close[v], __ATOMIC_RELAXED)) __atomic_store_n(&p->close[v], 1, __ATOMIC_RELAXED);
}

/* Least edge, and the vertices that have a short one. Ghost edges are NaN and change nothing. */
static void measure_range(void *context, size_t number, size_t begin, size_t end) {
  near_pass *p = context;
  const dyd_mesh *m = &p->sk->mesh;
  double least2 = DBL_MAX, most2 = p->most * p->most;
  for (size_t t = begin; t < end; t++) {
    const uint32_t *v = m->tri[t].v;
    for (unsigned k = 0; k < 3; k++) {
      uint32_t a = v[k], b = v[dyd_next(k)];
      double d = dyd_square_distance(m->xy[a], m->xy[b]);
      if (d < least2) least2 = d;
      if (d < most2) set_close(p, a), set_close(p, b);
    }
  }
  p->shortest2[number] = least2;
}

static void measure_edges(near_pass *p, unsigned threads) {
  double least2 = DBL_MAX;
  size_t ranges = dyd_parallel_ranges(threads, p->sk->mesh.count, measure_range, p);
  for (size_t r = 0; r < ranges; r++)
    if (p->shortest2[r] < least2) least2 = p->shortest2[r];
  p->least = sqrt(least2);
  if (p->most < p->least) p->most = p->least;
}

static bool is_near(const near_pass *p, dyd_half_edge h) {
  const dyd_mesh *m = &p->sk->mesh;
  dyd_half_edge twin = dyd_edge_twin(m, h);
  uint32_t u = dyd_edge_apex(m, h), a = dyd_edge_apex(m, twin), i = dyd_edge_origin(m, h), j = dyd_edge_target(m, h);
  if (i == m->n || j == m->n) return false;
  if (p->met && (p->met[dyd_edge_triangle(h)] || p->met[dyd_edge_triangle(twin)])) return false;
  const dyd_xy *xy = m->xy;
  double nearest = p->close[i] || p->close[j] ? p->least : p->most;
  if (dyd_filter_edge_near(xy[i], xy[j], xy[u], xy[a], p->reach, nearest)) return true;
  if (u == m->n) return dyd_filter_hull_edge_near(xy[j], xy[i], xy[a], p->reach, nearest);
  return a == m->n && dyd_filter_hull_edge_near(xy[i], xy[j], xy[u], p->reach, nearest);
}

/* Three loops, so that memory answers in time: triangles, then points, then the decision. */
static void decide_batch(const near_pass *p, dyd_marks *range, const dyd_half_edge *edge, unsigned count) {
  const dyd_mesh *m = &p->sk->mesh;
  for (unsigned q = 0; q < count; q++) {
    __builtin_prefetch(&m->xy[dyd_edge_origin(m, edge[q])]);
    __builtin_prefetch(&m->xy[dyd_edge_target(m, edge[q])]);
    __builtin_prefetch(&m->xy[dyd_edge_apex(m, edge[q])]);
    __builtin_prefetch(&m->xy[dyd_edge_across(m, edge[q])]);
  }
  for (unsigned q = 0; q < count; q++)
    if (is_near(p, edge[q])) dyd_mark(range, p->sk, edge[q]);
}

static void near_of_range(void *context, size_t number, size_t begin, size_t end) {
  near_pass *p = context;
  const dyd_mesh *m = &p->sk->mesh;
  dyd_marks *range = &p->marks[number];
  dyd_half_edge edge[BATCH + 3];
  *range = (dyd_marks){.first = begin, .end = end};
  for (uint32_t t = (uint32_t)begin; t < end;) {
    unsigned count = 0;
    for (; t < end && count < BATCH; t++)
      for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++) {
        dyd_half_edge twin = dyd_edge_twin(m, h);
        __builtin_prefetch(&m->tri[dyd_edge_triangle(twin)]);
        edge[count] = h;
        count += twin > h;
      }
    decide_batch(p, range, edge, count);
  }
}

dyd_status dyd_certify_near(dyd_skeleton *sk, unsigned threads, double reach, const uint32_t *met, double most) {
  near_pass p = {.sk = sk, .met = met, .most = most, .reach = reach > 0x1p-300 ? reach : 0x1p-300};
  p.close = calloc((size_t)sk->mesh.n + 1, 1);
  if (!p.close) return DYD_E_NOMEM;
  measure_edges(&p, threads);
  size_t ranges = dyd_parallel_ranges(threads, sk->mesh.count, near_of_range, &p);
  free(p.close);
  return dyd_marks_settle(p.marks, ranges, sk, true);
}

enum { MAX_DEGREE = 62, LONG = 256 };

typedef struct pass {
  dyd_skeleton *sk;
  uint8_t *open; /* of each vertex: it has an edge, real or ghost, that is not certain yet */
  dyd_marks marks[DYD_RANGES_MOST];
  double edge;  /* nearly all edges are longer */
  double limit; /* radius above which a rectangle is fat */
  double reach; /* 2 E */
  dyd_tree fat;
} pass;

/* ---- radii ---- */

static double star_radius(const dyd_skeleton *sk, uint32_t v) {
  dyd_xy p = sk->reps.xy[v];
  dyd_bbox c = {{p.x, p.x, p.y, p.y}};
  return sqrt(dyd_dl2_upper(&c, &sk->rects.box[v])) * DYD_UP_FACTOR + DYD_TINY;
}

/* Four times the median radius of a sample, or more while nearly all edges are long compared with it: a larger
 * rectangle counts as fat. */
static double ordinary_radius(const pass *p) {
  const dyd_skeleton *sk = p->sk;
  double sample[256];
  size_t count = 0, step = sk->n / 256 + 1;
  for (size_t v = 0; v < sk->n && count < 256; v += step) sample[count++] = star_radius(sk, (uint32_t)v);
  qsort(sample, count, sizeof *sample, dyd_compare_double);
  return fmax(4 * sample[count / 2], p->edge / LONG);
}

static dyd_status gather_fat(pass *p) {
  const dyd_skeleton *sk = p->sk;
  double largest = 0;
  uint32_t *fat = NULL;
  size_t count = 0, cap = 0;
  p->limit = ordinary_radius(p);
  for (uint32_t v = 0; v < sk->n; v++) {
    double r = star_radius(sk, v);
    if (r <= p->limit)
      largest = dyd_max(largest, r);
    else if (!DYD_GROW(fat, cap, count + 1))
      return free(fat), DYD_E_NOMEM;
    else
      fat[count++] = v;
  }
  p->reach = 2 * (largest + 3 * sk->reps.delta);
  return dyd_tree_init(&p->fat, fat, (uint32_t)count, sk->rects.box);
}

/* ---- fat rectangles ---- */

typedef struct fat_query {
  uint32_t i, j;
  bool met;
} fat_query;

static bool fat_met(void *context, uint32_t k) {
  fat_query *q = context;
  if (k == q->i || k == q->j) return true;
  q->met = true;
  return false;
}

static bool fat_near(const pass *p, dyd_xy c, double radius_upper, uint32_t i, uint32_t j) {
  fat_query q = {i, j, false};
  dyd_bbox at = {{c.x, c.x, c.y, c.y}};
  double radius2 = dyd_upper(radius_upper * radius_upper);
  if (p->fat.count) dyd_tree_near(&p->fat, &at, &radius2, fat_met, &q);
  return q.met;
}

static bool is_fat(const pass *p, uint32_t v) {
  return p->fat.count && !(star_radius(p->sk, v) <= p->limit);
}

/* ---- one star ---- */

typedef struct star {
  uint32_t v;
  int degree, ghost;              /* ghost: place of the ghost among the neighbours, -1: none */
  dyd_half_edge edge[MAX_DEGREE]; /* out of v; to neighbour q */
  double x[MAX_DEGREE], y[MAX_DEGREE];
  dyd_xy centre[MAX_DEGREE];
} star;

static bool read_star(star *s, const pass *p, uint32_t v) {
  const dyd_mesh *m = &p->sk->mesh;
  dyd_half_edge first = p->sk->leaving[v];
  s->v = v;
  s->degree = 0;
  s->ghost = -1;
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(m, h, first)) {
    if (s->degree == MAX_DEGREE) return false;
    uint32_t w = dyd_edge_target(m, h);
    if (w == m->n) s->ghost = s->degree;
    s->edge[s->degree] = h;
    s->x[s->degree] = m->xy[w].x;
    s->y[s->degree] = m->xy[w].y;
    s->centre[s->degree] = dyd_triangle_centre(m, dyd_edge_triangle(h));
    s->degree++;
  }
  return true;
}

/* Returns true if all neighbours but q and the ghost are farther from c than sqrt(limit). */
static bool others_farther(const star *s, int q, dyd_xy c, double limit) {
  int near = 0;
  for (int k = 0; k < s->degree; k++) {
    double dx = s->x[k] - c.x, dy = s->y[k] - c.y;
    near += !(dyd_lower(dx * dx + dy * dy) > limit);
  }
  /* q itself and the ghost (NaN) count as near */
  double dx = s->x[q] - c.x, dy = s->y[q] - c.y;
  int self = !(dyd_lower(dx * dx + dy * dy) > limit);
  return near == self + (s->ghost >= 0);
}

/* Neighbours that share a triangle may be in different tasks. No task reads these marks before all are made. */
static void star_mark(dyd_skeleton *sk, dyd_half_edge h) {
  (void)__atomic_fetch_or(&sk->certain[dyd_edge_triangle(h)], (uint8_t)(1u << dyd_edge_corner(h)), __ATOMIC_RELAXED);
}

static void certify_edges(const pass *p, const star *s) {
  dyd_xy v = p->sk->reps.xy[s->v];
  for (int q = 0; q < s->degree; q++) {
    if (q == s->ghost) continue;
    dyd_xy a = s->centre[q], b = s->centre[q ? q - 1 : s->degree - 1];
    dyd_xy c = {(a.x + b.x) * 0.5, (a.y + b.y) * 0.5};
    double ix = v.x - c.x, iy = v.y - c.y, jx = s->x[q] - c.x, jy = s->y[q] - c.y;
    double rho = sqrt(dyd_upper(dyd_max(ix * ix + iy * iy, jx * jx + jy * jy))) * DYD_UP_FACTOR;
    double wide = (rho + p->reach) * DYD_UP_FACTOR;
    if (!others_farther(s, q, c, dyd_upper(wide * wide))) continue;
    uint32_t j = dyd_edge_target(&p->sk->mesh, s->edge[q]);
    if (p->fat.count && (is_fat(p, j) || fat_near(p, c, wide, s->v, j))) continue;
    star_mark(p->sk, s->edge[q]);
  }
}

static void certify_hull(const pass *p, const star *s) {
  int next = (s->ghost + 1) % s->degree, before = (s->ghost + s->degree - 1) % s->degree;
  dyd_xy v = p->sk->reps.xy[s->v];
  double ux = s->y[next] - s->y[before], uy = s->x[before] - s->x[next];
  double need = p->reach * sqrt(dyd_upper(ux * ux + uy * uy)) * DYD_UP_FACTOR;
  if (p->fat.count) return;
  for (int k = 0; k < s->degree; k++) {
    if (k == s->ghost) continue;
    double a = ux * (v.x - s->x[k]), b = uy * (v.y - s->y[k]);
    if (!(a + b > need + 8 * 0x1p-53 * (fabs(a) + fabs(b)) + DYD_TINY)) return;
  }
  star_mark(p->sk, s->edge[s->ghost]);
  star_mark(p->sk, dyd_edge_twin(&p->sk->mesh, s->edge[s->ghost]));
}

/* ---- the pass ---- */

/* An edge is certain when both its ends found their stars clear; a half alone is revoked, where the other half is. */
static void join_halves(void *context, size_t number, size_t begin, size_t end) {
  pass *p = context;
  const dyd_skeleton *sk = p->sk;
  for (uint32_t t = (uint32_t)begin; t < end; t++)
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t) && !dyd_triangle_is_certain(sk, t); h++)
      if (!dyd_edge_is_certain(sk, h) && dyd_edge_is_certain(sk, dyd_edge_twin(&sk->mesh, h)))
        dyd_mark_later(&p->marks[number], h);
}

static void certify_star(const pass *p, star *s, uint32_t v) {
  if (p->sk->leaving[v] == DYD_NONE || !p->open[v] || is_fat(p, v) || !read_star(s, p, v)) return;
  certify_edges(p, s);
  if (s->ghost >= 0) certify_hull(p, s);
}

static void stars_of_range(void *context, size_t number, size_t begin, size_t end) {
  const pass *p = context;
  star s;
  (void)number;
  for (size_t v = begin; v < end; v++) certify_star(p, &s, (uint32_t)v);
}

/* Several tasks may say the same of one vertex at once. */
static void find_open(void *context, size_t number, size_t begin, size_t end) {
  pass *p = context;
  const dyd_mesh *m = &p->sk->mesh;
  (void)number;
  for (uint32_t t = (uint32_t)begin; t < end; t++)
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t) && !dyd_triangle_is_certain(p->sk, t); h++) {
      uint32_t v = dyd_edge_origin(m, h), w = dyd_edge_target(m, h);
      if (dyd_edge_is_certain(p->sk, h)) continue;
      if (v != m->n) __atomic_store_n(&p->open[v], 1, __ATOMIC_RELAXED);
      if (w != m->n) __atomic_store_n(&p->open[w], 1, __ATOMIC_RELAXED);
    }
}

static dyd_status pass_over_stars(pass *p, unsigned threads) {
  const uint32_t triangles = p->sk->mesh.count;
  dyd_parallel_ranges(threads, triangles, find_open, p);
  dyd_parallel_ranges(threads, p->sk->n, stars_of_range, p);
  size_t ranges = dyd_parallel_ranges(threads, triangles, join_halves, p);
  return dyd_marks_settle(p->marks, ranges, p->sk, false);
}

/* The first pass, where fat rectangles do not spoil it [WIT-FAT]. */
static dyd_status certify_thin(const pass *p, unsigned threads) {
  DYD_FREED uint32_t *met = NULL;
  if (p->sk->reps.code) return DYD_OK;
  dyd_status st = dyd_fat_meet(&met, p->sk, p->fat.item, p->fat.count, p->reach / 2);
  if (st == DYD_OK && (met || p->fat.count == 0)) st = dyd_certify_near(p->sk, threads, p->reach / 2, met, p->edge);
  return st;
}

dyd_status dyd_certify_stars(dyd_skeleton *sk, unsigned threads) {
  pass p = {.sk = sk, .edge = dyd_short_edge(&sk->mesh)};
  dyd_status st = gather_fat(&p);
  if (st == DYD_OK) st = certify_thin(&p, threads);
  if (st == DYD_OK && !DYD_ZEROED(p.open, (size_t)sk->n + 1)) st = DYD_E_NOMEM;
  if (st == DYD_OK) st = pass_over_stars(&p, threads);
  free(p.open);
  dyd_tree_clear(&p.fat);
  return st;
}
