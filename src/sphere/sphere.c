/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A sphere: places and streams of an engine, the engine of images; statuses and triangles, by the numbers of the
 * places.
 *
 * [SPH-1] A circle on the sphere without the centre q inside goes to a circle in the plane with the same points inside;
 * one through q to a line, the side of the plane away from the former inside. So pairs of other places are as their
 * images are, half-planes included, and a pair with q is possible or certain as the image is a corner of the hull.
 * Where it is on the hull, but no corner, it is on a line with others: a tie where all that is open there are ties.
 *
 * [SPH-5] A centre that is not a place is one point more: a statement certain with it is certain without, and only
 * pairs of places that may be its neighbours become possible without it. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/index.h"
#include "base/local.h"
#include "delaunay/state.h"
#include "engine/points.h"
#include "rect/rect.h"
#include "sphere/state.h"
#include "sphere/units.h"

#include <dyadel/io.h>
#include <string.h>

/* MOST_ABOUT: neighbours of a centre that is not a place, whose pairs are listed. */
enum { FIRST_BITS = 32, START_BITS = 40, MOST_ABOUT = 4096 };

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
  s->images->prover = (dyd_prover){dyd_sphere_prove, dyd_sphere_prove_places, dyd_sphere_place_at, NULL, s};
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
  DYD_LOCAL_NUMBERS(mpq, scale);
  mpq_set_ui(out, 0, 1);
  *ground = false;
  return radius_take(out, ground, o, scale, err);
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
  if (st != DYD_OK || o->no_images) return st;
  st = centre_take(s, o, err);
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
  dyd_near_index_free(s->near);
  dyd_engine_free(s->images);
  for (size_t i = 0; s->stream && i < s->count; i++) dyd_stream_free(s->stream[i]);
  dyd_free_all(s->stream, s->of, s->alias);
  dyd_eye_clear(&s->eye);
  mpq_clears(s->angle, s->degrees, s->metre, NULL);
  free(s);
}

/* ---- its parts ---- */

dyd_engine *dyd_sphere_images(const dyd_sphere *s) {
  return s ? s->images : NULL;
}

