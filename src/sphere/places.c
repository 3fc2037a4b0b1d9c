/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where the places are, and which are the same. */
#include "base/alloc.h"
#include "base/error.h"
#include "sphere/state.h"
#include <string.h>

dyd_status dyd_sphere_spot(dyd_spot *out, const dyd_sphere *s, uint32_t i, dyd_error *err) {
  dyd_rect r;
  dyd_status st = DYD_OK;
  dyd_rect_init(&r);
  if (dyd_sphere_is_fixed(s, i))
    st = dyd_sites_get(&r, dyd_engine_sites(s->places), i);
  else
    dyd_rect_set(&r, dyd_stream_rect(s->stream[i]));
  if (st != DYD_OK) {
    dyd_fail(err, st, "%s", dyd_status_text(st));
  } else if (!dyd_spot_set(out, &r, s->degrees)) {
    if (err) err->point = i;
    st = dyd_fail(err, DYD_E_DOMAIN,
                  "the latitude is beyond 90 degrees; points are longitude and latitude, in this order");
  }
  dyd_rect_clear(&r);
  return st;
}

void dyd_sphere_angle(mpq_ptr out, const dyd_sphere *s, uint32_t i) {
  double metres = dyd_engine_radius(s->places, i);
  mpq_set(out, s->angle);
  if (!(metres > 0)) return;
  mpq_set_d(out, metres);
  mpq_mul(out, out, s->metre);
  mpq_add(out, out, s->angle);
}

dyd_status dyd_sphere_wide_spot(dyd_spot *out, const dyd_sphere *s, uint32_t i, dyd_error *err) {
  mpq_t angle;
  dyd_status st = dyd_sphere_spot(out, s, i, err);
  if (st != DYD_OK || !dyd_sphere_is_round(s, i)) return st;
  mpq_init(angle);
  dyd_sphere_angle(angle, s, i);
  dyd_spot_widen(out, angle);
  mpq_clear(angle);
  return DYD_OK;
}

static dyd_status check_angle(const dyd_sphere *s, uint32_t i, dyd_error *err) {
  mpq_t angle;
  if (!dyd_sphere_is_round(s, i)) return DYD_OK;
  mpq_init(angle);
  dyd_sphere_angle(angle, s, i);
  bool small = mpq_cmp_si(angle, 1, 1) <= 0;
  mpq_clear(angle);
  if (!small && err) err->point = i;
  return small ? DYD_OK
               : dyd_fail(err, DYD_E_DOMAIN, "the radius is larger than that of the earth; give a smaller one");
}

/* ---- aliases ---- */

/* An exact place, by its degrees rounded: equal places have equal ones. */
typedef struct rounded_place {
  double at[2];
  uint32_t place;
} rounded_place;

static int compare_rounded(const void *a, const void *b) {
  const rounded_place *x = a, *y = b;
  for (int k = 0; k < 2; k++)
    if (x->at[k] != y->at[k]) return x->at[k] < y->at[k] ? -1 : 1;
  return (x->place > y->place) - (x->place < y->place);
}

/* Among places with equal rounded degrees: each becomes an alias of the first that is equal to it. */
static dyd_status aliases_in_run(dyd_sphere *s, const rounded_place *run, size_t count, dyd_error *err) {
  dyd_spot a, b;
  dyd_status st = DYD_OK;
  dyd_spot_init(&a);
  dyd_spot_init(&b);
  for (size_t k = 1; k < count && st == DYD_OK; k++) {
    uint32_t i = run[k].place;
    st = dyd_sphere_spot(&a, s, i, err);
    for (size_t l = 0; l < k && s->alias[i] == i && st == DYD_OK; l++) {
      uint32_t j = run[l].place;
      if (s->alias[j] != j) continue;
      st = dyd_sphere_spot(&b, s, j, err);
      if (mpq_equal(a.mid[0], b.mid[0]) && mpq_equal(a.mid[1], b.mid[1])) s->alias[i] = j;
    }
  }
  dyd_spot_clear(&b);
  dyd_spot_clear(&a);
  return st;
}

