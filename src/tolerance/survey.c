/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plans: targets, site by site, proof by a triangulation of all, accuracies as coarse as can be [SUR-1]. */
#include "tolerance/survey.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/index.h"
#include "base/local.h"
#include "delaunay/memory.h"

#include <dyadel/tolerance.h>

#include <stdlib.h>
#include <string.h>

/* Where no accuracy is given, these shares of each half-width are tried until one decides; and rounds of the work on
 * faces, of which more than one is needed where the needs of a face show only together with the others. */
static const int finer[] = {10, 20, 40};
enum { FINER = sizeof finer / sizeof *finer, ROUNDS = 8, STEPS = 4 };

/* ---- targets ---- */

static bool is_asked(const dyd_survey_options *o, const dyd_survey *s, const dyd_pair *p) {
  if (o->site && p->i != *o->site && p->j != *o->site) return false;
  return !o->window || dyd_rect_meets(&s->site[p->i].rect, o->window) || dyd_rect_meets(&s->site[p->j].rect, o->window);
}

/* Number of ties that dyd_least_bounding omits: those of the nominal places, which are the points. */
static size_t ties_left_out(const dyd_delaunay *pd) {
  size_t count[4];
  dyd_delaunay_count(count, pd);
  return dyd_least_bounding(pd) > DYD_TIE ? count[DYD_TIE] : 0;
}

/* The first pair that ties at the centres, and the first end of a pair whose centre is that of another site. */
static void note_nominal(dyd_survey_result *r, const dyd_delaunay *nominal, const dyd_pair *p) {
  const uint32_t end[2] = {p->i, p->j};
  if (p->status != DYD_INDETERMINATE) return;
  if (r->tie[0] == r->tie[1] && dyd_delaunay_status(nominal, p->i, p->j) == DYD_TIE) memcpy(r->tie, end, sizeof end);
  for (int k = 0; k < 2 && r->same[0] == r->same[1]; k++) {
    r->same[0] = dyd_delaunay_alias(nominal, end[k]);
    r->same[1] = end[k];
  }
}

/* Is the pair, open for the rectangles, open for the discs in them, too? */
static bool is_open_in_discs(const dyd_pair_list *discs, const dyd_pair *p) {
  const uint32_t key[2] = {p->i < p->j ? p->i : p->j, p->i < p->j ? p->j : p->i};
  const dyd_pair *found = dyd_find_two(key, discs->item, discs->count, sizeof *found);
  return found && found->status == DYD_INDETERMINATE;
}

/* Of the pairs asked for: those open. Cancelled: perhaps more of them. */
static dyd_status list_open(dyd_survey *s, const dyd_delaunay *pd) {
  DYD_SCOPED(dyd_pair_list) all = {0}, discs = {0};
  const dyd_survey_options *o = &s->options;
  dyd_status st = o->pairs ? DYD_OK : dyd_pairs_take(&all, pd, dyd_least_bounding(pd)), found = st;
  const dyd_pair_list *asked = o->pairs ? o->pairs : &all;
  if (!o->pairs) s->result.ties = ties_left_out(pd);
  if (st == DYD_OK && o->discs) found = dyd_disc_pairs(&discs, pd, o->cancel, s->err);
  if (found != DYD_CANCELLED) st = found;
  if (st == DYD_OK && !(s->target.item = dyd_alloc(asked->count, sizeof *s->target.item))) st = DYD_E_NOMEM;
  for (size_t k = 0; k < asked->count && st == DYD_OK; k++) {
    dyd_pair p = asked->item[k];
    p.i = dyd_delaunay_alias(pd, p.i);
    p.j = dyd_delaunay_alias(pd, p.j);
    p.status = dyd_delaunay_status(pd, p.i, p.j);
    if ((p.status != DYD_INDETERMINATE && p.status != DYD_TIE) || !is_asked(o, s, &p)) continue;
    if (!o->discs || is_open_in_discs(&discs, &p)) s->target.item[s->target.count++] = p;
  }
  return st == DYD_OK ? found : st;
}

