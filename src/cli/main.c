/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The command dyadel: finds out what is asked and does it. */
#include "cli.h"
#include <signal.h>
#include <stdarg.h>
#include <string.h>

void cli_complain(const char *format, ...) {
  va_list args;
  va_start(args, format);
  fputs("dyadel: ", stderr);
  vfprintf(stderr, format, args);
  fputs("\n", stderr);
  va_end(args);
}

static const struct {
  const char *name;
  int (*run)(const cli_options *o);
} commands[] = {{"delaunay", cli_delaunay}};
#define COMMANDS (sizeof commands / sizeof *commands)

static int print_and_close(void (*print)(FILE *)) {
  print(stdout);
  if (fflush(stdout) == 0 && !ferror(stdout)) return CLI_OK;
  cli_complain("cannot write to standard output");
  return CLI_FAILED;
}

static void print_version(FILE *out) {
  fprintf(out, "dyadel %s\n", dyd_version());
}

static int unknown_command(const char *name) {
  cli_complain("there is no command \"%s\"; the commands are:", name);
  for (size_t k = 0; k < COMMANDS; k++) fprintf(stderr, "  dyadel %s FILE\n", commands[k].name);
  return CLI_USAGE;
}

static int dispatch(const cli_options *o) {
  if (o->help) return print_and_close(cli_help);
  if (o->version) return print_and_close(print_version);
  if (!o->command) {
    cli_complain("a command is missing; try: dyadel delaunay FILE, or dyadel --help");
    return CLI_USAGE;
  }
  for (size_t k = 0; k < COMMANDS; k++) {
    if (strcmp(commands[k].name, o->command) != 0) continue;
    if (o->file) return commands[k].run(o);
    cli_complain("the points file is missing; give its name, or - for standard input");
    return CLI_USAGE;
  }
  return unknown_command(o->command);
}

int main(int argc, char **argv) {
  cli_options options;
  if (!cli_guard_descriptors()) return CLI_FAILED;
  signal(SIGPIPE, SIG_IGN); /* a reader that went away is a write error like others */
  int status = cli_options_read(&options, argc, argv);
  return status ? status : dispatch(&options);
}
