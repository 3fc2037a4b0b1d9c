/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which format a file has that is neither a points file nor a table, by its first bytes. */
#ifndef DYD_IO_READ_KIND_H
#define DYD_IO_READ_KIND_H

#include <dyadel/status.h>
#include <stdbool.h>
#include <stddef.h>

/* Are these the same letters, whatever their case? In any locale: in Turkish, strcasecmp takes I and i for different.
 */
static inline bool dyd_same_name(const char *a, const char *b, size_t length) {
  size_t k = 0;
  for (; k < length && (a[k] == b[k] || ((a[k] ^ b[k]) == 0x20 && (a[k] | 0x20) >= 'a' && (a[k] | 0x20) <= 'z')); k++) {
  }
  return k == length;
}

/* A format. make: a command that writes a table of FILE, with these columns of x and y, or, without any, a points file;
 * NULL: `remedy` says what to do. */
typedef struct dyd_file_kind {
  const char *name, *make, *columns, *remedy;
} dyd_file_kind;

/* Returns the format of a file that begins with these bytes, unpacked; NULL where they may be text of the kind wanted:
 * points or a table (data), or any other. Static storage. */
const dyd_file_kind *dyd_kind_find(const char *first, size_t length, bool data);
/* Returns that of a cell that is a geometry in words, as WKT has it; NULL for others. Static storage. */
const dyd_file_kind *dyd_kind_of_cell(const char *text, size_t length);
/* Fails with DYD_E_PARSE and a message that names the format and what to do. */
dyd_status dyd_kind_fail(dyd_error *err, const dyd_file_kind *kind);

#endif
