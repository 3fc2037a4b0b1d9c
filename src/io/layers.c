/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of layers, and those of the triangulation, of tolerances and plans.
 *
 * A new layer: its constant in dyadel/io.h; here its columns, its rows and its row of the table. In wkt and geojson
 * each rectangle is drawn as one place; on a sphere places are in degrees, and sides are great circles. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */
#include "io/table.h"

#include "base/alloc.h"
#include "base/index.h"
#include "base/local.h"
#include "io/diagram.h"
#include "io/geodesic.h"
#include "rect/rect.h"
#include <math.h>

enum { TRIANGLE_ARC = 2 }; /* degrees */

/* ---- comments of csv ---- */

static dyd_status alias_comments(dyd_table *t, const dyd_output *o) {
  dyd_csv_aliases(o->out, t->engine, t->sphere);
  return DYD_OK;
}

static dyd_status capped_faces(const dyd_result *r, FILE *out) {
  DYD_SCOPED(dyd_index_list) face = {0};
  dyd_status st = DYD_OK;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(r->pd) && st == DYD_OK; f++) {
    bool outer;
    st = dyd_delaunay_face(&face, &outer, r->pd, f);
    if (st != DYD_OK) break;
    fputs("# face ", out);
    dyd_put_rows(out, r->engine, &face, " ");
    fputs("\n", out);
  }
  return st;
}

/* Aliases, and the faces within which more may be possible than is listed or counted. */
static dyd_status pair_comments(dyd_table *t, const dyd_output *o) {
  const dyd_result *r = o->what;
  alias_comments(t, o);
  if (!dyd_delaunay_is_capped(r->pd)) return DYD_OK;
  fputs(r->sphere ? "# capped: further pairs may be possible\n"
                  : "# capped: pairs within one of these faces may be possible though they are not listed\n",
        o->out);
  return r->sphere ? DYD_OK : capped_faces(r, o->out);
}

static dyd_status point_comments(dyd_table *t, const dyd_output *o) {
  dyd_status st = pair_comments(t, o);
  fputs(t->sphere ? "# rounding: lo down, hi up\n" : "# rounding: lo down, hi up; empty: beyond doubles\n", o->out);
  return st;
}

/* ---- pairs ---- */

/* Bounds of the distance of two sites, where they are wanted. */
static dyd_status row_lengths(dyd_table *t, uint32_t i, uint32_t j) {
  double lo, hi;
  if (!t->lengths || t->box) return DYD_OK;
  DYD_LOCAL(dyd_rect, a, b);
  dyd_status st = dyd_sites_get(&a, dyd_engine_sites(t->engine), i);
  if (st == DYD_OK) st = dyd_sites_get(&b, dyd_engine_sites(t->engine), j);
  if (st == DYD_OK) dyd_rect_distance(&lo, &hi, &a, &b);
  if (st == DYD_OK) dyd_row_decimal(t, lo, DYD_DOWN), dyd_row_decimal(t, hi, DYD_UP);
  return st;
}

/* The row of two sites begins: the line between them, and their columns. */
static dyd_status row_line(dyd_table *t, size_t i, size_t j) {
  dyd_row_begin(t);
  dyd_status st = t->box ? dyd_row_arc(t, t->box[i], t->box[j]) : DYD_OK;
  if (t->place) dyd_row_place(t, &t->place[i]), dyd_row_place(t, &t->place[j]);
  dyd_row_site(t, i);
  dyd_row_site(t, j);
  return st;
}

static dyd_status row_pair(dyd_table *t, uint32_t i, uint32_t j, const char *status) {
  dyd_status st = row_line(t, i, j);
  dyd_row_word(t, status);
  if (st == DYD_OK) st = row_lengths(t, i, j);
  dyd_row_end_two(t, i, j);
  return st;
}

