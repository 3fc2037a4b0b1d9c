/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where the places are, and which are the same. */
#include "base/alloc.h"
#include "base/error.h"
#include "sphere/state.h"
#include <dyadel/io.h>
#include <string.h>

dyd_status dyd_sphere_stated(dyd_rect *out, const dyd_sphere *s, uint32_t i) {
  if (dyd_sphere_is_fixed(s, i)) return dyd_sites_get(out, dyd_engine_sites(s->places), i);
  dyd_rect_set(out, dyd_stream_rect(s->stream[i]));
  return DYD_OK;
}

/* All within this angle, in radians, of a place of the rectangle are meant. */
static void place_angle(mpq_ptr out, const dyd_sphere *s, uint32_t i) {
  double metres = dyd_engine_number(s->places, i, DYD_ROW_RADIUS);
  mpq_set_d(out, metres > 0 ? metres : 0);
  mpq_mul(out, out, s->metre);
  mpq_add(out, out, s->angle);
}

static dyd_status place_fail(uint32_t i, const char *what, dyd_error *err) {
  if (err) err->point = i;
  return dyd_fail(err, DYD_E_DOMAIN, "%s", what);
}

dyd_status dyd_sphere_spot(dyd_spot *out, const dyd_sphere *s, uint32_t i, dyd_error *err) {
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = dyd_sphere_stated(&r, s, i);
  bool good = st == DYD_OK && dyd_spot_set(out, &r, s->degrees);
  dyd_rect_clear(&r);
  if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
  if (!good)
    return place_fail(i, "the latitude is beyond 90 degrees; points are longitude and latitude, in this order", err);
  place_angle(out->angle, s, i);
  out->stays = mpq_sgn(out->angle) || mpq_sgn(s->degrees) || (dyd_sphere_is_fixed(s, i) && !dyd_spot_is_exact(out));
  if (mpq_cmp_si(out->angle, 1, 1) <= 0) return DYD_OK;
  return place_fail(i, "the radius is larger than that of the earth; give a smaller one", err);
}

/* Is place i exact, and within the common range of degrees? Then its site in doubles encloses its region. */
static bool place_is_plain(double box[4], const dyd_sphere *s, uint32_t i) {
  const dyd_sites *sites = dyd_engine_sites(s->places);
  if (!dyd_sphere_is_fixed(s, i) || !dyd_sites_is_point(sites, i) || mpq_sgn(s->degrees) || mpq_sgn(s->angle) ||
      dyd_engine_number(s->places, i, DYD_ROW_RADIUS) > 0)
    return false;
  dyd_sites_get_d(box, sites, i);
  return box[0] > -180 && box[1] < 180 && box[2] > -90 && box[3] < 90;
}

dyd_status dyd_sphere_spot_d(dyd_spot_d *out, const dyd_sphere *s, uint32_t i, dyd_error *err) {
  dyd_spot spot;
  out->angle = 0;
  if (place_is_plain(out->box, s, i)) return DYD_OK;
  dyd_spot_init(&spot);
  dyd_status st = dyd_sphere_spot(&spot, s, i, err);
  if (st == DYD_OK) dyd_spot_get_d(out, &spot);
  dyd_spot_clear(&spot);
  return st;
}

/* ---- aliases ---- */

/* A place that may be exact, by its degrees rounded down: equal places have equal ones. */
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
    if (st != DYD_OK || !dyd_spot_is_exact(&a)) continue;
    for (size_t l = 0; l < k && s->alias[i] == i && st == DYD_OK; l++) {
      uint32_t j = run[l].place;
      if (s->alias[j] != j) continue;
      st = dyd_sphere_spot(&b, s, j, err);
      if (!dyd_spot_is_exact(&b)) continue;
      if (mpq_equal(a.mid[0], b.mid[0]) && mpq_equal(a.mid[1], b.mid[1])) s->alias[i] = j;
    }
  }
  dyd_spot_clear(&b);
  dyd_spot_clear(&a);
  return st;
}

/* Looks at all places, which finds latitudes that are none; lists those that may be exact. */
static dyd_status places_round(rounded_place *out, size_t *count, dyd_sphere *s, dyd_error *err) {
  for (uint32_t i = 0; i < s->count; i++) {
    dyd_spot_d p;
    dyd_status st = dyd_sphere_spot_d(&p, s, i, err);
    s->alias[i] = i;
    if (st != DYD_OK) return st;
    if (!dyd_sphere_is_fixed(s, i) || !dyd_spot_d_is_tight(&p)) continue;
    out[(*count)++] = (rounded_place){{p.box[0] + 0., p.box[2] + 0.}, i}; /* no -0 */
  }
  return DYD_OK;
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