const dyd_engine *dyd_sphere_places(const dyd_sphere *s) {
  return s ? s->places : NULL;
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

static dyd_status sphere_again(dyd_sphere **out, const dyd_sphere *s, dyd_error *err) {
  *out = sphere_begin(s->places);
  if (!*out) return dyd_fail_nomem(err);
  mpq_set((*out)->angle, s->angle);
  mpq_set((*out)->degrees, s->degrees);
  (*out)->within = s->within;
  memcpy((*out)->alias, s->alias, s->count * sizeof *s->alias);
  return streams_take(*out, err);
}

static dyd_status sphere_deliver(dyd_sphere **out, dyd_status st, bool wanted) {
  if (st == DYD_OK && wanted) return st;
  dyd_sphere_free(*out);
  *out = NULL;
  return st;
}

dyd_status dyd_sphere_new_gap(dyd_sphere **out, const dyd_sphere *other, dyd_error *err) {
  dyd_status st = sphere_again(out, other, err);
  if (st == DYD_OK) st = dyd_sphere_choose_gap(*out, other, err);
  return sphere_deliver(out, st, st == DYD_OK && (*out)->free);
}

dyd_status dyd_sphere_new_within(dyd_sphere **out, const dyd_sphere *s, const double *within, dyd_error *err) {
  dyd_status st = sphere_again(out, s, err);
  if (st == DYD_OK) (*out)->within = within;
  if (st == DYD_OK) st = dyd_sphere_find_aliases(*out, err);
  if (st == DYD_OK && s->count) st = dyd_sphere_choose(*out, err);
  if (st == DYD_OK) st = images_make(*out, err);
  return sphere_deliver(out, st, true);
}

/* Those of places become those of their images. */
static double *costs_of_images(const dyd_sphere *s, const double *cost) {
  double *out = dyd_alloc(s->with_image, sizeof *out);
  for (size_t k = 0; out && k < s->with_image; k++) out[k] = cost[s->of[k]];
  return out;
}

/* [SPH-5] A statement from one eye holds whatever is unknown from another. A wide centre widens all images, and a
 * region near any centre has a wide one; from a gap only the pairs about it are lost. So where there are regions, pairs
 * that are indeterminate from the first are examined from the second, a gap, and those around that from another one. */
static dyd_status second_make(dyd_sphere *s, dyd_error *err) {
  dyd_status st = dyd_sphere_new_gap(&s->second, s, err);
  return st == DYD_OK && s->second ? images_make(s->second, err) : st;
}

/* *wide: some place has a region that stays. */
static dyd_status regions_look(bool *wide, const dyd_sphere *s, dyd_error *err) {
  DYD_LOCAL(dyd_spot, spot);
  dyd_status st = DYD_OK;
  *wide = false;
  for (uint32_t i = 0; i < s->count && !*wide && st == DYD_OK; i++) {
    st = dyd_sphere_spot(&spot, s, i, err);
    *wide = spot.stays;
  }
  return st;
}

/* With the time that is left, since `begun`; a cancel of the first cancels it. Where images from the gap fail, the
 * second does not exist. */
static dyd_status second_run(dyd_sphere *s, dyd_sphere *first, const dyd_engine_options *options, double begun,
                             dyd_error *err) {
  dyd_engine_options o = *options;
  dyd_outcome outcome;
  dyd_status st = s->second ? DYD_OK : second_make(s, err);
  if (st != DYD_OK || !s->second) return st;
  if (o.seconds > 0) o.seconds = fmax(o.seconds - (dyd_seconds() - begun), 0x1p-20);
  o.cost = NULL;
  o.progress = NULL;
  o.trace = NULL;
  dyd_engine_follow(first->images, s->second->images);
  st = dyd_sphere_blame(s->second, dyd_engine_run(&outcome, s->second->images, &o, err), err);
  dyd_engine_follow(first->images, NULL);
  if (st == DYD_E_DOMAIN) {
    dyd_sphere_free(s->second);
    s->second = NULL;
    return DYD_OK;
  }
  if (st != DYD_OK || s->free || dyd_sphere_outcome(first) != DYD_OUTCOME_FIXPOINT) return st;
  return second_run(s->second, first, options, begun, err);
}

/* About a centre that is not a place: all that may be its neighbours. */
static dyd_status face_of_gap(dyd_index_list *face, bool *tie, const dyd_delaunay *pd) {
  dyd_hull hull = {0};
  *tie = false;
  dyd_status st = dyd_delaunay_partial_hull(&hull, pd, false);
  *face = hull.possible_vertices;
  dyd_index_list_clear(&hull.sure_vertices);
  return st;
}

/* Finds whether a pair around the centre, which is not a place, is open. */
static dyd_status gap_look(dyd_sphere *s) {
  DYD_SCOPED(dyd_index_list) face = {0};
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  bool tie, *in = calloc(s->count, sizeof *in);
  dyd_status st = in ? face_of_gap(&face, &tie, dyd_engine_delaunay(s->images)) : DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < face.count; k++) in[s->of[face.item[k]]] = true;
  if (st == DYD_OK) st = dyd_sphere_pairs(&pairs, s);
  s->gap_decided = st == DYD_OK;
  for (size_t k = 0; k < pairs.count && s->gap_decided; k++) {
    const dyd_pair *p = &pairs.item[k];
    s->gap_decided = p->status == DYD_LEGAL || !in[p->i] || !in[p->j];
  }
  free(in);
  return st;
}

static dyd_status second_look(dyd_sphere *s, const dyd_engine_options *options, double begun, dyd_error *err) {
  bool wide;
  dyd_status st = regions_look(&wide, s, err);
  if (st != DYD_OK || !(wide || s->free)) return st;
  st = second_run(s, s, options, begun, err);
  if (st != DYD_OK || !s->free || !s->second) return st;
  st = gap_look(s);
  return st < 0 ? dyd_fail(err, st, "%s", dyd_status_text(st)) : DYD_OK;
}

