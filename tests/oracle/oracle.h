/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The slow literal oracle of the partial Delaunay triangulation: sections 3 and 10 of the mathematics, evaluated
 * for every pair in exact arithmetic, with no search structure, no filter and nothing shared with src.
 *
 * A positive answer is always backed by a centre (or direction) that has been verified literally against all
 * rectangles; negative answers are exhaustive. */
#ifndef DYD_TESTS_ORACLE_H
#define DYD_TESTS_ORACLE_H

#include "oracle/oracle_case.h"
#include "oracle/oracle_num.h"

/* The numbers of dyd_pair_status. */
enum { ORC_ILLEGAL = 0, ORC_TIE = 1, ORC_INDETERMINATE = 2, ORC_LEGAL = 3 };

typedef struct orc_point {
  orc_alg x, y;
} orc_point;

/* The side [e0,e1] of a rectangle, cut into the pieces on which one end is the closest (or farthest) coordinate:
 * coordinates lo <= t <= hi (NULL: unbounded) have distance |t - at| (at = NULL: distance 0). lo < hi always:
 * closed full-dimensional pieces cover everything. */
typedef struct orc_piece {
  mpq_srcptr lo, hi, at;
} orc_piece;
size_t orc_pieces_closest(orc_piece out[3], orc_pool *p, const mpq_t *e);
size_t orc_pieces_farthest(orc_piece out[2], orc_pool *p, const mpq_t *e);
/* Intersects two pieces' ranges; false unless lo < hi. */
bool orc_range_cut(mpq_srcptr *lo, mpq_srcptr *hi, orc_piece with);

/* ds(c,r)^2 and dl(c,r)^2. */
orc_alg orc_ds2(orc_pool *p, orc_point c, const orc_rect *r);
orc_alg orc_dl2(orc_pool *p, orc_point c, const orc_rect *r);

/* max(ds_i,ds_j)(c) <= min dl_k(c) over the other k, literally. */
bool orc_is_free(orc_pool *p, const orc_case *c, size_t i, size_t j, orc_point at);
/* max(dl_i,dl_j)(c) < min ds_k(c) over the other k that are not aliases of i or j, literally. */
bool orc_is_witness(orc_pool *p, const orc_case *c, size_t i, size_t j, mpq_srcptr x, mpq_srcptr y);

/* Aliases are dropped by the caller: c must hold no two equal points. */
bool orc_possible(orc_pool *p, const orc_case *c, size_t i, size_t j);
/* When legal and wx, wy are not NULL, they receive a witness (numbers of the pool). */
bool orc_legal(mpq_srcptr *wx, mpq_srcptr *wy, orc_pool *p, const orc_case *c, size_t i, size_t j);

/* Returns true if the witnesses of ij around the witness (wx,wy) hold a disc of about 2^-bits times its distance from
 * R_i. An estimate: false means that the search for it failed. */
bool orc_is_roomy(orc_pool *p, const orc_case *c, size_t i, size_t j, mpq_srcptr wx, mpq_srcptr wy, long bits);

/* The statuses of all pairs, aliases having the statuses of their site; ORC_TIE is used exactly when all
 * sites are points. status[i][j] = status[j][i]; the diagonal is ORC_ILLEGAL. */
typedef struct orc_table {
  size_t n;
  unsigned char status[ORC_MAX][ORC_MAX];
} orc_table;
void orc_statuses(orc_table *out, orc_pool *p, const orc_case *c);

/* The classical answer for exact points by another road: the pair's bisector cut by one half-line per other
 * point. ORC_LEGAL: strictly Delaunay; ORC_TIE: weakly (centres at infinity included); ORC_ILLEGAL: not Delaunay.
 * Points i and j differ. */
int orc_classical(orc_pool *p, const orc_case *points, size_t i, size_t j);
/* Sign of the orientation of three rectangles' lower left corners. */
int orc_turn(orc_pool *p, const orc_rect *a, const orc_rect *b, const orc_rect *c);
/* Is point d strictly inside (1), on (0) or outside (-1) the circle through points a, b, c (counter-clockwise)? */
int orc_in_circle(orc_pool *p, const orc_rect *a, const orc_rect *b, const orc_rect *c, const orc_rect *d);

#endif
