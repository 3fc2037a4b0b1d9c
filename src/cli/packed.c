/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Compresses results by gzip or zstd if the name ends in .gz or .zst: a stream that forwards its bytes to another. */
#define _GNU_SOURCE /* fopencookie */
#define ZLIB_CONST
#include "cli.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <zlib.h>
#include <zstd.h>

enum { PACKED_BLOCK = 1 << 16, GZIP = 15 + 16, LEVEL = 6 };

/* zstd NULL: gzip is used. */
typedef struct packer {
  FILE *to; /* borrowed */
  z_stream gzip;
  ZSTD_CStream *zstd;
  unsigned char block[PACKED_BLOCK];
} packer;

bool cli_name_is_packed(size_t *length, const char *name) {
  size_t all = strlen(name), ending = 0;
  if (all > 3 && strcasecmp(name + all - 3, ".gz") == 0) ending = 3;
  if (all > 4 && strcasecmp(name + all - 4, ".zst") == 0) ending = 4;
  *length = all - ending;
  return ending;
}

/* Packs the bytes; at the end (last) all that is left. false: errno says why. */
static bool pack_bytes(packer *p, const void *bytes, size_t count, bool last) {
  ZSTD_inBuffer in = {bytes, count, 0};
  p->gzip.next_in = bytes, p->gzip.avail_in = (uInt)count;
  for (bool more = true; more;) {
    ZSTD_outBuffer out = {p->block, sizeof p->block, 0};
    p->gzip.next_out = p->block, p->gzip.avail_out = sizeof p->block;
    if (p->zstd) {
      size_t left = ZSTD_compressStream2(p->zstd, &out, &in, last ? ZSTD_e_end : ZSTD_e_continue);
      if (ZSTD_isError(left)) return errno = ENOMEM, false;
      more = last ? left > 0 : in.pos < in.size;
    } else {
      deflate(&p->gzip, last ? Z_FINISH : Z_NO_FLUSH);
      out.pos = sizeof p->block - p->gzip.avail_out;
      more = p->gzip.avail_out == 0;
    }
    if (fwrite(p->block, 1, out.pos, p->to) != out.pos) return false;
  }
  return true;
}

static ssize_t packer_write(void *cookie, const char *bytes, size_t count) {
  enum { MOST = 1 << 30 };
  if (count > MOST) count = MOST;
  return pack_bytes(cookie, bytes, count, false) ? (ssize_t)count : 0;
}

static int packer_close(void *cookie) {
  packer *p = cookie;
  bool good = pack_bytes(p, NULL, 0, true);
  if (!p->zstd) deflateEnd(&p->gzip);
  ZSTD_freeCStream(p->zstd);
  free(p);
  return good ? 0 : EOF;
}

FILE *cli_pack(FILE *to, const char *name) {
  size_t length;
  packer *p = cli_name_is_packed(&length, name) ? calloc(1, sizeof *p) : NULL;
  if (!p) return NULL;
  p->to = to;
  bool gzip = strcasecmp(name + length, ".gz") == 0;
  if (!gzip) p->zstd = ZSTD_createCStream();
  bool good = gzip ? deflateInit2(&p->gzip, LEVEL, Z_DEFLATED, GZIP, 8, Z_DEFAULT_STRATEGY) == Z_OK : p->zstd != NULL;
  FILE *out = good ? fopencookie(p, "w", (cookie_io_functions_t){.write = packer_write, .close = packer_close}) : NULL;
  if (out) return out;
  if (good && gzip) deflateEnd(&p->gzip);
  ZSTD_freeCStream(p->zstd);
  free(p);
  errno = ENOMEM;
  return NULL;
}
