/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sites that a pair needs, and the others near a place. */
#include "base/alloc.h"
#include "rect/rect.h"
#include "tolerance/state.h"

#include <fenv.h>
#include <math.h>

enum { AHEAD = 8 };

/* ---- preparation ---- */

/* *low = the coordinate minus its double, rounded. */
static double low_part(dyd_interval *side, double high, mpq_ptr q, mpq_ptr d) {
  dyd_interval_get_q(q, d, side);
  mpq_set_d(d, high);
  mpq_sub(q, q, d);
  return mpq_get_d(q);
}

/* Low parts where doubles do not hold the points; one is off by less than 2^-52 of itself, so by 2^-105 of the
 * coordinate, or by a subnormal number. */
static dyd_status find_low_parts(dyd_tolerance *t) {
  const dyd_skeleton *sk = t->sk;
  double most = 0;
  if (dyd_sites_all_in_doubles(sk->reps.sites)) return DYD_OK;
  t->low = dyd_alloc(sk->n + 1, sizeof *t->low);
  if (!t->low) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_rect, r);
  DYD_LOCAL_NUMBERS(mpq, q, d);
  for (uint32_t v = 0; v < sk->n && st == DYD_OK; v++) {
    dyd_xy at = sk->reps.xy[v];
    t->low[v] = (dyd_xy){0, 0};
    most = fmax(most, fmax(fabs(at.x), fabs(at.y)));
    if (dyd_sites_in_doubles(sk->reps.sites, sk->reps.site[v]) || !isfinite(at.x) || !isfinite(at.y)) continue;
    st = dyd_sites_get(&r, sk->reps.sites, sk->reps.site[v]);
    if (st == DYD_OK) t->low[v] = (dyd_xy){low_part(&r.x, at.x, q, d), low_part(&r.y, at.y, q, d)};
  }
  t->low[sk->n] = (dyd_xy){0, 0};
  t->points.low = t->low;
  t->points.slack = most * 0x1p-100 + 0x1p-1000;
  return st;
}

/* Counter-clockwise, in the order of the vertices. */
static void fill_near(dyd_tolerance *t) {
  const dyd_mesh *m = &t->sk->mesh;
  const uint32_t *site = t->sk->reps.site;
  uint32_t count = 0;
  for (uint32_t v = 0; v < m->n; v++) {
    dyd_half_edge first = t->sk->leaving[v];
    t->start[v] = count;
    if (v + AHEAD < m->n && t->sk->leaving[v + AHEAD] != DYD_NONE)
      __builtin_prefetch(&m->tri[dyd_edge_triangle(t->sk->leaving[v + AHEAD])]);
    for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(m, h, first)) {
      uint32_t w = t->near[count] = dyd_edge_target(m, h);
      t->own[count++] = w != m->n && dyd_edge_is_certain(t->sk, h) && site[v] < site[w];
    }
  }
  t->start[m->n] = count;
}

static dyd_status list_near(dyd_tolerance *t) {
  const dyd_mesh *m = &t->sk->mesh;
  if (dyd_is_line(t->pd)) return DYD_OK;
  t->start = dyd_alloc((size_t)m->n + 1, sizeof *t->start);
  t->near = dyd_alloc(3 * (size_t)m->count, sizeof *t->near); /* a corner of a triangle has one neighbour more */
  t->own = dyd_alloc(3 * (size_t)m->count, sizeof *t->own);
  if (!t->start || !t->near || !t->own) return DYD_E_NOMEM;
  fill_near(t);
  return DYD_OK;
}

/* Of each site: the low parts, its neighbours twice over, where its rows begin, its radius and its weight. */
static bool near_has_room(dyd_tolerance *t) {
  uint64_t each =
      sizeof *t->low + sizeof *t->start + 6 * (sizeof *t->near + sizeof *t->own) + sizeof(size_t) + 3 * sizeof(double);
  uint64_t bytes = dyd_bytes_times(t->sk->n, each);
  if (!dyd_memory_has(&t->memory, bytes, "the neighbours of the points")) return false;
  t->memory.held += bytes;
  return true;
}

dyd_status dyd_near_prepare(dyd_tolerance *t) {
  if (!near_has_room(t)) return DYD_E_NOMEM;
  t->points = (dyd_points_d){.xy = t->sk->reps.xy, .usable = fegetround() == FE_TONEAREST};
  dyd_status st = find_low_parts(t);
  return st == DYD_OK ? list_near(t) : st;
}

void dyd_near_clear(dyd_tolerance *t) {
  if (t->has_tree) dyd_tree_clear(&t->tree);
  dyd_free_all(t->listed, t->box, t->start, t->near, t->own, t->low, t->others.vertex);
}

dyd_status dyd_near_index(dyd_tolerance *t) {
  const dyd_skeleton *sk = t->sk;
  if (t->has_tree) return DYD_OK;
  uint32_t *item = dyd_alloc(sk->n, sizeof *item), count = 0;
  if (!t->box) t->box = dyd_alloc(sk->n, sizeof *t->box);
  if (!t->listed) t->listed = calloc((size_t)sk->n + 1, sizeof *t->listed);
  if (!item || !t->box || !t->listed) {
    free(item);
    return DYD_E_NOMEM;
  }
  for (uint32_t v = 0; v < sk->n; v++) {
    dyd_sites_get_d(t->box[v].e, sk->reps.sites, sk->reps.site[v]);
    if (dyd_mesh_alias(&sk->mesh, v) == DYD_NONE) item[count++] = v;
  }
  dyd_status st = dyd_tree_init(&t->tree, item, count, t->box);
  t->has_tree = st == DYD_OK;
  if (st != DYD_OK) dyd_tree_clear(&t->tree);
  return st;
}

