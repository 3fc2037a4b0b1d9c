/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of formats: names and endings lead back to their format, every writer writes, and where there is none the
 * message names those that there are. */
#include "picture/canvas.h"
#include <dyadel/io.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { CONTENTS = DYD_CONTENT_TIES + 1 };

static void test_names(void **state) {
  (void)state;
  dyd_format found;
  size_t count = 0;
  for (; dyd_format_name((dyd_format)count); count++) {
    const char *name = dyd_format_name((dyd_format)count);
    char file[64];
    snprintf(file, sizeof file, "a.b/c.%s", name);
    assert_true(dyd_format_from_name(&found, name) && (size_t)found == count);
    assert_true(dyd_format_from_file(&found, file) && (size_t)found == count);
    assert_non_null(dyd_format_about((dyd_format)count));
    assert_false(dyd_format_holds((dyd_format)count, DYD_CONTENT_NONE));
    assert_false(dyd_format_holds((dyd_format)count, (dyd_content)CONTENTS));
    bool some = false;
    for (int k = 0; k < CONTENTS; k++) some |= dyd_format_holds((dyd_format)count, (dyd_content)k);
    bool cairo = count == DYD_FORMAT_PDF || count == DYD_FORMAT_PNG;
    assert_true(some == (!cairo || dyd_cairo_is_there()));
  }
  assert_true(count > DYD_FORMAT_PNG);
  assert_null(dyd_format_about((dyd_format)count));
  assert_false(dyd_format_holds((dyd_format)count, DYD_CONTENT_DELAUNAY));
  found = DYD_FORMAT_OBJ;
  assert_false(dyd_format_from_name(&found, "CSV") || dyd_format_from_name(&found, ""));
  assert_false(dyd_format_from_file(&found, "csv") || dyd_format_from_file(&found, "a.csv/b") ||
               dyd_format_from_file(&found, "a."));
  assert_int_equal(found, DYD_FORMAT_OBJ);
}

/* Everything that can be written, of four points. */
typedef struct example {
  dyd_engine *e;
  dyd_history *history;
  dyd_convergence stages;
  dyd_check_report report;
  dyd_rect r[3];
  dyd_index_list nearest;
} example;

