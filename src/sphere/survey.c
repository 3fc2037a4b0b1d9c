/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which places to measure next: plans of the plane (survey.h) for the images from a gap, and from another one for pairs
 * around the first [SPH-7].
 *
 * Seen from an eye at an angle t, a place has its image at the distance cot(t/2) from 0; all within an angle r < t of
 * it have theirs within cot((t - r)/2) - cot(t/2) of that one. So squares about images replace regions, and
 * accuracies of squares are angles. Whether the plan is enough is seen on the sphere in the end. */
#include "tolerance/survey.h"
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/index.h"
#include "base/local.h"
#include "base/random.h"
#include "engine/labels.h"
#include "engine/points.h"
#include "sphere/state.h"
#include "sphere/units.h"
#include "stream/ball.h"
#include "tolerance/lines.h"

#include <string.h>

enum { PREC = 128, EYES = 2 };

/* A place seen from a gap: its image as doubles; upper bounds of how far it is off and of how far that is from 0, the
 * latter as a ball, too; an angle. */
typedef struct plan_place {
  uint32_t place;
  double at[2], off;
  arb_struct far, angle;
} plan_place;

typedef struct sphere_plan {
  dyd_sphere *s, *nominal;
  dyd_survey_options options;
  mpq_t accuracy;   /* metres; 0: none */
  double *within;   /* metres, as in dyd_sphere; the plan so far */
  uint32_t *image;  /* of each place from the eye at work; DYD_NONE */
  plan_place *view; /* of each image */
  size_t views;
  dyd_pair_list asked;  /* the pairs in the options, sorted */
  dyd_pair_list target; /* open, but for ties, which come behind; sorted */
  dyd_pair *tied;       /* these */
  bool *taken;          /* of each target: an eye has planned for it */
  dyd_survey *found;
  dyd_survey_pair *pair; /* of each target */
  dyd_survey_row *row;
  size_t rows;
  uint32_t *row_of; /* of each place; DYD_NONE */
  dyd_error *err;
} sphere_plan;

/* ---- targets ---- */

static dyd_status targets_ask(sphere_plan *p, const dyd_pair_list *pairs) {
  p->asked.item = dyd_alloc(pairs->count, sizeof *pairs->item);
  if (!p->asked.item) return DYD_E_NOMEM;
  for (; p->asked.count < pairs->count; p->asked.count++) p->asked.item[p->asked.count] = pairs->item[p->asked.count];
  if (pairs->count) qsort(p->asked.item, pairs->count, sizeof *pairs->item, dyd_compare_two);
  return DYD_OK;
}

static bool target_is_asked(const sphere_plan *p, const dyd_pair *q) {
  const uint32_t *site = p->options.site;
  if (site && q->i != *site && q->j != *site) return false;
  return !p->options.pairs || dyd_find_two(q, p->asked.item, p->asked.count, sizeof *q);
}

/* The open pairs, except ties where places are in the middle of their regions. */
static dyd_status targets_find(sphere_plan *p) {
  DYD_SCOPED(dyd_pair_list) all = {0}, nominal = {0};
  dyd_survey_result *r = &p->found->result;
  dyd_status st = p->options.pairs ? targets_ask(p, p->options.pairs) : DYD_OK;
  if (st == DYD_OK) st = dyd_sphere_pairs(&all, p->s);
  if (st == DYD_OK && dyd_engine_delaunay(p->nominal->images)) st = dyd_sphere_pairs(&nominal, p->nominal);
  p->target.item = st == DYD_OK ? dyd_alloc(all.count, sizeof *all.item) : NULL;
  if (st == DYD_OK && (!p->target.item || !DYD_NEW(p->tied, all.count))) st = DYD_E_NOMEM;
  for (size_t k = 0; k < all.count && st == DYD_OK; k++) {
    const dyd_pair *q = &all.item[k];
    if (q->status == DYD_LEGAL || !target_is_asked(p, q)) continue;
    const dyd_pair *same = dyd_find_two(q, nominal.item, nominal.count, sizeof *q);
    const uint32_t alias[2] = {dyd_sphere_alias(p->nominal, q->i), dyd_sphere_alias(p->nominal, q->j)};
    for (int e = 0; e < 2 && r->same[0] == r->same[1] && q->status == DYD_INDETERMINATE; e++)
      r->same[0] = alias[e], r->same[1] = e ? q->j : q->i;
    bool tied = same && same->status == DYD_TIE;
    if (tied && q->status == DYD_INDETERMINATE && r->tie[0] == r->tie[1]) r->tie[0] = q->i, r->tie[1] = q->j;
    if (tied || alias[0] == alias[1])
      p->tied[r->ties++] = *q;
    else
      p->target.item[p->target.count++] = *q;
  }
  for (size_t k = 0; k < r->ties; k++) p->target.item[p->target.count + k] = p->tied[k];
  if (st == DYD_OK && (!DYD_ZEROED(p->taken, p->target.count + 1) || !DYD_NEW(p->pair, p->target.count)))
    st = DYD_E_NOMEM;
  for (size_t k = 0; k < p->target.count && st == DYD_OK; k++)
    p->pair[k] = (dyd_survey_pair){p->target.item[k].i, p->target.item[k].j, SIZE_MAX};
  return st;
}

