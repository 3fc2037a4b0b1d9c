/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pictures as svg, pdf or png: one page, one view of the plane in a frame with coordinates, legend and scale below it.
 *
 * Positions are doubles shown to hundredths of a pixel; a picture states nothing. Statuses differ in colour (colours
 * distinct for all kinds of sight), in dash and in lightness, so that a grey copy can be read too.
 *
 * A picture is a table of layers. A row selects elements, and has their style and their entry in the legend. */
#ifndef DYD_PICTURE_PICTURE_H
#define DYD_PICTURE_PICTURE_H

#include "io/output.h"
#include "picture/canvas.h"

/* The writers of pictures. */
dyd_writer dyd_delaunay_picture, dyd_voronoi_picture, dyd_convergence_picture;
dyd_writer dyd_sphere_picture, dyd_sphere_voronoi_picture;
dyd_writer dyd_disc_picture, dyd_bisector_picture, dyd_nearest_picture, dyd_tolerance_picture, dyd_plan_picture;

/* Colours after Okabe and Ito, distinct for all kinds of sight. The page of html has them from here:
 * src/picture/html/pack.py puts DYD_RGB_TIE_AREA where its style has "{tie-area}". */
#define DYD_RGB_LEGAL 0x0072b2
#define DYD_RGB_INDETERMINATE 0xd55e00
#define DYD_RGB_TIE 0x6b6b6b
#define DYD_RGB_LEGAL_AREA 0xd3e6f2
#define DYD_RGB_INDETERMINATE_AREA 0xfbe3d1
#define DYD_RGB_TIE_AREA 0xe4e4e4
#define DYD_RGB_TRIANGLE 0xe6f0f7
#define DYD_RGB_BAND 0xe69f00 /* the undetermined part, in all pictures */
/* Blues that neighbours rarely share; light, so that grey copies show the darker band between them. */
#define DYD_RGB_CELL_0 0xdcebf5
#define DYD_RGB_CELL_1 0xe8f2e4
#define DYD_RGB_CELL_2 0xeee9f6
#define DYD_RGB_CELL_3 0xe3f3f3
/* By quarters of the ranks of a plan; of pairs that are legal already. */
#define DYD_RGB_PLAN_1 0xd55e00
#define DYD_RGB_PLAN_2 0xe69f00
#define DYD_RGB_PLAN_3 0x56b4e9
#define DYD_RGB_PLAN_4 0x004c80
#define DYD_RGB_DECIDED 0xc8c8c8

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
/* Coordinates along the frame. */
void dyd_view_axes(dyd_canvas *c, const dyd_view *v);
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

/* ---- layers ---- */

typedef struct dyd_density_levels dyd_density_levels;
typedef struct dyd_legend dyd_legend;
typedef struct dyd_picture dyd_picture;
typedef struct dyd_picture_layer dyd_picture_layer;

/* How a path is painted, in a row of a table by one of the macros below: rgb, or DYD_NO_COLOUR; the width is `lines`
 * times that of lines in the view and `points`; a dash in widths, off = 0: a full line. */
typedef struct dyd_picture_style {
  unsigned fill, stroke;
  double lines, points, on, off;
  unsigned patch;                   /* of sites: of their patch in the legend, as rectangles are translucent */
  const dyd_density_levels *levels; /* of squares; else NULL */
} dyd_picture_style;

#define DYD_STYLE_FILL(rgb) .style = {(rgb), DYD_NO_COLOUR, 0, 0, 0, 0, (rgb), NULL}
#define DYD_STYLE_LINE(rgb, lines, on, off) .style = {DYD_NO_COLOUR, (rgb), (lines), 0, (on), (off), 0, NULL}
#define DYD_STYLE_PEN(rgb, points, on, off) .style = {DYD_NO_COLOUR, (rgb), 0, (points), (on), (off), 0, NULL}
#define DYD_STYLE_SHAPE(rgb, edge, lines, points) .style = {(rgb), (edge), (lines), (points), 0, 0, (rgb), NULL}
#define DYD_STYLE_SITES(rgb, patch) .style = {(rgb), DYD_NO_COLOUR, 0, 0, 0, 0, (patch), NULL}
#define DYD_STYLE_SQUARES(levels) .style = {DYD_NO_COLOUR, DYD_NO_COLOUR, 0, 0, 0, 0, 0, (levels)}

/* How the legend shows a style. NONE: another entry explains the layer. */
typedef enum dyd_key { DYD_KEY_UNSET, DYD_KEY_NONE, DYD_KEY_LINE, DYD_KEY_PATCH, DYD_KEY_DOT, DYD_KEY_SQUARES } dyd_key;

