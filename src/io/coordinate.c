/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One coordinate of the input: text to an exact number, a fixed interval or a computable real.
 *
 * A plain decimal v with half-width h > 0 becomes the interval [v-h, v+h], its ends rounded outward to doubles when
 * that adds less than 2^-20 of the width; else the exact ends go to dyd_real_from_interval, which adds less than
 * 2^-64. Rounding outward is sound (every choice in the exact rectangle is one in the rounded rectangle).
 *
 * Sums rounded in one direction: for doubles a, b and s = a + b to nearest, Knuth's TwoSum gives the exact error
 * e = a + b - s (no overflow here: all are below 2^100 in size); s moved one double towards the wanted side when e
 * lies on that side is the directed rounding. */
#include "io/coordinate.h"
#include "base/alloc.h"
#include "base/error.h"
#include "stream/number.h"
#include <math.h>
#include <string.h>

static double sum_towards(double a, double b, dyd_round dir) {
  double s = a + b, t = s - a;
  double e = (a - (s - t)) + (b - t);
  return e * (double)dir > 0 ? nextafter(s, dir == DYD_UP ? INFINITY : -INFINITY) : s;
}

/* ---- reals that know where they were written ---- */

typedef struct placed {
  dyd_real *inner;
  size_t line, column;
} placed;

static dyd_status placed_narrow(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  placed *p = user;
  dyd_status status = dyd_real_narrow(p->inner, request->bits, request->max_bits, err);
  if (status < 0) {
    if (err) err->line = p->line, err->column = p->column;
    return status;
  }
  dyd_interval_set(out, dyd_real_interval(p->inner));
  return dyd_real_is_final(p->inner) ? DYD_FIXED : DYD_OK;
}

static void placed_release(void *user) {
  placed *p = user;
  dyd_real_free(p->inner);
  free(p);
}

/* Replaces a real that is still to be narrowed by one whose errors name the place. */
static dyd_status place(dyd_real **x, const dyd_span *span, dyd_error *err) {
  if (dyd_real_is_final(*x)) return DYD_OK;
  placed *p = dyd_alloc(1, sizeof *p);
  if (!p) return dyd_fail_nomem(err);
  *p = (placed){.inner = *x};
  dyd_span_position(&p->line, &p->column, span, 0);
  dyd_real *outer = NULL;
  dyd_status status = dyd_real_new(&outer, placed_narrow, placed_release, p);
  if (status < 0) {
    free(p);
    return status;
  }
  *x = outer;
  return DYD_OK;
}

/* ---- the quick way ---- */

static bool box_from_plain(dyd_coordinate *out, dyd_plain v, const dyd_manner *manner) {
  dyd_plain ends[2] = {v, v};
  if (manner->measured) {
    if (v.man > INT64_MAX / 20 || v.man < -(INT64_MAX / 20)) return false;
    ends[0] = (dyd_plain){v.man * 10 - 5, v.exp - 1};
    ends[1] = (dyd_plain){v.man * 10 + 5, v.exp - 1};
  }
  double lo, hi;
  if (!dyd_plain_get_rounded(&lo, ends[0], DYD_DOWN) || !dyd_plain_get_rounded(&hi, ends[1], DYD_UP)) return false;
  if (manner->widen) {
    if (!(manner->radius_up < 0x1p90)) return false;
    lo = sum_towards(lo, -manner->radius_up, DYD_DOWN);
    hi = sum_towards(hi, manner->radius_up, DYD_UP);
  }
  /* Each end moved by less than 2^-51 of max(|lo|,|hi|) + radius in all. */
  double size = fmax(fabs(lo), fabs(hi));
  if (!((size + manner->radius_up) * 0x1p-50 <= (hi - lo) * 0x1p-20)) return false;
  *out = (dyd_coordinate){.kind = DYD_COORDINATE_BOX, .lo = lo, .hi = hi};
  return true;
}

