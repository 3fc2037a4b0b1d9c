/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From which place to project: one that is exact, or narrow for the distance of its nearest neighbour. Where that one's
 * width, which widens all images, would leave more open than the pairs around a gap, from no place, but from the middle
 * of a gap between them [SPH-5]; also where each may coincide with another one.
 *
 * A guess in doubles: on it depends how wide images are, not whether they are right. Places are compared by distances
 * between the middles of regions, so that wider radii do not change which place, or which gap, is best, unless they
 * reach it; a gap is taken from some width on, and where regions leave pairs open, the gap is looked from, too
 * (sphere.c): so wider radii decide no more. */
#include "base/alloc.h"
#include "base/error.h"
#include "sphere/state.h"
#include <math.h>

/* Where a place is about: a vector of length 1; how far from it the place may be; the same of the box about it, as an
 * eye, whose axes turn with its longitude. */
typedef struct ball_guess {
  double at[3], reach, eye;
  uint32_t place;
} ball_guess;

/* Approximate number of pairs examined, and most candidates; places tried for a gap; least ratio of the distance of an
 * eye that is a region from others to its width. */
enum { WORK = 1 << 20, CANDIDATES = 16, GAPS = 4096, APART = 4 };

/* Scores that differ by less of themselves are the same, whatever the radius. */
#define EVEN 1e-6

static const double degree = 0.017453292519943295, quarter = 1.5707963267948966;

static dyd_status guess_set(ball_guess *out, const dyd_sphere *s, uint32_t i, dyd_error *err) {
  dyd_spot_d r;
  dyd_status st = dyd_sphere_spot_d(&r, s, i, err);
  if (st != DYD_OK) return st;
  double lon = degree * (r.box[0] + r.box[1]) / 2, lat = degree * (r.box[2] + r.box[3]) / 2;
  double dx = degree * (r.box[1] - r.box[0]) / 2, dy = degree * (r.box[3] - r.box[2]) / 2;
  *out = (ball_guess){{cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat)}, .place = i};
  if (dyd_spot_d_is_tight(&r)) return DYD_OK;
  double high = fabs(lat) + dy, across = high * 1.0000001 < quarter - r.angle ? asin(sin(r.angle) / cos(high)) : 4;
  out->reach = dy + fmin(dx * cos(fmax(0, fabs(lat) - dy)), 4) + r.angle;
  out->eye = dy + r.angle + dx + across;
  return DYD_OK;
}

static int compare_guesses(const void *a, const void *b) {
  const ball_guess *x = a, *y = b;
  if (x->reach != y->reach) return x->reach < y->reach ? -1 : 1;
  return (x->place > y->place) - (x->place < y->place);
}

/* By reach; often all are exact, and in order as they come. */
static void guesses_sort(ball_guess *g, size_t n) {
  size_t k = 1;
  while (k < n && compare_guesses(&g[k - 1], &g[k]) < 0) k++;
  if (k < n) qsort(g, n, sizeof *g, compare_guesses);
}

/* From a place to the others: the least distance, and the part of it between the regions. */
typedef struct room_guess {
  double distance, left;
} room_guess;

static double distance_guess(const double a[3], const double b[3]) {
  double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return sqrt(x * x + y * y + z * z);
}

/* `left` counts from the edge of the eye's box. Where the distance is not above `enough`, or left is not above 0, both
 * may be any such numbers. */
static room_guess guess_room(const ball_guess *g, size_t n, const ball_guess *from, double enough) {
  room_guess r = {4, 4 - from->eye};
  for (size_t j = 0; j < n && r.distance > enough && r.left > 0; j++) {
    if (g[j].place == from->place) continue;
    double d = distance_guess(g[j].at, from->at);
    r.distance = fmin(r.distance, d);
    r.left = fmin(r.left, d - g[j].reach - from->eye);
  }
  return r;
}

/* Better ones are greater, of exact places and of others; 0 where it is not apart from all, or touches one, by doubles.
 */
static double guess_score(const ball_guess *g, size_t n, const ball_guess *from) {
  const room_guess r = guess_room(g, n, from, 0);
  if (r.left <= EVEN * r.distance) return 0;
  return from->eye == 0 ? r.distance : r.distance / from->eye;
}

/* Tries the narrowest places, spread among all exact ones; more only while none is apart. */
static double guess_best(uint32_t *out, const ball_guess *g, size_t n) {
  size_t exact = 0, tried = 0, most = 1 + WORK / (n + 1), all = 64 * most;
  double best = 0;
  bool exactly = false; /* the best one is exact */
  while (exact < n && g[exact].reach == 0) exact++;
  if (most > CANDIDATES) most = CANDIDATES;
  size_t step = exact > most ? exact / most : 1;
  for (size_t k = 0; k < n && tried < all && (tried < most || best <= 0); k += k < exact ? step : 1, tried++) {
    if (best > 0 && exactly && k >= exact) break;
    double score = guess_score(g, n, &g[k]);
    bool same = fabs(score - best) <= EVEN * best; /* two places may be nearest to each other */
    if (tried && (same ? g[k].place > *out : score < best)) continue;
    best = score;
    exactly = k < exact;
    *out = g[k].place;
  }
  return best;
}

/* A direction for an eye that is not a place: the k-th of a Fibonacci lattice, which is spread evenly over the sphere.
 */
