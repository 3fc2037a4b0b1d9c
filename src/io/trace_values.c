/* SPDX-License-Identifier: LGPL-3.0-or-later */
#include "io/trace_values.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

uint64_t dyd_trace_sum(uint64_t sum, const char *text, size_t length) {
  for (size_t k = 0; k < length; k++) sum = (sum ^ (unsigned char)text[k]) * 1099511628211u;
  return sum;
}

bool dyd_trace_is_sealed(uint64_t *sum, const char *text, size_t length) {
  enum { SEAL = sizeof ",\"sum\":\"0123456789abcdef\"}" - 1 };
  char seal[SEAL + 1];
  if (length < SEAL) return false;
  *sum = dyd_trace_sum(*sum, text, length - SEAL);
  snprintf(seal, sizeof seal, ",\"sum\":\"%016" PRIx64 "\"}", *sum);
  return memcmp(text + length - SEAL, seal, SEAL) == 0;
}

bool dyd_trace_integer(int64_t *out, const json_t *line, const char *name, int64_t least, int64_t most) {
  const json_t *value = json_object_get(line, name);
  if (!json_is_integer(value)) return false;
  *out = json_integer_value(value);
  return *out >= least && *out <= most;
}

bool dyd_trace_has_text(const json_t *line, const char *name, const char *wanted) {
  const char *text = json_string_value(json_object_get(line, name));
  return text && strcmp(text, wanted) == 0;
}

bool dyd_trace_ends(dyd_interval *out, const json_t *list, size_t from) {
  const char *lo = json_string_value(json_array_get(list, from)),
             *hi = json_string_value(json_array_get(list, from + 1));
  dyd_dyadic a, b;
  dyd_dyadic_init(&a);
  dyd_dyadic_init(&b);
  bool good = lo && hi && dyd_dyadic_set_str(&a, lo, NULL) == DYD_OK && dyd_dyadic_set_str(&b, hi, NULL) == DYD_OK &&
              dyd_interval_set_ends(out, &a, &b) == DYD_OK;
  dyd_dyadic_clear(&b);
  dyd_dyadic_clear(&a);
  return good;
}

bool dyd_trace_side(dyd_interval *out, const json_t *line, const char *name) {
  const json_t *side = json_object_get(line, name);
  const char *lo = json_string_value(json_array_get(side, 0)), *hi = json_string_value(json_array_get(side, 1));
  if (!lo || !hi || json_array_size(side) != 2) return false;
  if (strcmp(lo, hi) == 0) /* any form of an exact number */
    return dyd_interval_set_text(out, lo, strlen(lo), NULL) == DYD_OK && dyd_interval_is_point(out);
  return dyd_trace_ends(out, side, 0);
}
