/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel nearest FILE X Y, nearest --queries PLACES FILE: which points are surely, which are possibly nearest to a
 * place, or to each of many. */
#include "cli.h"
#include <stdlib.h>
#include <string.h>

/* A place, and what was found of it. */
typedef struct place {
  dyd_stream *at;
  dyd_nearest_answer answer;
  dyd_index_list found;
} place;

typedef struct query {
  const cli_options *options;
  const dyd_engine *engine;
  place *place;
  size_t count, answered; /* places; those of the first that are answered */
  double end;             /* of the time given, on cli_clock */
  dyd_outcome outcome;    /* of all */
} query;

/* ---- the places ---- */

static int read_real(dyd_real **out, const char *name, const char *text) {
  dyd_error err;
  memset(&err, 0, sizeof err);
  dyd_status st = dyd_real_parse(out, text, strlen(text), &err);
  if (st >= 0) return 0;
  if (st == DYD_E_NOMEM) return cli_complain_memory();
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

static int places_reserve(query *q, size_t count) {
  q->place = calloc(count ? count : 1, sizeof *q->place);
  if (!q->place) return cli_complain_memory();
  q->count = count;
  return 0;
}

/* The points of the file become places: streams that stay when their engine goes. */
static int places_read_file(query *q, dyd_engine *from) {
  cli_options file = {.file = q->options->queries, .read = {DYD_SIZED(dyd_read_options)}};
  int status = cli_points_read(from, &file);
  if (!status) status = places_reserve(q, dyd_engine_count(from));
  for (size_t k = 0; k < q->count && !status; k++)
    if (dyd_engine_stream(&q->place[k].at, from, (uint32_t)k) != DYD_OK) status = cli_complain_memory();
  return status;
}

static int places_read(query *q) {
  const cli_options *o = q->options;
  dyd_engine *from = NULL;
  if (!o->queries) {
    int status = places_reserve(q, 1);
    return status ? status : read_place(&q->place[0].at, o);
  }
  if (o->file && strcmp(o->file, "-") == 0 && strcmp(o->queries, "-") == 0) {
    cli_complain("points and places cannot both come from standard input; give the name of a file for one of them");
    return CLI_USAGE;
  }
  int status = dyd_engine_new(&from) == DYD_OK ? places_read_file(q, from) : cli_complain_memory();
  dyd_engine_free(from);
  return status;
}

static void places_clear(query *q) {
  for (size_t k = 0; k < q->count; k++) {
    dyd_index_list_clear(&q->place[k].found);
    dyd_stream_free(q->place[k].at);
  }
  free(q->place);
}

/* ---- the answers ---- */

/* The outcome of all is the one that leaves most to be done. */
static dyd_outcome worse_outcome(dyd_outcome a, dyd_outcome b) {
  return a > b ? a : b;
}

/* An error at a place names it. */
static dyd_status name_place(dyd_status st, size_t k, const query *q, dyd_error *err) {
  char message[sizeof err->message];
  if (st == DYD_OK || !q->options->queries || err->point < dyd_engine_count(q->engine)) return st;
  snprintf(message, sizeof message, "%s", err->message);
  err->point = DYD_NO_POINT;
  snprintf(err->message, sizeof err->message, "place %zu of %s: %.180s", k, q->options->queries, message);
  return st;
}

static dyd_status answer_place(query *q, size_t k, dyd_engine *e, const dyd_engine_options *o, dyd_error *err) {
  place *p = &q->place[k];
  dyd_outcome outcome;
  bool sure;
  dyd_status st = dyd_engine_nearest(&p->found, &sure, &outcome, e, p->at, o, err);
  if (st != DYD_OK) return name_place(st, k, q, err);
  p->answer = (dyd_nearest_answer){DYD_SIZED(dyd_nearest_answer), dyd_stream_rect(p->at), &p->found, sure, outcome,
                                   dyd_engine_nearest_tied(e)};
  q->answered++;
  q->outcome = worse_outcome(q->outcome, outcome);
  return DYD_OK;
}

/* The first triangulation serves as an index; the queries refine whom they need. Of the first place it is at least
 * looked who may be nearest, also when there is no time left or a signal asked to stop. */
static dyd_status answer(dyd_engine *e, const dyd_engine_options *options, void *user, dyd_error *err) {
  query *q = user;
  dyd_engine_options o = *options;
  o.max_stages = 1;
  dyd_outcome first;
  dyd_status st = dyd_engine_run(&first, e, &o, err);
  q->outcome = st == DYD_OK && dyd_engine_delaunay(e) ? DYD_OUTCOME_DECIDED : first;
  if (q->outcome != DYD_OUTCOME_DECIDED) return st;
  if (first == DYD_OUTCOME_CANCELLED) dyd_engine_cancel(e);
  for (size_t k = 0; k < q->count && st == DYD_OK; k++) {
    double left = q->end - cli_clock();
    if (o.seconds > 0) o.seconds = left > 1e-3 ? left : 1e-3;
    st = answer_place(q, k, e, &o, err);
    if (q->outcome == DYD_OUTCOME_CANCELLED) break;
    if (o.seconds > 0 && left <= 0 && q->answered < q->count) {
      q->outcome = DYD_OUTCOME_BUDGET;
      break;
    }
  }
  return st;
}

/* ---- output ---- */

static const dyd_nearest_answer **list_answers(const query *q) {
  const dyd_nearest_answer **list = malloc((q->answered + 1) * sizeof(const dyd_nearest_answer *));
  for (size_t k = 0; list && k < q->answered; k++) list[k] = &q->place[k].answer;
  return list;
}

static dyd_status write_answer(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const query *q = what;
  const dyd_nearest_answer **list = list_answers(q);
  if (!list) return DYD_E_NOMEM;
  const dyd_write_options how = {DYD_SIZED(dyd_write_options), .answer = list, .answers = q->answered,
                                 .outcome = q->outcome};
  dyd_status st = dyd_write(out, q->engine, o->content, o->format, &how, err);
  free(list);
  return st;
}

static dyd_status write_near_certificate(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const query *q = what;
  const dyd_nearest_answer **list = list_answers(q);
  (void)o;
  if (!list) return DYD_E_NOMEM;
  dyd_status st = dyd_write_nearest_certificate(out, q->engine, list, q->answered, q->outcome, err);
  free(list);
  return st;
}

static const char *nearest_reason(dyd_outcome outcome) {
  if (outcome == DYD_OUTCOME_FIXPOINT) return "no refinement can decide: ties or fixed rectangles";
  if (outcome == DYD_OUTCOME_BUDGET)
    return "the precision or time is used up; raise --max-bits or --timeout, unless the distances are equal";
  return "stopped on request";
}

static void note_outcome(const query *q) {
  size_t open = 0;
  if (q->outcome == DYD_OUTCOME_DECIDED) return;
  const char *outcome = dyd_outcome_text(q->outcome), *why = nearest_reason(q->outcome);
  if (!q->options->queries && q->place[0].answer.tied) why = "no refinement can decide: they are equally far, a tie";
  if (!q->options->queries) {
    cli_complain("%s: %zu possibly nearest; %s", outcome, q->place[0].found.count, why);
    return;
  }
  for (size_t k = 0; k < q->answered; k++) open += !q->place[k].answer.sure;
  if (q->answered < q->count)
    cli_complain("%s: only the first %zu of %zu places are answered, %zu of them without a sure nearest point; %s",
                 outcome, q->answered, q->count, open, why);
  else
    cli_complain("%s: %zu of %zu places have no sure nearest point; %s", outcome, open, q->count, why);
}

/* ---- the command ---- */

/* The session with the places known. */
static int ask(cli_session *s, query *q, const cli_options *o) {
  q->engine = s->engine;
  q->end = cli_clock() + o->engine.seconds;
  int status = cli_session_run_by(s, &o->engine, answer, q);
  if (status) return status;
  cli_session_settle(s);
  if (q->answered == q->count || q->answered)
    status = cli_write_file(o->output, o, write_answer, q);
  else
    cli_complain("%s before the points were known: there is no result to write", dyd_outcome_text(q->outcome));
  if (q->answered) status = cli_session_certificate(s, status, write_near_certificate, q);
  return status ? status : cli_exit_status(q->outcome);
}

int cli_nearest(const cli_options *o) {
  cli_session s;
  cli_options own = *o;
  query q = {.options = o, .outcome = DYD_OUTCOME_NONE};
  int status = places_read(&q);
  if (!status) {
    status = cli_session_open(&s, &own);
    if (!status) {
      status = ask(&s, &q, o);
      own.quiet = true; /* notes on the triangulation would mislead */
      bool known = q.answered && status == cli_exit_status(q.outcome);
      cli_session_close(&s, status);
      if (known && !o->quiet) note_outcome(&q);
    } else {
      status = cli_session_close(&s, status);
    }
  }
  places_clear(&q);
  return status;
}
