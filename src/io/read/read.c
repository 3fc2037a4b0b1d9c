/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reads points from a file into an engine, in one pass over the text.
 *
 * Each row of either layout becomes a staged point: missing fields, decimal commas, radii and places that are given
 * more than once are handled here. Staged points are kept back until the whole file is read, so that bad input adds
 * nothing.
 */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "dyadic/numeral.h"
#include "engine/labels.h"
#include "engine/points.h"
#include "io/read/cell.h"
#include "io/read/csv.h"
#include "io/read/stage.h"
#include "io/read/twins.h"
#include "rect/rect.h"
#include "stream/degrees.h"
#include "stream/real.h"

#include <dyadel/io.h>
#include <dyadel/stream.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

/* ---- rows ---- */

/* A point is widened by k times this: in x and y, or, as a length on the ground, in metres. */
typedef struct spread {
  double of[2];
  bool ground;
} spread;

/* A row of a point that others may give, too. cells: where its texts are, role by role, each terminated; "" where there
 * is none, "\1" where it is that of the role before. next: the next row of the point. */
typedef struct sighting {
  size_t cells, length, next;
  size_t row, line, column;
} sighting;

/* Invariant: every row so far is in report.rows, and, where labels are kept, in labels; sigma[] has each staged point
 * where there is a confidence. */
typedef struct intake {
  const dyd_read_options *o;          /* borrowed */
  mpq_t radius, scale;                /* of all points; of what columns hold */
  const dyd_unit *unit[DYD_CSV_MOST]; /* of radii that state none, by role, on the sphere; NULL: there is none */
  dyd_manner manner[2];               /* of x and y in the present row */
  double kept[2];                     /* radii of this row that do not widen it, rounded up */
  bool ground;                        /* the last radius is a length on the ground */
  const char *radius_at;              /* the place of the last radius */
  dyd_stage stage;
  spread *sigma, row;          /* row: of the present row */
  size_t sigma_cap, uncertain; /* uncertain: rows with a standard deviation above 0 */
  dyd_labels labels;
  dyd_place_keys places, ids;
  sighting *seen; /* by merge_by, rows with an identifier */
  size_t sightings, seen_cap;
  char *cells; /* theirs */
  size_t cells_used, cells_cap;
  dyd_read_report report;
  dyd_style style;
  int roles;                 /* numbers that rows have are in columns of smaller roles */
  const dyd_file_kind *kind; /* of a cell that is not a coordinate; NULL: none */
  bool numbers;              /* points have numbers beside their rectangles */
  char srid[12];             /* of the first geometry that has one; "": none */
  char *label;               /* identifier and carried texts of the present row, a NUL between two */
  size_t label_length, label_cap;
} intake;

/* ---- radii ---- */

static dyd_status radius_fail(const intake *in, const dyd_span *span, int role, dyd_error *err) {
  char message[DYD_MESSAGE_SIZE];
  if (span->length > 1 && span->text[0] == '-' && strchr(".0123456789", span->text[1])) {
    snprintf(message, sizeof message,
             "the %s is negative; if this means unknown, leave such rows out: `missing` '%.*s' `skip_missing`",
             dyd_role_holds(role), (int)(span->length < 20 ? span->length : 20), span->text);
    return dyd_span_fail(err, span, 0, message);
  }
  if (!in->o->degrees && dyd_cell_number(span))
    return dyd_span_fail(err, span, dyd_cell_number(span),
                         "radii in the plane are in the unit of the coordinates: write the number without a unit, or "
                         "convert all by `radius_scale`");
  const char *remedy = dyd_cell_remedy(span);
  snprintf(message, sizeof message, "the %s is not an exact number >= 0%s", dyd_role_holds(role),
           remedy           ? remedy
           : in->o->degrees ? " and a unit; give one such as 0.01deg, 30m or 2km"
                            : "; give one such as 0.01 or 1/64 (units: with `sphere`)");
  return dyd_span_fail(err, span, 0, message);
}

static dyd_status radius_fail_unit(const dyd_span *span, int role, dyd_error *err) {
  char message[180];
  snprintf(message, sizeof message, "the %s %.*s has no unit; state a unit: `radius_unit` m (" DYD_UNIT_NAMES ")",
           dyd_role_holds(role), (int)(span->length < 20 ? span->length : 20), span->text);
  dyd_span_fail(err, span, 0, message);
  if (err) err->code = DYD_E_ARG; /* with its place */
  return DYD_E_ARG;
}

/* Of a field: out, scaled; *ground: in metres. */
static dyd_status intake_read_radius(mpq_t out, bool *ground, const intake *in, const dyd_span *span, int role,
                                     dyd_error *err) {
  *ground = false;
  dyd_status st = in->o->degrees ? dyd_radius_parse(out, ground, span->text, span->length, in->unit[role])
                                 : dyd_real_parse_exact(out, span->text, span->length);
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st == DYD_E_DOMAIN) return radius_fail_unit(span, role, err);
  if (st == DYD_OK) mpq_mul(out, out, in->scale);
  return st != DYD_OK || mpq_sgn(out) < 0 ? radius_fail(in, span, role, err) : DYD_OK;
}

/* Of the disc around a box of lengths: at least sqrt(a^2 + b^2), which is m sqrt(1 + (n/m)^2) for the larger m and the
 * smaller n; the factor is more than what the five operations lose, but for the smallest numbers. */
static double radius_of_both(double a, double b) {
  double m = fmax(a, b), n = fmin(a, b);
  return m > 0 ? nextafter(m * sqrt(1 + n / m * (n / m)) * (1 + 0x1p-50), INFINITY) : 0;
}