/* Draws the elements that a layer selects. Elements with names are painted one by one, by dyd_picture_paint; the rest
 * of the path is painted at the end. A walk that draws several kinds at once has a row for each, one behind the other:
 * it is called for the first, and the others have none. */
typedef void dyd_picture_walk(dyd_picture *p, const dyd_picture_layer *l);
/* Writes the entries of a layer, if it has any now. */
typedef void dyd_picture_entry(dyd_legend *legend, const dyd_picture *p, const dyd_picture_layer *l);

struct dyd_picture_layer {
  dyd_picture_walk *walk;
  int kind; /* for the walk: which elements */
  dyd_picture_style style;
  dyd_key key;
  unsigned place;           /* in the legend, from 1 on; 0 with DYD_KEY_NONE alone */
  const char *text;         /* in the legend */
  dyd_picture_entry *entry; /* NULL: `text`, where something was drawn */
};

enum { DYD_PICTURE_LAYERS_MOST = 16 };

/* The table of a picture. row: in the order in which layers are drawn. notes: the sentences below the entries. */
typedef struct dyd_picture_table {
  const dyd_picture_layer *row;
  size_t count;
  void (*notes)(dyd_legend *legend, const dyd_picture *p);
} dyd_picture_table;

#define DYD_PICTURE_TABLE(row, notes)                                                                                  \
  { (row), sizeof(row) / sizeof *(row), (notes) }

extern const dyd_picture_table dyd_delaunay_layers, dyd_graph_layers, dyd_tolerance_layers, dyd_voronoi_layers,
    dyd_tiles_layers, dyd_plan_layers, dyd_sphere_layers, dyd_sphere_cells_layers, dyd_disc_layers, dyd_bisector_layers,
    dyd_nearest_layers;

/* Returns true if each row has a style, a key that suits it, and its words and place in the legend. */
bool dyd_picture_is_whole(const dyd_picture_table *t);

/* Lines between sites, each in the layer whose kind it has. kind: NULL: that of the pair; name: of the line that is the
 * path; NULL: none has one. */
typedef struct dyd_picture_lines {
  size_t count;
  int (*kind)(const dyd_picture *p, size_t k);
  bool (*path)(dyd_picture *p, size_t k); /* false: none of it is seen */
  void (*name)(dyd_picture *p, const dyd_picture_layer *l, size_t k);
} dyd_picture_lines;

/* A page. what: for the functions of the table. sites, pairs, lines: NULL, 0 where no layer shows them. */
struct dyd_picture {
  const dyd_picture_table *table;
  const char *title;
  const dyd_view *view;
  void *what;
  const struct dyd_sites_shown *sites;
  struct dyd_pairs_shown *pairs;
  dyd_picture_lines lines;
  /* While it is drawn: elements of each row so far; the first failure of a walk. */
  dyd_canvas *canvas;
  size_t drawn[DYD_PICTURE_LAYERS_MOST];
  dyd_status st;
};

/* The layers, cut to the frame of the view; the frame with its coordinates; and the legend below it. */
dyd_status dyd_picture_write(dyd_picture *p, const dyd_output *o);
/* Paints the path in the style of the layer, or filled with rgb instead; counts an element. */
void dyd_picture_paint(dyd_picture *p, const dyd_picture_layer *l);
void dyd_picture_tint(dyd_picture *p, const dyd_picture_layer *l, unsigned rgb);
/* Counts an element that is painted otherwise, or out of sight. */
void dyd_picture_seen(dyd_picture *p, const dyd_picture_layer *l);
static inline size_t dyd_picture_drawn(const dyd_picture *p, const dyd_picture_layer *l) {
  return p->drawn[l - p->table->row];
}

dyd_picture_walk dyd_lines_walk, dyd_frame_walk;
/* The path is the line between the middles of two sites, cut to the frame; false: nothing is left. */
bool dyd_picture_join(dyd_picture *p, const dyd_result *r, uint32_t i, uint32_t j);
/* An entry of the layer's key with this text. */
void dyd_legend_put(dyd_legend *legend, const dyd_picture_layer *l, const char *text);

/* ---- sites ---- */

/* A box on the page. */
void dyd_picture_box(dyd_canvas *c, const dyd_view *v, const double box[4]);
/* The next element is of the pair i, j of e: it has the name "pair-I-J", and `what` behind both for a title. */
void dyd_picture_name_pair(dyd_canvas *c, const dyd_engine *e, size_t i, size_t j, const char *what);
/* A rectangle, however small it is, as the path, with the name of a site. */
void dyd_picture_marked(dyd_canvas *c, const dyd_view *v, const double box[4], const dyd_engine *e, size_t site);

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

