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

/* Where the program is, by how the folder of this command ends: as installed, and as built. */
static const struct {
  const char *end, *instead;
} PLACE[] = {{"/", "/"}, {"/bin/", "/libexec/"}, {"/src/cli/", "/proofs/"}};
enum { PLACES = sizeof PLACE / sizeof *PLACE };

/* Sets *at to where `end` begins in the folder; returns false if the folder does not end in it. */
static bool folder_ends(size_t *at, const char *folder, const char *end) {
  size_t length = strlen(folder), tail = strlen(end);
  if (tail > length) return false;
  *at = length - tail;
  return strcmp(folder + *at, end) == 0;
}

/* Sets path to the folder of this command, "" where it is not known. */
static void folder_find(char *path, size_t size) {
  ssize_t length = readlink("/proc/self/exe", path, size);
  if (length >= (ssize_t)size) length = 0;
  while (length > 0 && path[length - 1] != '/') length--;
  path[length > 0 ? length : 0] = 0;
}

/* Sets path to the program in one of the places, or to its name, for PATH to find it. */
static void proved_find(char *path, size_t size, const char *folder) {
  size_t at;
  for (int k = 0; k < PLACES; k++) {
    if (!folder_ends(&at, folder, PLACE[k].end)) continue;
    snprintf(path, size, "%.*s%s" PROGRAM, (int)at, folder, PLACE[k].instead);
    if (access(path, X_OK) == 0) return;
  }
  snprintf(path, size, PROGRAM);
}

/* Reports the missing program, where it was looked for, and the remedy. */
static void complain_missing(const char *folder) {
  size_t at;
  if (folder_ends(&at, folder, PLACE[PLACES - 1].end))
    cli_complain("there is no " PROGRAM " in %.*s%s or in PATH (to build it, which needs coqc, ocamlfind and Zarith: "
                 "meson configure -Dproofs=enabled %.*s && ninja -C %.*s)",
                 (int)at, folder, PLACE[PLACES - 1].instead, (int)at, folder, (int)at, folder);
  else
    cli_complain("there is no " PROGRAM " in %s%sPATH (omit --proved, or install " PROGRAM
                 " from a build of dyadel with meson setup -Dproofs=enabled)",
                 folder, *folder ? " or in " : "");
}

/* Becomes the program, by functions only that may follow fork. `still` becomes its standard input (-1: no list). */
static void proved_become(int out, int still, const char *path, const char *file) {
  const char *option = still < 0 ? NULL : "--still"; /* NULL ends the arguments */
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL); /* whatever ends the command ends it */
#endif
  if (dup2(out, STDOUT_FILENO) < 0) _exit(CANNOT_RUN);
  if (still >= 0 && dup2(still, STDIN_FILENO) < 0) _exit(CANNOT_RUN);
  execlp(path, PROGRAM, file, option, "-", (char *)NULL);
  _exit(CANNOT_RUN);
}

/* Runs the program to its end; its exit status, which means what ours does. */
static int proved_run(int out, int still, const char *file) {
  char folder[4096], path[sizeof folder + 64];
  int how = 0;
  folder_find(folder, sizeof folder);
  proved_find(path, sizeof path, folder);
  pid_t child = fork();
  if (child == 0) proved_become(out, still, path, file);
  while (child > 0 && waitpid(child, &how, 0) < 0)
    if (errno != EINTR) child = -1;
  if (child < 0) {
    cli_complain("cannot run " PROGRAM ": %s", strerror(errno));
    return CLI_FAILED;
  }
  if (WIFEXITED(how) && WEXITSTATUS(how) != CANNOT_RUN) return WEXITSTATUS(how);
  if (WIFEXITED(how))
    complain_missing(folder);
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
