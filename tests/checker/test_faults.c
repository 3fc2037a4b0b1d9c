/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Wrong statuses with every count put right: a forger knows the checker. Any that are accepted must be true by the
 * oracle; pairs that are called illegal without a proof must be counted as unproved [CERT-1] [CERT-2] [CERT-3]. */
#include "checker/statement.h"

#include <stdlib.h>
#include <string.h>

#define SIZE 20000

typedef struct forger {
  orc_pool pool;
  statement claim;
  char text[SIZE];
  size_t tried, rejected, unproved, true_claims;
} forger;

static char *line_after(char *text, const char *start) {
  size_t length = strlen(start);
  for (char *line = text; *line; line = strchr(line, '\n') + 1)
    if (strncmp(line, start, length) == 0) return line;
  return NULL;
}

/* Replaces [at, at + length) of the text. */
static void put(char *text, char *at, size_t length, const char *by) {
  size_t more = strlen(by);
  assert_true(strlen(text) + more < SIZE);
  memmove(at + more, at + length, strlen(at + length) + 1);
  memcpy(at, by, more);
}

static void put_count(char *text, const char *name, unsigned long long count) {
  char by[60], *line = line_after(text, name);
  snprintf(by, sizeof by, "%s%llu", name, count);
  put(text, line, strcspn(line, "\n"), by);
}

static void change_count(char *text, const char *name, int by) {
  put_count(text, name, (unsigned long long)(atoll(line_after(text, name) + strlen(name)) + by));
}

static void remove_line(char *text, char *line) {
  put(text, line, strcspn(line, "\n") + 1, "");
}

static char *line_number(char *text, size_t number) {
  char *line = text;
  while (--number) line = strchr(line, '\n') + 1;
  return line;
}

/* Puts right what the message complains about; false when it is something else. corner: a claimed one stays. */
static bool repair(char *text, const dyd_error *err, bool corner) {
  unsigned long long count;
  unsigned site;
  char name[30];
  if (sscanf(err->message, "there are %llu sure triangles", &count) == 1) {
    put_count(text, "triangles ", count);
  } else if (sscanf(err->message, "of the pairs that are not listed, %llu are", &count) == 1) {
    put_count(text, "unproved ", count);
  } else if (strstr(err->message, "in no open set") || strstr(err->message, "of no open set")) {
    remove_line(text, line_number(text, err->line));
  } else if (!corner && strstr(err->message, "to be a corner") && sscanf(err->message, "site %u", &site) == 1) {
    snprintf(name, sizeof name, "%u ", site);
    remove_line(text, line_after(line_after(text, "corners"), name));
    change_count(text, "corners ", -1);
  } else {
    return false;
  }
  return true;
}

static void try_claim(forger *f, const char *original, bool corner) {
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  dyd_status status;
  f->tried++;
  for (int round = 0; round < 200; round++) {
    status = certificate_check(&report, f->text, strlen(f->text), &err);
    if (status == DYD_OK || !repair(f->text, &err, corner)) break;
  }
  if (status != DYD_OK) {
    f->rejected++;
    return;
  }
  f->unproved += report.unproved > 0;
  f->true_claims += report.unproved == 0;
  statement_read(&f->claim, f->text);
  if (!statement_ties_are_exact(&f->claim)) { /* may be right for the points; said not to be proved */
    assert_true(report.gaps & DYD_GAP_TIES);
    return;
  }
  const char *wrong = statement_judge(&f->pool, &f->claim);
  if (!wrong) return;
  fprintf(stderr, "%s\n--- forged:\n%s\n", original, f->text);
  fail_msg("accepted, but %s", wrong);
}

/* ---- forgeries; `line` is a line of the section legal, or of the pairs ---- */

static void forget_legal(forger *f, char *line) {
  remove_line(f->text, line);
  change_count(f->text, "legal ", -1);
}

static void legal_to_open(forger *f, char *line, char kind) {
  char by[40];
  unsigned i, j, k, l;
  assert_int_equal(sscanf(line, "%u %u", &i, &j), 2);
  forget_legal(f, line);
  snprintf(by, sizeof by, "%c %u %u\n", kind, i, j);
  char *at = strchr(line_after(f->text, "pairs"), '\n') + 1;
  while (sscanf(at, "%*c %u %u", &k, &l) == 2 && (k < i || (k == i && l < j))) at = strchr(at, '\n') + 1;
  put(f->text, at, 0, by);
}

