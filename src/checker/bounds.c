/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The bounds of a certificate, computed again.
 *
 * Twice the area of the hull of two rectangles is twice that of its bounding box less, at each corner of the box that
 * neither rectangle reaches, the product of the legs between their corners there. */
#include "checker/bounds.h"
#include "dyadic/raw.h"
#include <dyadel/dyadic.h>

void dyd_cert_bounds_init(dyd_cert_bounds *b) {
  *b = (dyd_cert_bounds){0};
  dyd_cert_fraction_init(&b->area2);
}

void dyd_cert_bounds_clear(dyd_cert_bounds *b) {
  dyd_cert_fraction_clear(&b->area2);
}

/* One end of one side: numerator; the denominator is the side's. */
static const dyd_exact *side_end(const dyd_cert_side *s, int upper) {
  return upper ? dyd_cert_high(s) : &s->lo;
}

/* out = end of b - end of a. */
static void side_gap(dyd_cert_fraction *out, const dyd_cert_side *a, int ua, const dyd_cert_side *b, int ub) {
  dyd_cert_fraction_sub(out, side_end(b, ub), dyd_cert_den(b), side_end(a, ua), dyd_cert_den(a));
}

/* out = the greatest distance along one axis between points of two sides. */
static void side_reach(dyd_cert_fraction *out, const dyd_cert_side *a, const dyd_cert_side *b) {
  dyd_cert_fraction t;
  dyd_cert_fraction_init(&t);
  side_gap(out, a, 0, b, 1);
  side_gap(&t, b, 0, a, 1);
  if (dyd_cert_fraction_cmp(&t, out) > 0) dyd_cert_fraction_swap(&t, out);
  dyd_cert_fraction_clear(&t);
}

/* out = the length of the hull of two sides. */
static void side_span(dyd_cert_fraction *out, const dyd_cert_side *a, const dyd_cert_side *b) {
  const dyd_cert_side *low = a, *high = a;
  dyd_cert_fraction t;
  dyd_cert_fraction_init(&t);
  side_gap(&t, a, 0, b, 0);
  if (dyd_exact_sgn(&t.num) < 0) low = b;
  side_gap(&t, a, 1, b, 1);
  if (dyd_exact_sgn(&t.num) > 0) high = b;
  side_gap(out, low, 0, high, 1);
  dyd_cert_fraction_clear(&t);
}

/* Takes the corner (ux, uy) off: *out is lessened by the product of the legs when one rectangle is farther out in x and
 * the other in y. */
static void bounds_cut_corner(dyd_cert_fraction *out, const dyd_cert_site *a, const dyd_cert_site *b, int ux, int uy) {
  dyd_cert_fraction x, y;
  dyd_cert_fraction_init(&x);
  dyd_cert_fraction_init(&y);
  side_gap(&x, &a->side[0], ux, &b->side[0], ux);
  side_gap(&y, &a->side[1], uy, &b->side[1], uy);
  int sx = dyd_exact_sgn(&x.num) * (ux ? 1 : -1), sy = dyd_exact_sgn(&y.num) * (uy ? 1 : -1);
  if (sx && sx == -sy) {
    dyd_cert_fraction_mul(&x, &x, &y);
    if (dyd_exact_sgn(&x.num) > 0) mpz_neg(x.num.man, x.num.man);
    dyd_cert_fraction_add(out, out, &x);
  }
  dyd_cert_fraction_clear(&x);
  dyd_cert_fraction_clear(&y);
}

/* A fraction becomes a dyadic, rounded up by at most 2^-200 of itself, so that sums stay short. */
static void fraction_make_whole(dyd_cert_fraction *f) {
  if (f->whole) return;
  int64_t exp = dyd_exact_top(&f->num);
  if (exp != INT64_MIN) {
    exp -= (int64_t)mpz_sizeinbase(f->den, 2) + 200;
    dyd_exact_ceil(f->num.man, &f->num, f->den, exp);
    f->num.exp = exp;
  }
  f->whole = true;
}

static void bounds_add_area(dyd_cert_bounds *b, const dyd_cert_site *i, const dyd_cert_site *j) {
  dyd_cert_fraction area, t;
  dyd_cert_fraction_init(&area);
  dyd_cert_fraction_init(&t);
  side_span(&area, &i->side[0], &j->side[0]);
  side_span(&t, &i->side[1], &j->side[1]);
  dyd_cert_fraction_mul(&area, &area, &t);
  area.num.exp++;
  for (int k = 0; k < 4; k++) bounds_cut_corner(&area, i, j, k & 1, k >> 1);
  fraction_make_whole(&area);
  dyd_cert_fraction_add(&b->area2, &b->area2, &area);
  dyd_cert_fraction_clear(&area);
  dyd_cert_fraction_clear(&t);
}