/* A run that ends with that of the sphere. */
static dyd_status plan_run(const sphere_plan *p, dyd_sphere *then) {
  dyd_outcome outcome;
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  dyd_engine_follow(p->s->images, then->images);
  dyd_status st = dyd_sphere_run(&outcome, then, &o, p->err);
  dyd_engine_follow(p->s->images, NULL);
  return st == DYD_OK && (outcome == DYD_OUTCOME_CANCELLED || dyd_flag_is_set(p->options.cancel)) ? DYD_CANCELLED : st;
}

/* Places in the middle of their regions, triangulated. */
static dyd_status nominal_make(sphere_plan *p) {
  for (size_t i = 0; i < p->s->count; i++) p->within[i] = 0;
  dyd_status st = dyd_sphere_new_within(&p->nominal, p->s, p->within, p->err);
  if (st != DYD_OK) return st;
  st = plan_run(p, p->nominal);
  dyd_status found = st == DYD_OK || st == DYD_CANCELLED ? targets_find(p) : st;
  for (size_t i = 0; i < p->s->count; i++) p->within[i] = -1;
  return found == DYD_OK ? st : found;
}

/* ---- images ---- */

/* Sets half to an upper bound of the half of a square that holds the images of all within the angle; false: no square
 * does. */
static bool square_half(double *half, const plan_place *v, arb_srcptr angle) {
  DYD_LOCAL_NUMBERS(arb, x);
  arb_sub(x, &v->angle, angle, PREC);
  bool good = arb_is_positive(x);
  arb_mul_2exp_si(x, x, -1);
  arb_cot(x, x, PREC);
  arb_sub(x, x, &v->far, PREC);
  *half = nextafter(dyd_ball_ends(x).hi + v->off, HUGE_VAL);
  return good && isfinite(*half);
}

/* The metres within which a place has to be so that its image is within `half`; a lower bound, to 6 digits. */
static double square_metres(const plan_place *v, const dyd_sphere *s, double half) {
  DYD_LOCAL_ARRAY(arb_struct, x, [2]);
  arb_ptr t = x + 1;
  DYD_LOCAL_NUMBERS(mpq, least);
  arb_set_d(x, half);
  arb_set_d(t, v->off);
  arb_sub(x, x, t, PREC);
  arb_add(x, x, &v->far, PREC);
  arb_one(t);
  arb_atan2(x, t, x, PREC);
  arb_mul_2exp_si(x, x, 1);
  arb_sub(x, &v->angle, x, PREC);
  dyd_sphere_metres(x, s, PREC);
  mpq_set_d(least, fmax(0, dyd_ball_ends(x).lo));
  return dyd_q_brief(least);
}

