/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pictures drawn with cairo, as svg, pdf or png: one page, one view of the plane, legend and scale below it.
 *
 * Positions are doubles shown to hundredths of a point; a picture states nothing. Statuses differ in colour (colours
 * that all kinds of sight tell apart), in dash and in lightness, so that a grey copy can be read too. */
#ifndef DYD_PICTURE_PICTURE_H
#define DYD_PICTURE_PICTURE_H

#include "io/output.h"
#include <cairo.h>

typedef void (*dyd_draw_fn)(cairo_t *cr, void *context);
/* Writes a page of width x height points (two pixels a point in png) in the format of o: svg, pdf or png. */
dyd_status dyd_page_write(const dyd_output *o, double width, double height, dyd_draw_fn draw, void *context);

/* The writers of pictures, which differ by what they show. */
dyd_writer dyd_delaunay_picture, dyd_voronoi_picture, dyd_convergence_picture;
dyd_writer dyd_disc_picture, dyd_bisector_picture, dyd_nearest_picture;

/* ---- views ---- */

/* Free space around the drawing, in points. */
#define DYD_VIEW_EDGE 30.0

/* Invariant: scale > 0; the drawing fits width x height. */
typedef struct dyd_view {
  double left, top, scale; /* data to points on the page */
  double width, height;    /* of the drawing */
  double line, dot;        /* width of lines, radius of dots */
  double frame[4];         /* x lower, x upper, y lower, y upper on the page: shown is what is inside; infinite: all */
} dyd_view;

/* A view of the box (x lower, x upper, y lower, y upper) of something whose neighbours are about `spacing` apart (0:
 * not known); DYD_E_RANGE with a message when doubles cannot scale it. */
dyd_status dyd_view_fit(dyd_view *v, const double box[4], double spacing, dyd_error *err);
/* About the median length of the possible pairs whose middle is in `box` (NULL: of all); 0 when there is none. */
double dyd_view_spacing(const dyd_delaunay *pd, const double box[4]);
double dyd_view_x(const dyd_view *v, double x);
double dyd_view_y(const dyd_view *v, double y);
/* The middle of a box, on the page. */
void dyd_view_middle(double z[2], const dyd_view *v, const double box[4]);
/* *box (xlo, xhi, ylo, yhi) grows to hold r; DYD_E_RANGE with a message unless doubles can hold it. */
dyd_status dyd_view_grow(double box[4], const dyd_rect *r, dyd_error *err);
/* *box grows by a margin on all sides, and to the shape of a page. */
void dyd_view_pad(double box[4]);
/* The baseline of the legend. */
double dyd_view_legend(const dyd_view *v);
/* A page: `inside`, cut to the frame of the view, the frame, and the legend below it. */
dyd_status dyd_view_write(const dyd_output *o, const dyd_view *v, dyd_draw_fn inside, dyd_draw_fn legend,
                          void *context);
void dyd_view_frame_path(cairo_t *cr, const dyd_view *v);

/* ---- clipping ---- */

/* More vertices than any polygon has that is cut. */
enum { DYD_CLIP_MOST = 24 };
/* Cuts the segment z[0], z[1] to the box (x lower, x upper, y lower, y upper); false: nothing is left. */
bool dyd_clip_segment(double z[2][2], const double box[4]);
/* The same for a convex polygon of n <= DYD_CLIP_MOST - 4 vertices; returns how many there are then. */
int dyd_clip_convex(double z[DYD_CLIP_MOST][2], int n, const double box[4]);

/* ---- drawing ---- */

/* What is undetermined, in all pictures. */
#define DYD_PICTURE_BAND 0xe69f00
/* Lines of the legend below the first one. */
#define DYD_PICTURE_ROW 22

/* Paints the page white, sets font and line style. */
void dyd_picture_begin(cairo_t *cr);
/* align 0: from x on, 0.5: around x, 1: up to x. */
void dyd_picture_text(cairo_t *cr, double x, double y, double align, double size, const char *text);
void dyd_picture_colour(cairo_t *cr, unsigned rgb);
/* Dash in line widths; off = 0: full. */
void dyd_picture_pen(cairo_t *cr, unsigned rgb, double width, double on, double off);
/* The path so far, which is gone then. */
void dyd_picture_stroke(cairo_t *cr, unsigned rgb, double width, double on, double off);
void dyd_picture_fill(cairo_t *cr, unsigned rgb);
/* A rectangle filled with rgb where it is large enough, else a dot; nothing outside of the view. */
void dyd_picture_site(cairo_t *cr, const dyd_view *v, const double box[4], bool fixed_point, unsigned rgb);
/* A rectangle, however small it is, filled with rgb; and its number beside it. */
void dyd_picture_marked(cairo_t *cr, const dyd_view *v, const double box[4], unsigned rgb);
void dyd_picture_numbered(cairo_t *cr, const dyd_view *v, const double box[4], unsigned rgb, size_t number);
/* Leaves the pen black, for text. */
void dyd_picture_dot(cairo_t *cr, double x, double y, double radius, unsigned fill, unsigned edge);
/* One entry of a legend: a line (fill = 0) or a patch; moves *x behind it. */
void dyd_picture_entry(cairo_t *cr, double *x, double y, unsigned rgb, bool fill, double on, double off,
                       const char *text);
/* A bar of round length, at the right end of the legend. */
void dyd_picture_scale(cairo_t *cr, const dyd_view *v, double y);

#endif
