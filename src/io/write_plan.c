/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What to measure next, as csv, wkt and geojson. */
#include "io/parts.h"
#include "io/result.h"
#include "io/table.h"
#include <stdlib.h>

static void plan_comments(const dyd_output *o) {
  const dyd_plan_result *p = o->what;
  const dyd_survey_row *row;
  size_t open, ties, left, rows = dyd_survey_rows(&row, p->survey);
  if (o->format != DYD_FORMAT_CSV) return;
  dyd_survey_count(&open, &ties, &left, p->survey);
  dyd_csv_aliases(o->out, p->result->engine);
  if (dyd_survey_is_cut(p->survey))
    fprintf(o->out, "# cut: the plan is not finished: %zu of %zu pairs are open after its first %zu points\n", left,
            open, rows);
  else if (left)
    fprintf(o->out, "# plan %zu points: not sufficient, %zu of %zu pairs stay open\n", rows, left, open);
  else
    fprintf(
        o->out,
        "# plan %zu points: sufficient if they turn out within these accuracies of their nominal places; verified\n",
        rows);
  if (ties)
    fprintf(o->out, "# ties %zu: pairs that no accuracy decides, if points are at their nominal places\n", ties);
}

dyd_status dyd_plan_rows(const dyd_output *o) {
  static const char *const column[] = {
      "rank", "i", "half_width_now", "half_width_needed", "pairs_decided", "pairs_left", "id", NULL};
  const dyd_plan_result *p = o->what;
  const dyd_table_head head = {o->out, o->format, column, DYD_GEOMETRY_POINT, p->result->epsg, p->result->engine, NULL};
  const dyd_survey_row *row;
  size_t rows = dyd_survey_rows(&row, p->survey);
  char bound[DYD_DECIMAL_SIZE];
  dyd_place *place = NULL;
  dyd_table t;
  dyd_status st = o->format == DYD_FORMAT_CSV ? DYD_OK : dyd_result_places(&place, bound, p->result, o->err);
  if (st != DYD_OK) return st;
  plan_comments(o);
  dyd_table_begin(&t, &head);
  for (size_t k = 0; k < rows && (k == 0 || !p->next); k++) {
    dyd_row_begin(&t);
    if (place) dyd_row_place(&t, &place[row[k].site]);
    dyd_row_index(&t, k + 1);
    dyd_row_site(&t, row[k].site);
    dyd_row_decimal(&t, row[k].now, DYD_UP);
    dyd_row_decimal(&t, row[k].needed, DYD_DOWN);
    dyd_row_index(&t, row[k].decided);
    dyd_row_index(&t, row[k].left);
    dyd_row_id(&t, row[k].site);
    dyd_row_end(&t);
  }
  dyd_table_end(&t);
  free(place);
  return DYD_OK;
}
