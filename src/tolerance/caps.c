/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Caps of directions, exactly. */
#include "tolerance/discs.h"

#include "base/alloc.h"
#include "base/local.h"

#include <mpfr.h>
#include <string.h>

#define NEAR 0x1p-30

void dyd_disc_init(dyd_disc *d) {
  mpq_inits(d->x, d->y, d->r, NULL);
}

void dyd_disc_clear(dyd_disc *d) {
  mpq_clears(d->x, d->y, d->r, NULL);
}

void dyd_caps_init(dyd_caps *c) {
  memset(c, 0, sizeof *c);
  mpq_inits(c->qx, c->qy, c->rho, c->n, c->a, c->b, c->s, c->t, NULL);
}

void dyd_caps_clear(dyd_caps *c) {
  for (size_t k = 0; k < c->made; k++) {
    dyd_cap *p = &c->item[k];
    mpq_clears(p->wx, p->wy, p->tau, p->ww, p->c, NULL);
  }
  free(c->item);
  mpq_clears(c->qx, c->qy, c->rho, c->n, c->a, c->b, c->s, c->t, NULL);
}

/* ---- discs ---- */

static void squared_distance(mpq_ptr out, mpq_ptr spare, const dyd_disc *a, const dyd_disc *b) {
  mpq_sub(out, a->x, b->x);
  mpq_mul(out, out, out);
  mpq_sub(spare, a->y, b->y);
  mpq_mul(spare, spare, spare);
  mpq_add(out, out, spare);
}

/* Returns true if the centres are as near as the sum (sign = 1) or the difference of the radii. */
static bool centres_are_near(const dyd_disc *a, const dyd_disc *b, int sign) {
  DYD_LOCAL_NUMBERS(mpq, d, s);
  squared_distance(d, s, a, b);
  (sign < 0 ? mpq_sub : mpq_add)(s, a->r, b->r);
  mpq_mul(s, s, s);
  return mpq_cmp(d, s) <= 0;
}

bool dyd_discs_meet(const dyd_disc *a, const dyd_disc *b) {
  return centres_are_near(a, b, 1);
}

bool dyd_disc_is_within(const dyd_disc *small, const dyd_disc *large) {
  return centres_are_near(small, large, -1);
}

/* (x, y, r) / n, all positive multiples of k - i, r and |k - i|^2 - r^2 > 0: disc k inverted. n becomes about 1, so
 * that numbers keep their sizes; nothing is divided but by powers of 2, which takes no common factors. */
static void invert(mpq_ptr x, mpq_ptr y, mpq_ptr r, mpq_ptr n, dyd_caps *c, const dyd_disc *i, const dyd_disc *k) {
  squared_distance(n, c->t, k, i);
  mpq_mul(c->t, r, r);
  mpq_sub(n, n, c->t);
  mpq_sub(x, k->x, i->x);
  mpq_sub(y, k->y, i->y);
  size_t over = mpz_sizeinbase(mpq_numref(n), 2), under = mpz_sizeinbase(mpq_denref(n), 2);
  mpq_ptr all[4] = {x, y, r, n};
  for (int v = 0; v < 4; v++)
    if (over > under)
      mpq_div_2exp(all[v], all[v], over - under);
    else
      mpq_mul_2exp(all[v], all[v], under - over);
}

/* Products of the axes of two caps. */
static void cap_product(mpq_ptr out, mpq_ptr spare, const dyd_cap *e, const dyd_cap *k) {
  mpq_mul(out, e->wx, k->wx);
  mpq_mul(spare, e->wy, k->wy);
  mpq_add(out, out, spare);
}

static void cap_cross(mpq_ptr out, mpq_ptr spare, const dyd_cap *e, const dyd_cap *k) {
  mpq_mul(out, e->wx, k->wy);
  mpq_mul(spare, e->wy, k->wx);
  mpq_sub(out, out, spare);
}

/* ---- loading ---- */

static dyd_cap *next_cap(dyd_caps *c) {
  if (!DYD_GROW(c->item, c->cap, c->count + 1)) return NULL;
  dyd_cap *p = &c->item[c->count];
  if (c->count == c->made) {
    mpq_inits(p->wx, p->wy, p->tau, p->ww, p->c, NULL);
    c->made++;
  }
  c->count++;
  return p;
}

