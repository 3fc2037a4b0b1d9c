/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Proving that points of an engine are the same, on one line, on one circle, or equally far from a place: by what their
 * coordinates are, whatever their rectangles.
 *
 * The points of one question are described in one algebra, so that they share their leaves. All determinants have
 * points in common: the ends of a chain, three points of a polygon far apart; these are proved to be different, and not
 * on one line, before a determinant that is 0 means anything. A point that is not described proves nothing.
 *
 * A determinant proved different from 0 shows how far points have to be refined before their rectangles show it, too:
 * this is noted at the points, for the schedule. */
#include "engine/ties.h"

#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "engine/points.h"
#include "engine/settle.h"
#include "rect/rect.h"
#include "rect/sites_table.h"
#include "stream/algebra/form.h"
#include "stream/algebra/zero.h"

#include <stdlib.h>
#include <string.h>

/* Joining points that are proved to be the same place.
 *
 * Where the rectangles of two sites meet, a disc that holds one of them and avoids the other does not exist: neither
 * has a legal edge but perhaps one to the other. So, unless these are the only sites, both are in an undecided face
 * together. */

/* A described site, with its box in doubles. */
typedef struct candidate {
  double box[4];
  uint32_t site;
  bool computable; /* not an exact point */
} candidate;

/* Returns true if the engine knows a description of the point. */
static bool candidate_set(candidate *c, const dyd_engine *e, uint32_t i) {
  const dyd_refinable *p = dyd_engine_find(e, i);
  bool point = dyd_sites_is_point(e->sites, i);
  *c = (candidate){.site = i, .computable = !point};
  dyd_sites_get_d(c->box, e->sites, i);
  return point || (p && p->stream);
}

static int candidate_compare(const void *a, const void *b) {
  const candidate *x = a, *y = b;
  if (x->box[0] != y->box[0]) return x->box[0] < y->box[0] ? -1 : 1;
  return (x->site > y->site) - (x->site < y->site);
}

/* Both rectangles are one point from now on, and the higher number takes part in nothing. */
static dyd_status join_sites(dyd_engine *e, uint32_t i, uint32_t j, dyd_error *err) {
  dyd_status st = dyd_sites_join(e->sites, i, j);
  if (st == DYD_E_NESTING)
    return dyd_fail(err, st, "points %lu and %lu are given by equal numbers, and their rectangles do not meet",
                    (unsigned long)i, (unsigned long)j);
  if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
  for (size_t k = 0; k < e->points; k++) {
    dyd_refinable *p = &e->point[k];
    if (p->site != i && p->site != j) continue;
    p->measured = true;
    p->final = p->final || dyd_sites_joined(e->sites, p->site) != p->site || dyd_sites_is_point(e->sites, p->site);
  }
  return DYD_OK;
}

static dyd_status try_pair(bool *any, dyd_engine *e, const candidate *a, const candidate *b, dyd_error *err) {
  uint32_t two[2] = {a->site < b->site ? a->site : b->site, a->site < b->site ? b->site : a->site};
  bool proved = false;
  if (!a->computable && !b->computable) return DYD_OK;
  if (a->box[2] > b->box[3] || b->box[2] > a->box[3]) return DYD_OK;
  if (dyd_sites_joined(e->sites, two[0]) == dyd_sites_joined(e->sites, two[1])) return DYD_OK;
  dyd_status st = dyd_ties_prove(&proved, e, DYD_COINCIDENT, two, 2, err);
  if (st == DYD_OK && proved) st = join_sites(e, two[0], two[1], err);
  *any = *any || (st == DYD_OK && proved);
  return st;
}

/* A sweep from left to right over the described sites. */
static dyd_status try_group(bool *any, dyd_engine *e, const uint32_t *site, size_t count, dyd_error *err) {
  DYD_FREED candidate *c = dyd_alloc(count, sizeof *c);
  size_t n = 0;
  dyd_status st = c ? DYD_OK : dyd_fail_nomem(err);
  for (size_t k = 0; k < count && c; k++) n += candidate_set(&c[n], e, site[k]);
  if (c) qsort(c, n, sizeof *c, candidate_compare);
  for (size_t k = 0; k < n && st == DYD_OK; k++)
    for (size_t l = k + 1; l < n && c[l].box[0] <= c[k].box[1] && st == DYD_OK; l++)
      st = dyd_flag_get(&e->stop) ? DYD_CANCELLED : try_pair(any, e, &c[k], &c[l], err);
  return st;
}

