/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which sites are possibly nearest to a point, or to a point of a rectangle (mathematics: section 2).
 *
 * i is possibly nearest to c iff ds_i(c) <= min_k dl_k(c), that is c is in Pos_i. If only i is listed for the rectangle
 * q, every point of q is in no other Pos_k, so i is certainly nearest everywhere: q is inside Int_i; the converse is
 * plain [NEAR-1]. Only sites that are possibly nearest to some point of q matter, as candidates and as blockers: the
 * site of least dl at a point is one of them. If q does not meet R_i and meets Pos_i, it does on its boundary: Pos_i
 * holds with c the segment to the point of R_i nearest to c, which leaves q through a side beyond which that point lies
 * [NEAR-2].
 */
#include "voronoi/nearest.h"

#include "base/alloc.h"
#include "base/local.h"

#include <dyadel/voronoi.h>

/* ---- does a side of the query meet Pos_i? ----
 *
 * A walk along the side, as the cover walk of the triangulation.
 * On the line of the side let t be the coordinate. Site k blocks the t with f_k = dl_k^2 - ds_i^2 < 0: C_ki is open and
 * convex, so that is one open interval. Pos_i meets the side iff the intervals of all other sites do not cover it.
 * Walk: start at the lower end; if no site blocks there, Pos_i meets the side. Else go to the upper end of a blocker's
 * interval, which
 * this blocker leaves free; beyond the side: it does not meet. Each step is at the end of another interval, farther on,
 * so there is at most one step for each site [NEAR-2].
 *
 * With s the farther end of R_k along the axis (the upper one for t <= the middle), and D = (distance across to the
 * farther end of R_k)^2 - (distance across to R_i)^2:
 *   f_k = 2 (e - s) t + s^2 - e^2 + D   beyond the end e of R_i along the axis,
 *   f_k = (t - s)^2 + D                 within R_i's extent along the axis.
 * So upper ends of intervals are rational or s + sqrt(-D), and signs of f_k there are those of p + q sqrt(c). */

/* Scratch of the walk. */
typedef struct dyd_near_work {
  mpq_t at, root; /* the place on the side: at + sqrt(root) */
  mpq_t far, near, d, p, q, s, t, mid;
} dyd_near_work;

static void near_work_init(dyd_near_work *w) {
  mpq_inits(w->at, w->root, w->far, w->near, w->d, w->p, w->q, w->s, w->t, w->mid, NULL);
}

static void near_work_clear(dyd_near_work *w) {
  mpq_clears(w->at, w->root, w->far, w->near, w->d, w->p, w->q, w->s, w->t, w->mid, NULL);
}

/* Sign of p + q sqrt(c), c >= 0 [SQR-1]. s, t: scratch. */
static int surd_sign(mpq_t s, mpq_t t, const mpq_t p, const mpq_t q, const mpq_t c) {
  int sp = mpq_sgn(p), sq = mpq_sgn(c) ? mpq_sgn(q) : 0;
  if (!sq || sp == sq) return sp;
  if (!sp) return sq;
  mpq_mul(s, p, p);
  mpq_mul(t, q, q);
  mpq_mul(t, t, c);
  int order = mpq_cmp(s, t);
  return order > 0 ? sp : order < 0 ? sq : 0;
}

/* Sign of (the place) - x. */
static int place_compare(dyd_near_work *w, const mpq_t x) {
  mpq_sub(w->p, w->at, x);
  mpq_set_ui(w->q, 1, 1);
  return surd_sign(w->s, w->t, w->p, w->q, w->root);
}

/* w->d = D for site k against site i. */
static void side_set_across(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *k,
                            const dyd_near_site *i) {
  int o = 2 - 2 * side->axis;
  mpq_sub(w->s, k->e[o + 1], side->across);
  mpq_sub(w->t, side->across, k->e[o]);
  mpq_ptr far = mpq_cmp(w->s, w->t) > 0 ? w->s : w->t;
  mpq_mul(w->d, far, far);
  if (mpq_cmp(side->across, i->e[o]) < 0)
    mpq_sub(w->s, i->e[o], side->across);
  else if (mpq_cmp(side->across, i->e[o + 1]) > 0)
    mpq_sub(w->s, side->across, i->e[o + 1]);
  else
    return;
  mpq_mul(w->s, w->s, w->s);
  mpq_sub(w->d, w->d, w->s);
}

static void side_set_middle(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *k) {
  int a = 2 * side->axis;
  mpq_add(w->mid, k->e[a], k->e[a + 1]);
  mpq_div_2exp(w->mid, w->mid, 1);
}

/* Linear coefficients of f in a piece beyond an end of R_i: f = p t + q; w->far = s, w->near = e are set. */
static void side_set_linear(dyd_near_work *w) {
  mpq_sub(w->p, w->near, w->far);
  mpq_add(w->p, w->p, w->p);
  mpq_mul(w->s, w->far, w->far);
  mpq_mul(w->t, w->near, w->near);
  mpq_sub(w->q, w->s, w->t);
  mpq_add(w->q, w->q, w->d);
}

