/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The section on discs of a certificate: for each pair that the discs decide a witness, or sites whose caps hold all
 * directions [CERT-11].
 *
 * The sites in possible pairs with one of its ends are tried for a pair first. Directions are numbers of
 * PRECISION bits: they prove nothing themselves, each result passes the checker's own tests. */
#include "tolerance/discs.h"
#include "base/alloc.h"
#include "base/index.h"
#include "base/local.h"
#include "checker/caps.h"
#include "checker/checker.h"
#include "delaunay/memory.h"
#include "engine/points.h"
#include "prove/proof.h"

#include <inttypes.h>
#include <string.h>

/* The pairs of a certificate: open ones, and illegal ones of open sets, each with its chain.
 *
 * Blockers are looked for first among those of the pairs just before with the same site i, as a few sites round i block
 * most others; then among the sites of the set and the neighbours of the two; then among all. */

/* Effort after which the search for chains gives up: 1 for each blocker tried, CHAIN_PAIR for each search. */
#define CHAIN_EFFORT ((uint64_t)300 * 1000 * 1000)

#define CHAIN_PAIR 200

#define RECENT 40

/* A line of the section: an open pair, or an illegal one of an open set, to be proved. Invariant: i < j. */
typedef struct pair_line {
  uint32_t i, j;
  char kind;
} pair_line;

typedef struct pair_lines {
  pair_line *item;
  size_t count, cap;
} pair_lines;

static dyd_status add_line(pair_lines *l, uint32_t i, uint32_t j, char kind) {
  if (!DYD_GROW(l->item, l->cap, l->count + 1)) return DYD_E_NOMEM;
  l->item[l->count++] = (pair_line){i, j, kind};
  return DYD_OK;
}

static dyd_status open_lines(pair_lines *l, dyd_proof *p) {
  static const char kind[] = {[DYD_TIE] = 't', [DYD_INDETERMINATE] = 'o', [DYD_LEGAL] = 'l'};
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < p->pairs.count && st == DYD_OK; k++) {
    const dyd_pair *q = &p->pairs.item[k];
    if (q->status == DYD_LEGAL && dyd_cert_edges_have(&p->legal, q->i, q->j)) continue;
    st = add_line(l, q->i, q->j, kind[q->status]);
    if (st == DYD_OK) st = dyd_cert_edges_add(&p->open, q->i, q->j);
  }
  return st;
}

static bool pair_is_listed(const dyd_proof *p, uint32_t i, uint32_t j) {
  return dyd_cert_edges_have(&p->legal, i, j) || dyd_cert_edges_have(&p->open, i, j);
}

static dyd_status unlisted_lines(pair_lines *l, const dyd_proof *p) {
  uint64_t effort = 0;
  dyd_status st = DYD_OK;
  for (size_t f = 0; f < p->faces.sets; f++) {
    const uint32_t *site = p->faces.member + p->faces.start[f];
    uint64_t m = p->faces.start[f + 1] - p->faces.start[f];
    if (m < 3 || p->faces.covered[f] == m * (m - 1) / 2) continue;
    for (size_t a = 0; a < m; a++)
      for (size_t b = a + 1; b < m && st == DYD_OK && effort < CHAIN_EFFORT; b++) {
        if (pair_is_listed(p, site[a], site[b])) continue;
        st = add_line(l, site[a], site[b], 'n');
        effort += CHAIN_PAIR;
      }
  }
  return st;
}

/* The pairs that boxes leave; all of open sets that are not listed, as far as the effort allows, where boxes give up.
 */
static dyd_status illegal_lines(pair_lines *l, dyd_proof *p) {
  static const dyd_cert_edges none = {0};
  const dyd_cert_known known = {{&p->legal, &p->open, &none}};
  dyd_cert_edges left;
  bool given_up;
  dyd_status st = dyd_cert_boxes_left(&left, &given_up, &p->sites, &p->faces, &known);
  if (st != DYD_OK) return st;
  for (size_t e = 0; e < left.count && e < CHAIN_EFFORT / CHAIN_PAIR && st == DYD_OK; e++)
    st = add_line(l, left.item[e].i, left.item[e].j, 'n');
  free(left.item);
  return st == DYD_OK && given_up ? unlisted_lines(l, p) : st;
}

