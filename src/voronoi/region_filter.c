/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Boxes round the undecided part of the diagram that belongs to an undecided face, by bisection in doubles [REGION-1].
 *
 * A point c is in Pos_i n Pos_j only if max(ds_i, ds_j)(c) <= dl_k(c) for all k. A box of centres is dropped when for
 * some k of the face, by the bounds of [FLT-DST] over the whole box, dl_k < ds_i or dl_k < ds_j. What is left after
 * bisection to a fixed depth is enclosed, and the enclosure bisected again while that pays. Every vertex of the
 * diagram, for any choice, that is no vertex of a sure triangle is the circumcentre of a triangle of some face with
 * an edge that is not legal, so it lies in Pos_i n Pos_j for such a pair ij. */
#include "voronoi/region.h"

enum { DEPTH = 5, ROUNDS = 24, FACE_SITES = 48 };

typedef struct search {
  const dyd_bbox *i, *j;
  const dyd_bbox *other;
  size_t others;
  dyd_bbox found;
  bool any;
} search;

static bool region_is_excluded(const search *s, const dyd_bbox *c) {
  double di = dyd_ds2_lower(c, s->i), dj = dyd_ds2_lower(c, s->j), least = dyd_max(di, dj);
  for (size_t k = 0; k < s->others; k++)
    if (dyd_dl2_upper(c, &s->other[k]) < least) return true;
  return false;
}

static bool box_is_within(const dyd_bbox *a, const dyd_bbox *b) {
  return b->e[0] <= a->e[0] && a->e[1] <= b->e[1] && b->e[2] <= a->e[2] && a->e[3] <= b->e[3];
}

static void grow_box(dyd_bbox *out, bool *any, const dyd_bbox *c) {
  if (!*any) *out = *c;
  *any = true;
  for (int k = 0; k < 4; k += 2) {
    out->e[k] = dyd_min(out->e[k], c->e[k]);
    out->e[k + 1] = dyd_max(out->e[k + 1], c->e[k + 1]);
  }
}

/* Bisects both sides, depth first; boxes inside the enclosure found so far add nothing. */
static void region_bisect(search *s, const dyd_bbox *c, int depth) {
  if ((s->any && box_is_within(c, &s->found)) || region_is_excluded(s, c)) return;
  if (depth == 0) {
    grow_box(&s->found, &s->any, c);
    return;
  }
  double x = c->e[0] / 2 + c->e[1] / 2, y = c->e[2] / 2 + c->e[3] / 2;
  for (int q = 0; q < 4; q++) {
    dyd_bbox part = {{q & 1 ? x : c->e[0], q & 1 ? c->e[1] : x, q & 2 ? y : c->e[2], q & 2 ? c->e[3] : y}};
    region_bisect(s, &part, depth - 1);
  }
}

static double size_of_box(const dyd_bbox *c) {
  return (c->e[1] - c->e[0]) + (c->e[3] - c->e[2]);
}

/* false: the pair has no point in *c. */
static bool region_shrink(dyd_bbox *c, search *s) {
  for (int round = 0; round < ROUNDS; round++) {
    s->any = false;
    region_bisect(s, c, DEPTH);
    if (!s->any) return false;
    bool pays = size_of_box(&s->found) < 0.75 * size_of_box(c);
    *c = s->found;
    if (!pays) break;
  }
  return true;
}

static dyd_bbox box_of_site(const dyd_delaunay *pd, uint32_t site) {
  dyd_bbox b;
  dyd_sites_get_d(b.e, pd->sk.rects.sites, site);
  return b;
}

bool dyd_filter_region(dyd_bbox *box, const dyd_delaunay *pd, const dyd_pair_list *pairs, const dyd_index_list *sites) {
  dyd_bbox other[FACE_SITES], all = *box;
  bool any = false;
  size_t step = sites->count / FACE_SITES + 1, others = 0; /* leaving sites out only makes the box larger */
  for (size_t k = 0; k < sites->count; k += step) other[others++] = box_of_site(pd, sites->item[k]);
  for (size_t k = 0; k < pairs->count; k++) {
    dyd_bbox i = box_of_site(pd, pairs->item[k].i), j = box_of_site(pd, pairs->item[k].j), c = *box;
    search s = {.i = &i, .j = &j, .other = other, .others = others};
    if (any && box_is_within(&c, &all)) break;
    if (region_shrink(&c, &s)) grow_box(&all, &any, &c);
  }
  *box = all;
  return any;
}
