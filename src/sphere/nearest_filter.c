/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which places may be nearest to a place, as far as doubles tell [SPH-6]: an index, sorted by the height z of places
 * over the plane of the equator.
 *
 * A region is within a chord `reach` of its middle; middles are at most SLACK off, which is more than 8 * 2^-50 from
 * turns [FLT-SPH] and a product, and more than the rounding of what follows. So chords between points of two regions
 * are within the sum of their reaches and 2 SLACK of the one between their middles, and |z - z'| is not above it. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "sphere/state.h"

/* ---- images in doubles [FLT-SPH]: the formula of project.c, halved above and below, in intervals ----
 *
 * Let u = 2^-53. An angle of x degrees is 90 k more than r degrees, |r| <= 45, exactly (Sterbenz): t = r pi / 180 is
 * off by 2.01 u t, |t| <= 0.7854, z = t^2 <= 0.617 by 1 u more. sin t = t + t z g with g of 8 terms, off by 0.45 u (the
 * leading 1/6 by 2 u, the others, 0.0053 in all, by 21 u), so t z g by 0.6 u t, the sum by 1 u t, the series by
 * 10^-19 t: 4 u t in all. cos t = 1 - z h, h = 1/2 - z ..., off by 1 u, so z h by 1.3 u, the difference by u / 2, by t
 * 1.2 u, the series by 10^-17: 3.1 u in all. TURN_ERROR = 8 u is more, also when added to the sine or cosine and
 * rounded. Between the ends of a box of angles sine and cosine change by its width in radians at most. */

#define DEGREE 0.017453292519943295
#define MORE_THAN_DEGREE 0.0175
#define TURN_ERROR 0x1p-50
#define MOST_DEGREES 720.0
#define LEAST 0x1p-64

/* sin t = t + t z g, cos t = 1 - z h: the coefficients, highest first. */
static const double sine[] = {1. / 355687428096000, -1. / 1307674368000, 1. / 6227020800, -1. / 39916800,
                              1. / 362880,          -1. / 5040,          1. / 120,        -1. / 6};
static const double cosine[] = {-1. / 20922789888000, 1. / 87178291200, -1. / 479001600, 1. / 3628800,
                                -1. / 40320,          1. / 720,         -1. / 24,        1. / 2};
enum { TERMS = sizeof sine / sizeof *sine, MOST_BITS = 48 };

static dyd_iv turn_around(double value, double error) {
  return (dyd_iv){dyd_down(value - error), dyd_up(value + error)};
}

/* Encloses sine and cosine of x degrees [FLT-SPH]. Returns false for angles beyond 720 degrees. */
static bool sin_cos(dyd_iv *s, dyd_iv *c, dyd_iv x) {
  if (!(fabs(x.lo) <= MOST_DEGREES && x.hi <= MOST_DEGREES)) return false;
  double k = nearbyint(x.lo / 90), t = (x.lo - 90 * k) * DEGREE, z = t * t, g = sine[0], h = cosine[0];
  for (int q = 1; q < TERMS; q++) {
    g = sine[q] + z * g;
    h = cosine[q] + z * h;
  }
  double wide = MORE_THAN_DEGREE * (x.hi - x.lo), even = wide + TURN_ERROR;
  dyd_iv sin = turn_around(t + t * z * g, wide + TURN_ERROR * fabs(t)), cos = turn_around(1 - z * h, even);
  unsigned quarter = (unsigned)(int)k & 3;
  *s = quarter & 1 ? cos : sin;
  *c = quarter & 1 ? sin : cos;
  if (quarter & 2) *s = dyd_iv_neg(*s);
  if (quarter == 1 || quarter == 2) *c = dyd_iv_neg(*c);
  return true;
}

/* Ends move outward by up to LEAST, so that none is next to 0, where exact arithmetic on doubles is slow. */
static bool span_give(double out[2], dyd_iv x, double most) {
  out[0] = x.lo - LEAST;
  out[1] = x.hi + LEAST;
  return out[0] < out[1] && out[1] - out[0] <= most && most < HUGE_VAL;
}

bool dyd_filter_image(double box[4], const dyd_spot_d *place, const dyd_eye_d *eye, int64_t bits) {
  dyd_iv lon = {place->box[0], place->box[1]}, lat = {place->box[2], place->box[3]}, sw, cw, su, cu, sf, cf;
  if (place->angle > 0) return false;
  if (!sin_cos(&sw, &cw, dyd_iv_scale(dyd_iv_sub(lon, eye->lon), 0.5)) ||
      !sin_cos(&su, &cu, dyd_iv_scale(dyd_iv_sub(lat, eye->lat), 0.5)) || !sin_cos(&sf, &cf, lat))
    return false;
  dyd_iv across = dyd_iv_mul(cf, dyd_iv_sqr(sw)); /* cos f sin^2(d/2) */
  dyd_iv D = dyd_iv_add(dyd_iv_sqr(su), dyd_iv_mul(eye->cos, across));
  dyd_iv x = dyd_iv_div(dyd_iv_mul(cf, dyd_iv_mul(sw, cw)), D);
  dyd_iv y = dyd_iv_div(dyd_iv_add(dyd_iv_mul(su, cu), dyd_iv_mul(eye->sin, across)), D);
  double scale = 1 + x.lo * x.lo + y.lo * y.lo;
  double most = bits >= 0 && bits <= MOST_BITS ? ldexp(scale, -(int)bits - 1) : 0;
  return span_give(box, x, most) && span_give(box + 2, y, most);
}

