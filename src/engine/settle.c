/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs that stay indeterminate whatever is refined [SET-1] [SET-2] [SET-4].
 *
 * A side of a rectangle may have a core, an interval that no refinement leaves [SET-3]: all of a fixed side, and what
 * is within the radius of every place that the centre of a side may have. Let no two points of a rectangle that differ
 * along sides without a core be farther apart than eps. A site is firm if both its sides have cores wider than 2 eps.
 * Pairs of firm sites: all sites are triangulated once, the firm ones with their cores less eps on each side, the
 * others with any place along each side without a core. A pair that is neither legal nor illegal there is so wherever
 * these points are. Other pairs are examined one by one; those of places that are proved to be on one circle or line,
 * together. */
#include "engine/settle.h"

#include "base/alloc.h"
#include "base/index.h"
#include "base/local.h"
#include "delaunay/disc_filter.h"
#include "delaunay/index_list.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "dyadic/raw.h"
#include "engine/points.h"
#include "engine/settle_filter.h"
#include "rect/rect.h"

#include <dyadel/predicate.h>
#include <stdlib.h>

/* Pairs of one face: pairs that stay open wherever the points are that can be narrowed [SET-1].
 *
 * A side has a core, which no refinement leaves, or can be narrowed to any point of it. A disc to which both ends may
 * reach along their cores, wherever they are along the others, while no other site has to meet it, makes a pair
 * possible for good. Points of both ends that four points show to be in no disc of their own, make it never legal. */

/* Numbers of the sites that have a point in common with one, whatever is narrowed. */
typedef struct settled_touch {
  bool known;
  dyd_index_list with;
  size_t cap;
} settled_touch;

/* site: sites of the face and their legal neighbours, ascending; rect, guess, touch: one for each of them; pair: pairs
 * examined; work: the work left for all faces. */
typedef struct settling {
  const dyd_engine *e;
  dyd_index_list site;
  size_t cap; /* of site */
  dyd_rect *rect;
  dyd_settle_site *guess;
  settled_touch *touch;
  dyd_settled_pair *pair;
  size_t pairs;
  dyd_settle_work *work;
  const dyd_settled *known; /* has the prover of circles; or NULL */
  bool mixed;               /* some side has a core that is no point */
} settling;

static void settling_drop_rects(settling *s) {
  for (size_t k = 0; s->rect && k < s->site.count; k++) dyd_rect_clear(&s->rect[k]);
  for (size_t k = 0; s->touch && k < s->site.count; k++) dyd_index_list_clear(&s->touch[k].with);
  dyd_free_all(s->rect, s->guess, s->touch);
  s->rect = NULL;
  s->guess = NULL;
  s->touch = NULL;
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
  return dyd_index_list_add(&s->site, &s->cap, more->item, more->count);
}

static bool settling_is_round(const settling *s) {
  return s->known && s->known->discs;
}

/* Sets *r, and core or disc of *guess: where points are in discs, *r is all of the rectangle, without a core, unless it
 * is a point. */
static dyd_status settling_core(dyd_rect *r, dyd_settle_site *guess, const settling *s, uint32_t site) {
  if (!settling_is_round(s)) return dyd_site_get_core(r, guess->core, s->e, site);
  dyd_status st = dyd_sites_get(r, s->e->sites, site);
  guess->core[0] = guess->core[1] = st == DYD_OK && dyd_rect_is_point(r);
  return st == DYD_OK ? dyd_disc_get_core(guess->disc, s->e, site) : st;
}

/* *r becomes a point of the core of the site. */
static dyd_status site_set_point(dyd_rect *r, const dyd_settle_site *guess, const double at[2], bool farthest) {
  double z[2];
  dyd_filter_disc_point(z, guess->disc, at, farthest);
  return dyd_rect_set_d(r, z[0], z[0], z[1], z[1]);
}

/* The sites are in order, each once, with their rectangles. */
static dyd_status settling_take_rects(settling *s) {
  dyd_status st = DYD_OK;
  dyd_index_list_sort(&s->site);
  s->rect = dyd_alloc(s->site.count, sizeof *s->rect);
  s->guess = calloc(s->site.count + 1, sizeof *s->guess);
  s->touch = calloc(s->site.count + 1, sizeof *s->touch);
  for (size_t k = 0; s->rect && k < s->site.count; k++) dyd_rect_init(&s->rect[k]);
  if (!s->rect || !s->guess || !s->touch) return DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < s->site.count; k++) {
    const bool *core = s->guess[k].core;
    st = settling_core(&s->rect[k], &s->guess[k], s, s->site.item[k]);
    dyd_rect_get_d(s->guess[k].box, &s->rect[k]);
    s->mixed = s->mixed || s->guess[k].disc[2] > 0 || (core[0] && !dyd_interval_is_point(&s->rect[k].x)) ||
               (core[1] && !dyd_interval_is_point(&s->rect[k].y));
  }
  return st;
}

/* Predicates of rectangles are exact where they are close: as much as many sites in doubles. */
enum { COST_PREDICATE = 16, COST_PROOF = 1 << 12, MOST_SEEDS = 64, HELD = 8 };

static void settling_pay(const settling *s, size_t cost) {
  s->work->sites -= s->work->sites < cost ? s->work->sites : cost;
}