/* Two sites without others, aliases apart, may be joined by a legal edge alone. */
static dyd_status try_last_pair(bool *any, dyd_engine *e, const dyd_delaunay *pd, dyd_error *err) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  size_t count[4];
  dyd_delaunay_count(count, pd);
  if (count[DYD_LEGAL] != 1) return DYD_OK;
  dyd_status st = dyd_pairs_list(&pairs, pd, DYD_TIE);
  if (st == DYD_OK && pairs.count == 1) st = try_group(any, e, (uint32_t[]){pairs.item->i, pairs.item->j}, 2, err);
  return st;
}

dyd_status dyd_aliases_find(bool *any, dyd_engine *e, const dyd_delaunay *pd, dyd_error *err) {
  size_t faces = dyd_delaunay_undecided_faces(pd);
  dyd_status st = DYD_OK;
  *any = false;
  if (e->points == 0) return DYD_OK;
  if (faces == 0) return try_last_pair(any, e, pd, err);
  for (size_t f = 0; f < faces && st == DYD_OK; f++) {
    DYD_SCOPED(dyd_index_list) sites = {0};
    bool outer;
    st = dyd_delaunay_face(&sites, &outer, pd, f);
    if (st == DYD_OK) st = try_group(any, e, sites.item, sites.count, err);
  }
  return st;
}

enum { TABLE = 1024 };

/* A question that was asked, by site numbers. */
typedef struct answer {
  struct answer *next;
  dyd_relation relation;
  int64_t most; /* bits that were allowed */
  dyd_zero zero;
  size_t count;
  uint32_t site[];
} answer;

/* Invariant: proved[0 .. proofs-1] are the answers that are proofs. */
struct dyd_ties {
  answer *head[TABLE];
  answer **proved;
  size_t proofs, proved_cap;
};

void dyd_ties_free(dyd_ties *t) {
  for (size_t k = 0; t && k < TABLE; k++)
    for (answer *a = t->head[k], *next; a; a = next) {
      next = a->next;
      free(a);
    }
  if (t) free(t->proved);
  free(t);
}

bool dyd_ties_proved(dyd_relation *relation, const uint32_t **site, size_t *count, const dyd_engine *e, size_t k) {
  if (!e->ties || k >= e->ties->proofs) return false;
  const answer *a = e->ties->proved[k];
  *relation = a->relation;
  *site = a->site;
  *count = a->count;
  return true;
}

/* ---- one question ---- */

/* place: NULL, or the sites are asked to be equally far from it; chosen: NULL, or given instead of `site`; meet: of two
 * sites, whether their regions have a point in common; a third point is then the sums of half their sides; discs:
 * whether the discs in these have. */
typedef struct tie_question {
  dyd_engine *e;
  dyd_algebra algebra;
  dyd_relation relation;
  const dyd_stream *place;
  const uint32_t *site;
  const dyd_site_place *chosen;
  bool meet, discs;
  size_t count;
  dyd_form_point *at; /* in the order of the sites; the place comes last */
  uint32_t *zero;     /* forms that are to be 0 */
  size_t zeros;
  int64_t needed; /* bits of the points at which one is seen not to be; 0: not known */
} tie_question;

dyd_status dyd_ties_describe(dyd_form_point *out, dyd_forms *f, const dyd_engine *e, uint32_t i, bool given) {
  const dyd_refinable *p = dyd_engine_find(e, i);
  *out = (dyd_form_point){DYD_NONE, DYD_NONE};
  if (p && p->stream && (given || !dyd_sites_is_point(e->sites, i))) {
    *out = dyd_forms_stream(f, p->stream);
    return DYD_OK;
  }
  if (!dyd_sites_is_point(e->sites, i)) return DYD_OK;
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sites_get(&r, e->sites, i);
  if (st == DYD_OK) *out = dyd_forms_rect(f, &r);
  return st;
}

