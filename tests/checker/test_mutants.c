/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Every truncation and every change of one field of a certificate is rejected, or states the same, or something true
 * [CERT-1] [CERT-2] [CERT-3] [CERT-4] [CERT-5] [CERT-6] [CERT-7] [CERT-9].
 *
 * Accepted texts are read by a separate reader.
 *   "The same": the same rectangles, the same list of pairs by kind, the same count of triangles and of pairs that are
 *   not proved; the same outcome, or one of the words that claim nothing; the same goal, unless it is said to be
 *   reached; and the same section on the diagram. Witnesses, places, bridges, corners and chains may differ: they are
 *   proofs, not statements. Bounds may differ, and are compared with the pairs listed each time.
 *   "Something true": of the rectangles that the mutant has, which are other ones in most cases. Every such statement
 *   is judged: each pair called legal or illegal by the engine, which shares no code with the checker; polygons and
 *   areas in rationals, distances at random points; and in a sample (all of it with a large DYADEL_TEST_SCALE) each
 * pair by the slow oracle too. */
#include "checker/diagram.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

typedef struct mutants {
  orc_pool pool;
  test_random random;
  statement original, mutant;
  diagram drawn, drawn_mutant;
  const char *text;
  size_t replaced, tried, same, judged;
  size_t judge_every; /* the oracle judges one in this many statements about other rectangles */
} mutants;

static void fail_mutant(const char *what, const char *text) {
  fputs(text, stderr);
  fail_msg("accepted, but %s", what);
}

/* Is the text rejected, or good? */
static void try_text(mutants *m, const char *text, size_t length) {
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  m->tried++;
  if (certificate_check(&r, text, length, NULL) != DYD_OK) return;
  statement_read(&m->mutant, text);
  bool exact = statement_ties_are_exact(&m->mutant);
  if (!exact && !(r.gaps & DYD_GAP_TIES)) fail_mutant("a pair is no tie", text);
  if (r.aliases_unproved && !(r.gaps & DYD_GAP_ALIASES)) fail_mutant("a site is no alias", text);
  if (r.aliases_unproved) return; /* two sites for a reader that sees rectangles only */
  diagram_read(&m->drawn_mutant, text);
  if (!statement_bounds_hold(&m->mutant)) fail_mutant("the bounds are too small", text);
  bool same = statement_same(&m->original, &m->mutant);
  const char *wrong = NULL;
  if (!same || !diagram_same(&m->drawn, &m->drawn_mutant))
    wrong = diagram_judge(&m->drawn_mutant, &m->mutant.sites, &m->random, 10);
  if (wrong) fail_mutant(wrong, text);
  m->same += same;
  if (same) return;
  wrong = statement_judge_by_engine(&m->mutant);
  if (!wrong && exact && m->judged++ % m->judge_every == 0) wrong = statement_judge(&m->pool, &m->mutant);
  if (wrong) fail_mutant(wrong, text);
}

/* The text with [from, from + length) replaced. */
static void try_replaced(mutants *m, size_t from, size_t length, const char *by) {
  if (m->replaced++ % test_stride()) return;
  size_t all = strlen(m->text), put = strlen(by);
  char *text = malloc(all + put + 1);
  memcpy(text, m->text, from);
  memcpy(text + from, by, put);
  strcpy(text + from + put, m->text + from + length);
  if (strcmp(text, m->text) != 0) try_text(m, text, strlen(text));
  free(text);
}

