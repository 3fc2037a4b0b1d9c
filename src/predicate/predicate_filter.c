/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Orientation and in-circle signs of boxes in interval arithmetic.
 *
 * Each determinant is evaluated on intervals that contain the coordinates of every choice, so the result contains
 * every value; for points the interval is a few units in the last place wide, for wide boxes the repeated coordinates
 * make it too wide. Orientation then falls back on the corners [ORI-1]: 16 choices for b and c, and the extreme corner
 * of a, each a determinant of points. */
#include "predicate/predicate_filter.h"

#include "base/float_filter.h"
#include "base/local.h"
#include "dyadic/raw.h"
#include "predicate/circle.h"
#include "predicate/pane.h"

#include <stdint.h>

/* The centre of a circle, enclosed in doubles.
 *
 * b sqrt(c) 2^g lies in [s, s+1] for s = floor(sqrt(b^2 c 4^g)), up to sign. With n = a 2^g + s (b > 0) or a 2^g - s -
 * 1 (b < 0) of at least 64 bits  * the enclosure [n, n+1] / (2^g d) is 2^-62 wide relative to its size, and rounding
 * outward adds one unit in the last place on each side. If n is shorter, g grows; a number that is not 0 has a long n
 * for some g. */

/* n <= (a + b sqrt c) 2^g <= n + 1 */
static void centre_enclose(mpz_ptr n, mpz_ptr t, mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, int64_t g) {
  mpz_mul(n, b, b);
  mpz_mul(n, n, c);
  mpz_mul_2exp(n, n, (mp_bitcnt_t)(2 * g));
  mpz_sqrt(n, n);
  if (mpz_sgn(b) < 0) {
    mpz_neg(n, n);
    mpz_sub_ui(n, n, 1);
  }
  mpz_mul_2exp(t, a, (mp_bitcnt_t)g);
  mpz_add(n, n, t);
}

/* [n, n + width] 2^-(g + shift) / d */
static void centre_quotient(double out[2], mpz_ptr n, unsigned long width, const dyd_icircle *k, int64_t exp) {
  out[0] = dyd_raw_quotient_get_d(n, exp, k->d, DYD_DOWN);
  mpz_add_ui(n, n, width);
  out[1] = dyd_raw_quotient_get_d(n, exp, k->d, DYD_UP);
}

static void centre_coordinate(double out[2], mpz_srcptr a, mpz_srcptr b, const dyd_icircle *k, int64_t shift) {
  DYD_LOCAL_NUMBERS(mpz, n, t);
  if (!mpz_sgn(b) || !mpz_sgn(k->c)) {
    mpz_set(n, a);
    centre_quotient(out, n, 0, k, -shift);
  } else if (!dyd_sqrt_sign(a, b, k->c)) {
    out[0] = out[1] = 0;
  } else {
    int64_t size = dyd_bits(b) + dyd_bits(k->c) / 2, g = size > 70 ? 0 : 70 - size;
    centre_enclose(n, t, a, b, k->c, g);
    while (dyd_bits(n) < 64) {
      g = 2 * g + 64;
      centre_enclose(n, t, a, b, k->c, g);
    }
    centre_quotient(out, n, 1, k, -g - shift);
  }
}

void dyd_icircle_centre_d(double out[4], const dyd_icircle *k, int64_t shift) {
  centre_coordinate(out, k->ax, k->bx, k, shift);
  centre_coordinate(out + 2, k->ay, k->by, k, shift);
}

/* Hulls of two boxes and distances to boxes, in interval arithmetic.
 *
 * Any direction that certainly separates the outer boxes, rounded or not, shows that the hulls are disjoint. Conversely
 * [HULL-1] names ten directions that suffice: for exact boxes, where none of them can separate, the hulls meet. The
 * sign of a difference of two doubles is the sign of the rounded difference, subnormals included, so the support
 * corner is the right one. */