/* The pairs of i and later sites; pairs that the list does not have from *next on are ties. */
static dyd_status pairs_of_site(dyd_table *t, const dyd_result *r, uint32_t i, size_t *next) {
  DYD_SCOPED(dyd_index_list) near = {0};
  dyd_status st = dyd_delaunay_neighbours(&near, r->pd, i, DYD_TIE);
  for (size_t q = 0; q < near.count && st == DYD_OK; q++) {
    const dyd_pair *p = *next < r->pairs.count ? &r->pairs.item[*next] : NULL;
    bool listed = p && p->i == i && p->j == near.item[q];
    if (near.item[q] < i) continue;
    *next += listed;
    st = row_pair(t, i, near.item[q], dyd_pair_status_text(listed ? p->status : DYD_TIE));
  }
  return st;
}

/* Places of the second sites are prefetched, since they lie anywhere in memory. */
static dyd_status rows_of_pairs(dyd_table *t, const dyd_output *o) {
  enum { AHEAD = 12 };
  const dyd_result *r = o->what;
  size_t next = 0;
  dyd_status st = DYD_OK;
  for (uint32_t i = 0; r->ties_apart && i < r->count && st == DYD_OK; i++)
    if (dyd_delaunay_alias(r->pd, i) == i) st = pairs_of_site(t, r, i, &next);
  for (size_t k = 0; !r->ties_apart && k < r->pairs.count && st == DYD_OK; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    if (t->place && k + AHEAD < r->pairs.count) {
      __builtin_prefetch(t->place[p[AHEAD].j].x);
      __builtin_prefetch(t->place[p[AHEAD].j].length);
    }
    st = row_pair(t, p->i, p->j, dyd_pair_status_text(p->status));
  }
  return st;
}

static dyd_status rows_of_graph(dyd_table *t, const dyd_output *o) {
  const dyd_result *r = o->what;
  for (size_t k = 0; k < r->graph.count; k++)
    row_pair(t, r->graph.item[k].i, r->graph.item[k].j, r->graph.item[k].sure ? "certain" : "possible");
  return DYD_OK;
}

/* ---- points ---- */

/* Where site i may be. */
static dyd_status site_box(double box[4], const dyd_result *r, uint32_t i) {
  dyd_status st = DYD_OK;
  if (!r->sphere) {
    dyd_sites_get_d(box, r->sites, i);
    return DYD_OK;
  }
  DYD_LOCAL(dyd_rect, place);
  st = dyd_sphere_rect(&place, r->sphere, i);
  dyd_rect_get_d(box, &place);
  return st;
}

static dyd_status rows_of_points(dyd_table *t, const dyd_output *o) {
  const dyd_result *r = o->what;
  DYD_FREED dyd_site_row *rows = NULL;
  dyd_status st = dyd_result_sites(&rows, r);
  for (uint32_t i = 0; i < r->count && st == DYD_OK; i++) {
    double box[4];
    st = site_box(box, r, i);
    dyd_row_begin(t);
    dyd_row_spot(t, i);
    dyd_row_own(t, i);
    dyd_row_box(t, box);
    for (int status = DYD_LEGAL; status >= DYD_TIE; status--) dyd_row_index(t, rows[i].partners[status]);
    dyd_row_word(t, rows[i].hull);
    dyd_row_end(t);
  }
  return st;
}

/* Rows without a point of their own, at the place of the one they have in common. */
static dyd_status rows_of_aliases(dyd_table *t, const dyd_output *o) {
  (void)o;
  dyd_alias_walk w = {.e = t->engine};
  while (dyd_alias_next(&w)) {
    double box[4];
    dyd_sites_get_d(box, dyd_engine_sites(t->engine), w.site);
    dyd_row_begin(t);
    if (dyd_box_is_finite(box)) dyd_row_at(t, box);
    dyd_row_index(t, w.row);
    dyd_row_index(t, w.of);
    dyd_row_end(t);
  }
  return DYD_OK;
}

/* ---- ties ---- */

static dyd_status row_group(void *context, dyd_group_kind kind, const dyd_index_list *sites) {
  dyd_table *t = context;
  dyd_row_begin(t);
  dyd_row_word(t, dyd_group_text(kind));
  dyd_row_sites(t, sites);
  dyd_row_end(t);
  return DYD_OK;
}

static dyd_status rows_of_ties(dyd_table *t, const dyd_output *o) {
  return dyd_delaunay_each_group(((const dyd_result *)o->what)->pd, row_group, t);
}

