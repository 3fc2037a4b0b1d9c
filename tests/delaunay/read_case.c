/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading cases, and all that can be compared about one of them. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/read_case.h"
#include <cmocka.h>
#include <string.h>

static const char *read_number(mpq_t out, const char *text) {
  char word[80] = "";
  size_t n = strcspn(text, ",] \n");
  dyd_dyadic x;
  dyd_dyadic_init(&x);
  if (n == 0 || n >= sizeof word) fail_msg("no number at: %s", text);
  memcpy(word, text, n);
  if (dyd_dyadic_set_str(&x, word, NULL) != DYD_OK) fail_msg("bad number: %s", word);
  dyd_dyadic_get_q(out, &x);
  dyd_dyadic_clear(&x);
  return text + n;
}

static const char *read_side(mpq_t *e, const char *text) {
  text += strspn(text, " \n");
  bool box = *text == '[';
  text = read_number(e[0], text + box);
  if (box)
    text = read_number(e[1], text + 1) + 1;
  else
    mpq_set(e[1], e[0]);
  return text;
}

void read_case(orc_case *out, const char *name, const char *text) {
  out->n = 0;
  snprintf(out->kind, sizeof out->kind, "%s", name);
  while (text[strspn(text, " \n")]) {
    assert_true(out->n < ORC_MAX);
    mpq_t *e = out->rect[out->n++].e;
    text = read_side(e + 2, read_side(e, text));
  }
}

static bool right_with(char *message, harness *h, const orc_case *c, const orc_table *t, bool no_filter) {
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = no_filter};
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, &o);
  bool good = pd && same_as_oracle(message, h, c, t, pd) && queries_agree(message, c, pd) &&
              triangles_right(message, &h->pool, c, pd) && witnesses_hold(message, &h->pool, c, pd);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static bool right(char *message, harness *h, const orc_case *c) {
  orc_table t;
  orc_statuses(&t, &h->pool, c);
  return right_with(message, h, c, &t, false) && right_with(message, h, c, &t, true);
}

void expect_right(harness *h, const orc_case *c) {
  harness_run(h, c, right);
}

int engine_status(const orc_case *c, uint32_t i, uint32_t j, bool no_filter) {
  char message[MESSAGE_SIZE] = "";
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = no_filter};
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, &o);
  int status = pd ? (int)dyd_delaunay_status(pd, i, j) : -1;
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return status;
}
