/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Invariants of the table of undecided faces: faces.h, state.h. */
#include "delaunay/table.h"

#include "delaunay/faces.h"
#include "delaunay/harness.h"

#include <stdlib.h>

typedef struct sums {
  size_t tris, pairs, others, capped;
} sums;

/* Its triangles are marked, not decided, and at the ghost if it is outer. */
static bool face_has_its_triangles(char *message, const dyd_delaunay *pd, size_t f) {
  const dyd_face *face = &pd->open.face[f];
  bool outer = false;
  for (uint32_t q = 0; q < face->tris; q++) {
    uint32_t t = pd->open.tri[face->first_tri + q];
    if (pd->open.of[t] != f) return wrong(message, "triangle %u is of face %zu, but marked otherwise", t, f);
    if (dyd_triangle_is_certain(&pd->sk, t)) return wrong(message, "face %zu has a triangle that is decided", f);
    outer = outer || dyd_is_ghost_triangle(&pd->sk.mesh, t);
  }
  return face->outer == outer || wrong(message, "face %zu says wrongly whether it is outer", f);
}

/* Its pairs ascend, also in their second order, and those hidden are counted. */
static bool face_has_its_pairs(char *message, const dyd_delaunay *pd, size_t f) {
  const dyd_face *face = &pd->open.face[f];
  const dyd_vertex_pair *p = pd->open.pair + face->first_pair;
  const uint32_t *turned = pd->open.turned + face->first_pair;
  uint32_t hidden = 0;
  for (uint32_t q = 0; q < face->pairs; q++) {
    hidden += p[q].hidden;
    if (q && dyd_compare_vertex_pair(&p[q - 1], &p[q]) >= 0) return wrong(message, "pairs of face %zu descend", f);
    if (q == 0 || face->pairs <= DYD_FEW_PAIRS) continue;
    const dyd_vertex_pair *a = &p[turned[q - 1]], *b = &p[turned[q]];
    if (a->j > b->j || (a->j == b->j && a->i >= b->i)) return wrong(message, "turned pairs of face %zu descend", f);
  }
  return face->hidden == hidden || wrong(message, "face %zu hides %u pairs, not %u", f, hidden, face->hidden);
}

/* Each pair that is listed is shown once. */
static bool pairs_are_shown_once(char *message, const dyd_delaunay *pd, size_t pairs) {
  dyd_vertex_pair *all = malloc((pairs + 1) * sizeof *all);
  size_t count = 0;
  bool good = all;
  for (size_t f = 0; f < pd->open.count; f++)
    for (uint32_t q = 0; q < pd->open.face[f].pairs; q++) all[count++] = pd->open.pair[pd->open.face[f].first_pair + q];
  qsort(all, count, sizeof *all, dyd_compare_vertex_pair);
  for (size_t q = 0, end; q < count && good; q = end) {
    size_t shown = 0;
    for (end = q; end < count && dyd_compare_vertex_pair(&all[q], &all[end]) == 0; end++) shown += !all[end].hidden;
    if (shown != 1) good = wrong(message, "pair %u %u is shown %zu times", all[q].i, (uint32_t)all[q].j, shown);
  }
  free(all);
  return good;
}

static bool triangles_are_marked(char *message, const dyd_delaunay *pd, size_t tris) {
  size_t marked = 0;
  for (uint32_t t = 0; t < pd->sk.mesh.count; t++) {
    marked += pd->open.of[t] != DYD_NONE;
    if (pd->open.of[t] == DYD_NONE && !dyd_triangle_is_certain(&pd->sk, t))
      return wrong(message, "triangle %u is not decided and in no face", t);
  }
  return marked == tris || wrong(message, "%zu triangles are marked, %zu listed", marked, tris);
}

bool table_is_right(char *message, const dyd_delaunay *pd) {
  const dyd_undecided *f = &pd->open;
  sums is = {0};
  if (f->kind != DYD_LISTED || !f->of) return true;
  for (size_t g = 0; g < f->count; g++) {
    const dyd_face *face = &f->face[g];
    is.tris += face->tris;
    is.pairs += face->pairs;
    is.others += !face->polygon;
    is.capped += face->capped;
    if (!face_has_its_triangles(message, pd, g) || !face_has_its_pairs(message, pd, g)) return false;
  }
  if (is.tris != f->live_tris || is.pairs != f->live_pairs || is.others != f->others || is.capped != f->capped)
    return wrong(message, "sums over the faces: %zu triangles, %zu pairs, %zu others, %zu capped; %zu, %zu, %zu, %zu",
                 is.tris, is.pairs, is.others, is.capped, f->live_tris, f->live_pairs, f->others, f->capped);
  return triangles_are_marked(message, pd, is.tris) && pairs_are_shown_once(message, pd, is.pairs);
}
