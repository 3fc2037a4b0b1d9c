/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The json format: everything the engine states, written piece by piece so that memory stays small.
 *
 * All texts are our own ASCII words and numbers, so nothing needs escaping. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/json_parts.h"
#include "io/result.h"
#include <dyadel/voronoi.h>
#include <inttypes.h>

static dyd_status write_interval(FILE *out, const char *name, const dyd_interval *a) {
  bool point = dyd_interval_is_point(a);
  char *lo = dyd_end_text(a, false), *hi = point ? NULL : dyd_end_text(a, true);
  dyd_status status = lo && (hi || point) ? DYD_OK : DYD_E_NOMEM;
  if (status >= 0) fprintf(out, "\"%s\": [\"%s\", \"%s\"], ", name, lo, point ? lo : hi);
  free(lo);
  free(hi);
  return status;
}

static void write_outward(FILE *out, const char *name, const double end[2]) {
  fprintf(out, "\"%s\": [", name);
  dyd_decimal_json(out, end[0], DYD_DOWN);
  fputs(", ", out);
  dyd_decimal_json(out, end[1], DYD_UP);
  fputs("]", out);
}

static dyd_status write_site(const dyd_result *r, size_t i, dyd_rect *rect) {
  double box[4];
  dyd_sites_get_d(box, r->sites, i);
  dyd_status status = dyd_sites_get(rect, r->sites, i);
  if (status < 0) return status;
  fprintf(r->out, "%s\n{\"i\": %zu, ", i ? "," : "", i);
  status = write_interval(r->out, "x", &rect->x);
  if (status >= 0) status = write_interval(r->out, "y", &rect->y);
  write_outward(r->out, "x_decimal", box);
  fputs(", ", r->out);
  write_outward(r->out, "y_decimal", box + 2);
  fputs("}", r->out);
  return status;
}

static dyd_status write_sites(const dyd_result *r) {
  dyd_rect rect;
  dyd_rect_init(&rect);
  dyd_status status = DYD_OK;
  fputs("\"sites\": [", r->out);
  for (size_t i = 0; i < r->count && status >= 0; i++) status = write_site(r, i, &rect);
  fputs("\n],\n", r->out);
  dyd_json_aliases(r->out, r->pd, r->count, ",\n");
  dyd_rect_clear(&rect);
  return status;
}

static void write_pairs(const dyd_result *r) {
  fputs("\"pairs\": [", r->out);
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    fprintf(r->out, "%s\n{\"i\": %u, \"j\": %u, \"status\": \"%s\"}", k ? "," : "", (unsigned)p->i, (unsigned)p->j,
            dyd_pair_status_text(p->status));
  }
  fputs("\n],\n", r->out);
}

static dyd_status write_triangles(const dyd_result *r) {
  dyd_triangle_list list = {0};
  dyd_status status = dyd_delaunay_triangles(&list, r->pd);
  fputs("\"triangles\": [", r->out);
  for (size_t k = 0; k < list.count; k++) {
    const uint32_t *v = list.item[k].v;
    fprintf(r->out, "%s[%u, %u, %u]",
            k == 0  ? ""
            : k % 8 ? ", "
                    : ",\n",
            (unsigned)v[0], (unsigned)v[1], (unsigned)v[2]);
  }
  fputs("],\n", r->out);
  dyd_triangle_list_clear(&list);
  return status;
}

/* The hull: possible pairs as hull edges; "capped" when they are too many to be listed. */
static dyd_status write_hull(const dyd_result *r) {
  dyd_hull hull = {0};
  dyd_status status = dyd_delaunay_partial_hull(&hull, r->pd);
  const dyd_index_list *list[2] = {&hull.sure_vertices, &hull.possible_vertices};
  fprintf(r->out, "\"hull\": {\"capped\": %s", status == DYD_CAPPED ? "true" : "false");
  for (int n = 0; n < 2; n++) {
    fprintf(r->out, ",\n\"%s_vertices\": [", n ? "possible" : "sure");
    for (size_t k = 0; k < list[n]->count; k++) fprintf(r->out, "%s%u", k ? ", " : "", (unsigned)list[n]->item[k]);
    fputs("]", r->out);
  }
  fputs(",\n\"edges\": [", r->out);
  for (size_t k = 0; k < hull.pairs.count; k++) {
    const dyd_pair *p = &hull.pairs.item[k];
    fprintf(r->out, "%s\n{\"i\": %u, \"j\": %u, \"status\": \"%s\"}", k ? "," : "", (unsigned)p->i, (unsigned)p->j,
            dyd_pair_status_text(p->status));
  }
  fputs("\n]},\n", r->out);
  dyd_hull_clear(&hull);
  return status;
}

