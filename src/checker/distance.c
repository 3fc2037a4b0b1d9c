/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The distance of undetermined points to the Voronoi diagram, by boxes that cover the window.
 *
 * For a box Q let S be the sites that are possibly nearest somewhere in it as far as distances of boxes tell: ds_k(Q)
 * is not above the least dl(Q). A point z of Q that is surely nearest to no site has, for a choice p, a nearest site a
 * and another one j that is possibly nearest at z, both in S [CERT-7]. It is at most dl_k(Q) from the diagram, for each
 * site k whose rectangle is disjoint from that of a; and, if those of a and j are, (diam R_a + diam R_j) (dl_a(Q) +
 * dl_j(Q)) / (2 dist(R_a, R_j)). Of two sites k that are disjoint from each other one will do for any a. A box for
 * which none of this gives the bound for all a and j is cut in four. Sites within the bound of Q are of use as k,
 * others only in S; both of a part are among those of the whole. All is done in integers, on a grid of 2^-36 of the
 * window, rounded to the safe side. */
#include "checker/distance.h"
#include "base/alloc.h"
#include "checker/tree.h"

#define GRID_BITS 36
#define FAR_BITS 60 /* grid coordinates stay below this power of two */
#define FEW 8       /* sites of a box whose pairs are looked at: always; when a cut would not help much; or at all */
#define SOME 64
#define MANY 1024
#define PAIR_COST 32 /* a comparison on the grid is 1 */
#define EFFORT_BITS 16

void dyd_cert_window_init(dyd_cert_window *w) {
  for (int k = 0; k < 4; k++) dyd_exact_init(&w->e[k]);
}

void dyd_cert_window_clear(dyd_cert_window *w) {
  for (int k = 0; k < 4; k++) dyd_exact_clear(&w->e[k]);
}

/* A rectangle, rounded outward: x0, x1, y0, y1. */
typedef struct grid_box {
  int64_t e[4];
} grid_box;

/* A site on the grid. diameter: an upper bound, man 2^exp; endless: it reaches beyond the grid. */
typedef struct grid_site {
  grid_box box;
  uint32_t site;
  bool endless;
  uint64_t diameter;
  int64_t diameter_exp;
} grid_site;

/* The lists of sites of nested boxes lie one behind the other in list[]. */
typedef struct search {
  const dyd_cert_sites *sites;
  const dyd_exact *bound;
  grid_site *item;
  size_t count;
  int64_t unit;
  mpz_t origin[2];
  uint64_t most; /* the bound in grid units, rounded down */
  uint32_t *list;
  size_t cap;
  uint64_t effort, effort_most;
  dyd_status st;
  mpz_t root, rest;
  dyd_cert_fraction gap, part;
} search;

/* ---- the grid ---- */

static int64_t place_end(bool *endless, search *s, const dyd_exact *x, mpz_srcptr den, int axis, bool up) {
  (up ? dyd_exact_ceil : dyd_exact_floor)(s->root, x, den, s->unit);
  mpz_sub(s->root, s->root, s->origin[axis]);
  if (mpz_sizeinbase(s->root, 2) <= FAR_BITS) return mpz_get_si(s->root);
  *endless = true;
  return mpz_sgn(s->root) > 0 ? INT64_C(1) << FAR_BITS : -(INT64_C(1) << FAR_BITS);
}

/* An upper bound of the root of f, with 64 bits. */
static void root_above(uint64_t *man, int64_t *exp, const dyd_cert_fraction *f) {
  *man = 0;
  *exp = 0;
  if (dyd_exact_sgn(&f->num) == 0) return;
  mpz_t t;
  mpz_init(t);
  int64_t top = dyd_exact_top(&f->num) - (f->whole ? 0 : (int64_t)mpz_sizeinbase(f->den, 2)), least = top - 124;
  least -= least % 2;
  dyd_exact_ceil(t, &f->num, f->whole ? NULL : f->den, least); /* below 2^127 */
  mpz_sub_ui(t, t, 1);
  mpz_sqrt(t, t);
  mpz_add_ui(t, t, 1);
  *man = mpz_get_ui(t);
  *exp = least / 2;
  mpz_clear(t);
}

