/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plain decimals of at most 18 digits: the form nearly all coordinates have, read without big numbers.
 *
 * man * 10^-k with k > 0 is a dyadic iff 5^k divides man; it is then (man / 5^k) * 2^-k.
 * For |man| < 2^53 and k <= 22, man and 10^k are doubles, so man / 10^k and man * 10^k are rounded once, to nearest;
 * fma gives the sign of the rounding error, and one step towards the wanted side makes the rounding directed. */
#include "io/plain.h"
#include "stream/number.h"
#include <math.h>

static const double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

typedef struct cursor {
  const char *at, *end;
} cursor;

static bool take(cursor *c, char wanted) {
  if (c->at == c->end || *c->at != wanted) return false;
  c->at++;
  return true;
}

/* Digits appended to *man; the number of digits read, or -1 when there are more than 18 in all. */
static int take_digits(int64_t *man, cursor *c, int limit) {
  int count = 0;
  for (; c->at < c->end && *c->at >= '0' && *c->at <= '9'; c->at++, count++) {
    if (count >= limit) return -1;
    *man = *man * 10 + (*c->at - '0');
  }
  return count;
}

/* e or E, sign, one to four digits. */
static bool take_exponent(int *exp, cursor *c) {
  if (!take(c, 'e') && !take(c, 'E')) return true;
  bool negative = take(c, '-');
  if (!negative) take(c, '+');
  int64_t value = 0;
  if (take_digits(&value, c, 4) < 1) return false;
  *exp += (int)(negative ? -value : value);
  return true;
}

bool dyd_plain_scan(dyd_plain *out, const char *text, size_t length) {
  cursor c = {text, text + length};
  dyd_plain p = {0, 0};
  bool negative = take(&c, '-');
  if (!negative) take(&c, '+');
  int whole = take_digits(&p.man, &c, 18), fraction = 0;
  if (whole < 0) return false;
  if (take(&c, '.')) {
    fraction = take_digits(&p.man, &c, 18 - whole);
    if (fraction < 0) return false;
    p.exp = -fraction;
  }
  if (whole + fraction == 0 || !take_exponent(&p.exp, &c) || c.at != c.end) return false;
  if (p.exp < -60 || p.exp > 60) return false;
  if (negative) p.man = -p.man;
  *out = p;
  return true;
}

bool dyd_plain_get_exact(double *out, dyd_plain p) {
  int exp = p.exp;
  while (exp < 0 && p.man % 5 == 0 && p.man != 0) {
    p.man /= 5;
    exp++;
  }
  if (p.man != 0 && exp < 0) return false;
  int twos = p.man == 0 ? 0 : p.exp < 0 ? p.exp : 0;
  for (; p.man != 0 && exp > 0; exp--) {
    if (p.man > INT64_MAX / 10 || p.man < -(INT64_MAX / 10)) return false;
    p.man *= 10;
  }
  double value = (double)p.man;
  if (value >= 0x1p63 || value < -0x1p63 || (int64_t)value != p.man) return false;
  *out = ldexp(value, twos);
  return true;
}

bool dyd_plain_get_rounded(double *out, dyd_plain p, dyd_round dir) {
  if (p.man >= (int64_t)1 << 53 || p.man <= -((int64_t)1 << 53) || p.exp > 22 || p.exp < -22) return false;
  double man = (double)p.man, near, error;
  if (p.exp < 0) {
    near = man / power_of_ten[-p.exp];
    error = fma(near, power_of_ten[-p.exp], -man);
  } else {
    near = man * power_of_ten[p.exp];
    error = -fma(man, power_of_ten[p.exp], -near);
  }
  if (error * (double)dir < 0) near = nextafter(near, dir == DYD_UP ? INFINITY : -INFINITY);
  *out = near;
  return true;
}

void dyd_plain_get_q(mpq_t q, dyd_plain p) {
  if (p.exp >= -18 && p.exp <= 18 && dyd_small_decimal(q, (uint64_t)(p.man < 0 ? -p.man : p.man), p.exp)) {
    if (p.man < 0) mpq_neg(q, q);
    return;
  }
  mpz_set_si(mpq_numref(q), p.man);
  mpz_ui_pow_ui(mpq_denref(q), 10, (unsigned long)(p.exp < 0 ? -p.exp : p.exp));
  if (p.exp > 0) {
    mpz_mul(mpq_numref(q), mpq_numref(q), mpq_denref(q));
    mpz_set_ui(mpq_denref(q), 1);
  }
  mpq_canonicalize(q);
}
