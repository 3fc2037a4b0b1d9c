/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where f is largest: deaths, where the way up is clear, and births, where all corners are looked at [TOL-2] [TOL-3].
 */
#include "tolerance/lines.h"
#include "tolerance/roots.h"

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
  if (left < l->count && right < l->count) dyd_line_cross(at, l, left, right);
  if ((left < l->count) == (right < l->count)) return;
  mpz_set_si(at->p, left < l->count ? -1 : 1);
  mpz_set_ui(at->q, 0);
}

/* The supremum of the smaller of the two, or of the one there is. */
static dyd_binding climb_next(dyd_bisector_place *at, dyd_lines *l, const climb *c) {
  bool rising = c->rising < l->count, falling = c->falling < l->count;
  if (rising && falling && dyd_line_cross(at, l, c->rising, c->falling)) {
    if (dyd_line_trend(l, at, c->rising) >= 0 && dyd_line_trend(l, at, c->falling) <= 0) return DYD_BINDING_TWO;
    dyd_line_summit(at, l, dyd_line_trend(l, at, c->rising) < 0 ? c->rising : c->falling);
    return DYD_BINDING_ONE;
  }
  if (dyd_line_summit(at, l, rising ? c->rising : c->falling)) return DYD_BINDING_ONE;
  mpz_set_si(at->p, rising ? 1 : -1);
  mpz_set_ui(at->q, 0);
  return DYD_BINDING_END;
}

/* Where f is not positive, up is where E rises, since E is concave. */
static int trend_of_death(dyd_lines *l, const dyd_bisector_place *at, size_t k) {
  return dyd_line_height(l, at, k) > 0 ? dyd_line_trend(l, at, k) : -mpz_sgn(l->item[k].n);
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
    size_t low = dyd_line_lowest(l, &out->at);
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
    dyd_line_cross(spare, l, a, k);
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
  dyd_summit now;
  dyd_bisector_place spare;
  out->binding = DYD_BINDING_NONE;
  if (!l->count) return;
  dyd_summit_init(&now);
  mpz_inits(spare.p, spare.q, NULL);
  mpz_set_si(now.at.p, -1);
  size_t a = dyd_line_lowest(l, &now.at), b = a;
  set_value(&now, l, DYD_BINDING_END, a, a);
  keep_better(out, &now);
  for (; next_corner(&now.at, &spare, &b, l, a); a = b) {
    set_value(&now, l, DYD_BINDING_TWO, a, b);
    keep_better(out, &now);
  }
  mpz_set_si(now.at.p, 1);
  mpz_set_ui(now.at.q, 0);
  set_value(&now, l, DYD_BINDING_END, a, a);
  keep_better(out, &now);
  mpz_clears(spare.p, spare.q, NULL);
  dyd_summit_clear(&now);
}

void dyd_lines_birth_by(dyd_summit *out, dyd_lines *l) {
  bool two = l->count > 1;
  if (two)
    dyd_line_cross(&out->at, l, 0, 1);
  else
    mpz_set_si(out->at.p, mpz_sgn(l->item[0].n));
  if (!two) mpz_set_ui(out->at.q, 0);
  set_value(out, l, two ? DYD_BINDING_TWO : DYD_BINDING_END, 0, two ? 1 : 0);
}

/* ---- centres ---- */

/* (i + J/2 + s J') / factor along one axis, with s J' = p turn / (2 q). */
static void centre_axis(double *lo, double *hi, const dyd_summit *s, dyd_lines *l, mpz_srcptr origin, mpz_srcptr along,
                        mpz_srcptr turn, int sign) {
  mpq_t c;
  mpq_init(c);
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
  mpq_clear(c);
}

double dyd_summit_place(const dyd_summit *s) {
  if (!mpz_sgn(s->at.q)) return 0;
  mpq_t at;
  mpq_init(at);
  mpz_set(mpq_numref(at), s->at.p);
  mpz_mul_2exp(mpq_denref(at), s->at.q, 1);
  mpq_canonicalize(at);
  double out = mpq_get_d(at);
  mpq_clear(at);
  return out;
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
