/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers as text for output: decimals rounded in a known direction, exact ends of intervals.
 *
 * MPFR converts to decimal with directed rounding exactly. Rounding is monotone: for a decimal d <= x (a double) the
 * double nearest to d is <= x, so the direction survives reading the decimal back.
 *
 * Numbers x = (a + b sqrt(c)) / d: with n = floor(x 2^g), x lies in [n, n+1] 2^-g; g is chosen so that 2^-g is small
 * against 1 / d. sqrt(x) lies in [floor(sqrt(n)), ceil(sqrt(n+1))] 2^-(g/2). */
#include "io/decimal.h"

#include "base/alloc.h"
#include "base/local.h"
#include "dyadic/raw.h"
#include "io/read/coordinate.h"
#include "voronoi/surd_point.h"

#include <inttypes.h>
#include <math.h>
#include <mpfr.h>
#include <string.h>

#define SEVEN(from) (from), 5 * (from), 25 * (from), 125 * (from), 625 * (from), 3125 * (from), 15625 * (from)
const uint64_t dyd_power_of_five[] = {SEVEN(UINT64_C(1)), SEVEN(UINT64_C(78125)), SEVEN(UINT64_C(6103515625)),
                                      SEVEN(UINT64_C(476837158203125))};

__extension__ typedef unsigned __int128 wide;

/* 0.DIGITS * 10^exp as a plain decimal, or in scientific form when that needs many zeros; its length. */
static size_t decimal_layout(char *out, bool negative, const char *digits, int count, int exp) {
  while (count > 1 && digits[count - 1] == '0') count--;
  char *p = out;
  if (negative) *p++ = '-';
  if (exp < -4 || exp > 17) {
    *p++ = digits[0];
    if (count > 1) *p++ = '.';
    memcpy(p, digits + 1, (size_t)count - 1);
    p += count - 1;
    return (size_t)(p - out) + (size_t)snprintf(p, 8, "e%d", exp - 1);
  }
  int whole = exp < 0 ? 0 : exp < count ? exp : count;
  memcpy(p, digits, (size_t)whole);
  p += whole;
  for (int k = count; k < exp; k++) *p++ = '0';
  if (exp <= 0) *p++ = '0';
  if (whole < count) *p++ = '.';
  for (int k = exp; k < 0; k++) *p++ = '0';
  memcpy(p, digits + whole, (size_t)(count - whole));
  p += count - whole;
  *p = 0;
  return (size_t)(p - out);
}

enum { MOST_DIGITS = 17 };

/* |x| 10^tens = whole + rest 2^-shift, 0 <= rest 2^-shift < 1, and whole has `digits` digits. */
typedef struct decimal_cut {
  uint64_t man, whole; /* |x| is man times a power of two, and has 53 bits */
  wide rest;
  int digits, tens, shift;
} decimal_cut;

static void cut_at(decimal_cut *c, int exponent, int tens) {
  wide product = (wide)c->man * dyd_power_of_five[tens]; /* 53 and 63 bits */
  int shift = -exponent - tens;
  if (shift < 0) product <<= -shift, shift = 0; /* |x| 10^tens < 10^19 */
  c->tens = tens;
  c->shift = shift;
  c->whole = (uint64_t)(product >> shift);
  c->rest = product - ((wide)c->whole << shift);
}

/* The first digits of x, 2 to 17 of them; false where 128 bits do not hold everything, as they do for nearly all
 * numbers that people write: from 10^-11 to 10^16. The guess of `tens` is off by one at most: |x| 10^tens < 10^19, and
 * not below 1, so that shift < 128. */
static bool decimal_cut_off(decimal_cut *c, double x, int digits) {
  uint64_t bits, least = 1;
  memcpy(&bits, &x, sizeof bits);
  int exponent = (int)(bits >> 52 & 0x7ff) - 1075, tens = digits - 1 - (int)floor((exponent + 52) * 0.30103);
  if (tens < 2 || tens >= DYD_MOST_FIVES || digits > MOST_DIGITS) return false;
  *c = (decimal_cut){.man = (bits & ((UINT64_C(1) << 52) - 1)) | UINT64_C(1) << 52, .digits = digits};
  for (int k = 1; k < digits; k++) least *= 10;
  cut_at(c, exponent, tens);
  if (c->whole >= 10 * least) cut_at(c, exponent, tens - 1);
  if (c->whole < least) cut_at(c, exponent, tens + 1);
  return true;
}

