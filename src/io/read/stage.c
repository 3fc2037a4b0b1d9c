/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points read but not yet given to the engine: kept back so that bad input adds nothing. */
#include "io/read/stage.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "engine/add.h"
#include "stream/stream.h"

#include <string.h>

/* A point takes the most special kind of its coordinates; doubles fit all kinds. */
struct dyd_staged {
  int16_t kind;   /* a dyd_coordinate_kind */
  int16_t exp[2]; /* PLAIN, SPAN */
  union {
    double box[4];  /* DOUBLE: x, y. BOX: x0, x1, y0, y1 */
    int64_t man[4]; /* PLAIN: x, y. SPAN: x0, x1, y0, y1 */
    dyd_real *real[2];
  } u;
};

static void staged_drop(dyd_staged *p) {
  if (p->kind != DYD_COORDINATE_REAL) return;
  dyd_real_free(p->u.real[0]);
  dyd_real_free(p->u.real[1]);
  p->kind = DYD_COORDINATE_DOUBLE;
}

/* Points in a piece: one of full length is in large pages, and none is copied. In the armed build few points need
 * several. */
#ifdef DYD_ARMED
enum { PIECE = 16 };
#else
enum { PIECE = 1 << 17 };
#endif

static dyd_staged *staged_at(const dyd_stage *s, size_t k) {
  return &s->piece[k / PIECE][k % PIECE];
}

void dyd_stage_clear(dyd_stage *s) {
  for (size_t k = 0; k < s->count; k++) staged_drop(staged_at(s, k));
  for (size_t k = 0; k < s->pieces; k++) free(s->piece[k]);
  free(s->piece);
  *s = (dyd_stage){0};
}

/* Room for one more point: the first piece grows, so that few points take little. */
static bool stage_make_room(dyd_stage *s) {
  size_t k = s->count / PIECE;
  if (k == s->pieces) {
    if (!DYD_GROW(s->piece, s->piece_cap, k + 1)) return false;
    s->piece[k] = k ? dyd_alloc(PIECE, sizeof **s->piece) : NULL;
    if (k && !s->piece[k]) return false;
    s->pieces++;
  }
  return k || dyd_reserve((void **)&s->piece[0], &s->first_cap, s->count + 1, sizeof **s->piece);
}

static bool is_decimal(dyd_coordinate_kind k) {
  return k == DYD_COORDINATE_PLAIN || k == DYD_COORDINATE_SPAN;
}

/* BINARY counts as DOUBLE, unless the other coordinate is decimal. */
static dyd_coordinate_kind staged_kind(dyd_coordinate_kind a, dyd_coordinate_kind b) {
  if (a == DYD_COORDINATE_BINARY && !is_decimal(b)) a = DYD_COORDINATE_DOUBLE;
  if (b == DYD_COORDINATE_BINARY && !is_decimal(a)) b = DYD_COORDINATE_DOUBLE;
  if (a == b) return a;
  if (is_decimal(a) && is_decimal(b)) return DYD_COORDINATE_SPAN;
  if (a == DYD_COORDINATE_DOUBLE && b != DYD_COORDINATE_REAL) return b;
  if (b == DYD_COORDINATE_DOUBLE && a != DYD_COORDINATE_REAL) return a;
  return DYD_COORDINATE_REAL;
}

/* Of doubles where they hold all ends. */
static void staged_join_spans(dyd_staged *out, const dyd_coordinate *x, const dyd_coordinate *y) {
  double box[4];
  bool doubles = true;
  for (int k = 0; k < 4; k++) {
    const dyd_coordinate *c = k / 2 ? y : x;
    out->u.man[k] = k % 2 && c->kind == DYD_COORDINATE_SPAN ? c->upper : c->plain.man;
    out->exp[k / 2] = (int16_t)c->plain.exp;
    doubles = doubles && dyd_plain_get_exact(&box[k], (dyd_plain){out->u.man[k], c->plain.exp});
  }
  if (!doubles) return;
  out->kind = DYD_COORDINATE_BOX;
  memcpy(out->u.box, box, sizeof box);
}

