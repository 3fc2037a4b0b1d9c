/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* --help: of everything, or of one command. */
#include "table.h"
#include <string.h>

enum { COLUMN = 24 };

/* How many commands are in the set. */
static unsigned count_commands(unsigned commands) {
  unsigned n = 0;
  for (; commands; commands &= commands - 1) n++;
  return n;
}

/* " (converge, check)" behind an option that few of the commands take. */
static void help_takers(FILE *out, unsigned commands, unsigned among) {
  unsigned takers = count_commands(commands & among);
  if (takers == count_commands(among) || takers > 2) return;
  fputs(" (", out);
  cli_commands_print(out, commands & among, ", ");
  fputs(")", out);
}

/* The first part of the line: "  -o, --output FILE", then blanks up to the column, on a new line where it is long. */
static void help_names(FILE *out, const cli_option *o) {
  char names[80];
  char letter[6] = "";
  if (o->letter) snprintf(letter, sizeof letter, "-%c, ", o->letter);
  const char *between = o->kind == CLI_HELP ? "[=" : " ", *end = o->kind == CLI_HELP ? "]" : "";
  int length = snprintf(names, sizeof names, "  %s--%s%s%s%s", letter, o->name, o->argument ? between : "",
                        o->argument ? o->argument : "", end);
  fputs(names, out);
  if (length > COLUMN - 2) {
    fputs("\n", out);
    length = 0;
  }
  fprintf(out, "%*s", COLUMN - length, "");
}

static void help_option(FILE *out, const cli_option *o, unsigned among) {
  help_names(out, o);
  if (o->kind == CLI_FORMAT)
    cli_formats_print(out, o->commands & among, ", ", true);
  else
    for (const char *c = o->help; *c; c++) {
      fputc(*c, out);
      if (*c == '\n') fprintf(out, "%*s", COLUMN, "");
    }
  help_takers(out, o->commands, among);
  fputs("\n", out);
}

static void help_options(FILE *out, unsigned among) {
  for (int g = 0; g < CLI_GROUPS; g++) {
    bool any = false;
    for (size_t k = 0; k < cli_option_count; k++) {
      const cli_option *o = &cli_option_table[k];
      if (o->group != (cli_group)g || !cli_option_exists(o, among)) continue;
      if (!any) fprintf(out, "%s\n", cli_group_names[g]);
      any = true;
      help_option(out, o, among);
    }
  }
}

void cli_help(FILE *out, const cli_command *command) {
  if (command) {
    fprintf(out, "Usage: dyadel %s [OPTION...] %s\n%s\n\n", command->name, command->operands, command->about);
  } else {
    fprintf(out, "Usage: dyadel COMMAND [OPTION...] FILE\n%s\n\nCommands\n", cli_summary);
    for (size_t c = 0; c < CLI_COMMANDS; c++) {
      char usage[64];
      snprintf(usage, sizeof usage, "%s %s", cli_commands[c].name, cli_commands[c].operands);
      fprintf(out, "  %-*s%s\n", COLUMN - 2, usage, cli_commands[c].line);
    }
    fputs("\n", out);
  }
  if (!command || strncmp(command->operands, "FILE", 4) == 0) fprintf(out, "%s\n\n", cli_file_text);
  help_options(out, command ? cli_command_bit(command) : CLI_ALL);
  fputs("\nExit status: 0 decided or certified, 1 bad input or failure, 2 bad usage,\n"
        "3 fixpoint (ties or fixed rectangles), 4 budget spent, 5 cancelled.\n"
        "Results are written for 0, 3, 4 and 5.\n",
        out);
}