/* Values of nx x + ny y on box a: enclosures of the least and the largest. */
static void box_support(dyd_iv *least, dyd_iv *largest, dyd_iv nx, dyd_iv ny, const dyd_box *a) {
  int x = nx.lo + nx.hi < 0, y = ny.lo + ny.hi < 0;
  *least = dyd_iv_add(dyd_iv_mul(nx, dyd_iv_point(a->outer[x])), dyd_iv_mul(ny, dyd_iv_point(a->outer[2 + y])));
  *largest = dyd_iv_add(dyd_iv_mul(nx, dyd_iv_point(a->outer[!x])), dyd_iv_mul(ny, dyd_iv_point(a->outer[3 - y])));
}

/* TRUE: certainly all of p is below all of q; FALSE: certainly not; from the supports. */
static dyd_truth supports_below(const dyd_iv largest[2], const dyd_iv least[2]) {
  bool all = true;
  for (int i = 0; i < 2; i++) {
    for (int j = 0; j < 2; j++) {
      if (largest[i].lo >= least[j].hi) return DYD_FALSE;
      all = all && largest[i].hi < least[j].lo;
    }
  }
  return all ? DYD_TRUE : DYD_UNKNOWN;
}

/* Decides if the direction separates.  box: p[0], p[1], q[0], q[1]. */
static dyd_truth direction_separates(dyd_iv nx, dyd_iv ny, const dyd_box *const box[4]) {
  dyd_iv least[4], largest[4];
  for (int k = 0; k < 4; k++) box_support(&least[k], &largest[k], nx, ny, box[k]);
  dyd_truth up = supports_below(largest, least + 2);
  if (up == DYD_TRUE) return DYD_TRUE;
  dyd_truth down = supports_below(largest + 2, least);
  if (down == DYD_TRUE) return DYD_TRUE;
  return up == DYD_FALSE && down == DYD_FALSE ? DYD_FALSE : DYD_UNKNOWN;
}

static double lesser_end(double a, double b) {
  return a < b ? a : b;
}

static double larger_end(double a, double b) {
  return a > b ? a : b;
}

static bool axis_separates(const dyd_box *const box[4], int lo, int hi) {
  double p0 = lesser_end(box[0]->outer[lo], box[1]->outer[lo]), p1 = larger_end(box[0]->outer[hi], box[1]->outer[hi]);
  double q0 = lesser_end(box[2]->outer[lo], box[3]->outer[lo]), q1 = larger_end(box[2]->outer[hi], box[3]->outer[hi]);
  return p1 < q0 || q1 < p0;
}

dyd_truth dyd_filter_partial_edges_disjoint(const dyd_box *a, const dyd_box *b, const dyd_box *c, const dyd_box *d) {
  const dyd_box *const box[4] = {a, b, c, d};
  if (axis_separates(box, 0, 1) || axis_separates(box, 2, 3)) return DYD_TRUE;
  bool meet = a->exact && b->exact && c->exact && d->exact;
  for (int join = 0; join < 8; join++) {
    const dyd_box *const *e = join < 4 ? box : box + 2;
    int x = join & 1, y = 2 + (join >> 1 & 1);
    dyd_iv dx = dyd_iv_point(e[1]->outer[x] - e[0]->outer[x]), dy = dyd_iv_point(e[0]->outer[y] - e[1]->outer[y]);
    if (dx.lo == 0 && dy.lo == 0) continue;
    if (meet) {
      dx = (dyd_iv){dx.lo == 0 ? 0 : dyd_down(dx.lo), dx.hi == 0 ? 0 : dyd_up(dx.hi)};
      dy = (dyd_iv){dy.lo == 0 ? 0 : dyd_down(dy.lo), dy.hi == 0 ? 0 : dyd_up(dy.hi)};
    }
    dyd_truth answer = direction_separates(dy, dx, box);
    if (answer == DYD_TRUE) return DYD_TRUE;
    if (answer == DYD_UNKNOWN) meet = false;
  }
  return meet ? DYD_FALSE : DYD_UNKNOWN;
}

