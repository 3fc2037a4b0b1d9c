/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages as svg: text stays text, and elements can be named. */
#include "picture/canvas_path.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* ---- pieces ---- */

/* To hundredths, with a point in every locale; what is beyond any page is brought near. */
static void put_length(FILE *out, double x) {
  int64_t n = llround(fmin(fmax(x, -1e12), 1e12) * 100), whole = (n < 0 ? -n : n) / 100, rest = (n < 0 ? -n : n) % 100;
  fprintf(out, "%s%" PRId64, n < 0 ? "-" : "", whole);
  if (rest) fprintf(out, rest % 10 ? ".%02d" : ".%d", (int)(rest % 10 ? rest : rest / 10));
}

static void put_lengths(FILE *out, const char *before, const double *x, int count) {
  fputs(before, out);
  for (int k = 0; k < count; k++) {
    if (k) fputc(' ', out);
    put_length(out, x[k]);
  }
}

static void put_attribute(FILE *out, const char *name, double x) {
  fprintf(out, " %s=\"", name);
  put_length(out, x);
  fputc('"', out);
}

static void put_escaped(FILE *out, const char *text) {
  for (; *text; text++) {
    const char *entity = *text == '<' ? "&lt;" : *text == '>' ? "&gt;" : *text == '&' ? "&amp;" : NULL;
    if (*text == '"') entity = "&quot;";
    if (entity)
      fputs(entity, out);
    else
      fputc(*text, out);
  }
}

/* An arc to its end; a full circle needs two. */
static void put_arc(FILE *out, const double z[6]) {
  double sweep = z[4] - z[3];
  int parts = sweep > 6 ? 2 : 1;
  for (int k = 1; k <= parts; k++) {
    double turn = z[3] + sweep * k / parts, end[2] = {z[0] + z[2] * cos(turn), z[1] + z[2] * sin(turn)};
    put_lengths(out, "A", (const double[]){z[2], z[2]}, 2);
    put_lengths(out, sweep / parts > 3.1416 ? " 0 1 1 " : " 0 0 1 ", end, 2);
  }
}

static void put_path(const dyd_canvas *c) {
  FILE *out = c->out;
  fputs(" d=\"", out);
  for (size_t k = 0; k < c->count; k++) {
    const double *z = c->step[k].z;
    const double begin[2] = {z[0] + z[2] * cos(z[3]), z[1] + z[2] * sin(z[3])};
    switch (c->step[k].kind) {
    case DYD_STROKE_MOVE:
      put_lengths(out, "M", z, 2);
      break;
    case DYD_STROKE_LINE:
      put_lengths(out, "L", z, 2);
      break;
    case DYD_STROKE_CURVE:
      put_lengths(out, "C", z, 6);
      break;
    case DYD_STROKE_ARC:
      put_lengths(out, k ? "L" : "M", begin, 2);
      put_arc(out, z);
      break;
    case DYD_STROKE_CLOSE:
      fputs("Z", out);
    }
  }
  fputs("\"", out);
}

/* ---- groups of one paint ---- */

static void put_colour(FILE *out, const char *name, unsigned rgb) {
  if (rgb == DYD_NO_COLOUR)
    fprintf(out, " %s=\"none\"", name);
  else
    fprintf(out, " %s=\"#%06x\"", name, rgb);
}

static bool same_paint(const dyd_paint *a, const dyd_paint *b) {
  return a->fill == b->fill && a->stroke == b->stroke && a->alpha == b->alpha && a->width == b->width &&
         a->on == b->on && a->off == b->off;
}

static void close_group(dyd_canvas *c) {
  if (c->open) fputs("</g>\n", c->out);
  c->open = false;
}

static void open_group(dyd_canvas *c, const dyd_paint *p) {
  if (c->open && same_paint(p, &c->shared)) return;
  close_group(c);
  fputs("<g", c->out);
  put_colour(c->out, "fill", p->fill);
  if (p->fill != DYD_NO_COLOUR && p->alpha < 1) put_attribute(c->out, "fill-opacity", p->alpha);
  if (p->stroke != DYD_NO_COLOUR) {
    put_colour(c->out, "stroke", p->stroke);
    put_attribute(c->out, "stroke-width", p->width);
    if (p->off > 0) {
      put_lengths(c->out, " stroke-dasharray=\"", (const double[]){p->on, p->off}, 2);
      fputs("\"", c->out);
    }
  }
  fputs(">\n", c->out);
  c->open = true;
  c->shared = *p;
}

/* ---- the page ---- */

void dyd_svg_begin(dyd_canvas *c, double width, double height, const char *title) {
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"", c->out);
  put_attribute(c->out, "width", width);
  put_attribute(c->out, "height", height);
  put_lengths(c->out, " viewBox=\"0 0 ", (const double[]){width, height}, 2);
  fputs("\" font-family=\"sans-serif\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>", c->out);
  put_escaped(c->out, title);
  fputs("</title>\n", c->out);
}

void dyd_svg_end(dyd_canvas *c) {
  close_group(c);
  fputs("</svg>\n", c->out);
}

void dyd_svg_paint(dyd_canvas *c, const dyd_paint *paint) {
  if (c->count == 0) return;
  open_group(c, paint);
  fputs("<path", c->out);
  if (c->id[0]) fprintf(c->out, " id=\"%s\"", c->id);
  put_path(c);
  if (!c->title[0]) {
    fputs("/>\n", c->out);
    return;
  }
  fputs("><title>", c->out);
  put_escaped(c->out, c->title);
  fputs("</title></path>\n", c->out);
}

void dyd_svg_clip(dyd_canvas *c) {
  close_group(c);
  fprintf(c->out, "<clipPath id=\"clip%u\"><path", ++c->clips);
  put_path(c);
  fprintf(c->out, "/></clipPath>\n<g clip-path=\"url(#clip%u)\">\n", c->clips);
}

void dyd_svg_unclip(dyd_canvas *c) {
  close_group(c);
  fputs("</g>\n", c->out);
}

void dyd_svg_text(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text) {
  close_group(c);
  fputs("<text", c->out);
  put_attribute(c->out, "x", x);
  put_attribute(c->out, "y", y);
  put_attribute(c->out, "font-size", size);
  if (align > 0) fprintf(c->out, " text-anchor=\"%s\"", align < 1 ? "middle" : "end");
  if (halo) fputs(" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"", c->out);
  fputs(">", c->out);
  put_escaped(c->out, text);
  fputs("</text>\n", c->out);
}
