/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Choosing the sites of a plan, face by face; then accuracies as coarse as can be [SUR-1].
 *
 * What happens in an undecided face depends on its own sites alone [LOC-1], so each try is a triangulation of these:
 * greedily the site that leaves fewest of its targets open, then sites that are not needed go. Whether the plan is
 * enough is seen on all sites in the end. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/index.h"
#include "base/invariant.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "delaunay/steps.h"
#include "rect/rect.h"
#include "tolerance/lines.h"
#include "tolerance/survey.h"

#include <dyadel/tolerance.h>

#include <stdlib.h>
#include <string.h>

/* A face of more sites than these is large; rounds of the work on faces, of which more than one is needed where the
 * needs of a face show only together with the others; how often a step of the common factor is halved. */
enum { SURVEY_LARGE = 8, ROUNDS = 8, STEPS = 4 };

/* Sites are measured one by one in a triangulation of all. open[k]: is target k; degree[i]: how many
 * open ones end at site i. Without steps it is made anew each time. */
typedef struct measuring {
  dyd_survey *s;
  dyd_survey_pair *pair; /* where the targets that `row` decides are noted; NULL: nowhere */
  size_t row;
  dyd_delaunay *now;
  dyd_steps steps;
  bool *open;
  size_t *degree, left;
} measuring;

/* min(scale 2^coarser unit, half) */
static void accuracy_of(mpq_ptr out, const dyd_survey *s, uint32_t i) {
  const dyd_survey_site *p = &s->site[i];
  if (s->options.accuracies)
    mpq_set_d(out, s->options.accuracies[i]);
  else
    mpq_set(out, s->options.accuracy ? s->options.accuracy : p->half);
  mpq_mul(out, out, s->scale);
  mpq_mul_2exp(out, out, p->coarser);
  if (mpq_cmp(out, p->half) > 0) mpq_set(out, p->half);
}

/* Outward, so that the plan never says less than is needed. */
dyd_status dyd_survey_cut(dyd_interval *side, mpq_srcptr centre, mpq_srcptr a, mpq_t end[2]) {
  if (dyd_interval_is_point(side)) return DYD_OK;
  DYD_LOCAL(dyd_interval, near);
  mpq_sub(end[0], centre, a);
  mpq_add(end[1], centre, a);
  int64_t bits = dyd_interval_bits(side);
  dyd_status st = dyd_interval_set_outward(&near, end[0], end[1], -bits - 120);
  return st == DYD_OK ? dyd_interval_intersect(side, side, &near) : st;
}

/* The rectangle of site i once measured, if `measured`, else as it is. Proved by 2^-52 of the accuracy more, which
 * holds the double nearest to the decimal that is stated. */
static dyd_status survey_rect(dyd_rect *out, const dyd_survey *s, uint32_t i, bool measured) {
  const dyd_survey_site *p = &s->site[i];
  dyd_rect_set(out, &p->rect);
  if (!measured) return DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, a);
  DYD_LOCAL_ARRAY(mpq_t, end, [2]);
  accuracy_of(a, s, i);
  mpq_div_2exp(end[0], a, 52);
  mpq_add(a, a, end[0]);
  dyd_status st = dyd_survey_cut(&out->x, p->x, a, end);
  return st == DYD_OK ? dyd_survey_cut(&out->y, p->y, a, end) : st;
}

static dyd_status planned_rect(dyd_rect *out, const void *survey, size_t i) {
  const dyd_survey *s = survey;
  return survey_rect(out, s, (uint32_t)i, s->site[i].chosen);
}

static dyd_status centre_rect(dyd_rect *out, const void *survey, size_t i) {
  const dyd_survey *s = survey;
  return dyd_rect_set_q(out, s->site[i].x, s->site[i].y);
}

static dyd_status survey_made(dyd_delaunay **pd, const dyd_survey *s, dyd_rect_fn *rect, const void *user) {
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = s->options.cancel, .threads = s->threads,
                                  .max_bytes = dyd_memory_left(&s->memory)};
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status st = dyd_delaunay_made(pd, s->sites, rect, user, &o, &err);
  if (s->err && st < 0 && err.code == st) *s->err = err;
  return st == DYD_CAPPED ? DYD_OK : st;
}

dyd_status dyd_survey_triangulate(dyd_delaunay **pd, const dyd_survey *s, bool centres) {
  return survey_made(pd, s, centres ? centre_rect : planned_rect, s);
}