/* Squared distance from c to [lo,hi] along one axis. t = max(lo - c, c - hi, 0), or max(c - lo, hi - c). */
static dyd_iv axis_distance2(dyd_iv c, dyd_iv lo, dyd_iv hi, dyd_touch touch) {
  bool far = touch == DYD_FARTHEST;
  dyd_iv s = far ? dyd_iv_sub(c, lo) : dyd_iv_sub(lo, c), t = far ? dyd_iv_sub(hi, c) : dyd_iv_sub(c, hi);
  if (isnan(s.lo + s.hi + t.lo + t.hi)) return DYD_IV_UNKNOWN;
  dyd_iv d = {larger_end(larger_end(s.lo, t.lo), 0), larger_end(larger_end(s.hi, t.hi), 0)};
  return dyd_iv_sqr(d);
}

dyd_iv dyd_filter_distance2(dyd_iv cx, dyd_iv cy, const dyd_box *r, dyd_touch touch) {
  return dyd_iv_add(axis_distance2(cx, r->end[0], r->end[1], touch), axis_distance2(cy, r->end[2], r->end[3], touch));
}

/* Throwing out panes without a critical circle, in interval arithmetic.
 *
 * The formulas are those of predicate/circle.c, evaluated on enclosures of the coordinates relative to a corner p on
 * the circle. Every step encloses the true value (predicate/interval_filter.h), so a pane is thrown out only when
 * every root is certainly outside one of its bounds or certainly not real: no further bound on the error is needed. */

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
typedef struct feature_iv {
  bool has[2];
  dyd_iv at[2];
} feature_iv;

