/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Arguments to cli_options, by the table: options may stand before or after the command and its operands.
 *
 * What begins with a minus sign and a digit or a point is an operand, not an option: coordinates may be negative. */
#include "table.h"
#include <ctype.h>
#include <getopt.h>
#include <string.h>

enum { MOST_OPTIONS = 96, MOST_OPERANDS = 5, FIRST_VALUE = 256 };

/* What was found before the command is known. Invariant: seen[k] when option k was given. */
typedef struct scan {
  struct option known[MOST_OPTIONS + 1];
  char letters[2 * MOST_OPTIONS + 3];
  bool seen[MOST_OPTIONS];
  const char *operand[MOST_OPERANDS];
  size_t operands;
} scan;

/* Tells getopt_long of all options; its value for option k is FIRST_VALUE + k. */
static void scan_prepare(scan *s) {
  size_t n = 0, m = 0;
  *s = (scan){0};
  s->letters[m++] = '+';
  s->letters[m++] = ':';
  for (size_t k = 0; k < cli_option_count && n < MOST_OPTIONS; k++) {
    const cli_option *o = &cli_option_table[k];
    int argument = o->kind == CLI_HELP ? optional_argument : o->argument ? required_argument : no_argument;
    s->known[n++] = (struct option){o->name, argument, NULL, FIRST_VALUE + (int)k};
    if (!o->letter) continue;
    s->letters[m++] = o->letter;
    if (argument == required_argument) s->letters[m++] = ':';
  }
}

static size_t option_number(int value) {
  if (value >= FIRST_VALUE) return (size_t)(value - FIRST_VALUE);
  for (size_t k = 0; k < cli_option_count; k++)
    if (cli_option_table[k].letter == value) return k;
  return 0;
}

static const char *option_name(size_t k) {
  return k < cli_option_count ? cli_option_table[k].name : NULL;
}

static int complain_unknown(const char *argument) {
  char name[64];
  snprintf(name, sizeof name, "%s", argument + strspn(argument, "-"));
  name[strcspn(name, "=")] = 0;
  const char *best = cli_suggest(name, option_name);
  if (best)
    cli_complain("there is no option %s; did you mean --%s?", argument, best);
  else
    cli_complain("there is no option %s; see dyadel --help", argument);
  return CLI_USAGE;
}

static int complain_option(int kind, const char *argument) {
  if (kind == ':')
    cli_complain("%s needs a value; see dyadel --help", argument);
  else if (optopt >= FIRST_VALUE)
    cli_complain("--%s takes no value; leave \"=\" and what follows away",
                 cli_option_table[option_number(optopt)].name);
  else if (optopt)
    cli_complain("there is no option -%c; see dyadel --help", optopt);
  else
    return complain_unknown(argument);
  return CLI_USAGE;
}

static bool is_operand(const char *a) {
  return a[0] != '-' || !a[1] || isdigit((unsigned char)a[1]) || a[1] == '.';
}

static int scan_operand(scan *s, const char *text) {
  if (s->operands < MOST_OPERANDS) {
    s->operand[s->operands++] = text;
    return 0;
  }
  cli_complain("\"%s\" is one argument too many; see dyadel --help", text);
  return CLI_USAGE;
}

static int scan_all(scan *s, cli_options *o, int argc, char **argv) {
  bool operands_only = false;
  opterr = 0;
  for (int status = 0; optind < argc;) {
    char *a = argv[optind];
    if (!operands_only && strcmp(a, "--") == 0) {
      operands_only = true;
      optind++;
    } else if (operands_only || is_operand(a)) {
      status = scan_operand(s, a);
      optind++;
    } else {
      int value = getopt_long(argc, argv, s->letters, s->known, NULL);
      if (value == '?' || value == ':') return complain_option(value, a);
      size_t k = option_number(value);
      s->seen[k] = true;
      status = cli_value_read(o, &cli_option_table[k], optarg);
    }
    if (status) return status;
  }
  return 0;
}

