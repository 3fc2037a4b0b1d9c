/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reads the section on a sphere, and checks that its sites are images of its places [CERT-14]. */
#include "checker/globe.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "checker/checker.h"

#include <string.h>

/* Pieces that all images have, and each: more would take minutes. */
enum { PIECES = 1 << 14, PIECES_EACH = 1 << 6 };

/* ---- places ---- */

static dyd_cert_site *add_place(dyd_cert_globe *g) {
  size_t i = g->place.count;
  if (!dyd_reserve((void **)&g->metres, &g->metres_cap, i + 1, sizeof *g->metres)) return NULL;
  dyd_cert_site *site = dyd_cert_sites_add(&g->place);
  if (site) dyd_exact_init(&g->metres[i]);
  return site;
}

/* The rest of a line: "= K": the place is exactly where place K is. */
static dyd_status read_place_alias(dyd_checker *c, uint32_t i) {
  dyd_cert_globe *g = &c->globe;
  uint32_t k = 0;
  dyd_status st = dyd_cert_expect_word(c, "=");
  if (st == DYD_OK) st = dyd_cert_read_index(&k, &c->in, i);
  if (st != DYD_OK) return st;
  if (k == i || g->place.site[k].alias != k) return dyd_cert_reject(&c->in, "place %u is an alias", (unsigned)k);
  DYD_LOCAL(dyd_cert_region, own, of);
  bool same = dyd_cert_globe_region(&own, g, i) && dyd_cert_globe_region(&of, g, k);
  same = same && dyd_cert_region_is_exact(&own) && dyd_cert_region_is_exact(&of) && dyd_cert_region_is_same(&own, &of);
  g->place.site[i].alias = k;
  return same ? DYD_OK : dyd_cert_reject(&c->in, "it is not seen to be the same place as %u", (unsigned)k);
}

static dyd_status read_globe_side(dyd_cert_side *out, dyd_checker *c) {
  dyd_status st = dyd_cert_read_side(out, &c->in);
  return st == DYD_E_NOMEM ? dyd_fail_nomem(c->in.err) : st;
}

static dyd_status read_metres(dyd_checker *c, uint32_t i) {
  dyd_exact *metres = &c->globe.metres[i];
  dyd_status st = dyd_cert_read_number(metres, &c->in);
  return st != DYD_OK || dyd_exact_sgn(metres) > 0 ? st : dyd_cert_reject(&c->in, "this is no radius");
}

/* "LON LAT", "LON LAT METRES", or "LON LAT = K". */
static dyd_status read_place_line(dyd_checker *c, uint32_t i) {
  dyd_cert_site *site = add_place(&c->globe);
  if (!site) return dyd_fail_nomem(c->in.err);
  dyd_status st = dyd_cert_next_line(&c->in);
  for (int a = 0; a < 2 && st == DYD_OK; a++) st = read_globe_side(&site->side[a], c);
  if (st == DYD_OK && dyd_cert_line_has_more(&c->in))
    st = c->in.at[0] == '=' ? read_place_alias(c, i) : read_metres(c, i);
  return st == DYD_OK ? dyd_cert_line_done(&c->in) : st;
}

static dyd_status read_places(dyd_checker *c) {
  uint32_t count = 0;
  dyd_status st = dyd_cert_expect_line(c, "places");
  if (st == DYD_OK) st = dyd_cert_read_index(&count, &c->in, (uint64_t)1 << 28);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  for (uint32_t i = 0; i < count && st == DYD_OK; i++) st = read_place_line(c, i);
  c->report.sphere_places = count;
  return st;
}

/* ---- the eye and the radius ---- */

/* "eye K", or "eye gap LON LAT"; K is looked at when there are places. */
static dyd_status read_eye(dyd_checker *c) {
  dyd_cert_globe *g = &c->globe;
  dyd_status st = dyd_cert_expect_line(c, "eye");
  g->gap = st == DYD_OK && c->in.at && strncmp(c->in.at, "gap ", 4) == 0;
  if (st == DYD_OK && !g->gap) return dyd_cert_read_index(&g->eye, &c->in, DYD_CERT_NONE - 1);
  if (st == DYD_OK) st = dyd_cert_expect_word(c, "gap");
  if (st != DYD_OK) return st;
  DYD_LOCAL(dyd_cert_sites, one);
  DYD_LOCAL_NUMBERS(mpq, none);
  dyd_cert_site *at = dyd_cert_sites_add(&one);
  if (!at) st = dyd_fail_nomem(c->in.err);
  for (int a = 0; a < 2 && st == DYD_OK; a++) st = read_globe_side(&at->side[a], c);
  if (st == DYD_OK &&
      (!dyd_cert_region_set(&g->lens.eye, at->side, none, none) || !dyd_cert_region_is_exact(&g->lens.eye)))
    st = dyd_cert_reject(&c->in, "the eye is no place");
  return st;
}

