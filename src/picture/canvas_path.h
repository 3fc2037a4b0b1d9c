/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A canvas from inside: its path, and what its two kinds do. */
#ifndef DYD_PICTURE_CANVAS_PATH_H
#define DYD_PICTURE_CANVAS_PATH_H

#include "io/sink.h"
#include "picture/canvas.h"

typedef enum dyd_stroke {
  DYD_STROKE_MOVE,
  DYD_STROKE_LINE,
  DYD_STROKE_CURVE,
  DYD_STROKE_ARC,
  DYD_STROKE_CLOSE
} dyd_stroke;

typedef struct dyd_path_step {
  dyd_stroke kind;
  double z[6]; /* x, y; of a curve both inner points before; of an arc centre, radius, angles */
} dyd_path_step;

struct dyd_canvas {
  dyd_format format;
  FILE *out;
  dyd_sink to;       /* of svg: to it */
  int error;         /* errno of the first write that failed, else 0 */
  struct _cairo *cr; /* of svg: to measure texts; NULL without cairo */
  dyd_path_step *step;
  size_t count, cap;
  bool failed; /* memory ran out */
  bool open;   /* svg: a group with the paint `shared` */
  dyd_paint shared;
  unsigned clips; /* svg: so many so far */
  char id[80], title[160];
};

/* ---- canvas_cairo.c; canvas_plain.c where the library was built without it ---- */

void dyd_cairo_begin(dyd_canvas *c, double width, double height);
/* Hands over what was drawn; returns st, or what went wrong. */
dyd_status dyd_cairo_end(dyd_canvas *c, dyd_status st, dyd_error *err);
void dyd_cairo_paint(dyd_canvas *c, const dyd_paint *p);
void dyd_cairo_clip(dyd_canvas *c);
void dyd_cairo_unclip(dyd_canvas *c);
double dyd_cairo_width(dyd_canvas *c, double size, const char *text);
void dyd_cairo_text(dyd_canvas *c, double x, double y, bool halo, const char *text);

#endif
