/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What doubles say surely, against exact numbers: places where a spoke is nearer, directions in which it is beyond,
 * turns of knots, discs and half-planes that are not met. They are drawn next to where the answer changes, of all
 * sizes, most often where squares and products have few digits or none. */
#include <setjmp.h>
#include <stdarg.h>

#include "support/random.h"
#include "tiles/reach_filter.c" /* the checks are static */

#include <cmocka.h>
#include <gmp.h>

/* ---- exact ---- */

/* out += (a - b) * c, or, c NULL, its square. */
static void add_product(mpq_t out, double a, double b, const double *c) {
  mpq_t p, q;
  mpq_inits(p, q, NULL);
  mpq_set_d(p, a);
  mpq_set_d(q, b);
  mpq_sub(p, p, q);
  if (c) mpq_set_d(q, *c);
  mpq_mul(p, p, c ? q : p);
  mpq_add(out, out, p);
  mpq_clears(p, q, NULL);
}

static double nearest_end(double c, double lo, double hi) {
  return c < lo ? lo : c > hi ? hi : c;
}

/* By how much the box is outside of the disc (of squares), or of the half-plane: positive. */
static int sign_outside(const tiles_disc *d, const tiles_box *b) {
  mpq_t most, bound;
  mpq_inits(most, bound, NULL);
  if (d->far) {
    add_product(bound, d->r, 0, &(double){1});
    add_product(most, d->x < 0 ? b->x0 : b->x1, 0, &d->x);
    add_product(most, d->y < 0 ? b->y0 : b->y1, 0, &d->y);
  } else {
    add_product(bound, d->x, nearest_end(d->x, b->x0, b->x1), NULL);
    add_product(bound, d->y, nearest_end(d->y, b->y0, b->y1), NULL);
    add_product(most, d->r, 0, NULL);
  }
  int sign = mpq_cmp(bound, most);
  mpq_clears(most, bound, NULL);
  return sign;
}

static int sign_of_sum(double a, double b, double c) {
  mpq_t sum;
  mpq_init(sum);
  add_product(sum, a, 0, &(double){1});
  add_product(sum, b, 0, &(double){1});
  add_product(sum, c, 0, &(double){1});
  int sign = mpq_sgn(sum);
  mpq_clear(sum);
  return sign;
}

static bool surely_inside(const tiles_disc *d, const tiles_box *b) {
  return sign_of_sum(d->x, -d->r, -b->x0) > 0 && sign_of_sum(d->x, d->r, -b->x1) < 0 &&
         sign_of_sum(d->y, -d->r, -b->y0) > 0 && sign_of_sum(d->y, d->r, -b->y1) < 0;
}

/* ---- numbers ---- */

static double near_to(double x, test_random *r) {
  for (uint64_t k = test_below(r, 3); k > 0; k--) x = nextafter(x, test_chance(r, 2) ? INFINITY : -INFINITY);
  return fmax(-DBL_MAX, fmin(x, DBL_MAX));
}

static double number_draw(test_random *r, int bits) {
  const int spread = test_chance(r, 4) ? 60 : 1;
  double x = ldexp(2 * test_unit(r) - 1, bits + (int)test_between(r, -spread, spread));
  return test_chance(r, 6) || !isfinite(x) ? 0 : x;
}

/* Where products of two such are: anywhere, or where they lose digits, or near the largest. */
static int bits_draw(test_random *r) {
  switch (test_below(r, 4)) {
  case 0:
    return (int)test_between(r, -1074, 1023);
  case 1:
    return (int)test_between(r, -560, -480);
  case 2:
    return (int)test_between(r, 480, 530);
  default:
    return 0;
  }
}

/* ---- checks of the chain ---- */

/* A site, another one, and where they are seen from the corner of the first, as for a chain. */
typedef struct check_case {
  tiles_box own, other;
  tiles_spoke spoke;
  tiles_box from; /* own */
  double far;     /* about how far from one another */
} check_case;

