/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows read, write, readhex: a points file in, csv out, against the triangulation of the same points by the engine.
 *
 * Decimals of 17 digits are exact rationals that no double holds; hexadecimal floats are exact doubles. */
#include "cloud.h"
#include "harness.h"

#include <dyadel/io.h>

typedef struct series {
  bench_series read, run, write;
} series;

static void check(dyd_status status, const dyd_error *err) {
  if (status != DYD_OK) bench_die("files", *err->message ? err->message : dyd_status_text(status));
}

static FILE *points_file(const cloud *c, bool hex) {
  FILE *f = tmpfile();
  if (!f) bench_die("files", "no temporary file");
  for (size_t i = 0; i < c->n; i++) fprintf(f, hex ? "%a %a\n" : "%.17g %.17g\n", c->x[i], c->y[i]);
  if (fflush(f)) bench_die("files", "writing failed");
  return f;
}

static void round_trip(series *s, FILE *in, size_t n) {
  dyd_engine *e = NULL;
  dyd_outcome outcome;
  dyd_error err;
  FILE *out = tmpfile();
  if (!out) bench_die("files", "no temporary file");
  dyd_error_clear(&err);
  rewind(in);
  check(dyd_engine_new(&e), &err);
  bench_meter meter = bench_start();
  check(dyd_read_points(e, in, NULL, &err), &err);
  bench_series_add(&s->read, bench_stop(&meter));
  if (dyd_engine_count(e) != n) bench_die("files", "not as many points as lines");
  meter = bench_start();
  check(dyd_engine_run(&outcome, e, NULL, &err), &err);
  bench_series_add(&s->run, bench_stop(&meter));
  meter = bench_start();
  check(dyd_write_delaunay(out, e, DYD_FORMAT_CSV, &err), &err);
  if (fflush(out)) bench_die("files", "writing failed");
  bench_series_add(&s->write, bench_stop(&meter));
  dyd_engine_free(e);
  fclose(out);
}

static void row_files(const bench_options *o, bool hex) {
  cloud points;
  series s = {0};
  cloud_uniform(&points, bench_size(o, 1000000));
  FILE *in = points_file(&points, hex);
  for (size_t r = 0; r < bench_runs(o, 3); r++) round_trip(&s, in, points.n);
  bench_row row = {.n = points.n, .peer = &s.run, .peer_name = "own triangulation", .ratio_goal = 1};
  row.name = hex ? "readhex" : "read";
  row.ours = &s.read;
  row.remark = hex ? "hexadecimal floats" : "decimals of 17 digits";
  bench_report(o, &row);
  row.name = "write";
  row.ours = &s.write;
  row.remark = "csv of all pairs";
  if (!hex) bench_report(o, &row);
  fclose(in);
  cloud_clear(&points);
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    if (bench_wants(&o, "read") || bench_wants(&o, "write")) row_files(&o, false);
    if (bench_wants(&o, "readhex")) row_files(&o, true);
  }
  bench_options_close(&o);
  return 0;
}