#define SLACK 0x1p-44
#define RADIANS_ABOVE 0.017453292519943298

typedef struct middle {
  double at[3], reach;
  uint32_t place;
} middle;

struct dyd_near_index {
  middle *item;
  size_t count;
  double widest; /* reach */
};

/* Half of the side, and more. */
static double half_above(const double side[2], double mid) {
  return dyd_up(fmax(side[1] - mid, mid - side[0]) * RADIANS_ABOVE);
}

static dyd_iv middle_turn(dyd_iv *cos, double degrees) {
  dyd_iv sin;
  if (!sin_cos(&sin, cos, (dyd_iv){degrees, degrees})) sin = *cos = (dyd_iv){-1, 1};
  return sin;
}

static void middle_set(middle *out, const dyd_spot_d *p, uint32_t place) {
  const double lon = (p->box[0] + p->box[1]) / 2, lat = (p->box[2] + p->box[3]) / 2;
  dyd_iv cl, cf, sl = middle_turn(&cl, lon), sf = middle_turn(&cf, lat);
  const dyd_iv v[3] = {dyd_iv_mul(cf, cl), dyd_iv_mul(cf, sl), sf};
  double up = half_above(p->box + 2, lat), along = half_above(p->box, lon) * fmin(1, fmax(cf.hi, 0) + up);
  out->place = place;
  out->reach = dyd_spot_d_is_tight(p) ? 0 : (up + along + p->angle) * (1 + 0x1p-40);
  for (int a = 0; a < 3; a++) {
    out->at[a] = (v[a].lo + v[a].hi) / 2;
    if (v[a].hi - v[a].lo > SLACK / 4) out->reach = 4;
  }
}

static int compare_middles(const void *a, const void *b) {
  const middle *x = a, *y = b;
  return (x->at[2] > y->at[2]) - (x->at[2] < y->at[2]);
}

void dyd_near_index_free(dyd_near_index *index) {
  if (index) free(index->item);
  free(index);
}

static dyd_status index_make(dyd_near_index **out, const dyd_sphere *s, dyd_error *err) {
  dyd_status st = DYD_OK;
  dyd_near_index *x = calloc(1, sizeof *x);
  if (x) x->item = dyd_alloc(s->count, sizeof *x->item);
  if (!x || !x->item) st = dyd_fail_nomem(err);
  for (uint32_t i = 0; i < s->count && st == DYD_OK; i++) {
    dyd_spot_d p;
    if (s->alias[i] != i) continue;
    st = dyd_sphere_spot_d(&p, s, i, err);
    if (st != DYD_OK) break;
    middle_set(&x->item[x->count++], &p, i);
    x->widest = fmax(x->widest, x->item[x->count - 1].reach);
  }
  if (st == DYD_OK) qsort(x->item, x->count, sizeof *x->item, compare_middles);
  if (st == DYD_OK)
    *out = x;
  else
    dyd_near_index_free(x);
  return st;
}

static double chord(const middle *a, const middle *b) {
  double x = a->at[0] - b->at[0], y = a->at[1] - b->at[1], z = a->at[2] - b->at[2];
  return sqrt(x * x + y * y + z * z);
}

/* The first that is not below. */
static size_t index_find(const dyd_near_index *x, double z) {
  size_t lo = 0, hi = x->count;
  while (lo < hi) {
    size_t mid = lo + (hi - lo) / 2;
    if (x->item[mid].at[2] < z)
      lo = mid + 1;
    else
      hi = mid;
  }
  return lo;
}

/* The least of chord and reach: those above and below the place in turn, as long as their heights may be as near. */
static double index_least(const dyd_near_index *x, const middle *here) {
  size_t up = index_find(x, here->at[2]), down = up;
  double least = HUGE_VAL;
  for (bool more = true; more;) {
    more = false;
    if (up < x->count && x->item[up].at[2] - here->at[2] <= least) {
      least = fmin(least, chord(&x->item[up], here) + x->item[up].reach);
      up++;
      more = true;
    }
    if (down > 0 && here->at[2] - x->item[down - 1].at[2] <= least) {
      down--;
      least = fmin(least, chord(&x->item[down], here) + x->item[down].reach);
      more = true;
    }
  }
  return least;
}

dyd_status dyd_sphere_near(dyd_index_list *out, dyd_sphere *s, const dyd_spot_d *at, dyd_error *err) {
  dyd_status st = s->near ? DYD_OK : index_make(&s->near, s, err);
  middle here;
  if (st != DYD_OK) return st;
  const dyd_near_index *x = s->near;
  middle_set(&here, at, DYD_NO_PLACE);
  double most = index_least(x, &here) + 2 * here.reach + 8 * SLACK, high = most + x->widest;
  size_t from = index_find(x, here.at[2] - high), to = index_find(x, here.at[2] + high), n = 0;
  while (to < x->count && x->item[to].at[2] <= here.at[2] + high) to++;
  uint32_t *item = dyd_alloc(to - from, sizeof *item);
  if (!item) return dyd_fail_nomem(err);
  for (size_t k = from; k < to; k++)
    if (chord(&x->item[k], &here) - x->item[k].reach <= most) item[n++] = x->item[k].place;
  qsort(item, n, sizeof *item, dyd_compare_index);
  dyd_index_list_clear(out);
  *out = (dyd_index_list){n, item};
  return DYD_OK;
}
