/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows over cells: polygons of all cells and both bounds of the diagram on the unit square; cells of thin boxes, cells
 * near (boxes of three hundredths of the spacing), apart (boxes of a tenth of the spacing), cells touch (lightly: of
 * three tenths), cells gps (squares of a receiver, many of which overlap), cells grid (squares of two tenths on a grid,
 * and their surroundings). Time a site; nobody else computes these. discs: statuses of the discs in those squares,
 * beside their triangulation. tiles: polygons of exact points, beside their triangulation; tiles-grid: of a square
 * grid; diagram: both together, beside CGAL; clip: tiles cut to a border.
 */
#include "answers.h"
#include "cloud.h"
#include "harness.h"
#include "ours.h"
#include "peer.h"

#include <dyadel/metric.h>
#include <dyadel/tolerance.h>
#include <math.h>
#include <stdlib.h>

static const bench_series no_peer;

/* area, distance: both bounds, up to rounding, times 10^9. */
typedef struct cells_answer {
  size_t area, distance;
  char remark[200];
} cells_answer;

/* One run on a triangulation that is there. The whole square is undetermined at most, and something is wherever boxes
 * have an extent. */
static bench_cost cells_run(cells_answer *answer, const char *row, const dyd_delaunay *pd, double low, double high) {
  dyd_rect window;
  double side = high - low;
  dyd_voronoi_bounds b;
  dyd_rect_init(&window);
  dyd_voronoi_bounds_init(&b);
  bench_need(row, dyd_rect_set_d(&window, low, high, low, high), NULL);
  bench_meter meter = bench_start();
  bench_need(row, dyd_metric_voronoi(&b, pd, &window, dyd_metric_coarseness(pd, &window) + 4, NULL), NULL);
  bench_cost cost = bench_stop(&meter);
  double area = dyd_dyadic_get_d(&b.area, DYD_UP) / (side * side);
  double distance = dyd_dyadic_get_d(&b.hausdorff, DYD_UP) / side;
  if (!b.finite || !(area > 0 && area <= 1 && distance > 0 && distance < 1)) bench_die(row, "the bounds are wrong");
  answer->area = (size_t)llround(area * 1e9);
  answer->distance = (size_t)llround(distance * 1e9);
  snprintf(answer->remark, sizeof answer->remark, "undetermined area %.9g; distance %.9g", area, distance);
  dyd_voronoi_bounds_clear(&b);
  dyd_rect_clear(&window);
  return cost;
}

/* Boxes of half-width share / sqrt(n) in the unit square; share 0: the squares of a receiver, -1: of half-width 0.2 on
 * a square grid, in a window twice as wide. goal: microseconds a site. */
static void row_cells(const bench_options *o, const char *name, size_t n, double share, double goal) {
  cloud boxes;
  bool grid = share < 0;
  bench_series ours = {0};
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  cells_answer answer = {0};
  if (!bench_wants(o, name)) return;
  (grid ? cloud_grid : share > 0 ? cloud_uniform : cloud_gps)(&boxes, bench_size(o, n));
  if (share != 0) cloud_widen(&boxes, grid ? 0.2 : share / sqrt((double)boxes.n));
  double side = share > 0 ? 1 : sqrt((double)boxes.n), margin = grid ? side / 2 : 0;
  bench_need(name, dyd_sites_new(&sites), NULL);
  bench_need(name, dyd_sites_add_boxes(sites, boxes.n, boxes.x0, boxes.x1, boxes.y0, boxes.y1), NULL);
  bench_need(name, dyd_delaunay_new(&pd, sites, NULL, NULL), NULL);
  for (size_t r = 0; r < bench_runs(o, 3); r++)
    bench_series_add(&ours, cells_run(&answer, name, pd, -margin, side + margin));
  bench_check_numbers(o, name, boxes.n, answer.area, answer.distance, 0);
  bench_report(o, &(bench_row){.name = name,
                               .n = boxes.n,
                               .ours = &ours,
                               .peer = &no_peer,
                               .measure = "us a site",
                               .figure = bench_series_median(&ours).seconds / (double)boxes.n * 1e6,
                               .figure_goal = goal,
                               .remark = answer.remark});
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  cloud_clear(&boxes);
}