/* Sets the view of a place in the middle of the spot; false: it is at the eye. */
static bool view_place(plan_place *v, dyd_sphere *eye, const dyd_spot *spot) {
  DYD_LOCAL_ARRAY(arb_struct, x, [4]);
  DYD_LOCAL(dyd_spot, mid);
  for (int a = 0; a < 2; a++) mpq_set(mid.mid[a], spot->mid[a]);
  bool good = dyd_project(x, x + 1, &mid, &eye->eye, PREC);
  v->off = 0;
  for (int a = 0; a < 2 && good; a++) {
    const dyd_iv ends = dyd_ball_ends(x + a);
    v->at[a] = ends.lo / 2 + ends.hi / 2;
    v->off += nextafter(ends.hi - ends.lo, HUGE_VAL);
  }
  arb_hypot(&v->far, x, x + 1, PREC);
  arb_one(x);
  arb_atan2(&v->angle, x, &v->far, PREC);
  arb_mul_2exp_si(&v->angle, &v->angle, 1);
  return good;
}

/* Adds the square of half-width h about the image. */
static dyd_status square_add(dyd_sites *sites, const plan_place *v, double h) {
  dyd_status st = DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, c, half);
  DYD_LOCAL_ARRAY(mpq_t, end, [2]);
  DYD_LOCAL(dyd_rect, r);
  mpq_set_d(half, h);
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    mpq_set_d(c, v->at[a]);
    mpq_sub(end[0], c, half);
    mpq_add(end[1], c, half);
    st = dyd_interval_set_outward(a ? &r.y : &r.x, end[0], end[1], -2048); /* exact */
  }
  return st == DYD_OK ? dyd_sites_add_rect(sites, &r) : st;
}

/* Of place i, as it is, or as the plan so far has it; *accuracy: half of the square for the accuracy asked for. Left
 * out where its region reaches the eye. */
static dyd_status square_make(double *accuracy, sphere_plan *p, dyd_sites *sites, dyd_sphere *eye, uint32_t i) {
  plan_place *v = &p->view[p->views];
  double half = 0;
  arb_init(&v->far);
  arb_init(&v->angle);
  p->views++;
  DYD_LOCAL_NUMBERS(arb, reach);
  DYD_LOCAL(dyd_spot, spot);
  v->place = i;
  dyd_status st = dyd_sphere_spot(&spot, p->s, i, p->err);
  if (st == DYD_OK) dyd_spot_reach(reach, &spot, PREC);
  bool good = st == DYD_OK && view_place(v, eye, &spot) && (arb_is_zero(reach) || square_half(&half, v, reach));
  if (good) {
    p->image[i] = (uint32_t)(p->views - 1);
    st = square_add(sites, v, half);
    mpq_mul(spot.angle, p->accuracy, p->s->metre);
    dyd_ball_set_q(reach, spot.angle, PREC);
    if (mpq_sgn(p->accuracy) && !square_half(accuracy, v, reach)) *accuracy = HUGE_VAL;
    *accuracy = fmin(*accuracy * (1 + 0x1p-30), 0x1p1000);
  } else {
    arb_clear(&v->angle);
    arb_clear(&v->far);
    p->views--;
  }
  return st;
}

/* ---- one eye ---- */

/* The rows of a plan of images, as places and metres; where a place has a row, the finer one counts. */
static dyd_status rows_take(sphere_plan *p, const dyd_survey *survey) {
  const dyd_survey_row *row;
  size_t rows = dyd_survey_rows(&row, survey);
  for (size_t k = 0; k < rows; k++) {
    const plan_place *v = &p->view[row[k].site];
    uint32_t *of = &p->row_of[v->place];
    bool first = *of == DYD_NONE;
    if (first) *of = (uint32_t)p->rows;
    dyd_survey_row *to = &p->row[*of];
    double metres = square_metres(v, p->s, row[k].needed);
    if (first) {
      *to = (dyd_survey_row){.site = v->place, .needed = metres};
      DYD_LOCAL(dyd_spot, spot);
      DYD_LOCAL_NUMBERS(arb, x);
      dyd_status st = dyd_sphere_spot(&spot, p->s, v->place, p->err);
      if (st == DYD_OK) dyd_spot_reach(x, &spot, PREC);
      dyd_sphere_metres(x, p->s, PREC);
      to->now = dyd_ball_ends(x).hi;
      p->rows++;
      if (st != DYD_OK) return st;
    }
    to->needed = fmin(to->needed, metres);
    p->within[v->place] = to->needed;
  }
  return DYD_OK;
}