static bool survey_is_open(const dyd_delaunay *pd, const dyd_pair *p) {
  dyd_pair_status status = dyd_delaunay_status(pd, p->i, p->j);
  return status == DYD_INDETERMINATE || status == DYD_TIE;
}

/* How many of the targets are open in it. */
static size_t survey_open(const dyd_survey *s, const dyd_delaunay *pd) {
  size_t open = 0;
  for (size_t k = 0; k < s->target.count; k++) open += survey_is_open(pd, &s->target.item[k]);
  return open;
}

/* The accuracy of site i, rounded down. */
static double survey_needed(const dyd_survey *s, uint32_t i) {
  DYD_LOCAL_NUMBERS(mpq, a);
  accuracy_of(a, s, i);
  return dyd_q_brief(a);
}

/* How often its accuracy can be doubled and still asks for a measurement. */
static unsigned survey_doublings(const dyd_survey *s, uint32_t i) {
  long most = 0;
  DYD_LOCAL_NUMBERS(mpq, a);
  accuracy_of(a, s, i);
  if (mpq_sgn(a) > 0) {
    mpq_div(a, s->site[i].half, a);
    most = (long)mpz_sizeinbase(mpq_numref(a), 2) - (long)mpz_sizeinbase(mpq_denref(a), 2);
    if (most > 0) mpq_div_2exp(a, a, (mp_bitcnt_t)most);
    if (mpq_cmp_ui(a, 1, 1) < 0) most--;
  }
  return most > 1 ? (unsigned)most - 1 : 0;
}

/* Sites are measured one by one in a triangulation of all; how many targets each row of a plan decides after the rows
 * before. A pair whose status changes has an end at the site or at a possible neighbour of it [LOC-4]: only these are
 * examined. */

/* Appends the next row of the face worked on. */
static dyd_status choose_site(dyd_survey *s, uint32_t site, size_t decided) {
  if (!DYD_GROW(s->chosen, s->chosen_cap, s->chosens + 1)) return DYD_E_NOMEM;
  s->chosen[s->chosens++] = (dyd_face_row){{.site = site, .decided = decided}, s->faces};
  s->site[site].chosen = true;
  return DYD_OK;
}

static void measuring_note(measuring *m, size_t k) {
  const dyd_pair *p = &m->s->target.item[k];
  if (!m->open[k]) return;
  m->open[k] = false;
  if (m->pair) m->pair[k].row = m->row;
  m->left--, m->degree[p->i]--, m->degree[p->j]--;
}

/* Targets that are open no longer, in the triangulation as it is made. */
static dyd_status measuring_look(measuring *m) {
  uint64_t bytes = dyd_bytes_add(dyd_delaunay_memory(m->now), dyd_steps_bytes(m->now));
  for (size_t k = 0; k < m->s->target.count; k++)
    if (!survey_is_open(m->now, &m->s->target.item[k])) measuring_note(m, k);
  if (!dyd_steps_can(m->now)) return DYD_OK;
  if (!dyd_memory_has(&m->s->memory, bytes, "the plan")) return DYD_E_NOMEM;
  return dyd_steps_begin(&m->steps, m->now, m->s->options.cancel);
}

/* Sites as they are chosen now. To be cleared, whatever it returns. */
static dyd_status measuring_begin(measuring *m, dyd_survey *s) {
  *m = (measuring){.s = s, .left = s->target.count};
  if (!DYD_NEW(m->open, s->target.count) || !DYD_ZEROED(m->degree, s->sites + 1)) return DYD_E_NOMEM;
  for (size_t k = 0; k < s->target.count; k++) {
    m->open[k] = true;
    m->degree[s->target.item[k].i]++, m->degree[s->target.item[k].j]++;
  }
  dyd_status st = dyd_survey_triangulate(&m->now, s, false);
  return st == DYD_OK ? measuring_look(m) : st;
}

static void measuring_clear(measuring *m) {
  dyd_steps_clear(&m->steps);
  dyd_delaunay_free(m->now);
  dyd_free_all(m->open, m->degree);
}

static dyd_status table_rect(dyd_rect *out, const void *sites, size_t i) {
  return dyd_sites_get(out, sites, i);
}

/* Made anew of the rectangles as they are. */
static dyd_status measuring_renew(measuring *m) {
  dyd_delaunay *next = NULL;
  dyd_status st = survey_made(&next, m->s, table_rect, m->now->own);
  if (st != DYD_OK) return st;
  dyd_steps_clear(&m->steps);
  dyd_delaunay_free(m->now);
  m->now = next;
  return measuring_look(m);
}

