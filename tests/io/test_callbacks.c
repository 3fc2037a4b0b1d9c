/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Files over callbacks, exact rectangles as text, and answers as rationals: a value written is read back unchanged. */
#include "rect/rect.h"
#include "support/random.h"
#include <dyadel/dyadel.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* Bytes written, and bytes left to read, `piece` at a time; fails behind `most` bytes. */
typedef struct tape {
  char bytes[20000];
  size_t length, at, piece, most;
} tape;

static bool tape_put(void *user, const char *bytes, size_t count) {
  tape *t = user;
  if (t->length + count > t->most) return false;
  memcpy(t->bytes + t->length, bytes, count);
  t->length += count;
  return true;
}

static bool tape_get(size_t *got, void *user, char *bytes, size_t room) {
  tape *t = user;
  if (t->at >= t->most) return false;
  *got = t->length - t->at;
  if (*got > t->piece) *got = t->piece;
  if (*got > room) *got = room;
  memcpy(bytes, t->bytes + t->at, *got);
  t->at += *got;
  return true;
}

static dyd_engine *engine_of(const char *text) {
  dyd_engine *e = NULL;
  assert_int_equal(DYD_OK, dyd_engine_new(&e));
  assert_int_equal(DYD_OK, dyd_engine_add_text(e, text, strlen(text), NULL, NULL));
  return e;
}

static const char points[] = "0 0\n1/3 [1,2]\n5*2^-9 0.1\n-7/9 22\n[1/3,1/2] 3+-1/7\n";

static void test_written_and_read(void **state) {
  (void)state;
  for (size_t piece = 1; piece < 50; piece += 12) {
    tape t = {.piece = piece, .most = sizeof t.bytes};
    FILE *f = NULL;
    dyd_engine *e = engine_of(points), *again = NULL;
    assert_int_equal(DYD_OK, dyd_file_of_callback(&f, tape_put, NULL, &t, NULL));
    assert_int_equal(DYD_OK, dyd_write_rects(f, dyd_engine_sites(e), 0, 5, NULL));
    assert_int_equal(DYD_E_ARG, dyd_write_rects(f, dyd_engine_sites(e), 1, 5, NULL));
    assert_int_equal(0, fclose(f));
    for (char *q = t.bytes; *q; q++) /* four ends become two intervals */
      if (*q == '\n') *q = ';';
    char text[4000] = "", *line = strtok(t.bytes, ";");
    for (; line; line = strtok(NULL, ";")) {
      char end[4][200];
      assert_int_equal(4, sscanf(line, "%199s %199s %199s %199s", end[0], end[1], end[2], end[3]));
      snprintf(text + strlen(text), sizeof text - strlen(text), "[%s,%s] [%s,%s]\n", end[0], end[1], end[2], end[3]);
    }
    t.length = strlen(text);
    memcpy(t.bytes, text, t.length);
    assert_int_equal(DYD_OK, dyd_engine_new(&again));
    assert_int_equal(DYD_OK, dyd_file_of_callback(&f, NULL, tape_get, &t, NULL));
    assert_int_equal(DYD_OK, dyd_read_points(again, f, NULL, NULL));
    assert_int_equal(0, fclose(f));
    dyd_rect a, b;
    dyd_rect_init(&a);
    dyd_rect_init(&b);
    assert_int_equal(5, dyd_engine_count(again));
    for (size_t i = 0; i < 5; i++) {
      assert_int_equal(DYD_OK, dyd_sites_get(&a, dyd_engine_sites(e), i));
      assert_int_equal(DYD_OK, dyd_sites_get(&b, dyd_engine_sites(again), i));
      assert_true(dyd_rect_equal(&a, &b));
    }
    dyd_rect_clear(&b);
    dyd_rect_clear(&a);
    dyd_engine_free(again);
    dyd_engine_free(e);
  }
}

static void test_failing(void **state) {
  (void)state;
  tape t = {.piece = 3, .most = 20};
  FILE *f = NULL;
  dyd_error err;
  dyd_engine *e = engine_of(points), *again = NULL;
  assert_int_equal(DYD_E_ARG, dyd_file_of_callback(&f, NULL, NULL, &t, &err));
  assert_int_equal(DYD_E_ARG, dyd_file_of_callback(&f, tape_put, tape_get, &t, &err));
  assert_int_equal(DYD_OK, dyd_file_of_callback(&f, tape_put, NULL, &t, &err));
  setvbuf(f, NULL, _IONBF, 0);
  assert_int_equal(DYD_E_IO, dyd_write_rects(f, dyd_engine_sites(e), 0, 5, &err));
  assert_int_equal(EOF, fclose(f));
  t.length = sizeof points - 1;
  memcpy(t.bytes, points, t.length);
  assert_int_equal(DYD_OK, dyd_engine_new(&again));
  assert_int_equal(DYD_OK, dyd_file_of_callback(&f, NULL, tape_get, &t, &err));
  assert_int_equal(DYD_E_IO, dyd_read_points(again, f, NULL, &err));
  assert_int_equal(EOF, fclose(f));
  assert_int_equal(0, dyd_engine_count(again));
  dyd_engine_free(again);
  dyd_engine_free(e);
}

/* As text has it, dyd_rect_narrow_q has it. */
static void test_rational_answers(void **state) {
  (void)state;
  static const char *const answer[] = {"0 1 0 1", "1/3 2/3 0 1/7", "1/2 1/3 0 1", "5*2^-9 5*2^-9 -1 2/7", "0 1 3 2"};
  mpq_t end[4];
  for (int k = 0; k < 4; k++) mpq_init(end[k]);
  for (size_t k = 0; k < sizeof answer / sizeof *answer; k++) {
    dyd_rect a, b;
    char word[4][40];
    dyd_error text_err, err;
    dyd_rect_init(&a);
    dyd_rect_init(&b);
    dyd_error_clear(&text_err);
    dyd_error_clear(&err);
    assert_int_equal(4, sscanf(answer[k], "%39s %39s %39s %39s", word[0], word[1], word[2], word[3]));
    for (int e = 0; e < 4; e++) assert_int_equal(DYD_OK, dyd_real_parse_exact(end[e], word[e], strlen(word[e])));
    for (int twice = 0; twice < 2; twice++) {
      dyd_status st = dyd_rect_narrow_text(&a, answer[k], strlen(answer[k]), &text_err);
      assert_int_equal(st, dyd_rect_narrow_q(&b, (const mpq_t *)end, &err));
      assert_string_equal(text_err.message, err.message);
      assert_true(dyd_rect_equal(&a, &b));
    }
    dyd_rect_clear(&b);
    dyd_rect_clear(&a);
  }
  for (int k = 0; k < 4; k++) mpq_clear(end[k]);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_written_and_read), cmocka_unit_test(test_failing),
                                     cmocka_unit_test(test_rational_answers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
