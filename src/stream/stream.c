/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Computable points: a source of nested rectangles and the narrowest one so far; images, pairs, memory.
 *
 * [NEST-1] A rectangle is taken over only if it is a subset of the one before, decided exactly; the stream keeps
 * its old rectangle otherwise. Built-in combinations are intersected with the former rectangle [NEST-2]. */
#include "stream/stream.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/local.h"
#include "base/memory.h"
#include "dyadic/raw.h"
#include "rect/rect.h"
#include "stream/expr.h"
#include "stream/real.h"
#include "stream/root.h"

#include <dyadel/compose.h>

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

/* The same with a context of `size` bytes in one block with the stream, as dyd_real_new_inside. */
static dyd_status stream_new_inside(dyd_stream **out, void **user, size_t size, dyd_narrow_fn narrow,
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
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = source->narrow(&r, source->user, &any, NULL);
  if (!dyd_failed(st)) st = dyd_stream_new_fixed(out, &r);
  source->release(source->user);
  return st;
}

dyd_status dyd_stream_new_enclosing(dyd_stream **out, const dyd_source *source, bool final) {
  if (final) return stream_new_final(out, source);
  dyd_status st = dyd_stream_new(out, source, DYD_NO_POINT, NULL);
  if (st == DYD_OK) (*out)->encloses = true;
  return st;
}

/* The context of s if `narrow` is its callback, else NULL. Borrowed. */
static void *stream_user(const dyd_stream *s, dyd_narrow_fn narrow) {
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
  dyd_free_all(s->now, s);
}

const dyd_rect *dyd_stream_rect(const dyd_stream *s) {
  return s ? s->now : NULL;
}

bool dyd_stream_is_final(const dyd_stream *s) {
  return s ? s->final : false;
}

