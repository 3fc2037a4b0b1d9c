/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Statuses of discs [DISC-1]: what squares leave indeterminate is decided for the discs in them.
 *
 * The discs that matter for a pair are found by searching the squares about one circle after another. Illegal is proved
 * by caps of finitely many sites, exactly; of those in a circle's way the one is taken whose cap reaches highest in its
 * direction, so that few are needed. Legal is proved by a witness: a centre of doubles, checked against every disc
 * whose square comes as near as the farther of both discs. |c - p| and the sums with radii are within ROOM = 2^-48 of
 * all sizes met (a few roundings each); closer distances are compared in rationals, with a centre as precise as it
 * takes, up to MOST_BITS of its size. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/index.h"
#include "base/invariant.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "delaunay/undecided.h"
#include "dyadic/raw.h"
#include "rect/rect.h"
#include "rect/sites_table.h"
#include "tolerance/discs.h"
#include "tolerance/lines.h"
#include <dyadel/tolerance.h>

#include <math.h>

#define ROOM 0x1p-48
#define FARTHEST 0x1p500
#define INSIDE 0x1p-46
#define ROOT_HALF 0x1.6a09e667f3bccp-1 /* below it */
enum {
  FIRST_SEEN = 10,
  MOST_SMALLER = 10,
  MOST_ROUNDS = 400,
  LEAST_BITS = 128,
  MOST_BITS = 8192,
  MOST_EXPONENT = 240,
  FARTHEST_EXPONENT = 1 << 20
};

/* ---- discs ---- */

/* The disc in a square, wider by 2^-60 of itself for what the ends of a rectangle that was given exactly were rounded
 * by, or else by 2^-50 of the coordinates, but no wider than the disc around the square, which needs 27/64 of itself
 * more. Of a bare site, a disc that holds the rectangle [DISC-5]. false: the rectangle should be a square, and is not.
 */
static bool disc_of_square(dyd_disc *d, const dyd_rect *r, dyd_site_kind kind) {
  DYD_LOCAL_NUMBERS(mpq, lo, h, room);
  dyd_side_sum(d->x, h, &r->x);
  dyd_side_sum(d->y, d->r, &r->y);
  mpq_abs(lo, d->x);
  mpq_abs(room, d->y);
  mpq_add(room, room, lo);
  mpq_add(room, room, h);
  mpq_add(room, room, d->r);
  mpq_div_2exp(room, room, 50);
  mpq_sub(lo, h, d->r);
  mpq_abs(lo, lo);
  bool bare = kind == DYD_SITE_BARE, square = bare || kind == DYD_SITE_ROUND || mpq_cmp(lo, room) <= 0;
  if (bare)
    mpq_add(d->r, d->r, h);
  else if (mpq_cmp(h, d->r) > 0)
    mpq_set(d->r, h);
  mpq_set_ui(h, 27, 64);
  mpq_mul(h, h, d->r);
  if (mpq_cmp(room, h) > 0) mpq_set(room, h);
  if (kind == DYD_SITE_GIVEN) mpq_div_2exp(room, d->r, 60);
  if (mpq_sgn(d->r) && !bare) mpq_add(d->r, d->r, room);
  mpq_div_2exp(d->x, d->x, 1);
  mpq_div_2exp(d->y, d->y, 1);
  mpq_div_2exp(d->r, d->r, 1);
  return square;
}

dyd_status dyd_disc_of_site(dyd_disc *d, const dyd_sites *s, size_t i) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sites_get(&r, s, i);
  if (st == DYD_OK && !disc_of_square(d, &r, dyd_sites_kind(s, i))) st = DYD_E_ARG;
  return st;
}

static void scale_disc(dyd_disc *d, int by) {
  mpq_ptr all[3] = {d->x, d->y, d->r};
  for (int k = 0; k < 3; k++) (by < 0 ? mpq_div_2exp : mpq_mul_2exp)(all[k], all[k], (mp_bitcnt_t)abs(by));
}

