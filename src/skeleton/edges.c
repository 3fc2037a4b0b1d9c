/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Facts about the edges of a skeleton. */
#include "skeleton/skeleton.h"

dyd_half_edge dyd_find_edge(const dyd_skeleton *sk, uint32_t v, uint32_t w) {
  dyd_half_edge first = sk->leaving[v], h = first;
  if (first == DYD_NONE) return DYD_NONE;
  do {
    if (dyd_edge_target(&sk->mesh, h) == w) return h;
    h = dyd_edge_turn(&sk->mesh, h);
  } while (h != first);
  return DYD_NONE;
}

bool dyd_is_legal(const dyd_skeleton *sk, uint32_t v, uint32_t w) {
  dyd_half_edge h = dyd_find_edge(sk, v, w);
  return h != DYD_NONE && dyd_edge_is_certain(sk, h);
}

uint64_t dyd_certain_corners(const dyd_skeleton *sk) {
  const dyd_mesh *m = &sk->mesh;
  uint64_t corners = 0;
  dyd_half_edge first = dyd_hull_first(m), h = first;
  if (first == DYD_NONE) return 0;
  do {
    corners += dyd_edge_is_certain(sk, dyd_edge_prev(h));
    h = dyd_hull_following(m, h);
  } while (h != first);
  return corners;
}

/* Bits of certain[] are halves of edges. */
uint64_t dyd_certain_edges(const dyd_skeleton *sk) {
  const dyd_mesh *m = &sk->mesh;
  uint64_t halves = 0;
  for (uint32_t t = 0; t < m->count; t++)
    halves += (sk->certain[t] & 1u) + (sk->certain[t] >> 1 & 1u) + (sk->certain[t] >> 2 & 1u);
  return halves / 2 - dyd_certain_corners(sk);
}

static bool is_listed(const uint32_t *list, int count, uint32_t v) {
  for (int k = 0; k < count; k++)
    if (list[k] == v) return true;
  return false;
}

int dyd_neighbours(uint32_t *out, int room, const dyd_skeleton *sk, uint32_t i, uint32_t j) {
  const dyd_mesh *m = &sk->mesh;
  int count = 0, before;
  for (int k = 0; k < 2; k++) {
    dyd_half_edge first = sk->leaving[k ? j : i], h = first;
    before = count;
    if (first == DYD_NONE) continue;
    do {
      uint32_t v = dyd_edge_target(m, h);
      if (v != m->n && v != i && v != j && count < room && !is_listed(out, before, v)) out[count++] = v;
      h = dyd_edge_turn(m, h);
    } while (h != first);
  }
  return count;
}
