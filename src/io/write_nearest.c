/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The answer to a nearest-site query: csv, json. */
#include "io/label_text.h"
#include "io/output.h"
#include "io/parts.h"

static const char *nearest_status(const dyd_nearest_answer *a) {
  return a->sure ? "sure" : "possible";
}

static void nearest_json_site(const dyd_nearest_output *n, FILE *out, size_t k) {
  const dyd_nearest_answer *a = n->answer;
  fprintf(out, "%s\n{\"i\": %zu, \"status\": \"%s\"", k ? "," : "", dyd_engine_row(n->engine, a->found->item[k]),
          nearest_status(a));
  dyd_json_ids(out, n->engine, &a->found->item[k], 0);
  fputs("}", out);
}

dyd_status dyd_nearest_json(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  const dyd_nearest_answer *a = n->answer;
  FILE *out = o->out;
  dyd_json_head(out, "dyadel nearest 1");
  fprintf(out, "\"outcome\": \"%s\",\n", dyd_outcome_text(a->outcome));
  dyd_status st = dyd_json_sides(out, a->at, ",\n");
  fputs(",\n\"nearest\": [", out);
  for (size_t k = 0; k < a->found->count; k++) nearest_json_site(o->what, out, k);
  fputs("\n],\n", out);
  dyd_json_aliases(out, n->engine, "}\n");
  return st;
}

dyd_status dyd_nearest_csv(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  const dyd_nearest_answer *a = n->answer;
  dyd_csv_aliases(o->out, n->engine);
  fprintf(o->out, "i,status%s\n", dyd_csv_id_head(n->engine, 0));
  for (size_t k = 0; k < a->found->count; k++) {
    fprintf(o->out, "%zu,%s", dyd_engine_row(n->engine, a->found->item[k]), nearest_status(a));
    dyd_csv_ids(o->out, n->engine, &a->found->item[k], 0);
    fputs("\n", o->out);
  }
  return DYD_OK;
}
