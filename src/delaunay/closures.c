/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One task for each range of faces. */
#include "delaunay/closures.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "skeleton/work.h"

#include <string.h>

typedef struct batch {
  dyd_closure *out;
  const dyd_delaunay *pd;
  size_t first, count, room;
  dyd_status status[DYD_RANGES_MOST];
  dyd_work *work;
} batch;

/* Closures of one range; those after a failure stay empty. */
static void close_range(void *context, size_t number) {
  batch *b = context;
  dyd_work *w = &b->work[number];
  dyd_status st = DYD_OK;
  size_t end = dyd_range_begin(b->count, number + 1);
  for (size_t k = dyd_range_begin(b->count, number); k < end && st == DYD_OK; k++) {
    const dyd_face *f = &b->pd->open.face[b->first + k];
    if (f->proved) continue;
    st = DYD_CANCELLED;
    if (w->keep_cut || !dyd_work_cancelled(w))
      st = dyd_closure_run(&b->out[k], w, &b->pd->sk, b->pd->open.tri + f->first_tri, f->tris, b->room);
    w->counters.faces++;
  }
  b->status[number] = st;
}

dyd_status dyd_closures_run(dyd_closure *out, const dyd_delaunay *pd, dyd_work *w, size_t first, size_t count,
                            size_t room) {
  batch b = {.out = out, .pd = pd, .first = first, .count = count, .room = room};
  size_t ranges = dyd_ranges(count);
  dyd_status st = DYD_OK;
  bool alone = ranges == 1; /* then w itself serves, with its scratch */
  b.work = alone ? w : dyd_alloc(ranges, sizeof *b.work);
  if (!b.work) return DYD_E_NOMEM;
  memset(out, 0, count * sizeof *out);
  for (size_t r = 0; r < ranges && !alone; r++) {
    dyd_work_fork(&b.work[r], w, &pd->sk);
    dyd_room_share(&b.work[r].room, w->threads);
  }
  dyd_parallel(w->threads, ranges, close_range, &b);
  for (size_t r = 0; r < ranges; r++) {
    if (st == DYD_OK) st = b.status[r];
    if (!alone) dyd_work_join(w, &b.work[r]);
  }
  if (!alone) free(b.work);
  for (size_t k = 0; k < count && st != DYD_OK; k++) dyd_closure_clear(&out[k]);
  return st;
}
