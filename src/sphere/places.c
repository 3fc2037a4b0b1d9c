/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where the places are, and which are the same. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "engine/state.h"
#include "sphere/state.h"
#include "stream/algebra/zero.h"
#include "stream/ball.h"

#include <dyadel/io.h>
#include <string.h>

/* ---- regions ---- */

void dyd_spot_init(dyd_spot *s) {
  mpq_inits(s->mid[0], s->mid[1], s->half[0], s->half[1], s->angle, NULL);
  s->stays = false;
}

void dyd_spot_clear(dyd_spot *s) {
  mpq_clears(s->mid[0], s->mid[1], s->half[0], s->half[1], s->angle, NULL);
}

static void spot_set_side(dyd_spot *s, int a, mpq_t lo, mpq_t hi) {
  mpq_set_ui(s->half[a], 0, 1);
  mpq_set(s->mid[a], lo);
  if (mpq_equal(lo, hi)) return;
  mpq_add(s->mid[a], lo, hi);
  mpq_div_2exp(s->mid[a], s->mid[a], 1);
  mpq_sub(s->half[a], hi, s->mid[a]);
}

/* Latitudes beyond a pole are cut off, and the longitude is any. */
static bool spot_cut_poles(dyd_spot *s, mpq_t lo, mpq_t hi) {
  bool beyond = mpq_cmp_si(hi, 90, 1) > 0 || mpq_cmp_si(lo, -90, 1) < 0;
  if (mpq_cmp_si(hi, -90, 1) < 0 || mpq_cmp_si(lo, 90, 1) > 0) return false;
  if (beyond && mpq_equal(lo, hi)) return false;
  if (mpq_cmp_si(hi, 90, 1) > 0) mpq_set_si(hi, 90, 1);
  if (mpq_cmp_si(lo, -90, 1) < 0) mpq_set_si(lo, -90, 1);
  spot_set_side(s, 1, lo, hi);
  bool pole = mpq_equal(lo, hi) && (mpq_cmp_si(hi, 90, 1) == 0 || mpq_cmp_si(lo, -90, 1) == 0);
  if (beyond || pole) {
    mpq_set_si(s->mid[0], 0, 1);
    mpq_set_si(s->half[0], pole ? 0 : 180, 1);
  }
  return true;
}

/* x becomes the number equal to it modulo 360 that is in [-180, 180). */
static void reduce_longitude(mpq_t x) {
  if (mpq_cmp_si(x, 180, 1) < 0 && mpq_cmp_si(x, -180, 1) >= 0) return;
  DYD_LOCAL_NUMBERS(mpz, turns, unit);
  mpz_mul_ui(unit, mpq_denref(x), 180);
  mpz_add(turns, mpq_numref(x), unit);
  mpz_mul_2exp(unit, unit, 1);
  mpz_fdiv_r(turns, turns, unit);
  mpz_tdiv_q_2exp(unit, unit, 1);
  mpz_sub(mpq_numref(x), turns, unit);
  mpq_canonicalize(x);
}

bool dyd_spot_set(dyd_spot *s, const dyd_rect *r, mpq_srcptr more) {
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  mpq_set_ui(s->angle, 0, 1);
  dyd_interval_get_q(lo, hi, &r->x);
  spot_set_side(s, 0, lo, hi);
  reduce_longitude(s->mid[0]);
  dyd_interval_get_q(lo, hi, &r->y);
  if (mpq_sgn(more)) {
    mpq_add(s->half[0], s->half[0], more);
    mpq_sub(lo, lo, more);
    mpq_add(hi, hi, more);
  }
  return spot_cut_poles(s, lo, hi);
}

bool dyd_spot_is_exact(const dyd_spot *s) {
  return mpq_sgn(s->half[0]) == 0 && mpq_sgn(s->half[1]) == 0 && mpq_sgn(s->angle) == 0;
}

void dyd_spot_choose(dyd_spot *s, unsigned place) {
  for (int a = 0; a < 2; a++) {
    if (place && (place - 1) >> a & 1) mpq_add(s->mid[a], s->mid[a], s->half[a]);
    if (place && !((place - 1) >> a & 1)) mpq_sub(s->mid[a], s->mid[a], s->half[a]);
    mpq_set_ui(s->half[a], 0, 1);
  }
  mpq_set_ui(s->angle, 0, 1);
  if (mpq_cmp_si(s->mid[1], 90, 1) == 0 || mpq_cmp_si(s->mid[1], -90, 1) == 0) mpq_set_ui(s->mid[0], 0, 1);
}

