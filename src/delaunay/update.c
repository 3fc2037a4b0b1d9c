/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Building again on narrower rectangles: legal pairs are carried over. */
#include "delaunay/update.h"

#include "delaunay/build.h"

dyd_status dyd_update(dyd_delaunay *pd, const uint32_t *changed, size_t count) {
  (void)changed;
  if (count == 0) return DYD_OK;
  dyd_pair_list legal = {0}, all = {0};
  dyd_status st = dyd_delaunay_pairs(&all, pd);
  if (st == DYD_OK) {
    size_t kept = 0;
    for (size_t q = 0; q < all.count; q++)
      if (all.item[q].status == DYD_LEGAL) all.item[kept++] = all.item[q];
    all.count = kept;
    dyd_delaunay next = {.sites = pd->sites, .n = pd->n, .counters = pd->counters, .options = pd->options,
                         .max_pairs = pd->max_pairs, .err = pd->err};
    st = dyd_build(&next, (dyd_known){all.item, all.count});
    if (st == DYD_OK) {
      dyd_build_clear(pd);
      *pd = next;
    }
  }
  dyd_pair_list_clear(&legal);
  dyd_pair_list_clear(&all);
  return st;
}
