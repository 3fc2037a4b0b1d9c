/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The file of a page: what comes before the data, the data packed, what comes behind. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */
#define ZLIB_CONST              /* what is packed is read only */
#include "picture/html/file.h"

#include "base/error.h"
#include <stdlib.h>
#include <zlib.h>

/* Made by pack.py. */
extern const unsigned char dyd_html_before[], dyd_html_after[];
extern const size_t dyd_html_before_size, dyd_html_after_size;

enum { GROUPS = 1 << 12, BLOCK = 3 * GROUPS }; /* of three bytes */

/* A line of base64 (RFC 4648). */
static void put_base64(FILE *out, const unsigned char *p, size_t size) {
  static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  char line[4 * GROUPS + 1], *to = line;
  for (size_t k = 0; k < size; k += 3) {
    unsigned a = p[k], b = k + 1 < size ? p[k + 1] : 0, c = k + 2 < size ? p[k + 2] : 0, word = a << 16 | b << 8 | c;
    *to++ = digit[word >> 18];
    *to++ = digit[word >> 12 & 63];
    *to++ = k + 1 < size ? digit[word >> 6 & 63] : '=';
    *to++ = k + 2 < size ? digit[word & 63] : '=';
  }
  *to++ = '\n';
  fwrite(line, 1, (size_t)(to - line), out);
}

/* The text is given to zlib in pieces that its counters hold. */
static dyd_status put_packed(FILE *out, const char *text, size_t size) {
  enum { PIECE = 1 << 20 };
  unsigned char block[BLOCK];
  z_stream z = {.next_out = block, .avail_out = BLOCK};
  if (deflateInit(&z, Z_BEST_COMPRESSION) != Z_OK) return DYD_E_NOMEM;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    if (z.avail_in == 0 && size) {
      z.next_in = (const unsigned char *)text;
      z.avail_in = size < PIECE ? (uInt)size : PIECE;
      text += z.avail_in;
      size -= z.avail_in;
    }
    state = deflate(&z, size || z.avail_in ? Z_NO_FLUSH : Z_FINISH);
    if (z.avail_out && state != Z_STREAM_END) continue;
    put_base64(out, block, BLOCK - z.avail_out);
    z.next_out = block;
    z.avail_out = BLOCK;
  }
  deflateEnd(&z);
  return DYD_OK;
}

dyd_status dyd_html_write(const dyd_output *o, dyd_html_data_fn data) {
  char *text = NULL;
  size_t size = 0;
  FILE *to = open_memstream(&text, &size);
  if (!to) return DYD_E_NOMEM;
  dyd_status st = data(to, o);
  if (fclose(to) != 0 && st == DYD_OK) st = DYD_E_NOMEM;
  if (st == DYD_OK) {
    fwrite(dyd_html_before, 1, dyd_html_before_size, o->out);
    st = put_packed(o->out, text, size);
    fwrite(dyd_html_after, 1, dyd_html_after_size, o->out);
  }
  free(text);
  return st;
}
