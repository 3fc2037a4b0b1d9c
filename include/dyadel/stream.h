/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Computable points and reals: lazy streams of nested rectangles and intervals.
 *
 * Threads: a stream or real is used by one thread at a time; two threads may use two streams at once unless
 * the streams share a part (an affine image and its preimage share the preimage). Callbacks are called from
 * the thread that narrows, never concurrently for one source. Reals and streams may move between threads.
 *
 * Memory: expressions and roots compute with FLINT and Arb, which keep caches (constants, free numbers) for each
 * thread. No real needs them between calls; users of leak checkers, and threads that end, call flint_cleanup() of
 * <flint/flint.h> in every thread that narrowed such reals.
 *
 * Ownership: streams and reals are counted. A constructor that takes another stream or real takes over one
 * reference (also when it fails); call dyd_stream_ref first to keep one. */
#ifndef DYADEL_STREAM_H
#define DYADEL_STREAM_H

#include <dyadel/rect.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a callback is asked: narrow point `point` so that both widths are about 2^-bits or less.
 * max_bits is the precision at which the caller would give up: working precision beyond about
 * max_bits + 64 is wasted (a function undefined up to there should return DYD_E_DOMAIN). */
typedef struct dyd_request {
  size_t struct_size; /* set by the library */
  size_t point;
  int64_t bits;
  int64_t max_bits;
  /* NULL, or a flag that becomes not 0 when the answer is no longer wanted (the run was cancelled, or its time is
   * over): a callback that may take long reads it atomically now and then, and then returns DYD_CANCELLED. */
  const volatile int *stop;
} dyd_request;

/* The callback of the library.
 * out    in: the rectangle known so far; at stage 0 it is unset: its lower ends are above its upper ones;
 *        out: a rectangle inside it; DYD_E_STREAM where a side is still unset. Initialised and owned by the caller.
 * Returns DYD_OK; DYD_FIXED when this rectangle is final; DYD_CANCELLED when request->stop was seen; < 0 with *err
 * filled (message at least).
 * A wider rectangle than asked is allowed, a rectangle not inside the previous one is a nesting error. */
typedef dyd_status (*dyd_narrow_fn)(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err);
typedef dyd_status (*dyd_narrow_real_fn)(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err);
typedef void (*dyd_release_fn)(void *user);
/* Prefetch hint: lists the requests of the coming stage in order, so that a slow source can answer them in parallel;
 * narrow then collects the answers one by one. The hint may be ignored, and narrow may be called for fewer of them, or
 * for others. Each list replaces the one before. Its elements are read by dyd_request_at; borrowed for the call. */
typedef void (*dyd_announce_fn)(void *user, const dyd_request *request, size_t count);
/* Element k of such a list. The distance of elements is the struct_size of the library that made the list. */
static inline const dyd_request *dyd_request_at(const dyd_request *request, size_t k) {
  return (const dyd_request *)(const void *)((const char *)request + k * request->struct_size);
}

/* For callbacks in languages that cannot fill in a dyd_rect: *r, as narrow was given it, becomes the answer that the
 * text "XLO XHI YLO YHI" or "XLO XHI YLO YHI fixed" gives, four plain numbers (decimal, rational, hexadecimal, dyadic),
 * exactly. The result (DYD_OK, DYD_FIXED, or an error with *r as it was) is for the callback to return. */
DYD_API dyd_status dyd_rect_narrow_text(dyd_rect *r, const char *text, size_t length, dyd_error *err);
/* The same from canonical rationals: x lower, x upper, y lower, y upper. */
DYD_API dyd_status dyd_rect_narrow_q(dyd_rect *r, const mpq_t end[4], dyd_error *err);

/* A callback with its context, begun with DYD_SIZED. release may be NULL; it is called exactly once, when nothing uses
 * user any more: also when the constructor that was given it fails, unless it has no size. announce may be NULL; only
 * engines call it, for sources added to them. cost may be NULL: all cost 1.
 */
