/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the writers share: the result to be written and the places where sites are drawn. */
#ifndef DYD_IO_RESULT_H
#define DYD_IO_RESULT_H

#include "io/decimal.h"
#include "io/output.h"

/* All borrowed but pairs. */
typedef struct dyd_result {
  FILE *out;
  const dyd_engine *engine;
  const dyd_delaunay *pd;
  const dyd_sites *sites;
  size_t count; /* sites, aliases included */
  dyd_pair_list pairs;
  const dyd_rect *window; /* what pictures show; NULL: everything */
} dyd_result;

/* A representative of a site. Invariant: every point of the site's rectangle is within `error` of it in x and
 * in y. */
typedef struct dyd_place {
  char x[DYD_DECIMAL_SIZE], y[DYD_DECIMAL_SIZE];
  double error;
} dyd_place;

/* "legal", "indeterminate", "tie", "illegal". */
const char *dyd_pair_status_text(dyd_pair_status status);
/* The box of site i; DYD_E_RANGE with a message that names the site when it is not finite in doubles. */
dyd_status dyd_result_box(double box[4], const dyd_result *r, size_t i, dyd_error *err);
/* The places of all sites; *out is released with free(). `bound` is the largest error among them, two digits rounded
 * up. */
dyd_status dyd_result_places(dyd_place **out, char bound[DYD_DECIMAL_SIZE], const dyd_result *r, dyd_error *err);

/* The rows of sites: "3, 7, 9". */
void dyd_put_rows(FILE *out, const dyd_engine *e, const dyd_index_list *list, const char *between);
/* The sites of each undecided face, behind `first` or `next`, before `end`. */
dyd_status dyd_result_faces(const dyd_result *r, const char *first, const char *next, const char *between,
                            const char *end);

#endif
