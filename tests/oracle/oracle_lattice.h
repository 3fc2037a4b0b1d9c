/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Classical Delaunay edges of integer points by the definition, for hundreds of points. */
#ifndef DYD_TESTS_ORACLE_LATTICE_H
#define DYD_TESTS_ORACLE_LATTICE_H

#include <stddef.h>
#include <stdint.h>

/* |x|, |y| <= LATTICE_MAX, so that all products fit 64 bits. */
#define LATTICE_MAX 4000

typedef struct orc_lattice {
  int32_t x, y;
} orc_lattice;

/* 3: some circle through points i and j has all others strictly outside; 1: some closed one (or half-plane) has
 * none inside; 0: none. The two points differ. */
int orc_lattice_status(const orc_lattice *point, size_t n, size_t i, size_t j);

#endif
