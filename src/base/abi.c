/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Structs that begin with their size. */
#include "base/abi.h"

#include "base/error.h"
#include <stdbool.h>
#include <string.h>

/* A size above this is no size: the struct was never initialised. */
#define MOST_BYTES 65536

static size_t abi_size(const void *theirs) {
  size_t size;
  memcpy(&size, theirs, sizeof size);
  return size;
}

dyd_status dyd_abi_check(const void *theirs, size_t least, const char *type, dyd_error *err) {
  size_t size = abi_size(theirs);
  if (size >= least && size >= sizeof size && size <= MOST_BYTES) return DYD_OK;
  if (err) dyd_error_clear(err);
  return dyd_fail(err, DYD_E_ARG, "struct_size of %s is %zu; begin it with its size: %s s = {DYD_SIZED(%s)}", type,
                  size, type, type);
}

/* Is there nothing but zeros from byte `from` on? */
static bool ends_in_zeros(const void *theirs, size_t from, size_t size) {
  const unsigned char *byte = theirs;
  while (from < size && !byte[from]) from++;
  return from >= size;
}

dyd_status dyd_abi_take(void *own, size_t size, const void *theirs, const char *type, dyd_error *err) {
  memset(own, 0, size);
  memcpy(own, &size, sizeof size);
  if (!theirs) return DYD_OK;
  dyd_status st = dyd_abi_check(theirs, 0, type, err);
  if (st != DYD_OK) return st;
  size_t given = abi_size(theirs);
  if (ends_in_zeros(theirs, size, given)) {
    memcpy(own, theirs, given < size ? given : size);
    memcpy(own, &size, sizeof size);
    return DYD_OK;
  }
  if (err) dyd_error_clear(err);
  return dyd_fail(err, DYD_E_ARG,
                  "%s has members set that dyadel %s does not know; leave them 0, or use a newer dyadel", type,
                  dyd_version());
}

void dyd_abi_give(void *theirs, const void *own, size_t size) {
  size_t room = abi_size(theirs), known = room < size ? room : size;
  if (known <= sizeof room) return;
  memcpy((char *)theirs + sizeof room, (const char *)own + sizeof room, known - sizeof room);
  memset((char *)theirs + known, 0, room - known);
}
