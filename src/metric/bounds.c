/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Upper bounds on what the partial triangulation leaves open, and the partial Voronoi diagram on a window (mathematics:
 * section 8).
 *
 * [AREA-V] The inner polygons lie in the Int_i, which are disjoint: U has at most the area of W less theirs.
 *
 * [HAUS-V] Let z be in U, p a choice, p_a nearest to z, and j the site with the smallest ds_j(z) among the others.
 * z is not in Int_a, so ds_j(z) <= dl_a(z). Both are possible at z: ds_a <= |z - p_a| <= |z - p_k| <= dl_k for all k,
 * and ds_j <= ds_k <= dl_k for k other than a. So |z - p_j| <= ds_j + diam R_j <= dl_a + diam R_j <= |z - p_a| + diam
 * R_a + diam R_j, and z is at most
 *   (|z-p_j|^2 - |z-p_a|^2) / (2 |p_a - p_j|) <= (diam R_a + diam R_j)(dl_a(z) + dl_j(z)) / (2 dist(R_a,R_j))
 * away from the bisector of p_a and p_j. On the way there it leaves the cell of p_a, at the latest on the bisector: it
 * meets the true diagram: z is within the width of the strip of a and j. And where p_k is not p_a, it is not in the
 * cell of p_a, so the segment from z to it meets the diagram: z is at most dl_k(z) away, for each k with R_k disjoint
 * from R_a, j possibly among them; and at most max(dl_k, dl_l)(z), for any R_k, R_l that are disjoint, since one of
 * p_k, p_l is not p_a. z lies in Pos_a n Pos_j n W, where dl_a, dl_j are at most their largest values at the vertices
 * of the outer polygons (dl is convex), and the others are bounded over boxes (bounds_filter.c). If none of these is
 * known and any two rectangles are disjoint, z is within the diameter of W and all sites of a point that is not p_a.
 * Of discs the same holds with discs as R_i; boxes over which distances are bounded are those around the discs. */
#include "metric/bounds.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/local.h"
#include "dyadic/raw.h"
#include "metric/bounds_filter.h"
#include "rect/rect.h"
#include "rect/sites_table.h"
#include "tolerance/discs.h"
#include "voronoi/shape.h"

/* ---- the triangulation ----
 *
 * Fix a choice p, let G be its Delaunay graph as the union of the segments p_i p_j of its Delaunay edges, and
 * U the union of the partial edges Ed(R_i,R_j) over the possible pairs. Every Delaunay edge of p is a possible pair
 * [POS-1] and its segment lies in the convex hull Ed(R_i,R_j), so G is inside U.
 *
 * [AREA-T] The measure of U is at most the sum of the areas of its members.
 *
 * [HAUS-T] As G is inside U, the Hausdorff distance of the two is the supremum over z in U of dist(z, G). Let z be
 * in Ed(R_i,R_j): R_i and R_j are convex, so z = (1-t) a + t b with a in R_i, b in R_j, 0 <= t <= 1.
 *   Legal pair: p_i p_j is an edge of G whatever the choice, and the point (1-t) p_i + t p_j of it is at distance
 *   |(1-t)(a - p_i) + t (b - p_j)| <= max(diam R_i, diam R_j) from z.
 *   Any possible pair: let t <= 1/2, otherwise exchange the two. Then |z - a| = t |b - a| <= L/2, where L is the
 *   largest distance of a point of R_i to one of R_j, and |a - p_i| <= diam R_i, so p_i is within
 *   L/2 + max(diam R_i, diam R_j) of z. And p_i is in G: if q is the nearest of the chosen points that are not p_i,
 *   the disc with diameter p_i q has no chosen point but these two, so p_i q is a Delaunay edge. (If all chosen
 *   points coincide, G is that point: an edge between coinciding points is the point.)
 * Ties count as any possible pair: a choice of diagonals in a cocircular set may leave such an edge out.
 *
 * With fewer than two sites, aliases not counted, G and U are empty and both bounds are 0.
 *
 * Rounding: terms are rounded up by at most 2^-80 of themselves. A sum of fewer than 2^40 non-negative terms at 128
 * bits adds at most 2^-87 of itself, a maximum nothing, and the last rounding, to 64 bits, 2^-63. Bounds so
 * small that 64 bits would reach below 2^-DYD_EXP_LIMIT are rounded up to a multiple of that instead. */

/* ---- one pair ----
 *
 * The exact rung forms squares of lengths and twice the area as rationals and rounds up at most four times at
 * DYD_MEASURE_PREC bits (value, square root, sum): the excess is below 8 * 2^-127 of the value. */

void dyd_measure_init(dyd_measure *m, const dyd_sites *sites) {
  m->sites = sites;
  m->filter = dyd_filter_measure_usable();
  m->discs = false;
  dyd_rect_init(&m->a);
  dyd_rect_init(&m->b);
  for (size_t k = 0; k < 8; k++) mpq_init(m->end[k]);
  mpq_inits(m->sum, m->term, NULL);
  mpfr_init2(m->t, DYD_MEASURE_PREC);
}