dyd_status dyd_discs_make(dyd_disc_work *w, dyd_error *err) {
  const dyd_skeleton *sk = &w->pd->sk;
  dyd_status st = DYD_OK;
  w->about = dyd_alloc(sk->n, sizeof *w->about);
  w->disc = w->about ? dyd_alloc(sk->n, sizeof *w->disc) : NULL;
  if (!w->disc) return dyd_fail_nomem(err);
  for (uint32_t v = 0; v < sk->n; v++) dyd_disc_init(&w->disc[v]);
  for (uint32_t v = 0; v < sk->n && st == DYD_OK; v++) {
    uint32_t site = sk->reps.site[v];
    st = dyd_disc_of_site(&w->disc[v], w->sites, site);
    if (w->scale) scale_disc(&w->disc[v], w->scale);
    w->about[v][0] = mpq_get_d(w->disc[v].x);
    w->about[v][1] = mpq_get_d(w->disc[v].y);
    w->about[v][2] = mpq_get_d(w->disc[v].r);
    if (st != DYD_E_ARG) continue;
    if (err) err->point = site;
    st = dyd_fail(err, DYD_E_ARG, "a disc needs one radius, the same in x and y");
  }
  return st;
}

void dyd_discs_clear(dyd_disc_work *w) {
  dyd_caps_clear(&w->caps);
  for (uint32_t v = 0; w->disc && v < w->pd->sk.n; v++) dyd_disc_clear(&w->disc[v]);
  dyd_free_all(w->disc, w->about, w->seen);
  dyd_delaunay_free(w->scaled);
}

/* ---- the discs considered ---- */

static bool is_seen(const dyd_disc_work *w, uint32_t v) {
  size_t k = 0;
  while (k < w->count && w->seen[k] != v) k++;
  return k < w->count || v == w->i || v == w->j;
}

bool dyd_discs_see(dyd_disc_work *w, uint32_t v) {
  if (is_seen(w, v)) return false;
  if (!DYD_GROW(w->seen, w->cap, w->count + 1)) w->failed = true;
  if (!w->failed) w->seen[w->count++] = v;
  return !w->failed;
}

static void see_neighbour(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  (void)v, (void)status;
  dyd_disc_work *d = context;
  if (d->count < FIRST_SEEN) dyd_discs_see(d, w);
}

double dyd_filter_radius(const dyd_disc_work *w, uint32_t v) {
  return w->weight ? w->weight[v] * w->now : w->about[v][2];
}

static double size_d(const dyd_disc_work *w, uint32_t v) {
  return fabs(w->about[v][0]) + fabs(w->about[v][1]) + dyd_filter_radius(w, v);
}

double dyd_filter_distance(const dyd_circle_d *c, uint32_t v) {
  return hypot(c->w->about[v][0] - c->x, c->w->about[v][1] - c->y);
}

/* How much all is off by, with v. */
static double room_d(const dyd_circle_d *c, uint32_t v) {
  return ROOM * (size_d(c->w, v) + (c->line ? fabs(c->height) : fabs(c->x) + fabs(c->y) + c->radius)) + c->clear;
}

bool dyd_filter_keeps_clear(const dyd_circle_d *c, uint32_t v) {
  double r = dyd_filter_radius(c->w, v), room = room_d(c, v);
  if (c->line) return c->x * c->w->about[v][0] + c->y * c->w->about[v][1] + (c->legal ? r : -r) < c->height - room;
  return dyd_filter_distance(c, v) + (c->legal ? -r : r) > c->radius + room;
}

/* The circle of direction u, about; reach: squares that come so near are visited. worst: of those in the way that are
 * not seen yet, the highest found so far (height_d), or DYD_NONE. */
typedef struct circle_trial {
  dyd_circle_d at;
  dyd_direction u;
  double reach, highest;
  bool good;
  uint32_t worst;
} circle_trial;

/* h of the circle of direction u that v just keeps from: discs.h. A disc that meets i rules all circles out, or none.
 */
static double height_d(const circle_trial *c, uint32_t v) {
  const double *i = c->at.w->about[c->at.w->i], *k = c->at.w->about[v];
  double x = k[0] - i[0], y = k[1] - i[1], r = k[2] + i[2], n = x * x + y * y - r * r, along = c->u.x * x + c->u.y * y;
  if (!(n > 0)) return c->at.legal ? HUGE_VAL : -HUGE_VAL;
  return (c->at.legal ? along + r : along - r) / n;
}

