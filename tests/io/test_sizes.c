/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The ABI rules of dyadel/dyadel.h at every call that takes or fills in a struct with a size: callers with shorter and
 * with longer structs, callers that never set the size. */
#include "engine/record.h"
#include <dyadel/dyadel.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MORE = 24, GUARD = 0xAA };

typedef struct fixture {
  dyd_engine *e; /* has run */
  FILE *sink;
} fixture;

static dyd_status open_engine(dyd_engine **out, void *user, dyd_error *err) {
  static const char text[] = "0 0\n1 sqrt(2)-1\n[0,1/8] 1\n1 1\n";
  (void)user;
  assert_int_equal(DYD_OK, dyd_engine_new(out));
  return dyd_engine_add_text(*out, text, sizeof text - 1, NULL, err);
}

static dyd_engine *new_engine(void) {
  dyd_engine *e = NULL;
  assert_int_equal(DYD_OK, open_engine(&e, NULL, NULL));
  return e;
}

/* ---- calls that take a struct ---- */

static dyd_status delaunay_new(fixture *f, const void *s, dyd_error *err) {
  dyd_delaunay *pd = NULL;
  dyd_status st = dyd_delaunay_new(&pd, dyd_delaunay_sites(dyd_engine_delaunay(f->e)), s, err);
  dyd_delaunay_free(pd);
  return st;
}

static dyd_status delaunay_update(fixture *f, const void *s, dyd_error *err) {
  dyd_delaunay *pd = NULL;
  const uint32_t changed[] = {0};
  assert_int_equal(DYD_OK, dyd_delaunay_new(&pd, dyd_delaunay_sites(dyd_engine_delaunay(f->e)), NULL, err));
  dyd_status st = dyd_delaunay_update(pd, changed, 1, s, err);
  dyd_delaunay_free(pd);
  return st;
}

static dyd_status engine_run(fixture *f, const void *s, dyd_error *err) {
  (void)f;
  dyd_outcome outcome;
  dyd_engine *e = new_engine();
  dyd_status st = dyd_engine_run(&outcome, e, s, err);
  assert_true((outcome == DYD_OUTCOME_ERROR) == (st != DYD_OK));
  dyd_engine_free(e);
  return st;
}

static dyd_status engine_nearest(fixture *f, const void *s, dyd_error *err) {
  dyd_stream *at = NULL;
  dyd_index_list list = {0};
  dyd_outcome outcome;
  bool sure;
  assert_int_equal(DYD_OK, dyd_engine_stream(&at, f->e, 3));
  dyd_status st = dyd_engine_nearest(&list, &sure, &outcome, f->e, at, s, err);
  dyd_index_list_clear(&list);
  dyd_stream_free(at);
  return st;
}

static dyd_status converge(fixture *f, const void *options, const void *c, dyd_error *err) {
  (void)f;
  dyd_convergence table = {DYD_SIZED(dyd_convergence)};
  dyd_engine *e = new_engine();
  dyd_status st = dyd_converge_run(&table, e, options, c, err);
  dyd_convergence_clear(&table);
  assert_true(table.struct_size == sizeof table);
  dyd_engine_free(e);
  return st;
}

static dyd_status converge_run(fixture *f, const void *s, dyd_error *err) {
  return converge(f, s, NULL, err);
}

static dyd_status converge_run_converge(fixture *f, const void *s, dyd_error *err) {
  return converge(f, NULL, s, err);
}

static dyd_status convergence_add(fixture *f, const void *s, dyd_error *err) {
  dyd_convergence table = {DYD_SIZED(dyd_convergence)};
  dyd_stage_row *row = NULL;
  dyd_status st = dyd_convergence_add(&row, &table, dyd_engine_delaunay(f->e), s, false, err);
  if (st == DYD_OK) assert_true(row->struct_size == sizeof *row && row->rungs.struct_size == sizeof row->rungs);
  dyd_convergence_clear(&table);
  return st;
}

static dyd_status trace(fixture *f, const void *options, const void *c, dyd_error *err) {
  dyd_trace *t = NULL;
  dyd_status st = dyd_trace_new(&t, f->sink, f->e, NULL, options, c, err);
  if (t) assert_int_equal(DYD_OK, dyd_trace_end(t, DYD_OUTCOME_DECIDED, NULL));
  return st;
}

