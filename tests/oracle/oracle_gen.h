/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Random cases biased to trouble, and random choices of points in the rectangles of a case. */
#ifndef DYD_TESTS_ORACLE_GEN_H
#define DYD_TESTS_ORACLE_GEN_H

#include "oracle/oracle_case.h"
#include "support/random.h"

#define ORC_KINDS 17

/* A case of 3 .. most rectangles of the given kind (0 .. ORC_KINDS-1). Sides are dyadic, or single rationals. */
void orc_generate(orc_case *out, test_random *r, size_t kind, size_t most);
/* A point of every rectangle: a corner, or between the ends at a multiple of 1/2^bits of the side. */
void orc_choose(orc_case *out, test_random *r, const orc_case *c, unsigned bits);
/* Narrows rectangle i around the point `target` of it: each end keeps its place or moves towards the target to a
 * dyadic; with `final` it becomes the target. */
void orc_narrow(orc_rect *rect, test_random *r, const orc_rect *target, bool final);

#endif