/* The visitor of trees: continues unless v is higher than the circle, and than the worst so far. */
static bool keep_worst(void *context, uint32_t v) {
  circle_trial *c = context;
  double height = is_seen(c->at.w, v) ? -HUGE_VAL : height_d(c, v);
  if (!(height > c->highest)) return true;
  c->worst = v;
  c->highest = height;
  return false;
}

/* legal: v must be outside for certain; possible: v blocks when its disc is inside, about. */
static bool meet_square(void *context, uint32_t v) {
  circle_trial *c = context;
  if (v == c->at.w->i || v == c->at.w->j || dyd_filter_keeps_clear(&c->at, v)) return true;
  c->good = false;
  return c->highest < HUGE_VAL && keep_worst(c, v);
}

/* ---- where doubles do not decide ---- */

/* A circle in rationals. about: the same in doubles; clear: no disc is in its way; one: the first one in its way ends
 * the search. */
typedef struct circle_q {
  dyd_disc_work *w;
  dyd_circle_d about;
  dyd_disc disc;
  bool one, clear;
} circle_q;

/* v is in the way unless its disc is outside. */
static bool meet_square_exactly(void *context, uint32_t v) {
  circle_q *c = context;
  const dyd_disc *k = &c->w->disc[v];
  if (v == c->w->i || v == c->w->j) return true;
  if (dyd_filter_keeps_clear(&c->about, v) || !dyd_discs_meet(k, &c->disc)) return true;
  c->clear = false;
  if (!c->one) dyd_discs_see(c->w, v);
  return !c->one && !c->w->failed;
}

/* Visits the squares that come as near as the circle, if doubles hold it. */
static void visit_exactly(circle_q *c) {
  const dyd_disc *d = &c->disc;
  double x = mpq_get_d(d->x), y = mpq_get_d(d->y), r = mpq_get_d(d->r), reach = r + ROOM * (fabs(x) + fabs(y) + r);
  const dyd_bbox at = {{x, x, y, y}};
  double radius2 = reach * reach * (1 + ROOM);
  if (!(reach < FARTHEST)) return;
  c->about = (dyd_circle_d){.w = c->w, .legal = true, .x = x, .y = y, .radius = r};
  c->clear = true;
  dyd_tree_near(&c->w->pd->sk.rects.tree, &at, &radius2, meet_square_exactly, c);
}

/* Returns true if the circle of the direction found is a witness. Sees the discs in its way. If all of these were seen,
 * their caps hold the direction, so the circle was not precise enough. */
static bool circle_is_witness(dyd_disc_work *w) {
  circle_q c = {.w = w};
  size_t had = w->count;
  dyd_disc_init(&c.disc);
  for (unsigned bits = LEAST_BITS; bits <= MOST_BITS && w->count == had && !w->failed && !c.clear; bits *= 4)
    if (dyd_caps_circle(&c.disc, &w->caps, bits)) visit_exactly(&c);
  dyd_disc_clear(&c.disc);
  return c.clear;
}

/* The circle of direction u: legal, the discs i and j just inside; possible, just meeting it. */
static bool place_circle_of(circle_trial *c, dyd_disc_work *w, dyd_direction u, bool legal) {
  const double *i = w->about[w->i], *j = w->about[w->j];
  double jx = j[0] - i[0], jy = j[1] - i[1], delta = j[2] - i[2], n = jx * jx + jy * jy - delta * delta;
  double h = (u.x * jx + u.y * jy + (legal ? -delta : delta)) / n;
  *c = (circle_trial){.u = u, .worst = DYD_NONE, .highest = h > 0 ? h * (1 - ROOM) : 0};
  c->at = (dyd_circle_d){.w = w, .x = i[0] + u.x / (2 * h), .y = i[1] + u.y / (2 * h), .legal = legal};
  double a = dyd_filter_distance(&c->at, w->i), ri = i[2], b = dyd_filter_distance(&c->at, w->j), rj = j[2];
  c->at.radius = legal ? fmax(a + ri, b + rj) : fmax(a - ri, b - rj);
  double room = room_d(&c->at, w->i) + room_d(&c->at, w->j);
  c->at.radius += legal ? room : 0;
  c->reach = c->at.radius + 2 * room;
  c->good = h > 0 && c->reach < FARTHEST;
  return c->good;
}

