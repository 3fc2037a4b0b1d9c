/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The faces of the legal graph, and the sets of sites within which a pair can be possible.
 *
 * A possible pair is a segment that crosses no legal edge, for some choice: its ends lie on one face of the legal graph
 * [CERT-2]. Bounded faces of three sites are triangles for every choice. The unbounded face is cut by rays out of sure
 * corners of the hull; a group of two sites is one edge of the hull [CERT-3]. What is left are the open sets: a
 * possible pair that is not legal has both ends in one of them. */
#ifndef DYD_CHECKER_FACES_H
#define DYD_CHECKER_FACES_H

#include "checker/graph.h"

/* Site i is claimed to be a corner of the hull for every choice, u being an outward direction. */
typedef struct dyd_cert_corner {
  uint32_t i;
  dyd_exact u[2];
} dyd_cert_corner;

/* How the sites of an open set lie: POLYGON: the set is a bounded face whose walk is one cycle of legal edges through
 * all its sites, each once; CHAIN: a part of the unbounded face from one corner of the hull to the next, a path of
 * legal edges likewise. */
typedef enum dyd_cert_shape { DYD_CERT_ANY, DYD_CERT_POLYGON, DYD_CERT_CHAIN } dyd_cert_shape;

typedef struct dyd_cert_faces {
  size_t triangles;
  /* Open set f holds the sites member[start[f] .. start[f+1]), ascending. */
  size_t sets, set_cap, members, member_cap;
  size_t *start;
  uint32_t *member;
  uint64_t *covered; /* pairs of set f that something is known about */
  bool *inexact;     /* does set f have a site that is no exact point? */
  bool *tied;        /* set f is a polygon or chain whose points are on one circle or line: exact points, at first */
  dyd_cert_shape *shape;
  size_t shape_cap;
  /* Site i is in the sets of[first[i] .. first[i+1]), ascending. */
  size_t *first;
  uint32_t *of;
} dyd_cert_faces;

/* *bad: a corner that is not proved, or DYD_CERT_NONE. Corners are sorted by site. A graph that is not connected makes
 * one open set of all sites. */
dyd_status dyd_cert_faces_init(dyd_cert_faces *f, uint32_t *bad, const dyd_cert_graph *g, const dyd_cert_corner *corner,
                               size_t corners);
void dyd_cert_faces_clear(dyd_cert_faces *f);
/* Something is known about the pair. Call once a pair. */
void dyd_cert_faces_cover(dyd_cert_faces *f, uint32_t i, uint32_t j);
/* How many open sets hold both? */
size_t dyd_cert_faces_common(const dyd_cert_faces *f, uint32_t i, uint32_t j);
/* Are both in one open set? */
bool dyd_cert_faces_share(const dyd_cert_faces *f, uint32_t i, uint32_t j);
/* Returns true if an open set that holds both is tied: a pair that is not legal is a tie then [CERT-10]. */
bool dyd_cert_faces_tied(const dyd_cert_faces *f, uint32_t i, uint32_t j);
/* Returns true if all sites of the open sets that hold both are exact points: nothing that is narrowed changes what the
 * pair is [CERT-8]. */
bool dyd_cert_faces_still(const dyd_cert_faces *f, uint32_t i, uint32_t j);
/* Pairs within open sets about which nothing is known (a pair of two sets counts twice). */
uint64_t dyd_cert_faces_left(const dyd_cert_faces *f);

/* The closed walk of half-edges from h; *out is released with free(). For those who look for corners. */
dyd_status dyd_cert_walk(uint32_t **out, size_t *count, const dyd_cert_graph *g, uint32_t h);
/* hull[v] = is the place of v a strict corner of the hull of the places item[0 .. count-1]? hull is cleared first;
 * item is sorted by places. */
dyd_status dyd_cert_hull(bool *hull, const dyd_cert_sites *s, uint32_t *item, size_t count);

/* Returns true if the places of `count` different sites are on the line of the first two, which have different places
 * (measure.c). */
bool dyd_cert_on_line(const dyd_cert_sites *s, const uint32_t *site, size_t count);
/* Returns true if the places of `count` sites, at least three, all different and not all on one line, are on one
 * circle. */
bool dyd_cert_on_circle(const dyd_cert_sites *s, const uint32_t *site, size_t count);

#endif
