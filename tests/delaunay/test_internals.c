/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The tools of the triangulation against brute force: tree of boxes, map of pairs, linear programme, spatial order,
 * common scale [FLT-DST] [FLT-DIR] [FLT-SCALE]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/read_case.h"
#include "legal/lp_filter.h"
#include "possible/pair_map.h"
#include "skeleton/order.h"
#include "skeleton/scale_set.h"
#include "skeleton/skeleton.h"
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

/* ---- map of pairs ---- */

enum { MEMBERS = 90 };

static void lists_agree(const dyd_pair_map *m, unsigned char want[MEMBERS][MEMBERS]) {
  for (uint32_t a = 0; a < MEMBERS; a++) {
    unsigned char seen[MEMBERS] = {0};
    for (uint32_t l = m->head[a]; l != UINT32_MAX; l = m->link[l].next) {
      assert_in_range(l, 0, m->links - 1);
      seen[m->link[l].to]++;
      assert_int_equal(m->link[l ^ 1].to, a);
    }
    for (uint32_t b = 0; b < MEMBERS; b++) {
      assert_int_equal(seen[b], want[a][b] >= DYD_PAIR_OPEN);
      if (a != b) assert_int_equal(dyd_pair_map_get(m, a, b), want[a][b]);
    }
  }
}

static void test_pair_map(void **state) {
  (void)state;
  for (size_t k = test_cases(20); k; k--) {
    static unsigned char want[MEMBERS][MEMBERS];
    dyd_pair_map m;
    memset(want, 0, sizeof want);
    assert_int_equal(dyd_pair_map_init(&m, MEMBERS), DYD_OK);
    for (size_t n = (size_t)test_below(&shared, 5000); n; n--) {
      uint32_t a = (uint32_t)test_below(&shared, MEMBERS), b = (uint32_t)test_below(&shared, MEMBERS);
      if (a == b || want[a][b]) continue;
      want[a][b] = want[b][a] = (unsigned char)test_between(&shared, 1, 3);
      assert_int_equal(dyd_pair_map_add(&m, a, b, (dyd_pair_state)want[a][b]), DYD_OK);
    }
    lists_agree(&m, want);
    dyd_pair_map_clear(&m);
  }
}

/* The longest chain of occupied places. */
static size_t longest_run(const dyd_pair_map *m) {
  size_t run = 0, longest = 0;
  for (size_t q = 0; q <= 2 * m->mask; q++) {
    run = m->key[q & m->mask] ? run + 1 : 0;
    if (run > longest) longest = run;
  }
  return longest;
}

/* Once all pairs with the same larger member began at the same place. */
static void test_hash_uses_both(void **state) {
  (void)state;
  for (uint32_t shape = 0; shape < 3; shape++) {
    dyd_pair_map m;
    assert_int_equal(dyd_pair_map_init(&m, 5001), DYD_OK);
    for (uint32_t a = 0; a < 1900; a++) {
      uint32_t from = shape == 2 ? a / 44 : a, to = shape == 0 ? 5000 : shape == 1 ? a + 1 : 100 + a % 44;
      assert_int_equal(dyd_pair_map_add(&m, from, to, DYD_PAIR_OPEN), DYD_OK);
    }
    assert_in_range(longest_run(&m), 1, 150);
    dyd_pair_map_clear(&m);
  }
}

/* ---- linear programme ---- */

/* The optimum of three cuts, where 0 is in the hull of their normals. */
static bool triple(double *z, const dyd_cut *a, const dyd_cut *b, const dyd_cut *c) {
  double la = b->nx * c->ny - b->ny * c->nx, lb = c->nx * a->ny - c->ny * a->nx, lc = a->nx * b->ny - a->ny * b->nx;
  double sum = la + lb + lc;
  if (fabs(sum) < 1e-9 || la * sum < 0 || lb * sum < 0 || lc * sum < 0) return false;
  *z = (la * a->d + lb * b->d + lc * c->d) / sum;
  return true;
}

static double least_over_triples(const dyd_cut *cut, size_t count) {
  double least = INFINITY, z;
  for (size_t a = 0; a < count; a++)
    for (size_t b = 0; b < a; b++)
      for (size_t c = 0; c < b; c++)
        if (triple(&z, &cut[a], &cut[b], &cut[c]) && z < least) least = z;
  return least;
}

/* Normals in general position: antiparallel up to rounding, a guess may go astray. */
static size_t random_cuts(dyd_cut *cut) {
  size_t count = (size_t)test_below(&shared, 13);
  for (size_t q = 0; q < count; q++) {
    bool regular = test_chance(&shared, 3);
    double angle = regular ? ((double)test_below(&shared, 24) + test_unit(&shared) * 0x1p-8) * 0.2617993877991494
                           : test_unit(&shared) * 6.283185307;
    cut[q] = (dyd_cut){cos(angle), sin(angle), test_unit(&shared) * 4 - 2};
  }
  return count;
}

/* The value is that of the point. Bounded: it is the optimum; else it is as good as the optimum inside the frame. */
static void test_lp(void **state) {
  (void)state;
  size_t bounded = 0;
  const double h = sqrt(0.75), bound = 100;
  for (size_t k = test_cases(3000); k; k--) {
    dyd_cut cut[15];
    size_t count = random_cuts(cut);
    dyd_lp_result r = dyd_lp_centre(cut, count, bound);
    cut[count] = (dyd_cut){0, 1, bound};
    cut[count + 1] = (dyd_cut){-h, -0.5, bound};
    cut[count + 2] = (dyd_cut){h, -0.5, bound};
    double own = least_over_triples(cut, count), framed = least_over_triples(cut, count + 3), value = INFINITY;
    for (size_t q = 0; q < count; q++) value = fmin(value, cut[q].nx * r.x + cut[q].ny * r.y + cut[q].d);
    bool good = r.bounded ? fabs(r.z - own) < 1e-5 && fabs(value - own) < 1e-5
                          : value > r.z - 1e-5 && r.z > framed - 1e-5 && r.z < own + 1e-5;
    bounded += r.bounded;
    if (!r.bounded && hypot(r.x, r.y) > 10 * bound) continue; /* an open end: any centre far out will do */
    if (good && (!r.bounded || r.active <= 2)) continue;
    for (size_t q = 0; q < count; q++) fprintf(stderr, "%a %a %a\n", cut[q].nx, cut[q].ny, cut[q].d);
    fail_msg("%zu cuts: %g, at the point %g; best %g, in the frame %g", count, r.z, value, own, framed);
  }
  assert_true(bounded > 100);
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_tree),           cmocka_unit_test(test_pair_map),
                                     cmocka_unit_test(test_hash_uses_both), cmocka_unit_test(test_lp),
                                     cmocka_unit_test(test_order),          cmocka_unit_test(test_scale_set)};
  shared = test_random_start("internals");
  return cmocka_run_group_tests(tests, NULL, NULL);
}
