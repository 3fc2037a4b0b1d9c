/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Biased randomised insertion order along a Hilbert curve, by table and radix sort.
 *
 * Nothing here is a statement: the doubles only choose an order, any order gives the same statuses. */
#include "skeleton/order.h"

#include "base/alloc.h"
#include "base/parallel.h"

#include <float.h>
#include <string.h>

enum {
  RADIX_BITS = 11,
  RADIX = 1 << RADIX_BITS,
  PASSES = 3,
  SAMPLE = 16,
  LEVELS = 2,
  COLUMNS = 1 << 16,
  STRIP_BIT = 29
};

/* A strip has at least so many sites. The armed build divides every second set of sites, however small. */
#ifdef DYD_ARMED
#define STRIP_LEAST(n) ((n) % 2 ? 4 : 1 << 16)
#else
#define STRIP_LEAST(n) (1 << 16)
#endif

/* step[state][x 4 bits, y 4 bits] = 8 bits of the curve | next state << 8. */
typedef struct hilbert_table {
  uint16_t step[4][256];
} hilbert_table;

static void fill_table(hilbert_table *h) {
  static const uint8_t order[4][4] = {{0, 1, 3, 2}, {0, 3, 1, 2}, {2, 1, 3, 0}, {2, 3, 1, 0}};
  static const uint8_t next[4][4] = {{1, 0, 3, 0}, {0, 2, 1, 1}, {2, 1, 2, 3}, {3, 3, 0, 2}};
  for (unsigned state = 0; state < 4; state++)
    for (unsigned cell = 0; cell < 256; cell++) {
      unsigned s = state, key = 0;
      for (int b = 3; b >= 0; b--) {
        unsigned quadrant = (cell >> 4 >> b & 1) << 1 | (cell >> b & 1);
        key = key << 2 | order[s][quadrant];
        s = next[s][quadrant];
      }
      h->step[state][cell] = (uint16_t)(key | s << 8);
    }
}

/* 28 bits of the curve from 16-bit coordinates. */
static uint32_t hilbert_key(const hilbert_table *h, uint32_t x, uint32_t y) {
  unsigned state = 0;
  uint32_t key = 0;
  for (int b = 12; b >= 0; b -= 4) {
    unsigned e = h->step[state][(x >> b & 15) << 4 | (y >> b & 15)];
    key = key << 8 | (e & 255);
    state = e >> 8;
  }
  return key >> 4;
}

static double clamp(double x) {
  return x > DBL_MAX ? DBL_MAX : x < -DBL_MAX ? -DBL_MAX : x;
}

/* Half of the middle of the outward rectangle, so that nothing overflows. */
static double half_middle(const dyd_sites *s, int axis, size_t i) {
  return clamp(dyd_sites_lo(s, axis, i)) / 4 + clamp(dyd_sites_hi(s, axis, i)) / 4;
}

typedef struct frame {
  double origin[2], scale;
} frame;

static frame frame_of(const dyd_sites *s) {
  double lo[2] = {DBL_MAX, DBL_MAX}, hi[2] = {-DBL_MAX, -DBL_MAX}, extent = 0;
  for (int a = 0; a < 2; a++) {
    for (size_t i = 0; i < s->count; i++) {
      double m = half_middle(s, a, i);
      if (m < lo[a]) lo[a] = m;
      if (m > hi[a]) hi[a] = m;
    }
    if (hi[a] - lo[a] > extent) extent = hi[a] - lo[a];
  }
  frame f = {{lo[0], lo[1]}, extent > 0 ? 65535.0 / extent : 0};
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
  frame f;
  hilbert_table h;
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
  uint32_t x = order_place(k, 0, i), y = order_place(k, 1, i), fat = k->mixed && !dyd_sites_is_point(k->sites, i);
  uint32_t key = (fat << 30 | (uint32_t)level_of(i) << 28 | hilbert_key(&k->h, x, y)) >> k->shift;
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

static void keys_of_range(void *context, size_t number) {
  const keys *k = context;
  size_t n = k->sites->count;
  for (size_t i = dyd_range_begin(n, number); i < dyd_range_begin(n, number + 1); i++)
    k->a[i] = (uint64_t)order_key(k, (uint32_t)i) << 32 | i;
}

static void count_keys(keys *k) {
  for (size_t i = 0; i < k->sites->count; i++) {
    uint32_t key = (uint32_t)(k->a[i] >> 32);
    k->members[k->column ? key >> STRIP_BIT : 0]++;
    for (int p = 0; p < PASSES; p++) k->count[p][key >> (RADIX_BITS * p) & (RADIX - 1)]++;
  }
}

dyd_status dyd_spatial_order(uint32_t *order, dyd_strips *strips, const dyd_sites *s, unsigned threads) {
  size_t n = s->count;
  uint64_t *b = dyd_alloc(n, sizeof *b);
  keys k = {.sites = s, .strips = strips_for(n), .a = dyd_alloc(n, sizeof *k.a)};
  k.count = calloc(PASSES, sizeof *k.count);
  if (k.strips > 1) k.column = calloc(COLUMNS, sizeof *k.column);
  k.shift = k.strips > 1 ? 31 - STRIP_BIT : 0;
  dyd_status st = k.a && b && k.count && (k.strips == 1 || k.column) ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) {
    k.f = frame_of(s);
    k.mixed = !dyd_sites_are_double_points(s);
    fill_table(&k.h);
    if (k.column) share_columns(&k);
    dyd_parallel(threads, dyd_ranges(n), keys_of_range, &k);
    count_keys(&k);
    radix_sort(k.a, b, n, k.count);
    for (size_t i = 0; i < n; i++) order[i] = (uint32_t)b[i]; /* an odd number of passes ends in b */
    set_strips(strips, &k);
  }
  free(k.column);
  free(k.count);
  free(b);
  free(k.a);
  return st;
}