/* How many places of site number k stay in its rectangle, as far as is known: 1 where it closes in on a true point. */
static unsigned settling_places(const settling *s, size_t k) {
  const bool *core = s->guess[k].core;
  if (s->guess[k].disc[2] > 0) return 0;
  bool narrow[2] = {!core[0] || dyd_interval_is_point(&s->rect[k].x), !core[1] || dyd_interval_is_point(&s->rect[k].y)};
  if (narrow[0] && narrow[1]) return 1;
  return core[0] && core[1] ? DYD_REGION_PLACES : 0;
}

/* ---- sites that have a point in common ---- */

/* Returns true if the disc k holds the box of i, or meets the disc i: by more than doubles are off by. */
static bool disc_holds(const dyd_settle_site *k, const dyd_settle_site *i) {
  const double *d = k->disc, *b = i->box, *o = i->disc;
  if (!(d[2] > 0)) return false;
  if (o[2] > 0) return dyd_filter_within(d, o[0], o[1], d[2] + o[2]);
  bool in = true;
  for (int n = 0; n < 4; n++) in = in && dyd_filter_within(d, b[n & 1], b[2 + n / 2], d[2]);
  return in;
}

/* Returns true if site number k has a core along both sides in which all of site i is, or which meets the core of i. */
static bool core_holds(const settling *s, size_t k, size_t i) {
  if (settling_is_round(s)) return disc_holds(&s->guess[k], &s->guess[i]);
  const bool *of_i = s->guess[i].core, *of_k = s->guess[k].core;
  const double *a = s->guess[i].box, *b = s->guess[k].box;
  if (!of_k[0] || !of_k[1] || a[1] < b[0] || b[1] < a[0] || a[3] < b[2] || b[3] < a[2]) return false;
  return of_i[0] && of_i[1] ? dyd_rect_meets(&s->rect[i], &s->rect[k]) : dyd_rect_contains(&s->rect[k], &s->rect[i]);
}

/* Sets *out to whether sites number k and n have a point in common, whatever is narrowed: their cores show it, or it is
 * proved of regions of which one touches the other. */
static dyd_status settling_touch(bool *out, settling *s, size_t k, size_t n) {
  const double *a = s->guess[k].box, *b = s->guess[n].box;
  *out = core_holds(s, k, n) || core_holds(s, n, k);
  bool apart = a[1] < b[0] || b[1] < a[0] || a[3] < b[2] || b[3] < a[2];
  if (*out || apart || !s->known || !s->known->prover.meet || !s->work->proofs) return DYD_OK;
  s->work->proofs--;
  settling_pay(s, COST_PROOF);
  const uint32_t site[2] = {s->site.item[k], s->site.item[n]};
  return s->known->prover.meet(out, s->known->prover.user, site, settling_is_round(s));
}

/* Lists the sites that have a point in common with number i. */
static dyd_status settling_touches(const dyd_index_list **out, settling *s, size_t i) {
  settled_touch *t = &s->touch[i];
  dyd_status st = DYD_OK;
  for (uint32_t k = 0; st == DYD_OK && !t->known && k < s->site.count; k++) {
    bool touch = false;
    if (k != i) st = settling_touch(&touch, s, i, k);
    if (st == DYD_OK && touch) st = dyd_index_list_add(&t->with, &t->cap, &k, 1);
  }
  t->known = true;
  *out = &t->with;
  return st;
}

/* Sets *out to whether another site but number j has a point in common with number i, whatever is narrowed: no disc
 * holds all of the one and nothing of the other. */
static dyd_status settling_meets(bool *out, settling *s, size_t i, size_t j) {
  const dyd_index_list *with;
  dyd_status st = settling_touches(&with, s, i);
  *out = with->count > 1 || (with->count == 1 && with->item[0] != j);
  return st;
}

/* ---- a disc that joins ---- */

/* a becomes its end that is farther from v. */
static dyd_status side_set_far(dyd_interval *a, const dyd_dyadic *v) {
  if (dyd_interval_is_point(a)) return DYD_OK;
  DYD_LOCAL(dyd_dyadic, sum);
  DYD_LOCAL_NUMBERS(mpz, twice, one);
  mpz_set_ui(one, 1);
  mpz_mul_2exp(twice, a->den, 1);
  dyd_status st = dyd_dyadic_add(&sum, &a->lo, &a->hi);
  if (st == DYD_OK) dyd_interval_set_over(a, dyd_raw_cmp(v, twice, &sum, one) > 0 ? &a->lo : &a->hi, a->den);
  return st;
}

/* The square of the distance from c to the point of r that is nearest to c along x (near[0]) and y (near[1]), or else
 * farthest. */
static dyd_status rect_reach2(mpq_t out, const dyd_point *c, const dyd_rect *r, const bool near[2]) {
  DYD_LOCAL(dyd_rect, s);
  dyd_rect_set(&s, r);
  dyd_status st = near[0] ? DYD_OK : side_set_far(&s.x, &c->x);
  if (st == DYD_OK && !near[1]) st = side_set_far(&s.y, &c->y);
  dyd_rect_ds2(out, c, &s);
  return st;
}

