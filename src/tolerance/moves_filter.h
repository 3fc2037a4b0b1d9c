/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A pair, the sites considered for it, and planes over a centre: deaths and births where points move in discs of
 * weights, or in squares, see moves_filter.c and moved_births_filter.c. */
#ifndef DYD_TOLERANCE_MOVES_FILTER_H
#define DYD_TOLERANCE_MOVES_FILTER_H

#include "tolerance/dd_filter.h"
#include "tolerance/state.h"

/* The first DYD_MOVES_CONE planes keep a step short. */
enum { DYD_MOVES_MOST_SEEN = 64, DYD_MOVES_MOST_PLANES = 259, DYD_MOVES_MOST_ADDED = 8, DYD_MOVES_CONE = 3 };

#define DYD_MOVES_SPARE 0x1p-51 /* weights may be the doubles next to the intended ones */

#define DYD_MOVES_CLOSE 0x1p-48 /* relative heights in doubles that count as equal */

typedef struct dyd_move_site {
  dyd_dd_bounded x, y;
  double weight;
  uint32_t vertex;
} dyd_move_site;

/* t <= top + (x, y).(c' - c), by site[end] and site[other]. A square of the end counts by one corner, that on the side
 * `way` of the centre from c. */
typedef struct dyd_move_plane {
  double top, x, y;
  uint32_t end, other;
  int way[2];
} dyd_move_plane;

/* A site of a chain, and a place that it and the next one keep up to t. climbed: no place is better. */
typedef struct dyd_move_link {
  uint32_t site;
  double x, y, t;
  bool climbed;
} dyd_move_link;

/* site[0], site[1]: i and j. The first planes keep c within about 2 far. contact: two regions meet from there on, those
 * of end and site `touch`. goal: climbing ends above it. way: 1 for a death, -1 for a birth; pair: two sites of its
 * chain. */
typedef struct dyd_moves {
  const dyd_tolerance *t;
  bool square;
  int way;
  uint32_t count, planes, links, basis[3];
  dyd_move_site site[2 + DYD_MOVES_MOST_SEEN];
  dyd_move_plane plane[DYD_MOVES_MOST_PLANES];
  double x, y, now, far, contact, goal;
  dyd_dd_bounded at[2];
  uint32_t touch[2], pair[2];
  dyd_move_link link[DYD_MOVES_MOST_SEEN];
} dyd_moves;

/* The t up to which c at (x, y) shows end e nearer than k, with its slope. */
static inline void dyd_plane_of_discs(dyd_move_plane *p, const dyd_move_site *e, const dyd_move_site *k, double x,
                                      double y) {
  double ax = x - e->x.h, ay = y - e->y.h, bx = x - k->x.h, by = y - k->y.h, r = e->weight + k->weight;
  double a = sqrt(ax * ax + ay * ay), b = sqrt(bx * bx + by * by);
  p->top = ((e->x.h - k->x.h) * (ax + bx) + (e->y.h - k->y.h) * (ay + by)) / ((a + b) * r);
  p->x = (bx / b - ax / a) / r;
  p->y = (by / b - ay / a) / r;
}

/* (a + t)^2 + (b + t)^2 = max(f - t, 0)^2 + max(g - t, 0)^2 */
static inline void dyd_plane_of_squares(dyd_move_plane *p, const dyd_move_site *e, const dyd_move_site *k, double x,
                                        double y) {
  double a = (x - e->x.h) * p->way[0], b = (y - e->y.h) * p->way[1], bx = x - k->x.h, by = y - k->y.h;
  double f = fabs(bx), g = fabs(by), most = fmax(f, g), least = fmin(f, g);
  double t = ((f - a) * (f + a) + (g - b) * (g + b)) / (2 * (a + b + f + g));
  if (t > least) {
    double sum = a + b + most, gain = (most - a) * (most + a) - b * b;
    t = gain / (sum + sqrt(fmax(0, sum * sum + gain)));
  }
  f = fmax(f - t, 0);
  g = fmax(g - t, 0);
  double steep = a + t + b + t + f + g;
  p->top = t;
  p->x = (copysign(f, bx) - p->way[0] * (a + t)) / steep;
  p->y = (copysign(g, by) - p->way[1] * (b + t)) / steep;
}

/* i, j and, unless they are DYD_NONE, two more vertices, then others around. false: doubles are not for these. */
bool dyd_moves_begin(dyd_moves *m, dyd_others *o, const dyd_tolerance *t, const uint32_t of[4], int way);
/* false: it is seen already, or there are too many. */
bool dyd_moves_see(dyd_moves *m, uint32_t v);
/* From (m->x, m->y) to about the highest place, or one above m->goal. false: it is not found, or far away. */
bool dyd_moves_climb(dyd_moves *m);
/* Where the three planes of the basis meet, seen from c. */
bool dyd_planes_meet(dyd_move_plane *at, const dyd_moves *m);
/* The highest point below the first four planes behind the cone, seen from c; the three that make it become the basis.
 * false: there is none. */
bool dyd_planes_four(dyd_move_plane *at, dyd_moves *m);
/* m->at and m->now become c and t, more precise than doubles make them. */
void dyd_moves_refine(dyd_moves *m);
/* Half of the relative width around t that is tried, after `tries`; 0: no more. */
double dyd_moves_width(const dyd_moves *m, size_t tries);
/* How far the region of a site may be from m->at at t (way = 1), or must be (way = -1): of squares the square of that.
 */
dyd_dd_bounded dyd_move_reach(const dyd_moves *m, const dyd_move_site *s, double t, int way);
/* Does m->at show the pair at t, for all sites? *added: some were in the way that are seen now. */
bool dyd_moves_hold(bool *added, dyd_moves *m, double t);

#endif
