/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of open sets. */
#ifndef DYD_PROOFS_FACES_H
#define DYD_PROOFS_FACES_H

#include "graph.h"

#include "checker/faces.h"

typedef const dyd_cert_faces *open_sets;

/* Sites are in the sets that the lists name. */
/*@ predicate indexed(open_sets f) = \valid_read(f) && f->members <= 1152921504606846976 && f->sets < 4294967295 &&
      \valid_read(f->first + (0 .. SITES)) && (\forall integer v; 0 <= v <= SITES ==> f->first[v] <= f->members) &&
      (0 < f->members ==> \valid_read(f->of + (0 .. f->members - 1))) &&
      (\forall integer q; 0 <= q < f->members ==> f->of[q] < f->sets) &&
      (0 < f->sets ==> \valid(f->covered + (0 .. f->sets - 1)) && \valid_read(f->inexact + (0 .. f->sets - 1)) &&
        \valid_read(f->tied + (0 .. f->sets - 1)) && \valid_read(f->start + (0 .. f->sets))) &&
      \separated(f->covered + (0 .. f->sets - 1), f, f->first + (0 .. SITES), f->of + (0 .. f->members - 1)); */

/*@ requires indexed(f) && i < SITES && j < SITES; assigns \nothing; exits \false; */
size_t dyd_cert_faces_common(const dyd_cert_faces *f, uint32_t i, uint32_t j);
/*@ requires indexed(f) && i < SITES && j < SITES; assigns \nothing; exits \false; */
bool dyd_cert_faces_share(const dyd_cert_faces *f, uint32_t i, uint32_t j);
/*@ requires indexed(f) && i < SITES && j < SITES; assigns \nothing; exits \false; */
bool dyd_cert_faces_still(const dyd_cert_faces *f, uint32_t i, uint32_t j);
/*@ requires indexed(f) && i < SITES && j < SITES; exits \false; ensures indexed(f); */
void dyd_cert_faces_cover(dyd_cert_faces *f, uint32_t i, uint32_t j);
/*@ requires indexed(f); assigns \nothing; exits \false; */
uint64_t dyd_cert_faces_left(const dyd_cert_faces *f);

#endif
