/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Hundreds of rectangles narrowed bit by bit: after every update the pairs are those of a fresh run, except that legal
 * ones may have been carried over. One or a few of a crowd are narrowed, too: what of a large face cannot have changed
 * is kept [LOC-4]. The armed build re-checks every witness found near its faces against all sites, and the whole
 * skeleton after every update, exactly [LOC-1] [LOC-2] [LOC-3]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/faces.h"
#include "delaunay/harness.h"
#include "delaunay/local_filter.h"
#include "delaunay/table.h"
#include "delaunay/undecided.h"
#include "legal/witness.h"
#include "support/failing_memory.h"
#include "support/random.h"
#include <cmocka.h>
#include <dyadel/delaunay.h>
#include <math.h>
#include <string.h>

enum { MOST = 400 };

static size_t hidden, aliases, failures;

/* Boxes of multiples of `unit`. */
typedef struct cloud {
  size_t n;
  double unit, x0[MOST], x1[MOST], y0[MOST], y1[MOST];
} cloud;

static double half_width(test_random *g, size_t n, unsigned wide) {
  double spacing = 1 / sqrt((double)n);
  if (!test_chance(g, wide)) return test_chance(g, 2) ? 0 : 0.01 * spacing * test_unit(g);
  return spacing * test_unit(g) * (test_chance(g, 6) ? 2 : 0.6);
}

static double snap(const cloud *c, double x) {
  return floor(x / c->unit) * c->unit;
}

/* Uniform, or most of them around a few places and on a ring. */
static void make(cloud *c, test_random *g) {
  static const double unit[3] = {0x1p-40, 0x1p-12, 0x1p-6};
  unsigned wide = 2 + (unsigned)test_below(g, 12), shape = (unsigned)test_below(g, 3);
  c->n = 20 + (size_t)test_below(g, test_chance(g, 4) ? MOST - 20 : 100);
  c->unit = unit[test_below(g, 3)];
  for (size_t i = 0; i < c->n; i++) {
    double x = test_unit(g), y = test_unit(g), h = half_width(g, c->n, wide);
    if (shape == 1) x = floor(3 * x) / 3 + 0.05 * test_unit(g), y = floor(3 * y) / 3 + 0.05 * test_unit(g);
    if (shape == 2 && i % 2) x = 0.5 + 0.5 * cos(6.3 * y), y = 0.5 + 0.5 * sin(6.3 * y);
    c->x0[i] = snap(c, x - h);
    c->y0[i] = snap(c, y - h);
    c->x1[i] = fmax(c->x0[i], snap(c, x + h));
    c->y1[i] = fmax(c->y0[i], snap(c, y + h));
  }
}

/* A random part of [lo,hi]: any, an end, or nearly all. */
static void narrow_side(const cloud *c, test_random *g, double *lo, double *hi) {
  double a = test_unit(g), b = test_unit(g), width = *hi - *lo, low = *lo;
  if (test_chance(g, 4)) b = a;
  if (test_chance(g, 4)) a = 0;
  if (test_chance(g, 4)) b = 1;
  double p = low + snap(c, fmin(a, b) * width), q = low + snap(c, fmax(a, b) * width);
  *lo = fmax(*lo, p);
  *hi = fmax(*lo, fmin(*hi, q));
}

static dyd_pair_list pairs_of(const dyd_delaunay *pd) {
  dyd_pair_list l = {0};
  assert_int_equal(dyd_delaunay_pairs(&l, pd), DYD_OK);
  return l;
}

static void table_holds(const dyd_delaunay *pd) {
  char message[MESSAGE_SIZE];
  if (!table_is_right(message, pd)) fail_msg("%s", message);
}

/* A pair that several faces list is shown by one and hidden in the others; those have to know, too, when it is no
 * longer possible: the one that shows it may go. */
static size_t listed_are_possible(const dyd_delaunay *pd, const dyd_delaunay *fresh) {
  size_t found = 0;
  if (pd->open.kind != DYD_LISTED) return 0;
  for (size_t f = 0; f < pd->open.count; f++)
    for (uint32_t q = 0; q < pd->open.face[f].pairs; q++) {
      dyd_vertex_pair p = pd->open.pair[pd->open.face[f].first_pair + q];
      uint32_t i = pd->sk.reps.site[p.i], j = pd->sk.reps.site[p.j];
      assert_int_not_equal(dyd_delaunay_status(fresh, i, j), DYD_ILLEGAL);
      assert_false(dyd_pair_is_legal(pd, p.i, p.j));
      found += p.hidden;
    }
  return found;
}

