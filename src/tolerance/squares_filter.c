/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Deaths and births where points move in squares, by bisection with statuses [TOL-9].
 *
 * At any t, whether some sites leave the pair legal, or possible, is decided exactly. A pair that they refute is
 * refuted by all sites; one that they allow is allowed by all when no other site comes to the disc that shows it, and a
 * site that may come is one of `some` from then on. A square of half-width t holds the disc of radius t and lies in
 * that of radius sqrt(2) t, so the event of discs, which is known, brackets a death.
 *
 * Squares are rounded outward to multiples of 2^exp: they hold those of half-width t, and lie in those of t + 2^exp. So
 * "yes" at t holds below t, "no" above t + 2^exp. The floor of the search for witnesses is far below another 2^exp.
 *
 * Doubles decide which other sites may come to a disc; all uncertain ones are added. A square about a point in the box
 * b, of half-width h, is in b widened by h and SPARE of all sizes, and holds what b less all that leaves; distances to
 * these are bounded as in skeleton/rects_filter.h. */
#include "legal/witness.h"
#include "possible/cover.h"
#include "predicate/circle.h"
#include "rect/rect.h"
#include "skeleton/rects_filter.h"
#include "skeleton/work.h"
#include "tolerance/lines.h"
#include "tolerance/state.h"

#include <dyadel/predicate.h>
#include <math.h>
#include <stdlib.h>

/* A pair of squares of half-width t about nominal places, and the other sites considered for it [TOL-9]. */

/* Invariant: i and j are not among seen, and no vertex is twice. While it is built, site 0 of sites is the square of i,
 * 1 that of j, 2 + k that of seen[k], each rounded outward by less than 2^exp, and the skeleton and work are theirs. */
typedef struct squares {
  dyd_tolerance *t;
  uint32_t i, j; /* vertices of t */
  dyd_others seen;
  double now; /* the half-width */
  int64_t exp;
  mpq_t half; /* the same */
  dyd_sites *sites;
  dyd_skeleton sk;
  dyd_work work;
  dyd_xy guess;   /* about where a witness is likely */
  dyd_point c;    /* the witness found */
  dyd_bbox place; /* where a pair is seen to be legal, or possible; NaN: nowhere in the plane */
} squares;

/* Squares are rounded at 2^-SQUARE_BITS of their half-width. */
enum { SQUARE_BITS = 24 };

#define WIDTH (1 + 0x1p-20)

/* Nothing is tried beyond 2^+-RANGE. */
enum { RANGE = 900, FIRST_SEEN = 24 };

/* ---- squares at one t ---- */

/* The square of a vertex of t, exactly but for that rounding. */
static dyd_status square_of_vertex(dyd_rect *out, const squares *q, uint32_t v) {
  dyd_status st = dyd_sites_get(out, q->t->sk->reps.sites, q->t->sk->reps.site[v]);
  return st == DYD_OK ? dyd_rect_widen(out, q->half, q->exp) : st;
}

static void squares_unbuild(squares *q) {
  if (!q->sites) return;
  dyd_work_clear(&q->work);
  dyd_skeleton_clear(&q->sk);
  dyd_sites_free(q->sites);
  q->sites = NULL;
}

/* i, j and seen at half-width t. A failure leaves nothing built. */
static dyd_status squares_build(squares *q, double t) {
  const dyd_skeleton_options o = {.no_filter = q->t->options.no_filter, .threads = 1};
  DYD_OWNED(dyd_sites) *sites = NULL;
  DYD_LOCAL(dyd_rect, r);
  q->now = t;
  q->exp = ilogb(t) - SQUARE_BITS;
  mpq_set_d(q->half, t);
  dyd_status st = dyd_sites_new(&sites);
  for (size_t k = 0; k < q->seen.count + 2 && st == DYD_OK; k++) {
    st = square_of_vertex(&r, q, k == 0 ? q->i : k == 1 ? q->j : q->seen.vertex[k - 2]);
    if (st == DYD_OK) st = dyd_sites_add_rect(sites, &r);
  }
  if (st == DYD_OK) st = dyd_skeleton_build(&q->sk, sites, &o);
  if (st != DYD_OK) return st;
  q->sites = sites;
  sites = NULL;
  dyd_work_init(&q->work, &q->sk, NULL);
  return DYD_OK;
}

#define SPARE 0x1p-50

#define MORE (1 + 0x1p-20) /* half-widths are rounded outward by less */

enum { MOST_NEW = 6 };

/* Beyond this squared ratio of the distances from i to the centre and to j, doubles do not show which site is nearest.
 */
#define FAR2 0x1p60

/* Includes v from now on; *more: it was not seen before. */
static dyd_status squares_see(bool *more, squares *q, uint32_t v) {
  *more = v != q->i && v != q->j;
  for (size_t k = 0; k < q->seen.count && *more; k++) *more = q->seen.vertex[k] != v;
  return !*more || dyd_others_add(&q->seen, v) ? DYD_OK : DYD_E_NOMEM;
}