/* Sets *out to whether a point of site k is outside the disc (c, r), wherever it is along narrowable sides. */
static dyd_status disc_spares(bool *out, const settling *s, const dyd_point *c, const mpq_t radius2, uint32_t k) {
  dyd_settle_site guess = {.absent = false};
  DYD_LOCAL_NUMBERS(mpq, far2);
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = settling_core(&r, &guess, s, k);
  const double at[2] = {dyd_dyadic_get_d(&c->x, DYD_DOWN), dyd_dyadic_get_d(&c->y, DYD_DOWN)};
  if (st == DYD_OK && guess.disc[2] > 0) st = site_set_point(&r, &guess, at, true);
  const bool near[2] = {!guess.core[0], !guess.core[1]};
  if (st == DYD_OK) st = rect_reach2(far2, c, &r, near);
  *out = st == DYD_OK && mpq_cmp(far2, radius2) >= 0;
  return st;
}

/* The square of the distance from c to the point of an end that is nearest along its core. */
static dyd_status end_reach2(mpq_t out, const settling *s, const dyd_point *c, size_t end) {
  const dyd_settle_site *guess = &s->guess[end];
  const double at[2] = {dyd_dyadic_get_d(&c->x, DYD_DOWN), dyd_dyadic_get_d(&c->y, DYD_DOWN)};
  if (!(guess->disc[2] > 0)) return rect_reach2(out, c, &s->rect[end], guess->core);
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = site_set_point(&r, guess, at, false);
  dyd_rect_ds2(out, c, &r);
  return st;
}

/* Marks the sites that hold an end which is one point, for a disc with these ends; *any: there are some. */
static dyd_status settling_hold(bool *any, settling *s, const size_t end[2]) {
  const dyd_index_list *with;
  dyd_status st = DYD_OK;
  *any = false;
  for (int e = 0; st == DYD_OK && e < 2; e++) {
    if (settling_places(s, end[e]) != 1) continue;
    st = settling_touches(&with, s, end[e]);
    for (size_t k = 0; k < with->count; k++) *any = s->guess[with->item[k]].absent = true;
  }
  return st;
}

/* Sets *out to whether c is near enough to a centre as far from one end as from the other, both points, for a disc with
 * a radius larger by 2^-41 of it to hold all that the disc around that centre does; radius2 becomes that of this disc.
 */
static bool disc_is_even(mpq_t radius2, const settling *s, const dyd_point *c, const size_t end[2]) {
  double lo, hi;
  DYD_LOCAL_NUMBERS(mpq, off, most, least, apart);
  for (int e = 0; e < 2; e++) {
    dyd_rect_dl2(most, c, &s->rect[end[e]]);
    dyd_rect_ds2(least, c, &s->rect[end[!e]]);
    mpq_sub(most, most, least);
    if (mpq_cmp(most, off) > 0) mpq_swap(most, off);
  }
  dyd_rect_distance(&lo, &hi, &s->rect[end[0]], &s->rect[end[1]]);
  mpq_set_d(apart, lo);
  mpq_mul(apart, apart, apart);
  mpq_mul(apart, apart, radius2);
  mpq_mul(off, off, off);
  mpq_mul_2exp(off, off, 84);
  bool even = mpq_cmp(off, apart) <= 0;
  mpq_div_2exp(most, radius2, 40);
  mpq_add(radius2, radius2, most);
  return even;
}

/* The same for one end that is a point: it is the farther one. */
static dyd_status disc_leans(bool *out, const settling *s, const dyd_point *c, size_t beside, size_t other) {
  DYD_LOCAL_NUMBERS(mpq, least, most);
  dyd_rect_ds2(least, c, &s->rect[beside]);
  dyd_status st = end_reach2(most, s, c, other);
  *out = st == DYD_OK && mpq_cmp(most, least) <= 0;
  return st;
}

/* Sets *out to whether a disc around c shows that ends, or two sites that hold points of these, are possible, wherever
 * points are that can be narrowed. *met: the sites that meet it. held: sites were marked that need not be outside. */
static dyd_status disc_joins(bool *out, dyd_index_list *met, const settling *s, const dyd_point *c, const size_t end[2],
                             bool held) {
  dyd_status st = DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, radius2, other);
  for (int k = 0; st == DYD_OK && k < 2; k++) {
    st = end_reach2(other, s, c, end[k]);
    if (mpq_cmp(other, radius2) > 0) mpq_swap(other, radius2);
  }
  *out = st == DYD_OK;
  bool point = settling_places(s, end[0]) == 1;
  if (st == DYD_OK && held && point && settling_places(s, end[1]) == 1)
    *out = disc_is_even(radius2, s, c, end);
  else if (st == DYD_OK && held)
    st = disc_leans(out, s, c, end[!point], end[point]);
  if (st == DYD_OK && *out) st = dyd_delaunay_meet_disc(met, s->e->pd, c, radius2);
  for (size_t k = 0; st == DYD_OK && *out && k < met->count; k++) {
    size_t at = settling_place(s, met->item[k]);
    if (at == end[0] || at == end[1] || (at != SIZE_MAX && s->guess[at].absent)) continue;
    st = disc_spares(out, s, c, radius2, met->item[k]);
  }
  return st;
}

/* Examines the disc around a guess; where others than the sites meet it, these become more. */
static dyd_status settling_join_at(settling *s, dyd_settled_pair *p, const double at[2], const size_t end[2],
                                   bool held) {
  DYD_SCOPED(dyd_index_list) met = {0};
  DYD_LOCAL(dyd_point, c);
  dyd_status st = dyd_dyadic_set_d(&c.x, at[0]);
  if (st == DYD_OK) st = dyd_dyadic_set_d(&c.y, at[1]);
  if (st == DYD_OK) st = disc_joins(&p->possible, &met, s, &c, end, held);
  if (st == DYD_OK && !p->possible && met.count) {
    settling_drop_rects(s);
    st = settling_append(s, &met);
    if (st == DYD_OK) st = settling_take_rects(s);
  }
  return st;
}

