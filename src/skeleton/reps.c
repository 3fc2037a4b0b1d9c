/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Choosing representatives; all conversions between doubles and exact points happen here. */
#include "skeleton/reps.h"

#include "base/alloc.h"
#include "base/float_filter.h"
#include "base/local.h"
#include "base/parallel.h"
#include "rect/rect.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Biased randomised insertion order along a Hilbert curve, by table and radix sort.
 *
 * Nothing here is a statement: the doubles only choose an order, any order gives the same statuses. */

enum {
  RADIX_BITS = 11,
  RADIX = 1 << RADIX_BITS,
  PASSES = 3,
  SAMPLE = 16,
  LEVELS = 2,
  COLUMNS = 1 << 16,
  STRIP_BIT = 29,
  FEW = 64 /* sites: for so few, a table and counts of digits cost more than they save */
};

/* A strip has at least this many sites. The armed build divides every second set of sites, however small. */
#ifdef DYD_ARMED
#define STRIP_LEAST(n) ((n) % 2 ? 4 : 1 << 16)
#else
#define STRIP_LEAST(n) (1 << 16)
#endif

/* step[state][x 4 bits, y 4 bits] = 8 bits of the curve | next state << 8. */
typedef struct hilbert_table {
  uint16_t step[4][256];
} hilbert_table;

/* Walks along the curve by the lowest `bits` bits of both coordinates, highest first; returns the bits of the curve. */
static uint32_t hilbert_walk(unsigned *state, uint32_t x, uint32_t y, int bits) {
  static const uint8_t order[4][4] = {{0, 1, 3, 2}, {0, 3, 1, 2}, {2, 1, 3, 0}, {2, 3, 1, 0}};
  static const uint8_t next[4][4] = {{1, 0, 3, 0}, {0, 2, 1, 1}, {2, 1, 2, 3}, {3, 3, 0, 2}};
  uint32_t key = 0;
  for (int b = bits - 1; b >= 0; b--) {
    unsigned quadrant = (x >> b & 1) << 1 | (y >> b & 1);
    key = key << 2 | order[*state][quadrant];
    *state = next[*state][quadrant];
  }
  return key;
}

static void fill_table(hilbert_table *h) {
  for (unsigned state = 0; state < 4; state++)
    for (unsigned cell = 0; cell < 256; cell++) {
      unsigned s = state, key = hilbert_walk(&s, cell >> 4, cell & 15, 4);
      h->step[state][cell] = (uint16_t)(key | s << 8);
    }
}

/* 28 bits of the curve from 16-bit coordinates; h: NULL for few sites. */
static uint32_t hilbert_key(const hilbert_table *h, uint32_t x, uint32_t y) {
  unsigned state = 0;
  uint32_t key = 0;
  if (!h) return hilbert_walk(&state, x, y, 16) >> 4;
  for (int b = 12; b >= 0; b -= 4) {
    unsigned e = h->step[state][(x >> b & 15) << 4 | (y >> b & 15)];
    key = key << 8 | (e & 255);
    state = e >> 8;
  }
  return key >> 4;
}

/* The nearest finite double. */
static double clamp(double x) {
  return x > DBL_MAX ? DBL_MAX : x < -DBL_MAX ? -DBL_MAX : x;
}

/* Half of the middle of the outward rectangle, so that nothing overflows. */
static double half_middle(const dyd_sites *s, int axis, size_t i) {
  return clamp(dyd_sites_lo(s, axis, i)) / 4 + clamp(dyd_sites_hi(s, axis, i)) / 4;
}

typedef struct unit_frame {
  double origin[2], scale;
} unit_frame;

static unit_frame frame_of(const dyd_sites *s) {
  double lo[2] = {DBL_MAX, DBL_MAX}, hi[2] = {-DBL_MAX, -DBL_MAX}, extent = 0;
  for (int a = 0; a < 2; a++) {
    for (size_t i = 0; i < s->count; i++) {
      double m = half_middle(s, a, i);
      if (m < lo[a]) lo[a] = m;
      if (m > hi[a]) hi[a] = m;
    }
    if (hi[a] - lo[a] > extent) extent = hi[a] - lo[a];
  }
  unit_frame f = {{lo[0], lo[1]}, extent > 0 ? 65535.0 / extent : 0};
  if (!(f.scale <= DBL_MAX)) f.scale = 0;
  return f;
}