/* Moves the ties of the nominal places behind the others. */
static void leave_out_ties(dyd_survey *s, const dyd_delaunay *nominal) {
  dyd_pair_list *t = &s->target;
  for (size_t k = 0; k < t->count; k++) note_nominal(&s->result, nominal, &t->item[k]);
  for (size_t k = 0; k < t->count;) {
    const dyd_pair p = t->item[k];
    bool tied = dyd_delaunay_status(nominal, p.i, p.j) == DYD_TIE ||
                dyd_delaunay_alias(nominal, p.i) == dyd_delaunay_alias(nominal, p.j);
    k += !tied;
    if (!tied) continue;
    t->item[k] = t->item[--t->count];
    t->item[t->count] = p;
    s->tied++;
  }
  s->result.ties += s->tied;
}

static dyd_status find_targets(dyd_survey *s, const dyd_delaunay *pd) {
  DYD_OWNED(dyd_delaunay) *nominal = NULL;
  dyd_status st = list_open(s, pd);
  if (st == DYD_OK && s->target.count) st = dyd_survey_triangulate(&nominal, s, true);
  if (nominal) leave_out_ties(s, nominal);
  dyd_status indexed = st == DYD_OK || st == DYD_CANCELLED ? dyd_survey_index_targets(s) : st;
  return indexed == DYD_OK ? st : indexed;
}

/* ---- choosing ---- */

static bool has_large_face(const dyd_delaunay *pd) {
  DYD_SCOPED(dyd_index_list) face = {0};
  bool outer, large = false;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd) && !large; f++)
    large = dyd_delaunay_face(&face, &outer, pd, f) == DYD_OK && face.count > DYD_SURVEY_LARGE;
  return large;
}

static dyd_status mark_near(bool *near, const dyd_delaunay *pd, uint32_t i) {
  DYD_SCOPED(dyd_index_list) l = {0};
  dyd_status st = dyd_delaunay_neighbours(&l, pd, i, DYD_TIE);
  near[i] = true;
  for (size_t k = 0; k < l.count && st == DYD_OK; k++) near[l.item[k]] = true;
  return st;
}

/* near[i] (may be NULL) is set where an open target, or a possible neighbour of one of its ends, is. */
static dyd_status recount_left(dyd_survey *s, bool *near) {
  DYD_OWNED(dyd_delaunay) *now = NULL;
  dyd_status st = dyd_survey_triangulate(&now, s, false);
  if (st == DYD_OK) s->result.left = dyd_survey_open(s, now);
  for (size_t k = 0; k < s->target.count && st == DYD_OK && near; k++) {
    const dyd_pair *p = &s->target.item[k];
    if (!dyd_survey_is_open(now, p)) continue;
    st = mark_near(near, now, p->i);
    if (st == DYD_OK) st = mark_near(near, now, p->j);
  }
  return st;
}

/* In all faces of pd, one by one; the sites chosen are measured in the triangulation of all. */
static dyd_status choose_in_faces(dyd_measuring *m, const dyd_delaunay *pd) {
  dyd_survey *s = m->s;
  dyd_status st = DYD_OK;
  for (size_t f = 0; st == DYD_OK && f < dyd_delaunay_undecided_faces(pd); f++) {
    size_t decided, before = s->chosens;
    st = dyd_survey_face(s, pd, f);
    for (size_t k = before; k < s->chosens && st == DYD_OK; k++)
      st = dyd_measuring_draft(&decided, m, s->chosen[k].row.site);
  }
  return st;
}

/* In large faces; then in all faces of the triangulation with the chosen sites measured, as long as that helps. */
static dyd_status measure_rounds(dyd_measuring *m, const dyd_delaunay *pd) {
  dyd_survey *s = m->s;
  dyd_status st = has_large_face(pd) ? dyd_survey_crowds(m) : DYD_OK;
  for (int round = 0; round < ROUNDS && m->left && st == DYD_OK; round++) {
    DYD_OWNED(dyd_delaunay) *now = NULL;
    size_t before = s->chosens;
    if (before) st = dyd_survey_triangulate(&now, s, false);
    if (st == DYD_OK) st = choose_in_faces(m, before ? now : pd);
    if (s->chosens == before) break;
  }
  return st;
}

static dyd_status choose_rounds(dyd_survey *s, const dyd_delaunay *pd) {
  dyd_measuring m;
  s->result.left = s->target.count;
  dyd_status st = dyd_measuring_begin(&m, s);
  if (st == DYD_OK) st = measure_rounds(&m, pd);
  if (st == DYD_OK) s->result.left = m.left;
  dyd_measuring_end(&m);
  return st;
}

