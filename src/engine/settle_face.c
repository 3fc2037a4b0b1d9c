/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs of one face: what stays open wherever the points are that can be narrowed [SET-1].
 *
 * A side has a core, which no refinement leaves, or can be narrowed to any point of it. A disc to which both ends may
 * reach along their cores, wherever they are along the others, while nobody else has to meet it, makes a pair possible
 * for good. Points of both ends that four points show to be in no disc of their own, make it never legal. First a few
 * choices of points in cores are triangulated, all others being as they are: a witness there is such a disc for
 * some of them, and what is illegal there is never legal. */
#include "engine/settle_face.h"

#include <dyadel/predicate.h>

#include "base/alloc.h"
#include "base/flag.h"
#include "base/index.h"
#include "delaunay/disc_filter.h"
#include "engine/settle_filter.h"
#include "engine/settle_firm.h"

#include <stdlib.h>

/* Random choices for one face. */
enum { RANDOM = 4 };

/* site: those of the face and their legal neighbours, ascending; rect and guess: one for each of them; pair: what is
 * looked at; left: how many of these are not settled; work: what is left of it for all faces. */
typedef struct settling {
  const dyd_engine *e;
  dyd_index_list site;
  size_t cap; /* of site */
  dyd_rect *rect;
  dyd_settle_site *guess;
  dyd_settled_pair *pair;
  size_t pairs, left;
  size_t *work;
  bool mixed; /* some side has a core that is no point */
} settling;

static void settling_drop_rects(settling *s) {
  for (size_t k = 0; s->rect && k < s->site.count; k++) dyd_rect_clear(&s->rect[k]);
  free(s->rect);
  free(s->guess);
  s->rect = NULL;
  s->guess = NULL;
}

static void settling_clear(settling *s) {
  settling_drop_rects(s);
  dyd_index_list_clear(&s->site);
}

static size_t settling_place(const settling *s, uint32_t site) {
  const uint32_t *at = dyd_find_index(&site, s->site.item, s->site.count, sizeof site);
  return at ? (size_t)(at - s->site.item) : SIZE_MAX;
}

static dyd_status settling_append(settling *s, const dyd_index_list *more) {
  if (!dyd_reserve((void **)&s->site.item, &s->cap, s->site.count + more->count, sizeof *s->site.item))
    return DYD_E_NOMEM;
  for (size_t k = 0; k < more->count; k++) s->site.item[s->site.count++] = more->item[k];
  return DYD_OK;
}

/* The sites are in order, each once, with their rectangles. */
static dyd_status settling_take_rects(settling *s) {
  dyd_status st = DYD_OK;
  size_t count = s->site.count;
  if (count) qsort(s->site.item, count, sizeof *s->site.item, dyd_compare_index);
  s->site.count = 0;
  for (size_t k = 0; k < count; k++)
    if (k == 0 || s->site.item[k - 1] != s->site.item[k]) s->site.item[s->site.count++] = s->site.item[k];
  s->rect = dyd_alloc(s->site.count, sizeof *s->rect);
  s->guess = dyd_alloc(s->site.count, sizeof *s->guess);
  for (size_t k = 0; s->rect && k < s->site.count; k++) dyd_rect_init(&s->rect[k]);
  if (!s->rect || !s->guess) return DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < s->site.count; k++) {
    bool *core = s->guess[k].core;
    st = dyd_site_get_core(&s->rect[k], core, s->e, s->site.item[k]);
    dyd_rect_get_d(s->guess[k].box, &s->rect[k]);
    s->mixed = s->mixed || (core[0] && !dyd_interval_is_point(&s->rect[k].x)) ||
               (core[1] && !dyd_interval_is_point(&s->rect[k].y));
  }
  return st;
}

/* ---- a disc that joins ---- */

static void settling_spend(settling *s) {
  *s->work -= *s->work < s->site.count ? *s->work : s->site.count;
}

