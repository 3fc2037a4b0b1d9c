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
#include "legal/witness.h"

#include "base/alloc.h"
#include "legal/cut_filter.h"
#include "legal/exact_lp.h"
#include "legal/witness_filter.h"
#include "possible/centre.h"
#include "possible/hull.h"
#include "skeleton/site_filter.h"
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

/* Would another violator change nothing? There is no room for one, and k surely does not touch the pair. */
static bool is_one_too_many(const search *s, uint32_t k) {
  const dyd_bbox *box = s->pd->box;
  return s->violated && s->rivals == MAX_RIVALS && !s->pd->options.no_filter &&
         dyd_boxes_disjoint(&box[k], &box[s->i]) && dyd_boxes_disjoint(&box[k], &box[s->j]);
}

static bool examine(void *context, uint32_t k) {
  search *s = context;
  if (k == s->i || k == s->j || is_one_too_many(s, k)) return true;
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

/* ---- the same in integers, for sites of very different scale ---- */

enum { MAX_PLANES = 512, EXACT_STEPS = 48 };

typedef struct plane_list {
  dyd_half_plane h[MAX_PLANES];
  size_t count, made;
} plane_list;

static dyd_half_plane *next_plane(plane_list *l) {
  if (l->count == MAX_PLANES) return NULL;
  if (l->made == l->count) dyd_half_plane_init(&l->h[l->made++]);
  return &l->h[l->count++];
}

/* The first four: the square |x|, |y| < 2^top. */
static void set_square(plane_list *l, int64_t top) {
  for (int k = 0; k < 4; k++) {
    dyd_half_plane *h = &l->h[k];
    mpz_ptr n = k < 2 ? h->a : h->b, zero = k < 2 ? h->b : h->a;
    mpz_set_ui(zero, 0);
    mpz_set_ui(h->w, 1);
    mpz_set_ui(h->c, 1);
    mpz_mul_2exp(h->w, h->w, (mp_bitcnt_t)(top < 0 ? -top : 0));
    mpz_mul_2exp(h->c, h->c, (mp_bitcnt_t)(top > 0 ? top : 0));
    mpz_set(n, h->w);
    if (k & 1) mpz_neg(n, n);
  }
}

/* Exponent above which no end of r reaches. */
static int64_t top_of(const dyd_rect *r) {
  const dyd_dyadic *end[4] = {&r->x.lo, &r->x.hi, &r->y.lo, &r->y.hi};
  int64_t top = -DYD_EXP_LIMIT;
  for (int k = 0; k < 4; k++) {
    int64_t t = end[k]->exp + (int64_t)mpz_sizeinbase(end[k]->man, 2);
    if (mpz_sgn(end[k]->man) && t > top) top = t;
  }
  return top;
}

/* Half-planes of all present rivals that c violates; false when there are too many, or two rectangles touch. */
static bool add_planes(search *s, plane_list *l) {
  for (size_t k = 0; k < s->rivals; k++)
    for (int q = 0; q < 2; q++) {
      bool violated;
      dyd_half_plane *h = next_plane(l);
      if (!h || !dyd_cut_exactly(&violated, h, &s->c, &s->own[q], &s->rect[k])) return false;
      if (!violated) l->count--; /* nothing new */
    }
  return true;
}

/* The largest exponent so far, with room for centres far outside. */
static int64_t square_top(const search *s, int64_t top) {
  for (size_t k = 0; k < s->rivals + 2; k++) {
    int64_t t = top_of(k < s->rivals ? &s->rect[k] : &s->own[k - s->rivals]) + 64;
    if (t > top) top = t;
  }
  return top;
}

/* Exponent of the finest bit of an end of r, its denominator counted too. */
static int64_t finest_bit(const dyd_rect *r) {
  const dyd_interval *side[2] = {&r->x, &r->y};
  int64_t low = DYD_EXP_LIMIT;
  for (int a = 0; a < 2; a++) {
    int64_t bits = (int64_t)mpz_sizeinbase(side[a]->den, 2) - 1;
    if (mpz_sgn(side[a]->lo.man) && side[a]->lo.exp - bits < low) low = side[a]->lo.exp - bits;
    if (mpz_sgn(side[a]->hi.man) && side[a]->hi.exp - bits < low) low = side[a]->hi.exp - bits;
  }
  return low;
}

/* The floor: exponent of a radius far below unit^2 / size, for ends that are multiples of `unit` up to `size` = 2^top.
 * A disc of witnesses that small is not looked for; where there is none, but three rectangles touch one circle, the
 * discs of the half-planes would shrink for ever. */
static int64_t floor_exponent(const search *s, int64_t top) {
  int64_t low = DYD_EXP_LIMIT;
  for (size_t k = 0; k < s->rivals + 2; k++) {
    int64_t b = finest_bit(k < s->rivals ? &s->rect[k] : &s->own[k - s->rivals]);
    if (b < low) low = b;
  }
  return 2 * low - top - 64;
}

/* Moves c into the middle of all half-planes; false: no room, not even in a far larger square, or no end. */
static bool step_exactly(search *s, plane_list *l, int64_t top) {
  dyd_exact_centre p;
  dyd_exact_centre_init(&p);
  bool good = true, room = false;
  for (int wide = 0; wide < 2 && good && !room; wide++) {
    set_square(l, top + (wide ? 4096 : 0));
    good = dyd_exact_lp(&p, l->h, l->count);
    room = good && mpz_sgn(p.z) > 0 && dyd_cut_exponent(&p) >= floor_exponent(s, top);
  }
  s->cuts.empty = good && !room;
  if (room) s->status = dyd_cut_round(&s->c, &p);
  dyd_exact_centre_clear(&p);
  return room && s->status == DYD_OK;
}

static void run_exactly(search *s) {
  int64_t top = square_top(s, -DYD_EXP_LIMIT);
  plane_list *l = malloc(sizeof *l);
  if (!l) {
    s->status = DYD_E_NOMEM;
    return;
  }
  for (l->made = l->count = 0; l->count < 4;) next_plane(l);
  for (int step = 0; step < EXACT_STEPS; step++) {
    s->rivals = 0;
    evaluate(s);
    if (s->status != DYD_OK || !s->violated || s->touching) break;
    top = square_top(s, top);
    if (!add_planes(s, l) || !step_exactly(s, l, top)) break;
  }
  if (s->status == DYD_E_RANGE) s->status = DYD_OK; /* beyond the numbers there are: not found */
  for (size_t k = 0; k < l->made; k++) dyd_half_plane_clear(&l->h[k]);
  free(l);
}

/* The search with doubles that only lead; where they get lost, with integers. */
static dyd_status search_exactly(bool *found, dyd_point *c, const dyd_delaunay *pd, uint32_t i, uint32_t j,
                                 dyd_xy guess) {
  search *s = malloc(sizeof *s);
  if (!s) return DYD_E_NOMEM;
  dyd_status st = search_init(s, pd, i, j);
  if (st == DYD_OK) st = set_start(&s->c, pd, i, guess);
  if (st == DYD_OK) {
    run(s);
    if (s->status == DYD_OK && s->violated && !s->touching && !s->cuts.impossible) run_exactly(s);
    st = s->status;
  }
  *found = st == DYD_OK && !s->violated && !s->touching;
  if (*found && c) dyd_point_set(c, &s->c);
  search_clear(s);
  free(s);
  return st;
}

/* Does some circle meet the rectangles of i, j and of both vertices across, these surely on opposite sides of ij? Then
 * there is no witness [WIT-QUAD]. */
static dyd_status is_excluded(bool *excluded, const dyd_delaunay *pd, uint32_t i, uint32_t j,
                              const uint32_t across[2]) {
  const uint32_t v[4] = {i, j, across[0], across[1]};
  dyd_rect r[4];
  dyd_status st = DYD_OK;
  for (int k = 0; k < 4; k++) dyd_rect_init(&r[k]);
  for (int k = 0; k < 4 && st == DYD_OK; k++) st = dyd_sites_get(&r[k], pd->sites, pd->reps.site[v[k]]);
  if (st == DYD_OK) {
    dyd_sure a = dyd_orientation(&r[0], &r[1], &r[2]), b = dyd_orientation(&r[0], &r[1], &r[3]);
    bool opposite = a != DYD_UNSURE && (int)a == -(int)b;
    *excluded = opposite && dyd_con(&r[3], &r[0], &r[1], &r[2]) == DYD_UNSURE;
  }
  for (int k = 0; k < 4; k++) dyd_rect_clear(&r[k]);
  return st;
}

/* Before a search with big numbers: is there surely none, or one between the centres of the triangles beside the edge?
 */
static dyd_status look_between(bool *found, bool *settled, dyd_point *c, const dyd_delaunay *pd, uint32_t i, uint32_t j,
                               const uint32_t across[2]) {
  dyd_point middle;
  dyd_point_init(&middle);
  bool exists = false;
  dyd_status st = is_excluded(settled, pd, i, j, across);
  if (st == DYD_OK && !*settled) st = dyd_centre_between(&exists, &middle, pd, i, j, across);
  if (st == DYD_OK && exists) st = dyd_witness_check(found, pd, i, j, &middle);
  if (st == DYD_OK && *found && c) dyd_point_set(c, &middle);
  *settled = *settled || *found;
  dyd_point_clear(&middle);
  return st;
}

dyd_status dyd_witness_search(bool *found, dyd_point *c, const dyd_delaunay *pd, uint32_t i, uint32_t j, dyd_xy guess,
                              const uint32_t across[2]) {
  *found = false;
  if (i > j) { /* one search for a pair, whoever is named first */
    uint32_t t = i;
    i = j;
    j = t;
  }
  dyd_truth quick = dyd_filter_witness(&guess, pd, i, j);
  if (quick == DYD_UNKNOWN || (quick == DYD_TRUE && pd->options.no_filter)) {
    bool settled = false;
    dyd_status st = across && !pd->options.no_filter ? look_between(found, &settled, c, pd, i, j, across) : DYD_OK;
    return st != DYD_OK || settled ? st : search_exactly(found, c, pd, i, j, guess);
  }
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
