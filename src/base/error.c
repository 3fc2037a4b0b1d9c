/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Status texts and error records. */
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

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

dyd_status dyd_fail_room(dyd_error *err, const dyd_room *room) {
  return dyd_fail(
      err, DYD_E_NOMEM,
      "%s would bring memory to about %llu bytes, and max_bytes leaves %llu; raise it, or ask for less: fewer "
      "points, narrower rectangles, fewer bits",
      room->refused, (unsigned long long)room->wanted, (unsigned long long)room->most);
}
