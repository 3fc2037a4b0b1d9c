/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Life of a sphere: places and streams of an engine, the engine of images. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include "engine/points.h"
#include "engine/ties.h"
#include "sphere/state.h"
#include "sphere/units.h"
#include <dyadel/io.h>
#include <string.h>

enum { FIRST_BITS = 32, START_BITS = 40 };

/* ---- places ---- */

static dyd_status streams_take(dyd_sphere *s, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (uint32_t i = 0; i < s->count && st == DYD_OK; i++) {
    if (!dyd_engine_find(s->places, i)) continue;
    if (!s->stream) s->stream = calloc(s->count, sizeof(dyd_stream *));
    st = s->stream ? dyd_engine_stream(&s->stream[i], s->places, i) : DYD_E_NOMEM;
    if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
    st = dyd_stream_narrow(s->stream[i], FIRST_BITS, FIRST_BITS, err);
    if (dyd_failed(st) && err) err->point = i;
    if (st == DYD_FIXED) st = DYD_OK;
  }
  return st;
}

/* ---- images ---- */

/* Points of the engine of images are called by the rows of their places. */
static dyd_status images_label(const dyd_sphere *s) {
  dyd_labels labels = {0};
  bool good = true;
  for (size_t k = 0; k < s->with_image && good; k++) {
    const char *id = dyd_engine_id(s->places, s->of[k]);
    dyd_row_numbers own = dyd_no_row_numbers;
    own.of[DYD_ROW_COST] = dyd_engine_number(s->places, s->of[k], DYD_ROW_COST);
    labels.rows = dyd_engine_row(s->places, s->of[k]);
    good = dyd_labels_add(&labels, id, id ? strlen(id) : 0, &own);
  }
  if (good)
    dyd_labels_give(s->images, &labels);
  else
    dyd_labels_clear(&labels);
  return good ? DYD_OK : DYD_E_NOMEM;
}

static dyd_status images_make(dyd_sphere *s, dyd_error *err) {
  s->of = dyd_alloc(s->count, sizeof *s->of);
  if (!s->of) return dyd_fail_nomem(err);
  for (uint32_t i = 0; i < s->count; i++)
    if (s->alias[i] == i && i != s->centre) s->of[s->with_image++] = i;
  dyd_status st = dyd_sphere_add_images(s, err);
  if (st != DYD_OK) return st;
  dyd_engine_set_prover(s->images, dyd_sphere_prove, s);
  return images_label(s) == DYD_OK ? DYD_OK : dyd_fail_nomem(err);
}

/* ---- life ---- */

static dyd_status radius_refuse(const char *text, const char *what, dyd_error *err) {
  return dyd_fail(err, DYD_E_ARG, "the radius \"%.60s\" %s", text, what);
}

static dyd_status radius_take(mpq_ptr radius, bool *ground, const dyd_sphere_options *o, mpq_t scale, dyd_error *err) {
  const dyd_unit *unit = NULL;
  mpq_set_ui(scale, 1, 1);
  dyd_status st = dyd_unit_take(&unit, scale, o->radius_unit, o->radius_scale, err);
  if (st != DYD_OK || !o->radius) return st;
  st = dyd_radius_parse(radius, ground, o->radius, strlen(o->radius), unit);
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st == DYD_E_DOMAIN)
    return radius_refuse(o->radius, "has no unit; state a unit: `radius_unit` m (" DYD_UNIT_NAMES ")", err);
  if (st != DYD_OK)
    return radius_refuse(o->radius, "is not an exact number >= 0 and a unit; give one such as 30m, 2km or 0.01deg",
                         err);
  mpq_mul(radius, radius, scale);
  return DYD_OK;
}

dyd_status dyd_sphere_radius(mpq_ptr out, bool *ground, const dyd_sphere_options *o, dyd_error *err) {
  mpq_t scale;
  mpq_init(scale);
  mpq_set_ui(out, 0, 1);
  *ground = false;
  dyd_status st = radius_take(out, ground, o, scale, err);
  mpq_clear(scale);
  return st;
}

