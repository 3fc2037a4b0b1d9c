/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Parts, the results of one rank as a file; the manifest; parts joined to csv. */
#include "base/digest.h"
#include "base/local.h"
#include "tiles/tiles.h"

#include <errno.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- files that appear whole or not at all ---- */

char *tiles_path(const char *folder, const char *name) {
  size_t size = strlen(folder) + strlen(name) + 2;
  char *path = malloc(size);
  if (path) snprintf(path, size, "%s/%s", folder, name);
  return path;
}

static void tiles_part_name(char name[32], size_t rank) {
  snprintf(name, 32, "part-%05zu.bin", rank);
}

static dyd_status file_fail(const tiles_file *f, dyd_error *err) {
  return dyd_fail(
      err, DYD_E_IO,
      "%s: cannot write: %s; make room there, then continue with --restart, or choose another folder with -o", f->name,
      strerror(errno));
}

static void file_clear(tiles_file *f) {
  dyd_free_all(f->name, f->temporary);
  *f = (tiles_file){0};
}

static dyd_status tiles_file_open(tiles_file *f, const char *folder, const char *name, dyd_error *err) {
  char beside[64];
  snprintf(beside, sizeof beside, ".%.40s.new", name);
  *f = (tiles_file){.name = tiles_path(folder, name), .temporary = tiles_path(folder, beside)};
  dyd_status st = f->name && f->temporary ? DYD_OK : tiles_no_memory(err);
  if (st == DYD_OK) f->stream = fopen(f->temporary, "wb");
  if (st == DYD_OK && !f->stream) st = file_fail(f, err);
  if (st != DYD_OK) file_clear(f);
  return st;
}

/* Returns st, or the error of writing; the file is there when that is DYD_OK. */
static dyd_status tiles_file_close(tiles_file *f, dyd_status st, dyd_error *err) {
  if (!f->stream) return st;
  bool kept = fflush(f->stream) == 0 && !ferror(f->stream) && fsync(fileno(f->stream)) == 0;
  if (!kept && st == DYD_OK) st = file_fail(f, err);
  kept = fclose(f->stream) == 0;
  if (st == DYD_OK && (!kept || rename(f->temporary, f->name) != 0)) st = file_fail(f, err);
  if (st != DYD_OK) unlink(f->temporary);
  file_clear(f);
  return st;
}

/* ---- records ---- */

static void record_encode(unsigned char *out, const tiles_row *r) {
  for (unsigned k = 0; k < 8; k++) {
    out[k] = (unsigned char)(r->i >> 8 * k);
    out[8 + k] = (unsigned char)(r->j >> 8 * k);
  }
  for (unsigned k = 0; k < 4; k++) out[16 + k] = (unsigned char)(r->status >> 8 * k);
}

static tiles_row tiles_row_decode(const unsigned char in[TILES_RECORD]) {
  tiles_row r = {0};
  for (unsigned k = 8; k-- > 0;) {
    r.i = r.i << 8 | in[k];
    r.j = r.j << 8 | in[8 + k];
  }
  for (unsigned k = 4; k-- > 0;) r.status = r.status << 8 | in[16 + k];
  return r;
}

static bool put_row(FILE *out, uint64_t *sum, const tiles_row *r) {
  unsigned char bytes[TILES_RECORD];
  record_encode(bytes, r);
  *sum = dyd_digest(*sum, bytes, sizeof bytes);
  return fwrite(bytes, sizeof bytes, 1, out) == 1;
}

/* The sum follows the rest, the lowest byte first. */
static bool put_sum(FILE *out, uint64_t sum) {
  unsigned char bytes[TILES_SUM];
  for (unsigned k = 0; k < sizeof bytes; k++) bytes[k] = (unsigned char)(sum >> 8 * k);
  return fwrite(bytes, sizeof bytes, 1, out) == 1;
}

/* Sets *out to the sum over a part; false where the one written behind it is another. Then and there `in` is at its
 * begin. */
