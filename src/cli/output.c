/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Result files: written without a name where the system has such files, else beside their final place, and named when
 * complete, so that they appear whole or not at all. Of a file without a name nothing is left however the process
 * ends. */
#define _GNU_SOURCE /* O_TMPFILE */
#include "cli.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
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

/* ---- pipes closed by their reader ---- */

static bool lost_reader;

bool cli_output_lost_reader(void) {
  return lost_reader;
}

/* Pipes and sockets report it even after errno has changed. */
static bool is_broken(FILE *stream) {
  struct pollfd end = {.fd = fileno(stream), .events = POLLOUT};
  return poll(&end, 1, 0) > 0 && end.revents & POLLERR;
}

bool cli_output_note_reader(FILE *stream, const char *name, const cli_options *o) {
  if (!is_broken(stream)) return false;
  lost_reader = true;
  cli_note(o, "%s: output closed early (broken pipe)", name ? name : "standard output");
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

/* Where writing to the file of this name ends up, links followed, also one that leads to no file; release with free().
 * NULL: memory is exhausted. */
static char *output_target(const char *name) {
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

/* The folder of the file, opened so that `flags` say; -1: it cannot be. */
static int open_folder(const char *target, int flags) {
  const char *slash = strrchr(target, '/');
  char *folder = slash ? strndup(target, slash == target ? 1 : (size_t)(slash - target)) : strdup(".");
  int fd = folder ? open(folder, flags | O_CLOEXEC, 0600) : -1;
  free(folder);
  return fd;
}

/* ---- files without a name ---- */

enum { LINK_SIZE = 40 };

/* By which an open file can be given a name. */
static void descriptor_path(char path[LINK_SIZE], int fd) {
  snprintf(path, LINK_SIZE, "/proc/self/fd/%d", fd);
}

/* -1: here are no such files, or they could not be named. */
static int open_unnamed(const char *target) {
#ifdef O_TMPFILE
  char path[LINK_SIZE];
  int fd = open_folder(target, O_TMPFILE | O_WRONLY);
  if (fd < 0) return -1;
  descriptor_path(path, fd);
  if (access(path, F_OK) == 0) return fd;
  close(fd);
#else
  (void)target;
#endif
  return -1;
}

/* A link never replaces a file: if the name is taken, the file gets another name next to it, to be renamed. */
static bool link_beside(cli_output *out, const char *path) {
  enum { MOST_TRIES = 1000 };
  size_t size = strlen(out->target) + 32;
  char *name = malloc(size);
  bool taken = true;
  for (long k = 0; name && taken && k < MOST_TRIES; k++) {
    snprintf(name, size, "%s.%06ld", out->target, ((long)getpid() + k) % 1000000);
    taken = linkat(AT_FDCWD, path, AT_FDCWD, name, AT_SYMLINK_FOLLOW) != 0;
    if (taken && errno != EEXIST) break;
  }
  if (taken) {
    free(name);
    return false;
  }
  out->temporary = name;
  cli_signals_remove(name);
  return true;
}

/* Gives the file, which is complete, its name. */
static bool output_place(cli_output *out, int fd) {
  if (!out->temporary) {
    char path[LINK_SIZE];
    descriptor_path(path, fd);
    if (linkat(AT_FDCWD, path, AT_FDCWD, out->target, AT_SYMLINK_FOLLOW) == 0) return true;
    if (errno != EEXIST || !link_beside(out, path)) return false;
  }
  if (rename(out->temporary, out->target) != 0) return false;
  cli_signals_keep(out->temporary);
  free(out->temporary);
  out->temporary = NULL;
  return true;
}

/* The same with signals blocked, so that none arrives while the name is not registered yet; then the folder
 * goes to the disk as well, where it can. */
static bool output_appear(cli_output *out, int fd) {
  sigset_t before;
  cli_signals_hold(&before);
  bool done = output_place(out, fd);
  int reason = errno;
  cli_signals_release(&before);
  int folder = done ? open_folder(out->target, O_RDONLY) : -1;
  if (folder >= 0) {
    fsync(folder);
    close(folder);
  }
  errno = reason;
  return done;
}

/* ---- opening and ending ---- */

/* A file with a name of its own, which signals remove. They are held back until the name is registered. */
static int open_named(cli_output *out) {
  sigset_t before;
  size_t size = strlen(out->target) + sizeof ".XXXXXX";
  out->temporary = malloc(size);
  if (!out->temporary) return -1;
  snprintf(out->temporary, size, "%s.XXXXXX", out->target);
  cli_signals_hold(&before);
  int fd = mkstemp(out->temporary), reason = errno;
  if (fd >= 0) cli_signals_remove(out->temporary);
  cli_signals_release(&before);
  if (fd >= 0) return fd;
  free(out->temporary);
  out->temporary = NULL;
  errno = reason;
  return -1;
}

static bool open_temporary(cli_output *out, mode_t mode) {
  int fd = open_unnamed(out->target);
  if (fd < 0) fd = open_named(out);
  if (fd < 0) return output_fail(out->name);
  out->stream = fchmod(fd, mode) == 0 ? fdopen(fd, "w") : NULL;
  if (out->stream) return true;
  output_fail(out->name);
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
  out->target = output_target(name);
  bool done = out->target ? open_temporary(out, exists ? info.st_mode & 0777 : default_mode()) : output_fail(name);
  if (!done) cli_output_drop(out);
  return done;
}

/* Everything is on the disk, under its name; else errno says why not. */
static bool output_complete(cli_output *out) {
  errno = 0;
  if (fflush(out->stream) != 0 || ferror(out->stream)) return false;
  if (!out->target) return true;
  return fsync(fileno(out->stream)) == 0 && output_appear(out, fileno(out->stream));
}

bool cli_output_appear(cli_output *out) {
  return output_complete(out) || output_fail(out->name);
}

bool cli_output_finish(cli_output *out, const cli_options *o) {
  bool done = output_complete(out);
  int reason = errno;
  bool told = !done && cli_output_note_reader(out->stream, out->name, o);
  FILE *stream = out->stream;
  out->stream = NULL;
  if (fclose(stream) != 0) done = false;
  if (!done && !told) {
    if (reason || !errno) errno = reason ? reason : EIO;
    output_fail(out->name);
  }
  cli_output_drop(out);
  return done;
}

void cli_output_drop(cli_output *out) {
  if (out->stream && out->stream != stdout) fclose(out->stream);
  if (out->temporary) {
    unlink(out->temporary);
    cli_signals_keep(out->temporary);
  }
  free(out->temporary);
  free(out->target);
  *out = (cli_output){0};
}

/* ---- files of the command line ----
 *
 * Before anything is read: no output may be an input, or another output; no picture goes to
 * a terminal. */

enum { MOST_FILES = 16 };

/* A file that is named by the arguments, or a standard stream. For one that does not exist: that of its folder, and its
 * name in there. */
typedef struct named_file {
  const char *option, *name;
  bool written, known, exists;
  dev_t device;
  ino_t inode;
  char *last;
} named_file;

static void named_identify(named_file *f, const struct stat *info) {
  f->known = true;
  f->device = info->st_dev;
  f->inode = info->st_ino;
}

/* Only regular files may not be used twice. false: memory is exhausted. */
static bool named_open(named_file *f, int descriptor) {
  struct stat info;
  f->exists = descriptor >= 0 ? fstat(descriptor, &info) == 0 : stat(f->name, &info) == 0;
  if (f->exists && S_ISREG(info.st_mode)) named_identify(f, &info);
  char *path = !f->exists && descriptor < 0 && f->written ? output_target(f->name) : NULL;
  if (!path) return true; /* opening it will report the error */
  char *slash = strrchr(path, '/');
  f->last = strdup(slash ? slash + 1 : path);
  if (slash) slash[slash == path ? 1 : 0] = 0;
  if (f->last && stat(slash ? path : ".", &info) == 0) named_identify(f, &info);
  free(path);
  return f->last != NULL;
}

static bool named_equal(const named_file *a, const named_file *b) {
  if (!a->known || !b->known || a->exists != b->exists || a->device != b->device || a->inode != b->inode) return false;
  return a->exists || strcmp(a->last, b->last) == 0;
}

/* All files of the options, then the operand, then standard streams in use. */
static size_t list_files(named_file file[MOST_FILES], const cli_options *o) {
  size_t n = 0;
  for (size_t k = 0; k < cli_option_count && n < MOST_FILES - 2; k++) {
    const cli_option *option = &cli_option_table[k];
    if (!cli_kind_is_file(option->kind)) continue;
    const char *name = *(const char *const *)((const char *)o + option->offset);
    if (name) file[n++] = (named_file){.option = option->name, .name = name, .written = option->kind == CLI_FILE};
  }
  if (o->file) file[n++] = (named_file){.name = o->file};
  if (!o->output) file[n++] = (named_file){.name = "standard output", .written = true};
  return n;
}

static void complain_equal(const named_file *a, const named_file *b) {
  const named_file *out = a->written ? a : b, *other = a->written ? b : a;
  const char *dash = out->option ? "--" : "", *option = out->option ? out->option : "";
  if (other->written)
    cli_complain("%s%s%s%s and --%s %s are the same file; give each result a file of its own", dash, option,
                 *option ? " " : "", out->name, other->option, other->name);
  else
    cli_complain("%s%s%s%s is the input file; give another name for the output", dash, option, *option ? " " : "",
                 out->name);
}

int cli_files_check(const cli_options *o) {
  named_file file[MOST_FILES];
  size_t n = list_files(file, o);
  int status = 0;
  for (size_t k = 0; k < n && !status; k++) {
    int descriptor = -1;
    if (!file[k].option && file[k].written) descriptor = STDOUT_FILENO;
    if (!file[k].written && strcmp(file[k].name, "-") == 0) descriptor = STDIN_FILENO;
    if (file[k].option && file[k].written && strcmp(file[k].name, "-") == 0)
      status =
          cli_usage("--%s -: standard output is for the result; give a name (./- for a file called -)", file[k].option);
    else if (!named_open(&file[k], descriptor))
      status = cli_complain_memory();
    for (size_t m = 0; m < k && !status; m++) {
      if ((!file[k].written && !file[m].written) || !named_equal(&file[k], &file[m])) continue;
      complain_equal(&file[k], &file[m]);
      status = CLI_USAGE;
    }
  }
  for (size_t k = 0; k < n; k++) free(file[k].last);
  const dyd_format_facts *f = dyd_format_get(o->format); /* NULL: the command has no format */
  if (status || o->output || !f || !f->binary || !isatty(STDOUT_FILENO)) return status;
  return cli_usage("%s is nothing for a terminal; give a file: -o NAME.%s", f->name, f->name);
}

FILE *cli_input_open(const char *name, const char *advice) {
  FILE *in = strcmp(name, "-") == 0 ? stdin : fopen(name, "rb");
  if (!in) cli_complain("%s: cannot open: %s; %s", name, strerror(errno), advice);
  return in;
}

void cli_input_close(FILE *in) {
  if (in != stdin) fclose(in);
}
