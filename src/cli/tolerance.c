/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel tolerance FILE: how far the points may move; dyadel plan FILE: the points to measure next. */
#include "cli.h"

#include <stdlib.h>

/* A number of each point, as its row says. NULL: memory is exhausted. */
static double *of_each_point(const dyd_engine *e, dyd_row_number which) {
  size_t n = dyd_engine_count(e);
  double *out = malloc((n + 1) * sizeof *out);
  for (size_t i = 0; out && i < n; i++) out[i] = dyd_engine_number(e, i, which);
  return out;
}

/* ---- tolerance ---- */

typedef struct tolerance_run {
  dyd_tolerance *tolerance;
  mpq_t up_to, sigma;
  double *weight, *sigmas;
  bool cut;
} tolerance_run;

/* Above 0, and a double that is. */
static int sigma_read(mpq_ptr out, const char *text) {
  int status = cli_number_read(out, "sigma", text);
  if (status || (mpq_get_d(out) >= 1e-300 && mpq_get_d(out) <= 1e300)) return status;
  return cli_usage("--sigma \"%s\" is not understood; give a number above 0, such as 0.01", text);
}

/* Options that exclude each other. */
static int tolerance_contradictions(const cli_options *o) {
  bool sigmas = o->sigma && o->read.sigma_column, weights = o->metric == DYD_METRIC_BOX && o->read.radius_columns;
  bool chances =
      (o->sigma || o->read.sigma_column) && (o->content == DYD_CONTENT_RADII || o->content == DYD_CONTENT_BARCODE);
  if (sigmas) cli_complain("--sigma and --sigma-column contradict each other; remove one of them");
  if (chances) cli_complain("probabilities are those of pairs; remove the standard deviation or --layer");
  if (weights) cli_complain("--metric box is about points that move equally far; remove it or --radius-column");
  return sigmas || chances || weights ? CLI_USAGE : 0;
}

static int tolerance_begin(cli_session *s) {
  tolerance_run *r = s->state;
  const cli_options *o = &s->o;
  s->o.read.keep_radii = true;
  mpq_inits(r->up_to, r->sigma, NULL);
  int status = o->up_to ? cli_number_read(r->up_to, "up-to", o->up_to) : 0;
  if (!status && o->sigma) status = sigma_read(r->sigma, o->sigma);
  return status ? status : tolerance_contradictions(o);
}

/* The column of radii holds how far each point moves. */
static int tolerance_columns(cli_session *s) {
  tolerance_run *r = s->state;
  const dyd_read_options *read = &s->o.read;
  if (read->radius_columns) r->weight = of_each_point(s->engine, DYD_ROW_RADIUS);
  if (read->sigma_column) r->sigmas = of_each_point(s->engine, DYD_ROW_SIGMA);
  bool good = !r->weight == !read->radius_columns && !r->sigmas == !read->sigma_column;
  return good ? 0 : cli_complain_memory();
}

/* The triangulation of the points as they are, and its tolerances. Radii of points, which take longer than all
 * edges, only where they are written. */
static dyd_status tolerance_run_engine(cli_session *s, const dyd_engine_options *options, dyd_error *err) {
  tolerance_run *r = s->state;
  dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options),
                             .points = s->o.content == DYD_CONTENT_RADII || s->o.format == DYD_FORMAT_JSON,
                             .max_pairs = options->max_pairs, .cancel = cli_signals_flag(), .metric = s->o.metric};
  if (mpq_sgn(r->up_to)) o.up_to = r->up_to;
  o.sigma = mpq_get_d(r->sigma);
  o.weight = r->weight;
  o.sigmas = r->sigmas;
  dyd_status st = dyd_engine_tolerance(&r->tolerance, &s->outcome, s->engine, &o, s->o.relative_bits, options, err);
  r->cut = st == DYD_CANCELLED;
  return cli_session_cut(st, err);
}

/* Of work that was cut short, pairs can be written; radii and counts come of all edges. */
static int tolerance_find(cli_session *s) {
  const tolerance_run *r = s->state;
  int status = tolerance_columns(s);
  if (!status) status = cli_session_run(s, &s->o.engine, tolerance_run_engine);
  bool parts = s->o.content != DYD_CONTENT_RADII && s->o.content != DYD_CONTENT_BARCODE;
  s->known = !status && r->tolerance && (!r->cut || parts);
  return status || s->known ? status : cli_session_stopped(s, "the tolerances were");
}

static dyd_status tolerance_write(FILE *out, const cli_session *s, dyd_error *err) {
  dyd_write_options how = cli_write_options(out, s);
  how.tolerance = ((tolerance_run *)s->state)->tolerance;
  return cli_write(out, s, &how, err);
}