static dyd_status trace_new(fixture *f, const void *s, dyd_error *err) {
  return trace(f, s, NULL, err);
}

static dyd_status trace_new_converge(fixture *f, const void *s, dyd_error *err) {
  return trace(f, NULL, s, err);
}

/* A trace without a point and without a stage. */
static dyd_status trace_replay(fixture *f, const void *s, dyd_error *err) {
  (void)f;
  dyd_convergence table = {DYD_SIZED(dyd_convergence)};
  dyd_engine *e = NULL;
  FILE *file = tmpfile();
  assert_non_null(file);
  assert_int_equal(DYD_OK, dyd_engine_new(&e));
  assert_int_equal(DYD_OK, trace(&(fixture){e, file}, NULL, NULL, NULL));
  rewind(file);
  dyd_status st = dyd_trace_replay(&table, file, s, err);
  dyd_convergence_clear(&table);
  fclose(file);
  dyd_engine_free(e);
  return st;
}

/* Schedules of it are done at once. */
static dyd_status open_point(dyd_engine **out, void *user, dyd_error *err) {
  (void)user;
  assert_int_equal(DYD_OK, dyd_engine_new(out));
  return dyd_engine_add_text(*out, "0 0", 3, NULL, err);
}

static dyd_status check_run(fixture *f, const void *s, dyd_error *err) {
  (void)f;
  dyd_check_report report = {DYD_SIZED(dyd_check_report)};
  dyd_status st = dyd_check_run(&report, open_point, NULL, s, err);
  dyd_check_report_clear(&report);
  assert_true(report.struct_size == sizeof report);
  return st;
}

static dyd_status oracle_new(fixture *f, const void *s, dyd_error *err) {
  (void)f;
  dyd_source source = {DYD_SIZED(dyd_source)};
  size_t points;
  dyd_status st = dyd_oracle_source(&source, &points, "echo points 3; exec cat >/dev/null", s, err);
  if (st == DYD_OK) source.release(source.user);
  return st;
}

static dyd_status add_text(fixture *f, const void *s, dyd_error *err) {
  (void)f;
  dyd_engine *e = new_engine();
  dyd_status st = dyd_engine_add_text(e, "5 6", 3, s, err);
  assert_true(dyd_engine_count(e) == (st == DYD_OK ? 5 : 4));
  dyd_engine_free(e);
  return st;
}

static dyd_status read_points(fixture *f, const void *s, dyd_error *err) {
  (void)f;
  FILE *in = tmpfile();
  assert_non_null(in);
  dyd_engine *e = new_engine();
  dyd_status st = dyd_read_points(e, in, s, err);
  dyd_engine_free(e);
  fclose(in);
  return st;
}

static dyd_status write_voronoi(fixture *f, const void *s, dyd_error *err) {
  return dyd_write(f->sink, f->e, DYD_CONTENT_VORONOI, DYD_FORMAT_CSV, s, err);
}

typedef struct taking {
  const char *type;
  size_t size;
  dyd_status (*call)(fixture *f, const void *s, dyd_error *err);
} taking;

static const taking takings[] = {
    {"dyd_delaunay_options", sizeof(dyd_delaunay_options), delaunay_new},
    {"dyd_delaunay_options", sizeof(dyd_delaunay_options), delaunay_update},
    {"dyd_engine_options", sizeof(dyd_engine_options), engine_run},
    {"dyd_engine_options", sizeof(dyd_engine_options), engine_nearest},
    {"dyd_engine_options", sizeof(dyd_engine_options), converge_run},
    {"dyd_engine_options", sizeof(dyd_engine_options), trace_new},
    {"dyd_converge_options", sizeof(dyd_converge_options), converge_run_converge},
    {"dyd_converge_options", sizeof(dyd_converge_options), convergence_add},
    {"dyd_converge_options", sizeof(dyd_converge_options), trace_new_converge},
    {"dyd_converge_options", sizeof(dyd_converge_options), trace_replay},
    {"dyd_check_options", sizeof(dyd_check_options), check_run},
    {"dyd_oracle_options", sizeof(dyd_oracle_options), oracle_new},
    {"dyd_read_options", sizeof(dyd_read_options), add_text},
    {"dyd_read_options", sizeof(dyd_read_options), read_points},
    {"dyd_write_options", sizeof(dyd_write_options), write_voronoi},
};

