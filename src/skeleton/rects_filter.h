/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The rectangles by vertex: exact ones in the table of sites, boxes in doubles around them, a tree over these; and
 * bounds of their distances from a centre.
 *
 * Questions about discs need no more: only the vertices in the tree count. */
#ifndef DYD_SKELETON_RECTS_FILTER_H
#define DYD_SKELETON_RECTS_FILTER_H

#include "base/index.h"
#include "base/invariant.h"
#include "rect/sites_table.h"
#include <dyadel/status.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>

/* Bounds of ds^2 and dl^2 in doubles [FLT-DST].
 *
 * A centre is known by an enclosing box C of doubles (a point when it is a double), a site by its outward box b. Each
 * difference, product and the sum carry a relative error u = 2^-53, (1+u)^4 in all, (1+u)^6 where slack is added;
 * 1 +- 10u covers that and the rounding of the bound itself; underflow of a square is at most 2^-1075 and covered by
 * 2^-1000. An overflowing lower bound is cut to DBL_MAX/4, an overflowing upper bound is infinite, and NaN compares
 * false: never certain. */

/* xlo, xhi, ylo, yhi. */
typedef struct dyd_bbox {
  double e[4];
} dyd_bbox;

#define DYD_DOWN_FACTOR (1 - 10 * 0x1p-53)
#define DYD_UP_FACTOR (1 + 10 * 0x1p-53)
#define DYD_TINY 0x1p-1000

static inline double dyd_max(double a, double b) {
  return a > b ? a : b;
}
static inline double dyd_min(double a, double b) {
  return a < b ? a : b;
}
static inline double dyd_lower(double x) {
  double y = x * DYD_DOWN_FACTOR - DYD_TINY;
  return y > DBL_MAX / 4 ? DBL_MAX / 4 : y;
}
static inline double dyd_upper(double x) {
  return x * DYD_UP_FACTOR + DYD_TINY;
}

/* *h becomes the box around both. */
static inline void dyd_box_widen(dyd_bbox *h, const dyd_bbox *b) {
  h->e[0] = dyd_min(h->e[0], b->e[0]);
  h->e[1] = dyd_max(h->e[1], b->e[1]);
  h->e[2] = dyd_min(h->e[2], b->e[2]);
  h->e[3] = dyd_max(h->e[3], b->e[3]);
}

/* Lower bound of ds^2 over the centres in C; negative only by the margin of underflow. */
static inline double dyd_ds2_lower(const dyd_bbox *c, const dyd_bbox *b) {
  double dx = dyd_max(dyd_max(b->e[0] - c->e[1], c->e[0] - b->e[1]), 0);
  double dy = dyd_max(dyd_max(b->e[2] - c->e[3], c->e[2] - b->e[3]), 0);
  return dyd_lower(dx * dx + dy * dy);
}

/* Upper bound of dl^2. */
static inline double dyd_dl2_upper(const dyd_bbox *c, const dyd_bbox *b) {
  double dx = dyd_max(b->e[1] - c->e[0], c->e[1] - b->e[0]);
  double dy = dyd_max(b->e[3] - c->e[2], c->e[3] - b->e[2]);
  return dyd_upper(dx * dx + dy * dy);
}

/* Upper bound of ds^2 for the rectangle: the outward box is at most as far as the rectangle, so this needs the inner
 * side: `slack` bounds by how much an end of the box may lie outside the rectangle. */
static inline double dyd_ds2_upper(const dyd_bbox *c, const dyd_bbox *b, double slack) {
  double dx = dyd_max(b->e[0] - c->e[0], c->e[1] - b->e[1]) + slack;
  double dy = dyd_max(b->e[2] - c->e[2], c->e[3] - b->e[3]) + slack;
  if (!(dx <= DBL_MAX && dy <= DBL_MAX)) return HUGE_VAL; /* infinite ends, or NaN of them */
  dx = dyd_max(dx, 0);
  dy = dyd_max(dy, 0);
  return dyd_upper(dx * dx + dy * dy);
}

/* Lower bound of dl^2 for the rectangle; slack as above. */
static inline double dyd_dl2_lower(const dyd_bbox *c, const dyd_bbox *b, double slack) {
  double dx = dyd_max(dyd_max(b->e[1] - c->e[1], c->e[0] - b->e[0]) - slack, 0);
  double dy = dyd_max(dyd_max(b->e[3] - c->e[3], c->e[2] - b->e[2]) - slack, 0);
  return dyd_lower(dx * dx + dy * dy);
}

/* A box of centres, by its corners 0 to 3, the right ones odd, the upper ones above 1. C_ki = {c : dl_k(c) < ds_i(c)}
 * is convex [PLANE-1], so k is nearer than i in all of a box if it is at its corners. These have two x and two y only:
 * the same steps as above, but half of them. */