/* Where blockers are looked for, owned; what the searches have cost; blockers that were of use for site `of`. */
typedef struct blockers {
  uint32_t *site;
  size_t count, cap;
  uint64_t effort;
  uint32_t of, recent[RECENT];
  size_t recents;
} blockers;

static dyd_status add_blockers(blockers *b, const uint32_t *site, size_t count) {
  if (!DYD_GROW(b->site, b->cap, b->count + count)) return DYD_E_NOMEM;
  if (count) memcpy(b->site + b->count, site, count * sizeof *site);
  b->count += count;
  return DYD_OK;
}

static dyd_status add_neighbours(blockers *b, const dyd_proof *p, uint32_t v) {
  dyd_status st = DYD_OK;
  for (size_t q = p->graph.start[v]; q < p->graph.start[v + 1] && st == DYD_OK; q++) {
    uint32_t w = dyd_cert_origin(&p->graph, p->graph.around[q] ^ 1);
    st = add_blockers(b, &w, 1);
  }
  return st;
}

static dyd_status find_blockers(blockers *b, const dyd_proof *p, uint32_t i, uint32_t j) {
  const dyd_cert_faces *f = &p->faces;
  b->count = 0;
  dyd_status st = add_neighbours(b, p, i);
  if (st == DYD_OK) st = add_neighbours(b, p, j);
  for (size_t k = f->first[i]; k < f->first[i + 1] && st == DYD_OK; k++) {
    bool shared = false;
    for (size_t l = f->first[j]; l < f->first[j + 1]; l++) shared |= f->of[k] == f->of[l];
    size_t start = f->start[f->of[k]];
    if (shared) st = add_blockers(b, f->member + start, f->start[f->of[k] + 1] - start);
  }
  return st;
}

static dyd_status all_blockers(blockers *b, const dyd_proof *p) {
  dyd_status st = DYD_OK;
  b->count = 0;
  for (uint32_t v = 0; v < p->sites.count && st == DYD_OK; v++)
    if (p->sites.site[v].alias == v) st = add_blockers(b, &v, 1);
  return st;
}

static dyd_status recent_blockers(blockers *b, uint32_t i) {
  if (b->of != i) b->recents = 0;
  b->of = i;
  b->count = 0;
  return add_blockers(b, b->recent, b->recents);
}

static void remember_blockers(blockers *b, const dyd_cert_chain *chain) {
  for (size_t q = 0; q <= chain->points && b->recents < RECENT; q++) {
    size_t k = 0;
    while (k < b->recents && b->recent[k] != chain->blocker[q]) k++;
    if (k == b->recents) b->recent[b->recents++] = chain->blocker[q];
  }
}

static dyd_status pair_chain(bool *found, dyd_cert_chain *chain, blockers *b, const dyd_proof *p, const pair_line *l) {
  dyd_status st = DYD_OK;
  *found = false;
  for (int wider = 0; wider < 3 && st == DYD_OK && !*found && b->effort < CHAIN_EFFORT; wider++) {
    st = wider == 0 ? recent_blockers(b, l->i) : wider == 1 ? find_blockers(b, p, l->i, l->j) : all_blockers(b, p);
    if (st != DYD_OK || b->count == 0) continue;
    b->effort += b->count + CHAIN_PAIR;
    st = dyd_proof_find_chain(found, chain, p, l->i, l->j, b->site, b->count);
  }
  if (*found) remember_blockers(b, chain);
  return st;
}

