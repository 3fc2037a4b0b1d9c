/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which places of a sphere are nearest to a place [CERT-12].
 *
 * All of a region is within an angle s of its middle: the angle of its cap, half of its latitudes, and half of its
 * longitudes times the greatest cosine of a latitude. With A and B the angles from the middle of `at` to those of two
 * regions, the first is nearer for every choice if A + s < B, s the sum of theirs and twice that of `at`; that is, as
 * long as A + s is below half a turn, if cos B < cos(A + s). Caps are what they are by this; boxes of degrees may be
 * less, and are cut in two where it does not hold. */
#include "checker/globe_near.h"

#include "base/alloc.h"
#include "base/index.h"
#include "base/local.h"
#include "checker/algebra.h"
#include "checker/tree.h"

enum { FIRST_PRECISION = 128, COARSE_BITS = 30, MOST_CUTS = 400 };
#define EFFORT ((uint64_t)1 << 12) /* of one question: a comparison at the first precision is 1 */

/* ---- a ball about a region ---- */

/* The middle, as a vector of length 1; box: how far the box of degrees reaches, cap: its angle; 2^-p. */
typedef struct ball {
  dyd_cert_enclosure v[3], cap;
  mpz_t box;
} ball;

static void place_ball_init(ball *b) {
  for (int k = 0; k < 3; k++) dyd_cert_enclosure_init(&b->v[k]);
  dyd_cert_enclosure_init(&b->cap);
  mpz_init(b->box);
}

static void place_ball_clear(ball *b) {
  for (int k = 0; k < 3; k++) dyd_cert_enclosure_clear(&b->v[k]);
  dyd_cert_enclosure_clear(&b->cap);
  mpz_clear(b->box);
}

/* x = q degrees in radians, rounded up, q >= 0: a degree is less than 0.0174533. */
static void radians_above(mpz_t x, mpq_srcptr q, long p) {
  DYD_LOCAL_NUMBERS(mpz, den);
  mpz_mul_ui(x, mpq_numref(q), 174533);
  mpz_mul_2exp(x, x, (mp_bitcnt_t)p);
  mpz_mul_ui(den, mpq_denref(q), 10000000);
  mpz_cdiv_q(x, x, den);
}

/* From the middle along its parallel, then along a meridian. cosine: of the middle latitude. */
static void ball_set_box(ball *b, const dyd_cert_region *r, const dyd_cert_enclosure *cosine, long p) {
  DYD_LOCAL_NUMBERS(mpz, lat);
  radians_above(lat, r->half[1], p);
  radians_above(b->box, r->half[0], p);
  mpz_mul(b->box, b->box, cosine->hi);
  mpz_cdiv_q_2exp(b->box, b->box, (mp_bitcnt_t)p);
  mpz_add(b->box, b->box, lat);
}

static void ball_set(ball *b, const dyd_cert_region *r, const dyd_cert_enclosure *pi, long p) {
  DYD_LOCAL(dyd_cert_trig, lon, lat);
  dyd_cert_trig_of_degrees(&lon, r->mid[0], pi, p);
  dyd_cert_trig_of_degrees(&lat, r->mid[1], pi, p);
  dyd_cert_enclosure_set(&b->v[0], &lon.c);
  dyd_cert_enclosure_set(&b->v[1], &lon.s);
  for (int k = 0; k < 2; k++) dyd_cert_enclosure_mul(&b->v[k], &lat.c, p);
  dyd_cert_enclosure_set(&b->v[2], &lat.s);
  dyd_cert_enclosure_set_q(&b->cap, mpq_numref(r->angle), mpq_denref(r->angle), p);
  ball_set_box(b, r, &lat.c, p);
}

/* out = the cosine of the angle between the middles, within [-1, 1]. */
static void cosine_between(dyd_cert_enclosure *out, const ball *a, const ball *b, long p) {
  DYD_LOCAL(dyd_cert_enclosure, x);
  dyd_cert_enclosure_set_si(out, 0, p);
  for (int k = 0; k < 3; k++) {
    dyd_cert_enclosure_set(&x, &a->v[k]);
    dyd_cert_enclosure_mul(&x, &b->v[k], p);
    dyd_cert_enclosure_add(out, &x);
  }
  dyd_cert_enclosure_set_si(&x, 1, p);
  dyd_cert_enclosure_extreme(out, -1, &x);
  dyd_cert_enclosure_neg(&x);
  dyd_cert_enclosure_extreme(out, 1, &x);
}