void dyd_measure_clear(dyd_measure *m) {
  mpfr_clear(m->t);
  mpq_clears(m->sum, m->term, NULL);
  for (size_t k = 0; k < 8; k++) mpq_clear(m->end[k]);
  dyd_rect_clear(&m->b);
  dyd_rect_clear(&m->a);
}

/* Fetches R_i into a and end[0..3], R_j into b and end[4..7], in the order x lower, x upper, y lower, y upper. */
static dyd_status measure_fetch(dyd_measure *m, size_t i, size_t j) {
  dyd_status st = dyd_sites_get(&m->a, m->sites, i);
  if (st == DYD_OK) st = dyd_sites_get(&m->b, m->sites, j);
  if (st != DYD_OK) return st;
  dyd_interval_get_q(m->end[0], m->end[1], &m->a.x);
  dyd_interval_get_q(m->end[2], m->end[3], &m->a.y);
  dyd_interval_get_q(m->end[4], m->end[5], &m->b.x);
  dyd_interval_get_q(m->end[6], m->end[7], &m->b.y);
  return DYD_OK;
}

/* sum += max(p1 - q0, q1 - p0)^2 for the intervals at end[p] and end[q]. */
static void add_farthest2(dyd_measure *m, size_t p, size_t q) {
  DYD_LOCAL_NUMBERS(mpq, other);
  mpq_sub(m->term, m->end[p + 1], m->end[q]);
  mpq_sub(other, m->end[q + 1], m->end[p]);
  if (mpq_cmp(other, m->term) > 0) mpq_swap(other, m->term);
  mpq_mul(m->term, m->term, m->term);
  mpq_add(m->sum, m->sum, m->term);
}

/* out = the largest distance of a point of the rectangle at end[p] to one at end[q]; p = q: the diameter. */
static void measure_farthest(mpfr_ptr out, dyd_measure *m, size_t p, size_t q) {
  mpq_set_ui(m->sum, 0, 1);
  add_farthest2(m, p, q);
  add_farthest2(m, p + 2, q + 2);
  mpfr_set_q(out, m->sum, MPFR_RNDU);
  mpfr_sqrt(out, out, MPFR_RNDU);
}

/* A filter of one rectangle or of two; false where it declines, or doubles do not hold them. */
typedef bool (*measure_filter)(double out[2], const double a[4], const double b[4]);

static bool measure_in_doubles(mpfr_ptr out, const dyd_measure *m, size_t i, size_t j, measure_filter f) {
  double a[4], b[4], dd[2];
  if (!m->filter || !dyd_sites_in_doubles(m->sites, i) || !dyd_sites_in_doubles(m->sites, j)) return false;
  dyd_sites_get_d(a, m->sites, i);
  dyd_sites_get_d(b, m->sites, j);
  if (!f(dd, a, b)) return false;
  mpfr_set_d(out, dd[0], MPFR_RNDU);
  mpfr_add_d(out, out, dd[1], MPFR_RNDU);
  return true;
}

dyd_status dyd_measure_area(mpfr_ptr out, dyd_measure *m, size_t i, size_t j) {
  mpfr_set_zero(out, 1);
  if (dyd_sites_is_point(m->sites, i) && dyd_sites_is_point(m->sites, j)) return DYD_OK;
  if (!measure_in_doubles(out, m, i, j, dyd_filter_partial_edge_area2)) {
    dyd_status st = measure_fetch(m, i, j);
    if (st != DYD_OK) return st;
    dyd_partial_edge_area2(m->sum, &m->a, &m->b);
    mpfr_set_q(out, m->sum, MPFR_RNDU);
  }
  mpfr_div_2ui(out, out, 1, MPFR_RNDU);
  return DYD_OK;
}

static bool filter_diameter(double out[2], const double a[4], const double b[4]) {
  (void)b;
  return dyd_filter_diameter(out, a);
}

dyd_status dyd_measure_diameter(mpfr_ptr out, dyd_measure *m, size_t i) {
  mpfr_set_zero(out, 1);
  if (dyd_sites_is_point(m->sites, i) || measure_in_doubles(out, m, i, i, filter_diameter)) return DYD_OK;
  dyd_status st = measure_fetch(m, i, i);
  if (st == DYD_OK) measure_farthest(out, m, 0, 0);
  return st;
}

dyd_status dyd_measure_reach(mpfr_ptr out, dyd_measure *m, size_t i, size_t j) {
  if (measure_in_doubles(out, m, i, j, dyd_filter_reach)) return DYD_OK;
  dyd_status st = measure_fetch(m, i, j);
  if (st != DYD_OK) return st;
  measure_farthest(out, m, 0, 0);
  measure_farthest(m->t, m, 4, 4);
  mpfr_max(m->t, m->t, out, MPFR_RNDU);
  measure_farthest(out, m, 0, 4);
  mpfr_div_2ui(out, out, 1, MPFR_RNDU);
  mpfr_add(out, out, m->t, MPFR_RNDU);
  return DYD_OK;
}