static void staged_join(dyd_staged *out, dyd_coordinate_kind kind, const dyd_coordinate *x, const dyd_coordinate *y) {
  *out = (dyd_staged){.kind = (int16_t)kind};
  switch (kind) {
  case DYD_COORDINATE_DOUBLE:
  case DYD_COORDINATE_BINARY:
    out->u.box[0] = x->lo, out->u.box[1] = y->lo;
    break;
  case DYD_COORDINATE_BOX:
    out->u.box[0] = x->lo, out->u.box[1] = x->hi, out->u.box[2] = y->lo, out->u.box[3] = y->hi;
    break;
  case DYD_COORDINATE_PLAIN:
    out->u.man[0] = x->plain.man, out->u.man[1] = y->plain.man;
    out->exp[0] = (int16_t)x->plain.exp, out->exp[1] = (int16_t)y->plain.exp; /* at most 60 */
    break;
  case DYD_COORDINATE_SPAN:
    staged_join_spans(out, x, y);
    break;
  case DYD_COORDINATE_REAL:
    out->u.real[0] = x->real, out->u.real[1] = y->real;
    break;
  }
}

/* Bytes of a point, here and in the table of sites: its ends, and a number that no double holds. */
static uint64_t staged_bytes(const dyd_staged *p) {
  enum { END = sizeof(double), RECORD = 64 };
  uint64_t bytes = sizeof *p + (p->kind == DYD_COORDINATE_DOUBLE ? 2 : 4) * END;
  if (p->kind == DYD_COORDINATE_PLAIN) bytes += sizeof(uint32_t) + sizeof(dyd_word_point);
  if (p->kind == DYD_COORDINATE_SPAN) bytes += END + RECORD;
  if (p->kind == DYD_COORDINATE_REAL) bytes += RECORD + dyd_real_bytes(p->u.real[0]) + dyd_real_bytes(p->u.real[1]);
  return bytes;
}

/* *out becomes the point; takes over reals, also on failure, and leaves both coordinates empty. */
static dyd_status staged_put(dyd_staged *out, dyd_coordinate *x, dyd_coordinate *y, dyd_error *err) {
  dyd_status st = DYD_OK;
  dyd_coordinate_kind kind = staged_kind(x->kind, y->kind);
  if (kind == DYD_COORDINATE_REAL) st = dyd_coordinate_make_real(x);
  if (st == DYD_OK && kind == DYD_COORDINATE_REAL) st = dyd_coordinate_make_real(y);
  if (st != DYD_OK) {
    dyd_coordinate_clear(x);
    dyd_coordinate_clear(y);
    return dyd_fail(err, st, "%s", dyd_status_text(st));
  }
  staged_join(out, kind, x, y);
  x->kind = y->kind = DYD_COORDINATE_DOUBLE;
  return DYD_OK;
}

/* Puts a point in place k, which is empty. */
static dyd_status stage_put(dyd_stage *s, size_t k, dyd_coordinate *x, dyd_coordinate *y, dyd_error *err) {
  dyd_status st = staged_put(staged_at(s, k), x, y, err);
  if (st == DYD_OK) s->bytes += staged_bytes(staged_at(s, k));
  return st;
}

dyd_status dyd_stage_add(dyd_stage *s, dyd_coordinate *x, dyd_coordinate *y, dyd_error *err) {
  if (!stage_make_room(s)) {
    dyd_coordinate_clear(x);
    dyd_coordinate_clear(y);
    return dyd_fail_nomem(err);
  }
  dyd_status st = stage_put(s, s->count, x, y, err);
  s->count += st == DYD_OK;
  return st;
}