static dyd_status places_pairs(dyd_pair_list *out, void *user) {
  return dyd_sphere_pairs(out, user);
}

/* table: NULL, or takes the stages of the first eye. */
static dyd_status sphere_run(dyd_outcome *outcome, dyd_sphere *s, const dyd_engine_options *options,
                             dyd_convergence *table, dyd_error *err) {
  const dyd_converge_options how = {DYD_SIZED(dyd_converge_options), .pairs = places_pairs, .pairs_user = s};
  dyd_engine_options o;
  double *cost = NULL, begun = dyd_seconds();
  *outcome = DYD_OUTCOME_ERROR;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_engine_options", err) != DYD_OK) return DYD_E_ARG;
  if (o.cost && !(o.cost = cost = costs_of_images(s, o.cost))) return dyd_fail_nomem(err);
  if (!o.start_bits) o.start_bits = START_BITS;
  dyd_status st =
      table ? dyd_converge_run(table, s->images, &o, &how, err) : dyd_engine_run(outcome, s->images, &o, err);
  free(cost);
  dyd_sphere_blame(s, st, err);
  if (st == DYD_OK) st = dyd_sphere_narrow_recalled(s, o.max_bits, err);
  if (st == DYD_OK) *outcome = dyd_sphere_outcome(s);
  if (st == DYD_OK && *outcome == DYD_OUTCOME_FIXPOINT) {
    st = second_look(s, &o, begun, err);
    if (st == DYD_OK) *outcome = dyd_sphere_outcome(s);
  }
  if (table && st == DYD_OK) table->outcome = *outcome;
  return st;
}

dyd_status dyd_sphere_run(dyd_outcome *outcome, dyd_sphere *s, const dyd_engine_options *options, dyd_error *err) {
  return sphere_run(outcome, s, options, NULL, err);
}

dyd_status dyd_sphere_converge(dyd_convergence *out, dyd_sphere *s, const dyd_engine_options *options, dyd_error *err) {
  dyd_outcome outcome;
  if (!s || !out) return dyd_fail_null(err);
  return sphere_run(&outcome, s, options, out, err);
}

/* ---- pairs ---- */

/* The images in face f; *tie: its pairs are ties. Where no pair is open, only the hull is: a tie if all are on a line.
 */
static dyd_status face_look(dyd_index_list *face, bool *outer, bool *tie, const dyd_sphere *s, size_t f) {
  const dyd_delaunay *pd = dyd_engine_delaunay(s->images);
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = dyd_delaunay_face(face, outer, pd, f);
  if (st == DYD_OK) st = dyd_delaunay_face_pairs(&pairs, pd, f);
  *tie = !dyd_delaunay_is_capped(pd);
  for (size_t k = 0; k < pairs.count; k++) *tie = *tie && pairs.item[k].status == DYD_TIE;
  if (st == DYD_OK && *tie && !pairs.count) {
    *tie = false;
    if (*outer && face->count > 2) st = dyd_sphere_on_circle(tie, s, true, face->item, face->count, NULL);
  }
  return st;
}

/* Of images in outer faces: whose pairs are all ties, or not. */
enum { IN_NONE, IN_TIE, IN_OPEN };

static dyd_status mark_outer(uint8_t *in, const dyd_sphere *s) {
  const dyd_delaunay *pd = dyd_engine_delaunay(s->images);
  dyd_status st = DYD_OK;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd) && st == DYD_OK; f++) {
    DYD_SCOPED(dyd_index_list) face = {0};
    bool outer, tie;
    st = face_look(&face, &outer, &tie, s, f);
    for (size_t k = 0; k < face.count && outer; k++)
      if (in[face.item[k]] != IN_OPEN) in[face.item[k]] = tie ? IN_TIE : IN_OPEN;
  }
  return st;
}

size_t dyd_sphere_faces(const dyd_sphere *s) {
  if (!s) return 0;
  const dyd_delaunay *pd = dyd_engine_delaunay(s->images);
  return pd ? dyd_delaunay_undecided_faces(pd) + (s->free && !s->gap_decided) : 0;
}