/* out = the sum of the squares of reach over both axes. */
static void site_reach2(dyd_cert_fraction *out, const dyd_cert_site *a, const dyd_cert_site *b) {
  dyd_cert_fraction t;
  dyd_cert_fraction_init(&t);
  side_reach(out, &a->side[0], &b->side[0]);
  dyd_cert_fraction_mul(out, out, out);
  side_reach(&t, &a->side[1], &b->side[1]);
  dyd_cert_fraction_mul(&t, &t, &t);
  dyd_cert_fraction_add(out, out, &t);
  dyd_cert_fraction_clear(&t);
}

/* The square of the greater diameter. */
static void site_diameter2(dyd_cert_fraction *out, const dyd_cert_site *a, const dyd_cert_site *b) {
  dyd_cert_fraction t;
  dyd_cert_fraction_init(&t);
  site_reach2(out, a, a);
  site_reach2(&t, b, b);
  if (dyd_cert_fraction_cmp(&t, out) > 0) dyd_cert_fraction_swap(&t, out);
  dyd_cert_fraction_clear(&t);
}

/* man = x 2^s exactly, s being great enough. */
static void set_scaled(mpz_ptr man, const dyd_exact *x, int64_t s) {
  mpz_mul_2exp(man, x->man, mpz_sgn(x->man) ? (mp_bitcnt_t)(x->exp + s) : 0);
}

static int64_t half_up(int64_t e) {
  return e >= 0 ? (e + 1) / 2 : e / 2;
}

static int64_t larger_exponent(int64_t a, int64_t b) {
  return a > b ? a : b;
}

/* Is sqrt(l) / 2 + sqrt(d) <= h? With Q the product of the denominators: is 2 h Q - sqrt(l Q^2) - 2 sqrt(d Q^2) >= 0?
 */
static bool half_and_diameter_fit(const dyd_cert_fraction *l, const dyd_cert_fraction *d, const dyd_exact *h) {
  dyd_exact x, y, z;
  mpz_t one[3];
  dyd_exact_init(&x);
  dyd_exact_init(&y);
  dyd_exact_init(&z);
  mpz_inits(one[0], one[1], one[2], NULL);
  dyd_exact_set(&x, &l->num);
  dyd_exact_set(&y, &d->num);
  dyd_exact_set(&z, h);
  z.exp++;
  for (int k = 0; k < 2; k++) { /* l Q^2 = num * den * dd^2, d Q^2 = num * den * dl^2 */
    const dyd_cert_fraction *f = k ? d : l;
    if (f->whole) continue;
    dyd_exact_mul_z(&z, &z, f->den);
    dyd_exact_mul_z(k ? &y : &x, k ? &y : &x, f->den);
    dyd_exact_mul_z(k ? &x : &y, k ? &x : &y, f->den);
    dyd_exact_mul_z(k ? &x : &y, k ? &x : &y, f->den);
  }
  int64_t s = larger_exponent(-z.exp, larger_exponent(half_up(-x.exp), half_up(-y.exp)));
  set_scaled(one[0], &z, s);
  set_scaled(one[1], &x, 2 * s);
  set_scaled(one[2], &y, 2 * s);
  mpz_t minus, twice;
  mpz_init_set_si(minus, -1);
  mpz_init_set_si(twice, -2);
  bool fits = dyd_sqrt2_sign(one[0], minus, one[1], twice, one[2]) >= 0;
  mpz_clears(minus, twice, one[0], one[1], one[2], NULL);
  dyd_exact_clear(&x);
  dyd_exact_clear(&y);
  dyd_exact_clear(&z);
  return fits;
}

static bool hausdorff_fits(const dyd_cert_bounds *b, const dyd_cert_site *i, const dyd_cert_site *j, bool legal) {
  dyd_cert_fraction d, l;
  dyd_cert_fraction_init(&d);
  dyd_cert_fraction_init(&l);
  site_diameter2(&d, i, j);
  bool fits;
  if (legal) {
    dyd_exact_mul(&l.num, b->hausdorff, b->hausdorff);
    fits = dyd_cert_fraction_cmp(&d, &l) <= 0;
  } else {
    site_reach2(&l, i, j);
    fits = half_and_diameter_fit(&l, &d, b->hausdorff);
  }
  dyd_cert_fraction_clear(&d);
  dyd_cert_fraction_clear(&l);
  return fits;
}

void dyd_cert_bounds_add(dyd_cert_bounds *b, const dyd_cert_sites *s, uint32_t i, uint32_t j, bool legal) {
  bounds_add_area(b, &s->site[i], &s->site[j]);
  if (b->hausdorff && !b->exceeded) b->exceeded = !hausdorff_fits(b, &s->site[i], &s->site[j], legal);
}

bool dyd_cert_bounds_area_holds(const dyd_cert_bounds *b, const dyd_exact *area) {
  dyd_exact twice;
  dyd_exact_init(&twice);
  dyd_exact_set(&twice, area);
  twice.exp++;
  bool holds = dyd_exact_cmp(&b->area2.num, &twice) <= 0;
  dyd_exact_clear(&twice);
  return holds;
}
