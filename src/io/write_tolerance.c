/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tolerances: their layers as csv, wkt and geojson, and all of them as json. */
#include "base/sort.h"
#include "io/parts.h"
#include "io/result.h"
#include "io/table.h"
#include <math.h>
#include <stdlib.h>

static const dyd_tolerance *tolerance_of(const dyd_output *o) {
  return ((const dyd_tolerance_result *)o->what)->tolerance;
}

static const dyd_result *nominal_of(const dyd_output *o) {
  return ((const dyd_tolerance_result *)o->what)->result;
}

static dyd_table_head tolerance_head(const dyd_output *o, const char *const *column, dyd_geometry geometry) {
  const dyd_result *r = nominal_of(o);
  return (dyd_table_head){o->out, o->format, column, geometry, r->epsg, r->engine, NULL};
}

static dyd_status tolerance_places(dyd_place **out, const dyd_output *o) {
  char bound[DYD_DECIMAL_SIZE];
  return o->format == DYD_FORMAT_CSV ? DYD_OK : dyd_result_places(out, bound, nominal_of(o), o->err);
}

/* What has no row, since work was cancelled; births: SIZE_MAX: they were not looked for. */
static bool tolerance_is_cut(size_t *edges, size_t *births, const dyd_output *o) {
  dyd_tolerance_left(edges, births, tolerance_of(o));
  return *edges || *births;
}

/* In csv: aliases, and the tolerance of the whole; what is missing. */
static void tolerance_comments(const dyd_output *o) {
  double lo, hi;
  if (o->format != DYD_FORMAT_CSV) return;
  dyd_csv_aliases(o->out, nominal_of(o)->engine);
  dyd_tolerance_whole(&lo, &hi, tolerance_of(o));
  fputs("# tolerance ", o->out);
  dyd_decimal_put(o->out, lo, DYD_DOWN, "inf");
  fputs(" ", o->out);
  dyd_decimal_put(o->out, hi, DYD_UP, "inf");
  fputs("\n", o->out);
  size_t edges, births;
  if (!tolerance_is_cut(&edges, &births, o)) return;
  fprintf(o->out, "# cut: %zu edges have no row; ", edges);
  if (births == SIZE_MAX)
    fputs("births were not looked for\n", o->out);
  else
    fprintf(o->out, "%zu pairs that may be born have none\n", births);
}

/* ---- layers ---- */

/* Empty where nobody binds. */
static void row_binding(dyd_table *t, uint32_t k) {
  if (k == DYD_NO_SITE)
    dyd_row_decimal(t, NAN, DYD_DOWN);
  else
    dyd_row_site(t, k);
}

dyd_status dyd_layer_tolerance(const dyd_output *o) {
  static const char *const column[] = {"i", "j", "event", "lo", "hi", "k", "l", "id_i", "id_j", NULL};
  static const char *const likely[] = {"i", "j", "event", "lo", "hi", "k", "l", "probability", "id_i", "id_j", NULL};
  const double *chance = dyd_tolerance_chances(tolerance_of(o));
  const dyd_table_head head = tolerance_head(o, chance ? likely : column, DYD_GEOMETRY_LINE);
  const dyd_tolerance_row *row;
  dyd_place *place = NULL;
  dyd_table t;
  dyd_status st = tolerance_places(&place, o);
  if (st != DYD_OK) return st;
  tolerance_comments(o);
  dyd_table_begin(&t, &head);
  for (size_t n = dyd_tolerance_rows(&row, tolerance_of(o)); n--; row++) {
    dyd_row_begin(&t);
    if (place) {
      dyd_row_place(&t, &place[row->i]);
      dyd_row_place(&t, &place[row->j]);
    }
    dyd_row_site(&t, row->i);
    dyd_row_site(&t, row->j);
    dyd_row_text(&t, dyd_tolerance_event_text(row->event));
    dyd_row_decimal(&t, row->lo, DYD_DOWN);
    dyd_row_decimal(&t, row->hi, DYD_UP);
    row_binding(&t, row->k);
    row_binding(&t, row->l);
    if (chance) dyd_row_decimal(&t, *chance++, DYD_DOWN);
    dyd_row_id(&t, row->i);
    dyd_row_id(&t, row->j);
    dyd_row_end(&t);
  }
  dyd_table_end(&t);
  free(place);
  return DYD_OK;
}

