/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs that stay indeterminate whatever is refined [SET-1] [SET-2].
 *
 * Let no point that can be narrowed be known worse than to a diameter of eps. A rectangle is firm if it is fixed and
 * wider than 2 eps both ways. Pairs of firm rectangles: all sites are triangulated once with firm rectangles smaller by
 * eps on each side and any point for each that can be narrowed. A pair that is open there, neither legal nor illegal,
 * is so wherever these points are.
 *
 * Other pairs: the points of fixed rectangles are chosen, everybody else keeps the present rectangle, and the face with
 * the legal neighbours of its sites is triangulated. A pair that is illegal there is illegal for that choice among all
 * sites: it never becomes legal. A pair that is legal there, with a disc that meets no other rectangle at all, is an
 * edge for that choice: it never becomes illegal. Or the pair is not legal among its ends and smaller firm rectangles.
 *
 * Only where to look is guessed (settle_filter.c). */
#include "engine/settle.h"

#include "base/alloc.h"
#include "base/index.h"
#include "delaunay/disc_filter.h"
#include "engine/points.h"
#include "engine/settle_filter.h"
#include "engine/settle_firm.h"

#include <stdlib.h>

/* From so many bits on pairs are worth a look; how many sites may be triangulated in all, for each site and besides;
 * random choices for one face; pairs across one that are made legal. In the armed build coarse points are looked at. */
#ifdef DYD_ARMED
enum { FIRST_BITS = 2 };
#else
enum { FIRST_BITS = 128 };
#endif
enum { WORK_PER_SITE = 4, WORK = 1 << 20, RANDOM = 12, ACROSS = 16 };

void dyd_settled_clear(dyd_settled *s) {
  free(s->item);
  *s = (dyd_settled){0};
}

/* ---- what is known ---- */

static int settled_compare(const void *a, const void *b) {
  const dyd_settled_pair *p = a, *q = b;
  if (p->i != q->i) return p->i < q->i ? -1 : 1;
  return (p->j > q->j) - (p->j < q->j);
}

static const dyd_settled_pair *settled_find(const dyd_settled *s, uint32_t i, uint32_t j) {
  const dyd_settled_pair key = {.i = i, .j = j};
  return s->count ? bsearch(&key, s->item, s->count, sizeof key, settled_compare) : NULL;
}

static bool pair_is_settled(const dyd_settled_pair *p) {
  return p->possible && p->unsure;
}

bool dyd_is_settled(const dyd_settled *s, const dyd_pair *pair) {
  const dyd_settled_pair *p = settled_find(s, pair->i, pair->j);
  return p && pair_is_settled(p);
}

/* Pairs from `sorted` on have come: what is known of each, in one place. */
static void settled_sort(dyd_settled *s) {
  size_t kept = 0;
  if (s->count) qsort(s->item, s->count, sizeof *s->item, settled_compare);
  for (size_t k = 0; k < s->count; k++) {
    dyd_settled_pair *last = kept ? &s->item[kept - 1] : NULL;
    if (last && settled_compare(last, &s->item[k]) == 0) {
      last->possible = last->possible || s->item[k].possible;
      last->unsure = last->unsure || s->item[k].unsure;
    } else {
      s->item[kept++] = s->item[k];
    }
  }
  s->count = kept;
}

/* ---- pairs of firm rectangles ---- */

/* Settles pairs of firm rectangles, by all sites. */
static dyd_status settle_firm(dyd_settled_pair *pair, size_t pairs, const dyd_plan *plan, const dyd_dyadic *eps) {
  const dyd_engine *e = plan->e;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = plan->o->max_pairs, .cancel = &e->stop,
                                  .threads = plan->o->threads, .no_filter = plan->o->no_filter};
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_status st = dyd_sites_new(&sites);
  for (size_t k = 0; st == DYD_OK && k < dyd_sites_count(e->sites); k++) st = dyd_firm_add(sites, e, eps, (uint32_t)k);
  if (st == DYD_OK) st = dyd_delaunay_new(&pd, sites, &o, NULL);
  for (size_t k = 0; st == DYD_OK && k < pairs; k++) {
    dyd_pair_status status = dyd_delaunay_status(pd, pair[k].i, pair[k].j);
    pair[k].possible = pair[k].possible || status != DYD_ILLEGAL;
    pair[k].unsure = pair[k].unsure || status != DYD_LEGAL;
  }
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* ---- one face ---- */

