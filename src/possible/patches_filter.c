/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Patches of the plane, and the sites that are possibly nearest in them.
 *
 * [PLANE-1] C_ki = {c : dl_k(c) < ds_i(c)} is convex. So when the corners of a convex patch are in C_ki, i is nowhere
 * in the patch possibly nearest, and no pair of i has a centre there (ij is possible iff Pos_i and Pos_j meet). A patch
 * is a square, or a strip outside the root square between two rays; the far corners of a strip are the directions u of
 * its rays, and there C_ki means min u.x over R_k > max u.x over R_i, as for centres at infinity. The patches cover the
 * plane with its directions, since neighbours share lines or rays bit by bit. The site with the least dl at a point of
 * a patch is possibly nearest there and never leaves its list, so the list alone bounds M(c) from below: sites of the
 * list with ds(c) <= M(c) are possible neighbours of one another. Distances are bounded as in
 * skeleton/rects_filter.h [FLT-DST], heights as in skeleton/rects_filter.c [FLT-DIR]; NaN and infinities compare
 * false and prove nothing. */
#include "possible/patches_filter.h"

#include "base/alloc.h"
#include "predicate/predicate_filter.h"
#include "skeleton/rects_filter.h"
#include "skeleton/skeleton.h"

#include <math.h>
#include <stdbool.h>

/* How far rectangles are from a corner of a part of the plane, as a number to compare at that corner: the squared
 * distance [FLT-DST], or minus the height for a corner at infinity [FLT-DIR]. */

/* A point, or a direction. */
typedef struct dyd_plane_corner {
  double x, y;
  bool far;
} dyd_plane_corner;

static inline double dyd_height_error(double px, double py) {
  return 8 * 0x1p-53 * (fabs(px) + fabs(py)) + DYD_TINY;
}

/* Lower bound of -u.x over a box that reaches `slack` farther. */
static inline double dyd_depth_lower(double ux, double uy, double x, double y, double slack) {
  double px = ux * x, py = uy * y, s = (fabs(ux) + fabs(uy)) * slack;
  return -(px + py + s) - dyd_height_error(px, py) - 4 * 0x1p-53 * s;
}
static inline double dyd_depth_upper(double ux, double uy, double x, double y, double slack) {
  return -dyd_depth_lower(-ux, -uy, x, y, slack);
}

/* Upper bound of the farthest of a rectangle. */
static inline double dyd_farthest_upper(dyd_plane_corner v, const dyd_bbox *b) {
  dyd_bbox c = {{v.x, v.x, v.y, v.y}};
  if (!v.far) return dyd_dl2_upper(&c, b);
  return dyd_depth_upper(v.x, v.y, v.x > 0 ? b->e[0] : b->e[1], v.y > 0 ? b->e[2] : b->e[3], 0);
}
/* Lower bound of the closest. */
static inline double dyd_closest_lower(dyd_plane_corner v, const dyd_bbox *b) {
  dyd_bbox c = {{v.x, v.x, v.y, v.y}};
  if (!v.far) return dyd_ds2_lower(&c, b);
  return dyd_depth_lower(v.x, v.y, v.x > 0 ? b->e[1] : b->e[0], v.y > 0 ? b->e[3] : b->e[2], 0);
}
/* The bounds from the other side; slack: by how much the box may be wider than the rectangle. */
static inline double dyd_farthest_lower(dyd_plane_corner v, const dyd_bbox *b, double slack) {
  dyd_bbox c = {{v.x, v.x, v.y, v.y}};
  if (!v.far) return dyd_dl2_lower(&c, b, slack);
  return dyd_depth_lower(v.x, v.y, v.x > 0 ? b->e[0] : b->e[1], v.y > 0 ? b->e[2] : b->e[3], slack);
}
static inline double dyd_closest_upper(dyd_plane_corner v, const dyd_bbox *b, double slack) {
  dyd_bbox c = {{v.x, v.x, v.y, v.y}};
  if (!v.far) return dyd_ds2_upper(&c, b, slack);
  return dyd_depth_upper(v.x, v.y, v.x > 0 ? b->e[1] : b->e[0], v.y > 0 ? b->e[3] : b->e[2], slack);
}

