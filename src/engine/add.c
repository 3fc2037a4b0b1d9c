/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Adding points to an engine, before its first run and later.
 *
 * Statements are about all points, so later points end the result: the next run triangulates anew, from the rectangles
 * reached, or puts exact points into the result that there was. Statements are monotone for the points at hand, not for
 * more of them. */
#include "engine/add.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "engine/labels.h"
#include "engine/points.h"
#include "engine/state.h"
#include "rect/columns_filter.h"
#include "rect/sites_table.h"
#include "stream/stream.h"

#include <math.h>

/* ---- when points may come ---- */

dyd_status dyd_engine_may_add(const dyd_engine *e, dyd_error *err) {
  if (err) dyd_error_clear(err);
  if (!dyd_engine_is_busy(e)) return DYD_OK;
  return dyd_fail(err, DYD_E_ARG, "the engine is at work: no callback of it, and no other thread, may add points");
}

/* Ends a call that found `before` points; told: *err has the reason of a failure. */
static dyd_status added(dyd_engine *e, size_t before, dyd_status st, bool told, dyd_error *err) {
  if (st == DYD_OK && dyd_sites_count(e->sites) > before) dyd_engine_end_result(e);
  return st == DYD_OK || told ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

/* The message about one side of a new point. */
static dyd_status side_fail(dyd_error *err, size_t point, const char *axis, double at) {
  if (err) err->point = point;
  return dyd_fail(err, DYD_E_ARG, "point %zu: %s is %g; coordinates are finite numbers", point, axis, at);
}

/* One side of n boxes (of points, where lo = hi), the first of which would be point `first`. */
static dyd_status side_check(size_t first, size_t n, const double *lo, const double *hi, const char *axis,
                             dyd_error *err) {
  for (size_t k = 0; k < n; k++) {
    if (!isfinite(lo[k]) || !isfinite(hi[k])) return side_fail(err, first + k, axis, isfinite(lo[k]) ? hi[k] : lo[k]);
    if (lo[k] <= hi[k]) continue;
    if (err) err->point = first + k;
    return dyd_fail(err, DYD_E_ARG,
                    "point %zu: the lower end of %s, %.17g, is above the upper one, %.17g; exchange them", first + k,
                    axis, lo[k], hi[k]);
  }
  return DYD_OK;
}

/* ---- doubles ---- */

dyd_status dyd_engine_add_boxes(dyd_engine *e, size_t n, const double *x0, const double *x1, const double *y0,
                                const double *y1, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, err);
  if (st != DYD_OK) return st;
  st = x0 == x1 && y0 == y1 ? dyd_sites_add_points(e->sites, n, x0, y0)
                            : dyd_sites_add_boxes(e->sites, n, x0, x1, y0, y1);
  bool told = st == DYD_E_ARG &&
              (side_check(before, n, x0, x1, "x", err) != DYD_OK || side_check(before, n, y0, y1, "y", err) != DYD_OK);
  return added(e, before, st, told, err);
}

dyd_status dyd_engine_add_points(dyd_engine *e, size_t n, const double *x, const double *y, dyd_error *err) {
  return dyd_engine_add_boxes(e, n, x, x, y, y, err);
}

/* Why column a gives no sides, the first of point `first`. */
static dyd_status column_check(size_t first, size_t n, const dyd_column *x, const dyd_column *radius, const char *axis,
                               dyd_error *err) {
  for (size_t k = 0; k < n; k++) {
    double lo, hi, at = dyd_column_at(x, k), r = radius ? dyd_column_at(radius, k) : 0;
    if (dyd_widen_d(&lo, &hi, at, r)) continue;
    if (!isfinite(at)) return side_fail(err, first + k, axis, at);
    if (err) err->point = first + k;
    return dyd_fail(err, DYD_E_ARG,
                    "point %zu: the radius in %s is %.17g; radii are finite, not negative, and small enough for "
                    "doubles",
                    first + k, axis, r);
  }
  return DYD_OK;
}

dyd_status dyd_engine_add_columns(dyd_engine *e, size_t n, const dyd_column xy[2], const dyd_column *radius,
                                  dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, err);
  if (st != DYD_OK) return st;
  st = dyd_sites_add_columns(e->sites, n, xy, radius);
  bool told = st == DYD_E_ARG && (column_check(before, n, &xy[0], radius, "x", err) != DYD_OK ||
                                  column_check(before, n, &xy[1], radius ? radius + 1 : NULL, "y", err) != DYD_OK);
  return added(e, before, st, told, err);
}

/* ---- exact ones ---- */

dyd_status dyd_engine_add_rect(dyd_engine *e, const dyd_rect *r, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, err);
  return st == DYD_OK ? added(e, before, dyd_sites_add_rect(e->sites, r), false, err) : st;
}

dyd_status dyd_engine_reserve(dyd_engine *e, size_t n) {
  return dyd_sites_reserve(e->sites, n);
}

void dyd_engine_take_back(dyd_engine *e, size_t before) {
  while (e->points && e->point[e->points - 1].site >= before) dyd_stream_free(e->point[--e->points].stream);
  dyd_sites_cut(e->sites, before);
}

