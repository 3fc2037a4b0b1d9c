/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The partial disc of three points, and where the others are: csv, json. */
#include "io/decimal.h"
#include "io/label_text.h"
#include "io/output.h"
#include "io/parts.h"
#include <math.h>

enum { CIRCLES = 6 };

static const char *const circle_names[CIRCLES] = {"FCC", "CFC", "CCF", "CFF", "FCF", "FFC"};

static const char *con_text(dyd_sure con) {
  return con == DYD_SURE_PLUS ? "inside" : con == DYD_SURE_MINUS ? "outside" : "unknown";
}

static const char *orientation_text(dyd_sure s) {
  return s == DYD_SURE_PLUS ? "counter-clockwise" : s == DYD_SURE_MINUS ? "clockwise" : "unknown";
}

typedef void circle_visit(void *context, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2);

static void disc_each_circle(const dyd_partial_disc *d, circle_visit visit, void *context) {
  dyd_surd_point centre, radius2;
  dyd_surd_point_init(&centre);
  dyd_surd_point_init(&radius2);
  for (int k = 0; k < CIRCLES && d->known; k++) {
    dyd_exact_circle(&centre, &radius2, &d->circle[k]);
    visit(context, k, &centre, &radius2);
  }
  dyd_surd_point_clear(&radius2);
  dyd_surd_point_clear(&centre);
}

/* The smallest box in doubles around the six centres: it holds the partial centre [CEN-1]. */
static void disc_grow_box(void *context, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2) {
  double *box = context, b[4];
  (void)number, (void)radius2;
  dyd_exact_enclose(b, centre);
  for (int k = 0; k < 4; k++) box[k] = k & 1 ? fmax(box[k], b[k]) : fmin(box[k], b[k]);
}

/* ---- csv ---- */

static void disc_csv_box(FILE *out, const double box[4]) {
  fputs(" within xlo ", out);
  dyd_exact_decimals(out, box[0], box[1], " xhi ");
  fputs(" ylo ", out);
  dyd_exact_decimals(out, box[2], box[3], " yhi ");
}

static void disc_csv_circle(void *context, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2) {
  FILE *out = context;
  double box[4], lo, hi;
  fprintf(out, "# circle %s x ", circle_names[number]);
  dyd_exact_text(out, centre->ax, centre->bx, centre->c, centre->d);
  fputs(" y ", out);
  dyd_exact_text(out, centre->ay, centre->by, centre->c, centre->d);
  fputs(" radius^2 ", out);
  dyd_exact_text(out, radius2->ax, radius2->bx, radius2->c, radius2->d);
  fprintf(out, "\n# circle %s", circle_names[number]);
  dyd_exact_enclose(box, centre);
  disc_csv_box(out, box);
  fputs(" rlo ", out);
  dyd_exact_enclose_root(&lo, &hi, radius2);
  dyd_exact_decimals(out, lo, hi, " rhi ");
  fputs("\n", out);
}

dyd_status dyd_disc_csv(const dyd_output *o) {
  const dyd_disc_output *c = o->what;
  const dyd_partial_disc *d = c->disc;
  FILE *out = o->out;
  fprintf(out, "# orientation of %zu %zu %zu: %s\n", dyd_engine_row(c->engine, 0), dyd_engine_row(c->engine, 1),
          dyd_engine_row(c->engine, 2), orientation_text(dyd_orientation(c->r[0], c->r[1], c->r[2])));
  fputs(
      "# critical circles: F encloses, C touches the rectangles 0 1 2; x, y, radius^2 exact, lo rounded down, hi up\n",
      out);
  disc_each_circle(d, disc_csv_circle, out);
  if (d->known) {
    double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
    disc_each_circle(d, disc_grow_box, box);
    fputs("# partial centre", out);
    disc_csv_box(out, box);
    fputs("\n", out);
  }
  fprintf(out, "i,con%s\n", dyd_csv_id_head(c->engine, 0));
  for (uint32_t i = 3; i < c->n; i++) {
    fprintf(out, "%zu,%s", dyd_engine_row(c->engine, i), con_text(dyd_partial_disc_con(d, c->r[i])));
    dyd_csv_ids(out, c->engine, &i, 0);
    fputs("\n", out);
  }
  return DYD_OK;
}

/* ---- json ---- */

static void disc_json_text(FILE *out, const char *name, mpz_srcptr a, mpz_srcptr b, const dyd_surd_point *p) {
  fprintf(out, ", \"%s\": \"", name);
  dyd_exact_text(out, a, b, p->c, p->d);
  fputs("\"", out);
}

static void disc_json_circle(void *context, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2) {
  FILE *out = context;
  double box[4], lo, hi;
  fprintf(out, "%s\n{\"labels\": \"%s\"", number ? "," : "", circle_names[number]);
  disc_json_text(out, "x", centre->ax, centre->bx, centre);
  disc_json_text(out, "y", centre->ay, centre->by, centre);
  disc_json_text(out, "radius_squared", radius2->ax, radius2->bx, radius2);
  dyd_exact_enclose(box, centre);
  fputs(", ", out);
  dyd_json_box(out, "_decimal", box);
  dyd_exact_enclose_root(&lo, &hi, radius2);
  fputs(", \"radius_decimal\": ", out);
  dyd_json_decimals(out, lo, hi);
  fputs("}", out);
}

static void disc_json_centre(FILE *out, const dyd_partial_disc *d) {
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  fputs("\n],\n\"partial_centre\": ", out);
  if (!d->known) {
    fputs("null", out);
    return;
  }
  disc_each_circle(d, disc_grow_box, box);
  fputs("{", out);
  dyd_json_box(out, "_decimal", box);
  fputs("}", out);
}

static void disc_json_con(FILE *out, const dyd_disc_output *c, uint32_t i) {
  fprintf(out, "%s\n{\"i\": %zu, \"con\": \"%s\"", i > 3 ? "," : "", dyd_engine_row(c->engine, i),
          con_text(dyd_partial_disc_con(c->disc, c->r[i])));
  dyd_json_ids(out, c->engine, &i, 0);
  fputs("}", out);
}

dyd_status dyd_disc_json(const dyd_output *o) {
  const dyd_disc_output *c = o->what;
  FILE *out = o->out;
  dyd_status st = DYD_OK;
  dyd_json_head_outward(out, "dyadel disc 1", c->outcome);
  fputs("\"rectangles\": [", out);
  for (size_t i = 0; i < c->n && st == DYD_OK; i++) {
    if (i) fputs(",\n", out);
    st = dyd_json_rect(out, c->r[i]);
  }
  fprintf(out, "],\n\"orientation\": \"%s\",\n\"circles\": [",
          orientation_text(dyd_orientation(c->r[0], c->r[1], c->r[2])));
  disc_each_circle(c->disc, disc_json_circle, out);
  disc_json_centre(out, c->disc);
  fputs(",\n\"con\": [", out);
  for (uint32_t i = 3; i < c->n; i++) disc_json_con(out, c, i);
  fputs("\n]\n}\n", out);
  return st;
}
