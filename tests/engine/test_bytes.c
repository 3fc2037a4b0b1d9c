/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* max_bytes: estimates against the memory really held, including that of GMP, MPFR and FLINT, since the allocator of
 * this program is the one below; and refusals, which come in time and leave everything as it was. */
#include "engine/help.h"

#include <dyadel/certificate.h>
#include <malloc.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void __libc_free(void *block);

static atomic_llong held, most;

static void *held_more(void *block, size_t before) {
  long long now = atomic_fetch_add(&held, (long long)malloc_usable_size(block) - (long long)before) +
                  (long long)malloc_usable_size(block) - (long long)before;
  if (now > atomic_load(&most)) atomic_store(&most, now);
  return block;
}
void *malloc(size_t size) {
  return held_more(__libc_malloc(size), 0);
}
void *calloc(size_t count, size_t size) {
  return held_more(__libc_calloc(count, size), 0);
}
void *realloc(void *old, size_t size) {
  size_t before = malloc_usable_size(old);
  void *block = __libc_realloc(old, size);
  return block ? held_more(block, before) : NULL;
}
void free(void *block) {
  atomic_fetch_sub(&held, (long long)malloc_usable_size(block));
  __libc_free(block);
}

#define MEGABYTE 1e6

/* ---- cases ---- */

static test_random random_numbers;

static double unit(void) {
  return (double)(test_u64(&random_numbers) >> 11) * 0x1p-53;
}

static void add_boxes(dyd_engine *e, size_t n, double half) {
  for (size_t k = 0; k < n; k++) {
    double x = unit(), y = unit(), x1 = x + half, y1 = y + half;
    x -= half;
    y -= half;
    assert_int_equal(DYD_OK, half > 0 ? dyd_engine_add_boxes(e, 1, &x, &x1, &y, &y1, NULL)
                                      : dyd_engine_add_points(e, 1, &x, &y, NULL));
  }
}

static void uniform(dyd_engine *e, dyd_engine_options *o) {
  (void)o;
  add_boxes(e, 30000, 0);
}
static void boxes(dyd_engine *e, dyd_engine_options *o) {
  (void)o;
  add_boxes(e, 30000, 1e-9);
}
static void open_boxes(dyd_engine *e, dyd_engine_options *o) {
  (void)o;
  add_boxes(e, 10000, 0.001);
}
static void crowd(dyd_engine *e, dyd_engine_options *o) {
  (void)o;
  add_boxes(e, 600, 0.3);
}
static void overlapping(dyd_engine *e, dyd_engine_options *o) {
  o->threads = 2;
  add_boxes(e, 3000, 0.5 / sqrt(3000));
}
static void grid(dyd_engine *e, dyd_engine_options *o) {
  (void)o;
  for (int k = 0; k < 20000; k++) {
    double x = k % 141, y = k / 141;
    assert_int_equal(DYD_OK, dyd_engine_add_points(e, 1, &x, &y, NULL));
  }
}
static void line(dyd_engine *e, dyd_engine_options *o) {
  o->goal = DYD_GOAL_AREA;
  for (int k = 0; k < 500; k++) {
    double x = k, y = -40;
    assert_int_equal(DYD_OK, dyd_engine_add_points(e, 1, &x, &y, NULL));
  }
}
static void roots_of_numbers(dyd_engine *e, dyd_engine_options *o) {
  o->start_bits = 20000;
  o->max_bits = 20000;
  engine_add_roots(e, &random_numbers, 300);
}
static void long_expressions(dyd_engine *e, dyd_engine_options *o) {
  o->start_bits = o->max_bits = 400000;
  o->no_ties = true;
  engine_add_text(e, "exp(sqrt(2))+log(3)*sin(pi/7)", "atan(sqrt(3)/5)");
  engine_add_text(e, "cos(1)^3+sqrt(1+sqrt(2+sqrt(3)))", "exp(1/3)-e");
  engine_add_text(e, "root(x^5-x-1,1,2)", "root(x^40-7*x^3-1,1,2)");
}
static void tie(dyd_engine *e, dyd_engine_options *o) {
  o->max_bits = 300;
  engine_add_text(e, "cbrt(2+sqrt(5))+cbrt(2-sqrt(5))", "0");
  engine_add_text(e, "1", "0");
  engine_add_text(e, "3", "4");
}
static dyd_rect square;
static void diagram(dyd_engine *e, dyd_engine_options *o) {
  o->goal = DYD_GOAL_VORONOI_HAUSDORFF;
  o->goal_bits = 4;
  o->window = &square;
  add_boxes(e, 20000, 1e-9);
}

