/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Stereographic projection from a place q = (l0, f0) on the sphere, in balls.
 *
 * With d = l - l0 and u = (f - f0) / 2 a place (l, f) goes to (X, Y) / D,
 *     D = 2 sin^2 u + 2 cos f0 cos f sin^2(d/2),  X = cos f sin d,  Y = sin 2u + 2 sin f0 cos f sin^2(d/2):
 * D is a sum of squares, so that nothing is lost near q. The places within an angle a of (l, f) go to the disc with
 * centre (X, Y) / E and radius sin a / E, E = D - 2 sin^2(a/2), as long as E > 0 [SPH-2].
 *
 * Over a box of v = (d, f, f0) with middle m, F(v) is extreme at an end of v_k where F_k(box), which holds its slope,
 * has one sign; by other variables it is off by F_k(box) (v_k - m_k). Boxes that are wide, measured by their distance
 * from q, are cut; where pieces are too many, they reach q. */
#include "base/error.h"
#include "base/flag.h"
#include "base/local.h"
#include "engine/points.h"
#include "rect/rect.h"
#include "sphere/state.h"
#include "stream/ball.h"
#include "stream/stream.h"

enum { EYE_BITS = 64, VARIABLES = 3, MOST_PIECES = 1 << 13, MOST_DEPTH = VARIABLES * 64 };

/* ---- one piece ---- */

/* A box of the three variables, in radians: middles, and upper bounds of half-widths. */
typedef struct variable_box {
  arb_struct mid[VARIABLES];
  mag_struct half[VARIABLES];
} variable_box;

/* Values at a middle, or over a box. E instead of D where there is an angle. */
typedef struct eye_values {
  arb_struct sd, cd, sf, cf, s0, c0, versine, D, E, X, Y, t;
} eye_values;

enum { VIEW_BALLS = sizeof(eye_values) / sizeof(arb_struct) };

/* Shared by all pieces. */
typedef struct sight {
  arb_t size, lost; /* sin a, 2 sin^2(a/2) */
  eye_values at, over;
  arb_t slope, number;
  arb_struct by[3];  /* derivatives of D, X and Y */
  arf_struct end[4]; /* x and y so far: lower and upper ends */
  arf_t limit;
  bool wide, any;
  slong prec;
  unsigned pieces;
  const volatile int *stop;
} sight;

static void eye_values_init(eye_values *v) {
  for (arb_ptr b = &v->sd; b < &v->sd + VIEW_BALLS; b++) arb_init(b);
}

static void eye_values_clear(eye_values *v) {
  for (arb_ptr b = &v->sd; b < &v->sd + VIEW_BALLS; b++) arb_clear(b);
}

/* d, f and f0 as balls. */
static void view_set(eye_values *v, arb_srcptr d, arb_srcptr f, arb_srcptr f0, const sight *g) {
  slong prec = g->prec;
  arb_sin_cos(&v->sd, &v->cd, d, prec);
  arb_sin_cos(&v->sf, &v->cf, f, prec);
  arb_sin_cos(&v->s0, &v->c0, f0, prec);
  arb_mul_2exp_si(&v->t, d, -1);
  arb_sin(&v->versine, &v->t, prec);
  arb_sqr(&v->versine, &v->versine, prec);
  arb_mul_2exp_si(&v->versine, &v->versine, 1);
  arb_mul(&v->E, &v->cf, &v->versine, prec); /* cos f (1 - cos d) */
  arb_sub(&v->t, f, f0, prec);
  arb_mul_2exp_si(&v->t, &v->t, -1);
  arb_sin_cos(&v->D, &v->Y, &v->t, prec);
  arb_mul(&v->Y, &v->Y, &v->D, prec);
  arb_mul_2exp_si(&v->Y, &v->Y, 1);
  arb_addmul(&v->Y, &v->s0, &v->E, prec);
  arb_sqr(&v->D, &v->D, prec);
  arb_mul_2exp_si(&v->D, &v->D, 1);
  arb_addmul(&v->D, &v->c0, &v->E, prec);
  arb_mul(&v->X, &v->cf, &v->sd, prec);
  arb_sub(&v->E, &v->D, g->lost, prec);
}