/* sum += the square of the gap between the intervals at end[p] and end[q]. */
static void add_gap2(dyd_measure *m, size_t p, size_t q) {
  mpq_sub(m->term, m->end[q], m->end[p + 1]);
  if (mpq_sgn(m->term) <= 0) mpq_sub(m->term, m->end[p], m->end[q + 1]);
  if (mpq_sgn(m->term) <= 0) return;
  mpq_mul(m->term, m->term, m->term);
  mpq_add(m->sum, m->sum, m->term);
}

/* The smallest distance of a point of R_i to one of R_j, rounded down: not above the true value t and not below
 * (1 - 2^-80) t. */
static dyd_status measure_gap(mpfr_ptr out, dyd_measure *m, size_t i, size_t j) {
  dyd_status st = measure_fetch(m, i, j);
  if (st != DYD_OK) return st;
  mpq_set_ui(m->sum, 0, 1);
  add_gap2(m, 0, 4);
  add_gap2(m, 2, 6);
  mpfr_set_q(out, m->sum, MPFR_RNDD);
  mpfr_sqrt(out, out, MPFR_RNDD);
  return DYD_OK;
}

/* pair_extent of discs. */
static dyd_status discs_extent(mpfr_ptr gap, mpfr_ptr diameters, dyd_measure *m, const dyd_pair *pair) {
  DYD_LOCAL(dyd_disc, a, b);
  dyd_status st = dyd_disc_of_site(&a, m->sites, pair->i);
  if (st == DYD_OK) st = dyd_disc_of_site(&b, m->sites, pair->j);
  mpq_sub(m->sum, a.x, b.x);
  mpq_sub(m->term, a.y, b.y);
  mpq_mul(m->sum, m->sum, m->sum);
  mpq_mul(m->term, m->term, m->term);
  mpq_add(m->sum, m->sum, m->term);
  mpq_add(m->term, a.r, b.r);
  mpfr_set_q(gap, m->sum, MPFR_RNDD);
  mpfr_sqrt(gap, gap, MPFR_RNDD);
  mpfr_sub_q(gap, gap, m->term, MPFR_RNDD);
  if (mpfr_sgn(gap) < 0) mpfr_set_zero(gap, 1);
  mpfr_set_q(diameters, m->term, MPFR_RNDU);
  mpfr_mul_2ui(diameters, diameters, 1, MPFR_RNDU);
  return st;
}

dyd_status dyd_bound_pair_hausdorff(mpfr_ptr out, dyd_measure *m, const dyd_pair *pair) {
  if (pair->status != DYD_LEGAL) return dyd_measure_reach(out, m, pair->i, pair->j);
  dyd_status st = dyd_measure_diameter(out, m, pair->i);
  if (st != DYD_OK) return st;
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, other);
  st = dyd_measure_diameter(other, m, pair->j);
  mpfr_max(out, out, other, MPFR_RNDU);
  return st;
}

/* The sum of the areas of the pairs, or the largest distance of one pair. */
static dyd_status bound_over(mpfr_ptr out, dyd_measure *m, const dyd_pair_list *pairs, bool area) {
  dyd_status st = DYD_OK;
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, term);
  mpfr_set_zero(out, 1);
  for (size_t k = 0; k < pairs->count && st == DYD_OK; k++) {
    const dyd_pair *p = &pairs->item[k];
    st = area ? dyd_measure_area(term, m, p->i, p->j) : dyd_bound_pair_hausdorff(term, m, p);
    (area ? mpfr_add : mpfr_max)(out, out, term, MPFR_RNDU);
  }
  return st;
}

dyd_status dyd_bound_area(mpfr_ptr out, dyd_measure *m, const dyd_pair_list *pairs) {
  return bound_over(out, m, pairs, true);
}

dyd_status dyd_bound_hausdorff(mpfr_ptr out, dyd_measure *m, const dyd_pair_list *pairs) {
  return bound_over(out, m, pairs, false);
}

/* out = x >= 0 rounded up to 64 bits, and up to the least positive dyadic. DYD_E_RANGE when x is too large. */
static dyd_status bound_to_dyadic(dyd_dyadic *out, mpfr_srcptr x) {
  if (mpfr_zero_p(x)) return dyd_dyadic_set_si_2exp(out, 0, 0);
  if (!mpfr_regular_p(x)) return DYD_E_RANGE;
  if (mpfr_cmp_ui_2exp(x, 1, -(mpfr_exp_t)DYD_EXP_LIMIT) <= 0) return dyd_dyadic_set_si_2exp(out, 1, -DYD_EXP_LIMIT);
  DYD_LOCAL_NUMBERS(mpz, man);
  DYD_LOCAL_FLOATS(64, short_x);
  mpfr_set(short_x, x, MPFR_RNDU);
  mpfr_exp_t exp = mpfr_get_z_2exp(man, short_x);
  if (exp < -DYD_EXP_LIMIT) {
    mpz_cdiv_q_2exp(man, man, (mp_bitcnt_t)(-DYD_EXP_LIMIT - exp));
    exp = -DYD_EXP_LIMIT;
  }
  return dyd_dyadic_set_z_2exp(out, man, exp);
}