/* The number of a target; SIZE_MAX: it is none. */
static size_t target_number(const dyd_survey *s, uint32_t i, uint32_t j) {
  const uint32_t key[2] = {i < j ? i : j, i < j ? j : i};
  const dyd_pair *p = dyd_find_two(key, s->target.item, s->target.count, sizeof *p);
  return p ? (size_t)(p - s->target.item) : SIZE_MAX;
}

static bool is_target(void *survey, uint32_t i, uint32_t j) {
  return target_number(survey, i, j) != SIZE_MAX;
}

static void measuring_note_ended(measuring *m) {
  const uint32_t *site = m->now->sk.reps.site;
  for (size_t k = 0; k < m->steps.ended.count; k++) {
    const dyd_vertex_pair *p = &m->steps.pair[m->steps.ended.item[k]];
    size_t number = target_number(m->s, site[p->i], site[p->j]);
    if (number != SIZE_MAX) measuring_note(m, number);
  }
}

/* *decided: how many targets this measurement decides. */
static dyd_status measuring_site(size_t *decided, measuring *m, uint32_t i) {
  size_t before = m->left;
  bool holds = false;
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = survey_rect(&r, m->s, i, true);
  if (st == DYD_OK) st = dyd_sites_narrow(m->now->own, i, &r);
  if (st == DYD_OK && m->steps.pd) st = dyd_steps_narrow(&holds, &m->steps, i);
  if (st == DYD_OK && holds) measuring_note_ended(m);
  if (st == DYD_OK && !holds) st = measuring_renew(m);
  *decided = before - m->left;
  return st;
}

/* The same; it is the next site of the draft. */
static dyd_status measuring_draft(size_t *decided, measuring *m, uint32_t i) {
  dyd_survey *s = m->s;
  m->pair = s->drafted ? NULL : s->pair;
  m->row = s->drafts;
  dyd_status st = measuring_site(decided, m, i);
  if (st != DYD_OK || s->drafted) return st;
  if (!DYD_GROW(s->draft, s->draft_cap, s->drafts + 1)) return DYD_E_NOMEM;
  s->draft[s->drafts++] = (dyd_survey_row){i, dyd_q_double(s->site[i].half, 1), survey_needed(s, i), *decided, m->left};
  return DYD_OK;
}

/* Sets how many pairs each row decides after the rows before it. */
static dyd_status survey_count_left(dyd_survey *s) {
  if (!s->rows) return DYD_OK;
  dyd_survey_pair *pair = dyd_alloc(s->target.count, sizeof *pair);
  for (size_t k = 0; pair && k < s->target.count; k++)
    pair[k] = (dyd_survey_pair){s->pair[k].i, s->pair[k].j, SIZE_MAX};
  for (size_t k = 0; k < s->rows; k++) s->site[s->row[k].site].chosen = false;
  DYD_SCOPED(measuring) m;
  dyd_status st = measuring_begin(&m, s);
  if (!pair) st = DYD_E_NOMEM;
  for (m.pair = pair; m.row < s->rows && st == DYD_OK; m.row++) {
    st = measuring_site(&s->row[m.row].decided, &m, s->row[m.row].site);
    s->row[m.row].left = m.left;
  }
  DYD_INVARIANT(st != DYD_OK || m.left == s->result.left);
  for (size_t k = 0; k < s->rows; k++) s->site[s->row[k].site].chosen = true;
  free(st == DYD_OK ? s->pair : pair);
  if (st == DYD_OK) s->pair = pair;
  return st;
}

/* Large faces. To try every site of one, as is done in small ones, takes as many triangulations as it has sites, for
 * each row; so the ends of most open targets for their cost are measured one after the other, until it has fallen into
 * small faces, which are worked on with care. Sites that were not needed go afterwards, as everywhere. */

/* One in SHARE of the sites that can be measured is, before large faces are sought again. */
enum { SHARE = 16 };

typedef struct crowd_site {
  double worth; /* open targets that end there, for its cost */
  uint32_t site;
} crowd_site;

static int compare_worth(const void *a, const void *b) {
  const crowd_site *x = a, *y = b;
  if (x->worth != y->worth) return x->worth > y->worth ? -1 : 1;
  return (x->site > y->site) - (x->site < y->site);
}

static double worth_of(const measuring *m, uint32_t i) {
  return (double)m->degree[i] / (m->s->options.cost ? m->s->options.cost[i] : 1);
}

