/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What pictures are drawn on: paths, text, clips and names, as svg or TikZ of our own or with cairo (pdf, png).
 *
 * Lengths in pixels of svg (points of pdf, half pixels of png), y downward; a page of a given width is scaled. A path
 * is collected, and gone when it is painted. In svg and TikZ text is text, and neighbours of the same paint share a
 * group. In svg elements can have an id and a title, which viewers show where the pointer is; other formats ignore
 * names. */
#ifndef DYD_PICTURE_CANVAS_H
#define DYD_PICTURE_CANVAS_H

#include "io/output.h"
#include "io/sink.h"

typedef struct dyd_canvas dyd_canvas;

/* false: the library was built without cairo. Then there are neither pdf nor png, and widths of texts in svg are
 * estimates. */
bool dyd_cairo_is_there(void);

/* Neither colour of a paint. */
#define DYD_NO_COLOUR 0x1000000u

/* rgb, or DYD_NO_COLOUR; dash in lengths, off = 0: a full line. alpha: of the filling. */
typedef struct dyd_paint {
  unsigned fill, stroke;
  double alpha, width, on, off;
} dyd_paint;

/* How large a page is: texts are `text` times as large as usual in relation to the drawing, and everything is scaled.
 */
typedef struct dyd_page {
  double text, scale;
} dyd_page;
/* Of a page as wide as inner + rim * text, by the look of o. DYD_E_ARG with a message where texts take all of it. */
dyd_status dyd_page_fit(dyd_page *out, const dyd_output *o, double inner, double rim);

/* Begins a page in the format of o, white, for the box x lower, x upper, y lower, y upper. NULL when
 * memory is exhausted. A format that is none of pictures draws nothing, but knows how wide texts are. */
dyd_canvas *dyd_canvas_new(const dyd_output *o, const dyd_page *page, const double box[4], const char *title);
/* Completes the page (unless st is an error) and frees c; returns st, or the error of writing. */
dyd_status dyd_canvas_end(dyd_canvas *c, dyd_status st, dyd_error *err);

/* ---- the path ---- */

void dyd_canvas_move(dyd_canvas *c, double x, double y);
/* Moves where there is no path yet. */
void dyd_canvas_line(dyd_canvas *c, double x, double y);
void dyd_canvas_segment(dyd_canvas *c, double z[2][2]);
void dyd_canvas_curve(dyd_canvas *c, double x1, double y1, double x2, double y2, double x, double y);
/* A line to the first end, if there is a path, then clockwise on the page from angle `from` to `to`, radians. */
void dyd_canvas_arc(dyd_canvas *c, double x, double y, double radius, double from, double to);
void dyd_canvas_close(dyd_canvas *c);
void dyd_canvas_circle(dyd_canvas *c, double x, double y, double radius);
void dyd_canvas_box(dyd_canvas *c, double x, double y, double width, double height);

/* ---- what becomes of it ---- */

void dyd_canvas_paint(dyd_canvas *c, const dyd_paint *paint);
/* The path so far, which is gone then. Dash in line widths; off = 0: full. */
void dyd_picture_stroke(dyd_canvas *c, unsigned rgb, double width, double on, double off);
void dyd_picture_fill(dyd_canvas *c, unsigned rgb);
/* Filled, with an edge of half the lightness. */
void dyd_picture_shape(dyd_canvas *c, unsigned fill, double alpha, unsigned edge, double width);
/* A line of an edge. */
void dyd_picture_line(dyd_canvas *c, double z[2][2], unsigned rgb, double width, double on, double off);
/* Until dyd_canvas_unclip only the inside of the path is shown; clips nest. */
void dyd_canvas_clip(dyd_canvas *c);
void dyd_canvas_unclip(dyd_canvas *c);
/* The next element painted has this id (unique on the page) and this title. Both are copied. */
void dyd_canvas_name(dyd_canvas *c, const char *id, const char *title);

/* ---- text ---- */

double dyd_canvas_width(dyd_canvas *c, double size, const char *text);
/* align 0: from x on, 0.5: around x, 1: up to x. halo: a white edge, so that it is read on anything. */
void dyd_canvas_text(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text);

/* ---- a canvas from inside: its path, and what cairo does ---- */

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

/* What a format does with a page. `begin` comes first, `end` last; without them there is nothing to do. */
typedef struct dyd_canvas_kind {
  void (*begin)(dyd_canvas *c, const char *title);
  void (*end)(dyd_canvas *c);
  void (*paint)(dyd_canvas *c, const dyd_paint *p);
  void (*clip)(dyd_canvas *c);
  void (*unclip)(dyd_canvas *c);
  void (*text)(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text);
} dyd_canvas_kind;

struct dyd_canvas {
  dyd_format format;
  const dyd_canvas_kind *kind;
  const char *font; /* NULL: sans-serif */
  double text, scale, box[4];
  double low; /* the greatest y of a text */
  FILE *out;
  dyd_sink to;       /* of svg and TikZ: to it */
  int error;         /* errno of the first write that failed, else 0 */
  struct _cairo *cr; /* of svg and TikZ: to measure texts; NULL without cairo */
  dyd_path_step *step;
  size_t count, cap;
  bool failed; /* memory ran out */
  bool open;   /* a group with the paint `shared` */
  dyd_paint shared;
  unsigned clips; /* svg: how many there are */
  char id[80], title[160];
};

/* ---- canvas_cairo.c; canvas_plain.c where the library was built without it ---- */

extern const dyd_canvas_kind dyd_canvas_cairo;
void dyd_cairo_begin(dyd_canvas *c);
/* Finishes the page and writes it; returns st, or the error of writing. */
dyd_status dyd_cairo_end(dyd_canvas *c, dyd_status st, dyd_error *err);
double dyd_cairo_width(dyd_canvas *c, double size, const char *text);

#endif