static size_t same_as_fresh(const dyd_sites *s, const dyd_delaunay *pd) {
  dyd_delaunay *fresh = NULL;
  size_t carried = 0;
  assert_false(dyd_delaunay_is_capped(pd));
  table_holds(pd);
  assert_int_equal(dyd_delaunay_new(&fresh, s, NULL, NULL), DYD_OK);
  dyd_pair_list is = pairs_of(pd), want = pairs_of(fresh);
  assert_int_equal(is.count, want.count);
  for (size_t k = 0; k < is.count; k++) {
    assert_true(is.item[k].i == want.item[k].i && is.item[k].j == want.item[k].j);
    carried += is.item[k].status != want.item[k].status;
    if (is.item[k].status != want.item[k].status)
      assert_true(is.item[k].status == DYD_LEGAL && want.item[k].status == DYD_INDETERMINATE);
  }
  hidden += listed_are_possible(pd, fresh);
  dyd_pair_list_clear(&is);
  dyd_pair_list_clear(&want);
  dyd_delaunay_free(fresh);
  return carried;
}

/* Only equal points are one site; a box whose representative falls on a point is none. */
static void aliases_are_points(const cloud *c, const dyd_delaunay *pd) {
  for (uint32_t i = 0; i < c->n; i++) {
    uint32_t a = dyd_delaunay_alias(pd, i);
    if (a == i) continue;
    assert_true(c->x0[i] == c->x1[i] && c->x0[a] == c->x1[a] && c->x0[i] == c->x0[a]);
    assert_true(c->y0[i] == c->y1[i] && c->y0[a] == c->y1[a] && c->y0[i] == c->y0[a]);
    aliases++;
  }
}

/* The sites of the cloud, and their statuses; with a cap on pairs, not all of them. */
static dyd_delaunay *triangulate(dyd_sites **s, const cloud *c, const dyd_delaunay_options *o) {
  dyd_delaunay *pd = NULL;
  *s = NULL;
  assert_int_equal(dyd_sites_new(s), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(*s, c->n, c->x0, c->x1, c->y0, c->y1), DYD_OK);
  dyd_status status = dyd_delaunay_new(&pd, *s, o, NULL);
  assert_int_equal(status, dyd_delaunay_is_capped(pd) ? DYD_CAPPED : DYD_OK);
  assert_true(o || status == DYD_OK);
  return pd;
}

static void finish(dyd_sites *s, dyd_delaunay *pd) {
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void narrow_to(dyd_sites *s, size_t i, double x0, double x1, double y0, double y1) {
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(dyd_rect_set_d(&r, x0, x1, y0, y1), DYD_OK);
  assert_int_equal(dyd_sites_narrow(s, i, &r), DYD_OK);
  dyd_rect_clear(&r);
}

static void narrow(cloud *c, test_random *g, dyd_sites *s, size_t i) {
  narrow_side(c, g, &c->x0[i], &c->x1[i]);
  narrow_side(c, g, &c->y0[i], &c->y1[i]);
  narrow_to(s, i, c->x0[i], c->x1[i], c->y0[i], c->y1[i]);
}

/* Sometimes memory fails first, once, at every allocation in turn: the old result is kept, and the update can be
 * repeated. */
static void update(dyd_delaunay *pd, test_random *g, const uint32_t *changed, size_t count, unsigned unfiltered) {
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = test_chance(g, unfiltered),
                            .max_pairs = pd->options.max_pairs};
  dyd_status status = DYD_E_NOMEM;
  for (size_t k = test_chance(g, 12); status == DYD_E_NOMEM; k++) {
    countdown = k;
    status = dyd_delaunay_update(pd, changed, count, &o, NULL);
    countdown = 0;
    if (status != DYD_E_NOMEM) break;
    failures++;
    table_holds(pd);
  }
  assert_int_equal(status, dyd_delaunay_is_capped(pd) ? DYD_CAPPED : DYD_OK);
}

static void step(cloud *c, test_random *g, dyd_sites *s, dyd_delaunay *pd) {
  uint32_t changed[MOST];
  size_t count = 0;
  unsigned one_in = 1 + (unsigned)test_below(g, 20);
  for (size_t i = 0; i < c->n; i++) {
    if (!test_chance(g, one_in)) continue;
    narrow(c, g, s, i);
    changed[count++] = (uint32_t)i;
  }
  update(pd, g, changed, count, 30);
}

/* Boxes and points on a coarse lattice, in an odd number: several strips in the armed build. */
static void test_aliases(void **state) {
  (void)state;
  test_random g = test_random_start("aliases");
  cloud *c = malloc(sizeof *c);
  assert_non_null(c);
  for (size_t q = 0; q < test_cases_all(300); q++) {
    dyd_sites *s;
    do {
      make(c, &g);
    } while (c->n % 2 == 0 || c->unit < 0x1p-8);
    dyd_delaunay *pd = triangulate(&s, c, NULL);
    aliases_are_points(c, pd);
    finish(s, pd);
  }
  fprintf(stderr, "# aliases %zu\n", aliases);
  assert_true(aliases > 0);
  free(c);
}

