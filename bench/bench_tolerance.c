/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows over tolerances: deaths of all edges of uniform points, against their triangulation; of a hub; radii of all
 * points. */
#include "answers.h"
#include "cloud.h"
#include "harness.h"

#include <dyadel/tolerance.h>

static void tolerance_check(const char *row, dyd_status status) {
  if (status != DYD_OK) bench_die(row, dyd_status_text(status));
}

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
  tolerance_check(row, dyd_sites_new(&sites));
  tolerance_check(row, dyd_sites_add_points(sites, c->n, c->x, c->y));
  tolerance_check(row, dyd_delaunay_new(&pd, sites, NULL, NULL));
  bench_series_add(before, bench_stop(&meter));
  meter = bench_start();
  tolerance_check(row, dyd_tolerance_new(&t, pd, &how, NULL));
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

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    row_deaths(&o, "deaths", false, cloud_uniform, 1000000, 1.5);
    row_deaths(&o, "radii", true, cloud_uniform, 1000000, 0);
    row_deaths(&o, "hub", false, cloud_hub, 100000, 0);
  }
  bench_options_close(&o);
  return 0;
}
