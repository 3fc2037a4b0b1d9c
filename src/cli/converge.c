/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel converge FILE: a run stage by stage, as a table and a plot, and replays of traces; dyadel check FILE: random
 * refinement schedules over the points, and what broke. */
#include "cli.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- converge: a run ---- */

typedef struct converge_run {
  dyd_convergence table;
  dyd_converge_options how;
  dyd_voronoi_bounds bounds;
  dyd_status replayed; /* how a replay ended */
  int64_t from, to;    /* --modulus */
} converge_run;

/* By the name of the plot's file; false when no format of that ending holds a plot. */
static bool plot_format(dyd_format *out, const char *name) {
  return dyd_format_from_file(out, name) && dyd_format_holds(*out, DYD_CONTENT_PLOT, false);
}

static const cli_work work_replay;

static const cli_work *converge_instead(const cli_options *o) {
  return o->replay ? &work_replay : NULL;
}

/* Returns true if the table is about a disc or bisector. */
static bool is_piece(const cli_session *s) {
  return s->o.of >= DYD_CONVERGE_DISC;
}

/* Reads --modulus, and sets the options that follow from it. */
static bool read_modulus(cli_session *s) {
  cli_options *o = &s->o;
  converge_run *r = s->state;
  enum { MOST = 1000000 };
  if (!o->modulus) return true;
  const char *colon = strchr(o->modulus, ':');
  if (!colon || !cli_integer_read(&r->from, o->modulus, (size_t)(colon - o->modulus), CLI_FORMS, -MOST, MOST) ||
      !cli_integer_read(&r->to, colon + 1, strlen(colon + 1), CLI_FORMS, r->from, MOST))
    return false;
  r->how.rates = true;
  if (o->engine.goal == DYD_GOAL_DECIDED) o->engine.goal = DYD_GOAL_HAUSDORFF;
  if (o->engine.goal_bits < r->to) o->engine.goal_bits = r->to;
  if (!o->engine.step_bits) o->engine.step_bits = 1;
  if (!o->start_set) o->engine.start_bits = 1;
  return o->start_set = true;
}

/* False after a message about --modulus or --hindsight. ranged: the former is well-formed. */
static bool experiment_fits(const cli_options *o, bool ranged) {
  if (!ranged)
    cli_complain("--modulus \"%s\" is not A:B; give two whole numbers, the lower one first: --modulus 0:40",
                 o->modulus);
  else if (o->modulus && (o->sphere || o->discs || o->format == DYD_FORMAT_HTML))
    cli_complain("--modulus is about rectangles in the plane, as csv or json; remove %s", o->sphere  ? "--sphere"
                                                                                          : o->discs ? "--discs"
                                                                                                     : "html");
  else if (o->hindsight && (o->sphere || o->discs || o->of != DYD_CONVERGE_DELAUNAY))
    cli_complain("--hindsight is about the triangulation of rectangles in the plane; remove %s", o->sphere  ? "--sphere"
                                                                                                 : o->discs ? "--discs"
                                                                                                            : "--of");
  else if (o->replay && (o->modulus || o->hindsight))
    cli_complain("--replay repeats a table as it was; remove --%s", o->modulus ? "modulus" : "hindsight");
  else
    return true;
  return false;
}

