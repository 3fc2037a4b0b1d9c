/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Voronoi vertices: of certain triangles, of tied and undecided faces, and as streams; partial centres; default
 * windows. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "delaunay/index_list.h"
#include "delaunay/state.h"
#include "delaunay/undecided.h"
#include "predicate/circle.h"
#include "rect/irect.h"
#include "rect/rect.h"
#include "stream/stream.h"
#include "voronoi/surd_point.h"
#include "voronoi/vertex_filter.h"

#include <dyadel/arc.h>
#include <dyadel/compose.h>
#include <dyadel/predicate.h>
#include <dyadel/voronoi.h>
#include <math.h>

/* ---- regions of undecided faces ---- */

/* The ends of the pairs and all their possible neighbours: no other site bounds their cells [CELL-2]. */
static dyd_status region_sites(dyd_index_list *out, const dyd_delaunay *pd, const dyd_pair_list *pairs) {
  DYD_SCOPED(dyd_index_list) near = {0};
  size_t cap = 0;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < pairs->count && st == DYD_OK; k++) {
    const uint32_t end[2] = {pairs->item[k].i, pairs->item[k].j};
    st = dyd_index_list_add(out, &cap, end, 2);
  }
  dyd_index_list_sort(out);
  for (size_t k = 0, ends = out->count; k < ends && st == DYD_OK; k++) {
    st = dyd_delaunay_neighbours(&near, pd, out->item[k], DYD_TIE);
    if (st == DYD_OK) st = dyd_index_list_add(out, &cap, near.item, near.count);
  }
  dyd_index_list_sort(out);
  return st;
}

static bool box_is_finite(const dyd_bbox *b) {
  return b->e[0] >= -DBL_MAX && b->e[1] <= DBL_MAX && b->e[2] >= -DBL_MAX && b->e[3] <= DBL_MAX;
}

static dyd_status region_find(dyd_rect *out, bool *any, const dyd_delaunay *pd, const dyd_pair_list *pairs,
                              const dyd_rect *window) {
  DYD_SCOPED(dyd_index_list) sites = {0};
  dyd_bbox box;
  dyd_status st = region_sites(&sites, pd, pairs);
  dyd_interval_get_d(&box.e[0], &box.e[1], &window->x);
  dyd_interval_get_d(&box.e[2], &box.e[3], &window->y);
  if (st == DYD_OK && !box_is_finite(&box)) {
    *any = true;
    dyd_rect_set(out, window);
  } else if (st == DYD_OK) {
    st = dyd_filter_region(&box, any, pd, pairs, &sites);
    if (st == DYD_OK && *any) st = dyd_rect_set_d(out, box.e[0], box.e[1], box.e[2], box.e[3]);
  }
  return st;
}

dyd_status dyd_voronoi_region(dyd_rect *out, bool *any, const dyd_delaunay *pd, size_t f, const dyd_rect *window) {
  if (!pd) return DYD_E_ARG;
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  if (f >= dyd_delaunay_undecided_faces(pd)) return DYD_E_ARG;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  dyd_status st = dyd_delaunay_face_pairs(&pairs, pd, f);
  return st == DYD_OK ? region_find(out, any, pd, &pairs, window) : st;
}

/* ---- partial centres, partial discs and bisectors ----
 *
 * [CEN-1] O(a,b,c) is bounded by parts of the boundaries of the convex sets C_xy, outside of which it lies, so that a
 * linear function has no local maximum over O inside such a part, flat parts aside; its maximum is at a point where two
 * of them meet, the centre of a critical circle. So the six centres have the bounding box of O. */

enum { CENTRES = 6 };

dyd_status dyd_partial_centre(dyd_surd_point out[6], const dyd_rect *a, const dyd_rect *b, const dyd_rect *c) {
  DYD_LOCAL(dyd_partial_disc, d);
  dyd_partial_disc_set(&d, a, b, c);
  bool known = d.known;
  for (int k = 0; known && k < CENTRES; k++) {
    const dyd_circle *o = &d.circle[k]; /* borrowed limbs */
    dyd_surd_point_set(&out[k],
                       &(dyd_surd_point){{o->ax[0]}, {o->bx[0]}, {o->ay[0]}, {o->by[0]}, {o->c[0]}, {o->d[0]}});
  }
  return known ? DYD_OK : DYD_E_ARG;
}