/* Metres are an angle, degrees stay degrees. */
static dyd_status radius_set(dyd_sphere *s, const dyd_sphere_options *o, dyd_error *err) {
  bool ground;
  dyd_status st = dyd_sphere_radius(s->degrees, &ground, o, err);
  if (st != DYD_OK || !ground) return st;
  mpq_swap(s->angle, s->degrees);
  mpq_mul(s->angle, s->angle, s->metre);
  if (mpq_cmp_si(s->angle, 1, 1) <= 0) return DYD_OK;
  return radius_refuse(o->radius, "is larger than that of the earth; give a smaller one", err);
}

/* Radians to a metre on the ground. */
static void metre_set(mpq_ptr out) {
  dyd_real_parse_exact(out, DYD_EARTH_RADIUS, sizeof DYD_EARTH_RADIUS - 1);
  mpq_inv(out, out);
}

static dyd_status centre_take(dyd_sphere *s, const dyd_sphere_options *o, dyd_error *err) {
  if (!s->count) return DYD_OK;
  if (!o->centre_set) return dyd_sphere_choose(s, err);
  if (o->centre >= s->count)
    return dyd_fail(err, DYD_E_ARG, "there is no point %lu to project from", (unsigned long)o->centre);
  s->centre = s->alias[o->centre];
  return DYD_OK;
}

static dyd_sphere *sphere_begin(dyd_engine *places) {
  dyd_sphere *s = calloc(1, sizeof *s);
  if (!s) return NULL;
  s->places = places;
  s->count = dyd_engine_count(places);
  s->eye_bits = INT64_MIN;
  mpq_inits(s->angle, s->degrees, s->metre, NULL);
  metre_set(s->metre);
  dyd_eye_init(&s->eye);
  s->alias = dyd_alloc(s->count, sizeof *s->alias);
  if (s->alias && dyd_engine_new(&s->images) == DYD_OK) return s;
  dyd_sphere_free(s);
  return NULL;
}

static dyd_status sphere_make(dyd_sphere *s, const dyd_sphere_options *o, dyd_error *err) {
  dyd_status st = radius_set(s, o, err);
  if (st == DYD_OK) st = streams_take(s, err);
  if (st == DYD_OK) st = dyd_sphere_find_aliases(s, err);
  if (st == DYD_OK) st = centre_take(s, o, err);
  return st == DYD_OK ? images_make(s, err) : st;
}

dyd_status dyd_sphere_new(dyd_sphere **out, dyd_engine *places, const dyd_sphere_options *options, dyd_error *err) {
  dyd_sphere_options o;
  if (err) dyd_error_clear(err);
  if (dyd_abi_take(&o, sizeof o, options, "dyd_sphere_options", err) != DYD_OK) return DYD_E_ARG;
  dyd_sphere *s = sphere_begin(places);
  if (!s) return dyd_fail_nomem(err);
  dyd_status st = sphere_make(s, &o, err);
  if (st == DYD_OK)
    *out = s;
  else
    dyd_sphere_free(s);
  return st;
}

void dyd_sphere_free(dyd_sphere *s) {
  if (!s) return;
  dyd_sphere_free(s->second);
  dyd_engine_free(s->images);
  for (size_t i = 0; s->stream && i < s->count; i++) dyd_stream_free(s->stream[i]);
  free(s->stream);
  free(s->of);
  free(s->alias);
  dyd_eye_clear(&s->eye);
  mpq_clears(s->angle, s->degrees, s->metre, NULL);
  free(s);
}

/* ---- what it is ---- */

dyd_engine *dyd_sphere_engine(dyd_sphere *s) {
  if (!s) return NULL;
  return s->images;
}

const dyd_engine *dyd_sphere_places(const dyd_sphere *s) {
  if (!s) return NULL;
  return s->places;
}

