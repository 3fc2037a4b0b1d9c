/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The answers to nearest-site queries, of one place or of many: csv, json. */
#include "io/decimal.h"
#include "io/label_text.h"
#include "io/output.h"
#include "io/parts.h"
#include "io/result.h"

static const char *nearest_status(const dyd_nearest_answer *a) {
  return a->sure ? "sure" : "possible";
}

/* The distance from the place to site i, whatever both are. scratch: a rectangle. */
static dyd_status nearest_distance(double bounds[2], const dyd_nearest_output *n, const dyd_nearest_answer *a,
                                   uint32_t i, dyd_rect *scratch) {
  dyd_status st = dyd_sites_get(scratch, dyd_delaunay_sites(n->pd), i);
  if (st == DYD_OK) dyd_rect_distance(&bounds[0], &bounds[1], a->at, scratch);
  return st;
}

static dyd_status nearest_json_list(FILE *out, const dyd_nearest_output *n, const dyd_nearest_answer *a,
                                    dyd_rect *scratch) {
  dyd_status st = DYD_OK;
  fprintf(out, "\"tied\": %s, \"nearest\": [", a->tied ? "true" : "false");
  for (size_t k = 0; k < a->found->count && st == DYD_OK; k++) {
    double bounds[2];
    st = nearest_distance(bounds, n, a, a->found->item[k], scratch);
    if (st != DYD_OK) break;
    fprintf(out, "%s\n{\"i\": %zu, \"status\": \"%s\", \"distance\": ", k ? "," : "",
            dyd_engine_row(n->engine, a->found->item[k]), nearest_status(a));
    dyd_json_decimals(out, bounds[0], bounds[1]);
    dyd_json_ids(out, n->engine, &a->found->item[k], 0);
    fputs("}", out);
  }
  fputs("\n]", out);
  return st;
}

dyd_status dyd_nearest_json(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  const dyd_nearest_answer *a = n->answer[0];
  dyd_rect scratch;
  dyd_rect_init(&scratch);
  dyd_json_head_outward(o->out, "dyadel nearest 1", a->outcome);
  dyd_status st = dyd_json_sides(o->out, a->at, ",\n");
  fputs(",\n", o->out);
  if (st == DYD_OK) st = nearest_json_list(o->out, n, a, &scratch);
  fputs(",\n", o->out);
  dyd_json_aliases(o->out, n->engine, "}\n");
  dyd_rect_clear(&scratch);
  return st;
}

dyd_status dyd_places_json(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  dyd_rect scratch;
  dyd_status st = DYD_OK;
  dyd_rect_init(&scratch);
  dyd_json_head_outward(o->out, "dyadel nearest places 1", n->outcome);
  fputs("\"places\": [", o->out);
  for (size_t q = 0; q < n->count && st == DYD_OK; q++) {
    fprintf(o->out, "%s\n{\"q\": %zu, \"outcome\": \"%s\", ", q ? "," : "", q, dyd_outcome_text(n->answer[q]->outcome));
    st = dyd_json_sides(o->out, n->answer[q]->at, ", ");
    fputs(", ", o->out);
    if (st == DYD_OK) st = nearest_json_list(o->out, n, n->answer[q], &scratch);
    fputs("}", o->out);
  }
  fputs("\n],\n", o->out);
  dyd_json_aliases(o->out, n->engine, "}\n");
  dyd_rect_clear(&scratch);
  return st;
}

/* A line for each tie: its points, after the place where there are many. */
static void nearest_ties(const dyd_output *o, bool many) {
  const dyd_nearest_output *n = o->what;
  for (size_t q = 0; q < n->count; q++) {
    if (!n->answer[q]->tied) continue;
    fputs("# tie ", o->out);
    if (many) fprintf(o->out, "%zu: ", q);
    dyd_put_rows(o->out, n->engine, n->answer[q]->found, " ");
    fputs("\n", o->out);
  }
}

/* Rows, which begin with the number of the place where there are many. */
static dyd_status nearest_rows(const dyd_output *o, bool many) {
  const dyd_nearest_output *n = o->what;
  dyd_rect scratch;
  dyd_status st = DYD_OK;
  dyd_rect_init(&scratch);
  dyd_csv_aliases(o->out, n->engine);
  nearest_ties(o, many);
  fprintf(o->out, "# rounding: lo down, hi up; empty: beyond doubles\n%si,status,lo,hi%s\n", many ? "q," : "",
          dyd_csv_id_head(n->engine, 0));
  for (size_t q = 0; q < n->count; q++) {
    const dyd_nearest_answer *a = n->answer[q];
    for (size_t k = 0; k < a->found->count && st == DYD_OK; k++) {
      double bounds[2];
      st = nearest_distance(bounds, n, a, a->found->item[k], &scratch);
      if (many) fprintf(o->out, "%zu,", q);
      fprintf(o->out, "%zu,%s,", dyd_engine_row(n->engine, a->found->item[k]), nearest_status(a));
      dyd_decimal_put(o->out, bounds[0], DYD_DOWN, "");
      fputs(",", o->out);
      dyd_decimal_put(o->out, bounds[1], DYD_UP, "");
      dyd_csv_ids(o->out, n->engine, &a->found->item[k], 0);
      fputs("\n", o->out);
    }
  }
  dyd_rect_clear(&scratch);
  return st;
}

dyd_status dyd_nearest_csv(const dyd_output *o) {
  return nearest_rows(o, false);
}

dyd_status dyd_places_csv(const dyd_output *o) {
  return nearest_rows(o, true);
}