/* site: those of the face and their legal neighbours, ascending; rect and guess: one for each of them; pair: what is
 * not settled, but for pairs of firm rectangles; left: how many of these; work: what is left of it for all faces. */
typedef struct settling {
  const dyd_engine *e;
  const dyd_dyadic *eps;
  dyd_index_list site;
  dyd_rect *rect;
  dyd_settle_site *guess;
  dyd_settled_pair *pair;
  size_t pairs, left;
  size_t *work;
  bool mixed; /* some rectangle is fixed */
} settling;

static void settling_clear(settling *s) {
  for (size_t k = 0; s->rect && k < s->site.count; k++) dyd_rect_clear(&s->rect[k]);
  dyd_index_list_clear(&s->site);
  free(s->rect);
  free(s->guess);
  free(s->pair);
}

static size_t settling_place(const settling *s, uint32_t site) {
  const uint32_t *at = dyd_find_index(&site, s->site.item, s->site.count, sizeof site);
  return at ? (size_t)(at - s->site.item) : SIZE_MAX;
}

/* The indeterminate pairs of face f that are not settled: those of firm rectangles, or the others. */
static dyd_status take_pairs(dyd_settled_pair **out, size_t *count, const dyd_settled *known, const dyd_engine *e,
                             const dyd_dyadic *eps, size_t f, bool firm) {
  dyd_pair_list all = {0};
  dyd_status st = dyd_delaunay_face_pairs(&all, e->pd, f);
  if (st == DYD_OK && !(*out = dyd_alloc(all.count, sizeof **out))) st = DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < all.count; k++) {
    const dyd_pair *pair = &all.item[k];
    const dyd_settled_pair *old = settled_find(known, pair->i, pair->j);
    bool both;
    if (pair->status != DYD_INDETERMINATE || (old && pair_is_settled(old))) continue;
    st = dyd_pair_is_firm(&both, e, eps, pair);
    if (both == firm) (*out)[(*count)++] = old ? *old : (dyd_settled_pair){pair->i, pair->j, false, false};
  }
  dyd_pair_list_clear(&all);
  return st;
}

/* Adds the legal neighbours of the sites of the face. */
static dyd_status settling_add_ring(dyd_index_list *site, const dyd_delaunay *pd) {
  size_t count = site->count, cap = site->count;
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < site->count; k++) {
    dyd_index_list ring = {0};
    st = dyd_delaunay_neighbours(&ring, pd, site->item[k], DYD_LEGAL);
    if (st == DYD_OK && !dyd_reserve((void **)&site->item, &cap, count + ring.count, sizeof *site->item))
      st = DYD_E_NOMEM;
    for (size_t q = 0; st == DYD_OK && q < ring.count; q++) site->item[count++] = ring.item[q];
    dyd_index_list_clear(&ring);
  }
  qsort(site->item, count, sizeof *site->item, dyd_compare_index);
  site->count = 0;
  for (size_t k = 0; k < count; k++)
    if (site->count == 0 || site->item[site->count - 1] != site->item[k]) site->item[site->count++] = site->item[k];
  return st;
}

/* Is one of the sites a point that can be narrowed? */
static bool settling_can_narrow(const settling *s) {
  for (size_t k = 0; k < s->site.count; k++) {
    const dyd_refinable *p = dyd_engine_find(s->e, s->site.item[k]);
    if (p && !p->final) return true;
  }
  return false;
}

static dyd_status settling_take_rects(settling *s) {
  dyd_status st = DYD_OK;
  s->rect = dyd_alloc(s->site.count, sizeof *s->rect);
  s->guess = dyd_alloc(s->site.count, sizeof *s->guess);
  for (size_t k = 0; s->rect && k < s->site.count; k++) dyd_rect_init(&s->rect[k]);
  if (!s->rect || !s->guess) return DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < s->site.count; k++) {
    const dyd_refinable *p = dyd_engine_find(s->e, s->site.item[k]);
    st = dyd_sites_get(&s->rect[k], s->e->sites, s->site.item[k]);
    dyd_rect_get_d(s->guess[k].box, &s->rect[k]);
    s->guess[k].fixed = !p || p->final;
    s->mixed = s->mixed || (s->guess[k].fixed && !dyd_rect_is_point(&s->rect[k]));
  }
  return st;
}

