/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Many possible pairs shown by one centre. */
#ifndef DYD_POSSIBLE_CLIQUE_FILTER_H
#define DYD_POSSIBLE_CLIQUE_FILTER_H

#include "skeleton/rects.h"
#include "skeleton/reps.h"

/* near[k]: vertex[k] is surely possibly nearest at c, so that all who are make possible pairs [POS-1]. */
void dyd_filter_clique(bool *near, const dyd_rects *r, dyd_xy c, const uint32_t *vertex, size_t count);

#endif