/* out = out n_j + sign at_j n_k, n_j and n_k those of discs j and k. */
static void against_j(mpq_ptr out, dyd_caps *c, mpq_srcptr at_j, mpq_srcptr n_k, int sign) {
  mpq_mul(out, out, c->n);
  mpq_mul(c->t, at_j, n_k);
  (sign < 0 ? mpq_sub : mpq_add)(out, out, c->t);
}

/* The bound: u.(-q_j) > rho_j is forbidden where possible is asked, u.q_j > rho_j wanted where legal is. */
static void set_bound(dyd_caps *c, dyd_cap *p) {
  mpq_sub(c->rho, p->disc->r, c->i->r);
  invert(c->qx, c->qy, c->rho, c->n, c, c->i, p->disc);
  mpq_set(p->wx, c->qx);
  mpq_set(p->wy, c->qy);
  mpq_set(p->tau, c->rho);
}

/* u.(q_k - q_j) > rho_k + rho_j, times n_k n_j. */
static void set_cap(dyd_caps *c, dyd_cap *p) {
  mpq_add(p->tau, p->disc->r, c->i->r);
  invert(p->wx, p->wy, p->tau, c->a, c, c->i, p->disc);
  against_j(p->wx, c, c->qx, c->a, -1);
  against_j(p->wy, c, c->qy, c->a, -1);
  against_j(p->tau, c, c->rho, c->a, 1);
}

/* Its rationals, and doubles as near to them as can be. */
static void need_exact(dyd_caps *c, dyd_cap *p) {
  bool bound = p == c->item;
  if (p->exact) return;
  if (!bound) need_exact(c, c->item);
  (bound ? set_bound : set_cap)(c, p);
  if (bound != c->legal) {
    mpq_neg(p->wx, p->wx);
    mpq_neg(p->wy, p->wy);
  }
  cap_product(p->ww, c->t, p, p);
  mpq_mul(c->t, p->tau, p->tau);
  mpq_sub(p->c, p->ww, c->t);
  p->exact = true;
  dyd_filter_cap_rounded(p);
}

bool dyd_caps_begin(dyd_caps *c, const dyd_disc *i, const dyd_disc *j, bool legal) {
  c->count = c->first = 0;
  c->i = i;
  c->legal = legal;
  return dyd_caps_add(c, j, UINT32_MAX);
}

bool dyd_caps_add(dyd_caps *c, const dyd_disc *k, uint32_t vertex) {
  dyd_cap *p = next_cap(c);
  if (!p) return false;
  p->vertex = vertex;
  p->disc = k;
  p->exact = false;
  dyd_filter_cap(p, c);
  return true;
}

/* ---- ends ---- */

/* Sign of a + b sqrt(q), q >= 0. */
static int sign_of_root(dyd_caps *c, mpq_srcptr a, mpq_srcptr b, mpq_srcptr q) {
  int x = mpq_sgn(a), y = mpq_sgn(q) ? mpq_sgn(b) : 0;
  if (x == y || !y) return x;
  if (!x) return y;
  mpq_mul(c->s, a, a);
  mpq_mul(c->t, b, b);
  mpq_mul(c->t, c->t, q);
  int larger = mpq_cmp(c->s, c->t);
  return larger > 0 ? x : larger < 0 ? y : 0;
}

/* The end of cap e on the side `turn` (1: counter-clockwise): u = (tau w + turn sqrt(c) w') / ww, w' the left turn of
 * w. The sign of u.w_k - tau_k. */
static int end_against(dyd_caps *c, dyd_cap *e, int turn, const dyd_direction *u, dyd_cap *k) {
  int sure = dyd_filter_cap_side(u, k);
  if (sure) return sure;
  need_exact(c, e);
  need_exact(c, k);
  cap_product(c->a, c->s, e, k);
  mpq_mul(c->a, c->a, e->tau);
  mpq_mul(c->b, k->tau, e->ww);
  mpq_sub(c->a, c->a, c->b);
  cap_cross(c->b, c->s, e, k);
  if (turn < 0) mpq_neg(c->b, c->b);
  return sign_of_root(c, c->a, c->b, e->c);
}

