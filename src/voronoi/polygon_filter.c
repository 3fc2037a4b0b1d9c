/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The polygons of polygon.c, number by number, from the boundary in doubles.
 *
 * All points of that rung are multiples of some 2^-scale. Here they are integers of at most GRID bits, so that sums,
 * means, steps and turns are exact; where a coordinate is rounded to the grid its enclosure has to lie between two
 * neighbours there, or it is taken from one of them, and where a point is proved the bounds of [FLT-DST] have to say
 * yes or no. So the polygons are the same ones, or as good (`loose`), or the filter declines [OUTLINE-1]. */
#include "base/alloc.h"
#include "base/local.h"
#include "voronoi/outline_filter.h"
#include "voronoi/sample.h"
#include "voronoi/shape.h"

#include <limits.h>
#include <stdlib.h>

#define WIDEST 0x1p-4 /* enclosures that are rounded, in steps of the grid */

enum { GRID = 50, FIRST_EXTRA = 8, FINER = 2, SAMPLES = 1 << 14 };

/* ---- polygons on a grid: turns and areas fit into 128 bits ---- */

/* A point times 2^scale. */
typedef struct grid_point {
  int64_t at[2];
  int scale;
} grid_point;

typedef struct grid_polygon {
  grid_point *vertex;
  size_t count, cap;
} grid_polygon;

/* All vertices on the finest of their grids; false: they do not fit there. */
static bool grid_align(grid_polygon *p) {
  int scale = INT_MIN;
  bool fits = true;
  for (size_t k = 0; k < p->count; k++)
    if (p->vertex[k].scale > scale) scale = p->vertex[k].scale;
  for (size_t k = 0; k < p->count; k++) {
    grid_point *z = &p->vertex[k];
    int up = scale - z->scale;
    for (int a = 0; a < 2; a++) {
      if (up > GRID || llabs(z->at[a]) >> (GRID + 2 - up)) fits = false;
      if (fits) z->at[a] = (int64_t)((uint64_t)z->at[a] << up);
    }
    z->scale = scale;
  }
  return fits;
}

/* Twice the area of a, b, c, with its sign. */
static dyd_i128 grid_turn(const grid_point *a, const grid_point *b, const grid_point *c) {
  return (dyd_i128)(b->at[0] - a->at[0]) * (c->at[1] - a->at[1]) -
         (dyd_i128)(b->at[1] - a->at[1]) * (c->at[0] - a->at[0]);
}

static int compare_grid(const void *a, const void *b) {
  const grid_point *p = a, *q = b;
  for (int k = 0; k < 2; k++)
    if (p->at[k] != q->at[k]) return p->at[k] < q->at[k] ? -1 : 1;
  return 0;
}

static size_t grid_extend(grid_point *chain, size_t kept, size_t floor, grid_point z) {
  while (kept >= floor + 2 && grid_turn(&chain[kept - 2], &chain[kept - 1], &z) <= 0) kept--;
  chain[kept++] = z;
  return kept;
}

/* As dyd_polygon_make_convex. The hull is made behind the vertices. */
static dyd_status grid_make_convex(grid_polygon *p) {
  size_t n = p->count, kept = 0;
  if (!DYD_GROW(p->vertex, p->cap, 3 * n + 1)) return DYD_E_NOMEM;
  grid_point *z = p->vertex, *chain = z + n;
  qsort(z, n, sizeof *z, compare_grid);
  for (size_t k = 0; k < n; k++) kept = grid_extend(chain, kept, 0, z[k]);
  size_t floor = kept ? kept - 1 : 0;
  for (size_t k = n; k-- > 1;) kept = grid_extend(chain, kept, floor, z[k - 1]);
  kept = kept ? kept - 1 : 0;
  p->count = kept >= 3 ? kept : 0;
  for (size_t k = 0; k < p->count; k++) z[k] = chain[k];
  return DYD_OK;
}

