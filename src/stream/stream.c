/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Computable points: a source of nested rectangles and the narrowest one so far.
 *
 * [NEST-1] A rectangle is taken over only if it is a subset of the one before, decided exactly; the stream keeps
 * its old rectangle otherwise. Built-in combinations are intersected with the former rectangle [NEST-2]. */
#include "stream/stream.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "rect/rect.h"
#include "stream/real.h"

/* Invariant: as dyd_real, with rectangles and without span. */
struct dyd_stream {
  size_t refs;
  dyd_source source; /* source.narrow is NULL for rectangles fixed from the start */
  size_t point;
  bool encloses, final;
  unsigned char kind; /* a dyd_stream_kind, of object */
  const void *object;
  uint64_t stage;
  dyd_rect *now;
};

/* `more` bytes follow the stream. */
static dyd_status stream_new(dyd_stream **out, size_t more, const dyd_source *source, size_t point) {
  dyd_stream *s = malloc(sizeof *s + more);
  if (!s) return DYD_E_NOMEM;
  *s = (dyd_stream){.refs = 1, .source = *source, .point = point};
  *out = s;
  return DYD_OK;
}

void dyd_stream_set_object(dyd_stream *s, dyd_stream_kind kind, const void *object) {
  s->kind = (unsigned char)kind;
  s->object = object;
}

dyd_stream_kind dyd_stream_object(const void **object, const dyd_stream *s) {
  *object = s->object;
  return (dyd_stream_kind)s->kind;
}

/* Makes room for a rectangle. */
static bool stream_hold(dyd_stream *s) {
  if (s->now) return true;
  s->now = dyd_alloc(1, sizeof *s->now);
  if (s->now) dyd_rect_init(s->now);
  return s->now;
}

dyd_status dyd_stream_new(dyd_stream **out, const dyd_source *source, size_t point, dyd_error *err) {
  dyd_source s;
  dyd_status st = dyd_abi_take(&s, sizeof s, source, "dyd_source", err);
  if (st != DYD_OK) return st;
  st = out && s.narrow ? stream_new(out, 0, &s, point) : DYD_E_ARG;
  if (st != DYD_OK && s.release) s.release(s.user);
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

dyd_status dyd_stream_new_inside(dyd_stream **out, void **user, size_t size, dyd_narrow_fn narrow,
                                 dyd_release_fn release) {
  dyd_source source = {.narrow = narrow, .release = release};
  dyd_status st = stream_new(out, size, &source, DYD_NO_POINT);
  if (st != DYD_OK) return st;
  (*out)->source.user = *user = *out + 1;
  (*out)->encloses = true;
  return DYD_OK;
}

dyd_status dyd_stream_new_fixed(dyd_stream **out, dyd_rect *value) {
  dyd_stream *s;
  dyd_source none = {0};
  dyd_status st = stream_new(&s, 0, &none, DYD_NO_POINT);
  if (st != DYD_OK) return st;
  if (!stream_hold(s)) {
    free(s);
    return DYD_E_NOMEM;
  }
  dyd_rect_swap(s->now, value);
  s->final = true;
  *out = s;
  return DYD_OK;
}

static dyd_status stream_new_final(dyd_stream **out, const dyd_source *source) {
  dyd_request any = {DYD_SIZED(dyd_request)};
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = source->narrow(&r, source->user, &any, NULL);
  if (!dyd_failed(st)) st = dyd_stream_new_fixed(out, &r);
  dyd_rect_clear(&r);
  source->release(source->user);
  return st;
}

dyd_status dyd_stream_new_enclosing(dyd_stream **out, const dyd_source *source, bool final) {
  if (final) return stream_new_final(out, source);
  dyd_status st = dyd_stream_new(out, source, DYD_NO_POINT, NULL);
  if (st == DYD_OK) (*out)->encloses = true;
  return st;
}

void *dyd_stream_user(const dyd_stream *s, dyd_narrow_fn narrow) {
  return s->source.narrow == narrow ? s->source.user : NULL;
}

dyd_stream *dyd_stream_ref(dyd_stream *s) {
  if (s) s->refs++;
  return s;
}

void dyd_stream_free(dyd_stream *s) {
  if (!s || --s->refs) return;
  if (s->source.release) s->source.release(s->source.user);
  if (s->now) dyd_rect_clear(s->now);
  free(s->now);
  free(s);
}

const dyd_rect *dyd_stream_rect(const dyd_stream *s) {
  if (!s) return NULL;
  return s->now;
}

bool dyd_stream_is_final(const dyd_stream *s) {
  if (!s) return false;
  return s->final;
}

uint64_t dyd_stream_stage(const dyd_stream *s) {
  if (!s) return 0;
  return s->stage;
}

static dyd_status stream_accept(dyd_stream *s, dyd_rect *next, dyd_error *err) {
  dyd_status st = dyd_nest(&next->x, s->now ? &s->now->x : NULL, s->encloses, "x side", err);
  if (st == DYD_OK) st = dyd_nest(&next->y, s->now ? &s->now->y : NULL, s->encloses, "y side", err);
  if (st != DYD_OK) return st;
  if (!stream_hold(s)) return dyd_fail_nomem(err);
  dyd_rect_swap(s->now, next);
  return DYD_OK;
}

static dyd_status stream_call_source(dyd_stream *s, const dyd_request *request, dyd_error *err) {
  dyd_rect next;
  dyd_error own;
  dyd_error_clear(&own);
  dyd_rect_init(&next);
  if (s->now) dyd_rect_set(&next, s->now);
  dyd_status st = s->source.narrow(&next, s->source.user, request, &own);
  bool fixed = st == DYD_FIXED;
  if (fixed) st = DYD_OK;
  if (st == DYD_OK) st = stream_accept(s, &next, &own);
  dyd_rect_clear(&next);
  if (st == DYD_CANCELLED && dyd_flag_is_set(request->stop)) return st;
  if (st == DYD_OK) {
    s->final = fixed || dyd_rect_is_point(s->now);
  } else {
    st = dyd_callback_fail(err, &own, st, s->point, s->stage);
  }
  s->stage++;
  return st;
}

dyd_status dyd_stream_narrow(dyd_stream *s, int64_t bits, int64_t max_bits, dyd_error *err) {
  if (!s) return dyd_fail_null(err);
  return dyd_stream_narrow_until(s, bits, max_bits, NULL, err);
}

dyd_status dyd_stream_narrow_until(dyd_stream *s, int64_t bits, int64_t max_bits, const volatile int *stop,
                                   dyd_error *err) {
  dyd_request request;
  if (s->final) return DYD_FIXED;
  if (s->now && dyd_rect_bits(s->now) >= bits) return DYD_OK;
  dyd_status st = dyd_request_make(&request, s->point == DYD_NO_POINT ? 0 : s->point, bits, max_bits, err);
  request.stop = stop;
  if (st == DYD_OK) st = stream_call_source(s, &request, err);
  if (st != DYD_OK) return st;
  return s->final ? DYD_FIXED : DYD_OK;
}
