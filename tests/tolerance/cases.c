/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Small sets of points, and the questions about them. */
#include <setjmp.h>
#include <stdarg.h>

#include "tolerance/cases.h"

#include <cmocka.h>
#include <math.h>

void cases_make(brute_points *p, test_random *r, size_t kind) {
  p->n = 2 + test_below(r, 7);
  for (size_t i = 0; i < p->n; i++) {
    double a = 6.283185307179586 * test_unit(r), x = test_unit(r), y = test_unit(r);
    if (kind == 0) y = ldexp(y, -20);
    if (kind == 1) x = (double)(i % 3) + ldexp(x, -12), y = (double)(i / 3) + ldexp(y, -12);
    if (kind == 2) x = cos(a) * (1 + ldexp(x, -14)), y = sin(a) * (1 + ldexp(y, -14));
    if (kind == 3) x = (double)test_below(r, 4), y = (double)test_below(r, 4);
    if (kind == 5) x = (double)test_below(r, 64), y = 2 * x + 1;
    p->x[i] = kind == 3 ? x : ldexp(nearbyint(ldexp(x, 30)), -30);
    p->y[i] = kind == 3 ? y : ldexp(nearbyint(ldexp(y, 36)), -36);
  }
  for (size_t i = 0; i < p->n; i++) /* places once only */
    for (size_t k = 0; k < i; k++)
      if (p->x[i] == p->x[k] && p->y[i] == p->y[k]) {
        p->n--;
        p->x[i] = p->x[p->n], p->y[i] = p->y[p->n];
        i--;
        break;
      }
}

void cases_ask(cases_answer *a, const brute_points *p, const dyd_tolerance_options *o) {
  dyd_error err;
  assert_int_equal(dyd_sites_new(&a->sites), DYD_OK);
  assert_int_equal(dyd_sites_add_points(a->sites, p->n, p->x, p->y), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&a->pd, a->sites, NULL, &err), DYD_OK);
  assert_int_equal(dyd_tolerance_new(&a->t, a->pd, o, &err), DYD_OK);
}

void cases_forget(cases_answer *a) {
  dyd_tolerance_free(a->t);
  dyd_delaunay_free(a->pd);
  dyd_sites_free(a->sites);
}

const dyd_tolerance_row *cases_row(const dyd_tolerance *t, uint32_t i, uint32_t j) {
  const dyd_tolerance_row *row;
  size_t n = dyd_tolerance_rows(&row, t);
  for (size_t k = 0; k < n; k++) {
    if (k) assert_true(row[k - 1].i < row[k].i || (row[k - 1].i == row[k].i && row[k - 1].j < row[k].j));
    if (row[k].i == i && row[k].j == j) return &row[k];
  }
  return NULL;
}

static double side_of(const brute_points *p, uint32_t i, uint32_t j, uint32_t k) {
  return (p->x[j] - p->x[i]) * (p->y[k] - p->y[i]) - (p->y[j] - p->y[i]) * (p->x[k] - p->x[i]);
}

bool cases_parted(const brute_points *p, const dyd_tolerance_row *row) {
  return (side_of(p, row->i, row->j, row->k) > 0) != (side_of(p, row->i, row->j, row->l) > 0);
}

bool cases_is_edge(const brute_points *p, uint32_t i, uint32_t j) {
  dyd_sites *sites;
  dyd_delaunay *pd;
  dyd_error err;
  assert_int_equal(dyd_sites_new(&sites), DYD_OK);
  assert_int_equal(dyd_sites_add_points(sites, p->n, p->x, p->y), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, sites, NULL, &err), DYD_OK);
  bool edge = dyd_delaunay_status(pd, i, j) == DYD_LEGAL;
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return edge;
}

void cases_move(brute_points *out, const brute_points *p, const double *radius, double share, test_random *r) {
  *out = *p;
  for (size_t i = 0; i < p->n; i++) {
    double a = 6.283185307179586 * test_unit(r), d = radius[i] * share * (test_chance(r, 2) ? 1 : test_unit(r));
    if (!isfinite(d)) continue;
    out->x[i] += d * cos(a) * (1 - 1e-9); /* roundings of these lines must not carry it outside */
    out->y[i] += d * sin(a) * (1 - 1e-9);
  }
}

bool cases_same_edges(const brute_points *p, const cases_answer *a) {
  dyd_sites *sites;
  dyd_delaunay *pd;
  dyd_error err;
  bool same = true;
  assert_int_equal(dyd_sites_new(&sites), DYD_OK);
  assert_int_equal(dyd_sites_add_points(sites, p->n, p->x, p->y), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, sites, NULL, &err), DYD_OK);
  for (uint32_t i = 0; i < p->n; i++)
    for (uint32_t j = i + 1; j < p->n; j++)
      same = same && dyd_delaunay_status(pd, i, j) == dyd_delaunay_status(a->pd, i, j);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return same;
}