static const struct {
  const char *name;
  void (*make)(dyd_engine *e, dyd_engine_options *o);
} CASES[] = {{"uniform", uniform},
             {"boxes", boxes},
             {"open boxes", open_boxes},
             {"crowd", crowd},
             {"overlapping", overlapping},
             {"grid", grid},
             {"line", line},
             {"roots", roots_of_numbers},
             {"long expressions", long_expressions},
             {"tie", tie},
             {"diagram", diagram}};
enum { ALL_CASES = sizeof CASES / sizeof *CASES };

static dyd_engine *case_engine(size_t k, dyd_engine_options *o) {
  dyd_engine *e = engine_new();
  dyd_engine_options_init(o);
  random_numbers.state = 12345 + k;
  CASES[k].make(e, o);
  return e;
}

/* Runs within the given number of bytes; *real: the peak of memory held, the points included. */
static dyd_status run_within(double *real, dyd_engine *e, dyd_engine_options o, uint64_t bytes, long long before,
                             dyd_error *err) {
  dyd_outcome outcome;
  o.max_bytes = bytes;
  atomic_store(&most, atomic_load(&held));
  dyd_status st = dyd_engine_run(&outcome, e, &o, err);
  *real = (double)(atomic_load(&most) - before);
  return st;
}

static void test_estimates(void **state) {
  (void)state;
  for (size_t k = 0; k < ALL_CASES; k++) {
    dyd_engine_options o;
    dyd_error err;
    double real;
    long long before = atomic_load(&held);
    dyd_engine *e = case_engine(k, &o);
    assert_int_equal(0, engine_counters(e).bytes_most);
    assert_true(run_within(&real, e, o, UINT64_MAX, before, &err) >= 0);
    double guess = (double)engine_counters(e).bytes_most;
    print_message("%s: %.0f held, %.0f estimated, ratio %.2f\n", CASES[k].name, real, guess, guess / real);
    assert_true(guess > 0 && guess < 2 * real + MEGABYTE && 2 * guess + MEGABYTE > real);
    assert_true(real < MEGABYTE || (guess < 2 * real && 2 * guess > real));
    dyd_engine_free(e);
  }
}

/* A budget below the need ends the run before it is exceeded, and another run continues. */
static void test_refusals(void **state) {
  (void)state;
  for (size_t k = 0; k < ALL_CASES; k++) {
    dyd_engine_options o;
    dyd_error err;
    double real;
    size_t want[4], got[4];
    dyd_engine *whole = case_engine(k, &o);
    assert_true(run_within(&real, whole, o, UINT64_MAX, 0, &err) >= 0);
    uint64_t peak = engine_counters(whole).bytes_most;
    const uint64_t bounds[] = {1, peak / 3, peak - 1};
    engine_count(want, whole);
    dyd_engine_free(whole);
    for (size_t b = 0; b < sizeof bounds / sizeof *bounds; b++) {
      long long before = atomic_load(&held);
      dyd_engine *e = case_engine(k, &o);
      double points = (double)(atomic_load(&held) - before);
      dyd_status st = run_within(&real, e, o, bounds[b], before, &err);
      if (st != DYD_E_NOMEM || !strstr(err.message, "max_bytes"))
        fail_msg("%s: %d, %s", CASES[k].name, st, err.message);
      assert_int_equal(DYD_E_NOMEM, err.code);
      assert_true(real < points + 2 * (double)bounds[b] + MEGABYTE);
      assert_true(run_within(&real, e, o, 0, 0, &err) >= 0);
      engine_count(got, e);
      assert_memory_equal(want, got, sizeof want);
      dyd_engine_free(e);
    }
  }
}

/* Statements known before a refusal are known after it. */
static void test_results_are_kept(void **state) {
  (void)state;
  const int weight[6] = {0, 1, 3, 7, 2, 5};
  dyd_engine *e = engine_new();
  dyd_engine_options o;
  dyd_error err;
  double real;
  monotone m;
  engine_add_polygon(e, 6, weight, 3000);
  dyd_engine_options_init(&o);
  o.max_stages = 1;
  assert_true(run_within(&real, e, o, UINT64_MAX, 0, &err) >= 0);
  const dyd_delaunay *result = dyd_engine_delaunay(e);
  uint64_t calls = engine_counters(e).calls;
  monotone_init(&m, e);
  monotone_look(&m);
  assert_int_equal(DYD_E_NOMEM, run_within(&real, e, o, engine_counters(e).bytes_most / 2, 0, &err));
  assert_ptr_equal(result, dyd_engine_delaunay(e));
  assert_int_equal(calls, engine_counters(e).calls);
  monotone_look(&m);
  o.max_stages = 0;
  o.max_bits = 20000;
  o.max_bytes = (uint64_t)1 << 30;
  engine_run(e, &o, DYD_OUTCOME_DECIDED);
  monotone_look(&m);
  monotone_clear(&m);
  dyd_engine_free(e);
}

