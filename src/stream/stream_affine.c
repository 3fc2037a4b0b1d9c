/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Images of streams under rational affine maps: of one stream, or the sum of those of several.
 *
 * [AFF-1] [CMB-1] For u = sum (a_k x_k + b_k y_k) + c over rectangles R_k the image is the interval whose ends take, in
 * each term, the end chosen by the sign of the coefficient: exact in rationals, of width sum (|a_k| wx_k + |b_k| wy_k),
 * and rounded outward once. So widths 2^-n with n = bits + 1 + ceil log2(sum (|a_k| + |b_k|)) give at most
 * 2^-(bits + 1), and the rounding to multiples of 2^-(bits + 2) adds less than twice that unit: 2^-bits in all.
 * The affine image of an affine image is that under the product matrix: chains are short and nothing is rounded
 * between. */
#include <dyadel/compose.h>

#include "base/alloc.h"
#include "base/error.h"
#include "dyadic/raw.h"
#include "stream/real.h"
#include "stream/stream.h"

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
  mpq_t end[2];
  bool flip = mpq_sgn(c) < 0;
  if (!mpq_sgn(c)) return;
  mpq_inits(end[0], end[1], NULL);
  dyd_interval_get_q(end[0], end[1], r);
  mpq_mul(end[0], end[0], c);
  mpq_mul(end[1], end[1], c);
  mpq_add(lo, lo, end[flip]);
  mpq_add(hi, hi, end[!flip]);
  mpq_clears(end[0], end[1], NULL);
}

/* One side of the image. Fixed rectangles are rounded once and for all. */
static dyd_status image_side(dyd_interval *out, const dyd_stream_image *a, int axis, int64_t exp) {
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  mpq_set(lo, a->shift[axis]);
  mpq_set(hi, a->shift[axis]);
  for (size_t k = 0; k < a->count; k++) {
    const dyd_rect *r = dyd_stream_rect(a->term[k].of);
    image_add_scaled(lo, hi, a->term[k].m[2 * axis], &r->x);
    image_add_scaled(lo, hi, a->term[k].m[2 * axis + 1], &r->y);
  }
  bool exact = image_is_final(a) || mpq_equal(lo, hi);
  dyd_status st = exact ? dyd_interval_fix(out, lo, hi) : dyd_interval_set_outward(out, lo, hi, exp);
  mpq_clears(lo, hi, NULL);
  return st;
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
  mpq_t sum, t;
  mpq_inits(sum, t, NULL);
  for (int axis = 0; axis < 2; axis++) {
    mpq_set_ui(sum, 0, 1);
    for (size_t k = 0; k < 2 * a->count; k++) {
      mpq_abs(t, a->term[k / 2].m[2 * axis + (int)(k % 2)]);
      mpq_add(sum, sum, t);
    }
    int64_t g = mpq_sgn(sum) ? dyd_q_log2_above(sum) : gain;
    if (g > gain) gain = g;
  }
  mpq_clears(sum, t, NULL);
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
  mpq_t t;
  mpq_init(t);
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
  mpq_clear(t);
}

dyd_status dyd_stream_affine(dyd_stream **out, dyd_stream *of, const mpq_t m[6]) {
  dyd_stream_image *a = of ? image_new(1) : NULL;
  if (!a) {
    dyd_stream_free(of);
    return of ? DYD_E_NOMEM : DYD_E_ARG;
  }
  const dyd_stream_image *inner = dyd_stream_user(of, affine_narrow);
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

dyd_status dyd_stream_midpoint(dyd_stream **out, dyd_stream *a, dyd_stream *b) {
  dyd_stream *const of[2] = {a, b};
  mpq_t half[2];
  for (int k = 0; k < 2; k++) {
    mpq_init(half[k]);
    mpq_set_ui(half[k], 1, 2);
  }
  dyd_status st = dyd_stream_combination(out, 2, of, (const mpq_t *)half, NULL);
  mpq_clears(half[0], half[1], NULL);
  return st;
}