/* ---- others ---- */

bool dyd_others_add(dyd_others *o, uint32_t v) {
  if (!DYD_GROW(o->vertex, o->cap, o->count + 1)) return false;
  o->vertex[o->count++] = v;
  return true;
}

static bool add_ring(dyd_others *o, const dyd_tolerance *t, uint32_t v, uint32_t w) {
  for (uint32_t q = t->start[v]; q < t->start[v + 1]; q++)
    if (t->near[q] != w && t->near[q] != t->sk->mesh.n && !dyd_others_add(o, t->near[q])) return false;
  return true;
}

/* On a line: one before, one behind. */
static bool add_along(dyd_others *o, const dyd_line *l, uint32_t v, uint32_t w) {
  uint32_t a = l->rank[v] < l->rank[w] ? l->rank[v] : l->rank[w], b = l->rank[v] + l->rank[w] - a;
  return (a == 0 || dyd_others_add(o, l->order[a - 1])) && (b + 1 == l->count || dyd_others_add(o, l->order[b + 1]));
}

dyd_status dyd_others_around(dyd_others *o, const dyd_tolerance *t, uint32_t v, uint32_t w, uint32_t most) {
  bool good = true;
  o->count = 0;
  if (dyd_is_line(t->pd)) return add_along(o, &t->sk->line, v, w) ? DYD_OK : DYD_E_NOMEM;
  if (dyd_degree(t, v) <= most) good = add_ring(o, t, v, w);
  if (dyd_degree(t, w) <= most) good = good && add_ring(o, t, w, v);
  dyd_half_edge h = dyd_degree(t, v) <= dyd_degree(t, w) ? dyd_find_edge(t->sk, v, w) : dyd_find_edge(t->sk, w, v);
  if (h == DYD_NONE) return good ? DYD_OK : DYD_E_NOMEM;
  uint32_t apex[2] = {dyd_edge_apex(&t->sk->mesh, h), dyd_edge_across(&t->sk->mesh, h)};
  for (int k = 0; k < 2; k++) good = good && (apex[k] == t->sk->mesh.n || dyd_others_add(o, apex[k]));
  return good ? DYD_OK : DYD_E_NOMEM;
}

/* ---- nearer vertices ---- */

typedef struct gather {
  dyd_others *others;
  const bool *listed; /* by vertex */
  uint32_t i, j;
  size_t most, added;
  bool failed;
} gather;

static bool gather_new(void *context, uint32_t v) {
  gather *g = context;
  if (v == g->i || v == g->j) return true;
  if (g->listed[v]) return true;
  g->failed = !dyd_others_add(g->others, v);
  return !g->failed && ++g->added < g->most;
}

/* Towards an end only how far out counts: the direction is p J', in doubles. */
static void gather_beyond(gather *g, const dyd_tolerance *t) {
  const dyd_summit *s = &t->summit;
  const dyd_lines *l = &t->lines;
  double x = mpz_get_d(l->jy) * -mpz_sgn(s->at.p), y = mpz_get_d(l->jx) * mpz_sgn(s->at.p), size = hypot(x, y);
  const double *b = t->box[l->item[s->a].vertex].e;
  if (!isfinite(size)) size = x = y = 0; /* beyond doubles: all are visited */
  double ux = size > 0 ? x / size : 0, uy = size > 0 ? y / size : 0;
  double height = ux * b[ux > 0 ? 0 : 1] + uy * b[uy > 0 ? 2 : 3];
  /* u is off by less than 2^-50, which counts by how far along the line another point may lie */
  height -= 0x1p-48 * (t->sk->mesh.extent[0] + t->sk->mesh.extent[1] + fabs(height));
  dyd_tree_beyond(&t->tree, ux, uy, &height, gather_new, g);
}

dyd_status dyd_others_nearer(bool *more, dyd_others *o, dyd_tolerance *t, uint32_t i, uint32_t j, size_t most) {
  const dyd_lines *l = &t->lines;
  gather g = {.others = o, .i = i, .j = j, .most = most < l->count ? l->count : most};
  dyd_bbox c;
  double radius2;
  dyd_status st = dyd_near_index(t);
  if (st != DYD_OK) return st;
  g.listed = t->listed;
  o->count = 0;
  for (size_t k = 0; k < l->count; k++)
    if (!dyd_others_add(o, l->item[k].vertex)) return DYD_E_NOMEM;
  for (size_t k = 0; k < l->count; k++) t->listed[l->item[k].vertex] = true;
  if (dyd_summit_disc(c.e, &radius2, &t->summit, &t->lines))
    dyd_tree_near(&t->tree, &c, &radius2, gather_new, &g);
  else
    gather_beyond(&g, t);
  for (size_t k = 0; k < l->count; k++) t->listed[l->item[k].vertex] = false;
  *more = g.added > 0;
  return g.failed ? DYD_E_NOMEM : DYD_OK;
}
