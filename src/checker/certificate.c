/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The check of a certificate from its first line to its last. */
#include "base/abi.h"
#include "base/error.h"
#include "checker/checker.h"

#include <stdlib.h>
#include <string.h>

static void checker_clear(dyd_checker *c) {
  dyd_cert_reader_clear(&c->in);
  dyd_cert_sites_clear(&c->sites);
  dyd_cert_tree_clear(&c->tree);
  free(c->legal.item);
  free(c->bridges.item);
  free(c->open.item);
  dyd_cert_corners_clear(&c->corners);
  dyd_cert_graph_clear(&c->graph);
  dyd_cert_faces_clear(&c->faces);
  dyd_cert_chain_clear(&c->chain);
  dyd_exact_clear(&c->point[0]);
  dyd_exact_clear(&c->point[1]);
}

static dyd_status checker_outcome(const dyd_checker *c) {
  const dyd_certificate_report *r = &c->report;
  bool open = r->indeterminate || r->tie || r->legal_unproved || r->capped;
  if (strcmp(r->outcome, "decided") == 0 && open)
    return dyd_cert_reject(&c->in, "the outcome is not decided: pairs are open");
  if (strcmp(r->outcome, "certified") == 0 && !c->reached)
    return dyd_cert_reject(&c->in, "the outcome is not certified: no bound reaches the goal");
  return DYD_OK;
}

/* The section on the diagram, if there is one, the outcome, and the last line. */
static dyd_status checker_end(dyd_checker *c) {
  dyd_status st = dyd_cert_next_line(&c->in);
  if (st == DYD_OK && strncmp(c->in.line, "window", 6) == 0) {
    st = dyd_checker_diagram(c);
    if (st == DYD_OK) st = dyd_cert_next_line(&c->in);
  }
  if (st == DYD_OK) st = checker_outcome(c);
  if (st == DYD_OK) st = dyd_cert_expect_word(c, "end");
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  return st == DYD_OK ? dyd_cert_expect_end(&c->in) : st;
}

dyd_status dyd_verify_certificate(dyd_certificate_report *out, FILE *in, dyd_error *err) {
  dyd_checker c = {.in = {.in = in, .err = err}};
  if (err) dyd_error_clear(err);
  if (dyd_abi_check(out, 0, "dyd_certificate_report", err) != DYD_OK) return DYD_E_ARG;
  dyd_cert_sites_init(&c.sites);
  dyd_cert_chain_init(&c.chain);
  dyd_exact_init(&c.point[0]);
  dyd_exact_init(&c.point[1]);
  dyd_status st = dyd_checker_head(&c);
  if (st == DYD_OK) st = dyd_checker_sites(&c);
  if (st == DYD_OK) st = dyd_checker_legal(&c);
  if (st == DYD_OK) st = dyd_checker_places(&c);
  if (st == DYD_OK) st = dyd_checker_bridges(&c);
  if (st == DYD_OK) st = dyd_checker_corners(&c);
  if (st == DYD_OK) st = dyd_checker_pairs(&c);
  if (st == DYD_OK) st = checker_end(&c);
  if (st == DYD_OK) dyd_abi_give(out, &c.report, sizeof c.report);
  checker_clear(&c);
  return st;
}