dyd_status dyd_sphere_face(dyd_index_list *out, bool *tie, const dyd_sphere *s, size_t f) {
  if (!s) return DYD_E_ARG;
  const dyd_delaunay *pd = dyd_engine_delaunay(s->images);
  DYD_SCOPED(dyd_index_list) face = {0};
  bool outer = false;
  if (!pd || f >= dyd_sphere_faces(s)) return DYD_E_ARG;
  bool gap = f == dyd_delaunay_undecided_faces(pd);
  dyd_status st = gap ? face_of_gap(&face, tie, pd) : face_look(&face, &outer, tie, s, f);
  uint32_t *item = st == DYD_OK ? dyd_alloc(face.count + 1, sizeof *item) : NULL;
  if (st == DYD_OK && !item) st = DYD_E_NOMEM;
  if (st == DYD_OK) {
    for (size_t k = 0; k < face.count; k++) item[k] = s->of[face.item[k]];
    item[face.count] = s->centre;
    size_t n = face.count + (outer && !s->free);
    qsort(item, n, sizeof *item, dyd_compare_index);
    dyd_index_list_clear(out);
    *out = (dyd_index_list){n, item};
  }
  return st;
}

/* Of an image that may be no corner of the hull. One of two is a corner, or the same place as the other. */
static dyd_pair_status status_on_hull(const dyd_sphere *s, uint8_t in) {
  if (s->with_image <= 2) return DYD_LEGAL;
  return in == IN_TIE ? DYD_TIE : DYD_INDETERMINATE;
}

dyd_status dyd_sphere_about_centre(dyd_pair_status *status, const dyd_sphere *s) {
  const dyd_delaunay *pd = dyd_engine_delaunay(s->images);
  DYD_SCOPED(dyd_hull) hull = {0};
  const dyd_index_list *sure = &hull.sure_vertices, *possible = &hull.possible_vertices;
  DYD_FREED uint8_t *in = calloc(s->with_image + 1, sizeof *in);
  dyd_status st = in ? mark_outer(in, s) : DYD_E_NOMEM;
  if (st == DYD_OK) st = dyd_delaunay_partial_hull(&hull, pd, false);
  for (size_t k = 0; k < s->with_image; k++) status[k] = DYD_ILLEGAL;
  for (size_t k = 0; k < possible->count; k++)
    status[possible->item[k]] = status_on_hull(s, in ? in[possible->item[k]] : IN_OPEN);
  for (size_t k = 0; k < sure->count; k++) status[sure->item[k]] = DYD_LEGAL;
  return st;
}

static dyd_pair pair_of(uint32_t i, uint32_t j, dyd_pair_status status) {
  return i < j ? (dyd_pair){i, j, status} : (dyd_pair){j, i, status};
}

static const dyd_pair *pair_find(const dyd_pair_list *l, uint32_t i, uint32_t j) {
  const dyd_pair key = pair_of(i, j, DYD_LEGAL);
  return dyd_find_two(&key, l->item, l->count, sizeof key);
}

/* The pairs of the centre; about one that is not a place, pairs of its neighbours that are not among the others. */
static size_t pairs_about_centre(dyd_pair *item, const dyd_sphere *s, const dyd_pair_list *images,
                                 const dyd_pair_status *status) {
  size_t n = 0;
  for (uint32_t k = 0; k < s->with_image; k++) {
    if (status[k] == DYD_ILLEGAL) continue;
    if (!s->free) item[n++] = pair_of(s->of[k], s->centre, status[k]);
    for (uint32_t l = 0; s->free && l < k; l++)
      if (status[l] != DYD_ILLEGAL && !pair_find(images, k, l))
        item[n++] = pair_of(s->of[k], s->of[l], DYD_INDETERMINATE);
  }
  return n;
}