dyd_status dyd_layer_radii(const dyd_output *o) {
  static const char *const column[] = {"i", "id", "rho", NULL};
  const dyd_table_head head = tolerance_head(o, column, DYD_GEOMETRY_POINT);
  const double *radius = dyd_tolerance_points(tolerance_of(o));
  dyd_place *place = NULL;
  dyd_table t;
  dyd_status st = tolerance_places(&place, o);
  if (st != DYD_OK) return st;
  tolerance_comments(o);
  dyd_table_begin(&t, &head);
  for (size_t i = 0; i < nominal_of(o)->count; i++) {
    dyd_row_begin(&t);
    if (place) dyd_row_place(&t, &place[i]);
    dyd_row_site(&t, i);
    dyd_row_id(&t, i);
    dyd_row_decimal(&t, radius[i], DYD_DOWN);
    dyd_row_end(&t);
  }
  dyd_table_end(&t);
  free(place);
  return DYD_OK;
}

/* ---- how many are certain ---- */

/* The first of the ascending numbers that is above x. */
static size_t count_up_to(const double *sorted, size_t count, double x) {
  size_t lo = 0, hi = count;
  while (lo < hi) {
    size_t mid = lo + (hi - lo) / 2;
    if (sorted[mid] > x)
      hi = mid;
    else
      lo = mid + 1;
  }
  return lo;
}

/* Accuracies 1, 2 and 5 times powers of ten, from below the first death to where the last edge is gone. The number
 * shown is the text, so counts are those of an accuracy rounded up. */
static void barcode_rows(dyd_table *t, const double *death, size_t count, size_t edges) {
  static const int step[3] = {1, 2, 5};
  size_t first = count_up_to(death, count, 0);
  if (first == count) return;
  int exp = (int)floor(log10(death[first]));
  for (size_t k = 0;; k++) {
    char text[24];
    snprintf(text, sizeof text, "%de%d", step[k % 3], exp + (int)(k / 3));
    size_t gone = count_up_to(death, count, nextafter(strtod(text, NULL), INFINITY));
    dyd_row_begin(t);
    dyd_row_text(t, text);
    dyd_row_index(t, edges - gone);
    dyd_row_index(t, gone);
    dyd_row_end(t);
    if (gone == count) return;
  }
}

dyd_status dyd_layer_barcode(const dyd_output *o) {
  static const char *const column[] = {"accuracy", "certain", "open", NULL};
  const dyd_table_head head = tolerance_head(o, column, DYD_GEOMETRY_POINT);
  const dyd_tolerance_row *row;
  size_t rows = dyd_tolerance_rows(&row, tolerance_of(o)), count = 0, edges, births;
  if (tolerance_is_cut(&edges, &births, o)) return DYD_CANCELLED;
  double *death = malloc((rows + 1) * sizeof *death);
  dyd_table t;
  if (!death) return DYD_E_NOMEM;
  for (size_t k = 0; k < rows; k++) {
    edges += row[k].event == DYD_EVENT_DEATH;
    if (row[k].event == DYD_EVENT_DEATH && isfinite(row[k].lo)) death[count++] = row[k].lo;
  }
  qsort(death, count, sizeof *death, dyd_compare_double);
  tolerance_comments(o);
  dyd_table_begin(&t, &head);
  barcode_rows(&t, death, count, edges);
  dyd_table_end(&t);
  free(death);
  return DYD_OK;
}

/* ---- json ---- */

static void json_site_or_null(FILE *out, const dyd_engine *e, const char *name, uint32_t k) {
  if (k == DYD_NO_SITE)
    fprintf(out, ", \"%s\": null", name);
  else
    fprintf(out, ", \"%s\": %zu", name, dyd_engine_row(e, k));
}