/* Marks sites of large faces at which open targets end and that can be measured. */
static dyd_status mark_crowd(bool *mark, const measuring *m) {
  dyd_status st = m->steps.pd ? dyd_steps_large(mark, &m->steps, SURVEY_LARGE) : DYD_OK;
  for (size_t i = 0; i < m->s->sites; i++) {
    const dyd_survey_site *p = &m->s->site[i];
    mark[i] = (mark[i] || !m->steps.pd) && m->degree[i] && !p->chosen && mpq_sgn(p->half) > 0;
  }
  return st;
}

/* They are moved to *crowd, and the marks taken away. */
static size_t list_crowd(crowd_site *crowd, bool *mark, const measuring *m) {
  size_t count = 0;
  for (uint32_t i = 0; i < m->s->sites; i++)
    if (mark[i]) {
      mark[i] = false;
      crowd[count++] = (crowd_site){worth_of(m, i), i};
    }
  if (count) qsort(crowd, count, sizeof *crowd, compare_worth);
  return count;
}

/* Measures the first ones, except sites that are by now worth less than the last of these was: their turn comes. */
static dyd_status measure_first(measuring *m, const crowd_site *crowd, size_t count) {
  size_t first = count / SHARE + 1 < count ? count / SHARE + 1 : count;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < first && st == DYD_OK; k++) {
    uint32_t i = crowd[k].site;
    if (worth_of(m, i) < crowd[first - 1].worth) continue;
    size_t decided;
    st = measuring_draft(&decided, m, i);
    if (st == DYD_OK) st = choose_site(m->s, i, decided);
  }
  return st;
}

/* Chooses in large faces of the triangulation, as sites are chosen now, until they are small or nothing
 * in them is open or can be measured; appends to s->chosen, and to the draft. */
static dyd_status survey_crowds(measuring *m) {
  dyd_survey *s = m->s;
  DYD_FREED bool *mark = calloc(s->sites + 1, sizeof *mark);
  DYD_FREED crowd_site *crowd = dyd_alloc(s->sites, sizeof *crowd);
  dyd_status st = mark && crowd ? DYD_OK : DYD_E_NOMEM;
  for (size_t count = 1; count && st == DYD_OK;) {
    st = mark_crowd(mark, m);
    count = list_crowd(crowd, mark, m);
    if (st == DYD_OK) st = measure_first(m, crowd, count);
  }
  s->faces++;
  return st;
}

/* A try: bits of the sites that were measured in it, and of the targets that it left open. */
typedef struct face_known {
  uint64_t measured, open;
} face_known;

/* Sites and targets by their numbers in the face; measured[k]: how it is tried. */
typedef struct face_try {
  dyd_survey *s;
  const dyd_sites *own; /* NULL: as measured[] says; else they are as in this table */
  dyd_index_list sites;
  dyd_pair *target;
  size_t targets;
  bool *measured, *open; /* open[k]: is target k, in the last try */
  dyd_rect *small;       /* of each site, once measured; NULL with own */
  uint32_t *order;       /* those chosen here */
  size_t *degree;        /* of how many open targets each is an end */
  size_t *left;          /* targets that are open before them, and after each, as they were chosen */
  size_t chosen;
  face_known *known; /* tries so far, where there are bits for all sites and targets */
  size_t knowns, known_cap;
} face_try;

/* The number of a site among these, ascending, or DYD_NONE. */
static uint32_t survey_number_in(const dyd_index_list *sites, uint32_t site) {
  const uint32_t *at = bsearch(&site, sites->item, sites->count, sizeof site, dyd_compare_index);
  return at ? (uint32_t)(at - sites->item) : DYD_NONE;
}

static dyd_status tried_rect(dyd_rect *out, const void *face, size_t k) {
  const face_try *f = face;
  if (f->own) return dyd_sites_get(out, f->own, f->sites.item[k]);
  dyd_rect_set(out, f->measured[k] ? &f->small[k] : &f->s->site[f->sites.item[k]].rect);
  return DYD_OK;
}

static bool has_bits(const face_try *f) {
  return f->sites.count <= 64 && f->targets <= 64;
}

static uint64_t flag_bits(const bool *flag, size_t count) {
  uint64_t bits = 0;
  for (size_t k = 0; k < count; k++) bits |= (uint64_t)flag[k] << k;
  return bits;
}

/* *open: bits of what a try with these sites measured leaves open, if tries so far tell: a smaller rectangle opens no
 * pair, so what fewer sites decide is decided, and what more of them leave open is open. */
