/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the pairs of a site may depend on: discs and half-planes [REACH-1]. */
#ifndef TILES_REACH_H
#define TILES_REACH_H

#include "tiles.h"

/* The disc about (x, y) of radius r; far: the half-plane of all p with x p.x + y p.y >= r. Closed. */
typedef struct tiles_disc {
  double x, y, r;
  uint64_t far;
} tiles_disc;

/* Begun as {0}; kept from site to site, for its memory. */
typedef struct tiles_reach {
  size_t count, room;
  tiles_disc *item;
  struct tiles_spoke *spoke; /* scratch */
  struct tiles_knot *knot;
  size_t room_spoke, room_knot;
} tiles_reach;
void tiles_reach_clear(tiles_reach *r);

/* Sites of a triangulation that are partners of one. */
typedef struct tiles_partners {
  const uint32_t *item; /* the site, and its status << 30 */
  size_t count;
} tiles_partners;
#define TILES_SITE(partner) ((partner)&0x3fffffffu)
#define TILES_STATUS(partner) ((dyd_pair_status)((partner) >> 30))

/* Fills *out: while no rectangle outside of the view meets an item, the possible pairs of site i in the view are all
 * that it has, and those of exact points have their status [REACH-1]; so have legal pairs of rectangles of both of
 * whose ends this holds [TILE-1]. Where rectangles crowd, it is the whole plane. Takes any partners, best all possible
 * ones. false: memory is exhausted. O(n log n). */
bool tiles_reach_find(tiles_reach *out, const tiles_view *v, uint32_t i, const tiles_partners *p);
/* The disc about a witness of a legal pair of the two boxes, of which `centre` is a double next to it. */
tiles_disc tiles_witness_disc(const double centre[2], const tiles_box *a, const tiles_box *b);

/* May be, when doubles are not sure. */
bool tiles_disc_may_meet(const tiles_disc *d, const tiles_box *box);
/* Surely. */
bool tiles_disc_is_inside(const tiles_disc *d, const tiles_box *box);
/* The smaller, the nearer to the middle of the disc, or the deeper in the half-plane; INFINITY: surely outside. No box
 * inside of `box` has a smaller one. */
double tiles_disc_score(const tiles_disc *d, const tiles_box *box);
bool tiles_box_is_point(const tiles_box *b);
bool tiles_boxes_meet(const tiles_box *a, const tiles_box *b);
/* Is it higher than wide? */
bool tiles_box_is_tall(const tiles_box *a);
/* Grows *a to hold b. */
void tiles_box_join(tiles_box *a, const tiles_box *b);
/* The box with nothing in it. */
tiles_box tiles_box_empty(void);
/* Wider on each side by `times` mean distances of `count` sites in it. */
tiles_box tiles_box_wider(const tiles_box *box, size_t count, double times);

/* The site that goes farthest into direction k of `of`, about; the first one among equals. s is not empty. */
size_t tiles_farthest(const tiles_sites *s, unsigned k, unsigned of);

#endif
