/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The process: messages on standard error, signals, memory, the time limit, progress. */
#include "cli.h"

#include <errno.h>
#include <flint/flint.h>
#include <jansson.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* ---- messages ---- */

/* Returns true if the field of the library's options has an option of the command, and prints that: `max_pairs` is
 * --max-pairs, and `radius_columns`, which may name two, is --radius-column. */
static bool complain_field(FILE *out, const char *field, size_t length) {
  for (const cli_option *o = cli_option_table; o < cli_option_table + cli_option_count; o++) {
    size_t k = 0;
    while (k < length && (field[k] == '_' ? '-' : field[k]) == o->name[k]) k++;
    if (o->name[k] || !(k == length || (k + 1 == length && field[k] == 's'))) continue;
    fprintf(out, "--%s", o->name);
    return true;
  }
  return false;
}

/* Prints the byte, or, where a terminal might take it for a command, its number; returns how many bytes of a character
 * are left. */
static int complain_byte(FILE *out, const char *at, int left) {
  unsigned char c = (unsigned char)*at;
  bool inside = left > 0 && (c & 0xC0) == 0x80, first = c >= 0xC2 && c < 0xF5;
  bool control = c < 0x20 || c == 0x7F || (c == 0xC2 && ((unsigned char)at[1] & 0xE0) == 0x80);
  if (control || (c >= 0x80 && !inside && !first)) {
    fprintf(out, "\\x%02X", c);
    return 0;
  }
  fputc(c, out);
  return inside ? left - 1 : !first ? 0 : c < 0xE0 ? 1 : c < 0xF0 ? 2 : 3;
}

/* Prints a message: the library names fields of its options in backquotes. The text may come from untrusted input. */
static void complain_print(FILE *out, const char *text) {
  for (int left = 0; *text;) {
    size_t length = *text == '`' ? strspn(text + 1, "abcdefghijklmnopqrstuvwxyz_") : 0;
    if (*text == '`' && text[1 + length] == '`' && complain_field(out, text + 1, length))
      text += length + 2;
    else
      left = complain_byte(out, text++, left);
  }
}

static void complain_list(const char *format, va_list args) {
  char text[2 * DYD_MESSAGE_SIZE + 8192];
  vsnprintf(text, sizeof text, format, args);
  fputs("dyadel: ", stderr);
  complain_print(stderr, text);
  fputs("\n", stderr);
}

int cli_usage(const char *format, ...) {
  va_list args;
  va_start(args, format);
  complain_list(format, args);
  va_end(args);
  return CLI_USAGE;
}

int cli_complain(const char *format, ...) {
  va_list args;
  va_start(args, format);
  complain_list(format, args);
  va_end(args);
  return CLI_FAILED;
}

void cli_note(const cli_options *o, const char *format, ...) {
  va_list args;
  va_start(args, format);
  if (!o->quiet) complain_list(format, args);
  va_end(args);
}

int cli_complain_memory(void) {
  return cli_complain("memory is exhausted; close other programs");
}

int cli_complain_of(const dyd_engine *e, const char *file, const dyd_error *err) {
  dyd_error own = *err;
  if (own.point != DYD_NO_POINT) own.point = dyd_engine_row(e, own.point);
  return cli_complain_at(file, &own);
}

int cli_complain_at(const char *file, const dyd_error *err) {
  char point[40] = "";
  if (err->point != DYD_NO_POINT) snprintf(point, sizeof point, "point %zu: ", err->point);
  if (!file) return cli_complain("%s%s", point, err->message);
  if (!err->line) return cli_complain("%s: %s%s", file, point, err->message);
  return cli_complain("%s:%zu:%zu: %s%s", file, err->line, err->column, point, err->message);
}

int cli_exit_refused(const cli_options *o, dyd_status st) {
  return st == DYD_E_NOMEM && o->engine.max_bytes ? CLI_BUDGET : CLI_FAILED;
}

