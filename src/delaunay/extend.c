/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sites put into a triangulation.
 *
 * The triangles whose circle holds the new representative are replaced by those around it. Faces of exact points are
 * polygons on one circle and chains on one line (ties.h). One that the new point is in, or on the circle or line of, is
 * taken out before; then the edges of the triangles around the point are decided, and the faces there are found again
 * [LOC-5]. Of rectangles, edges are decided again outward from the triangles around the new sites until legal ones
 * surround them, and then the other edges at these triangles' corners; faces that one of these edges touches are found
 * again [LOC-7]. */
#include "delaunay/extend.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "base/local.h"
#include "delaunay/faces.h"
#include "delaunay/ties.h"
#include "legal/certify.h"
#include "skeleton/mesh_build.h"
#include "skeleton/mesh_filter.h"

#include <string.h>

typedef struct triangles {
  uint32_t *item;
  size_t count, cap;
} triangles;

/* hole: the triangles whose circle the point is in. Of rectangles, near: triangles that may be in a face with a new
 * site; seed: those of faces that were taken out, and at edges that are not certain any more; seen: see DECIDED; old:
 * these faces. */
typedef struct extension {
  dyd_delaunay *pd;
  dyd_work *w;
  triangles hole, near, seed;
  uint8_t *seen;
  dyd_face *old;
  size_t olds, old_cap;
} extension;

static bool extension_list(triangles *list, const uint32_t *t, size_t count) {
  if (!DYD_GROW(list->item, list->cap, list->count + count)) return false;
  for (size_t k = 0; k < count; k++) list->item[list->count++] = t[k];
  return true;
}

/* Takes the face of triangle t, if it has one, out of the table; *t becomes a seed. */
static dyd_status face_drop(extension *x, uint32_t t) {
  dyd_undecided *open = &x->pd->open;
  const uint32_t f = dyd_face_of(x->pd, t);
  if (open->kind == DYD_TIED) return dyd_ties_drop(x->pd, t);
  if (f == DYD_NONE) return extension_list(&x->seed, &t, 1) ? DYD_OK : DYD_E_NOMEM;
  if (!extension_list(&x->seed, open->tri + open->face[f].first_tri, open->face[f].tris)) return DYD_E_NOMEM;
  if (!DYD_GROW(x->old, x->old_cap, x->olds + 1)) return DYD_E_NOMEM;
  x->old[x->olds++] = open->face[f];
  dyd_table_take_out(x->pd, f);
  return DYD_OK;
}

static bool hole_has(const extension *x, uint32_t t) {
  for (size_t k = 0; k < x->hole.count; k++)
    if (x->hole.item[k] == t) return true;
  return false;
}

