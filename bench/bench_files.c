/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows read, readhex, write and those of other formats: a points file in, all pairs out, against the triangulation of
 * the same points by the engine.
 *
 * Decimals of 17 digits are exact rationals that no double holds; hexadecimal floats are exact doubles. */
#include "answers.h"
#include "cloud.h"
#include "harness.h"
#include "ours.h"

#include <dyadel/io.h>

/* All formats but pages, which hold 300,000 pairs at most: the row of each, and the goal, if there is one. Pictures of
 * cairo are of other sizes elsewhere. */
enum { FORMATS = DYD_FORMAT_HTML };
static const struct {
  const char *row;
  double goal;
  bool same_everywhere;
} format[FORMATS] = {
    [DYD_FORMAT_CSV] = {"write", 1, true},      [DYD_FORMAT_JSON] = {"write-json", 1, true},
    [DYD_FORMAT_WKT] = {"write-wkt", 0, true},  [DYD_FORMAT_GEOJSON] = {"write-geojson", 1, true},
    [DYD_FORMAT_OBJ] = {"write-obj", 0, true},  [DYD_FORMAT_SVG] = {"write-svg", 1, true},
    [DYD_FORMAT_VTK] = {"write-vtk", 0, true},  [DYD_FORMAT_PDF] = {"write-pdf", 0, false},
    [DYD_FORMAT_PNG] = {"write-png", 0, false},
};

/* written: bytes. */
typedef struct series {
  bench_series read, run, write[FORMATS];
  size_t written[FORMATS], count[4];
} series;

static FILE *points_file(const cloud *c, bool hex) {
  FILE *f = tmpfile();
  if (!f) bench_die("files", "no temporary file");
  for (size_t i = 0; i < c->n; i++) fprintf(f, hex ? "%a %a\n" : "%.17g %.17g\n", c->x[i], c->y[i]);
  if (fflush(f)) bench_die("files", "writing failed");
  return f;
}

static void write_all(series *s, const dyd_engine *e, int k) {
  dyd_error err;
  FILE *out = tmpfile();
  if (!out) bench_die("files", "no temporary file");
  dyd_error_clear(&err);
  bench_meter meter = bench_start();
  bench_need("files", dyd_write(out, e, DYD_CONTENT_DELAUNAY, (dyd_format)k, NULL, &err), &err);
  if (fflush(out)) bench_die("files", "writing failed");
  bench_series_add(&s->write[k], bench_stop(&meter));
  s->written[k] = (size_t)ftell(out);
  if (!s->written[k]) bench_die(format[k].row, "nothing is written");
  fclose(out);
}

static void round_trip(series *s, const bench_options *o, FILE *in, size_t n) {
  dyd_engine *e = NULL;
  dyd_outcome outcome;
  dyd_error err;
  dyd_error_clear(&err);
  rewind(in);
  bench_need("files", dyd_engine_new(&e), &err);
  bench_meter meter = bench_start();
  bench_need("files", dyd_read_points(e, in, NULL, &err), &err);
  bench_series_add(&s->read, bench_stop(&meter));
  if (dyd_engine_count(e) != n) bench_die("files", "not as many points as lines");
  meter = bench_start();
  bench_need("files", dyd_engine_run(&outcome, e, NULL, &err), &err);
  bench_series_add(&s->run, bench_stop(&meter));
  dyd_delaunay_count(s->count, dyd_engine_delaunay(e));
  for (int k = 0; k < FORMATS; k++)
    if (bench_wants(o, format[k].row)) write_all(s, e, k);
  dyd_engine_free(e);
}

static void row_files(const bench_options *o, bool hex) {
  cloud points;
  series s = {0};
  cloud_uniform(&points, bench_size(o, 1000000));
  FILE *in = points_file(&points, hex);
  for (size_t r = 0; r < bench_runs(o, 3); r++) round_trip(&s, o, in, points.n);
  bench_row row = {.n = points.n, .peer = &s.run, .peer_name = "own triangulation", .ratio_goal = 1};
  row.name = hex ? "readhex" : "read";
  row.ours = &s.read;
  row.remark = hex ? "hexadecimal floats" : "decimals of 17 digits";
  bench_check(o, row.name, points.n, s.count);
  bench_report(o, &row);
  for (int k = 0; k < FORMATS && !hex; k++) {
    char remark[100];
    if (!bench_wants(o, format[k].row)) continue;
    row.name = format[k].row;
    row.ours = &s.write[k];
    row.ratio_goal = format[k].goal;
    row.remark = remark;
    snprintf(remark, sizeof remark, "%zu bytes; all pairs", s.written[k]);
    if (format[k].same_everywhere) /* json tells milliseconds, too */
      bench_check_numbers(o, row.name, points.n, s.written[k] / 1000, 0, 0);
    bench_report(o, &row);
  }
  fclose(in);
  cloud_clear(&points);
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    bool decimals = bench_wants(&o, "read");
    for (int k = 0; k < FORMATS; k++) decimals = decimals || bench_wants(&o, format[k].row);
    if (decimals) row_files(&o, false);
    if (bench_wants(&o, "readhex")) row_files(&o, true);
  }
  bench_options_close(&o);
  return 0;
}