/* Merges the sorted items from `first` on, fewer, with the sorted ones before. */
static dyd_status pairs_merge(dyd_pair *item, size_t first, size_t n) {
  DYD_FREED dyd_pair *late = dyd_alloc(n - first, sizeof *late);
  if (!late) return DYD_E_NOMEM;
  for (size_t k = first; k < n; k++) late[k - first] = item[k];
  for (size_t at = n, left = n - first; left;) {
    bool early = first && dyd_compare_two(&item[first - 1], &late[left - 1]) > 0;
    item[--at] = early ? item[--first] : late[--left];
  }
  return DYD_OK;
}

/* The pairs of images by their places, which keeps their order, and those about the centre; sorted. */
static dyd_status pairs_join(dyd_pair_list *out, const dyd_sphere *s, const dyd_pair_list *images,
                             const dyd_pair_status *status) {
  size_t n = 0, about = 0;
  for (size_t k = 0; k < s->with_image; k++) about += status[k] != DYD_ILLEGAL;
  if (s->free && about > MOST_ABOUT) return DYD_E_RANGE;
  dyd_pair *item = dyd_alloc(images->count + (s->free ? about * about : about), sizeof *item);
  if (!item) return DYD_E_NOMEM;
  for (; n < images->count; n++)
    item[n] = pair_of(s->of[images->item[n].i], s->of[images->item[n].j], images->item[n].status);
  n += pairs_about_centre(item + n, s, images, status);
  qsort(item + images->count, n - images->count, sizeof *item, dyd_compare_two);
  dyd_status st = pairs_merge(item, images->count, n);
  if (st != DYD_OK) {
    free(item);
    return st;
  }
  dyd_pair_list_clear(out);
  *out = (dyd_pair_list){n, item};
  return DYD_OK;
}

static dyd_status pairs_seen(dyd_pair_list *out, const dyd_sphere *s) {
  const dyd_delaunay *pd = dyd_engine_delaunay(s->images);
  if (!pd) return DYD_E_ARG;
  DYD_SCOPED(dyd_pair_list) images = {0};
  DYD_FREED dyd_pair_status *status = dyd_alloc(s->with_image, sizeof *status);
  dyd_status st = status ? dyd_delaunay_pairs(&images, pd) : DYD_E_NOMEM;
  if (st == DYD_OK) st = dyd_sphere_about_centre(status, s);
  return st == DYD_OK ? pairs_join(out, s, &images, status) : st;
}

/* Gives indeterminate pairs the status seen from another eye. */
static void pairs_improve(dyd_pair_list *l, const dyd_pair_list *other) {
  size_t n = 0;
  for (size_t k = 0; k < l->count; k++) {
    const dyd_pair *p = &l->item[k], *q = p;
    if (p->status == DYD_INDETERMINATE) q = pair_find(other, p->i, p->j);
    if (q) l->item[n++] = *q;
  }
  l->count = n;
}

/* Lists the pairs as seen from the given number of eyes. */
static dyd_status pairs_from(dyd_pair_list *out, const dyd_sphere *s, int eyes) {
  DYD_SCOPED(dyd_pair_list) other = {0};
  dyd_status st = pairs_seen(out, s);
  if (st != DYD_OK || eyes == 1 || !s->second || !dyd_engine_delaunay(s->second->images)) return st;
  st = pairs_from(&other, s->second, eyes - 1);
  if (st == DYD_OK) pairs_improve(out, &other);
  return st == DYD_E_NOMEM ? st : DYD_OK;
}

enum { ALL_EYES = 3 };

dyd_status dyd_sphere_pairs(dyd_pair_list *out, const dyd_sphere *s) {
  return s ? pairs_from(out, s, ALL_EYES) : DYD_E_ARG;
}

static bool pairs_are_legal(const dyd_sphere *s, int eyes) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  bool legal = pairs_from(&pairs, s, eyes) == DYD_OK;
  for (size_t k = 0; k < pairs.count; k++) legal = legal && pairs.item[k].status == DYD_LEGAL;
  return legal;
}

