/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cores [SET-3], and firm ones: wider both ways than twice the unknown width of sides without a core [SET-2]. */
#include "base/local.h"
#include "engine/points.h"
#include "engine/settle.h"
#include "rect/rect.h"
#include "stream/stream.h"

/* Sides of r that have a core, or sides without one, become their lower ends. */
static void rect_collapse(dyd_rect *r, const bool core[2], bool which) {
  dyd_interval *side[2] = {&r->x, &r->y};
  for (int a = 0; a < 2; a++)
    if (core[a] == which && !dyd_interval_is_point(side[a])) dyd_interval_set_over(side[a], &side[a]->lo, side[a]->den);
}

dyd_status dyd_site_get_core(dyd_rect *r, bool core[2], const dyd_engine *e, uint32_t site) {
  const dyd_refinable *p = dyd_engine_find(e, site);
  core[0] = core[1] = !p || p->final;
  dyd_status st = dyd_sites_get(r, e->sites, site);
  return st == DYD_OK && !core[0] && p->stream ? dyd_stream_core(r, core, p->stream, p->measured) : st;
}

/* Raises *eps to the largest difference of two points of r along sides without a core. */
static dyd_status eps_raise(dyd_dyadic *eps, const dyd_rect *r, const bool core[2]) {
  DYD_LOCAL(dyd_dyadic, more);
  DYD_LOCAL(dyd_rect, rest);
  dyd_rect_set(&rest, r);
  dyd_status st = DYD_OK;
  rect_collapse(&rest, core, true);
  if (!dyd_rect_is_point(&rest)) /* widths of 2^-b, a diameter below 2^(1-b) */
    st = dyd_dyadic_set_si_2exp(&more, 1, 1 - dyd_rect_bits(&rest));
  if (dyd_dyadic_cmp(&more, eps) > 0) dyd_dyadic_swap(&more, eps);
  return st;
}

dyd_status dyd_firm_raise(dyd_dyadic *eps, const dyd_engine *e, uint32_t site) {
  bool core[2];
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_site_get_core(&r, core, e, site);
  return st == DYD_OK ? eps_raise(eps, &r, core) : st;
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
  if (st == DYD_OK) rect_collapse(out, core, false);
  return st;
}

/* a becomes smaller by eps on each side, if it is wide enough: *can. */
static dyd_status side_shrink(dyd_interval *a, bool *can, const dyd_dyadic *eps) {
  DYD_LOCAL_NUMBERS(mpq, lo, hi, by);
  dyd_interval_get_q(lo, hi, a);
  dyd_dyadic_get_q(by, eps);
  mpq_add(lo, lo, by);
  mpq_sub(hi, hi, by);
  *can = !dyd_interval_is_point(a) && mpq_cmp(lo, hi) < 0;
  return *can ? dyd_interval_set_ends_q(a, lo, hi) : DYD_OK;
}

/* Sets *r to the core of a site: less eps on each side if it is firm, all of it if a side is too narrow for that, and a
 * point instead of each side that has no core. */
static dyd_status site_get_firm(dyd_rect *r, bool *firm, const dyd_engine *e, const dyd_dyadic *eps, uint32_t site) {
  bool core[2], wide[2] = {false, false};
  *firm = false;
  dyd_status st = dyd_site_get_core(r, core, e, site);
  if (st != DYD_OK) return st;
  if (!core[0] || !core[1]) return rect_collapse(r, core, false), DYD_OK;
  DYD_LOCAL(dyd_rect, s);
  dyd_rect_set(&s, r);
  st = side_shrink(&s.x, &wide[0], eps);
  if (st == DYD_OK) st = side_shrink(&s.y, &wide[1], eps);
  *firm = st == DYD_OK && wide[0] && wide[1];
  if (*firm) dyd_rect_swap(r, &s);
  return st;
}

dyd_status dyd_firm_pair(bool *out, const dyd_engine *e, const dyd_dyadic *eps, const dyd_pair *pair) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = site_get_firm(&r, out, e, eps, pair->i);
  if (st == DYD_OK && *out) st = site_get_firm(&r, out, e, eps, pair->j);
  return st;
}

dyd_status dyd_firm_rect(dyd_rect *out, const void *sites, size_t k) {
  const dyd_firm_sites *s = sites;
  return site_get_firm(out, &s->firm[k], s->e, s->eps, s->site ? s->site[k] : (uint32_t)k);
}
