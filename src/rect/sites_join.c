/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sites that are known to be the same place. */
#include "rect/sites_table.h"

#include <stdlib.h>

size_t dyd_sites_joined(const dyd_sites *s, size_t i) {
  if (!s) return 0;
  return i < s->joined_count ? s->joined[i] : i;
}

static dyd_status joined_make_room(dyd_sites *s) {
  uint32_t *p = s->joined_count < s->count ? realloc(s->joined, s->count * sizeof *p) : s->joined;
  if (!p) return DYD_E_NOMEM;
  s->joined = p;
  for (; s->joined_count < s->count; s->joined_count++) p[s->joined_count] = (uint32_t)s->joined_count;
  return DYD_OK;
}

/* *common = what sites i and j have in common. */
static dyd_status joined_rect(dyd_rect *common, const dyd_sites *s, size_t i, size_t j) {
  dyd_rect other;
  dyd_rect_init(&other);
  dyd_status st = dyd_sites_get(common, s, i);
  if (st == DYD_OK) st = dyd_sites_get(&other, s, j);
  if (st == DYD_OK && !dyd_rect_meets(common, &other)) st = DYD_E_NESTING;
  if (st == DYD_OK) st = dyd_interval_intersect(&common->x, &common->x, &other.x);
  if (st == DYD_OK) st = dyd_interval_intersect(&common->y, &common->y, &other.y);
  dyd_rect_clear(&other);
  return st;
}

/* Of the two and all that are joined with them. */
static dyd_status joined_narrow(dyd_sites *s, uint32_t low, uint32_t high, const dyd_rect *common) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < s->joined_count && st == DYD_OK; k++)
    if (s->joined[k] == low || s->joined[k] == high) st = dyd_sites_narrow(s, k, common);
  for (size_t k = 0; k < s->joined_count && st == DYD_OK; k++)
    if (s->joined[k] == high) s->joined[k] = low;
  return st;
}

dyd_status dyd_sites_join(dyd_sites *s, size_t i, size_t j) {
  if (!s) return DYD_E_ARG;
  if (i >= s->count || j >= s->count) return DYD_E_ARG;
  dyd_status st = joined_make_room(s);
  if (st != DYD_OK) return st;
  uint32_t low = s->joined[i < j ? i : j], high = s->joined[i < j ? j : i];
  if (low == high) return DYD_OK;
  dyd_rect common;
  dyd_rect_init(&common);
  st = joined_rect(&common, s, low, high);
  if (st == DYD_OK) st = low < high ? joined_narrow(s, low, high, &common) : joined_narrow(s, high, low, &common);
  if (st == DYD_OK) s->joins++;
  dyd_rect_clear(&common);
  return st;
}