/* Guesses a centre of a disc with the ends. held: with points as ends, where sites are marked. */
static bool settling_guess(double at[2], const settling *s, const size_t end[2], bool held, bool thorough) {
  const bool point[2] = {settling_places(s, end[0]) == 1, settling_places(s, end[1]) == 1};
  bool found = dyd_filter_find_centre(at, s->guess, s->site.count, end[0], end[1], thorough);
  for (int e = 0; found && held && e < 2; e++)
    if (point[e]) dyd_filter_lean(at, s->guess, end[e], end[!e], point[!e] ? 0 : 0x1p-20);
  return found;
}

/* Looks for a disc for one pair: with these sites as ends. */
static dyd_status settling_join(settling *s, dyd_settled_pair *p, const uint32_t site[2], bool held, bool thorough) {
  dyd_status st = DYD_OK;
  for (size_t had = 0; st == DYD_OK && !p->possible && had < s->site.count && s->work->sites;) {
    const size_t end[2] = {settling_place(s, site[0]), settling_place(s, site[1])};
    double at[2];
    bool any = true;
    had = s->site.count;
    for (size_t k = 0; k < had; k++) s->guess[k].absent = false;
    if (held) st = settling_hold(&any, s, end);
    settling_pay(s, had);
    if (st != DYD_OK || !any || !settling_guess(at, s, end, held, thorough)) break;
    st = settling_join_at(s, p, at, end, held);
  }
  return st;
}

/* The site, and first ones of the points that it holds: their number. */
static dyd_status settling_held(uint32_t out[HELD], size_t *count, settling *s, uint32_t site) {
  const dyd_index_list *with;
  dyd_status st = settling_touches(&with, s, settling_place(s, site));
  out[0] = site;
  *count = 1;
  for (size_t k = 0; st == DYD_OK && k < with->count && *count < HELD; k++)
    if (settling_places(s, with->item[k]) == 1) out[(*count)++] = s->site.item[with->item[k]];
  return st;
}

/* Looks for a disc for a pair whose ends have a point in common with others: an end, or another site, at such a point
 * is in no way. */
static dyd_status settling_join_held(settling *s, dyd_settled_pair *p) {
  uint32_t a[HELD], b[HELD];
  size_t as, bs;
  dyd_status st = settling_held(a, &as, s, p->i);
  if (st == DYD_OK) st = settling_held(b, &bs, s, p->j);
  for (size_t k = 0; st == DYD_OK && !p->possible && k < as * bs; k++) {
    const uint32_t site[2] = {a[k / bs], b[k % bs]};
    if (site[0] != site[1]) st = settling_join(s, p, site, true, true);
  }
  return st;
}

/* ---- points that part ---- */

/* The point of a, not a point, that is nearest to the double. */
static void choose_on_side(dyd_interval *out, const dyd_interval *a, double at) {
  const dyd_dyadic *end = &a->lo;
  if (dyd_interval_set_d(out, at, at) == DYD_OK) {
    if (dyd_interval_contains(a, out)) return;
    if (dyd_raw_cmp(&out->lo, a->den, &a->hi, out->den) > 0) end = &a->hi;
  }
  dyd_interval_set_over(out, end, a->den);
}

/* Site number k of the face: its point nearest to `at` along the sides where that can be chosen. */
static void settling_choose(dyd_rect *out, const settling *s, size_t k, const double at[2]) {
  dyd_rect_set(out, &s->rect[k]);
  const bool *core = s->guess[k].core;
  if (s->guess[k].disc[2] > 0 && site_set_point(out, &s->guess[k], at, false) != DYD_OK) dyd_rect_set(out, &s->rect[k]);
  if (core[0] && !dyd_interval_is_point(&out->x)) choose_on_side(&out->x, &s->rect[k].x, at[0]);
  if (core[1] && !dyd_interval_is_point(&out->y)) choose_on_side(&out->y, &s->rect[k].y, at[1]);
}

/* Returns true if r[3] is certainly among the three others. */
static bool surely_inside(const dyd_rect r[4]) {
  dyd_sure way = dyd_orientation(&r[0], &r[1], &r[2]);
  return way != DYD_UNSURE && dyd_orientation(&r[0], &r[1], &r[3]) == way &&
         dyd_orientation(&r[1], &r[2], &r[3]) == way && dyd_orientation(&r[2], &r[0], &r[3]) == way;
}

/* Returns true if 01 and 23 certainly cross, and no disc holds 0 and 1 that holds neither 2 nor 3. */
static bool surely_crossed(const dyd_rect r[4]) {
  dyd_sure way = dyd_orientation(&r[0], &r[1], &r[2]);
  return way != DYD_UNSURE && dyd_orientation(&r[1], &r[0], &r[3]) == way &&
         dyd_orientation(&r[3], &r[2], &r[0]) == way && dyd_orientation(&r[2], &r[3], &r[1]) == way &&
         dyd_con(&r[3], &r[0], &r[1], &r[2]) == DYD_SURE_PLUS;
}

