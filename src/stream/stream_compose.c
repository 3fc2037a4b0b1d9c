/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Combinations of streams with rational weights.
 *
 * [CMB-1] The image of rectangles R_k under sum w_k p_k + s is the rectangle whose ends take, in each term, the end
 * chosen by the sign of the weight: exact in rationals, of widths sum |w_k| width_k, and rounded outward once. So
 * widths 2^-n with n = bits + 1 + ceil log2(sum |w_k|) give at most 2^-(bits + 1), and the rounding to multiples of
 * 2^-(bits + 2) adds less than twice that unit: 2^-bits in all. */
#include <dyadel/compose.h>

#include "base/alloc.h"
#include "base/error.h"
#include "dyadic/raw.h"
#include "stream/real.h"
#include "stream/stream.h"

/* Invariant: no weight is 0; 2^gain >= sum of |weight|. */
typedef struct combination {
  size_t count;
  dyd_stream **of;
  mpq_t *weight;
  mpq_t shift[2];
  int64_t gain;
} combination;

static void combination_release(void *user) {
  combination *c = user;
  for (size_t k = 0; k < c->count; k++) {
    dyd_stream_free(c->of[k]);
    mpq_clear(c->weight[k]);
  }
  free(c->of);
  free(c->weight);
  mpq_clears(c->shift[0], c->shift[1], NULL);
  free(c);
}

static bool combination_is_final(const combination *c) {
  for (size_t k = 0; k < c->count; k++)
    if (!dyd_stream_is_final(c->of[k])) return false;
  return true;
}

/* One side of the image: side 0 is x [CMB-1]. Fixed rectangles are rounded once and for all. */
static dyd_status combination_image_side(dyd_interval *out, const combination *c, int side, int64_t exp) {
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  mpq_set(lo, c->shift[side]);
  mpq_set(hi, c->shift[side]);
  for (size_t k = 0; k < c->count; k++) {
    const dyd_rect *r = dyd_stream_rect(c->of[k]);
    dyd_add_scaled_interval(lo, hi, c->weight[k], side == 0 ? &r->x : &r->y);
  }
  bool exact = combination_is_final(c) || mpq_equal(lo, hi);
  dyd_status st = exact ? dyd_interval_fix(out, lo, hi) : dyd_interval_set_outward(out, lo, hi, exp);
  mpq_clears(lo, hi, NULL);
  return st;
}

static dyd_status combination_image(dyd_rect *out, const combination *c, int64_t exp) {
  dyd_status st = combination_image_side(&out->x, c, 0, exp);
  return st == DYD_OK ? combination_image_side(&out->y, c, 1, exp) : st;
}

static dyd_status combination_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  combination *c = user;
  int64_t more = c->gain + 1, most = request->max_bits + (more > 0 ? more : 0);
  for (size_t k = 0; k < c->count; k++) {
    dyd_status st = dyd_stream_narrow(c->of[k], request->bits + more, most, err);
    if (dyd_failed(st)) return st;
  }
  dyd_status st = combination_image(out, c, -request->bits - 2);
  if (st != DYD_OK) return dyd_fail(err, st, "a combination of points: %s", dyd_status_text(st));
  return combination_is_final(c) ? DYD_FIXED : DYD_OK;
}

/* A g with sum of |weight| <= 2^g. */
static int64_t combination_gain(const combination *c) {
  mpq_t sum, t;
  mpq_inits(sum, t, NULL);
  for (size_t k = 0; k < c->count; k++) {
    mpq_abs(t, c->weight[k]);
    mpq_add(sum, sum, t);
  }
  int64_t gain = mpq_sgn(sum) ? dyd_q_log2_above(sum) : -DYD_EXP_LIMIT;
  mpq_clears(sum, t, NULL);
  return gain;
}

/* Takes over the references in any case; NULL: memory is exhausted. */
static combination *combination_make(size_t n, dyd_stream *const *of, const mpq_t *weight, const mpq_t shift[2]) {
  combination *c = calloc(1, sizeof *c);
  if (c) {
    mpq_inits(c->shift[0], c->shift[1], NULL);
    c->of = dyd_alloc(n, sizeof(dyd_stream *));
    c->weight = dyd_alloc(n, sizeof *c->weight);
  }
  bool made = c && c->of && c->weight;
  for (size_t k = 0; k < n; k++) {
    if (!made || !mpq_sgn(weight[k])) {
      dyd_stream_free(of[k]);
      continue;
    }
    c->of[c->count] = of[k];
    mpq_init(c->weight[c->count]);
    mpq_set(c->weight[c->count++], weight[k]);
  }
  if (c && !made) {
    combination_release(c);
    return NULL;
  }
  for (int a = 0; c && shift && a < 2; a++) mpq_set(c->shift[a], shift[a]);
  if (c) c->gain = combination_gain(c);
  return c;
}

dyd_status dyd_stream_combination(dyd_stream **out, size_t n, dyd_stream *const *of, const mpq_t *weight,
                                  const mpq_t shift[2]) {
  bool whole = true;
  for (size_t k = 0; k < n; k++) whole = whole && of[k];
  if (!whole) {
    for (size_t k = 0; k < n; k++) dyd_stream_free(of[k]);
    return DYD_E_ARG;
  }
  combination *c = combination_make(n, of, weight, shift);
  if (!c) return DYD_E_NOMEM;
  dyd_source source = {DYD_SIZED(dyd_source), .narrow = combination_narrow, .release = combination_release, .user = c};
  return dyd_stream_new_enclosing(out, &source, combination_is_final(c));
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
