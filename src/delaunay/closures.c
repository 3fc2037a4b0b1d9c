/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One task for each range of faces. */
#include "delaunay/closures.h"

#include "base/parallel.h"
#include "delaunay/view.h"

typedef struct batch {
  dyd_closure *out;
  dyd_delaunay *pd;
  const dyd_face *face;
  size_t count, room;
  dyd_status status[DYD_RANGES_MOST];
  dyd_delaunay_counters counters[DYD_RANGES_MOST];
} batch;

/* Closures from begin on; those after a failure stay empty. */
static dyd_status run_faces(const batch *b, dyd_delaunay *pd, dyd_work *w, size_t begin, size_t end) {
  dyd_status st = DYD_OK;
  for (size_t k = begin; k < end && st == DYD_OK; k++) {
    const dyd_face *f = &b->face[k];
    st = dyd_cancelled(pd) ? DYD_CANCELLED
                           : dyd_closure_run(&b->out[k], pd, w, pd->faces.tri + f->first_tri, f->tris, b->room);
    pd->counters.faces++;
  }
  return st;
}

static void run_range(void *context, size_t number) {
  batch *b = context;
  dyd_delaunay view;
  dyd_work w;
  dyd_view_open(&view, b->pd);
  dyd_work_init(&w, &view);
  b->status[number] = run_faces(b, &view, &w, dyd_range_begin(b->count, number), dyd_range_begin(b->count, number + 1));
  dyd_work_clear(&w);
  dyd_view_close(&b->counters[number], &view);
}

static dyd_status run_ranges(batch *b) {
  dyd_status st = DYD_OK;
  dyd_view_prepare(b->pd);
  dyd_parallel(b->pd->options.threads, dyd_ranges(b->count), run_range, b);
  for (size_t r = 0; r < dyd_ranges(b->count); r++) {
    if (st == DYD_OK) st = b->status[r];
    dyd_counters_add(&b->pd->counters, &b->counters[r]);
  }
  return st;
}

dyd_status dyd_closures_run(dyd_closure *out, dyd_delaunay *pd, dyd_work *w, const dyd_face *face, size_t count,
                            size_t room) {
  batch b = {.out = out, .pd = pd, .face = face, .count = count, .room = room};
  memset(out, 0, count * sizeof *out);
  dyd_status st = dyd_ranges(count) > 1 ? run_ranges(&b) : run_faces(&b, pd, w, 0, count);
  for (size_t k = 0; k < count && st != DYD_OK; k++) dyd_closure_clear(&out[k]);
  return st;
}
