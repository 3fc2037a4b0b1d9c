/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How coarse the sites of a face are, compared with the distances to their neighbours. */
#ifndef DYD_ENGINE_COARSE_H
#define DYD_ENGINE_COARSE_H

#include <dyadel/delaunay.h>

/* A site of the face. width: 2^(width-1) <= longer side < 2^width; scale: the least, over the neighbours examined, of
 * the same exponent of the largest of gap and widths of both. INT64_MIN means zero, INT64_MAX no neighbour. */
typedef struct dyd_coarse_site {
  dyd_rect rect;
  int64_t width, scale;
} dyd_coarse_site;

/* Init with {0}. Invariant: item[k] belongs to sites.item[k]; sites ascend. */
typedef struct dyd_coarse {
  dyd_index_list sites;
  dyd_coarse_site *item;
} dyd_coarse;

/* Examines face f: the pairs given, and sites next to one another in x. O((sites + pairs) log sites). */
dyd_status dyd_coarse_set(dyd_coarse *out, const dyd_delaunay *pd, size_t f, const dyd_pair_list *pairs);
void dyd_coarse_clear(dyd_coarse *c);
/* The bits to which the site is known relative to its distances: 0 where it meets a neighbour no wider than itself.
 * INT64_MAX for points, and where the distance is unknown. */
int64_t dyd_coarse_bits(const dyd_coarse *c, uint32_t site);

#endif
