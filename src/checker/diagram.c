/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checks what a certificate says of the Voronoi diagram: inner polygons, the area they leave, distances.
 *
 * Int_i is convex: a polygon lies in it when its vertices do [CERT-6]. A closed polygon that turns left everywhere, by
 * less than half a turn each time, is convex and simple when its edges turn round once in all: when they change once
 * from going back to going on, in the order by x, then by y. */
#include "base/error.h"
#include "checker/checker.h"

#include <string.h>

/* ---- polygons ---- */

static dyd_cert_spot polygon_spot(const dyd_cert_chain *p, size_t k) {
  return dyd_cert_spot_at(p->point[k % p->points]);
}

static bool polygon_goes_on(const dyd_cert_chain *p, size_t k) {
  const dyd_exact *a = p->point[k % p->points], *b = p->point[(k + 1) % p->points];
  int sign = dyd_exact_cmp(&a[0], &b[0]);
  return sign ? sign < 0 : dyd_exact_cmp(&a[1], &b[1]) < 0;
}

bool dyd_cert_polygon_is_convex(const dyd_cert_chain *p) {
  size_t begins = 0;
  if (p->points < 3) return false;
  for (size_t k = 0; k < p->points; k++) {
    if (dyd_cert_cross(polygon_spot(p, k), polygon_spot(p, k + 1), polygon_spot(p, k + 1), polygon_spot(p, k + 2)) <= 0)
      return false;
    begins += !polygon_goes_on(p, k) && polygon_goes_on(p, k + 1);
  }
  return begins == 1;
}

void dyd_cert_polygon_area2(dyd_exact *out, const dyd_cert_chain *p) {
  dyd_exact d[4];
  for (int k = 0; k < 4; k++) dyd_exact_init(&d[k]);
  for (size_t k = 1; k + 1 < p->points; k++) {
    for (int m = 0; m < 4; m++) dyd_exact_sub(&d[m], &p->point[k + (size_t)m / 2][m % 2], &p->point[0][m % 2]);
    dyd_exact_mul(&d[0], &d[0], &d[3]);
    dyd_exact_mul(&d[1], &d[1], &d[2]);
    dyd_exact_sub(&d[0], &d[0], &d[1]);
    dyd_exact_add(out, out, &d[0]);
  }
  for (int k = 0; k < 4; k++) dyd_exact_clear(&d[k]);
}

bool dyd_cert_window_has(const dyd_cert_window *w, const dyd_exact at[2]) {
  for (int a = 0; a < 2; a++)
    if (dyd_exact_cmp(&at[a], &w->e[2 * a]) < 0 || dyd_exact_cmp(&at[a], &w->e[2 * a + 1]) > 0) return false;
  return true;
}

/* The rest of a line: the vertices. */
static dyd_status read_vertices(dyd_checker *c) {
  dyd_cert_chain *p = &c->chain;
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && (k == 0 || dyd_cert_line_has_more(&c->in)); k++) {
    if (dyd_cert_chain_resize(p, k + 1) != DYD_OK) return dyd_fail_nomem(c->in.err);
    st = dyd_cert_read_point(p->point[k], &c->in);
  }
  return st;
}

static dyd_status check_polygon(dyd_checker *c, dyd_exact *area2, const dyd_cert_window *w, uint32_t i) {
  uint32_t other;
  dyd_status st = read_vertices(c);
  if (st != DYD_OK) return st;
  if (!dyd_cert_polygon_is_convex(&c->chain))
    return dyd_cert_reject(&c->in, "the polygon is not strictly convex and counter-clockwise");
  for (size_t k = 0; k < c->chain.points; k++) {
    if (!dyd_cert_window_has(w, c->chain.point[k]))
      return dyd_cert_reject(&c->in, "vertex %zu lies outside of the window", k);
    const dyd_exact *at = c->chain.point[k];
    if (!dyd_cert_is_witness(&other, &c->sites, &c->tree, i, i, at, false) &&
        !(c->disc && dyd_cert_is_disc_witness(&other, &c->sites, &c->tree, c->disc, i, i, at)))
      return dyd_cert_reject(&c->in, "vertex %zu may be as near to site %u as to %u", k, (unsigned)other, (unsigned)i);
  }
  dyd_cert_polygon_area2(area2, &c->chain);
  c->report.polygons++;
  return DYD_OK;
}