/* Upper bounds of dl^2 there. */
static inline void dyd_corners_far(double at[4], const dyd_bbox *c, const dyd_bbox *b) {
  double s[4];
  for (int k = 0; k < 4; k++) s[k] = dyd_max(b->e[k | 1] - c->e[k], c->e[k] - b->e[k & 2]);
  for (int k = 0; k < 4; k++) s[k] *= s[k];
  for (int k = 0; k < 4; k++) at[k] = dyd_upper(s[k & 1] + s[2 + (k >> 1)]);
}

/* Lower bounds of ds^2. */
static inline void dyd_corners_near(double at[4], const dyd_bbox *c, const dyd_bbox *b) {
  double s[4];
  for (int k = 0; k < 4; k++) s[k] = dyd_max(b->e[k & 2] - c->e[k], c->e[k] - b->e[k | 1]);
  for (int k = 0; k < 4; k++) s[k] = dyd_max(s[k], 0);
  for (int k = 0; k < 4; k++) s[k] *= s[k];
  for (int k = 0; k < 4; k++) at[k] = dyd_lower(s[k & 1] + s[2 + (k >> 1)]);
}

/* Returns true if the rectangle with bounds `far` is certainly nearer everywhere than the one with bounds `near`. */
static inline bool dyd_corners_block(const double far[4], const double near[4]) {
  return far[0] < near[0] && far[1] < near[1] && far[2] < near[2] && far[3] < near[3];
}

/* A part of the plane, cut `depth` times from the whole, and its rest of the caller's lists: candidates
 * first .. first + count, and pairs of them. The lists of a part lie behind those of the part around it. level: the
 * caller's. */
typedef struct dyd_plane_part {
  dyd_bbox at;
  int depth, level;
  size_t first, count, first_pair, pairs;
} dyd_plane_part;

/* Examines a part; *parts: in how many it is cut, 4, 2 across x only, or 0 if it is decided. They begin as copies. */
typedef dyd_status (*dyd_look)(void *context, int *parts, dyd_plane_part *p);

/* Walks over p and its parts, depth first, until `look` does not return DYD_OK, or *cancel is set (NULL: never). */
dyd_status dyd_walk_parts(dyd_look look, void *context, const volatile int *cancel, dyd_plane_part p);

/* A packed tree of boxes over the vertices in spatial order: which can be near, which can lie beyond a line.
 *
 * Every node holds the hull of 8 consecutive vertices or nodes, so extents count, not only centres. Answers are
 * conservative: every vertex that might qualify is visited. */

enum { DYD_TREE_FANOUT = 8, DYD_TREE_LEVELS = 12 };

/* Invariant: node level[k] .. level[k+1]-1 are the nodes of level k (0: over items); a node's box holds the boxes of
 * its children. item[q] is the vertex of entry q; ascending: they go up. */
typedef struct dyd_tree {
  uint32_t count;
  uint32_t *item;
  const dyd_bbox *box; /* by vertex; borrowed */
  dyd_bbox *node;
  size_t level[DYD_TREE_LEVELS + 1];
  int levels;
  bool ascending;
} dyd_tree;

/* Children of node q on level k: entries first .. end - 1 of the level below (items for k = 0). */
static inline void dyd_tree_children(size_t *first, size_t *end, const dyd_tree *t, int k, size_t q) {
  size_t below = k == 0 ? t->count : t->level[k] - t->level[k - 1];
  *first = q * DYD_TREE_FANOUT;
  *end = *first + DYD_TREE_FANOUT < below ? *first + DYD_TREE_FANOUT : below;
}

static inline const dyd_bbox *dyd_tree_child_box(const dyd_tree *t, int k, size_t entry) {
  return k == 0 ? &t->box[t->item[entry]] : &t->node[t->level[k - 1] + entry];
}

/* Over the vertices item[0..count-1]; takes over the array. */
dyd_status dyd_tree_init(dyd_tree *t, uint32_t *item, uint32_t count, const dyd_bbox *box);
/* Appends entries for the vertices first .. first + count - 1, above all others. O(count), and an eighth of the nodes
 * moves. DYD_E_NOMEM: only clearing is allowed. */
dyd_status dyd_tree_grow(dyd_tree *t, uint32_t first, uint32_t count, const dyd_bbox *box);
void dyd_tree_clear(dyd_tree *t);
/* The entry of a vertex, in an ascending tree. */
uint32_t dyd_tree_entry(const dyd_tree *t, uint32_t vertex);
/* Entry q's box has changed. */
void dyd_tree_refresh(dyd_tree *t, uint32_t q);

