/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Bounds for the walks: everything here is conservative, the walks decide what is left. */
#include "skeleton/rects_filter.h"

#include <math.h>

dyd_bbox dyd_point_box(const dyd_point *c) {
  return (dyd_bbox){{dyd_dyadic_get_d(&c->x, DYD_DOWN), dyd_dyadic_get_d(&c->x, DYD_UP),
                     dyd_dyadic_get_d(&c->y, DYD_DOWN), dyd_dyadic_get_d(&c->y, DYD_UP)}};
}

double dyd_pair_dl2_upper(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j) {
  double a = dyd_dl2_upper(c, &r->box[i]), b = dyd_dl2_upper(c, &r->box[j]);
  return isnan(a) || isnan(b) ? INFINITY : dyd_max(a, b);
}

double dyd_pair_ds2_upper(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j) {
  double a = dyd_ds2_upper(c, &r->box[i], dyd_box_slack(r, i));
  double b = dyd_ds2_upper(c, &r->box[j], dyd_box_slack(r, j));
  return isnan(a) || isnan(b) ? INFINITY : dyd_max(a, b);
}

bool dyd_surely_not_nearer(const dyd_rects *r, const dyd_bbox *c, uint32_t k, double bound) {
  return dyd_dl2_lower(c, &r->box[k], dyd_box_slack(r, k)) >= bound;
}

typedef struct nearest {
  const dyd_rects *r;
  uint32_t i, j, best;
  dyd_bbox c;
  double least;
} nearest;

/* Who is farther than `least` altogether cannot have a smaller dl, so the radius follows. */
static bool keep_nearest(void *context, uint32_t k) {
  nearest *s = context;
  if (k == s->i || k == s->j) return true;
  double d = dyd_dl2_upper(&s->c, &s->r->box[k]);
  if (d < s->least) {
    s->least = d;
    s->best = k;
  }
  return true;
}

uint32_t dyd_surely_nearest(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j) {
  nearest s = {r, i, j, DYD_NONE, *c, 0};
  s.least = dyd_min(dyd_ds2_lower(c, &r->box[i]), dyd_ds2_lower(c, &r->box[j]));
  if (s.least > 0) dyd_tree_near(&r->tree, c, &s.least, keep_nearest, &s);
  return s.best;
}

void dyd_direction_d(double u[2], const mpz_t x, const mpz_t y) {
  long e[2];
  u[0] = mpz_get_d_2exp(&e[0], x);
  u[1] = mpz_get_d_2exp(&e[1], y);
  long top = u[0] == 0 ? e[1] : u[1] == 0 || e[0] > e[1] ? e[0] : e[1];
  for (int a = 0; a < 2; a++) u[a] = e[a] - top < -900 ? 0 : ldexp(u[a], (int)(e[a] - top));
}

/* The outward box reaches at most `slack` farther than the rectangle; u is off by 2^-52 |u| + 2^-900, products and sums
 * by 4 * 2^-53, on both sides of the comparison: 32 * 2^-53 |u| |x| + 2^-898 |x| covers it all [FLT-DIR]. */
double dyd_height_lower(const dyd_rects *r, double ux, double uy, const dyd_bbox *p) {
  const dyd_bbox *all = &r->tree.node[r->tree.level[r->tree.levels - 1]];
  double mx = dyd_max(fabs(all->e[0]), fabs(all->e[1])), my = dyd_max(fabs(all->e[2]), fabs(all->e[3]));
  double x = ux > 0 ? p->e[1] : p->e[0], y = uy > 0 ? p->e[3] : p->e[2];
  double slack = 32 * 0x1p-53 * (fabs(ux) * mx + fabs(uy) * my) + 0x1p-898 * (mx + my) + DYD_TINY;
  double h = ux * x + uy * y - slack;
  return isnan(h) ? -INFINITY : h;
}