/* The call with a struct of exactly `size` bytes, all 0 but for its size and the byte at `at` (0: none). */
static dyd_status take(const taking *t, fixture *f, size_t size, size_t claimed, size_t at, dyd_error *err) {
  unsigned char *s = calloc(1, size);
  assert_non_null(s);
  memcpy(s, &claimed, sizeof claimed);
  if (at) s[at] = 1;
  memset(err, GUARD, sizeof *err);
  dyd_status st = t->call(f, s, err);
  free(s);
  return st;
}

static void test_take(void **state) {
  fixture *f = *state;
  dyd_error err;
  for (size_t k = 0; k < sizeof takings / sizeof *takings; k++) {
    const taking *t = &takings[k];
    assert_int_equal(DYD_OK, t->call(f, NULL, &err));
    for (size_t size = sizeof size; size <= t->size + MORE; size += 8)
      if (take(t, f, size, size, 0, &err) != DYD_OK) fail_msg("%s, call %zu, %zu bytes: refused", t->type, k, size);
    if (take(t, f, t->size + MORE, t->size + MORE, t->size, &err) != DYD_E_ARG)
      fail_msg("%s, call %zu: a member that is not known is accepted", t->type, k);
    if (!strstr(err.message, t->type) || !strstr(err.message, "does not know")) fail_msg("%zu: %s", k, err.message);
    if (take(t, f, t->size, 0, 0, &err) != DYD_E_ARG) fail_msg("%s, call %zu: no size is accepted", t->type, k);
    if (!strstr(err.message, "DYD_SIZED") || !strstr(err.message, t->type)) fail_msg("%zu: %s", k, err.message);
  }
}

/* ---- calls that fill in a struct ---- */

static dyd_status delaunay_counters(fixture *f, void *s, dyd_error *err) {
  return dyd_delaunay_get_counters(s, dyd_engine_delaunay(f->e), err);
}

static dyd_status engine_counters(fixture *f, void *s, dyd_error *err) {
  return dyd_engine_get_counters(s, f->e, err);
}

static dyd_status verify(fixture *f, void *s, dyd_error *err) {
  FILE *file = tmpfile();
  assert_non_null(file);
  assert_int_equal(DYD_OK, dyd_write_certificate(file, f->e, NULL, NULL));
  rewind(file);
  dyd_status st = dyd_verify_certificate(s, file, NULL, err);
  fclose(file);
  return st;
}

static dyd_status oracle_source(fixture *f, void *s, dyd_error *err) {
  (void)f;
  size_t points;
  dyd_source *source = s;
  dyd_status st = dyd_oracle_source(source, &points, "echo points 3; exec cat >/dev/null", NULL, err);
  if (st == DYD_OK) source->release(source->user);
  return st;
}

typedef struct filling {
  const char *type;
  size_t size;
  dyd_status (*call)(fixture *f, void *s, dyd_error *err);
  size_t least; /* smaller structs are refused; 0: none is */
} filling;

static const filling fillings[] = {
    {"dyd_delaunay_counters", sizeof(dyd_delaunay_counters), delaunay_counters, 0},
    {"dyd_engine_counters", sizeof(dyd_engine_counters), engine_counters, 0},
    {"dyd_certificate_report", sizeof(dyd_certificate_report), verify, 0},
    {"dyd_source", sizeof(dyd_source), oracle_source, offsetof(dyd_source, announce)},
};

static void fill(const filling *t, fixture *f, size_t size) {
  unsigned char s[1024];
  dyd_error err;
  assert_true(size + MORE <= sizeof s);
  memset(s, GUARD, sizeof s);
  memcpy(s, &size, sizeof size);
  if (t->call(f, s, &err) != DYD_OK) fail_msg("%s, %zu bytes: refused", t->type, size);
  assert_memory_equal(s, &size, sizeof size);
  for (size_t k = size; k < sizeof s; k++)
    if (s[k] != GUARD) fail_msg("%s: byte %zu of %zu is written", t->type, k, size);
  for (size_t k = t->size; k < size; k++)
    if (s[k]) fail_msg("%s: byte %zu of %zu is not cleared", t->type, k, size);
}

