/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A certificate of nearest sites: for each place the sites that may be nearest to it, or the one that is [CERT-12]. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "checker/checker.h"
#include "checker/near.h"

#include <stdlib.h>
#include <string.h>

#define EFFORT_BITS 16

/* Places being read. list: of the place read last. On a sphere the compass replaces the spans, and `here` replaces at.
 */
typedef struct places {
  dyd_checker *c;
  dyd_cert_span *span, at;
  dyd_cert_compass compass;
  dyd_cert_region here;
  uint32_t *list;
  size_t count, cap;
  uint64_t effort;
} places;

static size_t places_sites(const places *p) {
  return p->c->globe.stated ? p->compass.count : p->c->sites.count;
}

static bool near_bounds_are_right(const places *p, uint32_t i, const dyd_exact *lo, const dyd_exact *hi) {
  const dyd_checker *c = p->c;
  if (c->globe.stated) return dyd_cert_ground_bounds_hold(&p->here, &p->compass.region[i], lo, hi);
  return dyd_cert_near_bounds_hold(&p->at, &p->span[i], c->disc ? &c->disc[i] : NULL, lo, hi);
}

static dyd_status read_nearest_index(uint32_t *i, places *p) {
  if (!p->c->globe.stated || !p->compass.count) return dyd_cert_read_site(i, p->c);
  dyd_status st = dyd_cert_read_index(i, &p->c->in, p->compass.count - 1);
  if (st != DYD_OK || !p->compass.bowl[*i].alias) return st;
  return dyd_cert_reject(&p->c->in, "place %u is an alias", (unsigned)*i);
}

/* "i lo hi", hi or "none". */
static dyd_status read_near_site(places *p) {
  dyd_checker *c = p->c;
  uint32_t i;
  dyd_status st = read_nearest_index(&i, p);
  if (st == DYD_OK) st = dyd_cert_read_number(&c->point[0], &c->in);
  if (st != DYD_OK) return st;
  bool none = c->in.at && strncmp(c->in.at, "none", 4) == 0;
  st = none ? dyd_cert_expect_word(c, "none") : dyd_cert_read_number(&c->point[1], &c->in);
  if (st != DYD_OK) return st;
  if (p->count && i <= p->list[p->count - 1]) return dyd_cert_reject(&c->in, "sites are not in order");
  if (!near_bounds_are_right(p, i, &c->point[0], none ? NULL : &c->point[1]))
    return dyd_cert_reject(&c->in, "the distance of site %u is not within its bounds", (unsigned)i);
  if (!dyd_reserve((void **)&p->list, &p->cap, p->count + 1, sizeof *p->list)) return dyd_fail_nomem(c->in.err);
  p->list[p->count++] = i;
  return DYD_OK;
}

/* Notes whom the answer to a place that is not certain hangs on. */
static dyd_status note_open_place(places *p, bool point) {
  dyd_checker *c = p->c;
  if (!point) c->near_moves = true;
  for (size_t k = 0; k < p->count; k++) {
    if (!dyd_reserve((void **)&c->near_open, &c->near_cap, c->near_count + 1, sizeof *c->near_open))
      return dyd_fail_nomem(c->in.err);
    c->near_open[c->near_count++] = p->list[k];
  }
  return DYD_OK;
}

/* The list has been read; kind 0: certain. */
static dyd_status check_place(places *p, size_t kind, bool point) {
  dyd_checker *c = p->c;
  const bool globe = c->globe.stated;
  const dyd_cert_near q = {&c->sites, &c->tree, p->span, c->disc, &p->at, DYD_CERT_NONE, p->list, p->count};
  uint32_t other;
  c->report.places++;
  if (kind == 0) {
    if (p->count != 1) return dyd_cert_reject(&c->in, "one site is certainly nearest");
    if (!(globe ? dyd_cert_compass_is_certain(&other, &p->compass, &p->here, p->list[0])
                : dyd_cert_near_is_certain(&other, &q)))
      return dyd_cert_reject(&c->in, "site %u may be as near", (unsigned)other);
    c->report.places_certain++;
    return DYD_OK;
  }
  size_t unproved = 0;
  if (p->count && globe) dyd_cert_compass_count(&c->report.near_unproved, &p->compass, &p->here, p->list, p->count);
  if (p->count && !globe) dyd_cert_near_count(&unproved, &other, &p->effort, &q);
  c->report.near_unproved += unproved;
  return note_open_place(p, point);
}

