/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the writers of the Voronoi diagram share: cells, vertices, edges on a window. */
#ifndef DYD_IO_DIAGRAM_H
#define DYD_IO_DIAGRAM_H

#include "io/decimal.h"
#include "io/output.h"
#include "metric/bounds.h"

/* ---- certain edges: one for each legal pair, between vertices of certain triangles and of ties ---- */

typedef enum dyd_dual_kind {
  DYD_DUAL_OPEN = 0, /* ends in the region of an undecided face */
  DYD_DUAL_VERTEX,   /* at the vertex of a certain triangle, or of a tied face */
  DYD_DUAL_RAY       /* unbounded, for every choice; beyond a tied chain, for the true points */
} dyd_dual_kind;

typedef struct dyd_dual_end {
  dyd_dual_kind kind;
  size_t vertex;       /* number of the triangle; of a tied face: beyond the triangles */
  double direction[4]; /* of a ray: bounds of both components of a vector along it, rounded outward */
} dyd_dual_end;

/* end[0] is on the left of the way from i to j, end[1] on its right. */
typedef struct dyd_dual_edge {
  uint32_t i, j;
  dyd_dual_end end[2];
} dyd_dual_edge;

/* Position of the face in the ascending list of tied faces; NULL: it is not tied. */
const size_t *dyd_dual_tied(const size_t *tied, size_t ties, size_t face);

/* ---- the diagram ---- */

/* One cell: bounds of its areas in W and the box of Pos_i n W, all rounded outward. Invariant: present = Pos_i may meet
 * W; exact = the polygon is the whole cell, but for the rounding of its vertices. */
typedef struct dyd_cell_row {
  double area[2], box[4];
  bool present, exact;
  double rounding; /* of the vertices of an exact one, in each coordinate; else 0 */
} dyd_cell_row;

/* The undetermined share of the possible cell, rounded up. */
double dyd_cell_undetermined(const dyd_cell_row *row);

/* All borrowed but the window and the lists. */
typedef struct dyd_diagram {
  FILE *out;
  const dyd_engine *engine;
  const dyd_delaunay *pd;
  const dyd_sites *sites;
  const dyd_pair_list *discs; /* statuses of discs, whose cells are written; NULL: those of rectangles */
  size_t count;
  dyd_rect window;
  const dyd_area *clip_to;    /* of tiles; NULL: the window */
  unsigned epsg;              /* the reference system of the coordinates; 0: not known */
  const dyd_history *history; /* of the run; NULL: not known */
  int64_t bits;               /* polygons are within 2^-bits of their cells */
  dyd_triangle_list triangles;
  size_t *tied, ties;         /* undecided faces whose sites are on one circle */
  double (*vertex)[4];        /* enclosures of the Voronoi vertices of both; infinite ends: not known in doubles */
  int64_t vertex_bits;        /* precision of exact enclosures */
  dyd_voronoi_bounds *bounds; /* found when the cells are visited */
  const volatile int *cancel; /* see dyd_write_options; NULL: never */
  dyd_memory *memory;         /* memory that max_bytes leaves for the diagram */
  size_t *cut;                /* the cells and regions that it cut, counted when they are visited */
  size_t *coincident;         /* receives how many sites have no tile of their own; NULL: not asked for */
} dyd_diagram;

/* Makes everything but the bounds; triangles and their vertices only if `vertices`. o->bounds and o->cut are there;
 * room is borrowed as long as *d is used. Of to->engine there has to be a result that is not capped. Fills *err on
 * failure; the caller calls dyd_diagram_clear in any case. */
dyd_status dyd_diagram_init(dyd_diagram *d, const dyd_output *to, const dyd_write_options *o, bool vertices,
                            dyd_memory *memory, dyd_error *err);
void dyd_diagram_clear(dyd_diagram *d);

/* Called in order for every site but aliases. */
typedef dyd_status (*dyd_cell_visit)(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row);
/* Makes the polygons of all cells once, shows them to `visit`, and finds the bounds. Once *d->cancel is set, cells and
 * regions are the whole window. */
dyd_status dyd_diagram_visit(const dyd_diagram *d, dyd_cell_visit visit, void *context);

/* Fills *out, which is empty before, with the polygons of all cells; finds the bounds. On failure the caller clears it.
 */
dyd_status dyd_diagram_cells(dyd_cells *out, const dyd_diagram *d);

/* Fills *out, which is empty before; needs vertices. On failure the caller clears it. */
dyd_status dyd_diagram_frame(dyd_frame *out, const dyd_diagram *d);

/* The tiles; sets the bounds, too. areas_only as in dyd_tiles_find. Fills *err where doubles are too coarse. */
dyd_status dyd_diagram_tiles(dyd_tiles *out, const dyd_diagram *d, bool areas_only, dyd_error *err);
/* Moves *end, the first ring, behind the rings that make one row: one, or all of a site that is cut. Returns their
 * area, rounded up. */
double dyd_diagram_tile(size_t *end, const dyd_diagram *d, const dyd_tiles *tiles);

/* Called for every undecided face in order, with the box of its vertices in the window, rounded outward; NULL: there
 * are none. */
typedef dyd_status (*dyd_region_visit)(void *context, size_t face, const double box[4]);
dyd_status dyd_diagram_regions(const dyd_diagram *d, dyd_region_visit visit, void *context);

/* The sure edges: of pairs that are legal for the discs, if there are such; *out is new, sorted by i and j; release
 * with free(). DYD_E_NOMEM, too, when d->room has none. */
dyd_status dyd_diagram_edges(dyd_dual_edge **out, size_t *count, const dyd_diagram *d);

/* Vertices: of sure triangles, then of tied faces. */
static inline size_t dyd_diagram_vertices(const dyd_diagram *d) {
  return d->triangles.count + d->ties;
}
/* The sites of vertex k; owned by the caller. */
dyd_status dyd_diagram_vertex_sites(dyd_index_list *out, const dyd_diagram *d, size_t k);
/* Returns true if vertex k can be drawn, and may be in the window. The vertex may be outside, so its enclosure is never
 * cut. */
bool dyd_diagram_vertex_in_window(const dyd_diagram *d, size_t k);
/* The exact enclosure of vertex k as four texts: x lower, x upper, y lower, y upper; release each with free(). */
dyd_status dyd_diagram_vertex(char *text[4], const dyd_diagram *d, size_t k);

bool dyd_box_is_finite(const double b[4]);
/* The boxes that hold both ends of an edge: of its vertex, or of a place as far out on its ray as the window is large.
 * false: an end is not known. */
bool dyd_diagram_edge(double box[2][4], const dyd_diagram *d, const dyd_dual_edge *e);

#endif
