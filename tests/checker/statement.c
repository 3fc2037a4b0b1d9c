/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a certificate states, read by a reader of its own, and judged by the oracle. */
#include "checker/statement.h"
#include "rect/rect.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void statement_init(statement *s) {
  memset(s, 0, sizeof *s);
  orc_case_init(&s->sites);
  mpq_inits(s->area, s->hausdorff, NULL);
}

void statement_clear(statement *s) {
  orc_case_clear(&s->sites);
  mpq_clears(s->area, s->hausdorff, NULL);
}

/* ---- reading ---- */

/* m or m*2^e, up to the end of the number; returns what follows. */
const char *statement_number(mpq_ptr out, const char *text) {
  size_t length = strspn(text, "-0123456789");
  char *digits = strndup(text, length);
  assert_int_equal(mpq_set_str(out, digits, 10), 0);
  free(digits);
  text += length;
  if (strncmp(text, "*2^", 3) != 0) return text;
  char *end;
  long e = strtol(text + 3, &end, 10);
  if (e >= 0)
    mpq_mul_2exp(out, out, (mp_bitcnt_t)e);
  else
    mpq_div_2exp(out, out, (mp_bitcnt_t)-e);
  return end;
}

static void read_side(mpq_t *end, const char *text) {
  mpq_t t;
  mpq_init(t);
  const char *rest = statement_number(end[0], text);
  mpq_set(end[1], end[0]);
  if (*rest == '/') {
    statement_number(t, rest + 1);
    mpq_div(end[0], end[0], t);
    mpq_set(end[1], end[0]);
  } else if (*rest == '+') {
    statement_number(t, rest + 1);
    mpq_add(end[1], end[0], t);
  }
  mpq_clear(t);
}

static void read_site(statement *s, char *line) {
  orc_rect *r = &s->sites.rect[s->sites.n];
  char *blank = strchr(line, ' ');
  assert_non_null(blank);
  assert_true(s->sites.n < ORC_MAX);
  if (*line == '=') {
    const orc_rect *of = &s->sites.rect[atoi(blank + 1)];
    for (int k = 0; k < 4; k++) mpq_set(r->e[k], of->e[k]);
  } else {
    *blank = 0;
    read_side(r->e, line);
    read_side(r->e + 2, blank + 1);
  }
  s->sites.n++;
}

static void read_line(statement *s, char *line, unsigned long *sites, unsigned long *legal) {
  unsigned i, j;
  char word[16], kind;
  if (*sites) {
    read_site(s, line);
    --*sites;
  } else if (*legal) {
    assert_int_equal(sscanf(line, "%u %u", &i, &j), 2);
    s->kind[i][j] = 'L';
    --*legal;
  } else if (sscanf(line, "outcome %15s", s->outcome) == 1 ||
             sscanf(line, "goal %21[a-z ] %ld", s->goal, &s->goal_bits) > 0 || sscanf(line, "sites %lu", sites) == 1 ||
             sscanf(line, "legal %lu", legal) == 1 || sscanf(line, "triangles %lu", &s->triangles) == 1 ||
             sscanf(line, "unproved %lu", &s->unproved) == 1) {
    return;
  } else if (sscanf(line, "capped %15s", word) == 1) {
    s->capped = strcmp(word, "yes") == 0;
  } else if (sscanf(line, "area %15s", word) == 1) {
    s->area_given = strcmp(word, "none") != 0;
    if (s->area_given) statement_number(s->area, line + 5);
  } else if (sscanf(line, "hausdorff %15s", word) == 1) {
    s->hausdorff_given = strcmp(word, "none") != 0;
    if (s->hausdorff_given) statement_number(s->hausdorff, line + 10);
  } else if (strchr("otln", *line) && sscanf(line, "%c %u %u", &kind, &i, &j) == 3) {
    s->kind[i][j] = kind;
  }
}

