/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sites of a cell in doubles: which of them take points from the others, and a box that holds the region. */
#include "voronoi/outline_sites_filter.h"

#include "base/alloc.h"
#include "base/local.h"
#include "rect/rect.h"
#include "rect/sites_table.h"

#include <stdlib.h>

/* ---- what rivals take ---- */

/* Parts of a rival: xlo, xhi, ylo, yhi, slack and number; in groups of LANES rivals, part by part. */
enum { LANES = 4, RIVAL_SLACK = 4, RIVAL_NUMBER, RIVAL_PARTS };

static inline double *rival_part(const dyd_outline_rivals *r, int part, size_t k) {
  return &r->part[(k / LANES * RIVAL_PARTS + (size_t)part) * LANES + k % LANES];
}

/* A lower or upper bound of the squared distance to a box of all points in c. */
static inline double outline_distance2(const dyd_bbox *c, const dyd_outline_rival *r, bool farthest, bool upper) {
  if (farthest) return upper ? dyd_dl2_upper(c, &r->box) : dyd_dl2_lower(c, &r->box, r->slack);
  return upper ? dyd_ds2_upper(c, &r->box, r->slack) : dyd_ds2_lower(c, &r->box);
}

/* Exchanges rivals a and b. */
static void rivals_swap(dyd_outline *o, size_t a, size_t b) {
  const size_t to[2] = {b, a};
  for (int e = 0; e < RIVAL_PARTS; e++) {
    double *p = rival_part(&o->rivals, e, a), *q = rival_part(&o->rivals, e, b), part = *p;
    *p = *q;
    *q = part;
  }
  for (int k = 0; k < 2; k++) o->item[(size_t)*rival_part(&o->rivals, RIVAL_NUMBER, to[k])].place = to[k];
}

/* Only sites other than `own` take points from now on; o->count: all others. */
void dyd_outline_exclude(dyd_outline *o, size_t own) {
  o->rivals.count = o->rivals.all;
  if (own == o->count) return;
  o->rivals.count--;
  if (o->item[own].place != o->rivals.count) rivals_swap(o, o->item[own].place, o->rivals.count);
}

/* The first rival, of LANES from m on, whose distance is certainly below `least`; r->all: none. */
static inline size_t rivals_nearer(const dyd_outline_rivals *r, size_t m, const dyd_bbox *c, bool farthest,
                                   double least) {
  double upper[LANES], below = HUGE_VAL;
  const double *p = rival_part(r, 0, m);
  for (int k = 0; k < LANES; k++) {
    const dyd_bbox b = {{p[k], p[LANES + k], p[2 * LANES + k], p[3 * LANES + k]}};
    upper[k] = farthest ? dyd_dl2_upper(c, &b) : dyd_ds2_upper(c, &b, p[RIVAL_SLACK * LANES + k]);
  }
  for (int k = 0; k < LANES; k++) below = dyd_min(below, upper[k]);
  if (!(below < least)) return r->all;
  for (int k = 0; k < LANES; k++)
    if (upper[k] < least && m + k < r->count) return m + k;
  return r->all;
}

/* Returns true if a site certainly takes all points of the box away from all that are excluded. A site that takes a
 * point likely takes the next, and comes first. */
bool dyd_outline_taken(dyd_outline *o, const dyd_iv at[2]) {
  const dyd_bbox c = {{at[0].lo, at[0].hi, at[1].lo, at[1].hi}};
  dyd_outline_rivals *r = &o->rivals;
  double least = outline_distance2(&c, &o->item[o->count].reach, !o->outer, false);
  if (o->blind || o->keep_all || !isfinite(c.e[0] + c.e[1] + c.e[2] + c.e[3])) return false;
  for (size_t m = 0; m < r->count; m += LANES) {
    size_t k = o->outer ? rivals_nearer(r, m, &c, true, least) : rivals_nearer(r, m, &c, false, least);
    if (k == r->all) continue;
    if (k) rivals_swap(o, k, 0);
    return true;
  }
  return false;
}

/* May other k be within `most` of a point of c, squared? */
static inline bool is_within(const dyd_outline *o, size_t k, const dyd_bbox *c, double most) {
  return !(outline_distance2(c, &o->item[k].reach, o->outer, false) > most);
}

