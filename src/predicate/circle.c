/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Critical circles of three rectangles, exactly: surds, circles in scaled integers, the panes that may hold a centre,
 * the circles through features, and circles in the coordinates of the caller. */
#include "predicate/circle.h"
#include "dyadic/raw.h"

#include "base/invariant.h"
#include "base/local.h"
#include "predicate/pane.h"

#include <dyadel/dyadic.h>

/* A point (both coordinates) or an axis-parallel line (one, across that axis), relative to the corner. */
typedef struct dyd_feature {
  bool has[2];
  mpz_t at[2];
} dyd_feature;

/* Centres ((a[0] + b[0] sqrt(c)) / d, (a[1] + b[1] sqrt(c)) / d), d > 0, c >= 0. */
typedef struct dyd_centre {
  mpz_t a[2], b[2], c, d;
  mpz_t s, t; /* scratch */
} dyd_centre;

/* The centres of all circles that pass through the origin, pass through each point and touch each line; which picks
 * one of at most DYD_CENTRES_MAX = 2. false: there is none with that number, or infinitely many. */
enum { DYD_CENTRES_MAX = 2 };

/* Comparing (a + b sqrt(c)) / d with the ends and the middle of an interval: [DIST-1] in one coordinate. */

int dyd_surd_compare(mpz_ptr t, const dyd_surd *s, mpz_srcptr z) {
  mpz_set(t, s->a);
  mpz_submul(t, z, s->d);
  return dyd_sqrt_sign(t, s->b, s->c);
}

/* The end of r along the axis closest to s, NULL when s is strictly within; or farthest from s (the upper one at the
 * middle). t, u are scratch. */
static mpz_srcptr surd_end(mpz_ptr t, mpz_ptr u, const dyd_surd *s, const dyd_irect *r, int axis, dyd_touch touch) {
  mpz_srcptr lo = dyd_irect_end(r, axis, 0), hi = dyd_irect_end(r, axis, 1);
  if (touch == DYD_CLOSEST) {
    if (dyd_surd_compare(t, s, lo) <= 0) return lo;
    return dyd_surd_compare(t, s, hi) >= 0 ? hi : NULL;
  }
  mpz_add(u, lo, hi);
  mpz_mul_2exp(t, s->a, 1);
  mpz_submul(t, u, s->d);
  mpz_mul_2exp(u, s->b, 1);
  return dyd_sqrt_sign(t, u, s->c) <= 0 ? hi : lo;
}

/* p + q sqrt c += d^2 ((a + b sqrt c) / d - z)^2; nothing for z = NULL (the distance along this axis is 0). */
static void surd_add_square(mpz_ptr p, mpz_ptr q, mpz_ptr t, const dyd_surd *s, mpz_srcptr z) {
  if (!z) return;
  mpz_mul(t, s->b, s->b);
  mpz_addmul(p, t, s->c);
  mpz_set(t, s->a);
  mpz_submul(t, z, s->d);
  mpz_addmul(p, t, t);
  mpz_mul_2exp(t, t, 1);
  mpz_addmul(q, t, s->b);
}

void dyd_surd_add_distance2(mpz_ptr p, mpz_ptr q, const dyd_surd xy[2], const dyd_irect *r, dyd_touch touch) {
  DYD_LOCAL_NUMBERS(mpz, t, u);
  for (int axis = 0; axis < 2; axis++) surd_add_square(p, q, t, &xy[axis], surd_end(t, u, &xy[axis], r, axis, touch));
}

/* Circles with centre A + B sqrt(C) against integer rectangles.
 *
 * With coordinates relative to the corner p on the circle, radius^2 = u^2 + v^2 for the centre (u,v), so for a point q
 *     |o - q|^2 - radius^2 = |q|^2 - 2 u q_x - 2 v q_y
 * is linear in the centre, and for the line u = l: (u - l)^2 - radius^2 = l^2 - 2 l u - v^2. */

void dyd_icircle_init(dyd_icircle *k) {
  mpz_inits(k->ax, k->bx, k->ay, k->by, k->c, k->px, k->py, NULL);
  mpz_init_set_ui(k->d, 1);
}

void dyd_icircle_clear(dyd_icircle *k) {
  mpz_clears(k->ax, k->bx, k->ay, k->by, k->c, k->d, k->px, k->py, NULL);
}