static void find_diameter(search *s, grid_site *g) {
  const dyd_cert_side *side = s->sites->site[g->site].side;
  for (int axis = 0; axis < 2; axis++) {
    dyd_cert_fraction *f = axis ? &s->part : &s->gap;
    dyd_cert_fraction_sub(f, dyd_cert_high(&side[axis]), dyd_cert_den(&side[axis]), &side[axis].lo,
                          dyd_cert_den(&side[axis]));
    dyd_cert_fraction_mul(f, f, f);
  }
  dyd_cert_fraction_add(&s->gap, &s->gap, &s->part);
  root_above(&g->diameter, &g->diameter_exp, &s->gap);
}

static void place_site(search *s, uint32_t v) {
  grid_site *g = &s->item[s->count++];
  *g = (grid_site){.site = v};
  for (int k = 0; k < 4; k++) {
    const dyd_cert_side *side = &s->sites->site[v].side[k / 2];
    g->box.e[k] = place_end(&g->endless, s, k % 2 ? dyd_cert_high(side) : &side->lo, dyd_cert_den(side), k / 2, k % 2);
  }
  find_diameter(s, g);
}

/* The grid, and the window on it. */
static void make_grid(grid_box *window, search *s, const dyd_cert_window *w) {
  bool endless = false;
  dyd_exact width;
  dyd_exact_init(&width);
  s->unit = INT64_MIN;
  for (int axis = 0; axis < 2; axis++) {
    dyd_exact_sub(&width, &w->e[2 * axis + 1], &w->e[2 * axis]);
    if (dyd_exact_top(&width) - GRID_BITS > s->unit) s->unit = dyd_exact_top(&width) - GRID_BITS;
  }
  for (int axis = 0; axis < 2; axis++) dyd_exact_floor(s->origin[axis], &w->e[2 * axis], NULL, s->unit);
  for (int k = 0; k < 4; k++) window->e[k] = place_end(&endless, s, &w->e[k], NULL, k / 2, k % 2);
  dyd_exact_floor(s->root, s->bound, NULL, s->unit);
  s->most = mpz_sizeinbase(s->root, 2) > FAR_BITS ? UINT64_C(1) << FAR_BITS : mpz_get_ui(s->root);
  dyd_exact_clear(&width);
}

/* ---- distances on the grid ---- */

static dyd_cert_area far_on_grid(const grid_box *q, const grid_site *g) {
  dyd_cert_area sum = 0;
  if (g->endless) return ~(dyd_cert_area)0;
  for (int a = 0; a < 4; a += 2) {
    int64_t left = q->e[a + 1] - g->box.e[a], right = g->box.e[a + 1] - q->e[a];
    sum += dyd_cert_square(left > right ? left : right);
  }
  return sum;
}

static dyd_cert_area near_on_grid(const grid_box *q, const grid_box *b) {
  dyd_cert_area sum = 0;
  for (int a = 0; a < 4; a += 2) {
    int64_t left = b->e[a] - q->e[a + 1], right = q->e[a] - b->e[a + 1], d = left > right ? left : right;
    if (d > 0) sum += dyd_cert_square(d);
  }
  return sum;
}

static void mpz_set_area(mpz_ptr out, dyd_cert_area v) {
  mpz_import(out, 1, 1, sizeof v, 0, 0, &v); /* one word, as it is in memory */
}

/* ---- pairs ---- */

/* s->gap = the squared distance of two rectangles. */
static void find_site_gap(search *s, const grid_site *a, const grid_site *b) {
  for (int axis = 0; axis < 2; axis++) {
    const dyd_cert_side *x = &s->sites->site[a->site].side[axis], *y = &s->sites->site[b->site].side[axis];
    dyd_cert_fraction *f = axis ? &s->part : &s->gap;
    dyd_cert_fraction_sub(f, &y->lo, dyd_cert_den(y), dyd_cert_high(x), dyd_cert_den(x));
    if (dyd_exact_sgn(&f->num) <= 0)
      dyd_cert_fraction_sub(f, &x->lo, dyd_cert_den(x), dyd_cert_high(y), dyd_cert_den(y));
    if (dyd_exact_sgn(&f->num) < 0) mpz_set_ui(f->num.man, 0);
    dyd_cert_fraction_mul(f, f, f);
  }
  dyd_cert_fraction_add(&s->gap, &s->gap, &s->part);
}

