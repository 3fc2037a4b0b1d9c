/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The manual page, in the mdoc macros. */
#include "table.h"
#include <string.h>

/* Text between macros. A line must not begin with a control character, a backslash is written \e, and a hyphen that
 * is to be copied from the page as it is typed is written \-. */
static void man_letter(FILE *out, char c) {
  if (c == '\\')
    fputs("\\e", out);
  else if (c == '-')
    fputs("\\-", out);
  else
    fputc(c, out);
}

/* Text in lines of moderate length; a sentence begins on a new line. */
static void man_text(FILE *out, const char *t) {
  int column = 0;
  for (; *t; t++) {
    bool blank = *t == ' ' || *t == '\n';
    bool sentence = blank && column && t[-1] == '.' && t[1] >= 'A' && t[1] <= 'Z';
    if (sentence || *t == '\n' || (blank && column + (int)strcspn(t + 1, " \n") > 70)) {
      fputc('\n', out);
      column = 0;
      continue;
    }
    if (column == 0 && (*t == '.' || *t == '\'')) fputs("\\&", out);
    man_letter(out, *t);
    column++;
  }
  fputs("\n", out);
}

/* An argument of a macro. */
static void man_quoted(FILE *out, const char *t) {
  fputc('"', out);
  for (; *t; t++) {
    if (*t == '"')
      fputs("\\(dq", out);
    else
      man_letter(out, *t);
  }
  fputc('"', out);
}

static void man_terms(FILE *out, const cli_term *t, const char *macro) {
  fputs(".Bl -tag -width Ds\n", out);
  for (; t->term; t++) {
    fprintf(out, ".It %s ", macro);
    man_quoted(out, t->term);
    fputs("\n", out);
    man_text(out, t->meaning);
  }
  fputs(".El\n", out);
}

static void man_takers(FILE *out, const cli_option *o) {
  if (o->commands == CLI_ALL) return;
  fputs("(", out);
  cli_commands_print(out, o->commands, ", ");
  fputs(")\n", out);
}

static void man_option(FILE *out, const cli_option *o) {
  fputs(".It ", out);
  if (o->letter) fprintf(out, "Fl %c , ", o->letter);
  fprintf(out, "Fl \\-%s", o->name);
  if (o->kind == CLI_HELP)
    fprintf(out, " Ns Op = Ns Ar %s", o->argument);
  else if (o->argument)
    fprintf(out, " Ar %s", o->argument);
  fputs("\n", out);
  if (o->kind == CLI_FORMAT) {
    cli_formats_print(out, o->commands, ", ", true);
    fputs("\n", out);
  } else {
    man_text(out, o->help);
  }
  man_takers(out, o);
}

static void man_options(FILE *out) {
  for (int g = 0; g < CLI_GROUPS; g++) {
    bool any = false;
    for (size_t k = 0; k < cli_option_count; k++) {
      const cli_option *o = &cli_option_table[k];
      if (o->group != (cli_group)g) continue;
      if (!any) fprintf(out, ".Ss %s\n.Bl -tag -width Ds\n", cli_group_names[g]);
      any = true;
      man_option(out, o);
    }
    if (any) fputs(".El\n", out);
  }
}

static void man_commands(FILE *out) {
  fputs(".Bl -tag -width Ds\n", out);
  for (size_t c = 0; c < CLI_COMMANDS; c++) {
    fprintf(out, ".It Cm %s Ar %s\n", cli_commands[c].name, cli_commands[c].operands);
    man_text(out, cli_commands[c].about);
  }
  fputs(".El\n", out);
}

static void man_formats(FILE *out) {
  fputs(".Bl -tag -width Ds\n", out);
  for (unsigned f = 0; dyd_format_name((dyd_format)f); f++) {
    fprintf(out, ".It Cm %s\n", dyd_format_name((dyd_format)f));
    man_text(out, dyd_format_about((dyd_format)f));
  }
  fputs(".El\n", out);
}

void cli_help_man(FILE *out) {
  fputs(".\\\" SPDX-License-Identifier: LGPL-3.0-or-later\n.Dd " CLI_MANUAL_DATE "\n.Dt DYADEL 1\n.Os\n"
        ".Sh NAME\n.Nm dyadel\n.Nd Delaunay and Voronoi of computable points\n.Sh SYNOPSIS\n",
        out);
  for (size_t c = 0; c < CLI_COMMANDS; c++)
    fprintf(out, ".Nm\n.Cm %s\n.Op Ar option ...\n.Ar %s\n", cli_commands[c].name, cli_commands[c].operands);
  fputs(".Sh DESCRIPTION\n", out);
  man_text(out, cli_summary);
  fputs(".Pp\nThe commands are:\n", out);
  man_commands(out);
  fputs(".Ss The points file\n", out);
  man_text(out, cli_file_text);
  fputs("A coordinate is one of\n", out);
  man_terms(out, cli_coordinate_forms, "Li");
  fputs(".Sh OPTIONS\n", out);
  man_text(out, "Commands in parentheses are those that take the option; where none is named, all do.");
  man_options(out);
  fputs(".Sh FORMATS\n", out);
  man_text(out,
           "No format holds a rounded number without saying to which side, or by how much at most, it is rounded.");
  man_formats(out);
  fputs(".Ss What is in them\n", out);
  man_terms(out, cli_results, "Li");
  fputs(".Sh PROGRAMS THAT SERVE POINTS\n", out);
  man_text(out, cli_oracle_text);
  fputs(".Sh EXIT STATUS\n", out);
  man_terms(out, cli_exit_statuses, "Li");
  fputs(".Pp\n", out);
  man_text(out, "Results are written for 0, 3, 4 and 5; they are true and complete for the rectangles reached.");
  fputs(".Sh EXAMPLES\n", out);
  man_terms(out, cli_examples, "Li");
}