/* ---- triangles ---- */

/* A triangle that is no less than half of the sphere has the other side of its corners on its left. */
static dyd_status triangle_outline(dyd_table *t, const uint32_t v[3]) {
  dyd_lon_lat corner[3];
  dyd_side side[3];
  for (int c = 0; !t->box && c < 4; c++) dyd_row_spot(t, v[c % 3]);
  if (!t->box) return DYD_OK;
  for (int c = 0; c < 3; c++) corner[c] = dyd_lon_lat_of(t->box[v[c]]);
  for (int c = 0; c < 3; c++) side[c] = (dyd_side){.from = corner[c], .to = corner[(c + 1) % 3]};
  return dyd_turns_left(corner) ? dyd_row_around(t, side, 3, TRIANGLE_ARC) : DYD_OK;
}

static dyd_status rows_of_triangles(dyd_table *t, const dyd_output *o) {
  DYD_SCOPED(dyd_triangle_list) list = {0};
  dyd_status st = dyd_result_triangles(&list, o->what);
  for (size_t k = 0; k < list.count && st == DYD_OK; k++) {
    dyd_row_begin(t);
    st = triangle_outline(t, list.item[k].v);
    dyd_row_three(t, list.item[k].v, false);
    dyd_row_three(t, list.item[k].v, true);
    dyd_row_end(t);
  }
  return st;
}

/* ---- T as a region ---- */

/* Vertices in turn, exactly: "0 0;1 0;1/2 2"; and a polygon, which is empty where they are a segment. */
static dyd_status row_corners(dyd_table *t, mpq_t *xy, size_t n) {
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_rect, r);
  if (n > 2 && t->drawn) dyd_row_part(t);
  for (size_t k = 0; k <= n && st == DYD_OK; k++) {
    mpq_t *z = &xy[2 * (k % n)];
    double box[4];
    st = dyd_interval_set_q(&r.x, z[0]);
    if (st == DYD_OK) st = dyd_interval_set_q(&r.y, z[1]);
    dyd_rect_get_d(box, &r);
    if (st == DYD_OK && n > 2 && t->drawn) dyd_row_at(t, box);
  }
  FILE *out = dyd_row_open(t);
  for (size_t k = 0; k < n; k++) gmp_fprintf(out, "%s%Qd %Qd", k ? ";" : "", xy[2 * k], xy[2 * k + 1]);
  dyd_row_close(t);
  return st;
}

/* The hull of n sites. */
static dyd_status row_hull(dyd_table *t, const uint32_t *site, int n, const char *status) {
  DYD_LOCAL_ARRAY(dyd_rect, own, [3]);
  DYD_LOCAL_ARRAY(mpq_t, xy, [24]);
  const dyd_rect *r[3] = {&own[0], &own[1], &own[2]};
  dyd_status st = DYD_OK;
  for (int k = 0; k < n && st == DYD_OK; k++) st = dyd_sites_get(&own[k], dyd_engine_sites(t->engine), site[k]);
  dyd_row_begin(t);
  if (st == DYD_OK) st = row_corners(t, xy, dyd_rect_hull(xy, r, (size_t)n));
  for (int k = 0; k < 3; k++) k < n ? dyd_row_site(t, site[k]) : dyd_row_word(t, "");
  dyd_row_word(t, status);
  for (int k = 0; k < 3 && dyd_engine_id(t->engine, site[0]); k++) k < n ? dyd_row_id(t, site[k]) : dyd_row_word(t, "");
  dyd_row_end(t);
  return st;
}

static dyd_status rows_of_hulls(dyd_table *t, const dyd_output *o) {
  const dyd_result *r = o->what;
  DYD_SCOPED(dyd_triangle_list) list = {0};
  dyd_status st = dyd_result_triangles(&list, r);
  for (size_t k = 0; k < r->pairs.count && st == DYD_OK; k++)
    st = row_hull(t, (const uint32_t[]){r->pairs.item[k].i, r->pairs.item[k].j}, 2,
                  dyd_pair_status_text(r->pairs.item[k].status));
  for (size_t k = 0; k < list.count && st == DYD_OK; k++) st = row_hull(t, list.item[k].v, 3, "certain");
  return st;
}

