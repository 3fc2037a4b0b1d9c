/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lines over a bisector in integers: their places, the direction of f on them, its largest value. */
#include "tolerance/lines.h"
#include "dyadic/raw.h"

#include "base/alloc.h"

#include <dyadel/dyadic.h>
#include <mpfr.h>
#include <stdlib.h>
#include <string.h>

/* ---- life ---- */

void dyd_lines_init(dyd_lines *l) {
  memset(l, 0, sizeof *l);
  mpz_inits(l->ix, l->iy, l->jx, l->jy, l->jj, l->u, l->v, l->x, l->y, NULL);
  mpq_init(l->factor);
}

void dyd_lines_clear(dyd_lines *l) {
  for (size_t k = 0; k < l->made; k++) {
    mpz_clears(l->item[k].m, l->item[k].n, l->item[k].along, NULL);
    dyd_rect_clear(&l->rect[k]);
    dyd_irect_clear(&l->grid[k]);
  }
  dyd_free_all(l->item, l->rect, l->grid);
  mpz_clears(l->ix, l->iy, l->jx, l->jy, l->jj, l->u, l->v, l->x, l->y, NULL);
  mpq_clear(l->factor);
}

static dyd_status lines_reserve(dyd_lines *l, size_t need) {
  size_t cap[3] = {l->made, l->made, l->made};
  if (!DYD_GROW(l->item, cap[0], need) || !DYD_GROW(l->rect, cap[1], need) || !DYD_GROW(l->grid, cap[2], need))
    return DYD_E_NOMEM;
  for (; l->made < need; l->made++) {
    dyd_line_over *o = &l->item[l->made];
    mpz_inits(o->m, o->n, o->along, NULL);
    dyd_rect_init(&l->rect[l->made]);
    dyd_irect_init(&l->grid[l->made]);
  }
  return DYD_OK;
}

/* ---- loading ---- */

static void line_set(dyd_line_over *o, dyd_lines *l, const dyd_irect *p) {
  mpz_sub(l->x, p->x0, l->ix);
  mpz_sub(l->y, p->y0, l->iy);
  mpz_mul(o->along, l->x, l->jx);
  mpz_addmul(o->along, l->y, l->jy);
  mpz_mul(o->m, l->x, l->x);
  mpz_addmul(o->m, l->y, l->y);
  mpz_sub(o->m, o->m, o->along);
  mpz_mul(o->n, l->y, l->jx);
  mpz_submul(o->n, l->x, l->jy);
}

static dyd_status lines_scale(dyd_lines *l, size_t count) {
  DYD_FREED const dyd_rect **in = dyd_alloc(count, sizeof *in);
  int64_t exp;
  if (!in) return DYD_E_NOMEM;
  for (size_t k = 0; k < count; k++) in[k] = &l->rect[k];
  dyd_irects_scale(l->grid, in, count, l->u, &exp);
  mpq_set_z(l->factor, l->u);
  if (exp >= 0)
    mpq_mul_2exp(l->factor, l->factor, (mp_bitcnt_t)exp);
  else
    mpq_div_2exp(l->factor, l->factor, (mp_bitcnt_t)-exp);
  return DYD_OK;
}

dyd_status dyd_lines_load(dyd_lines *l, const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t *k, size_t count,
                          bool distinct) {
  l->count = 0;
  dyd_status st = lines_reserve(l, count + 2);
  if (st == DYD_OK) st = dyd_sites_get(&l->rect[count], sk->reps.sites, sk->reps.site[i]);
  if (st == DYD_OK) st = dyd_sites_get(&l->rect[count + 1], sk->reps.sites, sk->reps.site[j]);
  for (size_t q = 0; q < count && st == DYD_OK; q++)
    st = dyd_sites_get(&l->rect[q], sk->reps.sites, sk->reps.site[k[q]]);
  if (st == DYD_OK) st = lines_scale(l, count + 2);
  if (st != DYD_OK) return st;
  mpz_set(l->ix, l->grid[count].x0);
  mpz_set(l->iy, l->grid[count].y0);
  mpz_sub(l->jx, l->grid[count + 1].x0, l->ix);
  mpz_sub(l->jy, l->grid[count + 1].y0, l->iy);
  mpz_mul(l->jj, l->jx, l->jx);
  mpz_addmul(l->jj, l->jy, l->jy);
  for (size_t q = 0; q < count; q++) {
    size_t before = distinct ? l->count : 0;
    while (before < l->count && l->item[before].vertex != k[q]) before++;
    if (before < l->count) continue;
    l->item[l->count].vertex = k[q];
    line_set(&l->item[l->count++], l, &l->grid[q]);
  }
  return DYD_OK;
}

