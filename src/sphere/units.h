/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Radii on a sphere: a number with a unit. */
#ifndef DYD_SPHERE_UNITS_H
#define DYD_SPHERE_UNITS_H

#include <dyadel/status.h>
#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

/* A unit of lengths on the ground, or of angles: `num` / `den` metres, or degrees. */
typedef struct dyd_unit {
  const char *name, *word, *other; /* "m", "meter", "metre"; NULL: no other spelling */
  bool ground;
  unsigned long num, den;
} dyd_unit;

/* The names of all units, as a message lists them. */
#define DYD_UNIT_NAMES "m, mm, cm, km, ft, in, deg, arcmin or arcsec"

/* Returns the unit of this name, such as "km"; NULL where there is none. */
const dyd_unit *dyd_unit_find(const char *name, size_t length);
/* Returns the unit that the name of a column states, such as "sde(m)", "s [mm]" or "accuracyInMeters"; NULL where it
 * states none. */
const dyd_unit *dyd_unit_of_column(const char *name, size_t length);

/* Sets *unit to that of this name (NULL: leaves it) and scale to an exact number above 0 (NULL: leaves it). Returns
 * DYD_E_ARG with a message where they are not such; DYD_E_NOMEM. */
dyd_status dyd_unit_take(const dyd_unit **unit, mpq_ptr scale, const char *name, const char *factor, dyd_error *err);
/* Reads "30m", "2 km": *ground, and out in metres; "0.01deg": in degrees. A number alone is in `unit`. Returns
 * DYD_E_ARG where it is no exact number >= 0 with a unit; DYD_E_DOMAIN where it is above 0, has no unit, and `unit` is
 * NULL; DYD_E_NOMEM. */
dyd_status dyd_radius_parse(mpq_ptr out, bool *ground, const char *text, size_t length, const dyd_unit *unit);

#endif
