/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The centre of the circle through three computable points, as a stream.
 *
 * [VTX-1] For a in A, b in B, c in C and p = b - a, q = c - a the centre is a + n/d with
 *   d = 2 (p_x q_y - p_y q_x),   n = (q_y |p|^2 - p_y |q|^2,  p_x |q|^2 - q_x |p|^2).
 * Evaluated in intervals with exact ends from p in B - A, q in C - A, where the interval of d does not hold 0: it holds
 * the centre of every choice. Widths shrink in proportion to those of A, B, C, so the loop ends for every triple that
 * is not collinear. For three points all intervals are points: the exact centre. For fixed rectangles, which no loop
 * can narrow, the box of the partial centre is taken instead, the smallest there is [CEN-1].
 *
 * The points are scaled by a common factor F to integers; n/d scales by F as well. */
#include <dyadel/arc.h>
#include <dyadel/compose.h>

#include "base/alloc.h"
#include "base/error.h"
#include "rect/irect.h"
#include "stream/stream.h"

/* ---- intervals of integers ---- */

typedef struct span {
  mpz_t lo, hi;
} span;

static void span_init(span *a) {
  mpz_inits(a->lo, a->hi, NULL);
}
static void span_clear(span *a) {
  mpz_clears(a->lo, a->hi, NULL);
}

/* out = a b; out is none of them. */
static void span_mul(span *out, const span *a, const span *b) {
  mpz_t t;
  mpz_init(t);
  mpz_mul(out->lo, a->lo, b->lo);
  mpz_set(out->hi, out->lo);
  for (int k = 1; k < 4; k++) {
    mpz_mul(t, k & 1 ? a->hi : a->lo, k & 2 ? b->hi : b->lo);
    if (mpz_cmp(t, out->lo) < 0) mpz_set(out->lo, t);
    if (mpz_cmp(t, out->hi) > 0) mpz_set(out->hi, t);
  }
  mpz_clear(t);
}

/* out = a b - c d */
static void span_cross(span *out, const span *a, const span *b, const span *c, const span *d) {
  span t;
  span_init(&t);
  span_mul(out, a, b);
  span_mul(&t, c, d);
  mpz_sub(out->lo, out->lo, t.hi);
  mpz_sub(out->hi, out->hi, t.lo);
  span_clear(&t);
}

/* out = x^2 + y^2 */
static void span_norm(span *out, const span *x, const span *y) {
  const span *in[2] = {x, y};
  mpz_t s, t;
  mpz_inits(s, t, NULL);
  mpz_set_ui(out->lo, 0);
  mpz_set_ui(out->hi, 0);
  for (int k = 0; k < 2; k++) {
    bool zero = mpz_sgn(in[k]->lo) <= 0 && mpz_sgn(in[k]->hi) >= 0, low = mpz_cmpabs(in[k]->lo, in[k]->hi) < 0;
    mpz_mul(s, low ? in[k]->lo : in[k]->hi, low ? in[k]->lo : in[k]->hi);
    mpz_mul(t, low ? in[k]->hi : in[k]->lo, low ? in[k]->hi : in[k]->lo);
    if (!zero) mpz_add(out->lo, out->lo, s);
    mpz_add(out->hi, out->hi, t);
  }
  mpz_clears(s, t, NULL);
}

/* ---- the formula ---- */

/* [lo,hi] = ([a0,a1] + n/d) / F for d.lo > 0. */
static void span_shifted_quotient(mpq_t lo, mpq_t hi, mpz_srcptr a0, mpz_srcptr a1, const span *n, const span *d,
                                  mpz_srcptr man, int64_t exp) {
  mpq_ptr end[2] = {lo, hi};
  for (int k = 0; k < 2; k++) {
    mpz_srcptr top = k ? n->hi : n->lo, below = (mpz_sgn(top) >= 0) == (k == 1) ? d->lo : d->hi;
    mpz_mul(mpq_numref(end[k]), k ? a1 : a0, below);
    mpz_add(mpq_numref(end[k]), mpq_numref(end[k]), top);
    mpz_mul(mpq_denref(end[k]), below, man);
    if (exp > 0) mpz_mul_2exp(mpq_denref(end[k]), mpq_denref(end[k]), (mp_bitcnt_t)exp);
    if (exp < 0) mpz_mul_2exp(mpq_numref(end[k]), mpq_numref(end[k]), (mp_bitcnt_t)-exp);
    mpq_canonicalize(end[k]);
  }
}