static bool are_disjoint(search *s, const grid_site *a, const grid_site *b) {
  if (near_on_grid(&a->box, &b->box) > 0) return true;
  find_site_gap(s, a, b);
  return dyd_exact_sgn(&s->gap.num) > 0;
}

/* s->root 2^*exp = a lower bound of the distance of two rectangles; exact ends where the grid is coarse for it. */
static void site_gap_below(int64_t *exp, search *s, const grid_site *a, const grid_site *b) {
  dyd_cert_area gap = near_on_grid(&a->box, &b->box);
  if (gap >> 48) {
    mpz_set_area(s->root, gap);
    *exp = s->unit;
  } else {
    find_site_gap(s, a, b);
    const dyd_cert_fraction *f = &s->gap;
    int64_t top = dyd_exact_sgn(&f->num) == 0 ? 0 : dyd_exact_top(&f->num), least = top - 128;
    if (!f->whole) least -= (int64_t)mpz_sizeinbase(f->den, 2);
    least -= least % 2;
    dyd_exact_floor(s->root, &f->num, f->whole ? NULL : f->den, least);
    *exp = least / 2;
  }
  mpz_sqrt(s->root, s->root);
}

/* out 2^*exp = the sum of the diameters. */
static void add_diameters(mpz_ptr out, int64_t *exp, const grid_site *a, const grid_site *b) {
  dyd_exact x, y;
  dyd_exact_init(&x);
  dyd_exact_init(&y);
  mpz_set_ui(x.man, a->diameter);
  mpz_set_ui(y.man, b->diameter);
  x.exp = a->diameter_exp;
  y.exp = b->diameter_exp;
  dyd_exact_add(&x, &x, &y);
  mpz_swap(out, x.man);
  *exp = x.exp;
  dyd_exact_clear(&x);
  dyd_exact_clear(&y);
}

/* Is (diam_a + diam_b) (far_a + far_b) <= 2 bound dist, the rectangles being disjoint? */
static bool is_near_bisector(search *s, const grid_site *a, const grid_site *b, uint64_t far_a, uint64_t far_b) {
  dyd_exact left, right;
  if (a->diameter == 0 && b->diameter == 0) return are_disjoint(s, a, b);
  dyd_exact_init(&left);
  dyd_exact_init(&right);
  site_gap_below(&right.exp, s, a, b);
  mpz_mul(right.man, s->root, s->bound->man);
  right.exp += s->bound->exp + 1;
  add_diameters(left.man, &left.exp, a, b);
  mpz_set_ui(s->root, far_a);
  mpz_add_ui(s->root, s->root, far_b);
  mpz_mul(left.man, left.man, s->root);
  left.exp += s->unit;
  bool holds = dyd_exact_cmp(&left, &right) <= 0; /* left > 0, as one of the two is no point */
  dyd_exact_clear(&left);
  dyd_exact_clear(&right);
  return holds;
}

/* Is some site of the list, disjoint from a, within the bound of all points of q? */
static bool is_near_site(search *s, const grid_box *q, const grid_site *a, const uint32_t *list, size_t count) {
  dyd_cert_area most = (dyd_cert_area)s->most * s->most;
  for (size_t k = 0; k < count; k++)
    if (far_on_grid(q, &s->item[list[k]]) <= most && are_disjoint(s, a, &s->item[list[k]])) return true;
  return false;
}

/* The root of far_on_grid, rounded up. The site is not endless. */
static uint64_t far_root(search *s, const grid_box *q, const grid_site *g) {
  mpz_set_area(s->root, far_on_grid(q, g));
  mpz_sqrtrem(s->root, s->rest, s->root);
  return mpz_get_ui(s->root) + (mpz_sgn(s->rest) != 0);
}

