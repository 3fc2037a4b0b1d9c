/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of reading options, and the columns that they name. */
#ifndef DYD_IO_READ_OPTIONS_H
#define DYD_IO_READ_OPTIONS_H

#include "io/read/csv.h"

/* What a column holds besides those of csv.h: numbers (a dyd_row_number more), then texts, which may be empty. */
enum {
  DYD_ROLE_NUMBER = DYD_CSV_OTHER,
  DYD_ROLE_SIGMA =
      DYD_ROLE_NUMBER + DYD_ROW_SIGMA, /* in x; then in y, and the correlation, which are no dyd_row_number */
  DYD_ROLE_RHO = DYD_ROLE_SIGMA + 2,
  DYD_ROLE_ID,
  DYD_ROLES
};
_Static_assert(DYD_ROW_SIGMA + 1 == DYD_ROW_NUMBERS, "sigmas are behind the other numbers");
_Static_assert((int)DYD_ROLES <= (int)DYD_CSV_MOST, "each role has a column");

/* A field; the roles of the columns that it names, from `role` on, at least `least` and at most `most` of them (0: it
 * names none); and what these hold. */
typedef struct dyd_read_option {
  dyd_read_field field;
  int role;
  size_t least, most;
  const char *holds;
} dyd_read_option;

/* Option k; NULL after the last. *value is what options say, as of dyd_read_field_at. */
const dyd_read_option *dyd_read_option_at(const char **value, const dyd_read_options *options, size_t k);
/* What a column of this role holds. */
const char *dyd_role_holds(int role);

#endif