static dyd_status pair_put_chain(FILE *out, dyd_cert_chain *chain, blockers *near, dyd_proof *p, const pair_line *l) {
  bool found;
  dyd_status st = pair_chain(&found, chain, near, p, l);
  if (st != DYD_OK || !found) return st;
  dyd_proof_put(out, "n %i %i %p", l->i, l->j, chain->u[0]);
  for (size_t q = 0; q < chain->points; q++) dyd_proof_put(out, " %i %p", chain->blocker[q], chain->point[q]);
  dyd_proof_put(out, " %i %p\n", chain->blocker[chain->points], chain->u[1]);
  dyd_cert_faces_cover(&p->faces, l->i, l->j);
  return dyd_cert_edges_add(&p->chained, l->i, l->j);
}

static dyd_status pair_put_lines(FILE *out, dyd_proof *p, const pair_lines *l) {
  blockers near = {0};
  DYD_LOCAL(dyd_cert_chain, chain);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < l->count && st == DYD_OK; k++) {
    const pair_line *at = &l->item[k];
    if (k && dyd_compare_two(at, at - 1) == 0) continue; /* a pair of two sets */
    if (at->kind == 'n')
      st = pair_put_chain(out, &chain, &near, p, at);
    else
      fprintf(out, "%c %" PRIu32 " %" PRIu32 "\n", at->kind, at->i, at->j);
  }
  free(near.site);
  return st;
}

/* Boxes may prove pairs that no line proves. */
static dyd_status pair_put_boxes(FILE *out, dyd_proof *p) {
  const dyd_cert_known known = {{&p->legal, &p->open, &p->chained}};
  uint64_t before = dyd_cert_faces_left(&p->faces);
  p->unproved = before;
  if (before == 0 || dyd_delaunay_is_capped(p->pd)) return DYD_OK;
  dyd_status st = dyd_cert_boxes_unproved(&p->unproved, &p->sites, &p->faces, &known);
  if (st == DYD_OK && p->unproved < before) fprintf(out, "boxes %" PRIu64 "\n", before - p->unproved);
  return st;
}

dyd_status dyd_proof_put_pairs(FILE *out, dyd_proof *p) {
  pair_lines l = {0};
  fputs("pairs\n", out);
  dyd_status st = open_lines(&l, p);
  for (size_t k = 0; k < l.count; k++) dyd_cert_faces_cover(&p->faces, l.item[k].i, l.item[k].j);
  if (st == DYD_OK && dyd_cert_faces_left(&p->faces) && !dyd_delaunay_is_capped(p->pd)) st = illegal_lines(&l, p);
  if (st == DYD_OK && l.count) qsort(l.item, l.count, sizeof *l.item, dyd_compare_two);
  if (st == DYD_OK) st = pair_put_lines(out, p, &l);
  if (st == DYD_OK) st = pair_put_boxes(out, p);
  free(l.item);
  return st;
}

enum { PRECISION = 256, MOST_ADDED = 64, MOST_MET = 64 };

typedef struct mpf_vector {
  mpf_t x, y;
} mpf_vector;

/* near: sites with their caps in `all`: cap k + 1 is that of site near[k]. some: those of a proof. */
typedef struct disc_proof {
  const dyd_proof *p;
  const dyd_pair_list *pairs;
  dyd_cert_disc *disc;
  size_t *start; /* partner[start[i] .. start[i + 1] - 1]: in possible pairs with site i */
  uint32_t *partner;
  uint32_t *near, *chosen;
  size_t near_count, near_cap, chosen_count, chosen_cap;
  dyd_cert_caps all, some;
  dyd_exact at[2];                   /* the witness found last */
  mpf_vector u, from, to, end, axis; /* scratch */
  mpf_t s, t, best;
} disc_proof;

/* ---- discs ---- */

