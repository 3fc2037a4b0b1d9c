/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of sites: N partial points, laid out for speed.
 *
 * Doubles rounded outward live in four arrays (lower and upper ends, x and y); the exact rectangle is kept
 * next to them only where doubles do not hold it. A site only ever shrinks. */
#ifndef DYADEL_SITES_H
#define DYADEL_SITES_H

#include <dyadel/rect.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DYD_MAX_SITES ((size_t)1 << 28)

typedef struct dyd_sites dyd_sites;

DYD_API dyd_status dyd_sites_new(dyd_sites **out);
DYD_API void dyd_sites_free(dyd_sites *s);
/* Appends n exact points / n rectangles, numbered on from the sites there are. Copied.
 * DYD_E_ARG for NaN, infinities or lower > upper, DYD_E_NOMEM; nothing is appended then. */
DYD_API dyd_status dyd_sites_add_points(dyd_sites *s, size_t n, const double *x, const double *y);
DYD_API dyd_status dyd_sites_add_boxes(dyd_sites *s, size_t n, const double *x0, const double *x1, const double *y0,
                                       const double *y1);
/* Doubles in a table of the caller's (dyd_engine_add_columns): `first`, and each `step` bytes behind the one before; 0:
 * one number for all. They need not be aligned. */
typedef struct dyd_column {
  const double *first;
  ptrdiff_t step;
} dyd_column;
DYD_API dyd_status dyd_sites_add_rect(dyd_sites *s, const dyd_rect *r);
DYD_API size_t dyd_sites_count(const dyd_sites *s);
/* The exact rectangle of site i, copied into *out. */
DYD_API dyd_status dyd_sites_get(dyd_rect *out, const dyd_sites *s, size_t i);
/* The outward-rounded rectangle of site i: out[0..3] = x lower, x upper, y lower, y upper. */
DYD_API void dyd_sites_get_d(double out[4], const dyd_sites *s, size_t i);
DYD_API bool dyd_sites_is_point(const dyd_sites *s, size_t i);
/* Replaces site i by a rectangle inside it; DYD_E_NESTING (site unchanged) when r is not inside. */
DYD_API dyd_status dyd_sites_narrow(dyd_sites *s, size_t i, const dyd_rect *r);
/* Bytes held. */
DYD_API size_t dyd_sites_memory(const dyd_sites *s);

#ifdef __cplusplus
}
#endif
#endif