static void example_init(example *x) {
  static const double px[] = {0, 4, 1, 5}, py[] = {0, 1, 3, 4};
  *x = (example){.stages = {DYD_SIZED(dyd_convergence)}, .report = {DYD_SIZED(dyd_check_report)}};
  assert_int_equal(dyd_engine_new(&x->e), DYD_OK);
  assert_int_equal(dyd_engine_add_points(x->e, 4, px, py), DYD_OK);
  assert_int_equal(dyd_converge_run(&x->stages, x->e, NULL, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_history_new(&x->history), DYD_OK);
  assert_int_equal(dyd_history_note(x->history, dyd_engine_delaunay(x->e)), DYD_OK);
  for (int k = 0; k < 3; k++) {
    dyd_rect_init(&x->r[k]);
    assert_int_equal(dyd_rect_set_d(&x->r[k], px[k], px[k] + 0.25, py[k], py[k] + 0.25), DYD_OK);
  }
  x->nearest.item = calloc(1, sizeof *x->nearest.item);
  assert_non_null(x->nearest.item);
  x->nearest.count = 1;
}

static void example_clear(example *x) {
  dyd_index_list_clear(&x->nearest);
  for (int k = 3; k-- > 0;) dyd_rect_clear(&x->r[k]);
  dyd_check_report_clear(&x->report);
  dyd_convergence_clear(&x->stages);
  dyd_history_free(x->history);
  dyd_engine_free(x->e);
}

/* The points of the example need not be exact for a plan, but for tolerances: three others. */
static dyd_status write_tolerance(FILE *out, dyd_content content, dyd_format format, dyd_error *err) {
  const dyd_tolerance_options options = {DYD_SIZED(dyd_tolerance_options), .points = true};
  const dyd_tolerance_output o = {DYD_SIZED(dyd_tolerance_output), .layer = content};
  dyd_engine *e;
  dyd_tolerance *t;
  dyd_outcome outcome;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_engine_add_points(e, 3, (const double[]){0, 3, 1}, (const double[]){0, 0, 2}), DYD_OK);
  assert_int_equal(dyd_engine_run(&outcome, e, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_tolerance_new(&t, dyd_engine_delaunay(e), &options, NULL), DYD_OK);
  dyd_status st = dyd_write_tolerance(out, e, t, &o, format, err);
  dyd_tolerance_free(t);
  dyd_engine_free(e);
  return st;
}

static dyd_status write_plan(FILE *out, const dyd_engine *e, dyd_format format, dyd_error *err) {
  dyd_survey *s;
  assert_int_equal(dyd_survey_new(&s, dyd_engine_delaunay(e), NULL, NULL), DYD_OK);
  dyd_status st = dyd_write_plan(out, e, s, NULL, format, err);
  dyd_survey_free(s);
  return st;
}

static dyd_status write_sphere(FILE *out, dyd_content content, dyd_format format, dyd_error *err) {
  const dyd_sphere_output o = {DYD_SIZED(dyd_sphere_output), .layer = content};
  dyd_engine *places;
  dyd_sphere *s;
  dyd_outcome outcome;
  assert_int_equal(dyd_engine_new(&places), DYD_OK);
  assert_int_equal(
      dyd_engine_add_points(places, 4, (const double[]){0, 90, 10, -120}, (const double[]){0, 10, 80, -45}), DYD_OK);
  assert_int_equal(dyd_sphere_new(&s, places, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_sphere_run(&outcome, s, NULL, NULL), DYD_OK);
  dyd_status st = dyd_write_sphere(out, s, &o, format, err);
  dyd_sphere_free(s);
  dyd_engine_free(places);
  return st;
}

static dyd_status write_content(FILE *out, const example *x, dyd_content content, dyd_format format, dyd_error *err) {
  const dyd_rect *const r[] = {&x->r[0], &x->r[1], &x->r[2]};
  const dyd_nearest_answer answer = {DYD_SIZED(dyd_nearest_answer), r[0], &x->nearest, true, DYD_OUTCOME_DECIDED};
  switch (content) {
  case DYD_CONTENT_DELAUNAY:
    return dyd_write_delaunay(out, x->e, format, err);
  case DYD_CONTENT_VORONOI:
    return dyd_write_voronoi(out, x->e, NULL, format, err);
  case DYD_CONTENT_CONVERGENCE:
    return dyd_write_convergence_as(
        out, &x->stages,
        &(dyd_convergence_output){DYD_SIZED(dyd_convergence_output), .engine = x->e, .history = x->history}, format,
        err);
  case DYD_CONTENT_PLOT:
    return dyd_plot_convergence(out, &x->stages, format, err);
  case DYD_CONTENT_CHECK:
    return dyd_write_check(out, &x->report, format, err);
  case DYD_CONTENT_DISC:
    return dyd_write_disc(out, r, 3, DYD_OUTCOME_DECIDED, format, err);
  case DYD_CONTENT_BISECTOR:
    return dyd_write_bisector(out, r[0], r[1], DYD_OUTCOME_DECIDED, format, err);
  case DYD_CONTENT_POINTS:
  case DYD_CONTENT_TRIANGLES:
  case DYD_CONTENT_GRAPH_NEAREST:
  case DYD_CONTENT_GRAPH_GABRIEL:
  case DYD_CONTENT_GRAPH_MST:
  case DYD_CONTENT_ALIASES:
  case DYD_CONTENT_TIES:
    return dyd_write_delaunay_as(out, x->e, &(dyd_delaunay_output){DYD_SIZED(dyd_delaunay_output), .layer = content},
                                 format, err);
  case DYD_CONTENT_VERTICES:
  case DYD_CONTENT_REGIONS:
  case DYD_CONTENT_EDGES:
  case DYD_CONTENT_VORONOI_ALIASES:
    return dyd_write_voronoi(out, x->e, &(dyd_voronoi_options){DYD_SIZED(dyd_voronoi_options), .layer = content},
                             format, err);
  case DYD_CONTENT_TOLERANCE:
  case DYD_CONTENT_RADII:
  case DYD_CONTENT_BARCODE:
    return write_tolerance(out, content, format, err);
  case DYD_CONTENT_PLAN:
    return write_plan(out, x->e, format, err);
  case DYD_CONTENT_SPHERE:
  case DYD_CONTENT_SPHERE_POINTS:
  case DYD_CONTENT_SPHERE_TRIANGLES:
  case DYD_CONTENT_SPHERE_VORONOI:
  case DYD_CONTENT_SPHERE_VERTICES:
  case DYD_CONTENT_SPHERE_REGIONS:
    return write_sphere(out, content, format, err);
  case DYD_CONTENT_PLACES:
    return dyd_write_places(out, x->e, &(const dyd_nearest_answer *){&answer}, 1, DYD_OUTCOME_DECIDED, format, err);
  default:
    return dyd_write_nearest(out, x->e, &answer, format, err);
  }
}

/* Names of layers lead back to them; a layer of the one is none of the other. */
static void test_layers(void **state) {
  (void)state;
  static const dyd_content of[4] = {DYD_CONTENT_DELAUNAY, DYD_CONTENT_VORONOI, DYD_CONTENT_SPHERE,
                                    DYD_CONTENT_SPHERE_VORONOI};
  size_t count = 0;
  for (int k = 0; k < 4; k++)
    for (size_t l = 0; dyd_layer_name(of[k], l); l++, count++) {
      dyd_content found = DYD_CONTENT_NONE;
      assert_true(dyd_layer_from_name(&found, of[k], dyd_layer_name(of[k], l)));
      assert_true(l == 0 ? found == of[k] : found != of[k]);
      assert_true(dyd_format_holds(DYD_FORMAT_CSV, found));
      assert_int_equal(dyd_format_holds(DYD_FORMAT_GEOJSON, found),
                       found != DYD_CONTENT_SPHERE_REGIONS && found != DYD_CONTENT_TIES);
      bool shared = strcmp(dyd_layer_name(of[k], l), "aliases") == 0;
      assert_int_equal(dyd_layer_from_name(&found, of[k ^ 1], dyd_layer_name(of[k], l)), shared);
    }
  assert_int_equal(count, 19);
  assert_null(dyd_layer_name(DYD_CONTENT_CHECK, 0));
  example x;
  dyd_error err;
  example_init(&x);
  const dyd_delaunay_output wrong = {DYD_SIZED(dyd_delaunay_output), .layer = DYD_CONTENT_EDGES};
  assert_int_equal(dyd_write_delaunay_as(stdout, x.e, &wrong, DYD_FORMAT_CSV, &err), DYD_E_ARG);
  assert_non_null(strstr(err.message, "no layer of this"));
  example_clear(&x);
}

/* A refusal writes nothing, and names all formats that hold the content and no other. */
static void assert_refused(const char *message, dyd_content content) {
  const char *list = strstr(message, "give ");
  assert_non_null(list);
  for (size_t f = 0; dyd_format_name((dyd_format)f); f++) {
    bool named = false;
    size_t length = strlen(dyd_format_name((dyd_format)f));
    for (const char *at = list + 5; *at; at += strcspn(at, " ,"), at += strspn(at, " ,"))
      named |= strcspn(at, " ,") == length && strncmp(at, dyd_format_name((dyd_format)f), length) == 0;
    assert_int_equal(named, dyd_format_holds((dyd_format)f, content));
  }
}

static void test_writers(void **state) {
  (void)state;
  example x;
  example_init(&x);
  for (int k = DYD_CONTENT_DELAUNAY; k < CONTENTS; k++)
    for (size_t f = 0; f == 0 || dyd_format_name((dyd_format)(f - 1)); f++) { /* one behind the last */
      char *text = NULL;
      size_t size = 0;
      dyd_error err;
      FILE *out = open_memstream(&text, &size);
      assert_non_null(out);
      bool holds = dyd_format_holds((dyd_format)f, (dyd_content)k);
      dyd_status st = write_content(out, &x, (dyd_content)k, (dyd_format)f, &err);
      assert_int_equal(fclose(out), 0);
      if (st != (holds ? DYD_OK : DYD_E_ARG)) fail_msg("content %d as format %zu: %d, %s", k, f, (int)st, err.message);
      assert_int_equal(size > 0, holds);
      if (!holds) assert_refused(err.message, (dyd_content)k);
      free(text);
    }
  example_clear(&x);
}

/* A full device is told of by every writer, with and without a place for the message. */
static void test_full_device(void **state) {
  (void)state;
  example x;
  example_init(&x);
  for (int k = DYD_CONTENT_DELAUNAY; k < CONTENTS; k++)
    for (size_t f = 0; dyd_format_name((dyd_format)f); f++)
      for (int told = 0; told < 2 && dyd_format_holds((dyd_format)f, (dyd_content)k); told++) {
        dyd_error err = {.message = ""};
        FILE *out = fopen("/dev/full", "w");
        if (!out) skip();
        assert_int_equal(write_content(out, &x, (dyd_content)k, (dyd_format)f, told ? &err : NULL), DYD_E_IO);
        if (told) assert_non_null(strstr(err.message, "cannot write: "));
        fclose(out);
      }
  example_clear(&x);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_names), cmocka_unit_test(test_layers),
                                     cmocka_unit_test(test_writers), cmocka_unit_test(test_full_device)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
