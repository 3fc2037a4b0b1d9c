/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel verify --proved: the check is done by dyadel-proved, a program of its own, extracted from what is proved in
 * Coq. */
#include "cli.h"
#include <errno.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <signal.h>
#include <sys/prctl.h>
#endif

#define PROGRAM "dyadel-proved"
enum { CANNOT_RUN = 127 };

/* Becomes the program, the one beside this command, else one in PATH; only functions that may follow fork. What stays
 * is its standard input (-1: it is not told). */
static void proved_become(int out, int still, const char *file) {
  char path[4096];
  const char *option = still < 0 ? NULL : "--still"; /* NULL ends the arguments */
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL); /* whatever ends the command ends it */
#endif
  ssize_t length = readlink("/proc/self/exe", path, sizeof path - sizeof PROGRAM);
  while (length > 0 && path[length - 1] != '/') length--;
  if (dup2(out, STDOUT_FILENO) < 0) _exit(CANNOT_RUN);
  if (still >= 0 && dup2(still, STDIN_FILENO) < 0) _exit(CANNOT_RUN);
  if (length > 0) {
    memcpy(path + length, PROGRAM, sizeof PROGRAM);
    execl(path, PROGRAM, file, option, "-", (char *)NULL);
  }
  execlp(PROGRAM, PROGRAM, file, option, "-", (char *)NULL);
  _exit(CANNOT_RUN);
}

/* Runs the program to its end; its exit status, which means what ours does. */
static int proved_run(int out, int still, const char *file) {
  int how = 0;
  pid_t child = fork();
  if (child == 0) proved_become(out, still, file);
  while (child > 0 && waitpid(child, &how, 0) < 0)
    if (errno != EINTR) child = -1;
  if (child < 0) {
    cli_complain("cannot run " PROGRAM ": %s", strerror(errno));
    return CLI_FAILED;
  }
  if (WIFEXITED(how) && WEXITSTATUS(how) != CANNOT_RUN) return WEXITSTATUS(how);
  if (WIFEXITED(how))
    cli_complain("there is no " PROGRAM ", neither beside dyadel nor in PATH: leave --proved out, or build it with "
                 "-Dproofs=enabled, which needs coqc, ocamlfind and Zarith");
  else
    cli_complain("%s: not judged: " PROGRAM " was ended by signal %d", file, WTERMSIG(how));
  return CLI_FAILED;
}

int cli_verify_proved(const cli_options *o, FILE *still, const char *more) {
  cli_output out;
  cli_deadline_phase("checking the certificate");
  if (!cli_output_open(&out, o->output)) return CLI_FAILED;
  if (still) rewind(still); /* what the child reads from */
  int status = proved_run(fileno(out.stream), still ? fileno(still) : -1, o->file);
  if (status == CLI_OK || status == CLI_FIXPOINT) {
    fputs(more, out.stream);
    return cli_output_finish(&out, o) ? status : CLI_FAILED;
  }
  cli_output_drop(&out);
  return status;
}
