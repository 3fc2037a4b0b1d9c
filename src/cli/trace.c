/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* --trace and --resume of the commands that refine.
 *
 * A trace appears when it has begun: with the answers of --resume, if there are any. From then on it gets a line for
 * each answer as it comes, so that it is there when the run is killed, and goes to the disk in short intervals. */
#include "cli.h"
#include <errno.h>
#include <string.h>

/* ---- which input ---- */

static uint64_t digest_bytes(uint64_t digest, const char *byte, size_t count) {
  for (size_t k = 0; k < count; k++) digest = (digest ^ (unsigned char)byte[k]) * 1099511628211u;
  return digest;
}

/* FNV-1a of the points file and of what says which points are in it. false: it cannot be read twice. */
static bool digest_input(char text[17], const cli_options *o) {
  const char *const words[] = {o->read.columns,     o->read.radius,       o->read.radius_columns,
                               o->read.radius_unit, o->read.radius_scale, o->read.delimiter};
  uint64_t digest = 14695981039346656037u;
  char part[4096];
  size_t count;
  FILE *in = o->file && strcmp(o->file, "-") != 0 && !o->oracle ? fopen(o->file, "rb") : NULL;
  if (!in) return false;
  while ((count = fread(part, 1, sizeof part, in)) > 0) digest = digest_bytes(digest, part, count);
  bool good = !ferror(in);
  fclose(in);
  for (size_t k = 0; k < sizeof words / sizeof *words; k++)
    if (words[k]) digest = digest_bytes(digest, words[k], strlen(words[k]) + 1);
  snprintf(text, 17, "%016llx", (unsigned long long)digest);
  return good;
}

/* ---- going on ---- */

int cli_trace_resume(const cli_session *s) {
  const cli_options *o = s->options;
  char input[17];
  dyd_recall_report r = {DYD_SIZED(dyd_recall_report)};
  dyd_error err;
  FILE *in = cli_input_open(o->resume, "check the name of the trace");
  if (!in) return CLI_FAILED;
  dyd_status st = dyd_trace_recall(&r, s->engine, in, digest_input(input, o) ? input : NULL, &err);
  cli_input_close(in);
  if (st != DYD_OK) {
    cli_complain_at(o->resume, &err);
    return CLI_FAILED;
  }
  cli_note(o, "%s: %zu answers are taken from this trace%s", o->resume, r.answers,
           r.cut ? "; its last line is cut short, and left out" : "");
  return 0;
}

/* ---- writing ---- */

enum { SYNC_SECONDS = 5 };

/* Begins the trace with the first run. */
static int trace_begin(cli_session *s, const dyd_engine_options *options) {
  const cli_options *o = s->options;
  char input[17];
  dyd_error err;
  if (!cli_output_open(&s->trace_file, o->trace)) return CLI_FAILED;
  setvbuf(s->trace_file.stream, NULL, _IOLBF, BUFSIZ);
  const char *name = digest_input(input, o) ? input : NULL;
  dyd_status st = dyd_trace_new(&s->trace, s->trace_file.stream, s->engine, name, options, s->converge, &err);
  if (st == DYD_OK) st = dyd_trace_sync(s->trace, o->trace_sync > 0 ? o->trace_sync : SYNC_SECONDS, &err);
  if (st != DYD_OK) cli_complain("%s: %s; choose another place with --trace", o->trace, err.message);
  return st == DYD_OK && cli_output_appear(&s->trace_file) ? 0 : CLI_FAILED;
}

static void trace_stage(void *user, const dyd_progress *p) {
  cli_session *s = user;
  cli_progress_stage(s->progress, p);
  cli_history_note(s);
  if (s->trace) dyd_trace_stage(s->trace, p);
}

int cli_trace_attach(dyd_engine_options *options, cli_session *s) {
  int status = s->options->trace && !s->trace ? trace_begin(s, options) : 0;
  options->progress = trace_stage;
  options->progress_user = s;
  options->trace = s->trace ? dyd_trace_step : NULL;
  options->trace_user = s->trace;
  return status;
}

int cli_trace_end(cli_session *s, dyd_outcome outcome) {
  dyd_error err;
  if (!s->trace_file.stream) return 0;
  dyd_error_clear(&err);
  dyd_status st = s->trace ? dyd_trace_end(s->trace, outcome, &err) : DYD_OK;
  bool good = fclose(s->trace_file.stream) == 0;
  s->trace = NULL;
  s->trace_file.stream = NULL;
  cli_output_drop(&s->trace_file);
  if (st == DYD_OK && good) return 0;
  cli_complain("%s: %s; choose another place with --trace", s->options->trace,
               st == DYD_OK ? strerror(errno) : err.message);
  return CLI_FAILED;
}
