/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages: paths, parts common to all kinds; svg, in which text stays text and elements have names; and TikZ: a
 * tikzpicture that \input reads, without any package but TikZ, whose texts are in the document's font.
 *
 * TeX holds lengths up to 16383 points. So a path that goes farther is cut to a box far outside of the page, its curves
 * and arcs made lines first. The box is convex, so filled areas stay as they were inside; lines along its rim are not
 * seen. */
#include "picture/canvas.h"

#include "base/alloc.h"
#include "base/error.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* ---- svg: pieces ---- */

/* To hundredths, with a point in every locale; lengths beyond any page are clamped. */
static void put_length(dyd_sink *to, double x) {
  int64_t n = llround(fmin(fmax(x, -1e12), 1e12) * 100);
  uint64_t size = (uint64_t)(n < 0 ? -n : n), rest = size % 100;
  char *p = dyd_sink_room(to, DYD_INDEX_SIZE + sizeof "-.25");
  if (n < 0) *p++ = '-';
  p = dyd_put_digits(p, size / 100);
  if (rest) *p++ = '.', *p++ = (char)('0' + rest / 10);
  if (rest % 10) *p++ = (char)('0' + rest % 10);
  to->end = p;
}

static void put_list(dyd_sink *to, const char *before, const double *x, int count, const char *between) {
  dyd_sink_text(to, before);
  for (int k = 0; k < count; k++) {
    if (k) dyd_sink_text(to, between);
    put_length(to, x[k]);
  }
}

static void put_lengths(dyd_sink *to, const char *before, const double *x, int count) {
  put_list(to, before, x, count, " ");
}

static void put_attribute(dyd_sink *to, const char *name, double x) {
  dyd_sink_text(to, " ");
  dyd_sink_text(to, name);
  dyd_sink_text(to, "=\"");
  put_length(to, x);
  dyd_sink_text(to, "\"");
}

static void put_escaped(dyd_sink *to, const char *text) {
  for (; *text; text++) {
    const char *entity = *text == '<' ? "&lt;" : *text == '>' ? "&gt;" : *text == '&' ? "&amp;" : NULL;
    if (*text == '"') entity = "&quot;";
    dyd_sink_put(to, entity ? entity : text, entity ? strlen(entity) : 1);
  }
}

/* An arc to its end; a full circle needs two. */
static void put_arc(dyd_sink *to, const double z[6]) {
  double sweep = z[4] - z[3];
  int parts = sweep > 6 ? 2 : 1;
  for (int k = 1; k <= parts; k++) {
    double turn = z[3] + sweep * k / parts, end[2] = {z[0] + z[2] * cos(turn), z[1] + z[2] * sin(turn)};
    put_lengths(to, "A", (const double[]){z[2], z[2]}, 2);
    put_lengths(to, sweep / parts > 3.1416 ? " 0 1 1 " : " 0 0 1 ", end, 2);
  }
}

static void put_path(dyd_canvas *c) {
  dyd_sink *to = &c->to;
  dyd_sink_text(to, " d=\"");
  for (size_t k = 0; k < c->count; k++) {
    const double *z = c->step[k].z;
    switch (c->step[k].kind) {
    case DYD_STROKE_MOVE:
      put_lengths(to, "M", z, 2);
      break;
    case DYD_STROKE_LINE:
      put_lengths(to, "L", z, 2);
      break;
    case DYD_STROKE_CURVE:
      put_lengths(to, "C", z, 6);
      break;
    case DYD_STROKE_ARC:
      put_lengths(to, k ? "L" : "M", (const double[]){z[0] + z[2] * cos(z[3]), z[1] + z[2] * sin(z[3])}, 2);
      put_arc(to, z);
      break;
    case DYD_STROKE_CLOSE:
      dyd_sink_text(to, "Z");
    }
  }
  dyd_sink_text(to, "\"");
}

/* ---- svg: groups of one paint ---- */

