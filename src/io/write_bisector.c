/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The partial bisector of two points: csv (a line for each arc), json. */
#include "io/arc_json.h"
#include "io/decimal.h"
#include "io/label_text.h"
#include "io/output.h"
#include "io/parts.h"

/* ---- csv ---- */

static void bisector_end(FILE *out, const dyd_arc_end *end) {
  const dyd_surd_point *p = &end->at;
  double box[4];
  fprintf(out, ",%s,", dyd_end_names[end->kind]);
  if (end->kind == DYD_END_INFINITE) {
    fputs(",,,,,", out);
    return;
  }
  dyd_exact_text(out, p->ax, p->bx, p->c, p->d);
  fputs(",", out);
  dyd_exact_text(out, p->ay, p->by, p->c, p->d);
  dyd_exact_enclose(box, p);
  for (int k = 0; k < 4; k += 2) {
    fputs(",", out);
    dyd_exact_decimals(out, box[k], box[k + 1], ",");
  }
}

static void bisector_curve(FILE *out, const dyd_boundary *b, const dyd_engine *e) {
  for (size_t m = 0; m < b->count; m++)
    for (size_t k = 0; k < b->chain[m].count; k++) {
      const dyd_arc *a = &b->chain[m].arc[k];
      fprintf(out, "%zu,%zu,%s,%s,%s", dyd_engine_row(e, a->far_site), dyd_engine_row(e, a->near_site),
              dyd_arc_names[a->kind], dyd_feature_names[a->corner], dyd_feature_names[a->feature]);
      bisector_end(out, &a->begin);
      bisector_end(out, &a->end);
      dyd_csv_ids(out, e, (const uint32_t[]){a->far_site, a->near_site}, 2);
      fputs("\n", out);
    }
}

dyd_status dyd_bisector_csv(const dyd_output *o) {
  const dyd_bisector_output *b = o->what;
  FILE *out = o->out;
  fputs("# arcs of dl_far = ds_near, nearer to far on the left; x, y exact, lo rounded down, hi rounded up\n", out);
  if (!b->curve[0].count) fputs("# the rectangles meet: nothing is surely nearer to one of them\n", out);
  fputs("far,near,kind,corner,feature,begin,begin_x,begin_y,begin_xlo,begin_xhi,begin_ylo,begin_yhi,"
        "end,end_x,end_y,end_xlo,end_xhi,end_ylo,end_yhi",
        out);
  fputs(dyd_engine_id(b->engine, 0) ? ",id_far,id_near\n" : "\n", out);
  for (int k = 0; k < 2; k++) bisector_curve(out, &b->curve[k], b->engine);
  return DYD_OK;
}

/* ---- json ---- */

dyd_status dyd_bisector_json(const dyd_output *o) {
  const dyd_bisector_output *b = o->what;
  FILE *out = o->out;
  dyd_status st = DYD_OK;
  dyd_point_texts texts = {.engine = b->engine};
  dyd_json_head_outward(out, "dyadel bisector 1", b->outcome);
  fputs("\"rectangles\": [", out);
  for (int k = 0; k < 2 && st == DYD_OK; k++) {
    if (k) fputs(",\n", out);
    st = dyd_json_rect(out, b->r[k]);
  }
  fputs("],\n\"curves\": [", out);
  for (int k = 0; k < 2 && st == DYD_OK; k++) {
    const uint32_t far = (uint32_t)k, near = 1 - far;
    fprintf(out, "%s\n{\"far\": %zu, \"near\": %zu", k ? "," : "", dyd_engine_row(b->engine, far),
            dyd_engine_row(b->engine, near));
    if (dyd_engine_id(b->engine, 0)) {
      fputs(", \"id_far\": ", out);
      dyd_json_text(out, dyd_engine_id(b->engine, far));
      fputs(", \"id_near\": ", out);
      dyd_json_text(out, dyd_engine_id(b->engine, near));
    }
    fputs(", \"boundary\": ", out);
    st = dyd_boundary_json(out, &b->curve[k], &texts);
    fputs("}", out);
  }
  fputs("\n]\n}\n", out);
  dyd_point_texts_clear(&texts);
  return st;
}
