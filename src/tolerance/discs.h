/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Discs about two sites, inverted: circles become lines, and each other disc a cap of directions [DISC-1].
 *
 * Let R_i <= R_j. With p_i as the origin and x -> x / |x|^2, the circle through p_i about c is the line u.x = h, u = c
 * / |c|, h = 1 / (2 |c|), its inside u.x > h. A disc (P, r) that does not hold the origin becomes that of centre q =
 * P/n and radius rho = r/n, n = |P|^2 - r^2. With delta = R_j - R_i about p_j and r_k = R_k + R_i about the others:
 *
 *   possible   for some u with u.q_j >= -rho_j, no k has u.(q_k - q_j) > rho_k + rho_j;
 *   legal      for some u with u.q_j > rho_j, every k has u.(q_j - q_k) > rho_j + rho_k.
 *
 * So each site is an open cap {u : u.w > tau} of the circle of directions, w and tau rational: an end of one is inside
 * another or not by the sign of a + b sqrt(c) [SQR-1]. w and tau may both be multiplied by a number above 0. */
#ifndef DYD_TOLERANCE_DISCS_H
#define DYD_TOLERANCE_DISCS_H

#include "predicate/interval_filter.h"
#include "skeleton/rects_filter.h"

#include <dyadel/delaunay.h>
#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A disc: centre and radius. */
typedef struct dyd_disc {
  mpq_t x, y, r;
} dyd_disc;
void dyd_disc_init(dyd_disc *d);
void dyd_disc_clear(dyd_disc *d);
/* Returns true if they have a common point. */
bool dyd_discs_meet(const dyd_disc *a, const dyd_disc *b);

/* Returns true if the one of the smaller radius is in the other. */
bool dyd_disc_is_within(const dyd_disc *small, const dyd_disc *large);

/* A direction in doubles, approximately; its circle is tested afterwards. off: of an end, how far it is off at most. */
typedef struct dyd_direction {
  double x, y, off;
} dyd_direction;

/* tau >= 0, ww = |w|^2, c = ww - tau^2: the cap is empty unless c > 0. Rationals are there once they are needed: wx to
 * c where `exact`. In doubles, w and tau to within `off`, c to within off_c; for both, w and tau may be multiplied by
 * different numbers above 0. */
typedef struct dyd_cap {
  uint32_t vertex;
  const dyd_disc *disc;
  bool exact;
  mpq_t wx, wy, tau, ww, c;
  double w[2], top, off, in_c, off_c;
} dyd_cap;

/* A disc seen from i, in doubles: centre, sum (of j: difference) of the radii, n; their sum norm and that of their
 * errors are at most size and off, that of n is off_n. */
typedef struct dyd_relative {
  double x, y, r, n, size, off, off_n;
} dyd_relative;

/* Invariant: item[0 .. made-1] are initialised, item[0 .. count-1] in use; (qx, qy) / n, rho / n, n > 0: what became of
 * disc j, where item[0] is exact. i, and the discs of caps: borrowed until the next dyd_caps_begin. */
typedef struct dyd_caps {
  const dyd_disc *i;
  bool legal;
  double at[3]; /* of i */
  dyd_relative j;
  mpq_t qx, qy, rho, n;
  dyd_cap *item;
  size_t count, made, cap;
  size_t first; /* the caps before it have no uncovered end */
  size_t by[2]; /* whose ends the direction found is between, or at */
  mpq_t a, b, s, t;
} dyd_caps;

void dyd_caps_init(dyd_caps *c);
void dyd_caps_clear(dyd_caps *c);

/* Begins for the discs i, j with i.r <= j.r, neither inside the other. legal: which of the two questions. */
bool dyd_caps_begin(dyd_caps *c, const dyd_disc *i, const dyd_disc *j, bool legal);
/* Adds disc k, disjoint from i, which is borrowed. false: memory is exhausted. */
bool dyd_caps_add(dyd_caps *c, const dyd_disc *k, uint32_t vertex);

