/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rectangles as they are, and as they would be after measuring. */
#include "base/alloc.h"
#include "tolerance/roots.h"
#include "tolerance/survey.h"

static void load_site(dyd_survey_site *p) {
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  dyd_interval_get_q(lo, hi, &p->rect.x);
  mpq_add(p->x, lo, hi);
  mpq_sub(p->half, hi, lo);
  dyd_interval_get_q(lo, hi, &p->rect.y);
  mpq_add(p->y, lo, hi);
  mpq_sub(hi, hi, lo);
  if (mpq_cmp(hi, p->half) > 0) mpq_set(p->half, hi);
  mpq_div_2exp(p->x, p->x, 1);
  mpq_div_2exp(p->y, p->y, 1);
  mpq_div_2exp(p->half, p->half, 1);
  mpq_clears(lo, hi, NULL);
}

/* Of each site its rectangle, centre and half-width, twelve numbers: with their digits, and what allocators add. */
static bool survey_has_room(dyd_survey *s, size_t sites) {
  enum { NUMBERS = 12, BLOCK = 32 };
  uint64_t bytes = dyd_bytes_times(sites, sizeof *s->site + NUMBERS * BLOCK);
  if (!dyd_room_has(&s->room, bytes, "the plan")) return false;
  s->room.held += bytes;
  return true;
}

dyd_status dyd_survey_load(dyd_survey *s, const dyd_sites *sites) {
  if (!survey_has_room(s, dyd_sites_count(sites))) return DYD_E_NOMEM;
  s->site = dyd_alloc(dyd_sites_count(sites), sizeof *s->site);
  if (!s->site) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  for (size_t i = 0; i < dyd_sites_count(sites) && st == DYD_OK; i++) {
    dyd_survey_site *p = &s->site[s->sites++];
    dyd_rect_init(&p->rect);
    mpq_inits(p->x, p->y, p->half, NULL);
    p->chosen = false;
    p->coarser = 0;
    st = dyd_sites_get(&p->rect, sites, i);
    if (st == DYD_OK) load_site(p);
  }
  return st;
}

/* min(scale 2^coarser unit, half) */
static void accuracy_of(mpq_ptr out, const dyd_survey *s, uint32_t i) {
  const dyd_survey_site *p = &s->site[i];
  mpq_mul(out, s->scale, s->options.accuracy ? s->options.accuracy : p->half);
  mpq_mul_2exp(out, out, p->coarser);
  if (mpq_cmp(out, p->half) > 0) mpq_set(out, p->half);
}

/* The part of the side within a of the centre; rounded outward, so that the plan never says less than is needed. */
static dyd_status cut_to_accuracy(dyd_interval *side, mpq_srcptr centre, mpq_srcptr a, mpq_t end[2]) {
  dyd_interval near;
  if (dyd_interval_is_point(side)) return DYD_OK;
  dyd_interval_init(&near);
  mpq_sub(end[0], centre, a);
  mpq_add(end[1], centre, a);
  int64_t bits = dyd_interval_bits(side);
  dyd_status st = dyd_interval_set_outward(&near, end[0], end[1], -bits - 120);
  if (st == DYD_OK) st = dyd_interval_intersect(side, side, &near);
  dyd_interval_clear(&near);
  return st;
}

dyd_status dyd_survey_rect(dyd_rect *out, const dyd_survey *s, uint32_t i, bool measured) {
  const dyd_survey_site *p = &s->site[i];
  dyd_rect_set(out, &p->rect);
  if (!measured) return DYD_OK;
  mpq_t a, end[2];
  mpq_inits(a, end[0], end[1], NULL);
  accuracy_of(a, s, i);
  dyd_status st = cut_to_accuracy(&out->x, p->x, a, end);
  if (st == DYD_OK) st = cut_to_accuracy(&out->y, p->y, a, end);
  mpq_clears(a, end[0], end[1], NULL);
  return st;
}

dyd_status dyd_survey_triangulate(dyd_delaunay **pd, dyd_sites **sites, const dyd_survey *s, bool centres) {
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = s->options.cancel};
  dyd_room room = s->room;
  dyd_error err = {0};
  dyd_rect r;
  dyd_rect_init(&r);
  *pd = NULL;
  dyd_status st = dyd_sites_new(sites);
  for (uint32_t i = 0; i < s->sites && st == DYD_OK; i++) {
    st = centres ? dyd_rect_set_q(&r, s->site[i].x, s->site[i].y) : dyd_survey_rect(&r, s, i, s->site[i].chosen);
    if (st == DYD_OK) st = dyd_sites_add_rect(*sites, &r);
  }
  if (room.most && st == DYD_OK) room.beside = dyd_sites_memory(*sites);
  o.max_bytes = dyd_room_left(&room);
  if (st == DYD_OK) st = dyd_delaunay_new(pd, *sites, &o, &err);
  dyd_rect_clear(&r);
  if (s->err && st < 0 && err.code == st) *s->err = err;
  return st == DYD_CAPPED ? DYD_OK : st;
}

bool dyd_survey_is_open(const dyd_delaunay *pd, const dyd_pair *p) {
  dyd_pair_status status = dyd_delaunay_status(pd, p->i, p->j);
  return status == DYD_INDETERMINATE || status == DYD_TIE;
}

size_t dyd_survey_open(const dyd_survey *s, const dyd_delaunay *pd) {
  size_t open = 0;
  for (size_t k = 0; k < s->target.count; k++) open += dyd_survey_is_open(pd, &s->target.item[k]);
  return open;
}

double dyd_survey_needed(const dyd_survey *s, uint32_t i) {
  mpq_t a;
  mpq_init(a);
  accuracy_of(a, s, i);
  double out = dyd_q_double(a, 0);
  mpq_clear(a);
  return out;
}

double dyd_survey_now(const dyd_survey *s, uint32_t i) {
  return dyd_q_double(s->site[i].half, 1);
}
