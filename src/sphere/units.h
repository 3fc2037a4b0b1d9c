/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Radii on a sphere: a number with a unit. */
#ifndef DYD_SPHERE_UNITS_H
#define DYD_SPHERE_UNITS_H

#include <dyadel/status.h>
#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

/* Reads "30m", "2km": *ground, and out in metres; "0.01deg", "0.01": in degrees. DYD_E_ARG where it is no exact number
 * >= 0 with such a unit; DYD_E_NOMEM. */
dyd_status dyd_radius_parse(mpq_ptr out, bool *ground, const char *text, size_t length);

#endif