/* Bounds the square of the radius at all points of the box from above; infinite: not known. */
static double radius2_upper(const dyd_outline *o, const dyd_bbox *c) {
  bool known = !o->blind && isfinite(c->e[0] + c->e[1] + c->e[2] + c->e[3]);
  return known ? outline_distance2(c, &o->item[o->count].reach, !o->outer, true) : HUGE_VAL;
}

bool dyd_outline_may_take(const dyd_outline *o, size_t k, const dyd_iv at[2]) {
  const dyd_bbox c = {{at[0].lo, at[0].hi, at[1].lo, at[1].hi}};
  return is_within(o, k, &c, radius2_upper(o, &c));
}

bool dyd_outline_may_be_taken(const dyd_outline *o, const dyd_iv at[2]) {
  const dyd_bbox c = {{at[0].lo, at[0].hi, at[1].lo, at[1].hi}};
  double most = radius2_upper(o, &c);
  for (size_t m = 0; m < o->rivals.count; m++)
    if (is_within(o, (size_t)*rival_part(&o->rivals, RIVAL_NUMBER, m), &c, most)) return true;
  return false;
}

/* ---- points of an arc ---- */

/* Lines: with n = q - s, m = q + s the other coordinate is m_o/2 + (n_k/n_o) (m_k/2 - t). Parabolas: with h = s_o - q_o
 * it is ((t - s_k)^2 / h + q_o + s_o) / 2. */
dyd_iv dyd_outline_arc_other(const dyd_filter_arc *arc, int k, dyd_iv at) {
  int o = 1 - k;
  dyd_iv mo = dyd_iv_scale(dyd_iv_add(arc->q[o], arc->s[o]), 0.5);
  if (arc->parabola) {
    dyd_iv h = dyd_iv_sub(arc->s[o], arc->q[o]);
    return dyd_iv_add(dyd_iv_scale(dyd_iv_div(dyd_iv_sqr(dyd_iv_sub(at, arc->s[k])), h), 0.5), mo);
  }
  dyd_iv mk = dyd_iv_scale(dyd_iv_add(arc->q[k], arc->s[k]), 0.5);
  dyd_iv slope = dyd_iv_div(dyd_iv_sub(arc->q[k], arc->s[k]), dyd_iv_sub(arc->q[o], arc->s[o]));
  return dyd_iv_add(mo, dyd_iv_mul(slope, dyd_iv_sub(mk, at)));
}

/* Around both; unknown where an end is not a number. */
static dyd_iv outline_hull(dyd_iv p, dyd_iv q) {
  if (!isfinite(p.lo + p.hi + q.lo + q.hi)) return DYD_IV_UNKNOWN;
  return (dyd_iv){p.lo < q.lo ? p.lo : q.lo, p.hi > q.hi ? p.hi : q.hi};
}

dyd_outline_spot dyd_outline_arc_at(const dyd_outline_arc *a, dyd_iv t) {
  dyd_outline_spot p = {.side = {-1, -1}};
  p.at[a->axis] = t;
  p.at[1 - a->axis] = dyd_outline_arc_other(&a->shape, a->axis, t);
  return p;
}

/* Are all parts of the arc between p and q, or (a = NULL) of the segment along axis k, taken? A middle that is not ends
 * it. */
static bool parts_are_taken(dyd_outline *o, const dyd_outline_arc *a, int k, const dyd_outline_spot *p,
                            const dyd_outline_spot *q, int depth) {
  double t = p->at[k].hi / 2 + q->at[k].lo / 2;
  if (!depth || !(p->at[k].hi < t && t < q->at[k].lo)) return false;
  dyd_outline_spot m = *p;
  m.at[k] = dyd_iv_point(t);
  if (a) m = dyd_outline_arc_at(a, m.at[k]);
  if (!dyd_outline_taken(o, m.at)) return false;
  for (int part = 0; part < 2; part++) {
    const dyd_outline_spot *from = part ? &m : p, *to = part ? q : &m;
    dyd_iv span[2];
    for (int c = 0; c < 2; c++) span[c] = outline_hull(from->at[c], to->at[c]); /* monotone between them [ARC-1] */
    if (!dyd_outline_taken(o, span) && !parts_are_taken(o, a, k, from, to, depth - 1)) return false;
  }
  return true;
}

