/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Answers to single questions as csv and json: a partial disc, a bisector, nearest sites, what the harness found, the
 * table of convergence. */
#include "base/local.h"
#include "io/decimal.h"
#include "io/json.h"
#include "io/table.h"
#include "predicate/circle.h"
#include "rect/rect.h"
#include "voronoi/surd_point.h"
#include <inttypes.h>
#include <math.h>

/* ---- the partial disc of three points, and where the others are ---- */

enum { CIRCLES = 6 };

static const char *const circle_names[CIRCLES] = {"FCC", "CFC", "CCF", "CFF", "FCF", "FFC"};

static const char *con_text(dyd_sure con) {
  return con == DYD_SURE_PLUS ? "inside" : con == DYD_SURE_MINUS ? "outside" : "unknown";
}

static const char *orientation_text(dyd_sure s) {
  return s == DYD_SURE_PLUS ? "counter-clockwise" : s == DYD_SURE_MINUS ? "clockwise" : "unknown";
}

typedef void circle_visit(void *context, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2);

static void disc_each_circle(const dyd_partial_disc *d, circle_visit visit, void *context) {
  DYD_LOCAL(dyd_surd_point, centre, radius2);
  for (int k = 0; k < CIRCLES && d->known; k++) {
    dyd_exact_circle(&centre, &radius2, &d->circle[k]);
    visit(context, k, &centre, &radius2);
  }
}

/* The smallest box in doubles around the six centres: it holds the partial centre [CEN-1]. */
static void disc_grow_box(void *context, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2) {
  double *box = context, b[4];
  (void)number, (void)radius2;
  dyd_exact_enclose(b, centre);
  for (int k = 0; k < 4; k++) box[k] = k & 1 ? fmax(box[k], b[k]) : fmin(box[k], b[k]);
}

/* "within" is that of the centres of all circles through the three points. */
dyd_status dyd_disc_comments(dyd_table *t, const dyd_output *o) {
  const dyd_disc_output *c = o->what;
  FILE *out = o->out;
  size_t count[3] = {0};
  (void)t;
  fprintf(out, "# orientation of %zu %zu %zu: %s\n", dyd_engine_row(c->engine, 0), dyd_engine_row(c->engine, 1),
          dyd_engine_row(c->engine, 2), orientation_text(dyd_orientation(c->r[0], c->r[1], c->r[2])));
  if (c->disc->known) {
    double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
    disc_each_circle(c->disc, disc_grow_box, box);
    fputs("# partial centre within xlo ", out);
    dyd_exact_decimals(out, box[0], box[1], " xhi ");
    fputs(" ylo ", out);
    dyd_exact_decimals(out, box[2], box[3], " yhi ");
    fputs("\n", out);
  }
  for (size_t i = 3; i < c->n; i++) count[1 + (int)dyd_partial_disc_con(c->disc, c->r[i])]++;
  if (c->n > 3)
    fprintf(out, "# con of the others: inside %zu, outside %zu, unknown %zu\n", count[2], count[0], count[1]);
  return DYD_OK;
}

static void disc_row_circle(void *context, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2) {
  dyd_table *t = context;
  double box[4], r[2];
  dyd_row_begin(t);
  dyd_row_word(t, circle_names[number]);
  dyd_exact_text(dyd_row_file(t), centre->ax, centre->bx, centre->c, centre->d);
  dyd_exact_text(dyd_row_file(t), centre->ay, centre->by, centre->c, centre->d);
  dyd_exact_text(dyd_row_file(t), radius2->ax, radius2->bx, radius2->c, radius2->d);
  dyd_exact_enclose(box, centre);
  dyd_exact_enclose_root(&r[0], &r[1], radius2);
  dyd_row_box(t, box);
  dyd_row_decimal(t, r[0], DYD_DOWN);
  dyd_row_decimal(t, r[1], DYD_UP);
  dyd_row_end(t);
}

dyd_status dyd_disc_rows(dyd_table *t, const dyd_output *o) {
  disc_each_circle(((const dyd_disc_output *)o->what)->disc, disc_row_circle, t);
  return DYD_OK;
}

dyd_status dyd_con_rows(dyd_table *t, const dyd_output *o) {
  const dyd_disc_output *c = o->what;
  for (size_t i = 3; i < c->n; i++) {
    dyd_row_begin(t);
    dyd_row_site(t, i);
    dyd_row_word(t, con_text(dyd_partial_disc_con(c->disc, c->r[i])));
    dyd_row_id(t, i);
    dyd_row_end(t);
  }
  return DYD_OK;
}

static void json_surd(dyd_json *j, const char *name, mpz_srcptr a, mpz_srcptr b, const dyd_surd_point *p) {
  FILE *out = dyd_json_file(j, name);
  fputs("\"", out);
  dyd_exact_text(out, a, b, p->c, p->d);
  fputs("\"", out);
}