/* Looks for points that show that the pair is never legal. */
static dyd_status settling_part(settling *s, dyd_settled_pair *p) {
  dyd_settle_cut cut;
  size_t i = settling_place(s, p->i), j = settling_place(s, p->j);
  dyd_status st = settling_meets(&p->unsure, s, i, j);
  if (st == DYD_OK && !p->unsure) st = settling_meets(&p->unsure, s, j, i);
  if (st != DYD_OK || p->unsure || !dyd_filter_find_cut(&cut, s->guess, s->site.count, i, j)) return st;
  DYD_LOCAL_ARRAY(dyd_rect, r, [4]);
  for (int k = 0; k < 4; k++) settling_choose(&r[k], s, cut.site[k], cut.at[k]);
  p->unsure = cut.inside ? surely_inside(r) : surely_crossed(r);
  return DYD_OK;
}

/* ---- one pair after the other ---- */

static dyd_status settling_do_pair(settling *s, dyd_settled_pair *p, bool thorough) {
  dyd_status st = settling_join(s, p, (const uint32_t[2]){p->i, p->j}, false, thorough);
  if (st == DYD_OK && thorough && !p->possible) st = settling_join_held(s, p);
  if (st == DYD_OK && !p->unsure && !thorough) st = settling_part(s, p);
  settling_pay(s, s->site.count);
  return st == DYD_OK && dyd_flag_get(&s->e->stop) ? DYD_CANCELLED : st;
}

static dyd_status settling_run(settling *s) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && s->work->sites && k < 2 * s->pairs; k++) {
    dyd_settled_pair *p = &s->pair[k % s->pairs];
    if (!dyd_pair_is_settled(p)) st = settling_do_pair(s, p, k >= s->pairs);
  }
  return st;
}

/* ---- circles and lines that are proved [SET-4] ---- */

/* A circle through the first three members, or a line through two: sites of the face, and which place of the region of
 * each is meant; at: a rectangle that holds it. */
typedef struct settled_circle {
  bool line;
  size_t count;
  size_t *member;
  unsigned *place;
  dyd_rect *at;
} settled_circle;

static dyd_site_place settling_site(const settling *s, size_t k, unsigned place) {
  return (dyd_site_place){s->site.item[k], place};
}

/* Puts a place of site number k behind the members. */
static dyd_status circle_put(settled_circle *c, const settling *s, size_t k, unsigned place) {
  const dyd_site_place at = settling_site(s, k, place);
  const dyd_prover *by = &s->known->prover;
  c->member[c->count] = k;
  c->place[c->count] = place;
  dyd_rect_set(&c->at[c->count], &s->rect[k]);
  return settling_places(s, k) > 1 ? by->place(&c->at[c->count], by->user, &at) : DYD_OK;
}

/* The last place, behind the members, may be on the circle. */
static bool may_be_on(const settling *s, const settled_circle *c) {
  const dyd_rect *a = &c->at[0], *b = &c->at[1], *r = &c->at[c->count];
  settling_pay(s, COST_PREDICATE);
  if (c->line) return dyd_orientation(a, b, r) == DYD_UNSURE;
  return dyd_con(r, a, b, &c->at[2]) == DYD_UNSURE;
}

/* Sets *on to whether the place behind the members is proved to be on the circle with the first three, on the line with
 * the first two. */
static dyd_status circle_prove(bool *on, const settling *s, const settled_circle *c) {
  const dyd_prover *by = &s->known->prover;
  dyd_site_place site[4];
  size_t first = c->line ? 2 : 3;
  bool roams = false;
  for (size_t k = 0; k <= first; k++) {
    size_t m = k < first ? k : c->count;
    site[k] = settling_site(s, c->member[m], c->place[m]);
    roams = roams || settling_places(s, c->member[m]) > 1;
  }
  *on = false;
  if (roams && s->work->proofs == 0) return DYD_OK;
  s->work->proofs -= roams;
  settling_pay(s, COST_PROOF);
  return by->prove_places(on, by->user, c->line ? DYD_COLLINEAR : DYD_COCIRCULAR, site, first + 1);
}

/* Adds all sites that are proved to be on the circle, by one of their places: number `first` of them is tried first. */
static dyd_status circle_fill(settled_circle *c, const settling *s, unsigned first) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < s->site.count && s->work->sites; k++) {
    bool member = false, on = false;
    for (size_t m = 0; m < (c->line ? 2 : 3); m++) member = member || c->member[m] == k;
    unsigned places = settling_places(s, k);
    for (unsigned at = 0; st == DYD_OK && !member && !on && at < places; at++) {
      st = circle_put(c, s, k, (first + at) % places);
      if (st == DYD_OK && may_be_on(s, c)) st = circle_prove(&on, s, c);
      c->count += on;
    }
  }
  return st;
}

/* Returns true if all of r is certainly on the side `way` of the line, or, whatever way is, outside of the circle. */
static bool surely_beside(const settled_circle *c, dyd_sure way, const dyd_rect *r) {
  if (c->line) return dyd_orientation(&c->at[0], &c->at[1], r) == way;
  return dyd_con(r, &c->at[0], &c->at[1], &c->at[2]) == DYD_SURE_MINUS;
}

/* The same for some choice along the cores of r: its corners are tried. */
static bool core_is_beside(const settled_circle *c, dyd_sure way, const dyd_rect *r, const bool core[2]) {
  bool found = false;
  DYD_LOCAL(dyd_rect, q);
  for (int k = 0; k < 4 && !found; k++) {
    dyd_rect_set(&q, r);
    if (core[0]) dyd_interval_set_over(&q.x, k & 1 ? &r->x.hi : &r->x.lo, r->x.den);
    if (core[1]) dyd_interval_set_over(&q.y, k & 2 ? &r->y.hi : &r->y.lo, r->y.den);
    found = surely_beside(c, way, &q);
  }
  return found;
}

