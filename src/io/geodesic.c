/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Great circles as lines and polygons of longitude and latitude, cut at the meridian of 180 degrees.
 *
 * Longitudes are unrolled along a way, each within 180 degrees of the one before. A closed way that does not come back
 * to where it began turns around a pole, the north one if it went east: it is followed twice, closed over the pole, and
 * cut to all longitudes once. Other ways are divided into the parts between -180 + 360 k and 180 + 360 k. A pole on the
 * way is a line of the map, from the longitude where the way comes to where it leaves. A convex region meets each
 * meridian in one piece, so each part is one polygon. */
#include "io/geodesic.h"

#include "base/alloc.h"
#include "base/local.h"
#include <math.h>
#include <string.h>

#define DEGREE 0.017453292519943295
#define PI 3.141592653589793
#define STEP (2 * DEGREE * (1 + 1e-9))
#define ROUND                                                                                                          \
  0x1p-36           /* degrees: 2 micrometres on the earth; places nearer to a pole or to 180 degrees are moved there */
#define NARROW 1e-9 /* degrees: boxes of vertices narrow enough in doubles */
#define LEAST 1e-12 /* radians: ways that are not divided */
#define MOST_TURN 5 /* degrees of longitude from place to place */

typedef struct unit_vector {
  double x, y, z;
} unit_vector;

dyd_lon_lat dyd_lon_lat_of(const double box[4]) {
  if (box[1] - box[0] >= 360 && (box[3] >= 90 || box[2] <= -90)) return (dyd_lon_lat){0, box[3] >= 90 ? 90 : -90};
  return (dyd_lon_lat){box[0] + (box[1] - box[0]) / 2, box[2] + (box[3] - box[2]) / 2};
}

static unit_vector vector_of(dyd_lon_lat p) {
  double lon = p.lon * DEGREE, lat = p.lat * DEGREE;
  return (unit_vector){cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat)};
}

static dyd_lon_lat place_of(unit_vector v) {
  return (dyd_lon_lat){atan2(v.y, v.x) / DEGREE, atan2(v.z, hypot(v.x, v.y)) / DEGREE};
}

