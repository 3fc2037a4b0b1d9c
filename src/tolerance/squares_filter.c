/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Who else may come to a disc, in doubles: all that is uncertain is looked at [TOL-9].
 *
 * A square about a point in the box b, of half-width h, is in b widened by h and SPARE of all sizes, and holds what b
 * less all that leaves; distances to these are bounded as in skeleton/distance_filter.h. */
#include "skeleton/rects_filter.h"
#include "tolerance/squares.h"
#include <dyadel/predicate.h>

#include <math.h>

#define SPARE 0x1p-50
#define MORE (1 + 0x1p-20) /* half-widths are rounded outward by less */
enum { MOST_NEW = 6 };
/* So many times as far from i as j is, squared, doubles do not tell who is nearest. */
#define FAR2 0x1p60

dyd_status dyd_squares_see(bool *more, dyd_squares *q, uint32_t v) {
  *more = v != q->i && v != q->j;
  for (size_t k = 0; k < q->seen.count && *more; k++) *more = q->seen.vertex[k] != v;
  return !*more || dyd_others_add(&q->seen, v) ? DYD_OK : DYD_E_NOMEM;
}

/* ---- searches ---- */

/* bound: of squared distances from c; far: everybody who is met is looked at. */
typedef struct square_search {
  dyd_squares *q;
  dyd_bbox c;
  double bound;
  bool legal, far;
  int added;
  dyd_status status;
} square_search;

static dyd_bbox widened(const dyd_bbox *b, double h) {
  double room = SPARE * (fabs(b->e[0]) + fabs(b->e[1]) + fabs(b->e[2]) + fabs(b->e[3]) + h);
  h += h < 0 ? -room : room;
  return (dyd_bbox){{b->e[0] - h, b->e[1] + h, b->e[2] - h, b->e[3] + h}};
}

/* The least square that v can have, each end of which is beyond the opposite end of b. */
static double farthest2_lower(const dyd_bbox *c, const dyd_bbox *b, double h) {
  double room = SPARE * (fabs(b->e[0]) + fabs(b->e[1]) + fabs(b->e[2]) + fabs(b->e[3]) + h);
  dyd_bbox inner = {{b->e[1] - h, b->e[0] + h, b->e[3] - h, b->e[2] + h}};
  return dyd_dl2_lower(c, &inner, room);
}

static bool surely_keeps_out(const square_search *s, uint32_t v) {
  const dyd_bbox *b = &s->q->t->box[v];
  dyd_bbox wide = widened(b, s->q->now * MORE);
  if (s->far) return false;
  return s->legal ? dyd_ds2_lower(&s->c, &wide) > s->bound : farthest2_lower(&s->c, b, s->q->now) >= s->bound;
}

/* Near the circle integers tell. */
static bool keeps_out_exactly(square_search *s, uint32_t v) {
  dyd_rect r[3];
  bool out = true;
  for (int k = 0; k < 3; k++) dyd_rect_init(&r[k]);
  s->status = dyd_square_of(&r[0], s->q, v);
  for (int k = 1; k < 3 && s->status == DYD_OK && out; k++) {
    s->status = dyd_sites_get(&r[k], s->q->sites, (size_t)k - 1);
    out = s->status == DYD_OK && dyd_compare_distance(&s->q->c, &r[k], DYD_FARTHEST, &r[0], DYD_CLOSEST) < 0;
  }
  for (int k = 0; k < 3; k++) dyd_rect_clear(&r[k]);
  return out;
}

static bool meet_rival(void *context, uint32_t v) {
  square_search *s = context;
  bool more;
  if (v == s->q->i || v == s->q->j || surely_keeps_out(s, v)) return true;
  for (size_t k = 0; k < s->q->seen.count; k++)
    if (s->q->seen.vertex[k] == v) return true;
  if (s->legal && keeps_out_exactly(s, v)) return true;
  if (s->status == DYD_OK) s->status = dyd_squares_see(&more, s->q, v);
  return s->status == DYD_OK && ++s->added < MOST_NEW;
}

dyd_status dyd_squares_see_rivals(bool *more, dyd_squares *q) {
  const dyd_rects *r = &q->sk.rects;
  square_search s = {.q = q, .c = dyd_point_box(&q->c), .legal = true};
  s.bound = dyd_pair_dl2_upper(r, &s.c, q->sk.vertex[0], q->sk.vertex[1]);
  q->place = s.c;
  q->guess = (dyd_xy){s.c.e[0], s.c.e[2]};
  double reach = (sqrt(s.bound) + 1.5 * q->now) * (1 + SPARE), reach2 = reach * reach * (1 + SPARE);
  if (!isfinite(reach2)) reach2 = INFINITY;
  dyd_tree_near(&q->t->tree, &s.c, &reach2, meet_rival, &s);
  *more = s.added > 0;
  return s.status;
}