static void visit_circle(circle_trial *c) {
  const dyd_bbox at = {{c->at.x, c->at.x, c->at.y, c->at.y}};
  double radius2 = c->reach * c->reach * (1 + ROOM);
  if (c->reach > 0) dyd_tree_near(&c->at.w->pd->sk.rects.tree, &at, &radius2, meet_square, c);
}

/* The circle of the same direction and height h, through i. */
static void set_height(circle_trial *c, double h) {
  const double *i = c->at.w->about[c->at.w->i];
  double distance = 1 / (2 * h), r = i[2];
  c->at.x = i[0] + c->u.x * distance;
  c->at.y = i[1] + c->u.y * distance;
  c->at.radius = c->reach = distance + (c->at.legal ? r : -r);
}

/* A still higher disc is in the smaller circle that the worst allows. */
static bool see_worst(circle_trial *c) {
  uint32_t last = DYD_NONE;
  while (c->worst != last && c->highest > 0 && isfinite(c->highest)) {
    last = c->worst;
    set_height(c, c->highest);
    visit_circle(c);
  }
  return c->worst != DYD_NONE && dyd_discs_see(c->at.w, c->worst);
}

/* Where the circle is much larger than the pair, or a half-plane, many discs are in its way, the highest in smaller
 * circles, which it holds. Returns true if one is there. */
static bool look_nearby(const circle_trial *c) {
  circle_trial small = *c;
  const double *i = c->at.w->about[c->at.w->i], *j = c->at.w->about[c->at.w->j];
  double h = 1 / (4 * hypot(j[0] - i[0], j[1] - i[1]));
  for (int k = 0; k < MOST_SMALLER && h > 4 * c->highest && small.worst == DYD_NONE; k++, h /= 4) {
    small.highest = h;
    set_height(&small, h);
    visit_circle(&small);
  }
  return see_worst(&small);
}

/* Far circles: all discs beyond the tangent of i, about. */
static void look_beyond(circle_trial *c) {
  const double *i = c->at.w->about[c->at.w->i];
  double height = c->u.x * i[0] + c->u.y * i[1];
  dyd_tree_beyond(&c->at.w->pd->sk.rects.tree, c->u.x, c->u.y, &height, keep_worst, c);
}

/* ---- one pair ---- */

/* Are the centres as near as the sum (sign = 1) or the difference of the radii? */
static bool vertices_near(const dyd_disc_work *w, uint32_t v, uint32_t k, int sign) {
  const double *a = w->about[v], *b = w->about[k];
  double gap = hypot(b[0] - a[0], b[1] - a[1]) - fabs(dyd_filter_radius(w, v) + sign * dyd_filter_radius(w, k));
  if (fabs(gap) > ROOM * (size_d(w, v) + size_d(w, k))) return gap < 0;
  return (sign < 0 ? dyd_disc_is_within : dyd_discs_meet)(&w->disc[v], &w->disc[k]);
}

/* The caps of those seen that have none yet. */
static bool load_more(dyd_disc_work *w, bool legal) {
  for (; w->loaded < w->count && !w->failed; w->loaded++) {
    uint32_t v = w->seen[w->loaded];
    bool meets = vertices_near(w, w->i, v, 1) || vertices_near(w, w->j, v, 1);
    if (meets && legal) return false;
    if (!meets && !dyd_caps_add(&w->caps, &w->disc[v], v)) w->failed = true;
  }
  return !w->failed;
}

bool dyd_discs_load(dyd_disc_work *w, bool legal) {
  w->loaded = 0;
  if (!dyd_caps_begin(&w->caps, &w->disc[w->i], &w->disc[w->j], legal)) w->failed = true;
  return load_more(w, legal);
}

static bool discs_are_legal(dyd_disc_work *w) {
  for (int round = 0; round < MOST_ROUNDS; round++) {
    circle_trial c;
    dyd_direction u;
    DYD_INVARIANT(2 * round < MOST_ROUNDS); /* the worst first: a few are enough */
    if (!(round ? load_more : dyd_discs_load)(w, true) || !dyd_caps_common(&u, &w->caps)) return false;
    bool placed = place_circle_of(&c, w, u, true);
    size_t had = w->count;
    if (placed) visit_circle(&c);
    if (c.good || (!(placed && see_worst(&c)) && circle_is_witness(w))) return true;
    if (w->count == had) return false;
  }
  return false;
}

