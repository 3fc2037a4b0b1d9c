/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The tools of the skeleton against brute force: tree of boxes, spatial order, common scale [FLT-DST] [FLT-DIR]
 * [FLT-SCALE]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/read_case.h"
#include "rect/rect.h"
#include "skeleton/rects_filter.h"
#include "skeleton/reps.h"
#include "skeleton/skeleton.h"
#include "skeleton/work.h"
#include <cmocka.h>
#include <math.h>
#include <string.h>

static test_random shared;

/* ---- tree ---- */

enum { MOST = 700 };

/* Which vertices were visited; stops after `left` visits. */
typedef struct visits {
  unsigned char times[MOST];
  size_t count, left;
} visits;

static bool note(void *context, uint32_t v) {
  visits *n = context;
  n->times[v]++;
  n->count++;
  return n->count < n->left;
}

static double coordinate(void) {
  double x = test_chance(&shared, 3) ? (double)test_between(&shared, -8, 8) : test_unit(&shared) * 16 - 8;
  return test_chance(&shared, 20) ? ldexp(x, (int)test_between(&shared, -600, 600)) : x;
}

static void random_box(dyd_bbox *b) {
  for (int a = 0; a < 2; a++) {
    double w = test_chance(&shared, 2) ? 0 : test_unit(&shared);
    if (test_chance(&shared, 30)) w = 16;
    b->e[2 * a] = coordinate();
    b->e[2 * a + 1] = b->e[2 * a] + w;
    if (test_chance(&shared, 200)) b->e[2 * a] = -INFINITY;
    if (test_chance(&shared, 200)) b->e[2 * a + 1] = INFINITY;
  }
}

/* ds(c,b)^2 <= r2, exactly; all finite. */
static bool within(const double c[2], const dyd_bbox *b, double r2) {
  mpq_t sum, d, e;
  mpq_inits(sum, d, e, NULL);
  for (int a = 0; a < 2; a++) {
    double near = fmin(fmax(c[a], b->e[2 * a]), b->e[2 * a + 1]);
    mpq_set_d(d, near);
    mpq_set_d(e, c[a]);
    mpq_sub(d, d, e);
    mpq_mul(d, d, d);
    mpq_add(sum, sum, d);
  }
  mpq_set_d(d, r2);
  bool good = mpq_cmp(sum, d) <= 0;
  mpq_clears(sum, d, e, NULL);
  return good;
}

/* max over b of u.x >= h, exactly; infinite ends reach everything they point to. */
static bool reaches(const double u[2], const dyd_bbox *b, double h) {
  mpq_t sum, d, e;
  bool all = false;
  mpq_inits(sum, d, e, NULL);
  for (int a = 0; a < 2; a++) {
    double x = b->e[2 * a + (u[a] > 0)];
    if (!isfinite(x)) {
      all = all || u[a] != 0;
      continue;
    }
    mpq_set_d(d, x);
    mpq_set_d(e, u[a]);
    mpq_mul(d, d, e);
    mpq_add(sum, sum, d);
  }
  mpq_set_d(d, h);
  bool good = all || mpq_cmp(sum, d) >= 0;
  mpq_clears(sum, d, e, NULL);
  return good;
}

static void ask_near(const dyd_tree *t) {
  visits got = {.left = SIZE_MAX}, cut = {.left = 3};
  double c[2] = {coordinate(), coordinate()}, r2 = test_chance(&shared, 4) ? 0 : 20 * test_unit(&shared);
  dyd_bbox at = {{c[0], c[0], c[1], c[1]}};
  dyd_tree_near(t, &at, &r2, note, &got);
  for (uint32_t q = 0; q < t->count; q++) {
    uint32_t v = t->item[q];
    bool want = !(dyd_ds2_lower(&at, &t->box[v]) > r2);
    assert_int_equal(got.times[v], want);
    if (within(c, &t->box[v], r2)) assert_int_equal(got.times[v], 1);
  }
  dyd_tree_near(t, &at, &r2, note, &cut);
  assert_int_equal(cut.count, got.count < 3 ? got.count : 3);
}

