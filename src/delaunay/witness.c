/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The search for a witness by cutting planes.
 *
 * c is a witness of ij iff ds_k(c)^2 - dl_s(c)^2 > 0 for s = i, j and all other k. This is the least, over q in R_k and
 * corners p of R_s, of |c-q|^2 - |c-p|^2, linear in c: a concave function, so at any c its active pair (q,p) gives a
 * half-plane that holds all witnesses: the points nearer to p than to q [WIT-1]. The search keeps such half-planes,
 * moves c to the centre of the largest disc inside them, and asks again who violates. An empty intersection ends it: no
 * witness.
 *
 * The half-planes are kept in doubles relative to the current c, in units of 2^unit; their offsets are computed
 * exactly from the rectangles and c, so each step gains about as many bits as a double has, and the search goes on at
 * any depth. Only the exact check at the end states anything. */
#include "delaunay/witness.h"

#include "base/alloc.h"
#include "delaunay/filter_cut.h"
#include "delaunay/filter_witness.h"
#include "delaunay/hull.h"
#include <dyadel/predicate.h>

#include <math.h>

enum { MAX_RIVALS = 48 };

/* Invariant: rival[0..rivals-1] are other vertices met on the way, with their rectangles. */
typedef struct search {
  const dyd_delaunay *pd;
  uint32_t i, j;
  dyd_rect own[2];
  uint32_t rival[MAX_RIVALS];
  dyd_rect rect[MAX_RIVALS];
  size_t rivals, made;
  dyd_point c;
  dyd_bbox box;
  double bound; /* squared radius, upper */
  bool violated, touching;
  dyd_cut_list cuts;
  dyd_status status;
} search;

static dyd_status search_init(search *s, const dyd_delaunay *pd, uint32_t i, uint32_t j) {
  s->pd = pd;
  s->i = i;
  s->j = j;
  s->rivals = s->made = 0;
  s->touching = false;
  s->cuts = (dyd_cut_list){0};
  dyd_rect_init(&s->own[0]);
  dyd_rect_init(&s->own[1]);
  dyd_point_init(&s->c);
  s->status = dyd_sites_get(&s->own[0], pd->sites, pd->reps.site[i]);
  if (s->status == DYD_OK) s->status = dyd_sites_get(&s->own[1], pd->sites, pd->reps.site[j]);
  return s->status;
}

static void search_clear(search *s) {
  for (size_t k = 0; k < s->made; k++) dyd_rect_clear(&s->rect[k]);
  dyd_point_clear(&s->c);
  dyd_rect_clear(&s->own[1]);
  dyd_rect_clear(&s->own[0]);
}

static bool is_rival(const search *s, uint32_t k) {
  for (size_t q = 0; q < s->rivals; q++)
    if (s->rival[q] == k) return true;
  return false;
}

/* Keeps k as a rival if there is room. */
static void keep(search *s, uint32_t k, dyd_rect *r) {
  if (s->rivals == MAX_RIVALS || is_rival(s, k)) return;
  if (s->made == s->rivals) dyd_rect_init(&s->rect[s->made++]);
  dyd_rect_swap(&s->rect[s->rivals], r);
  s->rival[s->rivals++] = k;
}

/* Is k surely farther from c than all of R_i and R_j? Exact. */
static bool is_outside(const search *s, const dyd_rect *r) {
  for (int q = 0; q < 2; q++)
    if (dyd_compare_distance(&s->c, &s->own[q], DYD_FARTHEST, r, DYD_CLOSEST) >= 0) return false;
  return true;
}

static bool examine(void *context, uint32_t k) {
  search *s = context;
  if (k == s->i || k == s->j) return true;
  dyd_rect r;
  dyd_rect_init(&r);
  s->status = dyd_sites_get(&r, s->pd->sites, s->pd->reps.site[k]);
  if (s->status == DYD_OK && !is_outside(s, &r)) {
    s->violated = true;
    s->touching = s->touching || dyd_rect_meets(&r, &s->own[0]) || dyd_rect_meets(&r, &s->own[1]);
    keep(s, k, &r);
  }
  dyd_rect_clear(&r);
  return s->status == DYD_OK && !s->touching;
}

/* Who violates c? Everybody is asked through the tree; the answer is exact. */
static void evaluate(search *s) {
  s->violated = false;
  dyd_cut_box(&s->box, &s->c);
  s->bound = s->pd->options.no_filter ? INFINITY : dyd_cut_radius2(s->pd, &s->box, s->i, s->j);
  dyd_tree_near(&s->pd->tree, &s->box, &s->bound, examine, s);
}

/* Fresh half-planes of all rivals at c, after which the old ones serve on. */
static void cut(search *s) {
  dyd_cut_age(&s->cuts);
  for (size_t k = 0; k < s->rivals; k++)
    for (int q = 0; q < 2; q++) dyd_cut_add(&s->cuts, &s->c, &s->own[q], &s->rect[k]);
}

/* Bits below the point of an end of a, its denominator counted too. */
static int64_t depth(const dyd_interval *a) {
  int64_t low = a->lo.exp < a->hi.exp ? a->lo.exp : a->hi.exp;
  return (low < 0 ? -low : 0) + 2 * (int64_t)mpz_sizeinbase(a->den, 2);
}

/* How deep a witness may have to lie: for exact points the degree of their in-circle determinant counts. */
static int64_t precision(const search *s) {
  int64_t bits = 0;
  for (size_t k = 0; k < s->rivals + 2; k++) {
    const dyd_rect *r = k < s->rivals ? &s->rect[k] : &s->own[k - s->rivals];
    int64_t x = depth(&r->x), y = depth(&r->y), b = x > y ? x : y;
    if (b > bits) bits = b;
  }
  return 2 * bits;
}