/* Where all are exact points and nothing is open every term of both bounds is zero. */
static bool bounds_are_zero(const dyd_delaunay *pd) {
  const dyd_sites *sites = dyd_delaunay_sites(pd);
  size_t count[4];
  dyd_delaunay_count(count, pd);
  bool zero = count[DYD_INDETERMINATE] == 0 && count[DYD_TIE] == 0;
  for (size_t i = 0; zero && i < dyd_sites_count(sites); i++) zero = dyd_sites_is_point(sites, i);
  return zero;
}

dyd_status dyd_metric_bound(dyd_dyadic *out, const dyd_delaunay *pd, const dyd_pair_list *discs, bool area) {
  if (!pd) return DYD_E_ARG;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  if (bounds_are_zero(pd)) return dyd_dyadic_set_si_2exp(out, 0, 0);
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_measure m;
  mpfr_t x;
  dyd_status st = discs ? DYD_OK : dyd_delaunay_pairs(&pairs, pd);
  if (st == DYD_OK) {
    dyd_measure_init(&m, dyd_delaunay_sites(pd));
    mpfr_init2(x, DYD_MEASURE_PREC);
    st = bound_over(x, &m, discs ? discs : &pairs, area);
    if (st == DYD_OK) st = bound_to_dyadic(out, x);
    mpfr_clear(x);
    dyd_measure_clear(&m);
  }
  return st;
}

dyd_status dyd_metric_area(dyd_dyadic *out, const dyd_delaunay *pd) {
  return dyd_metric_bound(out, pd, NULL, true);
}

dyd_status dyd_metric_hausdorff(dyd_dyadic *out, const dyd_delaunay *pd) {
  return dyd_metric_bound(out, pd, NULL, false);
}

/* Areas in W are below 2^(2 e), polygons are within 2^-bits: sums need some e + bits more digits than a bound. */
static mpfr_prec_t sum_precision(const dyd_rect *window, int64_t bits) {
  const dyd_dyadic *end[4] = {&window->x.lo, &window->x.hi, &window->y.lo, &window->y.hi};
  int64_t most = 0;
  for (int k = 0; k < 4; k++) {
    int64_t e = end[k]->exp + dyd_bits(end[k]->man);
    if (e > most) most = e;
  }
  return DYD_MEASURE_PREC + (bits + 2 * most > 0 ? (mpfr_prec_t)(bits + 2 * most) : 0);
}

dyd_status dyd_voronoi_sums_init(dyd_voronoi_sums *s, const dyd_delaunay *pd, const dyd_rect *window, int64_t bits) {
  size_t n = dyd_sites_count(dyd_delaunay_sites(pd));
  *s = (dyd_voronoi_sums){.pd = pd,
                          .window = window,
                          .bits = bits,
                          .most = HUGE_VAL,
                          .exact = true,
                          .proved = dyd_has_proved_tie(pd),
                          .memory = dyd_delaunay_memory_left(pd)};
  mpfr_inits2(sum_precision(window, bits), s->inner, s->term, (mpfr_ptr)0);
  mpfr_set_zero(s->inner, 1);
  dyd_dyadic_init(&s->area2);
  uint64_t bytes = dyd_bytes_times(n, sizeof *s->reach + sizeof *s->second);
  if (!dyd_memory_has(&s->memory, bytes, "the diagram")) return DYD_E_NOMEM;
  s->memory.held += bytes;
  if (!DYD_NEW(s->reach, n) || !DYD_NEW(s->second, n)) return DYD_E_NOMEM;
  for (size_t i = 0; i < n; i++) s->reach[i] = s->second[i] = -1;
  return DYD_OK;
}

void dyd_voronoi_sums_clear(dyd_voronoi_sums *s) {
  dyd_free_all(s->second, s->reach);
  dyd_dyadic_clear(&s->area2);
  mpfr_clears(s->inner, s->term, (mpfr_ptr)0);
}

static void mpfr_from_dyadic(mpfr_ptr out, const dyd_dyadic *x, mpfr_rnd_t rnd) {
  mpfr_set_z_2exp(out, x->man, (mpfr_exp_t)x->exp, rnd);
}

