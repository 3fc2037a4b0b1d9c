/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The partial disc of three points, and where the others are: csv, json, pictures. */
#include "base/error.h"
#include "io/exact_text.h"
#include "io/pieces.h"
#include "picture/picture.h"
#include "voronoi/surd_point.h"
#include <dyadel/arc.h>
#include <dyadel/io.h>

enum { CIRCLES = 6, SIDES = 4 };

static const char *const circle_names[CIRCLES] = {"FCC", "CFC", "CCF", "CFF", "FCF", "FFC"};
static const char *const side_names[SIDES] = {"xlo", "xhi", "ylo", "yhi"};

static const char *con_text(dyd_sure con) {
  return con == DYD_SURE_PLUS ? "inside" : con == DYD_SURE_MINUS ? "outside" : "unknown";
}

static const char *orientation_text(dyd_sure s) {
  return s == DYD_SURE_PLUS ? "counter-clockwise" : s == DYD_SURE_MINUS ? "clockwise" : "unknown";
}

/* A circle as points in lowest terms: its centre, and (radius^2, 0). Copied. */
static void split(dyd_surd_point *centre, dyd_surd_point *radius2, const dyd_circle *k) {
  mpz_set(centre->ax, k->ax);
  mpz_set(centre->bx, k->bx);
  mpz_set(centre->ay, k->ay);
  mpz_set(centre->by, k->by);
  mpz_set(centre->c, k->c);
  mpz_set(centre->d, k->d);
  mpz_set(radius2->ax, k->ar);
  mpz_set(radius2->bx, k->br);
  mpz_set_ui(radius2->ay, 0);
  mpz_set_ui(radius2->by, 0);
  mpz_set(radius2->c, k->c);
  mpz_set(radius2->d, k->dr);
  dyd_surd_point_tidy(centre);
  dyd_surd_point_tidy(radius2);
}

typedef void (*put_circle_fn)(FILE *out, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2);

static void each_circle(FILE *out, const dyd_partial_disc *d, put_circle_fn put) {
  dyd_surd_point centre, radius2;
  dyd_surd_point_init(&centre);
  dyd_surd_point_init(&radius2);
  for (int k = 0; k < CIRCLES && d->known; k++) {
    split(&centre, &radius2, &d->circle[k]);
    put(out, k, &centre, &radius2);
  }
  dyd_surd_point_clear(&radius2);
  dyd_surd_point_clear(&centre);
}

/* The smallest box in doubles around the six centres: it holds the partial centre [CEN-1]. */
static void enclose_centre(double box[SIDES], const dyd_partial_disc *d) {
  dyd_surd_point centre, radius2;
  dyd_surd_point_init(&centre);
  dyd_surd_point_init(&radius2);
  for (int k = 0; k < CIRCLES; k++) {
    split(&centre, &radius2, &d->circle[k]);
    for (int axis = 0; axis < 2; axis++) {
      double lo, hi;
      dyd_exact_enclose(&lo, &hi, &centre, axis);
      if (!k || lo < box[2 * axis]) box[2 * axis] = lo;
      if (!k || hi > box[2 * axis + 1]) box[2 * axis + 1] = hi;
    }
  }
  dyd_surd_point_clear(&radius2);
  dyd_surd_point_clear(&centre);
}

/* ---- csv ---- */

static void put_circle(FILE *out, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2) {
  double lo, hi;
  fprintf(out, "# circle %s x ", circle_names[number]);
  dyd_exact_text(out, centre->ax, centre->bx, centre->c, centre->d);
  fputs(" y ", out);
  dyd_exact_text(out, centre->ay, centre->by, centre->c, centre->d);
  fputs(" radius^2 ", out);
  dyd_exact_text(out, radius2->ax, radius2->bx, radius2->c, radius2->d);
  fprintf(out, "\n# circle %s within", circle_names[number]);
  for (int axis = 0; axis < 2; axis++) {
    dyd_exact_enclose(&lo, &hi, centre, axis);
    fprintf(out, " %s ", side_names[2 * axis]);
    dyd_exact_decimals(out, lo, hi, axis ? " yhi " : " xhi ");
  }
  fputs(" rlo ", out);
  dyd_exact_enclose_root(&lo, &hi, radius2);
  dyd_exact_decimals(out, lo, hi, " rhi ");
  fputs("\n", out);
}