/* Each row with columns of radii has its own: its value is added to the radius of all points, or kept. */
static dyd_status intake_radius(intake *in, int axis, const dyd_span *span, dyd_error *err) {
  bool ground = false;
  DYD_LOCAL_NUMBERS(mpq, own);
  dyd_status st = intake_read_radius(own, &ground, in, span, DYD_CSV_RADIUS_X + axis, err);
  if (st == DYD_OK) {
    bool keep = ground || in->o->keep_radii;
    in->kept[axis] = keep ? dyd_double_above(own) : 0;
    if (keep) mpq_set_ui(own, 0, 1);
    mpq_add(own, own, in->radius);
    dyd_manner_set_radius(&in->manner[axis], own);
  }
  if (st == DYD_OK && !isfinite(in->kept[axis]))
    st = dyd_span_fail(err, span, 0, "the radius is above the range of doubles, about 1.8e308; give a smaller one");
  const bool apart = axis && span->at != in->radius_at;
  if (st == DYD_OK && apart && ground && in->ground)
    in->kept[0] = in->kept[1] = radius_of_both(in->kept[0], in->kept[1]);
  in->ground = ground;
  in->radius_at = span->at;
  if (st == DYD_OK && axis && in->kept[0] != in->kept[1])
    st = dyd_span_fail(err, span, 0,
                       "the radii in x and in y differ, and here a point has one; name one column of them");
  return st;
}

/* The radius of all points, the unit and the scale. */
static dyd_status intake_radius_of_all(intake *in, dyd_error *err) {
  const char *text = in->o->radius, *unit = in->o->radius_unit, *scale = in->o->radius_scale;
  mpq_set_ui(in->scale, 1, 1);
  const dyd_unit *of_all = NULL;
  dyd_status st = dyd_unit_take(&of_all, in->scale, unit, scale, err);
  if (st != DYD_OK) return st;
  for (int role = 0; role < DYD_CSV_MOST; role++) in->unit[role] = of_all;
  if (unit && !in->o->degrees)
    return dyd_fail(err, DYD_E_ARG,
                    "in the plane radii are in the unit of the coordinates; for others scale them, such as millimetres "
                    "where coordinates are metres: `radius_scale` 0.001");
  st = text ? dyd_real_parse_exact(in->radius, text, strlen(text)) : DYD_OK;
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st != DYD_OK || mpq_sgn(in->radius) < 0)
    return dyd_fail(err, DYD_E_ARG,
                    dyd_cell_number(&(dyd_span){.text = text, .length = strlen(text)})
                        ? "the radius \"%.60s\" has a unit, but radii in the plane are in the unit of the coordinates: "
                          "give a number"
                        : "the radius \"%.60s\" is not an exact number >= 0; give one such as 0.01 or 1/64",
                    text);
  mpq_mul(in->radius, in->radius, in->scale);
  for (int a = 0; a < 2; a++) dyd_manner_set_radius(&in->manner[a], in->radius);
  return DYD_OK;
}

/* ---- normal errors ---- */

static dyd_status read_rho(mpq_t rho, const dyd_span *span, dyd_error *err) {
  dyd_status st = span->text ? dyd_real_parse_exact(rho, span->text, span->length) : DYD_OK;
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st == DYD_OK && mpq_cmp_si(rho, 1, 1) <= 0 && mpq_cmp_si(rho, -1, 1) >= 0) return DYD_OK;
  return dyd_span_fail(err, span, 0, "the correlation is not an exact number from -1 to 1; give one such as 0.3");
}

/* Sets in->row from the columns of standard deviations and the correlation. */
static dyd_status intake_sigma(intake *in, const dyd_span *span, dyd_error *err) {
  mpq_t s[2], rho;
  bool ground[2];
  mpq_inits(s[0], s[1], rho, NULL);
  dyd_status st = read_rho(rho, &span[2], err);
  for (int a = 0; a < 2 && st == DYD_OK; a++)
    st = intake_read_radius(s[a], &ground[a], in, &span[a], DYD_ROLE_SIGMA + a, err);
  if (st == DYD_OK && ground[0] != ground[1] && mpq_sgn(s[0]) && mpq_sgn(s[1]))
    st = dyd_span_fail(err, &span[1], 0,
                       "one standard deviation is a length, the other an angle; give both in units of one kind");
  if (st == DYD_OK) {
    in->row = (spread){.ground = ground[0] || ground[1]};
    bool disc = in->o->round || in->row.ground;
    for (int a = 0; a < 2; a++) in->row.of[a] = disc ? dyd_sigma_round(s, rho) : dyd_double_above(s[a]);
    in->uncertain += mpq_sgn(s[0]) || mpq_sgn(s[1]);
    if (!isfinite(in->row.of[0]) || !isfinite(in->row.of[1]))
      st = dyd_span_fail(err, span, 0, "the standard deviation is above the range of doubles; give a smaller one");
  }
  mpq_clears(s[0], s[1], rho, NULL);
  return st;
}

/* Remembers in->row for the point that was staged last. */
static dyd_status intake_keep_sigma(intake *in, dyd_error *err) {
  if (!in->o->confidence) return DYD_OK;
  if (!DYD_GROW(in->sigma, in->sigma_cap, in->stage.count)) return dyd_fail_nomem(err);
  in->sigma[in->stage.count - 1] = in->row;
  return DYD_OK;
}

/* Widens all staged points by k standard deviations. */
static dyd_status intake_confide(intake *in, double k, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t p = 0; st == DYD_OK && p < in->stage.count; p++) {
    const spread *s = &in->sigma[p];
    double by[2];
    for (int a = 0; a < 2; a++) by[a] = s->of[a] > 0 ? nextafter(k * s->of[a], INFINITY) : 0;
    if (!isfinite(by[0]) || !isfinite(by[1]))
      return dyd_fail(err, DYD_E_PARSE,
                      "%g standard deviations of point %zu are above the range of doubles; give smaller ones", k, p);
    if (!s->ground) {
      st = dyd_stage_widen(&in->stage, p, by, err);
    } else {
      double *kept = &in->labels.number[p].of[DYD_ROW_RADIUS];
      *kept = *kept > 0 ? nextafter(*kept + by[0], INFINITY) : by[0];
    }
  }
  return st;
}

