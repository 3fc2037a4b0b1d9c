/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Witnesses that only the faces around an edge can spoil.
 *
 * [LOC-3] Let i and j be joined by an edge of the skeleton inside a face of the plane graph of certain edges, and W the
 * vertices of all faces at i and at j (three of a decided triangle, all of an undecided face). If at c all of W but i
 * and j are certainly farther than i and j, so are all sites: c is a witness. So no search among all sites is needed;
 * the bounds are those of rects_filter.h [FLT-DST]. */
#include "delaunay/local_filter.h"

#include "skeleton/rects_filter.h"

#include <math.h>

/* Number of triangles examined for an edge. */
enum { MOST_TRIANGLES = 64 };

typedef struct around {
  const dyd_delaunay *pd;
  uint32_t i, j;
  dyd_bbox c;
  double bound; /* upper bound of the squared distance of i and j */
  uint32_t left;
} around;

static bool is_farther(const around *a, uint32_t v) {
  const dyd_skeleton *sk = &a->pd->sk;
  return v == a->i || v == a->j || v == sk->mesh.n || dyd_ds2_lower(&a->c, &sk->rects.box[v]) > a->bound;
}

static bool triangle_is_farther(around *a, uint32_t t) {
  const uint32_t *v = a->pd->sk.mesh.tri[t].v;
  return a->left-- > 0 && is_farther(a, v[0]) && is_farther(a, v[1]) && is_farther(a, v[2]);
}

static bool face_is_farther(around *a, uint32_t f) {
  const dyd_face *face = &a->pd->open.face[f];
  const uint32_t *tri = a->pd->open.tri + face->first_tri;
  if (face->tris > a->left) return false;
  for (uint32_t q = 0; q < face->tris; q++)
    if (!triangle_is_farther(a, tri[q])) return false;
  return true;
}

/* The faces at v but `own`. */
static bool star_is_farther(around *a, uint32_t v, uint32_t own) {
  dyd_half_edge first = a->pd->sk.leaving[v];
  uint32_t before = own;
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(&a->pd->sk.mesh, h, first)) {
    uint32_t t = dyd_edge_triangle(h), f = a->pd->open.of[t];
    if (f == DYD_NONE && !triangle_is_farther(a, t)) return false;
    if (f != DYD_NONE && f != own && f != before && !face_is_farther(a, f)) return false;
    before = f;
  }
  return true;
}

bool dyd_filter_local_witness(const dyd_delaunay *pd, dyd_half_edge h, dyd_xy c) {
  const dyd_bbox *box = pd->sk.rects.box;
  const dyd_mesh *m = &pd->sk.mesh;
  uint32_t i = dyd_edge_origin(m, h), j = dyd_edge_target(m, h), own = pd->open.of[dyd_edge_triangle(h)];
  around a = {.pd = pd, .i = i, .j = j, .c = {{c.x, c.x, c.y, c.y}}, .left = MOST_TRIANGLES};
  if (!isfinite(c.x) || !isfinite(c.y) || i == m->n || j == m->n) return false;
  a.bound = dyd_max(dyd_dl2_upper(&a.c, &box[i]), dyd_dl2_upper(&a.c, &box[j]));
  return isfinite(a.bound) && face_is_farther(&a, own) && star_is_farther(&a, i, own) && star_is_farther(&a, j, own);
}
