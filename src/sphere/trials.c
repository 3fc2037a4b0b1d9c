/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plans on the sphere tried on drawn places. */
#include "base/local.h"
#include "tolerance/survey.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/random.h"
#include "engine/labels.h"
#include "sphere/state.h"
#include "stream/ball.h"
#include "tolerance/lines.h"

enum { PREC = 96 };

typedef struct globe_trials {
  dyd_sphere *s;
  const char *accuracy;
  dyd_survey_options options; /* of the plans after the first one */
} globe_trials;

/* now, places: the regions so far (NULL: those of `of`); needed: metres of each place in the plan followed, else 0. */
typedef struct globe_draw {
  const globe_trials *of;
  uint64_t seed;
  dyd_engine *places;
  dyd_sphere *now;
  double *needed;
} globe_draw;

static dyd_status globe_begin(void **draw, const dyd_trials *t, uint64_t seed) {
  globe_draw *d = calloc(1, sizeof *d);
  if (!d) return DYD_E_NOMEM;
  *draw = d;
  d->of = t->user;
  d->seed = seed;
  d->needed = calloc(t->sites + 1, sizeof *d->needed);
  return d->needed ? DYD_OK : DYD_E_NOMEM;
}

static void globe_end(void *draw) {
  globe_draw *d = draw;
  dyd_sphere_free(d->now);
  dyd_engine_free(d->places);
  dyd_free_all(d->needed, d);
}

/* Sets u, v to a place in the unit disc about 0. */
static void disc_draw(mpq_ptr u, mpq_ptr v, uint64_t seed) {
  uint64_t k = 0;
  DYD_LOCAL_NUMBERS(mpq, sum, part);
  do {
    for (int a = 0; a < 2; a++) {
      mpq_ptr at = a ? v : u;
      dyd_trial_draw(at, seed, k++);
      mpq_mul_2exp(at, at, 1);
      mpz_sub(mpq_numref(at), mpq_numref(at), mpq_denref(at));
    }
    mpq_mul(sum, u, u);
    mpq_mul(part, v, v);
    mpq_add(sum, sum, part);
  } while (mpq_cmp_ui(sum, 1, 1) >= 0);
}

/* Moves the place (at[0], at[1]), degrees, to (u, v) of the disc of this angle about it: eastward, northward. */
static void place_move(double at[2], mpq_srcptr angle, mpq_srcptr u, mpq_srcptr v) {
  DYD_LOCAL_ARRAY(arb_struct, x, [10]);
  arb_ptr lon = x, lat = x + 1, east = x + 2, north = x + 3, far = x + 4, sf = x + 5, cf = x + 6, sd = x + 7,
          cd = x + 8, t = x + 9;
  arb_set_d(lat, at[1] / 180);
  arb_sin_cos_pi(sf, cf, lat, PREC);
  dyd_ball_set_q(east, u, PREC);
  dyd_ball_set_q(north, v, PREC);
  arb_hypot(far, east, north, PREC);
  arb_div(east, east, far, PREC);
  arb_div(north, north, far, PREC);
  dyd_ball_set_q(t, angle, PREC);
  arb_mul(far, far, t, PREC);
  arb_sin_cos(sd, cd, far, PREC);
  arb_mul(lat, cf, sd, PREC);
  arb_mul(lat, lat, north, PREC);
  arb_addmul(lat, sf, cd, PREC); /* the sine */
  arb_mul(lon, sf, lat, PREC);
  arb_sub(lon, cd, lon, PREC);
  arb_mul(t, east, sd, PREC);
  arb_mul(t, t, cf, PREC);
  arb_atan2(lon, t, lon, PREC);
  arb_asin(lat, lat, PREC);
  arb_const_pi(t, PREC);
  for (int a = 0; a < 2; a++) {
    arb_div(x + a, x + a, t, PREC);
    arb_mul_ui(x + a, x + a, 180, PREC);
  }
  at[0] += arf_get_d(arb_midref(lon), ARF_RND_NEAR);
  at[1] = arf_get_d(arb_midref(lat), ARF_RND_NEAR);
}

/* at: the true place of i, in degrees. */
static dyd_status globe_truth(double at[2], const globe_draw *d, uint32_t i) {
  const uint64_t own = dyd_random(d->seed, i);
  DYD_LOCAL(dyd_spot, spot);
  DYD_LOCAL_ARRAY(mpq_t, u, [2]);
  dyd_status st = dyd_sphere_spot(&spot, d->of->s, i, NULL);
  for (int a = 0; a < 2; a++) {
    dyd_trial_draw(u[a], dyd_random(own, 1), (uint64_t)a);
    mpq_mul_2exp(u[a], u[a], 1);
    mpz_sub(mpq_numref(u[a]), mpq_numref(u[a]), mpq_denref(u[a]));
    mpq_mul(u[a], u[a], spot.half[a]);
    mpq_add(u[a], u[a], spot.mid[a]);
    at[a] = mpq_get_d(u[a]);
  }
  disc_draw(u[0], u[1], dyd_random(own, 2));
  if (mpq_sgn(spot.angle)) place_move(at, spot.angle, u[0], u[1]);
  return st;
}

