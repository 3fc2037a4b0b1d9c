/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A certificate of nearest sites: for each place the sites that may be nearest to it, or the one that is [CERT-12]. */
#include "base/alloc.h"
#include "base/error.h"
#include "checker/checker.h"
#include "checker/near.h"

#include <stdlib.h>
#include <string.h>

#define EFFORT_BITS 16

/* Places being read. list: of the place read last. */
typedef struct places {
  dyd_checker *c;
  dyd_cert_span *span, at;
  uint32_t *list;
  size_t count, cap;
  uint64_t effort;
} places;

/* "i lo hi", hi or "none". */
static dyd_status read_near_site(places *p) {
  dyd_checker *c = p->c;
  uint32_t i;
  dyd_status st = dyd_cert_read_site(&i, c);
  if (st == DYD_OK) st = dyd_cert_read_number(&c->point[0], &c->in);
  if (st != DYD_OK) return st;
  bool none = c->in.at && strncmp(c->in.at, "none", 4) == 0;
  st = none ? dyd_cert_expect_word(c, "none") : dyd_cert_read_number(&c->point[1], &c->in);
  if (st != DYD_OK) return st;
  if (p->count && i <= p->list[p->count - 1]) return dyd_cert_reject(&c->in, "sites are not in order");
  if (!dyd_cert_near_bounds_hold(&p->at, &p->span[i], &c->point[0], none ? NULL : &c->point[1]))
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
  const dyd_cert_near q = {&c->sites, &c->tree, p->span, &p->at, DYD_CERT_NONE, p->list, p->count};
  uint32_t other;
  c->report.places++;
  if (kind == 0) {
    if (p->count != 1) return dyd_cert_reject(&c->in, "one site is certainly nearest");
    if (!dyd_cert_near_is_certain(&other, &q))
      return dyd_cert_reject(&c->in, "site %u may be as near", (unsigned)other);
    c->report.places_certain++;
    return DYD_OK;
  }
  size_t unproved = 0;
  if (p->count) dyd_cert_near_count(&unproved, &other, &p->effort, &q);
  c->report.near_unproved += unproved;
  return note_open_place(p, point);
}

static dyd_status read_near_place(places *p) {
  static const char *const kinds[] = {"c", "p"};
  dyd_checker *c = p->c;
  dyd_cert_sites at;
  size_t kind = 0;
  dyd_cert_sites_init(&at);
  p->count = 0;
  dyd_cert_site *site = dyd_cert_sites_add(&at);
  dyd_status st = site ? dyd_cert_next_line(&c->in) : dyd_fail_nomem(c->in.err);
  if (st == DYD_OK) st = dyd_cert_read_side(&site->side[0], &c->in);
  if (st == DYD_OK) st = dyd_cert_read_side(&site->side[1], &c->in);
  bool point = st == DYD_OK && dyd_cert_is_point(site);
  if (st == DYD_OK) dyd_cert_span_set(&p->at, site);
  dyd_cert_sites_clear(&at);
  if (st == DYD_OK) st = dyd_cert_read_choice(&kind, c, kinds, 2);
  while (st == DYD_OK && dyd_cert_line_has_more(&c->in)) st = read_near_site(p);
  if (st == DYD_OK && !p->count && c->sites.count) st = dyd_cert_reject(&c->in, "some site is nearest");
  return st == DYD_OK ? check_place(p, kind, point) : st;
}

dyd_status dyd_checker_places_near(dyd_checker *c) {
  places p = {.c = c, .effort = ((uint64_t)c->sites.count + 64) << EFFORT_BITS};
  uint32_t count = 0;
  dyd_cert_span_init(&p.at);
  dyd_status st = dyd_cert_expect_line(c, "nearest");
  if (st == DYD_OK) st = dyd_cert_read_index(&count, &c->in, DYD_CERT_NONE);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st == DYD_OK) st = dyd_cert_spans_init(&p.span, &c->sites);
  for (uint32_t k = 0; k < count && st == DYD_OK; k++) st = read_near_place(&p);
  dyd_cert_spans_free(p.span, c->sites.count);
  dyd_cert_span_clear(&p.at);
  free(p.list);
  return st == DYD_E_NOMEM ? dyd_fail_nomem(c->in.err) : st;
}
