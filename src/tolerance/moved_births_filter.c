/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Births where points move in discs of weights, or in squares, by a chain of sites [TOL-12].
 *
 * A site q keeps i and j from c at t when the region of q is nearer to c, wherever in it the point is, than those of i
 * and j: for each end up to the t of the same planes, q and the end in each other's place. The set of such c is convex.
 * A chain of sites, a place between each two that both of them keep, and a direction at each end: the path through the
 * places is kept, and where it parts i from j, the pair is illegal. So below the t of all places it is; and at the
 * lowest of them, a little above, c shows that it is possible unless a site keeps it, which is put between the two.
 *
 * Coordinates are those seen from i. */
#include "tolerance/moves_filter.h"
#include "tolerance/state.h"

#include <string.h>

enum { MOST_ROUNDS = 200 };

#define PATH_ROOM 0x1p-46 /* of the sizes, more than roundings of sides make */

#define LEAP 16 /* times the distance of a place from i that a step may take it: farther out paths are not proved */

#define DROP 0x1p-20 /* more than a place found may miss the best by */

/* ---- the chain of a birth ---- */

/* The plane of q in the place of an end, and e in that of the other one. */
static dyd_move_plane birth_plane(const dyd_moves *m, uint32_t q, uint32_t e, double x, double y) {
  const dyd_move_site *s = &m->site[q];
  dyd_move_plane p = {.end = q, .other = e, .way = {x < s->x.h ? -1 : 1, y < s->y.h ? -1 : 1}};
  (m->square ? dyd_plane_of_squares : dyd_plane_of_discs)(&p, s, &m->site[e], x, y);
  return p;
}

/* The t up to which q keeps (x, y). */
static double birth_room(const dyd_moves *m, uint32_t q, double x, double y) {
  return fmin(birth_plane(m, q, 0, x, y).top, birth_plane(m, q, 1, x, y).top);
}

static void link_measure(dyd_moves *m, uint32_t n, double x, double y) {
  dyd_move_link *a = &m->link[n];
  *a = (dyd_move_link){a->site, x, y, fmin(birth_room(m, a->site, x, y), birth_room(m, a[1].site, x, y)), false};
}

/* The chain of unmoved sites. */
static void birth_chain(dyd_moves *m) {
  double jx = m->site[1].x.h, jy = m->site[1].y.h, corner[DYD_MOVES_MOST_SEEN + 1];
  uint32_t chain[DYD_MOVES_MOST_SEEN];
  dyd_line_d line[DYD_MOVES_MOST_SEEN];
  for (uint32_t k = 2; k < m->count; k++) {
    double x = m->site[k].x.h, y = m->site[k].y.h;
    line[k - 2] = (dyd_line_d){.m = x * (x - jx) + y * (y - jy), .n = jx * y - jy * x};
  }
  m->links = dyd_filter_envelope(chain, corner, line, m->count - 2);
  for (uint32_t n = 0; n < m->links; n++) {
    double s = corner[n + 1];
    m->link[n] = (dyd_move_link){chain[n] + 2, jx / 2 - s * jy, jy / 2 + s * jx, HUGE_VAL, false};
  }
  for (uint32_t n = 0; n + 1 < m->links; n++) link_measure(m, n, m->link[n].x, m->link[n].y);
}

/* From place n to the best that its two sites keep. */
static void birth_climb(dyd_moves *m, uint32_t n) {
  dyd_move_link *a = &m->link[n];
  m->pair[0] = a->site;
  m->pair[1] = a[1].site;
  m->x = a->x;
  m->y = a->y;
  dyd_moves_climb(m);
  *a = (dyd_move_link){a->site, m->x, m->y, m->now, !(m->now > m->goal)};
}

