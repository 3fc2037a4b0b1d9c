/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* TikZ: a tikzpicture that \input reads, without any package but TikZ; texts are in the document's font.
 *
 * TeX holds lengths up to 16383 points. So a path that goes farther is cut to a box far outside of the page, its curves
 * and arcs made lines first. The box is convex, so filled areas stay as they were inside; lines along its rim are not
 * seen. */
#include "base/alloc.h"
#include "picture/canvas.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define FAR 2000.0 /* from the page, in lengths of it: a page and its surroundings */
#define FLAT 0.02  /* lines are so near to curves */
#define DEGREES (180 / 3.14159265358979323846)

static const char end_scope[] = "\\end{scope}\n";

/* "(x,y)" behind `before`. */
static void tikz_at(dyd_sink *to, const char *before, const double *z) {
  dyd_sink_text(to, before);
  dyd_put_lengths(to, "(", z, 2, ",");
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
  dyd_put_lengths(to, " arc[start angle=", (const double[]){z[3] * DEGREES, z[4] * DEGREES}, 2, ",end angle=");
  dyd_put_lengths(to, ",radius=", z + 2, 1, "");
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
  dyd_put_lengths(&c->to, before, (const double[]){x * c->scale}, 1, "");
  dyd_sink_text(&c->to, behind);
}

static void tikz_paint(dyd_canvas *c, const dyd_paint *p) {
  static const char *const word[] = {"\\path", "\\draw", "\\fill", "\\filldraw"};
  const bool fill = p->fill != DYD_NO_COLOUR, draw = p->stroke != DYD_NO_COLOUR;
  if (c->count == 0) return;
  if (dyd_canvas_group(c, p, end_scope)) {
    dyd_sink_text(&c->to, "\\begin{scope}[line cap=round");
    if (fill) tikz_colour(&c->to, "fill", p->fill);
    if (fill && p->alpha < 1) dyd_put_lengths(&c->to, ",fill opacity=", &p->alpha, 1, "");
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
  dyd_canvas_group(c, NULL, end_scope);
  dyd_sink_text(&c->to, "\\begin{scope}\n\\clip");
  tikz_path(c);
  dyd_sink_text(&c->to, ";\n");
}

static void tikz_unclip(dyd_canvas *c) {
  dyd_canvas_group(c, NULL, end_scope);
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
  dyd_canvas_group(c, NULL, end_scope);
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
  dyd_canvas_group(c, NULL, end_scope);
  dyd_sink_text(&c->to, "\\end{tikzpicture}\n");
}

const dyd_canvas_kind dyd_canvas_tikz = {tikz_begin, tikz_end, tikz_paint, tikz_clip, tikz_unclip, tikz_text};
