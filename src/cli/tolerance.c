/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel tolerance FILE: how far the points may move. */
#include "cli.h"
#include <stdlib.h>

typedef struct tolerance_run {
  dyd_tolerance *tolerance;
  const dyd_engine *engine;
  mpq_t up_to, sigma;
  double *weight, *sigmas;
  dyd_metric metric;
  bool cut;
  bool points; /* are radii of points written? They take longer than all edges */
  dyd_rect window;
} tolerance_run;

static dyd_status tolerance_write(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const tolerance_run *r = what;
  const dyd_write_options how = {DYD_SIZED(dyd_write_options), .tolerance = r->tolerance,
                                 .window = o->window ? &r->window : NULL, .epsg = o->epsg};
  return dyd_write(out, r->engine, o->content, o->format, &how, err);
}

/* A number of each point, as its row says. */
static double *of_each_point(const dyd_engine *e, double (*number)(const dyd_engine *e, size_t i)) {
  size_t n = dyd_engine_count(e);
  double *out = malloc((n + 1) * sizeof *out);
  for (size_t i = 0; out && i < n; i++) out[i] = number(e, i);
  return out;
}

/* How far points move, each by its own measure, stands in the column of radii. */
static int tolerance_columns(tolerance_run *r, const cli_options *o) {
  if (o->read.radius_columns) r->weight = of_each_point(r->engine, dyd_engine_radius);
  if (o->read.sigma_column) r->sigmas = of_each_point(r->engine, dyd_engine_sigma);
  bool good = !r->weight == !o->read.radius_columns && !r->sigmas == !o->read.sigma_column;
  return good ? 0 : cli_complain_memory();
}

/* The triangulation of the points as they are, and what it tolerates. */
static dyd_status tolerance_find(dyd_engine *e, const dyd_engine_options *options, void *user, dyd_error *err) {
  tolerance_run *r = user;
  dyd_outcome outcome;
  dyd_engine_options once = *options;
  dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .points = r->points, .max_pairs = options->max_pairs,
                             .cancel = cli_signals_flag(), .metric = r->metric};
  once.max_stages = 1;
  dyd_status st = dyd_engine_run(&outcome, e, &once, err);
  if (st != DYD_OK || !cli_run_was_whole(e)) return st;
  if (mpq_sgn(r->up_to)) o.up_to = r->up_to;
  o.sigma = mpq_get_d(r->sigma);
  o.weight = r->weight;
  o.sigmas = r->sigmas;
  st = dyd_tolerance_new(&r->tolerance, dyd_engine_delaunay(e), &o, err);
  r->cut = st == DYD_CANCELLED;
  return cli_session_cut(st, err);
}

static int tolerance_all(cli_session *s, tolerance_run *r, const cli_options *o) {
  r->engine = s->engine;
  int status = tolerance_columns(r, o);
  if (!status) status = cli_session_run_by(s, &o->engine, tolerance_find, r);
  cli_session_settle(s);
  /* radii and counts come of all edges */
  bool parts = o->content != DYD_CONTENT_RADII && o->content != DYD_CONTENT_BARCODE;
  if (!status && (!r->tolerance || (r->cut && !parts))) return cli_session_stopped(s, "the tolerances were");
  if (!status) status = cli_write_file(o->output, o, tolerance_write, r);
  return !status && r->cut ? cli_exit_cut() : status;
}

/* Above 0, and a double that is. */
static int sigma_read(mpq_ptr out, const char *text) {
  int status = cli_number_read(out, "sigma", text);
  if (status || (mpq_get_d(out) >= 1e-300 && mpq_get_d(out) <= 1e300)) return status;
  cli_complain("--sigma \"%s\" is not understood; give a number above 0, such as 0.01", text);
  return CLI_USAGE;
}

/* What may not be given together. */
static int tolerance_contradictions(const cli_options *o) {
  bool sigmas = o->sigma && o->read.sigma_column, weights = o->metric == DYD_METRIC_BOX && o->read.radius_columns;
  bool chances =
      (o->sigma || o->read.sigma_column) && (o->content == DYD_CONTENT_RADII || o->content == DYD_CONTENT_BARCODE);
  if (sigmas) cli_complain("--sigma and --sigma-column contradict each other; leave one of them away");
  if (chances) cli_complain("probabilities are those of pairs; leave the standard deviation or --layer away");
  if (weights) cli_complain("--metric box is about points that move equally far; leave it, or --radius-column, away");
  return sigmas || chances || weights ? CLI_USAGE : 0;
}

int cli_tolerance(const cli_options *o) {
  tolerance_run r = {.metric = o->metric, .points = o->content == DYD_CONTENT_RADII || o->format == DYD_FORMAT_JSON};
  cli_options own = *o;
  cli_session s;
  own.read.keep_radii = true;
  mpq_inits(r.up_to, r.sigma, NULL);
  dyd_rect_init(&r.window);
  int status = o->up_to ? cli_number_read(r.up_to, "up-to", o->up_to) : 0;
  if (!status && o->sigma) status = sigma_read(r.sigma, o->sigma);
  if (!status) status = tolerance_contradictions(o);
  if (!status && o->window) status = cli_window_read(&r.window, o->window);
  if (!status) {
    status = cli_session_open(&s, &own);
    if (!status) status = tolerance_all(&s, &r, o);
    own.quiet = true; /* ties are events here, nothing left open */
    dyd_tolerance_free(r.tolerance);
    r.tolerance = NULL;
    int end = cli_session_close(&s, status ? status : CLI_USAGE);
    if (status) status = end;
  }
  free(r.weight);
  free(r.sigmas);
  dyd_rect_clear(&r.window);
  mpq_clears(r.up_to, r.sigma, NULL);
  return status;
}
