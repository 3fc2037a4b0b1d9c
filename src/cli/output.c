/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Result files: written without a name where the system has such files, else beside their final place, and named when
 * complete, so that they appear whole or not at all. Of a file without a name nothing is left however the process
 * ends. */
#define _GNU_SOURCE /* O_TMPFILE, fopencookie, pipe2 */
#define ZLIB_CONST
#include "cli.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

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

/* ---- packing ----
 *
 * By gzip or zstd if the name ends in .gz or .zst: a stream that forwards its bytes to another. */

enum { PACKED_BLOCK = 1 << 16, GZIP = 15 + 16, LEVEL = 6 };

/* zstd NULL: gzip is used. */
typedef struct packer {
  FILE *to; /* borrowed */
  z_stream gzip;
  ZSTD_CStream *zstd;
  unsigned char block[PACKED_BLOCK];
} packer;

bool cli_name_is_packed(size_t *length, const char *name) {
  size_t all = strlen(name), ending = 0;
  if (all > 3 && strcasecmp(name + all - 3, ".gz") == 0) ending = 3;
  if (all > 4 && strcasecmp(name + all - 4, ".zst") == 0) ending = 4;
  *length = all - ending;
  return ending;
}

/* Packs the bytes; at the end (last) all that is left. false: errno says why. */
static bool pack_bytes(packer *p, const void *bytes, size_t count, bool last) {
  ZSTD_inBuffer in = {bytes, count, 0};
  p->gzip.next_in = bytes, p->gzip.avail_in = (uInt)count;
  for (bool more = true; more;) {
    ZSTD_outBuffer out = {p->block, sizeof p->block, 0};
    p->gzip.next_out = p->block, p->gzip.avail_out = sizeof p->block;
    if (p->zstd) {
      size_t left = ZSTD_compressStream2(p->zstd, &out, &in, last ? ZSTD_e_end : ZSTD_e_continue);
      if (ZSTD_isError(left)) return errno = ENOMEM, false;
      more = last ? left > 0 : in.pos < in.size;
    } else {
      deflate(&p->gzip, last ? Z_FINISH : Z_NO_FLUSH);
      out.pos = sizeof p->block - p->gzip.avail_out;
      more = p->gzip.avail_out == 0;
    }
    if (fwrite(p->block, 1, out.pos, p->to) != out.pos) return false;
  }
  return true;
}

static ssize_t packer_write(void *cookie, const char *bytes, size_t count) {
  enum { MOST = 1 << 30 };
  if (count > MOST) count = MOST;
  return pack_bytes(cookie, bytes, count, false) ? (ssize_t)count : 0;
}

static int packer_close(void *cookie) {
  packer *p = cookie;
  bool good = pack_bytes(p, NULL, 0, true);
  if (!p->zstd) deflateEnd(&p->gzip);
  ZSTD_freeCStream(p->zstd);
  free(p);
  return good ? 0 : EOF;
}

/* A stream that compresses its data as the ending of the name says, and writes it to `to` (borrowed), the last part
 * when it is closed; NULL: the name has no such ending, or memory is exhausted. */
static FILE *pack_stream(FILE *to, const char *name) {
  size_t length;
  packer *p = cli_name_is_packed(&length, name) ? calloc(1, sizeof *p) : NULL;
  if (!p) return NULL;
  p->to = to;
  bool gzip = strcasecmp(name + length, ".gz") == 0;
  if (!gzip) p->zstd = ZSTD_createCStream();
  bool good = gzip ? deflateInit2(&p->gzip, LEVEL, Z_DEFLATED, GZIP, 8, Z_DEFAULT_STRATEGY) == Z_OK : p->zstd != NULL;
  FILE *out = good ? fopencookie(p, "w", (cookie_io_functions_t){.write = packer_write, .close = packer_close}) : NULL;
  if (out) return out;
  if (good && gzip) deflateEnd(&p->gzip);
  ZSTD_freeCStream(p->zstd);
  free(p);
  errno = ENOMEM;
  return NULL;
}

static bool is_packed(const char *name, const cli_options *o) {
  size_t length;
  return name && name == o->output && cli_name_is_packed(&length, name);
}