static unsigned level_of(uint32_t i) {
  uint32_t hash = (i * UINT32_C(2654435761)) >> 8;
  unsigned level = LEVELS;
  for (; level && hash % SAMPLE == 0; hash /= SAMPLE) level--;
  return level;
}

/* What the key of a site is made of. shift: 0, or as many low bits of the curve as the strip number takes. */
typedef struct keys {
  const dyd_sites *sites;
  unit_frame f;
  const hilbert_table *h; /* NULL, as count: few sites */
  bool mixed;
  unsigned strips, shift;
  uint32_t *column; /* the strip of each column of the frame; NULL: one strip */
  uint32_t members[DYD_STRIPS];
  uint64_t *a;
  size_t (*count)[RADIX];
} keys;

static uint32_t order_place(const keys *k, int axis, size_t i) {
  return (uint32_t)((half_middle(k->sites, axis, i) - k->f.origin[axis]) * k->f.scale);
}

static uint32_t order_key(const keys *k, uint32_t i) {
  uint32_t x = order_place(k, 0, i), y = order_place(k, 1, i), fat = k->mixed && !dyd_site_is_point(k->sites, i);
  uint32_t key = (fat << 30 | (uint32_t)level_of(i) << 28 | hilbert_key(k->h, x, y)) >> k->shift;
  return k->column ? key | k->column[x] << STRIP_BIT : key;
}

/* ---- strips ---- */

static unsigned strips_for(size_t n) {
  size_t count = n / STRIP_LEAST(n);
  return count < 2 ? 1 : count > DYD_STRIPS ? DYD_STRIPS : (unsigned)count;
}

/* Columns with about the same number of sites, judged by a sample; a column is never divided. */
static void share_columns(keys *k) {
  size_t n = k->sites->count, step = n / COLUMNS + 1, sample = (n + step - 1) / step, seen = 0;
  for (size_t i = 0; i < n; i += step) k->column[order_place(k, 0, i)]++;
  for (size_t c = 0; c < COLUMNS; c++) {
    size_t here = k->column[c], strip = (seen + here / 2) * k->strips / sample;
    k->column[c] = strip < k->strips ? (uint32_t)strip : k->strips - 1;
    seen += here;
  }
}

static void set_strips(dyd_strips *out, const keys *k) {
  *out = (dyd_strips){.count = k->strips};
  for (unsigned s = 0; s < k->strips; s++) out->begin[s + 1] = out->begin[s] + k->members[s];
}

/* ---- sorting ---- */

static void radix_sort(uint64_t *a, uint64_t *b, size_t n, size_t count[PASSES][RADIX]) {
  for (int p = 0; p < PASSES; p++) {
    size_t sum = 0;
    for (int r = 0; r < RADIX; r++) {
      size_t c = count[p][r];
      count[p][r] = sum;
      sum += c;
    }
    int shift = 32 + RADIX_BITS * p;
    for (size_t i = 0; i < n; i++) b[count[p][a[i] >> shift & (RADIX - 1)]++] = a[i];
    uint64_t *t = a;
    a = b;
    b = t;
  }
}

/* All differ, so that every way to sort them has the same result. */
static void sort_few(uint64_t *a, size_t n) {
  for (size_t i = 1; i < n; i++) {
    uint64_t key = a[i];
    size_t at = i;
    for (; at && a[at - 1] > key; at--) a[at] = a[at - 1];
    a[at] = key;
  }
}

static void keys_of_range(void *context, size_t number, size_t begin, size_t end) {
  const keys *k = context;
  (void)number;
  for (size_t i = begin; i < end; i++) k->a[i] = (uint64_t)order_key(k, (uint32_t)i) << 32 | i;
}

static void count_keys(keys *k) {
  for (size_t i = 0; i < k->sites->count; i++) {
    uint32_t key = (uint32_t)(k->a[i] >> 32);
    k->members[k->column ? key >> STRIP_BIT : 0]++;
    for (int p = 0; p < PASSES && k->count; p++) k->count[p][key >> (RADIX_BITS * p) & (RADIX - 1)]++;
  }
}

