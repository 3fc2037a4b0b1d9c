/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which places of a sphere are nearest to a place [CERT-12]. */
#ifndef DYD_CHECKER_GLOBE_NEAR_H
#define DYD_CHECKER_GLOBE_NEAR_H

#include "checker/region.h"

/* All of a region is within r, straight through the sphere, of the point v; unit 2^-30 of its radius. alias: it is the
 * same exact place as another one, and takes no part. */
typedef struct dyd_cert_bowl {
  int64_t v[3], r;
  bool alias;
} dyd_cert_bowl;

/* Where each of `count` places may be. */
typedef struct dyd_cert_compass {
  dyd_cert_region *region;
  dyd_cert_bowl *bowl;
  size_t count;
} dyd_cert_compass;

/* Regions are initialised; DYD_E_NOMEM. To be cleared, on failure too. */
dyd_status dyd_cert_compass_init(dyd_cert_compass *c, size_t count);
void dyd_cert_compass_clear(dyd_cert_compass *c);
/* Region i has been set. */
void dyd_cert_compass_note(dyd_cert_compass *c, size_t i, bool alias);

/* Is place i strictly nearer than all others, to each place of `at`, for every choice? *other: one that is not seen to
 * be farther. */
bool dyd_cert_compass_is_certain(uint32_t *other, const dyd_cert_compass *c, const dyd_cert_region *at, uint32_t i);
/* Adds to *unproved the places that are not listed (count > 0) and not proved to be nearest to no place of `at`. */
void dyd_cert_compass_count(uint64_t *unproved, const dyd_cert_compass *c, const dyd_cert_region *at,
                            const uint32_t *list, size_t count);
/* Is the distance of any two places of the regions, in metres on the ground, seen to be in [lo, hi]? hi: NULL: no
 * bound. */
bool dyd_cert_ground_bounds_hold(const dyd_cert_region *a, const dyd_cert_region *b, const dyd_exact *lo,
                                 const dyd_exact *hi);

#endif