/* The number of the member that is the site; its count: none is. */
static size_t circle_find(const settling *s, const settled_circle *c, uint32_t site) {
  size_t m = 0;
  while (m < c->count && s->site.item[c->member[m]] != site) m++;
  return m;
}

/* Need no site but members be inside of the circle, or beyond the line from the side `way`? */
static dyd_status circle_is_empty(bool *out, const settling *s, const settled_circle *c, dyd_sure way) {
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_rect, r);
  *out = true;
  for (uint32_t k = 0; st == DYD_OK && *out && k < dyd_sites_count(s->e->sites); k++) {
    dyd_settle_site guess = {.absent = false};
    if (dyd_delaunay_alias(s->e->pd, k) != k || circle_find(s, c, k) < c->count) continue;
    settling_pay(s, 1);
    st = settling_core(&r, &guess, s, k);
    *out = st == DYD_OK && core_is_beside(c, way, &r, guess.core);
  }
  return st;
}

static bool surely_before(const dyd_interval *a, const dyd_interval *b) {
  return dyd_raw_cmp(&a->hi, b->den, &b->lo, a->den) < 0;
}

/* Returns true if b is between a and c, all on one line. */
static bool surely_between(const dyd_rect *a, const dyd_rect *b, const dyd_rect *c) {
  return (surely_before(&a->x, &b->x) && surely_before(&b->x, &c->x)) ||
         (surely_before(&c->x, &b->x) && surely_before(&b->x, &a->x)) ||
         (surely_before(&a->y, &b->y) && surely_before(&b->y, &c->y)) ||
         (surely_before(&c->y, &b->y) && surely_before(&b->y, &a->y));
}

/* Returns true if no disc holds members number i and j without another one. */
static bool circle_parts(const settled_circle *c, size_t i, size_t j) {
  bool left = false, right = false;
  for (size_t m = 0; m < c->count && !(left && right); m++) {
    if (m == i || m == j) continue;
    dyd_sure way = c->line ? DYD_UNSURE : dyd_orientation(&c->at[i], &c->at[j], &c->at[m]);
    bool between = c->line && surely_between(&c->at[i], &c->at[m], &c->at[j]);
    left = left || between || way == DYD_SURE_PLUS;
    right = right || between || way == DYD_SURE_MINUS;
  }
  return left && right;
}

/* Records the pairs that the circle settles. */
static dyd_status circle_tell_pairs(const settling *s, const settled_circle *c) {
  bool empty, other = false;
  dyd_status st = circle_is_empty(&empty, s, c, DYD_SURE_PLUS);
  if (st == DYD_OK && c->line && !empty) st = circle_is_empty(&other, s, c, DYD_SURE_MINUS);
  for (size_t k = 0; st == DYD_OK && k < s->pairs; k++) {
    dyd_settled_pair *p = &s->pair[k];
    size_t i = circle_find(s, c, p->i), j = circle_find(s, c, p->j);
    if (dyd_pair_is_settled(p) || i == c->count || j == c->count) continue;
    p->possible = p->possible || empty || other;
    p->unsure = p->unsure || circle_parts(c, i, j);
  }
  return st;
}

/* Tries the circle, or line, through the sites: through that place of each which has a region. */
static dyd_status settling_circle(settling *s, settled_circle *c, const size_t site[3], unsigned place) {
  dyd_status st = DYD_OK;
  for (c->count = 0; st == DYD_OK && c->count < 3; c->count += st == DYD_OK)
    st = circle_put(c, s, site[c->count], settling_places(s, site[c->count]) > 1 ? place : 0);
  if (st != DYD_OK) return st;
  c->line = dyd_orientation(&c->at[0], &c->at[1], &c->at[2]) == DYD_UNSURE;
  size_t first = c->count = c->line ? 2 : 3;
  st = circle_fill(c, s, place);
  if (st == DYD_OK && c->count > first) st = circle_tell_pairs(s, c);
  return st == DYD_OK && dyd_flag_get(&s->e->stop) ? DYD_CANCELLED : st;
}

/* Tries the circles, or lines, through both ends of a pair and another site. */
static dyd_status settling_circle_pair(settling *s, settled_circle *c, const dyd_settled_pair *p, unsigned places) {
  size_t site[3] = {settling_place(s, p->i), settling_place(s, p->j), 0}, seeds = 0;
  dyd_status st = DYD_OK;
  if (!settling_places(s, site[0]) || !settling_places(s, site[1])) return DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < s->site.count && seeds < MOST_SEEDS; k++) {
    if (k == site[0] || k == site[1] || !settling_places(s, k)) continue;
    seeds++;
    site[2] = k;
    for (unsigned at = 0; st == DYD_OK && at < (s->work->proofs ? places : 1) && s->work->sites; at++)
      if (!dyd_pair_is_settled(p)) st = settling_circle(s, c, site, at);
  }
  return st;
}

static void circle_clear(settled_circle *c, size_t most) {
  for (size_t k = 0; c->at && k < most; k++) dyd_rect_clear(&c->at[k]);
  dyd_free_all(c->at, c->place, c->member);
}

