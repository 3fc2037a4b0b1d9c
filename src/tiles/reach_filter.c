/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Chains around the possible cell of a site, in doubles [REACH-1].
 *
 * Coordinates are relative to the lower left corner o of the site's box: differences of two doubles, each wrong by
 * 2^-53 of itself at most, also below the least normal number. Knots of the chain are whatever doubles come out of the
 * construction, which proves nothing; the claims are checked (spoke_is_nearer, spoke_is_beyond, knots_turn)
 * with margins above the errors: a sum of products of such differences and of sums of two is wrong by less than 2^-49
 * of the same sum of absolute values, and by 2^-1070 where products underflow. Comparisons are such that NaN and
 * infinities fail them: nothing is above an infinite bound. */
#include "tiles/tiles.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

static const double MARGIN = 0x1p-48, TINY = 0x1p-1000;

/* A partner: where its middle is, seen from that of the site; how far both go from their middles; half the square of
 * the distance of its farthest point. All centres c with c.m - |c.x| halfx - |c.y| halfy > far are certainly nearer to
 * it: in one quadrant c.n > far, n the corner of their difference for the quadrant, and (x, y) = n / far is the pole of
 * this line. number 0 is not a partner: its pole is 0. */
typedef struct tiles_spoke {
  double mx, my, half[2], far;
  double nx, ny, x, y; /* of the quadrant at work */
  size_t number;
  bool gap; /* no partner bounds the cell between the one before and this one */
  tiles_box box;
} tiles_spoke;

/* Of a chain: a place, or (far) a direction. */
typedef struct tiles_knot {
  double x, y;
  bool far;
} tiles_knot;

typedef struct reach_work {
  tiles_reach *out;
  size_t spokes, border, knots;
  tiles_box own;
  double cx, cy; /* the middle of the site */
  bool thick;    /* there are rectangles */
} reach_work;

/* ---- checks ---- */

static tiles_box reach_box(const tiles_box *b, double ox, double oy) {
  return (tiles_box){b->x0 - ox, b->x1 - ox, b->y0 - oy, b->y1 - oy};
}

/* Adds the least 2 c (y - x) - y^2 + x^2 over y in [k0, k1], x in [i0, i1], and the sizes of its terms. */
static void add_gain(double *gain, double *size, double c, double k0, double k1, double i0, double i1) {
  double a = k0 * (2 * c - k0), b = k1 * (2 * c - k1), x = c < i0 ? i0 : c > i1 ? i1 : c;
  *gain += (a < b ? a : b) + x * (x - 2 * c);
  *size +=
      fabs(k0) * (2 * fabs(c) + fabs(k0)) + fabs(k1) * (2 * fabs(c) + fabs(k1)) + fabs(x) * (fabs(x) + 2 * fabs(c));
}

/* Returns true if the spoke's box is certainly nearer to (x, y) than the own one. */
static bool spoke_is_nearer(const tiles_spoke *s, const tiles_box *own, double x, double y) {
  double gain = 0, size = 0;
  add_gain(&gain, &size, x, s->box.x0, s->box.x1, own->x0, own->x1);
  add_gain(&gain, &size, y, s->box.y0, s->box.y1, own->y0, own->y1);
  return size > TINY && gain > MARGIN * size;
}

static double least_in(const tiles_box *b, double ux, double uy) {
  return fmin(ux * b->x0, ux * b->x1) + fmin(uy * b->y0, uy * b->y1);
}

static double size_in(const tiles_box *b, double ux, double uy) {
  return fabs(ux) * fmax(fabs(b->x0), fabs(b->x1)) + fabs(uy) * fmax(fabs(b->y0), fabs(b->y1));
}

/* Returns true if it is certainly beyond the own one in direction u. */
static bool spoke_is_beyond(const tiles_spoke *s, const tiles_box *own, double ux, double uy) {
  double gain = least_in(&s->box, ux, uy) + least_in(own, -ux, -uy);
  double size = size_in(&s->box, ux, uy) + size_in(own, ux, uy);
  return size > TINY && gain > MARGIN * size;
}