/* Statuses of the discs of a receiver, the triangulation of their squares included, beside that alone. */
static void row_discs(const bench_options *o, const char *name, size_t n) {
  cloud boxes;
  bench_series ours = {0}, plain = {0};
  size_t count[4] = {0};
  if (!bench_wants(o, name)) return;
  cloud_gps(&boxes, bench_size(o, n));
  for (size_t r = 0; r < bench_runs(o, 3); r++) {
    dyd_sites *sites = NULL;
    dyd_delaunay *pd = NULL;
    dyd_pair_list pairs = {0};
    bench_need(name, dyd_sites_new(&sites), NULL);
    bench_need(name, dyd_sites_add_boxes(sites, boxes.n, boxes.x0, boxes.x1, boxes.y0, boxes.y1), NULL);
    bench_meter squares = bench_start(), all = squares;
    bench_need(name, dyd_delaunay_new(&pd, sites, NULL, NULL), NULL);
    bench_series_add(&plain, bench_stop(&squares));
    bench_need(name, dyd_disc_pairs(&pairs, pd, NULL, NULL), NULL);
    bench_series_add(&ours, bench_stop(&all));
    for (int k = 0; k < 4; k++) count[k] = 0;
    for (size_t k = 0; k < pairs.count; k++) count[pairs.item[k].status]++;
    dyd_pair_list_clear(&pairs);
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
  }
  bench_check_numbers(o, name, boxes.n, count[DYD_LEGAL], count[DYD_INDETERMINATE], 0);
  bench_report(o, &(bench_row){.name = name,
                               .n = boxes.n,
                               .ours = &ours,
                               .peer = &plain,
                               .peer_name = "own triangulation",
                               .ratio_goal = 3,
                               .measure = "us an open pair",
                               .figure = bench_series_median(&ours).seconds / (double)count[DYD_INDETERMINATE] * 1e6,
                               .figure_goal = 10,
                               .remark = "statuses of discs, squares included"});
  cloud_clear(&boxes);
}

/* The triangulation of the points, and their tiles on the square around them. */
static void tiles_run(bench_series *plain, bench_series *ours, size_t answer[2], const char *row, const cloud *c,
                      double side) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_tiles tiles = {0};
  dyd_rect window;
  dyd_rect_init(&window);
  bench_need(row, dyd_rect_set_d(&window, 0, side, 0, side), NULL);
  bench_need(row, dyd_sites_new(&sites), NULL);
  bench_need(row, dyd_sites_add_points(sites, c->n, c->x, c->y), NULL);
  bench_meter meter = bench_start();
  bench_need(row, dyd_delaunay_new(&pd, sites, NULL, NULL), NULL);
  bench_series_add(plain, bench_stop(&meter));
  meter = bench_start();
  bench_need(row, dyd_voronoi_tiles(&tiles, pd, &window, 0, NULL), NULL);
  bench_series_add(ours, bench_stop(&meter));
  answer[0] = tiles.count;
  answer[1] = tiles.offset[tiles.count];
  dyd_tiles_clear(&tiles);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  dyd_rect_clear(&window);
}

/* A jagged border around the middle of the unit square, counter-clockwise. */
enum { BORDER = 20000 };
static void border_init(dyd_area *a) {
  const double turn = 6.283185307179586;
  uint64_t state = 7;
  *a = (dyd_area){1, calloc(2, sizeof *a->offset), calloc(2 * BORDER, sizeof *a->xy)};
  if (!a->offset || !a->xy) bench_die("clip", "out of memory");
  a->offset[1] = BORDER;
  for (size_t k = 0; k < BORDER; k++) {
    double t = turn * (double)k / BORDER,
           r = 0.42 + 0.04 * sin(7 * t) + 0.02 * sin(41 * t) + 0.003 * cloud_unit(&state);
    a->xy[2 * k] = 0.5 + r * cos(t);
    a->xy[2 * k + 1] = 0.5 + r * sin(t);
  }
}