static dyd_status intake_number(double *out, const dyd_span *span, int role, dyd_error *err) {
  char message[160];
  DYD_LOCAL_NUMBERS(mpq, own);
  dyd_status st = dyd_real_parse_exact(own, span->text, span->length);
  *out = st == DYD_OK ? mpq_get_d(own) : 0;
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (*out > 0 && isfinite(*out)) return DYD_OK;
  snprintf(message, sizeof message, "the %s is not an exact number above 0; give one such as 2 or 0.5",
           dyd_role_holds(role));
  return dyd_span_fail(err, span, 0, message);
}

/* ---- life ---- */

static dyd_status intake_check(const dyd_read_options *o, dyd_error *err) {
  const dyd_read_field *f;
  const char *value;
  for (size_t k = 0; !o->columns && (f = dyd_read_field_at(&value, o, k)); k++) {
    if (f->table && value)
      return dyd_fail(err, DYD_E_ARG, "`%s` is about columns; name those of x and y, too: `columns` NAME,NAME",
                      f->name);
  }
  if (o->confidence && !o->sigma_column)
    return dyd_fail(err, DYD_E_ARG,
                    "`confidence` is about normal errors; name the column of their standard deviations: `sigma_column` "
                    "NAME");
  if (o->sigma_column && !o->confidence && strchr(o->sigma_column, ',') && *o->sigma_column != '"')
    return dyd_fail(err, DYD_E_ARG,
                    "\"%.100s\" is not one column name; give NAME, or regions a probability: "
                    "`confidence` 95%%",
                    o->sigma_column);
  if (!o->merge_by) return DYD_OK;
  if (strcmp(o->merge_by, "id") != 0)
    return dyd_fail(err, DYD_E_ARG,
                    "\"%.60s\" is not id; rows are merged by the column of identifiers: `id` NAME and "
                    "`merge_by` id",
                    o->merge_by);
  if (!o->id) return dyd_fail(err, DYD_E_ARG, "`merge_by` id: name the column of identifiers, too: `id` NAME");
  if (o->merge)
    return dyd_fail(err, DYD_E_ARG,
                    "rows are merged by their identifiers or by their coordinates: leave `merge` or "
                    "`merge_by` out");
  if (o->confidence && o->degrees)
    return dyd_fail(err, DYD_E_ARG,
                    "means of rows are those of a plane: with `merge_by` and `confidence` give projected "
                    "coordinates");
  return DYD_OK;
}

/* DYD_E_ARG when the options are not of their form; intake_clear comes after it in any case. */
static dyd_status intake_init(intake *in, const dyd_read_options *o, dyd_error *err) {
  *in = (intake){.o = o, .report = {DYD_SIZED(dyd_read_report)}};
  mpq_inits(in->radius, in->scale, NULL);
  for (int a = 0; a < 2; a++) {
    in->manner[a].measured = o->measured;
    mpq_init(in->manner[a].radius);
  }
  in->numbers = o->radius_columns && (o->keep_radii || o->degrees); /* sigmas of metres: by their column, below */
  in->roles = DYD_CSV_Y + 1;
  const dyd_read_option *r;
  const char *value;
  for (size_t k = 0; (r = dyd_read_option_at(&value, o, k)); k++) {
    if (!value || !r->most || r->role >= DYD_ROLE_ID) continue;
    if (in->roles < r->role + (int)r->most) in->roles = r->role + (int)r->most;
    if (r->role >= DYD_ROLE_NUMBER) in->numbers = true;
  }
  dyd_status st = intake_check(o, err);
  if (st == DYD_OK) st = dyd_style_read(&in->style, o, err);
  return st == DYD_OK ? intake_radius_of_all(in, err) : st;
}

static void intake_clear(intake *in) {
  free(in->label);
  dyd_style_clear(&in->style);
  dyd_free_all(in->sigma, in->seen, in->cells);
  dyd_places_clear(&in->ids);
  dyd_places_clear(&in->places);
  dyd_labels_clear(&in->labels);
  dyd_stage_clear(&in->stage);
  for (int a = 0; a < 2; a++) mpq_clear(in->manner[a].radius);
  mpq_clears(in->radius, in->scale, NULL);
}

/* Returns true if rows and points may differ, or points have identifiers or numbers. */
static bool intake_labels(const intake *in) {
  return in->o->id || in->o->carry || in->o->skip_missing || in->o->merge || in->numbers;
}

/* false, with *err filled: reading takes more memory than `max_bytes`. The engine gets a copy of the labels. */
static bool intake_has_room(const intake *in, dyd_error *err) {
  dyd_memory memory = {.most = in->o->max_bytes};
  uint64_t bytes = in->stage.bytes + 2 * dyd_labels_bytes(&in->labels) + dyd_places_bytes(&in->places) +
                   dyd_places_bytes(&in->ids) + in->cells_used + in->sightings * sizeof *in->seen +
                   (in->sigma ? in->stage.count * sizeof *in->sigma : 0);
  return dyd_memory_has(&memory, bytes, "reading the points") || (dyd_fail_memory(err, &memory), false);
}

/* ---- fields ---- */

static dyd_status fail_missing_field(const dyd_span *s, int role, dyd_error *err) {
  char message[160];
  const char *what = dyd_role_holds(role);
  if (s->length)
    snprintf(message, sizeof message, "the %s is missing (%.*s); fill it in, or leave such rows out: `skip_missing`",
             what, (int)s->length, s->text);
  else
    snprintf(message, sizeof message, "the %s is empty; fill it in, or leave such rows out: `skip_missing`", what);
  return dyd_span_fail(err, s, 0, message);
}

/* ---- places given more than once ---- */

/* The width that the coordinate has in the end, about; with a standard deviation of such. */
static double final_width(const dyd_coordinate *c, const dyd_manner *manner, double sigma) {
  sigma *= 2;
  if (c->kind == DYD_COORDINATE_BOX || c->kind == DYD_COORDINATE_SPAN) return c->hi - c->lo + sigma;
  if (c->kind != DYD_COORDINATE_REAL) return sigma;
  if (!dyd_real_is_final(c->real)) return (manner->widen ? 2 * dyd_double_above(manner->radius) : 0) + sigma;
  double end[2];
  if (dyd_interval_is_point(dyd_real_interval(c->real))) return sigma;
  dyd_interval_get_d(&end[0], &end[1], dyd_real_interval(c->real));
  return end[1] - end[0] + sigma;
}

