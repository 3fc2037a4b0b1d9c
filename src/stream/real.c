/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Computable reals: a source of nested intervals and the narrowest one so far.
 *
 * [NEST-2] A built-in source encloses one and the same value every time; the intersection of two enclosures
 * encloses it too, so nestedness needs no trust. An empty intersection would disprove an enclosure: it is
 * reported as DYD_E_NESTING, never papered over. */
#include "stream/real.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/invariant.h"
#include "rect/rect.h"

/* Invariant: refs > 0; now: NULL before the first narrowing, else owned and valid; final: known and no call can narrow
 * it; spans: the value lies in span; encloses. */
struct dyd_real {
  size_t refs;
  dyd_narrow_real_fn narrow; /* NULL for values fixed from the start */
  dyd_release_fn release;
  void *user;
  bool encloses, final, spans;
  unsigned char kind; /* a dyd_real_kind, of object */
  const void *object;
  dyd_real *claim; /* NULL, or what the value is, as the caller says */
  uint64_t stage;
  size_t line, column; /* 0: no place known */
  dyd_double_span span;
  dyd_interval *now;
};

/* `more` bytes follow the real. */
static dyd_status real_new(dyd_real **out, size_t more, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user) {
  dyd_real *x = more > SIZE_MAX / 2 ? NULL : malloc(sizeof *x + more);
  if (!x) return DYD_E_NOMEM;
  *x = (dyd_real){.refs = 1, .narrow = narrow, .release = release, .user = user};
  *out = x;
  return DYD_OK;
}

dyd_status dyd_real_new(dyd_real **out, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user) {
  dyd_status st = out && narrow ? real_new(out, 0, narrow, release, user) : DYD_E_ARG;
  if (st != DYD_OK && release) release(user);
  return st;
}

dyd_status dyd_real_new_enclosing(dyd_real **out, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user) {
  dyd_status st = dyd_real_new(out, narrow, release, user);
  if (st == DYD_OK) (*out)->encloses = true;
  return st;
}

dyd_status dyd_real_new_inside(dyd_real **out, void **user, size_t size, dyd_narrow_real_fn narrow,
                               dyd_release_fn release) {
  dyd_status st = real_new(out, size, narrow, release, NULL);
  if (st != DYD_OK) return st;
  (*out)->user = *user = *out + 1;
  (*out)->encloses = true;
  return DYD_OK;
}

void dyd_real_set_span(dyd_real *x, dyd_double_span span) {
  DYD_INVARIANT(x->encloses && !x->now && span.lo <= span.hi);
  x->spans = true;
  x->span = span;
}

void *dyd_real_user(const dyd_real *x, dyd_narrow_real_fn narrow) {
  return x->narrow == narrow ? x->user : NULL;
}

void dyd_real_set_object(dyd_real *x, dyd_real_kind kind, const void *object) {
  x->kind = (unsigned char)kind;
  x->object = object;
}

dyd_real_kind dyd_real_object(const void **object, const dyd_real *x) {
  *object = x->object;
  return x->final && !dyd_interval_is_point(x->now) ? DYD_REAL_VAGUE : (dyd_real_kind)x->kind;
}

/* Makes room for an interval. */
static bool real_hold(dyd_real *x) {
  if (x->now) return true;
  x->now = dyd_alloc(1, sizeof *x->now);
  if (x->now) dyd_interval_init(x->now);
  return x->now;
}

dyd_status dyd_real_new_fixed(dyd_real **out, dyd_interval *value) {
  dyd_real *x;
  dyd_status st = real_new(&x, 0, NULL, NULL, NULL);
  if (st != DYD_OK) return st;
  if (!real_hold(x)) {
    free(x);
    return DYD_E_NOMEM;
  }
  dyd_interval_swap(x->now, value);
  x->final = true;
  DYD_INVARIANT(dyd_interval_is_valid(x->now));
  *out = x;
  return DYD_OK;
}

dyd_real *dyd_real_ref(dyd_real *x) {
  if (x) x->refs++;
  return x;
}

void dyd_real_free(dyd_real *x) {
  if (!x || --x->refs) return;
  if (x->release) x->release(x->user);
  dyd_real_free(x->claim);
  if (x->now) dyd_interval_clear(x->now);
  free(x->now);
  free(x);
}

const dyd_interval *dyd_real_interval(const dyd_real *x) {
  if (!x) return NULL;
  return x->now;
}

bool dyd_real_is_final(const dyd_real *x) {
  if (!x) return false;
  return x->final;
}

void dyd_real_place(dyd_real *x, size_t line, size_t column) {
  x->line = line;
  x->column = column;
}

/* next, made for `bits`, and the span, which comes rounded to the same grid where it is the shorter one: so all
 * intervals are inside of what a glance gave for fewer bits, and as wide as if there were no span. */
static dyd_status real_cut_to_span(dyd_interval *next, dyd_double_span span, int64_t bits, dyd_error *err) {
  dyd_interval old;
  if (bits < 0) return DYD_OK;
  dyd_filter_round(&span, span, bits);
  dyd_interval_init(&old);
  dyd_status st = dyd_interval_set_d(&old, span.lo, span.hi);
  st = st == DYD_OK ? dyd_nest(next, &old, true, "interval", err) : dyd_fail(err, st, "%s", dyd_status_text(st));
  dyd_interval_clear(&old);
  return st;
}

