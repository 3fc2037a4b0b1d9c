/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact points on circles and lines, and at corners, beside regions [SET-1] [SET-4]: pairs that are said to stay open
 * do, for rectangles that go on to hold the true points, by the literal oracle; and runs end there, with points that
 * the engine proves to be on one circle itself. */
#include "engine/help.h"
#include "engine/settle.h"
#include "engine/ties.h"
#include "oracle/oracle.h"
#include "rect/rect.h"

#include <math.h>

enum { MOST_SITES = 8 };

/* Sites: boxes, and places that are hidden in rectangles as wide as asked; all in 64ths. Some boxes are off the grid of
 * places, so that their corners are on no circle of these; others have middles and corners on it, or no height. Soft
 * ones are regions around hidden places; soft or not, places are at corners and sides of some. */
enum { UNIT = 64 };

typedef struct circled {
  dyd_engine *e;
  size_t n;
  bool box[MOST_SITES], soft[MOST_SITES];
  int at[MOST_SITES][2], half[MOST_SITES][2];
  test_random random;
} circled;

typedef struct hidden_side {
  circled *c;
  int at;
} hidden_side;

static dyd_status hidden_narrow(dyd_interval *out, void *user, const dyd_request *q, dyd_error *err) {
  hidden_side *s = user;
  double w = ldexp(1, -(int)q->bits), below = w * (double)test_below(&s->c->random, 9) / 8, had[2] = {-1e9, 1e9};
  (void)err;
  if (!dyd_interval_is_unset(out)) dyd_interval_get_d(&had[0], &had[1], out);
  return dyd_interval_set_d(out, fmax(had[0], (double)s->at / UNIT - below),
                            fmin(had[1], (double)s->at / UNIT + (w - below)));
}

/* Twice the area of a triangle, and the in-circle determinant. */
static long area_of(const int *a, const int *b, const int *c) {
  return (long)(b[0] - a[0]) * (c[1] - a[1]) - (long)(c[0] - a[0]) * (b[1] - a[1]);
}

static long power_of(const int *a, const int *b, const int *c, const int *d) {
  const int *p[3] = {a, b, c};
  long sum = 0;
  for (int k = 0; k < 3; k++) {
    long x = p[k][0] - d[0], y = p[k][1] - d[1];
    sum += (x * x + y * y) * area_of(d, p[(k + 1) % 3], p[(k + 2) % 3]);
  }
  return sum;
}

static dyd_status hidden_decide(bool *proved, dyd_relation relation, int (*at)[2], size_t count) {
  *proved = relation != DYD_COINCIDENT;
  for (size_t k = 1; k < count; k++)
    for (size_t l = 0; l < k; l++) *proved = *proved && (at[k][0] != at[l][0] || at[k][1] != at[l][1]);
  for (size_t k = 2; k < count && *proved && relation == DYD_COLLINEAR; k++)
    *proved = area_of(at[0], at[1], at[k]) == 0;
  if (*proved && relation == DYD_COCIRCULAR) *proved = area_of(at[0], at[1], at[2]) != 0;
  for (size_t k = 3; k < count && *proved && relation == DYD_COCIRCULAR; k++)
    *proved = power_of(at[0], at[1], at[2], at[k]) == 0;
  return DYD_OK;
}

static dyd_status hidden_prove(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                               dyd_error *err) {
  const circled *c = user;
  int at[MOST_SITES][2];
  (void)err;
  *proved = false;
  for (size_t k = 0; k < count; k++) {
    if (c->box[site[k]]) return DYD_OK;
    memcpy(at[k], c->at[site[k]], sizeof at[k]);
  }
  return hidden_decide(proved, relation, at, count);
}

static int place_of(const circled *c, const dyd_site_place *p, int a) {
  int half = c->half[p->site][a];
  return c->at[p->site][a] + (p->place == 0 ? 0 : (p->place - 1) >> a & 1 ? half : -half);
}

static dyd_status hidden_prove_places(bool *proved, void *user, dyd_relation relation, const dyd_site_place *chosen,
                                      size_t count) {
  const circled *c = user;
  int at[MOST_SITES][2];
  for (size_t k = 0; k < count; k++)
    for (int a = 0; a < 2; a++) at[k][a] = place_of(c, &chosen[k], a);
  return hidden_decide(proved, relation, at, count);
}

static dyd_status hidden_place(dyd_rect *out, void *user, const dyd_site_place *at) {
  const circled *c = user;
  double x = (double)place_of(c, at, 0) / UNIT, y = (double)place_of(c, at, 1) / UNIT;
  return c->box[at->site] ? dyd_rect_set_d(out, x, x, y, y) : DYD_OK;
}

