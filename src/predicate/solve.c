/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Circles through the origin and two more features: points (P) and axis-parallel lines (L).
 *
 * The centre (u,v) of a circle through the origin has squared radius u^2 + v^2. Then
 *     point (a,b):  2 a u + 2 b v = a^2 + b^2 =: s          line u = l:  v^2 + 2 l u = l^2.
 * PP   two linear equations with determinant 2 D: u = (s g_b - t f_b) / 2D, v = (f_a t - g_a s) / 2D.
 * PL   with the line u = l and a != 0: a v^2 - 2 b l v + l s - a l^2 = 0, whose discriminant is
 *      b^2 l^2 - a l s + a^2 l^2 = s l (l - a) =: c, so v = (b l +- sqrt c) / a and u = (s - 2 b v) / 2a.
 *      With a = 0: v = b / 2, u = (l^2 - v^2) / 2l, and nothing isolated when l = 0 or b = 0.
 * LL   parallel u = l, u = m, l != m: u = (l + m) / 2, v = +- sqrt(-l m).
 *      crossing u = l, v = m: the centre is on a 45-degree line v - m = z (u - l), z = +-1, and w = u - l has
 *      w^2 + 2 (l + z m) w + l^2 + m^2 = 0, so u = -z m +- sqrt(2 z l m), v = -z l +- z sqrt(2 z l m).
 *      For l m != 0 only z = sign(l m) is real; for l m = 0 both z give one centre each. */
#include "predicate/solve.h"

void dyd_feature_init(dyd_feature *f) {
  mpz_inits(f->at[0], f->at[1], NULL);
}

void dyd_feature_clear(dyd_feature *f) {
  mpz_clears(f->at[0], f->at[1], NULL);
}

void dyd_centre_init(dyd_centre *k) {
  mpz_inits(k->a[0], k->a[1], k->b[0], k->b[1], k->c, k->d, k->s, k->t, NULL);
}

void dyd_centre_clear(dyd_centre *k) {
  mpz_clears(k->a[0], k->a[1], k->b[0], k->b[1], k->c, k->d, k->s, k->t, NULL);
}

/* s = |f|^2 */
static void feature_norm2(mpz_ptr s, const dyd_feature *f) {
  mpz_mul(s, f->at[0], f->at[0]);
  mpz_addmul(s, f->at[1], f->at[1]);
}

static void centre_make_rational(dyd_centre *out) {
  mpz_set_ui(out->b[0], 0);
  mpz_set_ui(out->b[1], 0);
  mpz_set_ui(out->c, 0);
}

static void centre_make_positive(dyd_centre *out) {
  if (mpz_sgn(out->d) > 0) return;
  mpz_neg(out->d, out->d);
  mpz_neg(out->a[0], out->a[0]);
  mpz_neg(out->a[1], out->a[1]);
}

static bool solve_two_points(dyd_centre *out, const dyd_feature *f, const dyd_feature *g) {
  mpz_mul(out->d, f->at[0], g->at[1]);
  mpz_submul(out->d, g->at[0], f->at[1]);
  if (!mpz_sgn(out->d)) return false;
  mpz_mul_2exp(out->d, out->d, 1);
  feature_norm2(out->s, f);
  feature_norm2(out->t, g);
  mpz_mul(out->a[0], out->s, g->at[1]);
  mpz_submul(out->a[0], out->t, f->at[1]);
  mpz_mul(out->a[1], f->at[0], out->t);
  mpz_submul(out->a[1], g->at[0], out->s);
  centre_make_rational(out);
  centre_make_positive(out);
  return true;
}

/* a = 0: a line parallel to the join of the origin and the point. */
static bool solve_point_beside_line(dyd_centre *out, mpz_srcptr b, mpz_srcptr l, int k) {
  if (!mpz_sgn(b) || !mpz_sgn(l)) return false;
  mpz_mul_2exp(out->d, l, 3);
  mpz_mul(out->a[1 - k], b, l);
  mpz_mul_2exp(out->a[1 - k], out->a[1 - k], 2);
  mpz_mul(out->a[k], l, l);
  mpz_mul_2exp(out->a[k], out->a[k], 2);
  mpz_submul(out->a[k], b, b);
  centre_make_rational(out);
  centre_make_positive(out);
  return true;
}

