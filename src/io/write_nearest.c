/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The answer to a nearest-site query: csv, json, pictures. */
#include "base/abi.h"
#include "base/error.h"
#include "io/decimal.h"
#include "io/json_parts.h"
#include "io/pieces.h"
#include "picture/picture.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char *status_text(const dyd_nearest_answer *a) {
  return a->sure ? "sure" : "possible";
}

static dyd_status write_interval(FILE *out, const char *name, const dyd_interval *a) {
  char *lo = dyd_end_text(a, false), *hi = dyd_end_text(a, true);
  dyd_status status = lo && hi ? DYD_OK : DYD_E_NOMEM;
  if (status >= 0) fprintf(out, "\"%s\": [\"%s\", \"%s\"],\n", name, lo, hi);
  free(hi);
  free(lo);
  return status;
}

static dyd_status write_json(FILE *out, const dyd_delaunay *pd, const dyd_nearest_answer *a) {
  fprintf(out, "{\"format\": \"dyadel nearest 1\",\n\"version\": \"%s\",\n\"outcome\": \"%s\",\n", dyd_version(),
          dyd_outcome_text(a->outcome));
  dyd_status status = write_interval(out, "x", &a->at->x);
  if (status >= 0) status = write_interval(out, "y", &a->at->y);
  fputs("\"nearest\": [", out);
  for (size_t k = 0; k < a->found->count; k++)
    fprintf(out, "%s\n{\"i\": %u, \"status\": \"%s\"}", k ? "," : "", (unsigned)a->found->item[k], status_text(a));
  fputs("\n],\n", out);
  dyd_json_aliases(out, pd, dyd_sites_count(dyd_delaunay_sites(pd)), "}\n");
  return status;
}

static void write_csv(FILE *out, const dyd_delaunay *pd, const dyd_nearest_answer *a) {
  for (size_t i = 0; i < dyd_sites_count(dyd_delaunay_sites(pd)); i++) {
    uint32_t of = dyd_delaunay_alias(pd, (uint32_t)i);
    if (of != i) fprintf(out, "# alias %zu %u\n", i, (unsigned)of);
  }
  fputs("i,status\n", out);
  for (size_t k = 0; k < a->found->count; k++) fprintf(out, "%u,%s\n", (unsigned)a->found->item[k], status_text(a));
}

dyd_status dyd_write_nearest(FILE *out, const dyd_engine *e, const dyd_nearest_answer *answer, dyd_format format,
                             dyd_error *err) {
  if (err) dyd_error_clear(err);
  dyd_nearest_answer a;
  dyd_status status = dyd_abi_take(&a, sizeof a, answer, "dyd_nearest_answer", err);
  if (status != DYD_OK) return status;
  if (!a.at || !a.found) return dyd_fail(err, DYD_E_ARG, "there is no answer to be written");
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  if (!pd) return dyd_fail(err, DYD_E_ARG, "there is no result yet");
  if (dyd_format_is_picture(format)) return dyd_picture_nearest(out, format, pd, &a, err);
  if (format != DYD_FORMAT_CSV && format != DYD_FORMAT_JSON)
    return dyd_fail(err, DYD_E_ARG, "nearest points are written as csv, json, svg, pdf or png");
  if (format == DYD_FORMAT_JSON)
    status = write_json(out, pd, &a);
  else
    write_csv(out, pd, &a);
  if (status < 0) return dyd_fail(err, status, "%s", dyd_status_text(status));
  if (fflush(out) != 0 || ferror(out))
    return dyd_fail(err, DYD_E_IO, "cannot write: %s", strerror(errno ? errno : EIO));
  return DYD_OK;
}