/* a in order of keys; b: scratch, where the result is unless sites are few. */
static const uint64_t *sorted_keys(keys *k, hilbert_table *h, uint64_t *b, unsigned threads) {
  size_t n = k->sites->count;
  k->f = frame_of(k->sites);
  k->mixed = !dyd_sites_are_double_points(k->sites);
  if (k->count) fill_table(h);
  if (k->column) share_columns(k);
  dyd_parallel_ranges(threads, n, keys_of_range, k);
  count_keys(k);
  if (k->count)
    radix_sort(k->a, b, n, k->count); /* an odd number of passes ends in b */
  else
    sort_few(k->a, n);
  return k->count ? b : k->a;
}

dyd_status dyd_spatial_order(uint32_t *order, dyd_strips *strips, const dyd_sites *s, unsigned threads) {
  size_t n = s->count;
  hilbert_table h;
  bool few = n <= FEW;
  keys k = {.sites = s, .h = few ? NULL : &h, .strips = strips_for(n)};
  k.a = dyd_alloc(n, sizeof *k.a);
  uint64_t *b = few ? NULL : dyd_alloc(n, sizeof *b);
  if (!few) k.count = calloc(PASSES, sizeof *k.count);
  if (k.strips > 1) k.column = calloc(COLUMNS, sizeof *k.column);
  k.shift = k.strips > 1 ? 31 - STRIP_BIT : 0;
  dyd_status st = k.a && (few || (b && k.count)) && (k.strips == 1 || k.column) ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) {
    const uint64_t *key = sorted_keys(&k, &h, b, threads);
    for (size_t i = 0; i < n; i++) order[i] = (uint32_t)key[i];
    set_strips(strips, &k);
  }
  dyd_free_all(k.column, k.count, b, k.a);
  return st;
}

/* f = num / 2^bits, 0 < f < 1: the van der Corput sequence (bits of m mirrored behind the point), m >= 1.
 * m -> f is injective, so different m give different points. */
typedef struct binary_fraction {
  uint64_t num;
  unsigned bits;
} binary_fraction;

static binary_fraction mirrored(uint64_t m) {
  binary_fraction f = {0, 0};
  for (; m; m >>= 1, f.bits++) f.num = f.num << 1 | (m & 1);
  return f;
}

/* The fractions of x and y differ for k > 0, so that the points leave the diagonals and the centre lines. */
static binary_fraction fraction_of(uint32_t k, int axis) {
  return mirrored(axis == 0 ? (uint64_t)k + 1 : 2 * (uint64_t)k + 1);
}

/* lo + f (hi - lo), exactly; a rational point stays itself. */
static dyd_status at_fraction(dyd_interval *a, binary_fraction f) {
  if (dyd_interval_is_point(a)) return DYD_OK;
  DYD_LOCAL(dyd_dyadic, d, t);
  mpz_set_ui(t.man, 1);
  mpz_set_ui(d.man, (unsigned long)f.num);
  dyd_status st = dyd_dyadic_set_z_2exp(&t, d.man, -(int64_t)f.bits);
  if (st == DYD_OK) st = dyd_dyadic_sub(&d, &a->hi, &a->lo);
  if (st == DYD_OK) st = dyd_dyadic_mul(&d, &d, &t);
  if (st == DYD_OK) st = dyd_dyadic_add(&d, &d, &a->lo);
  if (st == DYD_OK) dyd_interval_set_over(a, &d, a->den);
  return st;
}

static dyd_status exact_fraction(dyd_rect *out, const dyd_reps *r, uint32_t v, uint32_t k) {
  dyd_status st = dyd_sites_get(out, r->sites, r->site[v]);
  for (int axis = 0; axis < 2 && st == DYD_OK; axis++) st = at_fraction(axis ? &out->y : &out->x, fraction_of(k, axis));
  return st;
}

dyd_status dyd_reps_get(dyd_rect *out, const dyd_reps *r, uint32_t v) {
  if (!dyd_reps_is_double(r, v)) return exact_fraction(out, r, v, r->code[v] - 1);
  return dyd_rect_set_d(out, r->xy[v].x, r->xy[v].x, r->xy[v].y, r->xy[v].y);
}