/* a becomes its end that is farther from v. */
static dyd_status side_set_far(dyd_interval *a, const dyd_dyadic *v) {
  dyd_dyadic below, above;
  if (dyd_interval_is_point(a)) return DYD_OK;
  dyd_dyadic_init(&below);
  dyd_dyadic_init(&above);
  dyd_status st = dyd_dyadic_sub(&below, v, &a->lo);
  if (st == DYD_OK) st = dyd_dyadic_sub(&above, &a->hi, v);
  const dyd_dyadic *end = dyd_dyadic_cmp(&below, &above) > 0 ? &a->lo : &a->hi;
  if (st == DYD_OK) st = dyd_interval_set_ends(a, end, end);
  dyd_dyadic_clear(&above);
  dyd_dyadic_clear(&below);
  return st;
}

/* The square of the distance from c to the point of r that is nearest to c along x (near[0]) and y (near[1]), or else
 * farthest. */
static dyd_status rect_reach2(mpq_t out, const dyd_point *c, const dyd_rect *r, const bool near[2]) {
  dyd_rect s;
  dyd_rect_init(&s);
  dyd_rect_set(&s, r);
  dyd_status st = near[0] ? DYD_OK : side_set_far(&s.x, &c->x);
  if (st == DYD_OK && !near[1]) st = side_set_far(&s.y, &c->y);
  dyd_rect_ds2(out, c, &s);
  dyd_rect_clear(&s);
  return st;
}

/* Is there a point of site k outside the disc (c, r), wherever it is along sides that can be narrowed? */
static dyd_status disc_spares(bool *out, const dyd_engine *e, const dyd_point *c, const mpq_t radius2, uint32_t k) {
  mpq_t far2;
  dyd_rect r;
  bool core[2] = {false, false};
  mpq_init(far2);
  dyd_rect_init(&r);
  dyd_status st = dyd_site_get_core(&r, core, e, k);
  const bool near[2] = {!core[0], !core[1]};
  if (st == DYD_OK) st = rect_reach2(far2, c, &r, near);
  *out = st == DYD_OK && mpq_cmp(far2, radius2) >= 0;
  dyd_rect_clear(&r);
  mpq_clear(far2);
  return st;
}

/* Is there a disc around c that shows that the pair is possible, wherever points are that can be narrowed? *met: who
 * meets it. */
static dyd_status disc_joins(bool *out, dyd_index_list *met, const settling *s, const dyd_point *c,
                             const dyd_settled_pair *p) {
  const size_t end[2] = {settling_place(s, p->i), settling_place(s, p->j)};
  mpq_t radius2, other;
  dyd_status st = DYD_OK;
  mpq_inits(radius2, other, (mpq_ptr)0);
  for (int k = 0; st == DYD_OK && k < 2; k++) {
    st = rect_reach2(other, c, &s->rect[end[k]], s->guess[end[k]].core);
    if (mpq_cmp(other, radius2) > 0) mpq_swap(other, radius2);
  }
  if (st == DYD_OK) st = dyd_delaunay_meet_disc(met, s->e->pd, c, radius2);
  *out = st == DYD_OK;
  for (size_t k = 0; st == DYD_OK && *out && k < met->count; k++)
    if (met->item[k] != p->i && met->item[k] != p->j) st = disc_spares(out, s->e, c, radius2, met->item[k]);
  mpq_clears(radius2, other, (mpq_ptr)0);
  return st;
}

/* Looks at the disc around a guess; where others than the sites meet it, these become more. */
static dyd_status settling_join_at(settling *s, dyd_settled_pair *p, const double at[2]) {
  dyd_index_list met = {0};
  dyd_point c;
  dyd_point_init(&c);
  dyd_status st = dyd_dyadic_set_d(&c.x, at[0]);
  if (st == DYD_OK) st = dyd_dyadic_set_d(&c.y, at[1]);
  if (st == DYD_OK) st = disc_joins(&p->possible, &met, s, &c, p);
  if (st == DYD_OK && !p->possible) {
    settling_drop_rects(s);
    st = settling_append(s, &met);
    if (st == DYD_OK) st = settling_take_rects(s);
  }
  dyd_index_list_clear(&met);
  dyd_point_clear(&c);
  return st;
}