static int64_t min64(int64_t a, int64_t b) {
  return a < b ? a : b;
}

/* Returns true if the closed boxes of the edges from a and from c meet. */
static bool grid_edges_near(const grid_point *a, const grid_point *b, const grid_point *c, const grid_point *d) {
  for (int k = 0; k < 2; k++)
    if (-min64(-a->at[k], -b->at[k]) < min64(c->at[k], d->at[k]) ||
        -min64(-c->at[k], -d->at[k]) < min64(a->at[k], b->at[k]))
      return false;
  return true;
}

/* Edge c d and the next one, d e, in one line: does the second go back? */
static bool grid_folds(const grid_point *c, const grid_point *d, const grid_point *e) {
  dyd_i128 x = (dyd_i128)(d->at[0] - c->at[0]) * (e->at[0] - d->at[0]);
  return !grid_turn(c, d, e) && x + (dyd_i128)(d->at[1] - c->at[1]) * (e->at[1] - d->at[1]) <= 0;
}

/* Are two points not on one side of a line, by their turns? */
static bool turns_apart(dyd_i128 s, dyd_i128 t) {
  return !((s < 0 && t < 0) || (s > 0 && t > 0));
}

/* Returns true if no edge meets another but in the common vertex of neighbours. Edges whose boxes meet do if neither
 * has both ends on one side of the other's line. O(n^2). */
static bool grid_is_simple(const grid_polygon *p) {
  const grid_point *z = p->vertex;
  size_t n = p->count;
  for (size_t j = 0; j < n; j++) {
    const grid_point *c = &z[j], *d = &z[j + 1 == n ? 0 : j + 1];
    if (grid_folds(c, d, &z[(j + 2) % n])) return false;
    for (size_t i = 0; i + 1 < j; i++) {
      const grid_point *a = &z[i], *b = &z[i + 1];
      if ((j + 1 == n && i == 0) || !grid_edges_near(a, b, c, d)) continue;
      if (turns_apart(grid_turn(a, b, c), grid_turn(a, b, d)) && turns_apart(grid_turn(c, d, a), grid_turn(c, d, b)))
        return false;
    }
  }
  return n >= 3;
}

/* As dyd_polygon_is_simple takes out repeats. */
static void grid_drop_repeats(grid_polygon *p) {
  size_t kept = 0, n = p->count;
  for (size_t k = 0; k < n; k++)
    if (n == 1 || compare_grid(&p->vertex[k], &p->vertex[kept ? kept - 1 : n - 1])) p->vertex[kept++] = p->vertex[k];
  p->count = kept;
}

/* Twice the area, with its sign, of an aligned one. */
static dyd_i128 grid_area2(const grid_polygon *p) {
  dyd_i128 sum = 0;
  for (size_t k = 1; k + 1 < p->count; k++) sum += grid_turn(&p->vertex[0], &p->vertex[k], &p->vertex[k + 1]);
  return sum;
}

/* ---- the work ---- */

/* As dyd_arc_sample. */
typedef struct grid_sample {
  const dyd_outline_piece *part, *before;
  uint32_t step, steps;
} grid_sample;

/* bits: of the polygon at work. */
typedef struct grid_work {
  dyd_outline *o;
  const dyd_delaunay *pd;
  uint32_t own;
  int bits;
  dyd_outline_piece *part; /* of the one closed chain */
  size_t parts, part_cap;
  grid_sample *sample;
  grid_polygon polygon;
  size_t samples, sample_cap;
  grid_point goal;
  double window[4];
  dyd_rect rect; /* of the site */
  mpq_t end[2][2], away[2];
  bool fetched;
  bool known; /* no number was in doubt, */
  bool loose; /* but for the last place of a rounding */
} grid_work;

/* ---- rounding ---- */

/* x 2^e. Products with a power of two are exact where none is subnormal. */
static double times_power(double x, int e) {
  union {
    uint64_t bits;
    double power;
  } u = {.bits = (uint64_t)(1023 + e) << 52};
  return -900 < e && e < 900 && (x == 0 || (fabs(x) > 0x1p-100 && fabs(x) < 0x1p100)) ? x * u.power : ldexp(x, e);
}

