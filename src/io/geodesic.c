/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Great circles as lines and polygons of longitude and latitude, cut at the meridian of 180 degrees.
 *
 * Longitudes are unrolled along a way, each within 180 degrees of the one before. A closed way that does not come back
 * to where it began turns around a pole, the north one if it went east, and is closed over it. What lies between
 * -180 + 360 k and 180 + 360 k is a part. */
#include "io/geodesic.h"

#include "base/alloc.h"
#include <math.h>
#include <string.h>

#define DEGREE 0.017453292519943295
#define STEP (2 * DEGREE)
#define ROUND 0x1p-32     /* degrees: less than a tenth of a millimetre on the earth */
enum { MOST_STEPS = 92 }; /* of a way of 180 degrees, roundings included */

typedef struct unit_vector {
  double x, y, z;
} unit_vector;

dyd_lon_lat dyd_lon_lat_of(const double box[4]) {
  return (dyd_lon_lat){box[0] + (box[1] - box[0]) / 2, box[2] + (box[3] - box[2]) / 2};
}

static unit_vector vector_of(dyd_lon_lat p) {
  double lon = p.lon * DEGREE, lat = p.lat * DEGREE;
  return (unit_vector){cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat)};
}

static dyd_lon_lat place_of(unit_vector v) {
  return (dyd_lon_lat){atan2(v.y, v.x) / DEGREE, atan2(v.z, hypot(v.x, v.y)) / DEGREE};
}

static double angle_between(unit_vector a, unit_vector b) {
  double x = a.y * b.z - a.z * b.y, y = a.z * b.x - a.x * b.z, z = a.x * b.y - a.y * b.x;
  return atan2(sqrt(x * x + y * y + z * z), a.x * b.x + a.y * b.y + a.z * b.z);
}

bool dyd_turns_left(const dyd_lon_lat corner[3]) {
  unit_vector a = vector_of(corner[0]), b = vector_of(corner[1]), c = vector_of(corner[2]);
  return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x) > 0;
}

/* The place at the share s of the way from a to b, an angle apart. Opposite places have no shorter way: any. */
static dyd_lon_lat way_at(unit_vector a, unit_vector b, double angle, double s) {
  double p = sin((1 - s) * angle), q = sin(s * angle);
  return place_of((unit_vector){p * a.x + q * b.x, p * a.y + q * b.y, p * a.z + q * b.z});
}

/* A pole has the longitude of who is next to it. */
static void ways_mend_poles(dyd_lon_lat *p, size_t n) {
  for (size_t k = 0; k < n && n > 1; k++)
    if (fabs(p[k].lat) >= 90) p[k].lon = p[k ? k - 1 : 1].lon;
}

dyd_status dyd_great_circles(dyd_lon_lat **out, size_t *count, const dyd_lon_lat *corner, size_t corners) {
  dyd_lon_lat *p = dyd_alloc(corners * MOST_STEPS + 1, sizeof *p);
  size_t n = 0;
  if (!p) return DYD_E_NOMEM;
  for (size_t k = 0; k + 1 < corners; k++) {
    unit_vector a = vector_of(corner[k]), b = vector_of(corner[k + 1]);
    double angle = angle_between(a, b), steps = ceil(angle / STEP);
    p[n++] = corner[k];
    for (double s = 1; s < steps; s++) p[n++] = way_at(a, b, angle, s / steps);
  }
  if (corners) p[n++] = corner[corners - 1];
  ways_mend_poles(p, n);
  *out = p;
  *count = n;
  return DYD_OK;
}

/* ---- unrolled and cut ---- */

/* Returns the turns made. */
static double way_unroll(dyd_lon_lat *p, size_t n) {
  double turns = 0;
  for (size_t k = 1; k < n; k++) {
    double step = p[k].lon + 360 * turns - p[k - 1].lon;
    turns -= step > 180 ? 1 : step < -180 ? -1 : 0;
    p[k].lon += 360 * turns;
  }
  return turns;
}

static int strip_of(double lon) {
  return (int)floor((lon + 180) / 360);
}

/* The strips that a way touches with more than its edge. */
static void strips_of(int strip[2], const dyd_lon_lat *p, size_t n) {
  double lo = INFINITY, hi = -INFINITY;
  for (size_t k = 0; k < n; k++) lo = fmin(lo, p[k].lon), hi = fmax(hi, p[k].lon);
  strip[0] = strip_of(lo);
  strip[1] = hi > lo ? -strip_of(-hi) : strip[0];
}

/* A place on the way, in few digits; on the edge of the map, or at a pole, exactly. */
static void row_at_place(dyd_table *t, double lon, double lat) {
  double x = fabs(lon) == 180 ? 0 : ROUND, y = fabs(lat) == 90 ? 0 : ROUND;
  dyd_row_at(t, (const double[]){lon - x, lon + x, lat - y, lat + y});
}

