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

static dyd_status print_schedule(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const dyd_check_report *r = what;
  (void)o, (void)err;
  fprintf(out,
          "# dyadel check schedule: %s\n# base BITS; seed S; stage POINT BITS\nbase %" PRId64 "\nseed %" PRIu64 "\n",
          r->message, r->base_bits, r->seed);
  for (size_t k = 0; k < r->moves; k++)
    fprintf(out, "%u %u %" PRId64 "\n", (unsigned)r->move[k].stage, (unsigned)r->move[k].point, r->move[k].bits);
  return DYD_OK;
}

typedef struct given_moves {
  dyd_check_move *move;
  size_t count, cap;
} given_moves;

static bool add_given_move(given_moves *s, dyd_check_move m) {
  if (s->count == s->cap) {
    size_t cap = 2 * s->cap + 64;
    void *p = realloc(s->move, cap * sizeof *s->move);
    if (!p) return false;
    s->move = p;
    s->cap = cap;
  }
  s->move[s->count++] = m;
  return true;
}

/* One line; false when it is not understood. */
static bool read_schedule_line(given_moves *s, dyd_check_options *o, const char *line) {
  long long a, b, c;
  char rest;
  if (line[0] == '#' || line[strspn(line, " \t\r\n")] == 0) return true;
  if (sscanf(line, "base %lld %c", &a, &rest) == 1) return o->base_bits = a, a > 0;
  if (sscanf(line, "seed %lld %c", &a, &rest) == 1) return o->seed = (uint64_t)a, true;
  if (sscanf(line, "%lld %lld %lld %c", &a, &b, &c, &rest) != 3) return false;
  if (a < 1 || a > UINT32_MAX || b < 0 || b > UINT32_MAX || c < 1 || c > DYD_EXP_LIMIT / 2) return false;
  if (s->count && s->move[s->count - 1].stage > (uint32_t)a) return false;
  return add_given_move(s, (dyd_check_move){(uint32_t)a, (uint32_t)b, c});
}

static int read_schedule_file(given_moves *s, dyd_check_options *o, const char *name) {
  FILE *in = fopen(name, "r");
  if (!in) {
    cli_complain("%s: cannot open: %s; give a schedule that check wrote by --trace", name, strerror(errno));
    return CLI_FAILED;
  }
  char line[256];
  int status = 0;
  for (size_t number = 1; !status && fgets(line, sizeof line, in); number++)
    if (!read_schedule_line(s, o, line)) {
      cli_complain("%s:%zu:1: this is no line of a schedule; give STAGE POINT BITS, stages ascending", name, number);
      status = CLI_FAILED;
    }
  fclose(in);
  return status;
}

/* ---- the report ---- */

static dyd_status print_check(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  return dyd_write_check(out, what, o->format, err);
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
  given_moves given = {0};
  dyd_error err;
  dyd_error_clear(&err);
  if (!o->oracle && strcmp(o->file, "-") == 0) {
    cli_complain("check reads the points once for each schedule; give a file in place of standard input");
    return CLI_USAGE;
  }
  int status = o->replay ? read_schedule_file(&given, &options, o->replay) : 0;
  cli_progress *progress = cli_progress_start(o->quiet);
  cli_progress_phase(progress, "checking");
  dyd_status st = DYD_OK;
  if (!status)
    st = o->replay ? dyd_check_replay(&report, open_checked_points, &in, given.move, given.count, &options, &err)
                   : dyd_check_run(&report, open_checked_points, &in, &options, &err);
  cli_progress_stop(progress);
  bool late = st == DYD_CANCELLED;
  if (late) st = DYD_OK; /* the report tells what was done until then */
  if (!status && st != DYD_OK) {
    if (!in.status) cli_complain("%s", err.message[0] ? err.message : dyd_status_text(st));
    status = in.status ? in.status : CLI_FAILED;
  }
  if (!status) status = tell_check(&report, o);
  if (!status && late) {
    cli_complain("the time is used up after %" PRIu64 " schedules; raise --timeout", report.schedules);
    status = CLI_BUDGET;
  }
  dyd_check_report_clear(&report);
  free(given.move);
  return status;
}
