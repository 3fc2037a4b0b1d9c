/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Row plan: positions by a receiver, the plan that decides all pairs, against the triangulation of their squares. */
#include "answers.h"
#include "cloud.h"
#include "harness.h"
#include "ours.h"

#include <dyadel/survey.h>

/* The triangulation, then the plan. */
static void plan_run(bench_series *before, bench_series *ours, size_t answer[3], const cloud *c) {
  const dyd_survey_row *row;
  dyd_sites *sites;
  dyd_delaunay *pd;
  dyd_survey *s;
  bench_meter meter = bench_start();
  bench_need("plan", dyd_sites_new(&sites), NULL);
  bench_need("plan", dyd_sites_add_boxes(sites, c->n, c->x0, c->x1, c->y0, c->y1), NULL);
  bench_need("plan", dyd_delaunay_new(&pd, sites, NULL, NULL), NULL);
  bench_series_add(before, bench_stop(&meter));
  meter = bench_start();
  bench_need("plan", dyd_survey_new(&s, pd, NULL, NULL), NULL);
  bench_series_add(ours, bench_stop(&meter));
  answer[0] = dyd_survey_get(s)->open;
  answer[1] = dyd_survey_get(s)->left;
  answer[2] = dyd_survey_rows(&row, s);
  dyd_survey_free(s);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

static void row_plan(const bench_options *o, size_t n) {
  cloud c;
  bench_series before = {0}, ours = {0};
  size_t answer[3] = {0};
  char remark[200];
  cloud_gps(&c, n);
  for (size_t r = 0; r < bench_runs(o, n > 10000 ? 1 : 3); r++) plan_run(&before, &ours, answer, &c);
  bench_check_numbers(o, "plan", c.n, answer[0], answer[1], answer[2]);
  snprintf(remark, sizeof remark, "%zu pairs open, %zu with the plan; %zu points in it", answer[0], answer[1],
           answer[2]);
  bench_report(o, &(bench_row){.name = "plan",
                               .n = c.n,
                               .ours = &ours,
                               .peer = &before,
                               .peer_name = "triangulation",
                               .ratio_goal = 20,
                               .remark = remark});
  cloud_clear(&c);
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  if (bench_wants(&o, "plan") && o.n) row_plan(&o, o.n);
  for (size_t n = 10000; bench_wants(&o, "plan") && !o.n && n <= 100000; n *= 10) row_plan(&o, n);
  bench_options_close(&o);
  return 0;
}