/* The loop. Ends with !violated (witness), or with violated (none, or the floor). */
static void run(search *s) {
  int64_t steps = 48;
  evaluate(s);
  for (int64_t step = 0; step < steps && s->status == DYD_OK && s->violated && !s->touching; step++) {
    cut(s);
    if (step == 0) steps += precision(s) / 16;
    if (!dyd_cut_move(&s->c, &s->cuts, &s->status)) break;
    evaluate(s);
  }
}

static dyd_status set_start(dyd_point *c, const dyd_delaunay *pd, uint32_t i, dyd_xy guess) {
  if (!isfinite(guess.x) || !isfinite(guess.y)) guess = pd->reps.xy[i];
  dyd_status st = dyd_dyadic_set_d(&c->x, guess.x);
  return st == DYD_OK ? dyd_dyadic_set_d(&c->y, guess.y) : st;
}

/* Half way between the doubles of i and j: near the pair whatever the scale of all others. */
static dyd_xy between(const dyd_delaunay *pd, uint32_t i, uint32_t j) {
  dyd_xy a = pd->reps.xy[i], b = pd->reps.xy[j];
  return (dyd_xy){a.x / 2 + b.x / 2, a.y / 2 + b.y / 2};
}

/* The search on the exact rung, from the guess; if it gets lost, once more from the pair itself. */
static dyd_status search_exactly(bool *found, dyd_point *c, const dyd_delaunay *pd, uint32_t i, uint32_t j,
                                 dyd_xy guess) {
  const dyd_xy starts[2] = {guess, between(pd, i, j)};
  search *s = malloc(sizeof *s);
  if (!s) return DYD_E_NOMEM;
  dyd_status st = search_init(s, pd, i, j);
  for (int k = 0; k < 2 && st == DYD_OK && !*found; k++) {
    s->cuts = (dyd_cut_list){0};
    s->rivals = 0;
    st = set_start(&s->c, pd, i, starts[k]);
    if (st != DYD_OK) break;
    run(s);
    st = s->status;
    *found = st == DYD_OK && !s->violated && !s->touching;
    if (s->touching || s->cuts.impossible || s->cuts.empty) break;
  }
  if (*found && c) dyd_point_set(c, &s->c);
  search_clear(s);
  free(s);
  return st;
}

dyd_status dyd_witness_search(bool *found, dyd_point *c, const dyd_delaunay *pd, uint32_t i, uint32_t j, dyd_xy guess) {
  *found = false;
  if (i > j) { /* one search for a pair, whoever is named first */
    uint32_t t = i;
    i = j;
    j = t;
  }
  dyd_truth quick = dyd_filter_witness(&guess, pd, i, j);
  if (quick == DYD_UNKNOWN || (quick == DYD_TRUE && pd->options.no_filter))
    return search_exactly(found, c, pd, i, j, guess);
  *found = quick == DYD_TRUE;
  return *found && c ? set_start(c, pd, i, guess) : DYD_OK;
}

dyd_status dyd_witness_check(bool *good, const dyd_delaunay *pd, uint32_t i, uint32_t j, const dyd_point *c) {
  search *s = malloc(sizeof *s);
  if (!s) return DYD_E_NOMEM;
  dyd_status st = search_init(s, pd, i, j);
  if (st == DYD_OK) {
    dyd_point_set(&s->c, c);
    evaluate(s);
    st = s->status;
    *good = !s->violated && !s->touching;
  }
  search_clear(s);
  free(s);
  return st;
}

/* c = p + 2^m u for a vertex's double p. */
static dyd_status far_centre(dyd_point *c, const dyd_delaunay *pd, uint32_t i, const mpz_t ux, const mpz_t uy,
                             int64_t m) {
  dyd_dyadic d;
  dyd_dyadic_init(&d);
  dyd_status st = set_start(c, pd, i, (dyd_xy){NAN, NAN});
  if (st == DYD_OK) st = dyd_dyadic_set_z_2exp(&d, ux, m);
  if (st == DYD_OK) st = dyd_dyadic_add(&c->x, &c->x, &d);
  if (st == DYD_OK) st = dyd_dyadic_set_z_2exp(&d, uy, m);
  if (st == DYD_OK) st = dyd_dyadic_add(&c->y, &c->y, &d);
  dyd_dyadic_clear(&d);
  return st;
}

dyd_status dyd_witness_far(bool *found, dyd_point *c, dyd_work *w, const dyd_delaunay *pd, uint32_t i, uint32_t j) {
  mpz_t ux, uy;
  dyd_point far;
  mpz_inits(ux, uy, NULL);
  dyd_point_init(&far);
  dyd_status st = dyd_hull_direction(found, ux, uy, w, pd, i, j);
  bool direction = *found;
  *found = false;
  for (int64_t step = 16, m = -64; direction && st == DYD_OK && !*found; m += step, step += step / 4) {
    st = far_centre(&far, pd, i, ux, uy, m);
    if (st == DYD_OK) st = dyd_witness_check(found, pd, i, j, &far);
  }
  if (st == DYD_E_RANGE) st = DYD_OK; /* farther than numbers go: the floor */
  if (st == DYD_OK && *found && c) dyd_point_set(c, &far);
  dyd_point_clear(&far);
  mpz_clears(ux, uy, NULL);
  return st;
}