/* A rectangle inside both is that of the smaller width in each coordinate, as they have their centre in common. A
 * radius that is kept goes with its rectangle: of rows with different ones, one is taken, inside the other if it can
 * be. */
static dyd_status intake_merge(intake *in, dyd_place_key *place, dyd_coordinate c[2], const double width[2],
                               dyd_error *err) {
  size_t point = place->point;
  double *kept = &in->labels.number[point].of[DYD_ROW_RADIUS];
  bool less = in->kept[0] < *kept && width[0] <= place->width[0] && width[1] <= place->width[1];
  bool same = in->kept[0] == *kept;
  bool take[2] = {(same || less) && width[0] < place->width[0], (same || less) && width[1] < place->width[1]};
  if (in->o->confidence) /* a width is that of a row's errors: the one row or the other */
    take[0] = take[1] = less = in->kept[0] <= *kept && width[0] <= place->width[0] && width[1] <= place->width[1];
  if (less) *kept = in->kept[0];
  for (int a = 0; a < 2; a++)
    if (take[a]) place->width[a] = width[a];
  if (in->o->confidence && take[0]) in->sigma[point] = in->row;
  dyd_status st = dyd_stage_replace(&in->stage, point, &c[0], &c[1], take, err);
  if (st != DYD_OK) return st;
  in->report.merged++;
  return dyd_labels_merge(&in->labels, point) ? DYD_OK : dyd_fail_nomem(err);
}

/* Remembers the present row, of the identifier. */
static dyd_status intake_see(intake *in, dyd_place_key *id, const dyd_span span[DYD_CSV_MOST], dyd_error *err) {
  sighting s = {.cells = in->cells_used, .row = in->report.rows - 1};
  for (int k = 0; k < in->roles; k++) {
    bool same = k && span[k].text && span[k].at == span[k - 1].at;
    size_t length = same ? 1 : span[k].text ? span[k].length : 0;
    if (!dyd_reserve((void **)&in->cells, &in->cells_cap, in->cells_used + length + 1, 1)) return dyd_fail_nomem(err);
    if (length) memcpy(in->cells + in->cells_used, same ? "\1" : span[k].text, length);
    in->cells_used += length;
    in->cells[in->cells_used++] = 0;
  }
  s.length = in->cells_used - s.cells;
  dyd_span_position(&s.line, &s.column, &span[0], 0);
  if (!DYD_GROW(in->seen, in->seen_cap, in->sightings + 1)) return dyd_fail_nomem(err);
  if (id->count == 1)
    id->row[0] = in->sightings, id->point = in->stage.count;
  else
    in->seen[id->row[1]].next = in->sightings;
  id->row[1] = in->sightings;
  in->seen[in->sightings++] = s;
  return DYD_OK;
}

/* Finds the identifier of the present row and raises its count; NULL: it has none. */
static dyd_status intake_id(dyd_place_key **out, intake *in, const dyd_span *id, dyd_error *err) {
  *out = NULL;
  return !id->length || dyd_places_find_id(out, &in->ids, id) == DYD_OK ? DYD_OK : dyd_fail_nomem(err);
}

/* *again: the present row is that of an earlier point, which takes it. */
static dyd_status intake_merge_id(bool *again, intake *in, const dyd_span span[DYD_CSV_MOST], dyd_error *err) {
  dyd_place_key *id;
  dyd_status st = intake_id(&id, in, &span[DYD_ROLE_ID], err);
  if (st == DYD_OK && id) st = intake_see(in, id, span, err);
  *again = st == DYD_OK && id && id->count > 1;
  if (!*again) return st;
  in->report.merged++;
  return dyd_labels_merge(&in->labels, id->point) ? DYD_OK : dyd_fail_nomem(err);
}

/* Another point has the identifier of the present row. */
static dyd_status intake_note_id(intake *in, const dyd_span *span, dyd_error *err) {
  dyd_place_key *id;
  dyd_status st = intake_id(&id, in, span, err);
  if (st != DYD_OK || !id) return st;
  if (id->count == 1)
    id->row[0] = in->report.rows - 1;
  else if (!in->report.repeated++)
    in->report.repeat[0] = id->row[0], in->report.repeat[1] = in->report.rows - 1;
  return DYD_OK;
}

/* Stages a point that is read; takes over reals, also on failure. */
static dyd_status intake_point(intake *in, const dyd_span span[DYD_CSV_MOST], dyd_coordinate c[2], dyd_error *err) {
  const double width[2] = {final_width(&c[0], &in->manner[0], in->row.of[0]),
                           final_width(&c[1], &in->manner[1], in->row.of[1])};
  dyd_place_key *place = NULL;
  const dyd_span *id = &span[DYD_ROLE_ID];
  dyd_row_numbers own = dyd_no_row_numbers;
  bool again = false;
  dyd_status st = in->o->merge_by ? intake_merge_id(&again, in, span, err) : DYD_OK;
  if (again || st != DYD_OK) {
    for (int a = 0; a < 2; a++) dyd_coordinate_clear(&c[a]);
    return st;
  }
  if (in->o->merge || width[0] > 0 || width[1] > 0 || (in->o->degrees && in->kept[0] > 0)) {
    if (dyd_places_find(&place, &in->places, span) != DYD_OK) {
      for (int a = 0; a < 2; a++) dyd_coordinate_clear(&c[a]);
      return dyd_fail_nomem(err);
    }
    if (place->count > 1 && in->o->merge) return intake_merge(in, place, c, width, err);
    if (place->count > 1) in->report.shared += place->count == 2 ? 2 : 1;
    if (place->count == 1) place->point = in->stage.count;
    if (place->count == 1) memcpy(place->width, width, sizeof width);
  }
  st = dyd_stage_add(&in->stage, &c[0], &c[1], err);
  if (st == DYD_OK) st = intake_keep_sigma(in, err);
  if (st == DYD_OK && in->o->id && !in->o->merge_by) st = intake_note_id(in, id, err);
  if (st != DYD_OK || !intake_labels(in)) return st;
  own.of[DYD_ROW_RADIUS] = in->kept[0];
  for (int k = 0; k < DYD_ROW_NUMBERS && st == DYD_OK; k++) {
    int role = k == DYD_ROW_SIGMA && !in->o->confidence ? DYD_ROLE_SIGMA : DYD_ROLE_NUMBER + k;
    if (span[role].text) st = intake_number(&own.of[k], &span[role], role, err);
  }
  if (st != DYD_OK) return st;
  const char *text = in->labels.names ? in->label : id->text;
  size_t length = in->labels.names ? in->label_length : id->length;
  return dyd_labels_add(&in->labels, text, length, &own) ? DYD_OK : dyd_fail_nomem(err);
}