/* Seen from the middle of the site. */
static bool knots_turn(const reach_work *w, const tiles_knot *a, const tiles_knot *b) {
  double ax = a->far ? a->x : a->x - w->cx, ay = a->far ? a->y : a->y - w->cy;
  double bx = b->far ? b->x : b->x - w->cx, by = b->far ? b->y : b->y - w->cy;
  double p = ax * by, q = ay * bx, size = fabs(p) + fabs(q);
  return size > TINY && p - q > MARGIN * size;
}

/* ---- the construction ---- */

static double reach_cross(double ax, double ay, double bx, double by) {
  return ax * by - ay * bx;
}

static bool reach_knot(reach_work *w, double x, double y, bool far) {
  tiles_reach *r = w->out;
  if (!DYD_GROW(r->knot, r->cap_knot, w->knots + 1)) return false;
  r->knot[w->knots++] = (tiles_knot){x, y, far};
  return true;
}

/* The corner k of what the two rectangles are apart. */
static void spoke_corner(double at[2], const tiles_spoke *s, int k) {
  at[0] = s->mx + (k & 1 ? s->half[0] : -s->half[0]);
  at[1] = s->my + (k & 2 ? s->half[1] : -s->half[1]);
}

/* The end of the bisector with the spoke, left or right of it as seen from the site: square to the corner that is
 * farthest on the other side, turned towards the spoke as far as is needed. */
static bool spoke_end(double u[2], const reach_work *w, const tiles_spoke *s, double side) {
  double c[2] = {s->mx, s->my}, other[2];
  for (int k = 0; k < 4; k++) {
    spoke_corner(other, s, k);
    if (side * reach_cross(c[0], c[1], other[0], other[1]) >= 0) continue;
    c[0] = other[0];
    c[1] = other[1];
  }
  for (double tilt = 0x1p-40; tilt < 64; tilt *= tilt < 0x1p-8 ? 16 : 1.5) {
    u[0] = tilt * s->mx - side * c[1];
    u[1] = tilt * s->my + side * c[0];
    if (spoke_is_beyond(s, &w->own, u[0], u[1])) return true;
  }
  return false;
}

/* Where the lines of two spokes meet, pushed outward until it is certainly nearer to both; or, too far away for good
 * bounds, the direction. */
static bool spokes_meet(tiles_knot *c, const reach_work *w, const tiles_spoke *a, const tiles_spoke *b) {
  double turn = reach_cross(a->nx, a->ny, b->nx, b->ny);
  if (!(turn > 0)) return false;
  double x = (a->far * b->ny - b->far * a->ny) / turn, y = (a->nx * b->far - b->nx * a->far) / turn;
  if (!(x * x + y * y < 0x1p48 * (a->far + b->far))) {
    *c = (tiles_knot){x, y, true};
    return spoke_is_beyond(a, &w->own, x, y) && spoke_is_beyond(b, &w->own, x, y);
  }
  for (double push = 0x1p-44; push < 4; push *= push < 0x1p-8 ? 16 : 1.5) {
    *c = (tiles_knot){w->cx + x * (1 + push), w->cy + y * (1 + push), false};
    if (spoke_is_nearer(a, &w->own, c->x, c->y) && spoke_is_nearer(b, &w->own, c->x, c->y)) return true;
  }
  return false;
}

/* The directions in which the cell is unbounded. */
static bool reach_ends(bool *fits, reach_work *w, const tiles_spoke *a, const tiles_spoke *b) {
  double last[2], first[2];
  *fits = spoke_end(last, w, a, 1) && spoke_end(first, w, b, -1);
  if (!*fits) return true;
  tiles_knot l = {last[0], last[1], true}, f = {first[0], first[1], true};
  return reach_knot(w, last[0], last[1], true) && (knots_turn(w, &l, &f) || reach_knot(w, -last[1], last[0], true)) &&
         reach_knot(w, first[0], first[1], true);
}