/* ---- two regions from a third ---- */

/* Three regions, at, the nearer and the farther one, their balls, and scratch numbers. */
typedef struct three_regions {
  const dyd_cert_region *of[3];
  ball ball[3];
  dyd_cert_enclosure pi, near, far, s, t;
  long p;
} three_regions;

static void near_view_init(three_regions *v) {
  dyd_cert_enclosure *all[] = {&v->pi, &v->near, &v->far, &v->s, &v->t};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) dyd_cert_enclosure_init(all[k]);
  for (int k = 0; k < 3; k++) place_ball_init(&v->ball[k]);
}

static void near_view_clear(three_regions *v) {
  dyd_cert_enclosure *all[] = {&v->pi, &v->near, &v->far, &v->s, &v->t};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) dyd_cert_enclosure_clear(all[k]);
  for (int k = 0; k < 3; k++) place_ball_clear(&v->ball[k]);
}

static void view_focus(three_regions *v, long p, int regions) {
  v->p = p;
  dyd_cert_enclosure_pi(&v->pi, p);
  for (int k = 0; k < regions; k++) ball_set(&v->ball[k], v->of[k], &v->pi, p);
}

static bool sum_is_large(const three_regions *v) {
  DYD_LOCAL_NUMBERS(mpz, halves);
  mpz_fdiv_q_2exp(halves, v->s.hi, (mp_bitcnt_t)(v->p - 1));
  return mpz_cmp_ui(halves, 3) >= 0;
}

/* t = cos(A + s), A having the cosine `near`; returns true if A + s is below half a turn for certain: as A is below a
 * quarter and s below 3/2, or by the sine of the sum. */
static bool cosine_of_sum(three_regions *v) {
  dyd_cert_enclosure root, sine, cosine, x;
  dyd_cert_enclosure *all[] = {&root, &sine, &cosine, &x};
  if (sum_is_large(v)) return false;
  for (int k = 0; k < 4; k++) dyd_cert_enclosure_init(all[k]);
  dyd_cert_enclosure_set(&x, &v->near);
  dyd_cert_enclosure_mul(&x, &x, v->p);
  dyd_cert_enclosure_set_si(&root, 1, v->p);
  dyd_cert_enclosure_sub(&root, &x);
  dyd_cert_enclosure_root(&root, 2, v->p); /* sin A */
  dyd_cert_enclosure_cos_sin(&cosine, &sine, &v->s, v->p);
  dyd_cert_enclosure_set(&v->t, &v->near);
  dyd_cert_enclosure_mul(&v->t, &cosine, v->p);
  dyd_cert_enclosure_set(&x, &root);
  dyd_cert_enclosure_mul(&x, &sine, v->p);
  dyd_cert_enclosure_sub(&v->t, &x);
  dyd_cert_enclosure_mul(&root, &cosine, v->p);
  dyd_cert_enclosure_mul(&sine, &v->near, v->p);
  dyd_cert_enclosure_add(&root, &sine); /* sin(A + s) */
  bool good = dyd_cert_enclosure_sign(&v->near) > 0 || dyd_cert_enclosure_sign(&root) > 0;
  for (int k = 0; k < 4; k++) dyd_cert_enclosure_clear(all[k]);
  return good && v->t.known;
}

/* s = how far both choices may be apart from their middles, of `at` too: boxes count, or only caps. */
static void view_set_sum(three_regions *v, bool boxes) {
  dyd_cert_enclosure_set(&v->s, &v->ball[1].cap);
  dyd_cert_enclosure_add(&v->s, &v->ball[2].cap);
  for (int k = 0; boxes && k < 4; k++) { /* that of `at` twice */
    mpz_add(v->s.lo, v->s.lo, v->ball[k % 3].box);
    mpz_add(v->s.hi, v->s.hi, v->ball[k % 3].box);
  }
}

/* 1: A + s < B for certain, -1: >, 0: not known. */
static int view_compare(three_regions *v, bool boxes) {
  cosine_between(&v->near, &v->ball[0], &v->ball[1], v->p);
  cosine_between(&v->far, &v->ball[0], &v->ball[2], v->p);
  view_set_sum(v, boxes);
  if (!cosine_of_sum(v)) return 0;
  return mpz_cmp(v->far.hi, v->t.lo) < 0 ? 1 : -(mpz_cmp(v->far.lo, v->t.hi) > 0);
}