static void check_draw(check_case *c, test_random *r) {
  const int bits = bits_draw(r), away = test_chance(r, 3) ? (int)test_below(r, 60) : 0,
            spread = test_chance(r, 2) ? 0 : 20;
  double end[8];
  for (int k = 0; k < 8; k++) end[k] = ldexp(2 * test_unit(r) - 1, bits - (int)test_below(r, (uint64_t)spread + 1));
  for (int k = 0; k < 2; k++) {
    const double move = test_chance(r, 2) ? ldexp(test_unit(r), bits + away) : 0;
    for (int m = 0; m < 4; m++) end[4 * k + m] = fmax(-DBL_MAX, fmin(end[4 * k + m] + move, DBL_MAX));
    for (int m = 0; m < 4; m += 2)
      if (test_chance(r, 2)) end[4 * k + m + 1] = end[4 * k + m];
  }
  for (int m = 0; m < 8; m += 2)
    if (end[m] > end[m + 1]) {
      double kept = end[m];
      end[m] = end[m + 1];
      end[m + 1] = kept;
    }
  c->own = (tiles_box){end[0], end[1], end[2], end[3]};
  c->other = (tiles_box){end[4], end[5], end[6], end[7]};
  c->from = reach_box(&c->own, c->own.x0, c->own.y0);
  c->spoke = (tiles_spoke){.box = reach_box(&c->other, c->own.x0, c->own.y0)};
  c->far = ldexp(1, bits);
}

/* out = the greatest (most) or least of u.x over the box, its corner o taken off. */
static void extreme_along(mpq_t out, const tiles_box *b, const tiles_box *o, const double u[2], bool most) {
  mpq_set_ui(out, 0, 1);
  add_product(out, (u[0] > 0) == most ? b->x1 : b->x0, o->x0, &u[0]);
  add_product(out, (u[1] > 0) == most ? b->y1 : b->y0, o->y0, &u[1]);
}

static bool is_beyond(const check_case *c, const double u[2]) {
  mpq_t least, most;
  mpq_inits(least, most, NULL);
  extreme_along(least, &c->other, &c->own, u, false);
  extreme_along(most, &c->own, &c->own, u, true);
  const bool beyond = mpq_cmp(least, most) > 0;
  mpq_clears(least, most, NULL);
  return beyond;
}

/* out += the square of the distance from o + x of the nearest, or farthest, place of [lo, hi]. */
static void add_square(mpq_t out, double x, double o, double lo, double hi, bool nearest) {
  mpq_t c, a, b;
  mpq_inits(c, a, b, NULL);
  add_product(c, x, 0, &(double){1});
  add_product(c, o, 0, &(double){1});
  mpq_set_d(a, lo);
  mpq_set_d(b, hi);
  mpq_sub(a, c, a);
  mpq_sub(b, c, b);
  const bool within = mpq_sgn(a) >= 0 && mpq_sgn(b) <= 0;
  mpq_mul(a, a, a);
  mpq_mul(b, b, b);
  if (!(nearest && within)) mpq_add(out, out, (mpq_cmp(a, b) < 0) == nearest ? a : b);
  mpq_clears(c, a, b, NULL);
}

static bool is_nearer(const check_case *c, const double at[2]) {
  mpq_t own, other;
  mpq_inits(own, other, NULL);
  add_square(own, at[0], c->own.x0, c->own.x0, c->own.x1, true);
  add_square(own, at[1], c->own.y0, c->own.y0, c->own.y1, true);
  add_square(other, at[0], c->own.x0, c->other.x0, c->other.x1, false);
  add_square(other, at[1], c->own.y0, c->other.y0, c->other.y1, false);
  const bool nearer = mpq_cmp(other, own) < 0;
  mpq_clears(own, other, NULL);
  return nearer;
}

/* On the way from the site to far beyond the other one, as near as doubles tell to where the answer changes. */
static void at_change(double at[2], const check_case *c, bool (*says)(const check_case *, const double[2]),
                      test_random *r) {
  double turn = 6.3 * test_unit(r), lo = 0, hi = 1;
  const double from[2] = {c->far * cos(turn), c->far * sin(turn)},
               to[2] = {16 * (c->spoke.box.x0 + c->spoke.box.x1) + c->far, 16 * (c->spoke.box.y0 + c->spoke.box.y1)};
  for (int k = 0; k < 64; k++) {
    const double t = (lo + hi) / 2;
    for (int m = 0; m < 2; m++) at[m] = from[m] + t * (to[m] - from[m]);
    *(isfinite(at[0] + at[1]) && says(c, at) ? &hi : &lo) = t;
  }
  for (int m = 0; m < 2; m++) at[m] = near_to(at[m], r);
}