/* caps_filter.c: the doubles of cap k, from those of discs or from its rationals. */
void dyd_filter_cap(dyd_cap *k, dyd_caps *c);
void dyd_filter_cap_rounded(dyd_cap *k);
/* The sign of c; 0: not certain. */
int dyd_filter_cap_size(const dyd_cap *k);
/* The end of cap e on the side `turn` (1: counter-clockwise), and the sign of u.w_k - tau_k there; 0: not certain. */
dyd_direction dyd_filter_cap_end(const dyd_cap *e, int turn);
/* About the middle of two directions less than half a turn apart. */
dyd_direction dyd_filter_between(const dyd_direction end[2]);
int dyd_filter_cap_side(const dyd_direction *u, const dyd_cap *k);

/* Returns true if a direction within the bounds is in no cap. The first cap is the bound: the direction must not be in
 * it. */
bool dyd_caps_uncovered(dyd_direction *u, dyd_caps *c);
/* Returns true if all caps hold a common direction. *u: about the middle of them. */
bool dyd_caps_common(dyd_direction *u, dyd_caps *c);
/* A circle about the direction that was found last, within about 2^-bits of its size; it holds the two discs.
 * false: at this precision it is a half-plane. */
bool dyd_caps_circle(dyd_disc *out, dyd_caps *c, unsigned bits);

/* A pair, and the other discs considered for it. Invariant: i and j are not among seen[0 .. count-1], and no vertex is
 * twice. */
typedef struct dyd_disc_work {
  const dyd_delaunay *pd;
  const dyd_sites *sites; /* the places; multiplied by 2^scale in pd, which is `scaled` where scale is not 0 */
  int scale;
  dyd_delaunay *scaled;
  dyd_disc *disc;       /* by vertex */
  double (*about)[3];   /* x, y, r of these in doubles */
  const double *weight; /* by vertex: radii are weight[v] * now; NULL: those of `about` */
  double now, heaviest; /* the largest weight, or 0 */
  const dyd_tree *tree; /* of boxes; radii by weights reach out of them, others do not but for roundings */
  unsigned most_bits;   /* of circles where doubles place none; 0: unknown then */
  dyd_caps caps;
  uint32_t i, j; /* vertices, the smaller disc first */
  uint32_t *seen;
  size_t count, cap, loaded;  /* loaded: how many of these have caps, or meet i or j */
  bool failed;                /* memory is exhausted */
  const volatile int *cancel; /* ends what dyd_disc_pairs does; may be NULL */
} dyd_disc_work;

/* The disc in the square of a site, larger by what the ends may have been rounded by: less than 2^-61 of the width for
 * sites given as exact rectangles, of others 2^-50 of the coordinates, up to the disc around the square. Of sites that
 * enclose a place without a radius, and may be narrowed, a disc that holds the rectangle [DISC-5]. DYD_E_ARG: the
 * rectangle is not a square. */
dyd_status dyd_disc_of_site(dyd_disc *d, const dyd_sites *s, size_t i);
/* discs_filter.c: encloses its centre and radius in doubles. */
dyd_status dyd_filter_ball(dyd_iv ball[3], const dyd_sites *s, size_t i);
/* The discs of all vertices of pd, from sites; a disc of radius 0 for a point. */
dyd_status dyd_discs_make(dyd_disc_work *w, dyd_error *err);
/* Whatever dyd_discs_make returned. */
void dyd_discs_clear(dyd_disc_work *w);
/* Includes v from now on; false: it is i, j or seen already, or memory is exhausted. */
bool dyd_discs_see(dyd_disc_work *w, uint32_t v);
/* Makes `now` what weights are multiplied by, for the pair and all seen. */
void dyd_discs_weigh(dyd_disc_work *w, double now);
/* The search for the sites that bind [DISC-1] [TOL-8]. Returns whether the pair is legal, or, without `legal`,
 * possible; the discs that show it are seen afterwards, but for far ones. DYD_UNKNOWN: no circle was precise enough, or
 * memory is exhausted (w->failed). */
dyd_truth dyd_discs_ask(dyd_disc_work *w, bool legal);

#endif
