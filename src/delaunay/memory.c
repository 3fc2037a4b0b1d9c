/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Memory for what is made of a result. */
#include "delaunay/memory.h"

#include "base/error.h"
#include "delaunay/state.h"

dyd_room dyd_delaunay_room(const dyd_delaunay *pd) {
  uint64_t most = pd->options.max_bytes;
  return (dyd_room){.most = most, .held = most ? dyd_delaunay_memory(pd) : 0};
}

void dyd_delaunay_allow(dyd_delaunay *pd, uint64_t max_bytes) {
  pd->options.max_bytes = max_bytes;
}

bool dyd_delaunay_is_bounded(const dyd_delaunay *pd) {
  return pd->options.max_bytes != 0;
}

dyd_status dyd_delaunay_grant(const dyd_delaunay *pd, uint64_t bytes, const char *what, dyd_error *err) {
  dyd_room room = dyd_delaunay_room(pd);
  return dyd_room_has(&room, bytes, what) ? DYD_OK : dyd_fail_room(err, &room);
}

dyd_pair_status dyd_least_bounding(const dyd_delaunay *pd) {
  return pd->sk.all_points ? DYD_INDETERMINATE : DYD_TIE;
}

uint64_t dyd_pairs_bytes(const dyd_delaunay *pd, dyd_pair_status least) {
  size_t count[4];
  dyd_delaunay_count(count, pd);
  return dyd_bytes_times(count[DYD_LEGAL] + (least <= DYD_INDETERMINATE ? count[DYD_INDETERMINATE] : 0) +
                             (least <= DYD_TIE ? count[DYD_TIE] : 0),
                         sizeof(dyd_pair));
}

/* Sorted with their numbers in the mesh, then listed. */
uint64_t dyd_triangles_bytes(const dyd_delaunay *pd) {
  return dyd_bytes_times(pd->sk.mesh.count, 2 * sizeof(dyd_triangle) + sizeof(uint32_t)) +
         dyd_bytes_times((uint64_t)pd->sk.n + 1, sizeof(uint32_t));
}