static void test_fresh(void **state) {
  (void)state;
  test_random g = test_random_start("update");
  cloud *c = malloc(sizeof *c);
  size_t carried = 0;
  assert_non_null(c);
  for (size_t q = 0; q < test_cases_all(12); q++) {
    dyd_sites *s;
    make(c, &g);
    dyd_delaunay *pd = triangulate(&s, c, NULL);
    for (int k = 0; k < 4; k++) {
      step(c, &g, s, pd);
      carried += same_as_fresh(s, pd);
    }
    finish(s, pd);
  }
  fprintf(stderr, "# carried over: %zu; pairs hidden: %zu; failures: %zu\n", carried, hidden, failures);
  assert_true(hidden > 0 && failures > 0);
  free(c);
}

/* ---- a crowd, few of whom are narrowed ---- */

/* Boxes that overlap many others, some of them thin and a few far out. */
static void make_crowd(cloud *c, test_random *g) {
  static const double unit[2] = {0x1p-40, 0x1p-8};
  double spread = 0.3 + 3 * test_unit(g);
  c->n = 12 + (size_t)test_below(g, 120);
  c->unit = unit[test_below(g, 2)];
  for (size_t i = 0; i < c->n; i++) {
    double far = test_chance(g, 40) ? 4 : 1, h = spread / sqrt((double)c->n) * test_unit(g);
    double x = far * test_unit(g), y = far * test_unit(g);
    if (test_chance(g, 8)) h *= 0.01;
    c->x0[i] = snap(c, x - h);
    c->y0[i] = snap(c, y - h);
    c->x1[i] = fmax(c->x0[i], snap(c, x + h));
    c->y1[i] = fmax(c->y0[i], snap(c, y + h));
  }
}

/* Mostly one, at most five, sometimes one of them twice. */
static void step_few(cloud *c, test_random *g, dyd_sites *s, dyd_delaunay *pd) {
  uint32_t changed[6];
  size_t count = 0;
  do {
    changed[count] = (uint32_t)test_below(g, c->n);
    narrow(c, g, s, changed[count++]);
  } while (count < 5 && test_chance(g, 3));
  if (test_chance(g, 10)) changed[count++] = changed[0];
  update(pd, g, changed, count, 100);
}

static void test_crowd(void **state) {
  (void)state;
  test_random g = test_random_start("crowd");
  cloud *c = malloc(sizeof *c);
  size_t carried = 0, before = hidden;
  assert_non_null(c);
  for (size_t q = 0; q < test_cases_all(25); q++) {
    dyd_sites *s;
    make_crowd(c, &g);
    dyd_delaunay *pd = triangulate(&s, c, NULL);
    for (int k = 0; k < 15; k++) {
      step_few(c, &g, s, pd);
      carried += same_as_fresh(s, pd);
    }
    finish(s, pd);
  }
  fprintf(stderr, "# carried over: %zu; pairs hidden: %zu; failures: %zu\n", carried, hidden - before, failures);
  assert_true(hidden > before);
  free(c);
}

/* Twelve sites on a circle; the last box becomes a point, and an indeterminate pair becomes a tie. */
static void test_last_point(void **state) {
  static const double x[12] = {5, 4, 3, 0, -3, -4, -5, -4, -3, 0, 3, 4},
                      y[12] = {0, 3, 4, 5, 4, 3, 0, -3, -4, -5, -4, -3};
  cloud *c = malloc(sizeof *c);
  test_random g = test_random_start("last point");
  size_t count[4];
  (void)state;
  assert_non_null(c);
  c->n = 12;
  for (uint32_t last = 0; last < 12; last++) {
    dyd_sites *s;
    for (uint32_t i = 0; i < 12; i++) {
      double h = i == last ? 0.25 : 0;
      c->x0[i] = x[i] - h, c->x1[i] = x[i] + h, c->y0[i] = y[i] - h, c->y1[i] = y[i] + h;
    }
    dyd_delaunay *pd = triangulate(&s, c, NULL);
    dyd_delaunay_count(count, pd);
    assert_true(count[DYD_INDETERMINATE] > 40);
    narrow_to(s, last, x[last], x[last], y[last], y[last]);
    update(pd, &g, &last, 1, 100);
    dyd_delaunay_count(count, pd);
    assert_int_equal(count[DYD_TIE], 54);
    same_as_fresh(s, pd);
    finish(s, pd);
  }
  free(c);
}

/* ---- not all pairs are stored ---- */