void dyd_icircle_swap(dyd_icircle *k, dyd_icircle *l) {
  dyd_icircle t = *k;
  *k = *l;
  *l = t;
}

/* Scratch for one comparison: au, av are d times the rational parts of the centre relative to p. */
typedef struct centre_frame {
  mpz_t au, av, l, m, s, t;
} centre_frame;

static void centre_frame_init(centre_frame *f, const dyd_icircle *k) {
  mpz_inits(f->au, f->av, f->l, f->m, f->s, f->t, NULL);
  mpz_set(f->au, k->ax);
  mpz_submul(f->au, k->px, k->d);
  mpz_set(f->av, k->ay);
  mpz_submul(f->av, k->py, k->d);
}

static void centre_frame_clear(centre_frame *f) {
  mpz_clears(f->au, f->av, f->l, f->m, f->s, f->t, NULL);
}

/* Sign of |o - q| - radius, q = (l,m) relative to p. */
static int side_of_point(centre_frame *f, const dyd_icircle *k) {
  mpz_mul(f->s, f->l, f->l);
  mpz_addmul(f->s, f->m, f->m);
  mpz_mul(f->s, f->s, k->d);
  mpz_mul(f->t, f->au, f->l);
  mpz_addmul(f->t, f->av, f->m);
  mpz_mul_2exp(f->t, f->t, 1);
  mpz_sub(f->s, f->s, f->t);
  mpz_mul(f->t, k->bx, f->l);
  mpz_addmul(f->t, k->by, f->m);
  mpz_mul_si(f->t, f->t, -2);
  return dyd_sqrt_sign(f->s, f->t, k->c);
}

/* Sign of |u - l| - radius, with u = (au + bu sqrt c) / d across the line. Times d^2 the square difference is
 * l^2 d^2 - 2 l d au - av^2 - bv^2 c  -  2 (l d bu + av bv) sqrt c. */
static int side_of_line(centre_frame *f, const dyd_icircle *k, mpz_srcptr au, mpz_srcptr bu, mpz_srcptr av,
                        mpz_srcptr bv) {
  mpz_mul(f->m, f->l, k->d);
  mpz_mul_2exp(f->t, au, 1);
  mpz_sub(f->t, f->m, f->t);
  mpz_mul(f->s, f->m, f->t);
  mpz_submul(f->s, av, av);
  mpz_mul(f->t, bv, bv);
  mpz_submul(f->s, f->t, k->c);
  mpz_mul(f->t, f->m, bu);
  mpz_addmul(f->t, av, bv);
  mpz_mul_si(f->t, f->t, -2);
  return dyd_sqrt_sign(f->s, f->t, k->c);
}

int dyd_icircle_side(const dyd_icircle *k, const dyd_irect *r, dyd_touch touch) {
  DYD_INVARIANT(mpz_sgn(k->d) > 0 && mpz_sgn(k->c) >= 0);
  DYD_SCOPED(centre_frame) f;
  centre_frame_init(&f, k);
  dyd_surd ox = {k->ax, k->bx, k->c, k->d}, oy = {k->ay, k->by, k->c, k->d};
  mpz_srcptr x = surd_end(f.s, f.t, &ox, r, 0, touch), y = surd_end(f.s, f.t, &oy, r, 1, touch);
  int side = -1; /* the centre is within: 0 minus the radius, which is positive */
  if (x) mpz_sub(f.l, x, k->px);
  if (y) mpz_sub(f.m, y, k->py);
  if (x && y) {
    side = side_of_point(&f, k);
  } else if (x) {
    side = side_of_line(&f, k, f.au, k->bx, f.av, k->by);
  } else if (y) {
    mpz_set(f.l, f.m);
    side = side_of_line(&f, k, f.av, k->by, f.au, k->bx);
  }
  return side;
}

int dyd_icircle_compare(const dyd_icircle *k, const dyd_icircle *l, int axis) {
  mpz_srcptr ak = axis ? k->ay : k->ax, bk = axis ? k->by : k->bx, al = axis ? l->ay : l->ax, bl = axis ? l->by : l->bx;
  DYD_LOCAL_NUMBERS(mpz, a, b, d);
  mpz_mul(a, ak, l->d);
  mpz_submul(a, al, k->d);
  mpz_mul(b, bk, l->d);
  mpz_mul(d, bl, k->d);
  mpz_neg(d, d);
  return dyd_sqrt2_sign(a, b, k->c, d, l->c);
}

