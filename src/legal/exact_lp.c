/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dual simplex in three unknowns x, y, z with integers.
 *
 * Three half-planes whose normals hold 0 in their convex hull, 0 = sum of l_k n_k, l_k >= 0, give for every point
 * sum l_k (n_k.p + c_k) = sum l_k c_k, hence min (n_k.p + c_k)/w_k <= Z/D := sum l_k c_k / sum l_k w_k: an upper bound
 * of the optimum, attained at the point where all three are equal. Exchanging a violated half-plane for one of the
 * three, the least bound first, ends at the optimum of all [LP-1]. The l_k are the 2x2 minors of the normals, and the
 * point comes by Cramer's rule. */
#include "legal/exact_lp.h"

#include "base/flag.h"
#include "base/invariant.h"

enum { PIVOTS = 400 };

void dyd_half_plane_init(dyd_half_plane *h) {
  mpz_inits(h->a, h->b, h->c, h->w, NULL);
}

void dyd_half_plane_clear(dyd_half_plane *h) {
  mpz_clears(h->a, h->b, h->c, h->w, NULL);
}

void dyd_exact_centre_init(dyd_exact_centre *p) {
  mpz_inits(p->x, p->y, p->z, p->d, NULL);
}

void dyd_exact_centre_clear(dyd_exact_centre *p) {
  mpz_clears(p->x, p->y, p->z, p->d, NULL);
}

static void swap_centres(dyd_exact_centre *p, dyd_exact_centre *q) {
  mpz_swap(p->x, q->x);
  mpz_swap(p->y, q->y);
  mpz_swap(p->z, q->z);
  mpz_swap(p->d, q->d);
}

/* out = p s - q r */
static void minor2(mpz_t out, const mpz_t p, const mpz_t q, const mpz_t r, const mpz_t s) {
  mpz_mul(out, p, s);
  mpz_submul(out, q, r);
}

/* out += or -= f * minor */
static void add_product(mpz_t out, const mpz_t f, const mpz_t g, int sign) {
  if (sign > 0)
    mpz_addmul(out, f, g);
  else
    mpz_submul(out, f, g);
}

/* The common value of three half-planes; false unless their normals hold 0 in their convex hull. l: scratch. */
static bool common_value(dyd_exact_centre *p, mpz_t l[3], mpz_t t, const dyd_half_plane *const h[3]) {
  int plus = 0, minus = 0;
  for (int k = 0; k < 3; k++) {
    const dyd_half_plane *u = h[(k + 1) % 3], *v = h[(k + 2) % 3];
    minor2(l[k], u->a, u->b, v->a, v->b);
    plus += mpz_sgn(l[k]) > 0;
    minus += mpz_sgn(l[k]) < 0;
  }
  if ((plus && minus) || (!plus && !minus)) return false;
  mpz_set_ui(p->x, 0);
  mpz_set_ui(p->y, 0);
  mpz_set_ui(p->z, 0);
  mpz_set_ui(p->d, 0);
  int sign = plus ? 1 : -1;
  for (int k = 0; k < 3; k++) {
    const dyd_half_plane *u = h[(k + 1) % 3], *v = h[(k + 2) % 3];
    add_product(p->d, h[k]->w, l[k], sign);
    add_product(p->z, h[k]->c, l[k], sign);
    minor2(t, u->b, u->w, v->b, v->w); /* x = -det[c b w] / D */
    add_product(p->x, h[k]->c, t, -sign);
    minor2(t, u->a, u->w, v->a, v->w); /* y = -det[a c w] / D = det[c a w] / D */
    add_product(p->y, h[k]->c, t, sign);
  }
  return true;
}

/* a x + b y + c d - w z, negative when the half-plane is violated. */
static int slack_sign(mpz_t t, const dyd_half_plane *h, const dyd_exact_centre *p) {
  mpz_mul(t, h->a, p->x);
  mpz_addmul(t, h->b, p->y);
  mpz_addmul(t, h->c, p->d);
  mpz_submul(t, h->w, p->z);
  return mpz_sgn(t);
}

/* Newest first: they were added since they are violated. Where numbers have a million bits each takes its time: any
 * one will do when work is stopped. */
static size_t violated(mpz_t t, const dyd_half_plane *h, size_t count, const dyd_exact_centre *p,
                       const volatile int *cancel) {
  for (size_t k = count; k-- > 0;)
    if (dyd_flag_is_set(cancel) || slack_sign(t, &h[k], p) < 0) return k;
  return count;
}

static bool is_less(mpz_t s, mpz_t t, const dyd_exact_centre *p, const dyd_exact_centre *q) {
  mpz_mul(s, p->z, q->d);
  mpz_mul(t, q->z, p->d);
  return mpz_cmp(s, t) < 0;
}

/* The best exchange for half-plane k; *best is its centre, basis is updated. There always is one: 0 stays in the convex
 * hull of any normal and two of the three, the one opposite to it being between these [LP-1]. */
static void exact_lp_exchange(const dyd_half_plane *basis[3], dyd_exact_centre *best, dyd_exact_centre *trial,
                              mpz_t scratch[5], const dyd_half_plane *k) {
  int leaves = -1;
  for (int out = 0; out < 3; out++) {
    const dyd_half_plane *const h[3] = {k, basis[(out + 1) % 3], basis[(out + 2) % 3]};
    if (!common_value(trial, scratch, scratch[3], h)) continue;
    if (leaves >= 0 && !is_less(scratch[3], scratch[4], trial, best)) continue;
    swap_centres(trial, best);
    leaves = out;
  }
  DYD_INVARIANT(leaves >= 0);
  basis[leaves] = k;
}

bool dyd_exact_lp(dyd_exact_centre *out, const dyd_half_plane *h, size_t count, const volatile int *cancel) {
  const dyd_half_plane *basis[3] = {&h[0], &h[1], &h[2]};
  dyd_exact_centre trial, next;
  mpz_t scratch[5];
  dyd_exact_centre_init(&trial);
  dyd_exact_centre_init(&next);
  for (int k = 0; k < 5; k++) mpz_init(scratch[k]);
  bool bounded = common_value(out, scratch, scratch[3], basis), done = false;
  DYD_INVARIANT(bounded);
  (void)bounded;
  for (int step = 0; step < PIVOTS; step++) {
    size_t k = violated(scratch[3], h, count, out, cancel);
    done = k == count;
    if (done || dyd_flag_is_set(cancel)) break;
    exact_lp_exchange(basis, &next, &trial, scratch, &h[k]);
    swap_centres(out, &next);
  }
  for (int k = 0; k < 5; k++) mpz_clear(scratch[k]);
  dyd_exact_centre_clear(&next);
  dyd_exact_centre_clear(&trial);
  return done;
}