/* ---- places ---- */

/* Which of two lines is lower at a place: the sign of D_a - D_b; at an end, of that near it. */
static int dyd_line_compare(dyd_lines *l, const dyd_bisector_place *at, size_t a, size_t b) {
  const dyd_line_over *x = &l->item[a], *y = &l->item[b];
  mpz_sub(l->u, x->m, y->m);
  mpz_mul(l->v, l->u, at->q);
  mpz_sub(l->x, x->n, y->n);
  mpz_submul(l->v, l->x, at->p);
  if (mpz_sgn(l->v) || mpz_sgn(at->q)) return mpz_sgn(l->v);
  return mpz_sgn(l->u);
}

/* The lowest line there, the first of several. There must be lines. */
static size_t line_lowest(dyd_lines *l, const dyd_bisector_place *at) {
  size_t best = 0;
  for (size_t k = 1; k < l->count; k++)
    if (dyd_line_compare(l, at, k, best) < 0) best = k;
  return best;
}

/* Sign of D_k there; at an end, near it. */
static int line_height(dyd_lines *l, const dyd_bisector_place *at, size_t k) {
  mpz_mul(l->v, l->item[k].m, at->q);
  mpz_submul(l->v, l->item[k].n, at->p);
  if (mpz_sgn(l->v) || mpz_sgn(at->q)) return mpz_sgn(l->v);
  return mpz_sgn(l->item[k].m);
}

/* Does g = sqrt(r^2 + D_k) - r rise or fall as s grows: 1, -1; 0 at its summit. */
/* g' = A / R - S / r up to a positive factor, A = p jj - 2 q n, S = p jj; where A and S have one sign, A^2 r^2 - S^2
 * R^2 is p^2 (n^2 - jj m) - p q n jj + q^2 n^2 up to another. At an end q = 0 means an infinitely small q > 0: when p^2
 * (...) is 0, the sign is that of -p n. */
static int line_trend(dyd_lines *l, const dyd_bisector_place *at, size_t k) {
  const dyd_line_over *o = &l->item[k];
  mpz_mul(l->u, at->p, l->jj);
  mpz_mul(l->v, at->q, o->n);
  mpz_mul_2exp(l->v, l->v, 1);
  mpz_sub(l->v, l->u, l->v);
  int a = mpz_sgn(l->v), s = mpz_sgn(l->u);
  if (a >= 0 && s <= 0) return a > 0 || s < 0;
  if (a <= 0 && s >= 0) return -1;
  mpz_mul(l->u, o->n, o->n);
  mpz_mul(l->v, at->q, at->q);
  mpz_mul(l->v, l->v, l->u);
  mpz_submul(l->u, l->jj, o->m);
  mpz_mul(l->x, at->p, at->p);
  mpz_addmul(l->v, l->x, l->u);
  mpz_mul(l->x, at->p, at->q);
  mpz_mul(l->y, o->n, l->jj);
  mpz_submul(l->v, l->x, l->y);
  int sign = mpz_sgn(l->v);
  if (!sign && !mpz_sgn(at->q)) sign = -mpz_sgn(at->p) * mpz_sgn(o->n);
  return a > 0 ? sign : -sign;
}

/* The summit of g, where the disc of k touches that of i or j; false: g has none. */
static bool line_summit(dyd_bisector_place *at, dyd_lines *l, size_t k) {
  const dyd_line_over *o = &l->item[k];
  mpz_neg(l->u, o->along);
  mpz_sub(l->v, o->along, l->jj);
  bool at_i = mpz_sgn(l->u) > 0, at_j = mpz_sgn(l->v) > 0;
  if (!at_i && !at_j) return false;
  mpz_neg(at->p, o->n);
  mpz_set(at->q, at_i ? l->u : l->v);
  return true;
}

