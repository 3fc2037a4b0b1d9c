/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of convergence as csv and json. */
#include "io/decimal.h"
#include "io/output.h"
#include "io/parts.h"
#include <inttypes.h>
#include <math.h>
#include <string.h>

enum { DIGITS = 6 };

static size_t possible_pairs(const dyd_stage_row *r) {
  return r->count[DYD_LEGAL] + r->count[DYD_INDETERMINATE] + r->count[DYD_TIE];
}

/* Milliseconds, rounded up. */
static double row_seconds(const dyd_stage_row *r) {
  return ceil(r->seconds * 1000) / 1000;
}

/* ---- labels ---- */

/* The name, or the value, of an item; returns the next one. */
static const char *label_item(FILE *out, const char *item, bool value) {
  size_t name = strcspn(item, "="), length = strcspn(item, ",");
  const char *from = value ? item + name + 1 : item;
  fprintf(out, "%.*s", (int)(value ? length - name - 1 : name), from);
  return item[length] ? item + length + 1 : NULL;
}

static void label_csv(FILE *out, const char *label, bool values) {
  for (const char *item = label; item;) {
    item = label_item(out, item, values);
    fputs(",", out);
  }
}

static void label_json(FILE *out, const char *label) {
  fputs("\"label\": {", out);
  for (const char *item = label; item;) {
    fputs(item == label ? "\"" : ", \"", out);
    label_item(out, item, false);
    fputs("\": \"", out);
    item = label_item(out, item, true);
    fputs("\"", out);
  }
  fputs("},\n", out);
}

/* ---- csv ---- */

static void table_csv_bound(FILE *out, const dyd_dyadic *x, bool known) {
  char text[DYD_DECIMAL_SIZE] = "";
  if (known) dyd_decimal_dyadic(text, x, DIGITS, DYD_UP);
  fprintf(out, ",%s", text);
}

static void table_csv_goal(FILE *out, const dyd_engine_options *o) {
  fputs(dyd_goal_text(o->goal), out);
  if (o->goal != DYD_GOAL_DECIDED) fprintf(out, " 2^%" PRId64, -o->goal_bits);
}

const char dyd_stage_columns[] =
    "stage,bits_least,bits_most,bits_total,width_largest,width_median,possible,legal,indeterminate,tie,faces,area,"
    "hausdorff,v_area,v_hausdorff,filter,integer,exact,calls,statuses,seconds";

static dyd_status table_csv_head(FILE *out, const dyd_convergence *c, const char *label, bool times) {
  const dyd_engine_options *o = c->options;
  fprintf(out, "# schedule %s; goal ", dyd_schedule_text(o->schedule));
  table_csv_goal(out, o);
  fprintf(out, "; first stage %" PRId64 " bits, then ", o->start_bits);
  if (o->step_bits)
    fprintf(out, "steps of %" PRId64, o->step_bits);
  else
    fputs("geometric growth", out);
  fprintf(out, "; at most %" PRId64 " bits; outcome %s\n", o->max_bits, dyd_outcome_text(c->outcome));
  dyd_status st = DYD_OK;
  if (c->window) {
    fputs("# v_area and v_hausdorff are of the Voronoi diagram on the window ", out);
    st = dyd_put_window(out, c->window, "", ",");
    fputs("\n", out);
  }
  fputs("# widths, areas and Hausdorff distances are upper bounds, decimals rounded up; empty: not known\n"
        "# bits, decisions (filter, integer, exact) and calls are counted from the start; statuses is a digest of all "
        "pairs with their statuses\n",
        out);
  fprintf(out, "# no random choice is made: there is no seed, and every run gives this table%s\n",
          times ? ", seconds (rounded up) aside" : "");
  label_csv(out, label, false);
  fprintf(out, "%.*s\n", (int)(strlen(dyd_stage_columns) - (times ? 0 : strlen(",seconds"))), dyd_stage_columns);
  return st;
}

/* With a point, whatever the caller's locale has between units and thousandths. */
static void table_seconds(FILE *out, const char *before, double seconds) {
  uint64_t thousandths = (uint64_t)(1000 * seconds + 0.5);
  fprintf(out, "%s%" PRIu64 ".%03" PRIu64, before, thousandths / 1000, thousandths % 1000);
}