/* ---- signals ----
 *
 * Ctrl-C, a connection that is lost, a request to end: the first one cancels the run, so that results are written; the
 * next one ends the process. Other signals end it at once. No file begun is left.
 *
 * Handlers touch only lock-free objects, dyd_engine_cancel (async-signal-safe by contract) and unlink. */

static _Atomic(dyd_engine *) to_cancel;

/* The results begun: one, and the trace of the run that makes it, and one to spare. */
enum { MOST_FILES = 4 };

static _Atomic(const char *) to_remove[MOST_FILES];

static volatile int stop;

/* Removes these files; async-signal-safe. */
static void signals_unlink(void) {
  for (int k = 0; k < MOST_FILES; k++) {
    const char *name = atomic_load(&to_remove[k]);
    if (name) unlink(name);
  }
}

/* Raises the flag below; async-signal-safe, from any thread. */
static void signals_stop(void) {
  __atomic_store_n(&stop, 1, __ATOMIC_SEQ_CST);
}

const volatile int *cli_signals_flag(void) {
  return &stop;
}

static void signal_end(int number) {
  signals_unlink();
  signal(number, SIG_DFL);
  raise(number);
}

static void signal_cancel(int number) {
  dyd_engine *e = atomic_exchange(&to_cancel, NULL);
  if (!e) {
    signal_end(number);
    return;
  }
  dyd_engine_cancel(e);
  signals_stop();
}

static void signal_install(int number, void (*handler)(int)) {
  struct sigaction old, action = {.sa_handler = handler, .sa_flags = SA_RESTART};
  sigemptyset(&action.sa_mask);
  /* A parent that has us ignore the signal (nohup) means it. */
  if (sigaction(number, NULL, &old) == 0 && old.sa_handler == SIG_IGN) return;
  sigaction(number, &action, NULL);
}

static void signals_install(void) {
  static const int cancel[] = {SIGINT, SIGTERM, SIGHUP}, end[] = {SIGQUIT, SIGXCPU, SIGABRT};
  for (size_t k = 0; k < sizeof cancel / sizeof *cancel; k++) signal_install(cancel[k], signal_cancel);
  for (size_t k = 0; k < sizeof end / sizeof *end; k++) signal_install(end[k], signal_end);
}

void cli_signals_cancel(dyd_engine *e) {
  atomic_store(&to_cancel, e);
  signals_install();
}

static void signals_exchange(const char *before, const char *now) {
  for (int k = 0; k < MOST_FILES; k++) {
    const char *expected = before;
    if (atomic_compare_exchange_strong(&to_remove[k], &expected, now)) return;
  }
}

void cli_signals_remove(const char *temporary) {
  signals_exchange(NULL, temporary);
  signals_install();
}

void cli_signals_keep(const char *temporary) {
  signals_exchange(temporary, NULL);
}

void cli_signals_hold(sigset_t *before) {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, before);
}

void cli_signals_release(const sigset_t *before) {
  pthread_sigmask(SIG_SETMASK, before, NULL);
}

/* Starts a thread that takes no signals: signals that the main thread holds back stay held back. */
static bool signals_spare(pthread_t *out, void *(*work)(void *), void *user) {
  sigset_t before;
  cli_signals_hold(&before);
  bool done = pthread_create(out, NULL, work, user) == 0;
  cli_signals_release(&before);
  return done;
}

/* ---- memory ----
 *
 * GMP, MPFR and FLINT, which hold the long numbers, cannot report to their caller that memory is exhausted: they end
 * the process. Jansson 2.14 follows a null pointer. Here all of them end it with a message and an exit status of the
 * command, and no file begun is left. */

static void *memory_found(void *p) {
  if (p) return p;
  cli_complain_memory();
  signals_unlink();
  _exit(CLI_FAILED);
}

static void *memory_take(size_t size) {
  return memory_found(malloc(size ? size : 1));
}

