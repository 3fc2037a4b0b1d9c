/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Files that appear whole or not at all. */
#include "state.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

char *tiles_path(const char *folder, const char *name) {
  size_t size = strlen(folder) + strlen(name) + 2;
  char *path = malloc(size);
  if (path) snprintf(path, size, "%s/%s", folder, name);
  return path;
}

void tiles_part_name(char name[32], size_t rank) {
  snprintf(name, 32, "part-%05zu.bin", rank);
}

static dyd_status file_fail(const tiles_file *f, dyd_error *err) {
  return tiles_fail(
      err, DYD_E_IO,
      "%s: cannot write: %s; make room there, then go on with --restart, or choose another folder with -o", f->name,
      strerror(errno));
}

static void file_clear(tiles_file *f) {
  free(f->name);
  free(f->temporary);
  *f = (tiles_file){0};
}

dyd_status tiles_file_open(tiles_file *f, const char *folder, const char *name, dyd_error *err) {
  char beside[64];
  snprintf(beside, sizeof beside, ".%.40s.new", name);
  *f = (tiles_file){.name = tiles_path(folder, name), .temporary = tiles_path(folder, beside)};
  dyd_status st = f->name && f->temporary ? DYD_OK : tiles_no_memory(err);
  if (st == DYD_OK) f->stream = fopen(f->temporary, "wb");
  if (st == DYD_OK && !f->stream) st = file_fail(f, err);
  if (st != DYD_OK) file_clear(f);
  return st;
}

dyd_status tiles_file_close(tiles_file *f, dyd_status st, dyd_error *err) {
  if (!f->stream) return st;
  bool kept = fflush(f->stream) == 0 && !ferror(f->stream) && fsync(fileno(f->stream)) == 0;
  if (!kept && st == DYD_OK) st = file_fail(f, err);
  kept = fclose(f->stream) == 0;
  if (st == DYD_OK && (!kept || rename(f->temporary, f->name) != 0)) st = file_fail(f, err);
  if (st != DYD_OK) unlink(f->temporary);
  file_clear(f);
  return st;
}
