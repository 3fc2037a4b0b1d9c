/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows of input, of either layout, to staged points with their labels. */
#ifndef DYD_IO_READ_INTAKE_H
#define DYD_IO_READ_INTAKE_H

#include "engine/labels.h"
#include "io/read/nominal.h"
#include "io/read/source.h"
#include "io/read/stage.h"

/* Invariant: every row so far is in report.rows, and, where labels are kept, in labels. */
typedef struct dyd_intake {
  const dyd_read_options *o; /* borrowed */
  mpq_t radius, scale;       /* of all points; of what columns hold */
  const dyd_unit *unit;      /* of radii that state none, on the sphere; NULL: there is none */
  dyd_manner manner[2];      /* of x and y in the present row */
  double kept[2];            /* radii of this row that do not widen it, rounded up */
  dyd_stage stage;
  dyd_labels labels;
  dyd_nominals places;
  dyd_read_report report;
  char *plain; /* fields with points in place of commas */
  size_t plain_cap;
} dyd_intake;

/* DYD_E_ARG when the options are not of their form; dyd_intake_clear comes after it in any case. */
dyd_status dyd_intake_init(dyd_intake *in, const dyd_read_options *o, dyd_error *err);
void dyd_intake_clear(dyd_intake *in);
/* Takes in one row: fields by their roles, text = NULL where there is none. span is changed. */
dyd_status dyd_intake_row(dyd_intake *in, dyd_span span[DYD_CSV_ROLES], dyd_error *err);
/* Adds all points to e, with their labels; the stage is empty afterwards. */
dyd_status dyd_intake_commit(dyd_engine *e, dyd_intake *in, dyd_error *err);

#endif
