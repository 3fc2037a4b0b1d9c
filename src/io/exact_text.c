/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers (a + b sqrt(c)) / d as text.
 *
 * Enclosures: with n = floor(x 2^g), x lies in [n, n+1] 2^-g; g is chosen so that 2^-g is small against 1 / d. For a
 * root sqrt(x) lies in [floor(sqrt(n)), ceil(sqrt(n+1))] 2^-(g/2). */
#include "io/exact_text.h"

#include "dyadic/raw.h"
#include "io/decimal.h"
#include "voronoi/surd_point.h"

void dyd_exact_text(FILE *out, mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d) {
  mpz_t gcd, p, q, r;
  mpz_inits(gcd, p, q, r, NULL);
  bool root = mpz_sgn(b) && mpz_sgn(c);
  mpz_gcd(gcd, a, d);
  if (root) mpz_gcd(gcd, gcd, b);
  mpz_divexact(p, a, gcd);
  mpz_divexact(r, d, gcd);
  bool whole = !mpz_cmp_ui(r, 1);
  if (root) {
    mpz_divexact(q, b, gcd);
    if (!whole) fputc('(', out);
    if (mpz_sgn(p)) gmp_fprintf(out, "%Zd%s", p, mpz_sgn(q) > 0 ? "+" : "");
    if (!mpz_cmp_si(q, -1)) fputc('-', out);
    if (mpz_cmpabs_ui(q, 1)) gmp_fprintf(out, "%Zd*", q);
    gmp_fprintf(out, "sqrt(%Zd)%s", c, whole ? "" : ")");
  } else {
    gmp_fprintf(out, "%Zd", p);
  }
  if (!whole) gmp_fprintf(out, "/%Zd", r);
  mpz_clears(gcd, p, q, r, NULL);
}

/* Fine enough for 17 digits of 1 / d. */
static int64_t enclosure_bits(const dyd_surd_point *p) {
  return 64 + dyd_bits(p->d);
}

void dyd_exact_enclose(double box[4], const dyd_surd_point *p) {
  int64_t bits = enclosure_bits(p);
  mpz_t floor, ceiling;
  mpz_inits(floor, ceiling, NULL);
  for (int axis = 0; axis < 2; axis++) {
    dyd_surd_point_floor(floor, ceiling, p, axis, bits);
    box[2 * axis] = dyd_raw_get_d(floor, -bits, DYD_DOWN);
    box[2 * axis + 1] = dyd_raw_get_d(ceiling, -bits, DYD_UP);
  }
  mpz_clears(floor, ceiling, NULL);
}

void dyd_exact_enclose_root(double *lo, double *hi, const dyd_surd_point *p) {
  int64_t bits = enclosure_bits(p);
  mpz_t floor, ceiling, rest;
  mpz_inits(floor, ceiling, rest, NULL);
  dyd_surd_point_floor(floor, ceiling, p, 0, 2 * bits);
  mpz_sqrt(floor, floor);
  mpz_sqrtrem(ceiling, rest, ceiling);
  if (mpz_sgn(rest)) mpz_add_ui(ceiling, ceiling, 1);
  *lo = dyd_raw_get_d(floor, -bits, DYD_DOWN);
  *hi = dyd_raw_get_d(ceiling, -bits, DYD_UP);
  mpz_clears(floor, ceiling, rest, NULL);
}

void dyd_exact_decimals(FILE *out, double lo, double hi, const char *between) {
  dyd_decimal_put(out, lo, DYD_DOWN, "-inf");
  fputs(between, out);
  dyd_decimal_put(out, hi, DYD_UP, "inf");
}

void dyd_exact_middle(double out[2], const dyd_surd_point *p) {
  double box[4];
  dyd_exact_enclose(box, p);
  for (int axis = 0; axis < 2; axis++) out[axis] = box[2 * axis] / 2 + box[2 * axis + 1] / 2;
}

void dyd_exact_circle(dyd_surd_point *centre, dyd_surd_point *radius2, const dyd_circle *k) {
  mpz_set(centre->ax, k->ax);
  mpz_set(centre->bx, k->bx);
  mpz_set(centre->ay, k->ay);
  mpz_set(centre->by, k->by);
  mpz_set(centre->c, k->c);
  mpz_set(centre->d, k->d);
  mpz_set(radius2->ax, k->ar);
  mpz_set(radius2->bx, k->br);
  mpz_set_ui(radius2->ay, 0);
  mpz_set_ui(radius2->by, 0);
  mpz_set(radius2->c, k->c);
  mpz_set(radius2->d, k->dr);
  dyd_surd_point_tidy(centre);
  dyd_surd_point_tidy(radius2);
}
