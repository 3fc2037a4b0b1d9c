/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The life of a partial Delaunay triangulation: made, brought up to date, freed. */
#include <dyadel/delaunay.h>

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/float_filter.h"
#include "delaunay/build.h"
#include "delaunay/update.h"

#include <string.h>

/* Links between pairs are 32-bit numbers, two for each. */
#define MOST_PAIRS ((size_t)1 << 30)

static void set_options(dyd_delaunay *pd, const dyd_delaunay_options *options, size_t n) {
  pd->options = *options;
  pd->room = (dyd_room){.most = options->max_bytes, .held = sizeof *pd};
  pd->max_pairs = pd->options.max_pairs ? pd->options.max_pairs : 4000000 + 16 * n;
  if (pd->max_pairs > MOST_PAIRS) pd->max_pairs = MOST_PAIRS;
}

static dyd_status finish(dyd_delaunay *pd, dyd_status st, dyd_error *err) {
  pd->options.cancel = NULL;
  pd->options.prove = NULL;
  pd->options.narrows = NULL;
  if (pd->room.peak > pd->counters.bytes_most) pd->counters.bytes_most = pd->room.peak;
  if (st == DYD_E_NOMEM && pd->room.refused) return dyd_fail_room(err, &pd->room);
  if (st == DYD_OK) return dyd_delaunay_is_capped(pd) ? DYD_CAPPED : DYD_OK;
  return dyd_fail(err, st, "%s", dyd_status_text(st));
}

dyd_status dyd_delaunay_new(dyd_delaunay **out, const dyd_sites *sites, const dyd_delaunay_options *options,
                            dyd_error *err) {
  dyd_delaunay_options o;
  *out = NULL;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_delaunay_options", err) != DYD_OK) return DYD_E_ARG;
  if (dyd_float_check(err) != DYD_OK) return DYD_E_ARG;
  if (dyd_sites_count(sites) > DYD_MAX_SITES) return dyd_fail(err, DYD_E_RANGE, "too many sites");
  dyd_delaunay *pd = calloc(1, sizeof *pd);
  if (!pd) return dyd_fail_nomem(err);
  set_options(pd, &o, dyd_sites_count(sites));
  dyd_status st = finish(pd, dyd_build(pd, sites, (dyd_known){NULL, 0}, err), err);
  if (dyd_failed(st) || st == DYD_CANCELLED)
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
  if (dyd_float_check(err) != DYD_OK) return DYD_E_ARG;
  for (size_t q = 0; q < count; q++)
    if (changed[q] >= pd->sk.n) return dyd_fail(err, DYD_E_ARG, "site %u does not exist", changed[q]);
  if (dyd_sites_count(pd->sk.rects.sites) != pd->sk.n)
    return dyd_fail(err, DYD_E_ARG, "sites were added after the triangulation");
  set_options(pd, &o, pd->sk.n);
  return finish(pd, dyd_update(pd, changed, count, err), err);
}

bool dyd_delaunay_is_capped(const dyd_delaunay *pd) {
  if (!pd) return false;
  return pd->open.capped > 0;
}