uint64_t dyd_stream_stage(const dyd_stream *s) {
  return s ? s->stage : 0;
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
  dyd_error own;
  dyd_error_clear(&own);
  DYD_LOCAL(dyd_rect, next);
  if (s->now)
    dyd_rect_set(&next, s->now);
  else
    dyd_rect_unset(&next);
  dyd_status st = s->source.narrow(&next, s->source.user, request, &own);
  bool fixed = st == DYD_FIXED;
  if (fixed) st = DYD_OK;
  if (st == DYD_OK) st = dyd_rect_check_set(&next, s->point, s->stage, &own);
  if (st == DYD_OK) st = stream_accept(s, &next, &own);
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
  return s ? dyd_stream_narrow_until(s, bits, max_bits, NULL, err) : dyd_fail_null(err);
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

/* Images of streams under rational affine maps: of one stream, or the sum of those of several.
 *
 * [AFF-1] [CMB-1] For u = sum (a_k x_k + b_k y_k) + c over rectangles R_k the image is the interval whose ends take, in
 * each term, the end chosen by the sign of the coefficient: exact in rationals, of width sum (|a_k| wx_k + |b_k| wy_k),
 * and rounded outward once. So widths 2^-n with n = bits + 1 + ceil log2(sum (|a_k| + |b_k|)) give at most
 * 2^-(bits + 1), and the rounding to multiples of 2^-(bits + 2) adds less than twice that unit: 2^-bits in all.
 * The affine image of an affine image is that under the product matrix: chains are short and nothing is rounded
 * between. */

static void image_release(void *user) {
  dyd_stream_image *a = user;
  for (size_t k = 0; k < a->count; k++) {
    dyd_stream_free(a->term[k].of);
    for (int i = 0; i < 4; i++) mpq_clear(a->term[k].m[i]);
  }
  free(a->term);
  mpq_clears(a->shift[0], a->shift[1], NULL);
  free(a);
}

/* With room for n terms; NULL: memory is exhausted. */
static dyd_stream_image *image_new(size_t n) {
  dyd_stream_image *a = calloc(1, sizeof *a);
  if (!a) return NULL;
  mpq_inits(a->shift[0], a->shift[1], NULL);
  a->term = dyd_alloc(n, sizeof *a->term);
  if (a->term) return a;
  image_release(a);
  return NULL;
}

/* Appends a term of coefficients 0; takes over the reference. */
static dyd_stream_term *image_add_term(dyd_stream_image *a, dyd_stream *of) {
  dyd_stream_term *t = &a->term[a->count++];
  t->of = of;
  for (int i = 0; i < 4; i++) mpq_init(t->m[i]);
  return t;
}

static bool image_is_final(const dyd_stream_image *a) {
  for (size_t k = 0; k < a->count; k++)
    if (!dyd_stream_is_final(a->term[k].of)) return false;
  return true;
}

/* [lo,hi] += c r. */
static void image_add_scaled(mpq_t lo, mpq_t hi, const mpq_t c, const dyd_interval *r) {
  bool flip = mpq_sgn(c) < 0;
  if (!mpq_sgn(c)) return;
  DYD_LOCAL_ARRAY(mpq_t, end, [2]);
  dyd_interval_get_q(end[0], end[1], r);
  mpq_mul(end[0], end[0], c);
  mpq_mul(end[1], end[1], c);
  mpq_add(lo, lo, end[flip]);
  mpq_add(hi, hi, end[!flip]);
}

/* One side of the image. Fixed rectangles are rounded once and for all. */
static dyd_status image_side(dyd_interval *out, const dyd_stream_image *a, int axis, int64_t exp) {
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  mpq_set(lo, a->shift[axis]);
  mpq_set(hi, a->shift[axis]);
  for (size_t k = 0; k < a->count; k++) {
    const dyd_rect *r = dyd_stream_rect(a->term[k].of);
    image_add_scaled(lo, hi, a->term[k].m[2 * axis], &r->x);
    image_add_scaled(lo, hi, a->term[k].m[2 * axis + 1], &r->y);
  }
  bool exact = image_is_final(a) || mpq_equal(lo, hi);
  return exact ? dyd_interval_set_ends_q(out, lo, hi) : dyd_interval_set_outward(out, lo, hi, exp);
}

/* what: for messages. */
static dyd_status image_narrow(dyd_rect *out, const dyd_stream_image *a, const dyd_request *request, const char *what,
                               dyd_error *err) {
  int64_t more = a->gain + 1, most = request->max_bits + (more > 0 ? more : 0);
  for (size_t k = 0; k < a->count; k++) {
    dyd_status st = dyd_stream_narrow_until(a->term[k].of, request->bits + more, most, request->stop, err);
    if (dyd_narrow_ended(st)) return st;
  }
  dyd_status st = image_side(&out->x, a, 0, -request->bits - 2);
  if (st == DYD_OK) st = image_side(&out->y, a, 1, -request->bits - 2);
  if (st != DYD_OK) return dyd_fail(err, st, "%s: %s", what, dyd_status_text(st));
  return image_is_final(a) ? DYD_FIXED : DYD_OK;
}

/* The least gain found by lengths of numbers; very small for a constant map. */
static int64_t image_gain(const dyd_stream_image *a) {
  int64_t gain = -DYD_EXP_LIMIT;
  DYD_LOCAL_NUMBERS(mpq, sum, t);
  for (int axis = 0; axis < 2; axis++) {
    mpq_set_ui(sum, 0, 1);
    for (size_t k = 0; k < 2 * a->count; k++) {
      mpq_abs(t, a->term[k / 2].m[2 * axis + (int)(k % 2)]);
      mpq_add(sum, sum, t);
    }
    int64_t g = mpq_sgn(sum) ? dyd_q_log2_above(sum) : gain;
    if (g > gain) gain = g;
  }
  return gain;
}

/* The image, complete but for its gain, as a stream; it is released on failure. */
static dyd_status image_stream(dyd_stream **out, dyd_stream_image *a, dyd_narrow_fn narrow) {
  a->gain = image_gain(a);
  dyd_source source = {DYD_SIZED(dyd_source), .narrow = narrow, .release = image_release, .user = a};
  bool final = image_is_final(a);
  dyd_status st = dyd_stream_new_enclosing(out, &source, final);
  if (st == DYD_OK && !final) dyd_stream_set_object(*out, DYD_STREAM_IMAGE, a);
  return st;
}

/* ---- of one stream ---- */

static dyd_status affine_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  return image_narrow(out, user, request, "the affine image of a point", err);
}

/* The only term and the shift of a become those of m, or of m after inner. */
static void affine_set(dyd_stream_image *a, const mpq_t m[6], const dyd_stream_image *inner) {
  DYD_LOCAL_NUMBERS(mpq, t);
  for (int k = 0; k < 6; k++) {
    int row = k / 3, column = k % 3;
    mpq_ptr entry = column < 2 ? a->term->m[2 * row + column] : a->shift[row];
    if (!inner) {
      mpq_set(entry, m[k]);
      continue;
    }
    mpq_mul(entry, m[3 * row], column < 2 ? inner->term->m[column] : inner->shift[0]);
    mpq_mul(t, m[3 * row + 1], column < 2 ? inner->term->m[2 + column] : inner->shift[1]);
    mpq_add(entry, entry, t);
    if (column == 2) mpq_add(entry, entry, m[k]);
  }
}

