/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What points are, and what of it proves ties and aliases [CERT-10], in blocks.
 *
 * The checker reads a block before it is written; facts that it does not take are left out. That points are the same
 * is about them as they were given; for other facts those that are exact are numbers. All facts of one of these two
 * kinds share a block; where that is too much for the checker, each has its own. */
#define _POSIX_C_SOURCE 200809L /* open_memstream, fmemopen */
#include "engine/ties.h"
#include "base/alloc.h"
#include "checker/parts.h"
#include "prove/numbers.h"
#include "stream/algebra/normal.h"

#include <inttypes.h>
#include <string.h>

/* Sites of one block at most. */
enum { BLOCK_SITES = 1 << 13 };

/* A fact of the engine; member is borrowed. */
typedef struct fact {
  dyd_relation relation;
  const uint32_t *member;
  size_t count;
} fact;

/* ---- blocks ---- */

static void block_clear(dyd_proof_block *b) {
  dyd_ring_clear(&b->ring);
  dyd_forms_clear(&b->forms);
  free(b->site);
  free(b->line);
  free(b->at);
}

/* The sites of the facts, each once. */
static dyd_status block_gather(dyd_proof_block *b, const fact *list, size_t count) {
  size_t n = 0;
  for (size_t q = 0; q < count; q++) n += list[q].count;
  b->site = dyd_alloc(n, sizeof *b->site);
  b->at = dyd_alloc(n, sizeof *b->at);
  if (!b->site || !b->at) return DYD_E_NOMEM;
  for (size_t q = 0; q < count; q++)
    for (size_t k = 0; k < list[q].count; k++) b->site[b->sites++] = list[q].member[k];
  b->sites = dyd_cert_distinct(b->site, b->sites);
  return DYD_OK;
}

/* *known: all sites are described, and their leaves settled. */
static dyd_status block_describe(bool *known, dyd_proof_block *b) {
  dyd_status st = DYD_OK;
  *known = b->sites <= BLOCK_SITES;
  for (size_t k = 0; k < b->sites && st == DYD_OK && *known; k++) {
    st = dyd_ties_describe(&b->at[k], &b->forms, b->proof->engine, b->site[k], b->given);
    *known = b->at[k].x != DYD_NONE && b->at[k].y != DYD_NONE;
  }
  if (st == DYD_OK && *known) st = dyd_ring_settle(&b->ring, &b->at->x, 2 * b->sites);
  *known = *known && !b->ring.stale;
  return b->forms.failed || b->ring.failed ? DYD_E_NOMEM : st;
}

/* Lines of numbers and points. */
static bool block_put(dyd_proof_block *b) {
  if (!dyd_proof_put_numbers(b)) return false;
  fprintf(b->out, "points %zu\n", b->sites);
  for (size_t k = 0; k < b->sites; k++)
    fprintf(b->out, "%" PRIu32 " %" PRIu32 " %" PRIu32 "\n", b->site[k], b->line[b->at[k].x], b->line[b->at[k].y]);
  return true;
}

/* *text: the lines, owned by the caller; NULL: there are none. */
static dyd_status block_text(char **text, size_t *size, uint32_t *lines, const dyd_proof *p, const fact *list,
                             size_t count) {
  dyd_proof_block b = {.proof = p, .given = list->relation == DYD_COINCIDENT};
  bool known = false;
  *text = NULL;
  b.out = open_memstream(text, size);
  if (!b.out) return DYD_E_NOMEM;
  dyd_forms_init(&b.forms);
  dyd_status st = dyd_ring_init(&b.ring, &b.forms);
  if (st == DYD_OK) st = block_gather(&b, list, count);
  if (st == DYD_OK) st = block_describe(&known, &b);
  known = st == DYD_OK && known && block_put(&b);
  *lines = b.lines;
  block_clear(&b);
  if (fclose(b.out) && st == DYD_OK) st = DYD_E_NOMEM;
  if (st == DYD_OK && known) return DYD_OK;
  free(*text);
  *text = NULL;
  return st;
}

/* The block as the checker sees it, without facts; *taken: it takes it. */
static dyd_status block_check(bool *taken, dyd_cert_ties *t, const char *text, size_t size, uint32_t lines,
                              const dyd_proof *p) {
  char *whole = dyd_alloc(size + 64, 1);
  dyd_error err;
  *taken = false;
  if (!whole) return DYD_E_NOMEM;
  size_t length = (size_t)snprintf(whole, 64, "algebra %" PRIu32 "\n", lines);
  memcpy(whole + length, text, size);
  length += size;
  length += (size_t)snprintf(whole + length, 16, "facts 0\n");
  dyd_cert_reader in = {.in = fmemopen(whole, length, "r"), .err = &err};
  dyd_error_clear(&err);
  dyd_status st = in.in ? dyd_cert_next_line(&in) : DYD_E_NOMEM;
  if (st == DYD_OK) st = dyd_cert_ties_read(t, &in, &p->sites);
  *taken = st == DYD_OK;
  dyd_cert_reader_clear(&in);
  if (in.in) fclose(in.in);
  free(whole);
  return st == DYD_E_NOMEM ? st : DYD_OK;
}

/* ---- facts ---- */