static bool face_recalls(uint64_t *open, const face_try *f, uint64_t measured) {
  uint64_t certain = 0;
  *open = UINT64_MAX >> (64 - f->targets);
  for (size_t q = 0; q < f->knowns; q++) {
    const face_known *a = &f->known[q];
    if (!(a->measured & ~measured)) *open &= a->open;
    if (!(measured & ~a->measured)) certain |= a->open;
  }
  return *open == certain;
}

static dyd_status face_remember(face_try *f) {
  if (!has_bits(f)) return DYD_OK;
  if (!DYD_GROW(f->known, f->known_cap, f->knowns + 1)) return DYD_E_NOMEM;
  f->known[f->knowns++] = (face_known){flag_bits(f->measured, f->sites.count), flag_bits(f->open, f->targets)};
  return DYD_OK;
}

static dyd_status face_triangulate(face_try *f) {
  DYD_OWNED(dyd_delaunay) *pd = NULL;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = f->s->options.cancel};
  if (dyd_flag_is_set(o.cancel)) return DYD_CANCELLED;
  dyd_status st = dyd_delaunay_made(&pd, f->sites.count, tried_rect, f, &o, NULL);
  if (st == DYD_CAPPED) st = DYD_OK;
  for (size_t k = 0; k < f->targets && st == DYD_OK; k++) f->open[k] = survey_is_open(pd, &f->target[k]);
  return st;
}

/* How many targets are open; degree[k] (may be NULL): of how many it is an end. */
static void count_open(size_t *open_pairs, size_t *degree, const face_try *f) {
  *open_pairs = 0;
  if (degree) memset(degree, 0, f->sites.count * sizeof *degree);
  for (size_t k = 0; k < f->targets; k++) {
    *open_pairs += f->open[k];
    if (degree && f->open[k]) degree[f->target[k].i]++, degree[f->target[k].j]++;
  }
}

/* The same with sites measured as they are. */
static dyd_status try_face(size_t *open_pairs, size_t *degree, face_try *f) {
  uint64_t open = 0;
  dyd_status st = DYD_OK;
  if (has_bits(f) && face_recalls(&open, f, flag_bits(f->measured, f->sites.count))) {
    DYD_INVARIANT(face_triangulate(f) != DYD_OK || flag_bits(f->open, f->targets) == open);
    for (size_t k = 0; k < f->targets; k++) f->open[k] = open >> k & 1;
  } else {
    st = face_triangulate(f);
    if (st == DYD_OK) st = face_remember(f);
  }
  if (st == DYD_OK) count_open(open_pairs, degree, f);
  return st;
}

static bool can_be_measured(const face_try *f, size_t k) {
  return !f->measured[k] && mpq_sgn(f->s->site[f->sites.item[k]].half) > 0;
}

static double cost_of(const face_try *f, size_t k) {
  return f->s->options.cost ? f->s->options.cost[f->sites.item[k]] : 1;
}

/* The site that decides most for its cost, *left: open pairs after it; where no single one decides anything, an end of
 * most open pairs. The first that decides all is best, unless costs differ. */
static dyd_status best_site(size_t *best, size_t *left, face_try *f, size_t open_pairs) {
  const size_t *open = f->degree;
  double most = 0;
  size_t fallback = f->sites.count, now = 1;
  *best = f->sites.count;
  *left = open_pairs;
  for (size_t k = 0; k < f->sites.count && (now || f->s->options.cost); k++) {
    if (!can_be_measured(f, k)) continue;
    if (fallback == f->sites.count || (double)open[k] * cost_of(f, fallback) > (double)open[fallback] * cost_of(f, k))
      fallback = k;
    f->measured[k] = true;
    dyd_status st = try_face(&now, NULL, f);
    f->measured[k] = false;
    if (st != DYD_OK) return st;
    double gain = ((double)open_pairs - (double)now) / cost_of(f, k);
    if (gain > most) most = gain, *best = k, *left = now;
  }
  if (*best == f->sites.count) *best = fallback;
  return DYD_OK;
}

/* As try_face, before anything is tried: where no site was measured for another face, by the triangulation that has
 * this one [LOC-1]. */
static dyd_status face_open(size_t *open_pairs, size_t *degree, face_try *f, const dyd_delaunay *pd) {
  for (size_t k = 0; k < f->sites.count; k++)
    if (f->measured[k]) return try_face(open_pairs, degree, f);
  for (size_t k = 0; k < f->targets; k++) {
    const dyd_pair *p = &f->target[k];
    f->open[k] = survey_is_open(pd, &(dyd_pair){f->sites.item[p->i], f->sites.item[p->j], p->status});
  }
  count_open(open_pairs, degree, f);
  return DYD_OK;
}