/* The plan of r. rank: of each site in it, else 0; owned. */
typedef struct dyd_plan_shown {
  const dyd_result *r;
  const dyd_survey_row *row;
  const dyd_survey_pair *pair;
  size_t rows, pairs, *rank;
} dyd_plan_shown;

enum { DYD_QUARTERS = 4 };
/* The quarter of row k of the plan, from 0. */
int dyd_plan_quarter(const dyd_plan_shown *plan, size_t k);

/* Sites that are drawn; `box` returns false for sites that are not. */
typedef struct dyd_sites_shown {
  const dyd_engine *engine; /* names them */
  size_t count;
  bool (*box)(double out[4], const void *context, size_t i);
  const void *context;
  const struct dyd_density *under; /* marks that its squares cover are omitted; NULL: none are */
  const dyd_plan_shown *plan;      /* its points are marked by their ranks, and no others are numbered; NULL: none */
} dyd_sites_shown;

/* The sites that are not duplicates and whose boxes doubles hold. */
dyd_sites_shown dyd_sites_shown_of(const dyd_delaunay *pd, const dyd_engine *e);

/* Draws the sites of the picture as they can be seen, each with the name "point-I", and its coordinates, with its
 * identifier, for a title; and their numbers where neighbours are far enough apart. The row's layer are rectangles, or
 * discs, that are large enough, the next one are dots. */
dyd_picture_walk dyd_sites_walk;
dyd_picture_entry dyd_sites_entry;

#define DYD_SITES_DOTS DYD_STYLE_FILL(0x222222)
#define DYD_SITES_LAYERS(walk, entry, rgb, patch, place)                                                               \
  {(walk), 0, DYD_STYLE_SITES(rgb, patch), DYD_KEY_PATCH, (place), "of a point", (entry)}, {                           \
    NULL, 1, DYD_SITES_DOTS, DYD_KEY_DOT, (place), "point", (entry)                                                    \
  }

/* ---- legend.c ---- */

/* Entries from left to right, then in the next line; next to the first lines a bar of round length. */
struct dyd_legend {
  dyd_canvas *canvas;
  const dyd_view *view;
  double x, y, bar; /* bar: where the bar begins */
};

void dyd_legend_begin(dyd_legend *l, dyd_canvas *c, const dyd_view *v);
/* "N points"; where a window is given, how many of them are in it. */
void dyd_points_text(char *out, size_t size, size_t inside, size_t count, bool window);
/* A sentence, on lines of its own. */
void dyd_legend_text(dyd_legend *l, const char *text);
/* Where most sites are, when they are in a small part of the view. */
void dyd_legend_crowd(dyd_legend *l, const dyd_sites_shown *m);

/* Of how many lines on a square is drawn, and how: from one line on; full squares only, as legal pairs, as ties. */
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

/* Kinds of pairs, the least known first. */
enum { DYD_KIND_TIE, DYD_KIND_OPEN, DYD_KIND_LEGAL, DYD_KINDS };

/* Pairs of a picture by kinds. dense, owned: full squares drawn with the lines, and all of the open ones instead of
 * them where they are crowded. */
typedef struct dyd_pairs_shown {
  const dyd_pair_list *list;
  const dyd_engine *engine; /* names their sites */
  size_t shown[DYD_KINDS];  /* in the frame */
  dyd_density dense[DYD_KINDS];
  bool crowded, full; /* full: full squares were drawn */
} dyd_pairs_shown;

/* Of pair k; -1: squares are drawn instead of it. */
static inline int dyd_pairs_kind(const dyd_picture *p, size_t k) {
  const dyd_pair_status status = p->pairs->list->item[k].status;
  if (status != DYD_LEGAL && status != DYD_TIE) return p->pairs->crowded ? -1 : DYD_KIND_OPEN;
  return status == DYD_LEGAL ? DYD_KIND_LEGAL : DYD_KIND_TIE;
}
void dyd_pairs_name(dyd_picture *p, const dyd_picture_layer *l, size_t k);
/* Finds out whether the open ones are crowded, once all are counted. */
void dyd_pairs_settle(dyd_pairs_shown *pairs);
dyd_picture_walk dyd_squares_walk;
dyd_picture_entry dyd_squares_entry, dyd_pairs_entry;

#endif