dyd_status dyd_proof_gather_discs(dyd_cert_disc **out, bool *fixed, const dyd_proof *p) {
  const dyd_sites *sites = dyd_delaunay_sites(p->pd);
  dyd_cert_disc *disc = *out = dyd_alloc(p->sites.count, sizeof *disc);
  dyd_status st = DYD_OK;
  *fixed = true;
  if (!disc) return DYD_E_NOMEM;
  for (size_t i = 0; i < p->sites.count; i++) dyd_cert_disc_init(&disc[i]);
  DYD_LOCAL(dyd_disc, d);
  for (size_t i = 0; i < p->sites.count && st == DYD_OK; i++) {
    const dyd_refinable *point = dyd_engine_find(p->engine, (uint32_t)i);
    *fixed = *fixed && (!point || point->final);
    st = dyd_disc_of_site(&d, sites, i);
    if (st == DYD_OK) dyd_proof_hold_disc(&disc[i], &d);
  }
  return st;
}

void dyd_proof_put_disc_lines(FILE *out, const dyd_cert_disc *disc, bool fixed, const dyd_proof *p) {
  size_t count = 0;
  for (size_t i = 0; i < p->sites.count; i++) count += p->sites.site[i].alias == i;
  fprintf(out, "discs %zu%s\n", count, fixed ? " fixed" : "");
  for (size_t i = 0; i < p->sites.count; i++)
    if (p->sites.site[i].alias == i) dyd_proof_put(out, "%n %n %n\n", &disc[i].x, &disc[i].y, &disc[i].r);
}

void dyd_proof_free_discs(dyd_cert_disc *disc, const dyd_proof *p) {
  for (size_t i = 0; disc && i < p->sites.count; i++) dyd_cert_disc_clear(&disc[i]);
  free(disc);
}

/* ---- vectors ---- */

static void set_float(mpf_ptr out, const dyd_exact *x) {
  mpf_set_z(out, x->man);
  if (x->exp < 0)
    mpf_div_2exp(out, out, (mp_bitcnt_t)-x->exp);
  else
    mpf_mul_2exp(out, out, (mp_bitcnt_t)x->exp);
}

/* out = u.w - tau. */
static void height_in_cap(mpf_ptr out, disc_proof *w, const dyd_cert_cap *k) {
  set_float(w->s, &k->wx);
  mpf_mul(out, w->s, w->u.x);
  set_float(w->s, &k->wy);
  mpf_mul(w->s, w->s, w->u.y);
  mpf_add(out, out, w->s);
  set_float(w->s, &k->tau);
  mpf_sub(out, out, w->s);
}

/* The sign of the cross product. */
static int turn_of(disc_proof *w, const mpf_vector *a, const mpf_vector *b) {
  mpf_mul(w->s, a->x, b->y);
  mpf_mul(w->t, a->y, b->x);
  return mpf_cmp(w->s, w->t);
}

/* The end of a cap that is not empty. */
static void end_of_cap(mpf_vector *out, disc_proof *w, const dyd_cert_cap *e, int turn) {
  const mpf_vector *v = &w->axis;
  set_float(w->t, &e->c);
  mpf_sqrt(w->t, w->t);
  if (turn < 0) mpf_neg(w->t, w->t);
  set_float(w->axis.x, &e->wx);
  set_float(w->axis.y, &e->wy);
  set_float(w->s, &e->tau);
  mpf_mul(out->x, w->s, v->x);
  mpf_mul(out->y, w->s, v->y);
  mpf_mul(w->s, w->t, v->y);
  mpf_sub(out->x, out->x, w->s);
  mpf_mul(w->s, w->t, v->x);
  mpf_add(out->y, out->y, w->s);
  set_float(w->s, &e->ww);
  mpf_div(out->x, out->x, w->s);
  mpf_div(out->y, out->y, w->s);
}

/* Makes its length 1; false: it is 0. */
static bool make_unit(disc_proof *w, mpf_vector *v) {
  mpf_mul(w->s, v->x, v->x);
  mpf_mul(w->t, v->y, v->y);
  mpf_add(w->s, w->s, w->t);
  mpf_sqrt(w->s, w->s);
  if (!mpf_sgn(w->s)) return false;
  mpf_div(v->x, v->x, w->s);
  mpf_div(v->y, v->y, w->s);
  return true;
}

/* ---- sites near a pair ---- */