static double dot(unit_vector a, unit_vector b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* a - s b */
static unit_vector less(unit_vector a, double s, unit_vector b) {
  return (unit_vector){a.x - s * b.x, a.y - s * b.y, a.z - s * b.z};
}

static unit_vector cross_product(unit_vector a, unit_vector b) {
  return (unit_vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

bool dyd_turns_left(const dyd_lon_lat corner[3]) {
  return dot(vector_of(corner[0]), cross_product(vector_of(corner[1]), vector_of(corner[2]))) > 0;
}

/* Where all on the circle through the corners, counter-clockwise from outside, are equally far. */
static dyd_lon_lat circle_centre(const dyd_lon_lat corner[3]) {
  unit_vector a = vector_of(corner[0]), b = vector_of(corner[1]), c = vector_of(corner[2]);
  return place_of(cross_product(less(b, 1, a), less(c, 1, a)));
}

/* ---- sides ---- */

/* The places of a way; `step`: radians between them at most. */
typedef struct geodesic_way {
  dyd_lon_lat *p;
  size_t count, cap;
  double step;
  dyd_status st;
} geodesic_way;

/* A part of a great circle from u on, towards t. */
typedef struct great_circle {
  unit_vector u, t;
  double angle;
} great_circle;

static void way_put(geodesic_way *w, dyd_lon_lat p) {
  if (!DYD_GROW(w->p, w->cap, w->count + 1))
    w->st = DYD_E_NOMEM;
  else
    w->p[w->count++] = p;
}

static unit_vector of_length_1(unit_vector a) {
  double length = sqrt(dot(a, a));
  return length > 0 ? (unit_vector){a.x / length, a.y / length, a.z / length} : a;
}

static bool is_pole(dyd_lon_lat p) {
  return fabs(p.lat) == 90;
}

/* Something that is not along a. */
static unit_vector aside(unit_vector a) {
  if (fabs(a.z) <= fabs(a.x) && fabs(a.z) <= fabs(a.y)) return (unit_vector){0, 0, 1};
  return fabs(a.x) <= fabs(a.y) ? (unit_vector){1, 0, 0} : (unit_vector){0, 1, 0};
}

/* Long ways by the places they are between: opposite ends decide nothing. */
static great_circle circle_of(const dyd_side *d, bool whole) {
  great_circle g = {.u = vector_of(d->from), .angle = 2 * PI};
  unit_vector w = vector_of(d->to), pole = less(vector_of(d->left), 1, vector_of(d->right));
  if (whole) g.u = of_length_1(cross_product(aside(pole), pole));
  if (whole || (d->between && dot(g.u, w) <= 0))
    g.t = of_length_1(cross_product(pole, g.u));
  else
    g.t = of_length_1(less(less(w, 1, g.u), dot(less(w, 1, g.u), g.u), g.u));
  if (whole) return g;
  if (dot(g.t, g.t) == 0)
    g.t = of_length_1(cross_product(aside(g.u), g.u)); /* opposite places have no shorter way: any */
  g.angle = atan2(dot(w, g.t), dot(w, g.u));
  if (g.angle < 0) g.angle += 2 * PI;
  return g;
}

static dyd_lon_lat at_pole(dyd_lon_lat p) {
  if (90 - fabs(p.lat) < ROUND) p.lat = copysign(90, p.lat);
  return p;
}

static dyd_lon_lat circle_at(const great_circle *g, double angle) {
  double c = cos(angle), s = sin(angle);
  return at_pole(place_of((unit_vector){c * g->u.x + s * g->t.x, c * g->u.y + s * g->t.y, c * g->u.z + s * g->t.z}));
}

/* The places between lo and hi, which are a and b. */
static void way_fill(geodesic_way *w, const great_circle *g, double lo, double hi, dyd_lon_lat a, dyd_lon_lat b) {
  double turn = is_pole(a) || is_pole(b) ? 0 : fabs(remainder(b.lon - a.lon, 360)), mid = lo + (hi - lo) / 2;
  if (hi - lo < LEAST || (hi - lo <= w->step && turn <= MOST_TURN)) return;
  dyd_lon_lat p = circle_at(g, mid);
  way_fill(w, g, lo, mid, a, p);
  way_put(w, p);
  way_fill(w, g, mid, hi, p, b);
}

/* The places of a side but its last. Where it is next to a pole it is divided, so that longitudes turn by less than 180
 * degrees on each piece. */
static void way_divide(geodesic_way *w, const great_circle *g, dyd_lon_lat from, dyd_lon_lat to) {
  double lo = 0, next = atan2(g->t.z, g->u.z) - 2 * PI;
  bool passes = g->angle > PI / 2 || hypot(g->u.z, g->t.z) > 0.9998;
  way_put(w, from);
  for (; passes && next < g->angle - LEAST; next += PI) {
    if (next <= LEAST) continue;
    dyd_lon_lat p = circle_at(g, next);
    way_fill(w, g, lo, next, from, p);
    way_put(w, p);
    lo = next, from = p;
  }
  way_fill(w, g, lo, g->angle, from, to);
}

static bool is_before(dyd_lon_lat a, dyd_lon_lat b) {
  return a.lon != b.lon ? a.lon < b.lon : a.lat < b.lat;
}

/* From both of its sides a side has the same places: those of the way from the lower end, or the lower place. */
static void way_side(geodesic_way *w, const dyd_side *side, bool whole) {
  dyd_side d = {at_pole(side->from), at_pole(side->to), side->between, side->left, side->right};
  bool back = whole ? is_before(d.right, d.left) : is_before(d.to, d.from);
  size_t first = w->count;
  if (back) d = (dyd_side){d.to, d.from, d.between, d.right, d.left};
  great_circle g = circle_of(&d, whole);
  if (whole) d.from = d.to = circle_at(&g, 0);
  way_divide(w, &g, d.from, d.to);
  if (!back) return;
  way_put(w, d.to);
  for (size_t k = first, l = w->count; k + 1 < l; k++) {
    dyd_lon_lat p = w->p[k];
    w->p[k] = w->p[--l];
    w->p[l] = p;
  }
  w->count -= w->st == DYD_OK;
}

dyd_status dyd_side_places(dyd_lon_lat **out, size_t *count, const dyd_side *side, bool whole) {
  geodesic_way w = {.step = STEP};
  way_side(&w, side, whole);
  way_put(&w, whole && w.count ? w.p[0] : at_pole(side->to));
  for (size_t k = 0; k < w.count && w.count > 1; k++) /* a pole has the longitude of the place next to it */
    if (is_pole(w.p[k])) w.p[k].lon = w.p[k ? k - 1 : 1].lon;
  if (w.st != DYD_OK) free(w.p);
  *out = w.st == DYD_OK ? w.p : NULL;
  *count = w.st == DYD_OK ? w.count : 0;
  return w.st;
}

/* ---- unrolled and cut ---- */

/* How far east it is from a to b; along a pole, with the inside of the way, on its left, between them. */
static double step_east(dyd_lon_lat a, dyd_lon_lat b) {
  double step = remainder(b.lon - a.lon, 360);
  if (!is_pole(a) || a.lat != b.lat || step * a.lat <= 0) return step;
  return step - copysign(360, step);
}

static void way_unroll(dyd_lon_lat *p, size_t n) {
  for (size_t k = 1; k < n; k++)
    p[k].lon += 360 * nearbyint((p[k - 1].lon + step_east(p[k - 1], p[k]) - p[k].lon) / 360);
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
static void place_near(dyd_short_place *out, double lon, double lat) {
  double x = fabs(lon) == 180 ? 0 : ROUND, y = fabs(lat) == 90 ? 0 : ROUND;
  dyd_short_place_set(out, (const double[]){lon - x, lon + x, lat - y, lat + y});
}

static void row_at_place(dyd_table *t, double lon, double lat) {
  dyd_short_place place;
  place_near(&place, lon, lat);
  dyd_row_place(t, &place);
}

/* Where the way from a to b has this longitude. */
static dyd_lon_lat way_cut(dyd_lon_lat a, dyd_lon_lat b, double lon) {
  return (dyd_lon_lat){lon, a.lat + (b.lat - a.lat) * (lon - a.lon) / (b.lon - a.lon)};
}

/* A place of the way; its ends are the boxes given. */
static void arc_put(dyd_table *t, const dyd_lon_lat *p, size_t k, size_t n, double turn, const double *const end[2]) {
  const double *box = k == 0 ? end[0] : k + 1 == n ? end[1] : NULL;
  if (box && dyd_lon_lat_of(box).lon == p[k].lon - turn)
    dyd_row_at(t, box);
  else
    row_at_place(t, p[k].lon - turn, p[k].lat);
}

dyd_status dyd_row_arc(dyd_table *t, const double a[4], const double b[4]) {
  const dyd_side side = {.from = dyd_lon_lat_of(a), .to = dyd_lon_lat_of(b)};
  const double *const end[2] = {a, b};
  DYD_FREED dyd_lon_lat *p = NULL;
  size_t n = 0;
  int strip[2];
  dyd_status st = dyd_side_places(&p, &n, &side, false);
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
  return DYD_OK;
}

/* Keeps the part of a closed way on one side of the longitude (1: east); returns the number of places. */
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

/* ---- polygons ---- */

static bool is_same_place(dyd_lon_lat a, dyd_lon_lat b) {
  return a.lat == b.lat && (a.lon == b.lon || is_pole(a));
}

/* Each place once, poles with the longitudes before and behind; closed. */
static void way_close(geodesic_way *out, const geodesic_way *w) {
  size_t n = 0, kept = 0;
  for (size_t k = 0; k < w->count; k++)
    if (!kept || !is_same_place(w->p[kept - 1], w->p[k])) w->p[kept++] = w->p[k];
  while (kept > 1 && is_same_place(w->p[kept - 1], w->p[0])) kept--;
  for (n = 0; n < kept; n++) {
    dyd_lon_lat p = w->p[n], before = w->p[n ? n - 1 : kept - 1], behind = w->p[n + 1 < kept ? n + 1 : 0];
    if (is_pole(p)) way_put(out, (dyd_lon_lat){before.lon, p.lat});
    way_put(out, is_pole(p) ? (dyd_lon_lat){behind.lon, p.lat} : p);
  }
  if (kept) way_put(out, out->count ? out->p[0] : w->p[0]);
}

/* Longitudes next to the edge of the map are on it. */
static void way_settle(geodesic_way *w) {
  for (size_t k = 0; k < w->count; k++) {
    double edge = 180 + 360 * nearbyint((w->p[k].lon - 180) / 360);
    if (fabs(w->p[k].lon - edge) < ROUND) w->p[k].lon = edge;
  }
}

/* Followed a second time, and closed over the pole. */
static void way_close_pole(geodesic_way *w) {
  size_t n = w->count;
  double from = w->p[0].lon, turn = w->p[n - 1].lon - from, pole = turn > 0 ? 90 : -90;
  for (size_t k = 1; k < n && w->st == DYD_OK; k++) way_put(w, (dyd_lon_lat){w->p[k].lon + turn, w->p[k].lat});
  way_put(w, (dyd_lon_lat){from + 2 * turn, pole});
  way_put(w, (dyd_lon_lat){from, pole});
}

static bool places_agree(const dyd_short_place *a, const dyd_short_place *b, int axis) {
  return a->length[axis] == b->length[axis] && memcmp(axis ? a->y : a->x, axis ? b->y : b->x, a->length[axis]) == 0;
}

/* A part, unless it has no area in the digits that it is written with. */
static void part_put(dyd_table *t, dyd_short_place *place, const dyd_lon_lat *p, size_t n, double turn) {
  size_t count = 0;
  bool flat[2] = {true, true};
  for (size_t k = 0; k < n; k++) {
    place_near(&place[count], p[k].lon - turn, p[k].lat);
    const dyd_short_place *last = count ? &place[count - 1] : NULL;
    if (!last || !places_agree(last, &place[count], 0) || !places_agree(last, &place[count], 1)) count++;
  }
  while (count > 1 && places_agree(place, &place[count - 1], 0) && places_agree(place, &place[count - 1], 1)) count--;
  for (size_t k = 1; k < count; k++)
    for (int a = 0; a < 2; a++) flat[a] = flat[a] && places_agree(place, &place[k], a);
  if (count < 3 || flat[0] || flat[1]) return;
  dyd_row_part(t);
  for (size_t k = 0; k <= count; k++) dyd_row_place(t, &place[k % count]);
}

/* The parts of a closed way: in every strip that it touches, or, closed over a pole, in one. */
static dyd_status around_put(dyd_table *t, const geodesic_way *w, bool pole) {
  size_t room = 4 * w->count + 16;
  dyd_lon_lat *work = dyd_alloc(room, 2 * sizeof *work);
  dyd_short_place *place = dyd_alloc(room, sizeof *place);
  int strip[2];
  strips_of(strip, w->p, w->count);
  if (pole) { /* the first that begins on it */
    double lo = fmin(w->p[w->count - 1].lon, w->p[w->count - 2].lon);
    strip[0] = strip[1] = -strip_of(-lo - 360);
  }
  for (int k = strip[0]; k <= strip[1] && work && place; k++) {
    size_t m = around_clip(work, w->p, w->count, 360.0 * k - 180, 1);
    m = around_clip(work + room, work, m, 360.0 * k + 180, -1);
    part_put(t, place, work + room, m, 360.0 * k);
  }
  dyd_status st = work && place ? DYD_OK : DYD_E_NOMEM;
  dyd_free_all(place, work);
  return st;
}

static dyd_status globe_put(dyd_table *t) {
  dyd_row_part(t);
  dyd_row_outline(t, (const double[]){-180, 180, -90, 90});
  return DYD_OK;
}

dyd_status dyd_row_around(dyd_table *t, const dyd_side *side, size_t sides, double most) {
  geodesic_way w = {.step = most * DEGREE * (1 + 1e-9)}, closed = {0};
  if (!sides) return globe_put(t);
  for (size_t k = 0; k < sides; k++) way_side(&w, &side[k], sides == 1);
  dyd_status st = w.st;
  if (st == DYD_OK) way_close(&closed, &w);
  if (st == DYD_OK) st = closed.st;
  if (st == DYD_OK && closed.count > 3) {
    way_unroll(closed.p, closed.count);
    way_settle(&closed);
    bool pole = fabs(closed.p[closed.count - 1].lon - closed.p[0].lon) > 180;
    if (pole)
      way_close_pole(&closed);
    else
      closed.count--;
    st = closed.st == DYD_OK ? around_put(t, &closed, pole) : closed.st;
  }
  dyd_free_all(closed.p, w.p);
  return st;
}

/* ---- Voronoi cells ---- */

/* Around a place i, counter-clockwise, the face (i, a, .., b), a triangle or the sites of a circle in its order, is
 * followed by (i, b, .., c). So its faces, sorted by a, are walked by looking up b; a walk that ends has an undecided
 * region behind its end. */

/* The face of `node` seen from a corner: the next one is a, the one before b. */
typedef struct corner_view {
  uint32_t at, a, b, node;
  bool has_before, used;
} corner_view;

/* Faces as they are found. */
typedef struct face_list {
  dyd_sphere_node *node;
  corner_view *view;
  size_t nodes, node_cap, views, view_cap;
} face_list;

void dyd_sphere_cells_clear(dyd_sphere_cells *c) {
  dyd_free_all(c->node, c->first, c->of, c->beyond, c->gap, c->closed, c->middle);
  *c = (dyd_sphere_cells){0};
}

static int compare_views(const void *p, const void *q) {
  const corner_view *x = p, *y = q;
  if (x->at != y->at) return x->at < y->at ? -1 : 1;
  return (x->a > y->a) - (x->a < y->a);
}

static corner_view *view_find(corner_view *view, size_t count, uint32_t at, uint32_t a) {
  const corner_view key = {.at = at, .a = a};
  return count ? bsearch(&key, view, count, sizeof key, compare_views) : NULL;
}

/* Lists the chain from `from` on; returns how many, and whether it came back. */
static size_t nodes_walk(bool *cycle, dyd_sphere_cells *c, size_t n, corner_view *view, size_t count,
                         corner_view *from) {
  corner_view *v = from;
  size_t begin = n;
  for (; v && !v->used; v = view_find(view, count, v->at, v->b)) {
    v->used = true;
    c->gap[n] = false;
    c->beyond[n] = v->b;
    c->of[n++] = v->node;
  }
  *cycle = v == from;
  c->gap[begin] = !*cycle;
  return n;
}

/* The cell seen in view[0 .. count-1]: first the chains that have a beginning, then cycles. */
static size_t cell_walk(dyd_sphere_cells *c, size_t n, corner_view *view, size_t count) {
  bool cycle = false, all = count > 0;
  for (size_t k = 0; k < count; k++) {
    corner_view *next = view_find(view, count, view[k].at, view[k].b);
    if (next) next->has_before = true;
  }
  for (int pass = 0; pass < 2; pass++)
    for (size_t k = 0; k < count; k++) {
      if (view[k].used || (pass == 0 && view[k].has_before)) continue;
      n = nodes_walk(&cycle, c, n, view, count, &view[k]);
      all = all && cycle;
    }
  if (count) c->closed[view[0].at] = all;
  return n;
}

static void cells_walk(dyd_sphere_cells *c, corner_view *view, size_t count) {
  size_t n = 0, k = 0;
  if (count) qsort(view, count, sizeof *view, compare_views);
  for (size_t i = 0; i < c->places; i++) {
    size_t begin = k;
    c->first[i] = n;
    while (k < count && view[k].at == i) k++;
    n = cell_walk(c, n, view + begin, k - begin);
  }
  c->first[c->places] = n;
}

/* A face by its sites; the vertex is found from three of them, far apart in the order. */
static dyd_status face_put(void *user, dyd_group_kind kind, const dyd_index_list *l) {
  face_list *f = user;
  (void)kind;
  if (!DYD_GROW(f->node, f->node_cap, f->nodes + 1) || !DYD_GROW(f->view, f->view_cap, f->views + l->count))
    return DYD_E_NOMEM;
  f->node[f->nodes].of = (dyd_triangle){{l->item[0], l->item[l->count / 3], l->item[2 * l->count / 3]}};
  for (size_t k = 0; k < l->count; k++)
    f->view[f->views++] = (corner_view){.at = l->item[k],
                                        .a = l->item[k + 1 < l->count ? k + 1 : 0],
                                        .b = l->item[k ? k - 1 : l->count - 1],
                                        .node = (uint32_t)f->nodes};
  f->nodes++;
  return DYD_OK;
}

static dyd_status faces_find(face_list *f, const dyd_sphere *s) {
  DYD_SCOPED(dyd_triangle_list) t = {0};
  dyd_status st = dyd_sphere_triangles(&t, s);
  for (size_t k = 0; k < t.count && st == DYD_OK; k++)
    st = face_put(f, DYD_GROUP_CIRCLE, &(dyd_index_list){3, t.item[k].v});
  return st == DYD_OK ? dyd_sphere_each_circle(s, face_put, f) : st;
}

/* Of one place it is the globe, wherever the place is; of two, its halves, which are known if both places are. */
static dyd_status cells_close(dyd_sphere_cells *c, const dyd_sphere *s) {
  dyd_status st = DYD_OK;
  size_t sites = 0, exact = 0;
  DYD_LOCAL(dyd_rect, r);
  for (uint32_t i = 0; i < c->places && sites < 3 && st == DYD_OK; i++) {
    if (dyd_sphere_alias(s, i) != i) continue;
    st = dyd_sphere_rect(&r, s, i);
    exact += dyd_rect_is_point(&r);
    sites++;
  }
  for (size_t i = 0; i < c->places && (sites == 1 || (sites == 2 && exact == 2)); i++) c->closed[i] = true;
  return st;
}

static dyd_status middles_find(dyd_sphere_cells *c, const dyd_sphere *s) {
  DYD_FREED double(*box)[4] = NULL;
  dyd_status st = dyd_sphere_boxes(&box, s);
  c->middle = st == DYD_OK ? dyd_alloc(c->places, sizeof *c->middle) : NULL;
  for (size_t i = 0; i < c->places && c->middle; i++) c->middle[i] = dyd_lon_lat_of(box[i]);
  return st == DYD_OK && !c->middle ? DYD_E_NOMEM : st;
}

/* Boxes wider than NARROW are wider than the error of doubles: there the vertex of the middles is computed. */
static dyd_status nodes_find(dyd_sphere_cells *c, const dyd_sphere *s, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < c->nodes && st == DYD_OK; k++) {
    dyd_sphere_node *v = &c->node[k];
    st = dyd_sphere_vertex(v->box, s, &v->of, err);
    v->at = dyd_lon_lat_of(v->box);
    bool wide = v->box[1] - v->box[0] > NARROW || v->box[3] - v->box[2] > NARROW;
    if (!wide || (v->box[3] - v->box[2] <= NARROW && v->box[1] - v->box[0] >= 360)) continue;
    const dyd_lon_lat corner[3] = {c->middle[v->of.v[0]], c->middle[v->of.v[1]], c->middle[v->of.v[2]]};
    v->at = circle_centre(corner);
  }
  return st;
}

dyd_status dyd_sphere_cells_find(dyd_sphere_cells *c, const dyd_sphere *s, dyd_error *err) {
  face_list f = {0};
  dyd_status st = faces_find(&f, s);
  c->places = dyd_engine_count(dyd_sphere_places(s));
  c->nodes = f.nodes;
  c->node = f.node;
  c->first = dyd_alloc(c->places + 1, sizeof *c->first);
  c->of = dyd_alloc(f.views, sizeof *c->of);
  c->beyond = dyd_alloc(f.views, sizeof *c->beyond);
  c->gap = dyd_alloc(f.views, sizeof *c->gap);
  c->closed = calloc(c->places + 1, sizeof *c->closed);
  if (st == DYD_OK && !(c->first && c->of && c->beyond && c->gap && c->closed)) st = DYD_E_NOMEM;
  if (st == DYD_OK) st = middles_find(c, s);
  if (st == DYD_OK) st = nodes_find(c, s, err);
  if (st == DYD_OK) cells_walk(c, f.view, f.views);
  free(f.view);
  return st == DYD_OK ? cells_close(c, s) : st;
}

dyd_side dyd_sphere_cell_side(const dyd_sphere_cells *c, uint32_t i, size_t k) {
  size_t from = c->first[i] + k, to = from + 1 < c->first[i + 1] ? from + 1 : c->first[i];
  return (dyd_side){c->node[c->of[from]].at, c->node[c->of[to]].at, true, c->middle[i], c->middle[c->beyond[from]]};
}

bool dyd_sphere_cell_is_half(dyd_side *out, const dyd_sphere_cells *c, const dyd_sphere *s, uint32_t i) {
  uint32_t j = 0;
  if (!c->closed[i] || c->first[i] < c->first[i + 1]) return false;
  while (j < c->places && dyd_sphere_alias(s, j) == dyd_sphere_alias(s, i)) j++;
  if (j < c->places) *out = (dyd_side){.between = true, .left = c->middle[i], .right = c->middle[j]};
  return j < c->places;
}