static void put_colour(dyd_sink *to, const char *name, unsigned rgb) {
  char text[] = "#rrggbb";
  snprintf(text + 1, sizeof text - 1, "%06x", rgb & 0xffffff);
  dyd_sink_text(to, " ");
  dyd_sink_text(to, name);
  dyd_sink_text(to, "=\"");
  dyd_sink_text(to, rgb == DYD_NO_COLOUR ? "none" : text);
  dyd_sink_text(to, "\"");
}

static bool same_paint(const dyd_paint *a, const dyd_paint *b) {
  return a->fill == b->fill && a->stroke == b->stroke && a->alpha == b->alpha && a->width == b->width &&
         a->on == b->on && a->off == b->off;
}

/* Ends the group of one paint, if one is open, with `end`; false: it is that of p, and stays. */
static bool canvas_group(dyd_canvas *c, const dyd_paint *p, const char *end) {
  if (c->open && p && same_paint(p, &c->shared)) return false;
  if (c->open) dyd_sink_text(&c->to, end);
  c->open = p;
  if (p) c->shared = *p;
  return true;
}

static void close_group(dyd_canvas *c) {
  canvas_group(c, NULL, "</g>\n");
}

static void open_group(dyd_canvas *c, const dyd_paint *p) {
  if (!canvas_group(c, p, "</g>\n")) return;
  dyd_sink_text(&c->to, "<g");
  put_colour(&c->to, "fill", p->fill);
  if (p->fill != DYD_NO_COLOUR && p->alpha < 1) put_attribute(&c->to, "fill-opacity", p->alpha);
  if (p->stroke != DYD_NO_COLOUR) {
    put_colour(&c->to, "stroke", p->stroke);
    put_attribute(&c->to, "stroke-width", p->width);
    if (p->off > 0) {
      put_lengths(&c->to, " stroke-dasharray=\"", (const double[]){p->on, p->off}, 2);
      dyd_sink_text(&c->to, "\"");
    }
  }
  dyd_sink_text(&c->to, ">\n");
}

/* ---- svg: the page ---- */

/* Points where a width was given, else pixels. */
static void put_extent(dyd_canvas *c, const char *before, double x) {
  put_lengths(&c->to, before, (const double[]){x * c->scale}, 1);
  dyd_sink_text(&c->to, c->scale == 1 ? "\"" : "pt\"");
}

static void svg_begin(dyd_canvas *c, const char *title) {
  const double *b = c->box, view[4] = {b[0], b[2], b[1] - b[0], b[3] - b[2]};
  dyd_sink_text(&c->to, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"");
  put_extent(c, " width=\"", view[2]);
  put_extent(c, " height=\"", view[3]);
  put_lengths(&c->to, " viewBox=\"", view, 4);
  dyd_sink_text(&c->to, "\" font-family=\"");
  put_escaped(&c->to, c->font ? c->font : "sans-serif");
  dyd_sink_text(&c->to, "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>");
  put_escaped(&c->to, title);
  dyd_sink_text(&c->to, "</title>\n");
}

static void svg_end(dyd_canvas *c) {
  close_group(c);
  dyd_sink_text(&c->to, "</svg>\n");
}

static void svg_paint(dyd_canvas *c, const dyd_paint *paint) {
  if (c->count == 0) return;
  open_group(c, paint);
  dyd_sink_text(&c->to, "<path");
  if (c->id[0]) {
    dyd_sink_text(&c->to, " id=\"");
    dyd_sink_text(&c->to, c->id);
    dyd_sink_text(&c->to, "\"");
  }
  put_path(c);
  if (!c->title[0]) {
    dyd_sink_text(&c->to, "/>\n");
    return;
  }
  dyd_sink_text(&c->to, "><title>");
  put_escaped(&c->to, c->title);
  dyd_sink_text(&c->to, "</title></path>\n");
}

