/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The boundary of a region in a window in doubles: what dyd_cell_boundary finds exactly, with boxes instead of points.
 *
 * Each step of the exact work is done in intervals that hold, and each decision is taken only where these leave no
 * doubt; else the filter declines and the exact rung does the cell [OUTLINE-1]. */
#ifndef DYD_VORONOI_OUTLINE_FILTER_H
#define DYD_VORONOI_OUTLINE_FILTER_H

#include "delaunay/state.h"
#include "voronoi/exact_cell_filter.h"

enum { DYD_OUTLINE_OTHERS = 4096, DYD_OUTLINE_ARCS = 2048, DYD_OUTLINE_MEETS = 512, DYD_OUTLINE_PIECES = 512 };

/* A point, relative to the origin of the outline. at[a] encloses coordinate a. side[a]: which end of the window (0, 1)
 * coordinate a is, exactly; else -1. */
typedef struct dyd_outline_spot {
  dyd_iv at[2];
  int side[2];
} dyd_outline_spot;

/* As dyd_elementary, whose words it uses. tilt[a]: sign of q[a] - s[a]. near_side[a]: 1 beyond the upper side of the
 * near rectangle, else -1. */
typedef struct dyd_outline_arc {
  dyd_filter_arc shape;
  uint32_t curve;
  int axis, branch, corner, feature;
  bool either;                           /* the exact work may go along the other axis */
  int tilt[2], near_side[2], mark[2][2]; /* mark: of the lower and the upper end of the pane along each axis */
  dyd_iv lo[2], hi[2], span[2];          /* span: encloses the coordinates of all its points */
  dyd_outline_spot end[2];
} dyd_outline_arc;

/* As dyd_piece. */
typedef struct dyd_outline_piece {
  uint32_t curve;
  const dyd_outline_arc *arc;
  const dyd_outline_spot *begin, *end;
} dyd_outline_piece;

/* A point in which two curves meet: of arcs a and b. */
typedef struct dyd_outline_meet {
  uint32_t arc[2];
  dyd_outline_spot spot;
} dyd_outline_meet;

/* The box of a site relative to the origin, which may be too wide by slack on each side. */
typedef struct dyd_outline_rival {
  dyd_bbox box;
  double slack;
} dyd_outline_rival;

/* Rivals that may take points, the first `count` of `all`, in any order, a row for each part of a rival: xlo, xhi, ylo,
 * yhi, slack and number. */
enum { DYD_OUTLINE_LANES = 4, DYD_RIVAL_SLACK = 4, DYD_RIVAL_NUMBER, DYD_RIVAL_PARTS };
typedef struct dyd_outline_rivals {
  double part[DYD_RIVAL_PARTS][DYD_OUTLINE_OTHERS];
  size_t count, all;
} dyd_outline_rivals;

/* Loaded once for a site: site, count, sites, box and thin (its own last). The rest is found by dyd_filter_outline:
 * part[0 .. parts) is the closed boundary, with the region on the left; parts = 0: there is none. curve = count + side:
 * of the window. */
typedef struct dyd_outline {
  uint32_t site[DYD_OUTLINE_OTHERS + 1];
  const dyd_sites *sites; /* borrowed, as rect is: the window */
  const dyd_rect *rect;
  size_t count;
  dyd_box box[DYD_OUTLINE_OTHERS + 1], window;
  bool thin[DYD_OUTLINE_OTHERS + 1][2]; /* equal ends, though doubles may not hold them */
  double origin[2];
  bool outer, unsure;
  dyd_iv near[DYD_OUTLINE_OTHERS + 1][4], frame[4]; /* relative to the origin; frame: the window */
  bool drop[DYD_OUTLINE_OTHERS];                    /* meets the site: does not matter to Pos */
  dyd_outline_rival reach[DYD_OUTLINE_OTHERS + 1];
  dyd_outline_rivals rivals; /* those not dropped */
  double limit[4];           /* lower and upper bounds of all points of Pos, hence of Int */
  dyd_iv bound[4];           /* the window cut down to them, */
  bool of_window[4];         /* where that is an end of the window */
  dyd_outline_arc arc[DYD_OUTLINE_ARCS];
  dyd_outline_meet meet[DYD_OUTLINE_MEETS];
  dyd_outline_spot corner[4];
  dyd_outline_piece piece[DYD_OUTLINE_PIECES], part[DYD_OUTLINE_PIECES];
  size_t arcs, meets, pieces, parts;
  const dyd_outline_spot *cut[DYD_OUTLINE_MEETS + 2];
} dyd_outline;

/* The site and its neighbours with at least the status `least`. *done = false: too many of them, or ends beyond
 * doubles. */
dyd_status dyd_outline_load(bool *done, dyd_outline *o, const dyd_delaunay *pd, uint32_t i, dyd_pair_status least);
/* false: something is in doubt. Pos first: its outline limits that of Int. */
bool dyd_filter_outline(dyd_outline *o, const dyd_rect *window, bool outer);
/* Coordinate a of a point, not relative to the origin. */
dyd_iv dyd_outline_coordinate(const dyd_outline *o, const dyd_outline_spot *p, int a);

/* outline.c. The rectangle of a site; false, and in doubt: memory. */
bool dyd_outline_rect(dyd_rect *r, dyd_outline *o, size_t k);
/* A mark of the rectangles `far` and `near`, exactly; DYD_MARKS and the next are the ends of `far`. */
void dyd_outline_number(mpq_ptr out, dyd_outline *o, size_t far, size_t near, int axis, int mark);
/* Returns true if the lines of arcs a and b cross beyond the pane of one, or at an end of both. Exact; false: they do
 * not, or are not straight. */
bool dyd_outline_needs_no_cut(dyd_outline *o, uint32_t a, uint32_t b);

/* Order of a and b; equal only as numbers that are known. Sets *unsure where it is not known.
 */
int dyd_outline_order(bool *unsure, dyd_iv a, dyd_iv b);

#endif