/* Middle of two doubles without overflow; lies between them. */
static double reps_middle(double lo, double hi) {
  return dyd_nearest_in(lo / 2 + hi / 2, lo, hi);
}

/* A bound of the error of the nearest (clamped) double to a point in [lo,hi], adjacent doubles or equal. */
static double spread(double lo, double hi) {
  return hi > DBL_MAX || lo < -DBL_MAX ? INFINITY : hi - lo;
}

static dyd_status keep_code(dyd_reps *r, uint32_t v, uint32_t code) {
  if (!r->code && code && !DYD_ZEROED(r->code, r->n ? r->n : 1)) return DYD_E_NOMEM;
  if (r->code && r->code[v] != code) r->code[v] = code; /* most stay 0: their pages are never there */
  return DYD_OK;
}

static dyd_status choose_exact(dyd_reps *r, uint32_t v, uint32_t k) {
  DYD_LOCAL(dyd_rect, q);
  double lo[2], hi[2];
  dyd_status st = exact_fraction(&q, r, v, k);
  if (st == DYD_OK) st = keep_code(r, v, k + 1);
  if (st == DYD_OK) {
    dyd_interval_get_d(&lo[0], &hi[0], &q.x);
    dyd_interval_get_d(&lo[1], &hi[1], &q.y);
    r->xy[v] = (dyd_xy){clamp(lo[0]), clamp(lo[1])};
    for (int a = 0; a < 2; a++) r->delta = fmax(r->delta, spread(lo[a], hi[a]));
    if (r->delta == 0 && lo[0] == hi[0] && lo[1] == hi[1]) st = keep_code(r, v, 0);
  }
  return st;
}

/* Sets *inside to whether the double point p is inside the exact rectangle of v. */
static dyd_status holds(bool *inside, const dyd_reps *r, uint32_t v, dyd_xy p) {
  DYD_LOCAL(dyd_rect, box, point);
  dyd_status st = dyd_sites_get(&box, r->sites, r->site[v]);
  if (st == DYD_OK) st = dyd_rect_set_d(&point, p.x, p.x, p.y, p.y);
  if (st == DYD_OK) *inside = dyd_rect_contains(&box, &point);
  return st;
}

dyd_status dyd_reps_stay(bool *stays, const dyd_reps *r, uint32_t v) {
  *stays = false;
  return dyd_reps_is_double(r, v) ? holds(stays, r, v, r->xy[v]) : DYD_OK;
}

/* An exact point that is not a double: the table has the doubles next to it. They are what choose_exact would find. */
static dyd_status choose_point(dyd_reps *r, uint32_t v, uint32_t k, const double b[4]) {
  dyd_status st = keep_code(r, v, k + 1);
  if (st != DYD_OK) return st;
  r->xy[v] = (dyd_xy){clamp(b[0]), clamp(b[2])};
  for (int a = 0; a < 4; a += 2) r->delta = fmax(r->delta, spread(b[a], b[a + 1]));
  return DYD_OK;
}

/* b: the outward box of the site. */
static dyd_status choose_in(dyd_reps *r, uint32_t v, uint32_t k, const double b[4]) {
  const dyd_sites *s = r->sites;
  bool inside = dyd_sites_in_doubles(s, r->site[v]);
  if (!inside && (b[0] < b[1] || b[2] < b[3]) && dyd_site_is_point(s, r->site[v])) return choose_point(r, v, k, b);
  if (k == 0) {
    dyd_xy p = {reps_middle(b[0], b[1]), reps_middle(b[2], b[3])};
    if (!inside && isfinite(b[0]) && isfinite(b[1]) && isfinite(b[2]) && isfinite(b[3])) {
      dyd_status st = holds(&inside, r, v, p);
      if (st != DYD_OK) return st;
    }
    if (inside) {
      r->xy[v] = p;
      return keep_code(r, v, 0);
    }
  }
  return choose_exact(r, v, k);
}