static dyd_outcome outcome_from(const dyd_sphere *s, int eyes) {
  dyd_outcome outcome = dyd_engine_outcome(s->images);
  if (s->free && outcome == DYD_OUTCOME_DECIDED) outcome = DYD_OUTCOME_FIXPOINT; /* pairs around it */
  if ((!s->second && !s->free) || outcome != DYD_OUTCOME_FIXPOINT) return outcome;
  if (pairs_are_legal(s, eyes)) return DYD_OUTCOME_DECIDED;
  for (; eyes > 1 && s->second; eyes--) {
    s = s->second;
    dyd_outcome other = dyd_engine_outcome(s->images);
    if (other == DYD_OUTCOME_CANCELLED || other == DYD_OUTCOME_BUDGET) return other;
  }
  return outcome;
}

dyd_outcome dyd_sphere_outcome(const dyd_sphere *s) {
  return s ? outcome_from(s, ALL_EYES) : DYD_OUTCOME_NONE;
}

dyd_outcome dyd_sphere_proved_outcome(const dyd_sphere *s) {
  return outcome_from(s, s->free ? 1 : 2);
}

/* ---- triangles ---- */

static int compare_triangles(const void *a, const void *b) {
  const dyd_triangle *x = a, *y = b;
  for (int k = 0; k < 3; k++)
    if (x->v[k] != y->v[k]) return x->v[k] < y->v[k] ? -1 : 1;
  return 0;
}

/* The lowest number first. */
static dyd_triangle triangle_of(uint32_t a, uint32_t b, uint32_t c) {
  if (a < b && a < c) return (dyd_triangle){{a, b, c}};
  return b < c ? (dyd_triangle){{b, c, a}} : (dyd_triangle){{c, a, b}};
}

static bool pair_is_legal(const dyd_pair_list *l, uint32_t i, uint32_t j) {
  const dyd_pair *p = pair_find(l, i, j);
  return p && p->status == DYD_LEGAL;
}

/* Images seen along the way out from q have their orientation from outside turned round twice: once by looking from
 * below, once by the axes (x east, y north, from the antipode's side); counter-clockwise in the plane is clockwise from
 * outside. Beyond a certain side of the hull is a triangle with q. */
static dyd_status triangles_join(dyd_triangle_list *out, const dyd_sphere *s, const dyd_triangle_list *images,
                                 const dyd_index_list *around, const dyd_hull *hull) {
  dyd_triangle *item = dyd_alloc(images->count + around->count, sizeof *item);
  size_t n = 0;
  if (!item) return DYD_E_NOMEM;
  for (; n < images->count; n++) {
    const uint32_t *v = images->item[n].v;
    item[n] = triangle_of(s->of[v[0]], s->of[v[2]], s->of[v[1]]);
  }
  for (size_t k = 0; k < around->count && around->count > 1; k++) {
    uint32_t a = around->item[k], b = around->item[k + 1 < around->count ? k + 1 : 0];
    if (pair_is_legal(&hull->pairs, a, b)) item[n++] = triangle_of(s->of[a], s->of[b], s->centre);
  }
  qsort(item, n, sizeof *item, compare_triangles);
  dyd_triangle_list_clear(out);
  *out = (dyd_triangle_list){n, item};
  return DYD_OK;
}

static dyd_status triangles_seen(dyd_triangle_list *out, const dyd_sphere *s) {
  const dyd_delaunay *pd = dyd_engine_delaunay(s->images);
  if (!pd) return DYD_E_ARG;
  DYD_SCOPED(dyd_triangle_list) images = {0};
  DYD_SCOPED(dyd_index_list) around = {0};
  DYD_SCOPED(dyd_hull) hull = {0};
  dyd_status st = dyd_delaunay_triangles(&images, NULL, pd, 0);
  if (st == DYD_OK && !s->free) st = dyd_delaunay_hull(&around, pd);
  if (st == DYD_OK && !s->free) st = dyd_delaunay_partial_hull(&hull, pd, true);
  if (st == DYD_CAPPED) st = DYD_OK; /* then no side of the hull is listed */
  return st == DYD_OK ? triangles_join(out, s, &images, &around, &hull) : st;
}