static void span_difference(span *x, span *y, const dyd_irect *to, const dyd_irect *from) {
  mpz_sub(x->lo, to->x0, from->x1);
  mpz_sub(x->hi, to->x1, from->x0);
  mpz_sub(y->lo, to->y0, from->y1);
  mpz_sub(y->hi, to->y1, from->y0);
}

static void span_negate(span *a) {
  mpz_swap(a->lo, a->hi);
  mpz_neg(a->lo, a->lo);
  mpz_neg(a->hi, a->hi);
}

/* The ends end[0..3] = x lower, x upper, y lower, y upper of an enclosure; false if the formula gives none. */
static bool vertex_enclose_scaled(mpq_t end[4], const dyd_irect r[3], mpz_srcptr man, int64_t exp) {
  enum { PX, PY, QX, QY, PP, QQ, D, NX, NY, SPANS };
  span s[SPANS];
  for (int k = 0; k < SPANS; k++) span_init(&s[k]);
  span_difference(&s[PX], &s[PY], &r[1], &r[0]);
  span_difference(&s[QX], &s[QY], &r[2], &r[0]);
  span_cross(&s[D], &s[PX], &s[QY], &s[PY], &s[QX]);
  mpz_mul_2exp(s[D].lo, s[D].lo, 1);
  mpz_mul_2exp(s[D].hi, s[D].hi, 1);
  bool known = mpz_sgn(s[D].lo) > 0 || mpz_sgn(s[D].hi) < 0;
  if (known) {
    span_norm(&s[PP], &s[PX], &s[PY]);
    span_norm(&s[QQ], &s[QX], &s[QY]);
    span_cross(&s[NX], &s[QY], &s[PP], &s[PY], &s[QQ]);
    span_cross(&s[NY], &s[PX], &s[QQ], &s[QX], &s[PP]);
    if (mpz_sgn(s[D].hi) < 0)
      for (int k = D; k <= NY; k++) span_negate(&s[k]);
    span_shifted_quotient(end[0], end[1], r[0].x0, r[0].x1, &s[NX], &s[D], man, exp);
    span_shifted_quotient(end[2], end[3], r[0].y0, r[0].y1, &s[NY], &s[D], man, exp);
  }
  for (int k = 0; k < SPANS; k++) span_clear(&s[k]);
  return known;
}

/* An enclosure of the centre for all choices in the three rectangles, rounded outward to multiples of 2^exp unless it
 * is a point. DYD_E_DOMAIN: the formula gives none. */
static dyd_status vertex_enclose(dyd_rect *out, const dyd_rect *const in[3], int64_t exp) {
  dyd_irect r[3];
  mpq_t end[4];
  mpz_t man;
  int64_t scale;
  for (int k = 0; k < 3; k++) dyd_irect_init(&r[k]);
  for (int k = 0; k < 4; k++) mpq_init(end[k]);
  mpz_init(man);
  dyd_irects_scale(r, in, 3, man, &scale);
  dyd_status st = DYD_E_DOMAIN;
  if (vertex_enclose_scaled(end, r, man, scale)) {
    for (int a = 0; a < 2 && (a == 0 || st == DYD_OK); a++) {
      dyd_interval *side = a ? &out->y : &out->x;
      const mpq_t *e = (const mpq_t *)&end[2 * a];
      st = mpq_equal(e[0], e[1]) ? dyd_interval_set_q(side, e[0]) : dyd_interval_set_outward(side, e[0], e[1], exp);
    }
  }
  mpz_clear(man);
  for (int k = 0; k < 4; k++) mpq_clear(end[k]);
  for (int k = 0; k < 3; k++) dyd_irect_clear(&r[k]);
  return st;
}

/* The same for fixed rectangles, once and for all: the box of the partial centre, within 2^-64 of the least width. */
static dyd_status vertex_enclose_fixed(dyd_rect *out, const dyd_rect *const in[3]) {
  enum { FINER = 64 };
  int64_t bits = INT64_MIN;
  for (int k = 0; k < 6; k++) {
    int64_t b = dyd_interval_bits(k & 1 ? &in[k / 2]->x : &in[k / 2]->y);
    if (b != INT64_MAX && b > bits) bits = b;
  }
  if (bits == INT64_MIN) return vertex_enclose(out, in, 0); /* three points */
  dyd_status st = dyd_partial_centre_enclose(out, in[0], in[1], in[2], bits + FINER);
  return st == DYD_E_ARG ? DYD_E_DOMAIN : st;
}