/* Looks for a disc for one pair. */
static dyd_status settling_join(settling *s, dyd_settled_pair *p, bool thorough) {
  dyd_status st = DYD_OK;
  for (size_t had = 0; st == DYD_OK && !p->possible && had < s->site.count && *s->work;) {
    double at[2];
    size_t i = settling_place(s, p->i), j = settling_place(s, p->j);
    had = s->site.count;
    settling_spend(s);
    if (!dyd_filter_find_centre(at, s->guess, had, i, j, thorough)) break;
    st = settling_join_at(s, p, at);
  }
  return st;
}

/* ---- points that part ---- */

/* The point of a, not a point, that is nearest to the double. */
static void choose_on_side(dyd_interval *out, const dyd_interval *a, double at) {
  const dyd_dyadic *end = &a->lo;
  if (dyd_interval_set_d(out, at, at) == DYD_OK) {
    if (dyd_interval_contains(a, out)) return;
    if (dyd_dyadic_cmp(&out->lo, &a->hi) > 0) end = &a->hi;
  }
  dyd_interval_set_ends(out, end, end);
}

/* Site number k of the face: its point nearest to `at` along the sides where that can be chosen. */
static void settling_choose(dyd_rect *out, const settling *s, size_t k, const double at[2]) {
  dyd_rect_set(out, &s->rect[k]);
  const bool *core = s->guess[k].core;
  if (core[0] && !dyd_interval_is_point(&out->x)) choose_on_side(&out->x, &s->rect[k].x, at[0]);
  if (core[1] && !dyd_interval_is_point(&out->y)) choose_on_side(&out->y, &s->rect[k].y, at[1]);
}

/* Is r[3] surely among the three others? */
static bool surely_inside(const dyd_rect r[4]) {
  dyd_sure way = dyd_orientation(&r[0], &r[1], &r[2]);
  return way != DYD_UNSURE && dyd_orientation(&r[0], &r[1], &r[3]) == way &&
         dyd_orientation(&r[1], &r[2], &r[3]) == way && dyd_orientation(&r[2], &r[0], &r[3]) == way;
}

/* Do 01 and 23 surely cross, and no disc hold 0 and 1 that holds neither 2 nor 3? */
static bool surely_crossed(const dyd_rect r[4]) {
  dyd_sure way = dyd_orientation(&r[0], &r[1], &r[2]);
  return way != DYD_UNSURE && dyd_orientation(&r[1], &r[0], &r[3]) == way &&
         dyd_orientation(&r[3], &r[2], &r[0]) == way && dyd_orientation(&r[2], &r[3], &r[1]) == way &&
         dyd_con(&r[3], &r[0], &r[1], &r[2]) == DYD_SURE_PLUS;
}

/* Looks for points that show that the pair is never legal. */
static void settling_part(const settling *s, dyd_settled_pair *p) {
  dyd_settle_cut cut;
  dyd_rect r[4];
  size_t i = settling_place(s, p->i), j = settling_place(s, p->j);
  if (!dyd_filter_find_cut(&cut, s->guess, s->site.count, i, j)) return;
  for (int k = 0; k < 4; k++) {
    dyd_rect_init(&r[k]);
    settling_choose(&r[k], s, cut.site[k], cut.at[k]);
  }
  p->unsure = cut.inside ? surely_inside(r) : surely_crossed(r);
  for (int k = 0; k < 4; k++) dyd_rect_clear(&r[k]);
}

/* ---- a choice for all pairs ---- */

