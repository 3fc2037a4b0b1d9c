/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Filling in error records. */
#ifndef DYD_BASE_ERROR_H
#define DYD_BASE_ERROR_H

#include "base/memory.h"
#include <dyadel/status.h>
#include <stdbool.h>

/* Writes code and the formatted message to *err (NULL: nothing), leaves point, stage, line and column as they
 * are, cuts over-long messages, and returns code: `return dyd_fail(err, DYD_E_ARG, "...")`. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
dyd_status
dyd_fail(dyd_error *err, dyd_status code, const char *format, ...);

/* st < 0, for calls that may return a positive code. */
static inline bool dyd_failed(dyd_status st) {
  return st < 0;
}

/* DYD_E_ARG: NULL was given for an object, or for a result that does not exist yet. Clears *err before. */
dyd_status dyd_fail_null(dyd_error *err);
/* DYD_E_NOMEM with its standard sentence. */
dyd_status dyd_fail_nomem(dyd_error *err);
/* DYD_E_NOMEM with what the room, which has refused something, was asked for. */
dyd_status dyd_fail_memory(dyd_error *err, const dyd_memory *memory);

#endif