/* If ds_i(c), ds_j(c) <= M(c), the least dl_k(c) of all k, then c is a centre of ij [POS-1]. Any c will do; the bounds
 * are those of skeleton/rects_filter.h [FLT-DST]. NaN proves nothing. */

/* least: a lower bound of the least dl^2 of those visited; bound: an upper one, of all. */
typedef struct nearest_bound {
  const dyd_rects *rects;
  dyd_bbox c;
  double least, bound;
} nearest_bound;

static bool lower_least(void *context, uint32_t k) {
  nearest_bound *m = context;
  const dyd_bbox *box = &m->rects->box[k];
  double value = dyd_dl2_lower(&m->c, box, dyd_box_slack(m->rects, k));
  m->least = isnan(value) ? -INFINITY : dyd_min(value, m->least);
  m->bound = dyd_min(dyd_dl2_upper(&m->c, box), m->bound);
  return true;
}

void dyd_filter_clique(bool *near, const dyd_rects *r, dyd_xy c, const uint32_t *vertex, size_t count) {
  nearest_bound m = {r, {{c.x, c.x, c.y, c.y}}, INFINITY, INFINITY};
  dyd_tree_near(&r->tree, &m.c, &m.bound, lower_least, &m);
  for (size_t k = 0; k < count; k++)
    near[k] = dyd_ds2_upper(&m.c, &r->box[vertex[k]], dyd_box_slack(r, vertex[k])) <= m.least;
}

/* ---- quads: the predicate layer's interval filters on outward boxes ---- */

bool dyd_surely_not_displaced(const dyd_skeleton *sk, uint32_t i, uint32_t j, uint32_t k, uint32_t l) {
  const dyd_bbox *box = sk->rects.box;
  if (sk->mesh.no_filter) return false;
  dyd_bbox ij = box[i], kl = box[k];
  dyd_box_widen(&ij, &box[j]);
  dyd_box_widen(&kl, &box[l]);
  if (dyd_boxes_disjoint(&ij, &kl)) return true;
  dyd_sure turn = dyd_filter_orientation(box[i].e, box[j].e, box[k].e);
  if (turn == DYD_UNSURE) return false;
  return (int)dyd_filter_incircle(box[i].e, box[j].e, box[k].e, box[l].e) == -(int)turn;
}

/* Lists up to SHORT are examined pair by pair, longer ones when cutting makes them no shorter, and pairs of lists up to
 * LONG are noted. DEEP: how often a patch is cut for the pairs noted in the last pass. COARSE: a patch is, while so
 * many times more may be nearest somewhere in it than at its centre; not those cut more than FINE times: ties. NARROW:
 * strips cut so often stay coarse, near as they are at one end. WALK: the cost of deciding one pair alone, in tests of
 * a rectangle; WORK: most of them for each site and each pair found. */
enum {
  SHORT = 48,
  LONG = 4096,
  DEEP = 2,
  COARSE = 4,
  FINE = 48,
  NARROW = 4,
  DOMINATORS = 5,
  MAX_DEPTH = 200,
  WALK = 60,
  WORK = 1000
};

/* A vertex in a patch. member: as such possibly nearest there, with open pairs; else DYD_NONE. rival: may have the
 * least dl. */
typedef struct patch_entry {
  uint32_t vertex, member;
  bool rival;
} patch_entry;

/* A pair that is still open, by places in the patch's list. */
typedef struct wish {
  uint16_t a, b;
} wish;

/* The plane and its patches: parts of a square, or of a strip between the rays e[0] and e[1]. The list of a patch is
 * entry[first .. first + count). level > 0: it is listed, and its open pairs are wish[first_pair .. + pairs); 0: they
 * are all pairs of the list. A listed patch was cut level - 1 times since it was listed and not coarse. */