void statement_read(statement *s, const char *text) {
  unsigned long sites = 0, legal = 0;
  char *copy = strdup(text), *next;
  s->sites.n = 0;
  memset(s->kind, 0, sizeof s->kind);
  for (char *line = copy; (next = strchr(line, '\n')) != NULL; line = next + 1) {
    *next = 0;
    read_line(s, line, &sites, &legal);
  }
  free(copy);
}

/* ---- comparing and judging ---- */

bool statement_same(const statement *a, const statement *b) {
  if (a->sites.n != b->sites.n || a->capped != b->capped || a->triangles != b->triangles || a->unproved != b->unproved)
    return false;
  for (size_t i = 0; i < a->sites.n; i++)
    if (!orc_rect_equal(&a->sites.rect[i], &b->sites.rect[i])) return false;
  return memcmp(a->kind, b->kind, sizeof a->kind) == 0 &&
         (strcmp(a->outcome, b->outcome) == 0 || strcmp(b->outcome, "decided") != 0) &&
         (strcmp(a->goal, b->goal) == 0 || strcmp(b->outcome, "certified") != 0);
}

/* The area by the library's rectangles, the Hausdorff terms in doubles: good to about 1e-15. */
static void term(double *most, mpq_ptr area2, const orc_rect *a, const orc_rect *b, bool legal) {
  dyd_rect x, y;
  mpq_t t;
  dyd_rect_init(&x);
  dyd_rect_init(&y);
  mpq_init(t);
  harness_rect(&x, a);
  harness_rect(&y, b);
  dyd_partial_edge_area2(t, &x, &y);
  mpq_add(area2, area2, t);
  double d = 0, l = 0, e[8];
  for (int k = 0; k < 4; k++) e[k] = mpq_get_d(a->e[k]), e[4 + k] = mpq_get_d(b->e[k]);
  d = fmax(hypot(e[1] - e[0], e[3] - e[2]), hypot(e[5] - e[4], e[7] - e[6]));
  l = hypot(fmax(e[5] - e[0], e[1] - e[4]), fmax(e[7] - e[2], e[3] - e[6]));
  *most = fmax(*most, legal ? d : d + l / 2);
  mpq_clear(t);
  dyd_rect_clear(&x);
  dyd_rect_clear(&y);
}

bool statement_bounds_hold(const statement *s) {
  mpq_t area2;
  double most = 0;
  mpq_init(area2);
  for (size_t i = 0; i < s->sites.n; i++)
    for (size_t j = i + 1; j < s->sites.n; j++)
      if (s->kind[i][j] && s->kind[i][j] != 'n')
        term(&most, area2, &s->sites.rect[i], &s->sites.rect[j], s->kind[i][j] == 'L');
  mpq_div_2exp(area2, area2, 1);
  bool good = (!s->area_given || mpq_cmp(s->area, area2) >= 0) &&
              (!s->hausdorff_given || mpq_get_d(s->hausdorff) >= most * (1 - 0x1p-40));
  mpq_clear(area2);
  return good;
}

static const char *judge_pair(orc_pool *p, const statement *s, size_t i, size_t j) {
  static char message[200];
  const orc_case *c = &s->sites;
  const char *wrong = NULL;
  char kind = s->kind[i][j];
  if (orc_case_alias(c, i) != i || orc_case_alias(c, j) != j) return kind ? "a pair of an alias" : NULL;
  size_t mark = orc_mark(p);
  if (kind == 'L' && !orc_legal(NULL, NULL, p, c, i, j)) wrong = "not legal";
  if (kind == 't' && !(orc_rect_is_point(&c->rect[i]) && orc_rect_is_point(&c->rect[j]))) wrong = "no tie";
  if ((kind == 'n' || (kind == 0 && s->unproved == 0)) && orc_possible(p, c, i, j)) wrong = "not illegal";
  orc_release(p, mark);
  if (!wrong) return NULL;
  snprintf(message, sizeof message, "pair %zu %zu is %s", i, j, wrong);
  return message;
}

