/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Throwing out panes without a critical circle, in interval arithmetic.
 *
 * The formulas are those of predicate/solve.c, evaluated on enclosures of the coordinates relative to a corner p on
 * the circle. Every step encloses the true value (predicate/interval_filter.h), so a pane is thrown out only when
 * every root is surely outside one of its bounds or surely not real: no bound on the error is needed beyond that. */
#include "predicate/pane.h"

#include <stdint.h>

/* get_d_2exp cuts towards 0 to 53 bits, so |z| is at most one unit in the last place above; ldexp rounds again only
 * into the subnormals, by half a unit. dyd_down and dyd_up move by a whole unit at least. */
dyd_iv dyd_filter_near(mpz_srcptr z, mpz_srcptr origin, int64_t shift, mpz_ptr scratch) {
  mpz_sub(scratch, z, origin);
  long exp;
  double d = mpz_get_d_2exp(&exp, scratch);
  int64_t e = (int64_t)exp - shift;
  if (exp <= 53 && e > -900 && e < 1000) return dyd_iv_point(ldexp(d, (int)e));
  if (e > 1000) return DYD_IV_UNKNOWN;
  d = ldexp(d, e < -2000 ? -2000 : (int)e);
  return (dyd_iv){dyd_down(d), dyd_up(d)};
}

/* A feature relative to p: a point, or a line across one axis. */
typedef struct feature {
  bool has[2];
  dyd_iv at[2];
} feature;

static feature relative_feature(const dyd_slab *x, const dyd_slab *y, int m, int base) {
  feature f = {{x->mark[m].at != NULL, y->mark[m].at != NULL}, {DYD_IV_UNKNOWN, DYD_IV_UNKNOWN}};
  if (f.has[0]) f.at[0] = dyd_iv_sub(x->mark[m].near, x->mark[base].near);
  if (f.has[1]) f.at[1] = dyd_iv_sub(y->mark[m].near, y->mark[base].near);
  return f;
}

/* Roots found: centres relative to p. known = false: nothing can be said. */
typedef struct roots {
  bool known;
  int count;
  dyd_iv at[2][2]; /* root, axis */
} roots;

static const roots unknown_roots = {false, 0, {{{0, 0}, {0, 0}}, {{0, 0}, {0, 0}}}};
static const roots no_roots = {true, 0, {{{0, 0}, {0, 0}}, {{0, 0}, {0, 0}}}};

static roots iv_two_points(const feature *f, const feature *g) {
  dyd_iv s = dyd_iv_add(dyd_iv_sqr(f->at[0]), dyd_iv_sqr(f->at[1]));
  dyd_iv t = dyd_iv_add(dyd_iv_sqr(g->at[0]), dyd_iv_sqr(g->at[1]));
  dyd_iv det = dyd_iv_sub(dyd_iv_mul(f->at[0], g->at[1]), dyd_iv_mul(g->at[0], f->at[1]));
  dyd_iv u = dyd_iv_sub(dyd_iv_mul(s, g->at[1]), dyd_iv_mul(t, f->at[1]));
  dyd_iv v = dyd_iv_sub(dyd_iv_mul(f->at[0], t), dyd_iv_mul(g->at[0], s));
  dyd_iv det2 = dyd_iv_scale(det, 2);
  return (roots){true, 1, {{dyd_iv_div(u, det2), dyd_iv_div(v, det2)}, {{0, 0}, {0, 0}}}};
}

