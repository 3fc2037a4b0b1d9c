/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points that are measured in one way and computed in the other: what is said to stay open does, whatever the computed
 * coordinates are, by the literal oracle [SET-1] [SET-2]; and runs end when nothing else is left. */
#include "engine/help.h"
#include "engine/settle.h"
#include "engine/settle_firm.h"
#include "oracle/oracle.h"

#include <math.h>

enum { MOST = 8 };

/* A coordinate that is known as roughly as asked, anywhere around a hidden place. */
typedef struct rough {
  test_random random;
  double at;
} rough;

/* What a case is made of; fixed: the sides of each site that are never narrowed. */
typedef struct half_case {
  dyd_engine *e;
  size_t n;
  rough side[MOST][2];
  bool fixed[MOST][2];
} half_case;

static double grid(test_random *r, int least, int most) {
  return (double)test_between(r, least, most) / 128;
}

static dyd_status rough_narrow(dyd_interval *out, void *user, const dyd_request *q, dyd_error *err) {
  rough *f = user;
  double w = ldexp(1, -(int)q->bits), below = w * (double)test_below(&f->random, 9) / 8, had[2] = {-1e9, 1e9};
  (void)err;
  if (!dyd_interval_is_point(out)) dyd_interval_get_d(&had[0], &had[1], out);
  return dyd_interval_set_d(out, fmax(had[0], f->at - below), fmin(had[1], f->at + (w - below)));
}

/* A side: [lo,hi] for good, or a place that is hidden in it. */
static dyd_real *side_of(rough *f, test_random *r, double lo, double hi, bool fixed) {
  dyd_real *out;
  mpq_t end[2];
  *f = (rough){.random = *r, .at = lo};
  test_below(r, 2);
  if (!fixed) {
    assert_int_equal(DYD_OK, dyd_real_new(&out, rough_narrow, NULL, f));
    return out;
  }
  mpq_inits(end[0], end[1], NULL);
  mpq_set_d(end[0], lo);
  mpq_set_d(end[1], hi);
  assert_int_equal(DYD_OK, dyd_real_from_interval(&out, end[0], end[1]));
  mpq_clears(end[0], end[1], NULL);
  return out;
}

/* In a square of 2, some with one side that is fixed, others with both or none; these are up to `most` 128ths wide. */
static void half_case_new(half_case *c, test_random *r, int most) {
  *c = (half_case){.e = engine_new(), .n = (size_t)test_between(r, 4, MOST)};
  for (size_t i = 0; i < c->n; i++) {
    dyd_real *x[2];
    dyd_stream *s;
    int kind = (int)test_below(r, 6);
    for (int a = 0; a < 2; a++) {
      double lo = grid(r, 0, 256);
      c->fixed[i][a] = kind < 2 ? kind == 0 : (kind & 1) == a;
      double hi = c->fixed[i][a] && !test_chance(r, 6) ? lo + grid(r, 1, most) : lo;
      x[a] = side_of(&c->side[i][a], r, lo, hi, c->fixed[i][a]);
    }
    assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, x[0], x[1]));
    assert_int_equal(DYD_OK, dyd_engine_add_stream(c->e, s));
  }
}

/* The sites when all that can be narrowed is a point: the lower ends, the upper ends, or anywhere, ends included. */
static void half_case_narrow(orc_case *out, const half_case *c, test_random *r, int way) {
  out->n = 0;
  for (size_t i = 0; i < c->n; i++) {
    double d[4];
    orc_rect *q = &out->rect[out->n++];
    dyd_sites_get_d(d, dyd_engine_sites(c->e), i);
    for (int a = 0; a < 2; a++) {
      if (c->fixed[i][a]) continue;
      double w = d[2 * a + 1] - d[2 * a];
      double t = way < 2 ? way : (double)test_below(r, 9) / 8;
      d[2 * a] = d[2 * a + 1] = d[2 * a] + t * w;
    }
    for (int k = 0; k < 4; k++) mpq_set_d(q->e[k], d[k]);
  }
}