/* Returns true if all of the coordinate is beyond most, on either side. Of computable numbers that is not known yet. */
static bool latitude_beyond(const dyd_coordinate *c, double most) {
  double lo = c->lo, hi = c->hi;
  if (c->kind == DYD_COORDINATE_PLAIN) return dyd_plain_get_rounded(&lo, c->plain, DYD_UP) && fabs(lo) > most;
  if (c->kind == DYD_COORDINATE_REAL && !dyd_real_is_final(c->real)) return false;
  if (c->kind == DYD_COORDINATE_REAL) dyd_interval_get_d(&lo, &hi, dyd_real_interval(c->real));
  return lo > most || hi < -most;
}

static dyd_status intake_skip(intake *in, const dyd_span *s, int role, dyd_error *err) {
  if (!in->o->skip_missing) return fail_missing_field(s, role, err);
  in->report.missing++;
  in->labels.rows++;
  return DYD_OK;
}

static dyd_status intake_coordinate(dyd_coordinate *out, intake *in, int axis, const dyd_span *span, dyd_error *err) {
  dyd_status st = dyd_coordinate_read(out, span, &in->manner[axis], err);
  const char *doubt = st == DYD_OK && in->o->columns && out->kind == DYD_COORDINATE_REAL ? dyd_cell_doubt(span) : NULL;
  if (doubt) {
    dyd_coordinate_clear(out);
    return dyd_span_fail(err, span, 0, doubt);
  }
  if (st == DYD_OK) return st;
  if (st != DYD_E_NOMEM && in->o->columns && (in->kind = dyd_kind_of_cell(span->text, span->length)))
    return dyd_kind_fail(err, in->kind);
  return dyd_cell_hint(st, &in->style, span, in->report.rows == 1, err);
}

/* Letters of degrees say which coordinate it is. */
static dyd_status intake_letter(intake *in, int axis, const dyd_coordinate *c, const dyd_span *span, dyd_error *err) {
  if (c->kind != DYD_COORDINATE_REAL || !dyd_real_is_final(c->real)) return DYD_OK;
  char letter = 0;
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  bool degrees = dyd_degrees_read(lo, hi, &letter, span->text, span->length, false, NULL) == DYD_OK && letter;
  if (!degrees) return DYD_OK;
  in->report.degrees = true;
  if ((letter == 'N' || letter == 'S') == (axis == 1)) return DYD_OK;
  in->report.swapped = true;
  return !in->o->degrees ? DYD_OK
                         : dyd_span_fail(err, span, 0,
                                         axis ? "a longitude where the latitude is expected; give the longitude first"
                                              : "a latitude where the longitude is expected; give the longitude first");
}

/* Takes in one row: fields by their roles, text = NULL where there is none. span is changed. */
static dyd_status intake_row(intake *in, dyd_span span[DYD_CSV_MOST], dyd_error *err) {
  dyd_coordinate c[2] = {{.kind = DYD_COORDINATE_DOUBLE}, {.kind = DYD_COORDINATE_DOUBLE}};
  dyd_status st = DYD_OK;
  in->report.rows++;
  if (!intake_has_room(in, err)) return DYD_E_NOMEM;
  for (int k = 0; k < in->roles; k++)
    if (span[k].text && dyd_cell_is_missing(&in->style, &span[k])) return intake_skip(in, &span[k], k, err);
  if (in->o->decimal_comma || in->style.thousands) st = dyd_cells_plain(&in->style, span, (size_t)in->roles, err);
  for (int a = 0; st == DYD_OK && a < 2; a++) {
    if (span[DYD_CSV_RADIUS_X + a].text) st = intake_radius(in, a, &span[DYD_CSV_RADIUS_X + a], err);
    if (st == DYD_OK) st = intake_coordinate(&c[a], in, a, &span[a], err);
    if (st == DYD_OK) st = intake_letter(in, a, &c[a], &span[a], err);
  }
  if (st == DYD_OK && in->o->confidence) st = intake_sigma(in, &span[DYD_ROLE_SIGMA], err);
  if (st == DYD_OK && in->o->degrees && latitude_beyond(&c[1], 90))
    st = dyd_span_fail(err, &span[1], 0,
                       latitude_beyond(&c[1], 360)
                           ? "the latitude is beyond 90 degrees; give degrees, not metres or other units"
                           : "the latitude is beyond 90 degrees; longitude comes first, then latitude");
  if (st == DYD_OK) return intake_point(in, span, c, err);
  dyd_coordinate_clear(&c[1]);
  dyd_coordinate_clear(&c[0]);
  return st;
}

/* ---- points of several rows ---- */

/* Reads a row again. DYD_E_PARSE: a coordinate is not rational. */
static dyd_status twin_read(dyd_twin *out, intake *in, const sighting *s, dyd_error *err) {
  dyd_span span[DYD_CSV_MOST] = {{0}};
  const char *at = in->cells + s->cells;
  dyd_status st = DYD_OK;
  for (int k = 0; k < in->roles; k++, at += strlen(at) + 1)
    if (k && strcmp(at, "\1") == 0)
      span[k] = span[k - 1];
    else if (*at)
      span[k] = (dyd_span){at, strlen(at), at, at, s->line};
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    if (span[DYD_CSV_RADIUS_X + a].text) st = intake_radius(in, a, &span[DYD_CSV_RADIUS_X + a], err);
    if (st == DYD_OK) st = dyd_coordinate_ends(out->lo[a], out->hi[a], &span[a], &in->manner[a]);
  }
  if (st == DYD_OK && in->o->confidence) st = intake_sigma(in, &span[DYD_ROLE_SIGMA], err);
  out->kept = in->kept[0];
  for (int a = 0; a < 2; a++) out->sigma[a] = in->o->confidence ? in->row.of[a] : 0;
  return st;
}

