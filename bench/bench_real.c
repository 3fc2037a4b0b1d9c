/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows over real data: airports widened by three radii, a crowd with far outliers, clusters, tracks, a coast line.
 * Nobody else computes these statuses: microseconds and bytes a possible pair. And what it takes to check certificates
 * of crowds, beside the run that they come from. */
#include "answers.h"
#include "harness.h"
#include "ours.h"
#include "real.h"

#include <dyadel/certificate.h>
#include <dyadel/io.h>

typedef struct real_row {
  const char *name;
  FILE *(*make)(size_t n);
  size_t n;
  const char *columns, *radius;
} real_row;

static dyd_engine *engine_of(const real_row *row, FILE *in) {
  dyd_read_options read = {DYD_SIZED(dyd_read_options), .columns = row->columns, .radius = row->radius};
  dyd_engine *e = NULL;
  dyd_error err;
  dyd_error_clear(&err);
  rewind(in);
  bench_need(row->name, dyd_engine_new(&e), &err);
  bench_need(row->name, dyd_read_points(e, in, &read, &err), &err);
  return e;
}

/* One run of the engine, and the list of its pairs; the file has been read before. */
static bench_cost run(size_t count[4], const real_row *row, FILE *in, size_t *points) {
  dyd_engine *e = engine_of(row, in);
  dyd_outcome outcome;
  dyd_pair_list pairs = {0};
  dyd_error err;
  bench_meter meter = bench_start();
  bench_need(row->name, dyd_engine_run(&outcome, e, NULL, &err), &err);
  bench_need(row->name, dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(e)), &err);
  bench_cost cost = bench_stop(&meter);
  dyd_pair_list_clear(&pairs);
  *points = dyd_engine_count(e);
  dyd_delaunay_count(count, dyd_engine_delaunay(e));
  dyd_engine_free(e);
  return cost;
}

static void row_real(const bench_options *o, const real_row *real) {
  static const bench_series no_peer;
  bench_series ours = {0};
  size_t count[4], points = 0;
  char remark[200];
  FILE *in = real->make(bench_size(o, real->n));
  for (size_t r = 0; r < bench_runs(o, 3); r++) bench_series_add(&ours, run(count, real, in, &points));
  fclose(in);
  bench_check(o, real->name, points, count);
  size_t pairs = count[DYD_LEGAL] + count[DYD_INDETERMINATE] + count[DYD_TIE];
  bench_cost cost = bench_series_median(&ours);
  snprintf(remark, sizeof remark, "%zu pairs; legal %zu; indeterminate %zu; tied %zu", pairs, count[DYD_LEGAL],
           count[DYD_INDETERMINATE], count[DYD_TIE]);
  bench_row row = {.name = real->name, .n = points, .ours = &ours, .peer = &no_peer, .remark = remark, .output = pairs};
  row.measure = "us a possible pair";
  row.figure = cost.seconds / (double)pairs * 1e6;
  row.figure_goal = 8;
  row.bytes_each = cost.bytes / (double)pairs;
  row.bytes_each_goal = 200;
  bench_report(o, &row);
}

/* One run of the engine; then its certificate is checked. */
static void run_and_verify(bench_series *run, bench_series *verify, dyd_certificate_report *report, const real_row *row,
                           FILE *in) {
  dyd_engine *e = engine_of(row, in);
  dyd_outcome outcome;
  dyd_error err;
  bench_meter meter = bench_start();
  bench_need(row->name, dyd_engine_run(&outcome, e, NULL, &err), &err);
  bench_series_add(run, bench_stop(&meter));
  FILE *certificate = tmpfile();
  if (!certificate) bench_die(row->name, "there is no room for a file");
  bench_need(row->name, dyd_write_certificate(certificate, e, NULL, &err), &err);
  dyd_engine_free(e);
  rewind(certificate);
  meter = bench_start();
  bench_need(row->name, dyd_verify_certificate(report, certificate, NULL, &err), &err);
  bench_series_add(verify, bench_stop(&meter));
  fclose(certificate);
}

static void row_verify(const bench_options *o, const real_row *real) {
  bench_series ran = {0}, verified = {0};
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  char remark[200];
  FILE *in = real->make(bench_size(o, real->n));
  for (size_t r = 0; r < bench_runs(o, 3); r++) run_and_verify(&ran, &verified, &report, real, in);
  fclose(in);
  bench_check_numbers(o, real->name, report.sites, report.legal, report.indeterminate, report.gaps);
  snprintf(remark, sizeof remark, "%zu indeterminate pairs; gaps %u", report.indeterminate, report.gaps);
  bench_report(o, &(bench_row){.name = real->name,
                               .n = report.sites,
                               .ours = &verified,
                               .peer = &ran,
                               .peer_name = "own run",
                               .output = report.legal + report.indeterminate,
                               .measure = "seconds",
                               .figure = bench_series_median(&verified).seconds,
                               .figure_goal = 1,
                               .remark = remark});
}

int main(int argc, char **argv) {
  static const real_row rows[] = {{"airports05", real_airports, 3376, "longitude,latitude", "0.05"},
                                  {"airports1", real_airports, 3376, "longitude,latitude", "0.1"},
                                  {"airports3", real_airports, 3376, "longitude,latitude", "0.3"},
                                  {"outliers", real_outliers, 3000, NULL, NULL},
                                  {"clusters", real_clusters, 6000, NULL, NULL},
                                  {"tracks", real_tracks, 40000, NULL, NULL},
                                  {"coast", real_coast, 100000, NULL, NULL}};
  static const real_row verified[] = {{"verify-airports", real_airports, 3376, "longitude,latitude", "0.1"},
                                      {"verify-tracks", real_tracks, 2000, NULL, NULL}};
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
      if (bench_wants(&o, rows[k].name)) row_real(&o, &rows[k]);
    for (size_t k = 0; k < sizeof verified / sizeof *verified; k++)
      if (bench_wants(&o, verified[k].name)) row_verify(&o, &verified[k]);
  }
  bench_options_close(&o);
  return 0;
}