typedef struct plane {
  const dyd_patches *c;
  dyd_bbox root;
  int side;                   /* < 0: squares are examined; else the strip at that side of the root */
  bool coarse;                /* the patch at hand */
  double cx, cy, radius;      /* of the root */
  dyd_plane_corner corner[4]; /* of the strip at hand; numbered as those of a box */
  patch_entry *entry;
  wish *wish;
  size_t entry_cap, wish_cap;
  uint16_t *place; /* by place in the parent's list of a listed patch: place in the patch's list */
  bool *rival, *wanted;
  double *value;
  bool *near; /* by place in the list: possibly nearest at the centre */
  double least;
  size_t work, found;
  bool last; /* of the passes */
  bool enough, lost;
} plane;

static dyd_plane_corner ray(const plane *p, double w, bool far) {
  int side = p->side;
  double one = side & 1 ? -1 : 1;
  if (far) return side < 2 ? (dyd_plane_corner){w, one, true} : (dyd_plane_corner){one, w, true};
  if (side < 2) return (dyd_plane_corner){p->cx + p->radius * w, p->root.e[side & 1 ? 2 : 3], false};
  return (dyd_plane_corner){p->root.e[side & 1 ? 0 : 1], p->cy + p->radius * w, false};
}

/* ---- the list of a patch ---- */

typedef struct dominator {
  uint32_t vertex;
  double at[4]; /* farthest_upper at the corners */
} dominator;

/* farthest_upper at the corners. */
static void measure(dominator *d, const plane *p, const dyd_plane_part *q) {
  const dyd_bbox *b = &p->c->rects->box[d->vertex];
  if (p->side < 0) {
    dyd_corners_far(d->at, &q->at, b);
    return;
  }
  for (int k = 0; k < 4; k++) d->at[k] = dyd_farthest_upper(p->corner[k], b);
}

/* closest_lower at the corners. */
static void measure_closest(double at[4], const plane *p, uint32_t vertex, const dyd_plane_part *q) {
  const dyd_bbox *b = &p->c->rects->box[vertex];
  if (p->side < 0) {
    dyd_corners_near(at, &q->at, b);
    return;
  }
  for (int k = 0; k < 4; k++) at[k] = dyd_closest_lower(p->corner[k], b);
}

/* Finds the nearest vertices at the worst corner and at each corner. Returns their number. */
static int choose_dominators(dominator best[DOMINATORS], const plane *p, const dyd_plane_part *q) {
  double least[DOMINATORS] = {INFINITY, INFINITY, INFINITY, INFINITY, INFINITY};
  dominator all[DOMINATORS] = {{DYD_NONE, {0}}, {DYD_NONE, {0}}, {DYD_NONE, {0}}, {DYD_NONE, {0}}, {DYD_NONE, {0}}};
  for (size_t e = 0; e < q->count; e++) {
    if (!p->rival[e]) continue;
    dominator d = {.vertex = p->entry[q->first + e].vertex};
    measure(&d, p, q);
    double worst = dyd_max(dyd_max(d.at[0], d.at[1]), dyd_max(d.at[2], d.at[3]));
    for (int k = 0; k < DOMINATORS; k++) {
      double value = k == 0 ? worst : d.at[k - 1];
      if (!(value < least[k])) continue;
      least[k] = value;
      all[k] = d;
    }
  }
  int count = 0;
  for (int k = 0; k < DOMINATORS; k++) {
    bool fresh = all[k].vertex != DYD_NONE;
    for (int m = 0; m < count && fresh; m++) fresh = best[m].vertex != all[k].vertex;
    if (fresh) best[count++] = all[k];
  }
  return count;
}

static bool is_dominated(const plane *p, uint32_t vertex, const dyd_plane_part *q, const dominator *best, int count) {
  double at[4];
  measure_closest(at, p, vertex, q);
  for (int m = 0; m < count; m++)
    if (dyd_corners_block(best[m].at, at) && best[m].vertex != vertex) return true;
  return false;
}

