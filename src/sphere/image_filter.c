/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Images in doubles [FLT-SPH]: the formula of project.c, halved above and below, in intervals.
 *
 * Let u = 2^-53. An angle of x degrees is 90 k more than r degrees, |r| <= 45, exactly (Sterbenz): t = r pi / 180 is
 * off by 2.01 u t, |t| <= 0.7854, z = t^2 <= 0.617 by 1 u more. sin t = t + t z g with g of 8 terms, off by 0.45 u (the
 * leading 1/6 by 2 u, the others, 0.0053 in all, by 21 u), so t z g by 0.6 u t, the sum by 1 u t, the series by
 * 10^-19 t: 4 u t in all. cos t = 1 - z h, h = 1/2 - z ..., off by 1 u, so z h by 1.3 u, the difference by u / 2, by t
 * 1.2 u, the series by 10^-17: 3.1 u in all. TURN_ERROR = 8 u is more, also when added to the sine or cosine and
 * rounded. Between the ends of a box of angles sine and cosine change by its width in radians at most. */
#include "sphere/state.h"

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

bool dyd_filter_sin_cos(dyd_iv *s, dyd_iv *c, dyd_iv x) {
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
  if (!dyd_filter_sin_cos(&sw, &cw, dyd_iv_scale(dyd_iv_sub(lon, eye->lon), 0.5)) ||
      !dyd_filter_sin_cos(&su, &cu, dyd_iv_scale(dyd_iv_sub(lat, eye->lat), 0.5)) || !dyd_filter_sin_cos(&sf, &cf, lat))
    return false;
  dyd_iv across = dyd_iv_mul(cf, dyd_iv_sqr(sw)); /* cos f sin^2(d/2) */
  dyd_iv D = dyd_iv_add(dyd_iv_sqr(su), dyd_iv_mul(eye->cos, across));
  dyd_iv x = dyd_iv_div(dyd_iv_mul(cf, dyd_iv_mul(sw, cw)), D);
  dyd_iv y = dyd_iv_div(dyd_iv_add(dyd_iv_mul(su, cu), dyd_iv_mul(eye->sin, across)), D);
  double scale = 1 + x.lo * x.lo + y.lo * y.lo;
  double most = bits >= 0 && bits <= MOST_BITS ? ldexp(scale, -(int)bits - 1) : 0;
  return span_give(box, x, most) && span_give(box + 2, y, most);
}