/* "radius none", "radius degrees R", "radius metres R". */
static dyd_status read_radius(dyd_checker *c) {
  static const char *const unit[] = {"none", "degrees", "metres"};
  dyd_cert_globe *g = &c->globe;
  size_t k = 0;
  dyd_status st = dyd_cert_expect_line(c, "radius");
  if (st == DYD_OK) st = dyd_cert_read_choice(&k, c, unit, 3);
  if (st != DYD_OK || k == 0) return st;
  g->ground = k == 2;
  DYD_LOCAL(dyd_cert_sites, one);
  dyd_cert_site *at = dyd_cert_sites_add(&one);
  st = at ? read_globe_side(&at->side[0], c) : dyd_fail_nomem(c->in.err);
  if (st == DYD_OK && (!at->side[0].point || dyd_exact_sgn(&at->side[0].lo) <= 0))
    st = dyd_cert_reject(&c->in, "this is no radius");
  if (st == DYD_OK) dyd_cert_exact_to_q(g->radius, &at->side[0].lo, dyd_cert_den(&at->side[0]));
  return st;
}

/* ---- images ---- */

/* Which place each site is the image of: all but the eye and aliases, in their order. */
static dyd_status find_images(dyd_checker *c) {
  dyd_cert_globe *g = &c->globe;
  size_t n = 0;
  g->of = dyd_alloc(g->place.count, sizeof *g->of);
  g->image = dyd_alloc(g->place.count, sizeof *g->image);
  g->kind = calloc(c->sites.count ? c->sites.count : 1, sizeof *g->kind);
  if (!g->of || !g->image || !g->kind) return dyd_fail_nomem(c->in.err);
  if (!g->gap && (g->eye >= g->place.count || g->place.site[g->eye].alias != g->eye))
    return dyd_cert_reject(&c->in, "there is no place %u that is the eye", (unsigned)g->eye);
  for (uint32_t i = 0; i < g->place.count; i++) {
    bool seen = g->place.site[i].alias == i && (g->gap || i != g->eye);
    g->image[i] = seen ? (uint32_t)n : DYD_CERT_NONE;
    if (seen) g->of[n++] = i;
  }
  if (n == c->sites.count) return DYD_OK;
  return dyd_cert_reject(&c->in, "there are %zu sites, and %zu places that have an image", c->sites.count, n);
}

static dyd_status check_image(dyd_checker *c, dyd_cert_region *r, uint32_t k) {
  dyd_cert_globe *g = &c->globe;
  if (!dyd_cert_globe_region(r, g, g->of[k]))
    return dyd_cert_reject(&c->in, "place %u is no place with a radius on the sphere", (unsigned)g->of[k]);
  dyd_cert_holds holds = dyd_cert_image_in(&g->lens, r, c->sites.site[k].side);
  if (holds == DYD_CERT_NO)
    return dyd_cert_reject(&c->in, "the rectangle of site %u does not hold the image of place %u", (unsigned)k,
                           (unsigned)g->of[k]);
  c->report.images_unproved += holds == DYD_CERT_OPEN;
  return DYD_OK;
}

static dyd_status check_images(dyd_checker *c) {
  dyd_cert_globe *g = &c->globe;
  dyd_status st = find_images(c);
  if (st != DYD_OK) return st;
  g->lens.pieces = PIECES + PIECES_EACH * c->sites.count;
  DYD_LOCAL(dyd_cert_region, r);
  if (!g->gap && !dyd_cert_globe_region(&g->lens.eye, g, g->eye))
    st = dyd_cert_reject(&c->in, "the eye is no place with a radius on the sphere");
  dyd_cert_region_box(&g->lens.eye);
  for (uint32_t k = 0; k < c->sites.count && st == DYD_OK; k++) st = check_image(c, &r, k);
  return st;
}

/* ---- the section ---- */

dyd_status dyd_checker_globe_places(dyd_checker *c) {
  c->globe.stated = c->report.sphere = true;
  dyd_status st = read_radius(c);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  return st == DYD_OK ? read_places(c) : st;
}

/* The radius and the places; of the second certificate those of the first. */
static dyd_status read_all_places(dyd_checker *c) {
  dyd_cert_globe *g = &c->globe;
  if (!c->first) return dyd_checker_globe_places(c);
  const dyd_cert_globe *from = &c->first->globe;
  dyd_cert_sites_clear(&g->place);
  g->place = from->place;
  g->metres = from->metres;
  g->borrowed = true;
  g->ground = from->ground;
  mpq_set(g->radius, from->radius);
  return DYD_OK;
}

dyd_status dyd_checker_globe(dyd_checker *c) {
  c->globe.stated = c->report.sphere = true;
  if (c->report.diagram || c->ties.blocks)
    return dyd_cert_reject(&c->in, "blocks and diagrams are about a plane, not about a sphere");
  dyd_status st = dyd_cert_expect_word(c, "sphere");
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st == DYD_OK) st = read_eye(c);
  c->report.gap = c->globe.gap;
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st == DYD_OK) st = read_all_places(c);
  return st == DYD_OK ? check_images(c) : st;
}