static dyd_plane_corner centre_of(const plane *p, const dyd_plane_part *q) {
  const double *e = q->at.e, x = e[0] / 2 + e[1] / 2, y = e[2] / 2 + e[3] / 2;
  return p->side < 0 ? (dyd_plane_corner){x, y, false} : ray(p, x, true);
}

/* An upper bound of dl at the centre for the vertex with the least dl anywhere in a square: dl changes by at most the
 * way, so it is at most the least one at the centre, and twice the way to the farthest corner. Infinite for strips. */
static double rival_limit(const plane *p, const dyd_plane_part *q, const dyd_plane_corner *centre, double least2) {
  if (p->side >= 0) return INFINITY;
  const double *e = q->at.e;
  double dx = dyd_max(e[1] - centre->x, centre->x - e[0]), dy = dyd_max(e[3] - centre->y, centre->y - e[2]);
  double limit = sqrt(least2) + 2 * sqrt(dyd_upper(dx * dx + dy * dy));
  limit = dyd_upper(limit * limit);
  return isnan(limit) ? INFINITY : limit;
}

/* rival[k]: whether the k-th of the parent's list may have the least dl somewhere in q. p->least: M at the centre from
 * below. */
static void find_rivals(plane *p, const dyd_plane_part *q) {
  const patch_entry *e = p->entry + q->first;
  const dyd_bbox *box = p->c->rects->box;
  dyd_plane_corner centre = centre_of(p, q);
  double upper = INFINITY;
  bool good = true;
  p->least = INFINITY;
  for (size_t k = 0; k < q->count; k++) {
    if (!e[k].rival) continue;
    p->value[k] = dyd_farthest_lower(centre, &box[e[k].vertex], dyd_box_slack(p->c->rects, e[k].vertex));
    good = good && !isnan(p->value[k]);
    p->least = dyd_min(p->value[k], p->least);
    upper = dyd_min(dyd_farthest_upper(centre, &box[e[k].vertex]), upper);
  }
  if (!good) p->least = -INFINITY;
  double limit = rival_limit(p, q, &centre, upper);
  for (size_t k = 0; k < q->count; k++) p->rival[k] = e[k].rival && !(p->value[k] > limit);
}

/* wanted[k]: whether the k-th of the parent's list is a member with open pairs. */
static void find_wanted(plane *p, const dyd_plane_part *q) {
  for (size_t k = 0; k < q->count; k++) p->wanted[k] = q->level == 0 && p->entry[q->first + k].member != DYD_NONE;
  for (size_t k = 0; k < q->pairs && q->level > 0; k++) {
    p->wanted[p->wish[q->first_pair + k].a] = true;
    p->wanted[p->wish[q->first_pair + k].b] = true;
  }
}

/* Writes the rivals of the parent's list, and its members with open pairs that are not dominated, behind all lists, and
 * makes that q's list. place[]: the new places of the latter. Returns how many they are. */
static size_t make_list(plane *p, dyd_plane_part *q) {
  dominator best[DOMINATORS];
  for (int k = 0; k < 4 && p->side >= 0; k++) p->corner[k] = ray(p, q->at.e[k & 1], k & 2);
  find_rivals(p, q);
  find_wanted(p, q);
  int dominators = choose_dominators(best, p, q);
  size_t members = 0, first = q->first + q->count, end = first;
  for (size_t k = 0; k < q->count; k++) {
    patch_entry e = p->entry[q->first + k];
    bool out = (!p->wanted[k] && !p->rival[k]) || is_dominated(p, e.vertex, q, best, dominators);
    bool in = !out && p->wanted[k];
    if (q->level > 0) p->place[k] = in ? (uint16_t)(end - first) : UINT16_MAX;
    if (out) continue;
    p->entry[end++] = (patch_entry){e.vertex, in ? e.member : DYD_NONE, p->rival[k]};
    members += in;
  }
  q->first = first;
  q->count = end - first;
  return members;
}

/* ---- pairs shown to be possible ---- */

static bool is_open(const plane *p, const patch_entry *a, const patch_entry *b) {
  return dyd_pair_map_get(p->c->map, a->member, b->member) == DYD_PAIR_UNKNOWN;
}