static dyd_status choose_sites(face_try *f, const dyd_delaunay *pd) {
  size_t open_pairs;
  dyd_status st = face_open(&open_pairs, f->degree, f, pd);
  f->left[0] = open_pairs;
  while (st == DYD_OK && open_pairs) {
    size_t best;
    st = best_site(&best, &open_pairs, f, open_pairs);
    if (st != DYD_OK || best == f->sites.count) return st;
    f->measured[best] = true;
    f->order[f->chosen++] = (uint32_t)best;
    if (open_pairs) st = try_face(&open_pairs, f->degree, f);
    f->left[f->chosen] = open_pairs;
  }
  return st;
}

/* Those chosen, the dearest first, of equal cost the first chosen, which knew least of the others. */
static void order_to_drop(uint32_t *dear, const face_try *f) {
  for (size_t q = 0; q < f->chosen; q++) {
    size_t at = q;
    for (; at && cost_of(f, dear[at - 1]) < cost_of(f, f->order[q]); at--) dear[at] = dear[at - 1];
    dear[at] = f->order[q];
  }
}

/* *dropped: some are not needed. */
static dyd_status drop_sites(bool *dropped, face_try *f) {
  size_t wanted = f->left[f->chosen], open_pairs, kept = 0;
  *dropped = false;
  if (f->chosen == 1 && wanted < f->left[0]) return DYD_OK;
  DYD_FREED uint32_t *dear = dyd_alloc(f->chosen, sizeof *dear);
  dyd_status st = dear ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) order_to_drop(dear, f);
  for (size_t q = 0; q < f->chosen && st == DYD_OK; q++) {
    f->measured[dear[q]] = false;
    st = try_face(&open_pairs, NULL, f);
    f->measured[dear[q]] = open_pairs > wanted;
  }
  for (size_t q = 0; q < f->chosen; q++)
    if (f->measured[f->order[q]]) f->order[kept++] = f->order[q];
  *dropped = kept < f->chosen;
  f->chosen = kept;
  return st;
}

/* The rows, in the order chosen, with the number of pairs each decides in the face. dropped: some that were chosen are
 * not among them any more. */
static dyd_status write_rows(face_try *f, bool dropped) {
  dyd_status st = DYD_OK;
  if (!f->chosen) return DYD_OK;
  for (size_t q = 0; q < f->chosen && dropped; q++) f->measured[f->order[q]] = false;
  for (size_t q = 0; q < f->chosen && st == DYD_OK; q++) {
    f->measured[f->order[q]] = true;
    if (dropped) st = try_face(&f->left[q + 1], NULL, f);
    if (st == DYD_OK) st = choose_site(f->s, f->sites.item[f->order[q]], f->left[q] - f->left[q + 1]);
  }
  f->s->faces++;
  return st;
}

/* Allocates for all targets with an end here. */
static bool make_targets(face_try *f) {
  size_t most = 0;
  for (size_t a = 0; a < f->sites.count; a++) most += f->s->first[f->sites.item[a] + 1] - f->s->first[f->sites.item[a]];
  return DYD_NEW(f->target, most) && DYD_NEW(f->open, most);
}

static void take_targets(face_try *f) {
  const dyd_survey *s = f->s;
  for (size_t a = 0; a < f->sites.count; a++)
    for (size_t k = s->first[f->sites.item[a]]; k < s->first[f->sites.item[a] + 1]; k++) {
      const dyd_pair *p = &s->target.item[s->at[k]];
      uint32_t j = p->i == f->sites.item[a] ? survey_number_in(&f->sites, p->j) : DYD_NONE;
      if (j != DYD_NONE) f->target[f->targets++] = (dyd_pair){(uint32_t)a, j, p->status};
    }
}

/* The rectangles of all sites, once measured. */
static dyd_status make_small(face_try *f) {
  size_t n = f->sites.count;
  dyd_status st = DYD_NEW(f->small, n) ? DYD_OK : DYD_E_NOMEM;
  for (size_t k = 0; k < n && f->small; k++) dyd_rect_init(&f->small[k]);
  for (size_t k = 0; k < n && st == DYD_OK; k++) st = survey_rect(&f->small[k], f->s, f->sites.item[k], true);
  return st;
}

