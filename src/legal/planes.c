/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Half-planes from a centre and two rectangles, and the next centre. */
#include "legal/planes.h"

#include "base/flag.h"
#include "base/invariant.h"
#include "base/local.h"
#include "rect/irect.h"
#include "skeleton/circumcentre.h"

/* Dual simplex in three unknowns x, y, z with integers.
 *
 * Three half-planes whose normals hold 0 in their convex hull, 0 = sum of l_k n_k, l_k >= 0, give for every point
 * sum l_k (n_k.p + c_k) = sum l_k c_k, hence min (n_k.p + c_k)/w_k <= Z/D := sum l_k c_k / sum l_k w_k: an upper bound
 * of the optimum, attained at the point where all three are equal. Exchanging a violated half-plane for one of the
 * three, the least bound first, ends at the optimum of all [LP-1]. The l_k are the 2x2 minors of the normals, and the
 * point comes by Cramer's rule. */

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
  DYD_LOCAL(dyd_exact_centre, trial, next);
  DYD_LOCAL_ARRAY(mpz_t, scratch, [5]);
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
  return done;
}

/* How far out centres are looked for, in bits above the sites: each when there is no room nearer. Far out, doubles no
 * longer distinguish the distances of sites, and all sites are tested exactly. */
static const int64_t how_far[] = {3, 24, 64, 4160};

enum { REACHES = sizeof how_far / sizeof *how_far };

void dyd_planes_init(dyd_plane_list *l, const volatile int *cancel) {
  l->cancel = cancel;
  for (l->count = 0; l->count < 4; l->count++) dyd_half_plane_init(&l->h[l->count]);
  l->made = l->count;
  l->low = DYD_EXP_LIMIT;
  l->top = -DYD_EXP_LIMIT;
}

void dyd_planes_clear(dyd_plane_list *l) {
  for (size_t k = 0; k < l->made; k++) dyd_half_plane_clear(&l->h[k]);
}

static void planes_measure(dyd_plane_list *l, const dyd_rect *r) {
  const dyd_interval *side[2] = {&r->x, &r->y};
  for (int k = 0; k < 4; k++) {
    const dyd_interval *a = side[k / 2];
    const dyd_dyadic *end = k % 2 ? &a->hi : &a->lo;
    if (!mpz_sgn(end->man)) continue;
    int64_t low = end->exp + 1 - (int64_t)mpz_sizeinbase(a->den, 2);
    int64_t top = end->exp + (int64_t)mpz_sizeinbase(end->man, 2);
    if (low < l->low) l->low = low;
    if (top > l->top) l->top = top;
  }
}

/* On one axis: a = s - q, and q^2 - s^2 is added to sum; s the end of own farther from c, q the point of other nearest
 * to c. */
static void plane_axis(mpz_t a, mpz_t sum, mpz_t t, mpz_srcptr c, mpz_srcptr own0, mpz_srcptr own1, mpz_srcptr other0,
                       mpz_srcptr other1) {
  mpz_add(t, own0, own1);
  mpz_submul_ui(t, c, 2);
  mpz_srcptr s = mpz_sgn(t) > 0 ? own1 : own0;
  mpz_srcptr q = mpz_cmp(c, other0) < 0 ? other0 : mpz_cmp(c, other1) > 0 ? other1 : c;
  mpz_sub(a, s, q);
  mpz_add(t, s, q);
  mpz_submul(sum, a, t);
}

/* From a.x + c > 0 for x in units of 1 / (factor 2^exp) to user units, without common powers of two; w = |a| + |b|. */
static void plane_to_user(dyd_half_plane *h, const mpz_t factor, int64_t exp) {
  mpz_ptr part[3] = {h->a, h->b, h->c};
  mp_bitcnt_t zeros = ~(mp_bitcnt_t)0;
  for (int k = 0; k < 3; k++) {
    if (k < 2) mpz_mul(part[k], part[k], factor);
    int64_t up = k < 2 ? exp : -exp;
    if (up > 0) mpz_mul_2exp(part[k], part[k], (mp_bitcnt_t)up);
    mp_bitcnt_t z = mpz_scan1(part[k], 0); /* of 0: the largest number */
    if (z < zeros) zeros = z;
  }
  for (int k = 0; k < 3; k++) mpz_tdiv_q_2exp(part[k], part[k], zeros);
  mpz_abs(h->w, h->a);
  if (mpz_sgn(h->b) > 0)
    mpz_add(h->w, h->w, h->b);
  else
    mpz_sub(h->w, h->w, h->b);
}

