/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Chains around the possible cell of a site, in doubles [REACH-1].
 *
 * Coordinates are relative to the lower left corner o of the site's box. A difference of two doubles has a relative
 * error of 2^-53, also below the least normal number, so boxes widened by 2^-52 of their ends hold the true ones; a
 * chain for wider boxes is one for the true ones. Knots of the chain are whatever doubles come out of the construction,
 * which proves nothing; what is claimed of them is checked (spoke_is_nearer, spoke_is_beyond, knots_turn) with margins
 * above the errors: a sum of products of sums of two is wrong by less than 2^-50 of the same sum of absolute values,
 * and by 2^-1070 where products underflow. Comparisons are such that NaN and infinities fail them. */
#include "reach.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

static const double MARGIN = 0x1p-48, TINY = 0x1p-1000;

/* A partner: where its middle is, seen from that of the site; how far both go from their middles. Within a distance rho
 * of the site all centres c with c.m >= p = (|m| + size)^2 / 2 + rho size are surely nearer to it; (x, y) is the pole
 * of this line. */
typedef struct tiles_spoke {
  double mx, my, size, x, y;
  tiles_box box;
} tiles_spoke;

/* Of a chain: a place, or (far) a direction. */
typedef struct tiles_knot {
  double x, y;
  bool far;
} tiles_knot;

typedef struct reach_work {
  tiles_reach *out;
  size_t spokes, knots;
  tiles_box own;
  double cx, cy; /* the middle of the site */
  double rho;    /* how far its partners are, on the average */
  bool thick;    /* there are rectangles */
  bool gap;      /* the cell goes on between two spokes, the last and the first one as seen from far out: */
  tiles_spoke last, first;
} reach_work;

/* ---- what is checked ---- */

static tiles_box reach_box(const tiles_box *b, double ox, double oy) {
  const double wide = 0x1p-52;
  tiles_box d = {b->x0 - ox, b->x1 - ox, b->y0 - oy, b->y1 - oy};
  return (tiles_box){d.x0 - fabs(d.x0) * wide, d.x1 + fabs(d.x1) * wide, d.y0 - fabs(d.y0) * wide,
                     d.y1 + fabs(d.y1) * wide};
}

/* Adds the least 2 c (y - x) - y^2 + x^2 over y in [k0, k1], x in [i0, i1], and the sizes of its terms. */
static void add_gain(double *gain, double *size, double c, double k0, double k1, double i0, double i1) {
  double a = k0 * (2 * c - k0), b = k1 * (2 * c - k1), x = c < i0 ? i0 : c > i1 ? i1 : c;
  *gain += (a < b ? a : b) + x * (x - 2 * c);
  *size +=
      fabs(k0) * (2 * fabs(c) + fabs(k0)) + fabs(k1) * (2 * fabs(c) + fabs(k1)) + fabs(x) * (fabs(x) + 2 * fabs(c));
}

/* Is the spoke's box surely nearer to (x, y) than the own one? */
static bool spoke_is_nearer(const tiles_spoke *s, const tiles_box *own, double x, double y) {
  double gain = 0, size = 0;
  add_gain(&gain, &size, x, s->box.x0, s->box.x1, own->x0, own->x1);
  add_gain(&gain, &size, y, s->box.y0, s->box.y1, own->y0, own->y1);
  return size > TINY && gain > MARGIN * size && size < INFINITY;
}

static double least_in(const tiles_box *b, double ux, double uy) {
  return fmin(ux * b->x0, ux * b->x1) + fmin(uy * b->y0, uy * b->y1);
}

static double size_in(const tiles_box *b, double ux, double uy) {
  return fabs(ux) * fmax(fabs(b->x0), fabs(b->x1)) + fabs(uy) * fmax(fabs(b->y0), fabs(b->y1));
}

/* Is it surely beyond the own one in direction u? */
static bool spoke_is_beyond(const tiles_spoke *s, const tiles_box *own, double ux, double uy) {
  double gain = least_in(&s->box, ux, uy) + least_in(own, -ux, -uy);
  double size = size_in(&s->box, ux, uy) + size_in(own, ux, uy);
  return size > TINY && gain > MARGIN * size && size < INFINITY;
}

static bool knots_turn(const tiles_knot *a, const tiles_knot *b) {
  double p = a->x * b->y, q = a->y * b->x, size = fabs(p) + fabs(q);
  return size > TINY && p - q > MARGIN * size && size < INFINITY;
}