/* Takes rows out whose sites are not chosen. */
static void settle_rows(dyd_survey *s) {
  size_t kept = 0;
  for (size_t k = 0; k < s->chosens; k++)
    if (s->site[s->chosen[k].row.site].chosen) s->chosen[kept++] = s->chosen[k];
  s->chosens = kept;
}

/* Sites near (NULL: all) that have a row are measured, and no coarser than the common factor says. */
static void restore_rows(dyd_survey *s, const bool *near) {
  for (size_t k = 0; k < s->chosens; k++) {
    uint32_t site = s->chosen[k].row.site;
    if (near && !near[site]) continue;
    s->site[site].chosen = true;
    s->site[site].coarser = 0;
  }
}

/* Where more is open than the `before` that were, those near are taken back, as often as that may help; then all. */
static dyd_status restore_open(dyd_survey *s, size_t before) {
  DYD_FREED bool *near = calloc(s->sites + 1, sizeof *near);
  dyd_status st = near ? recount_left(s, near) : DYD_E_NOMEM;
  for (int round = 0; round < ROUNDS && st == DYD_OK && s->result.left > before; round++) {
    restore_rows(s, near);
    st = recount_left(s, near);
  }
  if (s->result.left > before) restore_rows(s, NULL);
  s->result.left = before;
  return st;
}

/* Sites that are not needed after all, seen one by one. All together are checked, as everywhere. */
static dyd_status unchoose(dyd_survey *s) {
  dyd_measuring m;
  size_t before = s->result.left;
  dyd_status st = dyd_measuring_begin(&m, s);
  for (size_t k = 0; k < s->chosens && st == DYD_OK; k++) {
    uint32_t site = s->chosen[k].row.site;
    bool holds = false;
    s->site[site].chosen = false;
    st = dyd_measuring_loosens(&holds, &m, site);
    s->site[site].chosen = !holds;
  }
  dyd_measuring_end(&m);
  if (st == DYD_OK) st = restore_open(s, before);
  settle_rows(s);
  return st;
}

/* Where this was not enough, sites are measured more finely, and others with them. The draft stays as it is. */
static dyd_status choose_finely_enough(dyd_survey *s, const dyd_delaunay *pd) {
  dyd_status st = DYD_OK;
  mpq_set_ui(s->scale, 1, 1);
  if (dyd_survey_is_limited(s)) return choose_rounds(s, pd);
  for (int k = 0; k < FINER && st == DYD_OK && (k == 0 || s->result.left); k++) {
    mpq_set_ui(s->scale, 1, 1);
    mpq_div_2exp(s->scale, s->scale, (mp_bitcnt_t)finer[k]);
    st = choose_rounds(s, pd);
    s->drafted = true;
  }
  return st;
}

/* ---- the common factor ---- */

/* *holds: no more is left open at this scale than before; s keeps it. */
static dyd_status holds_at(bool *holds, dyd_survey *s, mpq_srcptr scale) {
  size_t before = s->result.left;
  DYD_LOCAL_NUMBERS(mpq, old);
  mpq_set(old, s->scale);
  mpq_set(s->scale, scale);
  dyd_status st = recount_left(s, NULL);
  *holds = st == DYD_OK && s->result.left <= before;
  if (!*holds) mpq_set(s->scale, old);
  s->result.left = before;
  return st;
}

/* Doubled as often as that holds: the less exactly, the more is open. By halves, where it starts below 1 and ends
 * there; where the accuracy is given, one by one. */
static dyd_status double_scale(dyd_survey *s, mpq_t next) {
  bool limited = dyd_survey_is_limited(s);
  size_t least = 0, most = limited ? 64 : mpz_sizeinbase(mpq_denref(s->scale), 2) - 1;
  dyd_status st = DYD_OK;
  while (least < most && st == DYD_OK) {
    bool holds;
    size_t middle = limited ? least + 1 : least + (most - least + 1) / 2;
    mpq_mul_2exp(next, s->scale, middle - least);
    st = holds_at(&holds, s, next);
    if (holds)
      least = middle;
    else
      most = middle - 1;
  }
  return st;
}

/* Then halving the step. */
static dyd_status loosen(dyd_survey *s) {
  DYD_LOCAL_NUMBERS(mpq, next, step);
  dyd_status st = s->chosens ? double_scale(s, next) : DYD_OK;
  mpq_div_2exp(step, s->scale, 1);
  for (int k = 0; k < STEPS && s->chosens && st == DYD_OK; k++) {
    bool holds;
    mpq_add(next, s->scale, step);
    if (dyd_survey_is_limited(s) || mpq_cmp_ui(next, 1, 1) < 0) st = holds_at(&holds, s, next);
    mpq_div_2exp(step, step, 1);
  }
  return st;
}