/* Sign of f at the place; D and the middle of k are set. */
static int blocker_sign_at_place(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *k,
                                 const dyd_near_site *i) {
  int a = 2 * side->axis;
  mpq_set(w->far, place_compare(w, w->mid) <= 0 ? k->e[a + 1] : k->e[a]);
  bool below = place_compare(w, i->e[a])<0, above = place_compare(w, i->e[a + 1])> 0;
  if (below || above) {
    mpq_set(w->near, below ? i->e[a] : i->e[a + 1]);
    side_set_linear(w);
    mpq_mul(w->s, w->p, w->at);
    mpq_add(w->q, w->q, w->s); /* value = q + p sqrt(root) */
    mpq_swap(w->p, w->q);
  } else {
    mpq_sub(w->q, w->at, w->far);
    mpq_mul(w->p, w->q, w->q);
    mpq_add(w->p, w->p, w->root);
    mpq_add(w->p, w->p, w->d);
    mpq_add(w->q, w->q, w->q);
  }
  return surd_sign(w->s, w->t, w->p, w->q, w->root);
}

/* Sign of f at the rational x. */
static int blocker_sign_at(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *k, const dyd_near_site *i,
                           const mpq_t x) {
  int a = 2 * side->axis;
  mpq_sub(w->s, x, mpq_cmp(x, w->mid) <= 0 ? k->e[a + 1] : k->e[a]);
  mpq_mul(w->s, w->s, w->s);
  mpq_add(w->s, w->s, w->d);
  bool below = mpq_cmp(x, i->e[a]) < 0;
  if (below || mpq_cmp(x, i->e[a + 1]) > 0) {
    mpq_sub(w->t, x, below ? i->e[a] : i->e[a + 1]);
    mpq_mul(w->t, w->t, w->t);
    mpq_sub(w->s, w->s, w->t);
  }
  return mpq_sgn(w->s);
}

/* Moves to the upper end of the interval of k, which holds the place; false: it has none. */
static bool place_advance(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *k, const dyd_near_site *i) {
  int a = 2 * side->axis;
  mpq_srcptr lo = i->e[a], hi = i->e[a + 1], end[3] = {lo, hi, w->mid}, stop = NULL;
  for (int n = 0; n < 3; n++) {
    if (place_compare(w, end[n]) >= 0 || blocker_sign_at(w, side, k, i, end[n]) < 0) continue;
    if (!stop || mpq_cmp(end[n], stop) < 0) stop = end[n];
  }
  /* The piece that ends at stop, or the last one. */
  mpq_set(w->far, stop && mpq_cmp(stop, w->mid) <= 0 ? k->e[a + 1] : k->e[a]);
  if (stop && mpq_cmp(stop, lo) > 0 && mpq_cmp(stop, hi) <= 0) {
    mpq_set(w->at, w->far);
    mpq_neg(w->root, w->d);
    return true;
  }
  mpq_set(w->near, stop && mpq_cmp(stop, lo) <= 0 ? lo : hi);
  side_set_linear(w);
  if (mpq_sgn(w->p) <= 0) return false;
  mpq_div(w->at, w->q, w->p);
  mpq_neg(w->at, w->at);
  mpq_set_ui(w->root, 0, 1);
  return true;
}

/* Returns a site that blocks the place, with D and the middle set; count: none. */
static size_t side_find_blocker(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *site, size_t count,
                                size_t i, bool no_filter) {
  dyd_bbox c;
  dyd_filter_place(&c, side, w->at, w->root);
  size_t sure = no_filter ? count : dyd_filter_blocker(&c, site, count, i);
  for (size_t k = sure < count ? sure : 0; k < count; k++) {
    if (k == i || (k != sure && !no_filter && dyd_filter_blocks(&c, &site[k], &site[i]) == DYD_FALSE)) continue;
    side_set_across(w, side, &site[k], &site[i]);
    side_set_middle(w, side, &site[k]);
    if (k == sure || blocker_sign_at_place(w, side, &site[k], &site[i]) < 0) return k;
  }
  return count;
}

/* Returns true if a point of the side lies in Pos_i by the other sites of the list [NEAR-2]. Exact. */
static bool near_side_meets(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *site, size_t count,
                            size_t i, bool no_filter) {
  mpq_set(w->at, side->lo);
  mpq_set_ui(w->root, 0, 1);
  for (;;) {
    size_t k = side_find_blocker(w, side, site, count, i, no_filter);
    if (k == count) return true;
    if (!place_advance(w, side, &site[k], &site[i]) || place_compare(w, side->hi) > 0) return false;
  }
}

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
  dyd_free_all(q->site, q->vertex);
}

static dyd_status query_load_sites(query *q) {
  q->site = dyd_alloc(q->count, sizeof *q->site);
  if (!q->site) return DYD_E_NOMEM;
  DYD_LOCAL(dyd_rect, r);
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
  return st;
}