/* The derivatives of D, X and Y by variable k. */
static void view_derive(arb_t D_k, arb_t X_k, arb_t Y_k, const eye_values *v, int k, slong prec) {
  if (k == 0) {
    arb_mul(D_k, &v->c0, &v->X, prec);
    arb_mul(X_k, &v->cf, &v->cd, prec);
    arb_mul(Y_k, &v->s0, &v->X, prec);
  } else if (k == 1) {
    arb_mul(D_k, &v->c0, &v->sf, prec);
    arb_mul(D_k, D_k, &v->cd, prec);
    arb_submul(D_k, &v->s0, &v->cf, prec);
    arb_mul(X_k, &v->sf, &v->sd, prec);
    arb_neg(X_k, X_k);
    arb_mul(Y_k, &v->s0, &v->sf, prec);
    arb_mul(Y_k, Y_k, &v->cd, prec);
    arb_addmul(Y_k, &v->c0, &v->cf, prec);
  } else {
    arb_neg(D_k, &v->Y);
    arb_zero(X_k);
    arb_sub_ui(Y_k, &v->D, 1, prec);
  }
}

/* out = (N + side sin a) / E. */
static void view_value(arb_t out, const eye_values *v, int axis, int side, sight *g) {
  arb_mul_si(g->number, g->size, side, g->prec);
  arb_add(out, axis ? &v->Y : &v->X, g->number, g->prec);
  arb_div(out, out, &v->E, g->prec);
}

/* g->slope = (N_k E - (N + side sin a) D_k) / E^2 over the box. */
static void slope_set(sight *g, int k, int axis, int side) {
  const eye_values *v = &g->over;
  view_derive(&g->by[0], &g->by[1], &g->by[2], v, k, g->prec);
  view_value(g->slope, v, axis, side, g);
  arb_mul(g->slope, g->slope, &g->by[0], g->prec);
  arb_sub(g->slope, &g->by[1 + axis], g->slope, g->prec);
  arb_div(g->slope, g->slope, &v->E, g->prec);
}

/* Grows the end by the least (side < 0) or greatest value of one image coordinate over the piece [SPH-2]: at an end of
 * each variable where the slope by it has one sign, else at its middle, and the slope times its half-width off. */
static void piece_bound(sight *g, const variable_box *p, int axis, int side) {
  DYD_LOCAL_ARRAY(arb_struct, at, [VARIABLES]);
  arf_struct *end = &g->end[2 * axis + (side > 0)];
  DYD_LOCAL_NUMBERS(mag, off, more);
  for (int k = 0; k < VARIABLES; k++) {
    arb_set(at + k, &p->mid[k]);
    if (mag_is_zero(&p->half[k])) continue;
    slope_set(g, k, axis, side);
    int way = arb_is_positive(g->slope) - arb_is_negative(g->slope);
    arb_get_mag(more, g->slope);
    if (!way) mag_addmul(off, more, &p->half[k]);
    arf_set_mag(arb_midref(g->slope), &p->half[k]);
    mag_zero(arb_radref(g->slope));
    arb_addmul_si(at + k, g->slope, way * side, g->prec);
  }
  view_set(&g->at, at, at + 1, at + 2, g);
  view_value(g->number, &g->at, axis, side, g);
  mag_add(arb_radref(g->number), arb_radref(g->number), off);
  if (side < 0)
    arb_get_lbound_arf(g->limit, g->number, g->prec);
  else
    arb_get_ubound_arf(g->limit, g->number, g->prec);
  if (!g->any || arf_cmp(g->limit, end) * side > 0 || arf_is_nan(g->limit)) arf_set(end, g->limit);
}

static void piece_add(sight *g, const variable_box *p) {
  for (int axis = 0; axis < 2; axis++)
    for (int side = -1; side <= 1; side += 2) piece_bound(g, p, axis, side);
  g->any = true;
}

/* ---- pieces ---- */

/* Sets *step to how far places move by half the width of variable k, at most: longitudes move them by cos f as much as
 * latitudes do. So that they are narrow for a turn as well, no longitude is taken for shorter than the angle at which
 * places are seen from q, E >= least. */
static void piece_step(mag_t step, const sight *g, const variable_box *p, int k, const mag_t least) {
  mag_set(step, &p->half[k]);
  if (k) return;
  DYD_LOCAL_NUMBERS(mag, across);
  mag_mul_2exp_si(across, least, -1);
  mag_sqrt(across, across);
  arb_get_mag(step, &g->over.cf);
  mag_max(step, step, across);
  mag_mul(step, step, &p->half[0]);
}

