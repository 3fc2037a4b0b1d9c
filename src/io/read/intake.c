/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows of input to staged points: fields that are missing, decimal commas, radii, places given more than once. */
#include "io/read/intake.h"

#include "base/alloc.h"
#include "base/error.h"
#include <math.h>
#include <string.h>

/* ---- radii ---- */

/* mpq_get_d rounds towards zero. */
static double radius_above(const mpq_t radius) {
  mpq_t back;
  double down = mpq_get_d(radius);
  mpq_init(back);
  if (isfinite(down)) mpq_set_d(back, down);
  bool exact = mpq_equal(back, radius);
  mpq_clear(back);
  return exact ? down : nextafter(down, INFINITY);
}

/* Beyond doubles the radius goes the general way. */
static void manner_set_radius(dyd_manner *m, const mpq_t radius) {
  mpq_set(m->radius, radius);
  m->widen = mpq_sgn(radius) > 0;
  m->radius_up = radius_above(radius);
}

static dyd_status radius_fail(const dyd_intake *in, const dyd_span *span, dyd_error *err) {
  return dyd_span_fail(
      err, span, 0,
      in->o->degrees ? "the radius is not an exact number >= 0 and a unit; give one such as 0.01deg, 30m or 2km"
                     : "the radius is not an exact number >= 0; give one such as 0.01 or 1/64 (units: with `sphere`)");
}

static dyd_status radius_fail_unit(const dyd_span *span, dyd_error *err) {
  char message[160];
  snprintf(message, sizeof message, "the radius %.*s has no unit; state a unit: `radius_unit` m (" DYD_UNIT_NAMES ")",
           (int)(span->length < 20 ? span->length : 20), span->text);
  dyd_span_fail(err, span, 0, message);
  return DYD_E_ARG;
}

/* Of a field: out, scaled; *ground: in metres. */
static dyd_status intake_read_radius(mpq_t out, bool *ground, const dyd_intake *in, const dyd_span *span,
                                     dyd_error *err) {
  *ground = false;
  dyd_status st = in->o->degrees ? dyd_radius_parse(out, ground, span->text, span->length, in->unit)
                                 : dyd_real_parse_exact(out, span->text, span->length);
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st == DYD_E_DOMAIN) return radius_fail_unit(span, err);
  if (st == DYD_OK) mpq_mul(out, out, in->scale);
  return st != DYD_OK || mpq_sgn(out) < 0 ? radius_fail(in, span, err) : DYD_OK;
}

/* Each row with columns of radii has its own: what they say is added to the radius of all points, or kept. */
static dyd_status intake_radius(dyd_intake *in, int axis, const dyd_span *span, dyd_error *err) {
  mpq_t own;
  bool ground;
  mpq_init(own);
  dyd_status st = intake_read_radius(own, &ground, in, span, err);
  if (st == DYD_OK) {
    bool keep = ground || in->o->keep_radii;
    in->kept[axis] = keep ? radius_above(own) : 0;
    if (keep) mpq_set_ui(own, 0, 1);
    mpq_add(own, own, in->radius);
    manner_set_radius(&in->manner[axis], own);
  }
  mpq_clear(own);
  if (st == DYD_OK && !isfinite(in->kept[axis]))
    st = dyd_span_fail(err, span, 0, "the radius is above the range of doubles, about 1.8e308; give a smaller one");
  if (st == DYD_OK && axis && in->kept[0] != in->kept[1])
    st = dyd_span_fail(err, span, 0,
                       "the radii in x and in y differ, and here a point has one; name one column of them");
  return st;
}

/* The radius of all points, the unit and the scale. */
static dyd_status intake_radius_of_all(dyd_intake *in, dyd_error *err) {
  const char *text = in->o->radius, *unit = in->o->radius_unit, *scale = in->o->radius_scale;
  mpq_set_ui(in->scale, 1, 1);
  dyd_status st = dyd_unit_take(&in->unit, in->scale, unit, scale, err);
  if (st != DYD_OK) return st;
  if (unit && !in->o->degrees)
    return dyd_fail(err, DYD_E_ARG,
                    "in the plane radii are in the unit of the coordinates; for others scale them, such as millimetres "
                    "where coordinates are metres: `radius_scale` 0.001");
  st = text ? dyd_real_parse_exact(in->radius, text, strlen(text)) : DYD_OK;
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st != DYD_OK || mpq_sgn(in->radius) < 0)
    return dyd_fail(
        err, DYD_E_ARG,
        "the radius \"%.60s\" is not an exact number >= 0; give one such as 0.01 or 1/64 (units: with `sphere`)", text);
  mpq_mul(in->radius, in->radius, in->scale);
  for (int a = 0; a < 2; a++) manner_set_radius(&in->manner[a], in->radius);
  return DYD_OK;
}

