/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Messages on standard error. */
#include "cli.h"
#include "table.h"
#include <stdarg.h>
#include <string.h>

/* Returns true if the field of the library's options has an option of the command, and prints that: `max_pairs` is
 * --max-pairs, and `radius_columns`, which may name two, is --radius-column. */
static bool complain_field(FILE *out, const char *field, size_t length) {
  for (const cli_option *o = cli_option_table; o < cli_option_table + cli_option_count; o++) {
    size_t k = 0;
    while (k < length && (field[k] == '_' ? '-' : field[k]) == o->name[k]) k++;
    if (o->name[k] || !(k == length || (k + 1 == length && field[k] == 's'))) continue;
    fprintf(out, "--%s", o->name);
    return true;
  }
  return false;
}

/* Prints a message: the library names fields of its options in backquotes. */
static void complain_print(FILE *out, const char *text) {
  while (*text) {
    size_t plain = strcspn(text, "`"), length;
    fwrite(text, 1, plain, out);
    text += plain;
    if (!*text) return;
    length = strspn(text + 1, "abcdefghijklmnopqrstuvwxyz_");
    if (text[1 + length] == '`' && complain_field(out, text + 1, length)) {
      text += length + 2;
    } else {
      fputc(*text++, out);
    }
  }
}

static void complain_list(const char *format, va_list args) {
  char text[2 * DYD_MESSAGE_SIZE + 8192];
  vsnprintf(text, sizeof text, format, args);
  fputs("dyadel: ", stderr);
  complain_print(stderr, text);
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
