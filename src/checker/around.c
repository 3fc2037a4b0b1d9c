/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is proved of places by what is proved of their images: ties, and who is a neighbour of the eye [CERT-14].
 *
 * An image that is on no hull, for no choice, is no neighbour of the eye: for each direction u another image is surely
 * beyond, u.x < u.y for all x of its rectangle and y of the other. In one quarter of the directions that asks for a
 * corner of each rectangle only, so the directions that an image is beyond in are an open half of all; two images that
 * share the quarter are enough. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "checker/checker.h"
#include "checker/cocircular.h"

#include <string.h>

/* Pairs of images that are compared. */
#define MOST_PAIRS ((uint64_t)1 << 24)

/* ---- ties ---- */

/* Are all sites of set k, and the eye if it is a chain, exact places of one circle? at[] has room for their regions. */
static bool set_is_tied(const dyd_checker *c, size_t k, dyd_cert_region *at) {
  const dyd_cert_globe *g = &c->globe;
  const dyd_cert_faces *f = &c->faces;
  size_t count = f->start[k + 1] - f->start[k], all = count + (f->shape[k] == DYD_CERT_CHAIN);
  for (size_t q = 0; q < all; q++) {
    uint32_t i = q < count ? g->of[f->member[f->start[k] + q]] : g->eye;
    if (!dyd_cert_globe_region(&at[q], g, i) || !dyd_cert_region_is_exact(&at[q])) return false;
  }
  const dyd_cert_region *four[4] = {&at[0], &at[all / 3], &at[2 * all / 3]};
  for (size_t q = 1; q < all; q++) {
    if (q == all / 3 || q == 2 * all / 3) continue;
    four[3] = &at[q];
    if (!dyd_cert_are_cocircular(four)) return false;
  }
  return true;
}

/* A chain is on a line, so on a circle with the eye; where that is no place, it is not known to be tied. */
static dyd_status mark_ties(dyd_checker *c) {
  dyd_cert_faces *f = &c->faces;
  size_t most = f->members + 1;
  if (!c->tie.count) return DYD_OK;
  dyd_cert_region *at = dyd_alloc(most, sizeof *at);
  if (!at) return dyd_fail_nomem(c->in.err);
  for (size_t q = 0; q < most; q++) dyd_cert_region_init(&at[q]);
  for (size_t k = 0; k < f->sets; k++) {
    size_t count = f->start[k + 1] - f->start[k];
    bool polygon = f->shape[k] == DYD_CERT_POLYGON && count > 3;
    bool chain = f->shape[k] == DYD_CERT_CHAIN && count > 2 && !c->globe.gap;
    if (f->shape[k] == DYD_CERT_CHAIN && c->globe.gap) f->tied[k] = false;
    if (polygon || chain) f->tied[k] = f->tied[k] || set_is_tied(c, k, at);
  }
  for (size_t q = 0; q < most; q++) dyd_cert_region_clear(&at[q]);
  free(at);
  return DYD_OK;
}

/* A pair of places is a tie where all sets that hold both are tied: circles through the eye are lines; where it is no
 * place, those are no ties. */
static void around_count_ties(dyd_checker *c) {
  c->report.ties_unproved = 0;
  for (size_t q = 0; q < c->tie.count; q++)
    c->report.ties_unproved += !dyd_cert_faces_tied(&c->faces, c->tie.item[q].i, c->tie.item[q].j);
}

/* Is it on a chain that is tied? */
static bool is_on_tied_chain(const dyd_cert_faces *f, uint32_t i) {
  for (size_t q = f->first[i]; q < f->first[i + 1]; q++)
    if (f->shape[f->of[q]] == DYD_CERT_CHAIN && f->tied[f->of[q]]) return true;
  return false;
}

/* ---- hulls ---- */

/* The corner of a rectangle that is the first, or the last, in all directions of a quarter: right of 0 for quarters 0
 * and 1, above it for quarters 0 and 2. */
static dyd_cert_spot corner_of(const dyd_cert_site *s, int quarter, bool last) {
  dyd_cert_spot out;
  for (int axis = 0; axis < 2; axis++) {
    bool up = axis ? !(quarter & 1) : !(quarter & 2);
    out.v[axis] = up == last ? dyd_cert_high(&s->side[axis]) : &s->side[axis].lo;
    out.den[axis] = dyd_cert_den(&s->side[axis]);
  }
  return out;
}

/* Is b beyond a along an axis, in the directions of the quarter? */
static bool is_beyond(const dyd_cert_spot *a, const dyd_cert_spot *b, int axis, int quarter) {
  DYD_LOCAL(dyd_cert_fraction, t);
  dyd_cert_fraction_sub(&t, b->v[axis], b->den[axis], a->v[axis], a->den[axis]);
  bool up = axis ? !(quarter & 1) : !(quarter & 2);
  int sign = dyd_exact_sgn(&t.num);
  return up ? sign > 0 : sign < 0;
}

