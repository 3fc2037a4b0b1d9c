/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What commands share: an engine with the points, a run with progress and signals, a result file, exit statuses. */
#include "cli.h"
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- reading ---- */

static int session_read_file(dyd_engine *e, const cli_options *o, dyd_read_report *report) {
  FILE *in = cli_input_open(o->file, "check the name of the points file");
  if (!in) return CLI_FAILED;
  struct stat info;
  if (fstat(fileno(in), &info) == 0 && S_ISDIR(info.st_mode)) {
    cli_complain("%s: is a directory; give the name of a points file in it", o->file);
    cli_input_close(in);
    return CLI_FAILED;
  }
  dyd_error err;
  dyd_read_options read = o->read;
  read.report = report;
  dyd_status st = dyd_read_points(e, in, &read, &err);
  cli_input_close(in);
  if (st == DYD_E_ARG)
    cli_complain("%s", err.message);
  else if (st != DYD_OK)
    cli_complain_at(o->file, &err);
  return st == DYD_OK ? 0 : st == DYD_E_ARG ? CLI_USAGE : CLI_FAILED;
}

int cli_points_read(dyd_engine *e, const cli_options *o) {
  return o->oracle ? cli_oracle_read(e, o) : session_read_file(e, o, NULL);
}

/* Can all points be places on the globe? */
static bool points_are_degrees(const dyd_engine *e) {
  double b[4];
  bool good = dyd_engine_count(e) > 0;
  for (size_t i = 0; good && i < dyd_engine_count(e); i++) {
    if (!dyd_engine_knows(e, (uint32_t)i)) continue;
    dyd_sites_get_d(b, dyd_engine_sites(e), i);
    good = b[0] >= -180 && b[1] <= 180 && b[2] >= -90 && b[3] <= 90;
  }
  return good;
}

int cli_points_read_noting(dyd_engine *e, const cli_options *o) {
  if (o->oracle) return cli_oracle_read(e, o);
  dyd_read_report r = {DYD_SIZED(dyd_read_report)};
  int status = session_read_file(e, o, &r);
  if (status) return status;
  if (!r.rows) cli_note(o, "%s: there are no points in this file", o->file);
  if (r.missing)
    cli_note(o, "%s: %zu of %zu rows are left out, as a coordinate or radius is missing; the others keep their numbers",
             o->file, r.missing, r.rows);
  if (r.merged) cli_note(o, "%s: %zu rows are merged with earlier ones of equal coordinates", o->file, r.merged);
  if (r.shared)
    cli_note(o,
             "%s: %zu rectangles have the centre of another one, so that what is next to them stays undecided; if "
             "equal coordinates are one point, give --merge",
             o->file, r.shared);
  if (r.swapped && !o->plane)
    cli_note(
        o,
        "%s: by their names the columns are latitude and longitude, or northing and easting, and are taken as x and "
        "y: a mirrored map; give the column of y first, or --plane if that is meant",
        o->file);
  if (r.degrees && !o->sphere && !o->plane && points_are_degrees(e))
    cli_note(o,
             "%s: the columns are longitude and latitude by their names, and taken as coordinates in a plane; for "
             "neighbours on the globe give delaunay or voronoi --sphere; --plane says that the plane is meant",
             o->file);
  return 0;
}

int cli_session_open(cli_session *s, const cli_options *o) {
  *s = (cli_session){.options = o, .begun = cli_clock(), .share = 1};
  if (dyd_engine_new(&s->engine) != DYD_OK) return cli_complain_memory();
  s->progress = cli_progress_start(o->quiet);
  cli_progress_phase(s->progress, "reading");
  int status = cli_points_read_noting(s->engine, o);
  return status == 0 && o->resume ? cli_trace_resume(s) : status;
}

/* ---- running ---- */

int cli_session_run_by(cli_session *s, const dyd_engine_options *options, cli_run_fn run, void *user) {
  cli_progress_phase(s->progress, "triangulating");
  dyd_engine_options o = *options;
  o.seconds = cli_deadline_left(s->share);
  int status = cli_trace_attach(&o, s);
  if (status) return status;
  dyd_error err;
  dyd_error_clear(&err);
  cli_signals_cancel(s->engine);
  dyd_status st = run(s->engine, &o, user, &err);
  cli_signals_cancel(NULL);
  if (s->forgot) return cli_complain_memory();
  if (st == DYD_OK) return 0;
  cli_complain_of(s->engine, s->options->file, &err);
  return CLI_FAILED;
}

static dyd_status session_run_once(dyd_engine *e, const dyd_engine_options *options, void *user, dyd_error *err) {
  (void)user;
  dyd_outcome outcome;
  return dyd_engine_run(&outcome, e, options, err);
}