/* most: the members there may be, and one more that is tried. */
static dyd_status circle_init(settled_circle *c, size_t most) {
  *c = (settled_circle){.member = dyd_alloc(most, sizeof *c->member),
                        .place = dyd_alloc(most, sizeof *c->place),
                        .at = dyd_alloc(most, sizeof *c->at)};
  for (size_t k = 0; c->at && k < most; k++) dyd_rect_init(&c->at[k]);
  return c->member && c->place && c->at ? DYD_OK : DYD_E_NOMEM;
}

static dyd_status settling_circles(settling *s) {
  settled_circle c;
  size_t most = s->site.count + 1;
  unsigned places = 1;
  dyd_status st = circle_init(&c, most);
  for (size_t k = 0; k < s->site.count; k++)
    if (settling_places(s, k) > places) places = settling_places(s, k);
  for (size_t k = 0; st == DYD_OK && k < s->pairs; k++)
    if (!dyd_pair_is_settled(&s->pair[k])) st = settling_circle_pair(s, &c, &s->pair[k], places);
  circle_clear(&c, most);
  return st;
}

/* The sites of the face and their legal neighbours. */
static dyd_status settling_begin(settling *s, const dyd_index_list *face) {
  dyd_status st = settling_append(s, face);
  for (size_t k = 0; st == DYD_OK && k < face->count; k++) {
    DYD_SCOPED(dyd_index_list) ring = {0};
    st = dyd_delaunay_neighbours(&ring, s->e->pd, face->item[k], DYD_LEGAL);
    if (st == DYD_OK) st = settling_append(s, &ring);
  }
  return st == DYD_OK ? settling_take_rects(s) : st;
}

dyd_status dyd_settle_face(dyd_settled_pair *pair, dyd_settle_work *work, const dyd_settled *known, const dyd_engine *e,
                           size_t pairs, const dyd_index_list *face) {
  DYD_SCOPED(settling) s = {.e = e, .pair = pair, .pairs = pairs, .work = work, .known = known};
  dyd_status st = settling_begin(&s, face);
  if (st == DYD_OK && s.mixed) st = settling_run(&s);
  if (st == DYD_OK && s.mixed && known && known->prover.prove) st = settling_circles(&s);
  return st;
}

/* From this many bits on pairs without a radius are worth a look; how many sites may be examined in all, for each site
 * and besides. In the armed build coarse points are examined. */
#ifdef DYD_ARMED

enum { FIRST_BITS = 2 };

#else

enum { FIRST_BITS = 128 };

#endif

enum { WORK_PER_SITE = 4, WORK = 1 << 23, PROOFS = 512 };

void dyd_settled_clear(dyd_settled *s) {
  free(s->item);
  *s = (dyd_settled){0};
}

/* ---- pairs settled ---- */

bool dyd_is_settled(const dyd_settled *s, const dyd_pair *pair) {
  const dyd_settled_pair *p = dyd_find_two(pair, s->item, s->count, sizeof *p);
  return p && dyd_pair_is_settled(p);
}

/* Sorts the pairs, new ones from `sorted` on, and joins the entries of each. */
static void settled_sort(dyd_settled *s) {
  size_t kept = 0;
  if (s->count) qsort(s->item, s->count, sizeof *s->item, dyd_compare_two);
  for (size_t k = 0; k < s->count; k++) {
    dyd_settled_pair *last = kept ? &s->item[kept - 1] : NULL;
    if (last && dyd_compare_two(last, &s->item[k]) == 0) {
      last->possible = last->possible || s->item[k].possible;
      last->unsure = last->unsure || s->item[k].unsure;
    } else {
      s->item[kept++] = s->item[k];
    }
  }
  s->count = kept;
}

/* ---- pairs of firm sites ---- */

/* Settles pairs of firm sites, by all sites. */
static dyd_status settle_firm(dyd_settled_pair *pair, size_t pairs, const dyd_wants *wants, const dyd_dyadic *eps) {
  const dyd_engine *e = wants->e;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = wants->o->max_pairs, .cancel = &e->stop,
                                  .threads = wants->o->threads, .no_filter = wants->o->no_filter};
  DYD_OWNED(dyd_delaunay) *pd = NULL;
  size_t sites = dyd_sites_count(e->sites);
  dyd_firm_sites cores = {e, eps, dyd_alloc(sites, sizeof *cores.firm), NULL};
  dyd_status st = cores.firm ? dyd_delaunay_made(&pd, sites, dyd_firm_rect, &cores, &o, NULL) : DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < pairs; k++) {
    dyd_pair_status status = dyd_delaunay_status(pd, pair[k].i, pair[k].j);
    pair[k].possible = pair[k].possible || status != DYD_ILLEGAL;
    pair[k].unsure = pair[k].unsure || status != DYD_LEGAL;
  }
  free(cores.firm);
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* ---- faces ---- */

/* Returns true if one of the sites is a point that can be narrowed. */
static bool any_can_narrow(const dyd_engine *e, const dyd_index_list *site) {
  for (size_t k = 0; k < site->count; k++) {
    const dyd_refinable *p = dyd_engine_find(e, site->item[k]);
    if (p && !p->final) return true;
  }
  return false;
}

/* Returns true if the list has another status for the pair; NULL has none. */
static bool is_decided(const dyd_pair_list *list, const dyd_pair *pair) {
  const dyd_pair *p = list ? dyd_find_two(pair, list->item, list->count, sizeof *p) : NULL;
  return list && (!p || p->status != DYD_INDETERMINATE);
}

