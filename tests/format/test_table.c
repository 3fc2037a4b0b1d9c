/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of formats: names and endings lead back to their format, every writer writes, and a message for a missing
 * one names the existing ones. The tables of pictures are whole. */
#include "picture/picture.h"
#include <dyadel/io.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { CONTENTS = DYD_CONTENT_TRIALS + 1 };

static void test_names(void **state) {
  (void)state;
  dyd_format found;
  size_t count = 0;
  for (; dyd_format_get((dyd_format)count); count++) {
    const char *name = dyd_format_get((dyd_format)count)->name;
    char file[64];
    snprintf(file, sizeof file, "a.b/c.%s", name);
    assert_true(dyd_format_from_name(&found, name) && (size_t)found == count);
    assert_true(dyd_format_from_file(&found, file) && (size_t)found == count);
    assert_non_null(dyd_format_get((dyd_format)count)->about);
    assert_false(dyd_format_holds((dyd_format)count, DYD_CONTENT_NONE, false));
    assert_false(dyd_format_holds((dyd_format)count, (dyd_content)CONTENTS, false));
    bool some = false;
    for (int k = 0; k < CONTENTS; k++) some |= dyd_format_holds((dyd_format)count, (dyd_content)k, false);
    bool cairo = count == DYD_FORMAT_PDF || count == DYD_FORMAT_PNG;
    assert_true(some == (!cairo || dyd_cairo_is_there()));
  }
  assert_true(count > DYD_FORMAT_PNG);
  assert_null(dyd_format_get((dyd_format)count));
  assert_false(dyd_format_holds((dyd_format)count, DYD_CONTENT_DELAUNAY, false));
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
  assert_int_equal(dyd_engine_add_points(x->e, 4, px, py, NULL), DYD_OK);
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
  dyd_engine *e;
  dyd_tolerance *t;
  dyd_outcome outcome;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_engine_add_points(e, 3, (const double[]){0, 3, 1}, (const double[]){0, 0, 2}, NULL), DYD_OK);
  assert_int_equal(dyd_engine_run(&outcome, e, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_tolerance_new(&t, dyd_engine_delaunay(e), &options, NULL), DYD_OK);
  const dyd_write_options o = {DYD_SIZED(dyd_write_options), .tolerance = t};
  dyd_status st = dyd_write(out, e, content, format, &o, err);
  dyd_tolerance_free(t);
  dyd_engine_free(e);
  return st;
}

static dyd_status write_sphere(FILE *out, dyd_content content, dyd_format format, dyd_error *err) {
  dyd_engine *places;
  dyd_sphere *s;
  dyd_outcome outcome;
  assert_int_equal(dyd_engine_new(&places), DYD_OK);
  assert_int_equal(
      dyd_engine_add_points(places, 4, (const double[]){0, 90, 10, -120}, (const double[]){0, 10, 80, -45}, NULL),
      DYD_OK);
  assert_int_equal(dyd_sphere_new(&s, places, NULL, NULL), DYD_OK);
  const dyd_write_options o = {DYD_SIZED(dyd_write_options), .sphere = s};
  assert_int_equal(dyd_write(out, NULL, content, format, &o, err), DYD_E_ARG); /* there is no result yet */
  assert_int_equal(dyd_sphere_run(&outcome, s, NULL, NULL), DYD_OK);
  dyd_status st = dyd_write(out, NULL, content, format, &o, err);
  dyd_sphere_free(s);
  dyd_engine_free(places);
  return st;
}