static dyd_status rows_of_exterior(dyd_table *t, const dyd_output *o) {
  const dyd_exterior *e = &((const dyd_result *)o->what)->exterior;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < e->rings && st == DYD_OK; k++) {
    dyd_row_begin(t);
    st = row_corners(t, &e->xy[2 * e->offset[k]], e->offset[k + 1] - e->offset[k]);
    dyd_row_word(t, k ? "bounded" : "unbounded");
    dyd_row_end(t);
  }
  return st;
}

/* ---- tolerances ---- */

/* Aliases, the tolerance of the whole, and the number of missing rows. */
static dyd_status tolerance_comments(dyd_table *t, const dyd_output *o) {
  const dyd_result *r = o->what;
  double lo, hi;
  size_t edges, births;
  alias_comments(t, o);
  lo = dyd_tolerance_get(r->tolerance)->lo, hi = dyd_tolerance_get(r->tolerance)->hi;
  fputs("# tolerance ", o->out);
  dyd_decimal_put(o->out, lo, DYD_DOWN, "inf");
  fputs(" ", o->out);
  dyd_decimal_put(o->out, hi, DYD_UP, "inf");
  fputs("\n", o->out);
  if (!dyd_tolerance_is_cut(&edges, &births, r->tolerance)) return DYD_OK;
  fprintf(o->out, "# cut: %zu edges have no row; ", edges);
  if (births == SIZE_MAX)
    fputs("births were not all looked for\n", o->out);
  else
    fprintf(o->out, "%zu pairs that may be born have none\n", births);
  return DYD_OK;
}

/* Empty where no site binds. */
static void row_binding(dyd_table *t, uint32_t k) {
  if (k == DYD_NO_SITE)
    dyd_row_decimal(t, NAN, DYD_DOWN);
  else
    dyd_row_site(t, k);
}

static dyd_status rows_of_events(dyd_table *t, const dyd_output *o) {
  const dyd_tolerance *tolerance = ((const dyd_result *)o->what)->tolerance;
  const double *chance = dyd_tolerance_get(tolerance)->chances;
  const dyd_tolerance_row *row;
  for (size_t n = dyd_tolerance_rows(&row, tolerance); n--; row++) {
    row_line(t, row->i, row->j);
    dyd_row_word(t, dyd_tolerance_event_text(row->event));
    dyd_row_decimal(t, row->lo, DYD_DOWN);
    dyd_row_decimal(t, row->hi, DYD_UP);
    row_binding(t, row->k);
    row_binding(t, row->l);
    if (chance) dyd_row_decimal(t, *chance++, DYD_DOWN);
    dyd_row_end_two(t, row->i, row->j);
  }
  return DYD_OK;
}

static dyd_status rows_of_radii(dyd_table *t, const dyd_output *o) {
  const dyd_result *r = o->what;
  const double *radius = dyd_tolerance_get(r->tolerance)->points;
  for (size_t i = 0; i < r->count; i++) {
    dyd_row_begin(t);
    dyd_row_spot(t, i);
    dyd_row_own(t, i);
    dyd_row_decimal(t, radius[i], DYD_DOWN);
    dyd_row_end(t);
  }
  return DYD_OK;
}

/* The first of the ascending numbers that is above x. */
static size_t count_up_to(const double *sorted, size_t count, double x) {
  size_t lo = 0, hi = count;
  while (lo < hi) {
    size_t mid = lo + (hi - lo) / 2;
    if (sorted[mid] > x)
      hi = mid;
    else
      lo = mid + 1;
  }
  return lo;
}

/* Accuracies 1, 2 and 5 times powers of ten, from below the first death to where the last edge is gone. The number
 * shown is the text, so counts are those of an accuracy rounded up. */
