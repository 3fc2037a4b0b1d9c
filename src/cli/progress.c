/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Progress on standard error: on a terminal a bar that a second thread redraws, else one line per stage; nothing
 * during the first second. */
#include "cli.h"
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

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
  if (isatty(STDERR_FILENO)) p->drawing = cli_signals_spare(&p->thread, redraw_bar, p);
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
