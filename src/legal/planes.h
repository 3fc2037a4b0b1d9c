/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The half-planes met in a witness search, and the middle of them, in exact integers. */
#ifndef DYD_LEGAL_PLANES_H
#define DYD_LEGAL_PLANES_H

#include "legal/exact_lp.h"
#include <dyadel/rect.h>

enum { DYD_PLANES = 1024 };

/* Invariant: h[0..3] are a square's sides, h[4..count-1] hold all witnesses [WIT-1]; h[0..made-1] are initialised. All
 * ends of the rectangles seen are multiples of 2^low (times 1 / denominator), and less than 2^top. */
typedef struct dyd_plane_list {
  dyd_half_plane h[DYD_PLANES];
  size_t count, made;
  int64_t low, top;
  const volatile int *cancel; /* NULL: nobody can */
} dyd_plane_list;

void dyd_planes_init(dyd_plane_list *l, const volatile int *cancel);
void dyd_planes_clear(dyd_plane_list *l);
/* Adds the points nearer to the corner of `own` that is farthest from c than to the point of `other` nearest to c,
 * unless c is among them. false: the list is full, or the two points are one: no half-plane. */
bool dyd_planes_add(dyd_plane_list *l, const dyd_point *c, const dyd_rect *own, const dyd_rect *other);
/* *room: TRUE: c is the centre of the largest disc (in the sum norm) inside all half-planes, rounded so that it stays
 * inside; else c is unchanged or beyond use: FALSE: there is none, or none larger than the floor of witness.h; UNKNOWN:
 * no end. DYD_CANCELLED, DYD_E_NOMEM. */
dyd_status dyd_planes_centre(dyd_truth *room, dyd_point *c, dyd_plane_list *l);

#endif