/* Away from zero by one in the last digit where `up`. */
static size_t cut_layout(char *out, const decimal_cut *c, bool negative, bool up) {
  char text[DYD_INDEX_SIZE];
  int count = (int)(dyd_put_digits(text, c->whole + up) - text);
  return decimal_layout(out, negative, text, count, count - c->tens);
}

size_t dyd_decimal_directed(char out[DYD_DECIMAL_SIZE], double x, int digits, dyd_round dir) {
  decimal_cut cut;
  strcpy(out, "0");
  if (x == 0) return 1;
  if (isinf(x)) return (size_t)snprintf(out, DYD_DECIMAL_SIZE, "%s", x > 0 ? "inf" : "-inf");
  char text[40];
  mpfr_exp_t exp;
  if (decimal_cut_off(&cut, x, digits)) return cut_layout(out, &cut, x < 0, cut.rest && (dir == DYD_UP) == (x > 0));
  DYD_LOCAL_FLOATS(53, value);
  mpfr_set_d(value, x, MPFR_RNDN); /* exact */
  mpfr_get_str(text, &exp, 10, (size_t)digits, value, dir == DYD_UP ? MPFR_RNDU : MPFR_RNDD);
  bool negative = text[0] == '-';
  return decimal_layout(out, negative, text + negative, digits, (int)exp);
}

/* Takes apart what printf made of a number with %.*e, whatever the decimal point of the locale. */
static size_t decimal_layout_printed(char *out, const char *printed) {
  char digits[24];
  int count = 0;
  const char *p = printed;
  for (; *p && *p != 'e'; p++)
    if (*p >= '0' && *p <= '9') digits[count++] = *p;
  return decimal_layout(out, printed[0] == '-', digits, count, (int)strtol(p + 1, NULL, 10) + 1);
}

/* Known facts about a decimal. */
typedef struct near_decimal {
  double near; /* the double nearest to it; NAN: one that was not asked for */
  bool told, exact;
  size_t length;
} near_decimal;

/* The decimal nearest to x, half to even. x is the double nearest to it unless half the gap to the next double, 5^tens
 * / 2 in units of rest, is as near, or half of that below a power of two. Another one is found by a division of
 * doubles, rounded to nearest once, but only where it is wanted. Returns false where this way does not decide. */
static bool decimal_near(near_decimal *out, char text[DYD_DECIMAL_SIZE], double x, int digits, bool others) {
  decimal_cut c;
  if (!decimal_cut_off(&c, x, digits)) return false;
  wide one = (wide)1 << c.shift, twice = 2 * c.rest;
  bool up = twice > one || (twice == one && (c.whole & 1));
  wide away = up ? one - c.rest : c.rest;
  bool narrow = !up && c.man == UINT64_C(1) << 52, same = (narrow ? 4 : 2) * away < dyd_power_of_five[c.tens];
  if (!same && others && (c.whole >= UINT64_C(1) << 53 || c.tens > 22)) return false;
  double other = others ? (double)(c.whole + up) / ((double)dyd_power_of_five[c.tens] * (double)(1 << c.tens)) : NAN;
  *out = (near_decimal){same ? x : copysign(other, x), same, !away, cut_layout(text, &c, x < 0, up)};
  return true;
}

/* The same by the C library. */
static void decimal_printed(near_decimal *out, char text[DYD_DECIMAL_SIZE], double x, int digits) {
  char printed[40];
  snprintf(printed, sizeof printed, "%.*e", digits - 1, x);
  *out = (near_decimal){strtod(printed, NULL), false, false, 1};
  strcpy(text, "0");
  if (out->near != 0) out->length = decimal_layout_printed(text, printed);
}