/* st: the reason why these rows, which the place of an identifier begins with, give no point. */
static dyd_status twins_fail(const intake *in, dyd_status st, const dyd_place_key *id, const size_t which[2],
                             dyd_error *err) {
  const sighting *s[2] = {&in->seen[id->row[0]], &in->seen[id->row[0]]};
  for (int k = 0; k < 2; k++)
    for (size_t left = which[k]; left; left--) s[k] = &in->seen[s[k]->next];
  err->line = s[1]->line;
  err->column = s[1]->column;
  return dyd_fail(
      err, DYD_E_PARSE, "rows %zu (line %zu) and %zu are both \"%.*s\", %s", s[0]->row, s[0]->line, s[1]->row,
      id->length < 60 ? (int)id->length : 60, in->ids.text + id->text,
      st == DYD_E_DOMAIN && in->o->keep_radii ? "but not the same place; give other identifiers, or one place for both"
      : st == DYD_E_DOMAIN
          ? "but have nothing in common; give larger radii (`radius`, `radius_columns`, or `sigma_column` "
            "with `confidence`), or other identifiers"
      : st == DYD_E_ARG
          ? "but the radius of one is a length, and the other is in an interval; give lengths or degrees for "
            "both"
          : "but not written alike, and one has to be refined to be known; write both alike, or as numbers or "
            "intervals");
}

/* Gives the point what its rows say together. */
static dyd_status twins_join(intake *in, const dyd_place_key *id, dyd_twin *row, dyd_error *err) {
  dyd_coordinate c[2] = {{.kind = DYD_COORDINATE_DOUBLE}, {.kind = DYD_COORDINATE_DOUBLE}};
  const sighting *first = &in->seen[id->row[0]], *s = first;
  dyd_status st = DYD_OK;
  dyd_twin *out = &row[id->count];
  size_t which[2] = {0, 0}, other = 0;
  bool exact = true;
  for (size_t k = 0; k < id->count; k++, s = &in->seen[s->next]) {
    st = twin_read(&row[k], in, s, err);
    if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
    exact = exact && st == DYD_OK;
    if (!other && (s->length != first->length || memcmp(in->cells + s->cells, in->cells + first->cells, s->length)))
      other = k;
  }
  which[1] = other;
  if (!exact) return other ? twins_fail(in, DYD_E_PARSE, id, which, err) : DYD_OK;
  st = dyd_twins_merge(out, which, row, id->count, in->o);
  if (st != DYD_OK) return twins_fail(in, st, id, which, err);
  const bool both[2] = {true, true};
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    st = dyd_real_from_interval(&c[a].real, out->lo[a], out->hi[a]);
    if (st == DYD_OK) c[a].kind = DYD_COORDINATE_REAL;
    if (in->o->confidence) in->sigma[id->point].of[a] = out->sigma[a];
  }
  in->labels.number[id->point].of[DYD_ROW_RADIUS] = out->kept;
  if (st == DYD_OK) return dyd_stage_replace(&in->stage, id->point, &c[0], &c[1], both, err);
  for (int a = 0; a < 2; a++) dyd_coordinate_clear(&c[a]);
  return dyd_fail(err, st, "%s", dyd_status_text(st));
}

/* Points of several rows become what these say together; a point counts once. */
static dyd_status intake_join(intake *in, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < in->ids.count; k++) {
    const dyd_place_key *id = &in->ids.item[k];
    if (id->count < 2) continue;
    if (!intake_has_room(in, err)) return DYD_E_NOMEM;
    DYD_FREED dyd_twin *row = dyd_alloc(id->count + 1, sizeof *row);
    if (!row) return dyd_fail_nomem(err);
    for (size_t j = 0; j <= id->count; j++) dyd_twin_init(&row[j]);
    st = twins_join(in, id, row, err);
    for (size_t j = 0; j <= id->count; j++) dyd_twin_clear(&row[j]);
  }
  in->uncertain = 0;
  for (size_t p = 0; in->o->confidence && p < in->stage.count; p++)
    in->uncertain += in->sigma[p].of[0] > 0 || in->sigma[p].of[1] > 0;
  return st;
}

/* Adds all points to e, with their labels; the stage is empty afterwards. */
static dyd_status intake_commit(dyd_engine *e, intake *in, dyd_error *err) {
  const dyd_labels *own = &in->labels;
  DYD_SCOPED(dyd_labels) all = {0};
  bool labelled = own->has_ids || in->numbers || in->report.missing || in->report.merged;
  dyd_confidence c;
  dyd_status st = in->o->merge_by ? intake_join(in, err) : DYD_OK;
  if (st == DYD_OK && in->o->confidence) st = dyd_confidence_for(&c, e, in->o->confidence, in->uncertain, err);
  if (st == DYD_OK && in->o->confidence) st = intake_confide(in, c.k, err);
  if (st == DYD_OK && !intake_has_room(in, err)) st = DYD_E_NOMEM;
  if (st == DYD_OK && labelled && dyd_labels_join(&all, e, own) != DYD_OK) st = dyd_fail_nomem(err);
  if (st == DYD_OK) st = dyd_stage_commit(e, &in->stage, err);
  if (st == DYD_OK && in->o->confidence) dyd_engine_give_confidence(e, &c);
  if (st == DYD_OK && labelled) dyd_labels_give(e, &all);
  return st;
}

/* ---- files and texts ---- */

/* Appends a remedy to the error of the first line, where that may be of a table. The line is gone when others have been
 * read. */
