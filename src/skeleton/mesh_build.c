/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Building a skeleton: its coordinates, then its strips or all vertices. */
#include "skeleton/mesh_build.h"

#include "base/alloc.h"
#include "skeleton/insert.h"
#include "skeleton/join.h"
#include "skeleton/mesh_start.h"

static dyd_status mesh_init(dyd_mesh *m, dyd_reps *reps, const uint32_t *local, uint32_t n, bool no_filter) {
  *m = (dyd_mesh){.reps = reps, .local = local, .n = n, .end = n, .strips = {1, {0, n}}, .no_filter = no_filter};
  return dyd_mesh_coordinates(m);
}

/* Sites joined with a lower one are aliases from the start. */
static dyd_status mesh_put_joined(dyd_mesh *m) {
  const dyd_sites *sites = m->reps->sites;
  uint32_t *vertex = dyd_alloc(m->n, sizeof *vertex);
  dyd_status st = vertex ? DYD_OK : DYD_E_NOMEM;
  for (uint32_t v = 0; v < m->n && vertex; v++) vertex[m->reps->site[v]] = v;
  for (uint32_t v = 0; v < m->n && st == DYD_OK; v++) {
    uint32_t of = vertex[dyd_sites_joined(sites, m->reps->site[v])];
    if (of != v) st = dyd_mesh_set_alias(m, v, of);
  }
  free(vertex);
  return st;
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
  if (st == DYD_OK && reps->sites->joins)
    st = mesh_put_joined(m);
  else if (st == DYD_OK && dyd_strips_are_apart(reps, strips))
    st = dyd_mesh_join_strips(&joined, m, strips, cancel, threads);
  if (st == DYD_OK && !joined) st = dyd_mesh_fill(m, cancel);
  if (st != DYD_OK) dyd_mesh_clear(m);
  return st;
}