static size_t described_points(const tie_question *q) {
  return q->count + (q->place != NULL);
}

/* r becomes its middle, or a corner. */
static dyd_status rect_choose(dyd_rect *r, unsigned place) {
  dyd_interval *side[2] = {&r->x, &r->y};
  dyd_status st = DYD_OK;
  for (int a = 0; st == DYD_OK && a < 2; a++)
    if (place == 0)
      st = dyd_interval_halve(side[a]);
    else
      dyd_interval_set_over(side[a], (place - 1) >> a & 1 ? &side[a]->hi : &side[a]->lo, side[a]->den);
  return st;
}

/* Sets *r to a place that stays in the region of the site, where both sides have a core: *chosen. Otherwise to its
 * rectangle. */
static dyd_status place_choose(dyd_rect *r, bool *chosen, const dyd_engine *e, const dyd_site_place *at) {
  bool core[2];
  dyd_status st = dyd_site_get_core(r, core, e, at->site);
  *chosen = st == DYD_OK && core[0] && core[1];
  if (*chosen) return rect_choose(r, at->place);
  return st == DYD_OK ? dyd_sites_get(r, e->sites, at->site) : st;
}

static dyd_status describe_place(dyd_form_point *out, dyd_forms *f, const dyd_engine *e, const dyd_site_place *at) {
  bool chosen;
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = place_choose(&r, &chosen, e, at);
  if (st == DYD_OK && chosen) *out = dyd_forms_rect(f, &r);
  return st;
}

static bool is_described(const dyd_form_point *p) {
  return p->x != DYD_NONE && p->y != DYD_NONE;
}

static dyd_status describe_site(dyd_form_point *out, tie_question *q, size_t k) {
  uint32_t site = q->chosen ? q->chosen[k].site : q->site[k];
  dyd_status st = dyd_ties_describe(out, &q->algebra.forms, q->e, site, false);
  if (st != DYD_OK || !q->chosen || is_described(out)) return st;
  return describe_place(out, &q->algebra.forms, q->e, &q->chosen[k]);
}

/* The region that the site keeps: its centre, and half its sides are added to `sum`. One that others have cut is not
 * known. */
static dyd_status describe_region(dyd_form_point *out, mpq_t sum[2], tie_question *q, uint32_t site) {
  const dyd_refinable *p = dyd_engine_find(q->e, site);
  const bool still = !p || p->final;
  dyd_status st = DYD_OK;
  DYD_LOCAL_ARRAY(mpq_t, half, [2]);
  DYD_LOCAL(dyd_rect, r);
  *out = (dyd_form_point){DYD_NONE, DYD_NONE};
  if (still) st = dyd_sites_get(&r, q->e->sites, site);
  if (still && st == DYD_OK) *out = dyd_forms_middle(&q->algebra.forms, half, &r);
  if (!still && p->stream && !p->measured) *out = dyd_forms_region(&q->algebra.forms, half, p->stream);
  bool less = mpq_cmp(half[0], half[1]) < 0;
  for (int a = 0; a < 2; a++) mpq_add(sum[a], sum[a], half[q->discs ? !less : a]);
  return st;
}

static dyd_status describe_regions(bool *known, tie_question *q) {
  DYD_LOCAL_ARRAY(mpq_t, sum, [2]);
  dyd_status st = describe_region(&q->at[0], sum, q, q->site[0]);
  if (st == DYD_OK) st = describe_region(&q->at[1], sum, q, q->site[1]);
  for (int a = 0; a < 2; a++) *(a ? &q->at[2].y : &q->at[2].x) = dyd_forms_number(&q->algebra.forms, sum[a]);
  *known = st == DYD_OK && is_described(&q->at[0]) && is_described(&q->at[1]) && is_described(&q->at[2]) &&
           !q->algebra.forms.opaque;
  return st;
}

