/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which sites are possibly nearest to a point, or to a point of a rectangle (mathematics: section 2).
 *
 * i is possibly nearest to c iff ds_i(c) <= min_k dl_k(c), that is c is in Pos_i. If only i is listed for the rectangle
 * q, every point of q is in no other Pos_k, so i is surely nearest everywhere: q is inside Int_i; the converse is plain
 * [NEAR-1]. Only sites that are possibly nearest to some point of q matter, as candidates and as blockers: the site of
 * least dl at a point is one of them. If q does not meet R_i and meets Pos_i, it does on its boundary: Pos_i holds with
 * c the segment to the point of R_i nearest to c, which leaves q through a side beyond which that point lies [NEAR-2].
 */
#include <dyadel/voronoi.h>

#include "base/alloc.h"
#include "voronoi/nearest.h"

#include <string.h>

/* A query: candidates as vertices, and as rational rectangles. */
typedef struct query {
  const dyd_delaunay *pd;
  uint32_t *vertex;
  size_t count, made;
  dyd_near_site *site;
  mpq_t e[4]; /* of the query rectangle */
} query;

static void rect_get_ends(mpq_t e[4], const dyd_rect *r) {
  dyd_interval_get_q(e[0], e[1], &r->x);
  dyd_interval_get_q(e[2], e[3], &r->y);
}

static void query_clear(query *q) {
  for (size_t k = 0; k < q->made; k++)
    for (int n = 0; n < 4; n++) mpq_clear(q->site[k].e[n]);
  for (int n = 0; n < 4; n++) mpq_clear(q->e[n]);
  free(q->site);
  free(q->vertex);
}

static dyd_status query_load_sites(query *q) {
  q->site = dyd_alloc(q->count, sizeof *q->site);
  if (!q->site) return DYD_E_NOMEM;
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < q->count && st == DYD_OK; k++) {
    uint32_t i = q->pd->sk.reps.site[q->vertex[k]];
    dyd_near_site *s = &q->site[q->made++];
    for (int n = 0; n < 4; n++) mpq_init(s->e[n]);
    st = dyd_sites_get(&r, q->pd->sk.rects.sites, i);
    if (st != DYD_OK) break;
    rect_get_ends(s->e, &r);
    dyd_sites_get_d(s->box.e, q->pd->sk.rects.sites, i);
    s->slack = dyd_filter_slack(&s->box, dyd_sites_in_doubles(q->pd->sk.rects.sites, i));
  }
  dyd_rect_clear(&r);
  return st;
}

/* ---- a point ---- */

/* Squared distance from the point (e[0], e[2]) to the site: closest, or farthest. */
static void query_distance2(mpq_t out, mpq_t t, const query *q, const dyd_near_site *s, bool farthest) {
  mpq_set_ui(out, 0, 1);
  for (int a = 0; a < 4; a += 2) {
    mpq_t below, above;
    mpq_inits(below, above, NULL);
    mpq_sub(below, s->e[a], q->e[a]);     /* > 0: the point is below */
    mpq_sub(above, q->e[a], s->e[a + 1]); /* > 0: above */
    if (farthest) {
      mpq_neg(below, below);
      mpq_neg(above, above);
    } else {
      if (mpq_sgn(below) < 0) mpq_set_ui(below, 0, 1);
      if (mpq_sgn(above) < 0) mpq_set_ui(above, 0, 1);
    }
    mpq_ptr d = mpq_cmp(below, above) > 0 ? below : above;
    mpq_mul(t, d, d);
    mpq_add(out, out, t);
    mpq_clears(below, above, NULL);
  }
}

/* Keeps the sites with ds <= the least dl. */
static void query_keep_at_point(query *q) {
  mpq_t least, d, t;
  mpq_inits(least, d, t, NULL);
  for (size_t k = 0; k < q->count; k++) {
    query_distance2(d, t, q, &q->site[k], true);
    if (k == 0 || mpq_cmp(d, least) < 0) mpq_set(least, d);
  }
  size_t kept = 0;
  for (size_t k = 0; k < q->count; k++) {
    query_distance2(d, t, q, &q->site[k], false);
    if (mpq_cmp(d, least) <= 0) q->vertex[kept++] = q->vertex[k];
  }
  q->count = kept;
  mpq_clears(least, d, t, NULL);
}

