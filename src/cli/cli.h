/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The parts of the command. It uses the public headers only.
 *
 *   main.c       the words, then help or a command
 *   table.c      all commands and options, made of the texts in manual/: parsing, help, manual page and completion come
 *                from there
 *   options.c    arguments to cli_options, values of options
 *   help.c       --help, the manual page, completion scripts
 *   session.c    runs a command: reads points, runs the engine, writes a result and a trace, exit status
 *   output.c     result files, whole or not at all, packed or not
 *   spatial.c    which files take GDAL
 *   gdal.c       reading and writing these, in the program dyadel-gdal
 *   process.c    messages, signals, time limit, memory, progress
 *
 * The other files hold the commands, a row cli_work each. */
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
  dyd_content content; /* the layer, or the whole content of the command */
  unsigned epsg;       /* 0: not given */
  const char *in_layer;
  const char *driver; /* of GDAL, which writes the output; NULL: none does */
  bool all_layers;    /* it gets all layers */
  char *crs;          /* WKT of the reference system of the points file; NULL: not known; freed by no one */
  const char *window; /* checked text: see cli_window_read */
  int64_t flatten_bits;
  bool flatten_set;
  int64_t relative_bits;                /* tolerance; 0: default */
  double max_arc;                       /* degrees; 0: default */
  const char *query_columns, *query_id; /* of the file of queries */
  const char *certificate, *trace, *replay, *resume, *plot, *pgf;
  double trace_sync; /* seconds; 0: default */
  uint64_t seed;
  bool seed_set;
  unsigned schedules; /* 0: default */
  unsigned simulate;  /* trials of a plan; 0: none, the plan itself */
  bool start_set;     /* engine.start_bits was given */
  bool max_bits_set;
  bool no_times, no_header;
  dyd_converge_of of;
  const char *modulus; /* A:B */
  uint64_t hindsight;
  const char *label;
  bool discs;         /* delaunay: radii are discs */
  bool sphere, plane; /* points are longitude and latitude on a sphere; coordinates of a plane, whatever named */
  bool proved;        /* verify: by the checker that is proved */
  bool stats, quiet, version;
  bool comments; /* csv begins with lines of "# " */
  bool lengths, clip;
  dyd_write_style style;
  const char *clip_to;  /* file of an area */
  bool accept_fixpoint; /* exit status 0 instead of CLI_FIXPOINT */
  const char *help;     /* "" (--help), or the kind of --help=KIND */
} cli_options;

/* options.c: 0, or CLI_USAGE after a message. call, of argc + 1 words, becomes those on which the result depends, up to
 * a NULL: json repeats them with --comments, so that equal results are equal files. Borrowed by *out. */
int cli_options_read(cli_options *out, int argc, char **argv, char **call);