/* Room for n sites; measured as they are chosen now. */
static dyd_status face_begin(face_try *f) {
  size_t n = f->sites.count;
  f->degree = calloc(n + 1, sizeof *f->degree);
  f->measured = dyd_alloc(n, sizeof *f->measured);
  f->order = dyd_alloc(n, sizeof *f->order);
  f->left = dyd_alloc(n + 1, sizeof *f->left);
  if (!f->degree || !make_targets(f) || !f->measured || !f->order || !f->left) return DYD_E_NOMEM;
  for (size_t k = 0; k < n; k++) f->measured[k] = f->s->site[f->sites.item[k]].chosen;
  take_targets(f);
  return f->own || !f->targets ? DYD_OK : make_small(f);
}

static void face_try_clear(face_try *f) {
  for (size_t k = 0; f->small && k < f->sites.count; k++) dyd_rect_clear(&f->small[k]);
  dyd_free_all(f->degree, f->target, f->measured, f->order, f->left);
  dyd_free_all(f->small, f->open, f->known);
  dyd_index_list_clear(&f->sites);
}

/* Chooses among the sites of face f of pd so that its targets are decided; appends to s->chosen. */
static dyd_status survey_in_face(dyd_survey *s, const dyd_delaunay *pd, size_t face) {
  DYD_SCOPED(face_try) f = {.s = s};
  bool outer, dropped;
  dyd_status st = dyd_delaunay_face(&f.sites, &outer, pd, face);
  if (st == DYD_OK) st = face_begin(&f);
  if (st == DYD_OK && f.targets) st = choose_sites(&f, pd);
  if (st == DYD_OK && f.targets) st = drop_sites(&dropped, &f);
  return st == DYD_OK && f.targets ? write_rows(&f, dropped) : st;
}

/* How many targets of the part that the step reached are open in it. */
static dyd_status part_open(size_t *open_pairs, measuring *m) {
  DYD_SCOPED(face_try) f = {.s = m->s, .own = m->now->own};
  *open_pairs = 0;
  dyd_status st = dyd_steps_part_sites(&f.sites, &m->steps);
  if (st == DYD_OK) st = face_begin(&f);
  return st == DYD_OK && f.targets ? try_face(open_pairs, NULL, &f) : st;
}

/* Pairs of faces in the part are counted in a triangulation of the part alone [LOC-1]. */
static dyd_status part_holds(bool *holds, measuring *m, uint32_t i, const dyd_rect *old, const dyd_rect *now) {
  size_t before = 0, after = 0;
  if (dyd_steps_part_is_sure(&m->steps)) return DYD_OK;
  dyd_status st = part_open(&after, m);
  if (st == DYD_OK && after) st = dyd_sites_replace(m->now->own, i, old);
  if (st == DYD_OK && after) st = part_open(&before, m);
  if (st == DYD_OK && after) st = dyd_sites_replace(m->now->own, i, now);
  *holds = after <= before;
  return st;
}

/* Without steps: in a triangulation of all. */
static dyd_status all_holds(bool *holds, dyd_survey *s, size_t before) {
  DYD_OWNED(dyd_delaunay) *pd = NULL;
  dyd_status st = dyd_survey_triangulate(&pd, s, false);
  *holds = st == DYD_OK && survey_open(s, pd) <= before;
  return st;
}

/* Site i is wider in the survey than where it is measured one by one: *holds if no more targets are open so; then it is
 * as wide there, else nothing has changed. */
static dyd_status measuring_loosens(bool *holds, measuring *m, uint32_t i) {
  if (!m->steps.pd) return all_holds(holds, m->s, m->left);
  DYD_LOCAL(dyd_rect, old, now);
  *holds = false;
  dyd_status st = dyd_sites_get(&old, m->now->own, i);
  if (st == DYD_OK) st = survey_rect(&now, m->s, i, m->s->site[i].chosen);
  if (st == DYD_OK) st = dyd_sites_replace(m->now->own, i, &now);
  if (st == DYD_OK) st = dyd_steps_widen(holds, &m->steps, i, is_target, m->s);
  if (st == DYD_OK && *holds) st = part_holds(holds, m, i, &old, &now);
  if (st == DYD_OK && !*holds) {
    st = dyd_sites_replace(m->now->own, i, &old);
    dyd_steps_back(&m->steps, i);
  }
  return st;
}

/* ---- choosing ---- */