/* *side grows to hold s. */
static dyd_status interval_grow(dyd_interval *side, const dyd_interval *s) {
  const dyd_dyadic *lo = dyd_dyadic_cmp(&s->lo, &side->lo) < 0 ? &s->lo : &side->lo;
  const dyd_dyadic *hi = dyd_dyadic_cmp(&s->hi, &side->hi) > 0 ? &s->hi : &side->hi;
  DYD_LOCAL(dyd_interval, both);
  dyd_status st = dyd_interval_set_ends(&both, lo, hi);
  if (st == DYD_OK) dyd_interval_swap(side, &both);
  return st;
}

static dyd_status enclose_centres(dyd_rect *out, const dyd_surd_point centre[CENTRES], int64_t bits) {
  DYD_LOCAL(dyd_rect, one);
  dyd_status st = dyd_surd_point_enclose(out, &centre[0], bits);
  for (int k = 1; k < CENTRES && st == DYD_OK; k++) {
    st = dyd_surd_point_enclose(&one, &centre[k], bits);
    if (st == DYD_OK) st = interval_grow(&out->x, &one.x);
    if (st == DYD_OK) st = interval_grow(&out->y, &one.y);
  }
  return st;
}

dyd_status dyd_partial_centre_enclose(dyd_rect *out, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c,
                                      int64_t bits) {
  DYD_LOCAL(dyd_rect, r);
  DYD_LOCAL_ARRAY(dyd_surd_point, centre, [CENTRES]);
  dyd_status st = dyd_partial_centre(centre, a, b, c);
  if (st == DYD_OK) st = enclose_centres(&r, centre, bits);
  if (st == DYD_OK) dyd_rect_swap(out, &r);
  return st;
}

/* ---- the centre of the circle through three computable points, as a stream ----
 *
 * [VTX-1] For a in A, b in B, c in C and p = b - a, q = c - a the centre is a + n/d with
 *   d = 2 (p_x q_y - p_y q_x),   n = (q_y |p|^2 - p_y |q|^2,  p_x |q|^2 - q_x |p|^2).
 * Evaluated in intervals with exact ends from p in B - A, q in C - A, where the interval of d does not hold 0: it holds
 * the centre of every choice. Widths shrink in proportion to those of A, B, C, so the loop ends for every triple that
 * is not collinear. For three points all intervals are points: the exact centre. For fixed rectangles, which no loop
 * can narrow, the box of the partial centre is taken instead, the smallest there is [CEN-1].
 *
 * The points are scaled by a common factor F to integers; n/d scales by F as well. */

/* ---- intervals of integers ---- */

typedef struct mpz_span {
  mpz_t lo, hi;
} mpz_span;

static void mpz_span_init(mpz_span *a) {
  mpz_inits(a->lo, a->hi, NULL);
}

static void mpz_span_clear(mpz_span *a) {
  mpz_clears(a->lo, a->hi, NULL);
}

DYD_ARRAYS(mpz_span)

/* out = a b; out is none of them. */
static void span_mul(mpz_span *out, const mpz_span *a, const mpz_span *b) {
  DYD_LOCAL_NUMBERS(mpz, t);
  mpz_mul(out->lo, a->lo, b->lo);
  mpz_set(out->hi, out->lo);
  for (int k = 1; k < 4; k++) {
    mpz_mul(t, k & 1 ? a->hi : a->lo, k & 2 ? b->hi : b->lo);
    if (mpz_cmp(t, out->lo) < 0) mpz_set(out->lo, t);
    if (mpz_cmp(t, out->hi) > 0) mpz_set(out->hi, t);
  }
}

/* out = a b - c d */
static void span_cross(mpz_span *out, const mpz_span *a, const mpz_span *b, const mpz_span *c, const mpz_span *d) {
  DYD_LOCAL(mpz_span, t);
  span_mul(out, a, b);
  span_mul(&t, c, d);
  mpz_sub(out->lo, out->lo, t.hi);
  mpz_sub(out->hi, out->hi, t.lo);
}

/* out = x^2 + y^2 */
static void span_norm(mpz_span *out, const mpz_span *x, const mpz_span *y) {
  const mpz_span *in[2] = {x, y};
  DYD_LOCAL_NUMBERS(mpz, s, t);
  mpz_set_ui(out->lo, 0);
  mpz_set_ui(out->hi, 0);
  for (int k = 0; k < 2; k++) {
    bool zero = mpz_sgn(in[k]->lo) <= 0 && mpz_sgn(in[k]->hi) >= 0, low = mpz_cmpabs(in[k]->lo, in[k]->hi) < 0;
    mpz_mul(s, low ? in[k]->lo : in[k]->hi, low ? in[k]->lo : in[k]->hi);
    mpz_mul(t, low ? in[k]->hi : in[k]->lo, low ? in[k]->hi : in[k]->lo);
    if (!zero) mpz_add(out->lo, out->lo, s);
    mpz_add(out->hi, out->hi, t);
  }
}

