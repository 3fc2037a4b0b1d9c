/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rectangles and dyadic points: life, order and distances.
 *
 * A rectangle is a product of intervals, and inclusion, meeting and equality are those of its sides. */
#include "rect/rect.h"

#include "base/invariant.h"
#include "base/local.h"
#include "dyadic/raw.h"
#include "rect/irect.h"

#include <dyadel/rect.h>
#include <mpfr.h>

/* Integer rectangles: scaling, distances and hulls of two.
 *
 * [DIST-1] ds is attained at c clamped to R, dl at the corner diagonally opposite the quadrant of c as seen from the
 * centre of R; both coordinate by coordinate.
 * [HULL-1] An edge of Ed(a,b) is axis-parallel or joins a corner of a to the like corner of b, since in an open
 * quadrant of directions both rectangles have their support at the like corner. Two disjoint compact convex polygons
 * are separated strictly across an edge direction of one of them, or, when both lie on one line, along that line: a
 * slanted line is ordered by x. So the two axes and the four joins of each hull are all directions to try. */

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

/* Twice the area of the convex hull of a u b. */
static void dyd_irect_partial_edge_area2(mpz_ptr out, const dyd_irect *a, const dyd_irect *b) {
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

/* Returns true if the convex hulls of a u b and of c u d are disjoint. Touching counts as meeting [HULL-1]. */
static bool dyd_irect_partial_edges_disjoint(const dyd_irect *a, const dyd_irect *b, const dyd_irect *c,
                                             const dyd_irect *d) {
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

/* Closed intervals with exact ends.
 *
 * The end lo/den is a dyadic over an odd number; ends are compared by cross multiplication, which may leave the
 * exponent range of dyadics and is done on raw integers. */

bool dyd_interval_is_valid(const dyd_interval *a) {
  if (!dyd_dyadic_is_valid(&a->lo) || !dyd_dyadic_is_valid(&a->hi)) return false;
  if (mpz_sgn(a->den) <= 0 || !mpz_odd_p(a->den) || dyd_dyadic_cmp(&a->lo, &a->hi) > 0) return false;
  DYD_LOCAL_NUMBERS(mpz, g);
  mpz_gcd(g, a->lo.man, a->den);
  mpz_gcd(g, g, a->hi.man);
  return !mpz_cmp_ui(g, 1);
}

void dyd_interval_init(dyd_interval *a) {
  dyd_dyadic_init(&a->lo);
  dyd_dyadic_init(&a->hi);
  mpz_init_set_ui(a->den, 1);
}

void dyd_interval_clear(dyd_interval *a) {
  mpz_clear(a->den);
  dyd_dyadic_clear(&a->hi);
  dyd_dyadic_clear(&a->lo);
}

void dyd_interval_set(dyd_interval *out, const dyd_interval *a) {
  DYD_INVARIANT(dyd_interval_is_valid(a));
  dyd_dyadic_set(&out->lo, &a->lo);
  dyd_dyadic_set(&out->hi, &a->hi);
  mpz_set(out->den, a->den);
}

static void unset_end(dyd_dyadic *end, long man) {
  mpz_set_si(end->man, man);
  end->exp = DYD_EXP_LIMIT - 1;
}

/* Farther out than any other end, so that setting one end alone makes no interval either. */
void dyd_interval_unset(dyd_interval *out) {
  unset_end(&out->lo, 1);
  unset_end(&out->hi, -1);
}

bool dyd_interval_is_unset(const dyd_interval *a) {
  return a->lo.exp == DYD_EXP_LIMIT - 1 && a->hi.exp == DYD_EXP_LIMIT - 1 && !mpz_cmp_si(a->lo.man, 1) &&
         !mpz_cmp_si(a->hi.man, -1);
}

void dyd_rect_unset(dyd_rect *out) {
  dyd_interval_unset(&out->x);
  dyd_interval_unset(&out->y);
}

void dyd_interval_swap(dyd_interval *a, dyd_interval *b) {
  dyd_dyadic_swap(&a->lo, &b->lo);
  dyd_dyadic_swap(&a->hi, &b->hi);
  mpz_swap(a->den, b->den);
}

dyd_status dyd_interval_set_ends(dyd_interval *out, const dyd_dyadic *lo, const dyd_dyadic *hi) {
  if (dyd_dyadic_cmp(lo, hi) > 0) return DYD_E_ARG;
  DYD_LOCAL(dyd_interval, t);
  dyd_dyadic_set(&t.lo, lo);
  dyd_dyadic_set(&t.hi, hi);
  dyd_interval_swap(out, &t);
  return DYD_OK;
}

dyd_status dyd_interval_set_d(dyd_interval *out, double lo, double hi) {
  if (!(lo <= hi)) return DYD_E_ARG;
  DYD_LOCAL(dyd_interval, t);
  dyd_status st = dyd_dyadic_set_d(&t.lo, lo);
  if (st == DYD_OK) st = dyd_dyadic_set_d(&t.hi, hi);
  if (st == DYD_OK) dyd_interval_swap(out, &t);
  return st;
}

dyd_status dyd_interval_set_q(dyd_interval *out, const mpq_t q) {
  return dyd_interval_set_ends_q(out, q, q);
}

/* *out = den q, for a multiple den of the odd part of the denominator of q. */
static dyd_status end_set_q(dyd_dyadic *out, const mpq_t q, const mpz_t den) {
  mp_bitcnt_t twos = mpz_scan1(mpq_denref(q), 0);
  DYD_LOCAL_NUMBERS(mpz, man);
  mpz_tdiv_q_2exp(man, mpq_denref(q), twos);
  mpz_divexact(man, den, man);
  mpz_mul(man, man, mpq_numref(q));
  return dyd_dyadic_set_z_2exp(out, man, -(int64_t)twos);
}

dyd_status dyd_interval_set_ends_q(dyd_interval *out, const mpq_t lo, const mpq_t hi) {
  if (mpq_cmp(lo, hi) > 0) return DYD_E_ARG;
  DYD_LOCAL(dyd_interval, t);
  mpz_lcm(t.den, mpq_denref(lo), mpq_denref(hi));
  mpz_tdiv_q_2exp(t.den, t.den, mpz_scan1(t.den, 0));
  dyd_status st = dyd_bits(t.den) > DYD_EXP_LIMIT ? DYD_E_RANGE : end_set_q(&t.lo, lo, t.den);
  if (st == DYD_OK) st = end_set_q(&t.hi, hi, t.den);
  if (st == DYD_OK) dyd_interval_swap(out, &t);
  DYD_INVARIANT(st != DYD_OK || dyd_interval_is_valid(out));
  return st;
}

dyd_status dyd_interval_set_outward(dyd_interval *out, const mpq_t lo, const mpq_t hi, int64_t exp) {
  if (mpq_cmp(lo, hi) > 0) return DYD_E_ARG;
  DYD_LOCAL(dyd_interval, t);
  dyd_status st = dyd_dyadic_round_q(&t.lo, lo, exp, DYD_DOWN);
  if (st == DYD_OK) st = dyd_dyadic_round_q(&t.hi, hi, exp, DYD_UP);
  if (st == DYD_OK) dyd_interval_swap(out, &t);
  return st;
}

bool dyd_interval_is_point(const dyd_interval *a) {
  return dyd_dyadic_cmp(&a->lo, &a->hi) == 0;
}

/* Sign of the end x of a minus the end y of b. */
static int interval_cmp_ends(const dyd_dyadic *x, const dyd_interval *a, const dyd_dyadic *y, const dyd_interval *b) {
  return dyd_raw_cmp(x, b->den, y, a->den);
}

bool dyd_interval_contains(const dyd_interval *outer, const dyd_interval *inner) {
  return interval_cmp_ends(&outer->lo, outer, &inner->lo, inner) <= 0 &&
         interval_cmp_ends(&inner->hi, inner, &outer->hi, outer) <= 0;
}

bool dyd_interval_meets(const dyd_interval *a, const dyd_interval *b) {
  return interval_cmp_ends(&a->lo, a, &b->hi, b) <= 0 && interval_cmp_ends(&b->lo, b, &a->hi, a) <= 0;
}

static void interval_end_get_q(mpq_t out, const dyd_dyadic *end, const dyd_interval *a) {
  dyd_dyadic_get_q(out, end);
  mpz_mul(mpq_denref(out), mpq_denref(out), a->den);
  if (mpz_cmp_ui(a->den, 1)) mpq_canonicalize(out);
}

dyd_status dyd_interval_intersect(dyd_interval *out, const dyd_interval *a, const dyd_interval *b) {
  if (dyd_interval_contains(a, b)) return dyd_interval_set(out, b), DYD_OK; /* of measurements nearly always */
  if (!dyd_interval_meets(a, b)) return DYD_E_ARG;
  if (dyd_interval_contains(b, a)) return dyd_interval_set(out, a), DYD_OK;
  const bool a_is_lower = interval_cmp_ends(&a->lo, a, &b->lo, b) < 0;
  const dyd_interval *low = a_is_lower ? a : b, *high = a_is_lower ? b : a;
  if (!mpz_cmp_ui(a->den, 1) && !mpz_cmp_ui(b->den, 1)) return dyd_interval_set_ends(out, &high->lo, &low->hi);
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  interval_end_get_q(lo, &high->lo, high);
  interval_end_get_q(hi, &low->hi, low);
  return dyd_interval_set_ends_q(out, lo, hi);
}

void dyd_interval_set_over(dyd_interval *out, const dyd_dyadic *x, const mpz_t den) {
  DYD_LOCAL_NUMBERS(mpz, g);
  mpz_gcd(g, x->man, den);
  dyd_dyadic_set(&out->lo, x);
  mpz_divexact(out->den, den, g);
  mpz_divexact(out->lo.man, out->lo.man, g);
  dyd_dyadic_set(&out->hi, &out->lo);
}

dyd_status dyd_interval_halve(dyd_interval *a) {
  DYD_LOCAL(dyd_dyadic, x);
  dyd_status st = dyd_dyadic_add(&x, &a->lo, &a->hi);
  if (st == DYD_OK) st = dyd_dyadic_mul_2exp(&x, &x, -1);
  if (st == DYD_OK) dyd_interval_set_over(a, &x, a->den);
  return st;
}

dyd_status dyd_interval_round(dyd_interval *out, const dyd_interval *a) {
  if (!mpz_cmp_ui(a->den, 1)) return dyd_interval_set(out, a), DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_interval_get_q(lo, hi, a);
  return dyd_interval_is_point(a) ? dyd_interval_set_q(out, lo)
                                  : dyd_interval_set_outward(out, lo, hi, -dyd_interval_bits(a) - 66);
}

void dyd_interval_get_q(mpq_t lo, mpq_t hi, const dyd_interval *a) {
  interval_end_get_q(lo, &a->lo, a);
  interval_end_get_q(hi, &a->hi, a);
}

/* A width m 2^e / d, m and d of the sizes 2^(a-1) to 2^a and 2^(b-1) to 2^b, is above 2^(e+a-b-1) and below
 * 2^(e+a-b+1): it is at most 2^(e+a-b) if m <= d 2^(a-b). */
int64_t dyd_interval_bits(const dyd_interval *a) {
  int64_t exp, bits = INT64_MAX;
  DYD_LOCAL_NUMBERS(mpz, width);
  dyd_raw_add(width, &exp, &a->hi, &a->lo, -1);
  if (mpz_sgn(width)) {
    dyd_dyadic m = {.man = {width[0]}}, d = {.man = {a->den[0]}, .exp = dyd_bits(width) - dyd_bits(a->den)};
    bits = -(exp + d.exp + (dyd_dyadic_cmp(&m, &d) > 0));
  }
  return bits;
}

void dyd_interval_get_d(double *lo, double *hi, const dyd_interval *a) {
  *lo = dyd_raw_quotient_get_d(a->lo.man, a->lo.exp, a->den, DYD_DOWN);
  *hi = dyd_raw_quotient_get_d(a->hi.man, a->hi.exp, a->den, DYD_UP);
}

bool dyd_interval_get_exact_d(double *lo, double *hi, const dyd_interval *a) {
  if (mpz_cmp_ui(a->den, 1) || !dyd_dyadic_is_double(&a->lo) || !dyd_dyadic_is_double(&a->hi)) return false;
  dyd_interval_get_d(lo, hi, a);
  return true;
}

/* The least and the largest distance of points of two rectangles: exact squares, and roots rounded outward.
 *
 * Along an axis the points of [a0,a1] and [b0,b1] are at least max(b0 - a1, a0 - b1, 0) and at most max(b1 - a0, a1 -
 * b0) apart; both are reached for both axes at once, since a rectangle is a product. */

/* *out += d^2 for d = max(p - q, r - s, 0). */
static void add_apart2(mpq_ptr out, mpq_srcptr p, mpq_srcptr q, mpq_srcptr r, mpq_srcptr s) {
  DYD_LOCAL_ARRAY(mpq_t, d, [2]);
  mpq_sub(d[0], p, q);
  mpq_sub(d[1], r, s);
  mpq_ptr more = mpq_cmp(d[0], d[1]) > 0 ? d[0] : d[1];
  if (mpq_sgn(more) > 0) {
    mpq_mul(more, more, more);
    mpq_add(out, out, more);
  }
}

static double root_of(const mpq_t square, mpfr_rnd_t round) {
  DYD_LOCAL_FLOATS(128, root);
  mpfr_set_q(root, square, round);
  mpfr_sqrt(root, root, round);
  return mpfr_get_d(root, round);
}

void dyd_rect_distance(double *lo, double *hi, const dyd_rect *a, const dyd_rect *b) {
  DYD_LOCAL_NUMBERS(mpq, least, largest);
  DYD_LOCAL_ARRAY(mpq_t, e, [2][2]);
  for (int axis = 0; axis < 2; axis++) {
    dyd_interval_get_q(e[0][0], e[0][1], axis ? &a->y : &a->x);
    dyd_interval_get_q(e[1][0], e[1][1], axis ? &b->y : &b->x);
    add_apart2(least, e[1][0], e[0][1], e[0][0], e[1][1]);
    add_apart2(largest, e[1][1], e[0][0], e[0][1], e[1][0]);
  }
  *lo = root_of(least, MPFR_RNDD);
  *hi = root_of(largest, MPFR_RNDU);
}

void dyd_rect_init(dyd_rect *r) {
  dyd_interval_init(&r->x);
  dyd_interval_init(&r->y);
}

void dyd_rect_clear(dyd_rect *r) {
  dyd_interval_clear(&r->y);
  dyd_interval_clear(&r->x);
}

void dyd_rect_set(dyd_rect *out, const dyd_rect *r) {
  dyd_interval_set(&out->x, &r->x);
  dyd_interval_set(&out->y, &r->y);
}

void dyd_rect_swap(dyd_rect *a, dyd_rect *b) {
  dyd_interval_swap(&a->x, &b->x);
  dyd_interval_swap(&a->y, &b->y);
}

dyd_status dyd_rect_set_d(dyd_rect *out, double x0, double x1, double y0, double y1) {
  DYD_LOCAL(dyd_rect, t);
  dyd_status st = dyd_interval_set_d(&t.x, x0, x1);
  if (st == DYD_OK) st = dyd_interval_set_d(&t.y, y0, y1);
  if (st == DYD_OK) dyd_rect_swap(out, &t);
  return st;
}

dyd_status dyd_rect_set_q(dyd_rect *out, const mpq_t x, const mpq_t y) {
  DYD_LOCAL(dyd_rect, t);
  dyd_status st = dyd_interval_set_q(&t.x, x);
  if (st == DYD_OK) st = dyd_interval_set_q(&t.y, y);
  if (st == DYD_OK) dyd_rect_swap(out, &t);
  return st;
}

void dyd_rect_get_d(double out[4], const dyd_rect *r) {
  dyd_interval_get_d(&out[0], &out[1], &r->x);
  dyd_interval_get_d(&out[2], &out[3], &r->y);
}

bool dyd_rect_is_point(const dyd_rect *r) {
  return dyd_interval_is_point(&r->x) && dyd_interval_is_point(&r->y);
}

bool dyd_rect_contains(const dyd_rect *outer, const dyd_rect *inner) {
  return dyd_interval_contains(&outer->x, &inner->x) && dyd_interval_contains(&outer->y, &inner->y);
}

bool dyd_rect_meets(const dyd_rect *a, const dyd_rect *b) {
  return dyd_interval_meets(&a->x, &b->x) && dyd_interval_meets(&a->y, &b->y);
}

bool dyd_rect_holds(const dyd_rect *r, const dyd_point *p) {
  DYD_INVARIANT(mpz_cmp_ui(r->x.den, 1) == 0 && mpz_cmp_ui(r->y.den, 1) == 0);
  return dyd_dyadic_cmp(&r->x.lo, &p->x) <= 0 && dyd_dyadic_cmp(&p->x, &r->x.hi) <= 0 &&
         dyd_dyadic_cmp(&r->y.lo, &p->y) <= 0 && dyd_dyadic_cmp(&p->y, &r->y.hi) <= 0;
}

static bool interval_equal(const dyd_interval *a, const dyd_interval *b) {
  return !dyd_dyadic_cmp(&a->lo, &b->lo) && !dyd_dyadic_cmp(&a->hi, &b->hi) && !mpz_cmp(a->den, b->den);
}

bool dyd_rect_equal(const dyd_rect *a, const dyd_rect *b) {
  return interval_equal(&a->x, &b->x) && interval_equal(&a->y, &b->y);
}

int64_t dyd_rect_bits(const dyd_rect *r) {
  int64_t x = dyd_interval_bits(&r->x), y = dyd_interval_bits(&r->y);
  return x < y ? x : y;
}

void dyd_point_init(dyd_point *p) {
  dyd_dyadic_init(&p->x);
  dyd_dyadic_init(&p->y);
}

void dyd_point_clear(dyd_point *p) {
  dyd_dyadic_clear(&p->y);
  dyd_dyadic_clear(&p->x);
}

void dyd_point_set(dyd_point *out, const dyd_point *p) {
  dyd_dyadic_set(&out->x, &p->x);
  dyd_dyadic_set(&out->y, &p->y);
}

/* q = q / (man * 2^exp)^2, where q is an integer and man > 0. */
static void unscale_square(mpq_t q, mpz_srcptr man, int64_t exp) {
  mpz_mul(mpq_denref(q), man, man);
  if (exp > 0) mpz_mul_2exp(mpq_denref(q), mpq_denref(q), (mp_bitcnt_t)(2 * exp));
  if (exp < 0) mpz_mul_2exp(mpq_numref(q), mpq_numref(q), (mp_bitcnt_t)(-2 * exp));
  mpq_canonicalize(q);
}

typedef void distance_function(mpz_ptr, mpz_srcptr, mpz_srcptr, const dyd_irect *);

static void rect_distance2(mpq_t out, const dyd_point *c, const dyd_rect *r, distance_function *distance) {
  int64_t exp;
  DYD_LOCAL(dyd_irect, scaled);
  DYD_LOCAL_NUMBERS(mpz, cx, cy, man);
  dyd_irects_scale_with(cx, cy, &scaled, c, &r, 1, man, &exp);
  distance(mpq_numref(out), cx, cy, &scaled);
  unscale_square(out, man, exp);
}

void dyd_rect_ds2(mpq_t out, const dyd_point *c, const dyd_rect *r) {
  rect_distance2(out, c, r, dyd_irect_ds2);
}

void dyd_rect_dl2(mpq_t out, const dyd_point *c, const dyd_rect *r) {
  rect_distance2(out, c, r, dyd_irect_dl2);
}

void dyd_partial_edge_area2(mpq_t out, const dyd_rect *a, const dyd_rect *b) {
  const dyd_rect *in[2] = {a, b};
  int64_t exp;
  DYD_LOCAL_ARRAY(dyd_irect, scaled, [2]);
  DYD_LOCAL_NUMBERS(mpz, man);
  dyd_irects_scale(scaled, in, 2, man, &exp);
  dyd_irect_partial_edge_area2(mpq_numref(out), &scaled[0], &scaled[1]);
  unscale_square(out, man, exp);
}

bool dyd_partial_edges_disjoint(const dyd_rect *a, const dyd_rect *b, const dyd_rect *c, const dyd_rect *d) {
  const dyd_rect *in[4] = {a, b, c, d};
  DYD_LOCAL_ARRAY(dyd_irect, scaled, [4]);
  dyd_irects_scale(scaled, in, 4, NULL, NULL);
  return dyd_irect_partial_edges_disjoint(&scaled[0], &scaled[1], &scaled[2], &scaled[3]);
}
