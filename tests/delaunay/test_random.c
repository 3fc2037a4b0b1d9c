/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The engine against the oracle on random cases: every status of every pair, every query, every witness, and the
 * same answers for the exact rung, for permutations and for the symmetries of the square
 * [POS-1] [LEG-1] [CRIT-1] [QUAD-1] [HULL-1] [BETA-1] [COV-1] [COV-2] [CLO-1] [WIT-1] [WIT-QUAD] [WIT-NEAR] [WIT-HULL]
 * [HUL-1] [HUL-2] [HUL-3] [LINE-1] [FLT-ORI] [FLT-INC] [FLT-DST] [FLT-STAR] [FLT-DIR] [FLT-SCALE]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include <cmocka.h>

static harness shared;

/* The case turned and reordered: statuses move along. */
static bool same_when_moved(char *message, harness *h, const orc_case *c, const dyd_delaunay *pd) {
  orc_case moved;
  size_t order[ORC_MAX];
  uint32_t low[ORC_MAX];
  orc_case_init(&moved);
  for (size_t i = 0; i < c->n; i++) order[i] = i;
  for (size_t i = c->n; i > 1; i--) {
    size_t k = (size_t)test_below(&h->random, i), t = order[k];
    order[k] = order[i - 1], order[i - 1] = t;
  }
  unsigned symmetry = (unsigned)test_below(&h->random, 8);
  orc_case_permute(&moved, c, order, c->n);
  orc_case_turn(&moved, symmetry);
  for (size_t i = 0; i < c->n; i++) low[i] = (uint32_t)orc_case_alias(c, order[i]);
  dyd_sites *s = harness_sites(&moved);
  dyd_delaunay *other = harness_engine(message, s, NULL);
  bool good = other;
  for (uint32_t i = 0; i < c->n && good; i++)
    for (uint32_t j = 0; j < c->n && good; j++) {
      int is = (int)dyd_delaunay_status(other, i, j), was = (int)dyd_delaunay_status(pd, low[i], low[j]);
      if (!same_status(h, c, low[i], low[j], is, was))
        good = wrong(message, "symmetry %u: pair %u %u had %d, has %d", symmetry, low[i], low[j], was, is);
    }
  dyd_delaunay_free(other);
  dyd_sites_free(s);
  orc_case_clear(&moved);
  return good;
}

static bool same_with(char *message, harness *h, const orc_case *c, const dyd_sites *s, const dyd_delaunay *pd,
                      dyd_delaunay_options o) {
  dyd_delaunay *other = harness_engine(message, s, &o);
  bool good = other && same_statuses(message, h, c, pd, other);
  dyd_delaunay_free(other);
  return good;
}

static void count_pairs(harness *h, const orc_table *t) {
  for (size_t i = 0; i < t->n; i++)
    for (size_t j = i + 1; j < t->n; j++) {
      h->pairs++;
      h->legal += t->status[i][j] == ORC_LEGAL;
      h->undecided += t->status[i][j] == ORC_INDETERMINATE || t->status[i][j] == ORC_TIE;
    }
}

static bool check(char *message, harness *h, const orc_case *c) {
  orc_table t;
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  bool good = pd;
  if (good) {
    orc_statuses(&t, &h->pool, c);
    count_pairs(h, &t);
  }
  good = good && same_as_oracle(message, h, c, &t, pd) && queries_agree(message, c, pd) &&
         triangles_right(message, &h->pool, c, pd) && witnesses_hold(message, &h->pool, c, pd);
  good = good &&
         same_with(message, h, c, s, pd, (dyd_delaunay_options){DYD_SIZED(dyd_delaunay_options), .no_filter = true}) &&
         same_with(message, h, c, s, pd, (dyd_delaunay_options){DYD_SIZED(dyd_delaunay_options), .threads = 2}) &&
         same_when_moved(message, h, c, pd);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static void run_kind(size_t kind, size_t most, size_t cases) {
  orc_case c;
  orc_case_init(&c);
  for (size_t k = 0; k < cases; k++) {
    orc_generate(&c, &shared.random, kind, most);
    harness_run(&shared, &c, check);
  }
  orc_case_clear(&c);
}

/* Small cases of every kind. */
static void test_small(void **state) {
  (void)state;
  for (size_t kind = 0; kind < ORC_KINDS; kind++) run_kind(kind, 6, test_cases(90));
}

static void test_larger(void **state) {
  (void)state;
  for (size_t kind = 0; kind < ORC_KINDS; kind++) run_kind(kind, 12, test_cases(35));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_small), cmocka_unit_test(test_larger)};
  harness_init(&shared, "random");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