/* Changes of the integer at [from, from + length): neighbours, sign, zero, half, a digit less, a digit more. */
static void try_integer(mutants *m, size_t from, size_t length) {
  char *digits = strndup(m->text + from, length), by[400];
  mpz_t v, w;
  mpz_init_set_str(v, digits, 10);
  mpz_init(w);
  for (int change = -2; change <= 2; change++) {
    mpz_set(w, v);
    change < 0 ? mpz_sub_ui(w, w, (unsigned)-change) : mpz_add_ui(w, w, (unsigned)change);
    if (mpz_sizeinbase(w, 10) < sizeof by - 2) try_replaced(m, from, length, mpz_get_str(by, 10, w));
  }
  mpz_neg(w, v);
  try_replaced(m, from, length, mpz_get_str(by, 10, w));
  mpz_fdiv_q_2exp(w, v, 1);
  try_replaced(m, from, length, mpz_get_str(by, 10, w));
  try_replaced(m, from, length, "0");
  try_replaced(m, from + length - 1, 1, "");
  try_replaced(m, from + length, 0, "1");
  mpz_clears(v, w, NULL);
  free(digits);
}

static void each_integer(mutants *m) {
  for (size_t k = 0; m->text[k];) {
    size_t sign = m->text[k] == '-', length = sign + strspn(m->text + k + sign, "0123456789");
    if (length > sign) try_integer(m, k, length);
    k += length > sign ? length : 1;
  }
}

/* Each word removed, doubled, exchanged with the next one, or turned into another word that has a meaning. */
static void each_word(mutants *m) {
  static const char *const words[] = {"decided",   "certified", "fixpoint", "budget", "cancelled", "error",    "area",
                                      "hausdorff", "voronoi",   "yes",      "no",     "none",      "unproved", "o",
                                      "t",         "l",         "n",        "=",      "end",       "window"};
  for (size_t k = 0; m->text[k]; k++) {
    if ((k && !isspace((unsigned char)m->text[k - 1])) || isspace((unsigned char)m->text[k])) continue;
    size_t length = strcspn(m->text + k, " \n"), next = k + length + 1, second = strcspn(m->text + next, " \n");
    char by[2000];
    try_replaced(m, k, length, "");
    try_replaced(m, k, length + 1, "");
    if (length + second + 2 < sizeof by) {
      snprintf(by, sizeof by, "%.*s %.*s", (int)length, m->text + k, (int)length, m->text + k);
      try_replaced(m, k, length, by);
      snprintf(by, sizeof by, "%.*s%c%.*s", (int)second, m->text + next, m->text[k + length], (int)length, m->text + k);
      try_replaced(m, k, length + 1 + second, by);
    }
    for (size_t w = 0; w < sizeof words / sizeof *words && isalpha((unsigned char)m->text[k]); w++)
      try_replaced(m, k, length, words[w]);
  }
}

/* Each line removed, doubled, exchanged with the next one. */
static void each_line(mutants *m) {
  for (size_t k = 0; m->text[k];) {
    size_t length = strcspn(m->text + k, "\n") + 1;
    size_t second = m->text[k + length] ? strcspn(m->text + k + length, "\n") + 1 : 0;
    char *line = strndup(m->text + k, length), *next = strndup(m->text + k + length, second),
         *both = malloc(length + second + 1);
    try_replaced(m, k, length, "");
    try_replaced(m, k, 0, line);
    sprintf(both, "%s%s", next, line);
    try_replaced(m, k, length + second, both);
    free(line);
    free(next);
    free(both);
    k += length;
  }
}

static void each_truncation(mutants *m) {
  for (size_t length = 0, size = strlen(m->text); length < size; length += test_stride())
    assert_int_equal(certificate_check(NULL, m->text, length, NULL), DYD_E_PARSE);
}

static void each_byte(mutants *m, test_random *r) {
  char *text = strdup(m->text);
  for (size_t k = 0, size = strlen(text); k < size; k += test_stride()) {
    static const char bytes[] = "0123456789-+*^/ \n=otlnx";
    text[k] = bytes[test_below(r, sizeof bytes - 1)];
    if (text[k] != m->text[k]) try_text(m, text, strlen(text));
    text[k] = m->text[k];
  }
  free(text);
}