static void rows_of_deaths(dyd_table *t, const double *death, size_t count, size_t edges) {
  static const int step[3] = {1, 2, 5};
  size_t first = count_up_to(death, count, 0);
  if (first == count) return;
  int exp = (int)floor(log10(death[first]));
  for (size_t k = 0;; k++) {
    char text[24];
    snprintf(text, sizeof text, "%de%d", step[k % 3], exp + (int)(k / 3));
    size_t gone = count_up_to(death, count, nextafter(strtod(text, NULL), INFINITY));
    dyd_row_begin(t);
    dyd_row_word(t, text);
    dyd_row_index(t, edges - gone);
    dyd_row_index(t, gone);
    dyd_row_end(t);
    if (gone == count) return;
  }
}

static dyd_status rows_of_barcode(dyd_table *t, const dyd_output *o) {
  const dyd_tolerance *tolerance = ((const dyd_result *)o->what)->tolerance;
  const dyd_tolerance_row *row;
  size_t rows = dyd_tolerance_rows(&row, tolerance), count = 0, edges, births;
  if (dyd_tolerance_is_cut(&edges, &births, tolerance)) return DYD_CANCELLED;
  DYD_FREED double *death = malloc((rows + 1) * sizeof *death);
  if (!death) return DYD_E_NOMEM;
  for (size_t k = 0; k < rows; k++) {
    edges += row[k].event == DYD_EVENT_DEATH;
    if (row[k].event == DYD_EVENT_DEATH && isfinite(row[k].lo)) death[count++] = row[k].lo;
  }
  qsort(death, count, sizeof *death, dyd_compare_double);
  rows_of_deaths(t, death, count, edges);
  return DYD_OK;
}

/* ---- plans ---- */

static dyd_status plan_comments(dyd_table *t, const dyd_output *o) {
  const dyd_survey *plan = ((const dyd_result *)o->what)->survey;
  const dyd_survey_row *row;
  size_t open, ties, left, rows = dyd_survey_rows(&row, plan);
  open = dyd_survey_get(plan)->open, ties = dyd_survey_get(plan)->ties, left = dyd_survey_get(plan)->left;
  alias_comments(t, o);
  if (dyd_survey_get(plan)->cut)
    fprintf(o->out, "# cut: the plan is not finished: %zu of %zu pairs are undecided after its first %zu points\n",
            left, open, rows);
  else if (left)
    fprintf(o->out, "# plan %zu points: not sufficient, %zu of %zu pairs stay undecided\n", rows, left, open);
  else if (rows)
    fprintf(o->out,
            "# plan %zu points: sufficient if each new position is within half_width_needed of the old one; verified\n",
            rows);
  else
    fprintf(o->out, "# plan 0 points: %s\n",
            ties ? "only pairs are undecided that tie at the nominal places" : "sufficient, every pair is decided");
  if (ties)
    fprintf(o->out, "# ties %zu: pairs that no accuracy decides, if points are at their nominal places\n", ties);
  return DYD_OK;
}

static dyd_status rows_of_plan(dyd_table *t, const dyd_output *o) {
  const dyd_result *r = o->what;
  const dyd_survey_row *row;
  size_t rows = dyd_survey_rows(&row, r->survey);
  for (size_t k = 0; k < rows && (k == 0 || !r->next); k++) {
    dyd_row_begin(t);
    dyd_row_spot(t, row[k].site);
    dyd_row_index(t, k + 1);
    dyd_row_site(t, row[k].site);
    dyd_row_brief(t, row[k].now, false);
    dyd_row_brief(t, row[k].needed, true);
    dyd_row_index(t, row[k].decided);
    dyd_row_index(t, row[k].left);
    dyd_row_id(t, row[k].site);
    dyd_row_carried(t, row[k].site);
    dyd_row_end(t);
  }
  return DYD_OK;
}

static dyd_status rows_of_plan_pairs(dyd_table *t, const dyd_output *o) {
  const dyd_survey_pair *pair;
  const size_t pairs = dyd_survey_pairs(&pair, ((const dyd_result *)o->what)->survey);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < pairs && st == DYD_OK; k++) {
    st = row_line(t, pair[k].i, pair[k].j);
    if (pair[k].row == SIZE_MAX)
      dyd_row_decimal(t, NAN, DYD_DOWN);
    else
      dyd_row_index(t, pair[k].row + 1);
    dyd_row_end_two(t, pair[k].i, pair[k].j);
  }
  return st;
}

