/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One coordinate of the input: text to an exact number, a fixed interval or a computable real.
 *
 * A plain decimal v with half-width h > 0 becomes the interval [v-h, v+h], its ends rounded outward to doubles when
 * that adds less than 2^-13 of the width; else the exact ends go to dyd_real_from_interval, which adds less than
 * 2^-64. Rounding outward is sound (every choice in the exact rectangle is one in the rounded rectangle).
 *
 * Sums rounded in one direction: for doubles a, b and s = a + b to nearest, Knuth's TwoSum gives the exact error
 * e = a + b - s (no overflow here: all are below 2^100 in size); s moved one double towards the wanted side when e
 * lies on that side is the directed rounding. */
#include "io/read/coordinate.h"
#include "base/error.h"
#include "stream/number.h"
#include "stream/real.h"
#include <math.h>
#include <string.h>

static double sum_towards(double a, double b, dyd_round dir) {
  double s = a + b, t = s - a;
  double e = (a - (s - t)) + (b - t);
  return e * (double)dir > 0 ? nextafter(s, dir == DYD_UP ? INFINITY : -INFINITY) : s;
}

/* ---- the quick way ---- */

static bool coordinate_box(dyd_coordinate *out, dyd_plain v, const dyd_manner *manner) {
  dyd_plain ends[2] = {v, v};
  if (manner->measured) {
    if (v.man > INT64_MAX / 20 || v.man < -(INT64_MAX / 20)) return false;
    ends[0] = (dyd_plain){v.man * 10 - 5, v.exp - 1};
    ends[1] = (dyd_plain){v.man * 10 + 5, v.exp - 1};
  }
  double lo, hi;
  if (!dyd_plain_get_rounded(&lo, ends[0], DYD_DOWN) || !dyd_plain_get_rounded(&hi, ends[1], DYD_UP)) return false;
  if (manner->widen) {
    if (!(manner->radius_up > 0x1p-900 && manner->radius_up < 0x1p90)) return false;
    lo = sum_towards(lo, -manner->radius_up, DYD_DOWN);
    hi = sum_towards(hi, manner->radius_up, DYD_UP);
  }
  /* Each end moved by less than 2^-51 of max(|lo|,|hi|) + radius in all. */
  double size = fmax(fabs(lo), fabs(hi));
  if (!((size + manner->radius_up) * 0x1p-50 <= (hi - lo) * 0x1p-13)) return false;
  *out = (dyd_coordinate){.kind = DYD_COORDINATE_BOX, .lo = lo, .hi = hi};
  return true;
}

/* Does the text look like a hexadecimal float? */
static bool looks_hex(const dyd_span *span) {
  for (size_t k = 1; k < 3 && k < span->length; k++)
    if (span->text[k] == 'x' || span->text[k] == 'X') return true;
  return false;
}

static bool coordinate_hex(dyd_coordinate *out, const dyd_span *span, const dyd_manner *manner) {
  double value;
  if (manner->measured || manner->widen || !dyd_plain_scan_hex(&value, span->text, span->length)) return false;
  *out = (dyd_coordinate){.kind = DYD_COORDINATE_BINARY, .lo = value, .hi = value};
  return true;
}

static bool coordinate_plain(dyd_coordinate *out, const dyd_span *span, const dyd_manner *manner) {
  dyd_plain plain;
  if (looks_hex(span)) return coordinate_hex(out, span, manner);
  if (!dyd_plain_scan(&plain, span->text, span->length)) return false;
  if (manner->measured || manner->widen) return coordinate_box(out, plain, manner);
  double value;
  if (dyd_plain_get_exact(&value, plain))
    *out = (dyd_coordinate){.kind = DYD_COORDINATE_DOUBLE, .plain = plain, .lo = value, .hi = value};
  else
    *out = (dyd_coordinate){.kind = DYD_COORDINATE_PLAIN, .plain = plain};
  return true;
}

/* ---- the general way ---- */

static bool looks_decimal(const dyd_span *span) {
  for (size_t k = 0; k < span->length; k++)
    if (!memchr("0123456789.eE+-", span->text[k], 15)) return false;
  return true;
}

static dyd_status coordinate_parse(dyd_real **out, const dyd_span *span, const dyd_manner *manner, dyd_error *err) {
  if (!manner->measured || !looks_decimal(span)) return dyd_real_parse(out, span->text, span->length, err);
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  dyd_status st = dyd_parse_measured(lo, hi, span->text, span->length, err);
  if (st == DYD_OK) st = dyd_real_from_interval(out, lo, hi);
  mpq_clears(lo, hi, NULL);
  return st;
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

dyd_status dyd_coordinate_make_real(dyd_coordinate *c) {
  if (c->kind == DYD_COORDINATE_REAL) return DYD_OK;
  dyd_real *real = NULL;
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  dyd_status st;
  if (c->kind == DYD_COORDINATE_PLAIN) {
    dyd_plain_get_q(lo, c->plain);
    st = dyd_real_from_q(&real, lo);
  } else {
    mpq_set_d(lo, c->lo);
    mpq_set_d(hi, c->hi);
    st = dyd_real_from_interval(&real, lo, hi);
  }
  mpq_clears(lo, hi, NULL);
  if (st != DYD_OK) return st;
  *c = (dyd_coordinate){.kind = DYD_COORDINATE_REAL, .real = real};
  return DYD_OK;
}