/* Sets the view over the box. Returns true if the box is narrow for its distance from q, E > 2^8 step^2. *widest: the
 * variable to be cut, that of the longest step. */
static bool piece_is_narrow(int *widest, sight *g, const variable_box *p) {
  DYD_LOCAL_ARRAY(arb_struct, box, [VARIABLES]);
  DYD_LOCAL_NUMBERS(mag, least, most, step);
  for (int k = 0; k < VARIABLES; k++) {
    arb_set(box + k, &p->mid[k]);
    arb_add_error_mag(box + k, &p->half[k]);
  }
  view_set(&g->over, box, box + 1, box + 2, g);
  arb_get_mag_lower(least, &g->over.E);
  *widest = 0;
  for (int k = 0; k < VARIABLES; k++) {
    piece_step(step, g, p, k, least);
    if (mag_cmp(step, most) > 0) *widest = k;
    mag_max(most, most, step);
  }
  mag_mul(most, most, most);
  mag_mul_2exp_si(most, most, 8);
  return arb_is_positive(&g->over.E) && mag_cmp(most, least) <= 0;
}

static void variable_box_init(variable_box *p) {
  for (int k = 0; k < VARIABLES; k++) {
    arb_init(&p->mid[k]);
    mag_init(&p->half[k]);
  }
}

static void variable_box_clear(variable_box *p) {
  for (int k = 0; k < VARIABLES; k++) {
    arb_clear(&p->mid[k]);
    mag_clear(&p->half[k]);
  }
}

/* *out is one half of p, across variable k. */
static void piece_cut(variable_box *out, const variable_box *p, int k, int side, slong prec) {
  DYD_LOCAL_NUMBERS(arb, move);
  for (int j = 0; j < VARIABLES; j++) {
    arb_set(&out->mid[j], &p->mid[j]);
    mag_set(&out->half[j], &p->half[j]);
  }
  mag_mul_2exp_si(&out->half[k], &out->half[k], -1);
  arf_set_mag(arb_midref(move), &out->half[k]);
  arb_mul_si(move, move, side, prec);
  arb_add(&out->mid[k], &out->mid[k], move, prec);
}

/* Cut across the widest variable, a piece MOST_DEPTH cuts deep is as thin as 2^-64 of the whole: near the centre none
 * is narrow. */
static bool sight_cover(sight *g, const variable_box *all, int depth) {
  int widest;
  if (!g->wide || piece_is_narrow(&widest, g, all)) {
    view_set(&g->at, &all->mid[0], &all->mid[1], &all->mid[2], g);
    if (!arb_is_positive(&g->at.E)) return false;
    piece_add(g, all);
    return true;
  }
  if (++g->pieces > MOST_PIECES || depth == MOST_DEPTH || dyd_flag_is_set(g->stop)) return false;
  DYD_LOCAL(variable_box, p);
  piece_cut(&p, all, widest, -1, g->prec);
  bool good = sight_cover(g, &p, depth + 1);
  if (good) piece_cut(&p, all, widest, 1, g->prec);
  return good && sight_cover(g, &p, depth + 1);
}

/* ---- the image ---- */

/* out = q degrees in radians, half: upper bound of h degrees. */
static void radians(arb_t out, mag_t half, mpq_srcptr q, mpq_srcptr h, slong prec) {
  DYD_LOCAL_ARRAY(arb_struct, pi, [2]);
  arb_ptr t = pi + 1;
  arb_const_pi(pi, prec);
  arb_div_ui(pi, pi, 180, prec);
  dyd_ball_set_q(out, q, prec);
  arb_mul(out, out, pi, prec);
  dyd_ball_set_q(t, h, MAG_BITS + 2);
  arb_mul(t, t, pi, MAG_BITS + 2);
  arb_get_mag(half, t);
}

static void sight_init(sight *g, mpq_srcptr angle, slong prec) {
  arb_init(g->size);
  arb_init(g->lost);
  arb_init(g->slope);
  arb_init(g->number);
  arf_init(g->limit);
  eye_values_init(&g->at);
  eye_values_init(&g->over);
  for (int k = 0; k < 3; k++) arb_init(&g->by[k]);
  for (int k = 0; k < 4; k++) arf_init(&g->end[k]);
  g->prec = prec;
  g->pieces = 0;
  g->any = false;
  if (mpq_sgn(angle) == 0) return;
  dyd_ball_set_q(g->size, angle, prec);
  arb_mul_2exp_si(g->lost, g->size, -1);
  arb_sin(g->size, g->size, prec);
  arb_sin(g->lost, g->lost, prec);
  arb_sqr(g->lost, g->lost, prec);
  arb_mul_2exp_si(g->lost, g->lost, 1);
}

