/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel plan FILE: what to measure next. */
#include "cli.h"
#include <stdlib.h>

typedef struct plan_run {
  dyd_survey *survey;
  const dyd_engine *engine;
  dyd_survey_options options;
  mpq_t accuracy;
  dyd_rect window;
  dyd_pair_list pairs;
  size_t *line; /* of each pair in its file */
  uint32_t site;
  double *cost;
} plan_run;

/* ---- what is asked ---- */

static bool plan_add_pair(plan_run *r, uint32_t i, uint32_t j, size_t line) {
  dyd_pair_list *l = &r->pairs;
  if (l->count % 1024 == 0) {
    dyd_pair *more = realloc(l->item, (l->count + 1024) * sizeof *more);
    if (more) l->item = more;
    size_t *lines = realloc(r->line, (l->count + 1024) * sizeof *lines);
    if (lines) r->line = lines;
    if (!more || !lines) return false;
  }
  r->line[l->count] = line;
  l->item[l->count++] = (dyd_pair){i < j ? i : j, i < j ? j : i, DYD_INDETERMINATE};
  return true;
}

/* Where the ends of a pair are in a row; set by a header. */
typedef struct pairs_columns {
  plan_run *run;
  bool begun;
  size_t column[2];
} pairs_columns;

/* A header names the columns i and j; other columns may stand anywhere. */
static bool pairs_header(pairs_columns *p, const dyd_record *row) {
  bool found[2] = {false, false};
  for (size_t k = 0; k < row->fields; k++) {
    size_t length;
    const char *name = dyd_record_field(&length, row, k);
    for (size_t end = 0; end < 2; end++)
      if (length == 1 && *name == "ij"[end]) found[end] = true, p->column[end] = k;
  }
  return found[0] && found[1];
}

static dyd_status pairs_refuse(const dyd_record *row, size_t field, dyd_error *err) {
  dyd_record_place(err, row, field);
  return dyd_error_set(err, DYD_E_PARSE,
                       "this is no pair of different points; give their numbers i,j first, or name the columns i and j "
                       "in a header");
}

static dyd_status pairs_row(void *user, const dyd_record *row, dyd_error *err) {
  pairs_columns *p = user;
  int64_t end[2];
  const bool header = !p->begun && pairs_header(p, row);
  p->begun = true;
  if (header) return DYD_OK;
  for (size_t k = 0; k < 2; k++)
    if (!dyd_record_integer(&end[k], row, p->column[k], 0, UINT32_MAX)) return pairs_refuse(row, p->column[k], err);
  if (end[0] == end[1]) return pairs_refuse(row, p->column[1], err);
  dyd_record_place(err, row, p->column[0]);
  if (plan_add_pair(p->run, (uint32_t)end[0], (uint32_t)end[1], err->line)) return DYD_OK;
  return dyd_error_set(err, DYD_E_NOMEM, dyd_status_text(DYD_E_NOMEM));
}

static int pairs_read(plan_run *r, const char *file) {
  pairs_columns columns = {.run = r, .column = {0, 1}};
  dyd_error err;
  FILE *in = cli_input_open(file, "check the name of the file of pairs");
  if (!in) return CLI_FAILED;
  dyd_status st = dyd_read_records(in, 0, pairs_row, &columns, &err);
  cli_input_close(in);
  if (st != DYD_OK) cli_complain_at(file, &err);
  return st == DYD_OK ? 0 : CLI_FAILED;
}

static int plan_options(plan_run *r, const cli_options *o) {
  int status = o->accuracy ? cli_number_read(r->accuracy, "accuracy", o->accuracy) : 0;
  if (!status && o->accuracy && mpq_sgn(r->accuracy) == 0) {
    cli_complain("--accuracy \"%s\" is not understood; nothing is measured exactly: give a number above 0",
                 o->accuracy);
    status = CLI_USAGE;
  }
  if (!status && o->window) status = cli_window_read(&r->window, o->window);
  if (!status && o->pairs) status = pairs_read(r, o->pairs);
  r->site = o->site;
  r->options = (dyd_survey_options){DYD_SIZED(dyd_survey_options),
                                    .pairs = o->pairs ? &r->pairs : NULL,
                                    .window = o->window ? &r->window : NULL,
                                    .site = o->site_set ? &r->site : NULL,
                                    .accuracy = o->accuracy ? r->accuracy : NULL,
                                    .cancel = cli_signals_flag()};
  return status;
}

