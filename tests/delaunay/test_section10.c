/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The cases that a naive reading gets wrong (mathematics: section 10), with their statuses as literal tables.
 *
 * A table has one word per site i, one letter per j > i: L legal, ? indeterminate, t tie, . illegal. Cocircular sites
 * [CLO-2], pairs whose witnesses are far out [HUL-3], exponents far apart [FLT-DST]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include <cmocka.h>
#include <string.h>

static harness shared;

/* Engine and oracle against the table; every query; both rungs. */
static void expect(const orc_case *c, const char *table) {
  char message[MESSAGE_SIZE] = "";
  orc_table want = {.n = c->n}, found;
  const char *t = table;
  for (size_t i = 0; i < c->n; i++)
    for (size_t j = i + 1; j < c->n; j++) {
      while (*t == ' ') t++;
      assert_true(*t);
      want.status[i][j] = want.status[j][i] = (unsigned char)(strchr(".t?L", *t++) - ".t?L");
    }
  orc_statuses(&found, &shared.pool, c);
  for (size_t i = 0; i < c->n; i++)
    for (size_t j = 0; j < c->n; j++) assert_int_equal(found.status[i][j], want.status[i][j]);
  for (int exact = 0; exact < 2; exact++) {
    dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = exact};
    dyd_sites *s = harness_sites(c);
    dyd_delaunay *pd = harness_engine(message, s, &o);
    bool good = pd && same_as_oracle(message, &shared, c, &want, pd) && queries_agree(message, c, pd) &&
                triangles_right(message, &shared.pool, c, pd) && witnesses_hold(message, &shared.pool, c, pd);
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
    if (good) continue;
    orc_case_print(stderr, c);
    fail_msg("%s: %s", c->kind, message);
  }
}

/* The rectangles are quadruples x0, x1, y0, y1, all divided by den. */
static void expect_boxes(const char *name, const char *table, size_t n, const long (*box)[4], unsigned long den) {
  orc_case c;
  orc_case_init(&c);
  strcpy(c.kind, name);
  for (size_t i = 0; i < n; i++) orc_case_add(&c, box[i][0], box[i][1], box[i][2], box[i][3], den);
  expect(&c, table);
  orc_case_clear(&c);
}

#define EXPECT(name, table, den, ...)                                                                                  \
  do {                                                                                                                 \
    static const long box[][4] = {__VA_ARGS__};                                                                        \
    expect_boxes(name, table, sizeof box / sizeof *box, box, den);                                                     \
  } while (0)

/* Cases 1 to 5 and 7, multiplied by 10 so that the rectangles are dyadic. */
static void test_cases_1_to_5(void **state) {
  (void)state;
  EXPECT("1", "LL? ?L L", 1, {0, 0, 0, 0}, {10, 10, 0, 0}, {0, 0, 10, 10}, {9, 11, 9, 11});
  EXPECT("2", "??LL LL? .L ?", 1, {0, 0, 0, 0}, {10, 10, 0, 0}, {5, 5, 5, 5}, {5, 5, -6, -6}, {0, 2, 3, 3});
  EXPECT("3", "?LLL LLL L? .", 1, {0, 0, 0, 0}, {100, 100, 0, 0}, {50, 50, -1, 1}, {50, 50, 200, 200},
         {50, 50, -10000, -10000});
  EXPECT("4", "LL. LL L", 1, {0, 0, 0, 0}, {100, 100, 0, 0}, {0, 0, 100, 100}, {105, 110, 105, 110});
  EXPECT("5", "L", 1, {0, 0, 0, 0}, {9, 11, -1, 1});
  EXPECT("7", "?LL LL L", 1, {0, 0, 0, 0}, {40, 40, 0, 0}, {20, 20, 30, 30}, {19, 21, -1, 1});
}

/* Twelve integer points of x^2 + y^2 = 65. */
static const long ring[12][2] = {{1, 8},  {8, 1},  {4, 7},  {7, 4},  {-1, 8}, {-8, 1},
                                 {-4, 7}, {-7, 4}, {1, -8}, {8, -1}, {4, -7}, {7, -4}};

