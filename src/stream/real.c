/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Computable reals: a source of nested intervals and the narrowest one so far.
 *
 * [NEST-2] A built-in source encloses one and the same value every time; the intersection of two enclosures
 * encloses it too, so nestedness needs no trust. An empty intersection would disprove an enclosure: it is
 * reported as DYD_E_NESTING, never papered over. */
#include "stream/real.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/verify.h"
#include "rect/interval.h"

/* Invariant: refs > 0; known: `now` holds an interval, valid; final: known and no call can narrow it. */
struct dyd_real {
  size_t refs;
  dyd_narrow_real_fn narrow; /* NULL for values fixed from the start */
  dyd_release_fn release;
  void *user;
  bool encloses, known, final;
  uint64_t stage;
  size_t line, column; /* 0: no place known */
  dyd_interval now;
};

static dyd_status real_new(dyd_real **out, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user) {
  dyd_real *x = dyd_alloc(1, sizeof *x);
  if (!x) return DYD_E_NOMEM;
  *x = (dyd_real){.refs = 1, .narrow = narrow, .release = release, .user = user};
  dyd_interval_init(&x->now);
  *out = x;
  return DYD_OK;
}

dyd_status dyd_real_new(dyd_real **out, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user) {
  dyd_status st = out && narrow ? real_new(out, narrow, release, user) : DYD_E_ARG;
  if (st && release) release(user);
  return st;
}

dyd_status dyd_real_new_enclosing(dyd_real **out, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user) {
  dyd_status st = dyd_real_new(out, narrow, release, user);
  if (!st) (*out)->encloses = true;
  return st;
}

dyd_status dyd_real_new_fixed(dyd_real **out, dyd_interval *value) {
  dyd_real *x;
  dyd_status st = real_new(&x, NULL, NULL, NULL);
  if (st) return st;
  dyd_interval_swap(&x->now, value);
  x->known = x->final = true;
  DYD_CHECK(dyd_interval_is_valid(&x->now));
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
  dyd_interval_clear(&x->now);
  free(x);
}

const dyd_interval *dyd_real_interval(const dyd_real *x) {
  return x->known ? &x->now : NULL;
}

bool dyd_real_is_final(const dyd_real *x) {
  return x->final;
}

void dyd_real_place(dyd_real *x, size_t line, size_t column) {
  x->line = line;
  x->column = column;
}

/* Takes `next` over if it may follow; it becomes the interval now. */
static dyd_status accept(dyd_real *x, dyd_interval *next, dyd_error *err) {
  if (!dyd_interval_is_valid(next)) {
    return dyd_fail(err, DYD_E_STREAM, "the callback gave no valid interval; fill it with dyd_interval_set_ends");
  }
  if (x->known && x->encloses) {
    dyd_status st = dyd_interval_intersect(next, &x->now, next);
    if (st == DYD_E_ARG) return dyd_nesting_fail(err, "interval", &x->now, next);
    if (st) return dyd_fail(err, st, "%s", dyd_status_text(st));
  } else if (x->known && !dyd_interval_contains(&x->now, next)) {
    return dyd_nesting_fail(err, "interval", &x->now, next);
  }
  dyd_interval_swap(&x->now, next);
  x->known = true;
  return DYD_OK;
}

static dyd_status call_source(dyd_real *x, const dyd_request *request, dyd_error *err) {
  dyd_interval next;
  dyd_error own;
  dyd_error_clear(&own);
  dyd_interval_init(&next);
  if (x->known) dyd_interval_set(&next, &x->now);
  dyd_status st = x->narrow(&next, x->user, request, &own);
  bool fixed = st == DYD_FIXED;
  if (!st || fixed) st = accept(x, &next, &own);
  dyd_interval_clear(&next);
  if (!st) {
    x->final = fixed || dyd_interval_is_point(&x->now);
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

dyd_status dyd_real_narrow(dyd_real *x, int64_t bits, int64_t max_bits, dyd_error *err) {
  dyd_request request;
  if (x->final) return DYD_FIXED;
  if (x->known && dyd_interval_bits(&x->now) >= bits) return DYD_OK;
  dyd_status st = dyd_request_make(&request, 0, bits, max_bits, err);
  if (!st) st = call_source(x, &request, err);
  if (st) {
    place_error(x, err);
    return st;
  }
  return x->final ? DYD_FIXED : DYD_OK;
}