/* No bounds exist for a capped result: its pairs are not all known. */
static dyd_status write_bounds(const dyd_result *r) {
  dyd_dyadic area, hausdorff;
  dyd_dyadic_init(&area);
  dyd_dyadic_init(&hausdorff);
  fputs("\"bounds\": ", r->out);
  dyd_status status = dyd_engine_bounds(&area, &hausdorff, r->engine);
  if (status == DYD_OK) {
    fputs("{", r->out);
    status = dyd_json_bound(r->out, "area", &area);
    fputs(", ", r->out);
    if (status >= 0) status = dyd_json_bound(r->out, "hausdorff", &hausdorff);
    fputs("},\n", r->out);
  } else if (status != DYD_E_NOMEM) {
    fputs("null,\n", r->out);
    status = DYD_OK;
  }
  dyd_dyadic_clear(&area);
  dyd_dyadic_clear(&hausdorff);
  return status;
}

static void write_counters(const dyd_result *r) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_engine_get_counters(&c, r->engine, NULL);
  const dyd_delaunay_counters *d = &c.delaunay;
  fprintf(r->out,
          "\"counters\": {\"stages\": %" PRIu64 ", \"stream_calls\": %" PRIu64 ", \"bits_least\": %" PRId64
          ", \"bits_most\": %" PRId64 ", \"bits_total\": %" PRIu64 ",\n\"undecided_faces\": %" PRIu64
          ", \"faces_worked_on\": %" PRIu64 ", \"filter\": %" PRIu64 ", \"integer\": %" PRIu64 ", \"exact\": %" PRIu64
          ",\n\"witness_guess\": %" PRIu64 ", \"witness_search\": %" PRIu64 ", \"cover_walks\": %" PRIu64
          ", \"milliseconds_rounded_up\": %" PRIu64 "}\n",
          c.stages, c.calls, c.bits_least, c.bits_most, c.bits_total, c.undecided_faces, d->faces, d->filter,
          d->integer, d->exact, d->witness_guess, d->witness_search, d->cover_walks, (uint64_t)(c.seconds * 1000) + 1);
}

static void write_head(const dyd_result *r) {
  size_t count[4];
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, r->engine);
  dyd_delaunay_count(count, r->pd);
  fprintf(r->out,
          "{\"format\": \"dyadel delaunay 1\",\n\"version\": \"%s\",\n"
          "\"rounding\": \"x, y and exact are exact; x_decimal and y_decimal are rounded outward: the first down, the "
          "second up; decimal is rounded up; null is beyond the largest double\",\n"
          "\"outcome\": \"%s\",\n\"goal\": \"%s\",\n",
          dyd_version(), dyd_outcome_text(dyd_engine_outcome(r->engine)), dyd_goal_text(goal));
  if (goal != DYD_GOAL_DECIDED) fprintf(r->out, "\"goal_bits\": %" PRId64 ",\n", bits);
  fprintf(r->out,
          "\"capped\": %s,\n\"count\": {\"sites\": %zu, \"legal\": %zu, \"indeterminate\": %zu, \"tie\": %zu},\n",
          dyd_delaunay_is_capped(r->pd) ? "true" : "false", r->count, count[DYD_LEGAL], count[DYD_INDETERMINATE],
          count[DYD_TIE]);
}

/* Only for a capped result: pairs within one of these faces may be possible without being listed. */
static dyd_status write_faces(const dyd_result *r) {
  if (!dyd_delaunay_is_capped(r->pd)) return DYD_OK;
  dyd_index_list face = {0};
  dyd_status status = DYD_OK;
  fputs("\"faces\": [", r->out);
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(r->pd) && status >= 0; f++) {
    bool outer;
    status = dyd_delaunay_face(&face, &outer, r->pd, f);
    if (status < 0) break;
    fputs(f ? ",\n[" : "\n[", r->out);
    for (size_t k = 0; k < face.count; k++) fprintf(r->out, "%s%u", k ? ", " : "", (unsigned)face.item[k]);
    fputs("]", r->out);
  }
  fputs("],\n", r->out);
  dyd_index_list_clear(&face);
  return status;
}

dyd_status dyd_write_json(const dyd_result *r, dyd_error *err) {
  write_head(r);
  dyd_status status = write_bounds(r);
  if (status >= 0) status = write_sites(r);
  if (status >= 0) write_pairs(r);
  if (status >= 0) status = write_faces(r);
  if (status >= 0) status = write_triangles(r);
  if (status >= 0) status = write_hull(r);
  if (status >= 0) write_counters(r);
  fputs("}\n", r->out);
  return status < 0 ? dyd_fail(err, status, "%s", dyd_status_text(status)) : DYD_OK;
}