static bool says_beyond(const check_case *c, const double u[2]) {
  return spoke_is_beyond(&c->spoke, &c->from, u[0], u[1]);
}

static bool says_nearer(const check_case *c, const double at[2]) {
  return spoke_is_nearer(&c->spoke, &c->from, at[0], at[1]);
}

static void check_against(const char *name, bool (*says)(const check_case *, const double[2]),
                          bool (*is)(const check_case *, const double[2])) {
  test_random r = test_random_start(name);
  const size_t all = test_cases(30000);
  size_t sure = 0;
  for (size_t k = 0; k < all; k++) {
    check_case c;
    double at[2];
    check_draw(&c, &r);
    at_change(at, &c, test_chance(&r, 16) ? is : says, &r);
    if (!isfinite(at[0] + at[1]) || !says(&c, at)) continue;
    assert_true(is(&c, at));
    sure++;
  }
  fprintf(stderr, "# %zu of %zu are sure\n", sure, all);
  assert_true(20 * sure > all);
}

static void test_nearer(void **state) {
  (void)state;
  check_against("nearer", says_nearer, is_nearer);
}

static void test_beyond(void **state) {
  (void)state;
  check_against("beyond", says_beyond, is_beyond);
}

/* As if it were a point in the middle: lines of rectangles that are wrong, so that all depends on the checks. */
static void spoke_of_middle(tiles_spoke *s, const reach_work *w) {
  s->nx = s->mx = (s->box.x0 + s->box.x1) / 2 - w->cx;
  s->ny = s->my = (s->box.y0 + s->box.y1) / 2 - w->cy;
  s->far = (s->nx * s->nx + s->ny * s->ny) / 2;
}

/* Where two lines meet, and the ends of one: knots that are given are in the regions of their spokes. */
static void test_knots(void **state) {
  (void)state;
  test_random r = test_random_start("knots");
  size_t met = 0, far = 0, ends = 0, all = test_cases(20000);
  for (size_t k = 0; k < all; k++) {
    check_case c[2];
    tiles_knot knot;
    for (int m = 0; m < 2; m++) check_draw(&c[m], &r);
    c[1].own = c[0].own;
    c[1].spoke.box = reach_box(&c[1].other, c[1].own.x0, c[1].own.y0);
    reach_work w = {.own = c[0].from, .cx = c[0].from.x1 / 2, .cy = c[0].from.y1 / 2};
    for (int m = 0; m < 2; m++) spoke_of_middle(&c[m].spoke, &w);
    if (spokes_meet(&knot, &w, &c[0].spoke, &c[1].spoke)) {
      const double at[2] = {knot.x, knot.y};
      for (int m = 0; m < 2; m++) assert_true(knot.far ? is_beyond(&c[m], at) : is_nearer(&c[m], at));
      *(knot.far ? &far : &met) += 1;
    }
    for (int side = -1; side <= 1; side += 2) {
      double u[2];
      if (!spoke_end(u, &w, &c[0].spoke, side)) continue;
      assert_true(is_beyond(&c[0], u));
      ends++;
    }
  }
  fprintf(stderr, "# of %zu pairs, %zu places, %zu directions; %zu ends\n", all, met, far, ends);
  assert_true(100 * met > all && far > 0 && 4 * ends > all);
}

