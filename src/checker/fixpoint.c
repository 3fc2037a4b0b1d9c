/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Can nothing that is narrowed change what a pair is [CERT-8]?
 *
 * Of an open pair both sites have to stay, and nobody who may be narrowed may be in a possible pair with both. Where
 * one of the two is no point that is not enough: an edge of every choice need not have a witness, and may get one when
 * a neighbour of one site is narrowed. Then nobody may be in a possible pair with either; so neither of the two may be
 * narrowed, who are in a pair with each other. (A point may be: it stays.) */
#include "base/alloc.h"
#include "checker/by_key.h"
#include "checker/checker.h"

#include <stdlib.h>
#include <string.h>

/* movable[i]: site i, or an alias of it, may be narrowed. Site i is listed in pairs with such sites
 * of[start[i] .. start[i + 1]). */
typedef struct movers {
  bool *movable;
  size_t *start;
  uint32_t *of;
} movers;

static void movers_clear(movers *m) {
  free(m->movable);
  free(m->start);
  free(m->of);
}

/* Puts at entry[count ..], for both ends of each pair, who is at the other one and may be narrowed; returns how many
 * there are then. */
static size_t movers_add(dyd_cert_entry *entry, size_t count, const movers *m, const dyd_cert_edges *edges) {
  for (size_t e = 0; e < edges->count; e++) {
    const dyd_cert_edge *p = &edges->item[e];
    if (m->movable[p->j]) entry[count++] = (dyd_cert_entry){p->i, p->j};
    if (m->movable[p->i]) entry[count++] = (dyd_cert_entry){p->j, p->i};
  }
  return count;
}

static dyd_status movers_list(movers *m, const dyd_checker *c) {
  size_t ends = 2 * (c->legal.count + c->open.count);
  dyd_cert_entry *entry = dyd_alloc(ends, sizeof *entry);
  m->start = dyd_alloc(c->sites.count + 1, sizeof *m->start);
  m->of = dyd_alloc(ends, sizeof *m->of);
  bool good = entry && m->start && m->of;
  if (good) {
    size_t count = movers_add(entry, 0, m, &c->legal);
    count = movers_add(entry, count, m, &c->open);
    dyd_cert_by_key(m->start, m->of, c->sites.count, entry, count);
  }
  free(entry);
  return good ? DYD_OK : DYD_E_NOMEM;
}

static size_t movers_of(const uint32_t **of, const movers *m, uint32_t i) {
  *of = m->of + m->start[i];
  return m->start[i + 1] - m->start[i];
}

static bool is_in_a_pair(const dyd_checker *c, uint32_t i, uint32_t j) {
  uint32_t a = i < j ? i : j, b = i < j ? j : i;
  return dyd_cert_edges_have(&c->legal, a, b) || dyd_cert_edges_have(&c->open, a, b);
}

static bool open_pair_stays(const dyd_checker *c, const movers *m, uint32_t i, uint32_t j) {
  const uint32_t *of, *other;
  size_t count = movers_of(&of, m, i), others = movers_of(&other, m, j);
  if (!count && !others) return true;
  if (!dyd_cert_is_point(&c->sites.site[i]) || !dyd_cert_is_point(&c->sites.site[j])) return false;
  if (others < count) return open_pair_stays(c, m, j, i);
  for (size_t k = 0; k < count; k++)
    if (is_in_a_pair(c, of[k], j)) return false;
  return true;
}

/* Of the triangulation; all possible pairs are listed. */
static bool open_pairs_stay(const dyd_checker *c, const movers *m) {
  for (size_t e = 0; e < c->open.count; e++) {
    const dyd_cert_edge *p = &c->open.item[e];
    if (!dyd_cert_faces_tied(&c->faces, p->i, p->j) && !dyd_cert_faces_still(&c->faces, p->i, p->j) &&
        !open_pair_stays(c, m, p->i, p->j))
      return false;
  }
  return true;
}

/* Of places: who is nearest to one is decided by those listed there. */
static bool places_stay(const dyd_checker *c, const movers *m) {
  bool stay = !c->near_moves && !c->report.near_unproved;
  for (size_t k = 0; k < c->near_count && stay; k++) stay = !m->movable[c->near_open[k]];
  return stay;
}

dyd_status dyd_checker_stays(bool *out, const dyd_checker *c, const bool *still) {
  const dyd_certificate_report *r = &c->report;
  bool all = true, of_pairs = strcmp(r->goal, "decided") == 0 && !r->unproved && !r->capped && !r->discs;
  *out = r->discs_fixed && !still && !c->near_moves && !r->near_unproved;
  if (*out) return DYD_OK;
  const bool nearest = strcmp(r->goal, "nearest") == 0;
  const dyd_cert_sites *sites = nearest && c->globe.stated ? &c->globe.place : &c->sites;
  movers m = {.movable = calloc(sites->count ? sites->count : 1, sizeof *m.movable)};
  if (!m.movable) return DYD_E_NOMEM;
  for (size_t i = 0; i < sites->count; i++) {
    if (still ? still[i] : dyd_cert_is_point(&sites->site[i])) continue;
    m.movable[sites->site[i].alias] = true;
    all = false;
  }
  *out = nearest ? places_stay(c, &m) : all;
  dyd_status st = !all && of_pairs ? movers_list(&m, c) : DYD_OK;
  if (st == DYD_OK && !all && of_pairs) *out = open_pairs_stay(c, &m);
  movers_clear(&m);
  return st;
}
