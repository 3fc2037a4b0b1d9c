/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of the numbers of a block, of which there may come more. */
#ifndef DYD_PROOFS_NUMBERS_H
#define DYD_PROOFS_NUMBERS_H

#include "polys.h"

/* known: the number to be added is in its place behind those before; listed: there is none to be added; cycled: the
 * list of cosines is apart.
 * angled: leaves of angles are in pairs, the cosine before its sine. This does not hold any more where there was room
 * for the cosine alone; the line is refused then. A block whose lines were all accepted has it. */
/*@ predicate known(numbers a) = \valid(a) && a->relations.count <= 64 && a->count < 4294967295 &&
      \valid(a->number + (0 .. a->count)) && \separated(a, a->number + (0 .. a->count)) &&
      (\forall integer k; 0 <= k < a->relations.count ==> a->leaf[k].number <= a->count) &&
      (\forall integer k; 0 <= k <= a->count ==> a->number[k].a <= a->count);
    predicate cycled(numbers a) = cosines(a) &&
      \separated(a->cosine + (0 .. a->cycle - 1), a, a->number + (0 .. a->count));
    predicate circular(integer op) = DYD_CERT_COS <= op <= DYD_CERT_TAN;
    predicate angle(numbers a, integer k) = !a->leaf[k].sine && circular(a->number[a->leaf[k].number].op);
    predicate angled(numbers a) = \forall integer k; 0 <= k < a->relations.count && angle(a, k) ==>
      k + 1 < a->relations.count;
    predicate listed(numbers a) = \valid(a) && a->relations.count <= 64 && a->count <= 4194304 &&
      a->count <= a->cap <= 1152921504606846976 && (0 < a->cap ==> \valid(a->number + (0 .. a->cap - 1))) &&
      \separated(a, a->number + (0 .. a->count - 1)) &&
      (\forall integer k; 0 <= k < a->relations.count ==> a->leaf[k].number < a->count) &&
      (\forall integer k; 0 <= k < a->count ==> a->number[k].a <= a->count) && angled(a) && cosines(a); */

/* That a line is left, and the list with one more: part by part, which CVC4 does not prove as one. */
/*@ requires listed(a) && a->count < 4194304 && reads(in) && \separated(a, in, in->err, in->in, LINES + (..));
    exits \false; ensures \result == DYD_OK ==> \valid(in) && \valid(in->in);
    ensures \result == DYD_OK ==> in->err == \null || \valid(in->err);
    ensures \result == DYD_OK ==> in->cap <= 1152921504606846976;
    ensures \result == DYD_OK ==> \separated(in, in->err, in->in, LINES + (..));
    ensures \result == DYD_OK && 0 < in->cap ==> \valid(in->line + (0 .. in->cap - 1)) &&
      \base_addr(in->line) == \base_addr(LINES + 0);
    ensures \result == DYD_OK && in->at != \null ==> 0 < in->cap && inside(in, in->at);
    ensures \result == DYD_OK ==> \valid(a) && a->relations.count <= 64 && a->count == \old(a->count) + 1;
    ensures \result == DYD_OK ==> a->count <= a->cap <= 1152921504606846976 && \valid(a->number + (0 .. a->cap - 1));
    ensures \result == DYD_OK ==> \forall integer k; 0 <= k < a->relations.count ==> a->leaf[k].number < a->count;
    ensures \result == DYD_OK ==> \forall integer k; 0 <= k < a->count ==> a->number[k].a <= a->count;
    ensures \result == DYD_OK ==> angled(a); ensures \result == DYD_OK ==> cosines(a);
    ensures \result == DYD_OK ==> \separated(a, a->number + (0 .. a->count - 1));
    ensures \result == DYD_OK ==> \separated(a, in, in->err, in->in, LINES + (..)); */
dyd_status dyd_cert_algebra_read(dyd_cert_algebra *a, dyd_cert_reader *in);

#endif
