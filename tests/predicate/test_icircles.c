/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Critical circles [CRIT-1] against the literal oracle, and their comparisons and enclosures. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "predicate/circle.h"
#include "predicate/shapes.h"

enum { ROOM = 8 };

typedef struct workspace {
  dyd_irect r[3];
  dyd_icircle found[ROOM];
  dyd_circle circle;
  oracle_circle expected[ROOM];
  mpz_t one;
} workspace;

static void workspace_init(workspace *w) {
  for (int k = 0; k < 3; k++) dyd_irect_init(&w->r[k]);
  for (int k = 0; k < ROOM; k++) dyd_icircle_init(&w->found[k]), oracle_circle_init(&w->expected[k]);
  dyd_circle_init(&w->circle);
  mpz_init_set_ui(w->one, 1);
}

static void workspace_clear(workspace *w) {
  mpz_clear(w->one);
  dyd_circle_clear(&w->circle);
  for (int k = 0; k < ROOM; k++) oracle_circle_clear(&w->expected[k]), dyd_icircle_clear(&w->found[k]);
  for (int k = 0; k < 3; k++) dyd_irect_clear(&w->r[k]);
}

static void random_labels(dyd_touch out[3], test_random *r) {
  unsigned mask = 1 + (unsigned)test_below(r, 6);
  for (int k = 0; k < 3; k++) out[k] = mask >> k & 1 ? DYD_FARTHEST : DYD_CLOSEST;
}

static size_t find(workspace *w, const small_rect s[3], const dyd_touch touch[3]) {
  const dyd_irect *r[3] = {&w->r[0], &w->r[1], &w->r[2]};
  for (int k = 0; k < 3; k++) small_irect(&w->r[k], &s[k]);
  return dyd_icircles(w->found, ROOM, r, touch);
}

/* The same set of centres. */
static void compare_sets(workspace *w, size_t found, size_t expected) {
  assert_int_equal(found, expected);
  assert_true(found <= 4);
  for (size_t i = 0; i < found; i++) {
    dyd_circle_unscale(&w->circle, &w->found[i], w->one, 0);
    size_t matches = 0;
    for (size_t j = 0; j < expected; j++) matches += oracle_same_centre(&w->expected[j], &w->circle);
    assert_int_equal(matches, 1);
  }
}

/* Pairwise disjoint: no continuum of circles. */
static void test_oracle(void **state) {
  (void)state;
  test_random r = test_random_start("critical circles");
  workspace w;
  workspace_init(&w);
  size_t seen[5] = {0};
  for (size_t n = test_cases(700); n > 0;) {
    small_rect s[3];
    dyd_touch touch[3];
    int grid = test_chance(&r, 2) ? 3 : 9;
    for (int k = 0; k < 3; k++) s[k] = random_small(&r, grid);
    if (small_meets(&s[0], &s[1]) || small_meets(&s[1], &s[2]) || small_meets(&s[2], &s[0])) continue;
    random_labels(touch, &r);
    size_t expected = oracle_circles(w.expected, ROOM, s, touch), found = find(&w, s, touch);
    compare_sets(&w, found, expected);
    if (oracle_orientation(&s[0], &s[1], &s[2])) assert_int_equal(found, 1);
    seen[found]++;
    n--;
  }
  assert_true(seen[0] && seen[1] && seen[2]);
  workspace_clear(&w);
}

static bool share_corner(const small_rect *a, const small_rect *b) {
  bool x = false, y = false;
  for (int k = 0; k < 4; k++) {
    x = x || a->end[k & 1] == b->end[k >> 1];
    y = y || a->end[2 + (k & 1)] == b->end[2 + (k >> 1)];
  }
  return x && y;
}

/* Returns true if a continuum of circles may exist. Only when C-rectangles meet, or a corner of an F-rectangle is one
 * of another.
 */
static bool may_be_infinite(const small_rect s[3], const dyd_touch touch[3]) {
  for (int k = 0; k < 3; k++) {
    const small_rect *a = &s[k], *b = &s[(k + 1) % 3];
    bool far = touch[k] == DYD_FARTHEST || touch[(k + 1) % 3] == DYD_FARTHEST;
    if (far ? share_corner(a, b) : small_meets(a, b)) return true;
  }
  return false;
}

/* An F-rectangle may lie across the others: still the same circles. */
static void test_overlapping(void **state) {
  (void)state;
  test_random r = test_random_start("critical circles, F across C");
  workspace w;
  workspace_init(&w);
  for (size_t n = test_cases(700); n > 0;) {
    small_rect s[3];
    dyd_touch touch[3];
    for (int k = 0; k < 3; k++) s[k] = random_small(&r, 4);
    random_labels(touch, &r);
    if (may_be_infinite(s, touch)) continue;
    size_t expected = oracle_circles(w.expected, ROOM, s, touch);
    compare_sets(&w, find(&w, s, touch), expected);
    n--;
  }
  workspace_clear(&w);
}

