/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Completion scripts for bash and zsh. */
#include "table.h"

static void option_names(FILE *out, unsigned commands) {
  for (size_t k = 0; k < cli_option_count; k++) {
    const cli_option *o = &cli_option_table[k];
    if (!cli_option_exists(o, commands)) continue;
    fprintf(out, " --%s", o->name);
    if (o->letter) fprintf(out, " -%c", o->letter);
  }
}

/* ---- bash ---- */

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
  if (o->kind == CLI_FLAG || cli_kind_is_file(o->kind)) return; /* files are what bash offers by itself */
  bash_pattern(out, o);
  if (o->kind == CLI_FORMAT || o->kind == CLI_LAYER) {
    fputs("case $command in\n", out);
    bash_words(out, "      ", o->kind == CLI_FORMAT ? bash_formats : bash_layers);
    fputs("      esac ;;\n", out);
  } else if (o->kind == CLI_SCHEDULE) {
    fputs("words='adaptive uniform' ;;\n", out);
  } else if (o->kind == CLI_SUBJECT) {
    fputs("words='delaunay voronoi' ;;\n", out);
  } else if (o->kind == CLI_METRIC) {
    fputs("words='euclid box' ;;\n", out);
  } else if (o->kind == CLI_TIES) {
    fputs("words='prove off' ;;\n", out);
  } else if (o->kind == CLI_LIST_TIES) {
    fputs("words='pairs groups none' ;;\n", out);
  } else if (o->kind == CLI_GOAL) {
    fputs("words='decided area: hausdorff:' ;;\n", out);
  } else if (o->kind == CLI_CRS) {
    fputs("words='EPSG:' ;;\n", out);
  } else if (o->kind == CLI_HELP) {
    fputs("[[ $equals ]] && words='man bash zsh' ;;\n", out);
  } else {
    fputs("words=' ' ;;\n", out);
  }
}

void cli_help_bash(FILE *out) {
  fputs("# SPDX-License-Identifier: LGPL-3.0-or-later\n# Completion of dyadel for bash.\n"
        "_dyadel() {\n"
        "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command='' words='' equals='' k\n"
        "  COMPREPLY=()\n"
        "  # bash takes --format=js for three words\n"
        "  if [[ $cur == = ]]; then cur='' equals=1\n"
        "  elif [[ $prev == = ]]; then prev=${COMP_WORDS[COMP_CWORD-2]} equals=1; fi\n"
        "  for ((k = 1; k < COMP_CWORD; k++)); do\n"
        "    case ${COMP_WORDS[k]} in\n"
        "    ",
        out);
  cli_commands_print(out, CLI_ALL, "|");
  fputs(") command=${COMP_WORDS[k]}; break ;;\n    esac\n  done\n  case $prev in\n", out);
  for (size_t k = 0; k < cli_option_count; k++) bash_value(out, &cli_option_table[k]);
  for (size_t k = 0; k < cli_option_count; k++) {
    const cli_option *o = &cli_option_table[k];
    if (!cli_kind_is_file(o->kind)) continue;
    bash_pattern(out, o);
    fputs("return ;;\n", out);
  }
  fputs("  esac\n  if [[ -z $words && $cur == -* ]]; then\n    case $command in\n", out);
  bash_words(out, "    ", option_names);
  fputs("    esac\n  elif [[ -z $words && -z $command ]]; then words='", out);
  cli_commands_print(out, CLI_ALL, " ");
  fputs("'; fi\n"
        "  [[ $words ]] || return # names of files\n"
        "  compopt +o default 2>/dev/null\n"
        "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$cur\")\n"
        "  [[ ${COMPREPLY[0]-} == *: ]] && compopt -o nospace 2>/dev/null\n"
        "  return 0\n"
        "}\n"
        "complete -o default -F _dyadel dyadel\n",
        out);
}

/* ---- zsh ---- */

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
  if (o->kind == CLI_SCHEDULE) fputs("(adaptive uniform)", out);
  if (o->kind == CLI_SUBJECT) fputs("(delaunay voronoi)", out);
  if (o->kind == CLI_METRIC) fputs("(euclid box)", out);
  if (o->kind == CLI_TIES) fputs("(prove off)", out);
  if (o->kind == CLI_LIST_TIES) fputs("(pairs groups none)", out);
  if (o->kind == CLI_GOAL) fputs("(decided area\\: hausdorff\\:)", out);
  if (o->kind == CLI_CRS) fputs("(EPSG\\:)", out);
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

void cli_help_zsh(FILE *out) {
  fputs("#compdef dyadel\n# SPDX-License-Identifier: LGPL-3.0-or-later\n# Completion of dyadel for zsh.\n"
        "_dyadel() {\n"
        "  local -a commands options\n"
        "  local context state state_descr line\n"
        "  typeset -A opt_args\n"
        "  commands=(\n",
        out);
  for (size_t c = 0; c < CLI_COMMANDS; c++) {
    fprintf(out, "    '%s:", cli_commands[c].name);
    zsh_text(out, cli_commands[c].line);
    fputs("'\n", out);
  }
  fputs("  )\n"
        "  _arguments -C '(-h --help)'{-h,--help}'[help]' '--version[the version]' '1:command:->command' "
        "'*::argument:->arguments' && return\n"
        "  case $state in\n"
        "  command) _describe command commands ;;\n"
        "  arguments)\n"
        "    case $line[1] in\n",
        out);
  for (size_t c = 0; c < CLI_COMMANDS; c++) zsh_command(out, &cli_commands[c]);
  fputs("    esac\n"
        "    _arguments $options ;;\n"
        "  esac\n"
        "}\n"
        "_dyadel \"$@\"\n",
        out);
}
