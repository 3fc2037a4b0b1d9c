/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Thousands of small sets in pieces: the output of all ranks together is that of one engine [REACH-1] [TILE-1]. Ranks
 * begin with little more than their own sites, and get few at a time: all depends on their requests. */
#include <setjmp.h>
#include <stdarg.h>

#include "tiles/sets.h"

#include "tiles/tiles.h"
#include <cmocka.h>
#include <inttypes.h>
#include <math.h>
#include <unistd.h>

enum { MOST_RANKS = 9 };

/* Files written here need not survive a power cut. */
int fsync(int file) {
  (void)file;
  return 0;
}

/* The csv of one engine; the caller frees it. Returns NULL when the pairs are too many for a quick test. */
static char *text_of_one(const sets_case *s) {
  static const char *const word[] = {"illegal", "tie", "indeterminate", "legal"};
  char *text = NULL;
  size_t size = 0;
  dyd_pair_list l = {0};
  dyd_engine *e = sets_engine(s);
  if (!e) return NULL;
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  assert_int_equal(dyd_delaunay_pairs(&l, pd), DYD_OK);
  FILE *out = open_memstream(&text, &size);
  for (uint32_t i = 0; i < s->n; i++) {
    uint32_t of = dyd_delaunay_alias(pd, i);
    if (of != i) fprintf(out, "# alias %" PRIu32 " %" PRIu32 "\n", i, of);
  }
  fprintf(out, "i,j,status\n");
  for (size_t k = 0; k < l.count; k++)
    fprintf(out, "%" PRIu32 ",%" PRIu32 ",%s\n", l.item[k].i, l.item[k].j, word[l.item[k].status]);
  fclose(out);
  dyd_pair_list_clear(&l);
  dyd_engine_free(e);
  return text;
}

static void write_input(const char *name, const sets_case *s) {
  FILE *f = fopen(name, "wb");
  assert_non_null(f);
  for (size_t i = 0; i < s->n; i++) fwrite(s->end[i], sizeof(double), s->dim, f);
  assert_int_equal(fclose(f), 0);
}

/* The same of parts; *total: the counters of all. */
static char *text_of_parts(const tiles_job *job, tiles_counters *total) {
  tile member[MOST_RANKS];
  dyd_error err;
  bool elsewhere;
  char *text = NULL;
  size_t size = 0;
  dyd_error_clear(&err);
  for (size_t k = 0; k < job->ranks; k++) assert_int_equal(tile_new(&member[k], job, k, &err), DYD_OK);
  if (tiles_drive(member, job->ranks, &tiles_in_memory, &elsewhere, &err) != DYD_OK) fail_msg("%s", err.message);
  *total = member[0].counters;
  for (size_t k = 0; k < job->ranks; k++) tile_free(&member[k]);
  FILE *out = open_memstream(&text, &size);
  assert_int_equal(tiles_write_csv(out, job->folder, true, &err), DYD_OK);
  fclose(out);
  return text;
}

/* A site in the gap of a hidden witness, and crowds far away, so that it belongs to another rank. */
static void hidden_with_others(sets_case *s, test_random *r) {
  sets_hidden(s, r);
  for (unsigned crowds = (unsigned)test_below(r, 4), k = 0; k <= crowds; k++) {
    const double turn = 6.3 * test_unit(r), far = k ? 4 + 20 * test_unit(r) : 2 * test_unit(r);
    const double at[2] = {1.5 * (k == 0) + far * cos(turn), far * sin(turn)};
    for (size_t left = k ? test_below(r, 30) : 1; left > 0 && s->n < SETS_MOST; left--, s->n++)
      for (int e = 0; e < 2; e++) s->end[s->n][2 * e] = s->end[s->n][2 * e + 1] = at[e] + (k ? 0.5 * test_unit(r) : 0);
  }
}

static void job_draw(tiles_job *job, test_random *r) {
  static const double halo[] = {0, 0, 0.1, 0.5, 3};
  static const unsigned corners[] = {0, 1, 4, 16};
  job->ranks = 2 + (size_t)test_below(r, MOST_RANKS - 1);
  job->halo = halo[test_below(r, 5)];
  job->corners = corners[test_below(r, 4)];
  job->nearest = 1 + (size_t)test_below(r, 3);
}

static void test_union(void **state) {
  (void)state;
  test_random r = test_random_start("union");
  char folder[] = "dyadel-union-XXXXXX", input[64];
  uint64_t rounds = 0, ghosts = 0, own = 0;
  size_t tried = 0;
  assert_non_null(mkdtemp(folder));
  snprintf(input, sizeof input, "%s/in.bin", folder);
  for (size_t c = 0; c < test_cases(3000); c++) {
    sets_case s;
    tiles_counters total;
    if (test_chance(&r, 5))
      hidden_with_others(&s, &r);
    else
      sets_make(&s, &r, 0, test_chance(&r, 8) ? SETS_MOST : 36);
    write_input(input, &s);
    tiles_job job = {.input = input, .folder = folder, .boxes = s.dim == 4, .size = s.n * s.dim * sizeof(double)};
    job_draw(&job, &r);
    char *one = text_of_one(&s);
    if (!one) continue;
    char *parts = text_of_parts(&job, &total);
    if (strcmp(one, parts) != 0) {
      sets_print(&s);
      fail_msg("case %zu, %zu ranks, halo %g, %u corners, %zu nearest: one says\n%sparts say\n%s", c, job.ranks,
               job.halo, job.corners, job.nearest, one, parts);
    }
    rounds += total.rounds;
    ghosts += total.ghosts;
    own += total.own;
    free(one);
    free(parts);
    tried++;
  }
  fprintf(stderr, "# %" PRIu64 " sites, %" PRIu64 " ghosts, %" PRIu64 " rounds in %zu cases\n", own, ghosts, rounds,
          tried);
  char command[96];
  snprintf(command, sizeof command, "rm -r %s", folder);
  assert_int_equal(system(command), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_union)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