static bool tiles_part_sum(uint64_t *out, FILE *in) {
  unsigned char bytes[1 << 16];
  uint64_t sum = DYD_DIGEST_BEGIN, told = 0;
  rewind(in);
  /* The last eight bytes read are kept back. */
  size_t kept = 0;
  for (size_t got; (got = fread(bytes + kept, 1, sizeof bytes - kept, in)) > 0;) {
    const size_t have = kept + got, done = have > TILES_SUM ? have - TILES_SUM : 0;
    sum = dyd_digest(sum, bytes, done);
    memmove(bytes, bytes + done, kept = have - done);
  }
  for (size_t k = kept; k-- > 0;) told = told << 8 | bytes[k];
  *out = sum;
  rewind(in);
  return kept == TILES_SUM && told == sum && !ferror(in);
}

static bool get_row(tiles_row *r, FILE *in) {
  unsigned char bytes[TILES_RECORD];
  if (fread(bytes, sizeof bytes, 1, in) != 1) return false;
  *r = tiles_row_decode(bytes);
  return true;
}

/* ---- the spool, and parked places ---- */

static dyd_status spool_fail(const tile *t, dyd_error *err) {
  return dyd_fail(err, DYD_E_IO,
                  "%s: cannot write the working files of rank %zu: %s; make room there, then continue with --restart",
                  t->job->folder, t->rank, strerror(errno));
}

/* A file without a name: nothing is left of it however the process ends. */
static dyd_status open_working_file(FILE **out, const tile *t, dyd_error *err) {
  char name[40];
  snprintf(name, sizeof name, ".rows-%05zu", t->rank);
  DYD_FREED char *path = tiles_path(t->job->folder, name);
  if (!path) return tiles_no_memory(err);
  *out = fopen(path, "w+b");
  if (*out) unlink(path);
  return *out ? DYD_OK : spool_fail(t, err);
}

dyd_status tile_park(tile *t, dyd_error *err) {
  const size_t count = t->own.count * t->own.dim;
  dyd_status st = open_working_file(&t->parked, t, err);
  if (st != DYD_OK) return st;
  if (fwrite(t->own.end, sizeof *t->own.end, count, t->parked) != count || fflush(t->parked) != 0)
    return spool_fail(t, err);
  tiles_sites_end(&t->own);
  return DYD_OK;
}

dyd_status tile_unpark(tile *t, dyd_error *err) {
  const size_t count = t->own.count * t->own.dim;
  if (!tiles_sites_reserve(&t->own, t->own.count)) return tiles_no_memory(err);
  rewind(t->parked);
  size_t got = fread(t->own.end, sizeof *t->own.end, count, t->parked);
  fclose(t->parked);
  t->parked = NULL;
  return got == count ? DYD_OK
                      : dyd_fail(err, DYD_E_IO, "%s: cannot read what rank %zu wrote there; continue with --restart",
                                 t->job->folder, t->rank);
}

dyd_status tile_spool(tile *t, const tiles_rows *rows, dyd_error *err) {
  dyd_status st = t->spool ? DYD_OK : open_working_file(&t->spool, t, err);
  for (size_t k = 0; st == DYD_OK && k < rows->count; k++) {
    t->counters.count[rows->item[k].status]++;
    if (!put_row(t->spool, &(uint64_t){0}, &rows->item[k])) st = spool_fail(t, err);
  }
  return st;
}

/* ---- the header ---- */

/* As dyd_digest, of words of 64 bits. */
uint64_t tile_digest(const tile *t) {
  const tiles_sites *s = &t->own;
  uint64_t sum = DYD_DIGEST_BEGIN;
  for (size_t k = 0; k < s->count; k++) {
    uint64_t word[5] = {s->number[k]};
    memcpy(word + 1, s->end + k * s->dim, s->dim * sizeof(double));
    for (unsigned w = 0; w <= s->dim; w++) sum = (sum ^ word[w]) * DYD_DIGEST_PRIME;
  }
  return sum;
}

