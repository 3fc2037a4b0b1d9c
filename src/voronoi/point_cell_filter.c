/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cells of exact points in doubles.
 *
 * Each vertex lies in a box [VERT-1]. Where all of the box rounds to one multiple of 2^-grid, so does the vertex; where
 * it does not, x is NaN, and the exact rung rounds that vertex. A cell whose boxes are all strictly inside W is the
 * polygon of its vertices; one whose boxes are all beyond one side of W does not meet W. The area is enclosed by the
 * shoelace formula over the boxes in interval arithmetic: it holds the area of every polygon with one vertex in each
 * box. */
#include "base/alloc.h"
#include "predicate/interval_filter.h"
#include "voronoi/point_cell.h"
#include "voronoi/vertex_filter.h"

/* *out = floor(x 2^grid + 1/2) for both ends; true where it is one number, which has few bits. x 2^grid is exact, and
 * so is the sum: both are below 2^50. */
static bool round_to_grid(double *out, double lo, double hi, int grid) {
  double a = floor(ldexp(lo, grid) + 0.5), b = floor(ldexp(hi, grid) + 0.5);
  *out = ldexp(a, -grid);
  return a == b && fabs(a) < 0x1p50;
}

static bool box_is_inside(const dyd_bbox *b, const double w[4]) {
  return w[0] < b->e[0] && b->e[1] < w[1] && w[2] < b->e[2] && b->e[3] < w[3];
}

/* Are all boxes beyond one side of W? */
static bool boxes_are_beyond(const dyd_bbox *b, uint32_t n, const double w[4]) {
  for (int side = 0; side < 4; side++) {
    uint32_t k = 0;
    while (k < n && (side & 1 ? b[k].e[side - 1] >= w[side] : b[k].e[side + 1] <= w[side])) k++;
    if (k == n) return true;
  }
  return false;
}

/* Twice the area of the polygon with a vertex in each box; o is any point near. */
static dyd_iv boxes_area2(const dyd_bbox *b, uint32_t n, dyd_xy o) {
  dyd_iv sum = dyd_iv_point(0), x[2], y[2];
  for (uint32_t k = 0; k <= n; k++) {
    const double *e = b[k % n].e;
    x[k & 1] = dyd_iv_sub((dyd_iv){e[0], e[1]}, dyd_iv_point(o.x));
    y[k & 1] = dyd_iv_sub((dyd_iv){e[2], e[3]}, dyd_iv_point(o.y));
    int was = 1 - (int)(k & 1), is = (int)(k & 1);
    if (k) sum = dyd_iv_add(sum, dyd_iv_sub(dyd_iv_mul(x[was], y[is]), dyd_iv_mul(y[was], x[is])));
  }
  return sum;
}

dyd_status dyd_filter_point_cell(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t v, uint32_t degree,
                                 const dyd_window *w) {
  *done = false;
  for (uint32_t k = 0; k < degree; k++)
    if (s->key[k] == DYD_NONE || !dyd_filter_vertex(&s->fan_box[k], pd, pd->sk.mesh.tri[s->key[k]].v)) return DYD_OK;
  s->inner_count = 0;
  s->area[0] = s->area[1] = 0;
  if (boxes_are_beyond(s->fan_box, degree, w->d)) return *done = true, DYD_OK;
  for (uint32_t k = 0; k < degree; k++)
    if (!box_is_inside(&s->fan_box[k], w->d)) return DYD_OK;
  dyd_iv area2 = boxes_area2(s->fan_box, degree, pd->sk.reps.xy[v]);
  if (!(area2.hi - area2.lo <= 0x1p-20 * area2.lo)) return DYD_OK;
  s->area[0] = dyd_down(area2.lo / 2);
  s->area[1] = dyd_up(area2.hi / 2);
  if (!dyd_reserve((void **)&s->inner, &s->inner_cap, degree, sizeof *s->inner)) return DYD_E_NOMEM;
  for (; s->inner_count < degree; s->inner_count++) {
    const double *e = s->fan_box[s->inner_count].e;
    dyd_xy *z = &s->inner[s->inner_count];
    if (!round_to_grid(&z->x, e[0], e[1], w->grid) || !round_to_grid(&z->y, e[2], e[3], w->grid)) z->x = (double)NAN;
  }
  *done = true;
  return DYD_OK;
}
