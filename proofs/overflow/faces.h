/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of open sets. */
#ifndef DYD_PROOFS_FACES_H
#define DYD_PROOFS_FACES_H

#include "graph.h"

#include "checker/faces.h"
#include "checker/parts.h"

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
bool dyd_cert_faces_tied(const dyd_cert_faces *f, uint32_t i, uint32_t j);
/*@ requires indexed(f) && i < SITES && j < SITES; assigns \nothing; exits \false; */
bool dyd_cert_faces_still(const dyd_cert_faces *f, uint32_t i, uint32_t j);
/*@ requires indexed(f) && i < SITES && j < SITES; exits \false; ensures indexed(f); */
void dyd_cert_faces_cover(dyd_cert_faces *f, uint32_t i, uint32_t j);
/*@ requires indexed(f); assigns \nothing; exits \false; */
uint64_t dyd_cert_faces_left(const dyd_cert_faces *f);

/*@ predicate sites_from(uint32_t *list, integer a, integer b) = \forall integer q; a <= q < b ==> list[q] < SITES;
    axiomatic Part { // a part of a list is a list: CVC4 does not see that (list + a)[k] is list[a + k]
      axiom part{L}: \forall uint32_t *list, integer a, b, n; 0 <= a && a + n <= b && sites_from{L}(list, a, b) ==>
        below{L}(list + a, n, SITES); } */

typedef const dyd_cert_parts *parts_of;
/*@ predicate grouped(parts_of p, integer count) = \valid_read(p) && 0 < p->groups <= count &&
      \valid_read(p->group + (0 .. count - 1)) && (\forall integer q; 0 <= q < count ==> p->group[q] < p->groups) &&
      \valid_read(p->start + (0 .. p->groups)) &&
      (\forall integer r; 0 <= r <= p->groups ==> p->start[r] <= p->start[p->groups]) &&
      p->start[p->groups] <= 2 * count && \valid_read(p->site + (0 .. 2 * count - 1)) &&
      below(p->site, p->start[p->groups], SITES) &&
      (\forall integer r; 0 <= r < p->groups ==> p->start[r] <= p->start[r + 1]); */

/*@ requires count < 1152921504606846976 && (0 < count ==> \valid(item + (0 .. count - 1)));
    assigns item[0 .. count - 1]; exits \false; ensures \result <= count && (0 < count ==> 0 < \result);
    ensures below{Pre}(item, count, BOUND) ==> below(item, \result, BOUND); */
size_t dyd_cert_distinct(uint32_t *item, size_t count);
/* The same of sites; of those at the end of a list, that it goes on. */
/*@ requires count < 1152921504606846976 && (0 < count ==> \valid(item + (0 .. count - 1))) &&
      below(item, count, SITES);
    assigns item[0 .. count - 1]; exits \false;
    ensures \result <= count && (0 < count ==> 0 < \result) && below(item, \result, SITES);
    ensures \forall uint32_t *list, integer n; 0 <= n && item == list + n && below{Pre}(list, n, SITES) ==>
      below(list, n + \result, SITES); */
size_t distinct_sites(uint32_t *item, size_t count);
/*@ requires \valid(p) && joined(g) && 0 < count <= 2 * g->count && \valid_read(walk + (0 .. count - 1)) &&
      below((uint32_t *)walk, count, 2 * g->count) && \valid_read(corner + (0 .. SITES - 1)) &&
      \separated(p, g, g->sites, g->legal, g->bridges, walk + (0 .. count - 1), corner + (0 .. SITES - 1),
        g->legal->item + (0 .. g->legal->count - 1), g->bridges->item + (0 .. g->bridges->count - 1));
    exits \false; ensures \result == DYD_OK ==> grouped(p, count); */
dyd_status dyd_cert_parts_init(dyd_cert_parts *p, const dyd_cert_graph *g, const uint32_t *walk, size_t count,
                               const bool *corner);
/*@ requires \valid(p); assigns *p; exits \false; */
void dyd_cert_parts_clear(dyd_cert_parts *p);

#endif
