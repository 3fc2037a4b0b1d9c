/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What bisector and disc share: a question about the first points of a file, put to the engine. */
#include "pieces.h"
#include <stdlib.h>

enum { FIRST_BITS = 64 };

/* ---- the question ---- */

static bool pieces_are_known(const cli_pieces *p) {
  for (size_t i = 0; i < p->count; i++)
    if (!dyd_engine_knows(p->session.engine, (uint32_t)i)) return false;
  return true;
}

/* At each precision the points that make the piece come first, then, by what they are now, those others that are
 * wanted. Where one of both wants nothing it is the turn of the other. */
static dyd_status pieces_plan(dyd_plan *plan, cli_pieces *p) {
  dyd_status st = DYD_OK;
  for (int turn = 0; turn < 2 && st == DYD_OK && !dyd_plan_count(plan); turn++) {
    size_t end = p->rest ? p->count : p->first;
    if (!p->rest) p->bits *= 2;
    for (size_t i = p->rest ? p->first : 0; st == DYD_OK && i < end; i++)
      if (p->wanted(p, i)) st = dyd_plan_add(plan, (uint32_t)i, p->bits);
    p->rest = !p->rest;
  }
  return st;
}

/* Before all points have a rectangle nothing can be said. */
static dyd_status pieces_ask(bool *answered, dyd_plan *plan, void *user, const dyd_engine *e, dyd_error *err) {
  cli_pieces *p = user;
  dyd_status st = DYD_OK;
  (void)err;
  if (!pieces_are_known(p)) {
    for (size_t i = 0; st == DYD_OK && i < p->count; i++) st = dyd_plan_add(plan, (uint32_t)i, p->bits);
    return st;
  }
  for (size_t i = 0; st == DYD_OK && i < p->count; i++) st = dyd_sites_get(&p->own[i], dyd_engine_sites(e), i);
  *answered = st == DYD_OK && p->answered(p);
  return st == DYD_OK && !*answered ? pieces_plan(plan, p) : st;
}

/* Asks it; 0, or an exit status after a message. */
static int pieces_run(cli_pieces *p) {
  const cli_options *o = p->session.options;
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = pieces_ask, .user = p};
  dyd_engine_options options = o->engine;
  dyd_error err;
  int status = cli_trace_attach(&options, &p->session);
  if (status) return status;
  cli_progress_phase(p->session.progress, "refining");
  cli_signals_cancel(p->session.engine);
  dyd_status st = dyd_engine_ask(&p->outcome, p->session.engine, &question, &options, &err);
  cli_signals_cancel(NULL);
  status = cli_trace_end(&p->session, p->outcome);
  if (st != DYD_OK)
    cli_complain_of(p->session.engine, o->file, &err);
  else if (!pieces_are_known(p))
    cli_complain("%s before the points were known: there is no result to write", dyd_outcome_text(p->outcome));
  if (st != DYD_OK || status) return CLI_FAILED;
  return pieces_are_known(p) ? 0 : cli_exit_status(p->outcome);
}

/* ---- the command ---- */

/* Room for `count` rectangles. */
static bool pieces_reserve(cli_pieces *p, size_t count) {
  p->own = calloc(count, sizeof *p->own);
  p->rect = calloc(count, sizeof *p->rect);
  if (!p->own || !p->rect) return false;
  for (; p->count < count; p->count++) {
    dyd_rect_init(&p->own[p->count]);
    p->rect[p->count] = &p->own[p->count];
  }
  return true;
}

static int pieces_open(cli_pieces *p, const cli_options *o, size_t least, size_t most) {
  int status = cli_session_open(&p->session, o);
  if (status) return status;
  size_t count = dyd_engine_count(p->session.engine);
  if (count < least) {
    cli_complain("%s: %zu points are needed, here are %zu; give more", o->file ? o->file : "the oracle", least, count);
    return CLI_FAILED;
  }
  if (pieces_reserve(p, count < most ? count : most)) return 0;
  return cli_complain_memory();
}

static void pieces_note(const cli_pieces *p) {
  if (p->outcome == DYD_OUTCOME_CANCELLED) cli_complain("cancelled: stopped on request; this much was known before");
  if (p->outcome == DYD_OUTCOME_FIXPOINT)
    cli_complain("fixpoint: nothing that is open can be refined: exact ties or fixed rectangles");
  if (p->outcome == DYD_OUTCOME_BUDGET)
    cli_complain("budget: the precision or the time is used up; raise --max-bits or --timeout, unless the points are "
                 "tied");
}

static void pieces_close(cli_pieces *p) {
  for (size_t i = p->count; i-- > 0;) dyd_rect_clear(&p->own[i]);
  free(p->rect);
  free(p->own);
  cli_session_close(&p->session, CLI_FAILED);
}

int cli_pieces_all(const cli_options *o, size_t least, size_t most, cli_answered_fn answered, cli_wanted_fn wanted,
                   cli_print_fn print) {
  cli_pieces p = {.answered = answered, .wanted = wanted, .first = least, .bits = FIRST_BITS};
  int status = pieces_open(&p, o, least, most);
  if (!status) status = pieces_run(&p);
  bool known = !status;
  cli_session_settle(&p.session);
  if (known) status = cli_write_file(o->output, o, print, &p);
  pieces_close(&p);
  if (!status) status = cli_exit_status(p.outcome);
  if (known && !o->quiet && status) pieces_note(&p);
  return status;
}