static int converge_begin(cli_session *s) {
  const cli_options *o = &s->o;
  converge_run *r = s->state;
  dyd_format format;
  r->table = (dyd_convergence){DYD_SIZED(dyd_convergence)};
  r->how = (dyd_converge_options){DYD_SIZED(dyd_converge_options), .of = o->of, .hindsight = o->hindsight};
  dyd_voronoi_bounds_init(&r->bounds);
  const bool ranged = read_modulus(s);
  if (o->of == DYD_CONVERGE_VORONOI) s->o.engine.goal = cli_voronoi_goal(o->engine.goal);
  if (!o->start_set) s->o.engine.start_bits = 4;
  if (o->plot && !plot_format(&format, o->plot))
    cli_complain("--plot \"%s\" does not say what kind of picture is wanted; end it in .svg, .pdf, .png, .tikz or .pgf",
                 o->plot);
  else if (o->label && !dyd_label_fits(o->label))
    cli_complain("--label \"%s\" is not understood; give NAME=VALUE,NAME=VALUE without quotes and "
                 "backslashes, names that differ, and none that is a column of the table",
                 o->label);
  else if (!experiment_fits(o, ranged))
    return CLI_USAGE;
  else if (is_piece(s) && o->format == DYD_FORMAT_HTML)
    cli_complain("html shows the triangulation of all points; remove --of %s, or give another format",
                 dyd_converge_of_text(o->of));
  else if (o->replay && o->of != DYD_CONVERGE_DELAUNAY)
    cli_complain("--replay takes what the table is about from the trace; remove --of");
  else if (o->replay && o->format == DYD_FORMAT_HTML)
    cli_complain("html shows the points, which --replay does without; run converge on them");
  else if (o->sphere && (o->of != DYD_CONVERGE_DELAUNAY || o->engine.goal != DYD_GOAL_DECIDED || o->window))
    cli_complain("%s is about the plane; remove it or --sphere", o->window                        ? "--window"
                                                                 : o->of != DYD_CONVERGE_DELAUNAY ? "--of"
                                                                                                  : "--until");
  else if (o->sphere && o->format == DYD_FORMAT_HTML)
    cli_complain("html is about the plane; remove it or --sphere");
  else if (o->discs && is_piece(s))
    cli_complain("--of %s is about rectangles; remove --discs", dyd_converge_of_text(o->of));
  else if (o->discs && o->format == DYD_FORMAT_HTML)
    cli_complain("html shows rectangles at every stage; remove --discs, or give csv or json");
  else {
    if (o->sphere) cli_sphere_begin(s);
    return 0;
  }
  return CLI_USAGE;
}

static dyd_status converge_run_engine(cli_session *s, const dyd_engine_options *options, dyd_error *err) {
  converge_run *r = s->state;
  if (s->sphere) return dyd_sphere_converge(&r->table, s->sphere, options, err);
  dyd_status st = dyd_converge_run(&r->table, s->engine, options, &r->how, err);
  if (is_piece(s)) s->outcome = r->table.outcome;
  return st;
}

static int piece_points(const cli_session *s) {
  return !is_piece(s) || cli_has_points(s, s->o.of == DYD_CONVERGE_DISC ? 3 : 2) ? 0 : CLI_FAILED;
}

static dyd_status write_curves(FILE *out, const cli_session *s, dyd_format format, dyd_error *err) {
  const dyd_write_options how = {DYD_SIZED(dyd_write_options), .stages = &((converge_run *)s->state)->table,
                                 .style = &s->o.style};
  return dyd_write(out, NULL, DYD_CONTENT_PLOT, format, &how, err);
}

static dyd_status write_plot(FILE *out, const cli_session *s, dyd_error *err) {
  dyd_format format = s->o.format;
  plot_format(&format, s->o.plot);
  return write_curves(out, s, format, err);
}

static dyd_status write_pgf(FILE *out, const cli_session *s, dyd_error *err) {
  return write_curves(out, s, DYD_FORMAT_PGF, err);
}

/* Sets s->known, and draws the plot, as far as the table was made. */
static int converge_found(cli_session *s) {
  s->known = ((converge_run *)s->state)->table.count > 0;
  int status = s->known && s->o.plot ? cli_write_file(s->o.plot, s, write_plot) : 0;
  return status == 0 && s->known && s->o.pgf ? cli_write_file(s->o.pgf, s, write_pgf) : status;
}

/* The last row; NULL: none. */
static const dyd_stage_row *last_stage(const converge_run *r) {
  return r->table.count ? r->table.row[r->table.count - 1] : NULL;
}

static int converge_find(cli_session *s) {
  converge_run *r = s->state;
  r->how.window = s->view;
  s->converge = s->o.sphere ? NULL : &r->how;
  int status = s->o.sphere ? cli_sphere_look(s) : piece_points(s);
  if (status) return status;
  status = cli_session_run(s, &s->o.engine, converge_run_engine);
  cli_session_settle(s);
  if (status == 0 && !r->table.count) cli_session_lacks(s, r->table.outcome, "the first stage was complete");
  int drawn = converge_found(s);
  const dyd_stage_row *last = last_stage(r);
  if (last && last->voronoi) { /* for the note on the goal */
    dyd_dyadic_set(&r->bounds.area, &last->v_area);
    dyd_dyadic_set(&r->bounds.hausdorff, &last->v_hausdorff);
    r->bounds.finite = true;
    s->bounds = &r->bounds;
  }
  return status ? status : drawn;
}

