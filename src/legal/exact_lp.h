/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The linear programme of lp_filter.h in integers: the middle of a few half-planes. */
#ifndef DYD_LEGAL_EXACT_LP_H
#define DYD_LEGAL_EXACT_LP_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

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
 * or *cancel (NULL: nobody can) is set. */
bool dyd_exact_lp(dyd_exact_centre *out, const dyd_half_plane *h, size_t count, const volatile int *cancel);

#endif