/* Finds the hole around v from t on, and takes out the faces in it, and those whose circle or line v is on. */
static dyd_status hole_find(extension *x, uint32_t v, uint32_t t) {
  const dyd_mesh *m = &x->pd->sk.mesh;
  triangles *hole = &x->hole;
  hole->count = 0;
  if (!extension_list(hole, &t, 1)) return DYD_E_NOMEM;
  for (size_t k = 0; k < hole->count; k++) {
    dyd_status st = face_drop(x, hole->item[k]);
    for (dyd_half_edge h = dyd_edge_of(hole->item[k], 0), end = dyd_edge_end(hole->item[k]); h < end && st == DYD_OK;
         h++) {
      const uint32_t beyond = dyd_edge_triangle(dyd_edge_twin(m, h)), *c = m->tri[beyond].v;
      if (hole_has(x, beyond)) continue;
      int in = dyd_mesh_incircle(&x->w->tally, m, c[0], c[1], c[2], v);
      if (in == 0) st = face_drop(x, beyond);
      if (in > 0 && !extension_list(hole, &beyond, 1)) return DYD_E_NOMEM;
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

/* ---- of rectangles ---- */

/* Of a triangle: bit k, half-edge k is decided; NEAR: it is in x->near. Of a vertex: CORNER, its edges are decided. */
enum { DECIDED = 1, NEAR = 8, CORNER = 16 };

/* The triangles around v: edges at v are not certain, others as their twins are. */
static void star_open(uint32_t *ghost, const extension *x, uint32_t v) {
  dyd_skeleton *sk = &x->pd->sk;
  const dyd_mesh *m = &sk->mesh;
  dyd_half_edge first = dyd_edge_of(m->hint, 2); /* m->tri[].v[0] is v */
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(m, h, first)) {
    const uint32_t t = dyd_edge_triangle(h), w = dyd_edge_target(m, h);
    if (w != m->n) sk->leaving[w] = dyd_edge_next(h);
    if (dyd_is_ghost_triangle(m, t)) *ghost = t;
    sk->certain[t] = dyd_edge_is_certain(sk, dyd_edge_twin(m, dyd_edge_of(t, 0)));
  }
  sk->leaving[v] = first;
}

static dyd_status near_add(extension *x, uint32_t t) {
  if (x->seen[t] & NEAR) return DYD_OK;
  x->seen[t] |= NEAR;
  dyd_status st = face_drop(x, t);
  return st != DYD_OK || extension_list(&x->near, &t, 1) ? st : DYD_E_NOMEM;
}

/* Decides an edge that is certain, or has a new end. If it is certain no more, the faces at it change. */
static dyd_status edge_decide(extension *x, dyd_half_edge h, uint32_t before) {
  dyd_skeleton *sk = &x->pd->sk;
  const dyd_half_edge twin = dyd_edge_twin(&sk->mesh, h);
  uint8_t *seen = &x->seen[dyd_edge_triangle(h)], bit = (uint8_t)(DECIDED << dyd_edge_corner(h));
  const uint32_t v = dyd_edge_origin(&sk->mesh, h), w = dyd_edge_target(&sk->mesh, h), n = sk->mesh.n;
  const bool fresh = (v >= before && v != n) || (w >= before && w != n), was = dyd_edge_is_certain(sk, h);
  if (*seen & bit || !(was || fresh)) return DYD_OK;
  *seen |= bit;
  x->seen[dyd_edge_triangle(twin)] |= (uint8_t)(DECIDED << dyd_edge_corner(twin));
  dyd_set_certain(sk, h, false);
  dyd_status st = dyd_certify_edge(sk, x->w, h);
  if (st != DYD_OK || !was || dyd_edge_is_certain(sk, h)) return st;
  st = face_drop(x, dyd_edge_triangle(h));
  return st == DYD_OK ? face_drop(x, dyd_edge_triangle(twin)) : st;
}

/* Decides the edges of the triangles near new sites, and of those beyond edges that are not certain. */
static dyd_status near_decide(extension *x, uint32_t before) {
  const dyd_skeleton *sk = &x->pd->sk;
  dyd_status st = DYD_OK;
  for (uint32_t v = before; v < sk->n && st == DYD_OK; v++)
    for (dyd_half_edge h = sk->leaving[v]; h != DYD_NONE && st == DYD_OK;
         h = dyd_edge_around(&sk->mesh, h, sk->leaving[v]))
      st = near_add(x, dyd_edge_triangle(h));
  for (size_t k = 0; k < x->near.count && st == DYD_OK; k++) {
    if (dyd_work_cancelled(x->w)) return DYD_CANCELLED;
    for (dyd_half_edge h = dyd_edge_of(x->near.item[k], 0), end = h + 3; h < end && st == DYD_OK; h++) {
      st = edge_decide(x, h, before);
      if (st == DYD_OK && !dyd_edge_is_certain(sk, h)) st = near_add(x, dyd_edge_triangle(dyd_edge_twin(&sk->mesh, h)));
    }
  }
  return st;
}

/* Decides the other edges at the corners of these triangles. */
static dyd_status corners_decide(extension *x, uint32_t before) {
  const dyd_skeleton *sk = &x->pd->sk;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < 3 * x->near.count && st == DYD_OK; k++) {
    const uint32_t v = sk->mesh.tri[x->near.item[k / 3]].v[k % 3];
    if (v == sk->mesh.n || x->seen[v] & CORNER) continue;
    x->seen[v] |= CORNER;
    for (dyd_half_edge h = sk->leaving[v]; h != DYD_NONE && st == DYD_OK;
         h = dyd_edge_around(&sk->mesh, h, sk->leaving[v]))
      st = edge_decide(x, h, before);
  }
  return st;
}

static dyd_status near_faces_find(extension *x, uint32_t before) {
  dyd_delaunay *pd = x->pd;
  if (!DYD_ZEROED(x->seen, 2 * (size_t)pd->sk.n + 2)) return DYD_E_NOMEM;
  dyd_status st = near_decide(x, before);
  if (st == DYD_OK) st = corners_decide(x, before);
  const size_t fresh = pd->open.count;
  if (st == DYD_OK) st = dyd_faces_find(pd, x->w, x->seed.item, x->seed.count);
  if (st == DYD_OK) st = dyd_faces_end_pairs(pd, x->w, x->old, x->olds, fresh);
  if (st == DYD_OK) dyd_table_compact(&pd->open);
  return st;
}

/* ---- one site ---- */

/* Moves the representative of v, a rectangle, until it differs from all others. DYD_CANCELLED: an old one has to move.
 */
static dyd_status move_apart(uint32_t *t, dyd_skeleton *sk, uint32_t v) {
  enum { MOST = 16 };
  uint32_t same = v;
  for (uint32_t k = 1; k < MOST && same != DYD_NONE; k++) {
    dyd_status st = dyd_vertex_is_point(sk, v) ? DYD_CANCELLED : dyd_reps_choose(&sk->reps, v, k);
    if (st != DYD_OK) return st;
    dyd_mesh_follow(&sk->mesh);
    dyd_mesh_find(t, &same, &sk->mesh, v);
  }
  return same == DYD_NONE ? DYD_OK : DYD_CANCELLED;
}

/* Among exact points, one at the place of another one becomes its alias. */
static dyd_status extend_by(uint32_t *ghost, extension *x, uint32_t v) {
  dyd_skeleton *sk = &x->pd->sk;
  const bool tied = x->pd->open.kind == DYD_TIED;
  uint32_t t, same;
  dyd_status st = DYD_OK;
  dyd_mesh_find(&t, &same, &sk->mesh, v);
  if (same != DYD_NONE && tied) {
    sk->vertex[sk->reps.site[v]] = same;
    sk->mesh.alias[v] = same;
    return DYD_OK;
  }
  if (same != DYD_NONE) st = move_apart(&t, sk, v);
  if (st == DYD_OK) st = hole_find(x, v, t);
  if (st == DYD_OK) st = dyd_mesh_put(&sk->mesh, v, t);
  if (st == DYD_OK && tied) return star_decide(ghost, x, v);
  if (st == DYD_OK) star_open(ghost, x, v);
  return st;
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
  DYD_FREED newcomer *all = dyd_alloc(count, sizeof *all);
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
  return DYD_OK;
}

bool dyd_delaunay_is_extensible(const dyd_delaunay *pd) {
  const bool points = pd->open.kind == DYD_TIED && !pd->sk.reps.code;
  return (points || pd->open.kind == DYD_LISTED) && !pd->memory.most && !pd->open.capped;
}

/* New vertices are the last ones, whatever place they have: all is made anew when they are a sixteenth. */
static bool can_extend(const dyd_delaunay *pd, uint32_t count) {
  const dyd_skeleton *sk = &pd->sk;
  bool fits = dyd_delaunay_is_extensible(pd) && pd->joins == sk->rects.sites->joins &&
              pd->options.no_filter == sk->mesh.no_filter && sk->n + count <= DYD_MAX_SITES &&
              sk->n + count - sk->built <= sk->built / 16 + 32;
  for (uint32_t k = 0; k < count && fits && pd->open.kind == DYD_TIED; k++)
    fits = dyd_site_is_point(sk->rects.sites, sk->n + k) && dyd_sites_in_doubles(sk->rects.sites, sk->n + k);
  return fits;
}

static dyd_status extend_all(dyd_delaunay *pd, dyd_work *w, uint32_t before, uint32_t *ghost) {
  extension x = {.pd = pd, .w = w};
  dyd_status st = DYD_OK;
  pd->sk.mesh.hint = *ghost;
  for (uint32_t v = before; v < pd->sk.n && st == DYD_OK; v++) st = extend_by(ghost, &x, v);
  if (st == DYD_OK && pd->open.kind == DYD_LISTED) st = near_faces_find(&x, before);
  dyd_free_all(x.hole.item, x.near.item, x.seed.item, x.seen, x.old);
  return st;
}

/* Resizes the marks of triangles for the largest mesh that these sites can make. */
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
  *fits = can_extend(pd, count);
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
