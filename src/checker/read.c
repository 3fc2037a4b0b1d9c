/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading a certificate: lines, words, numbers in their only spelling. */
#include "checker/read.h"
#include "base/alloc.h"
#include "base/error.h"

#include <dyadel/dyadic.h>
#include <errno.h>
#include <stdarg.h>
#include <string.h>

void dyd_cert_reader_clear(dyd_cert_reader *r) {
  free(r->line);
  r->line = NULL;
}

dyd_status dyd_cert_reject(const dyd_cert_reader *r, const char *format, ...) {
  if (!r->err) return DYD_E_PARSE;
  char message[DYD_MESSAGE_SIZE];
  va_list args;
  va_start(args, format);
  vsnprintf(message, sizeof message, format, args);
  va_end(args);
  r->err->line = r->number;
  return dyd_fail(r->err, DYD_E_PARSE, "%s", message);
}

/* ---- lines and words ---- */

static dyd_status input_failed(dyd_cert_reader *r) {
  return dyd_fail(r->err, DYD_E_IO, "cannot read: %s", strerror(errno ? errno : EIO));
}

dyd_status dyd_cert_next_line(dyd_cert_reader *r) {
  size_t length = 0;
  r->number++;
  errno = 0;
  for (;;) {
    if (!dyd_reserve((void **)&r->line, &r->cap, length + 256, 1)) return dyd_fail_nomem(r->err);
    int c = 0;
    while (length + 1 < r->cap && (c = getc(r->in)) != EOF && c != '\n') r->line[length++] = (char)c;
    if (c == '\n') break;
    if (c != EOF) continue;
    if (ferror(r->in)) return input_failed(r);
    return dyd_cert_reject(r, length ? "the line does not end" : "the certificate ends before the line \"end\"");
  }
  r->line[length] = 0;
  if (strlen(r->line) != length) return dyd_cert_reject(r, "a zero byte");
  r->at = r->line;
  return DYD_OK;
}

dyd_status dyd_cert_expect_end(dyd_cert_reader *r) {
  r->number++;
  errno = 0;
  if (getc(r->in) != EOF) return dyd_cert_reject(r, "something follows the line \"end\"");
  return ferror(r->in) ? input_failed(r) : DYD_OK;
}

bool dyd_cert_line_has_more(const dyd_cert_reader *r) {
  return r->at != NULL;
}

dyd_status dyd_cert_word(char **out, dyd_cert_reader *r) {
  if (!r->at) return dyd_cert_reject(r, "the line is too short");
  *out = r->at;
  char *blank = strchr(r->at, ' ');
  r->at = blank ? blank + 1 : NULL;
  if (blank) *blank = 0;
  return **out ? DYD_OK : dyd_cert_reject(r, "two blanks, or a blank at the end or the beginning");
}

dyd_status dyd_cert_line_done(dyd_cert_reader *r) {
  return r->at ? dyd_cert_reject(r, "the line goes on with \"%.40s\"", r->at) : DYD_OK;
}

/* ---- numbers ---- */

/* The end of a decimal integer at `text` in its only spelling; NULL when there is none. */
static const char *scan_decimal(const char *text) {
  const char *digit = text + (*text == '-');
  if (*digit == '0') return digit == text ? digit + 1 : NULL;
  const char *p = digit;
  while (*p >= '0' && *p <= '9') p++;
  return p > digit ? p : NULL;
}

bool dyd_cert_scan_integer(mpz_ptr out, const char *text) {
  const char *end = scan_decimal(text);
  return end && !*end && end - text < DYD_EXP_LIMIT / 4 && mpz_set_str(out, text, 10) == 0;
}

/* A decimal of at most 18 digits. */
static bool scan_small(long long *out, const char *text) {
  const char *end = scan_decimal(text);
  if (!end || *end || end - text > 18) return false;
  *out = strtoll(text, NULL, 10);
  return true;
}

dyd_status dyd_cert_read_integer(long long *out, dyd_cert_reader *r) {
  char *word = NULL;
  dyd_status st = dyd_cert_word(&word, r);
  if (st != DYD_OK) return st;
  return scan_small(out, word) ? DYD_OK : dyd_cert_reject(r, "\"%.40s\" is no integer", word);
}