static bool has_large_face(const dyd_delaunay *pd) {
  DYD_SCOPED(dyd_index_list) face = {0};
  bool outer, large = false;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd) && !large; f++)
    large = dyd_delaunay_face(&face, &outer, pd, f) == DYD_OK && face.count > SURVEY_LARGE;
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
  if (st == DYD_OK) s->result.left = survey_open(s, now);
  for (size_t k = 0; k < s->target.count && st == DYD_OK && near; k++) {
    const dyd_pair *p = &s->target.item[k];
    if (!survey_is_open(now, p)) continue;
    st = mark_near(near, now, p->i);
    if (st == DYD_OK) st = mark_near(near, now, p->j);
  }
  return st;
}

/* In all faces of pd, one by one; the sites chosen are measured in the triangulation of all. */
static dyd_status choose_in_faces(measuring *m, const dyd_delaunay *pd) {
  dyd_survey *s = m->s;
  dyd_status st = DYD_OK;
  for (size_t f = 0; st == DYD_OK && f < dyd_delaunay_undecided_faces(pd); f++) {
    size_t decided, before = s->chosens;
    st = survey_in_face(s, pd, f);
    for (size_t k = before; k < s->chosens && st == DYD_OK; k++)
      st = measuring_draft(&decided, m, s->chosen[k].row.site);
  }
  return st;
}

/* In large faces; then in all faces of the triangulation with the chosen sites measured, as long as that helps. */
static dyd_status measure_rounds(measuring *m, const dyd_delaunay *pd) {
  dyd_survey *s = m->s;
  dyd_status st = has_large_face(pd) ? survey_crowds(m) : DYD_OK;
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
  DYD_SCOPED(measuring) m;
  s->result.left = s->target.count;
  dyd_status st = measuring_begin(&m, s);
  if (st == DYD_OK) st = measure_rounds(&m, pd);
  if (st == DYD_OK) s->result.left = m.left;
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
  measuring m;
  size_t before = s->result.left;
  dyd_status st = measuring_begin(&m, s);
  for (size_t k = 0; k < s->chosens && st == DYD_OK; k++) {
    uint32_t site = s->chosen[k].row.site;
    bool holds = false;
    s->site[site].chosen = false;
    st = measuring_loosens(&holds, &m, site);
    s->site[site].chosen = !holds;
  }
  measuring_clear(&m);
  if (st == DYD_OK) st = restore_open(s, before);
  settle_rows(s);
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
static dyd_status loosen_site(measuring *m, uint32_t site, unsigned most) {
  unsigned least = 0;
  dyd_status st = DYD_OK;
  while (least < most && st == DYD_OK) {
    bool holds;
    unsigned middle = least + (most - least + 1) / 2;
    m->s->site[site].coarser = middle;
    st = measuring_loosens(&holds, m, site);
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
  measuring m;
  size_t before = s->result.left;
  dyd_status st = measuring_begin(&m, s);
  for (size_t k = 0; k < s->chosens && st == DYD_OK; k++)
    st = loosen_site(&m, s->chosen[k].row.site, survey_doublings(s, s->chosen[k].row.site));
  measuring_clear(&m);
  return st == DYD_OK ? restore_open(s, before) : st;
}

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
    row.now = dyd_q_double(s->site[row.site].half, 1);
    row.needed = survey_needed(s, row.site);
    s->row[s->rows] = row;
  }
  return st;
}

/* Where this was not enough, sites are measured more finely, and others with them. The draft stays as it is. */
static dyd_status choose_finely_enough(dyd_survey *s, const dyd_delaunay *pd) {
  static const int finer[] = {10, 20, 40}; /* shares of each half-width: tried until one decides */
  dyd_status st = DYD_OK;
  mpq_set_ui(s->scale, 1, 1);
  if (dyd_survey_is_limited(s)) return choose_rounds(s, pd);
  for (size_t k = 0; k < sizeof finer / sizeof *finer && st == DYD_OK && (k == 0 || s->result.left); k++) {
    mpq_set_ui(s->scale, 1, 1);
    mpq_div_2exp(s->scale, s->scale, (mp_bitcnt_t)finer[k]);
    st = choose_rounds(s, pd);
    s->drafted = true;
  }
  return st;
}

dyd_status dyd_survey_choose(dyd_survey *s, const dyd_delaunay *pd) {
  dyd_status st = choose_finely_enough(s, pd);
  if (st == DYD_OK) st = unchoose(s);
  if (st == DYD_OK) st = loosen(s);
  if (st == DYD_OK) st = loosen_each(s);
  if (st == DYD_OK) st = merge_rows(s);
  return st == DYD_OK ? survey_count_left(s) : st;
}
