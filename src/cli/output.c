/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Result files: written beside their final place and renamed when complete, so that they appear whole or not at
 * all. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "cli.h"
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool cli_guard_descriptors(void) {
  /* Opened the wrong way round, so that using one of them is an error. */
  static const int mode[3] = {O_WRONLY, O_RDONLY, O_WRONLY};
  for (int fd = 0; fd < 3; fd++)
    if (fcntl(fd, F_GETFD) == -1 && open("/dev/null", mode[fd]) != fd) return false;
  return true;
}

static bool output_fail(const char *name) {
  cli_complain("%s: cannot write: %s; choose another place with -o", name ? name : "standard output", strerror(errno));
  return false;
}

/* ---- pipes whose reader went away ---- */

static bool lost_reader;

bool cli_output_lost_reader(void) {
  return lost_reader;
}

/* Pipes and sockets tell of it whatever became of errno. */
static bool is_broken(FILE *stream) {
  struct pollfd end = {.fd = fileno(stream), .events = POLLOUT};
  return poll(&end, 1, 0) > 0 && end.revents & POLLERR;
}

bool cli_output_note_reader(FILE *stream, const char *name, const cli_options *o) {
  if (!is_broken(stream)) return false;
  lost_reader = true;
  cli_note(o, "%s: the reader went away before all was written", name ? name : "standard output");
  return true;
}

/* ---- names ---- */

/* The target of the link, as seen from where the link is; NULL: it is none, or memory is exhausted. */
static char *follow_link(const char *name) {
  char target[4096];
  ssize_t length = readlink(name, target, sizeof target - 1);
  const char *slash = strrchr(name, '/');
  if (length <= 0 || (size_t)length >= sizeof target - 1) return NULL;
  target[length] = 0;
  size_t folder = target[0] == '/' || !slash ? 0 : (size_t)(slash - name) + 1;
  char *path = malloc(folder + (size_t)length + 1);
  if (!path) return NULL;
  memcpy(path, name, folder);
  memcpy(path + folder, target, (size_t)length + 1);
  return path;
}

char *cli_output_target(const char *name) {
  char *path = realpath(name, NULL);
  if (path) return path;
  enum { MOST_LINKS = 40 };
  path = strdup(name);
  for (int k = 0; path && k < MOST_LINKS; k++) {
    char *next = follow_link(path);
    if (!next) break;
    free(path);
    path = next;
  }
  return path;
}

static mode_t default_mode(void) {
  mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

static bool open_temporary(cli_output *out, const char *name, mode_t mode) {
  size_t size = strlen(out->target) + sizeof ".XXXXXX";
  out->temporary = malloc(size);
  if (!out->temporary) return output_fail(name);
  snprintf(out->temporary, size, "%s.XXXXXX", out->target);
  int fd = mkstemp(out->temporary);
  if (fd < 0) {
    free(out->temporary);
    out->temporary = NULL;
    return output_fail(name);
  }
  cli_signals_remove(out->temporary);
  out->stream = fchmod(fd, mode) == 0 ? fdopen(fd, "w") : NULL;
  if (out->stream) return true;
  output_fail(name);
  close(fd);
  return false;
}

bool cli_output_open(cli_output *out, const char *name) {
  *out = (cli_output){.stream = stdout, .name = name};
  if (!name) return true;
  struct stat info;
  bool exists = stat(name, &info) == 0;
  if (exists && !S_ISREG(info.st_mode)) { /* a device or a pipe cannot be replaced */
    out->stream = fopen(name, "w");
    return out->stream ? true : output_fail(name);
  }
  out->stream = NULL;
  out->target = cli_output_target(name);
  bool done =
      out->target ? open_temporary(out, name, exists ? info.st_mode & 0777 : default_mode()) : output_fail(name);
  if (!done) cli_output_drop(out);
  return done;
}

bool cli_output_finish(cli_output *out, const cli_options *o) {
  errno = 0;
  bool done = fflush(out->stream) == 0 && !ferror(out->stream);
  if (done && out->temporary) done = fsync(fileno(out->stream)) == 0;
  int reason = errno;
  bool told = !done && cli_output_note_reader(out->stream, out->name, o);
  FILE *stream = out->stream;
  out->stream = NULL;
  if (fclose(stream) != 0) done = false;
  if (done && out->temporary) done = rename(out->temporary, out->target) == 0;
  if (!done && !told) {
    if (reason || !errno) errno = reason ? reason : EIO;
    output_fail(out->name);
  }
  cli_signals_remove(NULL);
  if (done) {
    free(out->temporary);
    out->temporary = NULL;
  }
  cli_output_drop(out);
  return done;
}

void cli_output_drop(cli_output *out) {
  if (out->stream && out->stream != stdout) fclose(out->stream);
  if (out->temporary) unlink(out->temporary);
  cli_signals_remove(NULL);
  free(out->temporary);
  free(out->target);
  *out = (cli_output){0};
}
