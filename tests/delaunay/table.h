/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checks invariants of the table of undecided faces. */
#ifndef DYD_TESTS_DELAUNAY_TABLE_H
#define DYD_TESTS_DELAUNAY_TABLE_H

#include <dyadel/delaunay.h>

/* Sums, marks of triangles, order of pairs, each shown by one face; true unless faces are listed. */
bool table_is_right(char *message, const dyd_delaunay *pd);

#endif
