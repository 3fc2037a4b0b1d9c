/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plots of series against stages on logarithmic scales, on a canvas. */
#ifndef DYD_PICTURE_PANEL_H
#define DYD_PICTURE_PANEL_H

#include "picture/canvas.h"
#include <dyadel/converge.h>

/* One curve, told apart by colour, by dash and by marker, so that grey does as well. */
typedef struct dyd_series {
  const char *name;
  unsigned rgb;
  double dash;   /* length; 0: a full line */
  unsigned mark; /* sides of the marker: 0 (a ring) or 3, 4, 5 */
} dyd_series;

enum { DYD_PANEL_MOST = 6 }; /* curves */

/* Invariant: low < high, count <= DYD_PANEL_MOST; zero is drawn on the bottom line, below low. */
typedef struct dyd_panel {
  double x, y, width, height; /* of the frame */
  double low, high;           /* on its scale */
  const char *id, *title;
  const dyd_series *series;
  size_t count;
  /* A number of the row for each curve, on the panel's scale; NAN where it is not known, -INFINITY for zero. */
  void (*values)(double *out, const dyd_stage_row *r);
} dyd_panel;

/* Sets low and high from the values. */
void dyd_panel_fit(dyd_panel *p, const dyd_convergence *c);
/* Frame, ticks (labels base^k), curves, legend. */
void dyd_panel_draw(dyd_canvas *on, const dyd_panel *p, const dyd_convergence *c, int base);

#endif
