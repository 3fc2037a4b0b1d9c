/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Can nothing that is narrowed change what a pair is [CERT-8]?
 *
 * Of an open pair both sites have to stay, and nobody who may be narrowed may be in a possible pair with both. Where
 * one of the two is no point that is not enough: an edge of every choice need not have a witness, and may get one when
 * a neighbour of one site is narrowed. Then nobody may be in a possible pair with either; so neither of the two may be
 * narrowed, who are in a pair with each other. (A point may be: it stays.) */
#include "base/alloc.h"
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

/* Counts in start[i + 2], so that filling leaves start[i] where the list of i begins. */
static void movers_count(movers *m, const dyd_cert_edges *edges) {
  for (size_t e = 0; e < edges->count; e++) {
    const dyd_cert_edge *p = &edges->item[e];
    if (m->movable[p->j]) m->start[p->i + 2]++;
    if (m->movable[p->i]) m->start[p->j + 2]++;
  }
}

static void movers_fill(movers *m, const dyd_cert_edges *edges) {
  for (size_t e = 0; e < edges->count; e++) {
    const dyd_cert_edge *p = &edges->item[e];
    if (m->movable[p->j]) m->of[m->start[p->i + 1]++] = p->j;
    if (m->movable[p->i]) m->of[m->start[p->j + 1]++] = p->i;
  }
}

static dyd_status movers_list(movers *m, const dyd_checker *c) {
  size_t n = c->sites.count;
  m->start = calloc(n + 2, sizeof *m->start);
  if (!m->start) return DYD_E_NOMEM;
  movers_count(m, &c->legal);
  movers_count(m, &c->open);
  for (size_t i = 1; i < n + 2; i++) m->start[i] += m->start[i - 1];
  m->of = dyd_alloc(m->start[n + 1], sizeof *m->of);
  if (!m->of) return DYD_E_NOMEM;
  movers_fill(m, &c->legal);
  movers_fill(m, &c->open);
  return DYD_OK;
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
    if (!dyd_cert_faces_still(&c->faces, p->i, p->j) && !open_pair_stays(c, m, p->i, p->j)) return false;
  }
  return true;
}

dyd_status dyd_checker_stays(bool *out, const dyd_checker *c, const bool *still) {
  const dyd_certificate_report *r = &c->report;
  bool all = true, of_pairs = strcmp(r->goal, "decided") == 0 && !r->unproved && !r->capped;
  movers m = {.movable = calloc(c->sites.count ? c->sites.count : 1, sizeof *m.movable)};
  if (!m.movable) return DYD_E_NOMEM;
  for (size_t i = 0; i < c->sites.count; i++) {
    if (still ? still[i] : dyd_cert_is_point(&c->sites.site[i])) continue;
    m.movable[c->sites.site[i].alias] = true;
    all = false;
  }
  *out = all;
  dyd_status st = !all && of_pairs ? movers_list(&m, c) : DYD_OK;
  if (st == DYD_OK && !all && of_pairs) *out = open_pairs_stay(c, &m);
  movers_clear(&m);
  return st;
}