/* Sets all options that contents need, unless they need a result of another kind. */
static dyd_status write_content(FILE *out, const example *x, dyd_content content, dyd_format format, dyd_error *err) {
  const dyd_rect *const r[] = {&x->r[0], &x->r[1], &x->r[2]};
  const dyd_nearest_answer answer = {DYD_SIZED(dyd_nearest_answer), r[0], &x->nearest, true, DYD_OUTCOME_DECIDED};
  const dyd_nearest_answer *const answers = &answer;
  dyd_write_options o = {DYD_SIZED(dyd_write_options),
                         .history = x->history,
                         .stages = &x->stages,
                         .report = &x->report,
                         .rect = r,
                         .rects = 3,
                         .answer = &answers,
                         .answers = 1};
  const dyd_survey_trial trial = {2, 3, 4, 1, true};
  dyd_survey *s = NULL;
  switch (content) {
  case DYD_CONTENT_TOLERANCE:
  case DYD_CONTENT_RADII:
  case DYD_CONTENT_BARCODE:
    return write_tolerance(out, content, format, err);
  case DYD_CONTENT_SPHERE:
  case DYD_CONTENT_SPHERE_POINTS:
  case DYD_CONTENT_SPHERE_TRIANGLES:
  case DYD_CONTENT_SPHERE_VORONOI:
  case DYD_CONTENT_SPHERE_VERTICES:
  case DYD_CONTENT_SPHERE_REGIONS:
    return write_sphere(out, content, format, err);
  case DYD_CONTENT_TRIALS:
    o.trial = &trial;
    o.trials = 1;
    break;
  case DYD_CONTENT_PLAN:
  case DYD_CONTENT_PLAN_PAIRS:
    assert_int_equal(dyd_survey_new(&s, dyd_engine_delaunay(x->e), NULL, NULL), DYD_OK);
    o.plan = s;
    break;
  default:
    break;
  }
  dyd_status st = dyd_write(out, x->e, content, format, &o, err);
  dyd_survey_free(s);
  return st;
}

/* Names of layers lead back to them; a layer of the one is none of the other. */
static void test_layers(void **state) {
  (void)state;
  static const dyd_content of[4] = {DYD_CONTENT_DELAUNAY, DYD_CONTENT_VORONOI, DYD_CONTENT_SPHERE,
                                    DYD_CONTENT_SPHERE_VORONOI};
  size_t count = 0;
  for (int k = 0; k < 4; k++)
    for (size_t l = 0; dyd_layer_name(NULL, NULL, of[k], l); l++, count++) {
      dyd_content found = DYD_CONTENT_NONE;
      assert_true(dyd_layer_from_name(&found, of[k], dyd_layer_name(NULL, NULL, of[k], l)));
      assert_true(l == 0 ? found == of[k] : found != of[k]);
      assert_true(dyd_format_holds(DYD_FORMAT_CSV, found, false));
      assert_int_equal(dyd_format_holds(DYD_FORMAT_GEOJSON, found, false),
                       found != DYD_CONTENT_SPHERE_REGIONS && found != DYD_CONTENT_TIES);
      bool shared = strcmp(dyd_layer_name(NULL, NULL, of[k], l), "aliases") == 0;
      assert_int_equal(dyd_layer_from_name(&found, of[k ^ 1], dyd_layer_name(NULL, NULL, of[k], l)), shared);
    }
  assert_int_equal(count, 22);
  assert_null(dyd_layer_name(NULL, NULL, DYD_CONTENT_CHECK, 0));
}

/* An option that a content needs and lacks is named, as are contents that do not exist. */
static void test_missing(void **state) {
  (void)state;
  example x;
  dyd_error err;
  example_init(&x);
  for (int content = 0; content <= CONTENTS; content++) {
    assert_int_equal(dyd_write(stdout, NULL, (dyd_content)content, DYD_FORMAT_CSV, NULL, &err), DYD_E_ARG);
    assert_true(err.message[0]);
  }
  assert_non_null(strstr(err.message, "there is no content"));
  assert_int_equal(dyd_write(stdout, x.e, DYD_CONTENT_TOLERANCE, DYD_FORMAT_CSV, NULL, &err), DYD_E_ARG);
  assert_int_equal(dyd_write(stdout, x.e, DYD_CONTENT_PLAN, DYD_FORMAT_CSV, NULL, &err), DYD_E_ARG);
  assert_int_equal(dyd_write(stdout, x.e, DYD_CONTENT_NEAREST, DYD_FORMAT_CSV, NULL, &err), DYD_E_ARG);
  example_clear(&x);
}

/* A refusal writes nothing, and names all formats that hold the content and no other. */
static void assert_refused(const char *message, dyd_content content) {
  const char *list = strstr(message, "give ");
  assert_non_null(list);
  for (size_t f = 0; dyd_format_get((dyd_format)f); f++) {
    bool named = false;
    size_t length = strlen(dyd_format_get((dyd_format)f)->name);
    for (const char *at = list + 5; *at; at += strcspn(at, " ,"), at += strspn(at, " ,"))
      named |= strcspn(at, " ,") == length && strncmp(at, dyd_format_get((dyd_format)f)->name, length) == 0;
    assert_int_equal(named, dyd_format_holds((dyd_format)f, content, false));
  }
}

