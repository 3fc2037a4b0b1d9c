/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Parts joined: the csv of `dyadel delaunay`. */
#include "state.h"

#include <errno.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

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

static bool reader_next(part_reader *p) {
  unsigned char bytes[TILES_RECORD];
  if (fread(bytes, sizeof bytes, 1, p->in) != 1) return false;
  p->row = tiles_row_decode(bytes);
  return true;
}

static dyd_status reader_fail(const part_readers *all, const char *name, const char *what, dyd_error *err) {
  return tiles_fail(err, DYD_E_IO, "%s/%s: %s; complete the folder by dyadel-tiles delaunay with --restart",
                    all->folder, name, what);
}

/* Opens the part, whose bytes have the sum that the manifest tells. */
static dyd_status reader_open(part_reader *p, const part_readers *all, const char *name, const char *told,
                              dyd_error *err) {
  char sum[20] = "";
  uint64_t found;
  char *path = tiles_path(all->folder, name);
  p->in = path ? fopen(path, "rb") : NULL;
  free(path);
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
    return reader_fail(all, "manifest.json", "this is no manifest of the format \"dyadel tiles 2\"", err);
  all->item = calloc(count, sizeof *all->item);
  if (!all->item) return tiles_no_memory(err);
  for (size_t k = 0; st == DYD_OK && k < count; k++) {
    const char *name = json_string_value(json_array_get(parts, k)), *sum = json_string_value(json_array_get(sums, k));
    st = name && sum ? reader_open(&all->item[all->count++], all, name, sum, err)
                     : reader_fail(all, "manifest.json", "a part has no name or no digest", err);
  }
  return st;
}

/* ---- aliases ---- */

static int compare_aliases(const void *a, const void *b) {
  const tiles_row *p = a, *q = b;
  return (p->i > q->i) - (p->i < q->i);
}

/* They stand behind the pairs. */
static dyd_status reader_aliases(part_readers *all, part_reader *p, dyd_error *err) {
  const off_t body = ftello(p->in);
  if (fseeko(p->in, body + (off_t)(p->pairs * TILES_RECORD), SEEK_SET) != 0) return DYD_E_IO;
  for (; p->aliases > 0; p->aliases--) {
    if (!reader_next(p)) return reader_fail(all, "", "a part is cut short", err);
    tiles_rows *a = &all->aliases;
    if (!tiles_reserve((void **)&a->item, &a->room, a->count + 1, sizeof *a->item)) return tiles_no_memory(err);
    a->item[a->count++] = p->row;
  }
  return fseeko(p->in, body, SEEK_SET) == 0 ? DYD_OK : DYD_E_IO;
}

static dyd_status write_aliases(FILE *out, part_readers *all, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < all->count; k++) st = reader_aliases(all, &all->item[k], err);
  if (all->aliases.count) qsort(all->aliases.item, all->aliases.count, sizeof *all->aliases.item, compare_aliases);
  for (size_t k = 0; st == DYD_OK && k < all->aliases.count; k++)
    fprintf(out, "# alias %" PRIu64 " %" PRIu64 "\n", all->aliases.item[k].i, all->aliases.item[k].j);
  return st;
}

/* ---- pairs ---- */

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
    else if (p->pairs--, reader_next(p))
      k++;
    else
      return reader_fail(all, "", "a part is cut short", err);
  }
  for (size_t k = all->open; k-- > 0;) reader_sift(all, k);
  return DYD_OK;
}

static dyd_status write_part_pairs(FILE *out, part_readers *all, dyd_error *err) {
  static const char *const word[] = {"illegal", "tie", "indeterminate", "legal"};
  dyd_status st = heap_of_readers(all, err);
  while (st == DYD_OK && all->open > 0) {
    part_reader *p = &all->item[0];
    fprintf(out, "%" PRIu64 ",%" PRIu64 ",%s\n", p->row.i, p->row.j, word[p->row.status & 3]);
    if (p->pairs == 0)
      swap_readers(all, 0, --all->open);
    else if (p->pairs--, !reader_next(p))
      st = reader_fail(all, "", "a part is cut short", err);
    reader_sift(all, 0);
  }
  return st;
}

static void readers_close(part_readers *all) {
  for (size_t k = 0; k < all->count; k++)
    if (all->item[k].in) fclose(all->item[k].in);
  free(all->item);
  free(all->aliases.item);
}

dyd_status tiles_write_csv(FILE *out, const char *folder, dyd_error *err) {
  part_readers all = {.folder = folder};
  char *path = tiles_path(folder, "manifest.json");
  if (!path) return tiles_no_memory(err);
  json_t *j = json_load_file(path, 0, NULL);
  free(path);
  if (!j) return reader_fail(&all, "manifest.json", "is not there, or none", err);
  dyd_status st = readers_open(&all, j, err);
  if (st == DYD_OK) st = write_aliases(out, &all, err);
  if (st == DYD_OK && fputs("i,j,status\n", out) == EOF) st = DYD_E_IO;
  if (st == DYD_OK) st = write_part_pairs(out, &all, err);
  if (st == DYD_OK && (fflush(out) != 0 || ferror(out)))
    st = tiles_fail(err, DYD_E_IO, "cannot write: %s", strerror(errno));
  readers_close(&all);
  json_decref(j);
  return st;
}