/* what: "the cost". */
static dyd_status intake_number(double *out, const dyd_span *span, const char *what, dyd_error *err) {
  char message[160];
  mpq_t own;
  mpq_init(own);
  dyd_status st = dyd_real_parse_exact(own, span->text, span->length);
  *out = st == DYD_OK ? mpq_get_d(own) : 0;
  mpq_clear(own);
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (*out > 0 && isfinite(*out)) return DYD_OK;
  snprintf(message, sizeof message, "%s is not an exact number above 0; give one such as 2 or 0.5", what);
  return dyd_span_fail(err, span, 0, message);
}

/* ---- life ---- */

static dyd_status intake_check(const dyd_read_options *o, dyd_error *err) {
  const char *about = o->id               ? "`id`"
                      : o->radius_columns ? "`radius_columns`"
                      : o->cost_column    ? "`cost_column`"
                      : o->sigma_column   ? "`sigma_column`"
                      : o->delimiter      ? "`delimiter`"
                                          : NULL;
  if (o->columns || !about) return DYD_OK;
  return dyd_fail(err, DYD_E_ARG, "%s is about columns; name those of x and y, too: `columns` NAME,NAME", about);
}

dyd_status dyd_intake_init(dyd_intake *in, const dyd_read_options *o, dyd_error *err) {
  *in = (dyd_intake){.o = o, .report = {DYD_SIZED(dyd_read_report)}};
  mpq_inits(in->radius, in->scale, NULL);
  for (int a = 0; a < 2; a++) {
    in->manner[a].measured = o->measured;
    mpq_init(in->manner[a].radius);
  }
  dyd_stage_init(&in->stage);
  dyd_status st = intake_check(o, err);
  return st == DYD_OK ? intake_radius_of_all(in, err) : st;
}

void dyd_intake_clear(dyd_intake *in) {
  free(in->plain);
  dyd_nominals_clear(&in->places);
  dyd_labels_clear(&in->labels);
  dyd_stage_clear(&in->stage);
  for (int a = 0; a < 2; a++) mpq_clear(in->manner[a].radius);
  mpq_clears(in->radius, in->scale, NULL);
}

/* Do points have what stands beside their rectangles? */
static bool intake_numbers(const dyd_intake *in) {
  const dyd_read_options *o = in->o;
  return o->cost_column || o->sigma_column || (o->radius_columns && (o->keep_radii || o->degrees));
}

/* Or rows and points may differ, or points have identifiers. */
static bool intake_labels(const dyd_intake *in) {
  return in->o->id || in->o->skip_missing || in->o->merge || intake_numbers(in);
}

/* ---- fields ---- */

static bool is_word(const char *text, size_t length, const char *word) {
  if (length != strlen(word)) return false;
  for (size_t k = 0; k < length; k++)
    if ((text[k] | 0x20) != word[k]) return false;
  return true;
}

/* Nothing, NA, NaN (printf signs it) or null, in any case. */
static bool is_missing(const dyd_span *s) {
  size_t sign = s->length && (*s->text == '-' || *s->text == '+');
  return !s->length || is_word(s->text, s->length, "na") || is_word(s->text, s->length, "null") ||
         is_word(s->text + sign, s->length - sign, "nan");
}

static dyd_status fail_missing_field(const dyd_span *s, dyd_csv_role role, dyd_error *err) {
  char message[160];
  const char *what = role == DYD_CSV_COST       ? "cost"
                     : role == DYD_CSV_SIGMA    ? "standard deviation"
                     : role >= DYD_CSV_RADIUS_X ? "radius"
                                                : "coordinate";
  if (s->length)
    snprintf(message, sizeof message, "the %s is missing (%.*s); fill it in, or leave such rows out: `skip_missing`",
             what, (int)s->length, s->text);
  else
    snprintf(message, sizeof message, "the %s is empty; fill it in, or leave such rows out: `skip_missing`", what);
  return dyd_span_fail(err, s, 0, message);
}