/* "# trials 1000: 1 round in 912, 2 in 80, at most 3; 14.2 points measured on average" */
static dyd_status trial_comments(dyd_table *t, const dyd_output *o) {
  const dyd_trials_output *of = o->what;
  size_t rounds[3] = {0}, most = 0, points = 0, done = 0, left = 0;
  (void)t;
  for (size_t k = 0; k < of->count; k++) {
    const dyd_survey_trial *one = &of->trial[k];
    if (!one->done) continue;
    done++;
    points += one->points;
    left += one->left > 0;
    most = one->rounds > most ? one->rounds : most;
    if (one->rounds < 3) rounds[one->rounds]++;
  }
  fprintf(o->out, "# trials %zu of %zu:", done, of->count);
  for (size_t k = 0; k < 3; k++)
    if (rounds[k]) fprintf(o->out, " %zu round%s in %zu,", k, k == 1 ? "" : "s", rounds[k]);
  fprintf(o->out, " at most %zu", most);
  const size_t tenths = done ? (10 * points + done / 2) / done : 0;
  fprintf(o->out, "; %zu.%zu points measured on average", tenths / 10, tenths % 10);
  fprintf(o->out, left ? "; pairs stay undecided in %zu\n" : "\n", left);
  return DYD_OK;
}

static dyd_status rows_of_trials(dyd_table *t, const dyd_output *o) {
  const dyd_trials_output *of = o->what;
  for (size_t k = 0; k < of->count; k++) {
    const dyd_survey_trial *one = &of->trial[k];
    if (!one->done) continue;
    dyd_row_begin(t);
    dyd_row_index(t, k);
    dyd_row_index(t, one->rounds);
    dyd_row_index(t, one->points);
    dyd_row_index(t, one->measurements);
    dyd_row_index(t, one->left);
    dyd_row_end(t);
  }
  return DYD_OK;
}

/* ---- the table ---- */

#define POINT DYD_GEOMETRY_POINT
#define LINE DYD_GEOMETRY_LINE
#define POLYGON DYD_GEOMETRY_POLYGON
#define LINES DYD_GEOMETRY_LINES
#define POLYGONS DYD_GEOMETRY_POLYGONS
#define IN(name) DYD_CONTENT_##name
#define PAIRS "i,j,status,?length_lo,?length_hi,id_i,id_j"
#define POINTS "i,id,*,xlo,xhi,ylo,yhi,legal,indeterminate,tie,hull"
#define TRIANGLES "i,j,k,id_i,id_j,id_k"