static dyd_status add_near(disc_proof *w, uint32_t v, uint32_t i, uint32_t j) {
  bool added;
  for (size_t k = 0; k < w->near_count; k++)
    if (w->near[k] == v) return DYD_OK;
  if (v == i || v == j) return DYD_OK;
  if (!DYD_GROW(w->near, w->near_cap, w->near_count + 1)) return DYD_E_NOMEM;
  dyd_status st = dyd_cert_caps_add(&added, &w->all, &w->disc[v]);
  if (st == DYD_OK && added) w->near[w->near_count++] = v;
  return st;
}

static dyd_status begin_pair(bool *good, disc_proof *w, uint32_t i, uint32_t j) {
  const uint32_t end[2] = {i, j};
  w->near_count = w->chosen_count = 0;
  dyd_status st = dyd_cert_caps_begin(good, &w->all, &w->disc[i], &w->disc[j]);
  for (int q = 0; q < 2 && st == DYD_OK && *good; q++)
    for (size_t k = w->start[end[q]]; k < w->start[end[q] + 1] && st == DYD_OK; k++)
      st = add_near(w, w->partner[k], i, j);
  return st;
}

/* ---- illegal ---- */

/* The cap that holds u, and highest, as circles go: (u.w - tau) / n; false: none does. */
static bool highest_cap(size_t *out, disc_proof *w) {
  mpf_set_ui(w->best, 0);
  for (size_t k = 1; k < w->all.count; k++) {
    height_in_cap(w->t, w, &w->all.item[k]);
    set_float(w->s, &w->all.item[k].n);
    mpf_div(w->t, w->t, w->s);
    if (mpf_cmp(w->t, w->best) <= 0) continue;
    mpf_set(w->best, w->t);
    *out = k;
  }
  return mpf_sgn(w->best) > 0;
}

/* All other sites, when those near leave a direction. */
static dyd_status add_all_sites(disc_proof *w, uint32_t i, uint32_t j) {
  dyd_status st = DYD_OK;
  for (uint32_t v = 0; v < w->p->sites.count && st == DYD_OK; v++)
    if (w->p->sites.site[v].alias == v) st = add_near(w, v, i, j);
  return st;
}

static dyd_status choose_cap(disc_proof *w, size_t k) {
  bool added;
  uint32_t v = w->near[k - 1];
  if (!DYD_GROW(w->chosen, w->chosen_cap, w->chosen_count + 1)) return DYD_E_NOMEM;
  w->chosen[w->chosen_count++] = v;
  return dyd_cert_caps_add(&added, &w->some, &w->disc[v]);
}

/* w->chosen becomes the sites whose caps hold all directions. */
static dyd_status find_caps(bool *found, disc_proof *w, uint32_t i, uint32_t j) {
  bool good, all = false;
  dyd_status st = begin_pair(&good, w, i, j);
  if (st == DYD_OK && good) st = dyd_cert_caps_begin(&good, &w->some, &w->disc[i], &w->disc[j]);
  *found = false;
  while (st == DYD_OK && good && w->chosen_count < MOST_ADDED) {
    size_t end, k = 0;
    *found = dyd_cert_caps_cover(&end, &w->some);
    if (*found || end == w->some.count) break;
    end_of_cap(&w->u, w, &w->some.item[end], 1);
    bool blocked = highest_cap(&k, w);
    if (!blocked && !all) {
      st = add_all_sites(w, i, j);
      all = true;
      blocked = st == DYD_OK && highest_cap(&k, w);
    }
    if (!blocked) break;
    if (st == DYD_OK) st = choose_cap(w, k);
  }
  return st;
}

/* ---- legal ---- */

/* Cuts the arc from w->from to w->to, at most half a turn, to its part in the cap. */
static void narrow_arc(disc_proof *w, const dyd_cert_cap *k) {
  mpf_vector *const ends[2] = {&w->from, &w->to};
  for (int side = 0; side < 2; side++) {
    end_of_cap(&w->end, w, k, side ? 1 : -1);
    if (turn_of(w, &w->from, &w->end) < 0 || turn_of(w, &w->end, &w->to) < 0) continue;
    mpf_set(ends[side]->x, w->end.x);
    mpf_set(ends[side]->y, w->end.y);
  }
}