/* ---- does it fit the command? ---- */

static const char *command_name(size_t k) {
  return k < CLI_COMMANDS ? cli_commands[k].name : NULL;
}

static int unknown_command(const char *name) {
  const char *best = cli_suggest(name, command_name);
  if (best)
    cli_complain("there is no command \"%s\"; did you mean %s?", name, best);
  else
    cli_complain("there is no command \"%s\"; the commands are:", name);
  for (size_t c = 0; !best && c < CLI_COMMANDS; c++)
    fprintf(stderr, "  dyadel %s %s\n", cli_commands[c].name, cli_commands[c].operands);
  return CLI_USAGE;
}

/* A trace of converge has the points in it; the schedule that check replays has not. */
static bool trace_has_points(const cli_options *o, const cli_command *c) {
  return o->replay && c == &cli_commands[CLI_CONVERGE];
}

/* What contradicts itself. */
static int sphere_fits(const cli_options *o) {
  if (!o->sphere || !o->plane) return 0;
  cli_complain("--sphere and --plane contradict each other; leave one of them away");
  return CLI_USAGE;
}

static int options_fit(const cli_options *o, const bool *seen, const cli_command *c) {
  for (size_t k = 0; k < cli_option_count; k++) {
    if (!seen[k] || cli_option_exists(&cli_option_table[k], cli_command_bit(c))) continue;
    cli_complain("%s does not take --%s; see dyadel %s --help", c->name, cli_option_table[k].name, c->name);
    return CLI_USAGE;
  }
  for (size_t k = 0; trace_has_points(o, c) && k < cli_option_count; k++) {
    cli_group group = cli_option_table[k].group;
    const bool timeout = cli_option_table[k].offset == offsetof(cli_options, engine.seconds);
    if (!seen[k] || timeout || (group != CLI_INPUT && group != CLI_REFINEMENT)) continue;
    cli_complain("--replay takes points and options from the trace; leave --%s away", cli_option_table[k].name);
    return CLI_USAGE;
  }
  for (size_t k = 0; c == &cli_commands[CLI_VERIFY] && !o->points && k < cli_option_count; k++) {
    if (!seen[k] || cli_option_table[k].group != CLI_INPUT) continue;
    cli_complain("--%s says how points are read; give their file with --points", cli_option_table[k].name);
    return CLI_USAGE;
  }
  return 0;
}

/* The layer named, as one of what the command writes. */
static int layer_fits(cli_options *o, const cli_command *c) {
  bool diagram = c == &cli_commands[CLI_VORONOI];
  dyd_content of = !o->sphere ? c->content : diagram ? DYD_CONTENT_SPHERE_VORONOI : DYD_CONTENT_SPHERE;
  o->content = o->queries ? DYD_CONTENT_PLACES : of;
  if (!o->layer || dyd_layer_from_name(&o->content, of, o->layer)) return 0;
  fprintf(stderr, "dyadel: %s%s has no layer \"%s\"; give ", c->name, o->sphere ? " --sphere" : "", o->layer);
  for (size_t k = 0; dyd_layer_name(of, k); k++) fprintf(stderr, "%s%s", k ? ", " : "", dyd_layer_name(of, k));
  fputs("\n", stderr);
  return CLI_USAGE;
}

/* The format, which has to hold what is written; the first that does where none is given. */
static int format_fits(cli_options *o, const cli_command *c) {
  while (!o->format_set && dyd_format_name(o->format) && !dyd_format_holds(o->format, o->content)) o->format++;
  if (!o->format_set || dyd_format_holds(o->format, o->content)) return 0;
  fprintf(stderr, "dyadel: %s%s%s%s does not write %s; give", c->name, o->sphere ? " --sphere" : "",
          o->layer ? " --layer " : "",
          o->layer     ? o->layer
          : o->queries ? " --queries"
                       : "",
          dyd_format_name(o->format));
  const char *before = " ";
  for (unsigned f = 0; dyd_format_name((dyd_format)f); f++) {
    if (!dyd_format_holds((dyd_format)f, o->content)) continue;
    fprintf(stderr, "%s%s", before, dyd_format_name((dyd_format)f));
    before = ", ";
  }
  fputs("\n", stderr);
  return CLI_USAGE;
}

