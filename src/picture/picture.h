/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pictures as svg, pdf or png: one page, one view of the plane in a frame with coordinates, legend and scale below it.
 *
 * Positions are doubles shown to hundredths of a pixel; a picture states nothing. Statuses differ in colour (colours
 * distinct for all kinds of sight), in dash and in lightness, so that a grey copy can be read too. */
#ifndef DYD_PICTURE_PICTURE_H
#define DYD_PICTURE_PICTURE_H

#include "io/output.h"
#include "picture/canvas.h"

typedef void (*dyd_draw_fn)(dyd_canvas *c, void *context);

/* The writers of pictures. */
dyd_writer dyd_delaunay_picture, dyd_voronoi_picture, dyd_convergence_picture;
dyd_writer dyd_sphere_picture, dyd_sphere_voronoi_picture;
dyd_writer dyd_disc_picture, dyd_bisector_picture, dyd_nearest_picture, dyd_tolerance_picture, dyd_plan_picture;

/* Up to this count each line and triangle has a name; beyond, a file would be all names. */
enum { DYD_PICTURE_NAMES = 40000 };

/* ---- views ---- */

/* Free space around the drawing: on top and right; on the left, for the coordinates. */
#define DYD_VIEW_EDGE 30.0
#define DYD_VIEW_LEFT 90.0

/* Invariant: scale > 0; the drawing fits width x height. */
typedef struct dyd_view {
  double left, top, scale; /* data to lengths on the page */
  double width, height;    /* of the drawing */
  double apart;            /* about the distance of neighbours on the page */
  double line, dot;        /* width of lines, radius of dots */
  bool dots;               /* all sites are dots, as rectangles would be one mass */
  bool discs;              /* rectangles are drawn as the discs in them */
  double frame[4];         /* x lower, x upper, y lower, y upper on the page: the inside is shown */
  const char *unit;        /* of the coordinates, for the scale; NULL: not known */
  unsigned epsg;           /* their reference system; 0: not known */
} dyd_view;

/* "m" or "degree" for EPSG numbers in common use; NULL: the unit is not known. */
const char *dyd_unit_of(unsigned epsg);
/* A view of the box (x lower, x upper, y lower, y upper) of something whose neighbours are about `spacing` apart (0:
 * not known); DYD_E_RANGE with a message when doubles cannot scale it. */
dyd_status dyd_view_fit(dyd_view *v, const double box[4], double spacing, dyd_error *err);
/* About the median length of the possible pairs whose middle is in `box` (NULL: of all); 0 when there is none. pairs:
 * the list of them, NULL where the caller has none. */
double dyd_view_spacing(const dyd_delaunay *pd, const dyd_pair_list *pairs, const double box[4]);
/* The middle one of n lengths, which are sorted; 0: there is none. */
double dyd_view_median(double *length, size_t n);
double dyd_view_x(const dyd_view *v, double x);
double dyd_view_y(const dyd_view *v, double y);
/* The middle of a box, on the page. */
void dyd_view_middle(double z[2], const dyd_view *v, const double box[4]);
/* The view of a dyd_result: its window, or all its rectangles with a rim; pairs as above. */
dyd_status dyd_view_of(dyd_view *v, const dyd_output *o, const dyd_pair_list *pairs);
/* The line between the middles of two sites on the page, cut to the frame; false: nothing is left. */
bool dyd_view_line(double z[2][2], const dyd_view *v, const dyd_result *r, uint32_t i, uint32_t j);
/* Returns true if a box meets the frame. */
bool dyd_view_sees(const dyd_view *v, const double box[4]);
/* *box (xlo, xhi, ylo, yhi) grows to hold b. */
void dyd_view_hold(double box[4], const double b[4]);
/* Sets box to the window; DYD_E_ARG with a message where it has no area. */
dyd_status dyd_view_window(double box[4], const dyd_rect *window, dyd_error *err);
/* *box grows to hold r; DYD_E_RANGE with a message unless doubles can hold it. */
dyd_status dyd_view_grow(double box[4], const dyd_rect *r, dyd_error *err);
/* *box grows by a margin on all sides, and to the shape of a page. */
void dyd_view_pad(double box[4]);
/* A page: `inside`, cut to the frame of the view, the frame with its coordinates, and the legend below it. */
dyd_status dyd_view_write(const dyd_output *o, const dyd_view *v, const char *title, dyd_draw_fn inside,
                          dyd_draw_fn legend, void *context);
void dyd_view_frame_path(dyd_canvas *c, const dyd_view *v);
/* The greatest of 1, 2, 5 times a power of ten that is at most `most`: digit * 10^exponent. false: there is none that
 * doubles hold. */
bool dyd_round_step(int *digit, int *exponent, double most);
/* "2.5", "-300", "5e-301": n * 10^exponent exactly. */
void dyd_tick_text(char *out, size_t size, int64_t n, int exponent);

/* More vertices than any polygon has that is cut. */
enum { DYD_CLIP_MOST = 24 };
/* Cuts the segment z[0], z[1] to the box (x lower, x upper, y lower, y upper); false: nothing is left. */
bool dyd_clip_segment(double z[2][2], const double box[4]);
/* The same for a convex polygon of n <= DYD_CLIP_MOST - 4 vertices; returns how many there are then. */
int dyd_clip_convex(double z[DYD_CLIP_MOST][2], int n, const double box[4]);

/* ---- drawing ---- */

/* The undetermined part, in all pictures. */
#define DYD_PICTURE_BAND 0xe69f00

/* A box on the page. */
void dyd_picture_box(dyd_canvas *c, const dyd_view *v, const double box[4]);

