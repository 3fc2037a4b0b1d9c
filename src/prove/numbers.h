/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers in the form that the checker of certificates reads. */
#ifndef DYD_PROVE_NUMBERS_H
#define DYD_PROVE_NUMBERS_H

#include "prove/proof.h"
#include "stream/algebra/ring.h"

/* Bits to which the bracket of a root is narrowed at most. */
#define DYD_PROOF_BRACKET ((slong)4096)

/* A block while it is written. given: points are described as they were given. line[n]: of form n, DYD_NONE: none yet;
 * lines: so many there are. Invariant: site is ascending, at[k] belongs to site[k]. */
typedef struct dyd_proof_block {
  const dyd_proof *proof;
  dyd_forms forms;
  dyd_ring ring;
  FILE *out;
  uint32_t *site, *line, lines;
  dyd_form_point *at;
  size_t sites;
  bool given;
} dyd_proof_block;

/* Lines of all leaves and of what points are made of. Forms made from now on belong to no point. false: of something
 * the checker has no form, or memory is exhausted. */
bool dyd_proof_put_numbers(dyd_proof_block *b);
/* The checker's name of an operation on forms; NULL: it has none. */
const char *dyd_proof_op_text(unsigned op);

#endif