/* near[k]: the k-th of the list is proved possibly nearest at the centre of the patch. All of them are possible
 * neighbours of one another. Much longer lists mean that the patch is coarse for its open pairs, be that by far
 * outliers, by distance or by density. */
static void patches_try_centre(plane *p, dyd_plane_part *q) {
  const dyd_rects *r = p->c->rects;
  const patch_entry *e = p->entry + q->first;
  dyd_plane_corner v = centre_of(p, q);
  size_t near = 0;
  for (size_t k = 0; k < q->count; k++) {
    p->near[k] = dyd_closest_upper(v, &r->box[e[k].vertex], dyd_box_slack(r, e[k].vertex)) <= p->least;
    near += p->near[k];
  }
  p->coarse = q->depth < FINE && q->count > COARSE * (near ? near : 1);
}

/* Reports the pair of the list if it is open and shown, else keeps it if it is open and the patch is listed. */
static dyd_status consider(plane *p, dyd_plane_part *q, size_t a, size_t b) {
  const patch_entry *i = &p->entry[q->first + a], *j = &p->entry[q->first + b];
  if (i->member == DYD_NONE || j->member == DYD_NONE || !is_open(p, i, j)) return DYD_OK;
  if (p->near[a] && p->near[b]) {
    p->found++;
    return p->c->found(p->c->context, &p->enough, i->member, j->member);
  }
  if (q->level == 0) return DYD_OK;
  if (!DYD_GROW(p->wish, p->wish_cap, q->first_pair + q->pairs + 1)) return DYD_E_NOMEM;
  p->wish[q->first_pair + q->pairs++] = (wish){(uint16_t)a, (uint16_t)b};
  return DYD_OK;
}

/* The parent's open pairs. */
static dyd_status consider_wishes(plane *p, dyd_plane_part *q) {
  size_t from = q->first_pair, count = q->pairs;
  dyd_status st = DYD_OK;
  q->first_pair = from + count;
  q->pairs = 0;
  q->level++;
  for (size_t k = 0; k < count && st == DYD_OK && !p->enough; k++) {
    uint16_t a = p->place[p->wish[from + k].a], b = p->place[p->wish[from + k].b];
    if (a != UINT16_MAX && b != UINT16_MAX) st = consider(p, q, a, b);
  }
  return st;
}

/* All pairs of the list; if it is not too long, the pairs that stay open are noted. */
static dyd_status consider_all(plane *p, dyd_plane_part *q) {
  dyd_status st = DYD_OK;
  q->level = q->count <= LONG ? 1 : 0;
  for (size_t a = 0; a < q->count; a++)
    for (size_t b = a + 1; b < q->count && st == DYD_OK && !p->enough; b++) st = consider(p, q, a, b);
  return st;
}

/* Returns true if the search does too much work for the pairs it finds. */
static bool is_lost(plane *p) {
  p->lost = p->lost || p->work > WORK * ((size_t)p->c->rects->tree.count + p->found);
  return p->lost;
}

/* Cutting shows no more: in the last pass, each pair that is still open is decided alone. */
static dyd_status leave(plane *p, const dyd_plane_part *q) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < q->pairs && p->last && st == DYD_OK && !p->enough && !is_lost(p); k++) {
    wish w = p->wish[q->first_pair + k];
    const patch_entry *i = &p->entry[q->first + w.a], *j = &p->entry[q->first + w.b];
    if (!is_open(p, i, j)) continue;
    st = p->c->decide(p->c->context, &p->enough, i->member, j->member);
    if (dyd_pair_is_possible(dyd_pair_map_get(p->c->map, i->member, j->member)))
      p->found++;
    else
      p->work += WALK;
  }
  return st;
}

