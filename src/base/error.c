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

dyd_status dyd_fail_nomem(dyd_error *err) {
  return dyd_fail(err, DYD_E_NOMEM, "%s", dyd_status_text(DYD_E_NOMEM));
}

const char *dyd_status_text(dyd_status status) {
  switch (status) {
  case DYD_OK:
    return "done";
  case DYD_FIXED:
    return "the rectangle is final";
  case DYD_CAPPED:
    return "the cap on stored pairs was met";
  case DYD_CANCELLED:
    return "cancelled";
  case DYD_E_NOMEM:
    return "out of memory";
  case DYD_E_ARG:
    return "an argument breaks its contract";
  case DYD_E_RANGE:
    return "a number leaves the exponent range";
  case DYD_E_PARSE:
    return "the text is not of the expected form";
  case DYD_E_DOMAIN:
    return "an expression is undefined up to the precision allowed";
  case DYD_E_NESTING:
    return "a stream gave a rectangle that is not inside its previous one";
  case DYD_E_STREAM:
    return "a stream failed";
  case DYD_E_IO:
    return "reading or writing failed";
  }
  return "unknown status";
}

const char *dyd_version(void) {
  return DYD_VERSION;
}