/* Stops at the line "undetermined", which is left to be read on. */
static dyd_status check_polygons(dyd_checker *c, dyd_exact *area2, const dyd_cert_window *w) {
  uint32_t i = 0, last = 0;
  dyd_status st = dyd_cert_expect_line(c, "polygons");
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  for (size_t q = 0; st == DYD_OK; q++, last = i) {
    st = dyd_cert_next_line(&c->in);
    if (st != DYD_OK || strncmp(c->in.line, "undetermined", 12) == 0) break;
    st = dyd_cert_read_site(&i, c);
    if (st == DYD_OK && q && i <= last) st = dyd_cert_reject(&c->in, "polygons are not in order");
    if (st == DYD_OK) st = check_polygon(c, area2, w, i);
  }
  return st;
}

/* ---- bounds ---- */

void dyd_cert_window_area(dyd_exact *out, const dyd_cert_window *w) {
  dyd_exact height;
  dyd_exact_init(&height);
  dyd_exact_sub(out, &w->e[1], &w->e[0]);
  dyd_exact_sub(&height, &w->e[3], &w->e[2]);
  dyd_exact_mul(out, out, &height);
  dyd_exact_clear(&height);
}

/* area2: twice the area of the polygons; it is used up. */
static dyd_status check_area(dyd_checker *c, dyd_exact *area2, const dyd_cert_window *w) {
  dyd_exact bound, all;
  dyd_exact_init(&bound);
  dyd_exact_init(&all);
  dyd_status st = dyd_cert_expect_word(c, "undetermined");
  if (st == DYD_OK) st = dyd_cert_read_number(&bound, &c->in);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st == DYD_OK) {
    dyd_cert_window_area(&all, w);
    area2->exp--;
    dyd_exact_add(area2, area2, &bound);
    if (dyd_exact_cmp(area2, &all) < 0) st = dyd_cert_reject(&c->in, "the polygons leave a greater area");
    dyd_cert_note_bound(c, "voronoi area", &bound);
  }
  dyd_exact_clear(&bound);
  dyd_exact_clear(&all);
  return st;
}

/* The rest of a line "distance H" or "distance H unproved"; its number is *bound. */
static dyd_status check_bound(dyd_checker *c, const dyd_exact *bound, const dyd_cert_window *w) {
  dyd_status st = DYD_OK;
  bool proved = !dyd_cert_line_has_more(&c->in), holds = false;
  if (!proved) st = dyd_cert_expect_word(c, "unproved");
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st == DYD_OK && proved) {
    if (dyd_cert_distance_holds(&holds, &c->sites, w, bound) != DYD_OK) return dyd_fail_nomem(c->in.err);
    if (!holds) st = dyd_cert_reject(&c->in, "boxes do not prove the bound of the distance");
  }
  if (st != DYD_OK) return st;
  c->report.distance = true;
  c->report.distance_proved = proved;
  dyd_cert_note_bound(c, "voronoi hausdorff", bound);
  return DYD_OK;
}

static dyd_status check_distance(dyd_checker *c, const dyd_cert_window *w) {
  dyd_exact bound;
  dyd_status st = dyd_cert_expect_line(c, "distance");
  if (st != DYD_OK || (c->in.at && strcmp(c->in.at, "none") == 0)) return st;
  dyd_exact_init(&bound);
  st = dyd_cert_read_number(&bound, &c->in);
  if (st == DYD_OK) st = check_bound(c, &bound, w);
  dyd_exact_clear(&bound);
  return st;
}

/* ---- all ---- */

static dyd_status read_window(dyd_checker *c, dyd_cert_window *w) {
  dyd_status st = dyd_cert_expect_word(c, "window");
  for (int k = 0; k < 4 && st == DYD_OK; k++) st = dyd_cert_read_number(&w->e[k], &c->in);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  if (dyd_exact_cmp(&w->e[0], &w->e[1]) >= 0 || dyd_exact_cmp(&w->e[2], &w->e[3]) >= 0)
    return dyd_cert_reject(&c->in, "the window has no area");
  return DYD_OK;
}

dyd_status dyd_checker_diagram(dyd_checker *c) {
  dyd_cert_window w;
  dyd_exact area2;
  dyd_cert_window_init(&w);
  dyd_exact_init(&area2);
  dyd_status st = read_window(c, &w);
  if (st == DYD_OK) st = check_polygons(c, &area2, &w);
  if (st == DYD_OK) st = check_area(c, &area2, &w);
  if (st == DYD_OK) st = check_distance(c, &w);
  c->report.diagram = true;
  dyd_exact_clear(&area2);
  dyd_cert_window_clear(&w);
  return st;
}