/* Returns true if the decimal is the double nearest to it. */
static bool decimal_is_exact(const near_decimal *d, const char *text) {
  dyd_plain plain;
  double exact;
  if (d->told) return d->exact;
  return dyd_plain_scan(&plain, text, d->length) && dyd_plain_get_exact(&exact, plain) && exact == d->near;
}

size_t dyd_decimal_within(char out[DYD_DECIMAL_SIZE], double *error, double lo, double hi) {
  *error = 0;
  strcpy(out, "0");
  if (lo == 0 && hi == 0) return 1;
  double middle = lo / 2 + hi / 2;
  if (!(middle >= lo && middle <= hi)) middle = lo;
  near_decimal d = {.near = NAN};
  for (int digits = 15; digits <= MOST_DIGITS && !(d.near >= lo && d.near <= hi); digits++)
    if (!decimal_near(&d, out, middle, digits, lo < hi)) decimal_printed(&d, out, middle, digits);
  double r = d.near;
  *error = fmax(hi - r, r - lo);
  if (*error > 0) *error = nextafter(*error, INFINITY);
  if (decimal_is_exact(&d, out)) return d.length;
  /* |decimal - r| is at most half the gap above |r|, the larger one; then two roundings to nearest. */
  double gap = nextafter(fabs(r), INFINITY) - fabs(r);
  *error = nextafter(nextafter(*error + gap / 2, INFINITY), INFINITY);
  return d.length;
}

/* MPFR rounds decimals correctly, and its exponents reach far beyond DYD_EXP_LIMIT. */
void dyd_decimal_dyadic(char out[DYD_DECIMAL_SIZE], const dyd_dyadic *x, int digits, dyd_round dir) {
  strcpy(out, "0");
  if (dyd_dyadic_sgn(x) == 0) return;
  char text[DYD_DECIMAL_SIZE];
  mpfr_exp_t point;
  size_t bits = mpz_sizeinbase(x->man, 2);
  DYD_LOCAL_FLOATS(bits < 2 ? 2 : (mpfr_prec_t)bits, exact);
  mpfr_set_z_2exp(exact, x->man, (mpfr_exp_t)x->exp, MPFR_RNDN);
  mpfr_get_str(text, &point, 10, (size_t)digits, exact, dir == DYD_UP ? MPFR_RNDU : MPFR_RNDD);
  const char *digit = text + (*text == '-');
  snprintf(out, DYD_DECIMAL_SIZE, "%s%c.%se%" PRIdMAX, *text == '-' ? "-" : "", *digit, digit + 1, (intmax_t)point - 1);
}

void dyd_sink_decimal(dyd_sink *s, double x, dyd_round dir, const char *otherwise) {
  if (isfinite(x))
    s->end += dyd_decimal_directed(dyd_sink_room(s, DYD_DECIMAL_SIZE), x, MOST_DIGITS, dir);
  else
    dyd_sink_text(s, otherwise);
}

void dyd_decimal_put(FILE *out, double x, dyd_round dir, const char *otherwise) {
  char text[DYD_DECIMAL_SIZE];
  if (isfinite(x)) dyd_decimal_directed(text, x, MOST_DIGITS, dir);
  fputs(isfinite(x) ? text : otherwise, out);
}

void dyd_decimal_put_near(FILE *out, double x) {
  char text[DYD_DECIMAL_SIZE];
  double error;
  dyd_decimal_within(text, &error, x, x);
  fputs(text, out);
}

/* The end of a, for a den > 1. */
static char *rational_text(const dyd_interval *a, bool upper) {
  char *text = NULL, *whole = NULL;
  const dyd_dyadic *end = upper ? &a->hi : &a->lo;
  if (end->exp > 256 || end->exp < -256) {
    whole = dyd_dyadic_get_str(end);
    size_t size = whole ? strlen(whole) + mpz_sizeinbase(a->den, 10) + 3 : 0;
    text = whole ? dyd_alloc(size, 1) : NULL;
    if (text) gmp_snprintf(text, size, "%s/%Zd", whole, a->den);
    free(whole);
    return text;
  }
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_interval_get_q(lo, hi, a);
  mpq_srcptr q = upper ? hi : lo;
  size_t size = mpz_sizeinbase(mpq_numref(q), 10) + mpz_sizeinbase(mpq_denref(q), 10) + 3;
  text = dyd_alloc(size, 1);
  if (text) mpq_get_str(text, 10, q);
  return text;
}

