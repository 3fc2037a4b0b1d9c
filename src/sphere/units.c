/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Radii on a sphere: a number with a unit. */
#include "sphere/units.h"

#include "base/error.h"
#include <dyadel/stream.h>
#include <string.h>

/* A name that ends like another one comes first. */
static const dyd_unit units[] = {{"arcmin", "arcminute", NULL, false, 1, 60},
                                 {"arcsec", "arcsecond", NULL, false, 1, 3600},
                                 {"deg", "degree", NULL, false, 1, 1},
                                 {"km", "kilometer", "kilometre", true, 1000, 1},
                                 {"cm", "centimeter", "centimetre", true, 1, 100},
                                 {"mm", "millimeter", "millimetre", true, 1, 1000},
                                 {"m", "meter", "metre", true, 1, 1},
                                 {"ft", "feet", "foot", true, 381, 1250},
                                 {"in", "inch", NULL, true, 127, 5000}};
enum { UNITS = sizeof units / sizeof *units };

const dyd_unit *dyd_unit_find(const char *name, size_t length) {
  for (size_t u = 0; u < UNITS; u++)
    if (strlen(units[u].name) == length && !memcmp(units[u].name, name, length)) return &units[u];
  return NULL;
}

static bool unit_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/* Returns true if the text ends with `end`, in any case but for its first letter where that is a capital. */
static bool ends_like(const char *text, size_t length, const char *end) {
  size_t n = strlen(end);
  if (n > length) return false;
  for (size_t k = 0; k < n; k++) {
    char c = text[length - n + k];
    if (c != end[k] && (c | 0x20) != end[k]) return false;
  }
  return true;
}

/* Returns true for a name such as "uncertaintyInMeters" or "accuracy in metres". */
static bool is_in_words(const char *name, size_t length, const char *word) {
  if (!word) return false;
  length -= length && (name[length - 1] | 0x20) == 's';
  if (word[strlen(word) - 1] == 'h') length -= length && (name[length - 1] | 0x20) == 'e'; /* inches */
  if (!ends_like(name, length, word)) return false;
  for (length -= strlen(word); length && !unit_letter(name[length - 1]); length--) continue;
  return length >= 2 && ends_like(name, length, "in") &&
         (length == 2 || name[length - 2] == 'I' || !unit_letter(name[length - 3]));
}

const dyd_unit *dyd_unit_of_column(const char *name, size_t length) {
  while (length && name[length - 1] == ' ') length--;
  char open = !length ? 0 : name[length - 1] == ')' ? '(' : name[length - 1] == ']' ? '[' : 0;
  for (size_t k = length; open && k-- > 0;)
    if (name[k] == open) return dyd_unit_find(name + k + 1, length - k - 2);
  for (size_t u = 0; u < UNITS; u++)
    if (is_in_words(name, length, units[u].word) || is_in_words(name, length, units[u].other)) return &units[u];
  return NULL;
}

dyd_status dyd_unit_take(const dyd_unit **unit, mpq_ptr scale, const char *name, const char *factor, dyd_error *err) {
  const dyd_unit *found = name ? dyd_unit_find(name, strlen(name)) : NULL;
  if (name && !found)
    return dyd_fail(err, DYD_E_ARG, "\"%.40s\" is not a unit of radii; give one of " DYD_UNIT_NAMES, name);
  if (found) *unit = found;
  dyd_status st = factor ? dyd_real_parse_exact(scale, factor, strlen(factor)) : DYD_OK;
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st == DYD_OK && (!factor || mpq_sgn(scale) > 0)) return DYD_OK;
  return dyd_fail(err, DYD_E_ARG, "the scale of radii \"%.40s\" is not an exact number above 0; give one such as 0.001",
                  factor);
}

/* Returns the unit at the end of the text and takes it, and blanks before it, off *length. */
static const dyd_unit *take_unit(const char *text, size_t *length) {
  for (size_t u = 0; u < UNITS; u++) {
    size_t name = strlen(units[u].name);
    if (name > *length || memcmp(text + *length - name, units[u].name, name) != 0) continue;
    for (*length -= name; *length && text[*length - 1] == ' ';) --*length;
    return &units[u];
  }
  return NULL;
}

dyd_status dyd_radius_parse(mpq_ptr out, bool *ground, const char *text, size_t length, const dyd_unit *unit) {
  const dyd_unit *own = take_unit(text, &length);
  dyd_status st = dyd_real_parse_exact(out, text, length);
  if (st == DYD_E_NOMEM) return st;
  if (st != DYD_OK || mpq_sgn(out) < 0) return DYD_E_ARG;
  *ground = false;
  if (!own) own = unit;
  if (!own) return mpq_sgn(out) ? DYD_E_DOMAIN : DYD_OK;
  *ground = own->ground;
  mpz_mul_ui(mpq_numref(out), mpq_numref(out), own->num);
  mpz_mul_ui(mpq_denref(out), mpq_denref(out), own->den);
  mpq_canonicalize(out);
  return DYD_OK;
}
