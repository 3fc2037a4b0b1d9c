/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The page of a run: the triangulation with a slider over its stages, and beside it the table's row. */
#include "picture/html/file.h"
#include "picture/html/html.h"
#include "picture/html/scene.h"

#include "base/error.h"

/* The table, as json has it, is a member of the page's data. */
static dyd_status html_run(FILE *to, const dyd_output *o, const char *layer) {
  const dyd_stage_table *t = o->what;
  const dyd_output table = {to, DYD_FORMAT_JSON, o->what, o->err};
  dyd_html_scene s;
  if (t->result->history->stages != t->stages->count)
    return dyd_fail(o->err, DYD_E_ARG, "the history has other stages than the table has rows");
  dyd_status st = dyd_html_scene_init(&s, to, t->result, o->err);
  if (st == DYD_OK) st = dyd_html_scene_head(&s, "converge", layer);
  fputs("\"convergence\": ", to);
  if (st == DYD_OK) st = dyd_convergence_json(&table);
  fputs(",\n", to);
  if (st == DYD_OK) st = dyd_html_scene_body(&s);
  fputs("}\n", to);
  dyd_html_scene_clear(&s);
  return st;
}

dyd_status dyd_html_convergence(const dyd_output *o) {
  return dyd_html_write(o, html_run, "pairs");
}
