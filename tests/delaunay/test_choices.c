/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* No choice of points ever refutes a statement [POS-1] [LEG-1]: a legal pair is a strictly Delaunay edge of every
 * choice, a weakly Delaunay edge of a choice is never illegal, a sure triangle is a triangle of every choice. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include <cmocka.h>

static harness shared;

/* The points of the choice without aliases, which would hide strictness. */
static bool has_alias(const orc_case *c) {
  for (size_t i = 0; i < c->n; i++)
    if (orc_case_alias(c, i) != i) return true;
  return false;
}

static bool pairs_hold(char *message, orc_pool *p, const orc_case *choice, const dyd_delaunay *pd) {
  for (uint32_t i = 0; i < choice->n; i++)
    for (uint32_t j = i + 1; j < choice->n; j++) {
      if (orc_rect_equal(&choice->rect[i], &choice->rect[j])) continue;
      int is = orc_classical(p, choice, i, j);
      dyd_pair_status s = dyd_delaunay_status(pd, i, j);
      if (s == DYD_LEGAL && is != ORC_LEGAL) return wrong(message, "legal pair %u %u refuted by a choice", i, j);
      if (s == DYD_ILLEGAL && is != ORC_ILLEGAL) return wrong(message, "illegal pair %u %u realised", i, j);
    }
  return true;
}

static bool triangles_hold(char *message, orc_pool *p, const orc_case *choice, const dyd_delaunay *pd) {
  dyd_triangle_list l = {0};
  if (dyd_delaunay_triangles(&l, NULL, pd, 0) != DYD_OK) return wrong(message, "dyd_delaunay_triangles fails");
  bool good = true;
  for (size_t k = 0; k < l.count && good; k++) {
    const uint32_t *v = l.item[k].v;
    const orc_rect *a = &choice->rect[v[0]], *b = &choice->rect[v[1]], *c = &choice->rect[v[2]];
    if (orc_turn(p, a, b, c) <= 0) good = wrong(message, "triangle %u %u %u turns", v[0], v[1], v[2]);
    for (size_t m = 0; m < choice->n && good; m++) {
      if (m == v[0] || m == v[1] || m == v[2]) continue;
      if (orc_in_circle(p, a, b, c, &choice->rect[m]) >= 0)
        good = wrong(message, "triangle %u %u %u holds site %zu", v[0], v[1], v[2], m);
    }
  }
  dyd_triangle_list_clear(&l);
  return good;
}

static bool check(char *message, harness *h, const orc_case *c) {
  if (has_alias(c)) return true;
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  orc_case choice;
  orc_case_init(&choice);
  bool good = pd;
  for (size_t k = 0; k < 12 && good; k++) {
    size_t mark = orc_mark(&h->pool);
    orc_choose(&choice, &h->random, c, k % 3 ? 6 : 1);
    good = pairs_hold(message, &h->pool, &choice, pd) && triangles_hold(message, &h->pool, &choice, pd);
    if (!good) fprintf(stderr, "refuting choice:\n"), orc_case_print(stderr, &choice);
    orc_release(&h->pool, mark);
  }
  orc_case_clear(&choice);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static void test_small(void **state) {
  (void)state;
  harness_run_kinds(&shared, 7, test_cases(40), check);
}

/* More sites than the oracle could do. */
static void test_larger(void **state) {
  (void)state;
  harness_run_kinds(&shared, 30, test_cases(3), check);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_small), cmocka_unit_test(test_larger)};
  harness_init(&shared, "choices");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