dyd_status dyd_stream_affine(dyd_stream **out, dyd_stream *of, const mpq_t m[6]) {
  dyd_stream_image *a = of ? image_new(1) : NULL;
  if (!a) {
    dyd_stream_free(of);
    return of ? DYD_E_NOMEM : DYD_E_ARG;
  }
  const dyd_stream_image *inner = stream_user(of, affine_narrow);
  image_add_term(a, dyd_stream_ref(inner ? inner->term->of : of));
  affine_set(a, m, inner);
  dyd_stream_free(of);
  return image_stream(out, a, affine_narrow);
}

/* ---- of several ---- */

static dyd_status combination_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  return image_narrow(out, user, request, "a combination of points", err);
}

dyd_status dyd_stream_combination(dyd_stream **out, size_t n, dyd_stream *const *of, const mpq_t *weight,
                                  const mpq_t shift[2]) {
  bool whole = true;
  for (size_t k = 0; k < n; k++) whole = whole && of[k];
  dyd_stream_image *a = whole ? image_new(n) : NULL;
  for (size_t k = 0; k < n; k++) {
    if (!a || !mpq_sgn(weight[k])) {
      dyd_stream_free(of[k]);
      continue;
    }
    dyd_stream_term *t = image_add_term(a, of[k]);
    mpq_set(t->m[0], weight[k]);
    mpq_set(t->m[3], weight[k]);
  }
  if (!a) return whole ? DYD_E_NOMEM : DYD_E_ARG;
  for (int axis = 0; shift && axis < 2; axis++) mpq_set(a->shift[axis], shift[axis]);
  return image_stream(out, a, combination_narrow);
}

/* Streams from rectangles and from pairs of reals. */

dyd_status dyd_stream_from_rect(dyd_stream **out, const dyd_rect *r) {
  DYD_LOCAL(dyd_rect, copy);
  dyd_rect_set(&copy, r);
  return dyd_stream_new_fixed(out, &copy);
}

static void pair_release(void *user) {
  dyd_stream_pair *p = user;
  dyd_real_free(p->y);
  dyd_real_free(p->x);
}

static bool pair_is_final(const dyd_stream_pair *p) {
  return dyd_real_is_final(p->x) && dyd_real_is_final(p->y);
}

static void pair_rect(dyd_rect *out, const dyd_stream_pair *p) {
  dyd_interval_set(&out->x, dyd_real_interval(p->x));
  dyd_interval_set(&out->y, dyd_real_interval(p->y));
}

static dyd_status pair_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_stream_pair *p = user;
  dyd_status st = dyd_real_narrow_until(p->x, request->bits, request->max_bits, request->stop, err);
  if (dyd_narrow_ended(st)) return st;
  st = dyd_real_narrow_until(p->y, request->bits, request->max_bits, request->stop, err);
  if (dyd_narrow_ended(st)) return st;
  pair_rect(out, p);
  return pair_is_final(p) ? DYD_FIXED : DYD_OK;
}

static dyd_status pair_fixed(dyd_stream **out, const dyd_stream_pair *p) {
  DYD_LOCAL(dyd_rect, r);
  pair_rect(&r, p);
  return dyd_stream_new_fixed(out, &r);
}

dyd_status dyd_stream_from_reals(dyd_stream **out, dyd_real *x, dyd_real *y) {
  dyd_stream_pair p = {x, y};
  void *inside;
  dyd_status st = x && y ? DYD_OK : DYD_E_ARG;
  if (st == DYD_OK && !pair_is_final(&p)) {
    st = stream_new_inside(out, &inside, sizeof p, pair_narrow, pair_release);
    if (st == DYD_OK) {
      *(dyd_stream_pair *)inside = p;
      dyd_stream_set_object(*out, DYD_STREAM_PAIR, inside);
      return DYD_OK;
    }
  } else if (st == DYD_OK) {
    st = pair_fixed(out, &p);
  }
  pair_release(&p);
  return st;
}

bool dyd_stream_reaches(const dyd_stream *s, const dyd_rect *now, int64_t bits) {
  const dyd_stream_pair *p = stream_user(s, pair_narrow);
  if (p) return dyd_real_reaches(p->x, &now->x, bits) && dyd_real_reaches(p->y, &now->y, bits);
  return dyd_stream_is_final(s) || dyd_rect_bits(now) >= bits;
}