/* Ties are events here, nothing left open. */
static int tolerance_summary(cli_session *s, int status) {
  if (status || s->outcome == DYD_OUTCOME_DECIDED || s->outcome == DYD_OUTCOME_FIXPOINT)
    return !status && ((tolerance_run *)s->state)->cut ? cli_exit_cut() : status;
  cli_note(&s->o, "%s: some events are wider than asked for, or have no row (%s)", dyd_outcome_text(s->outcome),
           cli_outcome_advice(s->engine));
  return cli_exit_status(s->outcome);
}

static void tolerance_end(cli_session *s) {
  tolerance_run *r = s->state;
  dyd_tolerance_free(r->tolerance);
  free(r->weight);
  free(r->sigmas);
  mpq_clears(r->up_to, r->sigma, NULL);
}

const cli_work cli_tolerance = {.size = sizeof(tolerance_run),
                                .begin = tolerance_begin,
                                .find = tolerance_find,
                                .write = tolerance_write,
                                .summary = tolerance_summary,
                                .end = tolerance_end};

/* ---- plan: the input ---- */

typedef struct plan_run {
  dyd_survey *survey;
  mpq_t accuracy;
  dyd_pair_list pairs;
  size_t *line; /* of each pair in its file */
  uint32_t site;
  double *cost;
  dyd_survey_trial *trial; /* with --simulate, instead of the plan */
  bool cut;
  dyd_pair_list discs; /* with --discs: of all, where pictures show them */
} plan_run;

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
                       "these are not two different points; give their numbers i,j first, or name the columns i and j "
                       "in a header");
}

static dyd_status pairs_row(void *user, const dyd_record *row, dyd_error *err) {
  pairs_columns *p = user;
  int64_t end[2];
  const bool header = !p->begun && pairs_header(p, row);
  p->begun = true;
  if (header) return DYD_OK;
  for (size_t k = 0; k < 2; k++)
    if (!cli_field_integer(&end[k], row, p->column[k], 0, UINT32_MAX)) return pairs_refuse(row, p->column[k], err);
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
  return st == DYD_OK ? 0 : cli_complain_at(file, &err);
}

static int plan_begin(cli_session *s) {
  plan_run *r = s->state;
  const cli_options *o = &s->o;
  mpq_init(r->accuracy);
  if (o->seed_set && !o->simulate) return cli_usage("--seed is about the trials of --simulate; remove it or add that");
  if (o->simulate && (o->layer || o->next))
    return cli_usage("--simulate writes trials instead of a plan; remove it or %s", o->layer ? "--layer" : "--next");
  if (o->sphere && o->window) return cli_usage("--window of plan is about the plane; remove it or --sphere");
  int status = 0;
  if (o->sphere) cli_sphere_begin(s);
  if (o->accuracy && !o->sphere) status = cli_number_read(r->accuracy, "accuracy", o->accuracy);
  if (!status && o->accuracy && !o->sphere && mpq_sgn(r->accuracy) == 0)
    return cli_usage("--accuracy \"%s\" is not understood; nothing is measured exactly: give a number above 0",
                     o->accuracy);
  if (!status && o->pairs) status = pairs_read(r, o->pairs);
  r->site = o->site;
  return status;
}

/* ---- plan: the plan ---- */

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
static int plan_find_points(cli_session *s) {
  plan_run *r = s->state;
  const cli_options *o = &s->o;
  if (o->site_set && (r->site = point_of_row(s->engine, r->site)) == UINT32_MAX)
    return cli_complain("there is no point %lu; give --site the number of one, from 0", (unsigned long)o->site);
  for (size_t k = 0; k < r->pairs.count; k++) {
    uint32_t *end[2] = {&r->pairs.item[k].i, &r->pairs.item[k].j};
    for (int x = 0; x < 2; x++) {
      unsigned long row = *end[x];
      if ((*end[x] = point_of_row(s->engine, *end[x])) != UINT32_MAX) continue;
      return cli_complain("%s:%zu: there is no point %lu; give pairs of points that are there, numbered from 0",
                          o->pairs, r->line[k], row);
    }
  }
  return 0;
}

static uint64_t plan_seed(const cli_session *s) {
  return s->o.seed_set ? s->o.seed : 1;
}

/* The plan, or its trials, of the result of the run; if the run was cut, so are they, before their first row. */
static dyd_status plan_or_trials(cli_session *s, dyd_error *err) {
  static const volatile int raised = 1;
  plan_run *r = s->state;
  const dyd_delaunay *pd = dyd_engine_delaunay(s->engine);
  const size_t trials = s->o.simulate;
  const dyd_survey_options how = {DYD_SIZED(dyd_survey_options),
                                  .pairs = s->o.pairs ? &r->pairs : NULL,
                                  .window = s->view,
                                  .site = s->o.site_set ? &r->site : NULL,
                                  .accuracy = s->o.accuracy && !s->sphere ? r->accuracy : NULL,
                                  .cost = r->cost,
                                  .discs = s->o.discs,
                                  .cancel = cli_run_was_whole(s->engine) ? cli_signals_flag() : &raised};
  dyd_status st = DYD_E_NOMEM;
  if (trials) r->trial = calloc(trials, sizeof *r->trial);
  if (trials && r->trial)
    st = s->sphere ? dyd_sphere_simulate(r->trial, s->sphere, trials, plan_seed(s), s->o.accuracy, &how, err)
                   : dyd_survey_simulate(r->trial, trials, plan_seed(s), pd, &how, err);
  else if (!trials)
    st = s->sphere ? dyd_sphere_survey(&r->survey, s->sphere, s->o.accuracy, &how, err)
                   : dyd_survey_new(&r->survey, pd, &how, err);
  r->cut = st == DYD_CANCELLED;
  const bool drawn = s->o.format != DYD_FORMAT_JSON && !dyd_format_holds(s->o.format, DYD_CONTENT_PLAN_PAIRS, false);
  if (st == DYD_OK && s->o.discs && drawn) st = dyd_disc_pairs(&r->discs, pd, cli_signals_flag(), err);
  return cli_session_cut(st, err);
}

