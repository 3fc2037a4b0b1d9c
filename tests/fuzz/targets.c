/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Fuzz targets: see targets.h. A call fails with a code and a message, or keeps its contract; the
 * rest is the business of the invariants of the armed library and of the sanitizers. */
#define _GNU_SOURCE /* fmemopen */
#include "targets.h"
#include "stream/number.h"
#include "stream/real.h"

#include <dyadel/dyadel.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MUST(condition)                                                                                                \
  do {                                                                                                                 \
    if (!(condition)) {                                                                                                \
      fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);                                                  \
      abort();                                                                                                         \
    }                                                                                                                  \
  } while (0)

/* Failures name their code and say something. */
static void must_tell(dyd_status st, const dyd_error *err) {
  MUST(st >= 0 || (err->message[0] && err->code == st && strlen(err->message) < sizeof err->message));
}

static dyd_engine_options small_run(void) {
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.max_bits = 256;
  o.max_stages = 4;
  o.max_pairs = 2000;
  o.tie_bits = 2048;
  o.seconds = 0.5;
  return o;
}

static void run_small(dyd_engine *e) {
  enum { MOST_POINTS = 20 };
  const dyd_engine_options o = small_run();
  dyd_outcome outcome;
  dyd_error err;
  dyd_pair_list pairs = {0};
  if (dyd_engine_count(e) > MOST_POINTS) return;
  dyd_status st = dyd_engine_run(&outcome, e, &o, &err);
  must_tell(st, &err);
  MUST((st < 0) == (outcome == DYD_OUTCOME_ERROR));
  if (!dyd_engine_delaunay(e)) return;
  MUST(dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(e)) >= 0);
  for (size_t k = 0; k < pairs.count; k++)
    MUST(pairs.item[k].i < pairs.item[k].j && pairs.item[k].j < dyd_engine_count(e));
  dyd_pair_list_clear(&pairs);
}

static void read_and_run(const uint8_t *data, size_t size, const dyd_read_options *options) {
  dyd_engine *e = NULL;
  dyd_error err;
  MUST(dyd_engine_new(&e) == DYD_OK);
  dyd_status st = dyd_engine_add_text(e, (const char *)data, size, options, &err);
  must_tell(st, &err);
  MUST(st >= 0 || dyd_engine_count(e) == 0);
  if (st >= 0) run_small(e);
  dyd_engine_free(e);
}

/* ---- the targets ---- */

void fuzz_points(const uint8_t *data, size_t size);
void fuzz_csv(const uint8_t *data, size_t size);
void fuzz_table(const uint8_t *data, size_t size);
void fuzz_wkt(const uint8_t *data, size_t size);
void fuzz_degrees(const uint8_t *data, size_t size);
void fuzz_packed(const uint8_t *data, size_t size);
void fuzz_area(const uint8_t *data, size_t size);
void fuzz_number(const uint8_t *data, size_t size);
void fuzz_expression(const uint8_t *data, size_t size);
void fuzz_trace(const uint8_t *data, size_t size);
void fuzz_certificate(const uint8_t *data, size_t size);
void fuzz_answer(const uint8_t *data, size_t size);
void fuzz_calls(const uint8_t *data, size_t size);

/* A points file, alone or measured and widened. */
void fuzz_points(const uint8_t *data, size_t size) {
  const dyd_read_options wide = {DYD_SIZED(dyd_read_options), .measured = true, .radius = "1/64", .merge = true};
  const dyd_read_options later = {DYD_SIZED(dyd_read_options), .skip_lines = "2", .skip_missing = true, .missing = "1"};
  read_and_run(data, size, size % 2 ? &wide : size % 3 ? NULL : &later);
}

/* Separated text; its size chooses how it is read. */
void fuzz_csv(const uint8_t *data, size_t size) {
  dyd_read_options o = {DYD_SIZED(dyd_read_options), .columns = "x,y", .skip_missing = true};
  if (size % 3 == 1) o.columns = "1,2";
  if (size % 3 == 2) o.radius_columns = "r";
  o.id = size % 2 ? "name" : NULL;
  o.decimal_comma = size % 5 == 0;
  o.merge = size % 7 == 0;
  o.no_header = size % 11 == 0;
  if (o.no_header) o.columns = "1,2", o.id = o.radius_columns = NULL;
  if (o.id && !o.merge && size % 4 == 1) o.merge_by = "id";
  o.units_row = size % 13 == 0;
  o.thousands = size % 17 == 0 ? "blank" : size % 17 == 1 ? "'" : NULL;
  o.missing = size % 3 ? "-9" : NULL;
  o.skip_lines = size % 19 == 0 ? "1" : NULL;
  if (size % 4 == 3) o.delimiter = "blank";
  read_and_run(data, size, &o);
}