/* ---- searches ---- */

/* bound: of squared distances from c; far: every site met is added. */
typedef struct square_search {
  squares *q;
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

/* Near the circle integers decide. */
static bool keeps_out_exactly(square_search *s, uint32_t v) {
  bool out = true;
  DYD_LOCAL_ARRAY(dyd_rect, r, [3]);
  s->status = square_of_vertex(&r[0], s->q, v);
  for (int k = 1; k < 3 && s->status == DYD_OK && out; k++) {
    s->status = dyd_sites_get(&r[k], s->q->sites, (size_t)k - 1);
    out = s->status == DYD_OK && dyd_compare_distance(&s->q->c, &r[k], DYD_FARTHEST, &r[0], DYD_CLOSEST) < 0;
  }
  return out;
}

static bool meet_rival(void *context, uint32_t v) {
  square_search *s = context;
  bool more;
  if (v == s->q->i || v == s->q->j || surely_keeps_out(s, v)) return true;
  for (size_t k = 0; k < s->q->seen.count; k++)
    if (s->q->seen.vertex[k] == v) return true;
  if (s->legal && keeps_out_exactly(s, v)) return true;
  if (s->status == DYD_OK) s->status = squares_see(&more, s->q, v);
  return s->status == DYD_OK && ++s->added < MOST_NEW;
}

/* Includes sites whose squares do not certainly keep out of the witness disc about q->c: a few at most. *more: there
 * are some. */
static dyd_status squares_see_rivals(bool *more, squares *q) {
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

/* Adds a few sites that may be near enough to block the place where the pair is seen to be possible. */
static dyd_status squares_see_blockers(bool *more, squares *q, const dyd_cover *at) {
  const dyd_rects *r = &q->sk.rects;
  uint32_t v[2] = {q->sk.vertex[0], q->sk.vertex[1]};
  square_search s = {.q = q, .c = at->place, .far = at->far};
  if (s.far) {
    const double *u = at->u;
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

static dyd_xy nominal_place(const squares *q, uint32_t v) {
  return q->t->sk->reps.xy[v];
}

/* About where the circle that binds is for a row of exact points: where the bisectors of ij and kl cross, the middle of
 * the widest annulus. */
static dyd_xy squares_guess(const squares *q, uint32_t k, uint32_t l) {
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

/* Puts the two of seen first that are about nearest to q->place, one on each side of ij, by their nearest points, or
 * `far` ones; *k < *l become their vertices, DYD_NONE where there is none. Unchanged where doubles do not decide. */
static void squares_bind(uint32_t *k, uint32_t *l, squares *q, bool far) {
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

/* ---- statuses at one t ---- */

typedef dyd_status squares_question(dyd_truth *answer, squares *q, double t);

static dyd_status squares_are_legal(dyd_truth *answer, squares *q, double t) {
  dyd_status st = DYD_OK;
  for (bool more = true; more && st == DYD_OK;) {
    st = squares_build(q, t);
    if (st != DYD_OK) return st;
    const uint32_t *v = q->sk.vertex;
    uint32_t across[2] = {v[2], q->seen.count > 1 ? v[3] : v[2]};
    more = false;
    st = dyd_witness_decide(answer, &q->c, &q->work, &q->sk, v[0], v[1], q->guess, q->seen.count > 1 ? across : NULL);
    if (st == DYD_OK && *answer == DYD_TRUE) st = squares_see_rivals(&more, q);
    squares_unbuild(q);
  }
  if (st != DYD_OK || *answer != DYD_TRUE) return st;
  uint32_t k, l;
  squares_bind(&k, &l, q, false);
  return DYD_OK;
}

/* A common point is possible whatever other sites there are. */
static dyd_status squares_meet(bool *meet, squares *q) {
  DYD_LOCAL_ARRAY(dyd_rect, r, [2]);
  dyd_status st = dyd_sites_get(&r[0], q->sites, 0);
  if (st == DYD_OK) st = dyd_sites_get(&r[1], q->sites, 1);
  *meet = st == DYD_OK && dyd_rect_meets(&r[0], &r[1]);
  return st;
}

static dyd_status squares_are_illegal(dyd_truth *answer, squares *q, double t) {
  static const uint32_t no_hint[2] = {DYD_NONE, DYD_NONE};
  dyd_status st = DYD_OK;
  for (bool more = true; more && st == DYD_OK;) {
    bool meet;
    dyd_cover found = {.possible = true};
    st = squares_build(q, t);
    if (st != DYD_OK) return st;
    more = false;
    const uint32_t *v = q->sk.vertex;
    st = squares_meet(&meet, q);
    if (st == DYD_OK && !meet) st = dyd_cover_possible(&found, &q->work, &q->sk, v[0], v[1], no_hint);
    if (st == DYD_OK && !meet && found.possible) st = squares_see_blockers(&more, q, &found);
    *answer = found.possible ? DYD_FALSE : DYD_TRUE;
    squares_unbuild(q);
  }
  return st;
}

/* ---- where it changes ---- */

/* Yes at *lo, or *lo is 0; no at *hi. Until they are near to each other, or no answer is found. */
static dyd_status squares_halve(double *lo, double *hi, squares *q, squares_question *ask) {
  dyd_status st = DYD_OK;
  while (*hi > *lo * WIDTH && st == DYD_OK) {
    double mid = 4 * *lo >= *hi ? *lo + (*hi - *lo) / 2 : *hi / 4, over = mid + ldexp(mid, 2 - SQUARE_BITS);
    dyd_truth answer = DYD_UNKNOWN;
    if (!(mid > *lo && over < *hi && mid > ldexp(1, -RANGE) && mid < ldexp(1, RANGE))) return DYD_OK;
    st = ask(&answer, q, mid);
    if (answer == DYD_UNKNOWN) return st;
    *(answer == DYD_TRUE ? lo : hi) = answer == DYD_TRUE ? mid : over;
  }
  return st;
}

/* ---- rows ---- */

/* The sites of the row, and some around it. */
static dyd_status squares_begin(squares *q, const dyd_tolerance_row *row) {
  const dyd_tolerance *t = q->t;
  const uint32_t *vertex = t->sk->vertex;
  dyd_status st = DYD_OK;
  bool more;
  q->i = vertex[row->i];
  q->j = vertex[row->j];
  q->seen.count = 0;
  q->place = (dyd_bbox){{NAN, NAN, NAN, NAN}};
  if (row->k != DYD_NO_SITE) st = squares_see(&more, q, vertex[row->k]);
  if (row->l != DYD_NO_SITE && st == DYD_OK) st = squares_see(&more, q, vertex[row->l]);
  if (st == DYD_OK) st = dyd_others_around(&q->t->others, t, q->i, q->j, FIRST_SEEN);
  for (size_t k = 0; k < t->others.count && st == DYD_OK; k++) st = squares_see(&more, q, t->others.vertex[k]);
  uint32_t any = 0; /* two hubs: begin with any point */
  while (any == q->i || any == q->j || dyd_mesh_alias(&t->sk->mesh, any) != DYD_NONE) any++;
  return st == DYD_OK && !q->seen.count ? squares_see(&more, q, any) : st;
}

static void row_bind(dyd_tolerance_row *row, squares *q, bool far) {
  uint32_t k, l;
  squares_bind(&k, &l, q, far);
  if (k != DYD_NONE) *row = dyd_row_of(q->t, q->i, q->j, row->event, k, l, row->lo, row->hi);
}

/* The death for discs is at most sqrt(2) times that for squares. */
static dyd_status square_death(squares *q, dyd_tolerance_row *row) {
  if (row->lo == HUGE_VAL) return DYD_OK;
  dyd_status st = squares_begin(q, row);
  q->guess = squares_guess(q, row->k, row->l);
  row->lo *= 0.70710678118654746 * (1 - 0x1p-50);
  if (st == DYD_OK) st = squares_halve(&row->lo, &row->hi, q, squares_are_legal);
  if (st == DYD_OK) row_bind(row, q, false);
  return st;
}

/* *late: it is above t->options.up_to for certain. */
static dyd_status square_birth(bool *late, squares *q, dyd_tolerance_row *row) {
  dyd_truth illegal = DYD_UNKNOWN;
  double up_to = dyd_q_double(q->t->options.up_to, 1);
  dyd_status st = squares_begin(q, row);
  if (st == DYD_OK) st = squares_are_illegal(&illegal, q, up_to);
  *late = st == DYD_OK && illegal == DYD_TRUE;
  row->lo = 0;
  row->hi = up_to + ldexp(up_to, 2 - SQUARE_BITS);
  if (st == DYD_OK && !*late) st = squares_halve(&row->lo, &row->hi, q, squares_are_illegal);
  if (st == DYD_OK && !*late) row_bind(row, q, true);
  return st;
}

static dyd_status square_row(bool *late, dyd_tolerance_row *row, void *user) {
  return row->event == DYD_EVENT_DEATH ? square_death(user, row) : square_birth(late, user, row);
}

dyd_status dyd_square_rows(dyd_tolerance *t, size_t first) {
  squares q = {.t = t};
  mpq_init(q.half);
  dyd_point_init(&q.c);
  dyd_status st = dyd_near_index(t);
  if (st == DYD_OK) st = dyd_rows_rework(t, first, square_row, &q);
  dyd_point_clear(&q.c);
  mpq_clear(q.half);
  free(q.seen.vertex);
  return st;
}
