/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sites as lines over the bisector of a pair, in integers: what tolerances are made of (mathematics: section 12).
 *
 * Let i be the origin, J = p_j - p_i, J' its left turn. A centre on the bisector is c(s) = J/2 + s J', its squared
 * distance to i and j is r^2 = |J|^2 (1/4 + s^2). For another site at P,
 *     |c - P|^2 - |c|^2 = D(s) = m - 2 n s,     m = P.(P - J),  n = J'.P:
 * a line. So the site nearest to c is the lowest line at s, whatever r is, and f(s) = min |c - P| - |c|
 * = sqrt(r^2 + E(s)) - r with E the lower envelope: the supremum of f is w(ij) [TOL-1]. */
#ifndef DYD_TOLERANCE_LINES_H
#define DYD_TOLERANCE_LINES_H

#include "rect/irect.h"
#include "skeleton/skeleton.h"
#include <gmp.h>

/* Numbers sqrt(plus) - sqrt(minus), plus and minus rationals that are not negative: compared exactly, enclosed by
 * doubles. */

/* Sign of e + sqrt(f) - sqrt(g); f and g are not negative. Exact [SQR-2]. */
int dyd_roots_sign(mpq_srcptr e, mpq_srcptr f, mpq_srcptr g);
/* Sign of (sqrt(p) - sqrt(m)) - (sqrt(q) - sqrt(n)). Exact [SQR-2]. */
int dyd_roots_compare(mpq_srcptr p, mpq_srcptr m, mpq_srcptr q, mpq_srcptr n);
/* Doubles around half of |sqrt(p) - sqrt(m)|, rounded down and up: a unit in the last place apart, or two. Both are 0
 * where it is 0; beyond the range of doubles they are the nearest ones on their side, infinite ones included. */
void dyd_roots_half(double *lo, double *hi, mpq_srcptr p, mpq_srcptr m);
/* The sum of the ends of a side, twice its centre, and its width. */
void dyd_side_sum(mpq_ptr sum, mpq_ptr width, const dyd_interval *side);
/* Widens r on all sides by half, its ends rounded outward to multiples of 2^exp. DYD_E_NOMEM, DYD_E_RANGE. */
dyd_status dyd_rect_widen(dyd_rect *r, mpq_srcptr half, int64_t exp);
/* q rounded to a double, down (up = 0) or up (1). */
double dyd_q_double(mpq_srcptr q, int up);
/* The double nearest to the largest decimal of 6 digits that is at most q > 0: such as was typed. */
double dyd_q_brief(mpq_srcptr q);

/* The lines over a bisector (lines.h) in doubles, with error bounds [FLT-TOL]. */

/* Where the points are: xy + low, low NULL where xy is exact. slack bounds the error of a difference of two
 * coordinates beyond its rounding. usable: the caller rounds to nearest. */
typedef struct dyd_points_d {
  const dyd_xy *xy, *low;
  double slack;
  bool usable;
} dyd_points_d;

/* Pairs whose ends have more neighbours in all have one end that is a hub. */
enum { DYD_HUB = 40 };
/* Of one pair: J, and in two lists the vertices that may bind, more than once where they are in both. i, j and vertices
 * at NaN do not count. apex: next to the pair, the first on its left; or one alone, and DYD_NONE. */
typedef struct dyd_lines_d {
  double jx, jy, jj, ejj, rjj; /* rjj: ejj / jj */
  uint32_t i, j, apex[2], rings[2];
  const uint32_t *ring[2];
} dyd_lines_d;

/* One of them, with Q = p_k - p_j: em, en, ea bound the errors of m, n and along = P.J. */
typedef struct dyd_line_d {
  double px, py, qx, qy, m, n, along, em, en, ea;
  uint32_t vertex;
} dyd_line_d;

/* What binds: two vertices, or one twice; lo and hi bound the death, hi <= (1 + 2^-40) lo. */
typedef struct dyd_death_d {
  double lo, hi;
  uint32_t k, l;
  double s; /* the place, see lines.h; end: -1 or 1 for an end of the bisector */
  int end;
} dyd_death_d;

/* Without vertices. false: doubles cannot hold the pair well. */
bool dyd_filter_pair(dyd_lines_d *l, const dyd_points_d *p, uint32_t i, uint32_t j);
void dyd_filter_line(dyd_line_d *o, const dyd_lines_d *l, const dyd_points_d *p, uint32_t vertex);
/* The lower envelope of `count` lines, at least one, by m and n alone, about. Sets chain to the numbers of its lines,
 * in order of n, corner[k], 0 < k < what is returned, to the place where those of chain[k - 1] and chain[k] cross, and
 * the corner behind the last line to infinity. Returns how many lines it has. */
