/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The check of a certificate from its first line to its last. */
#include "base/abi.h"
#include "base/error.h"
#include "checker/check.h"

#include <stdlib.h>

static void clear(dyd_cert_check *c) {
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

dyd_status dyd_verify_certificate(dyd_certificate_report *out, FILE *in, dyd_error *err) {
  dyd_cert_check c = {.in = {.in = in, .err = err}};
  if (err) dyd_error_clear(err);
  if (dyd_abi_check(out, 0, "dyd_certificate_report", err) != DYD_OK) return DYD_E_ARG;
  dyd_cert_sites_init(&c.sites);
  dyd_cert_chain_init(&c.chain);
  dyd_exact_init(&c.point[0]);
  dyd_exact_init(&c.point[1]);
  dyd_status status = dyd_cert_check_head(&c);
  if (status >= 0) status = dyd_cert_check_sites(&c);
  if (status >= 0) status = dyd_cert_check_legal(&c);
  if (status >= 0) status = dyd_cert_check_places(&c);
  if (status >= 0) status = dyd_cert_check_bridges(&c);
  if (status >= 0) status = dyd_cert_check_corners(&c);
  if (status >= 0) status = dyd_cert_check_pairs(&c);
  if (status >= 0) status = dyd_cert_check_end(&c);
  if (status >= 0) dyd_abi_give(out, &c.report, sizeof c.report);
  clear(&c);
  return status;
}
