/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Conversion of cases, running, shrinking and printing. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include "rect/rect.h"
#include <cmocka.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

/* The case being run, for the handler of crashes and hangs. */
static const orc_case *current;

static void on_signal(int number) {
  fprintf(stderr, "signal %d in this case:\n", number);
  if (current) orc_case_print(stderr, current);
  fflush(stderr);
  _exit(1);
}

void harness_init(harness *h, const char *name) {
  *h = (harness){.random = test_random_start(name)};
  orc_pool_init(&h->pool);
}

void harness_clear(harness *h) {
  fprintf(stderr, "# cases %zu, pairs %zu, legal %zu, undecided %zu, carried %zu, hairlines %zu, missed %zu\n",
          h->cases, h->pairs, h->legal, h->undecided, h->carried, h->hairlines, h->missed);
  orc_pool_clear(&h->pool);
}

bool wrong(char *message, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(message, MESSAGE_SIZE, format, arguments);
  va_end(arguments);
  return false;
}

static bool run_once(char *message, harness *h, const orc_case *c, case_check check) {
  current = c;
  signal(SIGABRT, on_signal);
  signal(SIGSEGV, on_signal);
  signal(SIGALRM, on_signal);
  alarm((unsigned)test_environment("DYADEL_TEST_PATIENCE", 120));
  size_t mark = orc_mark(&h->pool);
  bool good = check(message, h, c);
  orc_release(&h->pool, mark);
  alarm(0);
  current = NULL;
  return good;
}

static void shrink(char *message, harness *h, orc_case *c, case_check check, test_random start) {
  orc_case smaller;
  orc_case_init(&smaller);
  for (size_t i = 0; i < c->n;) {
    char text[MESSAGE_SIZE] = "";
    orc_case_set(&smaller, c);
    orc_case_drop(&smaller, i);
    h->random = start;
    if (run_once(text, h, &smaller, check)) {
      i++;
      continue;
    }
    orc_case_set(c, &smaller);
    memcpy(message, text, MESSAGE_SIZE);
    i = 0;
  }
  orc_case_clear(&smaller);
}

void harness_run(harness *h, const orc_case *c, case_check check) {
  char message[MESSAGE_SIZE] = "";
  test_random start = h->random;
  h->cases++;
  if (run_once(message, h, c, check)) return;
  orc_case least;
  orc_case_init(&least);
  orc_case_set(&least, c);
  shrink(message, h, &least, check, start);
  fprintf(stderr, "FAILED: %s\n", message);
  orc_case_print(stderr, &least);
  orc_case_clear(&least);
  fail_msg("%s", message);
}

static void run_kind(harness *h, size_t kind, size_t most, size_t cases, case_check check) {
  orc_case c;
  orc_case_init(&c);
  for (size_t k = 0; k < cases; k++) {
    orc_generate(&c, &h->random, kind, most);
    harness_run(h, &c, check);
  }
  orc_case_clear(&c);
}

void harness_run_kinds(harness *h, size_t most, size_t cases, case_check check) {
  for (size_t kind = 0; kind < ORC_KINDS; kind++) run_kind(h, kind, most, cases, check);
}

void harness_run_cases(harness *h, size_t most, size_t cases, case_check check) {
  for (size_t k = 0; k < cases; k++) run_kind(h, k % ORC_KINDS, most, 1, check);
}

static void set_dyadic(dyd_dyadic *out, mpq_srcptr x) {
  int64_t down = (int64_t)mpz_scan1(mpq_denref(x), 0);
  assert_int_equal(mpz_popcount(mpq_denref(x)), 1);
  assert_int_equal(dyd_dyadic_set_z_2exp(out, mpq_numref(x), -down), DYD_OK);
}

static void set_side(dyd_interval *out, const mpq_t *e) {
  if (mpq_equal(e[0], e[1])) {
    assert_int_equal(dyd_interval_set_q(out, e[0]), DYD_OK);
    return;
  }
  dyd_dyadic lo, hi;
  dyd_dyadic_init(&lo);
  dyd_dyadic_init(&hi);
  set_dyadic(&lo, e[0]);
  set_dyadic(&hi, e[1]);
  assert_int_equal(dyd_interval_set_ends(out, &lo, &hi), DYD_OK);
  dyd_dyadic_clear(&lo);
  dyd_dyadic_clear(&hi);
}

void harness_rect(dyd_rect *out, const orc_rect *r) {
  set_side(&out->x, &r->e[0]);
  set_side(&out->y, &r->e[2]);
}

dyd_sites *harness_sites(const orc_case *c) {
  dyd_sites *s = NULL;
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (size_t i = 0; i < c->n; i++) {
    harness_rect(&r, &c->rect[i]);
    assert_int_equal(dyd_sites_add_rect(s, &r), DYD_OK);
  }
  dyd_rect_clear(&r);
  return s;
}

dyd_delaunay *harness_engine(char *message, const dyd_sites *s, const dyd_delaunay_options *options) {
  dyd_delaunay *pd = NULL;
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status status = dyd_delaunay_new(&pd, s, options, &err);
  if (status == DYD_OK && pd) return pd;
  wrong(message, "dyd_delaunay_new gives %d: %s", status, err.message);
  dyd_delaunay_free(pd);
  return NULL;
}
