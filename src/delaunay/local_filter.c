/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Witnesses that only the faces around an edge can spoil.
 *
 * [LOC-3] Let i and j be joined by an edge of the skeleton inside a face of the plane graph of certain edges, and W the
 * vertices of all faces at i and at j (three of a decided triangle, all of an undecided face). If at c all of W but i
 * and j are farther than i and j for sure, so is everybody: c is a witness. So no search among all sites is needed; the
 * bounds are those of distance_filter.h [FLT-DST]. */
#include "delaunay/local_filter.h"

#include "skeleton/distance_filter.h"

#include <math.h>

/* So many triangles are looked at for an edge. */
enum { MOST_TRIANGLES = 64 };

typedef struct around {
  const dyd_delaunay *pd;
  uint32_t i, j;
  dyd_bbox c;
  double bound; /* upper bound of the squared distance of i and j */
  uint32_t left;
} around;

static bool is_farther(const around *a, uint32_t v) {
  return v == a->i || v == a->j || v == a->pd->mesh.n || dyd_ds2_lower(&a->c, &a->pd->box[v]) > a->bound;
}

static bool triangle_is_farther(around *a, uint32_t t) {
  const uint32_t *v = a->pd->mesh.tri[t].v;
  return a->left-- > 0 && is_farther(a, v[0]) && is_farther(a, v[1]) && is_farther(a, v[2]);
}

static bool face_is_farther(around *a, uint32_t f) {
  const dyd_face *face = &a->pd->faces.face[f];
  const uint32_t *tri = a->pd->faces.tri + face->first_tri;
  if (face->tris > a->left) return false;
  for (uint32_t q = 0; q < face->tris; q++)
    if (!triangle_is_farther(a, tri[q])) return false;
  return true;
}

/* The faces at v but `own`. */
static bool star_is_farther(around *a, uint32_t v, uint32_t own) {
  uint32_t first = a->pd->corner[v], h = first, before = own;
  do {
    uint32_t f = a->pd->faces.of[h >> 2];
    if (f == DYD_NONE && !triangle_is_farther(a, h >> 2)) return false;
    if (f != DYD_NONE && f != own && f != before && !face_is_farther(a, f)) return false;
    before = f;
    h = dyd_turn(&a->pd->mesh, h);
  } while (h != first);
  return true;
}

bool dyd_filter_local_witness(const dyd_delaunay *pd, uint32_t t, unsigned k, dyd_xy c) {
  uint32_t i = pd->mesh.tri[t].v[dyd_next(k)], j = pd->mesh.tri[t].v[dyd_prev(k)], own = pd->faces.of[t];
  around a = {.pd = pd, .i = i, .j = j, .c = {{c.x, c.x, c.y, c.y}}, .left = MOST_TRIANGLES};
  if (!isfinite(c.x) || !isfinite(c.y) || i == pd->mesh.n || j == pd->mesh.n) return false;
  a.bound = dyd_max(dyd_dl2_upper(&a.c, &pd->box[i]), dyd_dl2_upper(&a.c, &pd->box[j]));
  return isfinite(a.bound) && face_is_farther(&a, own) && star_is_farther(&a, i, own) && star_is_farther(&a, j, own);
}