/* Each field of the reading options is a bit of the first bytes: set, or not; and what columns are called. */
static size_t fields_of_bits(dyd_read_options *o, const uint8_t *data, size_t size) {
  static const char *const value[][2] = {
      {"radius", "1/64"},   {"radius_columns", "r"}, {"id", "name"},          {"carry", "all"},   {"delimiter", ";"},
      {"cost_column", "c"}, {"sigma_column", "r,r"}, {"radius_scale", "1/3"}, {"thousands", "'"}, {"missing", "-9"},
      {"skip_lines", "1"},  {"confidence", "95%"},   {"merge_by", "id"},      {"columns", "x,y"}};
  const dyd_read_field *field;
  size_t k = 0;
  for (; (field = dyd_read_field_at(NULL, NULL, k)) && k / 8 < size; k++) {
    if (!(data[k / 8] >> k % 8 & 1)) continue;
    char *place = (char *)o + field->offset;
    for (size_t v = 0; v < sizeof value / sizeof *value; v++)
      if (!field->flag && strcmp(field->name, value[v][0]) == 0) *(const char **)place = value[v][1];
    if (field->flag) *(bool *)place = true;
  }
  return k / 8 + 1 < size ? k / 8 + 1 : size;
}

/* Separated text read by any set of options. */
void fuzz_table(const uint8_t *data, size_t size) {
  dyd_read_options o = {DYD_SIZED(dyd_read_options)};
  size_t used = fields_of_bits(&o, data, size);
  if (o.no_header) o.columns = "2,3";
  read_and_run(data + used, size - used, &o);
}

/* Well-known text, as lines or as a column. */
void fuzz_wkt(const uint8_t *data, size_t size) {
  const dyd_read_options column = {DYD_SIZED(dyd_read_options), .columns = "geometry,geometry", .carry = "all"};
  const dyd_read_options discs = {DYD_SIZED(dyd_read_options), .radius = "0.5", .round = true, .merge = true};
  read_and_run(data, size, size % 3 == 0 ? &column : size % 3 == 1 ? &discs : NULL);
}

/* Longitude and latitude, in a table or not, and their images. */
void fuzz_degrees(const uint8_t *data, size_t size) {
  dyd_read_options o = {DYD_SIZED(dyd_read_options), .degrees = true};
  static const char *const names[] = {"lonE7,latE7", "lon_deg,lat_deg", "lon,lat", "lon,lat", "lon,lat"};
  if (size % 2)
    o.columns = names[size % 5], o.radius_columns = size % 3 ? "r" : NULL, o.radius_unit = size % 11 ? "m" : NULL;
  const dyd_sphere_options how = {DYD_SIZED(dyd_sphere_options), .radius = size % 7 ? NULL : "3arcsec"};
  const dyd_engine_options run = small_run();
  dyd_engine *places = NULL;
  dyd_sphere *sphere = NULL;
  dyd_outcome outcome;
  dyd_error err;
  MUST(dyd_engine_new(&places) == DYD_OK);
  dyd_status st = dyd_engine_add_text(places, (const char *)data, size, &o, &err);
  must_tell(st, &err);
  if (st >= 0 && dyd_engine_count(places) <= 20) {
    st = dyd_sphere_new(&sphere, places, &how, &err);
    must_tell(st, &err);
    if (st >= 0) must_tell(dyd_sphere_run(&outcome, sphere, &run, &err), &err);
  }
  dyd_sphere_free(sphere);
  dyd_engine_free(places);
}

static FILE *file_of(uint8_t **copy, const uint8_t *data, size_t size);

/* Packed text: gzip or zstd as it comes, cut and changed. */
void fuzz_packed(const uint8_t *data, size_t size) {
  uint8_t *copy;
  dyd_engine *e = NULL;
  dyd_error err;
  FILE *in = file_of(&copy, data, size);
  MUST(dyd_engine_new(&e) == DYD_OK);
  dyd_status st = dyd_read_points(e, in, NULL, &err);
  must_tell(st, &err);
  MUST(st >= 0 || dyd_engine_count(e) == 0);
  if (st >= 0) run_small(e);
  dyd_engine_free(e);
  fclose(in);
  free(copy);
}

