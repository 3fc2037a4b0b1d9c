/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One coordinate of the input: text to an exact number, a fixed interval or a computable real.
 *
 * A decimal v with a half-width h > 0 becomes the interval [v-h, v+h]: of decimals with one exponent where h is a
 * decimal and both are short, else of rationals. Regions of a probability, whose half-widths are rounded up anyway, are
 * rounded outward to doubles where that adds less than 2^-13 of the width. Rounding outward is sound (every choice in
 * the exact rectangle is one in the rounded rectangle).
 *
 * Sums rounded in one direction: for doubles a, b and s = a + b to nearest, Knuth's TwoSum gives the exact error
 * e = a + b - s (no overflow here: all are below 2^100 in size); s moved one double towards the wanted side when e
 * lies on that side is the directed rounding.
 *
 * Plain decimals: man * 10^-k with k > 0 is a dyadic iff 5^k divides man; it is then (man / 5^k) * 2^-k. For |man| <
 * 2^53 and k <= 22, man and 10^k are doubles, so man / 10^k and man * 10^k are rounded once, to nearest; fma gives the
 * sign of the rounding error, and one step towards the wanted side makes the rounding directed. */
#include "io/read/coordinate.h"

#include "base/error.h"
#include "base/local.h"
#include "io/decimal.h"
#include "stream/degrees.h"
#include "stream/number.h"
#include "stream/real.h"

#include <math.h>
#include <string.h>

/* ---- plain decimals ---- */

static const double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/* false: it is none of this size. */
static bool plain_of_numeral(dyd_plain *out, const dyd_numeral *n) {
  const int64_t exp = n->exponent - (int64_t)n->fraction;
  if (!n->few || exp < -60 || exp > 60) return false;
  *out = (dyd_plain){n->negative ? -(int64_t)n->man : (int64_t)n->man, (int)exp};
  return true;
}

