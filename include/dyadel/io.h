/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points files in, results out: the formats of the command. */
#ifndef DYADEL_IO_H
#define DYADEL_IO_H

#include <dyadel/converge.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dyd_read_options {
  const char
      *columns;       /* "NAME,NAME": read CSV with a header (RFC 4180) and take these two columns; NULL: points file */
  bool measured;      /* read every decimal as a rounded measurement: 47.61 becomes [47.605,47.615] */
  const char *radius; /* an exact number: widen every point by it on each side; NULL: none */
} dyd_read_options;

/* Reads points from `in` up to its end and adds them to e (nothing is added on failure). options may be NULL.
 * On DYD_E_PARSE err has line, column and a message with the remedy. */
DYD_API dyd_status dyd_read_points(dyd_engine *e, FILE *in, const dyd_read_options *options, dyd_error *err);

typedef enum dyd_format {
  DYD_FORMAT_CSV = 0,
  DYD_FORMAT_JSON,
  DYD_FORMAT_WKT,
  DYD_FORMAT_GEOJSON,
  DYD_FORMAT_OBJ,
  DYD_FORMAT_SVG
} dyd_format;
/* Finds a format by its name ("csv"); false when there is none. */
DYD_API bool dyd_format_from_name(dyd_format *out, const char *name);
/* The name of a format; NULL behind the last one, so that counting up from 0 lists them all. Static storage. */
DYD_API const char *dyd_format_name(dyd_format format);

/* Writes the current result of e. DYD_E_ARG when e has none; DYD_E_IO when a write fails. */
DYD_API dyd_status dyd_write_delaunay(FILE *out, const dyd_engine *e, dyd_format format, dyd_error *err);

/* Writes a table of convergence: DYD_FORMAT_CSV or DYD_FORMAT_JSON (else DYD_E_ARG). Bounds and widths are rounded up,
 * and the output says so. times = false leaves the seconds out: then equal runs give equal bytes. */
DYD_API dyd_status dyd_write_convergence(FILE *out, const dyd_convergence *c, dyd_format format, bool times,
                                         dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
