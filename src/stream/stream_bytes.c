/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Estimates of what streams take in memory. Operands made by dyd_real_op count by themselves, not for what they are
 * made of in turn, which others may use as well. */
#include "base/room.h"
#include "rect/rect.h"
#include "stream/expr.h"
#include "stream/real.h"
#include "stream/root.h"
#include "stream/stream.h"

/* Of a stream or real by itself, with what allocators add. */
enum { RECORD = 192, NUMBER = 48 };

static uint64_t bytes_of_number(mpz_srcptr z) {
  return NUMBER + mpz_size(z) * sizeof(mp_limb_t);
}

static uint64_t bytes_of_interval(const dyd_interval *x) {
  return x ? bytes_of_number(x->lo.man) + bytes_of_number(x->hi.man) + bytes_of_number(x->den) : 0;
}

static uint64_t bytes_of_root(const dyd_root *r) {
  uint64_t bytes = sizeof *r + bytes_of_number(r->slot);
  for (size_t k = 0; k < r->count; k++) bytes += bytes_of_number(r->coeff[k]);
  return bytes;
}

static uint64_t bytes_of_real(const dyd_real *x) {
  const void *object;
  uint64_t bytes = RECORD + bytes_of_interval(dyd_real_interval(x));
  dyd_real_kind kind = dyd_real_object(&object, x);
  if (kind == DYD_REAL_EXPR) bytes += dyd_expr_size(object) + ((const dyd_expr *)object)->roots * (uint64_t)RECORD;
  return kind == DYD_REAL_ROOT ? bytes + bytes_of_root(object) : bytes;
}

uint64_t dyd_stream_bytes(const dyd_stream *s) {
  const void *object;
  if (!s) return 0;
  const dyd_rect *now = dyd_stream_rect(s);
  uint64_t bytes = RECORD + (now ? bytes_of_interval(&now->x) + bytes_of_interval(&now->y) : 0);
  if (dyd_stream_object(&object, s) != DYD_STREAM_PAIR) return bytes;
  const dyd_stream_pair *pair = object;
  return bytes + bytes_of_real(pair->x) + (pair->y == pair->x ? 0 : bytes_of_real(pair->y));
}

/* Numbers of as many digits as the value has: those of all nodes, and what a function computes with: powers, constants,
 * sums by splitting. */
static uint64_t numbers_at_work(const dyd_real *x) {
  enum { OTHERS = 8, FUNCTION = 36 };
  const void *object;
  switch (dyd_real_object(&object, x)) {
  case DYD_REAL_EXPR:
    return FUNCTION + 2 * ((const dyd_expr *)object)->count;
  case DYD_REAL_ROOT:
    return FUNCTION + 2 * ((const dyd_root *)object)->count;
  default:
    return OTHERS;
  }
}

uint64_t dyd_stream_work_bytes(const dyd_stream *s, int64_t bits) {
  const void *object;
  if (bits <= 0 || !s || dyd_stream_object(&object, s) != DYD_STREAM_PAIR) return 0;
  const dyd_stream_pair *pair = object;
  uint64_t x = numbers_at_work(pair->x), y = numbers_at_work(pair->y);
  return dyd_bytes_times(x > y ? x : y, (uint64_t)bits / 8);
}
