/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One coordinate of the input: text to an exact number, a fixed interval or a computable real. */
#ifndef DYD_IO_READ_COORDINATE_H
#define DYD_IO_READ_COORDINATE_H

#include "io/read/text.h"
#include "rect/sites_table.h"
#include <dyadel/stream.h>

/* ---- plain decimals, which are read without big numbers ---- */

/* The number man * 10^exp. Invariant: |man| < 10^18, -60 <= exp <= 60. */
typedef struct dyd_plain {
  int64_t man;
  int exp;
} dyd_plain;

/* Reads the whole text; returns false if it is not a decimal of this size (it may still be another form of number). */
bool dyd_plain_scan(dyd_plain *out, const char *text, size_t length);
/* Returns true if the number is a double. Then *out is it. (May say no for numbers above 2^63.) */
bool dyd_plain_get_exact(double *out, dyd_plain p);
/* The largest double <= p or the smallest >= p; false where this quick way does not apply
 * (|man| >= 2^53 or |exp| > 22). */
bool dyd_plain_get_rounded(double *out, dyd_plain p, dyd_round dir);
/* The number in single words; false where they are too short. */
bool dyd_plain_get_words(dyd_words *out, dyd_plain p);
/* The exact value, canonical; q is initialised by the caller. */
void dyd_plain_get_q(mpq_t q, dyd_plain p);
/* The ends of the interval from a decimal to upper * 10^from.exp, rounded outward to doubles; false where
 * dyd_plain_get_rounded does not apply. */
bool dyd_plain_enclose(double *lo, double *hi, dyd_plain from, int64_t upper);

/* ---- any coordinate ---- */

/* How coordinates are to be understood. Owned by the reader of the file. */
typedef struct dyd_manner {
  bool measured; /* decimals are rounded measurements */
  bool widen;    /* radius > 0 */
  mpq_t radius;
  bool plain; /* decimal holds the radius */
  dyd_plain decimal;
} dyd_manner;

/* Sets the radius, q >= 0. */
void dyd_manner_set_radius(dyd_manner *m, const mpq_t q);

typedef enum dyd_coordinate_kind {
  DYD_COORDINATE_DOUBLE, /* the exact number lo = hi; plain holds it too */
  DYD_COORDINATE_BINARY, /* the exact number lo = hi; plain means nothing */
  DYD_COORDINATE_PLAIN,  /* the exact number plain, not a double */
  DYD_COORDINATE_SPAN,   /* the fixed interval from plain to upper * 10^plain.exp; lo and hi are rounded outward */
  DYD_COORDINATE_BOX,    /* the fixed interval [lo,hi] */
  DYD_COORDINATE_REAL    /* real, one reference */
} dyd_coordinate_kind;

typedef struct dyd_coordinate {
  dyd_coordinate_kind kind;
  dyd_plain plain;
  int64_t upper;
  double lo, hi;
  dyd_real *real;
} dyd_coordinate;

/* Reads one coordinate. Failures of the real later on (in refinement) report its line and column too.
 * On success a real in *out belongs to the caller. */
dyd_status dyd_coordinate_read(dyd_coordinate *out, const dyd_span *span, const dyd_manner *manner, dyd_error *err);
/* Where a radius begins, or the end of the text. */
size_t dyd_nominal_length(const dyd_span *span);
/* The exact ends, not rounded, of a coordinate that was read without a failure; equal ones of a number. manner = NULL:
 * as it is written. DYD_E_PARSE for numbers that are not rational; DYD_E_NOMEM. */
dyd_status dyd_coordinate_ends(mpq_t lo, mpq_t hi, const dyd_span *span, const dyd_manner *manner);
/* Passes on why a coordinate was refused: own counts columns from the first character of span, *err (may be NULL) from
 * that of the line. */
dyd_status dyd_coordinate_fail(dyd_error *err, dyd_status code, const dyd_span *span, const dyd_error *own);
void dyd_coordinate_clear(dyd_coordinate *c);
/* Widens by `by` >= 0, finite, on each side. A real that is taken over by a failure is gone. */
dyd_status dyd_coordinate_widen(dyd_coordinate *c, double by);
/* Turns any kind into DYD_COORDINATE_REAL. */
dyd_status dyd_coordinate_make_real(dyd_coordinate *c);

#endif
