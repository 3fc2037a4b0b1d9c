/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The life of a partial Delaunay triangulation: made, brought up to date, freed. */
#include <dyadel/delaunay.h>

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "delaunay/build.h"
#include "delaunay/faces.h"
#include "delaunay/line.h"
#include "delaunay/update.h"

#include <string.h>

/* Links between pairs are 32-bit numbers, two for each. */
#define MOST_PAIRS ((size_t)1 << 30)

static void set_options(dyd_delaunay *pd, const dyd_delaunay_options *options) {
  pd->options = *options;
  pd->max_pairs = pd->options.max_pairs ? pd->options.max_pairs : 4000000 + 16 * (size_t)pd->n;
  if (pd->max_pairs > MOST_PAIRS) pd->max_pairs = MOST_PAIRS;
}

static dyd_status finish(dyd_delaunay *pd, dyd_status st, dyd_error *err) {
  pd->options.cancel = NULL;
  pd->err = NULL;
  if (st == DYD_OK) return dyd_delaunay_is_capped(pd) ? DYD_CAPPED : DYD_OK;
  return dyd_fail(err, st, "%s", dyd_status_text(st));
}

dyd_status dyd_delaunay_new(dyd_delaunay **out, const dyd_sites *sites, const dyd_delaunay_options *options,
                            dyd_error *err) {
  dyd_delaunay_options o;
  *out = NULL;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_delaunay_options", err) != DYD_OK) return DYD_E_ARG;
  if (dyd_sites_count(sites) > DYD_MAX_SITES) return dyd_fail(err, DYD_E_RANGE, "too many sites");
  dyd_delaunay *pd = calloc(1, sizeof *pd);
  if (!pd) return dyd_fail_nomem(err);
  pd->sites = sites;
  pd->n = (uint32_t)dyd_sites_count(sites);
  pd->err = err;
  set_options(pd, &o);
  dyd_status st = finish(pd, dyd_build(pd, (dyd_known){NULL, 0}), err);
  if (st < 0 || st == DYD_CANCELLED)
    free(pd);
  else
    *out = pd;
  return st;
}

void dyd_delaunay_free(dyd_delaunay *pd) {
  if (!pd) return;
  dyd_build_clear(pd);
  free(pd);
}

dyd_status dyd_delaunay_update(dyd_delaunay *pd, const uint32_t *changed, size_t count,
                               const dyd_delaunay_options *options, dyd_error *err) {
  dyd_delaunay_options o;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_delaunay_options", err) != DYD_OK) return DYD_E_ARG;
  for (size_t q = 0; q < count; q++)
    if (changed[q] >= pd->n) return dyd_fail(err, DYD_E_ARG, "site %u does not exist", changed[q]);
  if (dyd_sites_count(pd->sites) != pd->n) return dyd_fail(err, DYD_E_ARG, "sites were added after the triangulation");
  pd->err = err;
  set_options(pd, &o);
  return finish(pd, dyd_update(pd, changed, count), err);
}

bool dyd_delaunay_is_capped(const dyd_delaunay *pd) {
  if (pd->line.capped) return true;
  for (size_t f = 0; f < pd->faces.count; f++)
    if (dyd_face_is_capped(pd, f)) return true;
  return false;
}