/* out = an upper bound of x degrees, x in radians. */
static void degrees_above(mpq_t out, arb_t x) {
  DYD_LOCAL_NUMBERS(arb, pi);
  DYD_LOCAL_NUMBERS(arf, up);
  arb_const_pi(pi, 64);
  arb_mul_ui(x, x, 180, 64);
  arb_div(x, x, pi, 64);
  arb_get_ubound_arf(up, x, 53);
  if (arf_is_finite(up) && arf_cmp_si(up, 180) < 0)
    mpq_set_d(out, arf_get_d(up, ARF_RND_CEIL));
  else
    mpq_set_si(out, 180, 1);
}

/* The cap about (l, f) of an angle a holds longitudes up to asin(sin a / cos f) from l, while f + a < 90 degrees. */
void dyd_spot_box(dyd_spot *s) {
  if (mpq_sgn(s->angle) == 0) return;
  DYD_LOCAL_NUMBERS(arb, a, f);
  DYD_LOCAL_NUMBERS(mpq, lo, hi, more);
  mpq_sub(lo, s->mid[1], s->half[1]);
  mpq_add(hi, s->mid[1], s->half[1]);
  mpq_neg(more, lo);
  dyd_ball_set_q(f, mpq_cmp(more, hi) > 0 ? more : hi, 64); /* the widest is about the highest latitude */
  arb_div_ui(f, f, 180, 64);
  arb_cos_pi(f, f, 64);
  dyd_ball_set_q(a, s->angle, 64);
  arb_sin(a, a, 64);
  arb_div(a, a, f, 64);
  arb_asin(a, a, 64);
  degrees_above(more, a);
  mpq_add(s->half[0], s->half[0], more);
  dyd_ball_set_q(a, s->angle, 64);
  degrees_above(more, a);
  mpq_sub(lo, lo, more);
  mpq_add(hi, hi, more);
  spot_cut_poles(s, lo, hi);
  mpq_set_ui(s->angle, 0, 1);
}

/* The next double at or below x (side < 0), or at or above. */
static double rounded_to(mpq_srcptr x, int side, mpq_t exact) {
  double d = mpq_get_d(x); /* towards 0 */
  mpq_set_d(exact, d);
  int beyond = mpq_cmp(x, exact);
  return beyond * side > 0 ? nextafter(d, side * HUGE_VAL) : d;
}

void dyd_spot_get_d(dyd_spot_d *out, const dyd_spot *s) {
  DYD_LOCAL_NUMBERS(mpq, end, exact);
  for (int a = 0; a < 2; a++) {
    mpq_sub(end, s->mid[a], s->half[a]);
    out->box[2 * a] = rounded_to(end, -1, exact);
    mpq_add(end, s->mid[a], s->half[a]);
    out->box[2 * a + 1] = rounded_to(end, 1, exact);
  }
  out->angle = rounded_to(s->angle, 1, exact);
}

/* Where the places themselves are asked, their engine knows more than a stream that was taken out, unless that was
 * recognised. */
dyd_status dyd_sphere_stated(dyd_rect *out, const dyd_sphere *s, uint32_t i) {
  if (dyd_sphere_is_fixed(s, i) || (dyd_engine_knows(s->places, i) && !dyd_stream_is_final(s->stream[i])))
    return dyd_sites_get(out, dyd_engine_sites(s->places), i);
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

/* Sets *out to all places within `metres` of its middle. */
static void spot_within(dyd_spot *out, const dyd_sphere *s, double metres) {
  for (int a = 0; a < 2; a++) mpq_set_ui(out->half[a], 0, 1);
  mpq_set_d(out->angle, metres);
  mpq_mul(out->angle, out->angle, s->metre);
  out->stays = metres > 0;
}

dyd_status dyd_sphere_spot(dyd_spot *out, const dyd_sphere *s, uint32_t i, dyd_error *err) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sphere_stated(&r, s, i);
  bool good = st == DYD_OK && dyd_spot_set(out, &r, s->degrees);
  if (good && s->within && s->within[i] >= 0) {
    spot_within(out, s, s->within[i]);
    return DYD_OK;
  }
  if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
  if (!good)
    return place_fail(i, "the latitude is beyond 90 degrees; points are longitude and latitude, in this order", err);
  place_angle(out->angle, s, i);
  out->stays = mpq_sgn(out->angle) || mpq_sgn(s->degrees) || (dyd_sphere_is_fixed(s, i) && !dyd_spot_is_exact(out));
  if (mpq_cmp_si(out->angle, 1, 1) <= 0) return DYD_OK;
  return place_fail(i, "the radius is larger than that of the earth; give a smaller one", err);
}