/* An open or unlisted pair is called legal, with the witness of another pair. */
static void call_legal(forger *f, unsigned i, unsigned j, const char *witness_line) {
  char by[400], witness[300];
  unsigned k, l;
  if (sscanf(witness_line, "%*u %*u %299[^\n]", witness) != 1) return;
  snprintf(by, sizeof by, "%u %u %s\n", i, j, witness);
  char *at = strchr(line_after(f->text, "legal "), '\n') + 1;
  while (sscanf(at, "%u %u", &k, &l) == 2 && (k < i || (k == i && l < j))) at = strchr(at, '\n') + 1;
  put(f->text, at, 0, by);
  change_count(f->text, "legal ", 1);
}

static void forge_legal(forger *f, const char *original, size_t n) {
  size_t offset = (size_t)(strchr(line_after((char *)(uintptr_t)original, "legal "), '\n') + 1 - original);
  for (const char *line = original + offset; strncmp(line, "places", 6) != 0; line = strchr(line, '\n') + 1) {
    for (int kind = 0; kind < 4; kind++) {
      strcpy(f->text, original);
      char *at = f->text + (line - original);
      if (kind == 0)
        forget_legal(f, at);
      else
        legal_to_open(f, at, " otl"[kind]);
      try_claim(f, original, false);
    }
    for (unsigned i = 0; i < n; i++)
      for (unsigned j = i + 1; j < n && n < 8; j++) {
        strcpy(f->text, original);
        call_legal(f, i, j, line);
        try_claim(f, original, false);
      }
  }
}

static void forge_open(forger *f, const char *original) {
  size_t offset = (size_t)(strchr(line_after((char *)(uintptr_t)original, "pairs"), '\n') + 1 - original);
  for (const char *line = original + offset; strncmp(line, "triangles", 9) != 0; line = strchr(line, '\n') + 1)
    for (int decided = 0; decided < 2; decided++) {
      strcpy(f->text, original);
      remove_line(f->text, f->text + (line - original));
      char *outcome = line_after(f->text, "outcome ");
      if (decided) put(f->text, outcome, strcspn(outcome, "\n"), "outcome decided");
      try_claim(f, original, false);
    }
}

/* Each site as a corner of the hull, in sixteen directions. */
static void forge_corner(forger *f, const char *original, size_t n) {
  static const int u[16][2] = {{1, 0},  {3, 1},   {1, 1},   {1, 3},   {0, 1},  {-1, 3}, {-1, 1}, {-3, 1},
                               {-1, 0}, {-3, -1}, {-1, -1}, {-1, -3}, {0, -1}, {1, -3}, {1, -1}, {3, -1}};
  for (unsigned v = 0; v < n; v++)
    for (int k = 0; k < 16; k++) {
      char by[40], name[20];
      unsigned i;
      strcpy(f->text, original);
      snprintf(name, sizeof name, "%u ", v);
      snprintf(by, sizeof by, "%u %d %d\n", v, u[k][0], u[k][1]);
      char *at = strchr(line_after(f->text, "corners "), '\n') + 1;
      while (sscanf(at, "%u", &i) == 1 && i < v) at = strchr(at, '\n') + 1;
      if (strncmp(at, name, strlen(name)) == 0) {
        remove_line(f->text, at);
        change_count(f->text, "corners ", -1);
      }
      put(f->text, at, 0, by);
      change_count(f->text, "corners ", 1);
      try_claim(f, original, true);
    }
}

static void forgeries(void **state) {
  (void)state;
  static forger f;
  orc_case c;
  test_random r = test_random_start("forged statuses");
  orc_case_init(&c);
  orc_pool_init(&f.pool);
  statement_init(&f.claim);
  for (size_t k = 0; k < test_cases(2); k++)
    for (size_t kind = 0; kind < ORC_KINDS; kind++) {
      orc_generate(&c, &r, kind, k % 2 ? 9 : 6);
      char *text = certificate_of_case(&c, NULL);
      if (strlen(text) < SIZE / 2) {
        forge_legal(&f, text, c.n);
        forge_open(&f, text);
        forge_corner(&f, text, c.n);
      }
      free(text);
    }
  fprintf(stderr, "# %zu forgeries: %zu rejected, %zu accepted with pairs unproved, %zu true\n", f.tried, f.rejected,
          f.unproved, f.true_claims);
  assert_true(f.rejected > 0 && f.unproved > 0);
  statement_clear(&f.claim);
  orc_pool_clear(&f.pool);
  orc_case_clear(&c);
}

