/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The svg picture: rectangles, edges by status, sure triangles, a legend and a scale.
 *
 * Lengths are in pixels with two decimals; lines and dots get thinner as sites get denser. Statuses differ in colour
 * (colours that colour-blind people tell apart) and in dash, so that a grey copy can be read too. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/result.h"
#include <math.h>

#define SIDE 1000.0 /* of the drawing */
#define EDGE 30.0   /* free space around it */
#define FOOT 84.0   /* room of the legend */

/* Invariant: scale > 0; the drawing fits width x height. */
typedef struct frame {
  double left, top, scale; /* data to pixels: (x - left) * scale + EDGE, (top - y) * scale + EDGE */
  double width, height;    /* pixels, without the free space */
  double line, dot;        /* width of lines, radius of dots */
} frame;

static const struct {
  dyd_pair_status status;
  const char *name, *colour;
  double dash_on, dash_off, width; /* in line widths */
} style[3] = {{DYD_TIE, "tie", "#6b6b6b", 0.2, 2.2, 1.0},
              {DYD_INDETERMINATE, "indeterminate", "#d55e00", 4, 2.5, 1.0},
              {DYD_LEGAL, "legal", "#0072b2", 0, 0, 1.2}};

/* Hundredths of a pixel, whatever the locale. */
static void put(FILE *out, double v) {
  long h = lround(v * 100);
  fprintf(out, "%s%ld.%02ld", h < 0 ? "-" : "", labs(h) / 100, labs(h) % 100);
}

static void put_attribute(FILE *out, const char *name, double v) {
  fprintf(out, " %s=\"", name);
  put(out, v);
  fputs("\"", out);
}

static double pixel_x(const frame *f, double x) {
  return (x - f->left) * f->scale + EDGE;
}
static double pixel_y(const frame *f, double y) {
  return (f->top - y) * f->scale + EDGE;
}

/* Halves first: the ends may be near the largest double. */
static double middle(double lo, double hi) {
  return lo / 2 + hi / 2;
}

