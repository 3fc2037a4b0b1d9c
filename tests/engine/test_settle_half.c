/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points that are measured in one way and computed in the other, and computed ones with a radius: pairs reported to
 * stay open do so, whatever the computed coordinates are, by the literal oracle [SET-1] [SET-2] [SET-3]; and runs end
 * when nothing else is left. */
#include "engine/help.h"
#include "engine/settle.h"
#include "oracle/oracle.h"
#include "rect/rect.h"

#include <math.h>
#include <string.h>

enum { MOST = 8 };

/* A coordinate that is known as roughly as asked, anywhere around a hidden place. */
typedef struct rough {
  test_random random;
  double at;
} rough;

/* What a case is made of; fixed: the sides of each site that are never narrowed; radius: of the others, in 384ths. */
typedef struct half_case {
  dyd_engine *e;
  size_t n;
  rough side[MOST][2];
  bool fixed[MOST][2];
  int radius[MOST][2];
} half_case;

enum { RADIUS_UNIT = 384 };

static double grid(test_random *r, int least, int most) {
  return (double)test_between(r, least, most) / 128;
}

static dyd_status rough_narrow(dyd_interval *out, void *user, const dyd_request *q, dyd_error *err) {
  rough *f = user;
  double w = ldexp(1, -(int)q->bits), below = w * (double)test_below(&f->random, 9) / 8, had[2] = {-1e9, 1e9};
  (void)err;
  if (!dyd_interval_is_unset(out)) dyd_interval_get_d(&had[0], &had[1], out);
  return dyd_interval_set_d(out, fmax(had[0], f->at - below), fmin(had[1], f->at + (w - below)));
}

/* A place that is hidden, with a radius. */
static dyd_real *wide_side(rough *f, int radius) {
  dyd_real *out;
  mpq_t by;
  assert_int_equal(DYD_OK, dyd_real_new(&out, rough_narrow, NULL, f));
  mpq_init(by);
  for (int part = radius / 2; radius > 0; radius -= part, part = radius) { /* in two parts */
    mpq_set_ui(by, (unsigned)part, RADIUS_UNIT);
    mpq_canonicalize(by);
    assert_int_equal(DYD_OK, dyd_real_widen(&out, out, by));
  }
  mpq_clear(by);
  return out;
}

/* A side: [lo,hi] for good, or a place that is hidden at lo, with a radius. */
static dyd_real *side_of(rough *f, test_random *r, double lo, double hi, bool fixed, int radius) {
  dyd_real *out;
  mpq_t end[2];
  *f = (rough){.random = *r, .at = lo};
  test_below(r, 2);
  if (!fixed) return wide_side(f, radius);
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
      c->radius[i][a] = !c->fixed[i][a] && test_chance(r, 3) ? (int)test_between(r, 1, most) : 0;
      x[a] = side_of(&c->side[i][a], r, lo, hi, c->fixed[i][a], c->radius[i][a]);
    }
    assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, x[0], x[1]));
    assert_int_equal(DYD_OK, dyd_engine_add_stream(c->e, s, NULL));
  }
}

/* Replaces a side from end[0] to end[1] by the places within the radius of the point eighths/8 along it. */
static void side_narrow(mpq_t end[2], int radius, int eighths) {
  mpq_t at, by, t;
  mpq_inits(at, by, t, (mpq_ptr)0);
  mpq_set_ui(by, (unsigned)radius, RADIUS_UNIT);
  mpq_canonicalize(by);
  mpq_set_ui(t, (unsigned)eighths, 8);
  mpq_canonicalize(t);
  mpq_sub(at, end[1], end[0]);
  mpq_sub(at, at, by);
  mpq_sub(at, at, by);
  mpq_mul(at, at, t);
  mpq_add(end[0], end[0], at);
  mpq_add(end[1], end[0], by);
  mpq_add(end[1], end[1], by);
  mpq_clears(at, by, t, (mpq_ptr)0);
}

/* The sites when all that can be narrowed is: to the lower ends, the upper ends, or anywhere, ends included. */
static void half_case_narrow(orc_case *out, const half_case *c, test_random *r, int way) {
  out->n = 0;
  for (size_t i = 0; i < c->n; i++) {
    dyd_rect rect;
    orc_rect *q = &out->rect[out->n++];
    dyd_rect_init(&rect);
    assert_int_equal(DYD_OK, dyd_sites_get(&rect, dyd_engine_sites(c->e), i));
    dyd_interval_get_q(q->e[0], q->e[1], &rect.x);
    dyd_interval_get_q(q->e[2], q->e[3], &rect.y);
    for (int a = 0; a < 2; a++)
      if (!c->fixed[i][a]) side_narrow(&q->e[2 * a], c->radius[i][a], way < 2 ? 8 * way : (int)test_below(r, 9));
    dyd_rect_clear(&rect);
  }
}