typedef struct dyd_source {
  size_t struct_size; /* set by DYD_SIZED */
  dyd_narrow_fn narrow;
  dyd_release_fn release;
  void *user;
  dyd_announce_fn announce;
  /* Cost of asking each of its points again, above 0 (DYD_ROW_COST of io.h): the adaptive schedule asks cheap
   * ones before expensive ones. Borrowed, and read by the call that adds the source to an engine only. */
  const double *cost;
} dyd_source;

/* ---- reals ---- */

/* A computable real: a source of nested intervals and the narrowest one so far. */
typedef struct dyd_real dyd_real;

/* All constructors: *out is new, with one reference, released by dyd_real_free. err may be NULL everywhere.
 * dyd_real_new calls release when it fails; its requests name point 0. */
DYD_API dyd_status dyd_real_new(dyd_real **out, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user);
/* The fixed interval [lo,hi], exactly. lo = hi is the exact point. */
DYD_API dyd_status dyd_real_from_interval(dyd_real **out, const mpq_t lo, const mpq_t hi);
/* Every coordinate form of the points file: decimal, rational, hexadecimal float, dyadic, degrees with minutes and
 * seconds (47°36'18.3"N, N47.605, 47:36:18.3), [lo,hi], value+-radius, expression, root(polynomial,lo,hi). And, for
 * experiments, random(seed), the number in [0,1] whose binary digits a whole number below 2^64 draws, exactly 2^-bits
 * wide; slow(expression), of which answer n is at most 1/n wide, whatever number of bits a request has. On DYD_E_PARSE
 * err has the column (from 1). */
DYD_API dyd_status dyd_real_parse(dyd_real **out, const char *text, size_t length, dyd_error *err);
/* The interval [value - radius, value + radius] around any real, at every precision; takes over x. */
DYD_API dyd_status dyd_real_widen(dyd_real **out, dyd_real *x, const mpq_t radius);
/* The root in [lo,hi] of the polynomial sum coeff[k] x^k, degree = count - 1, that has opposite signs at lo and hi. */
DYD_API dyd_status dyd_real_root(dyd_real **out, const mpq_t *coeff, size_t count, const mpq_t lo, const mpq_t hi,
                                 dyd_error *err);
/* Operations on reals. The first six have two operands. */
typedef enum dyd_real_operation {
  DYD_REAL_ADD,
  DYD_REAL_SUB,
  DYD_REAL_MUL,
  DYD_REAL_DIV,
  DYD_REAL_MIN,
  DYD_REAL_MAX,
  DYD_REAL_NEG,
  DYD_REAL_ABS,
  DYD_REAL_SQRT,
  DYD_REAL_CBRT,
  DYD_REAL_EXP,
  DYD_REAL_LOG,
  DYD_REAL_SIN,
  DYD_REAL_COS,
  DYD_REAL_TAN,
  DYD_REAL_ASIN,
  DYD_REAL_ACOS,
  DYD_REAL_ATAN,
  DYD_REAL_SINH,
  DYD_REAL_COSH,
  DYD_REAL_TANH
} dyd_real_operation;
/* x op y, or op of x where y is NULL. Takes over both references, also on failure; x and y may be the same real (two
 * references). The operands are narrowed as far as the value asks for. What the value is made of is known: where ties
 * are proved, a real made by dyd_real_new is a variable, the same real the same one, so that (a + b)^2 is a^2 + 2 a b +
 * b^2 whatever the callbacks a and b give. DYD_E_ARG for a wrong number of operands; DYD_E_DOMAIN, DYD_E_RANGE where
 * all operands are exact and the value does not exist, or is too large (else the narrowing says so); DYD_E_RANGE for
 * more than 1,000 operations above one another. */