/* w->u = the opposite of the middle of the common part of all caps: the direction of a witness. */
static bool common_direction(disc_proof *w) {
  const dyd_cert_cap *own = &w->all.item[0];
  end_of_cap(&w->from, w, own, -1);
  end_of_cap(&w->to, w, own, 1);
  for (size_t k = 1; k < w->all.count; k++) {
    if (dyd_exact_sgn(&w->all.item[k].c) <= 0) return false;
    narrow_arc(w, &w->all.item[k]);
  }
  mpf_add(w->u.x, w->from.x, w->to.x);
  mpf_add(w->u.y, w->from.y, w->to.y);
  if (w->all.count == 1) {
    set_float(w->u.x, &own->wx);
    set_float(w->u.y, &own->wy);
  }
  mpf_neg(w->u.x, w->u.x);
  mpf_neg(w->u.y, w->u.y);
  return make_unit(w, &w->u);
}

/* x = about a + b, rounded to a multiple of 2^exp. */
static void put_rounded(dyd_exact *x, disc_proof *w, const dyd_exact *a, mpf_srcptr b, int64_t exp) {
  set_float(w->s, a);
  mpf_add(w->s, w->s, b);
  if (exp < 0)
    mpf_mul_2exp(w->s, w->s, (mp_bitcnt_t)-exp);
  else
    mpf_div_2exp(w->s, w->s, (mp_bitcnt_t)exp);
  mpf_floor(w->s, w->s);
  mpz_set_f(x->man, w->s);
  x->exp = exp;
}

/* The centre p_i + u / (2 h), h = (u.P_j - delta) / N_j, with as few digits as make it a witness; or *other is one too
 * near. */
static bool round_centre(dyd_exact at[2], uint32_t *other, disc_proof *w, uint32_t i, uint32_t j) {
  mpf_vector *to = &w->end;
  long top;
  const dyd_proof *p = w->p;
  bool good = false;
  mpf_neg(w->u.x, w->u.x);
  mpf_neg(w->u.y, w->u.y);
  height_in_cap(w->best, w, &w->all.item[0]); /* of the opposite: u.P_j - delta */
  mpf_neg(w->u.x, w->u.x);
  mpf_neg(w->u.y, w->u.y);
  set_float(w->s, &w->all.nj);
  if (mpf_sgn(w->best) > 0) {
    mpf_div(w->best, w->s, w->best);
    mpf_div_2exp(w->best, w->best, 1);
    mpf_mul(to->x, w->u.x, w->best);
    mpf_mul(to->y, w->u.y, w->best);
    mpf_get_d_2exp(&top, w->best);
    for (int bits = 4; bits < PRECISION && !good; bits += bits < 64 ? 4 : 32) {
      put_rounded(&at[0], w, &w->all.i->x, to->x, top - bits);
      put_rounded(&at[1], w, &w->all.i->y, to->y, top - bits);
      good = dyd_cert_is_disc_witness(other, &p->sites, &p->tree, w->disc, i, j, at);
    }
  }
  return good;
}

/* w->at becomes the witness of a pair of discs. */
static dyd_status find_disc_witness(bool *found, disc_proof *w, uint32_t i, uint32_t j) {
  bool good;
  dyd_exact *at = w->at;
  dyd_status st = begin_pair(&good, w, i, j);
  *found = false;
  if (st == DYD_OK && !good) { /* the larger disc's own centre is best */
    dyd_exact_set(&at[0], &w->all.j->x);
    dyd_exact_set(&at[1], &w->all.j->y);
    *found = dyd_cert_is_disc_witness(NULL, &w->p->sites, &w->p->tree, w->disc, i, j, at);
  }
  for (int met = 0; st == DYD_OK && good && !*found && met < MOST_MET; met++) {
    uint32_t other = DYD_CERT_NONE;
    size_t before = w->all.count;
    if (!common_direction(w)) break;
    *found = round_centre(at, &other, w, i, j);
    if (!*found && other != DYD_CERT_NONE) st = add_near(w, other, i, j);
    if (!*found && w->all.count == before) break;
  }
  return st;
}