/* A cap with the eye in it may show a pair that the plane has for illegal. */
static bool is_of_plane_only(const dyd_index_list *outer, const dyd_pair *nominal) {
  return nominal->status != DYD_LEGAL && dyd_find_index(&nominal->i, outer->item, outer->count, sizeof *outer->item) &&
         dyd_find_index(&nominal->j, outer->item, outer->count, sizeof *outer->item);
}

/* Pairs of images that the first rows of their plan decide are decided by the rows of the same places, but for those
 * illegal of two images that may be on the hull [SPH-7]; outer: all that may be. */
static dyd_status pairs_take(sphere_plan *p, const dyd_survey *survey, const dyd_index_list *outer) {
  const dyd_survey_row *row;
  const dyd_survey_pair *pair;
  const size_t rows = dyd_survey_rows(&row, survey), pairs = dyd_survey_pairs(&pair, survey);
  DYD_FREED size_t *last = dyd_alloc(rows, sizeof *last); /* of the rows of places that the first ones are */
  if (!last) return DYD_E_NOMEM;
  for (size_t k = 0; k < rows; k++) {
    const size_t of = p->row_of[p->view[row[k].site].place];
    last[k] = k && last[k - 1] > of ? last[k - 1] : of;
  }
  for (size_t k = 0; k < pairs; k++) {
    const uint32_t a = p->view[pair[k].i].place, b = p->view[pair[k].j].place, key[2] = {a < b ? a : b, a < b ? b : a};
    const dyd_pair *at = dyd_find_two(key, p->target.item, p->target.count, sizeof *at);
    if (!at || pair[k].row >= rows || is_of_plane_only(outer, &survey->target.item[k])) continue;
    p->pair[at - p->target.item].row = last[pair[k].row];
  }
  return DYD_OK;
}

/* The targets that are open from here, as pairs of images. */
static dyd_status eye_targets(dyd_pair_list *out, sphere_plan *p, const dyd_delaunay *pd) {
  out->item = dyd_alloc(p->target.count, sizeof *out->item);
  if (!out->item) return DYD_E_NOMEM;
  for (size_t k = 0; k < p->target.count; k++) {
    uint32_t i = p->image[p->target.item[k].i], j = p->image[p->target.item[k].j];
    if (p->taken[k] || i == DYD_NONE || j == DYD_NONE) continue;
    if (dyd_delaunay_status(pd, i, j) == DYD_ILLEGAL) continue;
    p->taken[k] = true;
    out->item[out->count++] = (dyd_pair){i < j ? i : j, i < j ? j : i, DYD_INDETERMINATE};
  }
  return DYD_OK;
}

static dyd_status eye_plan(sphere_plan *p, const dyd_delaunay *pd, const double *accuracy, const double *cost) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  DYD_SCOPED(dyd_hull) hull = {0};
  DYD_OWNED(dyd_survey) *survey = NULL;
  dyd_status st = eye_targets(&pairs, p, pd);
  const dyd_survey_options how = {DYD_SIZED(dyd_survey_options), .pairs = &pairs,
                                  .accuracies = mpq_sgn(p->accuracy) ? accuracy : NULL,
                                  .cost = p->options.cost ? cost : NULL, .cancel = p->options.cancel};
  if (st == DYD_OK && pairs.count) st = dyd_survey_new(&survey, pd, &how, p->err);
  dyd_status taken = survey ? rows_take(p, survey) : DYD_OK;
  if (survey && taken == DYD_OK) taken = dyd_delaunay_partial_hull(&hull, pd, false);
  if (survey && taken == DYD_OK) taken = pairs_take(p, survey, &hull.possible_vertices);
  return taken == DYD_OK ? st : taken;
}

static void views_clear(sphere_plan *p) {
  for (size_t k = 0; k < p->views; k++) {
    arb_clear(&p->view[k].far);
    arb_clear(&p->view[k].angle);
  }
  p->views = 0;
}

