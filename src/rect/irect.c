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
#include "base/local.h"

/* Convex hulls of two integer rectangles: area and disjointness.
 *
 * With w, h the sides of the box that bounds a and b, the hull is that box less one triangle at each of its corners
 * where neither rectangle reaches it: there the join of the two like corners cuts off a triangle with legs |dx|, |dy|.
 * At a corner of direction (s,t) the two like corners differ by (dx,dy) with s dx and t dy of opposite signs; when the
 * signs agree, one rectangle has the corner of the bounding box itself. So
 *     2 area = 2 w h - sum over corners of |dx dy| where s dx * t dy < 0.
 * The four triangles do not overlap: the legs on a side of the box lie on disjoint parts of it. */

static mpz_srcptr lesser_z(mpz_srcptr a, mpz_srcptr b) {
  return mpz_cmp(a, b) <= 0 ? a : b;
}

static mpz_srcptr larger_z(mpz_srcptr a, mpz_srcptr b) {
  return mpz_cmp(a, b) >= 0 ? a : b;
}

void dyd_irect_partial_edge_area2(mpz_ptr out, const dyd_irect *a, const dyd_irect *b) {
  DYD_LOCAL_NUMBERS(mpz, w, h);
  mpz_sub(w, larger_z(a->x1, b->x1), lesser_z(a->x0, b->x0));
  mpz_sub(h, larger_z(a->y1, b->y1), lesser_z(a->y0, b->y0));
  mpz_mul(out, w, h);
  mpz_mul_2exp(out, out, 1);
  for (int corner = 0; corner < 4; corner++) {
    int right = corner & 1, upper = corner >> 1;
    mpz_sub(w, dyd_irect_end(b, 0, right), dyd_irect_end(a, 0, right));
    mpz_sub(h, dyd_irect_end(b, 1, upper), dyd_irect_end(a, 1, upper));
    int sign = mpz_sgn(w) * mpz_sgn(h) * (right == upper ? 1 : -1);
    if (sign >= 0) continue;
    mpz_mul(w, w, h);
    mpz_abs(w, w);
    mpz_sub(out, out, w);
  }
}

/* out = largest value of nx x + ny y over r (side = 1) or smallest (side = 0). */
static void irect_support(mpz_ptr out, mpz_srcptr nx, mpz_srcptr ny, const dyd_irect *r, int side) {
  mpz_mul(out, nx, dyd_irect_end(r, 0, mpz_sgn(nx) >= 0 ? side : !side));
  mpz_addmul(out, ny, dyd_irect_end(r, 1, mpz_sgn(ny) >= 0 ? side : !side));
}

/* Returns true if max n.(a u b) < min n.(c u d).  u, v: scratch. */
static bool edge_precedes(mpz_srcptr nx, mpz_srcptr ny, const dyd_irect *const p[2], const dyd_irect *const q[2],
                          mpz_ptr u, mpz_ptr v) {
  for (int i = 0; i < 2; i++) {
    irect_support(u, nx, ny, p[i], 1);
    for (int j = 0; j < 2; j++) {
      irect_support(v, nx, ny, q[j], 0);
      if (mpz_cmp(u, v) >= 0) return false;
    }
  }
  return true;
}

static bool normal_separates(mpz_srcptr nx, mpz_srcptr ny, const dyd_irect *const p[2], const dyd_irect *const q[2],
                             mpz_ptr u, mpz_ptr v) {
  return edge_precedes(nx, ny, p, q, u, v) || edge_precedes(nx, ny, q, p, u, v);
}

/* The axes, by comparisons only. */
static bool edge_boxes_disjoint(const dyd_irect *const p[2], const dyd_irect *const q[2]) {
  return mpz_cmp(larger_z(p[0]->x1, p[1]->x1), lesser_z(q[0]->x0, q[1]->x0)) < 0 ||
         mpz_cmp(larger_z(q[0]->x1, q[1]->x1), lesser_z(p[0]->x0, p[1]->x0)) < 0 ||
         mpz_cmp(larger_z(p[0]->y1, p[1]->y1), lesser_z(q[0]->y0, q[1]->y0)) < 0 ||
         mpz_cmp(larger_z(q[0]->y1, q[1]->y1), lesser_z(p[0]->y0, p[1]->y0)) < 0;
}

bool dyd_irect_partial_edges_disjoint(const dyd_irect *a, const dyd_irect *b, const dyd_irect *c, const dyd_irect *d) {
  const dyd_irect *p[2] = {a, b}, *q[2] = {c, d};
  if (edge_boxes_disjoint(p, q)) return true;
  DYD_LOCAL_NUMBERS(mpz, nx, ny, u, v);
  bool disjoint = false;
  for (int join = 0; join < 8 && !disjoint; join++) {
    const dyd_irect *const *e = join < 4 ? p : q;
    int right = join & 1, upper = (join >> 1) & 1;
    mpz_sub(nx, dyd_irect_end(e[0], 1, upper), dyd_irect_end(e[1], 1, upper));
    mpz_sub(ny, dyd_irect_end(e[1], 0, right), dyd_irect_end(e[0], 0, right));
    disjoint = normal_separates(nx, ny, p, q, u, v);
  }
  return disjoint;
}

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
  DYD_LOCAL_NUMBERS(mpz, lcm);
  mpz_set_ui(lcm, 1);
  DYD_LOCAL_NUMBERS(mpz, quotient);
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
  DYD_LOCAL_NUMBERS(mpz, t);
  closest_on_axis(t, cx, r->x0, r->x1);
  mpz_mul(out, t, t);
  closest_on_axis(t, cy, r->y0, r->y1);
  mpz_addmul(out, t, t);
}

void dyd_irect_dl2(mpz_ptr out, mpz_srcptr cx, mpz_srcptr cy, const dyd_irect *r) {
  DYD_LOCAL_NUMBERS(mpz, s, t);
  farthest_on_axis(t, s, cx, r->x0, r->x1);
  mpz_mul(out, t, t);
  farthest_on_axis(t, s, cy, r->y0, r->y1);
  mpz_addmul(out, t, t);
}
