/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The parts of the command: options, sessions, output files, signals, progress. It uses the public headers only.
 *
 *   main.c       finds out what is asked and does it
 *   table.c      all commands and options: parsing, help, manual page and completion come from there
 *   options.c    arguments to cli_options; values.c: the value of one option; suggest.c: "did you mean"
 *   complain.c   messages
 *   help*.c      --help, the manual page, completion scripts
 *   session.c    what commands share: read points, run the engine, write a result, exit status
 *   COMMAND.c    one file for each command */
#ifndef DYD_CLI_CLI_H
#define DYD_CLI_CLI_H

#include <dyadel/dyadel.h>
#include <pthread.h>
#include <signal.h>
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

/* All texts borrowed from argv; NULL where an option was not given, unless said otherwise. */
typedef struct cli_options {
  const char *command;
  const char *file;          /* the points file, or the certificate of verify; NULL with an oracle */
  const char *points;        /* verify: the points file */
  const char *at[2];         /* X Y of nearest */
  const char *queries;       /* or a file of places */
  const char *output;        /* NULL: standard output */
  const char *up_to, *sigma; /* of tolerance */
  dyd_metric metric;
  const char *accuracy, *pairs; /* of plan */
  unsigned site;                /* of plan */
  bool site_set, next;
  dyd_read_options read;
  const char *oracle;
  unsigned oracle_jobs, oracle_batch; /* 0: default */
  unsigned oracle_retries;
  double oracle_timeout; /* seconds; 0: default */
  dyd_engine_options engine;
  dyd_format format; /* one that the command can write; csv when not given */
  bool format_set;
  const char *layer; /* a name */
  dyd_list_ties list_ties;
  dyd_content content;  /* what is written: the layer, or all that the command says */
  unsigned epsg;        /* 0: not given */
  const char *window;   /* checked text: see cli_window_read */
  const dyd_rect *view; /* delaunay: the window read, which pictures show */
  int64_t flatten_bits;
  bool flatten_set;
  double max_arc; /* degrees; 0: default */
  const char *certificate, *trace, *replay, *resume, *plot;
  double trace_sync; /* seconds; 0: default */
  uint64_t seed;
  bool seed_set;
  unsigned schedules; /* 0: default */
  bool start_set;     /* engine.start_bits was given */
  bool max_bits_set;
  bool no_times, no_voronoi, of_voronoi, no_header;
  const char *label;
  bool discs;         /* delaunay: radii are discs */
  bool sphere, plane; /* points are longitude and latitude on a sphere; coordinates of a plane, whatever named */
  dyd_voronoi_bounds *bounds; /* voronoi: where the bounds of what is written go */
  size_t *cut;                /* voronoi: where the number of cells and regions goes that the deadline cut */
  dyd_history *history;       /* where each stage is noted, for html; NULL: nowhere */
  bool proved;                /* verify: by the checker that is proved */
  bool stats, quiet, version;
  bool accept_fixpoint; /* exit status 0 in place of CLI_FIXPOINT */
  const char *help;     /* "" (--help), or the kind of --help=KIND */
} cli_options;

/* options.c: 0, or CLI_USAGE after a message. */
int cli_options_read(cli_options *out, int argc, char **argv);

