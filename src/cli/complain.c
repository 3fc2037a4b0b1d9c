/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Messages on standard error. */
#include "cli.h"
#include <stdarg.h>

static void complain_list(const char *format, va_list args) {
  fputs("dyadel: ", stderr);
  vfprintf(stderr, format, args);
  fputs("\n", stderr);
}

void cli_complain(const char *format, ...) {
  va_list args;
  va_start(args, format);
  complain_list(format, args);
  va_end(args);
}

void cli_note(const cli_options *o, const char *format, ...) {
  va_list args;
  va_start(args, format);
  if (!o->quiet) complain_list(format, args);
  va_end(args);
}

int cli_complain_memory(void) {
  cli_complain("memory is exhausted; close other programs");
  return CLI_FAILED;
}

void cli_complain_of(const dyd_engine *e, const char *file, const dyd_error *err) {
  dyd_error own = *err;
  if (own.point != DYD_NO_POINT) own.point = dyd_engine_row(e, own.point);
  cli_complain_at(file, &own);
}

void cli_complain_at(const char *file, const dyd_error *err) {
  char point[40] = "";
  if (err->point != DYD_NO_POINT) snprintf(point, sizeof point, "point %zu: ", err->point);
  if (!file)
    cli_complain("%s%s", point, err->message);
  else if (err->line)
    cli_complain("%s:%zu:%zu: %s%s", file, err->line, err->column, point, err->message);
  else
    cli_complain("%s: %s%s", file, point, err->message);
}
