/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs that no refinement decides, since that hangs on where points are in their cores [SET-1] [SET-2] [SET-4]. */
#ifndef DYD_ENGINE_SETTLE_H
#define DYD_ENGINE_SETTLE_H

#include "engine/state.h"
#include "engine/wants.h"

/* Cores of sites [SET-3] and firm ones [SET-2]. */

/* Sets *r to the rectangle of `site` with its core instead of each side that has one, an interval that no refinement
 * leaves: core[0] for x, core[1] for y. A side that is fixed is its own core; one with a radius has a core once the
 * centre is known to within the radius. */
dyd_status dyd_site_get_core(dyd_rect *r, bool core[2], const dyd_engine *e, uint32_t site);
/* Sets disc to centre and radius of a disc that every disc of the site holds [DISC-4]; the radius is 0 where none is
 * known, and the disc is smaller by about 2^-30 of it. Its centre is at most 2^20 radii from 0 along an axis. */
dyd_status dyd_disc_get_core(double disc[3], const dyd_engine *e, uint32_t site);
/* Sets *eps to 0 or a power of 2 that is at least the distance of any two points of a rectangle that differ only along
 * sides without a core. */
dyd_status dyd_firm_eps(dyd_dyadic *eps, const dyd_engine *e);
/* Raises *eps to what that is for one site. */
dyd_status dyd_firm_raise(dyd_dyadic *eps, const dyd_engine *e, uint32_t site);
/* Sets *out to the core of a guest, with a point for each side that has none, and raises *eps as dyd_firm_eps does. */
dyd_status dyd_firm_place(dyd_rect *out, dyd_dyadic *eps, const dyd_stream *at);
/* Sets *out to whether the cores of both ends are firm. */
dyd_status dyd_firm_pair(bool *out, const dyd_engine *e, const dyd_dyadic *eps, const dyd_pair *pair);
/* Sites by their cores; firm[k] becomes whether number k is firm. */
typedef struct dyd_firm_sites {
  const dyd_engine *e;
  const dyd_dyadic *eps;
  bool *firm;
  const uint32_t *site; /* NULL: all */
} dyd_firm_sites;
/* The dyd_rect_fn of them: the core less eps if it is firm, else with a point for each side that has no core. */
dyd_status dyd_firm_rect(dyd_rect *out, const void *sites, size_t k);

/* Pairs of one undecided face, examined one by one [SET-1] [SET-4]. */

/* possible: the pair is an edge for some choice of places in cores, wherever points are along the others;
 * unsure: it is not legal wherever they are narrowed to. */
typedef struct dyd_settled_pair {
  uint32_t i, j;
  bool possible, unsure;
} dyd_settled_pair;

static inline bool dyd_pair_is_settled(const dyd_settled_pair *p) {
  return p->possible && p->unsure;
}

/* Settled facts about pairs, for ever unless points are measured again. Init with {0}. Invariant: item is
 * sorted by i, j, without repeats; next: the bits from which another try pays; prover: proves that places are on one
 * circle or line; discs: NULL, or statuses of pairs whose points are in discs: these pairs are examined. */
typedef struct dyd_settled {
  dyd_settled_pair *item;
  size_t count, cap;
  int64_t next;
  dyd_prover prover;
  const dyd_pair_list *discs;
} dyd_settled;

/* Budget left: sites to examine, and proofs about places of regions. */
typedef struct dyd_settle_work {
  size_t sites, proofs;
} dyd_settle_work;

/* Examines open pairs of a face with the given sites, and records the facts found. Reduces *work; at 0 it stops. known:
 * has the callback for proofs; may be NULL. DYD_CANCELLED when e->stop was seen. Nothing is found where no side has a
 * core. */
dyd_status dyd_settle_face(dyd_settled_pair *pair, dyd_settle_work *work, const dyd_settled *known, const dyd_engine *e,
                           size_t pairs, const dyd_index_list *face);

void dyd_settled_clear(dyd_settled *s);
/* Returns true if the pair is indeterminate for good. */
bool dyd_is_settled(const dyd_settled *s, const dyd_pair *pair);
/* Examines pairs in undecided faces with cores and points that can be narrowed, when these are known to more
 * bits than most pairs need, and again each time they are known to four times as many. DYD_CANCELLED when e->stop was
 * seen. Bounded: about as long as a few first stages of the sites. */
dyd_status dyd_settle(dyd_settled *s, const dyd_wants *wants);

#endif