/* Where both ends are at one place: does cap k lie on the same side of it? Both do when k's own end there is that of
 * the same turn: the sign of the derivative (u').w_k, u' = the left turn of u. */
static bool same_side(dyd_caps *c, const dyd_cap *e, int turn, const dyd_cap *k) {
  /* ww u'.w_k = tau (w'.w_k) - turn sqrt(c) (w.w_k) */
  cap_cross(c->a, c->s, e, k);
  mpq_mul(c->a, c->a, e->tau);
  cap_product(c->b, c->s, e, k);
  if (turn > 0) mpq_neg(c->b, c->b);
  int rises = sign_of_root(c, c->a, c->b, e->c);
  return turn > 0 ? rises < 0 : rises > 0;
}

static bool is_empty(dyd_caps *c, dyd_cap *k) {
  int sure = dyd_filter_cap_size(k);
  if (!sure) need_exact(c, k);
  return sure ? sure < 0 : mpq_sgn(k->c) <= 0;
}

/* An end, as near as the next step needs it. */
static dyd_direction cap_end(dyd_caps *c, dyd_cap *e, int turn) {
  dyd_direction u = dyd_filter_cap_end(e, turn);
  if (u.off < NEAR) return u;
  need_exact(c, e);
  return dyd_filter_cap_end(e, turn);
}

/* ---- answers ---- */

/* Is the end u of cap e on the side `turn` in no other? */
static bool is_uncovered(dyd_caps *c, size_t e, int turn, const dyd_direction *u) {
  for (size_t k = 0; k < c->count; k++) {
    dyd_cap *p = &c->item[k];
    if (k != e && !is_empty(c, p) && end_against(c, &c->item[e], turn, u, p) > 0) return false;
  }
  return true;
}

bool dyd_caps_uncovered(dyd_direction *u, dyd_caps *c) {
  bool any = false;
  for (size_t e = c->first; e < c->count; e++) {
    if (is_empty(c, &c->item[e])) continue;
    any = true;
    for (int turn = -1; turn <= 1; turn += 2) {
      *u = cap_end(c, &c->item[e], turn);
      if (!is_uncovered(c, e, turn, u)) continue;
      c->by[0] = c->by[1] = c->first = e;
      return true;
    }
  }
  if (!any) *u = (dyd_direction){1, 0, 0};
  return !any;
}

/* The common part begins at the end of one of them. */
static bool begins_common(dyd_caps *c, size_t e, int turn, const dyd_direction *u) {
  for (size_t k = 0; k < c->count; k++) {
    int inside = k == e ? 1 : end_against(c, &c->item[e], turn, u, &c->item[k]);
    if (inside < 0 || (inside == 0 && !same_side(c, &c->item[e], turn, &c->item[k]))) return false;
  }
  return true;
}

bool dyd_caps_common(dyd_direction *u, dyd_caps *c) {
  dyd_direction end[2];
  bool found[2] = {false, false};
  for (size_t e = 0; e < c->count; e++) {
    if (is_empty(c, &c->item[e])) return false;
    for (int turn = -1; turn <= 1; turn += 2) {
      bool *have = &found[turn > 0];
      if (*have) continue;
      end[turn > 0] = cap_end(c, &c->item[e], turn);
      *have = begins_common(c, e, turn, &end[turn > 0]);
      c->by[turn > 0] = e;
    }
  }
  if (!found[0] || !found[1]) return false;
  *u = dyd_filter_between(end);
  return true;
}

/* ---- circles ---- */

/* A circle is as near as asked for; statements about it are decided in rationals. */

/* Adds the end of cap e on the side `turn` to u. */
static void add_end(mpfr_t u[2], const dyd_cap *e, int turn) {
  DYD_LOCAL_FLOATS(mpfr_get_prec(u[0]), s, t, ww);
  mpfr_set_q(ww, e->ww, MPFR_RNDN);
  mpfr_set_q(s, e->c, MPFR_RNDN);
  mpfr_sqrt(s, s, MPFR_RNDN);
  if (turn < 0) mpfr_neg(s, s, MPFR_RNDN);
  for (int a = 0; a < 2; a++) { /* (tau w + s w') / ww */
    mpfr_set_q(t, e->tau, MPFR_RNDN);
    mpfr_mul_q(t, t, a ? e->wy : e->wx, MPFR_RNDN);
    mpfr_div(t, t, ww, MPFR_RNDN);
    mpfr_add(u[a], u[a], t, MPFR_RNDN);
    mpfr_mul_q(t, s, a ? e->wx : e->wy, MPFR_RNDN);
    mpfr_div(t, t, ww, MPFR_RNDN);
    (a ? mpfr_add : mpfr_sub)(u[a], u[a], t, MPFR_RNDN);
  }
}

