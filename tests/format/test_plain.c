/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The library without cairo: canvas_plain.c is linked in its place. svg is drawn, pdf and png are refused with a
 * sentence. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */
#include "picture/canvas.h"
#include <dyadel/io.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static dyd_engine *four_points(void) {
  static const double px[] = {0, 4, 1, 5}, py[] = {0, 1, 3, 4};
  dyd_engine *e = NULL;
  dyd_outcome outcome;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_engine_add_points(e, 4, px, py, NULL), DYD_OK);
  assert_int_equal(dyd_engine_run(&outcome, e, NULL, NULL), DYD_OK);
  return e;
}

/* The caller's. */
static char *written(dyd_status wanted, dyd_format format, dyd_error *err) {
  char *text = NULL;
  size_t size;
  dyd_engine *e = four_points();
  FILE *out = open_memstream(&text, &size);
  assert_non_null(out);
  assert_int_equal(dyd_write(out, e, DYD_CONTENT_DELAUNAY, format, NULL, err), wanted);
  fclose(out);
  dyd_engine_free(e);
  return text;
}

static void test_svg(void **state) {
  dyd_error err;
  (void)state;
  assert_false(dyd_cairo_is_there());
  char *text = written(DYD_OK, DYD_FORMAT_SVG, &err);
  assert_non_null(strstr(text, "</svg>"));
  assert_non_null(strstr(text, "legal: 5"));
  free(text);
}

static void test_refused(void **state) {
  static const dyd_format gone[] = {DYD_FORMAT_PDF, DYD_FORMAT_PNG};
  dyd_error err;
  (void)state;
  for (int k = 0; k < 2; k++) {
    for (int content = 0; content <= DYD_CONTENT_CON; content++)
      assert_false(dyd_format_holds(gone[k], (dyd_content)content, false));
    char *text = written(DYD_E_ARG, gone[k], &err);
    assert_string_equal(text, "");
    assert_non_null(strstr(err.message, "takes cairo, which this library was built without; give csv"));
    assert_non_null(strstr(err.message, "svg"));
    free(text);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_svg), cmocka_unit_test(test_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
