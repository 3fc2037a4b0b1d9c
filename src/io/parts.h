/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pieces that several formats or contents share. */
#ifndef DYD_IO_PARTS_H
#define DYD_IO_PARTS_H

#include "io/sink.h"
#include <dyadel/delaunay.h>
#include <dyadel/sphere.h>

/* Goes over the rows that have a point in common with an earlier one, ascending: aliases of the triangulation, and rows
 * that were merged when they were read. Begin with e, and s where it is that of the places of a sphere. */
typedef struct dyd_alias_walk {
  const dyd_engine *e;
  const dyd_sphere *s; /* NULL: of a plane */
  size_t i, merged;    /* where to look on */
  size_t row, of;      /* what was found: rows; */
  size_t site;         /* of the latter */
} dyd_alias_walk;
/* false: there is no other one. */
bool dyd_alias_next(dyd_alias_walk *w);
/* "# alias 7 3" for each alias or merged row of the result of e, a line each. */
void dyd_csv_aliases(FILE *out, const dyd_engine *e);
/* "aliases": [[7, 3], ..], and `after` behind it. */
void dyd_json_aliases(FILE *out, const dyd_engine *e, const char *after);
/* The same of a sphere. */
void dyd_csv_sphere_aliases(FILE *out, const dyd_sphere *s);
void dyd_json_sphere_aliases(FILE *out, const dyd_sphere *s, const char *after);
/* "adaptive", "uniform". */
const char *dyd_schedule_text(dyd_schedule schedule);
/* "format": .., "version": ..: the opening of an object. */
void dyd_json_head(FILE *out, const char *format);
/* "crs": "EPSG:32632", where it is known (not 0). */
void dyd_json_crs(FILE *out, unsigned epsg);
/* The head, with the outcome, where pairs of numbers are rounded outward and texts are exact. */
void dyd_json_head_outward(FILE *out, const char *format, dyd_outcome outcome);
/* "NAME": {"exact": "m*2^e", "decimal": rounded up}; null where the value is not known (NULL). */
dyd_status dyd_json_bound(FILE *out, const char *name, const dyd_dyadic *value);
/* "x": [lo, hi]<between>"y": [lo, hi], exact texts. */
dyd_status dyd_json_sides(FILE *out, const dyd_rect *r, const char *between);
/* The same as an object. */
dyd_status dyd_json_rect(FILE *out, const dyd_rect *r);
/* [lo, hi]: decimals rounded outward. */
void dyd_json_decimals(FILE *out, double lo, double hi);
/* "x<suffix>": [lo, hi], "y<suffix>": [lo, hi]: decimals rounded outward. */
void dyd_sink_json_box(dyd_sink *s, const char *suffix, const double box[4]);
void dyd_json_box(FILE *out, const char *suffix, const double box[4]);
/* The four ends of a window with dyadic ends, as exact texts, each between `quote`. */
dyd_status dyd_put_window(FILE *out, const dyd_rect *w, const char *quote, const char *between);

#endif