static json_t *header_of(const tile *t) {
  const tiles_counters *c = &t->counters;
  char digest[20];
  uint64_t all = 0; /* a part depends on the points of others, too */
  for (size_t r = 0; r < t->job->ranks; r++) all += t->info[r].digest;
  snprintf(digest, sizeof digest, "%016" PRIx64, all);
  return json_pack("{sssIsIsIsIsIsIsIsIsIsIsIsbsbsIss}", "format", "dyadel part 2", "rank", (json_int_t)t->rank, "own",
                   (json_int_t)c->own, "ghosts", (json_int_t)c->ghosts, "rounds", (json_int_t)c->rounds, "pairs",
                   (json_int_t)(c->count[1] + c->count[2] + c->count[3]), "legal", (json_int_t)c->count[DYD_LEGAL],
                   "indeterminate", (json_int_t)c->count[DYD_INDETERMINATE], "tie", (json_int_t)c->count[DYD_TIE],
                   "aliases", (json_int_t)c->aliases, "ranks", (json_int_t)t->job->ranks, "points",
                   (json_int_t)t->points, "boxes", t->job->boxes, "capped", c->capped, "max_pairs",
                   (json_int_t)t->job->max_pairs, "digest", digest);
}

static bool put_json_line(FILE *out, uint64_t *sum, json_t *j) {
  DYD_FREED char *text = j ? json_dumps(j, JSON_COMPACT) : NULL;
  bool fits = text && fprintf(out, "%s\n", text) > 0;
  if (text) *sum = dyd_digest(dyd_digest(*sum, text, strlen(text)), "\n", 1);
  json_decref(j);
  return fits;
}

/* ---- writing ---- */

/* Both ascending by i, which they have none of in common. */
static bool join_rows(FILE *out, uint64_t *sum, FILE *spool, const tiles_rows *late) {
  tiles_row r;
  size_t k = 0;
  bool fits = true;
  if (spool) rewind(spool);
  while (fits && spool && get_row(&r, spool)) {
    for (; fits && k < late->count && late->item[k].i < r.i; k++) fits = put_row(out, sum, &late->item[k]);
    if (fits) fits = put_row(out, sum, &r);
  }
  for (; fits && k < late->count; k++) fits = put_row(out, sum, &late->item[k]);
  return fits && !(spool && ferror(spool));
}

dyd_status tile_write_part(tile *t, dyd_error *err) {
  tiles_file f;
  char name[32];
  tiles_part_name(name, t->rank);
  for (size_t k = 0; k < t->rows.count; k++) t->counters.count[t->rows.item[k].status]++;
  t->counters.aliases = t->aliases.count;
  if (t->spool && fflush(t->spool) != 0) return spool_fail(t, err);
  dyd_status st = tiles_file_open(&f, t->job->folder, name, err);
  if (st != DYD_OK) return st;
  uint64_t *sum = &t->counters.sum;
  *sum = DYD_DIGEST_BEGIN;
  bool fits = put_json_line(f.stream, sum, header_of(t)) && join_rows(f.stream, sum, t->spool, &t->rows);
  for (size_t k = 0; fits && k < t->aliases.count; k++) fits = put_row(f.stream, sum, &t->aliases.item[k]);
  fits = fits && put_sum(f.stream, *sum);
  st = tiles_file_close(&f, DYD_OK, err);
  if (st == DYD_OK && !fits) st = spool_fail(t, err);
  if (t->spool) fclose(t->spool);
  t->spool = NULL;
  return st;
}

/* ---- finding one that is there ---- */

/* The header of a part; `in` is behind it then. NULL: there is none. */
static json_t *tiles_part_header(FILE *in) {
  json_t *j = json_loadf(in, JSON_DISABLE_EOF_CHECK, NULL);
  if (!j) return NULL;
  rewind(in);
  for (int c = 0; c != '\n' && c != EOF;) c = fgetc(in);
  return j;
}

static uint64_t header_number(const json_t *j, const char *key) {
  return (uint64_t)json_integer_value(json_object_get(j, key));
}

/* Returns true if it is of this rank in this job. Results of the run are not compared. */
static bool suits(const json_t *found, json_t *wanted) {
  static const char *const same[] = {"format", "rank", "own", "ranks", "points", "boxes", "max_pairs", "digest"};
  bool equal = found && wanted;
  for (size_t k = 0; equal && k < sizeof same / sizeof *same; k++)
    equal = json_equal(json_object_get(found, same[k]), json_object_get(wanted, same[k]));
  json_decref(wanted);
  return equal;
}