/* ---- each site alone ---- */

/* By the greatest power of two, at most 2^most, with which no more is open. */
static dyd_status loosen_site(dyd_measuring *m, uint32_t site, unsigned most) {
  unsigned least = 0;
  dyd_status st = DYD_OK;
  while (least < most && st == DYD_OK) {
    bool holds;
    unsigned middle = least + (most - least + 1) / 2;
    m->s->site[site].coarser = middle;
    st = dyd_measuring_loosens(&holds, m, site);
    if (holds)
      least = middle;
    else
      most = middle - 1;
  }
  m->s->site[site].coarser = least;
  return st;
}

/* One after the other; all together are checked in the end, and where they fail, the common factor alone counts. */
static dyd_status loosen_each(dyd_survey *s) {
  dyd_measuring m;
  size_t before = s->result.left;
  dyd_status st = dyd_measuring_begin(&m, s);
  for (size_t k = 0; k < s->chosens && st == DYD_OK; k++)
    st = loosen_site(&m, s->chosen[k].row.site, dyd_survey_doublings(s, s->chosen[k].row.site));
  dyd_measuring_end(&m);
  return st == DYD_OK ? restore_open(s, before) : st;
}

/* ---- the plan ---- */

/* A row and the least that it or one before it in its face decides. */
typedef struct row_rank {
  size_t least, k;
} row_rank;

static int compare_ranks(const void *a, const void *b) {
  const row_rank *x = a, *y = b;
  if (x->least != y->least) return x->least > y->least ? -1 : 1;
  return (x->k > y->k) - (x->k < y->k);
}

/* The rows of all faces, always the one that decides most of those next; each face keeps its own order. A row that
 * states more than one before it comes right after that one: so they are sorted by the least so far. */
static dyd_status merge_rows(dyd_survey *s) {
  size_t total = s->chosens, least = SIZE_MAX;
  DYD_FREED row_rank *rank = dyd_alloc(total, sizeof *rank);
  s->row = dyd_alloc(total, sizeof *s->row);
  dyd_status st = rank && s->row ? DYD_OK : DYD_E_NOMEM;
  for (size_t k = 0; k < total && st == DYD_OK; k++) {
    const dyd_face_row *c = &s->chosen[k];
    if (k == 0 || c->face != c[-1].face || c->row.decided < least) least = c->row.decided;
    rank[k] = (row_rank){least, k};
  }
  if (total && st == DYD_OK) qsort(rank, total, sizeof *rank, compare_ranks);
  for (; s->rows < total && st == DYD_OK; s->rows++) {
    dyd_survey_row row = s->chosen[rank[s->rows].k].row;
    row.now = dyd_survey_now(s, row.site);
    row.needed = dyd_survey_needed(s, row.site);
    s->row[s->rows] = row;
  }
  return st;
}

/* The plan made small, and its accuracies coarse; then its rows. */
static dyd_status simplify(dyd_survey *s) {
  dyd_status st = unchoose(s);
  if (st == DYD_OK) st = loosen(s);
  if (st == DYD_OK) st = loosen_each(s);
  if (st == DYD_OK) st = merge_rows(s);
  return st == DYD_OK ? dyd_survey_count_left(s) : st;
}

static dyd_status survey_check(const dyd_survey *s, const dyd_delaunay *pd, dyd_error *err) {
  const dyd_survey_options *o = &s->options;
  if (dyd_delaunay_is_capped(pd))
    return dyd_fail(err, DYD_CAPPED, "more undecided pairs than can be stored; raise `max_pairs`");
  if (o->accuracy && mpq_sgn(o->accuracy) <= 0)
    return dyd_fail(err, DYD_E_ARG, "the accuracy is not above 0; give a number above 0");
  if (o->site && *o->site >= s->sites)
    return dyd_fail(err, DYD_E_ARG, "there is no such point; give the number of one, from 0");
  for (size_t k = 0; o->pairs && k < o->pairs->count; k++)
    if (o->pairs->item[k].i >= s->sites || o->pairs->item[k].j >= s->sites)
      return dyd_fail(err, DYD_E_ARG, "pair number %zu names a point that does not exist", k);
  for (size_t i = 0; o->accuracies && i < s->sites; i++)
    if (!(o->accuracies[i] > 0))
      return dyd_fail(err, DYD_E_ARG, "the accuracy of point %zu is not above 0; give a number above 0", i);
  for (size_t i = 0; o->cost && i < s->sites; i++)
    if (!(o->cost[i] > 0)) return dyd_fail(err, DYD_E_ARG, "the cost of point %zu is not above 0", i);
  return DYD_OK;
}