/* Where lines a and b cross; false: they are parallel. */
static bool line_cross(dyd_bisector_place *at, const dyd_lines *l, size_t a, size_t b) {
  mpz_sub(at->p, l->item[b].m, l->item[a].m);
  mpz_sub(at->q, l->item[b].n, l->item[a].n);
  if (mpz_sgn(at->q) < 0) {
    mpz_neg(at->p, at->p);
    mpz_neg(at->q, at->q);
  }
  return mpz_sgn(at->q) != 0;
}

/* ---- differences of two square roots ---- */

enum { ROOT_BITS = 128 };

/* All over one denominator d: e + sqrt(f d^2) / d ... */
int dyd_roots_sign(mpq_srcptr e, mpq_srcptr f, mpq_srcptr g) {
  DYD_LOCAL_NUMBERS(mpz, d, a, c, h, one, minus);
  mpz_set_si(one, 1);
  mpz_set_si(minus, -1);
  mpz_lcm(d, mpq_denref(e), mpq_denref(f));
  mpz_lcm(d, d, mpq_denref(g));
  mpz_divexact(a, d, mpq_denref(e));
  mpz_mul(a, a, mpq_numref(e));
  mpz_divexact(c, d, mpq_denref(f));
  mpz_mul(c, c, mpq_numref(f));
  mpz_mul(c, c, d);
  mpz_divexact(h, d, mpq_denref(g));
  mpz_mul(h, h, mpq_numref(g));
  mpz_mul(h, h, d);
  return dyd_sqrt2_sign(a, one, c, minus, h);
}

/* sqrt(p) + sqrt(n) against sqrt(q) + sqrt(m): both are squared. */
int dyd_roots_compare(mpq_srcptr p, mpq_srcptr m, mpq_srcptr q, mpq_srcptr n) {
  DYD_LOCAL_NUMBERS(mpq, e, f, g);
  mpq_add(e, p, n);
  mpq_sub(e, e, q);
  mpq_sub(e, e, m);
  mpq_mul(f, p, n);
  mpq_mul(g, q, m);
  mpq_mul_2exp(f, f, 2);
  mpq_mul_2exp(g, g, 2);
  return dyd_roots_sign(e, f, g);
}

/* out = |p - m| / (sqrt(p) + sqrt(m)) / 2, every step rounded so that the whole is: no digits cancel. */
static double half_rounded(mpq_srcptr difference, mpq_srcptr p, mpq_srcptr m, mpfr_rnd_t way) {
  mpfr_rnd_t against = way == MPFR_RNDD ? MPFR_RNDU : MPFR_RNDD;
  DYD_LOCAL_FLOATS(ROOT_BITS, x, y);
  mpfr_set_q(x, p, against);
  mpfr_sqrt(x, x, against);
  mpfr_set_q(y, m, against);
  mpfr_sqrt(y, y, against);
  mpfr_add(y, x, y, against);
  mpfr_set_q(x, difference, way);
  mpfr_div(x, x, y, way);
  mpfr_div_2ui(x, x, 1, way);
  return mpfr_get_d(x, way);
}

void dyd_roots_half(double *lo, double *hi, mpq_srcptr p, mpq_srcptr m) {
  DYD_LOCAL_NUMBERS(mpq, difference);
  mpq_sub(difference, p, m);
  mpq_abs(difference, difference);
  bool zero = mpq_sgn(difference) == 0;
  *lo = zero ? 0 : half_rounded(difference, p, m, MPFR_RNDD);
  *hi = zero ? 0 : half_rounded(difference, p, m, MPFR_RNDU);
}

void dyd_side_sum(mpq_ptr sum, mpq_ptr width, const dyd_interval *side) {
  DYD_LOCAL_NUMBERS(mpq, lo);
  dyd_interval_get_q(lo, width, side);
  mpq_add(sum, lo, width);
  mpq_sub(width, width, lo);
}

dyd_status dyd_rect_widen(dyd_rect *r, mpq_srcptr half, int64_t exp) {
  dyd_status st = DYD_OK;
  DYD_LOCAL_ARRAY(mpq_t, end, [2]);
  for (int axis = 0; axis < 2 && st == DYD_OK; axis++) {
    dyd_interval *side = axis ? &r->y : &r->x;
    dyd_interval_get_q(end[0], end[1], side);
    mpq_sub(end[0], end[0], half);
    mpq_add(end[1], end[1], half);
    st = dyd_interval_set_outward(side, end[0], end[1], exp);
  }
  return st;
}