/* One end may be dyadic where the other is not. */
char *dyd_end_text(const dyd_interval *a, bool upper) {
  const dyd_dyadic *end = upper ? &a->hi : &a->lo;
  if (mpz_cmp_ui(a->den, 1) == 0) return dyd_dyadic_get_str(end);
  if (!mpz_divisible_p(end->man, a->den)) return rational_text(a, upper);
  DYD_LOCAL(dyd_dyadic, whole);
  dyd_dyadic_set(&whole, end);
  mpz_divexact(whole.man, whole.man, a->den);
  return dyd_dyadic_get_str(&whole);
}

static char *put_wide_digits(char *to, wide n) {
  const uint64_t half = UINT64_C(10000000000000000000);
  if (n <= UINT64_MAX) return dyd_put_digits(to, (uint64_t)n);
  char low[DYD_INDEX_SIZE];
  ptrdiff_t count = dyd_put_digits(low, (uint64_t)(n % half)) - low;
  to = dyd_put_digits(to, (uint64_t)(n / half));
  memset(to, '0', (size_t)(19 - count));
  memcpy(to + 19 - count, low, (size_t)count);
  return to + 19;
}

/* n / half < 2^63 for n < 2^126. */
char *dyd_words_put(char to[DYD_WORDS_SIZE], const dyd_words *w) {
  uint64_t man = w->man < 0 ? 0 - (uint64_t)w->man : (uint64_t)w->man;
  int whole = w->exp > 0 ? w->exp : 0, part = w->exp < 0 ? -w->exp : 0;
  if (whole > __builtin_clzll(man | 1) || part >= __builtin_clzll(w->den) + 63) return NULL;
  if (w->man < 0) *to++ = '-';
  to = dyd_put_digits(to, man << whole);
  if (w->den != 1) {
    *to++ = '/';
    return put_wide_digits(to, (wide)w->den << part);
  }
  if (!part) return to;
  memcpy(to, "*2^-", 4);
  return dyd_put_digits(to + 4, (uint64_t)part);
}

/* ---- numbers (a + b sqrt(c)) / d ---- */

void dyd_exact_text(FILE *out, mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d) {
  DYD_LOCAL_NUMBERS(mpz, gcd, p, q, r);
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
}

/* Fine enough for 17 digits of 1 / d. */
static int64_t enclosure_bits(const dyd_surd_point *p) {
  return 64 + dyd_bits(p->d);
}

void dyd_exact_enclose(double box[4], const dyd_surd_point *p) {
  int64_t bits = enclosure_bits(p);
  DYD_LOCAL_NUMBERS(mpz, floor, ceiling);
  for (int axis = 0; axis < 2; axis++) {
    dyd_surd_point_floor(floor, ceiling, p, axis, bits);
    box[2 * axis] = dyd_raw_get_d(floor, -bits, DYD_DOWN);
    box[2 * axis + 1] = dyd_raw_get_d(ceiling, -bits, DYD_UP);
  }
}

void dyd_exact_enclose_root(double *lo, double *hi, const dyd_surd_point *p) {
  int64_t bits = enclosure_bits(p);
  DYD_LOCAL_NUMBERS(mpz, floor, ceiling, rest);
  dyd_surd_point_floor(floor, ceiling, p, 0, 2 * bits);
  mpz_sqrt(floor, floor);
  mpz_sqrtrem(ceiling, rest, ceiling);
  if (mpz_sgn(rest)) mpz_add_ui(ceiling, ceiling, 1);
  *lo = dyd_raw_get_d(floor, -bits, DYD_DOWN);
  *hi = dyd_raw_get_d(ceiling, -bits, DYD_UP);
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