/* The base points first: the ends of a line, three points far apart of a circle. */
static void base_first(uint32_t *to, const fact *f) {
  size_t base[3] = {0, f->relation == DYD_COCIRCULAR ? f->count / 3 : f->count - 1, 2 * f->count / 3};
  size_t n = f->relation == DYD_COCIRCULAR ? 3 : 2, at = n;
  for (size_t k = 0; k < f->count; k++) {
    size_t q = 0;
    while (q < n && base[q] != k) q++;
    to[q < n ? q : at++] = f->member[k];
  }
}

static dyd_status put_fact(bool *written, FILE *out, dyd_cert_ties *t, const fact *f) {
  static const char *const name[] = {[DYD_COINCIDENT] = "same", [DYD_COLLINEAR] = "line", [DYD_COCIRCULAR] = "circle"};
  static const dyd_cert_relation_kind kind[] = {
      [DYD_COINCIDENT] = DYD_CERT_SAME, [DYD_COLLINEAR] = DYD_CERT_LINE, [DYD_COCIRCULAR] = DYD_CERT_CIRCLE};
  dyd_cert_block *b = t->block[t->blocks - 1];
  uint32_t *site = dyd_alloc(f->count, sizeof *site);
  if (!site) return DYD_E_NOMEM;
  base_first(site, f);
  bool identity = dyd_cert_fact_holds(b, kind[f->relation], site, f->count, false);
  *written = identity || dyd_cert_fact_holds(b, kind[f->relation], site, f->count, true);
  if (*written) {
    fputs(name[f->relation], out);
    for (size_t k = 0; k < f->count; k++) fprintf(out, " %" PRIu32, site[k]);
    fputs(identity ? " identity\n" : " bound\n", out);
  }
  free(site);
  return b->algebra.relations.nomem ? DYD_E_NOMEM : DYD_OK;
}

/* *text: the lines of the facts that the checker takes, *count of them. */
static dyd_status facts_text(char **text, size_t *taken, dyd_cert_ties *t, const fact *list, size_t count) {
  size_t size;
  FILE *out = open_memstream(text, &size);
  dyd_status st = out ? DYD_OK : DYD_E_NOMEM;
  *taken = 0;
  for (size_t q = 0; q < count && st == DYD_OK; q++) {
    bool written = false;
    st = put_fact(&written, out, t, &list[q]);
    *taken += written;
  }
  if (out && fclose(out) && st == DYD_OK) st = DYD_E_NOMEM;
  return st;
}

/* Writes one block for these facts; *taken: how many of them it has. *work: that of the blocks written. */
static dyd_status put_block(FILE *out, size_t *taken, uint64_t *work, const dyd_proof *p, const fact *list,
                            size_t count) {
  dyd_cert_ties t = {.work = *work};
  char *text = NULL, *facts = NULL;
  size_t size;
  uint32_t lines;
  bool good = false;
  *taken = 0;
  dyd_status st = block_text(&text, &size, &lines, p, list, count);
  if (st == DYD_OK && text) st = block_check(&good, &t, text, size, lines, p);
  if (st == DYD_OK && good) st = facts_text(&facts, taken, &t, list, count);
  if (st == DYD_OK && *taken) fprintf(out, "algebra %" PRIu32 "\n%sfacts %zu\n%s", lines, text, *taken, facts);
  if (*taken) *work = t.block[0]->algebra.relations.work;
  free(facts);
  free(text);
  dyd_cert_ties_clear(&t);
  return st;
}

/* Of points that are sites of their own, or the same site now. */
static bool fact_counts(const dyd_proof *p, const fact *f) {
  const dyd_cert_site *s = p->sites.site;
  if (f->relation == DYD_COINCIDENT) return s[f->member[0]].alias == s[f->member[1]].alias;
  for (size_t k = 0; k < f->count; k++)
    if (s[f->member[k]].alias != f->member[k]) return false;
  return true;
}

/* Those that are about the same place, or the others. */
static dyd_status facts_gather(fact **list, size_t *count, const dyd_proof *p, bool same) {
  fact f;
  size_t cap = 0;
  for (size_t k = 0; dyd_ties_proved(&f.relation, &f.member, &f.count, p->engine, k); k++) {
    if ((f.relation == DYD_COINCIDENT) != same || !fact_counts(p, &f)) continue;
    if (!dyd_reserve((void **)list, &cap, *count + 1, sizeof **list)) return DYD_E_NOMEM;
    (*list)[(*count)++] = f;
  }
  return DYD_OK;
}

static dyd_status put_facts(FILE *out, uint64_t *work, const dyd_proof *p, bool same) {
  fact *list = NULL;
  size_t count = 0, taken = 0;
  dyd_status st = facts_gather(&list, &count, p, same);
  if (st == DYD_OK && count) st = put_block(out, &taken, work, p, list, count);
  for (size_t q = 0; q < count && st == DYD_OK && !taken && count > 1; q++) {
    size_t one;
    st = put_block(out, &one, work, p, &list[q], 1);
  }
  free(list);
  return st;
}

dyd_status dyd_proof_put_ties(FILE *out, const dyd_proof *p) {
  uint64_t work = 0;
  dyd_status st = put_facts(out, &work, p, true);
  return st == DYD_OK ? put_facts(out, &work, p, false) : st;
}