/* For each direction of the quarter, is one of the listed images surely beyond image k? Of those that are so at one end
 * of the quarter, the one that is so farthest into it counts. */
static bool quarter_is_covered(const dyd_checker *c, const uint32_t *listed, size_t count, uint32_t k, int quarter) {
  dyd_cert_spot own = corner_of(&c->sites.site[k], quarter, true), best[2] = {{{0}, {0}}, {{0}, {0}}};
  bool found[2] = {false, false};
  int way = quarter == 0 || quarter == 3 ? 1 : -1;
  for (size_t q = 0; q < count; q++) {
    dyd_cert_spot at = corner_of(&c->sites.site[listed[q]], quarter, false);
    bool right = is_beyond(&own, &at, 0, quarter), above = is_beyond(&own, &at, 1, quarter);
    if (right && above) return true;
    if (!right && !above) continue;
    int end = above, turn = found[end] ? way * dyd_cert_cross(own, best[end], own, at) : 0;
    if (found[end] && (end ? turn >= 0 : turn <= 0)) continue;
    best[end] = at;
    found[end] = true;
  }
  return found[0] && found[1] && way * dyd_cert_cross(own, best[0], own, best[1]) > 0;
}

static bool is_off_hull(const dyd_checker *c, const uint32_t *listed, size_t count, uint32_t k) {
  for (int quarter = 0; quarter < 4; quarter++)
    if (!quarter_is_covered(c, listed, count, k, quarter)) return false;
  return true;
}

/* rim[k]: image k is on the walk of the unbounded face; all are where faces are not known. */
static dyd_status find_outer_sites(bool *rim, const dyd_checker *c) {
  uint32_t *walk = NULL, outer = c->graph.connected ? dyd_cert_outer(&c->graph) : DYD_CERT_NONE;
  size_t count = 0;
  for (size_t k = 0; k < c->sites.count; k++) rim[k] = outer == DYD_CERT_NONE && c->sites.site[k].alias == k;
  if (outer == DYD_CERT_NONE) return DYD_OK;
  dyd_status st = dyd_cert_walk(&walk, &count, &c->graph, outer);
  for (size_t q = 0; q < count && st == DYD_OK; q++) rim[dyd_cert_origin(&c->graph, walk[q])] = true;
  free(walk);
  return st;
}

/* What is not listed is no neighbour. */
static dyd_status check_unlisted(dyd_checker *c) {
  const dyd_cert_globe *g = &c->globe;
  DYD_FREED uint32_t *listed = dyd_alloc(c->sites.count, sizeof *listed);
  DYD_FREED bool *rim = dyd_alloc(c->sites.count, sizeof *rim);
  dyd_status st = listed && rim ? find_outer_sites(rim, c) : DYD_E_NOMEM;
  size_t count = 0;
  for (uint32_t k = 0; k < c->sites.count && st == DYD_OK; k++)
    if (g->kind[k]) listed[count++] = k;
  uint64_t left = MOST_PAIRS;
  for (uint32_t k = 0; k < c->sites.count && st == DYD_OK; k++) {
    if (!rim[k] || g->kind[k]) continue;
    bool looked = left >= count;
    if (looked) left -= count;
    c->report.around_unproved += !looked || !is_off_hull(c, listed, count, k);
  }
  return st == DYD_OK ? st : dyd_fail_nomem(c->in.err);
}

/* ---- the list ---- */

static int compare_site_corner(const void *a, const void *b) {
  uint32_t x = *(const uint32_t *)a, y = ((const dyd_cert_corner *)b)->i;
  return (x > y) - (x < y);
}

/* For every choice, is image k a corner of the hull of all? Of one or two images it is: points are different. */
static bool is_corner(const dyd_checker *c, uint32_t k) {
  const dyd_cert_corners *all = &c->corners;
  if (c->sites.count <= 2) return c->sites.site[k].alias == k;
  return all->count && bsearch(&k, all->item, all->count, sizeof *all->item, compare_site_corner);
}

/* Is image k surely beyond all others in direction u? */
static bool is_beyond_all(const dyd_checker *c, const dyd_exact u[2], uint32_t k) {
  for (uint32_t m = 0; m < c->sites.count; m++)
    if (m != k && c->sites.site[m].alias == m && dyd_cert_compare_heights(&c->sites, u, m, k) >= 0) return false;
  return true;
}