/* Two crossing lines, one of them through the corner itself: a circle on each side of a segment. */
static void test_both_diagonals(void **state) {
  (void)state;
  workspace w;
  workspace_init(&w);
  const small_rect s[3] = {{{2, 2, 0, 3}}, {{-1, 5, 4, 4}}, {{2, 2, 2, 2}}};
  const dyd_touch touch[3] = {DYD_CLOSEST, DYD_CLOSEST, DYD_FARTHEST};
  size_t expected = oracle_circles(w.expected, ROOM, s, touch);
  assert_int_equal(expected, 2);
  compare_sets(&w, find(&w, s, touch), expected);
  small_rect turned[3];
  for (int k = 0; k < 3; k++) turned[k] = turn_small(&s[k]);
  expected = oracle_circles(w.expected, ROOM, turned, touch);
  compare_sets(&w, find(&w, turned, touch), expected);
  workspace_clear(&w);
}

/* Any rectangles, nested and equal ones too: whatever is stated is a circle as asked for. */
static void test_sides(void **state) {
  (void)state;
  test_random r = test_random_start("critical circles of overlapping rectangles");
  workspace w;
  workspace_init(&w);
  for (size_t n = test_cases(20000); n > 0; n--) {
    small_rect s[3];
    dyd_touch touch[3];
    for (int k = 0; k < 3; k++)
      s[k] = test_chance(&r, 6) && k ? s[k - 1] : random_small(&r, test_chance(&r, 2) ? 2 : 12);
    random_labels(touch, &r);
    size_t found = find(&w, s, touch);
    for (size_t i = 0; i < found; i++) {
      for (int k = 0; k < 3; k++) assert_int_equal(dyd_icircle_side(&w.found[i], &w.r[k], touch[k]), 0);
      dyd_rect rect;
      dyd_rect_init(&rect);
      dyd_circle_unscale(&w.circle, &w.found[i], w.one, 0);
      for (int k = 0; k < 3; k++) {
        small_rect_get(&rect, &s[k]);
        assert_int_equal(dyd_circle_side(&w.circle, &rect, touch[k]), 0);
        for (int far = 0; far < 2; far++) { /* two ways to the same sign */
          dyd_touch t = far ? DYD_FARTHEST : DYD_CLOSEST;
          assert_int_equal(dyd_circle_side(&w.circle, &rect, t), dyd_icircle_side(&w.found[i], &w.r[k], t));
        }
      }
      dyd_rect_clear(&rect);
    }
  }
  workspace_clear(&w);
}

/* r * 2^shift + (2^shift / 3 rounded down, -2^shift): the same circles, far from the origin. */
static void move(dyd_irect *r, unsigned long shift) {
  mpz_t t;
  mpz_init(t);
  mpz_ui_pow_ui(t, 2, shift);
  mpz_ptr end[4] = {r->x0, r->x1, r->y0, r->y1};
  for (int k = 0; k < 4; k++) mpz_mul(end[k], end[k], t);
  for (int k = 2; k < 4; k++) mpz_sub(end[k], end[k], t);
  mpz_tdiv_q_ui(t, t, 3);
  for (int k = 0; k < 2; k++) mpz_add(end[k], end[k], t);
  mpz_clear(t);
}

static void test_moved(void **state) {
  (void)state;
  test_random r = test_random_start("critical circles moved and scaled");
  workspace w;
  dyd_icircle moved[ROOM];
  workspace_init(&w);
  for (int k = 0; k < ROOM; k++) dyd_icircle_init(&moved[k]);
  for (size_t n = test_cases(3000); n > 0; n--) {
    small_rect s[3];
    dyd_touch touch[3];
    const dyd_irect *in[3] = {&w.r[0], &w.r[1], &w.r[2]};
    for (int k = 0; k < 3; k++) s[k] = random_small(&r, 9);
    random_labels(touch, &r);
    size_t found = find(&w, s, touch);
    unsigned long shift = (unsigned long)test_below(&r, 4) * 700 + (unsigned long)test_below(&r, 90);
    for (int k = 0; k < 3; k++) move(&w.r[k], shift);
    assert_int_equal(dyd_icircles(moved, ROOM, in, touch), found);
    for (size_t i = 0; i < found; i++) {
      for (int k = 0; k < 3; k++) assert_int_equal(dyd_icircle_side(&moved[i], &w.r[k], touch[k]), 0);
    }
  }
  for (int k = 0; k < ROOM; k++) dyd_icircle_clear(&moved[k]);
  workspace_clear(&w);
}

/* The enclosure contains the centre, a few units in the last place wide: checked with exact comparisons against
 * degenerate "circles" at its ends. */
