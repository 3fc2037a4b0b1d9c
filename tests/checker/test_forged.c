/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Forged statuses of exact points are never called proved [CERT-8] [CERT-10].
 *
 * All sets of three, four and five points of a 3 x 3 grid, in every combination of statuses: each pair has its true
 * status, or is a tie, or legal without a witness, or not listed. The truth is by brute force in integers: the centres
 * that are as near to both points of a pair as to no other one are an interval of their bisector. Sets of five points
 * have two statuses a pair, the true one and a tie; with DYADEL_TEST_SCALE > 1 all. */
#include "checker/statement.h"
#include "support/random.h"

#include <string.h>

enum { SIDE = 3, MOST = 5, PAIRS = MOST * (MOST - 1) / 2, PARTS = 256 };

typedef enum truth { ILLEGAL, TIE, LEGAL } truth;
static const char STATUS[] = " tL";
typedef struct place {
  long x, y;
} place;
/* 256 t, of a centre on the bisector of the pair: middle + t times the normal. */
typedef struct pair {
  int i, j;
  truth is;
  long centre;
} pair;
typedef struct point_set {
  place at[MOST];
  int n, pairs;
  pair pair[PAIRS];
} point_set;
/* how[k]: 'L' with its witness, 't', 'l', or ' ', not listed. */
typedef struct forgery {
  const point_set *of;
  char how[PAIRS];
  unsigned long triangles, unproved;
} forgery;
typedef struct totals {
  size_t sets, texts, accepted, complete, rejected;
} totals;

/* ---- the truth ---- */

/* An end of an interval: num / den, den > 0. */
typedef struct end {
  long num, den;
  bool there;
} end;

static bool end_is_less(end a, end b) {
  return a.num * b.den < b.num * a.den;
}

/* A multiple of 1/256 between the ends, which are not too near. */
static long number_between(end low, end high) {
  if (!low.there && !high.there) return 0;
  long from = low.there ? low.num * PARTS / low.den - 1 : high.num * PARTS / high.den - 2;
  for (long c = from; c < from + 2 * PARTS; c++) {
    end at = {c, PARTS, true};
    if ((!low.there || end_is_less(low, at)) && (!high.there || end_is_less(at, high))) return c;
  }
  fail_msg("no centre between %ld/%ld and %ld/%ld", low.num, low.den, high.num, high.den);
  return 0;
}

/* The pair by the ends of its interval: t with 2 t (normal . (k - i)) <= |k - i|^2 - (k - i) . (j - i) for all k. */
static void pair_find(pair *p, const point_set *s) {
  const place *a = &s->at[p->i], *b = &s->at[p->j];
  end low = {0, 1, false}, high = low;
  bool strict = true, weak = true, left = true, right = true;
  for (int k = 0; k < s->n; k++) {
    if (k == p->i || k == p->j) continue;
    long x = s->at[k].x - a->x, y = s->at[k].y - a->y, dx = b->x - a->x, dy = b->y - a->y;
    long slope = 2 * (dx * y - dy * x), most = x * x + y * y - x * dx - y * dy;
    left = left && slope <= 0;
    right = right && slope >= 0;
    end at = {slope < 0 ? -most : most, slope < 0 ? -slope : slope, true};
    if (slope > 0 && (!high.there || end_is_less(at, high))) high = at;
    if (slope < 0 && (!low.there || end_is_less(low, at))) low = at;
    if (slope == 0) strict = strict && most > 0;
    if (slope == 0) weak = weak && most >= 0;
  }
  bool both = low.there && high.there;
  strict = strict && !(both && !end_is_less(low, high));
  weak = (weak && !(both && end_is_less(high, low))) || left || right;
  p->is = strict ? LEGAL : weak ? TIE : ILLEGAL;
  p->centre = strict ? number_between(low, high) : 0;
}

static void set_find(point_set *s) {
  s->pairs = 0;
  for (int i = 0; i < s->n; i++)
    for (int j = i + 1; j < s->n; j++) {
      s->pair[s->pairs] = (pair){.i = i, .j = j};
      pair_find(&s->pair[s->pairs++], s);
    }
}

/* ---- the text ---- */