static void test_fill(void **state) {
  fixture *f = *state;
  dyd_error err;
  for (size_t k = 0; k < sizeof fillings / sizeof *fillings; k++) {
    const filling *t = &fillings[k];
    for (size_t size = t->least ? t->least : sizeof size; size <= t->size + MORE; size += 8) fill(t, f, size);
    unsigned char none[1024] = {0};
    memcpy(none, &(size_t){t->least ? t->least - 8 : 0}, sizeof(size_t));
    assert_int_equal(DYD_E_ARG, t->call(f, none, &err));
    if (!strstr(err.message, "DYD_SIZED") || !strstr(err.message, t->type)) fail_msg("%zu: %s", k, err.message);
  }
}

/* ---- structs that live longer, and those with something to release ---- */

static void test_kept(void **state) {
  fixture *f = *state;
  dyd_error err;
  dyd_convergence table = {0};
  dyd_check_report report = {0};
  dyd_stage_row *row;
  dyd_engine *e = new_engine();
  assert_int_equal(DYD_E_ARG, dyd_converge_run(&table, e, NULL, NULL, &err));
  assert_non_null(strstr(err.message, "dyd_convergence s = {DYD_SIZED(dyd_convergence)}"));
  assert_int_equal(DYD_E_ARG, dyd_convergence_add(&row, &table, dyd_engine_delaunay(f->e), NULL, false, &err));
  assert_int_equal(DYD_E_ARG, dyd_trace_replay(&table, f->sink, NULL, &err));
  assert_int_equal(DYD_E_ARG, dyd_check_run(&report, open_engine, NULL, NULL, &err));
  assert_non_null(strstr(err.message, "dyd_check_report s = {DYD_SIZED(dyd_check_report)}"));
  dyd_convergence_clear(&table);
  dyd_check_report_clear(&report);
  assert_true(table.struct_size == 0 && report.struct_size == 0);
  const dyd_write_options o = {DYD_SIZED(dyd_write_options), .stages = &table, .report = &report};
  assert_int_equal(DYD_E_ARG, dyd_write(f->sink, NULL, DYD_CONTENT_CHECK, DYD_FORMAT_CSV, &o, &err));
  assert_non_null(strstr(err.message, "dyd_check_report s = {DYD_SIZED(dyd_check_report)}"));
  table.struct_size = sizeof table;
  assert_int_equal(DYD_E_ARG, dyd_write(f->sink, NULL, DYD_CONTENT_CONVERGENCE, DYD_FORMAT_CSV, &o, &err));
  assert_non_null(strstr(err.message, "no run"));
  assert_int_equal(DYD_E_ARG, dyd_write(f->sink, NULL, DYD_CONTENT_PLOT, DYD_FORMAT_SVG, &o, &err));
  assert_non_null(strstr(err.message, "no run"));
  dyd_engine_free(e);
}

static dyd_status narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  (void)user;
  assert_true(request->struct_size == sizeof *request);
  return dyd_rect_narrow_text(out, "0 1 0 1 fixed", 13, err);
}

static void count_release(void *user) {
  ++*(int *)user;
}

/* A caller that knows of no announce, and one that knows of more. */
static void test_source(void **state) {
  (void)state;
  int released = 0;
  dyd_error err;
  struct {
    dyd_source s;
    void (*later)(void *);
  } given = {{.narrow = narrow, .release = count_release, .user = &released}, NULL};
  const size_t sizes[] = {offsetof(dyd_source, announce), sizeof given.s, sizeof given};
  for (size_t k = 0; k < 3; k++) {
    dyd_stream *s = NULL;
    dyd_engine *e = new_engine();
    given.s.struct_size = sizes[k];
    given.s.announce = k ? NULL : (dyd_announce_fn)(void (*)(void))abort; /* beyond the size of the first */
    assert_int_equal(DYD_OK, dyd_engine_add_source(e, 1, &given.s, &err));
    assert_int_equal(DYD_OK, dyd_stream_new(&s, &given.s, 0, &err));
    assert_int_equal(DYD_FIXED, dyd_stream_narrow(s, 5, 50, &err));
    dyd_outcome outcome;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, NULL, &err));
    dyd_engine_free(e);
    dyd_stream_free(s);
    assert_int_equal(released, 2 * ((int)k + 1));
  }
  dyd_stream *s = NULL;
  dyd_engine *e = new_engine();
  given.later = count_release;
  assert_int_equal(DYD_E_ARG, dyd_engine_add_source(e, 1, &given.s, &err));
  assert_non_null(strstr(err.message, "does not know"));
  given.s.struct_size = 0;
  assert_int_equal(DYD_E_ARG, dyd_stream_new(&s, &given.s, 0, &err));
  assert_non_null(strstr(err.message, "dyd_source s = {DYD_SIZED(dyd_source)}"));
  assert_int_equal(released, 6);
  dyd_engine_free(e);
}

