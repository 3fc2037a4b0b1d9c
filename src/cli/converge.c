/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel converge FILE: a run stage by stage, as a table. */
#include "cli.h"

static dyd_status write_table(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  return dyd_write_convergence(out, what, o->format, !o->no_times, err);
}

/* Runs with the table being made; the outcome goes where cli_session_run puts it. */
static dyd_status run(dyd_engine *e, const dyd_engine_options *options, void *user, dyd_error *err) {
  return dyd_converge_run(user, e, options, NULL, err);
}

int cli_converge(const cli_options *o) {
  cli_session s;
  dyd_convergence table = {0};
  dyd_engine_options options = o->engine;
  if (!o->start_set) options.start_bits = 4;
  int status = cli_session_open(&s, o);
  if (status == 0) {
    status = cli_session_run_by(&s, &options, run, &table);
    int written = table.count ? cli_write_file(o->output, o, write_table, &table) : 0;
    if (status == 0) status = written;
  }
  dyd_convergence_clear(&table);
  return cli_session_close(&s, status);
}