static void disc_json_circle(void *context, int number, const dyd_surd_point *centre, const dyd_surd_point *radius2) {
  dyd_json *j = context;
  double box[4], lo, hi;
  dyd_json_object(j, NULL, DYD_JSON_FLAT);
  dyd_json_word(j, "labels", circle_names[number]);
  json_surd(j, "x", centre->ax, centre->bx, centre);
  json_surd(j, "y", centre->ay, centre->by, centre);
  json_surd(j, "radius_squared", radius2->ax, radius2->bx, radius2);
  dyd_exact_enclose(box, centre);
  dyd_json_box(j, true, box);
  dyd_exact_enclose_root(&lo, &hi, radius2);
  dyd_json_decimals(j, "radius_decimal", lo, hi);
  dyd_json_close(j, 1);
}

static void disc_json_centre(dyd_json *j, const dyd_partial_disc *d) {
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  if (!d->known) {
    dyd_json_raw(j, "partial_centre", "null");
    return;
  }
  disc_each_circle(d, disc_grow_box, box);
  dyd_json_object(j, "partial_centre", DYD_JSON_FLAT);
  dyd_json_box(j, true, box);
  dyd_json_close(j, 1);
}

static void json_rectangles(dyd_json *j, const dyd_rect *const *r, size_t n) {
  dyd_json_array(j, "rectangles", DYD_JSON_LINES);
  for (size_t i = 0; i < n && j->st == DYD_OK; i++) dyd_json_rect(j, NULL, r[i]);
  dyd_json_close(j, 1);
}

dyd_status dyd_disc_json(const dyd_output *o) {
  const dyd_disc_output *c = o->what;
  dyd_json j;
  dyd_json_begin(&j, o->out);
  dyd_json_head_outward(&j, "dyadel disc 1", o, c->engine, c->outcome);
  json_rectangles(&j, c->r, c->n);
  dyd_json_word(&j, "orientation", orientation_text(dyd_orientation(c->r[0], c->r[1], c->r[2])));
  dyd_json_array(&j, "circles", DYD_JSON_LIST);
  disc_each_circle(c->disc, disc_json_circle, &j);
  dyd_json_close(&j, 1);
  disc_json_centre(&j, c->disc);
  dyd_json_array(&j, "con", DYD_JSON_LIST);
  for (uint32_t i = 3; i < c->n; i++) {
    dyd_json_object(&j, NULL, DYD_JSON_FLAT);
    dyd_json_site(&j, "i", c->engine, i);
    dyd_json_word(&j, "con", con_text(dyd_partial_disc_con(c->disc, c->r[i])));
    dyd_json_ids(&j, c->engine, &i, 0);
    dyd_json_close(&j, 1);
  }
  dyd_json_close(&j, 1);
  return dyd_json_end(&j, "\n}\n");
}

/* ---- the partial bisector of two points ---- */

dyd_status dyd_bisector_comments(dyd_table *t, const dyd_output *o) {
  (void)t;
  fputs("# arcs of dl_far = ds_near, nearer to far on the left; x, y exact, lo rounded down, hi rounded up\n", o->out);
  if (!((const dyd_bisector_output *)o->what)->curve[0].count)
    fputs("# the rectangles meet: no place is certainly nearer to one of them\n", o->out);
  return DYD_OK;
}

/* x and y exactly, and their enclosures: six values. */
static void row_arc_end(dyd_table *t, const dyd_arc_end *end) {
  const dyd_surd_point *p = &end->at;
  double box[4];
  dyd_row_word(t, dyd_end_names[end->kind]);
  for (int k = 0; k < 6 && end->kind == DYD_END_INFINITE; k++) dyd_row_word(t, "");
  if (end->kind == DYD_END_INFINITE) return;
  dyd_exact_text(dyd_row_file(t), p->ax, p->bx, p->c, p->d);
  dyd_exact_text(dyd_row_file(t), p->ay, p->by, p->c, p->d);
  dyd_exact_enclose(box, p);
  dyd_exact_decimals(dyd_row_file(t), box[0], box[1], ",");
  dyd_exact_decimals(dyd_row_file(t), box[2], box[3], ",");
}

dyd_status dyd_bisector_rows(dyd_table *t, const dyd_output *o) {
  const dyd_boundary *curve = ((const dyd_bisector_output *)o->what)->curve;
  for (const dyd_boundary *b = curve; b < curve + 2; b++)
    for (size_t m = 0; m < b->count; m++)
      for (const dyd_arc *a = b->chain[m].arc; a < b->chain[m].arc + b->chain[m].count; a++) {
        dyd_row_begin(t);
        dyd_row_site(t, a->far_site);
        dyd_row_site(t, a->near_site);
        dyd_row_word(t, dyd_arc_names[a->kind]);
        dyd_row_word(t, dyd_feature_names[a->corner]);
        dyd_row_word(t, dyd_feature_names[a->feature]);
        row_arc_end(t, &a->begin);
        row_arc_end(t, &a->end);
        dyd_row_end_two(t, a->far_site, a->near_site);
      }
  return DYD_OK;
}