static ball_guess gap_anywhere(size_t k) {
  double z = 1 - (double)(2 * (k * 1597 % GAPS) + 1) / GAPS, r = sqrt(1 - z * z);
  double lon = degree * fmod((double)k * 222.49223594996215, 360);
  return (ball_guess){.at = {r * cos(lon), r * sin(lon), z}, .place = DYD_NO_PLACE};
}

/* The same in the middle of two places, so that others are all about it. */
static ball_guess gap_amid(const ball_guess *g, size_t n, size_t k) {
  const double *a = g[k % n].at, *b = g[(k + n / 2 + k / n) % n].at;
  ball_guess m = {.at = {a[0] + b[0], a[1] + b[1], a[2] + b[2]}, .place = DYD_NO_PLACE};
  double length = sqrt(m.at[0] * m.at[0] + m.at[1] * m.at[1] + m.at[2] * m.at[2]);
  for (int c = 0; c < 3; c++) m.at[c] = length > 0x1p-20 ? m.at[c] / length : a[c];
  return m;
}

/* Of many directions, the one that is farthest from the middles of all regions, and in none. Where another gap is
 * known, of those between places, away from it. */
static bool gap_best(double at[2], const ball_guess *g, size_t n, const ball_guess *other) {
  double best = 0, apart = other ? fmax(1, guess_room(g, n, other, 0).distance) : 0;
  for (size_t k = 0; k < GAPS && (best <= 0 || k * n < 16 * (size_t)WORK); k++) {
    const ball_guess here = other ? gap_amid(g, n, k) : gap_anywhere(k);
    if (other && distance_guess(here.at, other->at) < apart) continue;
    room_guess room = guess_room(g, n, &here, best);
    if (room.left <= 0 || room.distance <= best) continue;
    best = room.distance;
    at[0] = ldexp(nearbyint(ldexp(atan2(here.at[1], here.at[0]) / degree, 10)), -10);
    at[1] = ldexp(nearbyint(ldexp(asin(here.at[2]) / degree, 10)), -10);
  }
  return best > 0;
}

/* Returns true if it pays to project from a gap. A width of the eye leaves 14 to 30 pairs open for each 1 of the sum of
 * width through distance of the nearest neighbour, over all places; a gap leaves 35 to 70 (airports, places all over
 * the globe). The sum is guessed from some of the places. */
static bool eye_is_wide(const ball_guess *g, size_t n, const dyd_sphere *s) {
  const ball_guess *eye = g;
  while (eye->place != s->centre) eye++;
  if (eye->eye == 0 || !dyd_sphere_is_fixed(s, s->centre)) return false;
  if (guess_room(g, n, eye, 0).left < APART * eye->eye) return true;
  size_t step = 1 + n / (1 + WORK / n);
  double sum = 0;
  for (size_t k = 0; k < n; k += step) {
    const room_guess r = guess_room(g, n, &g[k], 0);
    sum += (double)step * (r.left > eye->eye ? eye->eye / r.left : 1);
  }
  return sum > 2.5;
}

static bool centre_in_gap(dyd_sphere *s, const ball_guess *g, size_t n, const ball_guess *other) {
  double at[2];
  if (!gap_best(at, g, n, other)) return false;
  for (int a = 0; a < 2; a++) mpq_set_d(s->eye.spot.mid[a], at[a]);
  s->free = true;
  s->centre = DYD_NO_PLACE;
  s->eye_bits = INT64_MAX;
  return true;
}

/* Guesses about all places except aliases. */
static dyd_status guesses_make(ball_guess **out, size_t *n, const dyd_sphere *s, dyd_error *err) {
  dyd_status st = DYD_OK;
  ball_guess *g = dyd_alloc(s->count, sizeof *g);
  *n = 0;
  *out = g;
  if (!g) return dyd_fail_nomem(err);
  for (uint32_t i = 0; i < s->count && st == DYD_OK; i++)
    if (s->alias[i] == i) st = guess_set(&g[(*n)++], s, i, err);
  return st;
}

dyd_status dyd_sphere_choose(dyd_sphere *s, dyd_error *err) {
  ball_guess *g;
  size_t n;
  dyd_status st = guesses_make(&g, &n, s, err);
  bool found = true;
  if (st == DYD_OK) {
    guesses_sort(g, n);
    found = guess_best(&s->centre, g, n) > 0 || n < 2;
    if (n >= 2 && (!found || eye_is_wide(g, n, s))) found = centre_in_gap(s, g, n, NULL) || found;
  }
  free(g);
  if (st != DYD_OK || found) return st;
  return dyd_fail(err, DYD_E_DOMAIN,
                  "points may be at the same place as others, and anywhere on the globe, so that nothing is "
                  "known of any; give a smaller radius, or `merge` where such points are one");
}

dyd_status dyd_sphere_choose_gap(dyd_sphere *s, const dyd_sphere *other, dyd_error *err) {
  ball_guess *g;
  size_t n;
  const double lon = degree * mpq_get_d(other->eye.spot.mid[0]), lat = degree * mpq_get_d(other->eye.spot.mid[1]);
  const ball_guess there = {.at = {cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat)}, .place = DYD_NO_PLACE};
  dyd_status st = guesses_make(&g, &n, s, err);
  if (st == DYD_OK && n) centre_in_gap(s, g, n, other->free ? &there : NULL);
  free(g);
  return st;
}
