/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A file of a stranger that GDAL reads: its features, as rows that the reader of tables takes. */
#include "cli/cli.h"
#include "targets.h"

#include <stdlib.h>
#include <unistd.h>

static char name[] = "/tmp/dyadel-fuzz-XXXXXX";

static void remove_file(void) {
  unlink(name);
}

/* The file, with these bytes; messages of the command go nowhere, those of sanitizers have a way of their own. */
static void file_write(const uint8_t *data, size_t size) {
  static bool begun;
  if (!begun) {
    int fd = mkstemp(name);
    if (fd < 0 || close(fd) != 0 || atexit(remove_file) != 0) abort();
    stderr = fopen("/dev/null", "w");
    begun = true;
  }
  FILE *out = fopen(name, "wb");
  if (!out || fwrite(data, 1, size, out) != size || fclose(out) != 0) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  cli_options o = {.file = name, .quiet = true, .plane = true, .read = {DYD_SIZED(dyd_read_options)}};
  dyd_engine *e = NULL;
  FILE *in;
  file_write(data, size);
  if (size % 2) o.read.carry = "all";
  if (size % 3 == 0) o.read.id = "name";
  if (size % 5 == 0) o.read.radius_columns = "r", o.read.skip_missing = true;
  if (dyd_engine_new(&e) != DYD_OK) abort();
  if (cli_gdal_here->open(&in, name, &o) == 0) {
    dyd_error err;
    dyd_status st = dyd_read_points(e, in, &o.read, &err);
    if (st < 0 && (err.code != st || !err.message[0] || dyd_engine_count(e))) abort();
    cli_gdal_here->close(in, name);
  }
  dyd_engine_free(e);
  return 0;
}
