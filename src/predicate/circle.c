/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Critical circles in the coordinates of their rectangles.
 *
 * Scaling by F > 0 multiplies centres by F and squared radii by F^2. With F = m 2^e a circle found in scaled integers
 * is divided by F, and a circle is compared with a rectangle after both are multiplied by F. */
#include "predicate/circle.h"

#include "predicate/surd.h"

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
  mpz_t p, q, t;
  mpz_inits(p, q, t, NULL);
  dyd_surd_add_distance2(p, q, centre, r, touch);
  mpz_mul(p, p, k->dr);
  mpz_mul(q, q, k->dr);
  mpz_mul(t, k->d, k->d);
  mpz_submul(p, k->ar, t);
  mpz_submul(q, k->br, t);
  int sign = dyd_sqrt_sign(p, q, k->c);
  mpz_clears(p, q, t, NULL);
  return sign;
}

int dyd_circle_side(const dyd_circle *c, const dyd_rect *r, dyd_touch touch) {
  dyd_circle k;
  dyd_irect scaled;
  mpz_t man;
  int64_t exp;
  dyd_circle_init(&k);
  dyd_irect_init(&scaled);
  mpz_init(man);
  dyd_irects_scale(&scaled, &r, 1, man, &exp);
  dyd_circle_set(&k, c);
  circle_rescale(&k, &scaled, man, exp);
  int sign = circle_side_scaled(&k, &scaled, touch);
  mpz_clear(man);
  dyd_irect_clear(&scaled);
  dyd_circle_clear(&k);
  return sign;
}