/* Three planes of place n become the basis. Returns true if all four have one height: the fourth follows then. */
static bool birth_planes(dyd_moves *m, uint32_t n) {
  const dyd_move_link *a = &m->link[n];
  double most = 0;
  for (uint32_t k = 0; k < 4; k++) {
    m->plane[DYD_MOVES_CONE + k] = birth_plane(m, k < 2 ? a->site : a[1].site, k % 2, a->x, a->y);
    most = fmax(most, m->plane[DYD_MOVES_CONE + k].top);
    if (k < 3) m->basis[k] = DYD_MOVES_CONE + k;
  }
  return most <= a->t + DROP * fabs(a->t);
}

/* Goes from place n to one that is better, no farther than a leap. */
static bool birth_goes(dyd_moves *m, uint32_t n, const dyd_move_plane *to) {
  dyd_move_link *a = &m->link[n], old = *a;
  double part = fmin(1, LEAP * (fabs(a->x) + fabs(a->y)) / hypot(to->x, to->y));
  if (!(to->top - a->t > DYD_MOVES_CLOSE * fabs(a->t))) return false;
  link_measure(m, n, a->x + part * to->x, a->y + part * to->y);
  if (a->t > old.t) return true;
  *a = old;
  return false;
}

/* A step towards the best place: to where the first three planes meet; there all four do, mostly. Or else to the summit
 * of all four, unless it is there, or must climb. */
static void birth_step(dyd_moves *m, uint32_t n) {
  dyd_move_link *a = &m->link[n];
  dyd_move_plane to;
  bool even = birth_planes(m, n), met = dyd_planes_meet(&to, m);
  if (met && birth_goes(m, n, &to)) return;
  a->climbed = met && even && !(to.top - a->t > DROP * fabs(a->t));
  if (a->climbed) return;
  met = dyd_planes_four(&to, m);
  if (met && birth_goes(m, n, &to)) return;
  a->climbed = met && !(to.top - a->t > DROP * fabs(a->t));
  if (!a->climbed) birth_climb(m, n);
}

/* The direction of an end of the path, way = -1 or 1: across ij, or that in which the two are equally far out at t. */
static dyd_xy birth_out(const dyd_moves *m, double t, int way) {
  double jx = m->site[1].x.h, jy = m->site[1].y.h, jj = jx * jx + jy * jy;
  double c = m->square ? 0 : t * (m->site[0].weight - m->site[1].weight) / jj, s = sqrt(fmax(1 / jj - c * c, 0)) * way;
  return (dyd_xy){c * jx - s * jy, c * jy + s * jx};
}

/* By how much more the region of site q is beyond those of i and j than t, about. */
static double birth_out_room(const dyd_moves *m, uint32_t q, dyd_xy u, double t) {
  const dyd_move_site *s = &m->site[q], *i = &m->site[0], *j = &m->site[1];
  double size = m->square ? fabs(u.x) + fabs(u.y) : hypot(u.x, u.y), p = u.x * s->x.h + u.y * s->y.h;
  double end = u.x * j->x.h + u.y * j->y.h, room = fabs(u.x * s->x.h) + fabs(u.y * s->y.h) + fabs(end);
  room += size * (fabs(j->x.h) + fabs(j->y.h) + t * (s->weight + i->weight + j->weight));
  return p - t * size * s->weight - fmax(t * size * i->weight, end + t * size * j->weight) - 0x1p-46 * room;
}

/* The direction in which link n keeps that end at t, or *kept: none. */
static dyd_xy birth_end(bool *kept, const dyd_moves *m, uint32_t n, double t, int way) {
  dyd_xy u = birth_out(m, 0, way);
  if (!(birth_out_room(m, m->link[n].site, u, t) > 0)) u = birth_out(m, t, way);
  *kept = birth_out_room(m, m->link[n].site, u, t) > 0;
  return u;
}

/* ---- below a birth ---- */

/* Does q keep m->at at t? */
static bool birth_keeps(const dyd_moves *m, uint32_t q, double t) {
  dyd_dd_bounded far = dyd_move_reach(m, &m->site[q], t, 1);
  for (int e = 0; e < 2; e++)
    if (dyd_dd_sign(dyd_dd_plus(dyd_move_reach(m, &m->site[e], t, -1), far, -1)) <= 0) return false;
  return true;
}