/* *known: all of them are described. */
static dyd_status describe_all(bool *known, tie_question *q) {
  dyd_status st = DYD_OK;
  const dyd_form_point none = {DYD_NONE, DYD_NONE};
  if (q->meet) return describe_regions(known, q);
  q->at[q->count] = q->place ? dyd_forms_stream(&q->algebra.forms, q->place) : none;
  *known = !q->place || is_described(&q->at[q->count]);
  for (size_t k = 0; k < q->count && st == DYD_OK && *known; k++) {
    st = describe_site(&q->at[k], q, k);
    *known = is_described(&q->at[k]);
  }
  return q->algebra.forms.failed ? DYD_E_NOMEM : st;
}

/* ---- forms that are 0 ---- */

static void put_coincident(tie_question *q) {
  dyd_forms *f = &q->algebra.forms;
  q->zero[q->zeros++] = dyd_forms_binary(f, DYD_OP_SUB, q->at[1].x, q->at[0].x);
  q->zero[q->zeros++] = dyd_forms_binary(f, DYD_OP_SUB, q->at[1].y, q->at[0].y);
}

/* Returns true if two points are different. */
static bool are_apart(tie_question *q, dyd_form_point a, dyd_form_point b) {
  dyd_forms *f = &q->algebra.forms;
  return dyd_algebra_is_nonzero(&q->algebra, dyd_forms_binary(f, DYD_OP_SUB, a.x, b.x)) ||
         dyd_algebra_is_nonzero(&q->algebra, dyd_forms_binary(f, DYD_OP_SUB, a.y, b.y));
}

/* The first and the last point are the line. false: they may be the same. */
static bool put_collinear(tie_question *q) {
  size_t last = q->count - 1;
  if (!are_apart(q, q->at[0], q->at[last])) return false;
  for (size_t k = 1; k < last; k++) {
    const dyd_form_point three[3] = {q->at[0], q->at[last], q->at[k]};
    q->zero[q->zeros++] = dyd_forms_collinear(&q->algebra.forms, three);
  }
  return true;
}

/* Three points far apart are the circle. false: they may be on one line. */
static bool put_cocircular(tie_question *q) {
  size_t base[3] = {0, q->count / 3, 2 * q->count / 3};
  dyd_form_point four[4] = {q->at[base[0]], q->at[base[1]], q->at[base[2]]};
  if (!dyd_algebra_is_nonzero(&q->algebra, dyd_forms_collinear(&q->algebra.forms, four))) return false;
  for (size_t k = 0; k < q->count; k++) {
    if (k == base[0] || k == base[1] || k == base[2]) continue;
    four[3] = q->at[k];
    q->zero[q->zeros++] = dyd_forms_cocircular(&q->algebra.forms, four);
  }
  return true;
}

/* The first is as far as the others. */
static void put_equidistant(tie_question *q) {
  dyd_forms *f = &q->algebra.forms;
  uint32_t first = dyd_forms_distance2(f, q->at[0], q->at[q->count]);
  for (size_t k = 1; k < q->count; k++)
    q->zero[q->zeros++] = dyd_forms_binary(f, DYD_OP_SUB, dyd_forms_distance2(f, q->at[k], q->at[q->count]), first);
}

/* Returns true if no two of the places are the same: chosen ones may be. */
static bool all_are_apart(tie_question *q) {
  bool apart = true;
  for (size_t k = 1; k < q->count && apart; k++)
    for (size_t l = 0; l < k && apart; l++) apart = are_apart(q, q->at[k], q->at[l]);
  return apart;
}

/* Along one axis: the distance of the centres is at most `sum`. Returns false if it is more; 0 is to be proved where it
 * may be the same. */
