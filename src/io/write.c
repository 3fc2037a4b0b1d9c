/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Writes a result in a format chosen by name; what the writers share. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/result.h"
#include <dyadel/io.h>
#include <errno.h>
#include <math.h>
#include <string.h>

static const struct {
  const char *name;
  dyd_write_fn write;
} formats[] = {[DYD_FORMAT_CSV] = {"csv", dyd_write_csv}, [DYD_FORMAT_JSON] = {"json", dyd_write_json},
               [DYD_FORMAT_WKT] = {"wkt", dyd_write_wkt}, [DYD_FORMAT_GEOJSON] = {"geojson", dyd_write_geojson},
               [DYD_FORMAT_OBJ] = {"obj", dyd_write_obj}, [DYD_FORMAT_SVG] = {"svg", dyd_write_svg},
               [DYD_FORMAT_VTK] = {"vtk", dyd_write_vtk}, [DYD_FORMAT_PDF] = {"pdf", dyd_write_pdf},
               [DYD_FORMAT_PNG] = {"png", dyd_write_png}};
#define FORMATS (sizeof formats / sizeof *formats)

bool dyd_format_from_name(dyd_format *out, const char *name) {
  for (size_t k = 0; k < FORMATS; k++) {
    if (strcmp(formats[k].name, name) != 0) continue;
    *out = (dyd_format)k;
    return true;
  }
  return false;
}

const char *dyd_format_name(dyd_format format) {
  return (size_t)format < FORMATS ? formats[format].name : NULL;
}

const char *dyd_pair_status_text(dyd_pair_status status) {
  static const char *const text[] = {
      [DYD_ILLEGAL] = "illegal", [DYD_TIE] = "tie", [DYD_INDETERMINATE] = "indeterminate", [DYD_LEGAL] = "legal"};
  return text[status];
}

dyd_status dyd_result_box(double box[4], const dyd_result *r, size_t i, dyd_error *err) {
  dyd_sites_get_d(box, r->sites, i);
  if (isfinite(box[0]) && isfinite(box[1]) && isfinite(box[2]) && isfinite(box[3])) return DYD_OK;
  if (err) err->point = i;
  return dyd_fail(err, DYD_E_RANGE,
                  "point %zu lies beyond the largest double, which this format cannot show; use csv or json", i);
}

static dyd_status find_place(dyd_place *out, const dyd_result *r, size_t i, dyd_error *err) {
  double box[4], error[2];
  dyd_status status = dyd_result_box(box, r, i, err);
  if (status < 0) return status;
  dyd_decimal_within(out->x, &error[0], box[0], box[1]);
  dyd_decimal_within(out->y, &error[1], box[2], box[3]);
  out->error = fmax(error[0], error[1]);
  return DYD_OK;
}

dyd_status dyd_result_places(dyd_place **out, double *error, const dyd_result *r, dyd_error *err) {
  dyd_place *places = dyd_alloc(r->count, sizeof *places);
  if (!places) return dyd_fail_nomem(err);
  *error = 0;
  dyd_status status = DYD_OK;
  for (size_t i = 0; i < r->count && status >= 0; i++) {
    status = find_place(&places[i], r, i, err);
    if (status >= 0) *error = fmax(*error, places[i].error);
  }
  if (status < 0)
    free(places);
  else
    *out = places;
  return status;
}

dyd_status dyd_write_delaunay(FILE *out, const dyd_engine *e, dyd_format format, dyd_error *err) {
  return dyd_write_delaunay_window(out, e, NULL, format, err);
}

dyd_status dyd_write_delaunay_window(FILE *out, const dyd_engine *e, const dyd_rect *window, dyd_format format,
                                     dyd_error *err) {
  if (err) dyd_error_clear(err);
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  if (!pd) return dyd_fail(err, DYD_E_ARG, "there is no result yet");
  if ((size_t)format >= FORMATS) return dyd_fail(err, DYD_E_ARG, "there is no format number %d", (int)format);
  dyd_result r = {.out = out, .engine = e, .pd = pd, .sites = dyd_delaunay_sites(pd), .window = window};
  r.count = dyd_sites_count(r.sites);
  dyd_status status = dyd_delaunay_pairs(&r.pairs, pd);
  if (status < 0) dyd_fail(err, status, "%s", dyd_status_text(status));
  if (status >= 0) status = formats[format].write(&r, err);
  dyd_pair_list_clear(&r.pairs);
  if (status < 0) return status;
  if (fflush(out) != 0 || ferror(out))
    return dyd_fail(err, DYD_E_IO, "cannot write: %s", strerror(errno ? errno : EIO));
  return DYD_OK;
}
