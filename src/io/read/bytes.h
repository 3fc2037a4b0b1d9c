/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The bytes of a file, unpacked where they are gzip or zstd; its first bytes tell. */
#ifndef DYD_IO_READ_BYTES_H
#define DYD_IO_READ_BYTES_H

#include <dyadel/status.h>
#include <stdbool.h>
#include <stdio.h>

typedef struct dyd_unpacker dyd_unpacker;

/* Invariant: unpacker = NULL before the first read and for what is not packed. */
typedef struct dyd_bytes {
  FILE *in; /* borrowed */
  bool begun;
  dyd_unpacker *unpacker;
} dyd_bytes;

void dyd_bytes_init(dyd_bytes *b, FILE *in);
void dyd_bytes_clear(dyd_bytes *b);
/* The next bytes, `size` of them unless the file ends: *got < size tells so. DYD_E_IO for reading, and for packed data
 * that are damaged or end early; DYD_E_PARSE for files of which the first bytes tell that they are no text. */
dyd_status dyd_bytes_read(size_t *got, char *out, size_t size, dyd_bytes *b, dyd_error *err);

#endif