static void test_case_6(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  strcpy(c.kind, "6, near");
  for (size_t k = 0; k < 12; k++)
    orc_case_add(&c, 16 * ring[k][0] - 1, 16 * ring[k][0] + 1, 16 * ring[k][1] - 1, 16 * ring[k][1] + 1, 16);
  expect(&c, "?L?L??????? ?L?????L?? L???????? ???????? ?L????? ?LL??? L???? ???? ?L? ?L L");
  c.n = 0;
  strcpy(c.kind, "6, exact");
  for (size_t k = 0; k < 12; k++) orc_case_add(&c, ring[k][0], ring[k][0], ring[k][1], ring[k][1], 1);
  expect(&c, "tLtLttttttt tLtttttLtt Ltttttttt tttttttt tLttttt tLLttt Ltttt tttt tLt tL L");
  c.n = 0;
  strcpy(c.kind, "6, grid");
  for (long k = 0; k < 9; k++) orc_case_add(&c, k % 3, k % 3, k / 3, k / 3, 1);
  expect(&c, "LtLt.t.. LtLt... .tL..t L.Lt. LtLt .tL Lt L");
  orc_case_clear(&c);
  EXPECT("6, square", "LLt tL L", 1, {0, 0, 0, 0}, {1, 1, 0, 0}, {0, 0, 1, 1}, {1, 1, 1, 1});
  EXPECT("6, square of thirds", "LLt tL L", 3, {0, 0, 0, 0}, {10, 10, 0, 0}, {0, 0, 10, 10}, {10, 10, 10, 10});
  EXPECT("6, square of tenths", "LLt tL L", 10, {1, 1, 1, 1}, {2, 2, 1, 1}, {1, 1, 2, 2}, {2, 2, 2, 2});
}

static void test_case_8(void **state) {
  (void)state;
  EXPECT("8, plus", "L?? ?? ?", 1, {-10, 10, -1, 1}, {-1, 1, -10, 10}, {20, 20, 0, 0}, {-20, -20, 3, 3});
  EXPECT("8, nested", "??? ?? ?", 1, {0, 16, 0, 16}, {4, 8, 4, 8}, {5, 6, 5, 6}, {40, 41, 0, 1});
  EXPECT("8, two nested", "L", 1, {0, 16, 0, 16}, {4, 8, 4, 8});
  EXPECT("8, equal rectangles", "??? ?? ?", 1, {0, 4, 0, 4}, {0, 4, 0, 4}, {0, 4, 0, 4}, {0, 4, 0, 4});
  EXPECT("8, equal and one more", "??? ?? ?", 1, {0, 4, 0, 4}, {0, 4, 0, 4}, {0, 4, 0, 4}, {9, 9, 9, 9});
  EXPECT("8, two equal", "L", 1, {0, 4, 0, 4}, {0, 4, 0, 4});
  EXPECT("8, equal points", "... .. .", 1, {3, 3, 4, 4}, {3, 3, 4, 4}, {3, 3, 4, 4}, {3, 3, 4, 4});
  EXPECT("8, two equal points", ".", 1, {3, 3, 4, 4}, {3, 3, 4, 4});
  EXPECT("8, aliases", ".LLL LLL L. L", 1, {0, 0, 0, 0}, {0, 0, 0, 0}, {5, 5, 0, 0}, {0, 0, 5, 5}, {5, 5, 0, 0});
  EXPECT("8, touching corners", "L?? ?? ?", 1, {0, 2, 0, 2}, {2, 4, 2, 4}, {8, 8, 0, 0}, {0, 0, 8, 8});
  EXPECT("8, collinear", "Lttt Ltt tL L", 1, {0, 0, 0, 0}, {1, 1, 2, 2}, {2, 2, 4, 4}, {5, 5, 10, 10}, {3, 3, 6, 6});
  EXPECT("8, collinear thirds", "Lt L", 3, {0, 0, 0, 0}, {1, 1, 2, 2}, {2, 2, 4, 4});
  EXPECT("8, collinear segments", "L?? L? L", 1, {0, 1, 0, 0}, {3, 4, 0, 0}, {6, 7, 0, 0}, {9, 10, 0, 0});
  EXPECT("8, two points", "L", 1, {0, 0, 0, 0}, {1, 1, 0, 0});
  EXPECT("8, one point", "", 1, {0, 0, 0, 0});
  EXPECT("8, one rectangle", "", 1, {0, 1, 0, 1});
  orc_case none;
  orc_case_init(&none);
  expect(&none, "");
  orc_case_clear(&none);
}

/* 2^-100000 beside 2^100000. */
static void test_case_9(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  strcpy(c.kind, "9");
  orc_case_add(&c, 0, 0, 0, 0, 1);
  orc_case_add(&c, 1, 1, 0, 0, 1);
  orc_case_scale(&c, -100000);
  orc_case_add(&c, 1, 1, 1, 1, 1);
  orc_case_add(&c, 0, 0, 1, 1, 1);
  mpq_mul_2exp(c.rect[3].e[2], c.rect[3].e[2], 100000);
  mpq_mul_2exp(c.rect[3].e[3], c.rect[3].e[3], 100000);
  expect(&c, "LLL L. L");
  c.n = 3;
  expect(&c, "LL L");
  orc_case_clear(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_cases_1_to_5), cmocka_unit_test(test_case_6),
                                     cmocka_unit_test(test_case_8), cmocka_unit_test(test_case_9)};
  harness_init(&shared, "section 10");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