static bool coincides(const orc_case *c, uint32_t i, uint32_t j) {
  for (size_t a = 0; a < c->n; a++)
    for (size_t b = 0; b < a; b++)
      if (orc_rect_is_point(&c->rect[a]) && orc_rect_equal(&c->rect[a], &c->rect[b])) return true;
  return i == j;
}

/* Checks a statement about a pair. */
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

/* A few sites, judged without the others around them. */
static void test_few(void **state) {
  (void)state;
  enum { FEW = 4 };
  test_random r = test_random_start(__func__);
  size_t possible = 0, unsure = 0;
  for (size_t round = 0; round < test_cases(500); round++) {
    half_case c;
    dyd_engine_options o;
    dyd_settled_pair pair[FEW * FEW];
    uint32_t few[FEW];
    size_t count = 0;
    dyd_settle_work work = {SIZE_MAX, SIZE_MAX};
    half_case_new(&c, &r, 96);
    run_coarsely(&c, &o, test_between(&r, 1, 3));
    for (uint32_t k = 0; k < FEW; k++) few[k] = (uint32_t)(k * c.n / FEW);
    for (uint32_t k = 0; k < FEW * FEW; k++)
      if (k / FEW < k % FEW) pair[count++] = (dyd_settled_pair){few[k / FEW], few[k % FEW], false, false};
    const dyd_index_list face = {.item = few, .count = FEW};
    assert_int_equal(DYD_OK, dyd_settle_face(pair, &work, NULL, c.e, count, &face));
    check_all_said(&c, pair, count, &r);
    for (size_t k = 0; k < count; k++) possible += pair[k].possible, unsure += pair[k].unsure;
    dyd_engine_free(c.e);
  }
  print_message("%zu possible, %zu never legal\n", possible, unsure);
  assert_true(possible > test_cases(500) / 2 && unsure > test_cases(500) / 2);
}

/* All faces, pairs of firm rectangles among them. */
static void test_faces(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  size_t said = 0, settled = 0;
  for (size_t round = 0; round < test_cases(200); round++) {
    half_case c;
    dyd_engine_options o;
    dyd_settled s = {0};
    half_case_new(&c, &r, 160);
    run_coarsely(&c, &o, test_between(&r, 2, 6));
    if (dyd_engine_delaunay(c.e)) {
      const dyd_wants wants = {.e = c.e, .o = &o};
      assert_int_equal(DYD_OK, dyd_settle(&s, &wants));
    }
    check_all_said(&c, s.item, s.count, &r);
    for (size_t k = 0; k < s.count; k++) said++, settled += dyd_pair_is_settled(&s.item[k]);
    dyd_settled_clear(&s);
    dyd_engine_free(c.e);
  }
  print_message("%zu pairs, %zu settled\n", said, settled);
  assert_true(settled > said / 3 && settled > 200);
}

/* Runs end when refining cannot help, and not before: every pair left stays open. */
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

/* The rectangle of site k of the engine, as P has it [SET-2]; core: with the core [SET-3]. */
static void check_added(const half_case *c, const dyd_dyadic *eps, size_t k, const dyd_rect *rect, const bool core[2]) {
  const uint32_t site = (uint32_t)k;
  dyd_rect made;
  double was[4], is[4];
  bool said;
  const dyd_firm_sites cores = {c->e, eps, &said, &site};
  dyd_rect_init(&made);
  assert_int_equal(DYD_OK, dyd_firm_rect(&made, &cores, 0));
  dyd_rect_get_d(was, rect);
  dyd_rect_get_d(is, &made);
  dyd_rect_clear(&made);
  double e = dyd_dyadic_get_d(eps, DYD_UP);
  bool firm = core[0] && core[1] && was[1] - was[0] > 2 * e && was[3] - was[2] > 2 * e;
  assert_true(said == firm);
  for (int a = 0; a < 4; a += 2) {
    double in = firm ? e : 0;
    assert_true(was[a] <= is[a] && is[a] <= is[a + 1] && is[a + 1] <= was[a + 1]);
    if (core[a / 2])
      assert_true(is[a] == was[a] + in && is[a + 1] == was[a + 1] - in);
    else
      assert_true(is[a] == is[a + 1]);
  }
}

/* The core of a side with a radius lies within the radius of every place [SET-3], and covers most of the part that
 * does. */