static void test_small(void **state) {
  fixture *f = *state;
  dyd_error err;
  dyd_rect window;
  dyd_voronoi_bounds b;
  dyd_nearest_answer a = {DYD_SIZED(dyd_nearest_answer)};
  dyd_rect_init(&window);
  dyd_voronoi_bounds_init(&b);
  assert_int_equal(DYD_OK, dyd_rect_set_d(&window, 0, 1, 0, 1));
  b.struct_size = 0;
  assert_int_equal(DYD_E_ARG, dyd_metric_voronoi(&b, dyd_engine_delaunay(f->e), &window, 10, NULL));
  const dyd_nearest_answer *const answer = &a;
  const dyd_write_options o = {DYD_SIZED(dyd_write_options), .window = &window, .bounds = &b, .answer = &answer,
                               .answers = 1};
  assert_int_equal(DYD_E_ARG, dyd_write(f->sink, f->e, DYD_CONTENT_VORONOI, DYD_FORMAT_CSV, &o, &err));
  assert_non_null(strstr(err.message, "dyd_voronoi_bounds"));
  b.struct_size = sizeof b;
  assert_int_equal(DYD_OK, dyd_metric_voronoi(&b, dyd_engine_delaunay(f->e), &window, 10, NULL));
  assert_int_equal(DYD_OK, dyd_write(f->sink, f->e, DYD_CONTENT_VORONOI, DYD_FORMAT_CSV, &o, &err));
  assert_int_equal(DYD_E_ARG, dyd_write(f->sink, f->e, DYD_CONTENT_NEAREST, DYD_FORMAT_CSV, &o, &err));
  assert_non_null(strstr(err.message, "no answer"));
  a.struct_size = 0;
  assert_int_equal(DYD_E_ARG, dyd_write(f->sink, f->e, DYD_CONTENT_NEAREST, DYD_FORMAT_CSV, &o, &err));
  assert_non_null(strstr(err.message, "DYD_SIZED(dyd_nearest_answer)"));
  dyd_voronoi_bounds_clear(&b);
  dyd_rect_clear(&window);
}

/* What callbacks are given tells its size. */
static void see_progress(void *user, const dyd_progress *p) {
  *(int *)user |= p->struct_size == sizeof *p;
}

static void see_step(void *user, const dyd_step *s) {
  *(int *)user |= (s->struct_size == sizeof *s) << 1;
}

static void see_row(void *user, const dyd_stage_row *row, const dyd_delaunay *pd) {
  *(int *)user |= (row->struct_size == sizeof *row && pd) << 2;
}

static void test_shown(void **state) {
  (void)state;
  int seen = 0;
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.progress = see_progress;
  o.trace = see_step;
  o.progress_user = o.trace_user = &seen;
  const dyd_converge_options c = {DYD_SIZED(dyd_converge_options), .stage = see_row, .stage_user = &seen};
  assert_int_equal(DYD_OK, converge(NULL, &o, &c, NULL));
  assert_int_equal(seen, 7);
}

static int set_up(void **state) {
  static fixture f;
  dyd_outcome outcome;
  f.e = new_engine();
  f.sink = tmpfile();
  *state = &f;
  return f.sink && dyd_engine_run(&outcome, f.e, NULL, NULL) == DYD_OK ? 0 : -1;
}

static int tear_down(void **state) {
  fixture *f = *state;
  dyd_engine_free(f->e);
  return fclose(f->sink);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_take),  cmocka_unit_test(test_fill),
                                     cmocka_unit_test(test_kept),  cmocka_unit_test(test_source),
                                     cmocka_unit_test(test_small), cmocka_unit_test(test_shown)};
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