/* process.c: print "dyadel: ..." to standard error. All that complain return CLI_FAILED, this one CLI_USAGE. */
int cli_complain(const char *format, ...) __attribute__((format(printf, 1, 2)));
int cli_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* Prints a note, unless --quiet was given. */
void cli_note(const cli_options *o, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Prints notes on the rows of a file: rows skipped, and values read in another way than written. */
void cli_note_lines(const cli_options *o, const dyd_read_report *r);
/* A name or list of names as a shell takes it, quoted where that is needed. */
void cli_shell_name(char *out, size_t size, const char *name);
/* Prints these and notes on the points, which e holds: merged points, and points with another possible meaning. */
void cli_note_points(const dyd_engine *e, const cli_options *o, const dyd_read_report *r);
/* An area to clip to in whose bounds no point is: degrees and metres are the usual reason. */
void cli_note_area(const dyd_engine *e, const cli_options *o, const dyd_rect *window);
/* "FILE:LINE:COLUMN: point N: message" as far as it is known. file NULL: without FILE. */
int cli_complain_at(const char *file, const dyd_error *err);
/* The same of a point of e, which is named by its row. */
int cli_complain_of(const dyd_engine *e, const char *file, const dyd_error *err);
int cli_complain_memory(void);
/* Where the library failed with st: CLI_BUDGET if --max-bytes refused memory, else CLI_FAILED. */
int cli_exit_refused(const cli_options *o, dyd_status st);

/* options.c: --window XLO,XHI,YLO,YHI. Ends that are no dyadics are rounded outward (dyd_real_from_interval).
 * out is initialised by the caller; 0, or an exit status after a message. */
int cli_window_read(dyd_rect *out, const char *text);

/* What numbers of options may have besides digits: a sign, and blanks in front. */
enum { CLI_FORMS = DYD_NUMBER_INDENT | DYD_NUMBER_MINUS | DYD_NUMBER_PLUS };

/* options.c: the whole number that is all of the text; false, with *out undefined, if it is none from least to most. */
bool cli_integer_read(int64_t *out, const char *text, size_t length, unsigned forms, int64_t least, int64_t most);
/* The same of field k. */
bool cli_field_integer(int64_t *out, const dyd_record *row, size_t k, int64_t least, int64_t most);

/* options.c: an exact number that is not negative, of the option --name; 0, or CLI_USAGE after a message. */
int cli_number_read(mpq_ptr out, const char *name, const char *text);

/* output.c: 0, or CLI_USAGE after a message when an output is an input or another output, or a picture would go to a
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

/* ---- files that take GDAL ---- */

/* spatial.c: what kind of file GDAL has to read, "GeoPackage"; NULL: text, none, or not known. */
const char *cli_spatial_kind(const char *name);
/* The name of the driver of GDAL that writes files of this ending, and whether these hold several layers; NULL: none,
 * also where ending is NULL. */
const char *cli_spatial_driver(bool *layers, const char *ending);
/* Sets path to the folder of this command, with a / at its end; "" where it is not known. */
void cli_folder_find(char *path, size_t size);
/* Becomes dyadel-gdal where the options take GDAL and this program has none. 0, or CLI_USAGE after a message. */
int cli_spatial_switch(const cli_options *o, char **argv);

typedef struct cli_session cli_session;
/* Prints the result; err is clear. Returns an error with *err filled, else DYD_OK. */
typedef dyd_status (*cli_print_fn)(FILE *out, const cli_session *s, dyd_error *err);

/* What GDAL does, in gdal.c. */
typedef struct cli_gdal {
  /* Opens the points of the file as a table for dyd_read_points, and completes the options by which it is read, and the
   * reference system. 0, or an exit status after a message. */
  int (*open)(FILE **out, const char *name, cli_options *o);
  /* Ends that. false after a message that reading failed. */
  bool (*close)(FILE *in, const char *name);
  /* Writes o.output, all layers or the one named. 0, or an exit status after a message. */
  int (*write)(cli_session *s, cli_print_fn print);
} cli_gdal;
extern const cli_gdal *const cli_gdal_here; /* NULL in dyadel */

/* Returns true if the name has the ending of gzip or zstd. *length: length of the part before it. */
bool cli_name_is_packed(size_t *length, const char *name);
/* svg, pdf, png, tikz. */
bool cli_is_picture(dyd_format format);

/* ---- a command at work: session.c ---- */

/* Asks the engine of s; options are complete. */
typedef dyd_status (*cli_run_fn)(cli_session *s, const dyd_engine_options *options, dyd_error *err);

/* The row of a command. cli_work_run does the rest: it reads the points, writes the result and its certificate,
 * ends the trace. Functions may be NULL, but for find. */
typedef struct cli_work {
  size_t size;                                             /* of s->state: zero before begin */
  bool bare;                                               /* no engine, no points are read */
  const struct cli_work *(*instead)(const cli_options *o); /* the row that these options ask for; NULL: this one */
  /* Before points are read: checks for contradicting options, other inputs. 0, or an exit status after a message. */
  int (*begin)(cli_session *s);
  /* Finds the result: sets s->known if there is one, else reports why not. 0, or an exit status after a message. */
  int (*find)(cli_session *s);
  cli_print_fn write, prove; /* the result; its certificate */
  /* After all is written with this status: reports the undecided part of the result. Returns the exit status. */
  int (*summary)(cli_session *s, int status);
  void (*end)(cli_session *s); /* frees the contents of state; also after a begin that failed */
} cli_work;
extern const cli_work cli_delaunay, cli_voronoi, cli_sphere, cli_converge, cli_check, cli_verify, cli_disc,
    cli_bisector, cli_nearest, cli_tolerance, cli_plan;

/* What writing a diagram has found. */
typedef struct cli_diagram {
  dyd_voronoi_bounds bounds;
  size_t cut;        /* cells and regions that were not worked out */
  size_t coincident; /* points without a tile of their own */
  dyd_area clip_to;  /* --clip-to */
} cli_diagram;

typedef struct cli_progress cli_progress;
struct cli_session {
  const cli_work *work;
  cli_options o; /* its own */
  void *state;
  dyd_engine *engine;
  cli_progress *progress; /* may be NULL */
  dyd_outcome outcome;    /* of the last question to the engine */
  bool known;             /* there is a result to write */
  int written;            /* exit status of writing it */
  dyd_rect window;
  const dyd_rect *view;                 /* the window given; NULL: none */
  dyd_history *history;                 /* of the stages, for html; NULL: none */
  double begun, share;                  /* of the time that is left, the engine's */
  bool forgot;                          /* memory was exhausted when a stage was noted */
  const dyd_pair_list *discs;           /* pairs of discs, borrowed; NULL: none */
  const dyd_graph_list *graph;          /* of a layer that is a graph, borrowed; NULL: not known */
  cli_diagram *diagram;                 /* receives the diagram found on writing, borrowed; NULL: none */
  const dyd_voronoi_bounds *bounds;     /* of the diagram written, borrowed; NULL: none */
  const dyd_converge_options *converge; /* for the trace, borrowed; NULL: none */
  FILE *noted;                          /* takes the comments of csv, for standard error; NULL: they are not noted */
  char *note;                           /* text taken by `noted` */
  size_t note_size;
  const char *radius, *resume; /* of places of a sphere, while points are read without; NULL: none */
  dyd_sphere *sphere;          /* of --sphere; owned; NULL: none */
  dyd_engine *places;          /* of it, while `engine` holds the images; NULL: engine holds the places */
  dyd_trace *trace;            /* NULL: none is written, or it has not begun */
  cli_output trace_file;
};

/* All of a command. Returns the exit status. */
int cli_work_run(const cli_work *work, const cli_options *o);

/* Adds the points of the file or oracle to e. 0, or an exit status after a message. noting: prints notes on skipped
 * rows and doubtful input. */
int cli_points_read(dyd_engine *e, cli_options *o, bool noting);
/* The same of the file of queries: a table where its header has --query-columns, or the names of --columns; else a
 * points file. */
int cli_places_read(dyd_engine *e, const cli_options *o);
/* For reading points as longitude and latitude. */
void cli_options_degrees(cli_options *o);
/* Returns true if the number of EPSG is known as that of a system in degrees. */
bool cli_crs_is_degrees(unsigned epsg);
/* delaunay.c: what a command with --sphere begins with: points are read as degrees. */
void cli_sphere_begin(cli_session *s);
/* Makes s->sphere of the points read, and restores the options --radius and --resume. 0, or an exit status after a
 * message. */
int cli_sphere_make(cli_session *s, bool no_images);
/* Makes it, and has s->engine hold its images, with the answers of --resume, until the end of the command. 0, or an
 * exit status after a message. */
int cli_sphere_look(cli_session *s);
/* Gives the engine, not run yet, the answers of --resume. 0, or an exit status after a message. */
int cli_trace_resume(const cli_session *s);
/* Runs with options; progress, trace and signals are added. 0 whatever the outcome, DYD_OUTCOME_ERROR aside: then
 * CLI_FAILED, and there may still be a result (dyd_engine_delaunay). */
int cli_session_run(cli_session *s, const dyd_engine_options *options, cli_run_fn run);
/* dyd_engine_run, a cli_run_fn. */
dyd_status cli_run_engine(cli_session *s, const dyd_engine_options *options, dyd_error *err);
/* Comes before a result is written: takes the bar off a terminal that the result goes to. */
void cli_session_settle(cli_session *s);
/* Reports that the run ended before `what`: "the points were known". */
void cli_session_lacks(cli_session *s, dyd_outcome outcome, const char *what);
/* The same with the remedy for work that was cut short ("the plan was"). Returns the exit status. */
int cli_session_stopped(cli_session *s, const char *what);
/* Returns true if the last run has a result and was stopped neither by a cancel nor by the time limit. */
bool cli_run_was_whole(const dyd_engine *e);
/* Returns true for layers that are graphs of neighbours. */
static inline bool cli_layer_is_graph(dyd_content layer) {
  return layer >= DYD_CONTENT_GRAPH_NEAREST && layer <= DYD_CONTENT_GRAPH_MST;
}
/* DYD_CANCELLED, a partial result: reports the missing part, and returns DYD_OK. Returns other statuses unchanged. */
dyd_status cli_session_cut(dyd_status st, const dyd_error *err);
/* Exit status where work was cut short, by the end of time or on request. */
int cli_exit_cut(void);
int cli_exit_status(dyd_outcome outcome);
/* Returns the reason why statuses are undecided, and the remedy. Static storage. */
const char *cli_outcome_advice(const dyd_engine *e);
/* The line that sums up a result with undecided pairs (dyd_pair_status counts) and names the next step; advice NULL:
 * that of the outcome. */
void cli_note_pairs(const cli_session *s, dyd_outcome outcome, const size_t count[4], const char *advice);
/* A line where the run ended before all pairs were found: readers take pairs without a row for illegal. */
void cli_note_unlisted(const cli_session *s);
/* Writes anything to the file `name` (NULL: standard output), whole or not at all. 0, or an exit status after a
 * message. */
int cli_write_file(const char *name, const cli_session *s, cli_print_fn print);
/* What most results take, from the options and the session: window, discs, sphere, history, names, comments. */
dyd_write_options cli_write_options(FILE *out, const cli_session *s);
/* Writes the result of the engine of s in the layer and format of its options. */
dyd_status cli_write(FILE *out, const cli_session *s, const dyd_write_options *how, dyd_error *err);
/* The summary of a triangulation: undecided pairs and the reason, notes on radii and equal points, --stats. */
int cli_pairs_summary(cli_session *s, int status);
/* False after a message: there are fewer points than needed. */
bool cli_has_points(const cli_session *s, size_t least);
/* Reports why a disc or bisector is not better known. Returns the exit status. */
int cli_pieces_outcome(const cli_session *s);
/* The same of a sphere. */
int cli_sphere_summary(cli_session *s, int status);
/* A line when radii were given and most of the rectangles, or of the regions of a sphere, meet another one. */
void cli_note_spacing(const cli_session *s, const dyd_delaunay *pd);
/* The goals of --until, for the diagram instead of the triangulation. */
dyd_goal cli_voronoi_goal(dyd_goal goal);
/* Prints counters if --stats was given. */
void cli_session_stats(const cli_session *s, const dyd_sphere *sphere);

/* output.c. name NULL: standard output. false after a message. */
bool cli_output_open(cli_output *out, const char *name);
/* Makes the file appear under its name as far as it is written, and leaves it open; false after a message. */
bool cli_output_appear(cli_output *out);
/* Makes the file appear under its name, and closes it; false after a message. */
bool cli_output_finish(cli_output *out, const cli_options *o);
/* Removes the file begun; does nothing after cli_output_finish. */
void cli_output_drop(cli_output *out);
/* Returns true if an output pipe was closed before all was written to it. */
bool cli_output_lost_reader(void);
/* To be called after a failed write to the stream, opened as `name` (NULL: standard output). If its reader closed the
 * pipe, prints a note and returns true. */
bool cli_output_note_reader(FILE *stream, const char *name, const cli_options *o);
/* Ensures that the descriptors 0, 1, 2 are in use, so that no file of ours gets one of them. */
bool cli_guard_descriptors(void);

/* process.c: from now on the first SIGINT, SIGTERM or SIGHUP cancels the engine, the next one ends the process. NULL:
 * the first one ends it. */
void cli_signals_cancel(dyd_engine *e);
/* The file `temporary` (borrowed) is removed when a signal ends the process; cli_signals_keep takes that back. */
void cli_signals_remove(const char *temporary);
void cli_signals_keep(const char *temporary);
/* Blocks all signals, until they are released with the mask *before. */
void cli_signals_hold(sigset_t *before);
void cli_signals_release(const sigset_t *before);
/* Set to 1 by the signal that cancels the engine, and at the deadline: for work on the result of the engine. */
const volatile int *cli_signals_flag(void);

/* process.c: when memory for long numbers is exhausted the process ends with CLI_FAILED after a message. Before
 * anything else. */
void cli_memory_guard(void);

/* process.c: the time limit of the whole command. seconds <= 0: no limit. */
void cli_deadline_start(double seconds);
/* The same in a child of the process: only the flags are raised. */
void cli_deadline_again(void);
/* Names the present work, "reading"; static text. */
void cli_deadline_phase(const char *what);
/* All output and messages are written. The rest (waiting for oracle programs to end) may be cut, with this status. */
void cli_deadline_written(int status);
/* Returns this share of the seconds left, above 0; 0 without a limit. For options of the engine. */
double cli_deadline_left(double share);
/* A cancellation flag that another thread sets to 1 at the deadline. */
const volatile int *cli_deadline_flag(void);
bool cli_deadline_passed(void);
/* Seconds of a clock that only goes forward. */
double cli_clock(void);

/* process.c: NULL when quiet or out of memory: all functions take NULL. */
cli_progress *cli_progress_start(bool quiet);
/* Names the present work, "reading"; static text. */
void cli_progress_phase(cli_progress *p, const char *phase);
/* For dyd_engine_options.progress; user is the cli_progress. */
void cli_progress_stage(void *user, const dyd_progress *stage);
/* Wipes the bar off the terminal and frees p. */
void cli_progress_stop(cli_progress *p);

/* ---- the table of commands and options: the one source of parsing, help, manual page and completion ---- */

/* A command, as the number of its bit in sets of commands. */
typedef enum cli_command_number {
  CLI_DELAUNAY,
  CLI_VORONOI,
  CLI_CONVERGE,
  CLI_CHECK,
  CLI_VERIFY,
  CLI_DISC,
  CLI_BISECTOR,
  CLI_NEAREST,
  CLI_TOLERANCE,
  CLI_PLAN,
  CLI_COMMANDS
} cli_command_number;

/* The kind of an option's value: how it is parsed, and which completions it has. */
typedef enum cli_kind {
  CLI_FLAG,    /* no value; a bool is set */
  CLI_TEXT,    /* any text */
  CLI_FILE,    /* the name of a file that is written */
  CLI_SOURCE,  /* the name of a file that is read */
  CLI_INTEGER, /* least..most, into an integer of `width` bytes */
  CLI_BYTES,   /* the same, with K, M, G or T behind it: times 1024, ... */
  CLI_SECONDS, /* a double above 0 */
  CLI_DEGREES, /* the same, up to 90 */
  CLI_LENGTH,  /* of paper, double in points: 240, 85mm, 12cm, 3.25in */
  CLI_GOAL,    /* decided, area:M, hausdorff:M */
  CLI_CHOICE,  /* one of words, as its number, into a bool or an enum */
  CLI_FORMAT,  /* a format of the command */
  CLI_LAYER,   /* a layer of the command's output */
  CLI_CRS,     /* EPSG:N */
  CLI_WINDOW,  /* XLO,XHI,YLO,YHI */
  CLI_HELP     /* nothing, or =KIND */
} cli_kind;
static inline bool cli_kind_is_file(cli_kind kind) {
  return kind == CLI_FILE || kind == CLI_SOURCE;
}

typedef enum cli_group { CLI_INPUT, CLI_REFINEMENT, CLI_OUTPUT, CLI_EXPERIMENTS, CLI_OTHER, CLI_GROUPS } cli_group;

typedef struct cli_option {
  const char *name;
  char letter;          /* 0: none */
  const char *argument; /* placeholder of the value; NULL: takes none */
  cli_kind kind;
  unsigned commands; /* the set of commands that take it */
  cli_group group;
  const char *help; /* one line, or lines; no full stop. Of formats: NULL, the list is made */
  size_t offset;    /* of the value in cli_options */
  size_t width;     /* and its size */
  long long least, most;
  const char *words; /* that completion offers, with a blank between two; NULL: none */
  size_t given;      /* offset of a bool that is set, 0: none */
  bool silent;       /* the result does not depend on it */
} cli_option;

typedef struct cli_command {
  const char *name;
  const char *operands; /* "FILE", "FILE X Y", "CERT" */
  const char *line;     /* one line, without a full stop */
  const char *about;    /* a paragraph or more for its help and the manual page, lines of at most 79 characters */
  dyd_content content;  /* of its result; the first format that holds it is the default */
  const cli_work *work;
} cli_command;

extern const cli_command cli_commands[CLI_COMMANDS];
extern const cli_option cli_option_table[];
extern const size_t cli_option_count;
extern const char *const cli_group_names[CLI_GROUPS];

/* The set of all commands. */
#define CLI_ALL ((1u << CLI_COMMANDS) - 1)
/* Returns true if the option exists for one of these commands. */
bool cli_option_exists(const cli_option *option, unsigned commands);
/* NULL when there is none of that name. */
const cli_command *cli_command_find(const char *name);
/* The names of the output layers of these commands, separated. */
void cli_layers_print(FILE *out, unsigned commands, const char *separator);
/* The set with this command alone. */
unsigned cli_command_bit(const cli_command *c);
/* The names of a set of commands, separated. */
void cli_commands_print(FILE *out, unsigned commands, const char *separator);
/* The names of the formats that some of these commands write, separated; the first is marked when `mark` says so ("csv
 * (default), json"). */
void cli_formats_print(FILE *out, unsigned commands, const char *separator, bool mark);

/* help.c: command NULL: help on everything. */
void cli_help(FILE *out, const cli_command *command);
void cli_help_man(FILE *out);
void cli_help_bash(FILE *out);
void cli_help_zsh(FILE *out);

#endif