/* The rectangle that is asked about; *point: it is one. */
static dyd_status read_place_asked(bool *point, places *p) {
  dyd_checker *c = p->c;
  DYD_LOCAL_NUMBERS(mpq, none);
  DYD_LOCAL(dyd_cert_sites, at);
  dyd_cert_site *site = dyd_cert_sites_add(&at);
  dyd_status st = site ? dyd_cert_next_line(&c->in) : dyd_fail_nomem(c->in.err);
  if (st == DYD_OK) st = dyd_cert_read_side(&site->side[0], &c->in);
  if (st == DYD_OK) st = dyd_cert_read_side(&site->side[1], &c->in);
  *point = st == DYD_OK && dyd_cert_is_point(site);
  if (st == DYD_OK) dyd_cert_span_set(&p->at, site);
  if (st == DYD_OK && c->globe.stated && !dyd_cert_region_set(&p->here, site->side, none, none))
    st = dyd_cert_reject(&c->in, "this is no place on the sphere");
  return st;
}

static dyd_status read_near_place(places *p) {
  static const char *const kinds[] = {"c", "p"};
  dyd_checker *c = p->c;
  size_t kind = 0;
  bool point;
  p->count = 0;
  dyd_status st = read_place_asked(&point, p);
  if (st == DYD_OK) st = dyd_cert_read_choice(&kind, c, kinds, 2);
  while (st == DYD_OK && dyd_cert_line_has_more(&c->in)) st = read_near_site(p);
  if (st == DYD_OK && !p->count && places_sites(p)) st = dyd_cert_reject(&c->in, "some site is nearest");
  return st == DYD_OK ? check_place(p, kind, point) : st;
}

/* After "sphere": the places, in degrees, instead of sites. */
static dyd_status read_compass(places *p) {
  dyd_checker *c = p->c;
  dyd_status st = dyd_cert_expect_word(c, "sphere");
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st == DYD_OK && c->sites.count) st = dyd_cert_reject(&c->in, "places on a sphere have no sites of a plane");
  if (st == DYD_OK) st = dyd_checker_globe_places(c);
  if (st == DYD_OK && dyd_cert_compass_init(&p->compass, c->globe.place.count) != DYD_OK)
    st = dyd_fail_nomem(c->in.err);
  for (uint32_t i = 0; st == DYD_OK && i < p->compass.count; i++) {
    if (!dyd_cert_globe_region(&p->compass.region[i], &c->globe, i))
      return dyd_cert_reject(&c->in, "place %u is no place with a radius on the sphere", (unsigned)i);
    dyd_cert_compass_note(&p->compass, i, c->globe.place.site[i].alias != i);
  }
  return st;
}

/* The lines before "nearest", and this one, up to its first word. */
static dyd_status read_before_nearest(places *p) {
  dyd_checker *c = p->c;
  dyd_status st = dyd_cert_next_line(&c->in);
  bool discs = st == DYD_OK && strncmp(c->in.line, "discs", 5) == 0,
       globe = st == DYD_OK && strncmp(c->in.line, "sphere", 6) == 0;
  if (discs) st = dyd_checker_read_discs(c);
  if (globe) st = read_compass(p);
  return st == DYD_OK && (discs || globe) ? dyd_cert_next_line(&c->in) : st;
}

dyd_status dyd_checker_places_near(dyd_checker *c) {
  places p = {.c = c, .effort = ((uint64_t)c->sites.count + 64) << EFFORT_BITS};
  uint32_t count = 0;
  dyd_cert_span_init(&p.at);
  dyd_cert_region_init(&p.here);
  dyd_status st = read_before_nearest(&p);
  if (st == DYD_OK) st = dyd_cert_expect_word(c, "nearest");
  if (st == DYD_OK) st = dyd_cert_read_index(&count, &c->in, DYD_CERT_NONE);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st == DYD_OK) st = dyd_cert_spans_init(&p.span, &c->sites);
  for (uint32_t k = 0; k < count && st == DYD_OK; k++) st = read_near_place(&p);
  dyd_cert_spans_free(p.span, c->sites.count);
  dyd_cert_compass_clear(&p.compass);
  dyd_cert_region_clear(&p.here);
  dyd_cert_span_clear(&p.at);
  free(p.list);
  return st == DYD_E_NOMEM ? dyd_fail_nomem(c->in.err) : st;
}