/* ---- one choice ---- */

/* The point of a, not a point, that is nearest to the double. */
static void choose_on_side(dyd_interval *out, const dyd_interval *a, double at) {
  const dyd_dyadic *end = &a->lo;
  if (dyd_interval_set_d(out, at, at) == DYD_OK) {
    if (dyd_interval_contains(a, out)) return;
    if (dyd_dyadic_cmp(&out->lo, &a->hi) > 0) end = &a->hi;
  }
  dyd_interval_set_ends(out, end, end);
}

static dyd_status settling_add_site(dyd_sites *sites, const settling *s, size_t k) {
  const dyd_rect *r = &s->rect[k];
  const dyd_settle_site *g = &s->guess[k];
  if (!g->fixed || dyd_rect_is_point(r)) return dyd_sites_add_rect(sites, r);
  dyd_rect point;
  dyd_rect_init(&point);
  dyd_rect_set(&point, r);
  if (!dyd_interval_is_point(&r->x)) choose_on_side(&point.x, &r->x, g->at[0]);
  if (!dyd_interval_is_point(&r->y)) choose_on_side(&point.y, &r->y, g->at[1]);
  dyd_status st = dyd_sites_add_rect(sites, &point);
  dyd_rect_clear(&point);
  return st;
}

/* Does the disc around c that holds a and b, sites of the choice, meet the rectangles of no other sites than these? */
static dyd_status disc_is_theirs(bool *out, const settling *s, const dyd_sites *chosen, const dyd_point *c, uint32_t a,
                                 uint32_t b) {
  dyd_index_list met = {0};
  mpq_t radius2, other;
  dyd_rect r;
  mpq_inits(radius2, other, (mpq_ptr)0);
  dyd_rect_init(&r);
  dyd_status st = dyd_sites_get(&r, chosen, a);
  dyd_rect_dl2(radius2, c, &r);
  if (st == DYD_OK) st = dyd_sites_get(&r, chosen, b);
  dyd_rect_dl2(other, c, &r);
  if (mpq_cmp(other, radius2) > 0) mpq_swap(other, radius2);
  if (st == DYD_OK) st = dyd_delaunay_meet_disc(&met, s->e->pd, c, radius2);
  *out = st == DYD_OK;
  for (size_t k = 0; *out && k < met.count; k++) *out = settling_place(s, met.item[k]) != SIZE_MAX;
  dyd_index_list_clear(&met);
  dyd_rect_clear(&r);
  mpq_clears(radius2, other, (mpq_ptr)0);
  return st;
}

/* What the choice tells about a pair. */
static dyd_status settling_look(dyd_settled_pair *p, const settling *s, const dyd_delaunay *pd) {
  uint32_t a = (uint32_t)settling_place(s, p->i), b = (uint32_t)settling_place(s, p->j);
  if (dyd_delaunay_alias(pd, a) == dyd_delaunay_alias(pd, b)) return DYD_OK;
  dyd_pair_status status = dyd_delaunay_status(pd, a, b);
  p->unsure = p->unsure || status == DYD_ILLEGAL;
  if (status != DYD_LEGAL || p->possible) return DYD_OK;
  dyd_point c;
  dyd_point_init(&c);
  dyd_status st = dyd_delaunay_witness(&c, pd, a, b);
  if (st == DYD_OK) st = disc_is_theirs(&p->possible, s, dyd_delaunay_sites(pd), &c, a, b);
  dyd_point_clear(&c);
  return st == DYD_E_RANGE ? DYD_OK : st; /* no witness was found */
}

static void settling_spend(settling *s) {
  *s->work -= *s->work < s->site.count ? *s->work : s->site.count;
}

/* Triangulates the choice, and looks at all pairs that are not settled. */
static dyd_status settling_try(settling *s) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = &s->e->stop};
  dyd_status st = dyd_sites_new(&sites);
  for (size_t k = 0; st == DYD_OK && k < s->site.count; k++) st = settling_add_site(sites, s, k);
  if (st == DYD_OK) st = dyd_delaunay_new(&pd, sites, &o, NULL);
  if (st == DYD_CAPPED) st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < s->pairs; k++) {
    if (pair_is_settled(&s->pair[k])) continue;
    st = settling_look(&s->pair[k], s, pd);
    s->left -= pair_is_settled(&s->pair[k]);
  }
  settling_spend(s);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return st;
}