/* floor(x 2^scale), or, `loose`, the number below where x may be on either side of one; *whole: it is that number. */
static int64_t grid_floor(bool *whole, grid_work *w, dyd_iv x, int scale) {
  double lo = times_power(x.lo, scale), hi = times_power(x.hi, scale), low = floor(lo);
  *whole = lo == hi && lo == low;
  if (!(fabs(lo) < 0x1p50 && fabs(hi) < 0x1p50 && hi - lo <= WIDEST)) return w->known = false, 0;
  if (low != floor(hi) || (lo == low && !*whole)) w->loose = true;
  return (int64_t)low;
}

/* The middle of the cell of the grid 2^-bits in which the coordinate is, on the grid 2^-(bits+1). */
static int64_t grid_end(grid_work *w, const dyd_outline_spot *p, int axis, int bits) {
  bool whole;
  int64_t n = grid_floor(&whole, w, dyd_outline_coordinate(w->o, p, axis), bits);
  return 2 * n + !whole;
}

static double grid_double(int64_t n, int scale) {
  return times_power((double)n, -scale);
}

static int grid_bits(uint64_t n) {
  int bits = 0;
  while (n >> bits) bits++;
  return bits;
}

/* ---- samples ---- */

/* The pieces that are one arc become one part. w->known = false: there are several chains, or open ones. */
static dyd_status grid_chain(grid_work *w) {
  const dyd_outline *o = w->o;
  w->parts = 0;
  if (!o->pieces) return DYD_OK;
  if (!DYD_GROW(w->part, w->part_cap, o->pieces)) return DYD_E_NOMEM;
  size_t start = dyd_outline_start(o, 0), p = start, seen = 0;
  do {
    if (!w->parts || !dyd_outline_smooth(o, o->last[p])) w->part[w->parts++] = o->piece[p];
    w->part[w->parts - 1].end = o->piece[p].end;
    p = o->next[p];
    seen++;
  } while (p != SIZE_MAX && p != start);
  w->known = p == start && seen == o->pieces && !dyd_outline_smooth(o, o->last[start]);
  return DYD_OK;
}

/* As arc_count_steps: n^2 >= (length^2 / q) 2^bits / 8. */
static dyd_status grid_steps(uint32_t *out, grid_work *w, const dyd_outline_piece *p, int bits) {
  *out = 1;
  if (!p->arc || !p->arc->shape.parabola) return DYD_OK;
  int k = p->arc->axis, o = 1 - k, exp[2];
  int64_t length = llabs(grid_end(w, p->begin, k, bits + 4) - grid_end(w, p->end, k, bits + 4));
  if (!w->known || !length) return DYD_OK;
  if (w->loose) length += 2;
  dyd_iv q = dyd_iv_sub(p->arc->shape.s[o], p->arc->shape.q[o]), square = dyd_iv_sqr(dyd_iv_point((double)length));
  if (dyd_iv_sign(q) < 0) q = dyd_iv_neg(q);
  if (!(q.lo > ldexp(1, -bits - DYD_NARROW))) return w->known = false, DYD_OK;
  dyd_iv share = dyd_iv_div(square, q);
  (void)frexp(share.lo, &exp[0]);
  (void)frexp(share.hi, &exp[1]);
  if (!(share.lo > 0 && isfinite(share.hi))) return w->known = false, DYD_OK;
  int twice = exp[0] - 2 * (bits + 5) + bits - 3;
  w->known = twice < 26;
  if (exp[0] == exp[1] && w->known && twice > 0) *out = (uint32_t)1 << ((twice + 1) / 2);
  if (exp[0] == exp[1] || !w->known) return DYD_OK;
  const uint32_t other = w->o->item[p->curve].site,
                 site[2] = {w->o->outer ? other : w->own, w->o->outer ? w->own : other};
  const int end[2] = {p->arc->corner >> o & 1, p->arc->feature & 1};
  return dyd_parabola_steps(out, dyd_delaunay_sites(w->pd), site, end, o, length, bits);
}

