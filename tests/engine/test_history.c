/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a history keeps of each stage is what the triangulation said then; where memory is exhausted it is as before. */
#include "engine/help.h"
#include "support/failing_memory.h"

#include "engine/record.h"
#include <dyadel/io.h>
#include <string.h>

enum { STAGES = 40, POINTS = 12 };

/* Records the statements after each stage. */
typedef struct witness {
  dyd_engine *e;
  dyd_history *h;
  size_t stages;
  dyd_pair_list pairs[STAGES];
  double box[STAGES][POINTS][4];
} witness;

/* Notes a stage while memory fails: the second allocation of the note's own, again and again. Those before it stay, so
 * that it is another one each time. */
static void note_poorly(dyd_history *h, const dyd_delaunay *pd) {
  enum { MANY = 1000 };
  const dyd_history before = *h;
  dyd_pair_list pairs = {0};
  countdown = MANY;
  assert_int_equal(dyd_delaunay_pairs(&pairs, pd), DYD_OK);
  size_t listing = MANY - countdown;
  dyd_pair_list_clear(&pairs);
  for (size_t k = 1, tries = 0;; k++, tries++) {
    countdown = k < listing + 2 ? k : listing + 2;
    dyd_status st = dyd_history_note(h, pd);
    countdown = 0;
    if (st == DYD_OK) return;
    assert_int_equal(st, DYD_E_NOMEM);
    assert_true(h->stages == before.stages && h->changes == before.changes && h->boxes == before.boxes);
    assert_true(tries < MANY);
  }
}

static void witness_stage(void *user, const dyd_progress *p) {
  witness *w = user;
  const dyd_delaunay *pd = dyd_engine_delaunay(w->e);
  (void)p;
  assert_true(w->stages < STAGES);
  assert_int_equal(dyd_delaunay_pairs(&w->pairs[w->stages], pd), DYD_OK);
  for (size_t i = 0; i < dyd_engine_count(w->e); i++)
    if (dyd_delaunay_alias(pd, (uint32_t)i) == i)
      dyd_sites_get_d(w->box[w->stages][i], dyd_delaunay_sites(pd), i);
    else if (w->stages) /* the box of an alias is not reported any more */
      memcpy(w->box[w->stages][i], w->box[w->stages - 1][i], sizeof w->box[0][0]);
  note_poorly(w->h, pd);
  w->stages++;
}

/* Tells the story anew, stage by stage. */
static void assert_told(const witness *w, size_t n) {
  static dyd_pair_status now[POINTS][POINTS];
  double box[POINTS][4] = {{0}};
  memset(now, 0, sizeof now);
  assert_int_equal(w->h->stages, w->stages);
  for (size_t s = 0; s < w->stages; s++) {
    size_t count = 0;
    for (size_t k = w->h->change_begin[s]; k < dyd_history_changes_end(w->h, s); k++) {
      const dyd_pair *p = &w->h->change[k];
      assert_true(now[p->i][p->j] != p->status);
      now[p->i][p->j] = p->status;
    }
    for (size_t k = w->h->box_begin[s]; k < dyd_history_boxes_end(w->h, s); k++)
      memcpy(box[w->h->box[k].site], w->h->box[k].box, sizeof *box);
    for (size_t i = 0; i < n; i++)
      for (size_t j = 0; j < n; j++) count += now[i][j] != DYD_ILLEGAL;
    assert_int_equal(count, w->pairs[s].count);
    for (size_t k = 0; k < count; k++)
      assert_int_equal(now[w->pairs[s].item[k].i][w->pairs[s].item[k].j], w->pairs[s].item[k].status);
    assert_memory_equal(box, w->box[s], n * sizeof *box);
  }
}

static void check_history(const char *text, const dyd_engine_options *options) {
  static witness w;
  dyd_engine_options o = *options;
  dyd_outcome outcome;
  w = (witness){.e = engine_new()};
  o.progress = witness_stage;
  o.progress_user = &w;
  assert_int_equal(dyd_history_new(&w.h), DYD_OK);
  assert_int_equal(dyd_engine_add_text(w.e, text, strlen(text), NULL, NULL), DYD_OK);
  assert_int_equal(dyd_engine_run(&outcome, w.e, &o, NULL), DYD_OK);
  assert_told(&w, dyd_engine_count(w.e));
  dyd_engine *other = engine_new();
  assert_int_equal(dyd_engine_add_text(other, "0 0\n1 1\n", 8, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_engine_run(&outcome, other, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_history_note(w.h, dyd_engine_delaunay(other)), DYD_E_ARG);
  assert_int_equal(w.h->stages, w.stages);
  dyd_engine_free(other);
  for (size_t s = 0; s < w.stages; s++) dyd_pair_list_clear(&w.pairs[s]);
  dyd_history_free(w.h);
  dyd_engine_free(w.e);
}

static void test_history(void **state) {
  (void)state;
  dyd_engine_options slow, plain;
  dyd_engine_options_init(&slow);
  dyd_engine_options_init(&plain);
  slow.start_bits = 1;
  slow.step_bits = 3;
  slow.max_bits = 90;
  check_history("sqrt(2) pi\n1/3 0\ncos(1) e\nsqrt(3) sqrt(5)\nexp(1) 1\n0.5 2.5\nsin(2) 1.1\nsqrt(2)+1e-9 pi\n",
                &slow);
  check_history("0 0\n1 0\n0 1\n1 1\n[2,3] [0,4]\n", &plain);
  slow.schedule = DYD_SCHEDULE_UNIFORM;
  check_history("sqrt(2) 0\n-sqrt(2) 0\n0 sqrt(2)\n0 -sqrt(2)\npi 1\n1 e\n", &slow);
  check_history("sqrt(8) 1\n2*sqrt(2) 1\n0 0\n1 5\n4 0\n", &slow); /* the first two are one place */
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_history)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
