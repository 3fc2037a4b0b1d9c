/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What each stage of a run says, for formats with a slider over the stages. */
#include "cli.h"

int cli_history_open(cli_options *o) {
  if (o->format != DYD_FORMAT_HTML || dyd_history_new(&o->history) == DYD_OK) return 0;
  return cli_complain_memory();
}

void cli_history_note(cli_session *s) {
  dyd_history *history = s->options->history;
  if (!history || s->forgot) return;
  s->forgot = dyd_history_note(history, dyd_engine_delaunay(s->engine)) != DYD_OK;
  if (s->forgot) dyd_engine_cancel(s->engine);
}