/* Returns true if place i is exact, and within the common range of degrees. Then its site in doubles encloses its
 * region. */
static bool place_is_plain(double box[4], const dyd_sphere *s, uint32_t i) {
  const dyd_sites *sites = dyd_engine_sites(s->places);
  if (s->within || !dyd_sphere_is_fixed(s, i) || !dyd_sites_is_point(sites, i) || mpq_sgn(s->degrees) ||
      mpq_sgn(s->angle) || dyd_engine_number(s->places, i, DYD_ROW_RADIUS) > 0)
    return false;
  dyd_sites_get_d(box, sites, i);
  return box[0] > -180 && box[1] < 180 && box[2] > -90 && box[3] < 90;
}

dyd_status dyd_sphere_spot_d(dyd_spot_d *out, const dyd_sphere *s, uint32_t i, dyd_error *err) {
  out->angle = 0;
  if (place_is_plain(out->box, s, i)) return DYD_OK;
  DYD_LOCAL(dyd_spot, spot);
  dyd_status st = dyd_sphere_spot(&spot, s, i, err);
  if (st == DYD_OK) dyd_spot_get_d(out, &spot);
  return st;
}

/* ---- what computable places are ---- */

/* Sets q to the number that form n is, where its normal form is one [IDN-1]. */
static bool form_is_rational(mpq_ptr q, dyd_algebra *a, uint32_t n) {
  const dyd_fraction *x = n == DYD_NONE ? NULL : dyd_ring_fraction(&a->ring, n);
  fmpz_t part;
  if (!x || !fmpz_mpoly_is_fmpz(x->num, a->ring.ctx) || !fmpz_mpoly_is_fmpz(x->den, a->ring.ctx)) return false;
  for (int k = 0; k < 2; k++) {
    fmpz_init(part);
    fmpz_mpoly_get_fmpz(part, k ? x->den : x->num, a->ring.ctx);
    fmpz_get_mpz(k ? mpq_denref(q) : mpq_numref(q), part);
    fmpz_clear(part);
  }
  mpq_canonicalize(q);
  return true;
}

/* Sets out to the exact place that the forms are; a pole has longitude 0, whatever the form of its longitude. */
static bool forms_are_exact(dyd_rect *out, dyd_algebra *a, dyd_form_point at) {
  DYD_LOCAL_NUMBERS(mpq, x, y);
  bool good = form_is_rational(y, a, at.y);
  bool pole = good && (mpq_cmp_si(y, 90, 1) == 0 || mpq_cmp_si(y, -90, 1) == 0);
  good = good && (pole || form_is_rational(x, a, at.x));
  return good && dyd_interval_set_q(&out->x, x) == DYD_OK && dyd_interval_set_q(&out->y, y) == DYD_OK;
}

static dyd_status place_becomes(dyd_sphere *s, uint32_t i, const dyd_rect *r) {
  dyd_stream *exact;
  dyd_status st = dyd_stream_from_rect(&exact, r);
  if (st != DYD_OK) return st;
  dyd_stream_free(s->stream[i]);
  s->stream[i] = exact;
  return DYD_OK;
}