/* ---- writing ---- */

static dyd_status put_refined(FILE *out, disc_proof *w, const dyd_pair *q, bool legal) {
  bool found = false;
  dyd_status st = legal ? find_disc_witness(&found, w, q->i, q->j) : find_caps(&found, w, q->i, q->j);
  if (st != DYD_OK) return st;
  dyd_proof_put(out, legal ? "l %i %i" : "n %i %i", q->i, q->j);
  if (found && legal) dyd_proof_put(out, " %p", w->at);
  for (size_t k = 0; found && !legal && k < w->chosen_count; k++) dyd_proof_put(out, " %i", w->chosen[k]);
  putc('\n', out);
  return DYD_OK;
}

/* The pairs of the squares that are indeterminate, and those of the discs, are both sorted. Counts, or writes. */
static dyd_status each_refined(size_t *count, FILE *out, disc_proof *w) {
  const dyd_pair_list *squares = &w->p->pairs;
  size_t d = 0;
  dyd_status st = DYD_OK;
  *count = 0;
  for (size_t k = 0; k < squares->count && st == DYD_OK; k++) {
    const dyd_pair *q = &squares->item[k];
    while (d < w->pairs->count && dyd_compare_two(&w->pairs->item[d], q) < 0) d++;
    bool there = d < w->pairs->count && dyd_compare_two(&w->pairs->item[d], q) == 0;
    if (q->status != DYD_INDETERMINATE || (there && w->pairs->item[d].status == DYD_INDETERMINATE)) continue;
    ++*count;
    if (out) st = put_refined(out, w, q, there);
  }
  return st;
}

/* ---- the section ---- */

static void init_search(disc_proof *w) {
  mpf_ptr all[] = {w->u.x,   w->u.y,    w->from.x, w->from.y, w->to.x, w->to.y, w->end.x,
                   w->end.y, w->axis.x, w->axis.y, w->s,      w->t,    w->best};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) mpf_init2(all[k], PRECISION);
  dyd_proof_init(w->at, 2);
  dyd_cert_caps_init(&w->all);
  dyd_cert_caps_init(&w->some);
}

static void clear_search(disc_proof *w) {
  mpf_clears(w->u.x, w->u.y, w->from.x, w->from.y, w->to.x, w->to.y, w->end.x, w->end.y, w->axis.x, w->axis.y, w->s,
             w->t, w->best, NULL);
  dyd_cert_caps_clear(&w->all);
  dyd_cert_caps_clear(&w->some);
  dyd_proof_free_discs(w->disc, w->p);
  dyd_proof_clear(w->at, 2);
  dyd_free_all(w->start, w->partner, w->near, w->chosen);
}

static dyd_status put_discs(FILE *out, disc_proof *w) {
  size_t count = 0;
  bool fixed;
  dyd_status st = dyd_proof_gather_discs(&w->disc, &fixed, w->p);
  if (st != DYD_OK) return st;
  dyd_proof_put_disc_lines(out, w->disc, fixed, w->p);
  each_refined(&count, NULL, w);
  fprintf(out, "refined %zu\n", count);
  return each_refined(&count, out, w);
}

dyd_status dyd_proof_put_discs(FILE *out, const dyd_proof *p, const dyd_pair_list *pairs) {
  disc_proof w = {.p = p, .pairs = pairs};
  init_search(&w);
  dyd_status st = dyd_pairs_deal(&w.start, &w.partner, &p->pairs, p->sites.count);
  if (st == DYD_OK) st = put_discs(out, &w);
  clear_search(&w);
  return st;
}
