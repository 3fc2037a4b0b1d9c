/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Adding points to an engine, before its first run and later.
 *
 * Statements are about all points, so later points end the result: the next run triangulates anew, from
 * the rectangles reached. Statements are monotone for the points at hand, not for more of them. */
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
#include <string.h>

/* ---- when points may come ---- */

dyd_status dyd_engine_may_add(dyd_engine *e, bool later) {
  dyd_error_clear(&e->refused);
  if (dyd_engine_is_busy(e))
    return dyd_fail(&e->refused, DYD_E_ARG,
                    "the engine is at work: no callback of it, and no other thread, may add points");
  if (e->started && !later)
    return dyd_fail(&e->refused, DYD_E_ARG,
                    "dyd_engine_add_* is for points that are there before the first run or question; add later ones "
                    "with dyd_engine_append_*");
  return DYD_OK;
}

const dyd_error *dyd_engine_add_error(const dyd_engine *e) {
  return &e->refused;
}

/* Ends a call that found `before` points. */
static dyd_status added(dyd_engine *e, size_t before, dyd_status st) {
  if (st != DYD_OK && !e->refused.message[0]) dyd_fail(&e->refused, st, "%s", dyd_status_text(st));
  if (st == DYD_OK && dyd_sites_count(e->sites) > before) dyd_engine_end_result(e);
  return st;
}

/* Tells the caller of an append. */
static dyd_status appended(const dyd_engine *e, dyd_status st, dyd_error *err) {
  if (err) dyd_error_clear(err);
  if (err && st != DYD_OK) *err = e->refused;
  return st;
}

/* One side of n boxes (of points, where lo = hi), the first of which would be point `first`. */
static dyd_status side_check(dyd_engine *e, size_t n, const double *lo, const double *hi, const char *axis) {
  size_t first = dyd_sites_count(e->sites);
  for (size_t k = 0; k < n; k++) {
    bool low = !isfinite(lo[k]);
    e->refused.point = first + k;
    if (low || !isfinite(hi[k]))
      return dyd_fail(&e->refused, DYD_E_ARG, "point %zu: %s is %g; coordinates are finite numbers", first + k, axis,
                      low ? lo[k] : hi[k]);
    if (lo[k] > hi[k])
      return dyd_fail(&e->refused, DYD_E_ARG,
                      "point %zu: the lower end of %s, %.17g, is above the upper one, %.17g; exchange them", first + k,
                      axis, lo[k], hi[k]);
  }
  return DYD_OK;
}

/* ---- doubles ---- */

static dyd_status add_boxes(dyd_engine *e, bool later, size_t n, const double *const lo[2], const double *const hi[2]) {
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, later);
  if (st != DYD_OK) return st;
  st = lo[0] == hi[0] && lo[1] == hi[1] ? dyd_sites_add_points(e->sites, n, lo[0], lo[1])
                                        : dyd_sites_add_boxes(e->sites, n, lo[0], hi[0], lo[1], hi[1]);
  if (st == DYD_E_ARG && side_check(e, n, lo[0], hi[0], "x") == DYD_OK) side_check(e, n, lo[1], hi[1], "y");
  return added(e, before, st);
}

dyd_status dyd_engine_add_points(dyd_engine *e, size_t n, const double *x, const double *y) {
  if (!e) return DYD_E_ARG;
  const double *const at[2] = {x, y};
  return add_boxes(e, false, n, at, at);
}

dyd_status dyd_engine_append_points(dyd_engine *e, size_t n, const double *x, const double *y, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  const double *const at[2] = {x, y};
  return appended(e, add_boxes(e, true, n, at, at), err);
}

dyd_status dyd_engine_add_boxes(dyd_engine *e, size_t n, const double *x0, const double *x1, const double *y0,
                                const double *y1) {
  if (!e) return DYD_E_ARG;
  const double *const lo[2] = {x0, y0}, *const hi[2] = {x1, y1};
  return add_boxes(e, false, n, lo, hi);
}