static dyd_status converge_write(FILE *out, const cli_session *s, dyd_error *err) {
  const converge_run *r = s->state;
  dyd_write_options how = cli_write_options(out, s);
  how.stages = &r->table;
  how.times = !s->o.no_times;
  how.label = s->o.label;
  how.no_header = s->o.no_header;
  how.modulus = s->o.modulus;
  how.modulus_from = r->from;
  how.modulus_to = r->to;
  return cli_write(out, s, &how, err);
}

/* The last row lacks bounds since no time was left for them: says so. Returns the exit status. */
static int note_cut(const cli_session *s) {
  const converge_run *r = s->state;
  const dyd_stage_row *last = last_stage(r);
  if (!last || s->sphere || !cli_deadline_passed() || (last->bounded && (last->voronoi || !r->table.window))) return 0;
  cli_note(&s->o, "budget: time limit reached: no bounds of stage %llu (raise --timeout)",
           (unsigned long long)last->stage);
  return CLI_BUDGET;
}

/* A curve takes more points than geometric growth gives: says which steps do. */
static void note_steps(const cli_session *s) {
  enum { FEW = 12, ENOUGH = 24 };
  const dyd_convergence *table = &((converge_run *)s->state)->table;
  if (!s->o.plot || s->o.engine.step_bits || !table->count || table->count >= FEW) return;
  int64_t bits = table->row[table->count - 1]->bits_most - table->row[0]->bits_most,
          step = (bits + ENOUGH - 1) / ENOUGH;
  if (bits <= 0) return;
  cli_note(&s->o, "the plot has %zu stages, in which precision grows geometrically; --step-bits %lld draws up to %lld",
           table->count, (long long)step, (long long)(bits / step + 1));
}

/* Statuses of the discs, after the last stage. */
static int discs_summary(cli_session *s, int status) {
  const dyd_stage_row *last = last_stage(s->state);
  size_t open = last ? last->count[DYD_INDETERMINATE] + last->count[DYD_TIE] : 0;
  if (!status && open) {
    status = cli_exit_status(s->outcome);
    if (status && !s->o.quiet) cli_note_pairs(s, s->outcome, last->count, NULL);
  }
  cli_session_stats(s, NULL);
  return status;
}

static int converge_summary(cli_session *s, int status) {
  const dyd_convergence *table = &((converge_run *)s->state)->table;
  note_steps(s);
  if (s->o.hindsight && !table->best_bits)
    cli_note(&s->o, "no best plan was found in hindsight (raise --hindsight, or take fewer points)");
  if (s->sphere) return cli_sphere_summary(s, status);
  if (is_piece(s)) return status ? status : cli_pieces_outcome(s);
  if (!status) status = note_cut(s);
  return s->o.discs && s->o.engine.goal == DYD_GOAL_DECIDED ? discs_summary(s, status) : cli_pairs_summary(s, status);
}

static void converge_end(cli_session *s) {
  converge_run *r = s->state;
  dyd_voronoi_bounds_clear(&r->bounds);
  dyd_convergence_clear(&r->table);
}

const cli_work cli_converge = {.size = sizeof(converge_run),
                               .instead = converge_instead,
                               .begin = converge_begin,
                               .find = converge_find,
                               .write = converge_write,
                               .summary = converge_summary,
                               .end = converge_end};

/* ---- converge --replay ---- */

static int replay_find(cli_session *s) {
  converge_run *r = s->state;
  FILE *in = cli_input_open(s->o.replay, "check the name of the trace");
  if (!in) return CLI_FAILED;
  const dyd_converge_options how = {DYD_SIZED(dyd_converge_options), .cancel = cli_deadline_flag()};
  dyd_error err;
  r->replayed = dyd_trace_replay(&r->table, in, &how, &err);
  cli_input_close(in);
  if (r->replayed == DYD_CANCELLED)
    cli_complain("time limit reached after %zu stages of the trace (raise --timeout)", r->table.count);
  else if (r->replayed != DYD_OK)
    cli_complain_at(s->o.replay, &err);
  return r->replayed == DYD_E_NOMEM ? CLI_FAILED : converge_found(s);
}

static int replay_summary(cli_session *s, int status) {
  const converge_run *r = s->state;
  if (status) return status;
  if (r->replayed == DYD_CANCELLED) return CLI_BUDGET;
  return r->replayed != DYD_OK ? CLI_FAILED : cli_exit_status(r->table.outcome);
}

