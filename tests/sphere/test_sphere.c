/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [SPH-1] [SPH-3] Of exact points every one can be projected from, and all give the same statuses and triangles. */
#include <setjmp.h>
#include <stdarg.h>

#include "support/random.h"

#include <cmocka.h>
#include <dyadel/sphere.h>
#include <string.h>

enum { MOST = 24 };

typedef struct globe_case {
  size_t n;
  double lon[MOST], lat[MOST];
} globe_case;

/* Parallels and meridians with poles, one hemisphere, a neighbourhood across 180 degrees, or anywhere. */
static void fill_globe(globe_case *g, test_random *r) {
  int kind = (int)test_below(r, 4);
  g->n = (size_t)test_between(r, 1, MOST);
  for (size_t i = 0; i < g->n; i++) {
    g->lon[i] = (double)test_between(r, -6, 12) * 30;
    g->lat[i] = (double)test_between(r, -3, 3) * 30;
    if (kind == 1) g->lat[i] = (double)test_between(r, 1, 6) * 15;
    if (kind == 2) g->lon[i] = 178 + (double)test_between(r, 0, 8) / 2, g->lat[i] = (double)test_between(r, -4, 4) / 2;
    if (kind == 3) g->lon[i] = 360 * test_unit(r) - 180, g->lat[i] = 180 * test_unit(r) - 90;
  }
}

typedef struct globe_answer {
  dyd_pair_list pairs;
  dyd_triangle_list triangles;
  dyd_outcome outcome;
} globe_answer;

/* Projected from point number `centre`. */
static void ask_globe(globe_answer *out, const globe_case *g, uint32_t centre) {
  dyd_engine *e;
  dyd_sphere *s;
  dyd_error err;
  const dyd_sphere_options o = {DYD_SIZED(dyd_sphere_options), .centre_set = true, .centre = centre};
  memset(out, 0, sizeof *out);
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_engine_add_points(e, g->n, g->lon, g->lat, NULL), DYD_OK);
  assert_int_equal(dyd_sphere_new(&s, e, &o, &err), DYD_OK);
  assert_int_equal(dyd_sphere_centre(s), dyd_sphere_alias(s, centre));
  assert_int_equal(dyd_sphere_run(&out->outcome, s, NULL, &err), DYD_OK);
  assert_int_equal(dyd_sphere_pairs(&out->pairs, s), DYD_OK);
  assert_int_equal(dyd_sphere_triangles(&out->triangles, s), DYD_OK);
  dyd_sphere_free(s);
  dyd_engine_free(e);
}

static void forget_answer(globe_answer *a) {
  dyd_pair_list_clear(&a->pairs);
  dyd_triangle_list_clear(&a->triangles);
}

static void compare_answers(const globe_answer *a, const globe_answer *b) {
  assert_int_equal(a->outcome, b->outcome);
  assert_int_equal(a->pairs.count, b->pairs.count);
  for (size_t k = 0; k < a->pairs.count; k++) {
    const dyd_pair *p = &a->pairs.item[k], *q = &b->pairs.item[k];
    assert_true(p->i == q->i && p->j == q->j && p->status == q->status && p->status != DYD_INDETERMINATE);
  }
  assert_int_equal(a->triangles.count, b->triangles.count);
  for (size_t k = 0; k < a->triangles.count; k++)
    assert_memory_equal(a->triangles.item[k].v, b->triangles.item[k].v, sizeof a->triangles.item[k].v);
}

static void test_every_centre(void **state) {
  (void)state;
  test_random r = test_random_start("every centre");
  size_t ties = 0, triangles = 0;
  for (size_t c = 0; c < test_cases_all(150); c++) {
    globe_case g;
    globe_answer first, other;
    fill_globe(&g, &r);
    ask_globe(&first, &g, 0);
    for (uint32_t centre = 1; centre < g.n; centre++) {
      ask_globe(&other, &g, centre);
      compare_answers(&first, &other);
      forget_answer(&other);
    }
    for (size_t k = 0; k < first.pairs.count; k++) ties += first.pairs.item[k].status == DYD_TIE;
    triangles += first.triangles.count;
    forget_answer(&first);
  }
  assert_true(ties > 100 && triangles > 1000);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_centre)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
