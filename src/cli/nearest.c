/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel nearest FILE X Y: which points are surely, which are possibly nearest to a place. */
#include "cli.h"
#include <stdlib.h>
#include <string.h>

typedef struct query {
  dyd_stream *at;
  double end; /* of the time given, on cli_clock; 0: none */
  bool sure;
  dyd_outcome outcome; /* DYD_OUTCOME_NONE: there is no answer */
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
  if (status) {
    dyd_real_free(x);
    return status;
  }
  if (dyd_stream_from_reals(out, x, y) >= 0) return 0;
  cli_complain("memory is exhausted; close other programs");
  return CLI_FAILED;
}

/* ---- the answer ---- */

/* The first triangulation serves as an index; the query refines whom it needs. */
static dyd_status answer(dyd_engine *e, const dyd_engine_options *options, void *user, dyd_error *err) {
  query *q = user;
  dyd_engine_options o = *options;
  dyd_outcome outcome;
  o.max_stages = 1;
  dyd_status status = dyd_engine_run(&outcome, e, &o, err);
  q->outcome = outcome == DYD_OUTCOME_CANCELLED ? outcome : DYD_OUTCOME_BUDGET;
  if (status < 0 || outcome == DYD_OUTCOME_CANCELLED || !dyd_engine_delaunay(e)) return status;
  if (o.seconds > 0) {
    o.seconds = q->end - cli_clock();
    if (o.seconds <= 0) o.seconds = 1e-3;
  }
  return dyd_engine_nearest(&q->found, &q->sure, &q->outcome, e, q->at, &o, err);
}

/* ---- output ---- */

static void write_aliases(FILE *out, const dyd_delaunay *pd, const char *form, const char *between) {
  bool any = false;
  for (size_t i = 0; i < dyd_sites_count(dyd_delaunay_sites(pd)); i++) {
    uint32_t of = dyd_delaunay_alias(pd, (uint32_t)i);
    if (of == i) continue;
    if (any) fputs(between, out);
    fprintf(out, form, i, (unsigned)of);
    any = true;
  }
}

/* An end of an interval, exactly: m*2^e, or p/q for a rational point. */
static dyd_status write_end(FILE *out, const dyd_interval *a, const dyd_dyadic *end) {
  if (mpz_cmp_ui(a->den, 1) == 0) {
    char *text = dyd_dyadic_get_str(end);
    if (!text) return DYD_E_NOMEM;
    fprintf(out, "\"%s\"", text);
    free(text);
    return DYD_OK;
  }
  mpq_t lo, hi;
  mpq_init(lo);
  mpq_init(hi);
  dyd_interval_get_q(lo, hi, a);
  fputc('"', out);
  mpq_out_str(out, 10, lo);
  fputc('"', out);
  mpq_clear(hi);
  mpq_clear(lo);
  return DYD_OK;
}

static dyd_status write_interval(FILE *out, const char *name, const dyd_interval *a) {
  fprintf(out, "\"%s\": [", name);
  dyd_status status = write_end(out, a, &a->lo);
  fputs(", ", out);
  if (status >= 0) status = write_end(out, a, &a->hi);
  fputs("],\n", out);
  return status;
}

static const char *status_text(const query *q) {
  return q->sure ? "sure" : "possible";
}

static dyd_status write_json(FILE *out, const query *q) {
  const dyd_rect *r = dyd_stream_rect(q->at);
  fprintf(out, "{\"format\": \"dyadel nearest 1\",\n\"version\": \"%s\",\n\"outcome\": \"%s\",\n", dyd_version(),
          dyd_outcome_text(q->outcome));
  dyd_status status = write_interval(out, "x", &r->x);
  if (status >= 0) status = write_interval(out, "y", &r->y);
  fputs("\"nearest\": [", out);
  for (size_t k = 0; k < q->found.count; k++)
    fprintf(out, "%s\n{\"i\": %u, \"status\": \"%s\"}", k ? "," : "", (unsigned)q->found.item[k], status_text(q));
  fputs("\n],\n\"aliases\": [", out);
  write_aliases(out, dyd_engine_delaunay(q->engine), "[%zu, %u]", ", ");
  fputs("]}\n", out);
  return status;
}

static dyd_status write_answer(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const query *q = what;
  dyd_status status = DYD_OK;
  if (o->format == DYD_FORMAT_JSON) {
    status = write_json(out, q);
  } else {
    write_aliases(out, dyd_engine_delaunay(q->engine), "# alias %zu %u\n", "");
    fputs("i,status\n", out);
    for (size_t k = 0; k < q->found.count; k++) fprintf(out, "%u,%s\n", (unsigned)q->found.item[k], status_text(q));
  }
  if (status >= 0) return DYD_OK;
  snprintf(err->message, sizeof err->message, "%s", dyd_status_text(status));
  return status;
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
  bool known = dyd_engine_delaunay(s->engine) && dyd_stream_rect(q->at);
  if (known) status = cli_write_file(o->output, o, write_answer, q);
  if (!known)
    cli_complain("%s before the points were known: there is no result to write", dyd_outcome_text(q->outcome));
  if (known && !status && !o->quiet) note_outcome(q);
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
  dyd_index_list_clear(&q.found);
  dyd_stream_free(q.at);
  return answered ? status : end;
}
