/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a certificate says points are, and what follows from that: that some are the same, on one line, on one circle
 * [CERT-10]. */
#ifndef DYD_CHECKER_TIES_H
#define DYD_CHECKER_TIES_H

#include "checker/algebra.h"
#include "checker/faces.h"

/* Site `site` is the point whose coordinates are these two numbers of the block. */
typedef struct dyd_cert_described {
  uint32_t site, number[2];
} dyd_cert_described;

/* Points of one algebra, sorted by site. */
typedef struct dyd_cert_block {
  dyd_cert_algebra algebra;
  dyd_cert_described *point;
  size_t points;
} dyd_cert_block;

typedef enum dyd_cert_relation_kind { DYD_CERT_SAME, DYD_CERT_LINE, DYD_CERT_CIRCLE } dyd_cert_relation_kind;

/* Sites member[first .. first+count) are so, ascending. */
typedef struct dyd_cert_fact {
  dyd_cert_relation_kind kind;
  size_t first, count;
} dyd_cert_fact;

/* Everything in it was checked. */
typedef struct dyd_cert_ties {
  dyd_cert_block **block;
  size_t blocks, block_cap;
  dyd_cert_fact *fact;
  size_t facts, fact_cap;
  uint32_t *member;
  size_t members, member_cap;
  size_t identities, bounds; /* facts by what proves them */
  uint64_t work;             /* of all blocks */
} dyd_cert_ties;

void dyd_cert_ties_clear(dyd_cert_ties *t);
/* Reads a block, whose first line is the reader's, and checks it. */
dyd_status dyd_cert_ties_read(dyd_cert_ties *t, dyd_cert_reader *in, const dyd_cert_sites *s);
/* Are these points of the block, all of which are described, so? The first two (of a circle: three) are the base. */
bool dyd_cert_fact_holds(dyd_cert_block *b, dyd_cert_relation_kind kind, const uint32_t *site, size_t count,
                         bool by_bound);
/* Notes in the faces which open sets are tied. */
void dyd_cert_ties_mark(dyd_cert_faces *f, const dyd_cert_ties *t);
/* How many aliases of sites that are no exact points are not proved to be. */
dyd_status dyd_cert_ties_aliases(size_t *out, const dyd_cert_ties *t, const dyd_cert_sites *s);

#endif