/* Of a line "l k", or "l k X Y" with a direction in which the image is beyond all others. */
static dyd_status read_corner(bool *sure, dyd_checker *c, uint32_t k) {
  *sure = is_corner(c, k);
  if (!dyd_cert_line_has_more(&c->in)) return DYD_OK;
  dyd_status st = dyd_cert_read_point(c->point, &c->in);
  if (st != DYD_OK) return st;
  *sure = true;
  if (is_beyond_all(c, c->point, k)) return DYD_OK;
  return dyd_cert_reject(&c->in, "image %u is not seen to be a corner of the hull", (unsigned)k);
}

static dyd_status read_neighbour(dyd_checker *c, uint32_t *k, bool first) {
  static const char *const kinds[] = {"l", "t", "o"};
  dyd_cert_globe *g = &c->globe;
  uint32_t before = *k;
  size_t kind = 0;
  bool sure = false;
  dyd_status st = dyd_cert_next_line(&c->in);
  if (st == DYD_OK) st = dyd_cert_read_choice(&kind, c, kinds, 3);
  if (st == DYD_OK) st = dyd_cert_read_site(k, c);
  if (st == DYD_OK && kind == 0) st = read_corner(&sure, c, *k);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  if (!first && *k <= before) return dyd_cert_reject(&c->in, "neighbours are not in order");
  if (g->gap && kind != 2) return dyd_cert_reject(&c->in, "the eye is no place, and has no pairs");
  if (kind == 1 && is_corner(c, *k)) return dyd_cert_reject(&c->in, "the pair is legal, and no tie");
  g->kind[*k] = kinds[kind][0];
  g->listed++;
  if (g->gap) return DYD_OK;
  c->report.legal_around += sure;
  c->report.legal_unproved += kind == 0 && !sure;
  c->report.tie += kind == 1;
  c->report.ties_unproved += kind == 1 && !is_on_tied_chain(&c->faces, *k);
  c->report.indeterminate += kind == 2;
  return DYD_OK;
}

/* Pairs of images that are both listed, and are no pairs of the plane: about a gap, these are open. */
static uint64_t pairs_about_gap(const dyd_checker *c) {
  const dyd_cert_edges *const known[2] = {&c->legal, &c->open};
  const char *kind = c->globe.kind;
  uint64_t n = c->globe.listed, count = n ? n * (n - 1) / 2 : 0;
  for (int l = 0; l < 2; l++)
    for (size_t e = 0; e < known[l]->count; e++) count -= kind[known[l]->item[e].i] && kind[known[l]->item[e].j];
  return count;
}

/* ---- what is open ---- */

bool dyd_checker_is_open(const dyd_checker *c, uint32_t i, uint32_t j) {
  const dyd_cert_globe *g = &c->globe;
  uint32_t k = g->image[i], l = g->image[j];
  if (k == DYD_CERT_NONE && l == DYD_CERT_NONE) return false;
  if (k == DYD_CERT_NONE || l == DYD_CERT_NONE)
    return g->kind[k == DYD_CERT_NONE ? l : k] && g->kind[k == DYD_CERT_NONE ? l : k] != 'l';
  if (k > l) k = g->image[j], l = g->image[i];
  if (dyd_cert_edges_have(&c->open, k, l)) return true;
  return g->gap && g->kind[k] && g->kind[l] && !dyd_cert_edges_have(&c->legal, k, l);
}

bool dyd_checker_is_closed_around(const dyd_checker *c) {
  const dyd_cert_globe *g = &c->globe;
  if (g->gap) return pairs_about_gap(c) == 0;
  for (uint32_t k = 0; k < c->sites.count; k++)
    if (g->kind[k] == 'o' || (g->kind[k] == 't' && !is_on_tied_chain(&c->faces, k))) return false;
  return true;
}

dyd_status dyd_checker_around(dyd_checker *c) {
  uint32_t count = 0, k = 0;
  dyd_status st = mark_ties(c);
  if (st != DYD_OK) return st;
  around_count_ties(c);
  st = dyd_cert_expect_line(c, "neighbours");
  if (st == DYD_OK) st = dyd_cert_read_index(&count, &c->in, c->sites.count);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  for (uint32_t q = 0; q < count && st == DYD_OK; q++) st = read_neighbour(c, &k, q == 0);
  for (uint32_t i = 0; i < c->sites.count && st == DYD_OK; i++)
    if (!c->globe.kind[i] && c->sites.site[i].alias == i && is_corner(c, i))
      st = dyd_cert_reject(&c->in, "site %u is a corner of the hull, and no neighbour", (unsigned)i);
  if (st == DYD_OK) st = check_unlisted(c);
  if (st == DYD_OK && c->globe.gap) c->report.indeterminate += pairs_about_gap(c);
  return st;
}