static void check_core(const double core[2], bool has, const double side[2], double radius) {
  double lo = side[1] - 2 * radius, hi = side[0] + 2 * radius, slack = side[1] - side[0] - 2 * radius;
  if (has)
    assert_true(lo <= core[0] && core[1] <= hi && core[0] <= lo + slack / 2 && core[1] >= hi - slack / 2);
  else
    assert_true(hi - lo < slack);
}

/* Which sides have cores, how much is not known of the others, and the rectangles used for the sites. */
static void test_sides(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  size_t wide = 0;
  for (size_t round = 0; round < test_cases(200); round++) {
    half_case c;
    dyd_engine_options o;
    dyd_dyadic eps;
    dyd_rect rect;
    double most = 0, d[4], was[4];
    half_case_new(&c, &r, 160);
    run_coarsely(&c, &o, test_between(&r, 1, 6));
    dyd_dyadic_init(&eps);
    dyd_rect_init(&rect);
    assert_int_equal(DYD_OK, dyd_firm_eps(&eps, c.e));
    for (size_t k = 0; k < c.n; k++) {
      bool core[2];
      assert_int_equal(DYD_OK, dyd_site_get_core(&rect, core, c.e, (uint32_t)k));
      dyd_rect_get_d(d, &rect);
      dyd_sites_get_d(was, dyd_engine_sites(c.e), k);
      for (int a = 0; a < 2; a++) {
        if (c.radius[k][a])
          check_core(&d[2 * a], core[a], &was[2 * a], (double)c.radius[k][a] / RADIUS_UNIT);
        else
          assert_true(core[a] == c.fixed[k][a]);
        wide += c.radius[k][a] && core[a];
      }
      double x = core[0] ? 0 : d[1] - d[0], y = core[1] ? 0 : d[3] - d[2];
      most = fmax(most, hypot(x, y));
      check_added(&c, &eps, k, &rect, core);
    }
    double e = dyd_dyadic_get_d(&eps, DYD_UP);
    assert_true(most <= e && (most == 0 ? e == 0 : e <= 4 * most));
    dyd_rect_clear(&rect);
    dyd_dyadic_clear(&eps);
    dyd_engine_free(c.e);
  }
  print_message("%zu sides with a radius have a core\n", wide);
  assert_true(wide > test_cases(200) / 2);
}

static bool same_interval(const dyd_interval *a, const dyd_interval *b) {
  return dyd_dyadic_cmp(&a->lo, &b->lo) == 0 && dyd_dyadic_cmp(&a->hi, &b->hi) == 0;
}

static dyd_status fixed_narrow(dyd_interval *out, void *user, const dyd_request *q, dyd_error *err) {
  (void)user, (void)q, (void)err;
  return dyd_interval_set_d(out, 1, 2) == DYD_OK ? DYD_FIXED : DYD_E_STREAM;
}

/* A callback that never knows more than [1,2], claimed to be the root of 2, next to the same place by expressions, and
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
  assert_int_equal(DYD_OK, dyd_engine_add_stream(e, s, NULL));
  engine_add_text(e, "sqrt(2)", "sqrt(3)");
  mpq_clears(coeff[0], coeff[1], coeff[2], lo, hi, NULL);
}

/* A coordinate declared fixed does not change: intervals narrower than first answers, places that are joined. */
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
      assert_int_equal(DYD_OK, dyd_site_get_core(&was[k], fixed[k], e, k));
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

/* Expressions and roots next to one interval, in a file of the usual kind, x and y in either order: few bits are spent
 * where bits cannot decide. */
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

/* Another user of a coordinate brings it to its end: the side here is as wide as before, and its core is that end. */
static void test_shared(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_engine_options o;
  dyd_outcome outcome;
  dyd_real *x, *y;
  dyd_stream *s;
  dyd_rect r;
  bool core[2];
  assert_int_equal(DYD_OK, dyd_real_new(&x, tiring_narrow, NULL, NULL));
  assert_int_equal(DYD_OK, dyd_real_parse(&y, "sqrt(3)", 7, NULL));
  assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, dyd_real_ref(x), y));
  assert_int_equal(DYD_OK, dyd_engine_add_stream(e, s, NULL));
  engine_add_text(e, "0", "0");
  dyd_rect_init(&r);
  dyd_engine_options_init(&o);
  o.start_bits = o.max_bits = 4;
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
  assert_int_equal(DYD_OK, dyd_site_get_core(&r, core, e, 0));
  assert_true(!core[0] && !core[1]);
  assert_int_equal(DYD_FIXED, dyd_real_narrow(x, 20, 20, NULL));
  assert_int_equal(DYD_OK, dyd_site_get_core(&r, core, e, 0));
  assert_true(core[0] && !core[1] && same_interval(&r.x, dyd_real_interval(x)));
  dyd_rect_clear(&r);
  dyd_real_free(x);
  dyd_engine_free(e);
}

