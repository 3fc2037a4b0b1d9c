/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The parts of the command: options, output files, signals, progress. It uses the public headers only. */
#ifndef DYD_CLI_CLI_H
#define DYD_CLI_CLI_H

#include <dyadel/dyadel.h>
#include <stdbool.h>
#include <stdio.h>

/* Exit statuses; part of the interface. */
enum {
  CLI_OK = 0, /* decided or certified */
  CLI_FAILED = 1,
  CLI_USAGE = 2,
  CLI_FIXPOINT = 3,
  CLI_BUDGET = 4,
  CLI_CANCELLED = 5
};

/* All texts borrowed from argv. */
typedef struct cli_options {
  const char *command;
  const char *file;
  const char *output; /* NULL: standard output */
  dyd_read_options read;
  dyd_engine_options engine;
  dyd_format format;
  bool stats, quiet, help, version;
} cli_options;

/* options.c: 0, or CLI_USAGE after a message. */
int cli_options_read(cli_options *out, int argc, char **argv);
void cli_help(FILE *out);
/* Prints "dyadel: ..." to standard error. */
void cli_complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* delaunay.c: the command; returns the exit status. */
int cli_delaunay(const cli_options *o);

/* output.c: a result file that appears whole or not at all. */
typedef struct cli_output {
  FILE *stream;
  char *target, *temporary; /* NULL when written in place */
} cli_output;
/* name NULL: standard output. false after a message. */
bool cli_output_open(cli_output *out, const char *name);
/* Makes the file appear under its name; false after a message. */
bool cli_output_finish(cli_output *out);
/* Removes what was written so far; nothing to do after cli_output_finish. */
void cli_output_drop(cli_output *out);
/* Sees to it that the descriptors 0, 1, 2 are taken, so that no file of ours gets one of them. */
bool cli_guard_descriptors(void);

/* signals.c: the first SIGINT or SIGTERM cancels the engine, the next one ends the process. */
void cli_signals_cancel(dyd_engine *e);
/* Signals end the process; the file `temporary` (may be NULL, borrowed) is removed before. */
void cli_signals_remove(const char *temporary);

/* progress.c */
typedef struct cli_progress cli_progress;
/* NULL when quiet or out of memory: all functions take NULL. */
cli_progress *cli_progress_start(bool quiet);
/* What is being done now ("reading"); static text. */
void cli_progress_phase(cli_progress *p, const char *phase);
/* For dyd_engine_options.progress; user is the cli_progress. */
void cli_progress_stage(const dyd_progress *stage, void *user);
/* Wipes the bar off the terminal and frees p. */
void cli_progress_stop(cli_progress *p);

/* stats.c: what --stats prints. `seconds` since the command began. */
void cli_stats(FILE *out, const dyd_engine *e, double seconds);
/* Seconds of a clock that only goes forward. */
double cli_clock(void);

#endif