/* ---- parts of boxes ---- */

static bool region_is_boxed(const dyd_cert_region *r) {
  return mpq_sgn(r->half[0]) || mpq_sgn(r->half[1]);
}

/* *out is one half of r, across its longer side: longitudes, whose cosine is that of the ball, or latitudes. */
static void region_halve(dyd_cert_region *out, const dyd_cert_region *r, const ball *b, bool upper, long p) {
  DYD_LOCAL_NUMBERS(mpz, lat);
  radians_above(lat, r->half[1], p);
  mpz_mul_2exp(lat, lat, 1);
  int axis = mpz_cmp(lat, b->box) > 0;
  for (int k = 0; k < 2; k++) {
    mpq_set(out->mid[k], r->mid[k]);
    mpq_set(out->half[k], r->half[k]);
  }
  mpq_set(out->angle, r->angle);
  mpq_div_2exp(out->half[axis], out->half[axis], 1);
  (upper ? mpq_add : mpq_sub)(out->mid[axis], out->mid[axis], out->half[axis]);
}

/* Of the first `regions` that one whose box adds most to the sum. */
static int view_widest(const three_regions *v, int regions) {
  int widest = 0;
  for (int k = 1; k < regions; k++)
    if (mpz_cmp(v->ball[k].box, v->ball[widest].box) > 0) widest = k;
  return widest;
}

/* Takes the cost of precision p from the effort, if there is enough of it. */
static bool may_look(uint64_t *effort, long p) {
  uint64_t cost = (uint64_t)(p / FIRST_PRECISION);
  if (*effort < cost) return false;
  *effort -= cost;
  return true;
}

/* Does the test hold for the regions, or for the parts of their boxes? It returns 1, -1, where it does not hold for
 * their middles, or 0. */
typedef int view_test(three_regions *v, void *user);

static bool view_holds(three_regions *v, int regions, view_test *test, void *user, uint64_t *effort, int cuts) {
  bool boxed = false;
  for (int k = 0; k < regions; k++) boxed = boxed || region_is_boxed(v->of[k]);
  int holds = 0;
  for (long p = FIRST_PRECISION; !holds; p *= 2) {
    if (p > DYD_CERT_PRECISION || !may_look(effort, p)) return false;
    view_focus(v, p, regions);
    holds = test(v, user);
    if (boxed && p > cuts) break;
  }
  if (holds || cuts == MOST_CUTS) return holds > 0;
  int widest = view_widest(v, regions);
  const dyd_cert_region *whole = v->of[widest];
  DYD_LOCAL(dyd_cert_region, part);
  bool good = true;
  for (int upper = 0; upper < 2 && good; upper++) {
    view_focus(v, FIRST_PRECISION, regions);
    region_halve(&part, whole, &v->ball[widest], upper, FIRST_PRECISION);
    v->of[widest] = &part;
    good = view_holds(v, regions, test, user, effort, cuts + 1);
    v->of[widest] = whole;
  }
  return good;
}

static int test_nearer(three_regions *v, void *user) {
  (void)user;
  if (view_compare(v, true) > 0) return 1;
  return view_compare(v, false) < 0 ? -1 : 0;
}

/* Is i nearer than k to each place of `at`, for every choice? */
static bool region_is_nearer(const dyd_cert_region *at, const dyd_cert_region *i, const dyd_cert_region *k,
                             uint64_t *effort) {
  three_regions v = {.of = {at, i, k}};
  near_view_init(&v);
  bool nearer = view_holds(&v, 3, test_nearer, NULL, effort, 0);
  near_view_clear(&v);
  return nearer;
}

/* ---- in whole numbers ---- */