double dyd_q_double(mpq_srcptr q, int up) {
  DYD_LOCAL_FLOATS(53, x);
  mpfr_rnd_t way = up ? MPFR_RNDU : MPFR_RNDD;
  mpfr_set_q(x, q, way);
  return mpfr_get_d(x, way);
}

double dyd_q_brief(mpq_srcptr q) {
  mpfr_exp_t e;
  char digits[8];
  DYD_LOCAL_FLOATS(53, x);
  DYD_LOCAL_NUMBERS(mpq, unit, t);
  mpfr_set_q(x, q, MPFR_RNDD);
  if (mpfr_regular_p(x) && mpfr_get_exp(x) > -1000 && mpfr_get_exp(x) < 1000) {
    mpfr_get_str(digits, &e, 10, 2, x, MPFR_RNDD); /* 0.digits * 10^e */
    mpq_set_ui(unit, 1, 1);
    mpz_ui_pow_ui(mpq_numref(unit), 10, (unsigned long)labs(6 - (long)e));
    if (e < 6) mpq_inv(unit, unit);
    mpq_div(t, q, unit);
    mpz_fdiv_q(mpq_numref(t), mpq_numref(t), mpq_denref(t));
    mpz_set_ui(mpq_denref(t), 1);
    mpq_mul(t, t, unit);
    mpfr_set_q(x, t, MPFR_RNDN);
  }
  return mpfr_get_d(x, MPFR_RNDN);
}

/* Where f is largest: deaths, where the way up is clear, and births, where all corners are tried [TOL-2] [TOL-3]. */

void dyd_summit_init(dyd_summit *s) {
  s->binding = DYD_BINDING_NONE;
  s->a = s->b = 0;
  mpz_inits(s->at.p, s->at.q, NULL);
  mpq_inits(s->plus, s->minus, NULL);
}

void dyd_summit_clear(dyd_summit *s) {
  mpz_clears(s->at.p, s->at.q, NULL);
  mpq_clears(s->plus, s->minus, NULL);
}

/* ---- values ---- */

/* Divides a square in scaled coordinates by factor^2. */
static void unscale(mpq_ptr x, const dyd_lines *l) {
  mpq_div(x, x, l->factor);
  mpq_div(x, x, l->factor);
}

/* r^2 = jj (p^2 + q^2) / (4 q^2), R^2 = r^2 + (q m - p n) / q. */
static void value_at_crossing(dyd_summit *s, dyd_lines *l) {
  const dyd_line_over *o = &l->item[s->a];
  mpz_mul(l->u, s->at.p, s->at.p);
  mpz_mul(l->v, s->at.q, s->at.q);
  mpz_add(l->u, l->u, l->v);
  mpz_mul(mpq_numref(s->minus), l->u, l->jj);
  mpz_mul_2exp(mpq_denref(s->minus), l->v, 2);
  mpq_canonicalize(s->minus);
  mpz_mul(l->u, s->at.q, o->m);
  mpz_submul(l->u, s->at.p, o->n);
  mpz_set(mpq_numref(s->plus), l->u);
  mpz_set(mpq_denref(s->plus), s->at.q);
  mpq_canonicalize(s->plus);
  mpq_add(s->plus, s->plus, s->minus);
}

/* At its summit g is |P| or |P - J|, whichever is smaller; |P|^2 = m + along, |P - J|^2 = m - along + jj. */
static void value_at_touch(dyd_summit *s, dyd_lines *l) {
  const dyd_line_over *o = &l->item[s->a];
  if (mpz_sgn(o->along) < 0) {
    mpz_add(l->u, o->m, o->along);
  } else {
    mpz_sub(l->u, o->m, o->along);
    mpz_add(l->u, l->u, l->jj);
  }
  mpq_set_z(s->plus, l->u);
  mpq_set_ui(s->minus, 0, 1);
}

/* Towards an end g tends to -p n / |J|. */
static void value_at_end(dyd_summit *s, dyd_lines *l) {
  const dyd_line_over *o = &l->item[s->a];
  bool negative = mpz_sgn(s->at.p) * mpz_sgn(o->n) > 0;
  mpq_ptr value = negative ? s->minus : s->plus;
  mpq_set_ui(negative ? s->plus : s->minus, 0, 1);
  mpz_mul(mpq_numref(value), o->n, o->n);
  mpz_set(mpq_denref(value), l->jj);
  mpq_canonicalize(value);
}