static bool coincides(const orc_case *c, uint32_t i, uint32_t j) {
  for (size_t a = 0; a < c->n; a++)
    for (size_t b = 0; b < a; b++)
      if (orc_rect_is_point(&c->rect[a]) && orc_rect_equal(&c->rect[a], &c->rect[b])) return true;
  return i == j;
}

/* What was said about a pair is so. */
static void check_said(orc_pool *p, const orc_case *c, const dyd_settled_pair *pair) {
  if (coincides(c, pair->i, pair->j)) return;
  if (pair->possible && !orc_possible(p, c, pair->i, pair->j)) {
    print_message("%u %u was said to stay possible\n", pair->i, pair->j);
    fail();
  }
  if (pair->unsure && orc_legal(NULL, NULL, p, c, pair->i, pair->j)) {
    print_message("%u %u was said never to be legal\n", pair->i, pair->j);
    fail();
  }
}

static void check_all_said(const half_case *c, const dyd_settled_pair *pair, size_t count, test_random *r) {
  enum { WAYS = 8 };
  orc_pool pool;
  orc_case narrow;
  orc_pool_init(&pool);
  orc_case_init(&narrow);
  size_t mark = orc_mark(&pool);
  for (int way = 0; way < WAYS; way++) {
    half_case_narrow(&narrow, c, r, way);
    for (size_t k = 0; k < count; k++) {
      check_said(&pool, &narrow, &pair[k]);
      orc_release(&pool, mark);
    }
  }
  orc_case_clear(&narrow);
  orc_pool_clear(&pool);
}

static void run_coarsely(half_case *c, dyd_engine_options *o, int64_t bits) {
  dyd_outcome outcome;
  dyd_engine_options_init(o);
  o->start_bits = o->max_bits = bits;
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, c->e, o, NULL));
}

/* A few sites, by what they alone suggest, while there are others around. */
static void test_few(void **state) {
  (void)state;
  enum { FEW = 4 };
  test_random r = test_random_start(__func__);
  size_t possible = 0, unsure = 0;
  for (size_t round = 0; round < test_cases(900); round++) {
    half_case c;
    dyd_engine_options o;
    dyd_settled_pair pair[FEW * FEW];
    uint32_t few[FEW];
    size_t count = 0, work = SIZE_MAX;
    uint64_t random = round;
    half_case_new(&c, &r, 96);
    run_coarsely(&c, &o, test_between(&r, 1, 3));
    for (uint32_t k = 0; k < FEW; k++) few[k] = (uint32_t)(k * c.n / FEW);
    for (uint32_t k = 0; k < FEW * FEW; k++)
      if (k / FEW < k % FEW) pair[count++] = (dyd_settled_pair){few[k / FEW], few[k % FEW], false, false};
    const dyd_index_list face = {.item = few, .count = FEW};
    assert_int_equal(DYD_OK, dyd_settle_face(pair, &random, &work, c.e, count, &face));
    check_all_said(&c, pair, count, &r);
    for (size_t k = 0; k < count; k++) possible += pair[k].possible, unsure += pair[k].unsure;
    dyd_engine_free(c.e);
  }
  print_message("%zu possible, %zu never legal\n", possible, unsure);
  assert_true(possible > 300 && unsure > 300);
}

/* All faces, pairs of firm rectangles among them. */
static void test_faces(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  size_t said = 0, settled = 0;
  for (size_t round = 0; round < test_cases(300); round++) {
    half_case c;
    dyd_engine_options o;
    dyd_settled s = {0};
    half_case_new(&c, &r, 160);
    run_coarsely(&c, &o, test_between(&r, 2, 6));
    if (dyd_engine_delaunay(c.e)) {
      const dyd_plan plan = {.e = c.e, .o = &o};
      assert_int_equal(DYD_OK, dyd_settle(&s, &plan));
    }
    check_all_said(&c, s.item, s.count, &r);
    for (size_t k = 0; k < s.count; k++) said++, settled += dyd_pair_is_settled(&s.item[k]);
    dyd_settled_clear(&s);
    dyd_engine_free(c.e);
  }
  print_message("%zu pairs, %zu settled\n", said, settled);
  assert_true(settled > said / 3 && settled > 200);
}

