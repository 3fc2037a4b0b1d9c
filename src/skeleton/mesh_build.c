/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Building a skeleton: its coordinates, then its strips or all vertices. */
#include "skeleton/mesh_build.h"

#include "skeleton/insert.h"
#include "skeleton/join.h"
#include "skeleton/mesh_start.h"

static dyd_status mesh_init(dyd_mesh *m, dyd_reps *reps, const uint32_t *local, uint32_t n, bool no_filter) {
  *m = (dyd_mesh){.reps = reps, .local = local, .n = n, .end = n, .strips = {1, {0, n}}, .no_filter = no_filter};
  return dyd_mesh_coordinates(m);
}

dyd_status dyd_mesh_build(dyd_mesh *m, dyd_reps *reps, const uint32_t *local, uint32_t n, bool no_filter,
                          const volatile int *cancel) {
  dyd_status st = mesh_init(m, reps, local, n, no_filter);
  if (st == DYD_OK) st = dyd_mesh_fill(m, cancel);
  if (st != DYD_OK) dyd_mesh_clear(m);
  return st;
}

dyd_status dyd_mesh_build_strips(dyd_mesh *m, dyd_reps *reps, const dyd_strips *strips, bool no_filter,
                                 const volatile int *cancel, unsigned threads) {
  bool joined = false;
  dyd_status st = mesh_init(m, reps, NULL, reps->n, no_filter);
  if (st == DYD_OK && dyd_strips_are_apart(reps, strips))
    st = dyd_mesh_join_strips(&joined, m, strips, cancel, threads);
  if (st == DYD_OK && !joined) st = dyd_mesh_fill(m, cancel);
  if (st != DYD_OK) dyd_mesh_clear(m);
  return st;
}
