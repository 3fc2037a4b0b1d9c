/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact places on one circle of the sphere [CERT-14].
 *
 * Four are iff the determinant of the differences of their vectors is 0. That is, times -16, a sum of 192 roots of
 * unity of order n, where all degrees are multiples of 360/n; its conjugates are at most 192, so it is 0, or at least
 * 192^-(phi(n) / 2) in absolute value: the determinant is 0 when it is below 2^-(4 phi(n) + 4). For large n there are
 * circles that show without digits: parallels, meridians, and two chords across the plane of one meridian. */
#include "checker/cocircular.h"

#include "base/local.h"
#include "checker/algebra.h"

DYD_ARRAYS(dyd_cert_enclosure)

enum { MOST_ORDER = 1 << 20, SPARE = 64 };

/* ---- without digits ---- */

/* Is q a multiple of `of`? */
static bool is_multiple(mpq_srcptr q, unsigned long of) {
  return mpz_cmp_ui(mpq_denref(q), 1) == 0 && mpz_divisible_ui_p(mpq_numref(q), of);
}

/* Are a and b on one parallel, c and d on another, with the same meridian, or the one opposite, half way? */
static bool chords_are_mirrored(const dyd_cert_region *a, const dyd_cert_region *b, const dyd_cert_region *c,
                                const dyd_cert_region *d) {
  if (!mpq_equal(a->mid[1], b->mid[1]) || !mpq_equal(c->mid[1], d->mid[1])) return false;
  DYD_LOCAL_NUMBERS(mpq, turn);
  mpq_add(turn, a->mid[0], b->mid[0]);
  mpq_sub(turn, turn, c->mid[0]);
  mpq_sub(turn, turn, d->mid[0]);
  return is_multiple(turn, 360);
}

static bool are_on_parallel(const dyd_cert_region *const at[4]) {
  bool all = true;
  for (int k = 1; k < 4; k++) all = all && mpq_equal(at[0]->mid[1], at[k]->mid[1]);
  return all;
}

static bool are_on_meridian(const dyd_cert_region *const at[4]) {
  bool all = true;
  DYD_LOCAL_NUMBERS(mpq, turn);
  for (int k = 1; k < 4; k++) {
    mpq_sub(turn, at[k]->mid[0], at[0]->mid[0]);
    all = all && is_multiple(turn, 180);
  }
  return all;
}

static bool circle_is_plain(const dyd_cert_region *const at[4]) {
  return are_on_parallel(at) || are_on_meridian(at) || chords_are_mirrored(at[0], at[1], at[2], at[3]) ||
         chords_are_mirrored(at[0], at[2], at[1], at[3]) || chords_are_mirrored(at[0], at[3], at[1], at[2]);
}

/* ---- by a bound ---- */

static long order_totient(unsigned long n) {
  unsigned long count = n;
  for (unsigned long q = 2; q * q <= n; q++) {
    if (n % q) continue;
    count -= count / q;
    while (n % q == 0) n /= q;
  }
  return (long)(n > 1 ? count - count / n : count);
}

/* phi(n) for the least n that all degrees are multiples of 360/n for; 0: n is too large. */
static long order_degree(const dyd_cert_region *const at[4]) {
  DYD_LOCAL_NUMBERS(mpq, turn);
  DYD_LOCAL_NUMBERS(mpz, n);
  mpz_set_ui(n, 1);
  for (int k = 0; k < 8; k++) {
    mpq_set(turn, at[k / 2]->mid[k % 2]);
    mpz_mul_ui(mpq_denref(turn), mpq_denref(turn), 360);
    mpq_canonicalize(turn);
    mpz_lcm(n, n, mpq_denref(turn));
  }
  return mpz_cmp_ui(n, MOST_ORDER) <= 0 ? order_totient(mpz_get_ui(n)) : 0;
}

/* The vector of a place. */
static void place_vector_set(dyd_cert_enclosure v[3], const dyd_cert_region *at, const dyd_cert_enclosure *pi, long p) {
  DYD_LOCAL(dyd_cert_trig, lon, lat);
  dyd_cert_trig_of_degrees(&lon, at->mid[0], pi, p);
  dyd_cert_trig_of_degrees(&lat, at->mid[1], pi, p);
  dyd_cert_enclosure_set(&v[0], &lon.c);
  dyd_cert_enclosure_set(&v[1], &lon.s);
  dyd_cert_enclosure_set(&v[2], &lat.s);
  for (int a = 0; a < 2; a++) dyd_cert_enclosure_mul(&v[a], &lat.c, p);
}

/* out = the determinant of v[1] - v[0], v[2] - v[0], v[3] - v[0], of which the latter are left in v. */
static void determinant(dyd_cert_enclosure *out, dyd_cert_enclosure v[4][3], long p) {
  DYD_LOCAL(dyd_cert_enclosure, t);
  dyd_cert_enclosure_set_si(out, 0, p);
  for (int k = 1; k < 4; k++)
    for (int a = 0; a < 3; a++) dyd_cert_enclosure_sub(&v[k][a], &v[0][a]);
  for (int k = 0; k < 6; k++) {
    int a = k % 3, b = (a + (k < 3 ? 1 : 2)) % 3, c = 3 - a - b;
    dyd_cert_enclosure_set(&t, &v[1][a]);
    dyd_cert_enclosure_mul(&t, &v[2][b], p);
    dyd_cert_enclosure_mul(&t, &v[3][c], p);
    (k < 3 ? dyd_cert_enclosure_add : dyd_cert_enclosure_sub)(out, &t);
  }
}

/* Is it known that |x| < 2^bits, both times 2^-p? */
static bool is_below(const dyd_cert_enclosure *x, long bits) {
  return x->known && mpz_sizeinbase(x->lo, 2) <= (size_t)bits && mpz_sizeinbase(x->hi, 2) <= (size_t)bits;
}

/* Is the determinant below 2^-bits in absolute value, to precision p > bits? */
static bool is_flat(const dyd_cert_region *const at[4], long bits, long p) {
  DYD_LOCAL(dyd_cert_enclosure, pi, det);
  dyd_cert_enclosure_pi(&pi, p);
  DYD_LOCAL_ARRAY(dyd_cert_enclosure, v, [4][3]);
  for (int k = 0; k < 4; k++) place_vector_set(v[k], at[k], &pi, p);
  determinant(&det, v, p);
  return is_below(&det, p - bits);
}

/* A look with few digits first: most that are on no circle are seen by it. */
bool dyd_cert_are_cocircular(const dyd_cert_region *const at[4]) {
  if (circle_is_plain(at)) return true;
  long degree = order_degree(at), bits = 4 * degree + 4;
  if (degree == 0 || bits + SPARE > DYD_CERT_PRECISION) return false;
  return is_flat(at, SPARE, 2 * SPARE) && is_flat(at, bits, bits + SPARE);
}