/* The counters, and the aliases behind the pairs; false: the file is not as long as its header says. */
static bool take_part(tile *t, FILE *in, const json_t *j) {
  tiles_counters *c = &t->counters;
  const off_t body = ftello(in);
  const uint64_t pairs = header_number(j, "pairs"), aliases = header_number(j, "aliases");
  if (fseeko(in, 0, SEEK_END) != 0 || (uint64_t)(ftello(in) - body) != (pairs + aliases) * TILES_RECORD + TILES_SUM)
    return false;
  t->alias = calloc(t->own.count + 1, sizeof *t->alias);
  if (!t->alias || fseeko(in, body + (off_t)(pairs * TILES_RECORD), SEEK_SET) != 0) return false;
  tiles_row r;
  size_t at = 0;
  for (uint64_t k = 0; k < aliases && get_row(&r, in); k++) {
    while (at < t->own.count && t->own.number[at] < r.i) at++;
    if (at < t->own.count && t->own.number[at] == r.i) t->alias[at] = true;
  }
  c->aliases = aliases;
  c->ghosts = header_number(j, "ghosts");
  c->capped = json_is_true(json_object_get(j, "capped"));
  c->count[DYD_LEGAL] = header_number(j, "legal");
  c->count[DYD_INDETERMINATE] = header_number(j, "indeterminate");
  c->count[DYD_TIE] = header_number(j, "tie");
  return true;
}

dyd_status tile_find_part(tile *t, dyd_error *err) {
  char name[32];
  if (!t->job->restart) return DYD_OK;
  tiles_part_name(name, t->rank);
  DYD_FREED char *path = tiles_path(t->job->folder, name);
  if (!path) return tiles_no_memory(err);
  FILE *in = fopen(path, "rb");
  json_t *j = in && tiles_part_sum(&t->counters.sum, in) ? tiles_part_header(in) : NULL;
  if (j) {
    t->done = suits(j, header_of(t)) && take_part(t, in, j);
  }
  json_decref(j);
  if (in) fclose(in);
  return DYD_OK;
}

/* ---- the manifest ---- */

static json_t *part_sum(const tiles_counters *c) {
  char sum[20];
  snprintf(sum, sizeof sum, "%016" PRIx64, c->sum);
  return json_string(sum);
}

static json_t *part_names(const tile *t) {
  json_t *parts = json_array();
  for (size_t r = 0; r < t->job->ranks; r++) {
    char name[32];
    tiles_part_name(name, r);
    json_array_append_new(parts, json_string(name));
  }
  return parts;
}

static const char *outcome_of(const tiles_counters *all) {
  dyd_outcome o = all->capped                                            ? DYD_OUTCOME_BUDGET
                  : all->count[DYD_INDETERMINATE] || all->count[DYD_TIE] ? DYD_OUTCOME_FIXPOINT
                                                                         : DYD_OUTCOME_DECIDED;
  return dyd_outcome_text(o);
}

static void sum_counters(tiles_counters *all, const tiles_counters *c) {
  for (unsigned k = 0; k < 4; k++) all->count[k] += c->count[k];
  all->own += c->own;
  all->ghosts += c->ghosts;
  all->sent += c->sent;
  all->late += c->late;
  all->aliases += c->aliases;
  all->seconds += c->seconds;
  all->capped |= c->capped;
  if (c->rounds > all->rounds) all->rounds = c->rounds;
  if (c->fringe > all->fringe) all->fringe = c->fringe;
}

