/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Every way in which a run may end before its time, at every place where it asks for memory: that fails, or the run is
 * stopped there, or its memory budget is reached, or the callback for proofs fails. Then the result states nothing, or
 * the same as before, or, with keep_cut, a part of it; and all can be repeated. Sites lie around true points that are
 * known, on lines and circles, so that proofs of ties are given as they are due. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/disc_filter.h"
#include "delaunay/state.h"
#include "dyadic/raw.h"
#include "support/failing_memory.h"
#include "support/random.h"
#include <cmocka.h>
#include <dyadel/delaunay.h>
#include <string.h>

enum { MOST = 40 };

/* Sites around the points (x, y) / 16, with their half widths in the same unit. */
typedef struct world {
  const char *name;
  size_t n;
  long x[MOST], y[MOST], half[MOST][2];
  dyd_sites *sites;
  size_t asked, fails_at; /* for proofs; the call that fails, 0: none */
} world;

typedef unsigned char table[MOST][MOST];
__extension__ typedef __int128 wide;

static void put(world *w, long x, long y, long half_x, long half_y) {
  assert_true(w->n < MOST);
  w->x[w->n] = 16 * x;
  w->y[w->n] = 16 * y;
  w->half[w->n][0] = half_x;
  w->half[w->n++][1] = half_y;
}

static void rect_of(dyd_rect *r, const world *w, size_t i, long part) {
  double hx = (double)w->half[i][0] / (double)part / 16, hy = (double)w->half[i][1] / (double)part / 16;
  double x = (double)w->x[i] / 16, y = (double)w->y[i] / 16;
  assert_int_equal(dyd_rect_set_d(r, x - hx, x + hx, y - hy, y + hy), DYD_OK);
}

static void make_sites(world *w) {
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(dyd_sites_new(&w->sites), DYD_OK);
  for (size_t i = 0; i < w->n; i++) {
    rect_of(&r, w, i, 1);
    assert_int_equal(dyd_sites_add_rect(w->sites, &r), DYD_OK);
  }
  dyd_rect_clear(&r);
}

/* Half of the sites get sides of a quarter, or become points. */
static size_t narrow(uint32_t *changed, world *w) {
  size_t count = 0;
  dyd_rect r;
  dyd_rect_init(&r);
  for (uint32_t i = 0; i < w->n; i += 2) {
    rect_of(&r, w, i, 4);
    if (i % 3 == 0) w->half[i][0] = w->half[i][1] = 0, rect_of(&r, w, i, 1);
    assert_int_equal(dyd_sites_narrow(w->sites, i, &r), DYD_OK);
    changed[count++] = i;
  }
  dyd_rect_clear(&r);
  return count;
}

/* ---- known facts about the true points ---- */

static long cross(const world *w, uint32_t a, uint32_t b, uint32_t c) {
  return (w->x[b] - w->x[a]) * (w->y[c] - w->y[a]) - (w->y[b] - w->y[a]) * (w->x[c] - w->x[a]);
}

static bool on_circle(const world *w, const uint32_t *s, uint32_t d) {
  wide m[3][3], det = 0;
  for (int k = 0; k < 3; k++) {
    m[k][0] = w->x[s[k]] - w->x[d];
    m[k][1] = w->y[s[k]] - w->y[d];
    m[k][2] = m[k][0] * m[k][0] + m[k][1] * m[k][1];
  }
  for (int k = 0; k < 3; k++)
    det += m[k][0] * (m[(k + 1) % 3][1] * m[(k + 2) % 3][2] - m[(k + 1) % 3][2] * m[(k + 2) % 3][1]);
  return det == 0;
}

static dyd_status tell(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                       dyd_error *err) {
  world *w = user;
  if (++w->asked == w->fails_at) return dyd_error_set(err, DYD_E_STREAM, "asked too often");
  *proved = true;
  for (size_t k = 2; k < count && relation == DYD_COLLINEAR; k++) *proved &= cross(w, site[0], site[1], site[k]) == 0;
  for (size_t k = 3; k < count && relation == DYD_COCIRCULAR; k++) *proved &= on_circle(w, site, site[k]);
  return DYD_OK;
}

/* ---- worlds ---- */

