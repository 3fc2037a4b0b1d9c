/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows over cells: polygons of all cells and both bounds of the diagram on the unit square; cells of thin boxes, cells
 * near (boxes of three hundredths of the spacing), apart (boxes of a tenth of the spacing), cells touch (lightly: of
 * three tenths). Time a site; nobody else computes these. tiles: polygons of exact points, beside their triangulation;
 * tiles-grid: of a square grid. */
#include "answers.h"
#include "cloud.h"
#include "harness.h"

#include <dyadel/metric.h>
#include <math.h>

static const bench_series no_peer;

static void cells_check(const char *row, dyd_status status) {
  if (status != DYD_OK) bench_die(row, dyd_status_text(status));
}

/* area, distance: both bounds, up to rounding, times 10^9. */
typedef struct cells_answer {
  size_t area, distance;
  char remark[200];
} cells_answer;

/* One run on a triangulation that is there. The whole square is undetermined at most, and something is wherever boxes
 * have an extent. */
static bench_cost cells_run(cells_answer *answer, const char *row, const dyd_delaunay *pd) {
  dyd_rect window;
  dyd_voronoi_bounds b;
  dyd_rect_init(&window);
  dyd_voronoi_bounds_init(&b);
  cells_check(row, dyd_interval_set_d(&window.x, 0, 1));
  cells_check(row, dyd_interval_set_d(&window.y, 0, 1));
  bench_meter meter = bench_start();
  cells_check(row, dyd_metric_voronoi(&b, pd, &window, dyd_metric_coarseness(pd, &window) + 4, NULL));
  bench_cost cost = bench_stop(&meter);
  double area = dyd_dyadic_get_d(&b.area, DYD_UP), distance = dyd_dyadic_get_d(&b.hausdorff, DYD_UP);
  if (!b.finite || !(area > 0 && area <= 1 && distance > 0 && distance < 1)) bench_die(row, "the bounds are wrong");
  answer->area = (size_t)llround(area * 1e9);
  answer->distance = (size_t)llround(distance * 1e9);
  snprintf(answer->remark, sizeof answer->remark, "undetermined area %.9g; distance %.9g", area, distance);
  dyd_voronoi_bounds_clear(&b);
  dyd_rect_clear(&window);
  return cost;
}

/* Boxes of half-width share / sqrt(n). goal: microseconds a site. */
static void row_cells(const bench_options *o, const char *name, size_t n, double share, double goal) {
  cloud boxes;
  bench_series ours = {0};
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  cells_answer answer = {0};
  if (!bench_wants(o, name)) return;
  cloud_uniform(&boxes, bench_size(o, n));
  cloud_widen(&boxes, share / sqrt((double)boxes.n));
  cells_check(name, dyd_sites_new(&sites));
  cells_check(name, dyd_sites_add_boxes(sites, boxes.n, boxes.x0, boxes.x1, boxes.y0, boxes.y1));
  cells_check(name, dyd_delaunay_new(&pd, sites, NULL, NULL));
  for (size_t r = 0; r < bench_runs(o, 3); r++) bench_series_add(&ours, cells_run(&answer, name, pd));
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

/* The triangulation of the points, and their tiles on the square around them. */
static void tiles_run(bench_series *plain, bench_series *ours, size_t answer[2], const char *row, const cloud *c,
                      double side) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_tiles tiles = {0};
  dyd_rect window;
  dyd_rect_init(&window);
  cells_check(row, dyd_rect_set_d(&window, 0, side, 0, side));
  cells_check(row, dyd_sites_new(&sites));
  cells_check(row, dyd_sites_add_points(sites, c->n, c->x, c->y));
  bench_meter meter = bench_start();
  cells_check(row, dyd_delaunay_new(&pd, sites, NULL, NULL));
  bench_series_add(plain, bench_stop(&meter));
  meter = bench_start();
  cells_check(row, dyd_voronoi_tiles(&tiles, pd, &window, 0, NULL));
  bench_series_add(ours, bench_stop(&meter));
  answer[0] = tiles.count;
  answer[1] = tiles.offset[tiles.count];
  dyd_tiles_clear(&tiles);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  dyd_rect_clear(&window);
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
    row_cells(&o, "cells-apart", 1000, 0.1, 100);
    row_cells(&o, "cells-touch", 1000, 0.3, 100);
    row_tiles(&o, "tiles", 1000000, false);
    row_tiles(&o, "tiles-grid", 1000000, true);
  }
  bench_options_close(&o);
  return 0;
}