static dyd_status settling_add_site(dyd_sites *sites, const settling *s, size_t k) {
  dyd_rect r;
  dyd_rect_init(&r);
  settling_choose(&r, s, k, s->guess[k].at);
  dyd_status st = dyd_sites_add_rect(sites, &r);
  dyd_rect_clear(&r);
  return st;
}

/* What the choice tells about a pair. */
static dyd_status settling_look(dyd_settled_pair *p, const settling *s, const dyd_delaunay *pd) {
  uint32_t a = (uint32_t)settling_place(s, p->i), b = (uint32_t)settling_place(s, p->j);
  if (dyd_delaunay_alias(pd, a) == dyd_delaunay_alias(pd, b)) return DYD_OK;
  dyd_pair_status status = dyd_delaunay_status(pd, a, b);
  p->unsure = p->unsure || status == DYD_ILLEGAL;
  if (status != DYD_LEGAL || p->possible) return DYD_OK;
  dyd_index_list met = {0};
  dyd_point c;
  dyd_point_init(&c);
  dyd_status st = dyd_delaunay_witness(&c, pd, a, b);
  if (st == DYD_OK) st = disc_joins(&p->possible, &met, s, &c, p);
  dyd_point_clear(&c);
  dyd_index_list_clear(&met);
  return st == DYD_E_RANGE ? DYD_OK : st; /* no witness was found */
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
    if (dyd_pair_is_settled(&s->pair[k])) continue;
    st = settling_look(&s->pair[k], s, pd);
    s->left -= dyd_pair_is_settled(&s->pair[k]);
  }
  settling_spend(s);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return st;
}

static dyd_status settling_try_all(settling *s, uint64_t *random) {
  dyd_filter_choose_middles(s->guess, s->site.count);
  dyd_status st = settling_try(s);
  for (int k = 0; st == DYD_OK && s->left && *s->work && k < RANDOM; k++) {
    dyd_filter_choose_any(s->guess, s->site.count, random);
    st = settling_try(s);
  }
  return st;
}

/* ---- one pair after the other ---- */

static dyd_status settling_do_pair(settling *s, dyd_settled_pair *p, bool thorough) {
  dyd_status st = p->possible ? DYD_OK : settling_join(s, p, thorough);
  if (st == DYD_OK && !p->unsure && !thorough) settling_part(s, p);
  s->left -= dyd_pair_is_settled(p);
  settling_spend(s);
  return st == DYD_OK && dyd_flag_get(&s->e->stop) ? DYD_CANCELLED : st;
}

static dyd_status settling_run(settling *s, uint64_t *random) {
  dyd_status st = settling_try_all(s, random);
  for (size_t k = 0; st == DYD_OK && s->left && *s->work && k < 2 * s->pairs; k++) {
    dyd_settled_pair *p = &s->pair[k % s->pairs];
    if (!dyd_pair_is_settled(p)) st = settling_do_pair(s, p, k >= s->pairs);
  }
  return st;
}

/* The sites of the face and their legal neighbours. */
static dyd_status settling_begin(settling *s, const dyd_index_list *face) {
  dyd_status st = settling_append(s, face);
  for (size_t k = 0; st == DYD_OK && k < face->count; k++) {
    dyd_index_list ring = {0};
    st = dyd_delaunay_neighbours(&ring, s->e->pd, face->item[k], DYD_LEGAL);
    if (st == DYD_OK) st = settling_append(s, &ring);
    dyd_index_list_clear(&ring);
  }
  return st == DYD_OK ? settling_take_rects(s) : st;
}

dyd_status dyd_settle_face(dyd_settled_pair *pair, uint64_t *random, size_t *work, const dyd_engine *e, size_t pairs,
                           const dyd_index_list *face) {
  settling s = {.e = e, .pair = pair, .pairs = pairs, .left = pairs, .work = work};
  dyd_status st = settling_begin(&s, face);
  if (st == DYD_OK && s.mixed) st = settling_run(&s, random);
  settling_clear(&s);
  return st;
}