static void set_value(dyd_summit *s, dyd_lines *l, dyd_binding binding, size_t a, size_t b) {
  s->binding = binding;
  s->a = a;
  s->b = b;
  if (binding == DYD_BINDING_TWO) value_at_crossing(s, l);
  if (binding == DYD_BINDING_ONE) value_at_touch(s, l);
  if (binding == DYD_BINDING_END) value_at_end(s, l);
  unscale(s->plus, l);
  unscale(s->minus, l);
}

/* ---- deaths ---- */

/* rising: a line that is lowest, and on which f rises, at some place left of the supremum; falling: the like on its
 * right. count: none yet. */
typedef struct climb {
  size_t rising, falling;
} climb;

/* Anywhere between: where two lines of different sides cross, or an end at which all lines that move fall. */
static void climb_begin(dyd_bisector_place *at, dyd_lines *l) {
  size_t left = l->count, right = l->count;
  for (size_t k = 0; k < l->count; k++) {
    if (mpz_sgn(l->item[k].n) > 0) left = k;
    if (mpz_sgn(l->item[k].n) < 0) right = k;
  }
  mpz_set_ui(at->p, 0);
  mpz_set_ui(at->q, 1);
  if (left < l->count && right < l->count) line_cross(at, l, left, right);
  if ((left < l->count) == (right < l->count)) return;
  mpz_set_si(at->p, left < l->count ? -1 : 1);
  mpz_set_ui(at->q, 0);
}

/* The supremum of the smaller of the two, or of the one there is. */
static dyd_binding climb_next(dyd_bisector_place *at, dyd_lines *l, const climb *c) {
  bool rising = c->rising < l->count, falling = c->falling < l->count;
  if (rising && falling && line_cross(at, l, c->rising, c->falling)) {
    if (line_trend(l, at, c->rising) >= 0 && line_trend(l, at, c->falling) <= 0) return DYD_BINDING_TWO;
    line_summit(at, l, line_trend(l, at, c->rising) < 0 ? c->rising : c->falling);
    return DYD_BINDING_ONE;
  }
  if (line_summit(at, l, rising ? c->rising : c->falling)) return DYD_BINDING_ONE;
  mpz_set_si(at->p, rising ? 1 : -1);
  mpz_set_ui(at->q, 0);
  return DYD_BINDING_END;
}

/* Where f is not positive, up is where E rises, since E is concave. */
static int trend_of_death(dyd_lines *l, const dyd_bisector_place *at, size_t k) {
  return line_height(l, at, k) > 0 ? line_trend(l, at, k) : -mpz_sgn(l->item[k].n);
}

static bool same_height(dyd_lines *l, const dyd_bisector_place *at, size_t a, size_t b) {
  return b < l->count && dyd_line_compare(l, at, a, b) == 0;
}

void dyd_lines_death(dyd_summit *out, dyd_lines *l) {
  climb c = {l->count, l->count};
  dyd_binding binding = DYD_BINDING_NONE;
  out->binding = DYD_BINDING_NONE;
  if (!l->count) return;
  climb_begin(&out->at, l);
  for (;;) {
    size_t low = line_lowest(l, &out->at);
    bool end = mpz_sgn(out->at.q) == 0;
    int up = trend_of_death(l, &out->at, low);
    if (binding == DYD_BINDING_TWO &&
        (same_height(l, &out->at, low, c.rising) || same_height(l, &out->at, low, c.falling))) {
      set_value(out, l, DYD_BINDING_TWO, c.rising, c.falling);
      return;
    }
    if (end ? up == mpz_sgn(out->at.p) : up == 0) {
      set_value(out, l, end ? DYD_BINDING_END : DYD_BINDING_ONE, low, low);
      return;
    }
    *(up > 0 ? &c.rising : &c.falling) = low;
    binding = climb_next(&out->at, l, &c);
  }
}

/* ---- births ---- */

/* The line that is lowest just right of `at`, where line a is: the next corner, the line beyond it in *b. false: none.
 */