dyd_status dyd_engine_append_boxes(dyd_engine *e, size_t n, const double *x0, const double *x1, const double *y0,
                                   const double *y1, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  const double *const lo[2] = {x0, y0}, *const hi[2] = {x1, y1};
  return appended(e, add_boxes(e, true, n, lo, hi), err);
}

/* Why column a gives no sides, the first of point `first`. */
static dyd_status column_check(dyd_engine *e, size_t n, const dyd_column *x, const dyd_column *radius,
                               const char *axis) {
  size_t first = dyd_sites_count(e->sites);
  for (size_t k = 0; k < n; k++) {
    double lo, hi, at = dyd_column_at(x, k), r = radius ? dyd_column_at(radius, k) : 0;
    if (dyd_widen_d(&lo, &hi, at, r)) continue;
    e->refused.point = first + k;
    if (!isfinite(at))
      return dyd_fail(&e->refused, DYD_E_ARG, "point %zu: %s is %g; coordinates are finite numbers", first + k, axis,
                      at);
    return dyd_fail(&e->refused, DYD_E_ARG,
                    "point %zu: the radius in %s is %.17g; radii are finite, not negative, and small enough for "
                    "doubles",
                    first + k, axis, r);
  }
  return DYD_OK;
}

dyd_status dyd_engine_append_columns(dyd_engine *e, size_t n, const dyd_column xy[2], const dyd_column *radius,
                                     dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, true);
  if (st != DYD_OK) return appended(e, st, err);
  st = dyd_sites_add_columns(e->sites, n, xy, radius);
  if (st == DYD_E_ARG && column_check(e, n, &xy[0], radius, "x") == DYD_OK)
    column_check(e, n, &xy[1], radius ? radius + 1 : NULL, "y");
  return appended(e, added(e, before, st), err);
}

/* ---- exact ones ---- */

static dyd_status add_rect(dyd_engine *e, bool later, const dyd_rect *r) {
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, later);
  return st != DYD_OK ? st : added(e, before, dyd_sites_add_rect(e->sites, r));
}

dyd_status dyd_engine_add_rect(dyd_engine *e, const dyd_rect *r) {
  if (!e) return DYD_E_ARG;
  return add_rect(e, false, r);
}

dyd_status dyd_engine_append_rect(dyd_engine *e, const dyd_rect *r, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  return appended(e, add_rect(e, true, r), err);
}

dyd_status dyd_engine_reserve(dyd_engine *e, size_t n) {
  return dyd_sites_reserve(e->sites, n);
}

dyd_status dyd_engine_append_words(dyd_engine *e, size_t n, const dyd_words *xy, dyd_error *err) {
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, true);
  if (st == DYD_OK) st = added(e, before, dyd_sites_add_words(e->sites, n, xy));
  return appended(e, st, err);
}

/* ---- streams and sources ---- */

/* Appends n sites with records like p; the site number is filled in. Nothing on failure. Of what sources tell is known
 * that it encloses places. */
static dyd_status points_add_refinable(dyd_engine *e, size_t n, dyd_refinable p) {
  size_t first = dyd_sites_count(e->sites);
  if (n > DYD_MAX_SITES) return DYD_E_RANGE;
  if (!dyd_reserve((void **)&e->point, &e->point_cap, e->points + n, sizeof *e->point)) return DYD_E_NOMEM;
  dyd_site_kind kind = p.stream ? dyd_stream_site_kind(p.stream) : DYD_SITE_BARE;
  dyd_status st = dyd_sites_add_planes(e->sites, n, kind);
  if (st != DYD_OK) return st;
  for (size_t k = 0; k < n; k++) {
    p.site = (uint32_t)(first + k);
    e->point[e->points++] = p;
  }
  return DYD_OK;
}

static dyd_status add_stream(dyd_engine *e, bool later, dyd_stream *s) {
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, later);
  const dyd_rect *fixed = dyd_stream_is_final(s) ? dyd_stream_rect(s) : NULL;
  if (st == DYD_OK) {
    st = fixed ? dyd_sites_add_rect(e->sites, fixed) : points_add_refinable(e, 1, (dyd_refinable){.stream = s});
    added(e, before, st);
  }
  if (fixed || st != DYD_OK) dyd_stream_free(s);
  return st;
}