/* The oracle wants no two equal points. */
static bool has_alias(const orc_case *c) {
  for (size_t i = 0; i < c->n; i++)
    if (orc_case_alias(c, i) != i) return true;
  return false;
}

bool statement_ties_are_exact(const statement *s) {
  for (size_t i = 0; i < s->sites.n; i++)
    for (size_t j = i + 1; j < s->sites.n; j++)
      if (s->kind[i][j] == 't' && !(orc_rect_is_point(&s->sites.rect[i]) && orc_rect_is_point(&s->sites.rect[j])))
        return false;
  return true;
}

const char *statement_judge(orc_pool *p, const statement *s) {
  bool open = s->capped;
  for (size_t i = 0; i < s->sites.n; i++)
    for (size_t j = i + 1; j < s->sites.n; j++) {
      open |= s->kind[i][j] && strchr("otl", s->kind[i][j]);
      const char *wrong = has_alias(&s->sites) ? NULL : judge_pair(p, s, i, j);
      if (wrong) return wrong;
    }
  if (strcmp(s->outcome, "decided") == 0 && open) return "decided, but pairs are open";
  return statement_bounds_hold(s) ? NULL : "the bounds are too small";
}

const char *statement_judge_by_engine(const statement *s) {
  static char message[200];
  const char *wrong = NULL;
  dyd_sites *sites = harness_sites(&s->sites);
  dyd_delaunay *pd = harness_engine(message, sites, NULL);
  assert_non_null(pd);
  for (size_t i = 0; i < s->sites.n && !wrong; i++)
    for (size_t j = i + 1; j < s->sites.n && !wrong; j++) {
      char kind = s->kind[i][j];
      if (dyd_delaunay_alias(pd, (uint32_t)i) != i || dyd_delaunay_alias(pd, (uint32_t)j) != j) continue;
      dyd_pair_status status = dyd_delaunay_status(pd, (uint32_t)i, (uint32_t)j);
      bool illegal = kind == 'n' || (kind == 0 && s->unproved == 0);
      if (illegal != (status == DYD_ILLEGAL) && (illegal || kind == 'L')) wrong = message;
      if (wrong) snprintf(message, sizeof message, "pair %zu %zu: the engine calls it otherwise", i, j);
    }
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return wrong;
}

/* ---- certificates ---- */

char *certificate_of_engine(const dyd_engine *e) {
  char *text = NULL;
  size_t size;
  FILE *out = open_memstream(&text, &size);
  dyd_error err;
  assert_int_equal(dyd_write_certificate(out, e, NULL, &err), DYD_OK);
  fclose(out);
  return text;
}

dyd_engine *engine_of_case(const orc_case *c, const dyd_engine_options *o) {
  dyd_engine *e = NULL;
  dyd_rect r;
  dyd_outcome outcome;
  dyd_rect_init(&r);
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  for (size_t i = 0; i < c->n; i++) {
    harness_rect(&r, &c->rect[i]);
    assert_int_equal(dyd_engine_add_rect(e, &r, NULL), DYD_OK);
  }
  assert_int_equal(dyd_engine_run(&outcome, e, o, NULL), DYD_OK);
  dyd_rect_clear(&r);
  return e;
}

char *certificate_of_case(const orc_case *c, const dyd_engine_options *o) {
  dyd_engine *e = engine_of_case(c, o);
  char *text = certificate_of_engine(e);
  dyd_engine_free(e);
  return text;
}

dyd_status certificate_check(dyd_certificate_report *report, const char *text, size_t length, dyd_error *err) {
  dyd_certificate_report unused = {DYD_SIZED(dyd_certificate_report)};
  FILE *in = length ? fmemopen((char *)(uintptr_t)text, length, "r") : fopen("/dev/null", "r");
  assert_non_null(in);
  dyd_status status = dyd_verify_certificate(report ? report : &unused, in, NULL, err);
  fclose(in);
  return status;
}