static bool next_corner(dyd_bisector_place *at, dyd_bisector_place *spare, size_t *b, dyd_lines *l, size_t a) {
  bool found = false;
  for (size_t k = 0; k < l->count; k++) {
    if (mpz_cmp(l->item[k].n, l->item[a].n) <= 0) continue;
    line_cross(spare, l, a, k);
    mpz_mul(l->u, spare->p, at->q);
    mpz_submul(l->u, at->p, spare->q);
    int before = found ? mpz_sgn(l->u) : -1;
    if (before > 0 || (before == 0 && mpz_cmp(l->item[k].n, l->item[*b].n) <= 0)) continue;
    mpz_swap(at->p, spare->p);
    mpz_swap(at->q, spare->q);
    *b = k;
    found = true;
  }
  return found;
}

static void keep_better(dyd_summit *best, dyd_summit *now) {
  if (best->binding != DYD_BINDING_NONE && dyd_roots_compare(now->plus, now->minus, best->plus, best->minus) <= 0)
    return;
  dyd_summit t = *best;
  *best = *now;
  *now = t;
}

void dyd_lines_birth(dyd_summit *out, dyd_lines *l) {
  out->binding = DYD_BINDING_NONE;
  if (!l->count) return;
  DYD_LOCAL(dyd_summit, now, spare);
  mpz_set_si(now.at.p, -1);
  size_t a = line_lowest(l, &now.at), b = a;
  set_value(&now, l, DYD_BINDING_END, a, a);
  keep_better(out, &now);
  for (; next_corner(&now.at, &spare.at, &b, l, a); a = b) {
    set_value(&now, l, DYD_BINDING_TWO, a, b);
    keep_better(out, &now);
  }
  mpz_set_si(now.at.p, 1);
  mpz_set_ui(now.at.q, 0);
  set_value(&now, l, DYD_BINDING_END, a, a);
  keep_better(out, &now);
}

void dyd_lines_birth_by(dyd_summit *out, dyd_lines *l) {
  bool two = l->count > 1;
  if (two)
    line_cross(&out->at, l, 0, 1);
  else
    mpz_set_si(out->at.p, mpz_sgn(l->item[0].n));
  if (!two) mpz_set_ui(out->at.q, 0);
  set_value(out, l, two ? DYD_BINDING_TWO : DYD_BINDING_END, 0, two ? 1 : 0);
}

/* ---- centres ---- */

/* (i + J/2 + s J') / factor along one axis, with s J' = p turn / (2 q). */
static void centre_axis(double *lo, double *hi, const dyd_summit *s, dyd_lines *l, mpz_srcptr origin, mpz_srcptr along,
                        mpz_srcptr turn, int sign) {
  DYD_LOCAL_NUMBERS(mpq, c);
  mpz_mul(l->u, s->at.p, turn);
  if (sign < 0) mpz_neg(l->u, l->u);
  mpz_mul_2exp(l->v, origin, 1);
  mpz_add(l->v, l->v, along);
  mpz_addmul(l->u, l->v, s->at.q);
  mpz_set(mpq_numref(c), l->u);
  mpz_mul_2exp(mpq_denref(c), s->at.q, 1);
  mpq_canonicalize(c);
  mpq_div(c, c, l->factor);
  *lo = dyd_q_double(c, 0);
  *hi = dyd_q_double(c, 1);
}

double dyd_summit_place(const dyd_summit *s) {
  if (!mpz_sgn(s->at.q)) return 0;
  DYD_LOCAL_NUMBERS(mpq, at);
  mpz_set(mpq_numref(at), s->at.p);
  mpz_mul_2exp(mpq_denref(at), s->at.q, 1);
  mpq_canonicalize(at);
  return mpq_get_d(at);
}

bool dyd_summit_disc(double box[4], double *radius2, const dyd_summit *s, dyd_lines *l) {
  if (!mpz_sgn(s->at.q)) return false;
  centre_axis(&box[0], &box[1], s, l, l->ix, l->jx, l->jy, -1);
  centre_axis(&box[2], &box[3], s, l, l->iy, l->jy, l->jx, 1);
  dyd_summit crossing = *s; /* R^2 at the place, also where it is a summit; the numbers are its own */
  mpq_inits(crossing.plus, crossing.minus, NULL);
  value_at_crossing(&crossing, l);
  unscale(crossing.plus, l);
  *radius2 = dyd_q_double(crossing.plus, 1);
  mpq_clears(crossing.plus, crossing.minus, NULL);
  return true;
}