static void points_in_a_grid(world *w) {
  for (long k = 0; k < 36; k++) put(w, k % 6, k / 6, 0, 0);
}
static void boxes_in_a_grid(world *w) {
  for (long k = 0; k < 25; k++) put(w, 2 * (k % 5), 2 * (k / 5), 1 + k % 2, 1);
}
/* Two circles: all that is inside is one face. */
static void points_on_circles(world *w) {
  for (long x = -25; x <= 25; x++)
    for (long y = -25; y <= 25; y++)
      if (x * x + y * y == 625 || x * x + y * y == 5) put(w, x, y, 0, 0);
}
static void circles_and_a_box(world *w) {
  points_on_circles(w);
  put(w, 60, 60, 1, 1);
}
static void boxes_on_a_circle(world *w) {
  for (long x = -65; x <= 65; x++)
    for (long y = -65; y <= 65; y++)
      if (x * x + y * y == 65 * 65) put(w, x, y, 1, 1);
}
static void boxes_on_a_line(world *w) {
  for (long k = 0; k < 30; k++) put(w, 2 * k, 0, k % 3 ? 4 : 0, 0);
}
static void points_on_a_line(world *w) {
  for (long k = 0; k < 20; k++) put(w, k * k, 2 * k * k, 0, 0);
}
static void crowd(world *w) {
  for (long k = 0; k < 24; k++) put(w, 7 * k % 11, 5 * k % 13, 24, 16 + k);
}
static void crowd_and_points(world *w) {
  for (long k = 0; k < 26; k++) put(w, 17 * k % 23, 11 * k % 29, k % 2 ? 48 : 0, k % 2 ? 32 : 0);
}

static const struct {
  const char *name;
  void (*make)(world *w);
} worlds[] = {{"points in a grid", points_in_a_grid},   {"boxes in a grid", boxes_in_a_grid},
              {"points on circles", points_on_circles}, {"circles and a box", circles_and_a_box},
              {"boxes on a circle", boxes_on_a_circle}, {"boxes on a line", boxes_on_a_line},
              {"points on a line", points_on_a_line},   {"crowd", crowd},
              {"crowd and points", crowd_and_points}};

/* ---- statuses ---- */

static void take(table out, const dyd_delaunay *pd, size_t n) {
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = 0; j < n; j++) out[i][j] = (unsigned char)dyd_delaunay_status(pd, i, j);
}

static void expect_same(const world *w, table is, table was, const char *what) {
  for (size_t i = 0; i < w->n; i++)
    for (size_t j = 0; j < w->n; j++)
      if (is[i][j] != was[i][j]) fail_msg("%s, %s: %zu %zu is %d, not %d", w->name, what, i, j, is[i][j], was[i][j]);
}

/* A status definite in a part is definite in the whole. */
static void expect_part(const world *w, table part, table whole, const char *what) {
  for (size_t i = 0; i < w->n; i++)
    for (size_t j = 0; j < w->n; j++)
      if (part[i][j] != DYD_INDETERMINATE && part[i][j] != whole[i][j])
        fail_msg("%s, %s: %zu %zu is %d, not %d", w->name, what, i, j, part[i][j], whole[i][j]);
}

/* ---- one kind of end ---- */

typedef enum end { MEMORY, STOPPED, CUT, BOUND, PROVER, ENDS } end;
static const char *const end_name[] = {"memory fails", "stopped", "cut", "bound of memory", "prover fails"};
static const dyd_status end_status[] = {DYD_E_NOMEM, DYD_CANCELLED, DYD_CANCELLED, DYD_E_NOMEM, DYD_E_STREAM};

/* Runs again with the fault one step later: a new run when *pd is NULL, else an update. Returns true if the run
 * completed. */
static bool run(dyd_delaunay **pd, world *w, end e, size_t k, size_t max_pairs, const uint32_t *changed, size_t count,
                dyd_status *status) {
  volatile int stop = 0;
  dyd_error err;
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = max_pairs, .prove = tell, .prove_user = w};
  if (e == STOPPED || e == CUT) o.cancel = bell = &stop;
  o.keep_cut = e == CUT;
  if (e == BOUND) o.max_bytes = 64 * k * k;
  w->asked = 0;
  w->fails_at = e == PROVER ? k : 0;
  dyd_error_clear(&err);
  countdown = e <= CUT ? k : 0;
  *status = *pd ? dyd_delaunay_update(*pd, changed, count, &o, &err) : dyd_delaunay_new(pd, w->sites, &o, &err);
  bool over = e == BOUND ? *status >= DYD_OK && *status != DYD_CANCELLED : e == PROVER ? w->asked < k : countdown > 0;
  countdown = 0;
  bell = NULL;
  w->fails_at = 0;
  bool ended = *status != DYD_OK && *status != DYD_CAPPED;
  if (ended && (*status != end_status[e] || over)) fail_msg("%s, %s, %zu: status %d", w->name, end_name[e], k, *status);
  if (*status < DYD_OK) assert_int_equal(err.code, *status);
  if (*status < DYD_OK && e == BOUND) assert_non_null(strstr(err.message, "max_bytes"));
  return over;
}

