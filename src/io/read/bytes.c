/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The bytes of a file, unpacked where they are gzip or zstd.
 *
 * Both kinds may be several packed files one behind the other (bgzip, pigz, cat): they are read as one. */
#define ZLIB_CONST
#include "io/read/bytes.h"

#include "base/alloc.h"
#include "base/error.h"
#include <errno.h>
#include <string.h>
#include <zlib.h>
#include <zstd.h>

enum { BLOCK = 1 << 16, AUTOMATIC_GZIP = 15 + 16 };

/* Packed bytes read and not yet unpacked: at[0 .. left). Exactly one of the two unpackers is in use.
 * between: the last byte unpacked was the last of a packed file. */
struct dyd_unpacker {
  bool is_gzip, between, ended;
  z_stream gzip;
  ZSTD_DStream *zstd;
  const unsigned char *at;
  size_t left;
  unsigned char block[BLOCK];
};

void dyd_bytes_init(dyd_bytes *b, FILE *in) {
  *b = (dyd_bytes){.in = in};
}

void dyd_bytes_clear(dyd_bytes *b) {
  if (b->unpacker && b->unpacker->is_gzip) inflateEnd(&b->unpacker->gzip);
  if (b->unpacker) ZSTD_freeDStream(b->unpacker->zstd);
  free(b->unpacker);
  *b = (dyd_bytes){0};
}

static dyd_status bytes_read_file(size_t *got, void *out, size_t size, dyd_bytes *b, dyd_error *err) {
  errno = 0;
  *got = fread(out, 1, size, b->in);
  if (*got == size || !ferror(b->in)) return DYD_OK;
  return dyd_fail(err, DYD_E_IO, "cannot read: %s", strerror(errno ? errno : EIO));
}

/* ---- what kind of file it is ---- */

static bool begins_gzip(const unsigned char *p, size_t n) {
  return n >= 2 && p[0] == 0x1F && p[1] == 0x8B;
}

/* A frame, or one to be skipped, as pzstd puts in front. */
static bool begins_zstd(const unsigned char *p, size_t n) {
  return n >= 4 && (memcmp(p, "\x28\xB5\x2F\xFD", 4) == 0 || (p[0] >> 4 == 5 && memcmp(p + 1, "\x2A\x4D\x18", 3) == 0));
}

static dyd_status refuse_kind(const unsigned char *p, size_t n, dyd_error *err) {
  static const struct {
    char first[7];
    size_t length;
    const char *what;
  } kind[] = {{"PK\3\4", 4, "a zip archive or a spreadsheet; save it as CSV"},
              {"BZh", 3, "packed by bzip2; unpack it, or pack it by gzip or zstd"},
              {"\xFD"
               "7zXZ",
               5, "packed by xz; unpack it, or pack it by gzip or zstd"},
              {"\xFF\xFE", 2, "text in UTF-16; save it as UTF-8"},
              {"\xFE\xFF", 2, "text in UTF-16; save it as UTF-8"}};
  for (size_t k = 0; k < sizeof kind / sizeof *kind; k++)
    if (n >= kind[k].length && memcmp(p, kind[k].first, kind[k].length) == 0)
      return dyd_fail(err, DYD_E_PARSE, "the file is %s", kind[k].what);
  return DYD_OK;
}

/* ---- unpacking ---- */

static dyd_status unpacker_new(dyd_bytes *b, const char *first, size_t n, dyd_error *err) {
  dyd_unpacker *u = calloc(1, sizeof *u);
  if (!u) return dyd_fail_nomem(err);
  b->unpacker = u;
  u->at = u->block;
  u->left = n;
  memcpy(u->block, first, n);
  if (begins_gzip(u->block, n))
    u->is_gzip = inflateInit2(&u->gzip, AUTOMATIC_GZIP) == Z_OK;
  else
    u->zstd = ZSTD_createDStream();
  return u->is_gzip || u->zstd ? DYD_OK : dyd_fail_nomem(err);
}

static dyd_status unpacker_fail(dyd_error *err, const dyd_unpacker *u, const char *how) {
  return dyd_fail(err, DYD_E_IO, "the %s data %s; fetch or pack the file again", u->is_gzip ? "gzip" : "zstd", how);
}

