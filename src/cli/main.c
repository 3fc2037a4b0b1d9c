/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The command dyadel. */
#include "cli.h"
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#ifndef DYD_GDAL
const cli_gdal *const cli_gdal_here = NULL;
#endif

static int flush_output(const cli_options *o) {
  if (fflush(stdout) == 0 && !ferror(stdout)) return CLI_OK;
  if (!cli_output_note_reader(stdout, NULL, o)) cli_complain("cannot write to standard output");
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
  return *o->help && k == kinds ? CLI_USAGE : flush_output(o);
}

static int run_command(const cli_options *o) {
  if (o->help) return print_help(o);
  if (o->version) {
    printf("dyadel %s\n", dyd_version());
    return flush_output(o);
  }
  int status = cli_files_check(o);
  cli_deadline_start(o->engine.seconds);
  if (!status) status = cli_work_run(cli_command_find(o->command)->work, o);
  return status == CLI_FIXPOINT && o->accept_fixpoint ? CLI_OK : status;
}

int main(int argc, char **argv) {
  cli_options options;
  if (!cli_guard_descriptors()) return CLI_FAILED;
  cli_memory_guard();
  char **call = calloc((size_t)argc + 1, sizeof *call);
  int status = call ? cli_options_read(&options, argc, argv, call) : cli_complain_memory();
  if (!status) status = cli_spatial_switch(&options, argv);
  /* A broken pipe is noticed when writing fails, so that other files are finished and all messages printed. At the end
   * the process dies of SIGPIPE as others do, unless the parent ignores it. */
  void (*before)(int) = signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN); /* a file that may grow no more is noticed at the writing, too */
  if (!status) status = run_command(&options);
  free(call);
  if (cli_output_lost_reader() && before == SIG_DFL) {
    signal(SIGPIPE, SIG_DFL);
    raise(SIGPIPE);
  }
  return status;
}