/* Plans for the targets that are seen from this eye. */
static dyd_status eye_look(sphere_plan *p, dyd_sphere *eye) {
  DYD_OWNED(dyd_sites) *sites = NULL;
  DYD_OWNED(dyd_delaunay) *pd = NULL;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = p->options.cancel};
  double *number = dyd_alloc(2 * p->s->count, sizeof *number), *cost = number + p->s->count;
  dyd_status st = number ? dyd_sites_new(&sites) : DYD_E_NOMEM;
  for (uint32_t i = 0; i < p->s->count && st == DYD_OK; i++) {
    p->image[i] = DYD_NONE;
    if (p->s->alias[i] != i) continue;
    number[p->views] = HUGE_VAL;
    if (p->options.cost) cost[p->views] = p->options.cost[i];
    st = square_make(&number[p->views], p, sites, eye, i);
  }
  if (st == DYD_OK) st = dyd_delaunay_new(&pd, sites, &o, p->err);
  if (st == DYD_OK) st = eye_plan(p, pd, number, cost);
  views_clear(p);
  free(number);
  return st;
}

/* ---- all ---- */

/* Which targets stay open with the plan: on the sphere, by a run of its own. Those decided of
 * which no eye tells the row are the last one's. */
static dyd_status plan_verify(sphere_plan *p) {
  DYD_OWNED(dyd_sphere) *then = NULL;
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = dyd_sphere_new_within(&then, p->s, p->within, p->err);
  if (st == DYD_OK) st = plan_run(p, then);
  if (st == DYD_OK) st = dyd_sphere_pairs(&pairs, then);
  for (size_t k = 0; k < p->target.count && st == DYD_OK; k++) {
    const dyd_pair *q = dyd_find_two(&p->target.item[k], pairs.item, pairs.count, sizeof *q);
    if (q && q->status != DYD_LEGAL)
      p->pair[k].row = SIZE_MAX;
    else if (p->pair[k].row == SIZE_MAX && p->rows)
      p->pair[k].row = p->rows - 1;
  }
  return st;
}

static void rows_count(sphere_plan *p) {
  size_t left = p->target.count;
  for (size_t k = 0; k < p->target.count; k++)
    if (p->pair[k].row < p->rows) p->row[p->pair[k].row].decided++;
  for (size_t k = 0; k < p->rows; k++) p->row[k].left = left -= p->row[k].decided;
  p->found->result.left = left;
}

static dyd_status plan_eyes(sphere_plan *p) {
  dyd_sphere *eye[EYES + 1] = {p->s};
  dyd_status st = DYD_OK;
  for (int k = 0; k < EYES && st == DYD_OK; k++) {
    const dyd_sphere *from = k ? eye[k] : p->nominal; /* whose place is none to keep away from */
    st = dyd_sphere_new_gap(&eye[k + 1], from, p->err);
    if (st != DYD_OK || !eye[k + 1]) break;
    eye[k + 1]->within = NULL;
    st = eye_look(p, eye[k + 1]);
  }
  for (int k = 1; k <= EYES; k++) dyd_sphere_free(eye[k]);
  return st;
}

static dyd_status plan_make(sphere_plan *p) {
  size_t n = p->s->count;
  if (!DYD_NEW(p->within, n) || !DYD_NEW(p->image, n) || !DYD_NEW(p->view, n) || !DYD_NEW(p->row, n) ||
      !DYD_NEW(p->row_of, n))
    return DYD_E_NOMEM;
  for (size_t i = 0; i < p->s->count; i++) p->row_of[i] = DYD_NONE;
  dyd_status st = nominal_make(p);
  if (st == DYD_OK && p->target.count) st = plan_eyes(p);
  if (st == DYD_OK && p->target.count) st = plan_verify(p);
  if (st != DYD_OK && st != DYD_CANCELLED) return st;
  rows_count(p);
  p->found->result.open = p->target.count;
  p->found->result.cut = st == DYD_CANCELLED;
  return dyd_survey_tell_cut(p->found, p->err);
}

/* Work was cancelled before, perhaps that on the sphere, too. */
static dyd_status plan_not_begun(sphere_plan *p) {
  const dyd_delaunay *pd = dyd_engine_delaunay(p->s->images);
  dyd_survey_result *r = &p->found->result;
  size_t count[4] = {0};
  if (pd) dyd_delaunay_count(count, pd);
  r->open = r->left = p->options.pairs ? p->options.pairs->count : count[DYD_INDETERMINATE];
  r->cut = true;
  return dyd_survey_tell_cut(p->found, p->err);
}