/* Appends the indeterminate pairs of face f that are not settled: those of firm sites, or all. */
static dyd_status take_pairs(dyd_settled *out, const dyd_settled *known, const dyd_engine *e, const dyd_dyadic *eps,
                             size_t f, bool firm) {
  DYD_SCOPED(dyd_pair_list) all = {0};
  dyd_status st = dyd_delaunay_face_pairs(&all, e->pd, f);
  if (st == DYD_OK && !DYD_GROW(out->item, out->cap, out->count + all.count)) st = DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < all.count; k++) {
    const dyd_pair *pair = &all.item[k];
    const dyd_settled_pair *old = dyd_find_two(pair, known->item, known->count, sizeof *old);
    bool both;
    if (pair->status != DYD_INDETERMINATE || is_decided(known->discs, pair) || (old && dyd_pair_is_settled(old)))
      continue;
    st = dyd_firm_pair(&both, e, eps, pair);
    if (both || !firm) out->item[out->count++] = old ? *old : (dyd_settled_pair){pair->i, pair->j, false, false};
  }
  return st;
}

/* Takes pairs of face f, if a point of it can be narrowed; unless only those of firm sites are taken, examines them. */
static dyd_status settle_face_pairs(dyd_settled *fresh, dyd_settled *s, dyd_settle_work *work, const dyd_engine *e,
                                    const dyd_dyadic *eps, size_t f, bool firm) {
  size_t first = fresh->count;
  DYD_SCOPED(dyd_index_list) face = {0};
  bool outer;
  dyd_status st = dyd_delaunay_face(&face, &outer, e->pd, f);
  if (st == DYD_OK && any_can_narrow(e, &face)) st = take_pairs(fresh, s, e, eps, f, firm);
  if (st == DYD_OK && !firm && fresh->count > first)
    st = dyd_settle_face(&fresh->item[first], work, s, e, fresh->count - first, &face);
  return st;
}

/* The most bits that a point which can be narrowed was asked for. */
static int64_t most_bits(const dyd_engine *e) {
  int64_t most = INT64_MIN;
  for (size_t k = 0; k < e->points; k++)
    if (e->point[k].asked && !e->point[k].final && e->point[k].bits > most) most = e->point[k].bits;
  return most;
}

/* Moves the entries of `fresh`. */
static dyd_status settled_append(dyd_settled *s, dyd_settled *fresh) {
  if (!DYD_GROW(s->item, s->cap, s->count + fresh->count)) return DYD_E_NOMEM;
  for (size_t k = 0; k < fresh->count; k++) s->item[s->count++] = fresh->item[k];
  settled_sort(s);
  fresh->count = 0;
  return DYD_OK;
}

static dyd_status settle_pairs(dyd_settled *fresh, dyd_settled *s, const dyd_wants *wants) {
  const dyd_engine *e = wants->e;
  dyd_settle_work work = {WORK + WORK_PER_SITE * dyd_sites_count(e->sites), PROOFS};
  size_t faces = dyd_delaunay_undecided_faces(e->pd);
  DYD_LOCAL(dyd_dyadic, eps);
  dyd_status st = dyd_firm_eps(&eps, e);
  for (size_t f = 0; st == DYD_OK && f < faces && !s->discs; f++)
    st = settle_face_pairs(fresh, s, &work, e, &eps, f, true);
  if (st == DYD_OK && fresh->count) st = settle_firm(fresh->item, fresh->count, wants, &eps);
  if (st == DYD_OK) st = settled_append(s, fresh); /* what firm sites do not settle, a point at a corner may */
  for (size_t f = 0; st == DYD_OK && work.sites && f < faces; f++)
    st = settle_face_pairs(fresh, s, &work, e, &eps, f, false);
  return st;
}

/* Sets *out to whether a point that can be narrowed has a core. */
static dyd_status any_core(bool *out, const dyd_engine *e) {
  dyd_status st = DYD_OK;
  *out = false;
  DYD_LOCAL(dyd_rect, r);
  for (size_t k = 0; st == DYD_OK && !*out && k < e->points; k++) {
    bool core[2];
    if (e->point[k].final) continue;
    st = dyd_site_get_core(&r, core, e, e->point[k].site);
    *out = st == DYD_OK && core[0] && core[1];
  }
  return st;
}

/* From FIRST_BITS on, and when all pairs are examined for the first time, if radii may be what keeps them open. */
static dyd_status settle_is_due(bool *out, const dyd_settled *s, const dyd_wants *wants, int64_t bits) {
  int64_t due = s->next > FIRST_BITS ? s->next : FIRST_BITS;
  *out = bits >= due || bits >= wants->o->max_bits;
  return *out || s->next ? DYD_OK : any_core(out, wants->e);
}

dyd_status dyd_settle(dyd_settled *s, const dyd_wants *wants) {
  int64_t bits = most_bits(wants->e);
  DYD_SCOPED(dyd_settled) fresh = {0};
  bool due;
  dyd_status st = settle_is_due(&due, s, wants, bits);
  if (st != DYD_OK || !due) return st;
  s->next = dyd_bits_raised(bits, bits > 0 ? 3 * bits : 0, INT64_MAX);
  st = settle_pairs(&fresh, s, wants);
  return st == DYD_OK ? settled_append(s, &fresh) : st;
}
