/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries of the Voronoi layer: chains of arcs on which dl_far = ds_near (mathematics: section 2; KEL
 * sections 2, 3).
 *
 * While the quadrant of c about the centre of R_far stays the same, the farthest point of R_far is one corner, the
 * focus; while the closest feature of R_near stays the same, it is one corner or one side. So every arc lies on the
 * bisector line of two corners, or on the parabola of a corner and the line of a side, and every arc ends at a point
 * with coordinates A + B sqrt(C) or at infinity [ARC-1]. */
#ifndef DYADEL_ARC_H
#define DYADEL_ARC_H

#include <dyadel/predicate.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The point ((ax + bx sqrt(c)) / d, (ay + by sqrt(c)) / d). Invariant: c >= 0, d > 0. */
typedef struct dyd_surd_point {
  mpz_t ax, bx, ay, by, c, d;
} dyd_surd_point;

/* The smallest rectangle with ends that are multiples of 2^-bits around p: widths 0 or 2^-bits. Exact.
 * DYD_E_RANGE when bits or p leave the exponent range. */
DYD_API dyd_status dyd_surd_point_enclose(dyd_rect *out, const dyd_surd_point *p, int64_t bits);

/* Corners of a rectangle: bit 0 chooses x1 over x0, bit 1 y1 over y0. Sides by the coordinate that is fixed. */
typedef enum dyd_feature_kind {
  DYD_CORNER_00 = 0,
  DYD_CORNER_10 = 1,
  DYD_CORNER_01 = 2,
  DYD_CORNER_11 = 3,
  DYD_SIDE_X0 = 4,
  DYD_SIDE_X1 = 5,
  DYD_SIDE_Y0 = 6,
  DYD_SIDE_Y1 = 7
} dyd_feature_kind;

typedef enum dyd_arc_kind {
  DYD_ARC_LINE = 0, /* bisector of the focus and a corner */
  DYD_ARC_PARABOLA, /* focus and the line of a side */
  DYD_ARC_WINDOW    /* part of a side of the window; far, near, corner, feature mean nothing */
} dyd_arc_kind;

typedef enum dyd_end_kind {
  DYD_END_INFINITE = 0, /* the arc is unbounded; at is unused */
  DYD_END_SITES,        /* a third site: ds (Int) or dl (Pos) of `site` equals the radius too */
  DYD_END_AXIS,         /* the farthest corner of the far site changes */
  DYD_END_FEATURE,      /* the closest feature of the near site changes */
  DYD_END_WINDOW        /* a side or corner of the window */
} dyd_end_kind;

typedef struct dyd_arc_end {
  dyd_end_kind kind;
  uint32_t site; /* for DYD_END_SITES the lowest third site that bounds the cell, else 0. Where all sites are exact
                    points, one whose pair is a tie does not */
  dyd_surd_point at;
} dyd_arc_end;

/* Invariant: dl_far = ds_near on the arc, |c - corner of far| = distance to the feature of near. Between its ends an
 * arc is monotone along the bisector line, or along the directrix. A singleton's corners are all named
 * DYD_CORNER_00, and a degenerate side's (x0 = x1 or y0 = y1) sides and corners the one with the lower bit. */
typedef struct dyd_arc {
  dyd_arc_kind kind;
  uint32_t far_site, near_site;
  dyd_feature_kind corner;  /* of far_site: the focus */
  dyd_feature_kind feature; /* of near_site: a corner for lines, a side for parabolas */
  dyd_arc_end begin, end;
} dyd_arc;

/* A chain of arcs, each beginning where the one before ends; closed: the last one ends where the first begins;
 * otherwise both ends are at infinity. The region that the chain bounds is on its left. */
typedef struct dyd_chain {
  size_t count;
  dyd_arc *arc;
  bool closed;
} dyd_chain;

/* The boundary of an open or closed region of the plane. No chain: the region is empty or the whole plane, as
 * `whole` says. A region in a window that is all of it is `whole` too, and its chain is the window's sides; parts of it
 * that have no area (a curve that runs along a side from outside) are omitted. Owned by the caller: init with {0},
 * release with dyd_boundary_clear. */
typedef struct dyd_boundary {
  size_t count;
  dyd_chain *chain;
  bool whole;
} dyd_boundary;
DYD_API void dyd_boundary_clear(dyd_boundary *b);

/* The boundary of C_ab = { c : dl_a(c) < ds_b(c) }, sites called 0 (a) and 1 (b); one chain of at most 7 arcs
 * [BIS-1]; C_ab is empty when the rectangles meet. The partial bisector of a and b is the complement of C_ab u C_ba.
 * *out is replaced. Exact. */
DYD_API dyd_status dyd_bisector(dyd_boundary *out, const dyd_rect *a, const dyd_rect *b);

#ifdef __cplusplus
}
#endif
#endif