/* Tiles cut to a border of 20,000 vertices, on top of the tiles. */
static void row_clip(const bench_options *o, const char *name, size_t n) {
  cloud points;
  bench_series ours = {0};
  size_t rings = 0, bad[2];
  dyd_area border;
  dyd_rect window;
  if (!bench_wants(o, name)) return;
  cloud_uniform(&points, bench_size(o, n));
  border_init(&border);
  dyd_rect_init(&window);
  bench_need(name, dyd_rect_set_d(&window, 0, 1, 0, 1), NULL);
  bench_need(name, dyd_area_orient(&border, bad), NULL);
  for (size_t r = 0; r < bench_runs(o, 3); r++) {
    dyd_sites *sites = NULL;
    dyd_delaunay *pd = NULL;
    dyd_tiles tiles = {0};
    bench_need(name, dyd_sites_new(&sites), NULL);
    bench_need(name, dyd_sites_add_points(sites, points.n, points.x, points.y), NULL);
    bench_need(name, dyd_delaunay_new(&pd, sites, NULL, NULL), NULL);
    bench_need(name, dyd_voronoi_tiles(&tiles, pd, &window, 0, NULL), NULL);
    bench_meter meter = bench_start();
    bench_need(name, dyd_tiles_clip(&tiles, &border, NULL), NULL);
    bench_series_add(&ours, bench_stop(&meter));
    rings = tiles.count;
    dyd_tiles_clear(&tiles);
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
  }
  bench_check_numbers(o, name, points.n, rings, 0, 0);
  bench_report_seconds(o, name, points.n, &ours, 1, "a border of 20,000 vertices");
  dyd_rect_clear(&window);
  dyd_area_clear(&border);
  cloud_clear(&points);
}

/* Triangulation and tiles together, beside CGAL's diagram of the same points. */
static void row_diagram(const bench_options *o, const char *name, size_t n) {
  cloud points;
  bench_series ours = {0}, plain = {0}, both = {0}, peer = {0};
  size_t answer[2] = {0}, corners = 0;
  if (!bench_wants(o, name)) return;
  cloud_uniform(&points, bench_size(o, n));
  for (size_t r = 0; r < bench_runs(o, 3); r++) {
    bench_cost cost;
    tiles_run(&plain, &ours, answer, name, &points, 1);
    cost =
        (bench_cost){plain.seconds[r] + ours.seconds[r], plain.wall[r] + ours.wall[r], plain.bytes[r] + ours.bytes[r]};
    bench_series_add(&both, cost);
    if (peer_voronoi(&cost, &corners, points.n, points.x, points.y)) bench_series_add(&peer, cost);
  }
  bench_check_numbers(o, name, points.n, answer[0], answer[1], 0);
  bench_report(o, &(bench_row){.name = name,
                               .n = points.n,
                               .ours = &both,
                               .peer = &peer,
                               .peer_name = "CGAL's Voronoi_diagram_2",
                               .ratio_goal = 0.5,
                               .remark = "polygons as arrays, the triangulation included"});
  cloud_clear(&points);
}

static void row_tiles(const bench_options *o, const char *name, size_t n, bool grid) {
  cloud points;
  bench_series ours = {0}, plain = {0};
  size_t answer[2] = {0}, width = 0;
  if (!bench_wants(o, name)) return;
  cloud_uniform(&points, bench_size(o, n));
  while (grid && (width + 1) * (width + 1) <= points.n) width++;
  if (grid) points.n = width * width;
  for (size_t k = 0; grid && k < points.n; k++)
    points.x[k] = (double)(k % width) + 0.5, points.y[k] = (double)(k / width) + 0.5;
  for (size_t r = 0; r < bench_runs(o, 3); r++)
    tiles_run(&plain, &ours, answer, name, &points, grid ? (double)width : 1);
  bench_check_numbers(o, name, points.n, answer[0], answer[1], 0);
  bench_report(o, &(bench_row){.name = name,
                               .n = points.n,
                               .ours = &ours,
                               .peer = &plain,
                               .peer_name = "own triangulation",
                               .ratio_goal = 1.5,
                               .remark = "polygons as arrays"});
  cloud_clear(&points);
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    row_cells(&o, "cells", 100000, 0x1p-20, 10);
    row_cells(&o, "cells-near", 2000, 0.03, 100);
    row_cells(&o, "cells-apart", 1000, 0.1, 60);
    row_cells(&o, "cells-touch", 1000, 0.3, 120);
    row_cells(&o, "cells-gps", 10000, 0, 100);
    row_cells(&o, "cells-grid", 10000, -1, 100);
    row_discs(&o, "discs", 10000);
    row_tiles(&o, "tiles", 1000000, false);
    row_tiles(&o, "tiles-grid", 1000000, true);
    row_diagram(&o, "diagram", 1000000);
    row_clip(&o, "clip", 100000);
  }
  bench_options_close(&o);
  return 0;
}
