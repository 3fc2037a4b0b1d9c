/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From sites to statuses: skeleton, certain edges, undecided faces. */
#include "delaunay/build.h"

#include "base/error.h"
#include "delaunay/face_table.h"
#include "delaunay/faces.h"
#include "delaunay/proved.h"
#include "delaunay/ties.h"
#include "legal/certify.h"
#include "skeleton/mesh_start.h"
#include "skeleton/predicates.h"

void dyd_build_clear(dyd_delaunay *pd) {
  dyd_table_clear(&pd->open);
  dyd_skeleton_clear(&pd->sk);
}

static void mark_known(dyd_skeleton *sk, dyd_known known) {
  for (size_t q = 0; q < known.count; q++) {
    uint32_t v = sk->vertex[known.pair[q].i], w = sk->vertex[known.pair[q].j];
    dyd_half_edge h = v == w ? DYD_NONE : dyd_find_edge(sk, v, w);
    if (h != DYD_NONE) dyd_set_certain(sk, h, true);
  }
}

/* All pairs of a line are possible: they count as one face. Ties are one group, which the cap does not count. */
static void line_find(dyd_delaunay *pd, dyd_error *err) {
  const dyd_line *l = &pd->sk.line;
  size_t open = dyd_line_open_pairs(l);
  pd->open.count = open > 0;
  pd->open.capped = !pd->line_tie && open > pd->max_pairs;
  if (pd->open.capped)
    dyd_fail(err, DYD_CAPPED,
             "%zu collinear sites (%u, %u, ...) have %zu possible pairs, more than the cap of %zu; raise the cap on "
             "pairs",
             (size_t)l->count, pd->sk.reps.site[l->order[0]], pd->sk.reps.site[l->order[1]], open, pd->max_pairs);
}

static dyd_status build_statuses(dyd_delaunay *pd, dyd_work *w, dyd_known known) {
  if (pd->open.kind == DYD_LINE) {
    dyd_status proved = dyd_prove_line(pd, w);
    if (proved == DYD_OK) line_find(pd, w->err);
    return proved;
  }
  bool tied = pd->open.kind == DYD_TIED;
  dyd_status st = tied ? dyd_certify_points(&pd->sk, w) : dyd_certify_all(&pd->sk, w);
  mark_known(&pd->sk, known);
  if (st != DYD_OK) return st;
  return tied ? dyd_ties_find(pd, w) : dyd_faces_find(pd, w, NULL, 0);
}

dyd_status dyd_build(dyd_delaunay *pd, const dyd_sites *sites, dyd_known known, dyd_error *err) {
  const dyd_skeleton_options o = {pd->options.no_filter, pd->options.threads, pd->options.cancel};
  if (!dyd_room_has(&pd->room, dyd_skeleton_bytes(sites), "the triangulation")) return DYD_E_NOMEM;
  dyd_status st = dyd_skeleton_build(&pd->sk, sites, &o);
  if (st != DYD_OK) return st;
  pd->joins = sites->joins;
  dyd_work w;
  dyd_work_init(&w, &pd->sk, o.cancel);
  w.threads = o.threads;
  w.err = err;
  w.keep_cut = pd->options.keep_cut;
  w.room = pd->room;
  pd->open.kind = pd->sk.mesh.collinear ? DYD_LINE : pd->sk.all_points ? DYD_TIED : DYD_LISTED;
  st = build_statuses(pd, &w, known);
  dyd_tally_add(&pd->counters, &pd->sk.mesh.tally, o.no_filter);
  dyd_work_count(&pd->counters, &w, &pd->sk);
  dyd_room_join(&pd->room, &w.room);
  dyd_work_clear(&w);
  if (st != DYD_OK)
    dyd_build_clear(pd);
  else
    dyd_mesh_trim(&pd->sk.mesh);
  return st;
}
