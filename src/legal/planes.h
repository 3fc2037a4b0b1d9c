/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The half-planes met in a witness search, and the middle of them, in exact integers. */
#ifndef DYD_LEGAL_PLANES_H
#define DYD_LEGAL_PLANES_H

#include <dyadel/rect.h>

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

/* The linear program of legal/lp_filter.h in integers: the middle of a few half-planes. */

/* a x + b y + c > 0, with w = |a| + |b| > 0. */
typedef struct dyd_half_plane {
  mpz_t a, b, c, w;
} dyd_half_plane;

void dyd_half_plane_init(dyd_half_plane *h);
void dyd_half_plane_clear(dyd_half_plane *h);

/* The point (x, y) / d, d > 0, that maximises z / d = min over the half-planes of (a x + b y + c) / w. */
typedef struct dyd_exact_centre {
  mpz_t x, y, z, d;
} dyd_exact_centre;

void dyd_exact_centre_init(dyd_exact_centre *p);
void dyd_exact_centre_clear(dyd_exact_centre *p);

/* The half-planes h[0..3] must be the sides x > -m, x < m, y > -m, y < m of a square (w = |a| or |b|). z <= 0
 * afterwards says that the open half-planes have no common point [LP-1]. false: no end after many steps, or no memory,
 * or *cancel (may be NULL) is set. */
bool dyd_exact_lp(dyd_exact_centre *out, const dyd_half_plane *h, size_t count, const volatile int *cancel);

enum { DYD_PLANES = 1024 };

/* Invariant: h[0..3] are a square's sides, h[4..count-1] hold all witnesses [WIT-1]; h[0..made-1] are initialised. All
 * ends of the rectangles seen are multiples of 2^low (times 1 / denominator), and less than 2^top. */
typedef struct dyd_plane_list {
  dyd_half_plane h[DYD_PLANES];
  size_t count, made;
  int64_t low, top;
  const volatile int *cancel; /* may be NULL */
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
