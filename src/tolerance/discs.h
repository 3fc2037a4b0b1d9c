/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A pair of discs, and the others that are looked at for it [DISC-1]. */
#ifndef DYD_TOLERANCE_DISCS_H
#define DYD_TOLERANCE_DISCS_H

#include "tolerance/caps.h"
#include <dyadel/delaunay.h>

/* Invariant: i and j are not among seen[0 .. count-1], and no vertex is twice. */
typedef struct dyd_disc_work {
  const dyd_delaunay *pd;
  dyd_disc *disc;     /* by vertex */
  double (*about)[3]; /* x, y, r of these in doubles, where statuses are asked for */
  dyd_caps caps;
  uint32_t i, j; /* vertices, the smaller disc first */
  uint32_t *seen;
  size_t count, cap, loaded;  /* loaded: how many of these have caps, or meet i or j */
  bool failed;                /* memory is exhausted */
  const volatile int *cancel; /* ends what dyd_disc_pairs_until does; may be NULL */
} dyd_disc_work;

/* The disc in a square, whose ends may have been rounded outward by less than 2^-50 of what they are: so is the disc.
 * false: it is no square. */
bool dyd_disc_of_square(dyd_disc *d, const dyd_rect *r);
/* Looks at v from now on; false: it is i, j or seen already, or memory is exhausted. */
bool dyd_discs_see(dyd_disc_work *w, uint32_t v);
/* The caps of all that are seen; false: one of them meets i or j, so that there is no witness. Who meets one of them
 * blocks nothing. */
bool dyd_discs_load(dyd_disc_work *w, bool legal);
/* The same when only the last of these were not seen before. */
bool dyd_discs_load_more(dyd_disc_work *w, bool legal);

/* weights_guess_filter.c: about the t between lo and hi from which on the pair is no longer legal (or illegal) for the
 * sites that are seen, the discs of all v having radius t weight[v]. */
double dyd_filter_guess_weight(const dyd_disc_work *w, const double *weight, bool legal, double lo, double hi);

#endif
