/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Statuses of discs [DISC-1]: what squares leave indeterminate is decided for the discs in them. The search for the
 * sites that bind is that of tolerances with weights, too [TOL-8].
 *
 * Whether a pair is legal, or possible, for some of the sites, those seen, is decided exactly by caps of directions.
 * For all sites: what those seen refute is refuted by all; what they allow is allowed by all when all others keep clear
 * of a circle of theirs, which doubles check: c = p_i + u / (2 h) with a direction u that is off by at most `turn`, so
 * c by `doubt`; distances are off by ROOM of all sizes (a few roundings each). A site that may not keep clear is seen
 * from then on. So doubles decide only far sites.
 *
 * h = (u.J -+ delta) / n, n = J^2 - delta^2, delta = R_j - R_i: its relative error is at most (turn |J| + 2^-49 (|J| +
 * delta)) / |u.J -+ delta| + 2^-48 (J^2 + delta^2) / n, and that of c - p_i twice this, while it is below 1/4, plus
 * turn. Where h is that small, the circle is a line but for a bulge of at most J^2 / (8 |c|) between the two discs.
 * Where n is too small for both, a witness in rationals is made as precise as it takes, up to MOST_BITS of its size. */
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
#define TURN 0x1p-38 /* directions between two that are less than 2^-9 from opposite are not used */
#define INSIDE 0x1p-46
#define ROOT_HALF 0x1.6a09e667f3bccp-1 /* below it */
enum {
  FIRST_SEEN = 10,
  MOST_NEW = 6,
  MOST_SEEN = 400,
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

/* Where radii are weights times `now`: that of v. */
static void weigh(dyd_disc_work *w, uint32_t v) {
  if (!w->weight) return;
  mpq_set_d(w->disc[v].r, w->weight[v]);
  mpq_set_d(w->caps.t, w->now);
  mpq_mul(w->disc[v].r, w->disc[v].r, w->caps.t);
}

void dyd_discs_weigh(dyd_disc_work *w, double now) {
  w->now = now;
  weigh(w, w->i);
  weigh(w, w->j);
  for (size_t k = 0; k < w->count; k++) weigh(w, w->seen[k]);
}

bool dyd_discs_see(dyd_disc_work *w, uint32_t v) {
  if (is_seen(w, v)) return false;
  if (!DYD_GROW(w->seen, w->cap, w->count + 1)) w->failed = true;
  if (w->failed) return false;
  weigh(w, v);
  w->seen[w->count++] = v;
  return true;
}

static void see_neighbour(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  (void)v, (void)status;
  dyd_disc_work *d = context;
  if (d->count < FIRST_SEEN) dyd_discs_see(d, w);
}

static double radius_d(const dyd_disc_work *w, uint32_t v) {
  return w->weight ? w->weight[v] * w->now : w->about[v][2];
}

/* A circle in doubles, or, with `line`, the half-plane beyond height along (x, y). clear: how far others have to keep
 * from it, beyond what distances are off by. */
typedef struct circle_trial {
  dyd_disc_work *w;
  bool legal, line;
  double x, y, radius, height, clear;
} circle_trial;

static double size_d(const dyd_disc_work *w, uint32_t v) {
  return fabs(w->about[v][0]) + fabs(w->about[v][1]) + radius_d(w, v);
}

static double distance_d(const circle_trial *c, uint32_t v) {
  return hypot(c->w->about[v][0] - c->x, c->w->about[v][1] - c->y);
}

/* How much all is off by, with v. */
static double room_d(const circle_trial *c, uint32_t v) {
  return ROOM * (size_d(c->w, v) + (c->line ? fabs(c->height) : fabs(c->x) + fabs(c->y) + c->radius)) + c->clear;
}

/* Returns true if disc v is outside for certain (legal), or not inside for certain. */
static bool keeps_clear(const circle_trial *c, uint32_t v) {
  double r = radius_d(c->w, v), room = room_d(c, v);
  if (c->line) return c->x * c->w->about[v][0] + c->y * c->w->about[v][1] + (c->legal ? r : -r) < c->height - room;
  return distance_d(c, v) + (c->legal ? -r : r) > c->radius + room;
}

/* Are the centres as near as the sum (sign = 1) or the difference of the radii? */
static bool vertices_near(const dyd_disc_work *w, uint32_t v, uint32_t k, int sign) {
  const double *a = w->about[v], *b = w->about[k];
  double gap = hypot(b[0] - a[0], b[1] - a[1]) - fabs(radius_d(w, v) + sign * radius_d(w, k));
  if (fabs(gap) > ROOM * (size_d(w, v) + size_d(w, k))) return gap < 0;
  return (sign < 0 ? dyd_disc_is_within : dyd_discs_meet)(&w->disc[v], &w->disc[k]);
}

/* ---- all others ---- */

/* added: how many discs were not clear of it, and are seen now. */
typedef struct circle_look {
  circle_trial at;
  int added;
} circle_look;

static bool meet_other(void *context, uint32_t v) {
  circle_look *l = context;
  if (keeps_clear(&l->at, v) || !dyd_discs_see(l->at.w, v)) return !l->at.w->failed;
  return ++l->added < MOST_NEW;
}

static double tree_extent(const dyd_tree *t) {
  const double *e = t->node[t->level[t->levels - 1]].e;
  return e[1] - e[0] + (e[3] - e[2]);
}

/* Returns true if all others are clear of it. Otherwise some are seen now. */
static bool all_are_clear(const circle_trial *c) {
  circle_look others = {.at = *c};
  double most = c->legal ? c->w->now * c->w->heaviest : 0, reach = c->radius + most;
  double size = fabs(c->x) + fabs(c->y) + reach + tree_extent(c->w->tree);
  const dyd_bbox at = {{c->x, c->x, c->y, c->y}};
  double height = c->height - most - 16 * ROOM * (size + fabs(c->height)) - c->clear;
  double radius2 = reach + 16 * ROOM * size + c->clear;
  radius2 *= radius2 * (1 + ROOM);
  if (c->line)
    dyd_tree_beyond(c->w->tree, c->x, c->y, &height, meet_other, &others);
  else
    dyd_tree_near(c->w->tree, &at, &radius2, meet_other, &others);
  return others.added == 0 && !c->w->failed;
}

/* ---- circles ---- */

/* The circle of direction u; false: doubles cannot place it. */
static bool circle_of_direction(circle_trial *c, dyd_disc_work *w, dyd_direction u, bool legal) {
  const double *i = w->about[w->i], *j = w->about[w->j];
  double jx = j[0] - i[0], jy = j[1] - i[1], size = hypot(jx, jy);
  double ri = radius_d(w, w->i), rj = radius_d(w, w->j), delta = rj - ri;
  double n = size * size - delta * delta, coordinates = fabs(i[0]) + fabs(i[1]) + fabs(j[0]) + fabs(j[1]);
  double num = u.x * jx + u.y * jy + (legal ? -delta : delta), from = 1 / (2 * num / n);
  double turn = fmax(TURN, u.off);
  double off = turn * size + 0x1p-49 * (size + delta + coordinates) +
               0x1p-48 * (size * size + delta * delta + size * coordinates) / n * fabs(num),
         doubt = off / fabs(num);
  *c = (circle_trial){.w = w, .legal = legal};
  if (!(n > 0x1p-20 * size * size && n > 0x1p-400 && n < 0x1p400)) return false;
  if (num > 0 && doubt < 0.25) {
    c->x = i[0] + u.x * from;
    c->y = i[1] + u.y * from;
    double a = distance_d(c, w->i), b = distance_d(c, w->j);
    c->radius = legal ? fmax(a + ri, b + rj) : fmax(a - ri, b - rj);
    c->clear = 2 * fabs(from) * (2 * doubt + turn) + ROOM * coordinates;
    return c->radius < 1e150 && c->clear < 1e150;
  }
  double a = u.x * i[0] + u.y * i[1], b = u.x * j[0] + u.y * j[1], wide = tree_extent(w->tree);
  c->line = true;
  c->x = u.x;
  c->y = u.y;
  c->height = legal ? fmin(a - ri, b - rj) : fmin(a + ri, b + rj);
  c->clear = 8 * (turn + off / size) * (size + wide) * (1 + size * size / n);
  return isfinite(c->height) && isfinite(c->clear);
}

/* A direction that all caps have in common: about the middle, or where they have nearly half of all, that of J. */
static bool direction_in_common(dyd_direction *u, dyd_disc_work *w) {
  if (!dyd_caps_common(u, &w->caps)) return false;
  dyd_direction a = dyd_filter_cap_end(&w->caps.item[w->caps.by[0]], -1);
  dyd_direction b = dyd_filter_cap_end(&w->caps.item[w->caps.by[1]], 1);
  if (hypot(a.x + b.x, a.y + b.y) > 0x1p-8) return true;
  const double *i = w->about[w->i], *j = w->about[w->j];
  double x = j[0] - i[0], y = j[1] - i[1], size = hypot(x, y);
  *u = (dyd_direction){x / size, y / size, 0};
  return true;
}

/* ---- one question ---- */

/* Returns true if no disc meets d, which holds i and j. Otherwise some may be seen now. */
static bool is_witness(dyd_disc_work *w, const dyd_disc *d) {
  const circle_trial c = {.w = w, .legal = true, .x = mpq_get_d(d->x), .y = mpq_get_d(d->y), .radius = mpq_get_d(d->r)};
  if (!isfinite(c.x) || !isfinite(c.y) || !isfinite(c.radius)) return false;
  for (;;) {
    for (size_t k = 0; k < w->count; k++)
      if (dyd_discs_meet(d, &w->disc[w->seen[k]])) return false;
    if (all_are_clear(&c)) return true;
    if (w->failed) return false;
  }
}

/* Where doubles do not place the circle of the direction found: as precise as it takes. */
static bool has_fine_witness(dyd_disc_work *w) {
  DYD_LOCAL(dyd_disc, d);
  bool found = false;
  size_t had = w->count;
  for (unsigned bits = LEAST_BITS; bits <= w->most_bits && w->count == had && !w->failed && !found; bits *= 4)
    found = dyd_caps_circle(&d, &w->caps, bits) && is_witness(w, &d);
  return found;
}

/* The caps of those seen that have none yet. false: legal, and one of them meets i or j, so that none is a witness. */
static bool load_more(dyd_disc_work *w, bool legal) {
  for (; w->loaded < w->count && !w->failed; w->loaded++) {
    uint32_t v = w->seen[w->loaded];
    bool meets = vertices_near(w, w->i, v, 1) || vertices_near(w, w->j, v, 1);
    if (meets && legal) return false;
    if (!meets && !dyd_caps_add(&w->caps, &w->disc[v], v)) w->failed = true;
  }
  return !w->failed;
}

dyd_truth dyd_discs_ask(dyd_disc_work *w, bool legal) {
  if (!legal && vertices_near(w, w->i, w->j, 1)) return DYD_TRUE;
  if (legal && vertices_near(w, w->i, w->j, -1)) /* the larger is the best witness then */
    return is_witness(w, &w->disc[w->j]) ? DYD_TRUE : w->failed ? DYD_UNKNOWN : DYD_FALSE;
  w->loaded = 0;
  if (!dyd_caps_begin(&w->caps, &w->disc[w->i], &w->disc[w->j], legal)) w->failed = true;
  for (size_t had = SIZE_MAX; w->count != had && !w->failed;) {
    dyd_direction u;
    circle_trial c;
    bool some = load_more(w, legal) && (legal ? direction_in_common(&u, w) : dyd_caps_uncovered(&u, &w->caps));
    if (!some) return w->failed ? DYD_UNKNOWN : DYD_FALSE;
    had = w->count;
    DYD_INVARIANT(w->weight || had < MOST_SEEN); /* a few are enough */
    if (circle_of_direction(&c, w, u, legal) ? all_are_clear(&c) : legal && has_fine_witness(w)) return DYD_TRUE;
  }
  return DYD_UNKNOWN;
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
  if (known != DYD_ILLEGAL && dyd_discs_ask(w, true) == DYD_TRUE) return DYD_LEGAL;
  return known == DYD_LEGAL || dyd_discs_ask(w, false) != DYD_FALSE ? DYD_INDETERMINATE : DYD_ILLEGAL;
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
  w->tree = &w->pd->sk.rects.tree;
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
  dyd_disc_work w = {.pd = pd, .sites = pd->sk.reps.sites, .most_bits = MOST_BITS, .cancel = cancel};
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