static void ask_beyond(const dyd_tree *t) {
  visits got = {.left = SIZE_MAX}, cut = {.left = 2};
  double u[2] = {(double)test_between(&shared, -4, 4), test_unit(&shared) * 8 - 4}, h = coordinate() * 4;
  if (test_chance(&shared, 3)) u[1] = (double)test_between(&shared, -4, 4), h = (double)test_between(&shared, -60, 60);
  if (!isfinite(h)) return;
  dyd_tree_beyond(t, u[0], u[1], &h, note, &got);
  for (uint32_t q = 0; q < t->count; q++) {
    const dyd_bbox *b = &t->box[t->item[q]];
    double size = 0;
    for (int e = 0; e < 4; e++) size = fmax(size, fabs(b->e[e]));
    if (reaches(u, b, h)) assert_int_equal(got.times[t->item[q]], 1);
    if (isfinite(size) && !reaches(u, b, h - size * 0x1p-44 - 0x1p-900)) assert_int_equal(got.times[t->item[q]], 0);
  }
  dyd_tree_beyond(t, u[0], u[1], &h, note, &cut);
  assert_int_equal(cut.count, got.count < 2 ? got.count : 2);
}

/* Some boxes shrink; after their refresh the nodes are those of a tree made anew. */
static void shrink_boxes(dyd_tree *t, dyd_bbox *box) {
  for (int k = 0; k < 9 && t->count; k++) {
    uint32_t q = (uint32_t)test_below(&shared, t->count), v = t->item[q];
    for (int a = 0; a < 2; a++) {
      if (isfinite(box[v].e[2 * a]))
        box[v].e[2 * a + 1] = box[v].e[2 * a];
      else if (isfinite(box[v].e[2 * a + 1]))
        box[v].e[2 * a] = box[v].e[2 * a + 1];
    }
    assert_int_equal(dyd_tree_entry(t, v), q);
    dyd_tree_refresh(t, q);
  }
  dyd_tree other;
  uint32_t *item = malloc((t->count ? t->count : 1) * sizeof *item);
  assert_non_null(item);
  memcpy(item, t->item, t->count * sizeof *item);
  assert_int_equal(dyd_tree_init(&other, item, t->count, box), DYD_OK);
  assert_memory_equal(t->node, other.node, t->level[t->levels] * sizeof *t->node);
  dyd_tree_clear(&other);
}

static void test_tree(void **state) {
  (void)state;
  static const uint32_t sizes[] = {0, 1, 2, 7, 8, 9, 63, 64, 65, 511, 513, MOST};
  static dyd_bbox box[MOST];
  for (size_t k = test_cases(48); k; k--) {
    dyd_tree t;
    uint32_t n = sizes[k % 12], count = 0, *item = malloc(MOST * sizeof *item);
    assert_non_null(item);
    for (uint32_t v = 0; v < MOST; v++) random_box(&box[v]);
    uint32_t skip = n < MOST / 2 ? 2 : 0;
    for (uint32_t v = 0; v < MOST && count < n; v++)
      if (!skip || test_chance(&shared, skip)) item[count++] = v;
    assert_int_equal(dyd_tree_init(&t, item, count, box), DYD_OK);
    for (int q = 0; q < 6; q++) {
      ask_near(&t);
      ask_beyond(&t);
      if (q & 1) shrink_boxes(&t, box);
    }
    dyd_tree_clear(&t);
  }
}

/* ---- order ---- */

static void add_any(dyd_sites *s) {
  double x = coordinate(), y = coordinate(), x1 = x + 1, y1 = y + 1;
  dyd_rect r;
  dyd_rect_init(&r);
  unsigned kind = (unsigned)test_below(&shared, 6);
  if (kind == 0) {
    assert_int_equal(dyd_dyadic_set_si_2exp(&r.x.lo, -1, 3000), DYD_OK);
    assert_int_equal(dyd_dyadic_set_si_2exp(&r.x.hi, 1, 3001), DYD_OK);
    assert_int_equal(dyd_sites_add_rect(s, &r), DYD_OK);
  } else if (kind == 1)
    assert_int_equal(dyd_sites_add_boxes(s, 1, &x, &x1, &y, &y1), DYD_OK);
  else
    assert_int_equal(dyd_sites_add_points(s, 1, &x, &y), DYD_OK);
  dyd_rect_clear(&r);
}