static dyd_status find_frame(frame *f, const dyd_result *r, dyd_error *err) {
  double all[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (size_t i = 0; i < r->count; i++) {
    double box[4];
    dyd_status status = dyd_result_box(box, r, i, err);
    if (status < 0) return status;
    all[0] = fmin(all[0], box[0]), all[1] = fmax(all[1], box[1]);
    all[2] = fmin(all[2], box[2]), all[3] = fmax(all[3], box[3]);
  }
  if (r->count == 0) all[0] = all[1] = all[2] = all[3] = 0;
  double size = fmax(all[1] - all[0], all[3] - all[2]);
  if (!isfinite(size) || (size > 0 && !isfinite(SIDE / size)))
    return dyd_fail(err, DYD_E_RANGE, "the points are too far apart or too close for a picture; use csv or json");
  f->scale = size > 0 ? SIDE / size : 1;
  f->left = all[0], f->top = all[3];
  f->width = fmax((all[1] - all[0]) * f->scale, 640);
  f->height = fmax((all[3] - all[2]) * f->scale, 40);
  if ((all[1] - all[0]) * f->scale < f->width) f->left -= (f->width / f->scale - (all[1] - all[0])) / 2;
  if ((all[3] - all[2]) * f->scale < f->height) f->top += (f->height / f->scale - (all[3] - all[2])) / 2;
  double spacing = SIDE / sqrt((double)r->count + 1);
  f->line = fmin(fmax(spacing * 0.03, 0.35), 2.2);
  f->dot = fmin(fmax(spacing * 0.06, 0.8), 4);
  return DYD_OK;
}

static void write_triangles(const dyd_result *r, const frame *f, const dyd_triangle_list *list) {
  fputs("<path id=\"triangles\" fill=\"#e6f0f7\" d=\"", r->out);
  for (size_t k = 0; k < list->count; k++) {
    for (int c = 0; c < 3; c++) {
      double box[4];
      dyd_sites_get_d(box, r->sites, list->item[k].v[c]);
      fputs(c ? "L" : "M", r->out);
      put(r->out, pixel_x(f, middle(box[0], box[1])));
      fputs(" ", r->out);
      put(r->out, pixel_y(f, middle(box[2], box[3])));
    }
    fputs(k % 8 == 7 ? "Z\n" : "Z", r->out);
  }
  fputs("\"/>\n", r->out);
}

/* stroke attributes of style k; `line` in pixels. */
static void write_stroke(FILE *out, int k, double line) {
  line *= style[k].width;
  fprintf(out, " fill=\"none\" stroke=\"%s\" stroke-linecap=\"round\"", style[k].colour);
  put_attribute(out, "stroke-width", line);
  if (style[k].dash_off == 0) return;
  double unit = fmax(line, 0.7);
  fputs(" stroke-dasharray=\"", out);
  put(out, style[k].dash_on * unit);
  fputs(" ", out);
  put(out, style[k].dash_off * unit);
  fputs("\"", out);
}

static void write_edges(const dyd_result *r, const frame *f, int k) {
  fprintf(r->out, "<path id=\"%s\"", style[k].name);
  write_stroke(r->out, k, f->line);
  fputs(" d=\"", r->out);
  for (size_t p = 0, shown = 0; p < r->pairs.count; p++) {
    const dyd_pair *pair = &r->pairs.item[p];
    if (pair->status != style[k].status) continue;
    double a[4], b[4];
    dyd_sites_get_d(a, r->sites, pair->i);
    dyd_sites_get_d(b, r->sites, pair->j);
    fputs("M", r->out);
    put(r->out, pixel_x(f, middle(a[0], a[1])));
    fputs(" ", r->out);
    put(r->out, pixel_y(f, middle(a[2], a[3])));
    fputs("L", r->out);
    put(r->out, pixel_x(f, middle(b[0], b[1])));
    fputs(" ", r->out);
    put(r->out, pixel_y(f, middle(b[2], b[3])));
    if (++shown % 8 == 0) fputs("\n", r->out);
  }
  fputs("\"/>\n", r->out);
}

/* A rectangle where it can be seen, else a dot. Sides of length 0 are drawn as thick as lines. */
static void write_site(const dyd_result *r, const frame *f, size_t i) {
  double box[4];
  dyd_sites_get_d(box, r->sites, i);
  double w = (box[1] - box[0]) * f->scale, h = (box[3] - box[2]) * f->scale;
  bool dot = fmax(w, h) < 2 * f->dot;
  double x = pixel_x(f, middle(box[0], box[1])), y = pixel_y(f, middle(box[2], box[3]));
  fputs(dot ? "<circle" : "<rect", r->out);
  put_attribute(r->out, dot ? "cx" : "x", dot ? x : pixel_x(f, box[0]));
  put_attribute(r->out, dot ? "cy" : "y", dot ? y : pixel_y(f, box[3]));
  put_attribute(r->out, dot ? "r" : "width", dot ? f->dot : fmax(w, f->line));
  if (!dot) put_attribute(r->out, "height", fmax(h, f->line));
  fputs(dot ? " fill=\"#222\" fill-opacity=\"1\" stroke=\"none\"/>\n" : "/>\n", r->out);
  if (r->count > 40) return;
  fputs("<text", r->out);
  put_attribute(r->out, "x", x + 6);
  put_attribute(r->out, "y", y - 6);
  fprintf(r->out,
          " fill=\"#222\" fill-opacity=\"1\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\">%zu</text>\n",
          i);
}

static void write_sites(const dyd_result *r, const frame *f) {
  fputs("<g id=\"sites\" fill=\"#e69f00\" fill-opacity=\"0.35\" stroke=\"#222\"", r->out);
  put_attribute(r->out, "stroke-width", f->line / 2);
  fputs(">\n", r->out);
  for (size_t i = 0; i < r->count; i++)
    if (dyd_delaunay_alias(r->pd, (uint32_t)i) == i) write_site(r, f, i);
  fputs("</g>\n", r->out);
}

/* A bar of 1, 2 or 5 times a power of ten, about a fifth of the width. */
static void write_scale(const dyd_result *r, const frame *f, double y) {
  double want = f->width / 5 / f->scale, length = pow(10, floor(log10(want)));
  if (length * 5 <= want)
    length *= 5;
  else if (length * 2 <= want)
    length *= 2;
  double x = EDGE + f->width - length * f->scale;
  char text[DYD_DECIMAL_SIZE];
  double error;
  dyd_decimal_within(text, &error, length, length);
  fputs("<path stroke=\"#222\" stroke-width=\"1.5\" fill=\"none\" d=\"M", r->out);
  put(r->out, x);
  fputs(" ", r->out);
  put(r->out, y - 4);
  fputs("v8m0 -4H", r->out);
  put(r->out, EDGE + f->width);
  fputs("m0 -4v8\"/>\n<text text-anchor=\"end\"", r->out);
  put_attribute(r->out, "x", EDGE + f->width);
  put_attribute(r->out, "y", y + 20);
  fprintf(r->out, ">%s</text>\n", text);
}

/* One line sample with its name and number; returns where the next one begins. */
static double write_sample(const dyd_result *r, int k, size_t count, double x, double y) {
  char text[60];
  int length = snprintf(text, sizeof text, "%s: %zu", style[k].name, count);
  fputs("<path", r->out);
  write_stroke(r->out, k, 2);
  fputs(" d=\"M", r->out);
  put(r->out, x);
  fputs(" ", r->out);
  put(r->out, y);
  fputs("h30\"/>\n<text", r->out);
  put_attribute(r->out, "x", x + 36);
  put_attribute(r->out, "y", y + 5);
  fprintf(r->out, ">%s</text>\n", text);
  return x + 60 + 8.0 * length;
}

static void write_legend(const dyd_result *r, const frame *f) {
  size_t count[4];
  double x = EDGE, y = 2 * EDGE + f->height + 4;
  dyd_delaunay_count(count, r->pd);
  for (int k = 2; k >= 0; k--) x = write_sample(r, k, count[style[k].status], x, y);
  write_scale(r, f, y);
  fputs("<text", r->out);
  put_attribute(r->out, "x", EDGE);
  put_attribute(r->out, "y", y + 28);
  fprintf(r->out,
          ">%zu points, outcome %s%s; blue areas: sure triangles; positions rounded by at most 0.01 pixel</text>\n",
          r->count, dyd_outcome_text(dyd_engine_outcome(r->engine)),
          dyd_delaunay_is_capped(r->pd) ? ", not all possible pairs are shown" : "");
}

dyd_status dyd_write_svg(const dyd_result *r, dyd_error *err) {
  frame f = {0};
  dyd_triangle_list triangles = {0};
  dyd_status status = find_frame(&f, r, err);
  if (status < 0) return status;
  status = dyd_delaunay_triangles(&triangles, r->pd);
  if (status < 0) return dyd_fail(err, status, "%s", dyd_status_text(status));
  double width = f.width + 2 * EDGE, height = f.height + EDGE + FOOT;
  fputs("<svg xmlns=\"http://www.w3.org/2000/svg\"", r->out);
  put_attribute(r->out, "width", width);
  put_attribute(r->out, "height", height);
  fputs(" font-family=\"sans-serif\" font-size=\"14\">\n<title>Partial Delaunay triangulation</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        r->out);
  write_triangles(r, &f, &triangles);
  for (int k = 0; k < 3; k++) write_edges(r, &f, k);
  write_sites(r, &f);
  write_legend(r, &f);
  fputs("</svg>\n", r->out);
  dyd_triangle_list_clear(&triangles);
  return DYD_OK;
}
