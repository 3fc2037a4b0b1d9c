/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The check of a certificate from its first line to its last, and what of it is proved. */
#include "base/abi.h"
#include "base/error.h"
#include "checker/checker.h"

#include <stdlib.h>
#include <string.h>

void dyd_checker_init(dyd_checker *c, FILE *in, dyd_error *err) {
  *c = (dyd_checker){.in = {.in = in, .err = err}};
  dyd_cert_sites_init(&c->sites);
  dyd_cert_chain_init(&c->chain);
  dyd_cert_globe_init(&c->globe);
  dyd_exact_init(&c->point[0]);
  dyd_exact_init(&c->point[1]);
}

static void checker_clear_second(dyd_checker *c) {
  if (c->second) dyd_checker_clear(c->second);
  free(c->second);
  c->second = NULL;
}

void dyd_checker_clear(dyd_checker *c) {
  dyd_cert_reader_clear(&c->in);
  dyd_cert_tree_clear(&c->tree);
  free(c->legal.item);
  free(c->bridges.item);
  free(c->open.item);
  free(c->tie.item);
  dyd_cert_ties_clear(&c->ties);
  free(c->chained.item);
  dyd_checker_discs_clear(c);
  free(c->near_open);
  dyd_cert_corners_clear(&c->corners);
  dyd_cert_graph_clear(&c->graph);
  dyd_cert_faces_clear(&c->faces);
  dyd_cert_chain_clear(&c->chain);
  checker_clear_second(c);
  dyd_cert_globe_clear(&c->globe);
  dyd_cert_sites_clear(&c->sites);
  dyd_exact_clear(&c->point[0]);
  dyd_exact_clear(&c->point[1]);
}

static dyd_status checker_outcome(const dyd_checker *c) {
  const dyd_certificate_report *r = &c->report;
  bool open = r->indeterminate || r->tie || r->legal_unproved || r->capped || r->places_certain < r->places;
  if (strcmp(r->outcome, "decided") == 0 && open)
    return dyd_cert_reject(&c->in, "the outcome is not decided: pairs are open");
  if (strcmp(r->outcome, "certified") == 0 && !c->reached)
    return dyd_cert_reject(&c->in, "the outcome is not certified: no bound reaches the goal");
  return DYD_OK;
}

/* What points are, block by block, up to a line that is none; what follows for aliases and ties. */
static dyd_status checker_ties(dyd_checker *c) {
  dyd_status st = dyd_cert_next_line(&c->in);
  while (st == DYD_OK && strncmp(c->in.line, "algebra", 7) == 0) {
    st = dyd_cert_ties_read(&c->ties, &c->in, &c->sites);
    if (st == DYD_OK) st = dyd_cert_next_line(&c->in);
  }
  if (st != DYD_OK) return st;
  dyd_cert_ties_mark(&c->faces, &c->ties);
  for (size_t q = 0; q < c->tie.count; q++)
    c->report.ties_unproved += !dyd_cert_faces_tied(&c->faces, c->tie.item[q].i, c->tie.item[q].j);
  c->report.identities = c->ties.identities;
  c->report.tie_bounds = c->ties.bounds;
  for (size_t k = 0; k < c->ties.blocks; k++) c->report.claims += c->ties.block[k]->algebra.claims;
  st = dyd_cert_ties_aliases(&c->report.aliases_unproved, &c->ties, &c->sites);
  return st == DYD_OK ? DYD_OK : dyd_fail_nomem(c->in.err);
}

/* After "also": another certificate, of the same places from a second eye. */
static dyd_status read_second(dyd_checker *c) {
  if (c->first || c->globe.gap)
    return dyd_cert_reject(&c->in, "a second eye is for places that are seen from one of them");
  c->second = dyd_checker_room();
  if (!c->second) return dyd_fail_nomem(c->in.err);
  dyd_checker_init(c->second, c->in.in, c->in.err);
  c->second->first = c;
  c->second->in.number = c->in.number;
  dyd_status st = dyd_checker_run(c->second);
  if (st != DYD_OK) return st;
  c->in.number = c->second->in.number;
  if (!c->second->globe.stated) return dyd_cert_reject(&c->in, "the second certificate is not about a sphere");
  c->report.capped = c->report.capped || c->second->report.capped;
  dyd_checker_join(c);
  return DYD_OK;
}