static size_t ended[ENDS], cuts;
static size_t dense; /* the first places one by one, later ones less densely */

/* The statuses of a run with nothing in its way. */
static dyd_delaunay *fresh(table out, world *w, size_t max_pairs) {
  dyd_delaunay *pd = NULL;
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = max_pairs, .prove = tell, .prove_user = w};
  dyd_status status = dyd_delaunay_new(&pd, w->sites, &o, NULL);
  assert_true(status == DYD_OK || status == DYD_CAPPED);
  take(out, pd, w->n);
  return pd;
}

static void each_end_of_new(world *w, end e, size_t max_pairs) {
  static table whole, is;
  dyd_delaunay_free(fresh(whole, w, max_pairs));
  for (size_t k = 1, over = 0; !over; k += 1 + k / dense) {
    dyd_delaunay *pd = NULL;
    dyd_status status;
    over = run(&pd, w, e, k, max_pairs, NULL, 0, &status);
    assert_int_equal(pd != NULL, status == DYD_OK || status == DYD_CAPPED);
    ended[e] += !pd;
    if (!pd) continue;
    take(is, pd, w->n);
    if (e == CUT && status == DYD_CAPPED && !over) {
      expect_part(w, is, whole, end_name[e]);
      cuts++;
    } else {
      expect_same(w, is, whole, end_name[e]);
    }
    dyd_delaunay_free(pd);
  }
}

/* After an update that ended, earlier statements still hold; the next one does the rest. */
static void each_end_of_update(world *w, end e) {
  static table before, is, whole;
  uint32_t changed[MOST];
  dyd_status status = DYD_OK;
  dyd_delaunay *pd = fresh(before, w, 0);
  size_t count = narrow(changed, w);
  for (size_t k = 1, over = 0; !over; k += 1 + k / dense) {
    over = run(&pd, w, e, k, 0, changed, count, &status);
    ended[e] += status != DYD_OK;
    take(is, pd, w->n);
    expect_part(w, before, is, end_name[e]);
  }
  dyd_delaunay_free(fresh(whole, w, 0));
  expect_same(w, is, whole, end_name[e]);
  dyd_delaunay_free(pd);
}

static void each_end(void **state) {
  (void)state;
  dense = test_cases(16);
  for (size_t k = 0; k < sizeof worlds / sizeof *worlds; k++)
    for (end e = 0; e < ENDS; e++)
      for (int what = 0; what < 3; what++) {
        world w = {.name = worlds[k].name};
        worlds[k].make(&w);
        make_sites(&w);
        if (what < 2)
          each_end_of_new(&w, e, what ? 8 : 0);
        else if (e != CUT)
          each_end_of_update(&w, e);
        dyd_sites_free(w.sites);
      }
  for (end e = 0; e < ENDS; e++) {
    fprintf(stderr, "# %s: %zu times\n", end_name[e], ended[e]);
    assert_true(ended[e] > 0 || e == CUT);
  }
  fprintf(stderr, "# cut and kept: %zu times\n", cuts);
  assert_true(cuts > 0);
}

/* ---- questions ---- */

static dyd_status ask(const dyd_delaunay *pd, size_t question, size_t *items) {
  dyd_index_list list = {0};
  dyd_pair_list pairs = {0};
  dyd_triangle_list triangles = {0}, beyond = {0};
  dyd_hull hull = {.pairs = {0}};
  dyd_point c;
  mpq_t radius2;
  bool outer;
  dyd_status st = DYD_OK;
  dyd_point_init(&c);
  mpq_init(radius2);
  mpq_set_ui(radius2, 400, 1);
  if (question == 0) st = dyd_delaunay_pairs(&pairs, pd);
  if (question == 1) st = dyd_delaunay_triangles(&triangles, NULL, pd, 0);
  if (question == 2) st = dyd_delaunay_hull(&list, pd);
  if (question == 3) st = dyd_delaunay_neighbours(&list, pd, 0, DYD_TIE);
  if (question == 4) st = dyd_delaunay_undecided_faces(pd) ? dyd_delaunay_face(&list, &outer, pd, 0) : DYD_OK;
  if (question == 5) st = dyd_delaunay_undecided_faces(pd) ? dyd_delaunay_face_pairs(&pairs, pd, 0) : DYD_OK;
  if (question == 6) st = dyd_delaunay_partial_hull(&hull, pd, true);
  if (question == 7) st = dyd_delaunay_partial_hull(&hull, pd, false);
  if (question == 8) st = dyd_delaunay_triangles(&triangles, &beyond, pd, 0);
  if (question == 9) st = dyd_delaunay_triangles(&triangles, &beyond, pd, DYD_TRIANGLES_AS_FOUND);
  if (question == 10) st = dyd_delaunay_meet_disc(&list, pd, &c, radius2);
  if (question == 11 && dyd_delaunay_status(pd, 0, 1) == DYD_LEGAL) st = dyd_delaunay_witness(&c, pd, 0, 1);
  *items = pairs.count + triangles.count + list.count + hull.sure_vertices.count + hull.possible_vertices.count +
           beyond.count + hull.pairs.count;
  mpq_clear(radius2);
  dyd_point_clear(&c);
  dyd_hull_clear(&hull);
  dyd_triangle_list_clear(&beyond);
  dyd_triangle_list_clear(&triangles);
  dyd_pair_list_clear(&pairs);
  dyd_index_list_clear(&list);
  return st;
}