/* A coordinate measured again is fixed all the same. */
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

/* Computed points with a radius: all that is open is so for good, which is seen early, and more bits change nothing. */
static void test_radius(void **state) {
  (void)state;
  static const char *const text[][2] = {{"sqrt(2)+-0.4", "0+-0.4"},
                                        {"0+-0.4", "sqrt(3)+-0.4"},
                                        {"2+-0.4", "2+-0.4"},
                                        {"sqrt(5)+-0.4", "e+-0.4"},
                                        {"1/3+-0.4", "pi/7+-0.4"}};
  dyd_engine *e = engine_new(), *fine = engine_new();
  dyd_engine_options o;
  dyd_outcome outcome;
  for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
    engine_add_text(e, text[k][0], text[k][1]);
    engine_add_text(fine, text[k][0], text[k][1]);
  }
  engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
  assert_true(engine_counters(e).bits_most <= 64);
  dyd_engine_options_init(&o);
  o.start_bits = o.max_bits = 2000;
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, fine, &o, NULL));
  assert_same_statuses(e, fine);
  dyd_engine_free(fine);
  dyd_engine_free(e);
}

/* Points (-1,0), (1,0), (0,h), (0,-h) with radius 0.4: 0,1 is legal if and only if h > 0.4 + sqrt(2.12), which takes
 * 100 bits to see, and for equality is never seen. */
static void test_near_radius(void **state) {
  (void)state;
  static const struct {
    const char *h, *minus_h;
    dyd_pair_status status;
    dyd_outcome outcome;
  } wanted[] = {
      {"0.4+sqrt(2.12)+2^-20+-0.4", "-0.4-sqrt(2.12)-2^-20+-0.4", DYD_LEGAL, DYD_OUTCOME_DECIDED},
      {"0.4+sqrt(2.12)-2^-20+-0.4", "-0.4-sqrt(2.12)+2^-20+-0.4", DYD_INDETERMINATE, DYD_OUTCOME_FIXPOINT},
  };
  for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++) {
    dyd_engine *e = engine_new();
    dyd_engine_options o;
    engine_add_text(e, "-1+-0.4", "0+-0.4");
    engine_add_text(e, "1+-0.4", "0+-0.4");
    engine_add_text(e, "0+-0.4", wanted[k].h);
    engine_add_text(e, "0+-0.4", wanted[k].minus_h);
    dyd_engine_options_init(&o);
    o.start_bits = 10;
    o.max_bits = 400;
    engine_run(e, &o, wanted[k].outcome);
    assert_int_equal(wanted[k].status, dyd_delaunay_status(dyd_engine_delaunay(e), 0, 1));
    assert_true(engine_counters(e).bits_most <= 100);
    dyd_engine_free(e);
  }
}

/* Sites that may be nearest whatever is refined [NEAR-5]: few bits. Beyond the radius: all the bits needed. */
static void test_nearest(void **state) {
  (void)state;
  static const struct {
    const char *x, *y;
    dyd_outcome outcome;
    size_t count;
  } at[] = {{"sqrt(2)/2", "sqrt(3)/3", DYD_OUTCOME_FIXPOINT, 2},
            {"sqrt(2)/2", "0", DYD_OUTCOME_FIXPOINT, 2},
            {"0", "sqrt(3)/3", DYD_OUTCOME_DECIDED, 1},
            {"sqrt(2)/2+-0.1", "0+-0.1", DYD_OUTCOME_FIXPOINT, 2}};
  for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
    dyd_engine *e = engine_new();
    dyd_index_list near = {0};
    dyd_outcome outcome;
    dyd_stream *s;
    dyd_real *x, *y;
    bool sure;
    engine_add_text(e, "0+-0.25", "sqrt(2)-sqrt(2)+-0.25");
    engine_add_text(e, "sqrt(2)+-0.25", "0+-0.25");
    engine_add_text(e, "5", "sqrt(31)");
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.start_bits = o.max_bits = 20;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
    assert_int_equal(DYD_OK, dyd_real_parse(&x, at[k].x, strlen(at[k].x), NULL));
    assert_int_equal(DYD_OK, dyd_real_parse(&y, at[k].y, strlen(at[k].y), NULL));
    assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, x, y));
    assert_int_equal(DYD_OK, dyd_engine_nearest(&near, &sure, &outcome, e, s, NULL, NULL));
    assert_int_equal(at[k].outcome, outcome);
    assert_int_equal(at[k].count, near.count);
    assert_true(engine_counters(e).bits_most <= 64);
    dyd_index_list_clear(&near);
    dyd_stream_free(s);
    dyd_engine_free(e);
  }
}

