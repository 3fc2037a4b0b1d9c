/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pictures of bisectors and discs. */
#ifndef DYD_IO_SVG_PIECES_H
#define DYD_IO_SVG_PIECES_H

#include <dyadel/arc.h>
#include <stdio.h>

/* A picture of the plane. Invariant: scale > 0; data to pixels: (x - left) scale, (top - y) scale. */
typedef struct dyd_canvas {
  FILE *out;
  double left, top, scale, width, height; /* width, height in pixels */
} dyd_canvas;

/* Begins a picture of the box {xlo, xhi, ylo, yhi}, enlarged by `margin` times its size on all sides. DYD_E_RANGE when
 * doubles cannot hold that. Ends with dyd_canvas_end and a line of text. */
dyd_status dyd_canvas_begin(dyd_canvas *c, FILE *out, const double box[4], double margin, const char *title);
void dyd_canvas_end(const dyd_canvas *c, const char *text);
/* Hundredths of a pixel, preceded by `before`; numbers beyond 10^9 are cut off. */
void dyd_canvas_put(const dyd_canvas *c, const char *before, double pixels);
void dyd_canvas_point(const dyd_canvas *c, const char *before, double x, double y);
/* A rectangle (or dot), with its number, and the fill colour. */
void dyd_canvas_rect(const dyd_canvas *c, const dyd_rect *r, size_t number, const char *colour);
/* *box grows to hold r; false unless all is finite. */
bool dyd_canvas_grow(double box[4], const dyd_rect *r);

dyd_status dyd_bisector_svg(FILE *out, const dyd_rect *const r[2], const dyd_boundary curve[2]);
dyd_status dyd_disc_svg(FILE *out, const dyd_partial_disc *d, const dyd_rect *const *r, size_t n);

#endif
