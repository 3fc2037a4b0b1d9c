/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Generators: every kind aims at one way of going wrong (mathematics: section 10). */
#include "oracle/oracle_gen.h"
#include <string.h>

static size_t how_many(test_random *r, size_t most) {
  size_t a = (size_t)test_between(r, 3, (int64_t)most), b = (size_t)test_between(r, 3, (int64_t)most);
  return a < b ? a : b;
}

/* A rectangle with its lower corner in [0,grid]^2 and sides of at most wide, tall. */
static void add_random(orc_case *c, test_random *r, long grid, long wide, long tall, unsigned long den) {
  long x = (long)test_between(r, 0, grid), y = (long)test_between(r, 0, grid);
  orc_case_add(c, x, x + (long)test_between(r, 0, wide), y, y + (long)test_between(r, 0, tall), den);
}

static void general(orc_case *c, test_random *r, size_t n) {
  long grid = (long)test_between(r, 3, 40), side = (long)test_between(r, 0, grid / 2);
  for (size_t i = 0; i < n; i++) add_random(c, r, grid, side, side, 1);
}

static void thin(orc_case *c, test_random *r, size_t n) {
  unsigned bits = (unsigned)test_between(r, 1, 40);
  for (size_t i = 0; i < n; i++) add_random(c, r, (long)20 << bits, 3, 3, 1ul << bits);
}

static void overlapping(orc_case *c, test_random *r, size_t n) {
  for (size_t i = 0; i < n; i++) add_random(c, r, 8, 12, 12, 2);
}

static void nested(orc_case *c, test_random *r, size_t n) {
  long a = 0, b = 64, d = 0, e = 64;
  for (size_t i = 0; i < n; i++) {
    if (test_chance(r, 3))
      add_random(c, r, 90, 10, 10, 1);
    else
      orc_case_add(c, a, b, d, e, 1);
    if (test_chance(r, 4)) continue;
    a = (long)test_between(r, a, b), b = (long)test_between(r, a, b);
    d = (long)test_between(r, d, e), e = (long)test_between(r, d, e);
  }
}

static void touching(orc_case *c, test_random *r, size_t n) {
  for (size_t i = 0; i < n; i++) {
    long x = (long)test_below(r, 4), y = (long)test_below(r, 4);
    orc_case_add(c, x, x + (long)test_below(r, 2), y, y + (long)test_below(r, 2), 1);
  }
}

static void lattice(orc_case *c, test_random *r, size_t n) {
  long grid = (long)test_between(r, 2, 4);
  for (size_t i = 0; i < n; i++) add_random(c, r, grid, 0, 0, 1);
}

static void strips(orc_case *c, test_random *r, size_t n) {
  for (size_t i = 0; i < n; i++) {
    bool flat = test_chance(r, 2);
    add_random(c, r, 20, flat ? 30 : 1, flat ? 1 : 30, 2);
  }
}

static void mixed_sizes(orc_case *c, test_random *r, size_t n) {
  for (size_t i = 0; i < n; i++) {
    long side = test_chance(r, 3) ? 12 : 0;
    add_random(c, r, 20, side, side, 1);
  }
}

static void rationals(orc_case *c, test_random *r, size_t n) {
  static const unsigned long den[4] = {10, 3, 7, 4};
  for (size_t i = 0; i < n; i++) {
    unsigned long d = den[test_below(r, 4)];
    long side = d == 4 ? (long)test_below(r, 4) : 0;
    add_random(c, r, 2 * (long)d, side, side, d);
    if (!test_chance(r, 4)) continue;
    mpq_set_si(c->rect[i].e[0], (long)test_between(r, -1, 1), 1);
    mpq_set_si(c->rect[i].e[1], (long)test_between(r, 1, 2), 1);
  }
}

static void duplicates(orc_case *c, test_random *r, size_t n) {
  for (size_t i = 0; i < n; i++) {
    long side = test_chance(r, 2) ? 3 : 0;
    if (i && test_chance(r, 2))
      orc_case_add_rect(c, &c->rect[test_below(r, c->n)]);
    else
      add_random(c, r, 10, side, side, 1);
  }
}