/* Cutting an axis into the slabs of predicate/pane.h.
 *
 * Bounds are kept doubled, since the middle of an integer interval may be a half. Slabs of width 0 are omitted:
 * they are part of their neighbours, which are closed. */

static void axis_init(dyd_axis *a) {
  for (int k = 0; k < 6; k++) mpz_init(a->line2[k]);
}

static void axis_clear(dyd_axis *a) {
  for (int k = 0; k < 6; k++) mpz_clear(a->line2[k]);
}

/* Writes the doubled lines in ascending order without repeats; returns how many. */
static size_t set_slab_lines(dyd_axis *a, const dyd_irect *const r[3], const dyd_touch touch[3], int axis) {
  size_t n = 0;
  for (int m = 0; m < 3; m++) {
    if (touch[m] == DYD_FARTHEST) {
      mpz_add(a->line2[n++], dyd_irect_end(r[m], axis, 0), dyd_irect_end(r[m], axis, 1));
    } else {
      mpz_mul_2exp(a->line2[n++], dyd_irect_end(r[m], axis, 0), 1);
      mpz_mul_2exp(a->line2[n++], dyd_irect_end(r[m], axis, 1), 1);
    }
  }
  for (size_t i = 1; i < n; i++) {
    for (size_t j = i; j > 0 && mpz_cmp(a->line2[j - 1], a->line2[j]) > 0; j--) {
      mpz_swap(a->line2[j - 1], a->line2[j]);
    }
  }
  size_t kept = 1;
  for (size_t i = 1; i < n; i++) {
    if (mpz_cmp(a->line2[kept - 1], a->line2[i]) != 0) mpz_swap(a->line2[kept++], a->line2[i]);
  }
  return kept;
}

/* What a rectangle shows to a slab: its lower or upper end, or nothing fixed (NULL). t: scratch. */
static mpz_srcptr shown_end(const dyd_slab *s, const dyd_irect *r, dyd_touch touch, int axis, mpz_ptr t) {
  mpz_srcptr lo = dyd_irect_end(r, axis, 0), hi = dyd_irect_end(r, axis, 1);
  if (touch == DYD_FARTHEST) {
    mpz_add(t, lo, hi);
    return s->hi2 && mpz_cmp(s->hi2, t) <= 0 ? hi : lo;
  }
  mpz_mul_2exp(t, lo, 1);
  if (s->hi2 && mpz_cmp(s->hi2, t) <= 0) return lo;
  mpz_mul_2exp(t, hi, 1);
  if (s->lo2 && mpz_cmp(s->lo2, t) >= 0) return hi;
  return NULL;
}

/* The slabs of axis 0 (x) or 1 (y). */
static void axis_set(dyd_axis *out, const dyd_irect *const r[3], const dyd_touch touch[3], int axis, mpz_srcptr origin,
                     int64_t shift) {
  DYD_LOCAL_NUMBERS(mpz, t, origin2);
  mpz_mul_2exp(origin2, origin, 1);
  size_t lines = set_slab_lines(out, r, touch, axis);
  dyd_iv near_end[3][2];
  for (int m = 0; m < 3; m++) {
    near_end[m][0] = dyd_filter_near(dyd_irect_end(r[m], axis, 0), origin, shift, t);
    near_end[m][1] = dyd_filter_near(dyd_irect_end(r[m], axis, 1), origin, shift, t);
  }
  out->slabs = lines + 1;
  for (size_t k = 0; k <= lines; k++) {
    dyd_slab *s = &out->slab[k];
    s->lo2 = k > 0 ? out->line2[k - 1] : NULL;
    s->hi2 = k < lines ? out->line2[k] : NULL;
    s->lo = k > 0 ? out->slab[k - 1].hi : DYD_IV_UNKNOWN;
    s->hi = k < lines ? dyd_filter_near(out->line2[k], origin2, shift + 1, t) : DYD_IV_UNKNOWN;
    for (int m = 0; m < 3; m++) {
      mpz_srcptr at = shown_end(s, r[m], touch[m], axis, t);
      s->mark[m].at = at;
      s->mark[m].near = at == dyd_irect_end(r[m], axis, 1) ? near_end[m][1] : near_end[m][0];
    }
  }
}

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

static void feature_init(dyd_feature *f) {
  mpz_inits(f->at[0], f->at[1], NULL);
}

