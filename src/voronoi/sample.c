/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dyadic points close to exact arcs. */
#include "voronoi/sample.h"

#include "base/alloc.h"
#include "base/index.h"
#include "base/local.h"
#include "dyadic/raw.h"
#include "predicate/circle.h"

/* ---- the sites of a cell ---- */

dyd_status dyd_cell_sites_init(dyd_cell_sites *s, const dyd_delaunay *pd, uint32_t i, dyd_pair_status least) {
  *s = (dyd_cell_sites){0};
  dyd_rect_init(&s->own);
  dyd_index_list list = {0};
  dyd_status st = dyd_sites_get(&s->own, dyd_delaunay_sites(pd), i);
  if (st == DYD_OK) st = dyd_delaunay_neighbours(&list, pd, i, least);
  if (st != DYD_OK) return st;
  s->site = list.item;
  s->other = dyd_alloc(list.count, sizeof *s->other);
  if (!s->other) return DYD_E_NOMEM;
  for (; s->count < list.count && st == DYD_OK; s->count++) {
    dyd_rect_init(&s->other[s->count]);
    st = dyd_sites_get(&s->other[s->count], dyd_delaunay_sites(pd), list.item[s->count]);
  }
  return st;
}

dyd_status dyd_cell_sites_enclose(dyd_cell_sites *s) {
  if (!DYD_NEW(s->box, s->count + 1)) return DYD_E_NOMEM;
  for (size_t k = 0; k < s->count; k++) dyd_filter_box(&s->box[k], &s->other[k]);
  dyd_filter_box(&s->box[s->count], &s->own);
  return DYD_OK;
}

void dyd_cell_sites_clear(dyd_cell_sites *s) {
  for (size_t k = 0; k < s->count; k++) dyd_rect_clear(&s->other[k]);
  dyd_free_all(s->box, s->other, s->site);
  dyd_rect_clear(&s->own);
}

const dyd_rect *dyd_cell_site(const dyd_cell_sites *s, uint32_t site) {
  const uint32_t *at = dyd_find_index(&site, s->site, s->count, sizeof site);
  return at ? &s->other[at - s->site] : &s->own;
}

bool dyd_cell_holds(const dyd_cell_sites *s, const dyd_point *c) {
  dyd_iv at[2];
  dyd_filter_point(at, c);
  dyd_iv own = dyd_filter_distance2(at[0], at[1], &s->box[s->count], DYD_FARTHEST);
  for (size_t k = 0; k < s->count; k++) {
    dyd_iv other = dyd_filter_distance2(at[0], at[1], &s->box[k], DYD_CLOSEST);
    if (!(own.hi < other.lo) && dyd_compare_distance(c, &s->own, DYD_FARTHEST, &s->other[k], DYD_CLOSEST) >= 0)
      return false;
  }
  return true;
}

/* The e with 2^(e-1) <= |q| < 2^e; q is not 0. */
static int64_t fraction_exponent(const mpq_t q) {
  int64_t e = dyd_q_log2_above(q) - 1; /* 2^(e-1) < |q| < 2^(e+1) */
  DYD_LOCAL_NUMBERS(mpz, n);
  mpz_set(n, mpq_numref(q));
  DYD_LOCAL_NUMBERS(mpz, d);
  mpz_set(d, mpq_denref(q));
  mpz_mul_2exp(e < 0 ? n : d, e < 0 ? n : d, (mp_bitcnt_t)(e < 0 ? -e : e));
  if (mpz_cmpabs(n, d) >= 0) e++;
  return e;
}

int64_t dyd_log2_length(const mpq_t x, const mpq_t y) {
  DYD_LOCAL_NUMBERS(mpq, s);
  mpq_abs(s, x);
  if (mpq_sgn(y) >= 0)
    mpq_add(s, s, y);
  else
    mpq_sub(s, s, y);
  return mpq_sgn(s) == 0 ? INT64_MIN / 2 : fraction_exponent(s);
}

/* ---- parabolas ---- */

/* The parabola of an arc: coordinate `along` runs along the directrix, the other one is
 * ((t - f_along)^2 + f_across^2 - d^2) / (2 (f_across - d)). */
typedef struct parabola {
  int along; /* 0: x */
  mpq_t focus[2], directrix;
} parabola;

static void parabola_init(parabola *p) {
  mpq_inits(p->focus[0], p->focus[1], p->directrix, NULL);
}
static void parabola_clear(parabola *p) {
  mpq_clears(p->focus[0], p->focus[1], p->directrix, NULL);
}

