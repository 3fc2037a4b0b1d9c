/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The pairs of a certificate: open ones, and illegal ones of open sets, each with its chain.
 *
 * Blockers are looked for first among those of the pairs just before with the same site i, as a few sites round i block
 * most others; then among the sites of the set and the neighbours of the two; then among all. */
#include "base/alloc.h"
#include "base/index.h"
#include "checker/checker.h"
#include "prove/proof.h"
#include <inttypes.h>
#include <string.h>

/* After so much work (a blocker looked at is 1, a search CHAIN_PAIR beside) the search for chains gives up. */
#define CHAIN_EFFORT ((uint64_t)300 * 1000 * 1000)
#define CHAIN_PAIR 200
#define RECENT 40

/* A line of the section: an open pair, or an illegal one of an open set, to be proved. Invariant: i < j. */
typedef struct line {
  uint32_t i, j;
  char kind;
} line;

typedef struct lines {
  line *item;
  size_t count, cap;
} lines;

static dyd_status add_line(lines *l, uint32_t i, uint32_t j, char kind) {
  if (!dyd_reserve((void **)&l->item, &l->cap, l->count + 1, sizeof *l->item)) return DYD_E_NOMEM;
  l->item[l->count++] = (line){i, j, kind};
  return DYD_OK;
}

static dyd_status open_lines(lines *l, dyd_proof *p) {
  static const char kind[] = {[DYD_TIE] = 't', [DYD_INDETERMINATE] = 'o', [DYD_LEGAL] = 'l'};
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < p->pairs.count && st == DYD_OK; k++) {
    const dyd_pair *q = &p->pairs.item[k];
    if (q->status == DYD_LEGAL && dyd_cert_edges_have(&p->legal, q->i, q->j)) continue;
    st = add_line(l, q->i, q->j, kind[q->status]);
    if (st == DYD_OK) st = dyd_cert_edges_add(&p->open, q->i, q->j);
  }
  return st;
}

static bool pair_is_listed(const dyd_proof *p, uint32_t i, uint32_t j) {
  return dyd_cert_edges_have(&p->legal, i, j) || dyd_cert_edges_have(&p->open, i, j);
}

static dyd_status unlisted_lines(lines *l, const dyd_proof *p) {
  uint64_t effort = 0;
  dyd_status st = DYD_OK;
  for (size_t f = 0; f < p->faces.sets; f++) {
    const uint32_t *site = p->faces.member + p->faces.start[f];
    uint64_t m = p->faces.start[f + 1] - p->faces.start[f];
    if (m < 3 || p->faces.covered[f] == m * (m - 1) / 2) continue;
    for (size_t a = 0; a < m; a++)
      for (size_t b = a + 1; b < m && st == DYD_OK && effort < CHAIN_EFFORT; b++) {
        if (pair_is_listed(p, site[a], site[b])) continue;
        st = add_line(l, site[a], site[b], 'n');
        effort += CHAIN_PAIR;
      }
  }
  return st;
}

/* The pairs that boxes leave; all of open sets that are not listed, as far as the effort allows, where boxes give up.
 */
static dyd_status illegal_lines(lines *l, dyd_proof *p) {
  static const dyd_cert_edges none = {0};
  const dyd_cert_known known = {{&p->legal, &p->open, &none}};
  dyd_cert_edges left;
  bool given_up;
  dyd_status st = dyd_cert_boxes_left(&left, &given_up, &p->sites, &p->faces, &known);
  if (st != DYD_OK) return st;
  for (size_t e = 0; e < left.count && e < CHAIN_EFFORT / CHAIN_PAIR && st == DYD_OK; e++)
    st = add_line(l, left.item[e].i, left.item[e].j, 'n');
  free(left.item);
  return st == DYD_OK && given_up ? unlisted_lines(l, p) : st;
}

/* Where blockers are looked for, owned; what the searches have cost; blockers that were of use for site `of`. */
typedef struct blockers {
  uint32_t *site;
  size_t count, cap;
  uint64_t effort;
  uint32_t of, recent[RECENT];
  size_t recents;
} blockers;

static dyd_status add_blockers(blockers *b, const uint32_t *site, size_t count) {
  if (!dyd_reserve((void **)&b->site, &b->cap, b->count + count, sizeof *b->site)) return DYD_E_NOMEM;
  if (count) memcpy(b->site + b->count, site, count * sizeof *site);
  b->count += count;
  return DYD_OK;
}

static dyd_status add_neighbours(blockers *b, const dyd_proof *p, uint32_t v) {
  dyd_status st = DYD_OK;
  for (size_t q = p->graph.start[v]; q < p->graph.start[v + 1] && st == DYD_OK; q++) {
    uint32_t w = dyd_cert_origin(&p->graph, p->graph.around[q] ^ 1);
    st = add_blockers(b, &w, 1);
  }
  return st;
}

static dyd_status find_blockers(blockers *b, const dyd_proof *p, uint32_t i, uint32_t j) {
  const dyd_cert_faces *f = &p->faces;
  b->count = 0;
  dyd_status st = add_neighbours(b, p, i);
  if (st == DYD_OK) st = add_neighbours(b, p, j);
  for (size_t k = f->first[i]; k < f->first[i + 1] && st == DYD_OK; k++) {
    bool shared = false;
    for (size_t l = f->first[j]; l < f->first[j + 1]; l++) shared |= f->of[k] == f->of[l];
    size_t start = f->start[f->of[k]];
    if (shared) st = add_blockers(b, f->member + start, f->start[f->of[k] + 1] - start);
  }
  return st;
}