/* What makes a pair legal that crosses number k makes that one illegal. */
static dyd_status settling_try_across(settling *s, size_t k) {
  size_t a = settling_place(s, s->pair[k].i), b = settling_place(s, s->pair[k].j);
  dyd_status st = DYD_OK;
  for (size_t q = 0, tries = 0; st == DYD_OK && q < s->pairs && tries < ACROSS && !s->pair[k].unsure; q++) {
    size_t c = settling_place(s, s->pair[q].i), d = settling_place(s, s->pair[q].j);
    if (!dyd_filter_middles_cross(s->guess, a, b, c, d)) continue;
    tries++;
    if (dyd_filter_choose_joined(s->guess, s->site.count, c, d, false)) st = settling_try(s);
  }
  return st;
}

/* Choices made for one pair; thorough: more for it to be possible. */
static dyd_status settling_try_for(settling *s, size_t k, bool thorough) {
  const dyd_settled_pair *p = &s->pair[k];
  size_t a = settling_place(s, p->i), b = settling_place(s, p->j);
  dyd_status st = DYD_OK;
  if (!p->possible && dyd_filter_choose_joined(s->guess, s->site.count, a, b, thorough)) st = settling_try(s);
  if (st != DYD_OK || p->unsure || thorough) return st;
  dyd_filter_choose_parted(s->guess, s->site.count, a, b);
  st = settling_try(s);
  return st == DYD_OK && !p->unsure ? settling_try_across(s, k) : st;
}

/* The ends of number k among firm rectangles of the face alone. */
static dyd_status settling_try_alone(settling *s, size_t k) {
  dyd_settled_pair *p = &s->pair[k];
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = &s->e->stop};
  dyd_status st = dyd_sites_new(&sites);
  if (st == DYD_OK) st = dyd_firm_add(sites, s->e, s->eps, p->i);
  if (st == DYD_OK) st = dyd_firm_add(sites, s->e, s->eps, p->j);
  for (size_t q = 0; st == DYD_OK && q < s->site.count; q++) {
    uint32_t site = s->site.item[q];
    bool firm = s->guess[q].fixed && site != p->i && site != p->j;
    if (firm) st = dyd_firm_shrink(NULL, &firm, &s->rect[q], s->eps);
    if (st == DYD_OK && firm) st = dyd_firm_add(sites, s->e, s->eps, site);
  }
  if (st == DYD_OK) st = dyd_delaunay_new(&pd, sites, &o, NULL);
  if (st == DYD_OK) p->unsure = dyd_delaunay_alias(pd, 1) == 1 && dyd_delaunay_status(pd, 0, 1) != DYD_LEGAL;
  settling_spend(s);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* The same for all pairs of which nothing else has shown that they stay open. */
static dyd_status settling_try_all_alone(settling *s) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && s->left && *s->work && k < s->pairs; k++) {
    if (s->pair[k].unsure || !s->pair[k].possible) continue;
    st = settling_try_alone(s, k);
    s->left -= pair_is_settled(&s->pair[k]);
  }
  return st;
}

static dyd_status settling_run(settling *s, uint64_t *random) {
  dyd_filter_choose_middles(s->guess, s->site.count);
  dyd_status st = settling_try(s);
  for (size_t k = 0; st == DYD_OK && s->left && *s->work && k < 2 * s->pairs; k++)
    st = settling_try_for(s, k % s->pairs, k >= s->pairs);
  for (int k = 0; st == DYD_OK && s->left && *s->work && k < RANDOM; k++) {
    dyd_filter_choose_any(s->guess, s->site.count, random);
    st = settling_try(s);
  }
  return st == DYD_OK ? settling_try_all_alone(s) : st;
}

/* Appends what was found. */
static dyd_status settled_keep(dyd_settled *out, const dyd_settled_pair *pair, size_t count) {
  if (!dyd_reserve((void **)&out->item, &out->cap, out->count + count, sizeof *out->item)) return DYD_E_NOMEM;
  for (size_t k = 0; k < count; k++)
    if (pair[k].possible || pair[k].unsure) out->item[out->count++] = pair[k];
  return DYD_OK;
}