/* Adds triangles that are certain from another eye. */
static dyd_status triangles_add(dyd_triangle_list *l, const dyd_triangle_list *more) {
  size_t n = l->count + more->count, kept = 0;
  dyd_triangle *item = dyd_alloc(n, sizeof *item);
  if (!item) return DYD_E_NOMEM;
  for (size_t k = 0; k < n; k++) item[k] = k < l->count ? l->item[k] : more->item[k - l->count];
  qsort(item, n, sizeof *item, compare_triangles);
  for (size_t k = 0; k < n; k++)
    if (!kept || compare_triangles(&item[kept - 1], &item[k]) != 0) item[kept++] = item[k];
  dyd_triangle_list_clear(l);
  *l = (dyd_triangle_list){kept, item};
  return DYD_OK;
}

dyd_status dyd_sphere_triangles(dyd_triangle_list *out, const dyd_sphere *s) {
  if (!s) return DYD_E_ARG;
  DYD_SCOPED(dyd_triangle_list) other = {0};
  dyd_status st = triangles_seen(out, s);
  if (st != DYD_OK || !s->second || !dyd_engine_delaunay(s->second->images)) return st;
  st = dyd_sphere_triangles(&other, s->second);
  return st == DYD_OK ? triangles_add(out, &other) : st;
}

/* ---- circles ---- */

/* A walk over the ties of images. */
typedef struct circle_walk {
  const dyd_sphere *s;
  dyd_group_fn visit;
  void *user;
} circle_walk;

/* [SPH-1] [SPH-4] Images of one circle are places of one, seen from the other side. A line of the hull, followed
 * clockwise about it, is a circle with the centre; one that holds all images is empty on both sides. */
static dyd_status circle_tell(void *user, dyd_group_kind kind, const dyd_index_list *images) {
  const circle_walk *w = user;
  bool chain = kind == DYD_GROUP_CHAIN;
  if (kind == DYD_GROUP_PAIR || (chain && w->s->free)) return DYD_OK;
  DYD_SCOPED(dyd_index_list) circle = {images->count + chain, NULL};
  circle.item = dyd_alloc(circle.count, sizeof *circle.item);
  if (!circle.item) return DYD_E_NOMEM;
  circle.item[0] = w->s->centre;
  for (size_t k = 0; k < images->count; k++) circle.item[circle.count - 1 - k] = w->s->of[images->item[k]];
  dyd_status st = w->visit(w->user, DYD_GROUP_CIRCLE, &circle);
  for (size_t k = 0; k < images->count; k++) circle.item[circle.count - images->count + k] = w->s->of[images->item[k]];
  if (st == DYD_OK && chain && images->count == w->s->with_image) st = w->visit(w->user, DYD_GROUP_CIRCLE, &circle);
  return st;
}

dyd_status dyd_sphere_each_circle(const dyd_sphere *s, dyd_group_fn visit, void *user) {
  if (!s || !visit) return DYD_E_ARG;
  return dyd_delaunay_each_group(dyd_engine_delaunay(s->images), circle_tell, &(circle_walk){s, visit, user});
}

/* ---- places ---- */

static dyd_status spot_side(dyd_interval *out, const dyd_spot *spot, int a) {
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  mpq_sub(lo, spot->mid[a], spot->half[a]);
  mpq_add(hi, spot->mid[a], spot->half[a]);
  return mpq_equal(lo, hi) ? dyd_interval_set_q(out, lo) : dyd_interval_set_outward(out, lo, hi, -64);
}

dyd_status dyd_sphere_rect(dyd_rect *out, const dyd_sphere *s, uint32_t i) {
  if (!s) return DYD_E_ARG;
  if (i >= s->count) return DYD_E_ARG;
  DYD_LOCAL(dyd_spot, spot);
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sphere_spot(&spot, s, i, NULL);
  if (st == DYD_OK) dyd_spot_box(&spot);
  if (st == DYD_OK) st = spot_side(&r.x, &spot, 0);
  if (st == DYD_OK) st = spot_side(&r.y, &spot, 1);
  if (st == DYD_OK) dyd_rect_swap(out, &r);
  return st;
}