static dyd_status plan_run_engine(cli_session *s, const dyd_engine_options *options, dyd_error *err) {
  dyd_outcome outcome;
  dyd_status st = s->sphere ? dyd_sphere_run(&outcome, s->sphere, options, err) : cli_run_engine(s, options, err);
  return st == DYD_OK && dyd_engine_delaunay(s->engine) ? plan_or_trials(s, err) : st;
}

static int plan_find(cli_session *s) {
  plan_run *r = s->state;
  dyd_engine_options o = s->o.engine;
  int status = plan_find_points(s);
  r->cost = of_each_point(s->engine, DYD_ROW_COST);
  if (!status && !r->cost) status = cli_complain_memory();
  if (!status && s->o.sphere) status = cli_sphere_look(s);
  if (s->o.sphere) o.start_bits = 0;
  if (!status) status = cli_session_run(s, &o, plan_run_engine);
  s->known = !status && (r->survey || r->trial);
  return status || s->known ? status : cli_session_stopped(s, "the plan was");
}

static dyd_status plan_write(FILE *out, const cli_session *s, dyd_error *err) {
  const plan_run *r = s->state;
  dyd_write_options how = cli_write_options(out, s);
  how.plan = r->survey;
  how.pairs = r->discs.item ? &r->discs : NULL;
  if (how.pairs) how.history = NULL; /* is that of squares */
  how.next = s->o.next;
  how.trial = r->trial;
  how.trials = s->o.simulate;
  how.seed = plan_seed(s);
  return cli_write(out, s, &how, err);
}

/* What rows alone do not say: ties at the nominal places, points that coincide there, rows that decide nothing yet. */
static void plan_notes(const cli_session *s, const dyd_survey *plan) {
  const dyd_survey_result *of = dyd_survey_get(plan);
  const dyd_engine *e = s->places ? s->places : s->engine;
  const dyd_survey_row *row;
  size_t rows = dyd_survey_rows(&row, plan), idle = 0;
  const bool same = of->same[0] != of->same[1];
  if (same)
    cli_note(
        &s->o,
        "points %zu and %zu have the same centre, so pairs next to them may stay undecided (measure them apart; if "
        "they are one point: --merge)",
        dyd_engine_row(e, of->same[0]), dyd_engine_row(e, of->same[1]));
  if (of->tie[0] != of->tie[1])
    cli_note(&s->o,
             "the pair %zu,%zu ties at the centres of its rectangles: any new measurement of one of the points on that "
             "circle or line decides it, unless it lies exactly there",
             dyd_engine_row(e, of->tie[0]), dyd_engine_row(e, of->tie[1]));
  for (size_t k = 0; k < rows; k++) idle += row[k].decided == 0;
  if (idle) cli_note(&s->o, "rows with pairs_decided 0 decide pairs only together with later rows");
  if (of->left)
    cli_note(&s->o, "%zu of %zu pairs stay undecided with this plan%s", of->left, of->open,
             s->o.accuracy && !same ? " (give a finer --accuracy)" : "");
}

static int plan_summary(cli_session *s, int status) {
  const plan_run *r = s->state;
  if (status) return status;
  if (r->cut) return s->outcome == DYD_OUTCOME_BUDGET ? CLI_BUDGET : cli_exit_cut();
  if (r->trial) return CLI_OK;
  plan_notes(s, r->survey);
  return dyd_survey_get(r->survey)->left ? CLI_FIXPOINT : CLI_OK;
}

static void plan_end(cli_session *s) {
  plan_run *r = s->state;
  dyd_survey_free(r->survey);
  free(r->trial);
  dyd_pair_list_clear(&r->discs);
  free(r->cost);
  free(r->line);
  dyd_pair_list_clear(&r->pairs);
  mpq_clear(r->accuracy);
}

const cli_work cli_plan = {.size = sizeof(plan_run),
                           .begin = plan_begin,
                           .find = plan_find,
                           .write = plan_write,
                           .summary = plan_summary,
                           .end = plan_end};