/* content, name, layer of, in wkt and geojson, drawn at sites, large, geometry, comments, rows, columns */
static const dyd_layer layers[] = {
    {IN(DELAUNAY), "pairs", IN(DELAUNAY), true, true, false, LINE, pair_comments, rows_of_pairs, PAIRS},
    {IN(POINTS), "points", IN(DELAUNAY), true, true, false, POINT, point_comments, rows_of_points, POINTS},
    {IN(TRIANGLES), "triangles", IN(DELAUNAY), true, true, false, POLYGON, alias_comments, rows_of_triangles,
     TRIANGLES},
    {IN(GRAPH_NEAREST), "graph:nearest", IN(DELAUNAY), true, true, false, LINE, alias_comments, rows_of_graph, PAIRS},
    {IN(GRAPH_GABRIEL), "graph:gabriel", IN(DELAUNAY), true, true, false, LINE, alias_comments, rows_of_graph, PAIRS},
    {IN(GRAPH_MST), "graph:mst", IN(DELAUNAY), true, true, false, LINE, alias_comments, rows_of_graph, PAIRS},
    {IN(ALIASES), "aliases", IN(DELAUNAY), true, false, false, POINT, NULL, rows_of_aliases, "i,of"},
    {IN(HULLS), "hulls", IN(DELAUNAY), true, false, true, POLYGONS, alias_comments, rows_of_hulls,
     "corners,i,j,k,status,id_i,id_j,id_k"},
    {IN(EXTERIOR), "exterior", IN(DELAUNAY), true, false, true, POLYGONS, alias_comments, rows_of_exterior,
     "corners,part"},
    {IN(TIES), "ties", IN(DELAUNAY), false, false, false, POINT, NULL, rows_of_ties, "kind,sites"},
    {IN(VORONOI), "cells", IN(VORONOI), true, false, false, POLYGON, dyd_cell_comments, dyd_cell_rows,
     "?kind,i,id,*,xlo,xhi,ylo,yhi,area_lo,area_hi,undetermined"},
    {IN(TILES), "tiles", IN(VORONOI), true, false, false, POLYGON, dyd_tile_comments, dyd_tile_rows,
     "i,id,*,area,certain_area,area_lo,area_hi"},
    {IN(VERTICES), "vertices", IN(VORONOI), true, false, false, POINT, dyd_vertex_comments, dyd_vertex_rows,
     "i,j,k,xlo,xhi,ylo,yhi,id_i,id_j,id_k"},
    {IN(REGIONS), "regions", IN(VORONOI), true, false, false, POLYGON, dyd_diagram_comments, dyd_region_rows,
     "face,xlo,xhi,ylo,yhi,sites"},
    {IN(EDGES), "edges", IN(VORONOI), true, false, false, LINE, dyd_diagram_comments, dyd_edge_rows,
     "i,j,left,right,id_i,id_j"},
    {IN(VORONOI_ALIASES), "aliases", IN(VORONOI), true, false, false, POINT, NULL, rows_of_aliases, "i,of"},
    {IN(TOLERANCE), "pairs", IN(TOLERANCE), true, true, false, LINE, tolerance_comments, rows_of_events,
     "i,j,event,lo,hi,k,l,?probability,id_i,id_j"},
    {IN(RADII), "points", IN(TOLERANCE), true, true, false, POINT, tolerance_comments, rows_of_radii, "i,id,*,rho"},
    {IN(BARCODE), "barcode", IN(TOLERANCE), false, false, false, POINT, tolerance_comments, rows_of_barcode,
     "accuracy,certain,open"},
    {IN(PLAN), "points", IN(PLAN), true, true, false, POINT, plan_comments, rows_of_plan,
     "rank,i,half_width_now,half_width_needed,pairs_decided,pairs_left,id,*"},
    {IN(PLAN_PAIRS), "pairs", IN(PLAN), true, true, false, LINES, plan_comments, rows_of_plan_pairs,
     "i,j,rank,id_i,id_j"},
    {IN(TRIALS), NULL, IN(TRIALS), false, false, false, POINT, trial_comments, rows_of_trials,
     "trial,rounds,points,measurements,pairs_left"},
    {IN(SPHERE), "pairs", IN(SPHERE), true, true, false, LINES, pair_comments, rows_of_pairs, PAIRS},
    {IN(SPHERE_POINTS), "points", IN(SPHERE), true, true, false, POINT, point_comments, rows_of_points, POINTS},
    {IN(SPHERE_TRIANGLES), "triangles", IN(SPHERE), true, true, false, POLYGONS, alias_comments, rows_of_triangles,
     TRIANGLES},
    {IN(SPHERE_VORONOI), "cells", IN(SPHERE_VORONOI), true, false, false, POLYGONS, alias_comments, dyd_globe_cell_rows,
     "i,id,*,complete,vertices"},
    {IN(SPHERE_VERTICES), "vertices", IN(SPHERE_VORONOI), true, false, false, POINT, dyd_globe_vertex_comments,
     dyd_globe_vertex_rows, "i,j,k,id_i,id_j,id_k,xlo,xhi,ylo,yhi"},
    {IN(SPHERE_REGIONS), "regions", IN(SPHERE_VORONOI), false, false, false, POINT, alias_comments,
     dyd_globe_region_rows, "face,status,sites"},
    {IN(CHECK), NULL, IN(CHECK), false, false, false, POINT, NULL, dyd_check_rows,
     "fault,schedules,stages,pairs,cells,floors,seed,moves"},
    {IN(DISC), "circles", IN(DISC), false, false, false, POINT, dyd_disc_comments, dyd_disc_rows,
     "circle,x,y,radius_squared,xlo,xhi,ylo,yhi,rlo,rhi"},
    {IN(CON), "con", IN(DISC), false, false, false, POINT, dyd_disc_comments, dyd_con_rows, "i,con,id"},
    {IN(BISECTOR), NULL, IN(BISECTOR), false, false, false, POINT, dyd_bisector_comments, dyd_bisector_rows,
     "far,near,kind,corner,feature,begin,begin_x,begin_y,begin_xlo,begin_xhi,begin_ylo,begin_yhi,end,end_x,end_y,"
     "end_xlo,end_xhi,end_ylo,end_yhi,id_far,id_near"},
    {IN(NEAREST), NULL, IN(NEAREST), false, false, false, POINT, dyd_nearest_comments, dyd_nearest_rows,
     "i,status,lo,hi,id"},
    {IN(PLACES), NULL, IN(PLACES), false, false, false, POINT, dyd_nearest_comments, dyd_nearest_rows,
     "q,?id_q,i,status,lo,hi,id"},
};

