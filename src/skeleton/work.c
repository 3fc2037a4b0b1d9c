/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The life of a work. */
#include "skeleton/work.h"

#include "skeleton/predicates.h"

void dyd_work_init(dyd_work *w, const dyd_skeleton *sk, const dyd_run *run) {
  static const dyd_run alone = {.threads = 1};
  *w = (dyd_work){.run = run ? run : &alone, .rects = &sk->rects};
  dyd_scale_set_init(&w->set, &sk->rects);
  dyd_icircle_init(&w->here);
  for (int k = 0; k < DYD_CIRCLES; k++) dyd_icircle_init(&w->next[k]);
  mpz_inits(w->u[0], w->u[1], w->h, w->s, w->t, NULL);
}

void dyd_work_clear(dyd_work *w) {
  mpz_clears(w->u[0], w->u[1], w->h, w->s, w->t, NULL);
  for (int k = 0; k < DYD_CIRCLES; k++) dyd_icircle_clear(&w->next[k]);
  dyd_icircle_clear(&w->here);
  dyd_scale_set_clear(&w->set);
}

void dyd_work_fork(dyd_work *task, const dyd_work *w, const dyd_skeleton *sk) {
  dyd_work_init(task, sk, w->run);
  task->room = w->room;
}

static void add_counters(dyd_delaunay_counters *sum, const dyd_delaunay_counters *c) {
  sum->filter += c->filter;
  sum->integer += c->integer;
  sum->exact += c->exact;
  sum->witness_guess += c->witness_guess;
  sum->witness_search += c->witness_search;
  sum->cover_walks += c->cover_walks;
  sum->faces += c->faces;
}

void dyd_work_join(dyd_work *w, dyd_work *task) {
  w->tally.asked += task->tally.asked;
  w->tally.integer += task->tally.integer;
  w->tally.exact += task->tally.exact;
  w->tally.ties += task->tally.ties;
  add_counters(&w->counters, &task->counters);
  dyd_room_join(&w->room, &task->room);
  dyd_work_clear(task);
}

void dyd_work_count(dyd_delaunay_counters *sum, const dyd_work *w, const dyd_skeleton *sk) {
  add_counters(sum, &w->counters);
  dyd_tally_add(sum, &w->tally, sk->mesh.no_filter);
}