/* Replaces a side by its core, with the cuts that others made. */
static dyd_status side_core(dyd_interval *side, bool *has, const dyd_real *x, bool narrower) {
  DYD_LOCAL(dyd_interval, core);
  dyd_status st = dyd_real_core(&core, has, x, narrower ? dyd_real_interval(x) : side);
  *has = *has && dyd_interval_meets(&core, side);
  if (st == DYD_OK && *has) st = dyd_interval_intersect(side, side, &core);
  return st;
}

dyd_status dyd_stream_core(dyd_rect *r, bool core[2], const dyd_stream *s, bool narrower) {
  const dyd_stream_pair *p = stream_user(s, pair_narrow);
  core[0] = core[1] = dyd_stream_is_final(s);
  if (!p || core[0]) return DYD_OK;
  dyd_status st = side_core(&r->x, &core[0], p->x, narrower);
  return st == DYD_OK ? side_core(&r->y, &core[1], p->y, narrower) : st;
}

/* Sets radius to that of a side, and adds to `off` the bound of its rounding: 2^-50 of the ends of a final one. */
static void side_radius(mpq_t radius, mpq_t off, const dyd_real *x) {
  dyd_real_radius(radius, x);
  if (!dyd_real_is_final(x)) return;
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_interval_get_q(lo, hi, dyd_real_interval(x));
  mpq_abs(lo, lo);
  mpq_abs(hi, hi);
  mpq_add(lo, lo, hi);
  mpq_div_2exp(lo, lo, 50);
  mpq_add(off, off, lo);
}

dyd_site_kind dyd_stream_site_kind(const dyd_stream *s) {
  const dyd_stream_pair *p = stream_user(s, pair_narrow);
  if (!p) return DYD_SITE_BARE;
  DYD_LOCAL_NUMBERS(mpq, x, y, off);
  side_radius(x, off, p->x);
  side_radius(y, off, p->y);
  bool bare = mpq_sgn(x) == 0 && mpq_sgn(y) == 0;
  bool round = mpq_sgn(x) && mpq_sgn(y);
  mpq_sub(y, y, x);
  mpq_abs(y, y);
  round = round && mpq_cmp(y, off) <= 0;
  return bare ? DYD_SITE_BARE : round ? DYD_SITE_ROUND : DYD_SITE_ANY;
}

bool dyd_stream_glance(dyd_double_span out[2], const dyd_stream *s, int64_t bits) {
  const dyd_stream_pair *p = stream_user(s, pair_narrow);
  if (!p || dyd_stream_rect(s)) return false;
  return dyd_real_glance(&out[0], p->x, bits) && dyd_real_glance(&out[1], p->y, bits);
}

int64_t dyd_stream_glance_bits(const dyd_stream *s) {
  const dyd_stream_pair *p = stream_user(s, pair_narrow);
  if (!p || dyd_stream_rect(s)) return INT64_MIN;
  int64_t x = dyd_real_glance_bits(p->x), y = dyd_real_glance_bits(p->y);
  return x < y ? x : y;
}

/* Estimates of what streams take in memory. Operands made by dyd_real_op count alone, without their own operands, which
 * others may use as well. */

/* Bytes of a stream or real alone, with the overhead of allocators. */
enum { RECORD = 192, NUMBER = 48 };

static uint64_t bytes_of_number(mpz_srcptr z) {
  return NUMBER + mpz_size(z) * sizeof(mp_limb_t);
}

static uint64_t bytes_of_interval(const dyd_interval *x) {
  return x ? bytes_of_number(x->lo.man) + bytes_of_number(x->hi.man) + bytes_of_number(x->den) : 0;
}

static uint64_t bytes_of_root(const dyd_root *r) {
  uint64_t bytes = sizeof *r + bytes_of_number(r->slot);
  for (slong k = 0; k < r->poly->length; k++)
    bytes += NUMBER + (uint64_t)fmpz_size(r->poly->coeffs + k) * sizeof(mp_limb_t);
  return bytes;
}

uint64_t dyd_real_bytes(const dyd_real *x) {
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
  return bytes + dyd_real_bytes(pair->x) + (pair->y == pair->x ? 0 : dyd_real_bytes(pair->y));
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
    return FUNCTION + 2 * (uint64_t)((const dyd_root *)object)->poly->length;
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
