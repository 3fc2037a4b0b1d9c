/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel nearest FILE X Y: which points are surely, which are possibly nearest to a place. */
#include "cli.h"
#include <stdlib.h>
#include <string.h>

typedef struct query {
  dyd_stream *at;
  double end;       /* of the time given, on cli_clock; 0: none */
  bool known, sure; /* is there an answer? */
  dyd_outcome outcome;
  dyd_index_list found;
  const dyd_engine *engine;
} query;

/* ---- the place ---- */

static int read_real(dyd_real **out, const char *name, const char *text) {
  dyd_error err;
  memset(&err, 0, sizeof err);
  if (dyd_real_parse(out, text, strlen(text), &err) >= 0) return 0;
  cli_complain("%s \"%s\", column %zu: %s", name, text, err.column, err.message);
  return CLI_USAGE;
}

static int read_place(dyd_stream **out, const cli_options *o) {
  dyd_real *x = NULL, *y = NULL;
  int status = read_real(&x, "X", o->at[0]);
  if (!status) status = read_real(&y, "Y", o->at[1]);
  if (!status) return dyd_stream_from_reals(out, x, y) == DYD_OK ? 0 : cli_complain_memory();
  dyd_real_free(x);
  return status;
}

/* ---- the answer ---- */

/* The first triangulation serves as an index; the query refines whom it needs. Cancelled before, it only looks. */
static dyd_status answer(dyd_engine *e, const dyd_engine_options *options, void *user, dyd_error *err) {
  query *q = user;
  dyd_engine_options o = *options;
  o.max_stages = 1;
  dyd_status st = dyd_engine_run(&q->outcome, e, &o, err);
  if (st != DYD_OK || !dyd_engine_delaunay(e)) return st;
  if (q->outcome == DYD_OUTCOME_CANCELLED) dyd_engine_cancel(e);
  if (o.seconds > 0) {
    o.seconds = q->end - cli_clock();
    if (o.seconds <= 0) o.seconds = 1e-3;
  }
  st = dyd_engine_nearest(&q->found, &q->sure, &q->outcome, e, q->at, &o, err);
  q->known = st == DYD_OK;
  return st;
}

/* ---- output ---- */

static dyd_status write_answer(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const query *q = what;
  const dyd_nearest_answer a = {sizeof a, dyd_stream_rect(q->at), &q->found, q->sure, q->outcome};
  return dyd_write_nearest(out, q->engine, &a, o->format, err);
}

static void note_outcome(const query *q) {
  if (q->outcome == DYD_OUTCOME_DECIDED) return;
  const char *why = "stopped on request";
  if (q->outcome == DYD_OUTCOME_FIXPOINT) why = "no refinement can decide: an exact tie or fixed rectangles";
  if (q->outcome == DYD_OUTCOME_BUDGET)
    why = "the precision or time is used up; raise --max-bits or --timeout, unless the distances are equal";
  cli_complain("%s: %zu possibly nearest; %s", dyd_outcome_text(q->outcome), q->found.count, why);
}

/* ---- the command ---- */

/* The session with the place known. */
static int ask(cli_session *s, query *q, const cli_options *o) {
  q->engine = s->engine;
  q->end = cli_clock() + o->engine.seconds;
  int status = cli_session_run_by(s, &o->engine, answer, q);
  if (status) return status;
  cli_session_settle(s);
  if (q->known) status = cli_write_file(o->output, o, write_answer, q);
  if (!q->known)
    cli_complain("%s before the points were known: there is no result to write", dyd_outcome_text(q->outcome));
  return status ? status : cli_exit_status(q->outcome);
}

int cli_nearest(const cli_options *o) {
  cli_session s;
  cli_options own = *o;
  query q = {.outcome = DYD_OUTCOME_NONE};
  int status = read_place(&q.at, o);
  if (status) return status;
  status = cli_session_open(&s, &own);
  bool answered = !status;
  if (answered) {
    status = ask(&s, &q, o);
    own.quiet = true; /* notes on the triangulation would mislead */
  }
  int end = cli_session_close(&s, status);
  if (q.known && status == cli_exit_status(q.outcome) && !o->quiet) note_outcome(&q);
  dyd_index_list_clear(&q.found);
  dyd_stream_free(q.at);
  return answered ? status : end;
}
