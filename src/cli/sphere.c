/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* --sphere of delaunay and voronoi: the points of the file are places, their images are run. */
#include "cli.h"

static dyd_status sphere_write(FILE *out, const void *sphere, const cli_options *o, dyd_error *err) {
  const dyd_write_options how = {DYD_SIZED(dyd_write_options), .sphere = sphere, .epsg = o->epsg, .window = o->view,
                                 .max_arc = o->max_arc};
  return dyd_write(out, NULL, o->content, o->format, &how, err);
}

static dyd_status sphere_write_certificate(FILE *out, const void *sphere, const cli_options *o, dyd_error *err) {
  (void)o;
  return dyd_write_sphere_certificate(out, sphere, err);
}

static dyd_status sphere_run(dyd_engine *images, const dyd_engine_options *options, void *user, dyd_error *err) {
  dyd_outcome outcome;
  (void)images;
  return dyd_sphere_run(&outcome, user, options, err);
}

static int refuse_on_sphere(const cli_options *o) {
  const char *what = o->discs                             ? "--discs"
                     : o->flatten_set                     ? "--flatten"
                     : o->engine.goal != DYD_GOAL_DECIDED ? "--until"
                                                          : NULL;
  bool picture = o->format == DYD_FORMAT_SVG || o->format == DYD_FORMAT_PDF || o->format == DYD_FORMAT_PNG;
  if (what)
    cli_complain("%s is about the plane; leave %s or --sphere away", what, what);
  else if (o->window && !picture)
    cli_complain("on a sphere --window is the part that a picture shows; give svg, pdf or png, or leave it away");
  else
    return 0;
  return CLI_USAGE;
}

static const char *sphere_advice(const dyd_sphere *sphere) {
  const dyd_engine *images = dyd_sphere_images(sphere);
  if (dyd_engine_outcome(images) != DYD_OUTCOME_DECIDED) return cli_outcome_advice(images);
  return "pairs around the gap that all is projected from stay open; smaller radii decide more";
}

/* A line about a result that leaves something open; the exit status. */
static int sphere_outcome(const dyd_sphere *sphere, const cli_options *o) {
  dyd_pair_list pairs = {0};
  size_t count[4] = {0};
  dyd_outcome outcome = dyd_sphere_outcome(sphere);
  if (outcome == DYD_OUTCOME_DECIDED) return CLI_OK;
  if (dyd_sphere_pairs(&pairs, sphere) != DYD_OK) return cli_complain_memory();
  for (size_t k = 0; k < pairs.count; k++) count[pairs.item[k].status]++;
  dyd_pair_list_clear(&pairs);
  if (!o->quiet)
    cli_complain("%s: %zu legal, %zu indeterminate, %zu tie; %s", dyd_outcome_text(outcome), count[DYD_LEGAL],
                 count[DYD_INDETERMINATE], count[DYD_TIE], sphere_advice(sphere));
  return cli_exit_status(outcome);
}

static int sphere_result(cli_session *s, const dyd_sphere *sphere, const cli_options *o) {
  if (!dyd_engine_delaunay(s->engine)) return cli_session_stopped(s, "the triangulation was");
  cli_session_settle(s);
  int status = cli_write_file(o->output, o, sphere_write, sphere);
  if (!status && o->certificate) status = cli_write_file(o->certificate, o, sphere_write_certificate, sphere);
  if (o->stats) cli_stats(stderr, s->engine, sphere, NULL, cli_clock() - s->begun);
  return status ? status : sphere_outcome(sphere, o);
}

/* s->engine holds the places; while images are run it is theirs. */
static int sphere_all(cli_session *s, const cli_options *o) {
  const dyd_sphere_options how = {DYD_SIZED(dyd_sphere_options), .radius = o->read.radius,
                                  .radius_unit = o->read.radius_unit, .radius_scale = o->read.radius_scale};
  dyd_engine *places = s->engine;
  dyd_engine_options run = o->engine;
  dyd_sphere *sphere = NULL;
  dyd_error err;
  dyd_status st = dyd_sphere_new(&sphere, places, &how, &err);
  if (st != DYD_OK) {
    cli_complain_of(places, st == DYD_E_ARG ? NULL : o->file, &err);
    return st == DYD_E_ARG ? CLI_USAGE : CLI_FAILED;
  }
  if (!o->start_set) run.start_bits = 0;
  s->engine = dyd_sphere_engine(sphere);
  int status = o->resume ? cli_trace_resume(s) : 0;
  if (!status) status = cli_session_run_by(s, &run, sphere_run, sphere);
  if (!status || dyd_engine_delaunay(s->engine)) {
    int written = sphere_result(s, sphere, o);
    if (!status) status = written;
  }
  s->engine = places;
  dyd_sphere_free(sphere);
  return status;
}

void cli_options_degrees(cli_options *o) {
  o->read.degrees = true;
  o->read.radius = NULL; /* it may have a unit, and widens places */
}

static int sphere_points(const cli_options *o) {
  cli_options read = *o;
  cli_session s;
  cli_options_degrees(&read);
  read.resume = NULL; /* traces hold answers of images */
  int status = cli_session_open(&s, &read);
  read.read.radius = o->read.radius;
  read.resume = o->resume;
  if (!status) status = sphere_all(&s, o);
  cli_session_close(&s, CLI_USAGE); /* what is open was told of */
  return status;
}

int cli_sphere(const cli_options *o) {
  cli_options own = *o; /* with the window read */
  dyd_rect window;
  int status = refuse_on_sphere(o);
  dyd_rect_init(&window);
  if (!status && o->window) {
    own.view = &window;
    status = cli_window_read(&window, o->window);
  }
  if (!status) status = sphere_points(&own);
  dyd_rect_clear(&window);
  return status;
}