dyd_status tile_write_manifest(tile *t, dyd_error *err) {
  tiles_counters all = {0}, one;
  json_t *sums = json_array();
  for (size_t r = 0; r < t->job->ranks; r++) {
    size_t read = 0;
    if (!tiles_mail_take(&one, sizeof one, &t->in[r], &read)) continue;
    sum_counters(&all, &one);
    json_array_append_new(sums, part_sum(&one));
  }
  t->counters = all;
  tiles_file f;
  dyd_status st = tiles_file_open(&f, t->job->folder, "manifest.json", err);
  if (st != DYD_OK) {
    json_decref(sums);
    return st;
  }
  json_t *j = json_pack("{sssssIsIsososss{sbsI}sIsIsIsI}", "format", "dyadel tiles 2", "input", t->job->input, "points",
                        (json_int_t)t->points, "ranks", (json_int_t)t->job->ranks, "parts", part_names(t), "sums", sums,
                        "outcome", outcome_of(&all), "options", "boxes", t->job->boxes, "max_pairs",
                        (json_int_t)t->job->max_pairs, "legal", (json_int_t)all.count[DYD_LEGAL], "indeterminate",
                        (json_int_t)all.count[DYD_INDETERMINATE], "tie", (json_int_t)all.count[DYD_TIE], "aliases",
                        (json_int_t)all.aliases);
  bool fits = put_json_line(f.stream, &(uint64_t){0}, j);
  if (!fits)
    st = dyd_fail(err, DYD_E_IO, "%s/manifest.json: cannot write; is the name of the input UTF-8?", t->job->folder);
  return tiles_file_close(&f, st, err);
}

/* ---- parts joined: the csv of `dyadel delaunay` ---- */

/* A part being read: its next record. */
typedef struct part_reader {
  FILE *in;
  uint64_t pairs, aliases; /* left */
  tiles_row row;
} part_reader;

typedef struct part_readers {
  const char *folder;
  size_t count;
  part_reader *item; /* those with pairs left form a heap by i, the first `open` ones */
  size_t open;
  tiles_rows aliases;
} part_readers;

static dyd_status reader_fail(const part_readers *all, const char *name, const char *what, dyd_error *err) {
  return dyd_fail(err, DYD_E_IO, "%s/%s: %s; complete the folder by dyadel-tiles delaunay with --restart", all->folder,
                  name, what);
}

/* Opens the part, whose bytes have the sum given by the manifest. */
static dyd_status reader_open(part_reader *p, const part_readers *all, const char *name, const char *told,
                              dyd_error *err) {
  char sum[20] = "";
  uint64_t found;
  DYD_FREED char *path = tiles_path(all->folder, name);
  p->in = path ? fopen(path, "rb") : NULL;
  if (!p->in) return reader_fail(all, name, strerror(errno), err);
  const bool whole = tiles_part_sum(&found, p->in);
  snprintf(sum, sizeof sum, "%016" PRIx64, found);
  if (!whole || strcmp(sum, told) != 0)
    return reader_fail(all, name, "it was changed since it was written: its digest is another", err);
  json_t *j = tiles_part_header(p->in);
  if (!j) return reader_fail(all, name, "is no part", err);
  p->pairs = (uint64_t)json_integer_value(json_object_get(j, "pairs"));
  p->aliases = (uint64_t)json_integer_value(json_object_get(j, "aliases"));
  json_decref(j);
  return DYD_OK;
}

static dyd_status readers_open(part_readers *all, const json_t *manifest, dyd_error *err) {
  const json_t *parts = json_object_get(manifest, "parts"), *sums = json_object_get(manifest, "sums");
  const char *format = json_string_value(json_object_get(manifest, "format"));
  const size_t count = json_array_size(parts);
  dyd_status st = DYD_OK;
  if (!format || strcmp(format, "dyadel tiles 2") != 0 || !count || json_array_size(sums) != count ||
      json_integer_value(json_object_get(manifest, "ranks")) != (json_int_t)count)
    return reader_fail(all, "manifest.json", "the file is not a manifest of the format \"dyadel tiles 2\"", err);
  all->item = calloc(count, sizeof *all->item);
  if (!all->item) return tiles_no_memory(err);
  for (size_t k = 0; st == DYD_OK && k < count; k++) {
    const char *name = json_string_value(json_array_get(parts, k)), *sum = json_string_value(json_array_get(sums, k));
    st = name && sum ? reader_open(&all->item[all->count++], all, name, sum, err)
                     : reader_fail(all, "manifest.json", "a part has no name or no digest", err);
  }
  return st;
}

