/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The last rung of the skeleton's predicates: GMP integers on a common scale. */
#include "skeleton/mesh_exact.h"

#include "rect/irect.h"
#include "skeleton/half_edge.h"

#include <math.h>

typedef struct scaled_points {
  dyd_irect p[4];
  size_t count;
} scaled_points;

/* Cannot fail: every representative lies in the exponent range, since its rectangle does. */
static void points_load(scaled_points *s, const dyd_mesh *m, const uint32_t *v, size_t count) {
  dyd_rect r[4];
  const dyd_rect *in[4] = {NULL};
  s->count = count;
  for (size_t k = 0; k < count; k++) {
    dyd_irect_init(&s->p[k]);
    dyd_rect_init(&r[k]);
    (void)dyd_reps_get(&r[k], m->reps, dyd_mesh_rep(m, v[k]));
    in[k] = &r[k];
  }
  dyd_irects_scale(s->p, in, count, NULL, NULL);
  for (size_t k = 0; k < count; k++) dyd_rect_clear(&r[k]);
}

static void points_unload(scaled_points *s) {
  for (size_t k = 0; k < s->count; k++) dyd_irect_clear(&s->p[k]);
}

/* Moves the origin to the last point. */
static void points_recentre(scaled_points *s) {
  const dyd_irect *o = &s->p[s->count - 1];
  for (size_t k = 0; k + 1 < s->count; k++) {
    mpz_sub(s->p[k].x0, s->p[k].x0, o->x0);
    mpz_sub(s->p[k].y0, s->p[k].y0, o->y0);
  }
}

static void points_cross(mpz_t out, mpz_t t, const dyd_irect *a, const dyd_irect *b) {
  mpz_mul(out, a->x0, b->y0);
  mpz_mul(t, a->y0, b->x0);
  mpz_sub(out, out, t);
}

int dyd_mesh_orient_exact(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  scaled_points s;
  mpz_t d, t;
  mpz_init(d);
  mpz_init(t);
  points_load(&s, m, (const uint32_t[]){a, b, c}, 3);
  points_recentre(&s);
  points_cross(d, t, &s.p[0], &s.p[1]);
  int sign = mpz_sgn(d);
  points_unload(&s);
  mpz_clear(t);
  mpz_clear(d);
  return sign;
}

int dyd_mesh_incircle_exact(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  scaled_points s;
  mpz_t d, l, x, t;
  mpz_inits(d, l, x, t, NULL);
  points_load(&s, m, (const uint32_t[]){a, b, c, p}, 4);
  points_recentre(&s);
  for (unsigned k = 0; k < 3; k++) {
    const dyd_irect *q = &s.p[k];
    mpz_mul(l, q->x0, q->x0);
    mpz_addmul(l, q->y0, q->y0);
    points_cross(x, t, &s.p[dyd_next(k)], &s.p[dyd_prev(k)]);
    mpz_addmul(d, l, x);
  }
  int sign = mpz_sgn(d);
  points_unload(&s);
  mpz_clears(d, l, x, t, NULL);
  return sign;
}

int dyd_mesh_compare(const dyd_mesh *m, uint32_t a, uint32_t b) {
  double x = m->xy[a].x - m->xy[b].x, y = m->xy[a].y - m->xy[b].y;
  if (!m->reps->code || fabs(x) > 4 * m->reps->delta) return x != 0 ? (x > 0) - (x < 0) : (y > 0) - (y < 0);
  scaled_points s;
  points_load(&s, m, (const uint32_t[]){a, b}, 2);
  int sign = mpz_cmp(s.p[0].x0, s.p[1].x0);
  if (!sign) sign = mpz_cmp(s.p[0].y0, s.p[1].y0);
  points_unload(&s);
  return (sign > 0) - (sign < 0);
}

static bool is_strictly_between(double a, double b, double p) {
  return a < b ? a < p && p < b : b < p && p < a;
}

bool dyd_mesh_between(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p) {
  if (!m->reps->code && !m->no_filter) /* on one line either coordinate tells, unless it is the same for all */
    return is_strictly_between(m->xy[a].x, m->xy[b].x, m->xy[p].x) ||
           is_strictly_between(m->xy[a].y, m->xy[b].y, m->xy[p].y);
  scaled_points s;
  mpz_t d;
  mpz_init(d);
  points_load(&s, m, (const uint32_t[]){a, b, p}, 3);
  points_recentre(&s);
  mpz_mul(d, s.p[0].x0, s.p[1].x0);
  mpz_addmul(d, s.p[0].y0, s.p[1].y0);
  bool between = mpz_sgn(d) < 0;
  points_unload(&s);
  mpz_clear(d);
  return between;
}

bool dyd_mesh_same(const dyd_mesh *m, uint32_t a, uint32_t b) {
  uint32_t u = dyd_mesh_rep(m, a), v = dyd_mesh_rep(m, b);
  if (m->xy[a].x != m->xy[b].x || m->xy[a].y != m->xy[b].y) return false;
  if (dyd_reps_is_double(m->reps, u) && dyd_reps_is_double(m->reps, v)) return true;
  dyd_rect p, q;
  dyd_rect_init(&p);
  dyd_rect_init(&q);
  bool same =
      dyd_reps_get(&p, m->reps, u) == DYD_OK && dyd_reps_get(&q, m->reps, v) == DYD_OK && dyd_rect_equal(&p, &q);
  dyd_rect_clear(&q);
  dyd_rect_clear(&p);
  return same;
}