/* area[outer] = the area of the polygons, rounded outward; so is s->term, of the inner one. */
static dyd_status add_exact_shape(double area[2], dyd_voronoi_sums *s, const dyd_shape *shape) {
  dyd_status st = DYD_OK;
  for (int outer = 1; outer >= 0 && st == DYD_OK; outer--) {
    mpfr_rnd_t rnd = outer ? MPFR_RNDU : MPFR_RNDD;
    st = dyd_shape_area2(&s->area2, shape, outer);
    if (st != DYD_OK) return st;
    mpfr_from_dyadic(s->term, &s->area2, rnd);
    mpfr_div_2ui(s->term, s->term, 1, rnd);
    area[outer] = mpfr_get_d(s->term, rnd);
  }
  mpfr_add(s->inner, s->inner, s->term, MPFR_RNDD);
  return st;
}

/* Adds the shape of site i (no alias). */
static dyd_status add_shape(double area[2], dyd_voronoi_sums *s, uint32_t i, const dyd_shape *shape) {
  double box[4];
  dyd_measure_box(box, dyd_delaunay_sites(s->pd), i, s->discs);
  s->reach[i] = dyd_filter_reach_of_shape(shape, box);
  s->added++;
  s->inexact += !shape->exact;
  if (!shape->in_doubles || shape->on_grid) return add_exact_shape(area, s, shape);
  area[0] = shape->area[0];
  area[1] = shape->area[1];
  mpfr_add_d(s->inner, s->inner, area[0], MPFR_RNDD);
  return DYD_OK;
}

/* The shape of site i, or an unknown one once the work is cancelled. */
static dyd_status find_shape(dyd_shape *shape, dyd_voronoi_sums *s, uint32_t i, const dyd_window *w) {
  dyd_status st = dyd_shape_find(shape, s->pd, i, w, s->bits);
  if (st != DYD_CANCELLED || !s->cut) return st;
  ++*s->cut;
  return dyd_shape_set_unknown(shape, s->window);
}

dyd_status dyd_voronoi_sums_all(dyd_voronoi_sums *s, dyd_voronoi_visit visit, void *context) {
  size_t n = dyd_sites_count(dyd_delaunay_sites(s->pd));
  DYD_SCOPED(dyd_shape) shape = {0};
  dyd_window w;
  dyd_status st = dyd_window_init(&w, s->window);
  w.cancel = s->cancel;
  w.memory = &s->memory;
  w.most = s->corners;
  w.proved = s->exact;
  if (s->corners && n > DYD_TIGHT_SITES) w.fan_bits = dyd_metric_coarseness(s->pd, s->window);
  w.discs = s->discs;
  if (st == DYD_OK && s->exact) dyd_window_set_grid(&w, DYD_GRID_FINE);
  for (size_t i = 0; i < n && st == DYD_OK; i++) {
    double area[2];
    if (dyd_delaunay_alias(s->pd, (uint32_t)i) != i) continue;
    st = find_shape(&shape, s, (uint32_t)i, &w);
    if (st == DYD_OK) st = add_shape(area, s, (uint32_t)i, &shape);
    if (st == DYD_OK && visit) st = visit(context, (uint32_t)i, &shape, area);
  }
  return st;
}

/* ---- area ---- */

void dyd_voronoi_area(mpfr_ptr out, const dyd_voronoi_sums *s) {
  DYD_LOCAL_ARRAY(dyd_dyadic, side, [2]);
  DYD_LOCAL(dyd_dyadic, area);
  DYD_LOCAL_FLOATS(mpfr_get_prec(s->inner), exact);
  mpfr_set_inf(out, 1);
  if (dyd_dyadic_sub(&side[0], &s->window->x.hi, &s->window->x.lo) == DYD_OK &&
      dyd_dyadic_sub(&side[1], &s->window->y.hi, &s->window->y.lo) == DYD_OK &&
      dyd_dyadic_mul(&area, &side[0], &side[1]) == DYD_OK) {
    mpfr_from_dyadic(exact, &area, MPFR_RNDU);
    mpfr_sub(out, exact, s->inner, MPFR_RNDU);
    bool whole = s->added && !s->inexact; /* cells of exact points fill W */
    if (whole || mpfr_sgn(out) < 0) mpfr_set_zero(out, 1);
  }
}

/* ---- Hausdorff ---- */

/* Bounds of the distance of both regions from below, and of the sum of their diameters from above. */
static dyd_status pair_extent(mpfr_ptr gap, mpfr_ptr diameters, dyd_measure *m, const dyd_pair *pair) {
  if (m->discs) return discs_extent(gap, diameters, m, pair);
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, other);
  dyd_status st = measure_gap(gap, m, pair->i, pair->j);
  if (st == DYD_OK) st = dyd_measure_diameter(diameters, m, pair->i);
  if (st == DYD_OK) st = dyd_measure_diameter(other, m, pair->j);
  mpfr_add(diameters, diameters, other, MPFR_RNDU);
  return st;
}

static dyd_pair_status sums_least(const dyd_voronoi_sums *s) {
  return s->exact ? dyd_least_bounding_true(s->pd) : dyd_least_bounding(s->pd);
}