/* ---- outputs made of a result ---- */

static void write_diagram(dyd_status *st, const dyd_engine *e, int64_t bits, dyd_format format, dyd_error *err) {
  const dyd_write_options o = {DYD_SIZED(dyd_write_options), .window = &square, .flatten_set = true,
                               .flatten_bits = bits};
  FILE *out = fopen("/dev/null", "w");
  assert_non_null(out);
  *st = dyd_write(out, e, DYD_CONTENT_VORONOI, format, &o, err);
  fclose(out);
}
static void use_vertices(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  write_diagram(st, e, 10, DYD_FORMAT_VTK, err);
}
static void use_polygons(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  write_diagram(st, e, 22, DYD_FORMAT_CSV, err);
}
/* Calls without an error tell less. */
static void use_cells(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  dyd_boundary b = {0};
  *st = DYD_OK;
  for (uint32_t i = 0; *st == DYD_OK && i < dyd_engine_count(e); i += 100)
    *st = dyd_voronoi_cell(&b, dyd_engine_delaunay(e), i, DYD_CELL_POSSIBLE, NULL);
  snprintf(err->message, sizeof err->message, "max_bytes");
  err->code = *st;
  dyd_boundary_clear(&b);
}
static void use_graph(dyd_status *st, const dyd_engine *e, dyd_graph graph, dyd_error *err) {
  dyd_graph_list l = {0};
  *st = dyd_graph_edges(&l, dyd_engine_delaunay(e), NULL, graph, NULL, err);
  dyd_graph_list_clear(&l);
}
static void use_gabriel(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  use_graph(st, e, DYD_GRAPH_GABRIEL, err);
}
static void use_tree(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  use_graph(st, e, DYD_GRAPH_MST, err);
}
static void use_tolerance(dyd_status *st, const dyd_engine *e, const char *up_to, dyd_error *err) {
  mpq_t cap;
  dyd_tolerance *t;
  mpq_init(cap);
  mpq_set_str(cap, up_to, 10);
  const dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .up_to = mpq_sgn(cap) ? cap : NULL, .points = true,
                                   .sigma = 0.001};
  *st = dyd_tolerance_new(&t, dyd_engine_delaunay(e), &o, err);
  dyd_tolerance_free(t);
  mpq_clear(cap);
}
static void use_deaths(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  use_tolerance(st, e, "0", err);
}
static void use_births(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  use_tolerance(st, e, "1/500", err);
}
/* Lists that are handed out; these calls know no error. */
static void use_pairs(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  dyd_pair_list l = {0};
  *st = dyd_delaunay_pairs(&l, dyd_engine_delaunay(e));
  snprintf(err->message, sizeof err->message, "max_bytes");
  err->code = *st;
  dyd_pair_list_clear(&l);
}
static void use_triangles(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  dyd_triangle_list l = {0}, beyond = {0};
  *st = dyd_delaunay_triangles(&l, &beyond, dyd_engine_delaunay(e), 0);
  snprintf(err->message, sizeof err->message, "max_bytes");
  err->code = *st;
  dyd_triangle_list_clear(&l);
  dyd_triangle_list_clear(&beyond);
}
static void write_format(dyd_status *st, const dyd_engine *e, dyd_format format, dyd_error *err) {
  FILE *out = fopen("/dev/null", "w");
  assert_non_null(out);
  *st = dyd_write(out, e, DYD_CONTENT_DELAUNAY, format, NULL, err);
  fclose(out);
}
static void use_csv(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  write_format(st, e, DYD_FORMAT_CSV, err);
}
static void use_vtk(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  write_format(st, e, DYD_FORMAT_VTK, err);
}
static void use_svg(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  write_format(st, e, DYD_FORMAT_SVG, err);
}
static void use_html(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  write_format(st, e, DYD_FORMAT_HTML, err);
}
static void use_certificate(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  FILE *out = fopen("/dev/null", "w");
  assert_non_null(out);
  *st = dyd_write_certificate(out, e, NULL, err);
  fclose(out);
}
static void use_plan(dyd_status *st, const dyd_engine *e, dyd_error *err) {
  dyd_survey *s;
  *st = dyd_survey_new(&s, dyd_engine_delaunay(e), NULL, err);
  dyd_survey_free(s);
}