/* Graphs of neighbours: edges that stay possible for good end with few bits [NEAR-6], other edges are refined until
 * they are certain; equal distances of points that are not exact are not proved. */
static void test_graphs(void **state) {
  (void)state;
  static const struct {
    const char *at[4][2];
    size_t certain[3], possible[3];
    dyd_outcome outcome[3];
    int64_t bits;
  } sets[] = {
      /* all with radii */
      {{{"0+-0.1", "sqrt(2)-sqrt(2)+-0.1"}, {"sqrt(2)+-0.1", "0+-0.1"}, {"0+-0.1", "sqrt(2)+-0.1"}},
       {2, 2, 2},
       {2, 1, 0},
       {DYD_OUTCOME_FIXPOINT, DYD_OUTCOME_FIXPOINT, DYD_OUTCOME_DECIDED},
       64},
      /* the ends have radii, the points next to them have none: a Gabriel edge for some of their places */
      {{{"sqrt(2)+-0.1", "0+-0.1"}, {"-sqrt(2)+-0.1", "0+-0.1"}, {"sqrt(3)-sqrt(3)", "sqrt(2)"}},
       {2, 2, 2},
       {2, 1, 0},
       {DYD_OUTCOME_FIXPOINT, DYD_OUTCOME_FIXPOINT, DYD_OUTCOME_DECIDED},
       64},
      /* exact points tie, next to one that can be refined and has no part in it */
      {{{"0", "0"}, {"1", "0"}, {"0", "1"}, {"sqrt(2)*5", "sqrt(3)*5"}},
       {3, 3, 3},
       {2, 1, 0},
       {DYD_OUTCOME_FIXPOINT, DYD_OUTCOME_FIXPOINT, DYD_OUTCOME_DECIDED},
       64},
      /* 2 is nearer to 0 by 2^-140 */
      {{{"0", "0"}, {"sqrt(2)", "0"}, {"-sqrt(2)*3/5", "-sqrt(2)*4/5+2^-140"}},
       {3, 2, 2},
       {0, 0, 0},
       {DYD_OUTCOME_DECIDED, DYD_OUTCOME_DECIDED, DYD_OUTCOME_DECIDED},
       300},
      /* 1 and 2 are equally far */
      {{{"0", "0"}, {"sqrt(2)", "0"}, {"-sqrt(2)*3/5", "sqrt(2)*4/5"}},
       {2, 2, 2},
       {2, 0, 0},
       {DYD_OUTCOME_BUDGET, DYD_OUTCOME_DECIDED, DYD_OUTCOME_DECIDED},
       400},
  };
  for (size_t k = 0; k < sizeof sets / sizeof *sets; k++) {
    for (int g = 0; g < 3; g++) {
      dyd_engine *e = engine_new();
      dyd_graph_list list = {0};
      dyd_outcome outcome;
      for (int i = 0; i < 4 && sets[k].at[i][0]; i++) engine_add_text(e, sets[k].at[i][0], sets[k].at[i][1]);
      dyd_engine_options o;
      dyd_engine_options_init(&o);
      o.start_bits = 20;
      o.max_bits = 400;
      assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
      assert_int_equal(DYD_OK, dyd_engine_graph(&list, &outcome, e, (dyd_graph)g, &o, NULL));
      size_t certain = 0;
      for (size_t n = 0; n < list.count; n++) certain += list.item[n].sure;
      assert_int_equal(sets[k].certain[g], certain);
      assert_int_equal(sets[k].certain[g] + sets[k].possible[g], list.count);
      assert_int_equal(sets[k].outcome[g], outcome);
      assert_true(engine_counters(e).bits_most <= sets[k].bits);
      dyd_graph_list_clear(&list);
      dyd_engine_free(e);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_few),         cmocka_unit_test(test_faces),          cmocka_unit_test(test_runs),
      cmocka_unit_test(test_sides),       cmocka_unit_test(test_fixed_for_good), cmocka_unit_test(test_text),
      cmocka_unit_test(test_shared),      cmocka_unit_test(test_measured),       cmocka_unit_test(test_radius),
      cmocka_unit_test(test_near_radius), cmocka_unit_test(test_nearest),        cmocka_unit_test(test_graphs)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