static dyd_status content_fail(dyd_error *err) {
  char text[128];
  snprintf(text, sizeof text, "cannot write: %s", strerror(errno));
  return dyd_error_set(err, DYD_E_IO, text);
}

static dyd_status content_print(FILE *out, const char *name, const cli_session *s, cli_print_fn print, dyd_error *err) {
  if (!is_packed(name, &s->o)) return print(out, s, err);
  FILE *packed = pack_stream(out, name);
  if (!packed) return content_fail(err);
  dyd_status st = print(packed, s, err);
  return fclose(packed) != 0 && st == DYD_OK ? content_fail(err) : st;
}

/* ---- pictures ----
 *
 * Written by a child process, since cairo and fontconfig follow null pointers when memory is exhausted, or do not end.
 * What happens to the child is an error here; other results are written. */

/* What the child reports; the numbers of a diagram follow. */
typedef struct drawing_report {
  dyd_status st;
  dyd_error err;
  size_t cut, coincident;
  bool finite;
} drawing_report;

static bool number_send(FILE *out, const dyd_dyadic *x) {
  return mpz_out_raw(out, x->man) > 0 && fwrite(&x->exp, sizeof x->exp, 1, out) == 1;
}

static bool number_receive(FILE *in, dyd_dyadic *x) {
  return mpz_inp_raw(x->man, in) > 0 && fread(&x->exp, sizeof x->exp, 1, in) == 1;
}

static bool report_send(FILE *out, const cli_diagram *d, dyd_status st, const dyd_error *err) {
  drawing_report r = {.st = st, .err = *err};
  if (d) r.cut = d->cut, r.coincident = d->coincident, r.finite = d->bounds.finite;
  bool good = fwrite(&r, sizeof r, 1, out) == 1;
  if (d) good = good && number_send(out, &d->bounds.area) && number_send(out, &d->bounds.hausdorff);
  return fclose(out) == 0 && good;
}

static bool report_receive(FILE *in, cli_diagram *d, dyd_status *st, dyd_error *err) {
  drawing_report r;
  bool good = fread(&r, sizeof r, 1, in) == 1;
  if (good && d) good = number_receive(in, &d->bounds.area) && number_receive(in, &d->bounds.hausdorff);
  if (!good) return false;
  if (d) d->cut = r.cut, d->coincident = r.coincident, d->bounds.finite = r.finite;
  *st = r.st;
  *err = r.err;
  return true;
}

/* The child: writes, reports, and ends. */
static _Noreturn void drawing_child(int report, FILE *out, const char *name, const cli_session *s, cli_print_fn print) {
  dyd_error err;
  dyd_error_clear(&err);
  cli_deadline_again();
  dyd_status st = content_print(out, name, s, print, &err);
  if (st == DYD_OK && fflush(out) != 0) st = content_fail(&err);
  FILE *to = fdopen(report, "w");
  _exit(to && report_send(to, s->diagram, st, &err) ? CLI_OK : CLI_FAILED);
}

/* Makes the child end with its parent; returns true if the parent still runs. */
static bool drawing_ties(pid_t parent) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  return getppid() == parent;
}

/* Returns false if the child has neither reported nor ended within these seconds. */
static bool drawing_wait(int report, double seconds) {
  struct pollfd end = {.fd = report, .events = POLLIN};
  const double until = cli_clock() + seconds;
  for (double left = seconds; left > 0; left = until - cli_clock()) {
    int ready = poll(&end, 1, left < 1e6 ? (int)(1e3 * left) + 1 : 1000000000);
    if (ready > 0 || (ready < 0 && errno != EINTR)) return true;
  }
  return false;
}

/* Seconds for a picture: the rest of --timeout, whose watch ends this process. Without it, by far enough time to find
 * fonts and draw the points. */
static double drawing_patience(const cli_session *s) {
  const double of_points = s->engine ? 1e-3 * (double)dyd_engine_count(s->engine) : 0;
  return cli_deadline_left(1) > 0 ? 1e9 : 60 + of_points;
}

