/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Members that several json formats share. */
#include "io/json_parts.h"

#include "io/decimal.h"
#include <stdlib.h>

void dyd_json_aliases(FILE *out, const dyd_delaunay *pd, size_t count, const char *after) {
  bool any = false;
  fputs("\"aliases\": [", out);
  for (size_t i = 0; i < count; i++) {
    uint32_t of = dyd_delaunay_alias(pd, (uint32_t)i);
    if (of == i) continue;
    fprintf(out, "%s[%zu, %u]", any ? ", " : "", i, (unsigned)of);
    any = true;
  }
  fprintf(out, "]%s", after);
}

dyd_status dyd_json_bound(FILE *out, const char *name, const dyd_dyadic *value) {
  char *exact = dyd_dyadic_get_str(value);
  if (!exact) return DYD_E_NOMEM;
  fprintf(out, "\"%s\": {\"exact\": \"%s\", \"decimal\": ", name, exact);
  dyd_decimal_json(out, dyd_dyadic_get_d(value, DYD_UP), DYD_UP);
  fputs("}", out);
  free(exact);
  return DYD_OK;
}