static void svg_clip(dyd_canvas *c) {
  close_group(c);
  dyd_sink_text(&c->to, "<clipPath id=\"clip");
  dyd_sink_index(&c->to, ++c->clips);
  dyd_sink_text(&c->to, "\"><path");
  put_path(c);
  dyd_sink_text(&c->to, "/></clipPath>\n<g clip-path=\"url(#clip");
  dyd_sink_index(&c->to, c->clips);
  dyd_sink_text(&c->to, ")\">\n");
}

static void svg_unclip(dyd_canvas *c) {
  close_group(c);
  dyd_sink_text(&c->to, "</g>\n");
}

static void svg_text(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text) {
  close_group(c);
  dyd_sink_text(&c->to, "<text");
  put_attribute(&c->to, "x", x);
  put_attribute(&c->to, "y", y);
  put_attribute(&c->to, "font-size", size);
  if (align > 0) dyd_sink_text(&c->to, align < 1 ? " text-anchor=\"middle\"" : " text-anchor=\"end\"");
  if (halo) dyd_sink_text(&c->to, " stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"");
  dyd_sink_text(&c->to, ">");
  put_escaped(&c->to, text);
  dyd_sink_text(&c->to, "</text>\n");
}

/* ---- TikZ ---- */

#define FAR 2000.0 /* from the page, in lengths of it: a page and its surroundings */
#define FLAT 0.02  /* lines are so near to curves */
#define DEGREES (180 / 3.14159265358979323846)

static const char end_scope[] = "\\end{scope}\n";

/* "(x,y)" behind `before`. */
static void tikz_at(dyd_sink *to, const char *before, const double *z) {
  dyd_sink_text(to, before);
  put_list(to, "(", z, 2, ",");
  dyd_sink_text(to, ")");
}

/* ---- paths that go far ---- */

static void box_beyond(double box[4], const dyd_canvas *c) {
  for (int k = 0; k < 4; k++) box[k] = c->box[k] + (k & 1 ? FAR : -FAR);
}

static bool goes_far(const dyd_canvas *c) {
  double box[4];
  box_beyond(box, c);
  for (size_t k = 0; k < c->count; k++) {
    const dyd_path_step *s = &c->step[k];
    int n = s->kind == DYD_STROKE_CLOSE ? 0 : s->kind == DYD_STROKE_CURVE ? 6 : 2;
    for (int a = 0; a < n; a++)
      if (!(box[2 * (a & 1)] <= s->z[a] && s->z[a] <= box[2 * (a & 1) + 1])) return true;
    if (s->kind == DYD_STROKE_ARC && !(s->z[2] < FAR)) return true;
  }
  return false;
}

/* A path without curves; closed when its last step says so. */
typedef struct tikz_line {
  dyd_canvas *c;
  double (*z)[2];
  size_t count, cap;
} tikz_line;

static void line_add(tikz_line *l, double x, double y) {
  if (!DYD_GROW(l->z, l->cap, l->count + 1))
    l->c->failed = true;
  else
    l->z[l->count][0] = x, l->z[l->count++][1] = y;
}

/* The part of an arc between two angles, but its begin: finer where it may be seen. */
static void line_arc(tikz_line *l, const double *z, double from, double to) {
  const double *b = l->c->box, middle = from / 2 + to / 2, half = (to - from) / 2;
  double x = z[0] + z[2] * cos(middle), y = z[1] + z[2] * sin(middle);
  double away = fmax(fmax(b[0] - x, x - b[1]), fmax(b[2] - y, y - b[3]));
  if (half > 1e-9 && (half > 1 || (z[2] * half * half > 2 * FLAT && away < FAR + z[2] * half))) {
    line_arc(l, z, from, middle);
    line_arc(l, z, middle, to);
  } else
    line_add(l, z[0] + z[2] * cos(to), z[1] + z[2] * sin(to));
}

static void line_curve(tikz_line *l, const double *z) {
  double from[2], bend = 0;
  if (!l->count) return;
  memcpy(from, l->z[l->count - 1], sizeof from);
  for (int a = 0; a < 2; a++)
    bend = fmax(bend, fmax(fabs(from[a] - 2 * z[a] + z[2 + a]), fabs(z[a] - 2 * z[2 + a] + z[4 + a])));
  const int steps = 1 + (int)sqrt(fmin(bend / FLAT, 1e6)); /* the second derivative is at most 6 bends in x and in y */
  for (int k = 1; k <= steps; k++) {
    double t = (double)k / steps, u = 1 - t, p[2];
    for (int a = 0; a < 2; a++)
      p[a] = u * u * u * from[a] + 3 * u * u * t * z[a] + 3 * u * t * t * z[2 + a] + t * t * t * z[4 + a];
    line_add(l, p[0], p[1]);
  }
}

/* Cuts to a side of the box. */
static void line_cut(tikz_line *l, bool closed, int axis, double side, bool above) {
  tikz_line kept = {.c = l->c};
  for (size_t k = 0; k < l->count; k++) {
    const double *p = l->z[k], *before = k ? l->z[k - 1] : closed ? l->z[l->count - 1] : p;
    double a = above ? before[axis] - side : side - before[axis], b = above ? p[axis] - side : side - p[axis];
    if ((a < 0) != (b < 0)) {
      double at = before[1 - axis] + a / (a - b) * (p[1 - axis] - before[1 - axis]);
      line_add(&kept, axis ? at : side, axis ? side : at);
    }
    if (b >= 0) line_add(&kept, p[0], p[1]);
  }
  free(l->z);
  *l = kept;
}

static void line_put(tikz_line *l, bool closed) {
  double box[4];
  box_beyond(box, l->c);
  for (int k = 0; k < 4; k++) line_cut(l, closed, k >> 1, box[k], !(k & 1));
  for (size_t k = 0; k < l->count; k++) tikz_at(&l->c->to, k ? " -- " : " ", l->z[k]);
  if (closed && l->count) dyd_sink_text(&l->c->to, " -- cycle");
  l->count = 0;
}

static void far_path(dyd_canvas *c) {
  tikz_line l = {.c = c};
  for (size_t k = 0; k < c->count; k++) {
    const double *z = c->step[k].z;
    switch (c->step[k].kind) {
    case DYD_STROKE_MOVE:
      line_put(&l, false);
      line_add(&l, z[0], z[1]);
      break;
    case DYD_STROKE_LINE:
      line_add(&l, z[0], z[1]);
      break;
    case DYD_STROKE_CURVE:
      line_curve(&l, z);
      break;
    case DYD_STROKE_ARC:
      line_add(&l, z[0] + z[2] * cos(z[3]), z[1] + z[2] * sin(z[3]));
      line_arc(&l, z, z[3], z[4]);
      break;
    case DYD_STROKE_CLOSE:
      line_put(&l, true);
    }
  }
  line_put(&l, false);
  free(l.z);
}

/* ---- paths ---- */

static void tikz_arc(dyd_sink *to, const double *z, bool first) {
  tikz_at(to, first ? " " : " -- ", (const double[]){z[0] + z[2] * cos(z[3]), z[1] + z[2] * sin(z[3])});
  put_list(to, " arc[start angle=", (const double[]){z[3] * DEGREES, z[4] * DEGREES}, 2, ",end angle=");
  put_list(to, ",radius=", z + 2, 1, "");
  dyd_sink_text(to, "]");
}

static void tikz_path(dyd_canvas *c) {
  dyd_sink *to = &c->to;
  if (goes_far(c)) {
    far_path(c);
    return;
  }
  for (size_t k = 0; k < c->count; k++) {
    const double *z = c->step[k].z;
    switch (c->step[k].kind) {
    case DYD_STROKE_MOVE:
    case DYD_STROKE_LINE:
      tikz_at(to, c->step[k].kind == DYD_STROKE_LINE ? " -- " : " ", z);
      break;
    case DYD_STROKE_CURVE:
      tikz_at(to, " .. controls ", z);
      tikz_at(to, " and ", z + 2);
      tikz_at(to, " .. ", z + 4);
      break;
    case DYD_STROKE_ARC:
      tikz_arc(to, z, k == 0);
      break;
    case DYD_STROKE_CLOSE:
      dyd_sink_text(to, " -- cycle");
    }
  }
}

/* ---- the page ---- */

static void tikz_colour(dyd_sink *to, const char *name, unsigned rgb) {
  char text[64];
  snprintf(text, sizeof text, ",%s={rgb,255:red,%u;green,%u;blue,%u}", name, rgb >> 16 & 255, rgb >> 8 & 255,
           rgb & 255);
  dyd_sink_text(to, text);
}

/* A length of TeX: the page is scaled by its units, which widths and sizes are not. */
static void tikz_size(dyd_canvas *c, const char *before, double x, const char *behind) {
  put_list(&c->to, before, (const double[]){x * c->scale}, 1, "");
  dyd_sink_text(&c->to, behind);
}

static void tikz_paint(dyd_canvas *c, const dyd_paint *p) {
  static const char *const word[] = {"\\path", "\\draw", "\\fill", "\\filldraw"};
  const bool fill = p->fill != DYD_NO_COLOUR, draw = p->stroke != DYD_NO_COLOUR;
  if (c->count == 0) return;
  if (canvas_group(c, p, end_scope)) {
    dyd_sink_text(&c->to, "\\begin{scope}[line cap=round");
    if (fill) tikz_colour(&c->to, "fill", p->fill);
    if (fill && p->alpha < 1) put_list(&c->to, ",fill opacity=", &p->alpha, 1, "");
    if (draw) tikz_colour(&c->to, "draw", p->stroke);
    if (draw) tikz_size(c, ",line width=", p->width, "bp");
    if (draw && p->off > 0) tikz_size(c, ",dash pattern=on ", p->on, "bp");
    if (draw && p->off > 0) tikz_size(c, " off ", p->off, "bp");
    dyd_sink_text(&c->to, "]\n");
  }
  dyd_sink_text(&c->to, word[2 * fill + draw]);
  tikz_path(c);
  dyd_sink_text(&c->to, ";\n");
}

static void tikz_clip(dyd_canvas *c) {
  canvas_group(c, NULL, end_scope);
  dyd_sink_text(&c->to, "\\begin{scope}\n\\clip");
  tikz_path(c);
  dyd_sink_text(&c->to, ";\n");
}

static void tikz_unclip(dyd_canvas *c) {
  canvas_group(c, NULL, end_scope);
  dyd_sink_text(&c->to, end_scope);
}

/* What TeX would read as its own. */
static void tikz_words(dyd_sink *to, const char *text) {
  static const char own[] = "\\{}$&#^_%~<>";
  static const char *const written[] = {"\\textbackslash{}",
                                        "\\{",
                                        "\\}",
                                        "\\$",
                                        "\\&",
                                        "\\#",
                                        "\\textasciicircum{}",
                                        "\\_",
                                        "\\%",
                                        "\\textasciitilde{}",
                                        "\\textless{}",
                                        "\\textgreater{}"};
  for (; *text; text++) {
    const char *at = strchr(own, *text);
    if (at)
      dyd_sink_text(to, written[at - own]);
    else
      dyd_sink_put(to, (unsigned char)*text < ' ' ? " " : text, 1);
  }
}

static void tikz_text(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text) {
  canvas_group(c, NULL, end_scope);
  dyd_sink_text(&c->to,
                align > 0 ? align < 1 ? "\\node[anchor=base" : "\\node[anchor=base east" : "\\node[anchor=base west");
  dyd_sink_text(&c->to, halo ? ",inner sep=0.5pt,fill=white,fill opacity=0.7,text opacity=1" : ",inner sep=0pt");
  tikz_size(c, ",font=\\fontsize{", size, "bp}");
  tikz_size(c, "{", size * 1.2, "bp}");
  if (c->font) {
    dyd_sink_text(&c->to, "\\fontfamily{");
    tikz_words(&c->to, c->font);
    dyd_sink_text(&c->to, "}");
  }
  dyd_sink_text(&c->to, "\\selectfont] at");
  tikz_at(&c->to, " ", (const double[]){x, y});
  dyd_sink_text(&c->to, " {");
  tikz_words(&c->to, text);
  dyd_sink_text(&c->to, "};\n");
}

static void tikz_begin(dyd_canvas *c, const char *title) {
  const int64_t unit = llround(c->scale * 1000000);
  char text[120];
  dyd_sink_text(&c->to, "% ");
  tikz_words(&c->to, title);
  snprintf(text, sizeof text,
           "\n\\begin{tikzpicture}[x=%" PRId64 ".%06" PRId64 "bp,y=-%" PRId64 ".%06" PRId64 "bp,line join=round]\n",
           unit / 1000000, unit % 1000000, unit / 1000000, unit % 1000000);
  dyd_sink_text(&c->to, text);
}

static void tikz_end(dyd_canvas *c) {
  canvas_group(c, NULL, end_scope);
  dyd_sink_text(&c->to, "\\end{tikzpicture}\n");
}

static const dyd_canvas_kind tikz_kind = {tikz_begin, tikz_end, tikz_paint, tikz_clip, tikz_unclip, tikz_text};

static const double full_turn = 6.283185307179586;

/* ---- the path ---- */

static void path_add(dyd_canvas *c, dyd_path_step step) {
  if (!DYD_GROW(c->step, c->cap, c->count + 1))
    c->failed = true;
  else
    c->step[c->count++] = step;
}

void dyd_canvas_move(dyd_canvas *c, double x, double y) {
  path_add(c, (dyd_path_step){DYD_STROKE_MOVE, {x, y}});
}

void dyd_canvas_line(dyd_canvas *c, double x, double y) {
  path_add(c, (dyd_path_step){c->count ? DYD_STROKE_LINE : DYD_STROKE_MOVE, {x, y}});
}

void dyd_canvas_curve(dyd_canvas *c, double x1, double y1, double x2, double y2, double x, double y) {
  path_add(c, (dyd_path_step){DYD_STROKE_CURVE, {x1, y1, x2, y2, x, y}});
}

void dyd_canvas_arc(dyd_canvas *c, double x, double y, double radius, double from, double to) {
  path_add(c, (dyd_path_step){DYD_STROKE_ARC, {x, y, radius, from, to}});
}

void dyd_canvas_close(dyd_canvas *c) {
  path_add(c, (dyd_path_step){.kind = DYD_STROKE_CLOSE});
}

void dyd_canvas_circle(dyd_canvas *c, double x, double y, double radius) {
  dyd_canvas_move(c, x + radius, y);
  dyd_canvas_arc(c, x, y, radius, 0, full_turn);
  dyd_canvas_close(c);
}

void dyd_canvas_box(dyd_canvas *c, double x, double y, double width, double height) {
  dyd_canvas_move(c, x, y);
  dyd_canvas_line(c, x + width, y);
  dyd_canvas_line(c, x + width, y + height);
  dyd_canvas_line(c, x, y + height);
  dyd_canvas_close(c);
}

/* ---- all kinds ---- */

static const dyd_canvas_kind svg_kind = {svg_begin, svg_end, svg_paint, svg_clip, svg_unclip, svg_text}, nowhere = {0};

/* Lines of a page that is made small stay thick enough to be seen. */
#define THINNEST 0.25

void dyd_canvas_paint(dyd_canvas *c, const dyd_paint *paint) {
  dyd_paint p = *paint;
  if (c->scale < 1) p.width = fmax(p.width, THINNEST / c->scale);
  if (c->kind->paint) c->kind->paint(c, &p);
  c->count = 0;
  c->id[0] = c->title[0] = 0;
}

void dyd_canvas_clip(dyd_canvas *c) {
  if (c->kind->clip) c->kind->clip(c);
  c->count = 0;
}

void dyd_canvas_unclip(dyd_canvas *c) {
  if (c->kind->unclip) c->kind->unclip(c);
}

void dyd_canvas_name(dyd_canvas *c, const char *id, const char *title) {
  snprintf(c->id, sizeof c->id, "%s", id);
  snprintf(c->title, sizeof c->title, "%s", title);
}

double dyd_canvas_width(dyd_canvas *c, double size, const char *text) {
  return dyd_cairo_width(c, size * c->text, text);
}

void dyd_canvas_text(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text) {
  if (c->kind->text) c->kind->text(c, x, y, align, size * c->text, halo, text);
  c->low = fmax(c->low, y);
}

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

void dyd_canvas_segment(dyd_canvas *c, double z[2][2]) {
  dyd_canvas_move(c, z[0][0], z[0][1]);
  dyd_canvas_line(c, z[1][0], z[1][1]);
}

void dyd_picture_line(dyd_canvas *c, double z[2][2], unsigned rgb, double width, double on, double off) {
  dyd_canvas_segment(c, z);
  dyd_picture_stroke(c, rgb, width, on, off);
}

/* ---- pages ---- */

dyd_status dyd_page_fit(dyd_page *out, const dyd_output *o, double inner, double rim) {
  enum { USUAL = 14, READABLE = 7 };
  double points = o->style.font_size, least = o->style.width / (inner + rim) * USUAL;
  *out = (dyd_page){points > 0 ? points / USUAL : 1, 1};
  if (!(o->style.width > 0)) return DYD_OK;
  if (!(points > 0)) points = fmax(least, READABLE);
  out->text = points * inner / (USUAL * o->style.width - rim * points);
  if (!(out->text > 0 && out->text <= (rim > 0 ? 12 : 60)))
    return dyd_fail(
        o->err, DYD_E_ARG,
        "a picture %g points wide has no room beside texts of %g points; take a larger width, or smaller texts",
        o->style.width, points);
  out->scale = o->style.width / (inner + rim * out->text);
  return DYD_OK;
}

static const dyd_canvas_kind *kind_of(dyd_format f) {
  if (f == DYD_FORMAT_SVG || f == DYD_FORMAT_TIKZ) return f == DYD_FORMAT_SVG ? &svg_kind : &tikz_kind;
  return f == DYD_FORMAT_PDF || f == DYD_FORMAT_PNG ? &dyd_canvas_cairo : &nowhere;
}

dyd_canvas *dyd_canvas_new(const dyd_output *o, const dyd_page *page, const double box[4], const char *title) {
  dyd_canvas *c = calloc(1, sizeof *c);
  if (!c) return NULL;
  c->format = o->format;
  c->kind = kind_of(o->format);
  c->font = o->style.font;
  c->text = page->text, c->scale = page->scale;
  memcpy(c->box, box, sizeof c->box);
  c->out = o->out;
  dyd_cairo_begin(c);
  if (c->kind->begin) {
    dyd_sink_begin(&c->to, c->out);
    c->kind->begin(c, title);
  }
  dyd_canvas_box(c, box[0], box[2], box[1] - box[0], box[3] - box[2]);
  dyd_canvas_paint(c, &(dyd_paint){0xffffff, DYD_NO_COLOUR, 1, 0, 0, 0});
  return c;
}

dyd_status dyd_canvas_end(dyd_canvas *c, dyd_status st, dyd_error *err) {
  if (!c) return DYD_E_NOMEM;
  if (c->kind->end) {
    c->kind->end(c);
    dyd_sink_flush(&c->to);
  }
  st = dyd_cairo_end(c, st, err);
  dyd_free_all(c->step, c);
  return st;
}