/* Integer points of x^2 + y^2 = 65 or 1105; some fattened by one unit of 2^-bits. */
static void cocircular(orc_case *c, test_random *r, size_t n) {
  static const long small[2][2] = {{1, 8}, {4, 7}};
  static const long big[4][2] = {{4, 33}, {9, 32}, {12, 31}, {23, 24}};
  bool large = test_chance(r, 2);
  unsigned bits = (unsigned)test_between(r, 0, 30);
  for (size_t i = 0; i < n; i++) {
    const long *v = large ? big[test_below(r, 4)] : small[test_below(r, 2)];
    bool swap = test_chance(r, 2);
    long x = (test_chance(r, 2) ? -1 : 1) * v[swap] * (1L << bits);
    long y = (test_chance(r, 2) ? -1 : 1) * v[!swap] * (1L << bits);
    long wide = test_chance(r, 6), tall = test_chance(r, 6), off = test_chance(r, 10);
    if (test_chance(r, 8)) x = y = 0;
    orc_case_add(c, x - off, x - off + wide, y, y + tall, 1ul << bits);
  }
}

static void collinear(orc_case *c, test_random *r, size_t n) {
  long a = (long)test_between(r, -3, 3), b = (long)test_between(r, -3, 3);
  for (size_t i = 0; i < n; i++) {
    long t = (long)test_between(r, 0, 24), wide = 3 * test_chance(r, 5), tall = 3 * test_chance(r, 5);
    orc_case_add(c, 2 * a * t, 2 * a * t + wide, 2 * b * t, 2 * b * t + tall, 1);
  }
}

/* Every side at a scale of its own. */
static void mixed_scales(orc_case *c, test_random *r, size_t n) {
  long span = test_chance(r, 3) ? 1000 : 30;
  for (size_t i = 0; i < n; i++) {
    add_random(c, r, 8, 2, 2, 1);
    orc_case one;
    orc_case_init(&one);
    orc_case_add_rect(&one, &c->rect[c->n - 1]);
    orc_case_scale(&one, (long)test_between(r, -span, span));
    c->n--;
    orc_case_add_rect(c, &one.rect[0]);
    orc_case_clear(&one);
  }
}

/* Nearly cocircular or collinear: a lattice moved by multiples of 2^-50. */
static void near_ties(orc_case *c, test_random *r, size_t n) {
  long unit = 1L << (long)test_between(r, 8, 50);
  for (size_t i = 0; i < n; i++) {
    long x = (long)test_below(r, 4) * unit + (long)test_between(r, -2, 2);
    long y = (long)test_below(r, 4) * unit + (long)test_between(r, -2, 2);
    orc_case_add(c, x, x + (long)test_below(r, 3), y, y + (long)test_below(r, 3), (unsigned long)unit);
  }
}

/* Disjoint cells of a grid, partly filled. */
static void separated(orc_case *c, test_random *r, size_t n) {
  for (size_t i = 0; i < n; i++) {
    long x = 16 * (long)test_below(r, 5), y = 16 * (long)test_below(r, 5), side = (long)test_below(r, 12);
    orc_case_add(c, x, x + (long)test_below(r, (uint64_t)side + 1), y, y + side, 1);
  }
}

/* A plus of crossing strips, a ring of points around, the like. */
static void crossing(orc_case *c, test_random *r, size_t n) {
  for (size_t i = 0; i < n; i++) {
    long reach = (long)test_between(r, 1, 10), t = (long)test_between(r, 0, 1);
    if (test_chance(r, 4))
      orc_case_add(c, -reach, reach, -t, t, 1);
    else if (test_chance(r, 3))
      orc_case_add(c, -t, t, -reach, reach, 1);
    else
      add_random(c, r, 12, t, t, 1);
  }
}

