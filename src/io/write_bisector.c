/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The partial bisector of two points: csv (a line for each arc), json, pictures. */
#include "base/error.h"
#include "io/arc_json.h"
#include "io/decimal.h"
#include "io/exact_text.h"
#include "io/pieces.h"
#include "picture/picture.h"
#include <dyadel/io.h>
#include <stdlib.h>

/* ---- csv ---- */

static void put_end(FILE *out, const dyd_arc_end *end) {
  const dyd_surd_point *p = &end->at;
  double lo, hi;
  fprintf(out, ",%s,", dyd_end_names[end->kind]);
  if (end->kind == DYD_END_INFINITE) {
    fputs(",,,,,", out);
    return;
  }
  dyd_exact_text(out, p->ax, p->bx, p->c, p->d);
  fputs(",", out);
  dyd_exact_text(out, p->ay, p->by, p->c, p->d);
  for (int axis = 0; axis < 2; axis++) {
    fputs(",", out);
    dyd_exact_enclose(&lo, &hi, p, axis);
    dyd_exact_decimals(out, lo, hi, ",");
  }
}

static void put_curve(FILE *out, const dyd_boundary *b) {
  for (size_t m = 0; m < b->count; m++)
    for (size_t k = 0; k < b->chain[m].count; k++) {
      const dyd_arc *a = &b->chain[m].arc[k];
      fprintf(out, "%u,%u,%s,%s,%s", (unsigned)a->far_site, (unsigned)a->near_site, dyd_arc_names[a->kind],
              dyd_feature_names[a->corner], dyd_feature_names[a->feature]);
      put_end(out, &a->begin);
      put_end(out, &a->end);
      fputs("\n", out);
    }
}

static void write_csv(FILE *out, const dyd_boundary curve[2]) {
  fputs("# arcs of dl_far = ds_near, nearer to far on the left; x, y exact, lo rounded down, hi rounded up\n", out);
  if (!curve[0].count) fputs("# the rectangles meet: nothing is surely nearer to one of them\n", out);
  fputs("far,near,kind,corner,feature,begin,begin_x,begin_y,begin_xlo,begin_xhi,begin_ylo,begin_yhi,"
        "end,end_x,end_y,end_xlo,end_xhi,end_ylo,end_yhi\n",
        out);
  for (int k = 0; k < 2; k++) put_curve(out, &curve[k]);
}

/* ---- json ---- */

dyd_status dyd_rect_json(FILE *out, const dyd_rect *r) {
  char *text[4] = {dyd_end_text(&r->x, false), dyd_end_text(&r->x, true), dyd_end_text(&r->y, false),
                   dyd_end_text(&r->y, true)};
  bool good = text[0] && text[1] && text[2] && text[3];
  if (good) fprintf(out, "{\"x\": [\"%s\", \"%s\"], \"y\": [\"%s\", \"%s\"]}", text[0], text[1], text[2], text[3]);
  for (int k = 4; k-- > 0;) free(text[k]);
  return good ? DYD_OK : DYD_E_NOMEM;
}

void dyd_pieces_json_head(FILE *out, const char *format, dyd_outcome outcome) {
  fprintf(out,
          "{\"format\": \"%s\",\n\"version\": \"%s\",\n\"rounding\": \"texts are exact numbers; pairs of numbers are "
          "rounded outward: the first down, the second up\",\n\"outcome\": \"%s\",\n",
          format, dyd_version(), dyd_outcome_text(outcome));
}

static dyd_status write_json(FILE *out, const dyd_rect *const r[2], const dyd_boundary curve[2], dyd_outcome outcome) {
  dyd_status status = DYD_OK;
  dyd_point_texts texts = {0};
  dyd_pieces_json_head(out, "dyadel bisector 1", outcome);
  fputs("\"rectangles\": [", out);
  for (int k = 0; k < 2 && status >= 0; k++) {
    if (k) fputs(",\n", out);
    status = dyd_rect_json(out, r[k]);
  }
  fputs("],\n\"curves\": [", out);
  for (int k = 0; k < 2 && status >= 0; k++) {
    fprintf(out, "%s\n{\"far\": %d, \"near\": %d, \"boundary\": ", k ? "," : "", k, 1 - k);
    status = dyd_boundary_json(out, &curve[k], &texts);
    fputs("}", out);
  }
  fputs("\n]\n}\n", out);
  dyd_point_texts_clear(&texts);
  return status;
}

/* ---- both ---- */

/* The curve of (b,a) names its sites 0, 1 for b, a. */
static void swap_names(dyd_boundary *curve) {
  for (size_t m = 0; m < curve->count; m++)
    for (size_t k = 0; k < curve->chain[m].count; k++) {
      curve->chain[m].arc[k].far_site = 1;
      curve->chain[m].arc[k].near_site = 0;
    }
}

dyd_status dyd_write_bisector(FILE *out, const dyd_rect *a, const dyd_rect *b, dyd_outcome outcome, dyd_format format,
                              dyd_error *err) {
  const dyd_rect *const r[2] = {a, b};
  dyd_status pictured = DYD_OK; /* tells err itself */
  dyd_boundary curve[2] = {{0}, {0}};
  if (format != DYD_FORMAT_CSV && format != DYD_FORMAT_JSON && !dyd_format_is_picture(format))
    return dyd_fail(err, DYD_E_ARG, "bisectors are written as csv, json, svg, pdf or png");
  dyd_status status = dyd_bisector(&curve[0], a, b);
  if (status >= 0) status = dyd_bisector(&curve[1], b, a);
  if (status >= 0) {
    swap_names(&curve[1]);
    if (format == DYD_FORMAT_JSON)
      status = write_json(out, r, curve, outcome);
    else if (format != DYD_FORMAT_CSV)
      pictured = dyd_picture_bisector(out, format, r, curve, err);
    else
      write_csv(out, curve);
  }
  for (int k = 2; k-- > 0;) dyd_boundary_clear(&curve[k]);
  if (status < 0) return dyd_fail(err, status, "%s", dyd_status_text(status));
  if (pictured < 0) return pictured;
  return ferror(out) ? dyd_fail(err, DYD_E_IO, "%s", dyd_status_text(DYD_E_IO)) : DYD_OK;
}