dyd_status dyd_bisector_json(const dyd_output *o) {
  const dyd_bisector_output *b = o->what;
  dyd_point_texts texts = {.engine = b->engine};
  dyd_json j;
  dyd_json_begin(&j, o->out);
  dyd_json_head_outward(&j, "dyadel bisector 1", o, b->engine, b->outcome);
  json_rectangles(&j, b->r, 2);
  dyd_json_array(&j, "curves", DYD_JSON_LIST);
  for (uint32_t far = 0; far < 2 && j.st == DYD_OK; far++) {
    dyd_json_object(&j, NULL, DYD_JSON_FLAT);
    dyd_json_site(&j, "far", b->engine, far);
    dyd_json_site(&j, "near", b->engine, 1 - far);
    if (dyd_engine_id(b->engine, 0)) {
      dyd_json_text(&j, "id_far", dyd_engine_id(b->engine, far));
      dyd_json_text(&j, "id_near", dyd_engine_id(b->engine, 1 - far));
    }
    dyd_json_boundary(&j, "boundary", &b->curve[far], &texts);
    dyd_json_close(&j, 1);
  }
  dyd_json_close(&j, 1);
  dyd_point_texts_clear(&texts);
  return dyd_json_end(&j, "\n}\n");
}

/* ---- nearest sites of one place or of many ---- */

static const char *nearest_status(const dyd_nearest_answer *a) {
  return a->sure ? "certain" : "possible";
}

/* The distance from the place to site i, whatever both are. scratch: a rectangle. */
static dyd_status nearest_distance(double bounds[2], const dyd_nearest_output *n, const dyd_nearest_answer *a,
                                   uint32_t i, dyd_rect *scratch) {
  if (n->sphere) return dyd_sphere_distance(&bounds[0], &bounds[1], n->sphere, i, a->at);
  if (a->discs) return dyd_disc_distance(&bounds[0], &bounds[1], dyd_delaunay_sites(n->pd), i, a->at);
  dyd_status st = dyd_sites_get(scratch, dyd_delaunay_sites(n->pd), i);
  if (st == DYD_OK) dyd_rect_distance(&bounds[0], &bounds[1], a->at, scratch);
  return st;
}

bool dyd_nearest_named(const dyd_nearest_output *n) {
  return n->count && n->answer[0]->id;
}

static size_t answer_place_number(const dyd_nearest_output *n, size_t q) {
  return n->answer[q]->placed ? n->answer[q]->place : q;
}

/* A line for each tie: its points, after the place where there are many. */
dyd_status dyd_nearest_comments(dyd_table *t, const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  dyd_csv_aliases(o->out, t->engine, n->sphere);
  if (n->sphere) fputs("# distances: metres on the ground\n", o->out);
  for (size_t q = 0; q < n->count; q++) {
    if (!n->answer[q]->tied) continue;
    fputs("# tie ", o->out);
    if (o->content == DYD_CONTENT_PLACES) fprintf(o->out, "%zu: ", answer_place_number(n, q));
    dyd_put_rows(o->out, n->engine, n->answer[q]->found, " ");
    fputs("\n", o->out);
  }
  fputs("# rounding: lo down, hi up; empty: beyond doubles\n", o->out);
  return DYD_OK;
}

/* They begin with the number of the place where there are many. */
dyd_status dyd_nearest_rows(dyd_table *t, const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_rect, scratch);
  for (size_t q = 0; q < n->count; q++) {
    const dyd_nearest_answer *a = n->answer[q];
    for (size_t k = 0; k < a->found->count && st == DYD_OK; k++) {
      uint32_t i = a->found->item[k];
      double bounds[2];
      st = nearest_distance(bounds, n, a, i, &scratch);
      if (st != DYD_OK) break;
      dyd_row_begin(t);
      if (o->content == DYD_CONTENT_PLACES) dyd_row_index(t, answer_place_number(n, q));
      if (o->content == DYD_CONTENT_PLACES && dyd_nearest_named(n)) dyd_row_text(t, a->id ? a->id : "");
      dyd_row_site(t, i);
      dyd_row_word(t, nearest_status(a));
      dyd_row_decimal(t, bounds[0], DYD_DOWN);
      dyd_row_decimal(t, bounds[1], DYD_UP);
      dyd_row_id(t, i);
      dyd_row_end(t);
    }
  }
  return st;
}

