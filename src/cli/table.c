/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of commands and options.
 *
 * A new command: its text in manual/manual.txt, its number, and its cli_work, declared in cli.h.
 * A new option: its entry in manual/options.txt and its field in cli_options. The rest follows: parsing, messages,
 * help, manual page, completion. */
#include "cli.h"
#include <string.h>

#define BIT(number) (1u << (number))
#define AT(field) .offset = offsetof(cli_options, field), .width = sizeof(((cli_options *)0)->field)
#define RANGE(low, high) .least = (low), .most = (high)
#define WORDS(text) .words = (text)
#define GIVEN(field) .given = offsetof(cli_options, field)
#define SILENT .silent = true

enum {
  ALL = CLI_ALL,
  READ = CLI_ALL & ~BIT(CLI_VERIFY),                                               /* reads points */
  RUN = BIT(CLI_DELAUNAY) | BIT(CLI_VORONOI) | BIT(CLI_CONVERGE) | BIT(CLI_CHECK), /* runs the engine to a goal */
  TEXT = READ | BIT(CLI_VERIFY),                                                   /* from a file */
  PIECES = BIT(CLI_DISC) | BIT(CLI_BISECTOR),
  REFINE = RUN | PIECES | BIT(CLI_NEAREST) | BIT(CLI_TOLERANCE), /* asks points to narrow */
  DRAW = (RUN & ~BIT(CLI_CHECK)) | PIECES | BIT(CLI_NEAREST) | BIT(CLI_TOLERANCE) | BIT(CLI_PLAN), /* pictures */
  GLOBE = BIT(CLI_DELAUNAY) | BIT(CLI_VORONOI) | BIT(CLI_CONVERGE) | BIT(CLI_NEAREST) | BIT(CLI_PLAN) |
          BIT(CLI_VERIFY) /* takes --sphere */
};

const cli_command cli_commands[CLI_COMMANDS] = {
#include "commands.inc"
};

const char *const cli_group_names[CLI_GROUPS] = {[CLI_INPUT] = "Input",
                                                 [CLI_REFINEMENT] = "Refinement",
                                                 [CLI_OUTPUT] = "Output",
                                                 [CLI_EXPERIMENTS] = "Experiments",
                                                 [CLI_OTHER] = "Other"};

const cli_option cli_option_table[] = {
#include "options.inc"
};
const size_t cli_option_count = sizeof cli_option_table / sizeof *cli_option_table;

/* Returns true if one of the commands writes the format. */
static bool is_format_of(dyd_format format, unsigned commands) {
  for (unsigned c = 0; c < CLI_COMMANDS; c++)
    if (commands & BIT(c) && dyd_format_holds(format, cli_commands[c].content, false)) return true;
  return false;
}

bool cli_option_exists(const cli_option *option, unsigned commands) {
  unsigned f = 0, takers = option->commands & commands;
  if (option->kind != CLI_FORMAT) return takers != 0;
  while (dyd_format_get((dyd_format)f) && !is_format_of((dyd_format)f, takers)) f++;
  return dyd_format_get((dyd_format)f);
}

const cli_command *cli_command_find(const char *name) {
  for (unsigned c = 0; c < CLI_COMMANDS; c++)
    if (strcmp(cli_commands[c].name, name) == 0) return &cli_commands[c];
  return NULL;
}

unsigned cli_command_bit(const cli_command *c) {
  return BIT((unsigned)(c - cli_commands));
}

void cli_commands_print(FILE *out, unsigned commands, const char *separator) {
  const char *before = "";
  for (unsigned c = 0; c < CLI_COMMANDS; c++) {
    if (!(commands & BIT(c))) continue;
    fprintf(out, "%s%s", before, cli_commands[c].name);
    before = separator;
  }
}

void cli_layers_print(FILE *out, unsigned commands, const char *separator) {
  const char *before = "";
  for (unsigned c = 0; c < CLI_COMMANDS; c++)
    for (size_t k = 0; commands & BIT(c) && dyd_layer_name(NULL, NULL, cli_commands[c].content, k); k++) {
      fprintf(out, "%s%s", before, dyd_layer_name(NULL, NULL, cli_commands[c].content, k));
      before = separator;
    }
}

void cli_formats_print(FILE *out, unsigned commands, const char *separator, bool mark) {
  bool first = true;
  for (unsigned f = 0; dyd_format_get((dyd_format)f); f++) {
    if (!is_format_of((dyd_format)f, commands)) continue;
    fprintf(out, "%s%s%s", first ? "" : separator, dyd_format_get((dyd_format)f)->name,
            first && mark ? " (default)" : "");
    first = false;
  }
}