static void sight_clear(sight *g) {
  for (int k = 0; k < 4; k++) arf_clear(&g->end[k]);
  for (int k = 0; k < 3; k++) arb_clear(&g->by[k]);
  eye_values_clear(&g->over);
  eye_values_clear(&g->at);
  arf_clear(g->limit);
  arb_clear(g->number);
  arb_clear(g->slope);
  arb_clear(g->lost);
  arb_clear(g->size);
}

/* The variables: longitudes enter by their difference, which is taken before anything is rounded. */
static void piece_set(variable_box *p, const dyd_spot *s, const dyd_spot *q, slong prec) {
  DYD_LOCAL_NUMBERS(mpq, mid, half);
  mpq_sub(mid, s->mid[0], q->mid[0]);
  mpq_add(half, s->half[0], q->half[0]);
  radians(&p->mid[0], &p->half[0], mid, half, prec);
  radians(&p->mid[1], &p->half[1], s->mid[1], s->half[1], prec);
  radians(&p->mid[2], &p->half[2], q->mid[1], q->half[1], prec);
}

/* ---- exact places ---- */

void dyd_eye_init(dyd_eye *e) {
  dyd_spot_init(&e->spot);
  for (arb_ptr b = &e->unit; b < &e->unit + DYD_EYE_BALLS; b++) arb_init(b);
  e->prec = 0;
  e->stop = NULL;
}

void dyd_eye_clear(dyd_eye *e) {
  for (arb_ptr b = &e->unit; b < &e->unit + DYD_EYE_BALLS; b++) arb_clear(b);
  dyd_spot_clear(&e->spot);
}

static void eye_prepare(dyd_eye *e, slong prec) {
  if (e->prec == prec) return;
  e->prec = prec;
  arb_const_pi(&e->unit, prec);
  arb_div_ui(&e->unit, &e->unit, 360, prec);
  dyd_ball_set_q(&e->lon, e->spot.mid[0], prec);
  dyd_ball_set_q(&e->lat, e->spot.mid[1], prec);
  arb_div_ui(&e->sin, &e->lat, 180, prec);
  arb_sin_cos_pi(&e->sin, &e->cos, &e->sin, prec);
}

dyd_iv dyd_ball_ends(arb_srcptr x) {
  DYD_LOCAL_NUMBERS(arf, end);
  arb_get_lbound_arf(end, x, EYE_BITS);
  double lo = arf_get_d(end, ARF_RND_FLOOR);
  arb_get_ubound_arf(end, x, EYE_BITS);
  double hi = arf_get_d(end, ARF_RND_CEIL);
  return (dyd_iv){lo, hi};
}

void dyd_eye_enclose(dyd_eye_d *out, dyd_eye *e) {
  eye_prepare(e, EYE_BITS);
  *out = (dyd_eye_d){dyd_ball_ends(&e->lon), dyd_ball_ends(&e->lat), dyd_ball_ends(&e->sin), dyd_ball_ends(&e->cos)};
}

/* Of one place in balls of degrees, seen from an exact place: three sines at half the angles. */
static bool project_degrees(arb_ptr x, arb_ptr y, arb_srcptr lon, arb_srcptr lat, dyd_eye *e, slong prec) {
  DYD_LOCAL_ARRAY(arb_struct, f, [3]);
  arb_ptr D = f + 1, w = f + 2;
  eye_prepare(e, prec);
  arb_sub(w, lon, &e->lon, prec);
  arb_mul(w, w, &e->unit, prec);
  arb_sin_cos(w, x, w, prec);
  arb_sub(D, lat, &e->lat, prec);
  arb_mul(D, D, &e->unit, prec);
  arb_sin_cos(D, y, D, prec);
  arb_mul(f, lat, &e->unit, prec);
  arb_mul_2exp_si(f, f, 1);
  arb_cos(f, f, prec);
  arb_mul(f, f, w, prec); /* cos f sin(d/2) */
  arb_mul(x, x, f, prec);
  arb_mul(w, f, w, prec); /* cos f sin^2(d/2) */
  arb_mul(y, y, D, prec);
  arb_addmul(y, &e->sin, w, prec);
  arb_sqr(D, D, prec);
  arb_addmul(D, &e->cos, w, prec);
  bool good = arb_is_positive(D);
  if (good) arb_div(x, x, D, prec);
  if (good) arb_div(y, y, D, prec);
  return good;
}