/* ---- a point ---- */

/* Squared distance from the point (e[0], e[2]) to the site: closest, or farthest. */
static void query_distance2(mpq_t out, mpq_t t, const query *q, const dyd_near_site *s, bool farthest) {
  mpq_set_ui(out, 0, 1);
  for (int a = 0; a < 4; a += 2) {
    DYD_LOCAL_NUMBERS(mpq, below, above);
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
  }
}

/* Keeps the sites with ds <= the least dl. */
static void query_keep_at_point(query *q) {
  DYD_LOCAL_NUMBERS(mpq, least, d, t);
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
}

/* ---- a rectangle ---- */

static bool query_meets(const query *q, const dyd_near_site *s) {
  for (int a = 0; a < 4; a += 2)
    if (mpq_cmp(s->e[a + 1], q->e[a]) < 0 || mpq_cmp(q->e[a + 1], s->e[a]) < 0) return false;
  return true;
}

/* Returns true if the query meets Pos of candidate i. */
static bool query_lists(dyd_near_work *w, const query *q, size_t i) {
  const dyd_near_site *s = &q->site[i];
  if (query_meets(q, s)) return true;
  for (int n = 0; n < 4; n++) { /* side n: coordinate n of the query is fixed */
    bool beyond = n & 1 ? mpq_cmp(s->e[n], q->e[n]) > 0 : mpq_cmp(s->e[n], q->e[n]) < 0;
    int axis = n < 2;
    const dyd_near_side side = {axis, q->e[2 * axis], q->e[2 * axis + 1], q->e[n]};
    if (beyond && near_side_meets(w, &side, q->site, q->count, i, q->pd->sk.mesh.no_filter)) return true;
  }
  return false;
}

static dyd_status query_keep_in_rect(query *q) {
  DYD_FREED bool *keep = dyd_alloc(q->count, sizeof *keep);
  if (!keep) return DYD_E_NOMEM;
  dyd_near_work w;
  near_work_init(&w);
  for (size_t i = 0; i < q->count; i++) keep[i] = query_lists(&w, q, i);
  near_work_clear(&w);
  size_t kept = 0;
  for (size_t i = 0; i < q->count; i++)
    if (keep[i]) q->vertex[kept++] = q->vertex[i];
  q->count = kept;
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

dyd_status dyd_nearest(dyd_index_list *out, bool *sure, const dyd_delaunay *pd, const dyd_rect *rect) {
  if (!pd) return DYD_E_ARG;
  DYD_SCOPED(query) q = {.pd = pd};
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
  return st;
}

/* ---- many places ---- */

/* Adds the answer for z. *v: where the walk begins, and ended. */
static dyd_status near_list_add(dyd_place_list *l, size_t *cap, uint32_t *v, const dyd_delaunay *pd, dyd_xy z) {
  const size_t before = l->places ? l->end[l->places - 1] : 0;
  dyd_index_list found = {0};
  dyd_status st = DYD_OK;
  if (dyd_filter_near_walk(v, pd, z)) {
    l->sure[l->places] = true;
    found = (dyd_index_list){1, &pd->sk.reps.site[*v]};
  } else {
    DYD_LOCAL(dyd_rect, at);
    st = dyd_rect_set_d(&at, z.x, z.x, z.y, z.y);
    if (st == DYD_OK) st = dyd_nearest(&found, &l->sure[l->places], pd, &at);
    if (st == DYD_OK && found.count) *v = pd->sk.vertex[found.item[0]];
  }
  if (st == DYD_OK && !dyd_reserve((void **)&l->site, cap, before + found.count, sizeof *l->site)) st = DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < found.count; k++) l->site[before + k] = found.item[k];
  if (st == DYD_OK) l->end[l->places++] = before + found.count;
  if (found.item != &pd->sk.reps.site[*v]) dyd_index_list_clear(&found);
  return st;
}

dyd_status dyd_nearest_places(dyd_place_list *out, const dyd_delaunay *pd, const double *xy, size_t count,
                              const volatile int *cancel) {
  if (!pd || (count && !xy)) return DYD_E_ARG;
  dyd_place_list l = {.end = dyd_alloc(count, sizeof *l.end), .sure = dyd_alloc(count, sizeof *l.sure)};
  size_t cap = 0;
  uint32_t v = 0;
  while (pd->open.kind != DYD_LINE && pd->sk.leaving[v] == DYD_NONE) v++;
  dyd_status st = l.end && l.sure ? DYD_OK : DYD_E_NOMEM;
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    st = near_list_add(&l, &cap, &v, pd, (dyd_xy){xy[2 * k], xy[2 * k + 1]});
    if (dyd_flag_is_set(cancel)) st = DYD_CANCELLED;
  }
  dyd_place_list_clear(st == DYD_OK ? out : &l);
  if (st == DYD_OK) *out = l;
  return st;
}