/* Answers are whole, or none. */
static void questions(void **state) {
  (void)state;
  static table statuses;
  for (size_t k = 0; k < sizeof worlds / sizeof *worlds; k++)
    for (size_t max_pairs = 0; max_pairs < 16; max_pairs += 8) {
      world w = {.name = worlds[k].name};
      worlds[k].make(&w);
      make_sites(&w);
      dyd_delaunay *pd = fresh(statuses, &w, max_pairs);
      for (size_t question = 0; question < 12; question++) {
        size_t all, items;
        dyd_status good = ask(pd, question, &all);
        assert_true(good == DYD_OK || (good == DYD_CAPPED && question == 6));
        for (size_t at = 1, over = 0; !over; at++) {
          countdown = at;
          dyd_status st = ask(pd, question, &items);
          over = countdown > 0;
          countdown = 0;
          if (st == DYD_E_NOMEM ? over || items : st != good || items != all)
            fail_msg("%s, question %zu, allocation %zu fails: %d, %zu items of %zu", w.name, question, at, st, items,
                     all);
        }
      }
      dyd_delaunay_free(pd);
      dyd_sites_free(w.sites);
    }
}

/* Sites that meet a disc, against integers. */
static void discs(void **state) {
  (void)state;
  static table statuses;
  test_random r = test_random_start("discs");
  for (size_t k = 0; k < sizeof worlds / sizeof *worlds; k++) {
    world w = {.name = worlds[k].name};
    worlds[k].make(&w);
    make_sites(&w);
    dyd_delaunay *pd = fresh(statuses, &w, 0);
    for (int tries = 0; tries < 50; tries++) {
      long c[2] = {(long)test_between(&r, -300, 900), (long)test_between(&r, -300, 900)};
      size_t to = (size_t)test_below(&r, w.n), at = 0;
      long radius2 = (c[0] - w.x[to]) * (c[0] - w.x[to]) + (c[1] - w.y[to]) * (c[1] - w.y[to]);
      dyd_index_list list = {0};
      dyd_point centre;
      mpq_t q;
      mpq_init(q);
      dyd_point_init(&centre);
      mpq_set_ui(q, (unsigned long)radius2, 256);
      mpq_canonicalize(q);
      assert_int_equal(dyd_dyadic_set_si_2exp(&centre.x, c[0], -4), DYD_OK);
      assert_int_equal(dyd_dyadic_set_si_2exp(&centre.y, c[1], -4), DYD_OK);
      assert_int_equal(dyd_delaunay_meet_disc(&list, pd, &centre, q), DYD_OK);
      for (uint32_t i = 0; i < w.n; i++) {
        long away2 = 0, d[2] = {labs(c[0] - w.x[i]), labs(c[1] - w.y[i])};
        for (int a = 0; a < 2; a++) away2 += d[a] > w.half[i][a] ? (d[a] - w.half[i][a]) * (d[a] - w.half[i][a]) : 0;
        bool listed = at < list.count && list.item[at] == i;
        if (listed != (away2 <= radius2)) fail_msg("%s: site %u, %d", w.name, i, listed);
        at += listed;
      }
      assert_int_equal(at, list.count);
      dyd_point_clear(&centre);
      mpq_clear(q);
      dyd_index_list_clear(&list);
    }
    dyd_delaunay_free(pd);
    dyd_sites_free(w.sites);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(each_end), cmocka_unit_test(questions), cmocka_unit_test(discs)};
  return cmocka_run_group_tests_name("ends of runs", tests, NULL, NULL);
}