/* ---- the plan ---- */

static dyd_status plan_write(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const plan_run *r = what;
  const dyd_write_options how = {DYD_SIZED(dyd_write_options), .plan = r->survey, .next = o->next, .epsg = o->epsg};
  return dyd_write(out, r->engine, o->content, o->format, &how, err);
}

/* Points are named by their rows in the file; the number of that point, one that does not exist where there is none. */
static uint32_t point_of_row(const dyd_engine *e, uint32_t row) {
  size_t lo = 0, hi = dyd_engine_count(e);
  while (lo < hi) {
    size_t mid = lo + (hi - lo) / 2;
    if (dyd_engine_row(e, mid) < row)
      lo = mid + 1;
    else
      hi = mid;
  }
  return lo < dyd_engine_count(e) && dyd_engine_row(e, lo) == row ? (uint32_t)lo : UINT32_MAX;
}

/* Pairs and site: from rows to points. */
static int plan_find_points(plan_run *r, const dyd_engine *e, const cli_options *o) {
  if (o->site_set && (r->site = point_of_row(e, r->site)) == UINT32_MAX) {
    cli_complain("there is no point %lu; give --site the number of one, from 0", (unsigned long)o->site);
    return CLI_FAILED;
  }
  for (size_t k = 0; k < r->pairs.count; k++) {
    uint32_t *end[2] = {&r->pairs.item[k].i, &r->pairs.item[k].j};
    for (int x = 0; x < 2; x++) {
      unsigned long row = *end[x];
      if ((*end[x] = point_of_row(e, *end[x])) != UINT32_MAX) continue;
      cli_complain("%s:%zu: there is no point %lu; give pairs of points that are there, numbered from 0", o->pairs,
                   r->line[k], row);
      return CLI_FAILED;
    }
  }
  return 0;
}

/* Of every point, where a column of costs was read. */
static dyd_status plan_costs(plan_run *r, const dyd_engine *e) {
  size_t n = dyd_engine_count(e);
  r->cost = malloc((n + 1) * sizeof *r->cost);
  if (!r->cost) return DYD_E_NOMEM;
  for (size_t i = 0; i < n; i++) r->cost[i] = dyd_engine_cost(e, i);
  r->options.cost = r->cost;
  return DYD_OK;
}

static dyd_status plan_find(dyd_engine *e, const dyd_engine_options *options, void *user, dyd_error *err) {
  plan_run *r = user;
  dyd_outcome outcome;
  dyd_status st = dyd_engine_run(&outcome, e, options, err);
  if (st != DYD_OK || !cli_run_was_whole(e)) return st;
  st = plan_costs(r, e);
  if (st == DYD_OK) st = dyd_survey_new(&r->survey, dyd_engine_delaunay(e), &r->options, err);
  return r->survey ? cli_session_cut(st, err) : st == DYD_CANCELLED ? DYD_OK : st;
}

static int plan_session(cli_session *s, plan_run *r, const cli_options *o) {
  size_t open, ties, left;
  r->engine = s->engine;
  int status = plan_find_points(r, s->engine, o);
  if (!status) status = cli_session_run_by(s, &o->engine, plan_find, r);
  cli_session_settle(s);
  if (status) return status;
  if (!r->survey) return cli_session_stopped(s, "the plan was");
  status = cli_write_file(o->output, o, plan_write, r);
  dyd_survey_count(&open, &ties, &left, r->survey);
  if (!status && dyd_survey_is_cut(r->survey)) return cli_exit_cut();
  if (status || !left) return status;
  if (!o->quiet) cli_complain("%zu of %zu pairs stay open with this plan; give a finer --accuracy", left, open);
  return CLI_FIXPOINT;
}

int cli_plan(const cli_options *o) {
  plan_run r = {0};
  cli_options own = *o;
  cli_session s;
  mpq_init(r.accuracy);
  dyd_rect_init(&r.window);
  int status = plan_options(&r, o);
  if (!status) {
    status = cli_session_open(&s, &own);
    if (!status) status = plan_session(&s, &r, o);
    own.quiet = true; /* what is open now is what the plan is about */
    dyd_survey_free(r.survey);
    cli_session_close(&s, status ? status : CLI_USAGE);
  }
  free(r.cost);
  free(r.line);
  dyd_pair_list_clear(&r.pairs);
  dyd_rect_clear(&r.window);
  mpq_clear(r.accuracy);
  return status;
}
