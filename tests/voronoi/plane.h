/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points and polygons in rationals, and cells by their definition: nothing shared with src. */
#ifndef DYD_TESTS_VORONOI_PLANE_H
#define DYD_TESTS_VORONOI_PLANE_H

#include "delaunay/harness.h"
#include <dyadel/voronoi.h>

typedef struct xy {
  mpq_srcptr x, y;
} xy;

static inline xy of_point(orc_pool *p, const dyd_point *z) {
  mpq_ptr x = orc_new(p), y = orc_new(p);
  dyd_dyadic_get_q(x, &z->x);
  dyd_dyadic_get_q(y, &z->y);
  return (xy){x, y};
}

static inline mpq_srcptr cross(orc_pool *p, xy o, xy a, xy b) {
  mpq_srcptr ax = orc_sub(p, a.x, o.x), ay = orc_sub(p, a.y, o.y), bx = orc_sub(p, b.x, o.x), by = orc_sub(p, b.y, o.y);
  return orc_sub(p, orc_mul(p, ax, by), orc_mul(p, ay, bx));
}

static inline mpq_srcptr distance2(orc_pool *p, xy a, xy b) {
  return orc_add(p, orc_sqr(p, orc_sub(p, a.x, b.x)), orc_sqr(p, orc_sub(p, a.y, b.y)));
}

/* Squared distance to the segment ab. */
static inline mpq_srcptr segment2(orc_pool *p, xy z, xy a, xy b) {
  mpq_srcptr l = distance2(p, a, b);
  if (!mpq_sgn(l)) return distance2(p, z, a);
  mpq_srcptr t = orc_add(p, orc_mul(p, orc_sub(p, z.x, a.x), orc_sub(p, b.x, a.x)),
                         orc_mul(p, orc_sub(p, z.y, a.y), orc_sub(p, b.y, a.y)));
  if (mpq_sgn(t) <= 0) return distance2(p, z, a);
  if (mpq_cmp(t, l) >= 0) return distance2(p, z, b);
  return orc_div(p, orc_sqr(p, cross(p, z, a, b)), l);
}

static inline mpq_srcptr near2(orc_pool *p, xy z, const orc_rect *r, bool far) {
  orc_point at = {orc_alg_q(p, z.x), orc_alg_q(p, z.y)};
  return (far ? orc_dl2(p, at, r) : orc_ds2(p, at, r)).a;
}

/* dl_i < ds_j at z. */
static inline bool nearer(orc_pool *p, const orc_case *c, size_t i, size_t j, xy z) {
  return mpq_cmp(near2(p, z, &c->rect[i], true), near2(p, z, &c->rect[j], false)) < 0;
}

static inline bool in_int(orc_pool *p, const orc_case *c, size_t i, xy z) {
  for (size_t j = 0; j < c->n; j++)
    if (j != i && orc_case_alias(c, j) != i && !nearer(p, c, i, j, z)) return false;
  return true;
}

static inline bool in_pos(orc_pool *p, const orc_case *c, size_t i, xy z) {
  for (size_t j = 0; j < c->n; j++)
    if (j != i && orc_case_alias(c, j) != i && nearer(p, c, j, i, z)) return false;
  return true;
}

static inline bool in_window(const orc_rect *w, xy z) {
  return mpq_cmp(w->e[0], z.x) <= 0 && mpq_cmp(z.x, w->e[1]) <= 0 && mpq_cmp(w->e[2], z.y) <= 0 &&
         mpq_cmp(z.y, w->e[3]) <= 0;
}

static inline mpq_srcptr two_to(orc_pool *p, long e) {
  mpq_ptr t = orc_new(p);
  mpq_set_ui(t, 1, 1);
  if (e >= 0)
    mpq_mul_2exp(t, t, (mp_bitcnt_t)e);
  else
    mpq_div_2exp(t, t, (mp_bitcnt_t)-e);
  return t;
}

static inline bool in_polygon(orc_pool *p, const dyd_polygon *g, xy z) {
  int winding = 0;
  for (size_t k = 0; k < g->count; k++) {
    xy a = of_point(p, &g->vertex[k]), b = of_point(p, &g->vertex[(k + 1) % g->count]);
    bool up = mpq_cmp(a.y, z.y) <= 0 && mpq_cmp(b.y, z.y) > 0, down = mpq_cmp(b.y, z.y) <= 0 && mpq_cmp(a.y, z.y) > 0;
    int s = mpq_sgn(cross(p, a, b, z));
    if (s == 0 && !mpq_sgn(segment2(p, z, a, b))) return true;
    winding += up && s > 0;
    winding -= down && s < 0;
  }
  return winding != 0;
}

#endif
