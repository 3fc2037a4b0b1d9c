/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How coarse the sites of a face are, compared with the distances to their neighbours.
 *
 * Whether a disc through some sites holds another depends on all of them about equally, each relative to its distance
 * from the nearest one. So a pair of points 2^-200 apart has to be known to 200 bits more than the points around it:
 * as long as two rectangles meet, no disc can hold one and avoid the other, and refining the rest is in vain.
 *
 * All this only chooses what to refine; what is stated does not depend on it. */
#include "engine/coarse.h"

#include "base/alloc.h"
#include "base/index.h"
#include <stdlib.h>

/* How many sites that follow in the order of x are looked at. */
#define NEXT 4

/* ---- exponents ---- */

/* The exponent of hi - lo for ends of intervals; INT64_MIN unless it is positive. */
static dyd_status exponent_above(int64_t *out, const dyd_interval *low, bool low_end_up, const dyd_interval *high,
                                 bool high_end_up) {
  dyd_status st = DYD_OK;
  *out = INT64_MIN;
  if (mpz_cmp_ui(low->den, 1) == 0 && mpz_cmp_ui(high->den, 1) == 0) {
    dyd_dyadic d;
    dyd_dyadic_init(&d);
    st = dyd_dyadic_sub(&d, high_end_up ? &high->hi : &high->lo, low_end_up ? &low->hi : &low->lo);
    if (st == DYD_OK && dyd_dyadic_sgn(&d) > 0) *out = d.exp + (int64_t)mpz_sizeinbase(d.man, 2);
    dyd_dyadic_clear(&d);
    return st;
  }
  mpq_t a[2], b[2];
  mpq_inits(a[0], a[1], b[0], b[1], (mpq_ptr)0);
  dyd_interval_get_q(a[0], a[1], low);
  dyd_interval_get_q(b[0], b[1], high);
  mpq_sub(a[0], b[high_end_up], a[low_end_up]);
  if (mpq_sgn(a[0]) > 0)
    *out = (int64_t)mpz_sizeinbase(mpq_numref(a[0]), 2) - (int64_t)mpz_sizeinbase(mpq_denref(a[0]), 2) + 1;
  mpq_clears(a[0], a[1], b[0], b[1], (mpq_ptr)0);
  return st;
}

/* Raises *out to the exponent of one of the two differences of ends, where it is larger. */
static dyd_status exponent_raise(int64_t *out, const dyd_interval *low, bool low_end_up, const dyd_interval *high,
                                 bool high_end_up) {
  int64_t e;
  dyd_status st = exponent_above(&e, low, low_end_up, high, high_end_up);
  if (st == DYD_OK && e > *out) *out = e;
  return st;
}

static dyd_status coarse_find_width(dyd_coarse_site *s) {
  s->width = INT64_MIN;
  dyd_status st = exponent_raise(&s->width, &s->rect.x, false, &s->rect.x, true);
  return st != DYD_OK ? st : exponent_raise(&s->width, &s->rect.y, false, &s->rect.y, true);
}

/* Lets two sites know of one another. */
static dyd_status coarse_meet(dyd_coarse_site *a, dyd_coarse_site *b) {
  int64_t e = a->width > b->width ? a->width : b->width;
  const dyd_interval *side[2][2] = {{&a->rect.x, &b->rect.x}, {&a->rect.y, &b->rect.y}};
  dyd_status st = DYD_OK;
  for (int k = 0; st == DYD_OK && k < 2; k++) {
    st = exponent_raise(&e, side[k][0], true, side[k][1], false);
    if (st == DYD_OK) st = exponent_raise(&e, side[k][1], true, side[k][0], false);
  }
  if (st != DYD_OK || e == INT64_MIN) return st;
  if (e < a->scale) a->scale = e;
  if (e < b->scale) b->scale = e;
  return DYD_OK;
}

/* ---- faces ---- */

static dyd_coarse_site *coarse_find(const dyd_coarse *c, uint32_t site) {
  const uint32_t *at = dyd_find_index(&site, c->sites.item, c->sites.count, sizeof site);
  return at ? &c->item[at - c->sites.item] : NULL;
}

static dyd_status coarse_fetch(dyd_coarse *c, const dyd_delaunay *pd, size_t f) {
  bool outer;
  dyd_status st = dyd_delaunay_face(&c->sites, &outer, pd, f);
  if (st != DYD_OK) return st;
  c->item = dyd_alloc(c->sites.count, sizeof *c->item);
  if (!c->item) return DYD_E_NOMEM;
  for (size_t k = 0; k < c->sites.count; k++) {
    dyd_rect_init(&c->item[k].rect);
    c->item[k].scale = INT64_MAX;
  }
  for (size_t k = 0; st == DYD_OK && k < c->sites.count; k++) {
    st = dyd_sites_get(&c->item[k].rect, dyd_delaunay_sites(pd), c->sites.item[k]);
    if (st == DYD_OK) st = coarse_find_width(&c->item[k]);
  }
  return st;
}

/* By left ends, then by lower ends; equal ones by their place, so that the order is always the same. */
static int coarse_compare_place(const void *a, const void *b) {
  const dyd_coarse_site *s = *(dyd_coarse_site *const *)a, *t = *(dyd_coarse_site *const *)b;
  int c = dyd_dyadic_cmp(&s->rect.x.lo, &t->rect.x.lo);
  if (c == 0) c = dyd_dyadic_cmp(&s->rect.y.lo, &t->rect.y.lo);
  return c ? c : (s > t) - (s < t);
}

static dyd_status coarse_meet_next(dyd_coarse *c) {
  dyd_status st = DYD_OK;
  dyd_coarse_site **order = dyd_alloc(c->sites.count, sizeof *order);
  if (!order) return DYD_E_NOMEM;
  for (size_t k = 0; k < c->sites.count; k++) order[k] = &c->item[k];
  qsort(order, c->sites.count, sizeof *order, coarse_compare_place);
  for (size_t k = 0; k < c->sites.count; k++)
    for (size_t l = k + 1; st == DYD_OK && l < c->sites.count && l <= k + NEXT; l++)
      st = coarse_meet(order[k], order[l]);
  free(order);
  return st;
}

dyd_status dyd_coarse_set(dyd_coarse *out, const dyd_delaunay *pd, size_t f, const dyd_pair_list *pairs) {
  dyd_status st = coarse_fetch(out, pd, f);
  for (size_t k = 0; st == DYD_OK && k < pairs->count; k++) {
    dyd_coarse_site *a = coarse_find(out, pairs->item[k].i), *b = coarse_find(out, pairs->item[k].j);
    if (a && b) st = coarse_meet(a, b);
  }
  return st != DYD_OK ? st : coarse_meet_next(out);
}

void dyd_coarse_clear(dyd_coarse *c) {
  for (size_t k = 0; c->item && k < c->sites.count; k++) dyd_rect_clear(&c->item[k].rect);
  free(c->item);
  dyd_index_list_clear(&c->sites);
  *c = (dyd_coarse){0};
}

int64_t dyd_coarse_bits(const dyd_coarse *c, uint32_t site) {
  const dyd_coarse_site *s = coarse_find(c, site);
  if (!s || s->width == INT64_MIN || s->scale == INT64_MAX) return INT64_MAX;
  return s->scale - s->width;
}
