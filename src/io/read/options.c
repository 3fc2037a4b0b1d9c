/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of reading options. */
#include "io/read/csv.h"

#include <string.h>

#define OF(field) sizeof(dyd_read_field), #field, offsetof(dyd_read_options, field)

static const dyd_read_option read_option[] = {
    {{OF(columns), .points = true, .text = true}, DYD_CSV_X, 2, 2, "coordinate"},
    {.field = {OF(measured), .flag = true, .points = true, .text = true}},
    {.field = {OF(radius), .points = true, .text = true}},
    {.field = {OF(radius_unit), .points = true, .text = true}},
    {.field = {OF(radius_scale), .points = true, .text = true}},
    {{OF(id), .table = true, .text = true}, DYD_ROLE_ID, 1, 1, "identifier"},
    {.field = {OF(carry), .table = true, .text = true}},
    {{OF(radius_columns), .table = true, .points = true, .text = true}, DYD_CSV_RADIUS_X, 1, 2, "radius"},
    {{OF(cost_column), .table = true, .text = true}, DYD_ROLE_NUMBER + DYD_ROW_COST, 1, 1, "cost"},
    {{OF(sigma_column), .table = true, .points = true, .text = true}, DYD_ROLE_SIGMA, 1, 3, "standard deviation"},
    {.field = {OF(confidence), .table = true, .points = true, .text = true}},
    {.field = {OF(round), .flag = true, .points = true}},
    {.field = {OF(delimiter), .table = true, .points = true, .text = true}},
    {.field = {OF(decimal_comma), .flag = true, .points = true, .text = true}},
    {.field = {OF(no_header), .flag = true, .table = true, .points = true, .text = true}},
    {.field = {OF(units_row), .flag = true, .table = true, .points = true, .text = true}},
    {.field = {OF(skip_lines), .points = true, .text = true}},
    {.field = {OF(thousands), .table = true, .points = true, .text = true}},
    {.field = {OF(missing), .points = true, .text = true}},
    {.field = {OF(skip_missing), .flag = true, .points = true, .text = true}},
    {.field = {OF(merge), .flag = true, .points = true, .text = true}},
    {.field = {OF(merge_by), .table = true, .points = true, .text = true}},
    {.field = {OF(degrees), .flag = true, .points = true}},
    {.field = {OF(keep_radii), .flag = true, .points = true}},
};

enum { READ_OPTIONS = sizeof read_option / sizeof *read_option };

/* The text at the field; NULL where options are older than it, or do not set it. */
static const char *field_value(const dyd_read_options *o, const dyd_read_field *f) {
  if (!o || f->offset + (f->flag ? sizeof(bool) : sizeof(char *)) > o->struct_size) return NULL;
  const char *at = (const char *)o + f->offset, *value;
  if (f->flag) return *(const bool *)at ? "true" : NULL;
  memcpy(&value, at, sizeof value);
  return value;
}

const dyd_read_option *dyd_read_option_at(const char **value, const dyd_read_options *options, size_t k) {
  const dyd_read_option *option = k < READ_OPTIONS ? &read_option[k] : NULL;
  if (value) *value = option ? field_value(options, &option->field) : NULL;
  return option;
}

const dyd_read_field *dyd_read_field_at(const char **value, const dyd_read_options *options, size_t k) {
  const dyd_read_option *option = dyd_read_option_at(value, options, k);
  return option ? &option->field : NULL;
}

const char *dyd_role_holds(int role) {
  if (role == DYD_ROLE_RHO) return "correlation";
  const dyd_read_option *option = read_option;
  while (role < option->role || role >= option->role + (int)option->most) option++;
  return option->holds;
}