dyd_status dyd_cert_read_index(uint32_t *out, dyd_cert_reader *r, uint64_t most) {
  long long value;
  char *word = NULL;
  dyd_status st = dyd_cert_word(&word, r);
  if (st != DYD_OK) return st;
  if (!scan_small(&value, word) || value < 0)
    return dyd_cert_reject(r, "\"%.40s\" is not a number of a site or of lines", word);
  if ((uint64_t)value > most) return dyd_cert_reject(r, "%lld is too large", value);
  *out = (uint32_t)value;
  return DYD_OK;
}

static bool exact_in_range(const dyd_exact *x) {
  return dyd_exact_sgn(x) == 0 ||
         (x->exp >= -DYD_EXP_LIMIT && x->exp <= DYD_EXP_LIMIT && dyd_exact_top(x) <= DYD_EXP_LIMIT);
}

/* m or m*2^e; the text is destroyed. */
static bool scan_number(dyd_exact *out, char *text) {
  const char *end = scan_decimal(text);
  long long exp = 0;
  if (!end) return false;
  if (*end) {
    if (strncmp(end, "*2^", 3) != 0 || !scan_small(&exp, end + 3) || exp == 0) return false;
    text[end - text] = 0;
  }
  if (mpz_set_str(out->man, text, 10) != 0 || (exp && !mpz_odd_p(out->man))) return false;
  out->exp = exp;
  return exact_in_range(out);
}

dyd_status dyd_cert_read_number(dyd_exact *out, dyd_cert_reader *r) {
  char *word = NULL;
  dyd_status st = dyd_cert_word(&word, r);
  if (st != DYD_OK) return st;
  return scan_number(out, word) ? DYD_OK : dyd_cert_reject(r, "\"%.40s\" is not a number m or m*2^e", word);
}

dyd_status dyd_cert_read_point(dyd_exact out[2], dyd_cert_reader *r) {
  dyd_status st = dyd_cert_read_number(&out[0], r);
  return st == DYD_OK ? dyd_cert_read_number(&out[1], r) : st;
}

/* A denominator: odd, > 1, without a factor in common with the numerator. */
static dyd_status read_den(dyd_cert_side *out, dyd_cert_reader *r, const char *text) {
  const char *end = scan_decimal(text);
  if (!end || *end) return dyd_cert_reject(r, "\"%.40s\" is no denominator", text);
  mpz_t den, g;
  mpz_inits(den, g, NULL);
  bool good = mpz_set_str(den, text, 10) == 0 && mpz_cmp_ui(den, 1) > 0 && mpz_odd_p(den);
  if (good) mpz_gcd(g, den, out->lo.man);
  good = good && mpz_cmp_ui(g, 1) == 0 && mpz_sizeinbase(den, 2) <= (size_t)DYD_EXP_LIMIT;
  dyd_status st =
      good ? dyd_cert_side_set_den(out, den) : dyd_cert_reject(r, "\"%.40s\" is no denominator in lowest terms", text);
  mpz_clears(den, g, NULL);
  return st;
}

dyd_status dyd_cert_read_side(dyd_cert_side *out, dyd_cert_reader *r) {
  char *word = NULL;
  dyd_status st = dyd_cert_word(&word, r);
  if (st != DYD_OK) return st;
  size_t length = strcspn(word, "/+");
  char kind = word[length];
  word[length] = 0;
  if (!scan_number(&out->lo, word)) return dyd_cert_reject(r, "\"%.40s\" is not a number m or m*2^e", word);
  out->point = kind != '+';
  if (kind == '/') return read_den(out, r, word + length + 1);
  if (kind == 0) return DYD_OK;
  dyd_exact width;
  dyd_exact_init(&width);
  if (!scan_number(&width, word + length + 1) || dyd_exact_sgn(&width) <= 0)
    st = dyd_cert_reject(r, "\"%.40s\" is not a width", word + length + 1);
  else
    dyd_exact_add(&out->hi, &out->lo, &width);
  dyd_exact_clear(&width);
  return st;
}