static dyd_status accuracy_take(sphere_plan *p, const char *text) {
  bool ground = false;
  mpq_init(p->accuracy);
  if (!text) return DYD_OK;
  dyd_status st = dyd_radius_parse(p->accuracy, &ground, text, strlen(text), NULL);
  if (st == DYD_E_NOMEM || (st == DYD_OK && ground && mpq_sgn(p->accuracy) > 0)) return st;
  return dyd_fail(p->err, DYD_E_ARG, "the accuracy \"%.60s\" is not a length above 0 with its unit, such as 5m", text);
}

dyd_status dyd_sphere_survey(dyd_survey **out, dyd_sphere *s, const char *accuracy, const dyd_survey_options *options,
                             dyd_error *err) {
  if (!s || !out) return dyd_fail_null(err);
  sphere_plan p = {.s = s, .err = err};
  *out = NULL;
  if (err) dyd_error_clear(err);
  dyd_status st = dyd_abi_take(&p.options, sizeof p.options, options, "dyd_survey_options", err);
  if (st != DYD_OK) return st;
  p.found = calloc(1, sizeof *p.found);
  if (!p.found) return dyd_fail_nomem(err);
  mpq_init(p.found->scale);
  st = accuracy_take(&p, accuracy);
  if (st == DYD_OK && dyd_flag_is_set(p.options.cancel)) st = plan_not_begun(&p);
  if (st == DYD_OK) st = plan_make(&p);
  p.found->result.struct_size = sizeof p.found->result;
  p.found->row = p.row;
  p.found->rows = p.rows;
  p.found->pair = p.pair;
  p.found->target = p.target;
  p.found->tied = p.found->result.ties;
  if (st == DYD_OK || st == DYD_CANCELLED)
    *out = p.found;
  else
    dyd_survey_free(p.found);
  dyd_sphere_free(p.nominal);
  dyd_pair_list_clear(&p.asked);
  dyd_free_all(p.row_of, p.taken, p.view, p.image, p.within, p.tied);
  mpq_clear(p.accuracy);
  return st == DYD_OK || (err && err->code == st) ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

/* ---- plans tried on drawn places ---- */

enum { TRIAL_BITS = 96 };

typedef struct globe_trials {
  dyd_sphere *s;
  const char *accuracy;
} globe_trials;

static const globe_trials *globe_of(const dyd_trial *d) {
  return d->of->user;
}

static void globe_end(void *now) {
  dyd_sphere *s = now;
  dyd_engine *places = s ? s->places : NULL;
  dyd_sphere_free(s);
  dyd_engine_free(places);
}

/* Sets u to two numbers in (-1, 1), those of the unit disc about 0 where `disc`. */
static void globe_draw(mpq_t u[2], uint64_t seed, bool disc) {
  dyd_trial_draw(u, seed, disc);
  for (int a = 0; a < 2; a++) {
    mpq_mul_2exp(u[a], u[a], 1);
    mpz_sub(mpq_numref(u[a]), mpq_numref(u[a]), mpq_denref(u[a]));
  }
}

/* Moves the place (at[0], at[1]), degrees, to (u, v) of the disc of this angle about it: eastward, northward. */
static void place_move(double at[2], mpq_srcptr angle, mpq_srcptr u, mpq_srcptr v) {
  DYD_LOCAL_ARRAY(arb_struct, x, [10]);
  arb_ptr lon = x, lat = x + 1, east = x + 2, north = x + 3, far = x + 4, sf = x + 5, cf = x + 6, sd = x + 7,
          cd = x + 8, t = x + 9;
  arb_set_d(lat, at[1] / 180);
  arb_sin_cos_pi(sf, cf, lat, TRIAL_BITS);
  dyd_ball_set_q(east, u, TRIAL_BITS);
  dyd_ball_set_q(north, v, TRIAL_BITS);
  arb_hypot(far, east, north, TRIAL_BITS);
  arb_div(east, east, far, TRIAL_BITS);
  arb_div(north, north, far, TRIAL_BITS);
  dyd_ball_set_q(t, angle, TRIAL_BITS);
  arb_mul(far, far, t, TRIAL_BITS);
  arb_sin_cos(sd, cd, far, TRIAL_BITS);
  arb_mul(lat, cf, sd, TRIAL_BITS);
  arb_mul(lat, lat, north, TRIAL_BITS);
  arb_addmul(lat, sf, cd, TRIAL_BITS); /* the sine */
  arb_mul(lon, sf, lat, TRIAL_BITS);
  arb_sub(lon, cd, lon, TRIAL_BITS);
  arb_mul(t, east, sd, TRIAL_BITS);
  arb_mul(t, t, cf, TRIAL_BITS);
  arb_atan2(lon, t, lon, TRIAL_BITS);
  arb_asin(lat, lat, TRIAL_BITS);
  arb_const_pi(t, TRIAL_BITS);
  for (int a = 0; a < 2; a++) {
    arb_div(x + a, x + a, t, TRIAL_BITS);
    arb_mul_ui(x + a, x + a, 180, TRIAL_BITS);
  }
  at[0] += arf_get_d(arb_midref(lon), ARF_RND_NEAR);
  at[1] = arf_get_d(arb_midref(lat), ARF_RND_NEAR);
}

/* at: the true place of i, in degrees. */
static dyd_status globe_truth(double at[2], const dyd_trial *d, uint32_t i) {
  const uint64_t own = dyd_random(d->seed, i);
  DYD_LOCAL(dyd_spot, spot);
  DYD_LOCAL_ARRAY(mpq_t, u, [2]);
  dyd_status st = dyd_sphere_spot(&spot, globe_of(d)->s, i, NULL);
  globe_draw(u, dyd_random(own, 1), false);
  for (int a = 0; a < 2; a++) {
    mpq_mul(u[a], u[a], spot.half[a]);
    mpq_add(u[a], u[a], spot.mid[a]);
    at[a] = mpq_get_d(u[a]);
  }
  globe_draw(u, dyd_random(own, 2), true);
  if (mpq_sgn(spot.angle)) place_move(at, spot.angle, u[0], u[1]);
  return st;
}

/* The region of place i as it is, or as it was measured, as a rectangle and metres about it. */
static dyd_status globe_region(dyd_rect *out, double *metres, const dyd_trial *d, uint32_t i) {
  const dyd_sphere *s = d->now ? d->now : globe_of(d)->s;
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

static dyd_status globe_add(dyd_engine *e, const dyd_trial *d, size_t sites, dyd_error *err) {
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

static dyd_status globe_step(dyd_survey **next, dyd_trial *d, dyd_error *err) {
  dyd_engine *places = NULL;
  dyd_sphere *then = NULL;
  dyd_outcome outcome;
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.start_bits = 0;
  dyd_status st = dyd_engine_new(&places);
  if (st == DYD_OK) st = globe_add(places, d, d->of->sites, err);
  if (st == DYD_OK) st = dyd_sphere_new(&then, places, NULL, err);
  if (st != DYD_OK) {
    dyd_engine_free(places);
    return st;
  }
  globe_end(d->now);
  d->now = then;
  st = dyd_sphere_run(&outcome, then, &o, err);
  return st == DYD_OK ? dyd_sphere_survey(next, then, globe_of(d)->accuracy, &d->of->options, err) : st;
}

dyd_status dyd_sphere_simulate(dyd_survey_trial *out, dyd_sphere *s, size_t count, uint64_t seed, const char *accuracy,
                               const dyd_survey_options *options, dyd_error *err) {
  if (!s || (count && !out)) return dyd_fail_null(err);
  const globe_trials how = {s, accuracy};
  DYD_OWNED(dyd_survey) *first = NULL;
  dyd_trials t = {
      .out = out, .count = count, .seed = seed, .sites = s->count, .step = globe_step, .end = globe_end, .user = &how};
  for (size_t k = 0; k < count; k++) out[k] = (dyd_survey_trial){0};
  dyd_status st = dyd_abi_take(&t.options, sizeof t.options, options, "dyd_survey_options", err);
  if (st == DYD_OK) st = dyd_sphere_survey(&first, s, accuracy, &t.options, err);
  t.first = first;
  return st == DYD_OK ? dyd_trials_run(&t, 1, err) : st; /* FLINT keeps memory of each thread */
}
