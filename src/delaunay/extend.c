/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact points put into a triangulation of exact points.
 *
 * The triangles whose circle holds the new point are replaced by those around it. What is undecided are polygons on one
 * circle and chains on one line (ties.h). One that the new point is in, or on the circle or line of, is taken out
 * before; then the edges of the triangles around the point are decided, and what is undecided there is found again
 * [LOC-5]. */
#include "delaunay/extend.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "delaunay/ties.h"
#include "legal/certify.h"
#include "skeleton/mesh_build.h"
#include "skeleton/predicates.h"

#include <string.h>

/* hole: the triangles whose circle the point is in. */
typedef struct extension {
  dyd_delaunay *pd;
  dyd_work *w;
  uint32_t *hole;
  size_t count, cap;
} extension;

static bool hole_has(const extension *x, uint32_t t) {
  for (size_t k = 0; k < x->count; k++)
    if (x->hole[k] == t) return true;
  return false;
}

/* Finds the hole around v from t on, and takes out the faces in it, and those whose circle or line v is on. */
static dyd_status hole_find(extension *x, uint32_t v, uint32_t t) {
  const dyd_mesh *m = &x->pd->sk.mesh;
  x->count = 0;
  if (!DYD_GROW(x->hole, x->cap, 1)) return DYD_E_NOMEM;
  x->hole[x->count++] = t;
  for (size_t k = 0; k < x->count; k++) {
    dyd_status st = dyd_ties_drop(x->pd, x->hole[k]);
    for (dyd_half_edge h = dyd_edge_of(x->hole[k], 0), end = dyd_edge_end(x->hole[k]); h < end && st == DYD_OK; h++) {
      const uint32_t beyond = dyd_edge_triangle(dyd_edge_twin(m, h)), *c = m->tri[beyond].v;
      if (hole_has(x, beyond)) continue;
      int in = dyd_mesh_incircle(&x->w->tally, m, c[0], c[1], c[2], v);
      if (in == 0) st = dyd_ties_drop(x->pd, beyond);
      if (in <= 0) continue;
      if (!DYD_GROW(x->hole, x->cap, x->count + 1)) return DYD_E_NOMEM;
      x->hole[x->count++] = beyond;
    }
    if (st != DYD_OK) return st;
  }
  return DYD_OK;
}

/* Decides the edges of the triangles around v. *ghost becomes one that is a ghost triangle, if there is one. */
static dyd_status star_decide(uint32_t *ghost, extension *x, uint32_t v) {
  dyd_skeleton *sk = &x->pd->sk;
  const dyd_mesh *m = &sk->mesh;
  dyd_half_edge first = dyd_edge_of(m->hint, 2); /* m->tri[].v[0] is v */
  dyd_status st = DYD_OK;
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(m, h, first)) {
    const uint32_t t = dyd_edge_triangle(h), w = dyd_edge_target(m, h);
    if (w != m->n) sk->leaving[w] = dyd_edge_next(h);
    if (dyd_is_ghost_triangle(m, t)) *ghost = t;
    for (dyd_half_edge e = dyd_edge_of(t, 0); e < dyd_edge_end(t); e++)
      dyd_set_certain(sk, e, dyd_point_edge_is_certain(&x->w->tally, m, e));
  }
  sk->leaving[v] = first;
  for (dyd_half_edge h = first; h != DYD_NONE && st == DYD_OK; h = dyd_edge_around(m, h, first))
    st = dyd_ties_add(x->pd, x->w, dyd_edge_triangle(h));
  return st;
}

/* A point at the place of another one becomes its alias. */
static dyd_status extend_by(uint32_t *ghost, extension *x, uint32_t v) {
  dyd_skeleton *sk = &x->pd->sk;
  uint32_t t, same;
  dyd_mesh_find(&t, &same, &sk->mesh, v);
  if (same != DYD_NONE) {
    sk->vertex[sk->reps.site[v]] = same;
    return dyd_mesh_set_alias(&sk->mesh, v, same);
  }
  dyd_status st = hole_find(x, v, t);
  if (st == DYD_OK) st = dyd_mesh_put(&sk->mesh, v, t);
  return st == DYD_OK ? star_decide(ghost, x, v) : st;
}

/* ---- all ---- */

typedef struct newcomer {
  dyd_xy at;
  uint32_t site;
} newcomer;

static int newcomer_by_x(const void *a, const void *b) {
  const newcomer *p = a, *q = b;
  if (p->at.x != q->at.x) return p->at.x < q->at.x ? -1 : 1;
  return (p->site > q->site) - (p->site < q->site);
}

static int newcomer_by_y(const void *a, const void *b) {
  const newcomer *p = a, *q = b;
  if (p->at.y != q->at.y) return p->at.y < q->at.y ? -1 : 1;
  return (p->site > q->site) - (p->site < q->site);
}