static const cli_work work_replay = {.size = sizeof(converge_run),
                                     .bare = true,
                                     .begin = converge_begin,
                                     .find = replay_find,
                                     .write = converge_write,
                                     .summary = replay_summary,
                                     .end = converge_end};

/* ---- check: the schedule of a file ---- */

typedef struct given_place {
  size_t line, column;
} given_place;

/* The moves of a file, and where each names its point; the run and its report. */
typedef struct check_run {
  dyd_check_options options;
  dyd_check_report report;
  dyd_check_move *move;
  given_place *place;
  size_t count, cap;
  const cli_options *o;
  int status;       /* of reading the points */
  bool noted, late; /* points are read for each schedule; notes are printed once */
} check_run;

static dyd_status add_given_move(check_run *s, const dyd_check_move *m, const dyd_record *row, dyd_error *err) {
  if (s->count == s->cap) {
    size_t cap = 2 * s->cap + 64;
    dyd_check_move *move = realloc(s->move, cap * sizeof *move);
    if (move) s->move = move;
    given_place *place = realloc(s->place, cap * sizeof *place);
    if (place) s->place = place;
    if (!move || !place) return dyd_error_set(err, DYD_E_NOMEM, dyd_status_text(DYD_E_NOMEM));
    s->cap = cap;
  }
  dyd_record_place(err, row, 1);
  s->place[s->count] = (given_place){err->line, err->column};
  s->move[s->count++] = *m;
  return DYD_OK;
}

static dyd_status refuse_move(const dyd_record *row, size_t field, const char *what, dyd_error *err) {
  dyd_record_place(err, row, field);
  return dyd_error_set(err, DYD_E_PARSE, what);
}

static bool row_is_named(const dyd_record *row, const char *name) {
  size_t length;
  const char *text = dyd_record_field(&length, row, 0);
  return row->fields == 2 && length == strlen(name) && memcmp(text, name, length) == 0;
}

static dyd_status read_given_move(void *user, const dyd_record *row, dyd_error *err) {
  check_run *s = user;
  int64_t value[3] = {0};
  if (row_is_named(row, "base") && cli_field_integer(&s->options.base_bits, row, 1, 1, DYD_EXP_LIMIT / 2))
    return DYD_OK;
  if (row_is_named(row, "seed") && cli_field_integer(&value[0], row, 1, 0, INT64_MAX))
    return s->options.seed = (uint64_t)value[0], DYD_OK;
  for (size_t k = 0; k < 4; k++)
    if (k == 3 ? row->fields > 3
               : !cli_field_integer(&value[k], row, k, k != 1, k == 2 ? DYD_EXP_LIMIT / 2 : UINT32_MAX))
      return refuse_move(row, k, "this is not a move; give STAGE POINT BITS, stages from 1, points from 0", err);
  if (s->count && s->move[s->count - 1].stage > value[0])
    return refuse_move(row, 0, "this stage comes after a later one; sort the moves by STAGE", err);
  return add_given_move(s, &(dyd_check_move){(uint32_t)value[0], (uint32_t)value[1], value[2]}, row, err);
}

static int read_schedule_file(check_run *s, const char *name) {
  dyd_error err;
  FILE *in = cli_input_open(name, "give a schedule that check wrote by --trace");
  if (!in) return CLI_FAILED;
  dyd_status st = dyd_read_records(in, ' ', read_given_move, s, &err);
  cli_input_close(in);
  static const dyd_check_move none;
  s->options.move = s->move ? s->move : &none;
  s->options.moves = s->count;
  return st == DYD_OK ? 0 : cli_complain_at(name, &err);
}

static int schedules_begin(cli_session *s) {
  const cli_options *o = &s->o;
  check_run *r = s->state;
  r->o = o;
  r->options = (dyd_check_options){DYD_SIZED(dyd_check_options),
                                   .seed = o->seed_set ? o->seed : 1,
                                   .schedules = o->schedules,
                                   .seconds = o->engine.seconds,
                                   .max_bits = o->max_bits_set ? o->engine.max_bits : 0,
                                   .tie_bits = o->engine.tie_bits,
                                   .no_ties = o->engine.no_ties};
  r->report = (dyd_check_report){DYD_SIZED(dyd_check_report)};
  if (!o->oracle && strcmp(o->file, "-") == 0)
    return cli_usage("check reads the points once for each schedule; give a file instead of standard input");
  return o->replay ? read_schedule_file(r, o->replay) : 0;
}