/* A place of the path. side: which side of ij's line it is certainly on (1: left); between: certainly between the lines
 * across it through i and j. */
typedef struct path_place {
  dyd_xy at;
  int side;
  bool between;
} path_place;

static path_place path_at(const dyd_moves *m, double x, double y) {
  double jx = m->site[1].x.h, jy = m->site[1].y.h, sizes = fabs(jx) + fabs(jy), along = jx * x + jy * y;
  double cross = jx * y - jy * x, room = PATH_ROOM * sizes * (fabs(x) + fabs(y) + sizes);
  return (path_place){{x, y},
                      cross > room    ? 1
                      : cross < -room ? -1
                                      : 0,
                      along > room && jx * jx + jy * jy - along > room};
}

/* Does the path from a to b, on a's line along (x, y), cross ij's line between i and j only? */
static bool path_passes(const dyd_moves *m, const path_place *a, const path_place *b, double x, double y) {
  double jx = m->site[1].x.h, jy = m->site[1].y.h, ax = a->at.x, ay = a->at.y;
  double i = y * ax - x * ay, j = x * (jy - ay) - y * (jx - ax);
  double room = PATH_ROOM * (fabs(x) + fabs(y) + fabs(ax) + fabs(ay) + fabs(b->at.x) + fabs(b->at.y)) *
                (fabs(jx) + fabs(jy) + fabs(ax) + fabs(ay));
  return (a->between && b->between) || (a->side && a->side == b->side) || (i > room && j < -room) ||
         (i < -room && j > room);
}

/* Does the path of the chain part i from j, and is it kept at its ends, at t? */
static bool path_parts(const dyd_moves *m, double t) {
  uint32_t end = m->links - 1;
  bool kept[2];
  dyd_xy first = birth_end(&kept[0], m, 0, t, -1), last = birth_end(&kept[1], m, end, t, 1);
  path_place from = path_at(m, first.x, first.y), out = path_at(m, last.x, last.y), to;
  from.between = out.between = false;
  if (!end || !kept[0] || !kept[1] || from.side >= 0 || out.side <= 0) return false;
  for (uint32_t n = 0; n < end; n++, from = to) {
    to = path_at(m, m->link[n].x, m->link[n].y);
    dyd_xy d = n ? (dyd_xy){to.at.x - from.at.x, to.at.y - from.at.y} : first;
    if (!path_passes(m, &to, &from, d.x, d.y)) return false;
  }
  return path_passes(m, &from, &out, last.x, last.y);
}

/* Is the pair illegal at t? m->at is place n, more precisely than the chain has it. */
static bool birth_is_above(dyd_moves *m, uint32_t best, double t) {
  dyd_dd_bounded at[2] = {m->at[0], m->at[1]};
  bool kept = path_parts(m, t);
  for (uint32_t n = 0; n + 1 < m->links && kept; n++) {
    if (n != best) m->at[0] = dyd_dd_of(m->link[n].x), m->at[1] = dyd_dd_of(m->link[n].y);
    kept = birth_keeps(m, m->link[n].site, t) && birth_keeps(m, m->link[n + 1].site, t);
    m->at[0] = at[0], m->at[1] = at[1];
  }
  return kept;
}

/* ---- the birth of a pair ---- */

/* About up to where an end is kept. */
static double birth_end_room(const dyd_moves *m, int way) {
  const dyd_move_site *q = &m->site[m->link[way < 0 ? 0 : m->links - 1].site];
  double jx = m->site[1].x.h, jy = m->site[1].y.h, n = (jx * q->y.h - jy * q->x.h) * way;
  if (m->square) return n / (2 * (fabs(jx) + fabs(jy)));
  return n / (hypot(jx, jy) * (q->weight + fmax(m->site[0].weight, m->site[1].weight)));
}

/* The number of the place, or of links where an end comes first, that is kept up to the least *t; *next: the least of
 * the others. */