/* The region of place i as it is, or as it was measured, as a rectangle and metres about it. */
static dyd_status globe_region(dyd_rect *out, double *metres, const globe_draw *d, uint32_t i) {
  const dyd_sphere *s = d->now ? d->now : d->of->s;
  double at[2];
  *metres = d->needed[i];
  if (*metres > 0) {
    dyd_status st = globe_truth(at, d, i);
    return st == DYD_OK ? dyd_rect_set_d(out, at[0], at[0], at[1], at[1]) : st;
  }
  DYD_LOCAL(dyd_spot, spot);
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_status st = dyd_sphere_spot(&spot, s, i, NULL);
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    mpq_sub(lo, spot.mid[a], spot.half[a]);
    mpq_add(hi, spot.mid[a], spot.half[a]);
    st = mpq_equal(lo, hi) ? dyd_interval_set_q(a ? &out->y : &out->x, lo)
                           : dyd_interval_set_outward(a ? &out->y : &out->x, lo, hi, -256);
  }
  mpq_div(lo, spot.angle, s->metre);
  *metres = dyd_q_double(lo, 1);
  return st;
}

static dyd_status globe_add(dyd_engine *e, const globe_draw *d, size_t sites, dyd_error *err) {
  DYD_SCOPED(dyd_labels) labels = {0};
  dyd_row_numbers own = dyd_no_row_numbers;
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = DYD_OK;
  for (uint32_t i = 0; i < sites && st == DYD_OK; i++) {
    st = globe_region(&r, &own.of[DYD_ROW_RADIUS], d, i);
    if (st == DYD_OK) st = dyd_engine_add_rect(e, &r, err);
    if (st == DYD_OK && !dyd_labels_add(&labels, NULL, 0, &own)) st = DYD_E_NOMEM;
  }
  if (st == DYD_OK) dyd_labels_give(e, &labels);
  return st;
}

static dyd_status globe_step(dyd_survey **next, void *draw, const dyd_trials *t, const dyd_survey *plan,
                             dyd_error *err) {
  globe_draw *d = draw;
  const dyd_survey_row *row;
  const size_t rows = dyd_survey_rows(&row, plan);
  dyd_engine *places = NULL;
  dyd_sphere *then = NULL;
  dyd_outcome outcome;
  dyd_engine_options o;
  dyd_survey_options how = d->of->options;
  dyd_engine_options_init(&o);
  o.start_bits = 0;
  for (size_t k = 0; k < rows; k++) d->needed[row[k].site] = row[k].needed;
  dyd_status st = dyd_engine_new(&places);
  if (st == DYD_OK) st = globe_add(places, d, t->sites, err);
  for (size_t k = 0; k < rows; k++) d->needed[row[k].site] = 0;
  if (st == DYD_OK) st = dyd_sphere_new(&then, places, NULL, err);
  if (st != DYD_OK) {
    dyd_engine_free(places);
    return st;
  }
  dyd_sphere_free(d->now);
  dyd_engine_free(d->places);
  d->now = then;
  d->places = places;
  how.pairs = &t->asked;
  st = dyd_sphere_run(&outcome, then, &o, err);
  return st == DYD_OK ? dyd_sphere_survey(next, then, d->of->accuracy, &how, err) : st;
}

dyd_status dyd_sphere_simulate(dyd_survey_trial *out, dyd_sphere *s, size_t count, uint64_t seed, const char *accuracy,
                               const dyd_survey_options *options, dyd_error *err) {
  if (!s || (count && !out)) return dyd_fail_null(err);
  globe_trials p = {.s = s, .accuracy = accuracy};
  dyd_survey *first = NULL;
  for (size_t k = 0; k < count; k++) out[k] = (dyd_survey_trial){0};
  dyd_status st = dyd_abi_take(&p.options, sizeof p.options, options, "dyd_survey_options", err);
  if (st == DYD_OK) st = dyd_sphere_survey(&first, s, accuracy, &p.options, err);
  p.options.site = NULL;
  dyd_trials t = {.out = out,
                  .count = count,
                  .seed = seed,
                  .first = first,
                  .sites = s->count,
                  .cancel = p.options.cancel,
                  .begin = globe_begin,
                  .step = globe_step,
                  .end = globe_end,
                  .user = &p};
  if (st == DYD_OK) st = dyd_trials_run(&t, 1, err); /* FLINT keeps memory of each thread */
  dyd_survey_free(first);
  return st;
}