static void nearest_json_list(dyd_json *j, const dyd_nearest_output *n, const dyd_nearest_answer *a,
                              dyd_rect *scratch) {
  double bounds[2];
  dyd_json_bool(j, "tied", a->tied);
  dyd_json_break(j, ", ");
  dyd_json_array(j, "nearest", DYD_JSON_LIST);
  for (const uint32_t *i = a->found->item; i < a->found->item + a->found->count; i++) {
    if (!dyd_json_good(j, nearest_distance(bounds, n, a, *i, scratch))) break;
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_site(j, "i", n->engine, *i);
    dyd_json_word(j, "status", nearest_status(a));
    dyd_json_decimals(j, "distance", bounds[0], bounds[1]);
    dyd_json_ids(j, n->engine, i, 0);
    dyd_json_carried(j, n->engine, *i);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
}

dyd_status dyd_nearest_json(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  bool many = o->content == DYD_CONTENT_PLACES;
  dyd_json j;
  DYD_LOCAL(dyd_rect, scratch);
  dyd_json_begin(&j, o->out);
  dyd_json_head_outward(&j, many ? "dyadel nearest places 1" : "dyadel nearest 1", o, n->engine,
                        many ? n->outcome : n->answer[0]->outcome);
  if (n->sphere) {
    dyd_json_word(&j, "surface", "sphere");
    dyd_json_word(&j, "distance_unit", "m");
  }
  if (many) dyd_json_array(&j, "places", DYD_JSON_LIST);
  for (size_t q = 0; q < n->count && j.st == DYD_OK; q++) {
    if (many) {
      dyd_json_object(&j, NULL, DYD_JSON_FLAT);
      dyd_json_index(&j, "q", answer_place_number(n, q));
      if (dyd_nearest_named(n)) dyd_json_text(&j, "id_q", n->answer[q]->id ? n->answer[q]->id : "");
      dyd_json_word(&j, "outcome", dyd_outcome_text(n->answer[q]->outcome));
    }
    dyd_json_sides(&j, n->answer[q]->at);
    nearest_json_list(&j, n, n->answer[q], &scratch);
    if (many) dyd_json_close(&j, 1);
  }
  if (many) dyd_json_close(&j, 1);
  dyd_json_aliases(&j, n->engine, n->sphere);
  return dyd_json_end(&j, "}\n");
}

/* ---- what the harness found ---- */

typedef struct check_counts {
  const char *name[7];
  uint64_t n[7];
} check_counts;

static check_counts counts_of_check(const dyd_check_report *r) {
  return (check_counts){{"schedules", "stages", "pairs", "cells", "floors", "seed", "moves"},
                        {r->schedules, r->stages, r->pairs, r->cells, r->floors, r->seed, r->moves}};
}

dyd_status dyd_check_rows(dyd_table *t, const dyd_output *o) {
  const dyd_check_report *r = o->what;
  const check_counts counts = counts_of_check(r);
  dyd_row_begin(t);
  dyd_row_word(t, dyd_check_fault_text(r->fault));
  for (int k = 0; k < 7; k++) dyd_row_index(t, counts.n[k]);
  dyd_row_end(t);
  return DYD_OK;
}

dyd_status dyd_check_json(const dyd_output *o) {
  const dyd_check_report *r = o->what;
  const check_counts counts = counts_of_check(r);
  dyd_json j;
  dyd_json_begin(&j, o->out);
  dyd_json_head(&j, "dyadel check 1", o);
  dyd_json_word(&j, "fault", dyd_check_fault_text(r->fault));
  for (int k = 0; k < 7; k++) dyd_json_index(&j, counts.name[k], counts.n[k]);
  return dyd_json_end(&j, "}\n");
}

/* ---- the table of convergence ---- */

enum { DIGITS = 6 };

/* Milliseconds, rounded up. */
static double row_seconds(const dyd_stage_row *r) {
  return ceil(r->seconds * 1000) / 1000;
}

/* The name, or the value, of an item; returns the next one. */
static const char *label_item(FILE *out, const char *item, bool value) {
  size_t name = strcspn(item, "="), length = strcspn(item, ",");
  const char *from = value ? item + name + 1 : item;
  fprintf(out, "%.*s", (int)(value ? length - name - 1 : name), from);
  return item[length] ? item + length + 1 : NULL;
}

static void label_csv(FILE *out, const char *label, bool values) {
  for (const char *item = label; item;) {
    item = label_item(out, item, values);
    fputs(",", out);
  }
}

static void label_json(dyd_json *j, const char *label) {
  dyd_json_object(j, "label", DYD_JSON_FLAT);
  for (const char *item = label; item;) {
    FILE *out = dyd_json_file(j, NULL);
    fputs("\"", out);
    label_item(out, item, false);
    fputs("\": \"", out);
    item = label_item(out, item, true);
    fputs("\"", out);
  }
  dyd_json_close(j, 1);
}

/* Columns of a table: the tables that have them, their contents, and their place in the row. */
typedef enum stage_kind {
  STAGE_INDEX, /* uint64_t */
  STAGE_SIZE,
  STAGE_BITS,  /* int64_t */
  STAGE_WIDTH, /* dyd_dyadic, rounded up */
  STAGE_BOUND, /* the same, where row->bounded */
  STAGE_DIAGRAM_BOUND,
  STAGE_POSSIBLE, /* the pairs */
  STAGE_ORIENTATION,
  STAGE_DISJOINT,
  STAGE_CON, /* how many points are on one side (offset), and the side of each */
  STAGE_CONS,
  STAGE_DIGEST,
  STAGE_RATIO, /* of bits_total to the best in hindsight */
  STAGE_SECONDS
} stage_kind;

typedef struct stage_column {
  const char *name;
  unsigned of; /* a set of dyd_converge_of */
  stage_kind kind;
  size_t offset;
} stage_column;

#define OF(what) (1u << DYD_CONVERGE_##what)
#define ROW(field) offsetof(dyd_stage_row, field)

enum { OF_T = OF(DELAUNAY) | OF(VORONOI), OF_DISC = OF(DISC), OF_BISECTOR = OF(BISECTOR), OF_ANY = 15 };

static const stage_column stage_columns[] = {
    {"stage", OF_ANY, STAGE_INDEX, ROW(stage)},
    {"bits_least", OF_ANY, STAGE_BITS, ROW(bits_least)},
    {"bits_most", OF_ANY, STAGE_BITS, ROW(bits_most)},
    {"bits_total", OF_ANY, STAGE_INDEX, ROW(bits_total)},
    {"width_largest", OF_ANY, STAGE_WIDTH, ROW(width_largest)},
    {"width_median", OF_ANY, STAGE_WIDTH, ROW(width_median)},
    {"possible", OF_T, STAGE_POSSIBLE, 0},
    {"legal", OF_T, STAGE_SIZE, ROW(count[DYD_LEGAL])},
    {"indeterminate", OF_T, STAGE_SIZE, ROW(count[DYD_INDETERMINATE])},
    {"tie", OF_T, STAGE_SIZE, ROW(count[DYD_TIE])},
    {"faces", OF_T, STAGE_SIZE, ROW(undecided_faces)},
    {"disjoint", OF_BISECTOR, STAGE_DISJOINT, 0},
    {"orientation", OF_DISC, STAGE_ORIENTATION, 0},
    {"inside", OF_DISC, STAGE_CON, DYD_SURE_PLUS + 1},
    {"outside", OF_DISC, STAGE_CON, DYD_SURE_MINUS + 1},
    {"unknown", OF_DISC, STAGE_CON, DYD_UNSURE + 1},
    {"con", OF_DISC, STAGE_CONS, 0},
    {"area", OF_ANY, STAGE_BOUND, ROW(area)},
    {"hausdorff", OF_ANY, STAGE_BOUND, ROW(hausdorff)},
    {"v_area", OF_T, STAGE_DIAGRAM_BOUND, ROW(v_area)},
    {"v_hausdorff", OF_T, STAGE_DIAGRAM_BOUND, ROW(v_hausdorff)},
    {"filter", OF_T, STAGE_INDEX, ROW(rungs.filter)},
    {"integer", OF_T, STAGE_INDEX, ROW(rungs.integer)},
    {"exact", OF_T, STAGE_INDEX, ROW(rungs.exact)},
    {"calls", OF_ANY, STAGE_INDEX, ROW(calls)},
    {"statuses", OF_T, STAGE_DIGEST, 0},
    {"ratio", OF_T, STAGE_RATIO, 0},
    {"seconds", OF_ANY, STAGE_SECONDS, 0},
};
enum { STAGE_COLUMNS = sizeof stage_columns / sizeof *stage_columns };

/* The k-th column of the table, k <= STAGE_COLUMNS, that it has; NULL: it does not have it. */
static const stage_column *stage_column_at(size_t k, const dyd_convergence *c, bool times) {
  const stage_column *column = &stage_columns[k];
  bool has = column->kind == STAGE_SECONDS ? times : column->kind != STAGE_RATIO || c->sought;
  return column->of & 1u << c->of && has ? column : NULL;
}

bool dyd_is_stage_column(const char *name, size_t length) {
  size_t k = 0;
  while (k < STAGE_COLUMNS && (strlen(stage_columns[k].name) != length || memcmp(stage_columns[k].name, name, length)))
    k++;
  return k < STAGE_COLUMNS;
}

static const dyd_dyadic *stage_bound(const stage_column *c, const dyd_stage_row *r) {
  bool known = c->kind == STAGE_WIDTH || (c->kind == STAGE_BOUND ? r->bounded : r->voronoi);
  return known ? (const void *)((const char *)r + c->offset) : NULL;
}

static uint64_t stage_count(const stage_column *c, const dyd_stage_row *r) {
  const void *at = (const char *)r + c->offset;
  uint64_t n = 0;
  if (c->kind == STAGE_POSSIBLE) return r->count[DYD_LEGAL] + r->count[DYD_INDETERMINATE] + r->count[DYD_TIE];
  if (c->kind != STAGE_CON) return c->kind == STAGE_SIZE ? *(const size_t *)at : *(const uint64_t *)at;
  for (size_t k = 0; k < r->cons; k++) n += r->con[k] == (int)c->offset - 1;
  return n;
}

/* A word that json quotes. */
static const char *stage_word(char digest[17], const stage_column *c, const dyd_stage_row *r) {
  if (c->kind == STAGE_ORIENTATION) return orientation_text(r->orientation);
  if (c->kind == STAGE_DISJOINT) return r->orientation == DYD_UNSURE ? "no" : "yes";
  snprintf(digest, 17, "%016" PRIx64, r->digest);
  return digest;
}

static void table_csv_goal(FILE *out, const dyd_engine_options *o) {
  fputs(dyd_goal_text(o->goal), out);
  if (o->goal != DYD_GOAL_DECIDED) fprintf(out, " 2^%" PRId64, -o->goal_bits);
}

static dyd_status table_csv_comments(FILE *out, const dyd_convergence *c, bool times) {
  const dyd_engine_options *o = c->options;
  fprintf(out, "# schedule %s; goal ", dyd_schedule_text(o->schedule));
  table_csv_goal(out, o);
  fprintf(out, "; first stage %" PRId64 " bits, then ", o->start_bits);
  if (o->step_bits)
    fprintf(out, "steps of %" PRId64, o->step_bits);
  else
    fputs("geometric growth", out);
  fprintf(out, "; at most %" PRId64 " bits; outcome %s\n", o->max_bits, dyd_outcome_text(c->outcome));
  dyd_status st = DYD_OK;
  if (c->window) {
    fprintf(out, "# %s on the window ",
            c->of == DYD_CONVERGE_BISECTOR ? "the bisector is" : "v_area and v_hausdorff are of the Voronoi diagram");
    st = dyd_put_window(out, c->window, "", ",");
    fputs("\n", out);
  }
  fputs("# widths, areas and Hausdorff distances are upper bounds, decimals rounded up; empty: not known\n"
        "# bits, decisions (filter, integer, exact) and calls are counted from the start; statuses is a digest of all "
        "pairs with their statuses\n",
        out);
  fprintf(out, "# no random choice is made and no seed is used: every run gives this table%s\n",
          times ? ", seconds (rounded up) aside" : "");
  return st;
}

static void table_csv_head(FILE *out, const dyd_stage_table *t) {
  label_csv(out, t->label, false);
  for (size_t k = 0; k < STAGE_COLUMNS; k++) {
    const stage_column *c = stage_column_at(k, t->stages, t->times);
    if (c) fprintf(out, "%s%s", k ? "," : "", c->name);
  }
  fputs("\n", out);
}

/* With a point, whatever the caller's locale has between units and thousandths. */
static void put_seconds(FILE *out, double seconds) {
  uint64_t thousandths = (uint64_t)(1000 * seconds + 0.5);
  fprintf(out, "%" PRIu64 ".%03" PRIu64, thousandths / 1000, thousandths % 1000);
}

/* bits_total / best, rounded up to millionths; `unknown` where best is 0. */
static void put_ratio(FILE *out, const dyd_stage_row *r, uint64_t best, const char *unknown) {
  enum { UNIT = 1000000 };
  const uint64_t whole = best ? r->bits_total / best : 0, rest = best ? r->bits_total % best : 0;
  const uint64_t part = best ? (rest * UNIT + best - 1) / best : 0;
  if (!best)
    fputs(unknown, out);
  else
    fprintf(out, "%" PRIu64 ".%06" PRIu64, whole + part / UNIT, part % UNIT);
}

/* "3:inside 5:unknown": points by their numbers. */
static void put_cons(FILE *out, const dyd_stage_row *r) {
  for (size_t k = 0; k < r->cons; k++) fprintf(out, "%s%zu:%s", k ? " " : "", k + 3, con_text(r->con[k]));
}

static void stage_csv(FILE *out, const stage_column *c, const dyd_stage_row *r, uint64_t best) {
  char text[DYD_DECIMAL_SIZE] = "";
  const dyd_dyadic *x;
  switch (c->kind) {
  case STAGE_BITS:
    fprintf(out, "%" PRId64, *(const int64_t *)((const char *)r + c->offset));
    break;
  case STAGE_WIDTH:
  case STAGE_BOUND:
  case STAGE_DIAGRAM_BOUND:
    if ((x = stage_bound(c, r))) dyd_decimal_dyadic(text, x, DIGITS, DYD_UP);
    fputs(text, out);
    break;
  case STAGE_CONS:
    put_cons(out, r);
    break;
  case STAGE_RATIO:
    put_ratio(out, r, best, "");
    break;
  case STAGE_SECONDS:
    put_seconds(out, row_seconds(r));
    break;
  case STAGE_ORIENTATION:
  case STAGE_DISJOINT:
  case STAGE_DIGEST:
    fputs(stage_word(text, c, r), out);
    break;
  default:
    fprintf(out, "%" PRIu64, stage_count(c, r));
  }
}

static void table_csv_row(FILE *out, const dyd_stage_table *t, const dyd_stage_row *r) {
  for (size_t k = 0; k < STAGE_COLUMNS; k++) {
    const stage_column *c = stage_column_at(k, t->stages, t->times);
    if (c && k) fputs(",", out);
    if (c) stage_csv(out, c, r, t->stages->best_bits);
  }
  fputs("\n", out);
}

/* ---- the modulus ---- */

/* first: from this row on the bound is at most 2^-m; rated: the first one with a rate. NULL: there is none. */
typedef struct modulus_row {
  const dyd_stage_row *first, *rated;
  int64_t apriori;
} modulus_row;

static bool modulus_is_of_area(const dyd_convergence *c) {
  return c->options->goal == DYD_GOAL_AREA || c->options->goal == DYD_GOAL_VORONOI_AREA;
}

/* NULL: the row has none. */
static const dyd_dyadic *modulus_bound(const dyd_convergence *c, const dyd_stage_row *r) {
  const bool diagram = c->of == DYD_CONVERGE_VORONOI, area = modulus_is_of_area(c);
  if (!(diagram ? r->voronoi : r->bounded)) return NULL;
  return diagram ? area ? &r->v_area : &r->v_hausdorff : area ? &r->area : &r->hausdorff;
}

static dyd_status modulus_find(modulus_row *out, const dyd_convergence *c, int64_t m) {
  *out = (modulus_row){NULL, NULL, 0};
  DYD_LOCAL(dyd_dyadic, goal);
  dyd_status st = dyd_dyadic_set_si_2exp(&goal, 1, -m);
  for (size_t k = c->count; st == DYD_OK && k-- > 0;) {
    const dyd_dyadic *bound = modulus_bound(c, c->row[k]);
    if (!bound || dyd_dyadic_cmp(bound, &goal) > 0) break;
    out->first = c->row[k];
  }
  for (size_t k = 0; k < c->count && !out->rated && !modulus_is_of_area(c); k++)
    if (c->row[k]->rated) out->rated = c->row[k];
  if (out->rated) {
    out->apriori = (m > out->rated->rate_from ? m : out->rated->rate_from) + out->rated->rate;
    if (out->apriori < out->rated->bits_most) out->apriori = out->rated->bits_most;
  }
  return st;
}

static dyd_status modulus_csv(const dyd_output *o, const dyd_stage_table *t) {
  const dyd_convergence *c = t->stages;
  dyd_status st = DYD_OK;
  if (!t->no_header) {
    label_csv(o->out, t->label, false);
    fputs("m,stage,bits_total,bits_most,bound,apriori_bits,apriori_stage\n", o->out);
  }
  for (int64_t m = t->from; st == DYD_OK && m <= t->to; m++) {
    modulus_row r;
    char text[DYD_DECIMAL_SIZE] = "";
    st = modulus_find(&r, c, m);
    label_csv(o->out, t->label, true);
    fprintf(o->out, "%" PRId64 ",", m);
    if (r.first) dyd_decimal_dyadic(text, modulus_bound(c, r.first), DIGITS, DYD_UP);
    if (r.first)
      fprintf(o->out, "%" PRIu64 ",%" PRIu64 ",%" PRId64 ",%s,", r.first->stage, r.first->bits_total,
              r.first->bits_most, text);
    else
      fputs(",,,,", o->out);
    if (r.rated)
      fprintf(o->out, "%" PRId64 ",%" PRIu64 "\n", r.apriori, r.rated->stage);
    else
      fputs(",\n", o->out);
  }
  return st;
}

static dyd_status modulus_json(dyd_json *j, const dyd_stage_table *t) {
  dyd_status st = DYD_OK;
  dyd_json_array(j, "modulus", DYD_JSON_LIST);
  for (int64_t m = t->from; st == DYD_OK && m <= t->to; m++) {
    modulus_row r;
    st = modulus_find(&r, t->stages, m);
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_signed(j, "m", m);
    if (r.first) {
      dyd_json_index(j, "stage", r.first->stage);
      dyd_json_index(j, "bits_total", r.first->bits_total);
      dyd_json_signed(j, "bits_most", r.first->bits_most);
      dyd_json_bound(j, "bound", modulus_bound(t->stages, r.first));
    }
    if (r.rated) {
      dyd_json_signed(j, "apriori_bits", r.apriori);
      dyd_json_index(j, "apriori_stage", r.rated->stage);
    }
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
  return st;
}

static dyd_status convergence_csv(const dyd_output *o) {
  const dyd_stage_table *t = o->what;
  dyd_status st = t->no_header || !o->comments ? DYD_OK : table_csv_comments(o->comments, t->stages, t->times);
  if (st == DYD_OK && t->modulus) return modulus_csv(o, t);
  if (!t->no_header) table_csv_head(o->out, t);
  for (size_t k = 0; k < t->stages->count; k++) {
    label_csv(o->out, t->label, true);
    table_csv_row(o->out, t, t->stages->row[k]);
  }
  return st;
}

/* These rows are not a layer, since labels are columns, too. */
dyd_writer *const dyd_csv_writers[DYD_CONTENTS] = {[DYD_CONTENT_CONVERGENCE] = convergence_csv};

static void stages_json_head(dyd_json *j, const dyd_output *out) {
  const dyd_convergence *c = ((const dyd_stage_table *)out->what)->stages;
  const dyd_engine_options *o = c->options;
  dyd_json_head(j, "dyadel converge 1", out);
  dyd_json_word(j, "of", dyd_converge_of_text(c->of));
  dyd_json_word(j, "rounding",
                "widths and bounds are upper bounds; exact is exact, decimal is rounded up; null is not known, or "
                "beyond the largest double; seconds are rounded up");
  dyd_json_schedule(j, o);
  dyd_json_raw(j, "seed", "null");
  dyd_json_word(j, "outcome", dyd_outcome_text(c->outcome));
  dyd_json_window(j, "window", c->window, ",");
}

static void stage_json_cons(dyd_json *j, const dyd_stage_row *r) {
  dyd_json_array(j, "con", DYD_JSON_FLAT);
  for (size_t k = 0; k < r->cons; k++) dyd_json_word(j, NULL, con_text(r->con[k]));
  dyd_json_close(j, 1);
}

static void stage_json_value(dyd_json *j, const stage_column *c, const dyd_stage_row *r, uint64_t best) {
  char digest[17];
  switch (c->kind) {
  case STAGE_BITS:
    dyd_json_signed(j, c->name, *(const int64_t *)((const char *)r + c->offset));
    break;
  case STAGE_WIDTH:
  case STAGE_BOUND:
  case STAGE_DIAGRAM_BOUND:
    dyd_json_bound(j, c->name, stage_bound(c, r));
    break;
  case STAGE_CONS:
    stage_json_cons(j, r);
    break;
  case STAGE_RATIO:
    put_ratio(dyd_json_file(j, c->name), r, best, "null");
    break;
  case STAGE_SECONDS:
    put_seconds(dyd_json_file(j, c->name), row_seconds(r));
    break;
  case STAGE_ORIENTATION:
  case STAGE_DISJOINT:
  case STAGE_DIGEST:
    dyd_json_word(j, c->name, stage_word(digest, c, r));
    break;
  default:
    dyd_json_index(j, c->name, stage_count(c, r));
  }
}

static void stage_json(dyd_json *j, const dyd_stage_table *t, const dyd_stage_row *r) {
  dyd_json_object(j, NULL, DYD_JSON_FLAT);
  for (size_t k = 0; k < STAGE_COLUMNS; k++) {
    const stage_column *c = stage_column_at(k, t->stages, t->times);
    if (c) stage_json_value(j, c, r, t->stages->best_bits);
    if (c && k % 8 == 7) dyd_json_break(j, ",\n ");
  }
  dyd_json_close(j, 1);
}

dyd_status dyd_convergence_json(const dyd_output *o) {
  const dyd_stage_table *t = o->what;
  dyd_json j;
  dyd_json_begin(&j, o->out);
  stages_json_head(&j, o);
  if (t->label) label_json(&j, t->label);
  dyd_json_array(&j, "stages", DYD_JSON_LIST);
  for (size_t k = 0; k < t->stages->count; k++) stage_json(&j, t, t->stages->row[k]);
  dyd_json_close(&j, 1);
  if (t->stages->sought && t->stages->best_bits) dyd_json_index(&j, "best_bits", t->stages->best_bits);
  dyd_status st = t->modulus ? modulus_json(&j, t) : DYD_OK;
  dyd_status ended = dyd_json_end(&j, "}\n");
  return st == DYD_OK ? ended : st;
}