/* s, empty, becomes face f with its pairs; nothing, unless a point of it can be narrowed. */
static dyd_status settling_begin(settling *s, const dyd_settled *known, size_t f) {
  bool outer;
  dyd_status st = dyd_delaunay_face(&s->site, &outer, s->e->pd, f);
  if (st != DYD_OK || !settling_can_narrow(s)) return st;
  st = take_pairs(&s->pair, &s->pairs, known, s->e, s->eps, f, false);
  s->left = s->pairs;
  if (st == DYD_OK && s->left) st = settling_add_ring(&s->site, s->e->pd);
  return st == DYD_OK && s->left ? settling_take_rects(s) : st;
}

/* fresh: what is found, not yet in order. */
static dyd_status settle_face(dyd_settled *fresh, uint64_t *random, size_t *work, const dyd_settled *known,
                              const dyd_engine *e, const dyd_dyadic *eps, size_t f) {
  settling s = {.e = e, .eps = eps, .work = work};
  dyd_status st = settling_begin(&s, known, f);
  if (st == DYD_OK && s.left && s.mixed) st = settling_run(&s, random);
  if (st == DYD_OK) st = settled_keep(fresh, s.pair, s.pairs);
  settling_clear(&s);
  return st;
}

/* All pairs of firm rectangles, in faces with points that can be narrowed. */
static dyd_status settle_all_firm(dyd_settled *fresh, const dyd_settled *known, const dyd_plan *plan,
                                  const dyd_dyadic *eps) {
  const dyd_engine *e = plan->e;
  dyd_status st = DYD_OK;
  for (size_t f = 0; st == DYD_OK && f < dyd_delaunay_undecided_faces(e->pd); f++) {
    settling s = {.e = e};
    bool outer;
    st = dyd_delaunay_face(&s.site, &outer, e->pd, f);
    if (st == DYD_OK && settling_can_narrow(&s)) st = take_pairs(&s.pair, &s.pairs, known, e, eps, f, true);
    size_t count = fresh->count + s.pairs;
    if (st == DYD_OK && !dyd_reserve((void **)&fresh->item, &fresh->cap, count, sizeof *s.pair)) st = DYD_E_NOMEM;
    for (size_t k = 0; st == DYD_OK && k < s.pairs; k++) fresh->item[fresh->count++] = s.pair[k];
    settling_clear(&s);
  }
  return st == DYD_OK && fresh->count ? settle_firm(fresh->item, fresh->count, plan, eps) : st;
}

/* The most bits that a point which can be narrowed was asked for. */
static int64_t most_bits(const dyd_engine *e) {
  int64_t most = INT64_MIN;
  for (size_t k = 0; k < e->points; k++)
    if (e->point[k].asked && !e->point[k].final && e->point[k].bits > most) most = e->point[k].bits;
  return most;
}

static dyd_status settle_pairs(dyd_settled *fresh, dyd_settled *s, const dyd_plan *plan) {
  const dyd_engine *e = plan->e;
  size_t work = WORK + WORK_PER_SITE * dyd_sites_count(e->sites);
  dyd_dyadic eps;
  dyd_dyadic_init(&eps);
  dyd_status st = dyd_firm_eps(&eps, e);
  if (st == DYD_OK) st = settle_all_firm(fresh, s, plan, &eps);
  for (size_t f = 0; st == DYD_OK && work && f < dyd_delaunay_undecided_faces(e->pd); f++)
    st = settle_face(fresh, &s->random, &work, s, e, &eps, f);
  dyd_dyadic_clear(&eps);
  return st;
}

dyd_status dyd_settle(dyd_settled *s, const dyd_plan *plan) {
  int64_t bits = most_bits(plan->e), due = s->next > FIRST_BITS ? s->next : FIRST_BITS;
  dyd_settled fresh = {0};
  if (bits < due && bits < plan->o->max_bits) return DYD_OK;
  s->next = dyd_bits_raised(bits, bits > 0 ? 3 * bits : 0, INT64_MAX);
  dyd_status st = settle_pairs(&fresh, s, plan);
  if (st == DYD_OK) st = settled_keep(s, fresh.item, fresh.count);
  settled_sort(s);
  dyd_settled_clear(&fresh);
  return st;
}