/* m / 512 as certificates have it. */
static void put_number(FILE *out, long m) {
  int e = -9;
  if (m == 0) {
    fputs(" 0", out);
    return;
  }
  for (; m % 2 == 0; m /= 2) e++;
  fprintf(out, e ? " %ld*2^%d" : " %ld", m, e);
}

static void put_witnessed(FILE *out, const point_set *s, const pair *p) {
  const place *a = &s->at[p->i], *b = &s->at[p->j];
  fprintf(out, "%d %d", p->i, p->j);
  put_number(out, PARTS * (a->x + b->x) - 2 * p->centre * (b->y - a->y));
  put_number(out, PARTS * (a->y + b->y) + 2 * p->centre * (b->x - a->x));
  fputc('\n', out);
}

static bool is_farthest(const point_set *s, int i, long x, long y) {
  for (int k = 0; k < s->n; k++)
    if (k != i && x * (s->at[k].x - s->at[i].x) + y * (s->at[k].y - s->at[i].y) >= 0) return false;
  return true;
}

/* An outward direction of corner i; false: it is none. */
static bool corner_find(long u[2], const point_set *s, int i) {
  for (u[0] = -SIDE; u[0] <= SIDE; u[0]++)
    for (u[1] = -SIDE; u[1] <= SIDE; u[1]++)
      if (is_farthest(s, i, u[0], u[1])) return true;
  return false;
}

static void put_corners(FILE *out, const point_set *s) {
  long u[2];
  int corners = 0;
  for (int i = 0; i < s->n; i++) corners += corner_find(u, s, i);
  fprintf(out, "corners %d\n", corners);
  for (int i = 0; i < s->n; i++)
    if (corner_find(u, s, i)) {
      fprintf(out, "%d", i);
      put_number(out, 2 * PARTS * u[0]);
      put_number(out, 2 * PARTS * u[1]);
      fputc('\n', out);
    }
}

/* Returns true if i and j are joined by pairs that are marked. */
static bool are_joined(const point_set *s, const bool *marked, int i, int j) {
  unsigned reached = 1U << i;
  for (int round = 0; round < s->n; round++)
    for (int k = 0; k < s->pairs; k++)
      if (marked[k] && (reached >> s->pair[k].i & 1 || reached >> s->pair[k].j & 1))
        reached |= 1U << s->pair[k].i | 1U << s->pair[k].j;
  return reached >> j & 1;
}

/* Legal pairs, and bridges until all sites are joined. */
static void put_edges(FILE *out, const forgery *f) {
  const point_set *s = f->of;
  bool marked[PAIRS], bridge[PAIRS] = {false};
  int legal = 0, bridges = 0;
  for (int k = 0; k < s->pairs; k++) legal += marked[k] = f->how[k] == 'L';
  for (int k = 0; k < s->pairs; k++) {
    bridge[k] = s->pair[k].is == LEGAL && !are_joined(s, marked, s->pair[k].i, s->pair[k].j);
    marked[k] |= bridge[k];
    bridges += bridge[k];
  }
  fprintf(out, "legal %d\n", legal);
  for (int k = 0; k < s->pairs; k++)
    if (f->how[k] == 'L') put_witnessed(out, s, &s->pair[k]);
  fprintf(out, "places 0\nbridges %d\n", bridges);
  for (int k = 0; k < s->pairs; k++)
    if (bridge[k]) put_witnessed(out, s, &s->pair[k]);
}

static void put_text(FILE *out, const forgery *f) {
  const point_set *s = f->of;
  bool open = false;
  for (int k = 0; k < s->pairs; k++) open |= f->how[k] == 't' || f->how[k] == 'l';
  fprintf(out, "dyadel certificate 1\noutcome %s\ngoal decided\ncapped no\nsites %d\n", open ? "fixpoint" : "decided",
          s->n);
  for (int i = 0; i < s->n; i++) {
    static const char *const number[SIDE] = {"0", "1", "1*2^1"};
    fprintf(out, "%s %s\n", number[s->at[i].x], number[s->at[i].y]);
  }
  put_edges(out, f);
  put_corners(out, s);
  fputs("pairs\n", out);
  for (int k = 0; k < s->pairs; k++)
    if (f->how[k] == 't' || f->how[k] == 'l') fprintf(out, "%c %d %d\n", f->how[k], s->pair[k].i, s->pair[k].j);
  fprintf(out, "triangles %lu\nunproved %lu\narea none\nhausdorff none\nend\n", f->triangles, f->unproved);
}

