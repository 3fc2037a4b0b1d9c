/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lists of points of a page, by their numbers there, as differences, which pack well: of pairs (i, j), sorted, i less
 * that of the pair before, and j - i; of triangles the same of their first corners, and the others less these. */
#ifndef DYD_PICTURE_HTML_LIST_H
#define DYD_PICTURE_HTML_LIST_H

#include <stdint.h>
#include <stdio.h>

typedef struct dyd_html_list {
  FILE *out;
  const char *between;
  uint32_t before; /* the first number of the last thing */
} dyd_html_list;

/* "NAME": [ */
void dyd_html_list_begin(dyd_html_list *l, FILE *out, const char *name);
/* A thing of `count` numbers. */
void dyd_html_list_put(dyd_html_list *l, const uint32_t *number, int count);
void dyd_html_list_end(dyd_html_list *l);

#endif
