/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Computable reals inside the library: built-in sources, places in a text, fixed intervals. */
#ifndef DYD_STREAM_REAL_H
#define DYD_STREAM_REAL_H

#include "base/local.h"
#include "rect/rect.h"
#include "stream/span_filter.h"
#include <dyadel/stream.h>

DYD_OWNERS(dyd_real)

/* As dyd_real_new for a source that encloses one and the same value every time: its intervals are intersected with
 * the former ones, so that they are nested by construction [NEST-2]. Takes over user, also on failure. */
dyd_status dyd_real_new_enclosing(dyd_real **out, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user);
/* The same with a context of `size` bytes in one block with the real; *user is where. release, which may be NULL, must
 * not free it. Only a success calls it, when the real goes. */
dyd_status dyd_real_new_inside(dyd_real **out, void **user, size_t size, dyd_narrow_real_fn narrow,
                               dyd_release_fn release);
/* From now on x is known to lie in `span`, from which coarse intervals are made without a call of the source. For a
 * source that encloses one and the same value, before it is narrowed. */
void dyd_real_set_span(dyd_real *x, dyd_double_span span);
/* Where doubles hold an interval of at most 2^-bits about x, which was not narrowed before, that interval; x is not
 * changed, and its later intervals lie in that interval. */
bool dyd_real_glance(dyd_double_span *out, const dyd_real *x, int64_t bits);
/* The greatest bits for which dyd_real_glance succeeds; INT64_MIN when there is none, INT64_MAX for exact doubles. */
int64_t dyd_real_glance_bits(const dyd_real *x);
/* What a real is made of: object is a dyd_expr, a dyd_root, the dyd_real that it is claimed to be; nothing for those of
 * which no more is known than that they are one number each (OPAQUE), or not even that (VAGUE: an interval). */
typedef enum dyd_real_kind {
  DYD_REAL_OPAQUE,
  DYD_REAL_VAGUE,
  DYD_REAL_EXPR,
  DYD_REAL_ROOT,
  DYD_REAL_CLAIMED
} dyd_real_kind;
/* Borrowed from x's context. New reals are opaque, fixed ones that are no points vague. */
void dyd_real_set_object(dyd_real *x, dyd_real_kind kind, const void *object);
dyd_real_kind dyd_real_object(const void **object, const dyd_real *x);
/* x, opaque, is the value of `claim`, as the caller says, which it takes over unless it fails: DYD_E_NESTING where the
 * interval of x does not hold it. */
dyd_status dyd_real_set_claim(dyd_real *x, dyd_real *claim, dyd_error *err);
/* The value of the expression that was parsed into d, which is left without constants and roots. */
struct dyd_draft;
dyd_status dyd_real_new_expr(dyd_real **out, struct dyd_draft *d);
/* From now on errors of x have this line, and their columns count from `column` on: the place in a file of the
 * text that x was parsed from. */
void dyd_real_place(dyd_real *x, size_t line, size_t column);

/* As dyd_real_narrow, with a flag that callbacks find in their requests (NULL: none): DYD_CANCELLED where one has seen
 * it; x stays as it was then. */
dyd_status dyd_real_narrow_until(dyd_real *x, int64_t bits, int64_t max_bits, const volatile int *stop, dyd_error *err);
/* Did a narrowing end without an interval or rectangle? */
static inline bool dyd_narrow_ended(dyd_status st) {
  return st < 0 || st == DYD_CANCELLED;
}
/* The context of x if `narrow` is its callback, else NULL. Borrowed. */
void *dyd_real_user(const dyd_real *x, dyd_narrow_real_fn narrow);
/* Returns true if `now`, an interval that x gave, is at most 2^-bits wider than x can ever be (known for final and for
 * widened reals; of others: than a point). */
bool dyd_real_reaches(const dyd_real *x, const dyd_interval *now, int64_t bits);
/* Sets radius to the sum of the radii around x; of a final real to half of its width. */
void dyd_real_radius(mpq_t radius, const dyd_real *x);
/* Returns what the radii are around, borrowed: x itself where it has none, or is final. */
const dyd_real *dyd_real_centre(const dyd_real *x);
/* Sets *core to an interval that every interval which x gives from now on contains [SET-3], and *has. Final reals and
 * reals widened by a radius have a core; for others *has is false. now: an interval that contains all that x gives from
 * now on (NULL: not known; out = now is allowed). */
dyd_status dyd_real_core(dyd_interval *core, bool *has, const dyd_real *x, const dyd_interval *now);

/* DYD_E_NESTING with both intervals in short; side is "x side", "y side" or "interval". */
dyd_status dyd_nesting_fail(dyd_error *err, const char *side, const dyd_interval *old, const dyd_interval *now);

/* DYD_E_STREAM if a callback left the sides that it was given unset. point: for the message; stage: of the call. */
dyd_status dyd_rect_check_set(const dyd_rect *r, size_t point, uint64_t stage, dyd_error *err);
/* Checks that next may follow old (NULL: it is the first one). Where the source encloses one value it is cut to old
 * [NEST-2], else it has to be inside of it. side as above. */
dyd_status dyd_nest(dyd_interval *next, const dyd_interval *old, bool encloses, const char *side, dyd_error *err);

/* The number of bits of narrowing a callback asks for, made safe: bits beyond the exponent range are refused. */
dyd_status dyd_request_make(dyd_request *out, size_t point, int64_t bits, int64_t max_bits, dyd_error *err);
/* Makes the record of a failed callback complete: known code, a message, point and stage. Copies it to *err. */
dyd_status dyd_callback_fail(dyd_error *err, const dyd_error *own, dyd_status st, size_t point, uint64_t stage);

/* The same where the text is an exact number, [lo,hi] or value+-radius, or an expression whose value is rational: out
 * becomes the number, or the interval, rounded as dyd_real_from_interval says. DYD_E_PARSE for other expressions. */
dyd_status dyd_interval_set_text(dyd_interval *out, const char *text, size_t length, dyd_error *err);

/* dyd_real_from_interval of [q,q]. */
dyd_status dyd_real_from_q(dyd_real **out, const mpq_t q);

#endif