static void check_enclosure(const dyd_icircle *k, int64_t shift) {
  double box[4];
  dyd_icircle_centre_d(box, k, shift);
  for (int axis = 0; axis < 2; axis++) {
    for (int end = 0; end < 2; end++) {
      double d = box[2 * axis + end];
      assert_true(isfinite(d));
      dyd_dyadic x;
      dyd_icircle at;
      dyd_dyadic_init(&x);
      dyd_icircle_init(&at);
      assert_int_equal(dyd_dyadic_set_d(&x, d), DYD_OK);
      mpz_ptr a = axis ? at.ay : at.ax;
      int64_t exp = x.exp + shift;
      mpz_set(a, x.man);
      if (exp > 0) mpz_mul_2exp(a, a, (mp_bitcnt_t)exp);
      if (exp < 0) mpz_mul_2exp(at.d, at.d, (mp_bitcnt_t)-exp);
      int order = dyd_icircle_compare(k, &at, axis);
      assert_true(end ? order <= 0 : order >= 0);
      dyd_icircle_clear(&at);
      dyd_dyadic_clear(&x);
    }
    double lo = box[2 * axis], hi = box[2 * axis + 1];
    assert_true(hi <= nextafter(nextafter(lo, HUGE_VAL), HUGE_VAL));
  }
}

static void test_enclosure(void **state) {
  (void)state;
  test_random r = test_random_start("centres in doubles");
  workspace w;
  workspace_init(&w);
  for (size_t n = test_cases(3000); n > 0; n--) {
    small_rect s[3];
    dyd_touch touch[3];
    for (int k = 0; k < 3; k++) s[k] = random_small(&r, 20);
    random_labels(touch, &r);
    size_t found = find(&w, s, touch);
    for (size_t i = 0; i < found; i++) {
      check_enclosure(&w.found[i], test_between(&r, -40, 40));
      for (size_t j = 0; j < found; j++) {
        for (int axis = 0; axis < 2; axis++) {
          int order = dyd_icircle_compare(&w.found[i], &w.found[j], axis);
          assert_int_equal(order, -dyd_icircle_compare(&w.found[j], &w.found[i], axis));
          if (i == j) assert_int_equal(order, 0);
        }
      }
    }
  }
  workspace_clear(&w);
}

/* Cancelling parts: 665857 - 470832 sqrt 2 is about 7.5e-7. */
static void test_cancellation(void **state) {
  (void)state;
  dyd_icircle k;
  dyd_icircle_init(&k);
  mpz_set_si(k.ax, 665857), mpz_set_si(k.bx, -470832);
  mpz_set_si(k.ay, -3), mpz_set_si(k.by, 1);
  mpz_set_ui(k.c, 2);
  check_enclosure(&k, 0);
  mpz_mul_2exp(k.ax, k.ax, 400), mpz_mul_2exp(k.bx, k.bx, 400);
  check_enclosure(&k, 0);
  mpz_set_ui(k.ax, 0), mpz_set_ui(k.bx, 1); /* sqrt(2^142 + 1), just above a double */
  mpz_set_ui(k.c, 1);
  mpz_mul_2exp(k.c, k.c, 142);
  mpz_add_ui(k.c, k.c, 1);
  check_enclosure(&k, 0);
  mpz_set_si(k.bx, -1);
  check_enclosure(&k, 0);
  mpz_set_ui(k.c, 4), mpz_set_si(k.ax, 6), mpz_set_si(k.bx, -3); /* exactly 0 */
  check_enclosure(&k, 7);
  dyd_icircle_clear(&k);
}

static void test_public(void **state) {
  (void)state;
  test_random r = test_random_start("public critical circles");
  workspace w;
  dyd_rect rect[3];
  const dyd_rect *in[3] = {&rect[0], &rect[1], &rect[2]};
  workspace_init(&w);
  for (int k = 0; k < 3; k++) dyd_rect_init(&rect[k]);
  for (size_t n = test_cases(300); n > 0; n--) {
    small_rect s[3];
    dyd_touch touch[3];
    for (int k = 0; k < 3; k++) {
      s[k] = random_small(&r, 9);
      small_rect_get(&rect[k], &s[k]);
    }
    random_labels(touch, &r);
    bool known = oracle_orientation(&s[0], &s[1], &s[2]) != DYD_UNSURE;
    assert_int_equal(dyd_critical_circle(&w.circle, in, touch), known ? DYD_OK : DYD_E_ARG);
    if (!known) continue;
    assert_int_equal(oracle_circles(w.expected, ROOM, s, touch), 1);
    assert_true(oracle_same_centre(&w.expected[0], &w.circle));
    small_rect other = random_small(&r, 9);
    dyd_rect o;
    dyd_rect_init(&o);
    small_rect_get(&o, &other);
    for (int far = 0; far < 2; far++) {
      dyd_touch t = far ? DYD_FARTHEST : DYD_CLOSEST;
      assert_int_equal(dyd_circle_side(&w.circle, &o, t), oracle_side(&w.expected[0], &other, t));
    }
    dyd_rect_clear(&o);
    for (int k = 0; k < 3; k++) touch[k] = DYD_CLOSEST;
    assert_int_equal(dyd_critical_circle(&w.circle, in, touch), DYD_E_ARG);
  }
  for (int k = 0; k < 3; k++) dyd_rect_clear(&rect[k]);
  workspace_clear(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_oracle),         cmocka_unit_test(test_overlapping),
                                     cmocka_unit_test(test_both_diagonals), cmocka_unit_test(test_sides),
                                     cmocka_unit_test(test_moved),          cmocka_unit_test(test_enclosure),
                                     cmocka_unit_test(test_cancellation),   cmocka_unit_test(test_public)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