/* A site as it can be seen: a rectangle, or disc, filled with rgb where it is large enough, else a dot; nothing outside
 * of the view. It has the name "point-I", and its coordinates, with its identifier, for a title. Returns the kind
 * of mark. */
typedef enum dyd_site_mark { DYD_MARK_NONE, DYD_MARK_DOT, DYD_MARK_RECTANGLE } dyd_site_mark;
/* The next element is of the pair i, j of e: it has the name "pair-I-J", and `what` behind both for a title. */
void dyd_picture_name_pair(dyd_canvas *c, const dyd_engine *e, size_t i, size_t j, const char *what);
/* A rectangle, however small it is, filled with rgb. */
void dyd_picture_marked(dyd_canvas *c, const dyd_view *v, const double box[4], const dyd_engine *e, size_t site,
                        unsigned rgb);

/* Numbers or identifiers of sites where there is room: on no rectangle, on no other number, inside of the frame. */
typedef struct dyd_numbers {
  const dyd_view *view;
  unsigned char *taken; /* squares of the page */
  size_t columns, rows;
} dyd_numbers;

/* false: memory is exhausted. */
bool dyd_numbers_init(dyd_numbers *l, const dyd_view *v);
void dyd_numbers_clear(dyd_numbers *l);
/* Keeps numbers off this box, or the dot drawn for it. */
void dyd_numbers_keep_off(dyd_numbers *l, const double box[4]);
/* Writes what a site of e is called beside its box, if there is room. */
void dyd_numbers_put(dyd_numbers *l, dyd_canvas *c, const double box[4], double size, const dyd_engine *e, size_t site);

/* The points of a plan. rank: of each site in it, else 0; rgb: of each site; both owned. */
typedef struct dyd_plan_marks {
  const dyd_survey_row *row;
  size_t rows, *rank;
  unsigned *rgb;
} dyd_plan_marks;

/* Sites that are drawn; `box` returns false for sites that are not. */
typedef struct dyd_site_marks {
  const dyd_engine *engine; /* names them */
  size_t count;
  bool (*box)(double out[4], const void *context, size_t i);
  const void *context;
  unsigned rgb;                       /* of rectangles */
  const struct dyd_density *under;    /* marks that its squares cover are omitted; NULL: none are */
  const dyd_plan_marks *plan;         /* its points are marked by their ranks, and no others are numbered; NULL: none */
  bool drawn[DYD_MARK_RECTANGLE + 1]; /* which marks were */
} dyd_site_marks;

/* The sites that are not duplicates and whose boxes doubles hold. */
dyd_site_marks dyd_site_marks_of(const dyd_delaunay *pd, const dyd_engine *e, unsigned rgb);
/* All of them, with their numbers where neighbours are far enough apart. */
void dyd_site_marks_draw(dyd_site_marks *m, dyd_canvas *c, const dyd_view *v);

/* ---- legend.c ---- */

/* Entries from left to right, then in the next line; next to the first lines a bar of round length. */
typedef struct dyd_legend {
  dyd_canvas *canvas;
  const dyd_view *view;
  double x, y, bar; /* bar: where the bar begins */
} dyd_legend;

void dyd_legend_begin(dyd_legend *l, dyd_canvas *c, const dyd_view *v);
/* A line, a patch, a dot and its meaning. */
void dyd_legend_line(dyd_legend *l, unsigned rgb, double on, double off, const char *text);
void dyd_legend_patch(dyd_legend *l, unsigned rgb, const char *text);
void dyd_legend_dot(dyd_legend *l, unsigned fill, unsigned edge, const char *text);
/* Of the rectangles, or discs, and dots that were drawn. */
void dyd_legend_marks(dyd_legend *l, const dyd_site_marks *m, unsigned rgb);
/* "N points"; where a window is given, how many of them are in it. */
void dyd_points_text(char *out, size_t size, size_t inside, size_t count, bool window);
/* A sentence, on lines of its own. */
void dyd_legend_text(dyd_legend *l, const char *text);
/* Where most sites are, when they are in a small part of the view. */
void dyd_legend_crowd(dyd_legend *l, const dyd_site_marks *m);

/* Of how many lines on a square is drawn, and how: from one line on; full squares only, as legal pairs, as ties. */
typedef struct dyd_density_levels dyd_density_levels;
extern const dyd_density_levels dyd_density_all, dyd_density_full, dyd_density_full_grey;

/* How many lines cross each small square of the frame. */
typedef struct dyd_density {
  const dyd_view *view;
  const dyd_density_levels *levels;
  uint32_t *count;            /* NULL: nothing is counted, and no square is drawn */
  size_t columns, rows, last; /* last: the square that the line at hand is in */
} dyd_density;

/* false: memory is exhausted. */
bool dyd_density_init(dyd_density *d, const dyd_view *v, const dyd_density_levels *levels);
void dyd_density_clear(dyd_density *d);
/* A line begins. */
void dyd_density_begin(dyd_density *d);
/* The next part of it, on the page. */
void dyd_density_add(dyd_density *d, double z[2][2]);
/* Returns true if the lines would be seen as a mass. */
bool dyd_density_is_crowded(const dyd_density *d);
/* Returns true if all that the frame shows of a box is on the page (x lower, x upper, y lower, y upper) in squares that
 * are drawn. May say no of a large box. */
bool dyd_density_covers(const dyd_density *d, const double box[4]);
/* Squares that are drawn of `under` (NULL: of none), too, are shared by both. false: there were none. */
bool dyd_density_draw(dyd_canvas *c, const dyd_density *d, const dyd_density *under);
/* what: behind the first number, " lines of a kind in a square". */
void dyd_density_legend(dyd_legend *l, const dyd_density *d, const char *what);

#endif