static dyd_status drawing_failed(dyd_error *err, const char *why) {
  char text[DYD_MESSAGE_SIZE];
  snprintf(text, sizeof text,
           "no picture was written, since %s; that happens when memory is exhausted: close other programs, or give "
           "another format",
           why);
  return dyd_error_set(err, DYD_E_STREAM, text);
}

static dyd_status drawing_end(int report, pid_t child, const cli_session *s, dyd_error *err) {
  char why[80] = "it takes too long";
  dyd_status st = DYD_E_STREAM;
  int how = 0;
  if (!drawing_wait(report, drawing_patience(s))) kill(child, SIGKILL);
  FILE *in = fdopen(report, "r");
  bool told = in && report_receive(in, s->diagram, &st, err);
  if (in)
    fclose(in);
  else
    close(report);
  while (waitpid(child, &how, 0) < 0 && errno == EINTR) continue;
  if (told) return st;
  if (WIFEXITED(how)) snprintf(why, sizeof why, "drawing it ended with status %d", WEXITSTATUS(how));
  if (WIFSIGNALED(how) && WTERMSIG(how) != SIGKILL)
    snprintf(why, sizeof why, "drawing it ended with signal %d", WTERMSIG(how));
  return drawing_failed(err, why);
}

static dyd_status draw_apart(FILE *out, const char *name, const cli_session *s, cli_print_fn print, dyd_error *err) {
  int report[2];
  if (pipe2(report, O_CLOEXEC) != 0) return drawing_failed(err, "a process for it cannot be started");
  fflush(NULL); /* buffered data is written by one process only */
  const pid_t parent = getpid(), child = fork();
  if (child == 0) {
    close(report[0]);
    if (drawing_ties(parent)) drawing_child(report[1], out, name, s, print);
    _exit(CLI_FAILED);
  }
  close(report[1]);
  if (child > 0) return drawing_end(report[0], child, s, err);
  close(report[0]);
  return drawing_failed(err, "a process for it cannot be started");
}

bool cli_is_picture(dyd_format format) {
  return format == DYD_FORMAT_SVG || format == DYD_FORMAT_PDF || format == DYD_FORMAT_PNG || format == DYD_FORMAT_TIKZ;
}

/* A plot is always one. */
static bool is_picture(const char *name, const cli_options *o) {
  if (name && (name == o->certificate || name == o->trace || name == o->plot || name == o->pgf)) return name == o->plot;
  return cli_is_picture(o->format);
}

static dyd_status write_content(FILE *out, const char *name, const cli_session *s, cli_print_fn print, dyd_error *err) {
  return is_picture(name, &s->o) ? draw_apart(out, name, s, print, err) : content_print(out, name, s, print, err);
}

/* ---- a result ---- */

/* Nothing is written since work was cut: says why. Exit status. */
static int write_was_cut(dyd_status st, const cli_options *o, const dyd_error *err) {
  if (cli_deadline_passed()) {
    cli_complain("budget: time limit reached before the result was known: nothing is written (raise --timeout)");
    return CLI_BUDGET;
  }
  if (st == DYD_CAPPED)
    cli_complain_at(o->file, err);
  else
    cli_complain("cancelled before the result was known: nothing is written");
  return st == DYD_CAPPED ? CLI_BUDGET : CLI_CANCELLED;
}

int cli_write_file(const char *name, const cli_session *s, cli_print_fn print) {
  const cli_options *o = &s->o;
  cli_output out;
  if (!cli_output_open(&out, name)) return CLI_FAILED;
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status st = write_content(out.stream, name, s, print, &err);
  bool done = st == DYD_OK;
  if (st > 0) {
    cli_output_drop(&out);
    return write_was_cut(st, o, &err);
  }
  if (st == DYD_E_IO && !cli_output_note_reader(out.stream, name, o))
    cli_complain("%s: %s; choose another place with -o", name ? name : "standard output", err.message);
  else if (!done && st != DYD_E_IO)
    cli_complain_at(o->file, &err);
  if (done)
    done = cli_output_finish(&out, o);
  else
    cli_output_drop(&out);
  const dyd_format_facts *f = dyd_format_get(o->format);
  if (done && f && is_packed(name, o)) cli_note(o, "%s holds %s, packed", name, f->name);
  return done ? 0 : cli_exit_refused(&s->o, st);
}