int cli_session_run(cli_session *s, const dyd_engine_options *options) {
  return cli_session_run_by(s, options, session_run_once, NULL);
}

int cli_exit_status(dyd_outcome outcome) {
  static const int status[] = {
      [DYD_OUTCOME_NONE] = CLI_FAILED,       [DYD_OUTCOME_DECIDED] = CLI_OK,    [DYD_OUTCOME_CERTIFIED] = CLI_OK,
      [DYD_OUTCOME_FIXPOINT] = CLI_FIXPOINT, [DYD_OUTCOME_BUDGET] = CLI_BUDGET, [DYD_OUTCOME_CANCELLED] = CLI_CANCELLED,
      [DYD_OUTCOME_ERROR] = CLI_FAILED};
  return status[outcome];
}

static const char *budget_advice(dyd_budget b) {
  switch (b) {
  case DYD_BUDGET_BITS:
    return "the precision is used up; raise --max-bits, unless the points are tied";
  case DYD_BUDGET_PAIRS:
    return "the cap on stored pairs was met; raise --max-pairs";
  case DYD_BUDGET_SECONDS:
    return "the time is used up; raise --timeout";
  default:
    return "the budget is used up";
  }
}

const char *cli_outcome_advice(const dyd_engine *e) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  switch (dyd_engine_outcome(e)) {
  case DYD_OUTCOME_FIXPOINT:
    return "nothing that is open can be refined: ties or fixed rectangles";
  case DYD_OUTCOME_BUDGET:
    dyd_engine_get_counters(&c, e, NULL);
    return budget_advice(c.spent);
  case DYD_OUTCOME_ERROR:
    return "a point failed; this much was known before";
  default:
    return "stopped on request";
  }
}

/* One line about a result that leaves something open. */
static void session_note_outcome(const cli_session *s) {
  const dyd_delaunay *pd = dyd_engine_delaunay(s->engine);
  dyd_outcome outcome = dyd_engine_outcome(s->engine);
  if (!pd || outcome == DYD_OUTCOME_DECIDED || outcome == DYD_OUTCOME_CERTIFIED) return;
  if (cli_note_goal(s, cli_outcome_advice(s->engine))) return;
  size_t count[4];
  dyd_delaunay_count(count, pd);
  cli_complain("%s: %zu legal, %zu indeterminate, %zu tie; %s", dyd_outcome_text(outcome), count[DYD_LEGAL],
               count[DYD_INDETERMINATE], count[DYD_TIE], cli_outcome_advice(s->engine));
}

/* ---- writing ---- */

/* Nothing is written since work was cut: says why. Exit status. */
static int write_was_cut(dyd_status st, const cli_options *o, const dyd_error *err) {
  if (cli_deadline_passed()) {
    cli_complain("budget: the time was used up before the result was known: nothing is written; raise --timeout");
    return CLI_BUDGET;
  }
  if (st == DYD_CAPPED)
    cli_complain_at(o->file, err);
  else
    cli_complain("cancelled before the result was known: nothing is written");
  return st == DYD_CAPPED ? CLI_BUDGET : CLI_CANCELLED;
}

int cli_write_file(const char *name, const cli_options *o, cli_print_fn print, const void *what) {
  cli_output out;
  if (!cli_output_open(&out, name)) return CLI_FAILED;
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status st = print(out.stream, what, o, &err);
  bool done = st == DYD_OK;
  if (st > 0) {
    cli_output_drop(&out);
    return write_was_cut(st, o, &err);
  }
  if (st == DYD_E_IO && !cli_output_note_reader(out.stream, name, o))
    cli_complain("%s: %s; choose another place with -o", name ? name : "standard output", err.message);
  else if (!done && st != DYD_E_IO)
    cli_complain_at(o->file, &err);
  if (done)
    done = cli_output_finish(&out, o);
  else
    cli_output_drop(&out);
  return done ? 0 : CLI_FAILED;
}

/* The graph of --layer, or nothing, beside the pairs. */
static dyd_status print_graph_certificate(FILE *out, const dyd_engine *e, const cli_options *o, dyd_error *err) {
  dyd_graph_list list = {0};
  dyd_certificate_parts parts = {DYD_SIZED(dyd_certificate_parts)};
  dyd_status st = DYD_OK;
  if (o->content == DYD_CONTENT_GRAPH_NEAREST || o->content == DYD_CONTENT_GRAPH_GABRIEL) {
    parts.kind = o->content == DYD_CONTENT_GRAPH_GABRIEL ? DYD_GRAPH_GABRIEL : DYD_GRAPH_NEAREST;
    parts.graph = &list;
    st = dyd_graph_edges(&list, dyd_engine_delaunay(e), (dyd_graph)parts.kind, cli_signals_flag(), err);
  }
  if (st == DYD_OK) st = dyd_write_certificate_parts(out, e, &parts, err);
  dyd_graph_list_clear(&list);
  return st;
}