static void write_csv(FILE *out, const dyd_partial_disc *d, const dyd_rect *const *r, size_t n) {
  fprintf(out, "# orientation of 0 1 2: %s\n", orientation_text(dyd_orientation(r[0], r[1], r[2])));
  fputs(
      "# critical circles: F encloses, C touches the rectangles 0 1 2; x, y, radius^2 exact, lo rounded down, hi up\n",
      out);
  each_circle(out, d, put_circle);
  if (d->known) {
    double box[SIDES];
    enclose_centre(box, d);
    fputs("# partial centre within xlo ", out);
    dyd_exact_decimals(out, box[0], box[1], " xhi ");
    fputs(" ylo ", out);
    dyd_exact_decimals(out, box[2], box[3], " yhi ");
    fputs("\n", out);
  }
  fputs("i,con\n", out);
  for (size_t i = 3; i < n; i++) fprintf(out, "%zu,%s\n", i, con_text(dyd_partial_disc_con(d, r[i])));
}

/* ---- json ---- */

static void put_text(FILE *out, const char *name, mpz_srcptr a, mpz_srcptr b, const dyd_surd_point *p) {
  fprintf(out, ", \"%s\": \"", name);
  dyd_exact_text(out, a, b, p->c, p->d);
  fputs("\"", out);
}

static void put_circle_json(FILE *out, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2) {
  static const char *const names[2] = {"x_decimal", "y_decimal"};
  double lo, hi;
  fprintf(out, "%s\n{\"labels\": \"%s\"", number ? "," : "", circle_names[number]);
  put_text(out, "x", centre->ax, centre->bx, centre);
  put_text(out, "y", centre->ay, centre->by, centre);
  put_text(out, "radius_squared", radius2->ax, radius2->bx, radius2);
  for (int axis = 0; axis < 2; axis++) {
    dyd_exact_enclose(&lo, &hi, centre, axis);
    fprintf(out, ", \"%s\": ", names[axis]);
    dyd_exact_decimals_json(out, lo, hi);
  }
  dyd_exact_enclose_root(&lo, &hi, radius2);
  fputs(", \"radius_decimal\": ", out);
  dyd_exact_decimals_json(out, lo, hi);
  fputs("}", out);
}

static void put_centre_json(FILE *out, const dyd_partial_disc *d) {
  double box[SIDES];
  fputs("\n],\n\"partial_centre\": ", out);
  if (!d->known) {
    fputs("null", out);
    return;
  }
  enclose_centre(box, d);
  fputs("{\"x_decimal\": ", out);
  dyd_exact_decimals_json(out, box[0], box[1]);
  fputs(", \"y_decimal\": ", out);
  dyd_exact_decimals_json(out, box[2], box[3]);
  fputs("}", out);
}

static dyd_status write_json(FILE *out, const dyd_partial_disc *d, const dyd_rect *const *r, size_t n,
                             dyd_outcome outcome) {
  dyd_status status = DYD_OK;
  dyd_pieces_json_head(out, "dyadel disc 1", outcome);
  fputs("\"rectangles\": [", out);
  for (size_t i = 0; i < n && status >= 0; i++) {
    if (i) fputs(",\n", out);
    status = dyd_rect_json(out, r[i]);
  }
  fprintf(out, "],\n\"orientation\": \"%s\",\n\"circles\": [", orientation_text(dyd_orientation(r[0], r[1], r[2])));
  each_circle(out, d, put_circle_json);
  put_centre_json(out, d);
  fputs(",\n\"con\": [", out);
  for (size_t i = 3; i < n; i++)
    fprintf(out, "%s\n{\"i\": %zu, \"con\": \"%s\"}", i > 3 ? "," : "", i, con_text(dyd_partial_disc_con(d, r[i])));
  fputs("\n]\n}\n", out);
  return status;
}

dyd_status dyd_write_disc(FILE *out, const dyd_rect *const *r, size_t n, dyd_outcome outcome, dyd_format format,
                          dyd_error *err) {
  if (n < 3) return dyd_fail(err, DYD_E_ARG, "a disc needs three points");
  if (format != DYD_FORMAT_CSV && format != DYD_FORMAT_JSON && !dyd_format_is_picture(format))
    return dyd_fail(err, DYD_E_ARG, "discs are written as csv, json, svg, pdf or png");
  dyd_status status = DYD_OK, pictured = DYD_OK; /* the latter tells err itself */
  dyd_partial_disc d;
  dyd_partial_disc_init(&d);
  dyd_partial_disc_set(&d, r[0], r[1], r[2]);
  if (format == DYD_FORMAT_JSON)
    status = write_json(out, &d, r, n, outcome);
  else if (format != DYD_FORMAT_CSV)
    pictured = dyd_picture_disc(out, format, &d, r, n, err);
  else
    write_csv(out, &d, r, n);
  dyd_partial_disc_clear(&d);
  if (status < 0) return dyd_fail(err, status, "%s", dyd_status_text(status));
  if (pictured < 0) return pictured;
  return ferror(out) ? dyd_fail(err, DYD_E_IO, "%s", dyd_status_text(DYD_E_IO)) : DYD_OK;
}
