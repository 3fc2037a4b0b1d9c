/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of convergence as csv and json. */
#include "base/error.h"
#include "io/decimal.h"
#include <dyadel/io.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DIGITS = 6 };

static const char *schedule_text(dyd_schedule s) {
  return s == DYD_SCHEDULE_UNIFORM ? "uniform" : "adaptive";
}

static size_t possible(const dyd_stage_row *r) {
  return r->count[DYD_LEGAL] + r->count[DYD_INDETERMINATE] + r->count[DYD_TIE];
}

/* Milliseconds, rounded up. */
static double seconds_up(const dyd_stage_row *r) {
  return ceil(r->seconds * 1000) / 1000;
}

/* ---- csv ---- */

static void csv_bound(FILE *out, const dyd_dyadic *x, bool known) {
  char text[DYD_DECIMAL_SIZE] = "";
  if (known) dyd_decimal_dyadic(text, x, DIGITS, DYD_UP);
  fprintf(out, ",%s", text);
}

static const char *const goals[] = {[DYD_GOAL_DECIDED] = "decided",
                                    [DYD_GOAL_AREA] = "area",
                                    [DYD_GOAL_HAUSDORFF] = "hausdorff",
                                    [DYD_GOAL_VORONOI_AREA] = "voronoi area",
                                    [DYD_GOAL_VORONOI_HAUSDORFF] = "voronoi hausdorff"};

static void csv_goal(FILE *out, const dyd_engine_options *o) {
  fputs(goals[o->goal], out);
  if (o->goal != DYD_GOAL_DECIDED) fprintf(out, " 2^%" PRId64, -o->goal_bits);
}

/* The ends of the window, separated by commas, each between `quote`. */
static dyd_status write_window(FILE *out, const dyd_rect *w, const char *quote) {
  const dyd_dyadic *end[] = {&w->x.lo, &w->x.hi, &w->y.lo, &w->y.hi};
  for (int k = 0; k < 4; k++) {
    char *text = dyd_dyadic_get_str(end[k]);
    if (!text) return DYD_E_NOMEM;
    fprintf(out, "%s%s%s%s", k ? "," : "", quote, text, quote);
    free(text);
  }
  return DYD_OK;
}

static dyd_status csv_head(FILE *out, const dyd_convergence *c, bool times) {
  const dyd_engine_options *o = c->options;
  fprintf(out, "# schedule %s; goal ", schedule_text(o->schedule));
  csv_goal(out, o);
  fprintf(out, "; first stage %" PRId64 " bits, then ", o->start_bits);
  if (o->step_bits)
    fprintf(out, "steps of %" PRId64, o->step_bits);
  else
    fputs("geometric growth", out);
  fprintf(out, "; at most %" PRId64 " bits; outcome %s\n", o->max_bits, dyd_outcome_text(c->outcome));
  dyd_status status = DYD_OK;
  if (c->window) {
    fputs("# v_area and v_hausdorff are of the Voronoi diagram on the window ", out);
    status = write_window(out, c->window, "");
    fputs("\n", out);
  }
  fputs("# widths, areas and Hausdorff distances are upper bounds, decimals rounded up; empty: not known\n"
        "# bits, decisions (filter, integer, exact) and calls are counted from the start; statuses is a digest of all "
        "pairs with their statuses\n",
        out);
  fprintf(out, "# no random choice is made: there is no seed, and every run gives this table%s\n",
          times ? ", seconds (rounded up) aside" : "");
  fprintf(out,
          "stage,bits_least,bits_most,bits_total,width_largest,width_median,possible,legal,indeterminate,tie,faces,"
          "area,hausdorff,v_area,v_hausdorff,filter,integer,exact,calls,statuses%s\n",
          times ? ",seconds" : "");
  return status;
}

static void csv_row(FILE *out, const dyd_stage_row *r, bool times) {
  fprintf(out, "%" PRIu64 ",%" PRId64 ",%" PRId64 ",%" PRIu64, r->stage, r->bits_least, r->bits_most, r->bits_total);
  csv_bound(out, &r->width_largest, true);
  csv_bound(out, &r->width_median, true);
  fprintf(out, ",%zu,%zu,%zu,%zu,%zu", possible(r), r->count[DYD_LEGAL], r->count[DYD_INDETERMINATE], r->count[DYD_TIE],
          r->undecided_faces);
  csv_bound(out, &r->area, r->bounded);
  csv_bound(out, &r->hausdorff, r->bounded);
  csv_bound(out, &r->v_area, r->voronoi);
  csv_bound(out, &r->v_hausdorff, r->voronoi);
  fprintf(out, ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%016" PRIx64, r->rungs.filter, r->rungs.integer,
          r->rungs.exact, r->calls, r->digest);
  if (times) fprintf(out, ",%.3f", seconds_up(r));
  fputs("\n", out);
}

/* ---- json ---- */