static bool project_exact(arb_ptr x, arb_ptr y, const dyd_spot *s, dyd_eye *e, slong prec) {
  DYD_LOCAL_ARRAY(arb_struct, lon, [2]);
  arb_ptr lat = lon + 1;
  dyd_ball_set_q(lon, s->mid[0], prec);
  dyd_ball_set_q(lat, s->mid[1], prec);
  return project_degrees(x, y, lon, lat, e, prec);
}

static bool project_sight(arb_ptr x, arb_ptr y, const dyd_spot *s, dyd_eye *e, slong prec) {
  DYD_SCOPED(sight) g;
  sight_init(&g, s->angle, prec);
  DYD_LOCAL(variable_box, p);
  piece_set(&p, s, &e->spot, prec);
  g.stop = e->stop;
  g.wide = false;
  for (int k = 0; k < VARIABLES; k++) g.wide = g.wide || !mag_is_zero(&p.half[k]);
  bool good = sight_cover(&g, &p, 0);
  if (good) {
    arb_set_interval_arf(x, &g.end[0], &g.end[1], prec);
    arb_set_interval_arf(y, &g.end[2], &g.end[3], prec);
    good = arb_is_finite(x) && arb_is_finite(y);
  }
  return good;
}

/* Sets out to a disc about a pole that holds s, a region of all longitudes: its angle is that of s and
 * 174532925199432958 / 10^19 > pi / 180 for each degree of latitude. As a box it would be cut into many pieces. Returns
 * false if s does not reach a pole. */
static bool spot_about_pole(dyd_spot *out, const dyd_spot *s) {
  mpq_abs(out->mid[1], s->mid[1]);
  mpq_add(out->mid[1], out->mid[1], s->half[1]);
  if (mpq_cmp_si(s->half[0], 180, 1) < 0 || mpq_cmp_si(out->mid[1], 90, 1) != 0) return false;
  mpq_set_si(out->mid[1], 90 * mpq_sgn(s->mid[1]), 1);
  mpq_set_ui(out->angle, 174532925199432958, 10000000000000000000u);
  mpq_canonicalize(out->angle);
  mpq_mul(out->angle, out->angle, s->half[1]);
  mpq_mul_2exp(out->angle, out->angle, 1);
  mpq_add(out->angle, out->angle, s->angle);
  return mpq_cmp_si(out->angle, 1, 1) <= 0;
}

bool dyd_project(arb_ptr x, arb_ptr y, const dyd_spot *s, dyd_eye *e, slong prec) {
  if (dyd_spot_is_exact(s) && dyd_spot_is_exact(&e->spot)) return project_exact(x, y, s, e, prec);
  DYD_LOCAL(dyd_spot, disc);
  return project_sight(x, y, spot_about_pole(&disc, s) ? &disc : s, e, prec);
}

/* ---- what the engine of images asks for ---- */

/* A request is a width of the image; the widths of place and centre that it takes, and the bits of the computation, are
 * found by trying: missing bits are added. Images of wide places, or seen from a wide centre, or of
 * circles, stay wide; they are final once their place and centre are, or are narrow next to the wide one. */
enum { GUARD = 64, SPARE = 8, TRIES = 12, WIDE_BITS = 128 };

/* A request for an image. */
typedef struct image_wish {
  int64_t bits, max_bits;
  const volatile int *stop; /* as in dyd_request */
} image_wish;

static dyd_status place_narrow(const dyd_sphere *s, uint32_t i, const image_wish *w, dyd_error *err) {
  if (dyd_sphere_is_fixed(s, i)) return DYD_OK;
  dyd_status st = dyd_stream_narrow_until(s->stream[i], w->bits, w->max_bits, w->stop, err);
  return st == DYD_CANCELLED || dyd_failed(st) ? st : DYD_OK;
}

/* The centre, at least so narrow; a box. */
static dyd_status centre_narrow(dyd_sphere *s, const image_wish *w, dyd_error *err) {
  if (s->eye_bits >= w->bits) return DYD_OK;
  dyd_status st = place_narrow(s, s->centre, w, err);
  if (st == DYD_OK) st = dyd_sphere_spot(&s->eye.spot, s, s->centre, err);
  if (st != DYD_OK) return st;
  dyd_spot_box(&s->eye.spot);
  s->eye.prec = 0;
  s->eye_bits = dyd_sphere_is_fixed(s, s->centre) ? INT64_MAX : w->bits;
  return DYD_OK;
}