static dyd_status grid_samples(grid_work *w) {
  w->samples = 0;
  for (size_t k = 0; k < w->parts && w->known; k++) {
    const dyd_outline_piece *part = &w->part[k], *before = &w->part[k ? k - 1 : w->parts - 1];
    uint32_t steps;
    dyd_status st = grid_steps(&steps, w, part, w->bits + 1);
    if (st != DYD_OK) return st;
    if (w->samples + steps > SAMPLES) w->known = false;
    if (!w->known) return DYD_OK;
    if (!DYD_GROW(w->sample, w->sample_cap, w->samples + steps)) return DYD_E_NOMEM;
    for (uint32_t s = 0; s < steps; s++) w->sample[w->samples++] = (grid_sample){part, s ? part : before, s, steps};
  }
  return DYD_OK;
}

/* As dyd_sample_point: on the grid 2^-(bits+1). */
static grid_point sample_on_grid(grid_work *w, const grid_sample *s, int bits) {
  grid_point z = {.scale = bits + 1};
  const dyd_outline_piece *p = s->part;
  bool whole;
  if (!s->step) {
    for (int a = 0; a < 2; a++) z.at[a] = grid_end(w, p->begin, a, bits);
    return z;
  }
  int k = p->arc->axis, more = grid_bits(s->steps) - 1;
  int64_t from = grid_end(w, p->begin, k, bits), to = grid_end(w, p->end, k, bits);
  int64_t t = from * s->steps + (to - from) * s->step; /* times 2^(bits+1+more) */
  if (llabs(from) >> (GRID - more) || llabs(to) >> (GRID - more)) return w->known = false, z;
  dyd_iv at = dyd_iv_sub(dyd_iv_point(grid_double(t, bits + 1 + more)), dyd_iv_point(w->o->origin[k]));
  dyd_iv other = dyd_iv_add(dyd_outline_arc_other(&p->arc->shape, k, at), dyd_iv_point(w->o->origin[1 - k]));
  z.at[k] = t >> more;
  z.at[1 - k] = grid_floor(&whole, w, other, bits + 1);
  return z;
}

/* ---- proofs ---- */

static dyd_bbox grid_box(const grid_point *z) {
  double x = grid_double(z->at[0], z->scale), y = grid_double(z->at[1], z->scale);
  return (dyd_bbox){{x, x, y, y}};
}

/* dl_a < ds_b at the point? */
static bool grid_nearer(grid_work *w, const dyd_bbox *c, const dyd_box *a, const dyd_box *b) {
  dyd_bbox p = {{a->outer[0], a->outer[1], a->outer[2], a->outer[3]}},
           q = {{b->outer[0], b->outer[1], b->outer[2], b->outer[3]}};
  if (dyd_dl2_upper(c, &p) < dyd_ds2_lower(c, &q)) return true;
  dyd_iv x = dyd_iv_point(c->e[0]), y = dyd_iv_point(c->e[2]);
  dyd_iv d = dyd_filter_distance2(x, y, a, DYD_FARTHEST), e = dyd_filter_distance2(x, y, b, DYD_CLOSEST);
  if (d.hi < e.lo) return true;
  if (!(d.lo > e.hi)) w->known = false;
  return false;
}

/* In Int_i n W? */
static bool grid_inside(grid_work *w, const grid_point *z) {
  const dyd_outline *o = w->o;
  dyd_bbox c = grid_box(z);
  if (!(w->window[0] <= c.e[0] && c.e[1] <= w->window[1] && w->window[2] <= c.e[2] && c.e[3] <= w->window[3]))
    return false;
  for (size_t k = 0; k < o->count; k++)
    if (!grid_nearer(w, &c, &o->item[o->count].box, &o->item[k].box)) return false;
  return true;
}