/* A comma in such a field is a decimal comma; within brackets it separates. */
static bool has_comma(const dyd_span *s) {
  return s->length && memchr(s->text, ',', s->length) && !memchr(s->text, '(', s->length) &&
         !memchr(s->text, '[', s->length);
}

/* Copies of fields with commas get points in their place. */
static dyd_status take_commas(dyd_intake *in, dyd_span span[DYD_CSV_ROLES], dyd_error *err) {
  size_t size = 0;
  for (int k = 0; k < DYD_CSV_ID; k++) size += span[k].length;
  if (!dyd_reserve((void **)&in->plain, &in->plain_cap, size + 1, 1)) return dyd_fail_nomem(err);
  char *at = in->plain;
  for (int k = 0; k < DYD_CSV_ID; k++) {
    if (!has_comma(&span[k])) continue;
    memcpy(at, span[k].text, span[k].length);
    span[k].text = at;
    for (char *end = at + span[k].length; at < end; at++)
      if (*at == ',') *at = '.';
  }
  return DYD_OK;
}

/* Behind what is wrong with a coordinate, where a comma may be the reason. */
static dyd_status hint_comma(dyd_status st, const dyd_intake *in, const dyd_span *s, dyd_error *err) {
  size_t length = strlen(err->message);
  if (st == DYD_E_PARSE && !in->o->decimal_comma && has_comma(s))
    snprintf(err->message + length, sizeof err->message - length,
             "; where commas stand for decimal points, give `decimal_comma`");
  return st;
}

/* ---- places given more than once ---- */

/* The width that the coordinate has in the end, about. */
static double final_width(const dyd_coordinate *c, const dyd_manner *manner) {
  if (c->kind == DYD_COORDINATE_BOX) return c->hi - c->lo;
  if (c->kind != DYD_COORDINATE_REAL) return 0;
  if (!dyd_real_is_final(c->real)) return manner->widen ? 2 * manner->radius_up : 0;
  double end[2];
  dyd_interval_get_d(&end[0], &end[1], dyd_real_interval(c->real));
  return end[1] - end[0];
}

/* A rectangle inside both is that of the smaller width in each coordinate, as they have their centre in common. A
 * radius that is kept goes with its rectangle: of rows with different ones, one is taken, inside the other if it can
 * be. */
static dyd_status intake_merge(dyd_intake *in, dyd_nominal *place, dyd_coordinate c[2], const double width[2],
                               dyd_error *err) {
  size_t point = place->point;
  double *kept = &in->labels.number[point].of[DYD_ROW_RADIUS];
  bool less = in->kept[0] < *kept && width[0] <= place->width[0] && width[1] <= place->width[1];
  bool same = in->kept[0] == *kept;
  const bool take[2] = {(same || less) && width[0] < place->width[0], (same || less) && width[1] < place->width[1]};
  if (less) *kept = in->kept[0];
  for (int a = 0; a < 2; a++)
    if (take[a]) place->width[a] = width[a];
  dyd_status st = dyd_stage_replace(&in->stage, point, &c[0], &c[1], take, err);
  if (st != DYD_OK) return st;
  in->report.merged++;
  return dyd_labels_merge(&in->labels, point) ? DYD_OK : dyd_fail_nomem(err);
}