static void test_turns(void **state) {
  (void)state;
  test_random r = test_random_start("turns");
  const size_t all = test_cases(100000);
  size_t sure = 0;
  for (size_t k = 0; k < all; k++) {
    const int bits = bits_draw(&r);
    reach_work w = {.cx = fabs(number_draw(&r, bits)), .cy = fabs(number_draw(&r, bits))};
    tiles_knot a = {number_draw(&r, bits), number_draw(&r, bits), test_chance(&r, 2)};
    const double x = a.far ? a.x : a.x - w.cx, y = a.far ? a.y : a.y - w.cy,
                 t = ldexp(2 * test_unit(&r) - 1, (int)test_below(&r, 40) - 20);
    tiles_knot b = {near_to(x * t, &r), near_to(y * t, &r), test_chance(&r, 2)};
    if (!b.far) b.x += w.cx, b.y += w.cy;
    if (test_chance(&r, 3)) b = (tiles_knot){number_draw(&r, bits), number_draw(&r, bits), test_chance(&r, 2)};
    if (!isfinite(b.x + b.y) || !knots_turn(&w, &a, &b)) continue;
    mpq_t ax, by;
    mpq_t ay, bx;
    mpq_inits(ax, ay, bx, by, NULL);
    add_product(ax, a.x, a.far ? 0 : w.cx, &(double){1});
    add_product(ay, a.y, a.far ? 0 : w.cy, &(double){1});
    add_product(bx, b.x, b.far ? 0 : w.cx, &(double){1});
    add_product(by, b.y, b.far ? 0 : w.cy, &(double){1});
    mpq_mul(ax, ax, by);
    mpq_mul(ay, ay, bx);
    assert_true(mpq_cmp(ax, ay) > 0);
    mpq_clears(ax, ay, bx, by, NULL);
    sure++;
  }
  fprintf(stderr, "# %zu of %zu are sure\n", sure, all);
  assert_true(8 * sure > all);
}

/* ---- discs ---- */

/* A box whose rim about touches the disc. */
static tiles_box box_beside(const tiles_disc *d, test_random *r, int bits) {
  const double turn = test_chance(r, 3) ? 1.5707963267948966 * (double)test_below(r, 4) : 6.3 * test_unit(r);
  double at[2] = {d->x + d->r * cos(turn), d->y + d->r * sin(turn)}, square = d->x * d->x + d->y * d->y;
  if (d->far) at[0] = d->x * d->r / square, at[1] = d->y * d->r / square;
  if (test_chance(r, 8) || !isfinite(at[0] + at[1])) at[0] = number_draw(r, bits), at[1] = number_draw(r, bits);
  double x = near_to(at[0], r), y = near_to(at[1], r), w = fabs(number_draw(r, bits)), h = fabs(number_draw(r, bits));
  if (test_chance(r, 2)) w = h = 0;
  tiles_box b = {x, x, y, y};
  if (test_chance(r, 2)) b.x0 = fmax(x - w, -DBL_MAX);
  if (test_chance(r, 2)) b.x1 = fmin(x + w, DBL_MAX);
  if (test_chance(r, 2)) b.y0 = fmax(y - h, -DBL_MAX);
  if (test_chance(r, 2)) b.y1 = fmin(y + h, DBL_MAX);
  return b;
}

/* Points reported outside are outside, points reported inside are inside; most random points get a report. */
static void test_discs(void **state) {
  (void)state;
  test_random r = test_random_start("discs");
  size_t out = 0, in = 0, tried = test_cases(100000);
  const double large = nextafter(0x1p512, 0);
  for (size_t k = 0; k < tried; k++) {
    const int bits = bits_draw(&r);
    tiles_disc d = {number_draw(&r, bits), number_draw(&r, bits), number_draw(&r, bits), test_chance(&r, 3)};
    if (d.far && test_chance(&r, 2)) d.r = near_to(d.r * (d.x + d.y), &r);
    if (!d.far) d.r = fabs(d.r);
    tiles_box box = box_beside(&d, &r, bits);
    if (test_chance(&r, 16)) { /* squares next to the largest double */
      const double turn = 6.3 * test_unit(&r), cx = test_unit(&r) * large, cy = test_unit(&r) * large;
      const double x = cx + large * cos(turn), y = cy + large * sin(turn);
      d = (tiles_disc){cx, cy, large, 0};
      box = (tiles_box){x, x, y, y};
    }
    if (!isfinite(d.r)) continue;
    if (!tiles_disc_may_meet(&d, &box)) {
      assert_true(sign_outside(&d, &box) > 0);
      out++;
    }
    if (test_chance(&r, 2))
      box = (tiles_box){d.x - d.r, near_to(d.x + d.r, &r), near_to(d.y - d.r, &r), near_to(d.y + d.r, &r)};
    if (test_chance(&r, 2)) box = tiles_box_wider(&box, 1, test_unit(&r) * 0x1p-40);
    if (tiles_disc_is_inside(&d, &box)) {
      assert_true(!d.far && surely_inside(&d, &box));
      in++;
    }
  }
  fprintf(stderr, "# of %zu, %zu outside, %zu inside\n", tried, out, in);
  assert_true(10 * out > tried && 100 * in > tried);
}