/* ---- inward ---- */

/* floor(n / d), d > 0. */
static int64_t floor_quotient(dyd_i128 n, dyd_i128 d) {
  dyd_i128 q = n / d;
  return (int64_t)(q - (n % d < 0));
}

/* As find_inner_goal. */
static bool grid_goal(grid_work *w, int fine) {
  dyd_i128 sum[2] = {0, 0};
  for (size_t k = 0; k < w->samples && w->known; k++) {
    grid_point z = sample_on_grid(w, &w->sample[k], fine);
    for (int a = 0; a < 2; a++) sum[a] += z.at[a];
  }
  w->goal.scale = fine;
  for (int a = 0; a < 2; a++) w->goal.at[a] = floor_quotient(sum[a], 2 * (dyd_i128)w->samples);
  return w->known && grid_inside(w, &w->goal);
}

/* As place_inner, with move_by_step in integers. */
static bool grid_place_inner(grid_point *z, grid_work *w, const grid_sample *s, int fine) {
  *z = sample_on_grid(w, s, fine);
  if (!w->known) return false;
  int scale = z->scale > w->goal.scale ? z->scale : w->goal.scale;
  dyd_i128 d[2], sum = 0;
  if (scale - w->goal.scale > 70 || scale - z->scale > 70) return w->known = false;
  for (int a = 0; a < 2; a++) {
    d[a] = w->goal.at[a] * ((dyd_i128)1 << (scale - w->goal.scale)) - z->at[a] * ((dyd_i128)1 << (scale - z->scale));
    sum += d[a] < 0 ? -d[a] : d[a];
  }
  if (sum >> 62) return w->known = false;
  int shift = sum ? grid_bits((uint64_t)sum) - scale + w->bits + 2 : 1;
  if (shift < 1) shift = 1;
  if (scale + shift - fine > 70) return w->known = false;
  for (int a = 0; a < 2; a++) {
    dyd_i128 moved = d[a] + z->at[a] * ((dyd_i128)1 << (scale + shift - z->scale));
    z->at[a] = (int64_t)(moved >> (scale + shift - fine));
  }
  z->scale = fine;
  return grid_inside(w, z);
}

/* ---- outward ---- */

/* The coordinate minus the nearest of the side lo .. hi of the site; *end: which of them, or -1: 0. */
static dyd_iv coordinate_away(int *end, bool *known, double at, const dyd_iv side[2]) {
  dyd_iv z = dyd_iv_point(at);
  *end = dyd_outline_order(&(bool){0}, z, side[0]) < 0 ? 0 : dyd_outline_order(&(bool){0}, z, side[1]) > 0 ? 1 : -1;
  if (*end >= 0) return dyd_iv_sub(z, side[*end]);
  if (!(side[0].hi <= at && at <= side[1].lo)) *known = false;
  return dyd_iv_point(0);
}

/* dyd_log2_length of a point's distances to the ends of the site. */
static int64_t grid_log2_exact(grid_work *w, const grid_point *z, const int end[2]) {
  if (!w->fetched) {
    const dyd_interval *side[2] = {&w->rect.x, &w->rect.y};
    if (dyd_sites_get(&w->rect, dyd_delaunay_sites(w->pd), w->own) != DYD_OK) return w->known = false, 0;
    for (int a = 0; a < 2; a++) dyd_interval_get_q(w->end[a][0], w->end[a][1], side[a]);
    w->fetched = true;
  }
  for (int a = 0; a < 2; a++) {
    mpq_set_d(w->away[a], end[a] < 0 ? 0 : grid_double(z->at[a], z->scale));
    if (end[a] >= 0) mpq_sub(w->away[a], w->away[a], w->end[a][end[a]]);
  }
  return dyd_log2_length(w->away[0], w->away[1]);
}