/* complain.c: prints "dyadel: ..." to standard error. */
void cli_complain(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* The same for what is no failure: --quiet leaves it out. */
void cli_note(const cli_options *o, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* "FILE:LINE:COLUMN: point N: message" as far as it is known. file NULL: left out. */
void cli_complain_at(const char *file, const dyd_error *err);
/* The same of a point of e, which is named by its row. */
void cli_complain_of(const dyd_engine *e, const char *file, const dyd_error *err);
/* Returns CLI_FAILED. */
int cli_complain_memory(void);

/* window.c: --window XLO,XHI,YLO,YHI. Ends that are no dyadics are rounded outward (dyd_real_from_interval).
 * out is initialised by the caller; 0, or an exit status after a message. */
int cli_window_read(dyd_rect *out, const char *text);

/* window.c: an exact number that is not negative, of the option --name; 0, or CLI_USAGE after a message. */
int cli_number_read(mpq_ptr out, const char *name, const char *text);

/* One function for each command, in a file of its own; returns the exit status. */
int cli_delaunay(const cli_options *o);
int cli_voronoi(const cli_options *o);
/* sphere.c: delaunay and voronoi with --sphere. */
int cli_sphere(const cli_options *o);
/* For reading points as longitude and latitude. */
void cli_options_degrees(cli_options *o);
int cli_check(const cli_options *o);
int cli_converge(const cli_options *o);
int cli_nearest(const cli_options *o);
int cli_tolerance(const cli_options *o);
int cli_plan(const cli_options *o);
int cli_verify(const cli_options *o);
/* proved.c: verify with --proved; `still`, the sites that stay, or NULL; `more` goes behind what is reported. */
int cli_verify_proved(const cli_options *o, FILE *still, const char *more);
int cli_disc(const cli_options *o);
int cli_bisector(const cli_options *o);

/* oracle.c: adds the points that the programs of --oracle serve. 0, or an exit status after a message. */
int cli_oracle_read(dyd_engine *e, const cli_options *o);

/* files.c: 0, or CLI_USAGE after a message when an output is an input or another output, or a picture would go to a
 * terminal. Nothing is read or written. */
int cli_files_check(const cli_options *o);
/* The file `name` ("-": standard input), read as bytes; NULL after a message that ends with the advice. */
FILE *cli_input_open(const char *name, const char *advice);
void cli_input_close(FILE *in);

/* output.c: a result file that appears whole or not at all. */
typedef struct cli_output {
  FILE *stream;
  const char *name;         /* as given, borrowed; NULL: standard output */
  char *target, *temporary; /* where it is to appear, NULL when written in place; its name till then, NULL: none */
} cli_output;

/* session.c: an engine with the points of the file (or oracle), and what goes on around it. */
typedef struct cli_progress cli_progress;
typedef struct cli_session {
  const cli_options *options; /* borrowed */
  dyd_engine *engine;
  cli_progress *progress;               /* may be NULL */
  double begun, share;                  /* of the time that is left, the engine's */
  bool forgot;                          /* memory was exhausted when a stage was noted */
  const dyd_pair_list *discs;           /* what was written of discs, borrowed; NULL: of none */
  const dyd_voronoi_bounds *bounds;     /* of the diagram written, borrowed; NULL: of none */
  const dyd_converge_options *converge; /* what a trace tells of them, borrowed; NULL: of none */
  dyd_trace *trace;                     /* NULL: none is written, or it has not begun */
  cli_output trace_file;
} cli_session;

/* trace.c. Gives the engine, not run yet, the answers of --resume. 0, or an exit status after a message. */
int cli_trace_resume(const cli_session *s);
/* Makes progress and --trace part of a run's options; the trace begins with the first. Status as above. */
int cli_trace_attach(dyd_engine_options *options, cli_session *s);
/* Ends the trace, if there is one. Status as above. */
int cli_trace_end(cli_session *s, dyd_outcome outcome);

/* Prints `what`; err is clear. Returns an error with *err filled, else DYD_OK. */
typedef dyd_status (*cli_print_fn)(FILE *out, const void *what, const cli_options *o, dyd_error *err);

/* history.c: makes o->history where the format shows stages; NULL otherwise. 0, or CLI_FAILED after a message. Release
 * with dyd_history_free. */
int cli_history_open(cli_options *o);
/* Notes the result of a stage there, if it is. Where memory is exhausted the run ends, and with it the command. */
void cli_history_note(cli_session *s);

/* All of a command that reads, runs, and prints one result: `print` gets the engine. Returns the exit status. */
int cli_session_all(const cli_options *o, cli_print_fn print);

/* Adds the points of the file or oracle to e. 0, or an exit status after a message. noting: notes tell what was left
 * out or is strange. */
int cli_points_read(dyd_engine *e, const cli_options *o);
int cli_points_read_noting(dyd_engine *e, const cli_options *o);
/* The same in steps. Each returns 0, or an exit status after a message; cli_session_close comes after any of them. */
int cli_session_open(cli_session *s, const cli_options *o);
/* Runs with options (progress and signals are added). 0 whatever the outcome, DYD_OUTCOME_ERROR aside: then
 * CLI_FAILED, and dyd_engine_delaunay tells whether there is a result all the same. */
int cli_session_run(cli_session *s, const dyd_engine_options *options);
/* The same, with something done around dyd_engine_run: run is called with the options completed. */
typedef dyd_status (*cli_run_fn)(dyd_engine *e, const dyd_engine_options *options, void *user, dyd_error *err);
int cli_session_run_by(cli_session *s, const dyd_engine_options *options, cli_run_fn run, void *user);
/* Comes before a result is written: takes the bar off a terminal that the result goes to. */
void cli_session_settle(cli_session *s);
/* Was the last run neither cancelled nor cut by the end of time, and is there a result? */
bool cli_run_was_whole(const dyd_engine *e);
/* Says that there is nothing to write, as the work ended before `what` ("the plan was") known, and how to mend that. */
int cli_session_stopped(const cli_session *s, const char *what);
/* Work that was cut short has a result all the same: says what is missing of it, and DYD_OK; other statuses stay. */
dyd_status cli_session_cut(dyd_status st, const dyd_error *err);
/* Exit status where work was cut short, by the end of time or on request. */
int cli_exit_cut(void);
/* Writes the certificate that the options ask for, after results were written with this status. Returns the status of
 * all. */
int cli_session_certificate(cli_session *s, int status, cli_print_fn print, const void *what);
/* Prints the result, from the engine, to --output, when there is one (otherwise says so). */
int cli_session_write(cli_session *s, cli_print_fn print);
/* Writes anything to the file `name` (NULL: standard output), whole or not at all. 0, or CLI_FAILED after a message. */
int cli_write_file(const char *name, const cli_options *o, cli_print_fn print, const void *what);
/* Prints notes and --stats as the outcome of the engine and `status` ask for, frees s; returns the exit status: that
 * of the outcome where status is 0. */
int cli_session_close(cli_session *s, int status);
int cli_exit_status(dyd_outcome outcome);
/* Why no more is known, and what to do. Static storage. */
const char *cli_outcome_advice(const dyd_engine *e);
/* goal.c: one line that tells which bound was asked for, which is reached, why it is no better (advice), and what to
 * do. false, and nothing said, where no bound was asked for. */
bool cli_note_goal(const cli_session *s, const char *advice);
/* The goals of --until, for the diagram in place of the triangulation. */
dyd_goal cli_voronoi_goal(dyd_goal goal);

/* notes.c: a line when radii were given and most of the rectangles meet another one. pd may be NULL. */
void cli_note_spacing(const dyd_delaunay *pd, const cli_options *o);
/* A line when points have no row in wkt or geojson, since they coincide with others. pd may be NULL. */
void cli_note_aliases(const dyd_delaunay *pd, const cli_options *o);

/* output.c. name NULL: standard output. false after a message. */
bool cli_output_open(cli_output *out, const char *name);
/* Makes the file appear under its name as far as it is written, and leaves it open; false after a message. */
bool cli_output_appear(cli_output *out);
/* Makes the file appear under its name, and closes it; false after a message. */
bool cli_output_finish(cli_output *out, const cli_options *o);
/* Removes what was written so far; nothing to do after cli_output_finish. */
void cli_output_drop(cli_output *out);
/* Where writing to the file of this name ends up, links followed, also one that leads to no file; release with free().
 * NULL: memory is exhausted. */
char *cli_output_target(const char *name);
/* Did a reader go away from a pipe before all was written to it? */
bool cli_output_lost_reader(void);
/* Writing to the stream, opened as `name` (NULL: standard output), failed. Is it as its reader went away? Then that is
 * noted, and true. */
bool cli_output_note_reader(FILE *stream, const char *name, const cli_options *o);
/* Sees to it that the descriptors 0, 1, 2 are taken, so that no file of ours gets one of them. */
bool cli_guard_descriptors(void);

/* signals.c: from now on the first SIGINT, SIGTERM or SIGHUP cancels the engine, the next one ends the process. NULL:
 * the first one ends it. */
void cli_signals_cancel(dyd_engine *e);
/* The file `temporary` (borrowed) is removed when a signal ends the process; cli_signals_keep takes that back. */
void cli_signals_remove(const char *temporary);
void cli_signals_keep(const char *temporary);
/* Removes these files; async-signal-safe. */
void cli_signals_unlink(void);
/* Holds all signals back, until they are released with what *before says. */
void cli_signals_hold(sigset_t *before);
void cli_signals_release(const sigset_t *before);
/* Starts a thread that takes no signals: those that the main thread holds back stay held back. */
bool cli_signals_spare(pthread_t *out, void *(*work)(void *), void *user);
/* Raises the flag below; async-signal-safe, from any thread. */
void cli_signals_stop(void);
/* Set to 1 by the signal that cancels the engine, and at the deadline: for work on what the engine has found. */
const volatile int *cli_signals_flag(void);

/* memory.c: when memory for long numbers is exhausted the process ends with CLI_FAILED after a message. Before anything
 * else. */
void cli_memory_guard(void);

/* deadline.c: what --timeout gives the whole command. seconds <= 0: no limit. */
void cli_deadline_start(double seconds);
/* What is being done now, as in "reading"; static text. */
void cli_deadline_phase(const char *what);
/* All is written and told; what follows (programs of an oracle are given time to end) may be cut, with this status. */
void cli_deadline_written(int status);
/* Of the seconds left, such a share, above 0; 0: there is no limit. For options of the engine. */
double cli_deadline_left(double share);
/* Set to 1 at the deadline, by another thread: for those who take a flag to be cancelled by. */
const volatile int *cli_deadline_flag(void);
bool cli_deadline_passed(void);
/* Seconds of a clock that only goes forward. */
double cli_clock(void);

/* progress.c: NULL when quiet or out of memory: all functions take NULL. */
cli_progress *cli_progress_start(bool quiet);
/* What is being done now ("reading"); static text. */
void cli_progress_phase(cli_progress *p, const char *phase);
/* For dyd_engine_options.progress; user is the cli_progress. */
void cli_progress_stage(void *user, const dyd_progress *stage);
/* Wipes the bar off the terminal and frees p. */
void cli_progress_stop(cli_progress *p);

/* stats.c: what --stats prints. `seconds` since the command began. */
void cli_stats(FILE *out, const dyd_engine *e, const dyd_sphere *sphere, const dyd_pair_list *discs, double seconds);

#endif
