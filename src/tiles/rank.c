/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A rank: its begin and end, the order of its steps, and mail within one process. */
#include "tiles/tiles.h"

#include <stdlib.h>

dyd_status tile_new(tile *t, const tiles_job *job, size_t rank, dyd_error *err) {
  const unsigned dim = job->boxes ? 4 : 2;
  *t = (tile){.job = job, .rank = rank, .own.dim = dim, .ghosts.dim = dim, .fringe.dim = dim};
  t->in = calloc(job->ranks, sizeof *t->in);
  t->out = calloc(job->ranks, sizeof *t->out);
  t->info = calloc(job->ranks, sizeof *t->info);
  t->sent = calloc(job->ranks, sizeof *t->sent);
  return t->in && t->out && t->info && t->sent ? DYD_OK : tiles_no_memory(err);
}

void tile_free(tile *t) {
  for (size_t r = 0; r < t->job->ranks; r++) {
    if (t->in) tiles_mail_clear(&t->in[r]);
    if (t->out) tiles_mail_clear(&t->out[r]);
    if (t->sent) tiles_set_clear(&t->sent[r]);
  }
  dyd_free_all(t->in, t->out, t->info, t->sent);
  tiles_sites_clear(&t->own);
  tiles_sites_clear(&t->ghosts);
  tiles_sites_clear(&t->fringe);
  tiles_tree_clear(&t->tree);
  tiles_graph_clear(&t->graph);
  tiles_reach_clear(&t->reach);
  tiles_search_clear(&t->search);
  dyd_engine_free(t->engine);
  dyd_free_all(t->alias, t->mark, t->late, t->rows.item, t->aliases.item);
  if (t->spool) fclose(t->spool);
  if (t->parked) fclose(t->parked);
}

/* ---- the order of steps, and mail within one process ---- */

static dyd_status carry_in_memory(tile *member, size_t count, dyd_error *err) {
  (void)err;
  for (size_t from = 0; from < count; from++)
    for (size_t to = 0; to < count; to++) {
      tiles_mail *mail = &member[from].out[to];
      if (from != to) member[from].counters.sent += mail->count;
      tiles_mail_clear(&member[to].in[from]);
      member[to].in[from] = *mail;
      *mail = (tiles_mail){0};
    }
  return DYD_OK;
}

static bool any_in_memory(bool here) {
  return here;
}

const tiles_carrier tiles_in_memory = {carry_in_memory, any_in_memory};

typedef dyd_status step_fn(tile *t, dyd_error *err);

typedef struct step_crew {
  tile *member;
  size_t count;
  const tiles_carrier *by;
  bool elsewhere;
  dyd_error *err;
} step_crew;

/* One step of all; false: a rank failed. */
static bool step_all(dyd_status *st, step_crew *c, step_fn *step) {
  for (size_t k = 0; *st == DYD_OK && k < c->count; k++) *st = step(&c->member[k], c->err);
  if (c->by->any(*st != DYD_OK)) {
    c->elsewhere = *st == DYD_OK;
    return false;
  }
  *st = c->by->carry(c->member, c->count, c->err);
  return *st == DYD_OK;
}

static bool anybody_asks(const step_crew *c) {
  bool here = false;
  for (size_t k = 0; k < c->count; k++) here |= c->member[k].asked > 0;
  return c->by->any(here);
}

dyd_status tiles_drive(tile *member, size_t count, const tiles_carrier *by, bool *elsewhere, dyd_error *err) {
  static step_fn *const begin[] = {tile_survey, tile_read, tile_split, tile_own, tile_halo, tile_first};
  step_crew c = {member, count, by, false, err};
  dyd_status st = DYD_OK;
  bool on = true;
  for (size_t k = 0; on && k < sizeof begin / sizeof *begin; k++) on = step_all(&st, &c, begin[k]);
  while (on && anybody_asks(&c)) on = step_all(&st, &c, tile_answer) && step_all(&st, &c, tile_extend);
  if (on && step_all(&st, &c, tile_report)) {
    if (member[0].rank == 0) st = tile_write_manifest(&member[0], err);
    c.elsewhere = by->any(st != DYD_OK) && st == DYD_OK;
  }
  *elsewhere = c.elsewhere;
  return st;
}