static uint32_t birth_lowest(double *t, double *next, int *end, const dyd_moves *m) {
  uint32_t best = m->links;
  *t = *next = HUGE_VAL;
  for (int way = -1; way <= 1; way += 2) {
    double room = birth_end_room(m, way);
    if (!(room >= *t)) *t = room, *end = way;
  }
  for (uint32_t n = 0; n + 1 < m->links; n++) {
    double here = m->link[n].t;
    *next = fmin(*next, here >= *t ? here : *t);
    if (!(here >= *t)) *t = here, best = n;
  }
  return best;
}

static bool meet_beyond(void *context, uint32_t v) {
  dyd_moves *m = context;
  m->planes += v != m->site[0].vertex && v != m->site[1].vertex && dyd_moves_see(m, v);
  return m->planes < DYD_MOVES_MOST_ADDED && m->count < 2 + DYD_MOVES_MOST_SEEN;
}

/* Adds sites that are farther out at the end. */
static bool birth_look_out(dyd_moves *m, int way) {
  const dyd_move_site *q = &m->site[m->link[way < 0 ? 0 : m->links - 1].site];
  dyd_xy i = m->t->points.xy[m->site[0].vertex], u = birth_out(m, 0, way);
  double size = hypot(u.x, u.y), x = u.x / size, y = u.y / size, height = x * (i.x + q->x.h) + y * (i.y + q->y.h);
  m->planes = 0; /* of sites added */
  dyd_tree_beyond(&m->t->tree, x, y, &height, meet_beyond, m);
  return m->planes > 0;
}

/* Of the sites seen only those of the chain stay: searches find the others again, if they are needed. */
static void birth_forget(dyd_moves *m) {
  uint32_t count = 2, to[2 + DYD_MOVES_MOST_SEEN];
  for (uint32_t k = 2; k < m->count; k++) {
    uint32_t n = 0;
    while (n < m->links && m->link[n].site != k) n++;
    to[k] = count;
    if (n < m->links) m->site[count++] = m->site[k];
  }
  for (uint32_t n = 0; n < m->links; n++) m->link[n].site = to[m->link[n].site];
  m->count = count;
}

static void move_links(dyd_moves *m, uint32_t from, uint32_t to) {
  memmove(&m->link[to], &m->link[from], (m->links - from) * sizeof *m->link);
  m->links = m->links - from + to;
}

/* Puts site q between links n and n + 1; or, where q is a link, drops the links between. false: they are full. */
static bool birth_insert(dyd_moves *m, uint32_t n, uint32_t q) {
  uint32_t known = 0, place = n;
  double x = m->link[n].x, y = m->link[n].y;
  while (known < m->links && m->link[known].site != q) known++;
  if (known == DYD_MOVES_MOST_SEEN) return false;
  if (known < n) {
    move_links(m, n + 1, (place = known) + 1);
  } else if (known < m->links) {
    move_links(m, known, n + 1);
  } else {
    move_links(m, n + 1, n + 2);
    m->link[n + 1].site = q;
    link_measure(m, n + 1, x, y);
  }
  link_measure(m, place, x, y);
  return true;
}

/* How far the region of a site may be from the place at t; at t < 0: must be at -t. Of squares the square. */
static double birth_reach(const dyd_moves *m, const dyd_move_link *a, uint32_t k, double t) {
  double x = fabs(a->x - m->site[k].x.h), y = fabs(a->y - m->site[k].y.h);
  if (!m->square) return sqrt(x * x + y * y) + t * m->site[k].weight;
  x = fmax(x + t, 0);
  y = fmax(y + t, 0);
  return x * x + y * y;
}

/* Puts the site between links n and n + 1 that keeps the place longest, and longer than those; false: there is none, or
 * no room. */
static bool birth_split(dyd_moves *m, uint32_t n) {
  const dyd_move_link *a = &m->link[n];
  double most = a->t + DYD_MOVES_CLOSE * fabs(a->t),
         reach = fmin(birth_reach(m, a, 0, -a->t), birth_reach(m, a, 1, -a->t));
  uint32_t q = 0;
  for (uint32_t k = 2; k < m->count; k++) {
    if (k == a->site || k == a[1].site || birth_reach(m, a, k, a->t) > reach) continue;
    double room = birth_room(m, k, a->x, a->y);
    if (room > most) most = room, q = k;
  }
  return q && birth_insert(m, n, q);
}