static void *memory_clear(size_t count, size_t size) {
  return memory_found(calloc(count ? count : 1, size ? size : 1));
}

static void *memory_change(void *old, size_t size) {
  return memory_found(realloc(old, size ? size : 1));
}

static void *memory_resize(void *old, size_t before, size_t size) {
  (void)before;
  return memory_change(old, size);
}

static void memory_release(void *old, size_t size) {
  (void)size;
  free(old);
}

/* What else FLINT gives up at, such as exponents beyond its own; it has said so. */
static _Noreturn void memory_abort(void) {
  cli_complain("these numbers are too large to compute with; give smaller ones");
  signals_unlink();
  _exit(CLI_FAILED);
}

void cli_memory_guard(void) {
  mp_set_memory_functions(memory_take, memory_resize, memory_release);
  __flint_set_memory_functions(memory_take, memory_clear, memory_change, free);
  flint_set_abort(memory_abort);
  json_set_alloc_funcs(memory_take, free);
}

/* ---- the time limit ----
 *
 * The time that --timeout gives the whole command, from its first byte read to its last byte written.
 *
 * A thread waits for the end of it and raises a flag, at which the engine and the writers end with the results so
 * far. Work that does not look at the flag (an input that does not come, one huge root) is ended with the process, a
 * grace later, with a line that names the work; the file begun is removed. */

#define LONGEST 1e9 /* about thirty years; longer limits are none */

static double ends = INFINITY, grace;

static volatile int late;

static _Atomic(const char *) current_phase = "starting";

static atomic_int written = -1;

double cli_clock(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static struct timespec deadline_time(double at) {
  return (struct timespec){.tv_sec = (time_t)at, .tv_nsec = (long)(1e9 * (at - floor(at)))};
}

static void deadline_wait(double at) {
  struct timespec t = deadline_time(at);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, NULL) == EINTR) continue;
}

static void deadline_note(void) {
  __atomic_store_n(&late, 1, __ATOMIC_SEQ_CST);
  signals_stop();
}

static void *deadline_raise(void *unused) {
  deadline_wait(ends);
  deadline_note();
  return unused;
}

static void *deadline_watch(void *unused) {
  deadline_raise(unused);
  deadline_wait(ends + grace);
  int status = atomic_load(&written);
  if (status >= 0) _exit(status);
  cli_complain("budget: time limit reached during %s; no result was written (raise --timeout)",
               atomic_load(&current_phase));
  signals_unlink();
  _exit(CLI_BUDGET);
}

void cli_deadline_start(double seconds) {
  pthread_t thread;
  if (!(seconds > 0 && seconds < LONGEST)) return;
  ends = cli_clock() + seconds;
  grace = fmax(0.9, 0.09 * seconds);
  if (signals_spare(&thread, deadline_watch, NULL)) pthread_detach(thread);
  /* A short limit ends before the thread begins, and small work with it. */
  if (cli_clock() >= ends) deadline_note();
}

void cli_deadline_again(void) {
  pthread_t thread;
  if (isfinite(ends) && signals_spare(&thread, deadline_raise, NULL)) pthread_detach(thread);
}

void cli_deadline_phase(const char *what) {
  atomic_store(&current_phase, what);
}

void cli_deadline_written(int status) {
  atomic_store(&written, status);
}

double cli_deadline_left(double share) {
  if (!isfinite(ends)) return 0;
  return fmax(share * (ends - cli_clock()), 0x1p-20);
}

const volatile int *cli_deadline_flag(void) {
  return &late;
}

/* The engine has a clock of its own, which may be read before the thread here wakes up. */
bool cli_deadline_passed(void) {
  return __atomic_load_n(&late, __ATOMIC_SEQ_CST) || cli_clock() >= ends;
}

/* ---- progress ----
 *
 * On standard error: on a terminal a bar that a second thread redraws, else one line per stage; nothing
 * during the first second. */