/* Runs end when refining is in vain, and not before: every pair left stays open. */
static void test_runs(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  size_t ends[6] = {0}, rounds = test_cases(150);
  for (size_t round = 0; round < rounds; round++) {
    half_case c;
    dyd_engine_options o;
    dyd_outcome outcome;
    dyd_pair_list pairs = {0};
    half_case_new(&c, &r, 96);
    dyd_engine_options_init(&o);
    o.start_bits = test_between(&r, 1, 5);
    o.step_bits = test_between(&r, 0, 2);
    o.max_bits = 40;
    o.schedule = test_chance(&r, 4) ? DYD_SCHEDULE_UNIFORM : DYD_SCHEDULE_ADAPTIVE;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, c.e, &o, NULL));
    ends[outcome]++;
    assert_int_equal(DYD_OK, dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(c.e)));
    for (size_t k = 0; outcome == DYD_OUTCOME_FIXPOINT && k < pairs.count; k++) {
      const dyd_settled_pair open = {pairs.item[k].i, pairs.item[k].j, true, true};
      if (pairs.item[k].status == DYD_INDETERMINATE) check_all_said(&c, &open, 1, &r);
    }
    dyd_pair_list_clear(&pairs);
    dyd_engine_free(c.e);
  }
  print_message("of %zu runs %zu decided, %zu in vain, %zu at the budget\n", rounds, ends[DYD_OUTCOME_DECIDED],
                ends[DYD_OUTCOME_FIXPOINT], ends[DYD_OUTCOME_BUDGET]);
  assert_true(ends[DYD_OUTCOME_FIXPOINT] > rounds / 2 && ends[DYD_OUTCOME_BUDGET] < rounds / 20);
}

/* The rectangle of site k of the engine, as P has it [SET-2]. */
static void check_added(const half_case *c, const dyd_dyadic *eps, size_t k) {
  dyd_sites *sites;
  double was[4], is[4];
  assert_int_equal(DYD_OK, dyd_sites_new(&sites));
  assert_int_equal(DYD_OK, dyd_firm_add(sites, c->e, eps, (uint32_t)k));
  dyd_sites_get_d(was, dyd_engine_sites(c->e), k);
  dyd_sites_get_d(is, sites, 0);
  dyd_sites_free(sites);
  double e = dyd_dyadic_get_d(eps, DYD_UP);
  bool both = c->fixed[k][0] && c->fixed[k][1];
  bool firm = both && was[1] - was[0] > 2 * e && was[3] - was[2] > 2 * e;
  for (int a = 0; a < 4; a += 2) {
    double in = firm ? e : 0;
    assert_true(was[a] <= is[a] && is[a] <= is[a + 1] && is[a + 1] <= was[a + 1]);
    if (c->fixed[k][a / 2])
      assert_true(is[a] == was[a] + in && is[a + 1] == was[a + 1] - in);
    else
      assert_true(is[a] == is[a + 1]);
  }
}

/* Which sides are fixed, how much is not known of the others, and what stands for the sites. */
static void test_sides(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  for (size_t round = 0; round < test_cases(200); round++) {
    half_case c;
    dyd_engine_options o;
    dyd_dyadic eps;
    dyd_rect rect;
    double most = 0, d[4];
    half_case_new(&c, &r, 160);
    run_coarsely(&c, &o, test_between(&r, 1, 6));
    dyd_dyadic_init(&eps);
    dyd_rect_init(&rect);
    assert_int_equal(DYD_OK, dyd_firm_eps(&eps, c.e));
    for (size_t k = 0; k < c.n; k++) {
      bool fixed[2];
      assert_int_equal(DYD_OK, dyd_sites_get(&rect, dyd_engine_sites(c.e), k));
      dyd_site_fixed_sides(fixed, c.e, (uint32_t)k, &rect);
      assert_true(fixed[0] == c.fixed[k][0] && fixed[1] == c.fixed[k][1]);
      dyd_sites_get_d(d, dyd_engine_sites(c.e), k);
      double x = fixed[0] ? 0 : d[1] - d[0], y = fixed[1] ? 0 : d[3] - d[2];
      most = fmax(most, hypot(x, y));
      check_added(&c, &eps, k);
    }
    double e = dyd_dyadic_get_d(&eps, DYD_UP);
    assert_true(most <= e && (most == 0 || e <= 4 * most));
    dyd_rect_clear(&rect);
    dyd_dyadic_clear(&eps);
    dyd_engine_free(c.e);
  }
}