/* ---- the construction ---- */

static double reach_cross(double ax, double ay, double bx, double by) {
  return ax * by - ay * bx;
}

static bool reach_knot(reach_work *w, double x, double y, bool far) {
  tiles_reach *r = w->out;
  if (!tiles_reserve((void **)&r->knot, &r->room_knot, w->knots + 1, sizeof *r->knot)) return false;
  r->knot[w->knots++] = (tiles_knot){x, y, far};
  return true;
}

/* The end of the bisector with the spoke, left or right of it as seen from the site, turned towards the spoke as far as
 * is needed. u is as long as the spoke. */
static bool spoke_end(double u[2], const reach_work *w, const tiles_spoke *s, double side) {
  for (double tilt = 0x1p-40; tilt < 64; tilt *= tilt < 0x1p-8 ? 16 : 1.5) {
    u[0] = tilt * s->mx - side * s->my;
    u[1] = tilt * s->my + side * s->mx;
    if (spoke_is_beyond(s, &w->own, u[0], u[1])) return true;
  }
  return false;
}

/* The p of a spoke at distance rho. */
static double spoke_line(const tiles_spoke *s, double rho) {
  double d2 = s->mx * s->mx + s->my * s->my;
  return (d2 + s->size * (2 * sqrt(d2) + s->size)) / 2 + rho * s->size;
}

/* Where the lines of two spokes meet, pushed outward until it is surely nearer to both; or, too far away for good
 * bounds, the direction. */
static bool spokes_meet(tiles_knot *c, const reach_work *w, const tiles_spoke *a, const tiles_spoke *b) {
  double turn = reach_cross(a->mx, a->my, b->mx, b->my), rho = w->rho;
  if (!(turn > 0)) return false;
  for (double push = 0x1p-44; push < 4; push *= push < 0x1p-8 ? 16 : 1.5, rho *= 1.5) {
    double p = spoke_line(a, rho), q = spoke_line(b, rho);
    double x = (p * b->my - q * a->my) / turn, y = (a->mx * q - b->mx * p) / turn;
    if (!(x * x + y * y < 0x1p48 * (p + q))) {
      *c = (tiles_knot){x, y, true};
      return spoke_is_beyond(a, &w->own, x, y) && spoke_is_beyond(b, &w->own, x, y);
    }
    *c = (tiles_knot){w->cx + x * (1 + push), w->cy + y * (1 + push), false};
    if (spoke_is_nearer(a, &w->own, c->x, c->y) && spoke_is_nearer(b, &w->own, c->x, c->y)) return true;
  }
  return false;
}

static bool spokes_same(const tiles_spoke *a, const tiles_spoke *b) {
  return a->mx == b->mx && a->my == b->my;
}

/* One knot where a and b meet. */
static bool reach_corner(bool *fits, reach_work *w, const tiles_spoke *a, const tiles_spoke *b) {
  tiles_knot c;
  if (spokes_same(a, b)) return true;
  *fits = spokes_meet(&c, w, a, b);
  return !*fits || reach_knot(w, c.x, c.y, c.far);
}

/* The directions into which the cell goes on. */
static bool reach_ends(bool *fits, reach_work *w, const tiles_spoke *a, const tiles_spoke *b) {
  double last[2], first[2];
  *fits = spoke_end(last, w, a, 1) && spoke_end(first, w, b, -1);
  if (!*fits) return true;
  tiles_knot l = {last[0], last[1], true}, f = {first[0], first[1], true};
  return reach_knot(w, last[0], last[1], true) && (knots_turn(&l, &f) || reach_knot(w, -last[1], last[0], true)) &&
         reach_knot(w, first[0], first[1], true);
}