/* What a dyadic's text and a whole number's are must be what a number's is. */
static void same_number(mpq_t want, dyd_status st, const char *text, size_t size) {
  dyd_dyadic x;
  int64_t whole;
  mpq_t q;
  mpq_init(q);
  dyd_dyadic_init(&x);
  if (!memchr(text, 0, size) && !memchr(text, '/', size) && dyd_dyadic_set_str(&x, text, NULL) == DYD_OK) {
    dyd_dyadic_get_q(q, &x);
    MUST(st == DYD_E_RANGE || (st == DYD_OK && mpq_equal(q, want)));
  }
  if (dyd_integer_scan(&whole, text, size, DYD_NUMBER_SIGNS, INT64_MIN, INT64_MAX))
    MUST(st == DYD_OK && mpq_cmp_si(want, whole, 1) == 0);
  dyd_dyadic_clear(&x);
  mpq_clear(q);
}

/* One number in any forms, which are the last two bytes: fewer forms take fewer texts, and mean the same. */
void fuzz_number(const uint8_t *data, size_t size) {
  if (size < 2) return;
  const unsigned forms = data[size - 1] | (data[size - 2] & 1u) << 8;
  char *text = malloc(size - 1);
  mpq_t any, some, lo, hi;
  dyd_error err;
  MUST(text);
  memcpy(text, data, size - 2);
  text[size - 2] = 0;
  mpq_inits(any, some, lo, hi, NULL);
  const dyd_status st = dyd_parse_number(any, text, size - 2, DYD_NUMBER_ANY, &err);
  must_tell(st, &err);
  MUST(st == DYD_OK || err.column <= size - 1);
  MUST((st != DYD_E_PARSE) == dyd_is_plain_number(text, size - 2));
  const dyd_status less = dyd_parse_number(some, text, size - 2, forms, &err);
  must_tell(less, &err);
  MUST(less == DYD_E_PARSE || (less == st && (st != DYD_OK || mpq_equal(any, some))));
  if (dyd_parse_measured(lo, hi, text, size - 2, NULL) == DYD_OK)
    MUST(st == DYD_OK && mpq_cmp(lo, any) <= 0 && mpq_cmp(any, hi) <= 0);
  same_number(any, st, text, size - 2);
  mpq_clears(any, some, lo, hi, NULL);
  free(text);
}

/* One coordinate: an exact number, an interval, or the ordinate of a point that is narrowed. */
void fuzz_expression(const uint8_t *data, size_t size) {
  char text[2000];
  dyd_interval x;
  dyd_error err;
  dyd_interval_init(&x);
  must_tell(dyd_interval_set_text(&x, (const char *)data, size, &err), &err);
  dyd_interval_clear(&x);
  if (size > 1900 || memchr(data, '\n', size) || memchr(data, 0, size)) return;
  int length = snprintf(text, sizeof text, "%.*s 0\n1 1\n0 2\n3 %.*s\n", (int)size, (const char *)data, (int)size / 2,
                        (const char *)data);
  if (length < (int)sizeof text) read_and_run((const uint8_t *)text, (size_t)length, NULL);
}

static FILE *file_of(uint8_t **copy, const uint8_t *data, size_t size) {
  *copy = malloc(size + 1);
  MUST(*copy);
  memcpy(*copy, data, size);
  FILE *in = fmemopen(*copy, size + !size, "rb");
  MUST(in);
  return in;
}

/* Polygons as well-known text or GeoJSON: read; to turn them again is no error. */
void fuzz_area(const uint8_t *data, size_t size) {
  uint8_t *copy;
  dyd_error err;
  dyd_area area = {0};
  size_t bad[2];
  FILE *in = file_of(&copy, data, size);
  dyd_status st = dyd_area_read(&area, in, &err);
  must_tell(st, &err);
  MUST(st >= 0 || !area.rings);
  if (st >= 0) MUST(dyd_area_orient(&area, bad) == DYD_OK);
  dyd_area_clear(&area);
  fclose(in);
  free(copy);
}

void fuzz_trace(const uint8_t *data, size_t size) {
  uint8_t *copy;
  dyd_error err;
  dyd_convergence table = {DYD_SIZED(dyd_convergence)};
  FILE *in = file_of(&copy, data, size);
  must_tell(dyd_trace_replay(&table, in, NULL, &err), &err);
  dyd_convergence_clear(&table);
  fclose(in);
  free(copy);
}