/* Exact, and as a decimal that a reader may take for a double. */
static dyd_status json_bound(FILE *out, const char *name, const dyd_dyadic *x, bool known) {
  fprintf(out, ", \"%s\": ", name);
  if (!known) {
    fputs("null", out);
    return DYD_OK;
  }
  char *exact = dyd_dyadic_get_str(x);
  if (!exact) return DYD_E_NOMEM;
  fprintf(out, "{\"exact\": \"%s\", \"decimal\": ", exact);
  dyd_decimal_json(out, dyd_dyadic_get_d(x, DYD_UP), DYD_UP);
  fputs("}", out);
  free(exact);
  return DYD_OK;
}

static dyd_status json_bounds(FILE *out, const dyd_stage_row *r) {
  dyd_status status = json_bound(out, "width_largest", &r->width_largest, true);
  if (status >= 0) status = json_bound(out, "width_median", &r->width_median, true);
  if (status >= 0) status = json_bound(out, "area", &r->area, r->bounded);
  if (status >= 0) status = json_bound(out, "hausdorff", &r->hausdorff, r->bounded);
  if (status >= 0) status = json_bound(out, "v_area", &r->v_area, r->voronoi);
  if (status >= 0) status = json_bound(out, "v_hausdorff", &r->v_hausdorff, r->voronoi);
  return status;
}

static dyd_status json_head(FILE *out, const dyd_convergence *c) {
  const dyd_engine_options *o = c->options;
  fprintf(
      out,
      "{\"format\": \"dyadel converge 1\",\n\"version\": \"%s\",\n\"rounding\": \"widths and bounds are upper bounds; "
      "exact is exact, decimal is rounded up; null is not known, or beyond the largest double; seconds are rounded "
      "up\",\n\"schedule\": \"%s\",\n\"goal\": \"%s\",\n\"goal_bits\": %" PRId64 ",\n\"start_bits\": %" PRId64
      ",\n\"step_bits\": %" PRId64 ",\n\"max_bits\": %" PRId64 ",\n\"seed\": null,\n\"outcome\": \"%s\",\n",
      dyd_version(), schedule_text(o->schedule), goals[o->goal], o->goal_bits, o->start_bits, o->step_bits, o->max_bits,
      dyd_outcome_text(c->outcome));
  dyd_status status = DYD_OK;
  fputs("\"window\": ", out);
  if (c->window) {
    fputs("[", out);
    status = write_window(out, c->window, "\"");
    fputs("],\n", out);
  } else {
    fputs("null,\n", out);
  }
  return status;
}

static dyd_status json_row(FILE *out, const dyd_stage_row *r, bool times) {
  fprintf(out,
          "{\"stage\": %" PRIu64 ", \"bits_least\": %" PRId64 ", \"bits_most\": %" PRId64 ", \"bits_total\": %" PRIu64
          ",\n \"possible\": %zu, \"legal\": %zu, \"indeterminate\": %zu, \"tie\": %zu, \"faces\": %zu",
          r->stage, r->bits_least, r->bits_most, r->bits_total, possible(r), r->count[DYD_LEGAL],
          r->count[DYD_INDETERMINATE], r->count[DYD_TIE], r->undecided_faces);
  dyd_status status = json_bounds(out, r);
  fprintf(out,
          ",\n \"filter\": %" PRIu64 ", \"integer\": %" PRIu64 ", \"exact\": %" PRIu64 ", \"calls\": %" PRIu64
          ", \"statuses\": \"%016" PRIx64 "\"",
          r->rungs.filter, r->rungs.integer, r->rungs.exact, r->calls, r->digest);
  if (times) fprintf(out, ", \"seconds\": %.3f", seconds_up(r));
  fputs("}", out);
  return status;
}

static dyd_status write_rows(FILE *out, const dyd_convergence *c, dyd_format format, bool times) {
  dyd_status status;
  if (format == DYD_FORMAT_CSV) {
    status = csv_head(out, c, times);
    for (size_t k = 0; k < c->count; k++) csv_row(out, c->row[k], times);
    return status;
  }
  status = json_head(out, c);
  fputs("\"stages\": [", out);
  for (size_t k = 0; status >= 0 && k < c->count; k++) {
    fputs(k ? ",\n" : "\n", out);
    status = json_row(out, c->row[k], times);
  }
  fputs("\n]}\n", out);
  return status;
}

dyd_status dyd_write_convergence(FILE *out, const dyd_convergence *c, dyd_format format, bool times, dyd_error *err) {
  if (err) dyd_error_clear(err);
  if (format != DYD_FORMAT_CSV && format != DYD_FORMAT_JSON)
    return dyd_fail(err, DYD_E_ARG, "a table of convergence is written as csv or json");
  if (!c->options) return dyd_fail(err, DYD_E_ARG, "the table is empty: there was no run");
  dyd_status status = write_rows(out, c, format, times);
  if (status < 0) return dyd_fail(err, status, "%s", dyd_status_text(status));
  if (fflush(out) != 0 || ferror(out))
    return dyd_fail(err, DYD_E_IO, "cannot write: %s", strerror(errno ? errno : EIO));
  return DYD_OK;
}