static bool put_near(tie_question *q, uint32_t a, uint32_t b, uint32_t sum) {
  dyd_forms *f = &q->algebra.forms;
  uint32_t d = dyd_forms_binary(f, DYD_OP_SUB, a, b);
  if (arb_is_negative(dyd_forms_value(f, d, DYD_ZERO_FIRST_BITS))) d = dyd_forms_binary(f, DYD_OP_SUB, b, a);
  d = dyd_forms_binary(f, DYD_OP_SUB, d, sum);
  if (d == DYD_NONE || arb_is_positive(dyd_forms_value(f, d, DYD_ZERO_FIRST_BITS))) return false;
  if (!arb_is_negative(dyd_forms_value(f, d, DYD_ZERO_FIRST_BITS))) q->zero[q->zeros++] = d;
  return true;
}

/* The same of the distance of the centres. */
static bool put_discs_near(tie_question *q) {
  dyd_forms *f = &q->algebra.forms;
  uint32_t d = dyd_forms_binary(f, DYD_OP_SUB, dyd_forms_distance2(f, q->at[0], q->at[1]),
                                dyd_forms_binary(f, DYD_OP_MUL, q->at[2].x, q->at[2].x));
  if (d == DYD_NONE || arb_is_positive(dyd_forms_value(f, d, DYD_ZERO_FIRST_BITS))) return false;
  if (!arb_is_negative(dyd_forms_value(f, d, DYD_ZERO_FIRST_BITS))) q->zero[q->zeros++] = d;
  return true;
}

static bool put_zeros(tie_question *q) {
  const dyd_form_point *at = q->at;
  if (q->discs) return put_discs_near(q);
  if (q->meet) return put_near(q, at[0].x, at[1].x, at[2].x) && put_near(q, at[0].y, at[1].y, at[2].y);
  if (q->chosen && !all_are_apart(q)) return false;
  if (q->place) {
    put_equidistant(q);
    return true;
  }
  switch (q->relation) {
  case DYD_COINCIDENT:
    put_coincident(q);
    return true;
  case DYD_COLLINEAR:
    return put_collinear(q);
  default:
    return put_cocircular(q);
  }
}

/* ---- ties refuted ---- */

/* Differences of coordinates are below 2^this in absolute value. */
static int64_t question_scale(tie_question *q) {
  dyd_forms *f = &q->algebra.forms;
  int64_t scale = INT64_MIN;
  DYD_LOCAL_NUMBERS(arb, d);
  DYD_LOCAL_NUMBERS(arf, most);
  for (size_t k = 0; k < 2 * described_points(q); k++) {
    uint32_t of = k & 1 ? q->at[k / 2].y : q->at[k / 2].x, from = k & 1 ? q->at[0].y : q->at[0].x;
    arb_sub(d, dyd_forms_value(f, of, DYD_ZERO_FIRST_BITS), dyd_forms_value(f, from, DYD_ZERO_FIRST_BITS),
            DYD_ZERO_FIRST_BITS);
    arb_get_abs_ubound_arf(most, d, DYD_ZERO_FIRST_BITS);
    if (!arf_is_finite(most) || arf_is_zero(most)) continue;
    int64_t size = (int64_t)fmpz_get_si(ARF_EXPREF(most));
    if (size > scale) scale = size;
  }
  return scale == INT64_MIN ? 0 : scale;
}

/* The degree of the forms in the coordinates. */
static int question_degree(const tie_question *q) {
  return q->place ? 2 : q->relation == DYD_COINCIDENT ? 1 : q->relation == DYD_COLLINEAR ? 2 : 4;
}

/* A form is seen not to be 0 from the precision `shown` on. Of all the largest one counts: with it alone the question
 * is answered. Coordinates that are off by 2^-b change a form of degree d, for points within 2^s of one another, by
 * about 2^(s (d - 1) - b). At the first precision nothing is gained. */
static void question_need(tie_question *q) {
  enum { MARGIN = 16 };
  slong shown = q->algebra.shown;
  int64_t least = INT64_MAX;
  if (shown <= DYD_ZERO_FIRST_BITS) return;
  for (size_t k = 0; k < q->zeros && !dyd_flag_get(&q->e->stop); k++) {
    int64_t e = dyd_algebra_smallness(&q->algebra, q->zero[k], shown);
    if (e < least) least = e;
  }
  if (least == INT64_MAX) return;
  int64_t need = least + (question_degree(q) - 1) * question_scale(q);
  if (need > 0) q->needed = need + need / 64 + MARGIN;
}