/* Boxes are their regions, and places points. */
static dyd_status hidden_meet(bool *proved, void *user, const uint32_t site[2], bool discs) {
  const uint32_t i = site[0], j = site[1];
  const circled *c = user;
  *proved = !discs;
  for (int a = 0; a < 2; a++) *proved = *proved && abs(c->at[i][a] - c->at[j][a]) <= c->half[i][a] + c->half[j][a];
  return DYD_OK;
}

static dyd_prover hidden_prover(circled *c) {
  return (dyd_prover){hidden_prove, hidden_prove_places, hidden_place, hidden_meet, c};
}

static bool is_new_place(const circled *c, const int *at) {
  for (size_t k = 0; k < c->n; k++)
    if (c->at[k][0] == at[0] && c->at[k][1] == at[1]) return false;
  return true;
}

static void draw_place(int *at, test_random *r, bool line) {
  static const int round[12][2] = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                                   {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
  const int *of = round[test_below(r, 12)];
  bool known = test_chance(r, 5) ? false : true;
  for (int a = 0; a < 2; a++) at[a] = UNIT * (known && !line ? of[a] : (int)test_between(r, -6, 6));
  if (known && line) at[1] = 2 * UNIT + at[0] / 2;
}

/* A place at a corner of a box, or on a side. */
static void touch_box(int *at, const circled *c, size_t k, test_random *r) {
  const bool corner = test_chance(r, 2), along = test_chance(r, 2);
  for (int a = 0; a < 2; a++) {
    const int half = c->half[k][a], end = test_chance(r, 2) ? half : -half;
    at[a] = c->at[k][a] + (corner || along == (a == 1) ? end : (int)test_between(r, -half, half));
  }
}

/* Side of site number n: hidden, an interval, or around a hidden place. */
static void side_new(dyd_real **x, const circled *c, hidden_side *side, mpq_t end[2]) {
  const bool hidden = !c->box[c->n] || c->soft[c->n];
  assert_int_equal(DYD_OK,
                   hidden ? dyd_real_new(x, hidden_narrow, NULL, side) : dyd_real_from_interval(x, end[0], end[1]));
  if (!c->soft[c->n]) return;
  mpq_sub(end[1], end[1], end[0]);
  mpq_div_2exp(end[1], end[1], 1);
  assert_int_equal(DYD_OK, dyd_real_widen(x, *x, end[1]));
}

static void circled_add(circled *c, hidden_side side[2], bool box, const int *at, test_random *r) {
  dyd_real *x[2];
  dyd_stream *s;
  mpq_t end[2];
  mpq_inits(end[0], end[1], NULL);
  c->box[c->n] = box;
  c->soft[c->n] = box && test_chance(r, 2);
  int shape = (int)test_below(r, 3); /* off the grid, on it, flat */
  for (int a = 0; a < 2; a++) {
    c->at[c->n][a] = at[a] + (box && shape == 0 ? 2 * (int)test_between(r, -4, 4) + 1 : 0);
    c->half[c->n][a] = !box ? 0 : shape == 0 ? 4 * (int)test_between(r, 1, 20) : UNIT * (int)test_between(r, 1, 2);
    if (shape == 2 && a == 1) c->half[c->n][a] = 0;
    side[a] = (hidden_side){c, c->at[c->n][a]};
    mpq_set_si(end[0], c->at[c->n][a] - c->half[c->n][a], UNIT);
    mpq_set_si(end[1], c->at[c->n][a] + c->half[c->n][a], UNIT);
    mpq_canonicalize(end[0]);
    mpq_canonicalize(end[1]);
    side_new(&x[a], c, &side[a], end);
  }
  c->n++;
  assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, x[0], x[1]));
  assert_int_equal(DYD_OK, dyd_engine_add_stream(c->e, s, NULL));
  mpq_clears(end[0], end[1], NULL);
}

static void circled_new(circled *c, hidden_side side[MOST_SITES][2], test_random *r) {
  bool line = test_chance(r, 4);
  size_t n = (size_t)test_between(r, 5, MOST_SITES), boxes = 0;
  *c = (circled){.e = engine_new(), .random = *r};
  test_below(r, 2);
  while (c->n < n) {
    int at[2];
    draw_place(at, r, line);
    bool box = test_chance(r, 5) || (c->n + 1 == n && !boxes);
    size_t k = test_below(r, c->n + 1);
    if (!box && k < c->n && c->box[k]) touch_box(at, c, k, r);
    if (!is_new_place(c, at)) continue;
    boxes += box;
    circled_add(c, side[c->n], box, at, r);
  }
  c->e->prover = hidden_prover(c);
}