/* Takes `next` over if it may follow; it becomes the interval now. */
static dyd_status real_accept(dyd_real *x, dyd_interval *next, dyd_error *err) {
  dyd_status st = dyd_nest(next, x->now, x->encloses, "interval", err);
  if (st != DYD_OK) return st;
  if (!real_hold(x)) return dyd_fail_nomem(err);
  dyd_interval_swap(x->now, next);
  return DYD_OK;
}

static dyd_status real_check_claim(dyd_real *claim, const dyd_interval *now, const dyd_request *request,
                                   dyd_error *err) {
  dyd_status st = dyd_real_narrow_until(claim, request->bits, request->max_bits, request->stop, err);
  if (dyd_narrow_ended(st)) return st;
  if (dyd_interval_meets(dyd_real_interval(claim), now)) return DYD_OK;
  return dyd_fail(err, DYD_E_NESTING, "the interval does not hold the root that the value is claimed to be");
}

dyd_status dyd_real_set_claim(dyd_real *x, dyd_real *claim, dyd_error *err) {
  const dyd_request request = {.bits = 64, .max_bits = 64};
  dyd_status st = DYD_OK;
  if (x->now) st = real_check_claim(claim, x->now, &request, err);
  if (st != DYD_OK) return st;
  x->claim = claim;
  x->kind = DYD_REAL_CLAIMED;
  x->object = claim;
  return DYD_OK;
}

static dyd_status real_call_source(dyd_real *x, const dyd_request *request, dyd_error *err) {
  dyd_interval next;
  dyd_error own;
  dyd_error_clear(&own);
  dyd_interval_init(&next);
  if (x->now) dyd_interval_set(&next, x->now);
  dyd_status st = x->narrow(&next, x->user, request, &own);
  bool fixed = st == DYD_FIXED;
  if (fixed) st = DYD_OK;
  if (st == DYD_OK && x->spans) st = real_cut_to_span(&next, x->span, request->bits, &own);
  if (st == DYD_OK && x->claim) st = real_check_claim(x->claim, &next, request, &own);
  if (st == DYD_OK) st = real_accept(x, &next, &own);
  dyd_interval_clear(&next);
  if (st == DYD_CANCELLED && dyd_flag_is_set(request->stop)) return st;
  if (st == DYD_OK) {
    x->final = fixed || dyd_interval_is_point(x->now);
  } else {
    st = dyd_callback_fail(err, &own, st, DYD_NO_POINT, x->stage);
  }
  x->stage++;
  return st;
}

/* Moves an error from the coordinate's own text to its place in the file. */
static void place_error(const dyd_real *x, dyd_error *err) {
  if (!err || !x->line) return;
  err->line = x->line;
  err->column = err->column ? err->column + x->column - 1 : x->column;
}

bool dyd_real_glance(dyd_double_span *out, const dyd_real *x, int64_t bits) {
  if (x->final) return dyd_interval_get_exact_d(&out->lo, &out->hi, x->now);
  return x->spans && !x->now && dyd_filter_round(out, x->span, bits);
}

int64_t dyd_real_glance_bits(const dyd_real *x) {
  dyd_double_span exact;
  if (x->final) return dyd_interval_get_exact_d(&exact.lo, &exact.hi, x->now) ? INT64_MAX : INT64_MIN;
  return x->spans && !x->now ? dyd_filter_bits(x->span) : INT64_MIN;
}

/* Is the span so short that rounding it to the grid for `bits` very likely gives one step of it, as it does with balls?
 */
#define SPARE 16
static bool span_is_short(const dyd_real *x, int64_t bits) {
  int64_t most = dyd_filter_bits(x->span);
  return most >= SPARE && bits <= most - SPARE;
}

/* Narrows to what the span gives for `bits`. */
static dyd_status real_take_span(dyd_real *x, dyd_double_span span, dyd_error *err) {
  dyd_interval next;
  dyd_interval_init(&next);
  dyd_status st = dyd_interval_set_d(&next, span.lo, span.hi);
  st = st == DYD_OK ? real_accept(x, &next, err) : dyd_fail(err, st, "%s", dyd_status_text(st));
  dyd_interval_clear(&next);
  if (st == DYD_OK) x->final = dyd_interval_is_point(x->now);
  return st;
}

dyd_status dyd_real_narrow(dyd_real *x, int64_t bits, int64_t max_bits, dyd_error *err) {
  if (!x) return dyd_fail_null(err);
  return dyd_real_narrow_until(x, bits, max_bits, NULL, err);
}

dyd_status dyd_real_narrow_until(dyd_real *x, int64_t bits, int64_t max_bits, const volatile int *stop,
                                 dyd_error *err) {
  dyd_request request;
  dyd_double_span span;
  if (x->final) return DYD_FIXED;
  if (x->now && dyd_interval_bits(x->now) >= bits) return DYD_OK;
  dyd_status st = dyd_request_make(&request, 0, bits, max_bits, err);
  request.stop = stop;
  if (st == DYD_OK && x->spans && span_is_short(x, request.bits) && dyd_filter_round(&span, x->span, request.bits))
    st = real_take_span(x, span, err);
  else if (st == DYD_OK)
    st = real_call_source(x, &request, err);
  if (st != DYD_OK) {
    place_error(x, err);
    return st;
  }
  return x->final ? DYD_FIXED : DYD_OK;
}