/* The small disc is in the large one, which is the best circle then. */
static bool large_is_legal(dyd_disc_work *w) {
  circle_q c = {.w = w, .one = true};
  const dyd_disc *j = &w->disc[w->j];
  dyd_disc_init(&c.disc);
  mpq_set(c.disc.x, j->x);
  mpq_set(c.disc.y, j->y);
  mpq_set(c.disc.r, j->r);
  visit_exactly(&c);
  dyd_disc_clear(&c.disc);
  return c.clear;
}

static bool discs_are_possible(dyd_disc_work *w) {
  for (int round = 0; round < MOST_ROUNDS; round++) {
    circle_trial c;
    dyd_direction u;
    DYD_INVARIANT(2 * round < MOST_ROUNDS); /* the worst first: a few are enough */
    if (!(round ? load_more : dyd_discs_load)(w, false)) return true;
    if (!dyd_caps_uncovered(&u, &w->caps)) return false;
    bool placed = place_circle_of(&c, w, u, false);
    if (look_nearby(&c)) continue;
    (placed ? visit_circle : look_beyond)(&c);
    if (!see_worst(&c)) return true;
  }
  return true;
}

/* ---- squares in discs ---- */

/* A square in the disc of v: half-width r / sqrt(2) less INSIDE of all sizes. The disc is known within 2^-49 of these,
 * x and its ends in doubles within 2^-50. DYD_E_DOMAIN: there is none. */
static dyd_status inner_square(dyd_rect *out, const void *discs, size_t v) {
  const dyd_disc_work *w = discs;
  const double *d = w->about[v];
  double half = mpq_sgn(w->disc[v].r) ? (d[2] - INSIDE * size_d(w, (uint32_t)v)) * ROOT_HALF : 0;
  DYD_LOCAL_NUMBERS(mpq, x);
  bool inside = half > 0;
  if (!inside && half == 0 && isfinite(d[0]) && isfinite(d[1])) { /* points, where doubles hold them */
    mpq_set_d(x, d[0]);
    inside = mpq_equal(x, w->disc[v].x);
    mpq_set_d(x, d[1]);
    inside = inside && mpq_equal(x, w->disc[v].y);
  }
  return inside ? dyd_rect_set_d(out, d[0] - half, d[0] + half, d[1] - half, d[1] + half) : DYD_E_DOMAIN;
}

/* Triangulates squares in the discs, numbered as vertices are [DISC-2]. *out = NULL: some disc has none that is worth
 * it, or there are too many pairs. */
static dyd_status triangulate_inside(dyd_delaunay **out, const dyd_disc_work *w) {
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = w->cancel};
  dyd_status st = dyd_delaunay_made(out, w->pd->sk.n, inner_square, w, &o, NULL);
  if (st != DYD_CAPPED && st != DYD_E_DOMAIN) return st;
  dyd_delaunay_free(*out);
  *out = NULL;
  return DYD_OK;
}

/* ---- all pairs ---- */

/* inside: the statuses of squares in the discs. A pair legal for the discs is legal for these, a pair possible for
 * these is possible for the discs. */
static dyd_pair_status discs_status(dyd_disc_work *w, uint32_t i, uint32_t j, const dyd_delaunay *inside) {
  dyd_pair_status known = inside ? dyd_delaunay_status(inside, i, j) : DYD_TIE;
  if (known == DYD_INDETERMINATE) return known;
  double more = w->about[i][2] - w->about[j][2], doubt = ROOM * (w->about[i][2] + w->about[j][2]);
  bool swap = fabs(more) > doubt ? more > 0 : mpq_cmp(w->disc[i].r, w->disc[j].r) > 0;
  w->i = swap ? j : i;
  w->j = swap ? i : j;
  w->count = 0;
  for (int end = 0; end < 2; end++) {
    dyd_legal_each_at(w->pd, end ? j : i, see_neighbour, w);
    dyd_open_each_at(w->pd, end ? j : i, DYD_TIE, see_neighbour, w);
  }
  if (known != DYD_ILLEGAL && (vertices_near(w, i, j, -1) ? large_is_legal(w) : discs_are_legal(w))) return DYD_LEGAL;
  bool possible = known == DYD_LEGAL || vertices_near(w, i, j, 1) || discs_are_possible(w);
  return possible ? DYD_INDETERMINATE : DYD_ILLEGAL;
}

