/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Circles of directions that caps have in common, as near as asked for. What is then said of a circle is decided in
 * rationals.
 */
#include "tolerance/caps.h"

#include <mpfr.h>

/* Adds the end of cap e on the side `turn` to u. */
static void add_end(mpfr_t u[2], const dyd_cap *e, int turn) {
  mpfr_t s, t, ww;
  mpfr_inits2(mpfr_get_prec(u[0]), s, t, ww, (mpfr_ptr)0);
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
  mpfr_clears(s, t, ww, (mpfr_ptr)0);
}

/* u: about the direction found last: the middle between two ends; the middle of a cap where these are its own. */
static void circle_set_direction(mpfr_t u[2], const dyd_caps *c) {
  const dyd_cap *a = &c->item[c->by[0]], *b = &c->item[c->by[1]];
  mpfr_t length;
  mpfr_init2(length, mpfr_get_prec(u[0]));
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
  mpfr_clear(length);
}

/* d = 1 / (2 h), h = u.q_j - rho_j. false: h is not above 0. */
static bool set_distance(mpfr_t d, mpfr_t u[2], const dyd_caps *c) {
  mpfr_t t;
  mpfr_init2(t, mpfr_get_prec(d));
  mpfr_mul_q(d, u[0], c->qx, MPFR_RNDN);
  mpfr_mul_q(t, u[1], c->qy, MPFR_RNDN);
  mpfr_add(d, d, t, MPFR_RNDN);
  mpfr_sub_q(d, d, c->rho, MPFR_RNDN);
  mpfr_set_q(t, c->n, MPFR_RNDN);
  bool above = mpfr_sgn(d) > 0;
  mpfr_div(d, t, d, MPFR_RNDN);
  mpfr_div_2ui(d, d, 1, MPFR_RNDN);
  mpfr_clear(t);
  return above && mpfr_number_p(d);
}

/* r becomes at least |c - k| + k.r, if it is less. */
static void reach_to(dyd_disc *c, const dyd_disc *k, mpfr_prec_t bits) {
  mpq_t x, y;
  mpfr_t d;
  mpq_inits(x, y, (mpq_ptr)0);
  mpfr_init2(d, bits);
  mpq_sub(x, c->x, k->x);
  mpq_sub(y, c->y, k->y);
  mpq_mul(x, x, x);
  mpq_mul(y, y, y);
  mpq_add(x, x, y);
  mpfr_set_q(d, x, MPFR_RNDU);
  mpfr_sqrt(d, d, MPFR_RNDU);
  mpfr_get_q(x, d);
  mpq_add(x, x, k->r);
  if (mpq_cmp(x, c->r) > 0) mpq_set(c->r, x);
  mpfr_clear(d);
  mpq_clears(x, y, (mpq_ptr)0);
}

bool dyd_caps_circle(dyd_disc *out, const dyd_caps *c, const dyd_disc *i, const dyd_disc *j, unsigned bits) {
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