dyd_status dyd_reps_choose(dyd_reps *r, uint32_t v, uint32_t k) {
  double b[4];
  dyd_sites_get_d(b, r->sites, r->site[v]);
  return choose_in(r, v, k, b);
}

/* ---- all of them ---- */

enum { FETCH_AHEAD = 24 };

/* box: NULL, or of each vertex: the table of sites is read once for both. Of each range: delta, status. */
typedef struct choice {
  dyd_reps *r;
  dyd_bbox *box;
  double delta[DYD_RANGES_MOST];
  dyd_status status[DYD_RANGES_MOST];
} choice;

static void choose_points(dyd_reps *r, size_t begin, size_t end) {
  const dyd_sites *s = r->sites;
  for (size_t v = begin; v < end; v++) {
    if (v + FETCH_AHEAD < end) dyd_sites_fetch(s, r->site[v + FETCH_AHEAD]);
    r->xy[v] = (dyd_xy){s->lower[0][r->site[v]], s->lower[1][r->site[v]]};
  }
}

static void look_up_boxes(dyd_bbox *box, const dyd_reps *r, size_t begin, size_t end) {
  for (size_t v = begin; v < end; v++) {
    if (v + FETCH_AHEAD < end) dyd_sites_fetch(r->sites, r->site[v + FETCH_AHEAD]);
    dyd_sites_get_d(box[v].e, r->sites, r->site[v]);
  }
}

static void choose_middles(dyd_xy *xy, const dyd_bbox *box, size_t begin, size_t end) {
  for (size_t v = begin; v < end; v++)
    xy[v] = (dyd_xy){reps_middle(box[v].e[0], box[v].e[1]), reps_middle(box[v].e[2], box[v].e[3])};
}

static dyd_status choose_any(dyd_reps *r, const dyd_bbox *box, size_t begin, size_t end) {
  dyd_status st = DYD_OK;
  for (size_t v = begin; v < end && st == DYD_OK; v++) {
    if (v + FETCH_AHEAD < end) dyd_sites_fetch_entry(r->sites, r->site[v + FETCH_AHEAD]);
    if (v + FETCH_AHEAD / 2 < end) dyd_sites_fetch_exact(r->sites, r->site[v + FETCH_AHEAD / 2]);
    st = box ? choose_in(r, (uint32_t)v, 0, box[v].e) : dyd_reps_choose(r, (uint32_t)v, 0);
  }
  return st;
}

static void choose_part_of_reps(void *context, size_t number, size_t begin, size_t end) {
  choice *c = context;
  dyd_reps part = *c->r; /* the same arrays */
  if (c->box) look_up_boxes(c->box, &part, begin, end);
  if (dyd_sites_are_double_points(part.sites))
    choose_points(&part, begin, end);
  else if (c->box && dyd_sites_all_in_doubles(part.sites))
    choose_middles(part.xy, c->box, begin, end);
  else
    c->status[number] = choose_any(&part, c->box, begin, end);
  c->delta[number] = part.delta;
}

dyd_status dyd_reps_init(dyd_reps *r, dyd_bbox *box, const dyd_sites *sites, uint32_t *site, uint32_t n,
                         unsigned threads) {
  choice c = {.r = r, .box = box};
  dyd_status st = DYD_OK;
  *r = (dyd_reps){.sites = sites, .n = n, .site = site};
  if (!DYD_NEW(r->xy, (size_t)n + 1)) return DYD_E_NOMEM;
  r->xy[n] = (dyd_xy){NAN, NAN};
  if (!dyd_sites_all_in_doubles(sites) && !DYD_ZEROED(r->code, (size_t)n + 1)) return DYD_E_NOMEM;
  size_t ranges = dyd_parallel_ranges(threads, r->n, choose_part_of_reps, &c);
  for (size_t k = 0; k < ranges; k++) {
    r->delta = fmax(r->delta, c.delta[k]);
    if (st == DYD_OK) st = c.status[k];
  }
  if (r->delta == 0) { /* every representative is its double point */
    free(r->code);
    r->code = NULL;
  }
  return st;
}

void dyd_reps_clear(dyd_reps *r) {
  dyd_free_all(r->site, r->xy, r->code);
  memset(r, 0, sizeof *r);
}
