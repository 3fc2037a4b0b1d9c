/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A growing set of vertices with their rectangles as integers in one common scale, for the exact walks.
 *
 * The common factor is lcm * 2^-low. A newcomer may refine it; then all members are multiplied by `growth`, and callers
 * that keep numbers in the old scale multiply them too (dyd_scale_add says so). Directions need no change. */
#ifndef DYD_SKELETON_SCALE_SET_H
#define DYD_SKELETON_SCALE_SET_H

#include "rect/irect.h"
#include "skeleton/rects_filter.h"

typedef struct dyd_scale_set {
  const dyd_rects *rects;
  uint32_t *vertex;
  dyd_irect *rect;
  size_t count, made, vertex_cap, rect_cap;
  mpz_t lcm, growth, t;
  int64_t low;
  dyd_rect load;
} dyd_scale_set;

void dyd_scale_set_init(dyd_scale_set *s, const dyd_rects *rects);
void dyd_scale_set_clear(dyd_scale_set *s);
/* Forgets the members. */
void dyd_scale_set_empty(dyd_scale_set *s);
/* Makes v a member; *index is its place. *grown: the scale was refined by the factor s->growth. */
dyd_status dyd_scale_add(size_t *index, bool *grown, dyd_scale_set *s, uint32_t v);
/* Converts a box of doubles enclosing a point in scaled coordinates times 2^-shift into user coordinates, outward. */
int64_t dyd_scale_shift(const dyd_scale_set *s);
void dyd_scale_to_user(dyd_bbox *box, const dyd_scale_set *s);

#endif