/* Knots between the spokes a and b. *fits = false: none. */
static bool reach_between(bool *fits, reach_work *w, const tiles_spoke *a, const tiles_spoke *b) {
  tiles_knot c;
  if (a != b && spokes_meet(&c, w, a, b)) return reach_knot(w, c.x, c.y, c.far);
  if (!w->gap) return reach_ends(fits, w, a, b);
  return reach_corner(fits, w, a, &w->last) && (!*fits || reach_ends(fits, w, &w->last, &w->first)) &&
         (!*fits || reach_corner(fits, w, &w->first, b));
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

/* Half a hull: behind s[from .. at-1], s[k] in place of what it makes needless. */
static size_t hull_push(tiles_spoke *s, size_t from, size_t at, const tiles_spoke *next) {
  while (at >= from + 2 && !(reach_cross(s[at - 1].x - s[at - 2].x, s[at - 1].y - s[at - 2].y, next->x - s[at - 2].x,
                                         next->y - s[at - 2].y) > 0))
    at--;
  s[at] = *next;
  return at + 1;
}

/* The bisectors on the border of a cell: their spokes, inverted, are the corners of a convex hull with 0. */
static size_t hull_of_spokes(tiles_spoke *s, size_t n) {
  tiles_spoke *out = s + n; /* room for 2 n */
  size_t at = 0;
  sort_spokes(s, n);
  for (size_t k = 0; k < n; k++) at = hull_push(out, 0, at, &s[k]);
  size_t from = at - 1;
  for (size_t k = n - 1; k-- > 0;) at = hull_push(out, from, at, &s[k]);
  return n == 1 ? 1 : at - 1;
}

static bool reach_spokes(reach_work *w, const tiles_view *v, uint32_t i, const tiles_partners *p) {
  tiles_reach *r = w->out;
  if (!tiles_reserve((void **)&r->spoke, &r->room_spoke, 3 * (p->count + 1), sizeof *r->spoke)) return false;
  tiles_box own = tiles_view_box(v, i);
  w->own = reach_box(&own, own.x0, own.y0);
  w->cx = w->own.x1 / 2;
  w->cy = w->own.y1 / 2;
  r->spoke[w->spokes++] = (tiles_spoke){0};
  for (size_t k = 0; k < p->count; k++) {
    tiles_box far = tiles_view_box(v, TILES_SITE(p->item[k])), box = reach_box(&far, own.x0, own.y0);
    if (tiles_boxes_meet(&box, &w->own)) continue;
    double mx = (box.x0 + box.x1) / 2 - w->cx, my = (box.y0 + box.y1) / 2 - w->cy;
    double size = (box.x1 - box.x0 + box.y1 - box.y0 + w->own.x1 + w->own.y1) / 2;
    if (tiles_box_is_point(&far) && tiles_box_is_point(&own)) size = 0;
    r->spoke[w->spokes++] = (tiles_spoke){.mx = mx, .my = my, .size = size, .box = box};
    w->rho += sqrt(mx * mx + my * my) + size;
    w->thick |= size > 0;
  }
  w->rho /= (double)w->spokes;
  return true;
}

/* The spokes of the border of the cell, seen from distance rho, counter-clockwise; the others lose their order. */
static tiles_spoke *reach_border(size_t *count, const reach_work *w, double rho) {
  tiles_spoke *all = w->out->spoke, *s = all + w->spokes;
  for (size_t k = 0; k < w->spokes; k++) {
    double p = spoke_line(&all[k], rho);
    all[k].x = p > 0 ? all[k].mx / p : 0;
    all[k].y = p > 0 ? all[k].my / p : 0;
  }
  size_t n = hull_of_spokes(all, w->spokes);
  *count = 0;
  for (size_t k = 0; k < n; k++) /* 0 leaves: where it was the cell has no end */
    if (s[k].mx != 0 || s[k].my != 0) s[(*count)++] = s[k];
  return s;
}

/* Far out near rectangles, which are seen at wide angles, do not bound the cell: those that do there. */
static void reach_gap(reach_work *w) {
  size_t n, gaps = 0;
  const tiles_spoke *s = reach_border(&n, w, ldexp(w->rho, 20));
  for (size_t k = 0; k < n; k++) {
    const tiles_spoke *a = &s[k], *b = &s[(k + 1) % n];
    if (reach_cross(a->mx, a->my, b->mx, b->my) > 0) continue;
    w->last = *a;
    w->first = *b;
    gaps++;
  }
  w->gap = gaps == 1;
}

/* *fits: the chain is one. */
static bool reach_chain(bool *fits, reach_work *w, double rho) {
  size_t n;
  const tiles_spoke *s = reach_border(&n, w, rho);
  w->knots = 0;
  *fits = n > 0;
  for (size_t k = 0; *fits && k < n; k++)
    if (!reach_between(fits, w, &s[k], &s[(k + 1) % n])) return false;
  const tiles_knot *e = w->out->knot;
  for (size_t k = 0; *fits && k < w->knots; k++) *fits = knots_turn(&e[k], &e[(k + 1) % w->knots]);
  return true;
}

/* Among rectangles the chain may have to be far out; twice as far each time. */
static bool reach_chains(bool *fits, reach_work *w) {
  enum { TRIES = 12 };
  *fits = false;
  if (!w->thick) return reach_chain(fits, w, 0);
  reach_gap(w);
  const bool gap = w->gap;
  for (int k = 0; !*fits && k < TRIES; k++) {
    w->gap = gap;
    if (!reach_chain(fits, w, ldexp(w->rho, k))) return false;
    w->gap = false;
    if (gap && !*fits && !reach_chain(fits, w, ldexp(w->rho, k))) return false;
  }
  return true;
}

/* ---- discs ---- */

static double farthest2(double x, double y, const tiles_box *b) {
  double dx = fmax(fabs(x - b->x0), fabs(x - b->x1)), dy = fmax(fabs(y - b->y0), fabs(y - b->y1));
  return dx * dx + dy * dy;
}

/* Room for errors of 2^-50 of all that went into it, its place included. */
static tiles_disc disc_rounded(double x, double y, double r2) {
  double r = sqrt(r2);
  return (tiles_disc){x, y, r + (fabs(x) + fabs(y) + r) * 0x1p-48, 0};
}

/* The least of all rectangles in direction u, rounded down. */
static double edge_of(const tiles_view *v, uint32_t i, const tiles_partners *p, bool wide, double ux, double uy) {
  tiles_box own = tiles_view_box(v, i);
  double least = least_in(&own, ux, uy), size = size_in(&own, ux, uy);
  for (size_t k = 0; wide && k < p->count; k++) {
    tiles_box b = tiles_view_box(v, TILES_SITE(p->item[k]));
    if (TILES_STATUS(p->item[k]) == DYD_LEGAL) least = fmin(least, least_in(&b, ux, uy));
    size = fmax(size, size_in(&b, ux, uy));
  }
  return least - size * MARGIN;
}

/* The knot seen from everywhere; relative places are wrong by what reach_box takes for widths. */
static tiles_disc knot_disc(const tiles_knot *e, const tiles_view *v, uint32_t i, const tiles_partners *p, bool wide) {
  if (e->far) return (tiles_disc){e->x, e->y, edge_of(v, i, p, wide, e->x, e->y), 1};
  tiles_box own = tiles_view_box(v, i);
  double x = own.x0 + e->x, y = own.y0 + e->y, r2 = farthest2(x, y, &own);
  for (size_t k = 0; wide && k < p->count; k++) {
    tiles_box b = tiles_view_box(v, TILES_SITE(p->item[k]));
    if (TILES_STATUS(p->item[k]) == DYD_LEGAL) r2 = fmax(r2, farthest2(x, y, &b));
  }
  return disc_rounded(x, y, r2);
}

bool tiles_reach_find(tiles_reach *out, const tiles_view *v, uint32_t i, const tiles_partners *p, bool wide) {
  reach_work w = {.out = out};
  bool fits;
  if (!reach_spokes(&w, v, i, p) || !reach_chains(&fits, &w) ||
      !tiles_reserve((void **)&out->item, &out->room, w.knots + 1, sizeof *out->item))
    return false;
  out->count = 0;
  if (!fits) out->item[out->count++] = (tiles_disc){tiles_view_box(v, i).x0, tiles_view_box(v, i).y0, INFINITY, 0};
  for (size_t k = 0; fits && k < w.knots; k++) out->item[out->count++] = knot_disc(&out->knot[k], v, i, p, wide);
  return true;
}

void tiles_reach_clear(tiles_reach *r) {
  free(r->item);
  free(r->spoke);
  free(r->knot);
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
    return top + size_in(b, d->x, d->y) * MARGIN < d->r ? INFINITY : fmin(-top, DBL_MAX);
  }
  double dx = outside(d->x, b->x0, b->x1), dy = outside(d->y, b->y0, b->y1), d2 = dx * dx + dy * dy;
  return d2 * (1 - MARGIN) > d->r * d->r && d2 > TINY && d2 < INFINITY ? INFINITY : fmin(d2, DBL_MAX);
}

bool tiles_disc_may_meet(const tiles_disc *d, const tiles_box *box) {
  return tiles_disc_score(d, box) != INFINITY;
}

bool tiles_disc_is_inside(const tiles_disc *d, const tiles_box *b) {
  double r = d->r + (fabs(d->x) + fabs(d->y) + d->r) * MARGIN;
  return !d->far && d->x - r > b->x0 && d->x + r < b->x1 && d->y - r > b->y0 && d->y + r < b->y1;
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