static void parabola_set(parabola *p, const dyd_arc *arc, const dyd_cell_sites *s, uint32_t own) {
  const dyd_rect *far = arc->far_site == own ? &s->own : dyd_cell_site(s, arc->far_site);
  const dyd_rect *near = arc->near_site == own ? &s->own : dyd_cell_site(s, arc->near_site);
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_interval_get_q(lo, hi, &far->x);
  mpq_set(p->focus[0], arc->corner & 1 ? hi : lo);
  dyd_interval_get_q(lo, hi, &far->y);
  mpq_set(p->focus[1], arc->corner & 2 ? hi : lo);
  p->along = arc->feature >= DYD_SIDE_Y0 ? 0 : 1;
  dyd_interval_get_q(lo, hi, p->along == 0 ? &near->y : &near->x);
  mpq_set(p->directrix, arc->feature & 1 ? hi : lo);
}

/* across = the other coordinate at abscissa t. */
static void parabola_at(mpq_t across, const parabola *p, const mpq_t t) {
  DYD_LOCAL_NUMBERS(mpq, a, b);
  mpq_srcptr f = p->focus[1 - p->along];
  mpq_sub(a, t, p->focus[p->along]);
  mpq_mul(a, a, a);
  mpq_mul(b, f, f);
  mpq_add(a, a, b);
  mpq_mul(b, p->directrix, p->directrix);
  mpq_sub(a, a, b);
  mpq_sub(b, f, p->directrix);
  mpq_mul_2exp(b, b, 1);
  mpq_div(across, a, b);
}

/* ---- samples ---- */

/* The middle of an enclosure of the end, within 2^-bits of it. */
static dyd_status arc_end_point(dyd_point *out, const dyd_arc_end *end, int64_t bits) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_surd_point_enclose(&r, &end->at, bits);
  DYD_LOCAL_NUMBERS(mpq, a, b);
  for (int axis = 0; st == DYD_OK && axis < 2; axis++) {
    dyd_interval_get_q(a, b, axis ? &r.y : &r.x);
    mpq_add(a, a, b);
    mpq_div_2exp(a, a, 1);
    st = dyd_dyadic_round_q(axis ? &out->y : &out->x, a, -(bits + 1), DYD_DOWN);
  }
  return st;
}

/* The coordinates of both ends of an arc along its directrix, within 2^-bits. */
static dyd_status arc_ends_along(mpq_t begin, mpq_t end, const dyd_arc *arc, int along, int64_t bits) {
  DYD_LOCAL(dyd_point, z);
  dyd_status st = arc_end_point(&z, &arc->begin, bits);
  dyd_dyadic_get_q(begin, along ? &z.y : &z.x);
  if (st == DYD_OK) st = arc_end_point(&z, &arc->end, bits);
  dyd_dyadic_get_q(end, along ? &z.y : &z.x);
  return st;
}

/* n^2 >= (length^2 / |q|) 2^bits / 8; length is destroyed. */
static dyd_status count_steps(uint32_t *out, mpq_t length, const mpq_t q, int64_t bits) {
  mpq_mul(length, length, length);
  mpq_div(length, length, q);
  int64_t twice = mpq_sgn(length) ? fraction_exponent(length) + bits - 3 : -1;
  int64_t shift = twice <= 0 ? 0 : (twice + 1) / 2;
  if (shift > 24) return DYD_E_RANGE;
  *out = (uint32_t)1 << shift;
  return DYD_OK;
}

dyd_status dyd_parabola_steps(uint32_t *out, const dyd_sites *sites, const uint32_t site[2], const int end[2],
                              int across, int64_t length, int64_t bits) {
  DYD_LOCAL(dyd_rect, r);
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  DYD_LOCAL_ARRAY(mpq_t, at, [2]);
  dyd_status st = DYD_OK;
  for (int k = 0; k < 2 && st == DYD_OK; k++) {
    st = dyd_sites_get(&r, sites, site[k]);
    dyd_interval_get_q(lo, hi, across ? &r.y : &r.x);
    mpq_set(at[k], end[k] ? hi : lo);
  }
  mpq_sub(at[0], at[0], at[1]);
  mpq_set_si(lo, length, 1);
  if (bits + 5 >= 0)
    mpq_div_2exp(lo, lo, (mp_bitcnt_t)(bits + 5));
  else
    mpq_mul_2exp(lo, lo, (mp_bitcnt_t) - (bits + 5));
  return st == DYD_OK ? count_steps(out, lo, at[0], bits) : st;
}

