/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What bisector and disc share: a question about the first points of a file, put to the engine. */
#ifndef DYD_CLI_PIECES_H
#define DYD_CLI_PIECES_H

#include "cli.h"

typedef struct cli_pieces cli_pieces;
/* Is everything known? Does knowing more about point i help? */
typedef bool (*cli_answered_fn)(const cli_pieces *p);
typedef bool (*cli_wanted_fn)(const cli_pieces *p, size_t i);

/* Invariant: rect[i] is &own[i], i < count. */
struct cli_pieces {
  cli_session session;
  cli_answered_fn answered;
  cli_wanted_fn wanted;
  dyd_rect *own;
  const dyd_rect **rect;
  size_t count, first; /* of all points, and of those that the piece is made of */
  int64_t bits;        /* the precision worked towards */
  bool rest;           /* points `first` and on are next at this precision */
  dyd_outcome outcome;
};

/* All of such a command: reads the points; the piece is made of the first `least`; takes the first `most`, doubles the
 * precision of those that are wanted until the question is answered, they are final, the budget is spent, or a signal
 * asks to stop, and prints. `print` gets the cli_pieces. Returns the exit status. */
int cli_pieces_all(const cli_options *o, size_t least, size_t most, cli_answered_fn answered, cli_wanted_fn wanted,
                   cli_print_fn print);

#endif
