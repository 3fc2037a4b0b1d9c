/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What pictures are made of: lines, areas, dots. */
#include "picture/picture.h"

#include <math.h>

void dyd_picture_stroke(dyd_canvas *c, unsigned rgb, double width, double on, double off) {
  double unit = fmax(width, 0.7);
  dyd_canvas_paint(c, &(dyd_paint){DYD_NO_COLOUR, rgb, 1, width, on * unit, off * unit});
}

void dyd_picture_fill(dyd_canvas *c, unsigned rgb) {
  dyd_canvas_paint(c, &(dyd_paint){rgb, DYD_NO_COLOUR, 1, 0, 0, 0});
}

void dyd_picture_shape(dyd_canvas *c, unsigned fill, double alpha, unsigned edge, double width) {
  dyd_canvas_paint(c, &(dyd_paint){fill, edge, alpha, width, 0, 0});
}

void dyd_picture_line(dyd_canvas *c, double z[2][2], unsigned rgb, double width, double on, double off) {
  dyd_canvas_move(c, z[0][0], z[0][1]);
  dyd_canvas_line(c, z[1][0], z[1][1]);
  dyd_picture_stroke(c, rgb, width, on, off);
}

void dyd_picture_dot(dyd_canvas *c, double x, double y, double radius, unsigned fill, unsigned edge) {
  dyd_canvas_circle(c, x, y, radius);
  dyd_picture_shape(c, fill, 1, edge, 1.2);
}

void dyd_picture_box(dyd_canvas *c, const dyd_view *v, const double b[4]) {
  dyd_canvas_box(c, dyd_view_x(v, b[0]), dyd_view_y(v, b[3]), (b[1] - b[0]) * v->scale, (b[3] - b[2]) * v->scale);
}