/* *left: how many indeterminate pairs were not reached when work was cancelled; these stay as they are. */
static dyd_status decide_discs(dyd_disc_work *w, size_t *left, dyd_pair_list *list) {
  const uint32_t *vertex = w->pd->sk.vertex;
  size_t kept = 0;
  DYD_OWNED(dyd_delaunay) *inside = NULL;
  dyd_status st = triangulate_inside(&inside, w);
  for (size_t k = 0; (st == DYD_OK || st == DYD_CANCELLED) && k < list->count && !w->failed; k++) {
    dyd_pair p = list->item[k];
    if (st == DYD_OK && p.status == DYD_INDETERMINATE && dyd_flag_is_set(w->cancel)) st = DYD_CANCELLED;
    if (p.status == DYD_INDETERMINATE && st == DYD_CANCELLED)
      ++*left;
    else if (p.status == DYD_INDETERMINATE)
      p.status = discs_status(w, vertex[p.i], vertex[p.j], inside);
    if (p.status != DYD_ILLEGAL) list->item[kept++] = p;
  }
  list->count = kept;
  return w->failed ? DYD_E_NOMEM : st;
}

/* About the exponent of the largest end of a site. */
static int64_t exponent_of_site(const dyd_sites *s, size_t i) {
  double d[4], most = 0;
  dyd_sites_get_d(d, s, i);
  for (int k = 0; k < 4; k++) most = fmax(most, fabs(d[k]));
  if (isfinite(most)) return most > 0 ? ilogb(most) : INT64_MIN;
  DYD_LOCAL(dyd_rect, r);
  int64_t exp = INT64_MAX;
  if (dyd_sites_get(&r, s, i) == DYD_OK) {
    const dyd_dyadic *end[4] = {&r.x.lo, &r.x.hi, &r.y.lo, &r.y.hi};
    exp = 0;
    for (int k = 0; k < 4; k++) {
      int64_t top = end[k]->exp + (int64_t)mpz_sizeinbase(end[k]->man, 2);
      exp = top > exp ? top : exp;
    }
  }
  return exp;
}

/* By which power of two all is multiplied, so that squares of distances are doubles: 0 where they are, or where a site
 * is as good as unknown. */
static int scale_of_sites(const dyd_sites *s) {
  int64_t most = INT64_MIN;
  for (size_t i = 0; i < dyd_sites_count(s); i++) {
    int64_t exp = exponent_of_site(s, i);
    most = exp > most ? exp : most;
  }
  bool plain = most >= -MOST_EXPONENT && most <= MOST_EXPONENT;
  return plain || most < -FARTHEST_EXPONENT || most > FARTHEST_EXPONENT ? 0 : (int)-most;
}

static dyd_status scaled_rect(dyd_rect *out, const void *discs, size_t i) {
  const dyd_disc_work *w = discs;
  dyd_dyadic *end[4] = {&out->x.lo, &out->x.hi, &out->y.lo, &out->y.hi};
  dyd_status st = dyd_sites_get(out, w->sites, i);
  for (int k = 0; k < 4; k++) end[k]->exp += mpz_sgn(end[k]->man) ? w->scale : 0;
  return st;
}

/* Triangulates the sites, multiplied by 2^scale, instead of pd; cancelled: all stays as it is. */
static dyd_status triangulate_scaled(dyd_disc_work *w) {
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = w->cancel};
  dyd_status st = dyd_delaunay_made(&w->scaled, dyd_sites_count(w->sites), scaled_rect, w, &o, NULL);
  if (w->scaled)
    w->pd = w->scaled;
  else
    w->scale = 0;
  return st == DYD_CAPPED || st == DYD_CANCELLED ? DYD_OK : st;
}

static dyd_status discs_begin(dyd_disc_work *w, dyd_error *err) {
  dyd_caps_init(&w->caps);
  w->scale = scale_of_sites(w->sites);
  dyd_status st = w->scale ? triangulate_scaled(w) : DYD_OK;
  return st == DYD_OK ? dyd_discs_make(w, err) : st;
}