/* "outcome W", or "also", a certificate, and this. */
static dyd_status read_last_lines(dyd_checker *c) {
  static const char *const outcome[] = {"decided", "certified", "fixpoint", "budget", "cancelled", "error"};
  size_t k = 0;
  dyd_status st = dyd_cert_next_line(&c->in);
  if (st == DYD_OK && strcmp(c->in.line, "also") == 0) {
    st = read_second(c);
    if (st == DYD_OK) st = dyd_cert_next_line(&c->in);
  }
  if (st == DYD_OK) st = dyd_cert_expect_word(c, "outcome");
  if (st == DYD_OK) st = dyd_cert_read_choice(&k, c, outcome, 6);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st == DYD_OK) c->report.outcome = outcome[k];
  return st;
}

/* The section on a sphere; the outcome before it is that of the images. */
static dyd_status checker_sphere(dyd_checker *c) {
  dyd_status st = checker_outcome(c);
  if (st == DYD_OK) st = dyd_checker_globe(c);
  if (st == DYD_OK) st = dyd_checker_around(c);
  return st == DYD_OK ? read_last_lines(c) : st;
}

/* Sections that need not be there, in their order; the line after them has been read. */
static dyd_status checker_sections(dyd_checker *c) {
  static const struct {
    const char *word;
    dyd_status (*check)(dyd_checker *);
  } section[] = {{"discs", dyd_checker_discs},
                 {"graph", dyd_checker_graph},
                 {"window", dyd_checker_diagram},
                 {"sphere", checker_sphere}};
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < sizeof section / sizeof *section && st == DYD_OK; k++) {
    if (strncmp(c->in.line, section[k].word, strlen(section[k].word)) != 0) continue;
    st = section[k].check(c);
    if (st == DYD_OK) st = dyd_cert_next_line(&c->in);
  }
  return st;
}

/* The outcome and the last line, which has been read and ends the text unless the certificate is the second one of a
 * sphere. */
static dyd_status checker_end(dyd_checker *c) {
  dyd_status st = DYD_OK;
  if (st == DYD_OK) st = checker_outcome(c);
  if (st == DYD_OK) st = dyd_cert_expect_word(c, "end");
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (c->first) return st;
  return st == DYD_OK ? dyd_cert_expect_end(&c->in) : st;
}

/* ---- what is stated and not proved [CERT-8] ---- */

/* stays: it is a fixpoint, and one is proved. */
static bool outcome_is_proved(const dyd_checker *c, bool stays) {
  const dyd_certificate_report *r = &c->report;
  bool complete = !r->unproved && !r->capped && !r->discs_unproved && !r->near_unproved && !(r->gaps & DYD_GAP_SPHERE),
       of_diagram = strncmp(r->goal, "voronoi", 7) == 0;
  if (strcmp(r->outcome, "decided") == 0) return complete;
  if (strcmp(r->outcome, "certified") == 0)
    return strcmp(r->goal, "voronoi hausdorff") == 0 ? r->distance_proved : of_diagram || complete;
  return stays;
}

/* What discs, graphs and places state without a proof; discs that are fixed have to be so. */
static void settle_sections(dyd_checker *c, const bool *still) {
  dyd_certificate_report *r = &c->report;
  for (size_t i = 0; still && r->discs_fixed && i < r->sites; i++) r->undescribed += !still[i];
  if (still && r->undescribed) r->gaps |= DYD_GAP_POINTS;
  if (r->discs_unproved) r->gaps |= DYD_GAP_DISCS;
  if (r->graph_unproved || (r->graph && (r->unproved || r->capped))) r->gaps |= DYD_GAP_GRAPH;
  if (r->near_unproved) r->gaps |= DYD_GAP_NEAREST;
}

/* Of a sphere: *stays: from no eye anything changes. Fills in the gaps of images, and of the second certificate. */
static dyd_status checker_settle_second(bool *stays, dyd_checker *c, const bool *still) {
  dyd_certificate_report *r = &c->report;
  const dyd_certificate_report *other = &c->second->report;
  dyd_status st = dyd_checker_settle(c->second, still);
  bool settled = strcmp(other->outcome, "fixpoint") == 0 || strcmp(other->outcome, "decided") == 0;
  *stays = *stays && settled && !(other->gaps & DYD_GAP_OUTCOME);
  r->gaps |= other->gaps & ~(unsigned)DYD_GAP_OUTCOME;
  r->second = true;
  r->second_legal = other->legal;
  r->legal_unproved += other->legal_unproved;
  r->unproved += other->unproved;
  r->ties_unproved += other->ties_unproved;
  r->images_unproved += other->images_unproved;
  r->around_unproved += other->around_unproved;
  return st;
}