/* window: of a section on the diagram; NULL: none. */
static void try_case(test_random *r, const orc_case *c, const dyd_rect *window, size_t judge_every) {
  static mutants m;
  size_t scale = test_cases(1);
  memset(&m, 0, sizeof m);
  m.judge_every = judge_every > scale ? judge_every / scale : 1;
  m.random = *r;
  dyd_engine *e = engine_of_case(c, NULL);
  char *text = window ? diagram_of_engine(e, window) : certificate_of_engine(e);
  dyd_engine_free(e);
  m.text = text;
  orc_pool_init(&m.pool);
  statement_init(&m.original);
  statement_init(&m.mutant);
  diagram_init(&m.drawn);
  diagram_init(&m.drawn_mutant);
  statement_read(&m.original, text);
  diagram_read(&m.drawn, text);
  assert_int_equal(certificate_check(NULL, text, strlen(text), NULL), DYD_OK);
  each_truncation(&m);
  each_integer(&m);
  each_word(&m);
  each_line(&m);
  each_byte(&m, r);
  fprintf(stderr, "# %s, %zu sites, %zu bytes: %zu mutants, %zu say the same, %zu something else that is true\n",
          c->kind, c->n, strlen(text), m.tried, m.same, m.judged);
  assert_true(m.same + m.judged < m.tried / 2);
  statement_clear(&m.original);
  statement_clear(&m.mutant);
  diagram_clear(&m.drawn);
  diagram_clear(&m.drawn_mutant);
  orc_pool_clear(&m.pool);
  free(text);
}

/* n thin boxes; with `wide`, some of them meet, and pairs are open. */
static void boxes(orc_case *c, test_random *r, size_t n, long wide) {
  c->n = 0;
  strcpy(c->kind, wide ? "wide boxes" : "boxes");
  for (size_t k = 0; k < n; k++) {
    long x = (long)test_between(r, 0, 1000), y = (long)test_between(r, 0, 1000);
    long w = test_chance(r, 3) ? (long)test_between(r, 0, wide) : 1;
    bool third = test_chance(r, 4); /* an exact point of thirds */
    orc_case_add(c, x, third ? x : x + w, y, third ? y : y + w, third ? 3 : 1);
  }
}

static void thirty_sites(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  test_random r = test_random_start("mutants of 30 sites");
  boxes(&c, &r, 30, 0);
  try_case(&r, &c, NULL, 20);
  boxes(&c, &r, 30, 120);
  try_case(&r, &c, NULL, 20);
  orc_case_clear(&c);
}

static void few_sites(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  test_random r = test_random_start("mutants of few sites");
  for (size_t k = 0; k < test_cases(1); k++) {
    for (size_t kind = 0; kind < ORC_KINDS; kind++) {
      orc_generate(&c, &r, kind, 7);
      if (orc_case_all_points(&c) || k > 0 || kind < 6) try_case(&r, &c, NULL, 1);
    }
    boxes(&c, &r, 7, 200);
    try_case(&r, &c, NULL, 1);
  }
  orc_case_clear(&c);
}

/* Certificates with a section on the diagram. */
static void diagrams(void **state) {
  (void)state;
  orc_case c;
  dyd_rect w;
  orc_case_init(&c);
  dyd_rect_init(&w);
  assert_int_equal(dyd_interval_set_d(&w.x, -100, 1100), DYD_OK);
  assert_int_equal(dyd_interval_set_d(&w.y, 0, 1000), DYD_OK);
  test_random r = test_random_start("mutants of diagrams");
  for (size_t k = 0; k < test_cases(1); k++) {
    boxes(&c, &r, 5, 0);
    try_case(&r, &c, &w, 1);
    boxes(&c, &r, 4, 300);
    try_case(&r, &c, &w, 1);
  }
  dyd_rect_clear(&w);
  orc_case_clear(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(thirty_sites), cmocka_unit_test(few_sites),
                                     cmocka_unit_test(diagrams)};
  return cmocka_run_group_tests_name("mutants of certificates", tests, NULL, NULL);
}
