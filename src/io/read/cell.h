/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cells of tables as people write them: nothing in many words, commas for points, thousands apart. */
#ifndef DYD_IO_READ_CELL_H
#define DYD_IO_READ_CELL_H

#include "io/read/text.h"
#include <dyadel/io.h>

/* How the cells of a file are written. Initialise by dyd_style_read; clear by dyd_style_clear. */
typedef struct dyd_style {
  const dyd_read_options *o; /* borrowed */
  char thousands;            /* the separator of groups of three digits; ' ': blanks of any kind; 0: nothing */
  dyd_span doubt;            /* the first cell such as 1,001 that may mean 1001 or 1.001; text = NULL: none */
  size_t line, column;       /* its place */
  bool settled;              /* a cell shows that commas are decimal */
  char *plain;               /* cells rewritten: room for those of a row */
  size_t plain_cap;
} dyd_style;

/* DYD_E_ARG when options contradict each other or are not of their form. */
dyd_status dyd_style_read(dyd_style *out, const dyd_read_options *o, dyd_error *err);
void dyd_style_clear(dyd_style *style);
/* Returns true for an empty cell and for words that mean nothing. */
bool dyd_cell_is_missing(const dyd_style *style, const dyd_span *cell);
/* Gives `count` cells, or those of them that have a text, points for decimal commas and no marks of thousands. Borrowed
 * until the next call. DYD_E_PARSE where a mark is not between groups of three digits; DYD_E_NOMEM. */
dyd_status dyd_cells_plain(dyd_style *style, dyd_span *cell, size_t count, dyd_error *err);
/* Fails with DYD_E_PARSE at the first doubtful cell if none shows what commas mean. */
dyd_status dyd_style_settle(const dyd_style *style, dyd_error *err);
/* Appends to the message, after the failure st at a cell, how people may mean it and what to give then; returns st.
 * first: the cell is in the first row of a table. */
dyd_status dyd_cell_hint(dyd_status st, const dyd_style *style, const dyd_span *cell, bool first, dyd_error *err);
/* Returns what a cell that is an expression may mean besides, and what to write instead, where people write such for
 * something else: 2024-01-02, 1.2-1.4, 1/2/2024, 5-1/2, (1.5), 1.5+103; NULL for others. Static storage. */
const char *dyd_cell_doubt(const dyd_span *cell);
/* Returns a remedy for a cell that does not hold a number: "; " and a sentence; NULL where that is not known. Static
 * storage.
 */
const char *dyd_cell_remedy(const dyd_span *cell);
/* Returns the same about a first line without a point, which the message is about; "" where it is not known. */
const char *dyd_line_remedy(const dyd_text_line *line, const char *message);
/* Returns the length of the number in "0.02 m", and 0 if the cell is not a number and a unit. */
size_t dyd_cell_number(const dyd_span *cell);

#endif
