/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel check FILE: random refinement schedules over the points, and what broke. */
#include "cli.h"
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* What the opener of engines needs, and which message it gave. */
typedef struct check_input {
  const cli_options *options;
  int status;
  bool noted; /* points are read for each schedule; notes are told once */
} check_input;

static dyd_status open_checked_points(dyd_engine **out, void *user, dyd_error *err) {
  check_input *in = user;
  (void)err;
  dyd_status st = dyd_engine_new(out);
  if (st != DYD_OK) return st;
  in->status = (in->noted ? cli_points_read : cli_points_read_noting)(*out, in->options);
  in->noted = true;
  if (!in->status) return DYD_OK;
  dyd_engine_free(*out);
  *out = NULL;
  return DYD_E_IO;
}

/* ---- schedules as text ---- */

/* The message is kept on one line, so that it stays a comment. */
static dyd_status print_schedule(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const dyd_check_report *r = what;
  (void)o, (void)err;
  fputs("# dyadel check schedule: ", out);
  for (const char *c = r->message; *c; c++) fputc((unsigned char)*c < ' ' ? ' ' : *c, out);
  fprintf(out, "\n# base BITS; seed S; stage POINT BITS\nbase %" PRId64 "\nseed %" PRIu64 "\n", r->base_bits, r->seed);
  for (size_t k = 0; k < r->moves; k++)
    fprintf(out, "%u %u %" PRId64 "\n", (unsigned)r->move[k].stage, (unsigned)r->move[k].point, r->move[k].bits);
  return DYD_OK;
}

typedef struct given_place {
  size_t line, column;
} given_place;

/* The moves of a file, and where each names its point. */
typedef struct given_moves {
  dyd_check_options *options;
  dyd_check_move *move;
  given_place *place;
  size_t count, cap;
} given_moves;

static dyd_status add_given_move(given_moves *s, const dyd_check_move *m, const dyd_record *row, dyd_error *err) {
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
  given_moves *s = user;
  int64_t value[3] = {0};
  if (row_is_named(row, "base") && dyd_record_integer(&s->options->base_bits, row, 1, 1, DYD_EXP_LIMIT / 2))
    return DYD_OK;
  if (row_is_named(row, "seed") && dyd_record_integer(&value[0], row, 1, 0, INT64_MAX))
    return s->options->seed = (uint64_t)value[0], DYD_OK;
  for (size_t k = 0; k < 4; k++)
    if (k == 3 ? row->fields > 3
               : !dyd_record_integer(&value[k], row, k, k != 1, k == 2 ? DYD_EXP_LIMIT / 2 : UINT32_MAX))
      return refuse_move(row, k, "this is not a move; give STAGE POINT BITS, stages from 1, points from 0", err);
  if (s->count && s->move[s->count - 1].stage > value[0])
    return refuse_move(row, 0, "this stage comes after a later one; sort the moves by STAGE", err);
  return add_given_move(s, &(dyd_check_move){(uint32_t)value[0], (uint32_t)value[1], value[2]}, row, err);
}

static int read_schedule_file(given_moves *s, const char *name) {
  dyd_error err;
  FILE *in = cli_input_open(name, "give a schedule that check wrote by --trace");
  if (!in) return CLI_FAILED;
  dyd_status st = dyd_read_records(in, ' ', read_given_move, s, &err);
  cli_input_close(in);
  if (st != DYD_OK) cli_complain_at(name, &err);
  return st == DYD_OK ? 0 : CLI_FAILED;
}

/* ---- the report ---- */

static dyd_status print_check(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  return dyd_write(out, NULL, o->content, o->format, &(dyd_write_options){DYD_SIZED(dyd_write_options), .report = what},
                   err);
}

static int tell_check(const dyd_check_report *r, const cli_options *o) {
  int status = cli_write_file(o->output, o, print_check, r);
  if (r->fault == DYD_CHECK_FINE || status) return status;
  cli_complain("%s: %s", dyd_check_fault_text(r->fault), r->message);
  if (o->trace) {
    status = cli_write_file(o->trace, o, print_schedule, r);
    if (!status) cli_complain("%zu moves show it: --replay %s", r->moves, o->trace);
  } else {
    cli_complain("%zu moves show it (seed %" PRIu64 "); --trace FILE writes them", r->moves, r->seed);
  }
  return CLI_FAILED;
}

/* The library numbers the moves, the reader of the message sees the lines. */
static int complain_check(const cli_options *o, const given_moves *given, dyd_status st, dyd_error *err) {
  if (!err->message[0]) dyd_error_set(err, st, dyd_status_text(st));
  const given_place *place = err->line ? &given->place[err->line - 1] : &(given_place){0};
  err->line = place->line, err->column = place->column;
  cli_complain_at(place->line ? o->replay : NULL, err);
  return CLI_FAILED;
}

int cli_check(const cli_options *o) {
  check_input in = {.options = o};
  dyd_check_options options = {DYD_SIZED(dyd_check_options),
                               .seed = o->seed_set ? o->seed : 1,
                               .schedules = o->schedules,
                               .seconds = o->engine.seconds,
                               .max_bits = o->max_bits_set ? o->engine.max_bits : 0,
                               .tie_bits = o->engine.tie_bits,
                               .no_ties = o->engine.no_ties};
  dyd_check_report report = {DYD_SIZED(dyd_check_report)};
  given_moves given = {.options = &options};
  dyd_error err;
  dyd_error_clear(&err);
  if (!o->oracle && strcmp(o->file, "-") == 0) {
    cli_complain("check reads the points once for each schedule; give a file in place of standard input");
    return CLI_USAGE;
  }
  int status = o->replay ? read_schedule_file(&given, o->replay) : 0;
  cli_progress *progress = cli_progress_start(o->quiet);
  cli_progress_phase(progress, "checking");
  dyd_status st = DYD_OK;
  if (!status)
    st = o->replay ? dyd_check_replay(&report, open_checked_points, &in, given.move, given.count, &options, &err)
                   : dyd_check_run(&report, open_checked_points, &in, &options, &err);
  cli_progress_stop(progress);
  bool late = st == DYD_CANCELLED;
  if (late) st = DYD_OK; /* the report tells what was done until then */
  if (!status && st != DYD_OK) status = in.status ? in.status : complain_check(o, &given, st, &err);
  if (!status) status = tell_check(&report, o);
  if (!status && late) {
    cli_complain("the time is used up after %" PRIu64 " schedules; raise --timeout", report.schedules);
    status = CLI_BUDGET;
  }
  dyd_check_report_clear(&report);
  free(given.move);
  free(given.place);
  return status;
}
