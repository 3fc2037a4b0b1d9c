/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a certificate states of the Voronoi diagram, read by a reader of its own, and judged literally. */
#ifndef DYD_TESTS_CHECKER_DIAGRAM_H
#define DYD_TESTS_CHECKER_DIAGRAM_H

#include "checker/statement.h"

#define DIAGRAM_VERTICES 300

/* The polygon of site i has count[i] vertices, 0: none. large: there are more than fit in here, and nothing is judged.
 */
typedef struct diagram {
  bool present, large, distance_given, distance_proved;
  mpq_t window[4], undetermined, distance;
  size_t count[ORC_MAX];
  mpq_t vertex[ORC_MAX][DIAGRAM_VERTICES][2];
} diagram;

void diagram_init(diagram *d);
void diagram_clear(diagram *d);
void diagram_read(diagram *d, const char *text);
/* Returns true if both state the same. */
bool diagram_same(const diagram *a, const diagram *b);
/* Checks every statement about these rectangles. Polygons and area exactly, each vertex against every site; the
 * distance at `points` random points of the window, each for a random choice. Returns NULL, or a description of the
 * error. */
const char *diagram_judge(const diagram *d, const orc_case *c, test_random *r, size_t points);

/* The certificate, window NULL: the default one; NULL when that or the polygons leave the range of numbers. Release
 * with free(). */
char *diagram_of_engine(const dyd_engine *e, const dyd_rect *window);

#endif
