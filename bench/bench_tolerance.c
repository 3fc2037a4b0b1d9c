/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows over tolerances: deaths of all edges of uniform points, against their triangulation; of a hub; radii of all
 * points; of positions of a receiver, with weights, in squares, and births. */
#include "answers.h"
#include "cloud.h"
#include "harness.h"
#include "ours.h"

#include <dyadel/tolerance.h>

typedef struct deaths_answer {
  uint64_t filter, exact;
  double least, radii; /* radii: the sum */
} deaths_answer;

/* The triangulation, then what it tolerates. */
static void deaths_run(bench_series *before, bench_series *ours, deaths_answer *answer, const char *row, bool radii,
                       const cloud *c) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_tolerance *t = NULL;
  const dyd_tolerance_options how = {DYD_SIZED(dyd_tolerance_options), .points = radii};
  bench_meter meter = bench_start();
  bench_need(row, dyd_sites_new(&sites), NULL);
  bench_need(row, dyd_sites_add_points(sites, c->n, c->x, c->y), NULL);
  bench_need(row, dyd_delaunay_new(&pd, sites, NULL, NULL), NULL);
  bench_series_add(before, bench_stop(&meter));
  meter = bench_start();
  bench_need(row, dyd_tolerance_new(&t, pd, &how, NULL), NULL);
  bench_series_add(ours, bench_stop(&meter));
  answer->filter = dyd_tolerance_get(t)->filter, answer->exact = dyd_tolerance_get(t)->exact;
  answer->least = dyd_tolerance_get(t)->lo;
  answer->radii = 0;
  for (size_t i = 0; radii && i < c->n; i++) answer->radii += dyd_tolerance_get(t)->points[i];
  dyd_tolerance_free(t);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

static void row_deaths(const bench_options *o, const char *name, bool radii, void (*make)(cloud *c, size_t n), size_t n,
                       double goal) {
  cloud points;
  bench_series before = {0}, ours = {0};
  deaths_answer answer = {0};
  char remark[200];
  if (!bench_wants(o, name)) return;
  make(&points, bench_size(o, n));
  for (size_t r = 0; r < bench_runs(o, 3); r++) deaths_run(&before, &ours, &answer, name, radii, &points);
  bench_check_numbers(o, name, points.n, (size_t)(answer.filter + answer.exact), (size_t)(answer.least * 1e18),
                      (size_t)(answer.radii * 1e9));
  snprintf(remark, sizeof remark, "%llu deaths; %llu by integers; the least %.9g",
           (unsigned long long)(answer.filter + answer.exact), (unsigned long long)answer.exact, answer.least);
  bench_report(o, &(bench_row){.name = name,
                               .n = points.n,
                               .ours = &ours,
                               .peer = &before,
                               .peer_name = "triangulation",
                               .ratio_goal = goal,
                               .remark = remark});
  cloud_clear(&points);
}

/* Positions of a receiver: squares of their accuracies are triangulated beside; the exact places' triangulation is not
 * counted. */
static size_t moved_run(bench_series *squares, bench_series *ours, double *least, const char *row,
                        const dyd_tolerance_options *how, const cloud *c) {
  dyd_sites *sites[2] = {NULL, NULL};
  dyd_delaunay *pd[2] = {NULL, NULL};
  dyd_tolerance *t = NULL;
  const dyd_tolerance_row *rows;
  bench_meter meter = bench_start();
  bench_need(row, dyd_sites_new(&sites[0]), NULL);
  bench_need(row, dyd_sites_add_boxes(sites[0], c->n, c->x0, c->x1, c->y0, c->y1), NULL);
  bench_need(row, dyd_delaunay_new(&pd[0], sites[0], NULL, NULL), NULL);
  bench_series_add(squares, bench_stop(&meter));
  bench_need(row, dyd_sites_new(&sites[1]), NULL);
  bench_need(row, dyd_sites_add_points(sites[1], c->n, c->x, c->y), NULL);
  bench_need(row, dyd_delaunay_new(&pd[1], sites[1], NULL, NULL), NULL);
  meter = bench_start();
  bench_need(row, dyd_tolerance_new(&t, pd[1], how, NULL), NULL);
  bench_series_add(ours, bench_stop(&meter));
  size_t count = dyd_tolerance_rows(&rows, t);
  *least = dyd_tolerance_get(t)->lo;
  dyd_tolerance_free(t);
  for (int k = 0; k < 2; k++) dyd_delaunay_free(pd[k]), dyd_sites_free(sites[k]);
  return count;
}

/* Births, too: up to a quarter. */
typedef enum moved_kind { MOVED_ALIKE, MOVED_BY_WEIGHTS, MOVED_IN_SQUARES } moved_kind;

/* goal: microseconds a row, births or all. */
static void row_moved(const bench_options *o, const char *name, moved_kind kind, bool births, size_t n, double goal) {
  cloud points;
  bench_series squares = {0}, ours = {0};
  double least = 0;
  size_t rows = 0, born = 0;
  mpq_t up_to;
  char remark[100];
  if (!bench_wants(o, name)) return;
  cloud_gps(&points, bench_size(o, n));
  mpq_init(up_to);
  mpq_set_ui(up_to, 1, 4);
  const dyd_tolerance_options how = {DYD_SIZED(dyd_tolerance_options), .up_to = births ? up_to : NULL,
                                     .weight = kind == MOVED_BY_WEIGHTS ? points.radius : NULL,
                                     .metric = kind == MOVED_IN_SQUARES ? DYD_METRIC_BOX : DYD_METRIC_EUCLID};
  for (size_t r = 0; r < bench_runs(o, 3); r++) rows = moved_run(&squares, &ours, &least, name, &how, &points);
  born = births ? rows - 3 * points.n : rows;
  bench_check_numbers(o, name, points.n, rows, (size_t)(least * 1e15), 0);
  snprintf(remark, sizeof remark, "%zu rows; the least %.9g", rows, least);
  bench_report(o, &(bench_row){.name = name,
                               .n = points.n,
                               .ours = &ours,
                               .peer = &squares,
                               .peer_name = "squares",
                               .output = rows,
                               .measure = births ? "us a birth" : "us an edge",
                               .figure = bench_series_median(&ours).seconds * 1e6 / (double)born,
                               .figure_goal = goal,
                               .remark = remark});
  mpq_clear(up_to);
  cloud_clear(&points);
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    row_deaths(&o, "deaths", false, cloud_uniform, 1000000, 1.5);
    row_deaths(&o, "radii", true, cloud_uniform, 1000000, 0);
    row_deaths(&o, "hub", false, cloud_hub, 100000, 0);
    row_moved(&o, "weights", MOVED_BY_WEIGHTS, false, 100000, 30);
    row_moved(&o, "squares", MOVED_IN_SQUARES, false, 100000, 30);
    row_moved(&o, "births", MOVED_ALIKE, true, 20000, 8);
    row_moved(&o, "births-weights", MOVED_BY_WEIGHTS, true, 20000, 8);
    row_moved(&o, "births-squares", MOVED_IN_SQUARES, true, 20000, 8);
  }
  bench_options_close(&o);
  return 0;
}