uint32_t dyd_filter_envelope(uint32_t *chain, double *corner, const dyd_line_d *line, uint32_t count);
/* The death of a strictly Delaunay pair with these others; false: not certain. `box` (may be NULL) gets a box around
 * the centre, *radius2 an upper bound of its squared distance to the sites that bind; infinite for a half-plane. */
bool dyd_filter_death(dyd_death_d *out, double box[4], double *radius2, const dyd_points_d *p, dyd_lines_d *l);

/* Many pairs at once, their points without low parts, by columns: i, j, and the vertices that may rise and fall. Then
 * the place, the centre from p_i, D there and r^2, with bounds of their relative errors, and top: other vertices whose
 * squared distance from the centre is top or more do not bind; -1: not known. */
#ifdef DYD_ARMED
enum { DYD_BATCH = 3 }; /* few pairs fill it, and all of it may have to be tried again */
#else
enum { DYD_BATCH = 64 };
#endif
typedef struct dyd_batch_d {
  uint32_t count, of[4][DYD_BATCH];
  uint8_t round[DYD_BATCH];
  double x[4][DYD_BATCH], y[4][DYD_BATCH];
  double s[DYD_BATCH], es[DYD_BATCH], cx[DYD_BATCH], cy[DYD_BATCH], top[DYD_BATCH];
  double D[DYD_BATCH], rD[DYD_BATCH], B[DYD_BATCH], rB[DYD_BATCH];
} dyd_batch_d;
void dyd_filter_batch(dyd_batch_d *c, const dyd_points_d *p);
/* The death of pair k, if those two bind. *again: others may, and are put instead of them. l: the pair's points. */
bool dyd_filter_batched(dyd_death_d *out, bool *again, dyd_batch_d *c, uint32_t k, const dyd_points_d *p,
                        dyd_lines_d *l);

/* along: P.J; m, n as above. All in integers: coordinates multiplied by a common factor. */
typedef struct dyd_line_over {
  uint32_t vertex;
  mpz_t m, n, along;
} dyd_line_over;

/* Invariant: item, rect and grid are initialised up to made; item[0 .. count-1] are in use, no vertex twice.
 * Coordinates were multiplied by factor > 0; (ix, iy) is p_i then. */
typedef struct dyd_lines {
  mpz_t ix, iy, jx, jy, jj;
  mpq_t factor;
  dyd_line_over *item;
  dyd_rect *rect;
  dyd_irect *grid;
  size_t count, made;
  mpz_t u, v, x, y; /* scratch */
} dyd_lines;

/* s = p / (2 q), q > 0; q = 0, p = 1 or -1: the end of the bisector at infinity. */
typedef struct dyd_bisector_place {
  mpz_t p, q;
} dyd_bisector_place;

/* What limits f at its supremum: TWO lines that cross, ONE line at its own summit (a disc touches that of i or j), or
 * one line at the END of the bisector (a half-plane). a, b: numbers in item[]; a = b unless TWO. w = sqrt(plus) -
 * sqrt(minus). */
typedef enum dyd_binding { DYD_BINDING_NONE, DYD_BINDING_TWO, DYD_BINDING_ONE, DYD_BINDING_END } dyd_binding;
typedef struct dyd_summit {
  dyd_binding binding;
  size_t a, b;
  dyd_bisector_place at;
  mpq_t plus, minus;
} dyd_summit;

void dyd_lines_init(dyd_lines *l);
void dyd_lines_clear(dyd_lines *l);
void dyd_summit_init(dyd_summit *s);
void dyd_summit_clear(dyd_summit *s);

/* The lines of the vertices k[0 .. count-1], others than i and j, over the bisector of the vertices i and j, which are
 * different exact points. A vertex that is named twice counts once; `distinct`: none is. */
dyd_status dyd_lines_load(dyd_lines *l, const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t *k, size_t count,
                          bool distinct);

/* The supremum of f where it is positive somewhere (a pair that is strictly Delaunay for these sites): O(count) for
 * each line that comes to bind. NONE without lines: f has no bound. */
void dyd_lines_death(dyd_summit *out, dyd_lines *l);
/* The supremum of f where it is nowhere positive: the best corner of the envelope, or end. O(count^2). */
void dyd_lines_birth(dyd_summit *out, dyd_lines *l);
/* The summit where the two lines, or the end where the one line, are known to bind. */
void dyd_lines_birth_by(dyd_summit *out, dyd_lines *l);
/* About s at the place; 0 at an end. */
double dyd_summit_place(const dyd_summit *s);
/* A box of doubles around the centre at s->at, and an upper bound of its squared distance to line s->a; false at an
 * end, where there is none. */
bool dyd_summit_disc(double box[4], double *radius2, const dyd_summit *s, dyd_lines *l);

#endif
