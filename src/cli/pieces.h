/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What bisector and disc share: the points as streams, narrowed until a question is answered. */
#ifndef DYD_CLI_PIECES_H
#define DYD_CLI_PIECES_H

#include "cli.h"

/* Invariant: stream[i] is owned, rect[i] is its rectangle (borrowed), i < count. */
typedef struct cli_pieces {
  cli_session session;
  dyd_stream **stream;
  const dyd_rect **rect;
  size_t count;
  int64_t bits, max_bits;
  dyd_outcome outcome;
} cli_pieces;

/* Is everything known? Does knowing more about point i help? */
typedef bool (*cli_answered_fn)(cli_pieces *p);
typedef bool (*cli_wanted_fn)(const cli_pieces *p, size_t i);

/* Reads the points, `least` of them at least, and takes the first `most`. 0, or an exit status after a message;
 * cli_pieces_close comes after it in any case. */
int cli_pieces_open(cli_pieces *p, const cli_options *o, size_t least, size_t most);
/* Doubles the precision of the points wanted until the question is answered, they are final, the budget is spent, or a
 * signal asks to stop; sets outcome. 0, or an exit status after a message. */
int cli_pieces_run(cli_pieces *p, cli_answered_fn answered, cli_wanted_fn wanted);
/* Frees; returns the exit status: that of the outcome where status is 0. */
int cli_pieces_close(cli_pieces *p, int status);

#endif