enum { STRETCHES = 3 }; /* how often an arc is halved, to find that it is taken */

bool dyd_outline_arc_taken(dyd_outline *o, dyd_outline_arc *a) {
  for (int k = 0; k < 2; k++) a->span[k] = outline_hull(a->end[0].at[k], a->end[1].at[k]); /* monotone [ARC-1] */
  return dyd_outline_taken(o, a->span) || parts_are_taken(o, a, a->axis, &a->end[0], &a->end[1], STRETCHES);
}

/* ---- the site and the others ---- */

/* Sides of the rectangle that are one number, where outward doubles leave it open. */
static void site_find_thin(dyd_outline *o, size_t i) {
  dyd_outline_site *t = &o->item[i];
  const dyd_box *b = &t->box;
  bool open[2];
  for (int a = 0; a < 2; a++) {
    t->thin[a] = b->outer[2 * a] == b->outer[2 * a + 1];
    open[a] = !t->thin[a] && b->end[2 * a].hi >= b->end[2 * a + 1].lo;
  }
  if (!open[0] && !open[1]) return;
  DYD_LOCAL(dyd_rect, fetched);
  const dyd_rect *r = dyd_outline_rect(o, &fetched, i);
  for (int a = 0; a < 2; a++) {
    const dyd_interval *side = a ? &r->y : &r->x;
    if (open[a]) t->thin[a] = !dyd_dyadic_cmp(&side->lo, &side->hi);
  }
}

/* The ends of the box, each within the last place of an outward double if doubles do not hold it. */
static void box_load(dyd_box *out, const dyd_sites *s, uint32_t i) {
  dyd_sites_get_d(out->outer, s, i);
  out->exact = dyd_sites_in_doubles(s, i);
  for (int k = 0; k < 4; k++) {
    double e = out->outer[k], inward = out->exact ? e : nextafter(e, k & 1 ? -INFINITY : INFINITY);
    out->end[k] = (dyd_iv){fmin(e, inward), fmax(e, inward)};
  }
}

static dyd_status outline_reserve(dyd_outline *o, size_t count) {
  if (!DYD_GROW(o->item, o->item_cap, count + 1)) return DYD_E_NOMEM;
  if (!DYD_GROW(o->rivals.part, o->rival_cap, (count + LANES) * RIVAL_PARTS)) return DYD_E_NOMEM;
  o->count = count;
  return DYD_OK;
}

/* item[0 .. count] have their site and rect. */
static dyd_status outline_load_boxes(dyd_outline *o) {
  o->blind = false;
  o->status = DYD_OK;
  for (size_t k = 0; k <= o->count && o->status == DYD_OK; k++) {
    dyd_outline_site *t = &o->item[k];
    if (t->rect)
      dyd_filter_box(&t->box, t->rect);
    else
      box_load(&t->box, o->sites, t->site);
    for (int e = 0; e < 4; e++) o->blind = o->blind || !isfinite(t->box.outer[e]);
    site_find_thin(o, k);
  }
  for (int a = 0; a < 2; a++) o->origin[a] = o->blind ? 0 : o->item[o->count].box.outer[2 * a];
  for (int k = 0; k < 4; k++) o->limit[k] = k & 1 ? INFINITY : -INFINITY;
  return o->status;
}

dyd_status dyd_outline_load(dyd_outline *o, const dyd_delaunay *pd, uint32_t i, dyd_pair_status least) {
  DYD_SCOPED(dyd_index_list) list = {0};
  dyd_status st = dyd_delaunay_neighbours(&list, pd, i, least);
  if (st == DYD_OK) st = outline_reserve(o, list.count);
  if (st != DYD_OK) return st;
  o->sites = dyd_delaunay_sites(pd);
  for (size_t k = 0; k <= list.count; k++) o->item[k] = (dyd_outline_site){.site = k < list.count ? list.item[k] : i};
  return outline_load_boxes(o);
}