/* Where the way from a to b has this longitude. */
static dyd_lon_lat way_cut(dyd_lon_lat a, dyd_lon_lat b, double lon) {
  return (dyd_lon_lat){lon, a.lat + (b.lat - a.lat) * (lon - a.lon) / (b.lon - a.lon)};
}

/* A place of the way: its ends are what they stand for. */
static void arc_put(dyd_table *t, const dyd_lon_lat *p, size_t k, size_t n, double turn, const double *const end[2]) {
  const double *box = k == 0 ? end[0] : k + 1 == n ? end[1] : NULL;
  if (box && dyd_lon_lat_of(box).lon == p[k].lon - turn)
    dyd_row_at(t, box);
  else
    row_at_place(t, p[k].lon - turn, p[k].lat);
}

dyd_status dyd_row_arc(dyd_table *t, const double a[4], const double b[4]) {
  const dyd_lon_lat corner[2] = {dyd_lon_lat_of(a), dyd_lon_lat_of(b)};
  const double *const end[2] = {a, b};
  dyd_lon_lat *p = NULL;
  size_t n = 0;
  int strip[2];
  dyd_status st = dyd_great_circles(&p, &n, corner, 2);
  if (st != DYD_OK) return st;
  way_unroll(p, n);
  strips_of(strip, p, n);
  for (int k = strip[0]; k <= strip[1]; k++) {
    double lo = 360.0 * k - 180, hi = lo + 360, turn = 360.0 * k;
    bool begun = false;
    for (size_t l = 0; l < n; l++) {
      bool inside = p[l].lon >= lo && p[l].lon <= hi;
      double edge = l && p[l].lon + p[l - 1].lon > 2 * turn ? hi : lo;
      bool crosses = l && (p[l].lon - edge) * (p[l - 1].lon - edge) < 0;
      if (!begun && (inside || crosses)) dyd_row_part(t), begun = true;
      if (crosses) row_at_place(t, edge - turn, way_cut(p[l - 1], p[l], edge).lat);
      if (inside) arc_put(t, p, l, n, turn, end);
    }
  }
  free(p);
  return DYD_OK;
}

/* Keeps what is on the side of the longitude (side 1: east of it) of a closed way; returns how many places. */
static size_t around_clip(dyd_lon_lat *out, const dyd_lon_lat *p, size_t n, double lon, int side) {
  size_t count = 0;
  for (size_t k = 0; k < n; k++) {
    dyd_lon_lat a = p[k], b = p[k + 1 < n ? k + 1 : 0];
    double da = side * (a.lon - lon), db = side * (b.lon - lon);
    if (da >= 0) out[count++] = a;
    if (da * db < 0) out[count++] = way_cut(a, b, lon);
  }
  return count;
}

/* p[0 .. n-1], a closed way, with room for 2 * n + 4 in each of work[]. */
static void around_put(dyd_table *t, const dyd_lon_lat *p, size_t n, dyd_lon_lat *const work[2]) {
  int strip[2];
  strips_of(strip, p, n);
  for (int k = strip[0]; k <= strip[1]; k++) {
    size_t m = around_clip(work[0], p, n, 360.0 * k - 180, 1);
    m = around_clip(work[1], work[0], m, 360.0 * k + 180, -1);
    if (m < 3) continue;
    dyd_row_part(t);
    for (size_t l = 0; l <= m; l++) row_at_place(t, work[1][l % m].lon - 360.0 * k, work[1][l % m].lat);
  }
}

dyd_status dyd_row_around(dyd_table *t, const dyd_lon_lat *corner, size_t corners) {
  dyd_lon_lat *p = NULL, *work[2], *closed = dyd_alloc(corners + 1, sizeof *closed);
  size_t n = 0;
  if (!closed) return DYD_E_NOMEM;
  for (size_t k = 0; k <= corners; k++) closed[k] = corner[k % corners];
  dyd_status st = dyd_great_circles(&p, &n, closed, corners + 1);
  size_t room = 4 * n + 16;
  dyd_lon_lat *all = st == DYD_OK ? dyd_alloc(room, 3 * sizeof *all) : NULL;
  if (all) {
    work[0] = all + room, work[1] = all + 2 * room;
    memcpy(all, p, n * sizeof *all);
    double turns = way_unroll(all, n);
    if (turns != 0) { /* closed over the pole */
      double pole = turns > 0 ? 90 : -90, from = all[0].lon, to = all[n - 1].lon;
      all[n++] = (dyd_lon_lat){to, pole};
      all[n++] = (dyd_lon_lat){from, pole};
    }
    around_put(t, all, n, work);
  }
  free(all);
  free(p);
  free(closed);
  return all ? DYD_OK : DYD_E_NOMEM;
}