/* ---- a rectangle ---- */

static bool query_meets(const query *q, const dyd_near_site *s) {
  for (int a = 0; a < 4; a += 2)
    if (mpq_cmp(s->e[a + 1], q->e[a]) < 0 || mpq_cmp(q->e[a + 1], s->e[a]) < 0) return false;
  return true;
}

/* Does the query meet Pos of candidate i? */
static bool query_lists(dyd_near_work *w, const query *q, size_t i) {
  const dyd_near_site *s = &q->site[i];
  if (query_meets(q, s)) return true;
  for (int n = 0; n < 4; n++) { /* side n: coordinate n of the query is fixed */
    bool beyond = n & 1 ? mpq_cmp(s->e[n], q->e[n]) > 0 : mpq_cmp(s->e[n], q->e[n]) < 0;
    int axis = n < 2;
    const dyd_near_side side = {axis, q->e[2 * axis], q->e[2 * axis + 1], q->e[n]};
    if (beyond && dyd_near_side_meets(w, &side, q->site, q->count, i, q->pd->sk.mesh.no_filter)) return true;
  }
  return false;
}

static dyd_status query_keep_in_rect(query *q) {
  bool *keep = dyd_alloc(q->count, sizeof *keep);
  if (!keep) return DYD_E_NOMEM;
  dyd_near_work w;
  dyd_near_work_init(&w);
  for (size_t i = 0; i < q->count; i++) keep[i] = query_lists(&w, q, i);
  dyd_near_work_clear(&w);
  size_t kept = 0;
  for (size_t i = 0; i < q->count; i++)
    if (keep[i]) q->vertex[kept++] = q->vertex[i];
  q->count = kept;
  free(keep);
  return DYD_OK;
}

/* ---- both ---- */

/* Vertices become sites, sorted, and are handed over. */
static void query_deliver(dyd_index_list *out, query *q) {
  for (size_t k = 0; k < q->count; k++) q->vertex[k] = q->pd->sk.reps.site[q->vertex[k]];
  if (q->count) qsort(q->vertex, q->count, sizeof *q->vertex, dyd_compare_index);
  dyd_index_list_clear(out);
  *out = (dyd_index_list){q->count, q->vertex};
  q->vertex = NULL;
}

dyd_status dyd_nearest_rect(dyd_index_list *out, bool *sure, const dyd_delaunay *pd, const dyd_rect *rect) {
  if (!pd) return DYD_E_ARG;
  query q = {.pd = pd};
  for (int n = 0; n < 4; n++) mpq_init(q.e[n]);
  dyd_status st = dyd_near_candidates(&q.vertex, &q.count, pd, rect);
  if (st == DYD_OK && q.count > 1) {
    rect_get_ends(q.e, rect);
    st = query_load_sites(&q);
    if (st == DYD_OK && dyd_rect_is_point(rect))
      query_keep_at_point(&q);
    else if (st == DYD_OK)
      st = query_keep_in_rect(&q);
  }
  if (st == DYD_OK) {
    query_deliver(out, &q);
    *sure = out->count == 1;
  }
  query_clear(&q);
  return st;
}

dyd_status dyd_nearest(dyd_index_list *out, bool *sure, const dyd_delaunay *pd, const dyd_point *c) {
  if (!pd) return DYD_E_ARG;
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = dyd_interval_set_ends(&r.x, &c->x, &c->x);
  if (st == DYD_OK) st = dyd_interval_set_ends(&r.y, &c->y, &c->y);
  if (st == DYD_OK) st = dyd_nearest_rect(out, sure, pd, &r);
  dyd_rect_clear(&r);
  return st;
}