/* They follow the pairs. */
static dyd_status reader_aliases(part_readers *all, part_reader *p, dyd_error *err) {
  const off_t body = ftello(p->in);
  if (fseeko(p->in, body + (off_t)(p->pairs * TILES_RECORD), SEEK_SET) != 0) return DYD_E_IO;
  for (; p->aliases > 0; p->aliases--) {
    if (!get_row(&p->row, p->in)) return reader_fail(all, "", "a part is cut short", err);
    dyd_status st = tiles_rows_add(&all->aliases, p->row, err);
    if (st != DYD_OK) return st;
  }
  return fseeko(p->in, body, SEEK_SET) == 0 ? DYD_OK : DYD_E_IO;
}

static dyd_status write_aliases(FILE *out, part_readers *all, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < all->count; k++) st = reader_aliases(all, &all->item[k], err);
  tiles_rows_sort(&all->aliases, 0);
  for (size_t k = 0; st == DYD_OK && k < all->aliases.count; k++)
    fprintf(out, "# alias %" PRIu64 " %" PRIu64 "\n", all->aliases.item[k].i, all->aliases.item[k].j);
  return st;
}

static void reader_sift(part_readers *all, size_t k) {
  part_reader moved = all->item[k];
  for (size_t child; (child = 2 * k + 1) < all->open; k = child) {
    if (child + 1 < all->open && all->item[child + 1].row.i < all->item[child].row.i) child++;
    if (moved.row.i <= all->item[child].row.i) break;
    all->item[k] = all->item[child];
  }
  all->item[k] = moved;
}

static void swap_readers(part_readers *all, size_t a, size_t b) {
  part_reader kept = all->item[a];
  all->item[a] = all->item[b];
  all->item[b] = kept;
}

static dyd_status heap_of_readers(part_readers *all, dyd_error *err) {
  all->open = all->count;
  for (size_t k = 0; k < all->open;) {
    part_reader *p = &all->item[k];
    if (p->pairs == 0)
      swap_readers(all, k, --all->open);
    else if (p->pairs--, get_row(&p->row, p->in))
      k++;
    else
      return reader_fail(all, "", "a part is cut short", err);
  }
  for (size_t k = all->open; k-- > 0;) reader_sift(all, k);
  return DYD_OK;
}

static dyd_status write_part_pairs(FILE *out, part_readers *all, dyd_error *err) {
  dyd_status st = heap_of_readers(all, err);
  while (st == DYD_OK && all->open > 0) {
    part_reader *p = &all->item[0];
    fprintf(out, "%" PRIu64 ",%" PRIu64 ",%s\n", p->row.i, p->row.j,
            dyd_pair_status_text((dyd_pair_status)(p->row.status & 3)));
    if (p->pairs == 0)
      swap_readers(all, 0, --all->open);
    else if (p->pairs--, !get_row(&p->row, p->in))
      st = reader_fail(all, "", "a part is cut short", err);
    reader_sift(all, 0);
  }
  return st;
}

static void readers_close(part_readers *all) {
  for (size_t k = 0; k < all->count; k++)
    if (all->item[k].in) fclose(all->item[k].in);
  dyd_free_all(all->item, all->aliases.item);
}

dyd_status tiles_write_csv(FILE *out, const char *folder, bool comments, dyd_error *err) {
  part_readers all = {.folder = folder};
  DYD_FREED char *path = tiles_path(folder, "manifest.json");
  if (!path) return tiles_no_memory(err);
  json_t *j = json_load_file(path, 0, NULL);
  if (!j) return reader_fail(&all, "manifest.json", "is not there, or none", err);
  dyd_status st = readers_open(&all, j, err);
  if (st == DYD_OK && comments) st = write_aliases(out, &all, err);
  if (st == DYD_OK && fputs("i,j,status\n", out) == EOF) st = DYD_E_IO;
  if (st == DYD_OK) st = write_part_pairs(out, &all, err);
  if (st == DYD_OK && (fflush(out) != 0 || ferror(out)))
    st = dyd_fail(err, DYD_E_IO, "cannot write: %s", strerror(errno));
  readers_close(&all);
  json_decref(j);
  return st;
}