/* The status and message where pairs are listed, and not all of them are decided. */
static dyd_status discs_end(const dyd_disc_work *w, dyd_status st, size_t left, size_t count, dyd_error *err) {
  if (st == DYD_CANCELLED)
    return dyd_fail(err, st, "%zu of %zu pairs were not reached: they have the statuses of squares", left, count);
  if (st == DYD_OK && dyd_delaunay_is_capped(w->pd))
    return dyd_fail(err, DYD_CAPPED, "there are more pairs than can be stored: some are missing");
  if (st == DYD_OK || (err && err->code == st)) return st;
  return dyd_fail(err, st, "%s", dyd_status_text(st));
}

dyd_status dyd_disc_pairs(dyd_pair_list *out, const dyd_delaunay *pd, const volatile int *cancel, dyd_error *err) {
  if (!pd || !out) return dyd_fail_null(err);
  dyd_disc_work w = {.pd = pd, .sites = pd->sk.reps.sites, .cancel = cancel};
  dyd_pair_list list = {0};
  size_t left = 0;
  if (err) dyd_error_clear(err);
  dyd_status st = discs_begin(&w, err);
  if (st == DYD_OK) st = dyd_delaunay_pairs(&list, pd);
  if (st == DYD_OK && pd->sk.rects.tree.count) st = decide_discs(&w, &left, &list);
  dyd_discs_clear(&w);
  w.pd = pd;
  st = discs_end(&w, st, left, list.count, err);
  if (st == DYD_OK || st == DYD_CAPPED || st == DYD_CANCELLED) {
    dyd_pair_list_clear(out);
    *out = list;
  } else {
    dyd_pair_list_clear(&list);
  }
  return st;
}

/* ---- triangles ---- */

/* The centre of a square; all of them are one choice. */
static dyd_status disc_centre(dyd_rect *out, const void *squares, size_t i) {
  DYD_LOCAL(dyd_disc, d);
  dyd_status st = dyd_disc_of_site(&d, squares, i);
  return st == DYD_OK ? dyd_rect_set_q(out, d.x, d.y) : st;
}

static bool is_legal_in(const dyd_pair_list *pairs, uint32_t i, uint32_t j) {
  const dyd_pair key = {i < j ? i : j, i < j ? j : i, DYD_LEGAL};
  const dyd_pair *p = dyd_find_two(&key, pairs->item, pairs->count, sizeof key);
  return p && p->status == DYD_LEGAL;
}

dyd_status dyd_disc_triangles(dyd_triangle_list *out, const dyd_pair_list *pairs, const dyd_delaunay *pd) {
  if (!pd || !pairs || !out) return DYD_E_ARG;
  dyd_triangle_list list = {0};
  DYD_OWNED(dyd_delaunay) *centres = NULL;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options)};
  const dyd_sites *squares = dyd_delaunay_sites(pd);
  size_t kept = 0;
  dyd_status st = dyd_delaunay_made(&centres, dyd_sites_count(squares), disc_centre, squares, &o, NULL);
  if (st == DYD_CAPPED) st = DYD_OK;
  if (st == DYD_OK) st = dyd_delaunay_triangles(&list, NULL, centres, 0);
  for (size_t k = 0; k < list.count && pairs->count; k++) {
    const uint32_t *v = list.item[k].v;
    uint32_t a = dyd_delaunay_alias(pd, v[0]), b = dyd_delaunay_alias(pd, v[1]), c = dyd_delaunay_alias(pd, v[2]);
    if (!is_legal_in(pairs, a, b) || !is_legal_in(pairs, b, c) || !is_legal_in(pairs, a, c)) continue;
    list.item[kept++] = (dyd_triangle){{a, b, c}}; /* [DISC-3] */
  }
  list.count = kept;
  if (st != DYD_OK) return st;
  dyd_triangle_list_clear(out);
  *out = list;
  return DYD_OK;
}

dyd_status dyd_filter_ball(dyd_iv ball[3], const dyd_sites *sites, size_t i) {
  DYD_LOCAL(dyd_disc, d);
  dyd_status st = dyd_disc_of_site(&d, sites, i);
  mpq_srcptr number[3] = {d.x, d.y, d.r};
  for (int k = 0; k < 3 && st == DYD_OK; k++) {
    ball[k].lo = dyd_raw_quotient_get_d(mpq_numref(number[k]), 0, mpq_denref(number[k]), DYD_DOWN);
    ball[k].hi = dyd_raw_quotient_get_d(mpq_numref(number[k]), 0, mpq_denref(number[k]), DYD_UP);
  }
  return st;
}