/* Returns false to end the search. */
typedef bool (*dyd_visit)(void *context, uint32_t vertex);
/* Visits every vertex whose box may come within sqrt(*radius2) of a centre in c (closed). The visitor may lower
 * *radius2. */
void dyd_tree_near(const dyd_tree *t, const dyd_bbox *c, const double *radius2, dyd_visit visit, void *context);
/* Visits every vertex whose box may reach u.x >= *height for the direction u = (ux, uy). The visitor may raise *height.
 */
void dyd_tree_beyond(const dyd_tree *t, double ux, double uy, const double *height, dyd_visit visit, void *context);

/* Invariant: box[v] holds the rectangle of site[v] for every v of the tree. */
typedef struct dyd_rects {
  const dyd_sites *sites;
  const uint32_t *site; /* vertex -> site; borrowed */
  dyd_bbox *box;
  dyd_tree tree;
} dyd_rects;

/* The rectangle of vertex v, exactly. */
static inline void dyd_rects_get(dyd_rect *out, const dyd_rects *r, uint32_t v) {
  dyd_status st = dyd_sites_get(out, r->sites, r->site[v]); /* fails for sites that do not exist */
  DYD_INVARIANT(st == DYD_OK);
  (void)st;
}
/* Brings the box of v up to date. */
static inline void dyd_rects_set_box(dyd_rects *r, uint32_t v) {
  dyd_sites_get_d(r->box[v].e, r->sites, r->site[v]);
}

/* ---- bounds of distances ---- */

/* By how much an end of v's outward box can lie outside its rectangle: 0 when doubles hold it, else one unit in the
 * last place of the largest end, at most 2^-52 of it (or 2^-1074). */
static inline double dyd_box_slack(const dyd_rects *r, uint32_t v) {
  if (dyd_sites_in_doubles(r->sites, r->site[v])) return 0;
  const double *e = r->box[v].e;
  double m = dyd_max(dyd_max(fabs(e[0]), fabs(e[1])), dyd_max(fabs(e[2]), fabs(e[3])));
  return m * 0x1p-52 + 0x1p-1074;
}
/* An enclosure of c in doubles. */
dyd_bbox dyd_point_box(const dyd_point *c);
/* Upper bound of max(dl_i, dl_j)^2 over the centres in c. */
double dyd_pair_dl2_upper(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j);
/* Upper bound of max(ds_i, ds_j)^2 over the centres in c. */
double dyd_pair_ds2_upper(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j);
/* Returns true if dl_k^2 >= bound for all centres in c, certainly. */
bool dyd_surely_not_nearer(const dyd_rects *r, const dyd_bbox *c, uint32_t k, double bound);
/* A vertex certainly nearer than i and j to all centres in c, dl_k < ds_i, ds_j: the one of least dl_k by its upper
 * bound. DYD_NONE: not known. */
uint32_t dyd_surely_nearest(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j);
/* Returns true if the boxes of i and j certainly do not meet. */
static inline bool dyd_boxes_disjoint(const dyd_bbox *a, const dyd_bbox *b) {
  return a->e[1] < b->e[0] || b->e[1] < a->e[0] || a->e[3] < b->e[2] || b->e[3] < a->e[2];
}
/* Returns true if the rectangles of i and j certainly meet. An end of a box is outside by the slack at most; twice that
 * covers the rounding here. A box with an infinite end gives no answer. */
static inline bool dyd_surely_meet(const dyd_rects *r, uint32_t i, uint32_t j) {
  const dyd_bbox *a = &r->box[i], *b = &r->box[j];
  double slack = 2 * (dyd_box_slack(r, i) + dyd_box_slack(r, j));
  return slack <= DBL_MAX && a->e[0] + slack <= b->e[1] && b->e[0] + slack <= a->e[1] && a->e[2] + slack <= b->e[3] &&
         b->e[2] + slack <= a->e[3];
}
/* The direction (x,y) != 0 in doubles, scaled to at most 1; each component off by at most 2^-52 of itself or 2^-900. */
void dyd_direction_d(double u[2], const mpz_t x, const mpz_t y);
/* A lower bound of max u.x over the rectangle in the box p, for u as dyd_direction_d gives it, minus what
 * dyd_tree_beyond may lose by the error of u: a height for it. */
double dyd_height_lower(const dyd_rects *r, double ux, double uy, const dyd_bbox *p);
/* Returns true if min u.x over the rectangle of k is at most the maximum for which dyd_height_lower gave `height`,
 * certainly: it reaches not altogether beyond it. */
bool dyd_surely_not_beyond(const dyd_rects *r, double ux, double uy, uint32_t k, double height);

#endif