void dyd_voronoi_pair_reach(double reach[2], const dyd_voronoi_sums *s, const dyd_pair *pair) {
  const uint32_t end[2] = {pair->i, pair->j};
  double box[2][4];
  for (int k = 0; k < 2; k++) reach[k] = s->reach[end[k]];
  if (s->exact && s->proved) {
    for (int k = 0; k < 2; k++) dyd_measure_box(box[k], dyd_delaunay_sites(s->pd), end[k], s->discs);
    dyd_filter_proved_reach(reach, box[0], box[1]);
  } else if (reach[0] < 0 || reach[1] < 0) {
    reach[0] = reach[1] = -1;
  }
}

dyd_status dyd_voronoi_pair_width(mpfr_ptr out, bool *finite, const dyd_voronoi_sums *s, dyd_measure *m,
                                  const dyd_pair *pair) {
  double reach[2];
  *finite = true;
  mpfr_set_zero(out, 1);
  const dyd_sites *sites = m->sites;
  dyd_voronoi_pair_reach(reach, s, pair);
  if (reach[0] < 0 || (dyd_sites_is_point(sites, pair->i) && dyd_sites_is_point(sites, pair->j))) return DYD_OK;
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, gap, other);
  dyd_status st = pair_extent(gap, out, m, pair);
  *finite = st != DYD_OK || !mpfr_zero_p(gap);
  if (st == DYD_OK && *finite) {
    mpfr_set_d(other, reach[0], MPFR_RNDU);
    mpfr_add_d(other, other, reach[1], MPFR_RNDU);
    mpfr_mul(out, out, other, MPFR_RNDU);
    mpfr_div(out, out, gap, MPFR_RNDU);
    mpfr_div_2ui(out, out, 1, MPFR_RNDU);
    double most = reach[0] > reach[1] ? reach[0] : reach[1];
    if (mpfr_cmp_d(out, most) > 0) mpfr_set_d(out, most, MPFR_RNDU);
  }
  return st;
}

/* seen[i]: the value found for site i, -1 until then. */
static dyd_status pair_find_second(double *out, double *seen, const dyd_voronoi_sums *s, const dyd_pair *pair,
                                   double enough) {
  const uint32_t end[2] = {pair->i, pair->j};
  dyd_status st = DYD_OK;
  *out = 0;
  for (int k = 0; k < 2 && st == DYD_OK && *out < HUGE_VAL; k++) {
    if (seen[end[k]] < 0) st = dyd_filter_second(&seen[end[k]], s, end[k], enough);
    if (seen[end[k]] > *out) *out = seen[end[k]];
  }
  return st;
}

dyd_status dyd_voronoi_pair_second(double *out, dyd_voronoi_sums *s, const dyd_pair *pair) {
  return pair_find_second(out, s->second, s, pair, 0);
}

/* The bound for one possible pair: its width, or the distance of other points where that is smaller; or else less than
 * `enough`. *known = false: there is neither. */
static dyd_status pair_distance(mpfr_ptr out, bool *known, double *seen, const dyd_voronoi_sums *s, dyd_measure *m,
                                const dyd_pair *pair, double enough) {
  double second;
  *known = true;
  dyd_status st = pair_find_second(&second, seen, s, pair, enough);
  mpfr_set_d(out, second, MPFR_RNDU);
  if (st == DYD_OK && !(second <= enough)) st = dyd_voronoi_pair_width(out, known, s, m, pair);
  if (st == DYD_OK && second < HUGE_VAL && (!*known || mpfr_cmp_d(out, second) > 0)) {
    mpfr_set_d(out, second, MPFR_RNDU);
    *known = true;
  }
  return st;
}

/* Returns true if the pair cannot be above `most`. */
static bool pair_is_small(const dyd_voronoi_sums *s, const dyd_pair *pair, mpfr_srcptr most) {
  double a[4], b[4], reach[2];
  dyd_voronoi_pair_reach(reach, s, pair);
  if (reach[0] < 0) return true;
  dyd_measure_box(a, dyd_delaunay_sites(s->pd), pair->i, s->discs);
  dyd_measure_box(b, dyd_delaunay_sites(s->pd), pair->j, s->discs);
  double value = dyd_filter_voronoi_pair(a, b, reach[0], reach[1]);
  return value < HUGE_VAL && mpfr_cmp_d(most, value) >= 0;
}

