/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of a certificate whose pairs are being read: lists of pairs, open sets. Of readers, see read.h. */
#ifndef DYD_PROOFS_PAIRING_H
#define DYD_PROOFS_PAIRING_H

#include "facts.h"

#include "checks.h"

typedef const dyd_cert_site *site_to_read;

/* begun: a line was read, and nothing of it yet. */
/*@ predicate begun(checking c) = checks(c) && 0 < c->in.cap && inside(&c->in, c->in.line);
    predicate grows(edges e) = e->count <= e->cap <= 1152921504606846976 && pairs(e, SITES) &&
      (0 < e->cap ==> \valid(e->item + (0 .. e->cap - 1)) && \separated(e->item + (0 .. e->cap - 1), e));
    predicate certified_site(site_to_read s) = small_site(s) && s->alias < SITES;
    predicate certified_sites(checking c) = \forall integer i; 0 <= i < SITES ==> certified_site(c->sites.site + i);
    predicate open_pairs(checking c) = c->sites.count == SITES && certified_sites(c) && indexed(&c->faces) &&
      pairs(&c->legal, SITES) && grows(&c->open) && grows(&c->tie) && grows(&c->chained) &&
      \separated(c, c->in.err, c->faces.first + (0 .. SITES), c->faces.of + (0 .. c->faces.members - 1),
        c->faces.start + (0 .. c->faces.sets), c->faces.covered + (0 .. c->faces.sets - 1),
        c->legal.item + (0 .. c->legal.count - 1), c->open.item + (0 .. c->open.cap - 1),
        c->tie.item + (0 .. c->tie.cap - 1), c->chained.item + (0 .. c->chained.cap - 1));
    predicate blocked(checking c) = c->chain.points <= c->chain.cap <= 1152921504606846976 &&
      (0 < c->chain.cap ==> \valid(c->chain.point + (0 .. c->chain.cap - 1)) &&
        \valid(c->chain.blocker + (0 .. c->chain.cap))) &&
      exact(&c->chain.u[0][0]) && exact(&c->chain.u[0][1]) && exact(&c->chain.u[1][0]) && exact(&c->chain.u[1][1]);
    predicate reported(checking c) = \valid_read(c) && string(c->report.outcome) && string(c->report.goal) &&
      -999999999999999999 <= c->report.goal_bits <= 999999999999999999; */

/* All that is known of a certificate while its pairs are read, and after it. */
/*@ predicate pairing(checking c) = checker(c) && open_pairs(c) && blocked(c) && reported(c) && listing(&c->ties) &&
      blocks(&c->ties); */

/* What graph.c proves of dyd_cert_edges_add; and that what was in the list stays, as well as all else, which WP does
 * not see: new memory is new. */
/*@ requires grows(edges) && i < SITES && j < SITES; assigns *edges, edges->item[0 .. edges->cap - 1]; exits \false;
    ensures grows(edges); */
dyd_status add_pair(dyd_cert_edges *edges, uint32_t i, uint32_t j);
#define dyd_cert_edges_add(edges, i, j) add_pair(edges, i, j)
/* What faces.h says of dyd_cert_faces_cover, and that it counts only, as the invariant of its loop in faces.c says. */
/*@ requires indexed(f) && i < SITES && j < SITES; assigns f->covered[0 .. f->sets - 1]; exits \false;
    ensures indexed(f); */
void cover_pair(dyd_cert_faces *f, uint32_t i, uint32_t j);
#define dyd_cert_faces_cover(f, i, j) cover_pair(f, i, j)

#endif
