/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Enclosures of Voronoi vertices in doubles [VERT-1].
 *
 * Let z be any point, q_0, q_1, q_2 a choice, a = q_1 - q_0, b = q_2 - q_0, c the circumcentre, h = c - z. From
 * 2 a.c = |q_1|^2 - |q_0|^2 follows 2 a.h = |q_1 - z|^2 - |q_0 - z|^2 =: A, likewise 2 b.h = B, so
 *   h_x = (A b_y - B a_y) / (2 a x b),   h_y = (B a_x - A b_x) / (2 a x b).
 * A, B are bounded by ds, dl at z [FLT-DST], a and b by the corners of the boxes, a x b from below by its value at the
 * middles less its variation. All quantities are sums, products and quotients of at most 20 operations each, so the
 * factors 1 +- 32 u put them on the safe side; a denominator below 2^-400 is refused, so that underflow (at most
 * 2^-1075 an operation) is covered by the same factors. */
#include "voronoi/vertex_filter.h"

#define SAFE (1 + 32 * 0x1p-53)

/* A vector known up to its radius in each coordinate. */
typedef struct ball2 {
  double x, y, rx, ry;
} ball2;

/* q_k - q_0 by boxes: middle of the representatives' difference, radius to the farthest corner. */
static ball2 ball_difference(const dyd_bbox *p, const dyd_bbox *q, dyd_xy mp, dyd_xy mq) {
  ball2 d = {mq.x - mp.x, mq.y - mp.y, 0, 0};
  d.rx = dyd_max(d.x - (q->e[0] - p->e[1]), (q->e[1] - p->e[0]) - d.x);
  d.ry = dyd_max(d.y - (q->e[2] - p->e[3]), (q->e[3] - p->e[2]) - d.y);
  double size = fabs(p->e[0]) + fabs(p->e[1]) + fabs(q->e[0]) + fabs(q->e[1]);
  d.rx = dyd_max(d.rx, 0) * SAFE + 8 * 0x1p-53 * size;
  size = fabs(p->e[2]) + fabs(p->e[3]) + fabs(q->e[2]) + fabs(q->e[3]);
  d.ry = dyd_max(d.ry, 0) * SAFE + 8 * 0x1p-53 * size;
  return d;
}

/* A lower bound of |a x b|; not positive when the sign is not sure. */
static double ball_cross_lower(const ball2 *a, const ball2 *b) {
  double p = a->x * b->y, q = a->y * b->x, value = fabs(p - q);
  double vary = a->rx * (fabs(b->y) + b->ry) + fabs(a->x) * b->ry + a->ry * (fabs(b->x) + b->rx) + fabs(a->y) * b->rx;
  return value - (vary * SAFE + 32 * 0x1p-53 * (fabs(p) + fabs(q)));
}

/* An upper bound of | |q_k - z|^2 - |q_0 - z|^2 |. */
static double circle_gap2(const dyd_bbox *z, const dyd_bbox *p, const dyd_bbox *q) {
  return dyd_max(dyd_dl2_upper(z, q) - dyd_ds2_lower(z, p), dyd_dl2_upper(z, p) - dyd_ds2_lower(z, q)) * SAFE;
}

static dyd_xy box_middle(const dyd_bbox *b) {
  return (dyd_xy){b->e[0] + (b->e[1] - b->e[0]) / 2, b->e[2] + (b->e[3] - b->e[2]) / 2};
}

bool dyd_filter_vertex(dyd_bbox *out, const dyd_delaunay *pd, const uint32_t v[3]) {
  dyd_bbox box[3];
  dyd_xy m[3];
  for (int k = 0; k < 3; k++) {
    dyd_sites_get_d(box[k].e, pd->sk.rects.sites, pd->sk.reps.site[v[k]]);
    m[k] = box_middle(&box[k]);
  }
  ball2 a = ball_difference(&box[0], &box[1], m[0], m[1]), b = ball_difference(&box[0], &box[2], m[0], m[2]);
  double det = 2 * (a.x * b.y - a.y * b.x), la = a.x * a.x + a.y * a.y, lb = b.x * b.x + b.y * b.y;
  double least = ball_cross_lower(&a, &b);
  if (!(least >= 0x1p-400)) return false;
  dyd_xy z = {m[0].x + (b.y * la - a.y * lb) / det, m[0].y + (a.x * lb - b.x * la) / det};
  dyd_bbox c = {{z.x, z.x, z.y, z.y}};
  double ga = circle_gap2(&c, &box[0], &box[1]), gb = circle_gap2(&c, &box[0], &box[2]);
  double hx = (ga * (fabs(b.y) + b.ry) + gb * (fabs(a.y) + a.ry)) / (2 * least) * SAFE + DYD_TINY;
  double hy = (gb * (fabs(a.x) + a.rx) + ga * (fabs(b.x) + b.rx)) / (2 * least) * SAFE + DYD_TINY;
  hx += 4 * 0x1p-53 * (fabs(z.x) + hx);
  hy += 4 * 0x1p-53 * (fabs(z.y) + hy);
  *out = (dyd_bbox){{z.x - hx, z.x + hx, z.y - hy, z.y + hy}};
  return out->e[0] >= -DBL_MAX && out->e[1] <= DBL_MAX && out->e[2] >= -DBL_MAX && out->e[3] <= DBL_MAX;
}
