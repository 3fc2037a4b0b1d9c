/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points read but not yet given to the engine: kept back so that bad input adds nothing. */
#include "io/read/stage.h"

#include "base/alloc.h"
#include "base/digest.h"
#include "base/error.h"
#include "base/local.h"
#include "engine/points.h"
#include "stream/stream.h"

#include <inttypes.h>
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
  return st == DYD_OK ? dyd_engine_add_rect(e, &r, err) : st;
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

/* ---- places ----
 *
Points are equal by their nominal coordinates. A hash table holds texts that are equal exactly if the numbers are:
 * "mek" for a decimal m * 10^k where 10 does not divide m, "p/q" in lowest terms for another rational. */

void dyd_places_clear(dyd_place_keys *n) {
  dyd_free_all(n->item, n->slot, n->text);
  *n = (dyd_place_keys){0};
}

size_t dyd_places_bytes(const dyd_place_keys *n) {
  return n->count * sizeof *n->item + n->slots * sizeof *n->slot + n->used;
}

static bool key_put(dyd_place_keys *n, const char *text, size_t length) {
  if (!dyd_reserve((void **)&n->text, &n->text_cap, n->used + length + 1, 1)) return false;
  memcpy(n->text + n->used, text, length);
  n->used += length;
  return true;
}

static bool key_put_plain(dyd_place_keys *n, dyd_plain p) {
  char text[48];
  for (; p.man && p.man % 10 == 0; p.exp++) p.man /= 10;
  int length = snprintf(text, sizeof text, "%" PRId64 "e%d ", p.man, p.man ? p.exp : 0);
  return key_put(n, text, (size_t)length);
}

/* Divides z, not 0, by p as often as it goes; returns how often. Short numbers are divided one digit after the other.
 */
static mp_bitcnt_t take_out(mpz_ptr z, unsigned long p) {
  enum { SHORT = 4 };
  mp_bitcnt_t times = 0;
  if (mpz_size(z) <= SHORT) {
    for (; mpz_divisible_ui_p(z, p); times++) mpz_divexact_ui(z, z, p);
    return times;
  }
  mpz_t factor;
  mpz_init_set_ui(factor, p);
  times = mpz_remove(z, z, factor);
  mpz_clear(factor);
  return times;
}

/* Destroys q, which is man / den * 10^ten with den coprime to 10 and man not divisible by 10: "mek" or "p/qek". */
static dyd_status key_put_rational(dyd_place_keys *n, mpq_t q) {
  mpz_ptr man = mpq_numref(q), den = mpq_denref(q);
  DYD_LOCAL_NUMBERS(mpz, factor);
  mp_bitcnt_t twos = mpz_scan1(den, 0);
  mpz_tdiv_q_2exp(den, den, twos);
  mp_bitcnt_t fives = take_out(den, 5);
  int64_t ten = -(int64_t)(twos > fives ? twos : fives);
  mpz_ui_pow_ui(factor, twos > fives ? 5 : 2, twos > fives ? twos - fives : fives - twos);
  mpz_mul(man, man, factor);
  ten = mpz_sgn(man) ? ten + (int64_t)take_out(man, 10) : 0;
  size_t most = mpz_sizeinbase(man, 10) + mpz_sizeinbase(den, 10) + 32;
  if (!dyd_reserve((void **)&n->text, &n->text_cap, n->used + most, 1)) return DYD_E_NOMEM;
  char *to = n->text + n->used;
  n->used += (size_t)(mpz_cmp_ui(den, 1) ? gmp_snprintf(to, most, "%Zd/%Zde%" PRId64 " ", man, den, ten)
                                         : gmp_snprintf(to, most, "%Zde%" PRId64 " ", man, ten));
  return DYD_OK;
}

static dyd_status key_put_coordinate(dyd_place_keys *n, const dyd_span *s) {
  size_t length = dyd_nominal_length(s);
  dyd_plain plain;
  if (dyd_plain_scan(&plain, s->text, length)) return key_put_plain(n, plain) ? DYD_OK : DYD_E_NOMEM;
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_status st = dyd_coordinate_ends(lo, hi, s, NULL);
  mpq_add(lo, lo, hi);
  mpq_div_2exp(lo, lo, 1);
  if (st == DYD_OK)
    st = key_put_rational(n, lo);
  else if (st != DYD_E_NOMEM)
    st = key_put(n, s->text, length) && key_put(n, " ", 1) ? DYD_OK : DYD_E_NOMEM;
  return st;
}

/* The digest with its high half stirred in, as slots are taken by low bits. */
static uint64_t hash_text(const char *text, size_t length) {
  uint64_t h = dyd_digest(DYD_DIGEST_BEGIN, text, length);
  return h ^ h >> 32;
}

/* The slot of the key, or the free one where it belongs; key = NULL: it is new. */
static dyd_place_slot *slot_find(const dyd_place_keys *n, uint64_t hash, const char *key, size_t length) {
  for (size_t k = (size_t)hash & (n->slots - 1);; k = (k + 1) & (n->slots - 1)) {
    dyd_place_slot *s = &n->slot[k];
    if (!s->item) return s;
    if (!key || s->tag != (uint32_t)(hash >> 32)) continue;
    const dyd_place_key *i = &n->item[s->item - 1];
    if (i->hash == hash && i->length == length && memcmp(n->text + i->text, key, length) == 0) return s;
  }
}

static bool slots_grow(dyd_place_keys *n) {
  if (n->slots && n->slots / 3 * 2 > n->count) return true;
  size_t slots = n->slots ? 2 * n->slots : 1024;
  dyd_place_slot *slot = n->count < UINT32_MAX ? calloc(slots, sizeof *slot) : NULL;
  if (!slot) return false;
  free(n->slot);
  n->slot = slot;
  n->slots = slots;
  for (size_t k = 0; k < n->count; k++) {
    uint64_t hash = n->item[k].hash;
    *slot_find(n, hash, NULL, 0) = (dyd_place_slot){(uint32_t)k + 1, (uint32_t)(hash >> 32)};
  }
  return true;
}

/* The item of the key that ends the text, begun at `begin`, with its count raised by 1. */
static dyd_status places_count(dyd_place_key **out, dyd_place_keys *n, size_t begin) {
  if (!slots_grow(n) || !DYD_GROW(n->item, n->cap, n->count + 1)) return DYD_E_NOMEM;
  size_t length = n->used - begin;
  uint64_t hash = hash_text(n->text + begin, length);
  dyd_place_slot *slot = slot_find(n, hash, n->text + begin, length);
  if (slot->item) {
    n->used = begin;
  } else {
    n->item[n->count++] = (dyd_place_key){.hash = hash, .text = begin, .length = length};
    *slot = (dyd_place_slot){(uint32_t)n->count, (uint32_t)(hash >> 32)};
  }
  *out = &n->item[slot->item - 1];
  (*out)->count++;
  return DYD_OK;
}

dyd_status dyd_places_find(dyd_place_key **out, dyd_place_keys *n, const dyd_span span[2]) {
  size_t begin = n->used;
  dyd_status st = key_put_coordinate(n, &span[0]);
  if (st == DYD_OK) st = key_put_coordinate(n, &span[1]);
  return st == DYD_OK ? places_count(out, n, begin) : st;
}

dyd_status dyd_places_find_id(dyd_place_key **out, dyd_place_keys *n, const dyd_span *id) {
  size_t begin = n->used;
  return key_put(n, id->text, id->length) ? places_count(out, n, begin) : DYD_E_NOMEM;
}
