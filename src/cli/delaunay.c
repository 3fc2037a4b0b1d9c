/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel delaunay FILE: read, run, write. */
#include "cli.h"
#include <errno.h>
#include <string.h>

/* "FILE:LINE:COLUMN: message" as far as it is known. */
static void complain_at(const char *file, const dyd_error *err) {
  char point[40] = "";
  if (err->point != DYD_NO_POINT) snprintf(point, sizeof point, "point %zu: ", err->point);
  if (err->line)
    cli_complain("%s:%zu:%zu: %s%s", file, err->line, err->column, point, err->message);
  else
    cli_complain("%s: %s%s", file, point, err->message);
}

static int read_points(dyd_engine *e, const cli_options *o) {
  bool standard = strcmp(o->file, "-") == 0;
  FILE *in = standard ? stdin : fopen(o->file, "rb");
  if (!in) {
    cli_complain("%s: cannot open: %s; check the name of the points file", o->file, strerror(errno));
    return CLI_FAILED;
  }
  dyd_error err;
  dyd_status status = dyd_read_points(e, in, &o->read, &err);
  if (!standard) fclose(in);
  if (status == DYD_E_ARG) {
    cli_complain("%s", err.message);
    return CLI_USAGE;
  }
  if (status < 0) complain_at(o->file, &err);
  return status < 0 ? CLI_FAILED : 0;
}

static int exit_status(dyd_outcome outcome) {
  switch (outcome) {
  case DYD_OUTCOME_DECIDED:
  case DYD_OUTCOME_CERTIFIED:
    return CLI_OK;
  case DYD_OUTCOME_FIXPOINT:
    return CLI_FIXPOINT;
  case DYD_OUTCOME_BUDGET:
    return CLI_BUDGET;
  case DYD_OUTCOME_CANCELLED:
    return CLI_CANCELLED;
  default:
    return CLI_FAILED;
  }
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

/* One line about a result that leaves something open. */
static void note_outcome(const dyd_engine *e) {
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  dyd_outcome outcome = dyd_engine_outcome(e);
  if (!pd || outcome == DYD_OUTCOME_DECIDED || outcome == DYD_OUTCOME_CERTIFIED) return;
  dyd_engine_counters c;
  size_t count[4];
  dyd_engine_get_counters(&c, e);
  dyd_delaunay_count(count, pd);
  const char *why = "stopped on request";
  if (outcome == DYD_OUTCOME_FIXPOINT) why = "no refinement can decide the rest: exact ties or fixed rectangles";
  if (outcome == DYD_OUTCOME_BUDGET) why = budget_advice(c.spent);
  cli_complain("%s: %zu legal, %zu indeterminate, %zu tie; %s", dyd_outcome_text(outcome), count[DYD_LEGAL],
               count[DYD_INDETERMINATE], count[DYD_TIE], why);
}

static int write_result(const dyd_engine *e, const cli_options *o) {
  if (!dyd_engine_delaunay(e)) {
    cli_complain("%s before the first triangulation was complete: there is no result to write",
                 dyd_outcome_text(dyd_engine_outcome(e)));
    return 0;
  }
  cli_output out;
  if (!cli_output_open(&out, o->output)) return CLI_FAILED;
  dyd_error err;
  dyd_status status = dyd_write_delaunay(out.stream, e, o->format, &err);
  bool done = status >= 0;
  if (!done) complain_at(o->output ? o->output : "standard output", &err);
  cli_signals_remove(NULL);
  if (done)
    done = cli_output_finish(&out);
  else
    cli_output_drop(&out);
  return done ? 0 : CLI_FAILED;
}

static int run(dyd_engine *e, const cli_options *o, cli_progress *progress) {
  cli_progress_phase(progress, "reading");
  int status = read_points(e, o);
  if (status) return status;
  cli_progress_phase(progress, "triangulating");
  dyd_engine_options options = o->engine;
  options.progress = cli_progress_stage;
  options.progress_user = progress;
  dyd_outcome outcome;
  dyd_error err;
  dyd_error_clear(&err);
  cli_signals_cancel(e);
  dyd_status done = dyd_engine_run(&outcome, e, &options, &err);
  cli_signals_remove(NULL);
  if (done < 0) {
    complain_at(o->file, &err);
    return CLI_FAILED;
  }
  cli_progress_phase(progress, "writing");
  status = write_result(e, o);
  return status ? status : exit_status(outcome);
}

int cli_delaunay(const cli_options *o) {
  double begun = cli_clock();
  dyd_engine *e = NULL;
  if (dyd_engine_new(&e) < 0) {
    cli_complain("memory is exhausted; close other programs");
    return CLI_FAILED;
  }
  cli_progress *progress = cli_progress_start(o->quiet);
  int status = run(e, o, progress);
  cli_progress_stop(progress);
  if (!o->quiet && (status == CLI_FIXPOINT || status == CLI_BUDGET || status == CLI_CANCELLED)) note_outcome(e);
  if (o->stats && dyd_engine_outcome(e) != DYD_OUTCOME_NONE) cli_stats(stderr, e, cli_clock() - begun);
  dyd_engine_free(e);
  return status;
}
