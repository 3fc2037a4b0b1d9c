/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel converge FILE: a run stage by stage, as a table and a plot; traces of runs, and replays of these. */
#include "cli.h"

/* engine: that ran; NULL: a trace was replayed. */
typedef struct result {
  const dyd_convergence *table;
  const dyd_engine *engine;
} result;

static dyd_status print_table(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const result *r = what;
  const dyd_write_options how = {DYD_SIZED(dyd_write_options), .stages = r->table, .times = !o->no_times,
                                 .history = o->history,        .window = o->view,  .label = o->label,
                                 .no_header = o->no_header};
  return dyd_write(out, r->engine, o->content, o->format, &how, err);
}

/* By the name of the plot's file; false when no format of that ending holds a plot. */
static bool plot_format(dyd_format *out, const char *name) {
  return dyd_format_from_file(out, name) && dyd_format_holds(*out, DYD_CONTENT_PLOT);
}

static dyd_status print_plot(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  dyd_format format = o->format;
  plot_format(&format, o->plot);
  const dyd_write_options how = {DYD_SIZED(dyd_write_options), .stages = ((const result *)what)->table};
  return dyd_write(out, NULL, DYD_CONTENT_PLOT, format, &how, err);
}

/* Table and plot, as far as they were made. */
static int write_results(const dyd_convergence *table, const dyd_engine *e, const cli_options *o) {
  const result r = {table, e};
  if (!table->count) return 0;
  int status = o->plot ? cli_write_file(o->plot, o, print_plot, &r) : 0;
  int written = cli_write_file(o->output, o, print_table, &r);
  return status ? status : written;
}

/* ---- a run ---- */

typedef struct run {
  const cli_options *o;
  dyd_convergence table;
  dyd_converge_options converge;
} run;

static dyd_status converge_run(dyd_engine *e, const dyd_engine_options *options, void *user, dyd_error *err) {
  run *r = user;
  return dyd_converge_run(&r->table, e, options, &r->converge, err);
}

/* The bounds of the diagram in the last row, for the note on the goal. */
static void take_bounds(dyd_voronoi_bounds *out, cli_session *s, const dyd_convergence *table) {
  const dyd_stage_row *last = table->count ? table->row[table->count - 1] : NULL;
  if (!last || !last->voronoi) return;
  dyd_dyadic_set(&out->area, &last->v_area);
  dyd_dyadic_set(&out->hausdorff, &last->v_hausdorff);
  out->finite = true;
  s->bounds = out;
}

/* The last row lacks bounds since no time was left for them: says so. Returns the exit status. */
static int note_cut(const dyd_convergence *table, const cli_options *o) {
  const dyd_stage_row *last = table->count ? table->row[table->count - 1] : NULL;
  if (!last || !cli_deadline_passed() || (last->bounded && (last->voronoi || !table->window))) return 0;
  if (!o->quiet)
    cli_complain("budget: the time is used up: bounds of stage %llu are left out; raise --timeout",
                 (unsigned long long)last->stage);
  return CLI_BUDGET;
}

/* A curve takes more points than geometric growth gives: says which steps do. */
static void note_steps(const dyd_convergence *table, const cli_options *o) {
  enum { FEW = 12, ENOUGH = 24 };
  if (!o->plot || o->quiet || o->engine.step_bits || !table->count || table->count >= FEW) return;
  int64_t bits = table->row[table->count - 1]->bits_most - table->row[0]->bits_most,
          step = (bits + ENOUGH - 1) / ENOUGH;
  if (bits <= 0) return;
  cli_complain("the plot has %zu stages, in which precision grows geometrically; --step-bits %lld draws up to %lld",
               table->count, (long long)step, (long long)(bits / step + 1));
}

static int converge_points(cli_options *o) {
  cli_session s = {.options = o};
  dyd_voronoi_bounds bounds;
  run r = {o, {DYD_SIZED(dyd_convergence)}, {DYD_SIZED(dyd_converge_options)}};
  dyd_rect window;
  dyd_engine_options options = o->engine;
  dyd_rect_init(&window);
  int status = o->window ? cli_window_read(&window, o->window) : 0;
  if (o->window) o->view = r.converge.window = &window;
  r.converge.no_voronoi = o->no_voronoi;
  if (o->of_voronoi) options.goal = cli_voronoi_goal(options.goal);
  if (!o->start_set) options.start_bits = 4;
  dyd_voronoi_bounds_init(&bounds);
  if (status == 0) status = cli_session_open(&s, o);
  if (status == 0) status = cli_history_open(o);
  if (status == 0) {
    s.converge = &r.converge;
    status = cli_session_run_by(&s, &options, converge_run, &r);
    cli_session_settle(&s);
    if (status == 0 && !r.table.count)
      cli_complain("%s before the first stage was complete: there is no result to write",
                   dyd_outcome_text(r.table.outcome));
    int written = write_results(&r.table, s.engine, o);
    if (status == 0) status = written;
    take_bounds(&bounds, &s, &r.table);
    note_steps(&r.table, o);
    if (status == 0) status = note_cut(&r.table, o);
  }
  status = cli_session_close(&s, status);
  dyd_voronoi_bounds_clear(&bounds);
  dyd_convergence_clear(&r.table);
  dyd_history_free(o->history);
  dyd_rect_clear(&window);
  return status;
}

/* ---- a replay ---- */

static int converge_replay(const cli_options *o) {
  FILE *in = cli_input_open(o->replay, "check the name of the trace");
  if (!in) return CLI_FAILED;
  dyd_convergence table = {DYD_SIZED(dyd_convergence)};
  const dyd_converge_options how = {DYD_SIZED(dyd_converge_options), .cancel = cli_deadline_flag()};
  dyd_error err;
  dyd_status st = dyd_trace_replay(&table, in, &how, &err);
  const bool late = st == DYD_CANCELLED;
  cli_input_close(in);
  if (late)
    cli_complain("the time is used up after %zu stages of the trace; raise --timeout", table.count);
  else if (st != DYD_OK)
    cli_complain_at(o->replay, &err);
  int status = st == DYD_E_NOMEM ? CLI_FAILED : write_results(&table, NULL, o);
  if (!status) status = late ? CLI_BUDGET : st != DYD_OK ? CLI_FAILED : cli_exit_status(table.outcome);
  dyd_convergence_clear(&table);
  return status;
}

int cli_converge(const cli_options *o) {
  dyd_format format;
  if (o->plot && !plot_format(&format, o->plot)) {
    cli_complain("--plot \"%s\" does not say what kind of picture is wanted; end it in .svg, .pdf or .png", o->plot);
    return CLI_USAGE;
  }
  if (o->label && !dyd_label_fits(o->label)) {
    cli_complain("--label \"%s\" is not understood; give NAME=VALUE,NAME=VALUE without quotes and "
                 "backslashes, names that differ, and none that is a column of the table",
                 o->label);
    return CLI_USAGE;
  }
  if (o->of_voronoi && o->no_voronoi) {
    cli_complain("--of voronoi needs the bounds that --no-voronoi leaves out; leave one of the two away");
    return CLI_USAGE;
  }
  if (o->replay && o->format == DYD_FORMAT_HTML) {
    cli_complain("html shows the points, which --replay does without; run converge on them");
    return CLI_USAGE;
  }
  cli_options own = *o; /* with window and history */
  return o->replay ? converge_replay(o) : converge_points(&own);
}