/* Boxes as they are; the others narrowed to their places, or to something that holds them. */
static void circled_narrow(orc_case *out, const circled *c, test_random *r, bool whole) {
  out->n = 0;
  for (size_t k = 0; k < c->n; k++) {
    orc_rect *q = &out->rect[out->n++];
    for (int a = 0; a < 2; a++) {
      const bool still = whole || (c->box[k] && !c->soft[k]);
      int below = still ? 0 : (int)test_below(r, 3), above = still ? 0 : (int)test_below(r, 3);
      mpq_set_si(q->e[2 * a], 64L * (c->at[k][a] - c->half[k][a]) - below, 4096);
      mpq_set_si(q->e[2 * a + 1], 64L * (c->at[k][a] + c->half[k][a]) + above, 4096);
      mpq_canonicalize(q->e[2 * a]);
      mpq_canonicalize(q->e[2 * a + 1]);
    }
  }
}

static void check_circled(const circled *c, const dyd_settled_pair *pair, size_t count, test_random *r) {
  enum { WAYS = 4 };
  orc_pool pool;
  orc_case now;
  orc_pool_init(&pool);
  orc_case_init(&now);
  size_t mark = orc_mark(&pool);
  for (int way = 0; way < WAYS; way++) {
    circled_narrow(&now, c, r, way == 0);
    for (size_t k = 0; k < count; k++) {
      if (pair[k].possible) assert_true(orc_possible(&pool, &now, pair[k].i, pair[k].j));
      if (pair[k].unsure) assert_false(orc_legal(NULL, NULL, &pool, &now, pair[k].i, pair[k].j));
      orc_release(&pool, mark);
    }
  }
  orc_case_clear(&now);
  orc_pool_clear(&pool);
}

/* All pairs of all sites as if they were of one face, with nothing known of them; proved: by the prover. */
static size_t settle_circled(circled *c, test_random *r, bool proved) {
  dyd_settled_pair pair[MOST_SITES * MOST_SITES];
  uint32_t site[MOST_SITES];
  size_t count = 0, settled = 0;
  dyd_settle_work work = {SIZE_MAX, SIZE_MAX};
  dyd_settled by = {.prover = hidden_prover(c)};
  for (uint32_t k = 0; k < c->n; k++) site[k] = k;
  for (uint32_t i = 0; i < c->n; i++)
    for (uint32_t j = i + 1; j < c->n; j++) pair[count++] = (dyd_settled_pair){i, j, false, false};
  const dyd_index_list face = {.item = site, .count = c->n};
  assert_int_equal(DYD_OK, dyd_settle_face(pair, &work, proved ? &by : NULL, c->e, count, &face));
  check_circled(c, pair, count, r);
  for (size_t k = 0; k < count; k++) settled += dyd_pair_is_settled(&pair[k]);
  return settled;
}

static void test_pairs(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  size_t with = 0, without = 0, rounds = test_cases(150);
  for (size_t round = 0; round < rounds; round++) {
    circled c;
    hidden_side side[MOST_SITES][2];
    dyd_engine_options o;
    dyd_outcome outcome;
    circled_new(&c, side, &r);
    dyd_engine_options_init(&o);
    o.start_bits = o.max_bits = test_between(&r, 3, 20);
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, c.e, &o, NULL));
    with += settle_circled(&c, &r, true);
    without += settle_circled(&c, &r, false);
    dyd_engine_free(c.e);
  }
  print_message("%zu pairs settled, %zu of them without a circle\n", with, without);
  assert_true(with > without + rounds);
}

/* Ends without success, and open pairs stay open. */
static void test_run_ends(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  size_t ends[6] = {0}, rounds = test_cases(80);
  for (size_t round = 0; round < rounds; round++) {
    circled c;
    hidden_side side[MOST_SITES][2];
    dyd_engine_options o;
    dyd_outcome outcome;
    dyd_pair_list pairs = {0};
    circled_new(&c, side, &r);
    dyd_engine_options_init(&o);
    o.max_bits = 46;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, c.e, &o, NULL));
    ends[outcome]++;
    assert_int_equal(DYD_OK, dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(c.e)));
    for (size_t k = 0; outcome == DYD_OUTCOME_FIXPOINT && k < pairs.count; k++) {
      const dyd_settled_pair open = {pairs.item[k].i, pairs.item[k].j, true, true};
      if (pairs.item[k].status == DYD_INDETERMINATE) check_circled(&c, &open, 1, &r);
    }
    dyd_pair_list_clear(&pairs);
    dyd_engine_free(c.e);
  }
  print_message("of %zu runs %zu decided, %zu in vain, %zu at the budget\n", rounds, ends[DYD_OUTCOME_DECIDED],
                ends[DYD_OUTCOME_FIXPOINT], ends[DYD_OUTCOME_BUDGET]);
  assert_true(ends[DYD_OUTCOME_FIXPOINT] > rounds / 2 && ends[DYD_OUTCOME_BUDGET] < rounds / 3);
}