/* The half-plane |q|^2 - |s|^2 + 2 (s - q).x > 0. Returns the sign of that at c; *differ: s != q. */
static int plane_set(bool *differ, dyd_half_plane *h, const dyd_point *c, const dyd_rect *own, const dyd_rect *other) {
  const dyd_rect *in[2] = {own, other};
  int64_t exp;
  DYD_LOCAL_NUMBERS(mpz, cx, cy, factor, t);
  DYD_LOCAL_ARRAY(dyd_irect, r, [2]);
  dyd_irects_scale_with(cx, cy, r, c, in, 2, factor, &exp);
  mpz_set_ui(h->c, 0);
  plane_axis(h->a, h->c, t, cx, r[0].x0, r[0].x1, r[1].x0, r[1].x1);
  plane_axis(h->b, h->c, t, cy, r[0].y0, r[0].y1, r[1].y0, r[1].y1);
  *differ = mpz_sgn(h->a) || mpz_sgn(h->b);
  mpz_mul(t, h->a, cx);
  mpz_addmul(t, h->b, cy);
  mpz_mul_2exp(t, t, 1);
  mpz_add(t, t, h->c);
  int sign = mpz_sgn(t);
  if (*differ) plane_to_user(h, factor, exp + 1);
  return sign;
}

bool dyd_planes_add(dyd_plane_list *l, const dyd_point *c, const dyd_rect *own, const dyd_rect *other) {
  bool differ;
  if (l->count == DYD_PLANES) return false;
  dyd_half_plane *h = &l->h[l->count];
  if (l->made == l->count) dyd_half_plane_init(&l->h[l->made++]);
  planes_measure(l, own);
  planes_measure(l, other);
  l->count += plane_set(&differ, h, c, own, other) <= 0 && differ;
  return differ;
}

/* The first four: the square |x|, |y| < 2^top. */
static void planes_square(dyd_plane_list *l, int64_t top) {
  for (int k = 0; k < 4; k++) {
    dyd_half_plane *h = &l->h[k];
    mpz_ptr n = k < 2 ? h->a : h->b, zero = k < 2 ? h->b : h->a;
    mpz_set_ui(zero, 0);
    mpz_set_ui(h->w, 1);
    mpz_set_ui(h->c, 1);
    mpz_mul_2exp(h->w, h->w, (mp_bitcnt_t)(top < 0 ? -top : 0));
    mpz_mul_2exp(h->c, h->c, (mp_bitcnt_t)(top > 0 ? top : 0));
    mpz_set(n, h->w);
    if (k & 1) mpz_neg(n, n);
  }
}

/* 2^e is less than a quarter of the radius z / d, and more than a 64th. */
static int64_t step_within(const dyd_exact_centre *p) {
  return (int64_t)mpz_sizeinbase(p->z, 2) - (int64_t)mpz_sizeinbase(p->d, 2) - 4;
}

/* The floor: exponent of a radius far below unit^2 / size, for ends that are multiples of unit = 2^low up to size =
 * 2^top. A disc of witnesses that small is not looked for; where there is none, but three rectangles touch one circle,
 * the discs of the half-planes would shrink for ever. */
static int64_t floor_exponent(const dyd_plane_list *l) {
  return 2 * l->low - l->top - 128;
}

dyd_status dyd_planes_centre(dyd_truth *room, dyd_point *c, dyd_plane_list *l) {
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_exact_centre, p);
  *room = DYD_FALSE;
  for (int k = 0; k < REACHES && *room == DYD_FALSE; k++) {
    planes_square(l, l->top + how_far[k]);
    if (!dyd_exact_lp(&p, l->h, l->count, l->cancel))
      *room = DYD_UNKNOWN;
    else if (mpz_sgn(p.z) > 0 && step_within(&p) >= floor_exponent(l))
      *room = DYD_TRUE;
  }
  if (dyd_flag_is_set(l->cancel)) st = DYD_CANCELLED;
  if (*room == DYD_TRUE && st == DYD_OK) st = dyd_centre_round(c, p.x, p.y, p.d, step_within(&p));
  if (st != DYD_E_RANGE) return st;
  *room = DYD_UNKNOWN; /* beyond the numbers there are */
  return DYD_OK;
}