/* ---- answers ---- */

/* Leaves are settled when no form is certainly not 0. *out stays unknown on failure. */
static dyd_status test_zeros(dyd_zero *out, tie_question *q) {
  dyd_algebra *a = &q->algebra;
  dyd_zero all = DYD_ZERO_PROVED;
  for (size_t k = 0; k < q->zeros; k++)
    if (dyd_algebra_is_refuted(a, q->zero[k])) {
      *out = DYD_ZERO_REFUTED;
      return DYD_OK;
    }
  _Static_assert(sizeof *q->at == 2 * sizeof(uint32_t), "points are pairs of forms");
  dyd_status st = dyd_algebra_settle(a, &q->at->x, 2 * described_points(q));
  for (size_t k = 0; k < q->zeros && st == DYD_OK && all == DYD_ZERO_PROVED; k++) all = dyd_algebra_test(a, q->zero[k]);
  if (a->forms.failed || a->ring.failed) st = DYD_E_NOMEM;
  if (st == DYD_OK && all == DYD_ZERO_REFUTED) question_need(q);
  if (st == DYD_OK) *out = all;
  return st;
}

static dyd_status question_run(dyd_zero *out, tie_question *q) {
  bool known;
  *out = DYD_ZERO_UNKNOWN;
  q->at = dyd_alloc(q->count + 1, sizeof *q->at);
  q->zero = dyd_alloc(q->count + 2, sizeof *q->zero);
  if (!q->at || !q->zero) return DYD_E_NOMEM;
  dyd_status st = describe_all(&known, q);
  if (st != DYD_OK || !known || !put_zeros(q)) return st;
  return test_zeros(out, q);
}

static void count_question(dyd_engine *e, const dyd_zero_counts *c, double seconds) {
  dyd_tie_counters *t = &e->tie_counters;
  t->tests += c->tests;
  t->by_identity += c->by_identity;
  t->by_bound += c->by_bound;
  t->nonzero += c->nonzero;
  t->unknown += c->unknown;
  if (c->bits > t->bits_most) t->bits_most = c->bits;
  if (c->degree > t->degree_most) t->degree_most = c->degree;
  t->seconds += seconds;
}

/* *final: it would be answered in the same way again. */
static dyd_status question_answer(dyd_zero *out, bool *final, tie_question *q) {
  dyd_engine *e = q->e;
  double begin = dyd_seconds();
  dyd_status st = dyd_algebra_open(&q->algebra, e->tie_bits, &e->stop);
  if (st != DYD_OK) return st;
  q->algebra.memory = e->memory;
  st = question_run(out, q);
  if (st == DYD_OK && e->memory && e->memory->refused) st = DYD_E_NOMEM;
  *final = !q->algebra.forms.opaque && !dyd_flag_get(&e->stop);
  dyd_algebra_close(&q->algebra);
  dyd_free_all(q->zero, q->at);
  count_question(e, &q->algebra.count, dyd_seconds() - begin);
  return st;
}

/* Notes at the points of a question the bits they need. */
static void note_need(const tie_question *q) {
  for (size_t k = 0; k < q->count && q->needed; k++) {
    dyd_refinable *p = dyd_find_index(&q->site[k], q->e->point, q->e->points, sizeof *q->e->point);
    if (p && p->needed < q->needed) p->needed = q->needed;
  }
}

/* ---- answers kept ---- */

static size_t ties_answer_place(dyd_relation relation, const uint32_t *site, size_t count) {
  uint64_t h = (uint64_t)relation + count;
  for (size_t k = 0; k < count; k++) h = (h ^ site[k]) * UINT64_C(0x9e3779b97f4a7c15) + (h >> 29);
  return (size_t)(h >> 40) % TABLE;
}

static answer *answer_find(const dyd_ties *t, size_t place, dyd_relation relation, const uint32_t *site, size_t count) {
  for (answer *a = t->head[place]; a; a = a->next)
    if (a->relation == relation && a->count == count && !memcmp(a->site, site, count * sizeof *site)) return a;
  return NULL;
}