/* Invariant: phase, stage, known and ended are only touched with the lock held. */
struct cli_progress {
  pthread_mutex_t lock;
  pthread_cond_t wake;
  pthread_t thread;
  bool drawing; /* the thread runs */
  bool ended, known, drawn;
  const char *phase;
  dyd_progress stage;
  double begun, said;
};

/* The share of possible pairs that are legal or ties, in steps of the bar. */
static int bar_share(const dyd_progress *s, int steps) {
  size_t left = s->count[DYD_INDETERMINATE], done = s->count[DYD_LEGAL] + s->count[DYD_TIE];
  if (left + done == 0) return 0;
  return (int)((double)done / (double)(left + done) * steps);
}

static void draw_bar(cli_progress *p) {
  enum { STEPS = 24 };
  char bar[STEPS + 1];
  int full = p->known ? bar_share(&p->stage, STEPS) : 0;
  for (int k = 0; k < STEPS; k++) bar[k] = k < full ? '#' : '.';
  bar[STEPS] = 0;
  fprintf(stderr, "\r\033[K[%s] %.0f s, %s", bar, cli_clock() - p->begun, p->phase);
  if (p->known)
    fprintf(stderr, ", stage %llu, %lld bits, %zu legal, %zu undecided", (unsigned long long)p->stage.stage,
            (long long)p->stage.bits, p->stage.count[DYD_LEGAL], p->stage.count[DYD_INDETERMINATE]);
  fflush(stderr);
  p->drawn = true;
}

static void *redraw_bar(void *user) {
  cli_progress *p = user;
  pthread_mutex_lock(&p->lock);
  while (!p->ended) {
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += 250000000;
    if (until.tv_nsec >= 1000000000) until.tv_sec++, until.tv_nsec -= 1000000000;
    pthread_cond_timedwait(&p->wake, &p->lock, &until);
    if (!p->ended && cli_clock() - p->begun > 1) draw_bar(p);
  }
  pthread_mutex_unlock(&p->lock);
  return NULL;
}

cli_progress *cli_progress_start(bool quiet) {
  cli_progress *p = quiet ? NULL : calloc(1, sizeof *p);
  if (!p) return NULL;
  p->phase = "starting";
  p->begun = p->said = cli_clock();
  pthread_mutex_init(&p->lock, NULL);
  pthread_cond_init(&p->wake, NULL);
  if (isatty(STDERR_FILENO)) p->drawing = signals_spare(&p->thread, redraw_bar, p);
  return p;
}

void cli_progress_phase(cli_progress *p, const char *phase) {
  cli_deadline_phase(phase);
  if (!p) return;
  pthread_mutex_lock(&p->lock);
  p->phase = phase;
  pthread_mutex_unlock(&p->lock);
}

void cli_progress_stage(void *user, const dyd_progress *stage) {
  cli_progress *p = user;
  if (!p) return;
  pthread_mutex_lock(&p->lock);
  p->stage = *stage;
  p->known = true;
  if (!p->drawing && cli_clock() - p->said > 1) {
    p->said = cli_clock();
    fprintf(stderr, "dyadel: stage %llu, %lld bits: %zu legal, %zu undecided, %.1f s\n",
            (unsigned long long)stage->stage, (long long)stage->bits, stage->count[DYD_LEGAL],
            stage->count[DYD_INDETERMINATE], stage->seconds);
  }
  pthread_mutex_unlock(&p->lock);
}

void cli_progress_stop(cli_progress *p) {
  if (!p) return;
  pthread_mutex_lock(&p->lock);
  p->ended = true;
  pthread_cond_signal(&p->wake);
  pthread_mutex_unlock(&p->lock);
  if (p->drawing) pthread_join(p->thread, NULL);
  if (p->drawn) fputs("\r\033[K", stderr);
  pthread_cond_destroy(&p->wake);
  pthread_mutex_destroy(&p->lock);
  free(p);
}
