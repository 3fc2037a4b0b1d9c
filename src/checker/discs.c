/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The section on discs: of the pairs that rectangles leave open, which are legal, and which illegal, when each point
 * lies in its disc, too [CERT-11]. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "checker/checker.h"

#include <stdlib.h>
#include <string.h>

/* ---- the discs ---- */

void dyd_checker_discs_clear(dyd_checker *c) {
  for (size_t i = 0; c->disc && i < c->sites.count; i++) dyd_cert_disc_clear(&c->disc[i]);
  free(c->disc);
  free(c->bare.item);
}

/* Some point of the rectangle is in the disc: else every statement on it is true. */
static bool disc_meets_site(const dyd_cert_disc *d, const dyd_cert_site *s) {
  const dyd_exact centre[2] = {d->x, d->y};
  DYD_LOCAL(dyd_cert_fraction, near, r2);
  dyd_cert_distance2(&near, centre, s, DYD_CERT_NEAR);
  dyd_exact_mul(&r2.num, &d->r, &d->r);
  return dyd_cert_fraction_cmp(&near, &r2) <= 0;
}

static dyd_status read_disc(dyd_checker *c, uint32_t i) {
  dyd_cert_disc *d = &c->disc[i];
  dyd_status st = dyd_cert_next_line(&c->in);
  if (st == DYD_OK) st = dyd_cert_read_number(&d->x, &c->in);
  if (st == DYD_OK) st = dyd_cert_read_number(&d->y, &c->in);
  if (st == DYD_OK) st = dyd_cert_read_number(&d->r, &c->in);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  if (dyd_exact_sgn(&d->r) < 0) return dyd_cert_reject(&c->in, "the radius is below 0");
  if (!disc_meets_site(d, &c->sites.site[i]))
    return dyd_cert_reject(&c->in, "the disc of site %u has no point in its rectangle", (unsigned)i);
  return DYD_OK;
}

dyd_status dyd_checker_read_discs(dyd_checker *c) {
  uint32_t count;
  dyd_status st = dyd_cert_expect_word(c, "discs");
  if (st == DYD_OK) st = dyd_cert_read_index(&count, &c->in, DYD_CERT_NONE);
  c->report.discs_fixed = st == DYD_OK && dyd_cert_line_has_more(&c->in);
  if (st == DYD_OK && c->report.discs_fixed) st = dyd_cert_expect_word(c, "fixed");
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  c->report.discs = c->sites.count - c->report.aliases;
  if (count != c->report.discs) return dyd_cert_reject(&c->in, "%zu discs are wanted", c->report.discs);
  c->disc = dyd_alloc(c->sites.count, sizeof *c->disc);
  if (!c->disc) return dyd_fail_nomem(c->in.err);
  for (size_t i = 0; i < c->sites.count; i++) dyd_cert_disc_init(&c->disc[i]);
  for (uint32_t i = 0; i < c->sites.count && st == DYD_OK; i++)
    if (c->sites.site[i].alias == i) st = read_disc(c, i);
  return st;
}

/* ---- the pairs ---- */

/* The rest of a line "l i j": nothing, or a witness. */
static dyd_status check_disc_witness(dyd_checker *c, const dyd_cert_edge *p) {
  uint32_t other;
  if (!dyd_cert_line_has_more(&c->in)) {
    c->report.discs_unproved++;
    return DYD_OK;
  }
  dyd_status st = dyd_cert_read_point(c->point, &c->in);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  if (!dyd_cert_is_disc_witness(&other, &c->sites, &c->tree, c->disc, p->i, p->j, c->point))
    return dyd_cert_reject(&c->in, "the disc of site %u is too near to the point of the line", (unsigned)other);
  c->report.discs_legal++;
  return DYD_OK;
}

/* The caps of the pair and of the sites that follow in the line; *good: all of them forbid something. */
static dyd_status read_caps(bool *good, dyd_checker *c, dyd_cert_caps *caps, const dyd_cert_edge *p) {
  uint32_t k;
  if (dyd_cert_caps_begin(good, caps, &c->disc[p->i], &c->disc[p->j]) != DYD_OK) return dyd_fail_nomem(c->in.err);
  while (*good && dyd_cert_line_has_more(&c->in)) {
    dyd_status st = dyd_cert_read_site(&k, c);
    if (st != DYD_OK) return st;
    if (dyd_cert_caps_add(good, caps, &c->disc[k]) != DYD_OK) return dyd_fail_nomem(c->in.err);
  }
  return DYD_OK;
}

/* The rest of a line "n i j": nothing, or the sites whose caps hold all directions. */
static dyd_status check_disc_caps(dyd_checker *c, const dyd_cert_edge *p) {
  if (!dyd_cert_line_has_more(&c->in)) {
    c->report.discs_unproved++;
    return DYD_OK;
  }
  size_t end;
  bool good = false;
  DYD_LOCAL(dyd_cert_caps, caps);
  dyd_status st = read_caps(&good, c, &caps, p);
  good = good && !dyd_cert_discs_meet(caps.i, caps.j) && dyd_cert_caps_cover(&end, &caps);
  if (st != DYD_OK) return st;
  if (!good)
    return dyd_cert_reject(&c->in, "the discs do not prove that %u %u is illegal", (unsigned)p->i, (unsigned)p->j);
  c->report.discs_illegal++;
  return DYD_OK;
}

/* A pair that the rectangles leave indeterminate. */
static dyd_status check_refined(dyd_checker *c, dyd_cert_edge *p) {
  static const char *const kinds[] = {"l", "n"};
  size_t kind;
  dyd_status st = dyd_cert_next_line(&c->in);
  if (st == DYD_OK) st = dyd_cert_read_choice(&kind, c, kinds, 2);
  if (st == DYD_OK) st = dyd_cert_read_pair(p, c);
  if (st != DYD_OK) return st;
  if (!dyd_cert_edges_have(&c->open, p->i, p->j) || dyd_cert_edges_have(&c->tie, p->i, p->j) ||
      dyd_cert_edges_have(&c->bare, p->i, p->j))
    return dyd_cert_reject(&c->in, "the pair is not listed as indeterminate");
  c->report.indeterminate--;
  return kind == 0 ? check_disc_witness(c, p) : check_disc_caps(c, p);
}

dyd_status dyd_checker_discs(dyd_checker *c) {
  uint32_t count = 0;
  dyd_cert_edge pair = {0, 0};
  dyd_status st = dyd_checker_read_discs(c);
  if (st == DYD_OK) st = dyd_cert_expect_line(c, "refined");
  if (st == DYD_OK) st = dyd_cert_read_index(&count, &c->in, DYD_CERT_NONE);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  for (uint32_t k = 0; k < count && st == DYD_OK; k++) st = check_refined(c, &pair);
  return st;
}
