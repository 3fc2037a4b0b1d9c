/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sites in a view. */
#include "io/decimal.h"
#include "io/label_text.h"
#include "picture/picture.h"
#include <math.h>

#define LARGEST_DISC 1e6 /* across, on the page: larger ones are drawn as their squares */

/* "point 7 (Alpha): x 1.5, y in [2,2.25]" for who points at it. */
static void name_site(dyd_canvas *c, const double box[4], const dyd_engine *e, size_t site) {
  char id[40], title[200], called[DYD_LABEL_SIZE + 8] = "", spare[DYD_LABEL_SIZE], text[2][2 * DYD_DECIMAL_SIZE + 8];
  for (int k = 0; k < 2; k++) {
    char lo[DYD_DECIMAL_SIZE], hi[DYD_DECIMAL_SIZE];
    dyd_decimal_directed(lo, box[2 * k], 10, DYD_DOWN);
    dyd_decimal_directed(hi, box[2 * k + 1], 10, DYD_UP);
    if (box[2 * k] == box[2 * k + 1])
      snprintf(text[k], sizeof text[k], "about %s", lo);
    else
      snprintf(text[k], sizeof text[k], "in [%s,%s]", lo, hi);
  }
  size_t number = dyd_engine_row(e, site);
  snprintf(id, sizeof id, "point-%zu", number);
  const char *label = dyd_label_text(spare, e, site);
  if (label != spare) snprintf(called, sizeof called, " (%s)", label);
  snprintf(title, sizeof title, "point %zu%s: x %s, y %s", number, called, text[0], text[1]);
  dyd_canvas_name(c, id, title);
}

void dyd_picture_name_pair(dyd_canvas *c, const dyd_engine *e, size_t i, size_t j, const char *what) {
  char id[80], title[120];
  size_t a = dyd_engine_row(e, i), b = dyd_engine_row(e, j);
  snprintf(id, sizeof id, "pair-%zu-%zu", a, b);
  snprintf(title, sizeof title, "%zu, %zu: %s", a, b, what);
  dyd_canvas_name(c, id, title);
}

dyd_site_mark dyd_picture_site(dyd_canvas *c, const dyd_view *v, const double box[4], const dyd_engine *e, size_t site,
                               unsigned rgb) {
  double x0 = dyd_view_x(v, box[0]), x1 = dyd_view_x(v, box[1]), y0 = dyd_view_y(v, box[3]), y1 = dyd_view_y(v, box[2]);
  const double *f = v->frame;
  if (!dyd_view_sees(v, box)) return DYD_MARK_NONE;
  name_site(c, box, e, site);
  if (v->dots || fmax(x1 - x0, y1 - y0) < 2 * v->dot) {
    dyd_canvas_circle(c, x0 / 2 + x1 / 2, y0 / 2 + y1 / 2, v->dot);
    dyd_picture_fill(c, 0x222222);
    return DYD_MARK_DOT;
  }
  /* What is far outside does not fit the numbers of a page. */
  if (v->discs && x1 - x0 < LARGEST_DISC) {
    dyd_canvas_circle(c, x0 / 2 + x1 / 2, y0 / 2 + y1 / 2, (x1 - x0) / 2);
  } else {
    x0 = fmax(x0, f[0] - 60), x1 = fmin(x1, f[1] + 60), y0 = fmax(y0, f[2] - 60), y1 = fmin(y1, f[3] + 60);
    double least = fmax(v->line, 1);
    dyd_canvas_box(c, x0, y0, fmax(x1 - x0, least), fmax(y1 - y0, least));
  }
  dyd_picture_shape(c, rgb, 0.55, (rgb >> 1 & 0x7f7f7f) + (rgb >> 4 & 0x0f0f0f), fmax(v->line * 0.7, 0.5));
  return DYD_MARK_RECTANGLE;
}

void dyd_picture_marked(dyd_canvas *c, const dyd_view *v, const double box[4], const dyd_engine *e, size_t site,
                        unsigned rgb) {
  double w = fmax((box[1] - box[0]) * v->scale, 7), h = fmax((box[3] - box[2]) * v->scale, 7);
  double z[2];
  dyd_view_middle(z, v, box);
  name_site(c, box, e, site);
  dyd_canvas_box(c, z[0] - w / 2, z[1] - h / 2, w, h);
  dyd_picture_shape(c, rgb, 1, 0x222222, 1.5);
}