/* Roots on one circle, and on one line, beside a box that reaches across. */
static void test_roots(void **state) {
  static const char *const at[2][4][2] = {
      {{"sqrt(2)", "0"}, {"0", "sqrt(2)"}, {"-sqrt(2)", "0"}, {"0", "-sqrt(2)"}},
      {{"sqrt(2)", "0"}, {"2*sqrt(2)", "0"}, {"-sqrt(2)", "0"}, {"3*sqrt(2)", "0"}}};
  (void)state;
  for (int line = 0; line < 2; line++) {
    dyd_engine *e = engine_new();
    dyd_engine_options o;
    dyd_rect r;
    dyd_rect_init(&r);
    for (int k = 0; k < 4; k++) engine_add_text(e, at[line][k][0], at[line][k][1]);
    assert_int_equal(DYD_OK, dyd_rect_set_d(&r, 0.875, 1.5, line ? -0.125 : 1, line ? 3 : 1.25));
    assert_int_equal(DYD_OK, dyd_engine_add_rect(e, &r, NULL));
    engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
    dyd_engine_options_init(&o);
    assert_true(engine_counters(e).bits_most < o.max_bits);
    dyd_rect_clear(&r);
    dyd_engine_free(e);
  }
}

/* A flat box on the line of roots, and boxes of which only an edge, or a corner, is on their line or circle. */
static void test_touching(void **state) {
  static const char *const at[][2] = {{"sqrt(2)", "0"}, {"sqrt(20)", "0"}, {"0", "sqrt(2)"}, {"-sqrt(2)", "0"}};
  static const double box[][4] = {{2, 3, 0, 0}, {2, 3, 0, 1}, {2, 3, -1, 0}, {5, 6, 0, 0}, {1, 3, 1, 3}};
  (void)state;
  for (size_t b = 0; b < sizeof box / sizeof *box; b++) {
    dyd_engine *e = engine_new();
    dyd_rect r;
    dyd_rect_init(&r);
    for (size_t k = 0; k < sizeof at / sizeof *at; k++)
      if (b == 4 || k != 3)
        engine_add_text(e, b == 4 && k == 1 ? "0" : at[k][0], b == 4 && k == 1 ? "-sqrt(2)" : at[k][1]);
    assert_int_equal(DYD_OK, dyd_rect_set_d(&r, box[b][0], box[b][1], box[b][2], box[b][3]));
    assert_int_equal(DYD_OK, dyd_engine_add_rect(e, &r, NULL));
    engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
    dyd_rect_clear(&r);
    dyd_engine_free(e);
  }
}

/* Regions around computable points, at a corner or side of which exact points are: nothing that is open can be decided,
 * and that is seen at once. The ends of pairs: regions, points at corners, others; of discs that pass such a point, one
 * end, both, or another site is there. */
static void test_corners(void **state) {
  static const char *const at[][9][2] = {
      {{"sqrt(2)+-3/4", "0+-3/4"}, {"sqrt(2)+3/4", "3/4"}, {"-sqrt(2)", "sqrt(3)"}},
      {{"-2", "-2"}, {"-pi+-3/2", "0+-3/2"}, {"-pi+-3/2", "e/3+-3/2"}, {"2", "sqrt(2)"}, {"3/2-pi", "-3/2"}},
      {{"sqrt(3)", "3/2"}, {"-pi+-3/2", "sqrt(2)+-3/2"}, {"3/2-pi", "sqrt(2)-3/2"}, {"e", "sqrt(2)+1"}},
      {{"11/8", "pi+1/4"},
       {"1/sqrt(7)+-1/4", "1+-1/4"},
       {"1/3", "-2"},
       {"3/2+-1/4", "pi+-1/4"},
       {"1/sqrt(7)-1/4", "3/4"},
       {"pi/7", "-1"}},
      {{"sqrt(2)+1+-1/4", "sqrt(2)+1+-1/4"},
       {"-9/4", "1/4-sqrt(2)"},
       {"sqrt(2)+5/4", "sqrt(2)+3/4"},
       {"pi/7", "1/3"},
       {"-2+-1/4", "-sqrt(2)+-1/4"},
       {"sqrt(2)+1", "pi/7"},
       {"-7/4", "-sqrt(2)-1/12"}}};
  (void)state;
  for (size_t n = 0; n < sizeof at / sizeof *at; n++) {
    dyd_engine *e = engine_new();
    for (int k = 0; k < 9 && at[n][k][0]; k++) engine_add_text(e, at[n][k][0], at[n][k][1]);
    engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
    assert_true(engine_counters(e).bits_most <= 512);
    dyd_engine_free(e);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_pairs), cmocka_unit_test(test_run_ends),
                                     cmocka_unit_test(test_roots), cmocka_unit_test(test_touching),
                                     cmocka_unit_test(test_corners)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
