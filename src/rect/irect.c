/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Integer rectangles: scaling, distances and hulls of two.
 *
 * [DIST-1] ds is attained at c clamped to R, dl at the corner diagonally opposite the quadrant of c as seen from the
 * centre of R; both coordinate by coordinate.
 * [HULL-1] An edge of Ed(a,b) is axis-parallel or joins a corner of a to the like corner of b, since in an open
 * quadrant of directions both rectangles have their support at the like corner. Two disjoint compact convex polygons
 * are separated strictly across an edge direction of one of them, or, when both lie on one line, along that line: a
 * slanted line is ordered by x. So the two axes and the four joins of each hull are all directions to try. */
#include "rect/irect.h"

#include "base/invariant.h"

void dyd_irect_init(dyd_irect *r) {
  mpz_inits(r->x0, r->x1, r->y0, r->y1, NULL);
}

void dyd_irect_clear(dyd_irect *r) {
  mpz_clears(r->x0, r->x1, r->y0, r->y1, NULL);
}

/* The least exponent seen and the least common multiple of the denominators. */
typedef struct scale {
  bool any;
  int64_t exp;
  mpz_ptr lcm;
} scale;

static void see_dyadic(scale *s, const dyd_dyadic *x) {
  if (!mpz_sgn(x->man) || (s->any && x->exp >= s->exp)) return;
  s->exp = x->exp;
  s->any = true;
}

static void see_interval(scale *s, const dyd_interval *a) {
  see_dyadic(s, &a->lo);
  see_dyadic(s, &a->hi);
  if (mpz_cmp_ui(a->den, 1)) mpz_lcm(s->lcm, s->lcm, a->den);
}

/* out = x * factor * 2^-exp */
static void scale_dyadic(mpz_ptr out, const dyd_dyadic *x, mpz_srcptr factor, int64_t exp) {
  if (mpz_cmp_ui(factor, 1)) {
    mpz_mul(out, x->man, factor);
  } else {
    mpz_set(out, x->man);
  }
  if (mpz_sgn(out) && x->exp > exp) mpz_mul_2exp(out, out, (mp_bitcnt_t)(x->exp - exp));
}

static void scale_interval(mpz_ptr lo, mpz_ptr hi, const dyd_interval *a, const scale *s, mpz_ptr quotient) {
  mpz_srcptr factor = s->lcm;
  if (mpz_cmp_ui(a->den, 1)) {
    mpz_divexact(quotient, s->lcm, a->den);
    factor = quotient;
  }
  scale_dyadic(lo, &a->lo, factor, s->exp);
  scale_dyadic(hi, &a->hi, factor, s->exp);
  DYD_INVARIANT(mpz_cmp(lo, hi) <= 0);
}

void dyd_irects_scale_with(mpz_ptr cx, mpz_ptr cy, dyd_irect *out, const dyd_point *c, const dyd_rect *const *in,
                           size_t n, mpz_ptr scale_man, int64_t *scale_exp) {
  mpz_t lcm, quotient;
  mpz_init_set_ui(lcm, 1);
  mpz_init(quotient);
  scale s = {false, 0, lcm};
  for (size_t k = 0; k < n; k++) {
    see_interval(&s, &in[k]->x);
    see_interval(&s, &in[k]->y);
  }
  if (c) {
    see_dyadic(&s, &c->x);
    see_dyadic(&s, &c->y);
    scale_dyadic(cx, &c->x, lcm, s.exp);
    scale_dyadic(cy, &c->y, lcm, s.exp);
  }
  for (size_t k = 0; k < n; k++) {
    scale_interval(out[k].x0, out[k].x1, &in[k]->x, &s, quotient);
    scale_interval(out[k].y0, out[k].y1, &in[k]->y, &s, quotient);
  }
  if (scale_man) mpz_set(scale_man, lcm);
  if (scale_exp) *scale_exp = -s.exp;
  mpz_clears(lcm, quotient, NULL);
}

void dyd_irects_scale(dyd_irect *out, const dyd_rect *const *in, size_t n, mpz_ptr scale_man, int64_t *scale_exp) {
  dyd_irects_scale_with(NULL, NULL, out, NULL, in, n, scale_man, scale_exp);
}

void dyd_irects_scale_point(mpz_ptr cx, mpz_ptr cy, dyd_irect *out, const dyd_point *c, const dyd_rect *const *in,
                            size_t n) {
  dyd_irects_scale_with(cx, cy, out, c, in, n, NULL, NULL);
}

/* t = distance from c to the nearest point of [lo,hi]. */
static void closest_on_axis(mpz_ptr t, mpz_srcptr c, mpz_srcptr lo, mpz_srcptr hi) {
  if (mpz_cmp(c, lo) < 0) {
    mpz_sub(t, lo, c);
  } else if (mpz_cmp(c, hi) > 0) {
    mpz_sub(t, c, hi);
  } else {
    mpz_set_ui(t, 0);
  }
}

/* t = distance from c to the farthest point of [lo,hi]; s is scratch. */
static void farthest_on_axis(mpz_ptr t, mpz_ptr s, mpz_srcptr c, mpz_srcptr lo, mpz_srcptr hi) {
  mpz_sub(s, c, lo);
  mpz_sub(t, hi, c);
  if (mpz_cmp(s, t) > 0) mpz_swap(s, t);
}

void dyd_irect_ds2(mpz_ptr out, mpz_srcptr cx, mpz_srcptr cy, const dyd_irect *r) {
  mpz_t t;
  mpz_init(t);
  closest_on_axis(t, cx, r->x0, r->x1);
  mpz_mul(out, t, t);
  closest_on_axis(t, cy, r->y0, r->y1);
  mpz_addmul(out, t, t);
  mpz_clear(t);
}

void dyd_irect_dl2(mpz_ptr out, mpz_srcptr cx, mpz_srcptr cy, const dyd_irect *r) {
  mpz_t s, t;
  mpz_inits(s, t, NULL);
  farthest_on_axis(t, s, cx, r->x0, r->x1);
  mpz_mul(out, t, t);
  farthest_on_axis(t, s, cy, r->y0, r->y1);
  mpz_addmul(out, t, t);
  mpz_clears(s, t, NULL);
}
