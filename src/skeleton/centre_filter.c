/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Guesses at centres. */
#include "skeleton/centre_filter.h"

#include "skeleton/mesh_filter.h"

/* Beyond the hull edge from a to b (the inside on the left) the middle of the Voronoi edge is taken one edge length
 * outside the inner centre o, or on the edge if o is far inside. */
static dyd_xy ghost_centre(dyd_xy a, dyd_xy b, dyd_xy o) {
  double ex = b.x - a.x, ey = b.y - a.y, mx = a.x + ex / 2, my = a.y + ey / 2;
  double out = ((o.x - mx) * ey - (o.y - my) * ex) / (ex * ex + ey * ey); /* in edge lengths, outward */
  double want = out > -0.5 ? out + 1 : 0;
  dyd_xy c = {mx + want * ey, my - want * ex};
  return (dyd_xy){2 * c.x - o.x, 2 * c.y - o.y};
}

dyd_xy dyd_triangle_centre(const dyd_mesh *m, uint32_t t) {
  const uint32_t *v = m->tri[t].v;
  if (!dyd_is_ghost_triangle(m, t)) return dyd_circumcentre(m->xy[v[0]], m->xy[v[1]], m->xy[v[2]]);
  dyd_half_edge h = dyd_hull_edge(m, t);
  const uint32_t *w = m->tri[dyd_edge_triangle(dyd_edge_twin(m, h))].v;
  dyd_xy o = dyd_circumcentre(m->xy[w[0]], m->xy[w[1]], m->xy[w[2]]);
  return ghost_centre(m->xy[dyd_hull_origin(m, h)], m->xy[dyd_hull_target(m, h)], o);
}

dyd_xy dyd_edge_centre(const dyd_skeleton *sk, dyd_half_edge h) {
  dyd_xy a = dyd_triangle_centre(&sk->mesh, dyd_edge_triangle(h));
  dyd_xy b = dyd_triangle_centre(&sk->mesh, dyd_edge_triangle(dyd_edge_twin(&sk->mesh, h)));
  return (dyd_xy){(a.x + b.x) * 0.5, (a.y + b.y) * 0.5};
}

dyd_xy dyd_edge_middle(const dyd_skeleton *sk, dyd_half_edge h) {
  dyd_xy a = sk->reps.xy[dyd_edge_origin(&sk->mesh, h)], b = sk->reps.xy[dyd_edge_target(&sk->mesh, h)];
  return (dyd_xy){a.x / 2 + b.x / 2, a.y / 2 + b.y / 2};
}

bool dyd_edge_centre_is_far(const dyd_skeleton *sk, dyd_half_edge h) {
  enum { FAR = 64 };
  dyd_xy a = sk->reps.xy[dyd_edge_origin(&sk->mesh, h)], middle = dyd_edge_middle(sk, h), c = dyd_edge_centre(sk, h);
  double away = fmax(fabs(c.x - middle.x), fabs(c.y - middle.y)),
         half = fmax(fabs(a.x - middle.x), fabs(a.y - middle.y));
  return !(away <= FAR * half);
}