/* One image on its way. */
typedef struct image {
  dyd_sphere *s;
  uint32_t i;
  dyd_spot spot;
  arb_t x, y;
  bool moving, wide; /* a stream is concerned; something stays wide whatever is asked */
} image;

static slong image_width(const image *m) {
  slong x = dyd_ball_radius_exponent(m->x), y = dyd_ball_radius_exponent(m->y);
  return x > y ? x : y;
}

/* One try; *seen: place and centre are apart. */
static dyd_status image_try(bool *seen, image *m, const image_wish *w, dyd_error *err) {
  dyd_sphere *s = m->s;
  dyd_status st = place_narrow(s, m->i, w, err);
  const bool placed = st == DYD_OK;
  if (placed) st = centre_narrow(s, w, err);
  s->centre_failed = placed && dyd_failed(st);
  if (st == DYD_OK) st = dyd_sphere_spot(&m->spot, s, m->i, err);
  if (st != DYD_OK) return st;
  m->wide = m->spot.stays || s->eye.spot.stays;
  m->moving = !dyd_sphere_is_fixed(s, m->i) || s->eye_bits != INT64_MAX;
  slong prec = (slong)(w->bits < WIDE_BITS && m->wide ? WIDE_BITS : w->bits) + SPARE;
  s->eye.stop = w->stop;
  *seen = dyd_project(m->x, m->y, &m->spot, &s->eye, prec < GUARD ? GUARD : prec);
  return dyd_flag_is_set(w->stop) ? DYD_CANCELLED : DYD_OK;
}

static dyd_status image_fail(const image *m, dyd_error *err) {
  if (m->s->free)
    return dyd_fail(err, DYD_E_DOMAIN,
                    "it may be nearly anywhere, and no place of the sphere is apart from all points; give a smaller "
                    "radius, or `merge` where points that meet are one place");
  return dyd_fail(
      err, DYD_E_DOMAIN,
      "it cannot be distinguished from point %zu, from which the sphere is projected; narrow one of them, or give "
      "`merge` where both are one place",
      dyd_engine_row(m->s->places, m->s->centre));
}

/* Tries until the image is as narrow as asked for; or will not be, as the part that stays wide is wide compared with
 * the part that moves; or max_bits are reached. */
static dyd_status image_find(image *m, const image_wish *w, dyd_error *err) {
  int64_t more = SPARE, most = (w->max_bits > w->bits ? w->max_bits : w->bits) + GUARD;
  bool seen = false;
  for (int k = 0; k < TRIES; k++) {
    image_wish now = {w->bits + more < most ? w->bits + more : most, most, w->stop};
    dyd_status st = image_try(&seen, m, &now, err);
    if (st != DYD_OK) return st;
    if (seen && image_width(m) <= -w->bits - 2) return DYD_OK;
    if (now.bits == most || (m->wide && (!m->moving || k > 1))) break;
    more += seen ? image_width(m) + w->bits + SPARE : GUARD << k;
  }
  return seen ? DYD_OK : image_fail(m, err);
}

/* Rounds outward and intersects with the image before. */
static dyd_status image_give(dyd_rect *out, const image *m, bool known, int64_t bits) {
  slong width = image_width(m) - 16;
  int64_t grid = m->wide && width > -bits - 2 - GUARD ? width : -bits - 2;
  DYD_LOCAL(dyd_rect, now);
  dyd_status st = dyd_ball_interval(&now.x, m->x, grid);
  if (st == DYD_OK) st = dyd_ball_interval(&now.y, m->y, grid);
  if (st == DYD_OK && known) st = dyd_interval_intersect(&now.x, &now.x, &out->x);
  if (st == DYD_OK && known) st = dyd_interval_intersect(&now.y, &now.y, &out->y);
  if (st == DYD_OK) dyd_rect_swap(out, &now);
  return st;
}

static void image_init(image *m, dyd_sphere *s, uint32_t i) {
  *m = (image){.s = s, .i = i};
  dyd_spot_init(&m->spot);
  arb_init(m->x);
  arb_init(m->y);
}

