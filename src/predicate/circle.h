/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From circles in scaled integers to circles in the coordinates of the caller. */
#ifndef DYD_PREDICATE_CIRCLE_H
#define DYD_PREDICATE_CIRCLE_H

#include "rect/irect.h"
#include <dyadel/predicate.h>

/* A number (a + b sqrt(c)) / d, d > 0, c >= 0, against integers and integer rectangles. */

/* Borrowed parts. */
typedef struct dyd_surd {
  mpz_srcptr a, b, c, d;
} dyd_surd;

/* z * 2^e for e > 0; nothing otherwise. */
static inline void dyd_shift_up(mpz_ptr z, int64_t e) {
  if (e > 0) mpz_mul_2exp(z, z, (mp_bitcnt_t)e);
}

/* Sign of s - z; t is scratch. */
int dyd_surd_compare(mpz_ptr t, const dyd_surd *s, mpz_srcptr z);
/* p + q sqrt(c) += d^2 (distance from the point (x, y) to r)^2, closest or farthest; x, y have one c and one d. */
void dyd_surd_add_distance2(mpz_ptr p, mpz_ptr q, const dyd_surd xy[2], const dyd_irect *r, dyd_touch touch);

/* Circles through features of integer rectangles: critical circles of three rectangles, found exactly.
 *
 * F-points are corners; C-points are corners or lie on an axis-parallel side. A critical circle passes through at
 * least one corner, so its centre and squared radius have the form A + B sqrt(C) (mathematics: section 4). */

/* Centre ((ax + bx sqrt(c)) / d, (ay + by sqrt(c)) / d), d > 0, c >= 0, and one given corner (px, py) on the
 * circle, in the scaled integer coordinates of the rectangles it came from. */
typedef struct dyd_icircle {
  mpz_t ax, bx, ay, by, c, d;
  mpz_t px, py;
} dyd_icircle;

void dyd_icircle_init(dyd_icircle *k);
void dyd_icircle_clear(dyd_icircle *k);
DYD_ARRAYS(dyd_icircle)
void dyd_icircle_swap(dyd_icircle *k, dyd_icircle *l);

/* Every circle that meets r[m] as touch[m] says (closest: ds = radius; farthest: dl = radius), m = 0, 1, 2;
 * at least one farthest, at least one closest. Radius 0 is not a circle. Where two features coincide there may be a
 * continuum of circles, of which only isolated ones are found; there is none for disjoint C-rectangles that are
 * disjoint from the F-rectangles. At most `room` are stored in out (initialised by the caller), without repeats;
 * the search stops there. Returns how many are stored; room = 4 always suffices [CRIT-1], and room = 1 is fastest
 * for a certainly oriented triple, where the circle is unique. */
size_t dyd_icircles(dyd_icircle *out, size_t room, const dyd_irect *const r[3], const dyd_touch touch[3]);

/* Sign of (closest or farthest distance of the centre to r) - radius. Exact. */
int dyd_icircle_side(const dyd_icircle *k, const dyd_irect *r, dyd_touch touch);

/* Sign of (coordinate of the centre of k) - (that of l); axis 0: x, axis 1: y. Both in the same scaled
 * coordinates. Exact. */
int dyd_icircle_compare(const dyd_icircle *k, const dyd_icircle *l, int axis);

/* An enclosure of the centre in scaled coordinates multiplied by 2^-shift: out = xlo, xhi, ylo, yhi, rounded
 * outward, within a few ulp. */
void dyd_icircle_centre_d(double out[4], const dyd_icircle *k, int64_t shift);

/* Exact rungs of the predicates on integer rectangles. */
dyd_sure dyd_irect_orientation(const dyd_irect *a, const dyd_irect *b, const dyd_irect *c);
/* r against the partial disc of a triple that is known to be certainly oriented, PLUS or MINUS. */
dyd_sure dyd_irect_con_oriented(const dyd_irect *r, const dyd_irect *const abc[3], dyd_sure orientation);

/* out = k divided by man * 2^exp, man > 0: undoes dyd_irects_scale. Exact. */
void dyd_circle_unscale(dyd_circle *out, const dyd_icircle *k, mpz_srcptr man, int64_t exp);

void dyd_circle_set(dyd_circle *out, const dyd_circle *c);
/* The critical circle of three certainly oriented rectangles: touch[k] says how it meets r[k]. At least one F,
 * at least one C. Unique [CRIT-1]. DYD_E_ARG when the triple is not certainly oriented or the labels are all equal. */
dyd_status dyd_critical_circle(dyd_circle *out, const dyd_rect *const r[3], const dyd_touch touch[3]);
/* Sign of (distance of the circle's centre to r, closest or farthest) - radius. Exact. */
int dyd_circle_side(const dyd_circle *c, const dyd_rect *r, dyd_touch touch);
/* PLUS: r is inside I; MINUS: r is inside E; UNSURE otherwise. */
dyd_sure dyd_partial_disc_con(const dyd_partial_disc *d, const dyd_rect *r);
/* Compares the distances of c from all points of a and all of b. TRUE: dl(c,a) < ds(c,b). FALSE: dl(c,b) < ds(c,a).
 * UNKNOWN otherwise. */
dyd_truth dyd_nearer(const dyd_point *c, const dyd_rect *a, const dyd_rect *b);
/* Sign of dist(c,a) - dist(c,b), each distance closest or farthest. Exact. */
int dyd_compare_distance(const dyd_point *c, const dyd_rect *a, dyd_touch ta, const dyd_rect *b, dyd_touch tb);

void dyd_circle_init(dyd_circle *c);
void dyd_circle_clear(dyd_circle *c);

/* The quad rule: TRUE when the pair ab certainly cannot displace the pair ij in any Delaunay triangulation
 * (Ed(i,j) and Ed(a,b) disjoint, or Con(a;i,j,b) = -, or Con(b;i,j,a) = -), UNKNOWN otherwise [QUAD-1]. */
dyd_truth dyd_cannot_displace(const dyd_rect *i, const dyd_rect *j, const dyd_rect *a, const dyd_rect *b);

#endif
