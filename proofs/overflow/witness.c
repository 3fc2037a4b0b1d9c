/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/witness.c: distances from a centre are numbers. Areas are numbers of 64 bits here: their
 * values are no part of the proof. That the tree visits sites of the list, with the context given, is taken for
 * granted: visit_sites stands for dyd_cert_tree_visit with is_outside_disc. */
#define __int128 long long
#define SPELL_OUT
#include "centres.h"
#include "sites.h"

#include "checker/witness.h"

/*@ requires \valid_read(s) && \valid_read(t) && small(c) && small(c + 1) && small_site(s->site + i) &&
      small_site(s->site + j) && \valid_read(s->box + i) && \valid_read(s->box + j) && whole(&s->origin[0][0]) &&
      whole(&s->origin[1][0]) && -274877906944 <= s->unit <= 274877906944 && (other == \null || \valid(other)) &&
      \separated(s, c + (0 .. 1));
    assigns *other; exits \false; */
bool dyd_cert_is_witness(uint32_t *other, const dyd_cert_sites *s, const dyd_cert_tree *t, uint32_t i, uint32_t j,
                         const dyd_exact c[2], bool places);

#include "checker/witness.c"