/* Nothing false is stated; returns how many pairs are open that would be impossible without the cap. */
static size_t is_sound(const dyd_sites *s, const dyd_delaunay *pd, size_t n) {
  dyd_delaunay *all = NULL;
  size_t open = 0;
  assert_int_equal(dyd_delaunay_new(&all, s, NULL, NULL), DYD_OK);
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = i + 1; j < n; j++) {
      dyd_pair_status is = dyd_delaunay_status(pd, i, j), want = dyd_delaunay_status(all, i, j);
      if (is == DYD_ILLEGAL || want == DYD_LEGAL) assert_true(is == want || is == DYD_INDETERMINATE);
      if (is == DYD_LEGAL) assert_int_not_equal(want, DYD_ILLEGAL);
      open += is == DYD_INDETERMINATE && want == DYD_ILLEGAL;
    }
  dyd_delaunay_free(all);
  return open;
}

static void test_capped(void **state) {
  (void)state;
  test_random g = test_random_start("capped");
  cloud *c = malloc(sizeof *c);
  size_t open = 0;
  assert_non_null(c);
  for (size_t q = 0; q < test_cases_all(12); q++) {
    dyd_sites *s;
    make_crowd(c, &g);
    dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = 1 + (size_t)test_below(&g, 4 * c->n)};
    dyd_delaunay *pd = triangulate(&s, c, &o);
    for (int k = 0; k < 8; k++) {
      step_few(c, &g, s, pd);
      table_holds(pd);
      open += is_sound(s, pd, c->n);
    }
    finish(s, pd);
  }
  fprintf(stderr, "# open by the cap: %zu\n", open);
  assert_true(open > 0);
  free(c);
}

/* ---- any certain edges will do, and any centre ---- */

/* Takes some edges back, and finds the faces that this gives; those of exact points are settled, and fall apart. */
static void forget_edges(dyd_delaunay *pd, test_random *g) {
  dyd_work w;
  unsigned one_in = 2 + (unsigned)test_below(g, 6);
  for (uint32_t t = 0; t < pd->sk.mesh.count; t++)
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++)
      if (dyd_edge_is_first(&pd->sk.mesh, h) && test_chance(g, one_in)) dyd_set_certain(&pd->sk, h, false);
  dyd_table_clear(&pd->open);
  dyd_work_init(&w, &pd->sk, NULL);
  assert_int_equal(dyd_faces_find(pd, &w, NULL, 0), DYD_OK);
  dyd_work_clear(&w);
  table_holds(pd);
}

/* Looks at centres on both sides of the edge; returns how many are witnesses. */
static size_t try_centres(const dyd_delaunay *pd, dyd_work *w, test_random *g, dyd_half_edge h) {
  uint32_t i = dyd_edge_origin(&pd->sk.mesh, h), j = dyd_edge_target(&pd->sk.mesh, h);
  dyd_xy p = pd->sk.reps.xy[i], q = pd->sk.reps.xy[j];
  dyd_point c;
  size_t count = 0;
  dyd_point_init(&c);
  for (int tries = 0; tries < 6; tries++) {
    double a = test_unit(g), b = (test_unit(g) - 0.5) * (test_chance(g, 4) ? 4 : 1);
    dyd_xy at = {p.x + a * (q.x - p.x) - b * (q.y - p.y), p.y + a * (q.y - p.y) + b * (q.x - p.x)};
    if (!dyd_filter_local_witness(pd, h, at)) continue;
    assert_int_equal(dyd_dyadic_set_d(&c.x, at.x) | dyd_dyadic_set_d(&c.y, at.y), DYD_OK);
    assert_true(dyd_witness_check(w, &pd->sk, i, j, &c));
    count++;
  }
  dyd_point_clear(&c);
  return count;
}

/* The same for all edges that are uncertain when some were forgotten. */
static size_t try_edges(dyd_delaunay *pd, test_random *g) {
  dyd_work w;
  size_t count = 0;
  forget_edges(pd, g);
  dyd_work_init(&w, &pd->sk, NULL);
  for (uint32_t t = 0; t < pd->sk.mesh.count; t++)
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++)
      if (!dyd_edge_is_certain(&pd->sk, h)) count += try_centres(pd, &w, g, h);
  dyd_work_clear(&w);
  return count;
}

static void test_local_witness(void **state) {
  (void)state;
  test_random g = test_random_start("local witness");
  cloud *c = malloc(sizeof *c);
  size_t witnesses = 0;
  assert_non_null(c);
  for (size_t q = 0; q < test_cases_all(40); q++) {
    dyd_sites *s;
    make(c, &g);
    dyd_delaunay *pd = triangulate(&s, c, NULL);
    if (pd->sk.rects.box) witnesses += try_edges(pd, &g);
    finish(s, pd);
  }
  fprintf(stderr, "# witnesses %zu\n", witnesses);
  assert_true(witnesses > 300);
  free(c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_aliases), cmocka_unit_test(test_fresh),
                                     cmocka_unit_test(test_crowd),   cmocka_unit_test(test_last_point),
                                     cmocka_unit_test(test_capped),  cmocka_unit_test(test_local_witness)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
