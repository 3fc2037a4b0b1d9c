/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lines of a text file, read in blocks and unpacked where they are gzip or zstd, and positions for error messages.
 *
 * A packed file may be several packed files one after another (bgzip, pigz, cat): they are read as one. */
#define ZLIB_CONST
#include "io/read/text.h"

#include "base/alloc.h"
#include "base/error.h"
#include "stream/number.h"

#include <errno.h>
#include <string.h>
#include <zlib.h>
#include <zstd.h>

enum { PACKED_BLOCK = 1 << 16, TEXT_BLOCK = 1 << 17, AUTOMATIC_GZIP = 15 + 16 };

/* Packed bytes read and not yet unpacked: at[0 .. left). Exactly one of the two unpackers is in use.
 * between: the last byte unpacked was the last of a packed file. */
struct dyd_unpacker {
  bool is_gzip, between, ended;
  z_stream gzip;
  ZSTD_DStream *zstd;
  const unsigned char *at;
  size_t left;
  unsigned char block[PACKED_BLOCK];
};

static dyd_status bytes_read_file(size_t *got, void *out, size_t size, dyd_text *t, dyd_error *err) {
  errno = 0;
  *got = fread(out, 1, size, t->in);
  if (*got == size || !ferror(t->in)) return DYD_OK;
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

static dyd_status unpacker_new(dyd_text *t, const char *first, size_t n, dyd_error *err) {
  dyd_unpacker *u = calloc(1, sizeof *u);
  if (!u) return dyd_fail_nomem(err);
  t->unpacker = u;
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
  z->next_out = (unsigned char *)*out, z->avail_out = *room > PACKED_BLOCK ? PACKED_BLOCK : (uInt)*room;
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
static dyd_status unpacker_fill(dyd_text *t, dyd_error *err) {
  dyd_unpacker *u = t->unpacker;
  if (u->left || u->ended) return DYD_OK;
  u->at = u->block;
  dyd_status st = bytes_read_file(&u->left, u->block, PACKED_BLOCK, t, err);
  u->ended = u->left < PACKED_BLOCK;
  return st;
}

/* gzip files may be filled up with zeros (tapes). */
static bool only_zeros(const dyd_unpacker *u) {
  for (size_t k = 0; k < u->left; k++)
    if (u->at[k]) return false;
  return true;
}

static dyd_status bytes_unpack(size_t *got, char *out, size_t size, dyd_text *t, dyd_error *err) {
  dyd_unpacker *u = t->unpacker;
  char *at = out;
  for (size_t room = size; room;) {
    size_t before = room;
    dyd_status st = unpacker_fill(t, err);
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
static dyd_status bytes_begin(size_t *got, char *out, size_t size, dyd_text *t, dyd_error *err) {
  const unsigned char *first = (const unsigned char *)out;
  size_t n;
  dyd_status st = bytes_read_file(&n, out, size < PACKED_BLOCK ? size : PACKED_BLOCK, t, err);
  t->begun = true;
  if (st == DYD_OK) st = refuse_kind(first, n, err);
  if (st != DYD_OK) return st;
  if (begins_gzip(first, n) || begins_zstd(first, n)) {
    st = unpacker_new(t, out, n, err);
    return st == DYD_OK ? bytes_unpack(got, out, size, t, err) : st;
  }
  *got = n;
  if (n < PACKED_BLOCK || n == size) return DYD_OK;
  st = bytes_read_file(got, out + n, size - n, t, err);
  *got += n;
  return st;
}

/* The next bytes, `size` of them unless the file ends: *got < size tells so. DYD_E_IO for reading, and for packed data
 * that are damaged or end early; DYD_E_PARSE for files of which the first bytes tell that they are no text. */
static dyd_status bytes_read(size_t *got, char *out, size_t size, dyd_text *t, dyd_error *err) {
  if (!t->begun) return bytes_begin(got, out, size, t, err);
  return t->unpacker ? bytes_unpack(got, out, size, t, err) : bytes_read_file(got, out, size, t, err);
}

/* ---- lines ---- */

void dyd_text_init(dyd_text *t, FILE *in) {
  *t = (dyd_text){.in = in};
}

void dyd_text_clear(dyd_text *t) {
  if (t->unpacker && t->unpacker->is_gzip) inflateEnd(&t->unpacker->gzip);
  if (t->unpacker) ZSTD_freeDStream(t->unpacker->zstd);
  free(t->unpacker);
  free(t->buffer);
  *t = (dyd_text){0};
}

void dyd_span_position(size_t *line, size_t *column, const dyd_span *span, size_t offset) {
  const char *end = span->at + offset, *begin = span->origin, *newline;
  *line = span->line;
  while ((newline = memchr(begin, '\n', (size_t)(end - begin)))) {
    ++*line;
    begin = newline + 1;
  }
  *column = dyd_text_column(begin, (size_t)(end - begin));
}

dyd_status dyd_span_fail(dyd_error *err, const dyd_span *span, size_t offset, const char *message) {
  if (err) dyd_span_position(&err->line, &err->column, span, offset);
  return dyd_fail(err, DYD_E_PARSE, "%s", message);
}

/* Reads one more block behind what is there. */
static dyd_status text_fill(dyd_text *t, dyd_error *err) {
  if (t->start) memmove(t->buffer, t->buffer + t->start, t->end - t->start);
  t->end -= t->start;
  t->start = 0;
  if (!dyd_reserve((void **)&t->buffer, &t->cap, t->end + TEXT_BLOCK, 1)) return dyd_fail_nomem(err);
  size_t got = 0;
  dyd_status st = bytes_read(&got, t->buffer + t->end, TEXT_BLOCK, t, err);
  if (st != DYD_OK) return st;
  t->end += got;
  t->ended = got < TEXT_BLOCK;
  return DYD_OK;
}

static void text_skip_mark(dyd_text *t) {
  if (t->end - t->start >= 3 && memcmp(t->buffer + t->start, "\xEF\xBB\xBF", 3) == 0) t->start += 3;
}

dyd_status dyd_text_init_copy(dyd_text *t, const char *text, size_t length) {
  *t = (dyd_text){.buffer = dyd_alloc(length, 1), .cap = length, .end = length, .ended = true};
  if (!t->buffer) return DYD_E_NOMEM;
  if (length) memcpy(t->buffer, text, length);
  text_skip_mark(t);
  return DYD_OK;
}

/* Finds the line end in what is read, reading on as needed; *length is up to the LF or the end of the file. */
static dyd_status text_find_end(size_t *length, bool *newline, dyd_text *t, dyd_error *err) {
  for (size_t seen = 0;;) {
    size_t have = t->end - t->start;
    const char *base = have ? t->buffer + t->start : NULL;
    const char *found = have > seen ? memchr(base + seen, '\n', have - seen) : NULL;
    *newline = found != NULL;
    *length = found ? (size_t)(found - base) : have;
    if (found || t->ended || *length > DYD_TEXT_LINE_MAX) return DYD_OK;
    seen = have;
    dyd_status st = text_fill(t, err);
    if (st != DYD_OK) return st;
    if (t->line == 0 && seen == 0) text_skip_mark(t);
  }
}

static dyd_status refuse_line(const dyd_line *line, dyd_error *err) {
  dyd_span span = {line->text, line->length, line->text, line->text, line->number};
  if (line->length > DYD_TEXT_LINE_MAX)
    return dyd_span_fail(err, &span, 0, "this line is longer than 1048576 bytes; give one point per line");
  const char *nul = memchr(line->text, 0, line->length);
  if (!nul) return DYD_OK;
  return dyd_span_fail(err, &span, (size_t)(nul - line->text), "a NUL byte; give plain text in UTF-8");
}

dyd_status dyd_text_next(dyd_line *out, dyd_text *t, dyd_error *err) {
  size_t length;
  bool newline;
  dyd_status st = text_find_end(&length, &newline, t, err);
  if (st != DYD_OK) return st;
  *out = (dyd_line){0};
  if (!length && !newline) return DYD_OK;
  *out = (dyd_line){t->buffer + t->start, length, ++t->line};
  t->start += length + newline;
  if (out->length && out->text[out->length - 1] == '\r') out->length--;
  return refuse_line(out, err);
}
