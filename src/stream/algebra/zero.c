/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The zero test, cheapest first: a ball at 128 bits; the separation bound where few bits do; the identity; the
 * separation bound up to the cap, doubling, and leaving as soon as the ball excludes 0. */
#include "stream/algebra/zero.h"

#include "base/flag.h"
#include "stream/algebra/normal.h"
#include "stream/algebra/separation.h"

enum { FIRST_BITS = DYD_ZERO_FIRST_BITS, FEW_BITS = 4096 };

dyd_status dyd_algebra_open(dyd_algebra *a, int64_t most_bits, const volatile int *cancel) {
  *a = (dyd_algebra){.most = (slong)most_bits, .cancel = cancel};
  dyd_forms_init(&a->forms);
  a->forms.stop = cancel;
  return dyd_ring_init(&a->ring, &a->forms);
}

void dyd_algebra_close(dyd_algebra *a) {
  dyd_ring_clear(&a->ring);
  dyd_forms_clear(&a->forms);
}

dyd_status dyd_algebra_settle(dyd_algebra *a, const uint32_t *node, size_t count) {
  dyd_status st = dyd_ring_settle(&a->ring, node, count);
  a->settled = st == DYD_OK && !a->ring.stale;
  return st;
}

/* The value to `prec` bits: is 0 excluded? */
static bool zero_is_excluded(dyd_algebra *a, uint32_t n, slong prec) {
  arb_srcptr x = dyd_forms_value(&a->forms, n, prec);
  if (prec > a->count.bits) a->count.bits = prec;
  if (arb_contains_zero(x)) return false;
  a->shown = prec;
  return true;
}

/* |P| = |value| |Q| < 2^-bits: then P = 0. */
static bool is_below_separation(dyd_algebra *a, uint32_t n, slong prec, const dyd_separation *s) {
  mag_t m;
  mag_init(m);
  arb_get_mag(m, dyd_forms_value(&a->forms, n, prec));
  mag_mul(m, m, s->den);
  bool below = mag_cmp_2exp_si(m, -s->bits) < 0;
  mag_clear(m);
  return below;
}

/* Room for the values of all forms to `prec` bits, and for what functions compute with. */
static bool zero_has_room(const dyd_algebra *a, slong prec) {
  enum { FUNCTION = 32 };
  uint64_t bytes = dyd_bytes_times(a->forms.count + FUNCTION, (uint64_t)prec / 8);
  return !a->room || dyd_room_has(a->room, bytes, "the proof of a tie");
}

/* Goes on from `prec` until the bound decides. Digits before the point are computed, too: twice the bits will do, where
 * the operations do not cancel much. */
static dyd_zero separate_from_zero(dyd_algebra *a, uint32_t n, const dyd_separation *s) {
  slong last = 2 * s->bits + 8 * FIRST_BITS;
  if (last > a->most + 8 * FIRST_BITS) last = a->most + 8 * FIRST_BITS;
  for (slong prec = FIRST_BITS; prec <= 2 * last; prec *= 2) {
    slong now = prec < last ? prec : last;
    if (dyd_flag_is_set(a->cancel) || !zero_has_room(a, now)) return DYD_ZERO_UNKNOWN;
    if (zero_is_excluded(a, n, now)) return DYD_ZERO_REFUTED;
    if (is_below_separation(a, n, now, s)) return DYD_ZERO_PROVED;
  }
  return DYD_ZERO_UNKNOWN;
}

static dyd_zero test_by_bound(dyd_algebra *a, uint32_t n, slong most) {
  dyd_separation s = {.degree = 0};
  dyd_zero zero = DYD_ZERO_UNKNOWN;
  mag_init(s.den);
  if (most > a->most) most = a->most;
  if (dyd_separation_find(&s, &a->ring, n, most)) {
    zero = separate_from_zero(a, n, &s);
    if (s.degree > a->count.degree) a->count.degree = s.degree;
    a->count.by_bound += zero == DYD_ZERO_PROVED;
  }
  mag_clear(s.den);
  return zero;
}

static dyd_zero test_by_identity(dyd_algebra *a, uint32_t n) {
  const dyd_fraction *x = dyd_ring_fraction(&a->ring, n);
  if (!x || !fmpz_mpoly_is_zero(x->num, a->ring.ctx)) return DYD_ZERO_UNKNOWN;
  a->count.by_identity++;
  return DYD_ZERO_PROVED;
}

bool dyd_algebra_is_refuted(dyd_algebra *a, uint32_t n) {
  if (n == DYD_NONE || !zero_is_excluded(a, n, FIRST_BITS)) return false;
  a->count.tests++;
  a->count.nonzero++;
  return true;
}

bool dyd_algebra_is_nonzero(dyd_algebra *a, uint32_t n) {
  for (slong prec = FIRST_BITS; n != DYD_NONE && prec <= FEW_BITS && prec <= a->most; prec *= 2)
    if (zero_is_excluded(a, n, prec)) return true;
  return false;
}

int64_t dyd_algebra_smallness(dyd_algebra *a, uint32_t n, slong prec) {
  int64_t e = INT64_MAX;
  if (n == DYD_NONE) return e;
  arf_t least;
  arf_init(least);
  arb_get_abs_lbound_arf(least, dyd_forms_value(&a->forms, n, prec), prec);
  /* balls have exponents of limited size (dyd_ball_check) */
  if (arf_is_finite(least) && arf_sgn(least) > 0) e = 1 - (int64_t)fmpz_get_si(ARF_EXPREF(least));
  arf_clear(least);
  return e;
}

dyd_zero dyd_algebra_test(dyd_algebra *a, uint32_t n) {
  dyd_zero zero = DYD_ZERO_UNKNOWN;
  a->count.tests++;
  if (n != DYD_NONE && zero_is_excluded(a, n, FIRST_BITS)) zero = DYD_ZERO_REFUTED;
  if (n != DYD_NONE && a->settled) {
    if (!zero) zero = test_by_bound(a, n, FEW_BITS);
    if (!zero) zero = test_by_identity(a, n);
    if (!zero) zero = test_by_bound(a, n, a->most);
  }
  /* without a bound the value may still show that it is not 0 */
  if (!zero && dyd_algebra_is_nonzero(a, n)) zero = DYD_ZERO_REFUTED;
  a->count.nonzero += zero == DYD_ZERO_REFUTED;
  a->count.unknown += zero == DYD_ZERO_UNKNOWN;
  return zero;
}
