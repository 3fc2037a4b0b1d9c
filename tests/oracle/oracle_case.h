/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A case: a handful of rectangles with exact rational ends, printable, shrinkable, transformable. */
#ifndef DYD_TESTS_ORACLE_CASE_H
#define DYD_TESTS_ORACLE_CASE_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#define ORC_MAX 40

/* [e0,e1] x [e2,e3]. Invariant: e0 <= e1, e2 <= e3, canonical. */
typedef struct orc_rect {
  mpq_t e[4];
} orc_rect;

/* Rectangles rect[0 .. n-1]; kind says which generator made them. All ORC_MAX are initialised. */
typedef struct orc_case {
  size_t n;
  char kind[32];
  orc_rect rect[ORC_MAX];
} orc_case;

void orc_case_init(orc_case *c);
void orc_case_clear(orc_case *c);
void orc_case_set(orc_case *out, const orc_case *c);
/* Appends [x0,x1] x [y0,y1], all divided by den. */
void orc_case_add(orc_case *c, long x0, long x1, long y0, long y1, unsigned long den);
void orc_case_add_rect(orc_case *c, const orc_rect *r);
/* Drops rectangle i; the later ones move up. */
void orc_case_drop(orc_case *c, size_t i);
/* out[k] = in[order[k]], k < n. out differs from in. */
void orc_case_permute(orc_case *out, const orc_case *in, const size_t *order, size_t n);
/* One of the eight symmetries of the square: bit 0 swaps the axes, bit 1 mirrors x, bit 2 mirrors y. */
void orc_case_turn(orc_case *c, unsigned symmetry);
/* Multiplies everything by 2^e. */
void orc_case_scale(orc_case *c, long e);
bool orc_rect_is_point(const orc_rect *r);
bool orc_rect_equal(const orc_rect *r, const orc_rect *s);
bool orc_rect_meets(const orc_rect *r, const orc_rect *s);
bool orc_case_all_points(const orc_case *c);
/* The lowest site with the same exact point, i when there is none. */
size_t orc_case_alias(const orc_case *c, size_t i);
/* One line per rectangle, in the form of a points file. */
void orc_case_print(FILE *f, const orc_case *c);

#endif