/* A hull vertex that is not sure, beside an edge of the hull that is not sure: as a corner it would hide the pair of
 * its neighbours. Either part alone is not enough. */
static void corner_of_one_part(void **state) {
  (void)state;
  static forger f;
  orc_case c;
  orc_case_init(&c);
  orc_pool_init(&f.pool);
  statement_init(&f.claim);
  orc_case_add(&c, 0, 0, 0, 0, 1);
  orc_case_add(&c, 10, 10, 0, 0, 1);
  orc_case_add(&c, 10, 10, 10, 10, 1);
  orc_case_add(&c, 0, 0, 9, 9, 1);
  orc_case_add(&c, 4, 6, -1, 1, 1);
  char *text = certificate_of_case(&c, NULL);
  assert_non_null(strstr(text, "\no 0 1\n"));
  forge_corner(&f, text, c.n);
  assert_true(f.rejected > 0);
  free(text);
  statement_clear(&f.claim);
  orc_pool_clear(&f.pool);
  orc_case_clear(&c);
}

/* Chains that are nearly right, instead of the tie 0 2 of a square. */
static void forged_chains(void **state) {
  (void)state;
  static const char *const chain[] = {
      "n 0 2 1 -1 1 3*2^1 -1*2^1 1 1*2^1 -1", /* blocked, but does not separate */
      "n 0 2 1 -1 1 5 -1 1 -1 1",             /* the second ray leaves the blocker's region */
      "n 0 2 -1 1 1 5 -1 1 1 -1",             /* the first one */
      "n 0 2 -1 1 3 5 -1 1 1 -1",             /* the point is not in the region of the first blocker */
      "n 0 2 1 -1 1 5 -1 3 -1 1",             /* of the second one */
      "n 0 2 1 -1 1 5 -1 1 -1 5 3 -1 1",      /* the segment's second end is not in the region of 1 */
      "n 0 2 1 -1 1 5 -1 3 -1 5 3 -1 1",      /* its first end is not in the region of 3 */
      "n 0 2 1 -1 0 5 -1 3 -1 5 3 -1 1",      /* site 0 blocks itself */
      "n 0 2 0 0 1 5 -1 1 1 -1",              /* no direction */
      "n 0 2 1 -1 1 1 -1",                    /* no point */
      "n 0 2 1 -1"};
  orc_case c;
  char text[SIZE];
  orc_case_init(&c);
  for (int k = 0; k < 4; k++)
    orc_case_add(&c, 4 * (k == 1 || k == 2), 4 * (k == 1 || k == 2), 4 * (k > 1), 4 * (k > 1), 1);
  char *original = certificate_of_case(&c, NULL);
  for (size_t k = 0; k < sizeof chain / sizeof *chain; k++) {
    dyd_error err;
    strcpy(text, original);
    char *line = line_after(text, "t 0 2");
    put(text, line, strcspn(line, "\n"), chain[k]);
    assert_int_equal(certificate_check(NULL, text, strlen(text), &err), DYD_E_PARSE);
    assert_int_equal(err.line, 23);
  }
  free(original);
  orc_case_clear(&c);
}

/* Centres beyond the grid are compared with all sites. */
static void far_centres(void **state) {
  (void)state;
  orc_case c;
  char text[SIZE];
  orc_case_init(&c);
  orc_case_add(&c, 0, 0, 0, 0, 1);
  orc_case_add(&c, 4, 4, 0, 0, 1);
  orc_case_add(&c, 0, 0, 4, 4, 1);
  orc_case_add(&c, 9, 9, 9, 9, 1);
  char *original = certificate_of_case(&c, NULL);
  for (int good = 0; good < 2; good++) {
    strcpy(text, original);
    char *line = line_after(text, good ? "0 1 " : "1 2 ");
    assert_non_null(line);
    put(text, line, strcspn(line, "\n"), good ? "0 1 1*2^1 -1*2^80" : "1 2 1*2^80 1*2^80");
    assert_int_equal(certificate_check(NULL, text, strlen(text), NULL), good ? DYD_OK : DYD_E_PARSE);
  }
  free(original);
  orc_case_clear(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(forgeries), cmocka_unit_test(corner_of_one_part),
                                     cmocka_unit_test(forged_chains), cmocka_unit_test(far_centres)};
  return cmocka_run_group_tests_name("forged certificates", tests, NULL, NULL);
}
