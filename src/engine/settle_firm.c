/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Firm rectangles: fixed, and wider both ways than twice what is not known of sides that can be narrowed [SET-2]. */
#include "engine/settle_firm.h"

#include "engine/points.h"
#include "stream/stream.h"

/* Sides of r that are fixed, or those that are not, become their lower ends. */
static dyd_status rect_collapse(dyd_rect *r, const bool fixed[2], bool which) {
  dyd_interval *side[2] = {&r->x, &r->y};
  dyd_status st = DYD_OK;
  for (int a = 0; st == DYD_OK && a < 2; a++)
    if (fixed[a] == which && !dyd_interval_is_point(side[a]))
      st = dyd_interval_set_ends(side[a], &side[a]->lo, &side[a]->lo);
  return st;
}

/* Is a side of a point that x gives one that never changes again? Another user of x may have narrowed it for good
 * since. A side that was measured again, or is joined with another one, is narrower than x, and only x is asked for
 * more. */
static bool side_is_final(const dyd_real *x, const dyd_interval *side) {
  return dyd_real_is_final(x) && dyd_interval_contains(dyd_real_interval(x), side);
}

void dyd_site_fixed_sides(bool fixed[2], const dyd_engine *e, uint32_t site, const dyd_rect *r) {
  const dyd_refinable *p = dyd_engine_find(e, site);
  const void *pair;
  fixed[0] = fixed[1] = !p || p->final;
  if (fixed[0] || !p->stream || dyd_stream_object(&pair, p->stream) != DYD_STREAM_PAIR) return;
  fixed[0] = side_is_final(((const dyd_stream_pair *)pair)->x, &r->x);
  fixed[1] = side_is_final(((const dyd_stream_pair *)pair)->y, &r->y);
}

dyd_status dyd_firm_eps(dyd_dyadic *eps, const dyd_engine *e) {
  int64_t least = INT64_MAX / 2;
  dyd_status st = DYD_OK;
  dyd_rect r;
  dyd_rect_init(&r);
  for (size_t k = 0; st == DYD_OK && k < e->points; k++) {
    bool fixed[2];
    if (e->point[k].final) continue;
    st = dyd_sites_get(&r, e->sites, e->point[k].site);
    dyd_site_fixed_sides(fixed, e, e->point[k].site, &r);
    if (st == DYD_OK) st = rect_collapse(&r, fixed, true);
    int64_t bits = dyd_rect_bits(&r);
    if (bits < least) least = bits;
  }
  dyd_rect_clear(&r);
  return st == DYD_OK ? dyd_dyadic_set_si_2exp(eps, 1, 1 - least) : st; /* widths of 2^-b, a diameter below 2^(1-b) */
}

/* *out, unless it is NULL: a, smaller by eps on each side. *can: is it wide enough? */
static dyd_status side_shrink(dyd_interval *out, bool *can, const dyd_interval *a, const dyd_dyadic *eps) {
  dyd_dyadic lo, hi;
  dyd_dyadic_init(&lo);
  dyd_dyadic_init(&hi);
  dyd_status st = dyd_dyadic_add(&lo, &a->lo, eps);
  if (st == DYD_OK) st = dyd_dyadic_sub(&hi, &a->hi, eps);
  *can = st == DYD_OK && !dyd_interval_is_point(a) && dyd_dyadic_cmp(&lo, &hi) < 0;
  if (*can && out) st = dyd_interval_set_ends(out, &lo, &hi);
  dyd_dyadic_clear(&hi);
  dyd_dyadic_clear(&lo);
  return st;
}

dyd_status dyd_firm_shrink(dyd_rect *out, bool *can, const dyd_rect *r, const dyd_dyadic *eps) {
  bool wide[2] = {false, false};
  dyd_rect s;
  dyd_rect_init(&s);
  dyd_status st = side_shrink(&s.x, &wide[0], &r->x, eps);
  if (st == DYD_OK) st = side_shrink(&s.y, &wide[1], &r->y, eps);
  *can = st == DYD_OK && wide[0] && wide[1];
  if (*can && out) dyd_rect_swap(out, &s);
  dyd_rect_clear(&s);
  return st;
}

bool dyd_site_is_fixed(const dyd_engine *e, uint32_t site) {
  const dyd_refinable *p = dyd_engine_find(e, site);
  return !p || p->final;
}

dyd_status dyd_pair_is_firm(bool *out, const dyd_engine *e, const dyd_dyadic *eps, const dyd_pair *pair) {
  const uint32_t end[2] = {pair->i, pair->j};
  dyd_status st = DYD_OK;
  dyd_rect r;
  *out = dyd_site_is_fixed(e, pair->i) && dyd_site_is_fixed(e, pair->j);
  dyd_rect_init(&r);
  for (int k = 0; st == DYD_OK && *out && k < 2; k++) {
    st = dyd_sites_get(&r, e->sites, end[k]);
    if (st == DYD_OK) st = dyd_firm_shrink(NULL, out, &r, eps);
  }
  dyd_rect_clear(&r);
  return st;
}

dyd_status dyd_firm_add(dyd_sites *sites, const dyd_engine *e, const dyd_dyadic *eps, uint32_t k) {
  dyd_rect r;
  bool firm = false;
  dyd_rect_init(&r);
  dyd_status st = dyd_sites_get(&r, e->sites, k);
  if (st == DYD_OK && dyd_site_is_fixed(e, k)) {
    st = dyd_firm_shrink(&r, &firm, &r, eps);
  } else if (st == DYD_OK) {
    bool fixed[2];
    dyd_site_fixed_sides(fixed, e, k, &r);
    st = rect_collapse(&r, fixed, false);
  }
  if (st == DYD_OK) st = dyd_sites_add_rect(sites, &r);
  dyd_rect_clear(&r);
  return st;
}