static void test_writers(void **state) {
  (void)state;
  example x;
  example_init(&x);
  for (int k = DYD_CONTENT_DELAUNAY; k < CONTENTS; k++)
    for (size_t f = 0; f == 0 || dyd_format_get((dyd_format)(f - 1)); f++) { /* one behind the last */
      char *text = NULL;
      size_t size = 0;
      dyd_error err;
      FILE *out = open_memstream(&text, &size);
      assert_non_null(out);
      bool holds = dyd_format_holds((dyd_format)f, (dyd_content)k, false);
      dyd_status st = write_content(out, &x, (dyd_content)k, (dyd_format)f, &err);
      assert_int_equal(fclose(out), 0);
      if (st != (holds ? DYD_OK : DYD_E_ARG)) fail_msg("content %d as format %zu: %d, %s", k, f, (int)st, err.message);
      assert_int_equal(size > 0, holds);
      if (!holds) assert_refused(err.message, (dyd_content)k);
      free(text);
    }
  example_clear(&x);
}

/* Every writer reports a full device, with and without a place for the message. */
static void test_full_device(void **state) {
  (void)state;
  example x;
  example_init(&x);
  for (int k = DYD_CONTENT_DELAUNAY; k < CONTENTS; k++)
    for (size_t f = 0; dyd_format_get((dyd_format)f); f++)
      for (int told = 0; told < 2 && dyd_format_holds((dyd_format)f, (dyd_content)k, false); told++) {
        dyd_error err = {.message = ""};
        FILE *out = fopen("/dev/full", "w");
        if (!out) skip();
        assert_int_equal(write_content(out, &x, (dyd_content)k, (dyd_format)f, told ? &err : NULL), DYD_E_IO);
        if (told) assert_non_null(strstr(err.message, "cannot write: "));
        fclose(out);
      }
  example_clear(&x);
}

/* Every layer of a picture has a style, a key for it, words and a place; a table with a row that lacks one is not
 * whole. */
static void test_pictures(void **state) {
  static const dyd_picture_table *const tables[] = {
      &dyd_delaunay_layers, &dyd_graph_layers,   &dyd_tolerance_layers, &dyd_voronoi_layers,
      &dyd_tiles_layers,    &dyd_plan_layers,    &dyd_sphere_layers,    &dyd_sphere_cells_layers,
      &dyd_disc_layers,     &dyd_nearest_layers, &dyd_bisector_layers};
  dyd_picture_layer row[DYD_PICTURE_LAYERS_MOST + 1] = {0};
  (void)state;
  for (size_t k = 0; k < sizeof tables / sizeof *tables; k++) {
    dyd_picture_table t = *tables[k];
    assert_true(dyd_picture_is_whole(&t));
    memcpy(row, t.row, t.count * sizeof *row);
    t.row = row;
    for (size_t r = 0; r < t.count; r++) {
      const dyd_picture_layer good = row[r], bare = {.walk = good.walk, .kind = good.kind, .style = good.style};
      dyd_picture_layer bad[7] = {good, good, good, good, good, good, bare};
      bad[0].style = (dyd_picture_style){0};
      bad[1].key = DYD_KEY_UNSET;
      bad[2].text = NULL;
      bad[3].text = "";
      bad[4].place = good.place ? 0 : 1;
      bad[5].place = DYD_PICTURE_LAYERS_MOST + 1;
      for (size_t b = 0; b < sizeof bad / sizeof *bad; b++) {
        row[r] = bad[b];
        assert_false(dyd_picture_is_whole(&t));
      }
      row[r] = good;
    }
    assert_true(dyd_picture_is_whole(&t));
    row[0].walk = NULL;
    assert_false(dyd_picture_is_whole(&t));
    t.count = DYD_PICTURE_LAYERS_MOST + 1;
    assert_false(dyd_picture_is_whole(&t));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_names),    cmocka_unit_test(test_layers),
                                     cmocka_unit_test(test_pictures), cmocka_unit_test(test_missing),
                                     cmocka_unit_test(test_writers),  cmocka_unit_test(test_full_device)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
