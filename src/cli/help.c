/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* --help, the manual page, completion scripts. */
#include "cli.h"

#include <string.h>

/* Day of the last change of the texts, as the manual page shows it. */
#define MANUAL_DATE "November 21, 2026"

/* A paragraph "TERM\tMEANING"; lists end with NULL. */
typedef struct help_term {
  const char *term, *meaning;
} help_term;

#include "manual.inc" /* made of manual/manual.txt; the manual page escapes what troff would take for its own */

/* ---- --help: of everything, or of one command ---- */

enum { COLUMN = 24, WIDTH = 80 };

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

/* A clause of a help text: up to a semicolon that is not in parentheses. */
static size_t clause_length(const char *text) {
  size_t k = 0;
  for (int depth = 0; text[k] && (depth || text[k] != ';'); k++) depth += (text[k] == '(') - (text[k] == ')');
  return k;
}

/* The commands that "delaunay, voronoi: " at its head names, and the length of that; 0 where it names none. */
static unsigned clause_commands(size_t *head, const char *text) {
  unsigned named = 0;
  for (size_t k = 0;;) {
    size_t length = strspn(text + k, "abcdefghijklmnopqrstuvwxyz");
    size_t c = 0;
    while (c < CLI_COMMANDS &&
           (strlen(cli_commands[c].name) != length || strncmp(cli_commands[c].name, text + k, length)))
      c++;
    if (c == CLI_COMMANDS) return 0;
    named |= 1U << c;
    k += length;
    *head = k + 2;
    if (text[k] == ':') return named;
    if (strncmp(text + k, ", ", 2) != 0) return 0;
    k += 2;
  }
}

/* False where it is about an option that none of the commands takes. */
static bool clause_applies(const char *text, size_t length, unsigned among) {
  for (const char *at = strstr(text, "--"); at && at < text + length; at = strstr(at + 2, "--")) {
    size_t name = strspn(at + 2, "abcdefghijklmnopqrstuvwxyz-");
    for (size_t k = 0; k < cli_option_count; k++)
      if (strlen(cli_option_table[k].name) == name && strncmp(cli_option_table[k].name, at + 2, name) == 0 &&
          !(cli_option_table[k].commands & among))
        return false;
  }
  return true;
}

/* Words in lines of the width that is left; column: where the line is. */
static void help_words(FILE *out, const char *text, size_t length, int *column) {
  for (size_t k = 0; k < length;) {
    size_t word = strcspn(text + k, " \n");
    if (word > length - k) word = length - k;
    if (*column + (int)word + 1 > WIDTH) fprintf(out, "\n%*s", *column = COLUMN, "");
    if (*column > COLUMN) fputc(' ', out), ++*column;
    fwrite(text + k, 1, word, out);
    *column += (int)word;
    k += word + 1;
  }
}

/* What of the text is about these commands; of a single one without its name. */
static void help_clauses(FILE *out, const char *text, unsigned among) {
  int column = COLUMN;
  bool any = false;
  while (*text) {
    size_t length = clause_length(text), head = 0;
    unsigned named = clause_commands(&head, text);
    if ((!named || named & among) && clause_applies(text, length, among)) {
      size_t skipped = named && count_commands(among) == 1 ? head : 0;
      if (any) fputc(';', out), column++;
      if (any && named) fprintf(out, "\n%*s", column = COLUMN, "");
      help_words(out, text + skipped, length - skipped, &column);
      any = true;
    }
    text += length;
    while (*text == ';' || *text == ' ' || *text == '\n') text++;
  }
}

