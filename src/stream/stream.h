/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Streams inside the library. */
#ifndef DYD_STREAM_STREAM_H
#define DYD_STREAM_STREAM_H

#include "base/local.h"
#include "rect/sites_table.h"
#include "stream/expr_filter.h"
#include <dyadel/stream.h>

DYD_OWNERS(dyd_stream)

/* What a stream is made of: object is a dyd_stream_pair, a dyd_stream_image, an array of three streams whose circle has
 * the point as its centre; nothing for those of which no more is known (OPAQUE). */
typedef enum dyd_stream_kind {
  DYD_STREAM_OPAQUE,
  DYD_STREAM_PAIR,
  DYD_STREAM_IMAGE,
  DYD_STREAM_CENTRE
} dyd_stream_kind;
typedef struct dyd_stream_pair {
  dyd_real *x, *y;
} dyd_stream_pair;
/* One of several summands: x becomes m[0] x + m[1] y, y becomes m[2] x + m[3] y. */
typedef struct dyd_stream_term {
  dyd_stream *of;
  mpq_t m[4];
} dyd_stream_term;
/* Invariant: 2^gain >= the sum of all |m[0]| + |m[1]|, and of all |m[2]| + |m[3]|. */
typedef struct dyd_stream_image {
  size_t count;
  dyd_stream_term *term;
  mpq_t shift[2];
  int64_t gain;
} dyd_stream_image;
/* Borrowed from s's context. New streams are opaque. */
void dyd_stream_set_object(dyd_stream *s, dyd_stream_kind kind, const void *object);
dyd_stream_kind dyd_stream_object(const void **object, const dyd_stream *s);

/* As dyd_stream_new for a source that encloses one and the same point every time: its rectangles are intersected
 * with the former ones [NEST-2]. The context is released on failure too. final: nothing can be narrowed, one call of
 * the source, at any precision, gives the final rectangle. */
dyd_status dyd_stream_new_enclosing(dyd_stream **out, const dyd_source *source, bool final);
/* A stream that is final from the start; swaps *value into it. */
dyd_status dyd_stream_new_fixed(dyd_stream **out, dyd_rect *value);
/* The same as dyd_real_glance for both sides of a point. */
bool dyd_stream_glance(dyd_double_span out[2], const dyd_stream *s, int64_t bits);
/* The greatest bits for which dyd_stream_glance succeeds; INT64_MIN when there is none. */
int64_t dyd_stream_glance_bits(const dyd_stream *s);
/* Returns true if `now`, a rectangle that s gave, is on both sides at most 2^-bits wider than it can ever be, as far as
 * that is known (dyd_real_reaches). */
bool dyd_stream_reaches(const dyd_stream *s, const dyd_rect *now, int64_t bits);
/* Replaces each side of r, a rectangle that s gave, by its core (dyd_real_core), where one is known: core[0] for x,
 * core[1] for y. narrower: r is what such a rectangle has in common with others. */
dyd_status dyd_stream_core(dyd_rect *r, bool core[2], const dyd_stream *s, bool narrower);
/* What the rectangles of s are while it is not final; ANY: radii differ, by more than what 2^-60 of them is rounded by.
 */
dyd_site_kind dyd_stream_site_kind(const dyd_stream *s);
/* As dyd_stream_narrow; stop as for dyd_real_narrow_until. */
dyd_status dyd_stream_narrow_until(dyd_stream *s, int64_t bits, int64_t max_bits, const volatile int *stop,
                                   dyd_error *err);
/* What s (NULL: none) takes in memory, and what narrowing it to 2^-bits takes for a while, by estimate. O(1), but for
 * polynomials. */
uint64_t dyd_stream_bytes(const dyd_stream *s);
uint64_t dyd_real_bytes(const dyd_real *x); /* of x alone, without operands */
uint64_t dyd_stream_work_bytes(const dyd_stream *s, int64_t bits);

/* How many times the source has been called. */
uint64_t dyd_stream_stage(const dyd_stream *s);

/* ---- What the lines of an oracle program mean. ---- */

/* "points N", or "points N cost C ... C" with N numbers above 0: *cost becomes new memory that holds them, or NULL.
 * DYD_OK, or with both unchanged: DYD_E_STREAM, DYD_E_NOMEM. */
dyd_status dyd_oracle_read_count(size_t *out, double **cost, const char *line, size_t length, dyd_error *err);
/* "I XLO XHI YLO YHI [fixed]", I checked before. known: *r comes in as the rectangle so far. *r becomes the answer,
 * rounded outward by less than 2^-64 of each width where an end is not dyadic, and cut to the rectangle so far.
 * DYD_OK, DYD_FIXED, or with *r unchanged: DYD_E_STREAM, DYD_E_NESTING (the answer is not inside; decided exactly, for
 * the ends as given), DYD_E_RANGE, DYD_E_NOMEM. */
dyd_status dyd_oracle_read_answer(dyd_rect *r, bool known, const char *line, size_t length, dyd_error *err);

#endif