/* Of points at the same place the lowest number comes first, too: the others become its aliases. */
static int newcomer_back(const void *a, const void *b) {
  const newcomer *p = a, *q = b;
  return p->at.y != q->at.y ? newcomer_by_y(b, a) : newcomer_by_y(a, b);
}

/* The new sites in an order in which each is near to the one before: columns of about sqrt(count), up and down. */
static dyd_status newcomers_order(uint32_t *order, const dyd_delaunay *pd, uint32_t count) {
  newcomer *all = dyd_alloc(count, sizeof *all);
  uint32_t size = 1;
  if (!all) return DYD_E_NOMEM;
  while ((uint64_t)size * size < count) size++;
  for (uint32_t k = 0; k < count; k++) {
    double box[4];
    dyd_sites_get_d(box, pd->sk.rects.sites, pd->sk.n + k);
    all[k] = (newcomer){{box[0], box[2]}, pd->sk.n + k};
  }
  qsort(all, count, sizeof *all, newcomer_by_x);
  for (uint32_t k = 0; k < count; k += size)
    qsort(all + k, count - k < size ? count - k : size, sizeof *all, k / size & 1 ? newcomer_back : newcomer_by_y);
  for (uint32_t k = 0; k < count; k++) order[k] = all[k].site;
  free(all);
  return DYD_OK;
}

bool dyd_delaunay_is_extensible(const dyd_delaunay *pd) {
  return pd->open.kind == DYD_TIED && !pd->sk.reps.code && !pd->room.most;
}

static bool can_extend(const dyd_delaunay *pd, uint32_t count) {
  const dyd_skeleton *sk = &pd->sk;
  bool points = dyd_delaunay_is_extensible(pd) && pd->joins == sk->rects.sites->joins &&
                pd->options.no_filter == sk->mesh.no_filter && sk->n + count <= DYD_MAX_SITES;
  for (uint32_t k = 0; k < count && points; k++)
    points = dyd_sites_is_point(sk->rects.sites, sk->n + k) && dyd_sites_in_doubles(sk->rects.sites, sk->n + k);
  return points;
}

static dyd_status extend_all(dyd_delaunay *pd, dyd_work *w, uint32_t before, uint32_t *ghost) {
  extension x = {.pd = pd, .w = w};
  dyd_status st = DYD_OK;
  pd->sk.mesh.hint = *ghost;
  for (uint32_t v = before; v < pd->sk.n && st == DYD_OK; v++) st = extend_by(ghost, &x, v);
  free(x.hole);
  return st;
}

/* Resizes what is known of triangles to what the mesh can come to hold. */
static dyd_status marks_grow(dyd_delaunay *pd) {
  const size_t count = pd->sk.mesh.count, most = 2 * (size_t)pd->sk.n + 2;
  memset(pd->sk.certain + count, 0, most - count);
  if (!pd->open.of) return DYD_OK;
  uint32_t *of = realloc(pd->open.of, most * sizeof *of);
  if (!of) return DYD_E_NOMEM;
  memset(of + count, 0xff, (most - count) * sizeof *of);
  pd->open.of = of;
  return DYD_OK;
}

dyd_status dyd_extend(bool *fits, dyd_delaunay *pd, dyd_error *err) {
  const uint32_t before = pd->sk.n, count = (uint32_t)dyd_sites_count(pd->sk.rects.sites) - before;
  const dyd_run run = {.cancel = pd->options.cancel, .threads = pd->options.threads, .err = err};
  const dyd_mesh *m = &pd->sk.mesh;
  uint32_t ghost = m->hint, *order = NULL;
  dyd_work w;
  *fits = count <= before / 32 + 32 && can_extend(pd, count);
  if (!*fits || !count) return DYD_OK;
  if (!dyd_is_ghost_triangle(m, ghost)) ghost = dyd_edge_triangle(dyd_hull_first(m));
  order = dyd_alloc(count, sizeof *order);
  dyd_status st = order ? newcomers_order(order, pd, count) : DYD_E_NOMEM;
  if (st == DYD_OK) st = dyd_skeleton_grow(&pd->sk, order, count, ghost);
  free(order);
  if (st == DYD_OK) st = marks_grow(pd);
  if (st == DYD_OK) {
    dyd_work_init(&w, &pd->sk, &run);
    st = extend_all(pd, &w, before, &ghost);
    pd->sk.mesh.tally.ties += w.tally.ties;
    dyd_work_count(&pd->counters, &w, &pd->sk);
    dyd_work_clear(&w);
    pd->sk.mesh.hint = ghost;
    dyd_mesh_trim(&pd->sk.mesh);
  }
  *fits = st == DYD_OK;
  if (*fits) DYD_INVARIANT(dyd_mesh_is_valid(m));
  return st;
}