static answer *answer_new(dyd_ties *t, size_t place, dyd_relation relation, const uint32_t *site, size_t count) {
  answer *a = malloc(sizeof *a + count * sizeof *site);
  if (!a) return NULL;
  *a = (answer){.next = t->head[place], .relation = relation, .count = count, .most = -1};
  memcpy(a->site, site, count * sizeof *site);
  return t->head[place] = a;
}

/* A question that was given up is asked again when more bits are allowed. */
static dyd_status answer_get(answer **out, dyd_engine *e, dyd_relation relation, const uint32_t *site, size_t count) {
  if (!e->ties) e->ties = calloc(1, sizeof *e->ties);
  if (!e->ties) return DYD_E_NOMEM;
  size_t place = ties_answer_place(relation, site, count);
  answer *a = answer_find(e->ties, place, relation, site, count);
  if (!a) a = answer_new(e->ties, place, relation, site, count);
  if (!a) return DYD_E_NOMEM;
  *out = a;
  if (a->zero != DYD_ZERO_UNKNOWN || a->most >= e->tie_bits) return DYD_OK;
  bool final = false;
  dyd_zero zero = DYD_ZERO_UNKNOWN;
  dyd_ties *t = e->ties;
  if (!dyd_reserve((void **)&t->proved, &t->proved_cap, t->proofs + 1, sizeof(answer *))) return DYD_E_NOMEM;
  tie_question q = {.e = e, .relation = relation, .site = site, .count = count};
  dyd_status st = question_answer(&zero, &final, &q);
  if (st != DYD_OK) return st;
  note_need(&q);
  a->zero = zero;
  if (final) a->most = e->tie_bits;
  if (zero == DYD_ZERO_PROVED) t->proved[t->proofs++] = a;
  return st;
}

dyd_status dyd_ties_prove(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                          dyd_error *err) {
  answer *a = NULL;
  *proved = false;
  dyd_status st = answer_get(&a, user, relation, site, count);
  if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
  *proved = a->zero == DYD_ZERO_PROVED;
  return DYD_OK;
}

static dyd_status ties_prove_places(bool *proved, void *user, dyd_relation relation, const dyd_site_place *at,
                                    size_t count) {
  tie_question q = {.e = user, .relation = relation, .chosen = at, .count = count};
  dyd_zero zero = DYD_ZERO_UNKNOWN;
  bool final;
  dyd_status st = question_answer(&zero, &final, &q);
  *proved = zero == DYD_ZERO_PROVED;
  return st;
}

static dyd_status ties_place(dyd_rect *out, void *user, const dyd_site_place *at) {
  bool chosen;
  return place_choose(out, &chosen, user, at);
}

static dyd_status ties_meet(bool *proved, void *user, const uint32_t site[2], bool discs) {
  tie_question q = {.e = user, .meet = true, .discs = discs, .site = site, .count = 3};
  dyd_zero zero = DYD_ZERO_UNKNOWN;
  bool final;
  dyd_status st = question_answer(&zero, &final, &q);
  *proved = zero == DYD_ZERO_PROVED;
  return st;
}

dyd_prover dyd_engine_prover(dyd_engine *e, const dyd_engine_options *o) {
  if (o->no_ties) return (dyd_prover){0};
  return e->prover.prove ? e->prover : (dyd_prover){dyd_ties_prove, ties_prove_places, ties_place, ties_meet, e};
}

dyd_status dyd_ties_equidistant(bool *tied, int64_t *needed, dyd_engine *e, dyd_stream *at, const dyd_index_list *sites,
                                dyd_error *err) {
  tie_question q = {.e = e, .place = at, .site = sites->item, .count = sites->count};
  dyd_zero zero = DYD_ZERO_UNKNOWN;
  bool final;
  dyd_status st = question_answer(&zero, &final, &q);
  if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
  *tied = zero == DYD_ZERO_PROVED;
  *needed = q.needed;
  return DYD_OK;
}