/* The coordinates of point k, which is empty afterwards: the inverse of stage_put. */
static void stage_split(dyd_coordinate *x, dyd_coordinate *y, dyd_stage *s, size_t k) {
  dyd_coordinate *c[2] = {x, y};
  dyd_staged *p = staged_at(s, k);
  s->bytes -= staged_bytes(p);
  for (int a = 0; a < 2; a++) {
    *c[a] = (dyd_coordinate){.kind = (dyd_coordinate_kind)p->kind};
    if (p->kind == DYD_COORDINATE_BOX)
      c[a]->lo = p->u.box[2 * a], c[a]->hi = p->u.box[2 * a + 1];
    else if (p->kind == DYD_COORDINATE_PLAIN)
      c[a]->plain = (dyd_plain){p->u.man[a], p->exp[a]};
    else if (p->kind == DYD_COORDINATE_SPAN)
      c[a]->plain = (dyd_plain){p->u.man[2 * a], p->exp[a]}, c[a]->upper = p->u.man[2 * a + 1];
    else if (p->kind == DYD_COORDINATE_REAL)
      c[a]->real = p->u.real[a];
    else
      *c[a] = (dyd_coordinate){.kind = DYD_COORDINATE_BINARY, .lo = p->u.box[a], .hi = p->u.box[a]};
  }
  p->kind = DYD_COORDINATE_DOUBLE;
}

static void swap_coordinates(dyd_coordinate *a, dyd_coordinate *b) {
  dyd_coordinate c = *a;
  *a = *b;
  *b = c;
}

dyd_status dyd_stage_replace(dyd_stage *s, size_t k, dyd_coordinate *x, dyd_coordinate *y, const bool take[2],
                             dyd_error *err) {
  dyd_coordinate old[2];
  stage_split(&old[0], &old[1], s, k);
  if (take[0]) swap_coordinates(&old[0], x);
  if (take[1]) swap_coordinates(&old[1], y);
  dyd_coordinate_clear(x);
  dyd_coordinate_clear(y);
  return stage_put(s, k, &old[0], &old[1], err);
}

dyd_status dyd_stage_widen(dyd_stage *s, size_t k, const double by[2], dyd_error *err) {
  dyd_coordinate c[2];
  dyd_status st = DYD_OK;
  stage_split(&c[0], &c[1], s, k);
  for (int a = 0; a < 2 && st == DYD_OK; a++) st = dyd_coordinate_widen(&c[a], by[a]);
  if (st == DYD_OK) return stage_put(s, k, &c[0], &c[1], err);
  for (int a = 0; a < 2; a++) dyd_coordinate_clear(&c[a]);
  return dyd_fail(err, st, "%s", dyd_status_text(st));
}

enum { BULK = 1024 };

/* Point k, if it is there and of that kind. */
static const dyd_staged *staged_if(const dyd_stage *s, size_t k, dyd_coordinate_kind kind) {
  const dyd_staged *p = k < s->count ? staged_at(s, k) : NULL;
  return p && p->kind == (int16_t)kind ? p : NULL;
}

/* The points from `first` on that are of the given kind, at most BULK; *count: the number added. */
static dyd_status commit_points(size_t *count, dyd_engine *e, const dyd_stage *s, size_t first, dyd_error *err) {
  const dyd_staged *p;
  double x[BULK], y[BULK];
  size_t n = 0;
  for (; n < BULK && (p = staged_if(s, first + n, DYD_COORDINATE_DOUBLE)); n++) {
    x[n] = p->u.box[0];
    y[n] = p->u.box[1];
  }
  *count = n;
  return dyd_engine_add_points(e, n, x, y, err);
}

static dyd_status commit_boxes(size_t *count, dyd_engine *e, const dyd_stage *s, size_t first, dyd_error *err) {
  const dyd_staged *p;
  double end[4][BULK];
  size_t n = 0;
  for (; n < BULK && (p = staged_if(s, first + n, DYD_COORDINATE_BOX)); n++)
    for (int k = 0; k < 4; k++) end[k][n] = p->u.box[k];
  *count = n;
  return dyd_engine_add_boxes(e, n, end[0], end[1], end[2], end[3], err);
}

/* The decimal of PLAIN, or one of the four ends of SPAN: in their order. */
static dyd_plain plain_of(const dyd_staged *p, int k) {
  return (dyd_plain){p->u.man[k], p->exp[p->kind == DYD_COORDINATE_SPAN ? k / 2 : k]};
}