/* The ending of the file that is written chooses the format, and does not contradict the one given. */
static int format_from_output(cli_options *o, const cli_command *c) {
  if (!o->output || c->content == DYD_CONTENT_NONE) return 0;
  if (!o->format_set) o->format_set = dyd_format_from_file(&o->format, o->output);
  if (dyd_format_suits_file(o->format, o->output)) return 0;
  const char *name = dyd_format_name(o->format);
  cli_complain("-o %s is no name for %s; leave --format %s away, or end the name in .%s", o->output, name, name, name);
  return CLI_USAGE;
}

/* Hands the operands behind the command's name to their fields. With an oracle or a trace there is no file, with a
 * file of places no place. */
static int place_operands(cli_options *o, const scan *s, const cli_command *c) {
  const char *operands = o->queries ? "FILE" : c->operands;
  const char **place[MOST_OPERANDS];
  size_t wanted = 0;
  bool file = !o->oracle && !trace_has_points(o, c);
  if (file) place[wanted++] = &o->file;
  if (strstr(operands, " X Y")) {
    place[wanted++] = &o->at[0];
    place[wanted++] = &o->at[1];
  }
  size_t given = s->operands - 1;
  if (given > wanted) {
    cli_complain("\"%s\" is one argument too many; give dyadel %s %s", s->operand[wanted + 1], c->name,
                 file ? operands : operands + strcspn(operands, " "));
    return CLI_USAGE;
  }
  for (size_t k = 0; k < given; k++) *place[k] = s->operand[k + 1];
  if (given == wanted) return 0;
  if (given == 0 && file && strncmp(operands, "FILE", 4) == 0)
    cli_complain("the points file is missing; give its name, or - for standard input");
  else
    cli_complain("an argument is missing; give dyadel %s %s", c->name, operands);
  return CLI_USAGE;
}

/* dyadel help [COMMAND] is dyadel [COMMAND] --help. */
static int options_help(cli_options *o, const scan *s) {
  if (s->operands > 2) {
    cli_complain("\"%s\" is one argument too many; give dyadel help COMMAND", s->operand[2]);
    return CLI_USAGE;
  }
  if (!o->help) o->help = "";
  if (s->operands < 2) return 0;
  if (!cli_command_find(s->operand[1])) return unknown_command(s->operand[1]);
  o->command = s->operand[1];
  return 0;
}

int cli_options_read(cli_options *out, int argc, char **argv) {
  scan s;
  *out = (cli_options){.format = DYD_FORMAT_CSV, .read = {DYD_SIZED(dyd_read_options)}};
  dyd_engine_options_init(&out->engine);
  scan_prepare(&s);
  int status = scan_all(&s, out, argc, argv);
  if (status) return status;
  if (s.operands == 0) {
    if (out->help || out->version) return 0;
    cli_complain("a command is missing; try: dyadel delaunay FILE, or dyadel --help");
    return CLI_USAGE;
  }
  if (strcmp(s.operand[0], "help") == 0) return options_help(out, &s);
  const cli_command *c = cli_command_find(s.operand[0]);
  if (!c) return unknown_command(s.operand[0]);
  out->command = c->name;
  if (out->help || out->version) return 0;
  status = options_fit(out, s.seen, c);
  if (!status) status = sphere_fits(out);
  if (!status) status = layer_fits(out, c);
  if (!status) status = format_from_output(out, c);
  if (!status) status = format_fits(out, c);
  return status ? status : place_operands(out, &s, c);
}