/* ---- the verdict ---- */

/* Puts right the counts that the checker says are wrong, which are no statement on a pair. */
static bool count_is_mended(forgery *f, const char *message) {
  unsigned long count;
  const char *triangles = strstr(message, "there are "), *unproved = strstr(message, "that are not listed, ");
  if (triangles && sscanf(triangles, "there are %lu sure", &count) == 1) return f->triangles = count, true;
  if (unproved && sscanf(unproved, "that are not listed, %lu are", &count) == 1) return f->unproved = count, true;
  return false;
}

static void judge(totals *t, forgery *f) {
  static char text[8192];
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  dyd_status st;
  f->triangles = f->unproved = 0;
  do {
    FILE *out = fmemopen(text, sizeof text, "w");
    put_text(out, f);
    fclose(out);
    st = certificate_check(&report, text, strlen(text), &err);
  } while (st != DYD_OK && count_is_mended(f, err.message));
  const point_set *s = f->of;
  size_t ties = 0, forged = 0, missed = 0;
  bool true_statement = true;
  for (int k = 0; k < s->pairs; k++) {
    ties += f->how[k] == 't' && s->pair[k].is == TIE;
    forged += f->how[k] == 't' && s->pair[k].is != TIE;
    missed += f->how[k] == ' ' && s->pair[k].is != ILLEGAL;
    true_statement &= f->how[k] == STATUS[s->pair[k].is];
  }
  t->texts++;
  t->rejected += st != DYD_OK;
  if (st != DYD_OK && true_statement) fail_msg("%s is rejected: %s", text, err.message);
  if (st != DYD_OK) return;
  t->accepted++;
  t->complete += report.gaps == 0;
  if (report.tie - report.ties_unproved > ties) fail_msg("a forged tie is proved:\n%s", text);
  if (!report.gaps && (forged || missed || strchr(f->how, 'l'))) fail_msg("all is proved:\n%s", text);
  if (!report.unproved && missed) fail_msg("the list is proved to be complete:\n%s", text);
  if (true_statement && report.gaps) fail_msg("not all is proved (%u):\n%s", report.gaps, text);
}

/* ---- all of them ---- */

/* Tries every combination of the statuses; "=" is the true one. */
static void try_statuses(totals *t, const point_set *s, const char *statuses) {
  size_t kinds = strlen(statuses), all = 1;
  for (int k = 0; k < s->pairs; k++) all *= kinds;
  for (size_t code = 0; code < all; code++) {
    forgery f = {.of = s};
    size_t rest = code;
    for (int k = 0; k < s->pairs; k++, rest /= kinds) {
      char how = statuses[rest % kinds];
      f.how[k] = how == '=' ? STATUS[s->pair[k].is] : how;
    }
    judge(t, &f);
  }
}

static void try_set(totals *t, unsigned chosen, int n) {
  point_set s = {.n = 0};
  for (unsigned k = 0; k < SIDE * SIDE; k++)
    if (chosen >> k & 1) s.at[s.n++] = (place){k / SIDE, k % SIDE};
  set_find(&s);
  t->sets++;
  bool all = n < MOST || test_cases_all(1) > 1;
  if (all) try_statuses(t, &s, "=t ");
  try_statuses(t, &s, all ? "=tl" : "=t");
}

static void all_sets(void **state) {
  (void)state;
  totals t = {0};
  for (int n = 3; n <= MOST; n++)
    for (unsigned chosen = 0; chosen < 1U << SIDE * SIDE; chosen += n < MOST ? 1 : (unsigned)test_stride())
      if (__builtin_popcount(chosen) == n) try_set(&t, chosen, n);
  fprintf(stderr, "# %zu sets, %zu certificates: %zu accepted, %zu of them proved, %zu rejected\n", t.sets, t.texts,
          t.accepted, t.complete, t.rejected);
  assert_true(t.complete >= t.sets && t.accepted > t.complete);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(all_sets)};
  return cmocka_run_group_tests_name("forged statuses", tests, NULL, NULL);
}