const dyd_layer *dyd_layer_at(size_t k) {
  return k < sizeof layers / sizeof *layers ? &layers[k] : NULL;
}

const dyd_layer *dyd_layer_of(dyd_content content) {
  size_t k = 0;
  while (dyd_layer_at(k) && layers[k].content != content) k++;
  return dyd_layer_at(k);
}

/* ---- writing ---- */

/* Where the sites of a layer are drawn. */
static dyd_status layer_places(dyd_table *t, const dyd_output *o) {
  const dyd_result *r = o->what;
  dyd_status st = DYD_OK;
  if (!t->layer->sites || !t->drawn) return DYD_OK;
  if (t->sphere) return dyd_sphere_boxes(&t->box, t->sphere);
  t->place = dyd_alloc(r->count, sizeof *t->place);
  if (!t->place) return DYD_E_NOMEM;
  for (size_t i = 0; i < r->count && st == DYD_OK; i++) {
    double box[4];
    st = dyd_result_box(box, r, i, o->err);
    if (st == DYD_OK) dyd_short_place_set(&t->place[i], box);
  }
  return st;
}

/* Returns true if the optional columns are present. */
static bool is_whole(const dyd_table *t, const dyd_output *o) {
  if (o->content == DYD_CONTENT_PLACES) return dyd_nearest_named(o->what);
  if (t->layer->of == DYD_CONTENT_DELAUNAY || t->layer->of == DYD_CONTENT_SPHERE) return t->lengths;
  if (o->content != DYD_CONTENT_TOLERANCE) return t->drawn;
  return dyd_tolerance_get(((const dyd_result *)o->what)->tolerance)->chances;
}

/* Comments find what rows need, also where they are not wanted. */
static dyd_status layer_comments(dyd_table *t, const dyd_output *o) {
  dyd_output to = *o;
  DYD_FREED char *text = NULL;
  size_t size;
  if (t->drawn || !t->layer->comments) return DYD_OK;
  to.out = o->comments ? o->comments : open_memstream(&text, &size);
  dyd_status st = to.out ? t->layer->comments(t, &to) : DYD_E_NOMEM;
  if (to.out && !o->comments) fclose(to.out);
  return st;
}

dyd_status dyd_layer_write(const dyd_output *o) {
  const dyd_layer *layer = dyd_layer_of(o->content);
  bool cut = o->content == DYD_CONTENT_TILES && ((const dyd_diagram *)o->what)->clip_to;
  dyd_table t = {.layer = layer,
                 .geometry = cut                                      ? DYD_GEOMETRY_POLYGONS
                             : layer->geometry == LINES && !o->sphere ? LINE
                                                                      : layer->geometry,
                 .engine = o->engine,
                 .sphere = o->sphere,
                 .lengths = o->lengths && !o->sphere,
                 .clip = o->clip,
                 .drawn = dyd_format_draws(o->format)};
  dyd_status st = layer_places(&t, o);
  if (st == DYD_OK) st = layer_comments(&t, o);
  if (st == DYD_OK) {
    dyd_table_begin(&t, o, is_whole(&t, o));
    st = t.layer->rows(&t, o);
    dyd_table_end(&t);
  }
  dyd_free_all(t.kept, t.box, t.place);
  return st;
}
