/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cores [SET-3], and firm ones: wider both ways than twice what is not known of sides without a core [SET-2]. */
#include "engine/settle_firm.h"

#include "engine/points.h"
#include "stream/real.h"
#include "stream/stream.h"

/* Sides of r that have a core, or those that have none, become their lower ends. */
static dyd_status rect_collapse(dyd_rect *r, const bool core[2], bool which) {
  dyd_interval *side[2] = {&r->x, &r->y};
  dyd_status st = DYD_OK;
  for (int a = 0; st == DYD_OK && a < 2; a++)
    if (core[a] == which && !dyd_interval_is_point(side[a]))
      st = dyd_interval_set_ends(side[a], &side[a]->lo, &side[a]->lo);
  return st;
}

dyd_status dyd_site_get_core(dyd_rect *r, bool core[2], const dyd_engine *e, uint32_t site) {
  const dyd_refinable *p = dyd_engine_find(e, site);
  core[0] = core[1] = !p || p->final;
  dyd_status st = dyd_sites_get(r, e->sites, site);
  return st == DYD_OK && !core[0] && p->stream ? dyd_stream_core(r, core, p->stream, p->measured) : st;
}

/* Raises *eps to what two points of r may differ by along sides without a core. */
static dyd_status eps_raise(dyd_dyadic *eps, const dyd_rect *r, const bool core[2]) {
  dyd_dyadic more;
  dyd_rect rest;
  dyd_dyadic_init(&more);
  dyd_rect_init(&rest);
  dyd_rect_set(&rest, r);
  dyd_status st = rect_collapse(&rest, core, true);
  if (st == DYD_OK && !dyd_rect_is_point(&rest)) /* widths of 2^-b, a diameter below 2^(1-b) */
    st = dyd_dyadic_set_si_2exp(&more, 1, 1 - dyd_rect_bits(&rest));
  if (dyd_dyadic_cmp(&more, eps) > 0) dyd_dyadic_swap(&more, eps);
  dyd_rect_clear(&rest);
  dyd_dyadic_clear(&more);
  return st;
}

dyd_status dyd_firm_raise(dyd_dyadic *eps, const dyd_engine *e, uint32_t site) {
  bool core[2];
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = dyd_site_get_core(&r, core, e, site);
  if (st == DYD_OK) st = eps_raise(eps, &r, core);
  dyd_rect_clear(&r);
  return st;
}

dyd_status dyd_firm_eps(dyd_dyadic *eps, const dyd_engine *e) {
  dyd_status st = dyd_dyadic_set_si_2exp(eps, 0, 0);
  for (size_t k = 0; st == DYD_OK && k < e->points; k++)
    if (!e->point[k].final) st = dyd_firm_raise(eps, e, e->point[k].site);
  return st;
}

dyd_status dyd_firm_place(dyd_rect *out, dyd_dyadic *eps, const dyd_stream *at) {
  bool core[2] = {false, false};
  dyd_rect_set(out, dyd_stream_rect(at));
  dyd_status st = dyd_stream_core(out, core, at, false);
  if (st == DYD_OK) st = eps_raise(eps, out, core);
  return st == DYD_OK ? rect_collapse(out, core, false) : st;
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

dyd_status dyd_pair_is_firm(bool *out, const dyd_engine *e, const dyd_dyadic *eps, const dyd_pair *pair) {
  const uint32_t end[2] = {pair->i, pair->j};
  dyd_status st = DYD_OK;
  dyd_rect r;
  *out = true;
  dyd_rect_init(&r);
  for (int k = 0; st == DYD_OK && *out && k < 2; k++) {
    bool core[2];
    st = dyd_site_get_core(&r, core, e, end[k]);
    *out = core[0] && core[1];
    if (st == DYD_OK && *out) st = dyd_firm_shrink(NULL, out, &r, eps);
  }
  dyd_rect_clear(&r);
  return st;
}

dyd_status dyd_firm_add(dyd_sites *sites, bool *firm, const dyd_engine *e, const dyd_dyadic *eps, uint32_t k) {
  dyd_rect r;
  bool core[2];
  *firm = false;
  dyd_rect_init(&r);
  dyd_status st = dyd_site_get_core(&r, core, e, k);
  if (st == DYD_OK && core[0] && core[1])
    st = dyd_firm_shrink(&r, firm, &r, eps);
  else if (st == DYD_OK)
    st = rect_collapse(&r, core, false);
  if (st == DYD_OK) st = dyd_sites_add_rect(sites, &r);
  dyd_rect_clear(&r);
  return st;
}