dyd_status dyd_engine_add_words(dyd_engine *e, size_t n, const dyd_words *xy, bool boxes, dyd_error *err) {
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, err);
  if (st != DYD_OK) return st;
  st = boxes ? dyd_sites_add_word_boxes(e->sites, n, xy) : dyd_sites_add_words(e->sites, n, xy);
  return added(e, before, st, false, err);
}

/* ---- streams and sources ---- */

/* Appends n sites with records like p; the site number is filled in. Nothing on failure. Answers of sources are known
 * to enclose places. */
static dyd_status points_add_refinable(dyd_engine *e, size_t n, dyd_refinable p) {
  size_t first = dyd_sites_count(e->sites);
  if (n > DYD_MAX_SITES) return DYD_E_RANGE;
  if (!DYD_GROW(e->point, e->point_cap, e->points + n)) return DYD_E_NOMEM;
  dyd_site_kind kind = p.stream ? dyd_stream_site_kind(p.stream) : DYD_SITE_BARE;
  dyd_status st = dyd_sites_add_planes(e->sites, n, kind);
  if (st != DYD_OK) return st;
  for (size_t k = 0; k < n; k++) {
    p.site = (uint32_t)(first + k);
    e->point[e->points++] = p;
  }
  return DYD_OK;
}

dyd_status dyd_engine_add_stream(dyd_engine *e, dyd_stream *s, dyd_error *err) {
  if (!e || !s) return dyd_stream_free(s), dyd_fail_null(err);
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, err);
  const dyd_rect *fixed = dyd_stream_is_final(s) ? dyd_stream_rect(s) : NULL;
  if (st == DYD_OK) {
    st = fixed ? dyd_sites_add_rect(e->sites, fixed) : points_add_refinable(e, 1, (dyd_refinable){.stream = s});
    added(e, before, st, false, err);
  }
  if (fixed || st != DYD_OK) dyd_stream_free(s);
  return st;
}

static dyd_status points_add_source(dyd_engine *e, size_t n, const dyd_source *source) {
  if (!DYD_GROW(e->source, e->source_cap, e->sources + 1)) return DYD_E_NOMEM;
  size_t first = dyd_sites_count(e->sites);
  dyd_status st = points_add_refinable(e, n, (dyd_refinable){.source = (uint32_t)e->sources});
  if (st == DYD_OK) e->source[e->sources++] = (dyd_source_use){.source = *source, .first = (uint32_t)first};
  return st;
}

static dyd_status source_check(const dyd_engine *e, size_t n, const dyd_source *source, dyd_error *err) {
  size_t first = dyd_sites_count(e->sites);
  if (!source->narrow) return dyd_fail(err, DYD_E_ARG, "the source has no function `narrow`");
  for (size_t k = 0; source->cost && k < n; k++) {
    if (source->cost[k] > 0 && isfinite(source->cost[k])) continue;
    if (err) err->point = first + k;
    return dyd_fail(err, DYD_E_ARG, "point %zu: its cost is %g; costs are finite numbers above 0", first + k,
                    source->cost[k]);
  }
  return DYD_OK;
}

static dyd_status points_add_source_at_cost(dyd_engine *e, size_t n, const dyd_source *source) {
  dyd_labels labels;
  if (!source->cost) return points_add_source(e, n, source);
  dyd_status st = dyd_labels_cost(&labels, e, n, source->cost);
  if (st != DYD_OK) return st;
  st = points_add_source(e, n, source);
  if (st == DYD_OK) dyd_labels_give(e, &labels);
  dyd_labels_clear(&labels);
  return st;
}

dyd_status dyd_engine_add_source(dyd_engine *e, size_t n, const dyd_source *source, dyd_error *err) {
  dyd_source s;
  const size_t before = e ? dyd_sites_count(e->sites) : 0;
  dyd_status st = dyd_abi_take(&s, sizeof s, source, "dyd_source", err);
  if (st != DYD_OK) return st;
  st = e ? dyd_engine_may_add(e, err) : dyd_fail_null(err);
  if (st == DYD_OK) st = source_check(e, n, &s, err);
  if (st == DYD_OK) st = added(e, before, points_add_source_at_cost(e, n, &s), false, err);
  if (st != DYD_OK && s.release) s.release(s.user);
  return st;
}

/* ---- in one call ---- */

dyd_status dyd_delaunay_of(dyd_pair_list *out, size_t n, const double *xy, double radius,
                           const dyd_engine_options *options, dyd_error *err) {
  const dyd_column xys[2] = {{xy, 2 * sizeof *xy}, {xy ? xy + 1 : NULL, 2 * sizeof *xy}},
                   radii[2] = {{&radius, 0}, {&radius, 0}};
  dyd_engine *e = NULL;
  dyd_outcome outcome;
  if (!out || (n && !xy)) return dyd_fail_null(err);
  dyd_status st = dyd_engine_new(&e);
  if (st != DYD_OK) return dyd_fail_nomem(err);
  st = dyd_engine_add_columns(e, n, xys, radius == 0 ? NULL : radii, err);
  if (st == DYD_OK) st = dyd_engine_run(&outcome, e, options, err);
  if (st == DYD_OK) {
    st = dyd_delaunay_pairs(out, dyd_engine_delaunay(e));
    if (st != DYD_OK)
      dyd_fail(err, st,
               "no pair is known: the budget was spent before the first stage was complete, or memory is exhausted");
  }
  dyd_engine_free(e);
  return st;
}
