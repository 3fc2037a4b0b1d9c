/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plain decimals of at most 18 digits and hexadecimal floats: the forms nearly all coordinates have.
 *
 * man * 10^-k with k > 0 is a dyadic iff 5^k divides man; it is then (man / 5^k) * 2^-k.
 * For |man| < 2^53 and k <= 22, man and 10^k are doubles, so man / 10^k and man * 10^k are rounded once, to nearest;
 * fma gives the sign of the rounding error, and one step towards the wanted side makes the rounding directed. */
#include "io/read/plain.h"
#include "io/fives.h"
#include "stream/number.h"
#include <math.h>

static const double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

typedef struct cursor {
  const char *at, *end;
} cursor;

static bool plain_take(cursor *c, char wanted) {
  if (c->at == c->end || *c->at != wanted) return false;
  c->at++;
  return true;
}

/* Digits appended to *man; the number of digits read, or -1 when there are more than 18 but for zeros in front. */
static int plain_digits(int64_t *man, cursor *c) {
  const char *begin = c->at;
  int64_t m = *man;
  for (; c->at < c->end && *c->at >= '0' && *c->at <= '9'; c->at++) {
    if (m >= INT64_C(100000000000000000) || c->at - begin > 1000) return -1;
    m = m * 10 + (*c->at - '0');
  }
  *man = m;
  return (int)(c->at - begin);
}

/* One of the letters, sign, one to four digits; nothing is right, too. */
static bool plain_exponent(int *exp, cursor *c, char small, char large) {
  if (!plain_take(c, small) && !plain_take(c, large)) return true;
  bool negative = plain_take(c, '-');
  if (!negative) plain_take(c, '+');
  int64_t value = 0;
  if (plain_digits(&value, c) < 1 || value > 9999) return false;
  *exp += (int)(negative ? -value : value);
  return true;
}

bool dyd_plain_scan(dyd_plain *out, const char *text, size_t length) {
  cursor c = {text, text + length};
  dyd_plain p = {0, 0};
  bool negative = plain_take(&c, '-');
  if (!negative) plain_take(&c, '+');
  int whole = plain_digits(&p.man, &c), fraction = 0;
  if (whole < 0) return false;
  if (plain_take(&c, '.')) {
    fraction = plain_digits(&p.man, &c);
    if (fraction < 0) return false;
    p.exp = -fraction;
  }
  if (whole + fraction == 0 || !plain_exponent(&p.exp, &c, 'e', 'E') || c.at != c.end) return false;
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

bool dyd_plain_get_words(dyd_words *out, dyd_plain p) {
  *out = (dyd_words){0, 1, 0};
  if (!p.man) return true;
  int five = -p.exp;
  for (; five > 0 && p.man % 5 == 0; five--) p.man /= 5;
  if (five > DYD_MOST_FIVES || five < -DYD_MOST_FIVES) return false;
  if (five >= 0)
    out->den = dyd_power_of_five[five];
  else if (__builtin_mul_overflow(p.man, (int64_t)dyd_power_of_five[-five], &p.man))
    return false;
  int twos = __builtin_ctzll((uint64_t)p.man);
  out->man = p.man / (INT64_C(1) << twos);
  out->exp = p.exp + twos;
  return true;
}

/* ---- hexadecimal floats ---- */

/* One more than the value of a digit; 0: none. */
static const unsigned char hex_digit[256] = {
    ['0'] = 1,  ['1'] = 2,  ['2'] = 3,  ['3'] = 4,  ['4'] = 5,  ['5'] = 6,  ['6'] = 7,  ['7'] = 8,
    ['8'] = 9,  ['9'] = 10, ['a'] = 11, ['b'] = 12, ['c'] = 13, ['d'] = 14, ['e'] = 15, ['f'] = 16,
    ['A'] = 11, ['B'] = 12, ['C'] = 13, ['D'] = 14, ['E'] = 15, ['F'] = 16};

/* Digits appended to *man; how many, or -1 when there are more than 15 but for zeros in front. */
static int plain_hex_digits(uint64_t *man, cursor *c) {
  const char *begin = c->at;
  uint64_t m = *man;
  for (unsigned digit; c->at < c->end && (digit = hex_digit[(unsigned char)*c->at]); c->at++) {
    if (m >> 56 || c->at - begin > 1000) return -1;
    m = m * 16 + (digit - 1);
  }
  *man = m;
  return (int)(c->at - begin);
}

bool dyd_plain_scan_hex(double *out, const char *text, size_t length) {
  cursor c = {text, text + length};
  uint64_t man = 0;
  bool negative = plain_take(&c, '-');
  if (!negative) plain_take(&c, '+');
  if (!plain_take(&c, '0') || (!plain_take(&c, 'x') && !plain_take(&c, 'X'))) return false;
  int whole = plain_hex_digits(&man, &c), fraction = plain_take(&c, '.') ? plain_hex_digits(&man, &c) : 0,
      exp = -4 * fraction;
  if (whole < 0 || fraction < 0 || whole + fraction == 0 || !plain_exponent(&exp, &c, 'p', 'P') || c.at != c.end)
    return false;
  if (man == 0) exp = 0;
  int twos = man ? __builtin_ctzll(man) : 0;
  man >>= twos;
  exp += twos;
  if (man >> 53 || exp < -1074 || exp > 900) return false;
  double size = ldexp((double)man, exp);
  *out = negative && man ? -size : size;
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
