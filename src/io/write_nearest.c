/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The answer to a nearest-site query: csv, json. */
#include "io/output.h"
#include "io/parts.h"

static const char *nearest_status(const dyd_nearest_answer *a) {
  return a->sure ? "sure" : "possible";
}

dyd_status dyd_nearest_json(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  const dyd_nearest_answer *a = n->answer;
  FILE *out = o->out;
  dyd_json_head(out, "dyadel nearest 1");
  fprintf(out, "\"outcome\": \"%s\",\n", dyd_outcome_text(a->outcome));
  dyd_status st = dyd_json_sides(out, a->at, ",\n");
  fputs(",\n\"nearest\": [", out);
  for (size_t k = 0; k < a->found->count; k++)
    fprintf(out, "%s\n{\"i\": %u, \"status\": \"%s\"}", k ? "," : "", (unsigned)a->found->item[k], nearest_status(a));
  fputs("\n],\n", out);
  dyd_json_aliases(out, n->pd, "}\n");
  return st;
}

dyd_status dyd_nearest_csv(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  const dyd_nearest_answer *a = n->answer;
  dyd_csv_aliases(o->out, n->pd);
  fputs("i,status\n", o->out);
  for (size_t k = 0; k < a->found->count; k++)
    fprintf(o->out, "%u,%s\n", (unsigned)a->found->item[k], nearest_status(a));
  return DYD_OK;
}