dyd_status dyd_sphere_recognise(dyd_sphere *s, uint32_t i, dyd_error *err) {
  dyd_algebra a;
  if (dyd_sphere_is_fixed(s, i) || dyd_stream_is_final(s->stream[i])) return DYD_OK;
  dyd_status st = dyd_algebra_open(&a, DYD_TIE_BITS, &s->images->stop);
  DYD_LOCAL(dyd_rect, r);
  dyd_form_point at = dyd_forms_stream(&a.forms, s->stream[i]);
  bool both = at.x != DYD_NONE; /* a longitude that is measured may be that of a pole */
  if (st == DYD_OK && at.y != DYD_NONE) st = dyd_algebra_settle(&a, both ? &at.x : &at.y, both ? 2 : 1);
  if (st == DYD_OK && a.settled && forms_are_exact(&r, &a, at)) st = place_becomes(s, i, &r);
  dyd_algebra_close(&a);
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

/* ---- aliases ---- */

/* A place that may be exact, by its degrees rounded down: equal places have equal ones. Where there are computable
 * places, by a square of 2^-FINE degrees that the true place may be in. */
typedef struct rounded_place {
  double at[2];
  uint32_t place;
} rounded_place;

enum { FINE = 28, MOST_SQUARES = 4 };

static int compare_rounded(const void *a, const void *b) {
  const rounded_place *x = a, *y = b;
  for (int k = 0; k < 2; k++)
    if (x->at[k] != y->at[k]) return x->at[k] < y->at[k] ? -1 : 1;
  return (x->place > y->place) - (x->place < y->place);
}

/* Among places with equal rounded degrees: each becomes an alias of the first that is equal to it. Computable ones are
 * recognised here, so that single ones cost nothing. */
static dyd_status aliases_in_run(dyd_sphere *s, const rounded_place *run, size_t count, dyd_error *err) {
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_spot, a, b);
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    uint32_t i = run[k].place;
    st = dyd_sphere_recognise(s, i, err);
    if (st == DYD_OK) st = dyd_sphere_spot(&a, s, i, err);
    if (st != DYD_OK || !dyd_spot_is_exact(&a)) continue;
    for (size_t l = 0; l < k && s->alias[i] == i && st == DYD_OK; l++) {
      uint32_t j = run[l].place;
      if (s->alias[j] != j) continue;
      st = dyd_sphere_spot(&b, s, j, err);
      if (!dyd_spot_is_exact(&b)) continue;
      if (mpq_equal(a.mid[0], b.mid[0]) && mpq_equal(a.mid[1], b.mid[1])) s->alias[i] = j;
    }
  }
  return st;
}

/* The squares that p meets; none where it is wide. Returns how many. */
static size_t squares_put(rounded_place out[MOST_SQUARES], const dyd_spot_d *p, uint32_t i) {
  const double turn = ldexp(360, FINE);
  double end[4];
  size_t n = 0;
  for (int k = 0; k < 4; k++) end[k] = floor(ldexp(p->box[k], FINE));
  if (!(p->angle == 0 && end[1] - end[0] <= 1 && end[3] - end[2] <= 1)) return 0;
  for (double x = end[0]; x <= end[1]; x++)
    for (double y = end[2]; y <= end[3]; y++)
      out[n++] = (rounded_place){{(x < -turn / 2 ? x + turn : x >= turn / 2 ? x - turn : x) + 0., y + 0.}, i};
  return n;
}

/* Examines all places, which finds invalid latitudes; lists places that may be exact. Near a pole the longitude
 * of a computable place is any, so that it has to be recognised first. */
static dyd_status places_round(rounded_place *out, size_t *count, dyd_sphere *s, dyd_error *err) {
  for (uint32_t i = 0; i < s->count; i++) {
    dyd_spot_d p;
    dyd_status st = dyd_sphere_spot_d(&p, s, i, err);
    s->alias[i] = i;
    bool fixed = dyd_sphere_is_fixed(s, i);
    if (st == DYD_OK && !fixed && p.box[1] - p.box[0] >= 360) {
      st = dyd_sphere_recognise(s, i, err);
      if (st == DYD_OK) st = dyd_sphere_spot_d(&p, s, i, err);
    }
    if (st != DYD_OK) return st;
    if (fixed && !dyd_spot_d_is_tight(&p)) continue;
    if (s->stream)
      *count += squares_put(out + *count, &p, i);
    else
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

/* Keeps the few that share a bucket with another one: others need not be sorted. */
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
  DYD_FREED rounded_place *place = dyd_alloc(s->count * (s->stream ? MOST_SQUARES : 1), sizeof *place);
  size_t count = 0;
  dyd_status st = place ? places_round(place, &count, s, err) : dyd_fail_nomem(err);
  if (st == DYD_OK && places_thin(place, &count) != DYD_OK) st = dyd_fail_nomem(err);
  if (st == DYD_OK) qsort(place, count, sizeof *place, compare_rounded);
  for (size_t k = 0, end; k < count && st == DYD_OK; k = end) {
    for (end = k + 1; end < count && !memcmp(place[end].at, place[k].at, sizeof place->at);) end++;
    if (end > k + 1) st = aliases_in_run(s, place + k, end - k, err);
  }
  for (uint32_t i = 0; i < s->count && st == DYD_OK; i++) s->alias[i] = s->alias[s->alias[i]];
  return st;
}
