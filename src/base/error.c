/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Status texts and error records. */
#include "base/error.h"

#include "base/abi.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* ---- structs that begin with their size ---- */

/* Larger sizes come from structs that were never initialised. */
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

/* Returns true if all bytes from `from` on are zero. */
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

void dyd_error_clear(dyd_error *err) {
  memset(err, 0, sizeof *err);
  err->point = DYD_NO_POINT;
}

dyd_status dyd_fail(dyd_error *err, dyd_status code, const char *format, ...) {
  if (err) {
    va_list args;
    va_start(args, format);
    err->code = code;
    vsnprintf(err->message, sizeof err->message, format, args);
    va_end(args);
  }
  return code;
}

dyd_status dyd_error_set(dyd_error *err, dyd_status code, const char *message) {
  return dyd_fail(err, code, "%s", message);
}

dyd_status dyd_fail_null(dyd_error *err) {
  if (err) dyd_error_clear(err);
  return dyd_fail(err, DYD_E_ARG, "NULL was given for an object, or for a result that does not exist yet");
}

dyd_status dyd_fail_nomem(dyd_error *err) {
  return dyd_fail(err, DYD_E_NOMEM, "%s", dyd_status_text(DYD_E_NOMEM));
}

const char *dyd_status_text(dyd_status status) {
  static const char *const text[] = {
      [DYD_OK - DYD_E_CONTRADICTION] = "done",
      [DYD_FIXED - DYD_E_CONTRADICTION] = "the rectangle is final",
      [DYD_CAPPED - DYD_E_CONTRADICTION] = "the cap on stored pairs was met",
      [DYD_CANCELLED - DYD_E_CONTRADICTION] = "cancelled",
      [DYD_E_NOMEM - DYD_E_CONTRADICTION] = "out of memory",
      [DYD_E_ARG - DYD_E_CONTRADICTION] = "an argument breaks its contract",
      [DYD_E_RANGE - DYD_E_CONTRADICTION] = "a number leaves the exponent range",
      [DYD_E_PARSE - DYD_E_CONTRADICTION] = "the text is not of the expected form",
      [DYD_E_DOMAIN - DYD_E_CONTRADICTION] = "an expression is undefined up to the precision allowed",
      [DYD_E_NESTING - DYD_E_CONTRADICTION] = "a stream gave a rectangle that is not inside its previous one",
      [DYD_E_STREAM - DYD_E_CONTRADICTION] = "a stream failed",
      [DYD_E_IO - DYD_E_CONTRADICTION] = "reading or writing failed",
      [DYD_E_CONTRADICTION - DYD_E_CONTRADICTION] = "two measurements of a point have nothing in common"};
  return status >= DYD_E_CONTRADICTION && status <= DYD_CANCELLED ? text[status - DYD_E_CONTRADICTION]
                                                                  : "unknown status";
}

const char *dyd_version(void) {
  return DYD_VERSION;
}

dyd_status dyd_fail_memory(dyd_error *err, const dyd_memory *memory) {
  return dyd_fail(
      err, DYD_E_NOMEM,
      "%s would bring memory to about %llu bytes, and `max_bytes` leaves %llu; raise it, or ask for less: fewer "
      "points, narrower rectangles, fewer bits",
      memory->refused, (unsigned long long)memory->wanted, (unsigned long long)memory->most);
}