/* Without filters, whose polygons have limited arrays. */
static void few_wide(dyd_engine *e, dyd_engine_options *o) {
  o->no_filter = true;
  add_boxes(e, 5, 0.03);
}
static void few_points(dyd_engine *e, dyd_engine_options *o) {
  (void)o;
  add_boxes(e, 3000, 0);
}
/* Exact points round one that is wide: all of them bound its cell. */
static void hub(dyd_engine *e, dyd_engine_options *o) {
  enum { RIM = 120 };
  (void)o;
  double lo = 0.25, hi = 0.75;
  assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 1, &lo, &hi, &lo, &hi, NULL));
  for (int k = 0; k < RIM; k++) {
    double x = 0.5 + 2 * cos(6.28318 * k / RIM), y = 0.5 + 2 * sin(6.28318 * k / RIM);
    assert_int_equal(DYD_OK, dyd_engine_add_points(e, 1, &x, &y, NULL));
  }
}
static void thin(dyd_engine *e, dyd_engine_options *o) {
  (void)o;
  add_boxes(e, 2000, 3e-4);
}

static const struct {
  const char *name;
  void (*make)(dyd_engine *e, dyd_engine_options *o);
  void (*use)(dyd_status *st, const dyd_engine *e, dyd_error *err);
} USES[] = {{"vertices", boxes, use_vertices},
            {"polygons", few_wide, use_polygons},
            {"cells", hub, use_cells},
            {"Gabriel", open_boxes, use_gabriel},
            {"tree", uniform, use_tree},
            {"deaths", uniform, use_deaths},
            {"births", few_points, use_births},
            {"plan", thin, use_plan},
            {"pairs", uniform, use_pairs},
            {"triangles", boxes, use_triangles},
            {"csv", crowd, use_csv},
            {"vtk", boxes, use_vtk},
            {"svg", open_boxes, use_svg},
            {"html", few_points, use_html},
            {"proofs", few_points, use_certificate},
            {"proofs of faces", overlapping, use_certificate}};
enum { ALL_USES = sizeof USES / sizeof *USES };

/* Sets the budget to the given bytes, by a run that has nothing to do. */
static void allow_bytes(dyd_engine *e, dyd_engine_options o, uint64_t bytes) {
  dyd_error err;
  double real;
  assert_true(run_within(&real, e, o, bytes, 0, &err) >= 0);
}

/* The least budget that a use passes with is the memory it holds, up to a factor of 2; below it is refused in time. */
static void test_uses(void **state) {
  (void)state;
  for (size_t k = 0; k < ALL_USES; k++) {
    dyd_engine_options o;
    dyd_error err;
    dyd_status st;
    dyd_engine_options_init(&o);
    random_numbers.state = 54321 + k;
    long long before = atomic_load(&held);
    dyd_engine *e = engine_new();
    USES[k].make(e, &o);
    allow_bytes(e, o, 0);
    double start = (double)(atomic_load(&held) - before), bound = start / 2;
    atomic_store(&most, atomic_load(&held));
    USES[k].use(&st, e, &err);
    double real = (double)(atomic_load(&most) - before);
    assert_true(st >= 0 && real > start);
    for (st = DYD_E_NOMEM; st < 0; bound *= st < 0 ? 1.2 : 1) {
      allow_bytes(e, o, (uint64_t)bound);
      atomic_store(&most, atomic_load(&held));
      USES[k].use(&st, e, &err);
      if (st < 0 && (st != DYD_E_NOMEM || err.code != st || !strstr(err.message, "max_bytes")))
        fail_msg("%s: %d, %s", USES[k].name, st, err.message);
      double now = (double)(atomic_load(&most) - before);
      if (now > start + 2 * bound + MEGABYTE) fail_msg("%s: %.0f held with %.0f allowed", USES[k].name, now, bound);
    }
    print_message("%s: %.0f held, %.0f before, granted from %.0f on, ratio %.2f\n", USES[k].name, real, start, bound,
                  bound / real);
    assert_true(bound < 2 * real + MEGABYTE && 2 * bound + MEGABYTE > real);
    assert_true(bound > start / 2);
    dyd_engine_free(e);
  }
}

/* ---- reading ---- */