static bool same_interval(const dyd_interval *a, const dyd_interval *b) {
  return dyd_dyadic_cmp(&a->lo, &b->lo) == 0 && dyd_dyadic_cmp(&a->hi, &b->hi) == 0;
}

static dyd_status fixed_narrow(dyd_interval *out, void *user, const dyd_request *q, dyd_error *err) {
  (void)user, (void)q, (void)err;
  return dyd_interval_set_d(out, 1, 2) == DYD_OK ? DYD_FIXED : DYD_E_STREAM;
}

/* A callback that never knows more than [1,2], claimed to be the root of 2, beside the same place by expressions, and
 * others where that place matters. */
static void add_claimed(dyd_engine *e) {
  dyd_real *x, *y;
  dyd_stream *s;
  mpq_t coeff[3], lo, hi;
  mpq_inits(coeff[0], coeff[1], coeff[2], lo, hi, NULL);
  mpq_set_si(coeff[0], -2, 1);
  mpq_set_si(coeff[2], 1, 1);
  mpq_set_si(lo, 1, 1);
  mpq_set_si(hi, 2, 1);
  assert_int_equal(DYD_OK, dyd_real_new(&x, fixed_narrow, NULL, NULL));
  assert_int_equal(DYD_OK, dyd_real_claim_root(x, (const mpq_t *)coeff, 3, lo, hi, NULL));
  assert_int_equal(DYD_OK, dyd_real_parse(&y, "sqrt(3)", 7, NULL));
  assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, x, y));
  assert_int_equal(DYD_OK, dyd_engine_add_stream(e, s));
  engine_add_text(e, "sqrt(2)", "sqrt(3)");
  mpq_clears(coeff[0], coeff[1], coeff[2], lo, hi, NULL);
}

/* What is said to be fixed stays as it is: intervals narrower than first answers, places that are joined. */
static void test_fixed_for_good(void **state) {
  (void)state;
  enum { POINTS = 7 };
  size_t said = 0;
  for (int64_t bits = 1; bits <= 40; bits++) {
    dyd_engine *e = engine_new();
    dyd_engine_options o;
    dyd_outcome outcome;
    dyd_rect was[POINTS], is;
    bool fixed[POINTS][2];
    add_claimed(e);
    engine_add_text(e, "sqrt(7)", "[1.1,1.1000001]");
    engine_add_text(e, "[0.1,0.1000000000003]", "cos(1)");
    engine_add_text(e, "sqrt(10)", "[0.3,2.7]");
    engine_add_text(e, "1/3", "sqrt(5)");
    engine_add_text(e, "5", "[1/3,2/3]");
    dyd_engine_options_init(&o);
    o.schedule = DYD_SCHEDULE_UNIFORM;
    o.start_bits = o.max_bits = bits;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
    for (uint32_t k = 0; k < POINTS; k++) {
      dyd_rect_init(&was[k]);
      assert_int_equal(DYD_OK, dyd_sites_get(&was[k], dyd_engine_sites(e), k));
      dyd_site_fixed_sides(fixed[k], e, k, &was[k]);
      said += fixed[k][0] + fixed[k][1];
    }
    o.start_bits = o.max_bits = bits + 100;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
    dyd_rect_init(&is);
    for (uint32_t k = 0; k < POINTS; k++) {
      assert_int_equal(DYD_OK, dyd_sites_get(&is, dyd_engine_sites(e), k));
      assert_true(!fixed[k][0] || same_interval(&is.x, &was[k].x));
      assert_true(!fixed[k][1] || same_interval(&is.y, &was[k].y));
      dyd_rect_clear(&was[k]);
    }
    dyd_rect_clear(&is);
    dyd_engine_free(e);
  }
  print_message("%zu sides said to be fixed\n", said);
  assert_true(said > 150);
}

