/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which sites are nearest to somewhere in a box [CERT-12]. */
#ifndef DYD_CHECKER_NEAR_H
#define DYD_CHECKER_NEAR_H

#include "checker/caps.h"

/* Ends of a box: x lower, x upper, y lower, y upper. */
typedef struct dyd_cert_span {
  dyd_exact e[4];
} dyd_cert_span;

void dyd_cert_span_init(dyd_cert_span *b);
void dyd_cert_span_clear(dyd_cert_span *b);
/* out = the rectangle of a site, its ends rounded outward to dyadics. */
void dyd_cert_span_set(dyd_cert_span *out, const dyd_cert_site *s);
bool dyd_cert_span_is_point(const dyd_cert_span *b);

/* Returns true if corner q of the box (bit 0: x, bit 1: y) has dl_k < ds_j. */
bool dyd_cert_span_prefers(const dyd_cert_span *b, int q, const dyd_cert_span *k, const dyd_cert_span *j);

/* d = the distance along an axis from c to the closer, or (far) the farther end of the side; scratch: another number.
 */
void dyd_cert_axis_gap(dyd_exact *d, dyd_exact *scratch, const dyd_exact *c, const dyd_exact side[2], bool far);
/* out = the square of ds, or (far) of dl, from corner q of the box to the site. */
void dyd_cert_corner_distance2(dyd_exact *out, const dyd_cert_span *b, int q, const dyd_cert_span *site, bool far);
/* The box on the grid, rounded outward. */
void dyd_cert_span_on_grid(dyd_cert_centre *out, const dyd_cert_sites *s, const dyd_cert_span *b);
/* part = a half of the box, which is cut in the middle of its longer side. */
void dyd_cert_span_half(dyd_cert_span *part, const dyd_cert_span *b, bool upper);

/* The boxes of all sites, of the number `count`. DYD_E_NOMEM */
dyd_status dyd_cert_spans_init(dyd_cert_span **out, const dyd_cert_sites *s);
void dyd_cert_spans_free(dyd_cert_span *span, size_t count);

/* A question: which sites are nearest to some point of `at`. list[0 .. count-1] (count > 0) are stated; `self` (or
 * DYD_CERT_NONE) takes no part. */
typedef struct dyd_cert_near {
  const dyd_cert_sites *sites;
  const dyd_cert_tree *tree;
  const dyd_cert_span *span; /* by site */
  const dyd_cert_disc *disc; /* by site: the point lies in it, too; NULL: in none */
  const dyd_cert_span *at;
  uint32_t self;
  const uint32_t *list;
  size_t count;
} dyd_cert_near;

/* Is list[0] strictly nearer than all others, everywhere in the box, for every choice? *other: one that is not farther.
 * Exact. */
bool dyd_cert_near_is_certain(uint32_t *other, const dyd_cert_near *q);
/* Counts the sites that are not listed and may be nearest to a point of the box: *unproved are not proved to be nowhere
 * nearest, and *other one of them. A box is cut to show it; that gives up after *effort comparisons, which are taken
 * from it. */
void dyd_cert_near_count(size_t *unproved, uint32_t *other, uint64_t *effort, const dyd_cert_near *q);
/* Is the distance of any two points of the boxes in [lo, hi]? hi: NULL: no bound. disc: the second lies in it, too;
 * NULL: in none. */
bool dyd_cert_near_bounds_hold(const dyd_cert_span *a, const dyd_cert_span *b, const dyd_cert_disc *disc,
                               const dyd_exact *lo, const dyd_exact *hi);

#endif