/* One point or rectangle of decimals of any size. */
static dyd_status commit_wide(dyd_engine *e, const dyd_staged *p, dyd_error *err) {
  const int step = p->kind == DYD_COORDINATE_SPAN ? 2 : 1;
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_rect, r);
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    dyd_plain_get_q(lo, plain_of(p, step * a));
    dyd_plain_get_q(hi, plain_of(p, step * a + step - 1));
    st = dyd_interval_set_ends_q(a ? &r.y : &r.x, lo, hi);
  }
  if (st == DYD_OK) st = dyd_engine_add_rect(e, &r, err);
  return st;
}

/* The decimals from `first` on that fit single words, at most BULK, all PLAIN or all SPAN. */
static dyd_status commit_words(size_t *count, dyd_engine *e, const dyd_stage *s, size_t first, dyd_error *err) {
  static const int order[2][4] = {{0, 1}, {0, 2, 1, 3}}; /* of the ends: corner by corner */
  const dyd_staged *p = staged_at(s, first);
  const dyd_coordinate_kind kind = (dyd_coordinate_kind)p->kind;
  const bool boxes = kind == DYD_COORDINATE_SPAN;
  const size_t ends = boxes ? 4 : 2;
  dyd_words end[4 * BULK];
  size_t n = 0;
  for (; n < BULK && (p = staged_if(s, first + n, kind)); n++) {
    size_t k = 0;
    while (k < ends && dyd_plain_get_words(&end[ends * n + k], plain_of(p, order[boxes][k]))) k++;
    if (k < ends) break;
  }
  *count = n;
  return dyd_engine_add_words(e, n, end, boxes, err);
}

static dyd_status commit_decimals(size_t *count, dyd_engine *e, const dyd_stage *s, size_t first, dyd_error *err) {
  dyd_status st = commit_words(count, e, s, first, err);
  if (st != DYD_OK || *count) return st;
  *count = 1;
  return commit_wide(e, staged_at(s, first), err);
}

static dyd_status commit_fixed(dyd_engine *e, const dyd_staged *p, dyd_error *err) {
  DYD_LOCAL(dyd_rect, r);
  dyd_interval_set(&r.x, dyd_real_interval(p->u.real[0]));
  dyd_interval_set(&r.y, dyd_real_interval(p->u.real[1]));
  return dyd_engine_add_rect(e, &r, err);
}

static dyd_status commit_reals(dyd_engine *e, dyd_staged *p, dyd_error *err) {
  if (dyd_real_is_final(p->u.real[0]) && dyd_real_is_final(p->u.real[1])) {
    dyd_status st = commit_fixed(e, p, err);
    staged_drop(p);
    return st;
  }
  dyd_stream *stream = NULL;
  p->kind = DYD_COORDINATE_DOUBLE; /* the stream takes both reals over */
  dyd_status st = dyd_stream_from_reals(&stream, p->u.real[0], p->u.real[1]);
  return st != DYD_OK ? st : dyd_engine_add_stream(e, stream, err);
}

static dyd_status stage_commit_from(size_t *count, dyd_engine *e, dyd_stage *s, size_t first, dyd_error *err) {
  dyd_staged *p = staged_at(s, first);
  *count = 1;
  switch ((dyd_coordinate_kind)p->kind) {
  case DYD_COORDINATE_DOUBLE:
  case DYD_COORDINATE_BINARY:
    return commit_points(count, e, s, first, err);
  case DYD_COORDINATE_BOX:
    return commit_boxes(count, e, s, first, err);
  case DYD_COORDINATE_PLAIN:
  case DYD_COORDINATE_SPAN:
    return commit_decimals(count, e, s, first, err);
  case DYD_COORDINATE_REAL:
    break;
  }
  return commit_reals(e, p, err);
}

dyd_status dyd_stage_commit(dyd_engine *e, dyd_stage *s, dyd_error *err) {
  const size_t before = dyd_engine_count(e);
  dyd_status st = dyd_engine_reserve(e, s->count);
  for (size_t k = 0, count = 1; k < s->count && st == DYD_OK; k += count) st = stage_commit_from(&count, e, s, k, err);
  if (st != DYD_OK) dyd_engine_take_back(e, before);
  dyd_stage_clear(s);
  return st != DYD_OK && !err->message[0] ? dyd_fail(err, st, "%s", dyd_status_text(st)) : st;
}
