/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel voronoi FILE: read, run to the goal on a window, write the diagram. */
#include "cli.h"

/* The window given, or the default one, which needs to know where the points are: *s has to have run a first stage
 * then. 0, or an exit status after a message. */
static int voronoi_window(dyd_rect *out, const cli_session *s) {
  if (s->options->window) return cli_window_read(out, s->options->window);
  const dyd_delaunay *pd = dyd_engine_delaunay(s->engine);
  if (!pd || dyd_voronoi_window(out, dyd_delaunay_sites(pd)) == DYD_OK) return 0;
  cli_complain("the points span more than doubles hold; give --window XLO,XHI,YLO,YHI");
  return CLI_FAILED;
}

/* *known becomes true with the window. The cells get a share of the time, too. */
static int voronoi_run(bool *known, cli_session *s, dyd_rect *window, const dyd_engine_options *options) {
  dyd_engine_options first = *options;
  int status = 0, read;
  first.goal = DYD_GOAL_DECIDED;
  first.max_stages = 1;
  s->share = 0.75;
  if (!s->options->window) status = cli_session_run(s, &first);
  read = voronoi_window(window, s);
  *known = read == 0;
  if (!status) status = read;
  if (status || (!s->options->window && !cli_run_was_whole(s->engine))) return status;
  return cli_session_run(s, options);
}

static dyd_status voronoi_write(FILE *out, const void *engine, const cli_options *o, dyd_error *err) {
  const dyd_write_options how = {DYD_SIZED(dyd_write_options),  .flatten_bits = o->flatten_bits,
                                 .flatten_set = o->flatten_set, .window = o->engine.window,
                                 .bounds = o->bounds,           .epsg = o->epsg,
                                 .cancel = cli_deadline_flag(), .cut = o->cut,
                                 .history = o->history};
  return dyd_write(out, engine, o->content, o->format, &how, err);
}

/* The diagram, where there is one. */
static int voronoi_write_result(cli_session *s) {
  const dyd_delaunay *pd = dyd_engine_delaunay(s->engine);
  if (pd && dyd_delaunay_is_capped(pd)) {
    cli_complain("neighbours are missing, so no diagram is written: %s", cli_outcome_advice(s->engine));
    return 0;
  }
  size_t *cut = s->options->cut;
  int status = cli_session_write(s, voronoi_write);
  if (pd && (!status || status == CLI_BUDGET)) s->bounds = s->options->bounds;
  if ((status && status != CLI_BUDGET) || !*cut) return status;
  if (!s->options->quiet)
    cli_complain("budget: the time is used up: %zu cells or regions are not worked out, and the window stands for "
                 "them; raise --timeout",
                 *cut);
  return CLI_BUDGET;
}

int cli_voronoi(const cli_options *o) {
  cli_session s;
  cli_options own = *o; /* with the window read */
  dyd_rect window;
  dyd_voronoi_bounds bounds;
  size_t cut = 0;
  bool known = false;
  if (o->sphere) return cli_sphere(o);
  if (o->max_arc > 0) return cli_complain("--max-arc is about the globe; give --sphere or leave it away"), CLI_USAGE;
  dyd_rect_init(&window);
  dyd_voronoi_bounds_init(&bounds);
  own.bounds = &bounds;
  own.cut = &cut;
  own.engine.goal = cli_voronoi_goal(o->engine.goal);
  own.engine.window = &window;
  int status = cli_session_open(&s, &own);
  if (!status) status = cli_history_open(&own);
  if (!status) status = voronoi_run(&known, &s, &window, &own.engine);
  if (known && (!status || dyd_engine_delaunay(s.engine))) {
    int written = voronoi_write_result(&s);
    if (!status) status = written;
  }
  status = cli_session_close(&s, status);
  dyd_history_free(own.history);
  dyd_voronoi_bounds_clear(&bounds);
  dyd_rect_clear(&window);
  return status;
}