static dyd_status all_blockers(blockers *b, const dyd_proof *p) {
  dyd_status st = DYD_OK;
  b->count = 0;
  for (uint32_t v = 0; v < p->sites.count && st == DYD_OK; v++)
    if (p->sites.site[v].alias == v) st = add_blockers(b, &v, 1);
  return st;
}

static dyd_status recent_blockers(blockers *b, uint32_t i) {
  if (b->of != i) b->recents = 0;
  b->of = i;
  b->count = 0;
  return add_blockers(b, b->recent, b->recents);
}

static void remember_blockers(blockers *b, const dyd_cert_chain *chain) {
  for (size_t q = 0; q <= chain->points && b->recents < RECENT; q++) {
    size_t k = 0;
    while (k < b->recents && b->recent[k] != chain->blocker[q]) k++;
    if (k == b->recents) b->recent[b->recents++] = chain->blocker[q];
  }
}

static dyd_status pair_chain(bool *found, dyd_cert_chain *chain, blockers *b, const dyd_proof *p, const line *l) {
  dyd_status st = DYD_OK;
  *found = false;
  for (int wider = 0; wider < 3 && st == DYD_OK && !*found && b->effort < CHAIN_EFFORT; wider++) {
    st = wider == 0 ? recent_blockers(b, l->i) : wider == 1 ? find_blockers(b, p, l->i, l->j) : all_blockers(b, p);
    if (st != DYD_OK || b->count == 0) continue;
    b->effort += b->count + CHAIN_PAIR;
    st = dyd_proof_find_chain(found, chain, p, l->i, l->j, b->site, b->count);
  }
  if (*found) remember_blockers(b, chain);
  return st;
}

static dyd_status pair_put_chain(FILE *out, dyd_cert_chain *chain, blockers *near, dyd_proof *p, const line *l) {
  bool found;
  dyd_status st = pair_chain(&found, chain, near, p, l);
  if (st != DYD_OK || !found) return st;
  fprintf(out, "n %" PRIu32 " %" PRIu32 " ", l->i, l->j);
  dyd_proof_put_point(out, (const dyd_exact *)chain->u[0]);
  for (size_t q = 0; q < chain->points; q++) {
    fprintf(out, " %" PRIu32 " ", chain->blocker[q]);
    dyd_proof_put_point(out, (const dyd_exact *)chain->point[q]);
  }
  fprintf(out, " %" PRIu32 " ", chain->blocker[chain->points]);
  dyd_proof_put_point(out, (const dyd_exact *)chain->u[1]);
  putc('\n', out);
  dyd_cert_faces_cover(&p->faces, l->i, l->j);
  return dyd_cert_edges_add(&p->chained, l->i, l->j);
}

static dyd_status pair_put_lines(FILE *out, dyd_proof *p, const lines *l) {
  dyd_cert_chain chain;
  blockers near = {0};
  dyd_cert_chain_init(&chain);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < l->count && st == DYD_OK; k++) {
    const line *at = &l->item[k];
    if (k && dyd_compare_two(at, at - 1) == 0) continue; /* a pair of two sets */
    if (at->kind == 'n')
      st = pair_put_chain(out, &chain, &near, p, at);
    else
      fprintf(out, "%c %" PRIu32 " %" PRIu32 "\n", at->kind, at->i, at->j);
  }
  dyd_cert_chain_clear(&chain);
  free(near.site);
  return st;
}

/* What no line proves, boxes may. */
static dyd_status pair_put_boxes(FILE *out, dyd_proof *p) {
  const dyd_cert_known known = {{&p->legal, &p->open, &p->chained}};
  uint64_t before = dyd_cert_faces_left(&p->faces);
  p->unproved = before;
  if (before == 0 || dyd_delaunay_is_capped(p->pd)) return DYD_OK;
  dyd_status st = dyd_cert_boxes_unproved(&p->unproved, &p->sites, &p->faces, &known);
  if (st == DYD_OK && p->unproved < before) fprintf(out, "boxes %" PRIu64 "\n", before - p->unproved);
  return st;
}

dyd_status dyd_proof_put_pairs(FILE *out, dyd_proof *p) {
  lines l = {0};
  fputs("pairs\n", out);
  dyd_status st = open_lines(&l, p);
  for (size_t k = 0; k < l.count; k++) dyd_cert_faces_cover(&p->faces, l.item[k].i, l.item[k].j);
  if (st == DYD_OK && dyd_cert_faces_left(&p->faces) && !dyd_delaunay_is_capped(p->pd)) st = illegal_lines(&l, p);
  if (st == DYD_OK && l.count) qsort(l.item, l.count, sizeof *l.item, dyd_compare_two);
  if (st == DYD_OK) st = pair_put_lines(out, p, &l);
  if (st == DYD_OK) st = pair_put_boxes(out, p);
  free(l.item);
  return st;
}
