/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What pictures of bisectors and discs are made of. Positions are rounded to hundredths of a pixel. */
#include "io/svg_pieces.h"

#include <math.h>
#include <stdlib.h>

#define SIDE 800.0  /* pixels of the longer side */
#define WIDTH 720.0 /* at least: for the text */
#define FOOT 44.0   /* room of two lines of text below */

void dyd_canvas_put(const dyd_canvas *c, const char *before, double pixels) {
  long h = lround(fmax(-1e9, fmin(1e9, pixels)) * 100);
  fprintf(c->out, "%s%s%ld.%02ld", before, h < 0 ? "-" : "", labs(h) / 100, labs(h) % 100);
}

void dyd_canvas_point(const dyd_canvas *c, const char *before, double x, double y) {
  dyd_canvas_put(c, before, (x - c->left) * c->scale);
  dyd_canvas_put(c, " ", (c->top - y) * c->scale);
}

bool dyd_canvas_grow(double box[4], const dyd_rect *r) {
  double b[4];
  dyd_interval_get_d(&b[0], &b[1], &r->x);
  dyd_interval_get_d(&b[2], &b[3], &r->y);
  for (int k = 0; k < 4; k++) box[k] = k & 1 ? fmax(box[k], b[k]) : fmin(box[k], b[k]);
  return isfinite(b[0]) && isfinite(b[1]) && isfinite(b[2]) && isfinite(b[3]);
}

dyd_status dyd_canvas_begin(dyd_canvas *c, FILE *out, const double box[4], double margin, const char *title) {
  double size = fmax(box[1] - box[0], box[3] - box[2]);
  if (size == 0) size = 1;
  double w = box[1] - box[0] + 2 * margin * size, h = box[3] - box[2] + 2 * margin * size;
  *c = (dyd_canvas){.out = out, .left = box[0] - margin * size, .top = box[3] + margin * size};
  c->scale = SIDE / fmax(w, h);
  if (!isfinite(c->scale) || !(c->scale > 0) || !isfinite(c->left) || !isfinite(c->top)) return DYD_E_RANGE;
  c->width = w * c->scale;
  c->height = h * c->scale;
  fputs("<svg xmlns=\"http://www.w3.org/2000/svg\"", out);
  dyd_canvas_put(c, " width=\"", fmax(c->width, WIDTH));
  dyd_canvas_put(c, "\" height=\"", c->height + FOOT);
  fprintf(out, "\" font-family=\"sans-serif\" font-size=\"14\">\n<title>%s</title>\n", title);
  fputs("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<clipPath id=\"frame\"><rect", out);
  dyd_canvas_put(c, " width=\"", c->width);
  dyd_canvas_put(c, "\" height=\"", c->height);
  fputs("\"/></clipPath>\n<g clip-path=\"url(#frame)\">\n", out);
  return DYD_OK;
}

static void put_line(const dyd_canvas *c, double y, const char *text) {
  fputs("<text x=\"10\" font-size=\"12\"", c->out);
  dyd_canvas_put(c, " y=\"", y);
  fprintf(c->out, "\">%s</text>\n", text);
}

void dyd_canvas_end(const dyd_canvas *c, const char *text) {
  fputs("</g>\n", c->out);
  put_line(c, c->height + 18, text);
  put_line(c, c->height + 34, "positions rounded by at most 0.01 pixel");
  fputs("</svg>\n", c->out);
}

void dyd_canvas_rect(const dyd_canvas *c, const dyd_rect *r, size_t number, const char *colour) {
  double b[4];
  dyd_interval_get_d(&b[0], &b[1], &r->x);
  dyd_interval_get_d(&b[2], &b[3], &r->y);
  double w = (b[1] - b[0]) * c->scale, h = (b[3] - b[2]) * c->scale;
  double x = ((b[0] / 2 + b[1] / 2) - c->left) * c->scale, y = (c->top - (b[2] / 2 + b[3] / 2)) * c->scale;
  w = fmax(w, 4), h = fmax(h, 4); /* points and segments can be seen */
  dyd_canvas_put(c, "<rect x=\"", x - w / 2);
  dyd_canvas_put(c, "\" y=\"", y - h / 2);
  dyd_canvas_put(c, "\" width=\"", w);
  dyd_canvas_put(c, "\" height=\"", h);
  fprintf(c->out, "\" fill=\"%s\" stroke=\"#222\"/>\n", colour);
  dyd_canvas_put(c, "<text x=\"", x + w / 2 + 4);
  dyd_canvas_put(c, "\" y=\"", y - h / 2 - 4);
  fprintf(c->out, "\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\">%zu</text>\n", number);
}