static void image_clear(image *m) {
  arb_clear(m->y);
  arb_clear(m->x);
  dyd_spot_clear(&m->spot);
}

static dyd_status image_request(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_sphere *s = user;
  DYD_SCOPED(image) m;
  image_init(&m, s, s->of[request->point]);
  dyd_status st = image_find(&m, &(image_wish){request->bits, request->max_bits, request->stop}, err);
  if (st == DYD_OK) st = image_give(out, &m, dyd_engine_knows(s->images, (uint32_t)request->point), request->bits);
  if (st == DYD_OK && m.wide && (!m.moving || request->bits >= WIDE_BITS)) st = DYD_FIXED;
  return st;
}

/* Projects the middle of the centre's region, where it has one, or else all of the eye as it is. */
static bool place_project(image *m, slong prec) {
  dyd_sphere *s = m->s;
  if (s->free || !dyd_sphere_is_fixed(s, s->centre)) return dyd_project(m->x, m->y, &m->spot, &s->eye, prec);
  DYD_LOCAL(dyd_eye, eye);
  bool seen = dyd_sphere_spot(&eye.spot, s, s->centre, NULL) == DYD_OK;
  if (seen) dyd_spot_choose(&eye.spot, 0);
  return seen && dyd_project(m->x, m->y, &m->spot, &eye, prec);
}

dyd_status dyd_sphere_place_at(dyd_rect *out, void *user, const dyd_site_place *at) {
  enum { PREC = 256 };
  dyd_sphere *s = user;
  DYD_SCOPED(image) m;
  image_init(&m, s, s->of[at->site]);
  dyd_status st = dyd_sphere_spot(&m.spot, s, m.i, NULL);
  if (st == DYD_OK && m.spot.stays && dyd_sphere_is_fixed(s, m.i)) dyd_spot_choose(&m.spot, at->place);
  if (st == DYD_OK && place_project(&m, PREC)) st = image_give(out, &m, false, PREC / 2);
  return st;
}

dyd_status dyd_sphere_blame(const dyd_sphere *s, dyd_status st, dyd_error *err) {
  if (dyd_failed(st) && err && err->point < s->with_image)
    err->point = s->centre_failed ? s->centre : s->of[err->point];
  return st;
}

/* An image that is known without its source having been asked may be narrower than its place would have it. */
dyd_status dyd_sphere_narrow_recalled(dyd_sphere *s, int64_t max_bits, dyd_error *err) {
  dyd_status st = DYD_OK;
  image m;
  for (uint32_t k = 0; k < s->with_image && st == DYD_OK; k++) {
    if (dyd_sphere_is_fixed(s, s->of[k])) continue;
    const dyd_refinable *p = dyd_engine_find(s->images, k);
    if (!p || !p->measured) continue;
    image_init(&m, s, s->of[k]);
    st = image_find(&m, &(image_wish){p->bits, max_bits, NULL}, err);
    if (st != DYD_OK && err) err->point = k;
    image_clear(&m);
  }
  return dyd_sphere_blame(s, st, err);
}

/* ---- a first look ---- */

/* The centre in doubles, where it is an exact place. */
static bool eye_glance(dyd_eye_d *out, dyd_sphere *s) {
  if (!s->free && !dyd_sphere_is_fixed(s, s->centre)) return false;
  if (centre_narrow(s, &(image_wish){0, 0, NULL}, NULL) != DYD_OK || !dyd_spot_is_exact(&s->eye.spot)) return false;
  dyd_eye_enclose(out, &s->eye);
  return true;
}

/* Doubles give the image of an exact place to some 45 bits, that of a wide one to fewer: returns false where they do
 * not give the bits requested. */
static bool image_glance(double box[4], void *user, size_t point, int64_t bits) {
  dyd_sphere *s = user;
  dyd_spot_d place;
  if (!dyd_sphere_is_fixed(s, s->of[point])) return false;
  if (dyd_sphere_spot_d(&place, s, s->of[point], NULL) != DYD_OK) return false;
  return dyd_filter_image(box, &place, &s->eye_d, bits);
}

dyd_status dyd_sphere_add_images(dyd_sphere *s, dyd_error *err) {
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = image_request, .user = s};
  if (!s->with_image) return DYD_OK;
  dyd_status st = dyd_engine_add_source(s->images, s->with_image, &source, err);
  if (st == DYD_OK && eye_glance(&s->eye_d, s)) dyd_engine_set_glance(s->images, image_glance);
  return st;
}