dyd_status dyd_outline_load_rects(dyd_outline *o, uint32_t own, const dyd_rect *const *rect, const uint32_t *other,
                                  size_t count) {
  dyd_status st = outline_reserve(o, count);
  if (st != DYD_OK) return st;
  for (size_t k = 0; k < count; k++) o->item[k] = (dyd_outline_site){.site = other[k], .rect = rect[k + 1]};
  o->item[count] = (dyd_outline_site){.site = own, .rect = rect[0]};
  return outline_load_boxes(o);
}

void dyd_outline_clear(dyd_outline *o) {
  dyd_outline_exact_clear(o);
  dyd_free_all(o->rivals.part, o->item, o->arc, o->meet, o->piece, o->next, o->last, o->cut);
  *o = (dyd_outline){0};
}

static void ends_place(dyd_iv out[4], const dyd_box *b, const double origin[2]) {
  for (int k = 0; k < 4; k++) out[k] = dyd_iv_sub(b->end[k], dyd_iv_point(origin[k >> 1]));
}

static void site_place(dyd_outline_site *t, const double origin[2]) {
  dyd_outline_rival *r = &t->reach;
  const dyd_iv *end = t->near;
  ends_place(t->near, &t->box, origin);
  *r = (dyd_outline_rival){{{end[0].lo, end[1].hi, end[2].lo, end[3].hi}}, 0};
  for (int e = 0; e < 4; e++) r->slack = dyd_max(r->slack, dyd_up(end[e].hi - end[e].lo));
}

/* Returns true if the closed rectangles of sites a and b meet. */
static bool outline_rects_meet(dyd_outline *o, size_t a, size_t b) {
  bool doubt = false;
  const dyd_iv *p = o->item[a].box.end, *q = o->item[b].box.end;
  for (int k = 0; k < 4; k += 2)
    if (dyd_outline_order(&doubt, p[k], q[k + 1]) > 0 || dyd_outline_order(&doubt, q[k], p[k + 1]) > 0) return false;
  if (!doubt) return true;
  DYD_LOCAL(dyd_rect, r, t);
  const dyd_rect *one = dyd_outline_rect(o, &r, a), *other = dyd_outline_rect(o, &t, b);
  return o->status == DYD_OK && dyd_rect_meets(one, other);
}

static void corner_place(dyd_outline *o, uint32_t k) {
  int side[2] = {k == 1 || k == 2, k >= 2};
  o->corner[k] = (dyd_outline_spot){
      {o->frame[side[0]], o->frame[2 + side[1]]}, {side[0], side[1]}, false, DYD_OUTLINE_CORNER, k, NULL};
}

bool dyd_outline_place(dyd_outline *o, const dyd_rect *window) {
  bool free = true;
  o->rect = window;
  if (window) dyd_filter_box(&o->window, window);
  if (window) ends_place(o->frame, &o->window, o->origin);
  for (size_t k = 0; k <= o->count; k++) site_place(&o->item[k], o->origin);
  dyd_outline_rivals *v = &o->rivals;
  v->all = 0;
  for (size_t k = 0; k < o->count; k++) {
    dyd_outline_site *t = &o->item[k];
    t->drop = outline_rects_meet(o, k, o->count);
    free = free && !t->drop;
    if (t->drop) continue;
    for (int e = 0; e < 4; e++) *rival_part(v, e, v->all) = t->reach.box.e[e];
    *rival_part(v, RIVAL_SLACK, v->all) = t->reach.slack;
    *rival_part(v, RIVAL_NUMBER, v->all) = (double)k;
    t->place = v->all++;
  }
  for (size_t k = v->all; k % LANES; k++) /* never nearer */
    for (int e = 0; e <= RIVAL_SLACK; e++) *rival_part(v, e, k) = HUGE_VAL;
  v->count = v->all;
  for (uint32_t k = 0; k < 4 && window; k++) corner_place(o, k);
  return free;
}

/* ---- limits ---- */

/* How far the others are from the origin, at most, in one coordinate. */
static double outline_reach(const dyd_outline *o) {
  double most = 0;
  for (size_t k = 0; k < o->count; k++)
    for (int e = 0; e < 4; e++) most = fmax(most, fabs(o->item[k].reach.box.e[e]));
  return most;
}