static void bowl_set(dyd_cert_bowl *out, const dyd_cert_region *r) {
  ball b;
  place_ball_init(&b);
  DYD_LOCAL(dyd_cert_enclosure, pi);
  dyd_cert_enclosure_pi(&pi, 2 * COARSE_BITS);
  ball_set(&b, r, &pi, 2 * COARSE_BITS);
  mpz_add(b.box, b.box, b.cap.hi);
  mpz_cdiv_q_2exp(b.box, b.box, COARSE_BITS);
  const int64_t most = INT64_C(2) << COARSE_BITS;
  out->r = mpz_cmp_si(b.box, most) < 0 ? mpz_get_si(b.box) : most;
  out->r += 2; /* the middle is off by less than a unit along each axis */
  for (int k = 0; k < 3; k++) {
    mpz_fdiv_q_2exp(b.v[k].lo, b.v[k].lo, COARSE_BITS);
    out->v[k] = mpz_get_si(b.v[k].lo);
  }
  place_ball_clear(&b);
}

static uint64_t bowl_distance2(const dyd_cert_bowl *a, const dyd_cert_bowl *b) {
  uint64_t sum = 0;
  for (int k = 0; k < 3; k++) {
    int64_t d = a->v[k] - b->v[k];
    sum += (uint64_t)(d * d);
  }
  return sum;
}

/* At least the distance of any two of their points. */
static int64_t bowl_far(const dyd_cert_bowl *a, const dyd_cert_bowl *b) {
  DYD_LOCAL_NUMBERS(mpz, root);
  mpz_set_ui(root, bowl_distance2(a, b));
  mpz_sqrt(root, root);
  return mpz_get_si(root) + 1 + a->r + b->r;
}

/* Are all points of the one farther than `far` from all of the other? */
static bool bowls_are_apart(const dyd_cert_bowl *a, const dyd_cert_bowl *b, int64_t far) {
  return dyd_cert_square(far + a->r + b->r) < bowl_distance2(a, b);
}

dyd_status dyd_cert_compass_init(dyd_cert_compass *c, size_t count) {
  *c = (dyd_cert_compass){.region = dyd_alloc(count, sizeof *c->region), .bowl = dyd_alloc(count, sizeof *c->bowl)};
  if (!c->region || !c->bowl) return DYD_E_NOMEM;
  for (; c->count < count; c->count++) dyd_cert_region_init(&c->region[c->count]);
  return DYD_OK;
}

void dyd_cert_compass_clear(dyd_cert_compass *c) {
  for (size_t i = 0; i < c->count; i++) dyd_cert_region_clear(&c->region[i]);
  dyd_free_all(c->region, c->bowl);
}

void dyd_cert_compass_note(dyd_cert_compass *c, size_t i, bool alias) {
  bowl_set(&c->bowl[i], &c->region[i]);
  c->bowl[i].alias = alias;
}

/* ---- questions ---- */

bool dyd_cert_compass_is_certain(uint32_t *other, const dyd_cert_compass *c, const dyd_cert_region *at, uint32_t i) {
  dyd_cert_bowl here;
  bowl_set(&here, at);
  const int64_t far = bowl_far(&here, &c->bowl[i]);
  for (uint32_t k = 0; k < c->count; k++) {
    uint64_t effort = EFFORT;
    if (k == i || c->bowl[k].alias || bowls_are_apart(&here, &c->bowl[k], far)) continue;
    if (region_is_nearer(at, &c->region[i], &c->region[k], &effort)) continue;
    *other = k;
    return false;
  }
  return true;
}

void dyd_cert_compass_count(uint64_t *unproved, const dyd_cert_compass *c, const dyd_cert_region *at,
                            const uint32_t *list, size_t count) {
  dyd_cert_bowl here;
  size_t best = 0;
  int64_t least = INT64_MAX;
  uint64_t effort = EFFORT;
  bowl_set(&here, at);
  for (size_t k = 0; k < count; k++) {
    int64_t far = bowl_far(&here, &c->bowl[list[k]]);
    if (far >= least) continue;
    least = far;
    best = k;
  }
  for (uint32_t j = 0; j < c->count; j++) {
    const bool apart = c->bowl[j].alias || bowls_are_apart(&here, &c->bowl[j], least);
    if (apart || dyd_find_index(&j, list, count, sizeof *list)) continue;
    bool nowhere = false;
    for (size_t k = 0; k < count && !nowhere; k++)
      nowhere = region_is_nearer(at, &c->region[list[(best + k) % count]], &c->region[j], &effort);
    *unproved += !nowhere;
  }
}

/* ---- bounds of a distance ---- */

/* Bounds in radians; upper: it is one from above. */
typedef struct ground_bound {
  mpq_t angle;
  bool upper;
} ground_bound;