enum { ROWS = 20000 };

/* Row k has these forms of the numbers x, y and k: how its points are written, and what comes with them. */
static const struct {
  const char *name, *header, *row;
  dyd_read_options o;
} TEXTS[] = {
    {"doubles", "", "%.0f %.0f\n", {.columns = NULL}},
    {"decimals", "", "%.5f %.5f\n", {.columns = NULL}},
    {"merged places", "", "%.5f %.5f\n", {.merge = true}},
    {"radii", "x,y\n", "%.5f,%.5f\n", {.columns = "x,y", .radius = "1/3"}},
    {"intervals", "", "[%.5f,9e9] [%.5f,9e9]\n", {.columns = NULL}},
    {"measured decimals", "", "%.5f %.5f\n", {.measured = true}},
    {"expressions", "", "sqrt(%.5f) sqrt(%.3f)\n", {.columns = NULL}},
    {"roots", "", "root(x^5-x-1-%.0f,1,99) %.5f\n", {.columns = NULL}},
    {"identifiers", "x,y,n\n", "%.5f,%.5f,name%d\n", {.columns = "x,y", .id = "n"}},
    {"rows of identifiers",
     "x,y,n\n",
     "%.5f,%.5f,n%d\n",
     {.columns = "x,y", .id = "n", .merge_by = "id", .radius = "1e9"}},
    {"carried texts",
     "x,y,n\n",
     "%.5f,%.5f,a text of some length that is carried %d\n",
     {.columns = "x,y", .carry = "all"}},
    {"confidence", "x,y,s\n", "%.5f,%.5f,0.%d\n", {.columns = "x,y", .sigma_column = "s", .confidence = "0.95"}},
};

static FILE *text_of(size_t k) {
  FILE *out = tmpfile();
  assert_non_null(out);
  fputs(TEXTS[k].header, out);
  random_numbers.state = 777 + k;
  for (int row = 0; row < ROWS; row++) {
    char text[200];
    double x = 1e6 * unit(), y = 1e6 * unit();
    assert_true(snprintf(text, sizeof text, TEXTS[k].row, x, y, row / 2) < (int)sizeof text);
    fputs(text, out);
  }
  return out;
}

/* Reads the text into an engine; *most_held: what it took. */
static dyd_status read_within(double *most_held, FILE *in, const dyd_read_options *o) {
  dyd_engine *e = engine_new();
  dyd_error err;
  rewind(in);
  long long before = atomic_load(&held);
  atomic_store(&most, before);
  dyd_status st = dyd_read_points(e, in, o, &err);
  *most_held = (double)(atomic_load(&most) - before);
  if (st < 0 && (st != DYD_E_NOMEM || err.code != st || !strstr(err.message, "max_bytes") || dyd_engine_count(e)))
    fail_msg("%d, %s", st, err.message);
  dyd_engine_free(e);
  return st;
}

/* What a text is granted from on is the memory that reading it takes, up to a factor of 2; below it is refused in time,
 * and nothing is added. */
static void test_reading(void **state) {
  (void)state;
  for (size_t k = 0; k < sizeof TEXTS / sizeof *TEXTS; k++) {
    dyd_status st;
    FILE *in = text_of(k);
    dyd_read_options o = TEXTS[k].o;
    o.struct_size = sizeof o;
    double real, now, bound;
    assert_int_equal(DYD_OK, read_within(&real, in, &o));
    bound = real / 3;
    do {
      o.max_bytes = (uint64_t)(bound *= 1.2);
      st = read_within(&now, in, &o);
      if (now > 2 * bound + MEGABYTE) fail_msg("%s: %.0f held with %.0f allowed", TEXTS[k].name, now, bound);
    } while (st == DYD_E_NOMEM);
    print_message("%s: %.0f held, granted from %.0f on, ratio %.2f\n", TEXTS[k].name, real, bound, bound / real);
    assert_true(bound < 2 * real + MEGABYTE && 2 * bound + MEGABYTE > real);
    fclose(in);
  }
}

int main(void) {
  random_numbers = test_random_start("bytes");
  dyd_rect_init(&square);
  assert_int_equal(DYD_OK, dyd_rect_set_d(&square, 0, 1, 0, 1));
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_reading),  cmocka_unit_test(test_estimates),
                                     cmocka_unit_test(test_refusals), cmocka_unit_test(test_results_are_kept),
                                     cmocka_unit_test(test_uses),     cmocka_unit_test(test_reading)};
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  dyd_rect_clear(&square);
  return failed;
}