/* Expressions and roots beside one interval, in a file of the usual kind, x and y in either order: few bits are spent
 * on what bits cannot decide. */
static void test_text(void **state) {
  (void)state;
  static const char *const text[][2] = {
      {"0", "0"}, {"10", "0"}, {"sqrt(26)", "[3.1,9.1]"}, {"5", "-6"}, {"15.5", "root(x^5-x-1,1,2)"}};
  for (int turned = 0; turned < 2; turned++) {
    dyd_engine *e = engine_new();
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) engine_add_text(e, text[k][turned], text[k][1 - turned]);
    engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
    assert_true(dyd_delaunay_status(dyd_engine_delaunay(e), 0, 1) == DYD_INDETERMINATE);
    assert_true(engine_counters(e).bits_most <= 1024);
    dyd_engine_free(e);
  }
}

/* Known as asked below 10 bits, then to 10 bits for good. */
static dyd_status tiring_narrow(dyd_interval *out, void *user, const dyd_request *q, dyd_error *err) {
  (void)user, (void)err;
  double w = ldexp(1, -(int)(q->bits < 10 ? q->bits : 10));
  if (dyd_interval_set_d(out, 2, 2 + w) != DYD_OK) return DYD_E_STREAM;
  return q->bits < 10 ? DYD_OK : DYD_FIXED;
}

/* Another user of a coordinate brings it to its end: the side here is as wide as before, and is narrowed when asked. */
static void test_shared(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_engine_options o;
  dyd_outcome outcome;
  dyd_real *x, *y;
  dyd_stream *s;
  dyd_rect r;
  bool fixed[2];
  assert_int_equal(DYD_OK, dyd_real_new(&x, tiring_narrow, NULL, NULL));
  assert_int_equal(DYD_OK, dyd_real_parse(&y, "sqrt(3)", 7, NULL));
  assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, dyd_real_ref(x), y));
  assert_int_equal(DYD_OK, dyd_engine_add_stream(e, s));
  engine_add_text(e, "0", "0");
  dyd_rect_init(&r);
  dyd_engine_options_init(&o);
  o.start_bits = o.max_bits = 4;
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
  assert_int_equal(DYD_FIXED, dyd_real_narrow(x, 20, 20, NULL));
  assert_int_equal(DYD_OK, dyd_sites_get(&r, dyd_engine_sites(e), 0));
  dyd_site_fixed_sides(fixed, e, 0, &r);
  assert_true(!fixed[0] && !fixed[1]);
  dyd_interval_set(&r.x, dyd_real_interval(x));
  dyd_site_fixed_sides(fixed, e, 0, &r);
  assert_true(fixed[0] && !fixed[1]);
  dyd_rect_clear(&r);
  dyd_real_free(x);
  dyd_engine_free(e);
}

/* What was measured again is fixed all the same. */
static void test_measured(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_rect r;
  dyd_rect_init(&r);
  engine_add_text(e, "0", "0");
  engine_add_text(e, "10", "0");
  engine_add_text(e, "sqrt(26)", "[3,9]");
  engine_add_text(e, "5", "-6");
  assert_int_equal(DYD_OK, dyd_interval_set_d(&r.x, 5, 5.5));
  assert_int_equal(DYD_OK, dyd_interval_set_d(&r.y, 3.25, 8));
  assert_int_equal(DYD_OK, dyd_engine_remeasure(e, 2, &r, NULL));
  engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
  assert_true(engine_counters(e).bits_most <= 1024);
  dyd_rect_clear(&r);
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_few),    cmocka_unit_test(test_faces),          cmocka_unit_test(test_runs),
      cmocka_unit_test(test_sides),  cmocka_unit_test(test_fixed_for_good), cmocka_unit_test(test_text),
      cmocka_unit_test(test_shared), cmocka_unit_test(test_measured)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