/* Examines the pairs of q, which was one of `before` sites with `open` pairs, and cuts it where that is of use. */
static dyd_status go_on(int *parts, plane *p, dyd_plane_part *q, size_t before, size_t open) {
  patches_try_centre(p, q);
  bool square = p->side < 0, may_shrink = p->coarse && (square || q->depth < NARROW);
  bool stuck = q->count <= SHORT || (q->count > before / 4 * 3 && !may_shrink);
  dyd_status st = DYD_OK;
  if (q->level > 0)
    st = consider_wishes(p, q);
  else if (stuck)
    st = consider_all(p, q);
  if (st != DYD_OK || p->enough || (q->level > 0 && q->pairs == 0)) return st;
  if (square && p->coarse && q->pairs > q->count) q->level = 1;
  if (q->level > (p->last ? DEEP : 0) && q->pairs > open / 4 * 3) return leave(p, q);
  *parts = square ? 4 : 2;
  return DYD_OK;
}

static dyd_status look(void *context, int *parts, dyd_plane_part *q) {
  plane *p = context;
  size_t before = q->count, open = q->pairs;
  p->work += before;
  p->lost = p->lost || q->depth > MAX_DEPTH;
  if (p->enough || is_lost(p)) return DYD_OK;
  if (!DYD_GROW(p->entry, p->entry_cap, q->first + 2 * before)) return DYD_E_NOMEM;
  return make_list(p, q) < 2 ? DYD_OK : go_on(parts, p, q, before, open);
}

/* ---- the whole plane ---- */

static uint32_t patches_member(const dyd_patches *c, uint32_t v) {
  const uint32_t *at = bsearch(&v, c->vertex, c->vertices, sizeof v, dyd_compare_index);
  return at ? (uint32_t)(at - c->vertex) : DYD_NONE;
}

/* The root square: the middle of all boxes, eight times their extent. */
static void set_root(plane *p) {
  const dyd_tree *t = &p->c->rects->tree;
  const double *e = t->node[t->level[t->levels - 1]].e;
  p->cx = e[0] + (e[1] - e[0]) / 2;
  p->cy = e[2] + (e[3] - e[2]) / 2;
  p->radius = 8 * dyd_max(e[1] - e[0], e[3] - e[2]);
  p->root = (dyd_bbox){{p->cx - p->radius, p->cx + p->radius, p->cy - p->radius, p->cy + p->radius}};
}

static dyd_status everybody(plane *p) {
  const dyd_tree *t = &p->c->rects->tree;
  if (!DYD_NEW(p->place, LONG) || !DYD_NEW(p->near, t->count) || !DYD_NEW(p->rival, t->count) ||
      !DYD_NEW(p->wanted, t->count) || !DYD_NEW(p->value, t->count) || !DYD_GROW(p->entry, p->entry_cap, t->count))
    return DYD_E_NOMEM;
  for (uint32_t q = 0; q < t->count; q++)
    p->entry[q] = (patch_entry){t->item[q], patches_member(p->c, t->item[q]), true};
  return DYD_OK;
}

/* Examines everything. The first pass finds most pairs that are possible at centres, wherever these are met; the last
 * one decides all. */
static dyd_status pass(plane *p) {
  dyd_status st = DYD_OK;
  for (p->side = -1; p->side < 4 && st == DYD_OK; p->side++) {
    dyd_plane_part all = {.at = {{-1, 1}}, .count = p->c->rects->tree.count};
    if (p->side < 0) all.at = p->root;
    st = dyd_walk_parts(look, p, p->c->cancel, all);
  }
  return st;
}

dyd_status dyd_patches_run(bool *complete, const dyd_patches *c) {
  plane p = {.c = c};
  set_root(&p);
  const double *e = p.root.e;
  bool finite = isfinite(e[0]) && isfinite(e[1]) && isfinite(e[2]) && isfinite(e[3]);
  dyd_status st = finite ? everybody(&p) : DYD_OK;
  if (finite && st == DYD_OK) st = pass(&p);
  p.last = true;
  if (finite && st == DYD_OK) st = pass(&p);
  *complete = finite && st == DYD_OK && !p.enough && !p.lost;
  dyd_free_all(p.entry, p.wish, p.value, p.wanted, p.rival, p.near, p.place);
  return st;
}
