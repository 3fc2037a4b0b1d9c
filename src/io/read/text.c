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
#include <stdint.h>
#include <string.h>
#include <zlib.h>
#include <zstd.h>

enum { PACKED_BLOCK = 1 << 16, TEXT_BLOCK = 1 << 17, AUTOMATIC_GZIP = 15 + 16, END_OF_DOS = 26 };

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

/* The next bytes, `size` of them unless the file ends: *got < size then. DYD_E_IO for reading, and for packed data
 * that are damaged or end early. */
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
  dyd_free_all(t->unpacker, t->buffer, t->recode);
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

/* Reads one more block after the present text. */
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
  return DYD_OK;
}

/* What the first block shows: a format that is not text, and CR alone at the ends of lines. */
static dyd_status text_begin(dyd_text *t, dyd_error *err) {
  dyd_status st = t->end == t->start && !t->ended ? text_fill(t, err) : DYD_OK;
  if (st != DYD_OK) return st;
  text_skip_mark(t);
  const char *first = t->end > t->start ? t->buffer + t->start : "";
  size_t n = t->end - t->start;
  t->newline = memchr(first, '\r', n) && !memchr(first, '\n', n) ? '\r' : '\n';
  t->kind = dyd_kind_find(first, n, t->data);
  return t->kind ? dyd_kind_fail(err, t->kind) : DYD_OK;
}

/* Finds the line end in the buffer, reading on as needed; *length is up to it or to the end of the file. */
static dyd_status text_find_end(size_t *length, bool *newline, dyd_text *t, dyd_error *err) {
  for (size_t seen = 0;;) {
    size_t have = t->end - t->start;
    const char *base = have ? t->buffer + t->start : NULL;
    const char *found = have > seen ? memchr(base + seen, t->newline, have - seen) : NULL;
    *newline = found != NULL;
    *length = found ? (size_t)(found - base) : have;
    if (found || t->ended || *length > DYD_TEXT_LINE_MAX) return DYD_OK;
    seen = have;
    dyd_status st = text_fill(t, err);
    if (st != DYD_OK) return st;
  }
}

static dyd_status refuse_line(const dyd_text_line *line, dyd_error *err) {
  dyd_span span = {line->text, line->length, line->text, line->text, line->number};
  if (line->length > DYD_TEXT_LINE_MAX)
    return dyd_span_fail(err, &span, 0, "this line is longer than 1048576 bytes; give one point per line");
  const char *nul = memchr(line->text, 0, line->length);
  if (!nul) return DYD_OK;
  return dyd_span_fail(err, &span, (size_t)(nul - line->text),
                       line->number > 1
                           ? "a NUL byte; give plain text in UTF-8 (tr -d '\\000' < FILE removes NUL bytes)"
                           : "a NUL byte; give plain text in UTF-8");
}

size_t dyd_utf8_length(const char *text, size_t length) {
  const unsigned char *p = (const unsigned char *)text;
  size_t n = p[0] < 0x80 ? 1 : p[0] < 0xC2 ? 0 : p[0] < 0xE0 ? 2 : p[0] < 0xF0 ? 3 : p[0] < 0xF5 ? 4 : 0;
  if (n > length) return 0;
  for (size_t k = 1; k < n; k++)
    if ((p[k] & 0xC0) != 0x80) return 0;
  if (n == 3 && ((p[0] == 0xE0 && p[1] < 0xA0) || (p[0] == 0xED && p[1] >= 0xA0))) return 0;
  if (n == 4 && ((p[0] == 0xF0 && p[1] < 0x90) || (p[0] == 0xF4 && p[1] >= 0x90))) return 0;
  return n;
}

/* Not UTF-8? Whole words of ASCII are passed over. */
static bool line_is_foreign(const dyd_text_line *line) {
  uint64_t all = 0, word;
  size_t k = 0;
  for (; k + sizeof word <= line->length; k += sizeof word) {
    memcpy(&word, line->text + k, sizeof word);
    all |= word;
  }
  for (; k < line->length; k++) all |= (unsigned char)line->text[k];
  if (!(all & UINT64_C(0x8080808080808080))) return false;
  size_t n = 1;
  for (k = 0; k < line->length && n; k += n) n = dyd_utf8_length(line->text + k, line->length - k);
  return !n;
}

/* Characters 0x80 to 0x9F of Windows-1252; the others are those of Latin-1. */
static const uint16_t windows[32] = {0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                     0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0x8D,   0x017D, 0x8F,
                                     0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                     0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

/* Recodes a line of Windows-1252 to UTF-8; it is borrowed until the next. */
static dyd_status line_recode(dyd_text_line *line, dyd_text *t, dyd_error *err) {
  if (!line_is_foreign(line)) return DYD_OK;
  if (!dyd_reserve((void **)&t->recode, &t->recode_cap, 3 * line->length, 1)) return dyd_fail_nomem(err);
  char *to = t->recode;
  for (size_t k = 0; k < line->length; k++) {
    unsigned c = (unsigned char)line->text[k];
    if (c - 0x80 < 32) c = windows[c - 0x80];
    if (c >= 0x800) *to++ = (char)(0xE0 | c >> 12);
    if (c >= 0x80) *to++ = (char)(c >= 0x800 ? 0x80 | (c >> 6 & 0x3F) : 0xC0 | c >> 6);
    *to++ = (char)(c >= 0x80 ? 0x80 | (c & 0x3F) : c);
  }
  *line = (dyd_text_line){t->recode, (size_t)(to - t->recode), line->number};
  t->recoded++;
  return DYD_OK;
}

dyd_status dyd_text_next(dyd_text_line *out, dyd_text *t, dyd_error *err) {
  size_t length;
  bool newline;
  dyd_status st = t->newline ? DYD_OK : text_begin(t, err);
  if (st == DYD_OK) st = text_find_end(&length, &newline, t, err);
  if (st != DYD_OK) return st;
  *out = (dyd_text_line){0};
  if (!length && !newline) return DYD_OK;
  *out = (dyd_text_line){t->buffer + t->start, length, ++t->line};
  t->start += length + newline;
  if (out->length && out->text[out->length - 1] == '\r') out->length--;
  if (out->length == 1 && out->text[0] == END_OF_DOS) out->length = 0;
  st = refuse_line(out, err);
  return st == DYD_OK && t->data ? line_recode(out, t, err) : st;
}