dyd_status dyd_voronoi_hausdorff(mpfr_ptr out, bool *finite, dyd_voronoi_sums *s, const dyd_pair_list *pairs) {
  DYD_SCOPED(dyd_measure) m;
  bool open = false;
  size_t n = dyd_sites_count(dyd_delaunay_sites(s->pd));
  DYD_FREED double *seen = dyd_alloc(n, sizeof *seen);
  dyd_status st = seen ? DYD_OK : DYD_E_NOMEM;
  for (size_t i = 0; i < n && seen; i++) seen[i] = -1;
  dyd_measure_init(&m, dyd_delaunay_sites(s->pd));
  m.discs = s->discs;
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, one);
  mpfr_set_zero(out, 1);
  *finite = true;
  for (size_t k = 0; k < pairs->count && st == DYD_OK; k++) {
    bool known;
    if (dyd_flag_is_set(s->cancel)) st = DYD_CANCELLED;
    if (st != DYD_OK) break;
    if (pair_is_small(s, &pairs->item[k], out)) continue;
    st = pair_distance(one, &known, seen, s, &m, &pairs->item[k], mpfr_get_d(out, MPFR_RNDD));
    open |= !known;
    if (known) mpfr_max(out, out, one, MPFR_RNDU);
  }
  if (st == DYD_OK && open) {
    double extent = dyd_filter_extent(finite, m.sites, s->window);
    if (*finite && !(extent < HUGE_VAL)) *finite = false;
    if (*finite)
      mpfr_set_d(out, extent, MPFR_RNDU);
    else
      mpfr_set_zero(out, 1);
  }
  if (mpfr_inf_p(out)) { /* beyond the doubles that reaches are kept in */
    *finite = false;
    mpfr_set_zero(out, 1);
  }
  return st;
}

/* ---- rates ---- */

/* Raises *most to sqrt(2) (reach_i + reach_j) / gap of a pair, rounded up: times w this is at least the width of the
 * pair for narrower rectangles of sides up to w, since reaches and gaps only come closer [HAUS-V]. */
static dyd_status rate_add_pair(mpfr_ptr most, bool *known, const dyd_voronoi_sums *s, dyd_measure *m,
                                const dyd_pair *pair) {
  double reach[2];
  dyd_voronoi_pair_reach(reach, s, pair);
  if (reach[0] < 0) return DYD_OK;
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, gap, one);
  dyd_status st = pair_extent(gap, one, m, pair);
  *known = *known && st == DYD_OK && !mpfr_zero_p(gap);
  if (*known) {
    mpfr_set_d(one, reach[0], MPFR_RNDU);
    mpfr_add_d(one, one, reach[1], MPFR_RNDU);
    mpfr_div(one, one, gap, MPFR_RNDU);
    mpfr_sqr(gap, one, MPFR_RNDU);
    mpfr_mul_2ui(gap, gap, 1, MPFR_RNDU);
    mpfr_sqrt(one, gap, MPFR_RNDU);
    mpfr_max(most, most, one, MPFR_RNDU);
  }
  return st;
}

/* The least e with x <= 2^e, x > 0. */
static int64_t log2_above(mpfr_srcptr x) {
  return (int64_t)mpfr_get_exp(x) - (mpfr_cmp_ui_2exp(x, 1, mpfr_get_exp(x) - 1) == 0);
}

static dyd_status sums_rate(int64_t *rate, bool *known, dyd_voronoi_sums *s) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  DYD_SCOPED(dyd_measure) m;
  dyd_measure_init(&m, dyd_delaunay_sites(s->pd));
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, most);
  mpfr_set_zero(most, 1);
  *known = true;
  dyd_status st = dyd_pairs_list(&pairs, s->pd, dyd_least_bounding(s->pd));
  for (size_t k = 0; st == DYD_OK && *known && k < pairs.count; k++)
    st = rate_add_pair(most, known, s, &m, &pairs.item[k]);
  *known = *known && mpfr_number_p(most);
  if (*known) *rate = mpfr_zero_p(most) ? 0 : log2_above(most); /* 0: nothing is undetermined in the window */
  return st;
}

dyd_status dyd_metric_voronoi_rate(int64_t *rate, bool *known, const dyd_delaunay *pd, const dyd_rect *window,
                                   const volatile int *cancel) {
  DYD_SCOPED(dyd_voronoi_sums) s;
  *known = false;
  dyd_status st = dyd_voronoi_sums_init(&s, pd, window, dyd_metric_coarseness(pd, window));
  s.cancel = cancel;
  if (st == DYD_OK) st = dyd_voronoi_sums_all(&s, NULL, NULL);
  return st == DYD_OK ? sums_rate(rate, known, &s) : st;
}

/* ---- public ---- */

dyd_status dyd_voronoi_sums_bounds(dyd_voronoi_bounds *out, dyd_voronoi_sums *s) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  DYD_LOCAL_FLOATS(DYD_MEASURE_PREC, area, hausdorff);
  dyd_status st = dyd_memory_has(&s->memory, dyd_pairs_bytes(s->pd, sums_least(s)), "the bounds of the diagram")
                      ? DYD_OK
                      : DYD_E_NOMEM;
  if (st == DYD_OK) st = dyd_pairs_take(&pairs, s->pd, sums_least(s));
  dyd_voronoi_area(area, s);
  if (st == DYD_OK) st = dyd_voronoi_hausdorff(hausdorff, &out->finite, s, &pairs);
  if (st == DYD_CANCELLED && s->cut) { /* not known */
    st = DYD_OK;
    out->finite = false;
    mpfr_set_zero(hausdorff, 1);
  }
  if (st == DYD_OK) st = bound_to_dyadic(&out->area, area);
  return st == DYD_OK ? bound_to_dyadic(&out->hausdorff, hausdorff) : st;
}