static void test_order(void **state) {
  (void)state;
  for (size_t n = 0; n < 400; n = n < 5 ? n + 1 : n * 3) {
    dyd_sites *s = NULL;
    uint32_t order[400];
    bool seen[400] = {false}, fat = false;
    dyd_strips strips;
    assert_int_equal(dyd_sites_new(&s), DYD_OK);
    for (size_t i = 0; i < n; i++) add_any(s);
    assert_int_equal(dyd_spatial_order(order, &strips, s, 1), DYD_OK);
    assert_int_equal(strips.begin[strips.count], n);
    unsigned strip = 0;
    for (size_t q = 0; q < n; q++) {
      for (; q == strips.begin[strip + 1]; strip++) fat = false;
      assert_in_range(order[q], 0, n - 1);
      assert_false(seen[order[q]]);
      seen[order[q]] = true;
      bool is_point = dyd_sites_is_point(s, order[q]);
      assert_false(fat && is_point); /* exact points come first in each strip */
      fat = fat || !is_point;
    }
    dyd_sites_free(s);
  }
}

/* ---- common scale ---- */

/* Does in * F = out with F = lcm * 2^-low? */
static void scaled_exactly(const dyd_scale_set *set, mpz_srcptr out, const mpq_t in) {
  mpq_t f;
  mpq_init(f);
  mpq_set_z(f, set->lcm);
  if (set->low > 0 && set->low != INT64_MAX) mpq_div_2exp(f, f, (mp_bitcnt_t)set->low);
  if (set->low < 0) mpq_mul_2exp(f, f, (mp_bitcnt_t)-set->low);
  mpq_mul(f, f, in);
  assert_int_equal(mpz_cmp_ui(mpq_denref(f), 1), 0);
  assert_int_equal(mpz_cmp(mpq_numref(f), out), 0);
  mpq_clear(f);
}

static void members_agree(const dyd_scale_set *set, const orc_case *c) {
  for (size_t k = 0; k < set->count; k++) {
    const mpq_t *e = c->rect[set->rects->site[set->vertex[k]]].e;
    scaled_exactly(set, set->rect[k].x0, e[0]);
    scaled_exactly(set, set->rect[k].x1, e[1]);
    scaled_exactly(set, set->rect[k].y0, e[2]);
    scaled_exactly(set, set->rect[k].y1, e[3]);
  }
}

/* A box about c * lcm in doubles comes back as a box about c [FLT-SCALE]. */
static void comes_back(const dyd_scale_set *set, mpq_t *const c) {
  dyd_bbox box;
  dyd_rect r;
  mpq_t q[2], d;
  dyd_rect_init(&r);
  mpq_inits(q[0], q[1], d, NULL);
  mpq_set_z(d, set->lcm);
  for (int a = 0; a < 2; a++) mpq_mul(q[a], c[2 * a], d);
  assert_int_equal(dyd_rect_set_q(&r, q[0], q[1]), DYD_OK);
  dyd_interval_get_d(&box.e[0], &box.e[1], &r.x);
  dyd_interval_get_d(&box.e[2], &box.e[3], &r.y);
  dyd_scale_to_user(&box, set);
  for (int k = 0; k < 4; k++) {
    if (!isfinite(box.e[k])) {
      assert_int_equal(box.e[k] > 0, k & 1);
      continue;
    }
    mpq_set_d(d, box.e[k]);
    assert_true((k & 1 ? 1 : -1) * mpq_cmp(d, c[k & 2]) >= 0);
  }
  mpq_clears(q[0], q[1], d, NULL);
  dyd_rect_clear(&r);
}

