/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Images of streams under rational affine maps.
 *
 * [AFF-1] For u = a x + b y + c the image of [x0,x1] x [y0,y1] is the interval whose ends take, in each term, the
 * end chosen by the sign of the coefficient: exact in rationals, of width |a| wx + |b| wy, and rounded outward
 * once. So widths 2^-n with n = bits + 1 + ceil log2(|a| + |b|) give at most 2^-(bits + 1), and the rounding to
 * multiples of 2^-(bits + 2) adds less than twice that unit: 2^-bits in all.
 * The image of an image is the image under the product matrix: chains are short and nothing is rounded between. */
#include "stream/real.h"
#include "stream/stream.h"

#include "base/alloc.h"
#include "base/error.h"
#include "dyadic/raw.h"

typedef struct affine {
  dyd_stream *of;
  mpq_t m[6];
  int64_t gain; /* 2^gain >= |m0| + |m1| and |m3| + |m4| */
} affine;

static void affine_release(void *user) {
  affine *a = user;
  dyd_stream_free(a->of);
  for (int i = 0; i < 6; i++) mpq_clear(a->m[i]);
  free(a);
}

void dyd_add_scaled_interval(mpq_t lo, mpq_t hi, const mpq_t c, const dyd_interval *r) {
  mpq_t end[2];
  bool flip = mpq_sgn(c) < 0;
  mpq_inits(end[0], end[1], NULL);
  dyd_interval_get_q(end[0], end[1], r);
  mpq_mul(end[0], end[0], c);
  mpq_mul(end[1], end[1], c);
  mpq_add(lo, lo, end[flip]);
  mpq_add(hi, hi, end[!flip]);
  mpq_clears(end[0], end[1], NULL);
}

/* out = row[0] x + row[1] y + row[2] over r [AFF-1]. Fixed rectangles are rounded once and for all. */
static dyd_status affine_image_side(dyd_interval *out, const mpq_t *row, const dyd_rect *r, bool final, int64_t exp) {
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  mpq_set(lo, row[2]);
  mpq_set(hi, row[2]);
  dyd_add_scaled_interval(lo, hi, row[0], &r->x);
  dyd_add_scaled_interval(lo, hi, row[1], &r->y);
  bool exact = final || mpq_equal(lo, hi);
  dyd_status st = exact ? dyd_interval_fix(out, lo, hi) : dyd_interval_set_outward(out, lo, hi, exp);
  mpq_clears(lo, hi, NULL);
  return st;
}

static dyd_status affine_image(dyd_rect *out, const affine *a, int64_t exp) {
  const dyd_rect *r = dyd_stream_rect(a->of);
  bool final = dyd_stream_is_final(a->of);
  dyd_status st = affine_image_side(&out->x, a->m, r, final, exp);
  return st == DYD_OK ? affine_image_side(&out->y, a->m + 3, r, final, exp) : st;
}

static dyd_status affine_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  affine *a = user;
  int64_t more = a->gain + 1;
  dyd_status st = dyd_stream_narrow(a->of, request->bits + more, request->max_bits + (more > 0 ? more : 0), err);
  if (dyd_failed(st)) return st;
  st = affine_image(out, a, -request->bits - 2);
  if (st != DYD_OK) return dyd_fail(err, st, "the affine image of a point: %s", dyd_status_text(st));
  return dyd_stream_is_final(a->of) ? DYD_FIXED : DYD_OK;
}

/* A g for which both rows have |row[0]| + |row[1]| <= 2^g; very small for a constant map. */
static int64_t affine_gain(const mpq_t m[6]) {
  int64_t gain = -DYD_EXP_LIMIT;
  mpq_t sum, t;
  mpq_init(sum);
  mpq_init(t);
  for (int row = 0; row < 2; row++) {
    mpq_abs(sum, m[3 * row]);
    mpq_abs(t, m[3 * row + 1]);
    mpq_add(sum, sum, t);
    if (!mpq_sgn(sum)) continue;
    int64_t g = dyd_q_log2_above(sum);
    if (g > gain) gain = g;
  }
  mpq_clear(t);
  mpq_clear(sum);
  return gain;
}

/* out = outer o inner. */
static void affine_compose(mpq_t out[6], const mpq_t outer[6], const mpq_t inner[6]) {
  mpq_t t;
  mpq_init(t);
  for (int row = 0; row < 2; row++) {
    for (int column = 0; column < 3; column++) {
      mpq_ptr entry = out[3 * row + column];
      mpq_mul(entry, outer[3 * row], inner[column]);
      mpq_mul(t, outer[3 * row + 1], inner[3 + column]);
      mpq_add(entry, entry, t);
    }
    mpq_add(out[3 * row + 2], out[3 * row + 2], outer[3 * row + 2]);
  }
  mpq_clear(t);
}

/* A new map; owns `of`, which is released on failure. */
static affine *affine_make(dyd_stream *of, const mpq_t m[6]) {
  affine *a = dyd_alloc(1, sizeof *a);
  if (!a) {
    dyd_stream_free(of);
    return NULL;
  }
  const affine *inner = dyd_stream_user(of, affine_narrow);
  for (int i = 0; i < 6; i++) mpq_init(a->m[i]);
  a->of = of;
  if (inner) {
    affine_compose(a->m, m, inner->m);
    a->of = dyd_stream_ref(inner->of);
    dyd_stream_free(of);
  } else {
    for (int i = 0; i < 6; i++) mpq_set(a->m[i], m[i]);
  }
  a->gain = affine_gain((const mpq_t *)a->m);
  return a;
}

dyd_status dyd_stream_affine(dyd_stream **out, dyd_stream *of, const mpq_t m[6]) {
  if (!of) return DYD_E_ARG;
  affine *a = affine_make(of, m);
  if (!a) return DYD_E_NOMEM;
  dyd_source source = {DYD_SIZED(dyd_source), .narrow = affine_narrow, .release = affine_release, .user = a};
  return dyd_stream_new_enclosing(out, &source, dyd_stream_is_final(a->of));
}
