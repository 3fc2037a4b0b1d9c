/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Deaths where points move in discs of weights, or in squares, by the few sites that bind [TOL-11].
 *
 * A centre c shows the pair ij at t when both regions are nearer to c, wherever in them the points are, than each other
 * one. For an end e of the pair and another site k that is so up to a t that depends on c, which is the smallest of
 * these for all e and k; where it is largest the pair dies. Each is replaced by its plane at c, the planes' summit is
 * the next c, as long as that helps: a guess. It is confirmed once, in double-doubles:
 *
 * Below it, c keeps from all other sites. Above it, three choices (a of an end, b of another site) refute the pair:
 * x is nearer to a than to b on an open half-plane bounded by their bisector. If c is in none of the three, and the
 * vectors b - a hold 0 between them, the half-planes have no common point. So no centre shows the pair. Where two
 * regions meet there is none either.
 *
 * Births (moved_births_filter.c) climb by the same planes, a site and an end in each other's place. Coordinates are
 * those seen from i. */
#include "tolerance/moves_filter.h"
#include "tolerance/state.h"

enum { MOST_STEPS = 60, MOST_PIVOTS = 80, MOST_LOOKS = 12, FIRST_AROUND = 24 };

#define FURTHER 8 /* slopes of the cone, over the steepest */

/* Half of the relative widths that are tried. */
static const double move_widths[] = {0x1p-44, 0x1p-42, 0x1p-34, 0x1p-22};

double dyd_moves_width(const dyd_moves *m, size_t tries) {
  return tries < (m->square ? 4 : 2) ? move_widths[tries] : 0;
}

/* ---- sites ---- */

static double move_weight(const dyd_moves *m, uint32_t v) {
  return m->square || !m->t->weight ? 1 : m->t->weight[v];
}

bool dyd_moves_see(dyd_moves *m, uint32_t v) {
  if (m->count == 2 + DYD_MOVES_MOST_SEEN) return false;
  for (uint32_t k = 0; k < m->count; k++)
    if (m->site[k].vertex == v) return false;
  dyd_dd_bounded p[2];
  dyd_dd_vector(p, &m->t->points, v, m->count ? m->site[0].vertex : v);
  m->site[m->count++] = (dyd_move_site){p[0], p[1], move_weight(m, v), v};
  return true;
}

/* ---- planes ---- */

/* The plane of the corner farthest from c, and those of corners that are for centres within m->far. */
static void planes_of_squares(dyd_moves *m, const dyd_move_plane *p, double *least) {
  const dyd_move_site *e = &m->site[p->end], *k = &m->site[p->other];
  double ax = m->x - e->x.h, ay = m->y - e->y.h;
  bool both[2] = {fabs(ax) < m->far, fabs(ay) < m->far};
  for (int n = 0; n < 4 && m->planes < DYD_MOVES_MOST_PLANES; n++) {
    if ((n % 2 && !both[0]) || (n / 2 && !both[1])) continue;
    dyd_move_plane *q = &m->plane[m->planes++];
    *q = *p;
    q->way[0] = (ax < 0) == (n % 2) ? 1 : -1;
    q->way[1] = (ay < 0) == (n / 2) ? 1 : -1;
    dyd_plane_of_squares(q, e, k, m->x, m->y);
    if ((n % 2 && !(fabs(ax) < q->top)) || (n / 2 && !(fabs(ay) < q->top))) m->planes--;
    if (n == 0 && !(q->top >= *least)) *least = q->top;
  }
}

/* All planes at c, for a birth those of the pair in the place of the ends; m->now: their least height. */
static void moves_measure(dyd_moves *m) {
  bool born = m->way < 0;
  uint32_t end = born ? 4 : m->count;
  m->planes = DYD_MOVES_CONE;
  m->now = HUGE_VAL;
  for (uint32_t k = 2; k < end; k++)
    for (uint32_t e = 0; e < 2 && m->planes < DYD_MOVES_MOST_PLANES; e++) {
      dyd_move_plane p = {.end = born ? m->pair[k - 2] : e, .other = born ? e : k};
      if (m->square) {
        planes_of_squares(m, &p, &m->now);
        continue;
      }
      dyd_plane_of_discs(&p, &m->site[p.end], &m->site[p.other], m->x, m->y);
      if (!(p.top >= m->now)) m->now = p.top;
      m->plane[m->planes++] = p;
    }
}