static bool read_plain(dyd_coordinate *out, const dyd_span *span, const dyd_manner *manner) {
  dyd_plain plain;
  if (!dyd_plain_scan(&plain, span->text, span->length)) return false;
  if (manner->measured || manner->widen) return box_from_plain(out, plain, manner);
  double value;
  if (dyd_plain_get_exact(&value, plain))
    *out = (dyd_coordinate){.kind = DYD_COORDINATE_DOUBLE, .plain = plain, .lo = value, .hi = value};
  else
    *out = (dyd_coordinate){.kind = DYD_COORDINATE_PLAIN, .plain = plain};
  return true;
}

/* ---- the general way ---- */

/* x +- radius; a fixed real stays fixed. */
static dyd_status widen(dyd_real **x, const mpq_t radius, dyd_error *err) {
  dyd_real *wide = NULL;
  dyd_status status;
  if (dyd_real_is_final(*x)) {
    mpq_t lo, hi;
    mpq_inits(lo, hi, NULL);
    dyd_interval_get_q(lo, hi, dyd_real_interval(*x));
    mpq_sub(lo, lo, radius);
    mpq_add(hi, hi, radius);
    status = dyd_real_from_interval(&wide, lo, hi);
    mpq_clears(lo, hi, NULL);
    dyd_real_free(*x);
  } else {
    status = dyd_real_widen(&wide, *x, radius);
  }
  *x = wide;
  return status < 0 ? dyd_fail(err, status, "%s", dyd_status_text(status)) : DYD_OK;
}

static bool looks_decimal(const dyd_span *span) {
  for (size_t k = 0; k < span->length; k++)
    if (!memchr("0123456789.eE+-", span->text[k], 15)) return false;
  return true;
}

static dyd_status parse(dyd_real **out, const dyd_span *span, const dyd_manner *manner, dyd_error *err) {
  if (!manner->measured || !looks_decimal(span)) return dyd_real_parse(out, span->text, span->length, err);
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  dyd_status status = dyd_parse_measured(lo, hi, span->text, span->length, err);
  if (status >= 0) status = dyd_real_from_interval(out, lo, hi);
  mpq_clears(lo, hi, NULL);
  return status;
}

/* Turns the column inside the coordinate into line and column of the file. */
static void place_error(dyd_error *err, const dyd_span *span) {
  if (!err) return;
  size_t inside = err->column ? err->column - 1 : 0, line, column;
  dyd_span_position(&line, &column, span, 0);
  err->line = line;
  err->column = column + inside;
}

dyd_status dyd_coordinate_read(dyd_coordinate *out, const dyd_span *span, const dyd_manner *manner, dyd_error *err) {
  if (read_plain(out, span, manner)) return DYD_OK;
  dyd_real *real = NULL;
  if (err) err->column = 0;
  dyd_status status = parse(&real, span, manner, err);
  if (status < 0) {
    if (err && !err->message[0]) dyd_fail(err, status, "%s", dyd_status_text(status));
    place_error(err, span);
    return status;
  }
  if (manner->widen) status = widen(&real, manner->radius, err);
  if (status >= 0) status = place(&real, span, err);
  if (status < 0) {
    dyd_real_free(real);
    place_error(err, span);
    return status;
  }
  *out = (dyd_coordinate){.kind = DYD_COORDINATE_REAL, .real = real};
  return DYD_OK;
}

void dyd_coordinate_clear(dyd_coordinate *c) {
  if (c->kind == DYD_COORDINATE_REAL) dyd_real_free(c->real);
  *c = (dyd_coordinate){.kind = DYD_COORDINATE_DOUBLE};
}

dyd_status dyd_coordinate_make_real(dyd_coordinate *c) {
  if (c->kind == DYD_COORDINATE_REAL) return DYD_OK;
  dyd_real *real = NULL;
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  dyd_status status;
  if (c->kind == DYD_COORDINATE_PLAIN) {
    dyd_plain_get_q(lo, c->plain);
    status = dyd_real_from_q(&real, lo);
  } else {
    mpq_set_d(lo, c->lo);
    mpq_set_d(hi, c->hi);
    status = dyd_real_from_interval(&real, lo, hi);
  }
  mpq_clears(lo, hi, NULL);
  if (status < 0) return status;
  *c = (dyd_coordinate){.kind = DYD_COORDINATE_REAL, .real = real};
  return DYD_OK;
}