static dyd_status hint_table(dyd_status st, const dyd_text_line *line, dyd_text *text, const intake *in,
                             dyd_error *err) {
  const size_t used = strlen(err->message);
  const char first = line->length ? *line->text : ' ';
  if (st != DYD_E_PARSE || in->report.rows > 1 || in->stage.count) return st;
  const char *remedy = dyd_line_remedy(line, err->message);
  if (!strchr("/;!>", first)) dyd_csv_hint(err, line, text);
  if (strlen(err->message) == used) snprintf(err->message + used, sizeof err->message - used, "%s", remedy);
  return st;
}

static dyd_status geometry_end(const dyd_wkt *w, dyd_error *err) {
  return w->wrong ? dyd_span_fail(err, &w->text, (size_t)(w->at - w->text.text), w->wrong) : DYD_OK;
}

/* Coordinates of geometries of several reference systems are not of one plane. */
static dyd_status geometry_see(intake *in, const dyd_wkt *w, dyd_error *err) {
  static const char *const degrees[] = {"4326", "4258", "4269", "4979"};
  const size_t n = w->srid.length;
  if (!n || n >= sizeof in->srid) return DYD_OK;
  for (size_t k = 0; k < sizeof degrees / sizeof *degrees; k++)
    in->report.degrees = in->report.degrees || (n == 4 && memcmp(w->srid.text, degrees[k], n) == 0);
  if (!in->srid[0]) memcpy(in->srid, w->srid.text, n);
  if (strlen(in->srid) == n && memcmp(in->srid, w->srid.text, n) == 0) return DYD_OK;
  char message[120];
  snprintf(message, sizeof message, "SRID %.*s here, and %s before; transform all to one reference system first",
           (int)n, w->srid.text, in->srid);
  return dyd_span_fail(err, &w->text, 0, message);
}

/* A geometry in a line: its places are points. */
static dyd_status read_geometry(intake *in, dyd_wkt *w, dyd_error *err) {
  dyd_span place[2], span[DYD_CSV_MOST] = {{0}};
  dyd_status st = geometry_see(in, w, err);
  while (st == DYD_OK && dyd_wkt_next(place, w)) {
    memset(span, 0, sizeof span);
    memcpy(span, place, sizeof place);
    in->report.vertices += !w->point;
    st = intake_row(in, span, err);
  }
  return st == DYD_OK ? geometry_end(w, err) : st;
}

static dyd_status read_points_file(intake *in, dyd_text *text, dyd_error *err) {
  dyd_span span[DYD_CSV_MOST] = {{0}};
  for (;;) {
    dyd_text_line line;
    size_t count;
    dyd_status st = dyd_text_next(&line, text, err);
    if (st != DYD_OK || !line.text) return st;
    dyd_wkt geometry;
    if (dyd_wkt_begin(&geometry, &(dyd_span){line.text, line.length, line.text, line.text, line.number})) {
      st = read_geometry(in, &geometry, err);
      if (st != DYD_OK) return st;
      continue;
    }
    st = dyd_points_split(span, &count, &line, in->o->decimal_comma ? ' ' : ',', err);
    if (st == DYD_OK && count) st = intake_row(in, span, err);
    if (st != DYD_OK) return hint_table(st, &line, text, in, err);
  }
}

/* Asks for the columns that the options name, and reads the header. */
static dyd_status csv_begin(dyd_csv *csv, const dyd_read_options *o, dyd_error *err) {
  dyd_status st = DYD_OK;
  const dyd_read_option *r;
  const char *value;
  for (size_t k = 0; st == DYD_OK && (r = dyd_read_option_at(&value, o, k)); k++) {
    if (value && r->most) st = dyd_csv_ask(csv, r->role, r->least, r->most, value, r->field.name, err);
  }
  return st == DYD_OK ? dyd_csv_open(csv, o->delimiter, o->degrees, err) : st;
}

/* Takes over the names of the columns that are carried. */
static void carry_begin(intake *in, dyd_csv *csv) {
  in->labels.carried = csv->carries;
  in->labels.names = csv->names;
  in->labels.anonymous = !in->o->id;
  csv->names = NULL;
}

/* Puts the label of the present record together. */
static dyd_status carry_row(intake *in, const dyd_csv *csv, const dyd_span *id, dyd_error *err) {
  size_t size = id->length + csv->carries;
  for (size_t k = 0; k < csv->carries; k++) size += csv->field[csv->carried[k]].length;
  if (!dyd_reserve((void **)&in->label, &in->label_cap, size + 1, 1)) return dyd_fail_nomem(err);
  char *at = in->label;
  if (id->length) memcpy(at, id->text, id->length), at += id->length;
  for (size_t k = 0; k < csv->carries; k++) {
    const dyd_span *f = &csv->field[csv->carried[k]];
    *at++ = 0;
    if (f->length) memcpy(at, f->text, f->length), at += f->length;
  }
  in->label_length = size;
  return DYD_OK;
}

/* Takes over the units that the table states. */
static dyd_status units_join(intake *in, const dyd_csv *csv, dyd_error *err) {
  for (int role = 0; role < DYD_CSV_MOST; role++) {
    const dyd_unit *own = csv->unit[role], *given = in->unit[role];
    const bool length =
        role == DYD_CSV_RADIUS_X || role == DYD_CSV_RADIUS_Y || role == DYD_ROLE_SIGMA || role == DYD_ROLE_SIGMA + 1;
    if (!given) in->unit[role] = own;
    if (length && own && given && own != given)
      return dyd_fail(err, DYD_E_ARG,
                      "the table says that the %s is in %s, and `radius_unit` says %s; remove `radius_unit`, and where "
                      "the table is wrong convert by `radius_scale`",
                      dyd_role_holds(role), own->name, given->name);
  }
  return DYD_OK;
}