/* Are there two sites of the list, disjoint from each other, within the bound of all points of q? Tried with the first
 * few of those within it. */
static bool has_two_near_sites(search *s, const grid_box *q, const uint32_t *list, size_t count) {
  dyd_cert_area most = (dyd_cert_area)s->most * s->most;
  int tried = 0;
  for (size_t k = 0; k < count && tried < FEW; k++) {
    if (far_on_grid(q, &s->item[list[k]]) > most) continue;
    s->effort += count;
    tried++;
    if (is_near_site(s, q, &s->item[list[k]], list, count)) return true;
  }
  return false;
}

/* Is every undetermined point of q near the diagram? S is the first `count` of the list, 2 .. MANY. */
static bool box_pairs_hold(search *s, const grid_box *q, const uint32_t *list, size_t count, size_t all) {
  uint64_t far[MANY];
  bool near[MANY];
  for (size_t k = 0; k < count; k++) {
    const grid_site *a = &s->item[list[k]];
    if (a->endless) return false;
    far[k] = far_root(s, q, a);
  }
  s->effort += count * all;
  for (size_t k = 0; k < count; k++) {
    near[k] = is_near_site(s, q, &s->item[list[k]], list, all);
    for (size_t l = 0; l < k; l++) {
      if (near[k] && near[l]) continue;
      s->effort += PAIR_COST;
      if (!is_near_bisector(s, &s->item[list[k]], &s->item[list[l]], far[k], far[l])) return false;
    }
  }
  return true;
}

/* ---- boxes ---- */

/* The sites of list[from .. from+count) of use for q, put behind them: S first, then those within the bound of q.
 * Returns how many; *possible: of S. */
static size_t box_keep(size_t *possible, search *s, const grid_box *q, size_t from, size_t count) {
  dyd_cert_area least = ~(dyd_cert_area)0, most = (dyd_cert_area)s->most * s->most;
  size_t kept = 0;
  s->effort += count;
  *possible = 0;
  if (!dyd_reserve((void **)&s->list, &s->cap, from + 2 * count, sizeof *s->list)) {
    s->st = DYD_E_NOMEM;
    return 0;
  }
  uint32_t *in = s->list + from, *out = in + count;
  for (size_t k = 0; k < count; k++) {
    dyd_cert_area far = far_on_grid(q, &s->item[in[k]]);
    if (far < least) least = far;
  }
  for (size_t k = 0; k < count; k++) {
    dyd_cert_area near = near_on_grid(q, &s->item[in[k]].box);
    if (near > least && near > most) continue;
    out[kept] = in[k];
    if (near <= least) {
      out[kept] = out[*possible];
      out[(*possible)++] = in[k];
    }
    kept++;
  }
  return kept;
}

/* Cutting the box is better as long as that leaves fewer sites to the parts. */
static bool is_worth_a_look(size_t count, size_t before) {
  return count <= FEW || (count <= SOME && 2 * count > before) || (count <= MANY && 8 * count > 7 * before);
}

/* around: the sites of the box around q are list[from .. from+around), before of them are of its S. */
static bool box_is_covered(search *s, const grid_box *q, size_t from, size_t around, size_t before) {
  size_t possible, count = box_keep(&possible, s, q, from, around);
  if (s->st != DYD_OK || s->effort > s->effort_most) return false;
  from += around;
  if (possible == 1 || has_two_near_sites(s, q, s->list + from, count)) return true;
  if (is_worth_a_look(possible, before) && box_pairs_hold(s, q, s->list + from, possible, count)) return true;
  if (q->e[1] - q->e[0] < 2 && q->e[3] - q->e[2] < 2) return false;
  int64_t x = q->e[0] + (q->e[1] - q->e[0]) / 2, y = q->e[2] + (q->e[3] - q->e[2]) / 2;
  for (int k = 0; k < 4; k++) {
    grid_box part = {{k & 1 ? x : q->e[0], k & 1 ? q->e[1] : x, k & 2 ? y : q->e[2], k & 2 ? q->e[3] : y}};
    if (!box_is_covered(s, &part, from, count, possible)) return false;
  }
  return true;
}