/* The same in doubles. */
static int64_t grid_log2(bool *known, const dyd_iv away[2]) {
  dyd_iv length = dyd_iv_point(0);
  int exp[2];
  for (int a = 0; a < 2; a++) length = dyd_iv_add(length, away[a].hi < 0 ? dyd_iv_neg(away[a]) : away[a]);
  (void)frexp(length.lo, &exp[0]);
  (void)frexp(length.hi, &exp[1]);
  if (!(length.lo > 0) || exp[0] != exp[1]) *known = false;
  return exp[0];
}

static bool grid_beyond(grid_work *w, const dyd_outline_piece *p, const dyd_bbox *c) {
  return !p->arc || grid_nearer(w, c, &w->o->item[p->curve].box, &w->o->item[w->o->count].box);
}

/* As place_outer. */
static bool grid_place_outer(grid_point *z, grid_work *w, const grid_sample *s, int fine) {
  *z = sample_on_grid(w, s, fine);
  if (!w->known || (!s->part->arc && !s->before->arc)) return w->known;
  const dyd_box *own = &w->o->item[w->o->count].box;
  dyd_iv away[2];
  int end[2];
  for (int a = 0; a < 2; a++)
    away[a] = coordinate_away(&end[a], &w->known, grid_double(z->at[a], z->scale), &own->end[2 * a]);
  bool sure = true;
  int64_t size = grid_log2(&sure, away);
  if (!sure) size = grid_log2_exact(w, z, end);
  if (!w->known || size > 2000 || size < -2000) return w->known = false;
  int shift = (int)size + w->bits + 2;
  for (int a = 0; a < 2; a++) {
    bool whole;
    dyd_iv at = dyd_iv_point(grid_double(z->at[a], z->scale));
    if (end[a] >= 0) at = dyd_iv_add(at, (dyd_iv){times_power(away[a].lo, -shift), times_power(away[a].hi, -shift)});
    z->at[a] = grid_floor(&whole, w, at, fine);
  }
  z->scale = fine;
  dyd_bbox c = grid_box(z);
  return w->known && grid_beyond(w, s->part, &c) && grid_beyond(w, s->before, &c);
}

/* ---- both ---- */

typedef bool (*grid_place)(grid_point *z, grid_work *w, const grid_sample *s, int fine);

static dyd_status grid_place_all(grid_work *w, grid_place place) {
  grid_polygon *p = &w->polygon;
  if (!DYD_GROW(p->vertex, p->cap, 2 * w->samples + 1)) return DYD_E_NOMEM;
  p->count = 0;
  for (size_t k = 0; k < w->samples && w->known; k++) {
    int extra = FIRST_EXTRA;
    while (w->known && !place(&p->vertex[k], w, &w->sample[k], w->bits + extra)) extra *= 2;
    p->count++;
  }
  return DYD_OK;
}

/* ---- the polygons ---- */

static dyd_status grid_deliver(dyd_grid_area *area, dyd_xy **out, size_t *cap, uint32_t *count, const grid_work *w) {
  const grid_polygon *p = &w->polygon;
  if (!dyd_reserve((void **)out, cap, p->count, sizeof **out)) return DYD_E_NOMEM;
  for (size_t k = 0; k < p->count; k++)
    (*out)[k] = (dyd_xy){grid_double(p->vertex[k].at[0], p->vertex[k].scale),
                         grid_double(p->vertex[k].at[1], p->vertex[k].scale)};
  *count = (uint32_t)p->count;
  *area = (dyd_grid_area){grid_area2(p), p->count ? p->vertex[0].scale : 0};
  return DYD_OK;
}

static dyd_status grid_inner(grid_work *w) {
  w->polygon.count = 0;
  if (!w->parts) return DYD_OK;
  dyd_status st = grid_samples(w);
  int extra = FIRST_EXTRA;
  while (st == DYD_OK && w->known && !grid_goal(w, w->bits + extra)) extra *= 2;
  if (st == DYD_OK && w->known) st = grid_place_all(w, grid_place_inner);
  if (st == DYD_OK && w->known) w->known = grid_align(&w->polygon);
  return st == DYD_OK && w->known ? grid_make_convex(&w->polygon) : st;
}

