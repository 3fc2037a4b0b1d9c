/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Radii on a sphere: a number with a unit. */
#include "sphere/units.h"

#include <dyadel/stream.h>
#include <string.h>

static const struct {
  const char *name;
  bool ground;
  unsigned long size;
} units[] = {{"km", true, 1000}, {"deg", false, 1}, {"m", true, 1}, {"", false, 1}};

dyd_status dyd_radius_parse(mpq_ptr out, bool *ground, const char *text, size_t length) {
  size_t u = 0, name;
  for (; name = strlen(units[u].name), name > length || memcmp(text + length - name, units[u].name, name) != 0;) u++;
  dyd_status st = dyd_real_parse_exact(out, text, length - name);
  if (st == DYD_E_NOMEM) return st;
  if (st != DYD_OK || mpq_sgn(out) < 0) return DYD_E_ARG;
  *ground = units[u].ground;
  mpz_mul_ui(mpq_numref(out), mpq_numref(out), units[u].size);
  mpq_canonicalize(out);
  return DYD_OK;
}