/* ---- the whole plane ---- */

/* The extent of the window and all rectangles along one axis, and the greatest lower and the least upper end. */
typedef struct extent {
  const dyd_exact *lo, *hi, *most_lo, *least_hi;
  mpz_srcptr den[4];
} extent;

static void extent_widen(extent *e, search *s, const dyd_cert_side *side) {
  const dyd_exact **best[4] = {&e->lo, &e->hi, &e->most_lo, &e->least_hi};
  for (int m = 0; m < 4; m++) {
    const dyd_exact *end = m % 2 ? dyd_cert_high(side) : &side->lo;
    bool larger = m == 1 || m == 2;
    if (*best[m]) {
      dyd_cert_fraction_sub(&s->part, end, dyd_cert_den(side), *best[m], e->den[m]);
      if (dyd_exact_sgn(&s->part.num) * (larger ? 1 : -1) <= 0) continue;
    }
    *best[m] = end;
    e->den[m] = dyd_cert_den(side);
  }
}

/* Does the bound reach across the window and all rectangles, two of which are disjoint? */
static bool spans_all(search *s, const dyd_cert_window *w) {
  bool disjoint = false;
  dyd_cert_fraction sum;
  dyd_cert_fraction_init(&sum);
  for (int axis = 0; axis < 2; axis++) {
    extent e = {.lo = &w->e[2 * axis], .hi = &w->e[2 * axis + 1]};
    for (size_t k = 0; k < s->count; k++) extent_widen(&e, s, &s->sites->site[s->item[k].site].side[axis]);
    dyd_cert_fraction_sub(&s->part, e.most_lo, e.den[2], e.least_hi, e.den[3]);
    disjoint |= dyd_exact_sgn(&s->part.num) > 0;
    dyd_cert_fraction_sub(&s->part, e.hi, e.den[1], e.lo, e.den[0]);
    dyd_cert_fraction_mul(&s->part, &s->part, &s->part);
    dyd_cert_fraction_add(&sum, &sum, &s->part);
  }
  s->part.whole = true;
  dyd_exact_mul(&s->part.num, s->bound, s->bound);
  bool spans = disjoint && dyd_cert_fraction_cmp(&sum, &s->part) <= 0;
  dyd_cert_fraction_clear(&sum);
  return spans;
}

/* ---- all ---- */

static void distance_search_init(search *s) {
  mpz_inits(s->origin[0], s->origin[1], s->root, s->rest, NULL);
  dyd_cert_fraction_init(&s->gap);
  dyd_cert_fraction_init(&s->part);
}

static void distance_search_clear(search *s) {
  mpz_clears(s->origin[0], s->origin[1], s->root, s->rest, NULL);
  dyd_cert_fraction_clear(&s->gap);
  dyd_cert_fraction_clear(&s->part);
  free(s->item);
  free(s->list);
}

dyd_status dyd_cert_distance_holds(bool *holds, const dyd_cert_sites *sites, const dyd_cert_window *w,
                                   const dyd_exact *bound) {
  search s = {.sites = sites, .bound = bound};
  grid_box window;
  distance_search_init(&s);
  s.item = dyd_alloc(sites->count, sizeof *s.item);
  if (!s.item) s.st = DYD_E_NOMEM;
  *holds = false;
  if (s.st == DYD_OK && dyd_exact_sgn(bound) >= 0) {
    make_grid(&window, &s, w);
    for (uint32_t v = 0; v < sites->count; v++)
      if (sites->site[v].alias == v) place_site(&s, v);
    s.effort_most = ((uint64_t)s.count + 64) << EFFORT_BITS;
    if (!dyd_reserve((void **)&s.list, &s.cap, s.count, sizeof *s.list)) s.st = DYD_E_NOMEM;
    for (size_t k = 0; s.st == DYD_OK && k < s.count; k++) s.list[k] = (uint32_t)k;
    *holds = s.st == DYD_OK && s.count && (spans_all(&s, w) || box_is_covered(&s, &window, 0, s.count, s.count));
    *holds &= s.st == DYD_OK;
  }
  distance_search_clear(&s);
  return s.st;
}