/* Takes link d out; its better place is between its two neighbours. */
static void birth_unlink(dyd_moves *m, uint32_t d) {
  dyd_move_link old = m->link[d], *a = &m->link[d - (d > 0)];
  move_links(m, d + 1, d);
  if (d == m->links) *a = (dyd_move_link){a->site, 0, 0, HUGE_VAL, true};
  if (d == 0 || d == m->links) return;
  link_measure(m, d - 1, a->x, a->y);
  dyd_move_link first = *a;
  link_measure(m, d - 1, old.x, old.y);
  if (first.t > a->t) *a = first;
}

/* Where one of the two sites keeps place n longer than the other, which keeps nothing from there on: that goes. */
static bool birth_drop(dyd_moves *m, uint32_t n) {
  const dyd_move_link *a = &m->link[n];
  double most = a->t + DROP * fabs(a->t);
  bool one = birth_room(m, a->site, a->x, a->y) > most, two = birth_room(m, a[1].site, a->x, a->y) > most;
  if (one == two || m->links == 2) return false;
  birth_unlink(m, two ? n : n + 1);
  return true;
}

/* The row by place n, or *added: sites that may keep it. false: not certain. */
static bool birth_confirm(bool *added, dyd_tolerance_row *row, dyd_moves *m, uint32_t n, double up_to) {
  dyd_move_link *a = &m->link[n];
  dyd_move_plane to;
  m->x = a->x;
  m->y = a->y;
  if (!birth_planes(m, n) && !dyd_planes_four(&to, m)) birth_climb(m, n);
  m->now = fmax(a->t, 0);
  dyd_moves_refine(m);
  a->x = m->x;
  a->y = m->y;
  for (size_t tries = 0; dyd_moves_width(m, tries) > 0; tries++) {
    double width = dyd_moves_width(m, tries), lo = m->now * (1 - width), hi = m->now * (1 + width),
           spare = m->square ? 0 : DYD_MOVES_SPARE;
    bool good = dyd_moves_hold(added, m, hi);
    if (*added) return true;
    if (!good || !(lo > 0 && birth_is_above(m, n, lo))) continue;
    *row = dyd_row_of(m->t, m->site[0].vertex, m->site[1].vertex, DYD_EVENT_BIRTH, m->site[a->site].vertex,
                      m->site[a[1].site].vertex, lo * (1 - spare), hi * (1 + 2 * spare));
    return row->hi <= up_to * (1 - 0x1p-50);
  }
  return false;
}

bool dyd_filter_moved_birth(dyd_tolerance_row *row, bool *late, const dyd_tolerance *t, uint32_t i, uint32_t j,
                            double up_to, dyd_others *spare) {
  dyd_moves m;
  bool added = true;
  *late = false;
  if (!dyd_moves_begin(&m, spare, t, (uint32_t[]){i, j, DYD_NONE, DYD_NONE}, -1)) return false;
  birth_chain(&m);
  for (int round = 0; round < MOST_ROUNDS; round++) {
    double least, next;
    int end = 1;
    if (m.count + DYD_MOVES_MOST_ADDED > 2 + DYD_MOVES_MOST_SEEN) birth_forget(&m);
    uint32_t n = birth_lowest(&least, &next, &end, &m);
    if (least > up_to) return *late = birth_is_above(&m, m.links, up_to);
    if (n == m.links) {
      if (!birth_look_out(&m, end)) return false;
      birth_chain(&m);
    } else if (!m.link[n].climbed) {
      m.goal = fmin(next, up_to); /* above it other places count */
      birth_step(&m, n);
      m.goal = HUGE_VAL;
    } else if (!birth_drop(&m, n) && !birth_split(&m, n)) {
      if (!birth_confirm(&added, row, &m, n, up_to)) return false;
      if (!added) return true;
      if (least <= 0) birth_chain(&m);
    }
  }
  return false;
}
