/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The two layouts of input: the points file and separated text with a header. Both give spans of text. */
#ifndef DYD_IO_READ_CSV_H
#define DYD_IO_READ_CSV_H

#include "io/read/text.h"
#include "sphere/units.h"
#include <dyadel/io.h>

/* Splits one line of a points file. *count is 2, or 0 for a line without a point. comma separates besides blanks; a
 * blank: nothing else does. */
dyd_status dyd_points_split(dyd_span coordinate[2], size_t *count, const dyd_text_line *line, char comma,
                            dyd_error *err);

/* The places of a geometry in well-known text, one after another; without the place that closes a ring. */
typedef struct dyd_wkt {
  dyd_span text, first[2]; /* of the ring */
  dyd_span srid;           /* 4326 in "SRID=4326;" or "EPSG:4326;" in front; length 0: there is none */
  const char *at, *end;
  const char *wrong;         /* the fault at `at`; NULL: none */
  int depth;                 /* parentheses that are open */
  bool point, rings, inside; /* it is a point; it has rings; it has been entered */
} dyd_wkt;
/* Returns true if the text begins as a geometry does. */
bool dyd_wkt_begin(dyd_wkt *w, const dyd_span *text);
/* Returns false after the last one, or where something is wrong. A geometry without places, "POINT EMPTY", has one of
 * length 0. */
bool dyd_wkt_next(dyd_span place[2], dyd_wkt *w);

/* What a column is wanted for. Roles from DYD_CSV_OTHER on are the caller's. */
enum { DYD_CSV_X, DYD_CSV_Y, DYD_CSV_RADIUS_X, DYD_CSV_RADIUS_Y, DYD_CSV_OTHER, DYD_CSV_MOST = 24 };

/* A column as the caller names it. name = NULL: none is wanted. quoted: digits are a name, no number. */
typedef struct dyd_csv_want {
  char *name;
  bool quoted;
  const char *option; /* the field that names it, for messages */
} dyd_csv_want;

/* Separated text (RFC 4180) being read. Initialise with {.text = ...}. */
typedef struct dyd_csv {
  dyd_text *text; /* borrowed */
  char delimiter;
  dyd_csv_want want[DYD_CSV_MOST];
  size_t column[DYD_CSV_MOST]; /* where they are, from 0 */
  int roles;                   /* all that are wanted are smaller */
  size_t columns;              /* how many the header has */
  bool degrees, swapped;       /* x and y are called longitude and latitude; latitude and longitude */
  bool e7,
      minutes; /* theirs are integers of 1e-7 degrees; another column is called as one of theirs, with min for deg */
  char scaled[2][24];                 /* x and y of the present record, where e7 */
  const dyd_unit *unit[DYD_CSV_MOST]; /* that the columns of radii and standard deviations state; NULL: none */
  bool headless, units_row;           /* set by the caller: no header; a row of units behind it */
  bool decimal_comma;                 /* set by the caller: commas separate columns only where nothing else does */
  bool comments;                      /* records that begin with # or % are passed over */
  bool fresh;                         /* no record behind the header has been read */
  bool held, marked, trails; /* the record in `field` is the next; the header begins with # or % alone; its last name is
                                empty */
  size_t commented;          /* comments that would be points */
  char *record;              /* the current record, when it spans lines */
  size_t record_cap;         /* */
  char *plain;               /* unquoted fields of the current record */
  size_t plain_cap, used;    /* */
  dyd_span *field;
  size_t fields, field_cap;
  const char *carry; /* set by the caller: "all", or names of columns; NULL: none */
  size_t *carried;   /* where they are */
  size_t carries, carried_cap;
  char *names; /* theirs, terminated */
  size_t names_used, names_cap;
} dyd_csv;

/* Asks for the columns that `text` names, at least `least` and at most `most`, for the roles from `first` on; a single
 * name gives the first two. Names with commas are quoted as in RFC 4180. option names the field of the options,
 * borrowed. DYD_E_ARG when the text is not of this form; DYD_E_NOMEM. */
dyd_status dyd_csv_ask(dyd_csv *csv, int first, size_t least, size_t most, const char *text, const char *option,
                       dyd_error *err);
/* Reads the header. NULL takes the delimiter from it; "blank": runs of blanks. Lines of # or % before it that do
 * not have the columns are skipped; so is a line such as "sep=;", which sets the delimiter, too. degrees: columns
 * called latitude and longitude, in this order, are an error. Called once, after the columns of x and y were asked for.
 * DYD_E_ARG when delimiter is not of its form, or columns of a file without a header are not given by number;
 * DYD_E_PARSE when the header does not have each column once. */
dyd_status dyd_csv_open(dyd_csv *csv, const char *delimiter, bool degrees, dyd_error *err);
void dyd_csv_clear(dyd_csv *csv);
/* The fields of the next record, blanks around them removed; fields not requested stay as they are. *count is
 * 0 at the end, else above. Borrowed until the next call. */
dyd_status dyd_csv_next(dyd_span field[DYD_CSV_MOST], size_t *count, dyd_csv *csv, dyd_error *err);
/* Returns true if a column is called as x, easting or longitude are (axis 0), or y, northing or latitude (1). */
bool dyd_name_is_axis(const dyd_span *name, int axis);
/* Writes two names as `columns` takes them, quoted for a shell where that is needed. */
void dyd_names_put(char out[160], const dyd_span *x, const dyd_span *y);
/* Sets what the names of the header say of the columns. Fails with DYD_E_ARG where x and y have other units than one
 * another and, with degrees, where they are in the other order or not in degrees. */
dyd_status dyd_names_mean(dyd_csv *csv, bool degrees, dyd_error *err);
/* Fails with DYD_E_ARG, at the cell, where two units are known (not NULL) and differ. */
dyd_status dyd_names_agree(const dyd_span *cell, const dyd_unit *x, const dyd_unit *y, dyd_error *err);
/* Makes degrees of x and y of the present record where they are integers of 1e-7 degrees. Fails with DYD_E_PARSE where
 * the rest of an angle is in another column: W or S, minutes. */
dyd_status dyd_names_complete(dyd_csv *csv, dyd_span cell[2], dyd_error *err);
/* The number, from 1, of the column with zones of UTM; 0: there is none. */
size_t dyd_zone_find(const dyd_csv *csv);
/* Remembers a zone such as 32, 32U or 32 N where it is the first one, or another. */
void dyd_zone_see(char seen[2][4], const dyd_span *cell);
/* Returns true if the text begins with an error value of spreadsheets, such as #N/A. */
bool dyd_is_sheet_error(const char *text, size_t length);
/* Where a first line that is no point looks like a header, the message of *err becomes, or gets, the remedy. text: the
 * lines behind it; the next one is taken. */
void dyd_csv_hint(dyd_error *err, const dyd_text_line *line, dyd_text *text);
/* Returns true if it begins with # or %. Error values of spreadsheets, such as #N/A, are not comments. */
bool dyd_line_is_comment(const dyd_text_line *line);

/* ---- options.c: the table of reading options, and the columns that they name ---- */

/* What a column holds besides those above: numbers (a dyd_row_number more), then texts, which may be empty. */
enum {
  DYD_ROLE_NUMBER = DYD_CSV_OTHER,
  DYD_ROLE_SIGMA = DYD_ROLE_NUMBER + DYD_ROW_NUMBERS, /* in x; then in y, and the correlation */
  DYD_ROLE_RHO = DYD_ROLE_SIGMA + 2,
  DYD_ROLE_ID,
  DYD_ROLES
};
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