void fuzz_certificate(const uint8_t *data, size_t size) {
  uint8_t *copy;
  dyd_error err;
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  FILE *in = file_of(&copy, data, size);
  must_tell(dyd_verify_certificate(&report, in, NULL, &err), &err);
  fclose(in);
  free(copy);
}

/* Lines that a callback or an oracle program answers, one after the other. */
typedef struct answers {
  const char *text, *end;
} answers;

static dyd_status next_answer(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  answers *a = user;
  (void)request;
  const char *line = a->text, *end = memchr(line, '\n', (size_t)(a->end - line));
  if (!end) end = a->end;
  a->text = end < a->end ? end + 1 : end;
  dyd_status st = dyd_rect_narrow_text(out, line, (size_t)(end - line), err);
  must_tell(st, err);
  return st;
}

void fuzz_answer(const uint8_t *data, size_t size) {
  answers a = {(const char *)data, (const char *)data + size};
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = next_answer, .user = &a};
  const double x[2] = {0, 4}, y[2] = {0, 1};
  dyd_engine *e = NULL;
  MUST(dyd_engine_new(&e) == DYD_OK);
  MUST(dyd_engine_add_points(e, 2, x, y, NULL) == DYD_OK);
  MUST(dyd_engine_add_source(e, 3, &source, NULL) == DYD_OK);
  run_small(e);
  dyd_engine_free(e);
}

/* ---- sequences of calls ---- */

typedef struct bytes {
  const uint8_t *at, *end;
} bytes;

static unsigned next_byte(bytes *b) {
  return b->at < b->end ? *b->at++ : 0;
}

static double next_number(bytes *b) {
  static const double odd[] = {0, -0.0, 1e300, -1e-320, 0x1p-1074, 1.0 / 3};
  unsigned k = next_byte(b);
  return k < 250 ? (double)k / 8 : odd[k - 250];
}

static void call_add(dyd_engine *e, bytes *b, dyd_error *err) {
  double x = next_number(b), y = next_number(b), w = next_number(b), h = next_number(b), x1 = x + w, y1 = y + h;
  static const char *const text[] = {"sqrt(2) 1", "1/3 [2,3]", "root(x^2-5,2,3) 4", "2 x", "5+-1 pi", "sqrt(8) 1"};
  unsigned k = next_byte(b);
  if (k % 3 == 0) must_tell(dyd_engine_add_points(e, 1, &x, &y, err), err);
  if (k % 3 == 1) must_tell(dyd_engine_add_boxes(e, 1, &x, &x1, &y, &y1, err), err);
  if (k % 3 == 2) must_tell(dyd_engine_add_text(e, text[k % 6], strlen(text[k % 6]), NULL, err), err);
}

static void call_measure(dyd_engine *e, bytes *b, dyd_error *err) {
  dyd_rect r;
  char text[80];
  double x = next_number(b), y = next_number(b);
  dyd_rect_init(&r);
  snprintf(text, sizeof text, "%a+-%u %a+-%u", x, next_byte(b) % 8, y, next_byte(b) % 8);
  if (dyd_rect_set_text(&r, text, strlen(text), err) == DYD_OK)
    must_tell(dyd_engine_remeasure(e, next_byte(b) % 16, &r, err), err);
  dyd_rect_clear(&r);
}

/* Adding, measuring, running, asking and cancelling in any order, with options of any kind. */
void fuzz_calls(const uint8_t *data, size_t size) {
  bytes b = {data, data + size};
  dyd_engine *e = NULL;
  dyd_error err;
  MUST(dyd_engine_new(&e) == DYD_OK);
  for (int calls = 0; b.at < b.end && calls < 40; calls++) {
    unsigned k = next_byte(&b);
    dyd_engine_options o = small_run();
    dyd_outcome outcome;
    o.schedule = (dyd_schedule)(k / 8 % 3);
    o.start_bits = (int64_t)next_byte(&b) - 8;
    o.no_ties = k & 64;
    switch (k % 6) {
    case 0:
    case 1:
      call_add(e, &b, &err);
      break;
    case 2:
      call_measure(e, &b, &err);
      break;
    case 3:
      must_tell(dyd_engine_run(&outcome, e, &o, &err), &err);
      break;
    case 4:
      run_small(e);
      break;
    default:
      dyd_engine_cancel(e);
    }
  }
  dyd_engine_free(e);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  FUZZ_TARGET(data, size);
  return 0;
}
