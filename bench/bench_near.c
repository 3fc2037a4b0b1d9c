/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows near, nearbits: 64 computable points next to a circle, their radii apart by multiples of 2^-10000, until
 * decided: the time, and the bits asked for each point, compared with 10000. */
#include "answers.h"
#include "harness.h"
#include "ours.h"

#include <dyadel/engine.h>

enum { POINTS = 64, APART = 10000 };

static void add_point(dyd_engine *e, int k, dyd_error *err) {
  static const char *const function[2] = {"cos", "sin"};
  dyd_real *coordinate[2] = {NULL, NULL};
  dyd_stream *s = NULL;
  for (int a = 0; a < 2; a++) {
    char text[100];
    int length =
        snprintf(text, sizeof text, "%s(2*pi*%d/%d)*(1+%d*2^-%d)", function[a], k, POINTS, k * 37 % POINTS, APART);
    bench_need("near", dyd_real_parse(&coordinate[a], text, (size_t)length, err), err);
  }
  bench_need("near", dyd_stream_from_reals(&s, coordinate[0], coordinate[1]), err);
  bench_need("near", dyd_engine_add_stream(e, s, NULL), err);
}

static bench_cost run(size_t count[4], double *bits, char *remark, size_t size) {
  dyd_engine *e = NULL;
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  dyd_engine_options options = {DYD_SIZED(dyd_engine_options), .max_bits = 4 * APART};
  dyd_engine_counters counters = {DYD_SIZED(dyd_engine_counters)};
  dyd_error err;
  dyd_error_clear(&err);
  bench_meter meter = bench_start();
  bench_need("near", dyd_engine_new(&e), &err);
  for (int k = 0; k < POINTS; k++) add_point(e, k, &err);
  bench_need("near", dyd_engine_run(&outcome, e, &options, &err), &err);
  bench_cost cost = bench_stop(&meter);
  dyd_engine_get_counters(&counters, e, NULL);
  dyd_delaunay_count(count, dyd_engine_delaunay(e));
  *bits = (double)counters.bits_total / POINTS;
  snprintf(remark, size, "outcome %s; legal %zu; undecided %zu; bits asked for each point %.0f on average",
           dyd_outcome_text(outcome), count[DYD_LEGAL], count[DYD_INDETERMINATE] + count[DYD_TIE], *bits);
  dyd_engine_free(e);
  return cost;
}

int main(int argc, char **argv) {
  static const bench_series no_peer;
  bench_options o;
  bench_options_read(&o, argc, argv);
  if (bench_wants(&o, "near") || bench_wants(&o, "nearbits")) {
    bench_series ours = {0};
    char remark[200];
    double bits = 0;
    size_t count[4] = {0};
    for (size_t r = 0; r < bench_runs(&o, 3); r++) bench_series_add(&ours, run(count, &bits, remark, sizeof remark));
    bench_check(&o, "near", POINTS, count);
    bench_report_seconds(&o, "near", POINTS, &ours, 2, remark);
    bench_report(&o, &(bench_row){.name = "nearbits",
                                  .n = POINTS,
                                  .ours = &ours,
                                  .peer = &no_peer,
                                  .measure = "bits asked by bits apart",
                                  .figure = bits / APART,
                                  .figure_goal = 1.2,
                                  .remark = remark});
  }
  bench_options_close(&o);
  return 0;
}
