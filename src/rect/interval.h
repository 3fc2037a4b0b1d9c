/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Invariants of intervals and rectangles. */
#ifndef DYD_RECT_INTERVAL_H
#define DYD_RECT_INTERVAL_H

#include <dyadel/rect.h>

bool dyd_interval_is_valid(const dyd_interval *a);

#endif