/* The square of the least radius about (x, y) that holds the box. */
static void farthest_square(mpq_t out, const double c[2], const tiles_box *b) {
  const double end[2][2] = {{b->x0, b->x1}, {b->y0, b->y1}};
  mpq_set_ui(out, 0, 1);
  for (int k = 0; k < 2; k++) {
    mpq_t one, other;
    mpq_inits(one, other, NULL);
    add_product(one, c[k], end[k][0], NULL);
    add_product(other, c[k], end[k][1], NULL);
    mpq_add(out, out, mpq_cmp(one, other) > 0 ? one : other);
    mpq_clears(one, other, NULL);
  }
}

/* Wherever in its two intervals between doubles the witness is, the disc about it is in the disc requested. */
static void test_witness_discs(void **state) {
  (void)state;
  test_random r = test_random_start("witness discs");
  for (size_t k = 0; k < test_cases(20000); k++) {
    const int bits = (int)(test_chance(&r, 2) ? test_between(&r, -1074, 900) : test_between(&r, -600, -400));
    const double c[2] = {number_draw(&r, bits), number_draw(&r, bits)};
    tiles_box box[2];
    for (int i = 0; i < 2; i++)
      box[i] = box_beside(&(tiles_disc){c[0], c[1], fabs(number_draw(&r, bits)), 0}, &r, bits);
    const tiles_disc d = tiles_witness_disc(c, &box[0], &box[1]);
    if (d.r == INFINITY) continue;
    for (int side = 0; side < 4; side++) {
      double at[2] = {c[0], c[1]};
      mpq_t far, room, off;
      mpq_inits(far, room, off, NULL);
      if (side & 1) at[0] = nextafter(c[0], INFINITY);
      if (side & 2) at[1] = nextafter(c[1], INFINITY);
      mpq_set_d(room, d.r);
      for (int i = 0; i < 2; i++) {
        mpq_set_ui(off, 0, 1);
        add_product(off, at[i], c[i], &(double){1});
        mpq_sub(room, room, off);
      }
      assert_true(mpq_sgn(room) >= 0);
      mpq_mul(room, room, room);
      for (int i = 0; i < 2; i++) {
        farthest_square(far, at, &box[i]);
        assert_true(mpq_cmp(far, room) <= 0);
      }
      mpq_clears(far, room, off, NULL);
    }
  }
}

/* The half-plane of a direction holds the whole site. */
static void test_half_planes(void **state) {
  (void)state;
  test_random r = test_random_start("half-planes");
  for (size_t k = 0; k < test_cases(30000); k++) {
    const int bits = test_chance(&r, 3) ? bits_draw(&r) : 0;
    const tiles_knot u = {number_draw(&r, bits), number_draw(&r, bits), true};
    const tiles_box box = box_beside(&(tiles_disc){number_draw(&r, 0), number_draw(&r, 0), 1, 0}, &r, 0);
    const tiles_disc d = knot_disc(&u, &box);
    mpq_t least, bound, few;
    if (!isfinite(d.r)) continue;
    mpq_inits(least, bound, few, NULL);
    extreme_along(least, &box, &(tiles_box){0, 0, 0, 0}, (double[2]){u.x, u.y}, false);
    mpq_set_d(bound, d.r);
    mpq_set_d(few, TINY); /* tiles_disc_score allows for that */
    mpq_add(least, least, few);
    assert_true(mpq_cmp(bound, least) <= 0);
    mpq_clears(least, bound, few, NULL);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_nearer),     cmocka_unit_test(test_beyond),
                                     cmocka_unit_test(test_knots),      cmocka_unit_test(test_turns),
                                     cmocka_unit_test(test_discs),      cmocka_unit_test(test_witness_discs),
                                     cmocka_unit_test(test_half_planes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