/* Is the site inside of the box, and is all of side k of it taken away, whole or in parts? */
static bool box_has_side(dyd_outline *o, const double box[4], int k) {
  const double *own = o->item[o->count].reach.box.e, *along = box + (k < 2 ? 2 : 0);
  const int axis = k < 2;
  for (int e = 0; e < 4; e++)
    if (e & 1 ? !(own[e] < box[e]) : !(box[e] < own[e])) return false;
  dyd_outline_spot end[2] = {0}, all = {0};
  all.at[1 - axis] = end[0].at[1 - axis] = end[1].at[1 - axis] = dyd_iv_point(box[k]);
  for (int e = 0; e < 2; e++) end[e].at[axis] = dyd_iv_point(along[e]);
  all.at[axis] = (dyd_iv){along[0], along[1]};
  return dyd_outline_taken(o, all.at) || parts_are_taken(o, NULL, axis, &end[0], &end[1], STRETCHES + 1);
}

/* Draws side k nearer to the site as long as it is taken away. Other sides become shorter, so they stay so. */
static void draw_side(dyd_outline *o, double box[4], int k) {
  for (int step = 0; step < 4; step++) {
    double old = box[k];
    box[k] = o->item[o->count].reach.box.e[k] * 0.25 + old * 0.75;
    if (!box_has_side(o, box, k)) box[k] = old;
  }
}

/* A box whose border is taken away around the site has Pos, which is connected and holds the site, inside. */
void dyd_outline_limit_by_box(dyd_outline *o) {
  static const double share[] = {0.4, 0.6, 0.8, 1.25, 2, 4};
  double reach = outline_reach(o), box[4];
  size_t shares = sizeof share / sizeof *share, m = 0;
  for (int sides = 0; m < shares && sides < 4; m += sides < 4) {
    for (int k = 0; k < 4; k++) box[k] = o->item[o->count].reach.box.e[k] + (k & 1 ? reach : -reach) * share[m];
    for (sides = 0; sides < 4 && box_has_side(o, box, sides);) sides++;
  }
  if (m == shares) return;
  for (int k = 0; k < 4; k++) draw_side(o, box, k);
  for (int k = 0; k < 4; k++) {
    double at = o->origin[k >> 1] + box[k];
    o->limit[k] = k & 1 ? dyd_up(at) : dyd_down(at);
  }
}

/* Int is in Pos, whose arcs are in the boxes of their ends. A little more, so that nothing ends at a limit. */
void dyd_outline_limit_by_parts(dyd_outline *o) {
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (size_t p = 0; p < o->pieces; p++)
    for (int e = 0; e < 2; e++)
      for (int k = 0; k < 4; k++) {
        const dyd_outline_spot *end = e ? o->piece[p].end : o->piece[p].begin;
        dyd_iv at = dyd_outline_coordinate(o, end, k >> 1);
        if (end->infinite || !isfinite(at.lo + at.hi)) return;
        box[k] = k & 1 ? dyd_max(box[k], at.hi) : dyd_min(box[k], at.lo);
      }
  for (int k = 0; k < 4 && o->pieces; k++) {
    double more = 0x1p-10 * (box[k | 1] - box[k & 2]);
    o->limit[k] = k & 1 ? fmin(o->limit[k], box[k] + more) : fmax(o->limit[k], box[k] - more);
  }
}

void dyd_outline_set_bounds(dyd_outline *o) {
  for (int k = 0; k < 4; k++) {
    dyd_iv end = o->rect ? o->window.end[k] : DYD_IV_UNKNOWN;
    bool limited = isfinite(o->limit[k]) && !o->keep_all;
    o->of_window[k] = o->rect && !(limited && (k & 1 ? o->limit[k] < end.lo : o->limit[k] > end.hi));
    o->bounded[k] = o->rect || limited;
    o->bound[k] = o->of_window[k] ? end : limited ? dyd_iv_point(o->limit[k]) : DYD_IV_UNKNOWN;
  }
}

dyd_iv dyd_outline_coordinate(const dyd_outline *o, const dyd_outline_spot *p, int a) {
  if (p->side[a] >= 0) return o->window.end[2 * a + p->side[a]];
  return dyd_iv_add(p->at[a], dyd_iv_point(o->origin[a]));
}
