/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The command dyadel: finds out what is asked and does it. */
#include "table.h"
#include <signal.h>
#include <string.h>

static int flush_output(void) {
  if (fflush(stdout) == 0 && !ferror(stdout)) return CLI_OK;
  cli_complain("cannot write to standard output");
  return CLI_FAILED;
}

static int print_help(const cli_options *o) {
  static const struct {
    const char *name;
    void (*print)(FILE *out);
  } kind[] = {{"man", cli_help_man}, {"bash", cli_help_bash}, {"zsh", cli_help_zsh}};
  size_t k = 0, kinds = sizeof kind / sizeof *kind;
  while (k < kinds && strcmp(o->help, kind[k].name) != 0) k++;
  if (!*o->help)
    cli_help(stdout, o->command ? cli_command_find(o->command) : NULL);
  else if (k < kinds)
    kind[k].print(stdout);
  else
    cli_complain("--help=%s is not understood; give --help, --help=man, --help=bash or --help=zsh", o->help);
  return *o->help && k == kinds ? CLI_USAGE : flush_output();
}

int main(int argc, char **argv) {
  cli_options options;
  if (!cli_guard_descriptors()) return CLI_FAILED;
  signal(SIGPIPE, SIG_IGN); /* a reader that went away is a write error like others */
  int status = cli_options_read(&options, argc, argv);
  if (status) return status;
  if (options.help) return print_help(&options);
  if (options.version) {
    printf("dyadel %s\n", dyd_version());
    return flush_output();
  }
  cli_deadline_start(options.engine.seconds);
  return cli_command_find(options.command)->run(&options);
}