/* ---- check: the run ---- */

static dyd_status open_checked_points(dyd_engine **out, void *user, dyd_error *err) {
  check_run *r = user;
  (void)err;
  dyd_status st = dyd_engine_new(out);
  if (st != DYD_OK) return st;
  cli_options o = *r->o;
  r->status = cli_points_read(*out, &o, !r->noted);
  r->noted = true;
  if (!r->status) return DYD_OK;
  dyd_engine_free(*out);
  *out = NULL;
  return DYD_E_IO;
}

/* The library numbers the moves, the reader of the message sees the lines. */
static int complain_check(const check_run *r, dyd_status st, dyd_error *err) {
  if (!err->message[0]) dyd_error_set(err, st, dyd_status_text(st));
  const given_place *place = err->line ? &r->place[err->line - 1] : &(given_place){0};
  err->line = place->line, err->column = place->column;
  return cli_complain_at(place->line ? r->o->replay : NULL, err);
}

static int schedules_find(cli_session *s) {
  check_run *r = s->state;
  dyd_error err;
  dyd_error_clear(&err);
  s->progress = cli_progress_start(s->o.quiet);
  cli_progress_phase(s->progress, "checking");
  dyd_status st = dyd_check_run(&r->report, open_checked_points, r, &r->options, &err);
  cli_progress_stop(s->progress);
  s->progress = NULL;
  r->late = st == DYD_CANCELLED; /* with a report of the schedules until then */
  s->known = st == DYD_OK || r->late;
  return s->known ? 0 : r->status ? r->status : complain_check(r, st, &err);
}

static dyd_status schedules_write(FILE *out, const cli_session *s, dyd_error *err) {
  const dyd_write_options how = {DYD_SIZED(dyd_write_options), .report = &((check_run *)s->state)->report,
                                 .style = &s->o.style};
  return dyd_write(out, NULL, s->o.content, s->o.format, &how, err);
}

/* The schedule as text. The message is kept on one line, so that it stays a comment. */
static dyd_status write_schedule(FILE *out, const cli_session *s, dyd_error *err) {
  const dyd_check_report *r = &((check_run *)s->state)->report;
  (void)err;
  fputs("# dyadel check schedule: ", out);
  for (const char *c = r->message; *c; c++) fputc((unsigned char)*c < ' ' ? ' ' : *c, out);
  fprintf(out, "\n# base BITS; seed S; stage POINT BITS\nbase %" PRId64 "\nseed %" PRIu64 "\n", r->base_bits, r->seed);
  for (size_t k = 0; k < r->moves; k++)
    fprintf(out, "%u %u %" PRId64 "\n", (unsigned)r->move[k].stage, (unsigned)r->move[k].point, r->move[k].bits);
  return DYD_OK;
}

static int schedules_summary(cli_session *s, int status) {
  const check_run *run = s->state;
  const dyd_check_report *r = &run->report;
  if (status) return status;
  if (r->fault == DYD_CHECK_FINE && run->late)
    cli_complain("time limit reached after %" PRIu64 " schedules (raise --timeout)", r->schedules);
  if (r->fault == DYD_CHECK_FINE) return run->late ? CLI_BUDGET : CLI_OK;
  cli_complain("%s: %s", dyd_check_fault_text(r->fault), r->message);
  const char *show = r->moves == 1 ? "move shows" : "moves show";
  if (!s->o.trace)
    cli_complain("%zu %s it (seed %" PRIu64 "); --trace FILE writes a schedule", r->moves, show, r->seed);
  else if (cli_write_file(s->o.trace, s, write_schedule) == 0)
    cli_complain("%zu %s it: --replay %s", r->moves, show, s->o.trace);
  return CLI_FAILED;
}

static void schedules_end(cli_session *s) {
  check_run *r = s->state;
  dyd_check_report_clear(&r->report);
  free(r->move);
  free(r->place);
}

const cli_work cli_check = {.size = sizeof(check_run),
                            .bare = true,
                            .begin = schedules_begin,
                            .find = schedules_find,
                            .write = schedules_write,
                            .summary = schedules_summary,
                            .end = schedules_end};