DYD_API dyd_status dyd_real_op(dyd_real **out, dyd_real *x, dyd_real *y, dyd_real_operation op, dyd_error *err);
/* The caller asserts that x, whose callback is opaque, is the one root in [lo,hi] of the polynomial sum
 * coeff[k] x^k, which has opposite signs at lo and hi. Ties are proved on that ground from now on, and certificates
 * name it. From now on every interval of x has to hold the root: DYD_E_NESTING where one does not, now or when x is
 * narrowed. DYD_E_ARG for a polynomial without such a root or with several in [lo,hi], for a real that is no
 * dyd_real_new, and for a second claim. x stays as it was on failure. */
DYD_API dyd_status dyd_real_claim_root(dyd_real *x, const mpq_t *coeff, size_t count, const mpq_t lo, const mpq_t hi,
                                       dyd_error *err);
/* The exact value of a number in one of the forms (dyd_number_form); out, initialised by the caller, becomes canonical,
 * and is unchanged on failure. DYD_E_PARSE, DYD_E_DOMAIN (denominator 0), DYD_E_RANGE or DYD_E_NOMEM with column and
 * message in *err, which may be NULL. Numbers of up to 18 digits and small exponents need no memory beyond that of out.
 */
DYD_API dyd_status dyd_parse_number(mpq_t out, const char *text, size_t length, unsigned forms, dyd_error *err);
/* The exact value of a text that dyd_real_parse takes, where that is a rational number; else DYD_E_PARSE. */
DYD_API dyd_status dyd_real_parse_exact(mpq_t out, const char *text, size_t length);
DYD_API dyd_real *dyd_real_ref(dyd_real *x);
DYD_API void dyd_real_free(dyd_real *x);
/* Narrows to about 2^-bits; nestedness is checked. DYD_OK, DYD_FIXED or an error. */
DYD_API dyd_status dyd_real_narrow(dyd_real *x, int64_t bits, int64_t max_bits, dyd_error *err);
/* The narrowest interval so far; borrowed until the next call on x; NULL before the first narrowing, except for
 * exact and fixed reals, which know theirs from the start. */
DYD_API const dyd_interval *dyd_real_interval(const dyd_real *x);
DYD_API bool dyd_real_is_final(const dyd_real *x);

/* ---- points ---- */

typedef struct dyd_stream dyd_stream;

/* Point number `point` of a source; the source is copied, release is called when the stream is freed. */
DYD_API dyd_status dyd_stream_new(dyd_stream **out, const dyd_source *source, size_t point, dyd_error *err);
/* The fixed rectangle r (an exact point if r is a singleton). Copied. */
DYD_API dyd_status dyd_stream_from_rect(dyd_stream **out, const dyd_rect *r);
/* The point (x, y); takes over both references, also on failure. x and y may be the same real (two references). */
DYD_API dyd_status dyd_stream_from_reals(dyd_stream **out, dyd_real *x, dyd_real *y);
/* The image (m[0] x + m[1] y + m[2], m[3] x + m[4] y + m[5]); takes over `of`; m is copied.
 * An exact point has an exact image. */
DYD_API dyd_status dyd_stream_affine(dyd_stream **out, dyd_stream *of, const mpq_t m[6]);
DYD_API dyd_stream *dyd_stream_ref(dyd_stream *s);
DYD_API void dyd_stream_free(dyd_stream *s);
/* Narrows until both widths are about 2^-bits or less. Checks that the new rectangle is inside the old one
 * [NEST-1]; otherwise DYD_E_NESTING, err names point and stage, and the stream keeps its old rectangle.
 * A failed stream keeps its rectangle too. Does nothing when the rectangle is already narrow enough or final. */
DYD_API dyd_status dyd_stream_narrow(dyd_stream *s, int64_t bits, int64_t max_bits, dyd_error *err);
/* The narrowest rectangle so far; borrowed until the next call on s; NULL before the first narrowing, except for
 * fixed streams. */
DYD_API const dyd_rect *dyd_stream_rect(const dyd_stream *s);
/* Returns true if no call can narrow it further. */
DYD_API bool dyd_stream_is_final(const dyd_stream *s);

#ifdef __cplusplus
}
#endif
#endif
