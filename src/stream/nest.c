/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What every call of a source goes through: requests, invariants, nestedness and complete error records.
 *
 * [NEST-1] A rectangle is taken over only if it is a subset of the one before, decided exactly. */
#include "stream/real.h"

#include "base/error.h"
#include "rect/interval.h"

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

/* The least e with the distance by which `now` leaves `old` below 2^e, at its worse end; *low tells which end. */
static int64_t nesting_excess(bool *low, const dyd_interval *old, const dyd_interval *now) {
  mpq_t a, b, c, d;
  mpq_inits(a, b, c, d, NULL);
  dyd_interval_get_q(a, b, old);
  dyd_interval_get_q(c, d, now);
  mpq_sub(a, a, c);
  mpq_sub(b, d, b);
  *low = mpq_cmp(a, b) >= 0;
  if (!*low) mpq_swap(a, b);
  int64_t e = 1 + (int64_t)mpz_sizeinbase(mpq_numref(a), 2) - (int64_t)mpz_sizeinbase(mpq_denref(a), 2);
  mpq_clears(a, b, c, d, NULL);
  return e;
}

dyd_status dyd_nesting_fail(dyd_error *err, const char *side, const dyd_interval *old, const dyd_interval *now) {
  double a[2], b[2];
  bool low;
  dyd_interval_get_d(&a[0], &a[1], old);
  dyd_interval_get_d(&b[0], &b[1], now);
  int64_t e = nesting_excess(&low, old, now);
  return dyd_fail(
      err, DYD_E_NESTING,
      "the new %s [%.17g, %.17g] is not inside the old one [%.17g, %.17g] (rounded): its %s end lies outside by "
      "less than 2^%lld; each answer must be a subset of the one before",
      side, b[0], b[1], a[0], a[1], low ? "lower" : "upper", (long long)e);
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