/* Knots between the spokes a and b. *fits = false: none. */
static bool reach_between(bool *fits, reach_work *w, const tiles_spoke *a, const tiles_spoke *b) {
  tiles_knot c;
  if (a->number == b->number && !b->gap) return true;
  if (!b->gap && spokes_meet(&c, w, a, b)) return reach_knot(w, c.x, c.y, c.far);
  return reach_ends(fits, w, a, b);
}

static int compare_spokes(const void *a, const void *b) {
  const tiles_spoke *p = a, *q = b;
  if (p->x != q->x) return p->x < q->x ? -1 : 1;
  return (p->y > q->y) - (p->y < q->y);
}

static void sort_spokes(tiles_spoke *s, size_t n) {
  if (n > 24) {
    qsort(s, n, sizeof *s, compare_spokes);
    return;
  }
  for (size_t k = 1; k < n; k++) {
    tiles_spoke moved = s[k];
    size_t at = k;
    for (; at > 0 && compare_spokes(&s[at - 1], &moved) > 0; at--) s[at] = s[at - 1];
    s[at] = moved;
  }
}

/* Half a hull: after s[from .. at-1], s[k] instead of the entries that it makes needless. */
static size_t hull_push(tiles_spoke *s, size_t from, size_t at, const tiles_spoke *next) {
  while (at >= from + 2 && !(reach_cross(s[at - 1].x - s[at - 2].x, s[at - 1].y - s[at - 2].y, next->x - s[at - 2].x,
                                         next->y - s[at - 2].y) > 0))
    at--;
  s[at] = *next;
  return at + 1;
}

/* The lines on the border of a cell: their poles are the corners of a convex hull with 0, counter-clockwise. */
static size_t hull_of_spokes(tiles_spoke *out, tiles_spoke *s, size_t n) {
  size_t at = 0;
  sort_spokes(s, n);
  for (size_t k = 0; k < n; k++) at = hull_push(out, 0, at, &s[k]);
  size_t from = at - 1;
  for (size_t k = n - 1; k-- > 0;) at = hull_push(out, from, at, &s[k]);
  return n == 1 ? 1 : at - 1;
}

/* Spokes; then space for those of a quadrant, for their hull, and for the border. */
static bool reach_spokes(reach_work *w, const tiles_view *v, uint32_t i, const tiles_partners *p) {
  enum { PARTS = 8 };
  tiles_reach *r = w->out;
  if (!DYD_GROW(r->spoke, r->cap_spoke, PARTS * (p->count + 1))) return false;
  tiles_box own = tiles_view_box(v, i);
  w->own = reach_box(&own, own.x0, own.y0);
  w->cx = w->own.x1 / 2;
  w->cy = w->own.y1 / 2;
  r->spoke[w->spokes++] = (tiles_spoke){.far = 1};
  for (size_t k = 0; k < p->count; k++) {
    tiles_box far = tiles_view_box(v, TILES_SITE(p->item[k])), box = reach_box(&far, own.x0, own.y0);
    if (tiles_boxes_meet(&box, &w->own)) continue;
    const bool points = tiles_box_is_point(&far) && tiles_box_is_point(&own);
    tiles_spoke s = {.mx = (box.x0 + box.x1) / 2 - w->cx, .my = (box.y0 + box.y1) / 2 - w->cy, .box = box};
    if (!points) s.half[0] = (box.x1 - box.x0 + w->own.x1) / 2;
    if (!points) s.half[1] = (box.y1 - box.y0 + w->own.y1) / 2;
    double x = fabs(s.mx) + s.half[0], y = fabs(s.my) + s.half[1];
    s.far = (x * x + y * y) / 2;
    s.number = w->spokes;
    r->spoke[w->spokes++] = s;
    w->thick |= !points;
  }
  return true;
}

