/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact rectangles as plain text, for programs that cannot read dyd_rect. */
#include "base/error.h"
#include "io/decimal.h"
#include <dyadel/io.h>
#include <stdlib.h>

static dyd_status put_side(FILE *out, const dyd_interval *a, char behind) {
  char *lo = dyd_end_text(a, false), *hi = dyd_end_text(a, true);
  dyd_status st = lo && hi ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) fprintf(out, "%s %s%c", lo, hi, behind);
  free(lo);
  free(hi);
  return st;
}

dyd_status dyd_write_rects(FILE *out, const dyd_sites *sites, size_t first, size_t count, dyd_error *err) {
  if (!sites) return dyd_fail_null(err);
  dyd_rect r;
  dyd_status st = DYD_OK;
  if (first > dyd_sites_count(sites) || count > dyd_sites_count(sites) - first)
    return dyd_fail(err, DYD_E_ARG, "there are %zu points; ask for some of them", dyd_sites_count(sites));
  dyd_rect_init(&r);
  for (size_t i = first; st == DYD_OK && i < first + count; i++) {
    st = dyd_sites_get(&r, sites, i);
    if (st == DYD_OK) st = put_side(out, &r.x, ' ');
    if (st == DYD_OK) st = put_side(out, &r.y, '\n');
  }
  dyd_rect_clear(&r);
  if (st == DYD_OK && ferror(out)) return dyd_fail(err, DYD_E_IO, "writing rectangles failed");
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}