/* Takes what add_stream would have taken. */
static dyd_status refuse_stream(dyd_stream *s, dyd_error *err) {
  dyd_stream_free(s);
  return dyd_fail_null(err);
}

dyd_status dyd_engine_add_stream(dyd_engine *e, dyd_stream *s) {
  if (!e || !s) return refuse_stream(s, NULL);
  return add_stream(e, false, s);
}

dyd_status dyd_engine_append_stream(dyd_engine *e, dyd_stream *s, dyd_error *err) {
  if (!e || !s) return refuse_stream(s, err);
  return appended(e, add_stream(e, true, s), err);
}

static dyd_status points_add_source(dyd_engine *e, size_t n, const dyd_source *source) {
  if (!source->narrow) return dyd_fail(&e->refused, DYD_E_ARG, "the source has no function `narrow`");
  if (!dyd_reserve((void **)&e->source, &e->source_cap, e->sources + 1, sizeof *e->source)) return DYD_E_NOMEM;
  size_t first = dyd_sites_count(e->sites);
  dyd_status st = points_add_refinable(e, n, (dyd_refinable){.source = (uint32_t)e->sources});
  if (st == DYD_OK) e->source[e->sources++] = (dyd_source_use){.source = *source, .first = (uint32_t)first};
  return st;
}

static dyd_status costs_check(dyd_engine *e, size_t n, const double *cost) {
  size_t first = dyd_sites_count(e->sites);
  for (size_t k = 0; k < n; k++) {
    if (cost[k] > 0 && isfinite(cost[k])) continue;
    e->refused.point = first + k;
    return dyd_fail(&e->refused, DYD_E_ARG, "point %zu: its cost is %g; costs are finite numbers above 0", first + k,
                    cost[k]);
  }
  return DYD_OK;
}

static dyd_status points_add_source_at_cost(dyd_engine *e, size_t n, const dyd_source *source) {
  dyd_labels labels;
  if (!source->cost) return points_add_source(e, n, source);
  dyd_status st = costs_check(e, n, source->cost);
  if (st != DYD_OK) return st;
  st = dyd_labels_cost(&labels, e, n, source->cost);
  if (st != DYD_OK) return st;
  st = points_add_source(e, n, source);
  if (st == DYD_OK) dyd_labels_give(e, &labels);
  dyd_labels_clear(&labels);
  return st;
}

static dyd_status add_source(dyd_engine *e, bool later, size_t n, const dyd_source *source) {
  dyd_source s;
  const size_t before = dyd_sites_count(e->sites);
  dyd_error_clear(&e->refused);
  dyd_status st = dyd_abi_take(&s, sizeof s, source, "dyd_source", &e->refused);
  if (st != DYD_OK) return st;
  st = dyd_engine_may_add(e, later);
  if (st == DYD_OK) st = added(e, before, points_add_source_at_cost(e, n, &s));
  if (st != DYD_OK && s.release) s.release(s.user);
  return st;
}

/* Releases what add_source would have released. */
static dyd_status refuse_source(const dyd_source *source, dyd_error *err) {
  dyd_source s;
  if (dyd_abi_take(&s, sizeof s, source, "dyd_source", NULL) == DYD_OK && s.release) s.release(s.user);
  return dyd_fail_null(err);
}

dyd_status dyd_engine_add_source(dyd_engine *e, size_t n, const dyd_source *source, dyd_error *err) {
  if (!e) return refuse_source(source, err);
  return appended(e, add_source(e, false, n, source), err);
}

dyd_status dyd_engine_append_source(dyd_engine *e, size_t n, const dyd_source *source, dyd_error *err) {
  if (!e) return refuse_source(source, err);
  return appended(e, add_source(e, true, n, source), err);
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
  st = dyd_engine_append_columns(e, n, xys, radius == 0 ? NULL : radii, err);
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