static roots iv_point_and_line(const feature *point, const feature *line) {
  int k = line->has[0] ? 0 : 1;
  dyd_iv a = point->at[k], b = point->at[1 - k], l = line->at[k];
  dyd_iv s = dyd_iv_add(dyd_iv_sqr(a), dyd_iv_sqr(b));
  dyd_iv c = dyd_iv_mul(dyd_iv_mul(s, l), dyd_iv_sub(l, a));
  if (c.hi < 0) return no_roots;
  dyd_iv root = dyd_iv_sqrt(c), bl = dyd_iv_mul(b, l);
  dyd_iv b2 = dyd_iv_scale(b, 2), a2 = dyd_iv_scale(a, 2);
  roots found = {true, 2, {{{0, 0}, {0, 0}}, {{0, 0}, {0, 0}}}};
  for (int i = 0; i < 2; i++) {
    dyd_iv v = dyd_iv_div(i ? dyd_iv_sub(bl, root) : dyd_iv_add(bl, root), a);
    found.at[i][1 - k] = v;
    found.at[i][k] = dyd_iv_div(dyd_iv_sub(s, dyd_iv_mul(b2, v)), a2);
  }
  return found;
}

static roots iv_parallel_lines(const feature *f, const feature *g, int k) {
  dyd_iv c = dyd_iv_neg(dyd_iv_mul(f->at[k], g->at[k]));
  if (c.hi < 0) return no_roots;
  dyd_iv u = dyd_iv_scale(dyd_iv_add(f->at[k], g->at[k]), 0.5), v = dyd_iv_sqrt(c);
  roots found = {true, 2, {{{0, 0}, {0, 0}}, {{0, 0}, {0, 0}}}};
  found.at[0][k] = found.at[1][k] = u;
  found.at[0][1 - k] = v;
  found.at[1][1 - k] = dyd_iv_neg(v);
  return found;
}

static roots iv_crossing_lines(dyd_iv l, dyd_iv m) {
  dyd_iv lm = dyd_iv_mul(l, m);
  int sign = dyd_iv_sign(lm);
  if (!sign) return unknown_roots;
  if (sign < 0) {
    l = dyd_iv_neg(l); /* centre (-sign m + root, -sign l + sign root) */
    m = dyd_iv_neg(m);
    lm = dyd_iv_neg(lm);
  }
  dyd_iv root = dyd_iv_sqrt(dyd_iv_scale(lm, 2));
  dyd_iv plus_u = dyd_iv_sub(root, m), minus_u = dyd_iv_neg(dyd_iv_add(root, m));
  dyd_iv plus_v = dyd_iv_sub(root, l), minus_v = dyd_iv_neg(dyd_iv_add(root, l));
  if (sign > 0) return (roots){true, 2, {{plus_u, plus_v}, {minus_u, minus_v}}};
  return (roots){true, 2, {{plus_u, minus_v}, {minus_u, plus_v}}};
}

static roots iv_solve(const feature *f, const feature *g) {
  bool f_point = f->has[0] && f->has[1], g_point = g->has[0] && g->has[1];
  if (f_point && g_point) return iv_two_points(f, g);
  if (f_point) return iv_point_and_line(f, g);
  if (g_point) return iv_point_and_line(g, f);
  if (f->has[0] && g->has[0]) return iv_parallel_lines(f, g, 0);
  if (f->has[1] && g->has[1]) return iv_parallel_lines(f, g, 1);
  return f->has[0] ? iv_crossing_lines(f->at[0], g->at[1]) : iv_crossing_lines(g->at[0], f->at[1]);
}

/* Is p + t surely below or above the slab? */
static bool outside_slab(dyd_iv t, dyd_iv p, const dyd_slab *s) {
  dyd_iv at = dyd_iv_add(t, p);
  return (s->lo2 && at.hi < s->lo.lo) || (s->hi2 && at.lo > s->hi.hi);
}

bool dyd_filter_pane_empty(const dyd_slab *x, const dyd_slab *y, int base) {
  feature f = relative_feature(x, y, (base + 1) % 3, base), g = relative_feature(x, y, (base + 2) % 3, base);
  roots found = iv_solve(&f, &g);
  if (!found.known) return false;
  for (int i = 0; i < found.count; i++) {
    if (!outside_slab(found.at[i][0], x->mark[base].near, x) && !outside_slab(found.at[i][1], y->mark[base].near, y))
      return false;
  }
  return true;
}
