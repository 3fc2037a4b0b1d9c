/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries as JSON: what each arc lies on, and its ends as integers a, b, c, d of (a + b sqrt(c)) / d. */
#include "io/arc_json.h"

#include "io/decimal.h"

const char *const dyd_feature_names[8] = {"x0y0", "x1y0", "x0y1", "x1y1", "x0", "x1", "y0", "y1"};
const char *const dyd_arc_names[3] = {"line", "parabola", "window"};
const char *const dyd_end_names[5] = {"infinite", "sites", "axis", "feature", "window"};

static void put_interval(FILE *out, const char *name, const dyd_interval *a) {
  double lo, hi;
  dyd_interval_get_d(&lo, &hi, a);
  fprintf(out, ", \"%s_decimal\": [", name);
  dyd_decimal_json(out, lo, DYD_DOWN);
  fputs(", ", out);
  dyd_decimal_json(out, hi, DYD_UP);
  fputs("]", out);
}

dyd_status dyd_surd_point_json(FILE *out, const dyd_surd_point *p) {
  gmp_fprintf(out,
              "{\"x\": {\"a\": \"%Zd\", \"b\": \"%Zd\"}, \"y\": {\"a\": \"%Zd\", \"b\": \"%Zd\"}, \"c\": \"%Zd\", "
              "\"d\": \"%Zd\"",
              p->ax, p->bx, p->ay, p->by, p->c, p->d);
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status status = dyd_surd_point_enclose(&r, p, 64);
  if (status >= 0) {
    put_interval(out, "x", &r.x);
    put_interval(out, "y", &r.y);
  }
  fputs("}", out);
  dyd_rect_clear(&r);
  return status;
}

static dyd_status put_end(FILE *out, const char *name, const dyd_arc_end *end) {
  fprintf(out, ",\n  \"%s\": {\"kind\": \"%s\"", name, dyd_end_names[end->kind]);
  dyd_status status = DYD_OK;
  if (end->kind == DYD_END_SITES) fprintf(out, ", \"site\": %u", (unsigned)end->site);
  if (end->kind != DYD_END_INFINITE) {
    fputs(", \"at\": ", out);
    status = dyd_surd_point_json(out, &end->at);
  }
  fputs("}", out);
  return status;
}

static dyd_status put_arc(FILE *out, const dyd_arc *arc) {
  fprintf(out, "\n {\"kind\": \"%s\"", dyd_arc_names[arc->kind]);
  if (arc->kind != DYD_ARC_WINDOW)
    fprintf(out, ", \"far\": %u, \"corner\": \"%s\", \"near\": %u, \"feature\": \"%s\"", (unsigned)arc->far_site,
            dyd_feature_names[arc->corner], (unsigned)arc->near_site, dyd_feature_names[arc->feature]);
  dyd_status status = put_end(out, "begin", &arc->begin);
  if (status >= 0) status = put_end(out, "end", &arc->end);
  fputs("}", out);
  return status;
}

dyd_status dyd_boundary_json(FILE *out, const dyd_boundary *b) {
  dyd_status status = DYD_OK;
  fprintf(out, "{\"whole\": %s, \"chains\": [", b->whole ? "true" : "false");
  for (size_t k = 0; k < b->count && status >= 0; k++) {
    fprintf(out, "%s{\"closed\": %s, \"arcs\": [", k ? ", " : "", b->chain[k].closed ? "true" : "false");
    for (size_t a = 0; a < b->chain[k].count && status >= 0; a++) {
      if (a) fputs(",", out);
      status = put_arc(out, &b->chain[k].arc[a]);
    }
    fputs("]}", out);
  }
  fputs("]}", out);
  return status;
}