static feature_iv relative_feature(const dyd_slab *x, const dyd_slab *y, int m, int base) {
  feature_iv f = {{x->mark[m].at != NULL, y->mark[m].at != NULL}, {DYD_IV_UNKNOWN, DYD_IV_UNKNOWN}};
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

static roots iv_two_points(const feature_iv *f, const feature_iv *g) {
  dyd_iv s = dyd_iv_add(dyd_iv_sqr(f->at[0]), dyd_iv_sqr(f->at[1]));
  dyd_iv t = dyd_iv_add(dyd_iv_sqr(g->at[0]), dyd_iv_sqr(g->at[1]));
  dyd_iv det = dyd_iv_sub(dyd_iv_mul(f->at[0], g->at[1]), dyd_iv_mul(g->at[0], f->at[1]));
  dyd_iv u = dyd_iv_sub(dyd_iv_mul(s, g->at[1]), dyd_iv_mul(t, f->at[1]));
  dyd_iv v = dyd_iv_sub(dyd_iv_mul(f->at[0], t), dyd_iv_mul(g->at[0], s));
  dyd_iv det2 = dyd_iv_scale(det, 2);
  return (roots){true, 1, {{dyd_iv_div(u, det2), dyd_iv_div(v, det2)}, {{0, 0}, {0, 0}}}};
}

static roots iv_point_and_line(const feature_iv *point, const feature_iv *line) {
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

static roots iv_parallel_lines(const feature_iv *f, const feature_iv *g, int k) {
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

static roots iv_solve(const feature_iv *f, const feature_iv *g) {
  bool f_point = f->has[0] && f->has[1], g_point = g->has[0] && g->has[1];
  if (f_point && g_point) return iv_two_points(f, g);
  if (f_point) return iv_point_and_line(f, g);
  if (g_point) return iv_point_and_line(g, f);
  if (f->has[0] && g->has[0]) return iv_parallel_lines(f, g, 0);
  if (f->has[1] && g->has[1]) return iv_parallel_lines(f, g, 1);
  return f->has[0] ? iv_crossing_lines(f->at[0], g->at[1]) : iv_crossing_lines(g->at[0], f->at[1]);
}

/* Returns true if p + t is certainly below or above the slab. */
static bool outside_slab(dyd_iv t, dyd_iv p, const dyd_slab *s) {
  dyd_iv at = dyd_iv_add(t, p);
  return (s->lo2 && at.hi < s->lo.lo) || (s->hi2 && at.lo > s->hi.hi);
}

bool dyd_filter_pane_empty(const dyd_slab *x, const dyd_slab *y, int base) {
  feature_iv f = relative_feature(x, y, (base + 1) % 3, base), g = relative_feature(x, y, (base + 2) % 3, base);
  roots found = iv_solve(&f, &g);
  if (!found.known) return false;
  for (int i = 0; i < found.count; i++) {
    if (!outside_slab(found.at[i][0], x->mark[base].near, x) && !outside_slab(found.at[i][1], y->mark[base].near, y))
      return false;
  }
  return true;
}

static dyd_iv end_enclosure(const dyd_dyadic *end, mpz_srcptr den) {
  double lo = dyd_raw_quotient_get_d(end->man, end->exp, den, DYD_DOWN);
  if (!mpz_cmp_ui(den, 1) && dyd_dyadic_is_double(end)) return dyd_iv_point(lo);
  return (dyd_iv){lo, dyd_raw_quotient_get_d(end->man, end->exp, den, DYD_UP)};
}

void dyd_filter_box(dyd_box *out, const dyd_rect *r) {
  out->end[0] = end_enclosure(&r->x.lo, r->x.den);
  out->end[1] = end_enclosure(&r->x.hi, r->x.den);
  out->end[2] = end_enclosure(&r->y.lo, r->y.den);
  out->end[3] = end_enclosure(&r->y.hi, r->y.den);
  out->exact = true;
  for (int k = 0; k < 4; k++) {
    out->outer[k] = k & 1 ? out->end[k].hi : out->end[k].lo;
    if (out->end[k].lo != out->end[k].hi) out->exact = false;
  }
}

void dyd_filter_point(dyd_iv out[2], const dyd_point *c) {
  for (int axis = 0; axis < 2; axis++) {
    const dyd_dyadic *d = axis ? &c->y : &c->x;
    out[axis] = (dyd_iv){dyd_dyadic_get_d(d, DYD_DOWN), dyd_dyadic_get_d(d, DYD_UP)};
  }
}

static dyd_iv side_x(const double a[4]) {
  return (dyd_iv){a[0], a[1]};
}

static dyd_iv side_y(const double a[4]) {
  return (dyd_iv){a[2], a[3]};
}

/* p q - r s */
static dyd_iv iv_det2(dyd_iv p, dyd_iv q, dyd_iv r, dyd_iv s) {
  return dyd_iv_sub(dyd_iv_mul(p, q), dyd_iv_mul(r, s));
}

static int sign_of_boxes(const double a[4], const double b[4], const double c[4]) {
  dyd_iv ux = dyd_iv_sub(side_x(b), side_x(a)), uy = dyd_iv_sub(side_y(b), side_y(a));
  dyd_iv vx = dyd_iv_sub(side_x(c), side_x(a)), vy = dyd_iv_sub(side_y(c), side_y(a));
  return dyd_iv_sign(iv_det2(ux, vy, uy, vx));
}

static int sign_of_points(double px, double py, double qx, double qy, double rx, double ry) {
  const double p[4] = {px, px, py, py}, q[4] = {qx, qx, qy, qy}, r[4] = {rx, rx, ry, ry};
  return sign_of_boxes(p, q, r);
}

dyd_turns dyd_filter_turns(const double a[4], const double b[4], const double c[4]) {
  int sign = sign_of_boxes(a, b, c);
  if (sign) return (dyd_turns){sign > 0, sign<0, sign> 0, sign < 0};
  dyd_turns t = {true, true, false, false};
  for (int k = 0; k < 16; k++) {
    double qx = b[k & 1], qy = b[2 + (k >> 1 & 1)], rx = c[k >> 2 & 1], ry = c[2 + (k >> 3 & 1)];
    int least_x = qy < ry, least_y = rx < qx; /* the corner of a that turns least to the left */
    int least = sign_of_points(a[least_x], a[2 + least_y], qx, qy, rx, ry);
    int most = sign_of_points(a[!least_x], a[3 - least_y], qx, qy, rx, ry);
    t.all_left = t.all_left && least > 0;
    t.all_right = t.all_right && most < 0;
    t.some_left = t.some_left || most > 0;
    t.some_right = t.some_right || least < 0;
    if (t.some_left && t.some_right) return (dyd_turns){false, false, true, true};
  }
  return t;
}

dyd_sure dyd_filter_orientation(const double a[4], const double b[4], const double c[4]) {
  dyd_turns t = dyd_filter_turns(a, b, c);
  return t.all_left ? DYD_SURE_PLUS : t.all_right ? DYD_SURE_MINUS : DYD_UNSURE;
}

dyd_sure dyd_filter_incircle(const double a[4], const double b[4], const double c[4], const double d[4]) {
  const double *const abc[3] = {a, b, c};
  dyd_iv x[3], y[3], sum = {0, 0};
  for (int k = 0; k < 3; k++) {
    x[k] = dyd_iv_sub(side_x(abc[k]), side_x(d));
    y[k] = dyd_iv_sub(side_y(abc[k]), side_y(d));
  }
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    dyd_iv norm = dyd_iv_add(dyd_iv_sqr(x[k]), dyd_iv_sqr(y[k]));
    sum = dyd_iv_add(sum, dyd_iv_mul(norm, iv_det2(x[i], y[j], x[j], y[i])));
  }
  int sign = dyd_iv_sign(sum);
  return sign > 0 ? DYD_SURE_PLUS : sign < 0 ? DYD_SURE_MINUS : DYD_UNSURE;
}

/* A point of box a: closest to t (far = false) or farthest from it. Any double between the ends is a choice, so t
 * need not be accurate. */
static double choose_end(double t, double lo, double hi, bool far) {
  return far ? dyd_farther_end(t, lo, hi) : dyd_nearest_in(t, lo, hi);
}

static void choose_box_point(double out[4], const double t[2], const double a[4], bool far) {
  out[0] = out[1] = choose_end(t[0], a[0], a[1], far);
  out[2] = out[3] = choose_end(t[1], a[2], a[3], far);
}

/* About the centre of the circle through the middles; false when that is not a number. */
static bool guess_centre(double out[2], const double a[4], const double b[4], const double c[4]) {
  double px = a[0] / 2 + a[1] / 2, py = a[2] / 2 + a[3] / 2;
  double qx = b[0] / 2 + b[1] / 2 - px, qy = b[2] / 2 + b[3] / 2 - py;
  double rx = c[0] / 2 + c[1] / 2 - px, ry = c[2] / 2 + c[3] / 2 - py;
  double det = 2 * (qx * ry - qy * rx), s = qx * qx + qy * qy, t = rx * rx + ry * ry;
  out[0] = px + (s * ry - t * qy) / det;
  out[1] = py + (qx * t - rx * s) / det;
  return isfinite(out[0]) && isfinite(out[1]);
}

/* d is moved towards the centre of a large circle and away from the centre of a small one. */
bool dyd_filter_incircle_mixed(const double a[4], const double b[4], const double c[4], const double d[4]) {
  double t[2], p[4][4];
  dyd_sure sign[2];
  if (!guess_centre(t, a, b, c)) return false;
  for (int far = 0; far < 2; far++) {
    choose_box_point(p[0], t, a, far);
    choose_box_point(p[1], t, b, far);
    choose_box_point(p[2], t, c, far);
    choose_box_point(p[3], t, d, !far);
    sign[far] = dyd_filter_incircle(p[0], p[1], p[2], p[3]);
  }
  return (int)sign[0] * (int)sign[1] < 0;
}