/* As exact_outer_part, and drop_if_clockwise. */
static dyd_status grid_outer(grid_work *w) {
  int bits = w->bits;
  bool simple = false;
  dyd_status st = DYD_OK;
  w->polygon.count = 0;
  for (int extra = 0; w->parts && !simple && w->known && st == DYD_OK; extra += FINER) {
    w->bits = bits + extra;
    st = grid_samples(w);
    if (st == DYD_OK && w->known) st = grid_place_all(w, grid_place_outer);
    if (st != DYD_OK || !w->known) break;
    w->known = grid_align(&w->polygon);
    grid_drop_repeats(&w->polygon);
    simple = w->known && grid_is_simple(&w->polygon);
  }
  w->bits = bits;
  if (w->known && grid_area2(&w->polygon) <= 0) w->polygon.count = 0;
  return st;
}

/* W enlarged as in polygon.c; the window of doubles for points inside. */
static dyd_status grid_shape(bool *done, dyd_shape *s, grid_work *w, const dyd_window *window) {
  dyd_status st = DYD_OK;
  for (int k = 0; k < 4; k++) w->window[k] = window->d[k];
  DYD_LOCAL(dyd_rect, wide);
  st = dyd_window_enlarge(&wide, window->rect, w->bits);
  if (st == DYD_OK) st = dyd_outline_find(w->o, &wide, true);
  if (st == DYD_OK) st = grid_chain(w);
  if (st == DYD_OK && w->known) st = grid_outer(w);
  if (st == DYD_OK && w->known) st = grid_deliver(&s->grid_area[1], &s->outer, &s->outer_cap, &s->outer_count, w);
  if (st == DYD_OK && w->known) st = dyd_outline_find(w->o, window->rect, false);
  if (st == DYD_OK && w->known) st = grid_chain(w);
  if (st != DYD_OK || !w->known) return st;
  for (int k = 0; k < 4; k++) w->known = w->known && w->o->window.end[k].lo == w->o->window.end[k].hi;
  if (w->known) st = grid_inner(w);
  if (st == DYD_OK && w->known) st = grid_deliver(&s->grid_area[0], &s->inner, &s->inner_cap, &s->inner_count, w);
  *done = st == DYD_OK && w->known;
  return st;
}

dyd_status dyd_filter_polygons(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *window,
                               int64_t bits) {
  *done = false;
  if (bits > 900 || bits < -900) return DYD_OK;
  if (!s->outline) s->outline = calloc(1, sizeof *s->outline);
  if (!s->outline) return DYD_E_NOMEM;
  s->outline->cancel = window->cancel;
  s->outline->memory = window->memory;
  grid_work w = {.o = s->outline, .pd = pd, .own = i, .bits = (int)bits, .known = true};
  dyd_rect_init(&w.rect);
  mpq_inits(w.end[0][0], w.end[0][1], w.end[1][0], w.end[1][1], w.away[0], w.away[1], NULL);
  dyd_pair_status least = dyd_least_at(pd, i, window->proved);
  s->outline->pd = least == dyd_least_bounding(pd) ? pd : NULL; /* of some sites only: all may share a vertex */
  dyd_status st = dyd_outline_load(w.o, pd, i, least);
  w.known = !w.o->blind;
  if (st == DYD_OK && w.known) st = grid_shape(done, s, &w, window);
  dyd_free_all(w.part, w.sample, w.polygon.vertex);
  dyd_outline_exact_clear(w.o);
  mpq_clears(w.end[0][0], w.end[0][1], w.end[1][0], w.end[1][1], w.away[0], w.away[1], NULL);
  dyd_rect_clear(&w.rect);
  s->in_doubles = s->on_grid = *done;
  s->loose = w.loose;
  return st;
}