/* Which of them goes farthest into direction (ux, uy); the lowest one of equals. */
static size_t farthest_pole(const tiles_spoke *s, size_t n, double ux, double uy) {
  size_t best = 0;
  for (size_t k = 1; k < n; k++) {
    double more = ux * (s[k].x - s[best].x) + uy * (s[k].y - s[best].y);
    if (more > 0 || (more == 0 && s[k].number < s[best].number)) best = k;
  }
  return best;
}

/* Adds the spokes that bound the cell in one quadrant, those of exact points everywhere, counter-clockwise. */
static void border_add(reach_work *w, tiles_spoke *border, int quadrant) {
  static const double axis[5][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  const size_t n = w->spokes;
  tiles_spoke *all = w->out->spoke, *s = all + n, *hull = s + n;
  for (size_t k = 0; k < n; k++) {
    s[k] = all[k];
    s[k].nx = s[k].mx - (quadrant == 0 || quadrant == 3 ? s[k].half[0] : -s[k].half[0]);
    s[k].ny = s[k].my - (quadrant < 2 ? s[k].half[1] : -s[k].half[1]);
    s[k].x = s[k].nx / s[k].far;
    s[k].y = s[k].ny / s[k].far;
  }
  const size_t corners = hull_of_spokes(hull, s, n),
               from = farthest_pole(hull, corners, axis[quadrant][0], axis[quadrant][1]);
  size_t end = farthest_pole(hull, corners, axis[quadrant + 1][0], axis[quadrant + 1][1]);
  if (!w->thick) end = (from + corners - 1) % corners;
  for (size_t k = from;; k = (k + 1) % corners) {
    border[w->border++] = hull[k];
    if (k == end) return;
  }
}

/* The spokes of the border of the cell, counter-clockwise. */
static tiles_spoke *reach_border(reach_work *w) {
  tiles_spoke *border = w->out->spoke + 4 * w->spokes;
  bool gap = false;
  size_t kept = 0;
  for (int quadrant = 0; quadrant < (w->thick ? 4 : 1); quadrant++) border_add(w, border, quadrant);
  for (size_t k = 0; k < w->border; k++) { /* where 0 was the cell has no end */
    bool bounds = border[k].number > 0;
    if (bounds) border[kept] = border[k];
    if (bounds) border[kept++].gap = gap;
    gap = !bounds;
  }
  if (kept) border[0].gap |= gap;
  w->border = kept;
  return border;
}

/* *fits: the chain is one. */
static bool reach_chain(bool *fits, reach_work *w) {
  const tiles_spoke *s = reach_border(w);
  const size_t n = w->border;
  *fits = n > 0;
  for (size_t k = 0; *fits && k < n; k++)
    if (!reach_between(fits, w, &s[k], &s[(k + 1) % n])) return false;
  const tiles_knot *e = w->out->knot;
  *fits = *fits && w->knots > 0;
  for (size_t k = 0; *fits && k < w->knots; k++) *fits = knots_turn(w, &e[k], &e[(k + 1) % w->knots]);
  return true;
}

/* ---- discs ---- */

static double farthest2(double x, double y, const tiles_box *b) {
  double dx = fmax(fabs(x - b->x0), fabs(x - b->x1)), dy = fmax(fabs(y - b->y0), fabs(y - b->y1));
  return dx * dx + dy * dy;
}

/* Room for errors of 2^-50 of all that went into it, its place included; squares below 2^-1022 have no digits. */
static tiles_disc disc_rounded(double x, double y, double r2) {
  double r = sqrt(r2) + 0x1p-500;
  return (tiles_disc){x, y, r + (fabs(x) + fabs(y) + r) * 0x1p-48, 0};
}

/* The knot seen from everywhere. */
static tiles_disc knot_disc(const tiles_knot *e, const tiles_box *own) {
  if (e->far) {
    double least = least_in(own, e->x, e->y) - size_in(own, e->x, e->y) * MARGIN;
    return (tiles_disc){e->x, e->y, least, 1};
  }
  double x = own->x0 + e->x, y = own->y0 + e->y;
  return disc_rounded(x, y, farthest2(x, y, own));
}

bool tiles_reach_find(tiles_reach *out, const tiles_view *v, uint32_t i, const tiles_partners *p) {
  reach_work w = {.out = out};
  bool fits;
  if (!reach_spokes(&w, v, i, p) || !reach_chain(&fits, &w) || !DYD_GROW(out->item, out->cap, w.knots + 1))
    return false;
  const tiles_box own = tiles_view_box(v, i);
  out->count = 0;
  if (!fits) out->item[out->count++] = (tiles_disc){own.x0, own.y0, INFINITY, 0};
  for (size_t k = 0; fits && k < w.knots; k++) out->item[out->count++] = knot_disc(&out->knot[k], &own);
  return true;
}

void tiles_reach_clear(tiles_reach *r) {
  dyd_free_all(r->item, r->spoke, r->knot);
  *r = (tiles_reach){0};
}

tiles_disc tiles_witness_disc(const double c[2], const tiles_box *a, const tiles_box *b) {
  return disc_rounded(c[0], c[1], fmax(farthest2(c[0], c[1], a), farthest2(c[0], c[1], b)));
}

/* ---- discs and boxes ---- */

static double outside(double c, double lo, double hi) {
  return c < lo ? lo - c : c > hi ? c - hi : 0;
}

double tiles_disc_score(const tiles_disc *d, const tiles_box *b) {
  if (d->far) {
    double top = -least_in(b, -d->x, -d->y);
    return top + size_in(b, d->x, d->y) * MARGIN + TINY < d->r ? INFINITY : fmin(-top, DBL_MAX);
  }
  double dx = outside(d->x, b->x0, b->x1), dy = outside(d->y, b->y0, b->y1), d2 = dx * dx + dy * dy;
  return d2 * (1 - MARGIN) > d->r * d->r && d2 > TINY && d2 < INFINITY ? INFINITY : fmin(d2, DBL_MAX);
}

bool tiles_disc_may_meet(const tiles_disc *d, const tiles_box *box) {
  return tiles_disc_score(d, box) != INFINITY;
}

/* A rounded difference is above a double only where the exact one is. */
bool tiles_disc_is_inside(const tiles_disc *d, const tiles_box *b) {
  return !d->far && d->x - d->r > b->x0 && d->x + d->r < b->x1 && d->y - d->r > b->y0 && d->y + d->r < b->y1;
}

bool tiles_box_is_point(const tiles_box *b) {
  return b->x0 == b->x1 && b->y0 == b->y1;
}

bool tiles_boxes_meet(const tiles_box *a, const tiles_box *b) {
  return a->x0 <= b->x1 && b->x0 <= a->x1 && a->y0 <= b->y1 && b->y0 <= a->y1;
}

void tiles_box_join(tiles_box *a, const tiles_box *b) {
  *a = (tiles_box){fmin(a->x0, b->x0), fmax(a->x1, b->x1), fmin(a->y0, b->y0), fmax(a->y1, b->y1)};
}

bool tiles_box_is_tall(const tiles_box *a) {
  return a->y1 - a->y0 > a->x1 - a->x0;
}

tiles_box tiles_box_empty(void) {
  return (tiles_box){INFINITY, -INFINITY, INFINITY, -INFINITY};
}

tiles_box tiles_box_wider(const tiles_box *b, size_t count, double times) {
  double h = times * sqrt((b->x1 - b->x0) / (double)(count + 1) * (b->y1 - b->y0));
  if (!(h < INFINITY)) h = 0;
  return (tiles_box){b->x0 - h, b->x1 + h, b->y0 - h, b->y1 + h};
}

size_t tiles_farthest(const tiles_sites *s, unsigned k, unsigned of) {
  const double angle = 6.283185307179586 * k / of, ux = cos(angle), uy = sin(angle);
  size_t best = 0;
  double most = -INFINITY;
  for (size_t j = 0; j < s->count; j++) {
    tiles_box b = tiles_sites_box(s, j);
    double top = least_in(&b, ux, uy);
    if (top > most) {
      most = top;
      best = j;
    }
  }
  return best;
}
