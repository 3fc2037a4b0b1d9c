/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What bisector and disc share: the points as streams, narrowed until a question is answered. */
#include "pieces.h"
#include <stdlib.h>

enum { FIRST_BITS = 64, DEFAULT_MAX_BITS = 4096 };

static int out_of_memory(void) {
  cli_complain("memory is exhausted; close other programs");
  return CLI_FAILED;
}

static int fail_at_point(const cli_pieces *p, size_t i, dyd_status status, dyd_error *err) {
  err->point = i;
  if (!err->message[0]) snprintf(err->message, sizeof err->message, "%s", dyd_status_text(status));
  cli_complain_at(p->session.options->file, err);
  return CLI_FAILED;
}

static int narrow(cli_pieces *p, size_t i) {
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status status = dyd_stream_narrow(p->stream[i], p->bits, p->max_bits, &err);
  if (status < 0) return fail_at_point(p, i, status, &err);
  p->rect[i] = dyd_stream_rect(p->stream[i]);
  return 0;
}

int cli_pieces_open(cli_pieces *p, const cli_options *o, size_t least, size_t most) {
  *p = (cli_pieces){.bits = FIRST_BITS};
  int status = cli_session_open(&p->session, o);
  if (status) return status;
  p->max_bits = o->engine.max_bits ? o->engine.max_bits : DEFAULT_MAX_BITS;
  if (p->bits > p->max_bits) p->bits = p->max_bits;
  size_t count = dyd_engine_count(p->session.engine);
  if (count < least) {
    cli_complain("%s: %zu points are needed, here are %zu; give more", o->file ? o->file : "the oracle", least, count);
    return CLI_FAILED;
  }
  count = count < most ? count : most;
  p->stream = calloc(count, sizeof *p->stream);
  p->rect = calloc(count, sizeof *p->rect);
  if (!p->stream || !p->rect) return out_of_memory();
  cli_signals_cancel(p->session.engine);
  for (; p->count < count && !status; p->count++) {
    if (cli_signals_cancelled()) {
      cli_complain("cancelled before the points were known: there is no result to write");
      return CLI_CANCELLED;
    }
    if (dyd_engine_stream(&p->stream[p->count], p->session.engine, (uint32_t)p->count) < 0) return out_of_memory();
    status = narrow(p, p->count);
  }
  return status;
}

/* Asks the points that are wanted for more; *moved tells whether one could be narrowed. */
static int refine(bool *moved, cli_pieces *p, cli_wanted_fn wanted) {
  *moved = false;
  p->bits = p->bits > p->max_bits / 2 ? p->max_bits : 2 * p->bits;
  for (size_t i = 0; i < p->count && !cli_signals_cancelled(); i++) {
    if (!wanted(p, i) || dyd_stream_is_final(p->stream[i])) continue;
    *moved = true;
    int status = narrow(p, i);
    if (status) return status;
  }
  return 0;
}

static int run(cli_pieces *p, cli_answered_fn answered, cli_wanted_fn wanted) {
  const cli_options *o = p->session.options;
  for (bool moved = true;;) {
    if (answered(p)) return p->outcome = DYD_OUTCOME_DECIDED, 0;
    if (cli_signals_cancelled()) return p->outcome = DYD_OUTCOME_CANCELLED, 0;
    if (!moved) return p->outcome = DYD_OUTCOME_FIXPOINT, 0;
    bool late = o->engine.seconds > 0 && cli_clock() - p->session.begun > o->engine.seconds;
    p->outcome = DYD_OUTCOME_BUDGET;
    if (late || p->bits >= p->max_bits) break;
    int status = refine(&moved, p, wanted);
    if (status) return status;
  }
  for (size_t i = 0; i < p->count; i++)
    if (wanted(p, i) && !dyd_stream_is_final(p->stream[i])) return 0;
  p->outcome = DYD_OUTCOME_FIXPOINT;
  return 0;
}

int cli_pieces_run(cli_pieces *p, cli_answered_fn answered, cli_wanted_fn wanted) {
  cli_progress_phase(p->session.progress, "refining");
  int status = run(p, answered, wanted);
  cli_signals_remove(NULL);
  cli_session_settle(&p->session);
  return status;
}

static void note(const cli_pieces *p) {
  if (p->outcome == DYD_OUTCOME_CANCELLED) cli_complain("cancelled: stopped on request; this much was known before");
  if (p->outcome == DYD_OUTCOME_FIXPOINT)
    cli_complain("fixpoint: no refinement can decide the rest: exact ties or fixed rectangles");
  if (p->outcome == DYD_OUTCOME_BUDGET)
    cli_complain("budget: the precision or the time is used up; raise --max-bits or --timeout, unless the points are "
                 "tied");
}

int cli_pieces_close(cli_pieces *p, int status) {
  if (!status) status = cli_exit_status(p->outcome);
  bool quiet = p->session.options->quiet;
  cli_signals_remove(NULL); /* the engine goes */
  for (size_t i = p->count; i-- > 0;) dyd_stream_free(p->stream[i]);
  free(p->stream);
  free(p->rect);
  cli_session_close(&p->session, CLI_FAILED);
  if (!quiet && status) note(p);
  return status;
}