/* Planes that fall so steeply from above c that the summit is less than about 2 far away. */
static void cone_begin(dyd_moves *m) {
  static const double turn[3][2] = {{1, 0}, {-0.5, 0.8660254037844386}, {-0.5, -0.8660254037844386}};
  double steepest = 0;
  for (uint32_t k = DYD_MOVES_CONE; k < m->planes; k++)
    steepest = fmax(steepest, fabs(m->plane[k].x) + fabs(m->plane[k].y));
  for (uint32_t k = 0; k < DYD_MOVES_CONE; k++) {
    double slope = FURTHER * steepest;
    m->plane[k] = (dyd_move_plane){.top = m->now + slope * m->far, .x = -slope * turn[k][0], .y = -slope * turn[k][1]};
    m->basis[k] = k;
  }
}

/* ---- the summit of planes ---- */

static double move_cross(const dyd_move_plane *a, const dyd_move_plane *b, const dyd_move_plane *c) {
  return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

bool dyd_planes_meet(dyd_move_plane *at, const dyd_moves *m) {
  const dyd_move_plane *a = &m->plane[m->basis[0]], *b = &m->plane[m->basis[1]], *c = &m->plane[m->basis[2]];
  double det = move_cross(a, b, c), p = a->top - b->top, q = a->top - c->top;
  at->x = (p * (c->y - a->y) - q * (b->y - a->y)) / det;
  at->y = (q * (b->x - a->x) - p * (c->x - a->x)) / det;
  at->top = a->top + a->x * at->x + a->y * at->y;
  return isfinite(at->top);
}

/* Weights of the slopes of the basis that make (x, y). */
static void planes_weigh(double out[3], const dyd_moves *m, const dyd_move_plane *slope) {
  const dyd_move_plane *a = &m->plane[m->basis[0]], *b = &m->plane[m->basis[1]], *c = &m->plane[m->basis[2]];
  double det = move_cross(a, b, c);
  out[1] = move_cross(a, slope, c) / det;
  out[2] = move_cross(a, b, slope) / det;
  out[0] = 1 - out[1] - out[2];
}

bool dyd_planes_four(dyd_move_plane *at, dyd_moves *m) {
  static const dyd_move_plane flat = {0};
  for (uint32_t out = 4; out-- > 0;) {
    const dyd_move_plane *p = &m->plane[DYD_MOVES_CONE + out];
    double zero[3];
    for (uint32_t k = 0; k < 3; k++) m->basis[k] = DYD_MOVES_CONE + k + (k >= out);
    if (!dyd_planes_meet(at, m)) continue;
    planes_weigh(zero, m, &flat);
    if (zero[0] >= 0 && zero[1] >= 0 && zero[2] >= 0 &&
        p->top + p->x * at->x + p->y * at->y - at->top >= -0x1p-50 * fabs(at->top))
      return true;
  }
  return false;
}

/* The place of the highest point below all planes, seen from c. The basis always holds 0 between its slopes; the plane
 * that is lowest at its point enters, and the one leaves that keeps it so. */
static bool planes_summit(dyd_move_plane *at, dyd_moves *m) {
  static const dyd_move_plane flat = {0};
  for (int pivot = 0; pivot < MOST_PIVOTS; pivot++) {
    if (!dyd_planes_meet(at, m)) return false;
    uint32_t low = 0;
    double least = -0x1p-50 * fabs(at->top);
    for (uint32_t k = 0; k < m->planes; k++) {
      double over = m->plane[k].top + m->plane[k].x * at->x + m->plane[k].y * at->y - at->top;
      if (k == m->basis[0] || k == m->basis[1] || k == m->basis[2] || !(over < least)) continue;
      least = over;
      low = k + 1;
    }
    if (!low) return true;
    double zero[3], enter[3], ratio = HUGE_VAL;
    int leave = 0;
    planes_weigh(zero, m, &flat);
    planes_weigh(enter, m, &m->plane[low - 1]);
    for (int k = 0; k < 3; k++)
      if (enter[k] > 0 && zero[k] < ratio * enter[k]) ratio = zero[k] / enter[k], leave = k;
    m->basis[leave] = low - 1;
  }
  return false;
}

/* ---- the way up ---- */

/* Discs: from where on one of i, j meets another one. */
static void moves_contact(dyd_moves *m) {
  m->contact = HUGE_VAL;
  for (uint32_t k = 2; k < m->count && !m->square && m->way > 0; k++)
    for (uint32_t e = 0; e < 2; e++) {
      const dyd_move_site *a = &m->site[e], *b = &m->site[k];
      double t = hypot(a->x.h - b->x.h, a->y.h - b->y.h) / (a->weight + b->weight);
      if (!(t < m->contact)) continue;
      m->contact = t;
      m->touch[0] = e;
      m->touch[1] = k;
    }
}

/* The point of the ray from the centre of the touching end, away from the place that it touches, next to (x, y). */
static void move_to_ray(double *x, double *y, const dyd_moves *m) {
  const dyd_move_site *e = &m->site[m->touch[0]], *k = &m->site[m->touch[1]];
  double ux = e->x.h - k->x.h, uy = e->y.h - k->y.h, size = hypot(ux, uy);
  double along = fmax(((*x - e->x.h) * ux + (*y - e->y.h) * uy) / size, 0);
  *x = e->x.h + along * ux / size;
  *y = e->y.h + along * uy / size;
}

/* Goes there if it is higher. Otherwise planes are left those of (x, y). */
static bool moves_try(dyd_moves *m, double x, double y) {
  double now = m->now, back[2] = {m->x, m->y};
  m->x = x;
  m->y = y;
  moves_measure(m);
  if (m->now > now) return true;
  m->now = now;
  m->x = back[0];
  m->y = back[1];
  return false;
}

static bool has_cone(const dyd_moves *m) {
  return m->basis[0] < DYD_MOVES_CONE || m->basis[1] < DYD_MOVES_CONE || m->basis[2] < DYD_MOVES_CONE;
}

bool dyd_moves_climb(dyd_moves *m) {
  double start = m->far = hypot(m->x, m->y);
  moves_contact(m);
  moves_measure(m);
  for (int step = 0; step < MOST_STEPS; step++) {
    dyd_move_plane to;
    if (m->now > m->goal || m->now >= m->contact * (1 - DYD_MOVES_CLOSE)) return true;
    cone_begin(m);
    if (!planes_summit(&to, m)) return false;
    bool held = has_cone(m);
    if (to.top - m->now <= DYD_MOVES_CLOSE * fabs(m->now)) return m->now > 0;
    double x = m->x + to.x, y = m->y + to.y, size = hypot(to.x, to.y);
    if (m->contact < to.top) move_to_ray(&x, &y, m);
    if (moves_try(m, x, y) || (m->contact < to.top && moves_try(m, m->x + to.x, m->y + to.y))) {
      m->far = held ? 4 * m->far : 4 * size;
    } else {
      m->far = size / 4;
      moves_measure(m);
    }
    if (!(m->far < 0x1p20 * start)) return false;
    if (!(m->far > 0x1p-50 * start)) return m->now > 0;
  }
  return m->now > 0;
}

/* ---- in double-doubles ---- */

static dyd_dd_bounded dd_size(dyd_dd_bounded a) {
  return a.h < 0 ? (dyd_dd_bounded){-a.h, -a.l, a.e} : a;
}

static dyd_dd_bounded dd_product(double a, double b) {
  return dyd_dd_times(dyd_dd_of(a), dyd_dd_of(b));
}

/* The place of c seen from a site. */
static void move_from(dyd_dd_bounded out[2], const dyd_moves *m, const dyd_move_site *s) {
  out[0] = dyd_dd_plus(m->at[0], s->x, -1);
  out[1] = dyd_dd_plus(m->at[1], s->y, -1);
}

dyd_dd_bounded dyd_move_reach(const dyd_moves *m, const dyd_move_site *s, double t, int way) {
  dyd_dd_bounded d[2];
  move_from(d, m, s);
  if (!m->square) return dyd_dd_plus(dyd_dd_root(dyd_dd_square_sum(d[0], d[1])), dd_product(t, s->weight), way);
  for (int a = 0; a < 2; a++) {
    d[a] = dyd_dd_plus(dd_size(d[a]), dyd_dd_of(t), way);
    if (!(d[a].h > 0)) d[a] = (dyd_dd_bounded){0, 0, fmax(d[a].h + d[a].e, 0)};
  }
  return dyd_dd_square_sum(d[0], d[1]);
}

/* How far c is too low for a plane at t. */
static double move_residue(const dyd_moves *m, const dyd_move_plane *p, double t) {
  const dyd_move_site *e = &m->site[p->end], *k = &m->site[p->other];
  dyd_dd_bounded near = dyd_move_reach(m, k, t, -1), d[2];
  if (!m->square) return dyd_dd_plus(near, dyd_move_reach(m, e, t, 1), -1).h / (e->weight + k->weight);
  move_from(d, m, e);
  for (int a = 0; a < 2; a++) d[a] = dyd_dd_plus(d[a], dyd_dd_of(p->way[a] * t), 1);
  double f = fmax(fabs(m->x - k->x.h) - t, 0), g = fmax(fabs(m->y - k->y.h) - t, 0);
  return dyd_dd_plus(near, dyd_dd_square_sum(d[0], d[1]), -1).h /
         (2 * (p->way[0] * d[0].h + p->way[1] * d[1].h + f + g));
}

void dyd_moves_refine(dyd_moves *m) {
  m->at[0] = dyd_dd_of(m->x);
  m->at[1] = dyd_dd_of(m->y);
  if (m->now >= m->contact * (1 - DYD_MOVES_CLOSE) || has_cone(m)) return;
  for (int step = 0; step < 2; step++) {
    dyd_move_plane to;
    for (int k = 0; k < 3; k++) m->plane[m->basis[k]].top = move_residue(m, &m->plane[m->basis[k]], m->now);
    if (!dyd_planes_meet(&to, m)) return;
    if (!(hypot(to.x, to.y) < 0x1p-10 * hypot(m->x, m->y) && fabs(to.top) < 0x1p-10 * m->now)) return;
    m->at[0] = dyd_dd_plus(m->at[0], dyd_dd_of(to.x), 1);
    m->at[1] = dyd_dd_plus(m->at[1], dyd_dd_of(to.y), 1);
    for (int a = 0; a < 2; a++) m->at[a].e = 0; /* it is that number */
    m->x = m->at[0].h;                          /* what searches are about */
    m->y = m->at[1].h;
    m->now += to.top;
  }
}

/* ---- below ---- */

/* The search for sites in the way of the circle about c at t. reach: of the pair, as of move_reach. radius2: of the
 * search, of a birth the least of those found: these are in the way longest, about. */
typedef struct move_look {
  dyd_moves *m;
  double t, radius, radius2;
  dyd_dd_bounded reach;
  int added;
} move_look;

/* Is a site out of the way for certain? */
static bool move_keeps_clear(const move_look *l, const dyd_move_site *s) {
  dyd_dd_bounded gap = dyd_dd_plus(dyd_move_reach(l->m, s, l->t, -l->m->way), l->reach, -1);
  return dyd_dd_sign(gap) > 0;
}

/* The same in doubles, with much room. */
static bool move_is_far(const move_look *l, uint32_t v) {
  const dyd_moves *m = l->m;
  const dyd_points_d *p = &m->t->points;
  dyd_xy at = p->xy[v], i = p->xy[m->site[0].vertex];
  double x = at.x - i.x - m->x, y = at.y - i.y - m->y, size = fabs(at.x) + fabs(at.y) + fabs(i.x) + fabs(i.y);
  double w = m->way * l->t * move_weight(m, v), room = 0x1p-45 * (size + fabs(m->x) + fabs(m->y) + l->radius + fabs(w));
  if (m->square) x = fmax(fabs(x) - w, 0), y = fmax(fabs(y) - w, 0), w = 0;
  return sqrt(x * x + y * y) > l->radius + w + room;
}

static bool move_meet(void *context, uint32_t v) {
  move_look *l = context;
  dyd_moves *m = l->m;
  uint32_t had = m->count;
  if (move_is_far(l, v) || v == m->site[0].vertex || v == m->site[1].vertex) return true;
  if (!dyd_moves_see(m, v)) {
    l->added += had == 2 + DYD_MOVES_MOST_SEEN ? DYD_MOVES_MOST_ADDED : 0; /* seen before */
    return l->added < DYD_MOVES_MOST_ADDED;
  }
  if (move_keeps_clear(l, &m->site[had])) {
    m->count = had;
  } else {
    double x = m->site[had].x.h - m->x, y = m->site[had].y.h - m->y;
    l->added++;
    if (m->way < 0) l->radius2 = fmin(l->radius2, (x * x + y * y) * (1 + DYD_MOVES_CLOSE));
  }
  return l->added < DYD_MOVES_MOST_ADDED;
}

/* Sets the reach, the larger one of both, and a radius that covers all roundings of the places of c and the sites. */
static bool move_look_begin(move_look *l, dyd_moves *m, double t) {
  dyd_dd_bounded of[2] = {dyd_move_reach(m, &m->site[0], t, m->way), dyd_move_reach(m, &m->site[1], t, m->way)};
  dyd_dd_bounded more = dyd_dd_plus(of[1], of[0], -1);
  *l = (move_look){.m = m, .t = t, .reach = of[0]};
  if (more.h > -more.e) l->reach = of[1];
  if (!dyd_dd_sign(more)) l->reach.e += fabs(more.h) + more.e;
  l->radius = (m->square ? sqrt(l->reach.h + l->reach.e) : l->reach.h + l->reach.e) * (1 + 0x1p-45);
  return isfinite(l->radius) && l->radius > 0;
}

bool dyd_moves_hold(bool *added, dyd_moves *m, double t) {
  move_look l;
  *added = false;
  if (!move_look_begin(&l, m, t)) return false;
  for (uint32_t k = 2; k < m->count; k++)
    if (!move_keeps_clear(&l, &m->site[k])) return false;
  const dyd_points_d *p = &m->t->points;
  dyd_xy i = p->xy[m->site[0].vertex];
  double x = i.x + m->x, y = i.y + m->y, size = fabs(i.x) + fabs(i.y) + fabs(m->x) + fabs(m->y) + l.radius;
  double most = m->way < 0 ? 0 : m->square ? 1.5 : m->t->heaviest, reach = l.radius + t * most;
  reach += 0x1p-44 * (size + reach + m->t->sk->mesh.extent[0] + m->t->sk->mesh.extent[1]);
  const dyd_bbox at = {{x, x, y, y}};
  l.radius2 = reach * reach * (1 + 0x1p-45);
  if (!isfinite(l.radius2)) return false;
  dyd_tree_near(&m->t->tree, &at, &l.radius2, move_meet, &l);
  *added = l.added > 0;
  return !*added;
}

/* ---- above ---- */

/* A point of the disc: the farthest from c (way = -1), or the nearest, but for 2^-50 of the radius. d: c seen from the
 * site. */
static void disc_choice(dyd_dd_bounded out[2], const dyd_move_site *s, const dyd_dd_bounded d[2], double t, int way) {
  double size = hypot(d[0].h, d[1].h), r = way * s->weight * (1 - 0x1p-50);
  out[0] = dyd_dd_plus(s->x, dd_product(t, r * (d[0].h / size)), 1);
  out[1] = dyd_dd_plus(s->y, dd_product(t, r * (d[1].h / size)), 1);
}

/* A corner of the square of the end, and the point of another square that is nearest to c. */
static void square_choice(dyd_dd_bounded out[2], const dyd_moves *m, const dyd_move_plane *p, const dyd_dd_bounded d[2],
                          double t, bool end) {
  const dyd_move_site *s = &m->site[end ? p->end : p->other];
  const dyd_dd_bounded *place[2] = {&s->x, &s->y};
  for (int a = 0; a < 2; a++) {
    bool beside = !end && dyd_dd_sign(dyd_dd_plus(dyd_dd_of(t), dd_size(d[a]), -1)) > 0;
    int way = end ? -p->way[a] : d[a].h < 0 ? -1 : 1;
    out[a] = beside ? m->at[a] : dyd_dd_plus(*place[a], dyd_dd_of(t), way);
  }
}

/* The vector between choices, and a bound of its errors: false, unless c is as near to b as to a. */
static bool move_refutes(double out[3], const dyd_moves *m, const dyd_move_plane *plane, double t) {
  dyd_dd_bounded p[2][2], far[2], d[2];
  for (int n = 0; n < 2; n++) {
    const dyd_move_site *s = &m->site[n ? plane->other : plane->end];
    move_from(d, m, s);
    if (m->square)
      square_choice(p[n], m, plane, d, t, n == 0);
    else
      disc_choice(p[n], s, d, t, n ? 1 : -1);
    for (int a = 0; a < 2; a++) d[a] = dyd_dd_plus(m->at[a], p[n][a], -1);
    far[n] = dyd_dd_square_sum(d[0], d[1]);
  }
  out[2] = 0;
  for (int a = 0; a < 2; a++) {
    dyd_dd_bounded v = dyd_dd_plus(p[1][a], p[0][a], -1);
    out[a] = v.h;
    out[2] += 2 * v.e + 0x1p-50 * fabs(v.h);
  }
  return dyd_dd_sign(dyd_dd_plus(far[0], far[1], -1)) > 0;
}

/* Sign of the turn from a to b, certainly. */
static int move_turn(const double a[3], const double b[3]) {
  double x = a[0] * b[1], y = a[1] * b[0], sizes = fabs(a[0]) + fabs(a[1]) + a[2];
  double doubt = 2 * (sizes * b[2] + (fabs(b[0]) + fabs(b[1])) * a[2]) + 0x1p-50 * (fabs(x) + fabs(y)) + DYD_DD_TINY;
  return x - y > doubt ? 1 : y - x > doubt ? -1 : 0;
}

/* Does no centre show the pair at t? */
static bool moves_fail(const dyd_moves *m, double t) {
  double d[3][3];
  if (t >= m->contact) {
    const dyd_move_site *e = &m->site[m->touch[0]], *k = &m->site[m->touch[1]];
    dyd_dd_bounded x = dyd_dd_plus(k->x, e->x, -1), y = dyd_dd_plus(k->y, e->y, -1);
    dyd_dd_bounded r = dyd_dd_plus(dd_product(t, k->weight), dd_product(t, e->weight), 1);
    if (dyd_dd_sign(dyd_dd_plus(dyd_dd_times(r, r), dyd_dd_square_sum(x, y), -1)) > 0) return true;
  }
  for (int n = 0; n < 3; n++)
    if (m->basis[n] < DYD_MOVES_CONE || !move_refutes(d[n], m, &m->plane[m->basis[n]], t)) return false;
  int turn = move_turn(d[0], d[1]);
  return turn && move_turn(d[1], d[2]) == turn && move_turn(d[2], d[0]) == turn;
}

/* ---- a row ---- */

/* Where the row without weights says: the bisectors of ij and kl cross; or beyond the end that k touches. */
static void moves_start(dyd_moves *m, bool two) {
  double jx = m->site[1].x.h, jy = m->site[1].y.h, ax = m->site[2].x.h, ay = m->site[2].y.h;
  if (two) {
    double bx = m->site[3].x.h, by = m->site[3].y.h, dx = bx - ax, dy = by - ay;
    double s = (((ax + bx - jx) / 2) * dx + ((ay + by - jy) / 2) * dy) / (jx * dy - jy * dx);
    m->x = jx / 2 - s * jy;
    m->y = jy / 2 + s * jx;
  } else {
    m->touch[0] = hypot(ax - jx, ay - jy) < hypot(ax, ay);
    m->touch[1] = 2;
    m->x = m->site[m->touch[0]].x.h * 2 - ax;
    m->y = m->site[m->touch[0]].y.h * 2 - ay;
  }
}

bool dyd_moves_begin(dyd_moves *m, dyd_others *o, const dyd_tolerance *t, const uint32_t of[4], int way) {
  uint32_t most = way > 0 ? DYD_HUB : FIRST_AROUND;
  m->t = t;
  m->square = t->options.metric == DYD_METRIC_BOX;
  m->way = way;
  m->count = 0;
  m->contact = m->goal = HUGE_VAL;
  for (uint32_t k = 0; k < 3; k++) m->basis[k] = k;
  for (uint32_t k = 0; k < 2; k++) m->touch[k] = k;
  if (dyd_is_line(t->pd) || !t->points.usable || dyd_others_around(o, t, of[0], of[1], most) != DYD_OK) return false;
  for (int k = 0; k < 4; k++)
    if (of[k] != DYD_NONE) dyd_moves_see(m, of[k]);
  for (size_t k = 0; k < o->count; k++) dyd_moves_see(m, o->vertex[k]);
  const dyd_dd_bounded *x = &m->site[1].x, *y = &m->site[1].y;
  double jj = x->h * x->h + y->h * y->h;
  return m->count > 2 && jj > 0x1p-400 && jj < 0x1p400 && x->e + y->e < 0x1p-60 * sqrt(jj);
}

/* Of squares, about: the site that is nearest to c on each side of ij. */
static void squares_beside(uint32_t k[2], const dyd_moves *m) {
  double least[2] = {HUGE_VAL, HUGE_VAL}, jx = m->site[1].x.h, jy = m->site[1].y.h;
  for (uint32_t n = 2; n < m->count; n++) {
    const dyd_move_site *s = &m->site[n];
    double x = fmax(fabs(s->x.h - m->x) - m->now, 0), y = fmax(fabs(s->y.h - m->y) - m->now, 0), d = x * x + y * y;
    int side = jx * s->y.h - jy * s->x.h > 0;
    if (!(d < least[side])) continue;
    least[side] = d;
    k[side] = m->t->sk->reps.site[s->vertex];
  }
}

/* Of discs: the sites of the planes that meet. */
static void discs_beside(uint32_t k[2], const dyd_moves *m) {
  bool touches = m->now >= m->contact * (1 - DYD_MOVES_CLOSE);
  for (int n = 0; n < 3; n++) {
    uint32_t v = m->t->sk->reps.site[m->site[touches ? m->touch[1] : m->plane[m->basis[n]].other].vertex];
    if (v != k[0] && v != k[1]) k[k[0] != DYD_NO_SITE] = v;
  }
}

static void moves_bind(dyd_tolerance_row *row, const dyd_moves *m) {
  uint32_t k[2] = {DYD_NO_SITE, DYD_NO_SITE};
  (m->square ? squares_beside : discs_beside)(k, m);
  row->k = k[0] < k[1] ? k[0] : k[1];
  row->l = k[0] < k[1] ? k[1] : k[0];
}

static bool begin_death(dyd_moves *m, dyd_others *o, const dyd_tolerance *t, const dyd_tolerance_row *row) {
  const uint32_t *v = t->sk->vertex, l = row->l == DYD_NO_SITE ? DYD_NONE : v[row->l];
  if (row->k == DYD_NO_SITE || !dyd_moves_begin(m, o, t, (uint32_t[]){v[row->i], v[row->j], v[row->k], l}, 1))
    return false;
  moves_start(m, l != DYD_NONE);
  return isfinite(m->x) && isfinite(m->y);
}

bool dyd_filter_moved_death(dyd_tolerance_row *row, const dyd_tolerance *t, dyd_others *spare) {
  dyd_moves m;
  bool added = true, known = begin_death(&m, spare, t, row);
  double lo = 0, hi = 0;
  for (int look = 0; known && added && look < MOST_LOOKS; look++) {
    added = false;
    known = dyd_moves_climb(&m);
    if (known) dyd_moves_refine(&m);
    bool good = false;
    for (size_t w = 0; known && !good && !added && dyd_moves_width(&m, w) > 0; w++) {
      lo = m.now * (1 - dyd_moves_width(&m, w));
      hi = m.now * (1 + dyd_moves_width(&m, w));
      good = moves_fail(&m, hi) && dyd_moves_hold(&added, &m, lo);
    }
    known = good || added;
  }
  if (!known || added) return false;
  row->lo = lo * (m.square ? 1 : 1 - DYD_MOVES_SPARE);
  row->hi = hi * (m.square ? 1 : 1 + 2 * DYD_MOVES_SPARE);
  moves_bind(row, &m);
  return true;
}