/* Two rectangles whose bisector runs between a side of one and a side of the other, and small ones about. */
static void diagonal(orc_case *c, test_random *r, size_t n) {
  long w = (long)test_between(r, 2, 12), h = (long)test_between(r, 2, 12), gap = (long)test_between(r, 1, 8);
  orc_case_add(c, w + gap, w + gap + (long)test_between(r, 0, 8), 0, h, 1);
  orc_case_add(c, 0, w, h + (long)test_between(r, 1, 8), h + 20, 1);
  while (c->n < n) {
    bool near = test_chance(r, 2);
    long x = (long)test_between(r, near ? 0 : -30, w + gap + 20), y = (long)test_between(r, near ? 0 : -30, h + 20);
    orc_case_add(c, x, x + (long)test_below(r, 3), y, y + (long)test_below(r, 3), 1);
  }
}

void orc_generate(orc_case *out, test_random *r, size_t kind, size_t most) {
  static void (*const make[ORC_KINDS])(orc_case *, test_random *, size_t) = {
      general,    thin,       overlapping, nested,       touching,  lattice,   strips,   mixed_sizes, rationals,
      duplicates, cocircular, collinear,   mixed_scales, near_ties, separated, crossing, diagonal};
  static const char *const name[ORC_KINDS] = {"general",    "thin",      "overlapping",  "nested",    "touching",
                                              "lattice",    "strips",    "mixed_sizes",  "rationals", "duplicates",
                                              "cocircular", "collinear", "mixed_scales", "near_ties", "separated",
                                              "crossing",   "diagonal"};
  out->n = 0;
  strcpy(out->kind, name[kind]);
  make[kind](out, r, how_many(r, most));
  orc_case_turn(out, (unsigned)test_below(r, 8));
  if (test_chance(r, 6)) orc_case_scale(out, (long)test_between(r, -1000, 1000));
}

/* ---- choices ---- */

static void choose_side(mpq_t *out, test_random *r, const mpq_t *e, unsigned bits) {
  uint64_t top = (uint64_t)1 << bits, t = test_below(r, top + 1);
  if (test_chance(r, 3)) t = test_chance(r, 2) ? 0 : top;
  mpq_sub(out[0], e[1], e[0]);
  mpq_set_ui(out[1], t, 1);
  mpq_mul(out[0], out[0], out[1]);
  mpq_div_2exp(out[0], out[0], bits);
  mpq_add(out[0], out[0], e[0]);
  mpq_set(out[1], out[0]);
}

void orc_choose(orc_case *out, test_random *r, const orc_case *c, unsigned bits) {
  out->n = c->n;
  memcpy(out->kind, c->kind, sizeof out->kind);
  for (size_t i = 0; i < c->n; i++)
    for (size_t axis = 0; axis < 2; axis++) choose_side(&out->rect[i].e[2 * axis], r, &c->rect[i].e[2 * axis], bits);
}

/* end := a dyadic near target + (end - target) k / 8 that is between the target and the end, if it is. */
static void move_end(mpq_t end, test_random *r, const mpq_t target) {
  mpq_t d, f;
  mpq_inits(d, f, NULL);
  mpq_set_si(f, (long)test_between(r, 0, 7), 8);
  mpq_canonicalize(f);
  mpq_sub(d, end, target);
  mpq_mul(d, d, f);
  mpq_add(d, d, target);
  if (mpz_popcount(mpq_denref(d)) != 1) {
    mpq_mul_2exp(d, d, 20);
    mpz_fdiv_q(mpq_numref(d), mpq_numref(d), mpq_denref(d));
    mpz_set_ui(mpq_denref(d), 1);
    mpq_div_2exp(d, d, 20);
  }
  if (mpq_cmp(d, target) * mpq_cmp(d, end) <= 0) mpq_set(end, d);
  mpq_clears(d, f, NULL);
}

void orc_narrow(orc_rect *rect, test_random *r, const orc_rect *target, bool final) {
  for (size_t k = 0; k < 4; k++) {
    if (final)
      mpq_set(rect->e[k], target->e[k]);
    else if (test_chance(r, 2) && !mpq_equal(rect->e[k & 2], rect->e[(k & 2) + 1]))
      move_end(rect->e[k], r, target->e[k]);
  }
}
