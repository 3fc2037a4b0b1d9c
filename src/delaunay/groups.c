/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Ties as groups: the sites of one circle, in its order, or of one line of the hull. */
#include "base/alloc.h"
#include "delaunay/proved.h"
#include "delaunay/undecided.h"

typedef struct group_list {
  uint32_t *site;
  size_t count, cap;
  bool chain;
} group_list;

static dyd_status group_add(group_list *g, uint32_t site) {
  if (!dyd_reserve((void **)&g->site, &g->cap, g->count + 1, sizeof *g->site)) return DYD_E_NOMEM;
  g->site[g->count++] = site;
  return DYD_OK;
}

/* Around the rim from h on; a chain begins behind the ghost. */
static dyd_status group_walk(group_list *g, const dyd_delaunay *pd, dyd_half_edge h) {
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_half_edge first = h;
  dyd_status st = DYD_OK;
  do {
    g->chain = dyd_edge_origin(m, h) == m->n;
    if (!g->chain) h = dyd_tie_next(&pd->sk, h);
  } while (!g->chain && h != first);
  first = h;
  do {
    uint32_t v = dyd_edge_origin(m, h);
    if (v != m->n) st = group_add(g, pd->sk.reps.site[v]);
    h = dyd_tie_next(&pd->sk, h);
  } while (st == DYD_OK && h != first);
  return st;
}

static dyd_status group_of_line(group_list *g, const dyd_line *l, const uint32_t *site) {
  dyd_status st = DYD_OK;
  g->chain = true;
  for (uint32_t q = 0; q < l->count && st == DYD_OK; q++) st = group_add(g, site[l->order[q]]);
  return st;
}

/* Where to walk around tied face f; DYD_NONE where its rim is not one cycle. */
static dyd_half_edge group_start(const dyd_delaunay *pd, size_t f) {
  bool chain;
  return pd->open.kind == DYD_TIED ? dyd_tie_start(pd, f) : dyd_rim_start(&chain, pd, &pd->open.face[f]);
}

/* Visits the pairs of a face whose rim is not one cycle, one by one. */
static dyd_status visit_pairs_of_face(const dyd_delaunay *pd, size_t f, dyd_group_fn visit, void *user) {
  dyd_pair_list pairs = {0};
  dyd_status st = dyd_delaunay_face_pairs(&pairs, pd, f);
  for (size_t k = 0; k < pairs.count && st == DYD_OK; k++)
    st = visit(user, DYD_GROUP_PAIR, &(dyd_index_list){2, (uint32_t[]){pairs.item[k].i, pairs.item[k].j}});
  dyd_pair_list_clear(&pairs);
  return st;
}

dyd_status dyd_delaunay_each_group(const dyd_delaunay *pd, dyd_group_fn visit, void *user) {
  if (!pd) return DYD_E_ARG;
  group_list g = {0};
  dyd_status st = DYD_OK;
  bool line = pd->open.kind == DYD_LINE, all = false; /* a chain of all sites has a face on each side */
  for (size_t f = 0; f < pd->open.count && st == DYD_OK; f++) {
    if (dyd_open_status_of(pd, f) != DYD_TIE) continue;
    dyd_half_edge start = line ? 0 : group_start(pd, f);
    if (start == DYD_NONE) {
      st = visit_pairs_of_face(pd, f, visit, user);
      continue;
    }
    g.count = 0;
    st = line ? group_of_line(&g, &pd->sk.line, pd->sk.reps.site) : group_walk(&g, pd, start);
    bool again = all;
    all = all || (g.chain && 2 * g.count == (size_t)pd->sk.mesh.count + 2);
    const dyd_index_list sites = {g.count, g.site};
    if (st == DYD_OK && !again) st = visit(user, g.chain ? DYD_GROUP_CHAIN : DYD_GROUP_CIRCLE, &sites);
  }
  free(g.site);
  return st;
}