/* The bits with which ends of an arc are found, for its length. An error d of the length adds d sqrt(2^bits / (8 q)) to
 * the number of parts: below 1 for d^2 <= q 2^-bits. Where the parabola is much narrower than 2^-bits, as near sites
 * that are small against the window, that takes more bits than the parts themselves. */
static int64_t length_bits(const mpq_t q, int64_t bits) {
  int64_t log2 = dyd_q_log2_above(q);
  return log2 >= -bits - DYD_NARROW ? bits + 4 : (bits - log2) / 2 + 3;
}

/* Into how many parts the arc has to be cut: n >= length sqrt(2^bits / (8 q)). */
static dyd_status arc_count_steps(uint32_t *out, const dyd_arc *arc, const dyd_cell_sites *s, uint32_t own,
                                  int64_t bits) {
  *out = 1;
  if (arc->kind != DYD_ARC_PARABOLA) return DYD_OK;
  DYD_LOCAL(parabola, p);
  DYD_LOCAL_NUMBERS(mpq, begin, end, q);
  parabola_set(&p, arc, s, own);
  mpq_sub(q, p.focus[1 - p.along], p.directrix);
  dyd_status st = arc_ends_along(begin, end, arc, p.along, length_bits(q, bits));
  mpq_sub(begin, begin, end);
  return st == DYD_OK ? count_steps(out, begin, q, bits) : st;
}

/* Of a sample, of the polygons that it is a corner of (one at work, its hull or its copy, the inner one while the outer
 * one is made), and of the box of its edge: coordinates of `bits` bits and some more. */
static uint64_t bytes_of_sample(int64_t bits) {
  enum { POLYGONS = 3, BLOCK = 24, MORE = 96 };
  uint64_t digits = (uint64_t)(bits > 0 ? bits + MORE : MORE) / 8 + BLOCK;
  return 2 * sizeof(dyd_arc_sample) + 4 * sizeof(double) + POLYGONS * (sizeof(dyd_point) + 2 * digits);
}

dyd_status dyd_chain_samples(dyd_arc_samples *out, const dyd_chain *chain, const dyd_cell_sites *s, uint32_t own,
                             int64_t bits, dyd_memory *memory) {
  for (size_t k = 0; k < chain->count; k++) {
    const dyd_arc *arc = &chain->arc[k], *before = &chain->arc[k ? k - 1 : chain->count - 1];
    uint32_t steps;
    dyd_status st = arc_count_steps(&steps, arc, s, own, bits);
    if (st != DYD_OK) return st;
    if (out->count + steps > (out->most ? out->most : DYD_MOST_SAMPLES)) return DYD_E_RANGE;
    uint64_t bytes = dyd_bytes_times(out->count + steps, bytes_of_sample(bits));
    if (memory && !dyd_memory_has(memory, bytes, "the corners of a polygon")) return DYD_E_NOMEM;
    if (!DYD_GROW(out->item, out->cap, out->count + steps)) return DYD_E_NOMEM;
    for (uint32_t step = 0; step < steps; step++)
      out->item[out->count++] = (dyd_arc_sample){arc, step ? arc : before, step, steps};
  }
  return DYD_OK;
}

dyd_status dyd_sample_point(dyd_point *out, const dyd_arc_sample *at, const dyd_cell_sites *s, uint32_t own,
                            int64_t bits) {
  if (at->step == 0) return arc_end_point(out, &at->arc->begin, bits);
  DYD_LOCAL(parabola, p);
  DYD_LOCAL_NUMBERS(mpq, t, u);
  parabola_set(&p, at->arc, s, own);
  dyd_status st = arc_ends_along(t, u, at->arc, p.along, bits);
  if (st == DYD_OK) { /* the part number step of steps */
    mpq_sub(u, u, t);
    mpz_mul_ui(mpq_numref(u), mpq_numref(u), at->step);
    mpz_mul_ui(mpq_denref(u), mpq_denref(u), at->steps);
    mpq_canonicalize(u);
    mpq_add(t, t, u);
    parabola_at(u, &p, t);
    st = dyd_dyadic_round_q(p.along ? &out->y : &out->x, t, -(bits + 1), DYD_DOWN);
  }
  if (st == DYD_OK) st = dyd_dyadic_round_q(p.along ? &out->x : &out->y, u, -(bits + 1), DYD_DOWN);
  return st;
}