static dyd_status read_csv_file(intake *in, dyd_text *text, dyd_error *err) {
  DYD_SCOPED(dyd_csv)
  csv = {.text = text,
         .headless = in->o->no_header,
         .units_row = in->o->units_row,
         .decimal_comma = in->o->decimal_comma,
         .carry = in->o->carry};
  dyd_span span[DYD_CSV_MOST] = {{0}}, more[2];
  size_t count = 1;
  dyd_status st = csv_begin(&csv, in->o, err);
  in->report.degrees = csv.degrees;
  in->report.swapped = csv.swapped;
  if (st == DYD_OK) st = units_join(in, &csv, err);
  if (st == DYD_OK && csv.carries) carry_begin(in, &csv);
  const size_t zone = st == DYD_OK ? dyd_zone_find(&csv) : 0;
  while (st == DYD_OK && count) {
    st = dyd_csv_next(span, &count, &csv, err);
    dyd_wkt geometry;
    if (st == DYD_OK && count && csv.column[DYD_CSV_X] == csv.column[DYD_CSV_Y] &&
        dyd_wkt_begin(&geometry, &span[DYD_CSV_X])) {
      st = geometry_see(in, &geometry, err);
      const bool one = geometry.point && dyd_wkt_next(span, &geometry) && !dyd_wkt_next(more, &geometry);
      if (st == DYD_OK) st = geometry_end(&geometry, err);
      if (st == DYD_OK && !one)
        st = dyd_span_fail(err, &span[DYD_CSV_X], 0,
                           "this geometry is not a POINT; take one point of each, such as the "
                           "centroid, or write its vertices as WKT alone, a geometry a line");
    }
    if (st == DYD_OK && count && (csv.degrees || csv.e7 || csv.minutes || in->o->degrees))
      st = dyd_names_complete(&csv, span, err);
    if (st == DYD_OK && count && csv.carries) st = carry_row(in, &csv, &span[DYD_ROLE_ID], err);
    if (st == DYD_OK && zone && zone <= csv.fields && count) dyd_zone_see(in->report.zone, &csv.field[zone - 1]);
    if (st == DYD_OK && count) st = intake_row(in, span, err);
  }
  in->report.commented = csv.commented;
  return st == DYD_OK && csv.delimiter == ',' ? dyd_style_settle(&in->style, err) : st;
}

/* Passes over the first lines. */
static dyd_status skip_lines(dyd_text *text, const char *many, dyd_error *err) {
  dyd_text_line line;
  dyd_status st = DYD_OK;
  if (!many) return DYD_OK;
  int64_t left;
  if (!dyd_integer_scan(&left, many, strlen(many), 0, 0, 999999999))
    return dyd_fail(err, DYD_E_ARG, "\"%.40s\" is not a number of lines; give one such as `skip_lines` 3", many);
  for (; left > 0 && st == DYD_OK; left--) {
    st = dyd_text_next(&line, text, err);
    if (st == DYD_OK && !line.text)
      return dyd_fail(err, DYD_E_PARSE, "the file has fewer lines than `skip_lines` %s", many);
  }
  return st;
}

/* Adds the points of text, which is ready to be read; err is not NULL. */
static dyd_status points_read_text(dyd_engine *e, dyd_text *text, const dyd_read_options *o, dyd_error *err) {
  DYD_SCOPED(intake) in;
  text->data = true;
  dyd_status st = intake_init(&in, o, err);
  if (st == DYD_OK && o->report) st = dyd_abi_check(o->report, sizeof o->report->struct_size, "dyd_read_report", err);
  const bool known = o->report && st == DYD_OK;
  if (st == DYD_OK) st = skip_lines(text, o->skip_lines, err);
  if (st == DYD_OK) st = o->columns ? read_csv_file(&in, text, err) : read_points_file(&in, text, err);
  if (st == DYD_OK) st = intake_commit(e, &in, err);
  const dyd_file_kind *kind = text->kind ? text->kind : in.kind;
  in.report.recoded = text->recoded;
  if (kind) in.report.kind = kind->name, in.report.make = kind->make, in.report.make_columns = kind->columns;
  if (known) dyd_abi_give(o->report, &in.report, sizeof in.report);
  return st;
}

/* The same with what the caller gave; clears text. */
static dyd_status points_read_given(dyd_engine *e, dyd_text *text, const dyd_read_options *options, dyd_error *err) {
  dyd_read_options o;
  dyd_error own;
  if (!err) err = &own;
  dyd_status st = dyd_engine_may_add(e, err);
  if (st == DYD_OK) st = dyd_abi_take(&o, sizeof o, options, "dyd_read_options", err);
  if (st == DYD_OK) st = points_read_text(e, text, &o, err);
  dyd_text_clear(text);
  return st;
}

dyd_status dyd_read_points(dyd_engine *e, FILE *in, const dyd_read_options *options, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  dyd_text text;
  dyd_text_init(&text, in);
  return points_read_given(e, &text, options, err);
}

dyd_status dyd_engine_add_text(dyd_engine *e, const char *text, size_t length, const dyd_read_options *options,
                               dyd_error *err) {
  dyd_text copy;
  if (!e) return dyd_fail_null(err);
  if (dyd_text_init_copy(&copy, text, length) != DYD_OK) return dyd_fail_nomem(err);
  return points_read_given(e, &copy, options, err);
}

/* ---- one rectangle ---- */

static dyd_status rect_set_side(dyd_interval *out, const dyd_span *span, dyd_error *err) {
  dyd_error own;
  dyd_error_clear(&own);
  dyd_status st = dyd_interval_set_text(out, span->text, span->length, &own);
  return st == DYD_OK ? st : dyd_coordinate_fail(err, st, span, &own);
}

dyd_status dyd_rect_set_text(dyd_rect *out, const char *text, size_t length, dyd_error *err) {
  const dyd_text_line line = {text, length, 1};
  dyd_span span[2];
  size_t count;
  if (err) dyd_error_clear(err);
  dyd_status st = dyd_points_split(span, &count, &line, ',', err);
  if (st == DYD_OK && !count) st = dyd_fail(err, DYD_E_PARSE, "the text holds no point; give two coordinates");
  if (st != DYD_OK) return st;
  DYD_LOCAL(dyd_rect, r);
  st = rect_set_side(&r.x, &span[0], err);
  if (st == DYD_OK) st = rect_set_side(&r.y, &span[1], err);
  if (st == DYD_OK) dyd_rect_swap(out, &r);
  return st;
}