/* Stages a point that is read; takes over reals, also on failure. */
static dyd_status intake_point(dyd_intake *in, const dyd_span span[DYD_CSV_ROLES], dyd_coordinate c[2],
                               dyd_error *err) {
  const double width[2] = {final_width(&c[0], &in->manner[0]), final_width(&c[1], &in->manner[1])};
  dyd_nominal *place = NULL;
  const dyd_span *id = &span[DYD_CSV_ID], *cost = &span[DYD_CSV_COST], *sigma = &span[DYD_CSV_SIGMA];
  dyd_row_numbers own = dyd_no_row_numbers;
  if (in->o->merge || width[0] > 0 || width[1] > 0 || (in->o->degrees && in->kept[0] > 0)) {
    if (dyd_nominals_find(&place, &in->places, span) != DYD_OK) {
      for (int a = 0; a < 2; a++) dyd_coordinate_clear(&c[a]);
      return dyd_fail_nomem(err);
    }
    if (place->count > 1 && in->o->merge) return intake_merge(in, place, c, width, err);
    if (place->count > 1) in->report.shared += place->count == 2 ? 2 : 1;
    if (place->count == 1) place->point = in->stage.count;
    if (place->count == 1) memcpy(place->width, width, sizeof width);
  }
  dyd_status st = dyd_stage_add(&in->stage, &c[0], &c[1], err);
  if (st != DYD_OK || !intake_labels(in)) return st;
  own.of[DYD_ROW_RADIUS] = in->kept[0];
  if (cost->text) st = intake_number(&own.of[DYD_ROW_COST], cost, "the cost", err);
  if (st == DYD_OK && sigma->text) st = intake_number(&own.of[DYD_ROW_SIGMA], sigma, "the standard deviation", err);
  if (st != DYD_OK) return st;
  return dyd_labels_add(&in->labels, id->text, id->length, &own) ? DYD_OK : dyd_fail_nomem(err);
}

/* ---- rows ---- */

/* Is all of the coordinate beyond 90? Of computable numbers that is not known yet. */
static bool is_beyond_poles(const dyd_coordinate *c) {
  double lo = c->lo, hi = c->hi;
  if (c->kind == DYD_COORDINATE_PLAIN) return dyd_plain_get_rounded(&lo, c->plain, DYD_UP) && fabs(lo) > 90;
  if (c->kind == DYD_COORDINATE_REAL && !dyd_real_is_final(c->real)) return false;
  if (c->kind == DYD_COORDINATE_REAL) dyd_interval_get_d(&lo, &hi, dyd_real_interval(c->real));
  return lo > 90 || hi < -90;
}

static dyd_status intake_skip(dyd_intake *in, const dyd_span *s, dyd_csv_role role, dyd_error *err) {
  if (!in->o->skip_missing) return fail_missing_field(s, role, err);
  in->report.missing++;
  dyd_labels_skip(&in->labels);
  return DYD_OK;
}

dyd_status dyd_intake_row(dyd_intake *in, dyd_span span[DYD_CSV_ROLES], dyd_error *err) {
  dyd_coordinate c[2] = {{.kind = DYD_COORDINATE_DOUBLE}, {.kind = DYD_COORDINATE_DOUBLE}};
  dyd_status st = DYD_OK;
  in->report.rows++;
  for (int k = 0; k < DYD_CSV_ID; k++)
    if (span[k].text && is_missing(&span[k])) return intake_skip(in, &span[k], (dyd_csv_role)k, err);
  if (in->o->decimal_comma) st = take_commas(in, span, err);
  for (int a = 0; st == DYD_OK && a < 2; a++) {
    if (span[DYD_CSV_RADIUS_X + a].text) st = intake_radius(in, a, &span[DYD_CSV_RADIUS_X + a], err);
    if (st == DYD_OK) st = hint_comma(dyd_coordinate_read(&c[a], &span[a], &in->manner[a], err), in, &span[a], err);
  }
  if (st == DYD_OK && in->o->degrees && is_beyond_poles(&c[1]))
    st = dyd_span_fail(err, &span[1], 0, "the latitude is beyond 90 degrees; longitude comes first, then latitude");
  if (st == DYD_OK) return intake_point(in, span, c, err);
  dyd_coordinate_clear(&c[1]);
  dyd_coordinate_clear(&c[0]);
  return st;
}

dyd_status dyd_intake_commit(dyd_engine *e, dyd_intake *in, dyd_error *err) {
  const dyd_labels *own = &in->labels;
  dyd_labels all = {0};
  bool labelled = own->has_ids || intake_numbers(in) || in->report.missing || in->report.merged;
  if (labelled && dyd_labels_join(&all, e, own) != DYD_OK) return dyd_fail_nomem(err);
  dyd_status st = dyd_stage_commit(e, &in->stage, err);
  if (st == DYD_OK && labelled)
    dyd_labels_give(e, &all);
  else
    dyd_labels_clear(&all);
  return st;
}
