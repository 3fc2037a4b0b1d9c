/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How a file is filled: packed if its name says so, and pictures by a child process, since cairo and fontconfig follow
 * null pointers when memory is exhausted, or do not end. What happens to the child is an error here; other results are
 * written. */
#define _GNU_SOURCE /* pipe2 */
#include "cli.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

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

bool cli_is_packed(const char *name, const cli_options *o) {
  size_t length;
  return name && name == o->output && cli_name_is_packed(&length, name);
}

static dyd_status content_fail(dyd_error *err) {
  char text[128];
  snprintf(text, sizeof text, "cannot write: %s", strerror(errno));
  return dyd_error_set(err, DYD_E_IO, text);
}

static dyd_status content_print(FILE *out, const char *name, const cli_session *s, cli_print_fn print, dyd_error *err) {
  if (!cli_is_packed(name, &s->o)) return print(out, s, err);
  FILE *packed = cli_pack(out, name);
  if (!packed) return content_fail(err);
  dyd_status st = print(packed, s, err);
  return fclose(packed) != 0 && st == DYD_OK ? content_fail(err) : st;
}

/* ---- pictures ---- */

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

dyd_status cli_write_content(FILE *out, const char *name, const cli_session *s, cli_print_fn print, dyd_error *err) {
  return is_picture(name, &s->o) ? draw_apart(out, name, s, print, err) : content_print(out, name, s, print, err);
}