/* u: about the direction found last: the middle between two ends; the middle of a cap where these are its own. */
static void circle_set_direction(mpfr_t u[2], const dyd_caps *c) {
  const dyd_cap *a = &c->item[c->by[0]], *b = &c->item[c->by[1]];
  DYD_LOCAL_FLOATS(mpfr_get_prec(u[0]), length);
  mpfr_set_zero(u[0], 1);
  mpfr_set_zero(u[1], 1);
  if (a == b) {
    mpfr_set_q(u[0], a->wx, MPFR_RNDN);
    mpfr_set_q(u[1], a->wy, MPFR_RNDN);
  } else {
    add_end(u, a, -1);
    add_end(u, b, 1);
  }
  mpfr_hypot(length, u[0], u[1], MPFR_RNDN);
  for (int k = 0; k < 2; k++) mpfr_div(u[k], u[k], length, MPFR_RNDN);
}

/* d = 1 / (2 h), h = u.q_j - rho_j. false: h is not above 0. */
static bool set_distance(mpfr_t d, mpfr_t u[2], const dyd_caps *c) {
  DYD_LOCAL_FLOATS(mpfr_get_prec(d), t);
  mpfr_mul_q(d, u[0], c->qx, MPFR_RNDN);
  mpfr_mul_q(t, u[1], c->qy, MPFR_RNDN);
  mpfr_add(d, d, t, MPFR_RNDN);
  mpfr_sub_q(d, d, c->rho, MPFR_RNDN);
  mpfr_set_q(t, c->n, MPFR_RNDN);
  bool above = mpfr_sgn(d) > 0;
  mpfr_div(d, t, d, MPFR_RNDN);
  mpfr_div_2ui(d, d, 1, MPFR_RNDN);
  return above && mpfr_number_p(d);
}

/* r becomes at least |c - k| + k.r, if it is less. */
static void reach_to(dyd_disc *c, const dyd_disc *k, mpfr_prec_t bits) {
  DYD_LOCAL_NUMBERS(mpq, x, y);
  DYD_LOCAL_FLOATS(bits, d);
  squared_distance(x, y, c, k);
  mpfr_set_q(d, x, MPFR_RNDU);
  mpfr_sqrt(d, d, MPFR_RNDU);
  mpfr_get_q(x, d);
  mpq_add(x, x, k->r);
  if (mpq_cmp(x, c->r) > 0) mpq_set(c->r, x);
}

bool dyd_caps_circle(dyd_disc *out, dyd_caps *c, unsigned bits) {
  const dyd_disc *i = c->i, *j = c->item->disc;
  for (int k = 0; k < 2; k++) need_exact(c, &c->item[c->by[k]]);
  need_exact(c, c->item);
  mpfr_t u[2], d;
  mpfr_inits2((mpfr_prec_t)bits, u[0], u[1], d, (mpfr_ptr)0);
  circle_set_direction(u, c);
  bool above = set_distance(d, u, c);
  mpq_ptr at[2] = {out->x, out->y};
  for (int k = 0; k < 2 && above; k++) {
    mpfr_mul(u[k], u[k], d, MPFR_RNDN);
    above = mpfr_number_p(u[k]);
    if (above) mpfr_get_q(at[k], u[k]);
    mpq_add(at[k], at[k], k ? i->y : i->x);
  }
  mpq_set_ui(out->r, 0, 1);
  if (above) reach_to(out, i, (mpfr_prec_t)bits);
  if (above) reach_to(out, j, (mpfr_prec_t)bits);
  mpfr_clears(u[0], u[1], d, (mpfr_ptr)0);
  return above;
}