/* The same where there is one eye. */
static dyd_status checker_settle_sphere(bool *stays, dyd_checker *c, const bool *still) {
  dyd_certificate_report *r = &c->report;
  dyd_status st = dyd_checker_stays_on_sphere(stays, c, still);
  if (st == DYD_OK && c->second) st = checker_settle_second(stays, c, still);
  *stays = *stays && strcmp(r->outcome, "fixpoint") == 0;
  if (r->images_unproved) r->gaps |= DYD_GAP_IMAGES;
  if (r->around_unproved) r->gaps |= DYD_GAP_AROUND;
  return st;
}

dyd_status dyd_checker_settle(dyd_checker *c, const bool *still) {
  dyd_certificate_report *r = &c->report;
  bool stays = false;
  settle_sections(c, still);
  const bool images = c->globe.stated && strcmp(r->goal, "nearest") != 0;
  if (images && checker_settle_sphere(&stays, c, still) != DYD_OK) return dyd_fail_nomem(c->in.err);
  if (strcmp(r->outcome, "fixpoint") == 0 && !images && dyd_checker_stays(&stays, c, still) != DYD_OK)
    return dyd_fail_nomem(c->in.err);
  if (r->legal_unproved) r->gaps |= DYD_GAP_LEGAL;
  if (r->unproved && !r->capped) r->gaps |= DYD_GAP_ILLEGAL;
  if (r->claims) r->gaps |= DYD_GAP_CLAIMS;
  if (r->ties_unproved) r->gaps |= DYD_GAP_TIES;
  if (r->aliases_unproved) r->gaps |= DYD_GAP_ALIASES;
  if (r->unproved && (r->area || r->hausdorff)) r->gaps |= DYD_GAP_BOUNDS;
  if (r->distance && !r->distance_proved) r->gaps |= DYD_GAP_DISTANCE;
  if (!outcome_is_proved(c, stays)) r->gaps |= DYD_GAP_OUTCOME;
  return DYD_OK;
}

static dyd_status run_nearest(dyd_checker *c) {
  dyd_status st = dyd_checker_places_near(c);
  if (st == DYD_OK) st = dyd_cert_next_line(&c->in);
  if (st == DYD_OK && dyd_cert_ties_aliases(&c->report.aliases_unproved, &c->ties, &c->sites) != DYD_OK)
    st = dyd_fail_nomem(c->in.err);
  return st == DYD_OK ? checker_end(c) : st;
}

dyd_status dyd_checker_run(dyd_checker *c) {
  dyd_status st = dyd_checker_head(c);
  if (st == DYD_OK) st = dyd_checker_sites(c);
  if (st == DYD_OK && strcmp(c->report.goal, "nearest") == 0) return run_nearest(c);
  if (st == DYD_OK) st = dyd_checker_legal(c);
  if (st == DYD_OK) st = dyd_checker_places(c);
  if (st == DYD_OK) st = dyd_checker_bridges(c);
  if (st == DYD_OK) st = dyd_checker_corners(c);
  if (st == DYD_OK) st = dyd_checker_pairs(c);
  if (st == DYD_OK) st = checker_ties(c);
  if (st == DYD_OK) st = checker_sections(c);
  return st == DYD_OK ? checker_end(c) : st;
}

dyd_status dyd_checker_verify(dyd_certificate_report *out, FILE *in, dyd_error *err) {
  dyd_checker c;
  if (err) dyd_error_clear(err);
  if (dyd_abi_check(out, 0, "dyd_certificate_report", err) != DYD_OK) return DYD_E_ARG;
  dyd_checker_init(&c, in, err);
  dyd_status st = dyd_checker_run(&c);
  if (st == DYD_OK) st = dyd_checker_settle(&c, NULL);
  if (st == DYD_OK) dyd_abi_give(out, &c.report, sizeof c.report);
  dyd_checker_clear(&c);
  return st;
}