bool dyd_plain_scan(dyd_plain *out, const char *text, size_t length) {
  dyd_numeral n;
  return dyd_numeral_scan(&n, text, length, DYD_NUMBER_DECIMAL) && plain_of_numeral(out, &n);
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

/* Of a hexadecimal float; false where it is no double. */
static bool binary_of(double *out, const dyd_numeral *n) {
  const int twos = n->man ? __builtin_ctzll(n->man) : 0;
  const int64_t exp = n->man ? n->exponent - 4 * (int64_t)n->fraction + twos : 0;
  const uint64_t man = n->man >> twos;
  if (!n->few || man >> 53 || exp < -1074 || exp > 900) return false;
  const double size = ldexp((double)man, (int)exp);
  *out = n->negative && man ? -size : size;
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

static double sum_towards(double a, double b, dyd_round dir) {
  double s = a + b, t = s - a;
  double e = (a - (s - t)) + (b - t);
  return e * (double)dir > 0 ? nextafter(s, dir == DYD_UP ? INFINITY : -INFINITY) : s;
}

/* ---- the quick way ---- */

/* *out becomes [lo - by, hi + by]. false: rounding outward would add too much, as each end moves by less than 2^-51 of
 * max(|lo|,|hi|) + by in all. */
static bool box_wide(dyd_coordinate *out, double lo, double hi, double by) {
  if (!(by > 0x1p-900 && by < 0x1p90)) return false;
  lo = sum_towards(lo, -by, DYD_DOWN);
  hi = sum_towards(hi, by, DYD_UP);
  if (!((fmax(fabs(lo), fabs(hi)) + by) * 0x1p-50 <= (hi - lo) * 0x1p-13)) return false;
  *out = (dyd_coordinate){.kind = DYD_COORDINATE_BOX, .lo = lo, .hi = hi};
  return true;
}

/* p as a multiple of 10^exp; false: it is none of less than 18 digits. */
static bool plain_scaled(int64_t *man, dyd_plain p, int exp) {
  for (*man = p.man; p.man && p.exp > exp; p.exp--)
    if (__builtin_mul_overflow(*man, 10, man)) return false;
  return *man < INT64_C(1000000000000000000) / 4 && *man > -INT64_C(1000000000000000000) / 4;
}

bool dyd_plain_enclose(double *lo, double *hi, dyd_plain from, int64_t upper) {
  return dyd_plain_get_rounded(lo, from, DYD_DOWN) && dyd_plain_get_rounded(hi, (dyd_plain){upper, from.exp}, DYD_UP);
}

/* A rounded measurement is off by half a unit of its last digit. */
static bool coordinate_span(dyd_coordinate *out, dyd_plain v, const dyd_manner *manner) {
  const dyd_plain half = {manner->measured ? 5 : 0, v.exp - manner->measured},
                  radius = manner->widen ? manner->decimal : half;
  const int exp = radius.exp < half.exp ? radius.exp : half.exp;
  int64_t middle, by[2] = {0, 0};
  if ((manner->widen && !(manner->plain && plain_scaled(&by[0], radius, exp))) || exp < -60 ||
      !plain_scaled(&middle, v, exp) || !plain_scaled(&by[1], half, exp))
    return false;
  *out = (dyd_coordinate){
      .kind = DYD_COORDINATE_SPAN, .plain = {middle - by[0] - by[1], exp}, .upper = middle + by[0] + by[1]};
  return dyd_plain_enclose(&out->lo, &out->hi, out->plain, out->upper);
}

/* The decimal q >= 0, in lowest terms, where it is a short one. */
static bool plain_set_q(dyd_plain *out, const mpq_t q) {
  if (!mpz_fits_slong_p(mpq_numref(q)) || !mpz_fits_slong_p(mpq_denref(q))) return false;
  long den = mpz_get_si(mpq_denref(q));
  for (*out = (dyd_plain){mpz_get_si(mpq_numref(q)), 0}; den % 10 == 0; den /= 10) out->exp--;
  const int by = den % 2 ? 5 : 2;
  for (; den % by == 0; den /= by, out->exp--)
    if (__builtin_mul_overflow(out->man, 10 / by, &out->man)) return false;
  return den == 1 && out->man < INT64_C(1000000000000000000);
}

void dyd_manner_set_radius(dyd_manner *m, const mpq_t q) {
  mpq_set(m->radius, q);
  m->widen = mpq_sgn(q) > 0;
  m->plain = plain_set_q(&m->decimal, q);
}

static bool coordinate_plain(dyd_coordinate *out, const dyd_span *span, const dyd_manner *manner) {
  dyd_numeral n;
  dyd_plain plain;
  double value;
  const bool wide = manner->measured || manner->widen;
  if (!dyd_numeral_scan(&n, span->text, span->length, DYD_NUMBER_DECIMAL | DYD_NUMBER_HEX)) return false;
  if (n.hex) {
    if (wide || !binary_of(&value, &n)) return false;
    *out = (dyd_coordinate){.kind = DYD_COORDINATE_BINARY, .lo = value, .hi = value};
    return true;
  }
  if (!plain_of_numeral(&plain, &n)) return false;
  if (wide) return coordinate_span(out, plain, manner);
  if (dyd_plain_get_exact(&value, plain))
    *out = (dyd_coordinate){.kind = DYD_COORDINATE_DOUBLE, .plain = plain, .lo = value, .hi = value};
  else
    *out = (dyd_coordinate){.kind = DYD_COORDINATE_PLAIN, .plain = plain};
  return true;
}

/* ---- the general way ---- */

/* "1.5+-0.1" states its radius, and has the characters of decimals, too. */
static bool looks_decimal(const dyd_span *span) {
  if (dyd_nominal_length(span) < span->length) return false;
  for (size_t k = 0; k < span->length; k++)
    if (!memchr("0123456789.eE+-", span->text[k], 15)) return false;
  return true;
}

/* Of a rounded measurement; DYD_E_ARG for other forms. */
static dyd_status measured_ends(mpq_t lo, mpq_t hi, const dyd_span *span, dyd_error *err) {
  char letter;
  dyd_status st = dyd_degrees_read(lo, hi, &letter, span->text, span->length, true, err);
  if (st == DYD_E_ARG && looks_decimal(span)) st = dyd_parse_measured(lo, hi, span->text, span->length, err);
  return st;
}

static dyd_status coordinate_parse(dyd_real **out, const dyd_span *span, const dyd_manner *manner, dyd_error *err) {
  if (!manner->measured) return dyd_real_parse(out, span->text, span->length, err);
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_status st = measured_ends(lo, hi, span, err);
  if (st == DYD_E_ARG)
    st = dyd_real_parse(out, span->text, span->length, err);
  else if (st == DYD_OK)
    st = dyd_real_from_interval(out, lo, hi);
  return st;
}

size_t dyd_nominal_length(const dyd_span *s) {
  int depth = 0;
  for (size_t k = 0; k + 1 < s->length; k++) {
    const char *p = s->text + k;
    depth += (*p == '(') - (*p == ')');
    if (!depth && (memcmp(p, "+-", 2) == 0 || memcmp(p, "\xC2\xB1", 2) == 0)) return k;
  }
  return s->length;
}

/* Of "[a,b]". */
static dyd_status interval_ends(mpq_t lo, mpq_t hi, const dyd_span *s) {
  const char *end = s->text + s->length, *comma = s->text;
  int depth = 0;
  for (; comma < end && (*comma != ',' || depth != 1); comma++)
    depth += (*comma == '(' || *comma == '[') - (*comma == ')' || *comma == ']');
  if (comma == end || end[-1] != ']') return DYD_E_PARSE;
  dyd_status st = dyd_real_parse_exact(lo, s->text + 1, (size_t)(comma - s->text) - 1);
  return st == DYD_OK ? dyd_real_parse_exact(hi, comma + 1, (size_t)(end - comma) - 2) : st;
}

/* Of a number, or one with a radius. */
static dyd_status value_ends(mpq_t lo, mpq_t hi, const dyd_span *s) {
  size_t length = dyd_nominal_length(s), behind = length + 2;
  DYD_LOCAL_NUMBERS(mpq, radius);
  dyd_status st = dyd_real_parse_exact(lo, s->text, length);
  if (st == DYD_OK && length < s->length) st = dyd_real_parse_exact(radius, s->text + behind, s->length - behind);
  mpq_add(hi, lo, radius);
  mpq_sub(lo, lo, radius);
  return st;
}

dyd_status dyd_coordinate_ends(mpq_t lo, mpq_t hi, const dyd_span *span, const dyd_manner *manner) {
  dyd_status st = manner && manner->measured ? measured_ends(lo, hi, span, NULL) : DYD_E_ARG;
  if (st == DYD_E_ARG) st = span->text[0] == '[' ? interval_ends(lo, hi, span) : value_ends(lo, hi, span);
  if (st != DYD_OK || !manner) return st;
  mpq_sub(lo, lo, manner->radius);
  mpq_add(hi, hi, manner->radius);
  return DYD_OK;
}

/* Parsed, widened, and told where it stands; *out is changed on success only. */
static dyd_status coordinate_real(dyd_real **out, const dyd_span *span, const dyd_manner *manner, size_t line,
                                  size_t column, dyd_error *err) {
  dyd_real *real = NULL, *wide = NULL;
  dyd_status st = coordinate_parse(&real, span, manner, err);
  if (st == DYD_OK && manner->widen) {
    dyd_real_place(real, line, column);
    st = dyd_real_widen(&wide, real, manner->radius);
    real = wide;
  }
  if (st != DYD_OK) return st;
  dyd_real_place(real, line, column);
  *out = real;
  return DYD_OK;
}

dyd_status dyd_coordinate_fail(dyd_error *err, dyd_status code, const dyd_span *span, const dyd_error *own) {
  if (err) {
    dyd_span_position(&err->line, &err->column, span, 0);
    if (own->column) err->column += own->column - 1;
  }
  return dyd_fail(err, code, "%s", own->message[0] ? own->message : dyd_status_text(code));
}

dyd_status dyd_coordinate_read(dyd_coordinate *out, const dyd_span *span, const dyd_manner *manner, dyd_error *err) {
  if (coordinate_plain(out, span, manner)) return DYD_OK;
  dyd_real *real = NULL;
  size_t line, column;
  dyd_error own;
  dyd_error_clear(&own);
  dyd_span_position(&line, &column, span, 0);
  dyd_status st = coordinate_real(&real, span, manner, line, column, &own);
  if (st == DYD_OK) {
    *out = (dyd_coordinate){.kind = DYD_COORDINATE_REAL, .real = real};
    return DYD_OK;
  }
  return dyd_coordinate_fail(err, st, span, &own);
}

void dyd_coordinate_clear(dyd_coordinate *c) {
  if (c->kind == DYD_COORDINATE_REAL) dyd_real_free(c->real);
  *c = (dyd_coordinate){.kind = DYD_COORDINATE_DOUBLE};
}

static dyd_plain upper_of(const dyd_coordinate *c) {
  return (dyd_plain){c->kind == DYD_COORDINATE_SPAN ? c->upper : c->plain.man, c->plain.exp};
}

dyd_status dyd_coordinate_make_real(dyd_coordinate *c) {
  if (c->kind == DYD_COORDINATE_REAL) return DYD_OK;
  dyd_real *real = NULL;
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  if (c->kind == DYD_COORDINATE_PLAIN || c->kind == DYD_COORDINATE_SPAN) {
    dyd_plain_get_q(lo, c->plain);
    dyd_plain_get_q(hi, upper_of(c));
  } else {
    mpq_set_d(lo, c->lo);
    mpq_set_d(hi, c->hi);
  }
  dyd_status st = dyd_real_from_interval(&real, lo, hi);
  if (st != DYD_OK) return st;
  *c = (dyd_coordinate){.kind = DYD_COORDINATE_REAL, .real = real};
  return DYD_OK;
}

dyd_status dyd_coordinate_widen(dyd_coordinate *c, double by) {
  double lo = c->lo, hi = c->hi;
  bool quick = c->kind != DYD_COORDINATE_REAL;
  if (!(by > 0)) return DYD_OK;
  if (c->kind == DYD_COORDINATE_PLAIN || c->kind == DYD_COORDINATE_SPAN)
    quick = dyd_plain_enclose(&lo, &hi, c->plain, upper_of(c).man);
  if (quick && box_wide(c, lo, hi, by)) return DYD_OK;
  dyd_status st = dyd_coordinate_make_real(c);
  if (st != DYD_OK) return st;
  DYD_LOCAL_NUMBERS(mpq, radius);
  mpq_set_d(radius, by);
  c->kind = DYD_COORDINATE_DOUBLE; /* the real is taken over */
  st = dyd_real_widen(&c->real, c->real, radius);
  if (st == DYD_OK) c->kind = DYD_COORDINATE_REAL;
  return st;
}