static dyd_status session_print_certificate(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const dyd_rect *window = o->engine.window;
  return window ? dyd_write_voronoi_certificate(out, what, window, err) : print_graph_certificate(out, what, o, err);
}

void cli_session_settle(cli_session *s) {
  cli_progress_phase(s->progress, "writing");
  if (s->options->output || !isatty(STDOUT_FILENO)) return;
  cli_progress_stop(s->progress);
  s->progress = NULL;
}

int cli_session_certificate(cli_session *s, int status, cli_print_fn print, const void *what) {
  const char *certificate = s->options->certificate;
  if (!certificate || (status && !cli_output_lost_reader())) return status;
  if (cli_deadline_passed()) {
    cli_complain("budget: the time is used up, so no certificate is written; raise --timeout");
    return CLI_BUDGET;
  }
  cli_progress_phase(s->progress, "the certificate");
  int written = cli_write_file(certificate, s->options, print, what);
  return status ? status : written;
}

int cli_session_write(cli_session *s, cli_print_fn print) {
  cli_session_settle(s);
  if (!dyd_engine_delaunay(s->engine)) {
    cli_complain("%s before the first triangulation was complete: there is no result to write",
                 dyd_outcome_text(dyd_engine_outcome(s->engine)));
    return 0;
  }
  int status = cli_write_file(s->options->output, s->options, print, s->engine);
  return cli_session_certificate(s, status, session_print_certificate, s->engine);
}

/* Without a result, no budget but that of time was there. */
static bool session_is_late(const dyd_engine *e) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_engine_get_counters(&c, e, NULL);
  return dyd_engine_outcome(e) == DYD_OUTCOME_BUDGET && (!dyd_engine_delaunay(e) || c.spent == DYD_BUDGET_SECONDS);
}

bool cli_run_was_whole(const dyd_engine *e) {
  return dyd_engine_delaunay(e) && dyd_engine_outcome(e) != DYD_OUTCOME_CANCELLED && !session_is_late(e);
}

dyd_status cli_session_cut(dyd_status st, const dyd_error *err) {
  bool late = cli_deadline_passed();
  if (st != DYD_CANCELLED) return st;
  cli_complain("%s: %s%s", late ? "budget" : "cancelled", err->message, late ? "; raise --timeout" : "");
  return DYD_OK;
}

int cli_exit_cut(void) {
  return cli_deadline_passed() ? CLI_BUDGET : CLI_CANCELLED;
}

/* The engine may see the end of time a little before the flag is raised. */
int cli_session_stopped(const cli_session *s, const char *what) {
  bool late = cli_deadline_passed() || session_is_late(s->engine);
  cli_complain("%s before %s known: there is no result to write%s", late ? "budget: the time was used up" : "cancelled",
               what, late ? "; raise --timeout" : "");
  return late ? CLI_BUDGET : CLI_CANCELLED;
}

int cli_session_close(cli_session *s, int status) {
  const cli_options *o = s->options;
  cli_progress_stop(s->progress);
  if (s->engine) {
    dyd_outcome outcome = dyd_engine_outcome(s->engine);
    int traced = cli_trace_end(s, outcome);
    if (status == 0) status = traced ? traced : cli_exit_status(outcome);
    if (!o->quiet && status != CLI_OK && status != CLI_USAGE) session_note_outcome(s);
    cli_note_aliases(dyd_engine_delaunay(s->engine), o);
    if (status != CLI_OK && status != CLI_USAGE) cli_note_spacing(dyd_engine_delaunay(s->engine), o);
    if (o->stats && outcome != DYD_OUTCOME_NONE) cli_stats(stderr, s->engine, NULL, s->discs, cli_clock() - s->begun);
  }
  cli_deadline_written(status);
  dyd_engine_free(s->engine);
  *s = (cli_session){0};
  return status;
}

int cli_session_all(const cli_options *o, cli_print_fn print) {
  cli_session s;
  int status = cli_session_open(&s, o);
  if (status == 0) {
    status = cli_session_run(&s, &o->engine);
    /* What was stated before a point failed stays true: it is written, and the exit status tells of the failure. */
    if (status == 0 || dyd_engine_delaunay(s.engine)) {
      int written = cli_session_write(&s, print);
      if (status == 0) status = written;
    }
  }
  return cli_session_close(&s, status);
}
