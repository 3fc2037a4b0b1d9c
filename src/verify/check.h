/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A certificate being checked: what has been read so far. */
#ifndef DYD_VERIFY_CHECK_H
#define DYD_VERIFY_CHECK_H

#include "verify/bounds.h"
#include "verify/chain.h"
#include "verify/faces.h"
#include "verify/read.h"
#include "verify/witness.h"
#include <dyadel/certificate.h>

typedef struct dyd_cert_corners {
  dyd_cert_corner *item;
  size_t count, cap;
} dyd_cert_corners;

typedef struct dyd_cert_check {
  dyd_cert_reader in;
  dyd_certificate_report report;
  dyd_cert_sites sites;
  dyd_cert_tree tree;
  dyd_cert_edges legal, bridges;
  dyd_cert_corners corners;
  dyd_cert_graph graph;
  dyd_cert_faces faces;
  dyd_cert_chain chain;
  dyd_cert_edges open; /* pairs o, t, l: kept for the bounds */
  dyd_exact point[2];
} dyd_cert_check;

/* The parts of a certificate, in order; each rejects what does not hold. */
dyd_status dyd_cert_check_head(dyd_cert_check *c);
dyd_status dyd_cert_check_sites(dyd_cert_check *c);
dyd_status dyd_cert_check_legal(dyd_cert_check *c);
dyd_status dyd_cert_check_places(dyd_cert_check *c);
dyd_status dyd_cert_check_bridges(dyd_cert_check *c);
dyd_status dyd_cert_check_corners(dyd_cert_check *c);
/* Up to the end. */
dyd_status dyd_cert_check_pairs(dyd_cert_check *c);

/* A line "NAME count"; the count is at most `most`. */
dyd_status dyd_cert_read_heading(uint32_t *count, dyd_cert_check *c, const char *name, uint64_t most);
/* The word must be there. */
dyd_status dyd_cert_expect_word(dyd_cert_check *c, const char *name);
/* The word is one of text[0 .. count-1]; *out is its number. */
dyd_status dyd_cert_read_choice(size_t *out, dyd_cert_check *c, const char *const *text, size_t count);
/* A site that is no alias. */
dyd_status dyd_cert_read_site(uint32_t *out, dyd_cert_check *c);
/* Two sites i < j, later than the pair before, which is (0,0) at first. */
dyd_status dyd_cert_read_pair(dyd_cert_edge *pair, dyd_cert_check *c);

void dyd_cert_corners_clear(dyd_cert_corners *c);
dyd_status dyd_cert_corners_add(dyd_cert_corners *c, uint32_t i, const dyd_exact u[2]);

#endif
