/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certificates of random cases, biased to trouble, are accepted, and their statements agree with the engine and the
 * oracle [CERT-1] [CERT-2] [CERT-3] [CERT-4] [CERT-5] [CERT-9]. */
#include "checker/statement.h"

#include <stdlib.h>
#include <string.h>

typedef struct totals {
  size_t cases, chains, boxes, unproved, sets, complete, unwitnessed;
} totals;

static void check_case(totals *t, orc_pool *pool, const orc_case *c, bool judge) {
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  statement s;
  char *text = certificate_of_case(c, NULL);
  if (certificate_check(&report, text, strlen(text), &err) != DYD_OK) {
    orc_case_print(stderr, c);
    fputs(text, stderr);
    fail_msg("line %zu: %s", err.line, err.message);
  }
  statement_init(&s);
  statement_read(&s, text);
  const char *wrong = judge ? statement_judge(pool, &s) : statement_bounds_hold(&s) ? NULL : "bounds";
  if (wrong) {
    orc_case_print(stderr, c);
    fputs(text, stderr);
    fail_msg("%s", wrong);
  }
  t->cases++;
  t->chains += report.illegal_chains;
  t->boxes += report.illegal_boxes;
  t->unproved += report.unproved;
  t->sets += report.undecided_sets;
  t->complete += report.unproved == 0;
  t->unwitnessed += report.legal_unproved;
  statement_clear(&s);
  free(text);
}

static void random_cases(void **state) {
  (void)state;
  totals t = {0};
  orc_pool pool;
  orc_case c;
  test_random r = test_random_start("certificates of random cases");
  orc_pool_init(&pool);
  orc_case_init(&c);
  for (size_t k = 0; k < test_cases(12); k++)
    for (size_t kind = 0; kind < ORC_KINDS; kind++) {
      orc_generate(&c, &r, kind, 9);
      check_case(&t, &pool, &c, k < test_cases(4));
      orc_generate(&c, &r, kind, ORC_MAX);
      check_case(&t, &pool, &c, false);
    }
  fprintf(stderr,
          "# %zu certificates, %zu complete; %zu chains, %zu pairs by boxes, %zu unproved in %zu sets, %zu legal pairs "
          "without a witness\n",
          t.cases, t.complete, t.chains, t.boxes, t.unproved, t.sets, t.unwitnessed);
  assert_true(t.boxes > 0);
  assert_true(t.complete * 10 > t.cases * 8);
  orc_case_clear(&c);
  orc_pool_clear(&pool);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(random_cases)};
  return cmocka_run_group_tests_name("certificates of random cases", tests, NULL, NULL);
}
