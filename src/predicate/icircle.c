/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Circles with centre A + B sqrt(C) against integer rectangles.
 *
 * With coordinates relative to the corner p on the circle, radius^2 = u^2 + v^2 for the centre (u,v), so for a point q
 *     |o - q|^2 - radius^2 = |q|^2 - 2 u q_x - 2 v q_y
 * is linear in the centre, and for the line u = l: (u - l)^2 - radius^2 = l^2 - 2 l u - v^2. */
#include "predicate/icircle.h"

#include "base/invariant.h"
#include "predicate/surd.h"

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
typedef struct frame {
  mpz_t au, av, l, m, s, t;
} frame;

static void frame_init(frame *f, const dyd_icircle *k) {
  mpz_inits(f->au, f->av, f->l, f->m, f->s, f->t, NULL);
  mpz_set(f->au, k->ax);
  mpz_submul(f->au, k->px, k->d);
  mpz_set(f->av, k->ay);
  mpz_submul(f->av, k->py, k->d);
}

static void frame_clear(frame *f) {
  mpz_clears(f->au, f->av, f->l, f->m, f->s, f->t, NULL);
}

/* Sign of |o - q| - radius, q = (l,m) relative to p. */
static int side_of_point(frame *f, const dyd_icircle *k) {
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
static int side_of_line(frame *f, const dyd_icircle *k, mpz_srcptr au, mpz_srcptr bu, mpz_srcptr av, mpz_srcptr bv) {
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
  frame f;
  frame_init(&f, k);
  dyd_surd ox = {k->ax, k->bx, k->c, k->d}, oy = {k->ay, k->by, k->c, k->d};
  mpz_srcptr x = dyd_surd_end(f.s, f.t, &ox, r, 0, touch), y = dyd_surd_end(f.s, f.t, &oy, r, 1, touch);
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
  frame_clear(&f);
  return side;
}

int dyd_icircle_compare(const dyd_icircle *k, const dyd_icircle *l, int axis) {
  mpz_srcptr ak = axis ? k->ay : k->ax, bk = axis ? k->by : k->bx, al = axis ? l->ay : l->ax, bl = axis ? l->by : l->bx;
  mpz_t a, b, d;
  mpz_inits(a, b, d, NULL);
  mpz_mul(a, ak, l->d);
  mpz_submul(a, al, k->d);
  mpz_mul(b, bk, l->d);
  mpz_mul(d, bl, k->d);
  mpz_neg(d, d);
  int sign = dyd_sqrt2_sign(a, b, k->c, d, l->c);
  mpz_clears(a, b, d, NULL);
  return sign;
}
