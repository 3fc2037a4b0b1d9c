/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of commands and options: the one source of parsing, help, manual page and completion. */
#ifndef DYD_CLI_TABLE_H
#define DYD_CLI_TABLE_H

#include "cli.h"

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

/* What the value of an option is: how it is read, and what completion offers for it. */
typedef enum cli_kind {
  CLI_FLAG,      /* no value; a bool is set */
  CLI_TEXT,      /* any text */
  CLI_FILE,      /* the name of a file that is written */
  CLI_SOURCE,    /* the name of a file that is read */
  CLI_INTEGER,   /* least..most, into an integer of `width` bytes */
  CLI_SECONDS,   /* a double above 0 */
  CLI_DEGREES,   /* the same, up to 90 */
  CLI_GOAL,      /* decided, area:M, hausdorff:M */
  CLI_SCHEDULE,  /* adaptive or uniform */
  CLI_SUBJECT,   /* delaunay or voronoi; a bool is set for the latter */
  CLI_METRIC,    /* euclid or box */
  CLI_TIES,      /* prove or off, into a bool: off */
  CLI_LIST_TIES, /* pairs, groups or none */
  CLI_FORMAT,    /* a format of the command */
  CLI_LAYER,     /* a layer of what the command writes */
  CLI_CRS,       /* EPSG:N */
  CLI_WINDOW,    /* XLO,XHI,YLO,YHI */
  CLI_HELP       /* nothing, or =KIND */
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
  size_t given; /* offset of a bool that is set, 0: none */
} cli_option;

typedef struct cli_command {
  const char *name;
  const char *operands; /* "FILE", "FILE X Y", "CERT" */
  const char *line;     /* what it does, in a line without a full stop */
  const char *about;    /* a paragraph or more for its help and the manual page, lines of at most 79 characters */
  dyd_content content;  /* what it writes; the first format that holds it is the default */
  int (*run)(const cli_options *o);
} cli_command;

extern const cli_command cli_commands[CLI_COMMANDS];
extern const cli_option cli_option_table[];
extern const size_t cli_option_count;
extern const char *const cli_group_names[CLI_GROUPS];

/* Texts of help and manual page: lines, each a paragraph "TERM\tMEANING". */
typedef struct cli_term {
  const char *term, *meaning;
} cli_term;
extern const cli_term cli_exit_statuses[], cli_coordinate_forms[], cli_results[], cli_examples[];
extern const char cli_summary[], cli_file_text[], cli_oracle_text[];
/* Day of the last change of these texts, as the manual page shows it. */
#define CLI_MANUAL_DATE "November 21, 2026"

/* The set of all commands. */
#define CLI_ALL ((1u << CLI_COMMANDS) - 1)
/* Does the option exist for one of these commands? */
bool cli_option_exists(const cli_option *option, unsigned commands);
/* NULL when there is none of that name. */
const cli_command *cli_command_find(const char *name);
/* The names of the layers of what these commands write, separated. */
void cli_layers_print(FILE *out, unsigned commands, const char *separator);
/* The set with this command alone. */
unsigned cli_command_bit(const cli_command *c);
/* The names of a set of commands, separated. */
void cli_commands_print(FILE *out, unsigned commands, const char *separator);
/* The names of the formats that some of these commands write, separated; the first is marked when `mark` says so ("csv
 * (default), json"). */
void cli_formats_print(FILE *out, unsigned commands, const char *separator, bool mark);

/* values.c: reads the value of an option into *o; 0, or an exit status after a message. */
int cli_value_read(cli_options *o, const cli_option *option, const char *text);

/* suggest.c: the candidate (0 and on, up to a NULL) most like `name`, NULL when none is like it. A name that begins as
 * `name` does, or a few typing errors away. */
const char *cli_suggest(const char *name, const char *(*candidate)(size_t k));

/* help.c, help_man.c, help_complete.c: command NULL: help on everything. */
void cli_help(FILE *out, const cli_command *command);
void cli_help_man(FILE *out);
void cli_help_bash(FILE *out);
void cli_help_zsh(FILE *out);

#endif