static void feature_clear(dyd_feature *f) {
  mpz_clears(f->at[0], f->at[1], NULL);
}

static void centre_init(dyd_centre *k) {
  mpz_inits(k->a[0], k->a[1], k->b[0], k->b[1], k->c, k->d, k->s, k->t, NULL);
}

static void centre_clear(dyd_centre *k) {
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

static bool solve_circle(dyd_centre *out, const dyd_feature *f, const dyd_feature *g, int which) {
  bool f_point = f->has[0] && f->has[1], g_point = g->has[0] && g->has[1];
  if (f_point && g_point) return which == 0 && solve_two_points(out, f, g);
  if (f_point) return solve_point_and_line(out, f, g, which);
  if (g_point) return solve_point_and_line(out, g, f, which);
  if (f->has[0] && g->has[0]) return solve_parallel_lines(out, f->at[0], g->at[0], 0, which);
  if (f->has[1] && g->has[1]) return solve_parallel_lines(out, f->at[1], g->at[1], 1, which);
  return f->has[0] ? solve_crossing_lines(out, f->at[0], g->at[1], which)
                   : solve_crossing_lines(out, g->at[0], f->at[1], which);
}

/* All critical circles of three integer rectangles.
 *
 * [CRIT-1] A circle that meets r[m] as touch[m] says has its centre in some pane of predicate/pane.h, where its three
 * features are known; a C-rectangle around the centre has ds = 0, which is not a circle. Conversely a centre in a
 * closed pane, found from the features of that pane, has exactly these features at distance ds or dl. So the circles
 * are the solutions of predicate/circle.c, pane by pane, whose centre is in the pane. Some rectangle is F, hence some
 * corner is on the circle. */

/* Everything one call needs, allocated once. */
typedef struct circle_search {
  const dyd_irect *const *r;
  const dyd_touch *touch;
  int base;
  dyd_axis axis[2];
  dyd_feature f, g;
  dyd_centre centre;
  dyd_icircle circle;
  mpz_t s, t;
} circle_search;

static void circle_search_init(circle_search *q) {
  for (int k = 0; k < 2; k++) axis_init(&q->axis[k]);
  feature_init(&q->f);
  feature_init(&q->g);
  centre_init(&q->centre);
  dyd_icircle_init(&q->circle);
  mpz_inits(q->s, q->t, NULL);
}

static void circle_search_clear(circle_search *q) {
  mpz_clears(q->s, q->t, NULL);
  dyd_icircle_clear(&q->circle);
  centre_clear(&q->centre);
  feature_clear(&q->g);
  feature_clear(&q->f);
  for (int k = 2; k-- > 0;) axis_clear(&q->axis[k]);
}

/* Coordinates relative to a corner of the base, cut so that products of four stay below 2^1000. */
static int64_t circles_choose_shift(circle_search *q) {
  const dyd_irect *o = q->r[q->base];
  size_t bits = 0;
  for (int m = 0; m < 3; m++) {
    mpz_srcptr at[4] = {q->r[m]->x0, q->r[m]->x1, q->r[m]->y0, q->r[m]->y1};
    for (int k = 0; k < 4; k++) {
      mpz_sub(q->t, at[k], k < 2 ? o->x0 : o->y0);
      size_t b = mpz_sizeinbase(q->t, 2);
      if (b > bits) bits = b;
    }
  }
  return bits > 200 ? (int64_t)bits - 200 : 0;
}

/* The feature of rectangle m in a pane, relative to the corner of the base; false: the centre itself. */
static bool circles_set_feature(dyd_feature *out, const dyd_slab *const s[2], int m, int base) {
  for (int k = 0; k < 2; k++) {
    mpz_srcptr at = s[k]->mark[m].at;
    out->has[k] = at != NULL;
    if (at) mpz_sub(out->at[k], at, s[k]->mark[base].at);
  }
  return out->has[0] || out->has[1];
}

/* circle = centre + corner of the base; false when the radius is 0. */
static bool circle_place(circle_search *q, const dyd_slab *const s[2]) {
  dyd_centre *o = &q->centre;
  dyd_icircle *k = &q->circle;
  if (!dyd_sqrt_sign(o->a[0], o->b[0], o->c) && !dyd_sqrt_sign(o->a[1], o->b[1], o->c)) return false;
  mpz_set(k->px, s[0]->mark[q->base].at);
  mpz_set(k->py, s[1]->mark[q->base].at);
  mpz_swap(k->ax, o->a[0]);
  mpz_addmul(k->ax, k->px, o->d);
  mpz_swap(k->ay, o->a[1]);
  mpz_addmul(k->ay, k->py, o->d);
  mpz_swap(k->bx, o->b[0]);
  mpz_swap(k->by, o->b[1]);
  mpz_swap(k->c, o->c);
  mpz_swap(k->d, o->d);
  return true;
}

/* Returns true if the coordinate (a + b sqrt c) / d is within the slab. */
static bool within_slab(circle_search *q, mpz_srcptr a, mpz_srcptr b, const dyd_slab *s) {
  const dyd_icircle *k = &q->circle;
  mpz_mul_2exp(q->s, b, 1);
  for (int side = 0; side < 2; side++) {
    mpz_srcptr bound = side ? s->hi2 : s->lo2;
    if (!bound) continue;
    mpz_mul_2exp(q->t, a, 1);
    mpz_submul(q->t, bound, k->d);
    int sign = dyd_sqrt_sign(q->t, q->s, k->c);
    if (side ? sign > 0 : sign < 0) return false;
  }
  return true;
}

static bool circle_is_new(const dyd_icircle *out, size_t count, const dyd_icircle *k) {
  for (size_t i = 0; i < count; i++) {
    if (!dyd_icircle_compare(&out[i], k, 0) && !dyd_icircle_compare(&out[i], k, 1)) return false;
  }
  return true;
}

/* Adds the circles of one pane. */
static size_t search_pane(circle_search *q, dyd_icircle *out, size_t count, size_t room, const dyd_slab *const s[2]) {
  if (!circles_set_feature(&q->f, s, (q->base + 1) % 3, q->base)) return count;
  if (!circles_set_feature(&q->g, s, (q->base + 2) % 3, q->base)) return count;
  if (dyd_filter_pane_empty(s[0], s[1], q->base)) return count;
  for (int which = 0; which < DYD_CENTRES_MAX && count < room; which++) {
    if (!solve_circle(&q->centre, &q->f, &q->g, which) || !circle_place(q, s)) continue;
    if (!within_slab(q, q->circle.ax, q->circle.bx, s[0]) || !within_slab(q, q->circle.ay, q->circle.by, s[1]))
      continue;
    if (circle_is_new(out, count, &q->circle)) dyd_icircle_swap(&out[count++], &q->circle);
  }
  return count;
}

size_t dyd_icircles(dyd_icircle *out, size_t room, const dyd_irect *const r[3], const dyd_touch touch[3]) {
  circle_search q = {.r = r, .touch = touch, .base = 0};
  while (q.base < 3 && touch[q.base] != DYD_FARTHEST) q.base++;
  DYD_INVARIANT(q.base < 3);
  circle_search_init(&q);
  int64_t shift = circles_choose_shift(&q);
  axis_set(&q.axis[0], r, touch, 0, r[q.base]->x0, shift);
  axis_set(&q.axis[1], r, touch, 1, r[q.base]->y0, shift);
  size_t count = 0;
  for (size_t i = 0; i < q.axis[0].slabs; i++) {
    for (size_t j = 0; j < q.axis[1].slabs && count < room; j++) {
      const dyd_slab *s[2] = {&q.axis[0].slab[i], &q.axis[1].slab[j]};
      count = search_pane(&q, out, count, room, s);
    }
  }
  circle_search_clear(&q);
  return count;
}

/* Circles in the coordinates of their rectangles.
 *
 * Scaling by F > 0 multiplies centres by F and squared radii by F^2. With F = m 2^e a circle found in scaled integers
 * is divided by F, and a circle is compared with a rectangle after both are multiplied by F. */

void dyd_circle_init(dyd_circle *c) {
  mpz_inits(c->ax, c->bx, c->ay, c->by, c->c, c->ar, c->br, NULL);
  mpz_init_set_ui(c->d, 1);
  mpz_init_set_ui(c->dr, 1);
}

void dyd_circle_clear(dyd_circle *c) {
  mpz_clears(c->ax, c->bx, c->ay, c->by, c->c, c->d, c->ar, c->br, c->dr, NULL);
}

void dyd_circle_set(dyd_circle *out, const dyd_circle *c) {
  mpz_set(out->ax, c->ax);
  mpz_set(out->bx, c->bx);
  mpz_set(out->ay, c->ay);
  mpz_set(out->by, c->by);
  mpz_set(out->c, c->c);
  mpz_set(out->d, c->d);
  mpz_set(out->ar, c->ar);
  mpz_set(out->br, c->br);
  mpz_set(out->dr, c->dr);
}

/* radius^2 = u^2 + v^2, u = (au + bx sqrt c) / d with au = ax - px d. */
static void circle_set_radius(dyd_circle *out, const dyd_icircle *k) {
  mpz_t u, v;
  mpz_init_set(u, k->ax);
  mpz_init_set(v, k->ay);
  mpz_submul(u, k->px, k->d);
  mpz_submul(v, k->py, k->d);
  mpz_mul(out->br, u, k->bx);
  mpz_addmul(out->br, v, k->by);
  mpz_mul_2exp(out->br, out->br, 1);
  mpz_mul(out->ar, k->bx, k->bx);
  mpz_addmul(out->ar, k->by, k->by);
  mpz_mul(out->ar, out->ar, k->c);
  mpz_addmul(out->ar, u, u);
  mpz_addmul(out->ar, v, v);
  mpz_mul(out->dr, k->d, k->d);
  mpz_clear(v);
  mpz_clear(u);
}

void dyd_circle_unscale(dyd_circle *out, const dyd_icircle *k, mpz_srcptr man, int64_t exp) {
  circle_set_radius(out, k);
  mpz_set(out->ax, k->ax);
  mpz_set(out->bx, k->bx);
  mpz_set(out->ay, k->ay);
  mpz_set(out->by, k->by);
  mpz_set(out->c, k->c);
  mpz_mul(out->d, k->d, man);
  mpz_mul(out->dr, out->dr, man);
  mpz_mul(out->dr, out->dr, man);
  dyd_shift_up(out->d, exp);
  dyd_shift_up(out->dr, 2 * exp);
  mpz_ptr centre[4] = {out->ax, out->bx, out->ay, out->by}, radius[2] = {out->ar, out->br};
  for (int i = 0; i < 4; i++) dyd_shift_up(centre[i], -exp);
  for (int i = 0; i < 2; i++) dyd_shift_up(radius[i], -2 * exp);
}

/* k and r multiplied by F, then both by 2^-exp if exp < 0, which makes everything an integer again. */
static void circle_rescale(dyd_circle *k, dyd_irect *r, mpz_srcptr man, int64_t exp) {
  mpz_ptr centre[4] = {k->ax, k->bx, k->ay, k->by}, radius[2] = {k->ar, k->br}, end[4] = {r->x0, r->x1, r->y0, r->y1};
  for (int i = 0; i < 4; i++) {
    mpz_mul(centre[i], centre[i], man);
    dyd_shift_up(centre[i], exp);
    dyd_shift_up(end[i], -exp);
  }
  for (int i = 0; i < 2; i++) {
    mpz_mul(radius[i], radius[i], man);
    mpz_mul(radius[i], radius[i], man);
    dyd_shift_up(radius[i], 2 * exp);
  }
}

/* Sign of distance^2 - radius^2 = (p + q sqrt c) / d^2 - (ar + br sqrt c) / dr. */
static int circle_side_scaled(const dyd_circle *k, const dyd_irect *r, dyd_touch touch) {
  const dyd_surd centre[2] = {{k->ax, k->bx, k->c, k->d}, {k->ay, k->by, k->c, k->d}};
  DYD_LOCAL_NUMBERS(mpz, p, q, t);
  dyd_surd_add_distance2(p, q, centre, r, touch);
  mpz_mul(p, p, k->dr);
  mpz_mul(q, q, k->dr);
  mpz_mul(t, k->d, k->d);
  mpz_submul(p, k->ar, t);
  mpz_submul(q, k->br, t);
  return dyd_sqrt_sign(p, q, k->c);
}

int dyd_circle_side(const dyd_circle *c, const dyd_rect *r, dyd_touch touch) {
  int64_t exp;
  DYD_LOCAL(dyd_circle, k);
  DYD_LOCAL(dyd_irect, scaled);
  DYD_LOCAL_NUMBERS(mpz, man);
  dyd_irects_scale(&scaled, &r, 1, man, &exp);
  dyd_circle_set(&k, c);
  circle_rescale(&k, &scaled, man, exp);
  return circle_side_scaled(&k, &scaled, touch);
}
