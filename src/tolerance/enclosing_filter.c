/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tolerances of true points that are known as small rectangles, from those of the rectangles' centres.
 *
 * [TOL-10] Let each true point be within d of its centre, in the metric of the tolerances. What every choice within t
 * of the centres has, every choice within t - d of the true points has, as these are within t of the centres; and the
 * other way round. So deaths, births, the whole and the radii of points differ by at most d. A pair that is tied for
 * the true points has the event at 0. */
#include "tolerance/state.h"

#include "base/error.h"
#include "base/index.h"
#include "dyadic/raw.h"
#include "rect/rect.h"
#include "rect/sites_table.h"

#include <math.h>

/* At least half of the length of a side. */
static dyd_status side_half(double *half, const dyd_interval *side) {
  DYD_LOCAL(dyd_dyadic, x);
  dyd_status st = dyd_dyadic_sub(&x, &side->hi, &side->lo);
  if (st == DYD_OK) st = dyd_dyadic_mul_2exp(&x, &x, -1);
  if (st == DYD_OK) *half = dyd_raw_quotient_get_d(x.man, x.exp, side->den, DYD_UP);
  return st;
}

/* r becomes its centre; *off is raised to how far points of it are from there. */
static dyd_status rect_centre(dyd_rect *r, double *off, dyd_metric metric) {
  double half[2] = {0, 0};
  dyd_interval *side[2] = {&r->x, &r->y};
  dyd_status st = DYD_OK;
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    if (dyd_interval_is_point(side[a])) continue;
    st = side_half(&half[a], side[a]);
    if (st == DYD_OK) st = dyd_interval_halve(side[a]);
  }
  double most = metric == DYD_METRIC_BOX ? fmax(half[0], half[1]) : dyd_upper(dyd_upper(half[0]) + half[1]);
  if (most > *off) *off = most;
  return st;
}

/* The sites whose centres are triangulated; *off is raised as above. */
typedef struct centred {
  const dyd_sites *from;
  dyd_metric metric;
  double *off;
} centred;

static dyd_status centre_of_site(dyd_rect *out, const void *user, size_t i) {
  const centred *c = user;
  dyd_status st = dyd_sites_get(out, c->from, dyd_sites_joined(c->from, i));
  return st == DYD_OK ? rect_centre(out, c->off, c->metric) : st;
}

static double widened_down(double t, double off) {
  return fmax(dyd_lower(t - off), 0);
}

static double widened_up(double t, double off) {
  return dyd_upper(t + off);
}

/* Widens rows to those of the true points; removes rows of indeterminate pairs, and births certainly above up_to.
 * *least: the least lo of the centres among rows other than ties. */
static void rows_widen(double *least, dyd_tolerance *t, double off, const dyd_delaunay *pd, double up_to) {
  size_t kept = 0;
  for (size_t k = 0; k < t->rows; k++) {
    dyd_tolerance_row row = t->row[k];
    dyd_pair_status status = dyd_delaunay_status(pd, row.i, row.j);
    if (status == DYD_INDETERMINATE) continue;
    if (status == DYD_TIE) continue; /* added below */
    *least = fmin(*least, row.lo);
    row.lo = widened_down(row.lo, off);
    row.hi = widened_up(row.hi, off);
    if (row.event == DYD_EVENT_BIRTH && row.lo > up_to) continue;
    t->row[kept++] = row;
  }
  t->rows = kept;
}

static dyd_status rows_add_ties(dyd_tolerance *t, const dyd_delaunay *pd) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = dyd_delaunay_pairs(&pairs, pd);
  for (size_t k = 0; k < pairs.count && st == DYD_OK; k++) {
    const dyd_pair *p = &pairs.item[k];
    if (p->status == DYD_TIE)
      st = dyd_row_add(t, (dyd_tolerance_row){p->i, p->j, DYD_EVENT_TIE, DYD_NO_SITE, DYD_NO_SITE, 0, 0});
  }
  return st;
}

/* Of the centres, so far. */
static dyd_status tolerance_widen(double *least, dyd_tolerance *t, double off, const dyd_delaunay *pd, double up_to) {
  size_t count[4];
  dyd_delaunay_count(count, pd);
  rows_widen(least, t, off, pd, up_to);
  dyd_status st = count[DYD_TIE] ? rows_add_ties(t, pd) : DYD_OK;
  if (st != DYD_OK) return st;
  if (t->rows) qsort(t->row, t->rows, sizeof *t->row, dyd_compare_two);
  const bool ties = count[DYD_TIE] > 0;
  dyd_tolerance_result *r = &t->result;
  r->lo = ties ? 0 : widened_down(r->lo, off);
  r->hi = ties ? 0 : widened_up(r->hi, off);
  for (size_t i = 0; t->radius && i < dyd_sites_count(dyd_delaunay_sites(pd)); i++)
    t->radius[i] = widened_down(t->radius[i], off);
  return DYD_OK;
}

dyd_status dyd_tolerance_enclosing(dyd_tolerance **out, double *off, double *least, const dyd_delaunay *pd,
                                   const dyd_tolerance_options *options, dyd_error *err) {
  DYD_OWNED(dyd_delaunay) *centres = NULL;
  dyd_tolerance_options o = *options;
  const centred of = {dyd_delaunay_sites(pd), o.metric, off};
  const dyd_delaunay_options how = {DYD_SIZED(dyd_delaunay_options), .max_pairs = o.max_pairs, .cancel = o.cancel};
  double up_to = HUGE_VAL;
  DYD_LOCAL_NUMBERS(mpq, beyond);
  *off = 0;
  *least = HUGE_VAL;
  *out = NULL;
  dyd_status st = dyd_delaunay_made(&centres, dyd_sites_count(of.from), centre_of_site, &of, &how, err);
  if (st == DYD_OK && o.up_to && mpq_sgn(o.up_to) > 0 && *off < HUGE_VAL) {
    up_to = dyd_upper(mpq_get_d(o.up_to));
    mpq_set_d(beyond, *off);
    mpq_add(beyond, beyond, o.up_to);
    o.up_to = beyond;
  }
  if (st == DYD_OK) st = dyd_tolerance_new(out, centres, &o, err);
  if (*out) {
    (*out)->centres = centres;
    centres = NULL;
    dyd_status widened = tolerance_widen(least, *out, *off, pd, up_to);
    if (widened == DYD_OK) return st;
    dyd_tolerance_free(*out);
    *out = NULL;
    st = dyd_fail(err, widened, "%s", dyd_status_text(widened));
  }
  return st;
}