/* "exact": the squares under both roots of 2 t = |sqrt(plus) - sqrt(minus)|. */
static dyd_status json_event(FILE *out, const dyd_engine *e, const dyd_tolerance *t, size_t number,
                             const dyd_tolerance_row *row, mpq_t q[2]) {
  fprintf(out, "%s\n{\"i\": %zu, \"j\": %zu, \"event\": \"%s\", \"bounds\": ", number ? "," : "",
          dyd_engine_row(e, row->i), dyd_engine_row(e, row->j), dyd_tolerance_event_text(row->event));
  dyd_json_decimals(out, row->lo, row->hi);
  json_site_or_null(out, e, "k", row->k);
  json_site_or_null(out, e, "l", row->l);
  if (dyd_tolerance_chances(t)) {
    fputs(", \"probability\": ", out);
    dyd_decimal_put(out, dyd_tolerance_chances(t)[number], DYD_DOWN, "null");
  }
  dyd_status st = dyd_tolerance_exact(q[0], q[1], t, number);
  if (st == DYD_OK) {
    fputs(", \"plus\": \"", out);
    mpq_out_str(out, 10, q[0]);
    fputs("\", \"minus\": \"", out);
    mpq_out_str(out, 10, q[1]);
    fputs("\"", out);
  }
  fputs("}", out);
  return st == DYD_E_ARG ? DYD_OK : st; /* there is no exact form */
}

static dyd_status json_events(FILE *out, const dyd_engine *e, const dyd_tolerance *t) {
  const dyd_tolerance_row *row;
  size_t rows = dyd_tolerance_rows(&row, t);
  mpq_t q[2];
  dyd_status st = DYD_OK;
  mpq_inits(q[0], q[1], NULL);
  fputs("\"pairs\": [", out);
  for (size_t k = 0; k < rows && st == DYD_OK; k++) st = json_event(out, e, t, k, &row[k], q);
  fputs("\n],\n", out);
  mpq_clears(q[0], q[1], NULL);
  return st;
}

static void json_missing(const dyd_output *o) {
  size_t edges, births;
  if (!tolerance_is_cut(&edges, &births, o)) return;
  fprintf(o->out, "\"without_row\": {\"edges\": %zu, \"births\": ", edges);
  if (births == SIZE_MAX)
    fputs("null},\n", o->out);
  else
    fprintf(o->out, "%zu},\n", births);
}

dyd_status dyd_tolerance_json(const dyd_output *o) {
  const dyd_result *r = nominal_of(o);
  const dyd_tolerance *t = tolerance_of(o);
  const double *radius = dyd_tolerance_points(t);
  double lo, hi;
  dyd_json_head(o->out, "dyadel tolerance 1");
  dyd_json_crs(o->out, r->epsg);
  bool box = dyd_tolerance_metric(t) == DYD_METRIC_BOX;
  fprintf(o->out,
          "%s\"rounding\": \"bounds are rounded outward: the first down, the second up, null is infinite; %srho and "
          "probability are rounded down\",\n\"tolerance\": ",
          box ? "\"metric\": \"box\",\n" : "", box ? "" : "twice the event is exactly |sqrt(plus) - sqrt(minus)|; ");
  dyd_tolerance_whole(&lo, &hi, t);
  dyd_json_decimals(o->out, lo, hi);
  fputs(",\n", o->out);
  json_missing(o);
  dyd_status st = json_events(o->out, r->engine, t);
  fputs("\"rho\": [", o->out);
  for (size_t i = 0; radius && i < r->count; i++) {
    fputs(i ? i % 8 ? ", " : ",\n" : "", o->out);
    dyd_decimal_put(o->out, radius[i], DYD_DOWN, "null");
  }
  fputs("],\n", o->out);
  dyd_json_aliases(o->out, r->engine, "}\n");
  return st;
}