const dyd_engine *dyd_sphere_images(const dyd_sphere *s) {
  if (!s) return NULL;
  return s->images;
}

uint32_t dyd_sphere_centre(const dyd_sphere *s) {
  if (!s) return 0;
  return s->count ? s->centre : DYD_NO_PLACE;
}

uint32_t dyd_sphere_place(const dyd_sphere *s, uint32_t k) {
  if (!s) return 0;
  return k < s->with_image ? s->of[k] : DYD_NO_PLACE;
}

uint32_t dyd_sphere_alias(const dyd_sphere *s, uint32_t i) {
  if (!s) return 0;
  return i < s->count ? s->alias[i] : i;
}

/* ---- running ---- */

/* Those of places become those of their images. */
static double *costs_of_images(const dyd_sphere *s, const double *cost) {
  double *out = dyd_alloc(s->with_image, sizeof *out);
  for (size_t k = 0; out && k < s->with_image; k++) out[k] = cost[s->of[k]];
  return out;
}

/* [SPH-5] What is stated from one eye holds whatever is not known from another. A wide centre widens all images; from a
 * gap only the pairs about it are lost. So pairs that are indeterminate from the first are looked at from the second.
 */
static dyd_status second_make(dyd_sphere *s, dyd_error *err) {
  dyd_sphere *t = sphere_begin(s->places);
  if (!t) return dyd_fail_nomem(err);
  mpq_set(t->angle, s->angle);
  mpq_set(t->degrees, s->degrees);
  memcpy(t->alias, s->alias, s->count * sizeof *s->alias);
  dyd_status st = streams_take(t, err);
  if (st == DYD_OK) st = dyd_sphere_choose_gap(t, err);
  if (st == DYD_OK && t->free) st = images_make(t, err);
  if (st == DYD_OK && t->free)
    s->second = t;
  else
    dyd_sphere_free(t);
  return st;
}

/* With the time that is left. Where no image can be had from the gap, there is no second. */
static dyd_status second_run(dyd_outcome *outcome, dyd_sphere *s, const dyd_engine_options *options, double seconds,
                             dyd_error *err) {
  dyd_engine_options o = *options;
  dyd_status st = s->second ? DYD_OK : second_make(s, err);
  if (st != DYD_OK || !s->second) return st;
  if (o.seconds > 0) o.seconds = o.seconds > seconds ? o.seconds - seconds : 0x1p-20;
  o.cost = NULL;
  o.progress = NULL;
  o.trace = NULL;
  dyd_engine_follow(s->images, s->second->images);
  st = dyd_engine_run(outcome, s->second->images, &o, err);
  dyd_engine_follow(s->images, NULL);
  if (st == DYD_E_DOMAIN) {
    dyd_sphere_free(s->second);
    s->second = NULL;
    st = DYD_OK;
  }
  return st;
}

dyd_status dyd_sphere_run(dyd_outcome *outcome, dyd_sphere *s, const dyd_engine_options *options, dyd_error *err) {
  dyd_engine_options o;
  double *cost = NULL, begun = dyd_seconds();
  *outcome = DYD_OUTCOME_ERROR;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_engine_options", err) != DYD_OK) return DYD_E_ARG;
  if (o.cost && !(o.cost = cost = costs_of_images(s, o.cost))) return dyd_fail_nomem(err);
  if (!o.start_bits) o.start_bits = START_BITS;
  dyd_status st = dyd_engine_run(outcome, s->images, &o, err);
  free(cost);
  if (st == DYD_OK) st = dyd_sphere_narrow_recalled(s, o.max_bits, err);
  if (st == DYD_OK && *outcome == DYD_OUTCOME_FIXPOINT && s->eye.spot.stays)
    st = second_run(outcome, s, &o, dyd_seconds() - begun, err);
  if (st == DYD_OK) *outcome = dyd_sphere_outcome(s);
  return st;
}