dyd_status dyd_squares_see_blockers(bool *more, dyd_squares *q) {
  const dyd_work *w = &q->work;
  const dyd_rects *r = &q->sk.rects;
  uint32_t v[2] = {q->sk.vertex[0], q->sk.vertex[1]};
  square_search s = {.q = q, .c = {{w->centre.x, w->centre.x, w->centre.y, w->centre.y}}};
  if (w->walked) s.c = w->place;
  s.far = w->walked && w->far;
  if (s.far) {
    double u[2];
    dyd_direction_d(u, w->u[0], w->u[1]);
    double height =
        dyd_min(dyd_height_lower(r, u[0], u[1], &r->box[v[0]]), dyd_height_lower(r, u[0], u[1], &r->box[v[1]]));
    q->place = (dyd_bbox){{NAN, NAN, NAN, NAN}};
    dyd_tree_beyond(&q->t->tree, u[0], u[1], &height, meet_rival, &s);
  } else {
    s.bound = dyd_pair_ds2_upper(r, &s.c, v[0], v[1]);
    q->place = s.c;
    dyd_tree_near(&q->t->tree, &s.c, &s.bound, meet_rival, &s);
  }
  *more = s.added > 0;
  return s.status;
}

/* ---- hints ---- */

static dyd_xy nominal_place(const dyd_squares *q, uint32_t v) {
  return q->t->sk->reps.xy[v];
}

/* Where the bisectors of ij and kl cross: the middle of the widest annulus. */
dyd_xy dyd_squares_guess(const dyd_squares *q, uint32_t k, uint32_t l) {
  dyd_xy i = nominal_place(q, q->i), j = nominal_place(q, q->j), middle = {i.x / 2 + j.x / 2, i.y / 2 + j.y / 2};
  if (k == DYD_NO_SITE || l == DYD_NO_SITE) return middle;
  dyd_xy a = nominal_place(q, q->t->sk->vertex[k]), b = nominal_place(q, q->t->sk->vertex[l]);
  double jx = j.x - i.x, jy = j.y - i.y, dx = b.x - a.x, dy = b.y - a.y;
  double ex = a.x / 2 + b.x / 2 - middle.x, ey = a.y / 2 + b.y / 2 - middle.y;
  double s = (ex * dx + ey * dy) / (jx * dy - jy * dx);
  return isfinite(s) ? (dyd_xy){middle.x - s * jy, middle.y + s * jx} : middle;
}

static void bring_forward(dyd_others *o, size_t to, uint32_t v) {
  size_t at = to;
  while (o->vertex[at] != v) at++;
  o->vertex[at] = o->vertex[to];
  o->vertex[to] = v;
}

void dyd_squares_bind(uint32_t *k, uint32_t *l, dyd_squares *q, bool far) {
  dyd_xy i = nominal_place(q, q->i), j = nominal_place(q, q->j), c = {q->place.e[0], q->place.e[2]};
  double jx = j.x - i.x, jy = j.y - i.y, cx = c.x - i.x, cy = c.y - i.y, least[2] = {HUGE_VAL, HUGE_VAL};
  size_t best[2] = {SIZE_MAX, SIZE_MAX};
  *k = *l = DYD_NONE;
  if (!(cx * cx + cy * cy < FAR2 * (jx * jx + jy * jy))) return;
  for (size_t s = 0; s < q->seen.count; s++) {
    const dyd_bbox *b = &q->t->box[q->seen.vertex[s]];
    dyd_xy p = nominal_place(q, q->seen.vertex[s]);
    dyd_bbox square = widened(b, q->now);
    double d = far ? dyd_dl2_upper(&q->place, &square) : dyd_ds2_lower(&q->place, &square);
    int side = jx * (p.y - i.y) - jy * (p.x - i.x) > 0;
    if (!(d < least[side])) continue;
    least[side] = d;
    best[side] = s;
  }
  for (int side = 0; side < 2; side++)
    if (best[side] != SIZE_MAX) *(*k == DYD_NONE ? k : l) = q->seen.vertex[best[side]];
  if (*l == DYD_NONE) return;
  bring_forward(&q->seen, 0, *k);
  bring_forward(&q->seen, 1, *l);
}