/* ---- the formula ---- */

/* [lo,hi] = ([a0,a1] + n/d) / F for d.lo > 0. */
static void span_shifted_quotient(mpq_t lo, mpq_t hi, mpz_srcptr a0, mpz_srcptr a1, const mpz_span *n,
                                  const mpz_span *d, mpz_srcptr man, int64_t exp) {
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

static void span_difference(mpz_span *x, mpz_span *y, const dyd_irect *to, const dyd_irect *from) {
  mpz_sub(x->lo, to->x0, from->x1);
  mpz_sub(x->hi, to->x1, from->x0);
  mpz_sub(y->lo, to->y0, from->y1);
  mpz_sub(y->hi, to->y1, from->y0);
}

static void span_negate(mpz_span *a) {
  mpz_swap(a->lo, a->hi);
  mpz_neg(a->lo, a->lo);
  mpz_neg(a->hi, a->hi);
}

/* The ends end[0..3] = x lower, x upper, y lower, y upper of an enclosure; false if the formula gives none. */
static bool vertex_enclose_scaled(mpq_t end[4], const dyd_irect r[3], mpz_srcptr man, int64_t exp) {
  enum { PX, PY, QX, QY, PP, QQ, D, NX, NY, SPANS };
  DYD_LOCAL_ARRAY(mpz_span, s, [SPANS]);
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
  return known;
}

/* An enclosure of the centre for all choices in the three rectangles, rounded outward to multiples of 2^exp unless it
 * is a point. DYD_E_DOMAIN: the formula gives none. */
static dyd_status vertex_enclose(dyd_rect *out, const dyd_rect *const in[3], int64_t exp) {
  int64_t scale;
  DYD_LOCAL_ARRAY(dyd_irect, r, [3]);
  DYD_LOCAL_ARRAY(mpq_t, end, [4]);
  DYD_LOCAL_NUMBERS(mpz, man);
  dyd_irects_scale(r, in, 3, man, &scale);
  dyd_status st = DYD_E_DOMAIN;
  if (vertex_enclose_scaled(end, r, man, scale)) {
    for (int a = 0; a < 2 && (a == 0 || st == DYD_OK); a++) {
      dyd_interval *side = a ? &out->y : &out->x;
      const mpq_t *e = (const mpq_t *)&end[2 * a];
      st = mpq_equal(e[0], e[1]) ? dyd_interval_set_q(side, e[0]) : dyd_interval_set_outward(side, e[0], e[1], exp);
    }
  }
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

/* The next precision to try: r lacks some bits; r = NULL: no enclosure yet. */
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

/* ---- vertices of certain triangles ---- */

/* The rectangle of the centre of three sites: counter-clockwise, or (turn) certainly oriented. */
static dyd_status enclose_centre(dyd_rect *out, const dyd_sites *sites, const uint32_t corner[3], int64_t bits,
                                 bool turn) {
  DYD_LOCAL_ARRAY(dyd_rect, r, [3]);
  dyd_status st = DYD_OK;
  for (int k = 0; k < 3 && st == DYD_OK; k++) st = dyd_sites_get(&r[k], sites, corner[k]);
  if (st == DYD_OK && turn) {
    dyd_sure sign = dyd_orientation(&r[0], &r[1], &r[2]);
    if (sign == DYD_SURE_MINUS) dyd_rect_swap(&r[1], &r[2]);
    if (sign == DYD_UNSURE) st = DYD_E_RANGE;
  }
  return st == DYD_OK ? dyd_partial_centre_enclose(out, &r[0], &r[1], &r[2], bits) : st;
}

/* Returns true if t is a certain triangle of pd. v becomes its vertices. */
static bool triangle_is_sure(const dyd_delaunay *pd, const dyd_triangle *t, uint32_t v[3]) {
  for (int k = 0; k < 3; k++) {
    if (t->v[k] >= pd->sk.n) return false;
    v[k] = pd->sk.vertex[t->v[k]];
  }
  dyd_half_edge h = dyd_find_edge(&pd->sk, v[0], v[1]);
  return h != DYD_NONE && dyd_edge_apex(&pd->sk.mesh, h) == v[2] && dyd_triangle_is_sure(pd, dyd_edge_triangle(h));
}

dyd_status dyd_voronoi_vertex(dyd_rect *out, const dyd_delaunay *pd, const dyd_triangle *t, int64_t bits) {
  if (!pd) return DYD_E_ARG;
  uint32_t v[3];
  dyd_bbox box;
  if (!triangle_is_sure(pd, t, v)) return DYD_E_ARG;
  if (!pd->sk.mesh.no_filter && bits > -1000 && bits < 1000 && dyd_filter_vertex(&box, pd, v)) {
    double limit = ldexp(1, (int)-bits);
    if (box.e[1] - box.e[0] < limit && box.e[3] - box.e[2] < limit)
      return dyd_rect_set_d(out, box.e[0], box.e[1], box.e[2], box.e[3]);
  }
  return enclose_centre(out, pd->sk.rects.sites, t->v, bits, false);
}

/* ---- vertices of tied faces ---- */

/* corner[0..2]: sites far apart: the first, the farthest from it, the farthest from the line through both. */
static void spread_corners(uint32_t corner[3], const dyd_sites *sites, const dyd_index_list *list) {
  double at[3][2], e[4], best[3] = {0, -1, -1};
  for (int k = 0; k < 3; k++) {
    corner[k] = list->item[0];
    for (size_t q = 0; q < list->count; q++) {
      dyd_sites_get_d(e, sites, list->item[q]);
      double x = e[0] / 2 + e[1] / 2 - (k ? at[0][0] : 0), y = e[2] / 2 + e[3] / 2 - (k ? at[0][1] : 0);
      double size = k == 0 ? -(double)q : k == 1 ? x * x + y * y : fabs(at[1][0] * y - at[1][1] * x);
      if (k == 0 ? q > 0 : size <= best[k]) continue;
      best[k] = size;
      corner[k] = list->item[q];
      at[k][0] = x;
      at[k][1] = y;
    }
  }
}

dyd_status dyd_voronoi_tied_vertex(dyd_rect *out, bool *tied, const dyd_delaunay *pd, size_t f, int64_t bits) {
  if (!pd) return DYD_E_ARG;
  DYD_SCOPED(dyd_index_list) sites = {0};
  uint32_t corner[3];
  bool outer;
  if (f >= dyd_delaunay_undecided_faces(pd)) return DYD_E_ARG;
  *tied = !dyd_open_is_outer(pd, f) && dyd_open_status_of(pd, f) == DYD_TIE;
  if (!*tied) return DYD_OK;
  dyd_status st = dyd_delaunay_face(&sites, &outer, pd, f);
  if (st == DYD_OK) {
    spread_corners(corner, pd->sk.rects.sites, &sites);
    st = enclose_centre(out, pd->sk.rects.sites, corner, bits, true);
  }
  return st;
}

/* ---- windows ---- */

/* The margin on each side of an extent: a quarter of it; if that is 0, other, or 1. */
static double window_margin(double lo, double hi, double other) {
  double size = hi / 4 - lo / 4;
  return size > 0 ? size : other > 0 ? other : 1;
}

dyd_status dyd_voronoi_window(dyd_rect *out, const dyd_sites *sites) {
  if (!sites) return DYD_E_ARG;
  double e[4] = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL}, b[4];
  size_t n = dyd_sites_count(sites);
  for (size_t i = 0; i < n; i++) {
    dyd_sites_get_d(b, sites, i);
    for (int k = 0; k < 4; k += 2) {
      e[k] = dyd_min(e[k], b[k]);
      e[k + 1] = dyd_max(e[k + 1], b[k + 1]);
    }
  }
  if (!n) e[0] = e[1] = e[2] = e[3] = 0;
  double mx = window_margin(e[0], e[1], e[3] / 4 - e[2] / 4), my = window_margin(e[2], e[3], mx);
  double w[4] = {e[0] - mx, e[1] + mx, e[2] - my, e[3] + my};
  for (int k = 0; k < 4; k++)
    if (!(fabs(w[k]) <= DBL_MAX)) return DYD_E_RANGE;
  if (!(w[0] < w[1] && w[2] < w[3])) return DYD_E_RANGE;
  return dyd_rect_set_d(out, w[0], w[1], w[2], w[3]);
}