static void help_option(FILE *out, const cli_option *o, unsigned among) {
  help_names(out, o);
  if (o->kind == CLI_FORMAT)
    cli_formats_print(out, o->commands & among, ", ", true);
  else
    help_clauses(out, o->help, among);
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

/* The examples that run the command. */
static void help_samples(FILE *out, const cli_command *command) {
  char start[32];
  snprintf(start, sizeof start, "dyadel %s ", command->name);
  fputs("Examples\n", out);
  for (const help_term *t = help_examples; t->term; t++) {
    if (!strstr(t->term, start)) continue;
    int column = COLUMN;
    fprintf(out, "  %s\n%*s", t->term, COLUMN, "");
    help_words(out, t->meaning, strlen(t->meaning), &column);
    fputs("\n", out);
  }
}

void cli_help(FILE *out, const cli_command *command) {
  if (command) {
    fprintf(out, "Usage: dyadel %s [OPTION...] %s\n%s\n\n", command->name, command->operands, command->about);
  } else {
    fprintf(out, "Usage: dyadel COMMAND [OPTION...] FILE\n%s\n\nCommands\n", help_summary);
    for (size_t c = 0; c < CLI_COMMANDS; c++) {
      char usage[64];
      snprintf(usage, sizeof usage, "%s %s", cli_commands[c].name, cli_commands[c].operands);
      fprintf(out, "  %-*s%s\n", COLUMN - 2, usage, cli_commands[c].line);
    }
    fputs("\n", out);
  }
  if (!command || strncmp(command->operands, "FILE", 4) == 0) fprintf(out, "%s\n\n", help_file);
  help_options(out, command ? cli_command_bit(command) : CLI_ALL);
  if (command) help_samples(out, command);
  fputs("\nExit status: 0 decided or certified, 1 bad input or failure, 2 bad usage,\n"
        "3 fixpoint (ties or fixed rectangles), 4 budget spent, 5 cancelled.\n"
        "Results are written for 0, 3, 4 and 5.\n",
        out);
}

/* ---- the manual page, in the mdoc macros ---- */

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

static void man_terms(FILE *out, const help_term *t, const char *macro) {
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
  for (unsigned f = 0; dyd_format_get((dyd_format)f); f++) {
    fprintf(out, ".It Cm %s\n", dyd_format_get((dyd_format)f)->name);
    man_text(out, dyd_format_get((dyd_format)f)->about);
  }
  fputs(".El\n", out);
}

void cli_help_man(FILE *out) {
  fputs(".\\\" SPDX-License-Identifier: LGPL-3.0-or-later\n.Dd " MANUAL_DATE "\n.Dt DYADEL 1\n.Os\n"
        ".Sh NAME\n.Nm dyadel\n.Nd Delaunay and Voronoi of computable points\n.Sh SYNOPSIS\n",
        out);
  for (size_t c = 0; c < CLI_COMMANDS; c++)
    fprintf(out, ".Nm\n.Cm %s\n.Op Ar option ...\n.Ar %s\n", cli_commands[c].name, cli_commands[c].operands);
  fputs(".Sh DESCRIPTION\n", out);
  man_text(out, help_summary);
  fputs(".Pp\nThe commands are:\n", out);
  man_commands(out);
  fputs(".Ss The points file\n", out);
  man_text(out, help_file);
  fputs("A coordinate is one of\n", out);
  man_terms(out, help_coordinate_forms, "Li");
  fputs(".Sh OPTIONS\n", out);
  man_text(out, "Parentheses name the commands that take the option; without them all do.");
  man_options(out);
  fputs(".Sh FORMATS\n", out);
  man_text(out,
           "No format holds a rounded number without saying to which side, or by how much at most, it is rounded.");
  man_formats(out);
  fputs(".Ss Contents\n", out);
  man_terms(out, help_results, "Li");
  fputs(".Sh PROGRAMS THAT SERVE POINTS\n", out);
  man_text(out, help_oracle);
  fputs(".Sh EXIT STATUS\n", out);
  man_terms(out, help_exit_statuses, "Li");
  fputs(".Pp\n", out);
  man_text(out, "Results are written for 0, 3, 4 and 5; they are true and complete for the rectangles reached.");
  fputs(".Sh EXAMPLES\n", out);
  man_terms(out, help_examples, "Li");
}

static void option_names(FILE *out, unsigned commands) {
  for (size_t k = 0; k < cli_option_count; k++) {
    const cli_option *o = &cli_option_table[k];
    if (!cli_option_exists(o, commands)) continue;
    fprintf(out, " --%s", o->name);
    if (o->letter) fprintf(out, " -%c", o->letter);
  }
}

/* Prints the replacement of {{NAME}} in a completion script. */
typedef void (*script_part)(FILE *out);

/* The script, with the parts in their order. */
static void print_script(FILE *out, const char *script, const script_part *part) {
  for (const char *at; (at = strstr(script, "{{")); script = strstr(at, "}}") + 2) {
    fwrite(script, 1, (size_t)(at - script), out);
    (*part++)(out);
  }
  fputs(script, out);
}

/* ---- completion for bash ---- */

/* The pattern of a case for the option: "--output|-o)". */
static void bash_pattern(FILE *out, const cli_option *o) {
  fprintf(out, "    --%s", o->name);
  if (o->letter) fprintf(out, "|-%c", o->letter);
  fputs(") ", out);
}

static void bash_formats(FILE *out, unsigned commands) {
  cli_formats_print(out, commands, " ", false);
}

static void bash_layers(FILE *out, unsigned commands) {
  cli_layers_print(out, commands, " ");
}

/* The patterns of a case on the command, with its words, and those of no command. */
static void bash_words(FILE *out, const char *indent, void (*words)(FILE *out, unsigned commands)) {
  for (size_t c = 0; c <= CLI_COMMANDS; c++) {
    bool any = c == CLI_COMMANDS;
    fprintf(out, "%s%s) words='", indent, any ? "*" : cli_commands[c].name);
    words(out, any ? CLI_ALL : cli_command_bit(&cli_commands[c]));
    fputs("' ;;\n", out);
  }
}

static void bash_value(FILE *out, const cli_option *o) {
  if (o->kind == CLI_FLAG || cli_kind_is_file(o->kind)) return; /* bash offers files without help */
  bash_pattern(out, o);
  if (o->kind == CLI_FORMAT || o->kind == CLI_LAYER) {
    fputs("case $command in\n", out);
    bash_words(out, "      ", o->kind == CLI_FORMAT ? bash_formats : bash_layers);
    fputs("      esac ;;\n", out);
  } else if (o->words) {
    fprintf(out, "words='%s' ;;\n", o->words);
  } else if (o->kind == CLI_HELP) {
    fputs("[[ $equals ]] && words='man bash zsh' ;;\n", out);
  } else {
    fputs("words=' ' ;;\n", out);
  }
}

static void bash_alternatives(FILE *out) {
  cli_commands_print(out, CLI_ALL, "|");
}

static void bash_values(FILE *out) {
  for (size_t k = 0; k < cli_option_count; k++) bash_value(out, &cli_option_table[k]);
  for (size_t k = 0; k < cli_option_count; k++) {
    if (!cli_kind_is_file(cli_option_table[k].kind)) continue;
    bash_pattern(out, &cli_option_table[k]);
    fputs("return ;;\n", out);
  }
}

static void bash_options(FILE *out) {
  bash_words(out, "    ", option_names);
}

static void bash_commands(FILE *out) {
  cli_commands_print(out, CLI_ALL, " ");
}

void cli_help_bash(FILE *out) {
  static const script_part parts[] = {bash_alternatives, bash_values, bash_options, bash_commands};
  print_script(out, help_bash, parts);
}

/* ---- completion for zsh ---- */

/* Text inside '...' and inside the brackets of a description. */
static void zsh_text(FILE *out, const char *t) {
  for (; *t; t++) {
    if (*t == '\'')
      fputs("'\\''", out);
    else if (*t == '[' || *t == ']' || *t == ':' || *t == '\\')
      fprintf(out, "\\%c", *t);
    else
      fputc(*t == '\n' ? ' ' : *t, out);
  }
}

static void zsh_option(FILE *out, const cli_option *o, const cli_command *c) {
  fputs("      ", out);
  if (o->letter)
    fprintf(out, "'(-%c --%s)'{-%c%s,--%s%s}'", o->letter, o->name, o->letter,
            o->argument && o->kind != CLI_HELP ? "+" : "", o->name, o->argument && o->kind != CLI_HELP ? "=" : "");
  else
    fprintf(out, "'--%s%s", o->name, o->argument ? "=" : "");
  fputs("[", out);
  zsh_text(out, o->help ? o->help : "format of the result");
  fputs("]", out);
  if (o->argument && o->kind != CLI_HELP) fprintf(out, ":%s:", o->argument);
  if (cli_kind_is_file(o->kind)) fputs("_files", out);
  if (o->words) {
    fputs("(", out);
    zsh_text(out, o->words);
    fputs(")", out);
  }
  if (o->kind == CLI_FORMAT || o->kind == CLI_LAYER) {
    fputs("(", out);
    if (o->kind == CLI_FORMAT)
      cli_formats_print(out, cli_command_bit(c), " ", false);
    else
      cli_layers_print(out, cli_command_bit(c), " ");
    fputs(")", out);
  }
  fputs("'\n", out);
}

static void zsh_command(FILE *out, const cli_command *c) {
  fprintf(out, "    %s) options=(\n", c->name);
  for (size_t k = 0; k < cli_option_count; k++)
    if (cli_option_exists(&cli_option_table[k], cli_command_bit(c))) zsh_option(out, &cli_option_table[k], c);
  fputs("      '1:file:_files'\n      '*:number:'\n      ) ;;\n", out);
}

static void zsh_commands(FILE *out) {
  for (size_t c = 0; c < CLI_COMMANDS; c++) {
    fprintf(out, "    '%s:", cli_commands[c].name);
    zsh_text(out, cli_commands[c].line);
    fputs("'\n", out);
  }
}

static void zsh_options(FILE *out) {
  for (size_t c = 0; c < CLI_COMMANDS; c++) zsh_command(out, &cli_commands[c]);
}

void cli_help_zsh(FILE *out) {
  static const script_part parts[] = {zsh_commands, zsh_options};
  print_script(out, help_zsh, parts);
}