static int test_ground(three_regions *v, void *user) {
  const ground_bound *b = user;
  dyd_cert_enclosure_set_q(&v->t, mpq_numref(b->angle), mpq_denref(b->angle), v->p);
  if (b->upper && mpz_cmp(v->t.lo, v->pi.hi) >= 0) return 1;
  cosine_between(&v->near, &v->ball[0], &v->ball[1], v->p);
  dyd_cert_enclosure_acos(&v->near, v->p);
  dyd_cert_enclosure_set(&v->s, &v->ball[1].cap);
  dyd_cert_enclosure_add(&v->s, &v->ball[0].cap);
  if (b->upper) {
    dyd_cert_enclosure_add(&v->near, &v->s);
    dyd_cert_enclosure_sub(&v->t, &v->near);
  } else {
    dyd_cert_enclosure_add(&v->t, &v->s);
    dyd_cert_enclosure_sub(&v->near, &v->t);
    dyd_cert_enclosure_set(&v->t, &v->near);
  } /* t: by how much the bound holds for the middles */
  if (!v->t.known || mpz_sgn(v->t.hi) < 0) return -1;
  for (int k = 0; k < 2; k++) mpz_sub(v->t.lo, v->t.lo, v->ball[k].box);
  return mpz_sgn(v->t.lo) >= 0;
}

/* out = the least, or the greatest difference of longitudes of the two, at most 180. */
static void longitudes_apart(mpq_ptr out, const dyd_cert_region *a, const dyd_cert_region *b, bool greatest) {
  DYD_LOCAL_NUMBERS(mpq, half, turn);
  DYD_LOCAL_NUMBERS(mpz, turns);
  mpq_set_ui(turn, 360, 1);
  mpq_sub(out, a->mid[0], b->mid[0]);
  mpq_abs(out, out);
  mpq_div(half, out, turn);
  mpz_fdiv_q(turns, mpq_numref(half), mpq_denref(half));
  mpq_set_z(half, turns);
  mpq_mul(half, half, turn);
  mpq_sub(out, out, half); /* below 360 */
  mpq_sub(half, turn, out);
  if (mpq_cmp(half, out) < 0) mpq_set(out, half);
  mpq_add(half, a->half[0], b->half[0]);
  (greatest ? mpq_add : mpq_sub)(out, out, half);
  if (mpq_sgn(out) < 0) mpq_set_ui(out, 0, 1);
  if (mpq_cmp_ui(out, 180, 1) > 0) mpq_set_ui(out, 180, 1);
}

/* The distance grows with the difference of longitudes: only boxes of latitudes are left. */
static bool ground_bound_holds(const dyd_cert_region *a, const dyd_cert_region *b, const dyd_exact *metres,
                               bool upper) {
  ground_bound bound = {.upper = upper};
  uint64_t effort = EFFORT / 4;
  dyd_cert_region end[2];
  three_regions v = {.of = {&end[0], &end[1]}};
  DYD_LOCAL_NUMBERS(mpq, metre);
  mpq_init(bound.angle);
  mpq_set_ui(metre, 5, 31855044); /* globe_places.c */
  dyd_cert_exact_to_q(bound.angle, metres, NULL);
  mpq_mul(bound.angle, bound.angle, metre);
  for (int k = 0; k < 2; k++) {
    dyd_cert_region_init(&end[k]);
    mpq_set(end[k].mid[1], (k ? b : a)->mid[1]);
    mpq_set(end[k].half[1], (k ? b : a)->half[1]);
    mpq_set(end[k].angle, (k ? b : a)->angle);
  }
  longitudes_apart(end[1].mid[0], a, b, upper);
  near_view_init(&v);
  bool holds = view_holds(&v, 2, test_ground, &bound, &effort, 0);
  near_view_clear(&v);
  for (int k = 0; k < 2; k++) dyd_cert_region_clear(&end[k]);
  mpq_clear(bound.angle);
  return holds;
}

bool dyd_cert_ground_bounds_hold(const dyd_cert_region *a, const dyd_cert_region *b, const dyd_exact *lo,
                                 const dyd_exact *hi) {
  if (dyd_exact_sgn(lo) > 0 && !ground_bound_holds(a, b, lo, false)) return false;
  return !hi || ground_bound_holds(a, b, hi, true);
}
