/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The page of a run: the triangulation with a slider over its stages, and beside it the table's row. */
#include "picture/html/file.h"
#include "picture/html/html.h"
#include "picture/html/scene.h"

#include "base/error.h"

/* The table, as json has it, is a member of the page's data. */
static dyd_status html_table(FILE *out, const void *output) {
  dyd_output table = *(const dyd_output *)output;
  table.out = out;
  table.format = DYD_FORMAT_JSON;
  fputs("\"convergence\": ", out);
  dyd_status st = dyd_convergence_json(&table);
  fputs(",\n", out);
  return st;
}

static dyd_status html_run(FILE *to, const dyd_output *o) {
  const dyd_stage_table *t = o->what;
  if (t->result->history->stages != t->stages->count)
    return dyd_fail(o->err, DYD_E_ARG, "the history has other stages than the table has rows");
  return dyd_html_scene_write(o, to, t->result, "converge", html_table, o);
}

dyd_status dyd_html_convergence(const dyd_output *o) {
  return dyd_html_write(o, html_run);
}