/* Work was cancelled when targets were known. */
static void keep_draft(dyd_survey *s) {
  free(s->row);
  s->row = s->draft;
  s->rows = s->drafts;
  s->draft = NULL;
  s->result.left = s->rows ? s->row[s->rows - 1].left : s->target.count;
  s->result.cut = true;
}

dyd_status dyd_survey_tell_cut(const dyd_survey *s, dyd_error *err) {
  if (!s->result.cut) return DYD_OK;
  return dyd_fail(err, DYD_CANCELLED,
                  "the plan is not finished: %zu of %zu pairs are undecided after its first %zu points", s->result.left,
                  s->result.open, s->rows);
}

/* Work was cancelled before, perhaps that on pd, too. */
static dyd_status survey_not_begun(dyd_survey **out, dyd_survey *s, const dyd_delaunay *pd, dyd_error *err) {
  size_t count[4];
  dyd_delaunay_count(count, pd);
  s->result.open = s->result.left = s->options.pairs ? s->options.pairs->count : count[DYD_INDETERMINATE];
  s->result.cut = true;
  s->result.struct_size = sizeof s->result;
  *out = s;
  return dyd_survey_tell_cut(s, err);
}

dyd_status dyd_survey_new(dyd_survey **out, const dyd_delaunay *pd, const dyd_survey_options *options, dyd_error *err) {
  if (!pd) return dyd_fail_null(err);
  *out = NULL;
  if (err) dyd_error_clear(err);
  dyd_survey *s = calloc(1, sizeof *s);
  if (!s) return dyd_fail_nomem(err);
  mpq_init(s->scale);
  s->room = dyd_delaunay_room(pd);
  s->threads = pd->options.threads;
  s->err = err;
  dyd_status st = dyd_abi_take(&s->options, sizeof s->options, options, "dyd_survey_options", err);
  if (st == DYD_OK && dyd_flag_is_set(s->options.cancel)) return survey_not_begun(out, s, pd, err);
  if (st == DYD_OK) st = dyd_survey_load(s, dyd_delaunay_sites(pd));
  if (st == DYD_OK) st = survey_check(s, pd, err);
  if (st == DYD_OK) st = find_targets(s, pd);
  if (st == DYD_OK) st = choose_finely_enough(s, pd);
  if (st == DYD_OK) st = simplify(s);
  s->err = NULL;
  if (st == DYD_OK || (st == DYD_CANCELLED && s->first)) {
    *out = s;
    if (st == DYD_CANCELLED) keep_draft(s);
    s->result.struct_size = sizeof s->result;
    s->result.open = s->target.count;
    return dyd_survey_tell_cut(s, err);
  }
  if (st == DYD_E_NOMEM && s->room.refused) dyd_fail_room(err, &s->room);
  dyd_survey_free(s);
  return err && err->code == st ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

void dyd_survey_free(dyd_survey *s) {
  if (!s) return;
  for (size_t i = 0; i < s->sites; i++) {
    dyd_rect_clear(&s->site[i].rect);
    mpq_clears(s->site[i].x, s->site[i].y, s->site[i].half, NULL);
  }
  dyd_free_all(s->first, s->at, s->pair);
  dyd_free_all(s->site, s->chosen, s->row, s->draft);
  dyd_pair_list_clear(&s->target);
  mpq_clear(s->scale);
  free(s);
}

size_t dyd_survey_rows(const dyd_survey_row **row, const dyd_survey *s) {
  if (!s) return 0;
  *row = s->row;
  return s->rows;
}

size_t dyd_survey_pairs(const dyd_survey_pair **pair, const dyd_survey *s) {
  if (!s) return 0;
  *pair = s->pair;
  return s->target.count;
}

const dyd_survey_result *dyd_survey_get(const dyd_survey *s) {
  return s ? &s->result : NULL;
}
