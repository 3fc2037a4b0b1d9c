/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What every call of a source goes through: requests, invariants, nestedness and complete error records.
 *
 * [NEST-1] A rectangle is taken over only if it is a subset of the one before, decided exactly. */
#include "stream/real.h"

#include "base/error.h"
#include "rect/rect.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Room for the guard bits that built-in sources add. */
#define GUARD 64

dyd_status dyd_request_make(dyd_request *out, size_t point, int64_t bits, int64_t max_bits, dyd_error *err) {
  int64_t limit = DYD_EXP_LIMIT - GUARD;
  if (bits > limit) {
    return dyd_fail(err, DYD_E_RANGE, "a width of 2^-%lld was asked for; the finest is 2^-%lld", (long long)bits,
                    (long long)limit);
  }
  if (bits < -limit) bits = -limit;
  if (max_bits > limit) max_bits = limit;
  if (max_bits < bits) max_bits = bits;
  *out = (dyd_request){DYD_SIZED(dyd_request), .point = point, .bits = bits, .max_bits = max_bits};
  return DYD_OK;
}

/* Two ends, old and new, and the least e with their distance below 2^e. */
typedef struct nest_ends {
  mpq_t end[2];
  bool low;
  int64_t e;
} nest_ends;

/* Finds the end by which `now` leaves `old` farther. */
static void nest_find(nest_ends *n, const dyd_interval *old, const dyd_interval *now) {
  mpq_t a, b, c, d;
  mpq_inits(a, b, c, d, NULL);
  dyd_interval_get_q(a, b, old);
  dyd_interval_get_q(c, d, now);
  mpq_set(n->end[0], a);
  mpq_set(n->end[1], c);
  mpq_sub(a, a, c);
  mpq_sub(c, d, b);
  n->low = mpq_cmp(a, c) >= 0;
  if (!n->low) {
    mpq_set(n->end[0], b);
    mpq_set(n->end[1], d);
    mpq_swap(a, c);
  }
  n->e = 1 + (int64_t)mpz_sizeinbase(mpq_numref(a), 2) - (int64_t)mpz_sizeinbase(mpq_denref(a), 2);
  mpq_clears(a, b, c, d, NULL);
}

/* Digits that tell the ends apart, three more than their leading bits have in common; at most NEST_DIGITS. */
enum { NEST_DIGITS = 4000, NEST_SHOWN = 72, NEST_EDGE = 16 };
static int nest_digits(const nest_ends *n) {
  int64_t top = n->e;
  for (int k = 0; k < 2; k++) {
    int64_t bits =
        1 + (int64_t)mpz_sizeinbase(mpq_numref(n->end[k]), 2) - (int64_t)mpz_sizeinbase(mpq_denref(n->end[k]), 2);
    if (mpq_sgn(n->end[k]) && bits > top) top = bits;
  }
  int64_t digits = (top - n->e) * 31 / 100 + 3;
  return digits < 17 ? 17 : digits < NEST_DIGITS ? (int)digits : NEST_DIGITS;
}

/* Where they are long, most of the digits that both have are left out. */
static void nest_show(char shown[2][NEST_SHOWN], const nest_ends *n) {
  static char const none[] = "(memory is exhausted)";
  const int digits = nest_digits(n);
  const size_t size = (size_t)digits + 32;
  char *text = malloc(2 * size);
  mpf_t near;
  mpf_init2(near, (mp_bitcnt_t)digits * 4 + 64);
  for (int k = 0; text && k < 2; k++) {
    mpf_set_q(near, n->end[k]);
    gmp_snprintf(text + (size_t)k * size, size, "%.*Fg", digits, near);
  }
  mpf_clear(near);
  size_t same = 0;
  while (text && text[same] && text[same] == text[size + same]) same++;
  for (int k = 0; k < 2; k++) {
    const char *whole = text ? text + (size_t)k * size : none;
    if (strlen(whole) < NEST_SHOWN || same < 2 * NEST_EDGE)
      snprintf(shown[k], NEST_SHOWN, "%s", whole);
    else
      snprintf(shown[k], NEST_SHOWN, "%.*s...%.*s", NEST_EDGE, whole, NEST_EDGE, whole + same - 4);
  }
  free(text);
}

dyd_status dyd_nesting_fail(dyd_error *err, const char *side, const dyd_interval *old, const dyd_interval *now) {
  char shown[2][NEST_SHOWN];
  nest_ends n;
  mpq_inits(n.end[0], n.end[1], NULL);
  nest_find(&n, old, now);
  nest_show(shown, &n);
  mpq_clears(n.end[0], n.end[1], NULL);
  return dyd_fail(err, DYD_E_NESTING,
                  "the new %s %s %s is not inside the old one %s %s: its %s end is outside by less than 2^%lld; each "
                  "answer must be a subset of the one before",
                  side, n.low ? "from" : "up to", shown[1], n.low ? "from" : "up to", shown[0],
                  n.low ? "lower" : "upper", (long long)n.e);
}

dyd_status dyd_nest(dyd_interval *next, const dyd_interval *old, bool encloses, const char *side, dyd_error *err) {
  if (!dyd_interval_is_valid(next))
    return dyd_fail(err, DYD_E_STREAM, "the callback gave no valid %s; fill it with dyd_interval_set_ends", side);
  if (!old || (!encloses && dyd_interval_contains(old, next))) return DYD_OK;
  dyd_status st = encloses ? dyd_interval_intersect(next, old, next) : DYD_E_ARG;
  if (st == DYD_E_ARG) return dyd_nesting_fail(err, side, old, next);
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

dyd_status dyd_callback_fail(dyd_error *err, const dyd_error *own, dyd_status st, size_t point, uint64_t stage) {
  bool known = dyd_failed(st) && st >= DYD_E_CONTRADICTION;
  dyd_status code = known ? st : DYD_E_STREAM;
  if (!err) return code;
  *err = *own;
  err->code = code;
  if (err->point == DYD_NO_POINT) err->point = point;
  err->stage = stage;
  if (!known) return dyd_fail(err, code, "the callback of the stream returned the unknown status %d", (int)st);
  if (!err->message[0]) return dyd_fail(err, code, "%s (the callback gave no message)", dyd_status_text(code));
  return code;
}
