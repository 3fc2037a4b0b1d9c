/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Quick answers about quads in doubles; false always means "not known". */
#ifndef DYD_POSSIBLE_QUAD_FILTER_H
#define DYD_POSSIBLE_QUAD_FILTER_H

#include "skeleton/work.h"

/* Surely kl cannot displace ij: their hulls' boxes are disjoint, or l is surely outside the circle of i, j, k [QUAD-1].
 */
bool dyd_surely_not_displaced(const dyd_skeleton *sk, uint32_t i, uint32_t j, uint32_t k, uint32_t l);

#endif
