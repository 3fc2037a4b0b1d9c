/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows over the sphere: uniform points, and airports, beside the same degrees as a plane; all crossings of parallels
 * and meridians, which are ties. */
#include "answers.h"
#include "cloud.h"
#include "harness.h"
#include "ours.h"
#include "real.h"

#include <dyadel/io.h>
#include <dyadel/sphere.h>

/* Where the points come from: a file, or a cloud. */
typedef struct globe_input {
  const char *row;
  const cloud *points;
  FILE *in;
} globe_input;

static dyd_engine *engine_fill(const globe_input *g) {
  const dyd_read_options how = {DYD_SIZED(dyd_read_options), .columns = "longitude,latitude"};
  dyd_engine *e = NULL;
  dyd_error err;
  bench_need(g->row, dyd_engine_new(&e), NULL);
  if (g->in) rewind(g->in);
  if (g->in)
    bench_need(g->row, dyd_read_points(e, g->in, &how, &err), &err);
  else
    bench_need(g->row, dyd_engine_add_points(e, g->points->n, g->points->x, g->points->y, NULL), NULL);
  return e;
}

/* Points, run and pairs. */
static bench_cost globe_run(size_t count[4], const globe_input *g, bool sphere) {
  dyd_sphere *s = NULL;
  dyd_pair_list pairs = {0};
  dyd_outcome outcome;
  dyd_error err;
  bench_meter meter = bench_start();
  dyd_engine *e = engine_fill(g);
  if (sphere) {
    bench_need(g->row, dyd_sphere_new(&s, e, NULL, &err), &err);
    bench_need(g->row, dyd_sphere_run(&outcome, s, NULL, &err), &err);
    bench_need(g->row, dyd_sphere_pairs(&pairs, s), NULL);
  } else {
    bench_need(g->row, dyd_engine_run(&outcome, e, NULL, &err), &err);
    bench_need(g->row, dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(e)), NULL);
  }
  bench_cost cost = bench_stop(&meter);
  for (int k = 0; k < 4; k++) count[k] = 0;
  for (size_t k = 0; k < pairs.count; k++) count[pairs.item[k].status]++;
  dyd_pair_list_clear(&pairs);
  dyd_sphere_free(s);
  dyd_engine_free(e);
  return cost;
}

static void row_globe(const bench_options *o, const globe_input *g, size_t n, size_t runs, double ratio,
                      double seconds) {
  bench_series ours = {0}, plane = {0};
  size_t count[4], plane_count[4];
  char remark[200];
  for (size_t r = 0; r < bench_runs(o, runs); r++) {
    bench_series_add(&ours, globe_run(count, g, true));
    if (ratio > 0) bench_series_add(&plane, globe_run(plane_count, g, false));
  }
  bench_check(o, g->row, n, count);
  snprintf(remark, sizeof remark, "legal %zu; tied %zu", count[DYD_LEGAL], count[DYD_TIE]);
  bench_report(o, &(bench_row){.name = g->row,
                               .n = n,
                               .ours = &ours,
                               .peer = &plane,
                               .peer_name = "plane",
                               .ratio_goal = ratio,
                               .measure = seconds > 0 ? "seconds" : NULL,
                               .figure = bench_series_median(&ours).seconds,
                               .figure_goal = seconds,
                               .remark = remark});
}

static void row_cloud(const bench_options *o, const char *name, void (*make)(cloud *c, size_t n), size_t n, size_t runs,
                      double ratio, double seconds) {
  cloud points;
  if (!bench_wants(o, name)) return;
  make(&points, bench_size(o, n));
  row_globe(o, &(globe_input){.row = name, .points = &points}, points.n, runs, ratio, seconds);
  cloud_clear(&points);
}

static void row_airports(const bench_options *o) {
  if (!bench_wants(o, "airports") || o->part > 1) return;
  FILE *in = real_airports(0);
  row_globe(o, &(globe_input){.row = "airports", .in = in}, 3376, 21, 2, 0);
  fclose(in);
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    row_cloud(&o, "sphere", cloud_globe, 100000, 5, 2, 0);
    row_cloud(&o, "parallels", cloud_parallels, 64800, 1, 0, 10);
    row_airports(&o);
  }
  bench_options_close(&o);
  return 0;
}