/* ---- the stream ---- */

/* extra: how much narrower than asked for the points had to be last time. */
typedef struct vertex {
  dyd_stream *of[3];
  int64_t extra;
} vertex;

enum { LEAST_EXTRA = 4, SLACK = 64 };

static void vertex_release(void *user) {
  vertex *v = user;
  for (int k = 0; k < 3; k++) dyd_stream_free(v->of[k]);
  free(v);
}

static bool vertex_is_final(const vertex *v) {
  return dyd_stream_is_final(v->of[0]) && dyd_stream_is_final(v->of[1]) && dyd_stream_is_final(v->of[2]);
}

/* Narrows the points to 2^-bits and encloses; *known: is there an enclosure? */
static dyd_status vertex_attempt(bool *known, dyd_rect *out, const vertex *v, int64_t bits, int64_t max_bits,
                                 int64_t exp, dyd_error *err) {
  const dyd_rect *in[3];
  *known = false;
  for (int k = 0; k < 3; k++) {
    dyd_status st = dyd_stream_narrow(v->of[k], bits, max_bits, err);
    if (dyd_failed(st)) return st;
  }
  for (int k = 0; k < 3; k++) {
    in[k] = dyd_stream_rect(v->of[k]);
    if (!in[k])
      return dyd_fail(err, DYD_E_STREAM, "a point of a Voronoi vertex has no rectangle after it was narrowed");
  }
  dyd_status st = vertex_is_final(v) ? vertex_enclose_fixed(out, in) : vertex_enclose(out, in, exp);
  *known = st == DYD_OK;
  return st == DYD_OK || st == DYD_E_DOMAIN ? DYD_OK : dyd_fail(err, st, "a Voronoi vertex: %s", dyd_status_text(st));
}

static dyd_status vertex_domain_fail(dyd_error *err, const vertex *v, int64_t bits) {
  if (vertex_is_final(v))
    return dyd_fail(err, DYD_E_DOMAIN, "a Voronoi vertex of three fixed points that are, or may be, on one line");
  return dyd_fail(err, DYD_E_DOMAIN,
                  "a Voronoi vertex of three points that may be on one line, as far as 2^-%lld tells; raise the "
                  "precision, or leave the vertex out",
                  (long long)bits);
}

/* The next precision to try: r lacks some bits; r = NULL: nothing is known yet. */
static int64_t vertex_next_bits(int64_t bits, const dyd_rect *r, int64_t want) {
  int64_t size = bits < 0 ? -bits : bits, step = size < 16 ? 16 : size;
  int64_t missing = r ? want - dyd_rect_bits(r) + LEAST_EXTRA : step;
  return bits + (missing < step ? missing : step);
}

static dyd_status vertex_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  vertex *v = user;
  int64_t want = request->bits, cap = request->max_bits + v->extra + SLACK, bits = want + v->extra;
  bool known = false;
  for (;;) {
    if (bits > cap) bits = cap;
    dyd_status st = vertex_attempt(&known, out, v, bits, cap, -want - 2, err);
    if (dyd_failed(st)) return st;
    if (vertex_is_final(v) || bits == cap || (known && dyd_rect_bits(out) >= want)) break;
    bits = vertex_next_bits(bits, known ? out : NULL, want);
  }
  if (!known) return vertex_domain_fail(err, v, bits);
  v->extra = bits - want;
  return vertex_is_final(v) ? DYD_FIXED : DYD_OK;
}

dyd_status dyd_stream_voronoi_vertex(dyd_stream **out, dyd_stream *a, dyd_stream *b, dyd_stream *c) {
  bool good = a && b && c && a != b && a != c && b != c;
  vertex *v = good ? dyd_alloc(1, sizeof *v) : NULL;
  if (!v) {
    dyd_stream_free(a);
    dyd_stream_free(b);
    dyd_stream_free(c);
    return good ? DYD_E_NOMEM : DYD_E_ARG;
  }
  *v = (vertex){{a, b, c}, LEAST_EXTRA};
  dyd_source source = {DYD_SIZED(dyd_source), .narrow = vertex_narrow, .release = vertex_release, .user = v};
  bool final = vertex_is_final(v);
  dyd_status st = dyd_stream_new_enclosing(out, &source, final);
  if (st == DYD_OK && !final) dyd_stream_set_object(*out, DYD_STREAM_CENTRE, v->of);
  return st;
}
