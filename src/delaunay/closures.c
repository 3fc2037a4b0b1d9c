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

/* Least number of triangles of a face that can be postponed; in the armed build small faces are, too. */
#ifdef DYD_ARMED
enum { MANY = 16 };
#else
enum { MANY = 64 };
#endif

/* Returns true if all corners of many triangles are points or can be narrowed. Not all are points: no cover walk is
 * needed for those. */
static bool face_is_postponed(const dyd_delaunay *pd, const dyd_face *face) {
  const dyd_delaunay_options *o = &pd->options;
  bool any = false;
  if (!o->narrows || face->tris < MANY) return false;
  for (uint32_t q = 0; q < face->tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t v = pd->sk.mesh.tri[pd->open.tri[face->first_tri + q]].v[k];
      if (v == pd->sk.mesh.n || dyd_vertex_is_point(&pd->sk, v)) continue;
      if (!o->narrows(o->narrows_user, pd->sk.reps.site[v])) return false;
      any = true;
    }
  return any;
}

dyd_status dyd_closures_run_one(dyd_closure *out, const dyd_delaunay *pd, dyd_work *w, const dyd_face *face,
                                size_t room) {
  return dyd_closure_run(out, w, &pd->sk, pd->open.tri + face->first_tri, face->tris, room,
                         face_is_postponed(pd, face));
}

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
    if (w->keep_cut || !dyd_work_cancelled(w)) st = dyd_closures_run_one(&b->out[k], b->pd, w, f, b->room);
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
