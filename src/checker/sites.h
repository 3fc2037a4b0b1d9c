/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The rectangles of a certificate, exact and on a coarse grid of integers.
 *
 * The grid has a unit 2^unit and an origin, so that all rectangles, rounded outward, have coordinates in [0, 2^31).
 * Grid coordinates only exclude: who is farther on the grid is farther. Everything else is decided exactly. */
#ifndef DYD_CHECKER_SITES_H
#define DYD_CHECKER_SITES_H

#include "checker/exact.h"
#include <dyadel/status.h>
#include <stddef.h>

#define DYD_CERT_NONE UINT32_MAX

/* [lo, hi], or the number lo / den (point; hi is not used; den = NULL means 1). */
typedef struct dyd_cert_side {
  dyd_exact lo, hi;
  mpz_t *den;
  bool point;
} dyd_cert_side;

/* Invariant: alias is the site's own number, or a lower one that is no alias itself and stands for the same point.
 * place (may be NULL) is a point of the rectangle, x and y: the site's place; else its place is its lower left corner.
 */
typedef struct dyd_cert_site {
  dyd_cert_side side[2];
  dyd_exact *place;
  uint32_t alias;
} dyd_cert_site;

/* x0, x1, y0, y1 on the grid. */
typedef struct dyd_cert_box {
  int32_t e[4];
} dyd_cert_box;

typedef struct dyd_cert_sites {
  dyd_cert_site *site;
  dyd_cert_box *box; /* of the rectangle; NULL until dyd_cert_sites_finish */
  size_t count, cap;
  int64_t unit;
  mpz_t origin[2];
} dyd_cert_sites;

void dyd_cert_sites_init(dyd_cert_sites *s);
void dyd_cert_sites_clear(dyd_cert_sites *s);
/* Appends a site with initialised numbers (zero); NULL when memory is exhausted. Borrowed until the next call. */
dyd_cert_site *dyd_cert_sites_add(dyd_cert_sites *s);
/* Makes the grid. */
dyd_status dyd_cert_sites_finish(dyd_cert_sites *s);
/* Gives the side a denominator > 1. */
dyd_status dyd_cert_side_set_den(dyd_cert_side *side, mpz_srcptr den);
/* Sets the place of a site; both numbers are copied. */
dyd_status dyd_cert_site_set_place(dyd_cert_site *site, const dyd_exact at[2]);

static inline bool dyd_cert_is_point(const dyd_cert_site *s) {
  return s->side[0].point && s->side[1].point;
}
static inline const dyd_exact *dyd_cert_high(const dyd_cert_side *s) {
  return s->point ? &s->lo : &s->hi;
}
static inline mpz_srcptr dyd_cert_den(const dyd_cert_side *s) {
  return s->den ? *s->den : NULL;
}

/* The place of a site: numerator and denominator (NULL: 1) of coordinate `axis`. */
static inline const dyd_exact *dyd_cert_place(mpz_srcptr *den, const dyd_cert_site *s, int axis) {
  *den = s->place ? NULL : dyd_cert_den(&s->side[axis]);
  return s->place ? &s->place[axis] : &s->side[axis].lo;
}

/* A fraction num / den, den > 0 (den = NULL: 1); what the exact comparisons hold. */
typedef struct dyd_cert_fraction {
  dyd_exact num;
  mpz_t den;
  bool whole; /* den = 1 */
} dyd_cert_fraction;

void dyd_cert_fraction_init(dyd_cert_fraction *f);
void dyd_cert_fraction_clear(dyd_cert_fraction *f);
int dyd_cert_fraction_cmp(const dyd_cert_fraction *a, const dyd_cert_fraction *b);
/* out = a / da - b / db; NULL denominators are 1. */
void dyd_cert_fraction_sub(dyd_cert_fraction *out, const dyd_exact *a, mpz_srcptr da, const dyd_exact *b,
                           mpz_srcptr db);
void dyd_cert_fraction_mul(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b);
void dyd_cert_fraction_add(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b);
void dyd_cert_fraction_swap(dyd_cert_fraction *a, dyd_cert_fraction *b);

/* A measure of distance from a centre: ds, dl, or the distance to the place. */
typedef enum dyd_cert_measure { DYD_CERT_NEAR, DYD_CERT_FAR, DYD_CERT_PLACE } dyd_cert_measure;
/* out = the squared distance from c (x and y) to the site. */
void dyd_cert_distance2(dyd_cert_fraction *out, const dyd_exact c[2], const dyd_cert_site *s, dyd_cert_measure measure);
/* A point with rational coordinates v / den (NULL: 1); all borrowed. */
typedef struct dyd_cert_spot {
  const dyd_exact *v[2];
  mpz_srcptr den[2];
} dyd_cert_spot;
dyd_cert_spot dyd_cert_place_of(const dyd_cert_sites *s, uint32_t v);
dyd_cert_spot dyd_cert_spot_at(const dyd_exact v[2]);
/* Sign of the cross product of b - a and d - c. */
int dyd_cert_cross(dyd_cert_spot a, dyd_cert_spot b, dyd_cert_spot c, dyd_cert_spot d);
/* Sign of the orientation of the places of three sites. */
int dyd_cert_turn(const dyd_cert_sites *s, uint32_t a, uint32_t b, uint32_t c);
/* Compares places by x, then by y. */
int dyd_cert_compare_places(const dyd_cert_sites *s, uint32_t a, uint32_t b);

/* Sign of max_{R_a} u.x - min_{R_b} u.x. */
int dyd_cert_compare_heights(const dyd_cert_sites *s, const dyd_exact u[2], uint32_t a, uint32_t b);

#endif