static void add_all(dyd_scale_set *set, uint32_t n, orc_case *c) {
  mpz_t before, was;
  mpz_inits(before, was, NULL);
  for (uint32_t v = 0; v < n; v++) {
    size_t place = 99, again = 99;
    bool grown = true;
    if (set->count) mpz_set(before, set->rect[0].x1);
    assert_int_equal(dyd_scale_add(&place, &grown, set, v), DYD_OK);
    assert_int_equal(place, v);
    if (grown) mpz_mul(before, before, set->growth);
    if (v) assert_int_equal(mpz_cmp(before, set->rect[0].x1), 0);
    assert_int_equal(dyd_scale_add(&again, &grown, set, v), DYD_OK);
    assert_true(again == place && !grown);
    assert_true(dyd_scale_shift(set) == (set->low == INT64_MAX ? 0 : -set->low));
    members_agree(set, c);
    comes_back(set, c->rect[set->rects->site[v]].e);
  }
  mpz_clears(before, was, NULL);
}

/* Denominators so long that their least common multiple leaves the doubles. */
static void lengthen(orc_case *c, unsigned bits) {
  for (size_t i = 0; i < c->n; i++)
    for (int a = 0; a < 2; a++) {
      mpq_t *e = &c->rect[i].e[2 * a];
      if (!mpq_equal(e[0], e[1])) continue;
      mpz_mul_2exp(mpq_denref(e[0]), mpq_denref(e[0]), bits);
      mpz_add_ui(mpq_denref(e[0]), mpq_denref(e[0]), 1 + 2 * test_below(&shared, 1000));
      mpz_mul_2exp(mpq_numref(e[0]), mpq_numref(e[0]), bits);
      mpq_canonicalize(e[0]);
      mpq_set(e[1], e[0]);
    }
}

static void test_scale_set(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  for (size_t k = test_cases(120); k; k--) {
    dyd_scale_set set;
    orc_generate(&c, &shared, test_chance(&shared, 2) ? 8 : test_below(&shared, ORC_KINDS), 9);
    if (test_chance(&shared, 2)) lengthen(&c, (unsigned)test_between(&shared, 20, 300));
    dyd_sites *s = harness_sites(&c);
    dyd_skeleton sk;
    assert_int_equal(dyd_skeleton_build(&sk, s, &(dyd_skeleton_options){.threads = 1}), DYD_OK);
    dyd_scale_set_init(&set, &sk.rects);
    add_all(&set, sk.n, &c);
    dyd_scale_set_empty(&set);
    add_all(&set, sk.n, &c);
    dyd_scale_set_clear(&set);
    dyd_skeleton_clear(&sk);
    dyd_sites_free(s);
  }
  orc_case_clear(&c);
}

/* ---- boxes of points ---- */

/* Returns whether [lo, hi] is the enclosure of v in doubles: around it, and no wider than to the next double. */
static bool is_rounded_outward(double lo, double hi, const dyd_dyadic *v) {
  mpq_t exact, end;
  mpq_inits(exact, end, NULL);
  dyd_dyadic_get_q(exact, v);
  mpq_set_d(end, lo);
  bool below = mpq_cmp(end, exact) <= 0;
  mpq_set_d(end, hi);
  bool above = mpq_cmp(exact, end) <= 0;
  mpq_clears(exact, end, NULL);
  return below && above && hi <= nextafter(lo, INFINITY);
}

/* To the last bit: centres have more digits than doubles. */
static void test_point_box(void **state) {
  (void)state;
  dyd_point c;
  dyd_point_init(&c);
  for (size_t n = test_cases(1000); n > 0; n--) {
    dyd_dyadic *at[2] = {&c.x, &c.y};
    for (int a = 0; a < 2; a++) {
      mpz_set_si(at[a]->man, (long)test_u64(&shared) | 1);
      at[a]->exp = test_between(&shared, -90, 30);
    }
    dyd_bbox b = dyd_point_box(&c);
    assert_true(is_rounded_outward(b.e[0], b.e[1], &c.x));
    assert_true(is_rounded_outward(b.e[2], b.e[3], &c.y));
  }
  dyd_point_clear(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_tree), cmocka_unit_test(test_order),
                                     cmocka_unit_test(test_scale_set), cmocka_unit_test(test_point_box)};
  shared = test_random_start("internals");
  return cmocka_run_group_tests(tests, NULL, NULL);
}