/* An exact place within the common range of degrees, in doubles rounded towards 0, as mpq_get_d rounds. */
static bool place_is_plain(double at[2], const dyd_sphere *s, uint32_t i) {
  const dyd_sites *sites = dyd_engine_sites(s->places);
  double box[4];
  if (!dyd_sphere_is_fixed(s, i) || !dyd_sites_is_point(sites, i) || mpq_sgn(s->degrees) || dyd_sphere_is_round(s, i))
    return false;
  dyd_sites_get_d(box, sites, i);
  for (int a = 0; a < 2; a++) at[a] = box[2 * a] >= 0 ? box[2 * a] : box[2 * a + 1];
  return box[0] > -180 && box[1] < 180 && box[2] > -90 && box[3] < 90;
}

/* Looks at all places, which finds latitudes that are none; lists those that are exact. */
static dyd_status places_round(rounded_place *out, size_t *count, const dyd_sphere *s, dyd_error *err) {
  dyd_spot spot;
  dyd_status st = DYD_OK;
  dyd_spot_init(&spot);
  for (uint32_t i = 0; i < s->count && st == DYD_OK; i++) {
    dyd_rough_place *r = &s->rough[i];
    s->alias[i] = i;
    *r = (dyd_rough_place){{0, 0}, {0, 0}};
    if (place_is_plain(r->at, s, i)) {
      out[(*count)++] = (rounded_place){{r->at[0], r->at[1]}, i};
      continue;
    }
    st = dyd_sphere_spot(&spot, s, i, err);
    if (st == DYD_OK) st = check_angle(s, i, err);
    if (st != DYD_OK) break;
    for (int a = 0; a < 2; a++) r->at[a] = mpq_get_d(spot.mid[a]), r->half[a] = mpq_get_d(spot.half[a]);
    if (!dyd_sphere_is_fixed(s, i) || !dyd_spot_is_exact(&spot) || dyd_sphere_is_round(s, i)) continue;
    out[(*count)++] = (rounded_place){{r->at[0], r->at[1]}, i};
  }
  dyd_spot_clear(&spot);
  return st;
}

/* Which of `buckets`, a power of two. */
static size_t bucket_of(const rounded_place *p, size_t buckets) {
  uint64_t bits[2];
  memcpy(bits, p->at, sizeof bits);
  uint64_t mixed = (bits[0] ^ (bits[1] << 32 | bits[1] >> 32)) * UINT64_C(0x9E3779B97F4A7C15);
  return (size_t)((mixed ^ mixed >> 32) & (buckets - 1));
}

/* Keeps those that share a bucket with another one, which are few: others need not be sorted. */
static dyd_status places_thin(rounded_place *place, size_t *count) {
  size_t buckets = 1, kept = 0;
  while (buckets / 8 < *count) buckets *= 2;
  uint8_t *held = calloc(buckets, sizeof *held); /* 0, 1, or 2 for more */
  if (!held) return DYD_E_NOMEM;
  for (size_t k = 0; k < *count; k++) {
    uint8_t *h = &held[bucket_of(&place[k], buckets)];
    if (*h < 2) ++*h;
  }
  for (size_t k = 0; k < *count; k++)
    if (held[bucket_of(&place[k], buckets)] > 1) place[kept++] = place[k];
  *count = kept;
  free(held);
  return DYD_OK;
}

dyd_status dyd_sphere_find_aliases(dyd_sphere *s, dyd_error *err) {
  rounded_place *place = dyd_alloc(s->count, sizeof *place);
  size_t count = 0;
  dyd_status st = place ? places_round(place, &count, s, err) : dyd_fail_nomem(err);
  if (st == DYD_OK && places_thin(place, &count) != DYD_OK) st = dyd_fail_nomem(err);
  if (st == DYD_OK) qsort(place, count, sizeof *place, compare_rounded);
  for (size_t k = 0, end; k < count && st == DYD_OK; k = end) {
    for (end = k + 1; end < count && !memcmp(place[end].at, place[k].at, sizeof place->at);) end++;
    if (end > k + 1) st = aliases_in_run(s, place + k, end - k, err);
  }
  free(place);
  return st;
}