/* As much as fits, or as the packed bytes at hand give. */
static dyd_status step_gzip(char **out, size_t *room, dyd_unpacker *u, dyd_error *err) {
  z_stream *z = &u->gzip;
  if (u->between && inflateReset(z) != Z_OK) return dyd_fail_nomem(err);
  u->between = false;
  z->next_in = u->at, z->avail_in = (uInt)u->left;
  z->next_out = (unsigned char *)*out, z->avail_out = *room > BLOCK ? BLOCK : (uInt)*room;
  int st = inflate(z, Z_NO_FLUSH);
  size_t made = (size_t)((char *)z->next_out - *out);
  *out += made, *room -= made;
  u->at = z->next_in, u->left = z->avail_in;
  u->between = st == Z_STREAM_END;
  if (st == Z_MEM_ERROR) return dyd_fail_nomem(err);
  return st == Z_OK || st == Z_STREAM_END || st == Z_BUF_ERROR ? DYD_OK : unpacker_fail(err, u, "are damaged");
}

static dyd_status step_zstd(char **out, size_t *room, dyd_unpacker *u, dyd_error *err) {
  ZSTD_inBuffer in = {u->at, u->left, 0};
  ZSTD_outBuffer to = {*out, *room, 0};
  size_t st = ZSTD_decompressStream(u->zstd, &to, &in);
  *out += to.pos, *room -= to.pos;
  u->at += in.pos, u->left -= in.pos;
  u->between = st == 0;
  if (!ZSTD_isError(st)) return DYD_OK;
  char how[80];
  snprintf(how, sizeof how, "are damaged (%s)", ZSTD_getErrorName(st));
  return unpacker_fail(err, u, how);
}

/* Sees to packed bytes at hand while the file has some. */
static dyd_status unpacker_fill(dyd_bytes *b, dyd_error *err) {
  dyd_unpacker *u = b->unpacker;
  if (u->left || u->ended) return DYD_OK;
  u->at = u->block;
  dyd_status st = bytes_read_file(&u->left, u->block, BLOCK, b, err);
  u->ended = u->left < BLOCK;
  return st;
}

/* gzip files may be filled up with zeros (tapes). */
static bool only_zeros(const dyd_unpacker *u) {
  for (size_t k = 0; k < u->left; k++)
    if (u->at[k]) return false;
  return true;
}

static dyd_status bytes_unpack(size_t *got, char *out, size_t size, dyd_bytes *b, dyd_error *err) {
  dyd_unpacker *u = b->unpacker;
  char *at = out;
  for (size_t room = size; room;) {
    size_t before = room;
    dyd_status st = unpacker_fill(b, err);
    if (st != DYD_OK) return st;
    *got = (size_t)(at - out);
    if (u->between && (!u->left || (u->is_gzip && only_zeros(u)))) return DYD_OK;
    if (u->between && u->is_gzip && u->at[0] != 0x1F) return unpacker_fail(err, u, "are followed by something else");
    bool last = !u->left;
    st = u->is_gzip ? step_gzip(&at, &room, u, err) : step_zstd(&at, &room, u, err);
    if (st != DYD_OK) return st;
    if (last && room == before && !u->between) return unpacker_fail(err, u, "end early");
  }
  *got = size;
  return DYD_OK;
}

/* The first bytes as they are; they become packed ones where they are that. */
static dyd_status bytes_begin(size_t *got, char *out, size_t size, dyd_bytes *b, dyd_error *err) {
  const unsigned char *first = (const unsigned char *)out;
  size_t n;
  dyd_status st = bytes_read_file(&n, out, size < BLOCK ? size : BLOCK, b, err);
  b->begun = true;
  if (st == DYD_OK) st = refuse_kind(first, n, err);
  if (st != DYD_OK) return st;
  if (begins_gzip(first, n) || begins_zstd(first, n)) {
    st = unpacker_new(b, out, n, err);
    return st == DYD_OK ? bytes_unpack(got, out, size, b, err) : st;
  }
  *got = n;
  if (n < BLOCK || n == size) return DYD_OK;
  st = bytes_read_file(got, out + n, size - n, b, err);
  *got += n;
  return st;
}

dyd_status dyd_bytes_read(size_t *got, char *out, size_t size, dyd_bytes *b, dyd_error *err) {
  if (!b->begun) return bytes_begin(got, out, size, b, err);
  return b->unpacker ? bytes_unpack(got, out, size, b, err) : bytes_read_file(got, out, size, b, err);
}