dyd_status dyd_voronoi_bounds_within(dyd_voronoi_bounds *out, const dyd_delaunay *pd, const dyd_rect *window,
                                     int64_t bits, size_t corners, bool discs, const volatile int *cancel) {
  dyd_window w;
  if (dyd_abi_check(out, sizeof *out, "dyd_voronoi_bounds", NULL) != DYD_OK) return DYD_E_ARG;
  if (bits < -DYD_EXP_LIMIT / 4 || bits > DYD_EXP_LIMIT / 4) return DYD_E_ARG;
  dyd_status st = dyd_window_init(&w, window);
  if (st != DYD_OK) return st;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  DYD_LOCAL(dyd_voronoi_bounds, b);
  DYD_SCOPED(dyd_voronoi_sums) s;
  st = dyd_voronoi_sums_init(&s, pd, window, bits);
  s.cancel = cancel;
  s.corners = corners;
  s.discs = discs;
  if (st == DYD_OK) st = dyd_voronoi_sums_all(&s, NULL, NULL);
  if (st == DYD_OK) st = dyd_voronoi_sums_bounds(&b, &s);
  if (st == DYD_OK) {
    dyd_dyadic_swap(&out->area, &b.area);
    dyd_dyadic_swap(&out->hausdorff, &b.hausdorff);
    out->finite = b.finite;
  }
  return st;
}

dyd_status dyd_metric_voronoi(dyd_voronoi_bounds *out, const dyd_delaunay *pd, const dyd_rect *window, int64_t bits,
                              const volatile int *cancel) {
  return dyd_voronoi_bounds_within(out, pd, window, bits, 0, false, cancel);
}

/* The perimeters of N cells of equal area in W are about 4 sqrt(N area(W)) in all, plus the perimeter of W. */
int64_t dyd_metric_flattening(const dyd_delaunay *pd, const dyd_rect *window, int64_t goal_bits) {
  if (!pd) return 0;
  mpfr_t side[2], length;
  size_t n = dyd_sites_count(dyd_delaunay_sites(pd));
  mpfr_inits2(64, side[0], side[1], length, (mpfr_ptr)0);
  for (int a = 0; a < 2; a++) {
    const dyd_interval *s = a ? &window->y : &window->x;
    mpfr_from_dyadic(side[a], &s->hi, MPFR_RNDU);
    mpfr_from_dyadic(length, &s->lo, MPFR_RNDD);
    mpfr_sub(side[a], side[a], length, MPFR_RNDU);
  }
  mpfr_add(length, side[0], side[1], MPFR_RNDU);
  mpfr_mul_ui(length, length, 2, MPFR_RNDU);
  mpfr_mul(side[0], side[0], side[1], MPFR_RNDU);
  mpfr_mul_ui(side[0], side[0], n ? (unsigned long)n : 1, MPFR_RNDU);
  mpfr_sqrt(side[0], side[0], MPFR_RNDU);
  mpfr_mul_ui(side[0], side[0], 4, MPFR_RNDU);
  mpfr_add(length, length, side[0], MPFR_RNDU);
  int64_t bits = goal_bits + 3 + (mpfr_regular_p(length) ? (int64_t)mpfr_get_exp(length) : 0);
  mpfr_clears(side[0], side[1], length, (mpfr_ptr)0);
  return bits;
}

/* The e with 2^e <= the shorter side < 2^(e+1). */
static int64_t log2_short_side(const dyd_rect *window) {
  const dyd_interval *side[2] = {&window->x, &window->y};
  int64_t least = INT64_MAX;
  DYD_LOCAL(dyd_dyadic, length);
  for (int a = 0; a < 2; a++) {
    if (dyd_dyadic_sub(&length, &side[a]->hi, &side[a]->lo) != DYD_OK) continue;
    int64_t log2 = length.exp + dyd_bits(length.man) - 1;
    if (log2 < least) least = log2;
  }
  return least;
}

/* With a total perimeter L of N cells, a cell has about the size L / (4 N); but it is no wider than the window, which
 * bounds it better where one side of that is very short. */
int64_t dyd_metric_coarseness(const dyd_delaunay *pd, const dyd_rect *window) {
  if (!pd) return 0;
  size_t n = dyd_sites_count(dyd_delaunay_sites(pd));
  int64_t log2_n = 0, log2_length = dyd_metric_flattening(pd, window, 0) - 3;
  while (log2_n < 60 && (size_t)1 << log2_n < n) log2_n++;
  int64_t bits = log2_n + 6 - log2_length, least = -log2_short_side(window);
  return bits > least ? bits : least;
}