static void table_csv_row(FILE *out, const dyd_stage_row *r, bool times) {
  fprintf(out, "%" PRIu64 ",%" PRId64 ",%" PRId64 ",%" PRIu64, r->stage, r->bits_least, r->bits_most, r->bits_total);
  table_csv_bound(out, &r->width_largest, true);
  table_csv_bound(out, &r->width_median, true);
  fprintf(out, ",%zu,%zu,%zu,%zu,%zu", possible_pairs(r), r->count[DYD_LEGAL], r->count[DYD_INDETERMINATE],
          r->count[DYD_TIE], r->undecided_faces);
  table_csv_bound(out, &r->area, r->bounded);
  table_csv_bound(out, &r->hausdorff, r->bounded);
  table_csv_bound(out, &r->v_area, r->voronoi);
  table_csv_bound(out, &r->v_hausdorff, r->voronoi);
  fprintf(out, ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%016" PRIx64, r->rungs.filter, r->rungs.integer,
          r->rungs.exact, r->calls, r->digest);
  if (times) table_seconds(out, ",", row_seconds(r));
  fputs("\n", out);
}

/* ---- json ---- */

static dyd_status table_json_bounds(FILE *out, const dyd_stage_row *r) {
  const struct {
    const char *name;
    const dyd_dyadic *value;
  } bound[] = {{"width_largest", &r->width_largest},       {"width_median", &r->width_median},
               {"area", r->bounded ? &r->area : NULL},     {"hausdorff", r->bounded ? &r->hausdorff : NULL},
               {"v_area", r->voronoi ? &r->v_area : NULL}, {"v_hausdorff", r->voronoi ? &r->v_hausdorff : NULL}};
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < sizeof bound / sizeof *bound && st == DYD_OK; k++) {
    fputs(", ", out);
    st = dyd_json_bound(out, bound[k].name, bound[k].value);
  }
  return st;
}

static dyd_status table_json_head(FILE *out, const dyd_convergence *c) {
  const dyd_engine_options *o = c->options;
  dyd_json_head(out, "dyadel converge 1");
  fprintf(
      out,
      "\"rounding\": \"widths and bounds are upper bounds; exact is exact, decimal is rounded up; null is not known, "
      "or "
      "beyond the largest double; seconds are rounded up\",\n\"schedule\": \"%s\",\n\"goal\": \"%s\",\n\"goal_bits\": "
      "%" PRId64 ",\n\"start_bits\": %" PRId64 ",\n\"step_bits\": %" PRId64 ",\n\"max_bits\": %" PRId64
      ",\n\"seed\": null,\n\"outcome\": \"%s\",\n\"window\": ",
      dyd_schedule_text(o->schedule), dyd_goal_text(o->goal), o->goal_bits, o->start_bits, o->step_bits, o->max_bits,
      dyd_outcome_text(c->outcome));
  fputs(c->window ? "[" : "null,\n", out);
  if (!c->window) return DYD_OK;
  dyd_status st = dyd_put_window(out, c->window, "\"", ",");
  fputs("],\n", out);
  return st;
}

static dyd_status table_json_row(FILE *out, const dyd_stage_row *r, bool times) {
  fprintf(out,
          "{\"stage\": %" PRIu64 ", \"bits_least\": %" PRId64 ", \"bits_most\": %" PRId64 ", \"bits_total\": %" PRIu64
          ",\n \"possible\": %zu, \"legal\": %zu, \"indeterminate\": %zu, \"tie\": %zu, \"faces\": %zu",
          r->stage, r->bits_least, r->bits_most, r->bits_total, possible_pairs(r), r->count[DYD_LEGAL],
          r->count[DYD_INDETERMINATE], r->count[DYD_TIE], r->undecided_faces);
  dyd_status st = table_json_bounds(out, r);
  fprintf(out,
          ",\n \"filter\": %" PRIu64 ", \"integer\": %" PRIu64 ", \"exact\": %" PRIu64 ", \"calls\": %" PRIu64
          ", \"statuses\": \"%016" PRIx64 "\"",
          r->rungs.filter, r->rungs.integer, r->rungs.exact, r->calls, r->digest);
  if (times) table_seconds(out, ", \"seconds\": ", row_seconds(r));
  fputs("}", out);
  return st;
}

dyd_status dyd_convergence_csv(const dyd_output *o) {
  const dyd_stage_table *t = o->what;
  dyd_status st = t->no_header ? DYD_OK : table_csv_head(o->out, t->stages, t->label, t->times);
  for (size_t k = 0; k < t->stages->count; k++) {
    label_csv(o->out, t->label, true);
    table_csv_row(o->out, t->stages->row[k], t->times);
  }
  return st;
}

dyd_status dyd_convergence_json(const dyd_output *o) {
  const dyd_stage_table *t = o->what;
  dyd_status st = table_json_head(o->out, t->stages);
  if (t->label) label_json(o->out, t->label);
  fputs("\"stages\": [", o->out);
  for (size_t k = 0; st == DYD_OK && k < t->stages->count; k++) {
    fputs(k ? ",\n" : "\n", o->out);
    st = table_json_row(o->out, t->stages->row[k], t->times);
  }
  fputs("\n]}\n", o->out);
  return st;
}