static bool solve_point_and_line(dyd_centre *out, const dyd_feature *point, const dyd_feature *line, int which) {
  int k = line->has[0] ? 0 : 1;
  mpz_srcptr a = point->at[k], b = point->at[1 - k], l = line->at[k];
  if (!mpz_sgn(a)) return which == 0 && solve_point_beside_line(out, b, l, k);
  mpz_sub(out->t, l, a);
  mpz_mul(out->t, out->t, l);
  if (mpz_sgn(out->t) < 0 || (which && !mpz_sgn(out->t))) return false;
  feature_norm2(out->s, point);
  mpz_mul(out->c, out->s, out->t);
  mpz_mul(out->d, a, a);
  mpz_mul_2exp(out->d, out->d, 1);
  mpz_mul_2exp(out->b[1 - k], a, 1);             /* v = (2 a b l +- 2 a sqrt c) / d */
  mpz_mul(out->t, b, l);                         /* b l */
  mpz_mul(out->a[1 - k], out->b[1 - k], out->t); /* 2 a b l */
  mpz_mul_2exp(out->b[k], b, 1);                 /* u = (s a - 2 b^2 l -+ 2 b sqrt c) / d */
  mpz_mul(out->a[k], out->s, a);
  mpz_submul(out->a[k], out->b[k], out->t);
  mpz_ptr negative = which ? out->b[1 - k] : out->b[k];
  mpz_neg(negative, negative);
  return true;
}

static bool solve_parallel_lines(dyd_centre *out, mpz_srcptr l, mpz_srcptr m, int k, int which) {
  mpz_mul(out->c, l, m);
  mpz_neg(out->c, out->c);
  if (!mpz_cmp(l, m) || mpz_sgn(out->c) < 0 || (which && !mpz_sgn(out->c))) return false;
  mpz_add(out->a[k], l, m);
  mpz_set_ui(out->b[k], 0);
  mpz_set_ui(out->a[1 - k], 0);
  mpz_set_si(out->b[1 - k], which ? -2 : 2);
  mpz_set_ui(out->d, 2);
  return true;
}

static bool solve_crossing_lines(dyd_centre *out, mpz_srcptr l, mpz_srcptr m, int which) {
  int z = mpz_sgn(l) * mpz_sgn(m);
  int root = which ? -1 : 1;
  if (!z) {
    z = root;
    root = 0;
  }
  mpz_mul(out->c, l, m);
  mpz_mul_2exp(out->c, out->c, 1);
  mpz_abs(out->c, out->c);
  mpz_mul_si(out->a[0], m, -z);
  mpz_mul_si(out->a[1], l, -z);
  mpz_set_si(out->b[0], root);
  mpz_set_si(out->b[1], root * z);
  mpz_set_ui(out->d, 1);
  return true;
}

bool dyd_solve(dyd_centre *out, const dyd_feature *f, const dyd_feature *g, int which) {
  bool f_point = f->has[0] && f->has[1], g_point = g->has[0] && g->has[1];
  if (f_point && g_point) return which == 0 && solve_two_points(out, f, g);
  if (f_point) return solve_point_and_line(out, f, g, which);
  if (g_point) return solve_point_and_line(out, g, f, which);
  if (f->has[0] && g->has[0]) return solve_parallel_lines(out, f->at[0], g->at[0], 0, which);
  if (f->has[1] && g->has[1]) return solve_parallel_lines(out, f->at[1], g->at[1], 1, which);
  return f->has[0] ? solve_crossing_lines(out, f->at[0], g->at[1], which)
                   : solve_crossing_lines(out, g->at[0], f->at[1], which);
}
